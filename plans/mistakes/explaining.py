"""Why answers are wrong: the mistakes that explain them, the simplest first.

All signatures are held against the answers at once; the nearest ones are then taken for the right construction, and
the answers marked with it: what is still wrong is not explained. Where one mistake leaves something, two are tried.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..marking.answers import FREE, Said
from ..marking.verdicts import CLEAR, Line, Marking, Verdict, behind, judge
from .book import Book, Signature, broken, key_of, signature
from .rules import Broken

MOST = 4.0  # tolerances beyond which a miss counts no more
ALIKE = 0.5  # tolerances by which values differ that answers cannot tell apart
NEAR = 12  # signatures that are looked at closely
FAR, NEARLY = 1.5, 0.3  # how much worse than the nearest a signature may be to be looked at
MISFIT = 2.0  # mean miss in tolerances from which a mistake explains nothing
LEFT, SECOND = 0.15, 0.25  # by how many tolerances a line left wrong, or a second mistake, is worse
PAIRS = 8  # pairs of them
ANGLES = 2  # angles of the crank that are looked at closely
ANGLED = frozenset(("M08", "M09", "M10"))  # mistakes that put the crank at another angle
FIRSTS = 4  # mistakes to which a second one is added

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Candidate:
    """An explanation: one mistake or two; those in `same` cannot be told from it by these answers.

    Parameters
    ----------
    explained, left : tuple of str
        Lines that are wrong without it and right with it, and those that stay wrong.
    misses : float
        Root of the mean square of the misses of all answers, in tolerances, those above MOST counting as MOST.
    """

    mistakes: tuple[Broken, ...]
    same: tuple[tuple[Broken, ...], ...]
    explained: tuple[str, ...]
    left: tuple[str, ...]
    misses: float

    @property
    def ids(self) -> frozenset[str]:
        """The numbers of all mistakes that it may be."""
        return frozenset(one.mistake for found in (self.mistakes, *self.same) for one in found)


@dataclass(frozen=True, slots=True)
class Explanation:
    """The candidates, the simplest first, and the marking in which the first one is an earlier error."""

    candidates: tuple[Candidate, ...]
    marking: Marking


@dataclass(frozen=True, slots=True)
class _Answers:
    """The answers of one student as columns: sizes, directions (unit vectors or signs, zero where not said)."""

    size: Floats
    way: NDArray[np.complex128]
    free: NDArray[np.bool_]
    angle: Floats

    def misses(self, book: Book, table: NDArray[np.complex128], most: Floats) -> Floats:
        """Return the misses of rows of values, in tolerances, NaN where nothing is said; shape of `table`.

        What has been found on another way is held against what that gives.
        """
        off = self._misses(book, table, most)
        if np.all(book.other == 1.0):
            return off
        return np.asarray(np.fmin(off, self._misses(book, table * book.other, most)))

    def _misses(self, book: Book, table: NDArray[np.complex128], most: Floats) -> Floats:
        sizes = np.abs(table)
        with np.errstate(all="ignore"):
            off = np.abs(self.size - sizes)
            off = np.where(np.isnan(self.size), 0.0, _parts(off, most))
            turned = np.abs(np.angle(np.conj(self.way) * table))
            turned = np.where(self.free, np.minimum(turned, np.pi - turned), turned)
            astray = np.where(book.vector, turned / self.angle, _parts(2.0 * sizes, most) * (turned > 1.0))
            off = np.where((self.way != 0.0) & (sizes > most), np.maximum(off, astray), off)
        said = ~np.isnan(self.size) | (self.way != 0.0)
        return np.where(said, np.where(np.isnan(table), MOST, off), np.nan)


def _parts(off: Floats, most: Floats) -> Floats:
    """Return misses in tolerances, where nothing may miss zero."""
    return np.where(off == 0.0, 0.0, off / most)


def explain(book: Book, marking: Marking) -> Explanation:
    """Find the mistakes that explain the answers of one student; none for answers without an error."""
    if marking.first_wrong is None:
        return Explanation((), marking)
    return _Search(book.drawn_to(marking.key), marking).explanation()


class _Search:
    """The search for the mistakes of one student."""

    def __init__(self, book: Book, marking: Marking) -> None:
        self.book, self.marking = book, marking
        self.said = _columns(marking)
        self.faulty = {line.name: line.off for line in marking.lines if line.verdict.faulty}
        self.answers = [line.answer for line in marking.lines if line.answer is not None]
        self.first = next(i for i, line in enumerate(marking.lines) if line.name == marking.first_wrong)
        self.without = _mean(self.said.misses(book, book.right[None, :], book.allowed[None, :]))[0]

    def explanation(self) -> Explanation:
        """Return the candidates in order, and the marking with the first one as an earlier error."""
        off = self.said.misses(self.book, self.book.table, self.book.most)
        means = _mean(off)
        likely = (means < self.without) | (off[:, self.first] <= 1.0)
        near = [int(i) for i in np.argsort(means, kind="stable") if likely[i]][:NEAR]
        near = [i for i in near if means[i] <= FAR * means[near[0]] + NEARLY]
        found = [c for i in near if (c := self._candidate((self.book.signatures[i],))) is not None]
        if not any(self._fits(c) and not ANGLED.intersection(c.ids) for c, _ in found):
            found += self._turned()
        if not found:
            found += self._adrift()
        if all(self._clear(c) for c, _ in found):
            found += self._pairs(off)
        ranked = sorted(found, key=lambda pair: self._rank(pair[0]))
        candidates = _simplest(_grouped(ranked, self.said))
        if not candidates or candidates[0].misses > 1.0:
            candidates = _simplest((*self._put_right(off), *candidates))
        return Explanation(candidates, self._carried(candidates[0]) if candidates else self.marking)

    def _fits(self, candidate: Candidate) -> bool:
        """Whether a candidate explains everything within the tolerances."""
        return candidate.misses <= 1.0 and not self._clear(candidate)

    def _turned(self) -> list[tuple[Candidate, Signature]]:
        """Return the crank at the angles that fit best, where the answers are those of another position."""
        book, table = self.book, self.book.turned.table
        with np.errstate(all="ignore"):
            most = book.allowed * np.fmax(1.0, np.abs(table) / np.abs(book.right))
        means = _mean(self.said.misses(book, table, most))
        near = [int(i) for i in np.argsort(means, kind="stable")[:ANGLES] if means[i] <= 1.0]
        made = [signature(book.key, book.turned.broken(i)) for i in near]
        return [c for one in made if one is not None and (c := self._candidate((one,))) is not None]

    def _adrift(self) -> list[tuple[Candidate, Signature]]:
        """Return mistakes at the first wrong line of a drawing that has gone far astray before it, by no error.

        There it is the ratio to what follows from the answers before it that tells, not the size.
        """
        line = self.marking[str(self.marking.first_wrong)]
        if not line.follows or line.follows != line.follows:
            return []
        size = self.said.size[self.first] * abs(line.right) / abs(line.follows)
        off = _parts(np.abs(size - np.abs(self.book.table[:, self.first])), self.book.most[:, self.first])
        near = [self.book.signatures[i] for i in np.argsort(off, kind="stable")[:FIRSTS] if off[i] <= 1.0]
        return [c for one in near if (c := self._candidate((one,))) is not None]

    def _put_right(self, off: Floats) -> tuple[Candidate, ...]:
        """Return the mistakes that explain every line that is not right, where right values were taken after them."""
        right = self.said.misses(self.book, self.book.right[None, :], self.book.allowed[None, :])[0]
        astray = np.flatnonzero(right > 1.0)  # not what is undefined, or not said
        if not np.isin(self.first, astray):
            return ()
        means = _mean(off[:, astray])
        fitting = [int(i) for i in np.argsort(means, kind="stable") if means[i] <= (1.0 if len(astray) > 1 else ALIKE)]
        names = [line.name for line in self.marking.lines]
        missed = {i: {names[j] for j in astray if off[i, j] > 1.0} for i in fitting}
        found = [
            Candidate(
                (self.book.signatures[i].broken,),
                (),
                tuple(name for name in self.faulty if name not in missed[i]),
                tuple(name for name in self.faulty if name in missed[i]),
                float(means[i]),
            )
            for i in fitting
            if off[i, self.first] <= 1.0
        ]
        return _simplest(tuple(found))[:NEAR]

    def _clear(self, candidate: Candidate) -> int:
        """Return how many lines stay clearly wrong."""
        return sum(self.faulty.get(name, MOST) > CLEAR for name in candidate.left)

    def _rank(self, candidate: Candidate) -> float:
        """Return the misses, worse for each line that stays clearly wrong and for a second mistake."""
        return candidate.misses + LEFT * self._clear(candidate) + SECOND * (len(candidate.mistakes) - 1)

    def _candidate(self, signatures: tuple[Signature, ...]) -> tuple[Candidate, Signature] | None:
        """Mark the answers with a broken construction; None where it does not explain the first wrong line."""
        last = signatures[-1]
        misses = float(_mean(self.said.misses(self.book, last.row[None, :], last.allowed[None, :]))[0])
        if misses > MISFIT:
            return None
        again = judge(key_of(self.book.key, last), self.answers, str(self.marking.first_wrong))
        if again is None:
            return None
        left = tuple(line.name for line in again if line.verdict.faulty)
        explained = tuple(name for name in self.faulty if name not in left)
        if not explained:
            return None
        return Candidate(tuple(s.broken for s in signatures), (), explained, left, misses), last

    def _pairs(self, off: Floats) -> list[tuple[Candidate, Signature]]:
        """Add a second mistake to the first ones: as if ratios multiplied, then in truth."""
        book, firsts = self.book, self._firsts(off)
        with np.errstate(all="ignore"):
            ratio = np.where(np.abs(book.right) > 0.0, book.table / book.right, 1.0)
        tried: list[tuple[float, int, int]] = []
        for i in firsts:
            with np.errstate(all="ignore"):
                both = np.where(np.isfinite(ratio), book.table[i] * ratio, book.table)
            means = _mean(self.said.misses(book, both, np.maximum(book.most[i], book.most)))
            tried += [(float(means[j]), i, int(j)) for j in np.argsort(means, kind="stable")[:PAIRS] if j != i]
        found = []
        for mean, i, j in sorted(tried)[:PAIRS]:
            if mean < self.without and (pair := self._both(i, j)) is not None:
                found.append(pair)
        return found

    def _firsts(self, off: Floats) -> list[int]:
        """Return the mistakes that explain the first wrong line, those first that leave least."""
        right = np.flatnonzero(off[:, self.first] <= 1.0)
        means = _mean(off[right])
        return [int(right[i]) for i in np.argsort(means, kind="stable")[:FIRSTS]]

    def _both(self, i: int, j: int) -> tuple[Candidate, Signature] | None:
        one, two = self.book.signatures[i], self.book.signatures[j]
        paper = replace(self.book.key.paper, program=one.broken.program, givens=one.broken.givens)
        again = broken(paper, one.values, (two.broken.mistake,))
        then = next((b for b in again if b.place == two.broken.place), None)
        made = None if then is None else signature(self.book.key, then)
        return None if made is None else self._candidate((one, made))

    def _carried(self, candidate: Candidate) -> Marking:
        """Return the marking in which the first line that each mistake explains is wrong, and the others are carried.

        The very first one may miss by so little that it seemed a slip of the hand.
        """
        if candidate.misses > 1.0:
            return self.marking  # it fits in part, but not within the tolerances
        first, *others = candidate.explained
        own = (
            {self._first_of(mistake, candidate) for mistake in candidate.mistakes}
            if len(candidate.mistakes) > 1
            else ()
        )
        lines = tuple(_carried(x) if x.name in others and x.name not in own else x for x in self.marking.lines)
        return replace(self.marking, lines=lines, first_wrong=first, step=behind(self.marking.key, first))

    def _first_of(self, mistake: Broken, candidate: Candidate) -> str:
        """Return the first line that a mistake of several would move by itself, of those that they explain."""
        book = self.book
        alone = next((s for s in book.signatures if s.broken.place == mistake.place), None)
        if alone is None:
            return candidate.explained[0]
        moved = np.abs(alone.row - book.right) > book.allowed
        names = [name for name, one in zip(book.key.questions, moved, strict=True) if one]
        return next((name for name in names if name in candidate.explained), candidate.explained[0])


def _carried(line: Line) -> Line:
    return replace(line, verdict=Verdict.CARRIED, about="")


def _columns(marking: Marking) -> _Answers:
    """Return the answers as columns."""
    said = [line.way or Said(None, None, None) for line in marking.lines]
    size = np.array([np.nan if s.size is None else s.size for s in said])
    way = np.array([s.direction if s.direction is not None else s.sign or 0.0 for s in said], complex)
    minus = [line.answer is not None and (line.answer.value or 0.0) < 0.0 for line in marking.lines]
    free = np.array([bool(FREE.match(line.name)) and m for line, m in zip(marking.lines, minus, strict=True)])
    angle = np.array([marking.key.angles.get(line.name, np.pi) for line in marking.lines])
    return _Answers(size, way, free, angle)


def _mean(off: Floats) -> Floats:
    """Return the root of the mean square of misses, each at most MOST."""
    most = np.minimum(off, MOST)
    count = np.maximum(np.sum(~np.isnan(most), axis=1), 1)
    return np.asarray(np.sqrt(np.nansum(most * most, axis=1) / count))


def _grouped(found: Iterable[tuple[Candidate, Signature]], said: _Answers) -> tuple[Candidate, ...]:
    """Put candidates together that the answers cannot tell apart."""
    groups: list[tuple[Candidate, Any]] = []
    asked, turned = ~np.isnan(said.size) | (said.way != 0.0), said.way != 0.0
    for candidate, made in found:
        row, allowed = made.row[asked], made.allowed[asked]
        for place, (first, other) in enumerate(groups):
            if len(first.mistakes) == len(candidate.mistakes) and _alike(row, other, allowed, turned[asked]):
                groups[place] = (replace(first, same=(*first.same, candidate.mistakes)), other)
                break
        else:
            groups.append((candidate, row))
    return tuple(candidate for candidate, _ in groups)


def _numbers(candidate: Candidate) -> tuple[str, ...]:
    return tuple(sorted(one.mistake for one in candidate.mistakes))


def _simplest(candidates: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
    """Leave out pairs of which one alone explains as much; put together those of one number that explain the same."""
    found: dict[tuple[tuple[str, ...], frozenset[str]], Candidate] = {}
    for candidate in candidates:
        if not any(_needless(candidate, other) for other in candidates):
            key = _numbers(candidate), frozenset(candidate.explained)
            first = found.get(key)
            same = () if first is None else (*first.same, candidate.mistakes, *candidate.same)
            found[key] = candidate if first is None else replace(first, same=same)
    return tuple(found.values())


def _needless(candidate: Candidate, other: Candidate) -> bool:
    """Whether another candidate explains as much with some of the same mistakes."""
    fewer = len(other.mistakes) < len(candidate.mistakes) and set(_numbers(other)) <= set(_numbers(candidate))
    return fewer and set(candidate.explained) <= set(other.explained)


def _alike(row: Any, other: Any, allowed: Floats, turned: NDArray[np.bool_]) -> bool:
    """Whether two rows differ by less than answers can tell: in size, and in direction where that is said."""
    apart = np.where(turned, np.abs(row - other), np.abs(np.abs(row) - np.abs(other)))
    return bool(np.all((apart <= ALIKE * allowed) | np.isnan(row)))
