"""Collects the results of a cohort: table.tsv, table.json and index.html, the worst case first.

  collect.py OUTPUT
"""

import csv
import html
import io
import json
import sys
from pathlib import Path

from cohort import write_whole

# Columns and where they are in report.json. README.md says what they mean.
FIGURES = {
    "input_vertices": "input.vertices",
    "input_faces": "input.faces",
    "openings": "input.loops",
    "repairs": "preparation.repairs",
    "moved": "preparation.distance_moved",
    "poles": "poles",
    "quads": "quads.count",
    "quad_min_scaled_jacobian": "quads.min_scaled_jacobian",
    "angle_stddev_deg": "quads.angle_stddev_deg",
    "off_size_area_fraction": "quads.off_size_area_fraction",
    "hexes": "wall.hexes",
    "min_scaled_jacobian": "wall.min_scaled_jacobian",
    "reduced_area_fraction": "reduced",
    "warnings": "warnings",
}


def lookup(report, path):
    """A number of the report: lists count as their length."""
    if path == "reduced":  # of the side with the greater share
        sides = [report["wall"].get(side) for side in ("outward", "inward")]
        return max((side["reduced_area_fraction"] for side in sides if side), default=None)
    value = report
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) else None
    return len(value) if isinstance(value, list) else value


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def row_of(output, case):
    """All that is known of a case."""
    folder = output / "cases" / case["name"]
    status = read_json(folder / "status.json")
    row = {"case": case["name"], "outcome": "no result", "reason": ""}
    if status is None:
        row["reason"] = "the job was killed or has not run: start the workflow again to resume"
        status = {}
    row.update({key: status[key] for key in ("outcome", "reason", "exit_code") if key in status})
    row["seconds"] = status.get("seconds")
    row["peak_memory_mb"] = status.get("peak_memory_mb")
    report = read_json(folder / "report.json") if row["outcome"] == "meshed" else None
    for column, path in FIGURES.items():
        row[column] = lookup(report, path) if report else None
    row["first_warning"] = report["warnings"][0] if report and report["warnings"] else ""
    row["surface"] = case["surface"]
    row["options"] = case["options"]
    row.update(case["columns"])
    return row


def badness(row):
    """Failures first, then the meshes with the worst hex."""
    if row["outcome"] != "meshed":
        return (0, 0.0, row["case"])
    return (1, row["min_scaled_jacobian"], row["case"])


def columns_of(rows):
    columns = {}
    for row in rows:
        columns.update(dict.fromkeys(row))
    columns.setdefault("exit_code")
    return list(columns)


def tsv(rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, columns_of(rows), delimiter="\t", lineterminator="\n", restval="")
    writer.writeheader()
    for row in rows:
        writer.writerow(
            {
                k: v.replace("\n", " ").replace("\t", " ") if isinstance(v, str) else v
                for k, v in row.items()
            }
        )
    return text.getvalue()


STYLE = """
body { font: 14px sans-serif; margin: 1.5em; color: #222; background: #fff; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 12px; }
article { border: 1px solid #ccc; border-radius: 4px; padding: 8px; overflow-wrap: anywhere; }
article.failed { border-color: #c22; background: #fff5f5; }
article.warned { border-color: #c90; }
h2 { font-size: 1em; margin: 0 0 6px; }
img { width: 100%; aspect-ratio: 4/3; object-fit: contain; background: #f4f4f4; }
dl { display: grid; grid-template-columns: auto 1fr; gap: 2px 8px; margin: 6px 0 0; }
dt { color: #666; } dd { margin: 0; }
p { margin: 6px 0 0; }
"""

SHOWN = {
    "least scaled Jacobian": "min_scaled_jacobian",
    "hexes": "hexes",
    "quads": "quads",
    "poles": "poles",
    "area with reduced thickness": "reduced_area_fraction",
    "seconds": "seconds",
}


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def article(output, row):
    folder = f"cases/{row['case']}"
    failed = row["outcome"] != "meshed"
    kind = "failed" if failed else "warned" if row["warnings"] else "fine"
    parts = [f'<article class="{kind}"><h2>{html.escape(row["case"])}</h2>']
    if (output / folder / "thumbnail.png").is_file() and not failed:
        parts.append(
            f'<a href="{folder}/"><img loading="lazy" src="{folder}/thumbnail.png" alt="quads"></a>'
        )
    if failed:
        parts.append(f"<p><b>{html.escape(row['outcome'])}</b>: {html.escape(row['reason'])}</p>")
    else:
        rows = [f"<dt>{label}</dt><dd>{shown(row[key])}</dd>" for label, key in SHOWN.items()]
        parts.append(f"<dl>{''.join(rows)}</dl>")
    if row["first_warning"]:
        more = f" (and {row['warnings'] - 1} more)" if row["warnings"] > 1 else ""
        parts.append(f"<p>Warning: {html.escape(row['first_warning'])}{more}</p>")
    if row["options"]:
        parts.append(f"<p><code>{html.escape(row['options'])}</code></p>")
    return "".join(parts) + "</article>"


def page(output, rows):
    meshed = sum(row["outcome"] == "meshed" for row in rows)
    warned = sum(bool(row["warnings"]) for row in rows)
    articles = "\n".join(article(output, row) for row in rows)
    return f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>hexwall: {len(rows)} cases</title>
<style>{STYLE}</style></head><body>
<h1>{len(rows)} cases: {meshed} meshed, {len(rows) - meshed} not; {warned} with warnings</h1>
<p>Failures first, then by the least scaled Jacobian of a hex. Colours: scaled Jacobian of the quads,
0 to 1. All figures: <a href="table.tsv">table.tsv</a>, <a href="table.json">table.json</a>.</p>
<main>
{articles}
</main></body></html>
"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    output = Path(sys.argv[1])
    cases = read_json(output / "cases.json")
    if cases is None:
        sys.exit(f"there is no cohort in {output}")
    rows = sorted((row_of(output, case) for case in cases), key=badness)
    write_whole(output / "table.tsv", tsv(rows))
    write_whole(output / "table.json", json.dumps(rows, indent=1) + "\n")
    write_whole(output / "index.html", page(output, rows))


if __name__ == "__main__":
    main()
