"""The Python package: the same meshes, options, reports and failures as the program."""

import filecmp
import importlib.util
import inspect
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import hexwall
import numpy as np

SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["HEXWALL_PROGRAM"]
SURFACE = hexwall.generate("bifurcation", edge=0.3)
OPTIONS = {"size": 0.4, "layers": 2}


def mesh(surface=SURFACE, **options):
    return hexwall.mesh(surface, **{**OPTIONS, **options})


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=True, **options
    )


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Results(InFolder):
    def test_arrays_make_up_a_mesh(self):
        r = mesh(layers=None, side="both", layer_spec="a:0.4:1,b:0.6:2")
        hexes = len(r.hexes)
        self.assertEqual(r.points.shape[1], 3)
        self.assertEqual(r.hexes.shape, (hexes, 8))
        self.assertEqual(set(np.unique(r.hexes)), set(range(len(r.points))))
        for name, values in r.cell_data.items():
            self.assertEqual(len(values), hexes, name)
        for name, values in r.point_data.items():
            self.assertEqual(len(values), len(r.points), name)
        p = r.points[r.hexes]
        volumes = np.linalg.det(
            np.stack([p[:, 1] - p[:, 0], p[:, 3] - p[:, 0], p[:, 4] - p[:, 0]], axis=1)
        )
        self.assertGreater(volumes.min(), 0.0)
        self.assertEqual(r.region_names, ["lumen", "wall"])
        self.assertEqual(r.zone_names[-2:], ["a", "b"])
        self.assertEqual(
            np.bincount(r.cell_data["zone"]).tolist()[-2:], [len(r.quads), 2 * len(r.quads)]
        )
        self.assertLessEqual(r.point_data["thickness_ratio"].max(), 1.0)

    def test_patches_are_the_boundary(self):
        r = mesh()
        self.assertEqual(list(r.patches), r.patch_names)
        faces = np.concatenate(list(r.patches.values()))
        edges = np.concatenate([faces[:, [k, (k + 1) % 4]] for k in range(4)])
        there = {(a, b) for a, b in edges.tolist()}
        self.assertEqual(len(there), len(edges))
        self.assertEqual(there, {(b, a) for a, b in there})  # closed, consistently wound
        of_faces = r.cell_data["patch_of_face"]
        self.assertEqual(of_faces.shape, (len(r.hexes), 6))
        for i, name in enumerate(r.patch_names):
            self.assertEqual((of_faces == i).sum(), len(r.patches[name]))

    def test_quads_lie_on_the_surface_that_was_meshed(self):
        r = mesh()
        self.assertEqual(r.quads.shape, (r.report["quads"]["count"], 4))
        self.assertEqual(len(r.quad_cell_data["scaled_jacobian"]), len(r.quads))
        self.assertEqual(len(r.quad_point_data["thickness"]), len(r.quad_points))
        np.testing.assert_array_equal(r.surface_points, SURFACE[0])
        np.testing.assert_array_equal(r.surface_triangles, SURFACE[1])

    def test_arrays_outlive_the_result_and_cannot_be_changed(self):
        points = mesh().points
        copy = points.copy()
        mesh()
        np.testing.assert_array_equal(points, copy)
        with self.assertRaises(ValueError):
            points[0] = 0.0

    def test_is_what_the_program_makes(self):
        surface = self.folder / "s.vtp"
        run(PROGRAM, "generate", "bifurcation", "--edge", "0.3", "-o", surface)
        run(
            PROGRAM,
            "mesh",
            surface,
            "-o",
            self.folder / "a",
            "--size=0.4",
            "--layers=2",
            "--write=vtu,gmsh",
            "--write-basis",
            "-q",
        )
        r = mesh(surface, output=self.folder / "b", write=["vtu", "gmsh"], write_basis=True)
        names = sorted(os.listdir(self.folder / "a"))
        self.assertEqual(names, sorted(os.listdir(self.folder / "b")))
        for name in set(names) - {"report.json", "report.html"}:  # which have times
            self.assertTrue(
                filecmp.cmp(self.folder / "a" / name, self.folder / "b" / name, False), name
            )
        reports = [json.loads((self.folder / f / "report.json").read_text()) for f in "ab"]
        reports.append(r.report)
        for report in reports:
            for key in ("seconds", "peak_memory_bytes"):
                del report[key]
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[1], reports[2])
        self.assertEqual(r.warnings, reports[0]["warnings"])

    def test_is_written_in_formats_of_choice(self):
        r = mesh()
        r.write(self.folder / "out", "abaqus")
        self.assertTrue((self.folder / "out" / "wall.inp").is_file())
        self.assertFalse((self.folder / "out" / "wall.vtu").exists())
        with self.assertRaisesRegex(hexwall.UsageError, "word"):
            r.write(self.folder / "out", ["word"])


