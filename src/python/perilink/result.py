"""Results of runs."""

from __future__ import annotations

import csv
import json
import shutil
import tempfile
import weakref
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .case import Case, as_case
from .parts import parts_beside_results, parts_of
from .summary import Summary

if TYPE_CHECKING:
    import pandas

Arrays = dict[str, NDArray[np.float64]]


class Result:
    """Results of a run, read from its directory (docs/outputs.md) when they are asked for.

    Attributes:
        directory: directory of the files
    """

    def __init__(self, directory: str | PathLike[str]) -> None:
        self.directory = Path(directory).absolute()
        _core.require_result(fspath(self.directory))
        self.text: str = ""  #: the lines that ``perilink run`` prints
        self._history: Arrays | None = None
        self._owner: object = None  # of a temporary directory

    @property
    def summary(self) -> Summary:
        """Contents of summary.json: peaks, energies, sizes, notes, times."""
        text = (self.directory / "summary.json").read_text(encoding="utf-8")
        summary: Summary = json.loads(text)
        return summary

    @property
    def status(self) -> str:
        """How the run ended: completed, collapsed, nothing_breaks, interrupted or failed."""
        return str(self.summary["status"])

    @property
    def history(self) -> Arrays:
        """Columns of history.csv by name, shape (rows,): load, displacement, energies, gauges."""
        if self._history is None:
            self._history = _core.read_history(str(self.directory / "history.csv"))
        return self._history

    @property
    def frame(self) -> pandas.DataFrame:
        """The history as a pandas data frame; needs pandas."""
        import pandas

        return pandas.DataFrame(self.history)

    @property
    def steps(self) -> list[int]:
        """Steps with fields, in order: the number in the names of their files."""
        return [int(name[len("fields_"):-len(".vtu")]) for name in self._series()]

    def fields(self, step: int | None = None) -> Arrays:
        """Returns the fields of the particles by name, shape (particles,) or (particles, k).

        ``points`` are the positions in the reference state, shape (particles, 3) [length]. Others
        are displacement, damage, stress, volume, ...: see docs/outputs.md.

        Args:
            step: one of `steps`; the last by default
        """
        grid = self._grid(step)
        return {"points": grid["points"], **grid["point_data"]}

    def broken_bonds(self, step: int | None = None) -> NDArray[np.int64]:
        """Returns the particles at the ends of broken bonds, in order of breaking, shape (k, 2)."""
        grid = self._grid(step)
        ends = np.asarray(grid["offsets"], dtype=np.int64)
        lines = np.flatnonzero(grid["cell_data"]["element"] == 1)
        last = ends[lines]
        connectivity = np.asarray(grid["connectivity"], dtype=np.int64)
        return np.stack([connectivity[last - 2], connectivity[last - 1]], axis=1)

    def reactions(self, step: int | None = None) -> list[dict[str, Any]]:
        """Returns the rows of reactions_STEP.csv: forces and moments at supports; none without."""
        return self._table("reactions", step)

    def bars(self, step: int | None = None) -> list[dict[str, Any]]:
        """Returns the rows of bars_STEP.csv: strain, force and slip along the bars."""
        return self._table("bars", step)

    def cracks(self, step: int | None = None) -> list[dict[str, Any]]:
        """Returns the rows of cracks_STEP.csv, the widest crack first; none without cracks."""
        return self._table("cracks", step)

    def _series(self) -> list[str]:
        path = self.directory / "fields.pvd"
        return [name for _, name in _core.read_series(str(path))] if path.exists() else []

    def _step(self, step: int | None) -> int:
        steps = self.steps
        if step is None and steps:
            return steps[-1]
        if step not in steps:
            raise ValueError(f"step {step} has no fields; steps with fields are {steps}")
        return step

    def _grid(self, step: int | None) -> dict[str, Any]:
        return _core.read_fields(str(self.directory / f"fields_{self._step(step):06d}.vtu"))

    def _table(self, kind: str, step: int | None) -> list[dict[str, Any]]:
        if step is None and not self.steps:
            return []
        path = self.directory / f"{kind}_{self._step(step):06d}.csv"
        if not path.exists():
            return []
        with path.open(newline="", encoding="utf-8") as file:
            return [{k: _number(v) for k, v in row.items()} for row in csv.DictReader(file)]

    def __repr__(self) -> str:
        return f"Result({str(self.directory)!r}, {self.status})"


def _number(text: str) -> float | str | None:
    try:
        return float(text) if text else None
    except ValueError:
        return text


def read_result(directory: str | PathLike[str]) -> Result:
    """Returns the result of an earlier run, also of the program.

    Raises:
        FileError: the directory holds no result
    """
    return Result(directory)


def run(
    case: Case,
    directory: str | PathLike[str] | None = None,
    *,
    threads: int | None = None,
    force: bool = False,
    resume: bool = False,
    progress: Callable[[_core.Row], object] | None = None,
    trust_geometry: bool = False,
    calibrations: str | PathLike[str] | None = None,
) -> Result:
    """Runs a case of any analysis type, like ``perilink run``.

    Other threads of Python run meanwhile. Ctrl-C ends the run at its next row: its files are
    complete, with the status ``interrupted``, and KeyboardInterrupt is raised. An exception of
    `progress` ends it in the same way.

    Args:
        case: the case
        directory: directory of the files; by default a temporary one, deleted with the result
        threads: most threads; by default OMP_NUM_THREADS or all processors
        force: overwrite the results of an earlier run
        resume: go on with the run of this case that the directory holds, if there is one
        progress: called with the latest row, at most 20 times a second; ends the run by returning
            ``False``
        trust_geometry: allow any gmsh script as mesh
        calibrations: directory in which calibrations of bonds are kept, and from which runs that
            differ in strengths and loads only take them

    Raises:
        InputError: the case is wrong or does not fit its body; nothing is written
        FileError: the directory holds results, or files cannot be written
        SolverError: the solver cannot continue; rows before are in the directory
    """
    case = as_case(case)
    if force and resume:
        raise ValueError("force overwrites the results that resume goes on with; give one of them")
    old = (_core.OldResults.removed if force else _core.OldResults.kept if resume
           else _core.OldResults.refused)
    target = Path(tempfile.mkdtemp(prefix="perilink-") if directory is None else directory)
    try:
        return _run(case, target, directory is None, threads, old, progress, trust_geometry,
                    calibrations)
    except BaseException:
        if directory is None:
            shutil.rmtree(target, ignore_errors=True)
        raise


def _run(
    case: Case,
    target: Path,
    is_temporary: bool,
    threads: int | None,
    old_results: _core.OldResults,
    progress: Callable[[_core.Row], object] | None,
    trust_geometry: bool,
    calibrations: str | PathLike[str] | None,
) -> Result:
    if parts_of(case):
        _core.refuse_old_results(fspath(target), old_results != _core.OldResults.refused)
        case._parse()  # before its parts are written
    resume = old_results == _core.OldResults.kept
    with parts_beside_results(case, target, resume=resume) as folder:
        parsed = case._parse(folder)
        parsed.trust_geometry = trust_geometry
        _, _, text = _core.run(parsed, fspath(target), threads or 0, old_results, progress,
                               None if calibrations is None else fspath(calibrations))
    result = Result(target)
    result.text = text
    if is_temporary:
        weakref.finalize(result, shutil.rmtree, target, ignore_errors=True)
    return result
