"""The geometry of a gear pair as a construction of calculations only, in the order of a student's note, and its laws.

Of every wheel's quantities the name ends in its number: d_1 and d_w1. The laws, for external spur gears cut by a rack,
take and give numbers or arrays, in SI, angles in radians. Own and other mean the wheel itself and its mate.

The involute function inv(alpha) = tan(alpha) - alpha and its inverse are known to the last digits at every angle: both
work on t = tan(alpha), in which t - arctan(t) is a series where the difference of the two would lose digits.

Source: GOST 16532-70.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import cache, wraps
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Board, Program, recorded
from ..boards.exact import ExactBoard
from ..laws import HALF_TURN, NAN, WHOLE_TURN, Law, Sign, as_number, bracketed, define, named
from ..names import role
from .gear import WHEELS, ordinate

Array = NDArray[np.float64]
SMALL = 0.5  # below it the series is summed
TERMS = tuple((-1.0) ** k / (2 * k + 3) for k in range(26))  # t - arctan(t) = t^3 (1/3 - t^2/5 + t^4/7 - ...)
STEPS = 6  # of Newton, which needs four from the start that it has


def _known(slope: Callable[[Any], Any]) -> Callable[[Callable[[Any], Array]], Callable[[Any], Any]]:
    """Return what lets a function take numbers that know their derivatives, by its own `slope`."""
    return lambda function: wraps(function)(
        lambda x: x.through(function, slope) if hasattr(x, "through") else function(x)
    )


@_known(lambda t: t * t / (1.0 + t * t))
def unrolled(t: Any) -> Array:
    """Return t - arctan(t): the involute function of an angle whose tangent is `t`.

    For a point of an involute t is also the angle by which the line has been unrolled from the base circle.
    """
    t = np.asarray(t, float)
    square = np.minimum(t * t, SMALL * SMALL)
    series = np.full_like(t, TERMS[-1])
    for term in TERMS[-2::-1]:
        series = series * square + term
    found: Array = np.where(np.abs(t) < SMALL, t * square * series, t - np.arctan(t))
    return found


def _involute(alpha: Any) -> Any:
    """Return inv(alpha) of angles, rad, between right angles."""
    return unrolled(np.tan(alpha))


@_known(lambda inv: 1.0 + tangent_of_involute(inv) ** -2.0)
def tangent_of_involute(inv: Any) -> Array:
    """Return tan(alpha) of the angles with the given involute functions, at least 0; NaN where these are negative.

    Newton's steps on t - arctan(t), which is convex: the first one passes the root, the others come down to it.
    """
    inv = np.asarray(inv, float)
    kept = np.where(inv > 0.0, inv, 1.0)
    t = np.maximum(np.cbrt(3.0 * kept), kept)  # both are below the root
    for _ in range(STEPS):
        t = t - (unrolled(t) - kept) * (1.0 + 1.0 / (t * t))
    found: Array = np.where(inv > 0.0, t, np.where(inv == 0.0, 0.0, np.nan))
    return found


def _angle_of_involute(inv: Any) -> Any:
    """Return the angles, rad, with the given involute functions; NaN where these are negative."""
    return np.arctan(tangent_of_involute(inv))


inv = named("inv", _involute)
IN_DEGREES = Sign(1.0, "180°/π")  # of radians


def _angle_of(base: Any, diameter: Any) -> Any:
    """Return the profile angle at a diameter: cos = base / diameter; NaN inside the base circle."""
    square = (diameter - base) * (diameter + base)
    return np.arctan2(np.sqrt(np.where(square >= 0.0, square, NAN)), base)


def _sliding(own: Any, other: Any, ratio: Any) -> Any:
    """Return 1 - other / (own * ratio): minus infinity on the own base circle, NaN beyond either line's end."""
    positive = np.where(own > 0.0, own, 1.0)
    at_end = np.where(own == 0.0, -np.inf, NAN)
    return np.where(other >= 0.0, np.where(own > 0.0, 1.0 - other / (positive * ratio), at_end), NAN)


