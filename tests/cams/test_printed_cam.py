"""The printed numbers of the project's cam beside the exact ones: the law is the one that they fit.

The figure with the law is lost. Of all laws the sawtooth with u = 1/3 and a fall mirrored in time comes nearest to the
printed s'_max, r_0 and e; what remains is the accuracy of a drawing. Two printed numbers are not of this kind.
"""

from __future__ import annotations

import math

import pytest

from kulman.plans.cams.cam import ORDERS
from kulman.plans.cams.followers import RollerProfile, Straight
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.sizes import smallest_plate, smallest_roller, wedge
from kulman.tests.support.cams import MADI_LIMITS, SMOOTH, madi_motion

MM = 1e-3
DS_MAX, R_0, E = 20.8 * MM, 45.696 * MM, 7.728 * MM


def test_printed_sizes_are_those_of_the_sawtooth_within_two_percent_and_a_bit() -> None:
    motion = madi_motion()
    sizes = smallest_roller(wedge(motion, MADI_LIMITS))

    assert motion.ds_max.value == pytest.approx(DS_MAX, rel=0.006)
    assert sizes.r_0 == pytest.approx(R_0, rel=0.01)
    assert sizes.e == pytest.approx(E, rel=0.021)
    assert sizes.on == ("rise", "fall")


def test_no_other_law_fits_the_printed_sizes_as_well() -> None:
    phases = [math.radians(angle) for angle in (108.0, 15.0, 108.0)]
    errors = {}
    for name in SMOOTH:
        for order in ORDERS:
            motion = Motion(13.0 * MM, *phases, law_of_motion(name, 1.0 / 3.0), order=order)
            sizes = smallest_roller(wedge(motion, MADI_LIMITS))
            found = (motion.ds_max.value / DS_MAX, sizes.r_0 / R_0, sizes.e / E)
            errors[name, order] = max(abs(part - 1.0) for part in found)

    best, following = sorted(errors, key=lambda key: errors[key])[:2]

    assert best == ("sawtooth", "mirror")
    assert errors[following] > 3.0 * errors[best]


def test_printed_least_radius_is_not_that_of_the_sharpest_place() -> None:
    motion = madi_motion()
    sizes = smallest_roller(wedge(motion, MADI_LIMITS))

    sharpest = RollerProfile(Straight(motion), sizes, 7.0 * MM).sharpest

    assert sharpest.value == pytest.approx(29.24 * MM, rel=1e-3)  # printed 60 mm
    assert math.degrees(sharpest.phi) == pytest.approx(36.0)  # where the acceleration jumps
    upper = math.hypot(sizes.e, sizes.s_0 + motion.h)
    assert upper == pytest.approx(60.0 * MM, rel=0.04)  # the printed one is nearer to the radius of the upper dwell


def test_printed_radius_under_the_plate_is_an_amplitude_on_paper() -> None:
    sizes = smallest_plate(madi_motion(), 10.0 * MM, 5.0 * MM)

    assert sizes.r_0_min == pytest.approx(28.60 * MM, rel=1e-3)  # printed 55 mm, as many as A_2 has on paper
    assert sizes.R_plate == pytest.approx(25.8 * MM, rel=0.005)


def test_printed_scale_factors_follow_from_the_drawn_travel() -> None:
    per_mm, pole, omega = math.radians(1.0), 30.0, 200.0
    mu_s, mu_ds, mu_d2s = 0.168, 0.321, 0.613  # 10^-3 m/mm

    assert mu_ds == pytest.approx(mu_s / (per_mm * pole), rel=1e-3)
    assert mu_d2s == pytest.approx(mu_ds / (per_mm * pole), rel=1e-3)
    assert omega * mu_ds == pytest.approx(64.2, rel=1e-3)
    assert omega**2 * mu_d2s == pytest.approx(24520.0, rel=1e-3)
    assert math.degrees(math.atan(mu_s / mu_ds)) == pytest.approx(27.6, abs=0.05)
    assert math.degrees(math.atan(mu_ds / mu_d2s)) == pytest.approx(27.6, abs=0.05)
    assert 13.0 / mu_s == pytest.approx(77.4, abs=0.05)  # mm of the highest ordinate
    assert 20.8 / mu_ds == pytest.approx(64.8, abs=0.05)
    assert [45.696 / mu_s, 7.728 / mu_s] == pytest.approx([272.0, 46.0], abs=0.05)


def test_printed_mistakes_are_of_the_size_that_the_document_tells() -> None:
    motion, mu = madi_motion(), 0.613
    s = float(motion.at(math.radians(36.0))[0]) / MM  # where the second amplitude begins
    upper = math.hypot(7.728, math.sqrt(45.696**2 - 7.728**2) + 13.0)

    assert s == pytest.approx(4.33, abs=0.005)
    assert 55.0 - s / mu == pytest.approx(47.9, abs=0.05)
    assert (55.0 - s / mu) * mu == pytest.approx(29.4, abs=0.05)
    assert upper == pytest.approx(58.6, abs=0.05)
