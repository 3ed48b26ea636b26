"""Down the ladders of scale factors: the first rungs at which every view has room on a page of its own."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Generic, Protocol, TypeVar

from ..plans.names import role
from ..scales.choices import SIZES
from ..scales.errors import InputError
from .compose import arrange
from .figure import Figure, Scene
from .formats import Format, room
from .packing import Placement
from .pens import Norm
from .view import View

Rungs = TypeVar("Rungs")
Wanted = TypeVar("Wanted", contravariant=True)  # rungs again, as a protocol takes them


class Drawer(Protocol[Wanted]):
    """Who draws the views of a sheet for any format, at any rungs of its ladders."""

    @property
    def ladders(self) -> Mapping[str, tuple[float, ...]]:
        """Return the ladders by name; the rungs have a field of each name."""

    def views(self, sheet: Format, rungs: Wanted) -> Sequence[tuple[View, Figure[Any]]]:
        """Return the views of a sheet, each with its figure."""


class Kept(Generic[Scene]):
    """Views that have been drawn: one is drawn again only where a ladder that it depends on has another rung."""

    def __init__(self) -> None:
        self._drawn: dict[tuple[Hashable, ...], View] = {}

    def view(self, scene: Scene, sheet: Format, rungs: object, figure: Figure[Scene], *of: Hashable) -> View:
        """Return the view of a figure; `of` says what else it depends on."""
        key = sheet.name, figure.name, *of, *(getattr(rungs, ladder) for ladder in figure.ladders)
        if key not in self._drawn:
            self._drawn[key] = figure.draw(scene)
        return self._drawn[key]


def fitted(drawer: Drawer[Rungs], sheet: Format, norm: Norm, rungs: Rungs, first: bool = False) -> Rungs:
    """Return the first rungs, from these on, at which every view has room on a page of its own.

    `first` tells that it may be the first page, with the larger title block.

    Raises
    ------
    InputError
        When a view has none at the last rung.
    """
    wide, high = room(sheet, norm, first)
    while True:
        views = drawer.views(sheet, rungs)
        tight = {f.ladders: v.size for v, f in views if v.size[0] > wide or v.size[1] > high}
        if not tight:
            return rungs
        for ladders, size in tight.items():
            name = next((ladder for ladder in ladders if has_next(drawer, rungs, ladder)), None)
            if name is None:
                raise too_fine(drawer, sheet, ladders) or too_small(sheet, size)
            rungs = lower(rungs, name)


def too_fine(drawer: Drawer[Rungs], sheet: Format, ladders: tuple[str, ...]) -> InputError | None:
    """Return that a drawing has no room because a user has fixed its scale factor, m/mm; None if nobody has."""
    fixed = next((name for name in ladders if role(name).kind == "mu" and len(drawer.ladders[name]) == 1), None)
    if fixed is None:
        return None
    return InputError("plan-too-fine", symbol=fixed, mu=f"{drawer.ladders[fixed][0]:g}", format=sheet.name)


def too_small(sheet: Format, size: tuple[float, float]) -> InputError:
    """Return why a drawing of this size, mm, that cannot be smaller has no room on a format, or on any."""
    if sheet.name != SIZES[-1]:
        return InputError("sheet-too-small", format=sheet.name)
    return InputError("sheet-too-large", wide=f"{size[0]:.0f}", high=f"{size[1]:.0f}")


def has_next(drawer: Drawer[Rungs], rungs: Rungs, ladder: str) -> bool:
    """Whether a ladder has a further rung."""
    return bool(getattr(rungs, ladder) + 1 < len(drawer.ladders[ladder]))


def lower(rungs: Rungs, ladder: str) -> Rungs:
    """Return the rungs with the next one of a ladder."""
    own: Any = rungs  # a dataclass
    lowered: Rungs = replace(own, **{ladder: getattr(rungs, ladder) + 1})
    return lowered


def on_pages(views: Sequence[View], sheet: Format, norm: Norm) -> list[Placement]:
    """Place views on as many pages as they need.

    Raises
    ------
    InputError
        When one has no room on a page.
    """
    places = arrange([view.size for view in views], sheet, norm, None)
    if places is None:
        raise InputError("sheet-too-small", format=sheet.name)
    return places
