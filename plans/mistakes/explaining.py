"""Why answers are wrong: the mistakes that explain them, the simplest first.

All signatures are held against the answers at once; the nearest ones are then taken for the right construction, and
the answers marked with it: what is still wrong is not explained. Where one mistake leaves something, two are tried.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from operator import neg
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..board import Step
from ..hands.shaky import Paper
from ..marking.again import Judged
from ..marking.answers import DIRECTION, FREE, QUARTER, Answer, Line, Said, Verdict, known, miss, nearest
from ..marking.key import Key
from ..marking.verdicts import CLEAR, RATES, Marking, judge
from ..names import role
from .book import Book, Complex, Floats, Signature, key_of, signatures
from .data import miswritten, other_orders, transposed
from .rules import BY_SCALE, Broken, Scene, broken

MOST = 4.0  # tolerances beyond which a miss counts no more
ALIKE = 0.5  # tolerances by which values differ that answers cannot tell apart
NEAR = 12  # signatures that are looked at closely
FAR, NEARLY = 1.5, 0.3  # how much worse than the nearest a signature may be to be looked at
LEFT, SPOILT, SECOND = 0.12, 0.1, 0.25  # by how many tolerances a line left wrong, or a second mistake, is worse
ANGLES = 2  # angles of the crank that are looked at closely
ANGLED = frozenset(("M08", "M09", "M10"))  # mistakes that put the crank at another angle
# units, and digits exchanged: a number may be written so, and the right one gone on with
WRITTEN = frozenset(("M01", "M02", "M03", "M04", "M05", "M06", "M123"))
SLIP = 1.5  # tolerances by which a line that stays wrong misses clearly
ODD = 1e4  # times the right scale factor that none is
EXACT, CLOSE = 0.006, 0.03  # parts of a number by which mm times mu, and a calculation, may differ from it
ASIDE, ALMOST = 0.1, 6  # tolerances by which another number is worse, and decimals to which explanations are as good
CLOSELY = 0.6  # misses of what explains no more than it leaves
BY_HAND = Step("read", "", ())
BEAM = 4  # chains of mistakes that are made longer
LOCAL = 16  # mistakes at one line that are looked at closely
LINES = 3  # lines that stay wrong to which a mistake more is sought
DEPTH = 4  # mistakes of one student that are named
READ_ELSEWHERE = frozenset(("M21", "M22"))  # another segment is taken
TELLING = 3  # senses that tell that all are opposite
# what is opposite: senses of turning, and directions, counted the other way or from the other end; the simplest first
OPPOSITE: tuple[tuple[bool, Callable[[float], float] | None], ...] = (
    *((True, None), (False, neg), (False, math.pi.__add__), (True, neg), (True, math.pi.__add__)),
)
TURNING = (*RATES, "N*m")
# what of a line may stand in another one: a number, all numbers, the whole line; and where a decimal comma may be lost
PLACES = (("mm",), ("value", "rounded"), ("mm", "value", "rounded"), ("mm", "value", "rounded", "direction"))
COMMAS = (0.1, 0.01)


@dataclass(frozen=True, slots=True)
class Candidate:
    """An explanation: one mistake or two; those in `same` cannot be told from it by these answers."""

    mistakes: tuple[Broken, ...]
    same: tuple[tuple[Broken, ...], ...]
    explained: tuple[str, ...]  # lines that are wrong without it and right with it
    left: tuple[str, ...]  # those that stay wrong
    misses: float  # root of the mean square of those of all answers, in tolerances, those above MOST counting as MOST

    @property
    def ids(self) -> frozenset[str]:
        """The numbers of all mistakes that it may be."""
        return frozenset(one.mistake for found in (self.mistakes, *self.same) for one in found)


class _Explanation(NamedTuple):
    """The candidates, the simplest first, and the marking in which the first one is an earlier error."""

    candidates: tuple[Candidate, ...]
    marking: Marking


@dataclass(frozen=True, slots=True, eq=False)
class _Found:
    """A candidate with its broken constructions, each after the one before, and the lines marked with the last."""

    candidate: Candidate
    chain: tuple[Signature, ...]
    lines: tuple[Line, ...]
    clear: tuple[int, ...]  # places of lines that stay wrong by more than a slip
    fits: bool  # whether it explains everything within the tolerances
    rank: float  # the misses, worse for each line that stays clearly wrong, or is spoilt, and for a second mistake
    order: tuple[float, int]  # among all; of single ones as good as each other that first which moves fewer lines


@dataclass(frozen=True, slots=True)
class _Answers:
    """The answers of one student as columns: sizes, directions (unit vectors or signs, zero where not said)."""

    size: Floats
    way: Complex
    free: NDArray[np.bool_]
    angle: Floats

    def misses(self, book: Book, table: Complex, most: Floats) -> Floats:
        """Return the misses of rows of values, in tolerances, NaN where nothing is said; shape of `table`.

        What has been found on another way is held against what that gives.
        """
        off = self.missed(book.vector, table, most)
        with np.errstate(invalid="ignore"):  # of values beyond all floats
            turned = table * book.other
        return off if np.all(book.other == 1.0) else np.fmin(off, self.missed(book.vector, turned, most))

    def of_line(self, place: int) -> _Answers:
        """Return the answer of one line alone."""
        here = slice(place, place + 1)
        return _Answers(self.size[here], self.way[here], self.free[here], self.angle[here])

    def missed(self, vector: NDArray[np.bool_], table: Complex, most: Floats) -> Floats:
        """Return the misses of rows of values; `vector` tells which of them are vectors."""
        sizes = np.abs(table)
        with np.errstate(all="ignore"):
            off = np.abs(self.size - sizes)
            off = np.where(np.isnan(self.size), 0.0, _parts(off, most))
            turned = np.abs(np.angle(np.conj(self.way) * table))
            turned = np.where(self.free, np.minimum(turned, np.pi - turned), turned)
            astray = np.where(vector, turned / self.angle, _parts(2.0 * sizes, most) * (turned > 1.0))
            off = np.where((self.way != 0.0) & (sizes > most), np.maximum(off, astray), off)
        said = ~np.isnan(self.size) | (self.way != 0.0)
        return np.where(said, np.where(np.isnan(table), MOST, off), np.nan)


def _parts(off: Floats, most: Floats) -> Floats:
    """Return misses in tolerances, where nothing may miss zero."""
    return np.where(off == 0.0, 0.0, off / most)


def explain(book: Book, marking: Marking) -> _Explanation:
    """Find the mistakes that explain the answers of one student; none for answers without an error."""
    if marking.first_wrong is None:
        return _Explanation((), marking)
    own = book.drawn_to(marking.key, _scales(marking))
    found = _Search(own, marking).explanation()
    slip = next((line.name for line in marking.lines if line.verdict.faulty), marking.first_wrong)
    if found.candidates or slip == marking.first_wrong:
        return found
    other = _Search(own, replace(marking, first_wrong=slip)).explanation()  # it may have been none
    return other if other.candidates else found


def _scales(marking: Marking) -> dict[str, float]:
    """Return the scale factors that the student has written, by plan, SI per mm."""
    ours, found = marking.key.paper.mus, dict[str, float]()
    for line in marking.lines:
        mu = line.answer.mu if line.answer is not None else None
        if mu is not None and known(mu) and mu > 0.0 and line.plan in ours:
            own = nearest((mu, 1.0 / mu), ours[line.plan])
            if 1.0 / ODD < own / ours[line.plan] < ODD:
                found.setdefault(line.plan, own)
    return found


class _Search:
    """The search for the mistakes of one student."""

    def __init__(self, book: Book, marking: Marking) -> None:
        self.book, self.marking, self.mus = book, marking, {**book.key.paper.mus, **_scales(marking)}
        self.said = _columns(marking)
        self.faulty = {line.name: line.off for line in marking.lines if line.verdict.faulty}
        self.valued = {line.name for line in marking.answered if line.answer and known(line.answer.value)}
        self.as_said = Judged(marking.marker, marking.lines)
        self.first = next(i for i, line in enumerate(marking.lines) if line.name == marking.first_wrong)
        self.without = _mean(self.said.misses(book, book.right[None, :], book.allowed[None, :]))[0]

    def explanation(self) -> _Explanation:
        """Return the candidates in order, and the marking with the first one as an earlier error."""
        off = self.said.misses(self.book, self.book.table, self.book.most)
        means = _mean(off)
        likely = (means < self.without) | (off[:, self.first] <= 1.0)
        near = [int(i) for i in np.argsort(means, kind="stable") if likely[i]][:NEAR]
        near = [i for i in near if means[i] <= FAR * means[near[0]] + NEARLY]
        found = self._alone(self.book.signatures[i] for i in near)
        found += self._alone(self._transposed(self.marking.lines[self.first], ()))
        if not any(one.fits and not ANGLED.intersection(one.candidate.ids) for one in found):
            found += self._turned()
        if not any(one.fits for one in found):
            tried = {one.chain[0].broken.place for one in found}
            local = self._at_line(self.marking.lines, self.first, ())
            found += [one for one in local if one.chain[0].broken.place not in tried]
            found += [] if found else self._together(off)
            found += self._chained(found)
        candidates = _simplest(_grouped(sorted(found, key=lambda one: one.order), self.said))
        if not candidates or candidates[0].misses > 1.0:
            candidates = _simplest((*self._put_right(off), *candidates))
        candidates = tuple(filter(self._tells, candidates))
        if (other := self._opposed()) is not None:  # told once, and not as a chain of mistakes
            alone = (one for one in candidates if len(one.mistakes) == 1 and not one.left and one.misses <= 1.0)
            candidates = (*alone, other)
        elif (written := self._miswritten()) is not None and self._tells(written):
            fits = any(one.fits and len(one.chain) == 1 for one in found)
            others = [one for one in candidates if len(one.mistakes) == 1]
            candidates = (*others, written) if fits else (written, *others)
        return _Explanation(candidates, self._carried(candidates[0]) if candidates else self.marking)

    def _tells(self, candidate: Candidate) -> bool:
        """Whether a candidate explains more than it leaves, and no fewer lines than it has mistakes.

        Some mistake gives nearly any one number by chance, and a chain of mistakes whatever one likes.
        """
        if len(candidate.mistakes) > len(candidate.explained):
            return False
        if candidate.ids <= READ_ELSEWHERE and all(map(self._well_read, candidate.explained)):
            return False
        left = sum(not self.faulty.get(name, 0.0) <= CLEAR for name in candidate.left)
        return len(candidate.explained) > left or (len(candidate.explained) == left and candidate.misses <= CLOSELY)

    def _well_read(self, name: str) -> bool:
        """Whether the segment of a line is right, and only what was made of it wrong."""
        line = self.marking[name]
        said = line.answer is not None and line.answer.mm is not None
        return said and line.verdict in (Verdict.ARITHMETIC, Verdict.SCALE)

    def _opposed(self) -> Candidate | None:
        """Return that all senses are opposite, and so many that this is no chance; None where they are not."""
        key, answered = self.marking.key, [line for line in self.marking.lines if line.answer is not None]
        for turning, direction in OPPOSITE:
            turned = [_the_other_way(key, line.answer, turning, direction) for line in answered if line.answer]
            both = zip(answered, turned, strict=True)
            changed = [(line, one) for line, one in both if one != line.answer and abs(line.right) > line.allowed]
            before = [_astray(key, line, line.answer) for line, _ in changed if line.answer]
            if sum(before) < TELLING or any(_astray(key, *one) for one in changed):
                continue
            lines = judge(key, turned) or ()
            found = self._written("M126", lines)
            if found is not None and not any(line.verdict.faulty and line.about == DIRECTION for line in lines):
                return found
        return None

    def _miswritten(self) -> Candidate | None:
        """Return that the first wrong line has the numbers of another one, which has its own; or has lost a comma."""
        key, lines = self.marking.key, self.marking.lines
        first, said = lines[self.first], {line.name: line.answer for line in lines if line.answer is not None}
        own, tried = said[first.name], list[tuple[str, dict[str, Answer]]]()
        for line in lines:
            if (other := line.answer) is None or line.name not in self.faulty or line.name == first.name:
                continue
            for parts in PLACES if key.questions[line.name].unit == key.questions[first.name].unit else ():
                if own.mm is not None or other.mm is not None or parts == PLACES[1]:
                    there, here = ({part: getattr(one, part) for part in parts} for one in (own, other))
                    tried.append(("M127", {first.name: replace(own, **here), line.name: replace(other, **there)}))
        for parts in PLACES[:2]:
            for times in COMMAS if getattr(own, parts[0]) else ():
                shifted: dict[str, Any] = {part: times * (getattr(own, part) or 0.0) for part in parts}
                tried.append(("M128", {first.name: replace(own, **shifted)}))
        for number, meant in tried:
            if all(self._near(self.marking[name], answer) for name, answer in meant.items()):
                found = self._written(number, judge(key, (said | meant).values()) or ())
                if found is not None and meant.keys() <= {*found.explained} and self.faulty.keys() >= {*found.left}:
                    return found
        return None

    def _near(self, line: Line, answer: Answer) -> bool:
        """Whether each number of an answer is about as large as is right for a line."""
        measured = answer.measured(self.mus.get(line.plan))
        sizes = [answer.value] if answer.value is not None and known(answer.value) else []
        sizes += [nearest(measured, abs(line.right))] if measured and line.right else []
        return bool(sizes) and all(abs(abs(x) - abs(line.right)) <= line.allowed + CLOSE * abs(x) for x in sizes)

    def _written(self, number: str, lines: Sequence[Line]) -> Candidate | None:
        """Return a mistake of writing, after which the lines are judged as meant; None where it explains nothing."""
        key, left = self.marking.key, tuple(line.name for line in lines if line.verdict.faulty)
        explained = tuple(name for name in self.faulty if name not in left)
        if not explained:
            return None
        off = np.array([min(line.off, MOST) for line in lines if line.answer is not None])
        mistake = miswritten(number, Scene(key.paper, key.values), explained[0])
        return Candidate((mistake,), (), explained, left, float(np.sqrt(np.mean(off * off))))

    def _alone(self, made: Iterable[Signature]) -> list[_Found]:
        """Return the single mistakes that explain the first wrong line."""
        return [found for one in made if (found := self._found((one,))) is not None]

    def _chained(self, found: list[_Found]) -> list[_Found]:
        """Add mistakes to those that leave lines clearly wrong, one at the first of these lines after another."""
        made: list[_Found] = []
        ends = found
        for _ in range(DEPTH - 1):
            best = sorted((one for one in ends if one.clear), key=lambda one: one.rank)[:BEAM]
            ends = []
            for one in best:
                longer = (self._at_line(one.lines, place, one.chain) for place in one.clear[:LINES])
                ends += next(filter(None, longer), [])
            made += ends
        return made

    def _at_line(self, lines: tuple[Line, ...], place: int, chain: tuple[Signature, ...]) -> list[_Found]:
        """Add a mistake to a chain: one that moves a line and none before it that passes.

        The nearest come first, by what they give or by its ratio to what the chain gives.
        """
        earlier = [i for i, line in enumerate(lines[:place]) if line.answer is not None and line.verdict.passed]
        fitting = np.flatnonzero(self.moved[:, place] & ~self.moved[:, earlier].any(axis=1))
        made = self._after(chain, [self.book.signatures[i] for i in fitting]) + self._transposed(lines[place], chain)
        if not made:
            return []
        table = np.array([one.row[place] for one in made])[:, None]
        most = np.array([one.allowed[place] for one in made])[:, None]
        usual = chain[-1].row[place] if chain else self.book.right[place]
        own = self._misses_of(place, *self._times(lines[place], table, usual))
        near = np.minimum(self._misses_of(place, table, most), own)
        ordered = [made[i] for i in np.argsort(near, kind="stable") if near[i] <= 1.0]
        return [more for one in ordered[:LOCAL] if (more := self._found((*chain, one), lines[place].name)) is not None]

    def _together(self, off: Floats) -> list[_Found]:
        """Return pairs of which the first wrong line has its size from the one, and its direction from the other."""
        place, name = self.first, str(self.marking.first_wrong)
        said, signatures = self.said.of_line(place), self.book.signatures
        if not said.way[0] or np.isnan(said.size[0]):
            return []
        line = self.book.vector[place], self.book.table[:, [place]], self.book.most[:, [place]]
        apart = self.moved[:, place] & (off[:, place] > 1.0)
        sized = apart & (replace(said, way=np.zeros(1, complex)).missed(*line)[:, 0] <= 1.0)
        turned = apart & (replace(said, size=np.full(1, np.nan)).missed(*line)[:, 0] <= 1.0)
        nearest_first = np.argsort(_mean(off), kind="stable")
        firsts = [signatures[i] for i in nearest_first if sized[i]][:BEAM] if turned.any() else []
        seconds = [signatures[i] for i in np.flatnonzero(turned)]
        pairs = [(one, other) for one in firsts for other in self._after((one,), seconds)]
        ends = np.array([[other.row[place], other.allowed[place]] for _, other in pairs]).reshape(-1, 2)
        near = self._misses_of(place, ends[:, :1], ends[:, 1:].real)
        fitting = [pairs[i] for i in np.flatnonzero(near <= 1.0)[:LOCAL]]
        return [found for pair in fitting if (found := self._found(pair, name)) is not None]

    def _after(self, chain: tuple[Signature, ...], others: list[Signature]) -> list[Signature]:
        """Return mistakes as they are made after those of a chain."""
        if not chain:
            return others
        last, places = chain[-1], {one.broken.place for one in others} - {one.broken.place for one in chain}
        if not places:
            return []
        paper = Paper(last.broken.program, last.broken.givens, self.mus)
        again = broken(paper, last.values, {place[0] for place in places})
        return list(signatures(self.book.key, (one for one in again if one.place in places), last))

    def _transposed(self, line: Line, chain: tuple[Signature, ...]) -> list[Signature]:
        """Return the numbers with two digits transposed that the millimetres or the earlier numbers of a line mean."""
        answer = line.answer
        if answer is None or not known(answer.value) or not answer.value:
            return []
        key, last = self.book.key, chain[-1] if chain else None
        paper = Paper(last.broken.program, last.broken.givens, self.mus) if last else key.paper
        scene = Scene(paper, last.values if last else key.values)
        orders = [other for other, near in other_orders(answer.value) if self._meant(line, answer, other, near)]
        made = (transposed(scene, line.name, answer.value, other) for other in orders)
        return list(signatures(key, made, last))

    def _meant(self, line: Line, answer: Answer, other: float, near: float) -> bool:
        """Whether mm times mu gives another number than is written, or what is calculated from earlier numbers does.

        It does so where it is as `near`.
        """
        if not other:
            return False
        exact = min(EXACT * other, near)
        if answer.mm and any(abs(x - other) <= exact for x in answer.measured(self.mus.get(line.plan))):
            return True
        if line.follows != line.follows or not self._calculated(line.name):
            return False
        return bool(abs(other - abs(line.follows)) <= min(line.allowed, CLOSE * other, near))

    def _misses_of(self, place: int, table: Complex, most: Floats) -> Floats:
        """Return by how many tolerances the answer of one line misses a column of values."""
        return np.asarray(self.said.of_line(place).missed(self.book.vector[place], table, most)[:, 0])

    def _times(self, line: Line, table: Complex, usual: complex) -> tuple[Complex, Floats]:
        """Return what follows from a student's own values where mistakes make a line so many times the usual value."""
        follows = complex(line.follows)
        with np.errstate(all="ignore"):
            own = table * (follows / usual if usual and follows == follows else np.nan)
            return own, line.allowed * np.maximum(1.0, np.abs(own) / abs(line.right or 1.0))

    @cached_property
    def by_value(self) -> Judged:
        """The answers by their values alone where these are written: another scale factor has other millimetres."""
        return self.as_said.by_value()

    @cached_property
    def wrong_by_value(self) -> frozenset[str]:
        """The lines that are wrong by their values alone."""
        lines = self.by_value.under(self.marking.key) or ()
        return frozenset(line.name for line in lines if line.verdict.faulty)

    @cached_property
    def moved(self) -> NDArray[np.bool_]:
        """Which lines each mistake moves by more than a tolerance, of shape (mistakes, questions)."""
        book, told = self.book, self.said.way != 0.0
        with np.errstate(all="ignore"):
            apart = np.where(told, np.abs(book.table - book.right), np.abs(np.abs(book.table) - np.abs(book.right)))
            return np.asarray(apart > book.allowed)

    def _turned(self) -> list[_Found]:
        """Return the crank at the angles that fit best, where the answers are those of another position."""
        book, table = self.book, self.book.turned.table
        with np.errstate(all="ignore"):
            most = book.allowed * np.fmax(1.0, np.abs(table) / np.abs(book.right))
        means = _mean(self.said.misses(book, table, most))
        near = [int(i) for i in np.argsort(means, kind="stable")[:ANGLES] if means[i] <= 1.0]
        return self._alone(signatures(book.key, map(book.turned.broken, near)))

    def _put_right(self, off: Floats) -> tuple[Candidate, ...]:
        """Return the mistakes that explain every line that is not right, where right values were taken after them."""
        right = self.said.misses(self.book, self.book.right[None, :], self.book.allowed[None, :])[0]
        astray = np.flatnonzero(right > 1.0)  # not what is undefined, or not said
        if not np.isin(self.first, astray):
            return ()
        lines, at, means = self.marking.lines, self.first, _mean(off[:, astray])
        names, first, against = [line.name for line in lines], lines[at], self.moved & (off > 1.0)
        passed = [i for i, line in enumerate(lines) if line.verdict.passed]
        before, beside = [i for i in passed if i < at], [i for i in passed if lines[i].plan == first.plan]
        likely = (off[:, at] <= 1.0) & self.moved[:, at] & ~against[:, before].any(axis=1)
        likely &= means <= (1.0 if len(astray) > 1 else ALIKE)
        own = np.abs(self._times(first, self.book.table[:, at], self.book.right[at])[0])
        calculated = first.name in self.valued and self._calculated(first.name)
        found = []
        for i in np.argsort(means, kind="stable"):
            mistake = self.book.signatures[i].broken
            formula = calculated and role(mistake.at).shown == first.name and own[i] < np.inf
            written = mistake.mistake in WRITTEN or (formula and self._aside(first, own[i]) <= EXACT)
            if likely[i] and (written or not against[i, beside].any()):
                missed = {names[j] for j in astray if off[i, j] > 1.0}
                explained = tuple(name for name in self.faulty if name not in missed)
                left = tuple(name for name in self.faulty if name in missed)
                found.append(Candidate((mistake,), (), explained, left, float(means[i])))
        return _simplest(found)[:NEAR]

    def _found(self, chain: tuple[Signature, ...], first: str = "") -> _Found | None:
        """Mark the answers with a broken construction; None where it does not explain the first wrong line."""
        by_scale = any(one.broken.mistake in BY_SCALE for one in chain)
        judged, last = self.by_value if by_scale else self.as_said, chain[-1]
        again = judged.under(key_of(self.book.key, last), first or str(self.marking.first_wrong), self.faulty)
        if again is None:
            return None
        wrong = self.wrong_by_value if by_scale else self.faulty.keys()  # no scale makes millimetres alone wrong
        left = tuple(line.name for line in again if line.verdict.faulty or line.name in self.faulty.keys() - wrong)
        explained = tuple(name for name in self.faulty if name not in left)
        # of a plan that is drawn to another scale factor values alone show it
        shown = self.valued | {line.name for line in again if line.plan != last.broken.at}
        if not explained or (by_scale and shown.isdisjoint(explained)):
            return None
        off = np.array([min(line.off, MOST) for line in again if line.answer is not None])
        misses = float(np.sqrt(np.mean(off * off)))
        clear = tuple(i for i, line in enumerate(again) if line.verdict.faulty and line.off > SLIP)
        clearly = {again[i].name for i in clear}
        gone_on = last.broken.mistake not in WRITTEN
        if gone_on and len(clearly - self.faulty.keys()) >= len(explained):
            return None  # of what follows less is explained than is spoilt
        spoilt = len({*left} - self.faulty.keys() - clearly)
        missed = sum(min(again[i].off, MOST) for i in clear)
        unshown = by_scale and self.valued.isdisjoint(explained)  # a scale factor shows in values
        rank = misses + LEFT * missed + SPOILT * spoilt + SECOND * (len(chain) - 1) + ASIDE * unshown
        moved, order = ~(np.abs(last.row - self.book.right) <= self.book.allowed), (rank, 0)
        if len(chain) == 1:  # worse where a calculated number is not what the mistake makes of it
            line = again[self.first]
            aside = ASIDE if self._aside(line, abs(line.follows)) > EXACT else 0.0
            order = round(rank + aside, ALMOST), int(np.count_nonzero(moved))
        candidate = Candidate(tuple(one.broken for one in chain), (), explained, left, misses)
        return _Found(candidate, chain, again, clear, misses <= 1.0 and not clear and not spoilt, rank, order)

    def _aside(self, line: Line, against: float) -> float:
        """Return by what part a number that was calculated misses what it is held against; nothing for what was not."""
        answer = line.answer
        if answer is None or not known(answer.value) or not self._calculated(line.name) or not against < np.inf:
            return 0.0
        off = abs(abs(answer.value or 0.0) - against)
        return off / against if against else np.inf if off else 0.0

    def _calculated(self, name: str) -> bool:
        """Whether a quantity is calculated, before it is laid off or not."""
        steps = self.book.key.paper.program.by_name
        return "calc" in (steps[name].verb, steps.get(f"_{name}", BY_HAND).verb)

    def _carried(self, candidate: Candidate) -> Marking:
        """Return the marking in which the first line that each mistake explains is wrong, and the others are carried.

        The very first one may miss by so little that it seemed a slip of the hand.
        """
        if candidate.misses > 1.0:
            return self.marking  # it fits in part, but not within the tolerances
        own, book = {candidate.explained[0]}, self.book
        for mistake in candidate.mistakes if len(candidate.mistakes) > 1 else ():
            # of the lines that each of several explains the first that it would move by itself
            alone = next((s for s in book.signatures if s.broken.place == mistake.place), None)
            if alone is not None:
                moved = dict(zip(book.key.questions, np.abs(alone.row - book.right) > book.allowed, strict=True))
                own.update([name for name in book.key.questions if moved[name] and name in candidate.explained][:1])
        lines = tuple(
            replace(line, verdict=Verdict.CARRIED, about="") if line.name in {*candidate.explained} - own else line
            for line in self.marking.lines
        )
        return replace(self.marking, lines=lines, first_wrong=candidate.explained[0])


