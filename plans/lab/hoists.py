"""Speed against accuracy of a hoist: closed forms with each way to their root, and integration step by step.

Errors are those of the lift-off, of the force over time (the worst until one period after the lift-off) and of the
greatest force, in parts of the exact values; these are found with longer numbers than float64.

Ways to a root tell evaluation by evaluation how fast they are. Bisection, Illinois's false position and Brent's method
keep a bracket and cannot fail; Newton's method and the secant can: near k t_1 = 2 pi n without acceleration the load
stands still when it lifts off, and the root is nearly triple.

Ways to the lift-off are looked at so, too, at the root of a hoist and at one that is nearly
triple: there a load without acceleration stands still as it lifts off. How far steps may reach is told by errors of
integrators over the step, and by where runs are refused.

The graphical solution stands beside these: the crossing of parabola and sinusoid, the circle, the diagram of forces.
Curves are joined by chords from section line to section line, which errs as the square of a section; a hand errs
besides, in the lift-off, in ordinates of the diagram and in the radius of the circle.

Source: R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4; M. Dowell and P. Jarratt, A
modified regula falsi method, BIT 11 (1971), for Illinois.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from ..boards.exact import ExactBoard, run
from ..hands.shaky import Hand, Paper, draw
from ..hands.spread import kept
from ..hoist.construction import FORCES, Roots, construct, drawn_name
from ..hoist.forces import rope_forces
from ..hoist.hoist import CIRCLE_PART, FORCES_PART, ROOTS_PART, Numbers
from ..hoist.model import model, model_program
from ..hoist.roots import bracket, lag, lag_rate, sine_rest
from ..hoist.solve import SolvedHoist, board_givens
from ..laws import LAWS, TURN
from .integrators import EXPLICIT, RK4, STEPPERS, integrate, stability_limit
from .race import FULL, SEED, Clock, Contest, Discipline, Effort, Entry, Way, timed

BISECTION, NEWTON, SECANT, ILLINOIS, BRENT = "bisection", "newton-root", "secant", "illinois", "brent"
MOST = 200  # evaluations
STILL = 2.0**-51  # parts of a root that are no step
BEYOND = 1e-9  # parts of a bracket by which a root on its end may be beyond it


@dataclass(frozen=True, slots=True)
class _Equation:
    """f(x) = 0 with its derivative f', and a bracket of its root: f(low) <= 0 <= f(high)."""

    value: Callable[[float], float]
    slope: Callable[[float], float]
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class _Found:
    """The root that a finder stopped at, NaN where it failed, and how often it evaluated f or f'."""

    root: float
    evaluations: int


def _lift_off_equation(V: float, a: float, k: float, height: float) -> _Equation:
    """Return (11) in x = k t: V (x - sin x) + (a/k) (x^2/2 - 1 + cos x) = k m g / C, k finite, `height` m g / C."""
    u, wanted = a / k, k * height
    low, high = map(float, bracket(V, a, k, height))
    return _Equation(lambda x: float(lag(V, u, x)) - wanted, lambda x: float(lag_rate(V, u, x)), low, high)


Guess = tuple[float, float]  # an approximation, and how far it is believed to be from the root


def _bisection(equation: _Equation) -> Iterator[Guess]:
    """Halve the bracket."""
    low, high = equation.low, equation.high
    while True:
        middle = 0.5 * (low + high)
        if equation.value(middle) < 0.0:
            low = middle
        else:
            high = middle
        yield 0.5 * (low + high), 0.5 * (high - low)


def _newton(equation: _Equation) -> Iterator[Guess]:
    """Go along the tangent, from the middle of the bracket; f and f' are two evaluations."""
    x = 0.5 * (equation.low + equation.high)
    step = math.inf
    while True:
        value, slope = equation.value(x), equation.slope(x)
        yield x, abs(step)
        step = -value / slope if slope else math.nan
        x += step
        yield x, abs(step)


def _chords(equation: _Equation, bracketed: bool) -> Iterator[Guess]:
    """Go along the chord of the two latest places, from the ends of the bracket.

    Illinois's rule keeps the root `bracketed`: an end that stays twice counts half.
    """
    x, y = equation.low, equation.high
    f_x, f_y = equation.value(x), equation.value(y)
    yield x, math.inf
    yield y, y - x
    while True:
        step = f_y * (y - x) / (f_x - f_y) if f_y != f_x else 0.0 if bracketed or f_y == 0.0 else math.nan
        z = y + step
        f_z = equation.value(z)
        yield z, abs(step)
        if bracketed and (f_z < 0.0) == (f_y < 0.0):
            f_x = 0.5 * f_x
        else:
            x, f_x = y, f_y
        y, f_y = z, f_z


