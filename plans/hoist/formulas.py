"""The laws of calculation of the hoist; the numbers in brackets are those of the article's formulas.

Each takes and gives numbers or arrays, in SI. A rigid beam has an infinite stiffness: what then is zero is found to be
zero, without a large number in its place. A prime marks an exact formula in the place of a simplified one.

Source: Karpenko, Muzyka, Gudym, Evaluation of the forces in the lifting rope taking into account the resilience of its
links; deflections: any course of strength of materials.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..laws import TURN, Sign, define
from . import roots

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
    oscillation=_oscillation,
    oscillation_rate=_oscillation_rate,
    # y - osc, and its rate
    lagging=_lagging,
    load_rate=_load_rate,
    # (9) F_01 = C (y - osc) - m g
    support_force=lambda C, lagging, weight: C * lagging - weight,
    # (10) F_12 = C y + C (C_12 / C_01) osc, with C C_12 / C_01 = mu C_12; the rate likewise
    rope_force=lambda C, wound, C_osc, oscillation: C * wound + C_osc * oscillation,
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
