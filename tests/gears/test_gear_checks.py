"""Verdicts on a pair: each against what the teeth themselves show when they are cut and rolled."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.gears.gear import HARDENED, GearPair
from kulman.plans.gears.geometry import geometry
from kulman.plans.gears.solve import SAME_CENTRES, checks, complete, judged
from kulman.plans.gears.teeth import meshing_of, tooth_of
from kulman.plans.solved import Check
from kulman.tests.support.gear_polygons import polygon
from kulman.tests.support.gears import SEED, madi, outlines


def verdicts(values: dict[str, float], pair: GearPair | None = None) -> dict[str, Check]:
    return {check.name: check for check in checks(pair or GearPair(), geometry(values))}


def test_pair_of_the_project_passes_all_checks() -> None:
    found = verdicts(madi())

    assert all(check.ok for check in found.values())
    assert list(found) == [
        *(f"centre_{name}" for name in SAME_CENTRES),
        *("undercut_1", "undercut_2", "interference_1", "interference_2", "contact_ratio", "tip_1", "tip_2"),
    ]
    check = found["interference_1"]
    assert (check.quantity, check.of, check.relation) == ("rho_l1", "rho_p1", "at-most")
    assert check.value == pytest.approx(1.1305e-3, abs=1e-7)
    assert check.limit == pytest.approx(6.4192e-3, abs=1e-7)


@pytest.mark.parametrize(
    ("others", "failing"),
    [
        pytest.param({"x_1": 0.12}, {"undercut_1"}, id="undercut pinion"),
        pytest.param({"z_1": 30.0, "z_2": 12.0, "x_1": 0.8, "x_2": 0.1}, {"undercut_2"}, id="undercut wheel"),
        pytest.param({"x_1": 0.5, "x_2": 1.0}, {"contact_ratio"}, id="contact ratio"),
        pytest.param({"z_1": 12.0, "x_1": 0.8, "x_2": -0.1}, {"tip_1"}, id="thin tip"),
        pytest.param({"z_1": 25.0, "z_2": 90.0, "x_1": -0.1, "x_2": -0.6}, {"interference_1"}, id="interference"),
    ],
)
def test_each_fault_is_told_by_its_own_check(others: dict[str, float], failing: set[str]) -> None:
    found = verdicts(madi(**others))

    assert {name for name, check in found.items() if not check.ok} == failing


def test_hardened_teeth_have_to_be_thicker_at_the_tip() -> None:
    values = madi(z_1=12.0, x_1=0.6, x_2=0.2)
    thickness = geometry(values)["s_a1"] / values["m"]
    assert 0.3 < thickness < 0.4

    assert verdicts(values)["tip_1"].ok
    hard = verdicts(values, GearPair(material=HARDENED))["tip_1"]
    assert not hard.ok
    assert hard.limit == pytest.approx(0.4 * values["m"])


@pytest.mark.parametrize(
    ("z_1", "z_2", "x_1", "x_2", "roots"),
    [
        pytest.param(20.0, 40.0, 0.2, 0.0, set(), id="neither", marks=pytest.mark.soak),
        pytest.param(15.0, 20.0, 0.2, 0.85, set(), id="the project's pair"),
        pytest.param(20.0, 40.0, 0.3, -1.0, {1}, id="root of the pinion", marks=pytest.mark.soak),
        pytest.param(25.0, 90.0, -0.1, -0.6, {1}, id="pinion and large wheel", marks=pytest.mark.soak),
        pytest.param(20.0, 40.0, 0.0, 1.65, {2}, id="root of the wheel"),
        pytest.param(30.0, 30.0, -0.6, -0.6, {1, 2}, id="both"),
    ],
)
def test_interference_is_where_wheels_overlap_when_they_roll(
    z_1: float, z_2: float, x_1: float, x_2: float, roots: set[int]
) -> None:
    values = complete(madi(z_1=z_1, z_2=z_2, x_1=x_1, x_2=x_2))
    meshing = meshing_of(values)
    angles = np.linspace(-math.pi / z_1, math.pi / z_1, 16, endpoint=False)
    pairs = (outlines(meshing, float(angle), 100, math.radians(0.3)) for angle in angles)

    worst = max(polygon(first).intersection(polygon(second)).area for first, second in pairs)

    own = verdicts(values)
    assert {i for i in (1, 2) if not own[f"interference_{i}"].ok} == roots
    assert (worst > 1e-4) == bool(roots)


@pytest.mark.parametrize("count", [pytest.param(20, id="20"), pytest.param(60, id="60", marks=pytest.mark.soak)])
def test_undercut_and_thickness_are_those_of_the_teeth(count: int) -> None:
    random = np.random.default_rng(SEED)
    for _ in range(count):
        values = madi(z_1=float(random.integers(8, 30)), x_1=random.uniform(-0.3, 0.9), x_2=0.3)
        own, tooth = verdicts(values), tooth_of(values, 1)

        assert own["undercut_1"].ok != tooth.undercut
        thickness = 2.0 * tooth.r_a * float(tooth.half_angle(tooth.r_a))
        assert own["tip_1"].ok == (thickness >= 0.3 * values["m"])


def test_value_on_its_limit_is_in_order_and_what_is_undefined_is_not() -> None:
    least = geometry(madi())["x_min1"]

    assert verdicts(madi(x_1=least))["undercut_1"].ok
    assert not judged("tip_1", "s_a1", {"s_a1": math.nan}, 1e-3, "at-least").ok
    assert not judged("interference_1", "rho_l1", {"rho_l1": math.nan}, 1e-3, "at-most").ok
    assert not judged("centre_a_w_shift", "a_w_shift", {"a_w_shift": 92e-3, "a_w": 92.1e-3}, "a_w", "equal").ok
