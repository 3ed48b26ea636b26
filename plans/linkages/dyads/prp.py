"""The dyad of the fourth kind, PRP: two sliders with a common pin on guides of other links, as in a tangent mechanism.

B is the inner revolute pair. Letters with the number of a link, B1, are its points that now lie under B. Determinant of
all its problems: the sine of the angle between the guides.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 4).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...board import Board
from ...names import spelled, vector
from ..guides import Slide, place_slide, running_line, slide_of, under_acceleration, under_velocity
from ..mechanism import ZERO, Mechanism, Prismatic
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
    turn_with,
)
from ..structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one PRP dyad use."""

    mechanism: Mechanism
    name: str
    B: str
    slides: tuple[Slide, Slide]

    @property
    def spans(self) -> tuple[Span, ...]:
        """No link has two joints."""
        return ()

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The links for those attached to them."""
        return self.slides[0].body, self.slides[1].body

    def passed(self) -> tuple[Passed, ...]:
        """Reactions on the links before, moved to B, with couples."""
        numbers = ((slide.link.number, slide.other) for slide in self.slides)
        return tuple(passed_on(self.mechanism, own, other, self.B, slides=True) for own, other in numbers)


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies) -> Dyad:
    """Name the parts of a PRP group.

    Raises
    ------
    InputError
        When the frame is said to be a slider.
    """
    B = group.inner[0].point
    slides = []
    for number, pair in zip(group.links, group.outer, strict=True):
        assert isinstance(pair, Prismatic)
        slides.append(slide_of(mechanism, pair, number, B, bodies))
    return Dyad(mechanism, group.name, B, (slides[0], slides[1]))


def position(board: Board, d: Dyad) -> None:
    """B is where the lines meet along which it runs on both guides."""
    first, second = (running_line(board, slide) for slide in d.slides)
    board.meet(d.B, first, d.slides[0].u, second, d.slides[1].u)
    for slide in d.slides:
        place_slide(board, slide)


def velocity(board: Board, d: Dyad) -> None:
    """Through b1 the parallel to one guide, through b4 that to the other: b."""
    (first, second), b = d.slides, f"velocity.{d.B}"
    for slide in d.slides:
        under_velocity(board, d.mechanism, slide)
    board.meet(b, first.mark("velocity"), first.u, second.mark("velocity"), second.u)
    for slide in d.slides:
        if slide.known is not None:
            board.read(vector("V", slide.own, slide.under), slide.mark("velocity"), b)
    board.read(vector("V", d.B), "velocity.p", b)
    _others(board, d, "velocity")


def acceleration(board: Board, d: Dyad) -> None:
    """From b1' and b4' the accelerations of Coriolis, through their ends the parallels to the guides: b'."""
    (first, second), b = d.slides, f"acceleration.{d.B}"
    ends = [under_acceleration(board, d.mechanism, slide) for slide in d.slides]
    board.meet(b, ends[0], first.u, ends[1], second.u)
    for slide, end in zip(d.slides, ends, strict=True):
        if slide.known is not None:
            board.read(vector("a", slide.own, slide.under, "r"), end, b)
    board.read(vector("a", d.B), "acceleration.p", b)
    _others(board, d, "acceleration")


def _others(board: Board, d: Dyad, plan: str) -> None:
    """Each link turns like the one on which it slides; its other points turn about B."""
    for slide in d.slides:
        if slide.known is not None:
            turn_with(board, slide.body, slide.known, plan)
        move_points(board, d.mechanism, slide.body, plan, (d.B,))


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plan of the group: the loads of both links, through its ends the normals to the guides.

    The inner reaction is a chord of the plan; the moments of each link about B give the arms of the outer ones.
    """
    (first, second), plan, pair = d.slides, spelled("forces", d.name), d.mechanism.pair
    i, j, k, m = first.other, first.link.number, second.link.number, second.other
    board.pole(f"{plan}.0")
    parted = hang(board, plan, [force for force, _ in loads[j]])
    last = hang(board, plan, [force for force, _ in loads[k]], len(loads[j]))
    closing = f"{plan}.{len(loads[j]) + len(loads[k]) + 1}"
    board.meet(closing, last, normal_of(second.u), f"{plan}.0", normal_of(first.u))
    board.read(pair("R", i, j), closing, f"{plan}.0")
    board.read(pair("R", m, k), last, closing)
    board.read(pair("R", k, j), parted, closing)
    answer(board, d.mechanism, "R", (i, j), (k, j), (m, k))
    for other, own in ((i, j), (m, k)):
        moments = moments_about(board, loads[own], d.B)
        board.calc(pair("M", other, own), "closing_moment", ZERO, *moments, *couples[own])
        answer(board, d.mechanism, "M", (other, own))
        board.step("arm", pair("h", other, own), pair("M", other, own), pair("R", other, own))
