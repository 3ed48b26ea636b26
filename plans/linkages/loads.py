"""Loads: outer forces and couples, weights and inertia of all links, as they act in a position.

What is not given follows first: masses from lengths, values of load diagrams, how much of its stroke the output has
done, and whether that is the working one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from ...scales.errors import InputError
from ..board import Board
from ..laws import TURN
from ..names import Name, inertia, magnitude, on_link, rate, vector
from .mechanism import (
    ANGLE,
    BOTH,
    FRAME,
    STROKE,
    WORKING,
    ZERO,
    Couple,
    Diagram,
    Link,
    Load,
    Mechanism,
    Prismatic,
    Revolute,
)
from .parts import Bodies, Couples, Forces, Span, local_mark

ROUNDING = 1e-12
# ends of the working stroke: givens of the board, metres of a slider along its guide, radians of a rocker
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


def lay_loads(board: Board, moving: Moving) -> None:
    """Lay down outer loads, weights, the inertia force and moment of every link that has a mass, and sums of couples.

    Raises InputError: when a mass is to follow from the length of a link that has none, a load resists the motion of a
    pivot, or the mechanism has no output that moves to and fro on the frame.
    """
    mechanism = moving.mechanism
    for link in mechanism.links:  # mass and moment of inertia may follow from the distance of its two joints
        length = _length(board, moving, link) if link.per_length or link.inertia_factor else ""
        if link.per_length:
            board.calc(str(link.mass), "mass_by_length", link.per_length, length)
        if link.inertia_factor:
            board.calc(str(link.inertia), "inertia_by_length", link.inertia_factor, str(link.mass), length)
    if needs_stroke(mechanism):
        _lay_stroke(board, moving)
    for diagram in mechanism.diagrams:
        _diagram(board, mechanism, diagram)
    for load in mechanism.loads:
        _load(board, moving, load)
    for couple in mechanism.couples:
        _couple(board, moving, couple)
    if mechanism.gravity and any(link.mass for link in mechanism.links):
        board.turn("_right", ZERO)
        board.normal("_up", "_right")
    for link in mechanism.links:
        for force, law, operands in _of_mass(mechanism, link):
            board.calc(force, law, *operands)
        epsilon = moving.bodies[link.number].epsilon
        if link.inertia and epsilon:
            board.calc(inertia("M", link.number), "inertia_moment", link.inertia, epsilon)
    for name, couples in _sums(_couples(mechanism, moving.bodies)).items():
        board.calc(name, "sum", *couples)


def hung(mechanism: Mechanism, bodies: Bodies) -> tuple[Forces, Couples]:
    """Return forces and couples by link: inertia first, weight, then outer loads; couples as one sum."""
    forces: Forces = {}
    for link in mechanism.links:
        forces[link.number] = {name: str(link.centre) for name, _, _ in _of_mass(mechanism, link)}
        forces[link.number] |= {load.name: load.point for load in mechanism.loads if load.link == link.number}
    couples = _couples(mechanism, bodies)
    for name, parts in _sums(couples).items():
        couples[next(number for number in couples if couples[number] == parts)] = [name]
    return forces, couples


def _of_mass(mechanism: Mechanism, link: Link) -> Iterator[tuple[Name, str, tuple[str, ...]]]:
    """Go through the forces at a link's centre, name, law and operands: inertia force where that moves, weight."""
    mass, centre = str(link.mass), str(link.centre)
    if link.mass and link.centre not in mechanism.frame_points:
        yield inertia("F", link.number), "inertia_force", (mass, vector("a", centre))
    if link.mass and mechanism.gravity:
        yield rate("G", link.number), "weight", (mass, mechanism.gravity, "_up")


def _couples(mechanism: Mechanism, bodies: Bodies) -> Couples:
    found: Couples = {link.number: [] for link in mechanism.links}
    for link in mechanism.links:
        if link.inertia and bodies[link.number].epsilon:
            found[link.number].append(inertia("M", link.number))
    for couple in mechanism.couples:
        found[couple.link].append(on_link(couple.name, couple.link))
    return found


