"""Speed against accuracy of a cam's motion: closed forms, chords on the board, and numerical integration.

All rivals begin with the acceleration, or with the velocity where that is given, and find the travel, scaled by its own
stroke as on paper. An error is the worst over the section lines, in parts of the stroke or of the greatest velocity;
that of closed forms is their rounding, beside the same forms with longer numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.batch import batch
from ..boards.exact import run
from ..cams.chords import DRAWINGS, drawn_on, equal_division, inner_jumps, nodes, ordinates
from ..cams.construction import ACCELERATION, MM_PER_M, TRAVEL, VELOCITY
from ..cams.motion import TURN, Array, Division, Motion
from ..cams.solve import SolvedCam
from ..hands.shaky import Hand, draw
from ..hands.spread import kept
from .race import FULL, SEED, Clock, Contest, Discipline, Effort, Way, timed

Course = tuple[NDArray[Any], NDArray[Any]]  # travel and its derivative on section lines, in any scale
CLOSED, BOARD, BOARDS = "closed", "board", "boards"
MIDPOINT, MISSED, SIMPSON, HAND = "midpoint", "missed", "simpson", "hand"
ON_BOARD = (12, 24, 48, 96, 192)  # sections of a phase
AT_ONCE, CAMS = (12, 24), 1000  # sections of many cams at once, and how many
NUMERICAL = (12, 24, 48, 96, 192, 768, 3072, 12288)
BY_HAND = (12, 24, 48)
TRAVELS, VELOCITIES = "travel", "speed"


def _sections(motion: Motion, given: str, division: Division) -> tuple[Array, Array, Array, Array]:
    """Return widths of sections, and the derivative that is given at their beginnings, middles and ends."""
    angles, order = division.angles, 2 if given == ACCELERATION else 1
    middles = 0.5 * (angles[:-1] + angles[1:])
    at = (motion.at(angles[:-1], 1), motion.at(middles), motion.at(angles[1:], -1))
    begin, middle, end = (values[order] for values in at)
    return np.diff(angles), begin, middle, end


def _midpoint(motion: Motion, given: str, division: Division) -> Course:
    """Integrate by mean ordinates, as the chords do, without a board."""
    width, _, middle, _ = _sections(motion, given, division)
    speed = _summed(middle * width)
    if given != ACCELERATION:
        return speed, motion.at(division.angles, -1)[1]
    return _summed(0.5 * (speed[1:] + speed[:-1]) * width), speed


def _simpson(motion: Motion, given: str, division: Division) -> Course:
    """Integrate by parabolas through both ends and the middle of every section."""
    width, begin, middle, end = _sections(motion, given, division)
    speed = _summed((begin + 4.0 * middle + end) * width * (1.0 / 6.0))
    if given != ACCELERATION:
        return speed, motion.at(division.angles, -1)[1]
    return _summed(speed[:-1] * width + (begin + 2.0 * middle) * width * width * (1.0 / 6.0)), speed


def closed(motion: Motion, angles: Array) -> Course:
    """Take the closed forms."""
    s, ds, _ = motion.at(angles, -1)
    return s, ds


def _in_extended(motion: Motion, angles: Array) -> Course:
    """Take the closed forms with longer numbers than float64, where the machine has them."""
    s, ds = np.zeros(angles.shape, np.longdouble), np.zeros(angles.shape, np.longdouble)
    for piece in (piece for phase in motion.phases for piece in phase.pieces):
        there = (angles > piece.low) & (angles <= piece.high)
        for values, curve in ((s, piece), (ds, piece.derivative())):
            t = angles[there].astype(np.longdouble) - curve.origin
            found = np.zeros_like(t)
            for coefficient in reversed(curve.coefficients):
                found = found * t + coefficient
            angle, wave = curve.rate * t, curve.wave
            values[there] = found + (wave.real * np.cos(angle) - wave.imag * np.sin(angle))
    return s, ds


def _summed(parts: Array) -> Array:
    return np.concatenate((np.zeros(1), np.cumsum(parts)))


Result = tuple[Way, Division, dict[str, Array]]  # with errors on section lines, by kind


def _closed(solved: SolvedCam, clock: Clock, effort: Effort) -> Iterator[Result]:
    """Go through closed forms for so many positions at once."""
    motion = solved.motion
    division = motion.division(max(ON_BOARD))
    found = errors(motion, division, closed(motion, division.angles), _in_extended(motion, division.angles))
    for size in effort.batches:
        places = TURN * ((np.arange(size) + 0.5) / size)
        yield Way(CLOSED, size, timed(partial(closed, motion, places), clock)[1] / size, size), division, found


def _board(solved: SolvedCam, clock: Clock) -> Iterator[Result]:
    """Go through chords on the board: one cam alone, and many at once."""
    for sections in ON_BOARD:
        division = solved.motion.division(sections)
        count, paper = len(division.angles), drawn_on(solved, division)
        board, spent = timed(partial(run, paper.program, paper.givens), clock)
        found = _errors_drawn(solved, division, board.values)
        yield Way(BOARD, division.top, spent / count), division, found
        if sections in AT_ONCE:
            several = {**paper.givens, "l_A1": np.full(CAMS, paper.givens["l_A1"])}
            _, spent = timed(partial(batch, paper.program, several, nodes(solved, division)), clock)
            yield Way(BOARDS, division.top, spent / (count * CAMS), CAMS), division, found


def _numerical(solved: SolvedCam, clock: Clock) -> Iterator[Result]:
    """Go through sums of numbers, with jumps on section lines, and within sections where there are any."""
    motion, given = solved.motion, solved.layout.given
    ways: list[tuple[str, Callable[..., Course], Callable[[int], Division]]] = [
        (MIDPOINT, _midpoint, motion.division),
        (SIMPSON, _simpson, motion.division),
    ]
    if inner_jumps(motion):
        ways.append((MISSED, _midpoint, lambda sections: equal_division(motion, sections + 1)))
    for method, integrate, divided in ways:
        for division in map(divided, NUMERICAL):
            count = len(division.angles)
            course, spent = timed(partial(integrate, motion, given, division), clock)
            found = errors(motion, division, course, closed(motion, division.angles))
            yield Way(method, division.top, spent / count, count), division, found


def _by_hand(solved: SolvedCam, hand: Hand) -> Iterator[Result]:
    """Go through what 95 % of the drawings of a hand keep, on every line."""
    for division in map(solved.motion.division, BY_HAND):
        board = draw(drawn_on(solved, division), hand, np.random.default_rng(SEED), DRAWINGS)
        drawn = _errors_drawn(solved, division, board.values, DRAWINGS)
        lines = {kind: np.asarray(kept(error, 0.0)) for kind, error in drawn.items()}
        yield Way(HAND, f"n = {division.top}"), division, lines


def errors(motion: Motion, division: Division, course: Course, exact: Course) -> dict[str, Array]:
    """Return errors of travel and velocity on the section lines, in parts of the stroke and of the greatest velocity.

    Both are scaled by the stroke that the course has at the end of the rise.
    """
    scale = motion.h / course[0][division.top]
    sizes = (motion.h, motion.ds_max.value)
    return {
        kind: (np.abs(found * scale - right) * (1.0 / size)).astype(float)
        for kind, found, right, size in zip((TRAVELS, VELOCITIES), course, exact, sizes, strict=True)
    }


def _errors_drawn(solved: SolvedCam, division: Division, values: Any, *shape: int) -> dict[str, Array]:
    """Return the errors of what has been drawn: slopes of the travel are worth the velocity's ordinates by H_v."""
    travel = ordinates(values, TRAVEL, division, *shape)
    speed = np.zeros_like(travel)
    if solved.layout.given == ACCELERATION:
        per_slope = 1.0 / (solved.givens["H_v"] * solved.givens["mu_phi"] * MM_PER_M)
        speed = ordinates(values, VELOCITY, division, *shape) * per_slope
    s, ds = (exact.reshape(-1, *(1,) * len(shape)) for exact in closed(solved.motion, division.angles))
    return errors(solved.motion, division, (travel, speed), (s, ds))


def rivals(solved: SolvedCam, clock: Clock, hand: Hand, effort: Effort = FULL) -> Contest:
    """Let closed forms, chords, sums and a hand compete by a clock in seconds, best of the processor."""
    own = 2 if solved.layout.given == ACCELERATION else 1  # a velocity that is given has no error
    kinds = (Discipline(TRAVELS, ("s",)), Discipline(VELOCITIES, ("ds",)))[:own]
    computed = (_closed(solved, clock, effort), _board(solved, clock), _numerical(solved, clock))
    entries = [
        way.entry(kind.name, division.angles, {kind.names[0]: found[kind.name]})
        for way, division, found in chain(*computed, _by_hand(solved, hand))
        for kind in kinds
    ]
    return Contest(kinds, solved.angles, tuple(entries), effort)
