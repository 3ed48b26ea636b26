"""Questions for Moodle: each has its scheme and its data, and lets pass what an honest hand misses."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from html import escape

import numpy as np

from ...drawing.page import Page, extent
from ...drawing.shapes import Text, shifted
from ...drawing.svg import svg_text
from ...drawing.text import html_scripts, spelled
from ...drawing.view import View
from ...plans.hands.shaky import Hand
from ...plans.hands.spread import SEED, drawn, kept
from ...plans.names import role
from ...plans.quantities import Quantity
from ...scales.packaged import packaged
from ..case import Case
from ..marking.keyed import SIGNED, Keyed

HALF, MOST = 2.0, 0.2  # how many tolerances off an answer still gets half, and at most which part of the value
ROUNDED = 0.005  # part of a value that is lost when it is written with three digits
SHARE, DRAWINGS = 0.98, 2000  # of honest drawings that pass, of so many
ALIKE, SAME = ("V", "a", "omega", "epsilon", "R"), 1e-9  # kinds of which one size is asked for once
UNSURE = 0.15  # part of a value: drawings that miss by more do not tell it, and it is not asked for
SCHEME, PER_MM, WIDEST = "scheme.svg", 4.0, 600.0  # its file, pixels of a millimetre of it, most of them
PLACE = f"@@PLUGINFILE@@/{SCHEME}"  # by which a text calls the file of its own question
BY = ("variant", "quantity")  # what a category holds: all questions of one, that a quiz may draw one of them


@dataclass(frozen=True, slots=True)
class Question:
    """A numerical question: its text in HTML, the right value, by how much an answer may miss, half of it beyond.

    `scheme` is a picture, SVG; `units` are spellings of one unit; what is `signed` has a sense, and a sense that is
    wrong leaves half; `right` is the answer as it is told afterwards.
    """

    name: str
    category: tuple[str, ...]
    text: str
    scheme: bytes
    value: float
    tolerance: float
    units: tuple[str, ...]
    signed: bool
    right: str
    language: str

    def answers(self) -> Iterator[tuple[int, float, float, str]]:
        """Go through what gets a part of the mark, in per cent: the value, its tolerance, what is told of it."""
        said = packaged(__package__, "texts", self.language)
        yield 100, self.value, self.tolerance, ""
        yield 50, self.value, min(HALF * self.tolerance, MOST * abs(self.value)), said["feedback.near"]
        if self.signed:
            yield 50, -self.value, self.tolerance, said["feedback.sense"]


@dataclass(frozen=True, slots=True)
class _Statement:
    """What the questions of a variant have in common; data are those of motion, or with loads."""

    key: Keyed
    said: Mapping[str, str]
    scheme: bytes
    width: int
    data: dict[bool, str]

    @classmethod
    def of(cls, key: Keyed) -> _Statement:
        """Draw the scheme of a variant."""
        case, language = key.solution.case, key.words.language
        view = case.kind.pictured(case, key.words)
        page = None if view is None else bare_page(view, language)
        scheme = b"" if page is None else svg_text(page).encode("utf-8", "replace")
        width = 0 if page is None else round(min(PER_MM * page.width, WIDEST))
        return cls(key, packaged(__package__, "texts", language), scheme, width, {})

    def html(self, loaded: bool) -> str:
        """Return scheme and data."""
        case, words = self.key.solution.case, self.key.words
        if loaded not in self.data:
            rows = [tuple(map(html, row)) for row in case.kind.stated(case, words, loaded)]
            lines = "\n".join(f"<tr><td>{a}</td><td>{b}</td><td>{c}</td></tr>" for a, b, c in rows if a or c)
            more = "".join(f"<p>{'. '.join(said)}.</p>" for said in [[b for a, b, c in rows if not (a or c)]] if said)
            self.data[loaded] = f"<table>\n{lines}\n</table>\n{more}"
        alt = escape(self.said[f"question.scheme.{case.kind.table}"])
        drawn = f'<p><img src="{PLACE}" alt="{alt}" width="{self.width}"/></p>\n' if self.scheme else ""
        return f"{drawn}<p>{self.said['question.data']}</p>\n{self.data[loaded]}"

    def question(self, item: Quantity, meaning: str, miss: float, by: str) -> Question:
        """Return the question for a quantity."""
        said, case, words, name = self.said, self.key.solution.case, self.key.words, item.name
        shown, signed = item.shown(words.display), item.unit in SIGNED
        assert shown.value is not None
        assert item.value
        sized = item.kind == "vector" or item.unit == "N"  # which way a force balances is not asked for
        value, factor = abs(shown.value) if sized else shown.value, abs(shown.value / item.value)
        of, symbol = words.spelled(shown.unit), html(words.symbol(name))
        told = {"meaning": html(meaning) or symbol, "symbol": symbol, "unit": of or said["question.plain"]}
        rule = said["question.sense"] if signed else said["question.size"] if sized else ""
        title, variant = case.task.title[words.language], said["question.variant"].format(variant=case.variant)
        text = (
            f"<p>{escape(title)}. {escape(variant)}.</p>\n{self.html(case.kind.loaded(name))}\n"
            f"<p><strong>{said['question.find'].format(**told)}</strong> {rule}</p>"
        )
        category = (title, variant if by == BY[0] else re.sub(r"<[^>]+>", "", html(words.symbol(name))))
        latin = shown.unit.replace("^2", "²").replace("*", "·")
        right = f"{symbol} = {words.short(value, 4)} {of}".rstrip()
        units = tuple(dict.fromkeys((of, latin))) if of else ()
        identity = f"{case.variant}-{name}"
        answer = value, factor * miss, units, signed, right, words.language
        return Question(identity, category, text, self.scheme, *answer)


def questions_of(key: Keyed, names: Iterable[str], named: bool, hand: Hand, by: str = BY[0]) -> Iterator[Question]:
    """Go through the questions of a variant, drawn by a `hand`.

    What has no words of its own, what is a given, or as large as what has been asked for of its kind, as one of two
    reactions that are one is, is asked for only where it is `named`. What such a hand does not find to `UNSURE` of
    itself is not asked for.
    """
    case, words = key.solution.case, key.words
    statement, misses = _Statement.of(key), _misses(key, hand)
    # a velocity about a pivot is that of the point
    own = {name: role(name) for name in key.key.questions}
    whole = {name: key.solution.quantities[name].value for name, said in own.items() if not said.about}
    seen, absolute = [*_rates(case)], [(own[name].kind, abs(size)) for name, size in whole.items() if size]
    for name in names:
        question, item = key.key.questions.get(name), key.solution.quantities.get(name)
        if question is None or item is None or not item.value:
            continue
        miss = max(misses[name], ROUNDED * abs(item.value))
        meaning = case.kind.sought(case.solved, words, question.step.name)
        kind, size = role(name).kind, abs(item.value)
        again = kind in ALIKE and any(
            of == kind and abs(size - other) <= SAME * size for of, other in seen + absolute * bool(role(name).about)
        )
        if miss > UNSURE * size or (again and not named) or not (meaning or named):
            continue
        seen.append((kind, size))
        yield statement.question(item, meaning, miss, by)


def _rates(case: Case) -> Iterator[tuple[str, float]]:
    """Go through the velocities and accelerations among the givens: kinds and sizes, SI."""
    of_units = {"m/s": "V", "rad/s": "omega", "m/s^2": "a", "rad/s^2": "epsilon"}
    for name, given in case.task.givens.items():
        if given.unit is not None and given.unit.name in of_units:
            yield of_units[given.unit.name], abs(float(case.values[name]))


def bare_page(view: View, language: str) -> Page:
    """Return a view without its heading on a page of its own."""
    bare = [shape for shape in view.shapes if not (isinstance(shape, Text) and shape.role == "heading")]
    x0, y0, x1, y1 = extent(bare)
    shapes = tuple(shifted(shape, complex(1.0 - x0, 1.0 - y0)) for shape in bare)
    return Page(x1 - x0 + 2.0, y1 - y0 + 2.0, shapes, view.heading[0], language)


def _misses(key: Keyed, hand: Hand) -> dict[str, float]:
    """Return by how much honest drawings miss the sizes of quantities, SI; what is only calculated misses nothing."""
    drawings, found = drawn(key.key.paper, hand, np.random.default_rng(SEED), DRAWINGS), dict[str, float]()
    for name in key.key.questions:
        values, right = drawings[name], key.solution.quantities[name].value
        sizes = np.abs(values) if np.iscomplexobj(values) else values
        miss = float(kept(sizes, right, SHARE)) if right is not None else np.nan
        found[name] = miss if np.isfinite(miss) else key.key.allowed[name]
    return found


def html(markup: str) -> str:
    """Return markup of sheets as HTML.

    >>> html("a^{n}_{BA}")
    'a<sup>n</sup><sub>BA</sub>'
    """
    return spelled(markup, escape, html_scripts)


def xml_bytes(questions: Iterable[Question]) -> bytes:
    """Return questions as Moodle's XML."""
    parts, place = ['<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n'], tuple[str, ...]()
    for one in questions:
        if one.category != place:
            place = one.category
            path = "/".join(("$course$", "top", *(name.replace("/", "//") for name in place)))
            parts.append(f'<question type="category"><category>{_text(path)}</category></question>\n')
        parts += _xml(one)
    return "".join((*parts, "</quiz>\n")).encode("utf-8")


