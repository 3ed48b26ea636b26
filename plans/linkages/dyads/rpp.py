"""The dyad of the fifth kind, RPP: a hinged slider and a slide that both translate on one another, as in a sine drive.

A is the outer revolute pair, on link 2; link 3 slides on link 2 along u23 and on the link before it along u34. All
three turn alike. Letters with the number of a link, A3, are its points that now lie under A. Determinant of all its
problems: the sine of the angle between the guides.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ....scales.errors import InputError
from ...board import Board
from ...names import Name, mark, spelled, vector
from ..guides import (
    Slide,
    coriolis,
    lay_guide,
    pin_offset,
    place_slide,
    running_line,
    slide_of,
    under_acceleration,
    under_velocity,
)
from ..mechanism import ZERO, Mechanism, Prismatic
from ..parts import (
    Bodies,
    Body,
    Couples,
    Forces,
    Passed,
    Span,
    answer,
    carry,
    hang,
    moments_about,
    move_points,
    normal_of,
    passed_on,
    turn_with,
)
from ..structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one RPP dyad use: `inner` of link 2 on 3, `outer` of link 3 on the last."""

    mechanism: Mechanism
    name: str
    A: str
    Q: str  # a lettered point of link 3
    before: int  # the link that carries A
    inner: Slide
    outer: Slide

    @property
    def under(self) -> Name:
        """Letter of link 3's point under A."""
        return self.inner.under

    @property
    def beneath(self) -> Slide:
        """The outer pair as if A3 ran in it, for the last link's point under A."""
        return replace(self.outer, pin=self.A)

    @property
    def spans(self) -> tuple[Span, ...]:
        """No link has two joints."""
        return ()

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The links for those attached to them."""
        return self.inner.body, self.outer.body

    def passed(self) -> tuple[Passed, Passed]:
        """Reactions on the links before; that on the last is moved to A, with a couple."""
        j, k, m = self.inner.link.number, self.outer.link.number, self.outer.other
        first = passed_on(self.mechanism, j, self.before, self.A)
        return first, passed_on(self.mechanism, k, m, self.A, slides=True)


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies) -> Dyad:
    """Name the parts of an RPP group.

    Raises
    ------
    InputError
        When the frame is said to be a slider, or link 3 slides in both pairs: its x axis cannot point along both.
    """
    first, second = group.links
    pin, last = group.outer
    between = group.inner[0]
    assert isinstance(last, Prismatic)
    assert isinstance(between, Prismatic)
    if between.links[0] == last.links[0] == second:
        raise InputError("slider-twice", link=second)
    Q = last.point if last.links[0] == second else next(iter(mechanism.link(second).points))
    outer = slide_of(mechanism, last, second, Q, bodies)
    inner = slide_of(mechanism, between, first, pin.point, {second: outer.body})
    return Dyad(mechanism, group.name, pin.point, Q, group.before[0], inner, outer)


def position(board: Board, d: Dyad) -> None:
    """Q of link 3 is where its path on the last link meets the parallel to u23 at its distance from A."""
    path = running_line(board, d.outer)
    lay_guide(board, d.inner)
    start = _beside(board, d)
    board.meet(d.Q, start, d.inner.u, path, d.outer.u)
    place_slide(board, d.outer)
    place_slide(board, d.inner)


def _beside(board: Board, d: Dyad) -> str:
    """Mark a point as far from A across u23 as Q is."""
    pair, (first, second) = d.inner.pair, (d.inner.link, d.outer.link)
    if d.inner.carries:
        shift, lay = pin_offset(board, pair, second, d.Q, first, d.A), board.lay
    else:
        shift, lay = pin_offset(board, pair, first, d.A, second, d.Q), board.back
    if shift == ZERO:
        return d.A
    lay(f"_{d.inner.u}_{d.Q}", d.A, normal_of(d.inner.u), shift)
    return f"_{d.inner.u}_{d.Q}"


def velocity(board: Board, d: Dyad) -> None:
    """Through a2 the parallel to u23, through a4 (p when the guide stands) the parallel to u34: a3."""
    a2, a3, beneath = d.mechanism.mark("velocity", d.A), mark("velocity", d.under), d.beneath
    under_velocity(board, d.mechanism, beneath)
    board.meet(a3, a2, d.inner.u, beneath.mark("velocity"), d.outer.u)
    board.read(vector("V", d.under, d.inner.own), a2, a3)
    if beneath.known is not None:
        board.read(vector("V", d.under, beneath.under), beneath.mark("velocity"), a3)
    board.read(vector("V", d.under), "velocity.p", a3)
    _others(board, d, "velocity")


def acceleration(board: Board, d: Dyad) -> None:
    """From a2' and a4' the accelerations of Coriolis, through their ends the parallels to the guides: a3'."""
    a2, a3, beneath = d.mechanism.mark("acceleration", d.A), mark("acceleration", d.under), d.beneath
    omega = d.outer.body.omega
    ends = (
        coriolis(board, omega, d.under, d.inner.own, a2) if omega else a2,
        under_acceleration(board, d.mechanism, beneath),
    )
    board.meet(a3, ends[0], d.inner.u, ends[1], d.outer.u)
    board.read(vector("a", d.under, d.inner.own, "r"), ends[0], a3)
    if beneath.known is not None:
        board.read(vector("a", d.under, beneath.under, "r"), ends[1], a3)
    board.read(vector("a", d.under), "acceleration.p", a3)
    _others(board, d, "acceleration")


