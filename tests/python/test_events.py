"""Damage analyses row by row."""

import os
import re
import signal
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import perilink
from test_cases import EXAMPLES, STRIP


def strip_with_gauge() -> perilink.Case:
    case = perilink.parse_case(STRIP)
    case["gauges"] = [{"name": "top", "at": [20, 80], "axis": "y"}]
    return case


def late_beam() -> perilink.Case:
    """A notched beam in elements that release a bond beyond its limit too late."""
    def box(name, x, y):
        return {"name": name, "x": x, "y": y}
    return perilink.Case(
        body={"pattern": "rectangular", "spacing": 2.0, "horizon_ratio": 3},
        regions=[box("beam", [0, 160], [0, 40]), box("left", [10, 14], [0, 0]),
                 box("right", [146, 150], [0, 0]), box("load", [78, 82], [40, 40]),
                 box("pads", [0, 60], [0, 40]), box("other pads", [100, 160], [0, 40]),
                 box("top", [60, 100], [32, 40])],
        materials=[{"region": "beam", "youngs_modulus": 30e3, "fracture_energy": 0.1},
                   {"regions": ["pads", "other pads", "top"], "youngs_modulus": 30e3,
                    "fracture_energy": "infinite"}],
        cracks=[{"points": [[81, -1], [81, 13]]}],
        supports=[{"region": "left", "fix": ["x", "y"]}, {"region": "right", "fix": ["y"]}],
        loads=[{"region": "load", "force": [0, -100]}],
        elements={"spacings": 4, "alert": 0.99, "halo": 0.01},
        stop={"broken_bonds": 120})


class Events(unittest.TestCase):
    def test_rows_are_those_of_a_run(self):
        case = strip_with_gauge()
        history = perilink.run(case, threads=1).history
        run = perilink.EventRun(perilink.build(case), threads=1)
        tops = []
        for k, row in enumerate(run):
            for column in history:
                if column != "top":
                    self.assertEqual(getattr(row, column), history[column][k], column)
            tops.append(run.gauges["top"])
        self.assertEqual(tops, list(history["top"]))
        self.assertGreater(len(tops), 5)
        self.assertEqual(len(tops), len(history["load"]))
        self.assertEqual(run.result["status"], "collapsed")
        self.assertEqual(list(run), [])

    def test_stubs_list_all_quantities_of_rows(self):
        path = Path(os.environ["PERILINK_SOURCE_DIR"]) / "src/python/perilink/_core.pyi"
        stubs = path.read_text(encoding="utf-8")
        for row in (perilink.EventRow, perilink.TimeRow):
            body = re.search(rf"^class {row.__name__}:(.*?)^\S", stubs, re.DOTALL | re.MULTILINE)
            named = re.findall(r"def (\w+)\(self\)", body[1])
            self.assertEqual(sorted(named),
                             sorted(k for k, v in vars(row).items() if isinstance(v, property)))

    def test_arrays_are_of_the_last_row(self):
        case = strip_with_gauge()
        problem = perilink.build(case)
        run = perilink.EventRun(problem)
        first = next(run)
        np.testing.assert_array_equal(run.stiffness_ratios, 1.0)
        np.testing.assert_allclose(run.damage, 0.0)
        elastic = perilink.solve(problem)
        np.testing.assert_allclose(run.displacement, first.load_factor * elastic.displacement,
                                   atol=1e-12)
        np.testing.assert_allclose(run.stress, first.load_factor * elastic.stress, atol=1e-9)
        top = np.flatnonzero((problem.positions == [20, 80]).all(axis=1))
        self.assertAlmostEqual(run.gauges["top"], run.displacement[top[0], 1], delta=1e-15)
        for row in run:
            if row.broken_bonds >= 5:
                break
        self.assertEqual(np.count_nonzero(run.stiffness_ratios == 0.0), row.broken_bonds)
        self.assertGreater(run.damage.max(), 0.0)

    def test_a_run_may_be_asked_again_after_ctrl_c(self):
        run = perilink.EventRun(perilink.build(perilink.read_case(EXAMPLES / "notched_beam.toml")))
        steps = [next(run).step]
        threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            for row in run:
                steps.append(row.step)
        steps += [row.step for row in run]  # what is left where the signal came between two rows
        self.assertEqual(steps, list(range(1, len(steps) + 1)))
        self.assertIn(run.result["status"], ("interrupted", "completed", "collapsed"))

    def test_a_run_goes_on_from_a_saved_state(self):
        problem = perilink.build(strip_with_gauge())
        run = perilink.EventRun(problem)
        for _ in range(4):
            next(run)
        state = run.state()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "four.state"
            run.write(path)
            loads = [[row.load for row in perilink.EventRun(problem, saved)]
                     for saved in (state, state, path, str(path))]
            self.assertGreater(len(loads[0]), 3)
            for others in loads[1:]:
                self.assertEqual(loads[0], others)
            np.testing.assert_allclose(loads[0], [row.load for row in run], rtol=1e-10)
            case = strip_with_gauge()
            case["loads"][0]["force"] = [0, 13]
            for saved in (path, state):
                with self.assertRaisesRegex(perilink.FileError, "another problem"):
                    perilink.EventRun(perilink.build(case), saved)

    def test_a_loaded_run_shows_its_last_row(self):
        problem = perilink.build(strip_with_gauge())
        run = perilink.EventRun(problem)
        self.assertEqual(run.result["status"], "running")
        for _ in range(4):
            next(run)
        loaded = perilink.EventRun(problem, run.state())
        np.testing.assert_allclose(loaded.displacement, run.displacement, rtol=1e-9, atol=1e-14)
        self.assertAlmostEqual(loaded.gauges["top"], run.gauges["top"], delta=1e-12)
        self.assertGreater(run.gauges["top"], 1e-6)

    def test_one_thread_at_a_time_advances_a_run(self):
        run = perilink.EventRun(perilink.build(perilink.read_case(EXAMPLES / "notched_beam.toml")))
        faults, steps = [], []

        def advance():
            try:
                for row in run:
                    steps.append(row.step)
            except RuntimeError as error:
                faults.append(str(error))

        threads = [threading.Thread(target=advance) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, ["another thread of Python is advancing this run"])
        self.assertEqual(sorted(steps), list(range(1, len(steps) + 1)))

    def test_missed_releases_start_the_run_again(self):
        case = late_beam()
        problem = perilink.build(case)
        result = perilink.run(case, threads=1)
        self.assertGreater(result.summary["late_conversions"], 0)
        run = perilink.EventRun(problem, threads=1)
        rows = []
        for row in run:
            if row.step == 1:
                rows = []
            rows.append(row)
        self.assertEqual(run.result["missed_releases"], result.summary["late_conversions"])
        for column in ("step", "load", "broken_bonds", "element"):
            self.assertEqual([getattr(row, column) for row in rows],
                             list(result.history[column]), column)

    def test_problems_outlive_their_name(self):
        run = perilink.EventRun(perilink.build(strip_with_gauge()))
        self.assertGreater(sum(1 for _ in run), 5)

    def test_other_analyses_are_refused(self):
        case = perilink.parse_case(STRIP)
        case["analysis"] = {"type": "elastic"}
        with self.assertRaises(perilink.InputError) as caught:
            perilink.EventRun(perilink.build(case))
        self.assertEqual(caught.exception.key, "analysis.type")


if __name__ == "__main__":
    unittest.main()
