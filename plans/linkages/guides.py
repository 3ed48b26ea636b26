"""Prismatic pairs: the direction of a guide, the line along which a point runs, the guide's point under it, Coriolis.

Of the two links that a pair joins one is known, the other slides along it and turns with it. Either may carry the
guide.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from ...scales.errors import InputError
from ..board import Board, Program
from ..names import CORIOLIS, ORIGIN, Name, mark, role, vector
from .mechanism import FRAME, ZERO, Link, Mechanism, Prismatic
from .parts import Bodies, Body, carry, coordinates, lay_off, local_mark, normal_of, place_points, settle, turning

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
class Slide:
    """Link `link` slides on `known` (None: the frame) along the direction `u`; `pin` is the point that runs."""

    pair: Prismatic
    link: Link
    pin: str
    known: Body | None
    carries: bool  # whether the link carries the guide, not the known one
    mechanism: Mechanism

    @property
    def other(self) -> int:
        """Number of the known link."""
        return self.pair.links[0] if self.carries else self.pair.links[1]

    @property
    def u(self) -> Name:
        """Name of the guide's direction."""
        return self.mechanism.pair("u", self.link.number, self.other)

    @property
    def under(self) -> Name:
        """Letter of the known link's point that now lies under the pin."""
        return self.mechanism.letter_on(self.pin, self.other)

    @property
    def own(self) -> Name:
        """Letter of the pin as a point of the sliding link."""
        return self.mechanism.letter_on(self.pin, self.link.number)

    @property
    def turns(self) -> bool:
        """Whether both links turn."""
        return self.known is not None and self.known.omega is not None

    @property
    def body(self) -> Body:
        """Return the sliding link for those attached to it."""
        simple = self.link.points[self.pin] == (ZERO, ZERO) and self.slope == ZERO
        local = None if simple else f"_g_{self.link.number}"
        return Body(self.link, self.pin, self.u, local, *turning(self.link.number, self.known))

    @property
    def slope(self) -> str:
        """Angle of the guide on the sliding link; the x axis of a slider points along the guide."""
        return self.pair.direction if self.carries else ZERO

    def mark(self, plan: str) -> str:
        """Return the mark of the known link's point under the pin."""
        return f"{plan}.p" if self.known is None else mark(plan, self.under)


def slide_of(mechanism: Mechanism, pair: Prismatic, number: int, pin: str, bodies: Bodies) -> Slide:
    """Name the parts of the pair by which link `number` slides on a known one.

    Raises
    ------
    InputError
        When the frame is said to be the slider.
    """
    other = next(link for link in pair.links if link != number)
    carries = pair.links[1] == number
    if carries and other == FRAME:
        raise InputError("moving-guide", links=f"{number}, {other}")
    return Slide(pair, mechanism.link(number), pin, None if other == FRAME else bodies[other], carries, mechanism)


def lay_guide(board: Board, s: Slide) -> None:
    """Lay down the guide's direction: given on the frame, on a moving link at an angle to the link's own."""
    if s.known is None:
        board.turn(s.u, s.pair.direction)
    else:
        slope = f"_slope_{s.u}"
        board.turn(slope, ZERO if s.carries else s.pair.direction)
        if s.known.local:
            board.decline(f"{slope}_{s.other}", slope, s.known.local)
            slope = f"{slope}_{s.other}"
        board.incline(s.u, s.known.direction, slope)
    board.normal(normal_of(s.u), s.u)
    settle(board, s.body, s.slope)


def running_line(board: Board, s: Slide) -> str:
    """Lay down the guide's direction and the line along which the pin runs; return the mark it goes through."""
    lay_guide(board, s)
    start, shift = _origin(board, s), offset(board, s)
    if shift == ZERO:
        return start
    board.lay(f"{start}_{s.pin}", start, normal_of(s.u), shift)
    return f"{start}_{s.pin}"


def _origin(board: Board, s: Slide) -> str:
    """Mark a point on the known link's line: of its guide, or its own point that runs in the other link's."""
    if s.carries:
        return s.pair.point
    start = Name(f"_{s.u}_origin", ORIGIN, s.u)
    if s.known is None:
        board.place(start, *s.pair.through)
    else:
        along, across = coordinates(board, s.known, f"through_{s.u}", *s.pair.through)
        board.normal(normal_of(s.known.direction), s.known.direction)
        lay_off(board, start, s.known.pin, s.known.direction, along, across)
    return start


def offset(board: Board, s: Slide) -> str:
    """Return the name of the distance of the pin's line to the left of the mark on the known link."""
    if not s.carries:
        return _with_height(board, s.pair, s.link, s.pin, s.pair.offset)
    across = across_guide(board, s.pair, s.link, s.pin)
    if s.pair.offset == ZERO:
        return across
    board.calc(f"_offset_{s.u}", "excess", across, s.pair.offset)
    return f"_offset_{s.u}"


def across_guide(board: Board, pair: Prismatic, link: Link, point: str) -> str:
    """Return the name of the distance of a point of the guide link to the left of its guide."""
    if link.points[point] == pair.through:
        return ZERO
    number, name = link.number, f"_{link.number}_{point}_aside_{pair.links[0]}"
    board.turn(f"_guide_{number}_{pair.links[0]}", pair.direction)
    board.place(f"_through_{number}_{pair.links[0]}", *pair.through)
    board.calc(
        name,
        "across_axis",
        f"_guide_{number}_{pair.links[0]}",
        f"_through_{number}_{pair.links[0]}",
        local_mark(board, link, point),
    )
    return name


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
    aside = across_guide(board, pair, guide, on_guide)
    if aside == ZERO:
        return size
    name = f"_offset_{slider.number}_{guide.number}"
    board.calc(name, "excess", size, aside)
    return name


def place_slide(board: Board, s: Slide) -> None:
    """Mark the other points of the sliding link."""
    place_points(board, s.body, (s.pin,))


def under_velocity(board: Board, mechanism: Mechanism, s: Slide) -> None:
    """Mark the velocity of the known link's point under the pin."""
    if s.known is not None:
        carry(board, mechanism, s.known, "velocity", s.under, s.pin)


def under_acceleration(board: Board, mechanism: Mechanism, s: Slide) -> str:
    """Mark the acceleration of that point and hang on it that of Coriolis; return the end of both."""
    if s.known is None:
        return "acceleration.p"
    carry(board, mechanism, s.known, "acceleration", s.under, s.pin)
    if s.known.omega is None:
        return s.mark("acceleration")
    return coriolis(board, s.known.omega, s.own, s.under, s.mark("acceleration"))


def coriolis(board: Board, omega: str, tip: str, tail: str, start: str) -> str:
    """Hang on `start` the acceleration of Coriolis: 2 omega v_r, v_r turned by 90 degrees in the sense of omega."""
    part = vector("a", tip, tail, "k")
    board.calc(part, "coriolis", omega, vector("V", tip, tail))
    board.chain(mark("acceleration", tip, CORIOLIS, tail), start, part)
    return mark("acceleration", tip, CORIOLIS, tail)
