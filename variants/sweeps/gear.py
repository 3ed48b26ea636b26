"""A gear pair over the contact of one pair of teeth: sliding, curvatures, how many pairs touch; as table, CSV, JSON."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...drawing.words import Words
from ...plans.gears.course import columns, extremes, marks, zones
from ...plans.gears.solve import SolvedGear
from ...plans.solved import Columned, Ends
from .sweeps import Rows, SizedSweep, millimetres


class GearSweep(SizedSweep):
    """A pair over the contact of one pair of teeth.

    `positions` divide the active line evenly, its ends among them; None for the marks of the meshing in the table, and
    every hundredth in files.
    """

    usual, not_drawn = 101, "gear-sweep-drawing"  # every hundredth of the active line

    @property
    def solved(self) -> SolvedGear:
        """The pair."""
        return SolvedGear.of(self.case.solved)

    def _places(self, count: int) -> Any:
        return np.linspace(*self.solved.meshing.touching, count)

    def _columns(self, places: Any) -> list[Columned]:
        return columns(self.solved, places)

    def _rows(self) -> Rows:
        if self.positions is not None:
            return super()._rows()
        known = marks(self.solved)
        return list(known), self._columns(list(known.values()))

    def _extremes(self) -> list[Ends]:
        return extremes(self.solved)

    def _remarks(self, words: Words) -> list[str]:
        """Say on which zones how many pairs of teeth touch."""
        lines = []
        for zone in zones(self.solved):
            ends = {name: millimetres(getattr(zone, name), words) for name in ("first", "last", "length")}
            lines.append(words["sweep.zone"].format(**ends, pairs=zone.pairs))
        return ["\n".join((*lines, *self._warned(words)))]

    def _data(self) -> dict[str, Any]:
        """Return columns, extremes, marks of the contact, and where how many pairs touch."""
        found = [{"from": zone.first, "to": zone.last, "pairs": zone.pairs} for zone in zones(self.solved)]
        return super()._data() | {"marks": marks(self.solved), "zones": found}


SWEEP = GearSweep
