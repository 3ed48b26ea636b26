"""A cam with an oscillating roller follower, the rocker: its smallest sizes, pressure angles and path.

At phi = 0 the rocker lies in its lowest position, from its pivot horizontally to the right; it lifts the roller up, the
cam is below. As for a roller on a line, e + i s_0 is the roller's lowest place seen from the cam's centre, r_0 its
distance; the travel is the angle psi of the rocker. The normal runs through the point of the rocker's line that is
l (1 - sense psi') from the pivot, so every position of the rocker permits a half plane of e + i s_0, and the smallest
cam is the place nearest to the origin in all of them.

With the distance l_OC of the pivot from the cam's centre given, one number is left: the angle beta at the pivot between
the rocker in its lowest position and the cam's centre, of which every position permits an interval.

Source: Artobolevsky, Theory of mechanisms and machines (cams with an oscillating follower).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .motion import RISE, Extreme, Motion, Phase
from .places import Minimum, minima
from .sizes import BACK, RIGHT_ANGLE, HalfPlane, Limits, Nearest, nearest

Array = NDArray[np.float64]
Points = NDArray[Any]  # complex
ROUNDS = 40
REACHED = 1e-12  # part of the rocker's length by which a position may be outside its limit
LOWEST, HIGHEST = "lowest", "highest"  # the cam stays below the rocker


@dataclass(frozen=True, slots=True)
class RockerSizes:
    """Sizes of a cam with a rocker of length l, m; `on` names the limits that it just reaches."""

    r_0: float
    l_OC: float
    l: float
    e: float
    s_0: float
    on: tuple[str, ...] = ()
    r_0_most: float = math.inf  # the greatest r_0 that the limits permit at this l_OC


@dataclass(frozen=True, slots=True)
class NoPlace:
    """Limits, one alone or several together, that permit no place of the cam's centre."""

    limits: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit of the pressure angle in one phase; `way` is +1 where it is to the side of a rise, -1 of a fall."""

    name: str
    phase: Phase
    gamma: float
    way: int


@dataclass(frozen=True, slots=True)
class Rocker:
    """A rocker of length l, m, with its motion psi(phi), rad, over a cam that turns with a sense."""

    motion: Motion
    l: float
    sense: int = 1

    def half_planes(self, limit: Limit, phi: Any, side: int = 1) -> tuple[Points, Array]:
        """Return normals and least components of the half planes of e + i s_0 that its positions permit."""
        psi, dpsi, _ = self.motion.at(phi, side)
        sine, cosine, way = math.sin(limit.gamma), math.cos(limit.gamma), limit.way
        normal = complex(way * self.sense * sine, cosine) * (np.cos(psi) + 1j * np.sin(psi))
        least = self.l * (sine * way * (self.sense * (np.cos(psi) - 1.0) + dpsi) - cosine * np.sin(psi))
        return normal, least

    def limits(self, limits: Limits) -> list[Limit]:
        """Return the limits in rise and fall, and to the other sides if wanted."""
        ways = ((1, ""), (-1, BACK))[: 1 + limits.two_sided]
        phases = ((self.motion.rise, limits.gamma_rise, 1), (self.motion.fall, limits.gamma_fall, -1))
        return [Limit(p.name + end, p, gamma, push * up) for push, end in ways for p, gamma, up in phases]


@dataclass(frozen=True, slots=True)
class RockerPath:
    """The path of a rocker's roller, for `RollerProfile`."""

    motion: Motion
    sizes: RockerSizes

    @property
    def pivot(self) -> complex:
        """The rocker's pivot, seen from the cam's centre."""
        return complex(self.sizes.e - self.sizes.l, self.sizes.s_0)

    def centre(self, phi: Any, side: int = 1) -> tuple[Points, Points, Points]:
        """Return q, q', q''."""
        psi, dpsi, d2psi = self.motion.at(phi, side)
        arm = self.sizes.l * (np.cos(psi) + 1j * np.sin(psi))
        return self.pivot + arm, 1j * dpsi * arm, (1j * d2psi - dpsi * dpsi) * arm

    def seat(self, corner: Points, R: float) -> Array:
        """Return the angle at which a roller of radius R rests on points of the frame; NaN where it passes them."""
        reach = corner - self.pivot
        far, l = np.abs(reach), self.sizes.l
        with np.errstate(invalid="ignore"):
            psi: Array = np.arctan2(reach.imag, reach.real) + np.arccos((l * l + far * far - R * R) / (2.0 * l * far))
        return psi


