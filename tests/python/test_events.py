"""Damage analyses row by row."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import perilink
from test_cases import STRIP


def strip_with_gauge() -> perilink.Case:
    case = perilink.parse_case(STRIP)
    case["gauges"] = [{"name": "top", "at": [20, 80], "axis": "y"}]
    return case


class Events(unittest.TestCase):
    def test_rows_are_those_of_a_run(self):
        case = strip_with_gauge()
        history = perilink.run(case, threads=1).history
        run = perilink.EventRun(perilink.build(case), threads=1)
        tops = []
        for k, row in enumerate(run):
            for column in ("step", "load", "displacement", "load_factor", "broken_bonds",
                           "element", "strain_energy", "dissipated_energy", "external_work"):
                self.assertEqual(getattr(row, column), history[column][k], column)
            tops.append(run.gauges["top"])
        self.assertEqual(tops, list(history["top"]))
        self.assertGreater(len(tops), 5)
        self.assertEqual(len(tops), len(history["load"]))
        self.assertEqual(run.result["status"], "collapsed")
        self.assertEqual(list(run), [])

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
            with self.assertRaisesRegex(perilink.FileError, "another problem"):
                perilink.EventRun(perilink.build(case), path)

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
