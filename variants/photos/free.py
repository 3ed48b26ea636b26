"""A student's own sheet photographed: laid flat by markers that are stuck on it, its poles and scale factors found.

Nothing is printed there that tells where plans are. They are found as on a drawing of lines (`plans/marking/drawn.py`),
right ones first; from then on their poles and scale factors are known as those of a handout are.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ...drawing.areas import lines, pairs
from ...drawing.markers import STUCK
from ...plans.marking.drawn import FoundPlan, recognise
from ...plans.marking.lines import Drawn
from ...plans.marking.ways import Shape, shapes_of
from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from ..marking.keyed import Keyed
from .pictures import Photo, grey_of
from .straight import ASTRAY, PER_MM, Straight, by_squares, flat
from .strokes import Ink, Stroke, strokes

ROUND = 40.0  # mm of the sheet around its markers that is looked at
LARGEST = 620.0, 460.0  # mm of that: A3 with markers near its edges
COARSE, TABLE = 10, 0.7  # pixels of paper that is looked at as one; of its brightness, what is darker than paper
CROWDED, MARGIN = 5, 15  # of these a side that no pencil fills, where many arrowheads meet, too; that are left out
WHITE = 2.0  # mm round a marker that its paper may be seen
SURE = 0.6  # part of a plan that tells where its pole is
COMMON = 2  # forces of a plan that lie on another one, too, which make the two look alike
LETTER = 4.0  # mm of a line that may be a vector
LINE, SHORT = 8.0, 0.1  # mm of a line, part of the longest vector of a plan, that tell how the sheet is turned
STEP, WIDTH = math.radians(0.2), 3  # between turns that are tried; steps within which a line has its direction
LIKELY, NEAR = 0.9, math.radians(2.0)  # part of the best turn that another may have; between a turn and a better one
LEVEL = math.radians(0.5)  # of a turn that does no harm
QUARTER = math.pi / 2.0

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class _Free:
    """A sheet laid flat: its picture, what no pencil has drawn there, its pencil, and the lines that are found."""

    picture: NDArray[np.uint8]
    ink: Ink
    lines: Sequence[Stroke]
    error: float


def laid_flat(photo: Photo, ways: Floats) -> _Free:
    """Lay a sheet flat, turned so that most lines go as vectors should: `ways` are their directions, radians.

    Raises
    ------
    InputError
        Its markers are no squares, or it is too large to be read.
    """
    way, corners = by_squares(photo.markers, STUCK, photo.centre)
    shown = quote(photo.source, SHOWN)
    if way.error > ASTRAY:
        raise InputError("photo-astray", file=shown, side=round(STUCK))
    grey = grey_of(photo)
    picture, hidden = _laid(grey, way, corners, shown)
    ink = Ink(picture, hidden)
    askew = _askew(*ink.segments(), ways)
    if abs(askew) > LEVEL:
        by = cmath.rect(1.0, askew)  # the sheet is turned back
        picture, hidden = _laid(grey, replace(way, size=way.size / by), corners / by, shown)
        ink = Ink(picture, hidden)
    return _Free(picture, ink, strokes(ink), way.error)


def _laid(grey: Any, way: Straight, corners: Complex, shown: str) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """Return a sheet laid flat as far as it is looked at, and where nothing is drawn by pencil."""
    low = complex(corners.real.min(), corners.imag.min()) - ROUND * (1 + 1j)
    size = complex(corners.real.max(), corners.imag.max()) + ROUND * (1 + 1j) - low
    if max(size.real, size.imag) > LARGEST[0] or min(size.real, size.imag) > LARGEST[1]:
        raise InputError("photo-far", file=shown)
    moved = replace(way, middle=way.middle - low)
    picture = flat(grey, moved, size.real, size.imag)
    # beyond the picture there is nothing, and a marker is no pencil
    hidden = flat(np.full_like(grey, 255), moved, size.real, size.imag, 0) < 250
    hidden |= _beside(picture)
    rows = len(picture)
    for four in corners - low:
        x0, x1 = (round(edge * PER_MM) for edge in (four.real.min() - WHITE, four.real.max() + WHITE))
        y0, y1 = (rows - round(edge * PER_MM) for edge in (four.imag.max() + WHITE, four.imag.min() - WHITE))
        hidden[max(y0, 0) : y1, max(x0, 0) : x1] = True
    return picture, hidden


def _beside(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Return where a table is seen instead of paper."""
    import cv2

    rows, columns = picture.shape
    coarse = cv2.resize(picture, (-(-columns // COARSE), -(-rows // COARSE)), interpolation=cv2.INTER_AREA)
    light = cv2.dilate(coarse, np.ones((CROWDED, CROWDED), np.uint8))
    dark = (light < TABLE * np.median(light)).astype(np.uint8)
    dark = cv2.dilate(dark, np.ones((MARGIN, MARGIN), np.uint8))
    return np.asarray(cv2.resize(dark, (columns, rows), interpolation=cv2.INTER_NEAREST) > 0)


def _askew(tails: Complex, tips: Complex, ways: Floats) -> float:
    """Return by how much a sheet is turned, -π/2 to π/2, for most mm of its lines to go in directions of `ways`."""
    spans = (tips - tails)[np.abs(tips - tails) > LINE]
    if not len(spans) or not len(ways):
        return 0.0
    turns = np.arange(-QUARTER, QUARTER, STEP)
    off = np.angle(spans)[:, None] - ways[None, :]
    bins = np.zeros(len(turns))
    places = np.round(((off + QUARTER) % math.pi) / STEP).astype(int) % len(turns)
    for own, size in zip(places, np.abs(spans).tolist(), strict=True):
        near = np.unique((own[:, None] + np.arange(-WIDTH, WIDTH + 1)) % len(turns))
        bins[near] += size
    likely = min(turns[bins >= LIKELY * bins.max()], key=abs)  # what is turned less, of what is as good
    near = np.abs(turns - likely) <= NEAR
    best = near & (bins >= bins[near].max())
    return float(min(turns[best], key=abs))


def ways_of(keyed: Keyed) -> Floats:
    """Return the directions of the vectors of all plans, as they should be."""
    shapes = (shapes_of(keyed.key, None, plan) for plan in keyed.key.paper.program.plans if plan in keyed.key.paper.mus)
    spans = [shape.spans[np.abs(shape.spans) > SHORT * shape.longest] for some in shapes for shape in some[:1]]
    return np.asarray(np.angle(np.concatenate(spans or [np.zeros(0, complex)])))


def turned(sheet: _Free, quarters: int) -> _Free:
    """Return a sheet turned against the clock, so many quarters of a turn."""
    picture = np.ascontiguousarray(np.rot90(sheet.picture, quarters))
    hidden = np.ascontiguousarray(np.rot90(sheet.ink.printed > 0, quarters))
    ink = Ink(picture, hidden)
    return _Free(picture, ink, strokes(ink), sheet.error)


def plans_on(sheets: Sequence[_Free], keyed: Keyed, apart: float) -> dict[str, FoundPlan]:
    """Return where plans are found on sheets, `apart` from one another: right ones, else those with a mistake."""
    ends = np.array([(line.tail + by, line.tip + by) for by, line in _lines(sheets, apart)], complex).reshape(-1, 2)
    drawn = Drawn(ends[:, 0], ends[:, 1], by_hand=True)
    right = {plan: shape[0] for plan in keyed.key.paper.mus if (shape := shapes_of(keyed.key, None, plan))}
    found = {plan: one for plan, one in recognise(drawn, keyed.key, None, {}).plans.items() if one.quality >= SURE}
    if len(found) < len(right):
        every = recognise(drawn, keyed.key, keyed.book, {plan: one.mu for plan, one in found.items()}).plans
        found = {**{plan: one for plan, one in every.items() if one.quality >= SURE}, **found}
    return {plan: one for plan, one in found.items() if not one.alone and not _within(plan, found, right)}


def _within(plan: str, found: Mapping[str, FoundPlan], right: Mapping[str, Shape]) -> bool:
    """Whether what is found may be a part of another plan: all but one of its forces lie there, too, on its lines."""

    def laid(name: str) -> Complex:
        at, shape = found[name], right[name]
        return at.pole + shape.places * cmath.rect(1.0 / at.mu, at.turn)

    own = set(right[plan].names)
    for other in right.keys() - {plan}:
        common, shape = own & set(right[other].names), right[other]
        if len(common) < max(COMMON, len(own) - 1):
            continue
        if other not in found:
            return True
        places = laid(other)
        whole = shapely.union_all(lines(places[shape.tails], places[shape.tips]))
        if shapely.distance(shapely.points(pairs(laid(plan))), whole).max() <= LETTER:
            return True
    return False


def _lines(sheets: Sequence[_Free], apart: float) -> Iterator[tuple[float, Stroke]]:
    for number, sheet in enumerate(sheets, start=1):
        yield from ((number * apart, line) for line in sheet.lines if line.size >= LETTER)


def quarters_of(plans: Sequence[FoundPlan]) -> int:
    """Return by how many quarters of a turn a sheet must be turned for most of its plans to stand as they should."""
    turns = [round(plan.turn / QUARTER) % 4 for plan in plans]
    return -max(turns, key=turns.count) % 4 if turns else 0
