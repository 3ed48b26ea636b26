"""The verdict of every line: right, right given the earlier error, wrong, arithmetic, scale, missing.

Each line is held against the right value, against what follows from all that the student said before (so that errors
of drawing do not add up), and against what follows from what was wrong before (so that an error counts once).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from statistics import median, median_high, median_low
from typing import Any, NamedTuple

from ...scales.names import unknown
from ..board import Step
from ..names import role
from .answers import NEVER, SIZE, Answer, Line, Miss, Said, Verdict, known, miss, nearest, ratio, readings
from .key import Key, Question, behind, hanging_on
from .student import Allowance, StudentBoard, Take, settled, settled_in

DECIMALS = tuple(10.0**power for power in (-3, -2, -1, 1, 2, 3))  # mm, cm, dm
THOUSANDS = (1e-3, 1e3)  # tons, kN/m, ms
# degrees, turns a minute
ANGLES = tuple(x for times in (180.0 / math.pi, 30.0 / math.pi) for x in (times, 1.0 / times))
UNITS = {
    "m": DECIMALS,
    "m/s": (*DECIMALS, 1 / 3.6, 3.6),  # km/h
    "m/s^2": DECIMALS,
    "N": (1e-6, 1e-3, 0.1, 10.0, 1e3, 1e6),  # kN, MPa in what it comes from, cm on the plan
    "N*m": (1e-6, *DECIMALS, 1e6),
    "Pa": (1e-6, *THOUSANDS, 1e6),
    **dict.fromkeys(("kg", "N/m", "s"), THOUSANDS),
    **dict.fromkeys(("m/mm", "(m/s)/mm", "(m/s^2)/mm"), DECIMALS),
    "rad": ANGLES[:2],
    "rad/s": ANGLES,
    "rad/s^2": (*ANGLES[:2], *(x * x for x in ANGLES[2:])),
}  # by what factors a value is wrong when only its unit is
SAME = 0.03  # part of a value by which a factor may miss: wide tolerances of short vectors let any factor fit
RATES = ("rad/s", "rad/s^2")  # units of what links turn with
EQUAL = 1e-9  # part of a value by which the rounding of two ways to it may differ
LARGE = 1e300  # no ratio is larger
AGREE = 0.05  # part by which segments of one plan may differ in the scale that they show
SHOWN = 5.0  # mm from which a segment shows to which scale its plan is drawn
CLEAR = 2.0  # tolerances from which an error is more than a slip of the hand
NOTHING = 1e-6  # part of a tolerance that is rounding
MANY = 3  # answers wrong by themselves, from which a line that hangs on them may follow by chance
SLACK = 0.5  # part of a tolerance by which mm times mu may differ from the value written
HALF = 0.5  # part of a value by which a hand may miss it at the most if it is to be judged


@dataclass(frozen=True, slots=True)
class Marking:
    """All lines in order of construction, the first one with an error of its own, and what has judged them."""

    lines: tuple[Line, ...]
    first_wrong: str | None
    marker: Marker = field(repr=False, compare=False)

    @property
    def key(self) -> Key:
        """The answer key, drawn to the student's scales."""
        return self.marker.key

    @property
    def step(self) -> Step | None:
        """The step that the first wrong line shows."""
        return None if self.first_wrong is None else behind(self.key, self.first_wrong)

    def __getitem__(self, name: str) -> Line:
        """Return the line of a quantity."""
        return next(line for line in self.lines if line.name == name)

    @property
    def answered(self) -> tuple[Line, ...]:
        """The lines that are not missing."""
        return tuple(line for line in self.lines if line.verdict is not Verdict.MISSING)


def mark(key: Key, answers: Iterable[Answer]) -> Marking:
    """Mark the answers of one student.

    Raises InputError: a quantity that is not asked.
    """
    marker = Marker.begun(key, answers)
    lines = tuple(marker.lines())
    return Marking(lines, first_wrong(lines, marker), marker)


