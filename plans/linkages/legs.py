"""Legs: what holds a joint on the links before it, a link with two joints or a slide in a guide; groups made of them.

A leg with two revolute pairs, AB, lies along the line AB. A slide, pinned at B, lies along the normal to its guide
through B: so the pin may have come there on a leg of any length. What the plans need of a leg is its line; the
direction, across the line, along which B moves relative to what is known; the mark from which that direction is drawn.

Of the two links that a prismatic pair joins one is known, the other slides along it and turns with it. Either may carry
the guide.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

from ...scales.errors import InputError
from ..board import Board, Program
from ..names import CORIOLIS, NORMAL, ORIGIN, Name, mark, rate, role, vector
from .mechanism import FRAME, ZERO, Link, Mechanism, Prismatic
from .parts import (
    SYMBOLS,
    Bodies,
    Body,
    Couples,
    Forces,
    Passed,
    Span,
    lay_off,
    local_mark,
    normal_of,
)
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


@dataclass(frozen=True, slots=True)
class Hinged(Span):
    """A leg with two revolute pairs: `start` is its joint with the link `before`, `end` the joint that it holds."""

    mechanism: Mechanism
    before: int
    absolute: bool  # whether `start` is a pivot of the frame, and motion about it is called absolute

    @property
    def spans(self) -> tuple[Span, ...]:
        """Itself, with its two joints."""
        return (self,)

    def path(self, board: Board) -> tuple[str, str, str]:
        """Lay down what it leaves to its joint: centre and radius of an arc, no line."""
        self.measure(board)
        return self.start, self.length, ZERO

    def about(self, point: str) -> tuple[str, str]:
        """Letters of a point's motion about the start: B and A, or B alone about a pivot of the frame."""
        return point, "" if self.absolute else self.start

    def begin(self, board: Board, plan: str) -> str:
        """Lay off what is known of the joint's motion: for the acceleration the normal part; return the end."""
        start = self.mechanism.mark(plan, self.start)
        if plan == "velocity":
            return start
        part, end = vector("a", *self.about(self.end), "n"), mark(plan, self.end, NORMAL, self.start)
        board.calc(part.size, "normal_part", vector("V", *self.about(self.end)), self.length)
        board.back(end, start, self.e, part.size)
        board.read(part, start, end)
        return end

    def read(self, board: Board, plan: str, end: str) -> None:
        """Read the motion of the joint relative to the start, when the joint is found."""
        about, joint = self.about(self.end), f"{plan}.{self.end}"
        if plan == "acceleration":
            board.read(vector("a", *about, "t"), end, joint)
        board.read(vector(SYMBOLS[plan], *about), self.mechanism.mark(plan, self.start), joint)

    def move(self, board: Board, plan: str) -> None:
        """Mark its other points by similarity."""
        self.mark_others(board, self.mechanism, plan)

    def turn(self, board: Board, plan: str) -> None:
        """Calculate omega or epsilon from the motion of the joint about the start."""
        about = self.about(self.end)
        if plan == "velocity":
            board.calc(self.omega, "turning", vector("V", *about), self.n, self.length)
        else:
            board.calc(self.epsilon, "turning", vector("a", *about, "t"), self.n, self.length)

    def passed(self) -> Passed:
        """Return the reaction on the link before, at the start."""
        return Passed(self.mechanism.pair("R", self.number, self.before), self.before, self.start)


