"""Parts that all constructions share: how a link lies and moves, and where its points are on every plan.

A link with two joints carries its points by similarity; a link with one joint and a sliding pair by rotation about that
joint. Points that stand on one axis with both joints, the first at its origin, need neither: its segment is divided.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from ..board import Board
from ..names import NORMAL, Name, arm, between, mark, moment, rate, role, spelled, vector
from .mechanism import FRAME, ZERO, Link, Mechanism, positive

SYMBOLS = {"velocity": "V", "acceleration": "a"}
Forces = dict[int, dict[str, str]]  # by link its forces, each with the point at which it acts
Couples = dict[int, list[str]]


class Plan:
    """A plan of velocities or accelerations that is being drawn: its board, its name, the symbol of its vectors."""

    def __init__(self, board: Board, mechanism: Mechanism, name: str) -> None:
        self.board, self.mechanism, self.name, self.symbol = board, mechanism, name, SYMBOLS[name]

    def mark(self, point: str) -> str:
        """Return the mark of a point; points of the frame are at the pole."""
        return self.mechanism.mark(self.name, point)

    def read(self, point: str) -> None:
        """Read the absolute motion of a point that is marked."""
        self.board.read(vector(self.symbol, point), f"{self.name}.p", f"{self.name}.{point}")


@dataclass(frozen=True, slots=True)
class Body:
    """How a moving link is known to the links that are attached to it.

    `pin` is one of its points with marks on all plans; `direction` a unit direction that turns with it, `local` the
    same direction in the link's own coordinates, or None where that is the x axis from `pin` at the origin; `omega` and
    `epsilon` are None where they are zero by the form of the mechanism.
    """

    link: Link
    pin: str
    direction: str
    local: str | None
    omega: str | None
    epsilon: str | None

    def turn_with(self, plan: Plan, other: Body) -> None:
        """Note that the link turns like the one on which it slides."""
        own, known = (self.omega, other.omega) if plan.symbol == "V" else (self.epsilon, other.epsilon)
        if own and known:
            plan.board.calc(own, "same_turning", known)

    def settle(self, board: Board, direction: str = ZERO) -> None:
        """Lay down the link's own direction on a drawing of the link: at the angle `direction` to its x axis."""
        if self.local:
            board.turn(self.local, direction)
            local_mark(board, self.link, self.pin)

    def coordinates(self, board: Board, key: str, x: str, y: str) -> tuple[str, str]:
        """Return the names of a place on the link along and across its direction, counted from its pin."""
        if self.local is None:
            return x, y
        number = self.link.number
        board.place(f"_{number}_{key}", x, y)
        along, across = f"_{number}_{key}_along", f"_{number}_{key}_across"
        board.calc(along, "along_axis", self.local, f"_{number}_{self.pin}", f"_{number}_{key}")
        board.calc(across, "across_axis", self.local, f"_{number}_{self.pin}", f"_{number}_{key}")
        return along, across

    def place_points(self, board: Board) -> None:
        """Mark the other points of a link with one joint, its pin."""
        for point, place in self.link.points.items():
            if point != self.pin:
                lay_off(board, point, self.pin, self.direction, *self.coordinates(board, point, *place))

    def move_points(self, plan: Plan) -> None:
        """Mark the other points of a link with one joint on a plan."""
        for point in self.link.points:
            if point != self.pin:
                self.carry(plan, point, point)

    def carry(self, plan: Plan, letter: str, at: str, pin_at: str | None = None) -> None:
        """Mark on a plan the point `letter` of a link that now stands at the mark `at`: it turns about the link's pin.

        `pin_at` is the mark at which the pin stands if it has another letter.
        """
        board, tip, start = plan.board, mark(plan.name, letter), plan.mark(self.pin)
        if self.omega is None:
            board.same(tip, start)
        else:
            radius = f"_r_{letter}_{self.pin}"
            if plan.symbol == "V":
                board.read(radius, pin_at or self.pin, at)
                parts = [("transport_speed", self.omega, vector("V", letter, self.pin), tip)]
            else:
                normal = tip if self.epsilon is None else mark(plan.name, letter, NORMAL, self.pin)
                parts = [("transport_normal", self.omega, vector("a", letter, self.pin, "n"), normal)]
                if self.epsilon is not None:
                    parts.append(("transport_tangential", self.epsilon, vector("a", letter, self.pin, "t"), tip))
            for law, turning, part, end in parts:
                board.calc(part, law, turning, radius)
                board.chain(end, start, part)
                start = end
        plan.read(letter)


Bodies = Mapping[int, Body]


class Passed(NamedTuple):
    """A reaction handed on to the link before: force, link, point where it acts, and a couple beside it."""

    force: str
    link: int
    point: str
    couple: str | None = None


