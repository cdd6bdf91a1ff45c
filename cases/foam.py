"""Reads OpenFOAM's text files, for the cases of flow: numpy and nothing else."""

import glob
import json
import os
import re

import numpy


def last_time(case):
    times = [name for name in os.listdir(case) if re.fullmatch(r"[0-9.]+", name)]
    return max(times, key=float)


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def _list(text, width):
    """The list of numbers, or of vectors of `width` numbers, that begins at the text's first '('."""
    body = text[text.index("(") + 1:]
    if width > 1:
        body = body[: re.search(r"\)\s*\)", body).start()]
        body = body.replace("(", " ").replace(")", " ")
        return numpy.array(body.split(), float).reshape(-1, width)
    return numpy.array(body[: body.index(")")].split(), float)


def field(case, time, name, patch=None):
    """Values in the cells, or on the faces of a patch, of a field with a value in each."""
    text = text_of(case, time, name)
    width = 3 if "volVectorField" in text[:1000] else 1
    if patch is None:
        return _list(text[text.index("internalField"):], width)
    boundary = text[text.index("boundaryField"):]
    entry = boundary[re.search(r"\n\s+" + re.escape(patch) + r"\s", boundary).end():]
    return _list(entry[entry.index("nonuniform"):], width)


class Patch:
    """Centres, area vectors and areas of the faces of a patch."""

    def __init__(self, case, name):
        mesh = os.path.join(case, "constant/polyMesh")
        entry = text_of(mesh, "boundary").split("\n    " + name + "\n", 1)[1]
        count = int(re.search(r"nFaces\s+(\d+)", entry)[1])
        start = int(re.search(r"startFace\s+(\d+)", entry)[1])
        points = _list(text_of(mesh, "points"), 3)
        faces = re.findall(r"\d\(([\d ]+)\)", text_of(mesh, "faces"))[start : start + count]
        self.corners = [points[[int(c) for c in corners.split()]] for corners in faces]
        self.centers = numpy.zeros((count, 3))
        self.areas = numpy.zeros((count, 3))
        for i, p in enumerate(self.corners):
            q = numpy.roll(p, -1, axis=0)
            middle = p.mean(axis=0)
            triangles = 0.5 * numpy.cross(p - middle, q - middle)
            weight = numpy.linalg.norm(triangles, axis=1)
            self.areas[i] = triangles.sum(axis=0)
            self.centers[i] = (weight[:, None] * (p + q + middle) / 3).sum(axis=0) / weight.sum()
        self.area = numpy.linalg.norm(self.areas, axis=1)

    def share_beyond(self, axis, limit):
        """Share of each face's area whose coordinate is above a limit: faces are cut by the plane."""
        share = numpy.zeros(len(self.corners))
        for i, p in enumerate(self.corners):
            above = p[:, axis] - limit
            if above.min() >= 0.0:
                share[i] = 1.0
            elif above.max() > 0.0:
                share[i] = min(1.0, _area_above(p, above) / self.area[i])
        return share


def _area_above(corners, above):
    """Area of the part of a polygon where a linear function, with the values `above` at its corners,
    is positive."""
    kept = []
    for p, q, u, v in zip(corners, numpy.roll(corners, -1, axis=0), above, numpy.roll(above, -1)):
        if u > 0.0:
            kept.append(p)
        if (u > 0.0) != (v > 0.0):
            kept.append(p + (q - p) * u / (u - v))
    spokes = numpy.array(kept) - kept[0]
    return 0.5 * numpy.linalg.norm(numpy.cross(spokes[:-1], spokes[1:]).sum(axis=0))


def report(case):
    return json.loads(text_of(case, "report.json"))


def log_of(case):
    return text_of(glob.glob(os.path.join(case, "log.simpleFoam"))[0])


def last_value(case, name):
    """What a function object of the solver has written last."""
    path = sorted(glob.glob(os.path.join(case, "postProcessing", name, "*", "*.dat")))[-1]
    return float(text_of(path).split()[-1])


def flows(case):
    """Flow out of each opening in m³/s at the end, by name; into the inlet it is negative."""
    flow = report(case)["flow"]
    names = [flow["inlet"]["patch"]] + [outlet["patch"] for outlet in flow["outlets"]]
    return {name: last_value(case, "flowRate_" + name) for name in names}


def imbalance(case):
    """What of the inflow does not come out again, as a share of it."""
    values = list(flows(case).values())
    return abs(sum(values) / values[0])


def seconds(case):
    """CPU time of the solver."""
    return float(re.findall(r"ExecutionTime = ([\d.]+)", log_of(case))[-1])


def wall_shear(case):
    """The wall, and the wall shear stress on each of its faces over the density, in m²/s²."""
    return Patch(case, "wall"), numpy.linalg.norm(
        field(case, last_time(case), "wallShearStress", "wall"), axis=1)


def run_of(case):
    """What is said of every run: the case's folder is named KIND_SIZE."""
    return {
        "name": os.path.basename(case),
        "size": float(case.rsplit("_", 1)[1]),
        "cells": report(case)["lumen"]["cells"],
        "seconds": seconds(case),
        "iterations": iterations(case),
    }


def runs_of(folder, measure, kinds=("hybrid", "tet")):
    """What `measure` says of the runs FOLDER/KIND_SIZE, from coarse to fine."""
    return {
        kind: sorted(
            (measure(case) for case in glob.glob(os.path.join(folder, kind + "_*"))),
            key=lambda run: -run["size"])
        for kind in kinds}


def table(runs, columns):
    """A table in Markdown: of all runs, name, cells, iterations and seconds, and `columns`, from a
    heading to a function that has its text from a run."""
    print("| mesh | cells | iterations | solver | " + " | ".join(columns) + " |")
    print("|---" * (4 + len(columns)) + "|")
    for run in (run for kind in runs.values() for run in kind):
        cells = [run["name"].replace("_", " "), str(run["cells"]), str(run["iterations"]),
                 f"{run['seconds']:.1f} s"]
        print("| " + " | ".join(cells + [text(run) for text in columns.values()]) + " |")


def write_results(folder, results):
    with open(os.path.join(folder, "results.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)


def iterations(case):
    return int(re.search(r"converged in (\d+) iterations", log_of(case))[1])
