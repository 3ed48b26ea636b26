"""Areas are hatched inside, lines clipped and broken, curves thinned; judged by what many places tell."""

import cmath
import itertools
import math

import numpy as np
import pytest
import shapely

from kulman.drawing.areas import beside, clipped, coarser, hatched, strokes, thinned
from kulman.drawing.formats import STYLES
from kulman.drawing.page import extent
from kulman.drawing.shapes import Arc, Group, Line, Pen, Polyline, Text, sides_of
from kulman.drawing.view import Canvas, left_of
from kulman.tests.support.shapes import places, within

STAR = [cmath.rect(40.0, 2.0 * cmath.pi * 2 * k / 5) + 3 - 7j for k in range(5)]  # crosses itself: a hole in the middle
ALONG = cmath.rect(1.0, 0.7)
BOXES = [(-4.0, -3.0, 5.0, 2.0), (3.0, 0.0, 9.0, 6.0), (-20.0, 4.0, -10.0, 30.0)]
CIRCLE = tuple(cmath.rect(40.0, math.radians(k)) for k in range(0, 271, 1))


def surrounded(at: np.ndarray, outline: list[complex]) -> np.ndarray:
    """Whether an odd number of sides of a closed line is to the right of each place."""
    sides = np.zeros(at.shape, dtype=int)
    for p, q in zip(outline, outline[1:] + outline[:1], strict=True):
        level = (p.imag > at.imag) != (q.imag > at.imag)
        x = p.real + (q.real - p.real) * (at.imag - p.imag) / (q.imag - p.imag)
        sides += level & (x > at.real)
    return sides % 2 == 1


def test_strokes_cover_what_an_odd_number_of_sides_surrounds() -> None:
    found = strokes(STAR, ALONG, 0.5)
    assert all(surrounded(places(line.a, line.b, 50), STAR).all() for line in found)
    assert all((line.b - line.a) / abs(line.b - line.a) == pytest.approx(ALONG) for line in found)
    corner = np.arange(-45.0, 45.0, 0.1)
    area = surrounded(np.add.outer(corner, 1j * corner) + 3 - 7j, STAR).sum() * 0.01
    assert sum(abs(line.b - line.a) for line in found) * 0.5 == pytest.approx(area, rel=0.01)
    levels = {round((line.a * ALONG.conjugate()).imag / 0.5, 6) for line in found}
    assert all(level == round(level) for level in levels)


@pytest.mark.parametrize("turn", [0.3, 2.0, 4.5])
def test_a_box_is_hatched_inside_of_all_sides_only(turn: float) -> None:
    box, sides = (-20.0, -12.0, 25.0, 9.0), [(cmath.rect(1.0, turn), -6.0), (cmath.rect(1.0, turn + 2.0), -8.0)]

    lines = [line for line in hatched(sides, box, 2.5, "centre").shapes if isinstance(line, Line)]

    def free(at: np.ndarray) -> np.ndarray:
        return np.logical_and.reduce([within(at, box), *((at * n.conjugate()).real > least for n, least in sides)])

    assert len(lines) > 4
    for line in lines:
        u = (line.b - line.a) / abs(line.b - line.a)
        assert u == pytest.approx((1 + 1j) / 2**0.5)
        assert free(places(line.a, line.b)).all()
        assert not free(np.array([line.a - 0.01 * u, line.b + 0.01 * u])).any()
    levels = sorted((line.a * (1 - 1j)).imag / 2**0.5 for line in lines)
    assert np.diff(levels) == pytest.approx(2.5)
    assert hatched([(1 + 0j, 5.0), (-1 + 0j, 5.0)], (-9.0, -9.0, 9.0, 9.0), 2.5, "centre").shapes == ()


