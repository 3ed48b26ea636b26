"""Error against the number of sections: the diagrams of a cam drawn by chords over and over, exactly and by hands.

Chords err as the square of a section when every jump of the acceleration lies on a section line, as the section itself
when one lies between lines. A hand errs the more the more chords it draws, so that for each there is a best number.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ..boards.exact import run
from ..hands.hand import Hand
from ..hands.shaky import Paper, draw
from ..hands.spread import kept
from .cam import DIAGRAMS, ROLLER, SIZES
from .construction import construct
from .division import Division
from .givens import diagram_givens
from .integration import ACCELERATION
from .motion import Motion, Phase
from .solve import SolvedCam

Array = NDArray[np.float64]
NODES, BETWEEN = "nodes", "between"  # where the jumps of the acceleration lie
V_MAX, S_MAX, MU_S, R_0 = QUANTITIES = ("V_max_chord", "S_max_chord", "mu_s_chord", "r_0_tangents")
EXACT = {V_MAX: "_V_max", S_MAX: "_S_max", MU_S: "mu_s"}  # what the exact curves give
SECTIONS = (6, 12, 24, 48, 96, 192, 384)  # of a phase
DRAWN = (6, 9, 12, 18, 24, 36, 48, 72)
FINE = 24  # sections from which on errors show their order
ROUNDING = 1e-11  # error that is none
THIRD, ROUNDED = 1.0 / 3.0, 9  # of a section; decimals
NEAR = 1e-6  # part of a section within which a jump lies on a line
DRAWINGS, SEED = 400, 1
ENOUGH = 1.1  # times the least error that is as good
MU_L = 1e-3  # m/mm, of plans that the sizes do not depend on


@dataclass(frozen=True, slots=True)
class Sectioned:
    """The diagrams of a cam with so many `sections` of the rise: the construction as it is drawn, and its values."""

    sections: int
    angles: Array
    division: Division
    paper: Paper
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Convergence:
    """Errors in parts of the exact value, by quantity, one for each number of sections.

    Parameters
    ----------
    exact : mapping of str to float
        The exact values, SI; of V_max and S_max in metres of paper.
    sections : mapping of str to tuple of int
        Sections of the rise by where jumps lie, `nodes` or `between`; the latter only where some lie within a phase.
    errors : mapping of (str, str) to array
        By where jumps lie and quantity, signed.
    drawn : tuple of int
        Numbers of sections at which hands were looked at.
    hands : mapping of (str, str) to array
        What 95 % of the drawings of a hand keep, by hand and quantity.
    """

    exact: Mapping[str, float]
    sections: Mapping[str, tuple[int, ...]]
    errors: Mapping[tuple[str, str], Array]
    drawn: tuple[int, ...]
    hands: Mapping[tuple[str, str], Array]

    @property
    def quantities(self) -> tuple[str, ...]:
        """The quantities that are compared."""
        return tuple(self.exact)

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
        at = int(np.argmax(errors <= ENOUGH * errors.min()))
        return self.drawn[at], float(errors[at])


def convergence(
    solved: SolvedCam,
    hands: Mapping[str, Hand],
    quantities: Sequence[str] = (),
    sections: Iterable[int] = SECTIONS,
    drawn: Iterable[int] = DRAWN,
) -> Convergence:
    """Draw the diagrams with more and more sections.

    Parameters
    ----------
    solved : SolvedCam
        With its diagrams, and its sizes when r_0 is wanted.
    hands : mapping of str to Hand
        Hands by their names.
    quantities : sequence of str
        Of `QUANTITIES`, all when empty.

    Raises
    ------
    InputError
        With the key `chart-exact-chords`: chords make no error, because the velocity is constant.
    """
    exact = {name: value for name, value in exact_values(solved).items() if not quantities or name in quantities}
    wanted = tuple(sections)
    on_nodes = [at_nodes(solved, n, exact) for n in wanted]
    beside = [between(solved, n, exact) for n in wanted] if inner_jumps(solved.motion) else []
    found = {NODES: _unique(on_nodes), **({BETWEEN: _unique(beside)} if beside else {})}
    errors = {
        (where, name): np.array([one.values[name] / value - 1.0 for one in ones])
        for where, ones in found.items()
        for name, value in exact.items()
    }
    if all(np.abs(error).max() < ROUNDING for error in errors.values()):
        raise InputError("chart-exact-chords")
    papers = _unique([at_nodes(solved, n, exact) for n in drawn])
    by_hand = {
        (hand, name): errors_by_hand
        for hand, errs in hands.items()
        for name, errors_by_hand in _by_hand(papers, errs, exact).items()
    }
    counts = {where: tuple(one.sections for one in ones) for where, ones in found.items()}
    return Convergence(exact, counts, errors, tuple(one.sections for one in papers), by_hand)


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


def equal_division(motion: Motion, count: int, last: float = 0.0) -> tuple[Array, Division]:
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
    program = construct(layout, (SIZES,) if sized else (DIAGRAMS,))
    givens = {**solved.givens, **diagram_givens(motion, angles, division, given)}
    return Paper(program.needed_for(names), givens, _worth(solved), solved.edges)


def _worth(solved: SolvedCam) -> dict[str, float]:
    """Return what a millimetre of the plans that are drawn is worth to the board, SI."""
    return solved.worth({plan: solved.values.get(mu, MU_L) for plan, mu in solved.scale_of_plan.items()})


def _sectioned(solved: SolvedCam, angles: Array, division: Division, names: tuple[str, ...]) -> Sectioned:
    paper = drawn_on(solved, angles, division, names)
    values = run(paper.program, paper.givens).values
    return Sectioned(division.top, angles, division, paper, {name: float(values[name]) for name in names})


def _unique(ones: Iterable[Sectioned]) -> list[Sectioned]:
    """Leave out what has the number of sections of another."""
    return [*{one.sections: one for one in ones}.values()]


def _by_hand(papers: Iterable[Sectioned], hand: Hand, exact: Mapping[str, float]) -> dict[str, Array]:
    """Return what most drawings of a hand keep, in parts of the exact values."""
    found: dict[str, list[float]] = {name: [] for name in exact}
    for one in papers:
        board = draw(one.paper, hand, np.random.default_rng(SEED), DRAWINGS)
        for name, value in exact.items():
            drawings = np.broadcast_to(board.values[name], DRAWINGS)
            found[name].append(float(kept(drawings, value)) / value)
    return {name: np.array(errors) for name, errors in found.items()}
