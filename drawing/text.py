r"""Text on a sheet: a small markup, its layout in runs at exact places, and the box that it fills.

Markup: `V_{B}`, `a^{n}`, `a^{n}_{BA}` (one over the other), `\bar{V}`, `\u{...}` and `\uu{...}` (underlined once or
twice: known by direction, known in full); it may be nested. `\{ \} \\ \_ \^` stand for the characters themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import cos, sin
from typing import TypeAlias

from ..scales.errors import InputError
from .font import SIZE, font
from .shapes import Text

SCRIPT = 5 / 7  # size of sub- and superscripts; a script of a script is no smaller, or nobody could read it
DROP, LIFT = 0.35, 0.62  # of a script's baseline, in heights of its parent
GAP = 0.22  # between text and a bar or an underline, and between two underlines, in heights
RULES = {"bar": 0, "u": 1, "uu": 2}
ESCAPED = "\\{}_^"

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
class TextLayout:
    """Runs and rules (bars, underlines) of one line of text, from `x = 0` on the baseline `y = 0`, mm."""

    runs: tuple[Run, ...]
    rules: tuple[Box, ...]
    width: float
    top: float
    bottom: float


_EMPTY = TextLayout((), (), 0.0, 0.0, 0.0)


def escape(plain: str) -> str:
    """Return markup that shows `plain` as it is."""
    return "".join("\\" + letter if letter in ESCAPED else letter for letter in plain)


@lru_cache(maxsize=8192)
def lay_out(markup: str, height: float) -> TextLayout:
    """Lay a line of markup out with capitals of `height` mm.

    Raises
    ------
    InputError
        The markup is broken, or the font lacks a character.
    """
    return _Reader(markup).line(height, height, nested=False)


@lru_cache(maxsize=8192)
def _word(string: str, size: float) -> TextLayout:
    """Lay plain characters out; spaces at the ends become distance, since SVG would drop them."""
    face = font()
    inner = string.strip(" ")
    start = face.width(" ") * size * (len(string) - len(string.lstrip(" ")))
    width = face.width(string) * size
    if not inner:
        return TextLayout((), (), width, 0.0, 0.0)
    ink = [face.rise(character) for character in inner]
    run = Run(start, 0.0, size, inner, face.width(inner) * size)
    return TextLayout((run,), (), width, max(high for _, high in ink) * size, min(low for low, _ in ink) * size)


def _joined(parts: list[tuple[TextLayout, float, float]], width: float) -> TextLayout:
    """Put layouts at their places (x, y) into one."""
    runs = tuple(
        Run(run.x + x, run.y + y, run.size, run.string, run.width) for part, x, y in parts for run in part.runs
    )
    rules = tuple((a + x, b + y, c + x, d + y) for part, x, y in parts for a, b, c, d in part.rules)
    inked = [(part, y) for part, _, y in parts if part.runs or part.rules]
    top = max((part.top + y for part, y in inked), default=0.0)
    bottom = min((part.bottom + y for part, y in inked), default=0.0)
    return TextLayout(runs, rules, width, top, bottom)


def _ruled(inner: TextLayout, kind: str, height: float) -> TextLayout:
    """Return `inner` with a vector bar over it, or one or two lines under it."""
    gap = GAP * height
    if kind == "bar":
        level = inner.top + gap
        rules = (*inner.rules, (0.0, level, inner.width, level))
        return TextLayout(inner.runs, rules, inner.width, level, inner.bottom)
    levels = [min(inner.bottom, 0.0) - gap * (step + 1) for step in range(RULES[kind])]
    rules = (*inner.rules, *((0.0, level, inner.width, level) for level in levels))
    return TextLayout(inner.runs, rules, inner.width, inner.top, levels[-1])


class _Reader:
    """Reads one line of markup from left to right."""

    def __init__(self, markup: str) -> None:
        self.markup = markup
        self.at = 0

    def refuse(self) -> InputError:
        return InputError("markup-broken", text=self.markup, position=self.at + 1)

    def line(self, height: float, base: float, nested: bool) -> TextLayout:
        """Lay out up to the end, or up to the brace that closes a group; scripts are measured from `base`."""
        parts: list[tuple[TextLayout, float, float]] = []
        x = 0.0
        while self.at < len(self.markup) and not (nested and self.markup[self.at] == "}"):
            parts_here, width = self.piece(height, base)
            parts += [(part, dx + x, dy) for part, dx, dy in parts_here]
            x += width
        if nested and self.at >= len(self.markup):
            raise self.refuse()
        return _joined(parts, x) if parts else _EMPTY

    def piece(self, height: float, base: float) -> tuple[list[tuple[TextLayout, float, float]], float]:
        """Lay out plain characters, a ruled group, or scripts; return them with the width they take."""
        mark, after = self.markup[self.at], self.markup[self.at + 1 : self.at + 2]
        if mark in "_^" and after == "{":
            return self.scripts(height, base)
        if mark == "\\" and (not after or after not in ESCAPED):
            kind = self.command()
            inner = _ruled(self.group(height, base), kind, height)
            return [(inner, 0.0, 0.0)], inner.width
        word = _word(self.plain(), height * SIZE)
        return [(word, 0.0, 0.0)], word.width

    def scripts(self, height: float, base: float) -> tuple[list[tuple[TextLayout, float, float]], float]:
        """Lay out a subscript, a superscript, or both one over the other."""
        small = SCRIPT * base
        found: dict[str, TextLayout] = {}
        while self.markup[self.at : self.at + 2] in ("_{", "^{") and self.markup[self.at] not in found:
            mark = self.markup[self.at]
            self.at += 1
            found[mark] = self.group(small, base)
        shift = {"_": -DROP * height, "^": LIFT * height}
        width = max(part.width for part in found.values()) + 0.06 * height
        return [(part, 0.0, shift[mark]) for mark, part in found.items()], width

    def group(self, height: float, base: float) -> TextLayout:
        """Lay out what stands between the brace here and the one that closes it."""
        self.at += 1
        inner = self.line(height, base, nested=True)
        self.at += 1
        return inner

    def command(self) -> str:
        """Read `\\bar`, `\\u` or `\\uu` up to its opening brace."""
        end = self.markup.find("{", self.at)
        kind = self.markup[self.at + 1 : end] if end >= 0 else ""
        if kind not in RULES:
            raise self.refuse()
        self.at = end
        return kind

    def plain(self) -> str:
        """Read characters that mean themselves."""
        found = ""
        while self.at < len(self.markup):
            mark, after = self.markup[self.at], self.markup[self.at + 1 : self.at + 2]
            if mark == "\\" and after and after in ESCAPED:
                self.at += 1
                mark = after
            elif mark == "\\" or (mark in "_^" and after == "{") or (mark == "}" and found):
                break
            elif mark in "{}":
                raise self.refuse()
            found += mark
            self.at += 1
        return found


def start_of(text: Text) -> complex:
    """Return where the first run of `text` starts: its point, moved back by its anchor."""
    share = {"left": 0.0, "middle": 0.5, "right": 1.0}[text.anchor]
    width = lay_out(text.markup, text.height).width * text.squeeze
    return text.at - complex(cos(text.angle), sin(text.angle)) * (share * width)


def placed(text: Text, x: float, y: float) -> complex:
    """Return the point of the sheet where the point (x, y) of the text's layout lies."""
    return start_of(text) + complex(x * text.squeeze, y) * complex(cos(text.angle), sin(text.angle))


def corners(text: Text) -> tuple[complex, complex, complex, complex]:
    """Return the corners of the rectangle that `text` fills, which turns with it."""
    lines = lay_out(text.markup, text.height)
    ends = ((0.0, lines.bottom), (lines.width, lines.bottom), (lines.width, lines.top), (0.0, lines.top))
    a, b, c, d = (placed(text, x, y) for x, y in ends)
    return a, b, c, d


def box(text: Text) -> Box:
    """Return the box (x0, y0, x1, y1) that `text` fills: its advances, and its ink from top to bottom, mm."""
    points = corners(text)
    xs, ys = [point.real for point in points], [point.imag for point in points]
    return min(xs), min(ys), max(xs), max(ys)
