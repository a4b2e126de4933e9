"""Perilink: implicit quasistatic peridynamics, from the first crack to collapse.

    import perilink

    case = perilink.read_case("notched_beam.toml")
    case["body"]["spacing"] = 2.0
    result = perilink.run(case, "results/fine")
    print(result.summary["peak_load"], result.history["load"].max())

`Case` describes the case, `run` runs it, `scan` runs it with lists of values, `EventRun` and
`TimeRun` advance it row by row, `build` and `solve` give its particles, bonds and elastic solution
as arrays of numpy. Docs: docs/python.md, docs/case_file.md.
"""

from ._core import Problem, Row, __version__, build_summary
from .case import Case, case_schema, parse_case, read_case
from .errors import Error, FileError, InputError, SolverError
from .events import DamageState, EventRow, EventRun
from .mesh import Mesh
from .problem import ElasticSolution, build, solve
from .result import Result, read_result, run
from .scans import ScanProgress, ScanResult, read_scan, scan
from .summary import Summary
from .time_run import TimeRow, TimeRun

__all__ = [
    "Case",
    "DamageState",
    "ElasticSolution",
    "Error",
    "EventRow",
    "EventRun",
    "FileError",
    "InputError",
    "Mesh",
    "Problem",
    "Result",
    "Row",
    "ScanProgress",
    "ScanResult",
    "SolverError",
    "Summary",
    "TimeRow",
    "TimeRun",
    "__version__",
    "build",
    "build_summary",
    "case_schema",
    "parse_case",
    "read_case",
    "read_result",
    "read_scan",
    "run",
    "scan",
    "solve",
]
