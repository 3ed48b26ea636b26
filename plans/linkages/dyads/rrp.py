"""The dyad of the second kind, RRP: a connecting rod 2 and a slider 3 on a guide, which stands or moves.

A is the outer revolute pair, B the inner one; u is the guide's direction. Determinant of all its problems: the sine of
the angle between the normal to AB and u, zero when AB is normal to the guide.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 2).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...board import Board
from ...names import NORMAL, mark, spelled, vector
from ..guides import Slide, place_slide, running_line, slide_of, under_acceleration, under_velocity
from ..mechanism import ZERO, Link, Mechanism, Prismatic
from ..parts import (
    Bodies,
    Body,
    Couples,
    Forces,
    Passed,
    Span,
    answer,
    hang,
    measure_link,
    moments_about,
    move_link,
    move_points,
    normal_of,
    passed_on,
    place_link,
    turn_with,
)
from ..structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one RRP dyad use; the slider may carry the guide itself."""

    mechanism: Mechanism
    name: str
    rod: Link
    slider: Link
    guide: Prismatic
    A: str
    B: str
    before: int  # the link that carries A
    slide: Slide

    @property
    def span(self) -> Span:
        """The rod between its pairs."""
        return Span(self.rod, self.A, self.B)

    @property
    def length(self) -> str:
        """Name of the rod's length."""
        return self.span.length

    @property
    def u(self) -> str:
        """Name of the guide's direction."""
        return self.slide.u

    @property
    def spans(self) -> tuple[Span, ...]:
        """Its links with two joints."""
        return (self.span,)

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The links for those attached to them."""
        return self.span.body(self.span.omega, self.span.epsilon), self.slide.body

    def passed(self) -> tuple[Passed, Passed]:
        """Reactions on the links before; that on the guide is moved to B, with a couple."""
        k, m = self.slider.number, self.slide.other
        first = passed_on(self.mechanism, self.rod.number, self.before, self.A)
        return first, passed_on(self.mechanism, k, m, self.B, slides=True)


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies | None = None) -> Dyad:
    """Name the parts of an RRP group; `bodies` are the links before it, wanted when the guide moves.

    Raises
    ------
    InputError
        When the frame is said to be the slider.
    """
    first, second = group.links
    pin, guide = group.outer
    assert isinstance(guide, Prismatic)
    A, B = pin.point, group.inner[0].point
    rod, slider = mechanism.link(first), mechanism.link(second)
    on_guide = slide_of(mechanism, guide, second, B, bodies or {})
    return Dyad(mechanism, group.name, rod, slider, guide, A, B, group.before[0], on_guide)


def position(board: Board, d: Dyad) -> None:
    """B is where the arc of radius AB about A crosses the line along which B runs."""
    start = running_line(board, d.slide)
    measure_link(board, d.span)
    board.arc(d.B, d.A, d.length, start, d.u, d.guide.branch or "one")
    place_link(board, d.span)
    place_slide(board, d.slide)


def velocity(board: Board, d: Dyad) -> None:
    """Through a the normal to AB, through b4 (p when the guide stands) the parallel to the guide: b."""
    a, b = d.mechanism.mark("velocity", d.A), f"velocity.{d.B}"
    under_velocity(board, d.mechanism, d.slide)
    board.meet(b, a, d.span.n, d.slide.mark("velocity"), d.u)
    board.read(vector("V", d.B, d.A), a, b)
    if d.slide.known is not None:
        board.read(vector("V", d.slide.own, d.slide.under), d.slide.mark("velocity"), b)
    board.read(vector("V", d.B), "velocity.p", b)
    _others(board, d, "velocity")
    board.calc(d.span.omega, "turning", vector("V", d.B, d.A), d.span.n, d.length)


def acceleration(board: Board, d: Dyad) -> None:
    """From a' the normal part towards A, through its end the normal to AB; the parallel to the guide gives b'.

    It runs through the pole when the guide stands, otherwise through the end of the acceleration of Coriolis.
    """
    a, b, n = d.mechanism.mark("acceleration", d.A), f"acceleration.{d.B}", mark("acceleration", d.B, NORMAL, d.A)
    part = vector("a", d.B, d.A, "n")
    board.calc(part.size, "normal_part", vector("V", d.B, d.A), d.length)
    board.back(n, a, d.span.e, part.size)
    board.read(part, a, n)
    k = under_acceleration(board, d.mechanism, d.slide)
    board.meet(b, n, d.span.n, k, d.u)
    board.read(vector("a", d.B, d.A, "t"), n, b)
    board.read(vector("a", d.B, d.A), a, b)
    if d.slide.known is not None:
        board.read(vector("a", d.slide.own, d.slide.under, "r"), k, b)
    board.read(vector("a", d.B), "acceleration.p", b)
    _others(board, d, "acceleration")
    board.calc(d.span.epsilon, "turning", vector("a", d.B, d.A, "t"), d.span.n, d.length)


def _others(board: Board, d: Dyad, plan: str) -> None:
    """Mark the other points of both links; the slider turns like the guide."""
    move_link(board, d.mechanism, d.span, plan)
    if d.slide.known is not None:
        turn_with(board, d.slide.body, d.slide.known, plan)
    move_points(board, d.mechanism, d.slide.body, plan, (d.B,))


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plans of the group and of the rod; `loads` are (force, point) and `couples` moments, by link.

    R_12^t from the moments of the rod about B; the chain R_12^t, loads of the slider, loads of the rod; through its
    beginning the parallel to AB, through its end the normal to the guide.
    """
    i, j, k, m = d.before, d.rod.number, d.slider.number, d.slide.other
    pair = d.mechanism.pair
    moments = moments_about(board, loads[j], d.B)
    # R^t stands at A on the arm l_AB and turns about B against the sense in which it points along the normal
    board.calc(pair("R", i, j, "t").size, "moment_equation", d.length, *moments, *couples[j])

    plan = spelled("forces", d.name)
    hung = [force for force, _ in (*loads[k], *loads[j])]
    board.pole(f"{plan}.0")
    board.lay(f"{plan}.1", f"{plan}.0", d.span.n, pair("R", i, j, "t").size)
    board.read(pair("R", i, j, "t"), f"{plan}.0", f"{plan}.1")
    last, closing = hang(board, plan, hung, 1), f"{plan}.{len(hung) + 2}"
    board.meet(closing, last, normal_of(d.u), f"{plan}.0", d.span.e)
    board.read(pair("R", m, k), last, closing)
    board.read(pair("R", i, j, "n"), closing, f"{plan}.0")
    board.read(pair("R", i, j), closing, f"{plan}.1")

    own = spelled("forces", j)
    board.pole(f"{own}.0")
    board.chain(f"{own}.1", f"{own}.0", pair("R", i, j))
    board.read(pair("R", k, j), hang(board, own, [force for force, _ in loads[j]], 1), f"{own}.0")
    answer(board, d.mechanism, "R", (i, j), (k, j), (m, k))

    # the guide's reaction stands where it balances the moments of the slider's loads about B
    own_moment = spelled("M", k, links=(k,)).size
    board.calc(own_moment, "sum", ZERO, *moments_about(board, loads[k], d.B), *couples[k])
    board.calc(pair("M", m, k), "opposite", own_moment)
    board.step("arm", pair("h", m, k), pair("M", m, k), pair("R", m, k))
    answer(board, d.mechanism, "M", (m, k))
