"""The report on one student as plain data, for other programs."""

from __future__ import annotations

import math
from typing import Any

from ...plans.marking.verdicts import Line, Verdict
from .report import Report, Row
from .rubric import Rubric


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
