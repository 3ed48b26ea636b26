"""Sheets of several pages: in reading order, the plans that nobody has scaled as large as the pages have room."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....scales.errors import InputError
from ...compose import arrange_parts, room
from ...formats import Format
from ...packing import Placement
from ...rows import Size
from ...view import View
from .fitting import Fitted, Fitting

# views with which the part of the forces begins
FORCES = ("load_", "equations_forces_loads", "group_", "driver", "lever")
WORDS = 40.0  # mm of a figure that do not grow with its scale factor: its letters and its heading

Several = tuple[Fitted, list[Placement]]


def several(fitting: Fitting, sheet: Format) -> Several:
    """Return views, scale factors and places on as many pages of `sheet` as they need.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    found = _roomy(fitting, sheet) or _reordered(fitting, sheet)
    if found is None:
        raise InputError("sheet-too-small", format=sheet.name)
    return found


def forces_begin(names: Sequence[str]) -> int:
    """Return how many views of these names come before the part of the forces."""
    return next((i for i, name in enumerate(names) if name.startswith(FORCES)), len(names))


def _roomy(fitting: Fitting, sheet: Format) -> Several | None:
    """Place the views in reading order, the larger ones smaller if the first page cannot hold them."""
    for first in (False, True):
        try:
            fitted, rungs = fitting.fitted(sheet, 0, first)
        except InputError:
            if not first:
                raise
            return None
        if first and not fitting.keeps(fitted[1]):
            return None
        places = _placed(fitting, sheet, fitted[0])
        if places is not None:
            return _enlarged(fitting, sheet, (fitted, places), rungs)
    return None


def _reordered(fitting: Fitting, sheet: Format) -> Several | None:
    """Begin with the first view that the first page can hold: a text, where a fixed plan is too large for it."""
    views, scales = fitting.views(sheet)
    wide, high = room(sheet, fitting.contents.norm, first=True)
    fit = [i for i, view in enumerate(views) if view.size[0] <= wide and view.size[1] <= high]
    for i in fit[:1]:
        order = [views[i], *views[:i], *views[i + 1 :]]
        places = _placed(fitting, sheet, order)
        if places is not None:
            return (order, scales), places
    return None


def _placed(fitting: Fitting, sheet: Format, views: Sequence[View]) -> list[Placement] | None:
    return _arranged(fitting, sheet, [view.name for view in views], [view.size for view in views])


def _arranged(fitting: Fitting, sheet: Format, names: Sequence[str], sizes: Sequence[Size]) -> list[Placement] | None:
    """Place views of these sizes: kinematics on the first pages, forces on the others."""
    forces = forces_begin(names)
    return arrange_parts((sizes[:forces], sizes[forces:]), sheet, fitting.contents.norm)


def _enlarged(fitting: Fitting, sheet: Format, found: Several, rungs: Mapping[str, int]) -> Several:
    """Draw plans that nobody has scaled larger, as long as the pages do not become more, nor more mixed."""
    shape = _shape([view.name for view in found[0][0]], found[1])
    taken = _growth(fitting, sheet, rungs, shape)
    while taken:
        finer = dict(rungs)
        for symbol in taken:
            finer[symbol] -= 1
        built, scales = fitting.build(sheet, finer)
        views = [view for view, _ in built]
        places = _placed(fitting, sheet, views)
        if places is not None and _shape([view.name for view in views], places) <= shape:
            return (views, scales), places
        taken.pop()
    return found


def _growth(fitting: Fitting, sheet: Format, rungs: Mapping[str, int], shape: tuple[int, bool]) -> list[str]:
    """Return the scale factors to be made finer by a rung, some several times, by what size the views would have."""
    built, _ = fitting.build(sheet, rungs)
    names, sizes = [view.name for view, _ in built], [view.size for view, _ in built]
    wide, high = room(sheet, fitting.contents.norm)
    now, taken = dict(rungs), list[str]()
    growing = [symbol for symbol in rungs if fitting.finer[symbol] and rungs[symbol] <= 0]
    while growing:
        for symbol in tuple(growing):
            ratio = fitting.mu(symbol, now[symbol]) / fitting.mu(symbol, now[symbol] - 1)
            trial = [_grown(size, ratio) if s == symbol else size for size, (_, s) in zip(sizes, built, strict=True)]
            places = None
            if ratio > 1.0 and all(w <= wide and h <= high for w, h in trial):
                places = _arranged(fitting, sheet, names, trial)
            if places is None or _shape(names, places) > shape:
                growing.remove(symbol)
                continue
            sizes, now[symbol] = trial, now[symbol] - 1
            taken.append(symbol)
    return taken


def _grown(size: Size, ratio: float) -> Size:
    wide, high = (side + max(0.0, side - WORDS) * (ratio - 1.0) for side in size)
    return wide, high


def _shape(names: Sequence[str], places: Sequence[Placement]) -> tuple[int, bool]:
    """Return how many pages there are, and whether kinematics and forces share one: the less, the better."""
    pages, forces = [place.page for place in places], forces_begin(names)
    return max(pages) + 1, not {*pages[:forces]}.isdisjoint(pages[forces:])
