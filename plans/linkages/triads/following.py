"""Groups of class III are followed: from where the task says that they start to where the driver is wanted.

Such a group has up to six positions for one of the driver, and no sign that tells them apart. So its central link is
laid down near the place that the task names, and moved on with the driver in steps so small that Newton's method stays
on one branch: its second correction must be a small part of the first (then no other position is as near), and the
determinant of the legs must keep its sign. Where that fails the step is halved, down to nothing in a dead position.

The way leads over a grid of the driver's positions that begins at the start. So what is found for one position does not
depend on which others are asked for with it, to the last bit.

Any two legs of a group may make its special point, but where two legs are nearly parallel their lines meet far away,
and where the special point stands in the joint of the third leg nothing turns about it. The choice is data of the
construction: `Start.legs`.

Source of the criterion: Deuflhard, Newton methods for nonlinear problems, chapter 5 (adaptive pathfollowing).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import Program, RecordingBoard
from ...boards.batch import batch
from ...boards.exact import ILL, SMALL, run
from ...laws import TURN
from ..chain import construct, named
from ..mechanism import Driver, Mechanism
from ..structure import TRIAD, analyse
from .courses import Course, Poses
from .triad import Triad

Array = NDArray[np.float64]
Legs = tuple[int, int]


class Follower:
    """The groups of class III of one mechanism with its numbers in SI, or of N where these are arrays of shape (N,).

    They are known at any positions of the driver: that among the numbers does not matter.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self._turns = isinstance(mechanism.driver, Driver)
        self._courses: list[Course] = []
        numbers = triads(mechanism)
        for count, number in enumerate(numbers, start=1):
            course = Course(mechanism, values, numbers[:count])
            start = mechanism.start(number)
            assert start is not None
            at = np.atleast_1d(np.asarray(values.get(start.driver, 0.0), float))
            at = np.broadcast_to(at, max(len(at), course.count))
            # from where the central links lie that are followed already
            course.settle(at, {name: value for name, value in self.near(at).items() if "astray" not in name})
            self._courses.append(course)

    def near(self, at: Array) -> Poses:
        """Return the board's givens that say where each central link lies, about, with the driver at `at`.

        `at`, float64 of shape (N,), is in radians, or metres of a slide. Each group has five givens of that shape, see
        `start_names`; one of them is not zero where it cannot come from its start, so that the board refuses.
        """
        found: Poses = {}
        for course in self._courses:
            found |= course.near(at)
        return found

    @property
    def places(self) -> Array:
        """Places of the driver that stand for all: around a crank's circle, a slide's start."""
        start = self._courses[-1].start.at[:1]
        return start + np.arange(-36, 37) * (TURN / 72) if self._turns else start

    def limits(self, range_of: float = TURN) -> tuple[float, float] | None:
        """Return how far the driver of one mechanism can go from the start of its last group, down and up.

        The groups come to a dead position there, to 1e-9 rad; after `range_of` the search ends. None when nothing can
        be laid down.
        """
        course = self._courses[-1]
        start = float(course.start.at[0])
        if not math.isfinite(start):
            return None
        low, high = course.go(np.array([start - range_of, start + range_of])).at
        return float(low), float(high)


def triads(mechanism: Mechanism) -> list[int]:
    """Return the central links of the groups of class III, in order of attachment."""
    return [group.central for group in analyse(mechanism).groups if group.kind == TRIAD]


