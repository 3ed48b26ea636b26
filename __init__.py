"""Kulman: a drafting machine in software for the theory of mechanisms and machines."""

from typing import TYPE_CHECKING, Any

from .scales.version import __version__ as __version__

if TYPE_CHECKING:
    from .scales.errors import KulmanError as KulmanError
    from .variants.batches.batch import batch as batch
    from .variants.charts.charts import chart as chart
    from .variants.making.all_variants import all_variants as all_variants
    from .variants.marking.checks import check as check
    from .variants.notes import note as note
    from .variants.reader import load_task as load_task
    from .variants.sheets import handout as handout
    from .variants.sheets import sheet as sheet
    from .variants.solution import solve as solve
    from .variants.sweeps.sweeps import sweep as sweep

_HOMES = {
    "KulmanError": "scales.errors",
    "all_variants": "variants.making.all_variants",
    "batch": "variants.batches.batch",
    "chart": "variants.charts.charts",
    "check": "variants.marking.checks",
    "handout": "variants.sheets",
    "load_task": "variants.reader",
    "note": "variants.notes",
    "sheet": "variants.sheets",
    "solve": "variants.solution",
    "sweep": "variants.sweeps.sweeps",
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
