"""The chart of how deep the model of a hoist must be: rows, table, CSV, JSON, picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...drawing.words import Words
from ...plans.hoist.depth import COMPARED, MANY, HoistDepth, OneMass
from ...scales.units import format_unit
from ..spreadsheets.csv_write import Cell
from ..tables import aligned
from .data import Scene, as_csv, finite, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("kind", "key", "masses", "ratio", "t_1 [%]", "F_12_max [%]", "P_12_max [%]", "F_max [%]", "F_drum [%]")
PERCENT = 100.0


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HoistDepthChart:
    """What simplifications change, and one mass beside ropes of many."""

    heading: ClassVar[str] = "chart.hoist_depth"
    scene: Scene
    found: HoistDepth

    def table(self, words: Words) -> str:
        """Return what every simplification changes, ropes of more and more masses, one mass over the rope's weight."""
        from ...drawing.charts.hoist_depth import verdict

        parts = [self._simpler(words), self._ropes(words), self._one_mass(words), "\n".join(verdict(self.found, words))]
        return "\n\n".join(part for part in (*parts, wrapped(words["chart.hoist.depth_note"])) if part)

    def _simpler(self, words: Words) -> str:
        rows = [[words["chart.hoist.simpler"], *(f"{name}, %" for name in COMPARED)]]
        for one in self.found.simpler:
            cells = [short(words, _per_cent(one.changes[name])) for name in COMPARED]
            rows.append([words[f"chart.hoist.without.{one.key}"], *cells])
        return aligned(rows)

    def _ropes(self, words: Words) -> str:
        if not self.found.ropes:
            return ""
        newton, second = (format_unit(unit, words.language) for unit in ("N", "s"))
        heads = [f"t_1, {second}", f"F_12_max, {newton}", f"P_12_max, {newton}"]
        rows = [[words["chart.hoist.masses"], *heads, f"{words['chart.hoist.at_drum']}, {newton}"]]
        for rope in self.found.ropes:
            values = (rope.t_1, rope.F_12_max, rope.P_12_max, rope.F_drum_max)
            rows.append([str(rope.n), *(short(words, value, 7) for value in values)])
        return aligned(rows, ())

    def _one_mass(self, words: Words) -> str:
        if not self.found.one_mass:
            return ""
        rows = [["G_2/G_1", "t_1, %", *(f"{words[f'chart.hoist.{key}']}, %" for key in ("at_load", "at_drum"))]]
        for one in self.found.one_mass:
            errors = (one.t_1, one.at_load, one.at_drum)
            rows.append([words.short(one.ratio, 3), *(short(words, PERCENT * error) for error in errors)])
        return f"{words['chart.hoist.one_mass'].format(n=MANY)}\n{aligned(rows, ())}"

    def csv(self, words: Words) -> bytes:
        """Return all rows: simplifications, ropes, weights of the rope."""
        return as_csv(HEAD, self._rows(), words)

    def _rows(self) -> Iterator[list[Cell]]:
        found = self.found
        for one in found.simpler:
            yield ["simpler", one.key, 1, None, *(_per_cent(one.changes[name]) for name in COMPARED), None]
        for rope in found.ropes:
            others = (rope.t_1, rope.F_12_max, rope.P_12_max, max(rope.F_12_max, rope.P_12_max))
            changes = [PERCENT * (value / found.full[n] - 1.0) for n, value in zip(COMPARED, others, strict=True)]
            drum = PERCENT * (rope.F_drum_max / found.full["F_max"] - 1.0)
            yield ["rope", "", rope.n, found.ratio, *changes, drum]
        for mass in found.one_mass:
            yield ["one_mass", "", MANY, mass.ratio, *_errors(mass)]

    def to_json(self) -> dict[str, Any]:
        """Return all of it as data, changes and errors in parts."""
        found = self.found
        here = found.here
        return {
            "full": dict(found.full),
            "tolerance": found.tolerance,
            "simpler": [{"without": one.key, "changes": dict(one.changes)} for one in found.simpler],
            "spare": list(found.spare),
            "ropes": [asdict(rope) for rope in found.ropes],
            "ratio": found.ratio,
            "one_mass": [asdict(one) for one in found.one_mass],
            "here": None if here is None else asdict(here),
            "enough_to": finite(found.enough_to),
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.hoist_depth import hoist_depth_page

        return hoist_depth_page(self.found, words, self.scene.title(self.heading))


def _per_cent(change: float | None) -> float | None:
    return None if change is None else PERCENT * change


def _errors(mass: OneMass) -> list[Cell]:
    return [PERCENT * mass.t_1, None, None, PERCENT * mass.at_load, PERCENT * mass.at_drum]
