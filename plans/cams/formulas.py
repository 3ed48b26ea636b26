"""The laws of calculation of cams: how drawn lengths, scale factors and sizes follow from one another.

Lengths on paper are metres of paper; scale factors are values in SI per millimetre.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..laws import Sign, as_number, bracketed, define, dot

MM_PER_M = Sign(1e3, "")  # millimetres in a metre of paper, in which lengths on it are printed
ARC = "arc_length"  # the law of the stroke of a rocker
SHARPEST = "sharpest"  # the law of the least radius of curvature


def _angle_of_triangle(a: Any, b: Any, opposite: Any) -> Any:
    cosine = (a * a + b * b - opposite * opposite) / (2.0 * a * b)
    return as_number(np.arccos(np.clip(cosine, -1.0, 1.0)))  # sides in one line may be off by rounding


def _touching(slope: Any, side: Any, *coordinates: Any) -> Any:
    """Return where a line that touches a smooth curve from the side +1 or -1 of the abscissas meets their axis.

    Along the line the abscissa grows by `slope` times the ordinate. `coordinates` are the abscissas of the points, then
    their ordinates; the curve through the outermost point and its neighbours is a parabola.
    """
    half = len(coordinates) // 2
    pairs = zip(coordinates[:half], coordinates[half:], strict=True)
    out = np.stack(np.broadcast_arrays(*(side * (x - slope * y) for x, y in pairs)))
    most = np.max(out, axis=0)
    if half > 2:
        middle = np.clip(np.argmax(out, axis=0), 1, half - 2)[np.newaxis]
        before, here, after = (np.take_along_axis(out, middle + k, axis=0)[0] for k in (-1, 0, 1))
        bend, rise = 2.0 * here - before - after, 0.5 * (after - before)
        inside = np.abs(rise) < bend  # else the outermost point is an end of the curve
        most = np.where(inside, here + 0.5 * rise * rise / np.where(inside, bend, 1.0), most)
    return as_number(most) * side


def _sharpest(stroke: Any, e: Any, s_0: Any, *parts: Any) -> Any:
    """Return the least radius of curvature of a roller's pitch curve on its section lines, where it is convex.

    `parts` are all s, then all s' with the sense of turning, then all s'', in parts of the stroke. The roller's centre
    is e + i (s_0 + s) on paper that turns with the cam.
    """
    deep = max(np.ndim(size) for size in (stroke, e, s_0))
    s, ds, d2s = stroke * np.array(parts).reshape(3, -1, *(1,) * deep)
    up, aside = s_0 + s, ds - e
    bend = up * (up - d2s) + aside * (aside + ds)
    convex = bend > 0.0
    radii = np.where(convex, np.sqrt(up * up + aside * aside) ** 3 / np.where(convex, bend, 1.0), np.inf)
    return as_number(np.min(radii, axis=0))


def _outermost(side: Any, *places: Any) -> Any:
    most = np.max(np.stack(np.broadcast_arrays(*(side * place for place in places))), axis=0)
    return as_number(most) * side


define(
    # the travel of a rocker's roller
    arc_length=(
        lambda angle, radius: angle * radius,
        lambda angle, radius: bracketed(angle / Sign(math.pi, "180")) * math.pi * radius,
    ),
    # both lobes have the same area
    second_amplitude=lambda amplitude, u: amplitude * u / (1.0 - u),
    on_axis=lambda angle, mu: angle / (mu * MM_PER_M),
    # an ordinate of the given diagram is a part of its amplitude
    part_of_amplitude=lambda amplitude, part: amplitude * part,
    # greatest ordinates of the curves drawn after a law: parts of A * x / H_a and of A * x^2 / (H_a * H_v)
    first_integral=lambda part, amplitude, length, pole: part * amplitude * length / pole,
    second_integral=lambda part, amplitude, length, pole, other: part * amplitude * length * length / (pole * other),
    scale_factor=lambda value, length: value / (length * MM_PER_M),
    # mu_ds and mu_d2s
    derived_scale=lambda mu, mu_axis, pole: mu / (mu_axis * pole * MM_PER_M),
    # mu_v and mu_a
    speed_scale=lambda omega, mu: omega * mu,
    acceleration_scale=lambda omega, mu: omega * omega * mu,
    to_scale=lambda mu, length: mu * length * MM_PER_M,
    ordinate_to_scale=lambda mu, up, segment: dot(up, segment) * mu * MM_PER_M,
    # tg nu = mu_s / mu_ds
    transfer_angle=lambda opposite, adjacent: as_number(np.arctan2(opposite, adjacent)),
    # a size of a mechanism is proportional to the travel
    part_of_travel=lambda travel, part: travel * part,
    # where a tangent of a given direction meets the axis: of every smooth piece, and of the whole curve
    touching=_touching,
    outermost=_outermost,
    # the abscissa of the S-ds/dphi diagram points to where the instant centre lies
    turned_with=lambda analogue, sense: analogue * sense,
    negative=lambda value: -value,
    # the angle between the sides a and b
    angle_of_triangle=(
        _angle_of_triangle,
        lambda a, b, opposite: np.arccos((a * a + b * b - opposite * opposite) / (2.0 * a * b)),
    ),
    # rho_min = |v|^3 / (v x v'), v and v' being the derivatives of the roller's centre by the angle of the cam
    **{SHARPEST: _sharpest},
    # R = |ds/dphi|max + 5..8 mm, r_0 = r_0min + rho_min
    enlarged=lambda size, margin: size + margin,
)
