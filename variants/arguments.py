"""Settings, names and numbers that callers of the Python API hand over: told apart, or refused in one line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from ..scales.arguments import of_kind
from ..scales.errors import InputError
from ..scales.names import unknown
from ..scales.numbers import quote


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
    """Return names that are given each alone or several with commas between; none for None.

    Raises
    ------
    InputError
        The value, or one of several, is of no kind of names; `kinds` are those of one.
    """
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


def positions_of(argument: str, value: int) -> int:
    """Return a number of positions or sections of a cycle.

    Raises
    ------
    InputError
        There is no cycle of so many.
    """
    from ..plans.linkages.cycles.cycle import FEWEST, MOST  # brings numpy, which most commands do without

    of_kind(argument, value, (int,), "int")
    if not FEWEST <= value <= MOST:
        raise InputError("positions-number", n=quote(value), least=FEWEST, most=MOST)
    return value


def plans_wanted(
    value: str | Iterable[str] | None, all_of_them: tuple[str, ...], known: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the plans that `only` names, each alone or several with commas between; `all_of_them` for none.

    Those that can be named are `known`.

    Raises
    ------
    InputError
        There is no such plan.
    """
    if value is None:
        return all_of_them
    of_kind("only", value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    plans = names_of("only", items)
    all_known("plan-unknown", plans or items[:1], known)
    return plans or all_of_them
