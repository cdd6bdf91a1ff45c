"""Compares the hexes and the tets of each folder with the reference at the same points.

compare.py FOLDER ...   prints a table per folder, writes results.json and stress.vtu there
"""

import json
import math
import os
import sys

from locate import TetLocator, shape_functions
from results import element_means, max_principal, mean, quantile, read_frd, von_mises
from vtu import write_vtu
from wall_mesh import CORNERS, quadratic, read_inp

REFERENCE = "C3D20R"
HIGH = 0.99  # of the points have less than what is called high stress
LIMIT = 0.05  # of the median differences of C3D8I and of C3D10


class Case:
    """The meshes of a folder; the points at which they are compared."""

    def __init__(self, folder):
        self.folder = folder
        self.wall, self.tets = (read_inp(f"{folder}/{name}.inp") for name in ("wall", "tets"))
        self.skin = self.wall.nodes_of_patch("inner_wall")
        middle = list(self.wall.sets.values())[len(self.wall.sets) // 2]
        self.middle = {e: mean([self.wall.nodes[n] for n in self.wall.elements[e]]) for e in middle}
        locator = TetLocator(self.tets, self.tet_width())
        self.place = {e: locator.find(p) for e, p in self.middle.items()}

    def tet_width(self):
        spans = []
        for nodes in self.tets.elements.values():
            spans += (max(x) - min(x) for x in zip(*(self.tets.nodes[n] for n in nodes)))
        return 2 * quantile(spans, 0.5)

    def width(self):
        x = [point[0] for point in self.wall.nodes.values()]
        return 1.1 * (max(x) - min(x))

    def seconds(self, what):
        with open(f"{self.folder}/{what}.seconds") as file:
            return float(file.read())

    def mesh_of(self, kind):
        linear = self.wall if CORNERS[kind] == 8 else self.tets
        return linear if kind in ("C3D8", "C3D8I", "C3D4") else quadratic(linear, kind)

    def mesh_seconds(self, kind):
        surface = self.seconds("hexwall")
        return surface if CORNERS[kind] == 8 else surface + self.seconds("tetgen")


def middle_stresses(case, mesh, kind, nodal):
    """Stress tensors in the centres of the middle layer's hexes."""
    if mesh.corners == 8:
        return element_means(f"{case.folder}/{kind}_deck.dat")
    stresses = {}
    for element, (tet, weights) in case.place.items():
        nodes = mesh.elements[tet]
        shape = shape_functions(weights, len(nodes))
        stresses[element] = [
            sum(n * s for n, s in zip(shape, column)) for column in zip(*(nodal[n] for n in nodes))
        ]
    return stresses


class Solution:
    def __init__(self, case, kind):
        self.kind, mesh = kind, case.mesh_of(kind)
        tables = read_frd(f"{case.folder}/{kind}_deck.frd")
        self.u, self.nodal = tables["DISP"], tables["STRESS"]
        middle = middle_stresses(case, mesh, kind, self.nodal)
        skin = {n: self.nodal[n] for n in case.skin}
        self.stress = {
            f"{name}, {where}": {i: value(s) for i, s in stresses.items()}
            for name, value in (("principal", max_principal), ("von Mises", von_mises))
            for where, stresses in (("lumen", skin), ("middle", middle))
        }
        self.size = {"cells": len(mesh.elements), "nodes": len(mesh.nodes)}
        self.size["degrees of freedom"] = 3 * len(mesh.nodes)
        self.size["mesh seconds"] = case.mesh_seconds(kind)
        self.size["solve seconds"] = case.seconds(kind)


def spread(differences):
    return {"median": quantile(differences, 0.5), "95 %": quantile(differences, 0.95)}


def displacement_differences(case, a, b):
    """Relative to the greatest displacement."""
    scale = max(math.hypot(*b.u[n]) for n in case.skin)
    return [math.dist(a.u[n], b.u[n]) / scale for n in case.skin]


def differences(case, a, b):
    """Of a from b; of stresses relative to the stress of b that 99 % of the points do not exceed, and
    relative to that of b at the point, which is near zero here and there."""
    of = {"displacement": spread(displacement_differences(case, a, b))}
    for name, values in b.stress.items():
        scale = quantile(values.values(), HIGH)
        off = {i: abs(a.stress[name][i] - s) for i, s in values.items()}
        of[name] = spread([d / scale for d in off.values()])
        of[name + ", relative"] = spread([off[i] / abs(s) for i, s in values.items()])
    return of


def summary_of(case, solution):
    principal = solution.stress["principal, lumen"].values()
    return {
        **solution.size,
        "greatest displacement [mm]": max(math.hypot(*solution.u[n]) for n in case.skin),
        "principal stress, lumen, quantiles [MPa]": {
            f"{100 * q:g} %": quantile(principal, q) for q in (0.5, HIGH, 1)
        },
    }


COLUMNS = {"displacement": "u", "principal, lumen": "s1 lumen", "principal, middle": "s1 middle"}


def percents(of):
    return "".join(f"  {100 * of[c]['median']:5.2f} {100 * of[c]['95 %']:5.1f}" for c in COLUMNS)


def print_table(name, results):
    print(f"\n{name}: differences from {REFERENCE}, median and 95 %, in %")
    heads = "".join(f"  {c:>11}" for c in COLUMNS.values())
    print("          cells   nodes    mesh    solve  max u  99 % s1" + heads)
    for kind, r in results["solutions"].items():
        high = r["principal stress, lumen, quantiles [MPa]"]["99 %"]
        print(
            f"{kind:7}{r['cells']:8}{r['nodes']:8} {r['mesh seconds']:5.1f} s"
            f" {r['solve seconds']:6.1f} s  {r['greatest displacement [mm]']:5.3f}  {high:7.4f}"
            + percents(r["difference"])
        )
    print("C3D8I from C3D10" + 39 * " " + percents(results["C3D8I from C3D10"]))


def compare(folder):
    case = Case(folder)
    solutions = {k: Solution(case, k) for k in ("C3D8", "C3D8I", "C3D4", "C3D10", REFERENCE)}
    results = {"reference": REFERENCE, "solutions": {}}
    for kind, solution in solutions.items():
        of = differences(case, solution, solutions[REFERENCE])
        results["solutions"][kind] = {**summary_of(case, solution), "difference": of}
    results["C3D8I from C3D10"] = differences(case, solutions["C3D8I"], solutions["C3D10"])
    with open(folder + "/results.json", "w") as file:
        json.dump(results, file, indent=1)
    print_table(os.path.basename(folder), results)
    hexes, tets = (case.wall, solutions["C3D8I"]), (case.tets, solutions["C3D10"])
    write_vtu(folder + "/stress.vtu", [(*hexes, (0, 0, 0)), (*tets, (case.width(), 0, 0))])
    return results


def main():
    for folder in sys.argv[1:]:
        results = compare(folder)
        for kind in ("C3D8I", "C3D10"):
            of = results["solutions"][kind]["difference"]
            if max(of[name]["median"] for name in COLUMNS) > LIMIT:
                sys.exit(f"{folder}: {kind} is more than {100 * LIMIT:g} % off at half of the points")


main()
