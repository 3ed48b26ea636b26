"""Legs of a triad, of two kinds: what its constructions ask of them is the same.

A leg with two revolute pairs, AB, lies along the line AB. A leg that is a slider, pinned to the central link at B, lies
along the normal to its guide through B: so the pin may have come there on a leg of any length. What the plans need of a
leg is its line; the direction, across the line, along which B moves relative to what is known; the mark from which that
direction is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ...board import Board
from ...names import NORMAL, mark, vector
from ..guides import Slide, place_slide, running_line, under_acceleration, under_velocity
from ..mechanism import ZERO, Mechanism
from ..parts import (
    Body,
    Passed,
    Span,
    measure_link,
    move_link,
    move_points,
    normal_of,
    passed_on,
    place_link,
    turn_with,
)


class Leg(Protocol):
    """What the constructions of a triad ask of a leg."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism that it is part of."""

    @property
    def number(self) -> int:
        """Its link."""

    @property
    def before(self) -> int:
        """The link before, to which it joins the central one."""

    @property
    def joint(self) -> str:
        """Its joint with the central link."""

    @property
    def end(self) -> str:
        """A joint or point of its line that the force from the link before goes through."""

    @property
    def line(self) -> str:
        """Direction of its line."""

    @property
    def across(self) -> str:
        """Direction normal to it."""

    @property
    def body(self) -> Body:
        """Return the leg for links attached to it."""

    @property
    def spans(self) -> tuple[Span, ...]:
        """Return the leg if it has two joints."""

    def path(self, board: Board) -> tuple[str, str, str]:
        """Lay down what it leaves to its joint: start, radius of an arc, direction of a line; one of both is `zero`."""

    def place(self, board: Board) -> None:
        """Mark the leg, whose joint is placed."""

    def start(self, plan: str) -> str:
        """Return the mark on a plan of velocities from which the joint's relative motion is drawn."""

    def about(self, point: str) -> tuple[str, str]:
        """Letters of a point's motion and of that mark, or the point's alone where the motion is absolute."""

    def begin_velocity(self, board: Board) -> None:
        """Mark what the plan of velocities starts from."""

    def finish_velocity(self, board: Board) -> None:
        """Read the motion of the leg when that of its joint is found."""

    def begin_acceleration(self, board: Board) -> str:
        """Lay off what is known of the acceleration of the joint; return the end, where `across` is drawn."""

    def finish_acceleration(self, board: Board, end: str) -> None:
        """Read the acceleration of the leg when that of its joint is found."""

    def passed(self) -> Passed:
        """Return the reaction on the link before."""


@dataclass(frozen=True, slots=True)
class Hinged:
    """A leg with two revolute pairs: `span` runs from the outer to the inner one."""

    mechanism: Mechanism
    span: Span
    before: int

    @property
    def number(self) -> int:
        """Its link."""
        return self.span.link.number

    @property
    def joint(self) -> str:
        """Its joint with the central link."""
        return self.span.end

    @property
    def end(self) -> str:
        """Its outer joint."""
        return self.span.start

    @property
    def line(self) -> str:
        """Direction from the outer to the inner joint."""
        return self.span.e

    @property
    def across(self) -> str:
        """Direction normal to it."""
        return self.span.n

    @property
    def body(self) -> Body:
        """Return the leg for links attached to it."""
        return self.span.body(self.span.omega, self.span.epsilon)

    @property
    def spans(self) -> tuple[Span, ...]:
        """The leg has two joints."""
        return (self.span,)

    def path(self, board: Board) -> tuple[str, str, str]:
        """Return the arc of the leg's length about the outer joint."""
        measure_link(board, self.span)
        return self.end, self.span.length, ZERO

    def place(self, board: Board) -> None:
        """Mark its direction and its other points."""
        place_link(board, self.span)

    def start(self, plan: str) -> str:
        """Return the mark of the outer joint."""
        return self.mechanism.mark(plan, self.end)

    def about(self, point: str) -> tuple[str, str]:
        """Return B and A, or B alone about a pivot of the frame."""
        return point, "" if self.end in self.mechanism.frame_points else self.end

    def begin_velocity(self, board: Board) -> None:
        """Do nothing: the outer joint is marked."""

    def finish_velocity(self, board: Board) -> None:
        """Read the velocity of the joint about the outer one; other points by similarity; omega."""
        about = self.about(self.joint)
        board.read(vector("V", *about), self.start("velocity"), f"velocity.{self.joint}")
        move_link(board, self.mechanism, self.span, "velocity")
        board.calc(self.span.omega, "turning", vector("V", *about), self.span.n, self.span.length)

    def begin_acceleration(self, board: Board) -> str:
        """Lay off the normal part towards the outer joint."""
        part, end = vector("a", *self.about(self.joint), "n"), mark("acceleration", self.joint, NORMAL, self.end)
        board.calc(part.size, "normal_part", vector("V", *self.about(self.joint)), self.span.length)
        board.back(end, self.start("acceleration"), self.span.e, part.size)
        board.read(part, self.start("acceleration"), end)
        return end

    def finish_acceleration(self, board: Board, end: str) -> None:
        """Read the tangential part and the whole; other points by similarity; epsilon."""
        about, joint = self.about(self.joint), f"acceleration.{self.joint}"
        board.read(vector("a", *about, "t"), end, joint)
        board.read(vector("a", *about), self.start("acceleration"), joint)
        move_link(board, self.mechanism, self.span, "acceleration")
        board.calc(self.span.epsilon, "turning", vector("a", *about, "t"), self.span.n, self.span.length)

    def passed(self) -> Passed:
        """Return the reaction on the link before, at the outer joint."""
        return passed_on(self.mechanism, self.number, self.before, self.end)


