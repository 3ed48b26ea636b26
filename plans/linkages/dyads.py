"""Dyads, the groups of class II: links pinned together, RRR, RRP, PRP, and links that slide on one another, RPR, RPP.

RRR is a connecting rod and a rocker, RRP a rod and a slider, PRP two sliders with a common pin, as in a tangent
mechanism. Each link is a leg that holds the pin B: by the pair A at its other end, or by a guide, which stands or
moves. Determinant of all problems of a kind: the sine of the angle between the normals to AB and CB, zero when A, B, C
stand in line; between the normal to AB and the guide, zero when AB is normal to the guide; between both guides.

RPR is a stone in a slotted lever, RPP stands in a sine drive. Determinant of all problems of RPR: the cosine of the
angle between the guide and CA, zero when A stands at the foot of the normal from C to the guide; of RPP: the sine of
the angle between the guides.

Letters with the number of a link, A3, are its points that now lie under A.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kinds 1 to 5).
"""

from __future__ import annotations

from dataclasses import replace

from ...scales.errors import InputError
from ..board import Board
from ..names import Name, between, mark, rate, spelled, vector
from .legs import AssurGroup, Hinged, Leg, Slide, coriolis, legs_of, normal_part, pin_offset, slider_body
from .mechanism import ZERO, Mechanism, Prismatic
from .parts import SYMBOLS, Bodies, Couples, Forces, Passed, answer, hang, moments_about, normal_of
from .structure import Group


class Pinned(AssurGroup):
    """What RRR, RRP and PRP have in common: B is found where the directions of both legs meet."""

    legs: tuple[Leg, Leg]

    def __init__(self, mechanism: Mechanism, group: Group, bodies: Bodies) -> None:
        first, second = legs_of(mechanism, group, bodies)
        if isinstance(first, Hinged) and (isinstance(second, Slide) or second.absolute):
            # only one motion of B is absolute: that on a slider; where both pivots are fixed the group stands still
            first.absolute = False
        super().__init__(mechanism, group, (first, second))
        self.B = first.end
        self.branch = (group.inner[0] if group.kind == "RRR" else group.outer[1]).branch or "one"

    def _move(self, board: Board, plan: str) -> None:
        """Through a and c the normals to AB and CB: b. A slider has b4 and the parallel to its guide instead.

        Of accelerations from a' and c' the normal parts, the lines through their ends. The parallel to a guide runs
        through the pole when the guide stands, otherwise through the end of the acceleration of Coriolis.
        """
        b, (first, second) = f"{plan}.{self.B}", self.legs
        ends = [leg.begin(board, plan) for leg in self.legs]
        board.meet(b, ends[0], first.n, ends[1], second.n)
        for leg, end in zip(self.legs, ends, strict=True):
            leg.read(board, plan, end)
        board.read(vector(SYMBOLS[plan], self.B), f"{plan}.p", b)
        for leg in self.legs:
            leg.move(board, plan)
        for leg in self.legs:
            leg.turn(board, plan)