@dataclass(frozen=True, slots=True)
class Slide:
    """Link `link` slides on `known` (None: the frame) along the direction `u`; `pin` is the point that runs."""

    pair: Prismatic
    link: Link
    pin: str
    known: Body | None
    carries: bool  # whether the link carries the guide, not the known one
    mechanism: Mechanism
    spans: ClassVar[tuple[Span, ...]] = ()  # it has one joint

    @property
    def number(self) -> int:
        """Number of the sliding link."""
        return self.link.number

    @property
    def before(self) -> int:
        """Number of the known link."""
        return self.pair.links[0] if self.carries else self.pair.links[1]

    @property
    def start(self) -> str:
        """Its pin: the reaction of the guide is moved there, with a couple."""
        return self.pin

    @property
    def end(self) -> str:
        """Its pin, too."""
        return self.pin

    @property
    def u(self) -> Name:
        """Name of the guide's direction."""
        return self.mechanism.pair("u", self.number, self.before)

    @property
    def e(self) -> Name:
        """Direction of its line: the normal to the guide."""
        return normal_of(self.u)

    @property
    def n(self) -> Name:
        """Direction normal to its line: that of the guide."""
        return self.u

    @property
    def under(self) -> Name:
        """Letter of the known link's point that now lies under the pin."""
        return self.mechanism.letter_on(self.pin, self.before)

    @property
    def own(self) -> Name:
        """Letter of the pin as a point of the sliding link."""
        return self.mechanism.letter_on(self.pin, self.number)

    @property
    def body(self) -> Body:
        """Return the sliding link for those attached to it: it turns like the known one."""
        omega = rate("omega", self.number) if self.known and self.known.omega else None
        epsilon = rate("epsilon", self.number) if self.known and self.known.epsilon else None
        return slider_body(self.link, self.pin, self.u, self.slope, (omega, epsilon))

    @property
    def slope(self) -> str:
        """Angle of the guide on the sliding link; the x axis of a slider points along the guide."""
        return self.pair.direction if self.carries else ZERO

    def mark(self, plan: str) -> str:
        """Return the mark of the known link's point under the pin."""
        return f"{plan}.p" if self.known is None else mark(plan, self.under)

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
            shift = _excess(board, f"_offset_{self.u}", across_guide(board, pair, self.link, self.pin), pair.offset)
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

    def begin(self, board: Board, plan: str) -> str:
        """Mark the known link's point under the pin, and hang on it the acceleration of Coriolis; return the end."""
        if self.known is not None:
            self.known.carry(board, self.mechanism, plan, self.under, self.pin)
            if plan == "acceleration" and self.known.omega is not None:
                return coriolis(board, self.known.omega, self.own, self.under, self.mark(plan))
        return self.mark(plan)

    def read(self, board: Board, plan: str, end: str) -> None:
        """Read the sliding, when the pin is found."""
        if self.known is not None:
            part = "" if plan == "velocity" else "r"
            board.read(vector(SYMBOLS[plan], self.own, self.under, part), end, f"{plan}.{self.pin}")

    def move(self, board: Board, plan: str) -> None:
        """Mark the other points of the slider, which turns like the guide."""
        if self.known is not None:
            self.body.turn_with(board, self.known, plan)
        self.body.move_points(board, self.mechanism, plan)

    def turn(self, board: Board, plan: str) -> None:
        """Do nothing: it turns like the guide."""

    def passed(self) -> Passed:
        """Return the reaction on the guide, moved to the pin, with a couple."""
        force, couple = (self.mechanism.pair(kind, self.number, self.before) for kind in ("R", "M"))
        return Passed(force, self.before, self.pin, couple)


Leg = Hinged | Slide


def slide_of(mechanism: Mechanism, pair: Prismatic, number: int, pin: str, bodies: Bodies) -> Slide:
    """Name the parts of the pair by which link `number` slides on a known one.

    Raises
    ------
    InputError
        When the frame is said to be the slider.
    """
    known = next(link for link in pair.links if link != number)
    carries = pair.links[1] == number
    if carries and known == FRAME:
        raise InputError("moving-guide", links=f"{number}, {known}")
    return Slide(pair, mechanism.link(number), pin, None if known == FRAME else bodies[known], carries, mechanism)


def legs_of(mechanism: Mechanism, group: Group, bodies: Bodies) -> list[Leg]:
    """Name the legs of a group, each with its outer and its inner joint: both links of a dyad, three of a triad."""
    legs: list[Leg] = []
    numbers = group.legs if group.kind == TRIAD else group.links
    joints = group.joints if group.kind == TRIAD else group.joints * 2
    for number, joint, outer, before in zip(numbers, joints, group.outer, group.before, strict=True):
        if isinstance(outer, Prismatic):
            legs.append(slide_of(mechanism, outer, number, joint, bodies))
        else:
            absolute = outer.point in mechanism.frame_points
            legs.append(Hinged(mechanism.link(number), outer.point, joint, mechanism, before, absolute))
    return legs


@dataclass(frozen=True, slots=True)
class AssurGroup:
    """A group with the names that its constructions use.

    A kind of group has `position`, `velocity` and `acceleration`, which take a board and mark its points there, and
    `forces`.
    """

    mechanism: Mechanism
    name: str  # its links as a word
    legs: tuple[Leg, ...]

    @property
    def spans(self) -> tuple[Span, ...]:
        """Its links with two joints."""
        return tuple(span for leg in self.legs for span in leg.spans)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Its links for those attached to them."""
        return tuple(leg.body for leg in self.legs)

    def passed(self) -> tuple[Passed, ...]:
        """Reactions on the links before."""
        return tuple(leg.passed() for leg in self.legs)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Draw its plans of forces; `loads` are (force, point) and `couples` moments, by link."""
        raise NotImplementedError


def slider_body(link: Link, pin: str, u: str, slope: str, rates: tuple[str | None, str | None]) -> Body:
    """Return a link of a sliding pair for those attached to it; `slope` is the angle of the guide `u` on the link."""
    simple = link.points[pin] == (ZERO, ZERO) and slope == ZERO
    return Body(link, pin, u, None if simple else f"_g_{link.number}", *rates)


def across_guide(board: Board, pair: Prismatic, link: Link, point: str) -> str:
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
    return _excess(board, f"_offset_{slider.number}_{guide.number}", size, across_guide(board, pair, guide, on_guide))


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
