"""The output in its stroke: how much of the stroke it has done, and whether that is the working one.

The ends of the working stroke are givens of the board: metres of a slider along its guide, radians of a rocker.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import assert_never

from ...scales.errors import InputError
from ..board import Board
from .mechanism import BOTH, FRAME, STROKE, ZERO, Mechanism, Pair, Prismatic, Revolute
from .parts import Bodies, Body, Span

BEGIN, END = "_stroke_begin", "_stroke_end"
PART, RATE, CHANGE = "_stroke_part", "_stroke_rate", "_stroke_change"


@dataclass(frozen=True, slots=True)
class Moving:
    """A mechanism whose motion is constructed.

    `speed` and `turning` name the driver's rates beside which others are rounding.
    """

    mechanism: Mechanism
    bodies: Bodies
    spans: Mapping[int, Span]
    speed: str
    turning: str


def needs_stroke(mechanism: Mechanism) -> bool:
    """Whether a load acts in one stroke only, or reads its size over the stroke."""
    over_stroke = any(diagram.over == STROKE for diagram in mechanism.diagrams)
    return over_stroke or any(load.stroke != BOTH for load in mechanism.acting)


def lay_stroke(board: Board, moving: Moving) -> None:
    """Find where the output stands between the ends of its working stroke, and which way it goes.

    Raises
    ------
    InputError
        When the mechanism has no output that moves to and fro on the frame.
    """
    stroke, pair = moving.mechanism.stroke, output_pair(moving.mechanism)
    assert stroke is not None
    body = moving.bodies[stroke.link]
    match pair:
        case Prismatic():
            reference = _slides(board, moving, body, pair)
        case Revolute():
            reference = _rocks(board, moving, body)
        case _:
            assert_never(pair)
    for name in (RATE, CHANGE):
        board.calc(f"{name}_working", "signed", name, stroke.sense)
    board.calc("_working", "working", f"{RATE}_working", reference, f"{CHANGE}_working")


def output_pair(mechanism: Mechanism) -> Pair:
    """Return the pair of the output link with the frame.

    Raises
    ------
    InputError
        When no output is named, or it is the driver, or has no such pair.
    """
    if mechanism.stroke is None:
        raise InputError("stroke-missing")
    link = mechanism.stroke.link
    found = [pair for pair in mechanism.pairs if {*pair.links} == {FRAME, link}]
    if not found or link == mechanism.driver.link:
        raise InputError("stroke-link", link=link)
    return found[0]


def _slides(board: Board, moving: Moving, body: Body, pair: Prismatic) -> str:
    """A slider: its travel from the point through which the guide passes."""
    board.place("_stroke_origin", *pair.through)
    board.calc("_stroke_travel", "along_axis", body.direction, "_stroke_origin", pair.point)
    board.calc(PART, "stroke_part", "_stroke_travel", BEGIN, END)
    board.calc(RATE, "component", body.direction, f"V_{pair.point}")
    board.calc(CHANGE, "component", body.direction, f"a_{pair.point}")
    return moving.speed


def _rocks(board: Board, moving: Moving, body: Body) -> str:
    """A rocker: its angle, counted from the middle of its stroke, so that it may swing by almost a turn."""
    board.calc("_stroke_middle", "middle", BEGIN, END)
    board.turn("_stroke_axis", "_stroke_middle")
    board.angle("_stroke_swing", "_stroke_axis", body.direction)
    board.calc("_stroke_angle", "sum", "_stroke_middle", "_stroke_swing")
    board.calc(PART, "stroke_part", "_stroke_angle", BEGIN, END)
    board.calc(RATE, "same_turning", body.omega or ZERO)
    board.calc(CHANGE, "same_turning", body.epsilon or ZERO)
    return moving.turning
