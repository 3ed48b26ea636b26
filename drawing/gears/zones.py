"""The customary arrangement of a gear pair's sheet of format A1: the meshing on the left, sliding and tables beside."""

from __future__ import annotations

from ..nesting import column, row
from ..zones import BLOCK, TURNED

LAYOUT = row(
    column(TURNED, "meshing"),
    column(
        row("rolling", "data"),
        row(column("action", "sliding"), column("points", "checks", BLOCK)),
    ),
)
LAYOUTS = (LAYOUT,)
