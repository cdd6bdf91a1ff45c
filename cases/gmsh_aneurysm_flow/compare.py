#!/usr/bin/env python3
"""Wall shear stress on the sac of an aneurysm, on meshes of several sizes, as a table, results.json
and a plot.

compare.py FOLDER: the runs are FOLDER/hybrid_SIZE and FOLDER/tet_SIZE.
"""

import glob
import json
import os
import sys

import matplotlib
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import foam  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SAC = 24e-3  # m: the wall at x beyond it is that of the sac and of nothing else


def measure(case):
    report = foam.report(case)
    density = report["flow"]["fluid"]["density"]
    wall = foam.Patch(case, "wall")
    area = numpy.linalg.norm(wall.areas, axis=1)
    shear = density * numpy.linalg.norm(
        foam.field(case, foam.last_time(case), "wallShearStress", "wall"), axis=1)
    sac = wall.centers[:, 0] > SAC
    return {
        "name": os.path.basename(case),
        "size": float(case.rsplit("_", 1)[1]),
        "cells": report["lumen"]["cells"],
        "seconds": foam.seconds(case),
        "iterations": foam.iterations(case),
        "sac_area": float(area[sac].sum()),
        "sac": float(numpy.average(shear[sac], weights=area[sac])),
        "elsewhere": float(numpy.average(shear[~sac], weights=area[~sac])),
    }


def plot(kinds, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    for axis, key in zip(axes, ("sac", "elsewhere")):
        for name, runs in kinds.items():
            axis.semilogx([r["cells"] for r in runs], [r[key] for r in runs], "o-", label=name)
        axis.set_xlabel("cells")
        axis.set_title(f"mean wall shear stress, {key}, in Pa", fontsize=10)
        axis.grid(True, which="both", alpha=0.3)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main(folder):
    kinds = {}
    for name in ("hybrid", "tet"):
        runs = [measure(case) for case in glob.glob(os.path.join(folder, name + "_*"))]
        kinds[name] = sorted(runs, key=lambda r: -r["size"])
    print("| mesh | cells | iterations | solver | sac | elsewhere |")
    print("|---" * 6 + "|")
    for runs in kinds.values():
        for r in runs:
            print(f"| {r['name'].replace('_', ' ')} | {r['cells']} | {r['iterations']} "
                  f"| {r['seconds']:.0f} s | {r['sac']:.4f} Pa | {r['elsewhere']:.4f} Pa |")
    finest = {name: runs[-1]["sac"] for name, runs in kinds.items()}
    print(f"at the finest, tetrahedra differ by {100 * (finest['tet'] / finest['hybrid'] - 1):+.1f} % "
          "on the sac")
    with open(os.path.join(folder, "results.json"), "w", encoding="utf-8") as file:
        json.dump(kinds, file, indent=1)
    plot(kinds, os.path.join(folder, "convergence.png"))


main(sys.argv[1])
