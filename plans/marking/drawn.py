"""A student's own drawing of the plans read back: which line is which vector, wherever the poles were put.

Of a drawing nothing is known but its lines: no names, no scale factors, no order. What may be drawn is known: the plan
of the right construction, and that of every construction with one rule broken. Each is laid on the drawing wherever one
of its long vectors finds a line of its direction; the plan of which most vectors are joined by lines is the one drawn.
Its points are then those of the student: what is measured is what was drawn.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...scales.names import latin
from ..board import POSITION
from ..mistakes.book import Book
from ..names import LEVER, role
from .answers import Answer
from .key import Key
from .lines import Complex, Floats, Indices, Lines, lines_of
from .ways import RIGHT, Shape, edges_of, shape_of, shapes_of

MEASURED, DIRECTED = 3.0, 8.0  # mm from which a vector can be measured, and shows a direction
ALONE = 0.5  # how sure of a line is who has nothing beside it
SHORT = 1.5  # mm below which a vector shows nothing
LEAST, LARGEST = 20.0, 1500.0  # mm, the longest vector of a plan
SMALLEST = 6.0  # of one that is of its usual size
GENERATOR = 0.3  # part of the longest vector of a plan that a vector must have to lay the plan by
ASTRAY = 0.5  # mm that ends of lines may be astray, which turns short ones
DEGREES = 0.4  # by which lines may miss their direction besides
NEAR = 0.8  # mm from where a point should be to where it is, once the plan lies where it fits best
LAID, FEW = 2, 4  # vectors by which a plan is laid; of so many those that few lines may be
MANY = 200  # places of a plan, the best ones, of which those that differ are sought
KEPT, CLOSE = 12, 1.5  # of which so many are looked at closely, worth no less than the best by more than so much
PROMISING, AT_ONCE = 1500, 250  # ways to lay a plan that are looked at, the most promising ones first; at once
SURELY = 7.0  # mm from which a vector surely has a direction
DOUBT = 4.0  # by how much less than others a wrong plan may seem to be worth before it is looked at closely
LIKELY = 6  # mistakes of which all plans are laid
SHAPES = 12  # wrong plans of which so many are looked at closely
UNTOLD = 3.0  # vectors of right plans that are too few to tell how the sheet is turned
TELLING = 3.0  # lines of a plan that tells how the sheet is turned
RESIZED = 8.0  # of plans that tell that a drawing is larger than the sheet
MANY_LINES = 5.0  # of a plan that is not found by chance, of whatever size
EVIDENT = 0.3  # vectors that a mistake must explain beyond those that the right plans do
ABSENT = 0.5  # what a vector that is not there costs, of what one is worth that is
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
ALL = 0.02  # part of a plan that may lack where it counts as the right one
OTHER = 2.0  # vectors more than the mistake that explains all plans must a mistake of one plan explain
ENOUGH = 0.7  # part of a plan that must be there
SKEW = math.radians(2.0)  # by which a plan may be turned against the sheet
TURNS = tuple(math.pi / 2.0 * quarter for quarter in range(4))


@dataclass(frozen=True, slots=True)
class Letter:
    """A text of a drawing: its middle and its height, mm."""

    text: str
    place: complex
    height: float


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """What a drawing holds, in millimetres of paper, y up: segments as they were found, complex of shape (N,).

    `arrows` are the indices of those that have an arrowhead at their tip.
    """

    tails: Complex
    tips: Complex
    letters: tuple[Letter, ...] = ()
    arrows: Indices = field(default_factory=lambda: np.zeros(0, np.intp))


@dataclass(frozen=True, slots=True)
class Found:
    """A vector as the student has drawn it, from `tail` to `tip` in mm of the drawing, on a plan; 0 to 1 how surely."""

    tail: complex
    tip: complex
    plan: str
    certainty: float


@dataclass(frozen=True, slots=True)
class FoundPlan:
    """Where a plan lies: SI per mm, by how much it is turned (radians), where its pole is.

    `quality` is the part of its vectors that are drawn, 0 to 1; `mistake` the number of the rule that it breaks, if
    any; a plan `alone` is a single line.
    """

    mu: float
    turn: float
    pole: complex
    quality: float
    mistake: str = ""
    alone: bool = False


@dataclass(frozen=True, slots=True)
class Recognised:
    """What was found in a drawing: plans, vectors by the names of their quantities, and names of those not found."""

    plans: Mapping[str, FoundPlan]
    vectors: Mapping[str, Found]
    missing: tuple[str, ...]

    @property
    def quality(self) -> float:
        """What part of all plans is drawn, 0 to 1: little of a drawing of something else."""
        known = [plan.quality for plan in self.plans.values()]
        return sum(known) / len(known) if known else 0.0

    def answers(self) -> Iterator[Answer]:
        """Go through what the drawing says of each vector: its segment, scale factor and direction.

        Nothing of those too short to be measured; no direction of those too short to show one, and of lines that stand
        alone, which show no sense without arrowheads.
        """
        for name, found in self.vectors.items():
            plan, way = self.plans[found.plan], found.tip - found.tail
            if abs(way) >= MEASURED:
                turned = cmath.phase(way * cmath.rect(1.0, -plan.turn))
                shown = turned if abs(way) >= DIRECTED and not plan.alone else None
                yield Answer(name, mm=abs(way), mu=plan.mu, direction=shown)


def recognise(drawn: Drawn, key: Key, book: Book | None = None, mus: Mapping[str, float] | None = None) -> Recognised:
    """Find the plans of a key in a drawing.

    The `book` has the constructions with a rule broken; without it wrong plans are found as far as they are right.
    `mus` are scale factors of plans that are given, SI per mm.
    """
    return _Search(drawn, _lines_of(drawn), key, book, dict(mus or {})).found()


def part_there(drawn: Drawn, key: Key) -> float:
    """Return what part of all lines of the right plans of a key may be in a drawing, 0 to 1, at a first look."""
    return _Search(drawn, _lines_of(drawn), key, None, {}).part_there()


@lru_cache(maxsize=1)  # a drawing is looked through for one variant after the other
def _lines_of(drawn: Drawn) -> Lines:
    return lines_of(drawn.tails, drawn.tips)


# Where it lies.


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
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
    """Ways to lay a shape: origins, factors, nodes of its marks, and what each may be worth."""

    origins: Complex
    factors: Complex
    nodes: Indices
    worth: Floats


@dataclass(eq=False)
class _Search:
    """The search for the plans of a key among lines; `used` are the lines that are vectors of plans already."""

    drawn: Drawn
    lines: Lines
    key: Key
    book: Book | None
    mus: dict[str, float]
    used: set[tuple[int, int]] = field(default_factory=set)
    common: int = RIGHT
    times: float = 1.0  # how many times the usual scale factors those of this drawing seem to be
    shapes: dict[str, tuple[Shape, ...]] = field(default_factory=dict)
    ways: dict[float, tuple[Indices, Floats]] = field(default_factory=dict)
    most: dict[str, float] = field(default_factory=dict)  # what each plan is worth at the most, however turned
    laid: dict[tuple[Shape, float, float], tuple[float, _Laid]] = field(default_factory=dict)

    @cached_property
    def plans(self) -> dict[str, Shape]:
        """The right plans with the most vectors first."""
        program, found = self.key.paper.program, list[Shape]()
        for plan in program.plans:
            shape = shape_of(plan, edges_of(program, plan), self.key.values)
            if plan != POSITION and role(plan).kind != LEVER and shape is not None and shape.longest:
                found.append(shape)
        return {shape.plan: shape for shape in sorted(found, key=lambda shape: -len(shape.lines))}

    def found(self) -> Recognised:
        """Lay all plans, and name what they find."""
        fits = self._fits()
        plans, vectors = dict[str, FoundPlan](), dict[str, Found]()
        asked = {n: q for n, q in self.key.questions.items() if q.vector and q.plan in self.plans}
        for plan, fit in fits.items():
            mistake = ""
            if not fit.shape.right and self.book is not None:
                number = self.common if self.common in fit.shape.broken else fit.shape.broken[0]
                mistake = self.book.signatures[number].broken.mistake
            pole, alone = complex(fit.origin), fit.shape.flat and not fit.senses.any()
            plans[plan] = FoundPlan(fit.mu, cmath.phase(fit.factor), pole, fit.quality, mistake, alone)
            vectors |= {n: one for n, one in self._vectors(fit).items() if n in asked and asked[n].plan == plan}
        return Recognised(plans, vectors, tuple(name for name in asked if name not in vectors))

    def part_there(self) -> float:
        """Return what part of all lines of the right plans may be there, at a first look."""
        shapes = [shape for shape in self.plans.values() if not shape.flat]
        whole = sum(float(shape.weights.sum()) for shape in shapes)
        most = [0.0]
        for turn in TURNS:
            there = 0.0
            for shape in shapes:
                laid = self._lay(shape, turn)
                at = laid.nodes[laid.worth.argmax()][None, :] if len(laid.worth) else np.zeros((0, 0), np.intp)
                if len(at):
                    joined = self.lines.joined(at[:, shape.tails[shape.lines]], at[:, shape.tips[shape.lines]], True)
                    there += float(joined[0] @ shape.weights)
            most.append(there)
        return max(most) / whole if whole else 0.0

    def _fits(self) -> dict[str, _Fit]:
        """Return where each plan lies that is drawn: the right one, or one with a mistake that explains more of it.

        By how much the sheet is turned, a multiple of a right angle, the right plans tell as far as they are there.
        """
        right = {turn: [fit for shape in self.plans.values() if (fit := self._best(shape, turn))] for turn in TURNS}
        turn = max(TURNS, key=lambda turn: sum(fit.worth for fit in right[turn]))
        self._resized(right[turn])
        told = {turn: [fit for fit in right[turn] if self._told(fit)] for turn in TURNS}
        likely = max(sum(fit.worth for fit in fits) for fits in told.values()) - UNTOLD
        turns = [turn for turn in TURNS if sum(fit.worth for fit in told[turn]) >= likely]
        if len(turns) == 1 and max(fit.lines for fit in told[turns[0]]) >= TELLING:
            return self._at(turns[0])[0]
        turns = turns if 1 < len(turns) < len(TURNS) else self._turns(right)
        fits, _, self.common = max(map(self._at, turns), key=lambda found: found[1])
        return fits

    def _turns(self, right: Mapping[float, list[_Fit]]) -> list[float]:
        """Return how a sheet may be turned on which no plan is right: a plan that is all there may tell, if wrong."""
        turns = sorted(TURNS, key=lambda turn: -sum(fit.worth for fit in right[turn]))  # those after it take less long
        plan = next((plan for plan, shape in self.plans.items() if not shape.flat), None)
        if plan is None:
            return [*TURNS]
        whole = {turn: [fit.lines for fit in self._ways(plan, turn) if self._told(fit)] for turn in turns}
        lines = {turn: max(found, default=0.0) for turn, found in whole.items()}
        likely = max(lines.values()) - UNTOLD if max(lines.values()) >= MANY_LINES else 0.0
        return [turn for turn in TURNS if lines[turn] >= likely]

    def _resized(self, right: list[_Fit]) -> None:
        """See whether several plans are drawn so many times as large as on the sheet: then all may be."""
        ratios = {fit.shape.plan: fit.mu / usual for fit in right if (usual := self._expected(fit.shape.plan))}
        whole = [fit for fit in right if fit.shape.plan in ratios and fit.quality >= ENOUGH and not fit.shape.flat]
        alike = {
            ratio: [fit for fit in whole if abs(ratios[fit.shape.plan] / ratio - 1.0) < SAME_MU]
            for ratio in (1.0, *(ratios[fit.shape.plan] for fit in whole))
        }
        lines = {ratio: sum(fit.lines for fit in some) for ratio, some in alike.items() if len(some) > 1}
        ratio = max(lines, key=lambda ratio: lines[ratio], default=1.0)
        if abs(ratio - 1.0) > SAME_MU and lines[ratio] >= RESIZED:
            self.times = ratio

    def _told(self, fit: _Fit) -> bool:
        """Whether a plan is drawn as it fits, and not found so by chance: of its usual size, or of many lines."""
        return not fit.shape.flat and not fit.against and 1.0 - fit.quality <= ALL and self._by_size(fit)

    def _by_size(self, fit: _Fit) -> bool:
        """Whether a plan is of its usual size, or of so many lines that it may have any."""
        usual = self._expected(fit.shape.plan)
        return fit.lines >= MANY_LINES or (bool(usual) and abs(fit.mu / usual - 1.0) < SAME_MU)

    def _at(self, turn: float) -> tuple[dict[str, _Fit], float, int]:
        """Return where each plan lies on a sheet turned so, what all are worth, and which mistake is in them."""
        self.used.clear()
        fits: dict[str, _Fit] = {}
        doubtful: dict[str, list[_Fit]] = {}
        sure: dict[str, _Fit] = {}
        for plan, right in self.plans.items():
            fit = self._best(right, turn)
            if fit is not None and self._told(fit):
                self._take(fits, fit)
                sure[plan] = fit
            elif (not right.flat or (fit and fit.senses.min() < 0.0)) and (ways := self._ways(plan, turn)):
                doubtful[plan] = ways  # also a single line whose arrowhead points the other way
        self.common = self._common(doubtful, sure, turn) if doubtful else RIGHT
        for ways in doubtful.values():
            usual = next((fit for fit in ways if fit.shape.explained(self.common)), ways[0])
            best = max(filter(self._by_size, ways), key=lambda fit: fit.worth, default=usual)
            chosen = best if best.worth > usual.worth + OTHER else usual
            by_chance = self.arrows and not (self._by_size(chosen) or chosen.senses.any())
            if chosen.quality >= ENOUGH and not by_chance:
                self._take(fits, chosen)
        for plan in [plan for plan in self.plans if plan not in doubtful and plan not in sure]:
            # one line follows from the others
            shapes = [shape for shape in self._shapes(plan) if shape.explained(self.common)]
            found = [fit for shape in shapes if (fit := self._best(shape, turn)) is not None and fit.quality >= ENOUGH]
            if found:
                self._take(fits, max(found, key=lambda fit: fit.worth))
        worth = sum(fit.worth for fit in fits.values() if not fit.shape.flat)
        if all(fit.shape.flat for fit in fits.values()) and not all(right.flat for right in self.plans.values()):
            fits = {}  # single lines are on any drawing
        return fits, worth, self.common

    def _shapes(self, plan: str) -> tuple[Shape, ...]:
        """Return all ways in which a plan may be drawn."""
        if plan not in self.shapes:
            self.shapes[plan] = shapes_of(self.key, self.book, plan)
        return self.shapes[plan]

    def _ways(self, plan: str, turn: float) -> list[_Fit]:
        """Return where the shapes of a plan fit best, the right one first, as far as they explain about as much."""
        right, *others = self._shapes(plan)
        fits = [fit for fit in [self._best(right, turn)] if fit is not None]
        most = max((fit.worth - fit.told for fit in fits), default=0.0)
        laid, least = list[tuple[_Laid, Shape]](), max(most, self.most.get(plan, most) - DOUBT) - OTHER - FREE
        for shape in others:
            laid.append((self._lay(shape, turn, least), shape))
            least = max(least, laid[-1][0].worth.max(initial=-math.inf) - DOUBT)
        laid.sort(key=lambda one: -one[0].worth.max(initial=-math.inf))
        for way, shape in laid:
            if way.worth.max(initial=-math.inf) + FREE < most - OTHER or len(fits) > SHAPES:
                break
            if (fit := self._closest(shape, way)) is not None:
                fits.append(fit)
                most = max(most, fit.worth - fit.told)
        self.most[plan] = max(most, self.most.get(plan, most))
        return fits

    def _common(self, doubtful: dict[str, list[_Fit]], sure: Mapping[str, _Fit], turn: float) -> int:
        """Return the number of the mistake by which most of all plans is explained, that of the right plans if none.

        Of the most likely ones all plans are laid that are not among the fits yet. What a mistake changes of a plan
        that is drawn right speaks against it.
        """
        drawn_right = {plan: frozenset(self._shapes(plan)[0].broken) for plan in sure}

        def worth(number: int) -> float:
            fits = ([fit.worth for fit in ways if fit.shape.explained(number)] for ways in doubtful.values())
            refuted = sum(number != RIGHT and number not in numbers for numbers in drawn_right.values())
            return sum(max(found, default=0.0) for found in fits) - OTHER * refuted

        numbers = sorted({number for ways in doubtful.values() for fit in ways for number in fit.shape.broken})
        likely = sorted(numbers, key=lambda number: -worth(number))[:LIKELY]
        for plan, ways in doubtful.items():
            laid = [fit.shape for fit in ways]
            for shape in self._shapes(plan):
                if shape not in laid and any(map(shape.explained, likely)):
                    ways.extend(fit for fit in [self._best(shape, turn)] if fit is not None)
        best = max(likely, key=worth, default=RIGHT)
        return best if best != RIGHT and worth(best) > worth(RIGHT) + EVIDENT else RIGHT

    def _take(self, fits: dict[str, _Fit], fit: _Fit) -> None:
        fits[fit.shape.plan] = fit
        self.used.update(map(self._hubs, fit.pairs))

    def _hubs(self, pair: tuple[int, int]) -> tuple[int, int]:
        """Return what stands for a line and all those that are nearly the same."""
        one, other = sorted(int(self.lines.hubs[node]) for node in pair)
        return one, other

    def _expected(self, plan: str) -> float:
        """Return the scale factor that a plan should have, SI per mm; zero where nobody knows."""
        given = self.mus.get(plan)
        return float(self.key.paper.mus.get(plan, 0.0) * self.times if given is None else given)

    def _best(self, shape: Shape, turn: float) -> _Fit | None:
        """Return where a shape fits best."""
        return self._closest(shape, self._lay(shape, turn))

    def _lay(self, shape: Shape, turn: float, least: float = -math.inf) -> _Laid:
        """Lay a shape in all ways that may be worth `least`, and tell what each may be worth.

        What lines go out where its long vector ends says how much a way may be worth at the most: the most promising
        ones are looked at, until no other is worth nearly as much.
        """
        kept = self.laid.get((shape, turn, self.times))
        if kept is not None and kept[0] <= least:
            return kept[1]
        origins, factors, most = self._laid(shape, turn)
        order = np.flatnonzero(most >= least)
        order = order[np.argsort(-most[order], kind="stable")][:PROMISING]
        nodes, worth, done = np.zeros((len(order), len(shape.marks)), np.intp), np.zeros(len(order)), 0
        while done < len(order) and (not done or most[order[done]] >= worth[:done].max() - CLOSE):
            some = slice(done, done + AT_ONCE)
            places = origins[order[some], None] + factors[order[some], None] * shape.places
            nodes[some] = self.lines.near(places)
            worth[some] = self._counted(shape, nodes[some], np.abs(factors[order[some]]), loosely=True)[0]
            done = min(done + AT_ONCE, len(order))
        laid = _Laid(origins[order[:done]], factors[order[:done]], nodes[:done], worth[:done])
        self.laid[shape, turn, self.times] = least, laid
        return laid

    def _closest(self, shape: Shape, laid: _Laid) -> _Fit | None:
        """Return the best of the ways in which a shape is laid, looked at closely."""
        best, seen, worth = None, set[bytes](), laid.worth
        for at in np.argsort(-worth, kind="stable")[:MANY]:
            if worth[at] < worth.max() - CLOSE or len(seen) == KEPT:
                break
            nodes = laid.nodes[at]
            if (look := np.where(nodes < 0, nodes, self.lines.hubs[nodes]).tobytes()) not in seen:
                seen.add(look)
                fit = self._settled(shape, complex(laid.origins[at]), complex(laid.factors[at]))
                if best is None or fit.worth > best.worth:
                    best = fit
        return best

    def _laid(self, shape: Shape, turn: float) -> tuple[Complex, Complex, Floats]:
        """Return all ways to lay a shape so that one of its long vectors lies on a line; few by those that say most.

        And what each may be worth at the most.
        """
        longest, lines = shape.longest, self.lines
        unit, given = cmath.rect(1.0, turn), self.mus.get(shape.plan)
        expected = self._expected(shape.plan)
        if given is None and shape.flat:
            given = expected or None  # one line has a direction, and any length
        ways: list[tuple[int, int, Indices, Floats]] = []
        long = [(at, span) for at, span in enumerate(shape.spans.tolist()) if abs(span) >= GENERATOR * longest]
        along = [(*self._along(cmath.phase(span) + turn), at, abs(span)) for at, span in long]
        for pairs, sizes, at, size in sorted(along, key=lambda one: len(one[0]))[:FEW]:
            drawn = sizes * (longest / size)
            usual = np.abs(sizes * expected / size - 1.0) < SAME_MU + ASTRAY / sizes
            good = ((drawn > LEAST) | (usual & (drawn > SMALLEST))) & (drawn < LARGEST)
            if given is not None:
                good &= np.abs(sizes - size / given) < ASTRAY + SAME_MU * sizes
            if good.any():
                ways.append((int(good.sum()), at, pairs[good], sizes[good]))
        ways.sort(key=lambda way: way[0])
        found = [(np.zeros(0, complex), np.zeros(0, complex), np.zeros(0))]
        for _, at, pairs, sizes in ways[:LAID]:
            factors = unit * sizes / abs(shape.spans[at])
            ends = lines.first[pairs], lines.second[pairs]
            middle = (shape.places[shape.tails[shape.lines[at]]] + shape.places[shape.tips[shape.lines[at]]]) / 2.0
            origins = (lines.nodes[ends[0]] + lines.nodes[ends[1]]) / 2.0 - factors * middle
            found.append((origins, factors, self._at_most(shape, at, ends, np.abs(factors), turn)))
        return tuple(np.concatenate([way[side] for way in found]) for side in range(3))  # type: ignore[return-value]

    def _at_most(self, shape: Shape, at: int, ends: tuple[Indices, Indices], per_unit: Floats, turn: float) -> Floats:
        """Return what ways to lay a shape, its line `at` between some nodes, may be worth by what goes out there."""
        tails, tips, spans = shape.tails[shape.lines], shape.tips[shape.lines], shape.spans
        worth = self._as_usual(shape.plan, per_unit)
        for line, (span, weight) in enumerate(zip(spans.tolist(), shape.weights.tolist(), strict=True)):
            sizes = abs(span) * per_unit
            worth += np.where(sizes < SHORT, 0.0, weight)
            shared = [
                (node, way)
                for mark, node in ((tails[at], ends[0]), (tips[at], ends[1]))
                for other, way in ((tails[line], span), (tips[line], -span))
                if mark == other and line != at
            ]
            for node, way in shared:
                lacks = ~self.lines.goes_out(node, cmath.phase(way) + turn) & (sizes > SURELY)
                worth -= (1.0 + ABSENT) * weight * lacks
        return worth

    def _as_usual(self, plan: str, per_unit: Floats) -> Floats:
        """Return what it is worth that plans are drawn to their usual scale, by mm per unit."""
        expected = self._expected(plan)
        if not expected:
            return np.zeros(len(per_unit))
        return USUAL * np.maximum(0.0, 1.0 - (np.abs(per_unit * expected - 1.0) / SAME_MU) ** 2)

    def _along(self, angle: float) -> tuple[Indices, Floats]:
        """Return the pairs of nodes joined along a direction, as nearly as lines are drawn; and how far apart each is.

        Vectors of most shapes have directions of the right plan: they are looked for once.
        """
        own = round(angle % math.tau, 6)
        if own not in self.ways:
            lines = self.lines
            pairs = lines.along(angle, math.radians(4.0))
            off = np.abs((lines.angles[pairs] - angle + math.pi) % math.tau - math.pi)
            pairs = pairs[off < math.radians(DEGREES) + ASTRAY / lines.sizes[pairs]]
            self.ways[own] = pairs, lines.sizes[pairs]
        return self.ways[own]

    def _counted(
        self, shape: Shape, nodes: Indices, per_unit: Floats, loosely: bool = False
    ) -> tuple[Floats, Any, Floats]:
        """Return for marks at nodes, of shape (ways, marks): what it is worth, which lines are there, their weights."""
        one, other = nodes[:, shape.tails[shape.lines]], nodes[:, shape.tips[shape.lines]]
        there = self.lines.joined(one, other, loosely)
        sizes = np.abs(shape.spans)[None, :] * per_unit[:, None]
        weights = np.where(sizes < SHORT, 0.0, shape.weights)
        worth = np.where(there, weights, -ABSENT * weights).sum(axis=1)
        return worth + self._as_usual(shape.plan, per_unit), there, weights

    def _settled(self, shape: Shape, origin: complex, factor: complex) -> _Fit:
        """Return a fit, moved to where it fits best: the squares of what its points miss are least."""
        square = factor / abs(factor)
        for _ in range(3):
            places = origin + factor * shape.places
            nodes = self._nodes(places)
            worth, there, weights = self._counted(shape, nodes[None, :], np.array([abs(factor)]))
            ends = np.unique(np.concatenate((shape.tails[shape.lines][there[0]], shape.tips[shape.lines][there[0]])))
            if len(ends) < 2:
                break
            at, drawn = shape.places[ends], self.lines.nodes[nodes[ends]]
            about, middle = at - at.mean(), drawn - drawn.mean()
            found = complex((middle * about.conj()).sum() / (np.abs(about) ** 2).sum())
            if not found or abs(cmath.phase(found / factor)) > SKEW:
                break
            factor, origin = found, complex(drawn.mean() - found * at.mean())
        there, lacking = there[0], ~there[0] & (weights[0] > 0.0)
        for at in np.flatnonzero(lacking):
            one, other = int(nodes[shape.tails[shape.lines[at]]]), int(nodes[shape.tips[shape.lines[at]]])
            if one >= 0 and other >= 0 and one != other:
                there[at] = self.lines.covers(self.lines.nodes[one], self.lines.nodes[other])
        gained = (1.0 + ABSENT) * float(weights[0][there & lacking].sum())
        senses = self._senses(shape, nodes) * there
        letters = self._lettered(shape, nodes)
        fit = _Fit(shape, origin, factor, nodes, there, float(worth[0]) + gained, weights[0], senses, letters)
        again = sum(
            AGAIN * weight
            for pair, weight in zip(fit.pairs, fit.weights[fit.there], strict=True)
            if self._hubs(pair) in self.used
        )
        both = [end for pair in fit.pairs for end in (pair, pair[::-1]) if pair[0] != pair[1]]
        free = sum(not self.lines.goes_on(*end) for end in both) / len(both) if both else 0.0
        skew = min(1.0, (cmath.phase(fit.factor / square) / ASKEW) ** 2)
        return replace(fit, worth=fit.worth - again + fit.told + FREE * (free - skew))

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
            if len(text) <= LETTERS and text == text.lower():
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

    def _nodes(self, places: Complex) -> Indices:
        """Return the nodes of marks: near enough, or -1."""
        nodes = self.lines.near(places)
        apart = np.abs(self.lines.nodes[nodes] - places)
        return np.where((nodes >= 0) & (apart <= NEAR), nodes, -1)

    def _vectors(self, fit: _Fit) -> dict[str, Found]:
        """Return the vectors of a plan by name, where they are drawn."""
        shape, found = fit.shape, dict[str, Found]()
        line_of = {
            frozenset((int(shape.tails[at]), int(shape.tips[at]))): there
            for at, there in zip(shape.lines, fit.there, strict=True)
        }
        points = self._points(fit)
        against = (
            shape.flat and fit.senses @ fit.weights < 0.0
        )  # of a plan that is one line the arrowheads say where it goes
        for name, tail, tip in zip(shape.names, shape.tails.tolist(), shape.tips.tolist(), strict=True):
            one, other = int(fit.nodes[tail]), int(fit.nodes[tip])
            size = abs(shape.places[tip] - shape.places[tail]) * abs(fit.factor)
            if name in found or size < SHORT or one < 0 or other < 0:
                continue
            sure = fit.quality * (ALONE if shape.flat else 1.0) * (1.0 if line_of[frozenset((tail, tip))] else 0.5)
            ends = points[tail], points[tip]
            found[name] = Found(*(ends[::-1] if against else ends), shape.plan, sure)
        return found

    def _points(self, fit: _Fit) -> dict[int, complex]:
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
