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
    """Centres and area vectors of the faces of a patch."""

    def __init__(self, case, name):
        mesh = os.path.join(case, "constant/polyMesh")
        entry = text_of(mesh, "boundary").split("\n    " + name + "\n", 1)[1]
        count = int(re.search(r"nFaces\s+(\d+)", entry)[1])
        start = int(re.search(r"startFace\s+(\d+)", entry)[1])
        points = _list(text_of(mesh, "points"), 3)
        faces = re.findall(r"\d\(([\d ]+)\)", text_of(mesh, "faces"))[start : start + count]
        self.centers = numpy.zeros((count, 3))
        self.areas = numpy.zeros((count, 3))
        for i, corners in enumerate(faces):
            p = points[[int(c) for c in corners.split()]]
            q = numpy.roll(p, -1, axis=0)
            middle = p.mean(axis=0)
            triangles = 0.5 * numpy.cross(p - middle, q - middle)
            weight = numpy.linalg.norm(triangles, axis=1)
            self.areas[i] = triangles.sum(axis=0)
            self.centers[i] = (weight[:, None] * (p + q + middle) / 3).sum(axis=0) / weight.sum()


def report(case):
    return json.loads(text_of(case, "report.json"))


def log_of(case):
    return text_of(glob.glob(os.path.join(case, "log.simpleFoam"))[0])


def seconds(case):
    """CPU time of the solver."""
    return float(re.findall(r"ExecutionTime = ([\d.]+)", log_of(case))[-1])


def iterations(case):
    return int(re.search(r"converged in (\d+) iterations", log_of(case))[1])
