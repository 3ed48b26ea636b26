"""Dyads whose two links slide on one another: RPR, such as a stone in a slotted lever; RPP, as in a sine drive.

Letters with the number of a link, A3, are its points that now lie under A. Determinant of all problems of RPR: the
cosine of the angle between the guide and CA, zero when A stands at the foot of the normal from C to the guide; of RPP:
the sine of the angle between the guides.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kinds 3 and 5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ....scales.errors import InputError
from ...board import Board
from ...names import NORMAL, Name, between, mark, rate, spelled, vector
from ..legs import AssurGroup, Slide, coriolis, pin_offset, slide_of, slider_body
from ..mechanism import ZERO, Link, Mechanism, Prismatic
from ..parts import (
    SYMBOLS,
    Bodies,
    Body,
    Couples,
    Forces,
    Passed,
    answer,
    hang,
    moments_about,
    normal_of,
    size_of,
)
from ..structure import Group


def named(mechanism: Mechanism, group: Group, bodies: Bodies) -> AssurGroup:
    """Name the parts of an RPR or RPP group; `bodies` are the links before it.

    Raises
    ------
    InputError
        In an RPP group the frame is said to be a slider, or link 3 slides in both pairs: its x axis cannot point along
        both.
    """
    pair, (pin, last) = group.inner[0], group.outer
    assert isinstance(pair, Prismatic)
    if group.kind == "RPR":
        pins = dict(zip(group.links, zip(group.outer, group.before, strict=True), strict=True))
        (at, before), (pivot, carrier) = (pins[number] for number in pair.links)
        slider, guide = (mechanism.link(number) for number in pair.links)
        return RPR(mechanism, group.name, (), pair, slider, guide, at.point, pivot.point, (before, carrier))
    first, second = group.links
    assert isinstance(last, Prismatic)
    if pair.links[0] == last.links[0] == second:
        raise InputError("slider-twice", link=second)
    Q = last.point if last.links[0] == second else next(iter(mechanism.link(second).points))
    outer = slide_of(mechanism, last, second, Q, bodies)
    inner = slide_of(mechanism, pair, first, pin.point, {second: outer.body})
    return RPP(mechanism, group.name, (), pin.point, Q, group.before[0], inner, outer)


@dataclass(frozen=True, slots=True)
class RPR(AssurGroup):
    """A slider on a rocking guide; either of the links may carry the guide."""

    pair: Prismatic
    slider: Link
    guide: Link
    A: str  # pin of the slider
    C: str  # pin of the guide link
    before: tuple[int, int]  # the links that carry A and C

    @property
    def CA(self) -> tuple[Name, Name, Name]:
        """Names of the distance of the pins, of the direction from C to A, and of the normal to it."""
        return between("l", self.C, self.A), between("e", self.C, self.A), between("n", self.C, self.A)

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
    def bodies(self) -> tuple[Body, Body]:
        """The slider and the guide link for those attached to them."""
        slider, guide = self.slider, self.guide
        turns = [(rate("omega", link.number), rate("epsilon", link.number)) for link in (slider, guide)]
        on_slider = slider_body(slider, self.A, self.u, ZERO, turns[0])
        return on_slider, slider_body(guide, self.C, self.u, self.pair.direction, turns[1])

    def passed(self) -> tuple[Passed, Passed]:
        """Reactions on the links before."""
        (i, m), j, k = self.before, self.slider.number, self.guide.number
        return Passed(self.mechanism.pair("R", j, i), i, self.A), Passed(self.mechanism.pair("R", k, m), m, self.C)

    def position(self, board: Board) -> None:
        """The guide's direction is that of the tangent through A to a circle about C: CA when it has no offset."""
        (slider, guide), (length, e, n) = self.bodies, self.CA
        offset = pin_offset(board, self.pair, self.slider, self.A, self.guide, self.C)
        board.tangent(self.u, self.C, self.A, offset, self.pair.branch or "one", size_of(board, self.mechanism))
        board.normal(normal_of(self.u), self.u)
        board.measure(length, self.C, self.A)
        board.direction(e, self.C, self.A, length)
        board.normal(n, e)
        slider.settle(board)
        guide.settle(board, self.pair.direction)
        guide.place_points(board)
        slider.place_points(board)

    def velocity(self, board: Board) -> None:
        """Through c the normal to CA (not to u), through a the parallel to u: a3. Other points turn about the pins."""
        c, a = (self.mechanism.mark("velocity", pin) for pin in (self.C, self.A))
        a3, of_guide, (length, _, n) = mark("velocity", self.under), vector("V", self.under, self.C), self.CA
        board.meet(a3, c, n, a, self.u)
        board.read(of_guide, c, a3)
        board.read(vector("V", self.under, self.own), a, a3)
        board.read(vector("V", self.under), "velocity.p", a3)
        self._turn(board, "velocity", "omega", (of_guide, n, length))

    def acceleration(self, board: Board) -> None:
        """From c' the normal part, then the normal to CA; from a' that of Coriolis, then the parallel to u: a3'."""
        c, a = (self.mechanism.mark("acceleration", pin) for pin in (self.C, self.A))
        a3, end = mark("acceleration", self.under), mark("acceleration", self.under, NORMAL, self.C)
        part, (length, e, n) = vector("a", self.under, self.C, "n"), self.CA
        board.calc(part.size, "normal_part", vector("V", self.under, self.C), length)
        board.back(end, c, e, part.size)
        board.read(part, c, end)
        k = coriolis(board, rate("omega", self.guide.number), self.under, self.own, a)
        board.meet(a3, end, n, k, self.u)
        board.read(vector("a", self.under, self.C, "t"), end, a3)
        board.read(vector("a", self.under, self.own, "r"), k, a3)
        board.read(vector("a", self.under), "acceleration.p", a3)
        self._turn(board, "acceleration", "epsilon", (vector("a", self.under, self.C, "t"), n, length))

    def _turn(self, board: Board, plan: str, kind: str, turning: tuple[Name, Name, Name]) -> None:
        """Find how both links turn, from what A3 does about C; mark their other points."""
        slider, guide = self.bodies
        board.calc(rate(kind, self.guide.number), "turning", *turning)
        slider.turn_with(board, guide, plan)
        guide.move_points(board, self.mechanism, plan)
        slider.move_points(board, self.mechanism, plan)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plans of the slider and of the group.

        R_12^t from the moments of the whole group about C; the slider's chain R_12^t, its loads; through its beginning
        the parallel to CA, through its end the normal to u. R_43 closes the chain of the group.
        """
        (i, m), j, k = self.before, self.slider.number, self.guide.number
        pair, (length, e, n) = self.mechanism.pair, self.CA
        moments = [moment for link in (j, k) for moment in moments_about(board, loads[link], self.C)]
        # R^t stands at A and turns about C in the sense in which it points along the normal: it is laid off backwards
        board.calc(pair("R", i, j, "t").size, "moment_equation", length, *moments, *couples[j], *couples[k])

        own, plan = spelled("forces", j), spelled("forces", self.name)
        board.pole(f"{own}.0")
        board.back(f"{own}.1", f"{own}.0", n, pair("R", i, j, "t").size)
        board.read(pair("R", i, j, "t"), f"{own}.0", f"{own}.1")
        last, closing = hang(board, own, [force for force, _ in loads[j]], 1), f"{own}.{len(loads[j]) + 2}"
        board.meet(closing, last, normal_of(self.u), f"{own}.0", e)
        board.read(pair("R", k, j), last, closing)
        board.read(pair("R", i, j, "n"), closing, f"{own}.0")
        board.read(pair("R", i, j), closing, f"{own}.1")

        board.pole(f"{plan}.0")
        hung = [pair("R", i, j), *(force for link in (j, k) for force, _ in loads[link])]
        board.read(pair("R", m, k), hang(board, plan, hung), f"{plan}.0")
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))

        # the guide's reaction stands where it balances the moments of the slider's loads about A
        about_A = moments_about(board, loads[j], self.A, self.A)
        board.calc(pair("M", k, j), "closing_moment", ZERO, *about_A, *couples[j])
        board.step("arm", pair("h", k, j), pair("M", k, j), pair("R", k, j))


@dataclass(frozen=True, slots=True)
class RPP(AssurGroup):
    """A hinged slider 2 and a slide 3: link 3 slides on link 2 along u23 and on the link before it along u34.

    All three turn alike. `inner` is the pair of link 2 with 3, `outer` that of link 3 with the last.
    """

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
    def bodies(self) -> tuple[Body, Body]:
        """The links for those attached to them."""
        return self.inner.body, self.outer.body

    def passed(self) -> tuple[Passed, Passed]:
        """Reactions on the links before; that on the last is moved to A, with a couple."""
        first = Passed(self.mechanism.pair("R", self.inner.number, self.before), self.before, self.A)
        return first, self.beneath.passed()

    def position(self, board: Board) -> None:
        """Q of link 3 is where its path on the last link meets the parallel to u23 at its distance from A."""
        path, _, _ = self.outer.path(board)
        self.inner.lay_guide(board)
        board.meet(self.Q, self._beside(board), self.inner.u, path, self.outer.u)
        self.outer.place(board)
        self.inner.place(board)

    def _beside(self, board: Board) -> str:
        """Mark a point as far from A across u23 as Q is."""
        pair, (first, second) = self.inner.pair, (self.inner.link, self.outer.link)
        if self.inner.carries:
            shift, lay = pin_offset(board, pair, second, self.Q, first, self.A), board.lay
        else:
            shift, lay = pin_offset(board, pair, first, self.A, second, self.Q), board.back
        if shift == ZERO:
            return self.A
        lay(f"_{self.inner.u}_{self.Q}", self.A, normal_of(self.inner.u), shift)
        return f"_{self.inner.u}_{self.Q}"

    def velocity(self, board: Board) -> None:
        """Through a2 the parallel to u23, through a4 (p when the guide stands) the parallel to u34: a3."""
        self._move(board, "velocity", self.mechanism.mark("velocity", self.A))

    def acceleration(self, board: Board) -> None:
        """From a2' and a4' the accelerations of Coriolis, through their ends the parallels to the guides: a3'."""
        start, omega = self.mechanism.mark("acceleration", self.A), self.outer.body.omega
        start = coriolis(board, omega, self.under, self.inner.own, start) if omega else start
        self._move(board, "acceleration", start)

    def _move(self, board: Board, plan: str, start: str) -> None:
        a3, symbol, part = mark(plan, self.under), SYMBOLS[plan], "" if plan == "velocity" else "r"
        beneath = self.beneath
        end = beneath.begin(board, plan)
        board.meet(a3, start, self.inner.u, end, self.outer.u)
        board.read(vector(symbol, self.under, self.inner.own, part), start, a3)
        if beneath.known is not None:
            board.read(vector(symbol, self.under, beneath.under, part), end, a3)
        board.read(vector(symbol, self.under), f"{plan}.p", a3)
        self._others(board, plan)

    def _others(self, board: Board, plan: str) -> None:
        """Both links turn like the last one; points of link 3 turn about A3, then about Q, those of link 2 about A."""
        first, second = self.bodies
        if self.outer.known is not None:
            second.turn_with(board, self.outer.known, plan)
            first.turn_with(board, second, plan)
        replace(second, pin=self.under).carry(board, self.mechanism, plan, self.Q, self.Q, self.A)
        second.move_points(board, self.mechanism, plan)
        first.move_points(board, self.mechanism, plan)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plans of link 3 and of link 2.

        The loads of link 3, through their ends the normals to both guides; the loads of link 2 with the inner reaction.
        Moments about A give the arms of the reactions of the guides, of link 2 first.
        """
        i, j, k, m = self.before, self.inner.number, self.outer.number, self.outer.before
        plan, own, pair = spelled("forces", k), spelled("forces", j), self.mechanism.pair
        board.pole(f"{plan}.0")
        last, closing = hang(board, plan, [force for force, _ in loads[k]]), f"{plan}.{len(loads[k]) + 1}"
        board.meet(closing, last, self.outer.e, f"{plan}.0", self.inner.e)
        board.read(pair("R", j, k), closing, f"{plan}.0")
        board.read(pair("R", m, k), last, closing)
        answer(board, self.mechanism, "R", (j, k))

        board.pole(f"{own}.0")
        board.read(pair("R", i, j), hang(board, own, [pair("R", k, j), *(force for force, _ in loads[j])]), f"{own}.0")
        answer(board, self.mechanism, "R", (i, j), (m, k))

        board.calc(pair("M", k, j), "closing_moment", ZERO, *moments_about(board, loads[j], self.A), *couples[j])
        answer(board, self.mechanism, "M", (k, j))
        moments = moments_about(board, loads[k], self.A)
        board.calc(pair("M", m, k), "closing_moment", pair("M", j, k), *moments, *couples[k])
        answer(board, self.mechanism, "M", (m, k))
        board.step("arm", pair("h", k, j), pair("M", k, j), pair("R", k, j))
        board.step("arm", pair("h", m, k), pair("M", m, k), pair("R", m, k))
