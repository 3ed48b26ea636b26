"""The answer key of one variant with its data, and the form that asks for it plan by plan, as rows of cells."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter

from ...drawing.words import Words
from ...plans.hands.shaky import paper_of
from ...plans.marking.key import Key, Question, answer_key, needed_by
from ...plans.mistakes.book import Book, book
from ...plans.names import COUPLE, LEVER, role
from ...scales.units import format_unit
from ..case import Request, Settings
from ..sheets import sheet_id
from ..solution import Solution, solution_of
from .cells import Asked
from .rubric import Rubric, has_sense
from .wording import plain, texts

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
        found.append(Section(kind.plan_heading(solved, key, words), fresh, tuple(own), asked))
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
    vectors = any(question.vector for part in keyed.parts for question in part.asked)
    kind, plans = keyed.solution.kind, ("", *keyed.solution.solved.program.plans)
    notes = ["hint", *["directions"] * vectors, *(note for plan, note in kind.form_notes.items() if plan in plans)]
    yield (" ".join(said[f"form.{note}"] for note in notes),)
    if about.get("variant") and keyed.solution.scales:  # a wish, no answer: the rows of the factors stay the student's
        yield (said["form.scales"].format(scales=keyed.solution.scaled(words)),)
    yield tuple(said[f"column.{column}"] for column in COLUMNS)
    letters = kind.vector_letters(keyed.solution.solved, words)
    for part in filter(attrgetter("asked"), keyed.parts):
        yield (plain(part.heading),)
        for name in part.scales:
            unit = f"({asked.display.of_scales.unit(asked.scales[name])})/{asked.display.paper}"
            yield (name, keyed.symbol(name), "", "", "", "", format_unit(unit, words.language))
        for name in (question.name for question in part.asked):
            unit = format_unit(asked.unit(name), words.language)
            yield (name, keyed.symbol(name), letters.get(name, ""), "", "", "", unit)


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
            columns += [f"{name}.mm", name] if drawn(question) else [name]
            if directions and (question.vector or has_sense(name)):
                columns.append(f"{name}.{'dir' if question.vector else 'sense'}")
    return tuple(columns)


def solved(request: Request) -> Solution:
    """Solve what is asked for; a position without a plan is an error, too."""
    found = solution_of(request)
    if found.reason is not None:
        raise found.reason
    return found


@dataclass(frozen=True, eq=False)
class Keyed:
    """A variant ready for marking."""

    solution: Solution
    key: Key
    asked: Asked
    parts: tuple[Section, ...]
    words: Words
    sheet: str

    @cached_property
    def book(self) -> Book:
        """What every mistake would give: costs more than the key, and is needed where an answer is wrong."""
        return book(self.key)

    def scale_of(self, name: str) -> str:
        """Return the scale factor of the plan on which a quantity stands; nothing where there is none."""
        question = self.key.questions.get(name)
        return "" if question is None else self.solution.solved.scale_of_plan.get(question.plan, "")

    @cached_property
    def needed(self) -> dict[str, float]:
        """For each quantity the part of those asked after it that hang on it."""
        return needed_by(self.key)

    @cached_property
    def by_plan(self) -> dict[str, str]:
        """For each quantity the plan, or section of the form, in which it stands."""
        return {question.name: str(number) for number, part in enumerate(self.parts) for question in part.questions}

    @cached_property
    def symbols(self) -> dict[str, str]:
        """The symbols of all quantities and scale factors as plain text, no two of a form alike.

        A couple's force has the symbols of both forces, as large as it is. What the sheet tells apart by the drawing
        where it stands has that in brackets: the links of a force plan, the point of a plan, the lever.
        """
        scales = [symbol for part in self.parts for symbol in part.scales]
        found = {name: plain(self.words.symbol(name)) for name in (*self.solution.quantities, *scales)}
        for name in [name for name in found if role(name).part == COUPLE and not role(name).about]:
            both = sorted({found[one] for one in found if role(one).whole == name != one})
            found[name] = " = ".join(both) or found[name]
        asked = [question.name for part in self.parts for question in part.asked]
        often = Counter(found[name] for name in (*asked, *scales))
        for name in [name for name in (*asked, *scales) if often[found[name]] > 1]:
            quantity, place = role(name), ""
            if quantity.kind == "mu":
                place = ", ".join(map(str, quantity.links)) or quantity.about
            elif (quantity.kind, quantity.part) == ("h", LEVER):
                place = texts(self.words.language)["form.lever"]
            found[name] += f" ({place})" if place else ""
        return found

    def symbol(self, name: str) -> str:
        """Return the symbol of a quantity, of a scale factor or of a given, as plain text."""
        return self.symbols.get(name) or plain(self.words.symbol(name))


def asked_of(solution: Solution, names: Mapping[str, object] | None = None) -> Asked:
    """Return what can be answered in a task, of `names` alone where they are given, but nothing in per cent."""
    made = frozenset(solution.drawn_by_students.program.names if names is None else names)
    quantities = {
        name: q for name, q in solution.quantities.items() if name in made and q.kind != "point" and q.unit != "%"
    }
    scales = {s.symbol: s.unit for s in solution.scales.values() if s.symbol not in solution}  # chosen, not found
    return Asked(quantities, scales, solution.words.display)


def keyed(request: Request, variant: str, settings: Settings, rubric: Rubric) -> Keyed:
    """Make the answer key of a variant.

    Raises
    ------
    InputError, PositionError
        The variant or its data have no solution.
    """
    request = replace(request, variant=variant, settings={**(request.settings or {}), **settings})
    solution = solved(request)
    kind, drawn = solution.kind, solution.drawn_by_students
    paper = paper_of(drawn, {scale.symbol: scale.mu for scale in solution.scales.values()})
    limits, firm = kind.limits(drawn, paper, rubric.tolerance), rubric.limits
    if not kind.limits_add_up:
        limits, firm = {}, {**limits, **firm}
    unit_of = {name: quantity.unit for name, quantity in solution.quantities.items()}
    key = answer_key(paper, rubric.tolerance, firm, units=unit_of.__getitem__, drawn=limits)
    key = key.or_else(solution.solved.values)
    words = kind.lettered(solution.words, solution.solved)
    parts = tuple(sections(solution, key.questions.values(), words))
    asked = asked_of(solution, key.questions)
    own = sheet_id(request.task, solution.variant, request.settings)
    return Keyed(solution, key, asked, parts, words, own)
