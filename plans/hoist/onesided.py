"""The motion of a load on a support that can only push, by a rope that can only pull: piece by piece, in closed form.

A piece ends when the rope goes slack or becomes taut, or the load leaves its support or comes back to it. While both
bear, the load swings with k; on the rope alone with k_1; on the support alone with its own frequency; else it flies.
Nothing is lost: on a rope alone the swing is the same again after every slack, and when one swing has passed without
the load coming back to its support none of the later ones, which are higher, does. So the motion is known for all time.
To a rigid support no load comes back: it leaves it slower, beside the rope's end, than the end itself moves.

The slope of a curve p_0 + p_1 t + p_2 t^2 + A cos w t + B sin w t turns where its bend is zero, which is known in
closed form; between two such places it passes zero once at most, and so does the curve between its own turnings.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise
from typing import Any

from ...scales.errors import InputError
from ..laws import TURN
from .roots import CLOSE, MOST_ROUNDS

MOST = 8_000  # pieces and swings of one motion: beyond, nobody wants to know them
LATEST = 1e12  # swings after which the next one cannot be told from it


@dataclass(frozen=True, slots=True)
class Curve:
    """p_0 + p_1 t + p_2 t^2 + A cos w t + B sin w t; without a swing A, B and w are zero."""

    p_0: float
    p_1: float
    p_2: float
    A: float = 0.0
    B: float = 0.0
    w: float = 0.0

    def __neg__(self) -> Curve:
        """Return the curve turned over."""
        return Curve(-self.p_0, -self.p_1, -self.p_2, -self.A, -self.B, self.w)

    def jet(self, t: float) -> tuple[float, float, float]:
        """Return the ordinate, the slope, and the slope of the slope."""
        c, s = math.cos(self.w * t), math.sin(self.w * t)
        swing, rate = self.A * c + self.B * s, self.B * c - self.A * s
        slope = self.p_1 + 2.0 * self.p_2 * t + self.w * rate
        return self.ordinate(t, c, s), slope, 2.0 * self.p_2 - self.w * self.w * swing

    def ordinate(self, t: Any, cosine: Any, sine: Any) -> Any:
        """Return the ordinate from cosine and sine of w t."""
        return self.p_0 + (self.p_1 + self.p_2 * t) * t + (self.A * cosine + self.B * sine)

    def at(self, t: float) -> float:
        """Return the ordinate."""
        return self.jet(t)[0]

    @property
    def swing(self) -> float:
        """How far it swings to either side."""
        return math.hypot(self.A, self.B)

    def surely(self, room: float) -> float:
        """Return a time from which on it is above zero by more than `room`: its parabola runs away to that side."""
        zeros = Curve(self.p_0 - self.swing - 2.0 * room, self.p_1, self.p_2)._zeros()
        return zeros[0] if self.p_1 < 0.0 else max(zeros[-1], 0.0)

    def turnings(self, end: float, begin: float = 0.0) -> Iterator[float]:
        """Go through the places from `begin` to `end` where it turns from rising to falling or back."""
        if self.w == 0.0:
            if self.p_2 != 0.0 and begin < -self.p_1 / (2.0 * self.p_2) < end:
                yield -self.p_1 / (2.0 * self.p_2)
            return
        slope = self.jet(begin)[1]
        for node in self._nodes(begin, end):
            other = self.jet(node)[1]
            if slope < 0.0 < other or other < 0.0 < slope:
                yield zero_between(lambda t: self.jet(t)[1:], begin, node)
            elif other == 0.0 and slope != 0.0:
                yield node
            begin, slope = node, other

    def _nodes(self, begin: float, end: float) -> Iterator[float]:
        """Go through places after `begin`, `end` the last, between which the slope does not turn.

        Raises InputError of more swings than anybody wants to know, or so late that they cannot be told apart.
        """
        size, psi = self.swing * self.w * self.w, math.atan2(self.B, self.A)
        part = 2.0 * self.p_2 / size if size else 2.0
        reach = math.acos(part) if abs(part) < 1.0 else 0.5 * math.pi
        first = (begin * self.w - reach - psi) / TURN
        late = not abs(first) < LATEST
        for n in range(0 if late else math.floor(first), 0 if late else math.floor(first) + MOST):
            for angle in (psi - reach, psi + reach):
                t = (angle + TURN * n) / self.w
                if t >= end:
                    yield end
                    return
                if t > begin:
                    yield t
        raise InputError("hoist-pieces", n=MOST)

    def falls_through(self, end: float, room: float) -> float | None:
        """Return where before `end` it first falls through zero, None where it does not.

        At the beginning it is above zero, or there and rising; `room` is by how much it may dip below for rounding.
        """
        straight = Curve(self.p_0 - self.swing - room, self.p_1, self.p_2)
        ends = [0.0, *sorted(t for t in straight._zeros() if 0.0 < t < end), end]
        for low, high in pairwise(ends):
            if not straight.at(0.5 * (low + high)) < 0.0:
                continue  # its swing does not reach zero there
            begin, value = low, max(self.at(low), 0.0)
            for turning in chain(self.turnings(high, low), (high,)):
                other = self.at(turning)
                if other < -room:
                    return zero_between(lambda t: self.jet(t)[:2], begin, turning) if value > 0.0 else begin
                begin, value = turning, other
        return None

    def _zeros(self) -> list[float]:
        """Return where its parabola is zero; where it turns if it nowhere is."""
        half = 0.5 * self.p_1
        root = math.sqrt(max(half * half - self.p_0 * self.p_2, 0.0))
        larger = -(half + math.copysign(root, half))
        found = [larger / self.p_2] if self.p_2 else []
        return found + ([self.p_0 / larger] if larger else [])


def zero_between(function: Callable[[Any], tuple[Any, Any]], low: Any, high: Any, close: float = CLOSE) -> Any:
    """Return where a function, given with its slope, is zero: of two signs at the ends, it does not turn between.

    Newton's steps that stay between the two, and every third time the middle, until one is a part `close` of the place.
    """
    rises, x = function(high)[0] > 0.0, 0.5 * (low + high)
    for done in range(MOST_ROUNDS):
        value, rate = function(x)
        if value == 0.0:
            return x
        low, high = (low, x) if (value > 0.0) == rises else (x, high)
        following = x - value / rate if rate and done % 3 != 2 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if not low < following < high or abs(following - x) <= close * abs(x):
            return following
        x = following
    return x


ROUNDING = 1e-12  # part of the static stretch that is nothing
SAME = 1e-9  # part of a force within which two are alike


@dataclass(frozen=True, slots=True)
class _Piece:
    """A piece of the motion from `begin` on, which lasts `time`; the curves are of the time since its begin."""

    begin: float
    time: float
    rope: bool  # whether it pulls
    support: bool  # whether it pushes
    stretch: Curve  # of the rope, m
    height: Curve  # of the load above the unloaded support beam, m

    @property
    def end(self) -> float:
        """When it ends."""
        return self.begin + self.time

    @property
    def events(self) -> float:
        """How much it adds to what a motion consists of: itself, and its swings."""
        return 1.0 + self.time * self.height.w / TURN

    def force(self, C_12: float, t: float) -> float:
        """Return the force of a rope of the stiffness C_12 at a time since its begin."""
        return max(C_12 * self.stretch.at(t), 0.0) if self.rope else 0.0


@dataclass(frozen=True)
class OneSided:
    """The whole motion until it only repeats itself, higher and higher."""

    pieces: tuple[_Piece, ...]  # the last one is on the rope, and one swing or as long as it takes to go slack
    C_12: float

    @cached_property
    def t_1(self) -> float:
        """When the support is free of the load for the first time."""
        return next(piece.begin for piece in self.pieces if not piece.support)

    def force(self, t: float) -> float:
        """Return the force of the rope at a time of the motion."""
        return (piece := self.at(t)).force(self.C_12, t - piece.begin)

    def rate(self, t: float) -> float:
        """Return how fast the force of the rope grows."""
        piece = self.at(t)
        return self.C_12 * piece.stretch.jet(t - piece.begin)[1] if piece.rope else 0.0

    def height(self, t: float) -> float:
        """Return how high the load is above the unloaded support beam."""
        return (piece := self.at(t)).height.at(t - piece.begin)

    def at(self, t: float) -> _Piece:
        """Return the piece to which a time of the motion belongs."""
        return self.pieces[min(bisect_right(self._ends, t), len(self.pieces) - 1)]

    @cached_property
    def _ends(self) -> tuple[float, ...]:
        return tuple(piece.end for piece in self.pieces)

    @property
    def events(self) -> float:
        """How many pieces it has, and swings in these."""
        return sum(piece.events for piece in self.pieces)

    def extremes(self, lifted: bool) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return time and force of the first maximum and of the minimum, before the first lift-off or from then on."""
        forces = [(self.t_1, self.force(self.t_1))]
        for piece in self.pieces:
            if (piece.begin >= self.t_1) == lifted:
                inner = piece.stretch.turnings(piece.time) if piece.rope else ()
                forces += [(piece.begin + t, piece.force(self.C_12, t)) for t in chain(inner, (piece.time,))]
        most, least = max(force for _, force in forces), min(force for _, force in forces)
        greatest = min(pair for pair in forces if pair[1] >= most * (1.0 - SAME))
        return greatest, min(pair for pair in forces if pair[1] <= least)

    @property
    def lowest(self) -> float:
        """How high the load is where it is lowest after the lift-off; after its first swing if it only rises."""
        heights = [self.height(math.nextafter(self.pieces[-1].end, 0.0))]
        for piece in self.pieces:
            if piece.begin >= self.t_1:
                curve = piece.height
                lowest = (curve.at(t) for t in curve.turnings(piece.time) if curve.jet(t)[2] > 0.0)
                heights += (height for height in lowest if abs(height) > ROUNDING * curve.swing)  # not t_1 itself
        return min(heights)

    @property
    def slackens(self) -> bool:
        """Whether the rope goes slack after the load has left its support."""
        return any(piece.begin >= self.t_1 and not piece.rope for piece in self.pieces)

    @property
    def least_pull(self) -> float:
        """The least force that a two-sided rope would have to bear on the way: below zero where this one is slack."""
        hanging = (piece.stretch for piece in self.pieces if piece.rope and not piece.support)
        return min(self.C_12 * (stretch.p_0 - stretch.swing) for stretch in hanging)

    @property
    def returns(self) -> tuple[float, ...]:
        """When the load comes back to its support."""
        return tuple(b.begin for a, b in pairwise(self.pieces) if b.support and not a.support)


