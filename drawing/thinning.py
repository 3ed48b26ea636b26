"""Curves of many points: as broken lines of few, for what only has to keep clear of them, and where they are freest."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from .shapes import Group, Polyline, Shape

FEW = 8  # points of a line that is left as it is
FAR = 1e6 + 0j  # mm


def coarser(shape: Shape, within: float) -> Shape:
    """Return a shape with its curves as broken lines of few points, none of them further than `within` mm away."""
    match shape:
        case Polyline(points=points) if len(points) > FEW:
            return replace(shape, points=thinned(points, within))
        case Group(shapes=parts):
            return replace(shape, shapes=tuple(coarser(part, within) for part in parts))
        case _:
            return shape


def thinned(points: Sequence[complex], within: float) -> tuple[complex, ...]:
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


def freest(curves: Sequence[Sequence[complex]], step: float, each: float) -> Iterator[tuple[int, complex, complex]]:
    """Go through places where curves are far from one another: the curve, the place, its direction there.

    They are looked for `step` mm apart; a curve has one such place for `each` mm of it, and one more.
    """
    dense = [_dense(curve, step) for curve in curves]
    for n, places in enumerate(dense):
        others = np.array([place for m, found in enumerate(dense) if m != n for place in found] or [FAR])
        own = np.array(places)
        room = np.min(np.abs(own[:, np.newaxis] - others[np.newaxis, :]), axis=1)
        room[[0, -1]] = -1.0  # not at the ends
        for _ in range(1 + int(len(places) / (each / step))):
            k = int(np.argmax(room))
            along = places[min(k + 1, len(places) - 1)] - places[max(k - 1, 0)]
            yield n, places[k], along / abs(along)
            room = np.minimum(room, np.abs(own - own[k]) - 0.5 * each)


def _dense(curve: Sequence[complex], step: float) -> list[complex]:
    """Return places along a curve, equally far apart, three at least."""
    reach = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(curve)))))
    at = np.linspace(0.0, reach[-1], max(3, int(reach[-1] / step)))
    places: list[complex] = (np.interp(at, reach, np.real(curve)) + 1j * np.interp(at, reach, np.imag(curve))).tolist()
    return places
