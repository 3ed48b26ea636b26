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
from dataclasses import dataclass, field
from functools import cached_property, lru_cache

from ..board import POSITION
from ..mistakes.book import Book
from ..names import LEVER, role
from .answers import Answer
from .elsewhere import elsewhere
from .key import Key
from .laying import FREE, SAME_MU, SHORT, USUAL, Fit, Laying
from .lines import Drawn, Lines, lines_of
from .ways import RIGHT, Shape, edges_of, shape_of, shapes_of

MEASURED, DIRECTED = 3.0, 8.0  # mm from which a vector can be measured, and shows a direction
ALONE = 0.5  # how sure of a line is who has nothing beside it
DOUBT = 4.0  # by how much less than others a wrong plan may seem to be worth before it is looked at closely
LIKELY = 6  # mistakes of which all plans are laid
SHAPES = 12  # wrong plans of which so many are looked at closely
UNTOLD = 3.0  # vectors of right plans that are too few to tell how the sheet is turned
TELLING = 0.5  # part of the lines of all plans that tells it where they are right
RESIZED = 8.0  # lines of plans that tell that a drawing is larger than the sheet
MANY_LINES = 5.0  # of a plan that is not found by chance, of whatever size
EVIDENT = 0.3  # vectors that a mistake must explain beyond those that the right plans do
ALL = 0.02  # part of a plan that may lack where it counts as the right one
OTHER = 2.0  # vectors more than the mistake that explains all plans must a mistake of one plan explain
MUCH = 0.2  # part of a plan that may lack where a known mistake explains it: else its points may be elsewhere
ENOUGH = 0.7  # part of a plan that must be there
TURNS = tuple(math.pi / 2.0 * quarter for quarter in range(4))


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
    return _Search(key, book, _laying(drawn, key, mus or {})).found()


def part_there(drawn: Drawn, key: Key, least: float = 0.0) -> float:
    """Return what part of all lines of the right plans of a key may be in a drawing, 0 to 1, at a first look.

    Of less than `least` it is not said how much less.
    """
    return _Search(key, None, _laying(drawn, key, {})).part_there(least)


def _laying(drawn: Drawn, key: Key, mus: Mapping[str, float]) -> Laying:
    return Laying(drawn, _lines_of(drawn), key.paper.mus, mus)


@lru_cache(maxsize=1)  # a drawing is looked through for one variant after the other
def _lines_of(drawn: Drawn) -> Lines:
    return lines_of(drawn)


