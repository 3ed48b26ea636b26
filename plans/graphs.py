"""Kinematic diagrams by chords: graphical differentiation of a curve that is drawn to scale.

The curve is divided into sections. From a pole at the distance H to the left of the axes a ray is drawn parallel to the
chord of each section; on the axis it cuts off the mean slope of the section, which belongs to its middle. Done once it
turns travels into velocities, done again velocities into accelerations.

Source: Artobolevsky, Theory of mechanisms and machines (method of chords); Kinytskyi, the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def middles(places: Array) -> Array:
    """Return the middles of sections."""
    found: Array = places[:-1] + 0.5 * (places[1:] - places[:-1])
    return found


def chords(values: Array, section: float) -> Array:
    """Return the mean slope of every section of a curve.

    Parameters
    ----------
    values : float64 or complex128 array of shape (n + 1,)
        Values at the ends of the sections: of a vector the differences of its ends.
    section : float
        Length of a section along the axis.

    Returns
    -------
    array of shape (n,)
        Slopes, at the middles of the sections.

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
    """A curve by plans, and the same by chords where chords give it; `difference` is chords less plans.

    Attributes
    ----------
    times : float64 array of shape (n,)
        Seconds.
    plans, chords : array of shape (n,)
        SI; complex for a vector.
    """

    times: Array
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

    Attributes
    ----------
    unit : str
        `m` for a point, `rad` for a link; velocities and accelerations in it per second and per second squared.
    times : float64 array of shape (n + 1,)
        Ends of the sections, seconds.
    s, v, a : array of shape (n + 1,)
        By plans: signed along a guide and for angles, complex for a point without a guide, whose travel is its place.
    velocity, acceleration : Curve
        By chords beside plans, at the middles: velocities of the sections, accelerations of the sections of the
        velocity curve, which are the ends of the first ones.
    """

    unit: str
    times: Array
    s: Array
    v: Array
    a: Array
    velocity: Curve
    acceleration: Curve


def differentiate(s: Array, section: float, closed: bool) -> tuple[Array, Array]:
    """Return velocities and accelerations by chords of travels at the ends of n sections.

    Parameters
    ----------
    s : array of shape (n + 1,)
        Travels; on a closed curve the last section runs into the first one.

    Returns
    -------
    v : array of shape (n,)
        At the middles of the sections.
    a : array of shape (n,) or (n - 1,)
        At the beginnings of the sections; on an open curve not at the first one.
    """
    v = chords(s, section)
    return v, chords(np.concatenate((v[-1:], v)) if closed else v, section)
