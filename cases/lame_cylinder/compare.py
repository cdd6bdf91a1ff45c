"""Prints the errors of both solvers relative to Lamé's solution, and the order at which they fall.

compare.py TIME SIZE:LAYERS:FOLDER ...   TIME is the folder of OpenFOAM's results
"""

import math
import re
import sys

INNER, OUTER, PRESSURE, YOUNG, POISSON = 1.0, 1.2, 1.0, 1000.0, 0.3
LIMIT = 0.01  # of the last run


def displacement(r):
    a = PRESSURE * INNER**2 / (OUTER**2 - INNER**2)
    return (1 + POISSON) / YOUNG * a * ((1 - 2 * POISSON) * r + OUTER**2 / r)


def hoop_stress(r):
    return PRESSURE * INNER**2 / (OUTER**2 - INNER**2) * (1 + OUTER**2 / r**2)


def displacement_error(position, u):
    r = math.hypot(position[0], position[1])
    radial = (u[0] * position[0] + u[1] * position[1]) / r
    return abs(radial / displacement(r) - 1)


def hoop_error(position, xx, yy, xy):
    r = math.hypot(position[0], position[1])
    c, s = position[0] / r, position[1] / r
    return abs((xx * s * s + yy * c * c - 2 * xy * s * c) / hoop_stress(r) - 1)


def mean(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]


def nodes_of(path):
    nodes, in_nodes = {}, False
    for line in open(path):
        if line.startswith("*"):
            in_nodes = line.startswith("*NODE")
        elif in_nodes:
            number, *xyz = line.split(",")
            nodes[int(number)] = [float(x) for x in xyz]
    return nodes


def tables_of(path):
    """Rows of numbers of a .dat file by the first word of the title above them."""
    tables = {}
    for line in open(path):
        words = line.split()
        if words and words[0][0].isalpha():
            rows = tables.setdefault(words[0], [])
        elif words:
            rows.append([float(word) for word in words])
    return tables


def means_by_element(rows):
    points = {}
    for row in rows:
        points.setdefault(row[0], []).append(row[2:])
    return {element: mean(values) for element, values in points.items()}


def calculix_errors(folder):
    nodes = nodes_of(folder + "/wall.inp")
    tables = tables_of(folder + "/lame.dat")
    positions = means_by_element(tables["global"])  # coordinates of the integration points
    stresses = means_by_element(tables["stresses"])
    return (
        max(displacement_error(nodes[row[0]], row[1:]) for row in tables["displacements"]),
        max(hoop_error(positions[e], s[0], s[1], s[3]) for e, s in stresses.items()),
    )


def foam_field(path):
    text = open(path).read()
    start = re.search(r"internalField\s+nonuniform List<\w+>\s*(\d+)\s*\(\n", text)
    lines = text[start.end() :].split("\n", int(start[1]))[:-1]
    return [[float(word) for word in line.strip("()").split()] for line in lines]


def openfoam_errors(folder):
    cells, u, sigma = (foam_field(folder + "/" + name) for name in ("C", "D", "sigma"))
    shift = mean(u)  # the rigid motion that the boundary conditions leave open
    return (
        max(displacement_error(c, [a - b for a, b in zip(d, shift)]) for c, d in zip(cells, u)),
        max(hoop_error(c, s[0], s[3], s[1]) for c, s in zip(cells, sigma)),
    )


def order(errors, i):
    return "    " if i == 0 else f"{math.log2(errors[i - 1] / errors[i]):4.2f}"


def print_table(solver, runs, errors):
    u, hoop = zip(*errors)
    for i, (size, layers, _) in enumerate(runs):
        print(
            f"{solver:9} {size:>5} {layers:>6}   {100 * u[i]:6.3f} %  {order(u, i)}"
            f"   {100 * hoop[i]:6.3f} %  {order(hoop, i)}"
        )


def main():
    time, *runs = sys.argv[1:]
    runs = [run.split(":", 2) for run in runs]
    print("solver     size layers        u_r  order       hoop  order")
    calculix = [calculix_errors(folder) for _, _, folder in runs]
    print_table("CalculiX", runs, calculix)
    openfoam = [openfoam_errors(f"{folder}/openfoam/{time}") for _, _, folder in runs]
    print_table("OpenFOAM", runs, openfoam)
    if max(calculix[-1] + openfoam[-1]) > LIMIT:
        sys.exit(f"more than {100 * LIMIT:g} % off on the finest mesh")


main()
