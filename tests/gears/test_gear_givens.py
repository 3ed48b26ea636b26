"""Shifts that follow from a given centre distance or from equal sliding, and data of which no pair can be made."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.gears.gear import CW, HARDENED, STANDARD, GearPair
from kulman.plans.gears.geometry import geometry
from kulman.plans.gears.solve import complete
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.gears import SEED, madi, random_pairs

BASIC = {"m": 5e-3, "z_1": 15.0, "z_2": 20.0}


def test_standard_rack_is_taken_where_no_other_is_given() -> None:
    found = complete({**BASIC, "x_1": 0.2, "x_2": 0.85})

    assert found == madi()
    assert complete({**BASIC, "x_1": 0.2, "x_2": 0.85, "c": 0.3})["c"] == 0.3


@pytest.mark.parametrize("count", [pytest.param(4, id="4"), pytest.param(40, id="40", marks=pytest.mark.soak)])
def test_shifts_follow_from_the_centre_distance(count: int) -> None:
    pairs = random_pairs(np.random.default_rng(SEED), count)
    a_w, x_sum = geometry(pairs)["a_w"], pairs["x_1"] + pairs["x_2"]
    for k in range(count):
        values = {name: float(column[k]) for name, column in pairs.items()}
        rest = {name: value for name, value in values.items() if name not in ("x_1", "x_2")}
        for given in ({"a_w": float(a_w[k])}, {"x_sum": float(x_sum[k])}):
            for kept, other in (("x_1", "x_2"), ("x_2", "x_1")):
                found = complete({**rest, **given, kept: values[kept]})
                assert found[other] == pytest.approx(values[other], abs=1e-11)
                assert "a_w" not in found


@pytest.mark.parametrize("count", [pytest.param(5, id="5"), pytest.param(30, id="30", marks=pytest.mark.soak)])
def test_shifts_for_equal_sliding_give_the_same_sliding_at_both_roots_and_no_less_is_had(count: int) -> None:
    random = np.random.default_rng(SEED)
    for _ in range(count):
        z_1, z_2 = (float(z) for z in random.integers(14, 70, 2))
        values = {"m": 3e-3, "z_1": z_1, "z_2": z_2, "x_sum": random.uniform(0.0, 1.0)}

        found = complete(values)

        at = geometry(found)
        assert at["theta_12_A1"] == pytest.approx(at["theta_21_A2"], rel=1e-9)
        assert at["rho_p1"] > 0.0
        assert at["rho_p2"] > 0.0
        for aside in (-0.01, 0.01):  # of two shifts with this sum no others have a lesser greatest sliding
            worse = geometry({**found, "x_1": found["x_1"] + aside, "x_2": found["x_2"] - aside})
            assert min(worse["theta_12_A1"], worse["theta_21_A2"]) < at["theta_12_A1"]


def test_shifts_for_equal_sliding_from_a_centre_distance_keep_it() -> None:
    found = complete({**BASIC, "a_w": 92e-3})

    at = geometry(found)

    assert at["a_w"] == pytest.approx(92e-3, rel=1e-13)
    assert at["theta_12_A1"] == pytest.approx(at["theta_21_A2"], rel=1e-10)


BAD = [
    pytest.param({"z_1": 2.0}, "gear-teeth", id="two teeth"),
    pytest.param({"z_2": 20.5}, "gear-teeth", id="half a tooth"),
    pytest.param({"z_2": math.nan}, "gear-teeth", id="no number of teeth"),
    pytest.param({"m": 0.0}, "gear-module", id="no module"),
    pytest.param({"m": -1e-3}, "gear-module", id="negative module"),
    pytest.param({"m": math.inf}, "gear-module", id="infinite module"),
    pytest.param({"alpha": math.radians(9.9)}, "gear-alpha", id="flat rack"),
    pytest.param({"alpha": math.radians(35.1)}, "gear-alpha", id="steep rack"),
    pytest.param({"alpha": math.radians(35.0)}, "gear-rack", id="rack without a tip"),
    pytest.param({"h_a": 0.0}, "gear-rack", id="rack without height"),
    pytest.param({"h_l": 2.3}, "gear-rack", id="edge longer than the tooth"),
    pytest.param({"h_l": 0.9}, "gear-rack", id="edge that does not pass the pitch line"),
    pytest.param({"c": -0.1}, "gear-rack", id="no clearance"),
    pytest.param({"x_1": -1.3}, "gear-no-tooth", id="tooth cut away"),
    pytest.param({"x_1": 3.0}, "gear-no-tooth", id="pointed below its flank"),
    pytest.param({"z_1": 6.0, "x_1": -0.9}, "gear-no-tooth", id="cut through"),
    pytest.param({"x_1": -0.5, "x_2": -0.4}, "gear-no-mesh", id="centres too near"),
    pytest.param({"x_1": math.nan}, "gear-shifts", id="no shift"),
    pytest.param(
        {"z_1": 22.0, "z_2": 39.0, "h_a": 0.3, "h_l": 0.6, "x_1": 1.3, "x_2": -1.1}, "gear-no-contact", id="tips apart"
    ),
]


@pytest.mark.parametrize(("others", "key"), BAD)
def test_bad_data_are_explained(others: dict[str, float], key: str) -> None:
    with pytest.raises(InputError) as caught:
        complete(madi(**others))

    assert caught.value.key == key
    for language in LANGUAGES:
        assert "{" not in caught.value.text(language)


@pytest.mark.parametrize(
    ("given", "key"),
    [
        pytest.param({}, "gear-shifts", id="nothing about shifts"),
        pytest.param({"x_1": 0.2}, "gear-shifts", id="one shift"),
        pytest.param({"x_1": 0.2, "x_2": 0.1, "a_w": 90e-3}, "gear-shifts", id="too much"),
        pytest.param({"x_sum": 0.2, "a_w": 90e-3}, "gear-shifts", id="the same twice"),
        pytest.param({"a_w": 82e-3}, "gear-centre", id="base circles overlap"),
        pytest.param({"x_sum": -0.9}, "gear-no-mesh", id="sum too small"),
        pytest.param({"a_w": 110e-3, "x_1": 0.2}, "gear-no-tooth-found", id="far apart"),
        pytest.param({"z_1": 8.0, "z_2": 8.0, "x_sum": -0.05}, "gear-no-balance", id="interference in any case"),
    ],
)
def test_givens_from_which_no_shifts_follow_are_explained(given: dict[str, float], key: str) -> None:
    with pytest.raises(InputError) as caught:
        complete({**BASIC, **given})

    assert caught.value.key == key
    assert "{" not in caught.value.text("uk")


def test_limit_that_an_error_names_is_the_limit() -> None:
    least = 87.5e-3 * math.cos(STANDARD["alpha"])
    with pytest.raises(InputError) as caught:
        complete({**BASIC, "a_w": least * 0.999, "x_1": 0.2})
    assert caught.value.data["least"] == f"{least * 1e3:.7g}"

    with pytest.raises(InputError) as caught:
        complete({**BASIC, "x_1": 0.0, "x_2": -2.0})
    x_sum = float(caught.value.data["least"])

    assert geometry(madi(x_1=0.0, x_2=x_sum + 1e-4), ("alpha_w",))["alpha_w"] > 0.0
    assert not geometry(madi(x_1=0.0, x_2=x_sum - 1e-4), ("alpha_w",))["alpha_w"] >= 0.0


def test_words_of_a_variant_take_the_place_of_the_names_of_choices() -> None:
    pair = GearPair(rotation="sense", material="heat").chosen({"sense": CW, "heat": HARDENED})

    assert pair == GearPair(CW, HARDENED)
    assert (pair.sense, pair.least_tip) == (-1, 0.4)
    assert (GearPair().sense, GearPair().least_tip) == (1, 0.3)
