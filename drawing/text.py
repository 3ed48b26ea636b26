r"""Text on a sheet: a small markup, its layout in runs at exact places, and the box that it fills.

Markup: `V_{B}`, `a^{n}`, `a^{n}_{BA}` (one over the other), `\bar{V}`, `\u{...}` and `\uu{...}` (underlined once or
twice: known by direction, known in full); it may be nested. `\{ \} \\ \_ \^` stand for the characters themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby
from math import cos, inf, pi, sin, tan
from typing import NamedTuple, TypeAlias

from ..scales.errors import InputError, Written
from ..scales.names import unknown
from .font import SCREEN, SLANTED, UPRIGHT, font
from .shapes import Text

SCRIPT = 5 / 7  # size of sub- and superscripts; a script of a script is no smaller, or nobody could read it
HEIGHTS, NEAR = (1.8, 2.5, 3.5, 5.0, 7.0, 10.0), 0.03  # mm, of GOST 2.304; part by which a script is off its one
DROP, LIFT = 0.35, 0.62  # of a script's baseline, in heights of its parent
CLEAR, BEHIND = 0.08, 0.14  # before a superscript, and behind scripts, in heights of their parent
GAP = 0.22  # between text and a bar or an underline, and between two underlines, in heights
RULES = {"bar": 0, "u": 1, "uu": 2}
STROKES = "strokes"  # the lettering whose letters are lines
FACES = {  # of words, of symbols
    "gost": (UPRIGHT, SLANTED),
    "gost-slanted": (SLANTED, SLANTED),
    "dejavu": (SCREEN, SCREEN),
    STROKES: (UPRIGHT, SLANTED),
}
SLOPE = tan(pi / 12)  # of slanted letters, by which a superscript stands farther to the right
STEEP = "|)]"  # marks into which a leaning letter before them would run at its top
_FUNCTION = r"(?:(?:arc)?(?:sin|cos|tg|tan|ctg)|inv|ln|exp|max|min)"
_UNIT = "[cmk]?m|min|s|kg|[kM]?N|[kMG]?Pa|rad|deg|rpm|Hz|J|k?W"
_LETTERS = re.compile(r"[A-Za-zΑ-Ωα-ω′″]+")
_PRIMES = re.compile("[′″]")
_CYRILLIC = re.compile(r"[А-Яа-яЄєІіЇїҐґЁё]")
# letters between < and > that are no symbols: functions, Roman numbers, sheet ids (4S7-31W), what stands behind an
# apostrophe, formats, scales, variants (V01), articles, initials of people
_WORDS = re.compile(
    rf"<{_FUNCTION}>|<([IVX]{{2,}}|I|V(?=> клас))>|(^| )(?=[A-Z<>-]*\d)(?=.*-)[0-9A-Z<>-]{{7,}}(?!\w)|['’]<|<A>[0-4]\b|"
    r"<[A-Z]>-[а-яіїєґё]|: (?=[0-9A-Z<>]{3,5}-[0-9A-Z<>]{3,5}$)|"
    r"(^| )<M> ?\d|<[A-Z]>\d\d|<a> [a-z]|^<A> |(^|[A-Z]\. ?|[A-Z][a-z]+ )<[A-Z]>\.( ?[A-Z]|$)"
)
_BEHIND_FUNCTION = re.compile(rf"{_FUNCTION} $")
_UNITS_BEFORE = re.compile(rf"(?:\d ?|[(/ ]|(?:^|[ (\d])(?:{_UNIT})[·/])$")
_OPERATORS = "=·/+−–⊥∥≤≥≈"
ESCAPED = "\\{}_^"
_PLAIN = re.compile(r"(?:[^\\{}_^]|\\[\\{}_^]|[_^](?!\{))+")
_SHARES = {"left": 0.0, "middle": 0.5, "right": 1.0}  # of its width, how much of a text stands before its point
_ESCAPE = re.compile(r"\\([\\{}_^])")

Box: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Run:
    """Characters of one face and size whose baseline starts at `x`, `y` (mm); `size` is the font size in mm."""

    x: float
    y: float
    size: float
    string: str
    width: float
    face: str


@dataclass(frozen=True, slots=True)
class _TextLayout:
    """Runs and rules (bars, underlines) of one line of text, from `x = 0` on the baseline `y = 0`, mm.

    Its ink goes from `left` to `right`: letters have room on both sides, and those that lean may reach beyond it.
    """

    runs: tuple[Run, ...]
    rules: tuple[Box, ...]
    width: float
    top: float
    bottom: float
    left: float
    right: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of all that it covers."""
        return self.right - self.left, self.top - self.bottom

    @property
    def bare(self) -> Box | None:
        """The box of its letters from the corner of all that it covers, where they have rules; else there is none.

        A bar over letters that lean reaches beyond them.
        """
        if not self.rules:
            return None
        left, right = _sides(self.runs)
        ink = [(run, font(run.face).ink(letter)) for run in self.runs for letter in run.string]
        low, high = (min(run.y + of[1] * run.size for run, of in ink), max(run.y + of[2] * run.size for run, of in ink))
        return min(left) - self.left, low - self.bottom, max(right) - self.left, high - self.bottom


