"""What is asked of a variant and what it is worth: the rubric, the answer key, the form that asks plan by plan."""

from __future__ import annotations

import math
import re
import tomllib
from collections import Counter
from collections.abc import Collection, Container, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import compress
from operator import itemgetter
from pathlib import Path
from typing import Any

from ...drawing.words import GREEK, Given, Words
from ...plans.hands.shaky import Tolerance, paper_of, preset
from ...plans.marking.answers import Answer, Line, Verdict
from ...plans.marking.key import Key, Question, answer_key, hanging_on
from ...plans.marking.ways import as_drawn
from ...plans.mistakes.book import Book, book
from ...plans.names import COUPLE, LEVER, role
from ...plans.quantities import unit_of
from ...scales.errors import LANGUAGES, InputError, KulmanError, as_one
from ...scales.names import all_known, latin, unknown
from ...scales.numbers import SHOWN, quote, split_number
from ..case import Case, Request, Settings, kind_of
from ..checks.basics import Checker, EnoughError, Field, Places, Read, one_of, record, trying
from ..reader import syntax_fault
from ..sheets import sheet_id
from ..solution import Solution, solution_of
from .cells import Asked, folded, value
from .wording import plain, texts

WORTH = {
    **dict.fromkeys((Verdict.RIGHT, Verdict.CARRIED), 1.0),
    **dict.fromkeys((Verdict.ARITHMETIC, Verdict.SCALE), 0.5),
    **dict.fromkeys((Verdict.WRONG, Verdict.UNCOUNTED, Verdict.MISSING), 0.0),
}
DIRECTIONS = ("optional", "required", "ignored")
SIZE_ALONE = 0.5  # part of a line's worth where a direction or sense is required and left out
NEEDED = 3.0  # how many times a line counts more on which all later ones hang
NOTHING = 1e-6  # part of a tolerance that is rounding
RATES = ("omega", "epsilon")  # kinds of quantities of links
SIGNED = ("rad/s", "rad/s^2", "N*m")  # units of scalars that have a sense
LARGEST = 100_000  # bytes
_CYRILLIC = re.compile("^[А-яЁёІіЇїЄєҐґ]+(?= *=)", re.MULTILINE)  # keys of a rubric in these letters alone
LARGEST_NUMBER = 1_000_000  # of a rubric
TOLERANCES = {"mm": LARGEST_NUMBER, "percent": 100, "degrees": 180}  # with the largest of each
ASKED_ABOUT = ("task", "variant", "sheet", "student", "group", "book")
DATA = "data"  # of one's own, for which a form is
PLANS = "plans"  # which of them a form asks for, if not all
COLUMNS = ("name", "symbol", "vector", "mm", "mu", "value", "unit", "direction")


@dataclass(frozen=True, slots=True)
class Rubric:
    """How answers are marked.

    Of `directions` and senses holds: "required", a line without its own is worth less; "optional", what is said of one
    is compared; "ignored", sizes alone are.
    """

    tolerance: Tolerance
    out_of: float = 100.0  # the full mark
    # what quantities weigh; those that are not named weigh one, and where none is, lines count as `parts` says
    weights: Mapping[str, float] = field(default_factory=dict)
    worth: Mapping[Verdict, float] = field(default_factory=lambda: WORTH)  # of verdicts, in parts of the weight
    asked: tuple[str, ...] = ()  # the quantities; all when empty
    limits: Mapping[str, float] = field(default_factory=dict)  # tolerances of single quantities, SI
    directions: str = DIRECTIONS[0]

    def parts(
        self, lines: Collection[Line], by_plan: Mapping[str, str], needed: Mapping[str, float]
    ) -> dict[str, float]:
        """Return what part of the full mark each line is: by the rubric's weights, or else by plans.

        A line whose verdict has no worth does not count. Others count the more, the more of the later ones hang on
        them, `needed` being their part, and nothing where zero is right; a plan (or section of the form) counts as the
        root of what its lines come to, so that of four times as many lines each counts half as much.
        """
        if self.weights:
            shares = {line.name: self.weights.get(line.name, 1.0) for line in lines}
        else:
            zero = {line.name for line in lines if abs(line.right) <= NOTHING * line.allowed}
            shares = {line.name: 1.0 + NEEDED * needed[line.name] for line in lines} | dict.fromkeys(zero, 0.0)
            whole = dict.fromkeys(by_plan.values(), 0.0)
            for name, share in shares.items():
                whole[by_plan[name]] += share
            shares = {name: share / math.sqrt(whole[by_plan[name]] or 1.0) for name, share in shares.items()}
        shares |= {line.name: 0.0 for line in lines if line.verdict not in self.worth}
        total = sum(shares.values())
        return {name: share / total if total else 1.0 / len(shares) for name, share in shares.items()}

    def mark(self, lines: Iterable[Line], parts: Mapping[str, float]) -> float:
        """Return the mark, to a tenth."""

        def earned(line: Line) -> float:
            return parts[line.name] * self.worth.get(line.verdict, 1.0) * (SIZE_ALONE if self.halves(line) else 1.0)

        return round(self.out_of * sum(map(earned, lines)), 1)

    def halves(self, line: Line) -> bool:
        """Whether a line earns less because it lacks a direction or sense that is required."""
        return self.directions == "required" and self.worth.get(line.verdict, 1.0) > 0.0 and _wants_direction(line)

    def compared(self, answer: Answer, question: Question) -> Answer:
        """Return what counts of an answer; the sign of a number without a unit is no sense."""
        if self.directions != "ignored":
            return answer
        signed = answer.value is None or (question.unit == "1" and not question.vector)
        value = answer.value if signed else abs(answer.value or 0.0)
        return replace(answer, value=value, direction=None, sense=None, plus=False)