def _the_other_way(key: Key, answer: Answer, turning: bool, direction: Callable[[float], float] | None) -> Answer:
    """Return an answer with the opposite sense of turning, or with its direction counted in another way."""
    if direction is not None and answer.direction is not None and known(answer.direction):
        return replace(answer, direction=direction(answer.direction))
    question = key.questions[answer.name]
    if not turning or question.vector or question.unit not in TURNING:
        return answer
    if answer.sense:
        return replace(answer, sense=-answer.sense)
    if not answer.value or FREE.match(answer.name):  # whose sign says nothing
        return answer
    return replace(answer, value=-answer.value, plus=answer.value < 0.0)


def _astray(key: Key, line: Line, answer: Answer) -> bool:
    """Whether the sense of an answer, without a sign that of a positive number, is not the right one."""
    told = answer.direction is not None and known(answer.direction)
    turned = cmath.rect(1.0, answer.direction or 0.0) if told else None
    sign = answer.sense or (int(math.copysign(1.0, answer.value)) if answer.value else None)
    said, angle = Said(None, sign, turned, answer.side), key.angles.get(line.name, math.pi)
    return miss(said, line.right, line.allowed, angle).off > 1.0


def _columns(marking: Marking) -> _Answers:
    """Return the answers as columns."""
    said = [line.way or Said(None, None, None) for line in marking.lines]
    size = np.array([np.nan if s.size is None else s.size for s in said])
    way = np.array([s.direction if s.direction is not None else s.sign or 0.0 for s in said], complex)
    minus = [line.answer is not None and (line.answer.value or 0.0) < 0.0 for line in marking.lines]
    free = np.array([bool(FREE.match(line.name)) and m for line, m in zip(marking.lines, minus, strict=True)])
    angle = np.array([marking.key.angles.get(line.name, np.pi) for line in marking.lines])
    angle += np.where([s.side for s in said], QUARTER, 0.0)  # a word means all of its side
    return _Answers(size, way, free, angle)


