"""Speed against accuracy: the methods by which a user could find the motion of a mechanism, and their race.

Plans in several precisions; Newton's method on closed contours; finite differences of positions; graphical
differentiation by chords: each is a function of the driver's places, and all give the same quantities. They run over
the cycle of one mechanism, their errors beside fifty digits, with their times.

The error of a quantity counts in parts of the largest vector of its plan, of a number that no plan shows in parts of
its unit's largest over the cycle; of a method the worst one counts, over all quantities of a kind and all positions.
What a hand misses stands beside the methods of a computer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import POSITION, Program
from ..boards.batch import batch
from ..boards.exact import STATUSES, ExactBoard, run
from ..boards.precision import batch_in, run_in
from ..hands.shaky import Hand, Paper, draw
from ..hands.spread import kept
from ..laws import TURN, inclination
from ..linkages.chain import construct, moving_bodies
from ..linkages.cycle import Cycle, chords
from ..linkages.mechanism import ZERO, Driver
from ..linkages.solved import SolvedLinkage
from ..names import LEVER, role
from ..quantities import BALANCES, plans_of, references
from .contours import Contours
from .race import FULL, SEED, Clock, Contest, Discipline, Effort, Entry, Way, timed

Array = NDArray[Any]
Values = dict[str, Array]
Method = Callable[[Array, Sequence[str]], Values]
SINGLE, EXTENDED = "plan-single", "plan-extended"
PLAN, NEWTON, DIFFERENCES, CHORDS, HAND = "plan", "newton", "differences", "chords", "hand"
TOLERANCES = (1e-1, 1e-2, 1e-4, 1e-8)
STEPS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
SECTIONS = (12, 24, 48, 96, 192, 384)
LONG = 1.0  # seconds that are too many
FEW = 100  # positions on which it is tried how long a method takes
BEARABLE = 0.03  # seconds that it may take at more positions at once
NEAR_DEAD = 0.01  # part of the cycle
DRAWN, DRAWINGS = 12, 400  # positions that are drawn, how many times
GRID = 72  # places round the cycle at which Newton's method knows where the links lie
ORDERS = {"V": 1, "omega": 1, "a": 2, "epsilon": 2}  # how many times a quantity is a derivative of a place


def _kinds_of(cycle: Cycle, chosen: Iterable[str] = ()) -> tuple[Discipline, ...]:
    """Return the quantities of a cycle that are compared, kind by kind.

    Those are velocities and accelerations of points, angular ones of links, reactions and what balances the driver;
    of them the `chosen` ones only.
    """
    chosen = tuple(chosen)
    known = [name for name in cycle.quantities if not chosen or name in chosen]
    points = {point for link in cycle.mechanism.links for point in link.points}
    links = {str(link.number) for link in cycle.mechanism.links}
    known_of = {"V": points, "omega": links, "a": points, "epsilon": links}
    found: dict[str, tuple[str, ...]] = {"velocity": (), "acceleration": ()}
    for name in known:
        its = role(name)
        if not its.about + its.part and its.of in known_of.get(its.kind, ()):
            found["velocity" if _order(name) == 1 else "acceleration"] += (name,)
    planned = [name for name in BALANCES if name.part != LEVER]
    found["forces"] = tuple(name for name in known if role(name).kind == "R" or name in planned)
    return tuple(Discipline(kind, names) for kind, names in found.items() if names)


class _Rivals:
    """A mechanism over its cycle, ready for all methods."""

    def __init__(self, cycle: Cycle) -> None:
        self.cycle = cycle
        self._bodies = moving_bodies(cycle.mechanism, cycle.structure)
        self._bare = construct(cycle.mechanism, ("position",))[1]
        driver, given = cycle.mechanism.driver, {"one": 1.0, ZERO: 0.0, **cycle.givens}
        sense = float(given[driver.sense]) if isinstance(driver, Driver) else 1.0  # of both rates, rad/s or m/s
        self.speed, self.acceleration = (float(given[x or ZERO]) * sense for x in (driver.speed, driver.acceleration))
        self.contours = Contours(cycle.mechanism, cycle.givens)
        self._whole = abs(cycle.range.high - cycle.range.low)
        # how the links lie at places round the cycle
        known = {mark for body in self._bodies.values() for mark in (body.direction, body.local)}
        there = cycle.at(_places_of(cycle, GRID), [name for name in cycle.program.names if name in known])
        self._grid = self.contours.pose({
            number: there[body.direction] * (np.conj(there[body.local]) if body.local else 1.0)
            for number, body in self._bodies.items()
        })  # fmt: skip

    def time(self, method: Method, size: int, names: Sequence[str], clock: Clock) -> float:
        """Return what a method takes for a position of so many at once, seconds."""
        return timed(partial(method, _places_of(self.cycle, size), names), clock)[1] / size

    def plan(self, places: Array, names: Sequence[str], precision: str = "double") -> Values:
        """Return quantities by plans in a precision, many positions at once."""
        givens = self.cycle.drive.givens(self.cycle.givens, places)
        return batch_in(self.cycle.program, givens, tuple(names), precision)[0]

    def differences(self, step: float, places: Array, names: Sequence[str]) -> Values:
        """Return central differences of positions by plans; `step` is in radians, of a slide a part of its range."""
        step = step if self.cycle.drive.turns else step * self._whole
        return self._slopes((2.0 * step, step), places, names)

    def chords(self, sections: int, places: Array, names: Sequence[str]) -> Values:
        """Return slopes of the chords of a drawn curve over so many sections of the cycle, and chords of these.

        A velocity belongs to the middle of its section, an acceleration to the end of two: both as if the sections lay
        there.
        """
        return self._slopes((self._whole / sections, self._whole / sections), places, names)

    def _slopes(self, wide: tuple[float, float], places: Array, names: Sequence[str]) -> Values:
        """Return rates by chords about places: over one section, and over two; so wide are they for either order."""
        slopes = Values()
        for order, offsets in ((1, (-0.5, 0.5)), (2, (-1.0, 0.0, 1.0))):
            section, wanted = wide[order - 1], [name for name in names if _order(name) == order]
            curves = self._curves(places + np.array(offsets)[:, None] * section, wanted) if wanted else {}
            slopes |= {name: self._sloped(name, curve, section)[0] for name, curve in curves.items()}
        return slopes

    def chords_of_cycle(self, sections: int, names: Sequence[str]) -> Values:
        """Return the same for a whole cycle, whose sections share their ends: the work of it, to be timed."""
        low, high = self.cycle.range.low, self.cycle.range.high
        curves = self._curves(low + (high - low) * (np.arange(-1, sections + 2) / sections), names)
        return {name: self._sloped(name, curve, self._whole / sections) for name, curve in curves.items()}

    def _sloped(self, name: str, curve: Array, section: float) -> Array:
        """Return rates of a curve by chords, along its first axis."""
        slopes = chords(curve, section)
        found: Array = slopes * self.speed
        if _order(name) == 2:
            middles = (slopes[1:] + slopes[:-1]) * 0.5
            found = chords(slopes, section) * self.speed**2 + middles * self.acceleration
        return found

    def _curves(self, places: Array, names: Sequence[str]) -> Values:
        """Return where the point of each quantity stands, or its link's angle, without jumps along the first axis."""
        marks = {name: role(name).of for name in names}
        marks |= {name: self._bodies[int(of)].direction for name, of in marks.items() if _turns(name)}
        givens = self.cycle.drive.givens(self.cycle.givens, places.ravel())
        values, codes = batch(self._bare, givens, tuple(dict.fromkeys(marks.values())))
        fails = codes == STATUSES.index("no-assembly")
        curves = {name: np.where(fails, np.nan, values[of]).reshape(places.shape) for name, of in marks.items()}
        for name in filter(_turns, curves):
            turns = inclination(curves[name][1:] * np.conj(curves[name][:-1]))
            curves[name] = np.concatenate((np.zeros_like(turns[:1]), np.cumsum(turns, axis=0)))
        return curves

    def newton(self, tolerance: float, places: Array, names: Sequence[str]) -> Values:
        """Use Newton's method on closed contours; it begins at a place of a grid half a step before, or more."""
        contours, low, high = self.contours, self.cycle.range.low, self.cycle.range.high
        which = np.floor((places - low) * (GRID / (high - low)) - 1.0).astype(int)
        which = which % GRID if self.cycle.drive.turns else np.clip(which, 0, GRID - 1)
        pose = contours.solve(self._grid[:, which], places, tolerance)
        rates, changes = contours.rates(pose, self.speed), None
        if any(_order(name) == 2 for name in names):
            changes = contours.changes(pose, rates, self.acceleration)
        return {name: self._of_pose(name, pose, rates, changes) for name in names}

    def _of_pose(self, name: str, pose: Array, rates: Array, changes: Array | None) -> Array:
        contours, of = self.contours, role(name).of
        poses = rates if _order(name) == 1 else changes
        assert poses is not None
        if _turns(name):
            return np.asarray(poses[contours.angle_of[int(of)]])
        form = contours.point(of)
        return contours.rate(form, pose, rates) if poses is rates else contours.change(form, pose, rates, poses)


