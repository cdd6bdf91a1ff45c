"""Decks for CalculiX: the wall under pressure on its inner side, in elements of several kinds.
Units are N and mm, so stresses are in MPa.

decks.py FOLDER   FOLDER has wall.inp by hexwall and tets.inp by tets.py
"""

import math
import sys

from results import mean
from wall_mesh import quadratic, read_inp, write_inp

PRESSURE = 0.016
YOUNG, POISSON = 2.7, 0.45


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def ring_axis(wall, name):
    """Centre and unit normal of an end ring."""
    total = [0.0, 0.0, 0.0]
    for face in wall.patches[name]:
        p = [wall.nodes[n] for n in wall.face(*face)]
        d1, d2 = ([a - b for a, b in zip(p[i + 2], p[i])] for i in (0, 1))
        total = [t + x / 2 for t, x in zip(total, cross(d1, d2))]
    length = math.hypot(*total)
    return mean([wall.nodes[n] for n in wall.nodes_of_patch(name)]), [t / length for t in total]


def load(wall):
    """The end rings move only towards their centres or away: neither along the vessel nor around."""
    rings = [name for name in wall.patches if name not in ("inner_wall", "outer_wall")]
    lines = []
    for name in rings:
        centre, normal = ring_axis(wall, name)
        lines.append(f"*TRANSFORM, NSET={name}, TYPE=C")
        axis = centre + [c + n for c, n in zip(centre, normal)]
        lines.append(", ".join(f"{x:.9f}" for x in axis))
    lines += ["*STEP", "*STATIC", "*BOUNDARY"] + [f"{name}, 2, 3" for name in rings]
    lines += ["*DSLOAD", f"inner_wall, P, {PRESSURE}", "*NODE FILE", "U", "*EL FILE", "S", ""]
    return "\n".join(lines)


def write_deck(folder, mesh_file, mesh):
    """`MESH_FILE.inp` with its load; stresses within the middle layer, if there are layers."""
    sets = list(mesh.sets)
    middle = sets[len(sets) // 2]
    with open(f"{folder}/{mesh_file}_deck.inp", "w") as deck:
        deck.write(f"*INCLUDE, INPUT={mesh_file}.inp\n*MATERIAL, NAME=wall\n")
        deck.write(f"*ELASTIC\n{YOUNG}, {POISSON}\n")
        deck.writelines(f"*SOLID SECTION, ELSET={name}, MATERIAL=wall\n" for name in sets)
        deck.write("*INCLUDE, INPUT=load.inp\n")
        if len(sets) > 1:
            deck.write(f"*EL PRINT, ELSET={middle}\nS\n")
        deck.write("*END STEP\n")


def main():
    folder = sys.argv[1]
    wall, tets = (read_inp(f"{folder}/{name}.inp") for name in ("wall", "tets"))
    with open(folder + "/load.inp", "w") as file:
        file.write(load(wall))
    plain = [("C3D8", wall), ("C3D8I", wall), ("C3D4", tets)]
    for kind, mesh in plain:
        mesh.kind = kind
        write_inp(mesh, f"{folder}/{kind}.inp")
        write_deck(folder, kind, mesh)
    for kind, mesh in (("C3D20R", wall), ("C3D10", tets)):
        write_inp(quadratic(mesh, kind), f"{folder}/{kind}.inp")
        write_deck(folder, kind, mesh)


main()
