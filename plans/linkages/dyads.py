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
from .parts import Bodies, Couples, Forces, Passed, Plan, Polygon, answer, moments_about, normal_of
from .structure import Group


class _Pinned(AssurGroup):
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

    def move(self, plan: Plan) -> None:
        """Through a and c the normals to AB and CB: b. A slider has b4 and the parallel to its guide instead.

        Of accelerations from a' and c' the normal parts, the lines through their ends. The parallel to a guide runs
        through the pole when the guide stands, otherwise through the end of the acceleration of Coriolis.
        """
        first, second = self.legs
        ends = [leg.begin(plan) for leg in self.legs]
        plan.board.meet(f"{plan.name}.{self.B}", ends[0], first.n, ends[1], second.n)
        for leg, end in zip(self.legs, ends, strict=True):
            leg.read(plan, end)
        plan.read(self.B)
        for leg in self.legs:
            leg.move(plan)
        for leg in self.legs:
            leg.turn(plan)


class RRR(_Pinned):
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
        (AB, CB), (j, k) = self.legs, (leg.number for leg in self.legs)
        for leg in self.legs:
            _tangential(board, leg, loads, couples)
        part = self._across(board, loads, couples)
        plan = Polygon(board, self.name)
        plan.lay(AB.outer("R", "t"), AB.n)
        parted, chained = plan.hang(*loads[j]), plan.hang(*loads[k])
        last = plan.lay(CB.outer("R", "t"), CB.n)
        closing = self._close(plan, chained, part)
        plan.read(AB.outer("R", "n"), closing, 0)
        plan.read(AB.outer("R"), closing, 1)
        plan.read(CB.outer("R", "n"), last, closing)
        plan.read(CB.outer("R"), chained, closing)
        plan.read(self.mechanism.pair("R", k, j), parted, closing)
        answer(board, self.mechanism, "R", (AB.before, j), (k, j), (CB.before, k))

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
        part = leg.outer("R", "m")
        board.calc(part.size, "moment_equation", length, *moments, *(c for n in numbers for c in couples[n]))
        return part

    def _close(self, plan: Polygon, chained: int, part: Name | None) -> int:
        """Mark where two lines close the chain: the parallels to AB and CB, or one of them and that to CA.

        `chained` is the mark at the end of the loads. The part turns about the centre in the sense in which it points
        along the normal; it is laid off at the loads.
        """
        (AB, CB), board, closing = self.legs, plan.board, plan.last + 1
        if part is None:
            return plan.close(CB.e, AB.e)
        e, n = spelled("e", self.name), spelled("n", self.name)
        start, last, end, beside = (f"{plan.name}.{mark}" for mark in (0, plan.last, closing, closing + 1))
        if dict(self.mechanism.centres)[self.name] == CB.start:
            board.lay(beside, f"{plan.name}.1", n, part.size)
            plan.read(part, closing + 1, 1)
            board.meet(end, beside, e, start, AB.e)
        else:
            board.back(beside, f"{plan.name}.{chained}", n, part.size)
            plan.read(part, chained, closing + 1)
            board.meet(end, last, CB.e, beside, e)
        return closing


def _tangential(board: Board, leg: Hinged, loads: Forces, couples: Couples) -> None:
    """Find the tangential part of an outer reaction from the moments of its link about B.

    It stands on the arm of the link and turns about B against the sense in which it points along the normal.
    """
    moments = moments_about(board, loads[leg.number], leg.end)
    board.calc(leg.outer("R", "t").size, "moment_equation", leg.length, *moments, *couples[leg.number])


class RRP(_Pinned):
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
        _tangential(board, rod, loads, couples)

        plan = Polygon(board, self.name)
        plan.lay(rod.outer("R", "t"), rod.n)
        last, closing = plan.hang(*loads[k], *loads[j]), plan.close(slide.e, rod.e)
        plan.read(slide.outer("R"), last, closing)
        plan.read(rod.outer("R", "n"), closing, 0)
        plan.read(rod.outer("R"), closing, 1)

        own = Polygon(board, j)
        own.read(pair("R", k, j), own.hang(rod.outer("R"), *loads[j]), 0)
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))

        # the guide's reaction stands where it balances the moments of the slider's loads about B
        own_moment = spelled("M", k, links=(k,)).size
        board.calc(own_moment, "sum", ZERO, *moments_about(board, loads[k], self.B), *couples[k])
        board.calc(slide.outer("M"), "opposite", own_moment)
        board.step("arm", slide.outer("h"), slide.outer("M"), slide.outer("R"))
        answer(board, self.mechanism, "M", (m, k))


