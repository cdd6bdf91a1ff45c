"""The wall of a hex mesh as tets: its boundary for TetGen, and TetGen's tets for CalculiX.

tets.py boundary WALL.inp OUT.smesh
tets.py mesh WALL.inp TETGEN OUT.inp   TETGEN: path of TetGen's files without .node, .ele, .face
"""

import sys

from locate import volume
from wall_mesh import FACES, Mesh, read_inp, write_inp


def boundary_nodes(wall):
    return sorted({n for _, face in wall.boundary_faces() for n in wall.face(*face)})


def distance2(p, q):
    return sum((a - b) ** 2 for a, b in zip(p, q))


def halves(nodes, quad):
    """Two triangles, split along the shorter diagonal, outwards."""
    d, c, b, a = quad
    if distance2(nodes[a], nodes[c]) <= distance2(nodes[b], nodes[d]):
        return (a, b, c), (a, c, d)
    return (a, b, d), (b, c, d)


def write_smesh(wall, path):
    used = boundary_nodes(wall)
    index = {n: i for i, n in enumerate(used)}
    mark = {name: m for m, name in enumerate(wall.patches, 1)}
    triangles = [
        (triangle, mark[name])
        for name, face in wall.boundary_faces()
        for triangle in halves(wall.nodes, wall.face(*face))
    ]
    with open(path, "w") as file:
        file.write(f"{len(used)} 3 0 0\n")
        file.writelines("%d %.17g %.17g %.17g\n" % (i, *wall.nodes[n]) for n, i in index.items())
        file.write(f"{len(triangles)} 1\n")
        file.writelines(f"3 {index[a]} {index[b]} {index[c]} {m}\n" for (a, b, c), m in triangles)
        file.write("0\n")


def rows_of(path, kind):
    with open(path) as file:
        next(file)
        return [[kind(word) for word in line.split()] for line in file if line[0] != "#"]


def patches_of(tets, triangles, number, names):
    owner = {}
    for element, nodes in tets.elements.items():
        for face, corners in enumerate(FACES[4]):
            owner[tuple(sorted(nodes[i] for i in corners))] = element, face
    patches = {name: [] for name in names}
    for _, a, b, c, mark in triangles:
        patches[names[mark - 1]].append(owner[tuple(sorted((number[a], number[b], number[c])))])
    return patches


def tets_of(wall, prefix):
    """Nodes of the boundary have the numbers that they have in `wall`."""
    tets, used, last = Mesh("C3D4"), boundary_nodes(wall), max(wall.nodes)
    points = rows_of(prefix + ".node", float)
    number = used + [last + 1 + i for i in range(len(points) - len(used))]
    tets.nodes = {number[i]: tuple(row[1:4]) for i, row in enumerate(points)}
    for row in rows_of(prefix + ".ele", int):
        a, b, c, d = (number[i] for i in row[1:5])
        if volume(*(tets.nodes[n] for n in (a, b, c, d))) < 0:
            a, b = b, a
        tets.elements[row[0] + 1] = (a, b, c, d)
    tets.sets["wall"] = list(tets.elements)
    tets.patches = patches_of(tets, rows_of(prefix + ".face", int), number, list(wall.patches))
    return tets


def main():
    what, wall, *paths = sys.argv[1:]
    wall = read_inp(wall)
    if what == "boundary":
        write_smesh(wall, paths[0])
    else:
        write_inp(tets_of(wall, paths[0]), paths[1])


main()
