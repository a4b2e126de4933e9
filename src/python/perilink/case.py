"""Cases as dictionaries of Python."""

from __future__ import annotations

import copy
import json
import re
import tomllib
from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from .errors import InputError
from .parts import named, write_parts


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
        path: name of the case in messages, by default that of `tables`; names of other files begin
            at its folder
        **more: further keys and tables
    """

    def __init__(
        self,
        tables: Mapping[str, Any] | None = None,
        /,
        *,
        path: str | PathLike[str] | None = None,
        **more: Any,
    ) -> None:
        super().__init__(copy.deepcopy({**(tables or {}), **more}))
        self.path: str = fspath(path or getattr(tables, "path", "case"))
        self._source: str | None = None  # text of the file that the case was read from

    def copy(self) -> Case:
        """Returns a copy that shares no table with this case."""
        return copy.deepcopy(self)

    def toml(self) -> str:
        """Returns the text of the case file: of the file itself while nothing has changed.

        A `Mesh` and points of a field are named body.msh, elements.msh, graded_1.csv and so on.
        """
        return self._unchanged() or _toml(named(self))

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the case file.

        Beside beam.toml, a `Mesh` is written as beam_body.msh or beam_elements.msh, points of
        fields as beam_graded_1.csv and so on. In another folder than that of the case, names of
        other files become absolute.
        """
        target, origin = Path(path), Path(self.path).resolve().parent
        prefix = f"{target.stem}_"
        write_parts(self, target.parent, prefix)
        text = _toml(named(self, prefix, None if origin == target.resolve().parent else origin))
        source = self._unchanged()
        target.write_text(source if source and text == _toml(self) else text, encoding="utf-8")

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
            folder: holds its meshes and points of fields; without one they are only named
        """
        source = self._unchanged()
        if source is not None:
            return _core.parse_case(source, self.path, True)
        text = _toml(named(self, f"{folder.resolve()}/" if folder else ""))
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
        same = _toml(tomllib.loads(self._source)) == _toml(named(self))
        return self._source if same else None


def as_case(case: Case | Mapping[str, Any]) -> Case:
    """Returns a case, also of plain dictionaries."""
    if isinstance(case, Mapping):
        return case if isinstance(case, Case) else Case(case)
    raise TypeError(f"a case is a perilink.Case or a dictionary, not {case!r}; "
                    "read_case(path) reads a file")


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


def _toml(case: Mapping[str, Any]) -> str:
    """Returns a case as TOML: plain keys, then a header for each table and entry of a list."""

    def key(name: object) -> str:
        if not isinstance(name, str):
            raise TypeError(f"keys of a case are texts, not {name!r}")
        return name if _BARE_KEY.match(name) else json.dumps(name, ensure_ascii=False)

    def value(item: Any) -> str:
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
