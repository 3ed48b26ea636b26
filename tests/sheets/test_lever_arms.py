"""Arms on the lever that lie close together are staggered; numbers that lines would cross go under the heading."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from kulman.drawing.formats import STYLES
from kulman.drawing.linkages.figures.lever import staggered
from kulman.drawing.linkages.figures.sketch import Arm
from kulman.drawing.shapes import Line, Pen, Text
from kulman.drawing.view import Canvas
from kulman.tests.support.sheet_geometry import crosses


def arm_to(foot: complex, along: complex = 1j) -> Arm:
    return Arm(["F"], ["h_F"], foot, along, foot)


def test_arms_side_by_side_are_staggered_away_from_the_figure() -> None:
    arms = [arm_to(40 + 0j), arm_to(20 + 0j), arm_to(60 + 0j), arm_to(-30 + 0j), arm_to(25j, 1 + 0j)]

    shifts = staggered(0j, arms, 10 + 50j, 8.0)

    assert shifts == {0: -8j, 2: -16j}


def test_random_arms_that_make_small_angles_do_not_meet() -> None:
    random = np.random.default_rng(5)
    for _ in range(200):
        turns = random.uniform(-0.1, 0.1, 5)
        ways = np.exp(1j * turns)
        arms = [arm_to(complex(w * r), complex(1j * w)) for w, r in zip(ways, random.uniform(10, 60, 5), strict=True)]

        shifts = staggered(0j, arms, 40j, 9.0)

        assert sorted(round(abs(shift), 9) for shift in shifts.values()) == [9.0, 18.0, 27.0, 36.0]
        assert all(shift.imag < 0.0 for shift in shifts.values())
        drawn = [(shifts.get(i, 0j), each.foot + shifts.get(i, 0j)) for i, each in enumerate(arms)]
        assert not any(crosses(one, other) for one, other in combinations(drawn, 2))


def test_number_of_an_arm_that_lines_cross_stands_under_the_heading() -> None:
    canvas = Canvas(STYLES["A1"])
    canvas.add(*(Line(complex(x, -60), complex(x, 60), Pen.THIN) for x in range(-60, 61, 4)))
    canvas.label("h = 1", (-1 + 0j, 1 + 0j), spare="h = 1")
    canvas.label("O", 70 + 0j)

    view = canvas.finish("crowded", ("heading",))

    roles = {shape.markup: shape.role for shape in view.shapes if isinstance(shape, Text)}
    assert roles == {"heading": "heading", "h = 1": "heading", "O": "label"}
