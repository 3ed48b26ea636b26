"""The tasks that come with the program: their ids, texts, and what `list` shows of them without checking them again."""

from __future__ import annotations

import tomllib
from importlib.resources import files
from typing import Any

_TASKS = files(__package__) / "tasks"


def bundled() -> tuple[str, ...]:
    """Return the ids of the bundled tasks."""
    names = (entry.name for entry in _TASKS.iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def bundled_text(task: str) -> str:
    """Return the TOML of a bundled task."""
    return (_TASKS / f"{task}.toml").read_text(encoding="utf-8")


def summary(task: str) -> dict[str, Any]:
    """Return what `list` shows of a bundled task: id, title, source, variants, plans, givens with unit or choices."""
    raw = tomllib.loads(bundled_text(task))
    givens = {name: given.get("unit") or given["choices"] for name, given in raw["givens"].items()}
    return {name: raw[name] for name in ("id", "title", "source", "plans")} | {
        "variants": [row["id"] for row in raw["variant"]],
        "givens": givens,
    }