def _fillet(h_a: Any, h_l: Any, c: Any, alpha: Any) -> Any:
    """Return the radius of the rack's corner in modules: it begins where the straight edge ends, or fills the tip."""
    sine, cosine = np.sin(alpha), np.cos(alpha)
    joined = (2.0 * h_a + c - h_l) / (1.0 - sine)
    round_tip = (0.25 * math.pi * cosine - (h_a + c) * sine) / (1.0 - sine)
    return np.minimum(joined, round_tip)


def _spanned(z: Any, x: Any, alpha: Any) -> Any:
    """Return over how many teeth the common normal is measured, so that it touches near the circle d + 2 x m."""
    base, middle = z * np.cos(alpha), np.maximum(z + 2.0 * x, z * np.cos(alpha))
    touched = np.tan(_angle_of(base, middle)) - 2.0 * x * np.tan(alpha) / z - _involute(alpha)
    return np.maximum(np.floor(z / math.pi * touched + 1.0), 1.0)


def _touching(number: Any, rho_p: Any, rho_a: Any, s_b: Any, p_b: Any) -> Any:
    """Return the number of teeth next to `number` whose normal touches active flanks; NaN where there is none."""
    least, most = np.ceil((2.0 * rho_p - s_b) / p_b), np.floor((2.0 * rho_a - s_b) / p_b)
    return np.where(least <= most, np.maximum(np.minimum(number, most + 1.0), least + 1.0), NAN)


def _on_numbers(law: Law) -> Law:
    """Return a law that gives a plain number for plain numbers, and NaN rather than a warning."""

    @wraps(law)
    def found(*operands: Any) -> Any:
        with np.errstate(all="ignore"):
            return as_number(law(*operands))

    return found


def _define(**laws: Law | tuple[Law, Law]) -> None:
    """Add laws to the table, for numbers and for arrays."""
    for name, law in laws.items():
        define(**{name: (_on_numbers(law[0]), law[1]) if isinstance(law, tuple) else _on_numbers(law)})


