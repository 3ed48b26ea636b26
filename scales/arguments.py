"""What callers of the Python API hand over: of the right kind, or refused in one line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from .errors import InputError
from .names import unknown
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


def by_name(name: str, value: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the argument `name`, a mapping from names, as a dict; nothing for None."""
    if value is None:
        return {}
    of_kind(name, value, (Mapping,), "dict[str, ...]")
    for key in value:
        of_kind(name, key, (str,), "dict[str, ...]")
    return dict(value)


def names_of(
    argument: str, value: str | Iterable[str | int] | None, kinds: tuple[type, ...] = (str,)
) -> tuple[str, ...]:
    """Return names that are given each alone or several with commas between, each of these `kinds`; none for None."""
    if value is None:
        return ()
    of_kind(argument, value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    for item in items:
        of_kind(argument, item, kinds, "list[str]")
    return tuple(dict.fromkeys(one.strip() for item in items for one in str(item).split(",") if one.strip()))


def all_known(key: str, names: Iterable[str], known: Collection[str]) -> None:
    """Refuse, with the message `key`, the first of the names that is not known."""
    for name in names:
        if name not in known:
            raise unknown(key, name, known)