def _sides(runs: Iterable[Run]) -> tuple[list[float], list[float]]:
    """Return where the ink of each run begins and ends, mm."""
    beyond = [(run, font(run.face)) for run in runs]
    left = [run.x - of.beyond(run.string[0])[0] * run.size for run, of in beyond]
    return left, [run.x + run.width + of.beyond(run.string[-1])[1] * run.size for run, of in beyond]


# Width, top and bottom of what has been laid out; top < bottom where there is no ink.
_Span: TypeAlias = tuple[float, float, float]
_NO_INK = (-inf, inf)


def escape(plain: str) -> str:
    """Return markup that shows `plain` as it is."""
    return "".join("\\" + letter if letter in ESCAPED else letter for letter in plain)


def plain(markup: str) -> str:
    """Return what markup without scripts shows: the way back of `escape`."""
    return _ESCAPE.sub(r"\1", markup)


def symbol(markup: str) -> str:
    """Return markup of letters that are a symbol though a unit or a word is spelled so, `m`, `s`, `OA`: with no script.

    >>> symbol("m"), symbol("a"), symbol("V_{A}"), symbol("II")
    ('m_{}', 'a', 'V_{A}', 'II')
    """
    known = not re.fullmatch(rf"[A-Z]{{2}}|{_UNIT}", markup) or _WORDS.search(f"<{markup}>")
    return markup if known else f"{markup}_{{}}"


class Ruling(NamedTuple):
    """A group under a vector bar (`bar`), or over one line or two (`u`, `uu`)."""

    kind: str
    pieces: list[Piece]


Piece: TypeAlias = str | Ruling | dict[str, list["Piece"]]  # plain characters, a ruled group, scripts by `_` and `^`
Told: TypeAlias = Iterable[tuple[Piece, bool]]  # pieces, and whether each is a symbol or stands at one


def read(markup: str) -> list[Piece]:
    """Return the pieces of a line of markup. Raises InputError: the markup is broken."""
    return _read(markup, 0, nested=False)[0]


def spelled(
    markup: str,
    plain: Callable[[str], str] = str,
    scripted: Callable[[str, str], str] = str.__add__,
    ruled: Callable[[str, str], str] = lambda kind, inside: inside,
) -> str:
    """Return markup in another notation.

    Characters are as `plain` writes them, what stands above and below as `scripted` writes both of them, a ruled group
    as `ruled` writes its kind and what it holds. Without these nothing but characters is left.

    >>> spelled("a^{n}_{BA}"), spelled("V_{B}", scripted="<sup>{}</sup><sub>{}</sub>".format)
    ('anBA', 'V<sup></sup><sub>B</sub>')
    """

    def spell(pieces: Iterable[Piece]) -> str:
        parts = list[str]()
        for piece in pieces:
            if isinstance(piece, str):
                parts.append(plain(piece))
            elif isinstance(piece, Ruling):
                parts.append(ruled(piece.kind, spell(piece.pieces)))
            else:
                parts.append(scripted(*(spell(piece.get(sign, ())) for sign in "^_")))
        return "".join(parts)

    return spell(read(markup))