def _xml(one: Question) -> Iterator[str]:
    data = b64encode(one.scheme).decode("ascii")
    file = f'<file name="{SCHEME}" path="/" encoding="base64">{data}</file>' if one.scheme else ""
    yield f'<question type="numerical">\n<name>{_text(one.name)}</name>\n'
    yield f'<questiontext format="html">{_html_text(one.text)}{file}</questiontext>\n'
    yield f'<generalfeedback format="html">{_html_text(f"<p>{one.right}</p>")}</generalfeedback>\n'
    yield "<defaultgrade>1</defaultgrade><penalty>0.3333333</penalty><hidden>0</hidden>\n"
    for part, value, tolerance, told in one.answers():
        yield f'<answer fraction="{part}" format="moodle_auto_format"><text>{value:.10g}</text>'
        yield f'<tolerance>{tolerance:.3g}</tolerance><feedback format="html">{_html_text(told)}</feedback></answer>\n'
    if one.units:
        names = (f"<unit><multiplier>1</multiplier><unit_name>{_clean(name)}</unit_name></unit>" for name in one.units)
        yield f"<units>{''.join(names)}</units>\n"
    # a unit may stand behind the number or not
    yield "<unitgradingtype>0</unitgradingtype><unitpenalty>0.1</unitpenalty>"
    yield f"<showunits>{0 if one.units else 3}</showunits><unitsleft>0</unitsleft>\n</question>\n"


