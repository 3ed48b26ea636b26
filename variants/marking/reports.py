"""The report on one student as text, as an HTML page that needs nothing else and prints on A4, as plain data."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache
from html import escape
from pathlib import Path
from typing import Any

from ...drawing.writers import save_all
from ...plans.marking.verdicts import Line, Verdict
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..tables import aligned
from .figures import plan_figures
from .report import Report, Row
from .rubric import Rubric
from .wording import script_runs, texts


def report_text(report: Report) -> str:
    """Return the report as lines of text."""
    return "\n".join(_lines(report)) + "\n"


def _lines(report: Report) -> Iterator[str]:
    said = texts(report.language)
    yield report.title
    yield "; ".join(f"{key}: {value}" for key, value in report.facts)
    yield ""
    yield from report.summary
    for heading, items in (
        (said["report.again"], report.again),
        (said["report.candidates"], report.candidates),
        (said["report.flags"], report.flags),
        (said["report.notes"], report.notes),
    ):
        if items:
            yield ""
            yield f"{heading}:"
            yield from (f"  {item}" for item in items)
    for heading, rows in report.parts:
        yield ""
        yield heading
        yield from _columns(report, rows)


def _columns(report: Report, rows: tuple[Row, ...]) -> Iterator[str]:
    """Go through the lines of a plan, in columns."""
    said = texts(report.language)
    head = ("", said["report.answer"], said["report.right"], said["report.tolerance_column"], said["report.verdict"])
    table: list[tuple[str, ...]] = [head]
    table += [(row.symbol, row.answer, row.right, row.tolerance, row.said) for row in rows]
    if report.own:
        table = [(*cells[:2], cells[-1]) for cells in table]
    yield from (f"  {line}" for line in aligned(table, range(len(table[0]))).split("\n"))


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
    said = texts(report.language)
    body = "".join(_body(report, said))
    title = escape(f"{said['report.title']}: {report.title}")
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html>\n<html lang="{report.language}"><head>{head}</head><body>{body}</body></html>\n'


def _body(report: Report, said: dict[str, str]) -> Iterator[str]:
    yield f"<h1>{escape(report.title)}</h1>"
    facts = (f"{escape(key)}: <b>{escape(value)}</b>" for key, value in report.facts)
    yield f"<p>{'; '.join(facts)}</p>"
    *lines, last = report.summary
    yield f"<p>{'<br>'.join(map(escape, lines))}</p><p class='first'>{scripts(last)}</p>"
    for key in ("again", "candidates", "flags", "notes"):
        items: tuple[str, ...] = getattr(report, key)
        if items:
            written = scripts if key in ("again", "candidates") else escape  # the others have names of files
            listed = "".join(f"<li>{written(item)}</li>" for item in items)
            yield f"<h2>{escape(said[f'report.{key}'])}</h2><ul>{listed}</ul>"
    for heading, rows in report.parts:
        yield f"<section><h2>{escape(heading)}</h2>{_table(report, rows, said)}</section>"
    if not report.own:
        figures = list(plan_figures(report.marked, report.language))
        if figures:
            yield f"<p>{escape(said['report.figure'])}</p>"
        for heading, figure in figures:
            yield f"<section><h2>{escape(heading)}</h2>{figure}</section>"


def _table(report: Report, rows: tuple[Row, ...], said: dict[str, str]) -> str:
    """Return the lines of one plan."""
    keys = (
        "column.name",
        "report.answer",
        "report.right",
        "report.tolerance_column",
        "report.verdict",
        "report.weight",
    )
    shown = tuple(key for key in keys if not (report.own and key in keys[2:4] + keys[5:]))
    head = "".join(f"<th>{escape(said[key])}</th>" for key in shown)
    body = "".join(_row(row, report.own) for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def _row(row: Row, own: bool) -> str:
    verdict = f"{SIGNS.get(row.verdict, '✗')} {row.said}"
    cells = (
        (row.symbol, row.answer, verdict)
        if own
        else (row.symbol, row.answer, row.right, row.tolerance, verdict, row.weight)
    )
    symbol, *others = cells
    listed = "".join(f"<td>{escape(cell)}</td>" for cell in others)
    return f'<tr class="{row.verdict}"><td>{scripts(symbol)}</td>{listed}</tr>'


@lru_cache(maxsize=4096)  # the symbols of a class are the same
def scripts(text: str) -> str:
    """Return text as HTML, with true superscripts and subscripts of the symbols in it.

    >>> scripts("a^n_BA < V_B"), scripts("F′_i2")
    ('a<sup>n</sup><sub>BA</sub> &lt; V<sub>B</sub>', 'F′<sub>i2</sub>')
    """
    runs = ((escape(run), TAGS[level]) for run, level in script_runs(text))
    return "".join(f"<{tag}>{run}</{tag}>" if tag else run for run, tag in runs)


def to_json(report: Report, rubric: Rubric) -> dict[str, Any]:
    """Return what `kulman check --json` prints of one student; a student's own has no right numbers."""
    marked, own, language = report.marked, report.own, report.language
    rows = {row.name: row for _, rows in report.parts for row in rows}
    lines = [_line(line, rows[line.name], own) for line in marked.lines]
    key = marked.keyed
    found: dict[str, Any] = {
        "task": key.solution.task.id,
        "variant": key.solution.variant,
        "sheet": key.sheet,
        "mark": marked.mark,
        "out_of": rubric.out_of,
        "first_wrong": marked.marking.first_wrong,
        "counts": {str(verdict): marked.count(verdict) for verdict in Verdict},
        "notes": [note.text(language) for note in marked.notes],
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


def report_bytes(found: Report, suffix: str) -> bytes:
    """Return what a file of a report holds."""
    return REPORTS[suffix.lower()](found).encode("utf-8", "replace")  # bytes in a name of a file


def write_reports(found: Report, files: Sequence[Path]) -> None:
    """Write the report on one student to each file; the suffix picks text or HTML."""
    save_all(files, REPORTS, lambda file: [(file, report_bytes(found, file.suffix))])