def html_scripts(above: str, below: str) -> str:
    """Return what stands above and below as HTML."""
    return (f"<sup>{above}</sup>" if above else "") + (f"<sub>{below}</sub>" if below else "")


def _read(markup: str, at: int, nested: bool) -> tuple[list[Piece], int]:
    """Read up to the end, or up to the brace that closes a group; return the pieces, and the place behind them."""
    pieces: list[Piece] = []
    while at < len(markup) and not (nested and markup[at] == "}"):
        mark, after = markup[at], markup[at + 1 : at + 2]
        if mark in "_^" and after == "{":
            scripts: dict[str, list[Piece]] = {}
            while (mark := markup[at : at + 2])[1:] == "{" and mark[0] in "_^" and mark[0] not in scripts:
                scripts[mark[0]], at = _read(markup, at + 2, nested=True)
            pieces.append(scripts)
        elif mark == "\\" and (not after or after not in ESCAPED):
            kind = markup[at + 1 : max(markup.find("{", at), at)]
            if kind not in RULES:
                raise _broken(markup, at)
            inner, at = _read(markup, at + len(kind) + 2, nested=True)
            pieces.append(Ruling(kind, inner))
        elif found := _PLAIN.match(markup, at):
            pieces.append(plain(found.group()))
            at = found.end()
        else:
            raise _broken(markup, at)
    if nested and at >= len(markup):
        raise _broken(markup, at)
    return pieces, at + nested


def _broken(markup: str, at: int) -> InputError:
    return InputError("markup-broken", text=Written(markup), position=at + 1)


class _Lettering(NamedTuple):
    """How text is set: in one of `LETTERINGS`, and whether single Latin letters may be units (`m`, `N`)."""

    name: str = "gost"
    latin_units: bool = True


_USUAL = _Lettering()
LETTERING: ContextVar[_Lettering] = ContextVar("lettering", default=_USUAL)  # of all that is drawn


@contextmanager
def lettered(lettering: str, language: str = "en") -> Iterator[None]:
    """Lay text of a language out in one of `LETTERINGS` meanwhile. Raises InputError: there is no such lettering."""
    if lettering not in FACES:
        raise unknown("lettering-unknown", lettering, FACES)
    before = LETTERING.set(_Lettering(lettering, language == "en"))
    try:
        yield
    finally:
        LETTERING.reset(before)


def lay_out(markup: str, height: float, symbols: bool = True) -> _TextLayout:
    """Lay a line of markup out with capitals of `height` mm, in the lettering of now; without `symbols` all are words.

    Raises InputError: the markup is broken, or the fonts lack a character.
    """
    return _lay_out(markup, height, LETTERING.get(), symbols)


def laid_out(text: Text) -> _TextLayout:
    """Lay a text out: what stands in the title block and under the frame are words, whatever their letters."""
    return lay_out(text.markup, text.height, text.role != "stamp")


@lru_cache(maxsize=8192)
def _lay_out(markup: str, height: float, lettering: _Lettering, symbols: bool) -> _TextLayout:
    pen = _Pen(lettering)
    told = _told(markup, lettering.latin_units) if symbols else [(piece, False) for piece in read(markup)]
    width, top, bottom = pen.line(told, 0.0, 0.0, height, height)
    if top < bottom:
        top = bottom = 0.0
    left, right = _sides(pen.runs)
    left += [rule[0] for rule in pen.rules]
    right += [rule[2] for rule in pen.rules]
    ends = min(left, default=0.0), max(right, default=0.0)
    return _TextLayout(tuple(pen.runs), tuple(pen.rules), width, top, bottom, *ends)


@lru_cache(maxsize=8192)
def _told(markup: str, latin_units: bool) -> list[tuple[Piece, bool]]:
    """Return the pieces of a line, told apart: the same whatever its height."""
    return [*told_apart(read(markup), latin_units)]


