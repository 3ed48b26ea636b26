"""Speed against accuracy: the rivals over the cycle of one mechanism, their errors beside fifty digits, their times.

The error of a quantity counts in parts of the largest vector of its plan, of a number that no plan shows in parts of
its unit's largest over the cycle; of a method the worst one counts, over all quantities of a kind and all positions.
What a hand misses stands beside the methods of a computer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import POSITION, Program
from ...boards.exact import ExactBoard, run
from ...boards.precision import run_in
from ...contest import FULL, Clock, Contest, Effort, Entry, Kind, timed
from ...hands.hand import Hand
from ...hands.shaky import Paper, draw
from ...hands.spread import kept
from ...laws import TURN
from ...quantities import plans_of, references
from ..cycles.cycle import Cycle
from ..solved import SolvedLinkage
from .methods import Newton, Rivals, Values, Way, kinds_of

Array = NDArray[Any]
SINGLE, EXTENDED = "plan-single", "plan-extended"
PLAN, NEWTON, DIFFERENCES, CHORDS, HAND = "plan", "newton", "differences", "chords", "hand"
TOLERANCES = (1e-1, 1e-2, 1e-4, 1e-8)
STEPS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
SECTIONS = (12, 24, 48, 96, 192, 384)
LONG = 1.0  # seconds that are too many
SEED = 1  # the same hand on every paper
NEAR_DEAD = 0.01  # part of the cycle
DRAWN, DRAWINGS = 12, 400  # positions that are drawn, how many times


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """What fifty digits give for quantities, as sums of two long numbers, and the sizes beside which errors count."""

    high: Mapping[str, Array]
    low: Mapping[str, Array]
    sizes: Mapping[str, Array]

    def errors(self, found: Values) -> dict[str, Array]:
        """Return the errors of values in parts of their sizes, shape (N,)."""
        return {
            name: np.abs((np.asarray(value, np.clongdouble) - self.high[name]) - self.low[name]).astype(float)
            * (1.0 / self.sizes[name])
            for name, value in found.items()
        }


def places_of(cycle: Cycle, count: int) -> Array:
    """Return so many places of the driver, half a step off the ends of the cycle, where loads may jump."""
    low, high = cycle.range.low, cycle.range.high
    return low + (high - low) * ((np.arange(count) + 0.5) / count)


def truth(cycle: Cycle, places: Array, names: Sequence[str]) -> Truth:
    """Run a program with fifty digits at all places that have plans; elsewhere there are NaN."""
    program = cycle.program.needed_for(names)
    high, low, sizes = (
        {name: np.full(len(places), np.nan, kind) for name in names} for kind in (complex, complex, float)
    )
    for i, here in enumerate(cycle.each(places)):
        board = run(cycle.program, here)
        if board.trouble is not None:
            continue
        exact, size = run_in(program, here, "fifty"), references(cycle.program, board.values)
        for name in names:
            high[name][i] = complex(exact[name])
            low[name][i] = complex(exact[name] - high[name][i])
            sizes[name][i] = size[name]
    return Truth(high, low, {name: beside(cycle, name, sizes[name]) for name in names})


def beside(cycle: Cycle, name: str, sizes: Array) -> Array:
    """Return the sizes beside which errors count: of a number that no plan shows the largest over the cycle."""
    if name not in plans_of(cycle.program):
        sizes = np.where(np.isnan(sizes), np.nan, np.nanmax(sizes, initial=0.0))
    found: Array = np.where(sizes > 0.0, sizes, np.nan)
    return found


def contest(cycle: Cycle, positions: int, clock: Clock, names: Iterable[str] = (), effort: Effort = FULL) -> Contest:
    """Let all methods but the hand, which `by_hand` adds, compete over a cycle.

    Errors are looked at in so many `positions`, of the quantities `names`, of all that can be compared when empty;
    `clock` returns seconds, best those of the processor, and `effort` says on what times are measured.
    """
    rivals, places = Rivals.of(cycle), places_of(cycle, positions)
    found: list[Entry] = []
    kinds = kinds_of(cycle, names)
    newton = Newton(rivals)
    for kind in kinds:
        race = _Race(rivals, kind, places, truth(cycle, places, kind.names), effort, clock)
        found += race.plans()
        if kind.name != "forces":
            found += race.others(newton)
    return Contest(kinds, places, tuple(found), effort)


@dataclass(frozen=True, slots=True, eq=False)
class _Race:
    """The methods on quantities of one kind."""

    rivals: Rivals
    kind: Kind
    places: Array
    truth: Truth
    effort: Effort
    clock: Clock

    def plans(self) -> Iterator[Entry]:
        """Go through plans: in batches of all sizes, then in other precisions."""
        names, rivals = self.kind.names, self.rivals
        found = rivals.plan(self.places, names)
        spent = 0.0
        for size in self.effort.batches:
            if spent * size > LONG * 10.0:  # groups of class III are followed at length
                break
            spent = self._one_by_one() if size == 1 else self._time(rivals.plan, size)
            yield self.entry(PLAN, size, found, spent, size)
        # a coarse clock may not notice what takes so little
        size = min(self.effort.at_once, max(int(LONG / spent), 100)) if spent else self.effort.at_once
        precisions = {SINGLE: "single"}
        if np.finfo(np.longdouble).eps < np.finfo(float).eps:  # not so on every machine
            precisions[EXTENDED] = "extended"
        for method, precision in precisions.items():

            def way(places: Array, wanted: Sequence[str], precision: str = precision) -> Values:
                return rivals.plan(places, wanted, precision)

            yield self.entry(method, size, way(self.places, names), self._time(way, size), size)

    def others(self, newton: Newton) -> Iterator[Entry]:
        """Go through the methods that are no plans."""
        names, rivals = self.kind.names, self.rivals
        ways = [(NEWTON, tolerance, newton.way(tolerance)) for tolerance in TOLERANCES]
        ways += [(DIFFERENCES, step, rivals.differences(step)) for step in STEPS]
        sizes: dict[str, int] = {}
        for method, setting, way in ways:
            size = sizes.setdefault(method, self._affordable(way))
            yield self.entry(method, setting, way(self.places, names), self._time(way, size), size)
        for sections in SECTIONS:
            found = rivals.chords(sections)(self.places, names)
            spent = timed(partial(rivals.chords_of_cycle, sections, names), self.clock) / sections
            yield self.entry(CHORDS, sections, found, spent, sections)

    def _affordable(self, way: Way) -> int:
        """Return how many positions at once a method is timed at."""
        few = 100
        spent = timed(lambda: way(places_of(self.rivals.cycle, few), self.kind.names), self.clock)
        return self.effort.at_once if spent * self.effort.at_once / few < LONG * 10.0 else few

    def _time(self, way: Way, size: int) -> float:
        places = places_of(self.rivals.cycle, size)
        return timed(lambda: way(places, self.kind.names), self.clock) / size

    def _one_by_one(self) -> float:
        """Return the time of one position on Python numbers."""
        cycle = self.rivals.cycle
        program = cycle.program.needed_for(self.kind.names)
        each = cycle.each(self.places)
        return timed(lambda: [run(program, here) for here in each], self.clock) / len(each)

    def entry(self, method: str, setting: float, found: Values, seconds: float, at_once: int) -> Entry:
        """Sum up the errors of what a method has found."""
        entry = summed(method, setting, self.kind, self.places, self.truth.errors(found))
        return replace(entry, seconds=seconds, at_once=at_once)


def summed(method: str, setting: float | str, kind: Kind, places: Array, errors: Mapping[str, Array]) -> Entry:
    """Return the worst and the typical error of a method, whose time is not known."""
    table = np.stack([errors[name] for name in kind.names])
    filled = np.where(np.isnan(table), -1.0, table)
    worst = filled.max(axis=0)
    row, column = np.unravel_index(np.argmax(filled), filled.shape)
    there = worst >= 0.0
    error, typical = (float(of(worst[there])) if there.any() else None for of in (np.max, np.median))
    failed, place = float(1.0 - there.mean()), float(places[column])
    return Entry(method, setting, kind.name, error, typical, kind.names[row], place, None, 1, failed)


@dataclass(frozen=True, slots=True)
class DrawnSheet:
    """The sheet of one position, `solved`, on a `paper`, with its scale factors by plan, SI per mm."""

    paper: str
    solved: SolvedLinkage
    mus: Mapping[str, float]


def by_hand(cycle: Cycle, sheet: DrawnSheet, hand: Hand, kinds: Iterable[Kind]) -> Iterator[Entry]:
    """Go through the errors that most drawings of a hand keep, kind by kind.

    The plans of every position are drawn as long as a sheet draws those of one.
    """
    places, kinds = _not_dead(cycle, places_of(cycle, DRAWN)), tuple(kinds)
    names = tuple(name for kind in kinds for name in kind.names)
    program, givens = cycle.program.needed_for(names), cycle.drive.givens(cycle.givens, places, cycle.program)
    runs = [run(cycle.program, here) for here in cycle.each(places)]
    column = {name: value[:, None] if np.ndim(value) else value for name, value in givens.items()}
    on_paper = Paper(program, column, _as_long(cycle.program, runs, sheet))
    board = draw(on_paper, hand, np.random.default_rng(SEED), (len(places), DRAWINGS))
    sizes = [references(cycle.program, one.values) for one in runs]
    errors = {}
    for name in names:
        exact = np.array([one.values[name] for one in runs])[:, None]
        drawings = np.broadcast_to(board.values[name], (len(places), DRAWINGS))
        size = beside(cycle, name, np.array([size[name] for size in sizes]))
        errors[name] = kept(drawings, exact) * (1.0 / size)
    for kind in kinds:
        yield summed(HAND, sheet.paper, kind, places, errors)


def _as_long(program: Program, runs: Iterable[ExactBoard], sheet: DrawnSheet) -> dict[str, float | Array]:
    """Return scale factors by plan at which the longest vectors are as long as those of the solved position."""
    solved, symbols = sheet.solved, sheet.solved.scale_of_plan
    own = _largest(solved.program, solved.values, symbols)
    each = [_largest(program, one.values, symbols) for one in runs]
    found: dict[str, float | Array] = {}
    for plan, mu in sheet.mus.items():
        symbol = symbols.get(plan, "")
        sizes = np.array([size.get(symbol, 0.0) for size in each])[:, None]
        drawn = own.get(symbol, 0.0) if plan != POSITION else 0.0
        found[plan] = np.where(sizes > 0.0, sizes * (mu / drawn), mu) if drawn > 0.0 else mu
    return found


def _largest(program: Program, values: Mapping[str, Any], symbols: Mapping[str, str]) -> dict[str, float]:
    """Return the largest vector that is drawn with each scale factor."""
    plans, largest = plans_of(program), dict[str, float]()
    for name, size in references(program, values).items():
        symbol = symbols.get(plans.get(name, ""))
        if symbol is not None:
            largest[symbol] = max(largest.get(symbol, 0.0), size)
    return largest


def _not_dead(cycle: Cycle, places: Array) -> Array:
    """Return the places that are off dead positions: a hand that errs there takes one stroke for the other."""
    near = NEAR_DEAD * abs(cycle.range.high - cycle.range.low)
    off = np.ones(len(places), bool)
    for dead in (dead for motion in cycle.motions for dead in motion.dead):
        away = places - dead.angle
        off &= np.abs(away - TURN * np.rint(away / TURN) if cycle.drive.turns else away) > near
    return places[off]
