"""The dyad of the third kind, RPR: a slider on a rocking guide, such as a stone in a slotted lever.

A is the pin of the slider, C that of the guide link, both outer pairs; u is the guide's direction. Letters with the
number of a link, A3, are its points that now lie under A. Determinant of all its problems: the cosine of the angle
between u and CA, zero when A stands at the foot of the normal from C to the guide.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 3).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...board import Board
from ...names import NORMAL, Name, between, mark, rate, spelled, vector
from ..guides import coriolis, pin_offset
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
    moments_about,
    move_points,
    normal_of,
    passed_on,
    place_points,
    settle,
    size_of,
)
from ..structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one RPR dyad use."""

    mechanism: Mechanism
    name: str
    pair: Prismatic
    slider: Link
    guide: Link
    A: str  # pin of the slider
    C: str  # pin of the guide link
    before: tuple[int, int]  # the links that carry A and C

    @property
    def length(self) -> Name:
        """Name of the distance of the pins, C and A."""
        return between("l", self.C, self.A)

    @property
    def e(self) -> Name:
        """Name of the direction from C to A."""
        return between("e", self.C, self.A)

    @property
    def n(self) -> Name:
        """Name of the normal to it."""
        return between("n", self.C, self.A)

    @property
    def u(self) -> Name:
        """Name of the guide's direction."""
        return self.mechanism.pair("u", self.slider.number, self.guide.number)

    @property
    def own(self) -> Name:
        """Letter of A as a point of the slider."""
        return self.mechanism.letter_on(self.A, self.slider.number)

    @property
    def under(self) -> Name:
        """Letter of the guide link's point under A."""
        return self.mechanism.letter_on(self.A, self.guide.number)

    @property
    def spans(self) -> tuple[Span, ...]:
        """No link has two joints."""
        return ()

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The slider and the guide link for those attached to them."""
        return self._body(self.slider, self.A, ZERO), self._body(self.guide, self.C, self.pair.direction)

    def _body(self, link: Link, pin: str, slope: str) -> Body:
        simple = link.points[pin] == (ZERO, ZERO) and slope == ZERO
        local = None if simple else f"_g_{link.number}"
        return Body(link, pin, self.u, local, rate("omega", link.number), rate("epsilon", link.number))

    def passed(self) -> tuple[Passed, Passed]:
        """Reactions on the links before."""
        (i, m), j, k = self.before, self.slider.number, self.guide.number
        return passed_on(self.mechanism, j, i, self.A), passed_on(self.mechanism, k, m, self.C)


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies) -> Dyad:
    """Name the parts of an RPR group; either of its links may carry the guide."""
    pair = group.inner[0]
    assert isinstance(pair, Prismatic)
    pins = dict(zip(group.links, zip(group.outer, group.before, strict=True), strict=True))
    (at, before), (pivot, carrier) = (pins[number] for number in pair.links)
    slider, guide = (mechanism.link(number) for number in pair.links)
    return Dyad(mechanism, group.name, pair, slider, guide, at.point, pivot.point, (before, carrier))


def position(board: Board, d: Dyad) -> None:
    """The guide's direction is that of the tangent through A to a circle about C, which is CA when it has no offset."""
    slider, guide = d.bodies
    offset = pin_offset(board, d.pair, d.slider, d.A, d.guide, d.C)
    board.tangent(d.u, d.C, d.A, offset, d.pair.branch or "one", size_of(board, d.mechanism))
    board.normal(normal_of(d.u), d.u)
    board.measure(d.length, d.C, d.A)
    board.direction(d.e, d.C, d.A, d.length)
    board.normal(d.n, d.e)
    settle(board, slider)
    settle(board, guide, d.pair.direction)
    place_points(board, guide, (d.C,))
    place_points(board, slider, (d.A,))


