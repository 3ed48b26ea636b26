"""Curves of many points as broken lines of few: for what only has to keep clear of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .shapes import Group, Polyline, Shape

FEW = 8  # points of a line that is left as it is


def coarser(shape: Shape, within: float) -> Shape:
    """Return a shape with its curves as broken lines of few points, none of them further than `within` mm away."""
    match shape:
        case Polyline(points=points) if len(points) > FEW:
            return replace(shape, points=thinned(points, within))
        case Group(shapes=parts):
            return replace(shape, shapes=tuple(coarser(part, within) for part in parts))
        case _:
            return shape


def thinned(points: tuple[complex, ...], within: float) -> tuple[complex, ...]:
    """Return as few of these points as keep the line through them within so many mm (Douglas and Peucker)."""
    line, kept = np.array(points), np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    open_parts = [(0, len(points) - 1)]
    while open_parts:
        a, b = open_parts.pop()
        between, chord = line[a + 1 : b] - line[a], line[b] - line[a]
        if not len(between):
            continue
        away = np.abs((between * chord.conjugate()).imag) / abs(chord) if chord else np.abs(between)
        k = int(np.argmax(away))
        if away[k] > within:
            kept[a + 1 + k] = True
            open_parts += [(a, a + 1 + k), (a + 1 + k, b)]
    result: tuple[complex, ...] = tuple(line[kept].tolist())
    return result
