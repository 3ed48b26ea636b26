"""Velocities of all points of a link at one position: the field of vectors over the link."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..laws import LAWS
from .chain import moving_bodies
from .solved import SolvedLinkage

Array = NDArray[Any]
MARGIN = 0.15  # how far a field reaches beyond the link's points, in parts of its larger side


def velocities(at: Array, pin: complex, velocity: complex, omega: float) -> Array:
    """Return the velocities of points of a link: v = v_A + omega x (P - A).

    Parameters
    ----------
    at : complex128 array
        Places P of the points, m.
    pin, velocity : complex
        Place and velocity of a point A of the link.
    omega : float
        Angular velocity of the link, rad/s.
    """
    found: Array = LAWS["transport_speed"](omega, at - pin) + velocity
    return found


def velocity_field(solved: SolvedLinkage, link: int, columns: int = 9, rows: int = 7) -> tuple[Array, Array]:
    """Return a grid of places over a link and their velocities, both of shape (rows, columns).

    The grid covers the link's lettered points in the plan of the mechanism, and a margin around them.
    """
    body = moving_bodies(solved.mechanism, solved.structure)[link]
    points = [solved.point(point) for point in body.link.points]
    places = _grid(np.array(points), columns, rows)
    omega = float(solved.values[body.omega]) if body.omega else 0.0
    velocity = solved.point(solved.mechanism.mark("velocity", body.pin))
    return places, velocities(places, solved.point(body.pin), velocity, omega)


def _grid(points: Array, columns: int, rows: int) -> Array:
    side = max(np.ptp(points.real), np.ptp(points.imag)) or 1.0
    xs = np.linspace(points.real.min() - MARGIN * side, points.real.max() + MARGIN * side, columns)
    ys = np.linspace(points.imag.min() - MARGIN * side, points.imag.max() + MARGIN * side, rows)
    grid: Array = xs[None, :] + 1j * ys[:, None]
    return grid
