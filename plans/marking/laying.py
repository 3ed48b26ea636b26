"""Plans laid on the lines of a drawing: where each fits best, which of its lines are there, what that is worth.

A shape is laid wherever one of its long vectors finds a line of its direction. What goes out where that line ends says
what a way to lay it may be worth at the most: the most promising ways are looked at first, of all shapes at once.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ...scales.names import latin
from ..laws import cross
from .lines import WAYS, Complex, Drawn, Floats, Indices, Lines, length_of
from .ways import Shape

SHORT = 1.5  # mm below which a vector shows nothing
LEAST, LARGEST = 20.0, 1500.0  # mm, the longest vector of a plan
SMALLEST = 6.0  # of one that is of its usual size
GENERATOR = 0.3  # part of the longest vector of a plan that a vector must have to lay the plan by
ASTRAY = 0.5  # mm that ends of lines may be astray, which turns short ones
DEGREES = 0.4  # by which lines may miss their direction besides
NEAR = 0.8  # mm from where a point should be to where it is, once the plan lies where it fits best
WIDEST = 4.0  # degrees by which lines are sought
LAID, FEW = 2, 4  # vectors by which a plan is laid; of so many those that few lines may be
CROWD = 3000  # lines that a vector may be by which no plan is laid that others tell
MANY = 200  # places of a plan, the best ones, of which those that differ are sought
KEPT, CLOSE = 12, 1.5  # of which so many are looked at closely, worth no less than the best by more than so much
PROMISING, AT_ONCE = 1500, 500  # ways to lay a plan that are looked at, the most promising ones first; at once
BLOCK = 30_000  # ways to lay a plan of which it is found out at once what they may be worth
MANY_SHAPES = 7  # shapes of which so many ways are looked at
SMALL = 1e-99  # of a plan of which nothing can be seen
UNSEEN = 0.15  # part of a plan by which lines that go out may tell less of it than there is
SURELY = 7.0  # mm from which a vector surely has a direction
ABSENT = 0.5  # what a vector that is not there costs, of what one is worth that is
ALONG = math.radians(1.0)  # by which lines that run along the edges of the sheet may miss their direction
POINTED_OUT = 0.5  # part of its lines with arrowheads, or of its points with letters, that shows a plan
AGAIN = 0.5  # what a line is worth that is a vector of another plan already
USUAL = 2.0  # what it is worth that a plan is drawn to its usual scale
FREE = 0.3  # what it is worth that no line goes on beyond its ends, as those of tables and frames do, or none is askew
SENSE = 0.5  # what an arrowhead is worth that points as it should, of what its line is; against it where it does not
POINTED = math.radians(10.0)  # by which the line of an arrowhead may be turned
NAMED = 0.5  # what a letter is worth that stands at its point; against it where it stands at another
LETTERS = 3  # of the name of a point
BY, AWAY = 2.0, 3.0  # heights of a letter within which it stands at a point, and from which it does not
ASKEW = math.radians(0.5)  # against the sheet, from where a plan is
SAME_MU = 0.01  # part by which scale factors that count as one may differ
SKEW = math.radians(2.0)  # by which a plan may be turned against the sheet


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A shape laid on a drawing: mm = `origin` + `factor` * place; the node of each mark or -1, lines that are there.

    `worth` is what its lines count, those that are not there against it; `senses` are 1 for lines with their
    arrowheads, -1 for those with arrowheads the other way round; `letters` are those at their points, less those at
    others.
    """

    shape: Shape
    origin: complex
    factor: complex
    nodes: Indices
    there: np.ndarray[Any, np.dtype[np.bool_]]
    worth: float
    weights: Floats
    senses: Floats
    letters: int

    @property
    def quality(self) -> float:
        """The part of the plan that is there."""
        whole = float(self.weights.sum())
        return self.lines / whole if whole else 0.0

    @property
    def lines(self) -> float:
        """How many of its lines are there, short ones and those that are nearly one line counted as less."""
        return float(self.weights[self.there].sum())

    @property
    def told(self) -> float:
        """What its arrowheads and letters are worth."""
        return SENSE * float(self.senses @ self.weights) + NAMED * self.letters

    @property
    def against(self) -> bool:
        """Whether its arrowheads point the other way round, or its letters stand at other points."""
        return float(self.senses @ self.weights) < 0.0 or self.letters < 0

    @property
    def mu(self) -> float:
        """The scale factor, SI per mm."""
        return 1.0 / abs(self.factor)

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The nodes that its lines join, the smaller number first."""
        s = self.shape
        ends = zip(self.nodes[s.tails[s.lines]][self.there], self.nodes[s.tips[s.lines]][self.there], strict=True)
        return [(int(min(pair)), int(max(pair))) for pair in ends]


class _Laid(NamedTuple):
    """Ways to lay a shape: origins, factors, nodes of its marks; what each may be worth, what part of it be there."""

    origins: Complex
    factors: Complex
    nodes: Indices
    worth: Floats
    parts: Floats

    @property
    def most(self) -> float:
        """What the best of them may be worth."""
        return float(self.worth.max(initial=-math.inf))


class _Stack:
    """Arrays of several shapes of one plan side by side, of shape (shapes, lines), filled up with nothing.

    `places` are those of their marks, of shape (shapes, marks); `flat`, `longest` of shape (shapes,).
    """

    def __init__(self, shapes: Sequence[Shape]) -> None:
        count, lines = len(shapes), max(len(shape.lines) for shape in shapes)
        self.plan = shapes[0].plan
        self.places = np.zeros((count, max(len(shape.marks) for shape in shapes)), complex)
        self.tails, self.tips = np.zeros((2, count, lines), np.intp)
        self.spans, self.weights = np.zeros((count, lines), complex), np.zeros((count, lines))
        for row, shape in enumerate(shapes):
            some = slice(len(shape.lines))
            self.places[row, : len(shape.marks)] = shape.places
            self.tails[row, some], self.tips[row, some] = shape.tails[shape.lines], shape.tips[shape.lines]
            self.spans[row, some], self.weights[row, some] = shape.spans, shape.weights
        self.sizes, self.angles = np.abs(self.spans), np.angle(self.spans)
        self.longest = self.sizes.max(axis=1)
        self.flat = np.array([shape.flat for shape in shapes])


@dataclass(eq=False)
class Laying:
    """Lays shapes on the lines of a drawing; `used` are the lines that are vectors of plans already.

    `usual` are the scale factors to which plans are drawn if nothing is said, `given` those that are known, SI per mm;
    `times` is how many times the usual ones those of this drawing seem to be.
    """

    drawn: Drawn
    lines: Lines
    usual: Mapping[str, float]
    given: Mapping[str, float]
    used: set[tuple[int, int]] = field(default_factory=set)
    times: float = 1.0
    _laid: dict[tuple[Shape, float, float], _Laid] = field(default_factory=dict)

    def expected(self, plan: str) -> float:
        """Return the scale factor that a plan should have, SI per mm; zero where nobody knows."""
        given = self.given.get(plan)
        return float(self.usual.get(plan, 0.0) * self.times if given is None else given)

    def take(self, fit: Fit) -> None:
        """Remember the lines of a plan."""
        self.used.update(map(self._hubs, fit.pairs))

    def leave(self, fit: Fit) -> None:
        """Forget the lines of a plan, of which another fit is looked for."""
        self.used.difference_update(map(self._hubs, fit.pairs))

    def _hubs(self, pair: tuple[int, int]) -> tuple[int, int]:
        """Return what stands for a line and all those that are nearly the same."""
        one, other = sorted(int(self.lines.hubs[node]) for node in pair)
        return one, other

    def best(self, shape: Shape, turn: float, part: float = 0.0) -> Fit | None:
        """Return where a shape fits best on a sheet turned so, radians, if such a part of it may be there."""
        return self.closest(shape, self.lay(shape, turn), part)

    def lay(self, shape: Shape, turn: float) -> _Laid:
        """Lay a shape in all ways that may be worth nearly as much as the best of them."""
        name = shape, turn, self.times
        if name not in self._laid:
            (self._laid[name],) = self.lay_all([shape], turn, CLOSE)
        return self._laid[name]

    def lay_all(
        self,
        shapes: Sequence[Shape],
        turn: float,
        within: float,
        part: float = 0.0,
        least: float = -math.inf,
        usually: bool = False,
    ) -> list[_Laid]:
        """Lay shapes of one plan in all ways that may be worth `least`, and nearly as much as the best of all.

        Only those of their usual size, or all.

        Parameters
        ----------
        within : float
            By how much less they may be worth than the best.
        part : float
            What part of a shape must be there, as far as lines that go out tell.
        """
        if not shapes:
            return []
        stack = _Stack(shapes)
        rows, origins, factors, most = self._ways(stack, turn, part, least, usually)
        nodes, done = np.zeros((len(most), stack.places.shape[1]), np.intp), 0
        worth, parts = np.zeros(len(most)), np.zeros(len(most))
        while done < len(most) and most[done] >= least:
            some = slice(done, done + AT_ONCE)
            nodes[some] = self.lines.near(origins[some, None] + factors[some, None] * stack.places[rows[some]])
            worth[some], parts[some] = self._worth(stack, rows[some], nodes[some], np.abs(factors[some]))
            done = min(done + AT_ONCE, len(most))
            least = max(least, worth[:done].max() - within)
        rows = np.where(parts[:done] >= part - UNSEEN, rows[:done], -1)
        found = [np.flatnonzero(rows == row) for row in range(len(shapes))]
        return [
            _Laid(origins[own], factors[own], nodes[own, : len(shape.marks)], worth[own], parts[own])
            for shape, own in zip(shapes, found, strict=True)
        ]

    def _worth(self, stack: _Stack, rows: Indices, nodes: Indices, per_unit: Floats) -> tuple[Floats, Floats]:
        """Return what ways to lay shapes, of these rows of a stack, may be worth, and what part of each may be there.

        Nodes beside those of their lines count as well.
        """
        one, other = (np.take_along_axis(nodes, side[rows], 1) for side in (stack.tails, stack.tips))
        weights = np.where(stack.sizes[rows] * per_unit[:, None] < SHORT, 0.0, stack.weights[rows])
        whole = weights.sum(axis=1)
        there = (weights * self.lines.joined(one, other, loosely=True)).sum(axis=1)
        worth = (1.0 + ABSENT) * there - ABSENT * whole + self._as_usual(stack.plan, per_unit)
        return worth, there / np.maximum(whole, SMALL)

    def closest(self, shape: Shape, laid: _Laid, part: float = 0.0) -> Fit | None:
        """Return the best of the ways in which a shape is laid, looked at closely; of which a part may be there."""
        looks, worth = dict[bytes, int](), laid.worth
        for at in np.argsort(-worth, kind="stable")[:MANY].tolist():
            if worth[at] < laid.most - CLOSE or len(looks) == KEPT:
                break
            nodes = laid.nodes[at]
            if laid.parts[at] >= part - UNSEEN:
                looks.setdefault(np.where(nodes < 0, nodes, self.lines.hubs[nodes]).tobytes(), at)
        some = [*looks.values()]
        fits = self.settled(shape, laid.origins[some], laid.factors[some])
        return max(fits, key=lambda fit: fit.worth, default=None)

    def _ways(
        self, stack: _Stack, turn: float, part: float, least: float, usually: bool
    ) -> tuple[Indices, Complex, Complex, Floats]:
        """Return ways to lay shapes so that one of their long vectors lies on a line; few by those that say most.

        Their rows in the stack, origins, factors, and what each may be worth at the most, which is `least` at the
        least: the most promising ones first, and no more than are looked at.
        """
        rows, ats, angles, (begin, end) = self._generators(stack, turn, usually)
        sizes, counts, expected = stack.sizes[rows, ats], (end - begin).sum(axis=1), self.expected(stack.plan)
        found = [(np.zeros(0, np.intp), np.zeros(0, np.intp), np.zeros(0))]
        for some in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(np.cumsum(counts) // BLOCK)) + 1):
            own, pairs = self.lines.within((begin[some], end[some]))
            drawn, of = self.lines.sizes[pairs], some[own]
            off = np.abs(self.lines.angles[pairs] - angles[of])
            good = np.minimum(off, math.tau - off) < math.radians(DEGREES) + ASTRAY / drawn
            if expected and not usually and stack.plan not in self.given:
                off = np.abs(drawn * (expected / sizes)[of] - 1.0)
                longest = drawn * (stack.longest[rows] / sizes)[of]
                good &= (longest > LEAST) | (off * drawn < SAME_MU * drawn + ASTRAY)
            own, pairs = own[good], pairs[good]
            likely, most = self._at_most(stack, turn, (rows[some], ats[some]), own, pairs, part, least)
            found.append((some[own[likely]], pairs[likely], most))
        own, pairs, most = (np.concatenate(side) for side in zip(*found, strict=True))
        count = PROMISING * min(len(stack.flat), MANY_SHAPES)
        promise = most - stack.weights.sum(axis=1)[rows[own]]  # of large shapes and small ones alike
        if len(most) > count:
            likely = np.flatnonzero(promise >= np.partition(promise, -count)[-count])
            likely = likely[np.argsort(-promise[likely], kind="stable")[:count]]
            own, pairs, most = own[likely], pairs[likely], most[likely]
        order = np.argsort(-most, kind="stable")
        own, pairs, rows, ats = own[order], pairs[order], rows[own[order]], ats[own[order]]
        factors = cmath.rect(1.0, turn) * (self.lines.sizes[pairs] / sizes[own])
        marks = stack.places[rows, stack.tails[rows, ats]] + stack.places[rows, stack.tips[rows, ats]]
        nodes = self.lines.nodes[self.lines.first[pairs]] + self.lines.nodes[self.lines.second[pairs]]
        return rows, np.asarray((nodes - factors * marks) / 2.0), np.asarray(factors), most[order]

    def _generators(
        self, stack: _Stack, turn: float, usually: bool
    ) -> tuple[Indices, Indices, Floats, tuple[Indices, Indices]]:
        """Return the lines by which to lay shapes: rows of a stack and places there; directions, ranges of pairs."""
        given, expected = self.given.get(stack.plan), self.expected(stack.plan)
        rows, ats = np.nonzero(stack.sizes >= GENERATOR * stack.longest[:, None])
        sizes, angles = stack.sizes[rows, ats], (stack.angles[rows, ats] + turn) % math.tau
        per_mm = sizes / stack.longest[rows]
        low, high = np.full(len(rows), -1.0), np.full(len(rows), -1.0)
        if expected:  # a vector of its usual size
            low = np.maximum((sizes / expected - ASTRAY) / (1.0 + SAME_MU), SMALLEST * per_mm)
            high = np.minimum((sizes / expected + ASTRAY) / (1.0 - SAME_MU), LARGEST * per_mm)
        if given is None and not usually:
            free = ~stack.flat[rows] | (expected == 0.0)  # one line has a direction, and any length
            high = np.where(free, LARGEST * per_mm, high)
            low = np.where(free, np.minimum(np.where(low > 0.0, low, np.inf), LEAST * per_mm), low)
        within = np.minimum(math.radians(DEGREES) + ASTRAY / np.maximum(low, ASTRAY), math.radians(WIDEST))
        begin, end = self.lines.ranges(angles, within, low, high)
        counts = (end - begin).sum(axis=1)
        some = np.flatnonzero(counts)
        some = some[np.lexsort((counts[some], rows[some]))]
        place = np.arange(len(some)) - np.searchsorted(rows[some], rows[some])
        some = some[(place < (FEW if usually else LAID)) & ((place == 0) | (counts[some] < CROWD))]
        return rows[some], ats[some], angles[some], (begin[some], end[some])

    def _at_most(
        self,
        stack: _Stack,
        turn: float,
        generators: tuple[Indices, Indices],
        own: Indices,
        pairs: Indices,
        part: float,
        least: float,
    ) -> tuple[Indices, Floats]:
        """Return which ways may be worth `least`, and have such a `part`, and what each may be worth at the most.

        They lay a shape, the row of a stack, by one of its lines, both as given by generators, on a pair of nodes: what
        does not go out there is not there. The numbers of their generators ascend.
        """
        rows, ats = generators
        each, counts = np.arange(len(rows)), np.bincount(own, minlength=len(rows))
        sizes, weights = stack.sizes[rows] / stack.sizes[rows, ats][:, None], stack.weights[rows]
        drawn = self.lines.sizes[pairs]
        usual = self._as_usual(stack.plan, drawn / np.repeat(stack.sizes[rows, ats], counts))
        whole, lacks = np.repeat(weights.sum(axis=1), counts), np.zeros(len(own))
        for line in np.argsort(sizes, axis=1).T:
            if not len(drawn) or sizes[each, line].min() * drawn.min() >= SHORT:
                break
            shown = drawn * np.repeat(sizes[each, line], counts) >= SHORT
            whole -= np.where(shown, 0.0, np.repeat(weights[each, line], counts))
        sizes, weights = np.tile(sizes, 2), np.tile(weights, 2)
        angles = np.concatenate((stack.angles[rows] + turn, stack.angles[rows] + turn + math.pi), axis=1)
        ways = (np.floor(angles * (WAYS / math.tau)) % WAYS).astype(np.intp)
        marks = np.concatenate((stack.tails[rows], stack.tips[rows]), axis=1)
        others = (np.arange(len(weights.T)) % len(stack.sizes.T) != ats[:, None]) & (weights > 0.0)
        log_drawn, log_sizes = np.log(drawn), np.log(np.maximum(sizes, SMALL))
        ends = stack.tails[rows, ats], stack.tips[rows, ats]
        for end, side in zip(ends, (self.lines.first, self.lines.second), strict=True):
            meets, hubs = others & (marks == end[:, None]), self.lines.hubs[side[pairs]] * WAYS
            for line in np.argsort(~meets, axis=1, kind="stable").T[: meets.sum(axis=1).max(initial=0)]:
                logarithms = log_drawn + np.repeat(log_sizes[each, line], counts)
                lengths = self.lines.outward[hubs + np.repeat(ways[each, line], counts)]
                gone = (lengths >> length_of(logarithms) & 1 == 0) & (logarithms > math.log(SURELY))
                lacks += gone * np.repeat(np.where(meets, weights, 0.0)[each, line], counts)
        most = usual + whole - (1.0 + ABSENT) * lacks
        good = np.flatnonzero((most >= least) & (lacks <= (1.0 - part + UNSEEN) * whole))
        return good, most[good]

    def _as_usual(self, plan: str, per_unit: Floats) -> Floats:
        """Return what it is worth that plans are drawn to their usual scale, by mm per unit."""
        expected = self.expected(plan)
        if not expected:
            return np.zeros(len(per_unit))
        return USUAL * np.maximum(0.0, 1.0 - (np.abs(per_unit * expected - 1.0) / SAME_MU) ** 2)

    def settled(self, shape: Shape, origins: Complex, factors: Complex) -> Iterator[Fit]:
        """Go through fits, moved to where they fit best: the squares of what their points miss are least."""
        squares, sizes = factors / np.abs(factors), np.abs(shape.spans)
        tails, tips = shape.tails[shape.lines], shape.tips[shape.lines]
        ends_of = (tails[:, None] == np.arange(len(shape.marks))) | (tips[:, None] == np.arange(len(shape.marks)))
        for _ in range(3):
            nodes, usual = self.nodes_of(origins[:, None] + factors[:, None] * shape.places), np.abs(factors)
            there = self.lines.joined(nodes[:, tails], nodes[:, tips])
            ends = (there[:, :, None] & ends_of).any(axis=1)
            count = np.maximum(ends.sum(axis=1, keepdims=True), 1)
            drawn = np.where(ends, self.lines.nodes[nodes], 0.0)
            about, middle = (x.sum(axis=1, keepdims=True) / count for x in (ends * shape.places, drawn))
            off = ends * (shape.places - about)
            found = ((drawn - middle) * off.conj()).sum(axis=1) / np.maximum((np.abs(off) ** 2).sum(axis=1), SMALL)
            moved = (found != 0.0) & (np.abs(np.angle(found / factors)) <= SKEW)
            origins = np.where(moved, (middle - found[:, None] * about)[:, 0], origins)
            factors = np.where(moved, found, factors)
        weights = np.where(sizes * usual[:, None] < SHORT, 0.0, shape.weights)
        one, other = nodes[:, tails], nodes[:, tips]
        for way, line in np.argwhere(~there & (weights > 0.0) & (one >= 0) & (other >= 0) & (one != other)).tolist():
            start, stop = self.lines.nodes[[one[way, line], other[way, line]]].tolist()
            there[way, line] = self.lines.covers(start, stop)
        worth = np.where(there, weights, -ABSENT * weights).sum(axis=1) + self._as_usual(shape.plan, usual)
        for at, square in enumerate(squares.tolist()):
            senses, letters = self._senses(shape, nodes[at]) * there[at], self._lettered(shape, nodes[at])
            place = complex(origins[at]), complex(factors[at])
            fit = Fit(shape, *place, nodes[at], there[at], float(worth[at]), weights[at], senses, letters)
            drawn_by = zip(fit.pairs, fit.weights[fit.there].tolist(), strict=True)
            again = AGAIN * sum(weight for pair, weight in drawn_by if self.used and self._hubs(pair) in self.used)
            pairs = np.array([pair for pair in fit.pairs if pair[0] != pair[1]], np.intp).reshape(-1, 2)
            on = self.lines.go_on(pairs.T.ravel(), pairs[:, ::-1].T.ravel())
            free = 1.0 - float(on.mean()) if len(on) else 0.0
            skew = min(1.0, (cmath.phase(fit.factor / square) / ASKEW) ** 2)
            yield replace(fit, worth=fit.worth - again + fit.told + FREE * (free - skew))

    def _senses(self, shape: Shape, nodes: Indices) -> Floats:
        """Return for each line of a shape laid on nodes whether arrowheads on it point as they should: 1, -1 or 0."""
        found = np.zeros(len(shape.lines))
        if not self.arrows:
            return found
        ends = zip(nodes[shape.tails[shape.lines]].tolist(), nodes[shape.tips[shape.lines]].tolist(), strict=True)
        for at, (one, other) in enumerate(ends):
            if one >= 0 and other >= 0 and one != other and not shape.both[at]:
                way = complex(self.lines.nodes[other] - self.lines.nodes[one])
                found[at] = self._points_along(other, way) - self._points_along(one, -way)
        return found

    def _points_along(self, node: int, way: complex) -> bool:
        """Whether an arrowhead at a node points along a way."""
        ways = self.arrows.get(int(self.lines.hubs[node]), ())
        return any((one * way.conjugate()).real >= math.cos(POINTED) * abs(way) for one in ways)

    def _lettered(self, shape: Shape, nodes: Indices) -> int:
        """Return how many letters stand at the points of a shape that they name, less those that stand at others."""
        known = [(at, text) for at, text in enumerate(shape.letters) if nodes[at] >= 0 and text in self.letters]
        if not known:
            return 0
        found, places = 0, self.lines.nodes[nodes[nodes >= 0]]
        for at, text in known:
            for place, height in self.letters[text]:
                apart = abs(place - self.lines.nodes[nodes[at]])
                if apart < BY * height:
                    found += 1
                elif apart > AWAY * height and np.abs(places - place).min() < BY * height:
                    found -= 1
        return found

    @cached_property
    def letters(self) -> dict[str, list[tuple[complex, float]]]:
        """Where letters stand that name a point of a plan, and how high they are: by their text, without primes."""
        found = dict[str, list[tuple[complex, float]]]()
        for letter in self.drawn.letters:
            text = "".join(filter(str.isalnum, latin(letter.text)))
            if 0 < len(text) <= LETTERS and text == text.lower():
                found.setdefault(text, []).append((letter.place, letter.height))
        return found

    @cached_property
    def arrows(self) -> dict[int, list[complex]]:
        """The unit directions of arrowheads by the hubs of the nodes at which they are."""
        found = dict[int, list[complex]]()
        tails, tips = (side[self.drawn.arrows] for side in (self.drawn.tails, self.drawn.tips))
        for node, way in zip(self.lines.near(tips).tolist(), (tips - tails).tolist(), strict=True):
            if node >= 0 and way:
                found.setdefault(int(self.lines.hubs[node]), []).append(way / abs(way))
        return found

    def evident(self, fit: Fit, expected: bool) -> bool:
        """Whether a plan is drawn where it fits, and not found by chance in the lines of a table, a frame, a ruler.

        These run along the edges of the sheet and meet one another; lines of a scheme are cut by what stands on them.
        Arrowheads or letters tell a plan, or that it has lines askew to the sheet and to one another. One that is
        `expected` may be a single line, along the edges if nothing else meets it.
        """
        named = sum(map(bool, fit.shape.letters))
        drawn_by = zip(fit.pairs, fit.weights[fit.there].tolist(), strict=True)
        others = sum(weight for pair, weight in drawn_by if named and self._hubs(pair) in self.used)
        if not fit.lines or 2.0 * others > fit.lines:  # of points alone no two plans have lines together
            return False
        told = float(fit.senses @ fit.weights) / fit.lines, fit.letters / max(named, 1)
        if max(told) >= POINTED_OUT or (expected and ((fit.senses > 0.0).any() or fit.letters > 0)):
            return True
        spans = fit.shape.spans[fit.there] * fit.factor
        longest = complex(spans[np.abs(spans).argmax()])
        askew = np.minimum(np.abs(spans.real), np.abs(spans.imag)) > np.maximum(ALONG * np.abs(spans), SHORT)
        if askew.any() and (expected or np.abs(cross(longest, spans)).max() > SHORT * abs(longest)):
            return True
        ends = self.lines.nodes[np.array(fit.pairs, np.intp).reshape(-1, 2)]
        return expected and self.lines.stand_free(*ends.T)

    def nodes_of(self, places: Complex) -> Indices:
        """Return the nodes of marks: near enough, or -1."""
        nodes = self.lines.near(places)
        apart = np.abs(self.lines.nodes[nodes] - places)
        return np.where((nodes >= 0) & (apart <= NEAR), nodes, -1)

    def points(self, fit: Fit) -> dict[int, complex]:
        """Return where the marks of a plan are drawn: where the lines that go out from them end."""
        shape, found = fit.shape, dict[int, complex]()
        for mark in np.flatnonzero(fit.nodes >= 0).tolist():
            node = complex(self.lines.nodes[fit.nodes[mark]])
            place = fit.origin + fit.factor * complex(shape.places[mark])
            here = fit.there & ((shape.tails[shape.lines] == mark) | (shape.tips[shape.lines] == mark))
            outward = np.where(shape.tails[shape.lines[here]] == mark, 1.0, -1.0)
            spans = outward * shape.spans[here] * fit.factor
            spans = spans[np.abs(spans) >= SHORT]
            end = self.lines.end(place, spans / np.abs(spans)) if len(spans) else None
            found[mark] = node if end is None else end
        return found
