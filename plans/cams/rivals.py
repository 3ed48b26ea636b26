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
from .construction import ACCELERATION, TRAVEL, VELOCITY
from .formulas import MM_PER_M
from .motion import TURN, Division, Motion
from .solve import SolvedCam

Array = NDArray[np.float64]
Course = tuple[NDArray[Any], NDArray[Any]]  # travel and its derivative on section lines, in any scale
CLOSED, BOARD, BOARDS = "closed", "board", "boards"
MIDPOINT, MISSED, SIMPSON, HAND = "midpoint", "missed", "simpson", "hand"
ON_BOARD = (12, 24, 48, 96, 192)  # sections of a phase
AT_ONCE, CAMS = (12, 24, 48), 1000  # sections of many cams at once, and how many
NUMERICAL = (12, 24, 48, 96, 192, 768, 3072, 12288)
BY_HAND = (12, 24, 48)
TRAVELS, VELOCITIES = "travel", "speed"


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """A turn divided: section lines, and accelerations at the ends and in the middle of every section."""

    angles: Array
    division: Division

    def fractions(self, motion: Motion, order: int) -> tuple[Array, Array, Array, Array]:
        """Return widths of sections, and a derivative at their beginnings, middles and ends."""
        angles = self.angles
        middles = 0.5 * (angles[:-1] + angles[1:])
        at = (motion.at(angles[:-1], 1), motion.at(middles), motion.at(angles[1:], -1))
        begin, middle, end = (values[order] for values in at)
        return np.diff(angles), begin, middle, end


def on_lines(motion: Motion, sections: int) -> Cut:
    """Return a turn divided so that jumps lie on section lines."""
    return Cut(*motion.division(sections))


def midpoint(motion: Motion, given: str, cut: Cut) -> Course:
    """Integrate by mean ordinates, as the chords do, without a board."""
    width, _, middle, _ = cut.fractions(motion, 2 if given == ACCELERATION else 1)
    if given != ACCELERATION:
        return _summed(middle * width), motion.at(cut.angles, -1)[1]
    speed = _summed(middle * width)
    return _summed(0.5 * (speed[1:] + speed[:-1]) * width), speed


def simpson(motion: Motion, given: str, cut: Cut) -> Course:
    """Integrate by parabolas through both ends and the middle of every section."""
    width, begin, middle, end = cut.fractions(motion, 2 if given == ACCELERATION else 1)
    areas = (begin + 4.0 * middle + end) * width * (1.0 / 6.0)
    if given != ACCELERATION:
        return _summed(areas), motion.at(cut.angles, -1)[1]
    speed = _summed(areas)
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
        cut = on_lines(motion, max(ON_BOARD))
        found = in_extended(motion, cut.angles)
        course = closed(motion, cut.angles)
        for size in self.effort.batches:
            places = TURN * ((np.arange(size) + 0.5) / size)
            spent = timed(partial(closed, motion, places), self.clock) / size
            way = _way(CLOSED, size, spent, size)
            yield from _entries(self.solved, way, cut.angles, errors(motion, cut.division, course, found))

    def board(self) -> Iterator[Entry]:
        """Go through chords on the board: one cam alone, and many at once."""
        motion = self.solved.motion
        for sections in ON_BOARD:
            cut = on_lines(motion, sections)
            paper = drawn_on(self.solved, cut.angles, cut.division, nodes(self.solved, cut.division))
            course = _drawn(self.solved, cut.division, run(paper.program, paper.givens).values)
            spent = timed(partial(run, paper.program, paper.givens), self.clock) / len(cut.angles)
            found = errors(motion, cut.division, course, closed(motion, cut.angles))
            yield from _entries(self.solved, _way(BOARD, cut.division.top, spent), cut.angles, found)
            if sections in AT_ONCE:
                several = {**paper.givens, "l_A1": np.full(CAMS, paper.givens["l_A1"])}
                work = partial(batch, paper.program, several, nodes(self.solved, cut.division))
                spent = timed(work, self.clock) / (len(cut.angles) * CAMS)
                yield from _entries(self.solved, _way(BOARDS, cut.division.top, spent, CAMS), cut.angles, found)

    def numerical(self) -> Iterator[Entry]:
        """Go through sums of numbers, with jumps on section lines, and within sections where there are any."""
        motion, given = self.solved.motion, self.solved.layout.given
        ways: list[tuple[str, Callable[..., Course], Callable[[Motion, int], Cut]]] = [
            (MIDPOINT, midpoint, on_lines),
            (SIMPSON, simpson, on_lines),
        ]
        if inner_jumps(motion):
            ways.append((MISSED, midpoint, lambda motion, sections: Cut(*equal_division(motion, sections + 1))))
        for method, way, divided in ways:
            for sections in NUMERICAL:
                cut = divided(motion, sections)
                course = way(motion, given, cut)
                spent = timed(partial(way, motion, given, cut), self.clock) / len(cut.angles)
                found = errors(motion, cut.division, course, closed(motion, cut.angles))
                done = _way(method, cut.division.top, spent, len(cut.angles))
                yield from _entries(self.solved, done, cut.angles, found)


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


