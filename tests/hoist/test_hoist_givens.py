"""Data of which there is no hoist: each refused with its name and what was expected."""

from __future__ import annotations

import math
from typing import Any

import pytest

from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.hoist import Hoist
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.hoists import VARIANTS

BAD = [
    pytest.param({"G_1": 0.0}, "hoist-positive", "G_1", id="no load"),
    pytest.param({"G_1": -5e4}, "hoist-positive", "G_1", id="negative load"),
    pytest.param({"G_1": "heavy"}, "hoist-number", "G_1", id="a word"),
    pytest.param({"G_2": -1.0}, "hoist-not-negative", "G_2", id="negative rope"),
    pytest.param({"L": 0.0}, "hoist-positive", "L", id="no rope"),
    pytest.param({"S": -1e-4}, "hoist-positive", "S", id="negative area"),
    pytest.param({"E_k": math.inf}, "hoist-number", "E_k", id="rigid rope"),
    pytest.param({"E_k": 0.0}, "hoist-positive", "E_k", id="rope without a modulus"),
    pytest.param({"sigma": 0.0}, "hoist-positive", "sigma", id="no permissible stress"),
    pytest.param({"K": 0.0}, "hoist-positive", "K", id="no safety"),
    pytest.param({"l_0": 0.0}, "hoist-positive", "l_0", id="no support beam"),
    pytest.param({"I_0": 0.0}, "hoist-positive", "I_0", id="support beam without a section"),
    pytest.param({"I_2": math.nan}, "hoist-number", "I_2", id="not a number"),
    pytest.param({"E_0": -2e11}, "hoist-positive", "E_0", id="negative modulus"),
    pytest.param({"E_2": math.inf}, "hoist-number", "E_2", id="infinite modulus"),
    pytest.param({"beta_0": 0.0}, "hoist-beta", "beta_0", id="load over a support"),
    pytest.param({"beta_2": 0.51}, "hoist-beta", "beta_2", id="counted from the farther end"),
    pytest.param({"beta_2": -0.2}, "hoist-beta", "beta_2", id="beside the bridge"),
    pytest.param({"V_0": -0.1}, "hoist-not-negative", "V_0", id="wound off"),
    pytest.param({"a": -0.1}, "hoist-not-negative", "a", id="braked"),
    pytest.param({"slack": -1e-3}, "hoist-not-negative", "slack", id="negative slack"),
    pytest.param({"g": 0.0}, "hoist-positive", "g", id="no gravity"),
    pytest.param({"V_0": 0.0, "a": 0.0}, "hoist-still", "", id="not wound up"),
    pytest.param({"I_0": 1e-320}, "hoist-range", "t_1", id="numbers too far apart"),
]


@pytest.mark.parametrize(("changes", "key", "name"), BAD)
def test_what_no_hoist_can_have_is_told(changes: dict[str, Any], key: str, name: str) -> None:
    with pytest.raises(InputError) as error:
        forces({**VARIANTS["V01"], **changes})

    assert error.value.key == key
    assert error.value.data.get("name", "") == name
    for language in LANGUAGES:
        assert "\n" not in error.value.text(language)


def test_a_number_that_is_missing_is_named() -> None:
    values = {name: value for name, value in VARIANTS["V01"].items() if name != "E_k"}

    with pytest.raises(InputError, match="E_k is missing"):
        forces(values)


def test_slack_and_gravity_may_be_left_out() -> None:
    values = {name: value for name, value in VARIANTS["V01"].items() if name not in ("slack", "g")}

    assert forces(values).found == forces(VARIANTS["V01"]).found


def test_words_of_a_variant_take_the_place_of_choices() -> None:
    assert Hoist(near_0="side").chosen({"side": "right"}) == Hoist(near_0="right")
