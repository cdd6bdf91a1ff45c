#!/usr/bin/env python3
"""Wall shear stress on the sac of an aneurysm, on meshes of several sizes, as a table, results.json
and a plot.

compare.py FOLDER: the runs are FOLDER/hybrid_SIZE and FOLDER/tet_SIZE.
"""

import os
import sys

import matplotlib
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import foam  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SAC = 24e-3  # m: the wall at x beyond it is that of the sac and of nothing else
CLOSE = 0.05
TICKS = {"cells": (10000, 30000, 100000, 300000), "seconds": (10, 100, 1000)}


def measure(case):
    report = foam.report(case)
    wall, shear = foam.wall_shear(case)
    shear *= report["flow"]["fluid"]["density"]
    sac = wall.area * wall.share_beyond(0, SAC)
    return foam.run_of(case) | {
        "volume": report["lumen"]["regions"][0]["volume"],
        "sac_area": float(sac.sum()),
        "sac": float(numpy.average(shear, weights=sac)),
        "elsewhere": float(numpy.average(shear, weights=wall.area - sac)),
        "imbalance": foam.imbalance(case),
    }


def within(runs, limit):
    """The coarsest run from which on all finer ones are close to the limit on the sac."""
    found = None
    for run in reversed(runs):
        if abs(run["sac"] / limit - 1.0) > CLOSE:
            break
        found = run
    return found


def plot(kinds, limit, path):
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.4))
    for axis, key, value, label in zip(axes, ("sac", "sac", "elsewhere"), ("cells", "seconds", "cells"),
                                       ("cells", "CPU seconds of the solver", "cells")):
        for name, runs in kinds.items():
            axis.semilogx([r[value] for r in runs], [r[key] for r in runs], "o-", label=name)
        if key == "sac":
            axis.axhspan((1 - CLOSE) * limit, (1 + CLOSE) * limit, color="gray", alpha=0.2,
                         label=f"within {100 * CLOSE:.0f} %")
        axis.set_xticks(TICKS[value], [f"{tick:,}".replace(",", " ") for tick in TICKS[value]])
        axis.minorticks_off()
        axis.set_xlabel(label)
        axis.set_title(f"mean wall shear stress, {key}, in Pa", fontsize=10)
        axis.grid(True, alpha=0.3)
        axis.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main(folder):
    kinds = foam.runs_of(folder, measure)
    foam.table(kinds, {
        "volume": lambda r: f"{r['volume']:.0f} mm³",
        "area of the sac": lambda r: f"{1e6 * r['sac_area']:.0f} mm²",
        "sac": lambda r: f"{r['sac']:.4f} Pa",
        "elsewhere": lambda r: f"{r['elsewhere']:.4f} Pa",
        "flow lost": lambda r: f"{r['imbalance']:.0e}",
    })
    hybrid, tet = (kinds[kind][-1]["sac"] for kind in ("hybrid", "tet"))
    limit = 0.5 * (hybrid + tet)
    print(f"at the finest, tetrahedra differ by {100 * (tet / hybrid - 1):+.1f} % on the sac; "
          f"the mean of the two is {limit:.4f} Pa")
    close = {kind: within(runs, limit) for kind, runs in kinds.items()}
    for kind, run in close.items():
        print(f"{kind}: " + (f"within {100 * CLOSE:.0f} % from {run['cells']} cells and "
                             f"{run['seconds']:.0f} s on" if run else "never close"))
    foam.write_results(folder, kinds | {"limit": limit, "close": close})
    plot(kinds, limit, os.path.join(folder, "convergence.png"))


main(sys.argv[1])
