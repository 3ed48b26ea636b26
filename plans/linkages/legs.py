"""Legs: what holds a joint on the links before it, a link with two joints or a slide in a guide; groups made of them.

A leg with two revolute pairs, AB, lies along the line AB. A slide, pinned at B, lies along the normal to its guide
through B: so the pin may have come there on a leg of any length. What the plans need of a leg is its line; the
direction, across the line, along which B moves relative to what is known; the mark from which that direction is drawn.

Of the two links that a prismatic pair joins one is known, the other slides along it and turns with it. Either may carry
the guide.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property, lru_cache

from ...scales.errors import InputError
from ..board import Board, Program
from ..names import CORIOLIS, NORMAL, ORIGIN, Name, mark, rate, role, vector
from .mechanism import FRAME, ZERO, Link, Mechanism, Prismatic
from .parts import Bodies, Body, Couples, Forces, Passed, Plan, Span, lay_off, local_mark, normal_of
from .structure import TRIAD, Group

AXES = "xyzuvw"


@lru_cache(maxsize=16)
def guide_letters(program: Program) -> Mapping[str, str]:
    """Return the letters of guides by the name of their direction: `u_30` is x–x, the next one y–y.

    The guide along the line of two pins needs none: it is named by them, as any link.
    """
    letters: dict[str, str] = {}
    for step in program:
        name, of_pins = role(step.name), step.verb == "tangent" and step.operands[2] == ZERO
        if name.kind == "u" and not (name.hidden or of_pins):
            turn, at = divmod(len(letters), len(AXES))
            axis = AXES[at] + "′" * turn
            letters[name] = f"{axis}–{axis}"
    return letters


class _Held:
    """A link that the link `before` holds by a pair."""

    mechanism: Mechanism
    number: int
    before: int

    def outer(self, kind: str, part: str = "") -> Name:
        """Return the outer reaction, of the link before on it, its moment or its arm."""
        return self.mechanism.pair(kind, self.before, self.number, part)


class Hinged(_Held, Span):
    """A leg with two revolute pairs: `start` is its joint with the link `before`, `end` the joint that it holds."""

    def __init__(self, mechanism: Mechanism, link: Link, joints: tuple[str, str], before: int) -> None:
        super().__init__(link, *joints)
        self.mechanism, self.before = mechanism, before
        # whether `start` is a pivot of the frame, and motion about it is called absolute
        self.absolute = self.start in mechanism.frame_points
        self.passed = Passed(mechanism.pair("R", self.number, before), before, self.start)

    def path(self, board: Board) -> tuple[str, str, str]:
        """Lay down what it leaves to its joint: centre and radius of an arc, no line."""
        self.measure(board)
        return self.start, self.length, ZERO

    def about(self, point: str) -> tuple[str, str]:
        """Letters of a point's motion about the start: B and A, or B alone about a pivot of the frame."""
        return point, "" if self.absolute else self.start

    def begin(self, plan: Plan) -> str:
        """Lay off what is known of the joint's motion: for the acceleration the normal part; return the end."""
        start = plan.mark(self.start)
        if plan.symbol == "V":
            return start
        return normal_part(plan.board, self.about(self.end), self.start, start, (self.e, self.length))

    def read(self, plan: Plan, end: str) -> None:
        """Read the motion of the joint relative to the start, when the joint is found."""
        about, joint = self.about(self.end), f"{plan.name}.{self.end}"
        if plan.symbol == "a":
            plan.board.read(vector("a", *about, "t"), end, joint)
        plan.board.read(vector(plan.symbol, *about), plan.mark(self.start), joint)

    move = Span.mark_others  # by similarity

    def turn(self, plan: Plan) -> None:
        """Calculate omega or epsilon from the motion of the joint about the start."""
        rate, part = (self.omega, "") if plan.symbol == "V" else (self.epsilon, "t")
        plan.board.calc(rate, "turning", vector(plan.symbol, *self.about(self.end), part), self.n, self.length)


