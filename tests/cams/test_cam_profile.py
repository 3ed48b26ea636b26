"""Profiles: the follower traced on them, their areas and curvature, and what a cutter leaves of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from shapely import Point, Polygon
from shapely.affinity import rotate

from kulman.plans.cams.cam import LAWS
from kulman.plans.cams.envelopes import Undercut, _chords, backward
from kulman.plans.cams.followers import Limits, PlateProfile, RollerProfile, Sizes, Straight, turned_back
from kulman.plans.cams.laws_of_motion import UNIFORM, law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.sizes import _smallest_plate, _smallest_roller, wedge
from kulman.tests.support.cams import (
    MADI_LIMITS,
    SEED,
    SMOOTH,
    madi_motion,
    random_limits,
    random_motion,
    random_profiles,
)
from kulman.tests.support.cases import some

TURN = 2.0 * math.pi
MM = 1e-3

COUNTS = pytest.mark.parametrize("count", [pytest.param(2, id="2"), pytest.param(30, id="30", marks=pytest.mark.soak)])


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


@COUNTS
def test_roller_traced_on_the_finished_profile_has_its_travel(count: int) -> None:
    for profile in random_profiles(count, 1, 0.7):
        unit = 1.0 if isinstance(profile.follower, Straight) else profile.follower.unit
        for phi in np.linspace(0.05, 6.2, 13):
            travel = float(profile.motion.at(phi)[0])
            assert traced(profile, phi) * unit == pytest.approx(travel * unit, abs=1e-6 * MM)


@COUNTS
def test_plate_traced_on_the_finished_profile_has_its_travel(count: int) -> None:
    random = np.random.default_rng(SEED + 12)

    for _ in range(count):
        motion, sense = random_motion(random, SMOOTH), int(random.choice((-1, 1)))
        profile = PlateProfile(motion, _smallest_plate(motion, 0.01, 0.005).r_0, sense)
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


@COUNTS
def test_area_of_the_practical_profile_is_that_of_the_offset_formula(count: int) -> None:
    for profile in random_profiles(count, 2, 0.7):
        (pitch, length), (practical, _) = integral(profile, "pitch"), integral(profile, "practical")

        assert practical == pytest.approx(pitch - profile.R * length + math.pi * profile.R**2, rel=1e-6)


@COUNTS
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


@COUNTS
def test_least_radius_of_curvature_is_found(count: int) -> None:
    for profile in random_profiles(count, 4, 0.5):
        phi = np.concatenate([np.linspace(a, b, 3000) for a, b in pairwise(profile.motion.corners)])
        most = max(float(np.max(profile.curvature(phi, side))) for side in (-1, 1))
        assert profile.rho_min == pytest.approx(1.0 / most, rel=1e-6)
        assert profile.rho_min <= 1.0 / most * (1.0 + 1e-13)
        assert not profile.undercuts


def test_contact_of_a_plate_is_beside_its_axis_and_the_pitch_curve_runs_against_the_sense_of_the_cam() -> None:
    profile = PlateProfile(madi_motion(), 0.04, -1)
    phi = np.linspace(0.0, 6.2, 40)

    beside = profile.practical(phi) - profile.centre(phi)

    assert np.abs(beside) == pytest.approx(np.abs(profile.motion.at(phi)[1]), abs=1e-15)
    for sense in (1, -1):
        pitch = RollerProfile(Straight(madi_motion(), sense), Sizes(0.05, 0.0, 0.05), 0.01).pitch(np.array([0.0, 0.1]))
        assert pitch[0] == pytest.approx(0.05j)
        assert math.copysign(1.0, pitch[1].real) == sense


EIGHTH = [0, 3, *(pytest.param(k, marks=pytest.mark.soak) for k in (1, 2, 4, 5, 6, 7))]
NECK = Motion(287.0 * MM, *np.radians((51.34, 26.21, 41.19)), law_of_motion("sine"))  # of a cam with a narrow neck
NECKED = Straight(NECK), Sizes(math.hypot(5.0, 33.9) * MM, -5.0 * MM, 33.9 * MM)


@cache
def undercut_cams() -> tuple[RollerProfile, ...]:
    """Return undercut cams: of the project at three radii of the roller, of laws that jump in velocity, random ones."""
    motion = madi_motion()
    sizes = _smallest_roller(wedge(motion, MADI_LIMITS))
    turned = Sizes(sizes.r_0, -sizes.e, sizes.s_0)
    uniform = Motion(0.01, 2.0, 0.5, 2.0, law_of_motion("uniform"))
    found = [RollerProfile(Straight(motion), sizes, R) for R in (0.0293, 0.032, 0.04)]
    found.append(RollerProfile(Straight(motion, -1), turned, 0.034))
    found.append(RollerProfile(Straight(uniform), Sizes(0.05, 0.0, 0.05), 0.02))
    for profile in random_profiles(4, 5, 1.0):
        R = min(1.15 * profile.rho_min, 0.98 * profile.sizes.r_0)
        found.append(RollerProfile(profile.follower, profile.sizes, R))
    return tuple(found)


def eroded(profile: RollerProfile) -> Polygon:
    """Return the cam that a milling cutter of the roller's radius leaves: what is R inside the pitch curve.

    The library simplifies what it offsets: the result is right to 1e-4 R.
    """
    pitch = profile.pitch(profile.motion.samples(math.radians(0.05))[:-1])
    cam = Polygon(np.column_stack((pitch.real, pitch.imag))).buffer(-profile.R, quad_segs=400)
    return cam if cam.geom_type == "Polygon" else next(part for part in cam.geoms if part.contains(Point(0.0, 0.0)))


def off_the_envelope(profile: RollerProfile | PlateProfile, cut: Undercut, end: float) -> float:
    """Return how far the corner of an undercut is from the envelope at one of its ends.

    Where the velocity jumps up, that is the roller's arc between the two limits.
    """
    jumps = [jump for jump in profile.motion.leaps if abs((end - jump + 1.0) % TURN - 1.0) < 1e-9]
    if not jumps or isinstance(profile, PlateProfile):
        return min(abs(complex(profile.practical(end, side)) - cut.corner) for side in (-1, 1))
    before, after = ((complex(profile.practical(end, side)) - complex(profile.pitch(end))) for side in (-1, 1))
    spoke = cut.corner - complex(profile.pitch(end))
    apart = abs(np.angle(spoke / before)) + abs(np.angle(after / spoke)) - abs(np.angle(after / before))
    return max(abs(abs(spoke) - profile.R), profile.R * float(apart))


@pytest.mark.parametrize("k", EIGHTH)
def test_undercut_is_found_and_outline_and_lost_travel_are_those_of_the_cut_cam(k: int) -> None:
    profile = undercut_cams()[k]

    cuts, points = profile.undercuts, profile.outline(math.radians(0.05))

    assert cuts
    assert left_by_the_cutter(profile) < 1e-4
    for cut in cuts:
        for end in (cut.start, cut.end):  # both branches run through the corner
            assert off_the_envelope(profile, cut, end) < 1e-12
    pitch = profile.pitch(profile.motion.samples(math.radians(0.1)))
    away = [np.min(np.abs(point - pitch)) for point in points[:: max(1, len(points) // 500)]]
    assert away == pytest.approx([profile.R] * len(away), abs=1e-7)  # 0.1 deg of the pitch curve between its points


WIDE_CUTTERS = {  # the cam, and its undercuts: from, to, deg, the travel that is lost, mm, and where
    "arc of the start": (
        ("uniform", 13.0, (60.0, 150.0), (40.0, 40.0), 7.0, 1),
        [(0.0, 8.106, 0.00282, 2.681), (44.579, 73.699, 1.1174, 60.0)],
    ),
    "arc of the end": (("uniform", 48.0, (140.0, 56.0), (33.0, 72.0), 47.5, -1), [(101.121, 196.0, 16.408, 140.0)]),
    "lobe cut off": (("cosine", 30.0, (64.0, 64.0), (33.0, 33.0), 14.5, 1), [(2.972, 125.028, 25.927, 64.0)]),
}


@pytest.mark.parametrize("name", some(WIDE_CUTTERS, 0))
def test_undercuts_of_wide_cutters_are_those_of_the_cut_cam(name: str) -> None:
    (law, stroke, phases, gammas, R, sense), expected = WIDE_CUTTERS[name]
    rise, fall = np.radians(phases)
    motion, limits = Motion(stroke * MM, rise, 0.0, fall, law_of_motion(law)), Limits(*np.radians(gammas))
    profile = RollerProfile(Straight(motion, sense), _smallest_roller(wedge(motion, limits, sense)), R * MM)

    found = [
        (*np.degrees((cut.start, cut.end)), cut.lost / MM, math.degrees(cut.phi_lost)) for cut in profile.undercuts
    ]

    assert found == [pytest.approx(one, rel=1e-3, abs=1e-4) for one in expected]
    left_by_the_cutter(profile)


def test_a_neck_narrower_than_the_cutter_cuts_the_lobe_off_where_nothing_runs_backwards() -> None:
    profile = RollerProfile(*NECKED, 33.2 * MM)

    (cut,) = profile.undercuts

    assert not backward(profile)
    assert cut.lost > 0.99 * NECK.h
    left_by_the_cutter(profile)


@pytest.mark.parametrize("wider", some([1e-9, 1e-6, 1e-3, 0.02], 1))
def test_a_neck_hardly_narrower_than_the_cutter_is_found(wider: float) -> None:
    width, ends = neck(RollerProfile(*NECKED, 1.0 * MM), math.radians(20.0), math.radians(105.0))

    narrower, cutting = (RollerProfile(*NECKED, 0.5 * width * (1.0 + w)) for w in (-1e-9, wider))

    (cut,) = cutting.undercuts
    assert narrower.undercuts == []
    assert cut.lost > 0.95 * NECK.h
    assert (cut.start, cut.end) == pytest.approx(ends, abs=2.0 * math.sqrt(wider))
    outline = cutting.outline(math.radians(0.1))
    assert Polygon(np.column_stack((outline.real, outline.imag))).is_valid


def neck(profile: RollerProfile, first: float, second: float) -> tuple[float, tuple[float, float]]:
    """Least distance of the pitch curve's two branches around two angles, and the angles, by ever finer grids."""
    ends, room = np.array([first, second]), math.radians(15.0)
    for _ in range(40):
        a, b = ends[:, np.newaxis] + room * np.linspace(-1.0, 1.0, 41)
        away = np.abs(np.asarray(profile.pitch(a))[:, np.newaxis] - np.asarray(profile.pitch(b)))
        i, j = np.unravel_index(int(np.argmin(away)), away.shape)
        ends, room = np.array([a[i], b[j]]), 0.5 * room
    return float(away[i, j]), (float(ends[0]), float(ends[1]))


