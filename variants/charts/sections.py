"""The chart of a cam's error against its number of sections: rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.words import Words
from ...plans.cams.convergence import DRAWINGS, Convergence, compared, convergence
from ...plans.cams.solve import SolvedCam, unit_of
from ...plans.hands.hand import PRESETS
from ...scales.names import unknown
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, finite, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("drawn_by", "jumps", "sections", "quantity", "error [%]", "order", "best")
NOBODY = "exact"  # draws chords without errors


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SectionsChart:
    """Errors of the diagrams by chords against the number of sections, with and without errors of drawing."""

    heading: ClassVar[str] = "chart.sections"
    scene: Scene
    found: Convergence

    def table(self, words: Words) -> str:
        """Return errors without those of drawing and their orders, then what each hand keeps, and its best number."""
        found = self.found
        names = [f"{name}, %" for name in found.quantities]
        rows = [[words["chart.jumps"], words["chart.sections_n"], *names]]
        for where, counts in found.sections.items():
            for i, n in enumerate(counts):
                cells = [short(words, 100.0 * float(found.errors[where, name][i])) for name in found.quantities]
                rows.append([words[f"chart.{where}"] if i == 0 else "", str(n), *cells])
            orders = [_order(found.order(where, name), words) for name in found.quantities]
            rows.append(["", words["chart.order"], *orders])
        by_hand = [[words["chart.hand"], words["chart.sections_n"], *names]]
        for hand in PRESETS:
            for i, n in enumerate(found.drawn):
                cells = [short(words, 100.0 * float(found.hands[hand, name][i])) for name in found.quantities]
                by_hand.append([words[f"hand.{hand}"] if i == 0 else "", str(n), *cells])
            best = [str(found.best(hand, name)[0]) for name in found.quantities]
            by_hand.append(["", words["chart.best"], *best])
        said = wrapped(words["chart.sections_note"].format(n=DRAWINGS))
        return "\n\n".join((aligned(rows), aligned(by_hand), said))

    def _items(self) -> Iterator[tuple[str, str, int, str, float, float | None, bool | None]]:
        found = self.found
        for where, counts in found.sections.items():
            for i, n in enumerate(counts):
                for name in found.quantities:
                    error = float(found.errors[where, name][i])
                    yield NOBODY, where, n, name, error, found.order(where, name), None
        for hand in PRESETS:
            for i, n in enumerate(found.drawn):
                for name in found.quantities:
                    best = found.best(hand, name)[0] == n
                    yield hand, "nodes", n, name, float(found.hands[hand, name][i]), None, best

    def csv(self, words: Words) -> bytes:
        """Return all errors: signed those of chords, of hands what 95 % of drawings keep."""
        rows: list[list[Cell]] = [
            [by, where, n, name, 100.0 * error, order, None if best is None else int(best)]
            for by, where, n, name, error, order, best in self._items()
        ]
        return as_csv(HEAD, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all errors as data, in parts of the exact values."""
        return {
            "exact": {name: {"value": value, "unit": unit_of(name)} for name, value in self.found.exact.items()},
            "orders": {
                where: {name: finite(self.found.order(where, name)) for name in self.found.quantities}
                for where in self.found.sections
            },
            "best": {
                hand: {name: self.found.best(hand, name)[0] for name in self.found.quantities} for hand in PRESETS
            },
            "errors": [
                {"drawn_by": by, "jumps": where, "sections": n, "quantity": name, "error": finite(error)}
                for by, where, n, name, error, _, _ in self._items()
            ],
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.sections import sections_page

        return sections_page(self.found, words, self.scene.title(self.heading))


def sections_chart(scene: Scene, solved: SolvedCam, quantities: Sequence[str]) -> SectionsChart:
    """Draw the diagrams with more and more sections.

    Raises
    ------
    InputError
        An unknown quantity, or diagrams that have no errors.
    """
    known = compared(solved)
    for name in quantities:
        if name not in known:
            raise unknown("quantity-unknown", name, known)
    hands = {name: preset.hand for name, preset in PRESETS.items()}
    return SectionsChart(scene, convergence(solved, hands, quantities))


def _order(value: float | None, words: Words) -> str:
    return "–" if value is None else words.number(value, 2)
