"""What runs that are advanced row by row share."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _core

Row = TypeVar("Row", _core.EventRow, _core.TimeRow)
Stepper = TypeVar("Stepper", _core.Stepper, _core.TimeStepper)


class RowRun(Iterator[Row], Generic[Row, Stepper]):
    """A run that is advanced row by row. Arrays are copies of the state in the last row."""

    _stepper: Stepper

    def __iter__(self) -> RowRun[Row, Stepper]:
        return self

    def __next__(self) -> Row:
        row = self._stepper.next()
        if row is None:
            raise StopIteration
        return row

    @property
    def displacement(self) -> NDArray[np.float64]:
        """Motion of the particles, shape (particles, width) [length], [-]."""
        return self._stepper.displacement()

    @property
    def damage(self) -> NDArray[np.float64]:
        """Damage of the particles, shape (particles,) [-]."""
        return self._stepper.damage()

    @property
    def stress(self) -> NDArray[np.float64] | None:
        """Stress of the particles, shape (particles, 6): xx, yy, zz, xy, yz, xz [force/length^2].

        None for shells, beams and state-based particles, and with Green's strains.
        """
        return self._stepper.stress()

    @property
    def stiffness_ratios(self) -> NDArray[np.float64]:
        """Present over intact stiffness of the elements, shape (elements,) [-].

        0: broken, or across a closed pre-crack (`Problem.bonds` has these from the start).
        """
        return self._stepper.stiffness_ratios()

    @property
    def gauges(self) -> dict[str, float]:
        """Values of the gauges by name."""
        return self._stepper.gauges()
