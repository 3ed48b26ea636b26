"""Kulman: a drafting machine in software for the theory of mechanisms and machines."""

from typing import TYPE_CHECKING, Any

from .scales.version import __version__ as __version__

if TYPE_CHECKING:
    from .plans.quantities import Quantity as Quantity
    from .scales.errors import KulmanError as KulmanError
    from .scales.series import Series as Series
    from .variants.batches.batch import Batch as Batch
    from .variants.batches.batch import batch as batch
    from .variants.charts.charts import Charts as Charts
    from .variants.charts.charts import chart as chart
    from .variants.making.all_variants import AllVariants as AllVariants
    from .variants.making.all_variants import all_variants as all_variants
    from .variants.many import ManyStates as ManyStates
    from .variants.many import Status as Status
    from .variants.many import solve_many as solve_many
    from .variants.marking.checks import Check as Check
    from .variants.marking.checks import check as check
    from .variants.marking.reading import Answers as Answers
    from .variants.marking.report import Report as Report
    from .variants.notes import Note as Note
    from .variants.notes import note as note
    from .variants.reader import load_task as load_task
    from .variants.sheets import Sheet as Sheet
    from .variants.sheets import handout as handout
    from .variants.sheets import sheet as sheet
    from .variants.shelf import tasks as tasks
    from .variants.solution import Solution as Solution
    from .variants.solution import solve as solve
    from .variants.sweeps.sweeps import sweep as sweep
    from .variants.tables import Swept as Swept
    from .variants.task import Task as Task

_HOMES = {
    "AllVariants": "variants.making.all_variants",
    "Answers": "variants.marking.reading",
    "Batch": "variants.batches.batch",
    "Charts": "variants.charts.charts",
    "Check": "variants.marking.checks",
    "KulmanError": "scales.errors",
    "ManyStates": "variants.many",
    "Note": "variants.notes",
    "Quantity": "plans.quantities",
    "Report": "variants.marking.report",
    "Series": "scales.series",
    "Sheet": "variants.sheets",
    "Solution": "variants.solution",
    "Status": "variants.many",
    "Swept": "variants.tables",
    "Task": "variants.task",
    "all_variants": "variants.making.all_variants",
    "batch": "variants.batches.batch",
    "chart": "variants.charts.charts",
    "check": "variants.marking.checks",
    "handout": "variants.sheets",
    "load_task": "variants.reader",
    "note": "variants.notes",
    "sheet": "variants.sheets",
    "solve": "variants.solution",
    "solve_many": "variants.many",
    "sweep": "variants.sweeps.sweeps",
    "tasks": "variants.shelf",
}
__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    """Load a public name where it lives only when it is asked for (PEP 562), so that `list` imports no numpy."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f".{_HOMES[name]}", __name__), name)


def __dir__() -> list[str]:
    """List the public names, loaded or not."""
    return sorted(__all__)