class Keywords(unittest.TestCase):
    def options_in_help(self, command):
        text = run(PROGRAM, command, "--help").stdout
        return {
            name.replace("-", "_") for name in re.findall(r"^  (?:-\w,)?--([\w-]+)", text, re.M)
        }

    def test_are_the_options_of_the_program(self):
        for function, left_out in ((hexwall.mesh, set()), (hexwall.check, {"output", "json"})):
            keywords = inspect.signature(function).parameters
            own = {"surface", "point_arrays", "cell_arrays", "progress", "cancelled"}
            self.assertEqual(
                set(keywords) - own,
                self.options_in_help(function.__name__) - {"help", "quiet", "verbose"} - left_out,
            )
            for keyword in set(keywords) - own:
                self.assertIn(f" {keyword}: ", function.__doc__)

    def test_have_stubs(self):
        path = SOURCE / "tools/python/stubs/stubs.py"
        spec = importlib.util.spec_from_file_location("stubs", path)
        stubs = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(stubs)
        compile(stubs.stubs(), "stubs", "exec")
        self.assertEqual(
            (SOURCE / "tools/python/hexwall/__init__.pyi").read_text(),
            stubs.stubs(),
            f"make them anew: PYTHONPATH=build/python python3 {path}",
        )

    def test_take_what_suits_python(self):
        r = mesh(
            size=np.float64(0.4),
            layers=np.int64(2),
            repair=["weld", "orient"],
            remesh=None,
            thickness_strict=False,
            poles=np.array([[0.0, 1.0, 3.0]]),
            names={"inlet": SURFACE[0][SURFACE[0][:, 2].argmax()]},
        )
        self.assertIn("inlet", r.patch_names)
        self.assertEqual(len(r.report["poles"]), 1)
        self.assertEqual(r.report["options"]["size"], 0.4)

    def test_take_arrays_on_the_surface(self):
        z = SURFACE[0][:, 2]
        wanted = 0.05 + 0.01 * (z - z.min()) / np.ptp(z)
        r = mesh(point_arrays={"t": wanted}, thickness_array="t")
        asked = r.point_data["thickness_asked"]
        self.assertAlmostEqual(asked.min(), wanted.min(), places=4)
        self.assertAlmostEqual(asked.max(), wanted.max(), places=4)

    def test_are_refused_as_on_the_command_line(self):
        for options in (
            {"size": -1},
            {"size": float("nan")},
            {"side": "up"},
            {"layers": 2, "layer_spec": "a:1:1"},
            {"thickness_array": "none"},
            {"poles": "nowhere.txt"},
            {"write": ["word"]},
            {"names": {"two words": (0, 0, 0)}},
        ):
            with self.subTest(options), self.assertRaises(hexwall.UsageError):
                hexwall.mesh(SURFACE, **options)
        for options in (
            {"sizes": 1},
            {"quiet": True},
            {"no_repair": 1},
            {"size": [1, 2]},
            {"size": True},
        ):
            with self.subTest(options), self.assertRaises(TypeError):
                hexwall.mesh(SURFACE, **options)


