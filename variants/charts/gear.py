"""The chart of a gear pair: error against the scale of the drawing; rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ...drawing.charts.curves import scales_page
from ...drawing.words import Words
from ...plans.gears.gear import unit_of
from ...plans.gears.solve import DRAWINGS, MILLI, ScaleErrors, SolvedGear, compared, scale_errors
from ...plans.hands.shaky import PRESETS
from ...scales.names import all_known
from ..tables import Cell, aligned
from .charts import HANDS, PERCENT, Chart, Gallery, Scene, error_rows

PARTS = {hand: preset.tolerance.part for hand, preset in PRESETS.items()}  # that are let pass


class _ScaleChart(Chart[ScaleErrors]):
    """What hands make of the meshing at one scale after the other."""

    heading, page = "chart.scale", staticmethod(scales_page)

    def _parts(self, words: Words) -> Iterator[str]:
        """Go through what each hand keeps at every scale, then from which scale on it keeps what is let pass of it."""
        found, names = self.found, self.found.quantities

        def said(ratio: float | None) -> str:
            return "–" if ratio is None else f"{words.short(ratio)}:1"

        rows = [[words["chart.hand"], words["chart.scale_n"], *(f"{name}, %" for name in names)]]
        for hand, part in PARTS.items():
            enough = words["chart.scale_enough"].format(part=words.short(PERCENT * part))
            last = [enough, *(said(found.enough(hand, name, part)) for name in names)]
            errors = [found.errors[hand, name] for name in names]
            rows += error_rows(words[f"hand.{hand}"], [*map(said, found.ratios)], errors, last, words)
        yield aligned(rows, (0, 1))

    def note(self, words: Words) -> str:
        """Return how often hands have drawn."""
        return words["chart.scale_note"].format(n=DRAWINGS)

    def _items(self) -> Iterator[tuple[str, float, str, float]]:
        for hand in PARTS:
            for i, ratio in enumerate(self.found.ratios):
                for name in self.found.quantities:
                    yield hand, ratio, name, float(self.found.errors[hand, name][i])

    def _rows(self) -> Iterator[Sequence[Cell]]:
        """Go through all errors: what 95 % of drawings keep."""
        yield "drawn_by", "scale", "mu_l [m/mm]", "tooth [mm]", "quantity", "error [%]"
        tooth = self.found.tooth / MILLI
        for hand, ratio, name, error in self._items():
            yield hand, ratio, MILLI / ratio, tooth * ratio, name, PERCENT * error

    def _data(self) -> dict[str, Any]:
        """Return all errors, in parts of the exact values."""
        found = self.found
        return {
            "exact": {name: {"value": value, "unit": unit_of(name)} for name, value in found.exact.items()},
            "tooth": {"value": found.tooth, "unit": "m"},
            "enough": {
                hand: {name: found.enough(hand, name, part) for name in found.quantities}
                for hand, part in PARTS.items()
            },
            "errors": [
                {"drawn_by": hand, "scale": ratio, "quantity": name, "error": error}
                for hand, ratio, name, error in self._items()
            ],
        }


def _scale(scene: Scene) -> _ScaleChart:
    """Draw the meshing at one scale after the other."""
    solved = SolvedGear.of(scene.case.solved)
    all_known("quantity-unknown", scene.quantities, compared(solved))
    return _ScaleChart(scene, scale_errors(solved, HANDS, scene.quantities))


CHARTS: Gallery = {"scale": (_scale, ("quantities",))}
