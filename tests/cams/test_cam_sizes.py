"""The smallest cams against brute force, permitted offsets, flat followers, rockers; the printed sizes of a project.

Of the project's cam the figure with the law is lost. Of all laws the sawtooth with u = 1/3 and a fall mirrored in time
comes nearest to the printed s'_max, r_0 and e; what remains is the accuracy of a drawing. Two printed numbers are not
of this kind.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman import note, sweep
from kulman.drawing.notes.blocks import Steps
from kulman.plans.cams.cam import ORDERS, Cam
from kulman.plans.cams.followers import Limits, PlateProfile, Rocker, RollerProfile, Sizes, Straight, turned_back
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import Motion, motion_of
from kulman.plans.cams.sizes import (
    _smallest_plate,
    _smallest_rocker,
    _smallest_rocker_at,
    _smallest_roller,
    apex,
    central,
    offsets,
    wedge,
)
from kulman.plans.cams.solve import solve_cam
from kulman.scales.errors import InputError
from kulman.tests.support.cam_points import CamCase, c8_plate
from kulman.tests.support.cams import (
    MADI,
    MADI_LIMITS,
    SEED,
    SMOOTH,
    asked,
    dense,
    keyed_cam,
    madi_motion,
    random_limits,
    random_motion,
)
from kulman.tests.support.printed_numbers import lines_of
from kulman.variants.kinds.cam import KIND

COUNTS = pytest.mark.parametrize(
    "count", [pytest.param(5, id="5"), pytest.param(100, id="100", marks=pytest.mark.soak)]
)
LEAST = pytest.mark.parametrize("count", [pytest.param(2, id="2"), pytest.param(40, id="40", marks=pytest.mark.soak)])
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
FEW = [pytest.param(2, id="2"), pytest.param(15, id="15", marks=pytest.mark.soak)]


class Positions:
    """What every one of many positions permits, each by itself: the least s_0 at an offset."""

    def __init__(self, motion: Motion, limits: Limits, sense: int, cells: int = 1500) -> None:
        self._rows = []
        for name, gamma, up in (("rise", limits.gamma_rise, 1), ("fall", limits.gamma_fall, -1)):
            _, s, ds, _ = dense(motion, name, cells)
            for way in (up, -up)[: 1 + limits.two_sided]:
                self._rows.append((way * sense, sense * ds, s, math.tan(0.5 * math.pi - gamma)))

    def s_0(self, e: float) -> float:
        """Return the least s_0: theta is limited to one side, way * (sense s' - e) <= tan * (s_0 + s)."""
        return float(max(np.max(way * (x - e) / tan - s) for way, x, s, tan in self._rows))

    def smallest(self, reach: float) -> float:
        """Return the least r_0 of all offsets: r_0(e) has one minimum, found by golden section to 1e-12 of `reach`."""
        low, high = -reach, reach
        inner = [(math.hypot(e, self.s_0(e)), e) for e in (high - GOLDEN * (high - low), low + GOLDEN * (high - low))]
        while high - low > 1e-12 * reach:
            (left, a), (right, b) = inner
            if left < right:
                high, e = b, b - GOLDEN * (b - low)
                inner = [(math.hypot(e, self.s_0(e)), e), inner[0]]
            else:
                low, e = a, a + GOLDEN * (high - a)
                inner = [inner[1], (math.hypot(e, self.s_0(e)), e)]
        return min(inner)[0]


@COUNTS
@pytest.mark.parametrize("sense", [1, -1])
def test_smallest_roller_cam_is_that_of_brute_force_and_just_reaches_the_limits_that_bind(
    count: int, sense: int
) -> None:
    random = np.random.default_rng([SEED, sense + 1])

    for _ in range(count):
        motion, limits = random_motion(random), random_limits(random)
        found = _smallest_roller(wedge(motion, limits, sense))
        brute = Positions(motion, limits, sense).smallest(3.0 * found.r_0)
        assert found.r_0 == pytest.approx(brute, rel=1e-6)
        assert found.r_0 == pytest.approx(math.hypot(found.e, found.s_0), rel=1e-14)
        for phase, gamma in (("rise", limits.gamma_rise), ("fall", limits.gamma_fall)):
            least = Straight(motion, sense).least_transmission(found, phase, limits.two_sided).value
            assert least >= gamma - 1e-12
            assert phase not in found.on or least == pytest.approx(gamma, abs=1e-12)


@pytest.mark.parametrize("count", [pytest.param(8, id="8"), pytest.param(30, id="30", marks=pytest.mark.soak)])
@pytest.mark.parametrize("two_sided", [False, True])
def test_least_transmission_angle_is_exact(two_sided: bool, count: int) -> None:
    random = np.random.default_rng(SEED + 4)

    for _ in range(count):
        motion, sense = random_motion(random), int(random.choice((-1, 1)))
        sizes = Sizes(0.05, e := random.uniform(-0.02, 0.02), math.sqrt(0.05**2 - e * e))
        for phase, up in (("rise", 1), ("fall", -1)):
            found = Straight(motion, sense).least_transmission(sizes, phase, two_sided)
            _, s, ds, _ = dense(motion, phase, 2000)
            theta = np.arctan2(sense * ds - sizes.e, sizes.s_0 + s)
            gamma = 0.5 * math.pi - (np.abs(theta) if two_sided else up * sense * theta)
            assert found.value == pytest.approx(float(np.min(gamma)), abs=1e-6)
            assert found.value <= np.min(gamma) + 1e-14


def test_apex_is_not_always_the_smallest_cam_and_one_that_turns_the_other_way_is_its_mirror_image() -> None:
    motion = Motion(0.03, 1.2, 0.2, 3.0, law_of_motion("sine"))
    limits = Limits(math.radians(60.0), math.radians(20.0))

    one, other = (_smallest_roller(wedge(motion, limits, sense)) for sense in (1, -1))

    corner = apex(wedge(motion, limits, 1))
    assert (one.on, corner.on) == (("rise",), ("rise", "fall"))
    assert one.r_0 < 0.99 * corner.r_0
    assert one.r_0 == pytest.approx(Positions(motion, limits, 1).smallest(0.2), rel=1e-6)
    assert one.e > 0.0  # towards the side to which the cam pushes in the rise
    assert (other.r_0, other.e, other.s_0, other.on) == (one.r_0, -one.e, one.s_0, one.on)


@COUNTS
def test_permitted_offsets_are_those_of_brute_force(count: int) -> None:
    random = np.random.default_rng(SEED + 5)

    for _ in range(count):
        motion, limits, sense = random_motion(random), random_limits(random), int(random.choice((-1, 1)))
        planes = wedge(motion, limits, sense)
        r_0 = _smallest_roller(planes).r_0 * random.uniform(1.0001, 1.8)
        found = offsets(planes, r_0)
        assert found is not None
        least, most = found
        positions = Positions(motion, limits, sense)
        inner = 1e-5 * (most - least)
        for e in np.linspace(least + inner, most - inner, 7):
            assert positions.s_0(e) <= math.sqrt(r_0 * r_0 - e * e) * (1.0 + 1e-9)
        for end, out in ((least, -1e-5), (most, 1e-5)):
            e = end + out * r_0
            assert abs(e) > r_0 or positions.s_0(e) > math.sqrt(r_0 * r_0 - e * e)


def test_offset_at_either_end_reaches_its_limit_and_too_small_a_cam_has_none() -> None:
    planes, r_0 = wedge(madi_motion(), MADI_LIMITS), 0.05

    found = offsets(planes, r_0)

    assert found is not None
    for e, phase, gamma in ((found[0], "rise", 75.0), (found[1], "fall", 60.0)):
        least = Straight(madi_motion()).least_transmission(Sizes(r_0, e, math.sqrt(r_0**2 - e * e)), phase).value
        assert math.degrees(least) == pytest.approx(gamma, abs=1e-11)
    for part in (0.999999, 0.40):  # both limits together, that of the rise alone
        assert offsets(planes, part * _smallest_roller(planes).r_0) is None


def test_least_r_0_permits_exactly_its_offset_and_a_central_follower_needs_the_least_s_0() -> None:
    random = np.random.default_rng(SEED + 6)

    for _ in range(20):
        motion, limits, sense = random_motion(random), random_limits(random), int(random.choice((-1, 1)))
        planes = wedge(motion, limits, sense)
        sizes, e = _smallest_roller(planes), random.uniform(-0.01, 0.01)
        assert offsets(planes, sizes.r_0) == pytest.approx((sizes.e, sizes.e), abs=1e-5 * sizes.r_0)
        assert central(planes, e).e == e
        assert central(planes, e).s_0 == pytest.approx(max(0.0, Positions(motion, limits, sense).s_0(e)), rel=1e-6)


@COUNTS
def test_flat_followers_cam_is_just_convex(count: int) -> None:
    random = np.random.default_rng(SEED + 8)

    for _ in range(count):
        motion = random_motion(random, SMOOTH)
        found = _smallest_plate(motion, 0.01, 0.005)
        samples = [dense(motion, phase.name, 1500) for phase in motion.phases if phase.pieces]
        assert found.r_0_min == pytest.approx(max(0.0, *(np.max(-s - d2s) for _, s, _, d2s in samples)), rel=1e-5)
        assert found.r_0 == found.r_0_min + 0.01
        assert found.R_plate == pytest.approx(max(np.max(np.abs(ds)) for _, _, ds, _ in samples) + 0.005, rel=1e-6)
        assert PlateProfile(motion, found.r_0).rho_min >= 0.01 - 1e-15


def test_geronimus_counts_both_limits_of_a_jump_and_no_plate_stands_a_velocity_that_drops() -> None:
    amplitude = 9.0 * 13e-3 / math.radians(108.0) ** 2

    assert madi_motion().maximum(-1.0, 0.0, -1.0).value == pytest.approx(amplitude - 13e-3 / 3.0, rel=1e-13)
    assert _smallest_plate(Motion(0.01, 1.0, 0.5, 2.0, law_of_motion("uniform")), 0.01, 0.005).r_0_min == math.inf


@pytest.mark.parametrize("count", FEW)
def test_smallest_rocker_cam_keeps_its_limits_and_no_smaller_one_does(count: int) -> None:
    random = np.random.default_rng(SEED + 9)

    for _ in range(count):
        sense = int(random.choice((-1, 1)))
        motion, limits = random_motion(random, SMOOTH, random.uniform(0.1, 0.7)), random_limits(random)
        rocker = Rocker(motion, random.uniform(0.05, 0.2), sense)
        found = _smallest_rocker(rocker, limits)
        if not isinstance(found, Sizes):
            places = rocker.l * (random.uniform(-5.0, 5.0, 800) + 1j * random.uniform(0.0, 8.0, 800))
            assert np.all(dense_slack(rocker, limits, places) < 0.0)
            continue
        slack = dense_slack(rocker, limits, np.array([complex(found.e, found.s_0)]))
        assert slack[0] >= -1e-11 * rocker.l
        around = found.r_0 * (1.0 - 1e-5) * np.exp(1j * np.linspace(0.0, math.pi, 400))
        nearer = complex(found.e, found.s_0) * (1.0 - 1e-5)
        assert np.all(dense_slack(rocker, limits, np.append(around, nearer)) < 0.0)


def dense_slack(rocker: Rocker, limits: Limits, places: np.ndarray) -> np.ndarray:
    """Return by how much every position keeps to its limit at the worst, for places of the cam's centre."""
    motion, least = rocker.motion, np.full(len(places), np.inf)
    for name, gamma, up in (("rise", limits.gamma_rise, 1), ("fall", limits.gamma_fall, -1)):
        _, psi, dpsi, _ = dense(motion, name, 700)
        along, centre = np.exp(1j * psi), (rocker.l - places)[:, np.newaxis]
        reach = rocker.l * along * (1.0 - rocker.sense * dpsi) - centre  # from the cam's centre to where normals meet
        lift, across = (reach / (1j * along)).real, -(reach / along).real
        for way in (up, -up)[: 1 + limits.two_sided]:
            room = lift - way * rocker.sense * across * math.tan(gamma)
            least = np.minimum(least, np.min(np.minimum(room * math.cos(gamma), lift), axis=1))
    return least


@pytest.mark.parametrize("sense", [1, -1])
def test_pressure_angle_is_that_between_normal_and_velocity(sense: int) -> None:
    random, sizes = np.random.default_rng(SEED + 10), Sizes(math.hypot(0.01, 0.05), 0.01, 0.05)
    phi = np.linspace(0.01, 6.2, 97)
    straight = RollerProfile(Straight(random_motion(random), sense), sizes, 0.01)
    rocker = Rocker(random_motion(random, SMOOTH, 0.5), 0.1, sense)
    rocking = RollerProfile(rocker, sizes, 0.01)
    for profile, moves in ((straight, 1j), (rocking, 1j * np.exp(1j * rocker.motion.at(phi)[0]))):
        normal = profile.normal(phi) / turned_back(phi, profile.sense)
        assert profile.pressure(phi) == pytest.approx(np.angle(normal / moves), abs=1e-13)
    for phase, up in ((rocker.motion.rise, 1), (rocker.motion.fall, -1)):
        inside, least = (phi > phase.start) & (phi < phase.end), rocker.least_transmission(sizes, phase.name)
        assert least.value <= np.min(0.5 * math.pi - up * sense * rocking.pressure(phi)[inside])
        assert float(rocking.pressure(least.phi)) * up * sense == pytest.approx(0.5 * math.pi - least.value, abs=1e-9)


def test_very_long_rocker_is_a_follower_on_a_line() -> None:
    scale, law = 1e-6, law_of_motion("sawtooth", 0.3)
    swing, line = (Motion(h, *np.radians((108.0, 15.0, 108.0)), law) for h in (13e-3 * scale, 13e-3))

    rocker = _smallest_rocker(Rocker(swing, 1.0 / scale), MADI_LIMITS)

    straight = _smallest_roller(wedge(line, MADI_LIMITS))
    assert (rocker.r_0, rocker.e, rocker.s_0) == pytest.approx((straight.r_0, straight.e, straight.s_0), rel=1e-5)


def test_rocker_at_a_given_distance_reaches_its_limit_and_tells_when_it_cannot() -> None:
    motion, law = Motion(math.radians(25.0), 1.9, 0.3, 1.9, law_of_motion("sine")), law_of_motion("sine")
    limits = Limits(math.radians(50.0), math.radians(45.0))

    for sense in (1, -1):
        rocker = Rocker(motion, 0.1, sense)
        best = _smallest_rocker(rocker, limits)
        assert isinstance(best, Sizes)
        same, wider = (_smallest_rocker_at(rocker, limits, part * best.l_OC) for part in (1.0, 1.2))
        assert isinstance(same, Sizes)
        assert isinstance(wider, Sizes)
        assert same.r_0 == pytest.approx(best.r_0, rel=1e-9)
        assert wider.r_0 > best.r_0
        assert dense_slack(rocker, limits, np.array([complex(wider.e, wider.s_0)]))[0] == pytest.approx(0.0, abs=1e-7)
        assert not isinstance(_smallest_rocker_at(rocker, limits, 0.05), Sizes)
    wide = Rocker(Motion(math.radians(35.0), 1.9, 0.3, 1.9, law), 0.1)
    assert _smallest_rocker(wide, Limits(math.radians(80.0), math.radians(75.0))) == ("rise", "fall")


PAPER = {"omega": 20.0, "mu_phi": math.radians(1.0), "l_A1": 0.1, "H_a": 0.03, "H_v": 0.03, "R_roller": 1e-4}


def random_task(random: np.random.Generator, follower: str) -> tuple[Cam, dict[str, float]]:
    """Return a cam with one follower and random laws, phases, limits and senses, and its numbers."""
    laws = random.choice(SMOOTH, 2)
    sides, order, sense = ("one-sided", "two-sided"), ("mirror", "same"), ("ccw", "cw")
    words = (str(random.choice(choices)) for choices in (order, sense, sides))
    rise, upper, fall, _ = random.dirichlet((6.0, 2.0, 6.0, 3.0)) * 2.0 * math.pi
    limits = dict(zip(("gamma_rise", "gamma_fall"), np.radians(random.uniform(25.0, 70.0, 2)).tolist(), strict=True))
    values = {**PAPER, **limits, "phi_rise": rise, "phi_upper": upper, "phi_fall": fall, "margin": 0.0}
    values |= {"h": random.uniform(5e-3, 60e-3), "rho_flat": random.uniform(0.0, 0.02)}
    values |= {"psi": random.uniform(0.1, 0.6), "l_rocker": random.uniform(0.05, 0.2), "u": random.uniform(0.2, 0.8)}
    return Cam((follower,), str(laws[0]), str(laws[1]), *words), values


def limits_in(cam: Cam, values: dict[str, float]) -> Limits:
    return Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)


