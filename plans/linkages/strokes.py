"""Strokes of the output links: dead positions, from where to where a link moves, how long the working stroke takes.

An output is a link on the frame that does not drive: a slider, whose place is its travel along the guide, or a rocker,
whose place is its angle. It stands dead where its velocity is zero; only the geometry of the mechanism matters, so that
the driver moves at unit speed here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ...scales.kept import Kept
from ..board import Program, Step
from ..boards.arrays import CODES, remembering
from ..laws import TURN, inclination
from ..zeros import Stretch, dipping, refined, zeros
from .chain import constructed, moving_bodies
from .limits import MarginBoard, Reach, Swept, full_turn, reach_of, size_of, swept
from .loads import BEGIN, END
from .mechanism import FRAME, ZERO, Driver, Mechanism, Prismatic, start_names
from .structure import Structure

Array = NDArray[Any]
INSIDE = 1e-14  # part of a stretch by which its end may lie beyond a limit of assembly, by rounding
_STROKES = Kept[Any](64)  # from where to where outputs move
FEWEST, AT_ONCE = 8, 64  # mechanisms whose strokes are found together at least, and at most
FAR = 1e3  # how much faster than still a slider has to be to count as moving without a closer look
STILL = 1e-9  # part of the usual velocity below which an output stands still for good


@dataclass(frozen=True, slots=True)
class Output:
    """A link on the frame: the names by which its place, velocity and acceleration are known; None for no motion.

    `place` is the travel of a slider along its guide, from the point through which it passes; of a rocker it names a
    unit direction that turns with it.
    """

    link: int
    slides: bool
    place: str
    rate: str | None
    change: str | None
    steps: tuple[Step, ...] = ()

    @property
    def unit(self) -> str:
        """Unit of its places: metres of a slider, radians of a rocker."""
        return "m" if self.slides else "rad"

    def places(self, values: Mapping[str, Array]) -> Array:
        """Return its places in successive positions, angles without jumps."""
        if self.slides:
            return values[self.place]
        return unwound(inclination(values[self.place]))


@dataclass(frozen=True, slots=True)
class _Travel:
    """From where to where an output moves, metres or radians, and the places of the driver there."""

    low: float
    high: float
    angle_low: float
    angle_high: float

    @property
    def length(self) -> float:
        """Length of the stroke."""
        return self.high - self.low


@dataclass(frozen=True, slots=True)
class _Dead:
    """A dead position: the driver's angle (travel of a sliding driver), the output's place, and which end it is."""

    angle: float
    place: float
    high: bool


@dataclass(frozen=True, slots=True)
class OutputMotion:
    """How an output moves over the driver's range; `travel` is None when it goes round and round.

    Where the driver cannot turn round, `travel` is that of the part of its range in which it stands.

    `ratio` is the time of the working stroke to that of the idle one at constant speed of the crank; without a stated
    working stroke the slower one is taken for it.
    """

    output: Output
    dead: tuple[_Dead, ...]
    travel: _Travel | None
    ratio: float | None


def unwound(angles: Array) -> Array:
    """Return angles of successive positions without jumps by whole turns, those of failed positions left out."""
    known = np.isfinite(angles)
    out = angles.copy()
    out[known] = np.unwrap(angles[known])
    return out


def outputs(mechanism: Mechanism, structure: Structure) -> tuple[Output, ...]:
    """Return the links on the frame that do not drive, in order of attachment."""
    bodies = moving_bodies(mechanism, structure)
    found = []
    for pair in (pair for group in structure.groups for pair in group.outer if FRAME in pair.links):
        link = next(number for number in pair.links if number != FRAME)
        if isinstance(pair, Prismatic):
            found.append(_slider(pair, link))
        else:
            found.append(Output(link, False, bodies[link].direction, bodies[link].omega, bodies[link].epsilon))
    return tuple(found)


def _slider(pair: Prismatic, link: int) -> Output:
    """Return a slider on the frame, with steps that measure its motion along the guide."""
    axis, start, point = f"_axis_{link}", f"_axis_{link}_start", pair.point
    steps = (
        Step("turn", axis, (pair.direction,)),
        Step("place", start, pair.through),
        Step("calc", f"_s_{link}", (axis, start, point), "along_axis"),
        Step("calc", f"_V_{link}", (axis, "velocity.p", f"velocity.{point}"), "along_axis"),
        Step("calc", f"_a_{link}", (axis, "acceleration.p", f"acceleration.{point}"), "along_axis"),
    )
    return Output(link, True, f"_s_{link}", f"_V_{link}", f"_a_{link}", steps)


def measured(program: Program, found: Sequence[Output]) -> Program:
    """Return a program that also measures the motion of outputs, as far as its plans go."""
    known, more = set(program.names), (step for output in found for step in output.steps)
    steps = (step for step in more if all(operand in known or "." not in operand for operand in step.operands))
    return Program((*program.steps, *steps))


def stroke_of(mechanism: Mechanism, values: Mapping[str, float]) -> _Travel:
    """Return from where to where the output of `mechanism.stroke` moves; without it, the first that has a stroke.

    Masses and loads are not needed. NaN all through where the mechanism cannot be assembled in any position: its plan
    of positions says why.

    Raises InputError: when the link does not move to and fro on the frame.
    """
    drive = swept(mechanism, values)
    found = reach_of(drive, values)
    if not found.stretches:
        return _Travel(math.nan, math.nan, math.nan, math.nan)
    wanted = mechanism.stroke.link if mechanism.stroke else None
    travels = (motion.travel for motion in output_motions(drive, values, found, wanted) if motion.travel is not None)
    if travel := next(travels, None):
        return travel
    raise InputError("stroke-none", link=FRAME if wanted is None else wanted)


def stroke_ends(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Find the ends of the working stroke: once for all rows of arrays that have the same lengths.

    How fast the driver moves, and where it stands, does not matter. The ends are kept, for sweeps, charts and sheets
    ask for them again at each position.
    """
    assert mechanism.stroke is not None
    sense, driver_at = mechanism.stroke.sense, mechanism.driver.coordinate
    followed = {name for start in mechanism.starts for name in start_names(start.link)}
    stated = {name for start in mechanism.starts for name in (start.x, start.y, start.angle, start.driver)}
    motion = constructed(_steady(mechanism), ("velocity",))[1].needs
    needed = {name: values[name] for name in {*motion, sense, *stated} & values.keys() - {driver_at} - followed}
    varying = {name: np.asarray(value) for name, value in needed.items() if np.ndim(value)}
    firsts, rows = _distinct([*varying.values()]) if varying else ([0], None)
    chosen = {name: column[firsts] for name, column in varying.items()}
    low, high = _plain_strokes(mechanism, needed | chosen, len(firsts))
    written = repr(mechanism)
    for i in np.flatnonzero(np.isnan(low)).tolist():
        one = {name: float(chosen[name][i] if name in chosen else value) for name, value in needed.items()}
        asked = written, repr(sorted(one.items()))
        travel = _STROKES.get(asked, partial(stroke_of, mechanism, {**one, driver_at: 0.0}))
        low[i], high[i] = travel.low, travel.high
    forth = np.asarray((needed | chosen).get(sense, 1.0)) > 0.0
    ends = {BEGIN: np.where(forth, low, high), END: np.where(forth, high, low)}
    return {name: float(at[0]) if rows is None else at[rows] for name, at in ends.items()}


