"""Models of cases, and their elastic solution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .case import Case, as_case
from .parts import parts_folder


@dataclass(frozen=True)
class ElasticSolution:
    """The elastic equilibrium of a body at load factor 1.

    Attributes:
        displacement: motion of the particles, shape (particles, width): displacements [length],
            then rotations [-]
        stress: stress of the particles, shape (particles, 6): xx, yy, zz, xy, yz, xz
            [force/length^2]; None for shells, beams and linear elements
        reactions: by support: mean position ``at``, ``force`` and ``moment``, three numbers each
        gauges: values of the gauges by name
        load: load [force]
        load_displacement: work-conjugate displacement [length]
        strain_energy: stored energy [force length]
        residual: relative residual force [-]
    """

    displacement: NDArray[np.float64]
    stress: NDArray[np.float64] | None
    reactions: dict[str, dict[str, list[float]]]
    gauges: dict[str, float]
    load: float
    load_displacement: float
    strain_energy: float
    residual: float


def build(case: Case, *, threads: int | None = None) -> _core.Problem:
    """Builds the particles, bonds, supports and loads of a case.

    Raises:
        InputError: the case is wrong or does not fit its body
    """
    case = as_case(case)
    with parts_folder(case) as folder:
        return _core.build(case._parse(folder), threads or 0)


def solve(problem: _core.Problem | Case, *, threads: int | None = None) -> ElasticSolution:
    """Solves for the elastic equilibrium at load factor 1, whatever the analysis type of the case.

    Of a case with stages the loads are those of the first one.

    Raises:
        SolverError: the body has no unique equilibrium
    """
    if not isinstance(problem, _core.Problem):
        problem = build(problem, threads=threads)
    values: dict[str, Any] = _core.solve(problem, threads or 0)
    return ElasticSolution(**values)