class Span:
    """A link between two of its joints, `start` and `end`, with the names that all plans use."""

    def __init__(self, link: Link, start: str, end: str) -> None:
        self.link, self.start, self.end, self.number = link, start, end, link.number
        self.e, self.n = between("e", start, end), between("n", start, end)  # direction from start to end, normal to it
        self.omega, self.epsilon = rate("omega", link.number), rate("epsilon", link.number)
        self.others = tuple(point for point in link.points if point not in (start, end))
        # the distance of the joints is given where `end` stands on the x axis from `start`, else it is measured
        origin, (x, y) = link.points[start], link.points[end]
        self.measured = origin != (ZERO, ZERO) or y != ZERO or x != positive(x)
        # points that stand in line with both joints, on the x axis with `start` at the origin
        on_axis = not self.measured and x != ZERO
        self.in_line = frozenset(point for point in self.others if on_axis and link.points[point][1] == ZERO)
        length, taken = between("l", start, end), {positive(xy) for place in link.points.values() for xy in place}
        # a hidden name where a coordinate has taken that name
        self.length: str = x if not self.measured else length.size if length in taken else length
        local = f"_g_{self.number}" if self.measured else None
        self.body = Body(link, start, self.e, local, self.omega, self.epsilon)  # for those attached to it

    def _on_drawing(self, board: Board) -> tuple[str, str]:
        """Mark both joints on a drawing of the link alone."""
        return local_mark(board, self.link, self.start), local_mark(board, self.link, self.end)

    def measure(self, board: Board) -> None:
        """Measure a link on a drawing of its own, where its length is not given."""
        if self.measured:
            start, end = self._on_drawing(board)
            board.measure(self.length, start, end)
            board.direction(f"_g_{self.number}", start, end, self.length)

    def place(self, board: Board, turned: bool = False) -> None:
        """Mark the direction of a link between its joints, which are placed, and its other points.

        Its direction is there already when it was `turned` to it.
        """
        if not turned:
            board.direction(self.e, self.start, self.end, self.length)
        board.normal(self.n, self.e)
        aside = [point for point in self.others if point not in self.in_line]
        if aside:
            start, end = self._on_drawing(board)
            for point in aside:
                local = local_mark(board, self.link, point)
                board.calc(f"_along_{point}", "part_along", start, end, local)
                board.calc(f"_across_{point}", "part_across", start, end, local)
        for point in self.others:
            self._third(board, point, point, self.start, self.end)

    def mark_others(self, plan: Plan) -> None:
        """Mark the other points of a link on a plan: its figure there is similar to the link."""
        start, end = plan.mark(self.start), plan.mark(self.end)
        for point in self.others:
            self._third(plan.board, point, f"{plan.name}.{point}", start, end)
            plan.read(point)

    def _third(self, board: Board, point: str, mark: str, start: str, end: str) -> None:
        if point in self.in_line:
            board.divide(mark, start, end, self.link.points[point][0], self.length)
        else:
            board.similar(mark, start, end, f"_along_{point}", f"_across_{point}")


def normal_of(direction: str) -> Name:
    """Return the name of the normal to a direction: n_AB to e_AB, n_u_30 to u_30."""
    along = role(direction)
    return spelled("n", along.of, along.about) if along.kind == "e" else spelled("n", along, links=along.links)


def local_mark(board: Board, link: Link, point: str) -> str:
    """Mark a point on a drawing of the link alone."""
    name = f"_{link.number}_{point}"
    board.place(name, *link.points[point])
    return name


def lay_off(board: Board, name: str, start: str, direction: str, along: str, across: str) -> None:
    """Mark the point at `along` and `across` from `start`."""
    if (along, across) == (ZERO, ZERO):
        board.same(name, start)
        return
    if along != ZERO:
        foot = name if across == ZERO else f"_{role(name).shown}_along"
        board.lay(foot, start, direction, along)
        start = foot
    if across != ZERO:
        board.lay(name, start, normal_of(direction), across)


def moments_about(
    board: Board, loads: Mapping[str, str], about: str, beside: str = "", always: bool = False
) -> list[Name]:
    """Take the moments of the loads on a link about a point; those that stand there have none, `always` names them too.

    The arms are called by their forces, and by the point `beside` where that is said.
    """
    moments = []
    for force, at in loads.items():
        if at != about or always:
            moments.append(moment(force, about))
            board.moment(moments[-1], arm(force, beside), force, at, about)
    return moments


def answer(board: Board, mechanism: Mechanism, symbol: str, *on_by: tuple[int, int]) -> None:
    """Note that a link answers another with the opposite force or moment; what acts on the frame needs no name."""
    for on, by in on_by:
        if on != FRAME:
            board.calc(mechanism.pair(symbol, by, on), "opposite", mechanism.pair(symbol, on, by))


class Polygon:
    """A plan of forces, which hang on one another from mark 0 on; its marks go by their numbers."""

    def __init__(self, board: Board, of: str | int) -> None:
        self.board, self.name, self.last = board, spelled("forces", of), 0
        board.pole(f"{self.name}.0")

    def hang(self, *forces: str) -> int:
        """Hang forces on the last mark, tip to tail; return the mark at the end."""
        for force in forces:
            self.board.chain(f"{self.name}.{self.last + 1}", f"{self.name}.{self.last}", force)
            self.last += 1
        return self.last

    def lay(self, part: Name, along: str, sense: int = 1) -> int:
        """Lay off a part of a reaction, of known size, along a direction or (-1) against it; return the mark made."""
        lay, start = self.board.lay if sense > 0 else self.board.back, self.last
        self.last += 1
        lay(f"{self.name}.{self.last}", f"{self.name}.{start}", along, part.size)
        self.read(part, start, self.last)
        return self.last

    def close(self, along: str, other: str) -> int:
        """Mark where the line through the last mark meets the other one, through mark 0."""
        self.board.meet(f"{self.name}.{self.last + 1}", f"{self.name}.{self.last}", along, f"{self.name}.0", other)
        self.last += 1
        return self.last

    def read(self, force: str, tail: int, tip: int) -> None:
        """Read a force from one mark to another."""
        self.board.read(force, f"{self.name}.{tail}", f"{self.name}.{tip}")
