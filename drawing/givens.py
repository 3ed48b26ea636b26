"""What a task gives, as a table in its own units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from .words import Words

if TYPE_CHECKING:
    from .formats import Style
    from .view import View

LONG, DENOMINATOR, ROUNDING = 10, 100, 1e-11  # characters of a number that may be a simple fraction


@dataclass(frozen=True, slots=True)
class Given:
    """A given as the task states it: a number in its own unit, or a chosen word (without unit)."""

    value: float | str
    unit: str = ""


def choice(words: Words, name: str, value: str) -> tuple[str, str]:
    """Return what a given that is a choice is about, and the word chosen."""
    return words.texts.get(f"given.{name}", name), words.texts.get(f"choice.{value}", value)


def _number(words: Words, value: float) -> str:
    """Return a number as short as it is: a third as a fraction."""
    if math.isinf(value):
        return "∞"
    simple = Fraction(value).limit_denominator(DENOMINATOR)
    whole = simple.denominator == 1
    if len(text := words.short(value)) > LONG and not whole and abs(value - simple) < ROUNDING * abs(value):
        return f"{simple.numerator}/{simple.denominator}"
    return text


def givens_view(
    givens: Mapping[str, Given], words: Words, style: Style, more: Sequence[tuple[str, str, str]] = ()
) -> View:
    """Return the table of the givens in the task's own units; `more` rows of the same columns follow."""
    from .table import table  # needs numpy, which a solution does without

    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in givens.items():
        if isinstance(given.value, str):
            rows.append([*choice(words, name, given.value), ""])
        else:
            rows.append([words.symbol(name), _number(words, given.value), words.unit(given.unit)])
    rows += map(list, more)
    return table("givens", words["heading.givens"], rows, style)
