"""The report on one student: what is said, in one language, as text, as an HTML page to print on A4, as plain data."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from html import escape
from pathlib import Path
from typing import Any, TypeVar

from ...drawing.words import Words
from ...drawing.writers import save_all
from ...plans.marking.answers import Line, Verdict
from ...plans.marking.key import behind
from ...plans.mistakes.rules import Broken
from ...plans.names import role
from ...scales.units import format_unit
from ..roster import WHO
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..tables import aligned
from .figures import plan_figures
from .marked import Marked, Misfit
from .rubric import Rubric
from .wording import letter, mistake_texts, plain, script_runs, texts

T = TypeVar("T")
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


def _kept(tell: Callable[[Report], Iterator[T]]) -> cached_property[tuple[T, ...]]:
    """Say something once."""
    return cached_property(lambda report: tuple(tell(report)))


@dataclass(frozen=True, eq=False)
class Report:
    """What is said of one student's answers.

    `own` tells a student's report, in which nothing stands that would tell right numbers, from a teacher's; `checks` is
    what a teacher should check.
    """

    marked: Marked
    rubric: Rubric
    language: str
    own: bool
    checks: Sequence[str] = ()

    @property
    def said(self) -> dict[str, str]:
        """The texts of reports."""
        return texts(self.language)

    @property
    def words(self) -> Words:
        """The symbols and numbers of the task."""
        return self.marked.keyed.words

    @property
    def title(self) -> str:
        """The title of the task."""
        return self.marked.keyed.solution.task.title[self.language]

    @property
    def notes(self) -> tuple[str, ...]:
        """What was odd."""
        return tuple(note.text(self.language) for note in self.marked.notes)

    @property
    def flags(self) -> tuple[str, ...]:
        """What a teacher should check, such as segments that are too exact."""
        return () if self.own else tuple(self.checks)

    @_kept
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

    @_kept
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
            parts = self.marked.keyed.parts
            heading = next((plain(part.heading) for part in parts if first in {q.name for q in part.questions}), "")
            # inside of a sentence; S of a diagram stays the letter of a quantity
            within = heading[:1].lower() + heading[1:] if heading[1:2].isalpha() else heading
            yield said["report.first"].format(symbol=self.symbol(first), heading=within)

    @_kept
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

    @_kept
    def candidates(self) -> Iterator[str]:
        """Go through the mistakes that explain the answers, the simplest first, each with those that look the same."""
        if self.own:
            return
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
        text, where = mistake_texts(self.language)[broken.mistake], ""
        name, solution = role(broken.at).shown, self.marked.keyed.solution
        if name in solution.quantities or name in solution.task.givens:
            where = self.symbol(name)
        elif "." in broken.at:
            where = letter(self.words, broken.at)
        angle = broken.givens.get(broken.at) if broken.mistake in TURNED else None
        if isinstance(angle, float):
            where = self.said["report.crank"].format(symbol=where, angle=self._degrees(angle))
        told = self.said["report.candidate"].format(text=text, at=where) if where else text
        return f"{broken.mistake}: {told}"

    @_kept
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
            right, points = self._right(line), self.rubric.out_of * self.marked.parts[line.name]
            weight = self.words.short(round(points, 1), DIGITS)
            tolerance = f"± {self._number(line.name, line.allowed)}" if line.allowed else ""
        said = self.said[f"verdict.{line.verdict}"]
        return Row(line.name, self.symbol(line.name), self._answer(line), right, tolerance, line.verdict, said, weight)

    def symbol(self, name: str) -> str:
        """Return the symbol of a quantity as plain text."""
        return self.marked.keyed.symbol(name)

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


LISTS = ("again", "candidates", "flags", "notes")
COLUMNS = ("column.name", "report.answer", "report.right", "report.tolerance_column", "report.verdict", "report.weight")
OWN = (0, 1, 4)  # columns that a student sees


def report_text(report: Report) -> str:
    """Return the report as lines of text."""
    return "\n".join(_lines(report)) + "\n"


def _lines(report: Report) -> Iterator[str]:
    yield report.title
    yield "; ".join(f"{key}: {value}" for key, value in report.facts)
    yield ""
    yield from report.summary
    for key in LISTS:
        if items := getattr(report, key):
            yield ""
            yield f"{report.said[f'report.{key}']}:"
            yield from (f"  {item}" for item in items)
    for heading, rows in report.parts:
        yield ""
        yield heading
        table = [("", *(report.said[key] for key in COLUMNS[1:5]))]
        table += [(row.symbol, row.answer, row.right, row.tolerance, row.said) for row in rows]
        columns = OWN if report.own else range(5)
        listed = aligned([[cells[i] for i in columns] for cells in table], range(len(columns)))
        yield from (f"  {line}" for line in listed.split("\n"))


TAGS = {0: "", 1: "sup", -1: "sub"}
SIGNS = {Verdict.RIGHT: "✓", Verdict.CARRIED: "(✓)", Verdict.MISSING: "–"}
STYLE = """
body{font:11pt/1.4 "Segoe UI",Arial,sans-serif;max-width:180mm;margin:8mm auto;color:#000}
h1{font-size:15pt}h2{font-size:12pt;margin:6mm 0 2mm}
table{border-collapse:collapse;width:100%}th,td{border:1px solid #888;padding:1mm 2mm;text-align:left}
th{background:#eee}td.n{white-space:nowrap}tr.wrong td,tr.uncounted td,tr.arithmetic td,tr.scale td{background:#fbe3d6}
tr.missing td{color:#666}.first{font-weight:bold}
sub,sup{font-size:70%;line-height:0}
svg{width:100%;max-height:150mm;border:1px solid #ccc}svg path{fill:none;stroke-width:.5}
svg path.right{stroke:#0072b2;stroke-dasharray:5 1.2 1 1.2;stroke-width:.8}svg path.own{stroke:#000}
svg path.wrong{stroke:#d55e00;stroke-dasharray:2.5 1.2;stroke-width:.7}svg path.tip{stroke-dasharray:none}
svg path.right.tip{fill:#0072b2}svg path.own.tip{fill:#000}svg path.wrong.tip{fill:#d55e00}
svg text{font:3.5px Arial,sans-serif}svg text.wrong{fill:#d55e00}
@media print{body{margin:0}section{break-inside:avoid}}
"""


def report_html(report: Report) -> str:
    """Return the report as a page; every text in it is escaped, and it loads nothing."""
    title = escape(f"{report.said['report.title']}: {report.title}")
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
    body = "".join(_body(report, report.said))
    return f'<!DOCTYPE html>\n<html lang="{report.language}"><head>{head}</head><body>{body}</body></html>\n'


def _body(report: Report, said: dict[str, str]) -> Iterator[str]:
    yield f"<h1>{escape(report.title)}</h1>"
    facts = (f"{escape(key)}: <b>{escape(value)}</b>" for key, value in report.facts)
    yield f"<p>{'; '.join(facts)}</p>"
    *lines, last = report.summary
    yield f"<p>{'<br>'.join(map(escape, lines))}</p><p class='first'>{scripts(last)}</p>"
    for key in LISTS:
        if items := getattr(report, key):
            written = scripts if key in ("again", "candidates") else escape  # the others have names of files
            listed = "".join(f"<li>{written(item)}</li>" for item in items)
            yield f"<h2>{escape(said[f'report.{key}'])}</h2><ul>{listed}</ul>"
    for heading, rows in report.parts:
        yield f"<section><h2>{escape(heading)}</h2>{_table(report, rows)}</section>"
    figures = [] if report.own else list(plan_figures(report.marked, report.language))
    if figures:
        yield f"<p>{escape(said['report.figure'])}</p>"
    for heading, figure in figures:
        yield f"<section><h2>{escape(heading)}</h2>{figure}</section>"


def _table(report: Report, rows: tuple[Row, ...]) -> str:
    """Return the lines of one plan."""
    columns = OWN if report.own else range(len(COLUMNS))
    heads = "".join(f"<th>{escape(report.said[COLUMNS[i]])}</th>" for i in columns)
    table = f"<tr>{heads}</tr>"
    for row in rows:
        verdict = f"{SIGNS.get(row.verdict, '✗')} {escape(row.said)}"
        numbers = map(escape, (row.answer, row.right, row.tolerance))
        cells = (scripts(row.symbol), *numbers, verdict, escape(row.weight))
        table += f'<tr class="{row.verdict}">{"".join(f"<td>{cells[i]}</td>" for i in columns)}</tr>'
    return f"<table>{table}</table>"


@lru_cache(maxsize=4096)  # the symbols of a class are the same
def scripts(text: str) -> str:
    """Return text as HTML, with true superscripts and subscripts of the symbols in it.

    >>> scripts("a^n_BA < V_B"), scripts("F′_i2")
    ('a<sup>n</sup><sub>BA</sub> &lt; V<sub>B</sub>', 'F′<sub>i2</sub>')
    """
    runs = ((escape(run), TAGS[level]) for run, level in script_runs(text))
    return "".join(f"<{tag}>{run}</{tag}>" if tag else run for run, tag in runs)


def to_json(report: Report) -> dict[str, Any]:
    """Return what `kulman check --json` prints of one student; a student's own has no right numbers."""
    marked, own = report.marked, report.own
    rows = {row.name: row for _, rows in report.parts for row in rows}
    lines = [_line(line, rows[line.name], own) for line in marked.lines]
    key = marked.keyed
    found: dict[str, Any] = {
        "task": key.solution.task.id,
        "variant": key.solution.variant,
        "sheet": key.sheet,
        "mark": marked.mark,
        "out_of": report.rubric.out_of,
        "first_wrong": marked.marking.first_wrong,
        "counts": {str(verdict): marked.count(verdict) for verdict in Verdict},
        "notes": [*report.notes],
        "lines": lines,
    }
    if not own:
        found["mistakes"] = [
            {
                "mistakes": [{"id": broken.mistake, "at": broken.at} for broken in candidate.mistakes],
                "same": sorted(candidate.ids - {broken.mistake for broken in candidate.mistakes}),
                "explained": list(candidate.explained),
            }
            for candidate in marked.candidates
        ]
    return found


def _line(line: Line, row: Row, own: bool) -> dict[str, Any]:
    """Return one line as plain data, answer and right value also as they are shown."""
    found = {"quantity": line.name, "verdict": str(line.verdict), "about": line.about, "answer": row.answer}
    if own:
        return found
    right = line.right
    parts = {"x": right.real, "y": right.imag} if isinstance(right, complex) else {}
    size = math.hypot(right.real, right.imag) if parts else right
    return {**found, "right": {"value": size, **parts}, "allowed": line.allowed, "shown": row.right}


REPORTS: Mapping[str, Callable[[Report], str]] = {".html": report_html, ".txt": report_text}
SUFFIXES = (*REPORTS, *TABLES)  # of all that marks can be written to


def report_bytes(report: Report, suffix: str) -> bytes:
    """Return what a file of a report holds."""
    return REPORTS[suffix.lower()](report).encode("utf-8", "replace")  # bytes in a name of a file


def write_reports(report: Report, files: Sequence[Path]) -> None:
    """Write the report on one student to each file; the suffix picks text or HTML."""
    save_all(files, REPORTS, lambda file: [(file, report_bytes(report, file.suffix))])
