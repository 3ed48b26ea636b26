"""Graphical integration by chords, on the board: from acceleration to velocity, to the travel.

Three diagrams stand on one axis of angles, divided into sections. The mean ordinate of every section is projected on
the ordinate axis and joined to a pole at the distance H to the left of it; on the next diagram the chord of the section
is drawn parallel to that ray, from the end of the chord before it to the next section line. All of it is drawn in
millimetres of paper: scale factors come from it, not before it.

Marks, on the plans `diagram_a`, `diagram_v`, `diagram_s`: `0` the origin, where the curve begins; `1`, `2`, ... the
nodes of the curve on the section lines; `f1` the foot of a section line; on a diagram that is integrated `O` the pole,
`m1` the mean ordinate of the first section, `p1` its projection; `ray(plan, 1)` names the direction of the ray.

Source: Artobolevsky, Theory of mechanisms and machines, graphical integration (method of chords).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from ..board import Board
from ..names import Name


@dataclass(frozen=True, slots=True)
class Division:
    """Numbers of section lines: the rise runs from 0 to `top`, the upper dwell to `leave`, the fall to `last`.

    The lower dwell is the rest of the turn; nothing changes in it, so that it has no sections. `jumps` are the lines
    within a phase at which the acceleration jumps.
    """

    top: int
    leave: int
    last: int
    jumps: tuple[int, ...] = ()

    @property
    def lines(self) -> range:
        """All section lines."""
        return range(self.last + 1)

    @property
    def sections(self) -> range:
        """All sections; each has the number of the line at its end."""
        return range(1, self.last + 1)

    @property
    def rise(self) -> range:
        """Lines of the rise, both ends among them."""
        return range(self.top + 1)

    @property
    def fall(self) -> range:
        """Lines of the fall, both ends among them."""
        return range(self.leave, self.last + 1)

    def pieces(self, phase: str) -> tuple[range, ...]:
        """Return the lines of the `rise` or the `fall`, between jumps: of each piece both ends are among them."""
        lines = self.rise if phase == "rise" else self.fall
        ends = sorted({lines[0], *(line for line in self.jumps if line in lines), lines[-1]})
        return tuple(range(a, b + 1) for a, b in pairwise(ends))


ACCELERATION, VELOCITY, TRAVEL = "diagram_a", "diagram_v", "diagram_s"
DIAGRAMS = (ACCELERATION, VELOCITY, TRAVEL)
RIGHT, UP = "_right", "_up"


def foot(plan: str, line: int) -> str:
    """Return the mark where a section line meets the axis of angles."""
    return f"{plan}.f{line}" if line else f"{plan}.0"


def ray(plan: str, section: int) -> str:
    """Return the name of the direction of a section's ray on the diagram that is integrated."""
    return f"_{plan}_ray{section}"


def mean(section: int) -> Name:
    """Return the name of the mean ordinate of a section on the given diagram."""
    return Name(f"_mean{section}", "mean", str(section))


def axes(board: Board, plan: str, sections: Iterable[int]) -> None:
    """Draw the axes of a diagram and its section lines."""
    board.pole(f"{plan}.0")
    for i in sections:
        board.calc(f"_x{i}", "on_axis", f"_phi{i}", "mu_phi")
        board.lay(foot(plan, i), f"{plan}.0", RIGHT, f"_x{i}")


def given_means(board: Board, plan: str, sections: Iterable[int]) -> None:
    """Mark on the given diagram the mean ordinate of every section, in its middle."""
    for i in sections:
        board.calc(f"_middle{i}", "on_axis", f"_phi_middle{i}", "mu_phi")
        board.calc(mean(i), "part_of_amplitude", "l_A1", f"_part{i}")
        board.place(f"{plan}.m{i}", f"_middle{i}", mean(i))


def drawn_means(board: Board, plan: str, sections: Iterable[int]) -> None:
    """Mark on a curve of chords the mean ordinate of every section: the middle of the chord."""
    for i in sections:
        board.divide(f"{plan}.m{i}", f"{plan}.{i - 1}", f"{plan}.{i}", "one", "_two")


def integrate(board: Board, plan: str, onto: str, pole_distance: str, sections: Iterable[int]) -> None:
    """Integrate the diagram `plan`, whose mean ordinates are marked, by chords onto the diagram `onto`."""
    origin, pole = f"{plan}.0", f"{plan}.O"
    board.back(pole, origin, RIGHT, pole_distance)
    for i in sections:
        projection, length = f"{plan}.p{i}", f"_{plan}_l{i}"
        board.meet(projection, f"{plan}.m{i}", RIGHT, origin, UP)
        board.measure(length, pole, projection)
        board.direction(ray(plan, i), pole, projection, length)
        board.meet(f"{onto}.{i}", f"{onto}.{i - 1}", ray(plan, i), foot(onto, i), UP)


def diagrams(board: Board, sections: range, given: str = ACCELERATION) -> None:
    """Draw the diagrams from the one that is given on: the analogue of acceleration, or that of velocity."""
    board.turn(RIGHT, "zero")
    board.normal(UP, RIGHT)
    for plan in DIAGRAMS[DIAGRAMS.index(given) :]:
        axes(board, plan, sections)
    given_means(board, given, sections)
    if given == ACCELERATION:
        integrate(board, ACCELERATION, VELOCITY, "H_a", sections)
        drawn_means(board, VELOCITY, sections)
    integrate(board, VELOCITY, TRAVEL, "H_v", sections)