def told(cam: Cam, values: dict[str, float], key: str) -> dict[str, float]:
    """Return the lengths, m, that an error or a warning of this key names; nothing where none is said."""
    try:
        said = KIND.warnings(solve_cam(cam, values, ("sizes",)))
    except InputError as error:
        said = (error,)
    return {name: float(text) * 1e-3 for error in said if error.key == key for name, text in error.data.items()}


def just_above(least: float, scanned: float) -> bool:
    """Whether a least length that is rounded up to six digits is the one that a scan finds."""
    return scanned * (1.0 - 1e-9) <= least <= scanned * (1.0 + 3e-5)


@LEAST
def test_too_small_a_cam_for_a_roller_names_the_least_r_0_of_all_offsets(count: int) -> None:
    random = np.random.default_rng(SEED + 20)

    for _ in range(count):
        cam, values = random_task(random, "roller")
        positions = Positions(motion_of(cam, values), limits_in(cam, values), cam.sense)
        ends, scanned = (-1.0, 1.0), math.inf
        for _ in range(9):  # a scan of e, then finer and finer ones about the best
            every = np.linspace(*ends, 41).tolist()
            scanned, e = min((math.hypot(e, positions.s_0(e)), e) for e in every)
            ends = (e - 2.0 * (every[1] - every[0]), e + 2.0 * (every[1] - every[0]))

        least = told(cam, {**values, "r_0": scanned * random.uniform(0.05, 0.999)}, "cam-no-offset")["least"]

        assert just_above(least, scanned * (1.0 - 2e-6))
        assert told(cam, {**values, "r_0": least}, "cam-no-offset") == {}
        e = 0.4 * scanned * random.uniform(-1.0, 1.0)
        least = told(cam, {**values, "e": e, "r_0": abs(e) * 1.001}, "cam-r-0-at-e")["least"]
        assert just_above(least, math.hypot(e, positions.s_0(e)) * (1.0 - 2e-6))
        assert told(cam, {**values, "e": e, "r_0": least}, "cam-r-0-at-e") == {}


