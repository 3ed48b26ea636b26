"""The laws of calculation of gear pairs: the formulas of GOST 16532-70 for external spur gears cut by a rack.

Each takes and gives numbers or arrays, in SI, angles in radians. Own and other mean the wheel itself and its mate.

The involute function inv(alpha) = tan(alpha) - alpha and its inverse are known to the last digits at every angle: both
work on t = tan(alpha), in which t - arctan(t) is a series where the difference of the two would lose digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..laws import HALF_TURN, NAN, WHOLE_TURN, Law, Sign, as_number, bracketed, define, named

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


def involute(alpha: Any) -> Any:
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


def angle_of_involute(inv: Any) -> Any:
    """Return the angles, rad, with the given involute functions; NaN where these are negative."""
    return np.arctan(tangent_of_involute(inv))


inv = named("inv", involute)
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
    touched = np.tan(_angle_of(base, middle)) - 2.0 * x * np.tan(alpha) / z - involute(alpha)
    return np.maximum(np.floor(z / math.pi * touched + 1.0), 1.0)


def _touching(number: Any, rho_p: Any, rho_a: Any, s_b: Any, p_b: Any) -> Any:
    """Return the number of teeth next to `number` whose normal touches active flanks; NaN where there is none."""
    least, most = np.ceil((2.0 * rho_p - s_b) / p_b), np.floor((2.0 * rho_a - s_b) / p_b)
    return np.where(least <= most, np.maximum(np.minimum(number, most + 1.0), least + 1.0), NAN)


def _middle(first: Any, second: Any, third: Any) -> Any:
    return np.maximum(np.minimum(first, second), np.minimum(np.maximum(first, second), third))


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
    involute=(involute, lambda alpha: np.tan(alpha) - alpha * math.pi / HALF_TURN),
    working_involute=lambda inv, x_sum, alpha, z_1, z_2: inv + 2.0 * x_sum * np.tan(alpha) / (z_1 + z_2),
    angle_of_involute=angle_of_involute,
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
    middle_of_three=_middle,
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
