"""Names of people in narrow cells: as they are written, else surname and initials, as title blocks usually show."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ..scales.errors import InputError
from .cells import fitted
from .shapes import Anchor, Text
from .text import Box

LEGIBLE = 0.5  # letters that are made narrower than that cannot be read
_PATRONYMIC = re.compile(r"\w+(вич|івна|ївна|ична|овна|евна|vych|vich|ivna|yivna|ovna|evna)", re.IGNORECASE)


def named(plain: str, cell: Box, heights: Sequence[float], anchor: Anchor, name: str) -> list[Text]:
    """Return the lines of a person's name in `cell`, in letters that one can read where that is possible.

    Raises
    ------
    InputError
        Not even the surname has room.
    """
    ways = dict.fromkeys((plain, with_initials(plain), surname(plain)))
    found: list[list[Text]] = []
    refused: list[InputError] = []
    for way in ways:
        try:
            found.append(fitted(way, cell, heights, anchor, name))
        except InputError as error:
            refused.append(error)
    if not found:
        raise refused[0]
    return next((texts for texts in found if _legible(texts)), found[0])


def _legible(texts: Sequence[Text]) -> bool:
    return all(text.squeeze >= LEGIBLE for text in texts)


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
    return " ".join(word if place == at else _initial(word) for place, word in enumerate(words))


def _surname_at(words: Sequence[str]) -> int:
    first = next((at for at, word in enumerate(words) if not word.endswith(".")), 0)  # behind a title
    last = len(words) - 1
    if last > first and _PATRONYMIC.fullmatch(words[last]):
        return first
    if last > first + 1 and _PATRONYMIC.fullmatch(words[last - 1]):
        return last
    return last if words and re.match("[A-Za-z]", words[first]) else first


def _initial(word: str) -> str:
    """Return the first letter of each part of a name; what is no name stays."""
    return re.sub(r"(\w)\w+", r"\1.", word) if word[:1].isalpha() and not word.endswith(".") else word
