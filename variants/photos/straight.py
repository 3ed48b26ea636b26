"""A photographed page laid flat: the map from millimetres of the sheet to pixels, fitted to the corners of its markers.

Paper bends, a camera is tilted, a lens is curved: millimetres -> bend of the paper (quadratic) -> homography -> one
radial term. Corners that lie badly count less and less (robust least squares, Gauss and Newton's steps). Measured on
synthetic sheets in `tests/photos/`; without the bend the error is three times as large.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.markers import SIDE, Place
from ...drawing.text import Box

PER_MM = 10  # pixels of a straightened page
ASTRAY = 0.3  # mm that corners of markers may lie beside where the map has them, root of the mean square
BENDS = 6  # coefficients of the bend, after the eight of the homography, before the radial one
STIFF = 0.003  # parts of the page's half diagonal that a bend shifts corners by, about
ENOUGH = 6  # markers of which one may lie badly
STEPS, STEP = 25, 1e-6
FIXED = 1e6  # px a unit, of what stays as it was
HUBER = 2.0  # of the middle error: from where a corner counts less
PITCH, ASIDE, WIDE = 6.0, 2.5, 6  # mm along the frame between looks at it, and beside it; tenths of its half width
CONTRAST = 0.2  # darkness of the frame at the least
GRID = 8  # pixels between places of which the map is reckoned; between them it is straight
BAND = 256  # rows of a page that are laid flat at a time
Complex = NDArray[np.complex128]


@dataclass(frozen=True, slots=True, eq=False)
class Straight:
    """A map from the sheet to a picture; `error` is how far corners miss it, mm, root of the mean square.

    A `size` that is complex turns the sheet.
    """

    values: NDArray[np.float64]
    middle: complex
    size: complex
    centre: complex
    error: float

    def at(self, places: NDArray[Any]) -> Complex:
        """Return where places of the sheet, mm, y up, are on the picture, pixels, y down."""
        return self.centre + _seen(self.values, (places - self.middle) / self.size)


def _seen(values: NDArray[np.float64], z: Complex) -> Complex:
    """Return where places are seen, from the axis of the lens: `values` are homography, bend, radial term, scale."""
    h, b, radial = values[:8], values[8 : 8 + BENDS], values[8 + BENDS]
    x, y = z.real, z.imag
    xx, xy, yy = x * x, x * y, y * y
    x, y = x + b[0] * xx + b[1] * xy + b[2] * yy, y + b[3] * xx + b[4] * xy + b[5] * yy
    below = 1.0 + h[6] * x + h[7] * y
    w = (h[0] * x + h[1] * y + h[2] + 1j * (h[3] * x + h[4] * y + h[5])) / below
    return np.asarray(w * (1.0 + radial * np.abs(w / REACH) ** 2))


REACH = 2000.0  # pixels at which the radial term is what it says


@dataclass(frozen=True, slots=True, eq=False)
class _Edges:
    """Places of straight printed lines: mm of the sheet, where they are seen, pixels, and across which direction."""

    places: Complex
    seen: Complex
    across: Complex


def framed(picture: Any, way: Straight, box: Box) -> _Edges:
    """Look where the printed frame is seen, near to where a map says: it reaches where no markers stand."""
    import cv2

    x0, y0, x1, y1 = box
    xs, ys = np.arange(x0 + PITCH, x1 - PITCH / 2, PITCH), np.arange(y0 + PITCH, y1 - PITCH / 2, PITCH)
    places = np.concatenate((xs + 1j * y0, xs + 1j * y1, x0 + 1j * ys, x1 + 1j * ys))
    normals = np.repeat([1j, 1j, 1.0, 1.0], [len(xs), len(xs), len(ys), len(ys)])
    off = np.arange(-ASIDE, ASIDE + 0.05, 0.1)
    at = way.at(places[:, None] + normals[:, None] * off[None, :])
    light = cv2.remap(picture, at.real.astype(np.float32), at.imag.astype(np.float32), cv2.INTER_LINEAR).astype(float)
    paper = np.percentile(light, 75, axis=1, keepdims=True)
    dark = np.clip(1.0 - light / np.maximum(paper, 1.0), 0.0, 1.0)
    top = dark.argmax(axis=1)[:, None]
    own = np.where(
        np.abs(np.arange(len(off)) - top) <= WIDE, np.maximum(dark - 0.3 * dark.max(axis=1)[:, None], 0.0), 0.0
    )
    good = (dark.max(axis=1) > CONTRAST) & (np.abs(top[:, 0] - len(off) // 2) < len(off) // 2 - WIDE)
    middles = (own * off).sum(axis=1) / np.maximum(own.sum(axis=1), 1e-9)
    z, n = places[good], normals[good]
    return _Edges(z, way.at(z + middles[good] * n), way.at(z + n) - way.at(z))


def straightened(
    markers: Mapping[int, tuple[complex, ...]], places: Sequence[Place], centre: complex, edges: _Edges | None = None
) -> Straight:
    """Fit the map of a page to the corners of its markers on a picture, of which `centre` is the middle of the lens.

    Lines that are printed, too, hold it across them.
    """
    both = [place for place in places if place.number in markers]
    if len(both) < 3:
        return Straight(np.zeros(8 + BENDS + 1), 0j, 1.0, centre, np.inf)
    on_sheet = np.array([z for place in both for z in place.corners])
    on_picture = np.array([z for place in both for z in markers[place.number]]) - centre
    middle, size = complex(on_sheet.mean()), float(np.abs(on_sheet - on_sheet.mean()).max())
    z = (on_sheet - middle) / size
    values = np.concatenate((_homography(z, on_picture), np.zeros(BENDS + 1)))
    sides = np.abs(np.diff(on_picture.reshape(-1, 4), axis=1))
    per = float(np.median(sides)) / SIDE  # pixels a mm
    held = np.concatenate((np.zeros(8), np.full(BENDS, 0.3 / STIFF), [0.3 / 0.05]))  # px
    missed: list[Missed] = [lambda own: _seen(own, z) - on_picture]
    if edges is not None and len(edges.places):
        lines, turn = (edges.places - middle) / size, np.conj(edges.across / np.abs(edges.across))
        missed.append(lambda own: (turn * (_seen(own, lines) + centre - edges.seen)).real)
    values = _fitted(values, missed, held)
    error = float(np.sqrt(np.mean(np.abs(_seen(values, z) - on_picture) ** 2))) / per
    return Straight(values, middle, size, centre, error if np.isfinite(error) else np.inf)


def without_worst(
    markers: Mapping[int, tuple[complex, ...]], places: Sequence[Place], centre: complex
) -> Mapping[int, tuple[complex, ...]]:
    """Return markers of a page without the one that lies worst: what is drawn over it may have moved its corners."""
    both = [place for place in places if place.number in markers]
    if len(both) < ENOUGH:
        return markers
    ways = [{n: z for n, z in markers.items() if n != place.number} for place in both]
    return min(ways, key=lambda way: straightened(way, places, centre).error)


def by_squares(markers: Mapping[int, tuple[complex, ...]], side: float, centre: complex) -> tuple[Straight, Complex]:
    """Fit the map of a sheet to markers that are stuck on it anywhere, squares of a side, mm, by their shapes alone.

    Return it, and the corners of each on the sheet, mm, of shape (N, 4): as the picture shows it, the origin amid it.
    """
    corners = np.array([*markers.values()]) - centre
    per = float(np.mean(np.abs(np.diff(corners, axis=1)))) / side
    laid = np.asarray(np.conj(corners) / per, np.complex128)
    middles = laid.mean(axis=1)
    square = side / 2.0 * np.array([-1.0 + 1.0j, 1.0 + 1.0j, 1.0 - 1.0j, -1.0 - 1.0j])
    turns = np.angle((np.conj(square) * (laid - middles[:, None])).sum(axis=1))
    size = float(np.abs(laid - laid.mean()).max())
    count = len(corners)

    def stuck(own: NDArray[np.float64]) -> Complex:
        x, y, turn = own[8:-1].reshape(3, count)
        return np.asarray(size * (x + 1j * y)[:, None] + square * np.exp(1j * turn)[:, None])

    def seen(own: NDArray[np.float64]) -> Complex:
        values = np.concatenate((own[:8], np.zeros(BENDS), own[-1:]))
        return _seen(values, stuck(own).ravel() / size) - corners.ravel()

    begun = _homography(laid.ravel() / size, corners.ravel())
    places = np.concatenate((middles.real / size, middles.imag / size, turns))
    first = np.tile(np.arange(count) == 0, 3)  # the sheet lies as this marker does: all might be moved together
    held = np.concatenate((np.zeros(8), np.where(first, FIXED, 0.0), [0.3 / 0.05]))
    own = _fitted(np.concatenate((begun, places, [0.0])), [seen], held)
    error = float(np.sqrt(np.mean(np.abs(seen(own)) ** 2))) / per
    values = np.concatenate((own[:8], np.zeros(BENDS), own[-1:]))
    return Straight(values, 0j, size, centre, error if np.isfinite(error) else np.inf), stuck(own)


Missed = Callable[[NDArray[np.float64]], NDArray[Any]]  # how far places are missed, px, as vectors or across lines


def _fitted(values: NDArray[np.float64], missed: Sequence[Missed], held: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return values with which places are missed least, the worst counting less; `held` keeps some as they are."""
    scales, start = np.maximum(np.abs(values), 1e-3), values
    scales[:6] = np.maximum(scales[:6], 1.0)
    for _ in range(STEPS):
        rows, right = [np.diag(held * scales)], [held * (values - start)]
        for one in missed:
            miss = one(values)
            slope = np.stack([(one(values + STEP * scales * unit) - miss) / STEP for unit in np.eye(len(values))], 1)
            off = np.abs(miss)
            bound = HUBER * max(float(np.median(off)), 0.02)
            weight = np.sqrt(np.minimum(1.0, bound / np.maximum(off, 1e-12)))
            for part in (np.real, np.imag) if np.iscomplexobj(miss) else (np.real,):
                rows.append(part(slope) * weight[:, None])
                right.append(part(miss) * weight)
        change = np.linalg.lstsq(np.concatenate(rows), np.concatenate(right), rcond=None)[0] * scales
        values = values - change
        if np.abs(change / scales).max() < 1e-9:
            break
    return values


