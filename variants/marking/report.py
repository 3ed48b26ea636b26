"""The report on one student: what is said, in one language, before it becomes text or HTML."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...drawing.words import Words
from ...plans.marking.verdicts import Line, Verdict, behind
from ...plans.mistakes.rules import Broken
from ...plans.names import role
from ...scales.units import format_unit
from ..roster import WHO
from .marked import Marked, Misfit
from .rubric import Rubric
from .wording import letter, mistake_texts, plain, texts

DIGITS, SCALE_DIGITS = 4, 3
ROUNDING, TOLD = 1e-9, 0.2  # parts of a tolerance: what is nothing, and what is worth telling
SHOWN_CANDIDATES = 3
TURNED = ("M08", "M09", "M10")  # mistakes that put the crank at another angle
AGAIN = {
    **dict.fromkeys(("meet", "tangent"), "again.meet"),
    **dict.fromkeys(("lay", "back", "chain", "same"), "again.lay"),
    **dict.fromkeys(("arc", "arcs", "template", "place"), "again.arc"),
    **{"similar": "again.similar", "divide": "again.divide", "calc": "again.calc", "arm": "again.arm"},
    **dict.fromkeys(("read", "measure", "distance", "moment", "pole"), "again.read"),
}


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the report; what only a teacher sees is empty for a student."""

    name: str
    symbol: str
    answer: str
    right: str
    tolerance: str
    verdict: Verdict
    said: str
    weight: str


@dataclass(frozen=True, slots=True)
class Report:
    """What is said of one student's answers; `parts` are headings with their lines.

    `own` tells a student's report, in which no right number stands, from a teacher's.
    """

    language: str
    own: bool
    title: str
    facts: tuple[tuple[str, str], ...]
    summary: tuple[str, ...]
    again: tuple[str, ...]
    candidates: tuple[str, ...]
    parts: tuple[tuple[str, tuple[Row, ...]], ...]
    notes: tuple[str, ...]
    flags: tuple[str, ...]
    marked: Marked


def report(marked: Marked, rubric: Rubric, language: str, own: bool, flags: Sequence[str] = ()) -> Report:
    """Put into words how a student's answers were marked.

    Parameters
    ----------
    own : bool
        For the student: without right numbers, and without what would tell them.
    flags : sequence of str
        What a teacher should check, such as answers that two students share.
    """
    teller = _Teller(marked, rubric, language, own)
    return Report(
        language,
        own,
        marked.keyed.solution.task.title[language],
        tuple(teller.facts()),
        tuple(teller.summary()),
        tuple(teller.again()),
        () if own else tuple(teller.candidates()),
        tuple(teller.parts()),
        tuple(note.text(language) for note in marked.notes),
        () if own else tuple(flags),
        marked,
    )


