#!/usr/bin/env python3
"""Brings the parts of the documentation that the program makes itself up to date.

    tools/reference.py [--check] [PROGRAM]

Between the lines `<!-- hexwall reference WHAT -->` and `<!-- end -->` of tools/README.md stands what
`PROGRAM reference WHAT` prints. With --check nothing is written; the exit code is 1 if that differs.
Formats without a row in exporters/README.md are an error either way: those rows say more.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "tools/README.md"
EXPORTERS = ROOT / "exporters/README.md"
BLOCK = re.compile(r"(<!-- hexwall reference (\S+) -->\n).*?(<!-- end -->\n)", re.S)


def reference(program, what):
    command = [program, "reference", what]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def made_anew(text, program):
    return BLOCK.sub(lambda m: f"{m[1]}{reference(program, m[2])}\n{m[3]}", text)


def formats_without_row(program):
    rows = EXPORTERS.read_text(encoding="utf-8")
    formats = re.findall(r"^\| `(\w+)` \| `(.*)` \|$", reference(program, "formats"), re.M)
    assert formats
    return [name for name, output in formats if f"| `{name}` | `{output}" not in rows]


def main():
    arguments = sys.argv[1:]
    check = "--check" in arguments
    rest = [a for a in arguments if a != "--check"]
    program = rest[0] if rest else str(ROOT / "build/hexwall")
    if missing := formats_without_row(program):
        sys.exit(f"{EXPORTERS} has no row for: {', '.join(missing)}")
    text = PAGE.read_text(encoding="utf-8")
    made = made_anew(text, program)
    if check and made != text:
        sys.exit(f"{PAGE} is not what the program says: run tools/reference.py")
    if made != text:
        PAGE.write_text(made, encoding="utf-8")


if __name__ == "__main__":
    main()
