"""A hoist integrated step by step: the load on its support until it lifts off, then a swing on the rope.

Many hoists go at once, each with its own step. The lift-off and the extrema of the rope's force lie within steps: they
are found there by steps of the same method that are shorter, so that no order is lost. A run whose oscillation grows by
its method is refused: its numbers would look like some.

Steps are those for u'' = b(t) - w^2 u: the load on its springs, driven by the rope. Every stepper takes times, states
(u, v = u') and steps, numbers or arrays, and gives the state a step later. Explicit Euler grows at any step; symplectic
Euler and Verlet hold to w h = 2, RK4 to 2 sqrt(2), the trapezoid at all steps.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..hoist.roots import time_to_wind

Array = NDArray[np.float64]
State = tuple[Any, Any]  # u, m, displacement from the static place, and v, m/s
Trace = Sequence[Array]  # times, s, places and velocities; of many steps a row a step, a column a hoist
Row = tuple[Any, Any, Any]  # the same of one step
EXPLICIT, SYMPLECTIC, VERLET, TRAPEZOID, RK4 = "euler", "symplectic", "verlet", "trapezoid", "rk4"
LEAST = 1e-4  # w h at which a method that grows has no stability limit at all
STABLE = 1e-12  # growth in a step that is rounding
MOST = 1e6  # w h up to which a method is looked at


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """u'' = b(t) - w^2 u, or another acceleration."""

    square: Any  # w^2, rad^2/s^2
    drive: Callable[[Any], Any]  # b(t), m/s^2
    bent: Callable[[Any, Any], Any] | None = None  # the acceleration at (t, u) where it is not linear in u

    def acceleration(self, t: Any, u: Any) -> Any:
        """Return u'', m/s^2."""
        return self.drive(t) - self.square * u if self.bent is None else self.bent(t, u)


Stepper = Callable[[Motion, Any, State, Any], State]


def _explicit_euler(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Step along the tangents at the beginning."""
    u, v = state
    return u + h * v, v + h * motion.acceleration(t, u)


