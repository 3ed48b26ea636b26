"""Points of a plan measured along where its lines should be: the pencil says where each is, not what is expected.

A line is looked for in the strip around its place: the way from side to side along which the pencil is darkest, put
on the middle of what is dark. Where it ends its darkness falls, or an arrowhead has its point. A point of the plan is
where its lines cross, weighed against ends and arrowheads: these alone tell where lines go on in one direction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...plans.laws import cross, dot
from ...plans.marking.ways import Shape as Way
from .straight import PER_MM
from .strokes import LINE, middles_of

HIDES = 255  # in what is dark: print hides what is there
PASSES = ((1.5, 0.25), (0.6, 0.1))  # mm aside in which a line is sought, and steps there, first and then
SHORTEST = 2.5  # mm of a vector whose line is sought
ALONG, ACROSS = 0.25, 0.1  # mm between places along a line, and across it
MOST = 160  # places along a line that is sought
FAINT = 0.05  # darkness of a line at the least
THERE = 0.75  # part of a line that must be dark
FULL, STRAY = 0.7, 0.3  # of the darkest, from where a line is as good; what it loses as far aside as it may be
FALL, ROUND = 0.5, 0.25  # part of its darkness at which a line ends; mm that its end is rounded, half its width
REACH, CLEAR = 3.0, 0.8  # mm beside where a line should end, that it may; that must be clear beyond
WINGS = tuple(math.radians(degrees) for degrees in (10.0, 13.0, 16.0, 20.0, 25.0))  # of arrowheads, half
WING, APART = 3.2, 0.55  # mm of a wing at the most; mm from its line where it is told from that
NIB, FLANK = 0.4, 0.4  # mm behind an arrowhead's point from where its wings are seen; mm beside them where paper is
FORTH, BY = np.arange(-1.2, 1.21, 0.1), np.arange(-0.2, 0.21, 0.1)  # mm that the point is sought along and across
TURNS = np.radians([-4.0, -2.0, 0.0, 2.0, 4.0])
BAND, WIDE, NARROW = np.arange(0.35, 0.76, 0.1), 0.2, 0.1  # mm beside a line that is wider; how dark that is, or is not
WIDER, BLUNT, LEVEL = 0.8, 0.55, 0.15  # mm along which it is; from there to the point; sine of lines that go on
ALONE = 1.5  # mm of a line before its end beside which nothing is, if that is no letter
ASIDE = 0.15  # mm, half the width of a line
ASTRAY = 0.1  # what each mm counts that wings are from where they should be, of how dark they are
TOPS = 0.6  # mm around within which a place of wings is the best one
CONTRAST, TOP = 0.5, 0.15  # of wings against the paper beside them, at the least; within which places are as good
ARROWED, WINGED = 9.0, 6.0  # mm of a vector whose arrowhead can be told from its line; whose wings can be found
POINTED, BARE = 0.55, 0.3  # parts of how dark their line is that wings must be, and where none is seen at the most
CLEARLY = 0.85  # the same of wings that must not be other lines
DOUBTED = 0.2  # part by which wings at the wrong end are darker from which they make the sense doubtful
TOUCHED, BESIDE, FEWEST = 0.95, 0.5, 5  # cosine, mm from which others may have wings, be these; places that tell
ONWARD = math.radians(40.0)  # of a line from where one ends: it leaves that gradually, and no end is seen
LIKE, NEARER = math.radians(3.0), 0.5  # of lines that look like wings; mm by which ends are nearer to their points
POLE, ENDING, POINTING = 0.15, 0.15, 0.35  # mm, errors of a printed pole, of where a line ends, of an arrowhead's point
PLACED = 0.2  # mm, error of a point that should lie on a line, and is put there by eye
NEAR = 1.0  # mm that a point may be from where it should be, as far as nothing tells
LIKELY = 2.5  # errors between a crossing and an end that is that of the point
STRAYED = 1.2  # mm from where a point should be that an end or an arrowhead alone tells of it
BESIDES = 1.4  # mm between a point and where the end of a line with its arrowhead has it
BEYOND = 0.45  # mm beyond its arrowhead that a line ends in another one, or in a letter
ALIKE = 0.8  # mm within which ends and arrowheads are those of one point
FLAT, TOLD = 0.6, 1.5  # mm, error of a crossing that ends must tell; from which a single end does not
TIED, TIE = 5.0, (0.2, 0.1)  # mm of a short vector; its error, mm and part of it
FAR = 3.0  # mm from where it should be that no point is
ROUNDS, STRANGE = 6, 2.5  # of solving; errors off at which an equation counts half
LOST = 99.0  # mm, error of a point of which nothing is known

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]
Ends = tuple[complex, complex]


@dataclass(frozen=True, slots=True, eq=False)
class Pencil:
    """How dark the pencil is on a page, 0 to 254, or `HIDES`.

    Places of the drawing are `by` to the right of those of the page, which are so many `times` as large.
    """

    dark: NDArray[np.uint8]
    by: float = 0.0
    times: float = 1.0

    def at(self, places: Complex) -> tuple[Floats, NDArray[np.bool_]]:
        """Return how dark the pencil is at places, 0 to 1, and where print hides it."""
        rows, columns = self.dark.shape
        z = (places - self.by) * self.times * PER_MM
        x = np.clip(np.floor(z.real).astype(np.intp), 0, columns - 1)
        y = np.clip(np.floor(rows - z.imag).astype(np.intp), 0, rows - 1)
        found = self.dark[y, x]
        hidden = found == HIDES
        return np.where(hidden, 0.0, found / 254.0), hidden


@dataclass(frozen=True, slots=True, eq=False)
class Traced:
    """A line as it is drawn: through which place, in which direction; how dark it is, what part of it is there."""

    through: complex
    unit: complex
    dark: float
    part: float


@dataclass(frozen=True, slots=True, eq=False)
class _Spot:
    """Where a line ends, or an `arrow` points to, along its line; nothing is drawn beside a `clean` end."""

    place: complex
    unit: complex
    arrow: bool = False
    clean: bool = False

    @property
    def error(self) -> float:
        """Its error, mm."""
        return POINTING if self.arrow else ENDING


def traced(
    pencil: Pencil, way: Way, wanted: Complex, points: Complex, pole: complex
) -> tuple[Complex, Floats, dict[int, Traced]]:
    """Return the points of a plan as they are drawn, their errors, and its lines that are there.

    `wanted` is where they should be, `points` where they seem to be.
    """
    ends = way.tails[way.lines], way.tips[way.lines]
    sizes = np.abs(wanted[ends[1]] - wanted[ends[0]])
    errors, tied, found = np.full(len(points), LOST), np.zeros(len(points), bool), dict[int, Traced]()
    for aside, step in PASSES:
        lines = [
            _line(pencil, complex(points[tail]), complex(points[tip]), aside, step)
            for tail, tip in zip(*ends, strict=True)
        ]
        found = {n: line for n, line in enumerate(lines) if line is not None and sizes[n] >= SHORTEST}
        spots = _spots(pencil, way, points, found)
        points, errors, tied = _solved(way, wanted, points, found, spots, pole)
    for mark, some in spots.items():
        if _contradicted(some, complex(points[mark])) or (tied[mark] and _astray(some, complex(points[mark]))):
            errors[mark] = LOST
    return points, np.where(np.abs(points - wanted) > FAR, LOST, errors), found


def _contradicted(spots: list[_Spot], point: complex) -> bool:
    """Whether a line ends, and its arrowhead points, clearly beside where a point has been found.

    Where two other lines end at the point, it is a letter that looks like both.
    """
    ends = [(s.unit, s.place) for s in spots if not s.arrow]
    heads = [(s.unit, s.place) for s in spots if s.arrow]
    return any(
        abs(dot(unit, end - head)) < ALIKE
        and abs(dot(unit, (end + head) / 2.0 - point)) > BESIDES
        and sum(abs(dot(way, place - point)) < ALIKE for way, place in ends if way != unit) < 2
        for (unit, end), (of, head) in product(ends, heads)
        if unit == of
    )


def _astray(spots: list[_Spot], point: complex) -> bool:
    """Whether lines end, and arrowheads point, only far beside a point of which nothing but its neighbours tells."""
    return bool(spots) and all(abs(dot(spot.unit, spot.place - point)) > STRAYED for spot in spots)


def between(way: Way, mark: int) -> NDArray[np.bool_]:
    """Return on which vectors of a plan a point lies, as a centre of mass does on that of its link."""
    start, span = way.places[way.tails[way.lines]], way.spans
    place = way.places[mark] - start
    along = dot(span, place) / np.maximum(np.abs(span) ** 2, 1e-300)
    aside = np.abs(cross(span, place)) / np.maximum(np.abs(span), 1e-300)
    return np.asarray((aside <= 1e-6 * way.longest) & (along > 0.02) & (along < 0.98))


def _line(pencil: Pencil, tail: complex, tip: complex, aside: float, step: float) -> Traced | None:
    """Return the line that is drawn near to a way, or None."""
    size = abs(tip - tail)
    if size < SHORTEST / 2:
        return None
    unit, trim = (tip - tail) / size, min(0.5, size / 8)
    count = int(np.clip(size / ALONG, 8, MOST))
    along = np.linspace(trim, size - trim, count)
    across = np.arange(-aside, aside + ACROSS / 2, ACROSS)
    strip, hidden = pencil.at(tail + along[:, None] * unit + 1j * unit * across[None, :])
    seen = ~hidden.all(axis=1)
    if seen.sum() < max(4, 0.25 * count) or hidden.all(axis=0).any():
        return None
    level = max(float(np.median(strip[seen].max(axis=1))), FAINT)
    strip = np.where(hidden, np.nan, np.minimum(strip / (FULL * level), 1.0))
    offs = np.arange(-aside, aside + step / 2, step)
    first, last = (one.ravel() for one in np.meshgrid(offs, offs, indexing="ij"))
    part = along / size
    columns = np.rint((first[:, None] * (1 - part) + last[:, None] * part + aside) / ACROSS).astype(np.intp)
    rows = np.arange(count)[None, :]
    with np.errstate(invalid="ignore"):
        score = np.nan_to_num(np.nanmean(strip[rows[:, seen], columns[:, seen]], axis=1))
    score -= STRAY * (first**2 + last**2) / aside**2
    best = int(score.argmax())
    start, stop = (end + 1j * unit * float(off[best]) for end, off in ((tail, first), (tip, last)))
    return _centred(pencil, start, stop, along, level)


def _centred(pencil: Pencil, start: complex, stop: complex, along: Floats, level: float) -> Traced | None:
    """Return a line put on the middle of what is dark, if enough of it is."""
    across = np.arange(-0.4, 0.41, ACROSS / 2)
    size, part, dark = abs(stop - start), 0.0, 0.0
    for _ in range(2):
        unit = (stop - start) / size
        strip, hidden = pencil.at(start + along[:, None] * unit + 1j * unit * across[None, :])
        top = strip[:, np.abs(across) < 0.25].max(axis=1)
        open_ = ~hidden.any(axis=1)
        good = open_ & (top > max(FAINT, FALL * level))
        part = float(good.sum() / max(int(open_.sum()), 1))
        if good.sum() < 4 or part < THERE:
            return None
        dark = float(np.median(top[good]))
        base, slope = middles_of(along[good], across, strip[good], dark)
        start, stop = (start + at * unit + 1j * unit * (base + slope * at) for at in (0.0, size))
    return Traced(start, (stop - start) / abs(stop - start), dark, part)


def _spots(pencil: Pencil, way: Way, points: Complex, found: dict[int, Traced]) -> dict[int, list[_Spot]]:
    """Return where lines end and arrowheads point to, by the points of the plan that they may be."""
    arrows = set(zip(way.tails.tolist(), way.tips.tolist(), strict=True))
    ends = [(int(way.tails[at]), int(way.tips[at])) for at in way.lines]
    spots: dict[int, list[_Spot]] = {}
    for number, line in found.items():
        for tail, tip in (ends[number], ends[number][::-1]):
            near, span = spots.setdefault(tip, []), complex(points[tip] - points[tail])
            others = [
                points[b] - points[a] for n in found for a, b in (ends[n], ends[n][::-1]) if a == tip and b != tail
            ]
            turns = np.angle(np.array(others, complex) / span)
            where = complex(points[tail]), complex(points[tip])
            goes_on = (np.abs(turns) < ONWARD).any()
            seen = [] if goes_on else [*_ended(pencil, line, *where)]
            back = math.pi - np.abs(turns)
            if (tail, tip) in arrows and not ((back > WINGS[0] - LIKE) & (back < WINGS[-1] + LIKE)).any():
                seen += _pointed(pencil, line, *where)
                if not seen and (np.abs(np.sin(turns)) < LEVEL).all():  # nothing else tells where it ends
                    seen += _widened(pencil, line, *where)
            bare = [head for head in seen if head.arrow and any(BEYOND < -_beyond(s, head) <= STRAYED for s in seen)]
            near += [spot for spot in seen if spot not in bare]  # no arrowhead points to where its line has ended
    for mark, some in spots.items():  # what is at another point is of that
        others_at = np.delete(points, mark)
        own = [s for s in some if np.abs(others_at - s.place).min() + NEARER > abs(points[mark] - s.place)]
        spots[mark] = own
    return spots


def senses(pencil: Pencil, way: Way, points: Complex, found: Mapping[int, Traced]) -> dict[int, int]:
    """Return of lines of a plan how their arrowheads point: 1 as they should, -1 the other way, 0 doubtfully.

    Lines that are vectors both ways, short ones, and those that nothing tells of are left out. An arrowhead that lines
    nearly in one direction may have may be that of each of them; but where a wing is bare, there is none of any.
    """
    heads = {n: (complex(points[way.tails[way.lines[n]]]), complex(points[way.tips[way.lines[n]]])) for n in found}
    heads = {n: ends for n, ends in heads.items() if abs(ends[1] - ends[0]) > BESIDE}
    told = dict[int, int]()
    for number, (tail, tip) in heads.items():
        if way.both[number] or abs(tip - tail) < ARROWED:
            continue
        others = {n: ends for n, ends in heads.items() if n != number}
        (at_tip, _), (at_tail, shared) = _along(tail, tip, others), _along(tip, tail, others)
        pairs, dark = ((tail, tip), (tip, tail)), found[number].dark
        forth, back = (_winged(pencil, *ends, dark, others.values()) for ends in pairs)
        alone = not (at_tip or at_tail or shared)
        if forth.faint <= BARE:  # no arrowhead where it should be
            half = forth.dark >= CLEARLY and back.faint <= BARE  # of one whose other wing a line hides
            if back.dark >= POINTED and not half:
                told[number] = -1 if alone and back.both >= POINTED and forth.dark <= BARE else 0
        elif at_tip and not at_tail and back.both >= CLEARLY:
            told[number] = 0
        elif alone and forth.both >= POINTED and back.both <= BARE:
            told[number] = 1
        elif alone and back.both > forth.both + DOUBTED:
            told[number] = 0
    return told


def _along(tail: complex, tip: complex, others: Mapping[int, Ends]) -> tuple[bool, bool]:
    """Return whether lines that go out from a tip about as that to the tail have their heads there, or their tails."""
    headed, shared = False, False
    for ends in others.values():
        for other, end in (ends, ends[::-1]):
            if abs(end - tip) < WING and dot(other - end, tail - tip) > TOUCHED * abs(other - end) * abs(tail - tip):
                headed, shared = headed or end == ends[1], shared or end == ends[0]
    return headed, shared


def ends_at(pencil: Pencil, tail: complex, tip: complex, other: complex) -> bool:
    """Whether a line from a tail has its arrowhead clearly at a tip, and none at another place along it."""
    if min(abs(tip - tail), abs(other - tail)) < ARROWED:
        return False
    along = np.asarray(tail + (tip - tail) * np.linspace(0.1, 0.9, MOST), complex)
    dark = float(np.median(pencil.at(along)[0]))
    here, there = (_winged(pencil, tail, end, max(dark, FAINT), ()).both for end in (tip, other))
    return here >= POINTED and there <= BARE


class _Wings(NamedTuple):
    """How dark, against their line, wings of an arrowhead may be: `both` of them, the `faint` and the `dark` side.

    NaN where other lines hide them: what is seen of a side that they partly hide may be beside its wing. No wing of an
    arrowhead is faint; other lines, letters may be dark on both sides.
    """

    both: float
    faint: float
    dark: float


def _winged(pencil: Pencil, tail: complex, tip: complex, line: float, others: Iterable[Ends]) -> _Wings:
    """Return how dark wings of an arrowhead at a tip are."""
    size, pairs, sides, partly = abs(tip - tail), list[float](), (list[float](), list[float]()), [False, False]
    unit = (tip - tail) / size
    at = np.arange(-NEAR, NEAR + 0.05, 1.0 / PER_MM)
    for wing in WINGS:
        behind, both = _behind(wing, size), list[Floats]()
        if len(behind) < FEWEST:
            continue
        for number, (side, own) in enumerate(zip((wing, -wing), sides, strict=True)):
            legs = tip + at[:, None] * unit - unit * np.exp(1j * side) * behind[None, :]
            dark, hidden = pencil.at(legs)
            for a, b in others:
                along, aside = dot(b - a, legs - a) / abs(b - a), np.abs(cross(b - a, legs - a)) / abs(b - a)
                hidden |= np.asarray((aside < BESIDE) & (along > -BESIDE) & (along < abs(b - a) + BESIDE))
            count = (~hidden).sum(axis=1)
            mean = np.where(hidden, 0.0, dark).sum(axis=1) / np.maximum(count, 1) / line
            both.append(np.where(count < FEWEST, np.nan, mean))
            own += mean[count >= FEWEST].tolist()
            partly[number] |= bool(count[len(count) // 2] < FEWEST)
        pairs += (least := np.minimum(*both))[~np.isnan(least)].tolist()
    most, told = max(pairs, default=math.nan), [max(own, default=math.nan) for own in sides]
    seen = [own for own, hides in zip(told, partly, strict=True) if own >= POINTED or not (hides or own != own)]
    seen = seen or [math.nan]
    return _Wings(most if most >= POINTED or not any(partly) else math.nan, min(seen), max(seen))


def _towards(line: Traced, tail: complex, tip: complex) -> tuple[complex, complex, float]:
    """Return the direction of a line from tail to tip, the place on it beside the tip, and how far they are apart."""
    unit = line.unit if dot(line.unit, tip - tail) > 0 else -line.unit
    return unit, line.through + dot(line.unit, tip - line.through) * line.unit, abs(tip - tail)


def _ended(pencil: Pencil, line: Traced, tail: complex, tip: complex) -> Iterator[_Spot]:
    """Go through where a line ends near to its tip: there its darkness falls."""
    unit, foot, size = _towards(line, tail, tip)
    inside = min(REACH, 0.6 * size)
    along = np.arange(-inside, REACH + CLEAR, 1.0 / PER_MM)
    across = np.arange(-0.2, 0.21, 0.1)
    strip, hidden = pencil.at(foot + along[:, None] * unit + 1j * unit * across[None, :])
    hid, dark = np.asarray(hidden.any(axis=1)), np.asarray(strip.mean(axis=1))
    before = ~hid & (along < 0.0)
    if not before.any():
        return
    level = max(FAINT / 2, FALL * float(np.median(dark[before])))
    on = np.asarray((dark > level) & ~hid)
    clear = round(CLEAR * PER_MM)
    for at in np.flatnonzero(on).tolist():
        beyond = slice(at + 1, at + 1 + clear)
        if at + clear < len(along) and not on[beyond].any():
            if not hid[beyond].any():
                past = (dark[at] - level) / (dark[at] - dark[at + 1])  # of a pixel that it goes on
                end = complex(foot + (along[at] + past / PER_MM - ROUND) * unit)
                dark, _ = _flanks(pencil, end, unit, np.arange(-ALONE, CLEAR, 1.0 / PER_MM))
                yield _Spot(end, unit, clean=bool(dark.max() < WIDE * line.dark))
            return


def _pointed(pencil: Pencil, line: Traced, tail: complex, tip: complex) -> Iterator[_Spot]:
    """Go through where an arrowhead on a line points to: its two wings are found, then where they meet the line."""
    unit, foot, size = _towards(line, tail, tip)
    if size < WINGED:
        return
    at = np.arange(-min(REACH, size / 3), REACH, 1.0 / PER_MM)
    best, angles = np.zeros(len(at)), np.zeros(len(at))
    for wing, by in product(WINGS, BY[::2]):  # the line may lie beside the point by a little
        behind = _behind(wing, size)
        if len(behind) < FEWEST:
            continue
        tips = foot + (at[:, None] + 1j * by) * unit
        legs = [tips - unit * np.exp(1j * side) * behind[None, :] for side in (wing, -wing)]
        score = np.minimum(*(pencil.at(leg)[0] for leg in legs)).mean(axis=1) / line.dark
        best, angles = np.maximum(best, score), np.where(score > best, wing, angles)
    tops = sorted(_tops(best), key=lambda own: ASTRAY * abs(float(at[own])) - float(best[own]))
    for own in tops:  # lines that cross may look like wings, too
        by = _apex(pencil, foot + at[own] * unit, unit, float(angles[own]), min(WING, 0.9 * size / 3))
        if by is not None:
            yield _Spot(complex(foot + (at[own] + by) * unit), unit, arrow=True)
            return
    if tops:  # letters beside its wings hide how these stand out
        yield _Spot(complex(foot + at[tops[0]] * unit), unit, arrow=True)


def _tops(score: Floats) -> Iterator[int]:
    """Go through where wings are darkest around, the darkest first, as far as they are dark enough; not at an end."""
    near = round(TOPS * PER_MM)
    for own in np.argsort(-score).tolist():
        if score[own] <= POINTED:
            return
        if 0 < own < len(score) - 1 and score[own] >= score[max(own - near, 0) : own + near + 1].max():
            yield own


def _widened(pencil: Pencil, line: Traced, tail: complex, tip: complex) -> Iterator[_Spot]:
    """Go through where a line becomes wider, on both sides alike: a small arrowhead points there, or a blotted one."""
    unit, foot, size = _towards(line, tail, tip)
    at = np.arange(-min(REACH, size / 3) - WIDER, min(REACH, size / 3), 1.0 / PER_MM)
    dark, hidden = _flanks(pencil, foot, unit, at)
    wide = dark.min(axis=0) / line.dark
    before, beyond = round(WIDER * PER_MM), round(CLEAR * PER_MM)
    for stop in np.flatnonzero((wide[:-1] > WIDE) & (wide[1:] <= WIDE)).tolist()[::-1]:
        own = slice(max(stop + 1 - before, 0), stop + 1 + beyond)
        if not hidden[own].any() and (wide[own][:before] > WIDE).all() and wide[stop + 1 : own.stop].min() < NARROW:
            yield _Spot(complex(foot + (at[stop] + BLUNT) * unit), unit, arrow=True)
            return


def _flanks(pencil: Pencil, place: complex, unit: complex, along: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Return how dark it is on both sides `along` a line from a place, of shape (2, N), and where that is hidden."""
    off = np.array([1j, -1j])[:, None, None] * BAND
    dark, hidden = pencil.at(np.asarray(place + unit * (along[:, None] + off)))
    return dark.mean(axis=2), np.asarray(hidden.any(axis=(0, 2)))


