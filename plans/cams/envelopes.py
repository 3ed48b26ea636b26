"""Envelopes of a follower's positions, and where they run through themselves: undercutting.

The follower goes round a cam that stands still; its positions envelop the profile. Where the envelope runs backwards
the positions cut away what others would leave standing: the profile has a corner in which two branches of the envelope
cross, the follower rests on that corner between the two angles, and does not reach its travel.

A point of the envelope is left where no position contains it. What is left may be several closed curves: a cutter too
wide for a lobe cuts it off. The cam is the one that holds its centre, on which the envelope's point nearest to the
centre always is.

A neck is where a position cuts what another, far from it in phi, has left, however little it is.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..laws import cross
from .motion import TURN, Array, Extreme, Motion, Places, minima, refined

Points = NDArray[Any]  # complex
Ends = tuple[float, float]
OUTLINE = math.radians(0.5)  # between points of a profile
AROUND, CLOSE = 4.0, 160  # how far around a part that runs backwards it is looked at closely, in how many places
LEAST = 1e-3  # rad, length of such a part that has none
ARC = 24  # cells of an arc
OUTWARD = 2  # cells beyond which no position between two that were looked at cuts
MEETING = 1e-9  # part of the size within which two branches meet
WITHIN = 400  # places between the ends of an undercut
STEPS, HALVINGS, CHORDS = 30, 60, 32
INSIDE = 1e-12  # part of the size by which a point is inside a position: less is rounding
ROWS = 256  # points compared with all positions at once
CELLS = 360  # of a turn, in which envelope and positions are looked at
APART = 3  # cells from a position to those that are not next to it
ZOOM = np.linspace(-1.0, 1.0, 5)
ROUNDS = 30  # by which a cell is halved: to 1e-11 rad
HALVED = 0.5 ** np.arange(24)  # of a cell, around a neck that is looked at closely


@dataclass(frozen=True, slots=True)
class Undercut:
    """A part of the motion that the profile does not give: from `start` to `end` the follower rests on a corner."""

    # angles of the cam, rad; the start is within the turn, the end may be beyond it
    start: float
    end: float
    corner: complex  # the corner of the profile, m, in the frame of the cam at phi = 0
    along: tuple[float, float]  # where the profile leaves the envelope and comes back to it: places of the curve
    # the greatest travel that is lost, and where
    lost: float
    phi_lost: float


class Envelope(ABC):
    """What a follower's positions envelop on a cam that stands still; `side` is that of a jump, +1 the right."""

    motion: Motion  # that the follower should have

    @abstractmethod
    def practical(self, phi: Any, side: int = 1) -> Points:
        """Return the points of the envelope, m, loops and all."""

    @abstractmethod
    def tangent(self, phi: Any, side: int = 1) -> Points:
        """Return their derivative."""

    @abstractmethod
    def bend(self, phi: Any, side: int = 1) -> Array:
        """Return a number that is negative where the envelope runs backwards."""

    @abstractmethod
    def depth(self, points: Any, phi: Any) -> Array:
        """Return how deep points of the cam are inside the follower at the angles `phi`, m; negative outside."""

    @abstractmethod
    def seat(self, corner: complex, phi: Any) -> Array:
        """Return the travel at which the follower rests on a corner of the cam."""

    @abstractmethod
    def across(self, phi: float, part: Any) -> tuple[Points, Points]:
        """Return points by which the envelope goes on where the velocity jumps up, and their derivative.

        They lie on an arc or a flat, at the `part` 0 ... 1 of it.
        """

    @cached_property
    @abstractmethod
    def sharpest(self) -> Extreme:
        """The least radius of curvature of the pitch curve where it is convex, or under a plate, m, and where."""

    @property
    def rho_min(self) -> float:
        """The least radius of curvature, m."""
        return self.sharpest.value

    # The closed curve of the envelope, with the arcs where the velocity jumps up. A place `t` on it is the angle phi,
    # rad, to which every arc before it adds 1.

    @property
    def length(self) -> float:
        """Length of the parameter over a turn."""
        return TURN + len(self.motion.leaps)

    def places(self, phi: Any, side: Any = 1) -> Array:
        """Return the places of angles of the first turn; at a jump up the two sides are the two ends of its arc."""
        leaps = self.motion.leaps
        before = np.where(np.asarray(side) > 0, *(np.searchsorted(leaps, phi, end) for end in ("right", "left")))
        found: Array = phi + before
        return found

    def arcs(self, parts: Array) -> Iterator[tuple[Array, Points]]:
        """Go through the arcs: places and points of the given parts of them."""
        for k, leap in enumerate(self.motion.leaps):
            yield leap + k + parts, self.across(leap, parts)[0]

    def locate(self, t: float) -> tuple[float, float | None]:
        """Return the angle of a place, and which part of an arc it is at if it is on one."""
        t %= self.length
        for k, leap in enumerate(self.motion.leaps):
            if t < leap + k:
                return t - k, None
            if t <= leap + k + 1.0:
                return leap, min(t - leap - k, 1.0)
        return t - len(self.motion.leaps), None

    def at(self, t: float, side: int) -> tuple[complex, complex]:
        """Return the point of a place and its derivative; where the velocity jumps down, from a side."""
        phi, part = self.locate(t)
        if part is not None:
            point, along = self.across(phi, part)
        else:
            point, along = self.practical(phi, side), self.tangent(phi, side)
        return complex(point), complex(along)

    @cached_property
    def undercuts(self) -> list[Undercut]:
        """What the profile does not give of the motion, in order: nothing where no position cuts another's part."""
        parts, corners = backward(self), self.motion.corners
        size = float(np.max(np.abs(self.practical(np.linspace(0.0, TURN, WITHIN)))))
        narrow = _necks(self, INSIDE * size)
        if not parts and not narrow:
            return []
        rooms = [AROUND * max(end - begin, LEAST) for begin, end in parts]
        close = [np.linspace(a - room, b + room, CLOSE) for (a, b), room in zip(parts, rooms, strict=True)]
        closer = (TURN / CELLS) * HALVED
        close += [np.concatenate((phi - closer, [phi], phi + closer)) for ends in narrow for phi in ends]
        traced = _Traced.of(self, Places.between(corners, np.concatenate(close)))
        ring = traced.ring()
        edges = [self.at(a, -1)[0] for a, _ in ring]
        cuts = (_undercut(self, ends, k, edges) for k, ends in enumerate(ring))
        return sorted(cuts, key=lambda cut: cut.start)

    def outline(self, most: float = OUTLINE, cells: int = ARC) -> Points:
        """Return points of the profile as it is cut, in order of phi, at most `most` rad apart, without loops.

        An arc where the velocity jumps has so many `cells`.
        The corner of an undercut stands in the place of its loop.
        """
        phi, cuts = self.motion.samples(most)[:-1], self.undercuts
        pieces = [*self.arcs(np.arange(cells) / cells), (self.places(phi), self.practical(phi))]
        pieces += [(np.array([cut.along[0] % self.length]), np.array([cut.corner])) for cut in cuts]
        t, points = (np.concatenate(part) for part in zip(*pieces, strict=True))
        kept = np.ones(len(t), bool)
        for cut in cuts:
            leaves, returns = cut.along
            into = (t - leaves % self.length) % self.length
            kept &= (into == 0.0) | (into >= (returns - leaves) % self.length)
        return np.asarray(points[kept][np.argsort(t[kept], kind="stable")])