def _symplectic_euler(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Step the velocity first, then the place with the new velocity."""
    u, v = state
    v = v + h * motion.acceleration(t, u)
    return u + h * v, v


def _verlet(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Half a step of the velocity, a step of the place, half a step of the velocity."""
    u, v = state
    half = 0.5 * h
    v = v + half * motion.acceleration(t, u)
    u = u + h * v
    return u, v + half * motion.acceleration(t + h, u)


def _trapezoid(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Take the means of both ends: implicit, solved for the new velocity as the motion is linear."""
    u, v = state
    half = 0.5 * h
    before, after = motion.drive(t) - motion.square * u, motion.drive(t + h)
    ahead = u + half * v  # the new place without the new velocity
    late = (v + half * (before + after - motion.square * ahead)) / (1.0 + motion.square * (half * half))
    return ahead + half * late, late


def _rk4(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Runge and Kutta's method of fourth order."""
    u, v = state
    half, sixth = 0.5 * h, h * (1.0 / 6.0)
    a_1 = motion.acceleration(t, u)
    v_2 = v + half * a_1
    a_2 = motion.acceleration(t + half, u + half * v)
    v_3 = v + half * a_2
    a_3 = motion.acceleration(t + half, u + half * v_2)
    v_4 = v + h * a_3
    a_4 = motion.acceleration(t + h, u + h * v_3)
    return u + sixth * (v + 2.0 * (v_2 + v_3) + v_4), v + sixth * (a_1 + 2.0 * (a_2 + a_3) + a_4)


STEPPERS: Mapping[str, Stepper] = {
    RK4: _rk4,
    VERLET: _verlet,
    TRAPEZOID: _trapezoid,
    SYMPLECTIC: _symplectic_euler,
    EXPLICIT: _explicit_euler,
}


def _one_step(method: str, z: Any) -> tuple[Any, Any, Any, Any]:
    """Return the matrix of a step h = z / w with no drive, found by taking it: of (u, v / w), row by row."""
    step = STEPPERS[method]
    motion = Motion(1.0, lambda t: 0.0 * t)
    none = 0.0 * np.asarray(z, float)
    (uu, vu), (uv, vv) = (step(motion, none, (one + none, 1.0 - one + none), z) for one in (1.0, 0.0))
    return uu, uv, vu, vv


def growth(method: str, z: Any) -> Array:
    """Return by what an oscillation grows in a step with w h = z in the long run: the spectral radius."""
    uu, uv, vu, vv = _one_step(method, z)
    determinant, half = uu * vv - uv * vu, 0.5 * (uu + vv)
    bend = half * half - determinant
    rounding = 8.0 * np.finfo(float).eps * np.maximum(half * half, np.abs(determinant))
    turning = np.sqrt(np.maximum(determinant, 0.0))
    found: Array = np.where(bend <= rounding, turning, np.abs(half) + np.sqrt(np.maximum(bend, 0.0)))
    return found


@cache
def stability_limit(method: str) -> float:
    """Return the largest w h at which oscillations do not grow: 0 when they always do, infinity when they never do."""

    def grows(z: float) -> bool:
        return float(growth(method, z)) > 1.0 + STABLE

    if grows(LEAST):
        return 0.0
    low, high = LEAST, 2.0 * LEAST
    while not grows(high):
        low, high = high, 2.0 * high
        if high > MOST:
            return math.inf
    while low < 0.5 * (low + high) < high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low


Flags = NDArray[np.bool_]
NAMES = ("m", "C_01", "C_12", "V_t", "a", "g")
GROWN = 1.1  # growth of an oscillation over a run from which on it is refused
ROUNDS = 60  # of closing in on an event within a step
CLOSE = 1e-15  # parts of a step that are no step
BLOCK = 16  # steps between looks at whether loads have left their supports, later such a part of all steps
MARGIN = 1.5  # times as long as the exact lift-off can take


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What an integrator finds, of N hoists; NaN where it is refused. Quantities as of the closed form, SI."""

    t_1: Array
    F_12_t1: Array
    F_12_max: Array
    P_12_max: Array
    F_max: Array
    grown: Array  # by what the method makes oscillations grow over the run
    refused: Flags  # steps beyond the stability limit, or oscillations that grow by more than `GROWN`
    t: Array  # shape (rows, N): at the steps; NaN after the end
    F_12: Array


# steps in both phases; t_1, F_12_t1, F_12_max, P_12_max; times and forces, and where they end
_Found = tuple[tuple[Any, Any], tuple[Array, ...], tuple[Array, Array, Array]]


def _smaller(first: Any, second: Any) -> Any:
    """Return the smaller one, of Python's numbers as they are."""
    return min(first, second) if isinstance(first, float) else np.minimum(first, second)


class _Hoists:
    """The load's motion in both phases, of many hoists: `m C_01 C_12 V_t a g` as arrays of one shape (N,)."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        given = np.broadcast_arrays(*(np.atleast_1d(np.asarray(values[name], float)) for name in NAMES))
        self.m, self.C_01, self.C_12, self.V_t, self.a, self.g = (np.asarray(one) for one in given)
        self.k_1, self.k = np.sqrt(self.C_12 / self.m), np.sqrt((self.C_01 + self.C_12) / self.m)

    def chosen(self, which: Any) -> _Hoists:
        """Return some of the hoists."""
        return _Hoists({name: getattr(self, name)[which] for name in NAMES})

    def of_floats(self) -> _Hoists:
        """Return the only hoist with Python's numbers, which are many times as fast as arrays of one."""
        alone = copy(self)
        for name, value in vars(self).items():
            setattr(alone, name, value.item())
        return alone

    def travel(self, t: Any) -> Any:
        """Return what has been wound up, m."""
        return (self.V_t + 0.5 * self.a * t) * t

    def on_support(self) -> Motion:
        """Return the motion while the support carries."""
        free = 1.0 / self.m
        pull = self.C_12 * free
        return Motion((self.C_01 + self.C_12) * free, lambda t: pull * self.travel(t))

    def lifted(self) -> Motion:
        """Return the motion on the rope alone."""
        square = self.C_12 / self.m
        return Motion(square, lambda t: square * self.travel(t) - self.g)

    def one_sided(self) -> Motion:
        """Return the motion on a support that only pushes: both phases in one, bent at lift-off."""
        pull, push = self.C_12 / self.m, self.C_01 / self.m

        def acceleration(t: Any, u: Any) -> Any:
            return pull * (self.travel(t) - u) - _smaller(push * u, self.g)

        return Motion(pull, lambda t: pull * self.travel(t) - self.g, acceleration)

    def force(self, t: Any, u: Any, _v: Any) -> Any:
        """Return the rope's force, N."""
        return self.C_12 * (self.travel(t) - u)

    def rate(self, t: Any, _u: Any, v: Any) -> Any:
        """Return the speed at which the rope is stretched, m/s."""
        return self.V_t + self.a * t - v

    def lift(self, t: Any, u: Any, _v: Any) -> Any:
        """Return F_01: the load leaves its support where it becomes positive, N."""
        return self.C_01 * u - self.m * self.g

    def latest(self) -> Array:
        """Return times before which the load lifts off, s."""
        yielding, swing = 1.0 / self.C_01 + 1.0 / self.C_12, self.V_t / self.k + 2.0 * self.a / (self.k * self.k)
        return np.asarray(time_to_wind(self.V_t, self.a, self.m * self.g * yielding + swing))


def integrate(values: Mapping[str, Any], method: str, step: Any, located: bool = True) -> Run:
    """Integrate hoists, by one of `STEPPERS`, until one period after lift-off.

    The `values` are `m C_01 C_12 V_t a g`, SI, of supports that yield. The `step` is k h, rad; many steps of one hoist
    go at once, too. Lift-off and extrema are `located` within steps; else they are taken at the steps, as programs do
    that know no events, and the support is one-sided: a method that is not implicit is needed then.
    """
    hoists = _Hoists({**values, "m": np.broadcast_arrays(values["m"], step)[0]})
    z = np.broadcast_to(np.asarray(step, float), hoists.m.shape)
    h = z / hoists.k
    with np.errstate(over="ignore", invalid="ignore"):
        return _judged(hoists, method, z, (_located if located else _missed)(hoists, STEPPERS[method], h))


Phase = Callable[[_Hoists], Motion]


def _located(hoists: _Hoists, take: Stepper, h: Array) -> _Found:
    first, off = _until_lift_off(hoists, take, h)
    last = np.ceil(2.0 * math.pi / (hoists.k_1 * h)).astype(np.int64) + 1
    second = _columns(itertools.islice(_rows(take, hoists, _Hoists.lifted, off, h), int(last.max()) + 1))
    t_1, F_12_t1 = off[0], hoists.force(*off)
    F_12_max = np.maximum(F_12_t1, _peak(hoists, take, _Hoists.on_support, first, t_1))
    end = t_1 + 2.0 * math.pi / hoists.k_1
    P_12_max = np.maximum(F_12_t1, _peak(hoists, take, _Hoists.lifted, second, end + h))
    counted = np.ceil(t_1 / h).astype(np.int64)
    t = np.concatenate((first[0], second[0]))
    force = np.concatenate((hoists.force(*first), hoists.force(*second)))
    return (counted, last), (t_1, F_12_t1, F_12_max, P_12_max), (t, force, end)


def _missed(hoists: _Hoists, take: Stepper, h: Array) -> _Found:
    until = hoists.latest() + 2.0 * math.pi / hoists.k_1
    rows = _rows(take, hoists, _Hoists.one_sided, _rest(h), h)
    trace = _columns(itertools.islice(rows, int(np.ceil(until / h).max()) + 2))
    t, force = trace[0], hoists.force(*trace)
    off = (hoists.lift(*trace) >= 0.0).argmax(axis=0)
    own = np.arange(len(off))
    t_1 = t[off, own]
    end = t_1 + 2.0 * math.pi / hoists.k_1
    before, after = t <= t_1, (t >= t_1) & (t <= end + h)
    F_12_max, P_12_max = (np.max(force, axis=0, initial=-np.inf, where=part) for part in (before, after))
    steps = off, np.ceil((end - t_1) / h).astype(np.int64)
    return steps, (t_1, force[off, own], F_12_max, P_12_max), (t, force, end)


def _judged(hoists: _Hoists, method: str, z: Array, found: _Found) -> Run:
    """Refuse what the method has made grow."""
    (first, last), ends, (t, force, end) = found
    z_1 = z * (hoists.k_1 / hoists.k)
    grown = np.exp(np.log(growth(method, z)) * first + np.log(growth(method, z_1)) * last)
    limit = stability_limit(method)
    refused: Flags = ((z > limit) & (limit > 0.0)) | (grown > GROWN) | ~np.isfinite(ends[0])
    t_1, F_12_t1, F_12_max, P_12_max = (np.where(refused, np.nan, value) for value in ends)
    over = refused | (t > end)
    masked = (np.where(over, np.nan, column) for column in (t, force))
    return Run(t_1, F_12_t1, F_12_max, P_12_max, np.maximum(F_12_max, P_12_max), grown, refused, *masked)


def _rest(h: Array) -> Trace:
    """Return time, place and velocity of the beginning, of as many hoists as have steps."""
    return [np.zeros_like(h)] * 3


def _rows(take: Stepper, hoists: _Hoists, phase: Phase, begin: Trace, h: Array) -> Iterator[Row]:
    """Go through times and states, from the beginning on without an end: of one hoist as Python's numbers."""
    alone = h.size == 1
    motion = phase(hoists.of_floats() if alone else hoists)
    t, u, v, step = [one.item() for one in (*begin, h)] if alone else (*begin, h)
    for i in itertools.count():
        now = t + i * step
        yield now, u, v
        u, v = take(motion, now, (u, v), step)


def _columns(rows: Iterable[Row]) -> Trace:
    """Return times, places and velocities, a row a step."""
    return [np.array(column).reshape(len(column), -1) for column in zip(*rows, strict=True)]


def _until_lift_off(hoists: _Hoists, take: Stepper, h: Array) -> tuple[Trace, Trace]:
    """Step until every load has left its support; return the steps, and time and state where it does."""
    source = _rows(take, hoists, _Hoists.on_support, _rest(h), h)
    rows, most = [next(source)], int(np.ceil(MARGIN * hoists.latest() / h).max()) + 1
    borne, going = np.zeros(h.shape, int), np.ones(h.shape, bool)
    while going.any() and len(rows) <= most:
        block = list(itertools.islice(source, min(max(BLOCK, len(rows) // BLOCK), most + 1 - len(rows))))
        bears = np.logical_and.accumulate(hoists.lift(*_columns(block)) < 0.0) & going
        borne, going = borne + bears.sum(axis=0), bears[-1]
        rows += block
    trace, own = _columns(rows[: borne.max() + 2]), np.arange(len(h))
    last = np.minimum(np.arange(len(trace[0]))[:, None], borne)  # where the load has left, its last on the support
    left = _within(hoists.lift, take, hoists.on_support(), [column[borne, own] for column in trace], h)
    off = [np.where(going, np.nan, value) for value in left]
    return [np.concatenate((column[last, own], [end])) for column, end in zip(trace, off, strict=True)], off


def _peak(hoists: _Hoists, take: Stepper, phase: Phase, trace: Trace, end: Array) -> Array:
    """Return the highest maximum of the rope's force up to `end`, found within steps; minus infinity for none."""
    rate, times = hoists.rate(*trace), trace[0]
    row, own = np.nonzero((rate[:-1] > 0.0) & (rate[1:] <= 0.0) & (times[1:] <= end))
    highest = np.full(end.shape, -np.inf)
    if row.size:
        some, begin = hoists.chosen(own), [column[row, own] for column in trace]
        top = _within(some.rate, take, phase(some), begin, times[row + 1, own] - begin[0])
        np.maximum.at(highest, own, some.force(*top))
    return highest


def _within(of: Callable[..., Any], take: Stepper, motion: Motion, begin: Trace, h: Array) -> Trace:
    """Return time and state where `of` changes its sign in a step: by chords, as Illinois does."""
    t, u, v = begin

    def after(part: Array) -> Trace:
        return t + part * h, *take(motion, t, (u, v), part * h)

    low, high = np.zeros_like(h), np.ones_like(h)
    f_low, f_high = of(*after(low)), of(*after(high))
    part, stayed = low, np.zeros(h.shape, int)
    for _ in range(ROUNDS):
        chord = low + (high - low) * (f_low / (f_low - f_high + (f_low == f_high)))
        chord = np.where((chord > low) & (chord < high), chord, 0.5 * (low + high))
        if np.all(np.abs(chord - part) <= CLOSE):
            break
        part, f = chord, of(*after(chord))
        same = np.signbit(f) == np.signbit(f_low)
        f_high = np.where(same, np.where(stayed > 0, 0.5 * f_high, f_high), f)
        f_low = np.where(same, f, np.where(stayed < 0, 0.5 * f_low, f_low))
        low, high = np.where(same, part, low), np.where(same, high, part)
        stayed = np.where(same, 1, -1)
    return after(part)
