"""The chart of steps that integrate a hoist: orders, limits of stability, refusals; rows, table, CSV, JSON, picture."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.words import Words
from ...plans.hoist.integrators import GROWN
from ...plans.hoist.step_limits import StepLimits
from ...plans.hoist.steppers import ORDERS
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, finite, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("method", "step [rad]", "error", "grown", "refused", "order", "limit")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HoistStepsChart:
    """Errors over the step of every method."""

    heading: ClassVar[str] = "chart.hoist_stability"
    scene: Scene
    found: StepLimits

    def table(self, words: Words) -> str:
        """Return order and limit of every method, then errors over the step; a dash where a run is refused."""
        found = self.found
        heads = ("chart.method", "chart.order", "chart.hoist.limit_head", "chart.hoist.refused_from")
        rows = [[words[key] for key in heads]]
        for method in ORDERS:
            order, refused = found.order(method), found.refused_from(method)
            said = "–" if order is None else words.number(order, 2)
            since = words["chart.hoist.never"] if refused is None else words.short(refused, 3)
            rows.append([words[f"chart.{method}"], said, self._limit(method, words), since])
        steps = sorted({float(z) for method in ORDERS for z in found.steps[method]}, reverse=True)
        errors = [[words["chart.hoist.step"], *(words[f"chart.{method}"] for method in ORDERS)]]
        known = {
            (m, z): e for m in ORDERS for z, e in zip(found.steps[m].tolist(), found.errors[m].tolist(), strict=True)
        }
        for z in steps:
            cells = [short(words, known[m, z]) if (m, z) in known else "" for m in ORDERS]
            errors.append([words.short(z, 3), *cells])
        return "\n\n".join((aligned(rows), aligned(errors, ()), wrapped(self.note(words))))

    def _limit(self, method: str, words: Words) -> str:
        limit = self.found.limit(method)
        if math.isinf(limit):
            return "∞"
        return words.short(limit, 5) if limit else words["chart.hoist.always"]

    def note(self, words: Words) -> str:
        """Return what is refused, and why."""
        grown = words.short(100.0 * (GROWN - 1.0), 3)
        return words["chart.hoist.limits_note"].format(grown=grown, ratio=words.short(self.found.ratio, 3))

    def _items(self) -> Iterator[tuple[str, float, float | None, float, float | None, float]]:
        found = self.found
        for method in ORDERS:
            columns = (found.steps[method], found.errors[method], found.grown[method])
            for z, error, grown in zip(*(column.tolist() for column in columns), strict=True):
                yield method, z, finite(error), grown, found.order(method), found.limit(method)

    def csv(self, words: Words) -> bytes:
        """Return a row for every method and step; no error where a run is refused."""
        rows: list[list[Cell]] = [
            [method, z, error, finite(grown), int(error is None), order, finite(limit)]
            for method, z, error, grown, order, limit in self._items()
        ]
        return as_csv(HEAD, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all of it as data."""
        found = self.found
        return {
            "methods": {
                method: {
                    "order": found.order(method),
                    "limit": finite(found.limit(method)),
                    "stable": math.isinf(found.limit(method)),
                    "refused_from": found.refused_from(method),
                }
                for method in ORDERS
            },
            "runs": [
                {"method": method, "step": z, "error": error, "grown": finite(grown), "refused": error is None}
                for method, z, error, grown, _, _ in self._items()
            ],
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.hoist_steps import steps_page

        return steps_page(self.found, words, self.scene.title(self.heading), self.note(words))
