"""Profiles: the follower traced on them, their areas, tangents and curvature."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from kulman.plans.cams.followers import PlateProfile, RollerProfile, Sizes, Straight, turned_back
from kulman.plans.cams.sizes import smallest_plate
from kulman.tests.support.cams import (
    SEED,
    SMOOTH,
    madi_motion,
    random_motion,
    random_profiles,
)

COUNTS = [pytest.param(2, id="2"), pytest.param(60, id="60", marks=pytest.mark.soak)]
TURN = 2.0 * math.pi
MM = 1e-3


def traced(profile: RollerProfile | PlateProfile, phi: float, cells: int = 720) -> float:
    """Return the travel of the follower on the finished profile: it rests where it comes highest.

    Between the places the highest is found by cutting the bracket around it again.
    """
    low, high = phi - math.pi, phi + math.pi
    for _ in range(9):
        places = np.linspace(low, high, cells)
        with np.errstate(invalid="ignore"):
            heights = np.nan_to_num(profile.seat(profile.practical(places), phi), nan=-np.inf)
        k = int(np.argmax(heights))
        low, high = places[max(k - 2, 0)], places[min(k + 2, cells - 1)]
        cells = 50
    return float(np.max(heights))


@pytest.mark.parametrize("count", COUNTS)
def test_roller_traced_on_the_finished_profile_has_its_travel(count: int) -> None:
    for profile in random_profiles(count, 1, 0.7):
        unit = 1.0 if isinstance(profile.follower, Straight) else profile.follower.unit
        for phi in np.linspace(0.05, 6.2, 13):
            travel = float(profile.motion.at(phi)[0])
            assert traced(profile, phi) * unit == pytest.approx(travel * unit, abs=1e-6 * MM)


@pytest.mark.parametrize("count", COUNTS)
def test_plate_traced_on_the_finished_profile_has_its_travel(count: int) -> None:
    random = np.random.default_rng(SEED + 12)

    for _ in range(count):
        motion, sense = random_motion(random, SMOOTH), int(random.choice((-1, 1)))
        profile = PlateProfile(motion, smallest_plate(motion, 0.01, 0.005).r_0, sense)
        for phi in np.linspace(0.05, 6.2, 13):
            assert traced(profile, phi) == pytest.approx(float(motion.at(phi)[0]), abs=1e-6 * MM)


def integral(profile: RollerProfile | PlateProfile, points: str) -> tuple[float, float]:
    """Return the area and the length of a closed curve of a cam, by quadrature on every smooth piece."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    area = length = 0.0
    corners = profile.motion.samples(math.radians(9.0))
    for low, high in pairwise(corners):
        phi = low + 0.5 * (high - low) * (1.0 + nodes)
        here, step = getattr(profile, points)(phi), 0.5 * (high - low) * weights
        if points == "pitch":
            w, _ = profile._velocity(phi, 1)
            velocity = w * turned_back(phi, profile.sense)
        else:
            velocity = profile.tangent(phi)
        area += 0.5 * float(np.sum(step * (here.real * velocity.imag - here.imag * velocity.real)))
        length += float(np.sum(step * np.abs(velocity)))
    return abs(area), length


@pytest.mark.parametrize("count", COUNTS)
def test_area_of_the_practical_profile_is_that_of_the_offset_formula(count: int) -> None:
    for profile in random_profiles(count, 2, 0.7):
        (pitch, length), (practical, _) = integral(profile, "pitch"), integral(profile, "practical")

        assert practical == pytest.approx(pitch - profile.R * length + math.pi * profile.R**2, rel=1e-6)


@pytest.mark.parametrize("count", COUNTS)
def test_curvature_and_tangents_are_those_of_the_points(count: int) -> None:
    step = 1e-5
    for profile in random_profiles(count, 3, 0.5):
        phi = np.random.default_rng(SEED).uniform(0.0, TURN, 40)
        phi = phi[np.min(np.abs(phi[:, np.newaxis] - np.array(profile.motion.corners)), axis=1) > 10.0 * step]
        ends = profile.practical(phi - step), profile.practical(phi + step)
        assert (ends[1] - ends[0]) / (2.0 * step) == pytest.approx(profile.tangent(phi), abs=1e-6)
        turned = np.angle(profile.unit(phi + step) / profile.unit(phi - step))
        length = np.abs(profile.pitch(phi + step) - profile.pitch(phi - step))
        assert -profile.sense * turned / length == pytest.approx(profile.curvature(phi), rel=1e-5, abs=1e-4)


@pytest.mark.parametrize("count", COUNTS)
def test_least_radius_of_curvature_is_found(count: int) -> None:
    for profile in random_profiles(count, 4, 0.5):
        phi = np.concatenate([np.linspace(a, b, 3000) for a, b in pairwise(profile.motion.corners)])
        most = max(float(np.max(profile.curvature(phi, side))) for side in (-1, 1))
        assert profile.rho_min == pytest.approx(1.0 / most, rel=1e-6)
        assert profile.rho_min <= 1.0 / most * (1.0 + 1e-13)
        assert not profile.undercuts


def test_contact_of_a_plate_is_beside_its_axis_by_the_analogue_of_velocity() -> None:
    profile = PlateProfile(madi_motion(), 0.04, -1)
    phi = np.linspace(0.0, 6.2, 40)

    beside = profile.practical(phi) - profile.centre(phi)

    assert np.abs(beside) == pytest.approx(np.abs(profile.motion.at(phi)[1]), abs=1e-15)


def test_pitch_curve_is_traced_against_the_sense_of_the_cam() -> None:
    for sense in (1, -1):
        profile = RollerProfile(Straight(madi_motion(), sense), Sizes(0.05, 0.0, 0.05), 0.01)
        centre = profile.pitch(np.array([0.0, 0.1]))
        assert centre[0] == pytest.approx(0.05j)
        assert math.copysign(1.0, centre[1].real) == sense
