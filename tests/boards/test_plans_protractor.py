"""The protractor against fifty digits: every angle, exact right angles, one position and many to the last bit."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.exact import FARTHEST, MARKS, ExactBoard, graduation


def turn(angle: float) -> complex:
    board = ExactBoard({"phi": angle})
    board.step("turn", "e", "phi")
    direction: complex = board.values["e"]
    return direction


def angles(count: int) -> np.ndarray:
    """Angles of all kinds: over some turns, near zero, near marks, near right angles, and from far away."""
    random = np.random.default_rng(1024)
    near = 10.0 ** random.uniform(-15.0, -3.0, count) * random.choice([-1.0, 1.0], count)
    return np.concatenate(
        [
            random.uniform(-7.0, 7.0, count),
            near,
            random.integers(-MARKS, MARKS, count) * (math.tau / MARKS) + near,
            random.integers(-MARKS, MARKS, count) * (math.tau / MARKS) + math.pi / MARKS + near,
            random.integers(-8, 8, count) * (math.tau / 4.0) + near,
            random.uniform(-1e4, 1e4, count),
        ]
    )


@pytest.mark.parametrize("count", [500, pytest.param(4_000, marks=pytest.mark.soak)])
def test_direction_of_any_angle_is_right_to_two_units_in_the_last_place(count: int) -> None:
    with mpmath.workdps(50):
        for angle in angles(count):
            direction, exact = turn(float(angle)), mpmath.expj(mpmath.mpf(float(angle)))

            for part, true in ((direction.real, exact.real), (direction.imag, exact.imag)):
                assert abs(part - true) <= 2.0 * math.ulp(true) + 1e-24 * abs(angle) or abs(true) <= 2.0**-50


def test_many_angles_at_once_equal_one_at_a_time_to_the_last_bit() -> None:
    many = np.concatenate([angles(300), [0.0, -0.0, FARTHEST, 1.5 * FARTHEST, -1e15, 1e300, math.inf, math.nan]])
    board = ArrayBoard({"phi": many}, len(many))

    with np.errstate(invalid="ignore"):
        board.step("turn", "e", "phi")

    one_at_a_time = np.array([turn(float(angle)) for angle in many])
    assert np.array_equal(board.values["e"], one_at_a_time, equal_nan=True)


@pytest.mark.parametrize("quarters", range(-9, 10))
def test_right_angle_is_exact(quarters: int) -> None:
    assert turn(math.radians(90 * quarters)) == (1, 1j, -1, -1j)[quarters % 4]


@pytest.mark.parametrize("angle", [2e6, -3e9, 1e15])
def test_angle_of_many_turns_is_as_right_as_it_is_known(angle: float) -> None:
    with mpmath.workdps(50):
        exact = complex(mpmath.expj(mpmath.mpf(angle)))

    assert abs(turn(angle) - exact) <= math.ulp(angle)


@pytest.mark.parametrize("angle", [math.inf, -math.inf, math.nan])
def test_angle_that_is_none_has_no_direction(angle: float) -> None:
    direction = turn(angle)

    assert math.isnan(direction.real)
    assert math.isnan(direction.imag)


def test_graduation_is_right_to_a_unit_in_the_last_place_and_symmetric() -> None:
    cosines, sines = graduation()

    with mpmath.workdps(50):
        for mark in range(MARKS):
            exact = mpmath.sinpi(mpmath.mpf(2 * mark) / MARKS)
            assert abs(sines[mark] - exact) <= math.ulp(exact)
    assert cosines == sines[MARKS // 4 :] + sines[: MARKS // 4]
    assert [cosines[mark] for mark in (0, 256, 512, 768)] == [1.0, 0.0, -1.0, 0.0]
