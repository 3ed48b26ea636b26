"""Settings and plans that callers of the Python API hand over: told apart, or refused in one line."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..plans.linkages.chain import PLANS
from ..scales.arguments import of_kind
from ..scales.names import unknown


def by_name(name: str, value: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the argument `name`, a mapping from names, as a dict; nothing for None."""
    if value is None:
        return {}
    of_kind(name, value, (Mapping,), "dict[str, ...]")
    for key in value:
        of_kind(name, key, (str,), "dict[str, ...]")
    return dict(value)


def plans_wanted(value: str | Iterable[str] | None, all_of_them: tuple[str, ...]) -> tuple[str, ...]:
    """Return the plans that `only` names, each alone or several with commas between; `all_of_them` for none.

    Raises
    ------
    InputError
        There is no such plan.
    """
    if value is None:
        return all_of_them
    of_kind("only", value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    for item in items:
        of_kind("only", item, (str,), "list[str]")
    plans = tuple(plan.strip() for item in items for plan in item.split(","))
    for plan in plans:
        if plan not in PLANS:
            raise unknown("plan-unknown", plan, PLANS)
    return plans or all_of_them
