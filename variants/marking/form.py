"""The answer form: what is asked, grouped by plan in order of construction, as rows of cells."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING

from ...drawing.words import Words
from ...plans.marking.key import Question
from ...scales.units import format_unit
from ..solution import Solution
from .rubric import has_sense
from .wording import plain, texts

if TYPE_CHECKING:
    from .keyed import Keyed

ASKED_ABOUT = ("task", "variant", "sheet", "student", "group", "book")
COLUMNS = ("name", "symbol", "vector", "mm", "mu", "value", "unit", "direction")


@dataclass(frozen=True, slots=True)
class Section:
    """The questions of one plan: its heading, its scale factors, all that may be answered, what a form asks of it."""

    heading: str
    scales: tuple[str, ...]
    questions: tuple[Question, ...]
    asked: tuple[Question, ...]


def sections(solution: Solution, questions: Iterable[Question], words: Words) -> list[Section]:
    """Return the questions plan by plan, in order of construction."""
    kind, solved = solution.kind, solution.solved
    by_key: dict[str, list[Question]] = {}
    current = ""
    for question in questions:
        current = kind.section(solved, question, current)
        by_key.setdefault(current, []).append(question)
    found, taken = [], set[str]()
    for key, own in by_key.items():
        plans = (question.plan for question in own if drawn(question))
        symbols = dict.fromkeys(solved.scale_of_plan[plan] for plan in plans if plan in solved.scale_of_plan)
        fresh = tuple(symbol for symbol in symbols if symbol not in taken and symbol not in solution)
        taken.update(fresh)
        asked = tuple(question for question in own if kind.asks(solved, question))
        found.append(Section(kind.section_heading(solved, key, words), fresh, tuple(own), asked))
    return found


def drawn(question: Question) -> bool:
    """Whether a quantity can be measured on a plan."""
    return question.vector or question.step.verb in ("read", "arm", "measure", "distance")


def form_rows(keyed: Keyed, about: Mapping[str, str]) -> Iterator[tuple[str, ...]]:
    """Go through the rows of an empty form; `about` is what is known of the sheet already."""
    asked, words = keyed.asked, keyed.words
    said = texts(words.language)
    for key in ASKED_ABOUT:
        yield (said[f"about.{key}"], about.get(key, ""))
    yield (" ".join(said[f"form.{note}"] for note in _notes(keyed)),)
    if about.get("variant") and keyed.solution.scales:  # a wish, no answer: the rows of the factors stay the student's
        yield (said["form.scales"].format(scales=keyed.solution.scaled(words)),)
    yield tuple(said[f"column.{column}"] for column in COLUMNS)
    letters = keyed.solution.kind.vector_letters(keyed.solution.solved, words)
    for part in filter(attrgetter("asked"), keyed.parts):
        yield (plain(part.heading),)
        for name in part.scales:
            unit = _written(f"({asked.display.of_scales.unit(asked.scales[name])})/{asked.display.paper}", words)
            yield (name, keyed.symbol(name), "", "", "", "", unit)
        for question in part.asked:
            name, unit = question.name, _written(asked.unit(question.name), words)
            yield (name, keyed.symbol(name), letters.get(name, ""), "", "", "", unit)


def _notes(keyed: Keyed) -> Iterator[str]:
    """Go through the keys of what stands over a form: how it is filled in."""
    yield "hint"
    if any(question.vector for part in keyed.parts for question in part.asked):
        yield "directions"
    yield from keyed.solution.kind.form_notes(keyed.solution.solved)


def _written(unit: str, words: Words) -> str:
    return format_unit(unit, words.language)


def class_header(parts: Iterable[Section], language: str, directions: bool) -> tuple[str, ...]:
    """Return the columns of a class: who it is, then scale factors, and segment, value of each quantity.

    With `directions` also the direction of a vector, the sense of what turns.
    """
    said = texts(language)
    columns = [said[f"about.{key}"] for key in ("student", "group", "book", "number", "variant", "sheet")]
    for part in parts:
        columns += part.scales
        for question in part.asked:
            name = question.name
            columns += [f"{name}.mm"] if drawn(question) else []
            columns += [name]
            if directions and (question.vector or has_sense(name)):
                columns.append(f"{name}.{'dir' if question.vector else 'sense'}")
    return tuple(columns)
