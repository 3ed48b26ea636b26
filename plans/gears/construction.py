"""The whole construction of a gear pair: the calculation of its sizes, its meshing drawn, its sliding drawn.

Plans are `meshing`, in metres, and `sliding` and `theta`, in metres of paper; `meshing_plan` and `sliding_plan` say
what their marks are.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..board import Program, RecordingBoard, with_needs
from .gear import GEOMETRY_PART, MESHING_PART, PLANS, SLIDING_PART
from .geometry import SIZES
from .meshing_plan import Rolling, meshing
from .sliding_plan import sliding

NEEDS = {GEOMETRY_PART: (), MESHING_PART: (GEOMETRY_PART,), SLIDING_PART: (GEOMETRY_PART,)}


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a pair depends on beside numbers.

    `rollings` say how the involutes of both wheels are divided, `sense` is +1 where the pinion turns counter-clockwise,
    `pole` the point of the table of sliding that stands in P.
    """

    rollings: tuple[Rolling, Rolling]
    sense: int
    pole: str


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction of the plans wanted and of those they need."""
    board, wanted = RecordingBoard(), with_needs(plans, NEEDS)
    if GEOMETRY_PART in wanted:
        for part in SIZES:
            part(board)
    if MESHING_PART in wanted:
        meshing(board, layout.rollings, layout.sense)
    if SLIDING_PART in wanted:
        sliding(board, layout.pole)
    return Program(board.steps)
