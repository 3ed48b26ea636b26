"""The report on one student: what is said, in one language, as text, as an HTML page to print on A4, as plain data."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from ...drawing.words import Words
from ...drawing.writers import Files
from ...plans.marking.answers import QUARTER, Line, Verdict
from ...plans.marking.key import behind
from ...plans.mistakes.explaining import ANGLED
from ...plans.mistakes.rules import Broken
from ...plans.names import role
from ...scales.errors import InputError, spoken
from ...scales.numbers import SHOWN, quote
from ..drawings.files import SUFFIXES as DRAWINGS
from ..roster import WHO
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..tables import Saved, aligned
from .figures import SIGNS, plan_figures
from .keyed import Rubric, is_arm_of_lever
from .marked import Marked, Misfit
from .wording import letter, mistake_texts, plain, script_runs, texts

PHOTOS = (".png", ".pdf")  # of photographs that are returned with verdicts
DIGITS, SCALE_DIGITS = 4, 3
ROUNDING, TOLD = 1e-9, 0.2  # parts of a tolerance: what is nothing, and what is worth telling
SHOWN_CANDIDATES = 3
LIKE = {
    "meet": ("meet", "tangent"),
    "lay": ("lay", "back", "chain", "same"),
    "arc": ("arc", "arcs", "template", "place"),
    "read": ("read", "measure", "distance", "moment", "pole"),
}
AGAIN = {verb: kind for kind, verbs in LIKE.items() for verb in verbs}  # what is told of a verb; of others their own


class _Row(NamedTuple):
    """One line of the report, in words; what only a teacher sees is empty for a student."""

    line: Line
    symbol: str
    answer: str
    right: str
    tolerance: str
    verdict: str
    weight: str


@dataclass(frozen=True, eq=False, repr=False)
class Report(Saved):
    """What is said of one student's answers; `save` writes `.html`, `.txt`, of a drawing or photographs that, too.

    `own` tells a student's report, in which nothing stands that would tell right numbers, from a teacher's; `checks` is
    what a teacher should check.
    """

    suffixes = (".html", ".txt", *DRAWINGS, ".png")
    marked: Marked
    rubric: Rubric
    language: str
    own: bool
    checks: Sequence[str] = ()

    def __repr__(self) -> str:
        """Return whose report it is, and the mark."""
        return f"<Report {self.marked.answers.source}: {self.mark:g}>"

    def _repr_html_(self) -> str:
        """Show the report in a notebook."""
        return report_html(self)

    @property
    def mark(self) -> float:
        """The mark, out of `rubric.out_of`."""
        return self.marked.mark

    def text(self) -> str:
        """Return the report as text, as the console shows it."""
        return report_text(self)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman check --json` prints of one student; a student's own has no right numbers."""
        marked, key = self.marked, self.marked.keyed
        rows = {row.line.name: row for _, rows in self.parts for row in rows}
        found: dict[str, Any] = {
            "task": key.solution.task.id,
            "variant": key.solution.variant,
            "sheet": key.sheet,
            "mark": marked.mark,
            "out_of": self.rubric.out_of,
            "first_wrong": marked.marking.first_wrong,
            "counts": {str(verdict): marked.count(verdict) for verdict in Verdict},
            "notes": [note.text(self.language) for note in marked.notes],
            "lines": [_line(rows[line.name], self.own) for line in marked.lines],
        }
        if not self.own:
            found["mistakes"] = [
                {
                    "mistakes": [{"id": broken.mistake, "at": broken.at} for broken in candidate.mistakes],
                    "same": sorted(candidate.ids - {broken.mistake for broken in candidate.mistakes}),
                    "explained": list(candidate.explained),
                }
                for candidate in marked.candidates
            ]
        return found

    def files(self, path: Path) -> Files:
        """Return the file of a report, or of the drawing with verdicts over it."""
        suffix, answers = path.suffix.lower(), self.marked.answers
        if self.marked.sheets is not None and suffix in PHOTOS:
            from ..photos.returned import photo_files

            return photo_files(self.marked, self.language, self.own, path)
        if suffix in REPORTS:
            return [(path, REPORTS[suffix](self).encode("utf-8", "replace"))]  # bytes in a name of a file
        if answers.drawn is None or suffix not in DRAWINGS:
            raise InputError("drawing-alone", file=quote(path, SHOWN))
        from .overlay import marked_files

        return marked_files(self.marked, self.language, self.own, path)

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        return self.files(path)

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

    def symbol(self, name: str) -> str:
        """Return the symbol of a quantity as plain text."""
        return self.marked.keyed.symbol(name)

    def facts(self) -> Iterator[tuple[str, str]]:
        """Go through who it is, and what was marked."""
        answers, solution = self.marked.answers, self.marked.keyed.solution
        who = self.marked.entry.who if self.marked.entry else answers.who
        told = {key: getattr(who, key) or getattr(answers.who, key) for key in WHO}
        told = {"task": solution.task.id, "variant": solution.variant, **told, "sheet": self.marked.keyed.sheet}
        yield from ((self.said[f"about.{key}"], value) for key, value in told.items() if value or key not in WHO)
        if answers.source:
            yield self.said["report.source"], spoken(answers.source, self.language)

    def summary(self) -> Iterator[str]:
        """Go through mark, tolerance, verdicts by number, and the first wrong step."""
        said, short, most = self.said, self.words.short, self.rubric.tolerance
        yield said["report.mark"].format(mark=short(self.marked.mark), full=short(self.rubric.out_of))
        numbers = {"mm": most.mm, "percent": most.part * 100.0, "degrees": most.degrees}
        yield said["report.tolerance"].format(**{key: short(value, DIGITS) for key, value in numbers.items()})
        counts = Counter(line.verdict for line in self.marked.lines)
        listed = (f"{said[f'verdict.{verdict}']} {counts[verdict]}" for verdict in Verdict if counts[verdict])
        yield f"{said['report.counts']}: {', '.join(listed)}"
        first, keyed = self.marked.marking.first_wrong, self.marked.keyed
        if first is None:
            yield said["report.no_wrong"]
        else:
            heading = plain(keyed.parts[int(keyed.by_plan[first])].heading)
            # inside of a sentence; S of a diagram stays the letter of a quantity
            within = heading[:1].lower() + heading[1:] if heading[1:2].isalpha() else heading
            yield said["report.first"].format(symbol=self.symbol(first), heading=within)

    @cached_property
    def lists(self) -> dict[str, tuple[str, ...]]:
        """What to look at again, mistakes that explain the answers, what a teacher should check, what was odd."""
        said = (note.text(self.language) for note in self.marked.notes)
        notes = tuple(note for note in said if self.own or note not in self.checks)
        teachers = {} if self.own else {"candidates": tuple(self._candidates()), "flags": tuple(self.checks)}
        return {"again": tuple(self._again()), **teachers, "notes": notes}

    def _again(self) -> Iterator[str]:
        """Go through what to look at again, the first wrong step first; a student is told how to go on."""
        lines, misfits = self.marked.marking.lines, self.marked.misfits
        if self.marked.fits:
            yield self.said["again.variant"]
            return
        for line in lines:
            if line.name in misfits:
                yield self._scale(misfits[line.name])
            if line.verdict.faulty and not (line.name in misfits and line.verdict is Verdict.SCALE):
                yield self._hint(line)
        unknown = ", ".join(self.symbol(line.name) for line in lines if line.verdict is Verdict.UNCOUNTED)
        if unknown:
            yield self.said["again.uncounted"].format(symbols=unknown)
        if self.own and self.marked.marking.first_wrong is not None:
            yield self.said["again.then"]

    def _scale(self, misfit: Misfit) -> str:
        """Return what is wrong with a scale factor that stands in its own row."""
        si, short = self.marked.keyed.asked.scales[misfit.symbol], self.words.short
        display = self.words.display.of_scales
        unit = self.words.spelled(f"({display.unit(si)})/mm")
        ratio = misfit.written / misfit.fits
        return self.said["again.large" if ratio > 1.0 else "again.small"].format(
            symbol=self.symbol(misfit.symbol),
            times=short(max(ratio, 1.0 / ratio), 2),
            fits=f"{short(display.value(misfit.fits, si), SCALE_DIGITS)} {unit}",
        )

    def _hint(self, line: Line) -> str:
        """Return what to look at again because of a line, without saying what would be right."""
        symbol = self.symbol(line.name)
        if line.verdict is not Verdict.WRONG or line.about == "direction":
            key = line.verdict if line.verdict is not Verdict.WRONG else line.about
            return self.said[f"again.{key}"].format(symbol=symbol)
        step = behind(self.marked.keyed.key, line.name)
        text = self.said[f"again.{AGAIN.get(step.verb, step.verb)}"]
        mark = letter(self.words, step.name) if "{mark}" in text else ""
        return f"{symbol}: {text.format(symbol=symbol, mark=mark)}"

    def _candidates(self) -> Iterator[str]:
        """Go through the mistakes that explain the answers, the simplest first, each with those that look the same."""
        if self.marked.slips:
            yield self.said["report.slip"]
        elif self.marked.untold:
            yield self.said["report.untold"]
        faulty = sum(line.verdict is Verdict.WRONG for line in self.marked.marking.lines)
        if faulty and not self.marked.candidates and not self.marked.fits:
            yield self.said["report.unexplained"].format(n=faulty)
        for number, candidate in enumerate(self.marked.candidates[:SHOWN_CANDIDATES], start=1):
            names = ", ".join(self.symbol(name) for name in candidate.explained)
            explains = f"; {self.said['report.explains'].format(names=names)}" if names else ""
            told = self._mistakes(candidate.mistakes)
            yield f"{number}. {told}{explains}"
            others = dict.fromkeys(text for text in map(self._mistakes, candidate.same) if text != told)
            shown = list(others)[: None if self.marked.untold else SHOWN_CANDIDATES]
            yield from (self.said["report.same"].format(texts=text) for text in shown)

    def _mistakes(self, together: tuple[Broken, ...]) -> str:
        """Return mistakes that were made together, in the order of the list: what was done, and where."""
        texts = []
        for broken in sorted(together, key=lambda broken: (broken.mistake, broken.at)):
            text, where = mistake_texts(self.language)[broken.mistake], ""
            name, solution = role(broken.at).shown, self.marked.keyed.solution
            if name in solution.quantities or name in solution.task.givens:
                where = self.symbol(name)
            elif "." in broken.at:
                where = letter(self.words, broken.at)
            angle = broken.givens.get(broken.at) if broken.mistake in ANGLED else None
            if isinstance(angle, float):
                where = self.said["report.crank"].format(symbol=where, angle=self._degrees(angle))
            text = self.said["report.candidate"].format(text=text, at=where) if where else text
            texts.append(f"{broken.mistake}: {text}")
        return self.said["report.and"].join(texts)

    @cached_property
    def parts(self) -> list[tuple[str, list[_Row]]]:
        """The lines that count, plan by plan."""
        lines = {line.name: line for line in self.marked.lines}
        parts = self.marked.keyed.parts
        rows = ([self._row(lines[q.name]) for q in part.questions if q.name in lines] for part in parts)
        return [(plain(part.heading), own) for part, own in zip(parts, rows, strict=True) if own]

    def _row(self, line: Line) -> _Row:
        """Put a line into words."""
        right = tolerance = weight = ""
        if not self.own:
            right, answered = self._shown(line, line.right), line.answer is not None
            if answered and abs(line.follows - line.right) > TOLD * line.allowed:  # NaN is none
                right += f" → {self._shown(line, line.follows)}"
            weight = self.words.short(round(self.rubric.out_of * self.marked.parts[line.name], 1), DIGITS)
            tolerance = f"± {self._shown(line, line.allowed)}" if line.allowed else ""
        verdict = self.said[f"verdict.{line.verdict}"]
        verdict += f"; {self.said['report.halved']}" if self.rubric.halves(line) else ""
        return _Row(line, self.symbol(line.name), self._answer(line), right, tolerance, verdict, weight)

    def _answer(self, line: Line) -> str:
        """Return what the student has written."""
        answer = line.answer
        if answer is None or answer.empty:
            return "–"
        parts = []
        reply = self.marked.answers.lines[line.name]
        written = reply.mm  # in a detail, or on another drawing
        if answer.mm is not None or written is not None:
            unit = reply.foreign[0] or self.words.spelled("mm")
            parts.append(f"{self.words.short(written or answer.mm or 0.0, DIGITS)} {unit}")
        if answer.value is not None:
            value = self._value(line.name, answer.value)
            value = f"{value.rpartition(' ')[0]} {reply.foreign[1]}" if reply.foreign[1] else value
            parts.append("+" * answer.plus + value)
        if answer.direction is not None:
            parts.append(self._degrees(answer.direction) + f" ± {math.degrees(QUARTER):.0f}°" * answer.side)
        if answer.sense is not None:
            parts.append("+" if answer.sense > 0 else "−")
        return "; ".join(parts)

    def _degrees(self, radians: float) -> str:
        return f"{self.words.short(round(math.degrees(radians), 1) % 360.0, DIGITS)}°"

    def _shown(self, line: Line, value: float | complex) -> str:
        """Return what is right, or a tolerance: of an arm on the lever in the student's own millimetres.

        Where there is no answer they are those of the plan.
        """
        mu, answer = None, line.answer
        if is_arm_of_lever(line.name) and answer is None:
            mu = self.marked.marking.key.paper.mus.get(line.plan)
        elif is_arm_of_lever(line.name) and answer and answer.value is None and answer.mm and line.way:
            mu = line.way.size and line.way.size / abs(answer.mm)
        if not mu or isinstance(value, complex):
            return self._value(line.name, value)
        return f"{self.words.number(abs(value) / mu, 1)} {self.words.spelled('mm')}"

    def _value(self, name: str, value: float | complex) -> str:
        """Return a value in the units of the task, of a vector its magnitude and direction; rounding alone is zero."""
        if isinstance(value, complex):
            size = math.hypot(value.real, value.imag)
            text = self._value(name, size)
            return f"{text}; {self._degrees(math.atan2(value.imag, value.real))}" if size else text
        value = value if abs(value) > ROUNDING * self.marked.marking.key.allowed.get(name, 0.0) else 0.0
        return self.words.amount(value, self.marked.keyed.solution.quantities[name].unit, DIGITS)


