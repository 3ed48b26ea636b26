"""A hoist over time: forces of rope and support, stress, how the load rises and the beams bend; table, CSV, JSON."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...plans.hoist.forces import Course, Forces, course
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

    def table(self, language: str | None = None) -> str:
        """Return even times with the marks among them."""
        words = self._words(language)
        even = self._times(self.positions or TABLED)
        heads: dict[float, list[str]] = {float(t): [] for t in even}
        for name, at in self.solved.marks.items():
            heads.setdefault(at, []).append(name)
        found = course(self.solved, np.array(sorted(heads)))
        names = [", ".join(heads[t]) for t in sorted(heads)]
        return "\n\n".join((column_table(found.columned, names, words), *self._warned(words)))

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV."""
        swept = self._swept()
        return columns_csv(swept.columned, self._words(language), {"bears": swept.states})

    def _data(self) -> dict[str, Any]:
        """Return columns, what bears the load when, the marks, and whether the formulas are valid."""
        swept = self._swept()
        return {
            "valid": self.solved.motion is None,
            "columns": columns_json(swept.columned),
            "bears": list(swept.states),
            "marks": self.solved.marks,
        }

    def _times(self, count: int) -> NDArray[np.float64]:
        return np.linspace(0.0, self.solved.end, count)

    def _swept(self) -> Course:
        return course(self.solved, self._times(self.count))


SWEEP = HoistSweep