def judge(key: Key, answers: Iterable[Answer], first: str = "") -> tuple[Line, ...] | None:
    """Judge the lines with a key that is drawn to the student's scales already, that of a broken rule too.

    Where the line `first` is clearly wrong, None: lines after it are not looked at.
    """
    marker = Marker.begun(key, answers, redraw=False)
    return None if first and marker.misses(first) else tuple(marker.lines())


def count_right(key: Key, answers: Iterable[Answer], least: float) -> int:
    """Return how many answers are as right as a hand draws; nothing where that is less than `least`."""
    marker = Marker.begun(key, answers)
    left = len(marker.answers)
    for name in key.questions:
        if name in marker.answers:
            marker.go_on(name)
            left -= marker.held[name].verdict is not Verdict.RIGHT
            if left < least:
                return 0
    return left


def first_wrong(lines: Iterable[Line], marker: Marker) -> str | None:
    """Return the first line with an error of its own.

    One that is measured and misses by little more than its tolerance may be a slip of the hand: it comes first only if
    there is no line that misses clearly. No hand slips in what is calculated.
    """
    faulty = [line for line in lines if line.verdict.faulty]
    clear = (
        line
        for line in faulty
        if line.off > CLEAR or line.verdict is not Verdict.WRONG or marker.allowance.calculation(line.name) is not None
    )
    first = next(clear, faulty[0] if faulty else None)
    return None if first is None else first.name


def bounded(marking: Marking, other: Key | None = None) -> Marking:
    """Return the marking in which no line earns anything by following from numbers that mostly are wrong.

    It does not where, of the answers on which it hangs, three or more are wrong by themselves, and more than are right
    or carried: then nobody can say what it follows from. Where the answers belong to the `other` key of another
    variant, no line is carried by any error, and what is nearer to its value than to the own one is right by chance.
    """
    bits, places = hanging_on(marking.key), marking.key.paper.program.places
    before: list[tuple[int, Verdict]] = []
    lines = []
    for line in marking.lines:
        if line.verdict is Verdict.CARRIED:
            place = places[line.name]
            behind_it = [verdict for found, verdict in before if found >> place & 1]
            wrong = sum(verdict in (Verdict.WRONG, Verdict.UNCOUNTED) for verdict in behind_it)
            passed = sum(verdict.passed for verdict in behind_it)
            if other is not None or (wrong >= MANY and wrong > passed):
                line = replace(line, verdict=Verdict.UNCOUNTED)
        size = line.way.size if line.verdict is Verdict.RIGHT and line.way is not None else None
        theirs = None if other is None or line.name not in other.questions else abs(other[line.name])
        if size is not None and theirs is not None and abs(size - theirs) < abs(size - abs(line.right)):
            line = replace(line, verdict=Verdict.UNCOUNTED)
        lines.append(line)
        if line.verdict is not Verdict.MISSING:
            before.append((bits[line.name], line.verdict))
    return replace(marking, lines=tuple(lines))


def _on_paper(key: Key, answer: Answer, said: Mapping[str, Answer]) -> Answer:
    """Return an answer on a drawing without a scale: what is measured there is the value, and no factor of it counts.

    What is calculated there from its millimetres has the scale factor that the student has found, else the right one.
    """
    question = key.questions[answer.name]
    if answer.mm is None or question.plan not in key.paper.unscaled:
        return answer
    if question.step.verb != "calc":
        return replace(answer, mu=key.paper.mus[question.plan])
    factor = question.step.operands[0]
    if known(answer.mu) or role(factor).kind != "mu":
        return answer if known(answer.mu) else replace(answer, mm=None)
    own = said[factor].value if factor in said else None
    return replace(answer, mu=own if own and known(own) else float(key.values[factor]))


class _Held(NamedTuple):
    """An answer held against a value: the verdict, how it was taken, by how much it misses what, and may miss it."""

    verdict: Verdict
    said: Said
    miss: Miss
    against: Any
    allowed: float


