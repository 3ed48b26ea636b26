"""The diagrams of a cam on a division of one's own: any number of sections, jumps on their lines or between them.

They are closed when they have been drawn: the velocity brought back to zero, then the travel. What a hand draws does
not close: at the end of a phase the velocity is not zero, after the fall the travel is not. The closing error of the
velocity may be distributed over its phase, that of the travel over the turn, in proportion to the way along the axis;
as the travel is the integral of the velocity, the first changes the travel, too.

They are drawn with more and more sections, exactly and by hands, and with a section line beside a jump. Chords err as
the square of a section when every jump of the acceleration lies on a section line, as the section itself when one lies
between lines. A hand errs the more the more chords it draws, so that for each there is a best number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ...scales.errors import InputError
from ..boards.arrays import ArrayBoard
from ..boards.exact import run
from ..hands.shaky import Alike, Hand, Hands, Paper, draw
from ..hands.spread import kept
from .cam import DIAGRAMS_PART, SIZES_PART
from .construction import ACCELERATION, MM_PER_M, TRAVEL, VELOCITY, construct
from .motion import Array, Division, Motion
from .solve import EQUAL, SolvedCam, diagram_givens

V_MAX, S_MAX, MU_S, R_0 = "V_max_chord", "S_max_chord", "mu_s_chord", "r_0_tangents"
EXACT = {V_MAX: "_V_max", S_MAX: "_S_max", MU_S: "mu_s"}  # what the exact curves give
NEAR = 1e-6  # part of a section within which a jump lies on a line
THIRD, ROUNDED = 1.0 / 3.0, 9  # of a section; decimals
MU_L = 1e-3  # m/mm, of plans that the sizes do not depend on


def _exact_values(solved: SolvedCam) -> dict[str, float]:
    """Return what the exact curves give for the quantities that the chords of a cam have."""
    found = {name: float(solved.values[of]) for name, of in EXACT.items()}
    if solved.layout.given != ACCELERATION:  # the velocity is given, not found
        del found[V_MAX]
    if solved.roller is not None:
        found[R_0] = solved.roller.by_tangents.r_0
    return found


def _between(motion: Motion, sections: int) -> Division:
    """Return about so many equal sections of a phase, jumps about a third of a section beside lines.

    The first jump lies behind the line: so errors of all numbers of sections have the same sign.
    """
    parts = list(inner_jumps(motion).values())

    def off(count: int) -> float:
        beside = [part * count - math.floor(part * count) for part in parts]
        return abs(beside[0] - THIRD) + sum(abs(min(x, 1.0 - x) - THIRD) for x in beside)

    counts = range(sections, sections + max(5, sections // 8))
    return equal_division(motion, min(counts, key=lambda count: round(off(count), ROUNDED)))


def inner_jumps(motion: Motion) -> dict[float, float]:
    """Return the jumps of the acceleration within rise and fall: by angle, the place of each as part of its phase."""
    return {
        jump.phi: part
        for phase in (motion.rise, motion.fall)
        for jump in motion.jumps
        if jump.order == 2 and NEAR < (part := (jump.phi - phase.start) / phase.length) < 1.0 - NEAR
    }


def equal_division(motion: Motion, count: int) -> Division:
    """Return section lines that divide rise and fall into `count` equal parts each, jumps wherever they lie."""
    parts = np.arange(count + 1) / count
    rise, fall = (phase.start + phase.length * parts for phase in (motion.rise, motion.fall))
    return motion.divided(rise, fall, NEAR * motion.rise.length / count)


def drawn_on(solved: SolvedCam, division: Division, names: tuple[str, ...] = ()) -> Paper:
    """Return the construction of some values on a division of one's own, as it is drawn; of the nodes without names."""
    motion, given, sized = solved.motion, solved.layout.given, solved.roller is not None
    layout = replace(solved.layout, division=division, plate=None, fastest=_fastest_line(solved, division))
    program = construct(layout, (SIZES_PART,) if sized else (DIAGRAMS_PART,))
    givens = {**solved.givens, **diagram_givens(motion, division, given)}
    mus = {plan: EQUAL.get(mu, mu) for plan, mu in solved.scale_of_plan.items()}
    worth = solved.worth({plan: solved.values.get(mu, MU_L) for plan, mu in mus.items()})
    return Paper(program.needed_for(names or nodes(solved, division)), givens, worth, solved.edges)


def _fastest_line(solved: SolvedCam, division: Division) -> int:
    """Return the section line that is nearest to the greatest velocity."""
    return int(np.abs(division.angles - solved.motion.ds_max.phi).argmin())