def _homography(z: Complex, w: Complex) -> NDArray[np.float64]:
    """Return the eight numbers of the homography that takes `z` to `w`, about."""
    one, zero, x, y = np.ones(len(z)), np.zeros(len(z)), z.real, z.imag
    size = float(np.abs(w).max())
    u, v = w.real / size, w.imag / size
    rows = np.concatenate((
        np.stack((x, y, one, zero, zero, zero, -u * x, -u * y), 1),
        np.stack((zero, zero, zero, x, y, one, -v * x, -v * y), 1),
    ))  # fmt: skip
    found = np.linalg.lstsq(rows, np.concatenate((u, v)), rcond=None)[0]
    return np.asarray(found * np.array([size] * 6 + [1.0] * 2))


def flat(picture: Any, way: Straight, width: float, height: float, beyond: int | None = None) -> NDArray[np.uint8]:
    """Return a grey picture of a page of `width` x `height` mm as if it had been scanned, `PER_MM` pixels per mm.

    What lies `beyond` the picture is as dark as its edge, if nothing else is said.
    """
    import cv2

    columns, rows = round(width * PER_MM), round(height * PER_MM)
    gx, gy = np.meshgrid(np.arange(0, columns + GRID, GRID), np.arange(0, rows + GRID, GRID))
    at = way.at(((gx + 0.5) + 1j * (rows - gy - 0.5)) / PER_MM)
    sides = [side.astype(np.float32) for side in (at.real, at.imag)]
    edge = cv2.BORDER_REPLICATE if beyond is None else cv2.BORDER_CONSTANT
    seen = np.empty((rows, columns), np.uint8)
    for top in range(0, rows, BAND):
        own = seen[top : top + BAND]
        down = (top + np.arange(len(own), dtype=np.float32)) / GRID
        x, y = np.meshgrid(np.arange(columns, dtype=np.float32) / GRID, down)
        across, below = (cv2.remap(side, x, y, cv2.INTER_LINEAR) for side in sides)
        own[:] = cv2.remap(picture, across, below, cv2.INTER_CUBIC, borderMode=edge, borderValue=beyond or 0)
    return seen