def _text(text: str) -> str:
    return f"<text>{_clean(text)}</text>"


def _html_text(text: str) -> str:
    kept = "".join(sign if sign.isprintable() or sign == "\n" else " " for sign in text)
    return f"<text><![CDATA[{kept}]]></text>" if kept else "<text></text>"


def _clean(text: str) -> str:
    """Return a text for XML, without characters that it cannot hold."""
    return escape("".join(sign if sign.isprintable() else " " for sign in text), quote=False)


def gift_bytes(questions: Iterable[Question]) -> bytes:
    """Return questions as GIFT, which has no files: the scheme stands in the text."""
    lines, place = list[str](), tuple[str, ...]()
    for one in questions:
        if one.category != place:
            place = one.category
            lines += [
                f"$CATEGORY: $course$/top/{'/'.join(' '.join(name.split()).replace('/', '//') for name in place)}",
                "",
            ]
        data = f"data:image/svg+xml;base64,{b64encode(one.scheme).decode('ascii')}"
        text = one.text.replace(PLACE, data)
        answers = (
            f"={'' if part == 100 else f'%{part}%'}{value:.10g}:{tolerance:.3g}{f'#{_gift(told)}' if told else ''}"
            for part, value, tolerance, told in one.answers()
        )
        feedback = f"####{_gift(one.right)}"
        lines += [f"::{_gift(one.name)}::[html]{_gift(text)} {{#{' '.join(answers)} {feedback}}}", ""]
    return "\n".join(lines).encode("utf-8")


def _gift(text: str) -> str:
    """Return a text on one line in which nothing is taken for a sign of GIFT."""
    return re.sub(r"([~=#{}:\\])", r"\\\1", " ".join(text.split()))
