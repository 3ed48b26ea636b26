"""The report on one student as plain data, for other programs."""

from __future__ import annotations

from typing import Any

from ...plans.marking.verdicts import Line, Verdict
from .marked import Marked
from .rubric import Rubric


def to_json(marked: Marked, rubric: Rubric, language: str, own: bool) -> dict[str, Any]:
    """Return what `kulman check --json` prints of one student; a student's own has no right numbers."""
    lines = [_line(line, own) for line in marked.lines]
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


def _line(line: Line, own: bool) -> dict[str, Any]:
    """Return one line as plain data."""
    found = {"quantity": line.name, "verdict": str(line.verdict), "about": line.about}
    if own:
        return found
    right = line.right
    parts = {"x": right.real, "y": right.imag} if isinstance(right, complex) else {}
    return {**found, "right": {"value": abs(right) if parts else right, **parts}, "allowed": line.allowed}