def _plain_strokes(mechanism: Mechanism, values: Mapping[str, Any], size: int) -> tuple[Array, Array]:
    """Return from where to where a slider moves, in arrays, as `stroke_of` finds it, for mechanisms of many lengths.

    NaN, for all where they are few, and where the crank does not go round far from every limit, the slider has a dip of
    its velocity, or the output is no slider: these are found one by one.
    """
    low, high = np.full(size, np.nan), np.full(size, np.nan)
    assert mechanism.stroke is not None
    if size < FEWEST or mechanism.starts or not isinstance(mechanism.driver, Driver):
        return low, high
    drive = swept(mechanism, {})
    steady = _steady(drive.mechanism)
    structure, program = constructed(steady, ("velocity",))
    output = next(output for output in outputs(steady, structure) if output.link == mechanism.stroke.link)
    if not output.slides or output.rate is None:
        return low, high
    _, position = constructed(drive.mechanism.without_loads, ("position",))
    motion = measured(program, (output,)).needed_for((output.place, output.rate))
    for start in range(0, size, AT_ONCE):
        part = slice(start, start + AT_ONCE)
        some = {name: value[part] if np.ndim(value) else value for name, value in values.items()}
        low[part], high[part] = _strokes_of_some(drive, output, some, (position, motion))
    return low, high