def nodes(solved: SolvedCam, division: Division) -> tuple[str, ...]:
    """Return the marks of the nodes that are drawn: of the travel, and of the velocity where it is not given."""
    plans = (TRAVEL, VELOCITY) if solved.layout.given == ACCELERATION else (TRAVEL,)
    return tuple(f"{plan}.{i}" for plan in plans for i in division.lines)


def ordinates(values: Mapping[str, Any], plan: str, division: Division, *shape: int) -> Array:
    """Return the ordinates of a diagram on all section lines, shape (lines, *shape), m of paper."""
    return np.array([np.broadcast_to(np.imag(values[f"{plan}.{i}"]), shape) for i in division.lines])


AS_DRAWN, SPEED, STROKE, BOTH = WAYS = ("drawn", "speed", "stroke", "both")  # what has been closed


def _travel_errors(solved: SolvedCam, division: Division, values: Mapping[str, Any], *shape: int) -> dict[str, Array]:
    """Return the errors of a drawn travel on its worst section line, in parts of the stroke, by what has been closed.

    The nodes among the `values` are numbers or arrays of `shape`, the errors too. They stand by `WAYS`; where the
    velocity is given there is none to be closed. The travel is scaled by its own stroke.
    """
    x = division.angles * (1.0 / (solved.givens["mu_phi"] * MM_PER_M))
    travel = ordinates(values, TRAVEL, division, *shape)
    closed = {AS_DRAWN: travel, STROKE: _stroke_closed(travel, x)}
    if solved.layout.given == ACCELERATION:
        speed = ordinates(values, VELOCITY, division, *shape)
        closed[SPEED] = travel - _drift(speed, x, division, solved.givens["H_v"])
        closed[BOTH] = _stroke_closed(closed[SPEED], x)
    exact = _column(solved.motion.at(division.angles, -1)[0] * (1.0 / solved.motion.h), travel)
    scaled = {way: closed[way] * (1.0 / closed[way][division.top]) for way in WAYS if way in closed}
    return {way: np.max(np.abs(travel - exact), axis=0) for way, travel in scaled.items()}


def _stroke_closed(travel: Array, x: Array) -> Array:
    """Return ordinates of the travel, shape (lines, ...), with the error at the last line distributed over the turn."""
    closed: Array = travel - _column(x / x[-1], travel) * travel[-1]
    return closed


def _drift(speed: Array, x: Array, division: Division, pole_distance: float) -> Array:
    """Return by how much the travel falls when the velocity is brought back to zero at the ends of rise and fall.

    The ordinates of `speed` have the shape (lines, ...), the abscissas `x` the shape (lines,), both in m of paper.
    """
    column = _column(x, speed)
    top, leave, last = division.top, division.leave, division.last
    off = np.empty_like(speed)
    off[: top + 1] = speed[top] * (column[: top + 1] / x[top])
    part = (column[leave:] - x[leave]) / (x[last] - x[leave])
    off[leave:] = speed[leave] * (1.0 - part) + speed[last] * part
    areas = 0.5 * (off[1:] + off[:-1]) * np.diff(column, axis=0)
    found: Array = np.concatenate((np.zeros_like(speed[:1]), np.cumsum(areas, axis=0))) * (1.0 / pole_distance)
    return found


def _column(x: Array, beside: Array) -> Array:
    """Return numbers of section lines as a column beside ordinates of many drawings."""
    return x.reshape(-1, *(1,) * (beside.ndim - 1))


NODES, BETWEEN = "nodes", "between"  # where the jumps of the acceleration lie
CLOSED = "s_closed"  # the travel on the worst section line, after velocity and travel have been closed
SECTIONS = (6, 12, 24, 48, 96, 192)  # of a phase
DRAWN = (6, 9, 12, 18, 24, 36, 48, 72)
FINE = 24  # sections from which on errors show their order
ROUNDING = 1e-11  # error that is none
DRAWINGS, SEED = 400, 1
ENOUGH = 1.1  # times the least error that is as good


