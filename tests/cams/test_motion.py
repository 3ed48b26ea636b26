"""Laws of motion against quadrature and the books; the motion over a turn: jumps, exact extremes, section lines."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from kulman.plans.cams.cam import Cam, Curve
from kulman.plans.cams.laws_of_motion import Law, _law_of_pieces, _law_of_points, law_of_curve, law_of_motion
from kulman.plans.cams.motion import PHASES, Motion, motion_of
from kulman.scales.errors import InputError
from kulman.tests.support.cams import SEED, SMOOTH, dense, madi_motion, random_motion

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
    curves = list(law)
    for _ in range(order):
        curves = [curve.derivative() for curve in curves]
    left, right = [curve for curve in curves if curve.low < x], [curve for curve in curves if curve.high > x]
    return (float(left[-1].value(x)) if left else 0.0, float(right[0].value(x)) if right else 0.0)


@pytest.mark.parametrize("parts", ALL_PARTS)
@pytest.mark.parametrize("name", SMOOTH)
def test_closed_forms_are_the_integrals_of_two_lobes_of_equal_areas(name: str, parts: tuple[float, ...]) -> None:
    x = np.linspace(0.0, 1.0, 41)

    for u in parts:
        law = law_of_motion(name, u)
        velocity, travel = quadrature(law, 2, 0.0, x), quadrature(law, 1, 0.0, x)
        assert np.max(np.abs(along(law, x, 1) - velocity)) <= 1e-13 * np.max(np.abs(along(law, x, 1)))
        assert np.max(np.abs(along(law, x) - travel)) <= 1e-13
        assert along(law, [0.0, 1.0]).tolist() == [0.0, 1.0]
        assert np.max(np.abs(along(law, [0.0, 1.0], 1))) <= 1e-15
        assert float(along(law, u)) == pytest.approx(u, rel=1e-14)
        assert quadrature(law, 2, 0.0, np.array([u]))[0] == pytest.approx(-quadrature(law, 2, u, np.array([1.0]))[0])


# acceleration at the start, on both sides of the join, at the end, as parts of A_1 and A_2; of others none
JUMPS = {
    "constant": (1.0, 1.0, -1.0, -1.0),
    "falling": (1.0, 0.0, 0.0, -1.0),
    "sawtooth": (0.0, 1.0, -1.0, 0.0),
    "cosine": (1.0, 0.0, 0.0, -1.0),
}


@pytest.mark.parametrize(
    ("name", "u"),
    [
        pytest.param(name, u, marks=() if (i + j) % 3 == 0 else pytest.mark.soak)
        for i, name in enumerate(SMOOTH)
        for j, u in enumerate(PARTS)
    ],
)
def test_amplitudes_are_as_the_lengths_of_lobes_and_the_acceleration_jumps_where_the_law_says(
    name: str, u: float
) -> None:
    law = law_of_motion(name, u)
    x = np.linspace(0.0, 1.0, 100_001)
    first, second = np.max(along(law, x, 2)), -np.min(along(law, x, 2))

    ends = (limits(law, 0.0, 2)[1], *limits(law, u, 2), limits(law, 1.0, 2)[0])

    expected = np.array(JUMPS.get(name, (0.0,) * 4)) * (first, first, second, second)
    assert np.allclose(ends, expected, rtol=0.0, atol=1e-4 * first)
    assert second / first == pytest.approx(u / (1.0 - u), rel=2e-3)
    if name in ("constant", "sawtooth"):
        assert -ends[2] / ends[1] == pytest.approx(u / (1.0 - u), rel=1e-12)
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


def test_symmetrical_laws_and_their_peaks_are_those_of_the_books() -> None:
    x = np.linspace(0.0, 1.0, 20_001)
    for name, travel in BOOK.items():
        assert np.max(np.abs(along(law_of_motion(name), x[::100]) - travel(x[::100]))) <= 1e-13, name
    for name, expected in PEAKS.items():
        law = law_of_motion(name)
        coarse = [x[np.argmax(along(law, x, order))] for order in (1, 2)]
        near = [np.clip(peak + np.linspace(-1e-4, 1e-4, 2001), 0.0, 1.0) for peak in coarse]
        peaks = [np.max(along(law, places, order)) for places, order in zip(near, (1, 2), strict=True)]
        assert peaks == pytest.approx(expected, rel=2e-6), name


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
        ("sawtooth", (0, 0.25, 0.25, 1), (0, 30, -10, 0)),
        ("constant", (0, 0.25, 0.25, 1), (3, 3, -1, -1)),
        ("trapezoid", (0, 0.0625, 0.1875, 0.25, 0.4375, 0.8125, 1), (0, 3, 3, 0, -1, -1, 0)),
    ],
)
def test_straight_pieces_give_the_law_they_belong_to(
    name: str, at: tuple[float, ...], values: tuple[float, ...]
) -> None:
    x, law = np.linspace(0.0, 1.0, 101), law_of_curve(Curve("own", "pieces", at, values))

    for order in range(3):
        assert along(law, x, order) == pytest.approx(along(law_of_motion(name, 0.25), x, order), abs=1e-12)


def test_smooth_curve_runs_through_its_points_without_a_jump_inside() -> None:
    at, values = (0.0, 0.2, 0.45, 0.6, 0.9, 1.0), (2.0, 3.0, 8.0, 11.0, 14.5, 15.0)
    places, x = np.linspace(0.0, 1.0, 7), np.linspace(0.0, 1.0, 50)

    law = _law_of_points(at, values)
    cubic = _law_of_points(places.tolist(), (3.0 * places**2 - 2.0 * places**3).tolist())

    assert along(law, at) == pytest.approx((np.array(values) - 2.0) / 13.0, abs=1e-14)
    assert along(law, [0.0, 1.0], 1) == pytest.approx([0.0, 0.0], abs=1e-14)
    for place in at[1:-1]:
        before, after = limits(law, place, 2)
        assert before == pytest.approx(after, abs=1e-12)
    assert along(cubic, x, 2) == pytest.approx(6.0 - 12.0 * x, abs=1e-12)


@pytest.mark.parametrize(
    ("key", "make"),
    [
        *(("law-u", partial(law_of_motion, "sine", u)) for u in (0.0, 1.0, math.nan)),
        ("choice-unknown", partial(law_of_motion, "cycloid")),
        ("law-open", partial(_law_of_pieces, (0, 0.5, 0.5, 1), (1, 1, -1, -0.9))),
        ("law-still", partial(_law_of_pieces, (0, 1), (0, 0))),
        ("law-still", partial(_law_of_pieces, (0, 0.5, 0.5, 1), (-1, -1, 1, 1))),  # moves back
        ("law-still", partial(_law_of_points, (0, 0.5, 1), (1, 2, 1))),  # returns
        ("law-places", partial(_law_of_points, (0, 0.6, 0.5, 1), (0, 1, 2, 3))),
        ("law-places", partial(_law_of_points, (0, 0.5, 0.5, 1), (0, 1, 2, 3))),  # the travel jumps
        ("law-places", partial(_law_of_pieces, (0.1, 1), (1, -1))),
        ("law-places", partial(_law_of_pieces, (0, 1), (1,))),
        ("law-leaves", partial(_law_of_points, (0, 0.1, 0.2, 1), (0, 0, 3, 3))),
    ],
)
def test_law_that_cannot_be_is_explained(key: str, make: Callable[[], Law]) -> None:
    with pytest.raises(InputError) as caught:
        make()

    assert caught.value.key == key
    assert "{" not in str(caught.value)


COUNTS = [pytest.param(12, id="12"), pytest.param(500, id="500", marks=pytest.mark.soak)]
TURN = 2.0 * math.pi


def test_phases_begin_and_end_exactly() -> None:
    motion = madi_motion()
    top, leave, last = np.cumsum(np.radians([108.0, 15.0, 108.0]))

    s, ds, _ = motion.at([0.0, top, 0.5 * (top + leave), leave, last, 6.0, TURN])

    assert list(s) == [0.0, 13e-3, 13e-3, 13e-3, 0.0, 0.0, 0.0]
    assert list(np.abs(ds)) == [0.0] * 7


def test_what_rounded_angles_leave_of_a_turn_is_no_dwell() -> None:
    law, third = law_of_motion("sine"), math.radians(120.0)
    left = [Motion(13e-3, 2.0, 1.0, TURN - 3.0 - dwell, law) for dwell in (2e-7, 2e-4)]

    full = Motion(0.01, third, third, third, law)

    assert [motion.lower.lasts for motion in left] == [False, True]
    assert all(motion.rise.lasts and motion.upper.lasts for motion in left)
    assert not Motion(13e-3, 2.0, 0.0, 2.0, law).upper.lasts
    assert full.lower.pieces == ()
    assert full.corners[-1] == TURN
    assert len(full.corners) == len(set(full.corners))
    with pytest.raises(InputError, match="361"):
        Motion(0.01, *np.radians([120.0, 121.0, 120.0]), law)


def test_motion_repeats_in_every_turn_and_one_angle_and_many_give_the_same_bits() -> None:
    motion = random_motion(np.random.default_rng(SEED))
    phi = np.linspace(-1.0, 8.0, 301)

    many = motion.at(phi)

    assert all(motion.at(x)[k] == many[k][i] for i, x in enumerate(phi) for k in range(3))
    inside = np.linspace(0.1, 6.2, 50)
    for turns in (-2, 1, 3):
        for value, again in zip(madi_motion().at(inside), madi_motion().at(inside + TURN * turns), strict=True):
            assert again == pytest.approx(value, abs=1e-12)


def test_jump_has_two_limits() -> None:
    motion = madi_motion()
    amplitude = 18.0 * 13e-3 / math.radians(108.0) ** 2

    jumps = [(jump.phi, jump.order, jump.before, jump.after) for jump in motion.jumps]

    assert jumps == [
        pytest.approx((math.radians(36.0), 2, amplitude, -amplitude / 2.0), rel=1e-12),
        pytest.approx((math.radians(195.0), 2, -amplitude / 2.0, amplitude), rel=1e-12),
    ]
    for phi, _, before, after in jumps:
        assert float(motion.at(phi, -1)[2]) == pytest.approx(before, rel=1e-12)
        assert float(motion.at(phi, +1)[2]) == pytest.approx(after, rel=1e-12)


def test_uniform_law_jumps_in_velocity_at_its_ends() -> None:
    motion = Motion(0.01, 1.0, 0.5, 2.0, law_of_motion("uniform"))

    jumps = [(jump.phi, jump.order, jump.before, jump.after) for jump in motion.jumps]

    expected = [(0.0, 1, 0.0, 0.01), (1.0, 1, 0.01, 0.0), (1.5, 1, 0.0, -0.005), (3.5, 1, -0.005, 0.0)]
    assert jumps == [pytest.approx(jump) for jump in expected]
    assert motion.drops == pytest.approx((1.0, 1.5))
    assert motion.leaps == pytest.approx((0.0, 3.5))
    assert [jump.phi for jump in motion.velocity_jumps] == sorted((*motion.drops, *motion.leaps))
    assert madi_motion().velocity_jumps == madi_motion().drops == madi_motion().leaps == ()


def test_motion_without_dwells_joins_fall_and_rise() -> None:
    motion = Motion(0.01, 3.0, 0.0, TURN - 3.0, law_of_motion("cosine"))

    assert [phase.name for phase in motion.phases if phase.pieces] == ["rise", "fall"]
    assert float(motion.at(TURN, -1)[2]) == pytest.approx(0.005 * (math.pi / (TURN - 3.0)) ** 2)
    assert float(motion.at(0.0)[2]) == pytest.approx(0.005 * (math.pi / 3.0) ** 2)


@pytest.mark.parametrize("count", COUNTS)
def test_extremes_are_exact(count: int) -> None:
    random = np.random.default_rng(SEED)

    for _ in range(count):
        motion = random_motion(random)
        weights = random.normal(size=3)
        found = motion.maximum(*weights)
        samples = [dense(motion, name, 400) for name in PHASES if getattr(motion, name).pieces]
        most = max(float(np.max(weights @ np.array(sample[1:]))) for sample in samples)
        size = np.abs(weights) @ [motion.h, motion.ds_max.value, motion.d2s_max.value]
        assert most <= found.value + 1e-13 * size
        assert found.value <= most + 1e-4 * size  # between samples the curves bend
        limits = [weights @ np.array(motion.at(found.phi, side)) for side in (-1, 1)]
        assert min(abs(found.value - limit) for limit in limits) <= 1e-9 * size


@pytest.mark.parametrize(
    ("u", "count", "equal"),
    [
        pytest.param(1.0 / 3.0, 12, True, id="third"),
        pytest.param(0.4, 15, True, id="two fifths"),
        pytest.param(0.37, 13, False, id="no equal division"),
    ],
)
def test_jump_lies_on_a_section_line(u: float, count: int, equal: bool) -> None:
    motion = Motion(0.01, 2.0, 0.5, 2.0, law_of_motion("sawtooth", u))

    division = motion.division(12)
    angles = division.angles

    assert (division.top, division.leave, division.last) == (count, count + 1, 2 * count + 1)
    assert [angles[i] for i in (0, division.top, division.leave, division.last)] == pytest.approx([0.0, 2.0, 2.5, 4.5])
    assert [angles[i] for i in division.jumps] == pytest.approx([jump.phi for jump in motion.jumps], abs=1e-12)
    assert (np.ptp(np.diff(angles[: count + 1])) < 1e-12) == equal
    assert np.max(np.diff(angles[: count + 1])) <= 2.0 / 12.0 + 1e-12


def test_inflexions_of_smooth_laws_lie_on_section_lines() -> None:
    motion = Motion(0.01, 2.0, 0.0, 3.0, law_of_motion("sine", 0.25), law_of_motion("polynomial-345", 0.6), "same")

    division = motion.division(12)
    angles = division.angles

    assert motion.inflexions == pytest.approx((0.5, 2.0 + 0.6 * 3.0))
    for phi in motion.inflexions:
        assert np.min(np.abs(angles - phi)) < 1e-12
    assert division.top == division.leave


def test_cam_as_data_gives_its_motion() -> None:
    values = {"h": 0.013, "phi_rise": 1.8, "phi_upper": 0.3, "phi_fall": 2.0, "u": 0.4, "u_fall": 0.7}
    own = Curve("own", "points", (0.0, 0.5, 1.0), (0.0, 5.0, 10.0))

    motion = motion_of(Cam(("roller",), "sine", "own", fall="same", curves=(own,)), values)

    assert float(motion.at(0.4 * 1.8)[0]) == pytest.approx(0.4 * 0.013)
    assert float(motion.at(2.1 + 1.0)[0]) == pytest.approx(0.5 * 0.013)