class PRP(_Pinned):
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
        (first, second), (j, k) = self.legs, (leg.number for leg in self.legs)
        plan = Polygon(board, self.name)
        parted, last = plan.hang(*loads[j]), plan.hang(*loads[k])
        closing = plan.close(second.e, first.e)
        plan.read(first.outer("R"), closing, 0)
        plan.read(second.outer("R"), last, closing)
        plan.read(self.mechanism.pair("R", k, j), parted, closing)
        answer(board, self.mechanism, "R", (first.before, j), (k, j), (second.before, k))
        for leg in self.legs:
            moments = moments_about(board, loads[leg.number], self.B)
            board.calc(leg.outer("M"), "closing_moment", ZERO, *moments, *couples[leg.number])
            answer(board, self.mechanism, "M", (leg.before, leg.number))
            board.step("arm", leg.outer("h"), leg.outer("M"), leg.outer("R"))


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

    def move(self, plan: Plan) -> None:
        """Through c the normal to CA (not to u), through a the parallel to u: a3. Other points turn about the pins.

        Of accelerations from c' the normal part, from a' that of Coriolis, the lines through their ends.
        """
        board, symbol, under, (length, e, n) = plan.board, plan.symbol, self.under, self.CA
        c, a, a3, (slider, guide) = plan.mark(self.C), plan.mark(self.A), mark(plan.name, under), self.bodies
        across, along, turning = "", "", rate("omega", self.guide.number)
        if symbol == "a":
            c = normal_part(board, (under, self.C), self.C, c, (e, length))
            a = coriolis(board, turning, under, self.own, a)
            across, along, turning = "t", "r", rate("epsilon", self.guide.number)
        board.meet(a3, c, n, a, self.u)
        board.read(vector(symbol, under, self.C, across), c, a3)
        board.read(vector(symbol, under, self.own, along), a, a3)
        plan.read(under)
        board.calc(turning, "turning", vector(symbol, under, self.C, across), n, length)
        slider.turn_with(plan, guide)
        guide.move_points(plan)
        slider.move_points(plan)

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

        own = Polygon(board, j)
        own.lay(pair("R", i, j, "t"), n, -1)
        last, closing = own.hang(*loads[j]), own.close(normal_of(self.u), e)
        own.read(pair("R", k, j), last, closing)
        own.read(pair("R", i, j, "n"), closing, 0)
        own.read(pair("R", i, j), closing, 1)

        plan = Polygon(board, self.name)
        plan.read(pair("R", m, k), plan.hang(pair("R", i, j), *loads[j], *loads[k]), 0)
        answer(board, self.mechanism, "R", (i, j), (k, j), (m, k))

        # the guide's reaction stands where it balances the moments of the slider's loads about A
        about_A = moments_about(board, loads[j], self.A, self.A)
        board.calc(pair("M", k, j), "closing_moment", ZERO, *about_A, *couples[j])
        board.step("arm", pair("h", k, j), pair("M", k, j), pair("R", k, j))


class RPP(AssurGroup):
    """A hinged slider 2 and a slide 3: link 3 slides on link 2 along u23 and on the link before it along u34.

    All three turn alike. `inner` is the pair of link 2 with 3, `outer` that of link 3 with the last.

    Raises InputError: when link 3 slides in both pairs: its x axis cannot point along both.
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

    def move(self, plan: Plan) -> None:
        """Through a2 the parallel to u23, through a4 (p when the guide stands) the parallel to u34: a3.

        Of accelerations from a2' and a4' those of Coriolis, the parallels through their ends.
        """
        board, symbol, under, part = plan.board, plan.symbol, self.under, "" if plan.symbol == "V" else "r"
        start, omega, beneath, (first, second) = plan.mark(self.A), self.outer.body.omega, self.beneath, self.bodies
        if symbol == "a" and omega:
            start = coriolis(board, omega, under, self.inner.own, start)
        a3, end = mark(plan.name, under), beneath.begin(plan)
        board.meet(a3, start, self.inner.u, end, self.outer.u)
        board.read(vector(symbol, under, self.inner.own, part), start, a3)
        if beneath.known is not None:
            board.read(vector(symbol, under, beneath.under, part), end, a3)
        plan.read(under)
        # both links turn like the last one; points of link 3 turn about A3, then about Q, those of link 2 about A
        if self.outer.known is not None:
            second.turn_with(plan, self.outer.known)
            first.turn_with(plan, second)
        replace(second, pin=under).carry(plan, self.Q, self.Q, self.A)
        second.move_points(plan)
        first.move_points(plan)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plans of link 3 and of link 2.

        The loads of link 3, through their ends the normals to both guides; the loads of link 2 with the inner reaction.
        Moments about A give the arms of the reactions of the guides, of link 2 first.
        """
        i, j, k, m = self.before, self.inner.number, self.outer.number, self.outer.before
        pair, plan = self.mechanism.pair, Polygon(board, k)
        last, closing = plan.hang(*loads[k]), plan.close(self.outer.e, self.inner.e)
        plan.read(pair("R", j, k), closing, 0)
        plan.read(pair("R", m, k), last, closing)
        answer(board, self.mechanism, "R", (j, k))

        own = Polygon(board, j)
        own.read(pair("R", i, j), own.hang(pair("R", k, j), *loads[j]), 0)
        answer(board, self.mechanism, "R", (i, j), (m, k))

        board.calc(pair("M", k, j), "closing_moment", ZERO, *moments_about(board, loads[j], self.A), *couples[j])
        answer(board, self.mechanism, "M", (k, j))
        moments = moments_about(board, loads[k], self.A)
        board.calc(pair("M", m, k), "closing_moment", pair("M", j, k), *moments, *couples[k])
        answer(board, self.mechanism, "M", (m, k))
        for other, link in ((k, j), (m, k)):
            board.step("arm", pair("h", other, link), pair("M", other, link), pair("R", other, link))
