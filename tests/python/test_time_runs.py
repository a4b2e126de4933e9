"""Explicit runs and relaxations row by row."""

import gc
import os
import signal
import threading
import unittest

import numpy as np

import perilink
from test_cases import STRIP


def moving_strip(**analysis) -> perilink.Case:
    case = perilink.parse_case(STRIP)
    case["gauges"] = [{"name": "top", "at": [20, 80], "axis": "y"}]
    case["materials"][0]["density"] = 2.4e-9
    del case["loads"]
    case["displacements"] = [{"region": "upper end", "y": 0.6}]
    case["analysis"] = {"type": "explicit", "duration": 2e-4, "ramp_time": 2e-4, "rows": 40,
                        **analysis}
    return case


COLUMNS = ("step", "time", "load_factor", "load", "displacement", "broken_bonds",
           "kinetic_energy", "strain_energy", "dissipated_energy", "damped_energy",
           "external_work")


class TimeRuns(unittest.TestCase):
    def follow(self, case, threads):
        """Compares all rows with those of a run; returns the run after its end."""
        history = perilink.run(case, threads=1).history
        run = perilink.TimeRun(perilink.build(case), threads=threads)
        self.assertIsNone(run.result)
        tops = []
        for k, row in enumerate(run):
            for column in COLUMNS:
                if column in history:
                    self.assertEqual(getattr(row, column), history[column][k], column)
            tops.append(run.gauges["top"])
        self.assertEqual(tops, list(history["top"]))
        self.assertGreater(len(tops), 5)
        self.assertEqual(list(run), [])
        return run, history

    def test_rows_are_those_of_an_explicit_run(self):
        for threads in (1, 2):
            run, history = self.follow(moving_strip(), threads)
            self.assertGreater(history["broken_bonds"][-1], 0)
            self.assertEqual(run.result, {"status": "completed", "reason": "the whole duration"})

    def test_rows_are_those_of_a_relaxation(self):
        case = moving_strip()
        case["analysis"] = {"type": "relaxation", "load_factors": [0.0005 * k for k in range(1, 12)]}
        self.follow(case, 1)

    def test_a_rule_of_a_gauge_ends_the_run(self):
        case = moving_strip()
        case["stop"] = {"gauge": "top", "above": 0.04}
        run, history = self.follow(case, 1)
        self.assertLess(history["load_factor"][-1], 0.6)
        self.assertIn("top", run.result["reason"])

    def test_arrays_are_of_the_last_row(self):
        problem = perilink.build(moving_strip())
        run = perilink.TimeRun(problem)
        with self.assertRaisesRegex(RuntimeError, "call next"):
            run.displacement
        next(run)
        np.testing.assert_array_equal(run.displacement, 0.0)
        np.testing.assert_array_equal(run.stiffness_ratios, 1.0)
        for row in run:
            if row.broken_bonds >= 5:
                break
        self.assertEqual(np.count_nonzero(run.stiffness_ratios == 0.0), row.broken_bonds)
        top = np.flatnonzero((problem.positions == [20, 80]).all(axis=1))
        self.assertEqual(run.gauges["top"], run.displacement[top[0], 1])
        self.assertEqual(run.velocity.shape, run.displacement.shape)
        self.assertEqual(run.stress.shape, (len(problem.positions), 6))
        self.assertGreater(run.damage.max(), 0.0)

    def test_arrays_stay_at_the_end(self):
        run = perilink.TimeRun(perilink.build(moving_strip()))
        for _ in run:
            last = run.displacement, run.damage, run.gauges["top"]
        np.testing.assert_array_equal(run.displacement, last[0])
        np.testing.assert_array_equal(run.damage, last[1])
        self.assertEqual(run.gauges["top"], last[2])
        self.assertGreater(last[2], 0.0)

    def test_a_run_may_be_left(self):
        problem = perilink.build(moving_strip(duration=2.0, ramp_time=2.0, rows=1000000))
        perilink.TimeRun(problem)  # never begun
        run = perilink.TimeRun(problem)
        next(run)
        next(run)
        del run
        gc.collect()

    def test_ctrl_c_ends_the_run(self):
        case = moving_strip(duration=50.0, ramp_time=50.0, rows=2)
        run = perilink.TimeRun(perilink.build(case))
        next(run)
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            next(run)
        self.assertEqual(list(run), [])
        self.assertEqual(run.result["status"], "interrupted")

    def test_other_analyses_are_refused(self):
        with self.assertRaisesRegex(perilink.InputError, "TimeRun follows"):
            perilink.TimeRun(perilink.build(perilink.parse_case(STRIP)))

    def test_energy_from_nothing_is_an_error(self):
        case = moving_strip(time_step=1.0)
        with self.assertRaises(perilink.InputError):
            perilink.TimeRun(perilink.build(case))


if __name__ == "__main__":
    unittest.main()