def left_by_the_cutter(profile: RollerProfile) -> float:
    """Assert that outline and travel are those of what the cutter leaves round the centre; return what part differs."""
    points, cam = profile.outline(math.radians(0.05)), eroded(profile)
    ring = np.array(cam.exterior.coords) @ np.array([1.0, 1.0j])
    ring = np.concatenate([ring[:-1] + part * np.diff(ring) for part in np.linspace(0.0, 1.0, 8, endpoint=False)])
    outline, cuts = Polygon(np.column_stack((points.real, points.imag))), profile.undercuts
    unit = 1.0 if isinstance(profile.follower, Straight) else profile.follower.unit
    assert outline.is_valid
    apart = float(outline.symmetric_difference(cam).area)
    assert apart < 2e-4 * profile.R * cam.length
    for phi in [*np.linspace(0.0, TURN, 61), *(cut.phi_lost for cut in cuts)]:
        travel, within = float(profile.motion.at(phi)[0]), 1e-4 * profile.R
        inside = next((cut for cut in cuts if (phi - cut.start) % TURN < cut.end - cut.start), None)
        resting = float(profile.seat(inside.corner, phi)) if inside else travel
        assert float(np.nanmax(profile.seat(ring, phi))) * unit == pytest.approx(resting * unit, abs=within)
        assert -1e-12 <= travel - resting <= (inside.lost if inside else 0.0) + 1e-12
        if inside and phi == inside.phi_lost:
            assert travel - resting == pytest.approx(inside.lost, abs=1e-12)
            assert inside.lost > 0.0
    return apart / float(cam.area)


