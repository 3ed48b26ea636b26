"""In which section of a note a calculated quantity stands: that whose programs have the step that finds it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from .board import Board, RecordingBoard


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