def test_lines_are_clipped_and_broken_where_boxes_say() -> None:
    random = np.random.default_rng(3)
    for a, b in (random.uniform(-25, 25, (60, 2)) + 1j * random.uniform(-25, 25, (60, 2))).tolist():
        at = places(a, b)
        inside = within(at, BOXES[0])
        part, pieces = clipped(a, b, BOXES[0]), beside(a, b, BOXES)

        assert (part is None) == (not inside.any())
        if part is not None:
            assert part == pytest.approx((at[inside][0], at[inside][-1]), abs=0.05)
        hidden = np.logical_or.reduce([within(at, box) for box in BOXES])
        shown = np.zeros(len(at), dtype=bool)
        share = ((at - a) / (b - a)).real
        for piece in pieces:
            low, high = (((end - a) / (b - a)).real for end in piece)
            assert low < high
            shown |= (share > low) & (share < high)
        assert np.count_nonzero(shown == hidden) <= 2 * len(BOXES)
    assert (clipped(1j, 1j, BOXES[0]), clipped(9 + 0j, 9 + 0j, BOXES[0])) == ((1j, 1j), None)  # a place as a line
    assert beside(-9 + 2j, 9 + 2j, BOXES[:1]) == [(-9 + 2j, 9 + 2j)]  # along the side of a box


@pytest.mark.parametrize("past", [0.4, 3.0])
def test_no_dot_of_a_construction_line_is_left_beside_a_letter(past: float) -> None:
    line = Line(0j, 14.0 + past + 0j, Pen.THIN, role="construction")
    letter = (8.0, -2.0, 14.0, 2.0)

    pieces = left_of(line, (letter,))

    ends = [end for piece in pieces for end in (piece.a, piece.b)]
    assert ends == pytest.approx([0j, 8.0 + 0j, 14.0 + 0j, 17.0 + 0j][: 4 if past > 1.0 else 2], abs=1e-6)


def test_an_arc_is_broken_at_a_letter_that_it_touches_beside_its_chords() -> None:
    round_it, canvas = Arc(0j, 35.0, 0.0, 2.0 * cmath.pi, Pen.THIN), Canvas(STYLES["A1"])
    a, b = next(iter(sides_of(round_it)))
    middle = (a + b) / abs(a + b)
    x0, y0, _, _ = extent((Text(0j, "n", 5.0, role="label"),))
    letter = Text(middle * 35.1 - complex(x0, y0), "n", 5.0, role="label")
    canvas.add(round_it, letter)
    canvas.label("far", 200 + 0j)

    left = [shape for shape in canvas.finish("figure").shapes if isinstance(shape, Arc)]

    assert abs(middle * 35.1 - (a + b) / 2) > 0.19  # the pen is 0.15 mm wide on both sides of the arc
    assert left != [round_it]


@pytest.mark.parametrize("within", [0.02, 0.1, 1.0])
def test_a_thinned_curve_stays_near_all_its_points(within: float) -> None:
    found = thinned(CIRCLE, within)
    line = shapely.LineString([(p.real, p.imag) for p in found])
    assert max(line.distance(shapely.Point(p.real, p.imag)) for p in CIRCLE) <= within + 1e-12
    assert len(found) < 2.0 + math.radians(270) / math.acos(1.0 - within / 40.0)
    assert (found[0], found[-1]) == (CIRCLE[0], CIRCLE[-1])
    assert set(found) <= set(CIRCLE)
    assert thinned((1j,) * 9, within) == (1j, 1j)  # a closed curve of points in one place


def test_only_curves_of_many_points_are_changed() -> None:
    line, short = Line(0j, 1 + 0j, Pen.THIN), Polyline(CIRCLE[:5], Pen.MAIN)
    group = coarser(Group((line, short, Polyline(CIRCLE, Pen.MAIN)), "curve", "s"), 0.1)
    assert isinstance(group, Group)
    assert group.shapes == (line, short, Polyline(thinned(CIRCLE, 0.1), Pen.MAIN))


@pytest.mark.parametrize("seed", range(8))
def test_chords_that_stand_for_an_arc_are_a_tenth_of_a_millimetre_beside_it_at_most(seed: int) -> None:
    rng = np.random.default_rng(seed)
    centre, radius = complex(*rng.uniform(-300.0, 300.0, 2)), 10.0 ** rng.uniform(0.0, 4.0)
    start, sweep = rng.uniform(-7.0, 7.0), rng.choice([-1.0, 1.0]) * rng.uniform(0.1, 2.0 * math.pi)

    chords = list(sides_of(Arc(centre, radius, start, sweep)))

    ends = chords[0][0], chords[-1][1]
    assert ends == pytest.approx(tuple(centre + cmath.rect(radius, turn) for turn in (start, start + sweep)))
    assert all(end == begin for (_, end), (begin, _) in itertools.pairwise(chords))
    assert max(radius - abs((a + b) / 2.0 - centre) for a, b in chords) <= 0.1 + 1e-9 * radius