def _order(name: str) -> int:
    return ORDERS[role(name).kind]


def _turns(name: str) -> bool:
    return role(name).kind in ("omega", "epsilon")


@dataclass(frozen=True, slots=True, eq=False)
class _Truth:
    """What fifty digits give for quantities, as sums of two long numbers, and the sizes beside which errors count."""

    high: Mapping[str, Array]
    low: Mapping[str, Array]
    sizes: Mapping[str, Array]

    def errors(self, found: Values) -> dict[str, Array]:
        """Return the errors of values in parts of their sizes, shape (N,)."""
        off = {
            name: (np.asarray(value, np.clongdouble) - self.high[name]) - self.low[name]
            for name, value in found.items()
        }
        return {name: np.abs(gap).astype(float) * (1.0 / self.sizes[name]) for name, gap in off.items()}


def _places_of(cycle: Cycle, count: int) -> Array:
    """Return so many places of the driver, half a step off the ends of the cycle, where loads may jump."""
    low, high = cycle.range.low, cycle.range.high
    return low + (high - low) * ((np.arange(count) + 0.5) / count)


def _truth(cycle: Cycle, places: Array, names: Sequence[str]) -> _Truth:
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
    return _Truth(high, low, {name: _beside(cycle, name, sizes[name]) for name in names})


