"""The whole cycle of a mechanism: a full turn of its crank, or the stroke of a sliding driver; diagrams over it.

Every position is computed at the place of the driver that it has, phi_0 + k * step, never from the one before: the
assembly that the task names is kept, and an error of one position stays in it.

Diagrams show travel, velocity and acceleration of a point or a link, by plans and by chords. By chords a curve that is
drawn to scale is differentiated graphically. It is divided into sections. From a pole at the distance H to the left of
the axes a ray is drawn parallel to the chord of each section; on the axis it cuts off the mean slope of the section,
which belongs to its middle. Done once it turns travels into velocities, done again velocities into accelerations.

Beside them the field of velocities of a link: those of all its points in one position; and how far sliders run along
their guides over the cycle, for guides are drawn so long.

Source: Artobolevsky, Theory of mechanisms and machines (method of chords); Kinytskyi, the same.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ...scales.names import unknown
from ..board import POSITION, Program
from ..boards.batch import FEW, batch
from ..boards.exact import STATUSES
from ..laws import LAWS, TURN, dot, inclination
from ..quantities import quantities
from ..zeros import Extreme, extremes
from .chain import USUAL, constructed, moving_bodies
from .limits import NEAR_LIMIT, Arc, Reach, Swept, reach_of, swept
from .mechanism import Driver, Mechanism, Prismatic
from .solved import SolvedLinkage, board_givens, solve_linkage
from .strokes import Output, OutputMotion, measured, output_motions, outputs, unwound, zero_position
from .structure import Structure

Array = NDArray[Any]
Runs = Mapping[str, tuple[float, float]]
VANISHES = 1e-9  # part of the largest magnitude below which the smallest is zero
BESIDE_CHANGE = 1e-4  # radians from a change point within which velocities are lost in rounding: it goes as 1 / angle^2
FEWEST, MOST = 3, 100_000  # positions of a cycle
SWAY = 0.3  # part of the mechanism's size by which a sliding driver is moved to and fro, to see how far sliders run
LEAP = 0.12  # part of that size which no slider runs between two positions, unless the guides are nearly parallel
POSITIONS = 72
MARGIN = 0.15  # how far a field reaches beyond the link's points, in parts of its larger side


@dataclass(frozen=True, slots=True, eq=False)
class Cycle:
    """N positions of a mechanism over its cycle; arrays have the shape (N,)."""

    drive: Swept
    structure: Structure
    program: Program
    givens: Mapping[str, float]
    angles: Array  # of the crank, rad, or travels of a sliding driver, m, in the sense in which it moves
    times: Array  # seconds from the first position, at constant speed of the driver
    # every quantity and lettered point: float64 scalars, complex128 vectors and points, NaN where a position fails
    values: Mapping[str, Array]
    codes: NDArray[np.int8]  # of `STATUSES`
    reach: Reach
    motions: tuple[OutputMotion, ...]  # of the links on the frame
    zero: float  # the driver's place at the zero position, where the working stroke begins
    _solved: dict[tuple[float, str], SolvedLinkage] = field(default_factory=dict, compare=False, repr=False)

    def solved(self, place: float, plan: str) -> SolvedLinkage:
        """Return the mechanism solved with the driver at a place, as far as a plan, for whatever draws it."""
        key = place, plan
        if key not in self._solved:
            givens = {**self.givens, self.drive.variable: place}
            self._solved[key] = solve_linkage(self.mechanism, givens, (plan,))
        return self._solved[key]

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism; its driver's variable may have another name than in the task."""
        return self.drive.mechanism

    @property
    def statuses(self) -> tuple[str, ...]:
        """Status of every position."""
        return tuple(STATUSES[code] for code in self.codes)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the quantities, points apart, in order of construction."""
        named = quantities(self.program, defaultdict(float), {})
        return tuple(name for name, item in named.items() if item.kind != "point")

    @property
    def outputs(self) -> tuple[Output, ...]:
        """The links on the frame that do not drive."""
        return tuple(motion.output for motion in self.motions)

    @property
    def speed(self) -> float:
        """Speed of the driver, positive: rad/s or m/s."""
        return abs(float(self.givens[self.mechanism.driver.speed]))

    @property
    def range(self) -> Arc:
        """The driver's range: a full turn from the first position on, or the travel of a slide."""
        if self.drive.turns:
            return Arc(float(self.angles[0]), float(self.angles[0]) + self.drive.sense * TURN)
        return Arc(float(self.angles[0]), float(self.angles[-1]))

    @property
    def sections(self) -> int:
        """Into how many sections the positions divide the range: a full turn ends where it begins."""
        return len(self.angles) - (not self.drive.turns)

    def at(self, places: Array, names: Sequence[str]) -> dict[str, Array]:
        """Return values by name for other places of the driver."""
        return self.drive.along(self.program, self.givens, names)(places)

    def each(self, places: Array) -> list[dict[str, float]]:
        """Return the board's givens for places of the driver, one after the other."""
        givens = self.drive.givens(self.givens, places)
        return [
            {name: float(value[i] if np.ndim(value) else value) for name, value in givens.items()}
            for i in range(len(places))
        ]

    def extremes(self, names: Iterable[str] | None = None) -> dict[str, tuple[Extreme, Extreme]]:
        """Return the largest and the smallest value of quantities, of all without `names`, and the driver's places.

        Scalars keep their sign, of vectors the magnitude counts. What has no value anywhere is left out.
        """
        wanted = tuple(self.quantities if names is None else names)
        along = self.drive.along(self.program, self.givens, wanted)
        vectors = [np.iscomplexobj(self.values[name]) for name in wanted]

        def sizes(at: Array) -> Array:
            found = along(at)
            return np.stack(
                [dot(found[name], found[name]) if v else found[name] for name, v in zip(wanted, vectors, strict=True)]
            )

        rows = extremes(sizes, self.reach.trimmed(BESIDE_CHANGE)) if wanted else []
        ends = {name: row for name, row in zip(wanted, rows, strict=False) if row is not None}
        for name in (name for name, vector in zip(wanted, vectors, strict=True) if vector and name in ends):
            most, least = ends[name]  # of the square, which is smooth where the vector vanishes
            size, low = (float(np.sqrt(max(end.value, 0.0))) for end in (most, least))
            ends[name] = Extreme(size, most.at), Extreme(low if low > VANISHES * size else 0.0, least.at)
        return ends


