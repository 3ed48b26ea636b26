"""The whole construction of a cam: which drawings, in which order."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..board import Program, RecordingBoard, with_needs
from .cam import DIAGRAMS_PART, PLANS, PLATE, PRESSURE_PART, PROFILE_PART, ROCKER, ROLLER, SIZES_PART
from .division import Division
from .formulas import ARC
from .integration import ACCELERATION, diagrams
from .inversion import plate_profile, positions, roller_profile
from .rocker_plans import rocker_profile, rocker_sizes
from .scale_factors import chord_factors, exact_factors
from .size_plans import ordinates, permitted_offsets, plate_sizes, roller_sizes, smallest_plate_cam, smallest_roller_cam

NEEDS = {DIAGRAMS_PART: (), SIZES_PART: (DIAGRAMS_PART,), PROFILE_PART: (SIZES_PART,), PRESSURE_PART: (SIZES_PART,)}


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a cam depends on beside numbers.

    `given` is the diagram that the law gives; `fastest` the section line of the greatest velocity; `limits` names the
    limits of the pressure angle, `corner` the two whose tangents meet at a cam's centre; `ranged` tells that r_0 is
    given, and between which offsets the cam may be; `plate_given` that r_0 of the cam for a plate is; `rocks` that the
    travel runs along the arc of a rocker.
    """

    division: Division
    followers: tuple[str, ...]
    given: str = ACCELERATION
    fastest: int = 0
    limits: tuple[str, ...] = ()
    corner: tuple[str, ...] = ()
    ranged: bool = False
    plate_given: bool = False
    rocks: bool = False


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction of the plans wanted and of those they need."""
    board, wanted = RecordingBoard(), with_needs(plans, NEEDS)
    division, given = layout.division, layout.given
    if DIAGRAMS_PART in wanted:
        diagrams(board, division.sections, given)
        if layout.rocks:
            board.calc("h", ARC, "psi", "l_rocker")
        exact_factors(board, given)
        chord_factors(board, division, layout.fastest, given)
    if SIZES_PART in wanted:
        ordinates(board, division, given)
        if ROLLER in layout.followers:
            roller_sizes(board, division, layout.limits, layout.corner)
            smallest_roller_cam(board)
            if layout.ranged:
                permitted_offsets(board)
        if PLATE in layout.followers:
            plate_sizes(board, division)
            smallest_plate_cam(board, layout.plate_given)
        if ROCKER in layout.followers:
            rocker_sizes(board, division)
    if PROFILE_PART in wanted:
        positions(board, division)
        if ROLLER in layout.followers:
            roller_profile(board, division)
        if PLATE in layout.followers:
            plate_profile(board, division)
        if ROCKER in layout.followers:
            rocker_profile(board, division)
    return Program(board.steps)
