"""Profiles of teeth: involutes, the fillets of a rack's corner, undercut and pointed teeth; areas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.gears.geometry import geometry
from kulman.plans.gears.teeth import RIGHT_ANGLE, Tooth, tooth_of
from kulman.tests.support.gear_polygons import cut_by_rack, polygon, sector_of, wheel_of
from kulman.tests.support.gears import SEED, madi

STEEP = {"alpha": math.radians(26.0)}  # the rack's tip is round
CASES = [
    pytest.param({}, "plain", id="the project's pinion"),
    pytest.param({"z_1": 9.0, "x_1": 0.0}, "undercut", id="undercut"),
    pytest.param({"z_1": 8.0, "x_1": 1.2, "x_2": 0.2}, "pointed", id="pointed"),
    pytest.param({"z_1": 40.0, "x_1": -0.3, **STEEP}, "plain", id="round tip of the rack"),
    pytest.param({"z_1": 30.0, "x_1": 1.45, "x_2": 0.0}, "plain", id="root outside the pitch line"),
]
CUT = [pytest.param(*case.values, id=case.id, marks=pytest.mark.soak if k < 1 else ()) for k, case in enumerate(CASES)]


def kind(tooth: Tooth) -> str:
    return "undercut" if tooth.undercut else "pointed" if tooth.pointed else "plain"


@pytest.mark.parametrize(("others", "what"), CUT)
def test_tooth_has_the_area_that_a_rack_leaves_cutting_in_many_steps(others: dict[str, float], what: str) -> None:
    values = madi(**others)
    tooth = tooth_of(values, 1)
    assert kind(tooth) == what

    area = cut_by_rack(values, tooth, values["x_1"], 3e-3)

    assert sector_of(tooth) == pytest.approx(area, abs=1e-3)


@pytest.mark.soak
def test_teeth_of_many_racks_have_the_area_that_is_left() -> None:
    random = np.random.default_rng(SEED)
    for what, teeth, shifts in (
        ("plain", (12, 60), (0.35, 0.5)),
        ("undercut", (6, 14), (-0.2, 0.1)),
        ("pointed", (6, 9), (0.9, 1.1)),
    ):
        for _ in range(8):
            z, x = float(random.integers(*teeth)), random.uniform(*shifts)
            values = madi(z_1=z, x_1=x, x_2=-0.1, alpha=math.radians(random.uniform(18.0, 22.0)))
            tooth = tooth_of(values, 1)
            assert (kind(tooth), tooth.whole) == (what, True)
            assert sector_of(tooth) == pytest.approx(cut_by_rack(values, tooth, x, 2e-3), abs=1e-3), (z, x)


@pytest.mark.parametrize(("others", "what"), CASES)
def test_outline_is_one_curve_without_gaps_or_loops(others: dict[str, float], what: str) -> None:
    tooth = tooth_of(madi(**others), 1)

    half, whole = tooth.half(200), polygon(wheel_of(tooth, 200))

    assert whole.is_valid
    assert np.max(np.abs(np.diff(half))) < 0.03 * tooth.r
    assert abs(complex(tooth.fillet(tooth.beta_start)) - complex(tooth.flank(tooth.rho_start))) < 1e-12 * tooth.r
    assert half[0] == pytest.approx(tooth.tip)
    assert np.angle(half[-1]) == pytest.approx(math.pi / tooth.z)
    assert abs(half[-1]) == pytest.approx(tooth.r_f)
    assert np.all(np.diff(np.abs(half)) < 1e-12)  # from the tip inwards all the way
    assert what != "pointed" or abs(complex(tooth.flank(tooth.rho_end)).imag) < 1e-12 * tooth.r


def normal(tooth: Tooth, rho: float | np.ndarray) -> np.ndarray:
    """Return unit normals of the upper involute, out of the tooth: each lies on a tangent of the base circle."""
    return 1j * np.exp(1j * (tooth.psi_b - np.asarray(rho) / tooth.r_b))


@pytest.mark.parametrize(("others", "what"), CASES)
def test_normals_of_the_flank_touch_the_base_circle(others: dict[str, float], what: str) -> None:
    tooth = tooth_of(madi(**others), 1)
    rho = np.linspace(tooth.rho_start, tooth.rho_end, 50)

    points, normals = tooth.flank(rho), normal(tooth, rho)

    along = points - rho * normals  # the end of the radius of curvature
    assert np.max(np.abs(np.abs(along) - tooth.r_b)) < 1e-12 * tooth.r
    assert np.max(np.abs((along * normals.conj()).real)) < 1e-12 * tooth.r
    middles = 0.5 * (rho[1:] + rho[:-1])
    chords = np.diff(points)
    slope = (chords * normal(tooth, middles).conj()).real / np.abs(chords)
    assert np.max(np.abs(slope)) < 1e-3  # and they are normals: of chords beside them


@pytest.mark.parametrize(("others", "what"), CASES)
def test_fillet_leaves_flank_and_root_without_a_kink_unless_undercut(others: dict[str, float], what: str) -> None:
    tooth = tooth_of(madi(**others), 1)
    step = 1e-6

    start = np.diff(tooth.fillet(np.array([tooth.beta_start, tooth.beta_start + step])))[0]
    across = complex(normal(tooth, tooth.rho_start))
    end = np.diff(tooth.fillet(np.array([RIGHT_ANGLE - step, RIGHT_ANGLE])))[0]
    foot = complex(tooth.fillet(RIGHT_ANGLE))

    kink = abs((start * across.conjugate()).real) / abs(start)
    assert (kink > 1e-2) == (what == "undercut")
    assert kink < 1e-4 or what == "undercut"
    assert abs((end * foot.conjugate()).real) / abs(end * foot) < 1e-4
    assert abs(foot) == pytest.approx(tooth.r_f, rel=1e-14)


def test_thickness_on_the_reference_circle_is_that_of_the_formula() -> None:
    values = madi()
    found = geometry(values)

    for i in (1, 2):
        tooth = tooth_of(values, i)
        assert 2.0 * tooth.r * float(tooth.half_angle(tooth.r)) == pytest.approx(found[f"s_{i}"], rel=1e-14)
        assert 2.0 * tooth.r_a * float(tooth.half_angle(tooth.r_a)) == pytest.approx(found[f"s_a{i}"], rel=1e-13)
        assert tooth.rho_start == pytest.approx(found[f"rho_l{i}"], rel=1e-12)


def test_teeth_follow_each_other_by_the_angular_pitch() -> None:
    tooth = tooth_of(madi(), 1)

    three, one = tooth.teeth(3), tooth.outline()

    assert len(three) == 3 * (len(one) - 1) + 1
    turned = one * np.exp(2j * math.pi / 15.0)
    assert np.max(np.abs(three[len(one) - 1 : 2 * len(one) - 2] - turned[:-1])) < 1e-15
    assert abs(three[-1]) == pytest.approx(tooth.r_f)


def test_undercut_begins_at_the_least_shift() -> None:
    least = geometry(madi(z_1=12.0))["x_min1"]

    for beside, undercut in ((1e-9, False), (-1e-9, True)):
        assert tooth_of(madi(z_1=12.0, x_1=least + beside), 1).undercut == undercut


def test_tooth_is_pointed_where_its_tip_has_no_thickness() -> None:
    for x in np.linspace(0.3, 1.1, 9):
        values = madi(z_1=12.0, x_1=float(x), x_2=0.0)
        assert tooth_of(values, 1).pointed == (geometry(values)["s_a1"] < 0.0)


@pytest.mark.parametrize("count", [pytest.param(60, id="60"), pytest.param(150, id="150", marks=pytest.mark.soak)])
def test_outlines_of_all_racks_and_shifts_are_valid(count: int) -> None:
    random = np.random.default_rng(SEED)
    seen = {"plain": 0, "undercut": 0, "pointed": 0, "round": 0}
    for _ in range(count):
        h_a = random.uniform(0.6, 1.1)
        values = madi(
            z_1=float(random.integers(3, 30)),
            x_1=random.uniform(-0.8, 1.6),
            alpha=math.radians(random.uniform(10.0, 32.0)),
            h_a=h_a,
            h_l=2.0 * h_a * random.uniform(0.9, 1.02),
            c=random.uniform(0.1, 0.2),
        )
        tooth = tooth_of(values, 1)
        if (h_a + values["c"]) * math.tan(values["alpha"]) < 0.25 * math.pi and tooth.whole:
            seen[kind(tooth)] += 1
            seen["round"] += tooth.e_f == 0.0
            assert polygon(wheel_of(tooth, 24)).is_valid

    assert min(seen.values()) > count // 30
