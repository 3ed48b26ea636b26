"""The forces of a hoist as a construction, in the order of a student's note: numbers, and the circle of phase 2.

Its laws of calculation take and give numbers or arrays, in SI; the numbers in brackets are those of the article's
formulas, a prime marks an exact one in the place of a simplified one. A rigid beam has an infinite stiffness: what then
is zero is found to be zero, without a large number in its place.

Until t_1 the load stands on the support beam, and the rope only takes it up; then it hangs. What the two-sided formulas
give is only valid while the rope pulls and the support pushes: `forces` looks, and takes the motion where it is not.

Near k t_1 = 2 pi n, without acceleration of the drum, speed and acceleration of the load are both nearly zero at the
lift-off, and the root of (11) is nearly triple: sixteen digits leave five of t_1. What is missing is found with
fifty digits, from the givens.

Source: Karpenko, Muzyka, Gudym, Evaluation of the forces in the lifting rope taking into account the resilience of its
links; deflections: any course of strength of materials.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import Any

import numpy as np

from ..board import Board, Program, recorded
from ..boards.arrays import ArrayBoard
from ..boards.exact import ExactBoard
from ..laws import TURN, Sign, define
from ..names import is_shown, role
from ..solved import calculated
from . import roots
from .hoist import DRAWN, VALUES, Numbers
from .onesided import zero_between

NINE_ROOTS = Sign(9.0 * math.sqrt(3.0), "9·√(3)")


def _phase(k: Any, t: Any) -> tuple[Any, Any]:
    """Return k t and 1/k; on a rigid support nothing swings, and 1/k is zero."""
    rigid = np.isinf(k)
    return np.where(rigid, 0.0, np.where(rigid, 1.0, k) * t), 1.0 / k


def _oscillation(V: Any, a: Any, k: Any, t: Any) -> Any:
    x, period = _phase(k, t)
    half = np.sin(0.5 * x)
    return (2.0 * a * period * (half * half) + V * np.sin(x)) * period


def _oscillation_rate(V: Any, a: Any, k: Any, t: Any) -> Any:
    """Return the rate of the oscillation; on a rigid support it has no part in any force."""
    x, period = _phase(k, t)
    return a * period * np.sin(x) + V * np.cos(x)


def _lagging(V: Any, a: Any, k: Any, t: Any) -> Any:
    """Return what is wound up less the oscillation, without cancellation."""
    x, period = _phase(k, t)
    return np.where(np.isinf(k), V * t + 0.5 * a * t * t, roots.lag(V, a * period, x) * period)


def _load_rate(V: Any, a: Any, k: Any, t: Any) -> Any:
    x, period = _phase(k, t)
    return np.where(np.isinf(k), V + a * t, roots.lag_rate(V, a * period, x))


def _greatest_deflection(force: Any, b: Any, l: Any, I: Any, E: Any) -> Any:
    square = (l - b) * (l + b)
    return 1.0 / NINE_ROOTS * force * b * square * np.sqrt(square) / (l * E * I)


def _deflection_of_unit(x: Any, b: Any, l: Any, I: Any, E: Any) -> Any:
    """Return how far a force of 1 N at b bends a simple beam at x, both from one end; the far part is its mirror."""
    near = x <= b
    place, load = np.where(near, x, l - x), np.where(near, b, l - b)
    rest = l - load
    return rest * place * ((l - rest) * (l + rest) - place * place) / (6.0 * E * I * l)


define(
    # (4)
    reduced_mass=lambda G_1, G_2, g: (G_1 + G_2 / 3.0) / g,
    # (6)
    place_factor=lambda beta: 1.0 / (beta * beta * ((1.0 - beta) * (1.0 - beta))),
    # (5)
    beam_stiffness=lambda E, I, alpha, l: 3.0 * E * I * alpha / (l * l * l),
    # (7)
    rope_stiffness=lambda S, E_k, L: S * E_k / L,
    # (7)
    in_series=(
        lambda first, second: 1.0 / (1.0 / first + 1.0 / second),
        lambda first, second: first * second / (first + second),
    ),
    frequency_between=lambda first, second, m: np.sqrt((first + second) / m),
    frequency=lambda stiffness, m: np.sqrt(stiffness / m),
    # C_12 / (C_01 + C_12), of C_12 once more
    support_share=lambda C_12, C_01: C_12 / (C_01 + C_12),
    static_force=lambda m, g: m * g,
    taut_speed=lambda V_0, a, slack: np.sqrt(V_0 * V_0 + 2.0 * a * slack),
    ratio=lambda part, whole: part / whole,
    product=lambda first, second: first * second,
    # (11) y - osc = m g / C
    lift_off=roots.lift_off,
    wound=lambda V, a, t: V * t + 0.5 * a * t * t,
    winding_speed=lambda V, a, t: V + a * t,
    # osc = (a / k^2) (1 - cos k t) + (V / k) sin k t
    oscillation=(
        _oscillation,
        lambda V, a, k, t: a / k**2 * (1.0 - np.cos(k * t)) + V / k * np.sin(k * t),
    ),
    oscillation_rate=(_oscillation_rate, lambda V, a, k, t: a / k * np.sin(k * t) + V * np.cos(k * t)),
    # y - osc, and its rate
    lagging=_lagging,
    load_rate=_load_rate,
    # (9) F_01 = C (y - osc) - m g
    support_force=lambda C, lagging, weight: C * lagging - weight,
    # (10) F_12 = C y + C (C_12 / C_01) osc, with C C_12 / C_01 = mu C_12; the rate likewise
    rope_force=lambda C, wound, C_osc, oscillation: C * wound + C_osc * oscillation,
    rope_force_of_both=lambda C, C_12, C_01, oscillation, wound: C * (C_12 / C_01 * oscillation + wound),
    # (12), and its solutions: when the force of the rope was last greatest, and when first least
    last_maximum=roots.last_maximum,
    first_minimum=roots.first_minimum,
    # of two forces, of which one may be undefined because nothing is there
    larger_of=lambda first, second: np.fmax(first, second),
    smaller_of=lambda first, second: np.fmin(first, second),
    time_of_larger=lambda first, second, t_first, t_second: np.where(first > second, t_first, t_second),
    # (13) P_m = m (g + a)
    mean_force=lambda m, g, a: m * (g + a),
    # (14') P_12 = P_m + D_0 cos k_1 T + D_1 sin k_1 T
    swing=lambda swing, rate, k, t: swing * np.cos(k * t) + rate * np.sin(k * t),
    suspended_force=lambda mean, swing: mean + swing,
    # (15') R and k_1 T_1 are read from the circle; the angle is one from 0 to 2 pi
    angle_above=lambda side, along: np.arctan(side / along),
    angle_left=lambda side, along: math.pi + np.arctan(side / along),
    angle_below=lambda side, along: TURN + np.arctan(side / along),
    whole_angle=lambda angle: angle + TURN * (angle < 0.0),
    # s = y - m g / C_01 - P_12 / C_12
    height=lambda wound, weight, C_01, force, C_12: wound - weight / C_01 - force / C_12,
    lowest_after=roots.lowest_after,
    later=lambda t, T: t + T,
    # the article's P_12: V_0 of a slack rope, (14) with its greatest value, (15) with the angle that belongs to it
    article_speed=lambda V_0, a, slack, weight, C_12: np.where(
        slack > 0.0, np.sqrt(2.0 * a * (slack + weight / C_12)), V_0
    ),
    article_force=lambda m, g, a, V, C_12, k_1, T: (
        m * g + m * a * (1.0 - np.cos(k_1 * T)) + V * np.sqrt(m * C_12) * np.sin(k_1 * T)
    ),
    article_maximum=lambda m, g, a, V, C_12: m * g + m * a + np.sqrt((m * a) * (m * a) + V * V * m * C_12),
    article_time=lambda V, k_1, a: np.arctan2(V * k_1, -a) / k_1,
    stress=lambda force, S: force / S,
    # the greatest deflection, and its place from the far end
    greatest_deflection=(
        _greatest_deflection,
        lambda force, b, l, I, E: force * b * (l**2 - b**2) ** 1.5 / (NINE_ROOTS * E * I * l),
    ),
    place_of_deflection=(lambda b, l: np.sqrt((l - b) * (l + b) / 3.0), lambda b, l: np.sqrt((l**2 - b**2) / 3.0)),
    # w = P (l - b) x (l^2 - (l - b)^2 - x^2) / (6 E I l) before the load
    deflection_of_unit=_deflection_of_unit,
    # the time of one swing
    period=lambda k: TURN / k,
    # w = P b^2 (l - b)^2 / (3 E I l) under the load
    deflection=lambda force, stiffness: force / stiffness,
)


BEAMS = (0, 2)  # the support beam and the bridge beam


def _reduced(board: Board) -> None:
    """Reduced mass and stiffnesses, formulas (4) to (7)."""
    board.calc("m", "reduced_mass", "G_1", "G_2", "g")
    board.calc("P_st", "static_force", "m", "g")
    for i in BEAMS:
        board.calc(f"alpha_{i}", "place_factor", f"beta_{i}")
        board.calc(f"b_{i}", "product", f"beta_{i}", f"l_{i}")
    board.calc("C_01", "beam_stiffness", "E_0", "I_0", "alpha_0", "l_0")
    board.calc("C_k", "rope_stiffness", "S", "E_k", "L")
    board.calc("C_2", "beam_stiffness", "E_2", "I_2", "alpha_2", "l_2")
    board.calc("C_12", "in_series", "C_k", "C_2")
    board.calc("C", "in_series", "C_01", "C_12")
    board.calc("k", "frequency_between", "C_01", "C_12", "m")
    board.calc("k_1", "frequency", "C_12", "m")
    board.calc("V_t", "taut_speed", "V_0", "a", "slack")


def _shared(board: Board) -> None:
    """How much of what oscillates comes to the rope."""
    board.calc("_mu", "support_share", "C_12", "C_01")
    board.calc("_C_osc", "product", "_mu", "C_12")


def _lifting_off(board: Board) -> None:
    """The end of phase 1, formula (11), and what the rope and the load do there."""
    _shared(board)
    board.calc("_height", "ratio", "P_st", "C")
    board.calc("_t_1", "lift_off", "V_t", "a", "k", "_height")
    board.calc("t_1", "later", "_t_1", "_rest")
    _lifted_off(board)


def _lifted_off(board: Board) -> None:
    """What the rope and the load do at the end of phase 1."""
    rope_force(board, "F_12_t1", "t_1")
    board.calc("_dosc_t1", "oscillation_rate", "V_t", "a", "k", "t_1")
    board.calc("_dy_t1", "winding_speed", "V_t", "a", "t_1")
    board.calc("_dF_t1", "rope_force", "C", "_dy_t1", "_C_osc", "_dosc_t1")


def rope_force(board: Board, name: str, time: str) -> None:
    """The force of the rope in phase 1 at a time: formula (10)."""
    board.calc(f"_y_{name}", "wound", "V_t", "a", time)
    board.calc(f"_osc_{name}", "oscillation", "V_t", "a", "k", time)
    board.calc(name, "rope_force", "C", f"_y_{name}", "_C_osc", f"_osc_{name}")


def swinging(values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return what the forces over time follow from, of complete givens and t_1."""
    board = ExactBoard(values)
    board.follow(recorded(_reduced, _shared, _lifted_off, _hanging))
    return board.values


