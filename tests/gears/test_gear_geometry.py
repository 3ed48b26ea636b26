"""Every quantity of a pair against points of flanks, a line cut by circles, turned teeth: a route without formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.gears.gear import STANDARD
from kulman.plans.gears.geometry import (
    POINTS,
    angle_of_involute,
    geometry,
    geometry_program,
    involute,
    tangent_of_involute,
)
from kulman.plans.gears.solve import SAME_CENTRES
from kulman.tests.support.fifty_digits import mp
from kulman.tests.support.gears import SEED, Flank, madi, random_pairs, second_route

MEASURED = (
    "z_W1",
    "z_W2",
    "W_1",
    "W_2",
    "rho_f",
    "inv_alpha",
    "inv_alpha_w",
    *SAME_CENTRES,
)  # in tests of their own
LENGTHS = {"a", "d", "p", "P", "s", "e", "h", "rho", "l", "g", "y"}
NUMBERS = {"y", "delta_y"}


@pytest.fixture(
    scope="module", params=[pytest.param(60, id="60"), pytest.param(1000, id="1000", marks=pytest.mark.soak)]
)
def pairs(request: pytest.FixtureRequest) -> dict[str, np.ndarray]:
    return random_pairs(np.random.default_rng(SEED), request.param)


def test_every_quantity_is_found_by_a_second_route(pairs: dict[str, np.ndarray]) -> None:
    found, other = geometry(pairs), second_route(pairs)

    named = {name for name in geometry_program().names if not name.startswith("_")}
    assert named - set(MEASURED) == set(other) & named
    for name in sorted(set(other) & named):
        error = found[name] - other[name]
        if name.startswith("theta"):  # as large as the places are near to N: compared as slopes of a line
            slopes = np.arctan(found[name]) - np.arctan(other[name])
            error = (slopes + 0.5 * np.pi) % np.pi - 0.5 * np.pi
        elif name in LENGTHS or (name.partition("_")[0] in LENGTHS and name not in NUMBERS):
            error = error / (40.0 * pairs["m"])
        assert np.max(np.abs(error)) < 1e-10, name


def test_ends_of_the_line_have_infinite_sliding_and_the_pole_none(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    assert np.all(found["theta_12_01"] == -np.inf)
    assert np.all(found["theta_21_12"] == -np.inf)
    assert np.all(found["theta_21_01"] == 1.0)
    assert np.all(found["theta_12_12"] == 1.0)
    inside = (found["g_f"] > 0.0) & (found["g_a"] > 0.0)  # the pole is the sixth point
    assert np.all(found["theta_12_06"][inside] == 0.0)
    assert np.all(found["theta_21_06"][inside] == 0.0)
    y_1, y_2 = (np.array([found[f"y_{i}_{point}"] for point in POINTS]) for i in (1, 2))
    assert np.all(np.diff(y_1, axis=0) > 0.0)
    assert np.all(np.diff(y_2, axis=0) < 0.0)


def test_centre_distance_is_the_same_in_four_other_ways(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    for name in SAME_CENTRES:
        assert np.max(np.abs(found[name] / found["a_w"] - 1.0)) < 1e-14
    for i in (1, 2):  # and the depth of the teeth in two
        depth = 0.5 * (found[f"d_a{i}"] - found[f"d_f{i}"])
        assert np.max(np.abs(depth - found["h"]) / pairs["m"]) < 1e-12


def test_common_normal_is_the_distance_of_jaws_that_touch_two_flanks(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    for i in (1, 2):
        some = np.isfinite(found[f"W_{i}"])  # flanks may be too short for any number of teeth
        r, s = 0.5 * found[f"d_{i}"][some], found[f"s_{i}"][some]
        z, alpha, m = (pairs[name][some] for name in (f"z_{i}", "alpha", "m"))
        flank = Flank(r, alpha, s)
        turn = np.exp(1j * math.pi * (found[f"z_W{i}"][some] - 1.0) / z)  # of the last tooth from the middle of all

        def beside(t: np.ndarray, flank: Flank = flank, turn: np.ndarray = turn) -> np.ndarray:
            return (flank.point(t) * turn).imag

        at = flank.base + np.angle(turn)  # where the flank is upright
        assert np.max(np.abs(found[f"W_{i}"][some] - 2.0 * beside(at)) / m) < 1e-11
        assert np.all((beside(at) > beside(at - 1e-3)) & (beside(at) > beside(at + 1e-3)))
        radius = 2.0 * abs(flank.point(at))
        assert np.all((found[f"d_p{i}"][some] <= radius) & (radius <= found[f"d_a{i}"][some]))
        short = 2.0 * (found[f"rho_a{i}"] - found[f"rho_p{i}"]) < found["p_b"]
        assert np.all(some | short)


def test_teeth_for_the_common_normal_are_as_many_as_tables_say() -> None:
    z = np.arange(12.0, 100.0)
    pair = {**madi(x_1=0.0, x_2=0.0, z_2=1000.0), "z_1": z}

    found = geometry(pair)["z_W1"]

    assert np.all(np.abs(found - (z / 9.0 + 0.5)) <= 0.53)  # z * 20 / 180 + 0.5, rounded


def test_quantities_of_many_pairs_are_those_of_each(pairs: dict[str, np.ndarray]) -> None:
    found = geometry(pairs)

    for k in (0, 7, len(pairs["m"]) - 1):
        alone = geometry({name: float(values[k]) for name, values in pairs.items()})
        for name, value in alone.items():
            assert value == found[name][k], name


@pytest.mark.parametrize("alpha", [1e-8, 1e-4, 0.05, 0.3, 0.463, 0.4637, 0.7, 1.2, 1.57])
def test_involute_and_its_inverse_are_exact_to_the_last_digits(alpha: float) -> None:
    with mp.workdps(50):
        exact = mp.tan(mp.mpf(alpha)) - mp.mpf(alpha)
        value = float(involute(alpha))
        angle = mp.findroot(lambda a: mp.tan(a) - a - mp.mpf(value), mp.mpf(alpha))

        assert abs(float(value / exact) - 1.0) < 2e-15
        assert abs(float(mp.mpf(float(angle_of_involute(value))) / angle) - 1.0) < 1e-15


def test_inverse_of_the_involute_never_fails() -> None:
    inv = np.logspace(-300, 12, 20_001)

    t = tangent_of_involute(inv)

    back = np.where(t < 1e-3, t**3 / 3.0, t - np.arctan(t))
    assert np.max(np.abs(back / inv - 1.0)) < 1e-6  # the difference loses digits where it is small
    assert np.all(np.diff(t) > 0.0)
    assert tangent_of_involute(0.0) == 0.0
    assert np.isnan(tangent_of_involute(-1e-9))


def test_corner_of_the_standard_rack_is_the_printed_one() -> None:
    found = geometry(madi())

    assert found["rho_f"] / found["m"] == pytest.approx(0.38, abs=1e-4)  # GOST 13755-81 rounds 0.379951
    assert found["rho_f"] * (1.0 - math.sin(STANDARD["alpha"])) == pytest.approx(0.25 * found["m"], rel=1e-14)


def test_corner_of_a_narrow_rack_fills_its_tip() -> None:
    steep = madi(alpha=math.radians(26.0))

    found = geometry(steep)

    tip = 0.25 * math.pi - 1.25 * math.tan(steep["alpha"])  # half the tip without the corner, in modules
    rounded = tip / math.tan(0.5 * (0.5 * math.pi - steep["alpha"]))  # of the circle that touches flank and tip there
    assert found["rho_f"] / found["m"] == pytest.approx(rounded, rel=1e-13)
    assert found["rho_f"] / found["m"] < 0.25 / (1.0 - math.sin(steep["alpha"]))
