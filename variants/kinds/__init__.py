"""Kinds of tasks: one module a kind, with all that a task of that kind needs, loaded when such a task is met.

A task file says of which kind it is by the table in which it describes its subject: `[mechanism]`, `[cam]`, `[gear]`,
`[hoist]`.
"""

from __future__ import annotations

from collections.abc import Container
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .kind import Kind

MODULES = {"mechanism": "linkage", "cam": "cam", "gear": "gear", "hoist": "hoist"}  # module of each kind by its table
KINDS = tuple(MODULES.values())


@cache
def kind_of(table: str) -> Kind[Any, Any]:
    """Return the kind of the tasks that have this table."""
    found: Kind[Any, Any] = import_module(f".{MODULES[table]}", __package__).KIND
    return found


def table_in(file: Container[str]) -> str:
    """Return which table says of which kind a task is; a file without any lacks the first one."""
    return next((table for table in MODULES if table in file), next(iter(MODULES)))
