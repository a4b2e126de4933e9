"""Cases as dictionaries of Python."""

from __future__ import annotations

import copy
import json
import re
import tempfile
import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InputError
from .mesh import Mesh


class Case(dict[str, Any]):
    """A case: the tables and keys of docs/case_file.md as nested dictionaries and lists.

    ``Case(body={"spacing": 5.0, ...}, materials=[{...}], analysis={"type": "damage"})`` builds one,
    `read_case` reads one. Values may be numbers (also of numpy), texts, booleans, lists, arrays,
    dictionaries and paths; keys with the value ``None`` are left out. ``body["mesh"]`` and
    ``elements["mesh"]`` may be a `Mesh`; ``graded[k]["file"]`` may be an array with a row
    ``x, y, factor`` (3D: ``x, y, z, factor``) per point. Change entries as in any dictionary:
    ``case["body"]["spacing"] = 2.5``.

    Args:
        tables: keys and tables, or another case
        path: name of the case in messages; names of other files begin at its folder
        **more: further keys and tables
    """

    def __init__(
        self,
        tables: Mapping[str, Any] | None = None,
        /,
        *,
        path: str | PathLike[str] = "case",
        **more: Any,
    ) -> None:
        super().__init__(copy.deepcopy(dict(tables or {})), **more)
        self.path: str = fspath(path)
        self._source: str | None = None  # text of the file that the case was read from

    def copy(self) -> Case:
        """Returns a copy that shares no table with this case."""
        return copy.deepcopy(self)

    def toml(self) -> str:
        """Returns the text of the case file: of the file itself while nothing has changed.

        A `Mesh` and the points of a field have the name of the file that `write` gives them.
        """
        return self._unchanged() or _toml(self, self._names())

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the case file.

        Beside it, a `Mesh` is written as body.msh or elements.msh, points of fields as
        graded_1.csv and so on.
        """
        target = Path(path)
        self._write_parts(target.parent)
        target.write_text(self.toml(), encoding="utf-8")

    def check(self) -> Case:
        """Checks all values and returns the case with all defaults.

        Raises:
            InputError: the first value at fault. Faults that depend on the body are found by
                `build` and `run`.
        """
        return Case(tomllib.loads(self._parse().resolved()), path=self.path)

    def _parse(self, folder: Path | None = None) -> _core.CaseFile:
        """Reads and checks the case.

        Args:
            folder: receives meshes and points of fields; without one they are only named
        """
        source = self._unchanged()
        if source is not None:
            return _core.parse_case(source, self.path, True)
        text = self.toml()
        if folder is not None:
            text = _toml(self, self._write_parts(folder))
        try:  # lines of this text mean nothing to the user
            return _core.parse_case(text, self.path, False)
        except InputError as error:
            line = f":{error.line}" if error.line > 0 else ""
            message = str(error).replace(f"{self.path}{line}: ", f"{self.path}: ", 1)
            raise InputError(message, error.path, 0, error.key) from None

    def _unchanged(self) -> str | None:
        """Returns the text that the case was read from, if nothing has changed since."""
        if self._source is None:
            return None
        # Texts are compared: arrays of numpy have no single answer to ==.
        same = _toml(tomllib.loads(self._source), {}) == _toml(self, self._names())
        return self._source if same else None

    def _parts(self) -> list[tuple[str, Any, Callable[[], str]]]:
        """Returns meshes and points of fields: name of the file, value of the key, text."""
        found: list[tuple[str, Any, Callable[[], str]]] = []
        for table in ("body", "elements"):
            entry = self.get(table)
            if isinstance(entry, dict) and isinstance(entry.get("mesh"), Mesh):
                found.append((f"{table}.msh", entry["mesh"], entry["mesh"]._text))
        fields = self.get("graded")
        for k, entry in enumerate(fields if isinstance(fields, (list, tuple)) else (), start=1):
            if isinstance(entry, dict) and isinstance(entry.get("file"), np.ndarray):
                text = partial(_points_text, entry["file"], entry.get("column", "factor"))
                found.append((f"graded_{k}.csv", entry["file"], text))
        return found

    def _names(self) -> dict[int, str]:
        return {id(part): name for name, part, _ in self._parts()}

    def _write_parts(self, folder: Path) -> dict[int, str]:
        """Writes meshes and points of fields and returns the paths of their files."""
        paths = {}
        for name, part, text in self._parts():
            file = folder / name
            file.write_text(text(), encoding="utf-8")
            paths[id(part)] = str(file.resolve())
        return paths


def _points_text(points: NDArray[Any], column: str) -> str:
    """Returns the text of a file of points, with all digits."""
    if points.ndim != 2 or points.shape[1] not in (3, 4):
        raise ValueError(f"points of a field have the shape {points.shape}; allowed are (n, 3) "
                         "with x, y, factor and (n, 4) with x, y, z, factor")
    names = [*"xyz"[: points.shape[1] - 1], column]
    rows = points.astype(float).tolist()
    return "\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows), ""])


# help(Case) lists every key.
Case.__doc__ = f"{Case.__doc__}\n    Tables and keys (units in L, F, T, M):\n{_core.case_reference()}"


def case_schema() -> dict[str, Any]:
    """Returns the JSON schema of case files: types, ranges, defaults and meanings of all keys."""
    return json.loads(_core.case_json_schema())


def parse_case(text: str, path: str | PathLike[str] = "case") -> Case:
    """Reads and checks a case from the text of a case file.

    Args:
        text: TOML, see docs/case_file.md
        path: name of the case in messages; names of other files begin at its folder

    Raises:
        InputError: with file, line, key, value, what is allowed and a suggestion
    """
    _core.parse_case(text, fspath(path), True)
    case = Case(tomllib.loads(text), path=path)
    case._source = text
    return case


def read_case(path: str | PathLike[str]) -> Case:
    """Reads and checks a case file.

    Raises:
        InputError: with file, line, key, value, what is allowed and a suggestion
        FileError: the file cannot be read
    """
    _core.read_case(fspath(path))
    case = Case(path=path)
    case._source = Path(path).read_text(encoding="utf-8-sig")
    case.update(tomllib.loads(case._source))
    return case


_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+\Z")


def _toml(case: Mapping[str, Any], names: Mapping[int, str]) -> str:
    """Returns a case as TOML: plain keys, then a header for each table and entry of a list.

    Args:
        names: names of the files of meshes and points, by their identity
    """

    def key(name: object) -> str:
        if not isinstance(name, str):
            raise TypeError(f"keys of a case are texts, not {name!r}")
        return name if _BARE_KEY.match(name) else json.dumps(name, ensure_ascii=False)

    def value(item: Any) -> str:
        if id(item) in names:
            return value(names[id(item)])
        if isinstance(item, (np.generic, np.ndarray)):
            item = item.tolist()
        if isinstance(item, bool):
            return "true" if item else "false"
        if isinstance(item, (int, float)):
            return repr(item)
        if isinstance(item, (str, PathLike)):
            return json.dumps(fspath(item), ensure_ascii=False).replace("\x7f", "\\u007f")
        if isinstance(item, Mapping):
            return "{" + ", ".join(f"{key(k)} = {value(v)}" for k, v in given(item)) + "}"
        if isinstance(item, (list, tuple)):
            return "[" + ", ".join(map(value, item)) + "]"
        raise TypeError(f"a case cannot hold {item!r} of type {type(item).__name__}")

    def given(table: Mapping[str, Any]) -> list[tuple[str, Any]]:
        return [(k, v) for k, v in table.items() if v is not None]

    def is_list_of_tables(item: Any) -> bool:
        return (isinstance(item, (list, tuple)) and len(item) > 0
                and all(isinstance(entry, Mapping) for entry in item))

    plain, tables = [], []
    for name, item in given(case):
        if isinstance(item, Mapping) or is_list_of_tables(item):
            header = f"[{key(name)}]" if isinstance(item, Mapping) else f"[[{key(name)}]]"
            for table in [item] if isinstance(item, Mapping) else item:
                tables += ["", header, *(f"{key(k)} = {value(v)}" for k, v in given(table))]
        else:
            plain.append(f"{key(name)} = {value(item)}")
    return "\n".join([*plain, *tables, ""])


class PartsFolder:
    """Folder for meshes and fields of a case while C++ reads them: a given or a temporary one."""

    def __init__(self, case: Case, given: Path | None = None) -> None:
        self._temporary = None
        self.path = given
        if given is None and case._parts():
            self._temporary = tempfile.TemporaryDirectory(prefix="perilink-")
            self.path = Path(self._temporary.name)

    def __enter__(self) -> Path | None:
        return self.path

    def __exit__(self, *_: object) -> None:
        if self._temporary is not None:
            self._temporary.cleanup()