@dataclass(frozen=True, slots=True, eq=False)
class Convergence:
    """Errors by quantity, one for each number of sections: in parts of the exact value, of `s_closed` of the stroke."""

    exact: Mapping[str, float]  # the exact values, SI; of V_max and S_max in metres of paper
    quantities: tuple[str, ...]  # what is compared
    # sections of the rise by where jumps lie, `nodes` or `between`; the latter only where some lie within a phase
    sections: Mapping[str, tuple[int, ...]]
    errors: Mapping[tuple[str, str], Array]  # by where jumps lie and quantity, signed
    drawn: tuple[int, ...]  # numbers of sections at which hands were looked at
    hands: Mapping[tuple[str, str], Array]  # what 95 % of the drawings of a hand keep, by hand and quantity

    def order(self, where: str, quantity: str) -> float | None:
        """Return the power of the section as which an error falls; None when it is rounding."""
        n = np.array(self.sections[where], float)
        error = np.abs(self.errors[where, quantity])
        shown = (n >= FINE) & (error > ROUNDING)
        if shown.sum() < 3:
            return None
        return -float(np.polyfit(np.log(n[shown]), np.log(error[shown]), 1)[0])

    def best(self, hand: str, quantity: str) -> tuple[int, float]:
        """Return the fewest sections with which a hand errs hardly more than it must, and its error."""
        errors = self.hands[hand, quantity]
        least = np.min(errors, initial=np.inf, where=np.isfinite(errors))
        at = int(np.argmax(errors <= ENOUGH * least))
        return self.drawn[at], float(errors[at])


def convergence(
    solved: SolvedCam,
    hands: Mapping[str, Hand],
    quantities: Sequence[str] = (),
    sections: Iterable[int] = SECTIONS,
    drawn: Iterable[int] = DRAWN,
) -> Convergence:
    """Draw the diagrams of a cam, which has its sizes when r_0 is wanted, with more and more sections, and by `hands`.

    The `quantities` are of `compared`, all when empty.

    Raises InputError: with the key `chart-exact-chords`: chords make no error, because the velocity is constant.
    """
    chosen = tuple(name for name in compared(solved) if not quantities or name in quantities)
    exact = {name: value for name, value in _exact_values(solved).items() if name in chosen}
    divided: dict[str, Callable[[int], Division]] = {NODES: solved.motion.division}
    if inner_jumps(solved.motion):
        divided[BETWEEN] = partial(_between, solved.motion)
    wanted = tuple(sections)
    found = {where: _drawings(solved, map(divide, wanted), exact) for where, divide in divided.items()}
    errors = {
        (where, name): np.array([_error(solved, drawing, name, exact) for drawing in every])
        for where, every in found.items()
        for name in chosen
    }
    if all(np.abs(error).max() < ROUNDING for error in errors.values()):
        raise InputError("chart-exact-chords")
    papers = _drawings(solved, map(solved.motion.division, drawn), exact)
    at_once = Hands.of(hands.values()) if hands else None
    kept_by_hand = [_by_hand(solved, drawing, at_once, chosen, exact) for drawing in papers if at_once]
    by_hand = {
        (hand, name): np.array([errors[name][i] for errors in kept_by_hand])
        for i, hand in enumerate(hands)
        for name in chosen
    }
    counts = {where: tuple(division.top for division, *_ in every) for where, every in found.items()}
    return Convergence(exact, chosen, counts, errors, tuple(division.top for division, *_ in papers), by_hand)


Drawing = tuple[Division, Paper, Mapping[str, Any]]  # the construction on a division as it is drawn, and its values


def _drawings(solved: SolvedCam, divisions: Iterable[Division], names: Iterable[str]) -> list[Drawing]:
    """Draw the diagrams on divisions, with each number of sections once."""
    found: list[Drawing] = []
    for division in {division.top: division for division in divisions}.values():
        paper = drawn_on(solved, division, (*names, *nodes(solved, division)))
        found.append((division, paper, run(paper.program, paper.givens).values))
    return found


def compared(solved: SolvedCam) -> tuple[str, ...]:
    """Return the names of what can be compared."""
    return (*_exact_values(solved), CLOSED)


def _error(solved: SolvedCam, drawing: Drawing, name: str, exact: Mapping[str, float]) -> float:
    """Return the error of chords alone."""
    division, _, values = drawing
    if name in exact:
        return float(values[name] / exact[name] - 1.0)
    found = _travel_errors(solved, division, values)
    return float(found.get(BOTH, found[STROKE]))


def _by_hand(
    solved: SolvedCam, drawing: Drawing, hands: Hands, names: Iterable[str], exact: Mapping[str, float]
) -> dict[str, Array]:
    """Return what most drawings of each hand keep, shape (hands,); their errors are alike."""
    division, paper, _ = drawing
    shape = len(hands.point), DRAWINGS
    values = draw(paper, hands, Alike(np.random.default_rng(SEED)), shape).values

    def missed(name: str) -> Array:
        if name in exact:
            return kept(np.broadcast_to(values[name], shape), exact[name]) / exact[name]
        found = _travel_errors(solved, division, values, *shape)
        return kept(found.get(BOTH, found[STROKE]), 0.0)

    return {name: missed(name) for name in names}


