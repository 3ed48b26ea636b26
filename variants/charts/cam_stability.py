"""The chart of how diagrams of a cam stand errors: rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.words import Words
from ...plans.cams.closing import WAYS
from ...plans.cams.convergence import DRAWINGS, ROUNDING
from ...plans.cams.robustness import Robustness, robustness
from ...plans.cams.solve import SolvedCam
from ...plans.hands.hand import PRESETS
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("kind", "drawn_by", "sections", "late", "closed", "quantity", "error [%]", "size [mm]")
EVERY = 5  # of the places of a line beside a jump stands in the table
ORDINATES = ("speed_top", "speed_last", "stroke_last")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class CamStabilityChart:
    """What a line beside a jump does, and by how much drawings do not close."""

    heading: ClassVar[str] = "chart.cam_stability"
    scene: Scene
    found: Robustness

    def table(self, words: Words) -> str:
        """Return errors of lines beside jumps, then for every hand what does not close, and what closing brings."""
        parts = [self._missed(words), self._closings(words), wrapped(self.note(words))]
        return "\n\n".join(part for part in parts if part)

    def note(self, words: Words) -> str:
        """Return what the numbers mean."""
        return words["chart.closing_note"].format(n=DRAWINGS, sections=self.found.sections)

    def _missed(self, words: Words) -> str:
        found = self.found
        if not found.beside:
            return words["chart.no_jumps"]
        heads = [words.short(part) for part in found.beside[::EVERY]]
        rows = [[words["chart.sections_n"], "", *heads]]
        for n, name in found.missed:
            tidy = [0.0 if abs(error) < ROUNDING else 100.0 * error for error in found.missed[n, name].tolist()]
            rows.append([str(n), f"{name}, %", *(short(words, error) for error in tidy[::EVERY])])
        return "\n".join((f"{words['chart.late']}:", aligned(rows, (0, 1))))

    def _closings(self, words: Words) -> str:
        rows = [[words["chart.hand"], *(words[f"chart.{name}"] for name in (*ORDINATES, *_closed()))]]
        for hand, closing in self.found.closings.items():
            cells = [short(words, getattr(closing, name)) for name in ORDINATES]
            cells += [short(words, _per_cent(closing.errors.get(way))) for way in WAYS]
            rows.append([words[f"hand.{hand}"], *cells])
        return aligned(rows)

    def csv(self, words: Words) -> bytes:
        """Return all rows: of lines beside jumps, of hands."""
        return as_csv(HEAD, self._rows(), words)

    def _rows(self) -> Iterator[list[Cell]]:
        for (n, name), errors in self.found.missed.items():
            for part, error in zip(self.found.beside, errors.tolist(), strict=True):
                yield ["jump", "exact", n, part, "", name, 100.0 * error, None]
        n = self.found.sections
        for hand, closing in self.found.closings.items():
            for name in ORDINATES:
                yield ["ordinate", hand, n, None, "", name, None, getattr(closing, name)]
            for way, error in closing.errors.items():
                yield ["travel", hand, n, None, way, "s", 100.0 * error, None]

    def to_json(self) -> dict[str, Any]:
        """Return all of it as data: errors in parts, ordinates in metres of paper."""
        return {
            "late": list(self.found.beside),
            "missed": [
                {"sections": n, "quantity": name, "error": errors.tolist()}
                for (n, name), errors in self.found.missed.items()
            ],
            "sections": self.found.sections,
            "hands": {
                hand: {
                    **{name: _metres(getattr(closing, name)) for name in ORDINATES},
                    "travel_error": dict(closing.errors),
                }
                for hand, closing in self.found.closings.items()
            },
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.cam_stability import stability_page

        return stability_page(self.found, words, self.scene.title(self.heading), self.note(words))


def cam_stability_chart(scene: Scene, solved: SolvedCam) -> CamStabilityChart:
    """Look at how the diagrams of a cam stand errors."""
    return CamStabilityChart(scene, robustness(solved, {name: preset.hand for name, preset in PRESETS.items()}))


def _closed() -> list[str]:
    return [f"closed.{way}" for way in WAYS]


def _per_cent(error: float | None) -> float | None:
    return None if error is None else 100.0 * error


def _metres(millimetres: float | None) -> float | None:
    return None if millimetres is None else 1e-3 * millimetres