def followed(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the board's givens that say where the central link of every group of class III lies, about.

    The `values` are numbers or float64 arrays of shape (N,) in SI, the driver's position among them. A mechanism
    without such groups needs none. For many positions of one mechanism, asked for again and again, keep a `Follower`.
    """
    if not mechanism.starts or not triads(mechanism):
        return {}
    at = np.asarray(values[mechanism.driver.coordinate], float)
    found = Follower(mechanism, values).near(np.atleast_1d(at))
    if all(len(array) == 1 for array in found.values()) and not at.ndim:
        return {name: float(array[0]) for name, array in found.items()}
    return found


def with_special_points(
    mechanism: Mechanism,
    values: Mapping[str, Any],
    near: Mapping[str, Any] | None = None,
    enough: float = SMALL,
    first: Mapping[int, Legs | None] | None = None,
) -> Mechanism:
    """Return the mechanism with two legs chosen for the special point of every triad whose task names none.

    Its numbers in SI are for one position or, float64 arrays of shape (N,), for many: of these the worst one counts;
    `near` is what `followed` gives for them, where it is known already. The first two legs whose sines are nowhere
    below `enough` are taken, so that one position is constructed like another; without such ones the best two. Those
    that `first` has by the number of the central link are taken where their lines meet everywhere, however flatly.
    """
    for number, (pairs, sines) in _sines(mechanism, values, near).items():
        worst = sines.min(axis=1)
        legs = pairs[int(np.argmax(np.minimum(worst, enough)))]
        wanted = (first or {}).get(number)
        keeps = wanted is not None and worst[pairs.index(wanted)] >= ILL
        legs = wanted if keeps and wanted else legs
        starts = tuple(replace(start, legs=legs) if start.link == number else start for start in mechanism.starts)
        mechanism = replace(mechanism, starts=starts)
    return mechanism


def _sines(
    mechanism: Mechanism, values: Mapping[str, Any], near: Mapping[str, Any] | None
) -> dict[int, tuple[list[Legs], Array]]:
    """Return for each triad without named legs the pairs of its legs, and the worse sine of each, shape (3, N).

    Where the mechanism cannot be assembled all are one.
    """
    if not any(start.legs is None for start in mechanism.starts):
        return {}
    free = mechanism.without_loads
    triads = [group for group in named(free, analyse(free))[0] if isinstance(group, Triad)]
    board, by_triad = RecordingBoard(), {}
    for triad in triads:
        start = mechanism.start(triad.central.number)
        if start is not None and start.legs is None:
            by_triad[triad.central.number] = dict(_pairs(board, triad))
    if not by_triad:
        return {}
    _, position = construct(free, ("position",))
    program = Program((*position.steps, *board.steps))
    wanted = [name for pairs in by_triad.values() for names in pairs.values() for name in names]
    found = _run(program.needed_for(wanted), {**values, **(near or followed(mechanism, values))}, wanted)
    return {number: (list(pairs), _rows(found, pairs.values())) for number, pairs in by_triad.items()}


def _rows(found: Mapping[str, Any], pairs: Iterable[tuple[str, str]]) -> Array:
    rows = np.stack([np.min([np.atleast_1d(np.abs(found[name])) for name in names], axis=0) for names in pairs])
    apart = np.isnan(rows).all(axis=0)
    return np.where(apart, 1.0, np.nan_to_num(rows, nan=0.0))


def _run(program: Program, values: Mapping[str, Any], wanted: list[str]) -> Mapping[str, Any]:
    needs = program.needs
    values = {name: value for name, value in values.items() if name in needs}
    if any(np.ndim(value) for value in values.values()):
        return batch(program, values, wanted)[0]
    return run(program, values).values


def _pairs(board: RecordingBoard, triad: Triad) -> Iterable[tuple[Legs, tuple[str, str]]]:
    """Record the sines of every two legs: of their lines, and of the third line with the way to the special point."""
    board.pole("_nowhere")
    for first, second in combinations(triad.by_number, 2):
        third = next(leg for leg in triad.legs if leg not in (first, second))
        key = f"{first.number}_{second.number}"
        board.meet(f"_X_{key}", first.start, first.e, second.start, second.e)
        board.distance(f"_l_{key}", f"_X_{key}", third.end)
        board.calc(f"_sine_{key}", "across_axis", first.e, "_nowhere", second.e)
        # the normals to both meet like the lines themselves
        board.calc(f"_across_{key}", "across_axis", third.e, f"_X_{key}", third.end)
        board.calc(f"_sine_D_{key}", "part_of", f"_across_{key}", f"_l_{key}")
        yield (first.number, second.number), (f"_sine_{key}", f"_sine_D_{key}")
