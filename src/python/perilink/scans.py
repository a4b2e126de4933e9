"""Scans: runs of a case with lists of values of its keys."""

from __future__ import annotations

import csv
import re
import shutil
import sys
import tempfile
import weakref
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from . import _core
from .case import Case, _toml, as_case
from .errors import FileError, InputError
from .mesh import Mesh
from .parts import absolute, named, parts_of
from .result import Result

if TYPE_CHECKING:
    import pandas

Table = dict[str, NDArray[Any]]

_NAME = "scan"  # of the scan in messages
_OF_FILES = re.compile(r"(body|elements)\.mesh\Z|graded\[\d+\]\.file\Z")  # keys
_TEXTS = ("status", "reason", "set", "quantity")
# A Python without numpy that runs the program: members start in a hundredth of a second.
_PROGRAM = "import sys; sys.path.append(sys.argv[1]); import _core; " \
           "sys.exit(_core.program(sys.argv[2:]))"


class ScanProgress(NamedTuple):
    """A member of a scan that has ended, for the progress function of `scan`."""

    member: int  #: number of the member, from 1
    values: str  #: "materials[1].tensile_strength = 2"
    status: str  #: completed, collapsed, nothing_breaks, interrupted or failed
    seconds: float  #: run time [s]
    done: int  #: members that have ended, with this one
    members: int  #: members that this scan runs


class ScanMembers(Sequence[Result]):
    """Results of the members of a scan, each read when it is asked for: ``members[0].history``."""

    def __init__(self, scan: ScanResult) -> None:
        self._scan = scan

    def __len__(self) -> int:
        return len(self._scan.table["member"])

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> list[Result]: ...
    def __getitem__(self, index: int | slice) -> Result | list[Result]:
        if isinstance(index, slice):
            return [self[k] for k in range(len(self))[index]]
        number = range(1, len(self) + 1)[index]
        result = Result(self._scan.path / f"{number:04}")
        result._owner = self._scan
        return result


