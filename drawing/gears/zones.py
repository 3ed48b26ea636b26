"""The customary arrangement of a gear pair's sheet of format A1: the meshing on the left, sliding and tables beside."""

from __future__ import annotations

from ..nesting import column, row
from ..zones import BLOCK, TURNED

# everything on one page, for sheets without the worked formulas
LAYOUT = row(
    column(TURNED, "meshing"),
    column(
        row("rolling", "data"),
        row(column("action", "sliding"), column("points", "checks", "contour", BLOCK)),
    ),
)
# what is drawn, where the calculations need a further page; where it has no room, the meshing with what belongs to it
FIRST_PAGES = (
    row(
        column(TURNED, "meshing"),
        column(row("rolling", "data"), row(column("action", "checks", "points"), column("sliding", BLOCK))),
    ),
    row(
        column(TURNED, "meshing"),
        column(row("rolling", "data"), row(column("action", "contour"), column("checks", BLOCK))),
    ),
)
LAYOUTS = (LAYOUT,)