def _apex(pencil: Pencil, apex: complex, unit: complex, angle: float, size: float) -> float | None:
    """Return how far beyond a place an arrowhead has its point: where both wings are dark, and paper is beside them.

    The line may lie beside the point by a little: both are sought together, with the angle of the wings.
    """
    back = np.arange(NIB, size, 0.15)
    apart = back * math.sin(angle) > FLANK + ASIDE
    shifts = (FORTH[:, None, None] + 1j * BY[None, :, None]) * unit
    turns = np.exp(1j * (angle + TURNS))[None, None, :]
    whole = np.zeros(np.broadcast_shapes(shifts.shape, turns.shape))
    least = np.zeros(whole.shape)
    for side in (1.0, -1.0):
        leg = -unit * (turns if side > 0 else turns.conj())
        place = (apex + shifts)[..., None] + leg[..., None] * back
        dark, beside, inner = (pencil.at(place + 1j * side * leg[..., None] * off)[0] for off in (0.0, FLANK, -FLANK))
        level = max(float(np.percentile(dark, 80)), FAINT)
        contrast = (np.minimum(dark / level, 1.0) - np.minimum(beside / level, 1.0)).mean(axis=-1)
        whole -= np.minimum(inner[..., apart] / level, 1.0).sum(axis=-1) / len(back)
        whole += contrast
        least = np.maximum(least, contrast)
    top = whole.max()
    if least[np.unravel_index(whole.argmax(), whole.shape)] < CONTRAST:
        return None
    good = np.maximum(whole - top + TOP, 0.0)
    return float((good * FORTH[:, None, None]).sum() / good.sum())


