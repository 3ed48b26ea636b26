"""Necks of an envelope: where a position cuts what another, far from it in phi, has left, however little it is."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .motion import TURN

Array = NDArray[np.float64]
Points = NDArray[Any]  # complex
CELLS = 360  # of a turn, in which envelope and positions are looked at
APART = 3  # cells from a position to those that are not next to it
ZOOM = np.linspace(-1.0, 1.0, 5)
ROUNDS = 30  # by which a cell is halved: to 1e-11 rad
HALVED = 0.5 ** np.arange(24)  # of a cell, around a neck that is looked at closely


class Cut(Protocol):
    """An envelope, and how deep points of it are inside the follower."""

    def practical(self, phi: Any, side: int = 1) -> Points:
        """Return the points of the envelope, m."""

    def depth(self, points: Any, phi: Any) -> Array:
        """Return how deep points of the cam are inside the follower at the angles `phi`, m; negative outside."""


def necks(envelope: Cut, inside: float) -> list[tuple[float, float]]:
    """Return the deepest cuts of positions into places of the envelope that are not next to them.

    The depth is looked at in all cells; where it is greatest among its neighbours, and might be positive between
    them, it is found exactly, so that no cut is too narrow.

    Parameters
    ----------
    inside : float
        Depth, m, up to which nothing is cut: rounding.

    Returns
    -------
    list of (float, float)
        Angles, rad, of the place that is cut and of the position that cuts it.
    """
    phi = np.arange(CELLS) * (TURN / CELLS)
    depth = envelope.depth(envelope.practical(phi)[:, np.newaxis], phi)
    shifted = [np.roll(depth, by, (0, 1)) for by in ((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1))]
    most, least = np.maximum.reduce(shifted), np.minimum.reduce(shifted)
    apart = np.abs(np.subtract.outer(np.arange(CELLS), np.arange(CELLS)))
    wanted = (depth >= most) & (2.0 * depth - least > inside) & (np.minimum(apart, CELLS - apart) >= APART)
    found = (_deepest(envelope, phi[i], phi[j]) for i, j in np.argwhere(wanted))
    return [place for place, value in found if value > inside]


def _deepest(envelope: Cut, place: float, position: float) -> tuple[tuple[float, float], float]:
    """Return where around a place and a position the depth is greatest, and the depth, m."""
    width, value = TURN / CELLS, -np.inf
    for _ in range(ROUNDS):
        places, positions = place + width * ZOOM, position + width * ZOOM
        depth = envelope.depth(envelope.practical(places % TURN)[:, np.newaxis], positions % TURN)
        i, j = np.unravel_index(int(np.argmax(depth)), depth.shape)
        place, position, value = float(places[i]), float(positions[j]), float(depth[i, j])
        width *= 0.5
    return (place % TURN, position % TURN), value


def around(found: list[tuple[float, float]]) -> Iterator[Array]:
    """Go through the angles at which an envelope is looked at around its necks, ever closer to them."""
    closer = (TURN / CELLS) * HALVED
    for ends in found:
        for phi in ends:
            yield np.concatenate((phi - closer, [phi], phi + closer))