class RRR(Pinned):
    """A connecting rod AB and a rocker CB."""

    legs: tuple[Hinged, Hinged]

    def position(self, board: Board) -> None:
        """B is where the arc of radius AB about A crosses the arc of radius CB about C."""
        (A, AB, _), (C, CB, _) = (leg.path(board) for leg in self.legs)
        board.arcs(self.B, A, AB, C, CB, self.branch)
        for leg in self.legs:
            leg.place(board)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plan of the group: R_12^t, loads of both links, R_43^t; the normal parts along AB and CB close it.

        The tangential parts follow from the moments of each link about B; the inner reaction is a chord of the plan.
        Where AB and CB are nearly parallel, moments of the whole group give a line that meets one of them better.
        """
        plan, pair, (AB, CB) = spelled("forces", self.name), self.mechanism.pair, self.legs
        (i, j), (m, k) = ((leg.before, leg.number) for leg in self.legs)
        for leg in self.legs:
            _tangential(board, leg, self.B, loads, couples)
        part = self._across(board, loads, couples)
        board.pole(f"{plan}.0")
        board.lay(f"{plan}.1", f"{plan}.0", AB.n, pair("R", i, j, "t").size)
        board.read(pair("R", i, j, "t"), f"{plan}.0", f"{plan}.1")
        parted = hang(board, plan, [force for force, _ in loads[j]], 1)
        chained = hang(board, plan, [force for force, _ in loads[k]], 1 + len(loads[j]))
        last, closing, beside = (f"{plan}.{len(loads[j]) + len(loads[k]) + more}" for more in (2, 3, 4))
        board.lay(last, chained, CB.n, pair("R", m, k, "t").size)
        board.read(pair("R", m, k, "t"), chained, last)
        self._close(board, (chained, last, closing, beside), part)
        board.read(pair("R", i, j, "n"), closing, f"{plan}.0")
        board.read(pair("R", i, j), closing, f"{plan}.1")
        board.read(pair("R", m, k, "n"), last, closing)
        board.read(pair("R", m, k), chained, closing)
        board.read(pair("R", k, j), parted, closing)
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))

    def _across(self, board: Board, loads: Forces, couples: Couples) -> Name | None:
        """Find, where it is wanted, the part of a reaction normal to CA from moments of the group about A or C."""
        centre = dict(self.mechanism.centres).get(self.name)
        if centre is None:
            return None
        leg = next(leg for leg in self.legs if leg.start != centre)
        length, e, n = between("l", centre, leg.start).size, spelled("e", self.name), spelled("n", self.name)
        board.measure(length, centre, leg.start)
        board.direction(e, centre, leg.start, length)
        board.normal(n, e)
        numbers = [leg.number for leg in self.legs]
        moments = [m for n in numbers for m in moments_about(board, loads[n], centre, centre)]
        part = self.mechanism.pair("R", leg.before, leg.number, "m")
        board.calc(part.size, "moment_equation", length, *moments, *(c for n in numbers for c in couples[n]))
        return part

    def _close(self, board: Board, marks: tuple[str, str, str, str], part: Name | None) -> None:
        """Mark where two lines close the chain: the parallels to AB and CB, or one of them and that to CA.

        `marks` are the ends of the chained loads, of the whole chain, the closing point, and one beside it.
        """
        (AB, CB), (chained, last, closing, beside), plan = self.legs, marks, spelled("forces", self.name)
        e, n = spelled("e", self.name), spelled("n", self.name)
        if part is None:
            board.meet(closing, last, CB.e, f"{plan}.0", AB.e)
        # the part turns about the centre in the sense in which it points along the normal; it is laid off at the loads
        elif dict(self.mechanism.centres)[self.name] == CB.start:
            board.lay(beside, f"{plan}.1", n, part.size)
            board.read(part, beside, f"{plan}.1")
            board.meet(closing, beside, e, f"{plan}.0", AB.e)
        else:
            board.back(beside, chained, n, part.size)
            board.read(part, chained, beside)
            board.meet(closing, last, CB.e, beside, e)


def _tangential(board: Board, leg: Hinged, B: str, loads: Forces, couples: Couples) -> None:
    """Find the tangential part of an outer reaction from the moments of its link about B.

    It stands on the arm of the link and turns about B against the sense in which it points along the normal.
    """
    moments, part = moments_about(board, loads[leg.number], B), leg.mechanism.pair("R", leg.before, leg.number, "t")
    board.calc(part.size, "moment_equation", leg.length, *moments, *couples[leg.number])


class RRP(Pinned):
    """A connecting rod AB and a slider, which may carry the guide itself."""

    legs: tuple[Hinged, Slide]

    def position(self, board: Board) -> None:
        """B is where the arc of radius AB about A crosses the line along which B runs."""
        rod, slide = self.legs
        start, _, u = slide.path(board)
        A, length, _ = rod.path(board)
        board.arc(self.B, A, length, start, u, self.branch)
        for leg in self.legs:
            leg.place(board)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plans of the group and of the rod.

        R_12^t from the moments of the rod about B; the chain R_12^t, loads of the slider, loads of the rod; through its
        beginning the parallel to AB, through its end the normal to the guide.
        """
        (rod, slide), pair = self.legs, self.mechanism.pair
        (i, j), (m, k) = ((leg.before, leg.number) for leg in self.legs)
        _tangential(board, rod, self.B, loads, couples)

        plan = spelled("forces", self.name)
        hung = [force for force, _ in (*loads[k], *loads[j])]
        board.pole(f"{plan}.0")
        board.lay(f"{plan}.1", f"{plan}.0", rod.n, pair("R", i, j, "t").size)
        board.read(pair("R", i, j, "t"), f"{plan}.0", f"{plan}.1")
        last, closing = hang(board, plan, hung, 1), f"{plan}.{len(hung) + 2}"
        board.meet(closing, last, slide.e, f"{plan}.0", rod.e)
        board.read(pair("R", m, k), last, closing)
        board.read(pair("R", i, j, "n"), closing, f"{plan}.0")
        board.read(pair("R", i, j), closing, f"{plan}.1")

        own = spelled("forces", j)
        board.pole(f"{own}.0")
        board.chain(f"{own}.1", f"{own}.0", pair("R", i, j))
        board.read(pair("R", k, j), hang(board, own, [force for force, _ in loads[j]], 1), f"{own}.0")
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))

        # the guide's reaction stands where it balances the moments of the slider's loads about B
        own_moment = spelled("M", k, links=(k,)).size
        board.calc(own_moment, "sum", ZERO, *moments_about(board, loads[k], self.B), *couples[k])
        board.calc(pair("M", m, k), "opposite", own_moment)
        board.step("arm", pair("h", m, k), pair("M", m, k), pair("R", m, k))
        answer(board, self.mechanism, "M", (m, k))


