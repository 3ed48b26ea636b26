"""Conditions: exact derivatives of every quantity by every given, the largest vector beside them, the worst sine."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from kulman import solve
from kulman.plans.boards.exact import run
from kulman.plans.boards.precision import DIGITS, fifty_digits
from kulman.plans.condition import conditions, derivatives
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, conditions_of, signs, solve_linkage, varied
from kulman.plans.quantities import plans_of, references, results
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.fifty_digits import differences
from kulman.tests.support.mechanisms import SEED, general_slider_crank, nau_slider_crank, nau_values, one_of
from kulman.tests.support.mechanisms import random_slider_cranks as random_cranks
from kulman.variants.shelf import bundled

TASKS = ("nau-slider-crank", "madi-four-bar", "scheme-10-shaper-two-blocks", "scheme-11-slotter")
MORE = [task for task in bundled("mechanism") if task not in TASKS]


def worst_difference(program: Any, givens: Mapping[str, Any], names: tuple[str, ...]) -> tuple[float, str]:
    """Return the largest difference of both routes to a condition, relative to it, and where it is."""
    values = run(program, givens).values
    sizes, ours = references(program, values), derivatives(program, givens, names)
    theirs = differences(program, givens, names, [step.name for step in results(program)])
    worst = (0.0, "")
    for name, slopes in theirs.items():
        expected = sum(float(abs(slope)) for slope in slopes)
        total = float(np.abs(ours[name]).sum())
        gap = abs(total - expected) / max(expected, 1e-6 * sizes[name]) if sizes[name] else 0.0
        if not name.startswith("delta_"):  # two routes to one value do not differ, whatever is given
            worst = max(worst, (gap, name))
    return worst


@pytest.mark.parametrize("task", [*TASKS, *(pytest.param(task, marks=pytest.mark.soak) for task in MORE)])
def test_conditions_are_those_of_differences_with_fifty_digits(task: str) -> None:
    solved = solve(task).solved

    gap, name = worst_difference(solved.program, solved.givens, varied(solved))

    assert gap <= 1e-6, name


@pytest.mark.parametrize("count", [3, pytest.param(100, marks=pytest.mark.soak)])
def test_conditions_of_random_mechanisms_are_those_of_differences(count: int) -> None:
    mechanism, values = general_slider_crank(), random_cranks(SEED, count)
    _, program = construct(mechanism)
    for index in range(count):
        givens = board_givens(mechanism, one_of(values, index))
        names = tuple(name for name in givens if name not in signs(mechanism))

        gap, name = worst_difference(program, givens, names)

        assert gap <= 1e-6, (index, name)


@pytest.mark.parametrize("turn", [1e-1, 1e-2, 1e-3, 1e-4])
def test_conditions_hold_on_the_way_to_a_singular_position(turn: float) -> None:
    mechanism, values = near_the_end(turn)
    _, program = construct(mechanism)
    givens = board_givens(mechanism, values)

    gap, name = worst_difference(program, givens, tuple(n for n in givens if n not in signs(mechanism)))

    assert gap <= 1e-6, name


def near_the_end(angle: float) -> tuple[Mechanism, dict[str, float]]:
    """Return a slider-crank whose rod, shorter than the crank, stands at `angle` to the normal to the guide."""
    values = nau_values(l_OA=0.1, l_AB=0.08)
    values["phi"] = math.asin(0.08 * math.cos(angle) / 0.1)
    return nau_slider_crank(), values


def test_condition_grows_like_one_over_the_sine() -> None:
    sines, found = [], []
    for angle in (1e-2, 1e-3, 1e-4):
        solved = solve_linkage(*near_the_end(angle))
        condition = conditions_of(solved)["B"]
        sines.append(condition.sine)
        found.append(condition.value)

    assert sines == pytest.approx([math.sin(1e-2), math.sin(1e-3), math.sin(1e-4)], rel=1e-6)
    assert found[1] / found[0] == pytest.approx(10.0, rel=0.02)
    assert found[2] / found[1] == pytest.approx(10.0, rel=0.02)


def test_condition_of_a_velocity_proportional_to_speed_holds_the_part_of_the_speed() -> None:
    solved = solve("nau-slider-crank", "example").solved
    names = varied(solved)

    slopes = derivatives(solved.program, solved.givens, names)

    # v is of the first degree in n_1, a of the second, and by all lengths together v is of the first
    assert slopes["V_B"][names.index("n_1")] == pytest.approx(solved.values["V_B"], rel=1e-12)
    assert slopes["a_B"][names.index("n_1")] == pytest.approx(2.0 * solved.values["a_B"], rel=1e-12)
    lengths = [i for i, name in enumerate(names) if name.startswith("l_")]
    assert sum(slopes["V_B"][lengths]) == pytest.approx(solved.values["V_B"], rel=1e-12)


def test_signs_do_not_err() -> None:
    solved = solve("nau-slider-crank", "example").solved

    assert signs(solved.mechanism) & set(solved.givens) != set()
    assert signs(solved.mechanism).isdisjoint(varied(solved))


def test_worst_sine_behind_a_quantity_is_that_of_the_intersections_it_needs() -> None:
    solved = solve("scheme-07-two-stage-compressor").solved
    found = conditions_of(solved)

    assert found["V_A"].sine == 1.0
    assert found["V_C"].sine <= found["V_B"].sine < 1.0
    assert min(item.sine for item in found.values()) == pytest.approx(solved.worst_sine()[1], rel=1e-15)


def test_a_position_without_a_plan_has_no_conditions_behind_it() -> None:
    solved = solve_linkage(nau_slider_crank(), nau_values(l_OA=0.1, l_AB=0.05, phi=1.5))
    found = conditions_of(solved)

    assert solved.status == "no-assembly"
    assert found["V_B"].value is None
    assert found["V_B"].sine == 0.0
    assert found["V_A"].value is not None


def test_conditions_of_a_program_alone() -> None:
    solved = solve("nau-slider-crank", "example").solved
    found = conditions(solved.program, solved.givens, ("n_1",), solved.values, solved.sines)

    assert found["V_B"].value == pytest.approx(abs(solved.values["V_B"]) / abs(solved.values["V_A"]), rel=1e-12)


def test_solve_shows_conditions_when_asked() -> None:
    solution = solve("nau-slider-crank", "example", condition=True)
    item = solution.to_json()["quantities"]["V_B"]

    assert item["condition"] == pytest.approx(conditions_of(solution.solved)["V_B"].value)
    assert item["sine"] == pytest.approx(math.cos(math.asin(50 * math.sin(math.radians(60)) / 130)), rel=1e-12)
    assert "condition" not in solve("nau-slider-crank", "example").to_json()["quantities"]["V_B"]
    row = next(line for line in solution.table("en").splitlines() if line.startswith("V_B "))
    assert row.split()[-4:] == ["K", f"{item['condition']:.3g}", "sin", f"{item['sine']:.3g}"]


@pytest.mark.parametrize("task", bundled("mechanism"))
def test_every_quantity_of_every_task_has_a_condition_and_a_sine(task: str) -> None:
    quantities = solve(task, condition=True).to_json()["quantities"]

    for name, item in quantities.items():
        assert 0.0 < item["sine"] <= 1.0, name
        undefined = item.get("value", item.get("x")) is None
        nothing = abs(item.get("value") or 0.0) <= 1e-12 * largest_of(quantities, item["unit"])
        assert item["condition"] is not None or undefined or nothing, name
        assert item["condition"] is None or (item["condition"] >= 0.0 and not undefined), name
    assert json.loads(json.dumps(quantities, allow_nan=False)) == quantities


def largest_of(quantities: Mapping[str, Any], unit: str) -> float:
    return max(abs(item.get("value") or 0.0) for item in quantities.values() if item["unit"] == unit)


def test_json_of_the_command_line_carries_conditions() -> None:
    command = [sys.executable, "-m", "kulman", "solve", "nau-slider-crank", "--condition", "--json"]
    out = subprocess.run(command, capture_output=True, text=True, check=True).stdout

    quantities = json.loads(out)["quantities"]
    assert all({"condition", "sine"} <= item.keys() for item in quantities.values())
    assert 1.0 < quantities["V_B"]["condition"] < 20.0


ERR = mpf(10) ** -13  # part by which data err, more than a right angle is rounded by
EPS = 2.0**-52
KINDS: list[tuple[str, tuple[int, int], tuple[bool, ...]]] = [
    ("RRR", (2, 3), ()),
    ("RRP", (2, 1), (True,)),
    ("RPR", (2, 3), (False,)),
    ("PRP", (2, 3), (False, True)),
    ("RPP", (2, 3), (False, False)),
]


def exceeding(solved: SolvedLinkage, random: np.random.Generator) -> dict[str, tuple[float, float]]:
    """Return what loses more than K says, by its name: in parts of it by data that err, and by rounding.

    Of what a plan shows K refers to the largest vector there, of all else to its own magnitude.
    """
    program, givens = solved.program, solved.givens
    err = {name: ERR * int(random.choice((-1, 1))) for name in varied(solved)}
    with mp.workdps(DIGITS):
        right = fifty_digits(program, givens)
        moved = fifty_digits(program, {name: mpf(value) * (1 + err.get(name, 0)) for name, value in givens.items()})
    shown, largest, known, found = plans_of(program), references(program, solved.values), conditions_of(solved), {}
    for name in (step.name for step in results(program) if step.law != "difference"):
        K, size = known[name].value, largest[name] if name in shown else abs(right[name])
        if K is None:  # no digit is right: nothing but rounding
            assert abs(solved.values[name]) <= 1e-12 * largest[name], name
            continue
        with mp.workdps(DIGITS):
            through = float(abs(moved[name] - right[name]) / (size or 1) / ERR)
            rounded = float(abs(mp.mpmathify(solved.values[name]) - right[name]) / (size or 1) / EPS)
        if through > K * (1 + 1e-4) + 1e-9 or rounded > 4.0 * (K + 1.0):
            found[name] = through / (K or 1.0), rounded / (K + 1.0)
    return found


@pytest.mark.parametrize("count", [1, pytest.param(40, marks=pytest.mark.soak)])
@pytest.mark.parametrize(("kind", "before", "carries"), KINDS)
def test_no_quantity_loses_more_than_its_condition_says(
    kind: str, before: tuple[int, int], carries: tuple[bool, ...], count: int
) -> None:
    random = np.random.default_rng(SEED)
    mechanism, values, _ = random_dyads(kind, before, carries, seed=SEED, count=count)
    for index in range(count):
        solved = solve_linkage(mechanism, one_of(values, index))

        assert exceeding(solved, random) == {}


@pytest.mark.parametrize("turn", [1.0, 1e-2, 1e-4])
def test_no_quantity_loses_more_than_its_condition_says_near_a_singular_position(turn: float) -> None:
    assert exceeding(solve_linkage(*near_the_end(turn)), np.random.default_rng(SEED)) == {}


def test_the_condition_of_a_calculated_quantity_refers_to_itself() -> None:
    # the rod hardly speeds up: its moment of inertia forces is nothing beside M_bal, and three of its digits are lost
    solved = solve("scheme-12-shaking-conveyor", "0").solved
    names = varied(solved)
    slopes = derivatives(solved.program, solved.givens, names)["M_i4"]

    found = conditions_of(solved)["M_i4"].value

    assert found == pytest.approx(float(np.abs(slopes).sum() / abs(solved.values["M_i4"])), rel=1e-12)
    assert found is not None
    assert found > 1e3
    given = names.index("phi")
    there = solve("scheme-12-shaking-conveyor", "0", set={"phi": solved.givens["phi"] * (1 + 1e-7) * 180 / math.pi})
    change = float(there["M_i4"].value or 0.0) - solved.values["M_i4"]
    assert change == pytest.approx(1e-7 * slopes[given], rel=1e-3)


def test_what_is_nothing_but_rounding_has_no_condition() -> None:
    solution = solve("scheme-05-articulated-rod", "1", condition=True)

    assert 0.0 < abs(solution["omega_2"].value or 0.0) < 1e-12
    assert solution.conditions["omega_2"].value is None
    assert solution.to_json()["quantities"]["omega_2"]["condition"] is None