class Slide(_Held):
    """Link `link` slides on `known` (None: the frame) along the direction `u`; `pin` is the point that runs.

    The reaction of the guide is moved to the pin, with a couple.

    Raises InputError: when the frame is said to be the slider.
    """

    def __init__(self, mechanism: Mechanism, pair: Prismatic, number: int, pin: str, bodies: Bodies) -> None:
        self.mechanism, self.pair, self.link, self.number = mechanism, pair, mechanism.link(number), number
        self.pin = self.start = self.end = pin
        self.carries = pair.links[1] == number  # whether the link carries the guide, not the known one
        self.before = pair.links[0] if self.carries else pair.links[1]
        if self.carries and self.before == FRAME:
            raise InputError("moving-guide", links=f"{number}, {FRAME}")
        self.known = None if self.before == FRAME else bodies[self.before]
        self.u = self.n = mechanism.pair("u", number, self.before)  # direction of the guide, normal to its line
        self.e = normal_of(self.u)  # direction of its line: the normal to the guide
        self.under = mechanism.letter_on(pin, self.before)  # the known link's point that now lies under the pin
        self.own = mechanism.letter_on(pin, number)  # the pin as a point of the sliding link
        # angle of the guide on the sliding link; the x axis of a slider points along the guide
        self.slope = pair.direction if self.carries else ZERO
        reaction, couple = (mechanism.pair(kind, number, self.before) for kind in ("R", "M"))
        self.passed = Passed(reaction, self.before, pin, couple)

    @cached_property
    def body(self) -> Body:
        """The sliding link for those attached to it: it turns like the known one."""
        omega = rate("omega", self.number) if self.known and self.known.omega else None
        epsilon = rate("epsilon", self.number) if self.known and self.known.epsilon else None
        return slider_body(self.link, self.pin, self.u, self.slope, (omega, epsilon))

    def lay_guide(self, board: Board) -> None:
        """Lay down the guide's direction: given on the frame, on a moving link at an angle to the link's own."""
        if self.known is None:
            board.turn(self.u, self.pair.direction)
        else:
            slope = f"_slope_{self.u}"
            board.turn(slope, ZERO if self.carries else self.pair.direction)
            if self.known.local:
                board.decline(f"{slope}_{self.before}", slope, self.known.local)
                slope = f"{slope}_{self.before}"
            board.incline(self.u, self.known.direction, slope)
        board.normal(normal_of(self.u), self.u)
        self.body.settle(board, self.slope)

    def path(self, board: Board) -> tuple[str, str, str]:
        """Lay down the guide's direction and the line along which the pin runs: a mark of it, no arc, direction."""
        self.lay_guide(board)
        start, pair = self._origin(board), self.pair
        if self.carries:
            shift = _excess(board, f"_offset_{self.u}", _across_guide(board, pair, self.link, self.pin), pair.offset)
        else:
            shift = _with_height(board, pair, self.link, self.pin, pair.offset)
        if shift == ZERO:
            return start, ZERO, self.u
        board.lay(f"{start}_{self.pin}", start, normal_of(self.u), shift)
        return f"{start}_{self.pin}", ZERO, self.u

    def _origin(self, board: Board) -> str:
        """Mark a point on the known link's line: of its guide, or its own point that runs in the other link's."""
        if self.carries:
            return self.pair.point
        start = Name(f"_{self.u}_origin", ORIGIN, self.u)
        if self.known is None:
            board.place(start, *self.pair.through)
        else:
            along, across = self.known.coordinates(board, f"through_{self.u}", *self.pair.through)
            board.normal(normal_of(self.known.direction), self.known.direction)
            lay_off(board, start, self.known.pin, self.known.direction, along, across)
        return start

    def place(self, board: Board) -> None:
        """Mark the other points of the sliding link."""
        self.body.place_points(board)

    def about(self, point: str) -> tuple[str, str]:
        """Letters of a point's motion about the guide: B and B4, or B alone when the guide stands."""
        return point, "" if self.known is None else self.under

    def begin(self, plan: Plan) -> str:
        """Mark the known link's point under the pin, and hang on it the acceleration of Coriolis; return the end."""
        if self.known is None:
            return f"{plan.name}.p"
        self.known.carry(plan, self.under, self.pin)
        start = mark(plan.name, self.under)
        if plan.symbol == "a" and self.known.omega is not None:
            return coriolis(plan.board, self.known.omega, self.own, self.under, start)
        return start

    def read(self, plan: Plan, end: str) -> None:
        """Read the sliding, when the pin is found."""
        if self.known is not None:
            part = "" if plan.symbol == "V" else "r"
            plan.board.read(vector(plan.symbol, self.own, self.under, part), end, f"{plan.name}.{self.pin}")

    def move(self, plan: Plan) -> None:
        """Mark the other points of the slider, which turns like the guide."""
        if self.known is not None:
            self.body.turn_with(plan, self.known)
        self.body.move_points(plan)

    def turn(self, plan: Plan) -> None:
        """Do nothing: it turns like the guide."""


Leg = Hinged | Slide