class Failures(InFolder):
    def assert_raises(self, error, surface, code, **options):
        with self.assertRaises(error) as caught:
            hexwall.mesh(surface, **options)
        self.assertIs(type(caught.exception), error)
        self.assertIsInstance(caught.exception, hexwall.Error)
        self.assertEqual(caught.exception.exit_code, code)

    def test_arrive_as_exceptions_of_their_class(self):
        points, triangles = SURFACE
        tetrahedron = (np.eye(4, 3), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        broken = points.copy()
        broken[3] = np.nan
        self.assert_raises(hexwall.ReadError, "nowhere.stl", 3)
        self.assert_raises(hexwall.ReadError, (points, triangles + len(points)), 3)
        self.assert_raises(hexwall.ReadError, (points, -triangles), 3)
        self.assert_raises(hexwall.TopologyError, tetrahedron, 4)
        self.assert_raises(hexwall.GeometryError, (broken, triangles), 5)
        self.assert_raises(hexwall.MeshingError, SURFACE, 6, thickness=1000.0, size=0.4)
        file = self.folder / "file"
        file.write_text("")
        self.assert_raises(hexwall.WriteError, SURFACE, 7, size=0.4, output=file / "out")

    def test_of_shapes_and_types_are_pythons_own(self):
        points, triangles = SURFACE
        for surface in ((points[:, :2], triangles), (points, triangles[:, :2])):
            with self.assertRaises(ValueError):
                hexwall.mesh(surface)
        for surface in ((points, triangles.astype(float)), 3, (points,)):
            with self.assertRaises(TypeError):
                hexwall.mesh(surface)
        with self.assertRaises(ValueError):
            hexwall.mesh(SURFACE, point_arrays={"t": np.ones(3)})

    def test_leave_no_files(self):
        with self.assertRaises(hexwall.MeshingError):
            mesh(thickness=1000.0, output=self.folder / "out")
        self.assertFalse((self.folder / "out").exists())


class Interrupts(unittest.TestCase):
    def test_progress_is_told(self):
        stages = []
        mesh(progress=lambda *stage: stages.append(stage))
        self.assertEqual(
            [name for name, _, _ in stages], ["form", "foliation", "quads", "relax", "wall"]
        )
        self.assertEqual([(i, n) for _, i, n in stages], [(i, 5) for i in range(5)])

    def test_exceptions_of_callbacks_come_out(self):
        def fail(*_):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            mesh(progress=fail)

    def test_cancelled_ends_the_work(self):
        with self.assertRaises(hexwall.Cancelled):
            mesh(size=0.03, cancelled=lambda: True)

    def test_control_c_ends_the_work(self):
        began = threading.Event()

        def interrupt():
            began.wait()
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            mesh(size=0.02, progress=lambda *_: began.set())
        thread.join()

    def test_other_threads_run_meanwhile(self):
        during = []
        done = threading.Event()

        def count():
            while not done.wait(0.002):
                during.append(time.monotonic())

        thread = threading.Thread(target=count)
        thread.start()
        before = len(during)
        mesh(size=0.05)
        after = len(during)
        done.set()
        thread.join()
        self.assertGreater(after - before, 10)


class Others(InFolder):
    def test_check_tells_what_is_wrong(self):
        points, triangles = SURFACE
        fine = hexwall.check(SURFACE)
        self.assertTrue(fine["meshable"])
        self.assertEqual(len(fine["openings"]), 3)
        closed = hexwall.check((np.eye(4, 3), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
        self.assertFalse(closed["meshable"])
        self.assertEqual(closed["exit_code"], hexwall.TopologyError.exit_code)
        self.assertTrue(closed["reason"])

    def test_generate_refuses_unknown_shapes(self):
        with self.assertRaisesRegex(hexwall.UsageError, "annulus"):
            hexwall.generate("cube")

    def test_examples_run(self):
        run(PROGRAM, "generate", "bifurcation", "--edge", "0.3", "-o", self.folder / "s.vtp")
        run(PROGRAM, "generate", "bifurcation", "--edge", "0.3", "-o", self.folder / "s.stl")
        for module, source, target in (("vtk", "s.vtp", "o.vtu"), ("meshio", "s.stl", "o.vtu")):
            with self.subTest(module):
                if not importlib.util.find_spec(module):
                    self.skipTest(f"there is no {module}")
                example = SOURCE / f"tools/python/examples/with_{module}.py"
                out = run(sys.executable, example, self.folder / source, self.folder / target, 0.4)
                self.assertRegex(out.stdout, "[1-9][0-9]* hexes$")
                self.assertTrue((self.folder / target).is_file())


if __name__ == "__main__":
    unittest.main()