def _wants_direction(line: Line) -> bool:
    """Whether an answer leaves out the direction of a vector, or the sense of a scalar that has one."""
    answer = line.answer
    if answer is None or answer.empty or not line.right:
        return False
    if isinstance(line.right, complex):
        return answer.direction is None
    return _has_sense(line.name) and answer.sense is None and not answer.plus and not (answer.value or 0.0) < 0.0


def _has_sense(name: str) -> bool:
    """Whether a scalar turns one way or the other: an angular velocity or acceleration, a moment."""
    of_link = role(name).of[:1].isdigit()  # the contact ratio of gears is no acceleration
    return unit_of(name) in SIGNED and (of_link or role(name).kind not in RATES)


def read_rubric(file: str | Path | None, preset_name: str, asked: Asked, directions: str | None = None) -> Rubric:
    """Read a rubric, a small TOML file; without weights of its own quantities count as `Rubric.parts` says.

    `directions` takes the place of what the file says of them.

        out_of = 100
        asked = ["V_B", "omega_2", "a_B"]
        directions = "required"

        [weights]
        a_B = 3

        [worth]
        carried = 0.8

        [tolerance]
        mm = 2
        percent = 5
        degrees = 1

        [limits]
        V_B = "0.1 m/s"

    Raises
    ------
    InputError
        The file cannot be read, or holds what no rubric has; with file and key; or `directions` is unknown.
    """
    if directions is not None and directions not in DIRECTIONS:
        raise unknown("choice-unknown", directions, DIRECTIONS)
    usual = preset(preset_name).tolerance
    rubric = Rubric(usual) if file is None else _read(file, usual, asked)
    return rubric if directions is None else replace(rubric, directions=directions)


def _read(file: str | Path, usual: Tolerance, asked: Asked) -> Rubric:
    """Return what a rubric's file says; what it leaves out of the tolerance is as usual."""
    path, shown, read, text = Path(file), quote(file, SHOWN), dict[str, Any](), ""
    try:
        text = (path.read_bytes() if path.stat().st_size <= LARGEST else b"\0").decode("utf-8-sig")
        text = _CYRILLIC.sub(r'"\g<0>"', text)  # no key is one: those that there are shall be told
        raw, checker = tomllib.loads(text), Checker(shown, Places(text))
    except FileNotFoundError:
        raise InputError("file-missing", file=shown) from None
    except OSError:
        raise InputError("file-unreadable", file=shown) from None
    except (ValueError, RecursionError) as problem:
        if not isinstance(problem, tomllib.TOMLDecodeError) or "\0" in text:
            raise InputError("rubric-toml", file=shown) from None
        raise syntax_fault(text, shown, str(problem)) from None
    with suppress(EnoughError):
        read = record(checker, (), raw, _fields(asked))
    if checker.faults:
        raise as_one(fault for _, _, fault in sorted(checker.faults, key=itemgetter(0, 1)))
    own, worth = read.get("tolerance", {}), {Verdict(name): part for name, part in read.pop("worth", {}).items()}
    part = own["percent"] / 100.0 if "percent" in own else usual.part
    tolerance = Tolerance(own.get("mm", usual.mm), part, own.get("degrees", usual.degrees))
    return Rubric(**{**read, "tolerance": tolerance, "worth": {**WORTH, **worth}})


