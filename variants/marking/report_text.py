"""The report on one student as plain text, for a console, an e-mail or a file."""

from __future__ import annotations

from collections.abc import Iterator

from ..tables import aligned
from .report import Report, Row
from .wording import texts


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
        yield from _table(report, rows)


def _table(report: Report, rows: tuple[Row, ...]) -> Iterator[str]:
    """Go through the lines of a plan, in columns."""
    said = texts(report.language)
    head = ("", said["report.answer"], said["report.right"], said["report.tolerance_column"], said["report.verdict"])
    table: list[tuple[str, ...]] = [head]
    table += [(row.symbol, row.answer, row.right, row.tolerance, row.said) for row in rows]
    if report.own:
        table = [(*cells[:2], cells[-1]) for cells in table]
    yield from (f"  {line}" for line in aligned(table, range(len(table[0]))).split("\n"))
