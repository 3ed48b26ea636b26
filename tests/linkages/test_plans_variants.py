"""The bundled table of variants: the guide's numbers, and quantities that the second solver confirms to the user."""

from __future__ import annotations

import math

import pytest
from mpmath import mpc, mpf

from kulman import load_task
from kulman.plans.linkages.solved import solve_linkage
from kulman.tests.linkages.test_plans_second_solver import size_of
from kulman.tests.support.mechanisms import NAU_VARIANTS, ROTATIONS, nau_cases, nau_values
from kulman.tests.support.second_solver import SecondSolver

TASK = load_task("nau-slider-crank")


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_bundled_variant_has_the_values_of_the_guide(variant: str, side: str, rotation: str) -> None:
    values = TASK.values(variant, {"side": side, "rotation": rotation})

    expected = nau_values(variant, side, rotation)

    assert {name: values[name] for name in expected} == pytest.approx(expected, rel=1e-15)


def test_bundled_task_has_the_variants_of_the_guide_and_its_example() -> None:
    assert list(TASK.variants) == list(NAU_VARIANTS)


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_quantities_of_a_bundled_variant_agree_with_the_second_solver(variant: str, side: str, rotation: str) -> None:
    values = TASK.values(variant, {"side": side, "rotation": rotation})

    solved = solve_linkage(TASK.mechanism, values)

    second = SecondSolver(TASK.mechanism, values)
    assert solved.status == "ok"
    for name, quantity in solved.quantities.items():
        expected = second.v[name] if name.startswith("l_") else second.quantities[name]
        close = max(abs(expected) * mpf("1e-11"), mpf("1e-12") * size_of(second, name))
        if quantity.kind == "scalar":
            assert abs(mpf(quantity.value) - expected) <= close, name
        else:
            assert abs(mpc(quantity.x, quantity.y) - expected) <= close, name
        if quantity.kind == "vector":
            assert quantity.value == pytest.approx(math.hypot(quantity.x or 0.0, quantity.y or 0.0), rel=1e-15)


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_balancing_moments_of_a_bundled_variant_agree(variant: str, side: str, rotation: str) -> None:
    solved = solve_linkage(TASK.mechanism, TASK.values(variant, {"side": side, "rotation": rotation}))

    plan, lever = solved.quantities["M_bal"].value, solved.quantities["M_bal_lever"].value

    assert plan == pytest.approx(lever, rel=1e-12)


@pytest.mark.parametrize("rotation", ROTATIONS)
@pytest.mark.parametrize("variant", ["0", "5"])
def test_sides_mirror_each_other_with_phi_taken_from_the_slider(variant: str, rotation: str) -> None:
    other = "ccw" if rotation == "cw" else "cw"
    values = TASK.values(variant, {"side": "left", "rotation": rotation})
    mirrored = {**TASK.values(variant, {"side": "right", "rotation": other}), "phi": math.pi - values["phi"]}

    left, right = (solve_linkage(TASK.mechanism, each) for each in (values, mirrored))

    for name, quantity in left.quantities.items():
        if quantity.kind == "vector" and "couple" not in name:
            assert right.values[name] == pytest.approx(-left.values[name].conjugate(), rel=1e-12, abs=1e-9), name