def _brent(equation: _Equation) -> Iterator[Guess]:
    """Interpolate by chords and inverse parabolas where that is quick, halve where it is not."""
    a, b = equation.low, equation.high
    f_a, f_b = equation.value(a), equation.value(b)
    yield a, math.inf
    yield b, b - a
    c, f_c = a, f_a
    step = before = b - a
    while True:
        if (f_b > 0.0) == (f_c > 0.0):
            c, f_c = a, f_a
            step = before = b - a
        if abs(f_c) < abs(f_b):
            a, b, c = b, c, b
            f_a, f_b, f_c = f_b, f_c, f_b
        half, least = 0.5 * (c - b), STILL * abs(b)
        if abs(half) <= least or f_b == 0.0:
            yield b, 0.0
            continue
        if abs(before) < least or abs(f_a) <= abs(f_b):
            before = step = half
        else:
            before, step = _interpolated((a, b, c), (f_a, f_b, f_c), half, (before, step), least)
        a, f_a = b, f_b
        b += step if abs(step) > least else math.copysign(least, half)
        f_b = equation.value(b)
        yield b, abs(step)


Three = tuple[float, float, float]


def _interpolated(x: Three, f: Three, half: float, steps: tuple[float, float], least: float) -> tuple[float, float]:
    """Return the last step and the next: interpolated when that stays inside and shrinks, else half the bracket."""
    (a, b, c), (f_a, f_b, f_c), (before, step) = x, f, steps
    s = f_b / f_a
    if a == c:
        p, q = 2.0 * half * s, 1.0 - s
    else:
        q, r = f_a / f_c, f_b / f_c
        p = s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0))
        q = (q - 1.0) * (r - 1.0) * (s - 1.0)
    p, q = abs(p), (-q if p > 0.0 else q)
    if 2.0 * p < min(3.0 * half * q - abs(least * q), abs(before * q)):
        return step, p / q
    return half, half


FINDERS: Mapping[str, Callable[[_Equation], Iterator[Guess]]] = {
    BISECTION: _bisection,
    NEWTON: _newton,
    SECANT: partial(_chords, bracketed=False),
    ILLINOIS: partial(_chords, bracketed=True),
    BRENT: _brent,
}


def _find(finder: str, equation: _Equation, tolerance: float) -> _Found:
    """Return the root in the bracket, believed to be right to a part `tolerance` of itself.

    A method that finds another root, or none in `MOST` evaluations, has failed.
    """
    for count, (x, away) in enumerate(islice(FINDERS[finder](equation), MOST), 1):
        if not math.isfinite(x):
            break
        if away <= max(tolerance, STILL) * abs(x):
            inside = equation.low * (1.0 - BEYOND) <= x <= equation.high * (1.0 + BEYOND)
            return _Found(x if inside else math.nan, count)
    return _Found(math.nan, count)


Array = NDArray[np.float64]
LIFT_OFF, COURSE, PEAK = "lift_off", "course", "peak"
KINDS = (Discipline(LIFT_OFF, ("t_1",)), Discipline(COURSE, ("F_12", "P_12")), Discipline(PEAK, ("F_max",)))
FORMULAS, MISSED, DRAWN, HAND = "hoist-closed", "rk4-missed", "hoist-drawn", "hand"
TOLERANCES = (1e-2, 1e-4, 1e-8, 1e-15)
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)  # k h, rad
TINY = (0.005, 0.002)  # beside these for the method of the least order
MOST_STEPS = 10_000  # of a run; ten times as many of the method of the least order
MOST_AT_ONCE = 10_000  # hoists; more at once are no faster
PLACES = 200  # times at which closed forms are compared
CORRECTIONS = 4  # of the exact root: from 1e-8 on two are enough
COMPARED = ("V_t", "m", "g", "P_st", "C_01", "C_12", "C", "k", "k_1", "t_1", "P_m", "D_0", "D_1")
AFTER = (*COMPARED, "F_12_max", "P_12_max", "F_max")


@cache
def _from_lift_off() -> Program:
    """Return the calculations, without those that find the lift-off."""
    steps = tuple(step for step in model_program() if step.name not in ("t_1", "_t_1"))
    return Program(steps).needed_for(AFTER)


