"""The diagrams of a cam on a division of one's own: any number of sections, jumps on their lines or between them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import run
from ..hands.shaky import Paper
from .cam import DIAGRAMS_PART, ROLLER, SIZES_PART
from .construction import construct
from .givens import diagram_givens
from .integration import ACCELERATION, TRAVEL, VELOCITY, Division
from .motion import Motion, Phase
from .solve import EQUAL, SolvedCam

Array = NDArray[np.float64]
V_MAX, S_MAX, MU_S, R_0 = "V_max_chord", "S_max_chord", "mu_s_chord", "r_0_tangents"
EXACT = {V_MAX: "_V_max", S_MAX: "_S_max", MU_S: "mu_s"}  # what the exact curves give
NEAR = 1e-6  # part of a section within which a jump lies on a line
THIRD, ROUNDED = 1.0 / 3.0, 9  # of a section; decimals
MU_L = 1e-3  # m/mm, of plans that the sizes do not depend on


@dataclass(frozen=True, slots=True)
class Sectioned:
    """The diagrams of a cam with so many `sections` of the rise: the construction as it is drawn, and its values."""

    sections: int
    angles: Array
    division: Division
    paper: Paper
    values: Mapping[str, Any]


def exact_values(solved: SolvedCam) -> dict[str, float]:
    """Return what the exact curves give for the quantities that the chords of a cam have."""
    found = {name: float(solved.values[of]) for name, of in EXACT.items()}
    if solved.layout.given != ACCELERATION:  # the velocity is given, not found
        del found[V_MAX]
    if solved.roller is not None:
        found[R_0] = solved.roller.by_tangents.r_0
    return found


def at_nodes(solved: SolvedCam, sections: int, names: Iterable[str]) -> Sectioned:
    """Draw the diagrams with at least so many sections of a phase and every jump on a section line."""
    return _sectioned(solved, *solved.motion.division(sections), tuple(names))


def between(solved: SolvedCam, sections: int, names: Iterable[str]) -> Sectioned:
    """Draw the diagrams with about so many equal sections of a phase, jumps about a third of a section beside lines.

    The first jump lies behind the line: so errors of all numbers of sections have the same sign.
    """
    parts = inner_jumps(solved.motion)

    def off(count: int) -> float:
        beside = [part * count - math.floor(part * count) for part in parts]
        return abs(beside[0] - THIRD) + sum(abs(min(x, 1.0 - x) - THIRD) for x in beside)

    count = min(range(sections, sections + max(5, sections // 8)), key=lambda count: round(off(count), ROUNDED))
    return _sectioned(solved, *equal_division(solved.motion, count), tuple(names))


def inner_jumps(motion: Motion) -> list[float]:
    """Return the places of jumps of the acceleration within rise and fall, each as part of its phase."""
    return [
        part
        for phase in (motion.rise, motion.fall)
        for jump in motion.jumps
        if jump.order == 2 and NEAR < (part := (jump.phi - phase.start) / phase.length) < 1.0 - NEAR
    ]


def equal_division(motion: Motion, count: int) -> tuple[Array, Division]:
    """Return section lines that divide rise and fall into `count` equal parts each, jumps wherever they lie."""

    def lines(phase: Phase) -> Array:
        return phase.start + phase.length * (np.arange(count + 1) / count)

    rise, fall = lines(motion.rise), lines(motion.fall)
    leave = count + (motion.upper.length > 0.0)
    angles = np.concatenate((rise, fall if leave > count else fall[1:]))
    places = [int(np.abs(angles - jump.phi).argmin()) for jump in motion.jumps]
    close = NEAR * motion.rise.length / count
    hit = (i for i, jump in zip(places, motion.jumps, strict=True) if abs(angles[i] - jump.phi) < close)
    end = leave + count
    return angles, Division(count, leave, end, tuple(i for i in hit if 0 < i < count or leave < i < end))


def drawn_on(solved: SolvedCam, angles: Array, division: Division, names: tuple[str, ...]) -> Paper:
    """Return the construction of some values on a division of one's own, as it is drawn."""
    motion, given = solved.motion, solved.layout.given
    sized = solved.roller is not None
    fastest = int(np.abs(angles - motion.ds_max.phi).argmin())
    layout = replace(solved.layout, division=division, followers=(ROLLER,) if sized else (), fastest=fastest)
    program = construct(layout, (SIZES_PART,) if sized else (DIAGRAMS_PART,))
    givens = {**solved.givens, **diagram_givens(motion, angles, division, given)}
    return Paper(program.needed_for(names), givens, _worth(solved), solved.edges)


def _worth(solved: SolvedCam) -> dict[str, float]:
    """Return what a millimetre of the plans that are drawn is worth to the board, SI."""
    mus = ((plan, EQUAL.get(mu, mu)) for plan, mu in solved.scale_of_plan.items())
    return solved.worth({plan: solved.values.get(mu, MU_L) for plan, mu in mus})


def _sectioned(solved: SolvedCam, angles: Array, division: Division, names: tuple[str, ...]) -> Sectioned:
    paper = drawn_on(solved, angles, division, (*names, *nodes(solved, division)))
    values = run(paper.program, paper.givens).values
    return Sectioned(division.top, angles, division, paper, values)


def nodes(solved: SolvedCam, division: Division) -> tuple[str, ...]:
    """Return the marks of the nodes that are drawn: of the travel, and of the velocity where it is not given."""
    plans = (TRAVEL, VELOCITY) if solved.layout.given == ACCELERATION else (TRAVEL,)
    return tuple(f"{plan}.{i}" for plan in plans for i in division.lines)


def ordinates(values: Mapping[str, Any], plan: str, division: Division, *shape: int) -> Array:
    """Return the ordinates of a diagram on all section lines, shape (lines, *shape), m of paper."""
    return np.array([np.broadcast_to(np.imag(values[f"{plan}.{i}"]), shape) for i in division.lines])