@dataclass(frozen=True, slots=True)
class Sliding:
    """A leg that is a slider, pinned to the central link, in a guide that stands or moves."""

    mechanism: Mechanism
    slide: Slide

    @property
    def number(self) -> int:
        """Its link."""
        return self.slide.link.number

    @property
    def before(self) -> int:
        """The link of the guide."""
        return self.slide.other

    @property
    def joint(self) -> str:
        """Its pin on the central link."""
        return self.slide.pin

    @property
    def end(self) -> str:
        """Its pin, too: the reaction of the guide is moved there, with a couple."""
        return self.slide.pin

    @property
    def line(self) -> str:
        """Direction of the normal to the guide."""
        return normal_of(self.slide.u)

    @property
    def across(self) -> str:
        """Direction of the guide."""
        return self.slide.u

    @property
    def body(self) -> Body:
        """Return the slider for links attached to it."""
        return self.slide.body

    @property
    def spans(self) -> tuple[Span, ...]:
        """The slider has one joint."""
        return ()

    def path(self, board: Board) -> tuple[str, str, str]:
        """Return the line along which the pin runs."""
        return running_line(board, self.slide), ZERO, self.slide.u

    def place(self, board: Board) -> None:
        """Mark its other points."""
        place_slide(board, self.slide)

    def start(self, plan: str) -> str:
        """Return the mark of the guide's point under the pin."""
        return self.slide.mark(plan)

    def about(self, point: str) -> tuple[str, str]:
        """Return B and B4, or B alone when the guide stands."""
        return point, "" if self.slide.known is None else self.slide.under

    def begin_velocity(self, board: Board) -> None:
        """Mark the velocity of the guide's point under the pin."""
        under_velocity(board, self.mechanism, self.slide)

    def finish_velocity(self, board: Board) -> None:
        """Read the sliding; the slider turns like the guide."""
        if self.slide.known is not None:
            pair = vector("V", self.slide.own, self.slide.under)
            board.read(pair, self.start("velocity"), f"velocity.{self.joint}")
        self._others(board, "velocity")

    def begin_acceleration(self, board: Board) -> str:
        """Lay off the acceleration of the guide's point and that of Coriolis."""
        return under_acceleration(board, self.mechanism, self.slide)

    def finish_acceleration(self, board: Board, end: str) -> None:
        """Read the relative part; the slider turns like the guide."""
        if self.slide.known is not None:
            board.read(vector("a", self.slide.own, self.slide.under, "r"), end, f"acceleration.{self.joint}")
        self._others(board, "acceleration")

    def _others(self, board: Board, plan: str) -> None:
        if self.slide.known is not None:
            turn_with(board, self.slide.body, self.slide.known, plan)
        move_points(board, self.mechanism, self.slide.body, plan, (self.joint,))

    def passed(self) -> Passed:
        """Return the reaction on the guide, moved to the pin, with a couple."""
        return passed_on(self.mechanism, self.number, self.before, self.joint, slides=True)