def legs_of(mechanism: Mechanism, group: Group, bodies: Bodies) -> list[Leg]:
    """Name the legs of a group, each with its outer and its inner joint: both links of a dyad, three of a triad."""
    legs: list[Leg] = []
    numbers = group.legs if group.kind == TRIAD else group.links
    joints = group.joints if group.kind == TRIAD else group.joints * 2
    for number, joint, outer, before in zip(numbers, joints, group.outer, group.before, strict=True):
        if isinstance(outer, Prismatic):
            legs.append(Slide(mechanism, outer, number, joint, bodies))
        else:
            legs.append(Hinged(mechanism, mechanism.link(number), (outer.point, joint), before))
    return legs


class AssurGroup:
    """A group with the names that its constructions use, and the constructions: each kind has its own."""

    bodies: tuple[Body, ...]  # its links for those attached to them
    passed: tuple[Passed, ...]  # reactions on the links before

    def __init__(self, mechanism: Mechanism, group: Group, legs: tuple[Leg, ...] = ()) -> None:
        self.mechanism, self.name, self.legs = mechanism, group.name, legs
        self.spans: tuple[Span, ...] = tuple(leg for leg in legs if isinstance(leg, Span))  # links with two joints
        self.bodies, self.passed = tuple(leg.body for leg in legs), tuple(leg.passed for leg in legs)

    def position(self, board: Board) -> None:
        """Mark its points in the plan of the mechanism."""
        raise NotImplementedError

    def move(self, plan: Plan) -> None:
        """Draw its plan of velocities or accelerations."""
        raise NotImplementedError

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Draw its plans of forces, with the loads and the couples of its links."""
        raise NotImplementedError


def slider_body(link: Link, pin: str, u: str, slope: str, rates: tuple[str | None, str | None]) -> Body:
    """Return a link of a sliding pair for those attached to it; `slope` is the angle of the guide `u` on the link."""
    simple = link.points[pin] == (ZERO, ZERO) and slope == ZERO
    return Body(link, pin, u, None if simple else f"_g_{link.number}", *rates)


def _across_guide(board: Board, pair: Prismatic, link: Link, point: str) -> str:
    """Return the name of the distance of a point of the guide link to the left of its guide."""
    if link.points[point] == pair.through:
        return ZERO
    pair_of = f"{link.number}_{pair.links[0]}"
    guide, through, aside = f"_guide_{pair_of}", f"_through_{pair_of}", f"_{link.number}_{point}_aside_{pair.links[0]}"
    board.turn(guide, pair.direction)
    board.place(through, *pair.through)
    board.calc(aside, "across_axis", guide, through, local_mark(board, link, point))
    return aside


def _with_height(board: Board, pair: Prismatic, slider: Link, point: str, size: str) -> str:
    """Add to a distance the height of a point of the slider over the one that runs along the guide."""
    height, own = slider.points[point][1], slider.points[pair.point][1]
    if height == own:
        return size
    name = f"_{slider.number}_{point}_over"
    board.calc(f"{name}_height", "excess", height, own)
    board.calc(name, "sum", size, f"{name}_height")
    return name


def pin_offset(board: Board, pair: Prismatic, slider: Link, pin: str, guide: Link, on_guide: str) -> str:
    """Return the name of the distance of the slider's pin's line to the left of a point of the guide link."""
    size = _with_height(board, pair, slider, pin, pair.offset)
    return _excess(board, f"_offset_{slider.number}_{guide.number}", size, _across_guide(board, pair, guide, on_guide))


def _excess(board: Board, name: str, whole: str, part: str) -> str:
    """Return the name of a distance less another one, which may be none."""
    if part == ZERO:
        return whole
    board.calc(name, "excess", whole, part)
    return name


def coriolis(board: Board, omega: str, tip: str, tail: str, start: str) -> str:
    """Hang on `start` the acceleration of Coriolis: 2 omega v_r, v_r turned by 90 degrees in the sense of omega."""
    part = vector("a", tip, tail, "k")
    board.calc(part, "coriolis", omega, vector("V", tip, tail))
    board.chain(mark("acceleration", tip, CORIOLIS, tail), start, part)
    return mark("acceleration", tip, CORIOLIS, tail)


def normal_part(board: Board, about: tuple[str, str], centre: str, start: str, line: tuple[str, str]) -> str:
    """Hang on `start` the normal part of a point's acceleration about a `centre`, and return its end.

    `about` are the letters of the motion, `line` names the direction from the centre to the point and their distance.
    """
    part, end, (e, length) = vector("a", *about, "n"), mark("acceleration", about[0], NORMAL, centre), line
    board.calc(part.size, "normal_part", vector("V", *about), length)
    board.back(end, start, e, part.size)
    board.read(part, start, end)
    return end
