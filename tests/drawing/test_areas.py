"""Hatching, clipping and what leaders cross, beside what many places of a line and determinants tell."""

from __future__ import annotations

import cmath

import numpy as np
import pytest

from kulman.drawing.areas import beside, clipped, hatched, strokes
from kulman.drawing.shapes import Line
from kulman.drawing.spots import FINE, MAIN, Obstacles, Surroundings

STAR = [cmath.rect(40.0, 2.0 * cmath.pi * 2 * k / 5) + 3 - 7j for k in range(5)]  # crosses itself: a hole in the middle
ALONG = cmath.rect(1.0, 0.7)
BOXES = [(-4.0, -3.0, 5.0, 2.0), (3.0, 0.0, 9.0, 6.0), (-20.0, 4.0, -10.0, 30.0)]


def places(a: complex, b: complex, count: int = 2000) -> np.ndarray:
    """Places along a line, none of them at its ends."""
    return a + (b - a) * (np.arange(count) + 0.5) / count


def surrounded(at: np.ndarray, outline: list[complex]) -> np.ndarray:
    """Whether an odd number of sides of a closed line is to the right of each place."""
    sides = np.zeros(at.shape, dtype=int)
    for p, q in zip(outline, outline[1:] + outline[:1], strict=True):
        level = (p.imag > at.imag) != (q.imag > at.imag)
        x = p.real + (q.real - p.real) * (at.imag - p.imag) / (q.imag - p.imag)
        sides += level & (x > at.real)
    return sides % 2 == 1


def within(at: np.ndarray, box: tuple[float, float, float, float]) -> np.ndarray:
    x0, y0, x1, y1 = box
    return (at.real > x0) & (at.real < x1) & (at.imag > y0) & (at.imag < y1)


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


def test_an_area_without_a_place_is_not_hatched() -> None:
    assert hatched([(1 + 0j, 5.0), (-1 + 0j, 5.0)], (-9.0, -9.0, 9.0, 9.0), 2.5, "centre").shapes == ()


def test_lines_are_clipped_and_broken_where_boxes_say() -> None:
    random = np.random.default_rng(3)
    for a, b in (random.uniform(-25, 25, (60, 2)) + 1j * random.uniform(-25, 25, (60, 2))).tolist():
        at = places(a, b)
        inside = within(at, BOXES[0])
        part, pieces = clipped(a, b, BOXES[0]), beside(a, b, BOXES)

        assert (part is None) == (not inside.any())
        if part is not None:
            assert part[0] == pytest.approx(at[inside][0], abs=0.05)
            assert part[1] == pytest.approx(at[inside][-1], abs=0.05)
        hidden = np.logical_or.reduce([within(at, box) for box in BOXES])
        shown = np.zeros(len(at), dtype=bool)
        share = ((at - a) / (b - a)).real
        for first, last in pieces:
            low, high = (((end - a) / (b - a)).real for end in (first, last))
            assert low < high
            shown |= (share > low) & (share < high)
        assert np.count_nonzero(shown == hidden) <= 2 * len(BOXES)


def test_a_place_is_clipped_as_a_line_is() -> None:
    assert clipped(1j, 1j, BOXES[0]) == (1j, 1j)
    assert clipped(9 + 0j, 9 + 0j, BOXES[0]) is None


def test_a_line_along_the_side_of_a_box_is_not_broken() -> None:
    assert beside(-9 + 2j, 9 + 2j, BOXES[:1]) == [(-9 + 2j, 9 + 2j)]


def test_leaders_count_what_they_cross() -> None:
    random = np.random.default_rng(5)
    main, thin = (random.uniform(-40, 40, (30, 2)) + 1j * random.uniform(-40, 40, (30, 2)) for _ in range(2))
    starts, heads = (random.uniform(-30, 30, 50) + 1j * random.uniform(-30, 30, 50) for _ in range(2))
    centres, boxes = [3 + 4j, -20 + 5j], [(10.0, 10.0, 16.0, 14.0)]
    around = Surroundings(Obstacles(main, thin, [(c, 4.0) for c in centres], boxes), 0.6)

    found = around.crossed(heads, starts)

    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        return np.sign(((q - p).conj() * (r - p)).imag)

    a, b = main.T
    p, q = starts[:, np.newaxis], heads[:, np.newaxis]
    crossed = (side(a, b, p) != side(a, b, q)) & (side(p, q, a) != side(p, q, b))
    number = crossed.sum(axis=1)
    for k, (start, head) in enumerate(zip(starts.tolist(), heads.tolist(), strict=True)):
        at = places(start, head, 20000)
        number[k] += sum(bool((np.abs(at - centre) < 4.0).any()) for centre in centres)
        number[k] += bool(within(at, boxes[0]).any()) and not within(np.array([start]), boxes[0])[0]
    assert np.array_equal(found, number)
    assert {MAIN, FINE} <= {*around.kind.tolist()}


def test_a_leader_along_a_thin_stroke_counts() -> None:
    around = Surroundings(Obstacles(thin=[(0j, 20 + 0j)]), 0.6)

    assert around.crossed(np.array([12 + 0.1j, 12 + 3j]), np.array([5 + 0j, 5 + 0.1j])).tolist() == [5, 0]
