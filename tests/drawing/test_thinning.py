"""Curves of many points as broken lines of few."""

from __future__ import annotations

import cmath
import math

import pytest
import shapely

from kulman.drawing.areas import coarser, thinned
from kulman.drawing.shapes import Group, Line, Pen, Polyline

CIRCLE = tuple(cmath.rect(40.0, math.radians(k)) for k in range(0, 271, 1))


@pytest.mark.parametrize("within", [0.02, 0.1, 1.0])
def test_a_thinned_curve_stays_near_all_its_points(within: float) -> None:
    found = thinned(CIRCLE, within)

    line = shapely.LineString([(p.real, p.imag) for p in found])
    assert max(line.distance(shapely.Point(p.real, p.imag)) for p in CIRCLE) <= within + 1e-12
    assert len(found) < 2.0 + math.radians(270) / math.acos(1.0 - within / 40.0)
    assert (found[0], found[-1]) == (CIRCLE[0], CIRCLE[-1])
    assert set(found) <= set(CIRCLE)


def test_a_closed_curve_of_points_in_one_place_has_two() -> None:
    assert thinned((1j,) * 9, 0.1) == (1j, 1j)


def test_only_curves_of_many_points_are_changed() -> None:
    line, short = Line(0j, 1 + 0j, Pen.THIN), Polyline(CIRCLE[:5], Pen.MAIN)

    group = coarser(Group((line, short, Polyline(CIRCLE, Pen.MAIN)), "curve", "s"), 0.1)

    assert isinstance(group, Group)
    assert group.shapes[:2] == (line, short)
    assert group.shapes[2] == Polyline(thinned(CIRCLE, 0.1), Pen.MAIN)
