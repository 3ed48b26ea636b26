"""Diagrams of motion over the cycle, of a point or a link: travel, velocity and acceleration by plans and by chords.

By chords a curve that is drawn to scale is differentiated graphically. It is divided into sections. From a pole at the
distance H to the left of the axes a ray is drawn parallel to the chord of each section; on the axis it cuts off the
mean slope of the section, which belongs to its middle. Done once it turns travels into velocities, done again
velocities into accelerations.

Beside them the field of velocities of a link: those of all its points in one position.

Source: Artobolevsky, Theory of mechanisms and machines (method of chords); Kinytskyi, the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....scales.errors import InputError
from ....scales.names import unknown
from ...laws import LAWS, inclination
from ..chain import moving_bodies
from ..solved import SolvedLinkage
from .cycle import Cycle
from .strokes import unwound

Array = NDArray[Any]
MARGIN = 0.15  # how far a field reaches beyond the link's points, in parts of its larger side


def chords(values: Array, section: float) -> Array:
    """Return the mean slope of every section of a curve, which belongs to its middle.

    `values`, float64 or complex128 of shape (n + 1,), stand at the ends of sections so long along the axis.

    >>> chords(np.array([0.0, 1.0, 4.0]), 0.5).tolist()
    [2.0, 6.0]
    """
    slopes: Array = (values[1:] - values[:-1]) * (1.0 / section)
    return slopes


def pole_distance(mu: float, mu_t: float, derived: float) -> float:
    """Return the pole distance H, mm, with which a derived curve gets the scale factor `derived`.

    A ray at the pole distance rises like its chord, so that mu_v = mu_s / (mu_t * H), mu_a = mu_v / (mu_t * H).
    """
    return mu / (mu_t * derived)


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A curve by plans, and the same by chords where chords give it: SI, shape (n,), complex for a vector."""

    times: Array  # seconds
    plans: Array
    chords: Array

    @property
    def difference(self) -> Array:
        """Chords less plans."""
        found: Array = self.chords - self.plans
        return found

    @property
    def per_cent(self) -> Array:
        """Size of the difference in per cent of the largest size of the curve by plans."""
        size: float = np.nanmax(np.abs(self.plans), initial=0.0)
        found: Array = np.abs(self.difference) * (100.0 / size if size else 0.0)
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Diagrams:
    """Diagrams of travel, velocity and acceleration over n sections of the cycle.

    By plans they are signed along a guide and for angles, complex for a point without a guide, whose travel is its
    place; shape (n + 1,).
    """

    unit: str  # `m` for a point, `rad` for a link; of velocities per second, of accelerations per second squared
    times: Array  # ends of the sections, seconds
    s: Array
    v: Array
    a: Array
    velocity: Curve  # by chords beside plans, at the middles of the sections
    acceleration: Curve  # by chords of the velocity curve, at the ends of the sections


def differentiate(s: Array, section: float, closed: bool) -> tuple[Array, Array]:
    """Return velocities and accelerations by chords of travels `s` at the ends of n sections, shape (n + 1,).

    The velocities stand at the middles, shape (n,), the accelerations at the beginnings of the sections; on a closed
    curve the last section runs into the first one, on an open one no acceleration stands at the first.
    """
    v = chords(s, section)
    return v, chords(np.concatenate((v[-1:], v)) if closed else v, section)


def _named(cycle: Cycle, of: str) -> tuple[tuple[str, str | None, str | None], bool]:
    """Return the names of travel, velocity and acceleration of a point or a link, and whether they are of an angle."""
    mechanism = cycle.mechanism
    points = dict.fromkeys(point for link in mechanism.links for point in link.points)
    links = {str(link.number): link.number for link in mechanism.links}
    sliders = (output for output in cycle.outputs if output.slides)
    slider = next((x for x in sliders if of in (str(x.link), *mechanism.link(x.link).points)), None)
    if slider is not None:
        return (slider.place, slider.rate, slider.change), False
    if of in links:
        body = moving_bodies(mechanism, cycle.structure)[links[of]]
        return (body.direction, body.omega, body.epsilon), True
    if of not in points:
        raise unknown("motion-unknown", of, (*points, *links))
    return (of, mechanism.mark("velocity", of), mechanism.mark("acceleration", of)), False


def diagrams(cycle: Cycle, of: str, sections: int = 12) -> Diagrams:
    """Draw the diagrams of a point or a link over the cycle, by plans and by chords.

    Parameters
    ----------
    of : str
        A point's letter, or the number of a link for its angle. A slider on the frame, or a point of it, has signed
        travels along its guide; of any other point travel, velocity and acceleration are vectors.
    sections : int
        Sections of the cycle.

    Raises
    ------
    InputError
        No such point or link; the cycle was computed without velocities or accelerations.
    """
    names, turns = _named(cycle, of)
    if not set(filter(None, names)) <= set(cycle.program.names):
        raise InputError("motion-plans", name=of)
    places = cycle.range.low + (cycle.range.high - cycle.range.low) * (np.arange(2 * sections + 1) / (2 * sections))
    closed = cycle.drive.turns
    duration = abs(cycle.range.high - cycle.range.low) / cycle.speed
    values = cycle.at(places, [name for name in names if name])
    s, v, a = (values[name] if name else np.zeros(len(places)) for name in names)
    s = unwound(inclination(s)) if turns else s
    times = duration * (np.arange(2 * sections + 1) / (2 * sections))
    v_chords, a_chords = differentiate(s[::2], duration / sections, closed)
    inner = slice(0, -1) if closed else slice(1, -1)
    curves = Curve(times[1::2], v[1::2], v_chords), Curve(times[::2][inner], a[::2][inner], a_chords)
    return Diagrams("rad" if turns else "m", times[::2], s[::2], v[::2], a[::2], *curves)


def velocities(at: Array, pin: complex, velocity: complex, omega: float) -> Array:
    """Return the velocities of points of a link: v = v_A + omega x (P - A).

    Places P and A, the `pin`, are in metres, complex128; `velocity` is that of A, `omega` in rad/s.
    """
    found: Array = LAWS["transport_speed"](omega, at - pin) + velocity
    return found


def velocity_field(solved: SolvedLinkage, link: int, columns: int = 9, rows: int = 7) -> tuple[Array, Array]:
    """Return a grid of places over a link and their velocities, both of shape (rows, columns).

    The grid covers the link's lettered points in the plan of the mechanism, and a margin around them.
    """
    body = moving_bodies(solved.mechanism, solved.structure)[link]
    points = np.array([solved.point(point) for point in body.link.points])
    beside = MARGIN * (max(np.ptp(points.real), np.ptp(points.imag)) or 1.0)
    xs = np.linspace(points.real.min() - beside, points.real.max() + beside, columns)
    ys = np.linspace(points.imag.min() - beside, points.imag.max() + beside, rows)
    places = xs[None, :] + 1j * ys[:, None]
    omega = float(solved.values[body.omega]) if body.omega else 0.0
    velocity = solved.point(solved.mechanism.mark("velocity", body.pin))
    return places, velocities(places, solved.point(body.pin), velocity, omega)