def _beside(cycle: Cycle, name: str, sizes: Array) -> Array:
    """Return the sizes beside which errors count: of a number that no plan shows the largest over the cycle."""
    if name not in plans_of(cycle.program):
        sizes = np.where(np.isnan(sizes), np.nan, np.nanmax(sizes, initial=0.0))
    return np.where(sizes > 0.0, sizes, np.nan)


def contest(cycle: Cycle, positions: int, clock: Clock, names: Iterable[str] = (), effort: Effort = FULL) -> Contest:
    """Let all methods but the hand, which `by_hand` adds, compete over a cycle.

    Errors are looked at in so many `positions`, of the quantities `names`, of all that can be compared when empty;
    `clock` returns seconds, best those of the processor, and `effort` says on what times are measured.
    """
    rivals, places, kinds = _Rivals(cycle), _places_of(cycle, positions), _kinds_of(cycle, names)
    entries: list[Entry] = []
    exact = _truth(cycle, places, tuple(dict.fromkeys(name for kind in kinds for name in kind.names)))  # once for all
    for kind in kinds:
        run_of = rivals, kind.names, places, effort, clock
        for way, values in (*_by_plans(*run_of), *(_by_others(*run_of) if kind.name != "forces" else ())):
            entries.append(way.entry(kind.name, places, exact.errors(values)))
    return Contest(kinds, places, tuple(entries), effort)


