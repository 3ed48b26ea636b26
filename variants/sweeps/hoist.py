"""A hoist over time: forces of rope and support, stress, how the load rises and the beams bend; table, CSV, JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...plans.hoist.course import Course, course, end_of, marks
from ...plans.hoist.forces import Forces
from ...plans.hoist.solve import SolvedHoist
from .sweeps import SizedSweep, column_table, columns_csv, columns_json

TABLED = 25  # times in the table, beside the marks


@dataclass(frozen=True, slots=True, repr=False)
class HoistSweep(SizedSweep):
    """A hoist over time, until one period after the lift-off; `positions` times, None for as many as are usual."""

    usual, places, not_drawn = 361, "times", "hoist-sweep-drawing"

    @property
    def solved(self) -> Forces:
        """The forces, and the motion where the formulas are not valid."""
        return SolvedHoist.of(self.case.solved).forces

    @property
    def marks(self) -> Mapping[str, float]:
        """Times of the lift-off and of the greatest and least forces, s."""
        return marks(self.solved.found, self.solved.motion)

    def at(self, t: NDArray[np.float64]) -> Course:
        """Return the hoist at times of shape (N,), s."""
        return course(self.solved.found, self.solved.motion, t)

    def table(self, language: str | None = None) -> str:
        """Return even times with the marks among them."""
        words = self._words(language)
        even = self._times(self.positions or TABLED)
        heads: dict[float, list[str]] = {float(t): [] for t in even}
        for name, at in self.marks.items():
            heads.setdefault(at, []).append(name)
        found = self.at(np.array(sorted(heads)))
        names = [", ".join(heads[t]) for t in sorted(heads)]
        return "\n\n".join((column_table(found.columned, names, words), *self._warned(words)))

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV."""
        found = self.at(self._times(self.count))
        return columns_csv(found.columned, self._words(language), {"bears": found.states})

    def _data(self) -> dict[str, Any]:
        """Return columns, what bears the load when, the marks, and whether the formulas are valid."""
        swept = self.at(self._times(self.count))
        return {
            "valid": self.solved.motion is None,
            "columns": columns_json(swept.columned),
            "bears": list(swept.states),
            "marks": dict(self.marks),
        }

    def _times(self, count: int) -> NDArray[np.float64]:
        return np.linspace(0.0, end_of(self.solved.found, self.solved.motion), count)


SWEEP = HoistSweep
