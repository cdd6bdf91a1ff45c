"""The workflow for cohorts: on this machine, and on a Slurm cluster of one node where that starts."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from slurm_node import SlurmNode

SOURCE = Path(__file__).resolve().parents[2]
WORKFLOW = Path(os.environ.get("HEXWALL_COHORT", SOURCE / "tools/cohort"))
PROGRAM = Path(os.environ["HEXWALL_PROGRAM"])
sys.path.insert(0, str(WORKFLOW))
import cohort  # noqa: E402


def wait_until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.05)


class InFolder(unittest.TestCase):
    def setUp(self):
        # Not in /tmp's root alone: a name with a blank must do.
        folder = tempfile.TemporaryDirectory(prefix="a cohort ")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.output = self.folder / "out"

    def surface(self, name):
        path = self.folder / name
        subprocess.run(
            [PROGRAM, "generate", "cylinder", "--edge", "0.4", "-o", path],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        return path

    def command(self, surfaces, profile="local", **config):
        config = {
            "surfaces": surfaces,
            "output": self.output,
            "hexwall": PROGRAM,
            "options": "--size 0.6",
            **config,
        }
        return [
            "snakemake",
            "-s",
            str(WORKFLOW / "Snakefile"),
            "--profile",
            str(WORKFLOW / "profiles" / profile),
            "--config",
            *[f"{key}={value}" for key, value in config.items()],
        ]

    def run_workflow(self, surfaces, fails=False, **config):
        done = subprocess.run(
            self.command(surfaces, **config),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode != 0, fails, done.stdout)
        return done.stdout

    def rows(self):
        with open(self.output / "table.tsv", encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file, delimiter="\t"))

    def outcomes(self):
        return {row["case"]: row["outcome"] for row in self.rows()}


class Cases(InFolder):
    def test_of_a_folder_are_its_surfaces(self):
        for name in ("b.stl", "a.vtp", "a.STL", "c d.ply", "notes.txt"):
            (self.folder / name).touch()
        cases = cohort.read_cohort(self.folder, "--size 1")
        self.assertEqual([c.name for c in cases], ["a.STL", "a.vtp", "b", "c_d"])
        self.assertEqual({c.options for c in cases}, {"--size 1"})

    def test_of_a_table_are_its_rows(self):
        table = self.folder / "t.tsv"
        table.write_text("surface\tage\tcase\toptions\nx/a.stl\t60\t\t--layers 2\nb.stl\t\tp1\t\n")
        a, b = cohort.read_cohort(table, "--size 1")
        self.assertEqual(
            (a.name, a.options, a.columns), ("a", "--size 1 --layers 2", {"age": "60"})
        )
        self.assertEqual(a.surface, str(self.folder / "x/a.stl"))
        self.assertEqual((b.name, b.options), ("p1", "--size 1"))

    def test_own_options_replace_those_for_all(self):
        for general, own, result in (
            ("--size 1 --layers 2", "--size=2", "--size=2 --layers 2"),
            ("--write vtu", "--names 'a b.json'", "--write vtu --names 'a b.json'"),
            ("--view -1 -2 .5", "", "--view -1 -2 .5"),
        ):
            self.assertEqual(cohort.merged(general, own), result)
        with self.assertRaises(cohort.CohortError):
            cohort.merged("0.8")

    def test_that_cannot_be_told_apart_are_refused_all_at_once(self):
        table = self.folder / "t.tsv"
        table.write_text("case\tsurface\na/b\tx.stl\np\tx.stl\np\ty.stl\nq\t\n")
        with self.assertRaises(cohort.CohortError) as caught:
            cohort.read_cohort(table)
        for problem in ("line 2", "lines 3 and 4", "line 5"):
            self.assertIn(problem, str(caught.exception))
        for content in ("a,b\n1,2\n", "surface\n"):
            table.write_text(content)
            with self.assertRaises(cohort.CohortError):
                cohort.read_cohort(table)


class Local(InFolder):
    def table(self, *surfaces):
        table = self.folder / "cohort.tsv"
        table.write_text("surface\n" + "".join(f"{s}\n" for s in surfaces))
        return table

    def test_failures_are_rows_and_lose_nothing_else(self):
        self.surface("good.vtp")
        content = (self.folder / "good.vtp").read_bytes()
        (self.folder / "corrupt.vtp").write_bytes(content[: len(content) // 2])
        (self.folder / "coarse.stl").write_text("solid\nendsolid\n")
        table = self.table("good.vtp", "corrupt.vtp", "missing.stl", "coarse.stl")
        self.run_workflow(table)
        rows = {row["case"]: row for row in self.rows()}
        self.assertEqual(rows["good"]["outcome"], "meshed")
        self.assertGreater(float(rows["good"]["min_scaled_jacobian"]), 0.2)
        self.assertEqual(list(rows)[-1], "good", "the worst come first")
        for name in ("corrupt", "missing", "coarse"):
            self.assertEqual(rows[name]["outcome"], "unreadable")
            self.assertEqual(rows[name]["exit_code"], "3")
            self.assertIn(name, rows[name]["reason"])
        page = (self.output / "index.html").read_text()
        self.assertIn('src="cases/good/thumbnail.png"', page)
        self.assertTrue(
            (self.output / "cases/good/thumbnail.png").read_bytes().startswith(b"\x89PNG")
        )
        self.assertLess(page.index("corrupt"), page.index("<h2>good"))
        self.assertEqual(len(json.loads((self.output / "table.json").read_text())), 4)
        self.check_that_only_what_changed_runs_again(table)

    def check_that_only_what_changed_runs_again(self, table):
        status = self.output / "cases/good/status.json"
        made = status.stat().st_mtime_ns
        self.assertIn("Nothing to be done", self.run_workflow(table))
        self.surface("missing.stl")
        self.run_workflow(table)
        self.assertEqual(self.outcomes()["missing"], "meshed")
        self.assertEqual(status.stat().st_mtime_ns, made)

    # A hexwall that kills itself, or the job that runs it, as a machine short of memory would.
    def killer(self, kill):
        program = self.folder / "hexwall"
        program.write_text(
            f'#!/bin/sh\ncase "$2" in *doomed*) {kill};; esac\nexec "{PROGRAM}" "$@"\n'
        )
        program.chmod(0o755)
        shutil.copy(PROGRAM.with_name("hexwall-picture"), self.folder)
        return program

    def test_killed_programs_are_tried_again_then_told(self):
        self.surface("good.vtp")
        self.surface("doomed.vtp")
        log = self.folder / "tries"
        program = self.killer(f'echo x >> "{log}"; kill -9 $$')
        self.run_workflow(self.table("doomed.vtp", "good.vtp"), hexwall=program)
        self.assertEqual(self.outcomes(), {"doomed": "killed", "good": "meshed"})
        self.assertEqual(log.read_text(), "x\nx\n")
        self.assertIn(
            "Nothing to be done",
            self.run_workflow(self.table("doomed.vtp", "good.vtp"), hexwall=program, timeout=99),
        )
        self.assertIn("SIGKILL", self.rows()[0]["reason"])

    def test_killed_jobs_lose_nothing_else_and_are_resumed(self):
        self.surface("good.vtp")
        self.surface("doomed.vtp")
        table = self.table("doomed.vtp", "good.vtp")
        program = self.killer("kill -9 $PPID; sleep 0.2; exit 1")
        self.run_workflow(table, fails=True, hexwall=program)
        self.assertEqual(self.outcomes(), {"doomed": "no result", "good": "meshed"})
        made = (self.output / "cases/good/status.json").stat().st_mtime_ns
        self.killer("true")
        self.run_workflow(table, hexwall=program)
        self.assertEqual(self.outcomes(), {"doomed": "meshed", "good": "meshed"})
        self.assertEqual((self.output / "cases/good/status.json").stat().st_mtime_ns, made)

    def test_slow_cases_are_given_up(self):
        self.surface("good.vtp")
        self.surface("doomed.vtp")
        program = self.killer("exec sleep 60")
        self.run_workflow(self.table("doomed.vtp", "good.vtp"), hexwall=program, timeout=2)
        self.assertEqual(self.outcomes(), {"doomed": "timeout", "good": "meshed"})


class Slurm(InFolder):
    def test_runs_cases_as_jobs_and_survives_the_loss_of_one(self):
        slurm = tempfile.TemporaryDirectory(prefix="slurm_")  # whose paths may have no blanks
        self.addCleanup(slurm.cleanup)
        node = SlurmNode(slurm.name)
        problem = node.start()
        self.addCleanup(node.stop)
        if problem:
            self.skipTest(f"no Slurm here: {problem}")
        surfaces = self.folder / "surfaces"
        surfaces.mkdir()
        for name in ("a.vtp", "b.vtp"):
            shutil.move(self.surface(name), surfaces)
        (surfaces / "corrupt.vtp").write_text("<VTKFile")
        self.surface("slow.vtp").rename(surfaces / "slow.vtp")
        started = self.folder / "started"
        program = self.folder / "hexwall"
        program.write_text(
            f'#!/bin/sh\ncase "$2" in *slow*) if [ ! -e "{started}" ]; then'
            f' echo "$SLURM_JOB_ID" > "{started}"; sleep 300; fi;; esac\nexec "{PROGRAM}" "$@"\n'
        )
        program.chmod(0o755)
        shutil.copy(PROGRAM.with_name("hexwall-picture"), self.folder)
        # Snakemake's jobs sit on one processor each.
        with open(self.folder / "log", "w", encoding="utf-8") as log:
            workflow = subprocess.Popen(
                [*self.command(surfaces, "slurm", hexwall=program), "--latency-wait", "5"],
                stdout=log,
                stderr=subprocess.STDOUT,
                cwd=self.folder,
                env=node.environment(),
            )
        try:
            wait_until(lambda: started.is_file() and started.read_text().strip())
            node.run("scancel", "--signal=KILL", "--full", started.read_text().strip())
            self.assertEqual(workflow.wait(timeout=240), 0, (self.folder / "log").read_text())
        finally:
            if workflow.poll() is None:
                workflow.send_signal(signal.SIGINT)
                workflow.wait(timeout=60)
        self.assertEqual(
            self.outcomes(),
            {"a": "meshed", "b": "meshed", "corrupt": "unreadable", "slow": "meshed"},
        )
        self.assertTrue(list((self.output / "slurm_logs").glob("slow-*.log")))


if __name__ == "__main__":
    unittest.main()
