"""A mechanism ready for a sweep, and where it can be assembled: stretches of the driver's range, change points.

The driver's variable has its own name, groups of class III are followed from their start to their dead positions.

Every arc and tangent of the position plan has a margin, the square of what the compass has to spare: where it falls
below zero the links come apart. Its zeros are the limiting positions. Where it only touches zero the links lie in line
and may go on in either of two ways: a change point. Where two guides become parallel a joint runs off to infinity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from ..boards.arrays import Along, ArrayBoard, remembering
from ..boards.exact import TANGENT
from ..laws import TURN
from ..names import role
from ..zeros import Stretch, zeros
from .chain import constructed
from .loads import with_sizes
from .mechanism import ZERO, Driver, Mechanism

if TYPE_CHECKING:
    from .following import Follower

Array = NDArray[Any]
SAME = 1e-9  # radians, or parts of a slide's range, within which two places of the driver are one, but for rounding
NEAR_CHANGE, NEAR_LIMIT = 1e-7, 1e-12  # the same: how well change points and limits are known
TURN_CELLS, SLIDE_CELLS = 360, 720  # grid on which a margin is looked at first: a full turn, the range of a slide
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

    def givens(self, values: Mapping[str, Any], places: Any) -> dict[str, Any]:
        """Return the board's givens for places of the driver; `values` hold the ends of the stroke where one counts."""
        near = self.follower.near(np.atleast_1d(places)) if self.follower else {}
        return with_sizes(self.mechanism, {**values, self.variable: places, **near})

    def along(
        self, program: Program, values: Mapping[str, Any], wanted: Sequence[str], board: type[ArrayBoard] = ArrayBoard
    ) -> Along:
        """Return a program of this mechanism, with its loads or without, as a function of the driver's variable."""
        givens = with_sizes(self.mechanism, {**values, self.variable: self.start})
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
        from .following import Follower, triads, with_special_points

        if triads(mechanism):
            follower = Follower(mechanism, {**values, name: start})
            there, places = {**values, name: start}, follower.places
            own = with_special_points(mechanism, there, follower.near(np.array([start])))
            legs = {begin.link: begin.legs for begin in own.starts}  # so that names are those of the task's position
            mechanism = with_special_points(mechanism, {**values, name: places}, follower.near(places), first=legs)
    return Swept(mechanism, name, turns, start, -1.0 if sense < 0.0 else 1.0, follower)


@dataclass(frozen=True, slots=True)
class Arc:
    """A part of the driver's range, from `low` to `high`: radians of a crank, metres of a slide."""

    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Reach:
    """Where a mechanism can be assembled.

    `stretches` are regular inside: they end at limiting positions, at `changes`, where links lie in line, and at
    `poles`, where guides are parallel. `apart` are the arcs between them that cannot be reached, `limits` the limiting
    positions.
    """

    whole: Stretch
    stretches: tuple[Stretch, ...]
    apart: tuple[Arc, ...]
    changes: tuple[float, ...]
    poles: tuple[float, ...]
    limits: tuple[float, ...] = ()

    @property
    def free(self) -> bool:
        """Whether a crank turns round without anything in its way."""
        return self.whole.closed and not (self.apart or self.changes or self.poles)

    def around(self, place: float) -> tuple[Stretch, ...]:
        """Return the stretches without an unreachable arc between them among which `place` is, or the longest such."""
        parts: list[list[Stretch]] = []
        for stretch in sorted(self.stretches, key=lambda stretch: stretch.low):
            if parts and parts[-1][-1].high == stretch.low:
                parts[-1].append(stretch)
            else:
                parts.append([stretch])
        if self.whole.closed and len(parts) > 1 and parts[-1][-1].high == parts[0][0].low + self.whole.length:
            parts[-1] += parts.pop(0)
        within = [part for part in parts if any(self._holds(stretch, place) for stretch in part)]
        return tuple(max(within or parts, key=lambda part: sum(stretch.length for stretch in part)))

    def trimmed(self, beside: float) -> tuple[Stretch, ...]:
        """Return the stretches less a little beside change points; without those that are hardly longer."""
        trimmed = []
        turn, same = (TURN, SAME) if self.whole.closed else (0.0, SAME * self.whole.length)
        for stretch in self.stretches:
            offs = [[abs(end - change) for change in self.changes] for end in (stretch.low, stretch.high)]
            low, high = (beside if any(min(x, abs(x - turn)) < same for x in off) else 0.0 for off in offs)
            if not (low or high):
                trimmed.append(stretch)
            elif stretch.length > 4.0 * beside:
                trimmed.append(stretch.part(stretch.low + low, stretch.high - high))
        return tuple(trimmed)

    def undetermined(self, places: Array) -> NDArray[np.bool_]:
        """Tell which places are those of change points or limits, but for rounding: they have no plan of velocities.

        Links in line leave the motion undetermined. The angle between them is a root of the rounding there, small but
        not zero, and what is computed with it means nothing.
        """
        turns, found = self.whole.closed, np.zeros(places.shape, bool)
        for spots, near in ((self.changes, NEAR_CHANGE), (self.limits, NEAR_LIMIT)):
            for off in (places - spot for spot in spots):
                away = np.minimum(off % TURN, -off % TURN) if turns else np.abs(off)
                found |= away <= near * (1.0 if turns else self.whole.length)
        return found

    def _holds(self, stretch: Stretch, place: float) -> bool:
        if self.whole.closed:
            return (place - stretch.low) % self.whole.length <= stretch.length
        return stretch.low <= place <= stretch.high


