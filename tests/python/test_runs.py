"""Runs: files as of the program, progress, Ctrl-C, failures."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import perilink
from test_cases import EXAMPLES, STRIP

PROGRAM = os.environ["PERILINK_PROGRAM"]


def notched_beam() -> perilink.Case:
    """The beginning of an example."""
    case = perilink.read_case(EXAMPLES / "notched_beam.toml")
    case["stop"]["broken_bonds"] = 150
    return case


class Runs(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)

    def test_a_changed_example_gives_the_bytes_of_the_program(self):
        case = notched_beam()
        case.write(self.folder / "beam.toml")
        result = perilink.run(case, self.folder / "python", threads=1)
        subprocess.run([PROGRAM, "run", "beam.toml", "--out", "program", "--quiet"],
                       cwd=self.folder, check=True)
        names = {path.name for path in (self.folder / "program").iterdir()}
        self.assertEqual(names, {path.name for path in result.directory.iterdir()})
        for name in sorted(names):
            if name.endswith((".vtu", ".pvd")) or name in ("history.csv", "case.toml"):
                self.assertEqual((self.folder / "python" / name).read_bytes(),
                                 (self.folder / "program" / name).read_bytes(), name)

        history = result.history
        self.assertGreater(len(history["load"]), 50)
        self.assertEqual(np.max(history["load"]), result.summary["largest_load"])
        self.assertEqual(result.status, "completed")
        self.assertIn("peak load", result.text)
        fields = result.fields()
        self.assertEqual(fields["displacement"].shape, fields["points"].shape)
        self.assertEqual(len(fields["points"]), result.summary["particles"])
        broken = result.broken_bonds()
        self.assertEqual(len(broken), history["broken_bonds"][-1])
        self.assertTrue(np.all(broken[:, 0] < broken[:, 1]))
        self.assertEqual(len(result.broken_bonds(result.steps[0])), 0)
        self.assertEqual(result.reactions()[-1]["place"], "sum")
        crack, = result.cracks()[:1]
        self.assertEqual(crack["largest_opening"], result.summary["cracks"][0]["largest_opening"])
        self.assertEqual(result.cracks(result.steps[0]), [])
        self.assertLessEqual(set(result.summary["cracks"][0]),
                             set(perilink.summary.Crack.__annotations__))
        with self.assertRaisesRegex(ValueError, "has no fields"):
            result.fields(-5)

    def test_temporary_results_go_with_their_result(self):
        result = perilink.run(perilink.parse_case(STRIP))
        directory = result.directory
        self.assertTrue((directory / "history.csv").exists())
        del result
        self.assertFalse(directory.exists())

    def test_every_type_of_analysis_runs(self):
        for kind, keys in {
            "elastic": {},
            "relaxation": {"load_factors": [0.01], "tolerance": 1e-2},
            "explicit": {"duration": 1e-3, "rows": 2},
        }.items():
            case = perilink.parse_case(STRIP)
            case["materials"][0]["density"] = 1.0
            case["analysis"] = {"type": kind, **keys}
            if kind != "explicit":
                del case["materials"][0]["density"]
            result = perilink.run(case)
            self.assertEqual(result.summary["analysis"], kind)
            self.assertGreater(len(result.history["load"]), 0)

    def test_progress_is_called_and_can_end_a_run(self):
        rows = []
        result = perilink.run(notched_beam(), progress=lambda row: rows.append(row))
        self.assertGreater(len(rows), 0)
        self.assertEqual(rows[0].row, 1)
        self.assertEqual(rows[0].load, result.history["load"][0])
        self.assertLess(len(rows), 25 * sum(result.summary["seconds"].values()) + 2)
        ended = perilink.run(notched_beam(), progress=lambda row: False)
        self.assertEqual(ended.status, "interrupted")
        self.assertEqual(len(ended.history["load"]), 1)

    def test_an_exception_of_the_progress_ends_the_run(self):
        def fail(row):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            perilink.run(notched_beam(), self.folder / "out", progress=fail)
        result = perilink.read_result(self.folder / "out")
        self.assertEqual(result.status, "interrupted")
        self.assertEqual(len(result.history["load"]), 1)

    def test_control_c_ends_a_run_and_keeps_its_results(self):
        case = perilink.read_case(EXAMPLES / "notched_beam.toml")
        begun = threading.Event()

        def interrupt():
            begun.wait()
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            perilink.run(case, self.folder / "out", progress=lambda row: begun.set())
        thread.join()
        result = perilink.read_result(self.folder / "out")
        self.assertEqual(result.status, "interrupted")
        self.assertGreater(len(result.history["load"]), 0)
        self.assertGreater(len(result.fields()["points"]), 0)

    def test_other_threads_run_meanwhile(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(1)
                done.wait(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = len(counted)
        perilink.run(notched_beam())
        during = len(counted) - before
        done.set()
        thread.join()
        self.assertGreater(during, 10)

    def test_a_run_does_not_overwrite_results(self):
        case = perilink.parse_case(STRIP)
        perilink.run(case, self.folder / "out")
        with self.assertRaisesRegex(perilink.FileError, "out"):
            perilink.run(case, self.folder / "out")
        case["body"]["horizon"] = 25.0
        result = perilink.run(case, self.folder / "out", force=True)
        self.assertEqual(perilink.read_case(self.folder / "out/case.toml")["body"]["horizon"], 25.0)
        self.assertIsNone(result.summary.get("error"))
        with self.assertRaises(perilink.FileError):
            perilink.read_result(self.folder)

    def test_an_ended_run_is_taken_up_again(self):
        case = notched_beam()
        case["output"]["checkpoint_every"] = 20
        whole = perilink.run(case, self.folder / "whole")
        count = len(whole.history["load"])
        ended = perilink.run(case, self.folder / "out", progress=lambda row: row.row < 30)
        self.assertEqual(ended.status, "interrupted")
        self.assertLess(len(ended.history["load"]), count)
        result = perilink.run(case, self.folder / "out", resume=True)
        self.assertEqual(result.status, "completed")
        self.assertEqual((result.directory / "history.csv").read_bytes(),
                         (whole.directory / "history.csv").read_bytes())
        again = perilink.run(case, self.folder / "out", resume=True)
        self.assertEqual(again.summary, result.summary, "it is complete and has not run")
        with self.assertRaisesRegex(ValueError, "give one of them"):
            perilink.run(case, self.folder / "out", resume=True, force=True)

    def test_refused_runs_leave_the_points_of_kept_results(self):
        case = perilink.parse_case(STRIP)
        case["graded"] = [{"property": "fracture_energy",
                           "file": np.array([[0.0, 0.0, 1.0], [0.0, 80.0, 1.0]])}]
        directory = perilink.run(case, self.folder / "out").directory
        kept = {path.name: path.read_bytes() for path in directory.iterdir()}
        case["graded"][0]["file"][1, 2] = 4.0
        with self.assertRaisesRegex(perilink.FileError, r"graded_1.csv: differs"):
            perilink.run(case, directory, resume=True)
        case["supports"] = case["supports"][:1]
        case["supports"][0]["fix"] = ["x"]
        for target in (directory, self.folder / "new"):
            with self.assertRaises(perilink.InputError):
                perilink.run(case, target, force=True)
        self.assertEqual(kept, {path.name: path.read_bytes() for path in directory.iterdir()})
        self.assertFalse((self.folder / "new").exists())

    def test_a_forked_process_runs(self):
        """OpenMP of GCC waits for ever in a child of a process that has run several threads."""
        text = ("import multiprocessing, perilink\n"
                f"case = perilink.parse_case({STRIP!r})\n"
                "def run(k):\n"
                "    return perilink.run(case, threads=2).summary['peak_load']\n"
                "first = run(0)\n"
                "with multiprocessing.get_context('fork').Pool(1) as pool:\n"
                "    assert pool.map(run, [1]) == [first]\n")
        subprocess.run([sys.executable, "-c", text], check=True, timeout=60)

    def test_faults_that_depend_on_the_body_are_exceptions(self):
        case = perilink.parse_case(STRIP)
        del case["supports"][0]
        with self.assertRaises(perilink.InputError) as caught:
            perilink.run(case, self.folder / "out")
        self.assertIn("rigid", str(caught.exception))
        self.assertEqual(caught.exception.line, 0, "the case was changed")
        self.assertFalse((self.folder / "out").exists())

    def test_histories_are_frames_where_pandas_is_there(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        result = perilink.run(perilink.parse_case(STRIP))
        self.assertIsInstance(result.frame, pandas.DataFrame)
        self.assertEqual(list(result.frame.columns), list(result.history))


if __name__ == "__main__":
    unittest.main()