def cycle(
    mechanism: Mechanism,
    values: Mapping[str, float],
    plans: Iterable[str] = USUAL,
    positions: int = 12,
    start: float | None = None,
    end: float | None = None,
) -> Cycle:
    """Compute N positions over a full turn of the crank, or over the stroke of a sliding driver.

    The `values` are the numbers of the mechanism in SI, where its driver stands does not matter; the `plans` wanted are
    those of `chain.PLANS`. Of a turn so many `positions` divide the circle evenly, the first one does not come again;
    of a sliding driver the first and the last are the ends of its travel. The driver begins at `start`, without it at
    the zero position, where the working stroke of `mechanism.stroke` begins, or at its own zero angle; a sliding driver
    runs to `end`, without either from one end of its reach to the other.

    Raises InputError: too few or too many positions; the output has no stroke; a sliding driver's reach has no end.
    """
    if not FEWEST <= positions <= MOST:
        raise InputError("positions-number", n=positions, least=FEWEST, most=MOST)
    drive = swept(mechanism, values)
    reach, between = _reach(drive, values, start, end)
    motions = output_motions(drive, values, reach)
    zero = between.low if between else zero_position(drive, values, motions) if reach.stretches else 0.0
    structure, program = constructed(drive.mechanism, plans)
    program = measured(program, outputs(drive.mechanism, structure))
    places = _places(drive, zero if start is None else start, between, positions)
    wanted, here = _wanted(mechanism, program, motions), drive.givens(values, drive.start)
    here = {name: float(np.ravel(value)[0]) for name, value in here.items()}
    givens = board_givens(drive.mechanism, here, program, follow=False)
    if positions > FEW:
        results, codes = batch(program, drive.givens(givens, places), wanted)
    else:
        results, codes = drive.along(program, givens, wanted).batch(places)
    _strike_out(results, codes, program, reach.undetermined(places))
    speed = abs(float(values[mechanism.driver.speed]))
    with np.errstate(divide="ignore", invalid="ignore"):
        times = np.abs(places - places[0]) / speed
    return Cycle(drive, structure, program, givens, places, times, results, codes, reach, motions, zero)


def _wanted(mechanism: Mechanism, program: Program, motions: Iterable[OutputMotion]) -> list[str]:
    """Return what a cycle keeps of every position: quantities, points, the motion of the outputs."""
    named = quantities(program, defaultdict(float), {})
    points = [point for link in mechanism.links for point in link.points] + [*mechanism.frame_points]
    moved = [motion.output for motion in motions]
    measures = [name for output in moved for name in (output.place, output.rate, output.change) if name]
    known = set(program.names)
    return [name for name in dict.fromkeys((*named, *points, *measures)) if name in known]


