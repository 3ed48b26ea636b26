"""How much diagrams by chords stand: a section line beside a jump, a velocity that does not return to zero.

What a hand draws does not close: at the end of a phase the velocity is not zero, after the fall the travel is not. The
closing error of the velocity may be distributed over its phase, that of the travel over the turn, in proportion to the
way along the axis; as the travel is the integral of the velocity, the first changes the travel, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import run
from ..hands.hand import Hand
from ..hands.shaky import draw
from ..hands.spread import kept
from .convergence import DRAWINGS, NEAR, SEED, drawn_on, exact_values, inner_jumps
from .division import Division
from .integration import ACCELERATION, TRAVEL, VELOCITY
from .solve import SolvedCam

Array = NDArray[np.float64]
SECTIONS = (12, 24, 48)  # at which a line beside a jump is looked at
BESIDE = tuple(k / 20.0 for k in range(-10, 11))  # parts of a section by which the line is late
DRAWN = 12  # sections that hands draw
AS_DRAWN, SPEED, STROKE, BOTH = WAYS = ("drawn", "speed", "stroke", "both")  # what has been closed
MM = 1e3


@dataclass(frozen=True, slots=True)
class Closing:
    """How the drawings of a hand close: what 95 % of them keep.

    Parameters
    ----------
    speed_top, speed_last, stroke_last : float
        Ordinates of the velocity at the end of the rise and of the fall, of the travel at the end of the fall, mm.
    errors : mapping of str to float
        Error of the scaled travel on the worst section line, in parts of the stroke, by what has been closed.
    """

    speed_top: float | None
    speed_last: float | None
    stroke_last: float
    errors: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Robustness:
    """What happens to diagrams by chords.

    Parameters
    ----------
    beside : tuple of float
        Parts of a section by which section lines at jumps are late; empty where no jump lies within a phase.
    missed : mapping of (int, str) to array
        Errors in parts of the exact values, by the number of sections and quantity.
    sections : int
        Sections of the rise that hands draw.
    closings : mapping of str to Closing
        By hand.
    """

    beside: tuple[float, ...]
    missed: Mapping[tuple[int, str], Array]
    sections: int
    closings: Mapping[str, Closing]


def robustness(solved: SolvedCam, hands: Mapping[str, Hand], sections: Iterable[int] = SECTIONS) -> Robustness:
    """Draw section lines beside jumps; let hands draw, and close what they have drawn."""
    exact = exact_values(solved)
    missed: dict[tuple[int, str], Array] = {}
    beside = BESIDE if inner_jumps(solved.motion) else ()
    for count in sections if beside else ():
        angles, division = solved.motion.division(count)
        found = [_missed(solved, angles, division, part, tuple(exact)) for part in beside]
        for name, value in exact.items():
            missed[division.top, name] = np.array([values[name] for values in found]) / value - 1.0
    angles, division = solved.motion.division(DRAWN)
    closings = {name: _closing(solved, angles, division, hand) for name, hand in hands.items()}
    return Robustness(beside, missed, division.top, closings)


def late(solved: SolvedCam, angles: Array, part: float) -> Array:
    """Return section lines, those at jumps within phases late by a part of the section that they move into."""
    moved = angles.copy()
    for phase in (solved.motion.rise, solved.motion.fall):
        for jump in solved.motion.jumps:
            inside = NEAR < (jump.phi - phase.start) / phase.length < 1.0 - NEAR
            if jump.order == 2 and inside:
                i = int(np.abs(angles - jump.phi).argmin())
                moved[i] += part * (angles[i + 1] - angles[i] if part > 0.0 else angles[i] - angles[i - 1])
    return moved


def _missed(
    solved: SolvedCam, angles: Array, division: Division, part: float, names: tuple[str, ...]
) -> dict[str, float]:
    paper = drawn_on(solved, late(solved, angles, part), division, names)
    values = run(paper.program, paper.givens).values
    return {name: float(values[name]) for name in names}


def _closing(solved: SolvedCam, angles: Array, division: Division, hand: Hand) -> Closing:
    """Let a hand draw, and look at how it closes."""
    fast = solved.layout.given == ACCELERATION
    marks = [f"{plan}.{i}" for plan in ((VELOCITY, TRAVEL) if fast else (TRAVEL,)) for i in division.lines]
    board = draw(drawn_on(solved, angles, division, tuple(marks)), hand, np.random.default_rng(SEED), DRAWINGS)

    def ordinates(plan: str) -> Array:
        return np.array([np.broadcast_to(np.imag(board.values[f"{plan}.{i}"]), DRAWINGS) for i in division.lines])

    x = angles / (solved.givens["mu_phi"] * MM)
    travel, speed = ordinates(TRAVEL), ordinates(VELOCITY) if fast else None
    exact = solved.motion.at(angles, -1)[0] / solved.motion.h
    closed = {AS_DRAWN: travel, STROKE: stroke_closed(travel, x)}
    if speed is not None:
        closed[SPEED] = travel - drift(speed, x, division, solved.givens["H_v"])
        closed[BOTH] = stroke_closed(closed[SPEED], x)
    return Closing(
        None if speed is None else _millimetres(speed[division.top]),
        None if speed is None else _millimetres(speed[division.last]),
        _millimetres(travel[division.last]),
        {way: _worst(closed[way], exact, division) for way in WAYS if way in closed},
    )


def stroke_closed(travel: Array, x: Array) -> Array:
    """Return ordinates of the travel, shape (lines, ...), with the error at the last line distributed over the turn."""
    share: Any = (x / x[-1]).reshape(-1, *(1,) * (travel.ndim - 1))
    closed: Array = travel - share * travel[-1]
    return closed


def drift(speed: Array, x: Array, division: Division, pole_distance: float) -> Array:
    """Return by how much the travel falls when the velocity is brought back to zero at the ends of rise and fall.

    Parameters
    ----------
    speed : array of shape (lines, ...)
        Ordinates of the velocity on the section lines, m of paper.
    x : array of shape (lines,)
        Abscissas, m of paper.
    """
    column = x.reshape(-1, *(1,) * (speed.ndim - 1))
    top, leave, last = division.top, division.leave, division.last
    off = np.empty_like(speed)
    off[: top + 1] = speed[top] * (column[: top + 1] / x[top])
    part = (column[leave:] - x[leave]) / (x[last] - x[leave])
    off[leave:] = speed[leave] * (1.0 - part) + speed[last] * part
    areas = 0.5 * (off[1:] + off[:-1]) * np.diff(column, axis=0)
    found: Array = np.concatenate((np.zeros_like(speed[:1]), np.cumsum(areas, axis=0))) * (1.0 / pole_distance)
    return found


def _millimetres(ordinates: Array) -> float:
    return float(kept(ordinates, 0.0)) * MM


def _worst(travel: Array, exact: Array, division: Division) -> float:
    """Return the error on the worst line of a travel that is scaled by its own stroke."""
    scaled = travel * (1.0 / travel[division.top])
    return float(kept(np.max(np.abs(scaled - exact[:, None]), axis=0), 0.0))
