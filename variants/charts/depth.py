"""The chart of the model's depth of one variant: rows, table, CSV, JSON, picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.charts.depth import verdict
from ...drawing.words import Words
from ...plans.linkages.accuracy.depth import Cost, Depth, depth
from ...plans.linkages.cycles.cycle import Cycle
from ...plans.quantities import unit_of
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, driver_unit, finite, place, place_column, place_head, place_si, place_value, short

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("without", "parts", "balance_max [%]", "balance_rms [%]", "reaction_max [%]", "reaction_rms [%]")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DepthChart:
    """What simplifications cost over the cycle."""

    heading: ClassVar[str] = "chart.depth"
    scene: Scene
    cycle: Cycle
    found: Depth

    def table(self, words: Words) -> str:
        """Return a row for every simplification, then what the scene needs."""
        found = self.found
        names = [found.balance, words["chart.reactions"]][: 2 if found.reaction else 1]
        head = ["", *(f"{name}, {words[f'chart.{key}']}, %" for name in names for key in ("max", "rms"))]
        head.append(place_head(self.cycle, words))
        rows = [[self._named(cost, words), *self._cells(cost, words)] for cost in found.costs]
        return "\n".join((aligned([head, *rows]), "", verdict(found, words, plain=True)))

    def _named(self, cost: Cost, words: Words) -> str:
        if cost.parts == (cost.key,):
            return words["chart.without"].format(part=cost.key)
        return words[f"chart.without.{cost.key}"]

    def _cells(self, cost: Cost, words: Words) -> list[str]:
        values = [cost.balance, cost.balance_rms]
        values += [cost.reaction or 0.0, cost.reaction_rms or 0.0] if self.found.reaction else []
        tidy = [0.0 if value < 1e-10 else value for value in values]
        return [*(short(words, value) for value in tidy), place(self.cycle, words, cost.place)]

    def csv(self, words: Words) -> bytes:
        """Return all simplifications."""
        rows: list[list[Cell]] = [
            [c.key, " ".join(c.parts), c.balance, c.balance_rms, c.reaction, c.reaction_rms, self._place(c)]
            for c in self.found.costs
        ]
        return as_csv((*HEAD, place_column(driver_unit(self.cycle))), rows, words)

    def _place(self, cost: Cost) -> float:
        return place_value(driver_unit(self.cycle), cost.place)

    def to_json(self) -> dict[str, Any]:
        """Return all simplifications as data."""
        found = self.found
        largest = {found.balance: {"value": found.largest_balance, "unit": unit_of(found.balance)}}
        if found.reaction:
            largest[found.reaction] = {"value": found.largest_reaction or 0.0, "unit": "N"}
        return {
            "balance": found.balance,
            "reaction": found.reaction,
            "largest": largest,
            "tolerance": found.tolerance,
            "needed": list(found.needed),
            "spare": list(found.spare),
            "spare_cost": found.together.worst,
            "costs": [self._item(cost) for cost in found.costs],
        }

    def _item(self, cost: Cost) -> dict[str, Any]:
        return {
            "without": cost.key,
            "parts": list(cost.parts),
            "balance": {"max": cost.balance, "rms": cost.balance_rms},
            "reaction": None if cost.reaction is None else {"max": cost.reaction, "rms": finite(cost.reaction_rms)},
            "at": place_si(driver_unit(self.cycle), cost.place),
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.depth import depth_page

        return depth_page(self.found, words, self.scene.title(self.heading))


def depth_chart(scene: Scene, cycle: Cycle, tolerance: float) -> DepthChart:
    """Find what simplifications cost.

    Raises
    ------
    InputError
        With the key `chart-no-forces`.
    """
    return DepthChart(scene, cycle, depth(cycle, tolerance))
