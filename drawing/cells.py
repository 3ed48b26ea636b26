"""Text in a cell: as large as fits, wrapped, shrunk, at last made narrower; names of people as surname and initials."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from ..scales.errors import InputError
from ..scales.numbers import quote
from .shapes import Anchor, Text
from .text import Box, escape, lay_out

SIDE, EDGE = 1.0, 0.65  # clear of the lines of the cell, mm; half of the widest line is 0.4
CLEAR = 0.45  # what the ink of a high or deep letter may leave of it
PITCH = 1.5  # from baseline to baseline, in heights of a capital
FALL = 0.3  # of p and y below the baseline, in heights of a capital
SHOWN = 60  # characters of a text in a message
NARROWEST = 40  # per cent of a letter's own width
LEGIBLE = 0.5  # letters that are made narrower than that cannot be read
_PATRONYMIC = re.compile(r"\w+(вич|івна|ївна|ична|овна|евна|vych|vich|ivna|yivna|ovna|evna)", re.IGNORECASE)


def fitted(plain: str, cell: Box, heights: Sequence[float], anchor: Anchor = "middle", name: str = "") -> list[Text]:
    """Return the lines of `plain` text that fill `cell`, in the largest of `heights` that fits.

    Raises
    ------
    InputError
        The text is too long even for the smallest and narrowest letters.
    """
    words = plain.split()
    if not words:
        return []
    wide, high = cell[2] - cell[0] - 2 * SIDE, cell[3] - cell[1]
    for height in heights:
        lines = _wrapped(words, height, wide)
        if lines and _fits(lines, height, high):
            return _placed(lines, cell, height, anchor, name)
    height = heights[-1]
    for percent in range(98, NARROWEST - 1, -2):
        lines = _wrapped(words, height, wide * 100 / percent)
        if lines and (len(lines) == 1 or _fits(lines, height, high)):
            return [replace(line, squeeze=percent / 100) for line in _placed(lines, cell, height, anchor, name)]
    raise InputError("stamp-too-long", field=name, text=quote(" ".join(words), SHOWN))


def _depth(lines: int, height: float) -> float:
    """Return the height of a block of lines, from the capitals of the first to the tails of the last."""
    return ((lines - 1) * PITCH + 1 + FALL) * height


def _ink(lines: list[str], height: float) -> tuple[float, float]:
    """Return bottom and top of a block's ink, measured from the baseline of its first line."""
    layouts = [lay_out(escape(line), height) for line in lines]
    levels = [-row * PITCH * height for row in range(len(lines))]
    bottom = min(layout.bottom + level for layout, level in zip(layouts, levels, strict=True))
    return bottom, max(layout.top + level for layout, level in zip(layouts, levels, strict=True))


def _fits(lines: list[str], height: float, high: float) -> bool:
    """Tell whether a block, and what its letters have above capitals, finds room in a cell `high` mm high."""
    bottom, top = _ink(lines, height)
    return _depth(len(lines), height) <= high - 2 * EDGE and top - bottom <= high - 2 * CLEAR


def _wrapped(words: list[str], height: float, wide: float) -> list[str]:
    """Return lines no wider than `wide`, or nothing when one word is wider than that."""
    lines: list[str] = []
    for word in words:
        longer = f"{lines[-1]} {word}" if lines else word
        if lay_out(escape(word), height).width > wide:
            return []
        if lines and lay_out(escape(longer), height).width <= wide:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def _placed(lines: list[str], cell: Box, height: float, anchor: Anchor, name: str) -> list[Text]:
    """Return lines centred in the height of the cell, one under the other."""
    x0, y0, x1, y1 = cell
    x = {"left": x0 + SIDE, "middle": (x0 + x1) / 2, "right": x1 - SIDE}[anchor]
    y = (y0 + y1 + _depth(len(lines), height)) / 2 - height
    bottom, top = _ink(lines, height)
    if y + top > y1 - CLEAR or y + bottom < y0 + CLEAR:  # a capital with a breve, a deep bracket
        y = (y0 + y1 - top - bottom) / 2
    return [
        Text(complex(x, y - row * PITCH * height), escape(line), height, anchor, role="stamp", name=name)
        for row, line in enumerate(lines)
    ]


def named(plain: str, cell: Box, heights: Sequence[float], anchor: Anchor, name: str) -> list[Text]:
    """Return the lines of a person's name in `cell`, in letters that one can read where that is possible.

    Raises
    ------
    InputError
        Not even the surname has room.
    """
    found: list[list[Text]] = []
    refused: list[InputError] = []
    for way in dict.fromkeys((plain, with_initials(plain), surname(plain))):
        try:
            found.append(fitted(way, cell, heights, anchor, name))
        except InputError as error:
            refused.append(error)
    if not found:
        raise refused[0]
    return next((texts for texts in found if all(text.squeeze >= LEGIBLE for text in texts)), found[0])


def surname(plain: str) -> str:
    """Return the surname of a full name: before a patronymic's given name, or behind it; else first, in Latin last.

    >>> surname("Коваль Іван Петрович"), surname("Іван Петрович Коваль"), surname("Ivan Koval")
    ('Коваль', 'Коваль', 'Koval')
    """
    words = plain.split()
    return words[_surname_at(words)] if words else ""


def with_initials(plain: str) -> str:
    """Return a full name as surname and initials, in the order in which it is written.

    >>> with_initials("Коваль Анна-Марія Петрівна"), with_initials("Ivan Koval"), with_initials("доц. Коваль Ольга")
    ('Коваль А.-М. П.', 'I. Koval', 'доц. Коваль О.')
    """
    words = plain.split()
    at = _surname_at(words)
    names = (place != at and word[:1].isalpha() and not word.endswith(".") for place, word in enumerate(words))
    return " ".join(
        re.sub(r"(\w)\w+", r"\1.", word) if short else word for word, short in zip(words, names, strict=True)
    )


def _surname_at(words: Sequence[str]) -> int:
    first = next((at for at, word in enumerate(words) if not word.endswith(".")), 0)  # behind a title
    last = len(words) - 1
    if last > first and _PATRONYMIC.fullmatch(words[last]):
        return first
    if last > first + 1 and _PATRONYMIC.fullmatch(words[last - 1]):
        return last
    return last if words and re.match("[A-Za-z]", words[first]) else first
