"""Which pencil line is which vector, on a handout whose poles and scale factors are known.

The right plan, and that of each mistake, say where lines should be; a line that is nearly there, along nearly the whole
way, is the vector. Points of a plan are where its lines cross, weighed against where they end and where arrows are: so
each has an error of its own. A plan is the one of which most lines are there, the right one where others are as good.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...plans.laws import cross, dot
from ...plans.marking.drawn import Found, FoundPlan, Recognised
from ...plans.marking.elsewhere import elsewhere
from ...plans.marking.laying import Laying
from ...plans.marking.lines import Drawn, Lines
from ...plans.marking.lines import lines_of as in_order
from ...plans.marking.ways import Shape as Way
from ...plans.marking.ways import shapes_of
from ..marking.keyed import Keyed
from .strokes import END, LINE
from .traced import Pencil, Traced, between, ends_at, senses, traced

LONG = 4.0  # mm of a vector whose line is sought
OFF, SKEW, TURN = (3.0, 1.5), 1.0, 0.03  # mm a line may be off at first, and then; mm at its ends and sine besides
COVER, FREE = 0.6, 1.5  # part of a vector that its line covers at the least; mm at its ends that it need not
GOOD, WORSE = 0.7, 4.0  # mm off that count little; times that at which a line counts half
NEAR = 2.0  # mm from where a point should be within which an end or an arrow tells of it
POLE = 0.15  # mm, error of a line that begins at a printed pole
WHOLE, ENOUGH, LAID = 0.97, 0.75, 0.6  # part of a plan: all of it; that must be there; at a first look
BETTER, ABSENT = 5.0, 0.5  # mm more of a plan with a mistake than of the right one; part that counts against it
CLEAR = 0.75  # part of the right plan that one with a mistake must have that is all there
LACKS, HAND = (
    8,
    0.25,
)  # power of the part that is there, by which a plan goes before others; mm that a hand misses points
RESIZED = 0.3  # mm by which the longest vector is measured anew
LIKELY = 6  # plans with a mistake of which most mm are there, and most of them, that are looked at closely
STRAYED = 3.0  # mm from where it should be that a point is elsewhere
SURE = 0.7  # mm, error of an end from which a vector is not sure; those that end so are 0.3 mm off
ALIKE = 0.7  # mm within which ends and arrows are those of one point
STEEP = 0.2  # sine of lines between which a point is told by their crossing
LOST = 99.0  # mm, error of a point of which nothing is known

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class _Lines:
    """Lines on a page, mm, complex of shape (N,), and the ends and arrows of all, shape (M,)."""

    tails: Complex
    tips: Complex
    spots: Complex
    pencil: Pencil | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    """A way to draw a plan, laid on a page: points, their errors, mm; how large it is, how much of it is there.

    `worth` are the mm of lines that are there, less half of those that are not; `off` is how far its points are from
    where they should be, mm, root of the mean square.
    """

    way: Way
    points: Complex
    errors: Floats
    times: float
    quality: float
    worth: float
    off: float
    there: frozenset[frozenset[int]]
    lines: Mapping[int, Traced] = field(default_factory=dict)


def lines_of(tails: Complex, tips: Complex, pencil: Pencil | None = None) -> _Lines:
    """Return lines of a page; short ones are wings of arrows, which begin at a spot."""
    long = np.abs(tips - tails) >= LONG
    return _Lines(tails[long], tips[long], np.concatenate((tails, tips[long])), pencil)


def matched(
    pages: Mapping[int, _Lines], poles: Mapping[str, tuple[int, complex]], mus: Mapping[str, float], keyed: Keyed
) -> Recognised:
    """Find the vectors of all plans whose pages are there; places are those of the pages, see `poles`."""
    plans, vectors, missing = dict[str, FoundPlan](), dict[str, Found](), list[str]()
    for plan, (number, pole) in poles.items():
        lines = pages.get(number)
        fit = None if lines is None else _best(lines, pole, mus[plan], plan, keyed)
        asked = [name for name, question in keyed.key.questions.items() if question.vector and question.plan == plan]
        if fit is None:
            missing += asked
            continue
        mistake = "" if fit.way.right else keyed.book.signatures[fit.way.broken[0]].broken.mistake
        at = complex(fit.points[int(np.abs(fit.way.places).argmin())])
        plans[plan] = FoundPlan(mus[plan] / fit.times, 0.0, at, fit.quality, mistake)
        way = fit.way
        told = {} if lines is None or lines.pencil is None else senses(lines.pencil, way, fit.points, fit.lines)
        pointed = {frozenset((int(way.tails[at]), int(way.tips[at]))): told.get(n) for n, at in enumerate(way.lines)}
        for name, tail, tip in zip(way.names, way.tails.tolist(), way.tips.tolist(), strict=True):
            error = float(np.hypot(fit.errors[tail], fit.errors[tip]))
            if name in asked and error <= SURE and (line := frozenset((tail, tip))) in fit.there:
                first, last = (tip, tail) if (sense := pointed[line]) == -1 else (tail, tip)
                certainty = 1.0 - error if sense != 0 else 0.0
                vectors[name] = Found(complex(fit.points[first]), complex(fit.points[last]), plan, certainty)
        missing += [name for name in asked if name not in vectors]
    return Recognised(plans, vectors, tuple(missing))


def _best(lines: _Lines, pole: complex, mu: float, plan: str, keyed: Keyed) -> _Fit | None:
    """Return how a plan is drawn: the right one, or one with a mistake of which clearly more is there.

    One that is all there goes before a larger one of which a part is: lines go on, and others lie where it should be.
    """
    if not len(lines.tails):
        return None
    (right, *_) = shapes_of(keyed.key, None, plan)
    laid = _laid(lines, pole, mu, right)
    first = best = _traced(lines, laid, pole, mu)
    whole = best.quality >= WHOLE
    if not whole or _untold(best):
        ways = (_laid(lines, pole, mu, way) for way in shapes_of(keyed.key, keyed.book, plan)[1:])
        likely = [
            fit for fit in ways if fit.quality >= LAID and fit.worth > min(CLEAR * laid.worth, laid.worth - BETTER)
        ]
        least, largest = best.worth, sorted(likely, key=_rank, reverse=True)[:LIKELY]
        for fit in dict.fromkeys((*largest, *sorted(likely, key=lambda fit: -fit.quality)[:LIKELY])):
            own = _traced(lines, fit, pole, mu)
            enough = CLEAR * least if own.quality >= WHOLE else least + BETTER
            better = own.worth > enough and (best.way.right or _rank(own) > _rank(best))
            if better and (not whole or _ends_elsewhere(lines, own, first, mu)):
                best = own
    if best.quality < WHOLE and (led := _elsewhere(lines, pole, mu, right, keyed)) is not None:
        best = led if led.worth > best.worth + BETTER else best
    return best if best.quality >= ENOUGH else None


def _untold(fit: _Fit) -> set[int]:
    """Return the numbers of the lines that are there of which it is not told where they end."""
    way, known = fit.way, fit.errors <= SURE
    return {n for n in fit.lines if not (known[way.tails[way.lines[n]]] and known[way.tips[way.lines[n]]])}


def _ends_elsewhere(lines: _Lines, own: _Fit, first: _Fit, mu: float) -> bool:
    """Whether all of a plan with a mistake is there, where lines of the right one, all there, go on or end before.

    The arrowheads of such lines must be where they are with the mistake, and not where they should be.
    """
    if own.quality < WHOLE or _untold(own) or lines.pencil is None:
        return False
    ends = {name: (own.way.tails[at], own.way.tips[at]) for at, name in enumerate(own.way.names)}
    untold, moved = _untold(first), 0
    for n in untold:
        at = first.way.lines[n]
        tail, tip = ends.get(first.way.names[at], (None, None))
        if tail is None or tip is None:
            return False
        drawn, right = own.points[tip] - own.points[tail], first.way.spans[n] * first.times / mu
        if abs(drawn - right) > NEAR:
            end = complex(own.points[tail])
            if not ends_at(lines.pencil, end, end + complex(drawn), end + complex(right)):
                return False
            moved += 1
    return moved > 0


def _elsewhere(lines: _Lines, pole: complex, mu: float, right: Way, keyed: Keyed) -> _Fit | None:
    """Return how a plan is drawn of which points are elsewhere by no mistake that is known, if all of it is there."""
    laying = Laying(*_in_order(lines), keyed.key.paper.mus, {right.plan: mu})
    led = elsewhere(laying, right, 0.0, pole)
    if led is None:
        return None
    nodes = laying.lines.nodes[led.nodes]
    places = np.where(led.nodes >= 0, (nodes - pole) * mu, right.places)
    if np.abs(places - right.places).max() <= STRAYED * mu:
        return None
    way = replace(right, places=places)
    fit = _traced(lines, _laid(lines, pole, mu, way), pole, mu)
    return fit if fit.quality >= WHOLE else None


@lru_cache(maxsize=1)  # of one plan of a page after the other
def _in_order(lines: _Lines) -> tuple[Drawn, Lines]:
    drawn = Drawn(lines.tails, lines.tips, by_hand=True)
    return drawn, in_order(drawn)


def _rank(fit: _Fit) -> tuple[bool, float]:
    """Return what goes before: what is all there; then more mm of which less lacks, nearer to where they should be."""
    return fit.quality >= WHOLE, fit.worth * fit.quality**LACKS / (1.0 + (max(fit.off, HAND) / GOOD) ** 2)


def _laid(lines: _Lines, pole: complex, mu: float, way: Way) -> _Fit:
    """Lay a way to draw a plan on a page, closer the second time."""
    times, shift = 1.0, 0j
    places = way.places / mu
    for within in OFF:
        wanted = pole + shift + times * places
        own, good = _lines(lines, way, wanted, within)
        points, errors = _points(lines, way, wanted, own, pole)
        known = (errors < SURE) & (np.abs(places) > LONG)
        if known.sum() >= 2:
            times = _times(places[known], points[known] - pole)
    return _fitted(way, mu, points, errors, pole, times, good)


def _times(places: Complex, drawn: Complex) -> float:
    """Return how large a plan is drawn, from its pole: the middle of what its points tell, the far ones more."""
    ratios, weights = dot(places, drawn) / np.abs(places) ** 2, np.abs(places)
    order = np.argsort(ratios)
    whole = np.cumsum(weights[order])
    return float(np.clip(ratios[order][np.searchsorted(whole, whole[-1] / 2.0)], 0.9, 1.1))


def _traced(lines: _Lines, fit: _Fit, pole: complex, mu: float) -> _Fit:
    """Return a fit whose points are measured along where its lines should be, if there is a picture."""
    if lines.pencil is None:
        return fit
    way = fit.way
    wanted = pole + fit.times * way.places / mu
    first = traced(lines.pencil, way, wanted, wanted, pole)
    known = (first[1] < SURE) & (np.abs(way.places) / mu > LONG)
    times = _times(way.places[known] / mu, first[0][known] - pole) if known.sum() >= 2 else fit.times
    near = (fit.errors < SURE) & (np.abs(fit.points - wanted) < OFF[0])
    if abs(times - fit.times) * way.longest / mu > RESIZED:
        wanted, fit = pole + times * way.places / mu, replace(fit, times=times)
        first = traced(lines.pencil, way, wanted, wanted, pole)
    best = fit
    for begun in (None, np.where(near, fit.points, wanted)):
        points, errors, found = first if begun is None else traced(lines.pencil, way, wanted, begun, pole)
        good = np.array([found[number].part if number in found else 0.0 for number in range(len(way.lines))])
        off = np.clip(np.abs(points - wanted) - GOOD, 0.0, OFF[0])  # a line that ends elsewhere is another's
        good /= 1.0 + np.maximum(off[way.tails[way.lines]], off[way.tips[way.lines]]) ** 2 / (GOOD * WORSE) ** 2
        own = replace(_fitted(way, mu, points, errors, pole, fit.times, good), lines=found)
        if best is fit or own.quality > best.quality:
            best = own
        if best.quality >= WHOLE:
            break
    return best


def _fitted(way: Way, mu: float, points: Complex, errors: Floats, pole: complex, times: float, good: Floats) -> _Fit:
    """Return a fit of which lines are there as `good` says, from 0 to 1."""
    sought = np.abs(way.spans) / mu >= LONG
    weights = np.where(sought, way.weights, 0.0)
    sizes = np.where(sought, np.abs(way.spans) / mu / way.like, 0.0)
    whole, known = float(weights.sum()), errors < SURE
    off = np.abs(points - pole - times * way.places / mu)[known]
    ends = zip(way.tails[way.lines].tolist(), way.tips[way.lines].tolist(), good > 0, sought, strict=True)
    return _Fit(
        way,
        points,
        errors,
        times,
        float((weights * good).sum()) / whole if whole else 0.0,
        float((sizes * (good - ABSENT * (1.0 - good))).sum()),
        math.sqrt(np.square(off).mean()) if known.any() else 0.0,
        frozenset(frozenset((tail, tip)) for tail, tip, found, long in ends if found or not long),
    )


def _lines(lines: _Lines, way: Way, wanted: Complex, within: float) -> tuple[NDArray[np.intp], Floats]:
    """Return for each vector of a plan the number of its line or -1, and how well that fits, 0 to 1."""
    sizes = np.abs(lines.tips - lines.tails)
    units = (lines.tips - lines.tails) / sizes
    starts, stops = wanted[way.tails[way.lines]], wanted[way.tips[way.lines]]
    long = np.abs(stops - starts)
    ways = (stops - starts) / np.maximum(long, 1e-9)
    middles = (starts + stops) / 2.0
    sine = np.abs(cross(ways[:, None], units[None, :]))
    off = np.abs(cross(units[None, :], middles[:, None] - lines.tails[None, :]))
    along = [dot(units[None, :], ends[:, None] - lines.tails[None, :]) for ends in (starts, stops)]
    low, high = np.minimum(*along) + FREE, np.maximum(*along) - FREE
    shown = np.clip(np.minimum(high, sizes[None, :]) - np.maximum(low, 0.0), 0.0, None)
    cover = shown / np.maximum(high - low, 0.1)
    may = (off <= within) & (sine <= TURN + SKEW / np.maximum(long, 1e-9)[:, None]) & (cover >= COVER)
    cost = (off / GOOD) ** 2 + (sine * long[:, None] / 2.0 / GOOD) ** 2 + (3.0 * (1.0 - np.minimum(cover, 1.0))) ** 2
    cost = np.where(may & (long >= LONG)[:, None], cost, np.inf)
    own = cost.argmin(axis=1)
    least = cost[np.arange(len(own)), own]
    found = np.isfinite(least)
    good = np.where(found, 1.0 / (1.0 + np.where(found, least, 0.0) / WORSE**2), 0.0)
    return np.where(found, own, -1), good


def _points(lines: _Lines, way: Way, wanted: Complex, own: NDArray[np.intp], pole: complex) -> tuple[Complex, Floats]:
    """Return the points of a plan and their errors: crossings of lines, with ends and arrows where those are flat."""
    points, errors = wanted.copy(), np.full(len(wanted), LOST)
    tails, tips = way.tails[way.lines], way.tips[way.lines]
    for mark in range(len(wanted)):
        at_ends = {int(line) for line in own[(tails == mark) | (tips == mark)] if line >= 0}
        if not at_ends:
            continue
        numbers = sorted(at_ends | {int(line) for line in own[between(way, mark)] if line >= 0})
        units = (lines.tips - lines.tails)[numbers] / np.abs(lines.tips - lines.tails)[numbers]
        point = wanted[mark]
        at_pole = abs(way.places[mark]) <= 1e-9 * way.longest
        for _ in range(3):
            rows, right = _crossing(units, lines.tails[numbers])
            if at_pole:
                rows, right = _more(rows, right, pole, POLE)
            spot = _spot(lines, point, units)
            if spot is not None:
                rows, right = _more(rows, right, *spot)
            inverse = np.linalg.pinv(rows.T @ rows + 1e-9 * np.eye(2))
            x, y = inverse @ (rows.T @ right)
            point = complex(x, y)
            errors[mark] = math.sqrt(max(float(np.trace(inverse)), 0.0))
        points[mark] = point
        if abs(point - wanted[mark]) > OFF[0] or errors[mark] > LOST:
            errors[mark] = LOST
    return points, errors


def _crossing(units: Complex, through: Complex) -> tuple[Floats, Floats]:
    """Return equations of a point on lines, each divided by its error."""
    normals = 1j * units
    return np.stack((normals.real, normals.imag), 1) / LINE, np.asarray(dot(normals, through)) / LINE


def _more(rows: Floats, right: Floats, place: complex, error: float) -> tuple[Floats, Floats]:
    """Return equations with those of a place."""
    own = np.array([place.real, place.imag]) / error
    return np.concatenate((rows, np.eye(2) / error)), np.concatenate((right, own))


def _spot(lines: _Lines, point: complex, units: Complex) -> tuple[complex, float] | None:
    """Return the end or arrow on its lines that is nearest to a point, and its error: others make it doubtful."""
    near = np.abs(lines.spots - point)
    aside = np.abs(cross(units[:, None], lines.spots[None, :] - point)).max(axis=0)
    may = (near < NEAR) & (aside < 0.6)
    if not may.any():
        return None
    steep = len(units) > 1 and float(np.abs(cross(units[:, None], units[None, :])).max()) > STEEP
    if steep and float(near[may].min()) > 1.0:
        return None
    spot = complex(lines.spots[may][near[may].argmin()])
    apart = float(np.abs(lines.spots[may] - spot).max())
    return spot, 2.0 * END if apart <= ALIKE else max(apart, 2.0 * END)
