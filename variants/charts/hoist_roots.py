"""The chart of ways to the lift-off of a hoist: rows, table, CSV, JSON, picture."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.words import Words
from ...plans.hoist.finders import FINDERS
from ...plans.hoist.root_race import RootRace, Ways
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, finite, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("root", "method", "evaluation", "error", "stops", "fails")
OWN, TRIPLE = "own", "triple"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HoistRootsChart:
    """Ways to the root of the hoist, and to one that is nearly triple."""

    heading: ClassVar[str] = "chart.roots"
    scene: Scene
    found: RootRace

    @property
    def _of_roots(self) -> dict[str, Ways]:
        return {OWN: self.found.own, TRIPLE: self.found.triple}

    def table(self, words: Words) -> str:
        """Return how many evaluations every method takes to which error."""
        parts = []
        for name, ways in self._of_roots.items():
            rows = [[words["chart.method"], words["chart.hoist.evaluations"], words["chart.hoist.reached"]]]
            for method in FINDERS:
                found = ways.found[method]
                failed = math.isnan(found.root)
                said = words["chart.hoist.fails"].format(method=words[f"chart.{method}"])
                cells = [said, "–", "–"] if failed else [words[f"chart.{method}"], str(found.evaluations)]
                rows.append(cells if failed else [*cells, short(words, ways.error(method))])
            head = words[f"chart.hoist.{name}_root"].format(x=words.short(ways.root, 7))
            parts.append(f"{head}\n{aligned(rows)}")
        return "\n\n".join((*parts, wrapped(words["chart.hoist.roots_note"])))

    def _items(self) -> Iterator[tuple[str, str, int, float | None, int, bool]]:
        for name, ways in self._of_roots.items():
            for method in FINDERS:
                found = ways.found[method]
                for i, error in enumerate(ways.errors[method].tolist(), 1):
                    yield name, method, i, finite(error), found.evaluations, math.isnan(found.root)

    def csv(self, words: Words) -> bytes:
        """Return a row for every evaluation."""
        rows: list[list[Cell]] = [[*item[:5], int(item[5])] for item in self._items()]
        return as_csv(HEAD, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all of it as data."""
        return {
            name: {
                "root": ways.root,
                "methods": {
                    method: {
                        "evaluations": ways.found[method].evaluations,
                        "error": finite(ways.error(method)),
                        "errors": [finite(error) for error in ways.errors[method].tolist()],
                    }
                    for method in FINDERS
                },
            }
            for name, ways in self._of_roots.items()
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.hoist_roots import roots_page

        return roots_page(self.found, words, self.scene.title(self.heading))