_define(
    reference_centre=lambda m, z_1, z_2: 0.5 * m * (z_1 + z_2),
    involute=(_involute, lambda alpha: np.tan(alpha) - alpha * math.pi / HALF_TURN),
    working_involute=lambda inv, x_sum, alpha, z_1, z_2: inv + 2.0 * x_sum * np.tan(alpha) / (z_1 + z_2),
    angle_of_involute=_angle_of_involute,
    # the angle and the sum of shifts follow from a given a_w
    working_centre=lambda a, alpha, alpha_w: a * np.cos(alpha) / np.cos(alpha_w),
    working_angle=lambda a, alpha, a_w: _angle_of(a * np.cos(alpha), a_w),
    sum_of_shifts=lambda z_1, z_2, alpha, inv, inv_w: (z_1 + z_2) * (inv_w - inv) / (2.0 * np.tan(alpha)),
    reference_diameter=lambda m, z: m * z,
    gear_ratio=lambda z_1, z_2: z_2 / z_1,
    rolling_diameter_of_pinion=lambda a_w, u: 2.0 * a_w / (u + 1.0),
    rolling_diameter_of_wheel=lambda a_w, u: 2.0 * a_w * u / (u + 1.0),
    perceived_shift=lambda a_w, a, m: (a_w - a) / m,
    tip_diameter=lambda d, h_a, x, delta_y, m: d + 2.0 * (h_a + x - delta_y) * m,
    root_diameter=lambda d, h_a, c, x, m: d - 2.0 * (h_a + c - x) * m,
    # the distance of the centres in other ways
    centre_by_rolling=lambda d_w1, d_w2: 0.5 * d_w1 + 0.5 * d_w2,
    centre_by_shift=lambda d_1, d_2, y, m: 0.5 * d_1 + 0.5 * d_2 + y * m,
    centre_by_clearance=lambda d_a, d_f, c, m: 0.5 * d_a + 0.5 * d_f + c * m,
    base_diameter=lambda d, alpha: d * np.cos(alpha),
    angular_pitch=(lambda z: 2.0 * math.pi / z, lambda z: WHOLE_TURN / z),
    pitch_chord=lambda d, tau: d * np.sin(0.5 * tau),
    pitch=lambda m: math.pi * m,
    base_pitch=lambda p, alpha: p * np.cos(alpha),
    # thickness at another circle
    tooth_thickness=lambda m, x, alpha: (0.5 * math.pi + 2.0 * x * np.tan(alpha)) * m,
    thickness_at=lambda d_y, s, d, inv, inv_y: d_y * (s / d + inv - inv_y),
    tooth_depth=lambda h_a, c, delta_y, m: (2.0 * h_a + c - delta_y) * m,
    tip_angle=(_angle_of, lambda d_b, d_a: np.arccos(d_b / d_a)),
    line_of_action=lambda a_w, alpha_w: a_w * np.sin(alpha_w),
    # at the tip, and at the lower point of contact, from alpha_a of the mate
    radius_of_curvature=lambda d_b, angle: 0.5 * d_b * np.tan(angle),
    lower_curvature=lambda a_w, alpha_w, d_b, alpha_a: a_w * np.sin(alpha_w) - 0.5 * d_b * np.tan(alpha_a),
    # to a point of the flank, and the circle there
    unrolled_angle=(lambda rho, d_b: 2.0 * rho / d_b, lambda rho, d_b: bracketed(2.0 * rho / d_b) * IN_DEGREES),
    diameter_of_curvature=lambda rho, d_b: np.hypot(2.0 * rho, d_b),
    least_shift=lambda h_l, h_a, z, alpha: h_l - h_a - 0.5 * z * np.sin(alpha) ** 2,
    boundary_curvature=lambda d, alpha, h_l, h_a, x, m: 0.5 * d * np.sin(alpha) - (h_l - h_a - x) * m / np.sin(alpha),
    contact_ratio=lambda z_1, alpha_a1, z_2, alpha_a2, alpha_w: (
        (z_1 * np.tan(alpha_a1) + z_2 * np.tan(alpha_a2) - (z_1 + z_2) * np.tan(alpha_w)) / (2.0 * math.pi)
    ),
    tip_thickness=lambda m, z, x, alpha, alpha_a: (
        (0.5 * math.pi + 2.0 * x * np.tan(alpha) + z * (inv(alpha) - inv(alpha_a)))
        * m
        * np.cos(alpha)
        / np.cos(alpha_a)
    ),
    # theta_12 = 1 - (rho_2 / rho_1) / u, theta_21 = 1 - u rho_1 / rho_2
    sliding_of_pinion=_sliding,
    sliding_of_wheel=lambda own, other, ratio: _sliding(own, other, 1.0 / ratio),
    # chord that touches a tooth where the rack does, and its height; common normal over z_W teeth
    constant_chord=lambda m, x, alpha: (0.5 * math.pi * np.cos(alpha) ** 2 + x * np.sin(2.0 * alpha)) * m,
    height_of_chord=lambda d_a, d, s_c, alpha: 0.5 * (d_a - d - s_c * np.tan(alpha)),
    spanned_teeth=_spanned,
    teeth_touched=_touching,
    base_thickness=lambda s, d, inv, d_b: (s / d + inv) * d_b,
    common_normal=lambda s_b, p_b, z_W: s_b + (z_W - 1.0) * p_b,
    rack_corner=lambda h_a, h_l, c, alpha, m: _fillet(h_a, h_l, c, alpha) * m,
    # places along N1N2 for a table of sliding
    within_line=lambda rho, line: np.minimum(np.maximum(rho, 0.0), line),
    least_of_three=lambda first, second, third: np.minimum(np.minimum(first, second), third),
    middle_of_three=lambda first, second, third: np.maximum(
        np.minimum(first, second), np.minimum(np.maximum(first, second), third)
    ),
    most_of_three=lambda first, second, third: np.maximum(np.maximum(first, second), third),
    part_between=lambda begin, end, part: begin + (end - begin) * part,
    # y = PW rho / rho at the pole; theta = (y - y of the mate) / y
    velocity_ordinate=lambda PW, rho, rho_P: PW * (rho / rho_P),
    sliding_by_ordinates=lambda own, other: _sliding(own, other, 1.0),
    # drawn quantities: lengths and numbers on paper, epsilon_alpha = g_alpha / p_b = phi_alpha / tau
    half_of=lambda whole: 0.5 * whole,
    on_paper=lambda value, mu: value / mu,
    ratio_of=lambda part, whole: part / whole,
    # the pinion's angle from the contact in the pole, and what the wheel makes of a length by its own angle
    contact_angle=lambda rho, rho_w, r_b: (rho - rho_w) / r_b,
    at_ratio=lambda rho, u: rho / u,
    # directions on the drawing: the line of action, radii where it touches, the axis and the flanks of a tooth
    angle_of_action=lambda alpha_w, sense: 0.5 * math.pi + sense * (0.5 * math.pi - alpha_w),
    unrolled_part=lambda length, part, whole: length * (part / whole),
    angle_of_tangency=lambda base, sense, alpha_w, rho_w, rho, r_b: base - sense * (alpha_w - (rho_w - rho) / r_b),
    angle_of_thickness=lambda s, d: s / d,
    angle_of_tooth=lambda base, sense, half, tau, number: base + sense * (number * tau - half),
    angle_beside=lambda axis, sense, half: axis + sense * half,
    # the angle at the centre between two points of a flank: inv alpha_y - inv alpha
    unrolled_involute=unrolled,
    angle_on_flank=lambda inv_y, inv, sense: sense * (inv_y - inv),
)

