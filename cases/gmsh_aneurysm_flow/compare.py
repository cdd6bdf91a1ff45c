#!/usr/bin/env python3
"""Wall shear stress on the sac of an aneurysm, on meshes of several sizes, as a table, results.json
and a plot.

compare.py FOLDER: the runs are FOLDER/hybrid_SIZE and FOLDER/tet_SIZE.
"""

import os
import sys

import matplotlib
import numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import foam  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

SAC = 24e-3  # m: the wall at x beyond it is that of the sac and of nothing else
CLOSE = 0.05
SPOT = 2e-3  # m: edge of the cubes in which means of the wall are compared
TICKS = {"cells": (10000, 30000, 100000, 300000), "seconds": (10, 100, 1000)}


def measure(case):
    report = foam.report(case)
    wall, shear = foam.wall_shear(case)
    shear *= report["flow"]["fluid"]["density"]
    sac = wall.area * wall.share_beyond(0, SAC)
    return foam.run_of(case) | {
        "case": case,
        "volume": report["lumen"]["regions"][0]["volume"],
        "sac_area": float(sac.sum()),
        "sac": float(numpy.average(shear, weights=sac)),
        "elsewhere": float(numpy.average(shear, weights=wall.area - sac)),
        "imbalance": foam.imbalance(case),
    }


class Spots:
    """Means of the wall shear stress in small cubes of the wall, compared with those of a run."""

    def __init__(self, case):
        self.wall, shear = foam.wall_shear(case)
        cubes = numpy.floor(self.wall.centers / SPOT).astype(int)
        self.spot = numpy.unique(cubes, axis=0, return_inverse=True)[1].reshape(-1)
        sac = self.wall.area * self.wall.share_beyond(0, SAC)
        self.weights = {"sac": sac, "elsewhere": self.wall.area - sac}
        self.sums = {part: self.sums_of(shear, part) for part in self.weights}

    def sums_of(self, shear, part):
        return numpy.bincount(self.spot, self.weights[part] * shear)

    def differences(self, case):
        """Mean difference of the spots' means, relative to the mean, on the sac and elsewhere. Each
        face takes the stress of the nearest one of the other mesh."""
        wall, shear = foam.wall_shear(case)
        points = vtkPoints()
        points.SetDataTypeToDouble()
        for center in wall.centers:
            points.InsertNextPoint(center)
        cloud = vtkPolyData()
        cloud.SetPoints(points)
        locator = vtkStaticPointLocator()
        locator.SetDataSet(cloud)
        locator.BuildLocator()
        shear = shear[[locator.FindClosestPoint(center) for center in self.wall.centers]]
        return {
            f"spots_{part}": float(numpy.abs(self.sums_of(shear, part) - sums).sum() / sums.sum())
            for part, sums in self.sums.items()}


def at_no_size(runs, key):
    """Where a line through the last four runs over their sizes meets size 0."""
    last = runs[-4:]
    return numpy.polyfit([r["size"] for r in last], [r[key] for r in last], 1)[1]


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
    panels = (("sac", "cells", "mean wall shear stress on the sac, in Pa"),
              ("sac", "seconds", "mean wall shear stress on the sac, in Pa"),
              ("spots_sac", "cells", "difference from the finest hybrid, 2 mm spots"))
    for axis, (key, value, title) in zip(axes, panels):
        for name, runs in kinds.items():
            shown = [r for r in runs if r[key] > 0.0]
            axis.semilogx([r[value] for r in shown], [r[key] for r in shown], "o-", label=name)
        if key == "sac":
            axis.axhspan((1 - CLOSE) * limit, (1 + CLOSE) * limit, color="gray", alpha=0.2,
                         label=f"within {100 * CLOSE:.0f} %")
        else:
            axis.set_ylim(0.0, None)
            axis.yaxis.set_major_formatter(matplotlib.ticker.PercentFormatter(1.0))
        axis.set_xticks(TICKS[value], [f"{tick:,}".replace(",", " ") for tick in TICKS[value]])
        axis.minorticks_off()
        axis.set_xlabel("cells" if value == "cells" else "CPU seconds of the solver")
        axis.set_title(title, fontsize=10)
        axis.grid(True, alpha=0.3)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main(folder):
    kinds = foam.runs_of(folder, measure)
    finest = kinds["hybrid"][-1]
    spots = Spots(finest["case"])
    for run in (run for runs in kinds.values() for run in runs):
        run.update(spots.differences(run.pop("case")))
    foam.table(kinds, {
        "volume": lambda r: f"{r['volume']:.0f} mm³",
        "area of the sac": lambda r: f"{1e6 * r['sac_area']:.0f} mm²",
        "sac": lambda r: f"{r['sac']:.4f} Pa",
        "elsewhere": lambda r: f"{r['elsewhere']:.4f} Pa",
        "spots, sac": lambda r: f"{100 * r['spots_sac']:.1f} %",
        "spots, elsewhere": lambda r: f"{100 * r['spots_elsewhere']:.1f} %",
        "flow lost": lambda r: f"{r['imbalance']:.0e}",
    })
    hybrid, tet = finest["sac"], kinds["tet"][-1]["sac"]
    limit = 0.5 * (hybrid + tet)
    print(f"at the finest, tetrahedra differ by {100 * (tet / hybrid - 1):+.1f} % on the sac; "
          f"the mean of the two is {limit:.4f} Pa")
    close = {kind: within(runs, limit) for kind, runs in kinds.items()}
    for kind, run in close.items():
        print(f"{kind}: " + (f"within {100 * CLOSE:.0f} % from {run['cells']} cells and "
                             f"{run['seconds']:.0f} s on" if run else "never close"))
    for part in ("sac", "elsewhere"):
        print(f"{part}: the line through the last four tetrahedral meshes meets size 0 at "
              f"{100 * at_no_size(kinds['tet'], 'spots_' + part):+.1f} % of difference in spots")
    foam.write_results(folder, kinds | {"limit": limit, "close": close})
    plot(kinds, limit, os.path.join(folder, "convergence.png"))


main(sys.argv[1])