BESIDE_AT = (12, 24, 48)  # at which a line beside a jump is looked at
BESIDE = tuple(k / 20.0 for k in range(-10, 11))  # parts of a section by which the line is late
CLOSED_AT = 12  # sections that hands draw


@dataclass(frozen=True, slots=True)
class _Closing:
    """How the drawings of a hand close: what 95 % of them keep."""

    # ordinates of the velocity at the end of the rise and of the fall, of the travel at the end of the fall, mm
    speed_top: float | None
    speed_last: float | None
    stroke_last: float
    # error of the scaled travel on the worst section line, in parts of the stroke, by what has been closed
    errors: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Robustness:
    """What happens to diagrams by chords."""

    # parts of a section by which section lines at jumps are late; empty where no jump lies within a phase
    beside: tuple[float, ...]
    # errors in parts of the exact values, by the number of sections and quantity
    missed: Mapping[tuple[int, str], Array]
    sections: int  # sections of the rise that hands draw
    closings: Mapping[str, _Closing]  # by hand


def robustness(solved: SolvedCam, hands: Mapping[str, Hand], sections: Iterable[int] = BESIDE_AT) -> Robustness:
    """Draw section lines beside jumps; let hands draw, and close what they have drawn."""
    exact = _exact_values(solved)
    missed: dict[tuple[int, str], Array] = {}
    beside = BESIDE if inner_jumps(solved.motion) else ()
    for count in sections if beside else ():
        division = solved.motion.division(count)
        found = _drawn_late(solved, division, beside, tuple(exact))
        for name, value in exact.items():
            missed[division.top, name] = found[name] / value - 1.0
    division = solved.motion.division(CLOSED_AT)
    closings = dict(zip(hands, _closings(solved, division, hands.values()), strict=True))
    return Robustness(beside, missed, division.top, closings)


def _drawn_late(
    solved: SolvedCam, division: Division, parts: Sequence[float], names: Sequence[str]
) -> dict[str, Array]:
    """Return values of diagrams whose lines at jumps are late by each of the parts, all of them at once."""
    divisions = [late(solved, division, part) for part in parts]
    fastest = [_fastest_line(solved, each) for each in divisions]
    found = {name: np.empty(len(parts)) for name in names}
    for line in sorted(set(fastest)):  # the line of the greatest velocity belongs to the construction
        which = [i for i, own in enumerate(fastest) if own == line]
        paper = drawn_on(solved, divisions[which[0]], tuple(names))
        each = [diagram_givens(solved.motion, divisions[i], solved.layout.given) for i in which]
        stacked = {name: np.array([one[name] for one in each]) for name in each[0]}
        board = ArrayBoard({**paper.givens, **stacked}, len(which))
        paper.program.run(board)
        for name in names:
            found[name][which] = board.values[name]
    return found


def late(solved: SolvedCam, division: Division, part: float) -> Division:
    """Return section lines, those at jumps within phases late by a part of the section that they move into."""
    angles = division.angles
    moved = angles.copy()
    for phi in inner_jumps(solved.motion):
        i = int(np.abs(angles - phi).argmin())
        moved[i] += part * (angles[i + 1] - angles[i] if part > 0.0 else angles[i] - angles[i - 1])
    return replace(division, angles=moved)


def _closings(solved: SolvedCam, division: Division, hands: Collection[Hand]) -> list[_Closing]:
    """Let hands draw, and look at how each closes."""
    if not hands:
        return []
    shape = len(hands), DRAWINGS
    alike = Alike(np.random.default_rng(SEED))
    values = draw(drawn_on(solved, division), Hands.of(hands), alike, shape).values

    def end(plan: str, line: int) -> list[float]:
        return [float(one) * MM_PER_M for one in kept(ordinates(values, plan, division, *shape)[line], 0.0)]

    given = solved.layout.given == ACCELERATION
    top, last = (end(VELOCITY, line) if given else [None] * len(hands) for line in (division.top, division.last))
    errors = {way: kept(error, 0.0) for way, error in _travel_errors(solved, division, values, *shape).items()}
    return [
        _Closing(top[i], last[i], stroke, {way: float(error[i]) for way, error in errors.items()})
        for i, stroke in enumerate(end(TRAVEL, division.last))
    ]