def _fields(asked: Asked) -> dict[str, Field]:
    """Return how the keys of a rubric are read, none of which must be there."""
    quantities = asked.quantities

    def names(raw: object) -> tuple[str, ...]:
        if not isinstance(raw, list) or not all(isinstance(name, str) for name in raw):
            raise InputError("rubric-names")
        all_known("quantity-unknown", raw, quantities)
        return tuple(raw)

    def number(raw: object, most: int = LARGEST_NUMBER) -> float:
        try:
            found, unit = split_number(raw) if isinstance(raw, str) else (raw, "")  # a decimal comma needs quotes
        except InputError:
            found, unit = None, ""
        if unit or isinstance(found, bool) or not isinstance(found, (int, float)) or not 0.0 <= found <= most:
            raise InputError("rubric-number", text=quote(raw), most=most)
        return float(found)

    def limit(raw: object, name: str) -> float:
        return value(str(raw), "", name, asked)

    def optional(readers: Mapping[str, Read]) -> dict[str, Field]:
        return {key: Field(read, required=False) for key, read in readers.items()}

    tables: dict[str, dict[str, Read]] = {
        "weights": dict.fromkeys(quantities, trying(number)),
        "worth": dict.fromkeys(map(str, Verdict), trying(partial(number, most=1))),
        "tolerance": {key: trying(partial(number, most=most)) for key, most in TOLERANCES.items()},
        "limits": {name: trying(partial(limit, name=name)) for name in quantities},
    }
    return optional({
        "out_of": trying(number),
        "asked": trying(names),
        "directions": one_of("choice-unknown", lambda: DIRECTIONS),
        **{table: partial(record, fields=optional(readers)) for table, readers in tables.items()},
    })  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Section:
    """The questions of one plan: its heading, its scale factors, all that may be answered, what a form asks of it."""

    heading: str
    scales: tuple[str, ...]
    questions: tuple[Question, ...]
    asked: tuple[Question, ...]


def _sections(solution: Solution, questions: Iterable[Question], words: Words) -> list[_Section]:
    """Return the questions plan by plan, in order of construction."""
    kind, solved = solution.kind, solution.solved
    by_key: dict[str, list[Question]] = {}
    current = ""
    for question in questions:
        current = kind.section(solved, question, current)
        by_key.setdefault(current, []).append(question)
    found, taken = [], set[str]()
    for key, own in by_key.items():
        measured = [question for question in own if _drawn(question)]
        symbols = [solved.scale_of_plan[q.plan] for q in measured if q.plan in solved.scale_of_plan]
        # the sheet may show them larger, at another one
        shown = (solution.quantities[question.name].scale for question in measured)
        symbols += [symbol for symbol in shown if symbol in solution.scales and symbol is not None]
        fresh = tuple(symbol for symbol in dict.fromkeys(symbols) if symbol not in taken and symbol not in solution)
        taken.update(fresh)
        asked = tuple(question for question in own if kind.asks(solved, question))
        found.append(_Section(kind.plan_heading(solved, key, words), fresh, tuple(own), asked))
    return found


def _drawn(question: Question) -> bool:
    """Whether a quantity can be measured on a plan."""
    return question.vector or question.step.verb in ("read", "arm", "measure", "distance")


def columns_of(question: Question) -> tuple[str, ...]:
    """Return what an answer to a question has: a segment that is measured, a value, a direction or sense."""
    arm, turns = is_arm_of_lever(question.name), question.vector or _has_sense(question.name)
    return tuple(compress(("mm", "value", "direction"), (_drawn(question), not arm, turns)))


