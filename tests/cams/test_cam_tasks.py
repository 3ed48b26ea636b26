"""Tasks about cams: what their files may say, what a user may set, what is solved, checked, told and marked."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from kulman import check, cli, solve
from kulman.plans.cams.cam import LAWS, VALUES, Cam, Curve
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.marking.verdicts import Verdict
from kulman.scales.errors import InputError
from kulman.scales.units import unit
from kulman.variants.checks.cam import NUMBERS, impossible
from kulman.variants.kinds import KINDS, kind_of, table_in
from kulman.variants.reader import load_task, read_text
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.solution import Solution
from kulman.variants.task import Task

TASK = "madi-cam"
TEXT = bundled_text(TASK)
ROCKER = Path(__file__).resolve().parents[2] / "docs" / "examples" / "rocker-cam.toml"
OWN = """
[[cam.curve]]
name = "mine"
kind = "pieces"
at = [0, "1/3", "1/3", 1]
values = [0, 2, -1, 0]
"""


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK)


def edited(*changes: tuple[str, str]) -> str:
    """Return the bundled file with other words in it."""
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def task_of(text: str) -> Task:
    task, faults = read_text(text, "t.toml")
    assert not faults
    assert task is not None
    return task


# the kinds


def test_every_bundled_task_is_of_the_kind_that_its_file_says() -> None:
    by_kind = {table: bundled(table) for table in ("mechanism", "cam")}

    assert sorted(sum(by_kind.values(), ())) == sorted(bundled())
    assert TASK in by_kind["cam"]
    for table, tasks in by_kind.items():
        assert {load_task(task).kind for task in tasks} == {table}
        assert kind_of(table).table == table


def test_a_file_without_any_table_lacks_the_first_one() -> None:
    assert (table_in(("givens", "cam")), table_in(("givens",))) == ("cam", "mechanism")
    _, faults = read_text(TEXT[: TEXT.index("[cam]")] + TEXT[TEXT.index("[scales]") :], "t.toml")
    assert "the key 'mechanism' is missing" in {fault.cause.text() for fault in faults}
    assert len(KINDS) == 2


# the file


def test_words_of_a_variant_stand_in_the_place_of_the_names_of_choices() -> None:
    task = load_task(TASK)
    assert isinstance(task.mechanism, Cam)

    cam = task.mechanism.chosen(task.words("17", {"law": "cosine", "rotation": "cw", "limits": "two-sided"}))

    assert (cam.law, cam.falls_by, cam.fall, cam.sense, cam.two_sided) == ("cosine", "cosine", "mirror", -1, True)
    assert (cam.followers, cam.sections) == (("roller", "plate"), 12)


def test_words_may_stand_in_the_table_itself() -> None:
    text = edited(
        ('law = "law"\n', 'law = "sine"\nlaw_fall = "cosine"\nsections = 15\n'),
        ('fall = "fall"\n', 'fall = "same"\n'),
        (TEXT[TEXT.index("law = {") : TEXT.index("\nfall = {") + 1], ""),
        ('fall = { choices = ["mirror", "same"], default = "mirror" }\n', ""),
        ('reconstructed = ["law", "fall", ', "reconstructed = ["),
    )

    cam = task_of(text).mechanism

    assert isinstance(cam, Cam)
    assert (cam.law, cam.falls_by, cam.fall, cam.sections) == ("sine", "cosine", "same", 15)


def test_numbers_that_nobody_states_are_the_usual_ones_and_may_be_set() -> None:
    short = edited(
        ('u = { unit = "1" }\n', ""), ('u = "1/3"\n', ""), ('margin = "5 mm"\n', ""), ('phi_upper = "15 deg"\n', "")
    )

    task = task_of(short)

    values = task.values("17")
    assert (values["u"], values["margin"], values["phi_upper"]) == (0.5, 0.005, 0.0)
    assert task.values("17", {"margin": "8 mm"})["margin"] == 0.008


def test_a_law_of_ones_own_is_chosen_like_the_others() -> None:
    text = edited(('"polynomial-4567"]', '"polynomial-4567", "mine"]')) + OWN

    mine, usual = (solve(task_of(text), set={"law": law}) for law in ("mine", "sawtooth"))

    cam = task_of(text).mechanism
    assert isinstance(cam, Cam)
    assert cam.curves == (Curve("mine", "pieces", (0.0, 1 / 3, 1 / 3, 1.0), (0.0, 2.0, -1.0, 0.0)),)
    assert mine["r_0"].value == pytest.approx(usual["r_0"].value, rel=1e-12)


def test_a_choice_may_set_numbers() -> None:
    sized = edited(
        ('h = { unit = "mm" }\n', 'size = { choices = ["small", "large"], default = "small" }\n'),
        ('h = "13 mm"\n', ""),
        ("[cam]", '[choices.size]\nsmall = { h = "13 mm" }\nlarge = { h = "26 mm" }\n\n[cam]'),
    )

    small, large = (solve(task_of(sized), set={"size": word}) for word in ("small", "large"))

    assert small["r_0"].value == solve(TASK)["r_0"].value
    assert large["r_0"].value == pytest.approx(2.0 * small["r_0"].value, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ('h = "13 mm"', 'h = "-13 mm"', "variant.h", "must be greater than zero"),
        ('h = "13 mm"', 'h = "13 deg"', "variant.h", "the unit deg does not fit"),
        ('phi_rise = "108 deg"', 'phi_rise = "361 deg"', "variant.phi_rise", "at most 360°"),
        ('phi_rise = "108 deg"', 'phi_rise = "250 deg"', "variant", "together take 373°, more than a turn"),
        ('phi_upper = "15 deg"', 'phi_upper = "-15 deg"', "variant.phi_upper", "must not be negative"),
        ('u = "1/3"', "u = 1", "variant.u", "greater than 0 and less than 1"),
        ('u = "1/3"', "u = 0", "variant.u", "greater than 0 and less than 1"),
        ('gamma_rise = "75 deg"', 'gamma_rise = "90 deg"', "variant.gamma_rise", "less than 90°"),
        ('gamma_fall = "60 deg"', "gamma_fall = 0", "variant.gamma_fall", "greater than 0°"),
        (
            'margin = "5 mm"\n',
            'margin = "5 mm"\nr_0 = 6\n',
            "variant",
            "the roller, 7 mm, is not smaller than r_0 = 6 mm",
        ),
        ('margin = "5 mm"\n', 'margin = "5 mm"\nr_0 = 60\ne = -60\n', "variant", "the eccentricity e = -60 mm"),
        ('h = { unit = "mm" }\n', "", "givens", "the key 'h' is missing"),
        ('h = { unit = "mm" }', 'h = { unit = "N" }', "givens.h", "expected one in mm"),
        ("R_roller = {", "r_roller = {", "givens.r_roller", "did you mean 'R_roller'?"),
        ("[givens]\n", '[givens]\nl_OC = { unit = "mm" }\n', "givens.l_OC", "has a number 'l_OC': roller, plate"),
        ("[givens]\n", '[givens]\npsi = { unit = "deg" }\n', "givens.psi", "has a number 'psi': roller, plate"),
        ('"roller", "plate"', '"plate"', "givens.R_roller", "has a number 'R_roller': plate"),
        ('"roller", "plate"', '"roller"', "givens.margin", "has a number 'margin': roller"),
        ('followers = ["roller", "plate"]', "followers = []", "cam.followers", "an array"),
        ('"roller", "plate"', '"roller", "dish"', "cam.followers", "'dish' is no follower of a cam"),
        ('"roller", "plate"', '"roller", "rocker"', "cam.followers", "the motion of a rocker is an angle"),
        ('law = "law"', 'law = "sinus"', "cam.law", "'sinus' is not a choice"),
        ('law = "law"', "law = 3", "cam.law", "a text in quotes was expected"),
        ('law = "law"\n', "", "cam", "the key 'law' is missing"),
        ('"cosine", "sine"', '"cosine", "sinus"', "givens.law.choices", "'sinus' is not a choice"),
        ('rotation = "rotation"', 'rotation = "left"', "cam.rotation", "'left' is not a choice"),
        ("[cam]\n", "[cam]\nsections = 6\n", "cam.sections", "12 to 90 sections"),
        ("[cam]\n", "[cam]\ncentre = 6\n", "cam.centre", "unknown key 'centre'"),
        ('mu_l = "0.001 m/mm"', 'mu_V = "0.001 (m/s)/mm"', "scales", "no scale factor 'mu_V'"),
        ('"pressure"]', '"velocity"]', "plans", "unknown plan 'velocity'"),
    ],
)
def test_bad_data_is_explained_at_its_place(old: str, new: str, place: str, message: str) -> None:
    task, faults = read_text(edited((old, new)), "t.toml")

    told = [fault.text() for fault in faults]
    assert task is None
    assert any(place in line and message in line for line in told), told


def test_what_only_solving_tells_is_a_fault_where_all_faults_are_asked_for() -> None:
    text = edited(('margin = "5 mm"\n', 'margin = "5 mm"\nr_0 = "40 mm"\n'))

    task, faults = read_text(text, "t.toml", thorough=True)

    assert task is None
    (told,) = [fault.text() for fault in faults]
    line = text[: text.index("[[variant]]")].count("\n") + 1
    assert told.startswith(f"t.toml:{line}:1: variant: at r_0 = 40 mm no eccentricity keeps")
    assert read_text(text, "t.toml")[1] == ()  # refused when it is solved
    assert read_text(TEXT, "t.toml", thorough=True)[1] == ()


@pytest.mark.parametrize(("excess", "whole"), [(0.0, True), (5e-13, True), (1e-11, False), (5e-10, False)])
def test_a_turn_is_as_long_for_the_checks_as_for_the_motion(excess: float, whole: bool) -> None:
    turn = {"phi_rise": math.pi, "phi_upper": 0.0, "phi_fall": math.pi + excess}

    assert ([*impossible(turn)] == []) is whole
    if whole:
        assert Motion(1.0, *turn.values(), law_of_motion("sine", 0.5)).lower.length == pytest.approx(0.0, abs=1e-15)
    else:
        with pytest.raises(InputError, match="more than a turn"):
            Motion(1.0, *turn.values(), law_of_motion("sine", 0.5))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        pytest.param("values = [0, 2, -1, 0]", "values = [0, 2, -1]", "number of items: 4", id="uneven"),
        pytest.param('at = [0, "1/3", "1/3", 1]', 'at = [0, "1/3", 0.2, 1]', "cam.curve", id="back"),
        pytest.param('kind = "pieces"', 'kind = "lines"', "'lines' is not a choice", id="kind"),
        pytest.param('name = "mine"', 'name = "sine"', "a second time", id="name of another law"),
        pytest.param("values = [0, 2, -1, 0]", "values = [0, 0, 0, 0]", "cam.curve", id="no motion"),
    ],
)
def test_a_law_that_moves_no_follower_is_refused(old: str, new: str, message: str) -> None:
    assert old in OWN
    _, faults = read_text(TEXT + OWN.replace(old, new), "t.toml")

    assert any(message in fault.text() for fault in faults), [fault.text() for fault in faults]


def test_every_number_of_a_cam_has_a_unit_and_a_bound() -> None:
    assert NUMBERS.keys() == VALUES.keys()
    for name, number in NUMBERS.items():
        if number.default is not None:
            assert number.bound.admits(number.default), name
        assert unit(VALUES[name] or "1")


# what is solved


def test_quantities_have_their_names_and_units(solution: Solution) -> None:
    units = {
        "m": "A_1 A_2 ds_max s_max r_0 e s_0 rho_min R_roller r_0_flat_min r_0_flat R_plate H_v H_a",
        "m/mm": "mu_s mu_ds mu_d2s mu_s_chord mu_ds_chord mu_d2s_chord",
        "rad": "gamma_rise_min gamma_fall_min nu",
        "(m/s)/mm": "mu_v",
        "(m/s^2)/mm": "mu_a",
        "rad/mm": "mu_phi",
        "m/s": "v_max",
        "m/s^2": "a_max",
    }

    assert {name: solution[name].unit for names in units.values() for name in names.split()} == {
        name: one for one, names in units.items() for name in names.split()
    }


@pytest.mark.parametrize("chord", ["", "_chord"])
def test_scale_factors_hang_together(solution: Solution, chord: str) -> None:
    def q(name: str) -> float:
        value = solution[name].value
        assert value is not None
        return value

    mu_s, mu_ds, mu_d2s = (q(f"{name}{chord}") for name in ("mu_s", "mu_ds", "mu_d2s"))
    assert mu_ds == pytest.approx(mu_s / (q("mu_phi") * q("H_v") * 1e3), rel=1e-12)
    assert mu_d2s == pytest.approx(mu_ds / (q("mu_phi") * q("H_a") * 1e3), rel=1e-12)
    assert q(f"mu_v{chord}") == pytest.approx(200.0 * mu_ds, rel=1e-12)
    assert q(f"mu_a{chord}") == pytest.approx(200.0**2 * mu_d2s, rel=1e-12)
    assert math.tan(q(f"nu{chord}")) == pytest.approx(mu_s / mu_ds, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_every_law_is_solved_and_keeps_the_limits(law: str) -> None:
    found = solve(TASK, set={"law": law}, only="sizes")

    assert found.status == "ok"
    assert found["s_max"].value == pytest.approx(0.013)
    assert {name: one["ok"] for name, one in found.checks.items() if name.startswith("gamma")} == {
        "gamma_rise": True,
        "gamma_fall": True,
    }
    assert [warning.key for warning in found.warnings if warning.key == "cam-no-plate"] == (
        ["cam-no-plate"] if law == "uniform" else []
    )


def test_only_what_is_wanted_is_built() -> None:
    diagrams, sizes = (solve(TASK, only=plan) for plan in ("diagrams", "sizes"))

    assert ("mu_s" in diagrams, "r_0" in diagrams) == (True, False)
    assert ("r_0" in sizes, "rho_min" in sizes) == (True, False)


def test_sense_of_rotation_moves_the_follower_to_the_other_side(solution: Solution) -> None:
    turned = solve(TASK, set={"rotation": "cw"})

    assert turned["e"].value == pytest.approx(-(solution["e"].value or 0.0), rel=1e-12)
    assert turned["r_0"].value == pytest.approx(solution["r_0"].value, rel=1e-12)


def test_given_radius_has_a_range_of_offsets_or_a_reason_why_there_is_none(solution: Solution) -> None:
    wide = solve(TASK, set={"r_0": 60})

    assert wide["e_least"].value < wide["e"].value < wide["e_most"].value  # type: ignore[operator]
    with pytest.raises(InputError, match=r"at r_0 = 45 mm no eccentricity keeps .* takes at least 45\.2582 mm"):
        solve(TASK, set={"r_0": 45})
    assert "e_least" not in solution


# rules of good design


def test_rules_of_good_design_hold_for_the_project(solution: Solution) -> None:
    checks = solution.checks

    assert all(one["ok"] for one in checks.values())
    assert checks["roller_of_radius"]["limit"] == pytest.approx(0.4 * (solution["r_0"].value or 0.0))
    assert checks["roller_of_curvature"]["limit"] == pytest.approx(0.7 * (solution["rho_min"].value or 0.0))
    assert checks["roller_of_radius"]["value"] == 0.007
    assert solution.warnings == ()


@pytest.mark.parametrize(
    ("settings", "broken"),
    [
        pytest.param({"R_roller": 19}, {"roller_of_radius"}, id="of the radius"),
        pytest.param({"R_roller": 22}, {"roller_of_radius", "roller_of_curvature"}, id="of the curvature"),
        pytest.param(
            {"R_roller": 33}, {"roller_of_radius", "roller_of_curvature", "undercut_roller"}, id="undercut profile"
        ),
        pytest.param({"r_0": 46, "e": -5}, {"gamma_rise"}, id="transmission angle"),
    ],
)
def test_a_broken_rule_is_told(settings: dict[str, Any], broken: set[str]) -> None:
    found = solve(TASK, set=settings)

    assert {name for name, one in found.checks.items() if not one["ok"]} == broken
    told = [warning.text() for warning in found.warnings]
    assert len(told) == len(broken)
    assert ("undercut_roller" in broken) == any(
        "is undercut: from 35.61° to 49.73° the follower loses up to 0.0224 mm" in line for line in told
    )
    assert ("roller_of_radius" in broken) == any("is larger than 0.4 r_0 = 18.1 mm" in line for line in told)
    assert ("gamma_rise" in broken) == any("in the rise the transmission angle falls to" in line for line in told)


def test_roller_that_leaves_no_cam_is_refused() -> None:
    with pytest.raises(InputError, match=r"the roller, 46 mm, is not smaller than r_0 = 45\.25818 mm"):
        solve(TASK, set={"R_roller": 46})


# the commands


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[object, str, str]:
    with pytest.raises(SystemExit) as stopped:
        cli.main(arguments)
    out, err = capsys.readouterr()
    return stopped.value.code, out, err


def test_solve_prints_json_with_the_scale_factors_and_checks(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "solve", TASK, "--json")

    data = json.loads(out)
    assert (status, data["status"]) == (0, "ok")
    assert data["scales"]["mu_s"]["value"] == data["quantities"]["mu_s"]["value"]
    assert data["scales"]["mu_l"] == {"value": 0.001, "unit": "m/mm"}
    assert data["quantities"]["A_1"]["mm"] == pytest.approx(110.0)
    assert data["checks"]["convex"]["ok"] is True


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("solve", TASK, "--condition"), "madi-cam: a task of this kind has no such thing: condition\n"),
        (
            ("solve", TASK, "--only", "velocity"),
            "unknown plan 'velocity'; known are: diagrams, sizes, profile, pressure\n",
        ),
        (("solve", TASK, "--scale", "mu_s=1"), "task madi-cam has no scale factor 'mu_s'; did you mean 'mu_l'?\n"),
        (("solve", TASK, "--set", "h=-1"), "h: '-1': must be greater than zero\n"),
    ],
)
def test_what_a_cam_has_not_is_refused_in_one_line(
    arguments: tuple[str, ...], line: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")

    assert run(capsys, *arguments) == (2, "", line)


# marking

PRINTED = {
    "mu_s_chord": Verdict.RIGHT,
    "mu_a_chord": Verdict.RIGHT,
    "ds_max_chord": Verdict.RIGHT,
    "r_0_tangents": Verdict.RIGHT,
    "e_tangents": Verdict.RIGHT,
    "rho_min": Verdict.WRONG,  # the radius of the upper dwell
    "r_0_flat_min": Verdict.WRONG,  # an amplitude on paper
    "r_0_flat": Verdict.CARRIED,
    "R_plate": Verdict.RIGHT,
}


def test_printed_answers_are_right_but_for_two_that_are_no_sizes_of_a_cam() -> None:
    asked = check(TASK, lang="en")

    (answers,) = asked.read("printed")
    verdicts = {line.name: line.verdict for line in asked.mark(answers).marked.lines}

    assert {name: verdicts[name] for name in PRINTED} == PRINTED


def test_form_asks_for_what_is_drawn_and_not_for_what_only_a_formula_gives(tmp_path: Any) -> None:
    text = check(TASK, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    asked = {line.split(",")[0] for line in text.splitlines()}
    assert {"mu_s_chord", "r_0_tangents", "e_tangents", "rho_min", "R_plate"} <= asked
    assert not {"mu_s", "r_0", "e", "s_0", "nu"} & asked


def test_form_of_a_rocker_is_headed_by_its_own_plans(tmp_path: Any) -> None:
    text = check(ROCKER, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    for heading in ("Positions of the rocker, place of the cam's centre", "Cam with a rocker"):
        assert f'{heading}"' in text or heading in text.splitlines()
    assert "roller follower" not in text


def test_right_answers_get_the_full_mark(tmp_path: Any, solution: Solution) -> None:
    asked = check(TASK, lang="en")
    form = asked.write_form(tmp_path / "form.csv")
    lines = form.read_text(encoding="utf-8-sig").splitlines()
    filled = []
    for line in lines:
        cells = line.split(",")
        if cells[0] in solution and len(cells) > 6:
            cells[5] = f"{solution[cells[0]].shown(solution.words.display).value:.4g}"
        filled.append(",".join(cells))
    form.write_text("\n".join(filled), encoding="utf-8-sig")

    (answers,) = asked.read(str(form))

    assert asked.mark(answers).marked.mark == 100.0


@pytest.mark.parametrize(
    ("name", "times"),
    [("mu_s_chord", 1e3), ("mu_a_chord", 10.0), ("gamma_rise_min", math.degrees(1.0)), ("r_0_tangents", 0.1)],
)
def test_a_value_in_another_unit_is_told_from_a_wrong_one(
    name: str, times: float, tmp_path: Any, solution: Solution
) -> None:
    asked = check(TASK, lang="en")
    written = solution[name].shown(solution.words.display)
    file = tmp_path / "class.csv"
    file.write_text(f"student,{name}\nA,{times * (written.value or 0.0):.6g}\n", encoding="utf-8")

    (answers,) = asked.read(str(file))
    (line,) = [line for line in asked.mark(answers).marked.lines if line.name == name]

    assert line.verdict is Verdict.SCALE
