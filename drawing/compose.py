"""Composing a sheet: views on pages, in frames with title blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from .formats import Format, drawing_area, reserved_boxes
from .frame import frame_shapes
from .packing import Placement, pack
from .page import Page
from .pens import Norm
from .titleblock import Stamp
from .view import View

MARGIN = 4.0  # mm between the frame and any view
GAP = 7.0  # mm between views
CLOSE = 4.0  # mm between views on the smallest format


def room(sheet: Format, norm: Norm) -> tuple[float, float]:
    """Return width and height of the largest view that a page of its own can hold, beside nothing else."""
    x0, _, x1, y1 = _area(sheet, norm)
    block = reserved_boxes(sheet, norm, first=False)[0]
    return x1 - x0, y1 - block[3] - CLOSE


def arrange(
    views: Sequence[View], sheet: Format, norm: Norm, pages: int | None, any_order: bool = True
) -> list[Placement] | None:
    """Place the views on at most `pages` pages of `sheet`, or on as many as they need; None if they do not fit.

    They stand in reading order; only with `any_order` they may leave it where nothing else fits.
    """
    return _arranged(views, sheet, norm, pages, any_order)


def arrange_parts(parts: Sequence[Sequence[View]], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on as many pages as they need, each part on pages of its own where that takes no more of them."""
    together = arrange([view for part in parts for view in part], sheet, norm, None)
    places: list[Placement] = []
    for part in filter(None, parts):
        pages = max((place.page + 1 for place in places), default=0)
        own = _arranged(part, sheet, norm, None, True, first=not pages)
        if own is None:
            return together
        places += [replace(place, page=place.page + pages) for place in own]
    if together is None or max(p.page for p in places) <= max(p.page for p in together):
        return places
    return together


def _arranged(
    views: Sequence[View], sheet: Format, norm: Norm, pages: int | None, any_order: bool, first: bool = True
) -> list[Placement] | None:
    return pack(
        [[view.size] for view in views],
        _area(sheet, norm),
        reserved_boxes(sheet, norm, first=first),
        later=reserved_boxes(sheet, norm, first=False),
        gap=CLOSE if sheet.letters == "A4" else GAP,
        pages=pages,
        any_order=any_order,
    )


def arrange_rest(views: Sequence[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on as many following pages as they need, counted from 0; None if one has no room on a page."""
    later = reserved_boxes(sheet, norm, first=False)
    return pack([[view.size] for view in views], _area(sheet, norm), later, gap=GAP, pages=None)


def compose(views: Sequence[View], places: Sequence[Placement], sheet: Format, norm: Norm, stamp: Stamp) -> list[Page]:
    """Return the finished pages: frame, title block and the views at their places."""
    count = max(place.page for place in places) + 1
    pages = []
    for number in range(count):
        own = replace(stamp, sheet=number + 1, sheets=count)
        frame = frame_shapes(sheet, own, norm, first=number == 0)
        figures = [v.at(p.x, p.y) for v, p in zip(views, places, strict=True) if p.page == number]
        pages.append(Page(sheet.width, sheet.height, (*frame, *figures), stamp.title, stamp.language, norm))
    return pages


def _area(sheet: Format, norm: Norm) -> tuple[float, float, float, float]:
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    margin = MARGIN if sheet.letters != "A4" else 2.0
    return x0 + margin, y0 + margin, x1 - margin, y1 - margin
