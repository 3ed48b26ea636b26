"""The triad, a group of class III and third order: a central link that three legs join to the links before.

B, C, D are the joints of the central link, AB, EC, FD the legs; any of them may be a slider on a guide instead. The
lines of two legs meet in a special point X of the central link, which moves relative to A and to E as if it were the
end of both legs: so its velocity and acceleration come first, then those of D, then those of B and C by similarity. Any
two legs will do. Determinant of all its problems: that of the lines of the three legs, zero when they meet in one point
or are parallel.

The normal parts of the reactions on the first two legs go through X, too. So the moments of all loads of the group
about X give the normal part on the third; then a chain of forces has two unknown ends.

The special point has the letter X with the number of the central link, X3, for S3 is a centre of mass.

Source: Artobolevsky, Theory of mechanisms and machines (groups of class III, special points of Assur).
"""

from __future__ import annotations

from collections.abc import Mapping

from ...scales.errors import InputError
from ..board import Board
from ..names import NORMAL, POINT, Name, arm, between, mark, moment, vector
from .legs import AssurGroup, Hinged, Leg, Slide, legs_of, normal_part
from .mechanism import ZERO, Mechanism, Revolute, start_names
from .parts import Bodies, Couples, Forces, Plan, Polygon, Span, answer, local_mark, moments_about
from .structure import Group, listed


