"""Damage analyses row by row."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any

from . import _core
from .row_run import RowRun

EventRow = _core.EventRow
DamageState = _core.DamageState


class EventRun(RowRun[_core.EventRow, _core.Stepper]):
    """A damage analysis that is advanced row by row: step, look, stop, save, go on.

    ::

        run = perilink.EventRun(problem)
        for row in run:
            if row.broken_bonds > 100:
                break
        run.write("hundred.state")

    Rows equal those of `run`. After a missed release of host elements the run starts again with
    these elements released, as `run` does: ``row.step`` is 1 again, and the rows before do not
    count. `result` gives the number of such restarts as ``missed_releases``. Ctrl-C raises
    KeyboardInterrupt; while a row is computed it ends the run, after this row if it is complete.

    Args:
        problem: from `build`, of a case with ``type = "damage"``
        state: state to go on from, `state` of a run or a file of `write`; stop rules may differ
        threads: most threads; by default OMP_NUM_THREADS or all processors

    Raises:
        InputError: the case has another type of analysis, or a piece of the body has no support
        SolverError: there is no equilibrium
        FileError: the state is of another problem, or the file is damaged
    """

    def __init__(
        self,
        problem: _core.Problem,
        state: DamageState | str | PathLike[str] | None = None,
        *,
        threads: int | None = None,
    ) -> None:
        self.problem = problem
        if isinstance(state, (str, PathLike)):
            state = _core.read_state(fspath(state), problem)
        self._stepper = _core.Stepper(problem, state, threads or 0)

    @property
    def result(self) -> dict[str, Any]:
        """Peaks, number of broken bonds, errors, status (``running`` before the end) and reason."""
        return self._stepper.result()

    def state(self) -> DamageState:
        """Returns all that a run needs to go on after the last row.

        Runs that go on from one state agree bit by bit. The run that was saved agrees with them up
        to last digits, because they begin with a new factor.
        """
        return self._stepper.state()

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the state to a file, for this problem and this version of perilink."""
        _core.write_state(fspath(path), self.problem, self.state())