@dataclass(frozen=True, slots=True)
class _Teller:
    """Says it in one language."""

    marked: Marked
    rubric: Rubric
    language: str
    own: bool

    @property
    def said(self) -> dict[str, str]:
        """The texts of reports."""
        return texts(self.language)

    @property
    def words(self) -> Words:
        """The symbols and numbers of the task."""
        return self.marked.keyed.words

    def facts(self) -> Iterator[tuple[str, str]]:
        """Go through who it is, and what was marked."""
        answers, solution = self.marked.answers, self.marked.keyed.solution
        who = self.marked.entry.who if self.marked.entry else answers.who
        yield self.said["about.task"], solution.task.id
        yield self.said["about.variant"], solution.variant
        for key in WHO:
            if getattr(who, key) or getattr(answers.who, key):
                yield self.said[f"about.{key}"], getattr(who, key) or getattr(answers.who, key)
        yield self.said["about.sheet"], self.marked.keyed.sheet
        yield self.said["report.source"], answers.source

    def summary(self) -> Iterator[str]:
        """Go through mark, tolerance, verdicts by number, and the first wrong step."""
        said, short = self.said, self.words.short
        yield said["report.mark"].format(mark=short(self.marked.mark), full=short(self.rubric.out_of))
        tolerance = self.rubric.tolerance
        percent, degrees = short(tolerance.part * 100.0, DIGITS), short(tolerance.degrees, DIGITS)
        yield said["report.tolerance"].format(mm=short(tolerance.mm, DIGITS), percent=percent, degrees=degrees)
        counts = Counter(line.verdict for line in self.marked.lines)
        listed = (f"{said[f'verdict.{verdict}']} {counts[verdict]}" for verdict in Verdict if counts[verdict])
        yield f"{said['report.counts']}: {', '.join(listed)}"
        first = self.marked.marking.first_wrong
        if first is None:
            yield said["report.no_wrong"]
        else:
            heading = self._heading(first)
            # inside of a sentence; S of a diagram stays the letter of a quantity
            within = heading[:1].lower() + heading[1:] if heading[1:2].isalpha() else heading
            yield said["report.first"].format(symbol=self.symbol(first), heading=within)

    def again(self) -> Iterator[str]:
        """Go through what to look at again, the first wrong step first; a student is told how to go on."""
        lines = self.marked.marking.lines
        if self.marked.fits:
            yield self.said["again.variant"]
            return
        for line in lines:
            misfit = self.marked.misfits.get(line.name)
            if misfit is not None:
                yield self._scale(misfit)
            if line.verdict.faulty and not (misfit and line.verdict is Verdict.SCALE):
                yield self.hint(line)
        unknown = ", ".join(self.symbol(line.name) for line in lines if line.verdict is Verdict.UNCOUNTED)
        if unknown:
            yield self.said["again.uncounted"].format(symbols=unknown)
        if self.own and self.marked.marking.first_wrong is not None:
            yield self.said["again.then"]

    def _scale(self, misfit: Misfit) -> str:
        """Return what is wrong with a scale factor that stands in its own row."""
        si, display = self.marked.keyed.asked.scales[misfit.symbol], self.words.display.of_scales
        unit = format_unit(f"({display.unit(si)})/mm", self.language)
        ratio = misfit.written / misfit.fits
        return self.said["again.large" if ratio > 1.0 else "again.small"].format(
            symbol=self.symbol(misfit.symbol),
            times=self.words.short(max(ratio, 1.0 / ratio), 2),
            fits=f"{self.words.short(display.value(misfit.fits, si), SCALE_DIGITS)} {unit}",
        )

    def hint(self, line: Line) -> str:
        """Return what to look at again because of a line, without saying what would be right."""
        symbol = self.symbol(line.name)
        if line.verdict in (Verdict.ARITHMETIC, Verdict.SCALE):
            return self.said[f"again.{line.verdict}"].format(symbol=symbol)
        if line.about == "direction":
            return self.said["again.direction"].format(symbol=symbol)
        step = behind(self.marked.keyed.key, line.name)
        key = AGAIN[step.verb]
        mark = letter(self.words, step.name) if "{mark}" in self.said[key] else ""
        return f"{symbol}: {self.said[key].format(symbol=symbol, mark=mark)}"

    def candidates(self) -> Iterator[str]:
        """Go through the mistakes that explain the answers, the simplest first, each with those that look the same."""
        if self.marked.slips:
            yield self.said["report.slip"]
        for number, candidate in enumerate(self.marked.candidates[:SHOWN_CANDIDATES], start=1):
            names = ", ".join(self.symbol(name) for name in candidate.explained)
            explains = f"; {self.said['report.explains'].format(names=names)}" if names else ""
            yield f"{number}. {self._mistakes(candidate.mistakes)}{explains}"
            others = dict.fromkeys(self._mistakes(found) for found in candidate.same)
            others.pop(self._mistakes(candidate.mistakes), None)
            for text in list(others)[:SHOWN_CANDIDATES]:
                yield self.said["report.same"].format(texts=text)

    def _mistakes(self, found: tuple[Broken, ...]) -> str:
        """Return mistakes that were made together, in the order of the list."""
        ordered = sorted(found, key=lambda broken: (broken.mistake, broken.at))
        return self.said["report.and"].join(self.mistake(broken) for broken in ordered)

    def mistake(self, broken: Broken) -> str:
        """Return what was done, and where."""
        text, where = mistake_texts(self.language)[broken.mistake], self._where(broken.at)
        angle = broken.givens.get(broken.at) if broken.mistake in TURNED else None
        if isinstance(angle, float):
            where = self.said["report.crank"].format(symbol=where, angle=self._degrees(angle))
        told = self.said["report.candidate"].format(text=text, at=where) if where else text
        return f"{broken.mistake}: {told}"

    def _where(self, at: str) -> str:
        """Return the symbol of a quantity or given, or the letter of a mark, at which a rule was broken."""
        name = role(at).shown
        if name in self.marked.keyed.solution.quantities or name in self.marked.keyed.solution.task.givens:
            return self.symbol(name)
        return letter(self.words, at) if "." in at else ""

    def parts(self) -> Iterator[tuple[str, tuple[Row, ...]]]:
        """Go through the lines that count, plan by plan."""
        lines = {line.name: line for line in self.marked.lines}
        for part in self.marked.keyed.parts:
            rows = tuple(self.row(lines[q.name]) for q in part.questions if q.name in lines)
            if rows:
                yield plain(part.heading), rows

    def row(self, line: Line) -> Row:
        """Put a line into words."""
        right = tolerance = weight = ""
        if not self.own:
            right, weight = self._right(line), self._points(line)
            tolerance = f"± {self._number(line.name, line.allowed)}" if line.allowed else ""
        said = self.said[f"verdict.{line.verdict}"]
        return Row(line.name, self.symbol(line.name), self._answer(line), right, tolerance, line.verdict, said, weight)

    def _points(self, line: Line) -> str:
        """Return what part of the full mark a line is."""
        return self.words.short(round(self.rubric.out_of * self.marked.parts[line.name], 1), DIGITS)

    def symbol(self, name: str) -> str:
        """Return the symbol of a quantity as plain text."""
        return self.marked.keyed.symbol(name)

    def _heading(self, name: str) -> str:
        parts = self.marked.keyed.parts
        return next((plain(part.heading) for part in parts if name in {q.name for q in part.questions}), "")

    def _number(self, name: str, value: float) -> str:
        """Return a value in the units of the task, with its unit; what is nothing but rounding is zero."""
        allowed = self.marked.marking.key.allowed.get(name, 0.0)
        value = value if abs(value) > ROUNDING * allowed else 0.0
        si = self.marked.keyed.solution.quantities[name].unit
        shown = self.words.display.value(value, si)
        return f"{self.words.short(shown, DIGITS)} {format_unit(self.words.display.unit(si), self.language)}".rstrip()

    def _answer(self, line: Line) -> str:
        """Return what the student has written."""
        answer = line.answer
        if answer is None or answer.empty:
            return "–"
        parts = []
        if answer.mm is not None:
            parts.append(f"{self.words.short(answer.mm, DIGITS)} {format_unit('mm', self.language)}")
        if answer.value is not None:
            parts.append("+" * answer.plus + self._number(line.name, answer.value))
        if answer.direction is not None:
            parts.append(self._degrees(answer.direction))
        if answer.sense is not None:
            parts.append("+" if answer.sense > 0 else "−")
        return "; ".join(parts)

    def _degrees(self, radians: float) -> str:
        return f"{self.words.short(round(math.degrees(radians), 1) % 360.0, DIGITS)}°"

    def _right(self, line: Line) -> str:
        """Return the right value, and what follows from the answers before it where that is another one."""
        right = self._value(line.name, line.right)
        other = line.answer is not None and line.follows == line.follows
        if other and abs(line.follows - line.right) > TOLD * line.allowed:
            return f"{right} → {self._value(line.name, line.follows)}"
        return right

    def _value(self, name: str, value: float | complex) -> str:
        """Return a value; of a vector its magnitude and direction."""
        if not isinstance(value, complex):
            return self._number(name, value)
        size = math.hypot(value.real, value.imag)
        text = self._number(name, size)
        return f"{text}; {self._degrees(math.atan2(value.imag, value.real))}" if size else text