def velocity(board: Board, d: Dyad) -> None:
    """Through c the normal to CA (not to u), through a the parallel to u: a3. Other points turn about the pins."""
    c, a = (d.mechanism.mark("velocity", pin) for pin in (d.C, d.A))
    a3 = mark("velocity", d.under)
    board.meet(a3, c, d.n, a, d.u)
    board.read(vector("V", d.under, d.C), c, a3)
    board.read(vector("V", d.under, d.own), a, a3)
    board.read(vector("V", d.under), "velocity.p", a3)
    board.calc(rate("omega", d.guide.number), "turning", vector("V", d.under, d.C), d.n, d.length)
    board.calc(rate("omega", d.slider.number), "same_turning", rate("omega", d.guide.number))
    _others(board, d, "velocity")


def acceleration(board: Board, d: Dyad) -> None:
    """From c' the normal part, then the normal to CA; from a' that of Coriolis, then the parallel to u: a3'."""
    c, a = (d.mechanism.mark("acceleration", pin) for pin in (d.C, d.A))
    a3, n, part = (
        mark("acceleration", d.under),
        mark("acceleration", d.under, NORMAL, d.C),
        vector("a", d.under, d.C, "n"),
    )
    board.calc(part.size, "normal_part", vector("V", d.under, d.C), d.length)
    board.back(n, c, d.e, part.size)
    board.read(part, c, n)
    k = coriolis(board, rate("omega", d.guide.number), d.under, d.own, a)
    board.meet(a3, n, d.n, k, d.u)
    board.read(vector("a", d.under, d.C, "t"), n, a3)
    board.read(vector("a", d.under, d.own, "r"), k, a3)
    board.read(vector("a", d.under), "acceleration.p", a3)
    board.calc(rate("epsilon", d.guide.number), "turning", vector("a", d.under, d.C, "t"), d.n, d.length)
    board.calc(rate("epsilon", d.slider.number), "same_turning", rate("epsilon", d.guide.number))
    _others(board, d, "acceleration")


def _others(board: Board, d: Dyad, plan: str) -> None:
    slider, guide = d.bodies
    move_points(board, d.mechanism, guide, plan, (d.C,))
    move_points(board, d.mechanism, slider, plan, (d.A,))


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plans of the slider and of the group.

    R_12^t from the moments of the whole group about C; the slider's chain R_12^t, its loads; through its beginning the
    parallel to CA, through its end the normal to u. R_43 closes the chain of the group.
    """
    (i, m), j, k = d.before, d.slider.number, d.guide.number
    pair = d.mechanism.pair
    moments = [m for n in (j, k) for m in moments_about(board, loads[n], d.C)]
    # R^t stands at A and turns about C in the sense in which it points along the normal: it is laid off backwards
    board.calc(pair("R", i, j, "t").size, "moment_equation", d.length, *moments, *couples[j], *couples[k])

    own = spelled("forces", j)
    board.pole(f"{own}.0")
    board.back(f"{own}.1", f"{own}.0", d.n, pair("R", i, j, "t").size)
    board.read(pair("R", i, j, "t"), f"{own}.0", f"{own}.1")
    last, closing = hang(board, own, [force for force, _ in loads[j]], 1), f"{own}.{len(loads[j]) + 2}"
    board.meet(closing, last, normal_of(d.u), f"{own}.0", d.e)
    board.read(pair("R", k, j), last, closing)
    board.read(pair("R", i, j, "n"), closing, f"{own}.0")
    board.read(pair("R", i, j), closing, f"{own}.1")

    plan = spelled("forces", d.name)
    board.pole(f"{plan}.0")
    hung = [pair("R", i, j), *(force for n in (j, k) for force, _ in loads[n])]
    board.read(pair("R", m, k), hang(board, plan, hung), f"{plan}.0")
    answer(board, d.mechanism, "R", (i, j), (k, j), (m, k))

    # the guide's reaction stands where it balances the moments of the slider's loads about A
    about_A = moments_about(board, loads[j], d.A, d.A)
    board.calc(pair("M", k, j), "closing_moment", ZERO, *about_A, *couples[j])
    board.step("arm", pair("h", k, j), pair("M", k, j), pair("R", k, j))
