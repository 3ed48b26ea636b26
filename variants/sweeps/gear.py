"""A gear pair over the contact of one pair of teeth: sliding, curvatures, how many pairs touch; as table, CSV, JSON."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...plans.gears.course import columns, extremes, marks, zones
from ...plans.gears.solve import SolvedGear
from .sweeps import SizedSweep, column_table, columns_csv, columns_json, extremes_json, extremes_table, millimetres


@dataclass(frozen=True, slots=True, repr=False)
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

    def table(self, language: str | None = None) -> str:
        """Return the contact at its marks, or at the positions asked for; extremes of sliding; zones of contact."""
        words = self._words(language)
        if self.positions is None:
            known = marks(self.solved)
            rows, heads = columns(self.solved, list(known.values())), list(known)
        else:
            rows = columns(self.solved, self._places())
            heads = [str(k) for k in range(self.positions)]
        said = (*self._zones(words), *self._warned(words))
        return "\n\n".join(
            (column_table(rows, heads, words), extremes_table(extremes(self.solved), words), "\n".join(said))
        )

    def _zones(self, words: Words) -> Iterator[str]:
        for zone in zones(self.solved):
            ends = {name: millimetres(getattr(zone, name), words) for name in ("first", "last", "length")}
            yield words["sweep.zone"].format(**ends, pairs=zone.pairs)

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV."""
        return columns_csv(columns(self.solved, self._places()), self._words(language))

    def _data(self) -> dict[str, Any]:
        """Return columns, extremes, marks of the contact, and where how many pairs touch."""
        return {
            "columns": columns_json(columns(self.solved, self._places())),
            "extremes": extremes_json(extremes(self.solved)),
            "marks": marks(self.solved),
            "zones": [{"from": zone.first, "to": zone.last, "pairs": zone.pairs} for zone in zones(self.solved)],
        }

    def _places(self) -> Any:
        return np.linspace(*self.solved.meshing.touching, self.count)


SWEEP = GearSweep
