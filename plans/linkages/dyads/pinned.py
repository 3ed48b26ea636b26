"""Dyads whose two links are pinned together at B: RRR, such as a connecting rod and a rocker; RRP, a rod and a slider;
PRP, two sliders with a common pin, as in a tangent mechanism.

Each link is a leg that holds B: by the pair A at its other end, or by a guide, which stands or moves. Letters with the
number of a link, B4, are its points that now lie under B. Determinant of all problems of a kind: the sine of the angle
between the normals to AB and CB, zero when A, B, C stand in line; between the normal to AB and the guide, zero when AB
is normal to the guide; between both guides.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kinds 1, 2 and 4).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...board import Board
from ...names import Name, between, spelled, vector
from ..legs import AssurGroup, Hinged, Leg, Slide, legs_of
from ..mechanism import ZERO, Mechanism
from ..parts import SYMBOLS, Bodies, Couples, Forces, answer, hang, moments_about
from ..structure import Group


def named(mechanism: Mechanism, group: Group, bodies: Bodies) -> AssurGroup:
    """Name the parts of an RRR, RRP or PRP group; `bodies` are the links before it.

    Raises
    ------
    InputError
        When the frame is said to be a slider.
    """
    legs = legs_of(mechanism, group, bodies)
    first, second = legs
    if isinstance(first, Hinged) and (isinstance(second, Slide) or second.absolute):
        # only one motion of B is absolute: that on a slider is, and where both pivots are fixed the group stands still
        legs[0] = replace(first, absolute=False)
    decides = group.inner[0] if group.kind == "RRR" else group.outer[1]
    kinds: dict[str, type[Pinned]] = {"RRR": RRR, "RRP": RRP, "PRP": PRP}
    return kinds[group.kind](mechanism, group.name, (legs[0], legs[1]), decides.branch or "one")


@dataclass(frozen=True, slots=True)
class Pinned(AssurGroup):
    """What all these dyads have in common: B is found where the directions of both legs meet."""

    legs: tuple[Leg, Leg]
    branch: str

    @property
    def B(self) -> str:
        """Letter of the inner joint."""
        return self.legs[0].end

    def velocity(self, board: Board) -> None:
        """Through a and c the normals to AB and CB: b. A slider has b4 and the parallel to its guide instead."""
        self._move(board, "velocity")

    def acceleration(self, board: Board) -> None:
        """From a' and c' the normal parts, through their ends the normals to AB and CB: b'.

        The parallel to a guide runs through the pole when the guide stands, otherwise through the end of the
        acceleration of Coriolis.
        """
        self._move(board, "acceleration")

    def _move(self, board: Board, plan: str) -> None:
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


@dataclass(frozen=True, slots=True)
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
        """Find the part of an outer reaction normal to CA from moments of the whole group about the other outer pair.

        Returns the name of the part, None where no such moments are wanted.
        """
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


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, slots=True)
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
