#!/usr/bin/env python3
"""Does what the tutorial says: runs its commands in a folder and compares what they print.

    follow.py [EMPTY_FOLDER]

Commands are the blocks ```sh of README.md; of what they print, the lines of a block ```text behind
them have to be there, in that order.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

README = Path(__file__).with_name("README.md")
BLOCK = re.compile(r"^```(sh|text)\n(.*?)^```$", re.S | re.M)


def run(commands, folder):
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", commands],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    print(f"{commands}{done.stdout}")
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode} of:\n{commands}")
    return done.stdout


def compare(expected, printed):
    lines = iter(printed.splitlines())
    for line in expected.splitlines():
        if line not in lines:
            sys.exit(
                f"the tutorial says that this is printed, but it is not, or not there:\n{line}"
            )


def follow(folder):
    blocks = BLOCK.findall(README.read_text(encoding="utf-8"))
    if not blocks:
        sys.exit(f"{README} has no commands")
    printed = ""
    for kind, text in blocks:
        if kind == "sh":
            printed = run(text, folder)
        else:
            compare(text, printed)


def main():
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    if len(sys.argv) == 1:
        with tempfile.TemporaryDirectory() as folder:
            return follow(folder)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    if any(folder.iterdir()):
        sys.exit(f"{folder} is not empty")
    return follow(folder)


if __name__ == "__main__":
    main()