def _behind(wing: float, size: float) -> Floats:
    """Return how far from the point of an arrowhead a wing is looked at: apart from its line, and from its end."""
    return np.arange(APART / math.sin(wing), min(WING, 0.9 * size / 3), 1.0 / PER_MM)


def _solved(
    way: Way,
    wanted: Complex,
    points: Complex,
    found: dict[int, Traced],
    spots: dict[int, list[_Spot]],
    pole: complex,
) -> tuple[Complex, Floats, NDArray[np.bool_]]:
    """Return where points of a plan are, their errors, and which of them only short vectors tell of.

    They are where lines cross, and with ends where that is flat.

    Points that a short vector joins, of which nobody is asked, are as far from one another as they should be, about.
    """
    rows = _Rows(points)
    for mark in range(len(points)):
        own = {n for n in found if mark in (way.tails[way.lines[n]], way.tips[way.lines[n]])}
        if own:
            for n in sorted(own | {n for n in np.flatnonzero(between(way, mark)).tolist() if n in found}):
                rows.add(mark, 1j * found[n].unit, found[n].through, LINE if n in own else PLACED)
        if abs(way.places[mark]) <= 1e-9 * way.longest:
            rows.add(mark, 1.0, pole, POLE)
            rows.add(mark, 1j, pole, POLE)
    for tail, tip in zip(way.tails[way.lines].tolist(), way.tips[way.lines].tolist(), strict=True):
        span = complex(wanted[tip] - wanted[tail])
        if abs(span) < TIED:
            for unit in (1.0, 1j):
                rows.tie(tail, tip, unit, span, TIE[0] + TIE[1] * abs(span))
    crossings, errors = rows.solved()
    left = {mark: [*some] for mark, some in spots.items()}
    for _ in range(2):  # an end tells where its neighbours are that short vectors join
        for mark, some in left.items():
            told = _telling(some, complex(crossings[mark]), float(errors[mark]), complex(wanted[mark]))
            for spot in told:
                rows.add(mark, spot.unit, spot.place, spot.error)
            if told:
                left[mark] = []
        crossings, errors = rows.solved()
    return crossings, errors, rows.spread(tied=False) > FLAT