COLUMNS = ("column.name", "report.answer", "report.right", "report.tolerance_column", "report.verdict", "report.weight")
OWN, VERDICT = (0, 1, 4), 4  # columns that a student sees, and the one of words


def report_text(report: Report) -> str:
    """Return the report as lines of text."""
    lines = [report.title, "; ".join(f"{key}: {value}" for key, value in report.facts()), "", *report.summary()]
    for key, items in report.lists.items():
        if items:
            lines += ["", f"{report.said[f'report.{key}']}:", *(f"  {item}" for item in items)]
    for heading, rows in report.parts:
        table = [("", *(report.said[key] for key in COLUMNS[1:5])), *(row[1:6] for row in rows)]
        columns = OWN if report.own else range(5)
        listed = aligned([[cells[i] for i in columns] for cells in table], range(len(columns)))
        lines += ["", heading, *(f"  {line}" for line in listed.split("\n"))]
    return "\n".join(lines) + "\n"


TAGS = {0: "", 1: "sup", -1: "sub"}
STYLE = """
body{font:11pt/1.4 "Segoe UI",Arial,sans-serif;max-width:180mm;margin:8mm auto;color:#000}
@media screen{body{padding:0 4mm}}h1{font-size:15pt}h2{font-size:12pt;margin:6mm 0 2mm}
table{border-collapse:collapse;width:100%}th,td{border:1px solid #888;padding:1mm 2mm;text-align:left}
th{background:#eee}td.n,.lines td:not(.v){white-space:nowrap}
tr.wrong td,tr.uncounted td,tr.arithmetic td,tr.scale td{background:#fbe3d6}
tr.missing td,tr.small td{color:#666}.first{font-weight:bold}
sub,sup{font-size:70%;line-height:0}
svg{width:100%;max-height:150mm;border:1px solid #ccc}svg path{fill:none;stroke-width:.5}
svg path.right{stroke:#0072b2;stroke-dasharray:5 1.2 1 1.2;stroke-width:.8}svg path.own{stroke:#000}
svg path.wrong{stroke:#d55e00;stroke-dasharray:2.5 1.2;stroke-width:.7}svg path.tip{stroke-dasharray:none}
svg path.right.tip{fill:#0072b2}svg path.own.tip{fill:#000}svg path.wrong.tip{fill:#d55e00}
img.drawing{width:100%;border:1px solid #ccc}
svg text{font:3.5px Arial,sans-serif}svg text.wrong{fill:#d55e00}
@media print{body{margin:0}section{break-inside:avoid}}
"""


