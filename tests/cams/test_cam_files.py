"""Files of tasks about cams: what they may say, what is refused, and where."""

from __future__ import annotations

import math
from functools import partial

import pytest

from kulman import solve
from kulman.plans.cams.cam import GIVENS, Cam, Curve
from kulman.plans.cams.laws_of_motion import law_of_motion
from kulman.plans.cams.motion import Motion
from kulman.scales.errors import InputError
from kulman.scales.units import unit
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.case import kind_of
from kulman.variants.kinds import MODULES, table_in
from kulman.variants.kinds.cam import KIND
from kulman.variants.reader import check_text, load_task, read_text
from kulman.variants.shelf import bundled, bundled_text

TASK = "madi-cam"
TEXT = bundled_text(TASK)
OWN = """
[[cam.curve]]
name = "mine"
kind = "pieces"
at = [0, "1/3", "1/3", 1]
values = [0, 2, -1, 0]
"""


edited = partial(with_changes, TEXT)


# the kinds


def test_every_bundled_task_is_of_the_kind_that_its_file_says() -> None:
    by_kind = {table: bundled(table) for table in MODULES}

    assert sorted(sum(by_kind.values(), ())) == sorted(bundled())
    assert TASK in by_kind["cam"]
    for table, tasks in by_kind.items():
        assert {load_task(task).kind for task in tasks} == {table}
        assert kind_of(table).table == table


def test_a_file_without_any_table_lacks_the_first_one() -> None:
    assert (table_in(("givens", "cam")), table_in(("givens",))) == ("cam", "mechanism")
    _, faults = read_text(TEXT[: TEXT.index("[cam]")] + TEXT[TEXT.index("[[variant]]") :], "t.toml")
    assert "the key 'mechanism' is missing" in {fault.cause.text() for fault in faults}


# the file


def test_words_of_a_variant_stand_in_the_place_of_the_names_of_choices() -> None:
    task = load_task(TASK)
    assert isinstance(task.subject, Cam)

    cam = task.subject.chosen(task.words("17", {"law": "cosine", "rotation": "cw", "limits": "two-sided"}))

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

    cam = task_of(text).subject

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

    cam = task_of(text).subject
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
        ("[cam]\n", '[scales]\nmu_V = "0.001 (m/s)/mm"\n[cam]\n', "scales", "no scale factor 'mu_V'"),
        ("[cam]\n", '[scales]\nmu_s = "0.001 m/mm"\n[cam]\n', "scales.mu_s", "mu_s follows from the lengths on paper"),
        ("[cam]\n", '[scales]\nmu_l = "OA=50 mm"\n[cam]\n', "scales.mu_l", "no segment chooses a scale factor here"),
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

    faults, _ = check_text(text, "t.toml")

    (told,) = [fault.text() for fault in faults]
    line = text[: text.index("[[variant]]")].count("\n") + 1
    assert told.startswith(f"t.toml:{line}:1: variant.17: at r_0 = 40 mm no eccentricity keeps")
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
    for name, given in GIVENS.items():
        if isinstance(given.default, float):
            assert given.bound.admits(given.default), name
        assert given.choices or unit(given.unit or "1")