class PRP(Pinned):
    """Two sliders with a common pin on guides of other links."""

    legs: tuple[Slide, Slide]

    def position(self, board: Board) -> None:
        """B is where the lines meet along which it runs on both guides."""
        (first, _, u), (second, _, w) = (leg.path(board) for leg in self.legs)
        board.meet(self.B, first, u, second, w)
        for leg in self.legs:
            leg.place(board)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plan of the group: the loads of both links, through its ends the normals to the guides.

        The inner reaction is a chord of the plan; the moments of each link about B give the arms of the outer ones.
        """
        (first, second), plan, pair = self.legs, spelled("forces", self.name), self.mechanism.pair
        (i, j), (m, k) = ((leg.before, leg.number) for leg in self.legs)
        board.pole(f"{plan}.0")
        parted = hang(board, plan, [force for force, _ in loads[j]])
        last = hang(board, plan, [force for force, _ in loads[k]], len(loads[j]))
        closing = f"{plan}.{len(loads[j]) + len(loads[k]) + 1}"
        board.meet(closing, last, second.e, f"{plan}.0", first.e)
        board.read(pair("R", i, j), closing, f"{plan}.0")
        board.read(pair("R", m, k), last, closing)
        board.read(pair("R", k, j), parted, closing)
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))
        for other, own in ((i, j), (m, k)):
            moments = moments_about(board, loads[own], self.B)
            board.calc(pair("M", other, own), "closing_moment", ZERO, *moments, *couples[own])
            answer(board, self.mechanism, "M", (other, own))
            board.step("arm", pair("h", other, own), pair("M", other, own), pair("R", other, own))


class RPR(AssurGroup):
    """A slider on a rocking guide; either of the links may carry the guide."""

    def __init__(self, mechanism: Mechanism, group: Group, bodies: Bodies) -> None:
        super().__init__(mechanism, group)
        pair, pins = group.inner[0], dict(zip(group.links, zip(group.outer, group.before, strict=True), strict=True))
        assert isinstance(pair, Prismatic)
        (at, i), (pivot, m) = (pins[number] for number in pair.links)
        self.pair, (j, k) = pair, pair.links
        self.slider, self.guide = mechanism.link(j), mechanism.link(k)
        self.A, self.C, self.before = at.point, pivot.point, (i, m)  # the pins of both, and the links that carry them
        # distance of the pins, direction from C to A, normal to it
        self.CA = between("l", self.C, self.A), between("e", self.C, self.A), between("n", self.C, self.A)
        self.u = mechanism.pair("u", j, k)  # direction of the guide
        # A as a point of the slider, and the guide link's point under it
        self.own, self.under = mechanism.letter_on(self.A, j), mechanism.letter_on(self.A, k)
        of_slider, of_guide = ((rate("omega", number), rate("epsilon", number)) for number in pair.links)
        guide = slider_body(self.guide, self.C, self.u, pair.direction, of_guide)
        self.bodies = slider_body(self.slider, self.A, self.u, ZERO, of_slider), guide
        self.passed = (Passed(mechanism.pair("R", j, i), i, self.A), Passed(mechanism.pair("R", k, m), m, self.C))

    def position(self, board: Board) -> None:
        """The guide's direction is that of the tangent through A to a circle about C: CA when it has no offset."""
        (slider, guide), (length, e, n) = self.bodies, self.CA
        offset = pin_offset(board, self.pair, self.slider, self.A, self.guide, self.C)
        names = (*self.mechanism.coordinates, *(xy for at in self.mechanism.frame_points.values() for xy in at))
        board.calc("_size", "largest", *dict.fromkeys(xy for xy in names if xy != ZERO))  # places are rounded by it
        board.tangent(self.u, self.C, self.A, offset, self.pair.branch or "one", "_size")
        board.normal(normal_of(self.u), self.u)
        board.measure(length, self.C, self.A)
        board.direction(e, self.C, self.A, length)
        board.normal(n, e)
        slider.settle(board)
        guide.settle(board, self.pair.direction)
        guide.place_points(board)
        slider.place_points(board)

    def _move(self, board: Board, plan: str) -> None:
        """Through c the normal to CA (not to u), through a the parallel to u: a3. Other points turn about the pins.

        Of accelerations from c' the normal part, from a' that of Coriolis, the lines through their ends.
        """
        c, a = (self.mechanism.mark(plan, pin) for pin in (self.C, self.A))
        a3, (length, e, n), (slider, guide), number = mark(plan, self.under), self.CA, self.bodies, self.guide.number
        symbol, across, along, turning = "V", "", "", rate("omega", number)
        if plan == "acceleration":
            symbol, across, along, turning = "a", "t", "r", rate("epsilon", number)
            c = normal_part(board, (self.under, self.C), self.C, c, (e, length))
            a = coriolis(board, rate("omega", number), self.under, self.own, a)
        board.meet(a3, c, n, a, self.u)
        board.read(vector(symbol, self.under, self.C, across), c, a3)
        board.read(vector(symbol, self.under, self.own, along), a, a3)
        board.read(vector(symbol, self.under), f"{plan}.p", a3)
        board.calc(turning, "turning", vector(symbol, self.under, self.C, across), n, length)
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