def report_html(report: Report) -> str:
    """Return the report as a page; every text in it is escaped, and it loads nothing."""
    title = escape(f"{report.said['report.title']}: {report.title}")
    return page(title, report.language, *_body(report, report.said))


def page(title: str, language: str, *parts: str, style: str = "") -> str:
    """Return a page that looks as reports do, with a `style` of its own; title and parts are HTML already."""
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}{style}</style>'
    return f'<!DOCTYPE html>\n<html lang="{language}"><head>{head}</head><body>{"".join(parts)}</body></html>\n'


def _body(report: Report, said: dict[str, str]) -> Iterator[str]:
    yield f"<h1>{escape(report.title)}</h1>"
    facts = (f"{escape(key)}: <b>{escape(value)}</b>" for key, value in report.facts())
    yield f"<p>{'; '.join(facts)}</p>"
    *lines, last = report.summary()
    yield f"<p>{'<br>'.join(map(escape, lines))}</p><p class='first'>{scripts(last)}</p>"
    for key, items in report.lists.items():
        if items:
            written = scripts if key in ("again", "candidates") else escape  # the others have names of files
            listed = "".join(f"<li>{written(item)}</li>" for item in items)
            yield f"<h2>{escape(said[f'report.{key}'])}</h2><ul>{listed}</ul>"
    columns = OWN if report.own else range(len(COLUMNS))
    heads = "".join(f"<th>{escape(said[COLUMNS[i]])}</th>" for i in columns)
    for heading, rows in report.parts:
        yield f'<section class="lines"><h2>{escape(heading)}</h2><table><tr>{heads}</tr>'
        for row in rows:
            verdict = f"{SIGNS.get(row.line.verdict, '✗')} {escape(row.verdict)}"
            answer, right, tolerance = map(escape, row[2:5])
            right = right.replace(" → ", "<br>→ ")
            cells = scripts(row.symbol), answer, right, tolerance, verdict, escape(row.weight)
            shown = (f"<td{' class=v' * (i == VERDICT)}>{cells[i]}</td>" for i in columns)
            yield f'<tr class="{row.line.verdict}">{"".join(shown)}</tr>'
        yield "</table></section>"
    sources, heading = list[str](), escape(said["report.drawing"])
    if report.marked.sheets is not None:
        from ..photos.returned import pictures

        sources = [*pictures(report.marked, report.language, report.own)]
    elif report.marked.seen is not None:
        from .overlay import picture

        sources = [picture(report.marked, report.language, report.own)]
    for source in sources:
        yield f'<section><h2>{heading}</h2><img class="drawing" alt="{heading}" src="{source}"></section>'
    figures = [] if report.own else list(plan_figures(report.marked, report.language))
    if figures:
        yield f"<p>{escape(said['report.figure'])}</p>"
    for heading, figure, told in figures:
        yield f"<section><h2>{escape(heading)}</h2>{figure}{f'<p>{scripts(told)}</p>' * bool(told)}</section>"


