"""The motion of a follower over a turn of its cam: four phases of smooth pieces, and least values over them.

The phases are rise, upper dwell, fall, lower dwell. The angle phi of the cam counts from the start of the rise, in the
sense in which the cam turns. Travel and derivatives are in SI; the travel of a rocker is its angle.

Something is looked at in places over the turn: at a corner of the motion there are two, one for the limit from each
side.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from .cam import MIRROR, NEAR, Cam
from .laws_of_motion import SAME, Law, Smooth, law_of_curve, law_of_motion

Array = NDArray[np.float64]
RISE, UPPER, FALL, LOWER = PHASES = ("rise", "upper", "fall", "lower")
TURN = 2.0 * math.pi
SHORT = 1e-6  # rad, of a phase that nobody can draw: what rounded angles leave of a turn
WHOLE = 1e-9  # part of a section by which a node may be off an equal division


@dataclass(frozen=True, slots=True, eq=False)
class Division:
    """Section lines at `angles`, rad: the rise has those from 0 to `top`, the fall those from `leave` to `last`.

    The upper dwell is between them. The lower dwell is the rest of the turn; nothing changes in it, so that it has no
    sections. `jumps` are the lines within a phase at which the acceleration jumps.
    """

    angles: Array
    top: int
    leave: int
    last: int
    jumps: tuple[int, ...] = ()

    @property
    def lines(self) -> range:
        """All section lines."""
        return range(self.last + 1)

    @property
    def sections(self) -> range:
        """All sections; each has the number of the line at its end."""
        return range(1, self.last + 1)

    @property
    def rise(self) -> range:
        """Lines of the rise, both ends among them."""
        return range(self.top + 1)

    @property
    def fall(self) -> range:
        """Lines of the fall, both ends among them."""
        return range(self.leave, self.last + 1)

    @property
    def on_lines(self) -> list[tuple[int, str]]:
        """Lines of the rise, then of the fall, each with the name of its phase."""
        return [(i, phase) for phase in (RISE, FALL) for i in self.of(phase)]

    def of(self, phase: str) -> range:
        """Return the lines of the `rise` or the `fall`."""
        return self.rise if phase == RISE else self.fall

    def pieces(self, phase: str) -> tuple[range, ...]:
        """Return the lines of the `rise` or the `fall`, between jumps: of each piece both ends are among them."""
        lines = self.of(phase)
        ends = sorted({lines[0], *(line for line in self.jumps if line in lines), lines[-1]})
        return tuple(range(a, b + 1) for a, b in pairwise(ends))


@dataclass(frozen=True, slots=True)
class Extreme:
    """An extreme value and the angle of the cam there; at a jump one of its two limits."""

    value: float
    phi: float


@dataclass(frozen=True, slots=True)
class _Jump:
    """A jump of s' (order 1) or of s'' (order 2) at an angle of the cam, with the limits on both sides."""

    phi: float
    order: int
    before: float
    after: float


@dataclass(frozen=True, slots=True)
class Phase:
    """One phase: its name, its ends, and the travel over it as smooth pieces (none when it has no length)."""

    name: str
    start: float
    end: float
    pieces: tuple[Smooth, ...]

    @property
    def length(self) -> float:
        """Angle of the cam during the phase."""
        return self.end - self.start

    @property
    def lasts(self) -> bool:
        """Whether the phase is more than the rounding of angles."""
        return self.length > SHORT

    @property
    def corners(self) -> tuple[float, ...]:
        """Where the pieces of the phase join, its ends among them."""
        return (*(piece.low for piece in self.pieces), self.end)


