"""Sheets of several pages: views in reading order."""

from __future__ import annotations

from collections.abc import Sequence

from ....scales.errors import InputError
from ...compose import arrange_parts
from ...extents import Rungs
from ...formats import Format, room
from ...packing import Placement
from ...view import View
from .fitting import Fitted, Fitting

# views with which the part of the forces begins
OF_FORCES = ("load_", "equations_forces_loads", "group_", "driver", "lever")

Several = tuple[Fitted, list[Placement]]


def several(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several:
    """Return views, scale factors and places on as many pages of `sheet` as they need, from these rungs on.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    found = _roomy(fitting, sheet, rungs) or _reordered(fitting, sheet, rungs)
    if found is None:
        raise InputError("sheet-too-small", format=sheet.name)
    return found


def forces_begin(names: Sequence[str]) -> int:
    """Return how many views of these names come before the part of the forces."""
    return next((i for i, name in enumerate(names) if name.startswith(OF_FORCES)), len(names))


def _roomy(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several | None:
    """Place the views in reading order, the larger ones smaller if the first page cannot hold them."""
    for first in (False, True):
        try:
            fitted, taken = fitting.fitted(sheet, rungs, first)
        except InputError:
            if not first:
                raise
            return None
        if first and any(taken[symbol] > rung for symbol, rung in rungs.items() if fitting.is_fixed(symbol)):
            return None
        places = _placed(fitting, sheet, fitted[0])
        if places is not None:
            return fitted, places
    return None


def _reordered(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several | None:
    """Begin with the first view that the first page can hold: a text, where a fixed plan is too large for it."""
    (views, scales), _ = fitting.fitted(sheet, rungs)
    wide, high = room(sheet, fitting.contents.norm, first=True)
    fit = [i for i, view in enumerate(views) if view.size[0] <= wide and view.size[1] <= high]
    for i in fit[:1]:
        order = [views[i], *views[:i], *views[i + 1 :]]
        places = _placed(fitting, sheet, order)
        if places is not None:
            return (order, scales), places
    return None


def _placed(fitting: Fitting, sheet: Format, views: Sequence[View]) -> list[Placement] | None:
    """Place views: kinematics on the first pages, forces on the others."""
    sizes, forces = [view.size for view in views], forces_begin([view.name for view in views])
    return arrange_parts((sizes[:forces], sizes[forces:]), sheet, fitting.contents.norm)
