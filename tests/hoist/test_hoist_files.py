"""Files of tasks about hoists: the bundled variants, what a file may say, what is refused, where; marking."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from kulman import check, solve
from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.hoist import VALUES, Hoist
from kulman.plans.marking.answers import Verdict
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.hoists import VARIANTS
from kulman.variants.reader import check_text, load_task
from kulman.variants.shelf import bundled_text

TASK = "karpenko-hoist"
TEXT = bundled_text(TASK)
QUANTITIES = (
    *(
        "m",
        "alpha_0",
        "alpha_2",
        "C_01",
        "C_k",
        "C_2",
        "C_12",
        "C",
        "k",
        "k_1",
        "t_1",
        "F_12_t1",
        "F_12_max",
        "t_F12_max",
    ),
    *(
        "T_1",
        "P_m",
        "R",
        "P_12_max",
        "P_12_min",
        "F_max",
        "sigma_max",
        "safety",
        "dynamic_factor",
        "w_0_max",
        "w_2_max",
    ),
    "P_12_max_printed",
)


def test_bundled_variants_are_the_ten_cranes() -> None:
    task = load_task(TASK)

    assert list(task.variants) == list(VARIANTS)
    for variant, values in VARIANTS.items():
        found = task.values(variant)
        assert {name: found[name] for name in VALUES} == pytest.approx(values, rel=1e-14)


@pytest.mark.parametrize("variant", ["V01", "V04", "V10"])
def test_results_of_a_variant_are_those_of_its_forces(variant: str) -> None:
    solution, found = solve(TASK, variant), forces(VARIANTS[variant]).found

    assert solution.status == "ok"
    for name in QUANTITIES:
        assert solution[name].value == pytest.approx(found[name], rel=1e-12), name
    assert [check["ok"] for check in solution.checks.values()][:3] == [True, True, True]


def test_what_is_infinite_is_null_and_the_rest_is_a_number() -> None:
    solution = solve(TASK, set={"I_0": "inf", "I_2": "inf"})

    items = json.loads(json.dumps(solution.to_json(), allow_nan=False))["quantities"]
    assert {name for name in QUANTITIES if items[name]["value"] is None} == {"C_01", "C_2", "k"}
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


def test_speed_that_never_lifts_is_refused() -> None:
    with pytest.raises(ValueError, match="never lifted"):
        solve(TASK, set={"V_0": 0, "a": 0})


BAD = [
    pytest.param('G_1 = "50000 N"', "G_1 = 0", "variant.G_1", "greater than zero", id="no load"),
    pytest.param('G_1 = "50000 N"', 'G_1 = "50 kg"', "variant.G_1", "unit kg does not fit", id="mass for weight"),
    pytest.param("beta_0 = 0.5", "beta_0 = 0.6", "variant.beta_0", "0.5", id="from the farther end"),
    pytest.param("beta_0 = 0.5", "beta_0 = 0", "variant.beta_0", "", id="over a support"),
    pytest.param('V_0 = "0.10 m/s"', 'V_0 = "-0.1 m/s"', "variant.V_0", "negative", id="wound off"),
    pytest.param('S = "234 mm^2"', 'S = "inf mm^2"', "variant.S", "", id="infinite rope"),
    pytest.param('near_0 = "near_0"', 'near_0 = "top"', "hoist.near_0", "'top' is not a choice", id="no such side"),
    pytest.param('near_0 = "near_0"', 'side = "left"', "hoist.side", "unknown key 'side'", id="no such key"),
    pytest.param("G_2 = { unit", "G_3 = { unit", "givens.G_3", "G_3", id="no such number"),
    pytest.param('"scheme", ', '"sheme", ', "plans", "scheme", id="no such plan"),
]


@pytest.mark.parametrize(("old", "new", "place", "message"), BAD)
def test_faults_of_a_file_are_told_with_their_places(old: str, new: str, place: str, message: str) -> None:
    assert old in TEXT

    faults, _ = check_text(TEXT.replace(old, new, 1), "t.toml")

    told = [fault.text("en") for fault in faults]
    assert any(f"{place}: " in line and message in line for line in told), told
    assert all("\n" not in fault.text(language) for fault in faults for language in LANGUAGES)


def test_sides_may_be_chosen() -> None:
    task = load_task(TASK)
    assert isinstance(task.subject, Hoist)

    assert task.subject.chosen(task.words("V01", {"near_2": "right"})) == Hoist("left", "right")
    assert solve(TASK, set={"near_0": "right"})["t_1"].value == solve(TASK)["t_1"].value


def verdicts(path: Path, answers: dict[str, float]) -> dict[str, Verdict]:
    """Mark one student's values of V04, in the units of the task."""
    asked = check(TASK, "V04", lang="en")
    path.write_text(
        f"student,{','.join(answers)}\nA,{','.join(f'{value!r}' for value in answers.values())}\n", encoding="utf-8"
    )
    (read,) = asked.read(str(path))
    return {line.name: line.verdict for line in asked.mark(read).marked.lines}


def test_right_answers_are_right_also_when_they_are_read_off_the_drawing(tmp_path: Path) -> None:
    solution = solve(TASK, "V04")
    form = check(TASK, "V04", lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")
    names = [name for name in (line.split(",")[0] for line in form.splitlines()) if name in solution]
    answers = {name: solution[name].shown(solution.words.display).value or 0.0 for name in names}
    answers |= {name: solution[f"{name}_drawn"].value or math.nan for name in ("t_1", "t_2_1", "t_2_2")}

    found = verdicts(tmp_path / "class.csv", answers)

    assert len(names) > 40
    assert {found[name] for name in names} == {Verdict.RIGHT}


def test_the_angle_of_the_article_is_a_wrong_answer(tmp_path: Path) -> None:
    found = forces(VARIANTS["V04"]).found
    principal = math.atan(-0.20 * found["k_1"] / 0.10) / found["k_1"]  # its arctg: a time before the lift-off

    marked = verdicts(tmp_path / "class.csv", {"T_1": principal, "P_12_max": found["P_12_max_printed"]})

    assert marked["T_1"] is Verdict.WRONG
    assert marked["P_12_max"] is Verdict.WRONG
