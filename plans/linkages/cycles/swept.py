"""A mechanism ready for a sweep: the driver's variable has its own name, groups of class III are followed.

A sweep tells how far sliders run along their guides while the driver goes through its cycle: guides are drawn so long.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...along import Along
from ...board import Program
from ...boards.arrays import ArrayBoard
from ...laws import TURN, dot
from ...names import role
from ..chain import constructed
from ..givens import board_givens
from ..mechanism import ZERO, Driver, Mechanism, Prismatic
from ..solved import SolvedLinkage

if TYPE_CHECKING:
    from ..triads.following import Follower

Runs = Mapping[str, tuple[float, float]]
Array = NDArray[Any]
POSITIONS = 72
SWAY = 0.3  # part of the mechanism's size by which a sliding driver is moved to and fro
LEAP = 0.12  # part of that size which no slider runs between two positions, unless the guides are nearly parallel
OWN = "_driver"  # the driver's variable where the mechanism has a literal in its place


@dataclass(frozen=True, slots=True)
class Swept:
    """A mechanism whose driver's variable may be swept: an angle that turns round, or the travel of a slide.

    `follower` knows where groups of class III lie at places of the driver.
    """

    mechanism: Mechanism
    variable: str
    turns: bool
    start: float  # the variable's value as given
    sense: float  # of the driver's motion, +1 or -1
    follower: Follower | None = field(default=None, repr=False)

    def givens(
        self, values: Mapping[str, Any], places: Any, program: Program | None = None, mechanism: Mechanism | None = None
    ) -> dict[str, Any]:
        """Return the board's givens for places of the driver; `mechanism` is this one in another form."""
        near = self.follower.near(np.atleast_1d(places)) if self.follower else {}
        there = {**values, self.variable: places, **near}
        return board_givens(mechanism or self.mechanism, there, program, follow=False)

    def along(
        self,
        program: Program,
        values: Mapping[str, Any],
        wanted: Sequence[str],
        board: type[ArrayBoard] = ArrayBoard,
        mechanism: Mechanism | None = None,
    ) -> Along:
        """Return a program of `mechanism`, this one in any form, as a function of the driver's variable."""
        there = {**values, self.variable: self.start}
        givens = board_givens(mechanism or self.mechanism, there, program, follow=False)
        return Along(program, givens, self.variable, wanted, board, self.follower.near if self.follower else None)


def swept(mechanism: Mechanism, values: Mapping[str, float]) -> Swept:
    """Return `mechanism` ready for a sweep.

    A literal may stand in other places too, so that the driver gets a variable of its own; a given that also stands
    elsewhere, as the direction of a load, changes there as well. The special points of triads are made by the legs that
    make them in the task's own position, where these do for the whole circle; else by others that do.
    """
    driver = mechanism.driver
    turns = isinstance(driver, Driver)
    name = driver.coordinate
    start = float(values.get(name, 0.0))
    sense = values.get(driver.sense, 1.0) if isinstance(driver, Driver) else values.get(driver.speed, 1.0)
    if name == ZERO or role(name).hidden:
        name = OWN
        key = "angle" if turns else "travel"
        mechanism = replace(mechanism, driver=replace(driver, **{key: name}))  # type: ignore[arg-type]
    follower = None
    if mechanism.starts:  # few mechanisms have groups of class III
        from ..triads.following import Follower, triads, with_special_points

        if triads(mechanism):
            follower = Follower(mechanism, {**values, name: start})
            there, places = {**values, name: start}, follower.places
            own = with_special_points(mechanism, there, follower.near(np.array([start])))
            legs = {begin.link: begin.legs for begin in own.starts}  # so that names are those of the task's position
            mechanism = with_special_points(mechanism, {**values, name: places}, follower.near(places), first=legs)
    return Swept(mechanism, name, turns, start, -1.0 if sense < 0.0 else 1.0, follower)


def slider_runs(solved: SolvedLinkage) -> Runs:
    """Return for each guide how far the slider's point runs back (negative) and forth from its place now, metres."""
    pairs = [pair for pair in solved.mechanism.pairs if isinstance(pair, Prismatic)]
    if not pairs:
        return {}
    drive = swept(solved.mechanism, solved.givens)
    free = drive.mechanism.without_loads
    _, program = constructed(free, ("position",))
    # a slider's way is measured from a point of the guide's link, from none on the frame
    first = {link.number: next(iter(link.points)) for link in solved.mechanism.links}
    marks = {solved.guide_name(pair): (pair.point, first.get(pair.links[1], "")) for pair in pairs}
    wanted = sorted({mark for u, (point, at) in marks.items() for mark in (u, point, at) if mark})
    steps = np.arange(-POSITIONS // 2, POSITIONS // 2 + 1) * (1.0 / POSITIONS)
    size = solved.extent
    whole = TURN if isinstance(solved.mechanism.driver, Driver) else 2.0 * SWAY * size
    places: Array = drive.start + steps * whole
    moved = drive.along(program, solved.givens, wanted, mechanism=free)(places)
    ways = {u: moved[point] - moved[at] if at else moved[point] for u, (point, at) in marks.items()}
    return {u: _run(dot(way, moved[u]), LEAP * size) for u, way in ways.items()}


def _run(along: Array, leap: float) -> tuple[float, float]:
    """Return how far it goes back and forth from the middle position, without a leap and while it can be assembled."""
    middle = len(along) // 2
    steps = np.abs(np.diff(along))
    stops = np.flatnonzero(~(steps < leap))
    first = int(max((k + 1 for k in stops if k < middle), default=0))
    last = int(min((k for k in stops if k >= middle), default=len(along) - 1))
    way = along[first : last + 1] - along[middle]
    return float(way.min()), float(way.max())