def lift_off_between(values: Mapping[str, Any]) -> tuple[Any, Any, Any]:
    """Return of (11) by how much a t_1 is too great, as a length times k, and two times between which it is not.

    The `values` are complete givens and t_1; no beam is rigid.
    """
    board = ExactBoard(values)
    board.follow(recorded(_reduced, lambda board: board.calc("_height", "ratio", "P_st", "C")))
    V, a, k, height = (board.values[name] for name in ("V_t", "a", "k", "_height"))
    low, high = roots.bracket(V, a, k, height)
    return roots.lag(V, a / k, k * values["t_1"]) - k * height, low / k, high / k


CIRCLE, HORIZONTAL = "circle", "_right"


def _extremes(board: Board) -> None:
    """The greatest and the least force of the rope in phase 1: formula (12)."""
    board.calc("_ratio", "ratio", "C_01", "C_12")
    board.calc("_t_last", "last_maximum", "V_t", "a", "k", "_ratio", "t_1")
    board.calc("_t_first", "first_minimum", "V_t", "a", "k", "_ratio", "t_1")
    rope_force(board, "_F_last", "_t_last")
    rope_force(board, "_F_first", "_t_first")
    board.calc("F_12_max", "larger_of", "_F_last", "F_12_t1")
    board.calc("t_F12_max", "time_of_larger", "_F_last", "F_12_t1", "_t_last", "t_1")
    board.calc("F_12_min", "smaller_of", "_F_first", "F_12_t1")


