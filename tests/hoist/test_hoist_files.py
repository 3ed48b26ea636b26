"""Tasks about hoists: the bundled variants, what a file may say, what is refused, where; marking and sweeps."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kulman import check, solve, sweep
from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.hoist import VALUES, Hoist
from kulman.plans.hoist.solve import SolvedHoist, conditions_of, solve_hoist
from kulman.plans.marking.answers import Verdict
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.commands import Run
from kulman.tests.support.hoists import VARIANTS
from kulman.variants.reader import check_text, load_task
from kulman.variants.shelf import bundled_text

TASK = "karpenko-hoist"
TEXT = bundled_text(TASK)
ERR = 1e-7
SOME = [pytest.param(v, marks=[] if v == "V09" else pytest.mark.soak) for v in VARIANTS]
PUSHING = {"I_0": 1e-6, "V_0": 0.5}  # so soft a support that the rope of V10 goes slack


def test_bundled_variants_are_the_ten_cranes() -> None:
    task = load_task(TASK)

    assert list(task.variants) == list(VARIANTS)
    for variant, values in VARIANTS.items():
        found = task.values(variant)
        assert {name: found[name] for name in VALUES} == pytest.approx(values, rel=1e-14)


def test_what_is_infinite_is_null_and_the_rest_is_a_number() -> None:
    solution = solve(TASK, set={"I_0": "inf", "I_2": "inf"})

    items = json.loads(json.dumps(solution.to_json(), allow_nan=False))["quantities"]
    assert {name for name, item in items.items() if item["value"] is None} == {"C_01", "C_2", "k"}
    assert items["w_0_max"]["value"] == 0.0
    assert items["C_12"]["value"] == items["C_k"]["value"]


@pytest.mark.parametrize(
    ("settings", "failed", "said"),
    [
        pytest.param({"a": 0, "I_0": 2.7e-6}, "rope_phase_1", "would have to push", id="pushes"),
        pytest.param({"V_0": 1.5}, "rope_phase_2", "slack", id="slack"),
        pytest.param({"K": 9}, "strength", "not strong enough", id="weak"),
    ],
)
def test_what_does_not_hold_is_told(settings: dict[str, float], failed: str, said: str) -> None:
    solution = solve(TASK, "V04", set=settings)

    assert not solution.checks[failed]["ok"]
    assert any(said in warning.text("en") for warning in solution.warnings)
    for name in ("F_12_min", "P_12_min"):
        assert (solution[name].value or 0.0) >= 0.0  # no invalid number is returned


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ('G_1 = "50000 N"', "G_1 = 0", "variant.G_1", "greater than zero"),
        ('G_1 = "50000 N"', 'G_1 = "50 kg"', "variant.G_1", "unit kg does not fit"),
        ("beta_0 = 0.5", "beta_0 = 0.6", "variant.beta_0", "0.5"),
        ('V_0 = "0.10 m/s"', 'V_0 = "-0.1 m/s"', "variant.V_0", "negative"),
        ('S = "234 mm^2"', 'S = "inf mm^2"', "variant.S", ""),
        ('near_0 = "near_0"', 'near_0 = "top"', "hoist.near_0", "'top' is not a choice"),
        ('near_0 = "near_0"', 'side = "left"', "hoist.side", "unknown key 'side'"),
        ("G_2 = { unit", "G_3 = { unit", "givens.G_3", "G_3"),
        ('"scheme", ', '"sheme", ', "plans", "scheme"),
    ],
)
def test_faults_of_a_file_are_told_with_their_places(old: str, new: str, place: str, message: str) -> None:
    assert old in TEXT

    faults, _ = check_text(TEXT.replace(old, new, 1), "t.toml")

    told = [fault.text("en") for fault in faults]
    assert any(f"{place}: " in line and message in line for line in told), told
    assert all("\n" not in fault.text(language) for fault in faults for language in LANGUAGES)


REFUSED: dict[str, tuple[str, tuple[object, ...]]] = {  # of each kind of bound the numbers, and what is beyond it
    "hoist-positive": ("G_1 L S E_k sigma K l_0 I_0 E_0 l_2 I_2 E_2 g", (0.0, -1.0)),
    "hoist-not-negative": ("G_2 V_0 a slack", (-1e-3,)),
    "hoist-beta": ("beta_0 beta_2", (0.0, 0.51, -0.2)),
    "hoist-number": ("G_1 G_2 S E_k E_2 beta_0 V_0 g", ("heavy", math.nan, math.inf)),
}


@pytest.mark.parametrize("key", REFUSED)
def test_numbers_that_no_hoist_can_have_are_named(key: str) -> None:
    names, beyond = REFUSED[key]
    for name in names.split():
        for value in beyond:
            changed: dict[str, Any] = {**VARIANTS["V01"], name: value}
            with pytest.raises(InputError) as told:
                forces(changed)
            assert (told.value.key, told.value.data["name"]) == (key, name)
            assert all("\n" not in told.value.text(language) for language in LANGUAGES)


def test_a_hoist_that_stands_still_or_lacks_a_number_is_refused() -> None:
    for changes, key in (({"V_0": 0.0, "a": 0.0}, "hoist-still"), ({"I_0": 1e-320}, "hoist-range")):
        with pytest.raises(InputError) as told:
            forces({**VARIANTS["V01"], **changes})
        assert told.value.key == key
    with pytest.raises(InputError, match="E_k is missing"):
        forces({name: value for name, value in VARIANTS["V01"].items() if name != "E_k"})
    usual = {name: value for name, value in VARIANTS["V01"].items() if name not in ("slack", "g")}
    assert forces(usual).found == forces(VARIANTS["V01"]).found


def test_sides_may_be_chosen() -> None:
    task = load_task(TASK)
    assert isinstance(task.subject, Hoist)

    assert task.subject.chosen(task.words("V01", {"near_2": "right"})) == Hoist("left", "right")
    assert solve(TASK, set={"near_0": "right"})["t_1"].value == solve(TASK)["t_1"].value


# marking


def verdicts(path: Path, answers: dict[str, float]) -> dict[str, Verdict]:
    """Mark one student's values of V04, in the units of the task."""
    asked = check(TASK, "V04", lang="en")
    path.write_text(f"student,{','.join(answers)}\nA,{','.join(map(repr, answers.values()))}\n", encoding="utf-8")
    (read,) = asked.read(str(path))
    return {line.name: line.verdict for line in asked.mark(read).marked.lines}


