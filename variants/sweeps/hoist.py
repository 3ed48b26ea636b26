"""A hoist over time: forces of rope and support, stress, how the load rises and the beams bend; table, CSV, JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...plans.hoist.forces import Forces, course
from ...plans.hoist.solve import SolvedHoist
from ...plans.solved import Columned
from .sweeps import Rows, SizedSweep

TABLED = 25  # times in the table, beside the marks


class HoistSweep(SizedSweep):
    """A hoist over time, until one period after the lift-off; `positions` times, None for as many as are usual."""

    usual, places, not_drawn = 361, "times", "hoist-sweep-drawing"

    @property
    def solved(self) -> Forces:
        """The forces, and the motion where the formulas are not valid."""
        return SolvedHoist.of(self.case.solved).forces

    def _places(self, count: int) -> Any:
        return np.linspace(0.0, self.solved.end, count)

    def _columns(self, places: Any) -> Sequence[Columned]:
        return course(self.solved, places).columned

    def _rows(self) -> Rows:
        """Return even times with the marks among them."""
        heads: dict[float, list[str]] = {float(t): [] for t in self._places(self.positions or TABLED)}
        for name, at in self.solved.marks.items():
            heads.setdefault(at, []).append(name)
        times = sorted(heads)
        return [", ".join(heads[t]) for t in times], self._columns(np.array(times))

    def _states(self, places: Any) -> Mapping[str, Sequence[str]]:
        return {"bears": course(self.solved, places).states}

    def _data(self) -> dict[str, Any]:
        """Return columns, what bears the load when, the marks, and whether the formulas are valid."""
        states = self._states(self._places(self.count))
        return {"valid": self.solved.motion is None, **super()._data(), **states, "marks": self.solved.marks}


SWEEP = HoistSweep
