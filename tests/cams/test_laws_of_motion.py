"""Laws of motion: closed forms against quadrature and the books, their jumps, laws of one's own."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from kulman.plans.cams.cam import LAWS, Curve
from kulman.plans.cams.laws_of_motion import (
    UNIFORM,
    Law,
    law_of_curve,
    law_of_motion,
    law_of_pieces,
    law_of_points,
)
from kulman.scales.errors import InputError
from kulman.tests.support.cams import SMOOTH

PARTS = (0.5, 1.0 / 3.0, 0.72)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
ALL_PARTS = [
    pytest.param(PARTS, id="3"),
    pytest.param(tuple(np.linspace(0.02, 0.98, 97)), id="97", marks=pytest.mark.soak),
]


def along(law: Law, x: object, order: int = 0) -> np.ndarray:
    """Return s (order 0), s' (1) or s'' (2) at the places `x`; at a jump what follows it, at 1 what precedes."""
    places = np.asarray(x, float)
    curves = list(law)
    for _ in range(order):
        curves = [curve.derivative() for curve in curves]
    which = np.clip(np.searchsorted([curve.low for curve in curves], places, side="right") - 1, 0, len(curves) - 1)
    return np.vectorize(lambda place, k: curves[k].value(place), otypes=[float])(places, which)


def quadrature(law: Law, order: int, low: float, high: np.ndarray) -> np.ndarray:
    """Return the integral of a derivative from `low` to each of `high`, piece by piece."""
    corners = [*(piece.low for piece in law), 1.0]
    total = np.zeros_like(high)
    for a, b in pairwise(corners):
        begin, end = np.clip(low, a, b), np.clip(high, a, b)
        half = 0.5 * (end - begin)
        places = begin + half * (1.0 + NODES[:, np.newaxis])
        inside = np.clip(places, a, np.nextafter(b, 0.0))
        total += half * (WEIGHTS @ along(law, inside, order))
    return total


def limits(law: Law, x: float, order: int) -> tuple[float, float]:
    """Return the limits of a derivative from the left and from the right; outside the phase the follower rests."""
    left = [piece for piece in law if piece.low < x]
    right = [piece for piece in law if piece.high > x]

    def value(piece: object, place: float) -> float:
        for _ in range(order):
            piece = piece.derivative()  # type: ignore[attr-defined]
        return float(piece.value(place))  # type: ignore[attr-defined]

    rest = 0.0
    return (value(left[-1], x) if left else rest, value(right[0], x) if right else rest)


@pytest.mark.parametrize("parts", ALL_PARTS)
@pytest.mark.parametrize("name", SMOOTH)
def test_closed_forms_are_the_integrals_of_the_acceleration(name: str, parts: tuple[float, ...]) -> None:
    x = np.linspace(0.0, 1.0, 41)

    for u in parts:
        law = law_of_motion(name, u)
        velocity, travel = quadrature(law, 2, 0.0, x), quadrature(law, 1, 0.0, x)
        assert np.max(np.abs(along(law, x, 1) - velocity)) <= 1e-13 * np.max(np.abs(along(law, x, 1)))
        assert np.max(np.abs(along(law, x) - travel)) <= 1e-13


@pytest.mark.parametrize("u", PARTS)
@pytest.mark.parametrize("name", LAWS)
def test_phase_is_travelled_exactly_from_rest_to_rest(name: str, u: float) -> None:
    law = law_of_motion(name, u)

    assert along(law, 0.0) == 0.0
    assert along(law, 1.0) == 1.0
    if name != UNIFORM:
        assert np.max(np.abs(along(law, [0.0, 1.0], 1))) <= 1e-15


@pytest.mark.parametrize("u", PARTS)
@pytest.mark.parametrize("name", SMOOTH)
def test_lobes_have_equal_areas_and_amplitudes_as_their_lengths(name: str, u: float) -> None:
    law = law_of_motion(name, u)
    x = np.append(np.linspace(0.0, 1.0, 4001), u)

    up, down = np.max(along(law, x[x < u], 2)), -np.min(along(law, x, 2))

    if name != "sawtooth":  # its first amplitude is a limit from the left
        assert down / up == pytest.approx(u / (1.0 - u), rel=2e-3)
    else:
        before, after = limits(law, u, 2)
        assert -after / before == pytest.approx(u / (1.0 - u), rel=1e-12)
    assert float(along(law, u)) == pytest.approx(u, rel=1e-14)
    assert quadrature(law, 2, 0.0, np.array([u]))[0] == pytest.approx(-quadrature(law, 2, u, np.array([1.0]))[0])


