"""Envelopes of a follower's positions, and where they run through themselves: undercutting.

The follower goes round a cam that stands still; its positions envelop the profile. Where the envelope runs backwards
the positions cut away what others would leave standing: the profile has a corner in which two branches of the envelope
cross, the follower rests on that corner between the two angles, and does not reach its travel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..laws import cross
from .motion import TURN, Motion
from .places import Places, minima, refined

Array = NDArray[np.float64]
Points = NDArray[Any]  # complex
AROUND, CLOSE = 4.0, 160  # how far around a part that runs backwards it is looked at closely, in how many places
LEAST = 1e-3  # rad, length of such a part that has none
WITHIN = 400  # places between the ends of an undercut
STEPS, HALVINGS = 30, 60
INSIDE = 1e-12  # part of the size by which a point is inside a position: less is rounding
ROWS = 256  # points compared with all positions at once


class Envelope(Protocol):
    """What a follower's positions envelop on a cam that stands still; `side` is that of a jump, +1 the right."""

    @property
    def motion(self) -> Motion:
        """The motion that the follower should have."""

    def practical(self, phi: Any, side: int = 1) -> Points:
        """Return the points of the envelope, m."""

    def tangent(self, phi: Any, side: int = 1) -> Points:
        """Return their derivative."""

    def bend(self, phi: Any, side: int = 1) -> Array:
        """Return a number that is negative where the envelope runs backwards."""

    def depth(self, points: Any, phi: Any) -> Array:
        """Return how deep points of the cam are inside the follower at the angles `phi`, m; negative outside."""

    def seat(self, corner: complex, phi: Any) -> Array:
        """Return the travel at which the follower rests on a corner of the cam."""

    def across(self, phi: float) -> Points:
        """Return the points by which the profile goes on where the envelope leaps: where the velocity jumps up."""


@dataclass(frozen=True, slots=True)
class Undercut:
    """A part of the motion that the profile does not give: from `start` to `end` the follower rests on a corner.

    Parameters
    ----------
    start, end : float
        Angles of the cam, rad; the start is within the turn, the end may be beyond it.
    corner : complex
        The corner of the profile, m, in the frame of the cam at phi = 0.
    lost, phi_lost : float
        The greatest travel that is lost, and where.
    """

    start: float
    end: float
    corner: complex
    lost: float
    phi_lost: float


def backward(envelope: Envelope) -> list[tuple[float, float]]:
    """Return the intervals of phi in which the envelope runs backwards, in order.

    Where the velocity drops it turns at once: an interval of no length.
    """
    corners = envelope.motion.corners
    places = Places.between(corners, [minimum.phi for minimum in minima(envelope.bend, corners)])
    below = places.values(envelope.bend) < 0.0
    found = [(phi, phi) for phi in envelope.motion.drops]
    for first, last in _runs(below):
        begin, end = (_sign_changes(envelope, places, i) for i in (first - 1, last))
        found.append((begin % TURN, begin % TURN + (end - begin) % TURN))
    return sorted(found)


def undercuts(envelope: Envelope) -> list[Undercut]:
    """Return what the profile does not give of the motion, in order; nothing where no position cuts another's part."""
    parts = backward(envelope)
    if not parts:
        return []
    rooms = [AROUND * max(end - begin, LEAST) for begin, end in parts]
    close = [np.linspace(a - room, b + room, CLOSE) for (a, b), room in zip(parts, rooms, strict=True)]
    places = Places.between(envelope.motion.corners, np.concatenate(close))
    points = places.values(envelope.practical)
    size = float(np.max(np.abs(points)))
    cut = np.concatenate(
        [
            np.max(envelope.depth(points[k : k + ROWS, np.newaxis], places.phi), axis=1) > INSIDE * size
            for k in range(0, len(points), ROWS)
        ]
    )
    return sorted((_undercut(envelope, places, run) for run in _runs(cut)), key=lambda found: found.start)


def _runs(wanted: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """Go through the runs of what is wanted, all round: index of the first, of the last (beyond the end if it must)."""
    count = len(wanted)
    for first in np.flatnonzero(wanted & ~np.roll(wanted, 1)):
        length = int(np.argmin(np.roll(wanted, -first)))
        yield int(first), int(first) + (length or count) - 1


def _sign_changes(envelope: Envelope, places: Places, i: int) -> float:
    """Return where between the places i and i + 1 the envelope turns round."""
    low, high, side = places.cell(i)
    if high <= low:
        return low
    below = float(envelope.bend(low, side)) < 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (float(envelope.bend(middle, side)) < 0.0) == below:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _undercut(envelope: Envelope, places: Places, run: tuple[int, int]) -> Undercut:
    (a, b, left), (c, d, right) = places.cell(run[0] - 1), places.cell(run[1])
    # what cuts the envelope's point a or d a little may be between two positions that were looked at
    start, end = _crossing(envelope, (2.0 * a - b, b, left), (c, 2.0 * d - c, right))
    end = start + (end - start) % TURN
    corner = complex(envelope.practical(start))

    def kept(phi: Any, side: int = 1) -> Array:
        return envelope.seat(corner, phi) - envelope.motion.at(phi, side)[0]

    phi = np.linspace(start, end, WITHIN)
    at = int(np.clip(np.argmin(kept(phi)), 1, WITHIN - 2))
    least, where = refined(kept, phi[at - 1], phi[at + 1])
    return Undercut(start % TURN, start % TURN + (end - start), corner, -float(least[0]), float(where[0]) % TURN)


def _crossing(
    envelope: Envelope, before: tuple[float, float, int], after: tuple[float, float, int]
) -> tuple[float, float]:
    """Return the angles at which the envelope comes through the same point, each in its cell, by Newton's steps."""
    first, second = 0.5 * (before[0] + before[1]), 0.5 * (after[0] + after[1])
    for _ in range(STEPS):
        gap = complex(envelope.practical(second, after[2]) - envelope.practical(first, before[2]))
        along, across = complex(envelope.tangent(first, before[2])), complex(envelope.tangent(second, after[2]))
        sine = cross(along, across)
        if sine == 0.0:
            break
        old = first, second
        first = min(max(first + cross(gap, across) / sine, before[0]), before[1])
        second = min(max(second + cross(gap, along) / sine, after[0]), after[1])
        if (first, second) == old:
            break
    return first, second


def outline(envelope: Envelope, cuts: list[Undercut], most: float) -> Points:
    """Return points of the profile as it is cut, in order of phi, at most `most` rad apart.

    The corner of an undercut stands in the place of its loop.
    """
    phi = envelope.motion.samples(most)[:-1]
    leaps = [(at % TURN, envelope.across(at)) for at in envelope.motion.leaps]
    pieces = leaps + [(cut.start, np.array([cut.corner])) for cut in cuts]
    angles = np.concatenate([*(np.full(len(points), at) for at, points in pieces), phi])
    points = np.concatenate([*(points for _, points in pieces), envelope.practical(phi)])
    kept = np.ones(len(angles), bool)
    for cut in cuts:
        into = (angles - cut.start) % TURN
        kept &= (into == 0.0) | (into >= cut.end - cut.start)
    order = np.argsort(angles[kept], kind="stable")
    found: Points = points[kept][order]
    return found