def told_apart(pieces: list[Piece], latin_units: bool = True) -> Iterator[tuple[Piece, bool]]:
    """Go through the pieces of a line, cut where symbols of quantities begin and end; tell which these are.

    A symbol is a Latin or Greek letter or two that are no word, no unit and no function: whatever stands under a bar or
    has a script or a prime, stands at an operator, or is alone; all Latin letters in a Ukrainian or Russian line.
    """
    line = "".join(piece if isinstance(piece, str) else "\1" for piece in pieces)
    local, at, before = not latin_units or bool(_CYRILLIC.search(line)), 0, False
    for index, piece in enumerate(pieces):
        if isinstance(piece, Ruling):
            before = piece.kind == "bar"
            yield piece, before
            at += 1
        elif isinstance(piece, dict):
            yield piece, before
            at += 1
        else:
            behind = pieces[index + 1] if index + 1 < len(pieces) else ""
            script = "".join(behind) if isinstance(behind, dict) else ""
            end = 0
            for found in _LETTERS.finditer(piece):
                if found.start() > end:
                    yield piece[end : found.start()], False
                end = found.end()
                before = _is_symbol(
                    found.group(),
                    line[: at + found.start()],
                    line[at + end :],
                    local,
                    script if end == len(piece) else "",
                    latin_units,
                )
                yield found.group(), before
            if end < len(piece):
                before = False
                yield piece[end:], False
            at += len(piece)


def _is_symbol(letters: str, before: str, after: str, local: bool, script: str, latin_units: bool) -> bool:
    """Whether letters in a line, with a script behind them or none, stand for a quantity or a point."""
    if letters[0] in "′″" and before[-1:].isdigit():  # of a number of a formula, of minutes
        return False
    if ("_" in script and not re.fullmatch("[IVX]{2,}", letters)) or letters[0] >= "Α" or _PRIMES.search(letters):
        return True
    if _WORDS.search(f"{before[-24:]}<{letters}>{after[:8]}"):
        return False
    if latin_units and re.fullmatch(_UNIT, letters) and (not before or _UNITS_BEFORE.search(before)):
        return False
    if len(letters) > 3 and letters[1:].islower():
        return False
    near, beyond = before.removesuffix("– ").rstrip(" ")[-1:], after.removeprefix(" –").lstrip(" ")[:1]  # no minus
    at_operator = (near and near in _OPERATORS) or (beyond and beyond in _OPERATORS)
    return bool(script or local or len(letters) == 1 or at_operator or _BEHIND_FUNCTION.search(before))


