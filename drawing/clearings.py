"""Places that are clear of all that is drawn, thin lines too: for a letter that stands where its reader expects it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from .spots import Bodies, Obstacles, circle_table


def first_clear(
    places: Sequence[complex], size: tuple[float, float], obstacles: Obstacles, gap: float
) -> complex | None:
    """Return the first place about which a box of this width and height is at least `gap` from everything, mm."""
    at, (wide, high) = np.array(places, dtype=complex), 0.5 * np.array(size)
    clear = np.ones(len(at), dtype=bool)
    for bodies in _bodies(obstacles):
        away = bodies.distance(at.real[:, None], at.imag[:, None], wide, high, slice(None))
        clear &= (away >= gap).all(axis=1)
    return complex(at[int(np.argmax(clear))]) if clear.any() else None


def _bodies(obstacles: Obstacles) -> Iterator[Bodies]:
    """Go through strokes, circles and boxes."""
    lines = [np.asarray(ends, dtype=complex).reshape(-1, 2) for ends in (obstacles.segments, obstacles.thin)]
    yield Bodies.strokes(*np.concatenate(lines).T)
    centres, radii = circle_table(obstacles.circles)
    yield replace(Bodies.strokes(centres, centres), radius=radii)
    edges = np.array(obstacles.boxes, dtype=float).reshape(-1, 4)
    boxes = Bodies.strokes(edges[:, 0] + 1j * edges[:, 1], edges[:, 2] + 1j * edges[:, 3])
    yield replace(boxes, along=0.0 * boxes.along, normal=0.0 * boxes.normal)
