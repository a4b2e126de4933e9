"""Files that a case names, and those written for its meshes and points of fields."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import FileError
from .mesh import Mesh

Tables = Mapping[str, Any]


def _entries(case: Tables) -> Iterator[tuple[Any, str, str]]:
    """Yields tables with a key that names a file: table, key, name of a file written for it."""
    for table in ("body", "elements"):
        yield case.get(table), "mesh", f"{table}.msh"
    for k, entry in enumerate(_graded(case), start=1):
        yield entry, "file", f"graded_{k}.csv"


def _graded(case: Tables) -> list[Any]:
    fields = case.get("graded")
    return list(fields) if isinstance(fields, (list, tuple)) else []


def _is_part(entry: Any, key: str) -> bool:
    """Whether the value of a key needs a file: a `Mesh`, or points of a field."""
    kind = Mesh if key == "mesh" else np.ndarray
    return isinstance(entry, Mapping) and isinstance(entry.get(key), kind)


def parts_of(case: Tables) -> dict[str, Callable[[], str]]:
    """Returns the texts of meshes and points of fields by the names of their files."""
    return {
        name: entry[key]._text if key == "mesh" else
        partial(_points_text, entry[key], entry.get("column", "factor"))
        for entry, key, name in _entries(case) if _is_part(entry, key)
    }


def named(case: Tables, prefix: str = "", origin: Path | None = None) -> dict[str, Any]:
    """Returns the tables of a case with names of files in place of meshes and points.

    Args:
        prefix: before the name of each file
        origin: folder in which names of other files begin, to make them absolute
    """
    renamed = [
        {**entry, key: prefix + name if _is_part(entry, key) else absolute(entry[key], origin)}
        if isinstance(entry, Mapping) and key in entry else entry
        for entry, key, name in _entries(case)
    ]
    tables = dict(case)
    for table, entry in zip(("body", "elements"), renamed, strict=False):
        if table in case:
            tables[table] = entry
    if _graded(case):
        tables["graded"] = renamed[2:]
    return tables


def absolute(name: Any, origin: Path | None) -> Any:
    """Returns names of files, one or a list, that begin in a folder; other values as they are."""
    if isinstance(name, list):
        return [absolute(entry, origin) for entry in name]
    return origin / name if origin and isinstance(name, (str, PathLike)) else name


def write_parts(case: Tables, folder: Path, prefix: str = "") -> None:
    """Writes meshes and points of fields."""
    for name, text in parts_of(case).items():
        (folder / (prefix + name)).write_text(text(), encoding="utf-8")


@contextlib.contextmanager
def parts_folder(case: Tables) -> Iterator[Path | None]:
    """Writes meshes and points of a case to a temporary folder, while C++ reads them."""
    if not parts_of(case):
        yield None
        return
    with tempfile.TemporaryDirectory(prefix="perilink-") as folder:
        write_parts(case, Path(folder))
        yield Path(folder)


@contextlib.contextmanager
def parts_beside_results(case: Tables, folder: Path, *, resume: bool) -> Iterator[Path | None]:
    """Writes meshes and points of a case to the directory of its results.

    If a run is refused, before it has written its case.toml, the directory is left as it was.

    Raises:
        FileError: a run would go on with another mesh or other points
    """
    texts = {folder / name: text().encode() for name, text in parts_of(case).items()}
    if not texts:
        yield None
        return
    kept = folder / "case.toml"
    stamp = _stamp(kept)
    before = {file: file.read_bytes() if file.exists() else None for file in texts}
    changed = [file for file, text in texts.items() if before[file] != text]
    for file in changed if resume and stamp else []:
        if before[file] is not None:
            raise FileError(f"{file}: differs from this case: the results are of another one\n"
                            "  begin it again with force=True, or choose another directory")
    is_new = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    try:
        for file in changed:
            file.write_bytes(texts[file])
        yield folder
    except BaseException:
        if _stamp(kept) == stamp:
            for file in changed:
                _restore(file, before[file])
            if is_new:
                with contextlib.suppress(OSError):
                    folder.rmdir()
        raise


def _stamp(file: Path) -> tuple[int, int] | None:
    """Returns what changes whenever a file is written anew; None: there is no file."""
    if not file.exists():
        return None
    status = file.stat()
    return status.st_ino, status.st_mtime_ns


def _restore(file: Path, content: bytes | None) -> None:
    if content is None:
        file.unlink(missing_ok=True)
    else:
        file.write_bytes(content)


def _points_text(points: NDArray[Any], column: str) -> str:
    """Returns the text of a file of points, with all digits."""
    if points.ndim != 2 or points.shape[1] not in (3, 4):
        raise ValueError(f"points of a field have the shape {points.shape}; allowed are (n, 3) "
                         "with x, y, factor and (n, 4) with x, y, z, factor")
    names = [*"xyz"[: points.shape[1] - 1], column]
    rows = points.astype(float).tolist()
    return "\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows), ""])