class Motion:
    """The travel s(phi) of a follower over one turn, with the stroke h, m, or for a rocker its swing, rad.

    The phases have lengths in rad; the lower dwell is the rest of the turn. The fall has by default the law of the
    rise, and runs through its law backwards in time, `mirror`, or in the `same` order.

    Raises InputError: when the phases are more than a turn.
    """

    def __init__(
        self,
        h: float,
        phi_rise: float,
        phi_upper: float,
        phi_fall: float,
        rise: Law,
        fall: Law | None = None,
        order: str = MIRROR,
    ) -> None:
        h, phi_rise, phi_upper, phi_fall = map(float, (h, phi_rise, phi_upper, phi_fall))
        top, leave = phi_rise, phi_rise + phi_upper
        last = leave + phi_fall
        if last > TURN + NEAR:
            raise InputError("cam-phases", angle=f"{math.degrees(last):.7g}")
        if last > TURN - NEAR:
            last = TURN
        back = fall or rise
        mirrored = order == MIRROR  # run through backwards in time, else in the order of the law
        falling = [p.mirrored() for p in reversed(back)] if mirrored else [p.less_than_one() for p in back]
        self.h = h
        pieces = [piece.times(h).stretched(phi_rise, 0.0) for piece in rise]
        self.rise = Phase(RISE, 0.0, top, tuple(pieces))
        self.upper = Phase(UPPER, top, leave, _dwell(top, leave, h))
        pieces = [piece.times(h).stretched(phi_fall, leave) for piece in falling]
        self.fall = Phase(FALL, leave, last, tuple(pieces))
        self.lower = Phase(LOWER, last, TURN, _dwell(last, TURN, 0.0))
        self.phases = self.rise, self.upper, self.fall, self.lower  # in order
        self._pieces = [(phase, piece) for phase in self.phases for piece in phase.pieces]

    def phase(self, name: str) -> Phase:
        """Return a phase by its name."""
        return self.phases[PHASES.index(name)]

    @cached_property
    def _derivatives(self) -> list[list[Smooth]]:
        """The pieces of the travel and of its two derivatives."""
        travel = [piece for _, piece in self._pieces]
        velocity = [piece.derivative() for piece in travel]
        return [travel, velocity, [piece.derivative() for piece in velocity]]

    @cached_property
    def _tables(self) -> tuple[Array, Array, Array, list[tuple[Array, NDArray[Any]]]]:
        """Where pieces begin, from where they are counted, rates of waves; of every derivative powers and waves.

        The powers are the highest first; each piece has a column, so that many angles are one array.
        """
        starts, origins, rates = np.array([(piece.low, piece.origin, piece.rate) for _, piece in self._pieces]).T.copy()
        tables = []
        for curves in self._derivatives:
            rows = [*zip_longest(*(curve.coefficients for curve in curves), fillvalue=0.0)]
            tables.append((np.array(rows[::-1]), np.array([curve.wave for curve in curves])))
        return starts, origins, rates, tables

    def at(self, phi: Any, side: int = 1) -> tuple[Array, Array, Array]:
        """Return s, ds/dphi, d2s/dphi2 at the angles `phi`, rad, of any turn.

        Where they jump, the limits from the right (side +1) or from the left (side -1).
        """
        phi = np.asarray(phi, float)
        turns = np.floor((phi + NEAR) / TURN) if side > 0 else -np.floor(1.0 - (phi - NEAR) / TURN)
        phi = phi - TURN * turns
        starts, origins, rates, tables = self._tables
        which = np.maximum(np.searchsorted(starts, phi + side * NEAR) - 1, 0)
        rows = [(powers[:, which], waves[which] if waves.any() else None) for powers, waves in tables]
        return _along(phi - origins[which], rates[which], rows)

    @property
    def written(self) -> tuple[Array, list[str], Array]:
        """Where the pieces begin, and numbers by which each of them is known: their names, and a row for each."""
        starts, origins, rates, tables = self._tables
        columns = {"origin": origins, "rate": rates}
        for order, (powers, waves) in enumerate(tables):
            columns |= {f"power{order}_{k}": row for k, row in enumerate(powers)}
            if waves.any():
                columns |= {f"cosine{order}": waves.real, f"sine{order}": -waves.imag}
        return starts, [*columns], np.column_stack([*columns.values()])

    def read(self, phi: Any, given: Callable[[str], Any]) -> tuple[Any, Any, Any]:
        """Return s, ds/dphi, d2s/dphi2 at an angle of the turn from the numbers of its piece, which are `given`."""
        rows = [
            (
                [given(f"power{order}_{k}") for k in range(len(powers))],
                (given(f"cosine{order}"), given(f"sine{order}")) if waves.any() else None,
            )
            for order, (powers, waves) in enumerate(self._tables[3])
        ]
        return _along(phi - given("origin"), given("rate"), rows)

    def maximum(self, s: float, ds: float, d2s: float, phases: Iterable[str] = PHASES) -> Extreme:
        """Return the exact maximum of s * travel + ds * first + d2s * second derivative over some of the phases.

        At jumps both limits count.
        """
        wanted = tuple(phases)
        best = Extreme(-math.inf, 0.0)
        for (phase, piece), first, second in zip(self._pieces, *self._derivatives[1:3], strict=True):
            if phase.name not in wanted:
                continue
            curve = piece.times(s).plus(first.times(ds)).plus(second.times(d2s))
            for place in curve.extreme_places():
                value = curve.value(place)
                if value > best.value:
                    best = Extreme(value, place)
        return best

    def minimum(self, s: float, ds: float, d2s: float, phases: Iterable[str] = PHASES) -> Extreme:
        """Return the exact minimum likewise."""
        found = self.maximum(-s, -ds, -d2s, phases)
        return Extreme(-found.value, found.phi)

    def _greatest(self, ds: float, d2s: float) -> Extreme:
        up, down = self.maximum(0.0, ds, d2s), self.maximum(0.0, -ds, -d2s)
        return up if up.value >= down.value * (1.0 - SAME) else down

    @cached_property
    def ds_max(self) -> Extreme:
        """The greatest |ds/dphi|."""
        return self._greatest(1.0, 0.0)

    @cached_property
    def d2s_max(self) -> Extreme:
        """The greatest |d2s/dphi2|."""
        return self._greatest(0.0, 1.0)

    @cached_property
    def jumps(self) -> tuple[_Jump, ...]:
        """All jumps of the velocity, and of the acceleration where the velocity has none, in order."""
        found: list[_Jump] = []
        sizes = (0.0, self.ds_max.value, self.d2s_max.value)
        for k, (_, piece) in enumerate(self._pieces):
            for order in (1, 2):
                curves = self._derivatives[order]
                before, after = curves[k - 1].value(curves[k - 1].high), curves[k].value(piece.low)
                if abs(after - before) > SAME * sizes[order]:
                    found.append(_Jump(piece.low, order, before, after))
                    break
        return tuple(found)

    @cached_property
    def velocity_jumps(self) -> tuple[_Jump, ...]:
        """The jumps of the velocity, in order."""
        return tuple(jump for jump in self.jumps if jump.order == 1)

    @property
    def drops(self) -> tuple[float, ...]:
        """Angles at which the velocity jumps down, in order: there a cam has a corner."""
        return tuple(jump.phi for jump in self.velocity_jumps if jump.after < jump.before)

    @property
    def leaps(self) -> tuple[float, ...]:
        """Angles at which the velocity jumps up, in order: there a profile goes on by an arc or a flat."""
        return tuple(jump.phi for jump in self.velocity_jumps if jump.after > jump.before)

    @cached_property
    def inflexions(self) -> tuple[float, ...]:
        """Angles at which the acceleration changes its sign, in order."""
        found: list[float] = []
        last, small = 0, SAME * self.d2s_max.value
        for curve in self._derivatives[2]:
            for low, high in zip([curve.low, *(roots := curve.roots())], [*roots, curve.high], strict=True):
                middle = curve.value(0.5 * (low + high))
                sign = (middle > small) - (middle < -small)
                if sign * last < 0:
                    found.append(low)
                last = sign or last
        return tuple(found)

    @cached_property
    def corners(self) -> tuple[float, ...]:
        """Angles at which the pieces join, 0 and a whole turn among them."""
        return (*(piece.low for _, piece in self._pieces), TURN)

    def divided(self, rise: Array, fall: Array, near: float) -> Division:
        """Return section lines of rise and fall together; a jump is on one that is less than `near` rad from it."""
        top = len(rise) - 1
        leave = top + (self.upper.length > 0.0)
        angles = np.concatenate((rise, fall if leave > top else fall[1:]))
        last = leave + len(fall) - 1
        lines = ((int(np.abs(angles - jump.phi).argmin()), jump.phi) for jump in self.jumps)
        jumps = tuple(i for i, phi in lines if abs(angles[i] - phi) < near and (0 < i < top or leave < i < last))
        return Division(angles, top, leave, last, jumps)

    def division(self, sections: int = 12) -> Division:
        """Return the section lines on which a cam is drawn.

        Rise and fall have at least as many sections each as asked for; jumps and inflexions lie on section lines. The
        sections of a phase are equal where some number of them, at most twice that asked for, puts all of them there.
        """
        marked = [*(jump.phi for jump in self.jumps), *self.inflexions]
        rise, fall = (_divided(phase, marked, sections) for phase in (self.rise, self.fall))
        found = self.divided(rise, fall, math.inf)
        for jump in self.jumps:  # exactly, to have the limits of both sides there
            found.angles[np.abs(found.angles - jump.phi).argmin()] = jump.phi
        return found

    def samples(self, most: float = math.radians(0.5)) -> Array:
        """Return angles over the whole turn, from 0 to a turn, corners among them, at most `most` rad apart."""
        parts = [
            np.linspace(low, high, max(1, math.ceil((high - low) / most)), endpoint=False)
            for low, high in pairwise(self.corners)
        ]
        return np.append(np.concatenate(parts), TURN)


