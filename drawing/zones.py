"""Customary arrangements: the views of a sheet in nests laid out by hand, round the blocks of the title."""

from __future__ import annotations

from collections.abc import Sequence

from .formats import Format, reserved_boxes, usable
from .nesting import Nest, names, nested
from .packing import Placement
from .pens import Norm
from .view import View

BLOCK, TURNED = "block", "turned"  # the title block below the last column, column 26 above the first one
GAP = 4.0  # mm between views


def zoned(layouts: Sequence[Nest], views: Sequence[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Return the places of the views on one page by the first layout with room for them all; None if none has."""
    x0, y0, x1, y1 = usable(sheet, norm)
    block, *turned = reserved_boxes(sheet, norm)
    sizes = {view.name: view.size for view in views}
    fitting = [nest for nest in layouts if sizes.keys() <= set(names((nest,)))]
    sizes[BLOCK] = x1 - block[0], block[3] - y0
    for box in turned:
        sizes[TURNED] = box[2] - x0, y1 - box[1]
    tried = (nested(layout, sizes, (x1 - x0, y1 - y0), GAP) for layout in fitting)
    found = next((places for places in tried if places is not None), None)
    if found is None:
        return None
    places = {name: Placement(0, x0 + x, y0 + y) for name, x, y in found}
    return [places[view.name] for view in views]
