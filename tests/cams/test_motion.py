"""The motion over a turn: phases, limits at jumps, exact extremes, section lines."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.cams.cam import Cam, Curve
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import PHASES, Motion, motion_of
from kulman.scales.errors import InputError
from kulman.tests.support.cams import SEED, dense, madi_motion, random_motion

COUNTS = [pytest.param(12, id="12"), pytest.param(500, id="500", marks=pytest.mark.soak)]
TURN = 2.0 * math.pi


def test_phases_begin_and_end_exactly() -> None:
    motion = madi_motion()
    top, leave, last = np.cumsum(np.radians([108.0, 15.0, 108.0]))

    s, ds, _ = motion.at([0.0, top, 0.5 * (top + leave), leave, last, 6.0, TURN])

    assert list(s) == [0.0, 13e-3, 13e-3, 13e-3, 0.0, 0.0, 0.0]
    assert list(np.abs(ds)) == [0.0] * 7


def test_what_rounded_angles_leave_of_a_turn_is_no_dwell() -> None:
    law = law_of_motion("sine")
    left = [Motion(13e-3, 2.0, 1.0, TURN - 3.0 - dwell, law) for dwell in (2e-7, 2e-4)]

    assert [motion.lower.lasts for motion in left] == [False, True]
    assert all(motion.rise.lasts and motion.upper.lasts for motion in left)
    assert not Motion(13e-3, 2.0, 0.0, 2.0, law).upper.lasts


def test_velocity_jumps_down_where_a_steady_rise_ends() -> None:
    motion = Motion(13e-3, 2.0, 0.0, 2.0, law_of_motion("uniform"))

    assert motion.drops == pytest.approx((2.0,))
    assert motion.leaps == pytest.approx((0.0, 4.0))
    assert [jump.phi for jump in motion.velocity_jumps] == sorted((*motion.drops, *motion.leaps))
    assert madi_motion().jumps
    assert madi_motion().velocity_jumps == madi_motion().drops == madi_motion().leaps == ()


def test_motion_repeats_in_every_turn() -> None:
    motion = madi_motion()
    phi = np.linspace(0.1, 6.2, 50)

    for turns in (-2, 1, 3):
        for value, again in zip(motion.at(phi), motion.at(phi + TURN * turns), strict=True):
            assert again == pytest.approx(value, abs=1e-15 * 1e3)


def test_one_angle_and_many_give_the_same_bits() -> None:
    motion = random_motion(np.random.default_rng(SEED))
    phi = np.linspace(-1.0, 8.0, 301)

    many = motion.at(phi)

    assert all(motion.at(x)[k] == many[k][i] for i, x in enumerate(phi) for k in range(3))


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


def test_phases_that_fill_the_turn_leave_no_sliver_of_a_dwell() -> None:
    third = math.radians(120.0)

    motion = Motion(0.01, third, third, third, law_of_motion("cosine"))

    assert motion.lower.pieces == ()
    assert motion.corners[-1] == TURN
    assert len(motion.corners) == len(set(motion.corners))


def test_phases_longer_than_a_turn_are_refused() -> None:
    with pytest.raises(InputError, match="361"):
        Motion(0.01, *np.radians([120.0, 121.0, 120.0]), law_of_motion("cosine"))


def test_cam_as_data_gives_its_motion() -> None:
    values = {"h": 0.013, "phi_rise": 1.8, "phi_upper": 0.3, "phi_fall": 2.0, "u": 0.4, "u_fall": 0.7}
    own = Curve("own", "points", (0.0, 0.5, 1.0), (0.0, 5.0, 10.0))

    motion = motion_of(Cam(("roller",), "sine", "own", fall="same", curves=(own,)), values)

    assert float(motion.at(0.4 * 1.8)[0]) == pytest.approx(0.4 * 0.013)
    assert float(motion.at(2.1 + 1.0)[0]) == pytest.approx(0.5 * 0.013)