NAMES = {1: "pinion", 2: "wheel"}
POINTS = tuple(f"{k:02d}" for k in range(1, 13))  # of the table of sliding
# where the points lie: between which of N1, the three places that follow (A1, P, A2 in a common pair), N2, in parts
DIVISIONS = ((0, 2), (1, 3), (2, 2), (3, 4))
PARTS = {f"_part_{j}_{n}": j / n for _, n in DIVISIONS for j in range(n)}
NOTHING = {"_zero": 0.0}


def _main_sizes(board: Board) -> None:
    """Sizes of the pair and its wheels: sections 1 to 11 of the note."""
    board.calc("a", "reference_centre", "m", "z_1", "z_2")
    board.calc("x_sum", "sum", "x_1", "x_2")
    board.calc("inv_alpha", "involute", "alpha")
    board.calc("inv_alpha_w", "working_involute", "inv_alpha", "x_sum", "alpha", "z_1", "z_2")
    board.calc("alpha_w", "angle_of_involute", "inv_alpha_w")
    board.calc("a_w", "working_centre", "a", "alpha", "alpha_w")
    for i in WHEELS:
        board.calc(f"d_{i}", "reference_diameter", "m", f"z_{i}")
    board.calc("u", "gear_ratio", "z_1", "z_2")
    for i in WHEELS:
        board.calc(f"d_w{i}", f"rolling_diameter_of_{NAMES[i]}", "a_w", "u")
    board.calc("y", "perceived_shift", "a_w", "a", "m")
    board.calc("delta_y", "excess", "x_sum", "y")
    for i in WHEELS:
        board.calc(f"d_a{i}", "tip_diameter", f"d_{i}", "h_a", f"x_{i}", "delta_y", "m")
    for i in WHEELS:
        board.calc(f"d_f{i}", "root_diameter", f"d_{i}", "h_a", "c", f"x_{i}", "m")


def _centre_again(board: Board) -> None:
    """The distance of the centres in four other ways: section 12."""
    board.calc("a_w_rolling", "centre_by_rolling", "d_w1", "d_w2")
    board.calc("a_w_shift", "centre_by_shift", "d_1", "d_2", "y", "m")
    board.calc("a_w_tip1", "centre_by_clearance", "d_a1", "d_f2", "c", "m")
    board.calc("a_w_tip2", "centre_by_clearance", "d_a2", "d_f1", "c", "m")