def _strike_out(
    results: dict[str, Array], codes: NDArray[np.int8], program: Program, undetermined: NDArray[np.bool_]
) -> None:
    """Call the undetermined positions singular, and take from them what hangs on lines that meet in their plans."""
    if not undetermined.any():
        return
    codes[undetermined] = np.maximum(codes[undetermined], STATUSES.index("singular"))
    hanging: set[str] = set()
    for step in program:
        if (step.verb == "meet" and step.plan != POSITION) or not hanging.isdisjoint(step.operands):
            hanging.add(step.name)
    for name in hanging.intersection(results):
        results[name] = np.where(undetermined, np.nan, results[name])


def _places(drive: Swept, start: float, between: Arc | None, positions: int) -> Array:
    """Return the driver's places: around the circle in the sense of rotation, or along the travel."""
    count: Array = np.arange(positions, dtype=float)
    if between is None:
        return start + drive.sense * TURN * (count / positions)
    rounding = NEAR_LIMIT * 0.1 * (between.high - between.low)  # a limit must not lie beyond itself
    low, high = between.low + rounding, between.high - rounding
    low, high = (low, high) if drive.sense > 0.0 else (high, low)
    return low + (high - low) * (count / (positions - 1))


def _reach(
    drive: Swept, values: Mapping[str, float], start: float | None, end: float | None
) -> tuple[Reach, Arc | None]:
    """Return where the mechanism can be assembled, and the range of a sliding driver."""
    if drive.turns:
        return reach_of(drive, values), None
    if start is not None and end is not None:
        between = Arc(min(start, end), max(start, end))
        return reach_of(drive, values, between), between
    found = reach_of(drive, values)
    if not found.stretches:
        return found, Arc(found.whole.low, found.whole.high)
    parts = found.around(drive.start)
    low = parts[0].low if start is None else start
    high = parts[-1].high if end is None else end
    if low <= found.whole.low or high >= found.whole.high:
        raise InputError("travel-endless")
    own = tuple(place for place, given in ((low, start), (high, end)) if given is None)
    between = Arc(min(low, high), max(low, high))
    found = reach_of(drive, values, between)
    return replace(found, limits=found.limits + own), between


def chords(values: Array, section: float) -> Array:
    """Return the mean slope of every section of a curve, which belongs to its middle.

    `values`, float64 or complex128 of shape (n + 1,), stand at the ends of sections so long along the axis.

    >>> chords(np.array([0.0, 1.0, 4.0]), 0.5).tolist()
    [2.0, 6.0]
    """
    return np.diff(values, axis=0) * (1.0 / section)


