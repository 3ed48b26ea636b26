"""The triad, a group of class III and third order: a central link that three legs join to the links before.

B, C, D are the joints of the central link, AB, EC, FD the legs; any of them may be a slider on a guide instead. The
lines of two legs meet in a special point X of the central link, which moves relative to A and to E as if it were the
end of both legs: so its velocity and acceleration come first, then those of D, then those of B and C by similarity. Any
two legs will do. Determinant of all its problems: that of the lines of the three legs, zero when they meet in one point
or are parallel.

The special point has the letter X with the number of the central link, X3, for S3 is a centre of mass.

Source: Artobolevsky, Theory of mechanisms and machines (groups of class III, special points of Assur).
"""

from __future__ import annotations

from collections.abc import Iterator

from ....scales.errors import InputError
from ...board import Board
from ...names import NORMAL, between, mark, vector
from ..guides import slide_of
from ..mechanism import Mechanism, Prismatic, Revolute
from ..parts import Bodies, Span, local_mark, measure_link, move_link, place_link
from ..structure import Group
from .forces import forces
from .legs import Hinged, Leg, Sliding
from .parts import Central, Triad, start_names

__all__ = ["acceleration", "dyad", "forces", "position", "velocity"]


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies) -> Triad:
    """Name the parts of a triad.

    Raises
    ------
    InputError
        When a leg slides on the central link, when the task does not say where that link starts, or names other links
        than two of the legs.
    """
    central = mechanism.link(group.central)
    if not all(isinstance(pair, Revolute) for pair in group.inner):
        raise InputError("triad-slide", links=_listed(group.links), link=central.number)
    start = mechanism.start(central.number)
    if start is None:
        raise InputError("start-missing", links=_listed(group.links), link=central.number)
    legs = [_leg(mechanism, group, i, bodies) for i in range(3)]
    first = legs[:2] if start.legs is None else [leg for number in start.legs for leg in legs if leg.number == number]
    if len({leg.number for leg in first}) != 2:
        raise InputError("start-legs", link=central.number, known=_listed(group.legs))
    third = next(leg for leg in legs if leg not in first)
    B, C = [leg.joint for leg in legs if leg != third]
    between = Central(central, B, C, third.joint)
    return Triad(mechanism, group.name, group.links, between, (first[0], first[1], third))


def _listed(numbers: tuple[int, ...]) -> str:
    return ", ".join(map(str, numbers))


def _leg(mechanism: Mechanism, group: Group, i: int, bodies: Bodies) -> Leg:
    number, joint, outer = group.legs[i], group.inner[i].point, group.outer[i]
    if isinstance(outer, Prismatic):
        return Sliding(mechanism, slide_of(mechanism, outer, number, joint, bodies))
    return Hinged(mechanism, Span(mechanism.link(number), outer.point, joint), group.before[i])


def position(board: Board, t: Triad) -> None:
    """B, C and D are where a template of the central link lies on the arcs, or the lines, of the three legs."""
    where: list[str] = [*start_names(t.number)]
    legs = sorted(t.legs, key=lambda leg: leg.number)
    for leg in legs:
        where += [local_mark(board, t.link, leg.joint), *leg.path(board)]
    for joint in t.joints:
        board.template(joint, local_mark(board, t.link, joint), *where)
    measure_link(board, t.central)
    place_link(board, t.central)
    for leg in legs:
        leg.place(board)


def velocity(board: Board, t: Triad) -> None:
    """Through a and e the normals to AB and EC: x. Through x the normal to XD, through f that to FD: d."""
    first, second, third = t.legs
    for leg in t.legs:
        leg.begin_velocity(board)
    _place_special_point(board, t)
    x, d = mark("velocity", t.X), mark("velocity", t.D)
    board.meet(x, first.start("velocity"), first.across, second.start("velocity"), second.across)
    for leg in (first, second):
        board.read(vector("V", *leg.about(t.X)), leg.start("velocity"), x)
    board.read(vector("V", t.X), "velocity.p", x)
    board.meet(d, x, between("n", t.X, t.D), third.start("velocity"), third.across)
    board.read(vector("V", t.D, t.X), x, d)
    board.read(vector("V", t.D), "velocity.p", d)
    board.calc(t.central.omega, "turning", vector("V", t.D, t.X), between("n", t.X, t.D), between("l", t.X, t.D))
    _by_similarity(board, t, "velocity", "V")
    for leg in t.legs:
        leg.finish_velocity(board)


