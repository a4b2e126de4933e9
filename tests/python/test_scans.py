"""Scans: files as of the program, tables, samples, going on, Ctrl-C, refusals."""

import os
import signal
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import perilink
from test_cases import STRIP
from test_runs import PROGRAM, notched_beam

ENERGIES = {"materials[1].fracture_energy": [0.001, 0.004], "stop.broken_bonds": [10, 20]}


def strip() -> perilink.Case:
    case = perilink.parse_case(STRIP)
    case["stop"] = {"broken_bonds": 20}
    return case


class Scans(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)

    def assert_same_files(self, first: Path, second: Path, names):
        for name in names:
            texts = [(path / name).read_text(encoding="utf-8") for path in (first, second)]
            if name == "scan.csv":  # the last column is run time
                texts = [[line.rpartition(",")[0] for line in text.splitlines()] for text in texts]
            self.assertEqual(*texts, name)

    def test_a_file_gives_the_bytes_of_the_program(self):
        strip().write(self.folder / "strip.toml")
        (self.folder / "scan.toml").write_text(
            'case = "strip.toml"\n[values]\n'
            '"materials[1].fracture_energy" = [0.001, 0.004]\n"stop.broken_bonds" = [10, 20]\n')
        subprocess.run([PROGRAM, "scan", "scan.toml", "--out", "program", "--quiet"],
                       cwd=self.folder, check=True)
        case = perilink.read_case(self.folder / "strip.toml")
        scan = perilink.scan(case, ENERGIES, out=self.folder / "python", jobs=2)
        names = {path.name for path in (self.folder / "program").iterdir()}
        self.assertEqual(names, {path.name for path in scan.path.iterdir()})
        self.assert_same_files(self.folder / "program", scan.path, [
            "scan.csv", "scan.svg", "0001/history.csv", "0003/history.csv", "0003/case.toml"])
        changed = perilink.scan(strip(), ENERGIES, out=self.folder / "changed")
        self.assertTrue((changed.path / "scan_case.toml").exists(), "there is no other file of it")
        self.assert_same_files(changed.path, scan.path,
                               ["scan.csv", "scan.svg", "0004/history.csv"])

        self.assertEqual(list(scan.table["member"]), [1, 2, 3, 4])
        self.assertEqual(list(scan.table["stop.broken_bonds"]), [10, 20, 10, 20])
        self.assertEqual(list(scan.table["status"]), ["completed"] * 4)
        peaks = scan.table["peak_load"].reshape(2, 2)
        np.testing.assert_allclose(peaks[1] / peaks[0], 2.0, rtol=1e-9)
        self.assertEqual(scan.seeds, {})
        self.assertEqual(len(scan.members), 4)
        self.assertEqual(scan.members[-1].summary["broken_bonds"], 20)
        self.assertEqual([len(m.history["load"]) for m in scan.members[1:3]],
                         [len(scan.members[k].history["load"]) for k in (1, 2)])
        with self.assertRaises(IndexError):
            scan.members[4]
        self.assertIn("4 completed", repr(scan))
        again = perilink.read_scan(scan.path)
        np.testing.assert_array_equal(again.table["peak_load"], scan.table["peak_load"])
        with self.assertRaisesRegex(perilink.FileError, "holds no scan"):
            perilink.read_scan(self.folder)

    def test_samples_have_statistics(self):
        case = strip()
        case["random"] = [{"property": "fracture_energy", "distribution": "weibull",
                           "variation": 0.2, "correlation_length": 20.0}]
        scan = perilink.scan(case, runs=[{"body.horizon": 25.0}, {"body.horizon": 31.0}], seeds=3)
        peaks = scan.table["peak_load"].reshape(2, 3)
        self.assertEqual(len(np.unique(peaks)), 6)
        of_peaks = scan.seeds["quantity"] == "peak_load"
        self.assertEqual(list(scan.seeds["set"][of_peaks]),
                         ["body.horizon = 25", "body.horizon = 31"])
        np.testing.assert_allclose(scan.seeds["mean"][of_peaks], peaks.mean(axis=1), rtol=1e-12)
        np.testing.assert_allclose(scan.seeds["standard_deviation"][of_peaks],
                                   peaks.std(axis=1, ddof=1), rtol=1e-12)
        out = self.folder / "out"
        one = perilink.scan(case, runs=[{"body.horizon": 31.0}], seeds=np.array([2]), out=out)
        self.assertEqual(one.table["peak_load"][0], peaks[1, 1])
        other = perilink.scan(case, runs=[{"body.horizon": 31.0}], out=out, force=True)
        self.assertEqual(other.seeds, {}, "those of the earlier scan are gone")

    def test_temporary_results_go_with_their_scan(self):
        scan = perilink.scan(strip(), {"stop.broken_bonds": range(5, 7)})
        path, member = scan.path, scan.members[1]
        del scan
        self.assertEqual(member.summary["broken_bonds"], 6)
        del member
        self.assertFalse(path.exists())

    def test_meshes_of_arrays_are_kept_beside_the_members(self):
        x, y = np.meshgrid(np.linspace(0, 40, 5), np.linspace(0, 80, 9), indexing="ij")
        number = np.arange(x.size).reshape(x.shape)
        corners = [part.ravel() for part in (number[:-1, :-1], number[1:, :-1],
                                             number[1:, 1:], number[:-1, 1:])]
        cells = np.vstack([np.column_stack([corners[k] for k in part])
                           for part in ((0, 1, 2), (0, 2, 3))])
        points = np.column_stack([x.ravel(), y.ravel()])
        case = strip()
        case["body"] = {"mesh": perilink.Mesh(points, cells), "horizon_ratio": 3}
        values = {"materials[1].fracture_energy": [0.001, 0.004]}
        with self.assertRaises(perilink.InputError):
            perilink.scan(case, {"materials[1].fracture_energy": [-1]}, out=self.folder / "out")
        self.assertFalse((self.folder / "out").exists())
        scan = perilink.scan(case, values, out=self.folder / "out")
        self.assertAlmostEqual(scan.table["peak_load"][1] / scan.table["peak_load"][0], 2.0, 9)
        single = perilink.run(self._with_energy(case, 0.004), self.folder / "single")
        self.assertEqual((scan.path / "0002/history.csv").read_bytes(),
                         (single.directory / "history.csv").read_bytes())
        perilink.scan(case, values, out=scan.path)
        case["body"]["mesh"] = perilink.Mesh(points * 1.5, cells)
        with self.assertRaisesRegex(perilink.FileError, "body.msh: is of another scan"):
            perilink.scan(case, values, out=scan.path)
        with self.assertRaisesRegex(TypeError, "Mesh.write"):
            perilink.scan(case, {"body.mesh": [case["body"]["mesh"]]})

    @staticmethod
    def _with_energy(case: perilink.Case, energy: float) -> perilink.Case:
        case = case.copy()
        case["materials"][0]["fracture_energy"] = energy
        return case

    def test_fields_of_arrays_are_kept_beside_the_members(self):
        case = strip()
        case["graded"] = [{"property": "fracture_energy",
                           "file": np.array([[0.0, 0.0, 1.0], [0.0, 50.0, 4.0]])}]
        scan = perilink.scan(case, {"stop.broken_bonds": [3, 5]}, out=self.folder / "out")
        self.assertEqual(list(scan.table["status"]), ["completed"] * 2, scan.table["reason"])
        case["stop"] = {"broken_bonds": 5}
        single = perilink.run(case, self.folder / "single")
        self.assertEqual((scan.path / "0002/history.csv").read_bytes(),
                         (single.directory / "history.csv").read_bytes())
        case["graded"][0]["file"] = "out/graded_1.csv"
        case.path = str(self.folder / "case.toml")
        named = perilink.scan(case, {"graded[1].file": ["out/graded_1.csv"]})
        self.assertEqual(list(named.table["status"]), ["completed"], named.table["reason"])

    def test_names_of_meshes_begin_at_the_folder_of_the_case(self):
        mesh = perilink.Mesh([[0, 0], [40, 0], [40, 80], [0, 80], [20, 40]],
                             [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
        for name in ("a.msh", "b.msh"):
            mesh.write(self.folder / name)
        case = strip()
        case["analysis"] = {"type": "elastic"}
        del case["stop"]
        case["body"] = {"mesh": Path("a.msh"), "horizon_ratio": 3}
        case.path = str(self.folder / "case.toml")
        scan = perilink.scan(case, {"body.mesh": ["a.msh", "b.msh"]})
        self.assertEqual(list(scan.table["status"]), ["completed"] * 2, scan.table["reason"])

    def test_progress_stops_a_scan_that_then_goes_on(self):
        ended = []
        scan = perilink.scan(strip(), ENERGIES, out=self.folder / "out", jobs=1,
                             progress=lambda member: ended.append(member) or len(ended) < 2)
        self.assertEqual([(m.member, m.status, m.done, m.members) for m in ended[:2]],
                         [(1, "completed", 1, 4), (2, "completed", 2, 4)])
        self.assertIn("stop.broken_bonds = 10", ended[0].values)
        self.assertIn("not run", scan.table["status"])
        self.assertTrue(np.isnan(scan.table["peak_load"][-1]))
        more = []
        scan = perilink.scan(strip(), ENERGIES, out=self.folder / "out", progress=more.append)
        self.assertEqual(list(scan.table["status"]), ["completed"] * 4)
        self.assertLess(len(more), 3, "finished members are kept")
        with self.assertRaisesRegex(perilink.FileError, "--force"):
            perilink.scan(self._with_energy(strip(), 1.0), {"stop.broken_bonds": [10]},
                          out=self.folder / "out")
        with self.assertRaises(ZeroDivisionError):
            perilink.scan(strip(), ENERGIES, progress=lambda member: 1 / 0)

    def test_control_c_stops_all_members(self):
        case = notched_beam()
        del case["stop"]
        out = self.folder / "out"
        done = threading.Event()

        def interrupt():
            while not done.is_set() and len(list(out.glob("*/history.csv"))) < 2:
                done.wait(0.01)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            perilink.scan(case, {"materials[1].tensile_strength": [2.0, 3.0, 4.0]}, out=out, jobs=2)
            done.set()
        thread.join()
        statuses = list(perilink.read_scan(out).table["status"])
        self.assertIn("interrupted", statuses)
        self.assertEqual(statuses[-1], "not run")

    def test_refusals_have_the_texts_of_the_program_without_lines(self):
        out = self.folder / "out"
        for values, text in [
            ({"body.spacng": [1, 2]}, "did you mean `spacing`"),
            ({"stop.broken_bonds": [10, -1]},
             r"^scan: the case refuses member 0002 \(stop.broken_bonds = -1\)"),
            ({"stop.broken_bonds": 10}, "must be a list of values"),
            ({}, "has no key"),
            (None, r"neither \[values\] nor \[\[runs\]\]"),
        ]:
            with self.assertRaisesRegex(perilink.InputError, text) as caught:
                perilink.scan(strip(), values, out=out)
            self.assertEqual(caught.exception.line, 0)
            self.assertNotRegex(str(caught.exception), r"(scan|case):\d")
            self.assertFalse(out.exists())
        with self.assertRaisesRegex(perilink.InputError, r"has no \[\[random\]\]"):
            perilink.scan(strip(), seeds=3)

    def test_a_failed_member_is_a_row_with_its_reason(self):
        scan = perilink.scan(strip(), runs=[{"body.spacing": 1e-7}, {"stop.broken_bonds": 5}])
        self.assertEqual(list(scan.table["status"]), ["failed", "completed"])
        self.assertIn("body.spacing: gives about", scan.table["reason"][0])
        self.assertTrue(np.isnan(scan.table["body.spacing"][1]), "it keeps that of the case")
        with self.assertRaises(perilink.FileError):
            scan.members[0]
        case = strip()
        case["body"].update(spacing=1e-7, pattern="unstructured")
        scan = perilink.scan(case, seeds=2)
        self.assertEqual(list(scan.table["status"]), ["failed"] * 2)
        self.assertEqual(len(scan.seeds["mean"]), 0)

    def test_tables_are_frames_where_pandas_is_there(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        scan = perilink.scan(strip(), {"stop.broken_bonds": [5, 6]})
        self.assertIsInstance(scan.frame, pandas.DataFrame)
        self.assertEqual(list(scan.frame.loc[2:, "broken_bonds"]), [6])


if __name__ == "__main__":
    unittest.main()
