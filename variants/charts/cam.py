"""The charts of cams: error against the number of sections, speed against accuracy, stability of the diagrams."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import Any

from ...drawing.charts.curves import closing_page, sections_page
from ...drawing.words import Words
from ...plans.cams.chords import DRAWINGS, ROUNDING, WAYS, Convergence, Robustness, compared, convergence, robustness
from ...plans.cams.solve import SolvedCam, unit_of
from ...plans.lab.cams import rivals
from ...scales.names import all_known
from ..tables import Cell, aligned
from . import charts

NOBODY = "exact"  # draws chords without errors
EVERY = 5  # of the places of a line beside a jump stands in the table
ORDINATES = ("speed_top", "speed_last", "stroke_last")


class _SectionsChart(charts.Chart[Convergence]):
    """Errors of the diagrams by chords against the number of sections, with and without errors of drawing."""

    heading, page = "chart.sections", staticmethod(sections_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through errors without those of drawing and orders, then what each hand keeps, and its best number."""
        found, names = self.found, self.found.quantities
        heads = [words["chart.sections_n"], *(f"{name}, %" for name in names)]
        rows, by_hand = [[words["chart.jumps"], *heads]], [[words["chart.hand"], *heads]]
        for where, counts in found.sections.items():
            orders = (found.order(where, name) for name in names)
            last = [words["chart.order"], *("–" if order is None else words.number(order, 2) for order in orders)]
            errors = [found.errors[where, name] for name in names]
            rows += charts.error_rows(words[f"chart.{where}"], [*map(str, counts)], errors, last, words)
        for hand in charts.HANDS:
            last = [words["chart.best"], *(str(found.best(hand, name)[0]) for name in names)]
            errors = [found.hands[hand, name] for name in names]
            by_hand += charts.error_rows(words[f"hand.{hand}"], [*map(str, found.drawn)], errors, last, words)
        yield from (aligned(rows), aligned(by_hand))

    def note(self, words: Words) -> str:
        """Return how often hands have drawn."""
        return words["chart.sections_note"].format(n=DRAWINGS)

    def _items(self) -> Iterator[tuple[str, str, int, str, float, float | None, bool | None]]:
        found = self.found
        for where, counts in found.sections.items():
            for i, n in enumerate(counts):
                for name in found.quantities:
                    error = float(found.errors[where, name][i])
                    yield NOBODY, where, n, name, error, found.order(where, name), None
        for hand in charts.HANDS:
            for i, n in enumerate(found.drawn):
                for name in found.quantities:
                    best = found.best(hand, name)[0] == n
                    yield hand, "nodes", n, name, float(found.hands[hand, name][i]), None, best

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through all errors: signed those of chords, of hands what 95 % of drawings keep."""
        yield "drawn_by", "jumps", "sections", "quantity", "error [%]", "order", "best"
        for by, where, n, name, error, order, best in self._items():
            yield by, where, n, name, charts.PERCENT * error, order, None if best is None else int(best)

    def _data(self) -> dict[str, Any]:
        """Return all errors, in parts of the exact values."""
        found, names = self.found, self.found.quantities
        return {
            "exact": {name: {"value": value, "unit": unit_of(name)} for name, value in found.exact.items()},
            "orders": {where: {name: found.order(where, name) for name in names} for where in found.sections},
            "best": {hand: {name: found.best(hand, name)[0] for name in names} for hand in charts.HANDS},
            "errors": [
                {"drawn_by": by, "jumps": where, "sections": n, "quantity": name, "error": error}
                for by, where, n, name, error, _, _ in self._items()
            ],
        }


class _CamStabilityChart(charts.Chart[Robustness]):
    """What a line beside a jump does, and by how much drawings do not close."""

    heading, page = "chart.cam_stability", staticmethod(closing_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through errors of lines beside jumps, then for every hand what does not close, and what closing brings."""
        rows = [[words["chart.hand"], *(words[f"chart.{name}"] for name in ORDINATES)]]
        rows[0] += [words[f"chart.closed.{way}"] for way in WAYS]
        for hand, closing in self.found.closings.items():
            cells = [charts.short(words, getattr(closing, name)) for name in ORDINATES]
            cells += [charts.short(words, charts.per_cent(closing.errors.get(way))) for way in WAYS]
            rows.append([words[f"hand.{hand}"], *cells])
        yield from (self._missed(words), aligned(rows))

    def note(self, words: Words) -> str:
        """Return what the numbers mean."""
        return words["chart.closing_note"].format(n=DRAWINGS, sections=self.found.sections)

    def _missed(self, words: Words) -> str:
        found = self.found
        if not found.beside:
            return words["chart.no_jumps"]
        rows = [[words["chart.sections_n"], "", *(words.short(part) for part in found.beside[::EVERY])]]
        for n, name in found.missed:
            parts = [0.0 if abs(error) < ROUNDING else error for error in found.missed[n, name][::EVERY].tolist()]
            rows.append([str(n), f"{name}, %", *(charts.short(words, charts.PERCENT * part) for part in parts)])
        return "\n".join((f"{words['chart.late']}:", aligned(rows, (0, 1))))

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through the rows of lines beside jumps, then of hands."""
        yield "kind", "drawn_by", "sections", "late", "closed", "quantity", "error [%]", "size [mm]"
        for (n, name), errors in self.found.missed.items():
            for part, error in zip(self.found.beside, errors.tolist(), strict=True):
                yield "jump", "exact", n, part, "", name, charts.PERCENT * error, None
        n = self.found.sections
        for hand, closing in self.found.closings.items():
            for name in ORDINATES:
                yield "ordinate", hand, n, None, "", name, None, getattr(closing, name)
            for way, error in closing.errors.items():
                yield "travel", hand, n, None, way, "s", charts.PERCENT * error, None

    def _data(self) -> dict[str, Any]:
        """Return errors in parts, ordinates in metres of paper."""
        missed, closings = self.found.missed.items(), self.found.closings.items()
        return {
            "late": list(self.found.beside),
            "missed": [{"sections": n, "quantity": name, "error": errors.tolist()} for (n, name), errors in missed],
            "sections": self.found.sections,
            "hands": {
                hand: {name: None if (size := getattr(closing, name)) is None else 1e-3 * size for name in ORDINATES}
                | {"travel_error": dict(closing.errors)}
                for hand, closing in closings
            },
        }


def _accuracy(scene: charts.Scene) -> charts.AccuracyChart:
    """Let all ways to the motion of a cam compete."""
    solved = SolvedCam.of(scene.case.solved)
    found = rivals(solved, time.process_time, charts.HANDS[scene.hand], charts.EFFORT)
    return charts.AccuracyChart(scene, found, charts.Places("rad"), "chart.cam_compared")


def _sections(scene: charts.Scene) -> _SectionsChart:
    """Draw the diagrams with more and more sections."""
    solved = SolvedCam.of(scene.case.solved)
    all_known("quantity-unknown", scene.quantities, compared(solved))
    return _SectionsChart(scene, convergence(solved, charts.HANDS, scene.quantities))


CHARTS: charts.Gallery = {
    "sections": (_sections, ("quantities",)),
    "accuracy": (_accuracy, ("hand",)),
    "stability": (
        lambda scene: _CamStabilityChart(scene, robustness(SolvedCam.of(scene.case.solved), charts.HANDS)),
        (),
    ),
}
