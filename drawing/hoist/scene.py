"""What every view of a hoist needs: the solved hoist on a format, its words, its scale factors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from ...plans.hoist.construction import SCHEME
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import ON_PAPER, SCALED, SCALES, SolvedHoist
from ...plans.names import role
from ...plans.solved import PAPER_MM
from ...scales.scale import Scale
from ..figure import SubjectScene
from ..printed import decimals_for
from ..words import Words

LETTERS = {"_y_F_12_t1": "y(t_{1})", "_osc_F_12_t1": "δ(t_{1})", "_dF_t1": "F′_{12}(t_{1})"}  # at the lift-off
LETTERS |= {"_height": "mg/C", "_dy_t1": "y′(t_{1})", "_dosc_t1": "δ′(t_{1})"}
UNITS = {SCALES[SCHEME]: "m", SCALES[CIRCLE]: "N"}  # of the scale factors that may be chosen


@dataclass(frozen=True, slots=True)
class HoistScene(SubjectScene[SolvedHoist]):
    """A solved hoist on a certain format, in certain words; `mus` are the chosen scale factors, SI per mm."""

    mus: Mapping[str, float] = field(default_factory=dict)

    def size(self, name: str) -> float:
        """Return a quantity or a given, SI."""
        return float(self.solved.values[name] if name in LETTERS else self.solved.forces.found[name])

    def sum_of(self, *names: str) -> float:
        """Return the sum of quantities as they are printed, SI."""
        return sum(round(size, decimals_for(size)) for size in map(self.size, names))

    def scale(self, symbol: str) -> Scale:
        """Return a scale factor as it is drawn."""
        return scale_of(self.solved, symbol, self.mus)

    def mm(self, mark: str) -> complex:
        """Return a mark in mm from the origin of its plan."""
        plan = role(mark).plan
        return self.solved.point(mark) * (1.0 / (PAPER_MM if plan in ON_PAPER else self.mus[SCALES[plan]]))

    def places(self, curve: NDArray[Any]) -> list[complex]:
        """Return a curve of a diagram, which is drawn in metres of paper, in mm."""
        places: list[complex] = (curve * (1.0 / PAPER_MM)).tolist()
        return places

    def stated(self, name: str, value: float | None = None, unit: str = "N") -> str:
        """Return a quantity with its symbol and unit."""
        number = self.value(self.size(name) if value is None else value)
        return f"{self.words.symbol(name)} = {number} {self.words.unit(unit)}"

    def factors(self, *symbols: str) -> str:
        """Return scale factors in one line."""
        return ";  ".join(self.words.scale(self.scale(symbol)) for symbol in symbols)


def lettered(words: Words, solved: SolvedHoist) -> Words:
    """Return the words with the letters of a hoist's quantities, with as many roots of (12) as it has."""
    table = words.letters_of("hoist") | LETTERS
    drawn = table.pop("drawn")
    for n in range(1, len(solved.layout.roots.times if solved.layout.roots else ()) + 1):
        table |= {f"t_2_{n}": f"t_{{2}}({n})", f"t_2_{n}_drawn": f"t^{{{drawn}}}_{{2}}({n})"}
    return words.lettered(table)


def scale_of(solved: SolvedHoist, symbol: str, mus: Mapping[str, float]) -> Scale:
    """Return a scale factor as it is drawn: of a diagram the one that is known, else the one of `mus`, SI per mm."""
    if symbol in SCALED:
        return Scale(symbol, float(solved.values[symbol]) * PAPER_MM, SCALED[symbol])
    return Scale(symbol, mus[symbol], UNITS[symbol])
