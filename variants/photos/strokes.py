"""Pencil lines on a straightened page: found, put on the middle of what is dark, ended where that ends.

Darkness is measured against the paper around; what is printed is left out. Segments (LSD) say where lines may be; a
line is then fitted to the middles of the dark profiles across it, those that lie badly counting less. It reaches as far
as it is dark, over gaps where print lies or the pencil failed; ends are moved to where lines cross, as points of a plan
are crossings of lines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...plans.laws import cross, dot
from .straight import PER_MM

PAPER = 4.0  # mm, wider than any stroke: what is dark on this width is paper
COARSE = 4  # times smaller, where the paper is looked for
DARKEST, STEEP = 254, 420  # of a page that is kept as bytes: what 1 becomes, and where edges are looked for
GROWN = 0.45  # mm by which print is grown before it is left out
FAINT = 0.06  # darkness below which nothing is a line
SEEN = 0.4  # of how dark a line is in the middle, what still is a part of it
ASIDE = 0.5  # mm beside a line in which its profile is looked at
PITCH, ACROSS = 0.2, 0.1  # mm between profiles, and across them
SMALL = 1.2  # mm of a segment that may tell of a line
EDGE, TELLING = 0.3, 2.0  # mm that pieces of one edge of a line lie beside one another; of an edge that tells of a line
WING, LEAN = 1.6, (math.sin(math.radians(7.0)), math.sin(math.radians(40.0)))  # of an arrow: mm, sines against its line
LEAST = 4.0  # mm of a line: less is a letter, if not the wing of an arrow
GAP = 3.0  # mm of a gap in a line
FULL = 0.6  # part of a line that must be dark
TURN = math.radians(3.0)  # by which segments of one line differ
SAME, LIKE = 0.35, math.radians(1.2)  # mm and angle within which two lines are one
BESIDE, HIDDEN = 0.6, 2.5  # mm that a line may miss its pole by, and that print may hide of it there
REACH = 1.3  # mm from its end to a crossing where the line ends instead
SHARP = math.sin(math.radians(7.0))  # of an angle at which a crossing says where an end is
LINE, END = 0.1, 0.15  # mm, errors of a line and of where it ends
HUBER = 0.08  # mm off the line from which a profile counts less
MOST = 600  # lines of a page

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


class Stroke(NamedTuple):
    """A line as it was drawn: its ends, mm of the page, y up; how far its profiles miss it, mm; how dark it is."""

    tail: complex
    tip: complex
    error: float
    dark: float

    @property
    def size(self) -> float:
        """Its length, mm."""
        return abs(self.tip - self.tail)

    @property
    def unit(self) -> complex:
        """Its direction."""
        return (self.tip - self.tail) / self.size


class Ink:
    """How dark a straightened page is against its paper, `DARKEST` at the most; what is printed is left out."""

    def __init__(self, page: NDArray[np.uint8], printed: NDArray[np.bool_]) -> None:
        """Measure a page, `PER_MM` pixels per mm; `printed` is what is left out of it, as large."""
        import cv2

        rows, columns = page.shape
        small = cv2.resize(page, (columns // COARSE, rows // COARSE), interpolation=cv2.INTER_AREA)
        wide = round(PAPER * PER_MM / COARSE) | 1
        paper = cv2.morphologyEx(small, cv2.MORPH_CLOSE, np.ones((wide, wide), np.uint8))
        paper = cv2.GaussianBlur(paper, (0, 0), wide / 2)
        paper = cv2.resize(paper, (columns, rows), interpolation=cv2.INTER_LINEAR).astype(np.float32)
        dark = np.divide(page, np.maximum(paper, 1.0, out=paper), out=paper)  # a page fills many megabytes
        np.maximum(np.subtract(1.0, dark, out=dark), 0.0, out=dark)
        dark -= np.float32(np.median(dark[::8, ::8]))
        grown = round(2 * GROWN * PER_MM) | 1
        hidden = np.where(printed, DARKEST, 0).astype(np.uint8)
        self.printed = np.asarray(cv2.dilate(hidden, np.ones((grown, grown), np.uint8)), np.uint8)
        np.clip(dark, 0.0, 1.0, out=dark)
        dark[self.printed > 0] = 0.0
        soft = np.asarray(cv2.GaussianBlur(dark, (0, 0), 1.0), np.float32)
        self.dark, self.soft, self.edges = (_bytes(dark, DARKEST), _bytes(soft, DARKEST), _bytes(soft, STEEP))
        self.height = rows / PER_MM

    def sampled(self, layer: NDArray[np.uint8], places: NDArray[Any]) -> Floats:
        """Return a layer, where `DARKEST` is 1, at places of the page, mm."""
        import cv2

        x = (places.real * PER_MM - 0.5).astype(np.float32)
        y = ((self.height - places.imag) * PER_MM - 0.5).astype(np.float32)
        found = cv2.remap(layer, x, y, cv2.INTER_LINEAR, borderValue=0)
        return np.asarray(found, float).reshape(places.shape) / DARKEST

    def segments(self) -> tuple[Complex, Complex]:
        """Return where edges of lines may be, mm: both ends of each."""
        import cv2

        found = cv2.createLineSegmentDetector(cv2.LSD_REFINE_STD, scale=0.6).detect(self.edges)[0]
        if found is None:
            return np.zeros(0, complex), np.zeros(0, complex)
        x0, y0, x1, y1 = ((found.reshape(-1, 4).T + 0.5) / PER_MM).astype(float)
        ends = x0 + 1j * (self.height - y0), x1 + 1j * (self.height - y1)
        long = np.abs(ends[1] - ends[0]) >= SMALL
        return ends[0][long], ends[1][long]


def _bytes(layer: NDArray[np.float32], times: int) -> NDArray[np.uint8]:
    """Return a layer of a page in a quarter of its memory."""
    return np.asarray(np.minimum(layer * np.float32(times), np.float32(255.0)), np.uint8)


def strokes(ink: Ink, poles: Sequence[complex] = ()) -> list[Stroke]:
    """Return the straight lines on a page, longer than letters; those that go to printed `poles` begin there."""
    tails, tips = ink.segments()
    found: list[Stroke] = []
    sizes = np.abs(tips - tails)
    left = np.ones(len(tails), bool)
    for first in np.argsort(-sizes).tolist():
        if not left[first] or len(found) >= MOST:
            continue
        group = _beside(tails, tips, first) & left
        left[group] = False
        ends = np.concatenate((tails[group], tips[group]))
        if sizes[group].sum() < TELLING:
            continue
        unit = (tips[first] - tails[first]) / sizes[first]
        along = dot(unit, ends - tails[first])
        for start, stop in _together(along.reshape(2, -1)):
            found += _drawn(ink, tails[first] + start * unit, tails[first] + stop * unit)
    lines = _single([one for one in found if one.size >= LEAST])
    return [*_joined(lines, np.array(poles, complex)), *_wings(found, lines)]


def _beside(tails: Complex, tips: Complex, first: int) -> NDArray[np.bool_]:
    """Return which segments lie along the line of the first one."""
    span = tips[first] - tails[first]
    unit = span / abs(span)
    ways = (tips - tails) / np.abs(tips - tails)
    aside = np.maximum(np.abs(cross(unit, tails - tails[first])), np.abs(cross(unit, tips - tails[first])))
    return np.asarray(
        (np.abs(cross(unit, ways)) < np.maximum(math.sin(TURN), 0.3 / np.abs(tips - tails))) & (aside < ASIDE)
    )


def _together(along: Floats) -> list[tuple[float, float]]:
    """Return the spans of segments along a line, from nearest to farthest end, as far as they hang together."""
    spans = sorted(zip(along.min(axis=0).tolist(), along.max(axis=0).tolist(), strict=True))
    found = [spans[0]]
    for low, high in spans[1:]:
        if low - found[-1][1] <= 3 * GAP:
            found[-1] = found[-1][0], max(found[-1][1], high)
        else:
            found.append((low, high))
    return found


def _drawn(ink: Ink, start: complex, stop: complex) -> list[Stroke]:
    """Return the lines that are drawn along a way, on the middle of what is dark."""
    error = dark = 0.0
    for _ in range(3):
        size = abs(stop - start)
        if size < SMALL:
            return []
        unit = (stop - start) / size
        along = np.arange(0.0, size + PITCH / 2, PITCH)
        across = np.arange(-ASIDE, ASIDE + ACROSS / 2, ACROSS)
        profile = ink.sampled(ink.dark, start + along[:, None] * unit + 1j * unit * across[None, :])
        weight = profile.sum(axis=1)
        top = profile.max(axis=1)
        dark = float(np.median(top[top > FAINT])) if (top > FAINT).any() else 0.0
        good = top > max(FAINT, SEEN * dark)
        if good.sum() < 4:
            return []
        middles = (profile * across).sum(axis=1)[good] / weight[good]
        base, slope, error = _fitted(along[good], middles, np.minimum(top[good], dark))
        start, stop = (
            start + at * unit + 1j * unit * (base + slope * at)
            for at in (float(along[good][0]), float(along[good][-1]))
        )
    return [Stroke(a, b, error, own) for a, b, own in _covered(ink, start, stop, dark) if abs(b - a) >= WING]


def _fitted(along: Floats, middles: Floats, weight: Floats) -> tuple[float, float, float]:
    """Return offset and slope of the line through middles, far ones counting less, and how far they miss it."""
    base, slope, off = float(np.median(middles)), 0.0, np.zeros(len(along))
    off = middles - base
    for _ in range(6):
        own = weight * np.minimum(1.0, HUBER / np.maximum(np.abs(off), 1e-9))
        whole = own.sum()
        at, mid = (own * along).sum() / whole, (own * middles).sum() / whole
        spread = (own * (along - at) ** 2).sum()
        slope = float((own * (along - at) * (middles - mid)).sum() / spread) if spread else 0.0
        base = float(mid - slope * at)
        off = middles - base - slope * along
    return base, slope, float(np.median(np.abs(off)) * 1.48)


def middles_of(along: Floats, across: Floats, profiles: Floats, dark: float) -> tuple[float, float]:
    """Return offset and slope of the line through the middles of profiles across it, of shape (along, across)."""
    middles = (profiles * across).sum(axis=1) / np.maximum(profiles.sum(axis=1), 1e-9)
    return _fitted(along, middles, np.minimum(profiles.max(axis=1), dark))[:2]


def _covered(ink: Ink, start: complex, stop: complex, dark: float) -> list[tuple[complex, complex, float]]:
    """Return where a line is dark: from end to end of each run, and how dark it is; print may hide it."""
    size = abs(stop - start)
    unit = (stop - start) / size
    along = np.arange(-2 * GAP, size + 2 * GAP, 1.0 / PER_MM)
    places = start + along * unit
    near = np.max([ink.sampled(ink.soft, places + 1j * unit * off) for off in (-0.12, 0.0, 0.12)], axis=0)
    hidden = ink.sampled(ink.printed, places) > 0.5
    on = near > max(FAINT, SEEN * dark)
    found: list[tuple[complex, complex, float]] = []
    at = np.flatnonzero(on)
    if not len(at):
        return found
    clear = np.concatenate(([0], np.cumsum(~hidden))) / PER_MM  # mm that are not hidden up to each place
    gaps = clear[at[1:]] - clear[at[:-1] + 1]
    for run in np.split(at, np.flatnonzero(gaps > GAP) + 1):
        inside = slice(run[0], run[-1] + 1)
        open_part = ~hidden[inside]
        full = on[inside].sum() / max(int(open_part.sum()), 1)
        if full >= FULL:
            own = float(np.median(near[inside][on[inside]]))
            found.append((complex(places[run[0]]), complex(places[run[-1]]), own))
    return found


def _single(found: list[Stroke]) -> list[Stroke]:
    """Return lines without those that are parts of others, the longest first."""
    kept: list[Stroke] = []
    for one in sorted(found, key=lambda stroke: -abs(stroke.tip - stroke.tail)):
        for other in kept:
            span = other.tip - other.tail
            unit = span / abs(span)
            aside = max(abs(cross(unit, end - other.tail)) for end in (one.tail, one.tip))
            ends = sorted(float(dot(unit, end - other.tail)) for end in (one.tail, one.tip))
            if aside < SAME and ends[0] > -1.0 and ends[1] < abs(span) + 1.0:
                break
        else:
            kept.append(one)
    return kept


def _joined(found: list[Stroke], poles: Complex) -> list[Stroke]:
    """Return lines whose ends are moved to the crossings with other lines that are near, or beside the pole."""
    if not found:
        return found
    tails, tips = (np.array([one[side] for one in found]) for side in (0, 1))
    sizes = np.abs(tips - tails)
    units = (tips - tails) / sizes
    moved: list[Stroke] = []
    for number, one in enumerate(found):
        sine = cross(units[number], units)
        with np.errstate(divide="ignore", invalid="ignore"):
            own = cross(tails - one.tail, units) / sine  # along this line to each crossing
            other = cross(tails - one.tail, units[number]) / sine  # along the other one
        fits = (np.abs(sine) > SHARP) & (other > -REACH) & (other < sizes + REACH) & np.isfinite(own)
        ends = list[complex]()
        at_pole = dot(units[number], poles - one.tail)[np.abs(cross(units[number], poles - one.tail)) < BESIDE]
        for end in (0.0, float(sizes[number])):
            of_pole, own_weight = at_pole[np.abs(at_pole - end) < HIDDEN], END**-2
            if len(of_pole):  # print hides where lines cross
                end, own_weight = float(of_pole[0]), 0.5 * END**-2
            near = fits & (np.abs(own - end) < REACH)
            weight = np.append((sine[near] / LINE) ** 2, own_weight)
            ends.append(
                one.tail + complex(units[number]) * float(np.average(np.append(own[near], end), weights=weight))
            )
        moved.append(Stroke(ends[0], ends[1], one.error, one.dark))
    return moved


def _wings(found: list[Stroke], lines: list[Stroke]) -> list[Stroke]:
    """Return the wings of arrows, from where they meet their lines: these show where a vector ends on a longer line."""
    wings: list[Stroke] = []
    for one in found:
        if one.size >= LEAST:
            continue
        for line in lines:
            sine = float(cross(line.unit, one.unit))
            if LEAN[0] < abs(sine) < LEAN[1]:
                at = float(cross(line.tail - one.tail, line.unit)) / -sine  # along the wing to its line
                apex = one.tail + at * one.unit
                end = min((one.tail, one.tip), key=lambda z: abs(z - apex))
                if abs(end - apex) < REACH and -REACH < float(dot(line.unit, apex - line.tail)) < line.size + REACH:
                    wings.append(Stroke(apex, one.tip if end == one.tail else one.tail, one.error, one.dark))
    return wings
