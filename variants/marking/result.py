"""What is kept of each marked student for the tables of a class; it goes into a file and comes back from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from ...plans.marking.verdicts import Verdict
from ...scales.errors import KulmanError
from ..roster import Who
from .answers import Answers
from .flags import Measured, measured, too_exact
from .marked import Marked
from .wording import texts


@dataclass(frozen=True, slots=True)
class Result:
    """One student: who, which variant, the mark (None where the answers could not be marked), verdicts, mistakes."""

    source: str
    who: Who
    variant: str = ""
    sheet: str = ""
    mark: float | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    first: str = ""
    mistakes: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    exact: bool = False
    segments: Mapping[str, Measured] = field(default_factory=dict)
    reports: tuple[str, ...] = ()
    fits: str = ""

    def flags(self, language: str) -> list[str]:
        """Return what a teacher should check of this student alone."""
        said = texts(language)
        found = [said["flag.exact"]] if self.exact else []
        return [*found, said["flag.variant"].format(variant=self.fits)] if self.fits else found

    def to_json(self) -> dict[str, Any]:
        """Return the result as plain data."""
        data = {item.name: getattr(self, item.name) for item in fields(self)}
        segments = {name: _plain(one) for name, one in self.segments.items()}
        return {**data, "who": _plain(self.who), "segments": segments}

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Result:
        """Return a result from plain data.

        Raises
        ------
        KeyError, TypeError
            The data are none of a result.
        """
        segments = {name: Measured(**of) for name, of in data["segments"].items()}
        lists = {name: tuple(data[name]) for name in ("mistakes", "notes", "reports")}
        return cls(**{**data, "who": Who(**data["who"]), "segments": segments, **lists})


def _plain(data: Who | Measured) -> dict[str, Any]:
    return {item.name: getattr(data, item.name) for item in fields(data)}


def students_scales(marked: Marked) -> dict[str, float]:
    """Return the student's scale factors by plan, value in SI per mm; ours where none is written.

    A factor may be meant as value per mm or as mm per unit: whichever is nearer to ours.
    """
    key, answers = marked.marking.key, marked.answers
    found = dict(key.paper.mus)
    for name, line in answers.lines.items():
        question = key.questions.get(name)
        symbol = "" if question is None else marked.keyed.solution.solved.scale_of_plan.get(question.plan, "")
        mu = line.mu or answers.scales.get(symbol)
        if question is not None and mu is not None and question.plan in found:
            found[question.plan] = mu.nearest(key.paper.mus[question.plan])
    return found


def result_of(marked: Marked, language: str, reports: tuple[str, ...] = ()) -> Result:
    """Return what is kept of a student who was marked."""
    key, first = marked.keyed, marked.marking.first_wrong
    follows = {line.name: abs(line.follows) for line in marked.marking.lines if line.follows == line.follows}
    segments = measured(marked.answers, marked.marking.key, students_scales(marked), follows)
    best = marked.candidates[0].mistakes if marked.candidates and not marked.slips else ()
    return Result(
        marked.answers.source,
        marked.entry.who if marked.entry else marked.answers.who,
        key.solution.variant,
        marked.answers.about.get("sheet", ""),
        marked.mark,
        {str(verdict): marked.count(verdict) for verdict in Verdict},
        "" if first is None else key.symbol(first),
        tuple(dict.fromkeys(broken.mistake for broken in best)),
        tuple(note.text(language) for note in marked.notes),
        too_exact(segments),
        segments,
        reports,
        marked.fits,
    )


def failed(answers: Answers, error: KulmanError, language: str) -> Result:
    """Return what is kept of a student whose answers cannot be marked."""
    reason = error.text(language)
    told = texts(language)["class.unread"].format(reason=reason) if answers.unread else reason
    notes = (*(problem.text(language) for problem in answers.problems), told)
    return Result(answers.source, answers.who, notes=notes)