def _auxiliary_sizes(board: Board) -> None:
    """Pitches, thicknesses, angles and curvatures: sections 13 to 21."""
    for i in WHEELS:
        board.calc(f"d_b{i}", "base_diameter", f"d_{i}", "alpha")
        board.calc(f"tau_{i}", "angular_pitch", f"z_{i}")
        board.calc(f"P_{i}", "pitch_chord", f"d_{i}", f"tau_{i}")
    board.calc("p", "pitch", "m")
    for i in WHEELS:
        board.calc(f"s_{i}", "tooth_thickness", "m", f"x_{i}", "alpha")
        board.calc(f"e_{i}", "excess", "p", f"s_{i}")
        board.calc(f"s_w{i}", "thickness_at", f"d_w{i}", f"s_{i}", f"d_{i}", "inv_alpha", "inv_alpha_w")
    board.calc("h", "tooth_depth", "h_a", "c", "delta_y", "m")
    for i in WHEELS:
        board.calc(f"alpha_a{i}", "tip_angle", f"d_b{i}", f"d_a{i}")
    for i, mate in zip(WHEELS, reversed(WHEELS), strict=True):
        board.calc(f"rho_p{i}", "lower_curvature", "a_w", "alpha_w", f"d_b{mate}", f"alpha_a{mate}")
        board.calc(f"nu_p{i}", "unrolled_angle", f"rho_p{i}", f"d_b{i}")
        board.calc(f"d_p{i}", "diameter_of_curvature", f"rho_p{i}", f"d_b{i}")
    board.calc("p_b", "base_pitch", "p", "alpha")


def _quality(board: Board) -> None:
    """What the pair is judged by: sections IV and V."""
    for i in WHEELS:
        board.calc(f"x_min{i}", "least_shift", "h_l", "h_a", f"z_{i}", "alpha")
        board.calc(f"rho_l{i}", "boundary_curvature", f"d_{i}", "alpha", "h_l", "h_a", f"x_{i}", "m")
    board.calc("epsilon_alpha", "contact_ratio", "z_1", "alpha_a1", "z_2", "alpha_a2", "alpha_w")
    for i in WHEELS:
        board.calc(f"s_a{i}", "tip_thickness", "m", f"z_{i}", f"x_{i}", "alpha", f"alpha_a{i}")
        board.calc(f"rho_a{i}", "radius_of_curvature", f"d_b{i}", f"alpha_a{i}")
    for end, first, second in (("A1", "rho_p1", "rho_a2"), ("A2", "rho_a1", "rho_p2")):
        board.calc(f"theta_12_{end}", "sliding_of_pinion", first, second, "u")
        board.calc(f"theta_21_{end}", "sliding_of_wheel", second, first, "u")


def _action(board: Board) -> None:
    """The line of action with its active part, its parts before and after the pole, and the angles of action."""
    board.calc("l_N1N2", "line_of_action", "a_w", "alpha_w")
    for i in WHEELS:
        board.calc(f"rho_w{i}", "radius_of_curvature", f"d_b{i}", "alpha_w")
    board.calc("g_alpha", "excess", "rho_a1", "rho_p1")
    board.calc("g_f", "excess", "rho_a2", "rho_w2")
    board.calc("g_a", "excess", "rho_a1", "rho_w1")
    for i in WHEELS:
        board.calc(f"phi_alpha{i}", "unrolled_angle", "g_alpha", f"d_b{i}")