def permitted_angles(rocker: Rocker, limits: Limits, l_OC: float, most: float) -> tuple[float, ...] | None:
    """Return the first and the last angle at the pivot that a scan permits, then finer scans about both; or None."""
    ends = [(0.0, most)] * 2
    for _ in range(5):
        for k, (low, high) in enumerate(ends):
            every = np.linspace(low, high, 41)
            fit = np.flatnonzero(dense_slack(rocker, limits, rocker.l - l_OC * np.exp(-1j * every)) >= 0.0)
            if not fit.size:
                return None
            at, step = every[fit[-k]], every[1] - every[0]
            ends[k] = max(at - step, 0.0), min(at + step, most)
    return tuple(sum(end) / 2.0 for end in ends)


@pytest.mark.parametrize("count", [1, pytest.param(8, marks=pytest.mark.soak)])
def test_a_given_r_0_beside_l_OC_of_a_rocker_is_held_against_all_that_is_permitted(count: int) -> None:
    random, checked = np.random.default_rng(SEED + 21), 0

    while checked < count:
        cam, values = random_task(random, "rocker")
        rocker, l = Rocker(motion_of(cam, {**values, "h": values["psi"]}), values["l_rocker"], cam.sense), "l_rocker"
        distance = values["l_OC"] = values[l] * random.uniform(0.8, 2.5)
        angles = permitted_angles(rocker, limits_in(cam, values), distance, math.pi - values["psi"])
        if angles is None:
            continue
        checked += 1
        first, last = (abs(values[l] - distance * np.exp(-1j * angle)) for angle in angles)

        small, large = (told(cam, {**values, "r_0": r_0}, "cam-r-0-at-l-OC") for r_0 in (0.99 * first, 1.01 * last))

        for named in (small, large or small):
            assert named["least"] == pytest.approx(first, rel=1e-5)
            assert named["most"] == pytest.approx(last, rel=1e-5)
            for end in ("least", "most"):
                assert told(cam, {**values, "r_0": named[end]}, "cam-r-0-at-l-OC") == {}


