"""The crossing of parabola and sinusoid ten times as large: the curves, and the chords by which it is drawn."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...plans.hoist.root_plans import LIFT_OFF
from ...plans.laws import LAWS
from ..shapes import Group, Line, Pen, Polyline, Shape, Text
from ..view import Canvas
from .scene import HoistScene

TIMES, HALF = 10.0, 16.0  # how many times as large, and half the side of the square, mm
PLACES = 81


def magnified(canvas: Canvas, scene: HoistScene, corner: complex) -> None:
    """Draw the crossing magnified in a square whose lower left corner is given."""
    roots, found = scene.solved.layout.roots, scene.solved.forces.found
    assert roots is not None
    centre, middle = scene.mm(f"{LIFT_OFF}.X"), corner + complex(HALF, HALF)
    x = np.linspace(centre.real - HALF / TIMES, centre.real + HALF / TIMES, PLACES)
    t = roots.begin + x * scene.scale("mu_t1").mu
    V, a, k = found["V_t"], found["a"], found["k"]
    mu = scene.scale("mu_y").mu
    parabola = (np.asarray(LAWS["wound"](V, a, t)) - found["P_st"] / found["C"]) / mu
    wave = (np.asarray(LAWS["oscillation"](V, a, k, t)) + 0.0 * t) / mu
    shapes: list[Shape] = []
    for y in (parabola, wave):
        places = [complex(p, q) for p, q in zip(x.tolist(), y.tolist(), strict=True)]
        shapes += (Polyline((p, q), Pen.MAIN) for p, q in clipped(places, centre, middle))
    for letter in "YO":
        ends = [scene.mm(f"{LIFT_OFF}.{letter}{roots.lift_off + n}") for n in (0, 1)]
        many = [ends[0] + (ends[1] - ends[0]) * n / PLACES for n in range(-PLACES, 2 * PLACES)]
        shapes += (Line(p, q, Pen.THIN) for p, q in clipped(many, centre, middle))
    square = tuple(middle + HALF * complex(x, y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    frame = Group((Polyline(square, Pen.THIN, closed=True),), "frame", "magnified")
    canvas.add(Group(tuple(shapes), "magnified", "X"), frame, scene.node(middle, "magnified"))
    h = scene.style.text
    canvas.add(Text(middle + 1j * (HALF + 0.6 * h), f"{scene.words.short(TIMES)}:1", h, "middle", role="magnified"))


def clipped(places: list[complex], centre: complex, middle: complex) -> list[tuple[complex, complex]]:
    """Return the pieces of a broken line, magnified about `centre`, that lie in the square about `middle`."""
    large = [middle + TIMES * (place - centre) for place in places]
    inside = [max(abs((p - middle).real), abs((p - middle).imag)) <= HALF + 1e-9 for p in large]
    kept = zip(pairwise(large), pairwise(inside), strict=True)
    return [piece for piece, both in kept if all(both)]