def _entries(solved: SolvedCam, way: Entry, angles: Array, found: Mapping[str, Array]) -> Iterator[Entry]:
    """Go through the errors on section lines, each as an entry; a velocity that is given has none."""
    for kind, error in found.items():
        if kind == TRAVELS or solved.layout.given == ACCELERATION:
            worst, name = int(np.argmax(error)), "s" if kind == TRAVELS else "ds"
            most, middle = float(error[worst]), float(np.median(error))
            yield replace(way, kind=kind, error=most, typical=middle, name=name, place=float(angles[worst]))


def rivals(solved: SolvedCam, clock: Clock, hand: Hand, effort: Effort = FULL) -> Contest:
    """Let closed forms, chords, sums and a hand compete.

    Parameters
    ----------
    clock : function
        Returns seconds, best those of the processor: `time.process_time`.
    """
    race = _Race(solved, clock, effort)
    found = [*race.closed(), *race.board(), *race.numerical(), *by_hand(solved, hand)]
    kinds = [Kind(VELOCITIES, ("ds",))] if solved.layout.given == ACCELERATION else []
    return Contest((Kind(TRAVELS, ("s",)), *kinds), solved.angles, tuple(found), effort)


def by_hand(solved: SolvedCam, hand: Hand) -> Iterator[Entry]:
    """Go through what 95 % of the drawings of a hand keep, on the worst line and on the middle one."""
    motion = solved.motion
    for sections in BY_HAND:
        cut = on_lines(motion, sections)
        paper = drawn_on(solved, cut.angles, cut.division, nodes(solved, cut.division))
        board = draw(paper, hand, np.random.default_rng(SEED), DRAWINGS)
        course = _drawn(solved, cut.division, board.values, DRAWINGS)
        s, ds = (values[:, None] for values in closed(motion, cut.angles))
        found = errors(motion, cut.division, course, (s, ds))
        lines = {kind: np.asarray(kept(error, 0.0)) for kind, error in found.items()}
        yield from _entries(solved, _way(HAND, f"n = {cut.division.top}", None), cut.angles, lines)


def _drawn(solved: SolvedCam, division: Division, values: Any, *shape: int) -> Course:
    """Return the course that has been drawn: slopes of the travel are worth the velocity's ordinates by H_v."""

    travel = ordinates(values, TRAVEL, division, *shape)
    if solved.layout.given != ACCELERATION:
        return travel, np.zeros_like(travel)
    return travel, ordinates(values, VELOCITY, division, *shape) * (
        1.0 / (solved.givens["H_v"] * solved.givens["mu_phi"] * MM_PER_M)
    )