@dataclass(eq=False)
class _Search:
    """The search for the plans of a key, which are laid on the lines of a drawing."""

    key: Key
    book: Book | None
    laying: Laying
    common: int = RIGHT
    usually: bool = False  # whether wrong plans are looked for at their usual size alone
    shapes: dict[str, tuple[Shape, ...]] = field(default_factory=dict)
    most: dict[str, float] = field(default_factory=dict)  # what each plan is worth at the most, however turned

    @cached_property
    def plans(self) -> dict[str, Shape]:
        """The right plans with the most vectors first."""
        program, found = self.key.paper.program, list[Shape]()
        for plan in program.plans:
            shape = shape_of(plan, edges_of(program, plan), self.key.values)
            if plan != POSITION and role(plan).kind != LEVER and shape is not None and shape.longest:
                found.append(shape)
        return {shape.plan: shape for shape in sorted(found, key=lambda shape: -len(shape.lines))}

    @cached_property
    def turns(self) -> tuple[float, ...]:
        """By how much the sheet may be turned, radians: as what is written on it, else by any right angles."""
        turn = self.laying.drawn.turn
        return TURNS if turn is None else (TURNS[turn],)

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

    def part_there(self, least: float) -> float:
        """Return what part of all lines of the right plans may be there, at a first look; see the function."""
        weights = {shape: float(shape.weights.sum()) for shape in self.plans.values() if not shape.flat}
        whole, most = sum(weights.values()), 0.0
        for turn in self.turns:
            may = whole
            for shape, weight in weights.items():
                spare = (may - least * whole) / weight if least else 1.0  # part of it that may lack
                may -= max(0.0, weight - self._lines_there(shape, turn, 1.0 - spare))
                if may < least * whole:
                    break
            most = max(most, may)
        return most / whole if whole else 0.0

    def _lines_there(self, shape: Shape, turn: float, part: float) -> float:
        """Return how many lines of a shape may be there, at a first look: of its usual size, else of any.

        0 if it is less than a part of them.
        """
        most = 0.0  # part of it
        for usually in (True, False):
            if most < 1.0 - ALL:
                (laid,) = self.laying.lay_all([shape], turn, 0.0, part, usually=usually)
                if len(laid.worth):
                    most = max(most, float(laid.parts[laid.worth.argmax()]))
        return most * float(shape.weights.sum())

    def _fits(self) -> dict[str, Fit]:
        """Return where each plan lies that is drawn: the right one, or one with a mistake that explains more of it.

        By how much the sheet is turned, a multiple of a right angle, the right plans tell where they are most of it.
        """
        laid = {t: [self.laying.best(shape, t, ENOUGH) for shape in self.plans.values()] for t in self.turns}
        right = {turn: [fit for fit in fits if fit is not None] for turn, fits in laid.items()}
        turn = max(self.turns, key=lambda turn: sum(fit.worth for fit in right[turn]))
        self._resized(right[turn])
        told = {turn: [fit for fit in right[turn] if self._told(fit)] for turn in self.turns}
        likely = max(sum(fit.worth for fit in fits) for fits in told.values()) - UNTOLD
        turns = [turn for turn in self.turns if sum(fit.worth for fit in told[turn]) >= likely]
        whole = sum(float(shape.weights.sum()) for shape in self.plans.values() if not shape.flat)
        if len(turns) == 1 and sum(fit.lines for fit in told[turns[0]]) >= TELLING * whole:
            return self._at(turns[0])[0]
        turns = self._turns(right, turns if likely > 0.0 else [])
        fits, _, self.common = max(map(self._at, turns), key=lambda found: found[1])
        return fits

    def _turns(self, right: Mapping[float, list[Fit]], likely: list[float]) -> list[float]:
        """Return how a sheet may be turned: as most of all plans of their usual size tell, with mistakes or without.

        Where that is little it is turned as right ones say is likely, or as one tells that is all there, of any size.
        Where none is, those of other sizes than the usual one would be found by chance.
        """
        plans = [plan for plan, shape in self.plans.items() if not shape.flat]
        whole = sum(float(self.plans[plan].weights.sum()) + USUAL for plan in plans)
        worth = dict.fromkeys(self.turns, 0.0)
        for turn, fits in right.items():
            most = dict.fromkeys(plans, 0.0) | {fit.shape.plan: fit.worth - fit.told for fit in fits}
            for plan in plans:
                laid = self.laying.lay_all(self._shapes(plan)[1:], turn, 0.0, ENOUGH, usually=True)
                worth[turn] += max([most[plan], *(way.most for way in laid)])
        if max(worth.values()) < ENOUGH * whole:
            if likely or not plans:
                return likely or [*self.turns]
            ways = {turn: self._ways(plans[0], turn, 1.0 - ALL) for turn in self.turns}
            lines = {t: max((fit.lines for fit in fits if self._told(fit)), default=0.0) for t, fits in ways.items()}
            self.usually = max(lines.values()) < MANY_LINES
            worth = worth if self.usually else lines
        return [turn for turn in self.turns if worth[turn] >= max(worth.values()) - UNTOLD]

    def _resized(self, right: list[Fit]) -> None:
        """See whether several plans are drawn so many times as large as on the sheet: then all may be."""
        ratios = {fit.shape.plan: fit.mu / usual for fit in right if (usual := self.laying.expected(fit.shape.plan))}
        whole = [fit for fit in right if fit.shape.plan in ratios and fit.quality >= ENOUGH and not fit.shape.flat]
        alike = {
            ratio: [fit for fit in whole if abs(ratios[fit.shape.plan] / ratio - 1.0) < SAME_MU]
            for ratio in (1.0, *(ratios[fit.shape.plan] for fit in whole))
        }
        lines = {ratio: sum(fit.lines for fit in some) for ratio, some in alike.items() if len(some) > 1}
        ratio = max(lines, key=lambda ratio: lines[ratio], default=1.0)
        if abs(ratio - 1.0) > SAME_MU and lines[ratio] >= RESIZED:
            self.laying.times = ratio

    def _told(self, fit: Fit) -> bool:
        """Whether a plan is drawn as it fits, and not found so by chance: of its usual size, or of many lines."""
        whole = not fit.shape.flat and not fit.against and 1.0 - fit.quality <= ALL
        return whole and self._by_size(fit) and self._evident(fit, fit.shape.right)

    def _evident(self, fit: Fit, expected: bool) -> bool:
        """Whether a plan is drawn and not found in other lines; it may be `expected` to be so, at its usual size."""
        return self.laying.evident(fit, expected and (self._usual(fit) or not self.laying.expected(fit.shape.plan)))

    def _by_size(self, fit: Fit) -> bool:
        """Whether a plan is of its usual size, or of so many lines that it may have any."""
        return fit.lines >= MANY_LINES or self._usual(fit)

    def _usual(self, fit: Fit) -> bool:
        """Whether a plan is of its usual size."""
        usual = self.laying.expected(fit.shape.plan)
        return bool(usual) and abs(fit.mu / usual - 1.0) < SAME_MU

    def _at(self, turn: float) -> tuple[dict[str, Fit], float, int]:
        """Return where each plan lies on a sheet turned so, what all are worth, and which mistake is in them."""
        self.laying.used.clear()
        fits: dict[str, Fit] = {}
        doubtful: dict[str, list[Fit]] = {}
        sure: dict[str, Fit] = {}
        for plan, right in self.plans.items():
            fit = self.laying.best(right, turn)
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
            sized = self._by_size(chosen) and (1.0 - chosen.quality <= ALL or self._usual(chosen))
            by_chance = self.laying.arrows and not (sized or chosen.senses @ chosen.weights > 0.0)
            mistaken = {number for fit in fits.values() if not fit.shape.right for number in fit.shape.broken}
            expected = chosen.shape.right or not mistaken.isdisjoint(chosen.shape.broken)
            if chosen.quality >= ENOUGH and not by_chance and self._evident(chosen, expected):
                self._take(fits, chosen)
        if not any(self.common in fit.shape.broken for fit in fits.values() if not fit.shape.right):
            self.common = RIGHT  # no plan that is drawn has the mistake
        for plan in [plan for plan in self.plans if plan not in doubtful and plan not in sure]:
            # one line follows from the others
            shapes = [shape for shape in self._shapes(plan) if shape.explained(self.common)]
            found = [
                fit
                for shape in shapes
                if (fit := self.laying.best(shape, turn)) is not None
                and fit.quality >= ENOUGH
                and self._evident(fit, expected=True)
            ]
            if found:
                self._take(fits, max(found, key=lambda fit: fit.worth))
        if self.book is not None:  # without it plans are found as far as they are right
            self._lead_on(fits, turn)
        worth = sum(fit.worth for fit in fits.values() if not fit.shape.flat)
        if all(fit.shape.flat for fit in fits.values()) and not all(right.flat for right in self.plans.values()):
            fits = {plan: fit for plan, fit in fits.items() if fit.told > 0.0}  # single lines are on any drawing
        return fits, worth, self.common

    def _lead_on(self, fits: dict[str, Fit], turn: float) -> None:
        """Take plans that no known mistake explains, and what is not yet found of right ones, with points elsewhere."""
        for plan, right in self.plans.items():
            fit = fits.get(plan)
            if right.flat or (fit is not None and 1.0 - fit.quality <= (ALL if fit.shape.right else MUCH)):
                continue
            if fit is not None:
                self.laying.leave(fit)
            led = elsewhere(self.laying, right, turn)
            if led is not None and led.lines > max(ENOUGH * right.weights.sum(), fit.lines if fit else 0.0):
                fit = fit if led.against or not self._evident(led, expected=False) else led
            if fit is not None:
                self._take(fits, fit)

    def _shapes(self, plan: str) -> tuple[Shape, ...]:
        """Return all ways in which a plan may be drawn."""
        if plan not in self.shapes:
            self.shapes[plan] = shapes_of(self.key, self.book, plan)
        return self.shapes[plan]

    def _ways(self, plan: str, turn: float, part: float = ENOUGH) -> list[Fit]:
        """Return where the shapes of a plan fit best, the right one first, as far as they explain about as much.

        Of each but the right one such a `part` must be there.
        """
        right, *others = self._shapes(plan)
        fits = [fit for fit in [self.laying.best(right, turn)] if fit is not None]
        most = max((fit.worth - fit.told for fit in fits), default=0.0)
        least = max(most, self.most.get(plan, most) - DOUBT) - OTHER - FREE
        laid = self.laying.lay_all(others, turn, DOUBT, part, least, usually=True)
        first = max(range(len(others)), key=lambda at: laid[at].most, default=None)
        fit = None if first is None else self.laying.closest(others[first], laid[first])
        whole = max((float(shape.weights.sum()) for shape in others), default=0.0)
        partly = fit is None or fit.quality < ENOUGH or fit.worth - fit.told < whole
        if partly and not self.usually:  # at another size more may be there
            least = least if fit is None else max(least, fit.worth - fit.told - OTHER - FREE)
            laid = self.laying.lay_all(others, turn, DOUBT, part, least)
        for way, shape in sorted(zip(laid, others, strict=True), key=lambda one: -one[0].most):
            if way.most + FREE < most - OTHER or len(fits) > SHAPES:
                break
            if (fit := self.laying.closest(shape, way)) is not None:
                fits.append(fit)
                most = max(most, fit.worth - fit.told)
        self.most[plan] = max(most, self.most.get(plan, most))
        return fits

    def _common(self, doubtful: dict[str, list[Fit]], sure: Mapping[str, Fit], turn: float) -> int:
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
            others = [s for s in self._shapes(plan) if s not in laid and any(map(s.explained, likely))]
            laid_of = self.laying.lay_all(others, turn, math.inf, ENOUGH, usually=self.usually)
            ways.extend(fit for fit in map(self.laying.closest, others, laid_of) if fit is not None)
        best = max(likely, key=worth, default=RIGHT)
        return best if best != RIGHT and worth(best) > worth(RIGHT) + EVIDENT else RIGHT

    def _take(self, fits: dict[str, Fit], fit: Fit) -> None:
        fits[fit.shape.plan] = fit
        self.laying.take(fit)

    def _vectors(self, fit: Fit) -> dict[str, Found]:
        """Return the vectors of a plan by name, where they are drawn."""
        shape, found = fit.shape, dict[str, Found]()
        line_of = {
            frozenset((int(shape.tails[at]), int(shape.tips[at]))): there
            for at, there in zip(shape.lines, fit.there, strict=True)
        }
        points = self.laying.points(fit)
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