def _hanging(board: Board) -> None:
    """The mean force of the rope in phase 2, formula (13), and what it swings about that with."""
    board.calc("P_m", "mean_force", "m", "g", "a")
    board.calc("D_0", "excess", "F_12_t1", "P_m")
    board.calc("D_1", "ratio", "_dF_t1", "k_1")


def _circle(board: Board) -> None:
    """Phase 2 as a circle: abscissas are the force of the rope, ordinates its rate by k_1."""
    _hanging(board)
    board.place(f"{CIRCLE}.C", "P_m", "zero")
    board.place(f"{CIRCLE}.1", "F_12_t1", "D_1")
    board.distance("R", f"{CIRCLE}.C", f"{CIRCLE}.1")
    board.read("_radius", f"{CIRCLE}.C", f"{CIRCLE}.1")
    board.turn(HORIZONTAL, "zero")
    board.angle("_phi", HORIZONTAL, "_radius")
    board.calc("phi_1", "whole_angle", "_phi")


def _suspended(board: Board) -> None:
    """The greatest and the least force of the rope in phase 2, at the ends of a diameter: formula (15')."""
    board.calc("T_1", "ratio", "phi_1", "k_1")
    board.calc("P_12_max", "sum", "P_m", "R")
    board.calc("P_12_min", "excess", "P_m", "R")


