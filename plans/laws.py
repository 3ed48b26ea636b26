"""The laws by which a plan's segments become quantities, and quantities segments.

Each law takes and gives floats, complex vectors, or arrays of them; called with symbols (`drawing.printed`) it prints
itself, with numbers of a trace it is written down, with dual numbers it gives derivatives. A sheet, a note and a page
name a law by its key.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import reduce
from typing import Any

Law = Callable[..., Any]
TURN = 2.0 * math.pi
NAN = float("nan")
REST = 1e-12  # part of the driver's rate below which another rate is rounding
NOTHING = 1e-13  # part of what a difference is taken from, below which it is rounding


class Sign(float):
    """A number of a formula that stands in print as its `text` says, such as an angle in degrees; nothing if empty."""

    text: str

    def __new__(cls, value: float, text: str) -> Sign:
        """Make a number with a text."""
        found = super().__new__(cls, value)
        found.text = text
        return found


HALF_TURN, WHOLE_TURN = Sign(math.pi, "180°"), Sign(TURN, "360°")


def named(name: str, law: Law) -> Law:
    """Return a function of one number that stands in print under its own name."""

    def found(operand: Any) -> Any:
        return operand.function(name) if hasattr(operand, "function") else law(operand)

    return found


def as_number(value: Any) -> Any:
    """Return what has no axes as a plain number."""
    return float(value) if getattr(value, "ndim", 1) == 0 else value


# what stands in brackets in print, though none are needed
bracketed = named("", lambda value: value)


def dot(u: Any, w: Any) -> Any:
    """Return the scalar product of two plane vectors given as complex numbers."""
    product = u.real * w.real
    product += u.imag * w.imag  # in place where these are arrays
    return product


def cross(u: Any, w: Any) -> Any:
    """Return the vector product (z component) of two plane vectors given as complex numbers."""
    product = u.real * w.imag
    product -= u.imag * w.real
    return product


def inclination(direction: Any) -> Any:
    """Return the angles of directions given as an array of complex numbers, from -pi to pi."""
    import numpy as np

    return np.arctan2(direction.imag, direction.real)


def _other_leg(hypotenuse: Any, leg: Any) -> Any:
    import numpy as np

    # the leg may be said to be longer
    return as_number(np.sqrt(np.maximum((hypotenuse - leg) * (hypotenuse + leg), 0.0)))


def _sum(first: Any = 0.0, *rest: Any) -> Any:
    for value in rest:
        first = first + value
    return first


def _square(vector: Any) -> Any:
    """Return the square of a length, for division: one for a link whose joints coincide, which has no figure."""
    square = dot(vector, vector)
    return square + (square == 0.0)


def _part_of(value: Any, whole: Any) -> Any:
    """Return value / whole; NaN where the whole is zero or rounding (NaN to the power of zero is one)."""
    none = abs(whole) <= NOTHING * abs(value)
    return value / (whole + none) * NAN**none


def _moves(rate: Any, reference: Any) -> Any:
    """Return whether a rate is more than rounding beside that of the driver, 1 or 0."""
    return (abs(rate) > REST * abs(reference)) * 1.0


def _sign(rate: Any, reference: Any) -> Any:
    """Return the sign of a rate: 1, -1, or 0 where it is rounding."""
    return (rate > REST * abs(reference)) * 1.0 - (rate < -REST * abs(reference)) * 1.0


def _resisting(size: Any, v: Any, speed: Any, reference: Any) -> Any:
    moves = _moves(speed, reference)
    return v * -(size * moves / (speed + (1.0 - moves)))


def _working(rate: Any, reference: Any, acceleration: Any) -> Any:
    # at a dead position the stroke that is about to begin
    starts = (1.0 - _moves(rate, reference)) * (acceleration > 0.0)
    return (rate > REST * abs(reference)) * 1.0 + starts


def _above(value: Any) -> Any:
    """Return a value where it is above zero, else zero; exactly, and alike for one and for many."""
    return (value + abs(value)) * 0.5


def _larger(first: Any, second: Any) -> Any:
    return first + _above(second - first)


def _within(value: Any, most: Any) -> Any:
    """Return a value kept between zero and `most`."""
    return most - _above(most - _above(value))


def _piecewise(x: Any, *nodes: Any) -> Any:
    """Return the value at `x` of straight lines between nodes: first all places, then all values."""
    places, values = nodes[: len(nodes) // 2], nodes[len(nodes) // 2 :]
    found = values[0]
    for a, b, low, high in zip(places, places[1:], values, values[1:], strict=False):
        width = b - a
        jump = (width == 0.0) * 1.0
        part = _within(x - a, width) / (width + jump) + jump * (x > a)
        found = found + (high - low) * part
    return found


FORMS: dict[str, Law] = {}  # textbook forms of laws that are computed in another one
LAWS: dict[str, Law] = {
    # omega = sense * speed, counter-clockwise positive
    "signed": lambda speed, sense: speed * sense,
    # v and a of a slider that drives, along its guide
    "given": lambda rate: rate,
    # v = omega * l, along the normal to the crank
    "circular_speed": lambda omega, length: omega * length,
    # a^n = omega^2 * l, towards the pivot
    "centripetal": lambda omega, length: omega * omega * length,
    # a^n_BA = v_BA^2 / l_AB, from B to A
    "normal_part": lambda v, length: dot(v, v) / length,
    # omega = v_BA / l_AB, epsilon = a^t_BA / l_AB, with the sense in which the vector turns B about A
    "turning": lambda v, normal, length: dot(v, normal) / length,
    # a link slides on another: it turns like it
    "same_turning": lambda rate: rate,
    # v = omega x r, a^n = -omega^2 * r, a^t = epsilon x r
    "transport_speed": lambda omega, r: omega * (r * 1j),
    "transport_normal": lambda omega, r: -(omega * omega) * r,
    "transport_tangential": lambda epsilon, r: epsilon * (r * 1j),
    # a^k = 2 * omega x v_r, omega of the guide
    "coriolis": lambda omega, v: 2.0 * omega * (v * 1j),
    # a^t = epsilon * l, along the normal to the crank
    "circular_acceleration": lambda epsilon, length: epsilon * length,
    # where a point of a link lies from its point b, along and to the left of its axis
    "along_axis": lambda axis, b, e: dot(axis, e - b),
    "across_axis": lambda axis, b, e: cross(axis, e - b),
    # the same from a to b, in parts of ab
    "part_along": lambda a, b, e: dot(b - a, e - a) / _square(b - a),
    "part_across": lambda a, b, e: cross(b - a, e - a) / _square(b - a),
    "inertia_force": lambda mass, a: -mass * a,
    "inertia_moment": lambda inertia, epsilon: -inertia * epsilon,
    "mass_by_length": lambda factor, length: factor * length,
    "inertia_by_length": lambda factor, mass, length: factor * mass * length * length,
    # downwards
    "weight": lambda mass, g, up: -(mass * g) * up,
    # part of a vector along a direction, place of a point along it
    "component": dot,
    # F against v, M against omega; none where nothing moves. Of a point whose line is known v tells only the sense
    "resisting_force": _resisting,
    "resisting_along": lambda size, v, line, reference: line * -(size * _sign(dot(v, line), reference)),
    "resisting_moment": lambda size, omega, reference: -size * _sign(omega, reference),
    # a length that none in the mechanism exceeds, and an angular velocity that goes with it
    "reach": lambda *lengths: _sum(*map(abs, lengths)),
    # the largest of several lengths
    "largest": lambda *lengths: reduce(_larger, map(abs, lengths)),
    "rate_over": lambda v, length: v / length,
    # 1 in the working stroke, 0 in the idle one
    "working": _working,
    "in_working": lambda size, working: size * working,
    "in_idle": lambda size, working: size * (1.0 - working),
    "by_stroke": lambda working, forth, back: forth * working + back * (1.0 - working),
    # part of the stroke that is done, from 0 to 1; 0 of a stroke that is nothing
    "stroke_part": lambda place, begin, end: _within((place - begin) / (end - begin + (end == begin) * 1.0), 1.0),
    "middle": lambda begin, end: (begin + end) * 0.5,
    # an angle within the turn that begins at `first`
    "within_turn": lambda angle, first: angle - TURN * ((angle - first) // TURN),
    "turn_later": lambda angle: angle + TURN,
    # a load diagram
    "piecewise": _piecewise,
    # a moment as a pair of forces on the arm l
    "couple": lambda moment, length: moment / length,
    "along": lambda size, direction: size * direction,
    "opposite": lambda vector: vector * -1.0,
    # of a right triangle: s_0^2 = r_0^2 - e^2 of a cam, half the chord of a circle
    "other_leg": _other_leg,
    # sum of moments = 0, solved for a force on the arm l
    "moment_equation": lambda length, *moments: _sum(*moments) / length,
    # the same for a force at its end, along the normal to it
    "closing_force": lambda length, *moments: -_sum(*moments) / length,
    # sum of moments = 0, solved for a moment
    "closing_moment": lambda *moments: -_sum(*moments),
    "sum": _sum,
    # where an instant centre divides the line of two pivots: it is nowhere while the link does not turn
    "part_of": _part_of,
    "hypotenuse": lambda leg, other: (leg * leg + other * other) ** 0.5,
    "excess": lambda whole, part: whole - part,
    # the moment of a couple on the lever, turned by +90 degrees, is minus its power, like those of forces
    "couple_on_lever": lambda moment, omega: -moment * omega,
    "crank_moment": lambda force, length: force * length,
    # difference of two values in per cent of the first
    "difference": lambda value, other: (value - other) / (value + (value == 0.0)) * 100.0,  # two zeros do not differ
}


def define(**laws: Law | tuple[Law, Law]) -> None:
    """Add the laws of a subject of its own to the table.

    A law prints itself when it is called with symbols. One that is computed in another form than textbooks have it, or
    by a procedure, is followed by that form, which is only printed.

    Raises ValueError: a law of this name is there already.
    """
    twice = LAWS.keys() & laws.keys()
    if twice:
        raise ValueError(f"laws defined twice: {', '.join(sorted(twice))}")
    for name, law in laws.items():
        LAWS[name], *form = law if isinstance(law, tuple) else (law,)
        FORMS.update({name: form[0]} if form else {})


def form_of(name: str) -> Law:
    """Return what prints a law: its textbook form, or the law itself."""
    return FORMS.get(name) or LAWS[name]