@pytest.mark.parametrize("count", [pytest.param(8, id="8"), pytest.param(60, id="60", marks=pytest.mark.soak)])
def test_wide_cutters_leave_what_is_round_the_centre(count: int) -> None:
    random = np.random.default_rng(SEED + 14)

    for k in range(count):
        motion, limits, sense = random_motion(random), random_limits(random), int(random.choice((-1, 1)))
        if k % 2:  # a narrow lobe, or a velocity that jumps
            law = law_of_motion(str(random.choice(LAWS)) if k % 4 == 1 else UNIFORM)
            phases = np.radians(random.uniform(30.0, 110.0, 2))
            motion = Motion(motion.h, phases[0], 0.0, phases[1], law)
        sizes = _smallest_roller(wedge(motion, limits, sense))
        profile = RollerProfile(Straight(motion, sense), sizes, sizes.r_0 * random.uniform(0.4, 0.97))
        if profile.undercuts:
            left_by_the_cutter(profile)


@dataclass
class Branches:
    """Two arcs that cross where one of them is at `a` and the other one at `b`, at a small angle."""

    a: float
    b: float

    def at(self, t: float, side: int) -> tuple[complex, complex]:
        off = t - (self.a if side < 0 else self.b)
        return 3.0 + 2.0j + off + side * 0.05j * off + 0.02j * off * off, 0j


