"""A photographed page laid flat: the map from millimetres of the sheet to pixels, fitted to the corners of its markers.

Paper bends, a camera is tilted, a lens is curved: millimetres -> bend of the paper (quadratic) -> homography -> one
radial term. Corners that lie badly count less and less (robust least squares, Gauss and Newton's steps). Measured on
synthetic sheets in `tests/photos/`; without the bend the error is three times as large.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.markers import SIDE, Place
from ...drawing.text import Box

PER_MM = 10  # pixels of a straightened page
BENDS = 6  # coefficients of the bend, after the eight of the homography, before the radial one
STIFF = 0.003  # parts of the page's half diagonal that a bend shifts corners by, about
STEPS, STEP = 25, 1e-6
HUBER = 2.0  # of the middle error: from where a corner counts less
PITCH, ASIDE, WIDE = 6.0, 2.5, 6  # mm along the frame between looks at it, and beside it; tenths of its half width
CONTRAST = 0.2  # darkness of the frame at the least
GRID = 8  # pixels between places of which the map is reckoned; between them it is straight
Complex = NDArray[np.complex128]


@dataclass(frozen=True, slots=True, eq=False)
class Straight:
    """A map from the sheet to a picture; `error` is how far corners miss it, mm, root of the mean square."""

    values: NDArray[np.float64]
    middle: complex
    size: float
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
class Edges:
    """Places of straight printed lines: mm of the sheet, where they are seen, pixels, and across which direction."""

    places: Complex
    seen: Complex
    across: Complex


def framed(picture: Any, way: Straight, box: Box) -> Edges:
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
    return Edges(z, way.at(z + middles[good] * n), way.at(z + n) - way.at(z))


def straightened(
    markers: Mapping[int, tuple[complex, ...]], places: Sequence[Place], centre: complex, edges: Edges | None = None
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
    stiff = np.concatenate((np.zeros(8), np.full(BENDS, 0.3 / STIFF), [0.3 / 0.05]))  # px
    scales = np.maximum(np.abs(values), np.array([1.0] * 6 + [1e-3] * 2 + [1e-3] * (BENDS + 1)))
    lines = np.zeros(0, complex) if edges is None else (edges.places - middle) / size
    for _ in range(STEPS):
        miss = _seen(values, z) - on_picture
        slope, weight = _slope(values, z, scales), _weight(np.abs(miss))
        own = [
            ((slope * weight[:, None]).real, (miss * weight).real),
            ((slope * weight[:, None]).imag, (miss * weight).imag),
        ]
        if edges is not None and len(lines):
            turn = np.conj(edges.across / np.abs(edges.across))
            aside = (turn * (_seen(values, lines) + centre - edges.seen)).real
            weight = _weight(np.abs(aside))
            own += [((turn[:, None] * _slope(values, lines, scales)).real * weight[:, None], aside * weight)]
        rows = np.concatenate((*(one for one, _ in own), np.diag(stiff * scales)))
        right = np.concatenate((*(one for _, one in own), stiff * values))
        change = np.linalg.lstsq(rows, right, rcond=None)[0] * scales
        values = values - change
        if np.abs(change / scales).max() < 1e-9:
            break
    error = float(np.sqrt(np.mean(np.abs(_seen(values, z) - on_picture) ** 2))) / per
    return Straight(values, middle, size, centre, error if np.isfinite(error) else np.inf)


def _slope(values: NDArray[np.float64], z: Complex, scales: NDArray[np.float64]) -> Complex:
    """Return how places move as each number of a map grows by its scale."""
    seen = _seen(values, z)
    return np.stack([(_seen(values + STEP * scales * unit, z) - seen) / STEP for unit in np.eye(len(values))], 1)


def _weight(off: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the weights of what is so far off: far ones count less."""
    bound = HUBER * max(float(np.median(off)), 0.02)
    return np.asarray(np.sqrt(np.minimum(1.0, bound / np.maximum(off, 1e-12))))


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


def flat(picture: Any, way: Straight, width: float, height: float) -> NDArray[np.uint8]:
    """Return a grey picture of a page of `width` x `height` mm as if it had been scanned, `PER_MM` pixels per mm."""
    import cv2

    columns, rows = round(width * PER_MM), round(height * PER_MM)
    gx, gy = np.meshgrid(np.arange(0, columns + GRID, GRID), np.arange(0, rows + GRID, GRID))
    at = way.at(((gx + 0.5) + 1j * (rows - gy - 0.5)) / PER_MM)
    x, y = np.meshgrid(np.arange(columns, dtype=np.float32) / GRID, np.arange(rows, dtype=np.float32) / GRID)
    across, down = (cv2.remap(side.astype(np.float32), x, y, cv2.INTER_LINEAR) for side in (at.real, at.imag))
    return np.asarray(cv2.remap(picture, across, down, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE), np.uint8)
