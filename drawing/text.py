r"""Text on a sheet: a small markup, its layout in runs at exact places, and the box that it fills.

Markup: `V_{B}`, `a^{n}`, `a^{n}_{BA}` (one over the other), `\bar{V}`, `\u{...}` and `\uu{...}` (underlined once or
twice: known by direction, known in full); it may be nested. `\{ \} \\ \_ \^` stand for the characters themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import cos, inf, sin
from typing import NamedTuple, TypeAlias

from ..scales.errors import InputError, Written
from .font import SIZE, font
from .shapes import Text

SCRIPT = 5 / 7  # size of sub- and superscripts; a script of a script is no smaller, or nobody could read it
DROP, LIFT = 0.35, 0.62  # of a script's baseline, in heights of its parent
GAP = 0.22  # between text and a bar or an underline, and between two underlines, in heights
RULES = {"bar": 0, "u": 1, "uu": 2}
ESCAPED = "\\{}_^"
_PLAIN = re.compile(r"(?:[^\\{}_^]|\\[\\{}_^]|[_^](?!\{))+")
_SHARES = {"left": 0.0, "middle": 0.5, "right": 1.0}  # of its width, how much of a text stands before its point
_ESCAPE = re.compile(r"\\([\\{}_^])")

Box: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Run:
    """Characters of one size whose baseline starts at `x`, `y` (mm); `size` is the font size in mm."""

    x: float
    y: float
    size: float
    string: str
    width: float


@dataclass(frozen=True, slots=True)
class _TextLayout:
    """Runs and rules (bars, underlines) of one line of text, from `x = 0` on the baseline `y = 0`, mm."""

    runs: tuple[Run, ...]
    rules: tuple[Box, ...]
    width: float
    top: float
    bottom: float


# Width, top and bottom of what has been laid out; top < bottom where there is no ink.
_Span: TypeAlias = tuple[float, float, float]
_NO_INK = (-inf, inf)


def escape(plain: str) -> str:
    """Return markup that shows `plain` as it is."""
    return "".join("\\" + letter if letter in ESCAPED else letter for letter in plain)


class Ruling(NamedTuple):
    """A group under a vector bar (`bar`), or over one line or two (`u`, `uu`)."""

    kind: str
    pieces: list[Piece]


Piece: TypeAlias = str | Ruling | dict[str, list["Piece"]]  # plain characters, a ruled group, scripts by `_` and `^`


def read(markup: str) -> list[Piece]:
    """Return the pieces of a line of markup. Raises InputError: the markup is broken."""
    return _read(markup, 0, nested=False)[0]


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
        elif plain := _PLAIN.match(markup, at):
            pieces.append(_ESCAPE.sub(r"\1", plain.group()))
            at = plain.end()
        else:
            raise _broken(markup, at)
    if nested and at >= len(markup):
        raise _broken(markup, at)
    return pieces, at + nested


def _broken(markup: str, at: int) -> InputError:
    return InputError("markup-broken", text=Written(markup), position=at + 1)


@lru_cache(maxsize=8192)
def lay_out(markup: str, height: float) -> _TextLayout:
    """Lay a line of markup out with capitals of `height` mm.

    Raises InputError: the markup is broken, or the font lacks a character.
    """
    pen = _Pen()
    width, top, bottom = pen.line(read(markup), 0.0, 0.0, height, height)
    if top < bottom:
        top = bottom = 0.0
    return _TextLayout(tuple(pen.runs), tuple(pen.rules), width, top, bottom)


class _Pen:
    """Lays pieces of markup out from left to right.

    Each method lays out from the place (x, y) with capitals of `height`; scripts are measured from `base`.
    """

    def __init__(self) -> None:
        self.runs: list[Run] = []
        self.rules: list[Box] = []

    def line(self, pieces: list[Piece], x: float, y: float, height: float, base: float) -> _Span:
        """Lay out pieces one after the other."""
        start, (top, bottom) = x, _NO_INK
        for piece in pieces:
            if isinstance(piece, str):
                width, high, low = self.word(piece, x, y, height * SIZE)
            elif isinstance(piece, Ruling):
                width, high, low = self.ruled(piece, x, y, height, base)
            else:
                width, high, low = self.scripts(piece, x, y, height, base)
            x, top, bottom = x + width, max(top, high), min(bottom, low)
        return x - start, top, bottom

    def word(self, string: str, x: float, y: float, size: float) -> _Span:
        """Lay plain characters out; spaces at the ends become distance, since SVG would drop them."""
        ink = font().ink
        letters = [ink(letter) for letter in string]
        width = sum([letter[0] for letter in letters]) * size
        inner = string.strip(" ")
        if not inner:
            return width, *_NO_INK
        spaces = len(string) - len(string.lstrip(" "))
        start, letters = x + ink(" ")[0] * size * spaces, letters[spaces : spaces + len(inner)]
        self.runs.append(Run(start, y, size, inner, sum([letter[0] for letter in letters]) * size))
        top, bottom = max([letter[2] for letter in letters]), min([letter[1] for letter in letters])
        return width, y + top * size, y + bottom * size

    def ruled(self, group: Ruling, x: float, y: float, height: float, base: float) -> _Span:
        """Lay out a group with a vector bar over it, or one or two lines under it."""
        width, top, bottom = self.line(group.pieces, x, y, height, base)
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

    def scripts(self, scripts: dict[str, list[Piece]], x: float, y: float, height: float, base: float) -> _Span:
        """Lay out a subscript, a superscript, or both one over the other."""
        width, (top, bottom) = 0.0, _NO_INK
        for mark, pieces in scripts.items():
            shift = -DROP * height if mark == "_" else LIFT * height
            wide, high, low = self.line(pieces, x, y + shift, SCRIPT * base, base)
            width, top, bottom = max(width, wide), max(top, high), min(bottom, low)
        return width + 0.06 * height, top, bottom


def placer(text: Text) -> Callable[[float, float], complex]:
    """Return what tells where on the sheet the point (x, y) of the text's layout lies."""
    at, squeeze, turn = text.at, text.squeeze, complex(cos(text.angle), sin(text.angle))
    before = _SHARES[text.anchor] * lay_out(text.markup, text.height).width
    return lambda x, y: at + complex((x - before) * squeeze, y) * turn


def corners(text: Text) -> tuple[complex, complex, complex, complex]:
    """Return the corners of the rectangle that `text` fills, which turns with it."""
    lines, place = lay_out(text.markup, text.height), placer(text)
    start, end = place(0.0, lines.bottom), place(lines.width, lines.bottom)
    up = place(0.0, lines.top) - start
    return start, end, end + up, start + up