class MarginBoard(ArrayBoard):
    """An array board that notes what every arc has to spare, and the sine of every two lines that meet."""

    def __init__(self, givens: Mapping[str, Any], size: int) -> None:
        super().__init__(givens, size)
        self.margins: dict[str, Any] = {}

    def restart(self, givens: Mapping[str, Any], codes: NDArray[np.int8]) -> None:
        """Begin with other positions and a new list of margins."""
        super().restart(givens, codes)
        self.margins = {}

    def _reaches(self, square: Any, radius: Any, distance: Any, *places: Any) -> Any:
        self.margins[self._name] = square + TANGENT * radius * radius
        return super()._reaches(square, radius, distance, *places)

    def _assembles(self, product: Any, first: Any, second: Any, base: Any, total: Any, *places: Any) -> Any:
        self.margins[self._name] = product + 2.0 * TANGENT * total * total * first * second
        return super()._assembles(product, first, second, base, total, *places)

    def _lines_sine(self, sine: Any) -> Any:
        self.margins[self._name] = sine
        return super()._lines_sine(sine)


def reach_of(drive: Swept, values: Mapping[str, float], between: Arc | None = None) -> Reach:
    """Find where in its driver's range a mechanism can be assembled.

    Of its numbers in SI that of the driver's variable does not matter for a crank, and for a slide only as the middle
    of the range that is searched; without `between` that is as far as its links could reach. Limits and change points
    are known to the rounding of the margins, better than 1e-12 rad; limits near a change point, which are nearly double
    zeros, than 1e-9 rad.
    """
    _, program = constructed(drive.mechanism.without_loads, ("position",))
    position = drive.along(program, values, program.names, MarginBoard)
    whole = _range(drive, values, between)
    if position.status in ("no-assembly", "singular"):
        return Reach(whole, (), _gaps(whole, ()), (), ())
    stretches, changes, poles = _followed(drive, whole), list[float](), list[float]()

    @remembering
    def margins(at: Array) -> Mapping[str, Array]:
        board = position.run(at)
        assert isinstance(board, MarginBoard)
        return board.margins

    for step in position.steps:
        if step.verb in ("arc", "arcs", "tangent", "meet"):
            parts = [_split(margins, step.name, step.verb == "meet", stretch) for stretch in stretches]
            stretches = [piece for pieces, _ in parts for piece in pieces]
            (poles if step.verb == "meet" else changes).extend(place for _, cuts in parts for place in cuts)
    if drive.turns:
        changes, poles = ([0.0 if TURN - x % TURN < SAME else x % TURN for x in places] for places in (changes, poles))
    apart = _gaps(whole, stretches)
    ends = set() if whole.closed else {whole.low, whole.high}
    limits = {end for arc in apart for end in (arc.low, arc.high)} - ends
    return Reach(whole, tuple(stretches), apart, tuple(sorted(changes)), tuple(sorted(poles)), tuple(sorted(limits)))


def _followed(drive: Swept, whole: Stretch) -> list[Stretch]:
    """Return the part of the range that groups of class III leave: as far as they can be followed from their start."""
    if drive.follower is None:
        return [whole]
    limits = drive.follower.limits(TURN if drive.turns else whole.length)
    if limits is None:
        return []
    low, high = limits
    if not drive.turns:
        return [whole.part(max(low, whole.low), min(high, whole.high))]
    return [whole] if high - low >= 2.0 * TURN else [whole.part(max(low, high - TURN), high)]


