"""The customary arrangement of a cam's sheet of format A1: diagrams on the left, profiles on top, tables below."""

from __future__ import annotations

from ..nesting import column, row
from ..zones import BLOCK, TURNED

LAYOUT = row(
    column(TURNED, "diagrams", "equations_plate"),
    column(
        row("profile", "plate_profile", "sizes"),
        row(
            column("motion", "equations_roller"),
            column("givens", "choices", "pressure"),
            column("plate_sizes", "equations_scales", BLOCK),
        ),
    ),
)
ROCKER_LAYOUT = row(
    column(TURNED, "diagrams"),
    column("profile", row("motion", column("givens", "choices"))),
    column("rocker_sizes", "equations_rocker", "pressure", "equations_scales", BLOCK),
)
LAYOUTS = LAYOUT, ROCKER_LAYOUT