def test_right_answers_are_right_also_when_they_are_read_off_the_drawing(tmp_path: Path) -> None:
    solution = solve(TASK, "V04")
    asked = check(TASK, "V04", lang="en")
    form = asked.write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")
    names = [name for name in (line.split(",")[0] for line in form.splitlines()) if name in solution]
    answers = {name: solution[name].shown(asked.asked.display).value or 0.0 for name in names}
    answers |= {name: solution[f"{name}_drawn"].value or math.nan for name in ("t_1", "t_2_1", "t_2_2")}

    found = verdicts(tmp_path / "class.csv", answers)

    assert len(names) > 40
    assert {found[name] for name in names} == {Verdict.RIGHT}


def test_the_angle_of_the_article_is_a_wrong_answer(tmp_path: Path) -> None:
    found = forces(VARIANTS["V04"]).found
    principal = math.atan(-0.20 * found["k_1"] / 0.10) / found["k_1"]  # its arctg: a time before the lift-off

    marked = verdicts(tmp_path / "class.csv", {"T_1": principal, "P_12_max": found["P_12_max_printed"]})

    assert marked["T_1"] is marked["P_12_max"] is Verdict.WRONG


# the condition of quantities


@pytest.mark.parametrize("variant", SOME)
def test_no_quantity_of_a_hoist_loses_more_than_its_condition_says(variant: str) -> None:
    random, right = np.random.default_rng(7), SolvedHoist.of(solve(TASK, variant).solved)
    known = conditions_of(right)
    for _ in range(3):
        err = {name: -ERR if name in ("beta_0", "beta_2") else ERR * random.choice((-1.0, 1.0)) for name in VALUES}

        there = solve_hoist(right.hoist, {n: right.givens[n] * (1.0 + err[n]) for n in VALUES}, right.plans).quantities

        for name, item in right.quantities.items():
            value, moved, K = item.value, there[name].value, known[name].value
            if value is None or moved is None or K is None:
                assert not value, name
                continue
            assert abs(moved - value) <= ERR * (K * 1.01 + 1e-3) * abs(value), name


