"""The dyad of the second kind, RRP: a connecting rod 2 and a slider 3 on a fixed guide.

A is the outer revolute pair, B the inner one; u is the guide's direction. Determinant of all its problems: the sine of
the angle between the normal to AB and u, zero when AB is normal to the guide.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 2).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...scales.errors import InputError
from ..board import Board
from .mechanism import FRAME, ZERO, Link, Mechanism, Prismatic
from .structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one RRP dyad use."""

    mechanism: Mechanism
    rod: Link
    slider: Link
    guide: Prismatic
    A: str
    B: str
    before: int  # the link that carries A

    @property
    def AB(self) -> str:
        """The rod by its ends."""
        return self.A + self.B

    @property
    def length(self) -> str:
        """Name of the rod's length."""
        return self.rod.points[self.B][0]

    @property
    def u(self) -> str:
        """Name of the guide's direction."""
        return f"u_{self.slider.number}{self.guide.links[1]}"

    @property
    def name(self) -> str:
        """The group's links as a word."""
        return f"{self.rod.number}{self.slider.number}"


def dyad(mechanism: Mechanism, group: Group) -> Dyad:
    """Name the parts of an RRP group.

    Raises
    ------
    InputError
        When the guide moves, or a point of the rod lies off the line AB: no construction for these yet.
    """
    first, second = group.links
    pin, guide = group.outer
    assert isinstance(guide, Prismatic)
    rod, slider = mechanism.link(first), mechanism.link(second)
    A, B = pin.point, group.inner[0].point
    if guide.links != (second, FRAME) or guide.point != B:
        raise InputError("moving-guide", links=f"{first}, {second}")
    if slider.points[B] != (ZERO, ZERO):
        raise InputError("bent-link", link=second)
    if rod.points[A] != (ZERO, ZERO) or any(y != ZERO for _, y in rod.points.values()):
        raise InputError("bent-link", link=first)
    before = next(number for number in pin.links if number != first)
    return Dyad(mechanism, rod, slider, guide, A, B, before)


def position(board: Board, d: Dyad) -> None:
    """B is where the arc of radius AB about A crosses the line along which B runs."""
    origin = f"_{d.u}_origin"
    board.place(origin, *d.guide.through)
    board.turn(d.u, d.guide.direction)
    board.normal(f"n_{d.u}", d.u)
    if d.guide.offset != ZERO:
        board.lay(f"{origin}_{d.B}", origin, f"n_{d.u}", d.guide.offset)
        origin = f"{origin}_{d.B}"
    board.arc(d.B, d.A, d.length, origin, d.u, d.guide.branch or "one")
    board.direction(f"e_{d.AB}", d.A, d.B, d.length)
    board.normal(f"n_{d.AB}", f"e_{d.AB}")
    for point, (x, _) in d.rod.points.items():
        if point not in (d.A, d.B):
            board.divide(point, d.A, d.B, x, d.length)
    for point in _slider_points(d):
        x, y = d.slider.points[point]
        along = point if y == ZERO else f"_{point}_along"
        board.lay(along, d.B, d.u, x)
        if y != ZERO:
            board.lay(point, along, f"n_{d.u}", y)


def velocity(board: Board, d: Dyad) -> None:
    """Through a the normal to AB, through p the parallel to the guide: b. Other points of the rod by similarity."""
    a, b = f"velocity.{d.A}", f"velocity.{d.B}"
    board.meet(b, a, f"n_{d.AB}", "velocity.p", d.u)
    board.read(f"V_{d.B}{d.A}", a, b)
    board.read(f"V_{d.B}", "velocity.p", b)
    _similar(board, d, "velocity", "V")
    board.calc(f"omega_{d.rod.number}", "turning", f"V_{d.B}{d.A}", f"n_{d.AB}", d.length)


def acceleration(board: Board, d: Dyad) -> None:
    """From a' the normal part towards A, through its end the normal to AB, through the pole the parallel to u: b'."""
    a, b, n = (f"acceleration.{letter}" for letter in (d.A, d.B, f"n_{d.B}{d.A}"))
    part = f"a_{d.B}{d.A}_n"
    board.calc(f"_{part}", "normal_part", f"V_{d.B}{d.A}", d.length)
    board.back(n, a, f"e_{d.AB}", f"_{part}")
    board.read(part, a, n)
    board.meet(b, n, f"n_{d.AB}", "acceleration.p", d.u)
    board.read(f"a_{d.B}{d.A}_t", n, b)
    board.read(f"a_{d.B}{d.A}", a, b)
    board.read(f"a_{d.B}", "acceleration.p", b)
    _similar(board, d, "acceleration", "a")
    board.calc(f"epsilon_{d.rod.number}", "turning", f"a_{d.B}{d.A}_t", f"n_{d.AB}", d.length)


