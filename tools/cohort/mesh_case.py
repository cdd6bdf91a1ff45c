"""Meshes one case of a cohort, takes its picture and says in status.json how it went.

Whatever hexwall says of a surface is a result: the exit code is 0 then. It is 1 only where another
attempt may help, as hexwall was killed, and this is not the last one.
"""

import argparse
import json
import os
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from cohort import merged, write_whole

OUTCOMES = {
    0: "meshed",
    1: "internal error",
    2: "usage",
    3: "unreadable",
    4: "topology",
    5: "geometry",
    6: "no mesh",
    7: "not written",
}
PICTURE_SECONDS = 120


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("surface")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--hexwall", default="hexwall")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=0.0, help="seconds; 0: none")
    parser.add_argument("--last-attempt", type=int, default=1)
    parser.add_argument("options", nargs="*", help="of hexwall mesh, after --")
    return parser.parse_args()


def run_mesh(arguments):
    """Runs hexwall. Returns its exit code (None: it took too long) and what it said."""
    command = [arguments.hexwall, "mesh", arguments.surface, "-o", str(arguments.folder)]
    command += shlex.split(merged(f"--threads {arguments.threads}", shlex.join(arguments.options)))
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=arguments.timeout or None,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None, ""
    (arguments.folder / "hexwall.log").write_text(done.stdout + done.stderr, encoding="utf-8")
    return done.returncode, done.stderr


def describe(code, stderr, limit):
    """The outcome in a word, and the reason in a sentence."""
    if code is None:
        return "timeout", f"took longer than {limit:g} s"
    if code < 0:
        return "killed", f"hexwall was killed by {signal.Signals(-code).name}"
    errors = [line for line in stderr.splitlines() if line.startswith("hexwall: error: ")]
    reason = errors[-1].removeprefix("hexwall: error: ") if errors else stderr.strip()
    return OUTCOMES.get(code, f"exit code {code}"), "" if code == 0 else reason


def take_picture(folder, hexwall):
    """A picture of the quads, or why there is none. Never fails: a mesh is worth more than that."""
    picture = shutil.which(
        "hexwall-picture", path=f"{os.path.dirname(hexwall)}:{os.environ['PATH']}"
    )
    if not picture:
        return "there is no hexwall-picture"
    command = [picture, str(folder / "quads.vtp"), "-o", str(folder / "thumbnail.png"), "--edges"]
    command += ["--array", "scaled_jacobian", "--range", "0,1", "--size", "480x360"]
    if "DISPLAY" not in os.environ:
        command = ["xvfb-run", "-a", *command]
    problem = ""
    for _ in range(3):  # two of xvfb-run at a time may take the same display
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=PICTURE_SECONDS, check=False
            )
            if done.returncode == 0:
                return ""
            problem = done.stderr.strip()
        except (OSError, subprocess.TimeoutExpired) as error:
            problem = str(error)
    return problem


def main():
    arguments = parse_arguments()
    folder = arguments.folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start = time.monotonic()
    code, stderr = run_mesh(arguments)
    status = {"seconds": round(time.monotonic() - start, 3)}
    status["outcome"], status["reason"] = describe(code, stderr, arguments.timeout)
    status["exit_code"] = code
    status["peak_memory_mb"] = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024
    if status["outcome"] == "killed" and not arguments.last_attempt:
        print(f"{status['reason']}: it will be tried again", file=sys.stderr)
        return 1
    if code == 0:
        status["picture_problem"] = take_picture(folder, arguments.hexwall)
    write_whole(folder / "status.json", json.dumps(status, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
