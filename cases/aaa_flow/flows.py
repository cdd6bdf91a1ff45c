#!/usr/bin/env python3
"""What flows through each opening at the end of a run, as a table and flows.json; ends with exit
code 1 if what flows in does not come out again.

flows.py CASE
"""

import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import foam  # noqa: E402

MOST_LOST = 1e-6  # of the inflow


def main(case):
    flow = foam.report(case)["flow"]
    out = foam.flows(case)
    inflow = -out[flow["inlet"]["patch"]]
    print("| outlet | share asked | share that flows | Pa above the outlet at zero |")
    print("|---|---|---|---|")
    for outlet in flow["outlets"]:
        name = outlet["patch"]
        pressure = flow["fluid"]["density"] * foam.last_value(case, "pressure_" + name)
        print(f"| {name} | {100 * outlet['share']:.2f} % | {100 * out[name] / inflow:.2f} % "
              f"| {pressure:.2f} |")
    lost = foam.imbalance(case)
    print(f"in {1e6 * inflow:.6f} mL/s, out {1e6 * (sum(out.values()) + inflow):.6f} mL/s: "
          f"{lost:.1e} of the flow is lost; {foam.iterations(case)} iterations, "
          f"{foam.seconds(case):.0f} s")
    with open(os.path.join(case, "flows.json"), "w", encoding="utf-8") as file:
        json.dump({"out": out, "lost": lost}, file, indent=1)
    return 0 if lost < MOST_LOST else 1


sys.exit(main(sys.argv[1]))