def _measures(board: Board) -> None:
    """What a tooth is measured by: constant chord with its height, common normal; and the corner of the rack."""
    for i in WHEELS:
        board.calc(f"s_c{i}", "constant_chord", "m", f"x_{i}", "alpha")
        board.calc(f"h_c{i}", "height_of_chord", f"d_a{i}", f"d_{i}", f"s_c{i}", "alpha")
    for i in WHEELS:
        board.calc(f"s_b{i}", "base_thickness", f"s_{i}", f"d_{i}", "inv_alpha", f"d_b{i}")
        board.calc(f"_z_W{i}", "spanned_teeth", f"z_{i}", f"x_{i}", "alpha")
        board.calc(f"z_W{i}", "teeth_touched", f"_z_W{i}", f"rho_p{i}", f"rho_a{i}", f"s_b{i}", "p_b")
        board.calc(f"W_{i}", "common_normal", f"s_b{i}", "p_b", f"z_W{i}")
    board.calc("rho_f", "rack_corner", "h_a", "h_l", "c", "alpha", "m")


def sliding_places(board: Board) -> None:
    """Twelve points of N1N2: their distances from both ends."""
    ends = ("_rho_at_A1", "rho_w1", "_rho_at_A2")
    board.calc("_rho_at_A1", "within_line", "rho_p1", "l_N1N2")
    board.calc("_rho_at_A2", "within_line", "rho_a1", "l_N1N2")
    for k, order in enumerate(("least", "middle", "most"), 1):
        board.calc(f"_rho_mark{k}", f"{order}_of_three", *ends)
    board.calc("_rho_at_P1", "within_line", "rho_w1", "l_N1N2")
    board.calc("_rho_at_P2", "excess", "l_N1N2", "rho_w1")  # so that both ordinates at the pole are equal to the bit
    marks = ("_zero", "_rho_mark1", "_rho_mark2", "_rho_mark3", "l_N1N2")
    places = [(marks[k], marks[k + 1], f"_part_{j}_{n}") for k, n in DIVISIONS for j in range(n)]
    for point, place in zip(POINTS, places, strict=False):
        board.calc(f"_rho_1_{point}", "part_between", *place)
    board.calc(f"_rho_1_{POINTS[-1]}", "sum", "_zero", "l_N1N2")
    for point in POINTS:
        board.calc(f"_rho_2_{point}", "excess", "l_N1N2", f"_rho_1_{point}")


def _calculated_sliding(board: Board) -> None:
    """Ordinates of the velocities along the profiles at the twelve points, by proportion, and specific sliding."""
    for point in POINTS:
        for i in WHEELS:
            board.calc(ordinate(i, point), "velocity_ordinate", "PW", f"_rho_{i}_{point}", f"_rho_at_P{i}")
    for point in POINTS:
        for i in WHEELS:
            sliding_at(board, point, i)


def sliding_at(board: Board, point: str, i: int) -> None:
    """Specific sliding of a wheel at a point of the table, by the ordinates."""
    mate = 3 - i
    board.calc(f"theta_{i}{mate}_{point}", "sliding_by_ordinates", f"y_{i}_{point}", f"y_{mate}_{point}")


SIZES = (_main_sizes, _centre_again, _auxiliary_sizes, _quality, _action, _measures)


def _geometry_program() -> Program:
    """Return all calculations, in order, recorded."""
    return recorded(*SIZES, sliding_places, _calculated_sliding)


@cache
def _needed(wanted: tuple[str, ...]) -> Program:
    return _geometry_program().needed_for(wanted)


def geometry(values: Mapping[str, Any], wanted: Iterable[str] = ()) -> dict[str, Any]:
    """Return the quantities of a pair by name, in SI, angles in radians, after the givens.

    The `values` are `m z_1 z_2 x_1 x_2 alpha h_a h_l c PW`, of any shapes that go together; the quantities `wanted`, by
    default all, come with those that they need. NaN is what is undefined, such as the angle inside the base circle.
    """
    names = tuple(wanted)
    program = _needed(names) if names else _geometry_program()
    board = ExactBoard({**PARTS, **NOTHING, **values})
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board.follow(program)
    found = {name: board.values[name] for name in (*values, *program.names) if not role(name).hidden}
    return {name: value if np.ndim(value) else float(value) for name, value in found.items()}