def test_what_is_proportional_to_data_has_the_sum_of_their_powers() -> None:
    known = solve(TASK, "V01", condition=True).conditions

    assert known["P_st"].value == pytest.approx(1.0, abs=1e-6)  # G_1 + G_2 / 3
    assert known["C_k"].value == pytest.approx(3.0, abs=1e-4)  # E_k S / L
    assert known["sigma_max"].value == pytest.approx((known["F_max"].value or 0.0) + 1.0, abs=1e-4)


# forces over time


def test_csv_begins_at_rest_and_ends_a_period_after_the_lift_off() -> None:
    rows = list(csv.DictReader(io.StringIO(sweep(TASK, "V01", lang="en", positions=73).csv())))
    solved = solve(TASK, "V01")

    names = ("F_12 [N]", "F_01 [N]", "t [s]", "sigma [MPa]")
    force, pressed, t, sigma = (np.array([float(row[name]) for row in rows]) for name in names)

    assert (len(t), force[0]) == (73, 0.0)
    assert pressed[0] == pytest.approx(-solved["P_st"].value, rel=1e-14)
    assert t[-1] == pytest.approx(solved["t_1"].value + 2.0 * np.pi / solved["k_1"].value, rel=1e-14)
    assert force[-1] == pytest.approx(solved["F_12_t1"].value, rel=1e-12)
    assert np.all(pressed[t > solved["t_1"].value] == 0.0)
    assert force.max() <= solved["F_max"].value
    assert sigma == pytest.approx(force / 234e-6 * 1e-6, rel=1e-12)


def test_json_is_in_si_and_says_what_bears() -> None:
    data = json.loads(json.dumps(sweep(TASK, "V10", set=PUSHING).to_json(), allow_nan=False))

    bears, force = np.array(data["bears"]), np.array(data["columns"]["F_12"]["value"])
    assert not data["valid"]
    assert {"both", "support", "rope"} <= set(data["bears"])
    assert data["columns"]["F_12"]["unit"] == "N"
    assert np.all(force >= 0.0)
    assert np.all(force[bears == "support"] == 0.0)
    assert data["marks"]["t_1"] > 0.0


def test_a_sweep_of_a_hoist_has_no_drawing_no_points_and_no_ends(tmp_path: Path, run: Run) -> None:
    with pytest.raises(InputError) as refused:
        sweep(TASK, "V01", set={"l_0": "6 m"}).save(tmp_path / "forces.svg")
    assert all(
        "kulman sheet karpenko-hoist -v V01 --set 'l_0=6 m' --lang en -o forces.svg" in refused.value.text(lang)
        for lang in LANGUAGES
    )
    assert not (tmp_path / "forces.svg").exists()
    for option in (["--points", "A"], ["--from", "1"], ["--to", "2"], ["--chords", "A"]):
        status, _, err = run("sweep", TASK, *option)
        assert status == 2
        assert option[0] in err


def test_stresses_are_shown_in_megapascals_and_data_are_in_si() -> None:
    solution = solve("karpenko-hoist", lang="en")
    row = dict(zip(solution.columns, next(row for row in solution.rows if row[0] == "sigma_max"), strict=True))

    assert (row["value"], row["unit"]) == (solution["sigma_max"].value / 1e6, "MPa")
    assert solution["sigma_max"].unit == solution.to_json()["quantities"]["sigma_max"]["unit"] == "Pa"