def _sums(couples: Couples) -> dict[str, list[str]]:
    """Return the sums of couples on links that have several: `M_sum`, of more such links `M_sum_3`."""
    several = {number: parts for number, parts in couples.items() if len(parts) > 1}
    own = "M_sum" if len(several) == 1 else ""
    return {on_link(own or f"M_sum_{number}", number): parts for number, parts in several.items()}


def _length(board: Board, moving: Moving, link: Link) -> str:
    if link.number in moving.spans:
        return moving.spans[link.number].length
    pairs = (pair for pair in moving.mechanism.pairs if isinstance(pair, Revolute) and link.number in pair.links)
    joints = sorted({pair.point for pair in pairs}, key=lambda point: (link.points[point] != (ZERO, ZERO), point))
    if len(joints) != 2:
        raise InputError("no-length", link=link.number)
    span = Span(link, joints[0], joints[1])
    if span.measured:
        board.measure(span.length, *(local_mark(board, link, point) for point in joints))
    return span.length


def _load(board: Board, moving: Moving, load: Load) -> None:
    """Lay down a force: along its direction, or against the velocity of its point."""
    size = _size(board, moving.mechanism, load)
    if load.direction is not None:
        board.turn(f"e_{load.name}", load.direction)
        board.calc(load.name, "along", size, f"e_{load.name}")
    elif load.point in moving.mechanism.frame_points:
        raise InputError("load-still", name=load.name, point=load.point)
    elif line := _line(board, moving, load):
        board.calc(load.name, "resisting_along", size, vector("V", load.point), line, moving.speed)
    else:
        board.distance(f"_V_of_{load.name}", "velocity.p", f"velocity.{load.point}")
        board.calc(load.name, "resisting_force", size, vector("V", load.point), f"_V_of_{load.name}", moving.speed)


def _line(board: Board, moving: Moving, load: Load) -> str | None:
    """Return the direction along which a load's point moves where its link is on the frame: of the guide, or round.

    Near a dead position the velocity is so short that it shows no direction on paper, and hardly one in numbers.
    """
    pair = next((pair for pair in moving.mechanism.pairs if {*pair.links} == {FRAME, load.link}), None)
    if pair is None:
        return None
    if isinstance(pair, Prismatic):
        return moving.bodies[load.link].direction
    span = moving.spans.get(load.link)
    if span and (span.start, span.end) == (pair.point, load.point):
        return span.n
    length, along = f"_l_of_{load.name}", f"_e_of_{load.name}"
    board.measure(length, pair.point, load.point)
    board.direction(along, pair.point, load.point, length)
    board.normal(f"_n_of_{load.name}", along)
    return f"_n_of_{load.name}"


def _couple(board: Board, moving: Moving, couple: Couple) -> None:
    """Lay down a moment: in its sense, or against the turning of its link."""
    size, omega = _size(board, moving.mechanism, couple), moving.bodies[couple.link].omega
    name = on_link(couple.name, couple.link)
    if couple.sense is not None or omega is None:
        board.calc(name, "signed", size, couple.sense or ZERO)
    else:
        board.calc(name, "resisting_moment", size, omega, moving.turning)


def _size(board: Board, mechanism: Mechanism, load: Load | Couple) -> str:
    """Return the name of a load's magnitude in this position."""
    diagrams = {diagram.name for diagram in mechanism.diagrams}
    size = f"_diagram_{load.magnitude}" if load.magnitude in diagrams else magnitude(load.magnitude)
    if load.stroke == BOTH:
        return size
    board.calc(f"_acting_{load.name}", "in_working" if load.stroke == WORKING else "in_idle", size, "_working")
    return f"_acting_{load.name}"