# acceleration at the start, on both sides of the join, at the end, as parts of A_1 and A_2
JUMPS = {
    "constant": (1.0, 1.0, -1.0, -1.0),
    "falling": (1.0, 0.0, 0.0, -1.0),
    "sawtooth": (0.0, 1.0, -1.0, 0.0),
    "cosine": (1.0, 0.0, 0.0, -1.0),
    "sine": (0.0, 0.0, 0.0, 0.0),
    "trapezoid": (0.0, 0.0, 0.0, 0.0),
    "modified-trapezoid": (0.0, 0.0, 0.0, 0.0),
    "modified-sine": (0.0, 0.0, 0.0, 0.0),
    "polynomial-345": (0.0, 0.0, 0.0, 0.0),
    "polynomial-4567": (0.0, 0.0, 0.0, 0.0),
}


@pytest.mark.parametrize("u", PARTS)
@pytest.mark.parametrize("name", SMOOTH)
def test_acceleration_jumps_where_the_law_says(name: str, u: float) -> None:
    law = law_of_motion(name, u)
    x = np.linspace(0.0, 1.0, 100_001)
    first, second = np.max(along(law, x, 2)), -np.min(along(law, x, 2))

    ends = (limits(law, 0.0, 2)[1], *limits(law, u, 2), limits(law, 1.0, 2)[0])

    expected = [part * (first if k < 2 else second) for k, part in enumerate(JUMPS[name])]
    assert np.allclose(ends, expected, rtol=0.0, atol=1e-4 * first)
    for piece, following in pairwise(law):  # s and s' do not jump anywhere
        assert piece.value(piece.high) == pytest.approx(following.value(following.low), abs=1e-14)
        left, right = piece.derivative(), following.derivative()
        assert left.value(piece.high) == pytest.approx(right.value(following.low), abs=1e-13)
        bends = abs(left.derivative().value(piece.high) - right.derivative().value(following.low))
        assert bends <= 1e-12 * first or piece.high == pytest.approx(u)


BOOK: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "uniform": lambda x: x,
    "constant": lambda x: np.where(x < 0.5, 2.0 * x**2, 1.0 - 2.0 * (1.0 - x) ** 2),
    "falling": lambda x: 3.0 * x**2 - 2.0 * x**3,
    "sawtooth": lambda x: np.where(x < 0.5, 4.0 * x**3, 1.0 - 4.0 * (1.0 - x) ** 3),
    "cosine": lambda x: 0.5 * (1.0 - np.cos(np.pi * x)),
    "sine": lambda x: x - np.sin(2.0 * np.pi * x) / (2.0 * np.pi),
    "polynomial-345": lambda x: 10.0 * x**3 - 15.0 * x**4 + 6.0 * x**5,
    "polynomial-4567": lambda x: 35.0 * x**4 - 84.0 * x**5 + 70.0 * x**6 - 20.0 * x**7,
}


@pytest.mark.parametrize("name", BOOK)
def test_symmetrical_law_is_that_of_the_books(name: str) -> None:
    x = np.linspace(0.0, 1.0, 201)

    assert np.max(np.abs(along(law_of_motion(name), x) - BOOK[name](x))) <= 1e-13


# greatest s' and s'' of u = 1/2; Rothbart, Cam Design Handbook, table of basic curves
PEAKS = {
    "constant": (2.0, 4.0),
    "cosine": (math.pi / 2.0, math.pi**2 / 2.0),
    "sine": (2.0, 2.0 * math.pi),
    "trapezoid": (2.0, 16.0 / 3.0),
    "modified-trapezoid": (2.0, 8.0 * math.pi / (math.pi + 2.0)),
    "modified-sine": (1.7596034, 5.5279571),
    "polynomial-345": (1.875, 10.0 / math.sqrt(3.0)),
    "polynomial-4567": (2.1875, 84.0 * math.sqrt(5.0) / 25.0),
}


@pytest.mark.parametrize("name", PEAKS)
def test_peaks_are_those_of_the_books(name: str) -> None:
    x = np.linspace(0.0, 1.0, 200_001)
    law = law_of_motion(name)

    peaks = np.max(along(law, x, 1)), np.max(along(law, x, 2))

    assert peaks == pytest.approx(PEAKS[name], rel=2e-6)


