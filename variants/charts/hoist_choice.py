"""The chart of where load and drum of a hoist may stand: rows, tables, CSV, JSON, picture."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...drawing.words import Words
from ...plans.hoist.choice import Choice
from ...scales.units import format_unit, unit
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("beta_0", "beta_2", "F_max [N]", "sigma_max [Pa]", "safety", "permitted", "formulas")
EVERY = 5  # of the places stands in the tables
TABLED = (("F_max", "kN"), ("sigma_max", "MPa"))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HoistChoiceChart:
    """The spectrum of forces and stresses over the places of load and drum; `S` is the area of the rope, m^2."""

    heading: ClassVar[str] = "chart.choice"
    scene: Scene
    found: Choice
    S: float

    def table(self, words: Words) -> str:
        """Return forces and stresses over both places, a star where they are permitted, and what the loop finds."""
        from ...drawing.charts.hoist_choice import said

        grids = [self._grid(name, of, words) for name, of in TABLED]
        return "\n\n".join((*grids, "\n".join(said(self.found, words))))

    def _grid(self, name: str, of: str, words: Words) -> str:
        grid = self.found.spectrum
        values: NDArray[np.float64] = getattr(grid, name)
        shown = unit(of)
        rows = [["β₀ \\ β₂", *(words.short(float(beta), 3) for beta in grid.beta_2[::EVERY])]]
        for i in range(0, len(grid.beta_0), EVERY):
            cells = [
                words.short(shown.from_si(float(values[i, j])), 4) + ("*" if grid.permitted[i, j] else " ")
                for j in range(0, len(grid.beta_2), EVERY)
            ]
            rows.append([words.short(float(grid.beta_0[i]), 3), *cells])
        head = words["chart.hoist.choice_key"].format(name=name, unit=format_unit(of, words.language))
        return f"{head}\n{aligned(rows, ())}"

    def csv(self, words: Words) -> bytes:
        """Return a row for every pair of places."""
        grid = self.found.spectrum
        rows: list[list[Cell]] = [
            [
                round(float(grid.beta_0[i]), 6),
                round(float(grid.beta_2[j]), 6),
                *(float(column[i, j]) for column in (grid.F_max, grid.sigma_max, grid.safety)),
                int(grid.permitted[i, j]),
                int(grid.formulas[i, j]),
            ]
            for i, j in np.ndindex(*grid.F_max.shape)
        ]
        return as_csv(HEAD, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all of it as data."""
        found, grid = self.found, self.found.spectrum
        columns = ("beta_0", "beta_2", "F_max", "sigma_max", "safety", "permitted", "formulas")
        return {
            "given": asdict(found.given),
            "best": asdict(found.best),
            "safety_required": found.K,
            "found": found.found,
            "trials": [asdict(trial) for trial in found.trials],
            "spectrum": {name: getattr(grid, name).tolist() for name in columns},
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.hoist_choice import choice_page

        return choice_page(self.found, self.S, words, self.scene.title(self.heading))