def form_rows(keyed: Keyed, about: Mapping[str, str], only: Collection[str]) -> Iterator[tuple[str, ...]]:
    """Go through the rows of an empty form; `about` is what is known of the sheet already, `only` what is asked."""
    asked, words = keyed.asked, keyed.words
    said = texts(words.language)
    for key in (*ASKED_ABOUT, *(key for key in (DATA, PLANS) if key in about)):
        yield (said[f"about.{key}"], about.get(key, ""))
    vectors = any(question.vector for part in keyed.parts for question in part.asked)
    kind, plans = keyed.solution.kind, ("", *keyed.solution.solved.program.plans)
    notes = ["hint", *["directions"] * vectors, *(note for plan, note in kind.form_notes.items() if plan in plans)]
    yield (" ".join(said[f"form.{note}"] for note in notes),)
    if about.get("variant") and keyed.solution.scales:  # a wish, no answer: the rows of the factors stay the student's
        yield (said["form.scales"].format(scales=keyed.solution.scaled(words, keyed.symbol)),)
    yield tuple(said[f"column.{column}"] for column in COLUMNS)
    letters = kind.vector_letters(keyed.solution.solved, words)
    for part in keyed.parts:
        questions = [question for question in part.asked if not only or question.name in only]
        if not questions:
            continue
        yield (plain(part.heading),)
        for name in part.scales if any(map(_drawn, questions)) else ():
            unit = f"({asked.display.of_scales.unit(asked.scales[name])})/{asked.display.paper}"
            yield (name, keyed.symbol(name), "", "", "", "", words.spelled(unit))
        for name in (question.name for question in questions):
            on_paper = is_arm_of_lever(name)
            unit = words.spelled(asked.display.paper if on_paper else asked.unit(name))
            yield (name, keyed.symbol(name), letters.get(name, ""), "", "", "", unit)


def class_header(keyed: Keyed, who: Iterable[str], directions: bool, only: Collection[str]) -> tuple[str, ...]:
    """Return the columns of a class: `who` it is, then scale factors, segment and value of each quantity with its unit.

    With `directions` also the direction of a vector, the sense of what turns. Of quantities `only` some may be asked.
    """
    words, paper = keyed.words, keyed.asked.display.paper
    said = texts(words.language)
    segment = said["column.mm"].partition(" ")[0] + " "  # the word before its unit
    columns = [said[f"about.{key}"] for key in who]
    for part in keyed.parts:
        asked = [question for question in part.asked if not only or question.name in only]
        if any(map(_drawn, asked)):
            columns += map(_shown, part.scales)
        for question in asked:
            name, unit = _shown(question.name), words.spelled(keyed.asked.unit(question.name))
            length = keyed.asked.quantities[question.name].unit == "m"  # of which mm alone would be the value
            heads = {
                "mm": f"{name}, {segment if length else ''}{words.spelled(paper)}",
                "value": f"{name}, {unit}" if unit else name,
                "direction": f"{name}, {said['class.direction']}",
            }
            columns += [heads[part] for part in columns_of(question) if directions or part != "direction"]
    return tuple(columns)


def data_text(case: Case, names: Collection[str]) -> str:
    """Return the data of one's own in a case, those of `names`, as a form has them: `l_OA = 55 mm; phi = 30 deg`."""

    words = case.words()

    def shown(given: Given) -> str:
        if isinstance(given.value, str):
            return given.value
        number = f"{given.value:.12g}"
        number = number if case.language == "en" else number.replace(".", ",")
        return number if given.unit in ("", "1") else f"{number} {words.spelled(given.unit)}"

    return "; ".join(f"{name} = {shown(given)}" for name, given in case.givens.items() if name in names)


def data_said(text: str) -> dict[str, str]:
    """Return the data of one's own that a form has, as `--set` takes them.

    >>> data_said("l_OA = 55 mm; phi=30")
    {'l_OA': '55 mm', 'phi': '30'}
    """
    pairs = (part.partition("=") for part in text.split(";") if part.strip())
    return {latin(name.strip()): value.strip() for name, _, value in pairs}


def is_arm_of_lever(name: str) -> bool:
    """Whether a quantity is an arm on Zhukovsky's lever: one of paper, though it has the unit of a velocity."""
    return role(name).kind == "h" and role(name).part == LEVER


