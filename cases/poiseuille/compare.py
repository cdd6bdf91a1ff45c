#!/usr/bin/env python3
"""Developed flow in a straight tube: errors of wall shear stress and pressure drop of each run
against Poiseuille's solution, as a table, results.json and a plot.

compare.py FOLDER: the runs are FOLDER/hybrid_SIZE, FOLDER/stretched_SIZE and FOLDER/tet_SIZE.
"""

import os
import sys

import matplotlib
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import foam  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RADIUS = 1e-3  # m


def slope_of_pressure(case, time, length):
    """dp/dz over the middle half: line through the pressures of its cells, by volume."""
    z = foam.field(case, "0", "C")[:, 2]
    volume = foam.field(case, "0", "V")
    pressure = foam.field(case, time, "p")
    inside = (z > 0.25 * length) & (z < 0.75 * length)
    return abs(numpy.polyfit(z[inside], pressure[inside], 1, w=numpy.sqrt(volume[inside]))[0])


def measure(case):
    report = foam.report(case)
    flow = report["flow"]
    nu = flow["fluid"]["viscosity"] / flow["fluid"]["density"]
    wall, shear = foam.wall_shear(case)
    z = wall.centers[:, 2]
    length = z.max() + z.min()
    inside = (z > 0.25 * length) & (z < 0.75 * length)
    slope = slope_of_pressure(case, foam.last_time(case), length)

    def errors(radius):
        exact_shear = 4 * nu * flow["flow_rate"] / (numpy.pi * radius**3)
        exact_slope = 8 * nu * flow["flow_rate"] / (numpy.pi * radius**4)
        off = shear[inside] / exact_shear - 1
        return {
            "shear_rms": float(numpy.sqrt(numpy.average(off**2, weights=wall.area[inside]))),
            "shear_mean": float(numpy.average(off, weights=wall.area[inside])),
            "pressure_drop": float(slope / exact_slope - 1),
        }

    return foam.run_of(case) | {
        # What is meshed is a prism over a polygon: its circle of equal area is smaller.
        "area": flow["inlet"]["area"] / (numpy.pi * RADIUS**2) - 1,
        "tube": errors(RADIUS),
        "meshed": errors(flow["inlet"]["diameter"] / 2),
    }


def at_error(runs, value, kind):
    """`value` (cells or seconds) at which a kind of mesh has an error of wall shear stress: between
    runs on a straight line in log-log."""
    runs = sorted(runs, key=lambda r: r[kind]["shear_rms"])
    x = numpy.log([r[kind]["shear_rms"] for r in runs])
    y = numpy.log([r[value] for r in runs])
    return lambda error: float(numpy.exp(numpy.interp(numpy.log(error), x, y)))


def advantage(hybrid, tet, kind):
    """How many times more cells and seconds tetrahedra take, at the errors of their runs that the
    hybrid meshes reach between their coarsest and their finest."""
    rows = []
    worst, best = (limit(r[kind]["shear_rms"] for r in hybrid) for limit in (max, min))
    for error in (r[kind]["shear_rms"] for r in tet):
        if best <= error <= worst:
            rows.append({"error": error} | {
                value: at_error(tet, value, kind)(error) / at_error(hybrid, value, kind)(error)
                for value in ("cells", "seconds")})
    return rows


def plot(kinds, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.3), sharey=True)
    for axis, value, label in zip(axes, ("cells", "seconds"), ("cells", "CPU seconds of the solver")):
        for (name, runs), color in zip(kinds.items(), ("tab:blue", "tab:green", "tab:red")):
            x = [r[value] for r in runs]
            axis.loglog(x, [100 * r["tube"]["shear_rms"] for r in runs], "o-", color=color,
                        label=f"{name}: wall shear stress, rms")
            axis.loglog(x, [100 * abs(r["tube"]["pressure_drop"]) for r in runs], "s--", color=color,
                        label=f"{name}: pressure drop")
        axis.set_xlabel(label)
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("error in %")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=3, fontsize=8)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(path, dpi=90)


def main(folder):
    kinds = foam.runs_of(folder, measure, ("hybrid", "stretched", "tet"))
    columns = {"area": lambda r: f"{100 * r['area']:+.1f} %"}
    for kind, where in (("tube", "of the tube"), ("meshed", "of the meshed tube")):
        columns |= {
            f"{where}: shear, rms": lambda r, k=kind: f"{100 * r[k]['shear_rms']:.2f} %",
            f"{where}: mean": lambda r, k=kind: f"{100 * r[k]['shear_mean']:+.2f} %",
            f"{where}: pressure drop": lambda r, k=kind: f"{100 * r[k]['pressure_drop']:+.2f} %"}
    foam.table(kinds, columns)
    # Of wall shear stress: errors of the pressure drop pass through zero.
    gains = {name: advantage(kinds[name], kinds["tet"], "tube") for name in ("hybrid", "stretched")}
    for name, rows in gains.items():
        for g in rows:
            print(f"shear {100 * g['error']:.1f} % off: tetrahedra take {g['cells']:.1f} times the cells "
                  f"of {name}, {g['seconds']:.1f} times the solver's time")
    foam.write_results(folder, kinds | {"advantage": gains})
    plot(kinds, os.path.join(folder, "errors.png"))


main(sys.argv[1])