def _lifted(board: Board) -> None:
    """How high above the support the load is when it is lowest after the lift-off."""
    board.calc("_T_low", "lowest_after", "_dy_t1", "a", "k_1", "D_0", "D_1", "m")
    board.calc("_t_low", "later", "t_1", "_T_low")
    board.calc("_y_low", "wound", "V_t", "a", "_t_low")
    board.calc("_D_low", "swing", "D_0", "D_1", "k_1", "_T_low")
    board.calc("_P_low", "suspended_force", "P_m", "_D_low")
    board.calc("s_min", "height", "_y_low", "P_st", "C_01", "_P_low", "C_12")


def _printed(board: Board) -> None:
    """What the article prints: formulas (14) and (15), for a rigid support and V_0 as the speed at the lift-off."""
    board.calc("_V_printed", "article_speed", "V_0", "a", "slack", "P_st", "C_12")
    board.calc("P_12_max_printed", "article_maximum", "m", "g", "a", "_V_printed", "C_12")
    board.calc("T_1_printed", "article_time", "_V_printed", "k_1", "a")
    board.calc("_stress_printed", "stress", "P_12_max_printed", "S")
    board.calc("_safety_printed", "ratio", "sigma", "_stress_printed")


def _strength(board: Board) -> None:
    """The stress of the rope, its safety, and how far the beams bend."""
    board.calc("F_max", "larger_of", "F_12_max", "P_12_max")
    board.calc("sigma_max", "stress", "F_max", "S")
    board.calc("safety", "ratio", "sigma", "sigma_max")
    board.calc("dynamic_factor", "ratio", "P_12_max", "P_st")
    for i, force in zip(BEAMS, ("P_st", "P_12_max"), strict=True):
        board.calc(f"w_{i}_max", "greatest_deflection", force, f"b_{i}", f"l_{i}", f"I_{i}", f"E_{i}")
        board.calc(f"x_w{i}", "place_of_deflection", f"b_{i}", f"l_{i}")


def moved(*names: str) -> Callable[[Board], None]:
    """Return what the motion of a load on a one-sided support, by a one-sided rope, gives in the place of formulas."""

    def given(board: Board) -> None:
        for name in names:
            board.calc(name, "given", motion_given(name))

    return given


def motion_given(name: str) -> str:
    """Return the name of the given that is a quantity's value in the motion."""
    return f"_{role(name).shown}_motion"


TWO_SIDED = (_reduced, _lifting_off, _extremes, _circle, _suspended, _lifted, _strength, _printed)
IN_PHASE_1 = moved("t_1", "F_12_t1", "_dF_t1", "F_12_max", "t_F12_max", "F_12_min")
ONE_SIDED = (_reduced, IN_PHASE_1, _circle, moved("T_1", "P_12_max", "P_12_min", "s_min"), _strength, _printed)


def model_program(one_sided: bool = False) -> Program:
    """Return all steps, in order, recorded: formulas, or with the results of a motion in the place of some of them."""
    return recorded(*(ONE_SIDED if one_sided else TWO_SIDED))


@cache
def _needed(wanted: tuple[str, ...], one_sided: bool) -> Program:
    program = model_program(one_sided)
    return program.needed_for(wanted) if wanted else program