class RPP(AssurGroup):
    """A hinged slider 2 and a slide 3: link 3 slides on link 2 along u23 and on the link before it along u34.

    All three turn alike. `inner` is the pair of link 2 with 3, `outer` that of link 3 with the last.

    Raises
    ------
    InputError
        When link 3 slides in both pairs: its x axis cannot point along both.
    """

    def __init__(self, mechanism: Mechanism, group: Group, bodies: Bodies) -> None:
        super().__init__(mechanism, group)
        pair, (pin, last), (first, second) = group.inner[0], group.outer, group.links
        assert isinstance(pair, Prismatic)
        assert isinstance(last, Prismatic)
        if pair.links[0] == last.links[0] == second:
            raise InputError("slider-twice", link=second)
        self.A, self.before = pin.point, group.before[0]  # and the link that carries A
        # a lettered point of link 3
        self.Q = last.point if last.links[0] == second else next(iter(mechanism.link(second).points))
        self.outer = Slide(mechanism, last, second, self.Q, bodies)
        # the outer pair as if A3 ran in it, for the last link's point under A
        self.beneath = Slide(mechanism, last, second, self.A, bodies)
        self.inner = Slide(mechanism, pair, first, self.A, {second: self.outer.body})
        self.under = self.inner.under  # letter of link 3's point under A
        self.bodies = self.inner.body, self.outer.body
        # the reaction on the last link is moved to A, with a couple
        self.passed = Passed(mechanism.pair("R", first, self.before), self.before, self.A), self.beneath.passed

    def position(self, board: Board) -> None:
        """Q of link 3 is where its path on the last link meets the parallel to u23 at its distance from A."""
        path, _, _ = self.outer.path(board)
        self.inner.lay_guide(board)
        pair, (first, second), beside = self.inner.pair, (self.inner.link, self.outer.link), self.A
        if self.inner.carries:
            shift, lay = pin_offset(board, pair, second, self.Q, first, self.A), board.lay
        else:
            shift, lay = pin_offset(board, pair, first, self.A, second, self.Q), board.back
        if shift != ZERO:
            beside = f"_{self.inner.u}_{self.Q}"  # a point as far from A across u23 as Q is
            lay(beside, self.A, normal_of(self.inner.u), shift)
        board.meet(self.Q, beside, self.inner.u, path, self.outer.u)
        self.outer.place(board)
        self.inner.place(board)

    def _move(self, board: Board, plan: str) -> None:
        """Through a2 the parallel to u23, through a4 (p when the guide stands) the parallel to u34: a3.

        Of accelerations from a2' and a4' those of Coriolis, the parallels through their ends.
        """
        start, omega = self.mechanism.mark(plan, self.A), self.outer.body.omega
        if plan == "acceleration" and omega:
            start = coriolis(board, omega, self.under, self.inner.own, start)
        a3, symbol, part = mark(plan, self.under), SYMBOLS[plan], "" if plan == "velocity" else "r"
        beneath, (first, second) = self.beneath, self.bodies
        end = beneath.begin(board, plan)
        board.meet(a3, start, self.inner.u, end, self.outer.u)
        board.read(vector(symbol, self.under, self.inner.own, part), start, a3)
        if beneath.known is not None:
            board.read(vector(symbol, self.under, beneath.under, part), end, a3)
        board.read(vector(symbol, self.under), f"{plan}.p", a3)
        # both links turn like the last one; points of link 3 turn about A3, then about Q, those of link 2 about A
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
