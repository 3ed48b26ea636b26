"""What every view of a hoist needs: the solved hoist on a format, its words, its scale factors and their ladders."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from ...plans.hoist.construction import BENT, SCHEME
from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import ON_PAPER, SCALED, SCALES, SolvedHoist
from ...plans.names import role
from ...plans.solved import PAPER_MM
from ...scales.scale import Choosers, From, Scale, steps
from ..extents import smallest, visible
from ..figure import SubjectScene
from ..formats import Format
from ..printed import decimals_for
from ..words import Words

LEAST = 1e-3  # part of the mean force that the circle is taken for at least
SPAN, ROPE, DIAMETER = 280.0, 350.0, 210.0  # mm of paper that the longer beam, the rope and the circle may take
# mm that letters, dimensions and heading add to the scheme and to the circle; mm^2 that the scheme, and both, may take
ABOUT_SCHEME, ABOUT_CIRCLE = (41.0, 91.0), 63.0
LARGEST, BOTH = 7.2e4, 1.1e5
# mm^2 of A1: of figures with their texts, and of tables that every sheet has
AREAS = {SCHEME_PART: 2e4, FORCES_PART: 1.25e5, ROOTS_PART: 9e4, CIRCLE_PART: 3e4, BEAMS_PART: 3e4}
TABLES = 4e4
UNITS = {SCALES[SCHEME]: "m", SCALES[CIRCLE]: "N"}  # of the scale factors that may be chosen


@dataclass(frozen=True, slots=True)
class HoistScene(SubjectScene[SolvedHoist]):
    """A solved hoist on a certain format, in certain words; `mus` are the chosen scale factors, SI per mm."""

    mus: Mapping[str, float] = field(default_factory=dict)

    def size(self, name: str) -> float:
        """Return a quantity or a given, SI."""
        return float(self.solved.forces.found[name])

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


def lettered(words: Words, roots: int = 0) -> Words:
    """Return the words with the letters of a hoist that has so many roots of (12)."""
    table = words.letters_of("hoist")
    drawn = table.pop("drawn")
    for n in range(1, roots + 1):
        table |= {f"t_2_{n}": f"t_{{2}}({n})", f"t_2_{n}_drawn": f"t^{{{drawn}}}_{{2}}({n})"}
    return words.lettered(table)


def ladder(solved: SolvedHoist, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the values of a scale factor that may be chosen, one of `UNITS`, the one wanted first.

    Where nothing is said, scheme and circle are as large as they may be, the circle as the scheme leaves room.
    """
    span, rope = max(solved.size(f"l_{i}") for i in BENT), solved.size("L")

    def scheme(mu: float) -> float:  # mm^2
        return (span / mu + ABOUT_SCHEME[0]) * (rope / mu + ABOUT_SCHEME[1])

    if symbol == SCALES[SCHEME]:
        largest = max(span, rope)
        wanted = next(mu for mu in steps(max(span / SPAN, rope / ROPE)) if scheme(mu) <= LARGEST)
    else:
        largest = 2.0 * solved.size("R")
        left = BOTH - scheme(ladder(solved, choosers, SCALES[SCHEME])[0])
        diameter = min(DIAMETER, math.sqrt(max(left, BOTH - LARGEST)) - ABOUT_CIRCLE)
        wanted = steps(max(largest, LEAST * solved.size("P_m")) / diameter)[0]
    chooser = choosers.get(symbol, From(wanted))
    values = chooser.ladder(solved.size)
    if symbol in solved.scale_of_plan.values():
        visible(chooser, symbol, values[0], largest, UNITS[symbol])
    return values


def scale_of(solved: SolvedHoist, symbol: str, mus: Mapping[str, float]) -> Scale:
    """Return a scale factor as it is drawn: of a diagram the one that is known, else the one of `mus`, SI per mm."""
    if symbol in SCALED:
        return Scale(symbol, float(solved.values[symbol]) * PAPER_MM, SCALED[symbol])
    return Scale(symbol, mus[symbol], UNITS[symbol])


def first_scales(solved: SolvedHoist, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams are known."""
    symbols = solved.scale_of_plan
    mus = {symbol: ladder(solved, choosers, symbol)[0] for symbol in symbols.values() if symbol in UNITS}
    found = {plan: scale_of(solved, symbol, mus) for plan, symbol in symbols.items()}
    return smallest((TABLES, *(AREAS[plan] for plan in plans))), found