def _shown(name: str) -> str:
    """Return a name with the Greek letter that it begins with."""
    kind, _, rest = name.partition("_")
    return f"{GREEK[kind]}_{rest}" if kind in GREEK and kind != "delta" and rest else name


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
    parts: tuple[_Section, ...]
    words: Words
    sheet: str

    @cached_property
    def book(self) -> Book:
        """What every mistake would give: costs more than the key, and is needed where an answer is wrong."""
        return book(self.key)

    @cached_property
    def drawn(self) -> Book:
        """What every mistake would give on a drawing, where vectors have no names."""
        return as_drawn(self.book)

    @cached_property
    def magnified(self) -> Mapping[str, float]:
        """How many times as large as on its plan a vector is read in the detail where the sheet shows it."""
        solution = self.solution
        symbols = solution.solved.scale_of_plan.items()
        scales = {plan: solution.scales[symbol] for plan, symbol in symbols if symbol in solution.scales}
        return solution.kind.magnified(solution.case, scales, solution.words)

    def scale_of(self, name: str, written: Container[str] = ()) -> str:
        """Return the scale factor of the plan on which a quantity stands; nothing where there is none.

        Where that of the figure on which the sheet shows it is `written`, it is that.
        """
        question, item, solved = self.key.questions.get(name), self.solution.quantities.get(name), self.solution.solved
        if (own := solved.scale_of_figure.get(solved.shown_on.get(name, ""))) in written:
            return own or ""
        if item is not None and item.scale in written:
            return item.scale or ""
        return "" if question is None else solved.scale_of_plan.get(question.plan, "")

    @cached_property
    def needed(self) -> dict[str, float]:
        """For each quantity the part of those asked after it that hang on it, on its mark or its value."""
        places, hanging, after = self.key.paper.program.places, hanging_on(self.key), 0
        parts: dict[str, float] = {}
        for count, name in enumerate(reversed([*self.key.questions])):
            parts[name] = (hanging[name] & after).bit_count() / count if count else 0.0
            after |= 1 << places[name]
        return parts

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
    made = frozenset(solution.kind.as_drawn(solution.solved)[0].program.names if names is None else names)
    quantities = {
        name: q for name, q in solution.quantities.items() if name in made and q.kind != "point" and q.unit != "%"
    }
    scales = {s.symbol: s.unit for s in solution.scales.values() if s.symbol not in solution}  # chosen, not found
    figures, shown_on = solution.solved.scale_of_figure, solution.solved.shown_on  # of any variant
    scales |= {figures[shown_on[name]]: q.unit for name, q in quantities.items() if shown_on.get(name) in figures}
    words, every = [replace(solution.words, language=language) for language in LANGUAGES], (*quantities, *scales)
    shown = [(folded(text), name) for name in every for text in (name, *(of.symbol(name) for of in words))]
    often = Counter(text for text, _ in {*shown})
    return Asked(quantities, scales, solution.words.display, symbols={t: name for t, name in shown if often[t] == 1})


def fullest(request: Request) -> str:
    """Return the variant of a request; without one that which has most to answer, so that a form suits them all."""
    of = request.task

    def asks(variant: str) -> int:
        with suppress(KulmanError):  # a variant without a solution asks nothing
            return len(asked_of(solved(replace(request, variant=variant))).quantities)
        return 0

    if request.variant is not None or not kind_of(of.kind).unequal:
        return str(request.variant or next(iter(of.variants)))
    return max(of.variants, key=asks)


def keyed(request: Request, variant: str, settings: Settings, rubric: Rubric) -> Keyed:
    """Make the answer key of a variant.

    Raises
    ------
    InputError, PositionError
        The variant or its data have no solution.
    """
    request = replace(request, variant=variant, settings={**(request.settings or {}), **settings})
    solution = solved(request)
    kind = solution.kind
    drawn, _ = kind.as_drawn(solution.solved)
    paper = paper_of(drawn, {scale.symbol: scale.mu for scale in solution.scales.values()})
    limits, firm = kind.limits(drawn, paper, rubric.tolerance), rubric.limits
    if not kind.limits_add_up:
        limits, firm = {}, {**limits, **firm}
    unit_of = {name: quantity.unit for name, quantity in solution.quantities.items()}
    key = answer_key(paper, rubric.tolerance, firm, units=unit_of.__getitem__, drawn=limits)
    key = key.or_else(solution.solved.values)
    words = kind.lettered(solution.words, solution.solved)
    parts = tuple(_sections(solution, key.questions.values(), words))
    asked = asked_of(solution, key.questions)
    own = sheet_id(request.task, solution.variant, request.settings)
    return Keyed(solution, key, asked, parts, words, own)