def _necks(envelope: Envelope, inside: float) -> list[tuple[float, float]]:
    """Return the deepest cuts of positions into places of the envelope that are not next to them.

    The depth is looked at in all cells; where it is greatest among its neighbours, and might be positive between
    them, it is found exactly, so that no cut is too narrow. A cut is the angles, rad, of the place that is cut and of
    the position that cuts it; up to the depth `inside`, m, nothing is cut: rounding.
    """
    phi = np.arange(CELLS) * (TURN / CELLS)
    depth = envelope.depth(envelope.practical(phi)[:, np.newaxis], phi)
    shifted = [np.roll(depth, by, (0, 1)) for by in ((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1))]
    most, least = np.maximum.reduce(shifted), np.minimum.reduce(shifted)
    apart = np.abs(np.subtract.outer(np.arange(CELLS), np.arange(CELLS)))
    wanted = (depth >= most) & (2.0 * depth - least > inside) & (np.minimum(apart, CELLS - apart) >= APART)
    found = (_deepest(envelope, phi[i], phi[j]) for i, j in np.argwhere(wanted))
    return [place for place, value in found if value > inside]


def _deepest(envelope: Envelope, place: float, position: float) -> tuple[tuple[float, float], float]:
    """Return where around a place and a position the depth is greatest, and the depth, m."""
    width, value = TURN / CELLS, -np.inf
    for _ in range(ROUNDS):
        places, positions = place + width * ZOOM, position + width * ZOOM
        depth = envelope.depth(envelope.practical(places % TURN)[:, np.newaxis], positions % TURN)
        i, j = np.unravel_index(int(np.argmax(depth)), depth.shape)
        place, position, value = float(places[i]), float(positions[j]), float(depth[i, j])
        width *= 0.5
    return (place % TURN, position % TURN), value


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