def _along(t: Any, rate: Any, rows: Iterable[tuple[Any, Any]]) -> tuple[Any, Any, Any]:
    """Return the travel and its derivatives so far along a piece: of each powers, the highest first, and a wave.

    A wave is complex, or the pair of its cosine and its sine; without one it is None.
    """
    curves = []
    for powers, wave in rows:
        value = powers[0]
        for row in powers[1:]:
            value = value * t + row
        if wave is not None:
            cosine, sine = wave if isinstance(wave, tuple) else (wave.real, -wave.imag)
            value = value + (cosine * np.cos(rate * t) + sine * np.sin(rate * t))
        curves.append(value)
    return curves[0], curves[1], curves[2]


def motion_of(cam: Cam, values: Mapping[str, float]) -> Motion:
    """Return the motion of a cam with its numbers: h, phi_rise, phi_upper, phi_fall, u, u_fall.

    Raises InputError: when a law cannot be had with these numbers.
    """
    u = values.get("u", 0.5)
    rise, fall = (
        law_of_curve(curve) if (curve := cam.curve(name)) else law_of_motion(name, part)
        for name, part in ((cam.law, u), (cam.falls_by, values.get("u_fall", u)))
    )
    return Motion(
        values["h"], values["phi_rise"], values.get("phi_upper", 0.0), values["phi_fall"], rise, fall, cam.fall
    )


