"""Files of tasks about cams: what they may say, what is refused and where, what is unusual and told."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from kulman import load_task, sheet, solve
from kulman.plans.cams.cam import GIVENS, Cam, Curve
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.solve import unusual
from kulman.scales.errors import InputError
from kulman.tests.support.cams import ROCKER
from kulman.tests.support.commands import Run
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.kinds import table_in
from kulman.variants.kinds.cam import KIND
from kulman.variants.reader import check_text, read_text
from kulman.variants.shelf import bundled_text

TASK = "madi-cam"
TEXT = bundled_text(TASK)
ROCKER_TEXT = Path(ROCKER).read_text(encoding="utf-8")
OWN = """
[[cam.curve]]
name = "mine"
kind = "pieces"
at = [0, "1/3", "1/3", 1]
values = [0, 2, -1, 0]
"""
edited = partial(with_changes, TEXT)


def test_a_file_without_any_table_lacks_the_first_one() -> None:
    assert (table_in(("givens", "cam")), table_in(("givens",))) == ("cam", "mechanism")
    _, faults = read_text(TEXT[: TEXT.index("[cam]")] + TEXT[TEXT.index("[[variant]]") :], "t.toml")
    assert "the key 'mechanism' is missing" in {fault.cause.text() for fault in faults}


def test_words_stand_in_a_variant_or_in_the_table_itself() -> None:
    task = load_task(TASK)
    text = edited(
        ('law = "law"\n', 'law = "sine"\nlaw_fall = "cosine"\nsections = 15\n'),
        ('fall = "fall"\n', 'fall = "same"\n'),
        (TEXT[TEXT.index("law = {") : TEXT.index("\nfall = {") + 1], ""),
        ('fall = { choices = ["mirror", "same"], default = "mirror" }\n', ""),
        ('reconstructed = ["law", "fall", ', "reconstructed = ["),
    )

    chosen = task.subject.chosen(task.words("17", {"law": "cosine", "rotation": "cw", "limits": "two-sided"}))
    written = task_of(text).subject

    assert isinstance(chosen, Cam)
    assert isinstance(written, Cam)
    assert (chosen.law, chosen.falls_by, chosen.fall, chosen.sense) == ("cosine", "cosine", "mirror", -1)
    assert (chosen.followers, chosen.sections, chosen.two_sided) == (("roller", "plate"), 12, True)
    assert (written.law, written.falls_by, written.fall, written.sections) == ("sine", "cosine", "same", 15)


def test_numbers_that_nobody_states_are_the_usual_ones_and_may_be_set() -> None:
    task = task_of(
        edited(
            ('u = { unit = "1" }\n', ""), ('u = "1/3"\n', ""), ('margin = "5 mm"\n', ""), ('phi_upper = "15 deg"\n', "")
        )
    )

    values = task.values("17")
    assert (values["u"], values["margin"], values["phi_upper"]) == (0.5, 0.005, 0.0)
    assert task.values("17", {"margin": "8 mm"})["margin"] == 0.008


def test_a_law_of_ones_own_is_solved_like_that_of_the_table() -> None:
    task = task_of(edited(('"polynomial-4567"]', '"polynomial-4567", "mine"]')) + OWN)

    mine, usual = (solve(task, set={"law": law}) for law in ("mine", "sawtooth"))

    assert isinstance(task.subject, Cam)
    assert task.subject.curves == (Curve("mine", "pieces", (0.0, 1 / 3, 1 / 3, 1.0), (0.0, 2.0, -1.0, 0.0)),)
    for name in ("mu_s", "ds_max", "A_1", "A_2", "r_0", "e", "rho_min", "r_0_flat_min"):
        assert mine[name].value == pytest.approx(usual[name].value, rel=1e-12), name


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
        ('margin = "5 mm"\n', "r_0 = 7\n", "variant", "the roller, 7 mm, is not smaller than r_0 = 7 mm"),
        ('margin = "5 mm"\n', "r_0 = 60\ne = -60\n", "variant", "the offset e = −60 mm"),
        ('h = { unit = "mm" }\n', "", "givens", "the key 'h' is missing"),
        ('h = { unit = "mm" }', 'h = { unit = "N" }', "givens.h", "expected one in mm"),
        ("R_roller = {", "r_roller = {", "givens.r_roller", "did you mean 'R_roller'?"),
        ("[givens]\n", '[givens]\npsi = { unit = "deg" }\n', "givens.psi", "has a number 'psi': roller, plate"),
        ('"roller", "plate"', '"plate"', "givens.R_roller", "has a number 'R_roller': plate"),
        ('"roller", "plate"', '"roller"', "givens.margin", "has a number 'margin': roller"),
        ('followers = ["roller", "plate"]', "followers = []", "cam.followers", "an array"),
        ('"roller", "plate"', '"roller", "dish"', "cam.followers", "'dish' is no follower of a cam"),
        ('"roller", "plate"', '"roller", "rocker"', "cam.followers", "the motion of a rocker is an angle"),
        ('law = "law"\n', "", "cam", "the key 'law' is missing"),
        ('"cosine", "sine"', '"cosine", "sinus"', "givens.law.choices", "'sinus' is not a choice"),
        ("[cam]\n", "[cam]\nsections = 6\n", "cam.sections", "12 to 90 sections"),
        ("[cam]\n", '[scales]\nmu_V = "0.001 (m/s)/mm"\n[cam]\n', "scales", "no scale factor 'mu_V'"),
        ("[cam]\n", '[scales]\nmu_l = "OA=50 mm"\n[cam]\n', "scales.mu_l", "no segment chooses a scale factor here"),
        ('"pressure"]', '"velocity"]', "plans", "unknown plan 'velocity'"),
        ("values = [0, 2, -1, 0]", "values = [0, 2, -1]", "cam.curve", "number of items: 4"),
        ("values = [0, 2, -1, 0]", "values = [0, 0, 0, 0]", "cam.curve", ""),
        ('at = [0, "1/3", "1/3", 1]', 'at = [0, "1/3", 0.2, 1]', "cam.curve", ""),
        ('kind = "pieces"', 'kind = "lines"', "cam.curve", "'lines' is not a choice"),
        ('name = "mine"', 'name = "sine"', "cam.curve", "a second time"),
    ],
)
def test_bad_data_is_explained_at_its_place(old: str, new: str, place: str, message: str) -> None:
    task, faults = read_text(with_changes(TEXT + OWN, (old, new)), "t.toml")

    told = [fault.text() for fault in faults]
    assert task is None
    assert any(place in line and message in line for line in told), told


@pytest.mark.parametrize("name", ["h", "e", "rho_flat", "margin"])
def test_a_number_that_no_rocker_has_is_a_fault_where_it_stands(name: str) -> None:
    lines = ROCKER_TEXT.split("\n")
    at = lines.index("[givens]") + 1

    faults, _ = check_text("\n".join([*lines[:at], f'{name} = {{ unit = "mm", default = 5 }}', *lines[at:]]), "t.toml")

    place = f"t.toml:{at + 1}:1: givens.{name}"
    assert [fault.text() for fault in faults] == [f"{place}: no follower of this cam has a number '{name}': rocker"]


def test_what_only_solving_tells_is_a_fault_where_all_faults_are_asked_for() -> None:
    text = edited(('margin = "5 mm"\n', 'margin = "5 mm"\nr_0 = "40 mm"\n'))

    faults, _ = check_text(text, "t.toml")

    (told,) = [fault.text() for fault in faults]
    line = text[: text.index("[[variant]]")].count("\n") + 1
    assert told.startswith(f"t.toml:{line}:1: variant.17: at r_0 = 40 mm no offset keeps")
    assert read_text(text, "t.toml")[1] == ()  # refused when it is solved
    assert check_text(TEXT, "t.toml") == ((), ())


@pytest.mark.parametrize(("excess", "whole"), [(0.0, True), (5e-13, True), (1e-11, False), (5e-10, False)])
def test_a_turn_is_as_long_for_the_checks_as_for_the_motion(excess: float, whole: bool) -> None:
    turn = {"phi_rise": math.pi, "phi_upper": 0.0, "phi_fall": math.pi + excess}

    assert ([*KIND.impossible(turn)] == []) is whole
    if whole:
        assert Motion(1.0, *turn.values(), law_of_motion("sine", 0.5)).lower.length == pytest.approx(0.0, abs=1e-15)
    else:
        with pytest.raises(InputError, match="more than a turn"):
            Motion(1.0, *turn.values(), law_of_motion("sine", 0.5))


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("--set u_fall=0", "u_fall: '0': must be greater than 0 and less than 1"),
        ("--set law_fall=sine", "task madi-cam does not state law_fall, which a task of this kind may have: "),
        ("--set R_rolle=8", "madi-cam has no given 'R_rolle'; did you mean 'R_roller'?"),
        ("--scale OA=80", "'OA': no segment chooses a scale factor here; expected one of: mu_l, mu_s_ds, mu_s_d2s"),
        ("--scale mu_s=1", "mu_s follows from the lengths on paper that are given; chosen may be: mu_l, mu_s_ds, "),
        ("--only velocity", "unknown plan 'velocity'; known are: diagrams, sizes, profile, pressure\n"),
    ],
)
def test_what_cannot_be_set_is_explained_in_one_line(
    arguments: str, line: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")

    status, out, err = run("solve", TASK, *arguments.split())

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(line)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (
            {"l_OC": "70 mm"},
            "at l_OC = 70 mm no place of the cam's centre keeps gamma_fall; the smallest cam has l_OC = 117.28 mm",
        ),
        (
            {"psi": "80 deg", "gamma_rise": "75 deg", "gamma_fall": "75 deg"},
            "no place of the cam's centre keeps gamma_rise, gamma_fall",
        ),
        ({"r_0": "50 mm"}, "r_0 of a cam with a rocker is given together with l_OC"),
        ({"r_0": "14 mm", "l_OC": "130 mm"}, "l_rocker = 110 mm, l_OC = 130 mm and r_0 = 14 mm make no triangle"),
        ({"R_roller": "36 mm"}, "the roller, 36 mm, is not smaller than r_0"),
    ],
)
def test_what_no_rocker_can_have_is_explained(settings: dict[str, str], said: str) -> None:
    sized = with_changes(ROCKER_TEXT, ("l_OC = {", 'r_0 = { unit = "mm" }\nl_OC = {'))

    with pytest.raises(InputError) as told:
        solve(task_of(sized), set=settings)

    assert told.value.text("en").startswith(said)


# numbers that hardly any cam has


TOLD = {
    "h=1e9": "h = 1·10⁹ mm is unusual: most cams have 0.1 to 500 mm; is the unit right?",
    "phi_rise=0.5": "phi_rise = 0.5° is unusual: most cams have 5 to 355°; is the unit right?",
    "u=0.999": "u = 0.999 is unusual: most cams have 0.05 to 0.95",
    "rho_flat=1e6": "rho_flat = 1·10⁶ mm is unusual: most cams have at most 200 mm; is the unit right?",
    "r_0=3000": "r_0 = 3000 mm is unusual: most cams have 2 to 1000 mm; is the unit right?",
    "omega=2500": "a_max = 4.116·10⁵ m/s² is unusual: most cams have at most 1·10⁵ m/s²; is the unit right?",
}


@pytest.mark.parametrize("setting", TOLD)
def test_a_number_that_hardly_any_cam_has_is_told_and_what_follows_from_it_is_not(setting: str) -> None:
    name, _, value = setting.partition("=")

    found = [warning for warning in solve(TASK, set={name: value}, only="sizes").warnings if "unusual" in warning.key]

    assert [warning.text("en") for warning in found] == [TOLD[setting]]


def test_the_ends_of_what_is_usual_are_usual() -> None:
    for name, given in GIVENS.items():
        for end, out in zip(given.usual or (), (0.999, 1.001), strict=given.usual is not None):
            for value, told in ((end, False), (end * out, end > 0.0)):
                cam: Any = SimpleNamespace(givens={name: value}, values={})
                assert [called for called, *_ in unusual(cam)] == [name] * told, (name, value)


def test_the_cams_of_books_are_usual() -> None:
    for task in (TASK, ROCKER):
        for variant in load_task(task).variants:
            assert solve(task, variant, only="sizes").warnings == ()


@pytest.mark.parametrize("name", ["phi_rise", "phi_fall"])
def test_a_phase_that_nobody_can_draw_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=rf"{name} = 1·10⁻⁶°: no phase of a cam is shorter than 0\.01°"):
        solve(TASK, set={name: "1e-6 deg"})


@pytest.mark.parametrize(
    "setting",
    [
        "u=0.999",
        *(pytest.param(s, marks=pytest.mark.soak) for s in ("l_A1=1e6", "H_a=1", "mu_phi=0.001", "margin=1e6")),
    ],
)
def test_a_drawing_for_which_no_paper_is_large_enough_is_refused(setting: str) -> None:
    name, _, value = setting.partition("=")
    with pytest.raises(InputError, match=r"no format has room for this sheet: a drawing of it is \d+ × \d+ mm") as told:
        sheet(TASK, set={name: value}, only="diagrams,profile" if name == "margin" else "diagrams")
    (*_, last) = told.value.data.get("faults", [told.value])  # behind how far a number is from the task's
    assert last.key == "sheet-too-large"


@pytest.mark.soak
@pytest.mark.parametrize("setting", ["h=1e9", "phi_rise=0.02", "omega=1e9", "mu_phi=100", "l_A1=1", "rho_flat=1e6"])
def test_an_unusual_cam_is_drawn_with_a_warning(setting: str) -> None:
    name, _, value = setting.partition("=")

    drawn = sheet(TASK, set={name: value})

    assert any(warning.key.startswith("cam-unusual-") for warning in drawn.warnings)