def full_turn() -> Stretch:
    """Return the range of a crank that goes round."""
    return Stretch(0.0, TURN, TURN / TURN_CELLS, closed=True)


def _range(drive: Swept, values: Mapping[str, float], between: Arc | None) -> Stretch:
    """Return a full turn of a crank, or the range of a slide: twice as far as all its links together reach."""
    if drive.turns:
        return full_turn()
    if between is not None:
        return Stretch(between.low, between.high, (between.high - between.low) / SLIDE_CELLS)
    far = 2.0 * size_of(drive.mechanism, values)
    return Stretch(drive.start - far, drive.start + far, 2.0 * far / SLIDE_CELLS)


def size_of(mechanism: Mechanism, values: Mapping[str, float]) -> float:
    """Return a length that no distance in the mechanism exceeds: all coordinates that it names, together."""
    names = [*mechanism.coordinates, *(name for pair in mechanism.pairs for name in pair.coordinates)]
    return math.fsum(abs(values.get(name, 0.0)) for name in set(names)) or 1.0  # the same in any order


def _split(
    margins: Callable[[Array], Mapping[str, Array]], name: str, lines: bool, stretch: Stretch
) -> tuple[list[Stretch], list[float]]:
    """Cut a stretch where the margin of one step changes its sign or touches zero; keep the parts that assemble."""

    def margin(at: Array) -> Array:
        found = np.broadcast_to(margins(at)[name], at.shape)
        return np.where(np.isnan(found), 0.0, found)  # two pins coincide: nothing is left to spare

    roots, touches = zeros(margin, stretch)
    cuts = np.sort(np.concatenate((roots, touches)))
    pieces = _between(stretch, cuts.tolist())
    if lines:
        return pieces, cuts.tolist()
    middles = np.array([0.5 * (piece.low + piece.high) for piece in pieces])
    held = margin(middles) >= 0.0
    pieces = [piece for piece, holds in zip(pieces, held, strict=True) if holds]
    ends = {end for piece in pieces for end in (piece.low, piece.high)}
    return pieces, [x for x in touches.tolist() if not ends.isdisjoint((x, x + TURN))]


def _between(stretch: Stretch, cuts: list[float]) -> list[Stretch]:
    """Return the parts of a stretch between cuts; a closed one begins and ends at the first cut."""
    if not cuts:
        return [stretch]
    ends = [*cuts, cuts[0] + stretch.length] if stretch.closed else [stretch.low, *cuts, stretch.high]
    return [stretch.part(low, high) for low, high in pairwise(ends) if high > low]


def _gaps(whole: Stretch, stretches: Iterable[Stretch]) -> tuple[Arc, ...]:
    """Return what the stretches leave of the whole range."""
    ordered = sorted(stretches, key=lambda stretch: stretch.low)
    lows, highs = [stretch.low for stretch in ordered], [stretch.high for stretch in ordered]
    if whole.closed and ordered:
        gaps = zip(highs, [*lows[1:], lows[0] + whole.length], strict=True)
        return tuple(Arc(low % TURN, low % TURN + (high - low)) for low, high in gaps if high > low)
    gaps = zip([whole.low, *highs], [*lows, whole.high], strict=True)
    return tuple(Arc(low, high) for low, high in gaps if high > low)


def limiting_places(mechanism: Mechanism, values: Mapping[str, float]) -> tuple[float | None, float | None] | None:
    """Return the places of the driver, below and above the given one, from which on the mechanism can be assembled.

    They are radians within one turn of the given angle, or metres of a slide, where None stands for no such place; None
    for both when there is no place at all.
    """
    drive = swept(mechanism, values)
    found = reach_of(drive, values)
    if not found.stretches:
        return None
    lows, highs = ([getattr(stretch, end) for stretch in found.stretches] for end in ("low", "high"))
    if not drive.turns:
        below, above = [x for x in highs if x <= drive.start], [x for x in lows if x >= drive.start]
        return max(below, default=None), min(above, default=None)
    below, above = [(x - drive.start) % TURN - TURN for x in highs], [(x - drive.start) % TURN for x in lows]
    return drive.start + max(below), drive.start + min(above)
