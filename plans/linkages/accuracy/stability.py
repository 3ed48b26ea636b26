"""Stability over the cycle: how flatly lines meet, how errors of the data come through, by how much a hand misses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import Program
from ...boards.exact import SMALL, run
from ...condition import conditions
from ...hands.hand import Hand
from ...hands.shaky import Paper, Shape, draw
from ...hands.spread import kept
from ...laws import TURN
from ...quantities import plans_of, worst_behind
from ..cycles.cycle import Cycle
from ..solved import signs

Array = NDArray[Any]
DIGITS = 16.0  # of double precision
NOTHING_LEFT = 1e15  # K at which a quantity and the largest beside it are nothing but rounding
DRAWINGS = 300
AT_ONCE = 60_000  # drawings in one go, of all positions together
DEAD, CHANGE, POLE, LIMIT = "dead", "change", "parallel", "limit"


@dataclass(frozen=True, slots=True)
class Spot:
    """A place of the driver that is special: `dead` (of `link`), `change`, `parallel` guides, or a `limit`."""

    kind: str
    place: float
    link: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Stability:
    """What is lost over the cycle; all arrays are float64 of shape (N,), NaN where a position has no plan."""

    places: Array  # of the driver, rad or m
    statuses: tuple[str, ...]
    sines: Array  # of the worst intersection on which the chosen quantities hang
    worst: tuple[str, ...]  # its mark
    conditions: Mapping[str, Array]  # K of every quantity
    # What most drawings of a hand keep, in millimetres where a plan shows the quantity, otherwise in per cent of its
    # largest value over the cycle, where lines do not meet flatly; and which of both.
    misses: Mapping[str, Array]
    in_mm: Mapping[str, bool]
    spots: tuple[Spot, ...]

    @property
    def angles(self) -> Array:
        """Angles of the worst intersection, degrees."""
        found: Array = np.degrees(np.arcsin(np.clip(self.sines, 0.0, 1.0)))
        return found

    def digits(self, name: str) -> Array:
        """Return how many digits of double precision are left of a quantity, beside the largest vector of its plan."""
        with np.errstate(divide="ignore"):
            lost = np.log10(np.maximum(self.conditions[name], 1.0))
        found: Array = DIGITS - lost
        return found


def stability(cycle: Cycle, names: Sequence[str], mus: Mapping[str, float], hand: Hand, seed: int = 0) -> Stability:
    """Look at quantities at all places of a cycle; `mus` are scale factors by plan, SI per mm."""
    lost = cycle.reach.undetermined(cycle.angles)
    sines, worst, found = _conditions(cycle, names, lost)
    plans = plans_of(cycle.program)
    in_mm = {name: plans.get(name, "") in mus for name in names}
    misses = _misses(cycle, names, mus, hand, seed)
    steep = sines >= SMALL if (sines >= SMALL).any() else np.ones(len(sines), bool)
    for name in names:
        sizes = np.abs(np.broadcast_to(cycle.values[name], len(sines)))[steep]
        size = mus[plans[name]] if in_mm[name] else np.nanmax(sizes, initial=0.0) / 100.0
        misses[name] = np.where(lost, np.nan, misses[name]) * (1.0 / size if size else np.nan)
    return Stability(cycle.angles, cycle.statuses, sines, worst, found, misses, in_mm, spots(cycle))


def _conditions(
    cycle: Cycle, names: Sequence[str], lost: NDArray[np.bool_]
) -> tuple[Array, tuple[str, ...], dict[str, Array]]:
    """Return the worst sine of every position, the mark where it is, and K of every quantity."""
    count, fixed = len(cycle.angles), signs(cycle.mechanism)
    sines, worst = np.full(count, np.nan), [""] * count
    found = {name: np.full(count, np.nan) for name in names}
    # angles of a crank within a turn: of an angle its radians count as a given
    places = cycle.angles % TURN if cycle.drive.turns else cycle.angles
    for i, values in enumerate(cycle.each(places)):
        board = run(cycle.program, values)
        if board.trouble is not None or lost[i]:
            sines[i] = 0.0 if board.status == "singular" or lost[i] else np.nan
            continue
        sines[i], worst[i] = _worst(cycle.program, board.sines, names)
        varied = [name for name, value in values.items() if name not in fixed and value]
        known = conditions(cycle.program, values, varied, board.values, board.sines)
        for name in names:
            value = known[name].value
            found[name][i] = value if value is not None and value < NOTHING_LEFT else np.nan
    return sines, tuple(worst), found


def _worst(program: Program, sines: Mapping[str, float], names: Sequence[str]) -> tuple[float, str]:
    """Return the least sine on which any of the names hangs, and the mark where the lines meet so."""
    behind = worst_behind(program, sines)
    least = min((behind[name] for name in names), default=1.0)
    needed = {step.name for step in program.needed_for(names)}
    marks = [mark for mark, sine in sines.items() if mark in needed and abs(sine) == least]
    return least, marks[0] if marks else ""


@dataclass(frozen=True, slots=True)
class _Alike:
    """Errors that are the same in all positions, so that curves over the cycle are smooth."""

    random: np.random.Generator

    def standard_normal(self, size: Shape, /) -> Array:
        """Return an array of errors in standard deviations."""
        assert isinstance(size, tuple)
        return np.broadcast_to(self.random.standard_normal((1, *size[1:])), size)


def _misses(cycle: Cycle, names: Sequence[str], mus: Mapping[str, float], hand: Hand, seed: int) -> dict[str, Array]:
    """Return what most drawings keep, SI."""
    program = cycle.program.needed_for(names)
    givens = cycle.drive.givens(cycle.givens, cycle.angles, cycle.program)
    count, some = len(cycle.angles), max(AT_ONCE // DRAWINGS, 1)
    found = {name: np.full(count, np.nan) for name in names}
    for start in range(0, count, some):
        part = slice(start, min(start + some, count))
        shape = (part.stop - start, DRAWINGS)
        here = {name: value[part, None] if np.ndim(value) else value for name, value in givens.items()}
        board = draw(Paper(program, here, mus), hand, _Alike(np.random.default_rng(seed)), shape)
        for name in names:
            exact = np.broadcast_to(cycle.values[name], count)[part, None]
            found[name][part] = kept(np.broadcast_to(board.values[name], shape), exact)
    return found


def spots(cycle: Cycle) -> tuple[Spot, ...]:
    """Return the special places of the driver."""
    found = [Spot(DEAD, dead.angle, motion.output.link) for motion in cycle.motions for dead in motion.dead]
    places = {CHANGE: cycle.reach.changes, POLE: cycle.reach.poles, LIMIT: cycle.reach.limits}
    return (*found, *(Spot(kind, place) for kind, at in places.items() for place in at))
