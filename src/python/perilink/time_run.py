"""Explicit runs and relaxations row by row."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import _core
from .row_run import RowRun

TimeRow = _core.TimeRow


class TimeRun(RowRun[_core.TimeRow, _core.TimeStepper]):
    """An explicit run or a relaxation of bonds that is advanced row by row.

    ::

        run = perilink.TimeRun(perilink.build(case))
        for row in run:
            if run.damage.max() > 0.5:
                break

    Rows equal those of `run`; a stop rule by a gauge ends both. Arrays are copies of the state in
    the last row. Ctrl-C raises KeyboardInterrupt; while a row is computed it ends the run, after
    this row if it is complete.

    Args:
        problem: from `build`, of a case with ``type = "explicit"`` or ``"relaxation"``
        threads: most threads; by default OMP_NUM_THREADS or all processors

    Raises:
        InputError: the case has another type of analysis, or its time step is unstable
        SolverError: energy appears from nothing, or a load step does not come to rest
    """

    def __init__(self, problem: _core.Problem, *, threads: int | None = None) -> None:
        self.problem = problem
        self._stepper = _core.TimeStepper(problem, threads or 0)

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Velocity half a time step earlier, shape (particles, width) [length/time], [1/time].

        In a relaxation it is that of the damped motion.
        """
        return self._stepper.velocity()

    @property
    def result(self) -> dict[str, str] | None:
        """Status and reason of the end; None before."""
        return self._stepper.result()