class ScanResult:
    """Results of a scan, from its directory (docs/studies.md).

    Attributes:
        path: directory of the files
        table: columns of scan.csv by name, shape (members,): ``member`` from 1, the keys,
            ``status``, ``peak_load`` [force], ``peak_displacement`` [length], ... Numbers are
            floats, NaN where a member has none; ``status``, ``reason`` and keys with other values
            are texts.
        seeds: columns of scan_seeds.csv by name, shape (sets * quantities,): ``set`` (values of
            other keys), ``quantity``, ``seeds``, ``mean``, ``standard_deviation``; without seeds
            empty
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = Path(path)
        if not (self.path / "scan.csv").is_file():
            raise FileError(f"{self.path}: holds no scan: there is no scan.csv")
        self.table = _read_table(self.path / "scan.csv")
        self.table["member"] = self.table["member"].astype(np.int64)
        seeds = self.path / "scan_seeds.csv"
        self.seeds: Table = _read_table(seeds) if seeds.is_file() else {}

    @property
    def members(self) -> ScanMembers:
        """Results of the members, in the order of the table.

        Members that were refused or did not run raise FileError when they are asked for.
        """
        return ScanMembers(self)

    @property
    def frame(self) -> pandas.DataFrame:
        """The table as a pandas data frame; needs pandas."""
        import pandas

        return pandas.DataFrame(self.table).set_index("member")

    def __repr__(self) -> str:
        statuses, counts = np.unique(self.table["status"], return_counts=True)
        ends = ", ".join(f"{n} {status}" for status, n in zip(statuses, counts, strict=True))
        return f"ScanResult({str(self.path)!r}, {ends})"


def read_scan(directory: str | PathLike[str]) -> ScanResult:
    """Returns the results of an earlier scan, also of the program.

    Raises:
        FileError: the directory holds no scan
    """
    return ScanResult(directory)


def scan(
    case: Case,
    values: Mapping[str, Iterable[Any]] | None = None,
    *,
    runs: Iterable[Mapping[str, Any]] | None = None,
    seeds: int | Iterable[int] | None = None,
    out: str | PathLike[str] | None = None,
    jobs: int | None = None,
    threads: int = 1,
    title: str | None = None,
    force: bool = False,
    progress: Callable[[ScanProgress], object] | None = None,
    trust_geometry: bool = False,
) -> ScanResult:
    """Runs a case once for each set of values, several runs at once, like ``perilink scan``.

    ::

        scan = perilink.scan(case, {"materials[1].tensile_strength": [2, 3, 4],
                                    "materials[1].fracture_energy": [0.05, 0.1]})
        scan.table["peak_load"].reshape(3, 2)

    With `out` the same call continues a scan that was stopped: finished members of equal cases are
    kept. Ctrl-C stops all members and raises KeyboardInterrupt. A member that fails has the status
    ``failed`` in the table; the others go on. Members are processes of this Python.

    Args:
        case: the case
        values: a list of values for each key; one run for every combination, the last key varies
            fastest. Keys are those of ``perilink run --set``: "body.spacing",
            "materials[1].tensile_strength", "regions.upper edge.y".
        runs: instead of `values`: a dictionary of keys and values for each run
        seeds: run each set with the seeds 1 to this number, or with these seeds, of ``[[random]]``
            and unstructured particles
        out: directory of the files; by default a temporary one, deleted with the result
        jobs: most runs at once; by default OMP_NUM_THREADS or all processors, over `threads`
        threads: threads of each run
        title: heading of the picture scan.svg; by default that of the case
        force: run all members anew and overwrite their results
        progress: called with each member that has ended; stops the scan by returning ``False``
        trust_geometry: allow any gmsh script as mesh

    Raises:
        InputError: the case refuses a member, or the scan is wrong; nothing is written
        FileError: the directory holds results of another case, or files cannot be written
    """
    case = as_case(case)
    table = {"title": title, "case": case.path, "seeds": _listed(seeds),
             "values": None if values is None else {k: _listed(v) for k, v in values.items()},
             "runs": None if runs is None else [dict(run) for run in runs]}
    path = Path(tempfile.mkdtemp(prefix="perilink-") if out is None else out)
    try:
        _scan(case, table, path, (jobs or 0, threads), force, trust_geometry, progress)
        result = ScanResult(path)
    except BaseException:
        if out is None:
            shutil.rmtree(path, ignore_errors=True)
        raise
    if out is None:
        weakref.finalize(result, shutil.rmtree, path, ignore_errors=True)
    return result


def _scan(
    case: Case,
    table: dict[str, Any],
    path: Path,
    processors: tuple[int, int],
    force: bool,
    trust_geometry: bool,
    progress: Callable[[ScanProgress], object] | None,
) -> None:
    text = None if _is_file(case) else _whole_text(case, table, path)
    scan_text = _toml(table)
    report = None if progress is None else lambda *member: progress(ScanProgress(*member))
    words = [sys.executable, "-I", "-S", "-c", _PROGRAM, str(Path(_core.__file__).parent)]
    try:
        if parts_of(case):
            _core.check_scan(scan_text, _NAME, text)  # before meshes and fields are written
            _write_parts(case, path, force)
        _core.scan(scan_text, _NAME, text, fspath(path), *processors,
                   _core.OldResults.removed if force else _core.OldResults.refused,
                   trust_geometry, words, report)
    except InputError as error:  # lines of these texts mean nothing to the user
        message = str(error)
        for name in [_NAME] if text is None else [_NAME, case.path]:
            message = re.sub(rf"(?<!\S)({re.escape(name)}):\d+:", r"\1:", message)
        line = error.line if text is None and error.path != _NAME else 0
        raise InputError(message, error.path, line, error.key) from None


def _is_file(case: Case) -> bool:
    """Whether the members can read the file that the case was read from."""
    text = case._unchanged()
    path = Path(case.path)
    return text is not None and path.is_file() and path.read_text(encoding="utf-8-sig") == text


def _whole_text(case: Case, table: dict[str, Any], path: Path) -> str:
    """Returns the text of a case that may stand in any folder, and changes values accordingly."""
    origin = Path(case.path).resolve().parent
    for values in [table["values"] or {}, *(table["runs"] or [])]:
        for key in filter(_OF_FILES.match, values):
            values[key] = absolute(values[key], origin)
    return _toml(named(case, f"{path.resolve()}/", origin))


def _write_parts(case: Case, path: Path, force: bool) -> None:
    path.mkdir(parents=True, exist_ok=True)
    for name, text in parts_of(case).items():
        file = path / name
        if file.exists() and (path / "scan.csv").exists() and not force:
            if file.read_text(encoding="utf-8") == text():
                continue
            raise FileError(f"{file}: is of another scan\n  overwrite it with force=True, "
                            "or choose another directory with out")
        file.write_text(text(), encoding="utf-8")


def _listed(values: Any) -> Any:
    """Returns values as a list where they are several."""
    if isinstance(values, Iterable) and not isinstance(values, (str, Mapping)):
        values = list(values)
        if any(isinstance(value, Mesh) for value in values):
            raise TypeError("a Mesh cannot be a value of a scan; write the meshes to files by "
                            "Mesh.write and give their names")
    return values


def _read_table(path: Path) -> Table:
    with path.open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    return {name: _column(name, [row[k] for row in rows]) for k, name in enumerate(header)}


def _column(name: str, texts: Sequence[str]) -> NDArray[Any]:
    """Returns numbers, where all texts are numbers or empty."""
    try:
        if name not in _TEXTS:
            return np.array([float(text or "nan") for text in texts])
    except ValueError:
        pass
    return np.array(texts)
