"""The methods by which a user could find the motion of a mechanism, each as a function of the driver's places.

Plans in several precisions; Newton's method on closed contours; finite differences of positions; graphical
differentiation by chords. All give the same quantities, so that their errors and times can stand in one chart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import Program
from ...boards.batch import batch
from ...boards.exact import STATUSES
from ...boards.precision import batch_in
from ...contest import Kind
from ...laws import inclination
from ...names import LEVER, role
from ...quantities import BALANCES
from ..chain import construct, moving_bodies
from ..cycles.cycle import Cycle
from ..cycles.diagrams import chords
from ..mechanism import Driver
from ..parts import Bodies
from .contours import Closure, Pose

Array = NDArray[Any]
Values = dict[str, Array]
Way = Callable[[Array, Sequence[str]], Values]
PLANNED = tuple(name for name in BALANCES if name.part != LEVER)  # what force plans give
GRID = 72  # places round the cycle at which Newton's method knows where the links lie
ORDERS = {"V": 1, "omega": 1, "a": 2, "epsilon": 2}  # how many times a quantity is a derivative of a place


def kinds_of(cycle: Cycle, chosen: Iterable[str] = ()) -> tuple[Kind, ...]:
    """Return the quantities of a cycle that are compared, kind by kind.

    Those are velocities and accelerations of points, angular ones of links, reactions and what balances the driver;
    of them the `chosen` ones only.
    """
    chosen = tuple(chosen)
    known = [name for name in cycle.quantities if not chosen or name in chosen]
    points = {point for link in cycle.mechanism.links for point in link.points}
    links = {str(link.number) for link in cycle.mechanism.links}
    known_of = {"V": points, "omega": links, "a": points, "epsilon": links}
    rates = [
        name
        for name in known
        if not role(name).about + role(name).part and role(name).of in known_of.get(role(name).kind, ())
    ]
    orders = {"velocity": 1, "acceleration": 2}
    found = {kind: tuple(name for name in rates if _order(name) == order) for kind, order in orders.items()}
    found["forces"] = tuple(name for name in known if role(name).kind == "R" or name in PLANNED)
    return tuple(Kind(kind, names) for kind, names in found.items() if names)


@dataclass(frozen=True, slots=True, eq=False)
class Rivals:
    """A mechanism over its cycle, ready for all methods."""

    cycle: Cycle
    bodies: Bodies
    bare: Program = field(repr=False)  # positions alone

    @classmethod
    def of(cls, cycle: Cycle) -> Rivals:
        """Prepare the methods for a cycle."""
        _, program = construct(cycle.mechanism, ("position",))
        return cls(cycle, moving_bodies(cycle.mechanism, cycle.structure), program)

    @property
    def speed(self) -> float:
        """Speed of the driver with its sign, rad/s or m/s."""
        return self._rate(self.cycle.mechanism.driver.speed)

    @property
    def acceleration(self) -> float:
        """Acceleration of the driver with its sign."""
        name = self.cycle.mechanism.driver.acceleration
        return self._rate(name) if name else 0.0

    def _rate(self, name: str) -> float:
        driver, given = self.cycle.mechanism.driver, {"one": 1.0, "zero": 0.0, **self.cycle.givens}
        return float(given[name]) * (float(given[driver.sense]) if isinstance(driver, Driver) else 1.0)

    # Plans.

    def plan(self, places: Array, names: Sequence[str], precision: str = "double") -> Values:
        """Return quantities by plans in a precision, many positions at once."""
        givens = self.cycle.drive.givens(self.cycle.givens, places, self.cycle.program)
        return batch_in(self.cycle.program, givens, tuple(names), precision)[0]

    # Positions, differentiated.

    def differences(self, step: float) -> Way:
        """Return central differences of positions by plans; `step` is in radians, of a slide a part of its range."""
        step = step if self.cycle.drive.turns else step * abs(self.cycle.range.high - self.cycle.range.low)

        def found(places: Array, names: Sequence[str]) -> Values:
            offsets = (-step, step) if all(_order(name) == 1 for name in names) else (-step, 0.0, step)
            laid = [self._laid(places + offset, names) for offset in offsets]
            return {name: self._differentiated(name, [one[name] for one in laid], step) for name in names}

        return found

    def chords(self, sections: int) -> Way:
        """Return slopes of the chords of a drawn curve over so many sections of the cycle, and chords of these.

        A velocity belongs to the middle of its section, an acceleration to the end of two: both as if the sections lay
        there.
        """
        section = abs(self.cycle.range.high - self.cycle.range.low) / sections

        def found(places: Array, names: Sequence[str]) -> Values:
            slopes: Values = {}
            for order, offsets in ((1, (-0.5, 0.5)), (2, (-1.0, 0.0, 1.0))):
                wanted = [name for name in names if _order(name) == order]
                laid = [self._laid(places + offset * section, wanted) for offset in offsets] if wanted else []
                for name in wanted:
                    slopes[name] = self._sloped(name, np.stack([one[name] for one in laid]), section)[0]
            return slopes

        return found

    def chords_of_cycle(self, sections: int, names: Sequence[str]) -> Values:
        """Return the same for a whole cycle, whose sections share their ends: the work of it, to be timed."""
        low, high = self.cycle.range.low, self.cycle.range.high
        ends = low + (high - low) * (np.arange(-1, sections + 2) / sections)
        laid = self._laid(ends, names)
        section = abs(high - low) / sections
        return {name: self._sloped(name, laid[name], section) for name in names}

    def _sloped(self, name: str, curve: Array, section: float) -> Array:
        """Return rates of a curve by chords, along its first axis."""
        if _turns(name):
            curve = _unwound(curve)
        slopes = chords(curve, section)
        found: Array = slopes * self.speed
        if _order(name) == 2:
            middles = (slopes[1:] + slopes[:-1]) * 0.5
            found = chords(slopes, section) * self.speed**2 + middles * self.acceleration
        return found

    def _differentiated(self, name: str, laid: Sequence[Array], step: float) -> Array:
        curve = _unwound(np.stack(laid)) if _turns(name) else np.stack(laid)
        first = (curve[-1] - curve[0]) * (0.5 / step)
        found: Array = first * self.speed
        if _order(name) == 2:
            second = (curve[2] - curve[1] - (curve[1] - curve[0])) * (1.0 / step**2)
            found = second * self.speed**2 + first * self.acceleration
        return found

    def _laid(self, places: Array, names: Sequence[str]) -> Values:
        """Return where the point of each quantity stands, or the direction of its link."""
        marks = {name: role(name).of for name in names}
        marks |= {name: self.bodies[int(of)].direction for name, of in marks.items() if _turns(name)}
        givens = self.cycle.drive.givens(self.cycle.givens, places)
        wanted = tuple(dict.fromkeys(marks.values()))
        values, codes = batch(self.bare, givens, wanted)
        fails = codes == STATUSES.index("no-assembly")
        return {name: np.where(fails, np.nan, values[mark]) for name, mark in marks.items()}


def _order(name: str) -> int:
    return ORDERS[role(name).kind]


def _turns(name: str) -> bool:
    return role(name).kind in ("omega", "epsilon")


def _unwound(directions: Array) -> Array:
    """Return angles along the first axis without jumps, from the first one on."""
    turns = inclination(directions[1:] * np.conj(directions[:-1]))
    return np.concatenate((np.zeros_like(turns[:1]), np.cumsum(turns, axis=0)))


class Newton:
    """Newton's method on closed contours; it starts from where the links lie at a place of a grid nearby."""

    def __init__(self, rivals: Rivals) -> None:
        cycle = rivals.cycle
        self._rivals, self._closure = rivals, Closure(cycle.mechanism, cycle.givens)
        self._low, self._range = cycle.range.low, cycle.range.high - cycle.range.low
        self._turns = cycle.drive.turns
        self._grid = self._poses(self._low + self._range * ((np.arange(GRID) + 0.5) / GRID))

    def _poses(self, places: Array) -> Pose:
        cycle, bodies = self._rivals.cycle, self._rivals.bodies
        points = [point for link in cycle.mechanism.links for point in link.points]
        names = [mark for body in bodies.values() for mark in (body.direction, body.local) if mark]
        wanted = tuple(name for name in dict.fromkeys((*names, *points)) if name in cycle.program.names)
        found = cycle.at(places, wanted)
        directions = {
            number: found[body.direction] * (np.conj(found[body.local]) if body.local else 1.0)
            for number, body in bodies.items()
        }
        return self._closure.contours.pose(directions, found)

    def near(self, places: Array) -> Pose:
        """Return where the links lie at a place of the grid from half a step to one and a half before each place."""
        which = np.floor((places - self._low) * (GRID / self._range) - 1.0).astype(int)
        return self._grid.at(which % GRID if self._turns else np.clip(which, 0, GRID - 1))

    def way(self, tolerance: float) -> Way:
        """Return the method with a tolerance."""

        def found(places: Array, names: Sequence[str]) -> Values:
            closure, rivals = self._closure, self._rivals
            pose = closure.solve(self.near(places), places, tolerance)
            rates = closure.rates(pose, rivals.speed)
            changes = None
            if any(_order(name) == 2 for name in names):
                changes = closure.changes(pose, rates, rivals.acceleration)
            return {name: self._quantity(name, pose, rates, changes) for name in names}

        return found

    def _quantity(self, name: str, pose: Pose, rates: Pose, changes: Pose | None) -> Array:
        contours, of = self._closure.contours, role(name).of
        if _turns(name):
            poses = rates if _order(name) == 1 else changes
            assert poses is not None
            row: Array = poses.angles[contours.angle_of[int(of)]]
            return row
        if _order(name) == 1:
            return contours.rate(contours.point(of), pose, rates)
        assert changes is not None
        return contours.change(contours.point(of), pose, rates, changes)
