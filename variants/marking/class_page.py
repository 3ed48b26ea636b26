"""A class on one HTML page: marks and their distribution, the commonest mistakes with a picture, equal millimetres."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from html import escape
from math import floor

from ...scales.errors import KulmanError
from ..case import Request
from ..roster import Entry
from .figures import plan_figures
from .keyed import Rubric
from .marked import Marked
from .report import page, scripts
from .result import Lines, Result, class_lines, commonest, flags_of, marked_of, names_of, shared_of
from .wording import heads, mistake_texts, texts

PAGE = ".html"
PICTURED = 5  # mistakes that have a picture
BARS = 10  # of the distribution
BAR, HIGH, FOOT = 14.0, 40.0, 6.0  # mm: width of a bar, the highest, room below for numbers
OWN_STYLE = """
@page{size:A4 landscape;margin:10mm}body{max-width:277mm}td{overflow-wrap:anywhere}tr,li{break-inside:avoid}
ol li{margin-bottom:4mm}td.m{text-align:right;font-weight:bold}
td:nth-child(2){min-width:58mm}td:nth-child(3){white-space:nowrap}td:nth-last-child(-n+2){min-width:40mm}
svg.bars{width:auto;height:52mm;border:0}svg.bars rect{fill:#0072b2}svg.bars text{font:3.5px Arial,sans-serif;
text-anchor:middle}figure{margin:2mm 0}figure svg{width:150mm;max-height:130mm}figcaption{font-size:9pt}
tr.flag td{background:#fff3c4}tr.absent td{color:#666}
@media print{section{break-inside:auto}h2{break-after:avoid}}
"""


@dataclass(frozen=True, slots=True)
class ClassPage:
    """The page about a class: its `lines` in order; `again` marks one of them once more, for a picture."""

    request: Request
    rubric: Rubric
    lines: Lines
    again: Callable[[Result], Marked]

    @property
    def said(self) -> dict[str, str]:
        """The texts of reports."""
        return texts(self.request.language)

    def html(self) -> str:
        """Return the page; every text in it is escaped, and it loads nothing."""
        language = self.request.language
        title = escape(f"{self.said['class.title']}: {self.request.task.title[language]}")
        *_, whole = class_lines(self.lines, language)
        head = f"<h1>{title}</h1><p class='first'>{escape(whole)}</p>"
        return page(title, language, head, *self._parts(), style=OWN_STYLE)

    def _parts(self) -> Iterator[str]:
        yield self._section("class.marks", self._distribution())
        yield self._section("class.title", self._table())
        counted = commonest(self.lines)
        items = "".join(self._mistake(name, students, at) for at, (name, students) in enumerate(counted))
        yield self._section(
            "class.commonest", f"<ol>{items}</ol>" if items else f"<p>{self.said['class.no_mistakes']}</p>"
        )
        if pairs := self._pairs():
            yield self._section("class.alike", pairs)

    def _section(self, key: str, body: str) -> str:
        return f"<section><h2>{escape(self.said[key])}</h2>{body}</section>"

    def _number(self, value: float) -> str:
        return f"{value:g}" if self.request.language == "en" else f"{value:g}".replace(".", ",")

    def _distribution(self) -> str:
        """Return how many have marks in each tenth of the full one, as bars."""
        full = self.rubric.out_of or 1.0
        marks = [result.mark for result in marked_of(self.lines) if result.mark is not None]
        counts = [0] * BARS
        for mark in marks:
            counts[min(max(floor(mark / full * BARS), 0), BARS - 1)] += 1
        most, drawn = max(counts) or 1, list[str]()
        for at, count in enumerate(counts):
            x, high = BAR * at, HIGH * count / most
            low, top = (self._number(round(full * k / BARS, 6)) for k in (at, at + 1))
            drawn.append(f'<text x="{x + BAR / 2:g}" y="{HIGH + 2 * FOOT - 2:g}">{low}–{top}</text>')
            if count:
                bar = f'x="{x + 1:g}" y="{FOOT + HIGH - high:.2f}" width="{BAR - 2:g}" height="{high:.2f}"'
                drawn.append(f'<rect {bar}/><text x="{x + BAR / 2:g}" y="{FOOT + HIGH - high - 1:.2f}">{count}</text>')
        name = escape(self.said["class.marks"])
        size = f'viewBox="0 0 {BAR * BARS:g} {HIGH + 2 * FOOT:g}"'
        return f'<svg class="bars" role="img" {size}><title>{name}</title>{"".join(drawn)}</svg>'

    def _table(self) -> str:
        """Return a row for each student: mark, first wrong step, mistakes in words, what is to be checked."""
        said, language = self.said, self.request.language
        grouped = any(line.who.group for line in self.lines)
        whose = ("about.student", *["about.group"] * grouped, "about.variant")
        keys = *whose, "class.mark", "class.first", "report.candidates"
        shown_heads = "".join(f"<th>{escape(head)}</th>" for head in heads((*keys, "report.flags"), language))
        rows = list[str]()
        names = names_of(self.lines, language)
        for name, line, flags in zip(names, self.lines, flags_of(self.lines, language), strict=True):
            about = (escape(name), *[escape(line.who.group)] * grouped, escape(line.variant))
            if isinstance(line, Entry):
                cells, kind = (*about, "–", escape(said["class.absent"]), "", ""), "absent"
            else:
                mark = "–" if line.mark is None else self._number(line.mark)
                notes = () if line.mark is not None else line.noted(language)  # why there is none
                told = "; ".join(line.explained(language, numbered=False))
                cells = *about, mark, scripts(line.first), scripts(told), escape("; ".join((*flags, *notes)))
                kind = "flag" if flags or notes else ""
                kind = "absent" if line.empty else kind
            shown = "".join(f"<td{' class=m' if at == len(about) else ''}>{cell}</td>" for at, cell in enumerate(cells))
            rows.append(f'<tr class="{kind}"><td>{len(rows) + 1}</td>{shown}</tr>')
        return f"<table><tr><th>№</th>{shown_heads}</tr>{''.join(rows)}</table>"

    def _mistake(self, name: str, students: list[Result], at: int) -> str:
        """Return what was done, by how many and whom, and the plan of one of them over the right one."""
        by = dict(zip(map(id, self.lines), names_of(self.lines, self.request.language), strict=True))
        names = ", ".join(escape(by[id(student)]) for student in students)
        text = f"<b>{scripts(mistake_texts(self.request.language)[name])}</b>"
        count = escape(self.said["class.of_students"].format(n=len(students)))
        figure = self._figure(students[0], by[id(students[0])]) if at < PICTURED else ""
        return f"<li>{text} – {count} ({names}){figure}</li>"

    def _figure(self, student: Result, name: str) -> str:
        try:
            found = list(plan_figures(self.again(student), self.request.language))
        except KulmanError:  # answers that have been marked can be marked again
            return ""
        wrong = next((figure for figure in found if 'class="wrong' in figure[1]), None)
        if wrong is None:
            return ""
        caption = f"{escape(wrong[0])}. {escape(self.said['class.figure'].format(student=name.removesuffix('.')))}"
        caption += f" {scripts(wrong[2])}" * bool(wrong[2])
        return f"<figure>{wrong[1]}<figcaption>{caption}</figcaption></figure>"

    def _pairs(self) -> str:
        """Return the pairs of students who have the same millimetres."""
        said, names = self.said, names_of(self.lines, self.request.language)
        rows = [
            f"<tr><td>{escape(names[pair.first])}</td><td>{escape(names[pair.second])}</td>"
            f"<td>{len(pair.names)} / {pair.of}</td><td>{pair.near} / {pair.of}</td></tr>"
            for pair in shared_of(self.lines)
        ]
        keys = "class.first_student", "class.second_student", "class.same", "class.near"
        heads = "".join(f"<th>{escape(said[key])}</th>" for key in keys)
        return (
            f"<p>{escape(said['class.alike_says'])}</p><table><tr>{heads}</tr>{''.join(rows)}</table>" if rows else ""
        )