@np.errstate(invalid="ignore", divide="ignore")
def _strokes_of_some(
    drive: Swept, output: Output, values: Mapping[str, Any], programs: tuple[Program, Program]
) -> tuple[Array, Array]:
    """Return the ends of a slider's strokes, shape (N,), by programs of positions and of its velocity; NaN as above."""
    assert output.rate is not None
    size = max(len(value) for value in values.values() if np.ndim(value))
    whole = full_turn()
    theta = whole.grid()
    at, of = np.repeat(whole.place(theta), size), np.tile(np.arange(size), len(theta))
    there, moving = (_run(program, drive, values, at, of) for program in programs)
    rate = np.reshape(moving.values[output.rate], (len(theta), size))
    plain = (np.reshape(there.codes, rate.shape) < CODES["singular"]).all(axis=0) & np.isfinite(rate).all(axis=0)
    for margin in there.margins.values():
        spare = np.reshape(np.broadcast_to(margin, at.shape), rate.shape)
        plain &= ((spare > 0.0).all(axis=0) | (spare < 0.0).all(axis=0)) & ~dipping(spare).any(axis=0)
    median = np.sort(np.abs(rate), axis=0)[[(len(theta) - 1) // 2, len(theta) // 2]].mean(axis=0)
    lengths = sum(np.abs(value) for value in values.values())
    plain &= (median > FAR * STILL * lengths) & ~dipping(rate).any(axis=0)
    above = rate >= 0.0
    cell, column = np.nonzero((above[1:] != above[:-1])[: whole.cells])

    def motion(places: Array) -> Mapping[str, Array]:
        return _run(programs[1], drive, values, places, np.resize(column, len(places))).values

    def velocity(turned: Array) -> Array:
        return motion(whole.place(turned))[str(output.rate)]

    roots = whole.place(refined(velocity, theta[cell], theta[cell + 1], above[cell, column]) % TURN)
    ends, low, high = motion(roots), np.full(size, np.inf), np.full(size, -np.inf)
    np.minimum.at(low, column, ends[output.place])
    np.maximum.at(high, column, ends[output.place])
    np.logical_and.at(plain, column, np.abs(ends[output.rate]) <= median[column])
    plain &= low < high
    return np.where(plain, low, np.nan), np.where(plain, high, np.nan)


def _run(program: Program, drive: Swept, values: Mapping[str, Any], at: Array, of: NDArray[np.intp]) -> MarginBoard:
    """Do a program for places of the driver, shape (N,), each in one of the mechanisms, by its number."""
    own = {name: value[of] if np.ndim(value) else value for name, value in values.items()}
    board = MarginBoard(drive.givens(own, at), len(at))
    program.run(board)
    return board


def _distinct(columns: Sequence[Array]) -> tuple[list[int], NDArray[np.intp]]:
    """Return where distinct rows of some columns stand first, and for every row which of them it is."""
    rows = np.zeros(len(columns[0]), np.intp)
    for column in columns:
        own = np.unique(column, return_inverse=True)[1]
        _, firsts, rows = np.unique(rows * (own.max() + 1) + own, return_index=True, return_inverse=True)
    return firsts.tolist(), rows


def _steady(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without loads whose driver goes at one radian or metre a second, in the positive sense."""
    driver = replace(mechanism.driver, speed="one", acceleration=None)
    driver = replace(driver, sense="one") if isinstance(driver, Driver) else driver
    return replace(mechanism.without_loads, driver=driver)


def working_stroke(mechanism: Mechanism, values: Mapping[str, float]) -> tuple[float, float]:
    """Return the driver's places at which the working stroke begins, the zero position, and ends.

    Raises InputError: when no output moves to and fro on the frame.
    """
    travel = stroke_of(mechanism, values)
    ends = travel.angle_low, travel.angle_high
    return ends if _working_sense(mechanism, values) > 0.0 else ends[::-1]


def _working_sense(mechanism: Mechanism, values: Mapping[str, float]) -> float:
    """Return the sense in which the output moves in its working stroke: +1 along its guide or counter-clockwise."""
    sense = mechanism.stroke.sense if mechanism.stroke else ZERO
    return 1.0 if {ZERO: 1.0, "one": 1.0, **values}[sense] >= 0.0 else -1.0


def zero_position(drive: Swept, values: Mapping[str, float], motions: Sequence[OutputMotion]) -> float:
    """Return where the driver stands when the working stroke begins; without a stated stroke its own zero."""
    stroke = drive.mechanism.stroke
    if stroke is None:
        return 0.0
    travel = next((motion.travel for motion in motions if motion.output.link == stroke.link), None)
    if travel is None:
        raise InputError("stroke-none", link=stroke.link)
    return travel.angle_low if _working_sense(drive.mechanism, values) > 0.0 else travel.angle_high


def output_motions(
    drive: Swept, values: Mapping[str, float], found: Reach, link: int | None = None
) -> tuple[OutputMotion, ...]:
    """Find the dead positions of every output, or of one link, its stroke and the ratio of its times.

    Dead positions are zeros of the velocity, refined until they do not change: better than 1e-12 rad.
    """
    mechanism = _steady(drive.mechanism)
    structure, program = constructed(mechanism, ("velocity",))
    moved = tuple(output for output in outputs(mechanism, structure) if link in (None, output.link))
    wanted = [name for output in moved for name in (output.place, output.rate) if name]
    along = remembering(drive.along(measured(program, moved), values, wanted))
    size = size_of(mechanism, values)
    return tuple(_Ends(output, along, drive, size).motion(values, found) for output in moved)


@dataclass(slots=True)
class _Ends:
    """The search for the ends of one output's strokes; `along` gives its places and velocities, `size` is a length."""

    output: Output
    along: Callable[[Array], Mapping[str, Array]]
    drive: Swept
    size: float

    def velocity(self, at: Array) -> Array:
        """Return the output's velocity per unit of the driver's."""
        assert self.output.rate
        return self.along(at)[self.output.rate]

    def motion(self, values: Mapping[str, float], found: Reach) -> OutputMotion:
        """Find its dead positions, from where to where it moves, and the ratio of times."""
        spots = {stretch: self._on(stretch) for stretch in found.stretches} if self.output.rate else {}
        dead = [spot for on, _ in spots.values() for spot in on]
        ratio = _ratio(self.output, dead, self.drive, values) if found.free else None
        at = sorted((replace(spot, angle=self._turned(spot.angle)) for spot in dead), key=lambda spot: spot.angle)
        return OutputMotion(self.output, tuple(at), self._travel(spots, found), ratio)

    def _travel(
        self, spots: Mapping[Stretch, tuple[list[_Dead], list[tuple[float, float]]]], found: Reach
    ) -> _Travel | None:
        """Return from where to where it moves as far as the driver can go from where it stands; None for no end."""
        if not spots or not (any(dead for dead, _ in spots.values()) or found.apart or not found.whole.closed):
            return None
        joined = found.around(self.drive.start)
        places = [(spot.place, spot.angle) for stretch in joined for spot in spots[stretch][0]]
        places += [end for stretch in joined for end in spots[stretch][1]]
        if not places:
            return None
        (low, at_low), (high, at_high) = min(places), max(places)
        return _Travel(low, high, self._turned(at_low), self._turned(at_high))

    def _turned(self, place: float) -> float:
        return place % TURN if self.drive.turns else place

    def _on(self, stretch: Stretch) -> tuple[list[_Dead], list[tuple[float, float]]]:
        """Return the dead positions on a stretch, and its two ends as (place, driver's place) unless it has none."""
        speeds = np.abs(self.velocity(stretch.place(stretch.grid())))
        usual = (self.size if self.output.slides else 1.0) / (1.0 if self.drive.turns else self.size)
        known = np.sort(speeds[np.isfinite(speeds)])  # np.median and np.unique would import all of numpy.ma
        median = known[(len(known) - 1) // 2 : len(known) // 2 + 1].mean() if len(known) else 0.0
        roots = zeros(self.velocity, stretch)[0] if median > STILL * usual else speeds[:0]
        roots = roots[np.abs(self.velocity(roots)) <= median] if len(roots) else roots
        ends = [] if stretch.closed else [stretch.low, stretch.high]
        inside = [end + s * INSIDE * stretch.length for end, s in zip(ends, (1.0, -1.0), strict=False)]
        at = np.sort(np.concatenate((stretch.place(stretch.grid()), roots, ends, inside)))
        at = at[np.append(True, at[1:] > at[:-1])]
        places = self.output.places(self.along(at))
        known = np.flatnonzero(np.isfinite(places))
        found = [(float(places[i]), float(x)) for i, x in zip(known[[0, -1]], ends, strict=False)] if len(known) else []
        if not len(roots):
            return [], found
        before = roots[-1] - stretch.length if stretch.closed else stretch.low
        coming = self.velocity(0.5 * (roots + np.concatenate(([before], roots[:-1])))) > 0.0
        there = places[np.searchsorted(at, roots)]
        return [_Dead(*spot) for spot in zip(roots.tolist(), there.tolist(), coming.tolist(), strict=True)], found


def _ratio(output: Output, dead: Sequence[_Dead], drive: Swept, values: Mapping[str, float]) -> float | None:
    """Return the ratio of the crank's angle in the working stroke to that in the idle one."""
    if len(dead) < 2:
        return None
    ordered = sorted(dead, key=lambda spot: spot.angle)
    first = replace(ordered[0], angle=ordered[0].angle + TURN)
    up = sum(b.angle - a.angle for a, b in pairwise([*ordered, first]) if b.high)
    rising = up if drive.sense > 0.0 else TURN - up
    stroke = drive.mechanism.stroke
    if stroke is None or stroke.link != output.link:
        return max(rising, TURN - rising) / min(rising, TURN - rising)
    working = rising if _working_sense(drive.mechanism, values) > 0.0 else TURN - rising
    return working / (TURN - working)
