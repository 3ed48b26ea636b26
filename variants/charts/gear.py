"""The chart of a gear pair: error against the scale of the drawing; rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.gears.scene import lettered
from ...drawing.words import Words
from ...plans.gears.gear import unit_of
from ...plans.gears.scale_errors import DRAWINGS, MILLI, ScaleErrors, compared, scale_errors
from ...plans.gears.solve import SolvedGear
from ...plans.hands.hand import PRESETS
from ...scales.names import unknown
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, finite, short, wrapped
from .gallery import ChartRequest

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("drawn_by", "scale", "mu_l [m/mm]", "tooth [mm]", "quantity", "error [%]")


class GearCharts:
    """Makes the chart of a gear pair."""

    charts: ClassVar[tuple[str, ...]] = ("scale",)
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {"quantities": ("scale",)}

    def make(self, name: str, scene: Scene, asked: ChartRequest) -> ScaleChart:
        """Make the chart.

        Raises
        ------
        InputError
            An unknown quantity, or no meshing to draw.
        """
        return scale_chart(scene, SolvedGear.of(scene.case.solved), asked.quantities)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ScaleChart:
    """What hands make of the meshing at one scale after the other."""

    heading: ClassVar[str] = "chart.scale"
    scene: Scene
    found: ScaleErrors

    def table(self, words: Words) -> str:
        """Return what each hand keeps at every scale, then from which scale on it keeps what is let pass of it."""
        found = self.found
        rows = [[words["chart.hand"], words["chart.scale_n"], *(f"{name}, %" for name in found.quantities)]]
        for hand, preset in PRESETS.items():
            for i, ratio in enumerate(found.ratios):
                cells = [short(words, 100.0 * float(found.errors[hand, name][i])) for name in found.quantities]
                rows.append([words[f"hand.{hand}"] if i == 0 else "", _ratio(ratio, words), *cells])
            said = words["chart.scale_enough"].format(part=words.short(100.0 * preset.tolerance.part))
            enough = [found.enough(hand, name, preset.tolerance.part) for name in found.quantities]
            rows.append(["", said, *("–" if ratio is None else _ratio(ratio, words) for ratio in enough)])
        return "\n\n".join((aligned(rows, (0, 1)), wrapped(words["chart.scale_note"].format(n=DRAWINGS))))

    def _items(self) -> Iterator[tuple[str, float, str, float]]:
        for hand in PRESETS:
            for i, ratio in enumerate(self.found.ratios):
                for name in self.found.quantities:
                    yield hand, ratio, name, float(self.found.errors[hand, name][i])

    def csv(self, words: Words) -> bytes:
        """Return all errors: what 95 % of drawings keep."""
        tooth = self.found.tooth / MILLI
        rows: list[list[Cell]] = [
            [hand, ratio, MILLI / ratio, tooth * ratio, name, 100.0 * error]
            for hand, ratio, name, error in self._items()
        ]
        return as_csv(HEAD, rows, words)

    def to_json(self) -> dict[str, Any]:
        """Return all errors as data, in parts of the exact values."""
        found = self.found
        return {
            "exact": {name: {"value": value, "unit": unit_of(name)} for name, value in found.exact.items()},
            "tooth": {"value": found.tooth, "unit": "m"},
            "enough": {
                hand: {name: found.enough(hand, name, preset.tolerance.part) for name in found.quantities}
                for hand, preset in PRESETS.items()
            },
            "errors": [
                {"drawn_by": hand, "scale": ratio, "quantity": name, "error": finite(error)}
                for hand, ratio, name, error in self._items()
            ],
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.gear_scales import scales_page

        said = lettered(words)
        tolerances = {hand: preset.tolerance.part for hand, preset in PRESETS.items()}
        return scales_page(self.found, said, self.scene.title(self.heading), tolerances)


def scale_chart(scene: Scene, solved: SolvedGear, quantities: Sequence[str]) -> ScaleChart:
    """Draw the meshing at one scale after the other.

    Raises
    ------
    InputError
        An unknown quantity, or no meshing to draw.
    """
    known = compared(solved)
    for name in quantities:
        if name not in known:
            raise unknown("quantity-unknown", name, known)
    return ScaleChart(scene, scale_errors(solved, {name: preset.hand for name, preset in PRESETS.items()}, quantities))


def _ratio(ratio: float, words: Words) -> str:
    return f"{words.short(ratio)}:1"