def _similar(board: Board, d: Dyad, plan: str, symbol: str) -> None:
    for point, (x, _) in d.rod.points.items():
        if point not in (d.A, d.B):
            board.divide(f"{plan}.{point}", f"{plan}.{d.A}", f"{plan}.{d.B}", x, d.length)
            board.read(f"{symbol}_{point}", f"{plan}.p", f"{plan}.{point}")
    for point in _slider_points(d):
        board.same(f"{plan}.{point}", f"{plan}.{d.B}")
        board.read(f"{symbol}_{point}", f"{plan}.p", f"{plan}.{point}")


def _slider_points(d: Dyad) -> list[str]:
    """Return the slider's points beside B; it does not turn, so all move like B."""
    return [point for point in d.slider.points if point != d.B]


def forces(board: Board, d: Dyad, loads: dict[int, list[tuple[str, str]]], couples: dict[int, list[str]]) -> None:
    """Force plans of the group and of the rod; `loads` are (force, point) and `couples` moments, by link.

    R_12^t from the moments of the rod about B; the chain R_12^t, loads of the slider, loads of the rod; through its
    beginning the parallel to AB, through its end the normal to the guide.
    """
    i, j, k = d.before, d.rod.number, d.slider.number
    moments = []
    for force, at in loads[j]:
        if at != d.B:
            arm = f"h_{j}" if force == f"F_i{j}" else f"h_{force.removeprefix('R_')}"
            board.moment(f"_M_{force}_{d.B}", arm, force, at, d.B)
            moments.append(f"_M_{force}_{d.B}")
    # R^t stands at A on the arm l_AB and turns about B against the sense in which it points along the normal
    board.calc(f"_R_{i}{j}_t", "moment_equation", d.length, *moments, *couples[j])

    plan = f"forces_{d.name}"
    hung = [force for force, _ in (*loads[k], *loads[j])]
    board.pole(f"{plan}.0")
    board.lay(f"{plan}.1", f"{plan}.0", f"n_{d.AB}", f"_R_{i}{j}_t")
    board.read(f"R_{i}{j}_t", f"{plan}.0", f"{plan}.1")
    for number, force in enumerate(hung, start=1):
        board.chain(f"{plan}.{number + 1}", f"{plan}.{number}", force)
    last, closing = f"{plan}.{len(hung) + 1}", f"{plan}.{len(hung) + 2}"
    board.meet(closing, last, f"n_{d.u}", f"{plan}.0", f"e_{d.AB}")
    board.read(f"R_0{k}", last, closing)
    board.read(f"R_{i}{j}_n", closing, f"{plan}.0")
    board.read(f"R_{i}{j}", closing, f"{plan}.1")

    own = f"forces_{j}"
    board.pole(f"{own}.0")
    board.chain(f"{own}.1", f"{own}.0", f"R_{i}{j}")
    for number, (force, _) in enumerate(loads[j], start=1):
        board.chain(f"{own}.{number + 1}", f"{own}.{number}", force)
    board.read(f"R_{k}{j}", f"{own}.{len(loads[j]) + 1}", f"{own}.0")
    board.calc(f"R_{j}{i}", "opposite", f"R_{i}{j}")
    board.calc(f"R_{j}{k}", "opposite", f"R_{k}{j}")

    moments = [ZERO, *couples[k]]
    for force, at in loads[k]:
        if at != d.B:
            arm = f"h_{k}" if force == f"F_i{k}" else f"h_{force}"
            board.moment(f"_M_{force}_{d.B}", arm, force, at, d.B)
            moments.append(f"_M_{force}_{d.B}")
    # the guide's reaction stands where it balances the moments of the slider's loads about B
    board.calc(f"_M_{k}", "sum", *moments)
    board.step("arm", f"h_0{k}", f"_M_{k}", f"R_0{k}")