def test_fall_runs_back_in_time_or_in_the_same_order() -> None:
    law = law_of_motion("sawtooth", 0.3)
    x = np.linspace(0.0, 1.0, 11)

    mirror = tuple(piece.mirrored() for piece in reversed(law))
    same = tuple(piece.less_than_one() for piece in law)

    assert along(mirror, x) == pytest.approx(along(law, 1.0 - x), abs=1e-15)
    assert along(same, x) == pytest.approx(1.0 - along(law, x), abs=1e-15)
    assert [piece.low for piece in mirror] == pytest.approx([0.0, 0.7])
    assert [piece.low for piece in same] == pytest.approx([0.0, 0.3])


@pytest.mark.parametrize(
    ("name", "at", "values"),
    [
        pytest.param("sawtooth", (0, 0.25, 0.25, 1), (0, 30, -10, 0), id="sawtooth"),
        pytest.param("constant", (0, 0.25, 0.25, 1), (3, 3, -1, -1), id="constant"),
        pytest.param(
            "trapezoid", (0, 0.0625, 0.1875, 0.25, 0.4375, 0.8125, 1), (0, 3, 3, 0, -1, -1, 0), id="trapezoid"
        ),
    ],
)
def test_straight_pieces_give_the_law_they_belong_to(
    name: str, at: tuple[float, ...], values: tuple[float, ...]
) -> None:
    x = np.linspace(0.0, 1.0, 101)

    law = law_of_curve(Curve("own", "pieces", at, values))

    for order in range(3):
        assert along(law, x, order) == pytest.approx(along(law_of_motion(name, 0.25), x, order), abs=1e-12)


def test_smooth_curve_runs_through_its_points_without_a_jump_inside() -> None:
    at, values = (0.0, 0.2, 0.45, 0.6, 0.9, 1.0), (2.0, 3.0, 8.0, 11.0, 14.5, 15.0)

    law = law_of_points(at, values)

    assert along(law, at) == pytest.approx((np.array(values) - 2.0) / 13.0, abs=1e-14)
    assert along(law, [0.0, 1.0], 1) == pytest.approx([0.0, 0.0], abs=1e-14)
    for x in at[1:-1]:
        before, after = limits(law, x, 2)
        assert before == pytest.approx(after, abs=1e-12)


def test_points_of_a_cubic_give_that_cubic() -> None:
    at = np.linspace(0.0, 1.0, 7)

    law = law_of_points(at.tolist(), (3.0 * at**2 - 2.0 * at**3).tolist())

    x = np.linspace(0.0, 1.0, 50)
    assert along(law, x, 2) == pytest.approx(6.0 - 12.0 * x, abs=1e-12)


@pytest.mark.parametrize(
    ("key", "make"),
    [
        pytest.param("law-u", lambda: law_of_motion("sine", 0.0), id="u is 0"),
        pytest.param("law-u", lambda: law_of_motion("sine", 1.0), id="u is 1"),
        pytest.param("law-u", lambda: law_of_motion("sine", math.nan), id="u is no number"),
        pytest.param("choice-unknown", lambda: law_of_motion("cycloid"), id="unknown law"),
        pytest.param("law-open", lambda: law_of_pieces((0, 0.5, 0.5, 1), (1, 1, -1, -0.9)), id="does not close"),
        pytest.param("law-still", lambda: law_of_pieces((0, 1), (0, 0)), id="no acceleration"),
        pytest.param("law-still", lambda: law_of_pieces((0, 0.5, 0.5, 1), (-1, -1, 1, 1)), id="moves back"),
        pytest.param("law-still", lambda: law_of_points((0, 0.5, 1), (1, 2, 1)), id="returns"),
        pytest.param("law-places", lambda: law_of_points((0, 0.6, 0.5, 1), (0, 1, 2, 3)), id="backwards"),
        pytest.param("law-places", lambda: law_of_points((0, 0.5, 0.5, 1), (0, 1, 2, 3)), id="travel jumps"),
        pytest.param("law-places", lambda: law_of_pieces((0.1, 1), (1, -1)), id="starts late"),
        pytest.param("law-places", lambda: law_of_pieces((0, 1), (1,)), id="value missing"),
        pytest.param("law-leaves", lambda: law_of_points((0, 0.1, 0.2, 1), (0, 0, 3, 3)), id="overshoots"),
    ],
)
def test_law_that_cannot_be_is_explained(key: str, make: Callable[[], Law]) -> None:
    with pytest.raises(InputError) as caught:
        make()

    assert caught.value.key == key
    assert "{" not in str(caught.value)