def _diagram(board: Board, mechanism: Mechanism, diagram: Diagram) -> None:
    """Read a load diagram in this position."""
    name, sizes = f"_diagram_{diagram.name}", mechanism.sizes  # whose name is that of a load's vector on the board
    values, back = ([magnitude(x) if x in sizes else x for x in of] for of in (diagram.values, diagram.back or ()))
    if diagram.over == ANGLE:  # behind its last place it runs on to the first one of the next turn
        board.calc(f"{name}_angle", "within_turn", mechanism.driver.coordinate, diagram.at[0])
        board.calc(f"{name}_next", "turn_later", diagram.at[0])
        board.calc(name, "piecewise", f"{name}_angle", *diagram.at, f"{name}_next", *values, values[0])
        return
    board.calc(f"{name}_forth" if back else name, "piecewise", PART, *diagram.at, *values)
    if back:
        board.calc(f"{name}_back", "piecewise", PART, *diagram.at, *back)
        board.calc(name, "by_stroke", "_working", f"{name}_forth", f"{name}_back")


def in_order(diagram: Diagram, values: Mapping[str, Any]) -> None:
    """Refuse, with an InputError, a diagram whose places decrease, or lie beyond the stroke or a turn."""
    places = [values.get(name, 0.0) for name in diagram.at]
    low, most = (0.0, 1.0) if diagram.over == STROKE else (places[0], TURN * (1.0 + ROUNDING))
    wrong = [a > b for a, b in pairwise(places)] + [places[0] < low, places[-1] - low > most]
    if any(bool(rows.any() if hasattr(rows, "any") else rows) for rows in wrong):
        raise InputError(f"diagram-{diagram.over}", name=diagram.name)


def with_sizes(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return `values` with the sizes of loads as the board calls them: `|F_3|`, for `F_3` is the vector there."""
    for diagram in mechanism.diagrams:
        in_order(diagram, values)
    return {**values, **{magnitude(name): values[name] for name in mechanism.sizes if name in values}}


def needs_stroke(mechanism: Mechanism) -> bool:
    """Whether a load acts in one stroke only, or reads its size over the stroke."""
    over_stroke = any(diagram.over == STROKE for diagram in mechanism.diagrams)
    return over_stroke or any(load.stroke != BOTH for load in mechanism.acting)


def _lay_stroke(board: Board, moving: Moving) -> None:
    """Find where the output stands between the ends of its working stroke, and which way it goes."""
    stroke, pair = moving.mechanism.stroke, output_pair(moving.mechanism)
    assert stroke is not None
    body = moving.bodies[stroke.link]
    if isinstance(pair, Prismatic):  # a slider: its travel from the point through which the guide passes
        board.place("_stroke_origin", *pair.through)
        board.calc("_stroke_travel", "along_axis", body.direction, "_stroke_origin", pair.point)
        board.calc(PART, "stroke_part", "_stroke_travel", BEGIN, END)
        board.calc(RATE, "component", body.direction, f"V_{pair.point}")
        board.calc(CHANGE, "component", body.direction, f"a_{pair.point}")
    else:  # a rocker: its angle, counted from the middle of its stroke, so that it may swing by almost a turn
        board.calc("_stroke_middle", "middle", BEGIN, END)
        board.turn("_stroke_axis", "_stroke_middle")
        board.angle("_stroke_swing", "_stroke_axis", body.direction)
        board.calc("_stroke_angle", "sum", "_stroke_middle", "_stroke_swing")
        board.calc(PART, "stroke_part", "_stroke_angle", BEGIN, END)
        board.calc(RATE, "same_turning", body.omega or ZERO)
        board.calc(CHANGE, "same_turning", body.epsilon or ZERO)
    for name in (RATE, CHANGE):
        board.calc(f"{name}_working", "signed", name, stroke.sense)
    reference = moving.speed if isinstance(pair, Prismatic) else moving.turning
    board.calc("_working", "working", f"{RATE}_working", reference, f"{CHANGE}_working")


def output_pair(mechanism: Mechanism) -> Revolute | Prismatic:
    """Return the pair of the output link with the frame.

    Raises InputError: when no output is named, or it is the driver, or has no such pair.
    """
    if mechanism.stroke is None:
        raise InputError("stroke-missing")
    link = mechanism.stroke.link
    found = [pair for pair in mechanism.pairs if {*pair.links} == {FRAME, link}]
    if not found or link == mechanism.driver.link:
        raise InputError("stroke-link", link=link)
    return found[0]