def _telling(spots: list[_Spot], crossing: complex, error: float, wanted: complex) -> list[_Spot]:
    """Return the ends and arrowheads that tell of a point: of a flat crossing an arrowhead, or ends that are one.

    Where a line ends and its arrowhead points elsewhere, nothing tells, for a letter may touch either; but one goes on
    beyond an arrowhead that is about where it should be. Nor does what is far from where a point should be, if end and
    arrowhead do not say the same, and the end is not clean: letters look like arrowheads, too, and like ends of lines.
    """
    near = [s for s in spots if abs(dot(s.unit, s.place - crossing)) < LIKELY * math.hypot(min(error, NEAR), s.error)]
    most = LOST if error <= FLAT else ALIKE
    near = [s for s in near if s.clean or not any(BEYOND < _beyond(s, head) <= most for head in near if head.arrow)]
    if error <= FLAT:
        own = [s for s in near if s.arrow or s.clean or abs(dot(s.unit, s.place - crossing)) <= ALIKE]
        return [s for s in near if s in own or any(abs(_beyond(s, head)) <= ALIKE for head in own if head.arrow)]
    heads = [s for s in near if s.arrow and abs(dot(s.unit, s.place - wanted)) <= STRAYED]
    near = [s for s in near if s.arrow or not any(_beyond(s, head) > ALIKE for head in heads)]
    apart = max((abs(dot(one.unit, one.place - other.place)) for one in near for other in near), default=LOST)
    alone = len(near) < 2 and not any(spot.arrow or spot.clean for spot in near) and error > TOLD
    alone &= any(abs(dot(spot.unit, spot.place - wanted)) > ALIKE for spot in near)
    strayed = any(abs(dot(spot.unit, spot.place - wanted)) > STRAYED and not spot.clean for spot in near)
    strayed &= not any(abs(_beyond(*two)) <= ALIKE for two in combinations(near, 2))  # both tell the same
    return [] if apart > ALIKE or alone or strayed else near