def _by_plans(
    rivals: _Rivals, names: Sequence[str], places: Array, effort: Effort, clock: Clock
) -> Iterator[tuple[Way, Values]]:
    """Go through plans: in batches of all sizes, then in other precisions."""
    cycle = rivals.cycle
    values, program = rivals.plan(places, names), cycle.program.needed_for(names)
    spent, each = 0.0, cycle.each(places)
    for size in effort.batches:
        if spent * size > LONG * 0.3:  # groups of class III are followed at length
            break
        if size == 1:  # on Python numbers
            spent = timed(lambda: [run(program, here) for here in each], clock)[1] / len(each)
        else:
            spent = rivals.time(rivals.plan, size, names, clock)
        yield Way(PLAN, size, spent, size), values
    # a coarse clock may not notice what takes so little
    size = min(effort.at_once, max(int(LONG / spent), 100)) if spent else effort.at_once
    precisions = {SINGLE: "single"}
    if np.finfo(np.longdouble).eps < np.finfo(float).eps:  # not so on every machine
        precisions[EXTENDED] = "extended"
    for method, precision in precisions.items():
        plan = partial(rivals.plan, precision=precision)
        yield Way(method, size, rivals.time(plan, size, names, clock), size), plan(places, names)


def _by_others(
    rivals: _Rivals, names: Sequence[str], places: Array, effort: Effort, clock: Clock
) -> Iterator[tuple[Way, Values]]:
    """Go through the methods that are no plans."""
    for name, method, settings in ((NEWTON, rivals.newton, TOLERANCES), (DIFFERENCES, rivals.differences, STEPS)):
        # it may not be bearable at more positions at once
        spent = rivals.time(partial(method, settings[0]), FEW, names, clock)
        size = effort.at_once
        while spent * size > BEARABLE and size > FEW:
            size //= 10
        for setting in settings:
            spent = rivals.time(partial(method, setting), size, names, clock)
            yield Way(name, setting, spent, size), method(setting, places, names)
    for sections in SECTIONS:
        _, spent = timed(partial(rivals.chords_of_cycle, sections, names), clock)
        yield Way(CHORDS, sections, spent / sections, sections), rivals.chords(sections, places, names)


@dataclass(frozen=True, slots=True)
class DrawnSheet:
    """The sheet of one position, `solved`, on a `paper`, with its scale factors by plan, SI per mm."""

    paper: str
    solved: SolvedLinkage
    mus: Mapping[str, float]


def by_hand(cycle: Cycle, sheet: DrawnSheet, hand: Hand, kinds: Iterable[Discipline]) -> Iterator[Entry]:
    """Go through the errors that most drawings of a hand keep, kind by kind.

    The plans of every position are drawn as long as a sheet draws those of one.
    """
    places, kinds = _places_of(cycle, DRAWN), tuple(kinds)
    near, off = NEAR_DEAD * abs(cycle.range.high - cycle.range.low), np.ones(len(places), bool)
    for dead in (dead for motion in cycle.motions for dead in motion.dead):
        away = places - dead.angle
        off &= np.abs(away - TURN * np.rint(away / TURN) if cycle.drive.turns else away) > near
    places = places[off]  # a hand that errs at a dead position takes one stroke for the other
    names = tuple(name for kind in kinds for name in kind.names)
    program, givens = cycle.program.needed_for(names), cycle.drive.givens(cycle.givens, places)
    runs = [run(cycle.program, here) for here in cycle.each(places)]
    column = {name: value[:, None] if np.ndim(value) else value for name, value in givens.items()}
    on_paper = Paper(program, column, _as_long(cycle.program, runs, sheet))
    board = draw(on_paper, hand, np.random.default_rng(SEED), (len(places), DRAWINGS))
    largest, errors = [references(cycle.program, there.values) for there in runs], {}
    for name in names:
        exact = np.array([there.values[name] for there in runs])[:, None]
        drawings = np.broadcast_to(board.values[name], (len(places), DRAWINGS))
        errors[name] = kept(drawings, exact) * (1.0 / _beside(cycle, name, np.array([of[name] for of in largest])))
    for kind in kinds:
        yield Way(HAND, sheet.paper).entry(kind.name, places, {name: errors[name] for name in kind.names})


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