def _others(board: Board, d: Dyad, plan: str) -> None:
    """Both links turn like the last one; the points of link 3 turn about A3, then about Q, those of link 2 about A."""
    second, first = d.outer.body, d.inner.body
    if d.outer.known is not None:
        turn_with(board, second, d.outer.known, plan)
        turn_with(board, first, second, plan)
    carry(board, d.mechanism, replace(second, pin=d.under), plan, d.Q, d.Q, d.A)
    move_points(board, d.mechanism, second, plan, (d.Q,))
    move_points(board, d.mechanism, first, plan, (d.A,))


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plans of link 3 and of link 2.

    The loads of link 3, through their ends the normals to both guides; the loads of link 2 with the inner reaction.
    Moments about A give the arms of the reactions of the guides, of link 2 first.
    """
    i, j, k, m = d.before, d.inner.link.number, d.outer.link.number, d.outer.other
    plan, own, pair = spelled("forces", k), spelled("forces", j), d.mechanism.pair
    board.pole(f"{plan}.0")
    last, closing = hang(board, plan, [force for force, _ in loads[k]]), f"{plan}.{len(loads[k]) + 1}"
    board.meet(closing, last, normal_of(d.outer.u), f"{plan}.0", normal_of(d.inner.u))
    board.read(pair("R", j, k), closing, f"{plan}.0")
    board.read(pair("R", m, k), last, closing)
    answer(board, d.mechanism, "R", (j, k))

    board.pole(f"{own}.0")
    board.read(pair("R", i, j), hang(board, own, [pair("R", k, j), *(force for force, _ in loads[j])]), f"{own}.0")
    answer(board, d.mechanism, "R", (i, j), (m, k))

    board.calc(pair("M", k, j), "closing_moment", ZERO, *moments_about(board, loads[j], d.A), *couples[j])
    answer(board, d.mechanism, "M", (k, j))
    moments = moments_about(board, loads[k], d.A)
    board.calc(pair("M", m, k), "closing_moment", pair("M", j, k), *moments, *couples[k])
    answer(board, d.mechanism, "M", (m, k))
    board.step("arm", pair("h", k, j), pair("M", k, j), pair("R", k, j))
    board.step("arm", pair("h", m, k), pair("M", m, k), pair("R", m, k))