def follow(values: Numbers, t_1: Any) -> dict[str, Any]:
    """Return the quantities of a hoist that lifts off at `t_1`, found in whatever way."""
    board = ExactBoard({**values, "t_1": t_1, "_rest": 0.0})
    with np.errstate(invalid="ignore", divide="ignore"):
        board.follow(_from_lift_off())
    return {name: board.values[name] for name in ("a", "S", *AFTER)}


def exact(values: Numbers) -> dict[str, Any]:
    """Return the quantities with longer numbers than float64, where the machine has them: Newton's steps to t_1."""
    long = {name: np.longdouble(value) for name, value in values.items()}
    t_1 = np.longdouble(model(values, ("t_1",))["t_1"])
    found = follow(long, t_1)
    height = found["P_st"] / found["C"]
    swing = (found["V_t"], long["a"], found["k"])
    for _ in range(CORRECTIONS):
        t_1 = t_1 - (LAWS["lagging"](*swing, t_1) - height) / LAWS["load_rate"](*swing, t_1)
    return follow(long, t_1)


Result = tuple[Way, float, Numbers, tuple[Array, Array]]
# a way, seconds of the lift-off alone, `t_1` and `F_max`, the force of the rope over time; no number where it fails
NOTHING: tuple[float, Numbers, tuple[Array, Array]] = (
    0.0, {"t_1": np.nan, "F_max": np.nan}, (np.zeros(1), np.full(1, np.nan))
)  # fmt: skip


def _closed(values: Numbers, clock: Clock, effort: Effort, places: Array) -> Iterator[Result]:
    """Go through closed forms of so many hoists at once."""
    for size in (size for size in effort.batches if size <= MOST_AT_ONCE):
        many = {name: np.full(size, value) if size > 1 else value for name, value in values.items()}
        alone, whole = (timed(partial(model, many, names), clock)[1] / size for names in (("t_1",), AFTER))
        found = follow(values, model(values, ("t_1",))["t_1"])
        yield Way(FORMULAS, size, whole, size), alone, found, (places, rope_forces(found, places)[1])


def _found(values: Numbers, clock: Clock, places: Array) -> Iterator[Result]:
    """Go through closed forms with each way to the root, and tolerances."""
    reduced = model(values, COMPARED)
    equation = _lift_off_equation(reduced["V_t"], values["a"], reduced["k"], reduced["P_st"] / reduced["C"])
    for finder in FINDERS:
        for tolerance in TOLERANCES:
            root, alone = timed(partial(_find, finder, equation, tolerance), clock)
            if not np.isfinite(root.root):
                yield Way(finder, tolerance), *NOTHING
                continue
            found, after = timed(partial(follow, values, root.root / reduced["k"]), clock)
            way = Way(finder, tolerance, alone + after)
            yield way, alone, found, (places, rope_forces(found, places)[1])


def _stepped(values: Numbers, right: Numbers, clock: Clock) -> Iterator[Result]:
    """Go through integrators and steps; runs that are refused, or too long, give nothing."""
    reduced = model(values, COMPARED) | {"a": values["a"]}
    angle = float(right["k"] * (right["t_1"] + TURN / right["k_1"]))  # k t of a whole run
    ways = [(method, method, True) for method in STEPPERS] + [(MISSED, RK4, False)]
    for name, method, located in ways:
        for step in (*STEPS, *(TINY if method == EXPLICIT else ())):
            run, spent = None, 0.0
            if angle <= step * MOST_STEPS * (10 if method == EXPLICIT else 1):
                run, spent = timed(partial(integrate, reduced, method, step, located), clock)
            if run is None or run.refused[0]:
                yield Way(name, step), *NOTHING
                continue
            known = ~np.isnan(run.F_12[:, 0])
            found = {"t_1": run.t_1[0], "F_max": run.F_max[0]}
            yield Way(name, step, spent), spent, found, (run.t[known, 0], run.F_12[known, 0])