@LEAST
@pytest.mark.parametrize("name", ["r_0", "r_0_flat"])
def test_a_given_r_0_under_a_plate_is_held_against_the_least_that_a_scan_finds(name: str, count: int) -> None:
    random = np.random.default_rng(SEED + 22)

    for _ in range(count):
        cam, values = random_task(random, "plate")
        motion = motion_of(cam, values)
        every = [dense(motion, phase.name, 1500) for phase in motion.phases if phase.pieces]
        scanned = max(0.0, *(np.max(-s - d2s) for _, s, _, d2s in every)) + values["rho_flat"]

        least = told(cam, {**values, name: scanned * random.uniform(0.05, 0.99)}, "cam-plate-r-0")["least"]

        assert just_above(least, scanned * (1.0 - 1e-5))
        solved = solve_cam(cam, {**values, name: 2.0 * least})
        assert solved.plate is not None
        assert solved.quantities["r_0_flat"].value == 2.0 * least
        assert solved.quantities["rho_flat_min"].value == pytest.approx(solved.plate.profile.rho_min, rel=1e-12)
        for k, phi in enumerate(solved.angles.tolist()):
            reach = solved.point(f"plate_profile.B{k}") * np.exp(1j * cam.sense * phi)
            assert reach == pytest.approx(1j * (2.0 * least + float(motion.at(phi)[0])), abs=1e-14)