def model(values: Numbers, wanted: Iterable[str] = (), one_sided: bool = False) -> dict[str, Any]:
    """Return the quantities of a hoist by name, in SI, after the givens; by the formulas, whether valid or not.

    The `values` are complete givens of any shapes that go together; with `one_sided` those of the motion, too.
    Quantities `wanted`, by default all, come with those that they need; where a beam is rigid, some are infinite.
    """
    program = _needed(tuple(wanted), one_sided)
    values = {name: value if np.ndim(value) else np.float64(value) for name, value in values.items()}  # 1/0 is inf
    givens = {**values, "_rest": 0.0 if one_sided else rest_of_root(values)}
    many = [value for value in givens.values() if np.ndim(value)]
    board = ArrayBoard(givens, np.broadcast(*many).size) if many else ExactBoard(givens)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        program.run(board)
    names = (name for name in (*values, *program.names) if is_shown(name))
    found = {name: board.values[name] for name in names}
    return {name: value if np.ndim(value) else float(value) for name, value in found.items()}


ILL = 1e3  # how much larger than those of the givens errors of t_1 may be without more digits
CLOSE = 1e-20  # part of t_1 that is none
BRACKET = 1e-4  # rad, first guess of how far the root is from that found with sixteen digits


@np.errstate(invalid="ignore", divide="ignore")
def _condition(V: Any, a: Any, k: Any, height: Any, t_1: Any) -> Any:
    """Return by how much errors of m g / C grow in t_1: height / (t_1 * slope), one or less on a rigid support."""
    x, _ = _phase(k, t_1)
    return np.where(np.isinf(k), 1.0, height / (t_1 * roots.lag_rate(V, a / k, x)))


define(condition_of_root=_condition)


@cache
def _programs() -> tuple[Program, Program]:
    """Return the calculation of the root with its condition, and of what it depends on."""

    def condition(board: Board) -> None:
        board.calc("_condition", "condition_of_root", "V_t", "a", "k", "_height", "_t_1")

    whole = recorded(_reduced, _lifting_off, condition)
    return whole.needed_for(("_condition",)), whole.needed_for(("V_t", "k", "_height"))


def rest_of_root(values: Numbers) -> Any:
    """Return what has to be added to t_1 as it is found with sixteen digits: zero almost everywhere.

    The `values` are complete givens, of any shapes that go together.
    """
    program, exact = _programs()
    board = ExactBoard(values)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board.follow(program)
    condition, t_1 = np.broadcast_arrays(board.values["_condition"], board.values["_t_1"])
    rest = np.zeros(condition.shape)
    ill = np.argwhere(condition > ILL)
    if not len(ill):
        return rest if rest.ndim else 0.0
    arrays = {name: np.broadcast_to(np.asarray(values[name]), rest.shape) for name in VALUES}
    for index in map(tuple, ill):
        one = {name: float(array[index]) for name, array in arrays.items()}
        rest[index] = _rest(exact, one, float(t_1[index]))
    return rest if rest.ndim else float(rest)


def _rest(program: Program, values: Numbers, t_1: float) -> float:
    """Return the rest of one root, between two places: the function never falls."""
    from mpmath import mp, mpf

    from ..boards.precision import DIGITS, fifty_digits

    with mp.workdps(DIGITS):
        found = fifty_digits(program, values)
        V, k, height, a = found["V_t"], found["k"], found["_height"], mpf(values["a"])
        u, x, reach = a / k, k * mpf(t_1), mpf(BRACKET)

        def surplus(x: Any) -> tuple[Any, Any]:  # (11) once more: fifty digits cancel without harm, `lag` has but 16
            sine, cosine = x - mp.sin(x), 1 - mp.cos(x)
            return V * sine + u * (x * x / 2 - cosine) - k * height, V * cosine + u * sine

        while surplus(x - reach)[0] > 0 or surplus(x + reach)[0] < 0:
            reach *= 2
        return float(zero_between(surplus, x - reach, x + reach, CLOSE) / k - mpf(t_1))


PARTS = {
    "reduced": (_reduced,),
    "resting": (_lifting_off, _extremes),
    "hanging": (_circle, _suspended, _lifted),
    "strength": (_strength,),
    "printed": (_printed,),
}
SECTIONS = (*PARTS, DRAWN)


@cache
def _calculated() -> Mapping[str, str]:
    """Return the section of every calculated quantity."""
    return calculated(PARTS)


def section_of(name: str) -> str:
    """Return the section of a quantity, of `SECTIONS`: what is not calculated is drawn.

    >>> section_of("C_12"), section_of("t_1"), section_of("T_1"), section_of("t_1_drawn")
    ('reduced', 'resting', 'hanging', 'drawn')
    """
    return _calculated().get(name, DRAWN)