@lru_cache(maxsize=4096)  # the symbols of a class are the same
def scripts(text: str) -> str:
    """Return text as HTML, with true superscripts and subscripts of the symbols in it.

    >>> scripts("a^n_BA < V_B"), scripts("F′_i2")
    ('a<sup>n</sup><sub>BA</sub> &lt; V<sub>B</sub>', 'F′<sub>i2</sub>')
    """
    runs = ((escape(run), TAGS[level]) for run, level in script_runs(text))
    return "".join(f"<{tag}>{run}</{tag}>" if tag else run for run, tag in runs)


def _line(row: _Row, own: bool) -> dict[str, Any]:
    """Return one line as plain data, answer and right value also as they are shown."""
    line, right = row.line, row.line.right
    found = {"quantity": line.name, "verdict": str(line.verdict), "about": line.about, "answer": row.answer}
    vector = isinstance(right, complex)
    size = (
        {"value": math.hypot(right.real, right.imag), "x": right.real, "y": right.imag} if vector else {"value": right}
    )
    return found if own else {**found, "right": size, "allowed": line.allowed, "shown": row.right}


REPORTS: Mapping[str, Callable[[Report], str]] = {".html": report_html, ".txt": report_text}
SUFFIXES = (*REPORTS, *TABLES, *DRAWINGS, ".png")  # of all that marks can be written to