@pytest.mark.soak
def test_a_plate_cam_with_a_given_r_0_is_drawn_told_and_marked() -> None:
    given, drawn = {"r_0_flat": "50 mm"}, CamCase((("r_0_flat", "50 mm"),), "A2", "en", only="sizes,profile")
    of = keyed_cam((*given.items(),))

    steps = [block for block in note(MADI, set=given, lang="en").document.blocks if isinstance(block, Steps)]
    swept = sweep(MADI, set=given).table("en")

    assert any("given least radius" in text for block in steps for text in block.texts)
    assert ("r_0_flat" in asked(of), "rho_flat_min" in asked(of)) == (False, True)
    assert "least radius of curvature under the plate: 21.4039 mm at phi = 195" in swept
    assert [*c8_plate(drawn, drawn.sheet)] == []
    assert any(
        line.endswith(" = 10 mm") for line in lines_of(drawn.sheet["equations_plate"])
    )  # what it is held against


MM = 1e-3
DS_MAX, R_0, E = 20.8 * MM, 45.696 * MM, 7.728 * MM


def test_no_law_fits_the_printed_sizes_as_well_as_the_sawtooth() -> None:
    errors = {}
    for name in SMOOTH:
        for order in ORDERS:
            phases = np.radians((108.0, 15.0, 108.0))
            motion = Motion(13.0 * MM, *phases, law_of_motion(name, 1.0 / 3.0), order=order)
            sizes = _smallest_roller(wedge(motion, MADI_LIMITS))
            found = np.array((motion.ds_max.value / DS_MAX, sizes.r_0 / R_0, sizes.e / E))
            errors[name, order] = np.abs(found - 1.0)

    best, following = sorted(errors, key=lambda key: max(errors[key]))[:2]

    assert best == ("sawtooth", "mirror")
    assert np.all(errors[best] < (0.006, 0.01, 0.021))
    assert max(errors[following]) > 3.0 * max(errors[best])
    assert _smallest_roller(wedge(madi_motion(), MADI_LIMITS)).on == ("rise", "fall")