@dataclass(frozen=True, slots=True)
class _State:
    """Where the load is: time, stretch of the rope, height, speed; what bears."""

    t: float
    stretch: float
    height: float
    speed: float
    rope: bool
    support: bool


@dataclass(frozen=True, slots=True)
class _Hoisting:
    """What moves a load: the numbers that the pieces of its motion follow from."""

    m: float
    g: float
    C_01: float
    C_12: float
    V: float
    a: float

    @property
    def room(self) -> float:
        """What is nothing beside the static stretch of rope and support."""
        return ROUNDING * self.m * self.g * (1.0 / self.C_01 + 1.0 / self.C_12)

    def start(self) -> _State:
        """Return the state with a rope just taut; on a rigid support that in which it carries the load."""
        if math.isinf(self.C_01):
            length = self.m * self.g / self.C_12
            t = 2.0 * length / (self.V + math.sqrt(self.V * self.V + 2.0 * self.a * length))
            return _State(t, length, 0.0, 0.0, rope=True, support=False)
        return _State(0.0, 0.0, -self.m * self.g / self.C_01, 0.0, rope=True, support=True)

    def curves(self, state: _State) -> tuple[Curve, Curve]:
        """Return stretch and height from a state on, while the same bears."""
        rope, beam = self.C_12 / self.m * state.rope, (self.C_01 / self.m if state.support else 0.0)
        square, winding = rope + beam, self.V + self.a * state.t
        whole = Curve(state.stretch + state.height, winding, 0.5 * self.a)
        if square == 0.0:
            height = Curve(state.height, state.speed, -0.5 * self.g)
        else:
            p_2, p_1 = rope * whole.p_2 / square, rope * whole.p_1 / square
            p_0, w = (rope * whole.p_0 - self.g - 2.0 * p_2) / square, math.sqrt(square)
            height = Curve(p_0, p_1, p_2, state.height - p_0, (state.speed - p_1) / w, w)
        down = -height
        p = (whole.p_0 + down.p_0, whole.p_1 + down.p_1, whole.p_2 + down.p_2)
        return Curve(*p, down.A, down.B, down.w), height

    def piece(self, state: _State) -> tuple[_Piece, _State]:
        """Return the piece that begins in a state, and the state in which it ends."""
        stretch, height = self.curves(state)
        room = self.room
        if state.support:
            end = (height if state.rope else stretch).surely(room)
        else:
            end = TURN / height.w if state.rope else (-height).surely(room)
        at_rope = (stretch if state.rope else -stretch).falls_through(end, room)
        at_support = None
        if not math.isinf(self.C_01):
            sooner = end if at_rope is None else at_rope
            at_support = (-height if state.support else height).falls_through(sooner, room)
        time = min([end, *(t for t in (at_rope, at_support) if t is not None)])
        following = _State(
            state.t + time,
            0.0 if time == at_rope else stretch.at(time),
            0.0 if time == at_support else height.at(time),
            height.jet(time)[1],
            rope=state.rope != (time == at_rope),
            support=state.support != (time == at_support),
        )
        return _Piece(state.t, time, state.rope, state.support, stretch, height), following


def one_sided(found: Mapping[str, float], most: float = MOST) -> OneSided:
    """Return the motion of a load on a one-sided support, by a one-sided rope.

    Needed are the quantities `m g C_01 C_12 V_t a`, SI. Raises InputError of more pieces and swings than `most`.
    """
    hoisting = _Hoisting(*(found[name] for name in ("m", "g", "C_01", "C_12", "V_t", "a")))
    state, pieces, slack, events = hoisting.start(), list[_Piece](), False, 0.0
    while True:
        piece, following = hoisting.piece(state)
        pieces.append(piece)
        events += piece.events
        if not events <= most:
            raise InputError("hoist-pieces", n=f"{most:.0f}")
        if piece.rope and not piece.support and not following.support:
            if following.rope or slack:  # a swing without an end, or one after a slack
                return OneSided(tuple(pieces), hoisting.C_12)
            slack = True
        elif following.support:
            slack = False
        state = following
