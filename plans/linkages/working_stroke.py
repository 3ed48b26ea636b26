"""The output in its stroke: how much of the stroke it has done, and whether that is the working one.

The ends of the working stroke are givens of the board: metres of a slider along its guide, radians of a rocker.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, assert_never

from ...scales.errors import InputError
from ..board import Board
from .mechanism import BOTH, FRAME, STROKE, ZERO, Mechanism, Pair, Prismatic, Revolute
from .parts import Bodies, Body, Span
from .triads.parts import start_names

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


def stroke_ends(mechanism: Mechanism, values: Mapping[str, Any], motion: Iterable[str]) -> dict[str, Any]:
    """Find the ends of the working stroke: once where only the driver moves, else for every mechanism of the arrays.

    `motion` names the values on which its motion depends.
    """
    from .cycles.strokes import stroke_of  # which sweeps constructions, and these read loads over the stroke

    assert mechanism.stroke is not None
    sense, driver_at = mechanism.stroke.sense, mechanism.driver.coordinate
    followed = {name for start in mechanism.starts for name in start_names(start.link)}
    stated = {name for start in mechanism.starts for name in (start.x, start.y, start.angle, start.driver)}
    needed = {name: values[name] for name in {*motion, sense, *stated} & values.keys() - {driver_at} - followed}
    size = max((len(value) for value in needed.values() if getattr(value, "ndim", 0)), default=0)
    found = []
    for row in range(size or 1):
        one = {name: float(value[row] if getattr(value, "ndim", 0) else value) for name, value in needed.items()}
        travel = stroke_of(mechanism, {**one, driver_at: 0.0})
        found.append((travel.low, travel.high) if one.get(sense, 1.0) > 0.0 else (travel.high, travel.low))
    begin, end = zip(*found, strict=True)
    return {BEGIN: [*begin], END: [*end]} if size else {BEGIN: begin[0], END: end[0]}