def test_printed_least_radius_is_not_that_of_the_sharpest_place_and_that_under_the_plate_an_amplitude() -> None:
    motion = madi_motion()
    sizes, plate = _smallest_roller(wedge(motion, MADI_LIMITS)), _smallest_plate(motion, 10.0 * MM, 5.0 * MM)

    sharpest = RollerProfile(Straight(motion), sizes, 7.0 * MM).sharpest

    assert sharpest.value == pytest.approx(29.24 * MM, rel=1e-3)  # printed 60 mm
    assert math.degrees(sharpest.phi) == pytest.approx(36.0)  # where the acceleration jumps
    upper = math.hypot(sizes.e, sizes.s_0 + motion.h)
    assert upper == pytest.approx(60.0 * MM, rel=0.04)  # the printed one is nearer to the radius of the upper dwell
    assert plate.r_0_min == pytest.approx(28.60 * MM, rel=1e-3)  # printed 55 mm, as many as A_2 has on paper
    assert plate.R_plate == pytest.approx(25.8 * MM, rel=0.005)


def test_printed_mistakes_are_of_the_size_that_the_document_tells() -> None:
    s, mu = float(madi_motion().at(math.radians(36.0))[0]) / MM, 0.613  # where the second amplitude begins

    assert s == pytest.approx(4.33, abs=0.005)
    assert 55.0 - s / mu == pytest.approx(47.9, abs=0.05)
    assert (55.0 - s / mu) * mu == pytest.approx(29.4, abs=0.05)
    assert math.hypot(7.728, math.sqrt(45.696**2 - 7.728**2) + 1e3 * madi_motion().h) == pytest.approx(58.6, abs=0.05)