def _place_special_point(board: Board, t: Triad) -> None:
    """Mark where the lines of two legs meet, and how the joints of the central link lie to it and to D."""
    first, second, _ = t.legs
    board.meet(t.X, first.end, first.line, second.end, second.line)
    board.measure(between("l", t.X, t.D), t.X, t.D)
    board.direction(between("e", t.X, t.D), t.X, t.D, between("l", t.X, t.D))
    board.normal(between("n", t.X, t.D), between("e", t.X, t.D))
    for joint, along, across in _figure(t):
        board.calc(along, "part_along", t.X, t.D, joint)
        board.calc(across, "part_across", t.X, t.D, joint)


def _figure(t: Triad) -> Iterator[tuple[str, str, str]]:
    """Go through the other two joints: letter, and names of their parts along and across XD."""
    for leg in t.legs[:2]:
        yield leg.joint, f"_along_{leg.joint}_{t.XD}", f"_across_{leg.joint}_{t.XD}"


def _by_similarity(board: Board, t: Triad, plan: str, symbol: str) -> None:
    """Mark the other joints of the central link, then its other points."""
    for joint, along, across in _figure(t):
        board.similar(f"{plan}.{joint}", f"{plan}.{t.X}", f"{plan}.{t.D}", along, across)
        board.read(vector(symbol, joint), f"{plan}.p", f"{plan}.{joint}")
    move_link(board, t.mechanism, t.central, plan)


def acceleration(board: Board, t: Triad) -> None:
    """From a' the normal parts of B about A and of X about B, from e' likewise; the normals to AB and EC give x'.

    From x' the normal part of D about X, from f' that of D about F; the normals to XD and FD give d'.
    """
    first, second, third = t.legs
    ends = [leg.begin_acceleration(board) for leg in t.legs]
    hung = [_towards_joint(board, t, leg, end) for leg, end in zip((first, second), ends, strict=False)]
    x, d, n = mark("acceleration", t.X), mark("acceleration", t.D), mark("acceleration", t.D, NORMAL, t.X)
    board.meet(x, hung[0], first.across, hung[1], second.across)
    board.read(vector("a", t.X), "acceleration.p", x)
    part = vector("a", t.D, t.X, "n")
    board.calc(part.size, "normal_part", vector("V", t.D, t.X), between("l", t.X, t.D))
    board.back(n, x, between("e", t.X, t.D), part.size)
    board.read(part, x, n)
    board.meet(d, n, between("n", t.X, t.D), ends[2], third.across)
    board.read(vector("a", t.D, t.X, "t"), n, d)
    board.read(vector("a", t.D, t.X), x, d)
    board.read(vector("a", t.D), "acceleration.p", d)
    board.calc(t.central.epsilon, "turning", vector("a", t.D, t.X, "t"), between("n", t.X, t.D), between("l", t.X, t.D))
    _by_similarity(board, t, "acceleration", "a")
    for leg, end in zip(t.legs, ends, strict=True):
        leg.finish_acceleration(board, end)


def _towards_joint(board: Board, t: Triad, leg: Leg, end: str) -> str:
    """Hang on `end` the normal part of X about the joint of a leg: it lies along the leg's line, as that of the joint.

    It follows from omega of the central link, so that X may stand in the joint itself.
    """
    part, tip = vector("a", t.X, leg.joint, "n"), mark("acceleration", t.X, NORMAL, leg.joint)
    arm = f"_r_{t.X}{leg.joint}"
    board.read(arm, leg.joint, t.X)
    board.calc(part, "transport_normal", t.central.omega, arm)
    board.chain(tip, end, part)
    return tip
