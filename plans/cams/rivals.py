"""Speed against accuracy of a cam's motion: closed forms, chords on the board, and numerical integration.

All rivals begin with the acceleration, or with the velocity where that is given, and find the travel, scaled by its own
stroke as on paper. An error is the worst over the section lines, in parts of the stroke or of the greatest velocity;
that of closed forms is their rounding, beside the same forms with longer numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.batch import batch
from ..boards.exact import run
from ..contest import FULL, Clock, Contest, Effort, Entry, Kind, timed
from ..hands.shaky import Hand, draw
from ..hands.spread import kept
from .chords import DRAWINGS, SEED, drawn_on, equal_division, inner_jumps, nodes, ordinates
from .construction import ACCELERATION, MM_PER_M, TRAVEL, VELOCITY
from .motion import TURN, Array, Division, Motion
from .solve import SolvedCam

Course = tuple[NDArray[Any], NDArray[Any]]  # travel and its derivative on section lines, in any scale
CLOSED, BOARD, BOARDS = "closed", "board", "boards"
MIDPOINT, MISSED, SIMPSON, HAND = "midpoint", "missed", "simpson", "hand"
ON_BOARD = (12, 24, 48, 96, 192)  # sections of a phase
AT_ONCE, CAMS = (12, 24, 48), 1000  # sections of many cams at once, and how many
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


def midpoint(motion: Motion, given: str, division: Division) -> Course:
    """Integrate by mean ordinates, as the chords do, without a board."""
    width, _, middle, _ = _sections(motion, given, division)
    speed = _summed(middle * width)
    if given != ACCELERATION:
        return speed, motion.at(division.angles, -1)[1]
    return _summed(0.5 * (speed[1:] + speed[:-1]) * width), speed


def simpson(motion: Motion, given: str, division: Division) -> Course:
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


def in_extended(motion: Motion, angles: Array) -> Course:
    """Take the closed forms with longer numbers than float64, where the machine has them."""
    s, ds = np.zeros(angles.shape, np.longdouble), np.zeros(angles.shape, np.longdouble)
    for piece in (piece for phase in motion.phases for piece in phase.pieces):
        there = (angles > piece.low) & (angles <= piece.high)
        for values, curve in ((s, piece), (ds, piece.derivative())):
            t = angles[there].astype(np.longdouble) - curve.origin
            found = np.zeros_like(t)
            for coefficient in reversed(curve.coefficients):
                found = found * t + coefficient
            values[there] = found + (curve.sine * np.sin(curve.rate * t) + curve.cosine * np.cos(curve.rate * t))
    return s, ds


def _summed(parts: Array) -> Array:
    found: Array = np.concatenate((np.zeros(1), np.cumsum(parts)))
    return found


@dataclass(frozen=True, slots=True, eq=False)
class _Race:
    """The rivals for one cam."""

    solved: SolvedCam
    clock: Clock
    effort: Effort

    def closed(self) -> Iterator[Entry]:
        """Go through closed forms for so many positions at once."""
        motion = self.solved.motion
        division = motion.division(max(ON_BOARD))
        course = closed(motion, division.angles)
        found = errors(motion, division, course, in_extended(motion, division.angles))
        for size in self.effort.batches:
            places = TURN * ((np.arange(size) + 0.5) / size)
            spent = timed(partial(closed, motion, places), self.clock) / size
            yield from _entries(self.solved, _way(CLOSED, size, spent, size), division, found)

    def board(self) -> Iterator[Entry]:
        """Go through chords on the board: one cam alone, and many at once."""
        for sections in ON_BOARD:
            division = self.solved.motion.division(sections)
            count, paper = len(division.angles), drawn_on(self.solved, division)
            found = _errors_drawn(self.solved, division, run(paper.program, paper.givens).values)
            spent = timed(partial(run, paper.program, paper.givens), self.clock) / count
            yield from _entries(self.solved, _way(BOARD, division.top, spent), division, found)
            if sections in AT_ONCE:
                several = {**paper.givens, "l_A1": np.full(CAMS, paper.givens["l_A1"])}
                work = partial(batch, paper.program, several, nodes(self.solved, division))
                way = _way(BOARDS, division.top, timed(work, self.clock) / (count * CAMS), CAMS)
                yield from _entries(self.solved, way, division, found)

    def numerical(self) -> Iterator[Entry]:
        """Go through sums of numbers, with jumps on section lines, and within sections where there are any."""
        motion, given = self.solved.motion, self.solved.layout.given
        ways: list[tuple[str, Callable[..., Course], Callable[[int], Division]]] = [
            (MIDPOINT, midpoint, motion.division),
            (SIMPSON, simpson, motion.division),
        ]
        if inner_jumps(motion):
            ways.append((MISSED, midpoint, lambda sections: equal_division(motion, sections + 1)))
        for method, integrate, divided in ways:
            for sections in NUMERICAL:
                division = divided(sections)
                count, work = len(division.angles), partial(integrate, motion, given, division)
                found = errors(motion, division, work(), closed(motion, division.angles))
                way = _way(method, division.top, timed(work, self.clock) / count, count)
                yield from _entries(self.solved, way, division, found)

    def by_hand(self, hand: Hand) -> Iterator[Entry]:
        """Go through what 95 % of the drawings of a hand keep, on the worst line and on the middle one."""
        for sections in BY_HAND:
            division = self.solved.motion.division(sections)
            board = draw(drawn_on(self.solved, division), hand, np.random.default_rng(SEED), DRAWINGS)
            found = _errors_drawn(self.solved, division, board.values, DRAWINGS)
            lines = {kind: np.asarray(kept(error, 0.0)) for kind, error in found.items()}
            yield from _entries(self.solved, _way(HAND, f"n = {division.top}", None), division, lines)


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


def _way(method: str, setting: float | str, seconds: float | None, at_once: int = 1) -> Entry:
    """Return an entry of which the errors are still to be found."""
    return Entry(method, setting, "", None, None, "", 0.0, seconds, at_once, 0.0)


def _entries(solved: SolvedCam, way: Entry, division: Division, found: Mapping[str, Array]) -> Iterator[Entry]:
    """Go through the errors on section lines, each as an entry; a velocity that is given has none."""
    for kind, error in found.items():
        if kind == TRAVELS or solved.layout.given == ACCELERATION:
            worst, name = int(np.argmax(error)), "s" if kind == TRAVELS else "ds"
            most, middle = float(error[worst]), float(np.median(error))
            yield replace(way, kind=kind, error=most, typical=middle, name=name, place=float(division.angles[worst]))


def rivals(solved: SolvedCam, clock: Clock, hand: Hand, effort: Effort = FULL) -> Contest:
    """Let closed forms, chords, sums and a hand compete by a clock in seconds, best of the processor."""
    race = _Race(solved, clock, effort)
    found = [*race.closed(), *race.board(), *race.numerical(), *race.by_hand(hand)]
    kinds = [Kind(VELOCITIES, ("ds",))] if solved.layout.given == ACCELERATION else []
    return Contest((Kind(TRAVELS, ("s",)), *kinds), solved.angles, tuple(found), effort)


def _errors_drawn(solved: SolvedCam, division: Division, values: Any, *shape: int) -> dict[str, Array]:
    """Return the errors of what has been drawn: slopes of the travel are worth the velocity's ordinates by H_v."""
    travel = ordinates(values, TRAVEL, division, *shape)
    speed = np.zeros_like(travel)
    if solved.layout.given == ACCELERATION:
        per_slope = 1.0 / (solved.givens["H_v"] * solved.givens["mu_phi"] * MM_PER_M)
        speed = ordinates(values, VELOCITY, division, *shape) * per_slope
    s, ds = (exact.reshape(-1, *(1,) * len(shape)) for exact in closed(solved.motion, division.angles))
    return errors(solved.motion, division, (travel, speed), (s, ds))
