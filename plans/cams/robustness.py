"""How much diagrams by chords stand: a section line beside a jump, a velocity that does not return to zero."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import run
from ..hands.hand import Hand
from ..hands.shaky import draw
from ..hands.spread import kept
from .closing import travel_errors
from .convergence import DRAWINGS, SEED
from .formulas import MM_PER_M
from .integration import ACCELERATION, TRAVEL, VELOCITY, Division
from .sectioned import NEAR, drawn_on, exact_values, inner_jumps, nodes, ordinates
from .solve import SolvedCam

Array = NDArray[np.float64]
SECTIONS = (12, 24, 48)  # at which a line beside a jump is looked at
BESIDE = tuple(k / 20.0 for k in range(-10, 11))  # parts of a section by which the line is late
DRAWN = 12  # sections that hands draw


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
    paper = drawn_on(solved, angles, division, nodes(solved, division))
    values = draw(paper, hand, np.random.default_rng(SEED), DRAWINGS).values
    travel = ordinates(values, TRAVEL, division, DRAWINGS)
    speed = ordinates(values, VELOCITY, division, DRAWINGS) if solved.layout.given == ACCELERATION else None
    found = travel_errors(solved, angles, division, values, DRAWINGS)
    return Closing(
        None if speed is None else _millimetres(speed[division.top]),
        None if speed is None else _millimetres(speed[division.last]),
        _millimetres(travel[division.last]),
        {way: float(kept(errors, 0.0)) for way, errors in found.items()},
    )


def _millimetres(ordinates: Array) -> float:
    return float(kept(ordinates, 0.0)) * MM_PER_M