@pytest.mark.parametrize(("a", "b"), [(0.31, 4.77), (0.83, 4.12), (0.05, 4.5)])
def test_branches_that_cross_at_a_small_angle_are_begun_with_near_their_crossing(a: float, b: float) -> None:
    ((near_a, near_b),) = _chords(Branches(a, b), (0.0, 1.0), (4.0, 5.0))

    assert (near_a, near_b) == (pytest.approx(a, abs=0.05), pytest.approx(b, abs=0.05))


def test_roller_just_smaller_than_the_least_radius_undercuts_nothing() -> None:
    motion = madi_motion()
    cam = Straight(motion), _smallest_roller(wedge(motion, MADI_LIMITS))
    rho = RollerProfile(*cam, 0.0).rho_min

    below, above = (RollerProfile(*cam, rho * part) for part in (1.0 - 1e-9, 1.0 + 1e-3))

    assert below.undercuts == []
    assert [math.degrees(cut.start) for cut in above.undercuts] == pytest.approx([36.0], abs=0.1)
    assert 0.0 < above.undercuts[0].lost < 1e-6


@pytest.mark.parametrize("rise", some([2.0, 0.3, 0.9, 1.3], 0, 3))  # places of angles are rounded, those of 2 are not
def test_velocity_that_drops_undercuts_at_any_radius_and_has_a_point_on_either_side(rise: float) -> None:
    motion = Motion(0.01, rise, 0.5, 2.0, law_of_motion("uniform"))

    profile = RollerProfile(Straight(motion), Sizes(0.05, 0.0, 0.05), 1e-3)

    assert profile.rho_min == 0.0
    assert all(any(cut.start < phi < cut.end for cut in profile.undercuts) for phi in (rise, rise + 0.5))
    for drop in motion.drops:
        before, after = (profile.at(float(profile.places(drop, side)), side)[0] for side in (-1, 1))
        assert before == pytest.approx(complex(profile.practical(drop, -1)), abs=1e-12)
        assert after == pytest.approx(complex(profile.practical(drop, 1)), abs=1e-12)
        assert abs(after - before) > 1e-5


@pytest.mark.parametrize(("r_0", "sense"), some([(0.028, 1), (0.022, -1), (0.014, 1)], 0))
def test_plate_that_is_too_low_cuts_its_own_profile(r_0: float, sense: int) -> None:
    profile = PlateProfile(madi_motion(), r_0, sense)
    reach, cam = 0.2, Polygon([(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)])
    for phi in np.linspace(0.0, TURN, 480, endpoint=False):
        height = r_0 + float(profile.motion.at(phi)[0])
        below = Polygon([(-reach, -reach), (reach, -reach), (reach, height), (-reach, height)])
        cam = cam.intersection(rotate(below, -sense * phi, origin=(0.0, 0.0), use_radians=True))
    ring = np.array(cam.exterior.coords) @ np.array([1.0, 1.0j])

    cuts = profile.undercuts

    assert len(cuts) == 2
    assert profile.rho_min < 0.0
    for cut in cuts:
        lost = float(profile.motion.at(cut.phi_lost)[0] - np.nanmax(profile.seat(ring, cut.phi_lost)))
        assert cut.lost == pytest.approx(lost, abs=2e-3 * MM)
        assert cut.lost > 0.0
    points = profile.outline()
    assert Polygon(np.column_stack((points.real, points.imag))).area == pytest.approx(cam.area, rel=1e-4)


@pytest.mark.parametrize("count", [pytest.param(5, id="5"), pytest.param(40, id="40", marks=pytest.mark.soak)])
def test_cams_are_undercut_exactly_when_a_radius_is_too_small(count: int) -> None:
    random = np.random.default_rng(SEED + 13)

    for k in range(count):
        motion, limits, sense = random_motion(random), random_limits(random), int(random.choice((-1, 1)))
        if k % 3:
            sizes = _smallest_roller(wedge(motion, limits, sense))
            rho = RollerProfile(Straight(motion, sense), sizes, 0.0).rho_min
            R = min(max(rho, 0.1 * sizes.r_0) * math.exp(random.uniform(-0.3, 0.7)), 0.97 * sizes.r_0)
            profile: RollerProfile | PlateProfile = RollerProfile(Straight(motion, sense), sizes, R)
            expected = rho < R
        else:
            motion = random_motion(random, SMOOTH)
            profile = PlateProfile(motion, (r_0 := _smallest_plate(motion, 0.0, 0.0).r_0_min) * 0.8 + 1e-3, sense)
            expected = r_0 * 0.8 + 1e-3 < r_0
        cuts, points = profile.undercuts, profile.outline()
        assert bool(cuts) == expected
        assert Polygon(np.column_stack((points.real, points.imag))).is_valid
        for cut in cuts:
            assert cut.lost > 0.0
            for end in (cut.start, cut.end):
                assert off_the_envelope(profile, cut, end) < 1e-12
