"""What a task gives, as a table in its own units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .words import Words

if TYPE_CHECKING:
    from .style import Style
    from .view import View


@dataclass(frozen=True, slots=True)
class Given:
    """A given as the task states it: a number in its own unit, or a chosen word (without unit)."""

    value: float | str
    unit: str = ""


def givens_view(
    givens: Mapping[str, Given], words: Words, style: Style, more: Sequence[tuple[str, str, str]] = ()
) -> View:
    """Return the table of the givens in the task's own units; `more` rows of the same columns follow."""
    from .table import table  # needs numpy, which a solution does without

    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in givens.items():
        if isinstance(given.value, str):
            label = words.texts.get(f"given.{name}", name)
            rows.append([label, words.texts.get(f"choice.{given.value}", given.value), ""])
        else:
            rows.append([words.symbol(name), words.short(given.value), words.unit(given.unit)])
    rows += map(list, more)
    return table("givens", words["heading.givens"], rows, style)