def _mean(off: Floats) -> Floats:
    """Return the root of the mean square of misses, each at most MOST."""
    most = np.minimum(off, MOST)
    count = np.maximum(np.sum(~np.isnan(most), axis=1), 1)
    return np.asarray(np.sqrt(np.nansum(most * most, axis=1) / count))


def _grouped(found: Iterable[_Found], said: _Answers) -> tuple[Candidate, ...]:
    """Put candidates together that the answers cannot tell apart."""
    groups: list[tuple[Candidate, Any]] = []
    asked, turned = ~np.isnan(said.size) | (said.way != 0.0), said.way != 0.0
    for one in found:
        candidate, row, allowed = one.candidate, one.chain[-1].row[asked], one.chain[-1].allowed[asked]
        for place, (first, other) in enumerate(groups):
            if len(first.mistakes) == len(candidate.mistakes) and _alike(row, other, allowed, turned[asked]):
                groups[place] = (replace(first, same=(*first.same, candidate.mistakes)), other)
                break
        else:
            groups.append((candidate, row))
    return tuple(candidate for candidate, _ in groups)


def _numbers(candidate: Candidate) -> tuple[str, ...]:
    return tuple(sorted(one.mistake for one in candidate.mistakes))


def _simplest(candidates: Sequence[Candidate]) -> tuple[Candidate, ...]:
    """Leave out pairs of which one alone explains as much; put together those of one number that explain the same."""
    found: dict[tuple[tuple[str, ...], frozenset[str]], Candidate] = {}
    for candidate in candidates:
        key = _numbers(candidate), frozenset(candidate.explained)
        # whether another one explains as much with some of the same mistakes
        fewer = [o for o in candidates if len(o.mistakes) < len(candidate.mistakes) and key[1] <= set(o.explained)]
        if not any(set(_numbers(other)) <= set(key[0]) for other in fewer):
            first = found.get(key)
            same = () if first is None else (*first.same, candidate.mistakes, *candidate.same)
            found[key] = candidate if first is None else replace(first, same=same)
    return tuple(found.values())


def _alike(row: Any, other: Any, allowed: Floats, turned: NDArray[np.bool_]) -> bool:
    """Whether two rows differ by less than answers can tell: in size, and in direction where that is said."""
    apart = np.where(turned, np.abs(row - other), np.abs(np.abs(row) - np.abs(other)))
    return bool(np.all((apart <= ALIKE * allowed) | np.isnan(row)))