def _dwell(start: float, end: float, s: float) -> tuple[Smooth, ...]:
    return (Smooth(start, end, start, (s,)),) if end > start else ()


def _divided(phase: Phase, marked: Iterable[float], sections: int) -> Array:
    """Return section lines of a phase, the `marked` angles inside it among them."""
    near = WHOLE * phase.length
    inner = sorted({round((phi - phase.start) / near) for phi in marked if phase.start + near < phi < phase.end - near})
    parts = [0.0, *(WHOLE * k for k in inner), 1.0]
    for count in range(sections, 2 * sections + 1):
        if all(abs(part * count - round(part * count)) < WHOLE * count for part in parts):
            return phase.start + phase.length * (np.arange(count + 1) / count)
    counts = [math.ceil(sections * (b - a)) for a, b in pairwise(parts)]
    steps = [np.linspace(a, b, n, endpoint=False) for (a, b), n in zip(pairwise(parts), counts, strict=True)]
    return phase.start + phase.length * np.append(np.concatenate(steps), 1.0)


Function = Callable[[Any, int], NDArray[Any]]
FINE = math.radians(0.25)  # between places
FEWEST = 8  # cells of a piece
APART = 2e-12  # rad, from a corner, where the side of a limit no longer matters
GOLDEN, ROUNDS = 0.5 * (math.sqrt(5.0) - 1.0), 60


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Angles `phi` in order, each with the side of its limit, +1 right or -1 left."""

    phi: Array
    side: NDArray[np.intp]

    @classmethod
    def between(cls, corners: Sequence[float], extra: Iterable[float] = ()) -> Places:
        """Return places at most `FINE` apart between corners, those of `extra` among them, of any turn."""
        further = np.mod(np.fromiter(extra, float), TURN)
        parts, sides = [], []
        for low, high in pairwise(corners):
            even = np.linspace(low, high, max(FEWEST, math.ceil((high - low) / FINE)) + 1)
            inner = further[(further > low) & (further < high)]
            parts.append(np.unique(np.concatenate((even, inner))))
            sides.append(np.ones(len(parts[-1]), int))
            sides[-1][-1] = -1
        return cls(np.concatenate(parts), np.concatenate(sides))

    def values(self, function: Function) -> NDArray[Any]:
        """Return the values of a function of the angle and the side."""
        return np.where(self.side > 0, function(self.phi, 1), function(self.phi, -1))

    def cell(self, i: int) -> tuple[float, float, int]:
        """Return the cell between the places i and i + 1, all round: its ends and the side for what is in it."""
        a, b = i % len(self.phi), (i + 1) % len(self.phi)
        low, high = float(self.phi[a]), float(self.phi[b])
        return low, high if high >= low else high + TURN, int(self.side[b])


def refined(function: Function, low: Array, high: Array) -> tuple[Array, Array]:
    """Return the least values in brackets, and where, by golden section; each bracket lies inside one piece."""
    low, high = np.atleast_1d(low) + APART, np.atleast_1d(high) - APART
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    left, right = function(a, 1), function(b, 1)
    for _ in range(ROUNDS):
        down = left <= right
        low, high = np.where(down, low, a), np.where(down, b, high)
        kept, value = np.where(down, a, b), np.where(down, left, right)
        fresh = np.where(down, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        found = function(fresh, 1)
        a, b = np.where(down, fresh, kept), np.where(down, kept, fresh)
        left, right = np.where(down, found, value), np.where(down, value, found)
    return np.minimum(left, right), np.where(left <= right, a, b)


def least(function: Function, corners: Sequence[float]) -> Extreme:
    """Return the least of all `minima`, the first of equal ones."""
    return min(minima(function, corners), key=lambda minimum: minimum.value)


def minima(function: Function, corners: Sequence[float]) -> list[Extreme]:
    """Return the minima of a function between corners of the motion, the limits there among them, in order of phi.

    Where it is constant its first place stands for all.
    """
    places = Places.between(corners)
    values, phi = places.values(function), places.phi
    begins = np.append(True, np.diff(phi) == 0.0)
    ends = np.roll(begins, -1)
    before = np.where(begins, np.inf, np.roll(values, 1))
    after = np.where(ends, np.inf, np.roll(values, -1))
    at = np.flatnonzero((values < before) & (values <= after))
    low, high = phi[np.where(begins[at], at, at - 1)], phi[np.where(ends[at], at, at + 1)]
    lower, where = refined(function, low, high)
    better = lower < values[at]
    found = np.where(better, lower, values[at]), np.where(better, where, phi[at])
    return [Extreme(float(value), float(place)) for value, place in zip(*found, strict=True)]