@dataclass(frozen=True, slots=True, eq=False)
class _Traced:
    """An envelope looked at all round: places `t` in order, their points, and which of them a position contains."""

    envelope: Envelope
    t: Array
    points: Points
    cut: NDArray[np.bool_]

    @classmethod
    def of(cls, envelope: Envelope, places: Places) -> _Traced:
        """Return an envelope looked at in places."""
        arcs = list(envelope.arcs(np.arange(1, ARC) / ARC))
        t = np.concatenate([envelope.places(places.phi, places.side), *(t for t, _ in arcs)])
        points = np.concatenate([places.values(envelope.practical), *(points for _, points in arcs)])
        order = np.argsort(t, kind="stable")
        t, points = t[order], points[order]
        inside = INSIDE * float(np.max(np.abs(points)))
        blocks = (points[k : k + ROWS, np.newaxis] for k in range(0, len(points), ROWS))
        cut = np.concatenate([np.max(envelope.depth(block, places.phi), axis=1) > inside for block in blocks])
        cut[np.argmin(np.abs(points))] = False
        return cls(envelope, t, points, cut)

    def ring(self) -> list[tuple[float, float]]:
        """Return where the curve round the centre leaves the envelope and comes back, in order."""
        runs = list(_runs(~self.cut))
        nearest = int(np.argmin(np.abs(self.points)))
        first = here = next((k for k, (a, b) in enumerate(runs) if (nearest - a) % len(self.t) <= b - a), 0)
        found = []
        for _ in runs:
            here, ends = self._next(runs, here)
            found.append(ends)
            if here == first:
                break
        return found

    def _next(self, runs: list[tuple[int, int]], here: int) -> tuple[int, tuple[float, float]]:
        """Return which part that is left goes on where one of them ends, and the two places of the corner."""
        last = runs[here][1]
        away = [abs(self.points[last % len(self.t)] - self.points[first]) for first, _ in runs]
        tried = []
        for k in sorted(range(len(runs)), key=lambda k: away[k]):
            gap, ends = self._crossing(last, runs[k][0])
            tried.append((gap, k, ends))
            if gap < MEETING * float(np.max(np.abs(self.points))):
                break
        _, k, ends = min(tried)
        return k, ends

    def _crossing(self, last: int, first: int) -> tuple[float, tuple[float, float]]:
        """Return how far apart two branches stay, m, and where they cross, near their cut ends."""

        def place(i: int) -> float:  # it may be one of another turn
            turns, k = divmod(i, len(self.t))
            return float(self.t[k]) + turns * self.envelope.length

        before, after = (place(last - OUTWARD), place(last + 1)), (place(first - 1), place(first + OUTWARD))
        middle = 0.5 * (place(last) + before[1]), 0.5 * (after[0] + place(first))
        gap, ends = _newton(self.envelope, before, after, middle)
        if gap < MEETING * float(np.max(np.abs(self.points))):
            return gap, ends
        begins = _chords(self.envelope, before, after)
        return min([(gap, ends), *(_newton(self.envelope, before, after, begin) for begin in begins)])


def _newton(envelope: Envelope, before: Ends, after: Ends, begin: Ends) -> tuple[float, Ends]:
    """Return how far apart two branches stay, m, and the places, each between its ends, where Newton's steps lead."""
    a, b = begin
    for _ in range(STEPS):
        (start, along), (end, across) = envelope.at(a, -1), envelope.at(b, 1)
        gap, sine = end - start, cross(along, across)
        if sine == 0.0:
            break
        old = a, b
        a = min(max(a + cross(gap, across) / sine, before[0]), before[1])
        b = min(max(b + cross(gap, along) / sine, after[0]), after[1])
        if (a, b) == old:
            break
    return abs(envelope.at(b, 1)[0] - envelope.at(a, -1)[0]), (a, b)


def _chords(envelope: Envelope, before: Ends, after: Ends) -> Iterator[Ends]:
    """Go through the places at which chords of two branches cross: branches that cross at a small angle need it."""
    a, b = (np.linspace(*ends, CHORDS + 1) for ends in (before, after))
    p, q = (np.array([envelope.at(t, side)[0] for t in at.tolist()]) for at, side in ((a, -1), (b, 1)))
    apart = q - p[:, np.newaxis]
    left, right = cross(np.diff(p)[:, np.newaxis], apart[:-1]) > 0.0, cross(np.diff(q), apart[:, :-1]) > 0.0
    for i, j in np.argwhere((left[:, 1:] != left[:, :-1]) & (right[1:] != right[:-1])):
        yield 0.5 * float(a[i] + a[i + 1]), 0.5 * float(b[j] + b[j + 1])


def _undercut(envelope: Envelope, ends: tuple[float, float], k: int, corners: list[complex]) -> Undercut:
    """Return an undercut; where its own corner does not bear the follower another one does."""
    start, end = (envelope.locate(t)[0] % TURN for t in ends)
    end = start + (end - start) % TURN

    def kept(phi: Any, side: int = 1) -> Array:
        seats = [envelope.seat(corner, phi) for corner in corners]
        return np.asarray(np.fmax.reduce(seats) - envelope.motion.at(phi, side)[0])

    phi = np.linspace(start, end, WITHIN)
    at = int(np.clip(np.argmin(kept(phi)), 1, WITHIN - 2))
    least, where = refined(kept, phi[at - 1], phi[at + 1])
    return Undercut(start, end, corners[k], ends, -float(least[0]), float(where[0]) % TURN)