def smallest_rocker(rocker: Rocker, limits: Limits) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0, the place of the cam's centre being free, or why there is none.

    The half planes of a few positions are held; as long as another position is outside its limit, it joins them. A
    wide swing and large transmission angles may leave nothing.
    """
    swing, l = rocker.motion.h, rocker.l
    high = complex(-math.sin(swing), math.cos(swing))
    planes = [HalfPlane(LOWEST, 1j, 0.0), HalfPlane(HIGHEST, high, -l * math.sin(swing))]
    wanted = rocker.limits(limits)
    found = Nearest(0j, ())
    for _ in range(ROUNDS):
        further = [plane for limit in wanted for plane in _outside(rocker, limit, found.place)]
        if not further:
            break
        planes += further
        if (nearer := nearest(planes)) is None:
            return NoPlace(_opposed(planes))
        found = nearer
    place = found.place
    on = tuple(plane.name for plane in found.on)
    return RockerSizes(abs(place), abs(l - place), l, place.real, place.imag, on)


def _opposed(planes: list[HalfPlane]) -> tuple[str, ...]:
    """Return names of half planes that together permit nothing, as few as may be."""
    names = list(dict.fromkeys(plane.name for plane in planes))
    for name in tuple(names):
        fewer = [other for other in names if other != name]
        if nearest([plane for plane in planes if plane.name in fewer]) is None:
            names = fewer
    return tuple(names)


def _outside(rocker: Rocker, limit: Limit, place: complex) -> Iterator[HalfPlane]:
    """Go through the positions that most lack their limit."""

    for worst in _slacks(rocker, limit, place):
        if worst.value < -REACHED * rocker.l:
            side = 1 if worst.phi < limit.phase.end else -1
            normal, least = rocker.half_planes(limit, worst.phi, side)
            yield HalfPlane(limit.name, complex(normal), float(least), worst.phi)


def _slacks(rocker: Rocker, limit: Limit, place: complex) -> list[Minimum]:
    """Return the least distances of a place from the limit, m, negative outside of it, and where they are."""

    def slack(phi: Any, side: int) -> Array:
        normal, least = rocker.half_planes(limit, phi, side)
        room: Array = normal.real * place.real + normal.imag * place.imag - least
        return room

    return minima(slack, limit.phase.corners)


def tightest(rocker: Rocker, limit: Limit, place: complex) -> float:
    """Return the angle of the cam at which a place e + i s_0 comes nearest to a limit, rad."""
    return min(_slacks(rocker, limit, place), key=lambda one: one.value).phi


def smallest_rocker_at(rocker: Rocker, limits: Limits, l_OC: float) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0 at a given distance of the pivot, or the limits that permit none."""
    least, most = (0.0, LOWEST), (math.pi - rocker.motion.h, HIGHEST)
    for limit in rocker.limits(limits):
        bounds = _Bounds(rocker, limit, l_OC)
        if bounds.most_sine() > 1.0:
            return NoPlace((limit.name,))
        low, high = (min(one.value for one in minima(end, limit.phase.corners)) for end in (bounds.low, bounds.high))
        least, most = max(least, (-low, limit.name)), min(most, (high, limit.name))
    beta, name = least
    if beta > most[0]:
        return NoPlace((name, most[1]))
    place, farthest = (rocker.l - l_OC * complex(math.cos(end), -math.sin(end)) for end in (beta, most[0]))
    return RockerSizes(abs(place), l_OC, rocker.l, place.real, place.imag, (name,), abs(farthest))


@dataclass(frozen=True, slots=True)
class _Bounds:
    """Between which angles beta the positions of a rocker permit the cam's centre at the distance d of the pivot.

    With x = beta + psi a limit is sin(x - way sense gamma) >= q.
    """

    rocker: Rocker
    limit: Limit
    d: float

    def sine(self, phi: Any, side: int = 1) -> Array:
        """Return q."""
        _, dpsi, _ = self.rocker.motion.at(phi, side)
        way = self.limit.way
        q: Array = (self.rocker.l / self.d) * math.sin(self.limit.gamma) * way * (dpsi - self.rocker.sense)
        return q

    def most_sine(self) -> float:
        """Return the greatest q: above 1 nothing is permitted."""
        return -min(one.value for one in minima(lambda phi, side: -self.sine(phi, side), self.limit.phase.corners))

    def low(self, phi: Any, side: int) -> Array:
        """Return the least beta of the positions, negative so that the greatest of them is a minimum."""
        return self._shift(phi, side) - np.arcsin(np.clip(self.sine(phi, side), -1.0, 1.0))

    def high(self, phi: Any, side: int) -> Array:
        """Return the greatest beta of the positions."""
        return math.pi - self._shift(phi, side) - np.arcsin(np.clip(self.sine(phi, side), -1.0, 1.0))

    def _shift(self, phi: Any, side: int) -> Array:
        shift: Array = self.rocker.motion.at(phi, side)[0] - self.limit.way * self.rocker.sense * self.limit.gamma
        return shift


def rocker_pressure(rocker: Rocker, sizes: RockerSizes, phi: Any, side: int = 1) -> Array:
    """Return the pressure angle theta, rad: from the roller's velocity in the rise to the normal, its sign as usual."""
    psi, dpsi, _ = rocker.motion.at(phi, side)
    cosine, sine = np.cos(psi), np.sin(psi)
    x, y = sizes.e - sizes.l, sizes.s_0  # the pivot
    across = rocker.l * (rocker.sense * dpsi - 1.0) - (x * cosine + y * sine)
    theta: Array = np.arctan2(across, y * cosine - x * sine)
    return theta


def least_rocker_transmission(rocker: Rocker, sizes: RockerSizes, phase: Phase, two_sided: bool = False) -> Extreme:
    """Return the least transmission angle of the rise or the fall, rad, and where it is."""
    way = rocker.sense * (1 if phase.name == RISE else -1)

    def gamma(phi: Any, side: int) -> Array:
        theta = rocker_pressure(rocker, sizes, phi, side)
        return RIGHT_ANGLE - (np.abs(theta) if two_sided else way * theta)

    least = min(minima(gamma, phase.corners), key=lambda one: one.value)
    return Extreme(least.value, least.phi, phase.name)
