"""Meshes from arrays."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

_ELEMENT_TYPES = {1: 1, 2: 2, 3: 4}  # gmsh's lines, triangles, tetrahedra, by dimension


class Mesh:
    """A mesh of triangles (2D) or tetrahedra (3D) for ``case["body"]["mesh"]``.

    Args:
        points: positions of the vertices, shape (n, 2) or (n, 3) [length]
        cells: vertices of each cell, numbers from 0, shape (m, 3) for triangles or (m, 4) for
            tetrahedra
        groups: named parts of the mesh, for ``group`` in ``[[regions]]`` and others. A list of
            numbers, shape (k,), means cells. An array of vertices, shape (k, dim) or (k, 2), means
            edges or triangles of cells, or lines.
    """

    def __init__(
        self, points: ArrayLike, cells: ArrayLike, groups: Mapping[str, ArrayLike] | None = None
    ) -> None:
        self.points: NDArray[np.float64] = np.array(points, dtype=float)
        self.cells: NDArray[np.int64] = _integers(cells, "cells")
        if self.cells.ndim != 2 or self.cells.shape[1] not in (3, 4):
            raise ValueError(f"cells have the shape {self.cells.shape}; allowed are (m, 3) for "
                             "triangles and (m, 4) for tetrahedra")
        self.dim: int = self.cells.shape[1] - 1
        if self.points.ndim != 2 or self.points.shape[1] not in (self.dim, 3):
            raise ValueError(
                f"points have the shape {self.points.shape}; allowed is (n, {self.dim})")
        if not np.isfinite(self.points).all():
            raise ValueError("points: holds nan or inf")
        _check_numbers(self.cells, len(self.points), "cells", "points")
        self.groups: dict[str, NDArray[np.int64]] = {}
        for name, elements in (groups or {}).items():
            self.groups[name] = self._checked_group(name, elements)

    def write(self, path: str | PathLike[str]) -> None:
        """Writes a file of gmsh's format 4.1, which holds every number exactly."""
        Path(path).write_text(self._text(), encoding="utf-8")

    def _checked_group(self, name: str, elements: ArrayLike) -> NDArray[np.int64]:
        what = f"groups[{name!r}]"
        if any(sign in name for sign in '"\n\r'):
            raise ValueError(f"{what}: names must not contain quotes or line ends")
        numbers = _integers(elements, what)
        if numbers.ndim == 1:
            _check_numbers(numbers, len(self.cells), what, "cells")
        elif numbers.ndim == 2 and 2 <= numbers.shape[1] <= self.dim:
            _check_numbers(numbers, len(self.points), what, "points")
        else:
            raise ValueError(f"{what} has the shape {numbers.shape}; allowed are (k,) for cells "
                             f"and (k, {self.dim}) for their sides")
        return numbers

    def _elements(self) -> list[tuple[int, NDArray[np.int64], list[str]]]:
        """Returns the entities: dimension, vertices of their elements, and their groups."""
        cell_groups = {k: v for k, v in self.groups.items() if v.ndim == 1}
        member = np.zeros((len(self.cells), len(cell_groups)), dtype=bool)
        for column, numbers in enumerate(cell_groups.values()):
            member[numbers, column] = True
        patterns, pattern_of = np.unique(member, axis=0, return_inverse=True)
        pattern_of = np.reshape(pattern_of, -1)
        names = list(cell_groups)
        entities = []
        for number, pattern in enumerate(patterns):
            entities.append((self.dim, self.cells[pattern_of == number],
                             [names[k] for k in np.flatnonzero(pattern)]))
        for name, vertices in self.groups.items():
            if vertices.ndim == 2:
                entities.append((vertices.shape[1] - 1, vertices, [name]))
        return entities

    def _text(self) -> str:
        entities = self._elements()
        tags = {name: tag for tag, name in enumerate(self.groups, start=1)}
        dim_of = {name: dim for dim, _, names in entities for name in names}
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(dim_of))]
        lines += [f'{dim} {tags[name]} "{name}"' for name, dim in dim_of.items()]
        lines += ["$EndPhysicalNames", "$Entities"]
        in_order = sorted(enumerate(entities, start=1), key=lambda entry: entry[1][0])
        lines.append(" ".join(str(sum(e[0] == d for e in entities)) for d in range(4)))
        for tag, (_, _, names) in in_order:
            physical = "".join(f" {tags[name]}" for name in names)
            lines.append(f"{tag} 0 0 0 0 0 0 {len(names)}{physical} 0")
        count = len(self.points)
        lines += ["$EndEntities", "$Nodes", f"1 {count} 1 {count}",
                  f"{self.dim} 1 0 {count}", *map(str, range(1, count + 1))]
        padded = np.zeros((count, 3))
        padded[:, : self.points.shape[1]] = self.points
        lines += [f"{x!r} {y!r} {z!r}" for x, y, z in padded.tolist()]
        total = sum(len(vertices) for _, vertices, _ in entities)
        lines += ["$EndNodes", "$Elements", f"{len(entities)} {total} 1 {total}"]
        first = 1
        for tag, (dim, vertices, _) in enumerate(entities, start=1):
            lines.append(f"{dim} {tag} {_ELEMENT_TYPES[dim]} {len(vertices)}")
            for number, row in enumerate((vertices + 1).tolist(), start=first):
                lines.append(f"{number} {' '.join(map(str, row))}")
            first += len(vertices)
        return "\n".join([*lines, "$EndElements", ""])


def _integers(values: ArrayLike, what: str) -> NDArray[np.int64]:
    numbers = np.asarray(values)
    if numbers.size == 0:
        raise ValueError(f"{what}: is empty")
    if not np.issubdtype(numbers.dtype, np.integer):
        raise ValueError(f"{what}: holds {numbers.dtype} numbers; integers are needed")
    return numbers.astype(np.int64)


def _check_numbers(numbers: NDArray[np.int64], count: int, what: str, of: str) -> None:
    for number in (numbers.min(), numbers.max()):
        if not 0 <= number < count:
            raise ValueError(f"{what}: holds the number {number}; "
                             f"{of} have the numbers 0 to {count - 1}")
