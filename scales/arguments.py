"""What callers of the Python API hand over: of the right kind, or refused in one line."""

from __future__ import annotations

from .errors import InputError
from .numbers import quote


def of_kind(name: str, value: object, kinds: tuple[type, ...], expected: str) -> None:
    """Refuse the argument `name` unless its value is of one of `kinds`; `expected` says so in Python's words.

    Raises
    ------
    InputError
        The value is of another kind.
    """
    if not isinstance(value, kinds):
        raise InputError("argument-type", name=name, expected=expected, text=quote(type(value).__name__))
