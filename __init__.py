"""Kulman: a drafting machine in software for the theory of mechanisms and machines."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .scales import KulmanError as KulmanError
    from .variants import all_variants as all_variants
    from .variants import batch as batch
    from .variants import chart as chart
    from .variants import check as check
    from .variants import handout as handout
    from .variants import load_task as load_task
    from .variants import note as note
    from .variants import sheet as sheet
    from .variants import solve as solve
    from .variants import sweep as sweep

__version__ = "0.1.0"
__all__ = [
    "KulmanError",
    "__version__",
    "all_variants",
    "batch",
    "chart",
    "check",
    "handout",
    "load_task",
    "note",
    "sheet",
    "solve",
    "sweep",
]

_HOMES = {name: "variants" for name in __all__ if name != "__version__"} | {"KulmanError": "scales"}


def __getattr__(name: str) -> Any:
    """Load a public name where it lives only when it is asked for (PEP 562), so that `list` imports no numpy."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f".{_HOMES[name]}", __name__), name)


def __dir__() -> list[str]:
    """List the public names, loaded or not."""
    return sorted(__all__)