def _entries(right: Numbers, result: Result) -> Iterator[Entry]:
    """Go through the errors of the three kinds: `seconds` of the lift-off alone, and of everything."""
    way, alone, found, (t, force) = result
    end = np.array([float(right["t_1"])])
    if np.isnan(force[0]):
        yield from (way.entry(kind.name, end, {"": force}) for kind in KINDS)
        return
    t_1, peak = (
        {name: np.array([float(abs(np.longdouble(found[name]) / right[name] - 1.0))])} for name in ("t_1", "F_max")
    )
    away = force - rope_forces(right, t.astype(np.longdouble))[1]
    errors = np.abs(away * (1.0 / right["F_max"])).astype(float)
    resting = t < right["t_1"]
    course = {"F_12": np.where(resting, errors, np.nan), "P_12": np.where(resting, np.nan, errors)}
    yield replace(way, seconds=alone).entry(LIFT_OFF, end, t_1)
    yield way.entry(COURSE, t, course)
    yield way.entry(PEAK, end, peak)


def rivals(values: Numbers, clock: Clock, effort: Effort = FULL) -> Contest:
    """Let closed forms and integrators compete; the `clock`, best that of the processor, returns seconds.

    The `values` are complete givens, SI, of a hoist on a support that yields, whose formulas are valid.
    """
    right = exact(values)
    places = float(right["t_1"] + TURN / right["k_1"]) * ((np.arange(PLACES) + 0.5) / PLACES)
    computed = (
        *_closed(values, clock, effort, places),
        *_found(values, clock, places),
        *_stepped(values, right, clock),
    )
    entries = (entry for result in computed for entry in _entries(right, result))
    return Contest(KINDS, places, tuple(entries), effort)


EVALUATIONS = 60
AWAY = 1e-3  # rad by which the nearly triple root is from a whole turn
LEAST = 1e-17  # part of a root that is no error
TOLERANCE = 1e-14  # at which evaluations are counted


@dataclass(frozen=True, slots=True, eq=False)
class Ways:
    """Ways to one root."""

    root: float  # x = k t_1, rad
    # shape (N,): by method: of the approximation after each evaluation, in parts of the root; NaN where there is none
    errors: Mapping[str, Array]
    found: Mapping[str, _Found]  # where each method stops; the root is NaN where it fails

    def error(self, method: str) -> float:
        """Return the error where a method stops, in parts of the root."""
        return abs(self.found[method].root / self.root - 1.0)


def root_race(values: Numbers) -> dict[str, Ways]:
    """Follow all ways to the `own` root of a hoist on a support that yields, and to a nearly `triple` one.

    The `values` are its complete givens, SI.
    """
    right = exact(values)
    k, height = float(right["k"]), float(right["P_st"] / right["C"])
    V = float(right["V_t"])
    own = _lift_off_equation(V, values["a"], k, height)
    speed = V if V > 0.0 else values["a"] / k  # of a rope that starts from rest: what it has soon after
    x = TURN + AWAY
    triple = _lift_off_equation(speed, 0.0, k, speed / k * float(sine_rest(x)))
    return {"own": _ways(own, float(right["k"] * right["t_1"])), "triple": _ways(triple, x)}


def _ways(equation: _Equation, root: float) -> Ways:
    errors = {}
    for method in FINDERS:
        with np.errstate(invalid="ignore", over="ignore"):
            guesses = np.array([guess for guess, _ in islice(FINDERS[method](equation), EVALUATIONS)])
            away = np.abs(guesses / root - 1.0)
        errors[method] = np.where(np.isfinite(away), np.maximum(away, LEAST), np.nan)
    return Ways(root, errors, {method: _find(method, equation, TOLERANCE) for method in FINDERS})


TRIED = tuple(4.0 * 2.0 ** (-0.5 * i) for i in range(15))  # k h, rad: from 4 to 0.03
TRIED_TINY = tuple(2.0 ** (-0.5 * i) / 64.0 for i in range(6))  # for explicit Euler, which is refused early
SHOWING = 0.35  # k h up to which an error shows its order
ROUNDING = 1e-12  # error that is none


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """Runs by one integrator, with steps of several sizes; all arrays have the shape (N,)."""

    steps: Array  # k h, rad
    errors: Array  # of the force, the worst until one period after lift-off, parts of the greatest; NaN: refused
    grown: Array  # by what the method makes oscillations grow over the run
    limit: float  # the largest k h at which it is stable
    ratio: float  # k_1 / k: in phase 2 steps are so much smaller beside the period

    @property
    def order(self) -> float | None:
        """The power of the step as which the error falls; None where too few runs show it."""
        shown = (self.steps <= SHOWING) & (self.errors > ROUNDING)
        if shown.sum() < 2:
            return None
        return float(np.polyfit(np.log(self.steps[shown]), np.log(self.errors[shown]), 1)[0])

    @property
    def refused_from(self) -> float | None:
        """The smallest step of those tried that is refused; None where none is."""
        return min(self.steps[np.isnan(self.errors)].tolist(), default=None)