class _Pen:
    """Lays pieces of markup out from left to right.

    Each method lays out from the place (x, y) with capitals of `height`; scripts are measured from `base`.
    """

    def __init__(self, lettering: _Lettering) -> None:
        self.faces, self.latin_units = FACES[lettering.name], lettering.latin_units
        self.runs: list[Run] = []
        self.rules: list[Box] = []

    def line(self, pieces: Told, x: float, y: float, height: float, base: float, leaning: bool = False) -> _Span:
        """Lay out pieces one after the other; all of them lean that stand at a symbol, as its scripts do."""
        start, over, (top, bottom) = x, 0.0, _NO_INK
        told = ((piece, leaning or is_symbol) for piece, is_symbol in pieces)
        for (plain, leans), alike in groupby(told, lambda one: (isinstance(one[0], str), one[1])):
            parts = [piece for piece, _ in alike]
            for piece in ("".join(map(str, parts)),) if plain else parts:
                if isinstance(piece, str):
                    x += over if piece[0] in STEEP else 0.0
                    width, high, low = self.word(piece, x, y, height, self.faces[leans])
                elif isinstance(piece, Ruling):
                    width, high, low = self.ruled(piece, x, y, height, base, leans)
                else:
                    width, high, low = self.scripts(piece, x, y, height, base, leans)
                over = self.overhang(piece[-1], height) if isinstance(piece, str) and leans else 0.0
                x, top, bottom = x + width, max(top, high), min(bottom, low)
        return x - start, top, bottom

    def overhang(self, letter: str, height: float) -> float:
        """Return by how much farther a steep mark stands behind a letter that leans over its own place."""
        face = font(self.faces[True])
        past = face.beyond(letter)[1] if face.glyph(letter) else 0.0
        return past * height * face.size + CLEAR * height if past > 0.0 else 0.0

    def word(self, string: str, x: float, y: float, height: float, face: str) -> _Span:
        """Lay plain characters out; spaces at the ends become distance, since SVG would drop them."""
        start, (top, bottom) = x, _NO_INK
        whole = all(map(font(face).glyph, string))
        alike = groupby(string, lambda letter: face if font(face).glyph(letter) else SCREEN)
        for other, part in ((face, string),) if whole else ((other, "".join(own)) for other, own in alike):
            letters, inner = font(other), part.strip(" ")
            size, (across, low, high) = height * letters.size, zip(*map(letters.ink, part), strict=True)
            if inner:
                spaces = len(part) - len(part.lstrip(" "))
                inked = slice(spaces, spaces + len(inner))
                at = x + letters.ink(" ")[0] * size * spaces
                self.runs.append(Run(at, y, size, inner, sum(across[inked]) * size, other))
                top, bottom = max(top, y + max(high[inked]) * size), min(bottom, y + min(low[inked]) * size)
            x += sum(across) * size
        return x - start, top, bottom

    def ruled(self, group: Ruling, x: float, y: float, height: float, base: float, leans: bool) -> _Span:
        """Lay out a group with a vector bar over it, or one or two lines under it."""
        width, top, bottom = self.line(told_apart(group.pieces, self.latin_units), x, y, height, base, leans)
        if top < bottom:
            top = bottom = y
        gap = GAP * height
        if group.kind == "bar":
            top += gap
            self.rules.append((x, top, x + width, top))
            return width, top, bottom
        bottom = min(bottom, y)
        for _ in range(RULES[group.kind]):
            bottom -= gap
            self.rules.append((x, bottom, x + width, bottom))
        return width, top, bottom

    def scripts(
        self, scripts: dict[str, list[Piece]], x: float, y: float, height: float, base: float, leans: bool
    ) -> _Span:
        """Lay out a subscript, a superscript, or both one over the other."""
        width, (top, bottom) = 0.0, _NO_INK
        for mark, pieces in scripts.items():
            shift, aside = -DROP * height, 0.0
            if mark == "^":
                shift = LIFT * height
                aside = CLEAR * height + (SLOPE * shift if self.faces[leans] == SLANTED else 0.0)
            told = told_apart(pieces, self.latin_units)
            wide, high, low = self.line(told, x + aside, y + shift, script_of(base), base, leans)
            width, top, bottom = max(width, aside + wide), max(top, high), min(bottom, low)
        return width + BEHIND * height * (width > 0.0), top, bottom


@lru_cache
def script_of(height: float) -> float:
    """Return the size of scripts beside letters of a height, mm: the next smaller one of the standard.

    >>> script_of(5.0), script_of(3.5), script_of(7.0)
    (3.5, 2.5, 5.0)
    """
    size = SCRIPT * height
    standard = min(HEIGHTS, key=lambda known: abs(known - size))
    return standard if abs(standard - size) <= NEAR * size else size


def placer(text: Text) -> Callable[[float, float], complex]:
    """Return what tells where on the sheet the point (x, y) of the text's layout lies."""
    at, squeeze, turn = text.at, text.squeeze, complex(cos(text.angle), sin(text.angle))
    before = _SHARES[text.anchor] * laid_out(text).width
    return lambda x, y: at + complex((x - before) * squeeze, y) * turn


def corners(text: Text) -> tuple[complex, complex, complex, complex]:
    """Return the corners of the rectangle that `text` fills, which turns with it."""
    lines, place = laid_out(text), placer(text)
    start, end = place(0.0, lines.bottom), place(lines.width, lines.bottom)
    up = place(0.0, lines.top) - start
    return start, end, end + up, start + up