def pole_distance(mu: float, mu_t: float, derived: float) -> float:
    """Return the pole distance H, mm, with which a derived curve gets the scale factor `derived`.

    A ray at the pole distance rises like its chord, so that mu_v = mu_s / (mu_t * H), mu_a = mu_v / (mu_t * H).
    """
    return mu / (mu_t * derived)


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A curve by plans, and the same by chords where chords give it: SI, shape (n,), complex for a vector."""

    times: Array  # seconds
    plans: Array
    chords: Array

    @property
    def difference(self) -> Array:
        """Chords less plans."""
        return np.asarray(self.chords - self.plans)

    @property
    def per_cent(self) -> Array:
        """Size of the difference in per cent of the largest size of the curve by plans."""
        size: float = np.nanmax(np.abs(self.plans), initial=0.0)
        return np.abs(self.difference) * (100.0 / size if size else 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Diagrams:
    """Diagrams of travel, velocity and acceleration over n sections of the cycle.

    By plans they are signed along a guide and for angles, complex for a point without a guide, whose travel is its
    place; shape (n + 1,).
    """

    unit: str  # `m` for a point, `rad` for a link; of velocities per second, of accelerations per second squared
    times: Array  # ends of the sections, seconds
    s: Array
    v: Array
    a: Array
    velocity: Curve  # by chords beside plans, at the middles of the sections
    acceleration: Curve  # by chords of the velocity curve, at the ends of the sections


def _differentiate(s: Array, section: float, closed: bool) -> tuple[Array, Array]:
    """Return velocities and accelerations by chords of travels `s` at the ends of n sections, shape (n + 1,).

    The velocities stand at the middles, shape (n,), the accelerations at the beginnings of the sections; on a closed
    curve the last section runs into the first one, on an open one no acceleration stands at the first.
    """
    v = chords(s, section)
    return v, chords(np.concatenate((v[-1:], v)) if closed else v, section)


def _named(cycle: Cycle, of: str) -> tuple[tuple[str, str | None, str | None], bool]:
    """Return the names of travel, velocity and acceleration of a point or a link, and whether they are of an angle."""
    mechanism = cycle.mechanism
    points = dict.fromkeys(point for link in mechanism.links for point in link.points)
    links = {str(link.number): link.number for link in mechanism.links}
    sliders = (output for output in cycle.outputs if output.slides)
    slider = next((x for x in sliders if of in (str(x.link), *mechanism.link(x.link).points)), None)
    if slider is not None:
        return (slider.place, slider.rate, slider.change), False
    if of in links:
        body = moving_bodies(mechanism, cycle.structure)[links[of]]
        return (body.direction, body.omega, body.epsilon), True
    if of not in points:
        raise unknown("motion-unknown", of, (*points, *links))
    return (of, mechanism.mark("velocity", of), mechanism.mark("acceleration", of)), False


def diagrams(cycle: Cycle, of: str, sections: int = 12) -> Diagrams:
    """Draw the diagrams of a point or a link over so many sections of the cycle, by plans and by chords.

    They are `of` a point's letter, or the number of a link for its angle. A slider on the frame, or a point of it, has
    signed travels along its guide; of any other point travel, velocity and acceleration are vectors.

    Raises InputError: no such point or link; the cycle was computed without velocities or accelerations.
    """
    names, turns = _named(cycle, of)
    if not set(filter(None, names)) <= set(cycle.program.names):
        raise InputError("motion-plans", name=of)
    parts, closed = np.arange(2 * sections + 1) / (2 * sections), cycle.drive.turns
    way = cycle.range.high - cycle.range.low
    values = cycle.at(cycle.range.low + way * parts, [name for name in names if name])
    s, v, a = (values[name] if name else np.zeros(len(parts)) for name in names)
    s = unwound(inclination(s)) if turns else s
    duration = abs(way) / cycle.speed
    times = duration * parts
    v_chords, a_chords = _differentiate(s[::2], duration / sections, closed)
    inner = slice(0, -1) if closed else slice(1, -1)
    curves = Curve(times[1::2], v[1::2], v_chords), Curve(times[::2][inner], a[::2][inner], a_chords)
    return Diagrams("rad" if turns else "m", times[::2], s[::2], v[::2], a[::2], *curves)


def velocities(at: Array, pin: complex, velocity: complex, omega: float) -> Array:
    """Return the velocities of points of a link: v = v_A + omega x (P - A).

    Places P and A, the `pin`, are in metres, complex128; `velocity` is that of A, `omega` in rad/s.
    """
    return np.asarray(LAWS["transport_speed"](omega, at - pin) + velocity)


def velocity_field(solved: SolvedLinkage, link: int, columns: int = 9, rows: int = 7) -> tuple[Array, Array]:
    """Return a grid of places over a link and their velocities, both of shape (rows, columns).

    The grid covers the link's lettered points in the plan of the mechanism, and a margin around them.
    """
    body = moving_bodies(solved.mechanism, solved.structure)[link]
    points = np.array([solved.point(point) for point in body.link.points])
    beside = MARGIN * (max(np.ptp(points.real), np.ptp(points.imag)) or 1.0)
    xs = np.linspace(points.real.min() - beside, points.real.max() + beside, columns)
    ys = np.linspace(points.imag.min() - beside, points.imag.max() + beside, rows)
    places = xs[None, :] + 1j * ys[:, None]
    omega = float(solved.values[body.omega]) if body.omega else 0.0
    velocity = solved.point(solved.mechanism.mark("velocity", body.pin))
    return places, velocities(places, solved.point(body.pin), velocity, omega)


def slider_runs(solved: SolvedLinkage) -> Runs:
    """Return for each guide how far the slider's point runs back (negative) and forth from its place now, metres."""
    pairs = [pair for pair in solved.mechanism.pairs if isinstance(pair, Prismatic)]
    if not pairs:
        return {}
    drive = swept(solved.mechanism, solved.givens)
    _, program = constructed(drive.mechanism.without_loads, ("position",))
    # a slider's way is measured from a point of the guide's link, from none on the frame
    first = {link.number: next(iter(link.points)) for link in solved.mechanism.links}
    marks = {solved.guide_name(pair): (pair.point, first.get(pair.links[1], "")) for pair in pairs}
    wanted = sorted({mark for u, (point, at) in marks.items() for mark in (u, point, at) if mark})
    steps = np.arange(-POSITIONS // 2, POSITIONS // 2 + 1) * (1.0 / POSITIONS)
    size = solved.extent
    whole = TURN if isinstance(solved.mechanism.driver, Driver) else 2.0 * SWAY * size
    places: Array = drive.start + steps * whole
    moved = drive.along(program, solved.givens, wanted)(places)
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