class Triad(AssurGroup):
    """The names that the constructions of one triad use, and the constructions.

    `legs` are in the order of construction: the lines of the first two meet in the special point, then the third.

    Raises InputError: when a leg slides on the central link, when the task does not say where that link starts, or
    names other links than two of the legs.
    """

    legs: tuple[Leg, Leg, Leg]

    def __init__(self, mechanism: Mechanism, group: Group, bodies: Bodies) -> None:
        number, links = group.central, listed(group.links)
        if not all(isinstance(pair, Revolute) for pair in group.inner):
            raise InputError("triad-slide", links=links, link=number)
        start = mechanism.start(number)
        if start is None:
            raise InputError("start-missing", links=links, link=number)
        legs = legs_of(mechanism, group, bodies)
        first = legs[:2] if start.legs is None else [leg for own in start.legs for leg in legs if leg.number == own]
        if len({leg.number for leg in first}) != 2:
            raise InputError("start-legs", link=number, known=listed(group.legs))
        third = next(leg for leg in legs if leg not in first)
        super().__init__(mechanism, group, (first[0], first[1], third))
        self.by_number = legs  # that is their order
        B, C = [leg.end for leg in legs if leg is not third]
        self.central = Span(mechanism.link(number), B, C)
        # the third joint is found before the points of the figure
        self.central.others = tuple(point for point in self.central.others if point != third.end)
        self.spans, self.bodies = (self.central, *self.spans), (self.central.body, *self.bodies)
        # Assur's special point; its distance from the third leg's joint, the direction from it, the normal to that
        X, D = Name(f"X{number}", POINT, f"X{number}", links=(number,)), third.end
        self.X, self.XD = X, (between("l", X, D), between("e", X, D), between("n", X, D))
        # the other two joints, and names of their parts along and across XD
        self.figure = [(x.end, f"_along_{x.end}_{X}{D}", f"_across_{x.end}_{X}{D}") for x in first]

    def position(self, board: Board) -> None:
        """B, C and D are where a template of the central link lies on the arcs, or the lines, of the three legs."""
        link = self.central.link
        where: list[str] = [*start_names(link.number)]
        for leg in self.by_number:
            where += [local_mark(board, link, leg.end), *leg.path(board)]
        for leg in self.by_number:
            board.template(leg.end, local_mark(board, link, leg.end), *where)
        self.central.measure(board)
        self.central.place(board)
        for leg in self.by_number:
            leg.place(board)

    def move(self, plan: Plan) -> None:
        """Through a and e the normals to AB and EC: x. Through x the normal to XD, through f that to FD: d.

        Of accelerations from a' the normal parts of B about A and of X about B, from e' likewise; the normals to AB and
        EC give x'. From x' the normal part of D about X, from f' that of D about F; the normals to XD and FD give d'.
        """
        board, symbol, legs, X, (length, e, n) = plan.board, plan.symbol, self.legs, self.X, self.XD
        (first, second, third), D, part = legs, legs[2].end, "" if symbol == "V" else "t"
        ends = [leg.begin(plan) for leg in legs]
        if symbol == "V":
            self._place_special_point(board)
        starts = (
            ends
            if symbol == "V"
            else [self._towards_joint(board, leg, end) for leg, end in zip(legs[:2], ends, strict=False)]
        )
        x, d = mark(plan.name, X), mark(plan.name, D)
        board.meet(x, starts[0], first.n, starts[1], second.n)
        if symbol == "V":
            for leg, start in zip(legs[:2], starts, strict=False):
                board.read(vector("V", *leg.about(X)), start, x)
        plan.read(X)
        tip = x if symbol == "V" else normal_part(board, (D, X), X, x, (e, length))
        board.meet(d, tip, n, ends[2], third.n)
        if symbol == "a":
            board.read(vector("a", D, X, "t"), tip, d)
        board.read(vector(symbol, D, X), x, d)
        plan.read(D)
        turning = self.central.omega if symbol == "V" else self.central.epsilon
        board.calc(turning, "turning", vector(symbol, D, X, part), n, length)
        # the other points of the central link by similarity, then the motion of the legs
        for joint, along, across in self.figure:
            board.similar(f"{plan.name}.{joint}", x, d, along, across)
            plan.read(joint)
        self.central.mark_others(plan)
        for leg, end in zip(legs, ends, strict=True):
            leg.read(plan, end)
            leg.move(plan)
            leg.turn(plan)

    def _place_special_point(self, board: Board) -> None:
        """Mark where the lines of two legs meet, and how the joints of the central link lie to it and to D."""
        (first, second, third), (length, e, n) = self.legs, self.XD
        board.meet(self.X, first.start, first.e, second.start, second.e)
        board.measure(length, self.X, third.end)
        board.direction(e, self.X, third.end, length)
        board.normal(n, e)
        for joint, along, across in self.figure:
            board.calc(along, "part_along", self.X, third.end, joint)
            board.calc(across, "part_across", self.X, third.end, joint)

    def _towards_joint(self, board: Board, leg: Leg, end: str) -> str:
        """Hang on `end` the normal part of X about the joint of a leg: along the leg's line, as that of the joint.

        It follows from omega of the central link, so that X may stand in the joint itself.
        """
        part, tip = vector("a", self.X, leg.end, "n"), mark("acceleration", self.X, NORMAL, leg.end)
        radius = f"_r_{self.X}{leg.end}"
        board.read(radius, leg.end, self.X)
        board.calc(part, "transport_normal", self.central.omega, radius)
        board.chain(tip, end, part)
        return tip

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Force plan of the group: first leg, central link, third leg, second leg; parallels to AB and EC close it.

        Tangential parts follow from each leg alone, a normal part from moments about X. Inner reactions are chords of
        the plan.
        """
        moments: list[str] = []
        for leg in self.legs:
            moments += self._alone(board, leg, loads[leg.number], couples[leg.number])
        number = self.central.number
        moments += moments_about(board, loads[number], self.X)
        third = self.legs[2]  # whose normal part has a moment about X that balances that of all the rest
        part, aside = _normal(third), Name(f"_arm_{third.outer('R').of}")
        # a force along the line has the moment minus its size times the distance of the line to the left of X
        board.calc(aside, "across_axis", third.e, self.X, third.start)
        board.calc(part.size, "moment_equation", aside, *moments, *couples[number])
        board.calc(part, "along", part.size, third.e)
        board.moment(moment(part, self.X), arm(part, self.X), part, third.start, self.X)
        self._draw(board, loads)
        for leg in self.legs:
            if isinstance(leg, Slide):
                board.step("arm", leg.outer("h"), leg.outer("M"), leg.outer("R"))
            answer(board, self.mechanism, "R", (leg.before, leg.number), (number, leg.number))

    def _alone(self, board: Board, leg: Leg, loads: Mapping[str, str], couples: list[str]) -> list[str]:
        """Find the tangential part of an outer reaction, or the couple of a guide, from moments about the inner joint.

        Returns the moments of all that is known on the leg about X.
        """
        own = moments_about(board, loads, leg.end)
        about = moments_about(board, loads, self.X, self.X)
        if isinstance(leg, Slide):
            board.calc(leg.outer("M"), "closing_moment", ZERO, *own, *couples)
            answer(board, self.mechanism, "M", (leg.before, leg.number))
            return [*about, *couples, leg.outer("M")]
        part = leg.outer("R", "t")
        # R^t stands on the arm of the leg and turns about the joint against the sense in which it points
        board.calc(part.size, "moment_equation", leg.length, *own, *couples)
        board.calc(part, "along", part.size, leg.n)
        board.moment(moment(part, self.X), arm(part), part, leg.start, self.X)
        return [*about, *couples, moment(part, self.X)]

    def _draw(self, board: Board, loads: Forces) -> None:
        """Hang all that is known in a chain, close it, read the reactions."""
        (first, second, third), number, plan = self.legs, self.central.number, Polygon(board, self.name)
        parted = plan.hang(*_tangential(first), *loads[first.number])
        left, loaded = plan.hang(*loads[number]), plan.hang(*loads[third.number])
        right = plan.hang(*_tangential(third), _normal(third))
        chained, last = plan.hang(*loads[second.number]), plan.hang(*_tangential(second))
        closing = plan.close(second.e, first.e)
        plan.read(_normal(first), closing, 0)
        plan.read(_normal(second), last, closing)
        for leg, tail, tip in ((first, closing, 1), (second, chained, closing), (third, loaded, right)):
            if isinstance(leg, Hinged):
                plan.read(leg.outer("R"), tail, tip)
        for leg, tail, tip in ((first, parted, closing), (second, closing, right), (third, right, left)):
            plan.read(self.mechanism.pair("R", number, leg.number), tail, tip)


def _normal(leg: Leg) -> Name:
    """Name of the part of an outer reaction along the leg's line: all of it on a slider."""
    return leg.outer("R", "" if isinstance(leg, Slide) else "n")


def _tangential(leg: Leg) -> list[Name]:
    return [leg.outer("R", "t")] if isinstance(leg, Hinged) else []
