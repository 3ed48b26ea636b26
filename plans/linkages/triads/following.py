"""Groups of class III are followed: from where the task says that they start to where the driver is wanted.

Such a group has up to six positions for one of the driver, and no sign that tells them apart. So its central link is
laid down near the place that the task names, and moved on with the driver in steps so small that Newton's method stays
on one branch: its second correction must be a small part of the first (then no other position is as near), and the
determinant of the legs must keep its sign. Where that fails the step is halved, down to nothing in a dead position.

The way leads over a grid of the driver's positions that begins at the start. So what is found for one position does not
depend on which others are asked for with it, to the last bit.

Source of the criterion: Deuflhard, Newton methods for nonlinear problems, chapter 5 (adaptive pathfollowing).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...laws import TURN
from ..mechanism import Driver, Mechanism, start_names
from ..structure import TRIAD, analyse
from .courses import Course, Poses, State

Array = NDArray[np.float64]


class Follower:
    """The groups of class III of one mechanism, at any positions of its driver.

    Parameters
    ----------
    values : mapping of str to float or float64 array of shape (N,)
        Its numbers in SI; the position of the driver is not among those that matter. With arrays there are N
        mechanisms.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self._turns = isinstance(mechanism.driver, Driver)
        self._ways: list[_Way] = []
        numbers = triads(mechanism)
        for count, number in enumerate(numbers, start=1):
            course = Course(mechanism, values, numbers[:count])
            start = mechanism.start(number)
            assert start is not None
            at = np.atleast_1d(np.asarray(values.get(start.driver, 0.0), float))
            at = np.broadcast_to(at, max(len(at), course.count))
            self._ways.append(_Way(course, course.settled(at, self._poses(at)), self._turns))

    def _poses(self, at: Array) -> Poses:
        """Return where the central links lie that are followed already."""
        return {name: value for name, value in self.near(at).items() if "astray" not in name}

    def near(self, at: Array) -> Poses:
        """Return the board's givens that say where each central link lies, about, with the driver at `at`.

        Parameters
        ----------
        at : float64 array of shape (N,)
            Positions of the driver: radians, or metres of a slide.

        Returns
        -------
        dict of str to float64 array of shape (N,)
            Five givens for each group; see `parts.start_names`. One of them is not zero where the group cannot
            come from its start, so that the board refuses that position.
        """
        found: Poses = {}
        for way in self._ways:
            found |= way.near(at)
        return found

    @property
    def starts(self) -> NDArray[np.bool_]:
        """Whether all groups can be laid down near their starts, shape (N,)."""
        held = np.ones(1, bool)
        for way in self._ways:
            held = held & np.isfinite(way.start.at)
        return held

    @property
    def places(self) -> Array:
        """Places of the driver that stand for all: around a crank's circle, a slide's start."""
        start = self._ways[-1].start.at[:1]
        return start + np.arange(-36, 37) * (TURN / 72) if self._turns else start

    def limits(self, range_of: float = TURN) -> tuple[float, float] | None:
        """Return how far the driver of one mechanism can go from the start of its last group, down and up.

        The groups come to a dead position there, to 1e-9 rad; after `range_of` the search ends. None when nothing can
        be laid down.
        """
        way = self._ways[-1]
        start = float(way.start.at[0])
        if not math.isfinite(start):
            return None
        low, high = way.go(np.array([start - range_of, start + range_of])).at
        return float(low), float(high)


def triads(mechanism: Mechanism) -> list[int]:
    """Return the central links of the groups of class III, in order of attachment."""
    return [group.central for group in analyse(mechanism).groups if group.kind == TRIAD]


def followed(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the board's givens that say where the central link of every group of class III lies, about.

    A mechanism without such groups needs none. For many positions of one mechanism, asked for again and again, keep a
    `Follower`.

    Parameters
    ----------
    values : mapping of str to float or float64 array of shape (N,)
        Numbers of the mechanism in SI, its driver's position among them.
    """
    if not mechanism.starts or not triads(mechanism):
        return {}
    at = np.asarray(values[mechanism.driver.coordinate], float)
    found = Follower(mechanism, values).near(np.atleast_1d(at))
    if all(len(array) == 1 for array in found.values()) and not at.ndim:
        return {name: float(array[0]) for name, array in found.items()}
    return found


@dataclass(slots=True)
class _Way:
    """The way of one course from its start: `start` is one state for all, or one for each mechanism."""

    course: Course
    start: State
    turns: bool

    def near(self, goal: Array) -> Poses:
        """Return the givens of the last group of the course, at any positions of the driver."""
        goal = np.broadcast_to(goal, max(len(goal), len(self.start.at)))
        state = self.go(self._within(goal))
        lost = np.flatnonzero(state.at != self._within(goal))
        if self.turns and len(lost):
            self._other_way(state, goal, lost)
            lost = lost[state.at[lost] != self._within(goal)[lost]]
        astray = np.zeros(len(goal))
        if len(lost):
            astray[lost] = self.course.astray(state, goal, lost)
        x, y, c, s, way = start_names(self.course.numbers[-1])
        return {**{name: state.poses[name] for name in (x, y, c, s)}, way: astray}

    def _within(self, goal: Array) -> Array:
        """Return positions of a crank less whole turns, where the group comes back after one or cannot make it."""
        if not self.turns:
            return goal
        whole = np.trunc((goal - self.start.at) / TURN)
        far = np.flatnonzero(np.abs(whole) >= 1.0)
        if not len(far):
            return goal
        goal = goal.copy()
        start = self._starts(len(goal)).take(far)
        once = start.at + np.copysign(TURN, whole[far])
        after = self.course.follow(self.start if len(self.start.at) == 1 else start, once, far)
        goal[far] -= np.where((after.at != once) | self.course.same(after, start, far), whole[far] * TURN, 0.0)
        return goal

    def _starts(self, count: int) -> State:
        return self.start.take(np.zeros(count, int) if len(self.start.at) == 1 else np.arange(count))

    def go(self, goal: Array, which: NDArray[np.intp] | None = None) -> State:
        """Return the state at `goal`, or where the way to it ends; `which` are the mechanisms."""
        which = np.arange(len(goal)) if which is None else which
        start = self.start if len(self.start.at) == 1 else self.start.take(which)
        return self.course.follow(start, goal, which)

    def _other_way(self, state: State, goal: Array, lost: NDArray[np.intp]) -> None:
        """Try to come round the other way, where that way does not lead past the place at which this one ends.

        If it does, the crank has two positions for that angle, and a sweep would jump from one to the other.
        """
        start, within = self._starts(len(goal)).at[lost], self._within(goal)[lost]
        back = np.copysign(TURN, within - start)
        found, end = self.go(within - back, lost), self.go(state.at[lost] - back, lost)
        there = (found.at == within - back) & (end.at != state.at[lost] - back)
        arrived = found.take(there)
        arrived.at[:] = within[there]
        state.put(lost[there], arrived)