def _beyond(spot: _Spot, head: _Spot) -> float:
    """Return how far a line goes on beyond an arrowhead of its own, mm."""
    return float(dot(spot.unit, spot.place - head.place)) if spot.unit == head.unit else math.inf


class _Rows:
    """Equations of the points of a plan, each divided by its error."""

    def __init__(self, points: Complex) -> None:
        self.points = points
        self.rows: list[Floats] = []
        self.right: list[float] = []
        self.weight = np.ones(0)  # of each, once they are solved

    def add(self, mark: int, unit: complex, place: complex, error: float) -> None:
        """Say that a point lies at a place in a direction."""
        row = np.zeros((len(self.points), 2))
        row[mark] = unit.real / error, unit.imag / error
        self.rows.append(row.ravel())
        self.right.append(float(dot(unit, place - self.points[mark])) / error)

    def tie(self, tail: int, tip: int, unit: complex, span: complex, error: float) -> None:
        """Say how far one point is from another in a direction."""
        row = np.zeros((len(self.points), 2))
        row[tip] = unit.real / error, unit.imag / error
        row[tail] = -row[tip]
        self.rows.append(row.ravel())
        self.right.append(float(dot(unit, span - self.points[tip] + self.points[tail])) / error)

    def solved(self) -> tuple[Complex, Floats]:
        """Return the points and their errors; what nothing tells stays where it is, and its error is large.

        An equation that most others contradict counts less and less: the line of a neighbour may have been taken.
        """
        rows, right = np.array(self.rows).reshape(len(self.rows), 2 * len(self.points)), np.array(self.right)
        free, self.weight = np.eye(2 * len(self.points)), np.ones(len(rows))
        for _ in range(ROUNDS):
            own = (self.weight * rows.T) @ rows
            x = np.linalg.solve(own + free / NEAR**2, (self.weight * rows.T) @ right)
            self.weight = 1.0 / (1.0 + ((rows @ x - right) / STRANGE) ** 2)
        moved = x.reshape(-1, 2)
        return self.points + moved[:, 0] + 1j * moved[:, 1], self.spread()

    def spread(self, tied: bool = True) -> Floats:
        """Return the errors of the points, with or without what is said of two of them, as they were solved."""
        rows = np.array(self.rows).reshape(len(self.rows), 2 * len(self.points))
        weight = self.weight * (tied | (np.count_nonzero(rows.reshape(len(rows), -1, 2).any(axis=2), axis=1) < 2))
        spread = np.diag(np.linalg.inv((weight * rows.T) @ rows + np.eye(rows.shape[1]) / LOST**2))
        return np.asarray(np.sqrt(spread.reshape(-1, 2).sum(axis=1)))
