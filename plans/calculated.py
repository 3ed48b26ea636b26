"""In which section of a note a calculated quantity stands: that whose programs have the step that finds it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeVar

from .board import Board, RecordingBoard

T = TypeVar("T")


def calculated(programs: Mapping[str, Iterable[Callable[[Board], None]]]) -> dict[str, str]:
    """Return the section of every quantity that the `programs` of some section calculate.

    >>> calculated({"speeds": (lambda board: board.calc("v", "product", "omega", "r"),)})
    {'v': 'speeds'}
    """
    found: dict[str, str] = {}
    for section, parts in programs.items():
        board = RecordingBoard()
        for part in parts:
            part(board)
        found |= dict.fromkeys((step.name for step in board.steps), section)
    return found


def in_sections(results: Mapping[str, T], sections: Sequence[str], section_of: Callable[[str], str]) -> dict[str, T]:
    """Return results by name section by section, in each in the order that they have."""
    return {name: results[name] for name in sorted(results, key=lambda name: sections.index(section_of(name)))}
