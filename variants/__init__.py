"""Tasks as data: their reader, their variants, and what is solved and drawn of them."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .batches.batch import batch as batch
    from .charts.charts import chart as chart
    from .handouts import handout as handout
    from .making.all_variants import all_variants as all_variants
    from .marking.checks import check as check
    from .notes import note as note
    from .reader import load_task as load_task
    from .sheets import sheet as sheet
    from .solution import solve as solve
    from .sweeps.sweeps import sweep as sweep

__all__ = ["all_variants", "batch", "chart", "check", "handout", "load_task", "note", "sheet", "solve", "sweep"]

_HOMES = {
    "all_variants": "making.all_variants",
    "batch": "batches.batch",
    "chart": "charts.charts",
    "check": "marking.checks",
    "handout": "handouts",
    "load_task": "reader",
    "note": "notes",
    "sheet": "sheets",
    "solve": "solution",
    "sweep": "sweeps.sweeps",
}


def __getattr__(name: str) -> Any:
    """Load what is asked for, so that a list of tasks needs no numpy."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