def step_limits(
    values: Numbers, steps: tuple[float, ...] = TRIED, tiny: tuple[float, ...] = TRIED_TINY
) -> dict[str, Steps]:
    """Integrate a hoist by every method with larger and larger steps, all of them at once.

    The `values` are complete givens, SI, of a hoist on a support that yields, whose formulas are valid.
    """
    right, limits = exact(values), {}
    hoist = {name: float(right[name]) for name in COMPARED} | {"a": values["a"]}
    for method in STEPPERS:
        taken = np.array((*steps, *(tiny if method == EXPLICIT else ())))
        run = integrate(hoist, method, taken)
        known = ~np.isnan(run.t)
        away = np.zeros(known.shape)  # large steps end soon: most places of their columns are empty
        forces = rope_forces(right, run.t[known].astype(np.longdouble))[1]
        away[known] = np.abs((run.F_12[known] - forces) * (1.0 / right["F_max"])).astype(float)
        errors = np.where(run.refused, np.nan, np.max(away, axis=0, initial=0.0))
        limits[method] = Steps(taken, errors, run.grown, stability_limit(method), hoist["k_1"] / hoist["k"])
    return limits


SECTIONS = (10, 20, 40, 80, 160)  # before the lift-off
DRAWINGS = 400
T_1: str = drawn_name("t_1")
ENDS = {"R": "F_12", "P": "P_12"}  # forces by the letters of the marks at their ends


def _sectioned(solved: SolvedHoist, before: int) -> tuple[Program, dict[str, Any]]:
    """Return the construction with so many sections before the lift-off, and what it begins with."""
    assert solved.layout.roots is not None
    begin = solved.layout.roots.begin
    section = (solved.forces.found["t_1"] - begin) / (before + 0.5)
    layout = replace(solved.layout, roots=Roots(begin, section, before, (), (), False))
    program = construct(layout, (ROOTS_PART, CIRCLE_PART, FORCES_PART))
    return program, {**solved.givens, **board_givens(solved.forces, layout)}


def by_board(solved: SolvedHoist, clock: Clock) -> Iterator[Entry]:
    """Go through lift-offs on exact boards with more and more sections: the crossing errs as chords do."""
    t_1 = solved.forces.found["t_1"]
    for before in SECTIONS:
        program, givens = _sectioned(solved, before)
        board, spent = timed(partial(run, program.needed_for((T_1,)), givens), clock)
        errors = {T_1: np.array([abs(float(board.values[T_1]) / t_1 - 1.0)])}
        yield Way(DRAWN, before, spent).entry(LIFT_OFF, np.array([t_1]), errors)


def by_hand(solved: SolvedHoist, mus: Numbers, hand: Hand) -> Iterator[Entry]:
    """Go through what 95 % of the drawings of a hand keep, on the sections that the sheet has.

    `mus` are the scale factors by plan, SI per mm.
    """
    assert solved.layout.roots is not None
    found, before = solved.forces.found, solved.layout.roots.lift_off
    program, givens = _sectioned(solved, before)
    paper = Paper(program, givens, solved.worth(mus), solved.edges, solved.on_paper)
    values = draw(paper, hand, np.random.default_rng(SEED), DRAWINGS).values
    exact, way = run(program, givens).values, Way(HAND, f"n = {before}")
    for kind, name, right in ((LIFT_OFF, T_1, found["t_1"]), (PEAK, "F_max", found["F_max"])):
        errors = np.broadcast_to(np.abs(values[name] - right), DRAWINGS) * (1.0 / right)
        entry = way.entry(kind, np.array([found["t_1"]]), {name: kept(errors[None], 0.0)})
        yield replace(entry, typical=float(np.median(errors)))
    ends = {f"{FORCES}.{letter}{i}": force for letter, force in ENDS.items() for i in range(len(exact))}
    marks = [mark for mark in exact if mark in ends]
    worth = givens["mu_F"] * (1.0 / found["F_max"])
    lines = np.array([float(kept(worth * np.abs(values[m].imag - exact[m].imag), 0.0)) for m in marks])
    course = {of: np.where([ends[mark] == of for mark in marks], lines, np.nan) for of in ENDS.values()}
    times = np.array([float(exact[mark].real) for mark in marks]) * givens["mu_t"]
    yield way.entry(COURSE, times, course)
