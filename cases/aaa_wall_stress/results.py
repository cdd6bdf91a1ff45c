"""CalculiX' results, and what follows from them at a point."""

import math

DIGITS = 12  # of a number in an .frd file


def read_frd(path):
    """{"DISP": {node: [x, y, z]}, "STRESS": {node: [xx, yy, zz, xy, yz, zx]}}"""
    tables, rows = {}, None
    for line in open(path):
        start = line[:3]
        if start == " -4":
            rows = tables.setdefault(line.split()[1], {})
        elif start == " -3":
            rows = None
        elif start == " -1" and rows is not None:
            ends = range(13, len(line) - DIGITS, DIGITS)
            rows[int(line[3:13])] = [float(line[i : i + DIGITS]) for i in ends]
    return tables


def mean(rows):
    return [sum(column) / len(rows) for column in zip(*rows)]


def element_means(path):
    """xx, yy, zz, xy, yz, zx of each element in a .dat file: the mean of its integration points."""
    points = {}
    for line in open(path):
        words = line.split()
        if len(words) == 8 and words[0].isdigit():
            xx, yy, zz, xy, xz, yz = map(float, words[2:])
            points.setdefault(int(words[0]), []).append([xx, yy, zz, xy, yz, xz])
    return {element: mean(rows) for element, rows in points.items()}


def von_mises(stress):
    xx, yy, zz, xy, yz, zx = stress
    normal = ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2
    return math.sqrt(normal + 3 * (xy * xy + yz * yz + zx * zx))


def max_principal(stress):
    """By the angle of Lode."""
    xx, yy, zz, xy, yz, zx = stress
    pressure, q = (xx + yy + zz) / 3, von_mises(stress)
    if q == 0:
        return pressure
    a, b, c = xx - pressure, yy - pressure, zz - pressure
    j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx)
    angle = math.acos(max(-1.0, min(1.0, 13.5 * j3 / q**3))) / 3
    return pressure + 2 / 3 * q * math.cos(angle)


def quantile(values, fraction):
    return sorted(values)[min(len(values) - 1, int(fraction * len(values)))]
