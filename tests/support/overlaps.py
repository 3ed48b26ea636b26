"""What touches on a drawn sheet; shapely, which no drawing code uses, is the judge."""

from collections.abc import Iterator

import numpy as np
import shapely

from kulman.tests.support.readback import Page, Sheet, Stroke, Text, View, boxes, polygon, thick

TINY = 1e-6
BLOCKS = {"form-1", "form-2a", "iso-7200", "column-26"}  # in which no view may stand


def overlaps(sheet: Sheet) -> list[str]:
    """All faults of a sheet: letters that touch something, views that touch each other, the frame or the block."""
    return [fault for page in sheet.pages for fault in page_faults(page)]


def page_faults(page: Page) -> Iterator[str]:
    """Faults of one page."""
    for view in page.all:
        yield from text_faults(view)
    yield from view_faults(page)


def text_faults(view: View) -> Iterator[str]:
    """Texts of a view that touch a text, a circle, an arrowhead or a main line."""
    where = view.name or "frame"
    texts = view.texts
    areas = boxes([text.box for text in texts])
    tree = shapely.STRtree(areas)
    for i, j in tree.query(areas, predicate="intersects").T.tolist():
        if i < j and shapely.area(shapely.intersection(areas[i], areas[j])) > TINY:
            yield f"{where}: {texts[i].string!r} on {texts[j].string!r}"
    for thing, name in _things(view):
        for i in tree.query(thing, predicate="intersects").tolist():
            yield f"{where}: {texts[i].string!r} on {name}"


def _things(view: View) -> Iterator[tuple[shapely.Geometry, str]]:
    main = max((s.width for s in view.strokes), default=0.0)
    for stroke in view.strokes:
        if stroke.width == main and stroke.width > 0:
            yield thick(stroke), f"main line {_called(stroke)}"
    for ring in view.rings:
        disc = shapely.Point(ring.centre.real, ring.centre.imag).buffer(ring.radius + ring.width / 2, quad_segs=16)
        yield disc, f"circle {ring.path[-1][1] if ring.path else ''}"
    for tip in view.tips:
        yield polygon(tip.corners), f"arrowhead {tip.path[-1][1] if tip.path else ''}"


def _called(stroke: Stroke) -> str:
    return "/".join(filter(None, (*(name for _, name in stroke.path), stroke.role, stroke.name)))


def thin_faults(view: View) -> Iterator[tuple[Text, Stroke]]:
    """Texts that a thin line runs through: allowed by G5, but no pleasure to read."""
    main = max((s.width for s in view.strokes), default=0.0)
    areas = boxes([text.box for text in view.texts])
    if not len(areas):
        return
    tree = shapely.STRtree(areas)
    for stroke in view.strokes:
        if 0 < stroke.width < main:
            for i in tree.query(thick(stroke), predicate="intersects").tolist():
                yield view.texts[i], stroke


def view_faults(page: Page) -> Iterator[str]:
    """Views that leave the frame, lie on the title block or on each other."""
    areas = boxes([view.box for view in page.views])
    for i, view in enumerate(page.views):
        for j in np.flatnonzero(shapely.area(shapely.intersection(areas[i], areas)) > TINY).tolist():
            if i < j:
                yield f"view {view.name} on view {page.views[j].name}"
    (frame,) = [s for s in page.rest.strokes if s.role == "frame"]
    xs, ys = [p.real for p in frame.points], [p.imag for p in frame.points]
    half = frame.width / 2
    inner = shapely.box(min(xs) + half, min(ys) + half, max(xs) - half, max(ys) - half)
    obstacles = [polygon(corners) for corners in _blocks(page)]
    for view, area in zip(page.views, areas, strict=True):
        if not inner.contains(area):
            yield f"view {view.name} leaves the frame"
        if any(shapely.area(shapely.intersection(area, block)) > TINY for block in obstacles):
            yield f"view {view.name} on the title block"
        outside = [text for text in view.texts if not inner.contains(shapely.box(*text.box))]
        yield from (f"{view.name}: {text.string!r} leaves the frame" for text in outside)


def _blocks(page: Page) -> Iterator[tuple[complex, ...]]:
    """Boxes of the blocks drawn in the corners of the frame, from their own lines."""
    names = {s.path[0][1] for s in page.rest.strokes if s.path} & BLOCKS
    for name in sorted(names):
        points = [p for s in page.rest.strokes if s.path and s.path[0][1] == name for p in s.points]
        x0, x1 = min(p.real for p in points), max(p.real for p in points)
        y0, y1 = min(p.imag for p in points), max(p.imag for p in points)
        yield complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1)
