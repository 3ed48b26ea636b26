"""Kinds of tasks: one module a kind, with all that a task of that kind needs, loaded when such a task is met.

A task file says of which kind it is by the table in which it describes its subject: `[mechanism]`, `[cam]`, `[gear]`,
`[hoist]`.
"""

from __future__ import annotations

from collections.abc import Container

MODULES = {"mechanism": "linkage", "cam": "cam", "gear": "gear", "hoist": "hoist"}  # module of each kind by its table
KINDS = tuple(MODULES.values())


def table_in(file: Container[str]) -> str:
    """Return which table says of which kind a task is; a file without any lacks the first one."""
    return next((table for table in MODULES if table in file), next(iter(MODULES)))