class Marker:
    """Marks the lines of one student, one after the other."""

    def __init__(self, key: Key, answers: Iterable[Answer]) -> None:
        """Take the answers of one student, of two to one question the first."""
        said: dict[str, Answer] = {}
        for answer in answers:
            if answer.name not in key.questions:
                raise unknown("quantity-unknown", answer.name, key.questions)
            if not answer.empty:
                said.setdefault(answer.name, answer)
        on_paper = (_on_paper(key, answer, said) for answer in said.values())
        self.key, self.answers = key, {answer.name: answer for answer in on_paper if not answer.empty}
        self.mus = {name: (known(answer.mu) and answer.mu) or None for name, answer in self.answers.items()}
        self.written = {name for name, mu in self.mus.items() if mu is not None}  # whose scale factor is the student's
        self.guessed = False  # whether a scale factor is taken from the key
        self.segments: dict[str, list[str]] = {}  # the lines of a plan with millimetres
        self.ways: dict[str, tuple[Said, ...]] = {}  # to take each answer
        self.taken: dict[str, Said] = {}  # what the student goes on with
        self.held: dict[str, _Held] = {}
        self.failed = False

    @classmethod
    def begun(cls, key: Key, answers: Iterable[Answer], redraw: bool = True) -> Marker:
        """Return what has begun to mark the answers of one student."""
        marker = cls(key, answers)
        marker.settle_scales(redraw)
        marker.begin()
        return marker

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what begins to mark the same answers in another process, under the key drawn to their scales."""
        return Marker.begun, (self.key, [*self.answers.values()], False)

    def again(self, key: Key, anew: Collection[str], steps: tuple[Step, ...]) -> Marker:
        """Return what marks the same answers under another key: `steps`, that make names `anew`; else all is as here.

        No scale factor is guessed.
        """
        made = Marker.__new__(Marker)
        vars(made).update(vars(self))
        made.key = key
        made.begin(self, anew, steps)
        return made

    def settle_scales(self, redraw: bool = True) -> None:
        """Find the scale factor of every line with millimetres, and draw the key to the student's scales."""
        for name, answer in self.answers.items():
            plan = self.key.questions[name].plan
            if answer.mm and known(answer.mm) and answer.mm > 0.0 and plan not in self.key.paper.unscaled:
                self.segments.setdefault(plan, []).append(name)
        drawn = {}
        for plan, names in self.segments.items():
            written = next((mu for name in names if (mu := self.mus[name])), None) or self._from_pairs(
                names, self.key.paper.mus.get(plan, 0.0)
            )
            mu = written or self._likeliest(names)
            if written is None:
                self.guessed = True
                self.written.difference_update(names)
            else:
                self.written.update(names)
            self.mus.update({name: mu for name in names if not self.mus[name]})
            ours = self.key.paper.mus.get(plan, mu)
            drawn[plan] = nearest((mu, 1.0 / mu), ours) if mu else ours  # in whichever convention it is meant
        if redraw:
            self.key = self.key.drawn_to({plan: mu for plan, mu in drawn.items() if mu > 0.0})

    def _drawn_to(self, name: str) -> float:
        return float(abs(self.key[name])) / abs(self.answers[name].mm or 1.0)

    def _likeliest(self, names: list[str]) -> float:
        """Return the scale, of those that single segments show, at which most are right, and miss least."""

        def misses(mu: float) -> float:
            missed = ((abs((self.answers[n].mm or 0.0) * mu - abs(self.key[n])), self.key.on_paper(n)) for n in names)
            return sum(min(ratio(off, allowed), 1.0) ** 2 for off, allowed in missed)

        return min((self._drawn_to(name) for name in names), key=misses)

    def _from_pairs(self, names: list[str], ours: float) -> float | None:
        """Return the scale factor by which students went on from millimetres to values, also to those of opposites.

        Where half of them has one and half another, it is that which is nearer to ours.
        """
        questions = self.key.questions.values()
        opposite = {q.step.operands[0]: q.name for q in questions if q.step.law == "opposite"}
        pairs = [(self.answers[name], self.answers.get(opposite.get(name, ""))) for name in names]
        values = [(own.mm, own.value or (other and other.value)) for own, other in pairs]
        found = [abs(value / mm) for mm, value in values if value and mm]
        if not found or median_high(found) - median_low(found) <= AGREE * median(found) or not ours:
            return median(found) if found else None
        return min(
            median_low(found), median_high(found), key=lambda mu: abs(math.log(max(min(mu / ours, LARGE), 1.0 / LARGE)))
        )

    def shown_scale(self, plan: str) -> float | None:
        """Return to which scale the segments of a plan seem to be drawn."""
        names, questions = self.segments.get(plan, ()), self.key.questions
        long = [name for name in names if abs(self.answers[name].mm or 0.0) >= SHOWN]
        shown = [self._drawn_to(name) for name in long if questions[name].step.verb != "arm"]
        middle = median(shown) if shown else 0.0
        near = [mu for mu in shown if abs(mu - middle) < AGREE * middle]
        return middle if len(shown) > 1 and len(near) > len(shown) / 2 else None  # one alone shows none

    def begin(
        self, before: Marker | None = None, anew: Collection[str] = (), steps: tuple[Step, ...] | None = None
    ) -> None:
        """Find how every answer may be taken, and begin the constructions with it.

        All is taken over from what has judged the same answers `before`, but for the names that `steps` make `anew`.
        """
        paper = self.key.paper
        self.settled = settled(paper.program) if steps is None else settled_in(steps)
        take: Take = lambda name, value: (self.taken.get(name), True)  # noqa: E731
        self.drawn = StudentBoard(paper.program, paper.givens, take, steps=steps)
        self.board = StudentBoard(paper.program, self.key.values, self._judge, made=True, steps=steps)
        self.allowance = Allowance(self.key, self.answers, self.drawn, self._sure, self._faulty)
        if before is None:
            self._take(self.answers)
            return
        self.ways, self.taken, self.held = before.ways.copy(), before.taken.copy(), before.held.copy()
        for name in anew:
            self.held.pop(name, None)
        self._take(name for name, ways in before.ways.items() if len(ways) > 1 and name in anew)
        self.drawn.after(before.drawn, anew)
        self.board.after(before.board, anew)
        self.allowance.after(before.allowance, anew)

    def _take(self, names: Iterable[str]) -> None:
        for name in names:
            values = self.answers[name].values(self.mus[name])
            self.ways[name] = self._readings(name, values)
            near = (nearest(values, abs(self.key[name])),) if len(values) > 1 else values
            self.taken[name] = self.ways[name][0] if near == values else self._readings(name, near)[0]

    def _sure(self, name: str) -> bool:
        """Whether the student has said a size, and not only a segment whose scale factor is to be guessed."""
        answer = self.answers[name]
        return known(answer.value) or (known(answer.mm) and name in self.written)

    def _faulty(self, name: str) -> bool:
        return name in self.held and self.held[name].verdict.faulty

    def go_on(self, name: str) -> None:
        """Judge the lines up to that of `name`."""
        self.board.go_on(self.settled.get(name, 0))

    def passes(self, name: str) -> bool:
        """Judge the lines up to that of `name`; whether it has no error of its own."""
        self.go_on(name)
        return not self._faulty(name)

    def misses(self, name: str) -> bool:
        """Judge the lines up to that of `name`; whether it is clearly wrong by itself."""
        self.go_on(name)
        held = self.held.get(name)
        return held is not None and held.verdict.faulty and held.miss.off > CLEAR

    def likely(self, name: str, key: Key) -> bool:
        """Whether a line is of the size that is right under another key, so that it probably passes."""
        size, most = abs(key[name]), key.allowed[name]
        return any(way.size is None or abs(way.size - size) <= most for way in self.ways.get(name, ()))

    def lines(self, before: Iterable[Line] = (), anew: Collection[str] = ()) -> Iterator[Line]:
        """Judge every line in order of construction; of lines that were judged `before` those `anew`."""
        self.board.go_on()
        follows = self.board.follows
        kept = {line.name: line for line in before if line.name not in anew}
        for question in self.key.questions.values():
            yield kept.get(question.name) or self._line(question, follows[question.name])

    def _follows(self, name: str) -> Any:
        """Return what follows from all that the student said before: constructed as far as it is asked for."""
        self.drawn.go_on(self.settled[name])
        return self.drawn.follows.get(name)

    def _line(self, question: Question, follows: Any) -> Line:
        name, held = question.name, self.held.get(question.name)
        right, allowed = self._right(name), self.key.allowed[name]
        if held is None:
            return Line(name, question.plan, Verdict.MISSING, None, None, right, follows, allowed, NEVER)
        verdict, way, found, against, allowed = held
        said = way.taken(follows if follows == follows else right)
        if verdict is Verdict.CARRIED:
            said = way.taken(against)
        about = found.about if verdict.faulty else ""
        answer = self.answers[name]
        return Line(name, question.plan, verdict, answer, said, right, against, allowed, found.off, about, way)

    def _right(self, name: str) -> Any:
        """Return the right value, of two that which the answer is nearer to."""
        values = self.key.right(name)
        if len(values) == 1 or name not in self.held:
            return values[0]
        return min((self._best(self.ways[name], name, x, right=True) for x in values), key=_off).against

    def _judge(self, name: str, value: Any) -> tuple[Said | None, bool]:
        """Judge a line whose value follows from what was wrong before; go on with what the student says if it differs.

        A slip of the pen or of the scale does not move the mark.
        """
        if name not in self.answers:
            return None, False
        if name not in self.held:
            self.held[name] = self._as_its_equal(name, self._verdict(name, value))
            self.failed |= self.held[name].verdict.faulty
        held = self.held[name]
        wrong = held.verdict is Verdict.WRONG
        if not wrong and self._missed(held.said, name, value, self.allowance.by_hand(name, value)).off <= 1.0:
            return None, False
        return held.said, wrong

    def _as_its_equal(self, name: str, held: _Held) -> _Held:
        """Let pass an angular velocity or acceleration that is taken over, with its sense, from an equal one that did.

        That of a link by compound motion, where what carries it turns evenly, is that of its plan.
        """
        if held.verdict is not Verdict.WRONG or self.key.questions[name].unit not in RATES:
            return held
        size, sign = held.said.size, held.said.sign or 0
        for other, before in self.held.items():
            same = abs(self.key[other] - self.key[name]) <= EQUAL * abs(self.key[name])
            if same and before.verdict.passed and size and size == before.said.size and sign * before.against >= 0.0:
                return held._replace(verdict=before.verdict)
        return held

    def _verdict(self, name: str, value: Any) -> _Held:
        answer = self.answers[name]
        held = self._held(self.ways[name], name, value)
        clear = held.miss.off > CLEAR and held.miss.about == SIZE
        units, values = UNITS.get(self.key.questions[name].unit, ()), self.answers[name].values(self.mus[name])
        if clear and self._fits(name, value, [x * unit for x in values for unit in units]):  # in another unit
            return held._replace(verdict=Verdict.SCALE)
        instead, written = answer.measured(self.mus[name]), answer.value
        if written is not None and instead and not self._agrees(name, written, instead):
            by_mm = self._held(self._readings(name, instead), name, value).verdict
            if held.verdict.passed is not by_mm.passed:
                return held._replace(verdict=Verdict.ARITHMETIC)
        if clear and self._is_scale(name, value):
            return held._replace(verdict=Verdict.SCALE)
        return held._replace(verdict=Verdict.SMALL) if self._too_small(name, held) else held

    def _too_small(self, name: str, held: _Held) -> bool:
        """Whether an answer is far from a value of which a hand may miss more than half: it says nothing then."""
        if held.verdict is not Verdict.RIGHT or name in self.key.firm:
            return False
        allowed, sizes = self.key.allowed[name], [abs(value) for value in self.key.right(name)]
        if not all(NOTHING * allowed < size < allowed / HALF for size in sizes):
            return False
        ways = (held.said, *self.ways[name])
        return all(miss(way, x, HALF * abs(x), 0.0).off > 1.0 for way in ways for x in self.key.right(name))

    def _readings(self, name: str, values: tuple[float, ...]) -> tuple[Said, ...]:
        """Return all ways to take an answer; a number without a unit is no magnitude, and its sign counts."""
        return readings(self.answers[name], values, self.key.questions[name].unit == "1")

    def _agrees(self, name: str, written: float, instead: Iterable[float]) -> bool:
        """Whether the value written is one of those that the millimetres mean."""
        most, mu = self.key.tolerance, float(self.key.paper.mus.get(self.key.questions[name].plan, 0.0))
        return any(abs(x - abs(written)) <= SLACK * max(most.mm * mu, most.part * x) for x in instead)

    def _held(self, ways: tuple[Said, ...], name: str, value: Any) -> _Held:
        """Hold an answer against the right values, and against what follows."""
        values = self.key.right(name)
        right = min((self._best(ways, name, x, right=True) for x in values), key=_off)
        if right.miss.off <= 1.0:
            return right
        own = self._best(ways, name, self._follows(name))
        found = min((right, self._best(ways, name, value), own), key=_off)
        if found.miss.off <= 1.0:
            allowed = self.key.allowed[name]  # as near to what is right as hands draw
            near = (self._missed(way, name, x, allowed).off <= 1.0 for way in ways for x in values)
            right_too = not self.failed or any(near)
            return found._replace(verdict=Verdict.RIGHT if right_too else Verdict.CARRIED)
        if own.miss.off < NEVER and self.allowance.follows(name):
            found = own
        return found._replace(verdict=Verdict.WRONG, said=self.taken[name])

    def _best(self, ways: tuple[Said, ...], name: str, value: Any, right: bool = False) -> _Held:
        """Return the way to take an answer that misses a value least."""
        if value is None or value != value:
            return _Held(Verdict.RIGHT, ways[0], Miss(NEVER, SIZE), value, NEVER)
        if not right or self.allowance.calculation(name) is not None:
            self.drawn.go_on(self.settled[name])
        allowed = self.allowance.of(name, value, right)
        held = (_Held(Verdict.RIGHT, way, self._missed(way, name, value, allowed), value, allowed) for way in ways)
        return min(held, key=_off)

    def _missed(self, way: Said, name: str, value: Any, allowed: float) -> Miss:
        return miss(way, value, allowed, self.key.angles.get(name, math.pi))

    def _is_scale(self, name: str, value: Any) -> bool:
        """Whether only the convention of the scale factor, or the scale itself, makes a line wrong."""
        question, mm = self.key.questions[name], self.answers[name].mm
        # an arm hangs on the direction of a force, and shows no scale when that is wrong
        true, mu = self.shown_scale(question.plan) if mm and question.step.verb != "arm" else None, self.mus[name]
        if true and mu and any(abs(way - true) <= SAME * true for way in (mu, 1.0 / mu)):
            true = None  # it is the student's own, but for what hands miss
        own = (mm * true,) if true is not None and mm else ()
        return self._fits(name, value, (*self.answers[name].measured(self.mus[name]), *own))

    def _fits(self, name: str, value: Any, others: Iterable[float]) -> bool:
        """Whether a line would pass with one of other values, and that in a few parts of a hundred."""
        if abs(self.key[name]) <= self.key.allowed[name]:
            return False  # anything is nothing in some unit
        sizes = [abs(x) for x in (*self.key.right(name), value, self._follows(name)) if x is not None]
        for x in others:
            if any(abs(abs(x) - size) <= SAME * size for size in sizes):  # else it need not be held against anything
                held = self._held(self._readings(name, (x,)), name, value)
                if held.verdict.passed and abs(abs(x) - abs(held.against)) <= SAME * abs(held.against):
                    return True
        return False


def _off(held: _Held) -> float:
    return held.miss.off
