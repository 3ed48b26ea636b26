"""Tasks about cams solved: rules of good design, what is listed, told, measured on paper; the document about cams."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import kulman
from kulman import check, load_task, sheet, solve
from kulman.plans.cams.cam import LAWS, PLANS
from kulman.plans.cams.construction import construct
from kulman.plans.cams.solve import EQUAL, OF_PLAN, PRESSURES, SCALES, SolvedCam, section_of
from kulman.scales.errors import InputError
from kulman.tests.support.cam_points import MU_D2S, MU_DS, MU_S, MU_S_D2S, MU_S_DS, measured, printed_scales
from kulman.tests.support.cam_students import ROCKER
from kulman.tests.support.printed_numbers import lines_of
from kulman.tests.support.readback import read
from kulman.variants.marking.report import to_json
from kulman.variants.sheets import Sheet
from kulman.variants.solution import Solution
from kulman.variants.sweeps.swept import CourseSweep

TASK = "madi-cam"
TASKS = pytest.mark.parametrize("task", [TASK, ROCKER], ids=["roller", "rocker"])
GIVEN = {"mu_phi", "H_a", "H_v", "R_roller", "l_rocker"}
SMALL = {"l_A1": "55 mm", "H_a": "15 mm", "H_v": "15 mm", "mu_phi": "2 deg/mm"}  # half, as A3 has room for
DOCUMENT = (Path(kulman.__file__).parent / "docs" / "cams.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK)


# sizes and rules


@pytest.mark.parametrize("law", LAWS)
def test_every_law_is_solved_and_keeps_the_limits(law: str) -> None:
    found = solve(TASK, set={"law": law}, only="sizes")

    assert (found.status, found["s_max"].value) == ("ok", pytest.approx(0.013))
    assert found.checks["gamma_rise"]["ok"]
    assert found.checks["gamma_fall"]["ok"]
    assert ("cam-no-plate" in {warning.key for warning in found.warnings}) == (law == "uniform")


def test_given_radius_has_a_range_of_offsets_or_a_reason_why_there_is_none(solution: Solution) -> None:
    wide = solve(TASK, set={"r_0": 60}).solved.values

    assert wide["e_least"] < wide["e"] < wide["e_most"]
    with pytest.raises(InputError, match=r"at r_0 = 45 mm no eccentricity keeps .* takes at least 45\.2582 mm"):
        solve(TASK, set={"r_0": 45})
    assert "e_least" not in solution
    for name in ("e_least", "e_most"):  # at either end a limit is just kept
        at_end = solve(TASK, set={"r_0": "60 mm", "e": f"{wide[name]!r} m"}).solved.values
        slack = [at_end[f"gamma_{phase}_min"] - at_end[f"gamma_{phase}"] for phase in ("rise", "fall")]
        assert min(slack) == pytest.approx(0.0, abs=1e-9)


def test_a_follower_that_is_pressed_to_one_side_alone_has_no_more_than_a_right_angle() -> None:
    assert solve(TASK, set={"e": 100})["gamma_rise_min"].value == pytest.approx(math.pi / 2)


def test_the_fall_may_have_another_part(solution: Solution) -> None:
    other = solve(TASK, set={"u_fall": 0.6})

    assert other["mu_s"].value == solution["mu_s"].value
    assert other["r_0"].value != solution["r_0"].value


def test_rules_of_good_design_hold_for_the_project(solution: Solution) -> None:
    checks = solution.checks

    assert all(one["ok"] for one in checks.values())
    assert checks["roller_of_radius"]["limit"] == pytest.approx(0.4 * (solution["r_0"].value or 0.0))
    assert checks["roller_of_curvature"]["limit"] == pytest.approx(0.7 * (solution["rho_min"].value or 0.0))
    assert checks["roller_of_radius"]["value"] == 0.007
    assert solution.warnings == ()


@pytest.mark.parametrize(
    ("settings", "broken", "said"),
    [
        ({"R_roller": 19}, {"roller_of_radius"}, "is larger than 0.4 r_0 = 18.1 mm"),
        ({"R_roller": 22}, {"roller_of_radius", "roller_of_curvature"}, ""),
        (
            {"R_roller": 33},
            {"roller_of_radius", "roller_of_curvature", "undercut_roller"},
            "is undercut: from 35.61° to 49.73° the follower loses up to 0.0224 mm",
        ),
        ({"r_0": 46, "e": -5}, {"gamma_rise"}, "in the rise the transmission angle falls to"),
    ],
)
def test_a_broken_rule_is_told(settings: dict[str, Any], broken: set[str], said: str) -> None:
    found = solve(TASK, set=settings)

    assert {name for name, one in found.checks.items() if not one["ok"]} == broken
    told = [warning.text() for warning in found.warnings if warning.key != "cam-r-0-at-e"]  # which tells the least r_0
    assert len(told) == len(broken)
    assert any(said in line for line in told)


def test_an_undercut_profile_of_a_rocker_is_told_in_degrees() -> None:
    found = solve(ROCKER, set={"R_roller": "34 mm"})
    rocker = SolvedCam.of(found.solved).rocker
    assert rocker is not None
    (cut,) = rocker.profile.undercuts

    start, end, lost = (math.degrees(angle) for angle in (cut.start, cut.end, cut.lost))

    said = f"undercut: from {start:.4g}° to {end:.4g}° the rocker loses up to {lost:.3g}° of its swing"
    assert any(said in warning.text("en") for warning in found.warnings)
    told = found.checks["undercut_rocker"]
    assert (told["ok"], told["unit"], told["value"]) == (False, "rad", pytest.approx(cut.lost))


@pytest.mark.parametrize(
    ("rotation", "limits"),
    [
        ("cw", "two-sided"),
        *(pytest.param(*both, marks=pytest.mark.soak) for both in (("ccw", "two-sided"), ("ccw", "one-sided"))),
        pytest.param("cw", "one-sided", marks=pytest.mark.soak),
    ],
)
def test_a_given_pivot_costs_radius_and_keeps_the_limits(rotation: str, limits: str) -> None:
    words = {"rotation": rotation, "limits": limits}

    free, given = solve(ROCKER, set=words), solve(ROCKER, set=words | {"l_OC": "140 mm"})

    assert given["l_OC"].value == pytest.approx(0.14, rel=1e-12)
    assert given["r_0"].value > free["r_0"].value
    for found in (free, given):
        assert found.checks["gamma_rise"]["ok"]
        assert found.checks["gamma_fall"]["ok"]
        assert found.warnings == ()


def test_the_stroke_of_a_rocker_is_calculated_on_the_board() -> None:
    solved = solve(ROCKER).solved
    steps = {step.name: step for step in solved.program}

    assert (steps["h"].verb, steps["h"].law, steps["h"].operands) == ("calc", "arc_length", ("psi", "l_rocker"))
    assert "h" not in solved.givens
    assert solved.values["h"] == pytest.approx(solved.givens["psi"] * solved.givens["l_rocker"], rel=1e-15)


# what is listed and told


@cache
def names(task: str, *plans: str) -> frozenset[str]:
    return frozenset(solve(task, only=plans).to_json()["quantities"])


@TASKS
def test_only_a_plan_lists_what_it_adds_and_together_they_list_everything_once(task: str) -> None:
    whole = solve(task)
    layout = SolvedCam.of(whole.solved).layout
    steps = {plan: {step.name for step in construct(layout, (plan,))} for plan in PLANS}

    assert names(task, "diagrams") - GIVEN <= steps["diagrams"]
    assert names(task, "sizes") - GIVEN <= steps["sizes"] - steps["diagrams"]
    assert names(task, "profile") - GIVEN <= steps["profile"] - steps["sizes"]
    assert names(task, "pressure") == {*PRESSURES}
    assert sum(len(names(task, plan)) for plan in PLANS) == len(whole) + len(PRESSURES)
    assert {*whole.to_json()["quantities"]} == {*whole}
    assert names(task, "sizes", "profile") == names(task, "sizes") | names(task, "profile")
    assert {section_of(name) for name in whole} <= {section for sections in OF_PLAN.values() for section in sections}
    assert solve(task, only="pressure")["r_0"].value == whole["r_0"].value  # solved, though it is not listed


def test_the_list_has_the_chosen_scale_factors_beside_their_segments() -> None:
    found = solve(TASK, scales={"mu_s_ds": 0.0004}, lang="en")
    rows = {row[0]: row[1:] for row in map(str.split, found.table().splitlines()) if row}

    assert rows["mu_s_ds"] == ["0.0004", "m/mm"]
    assert (rows["mu_l"], rows["mu_s_d2s"][1]) == (["0.001", "m/mm"], "m/mm")
    assert float(rows["r_0"][2]) == pytest.approx(float(rows["r_0"][0]) / 0.4, abs=0.01)
    assert not {"mu_s_ds", "mu_l"} & {*found.to_json()["quantities"]}  # there they stand under `scales`


def test_people_read_degrees_and_millimetres_or_what_a_file_says_and_machines_si(tmp_path: Path) -> None:
    own = (
        Path(ROCKER)
        .read_text(encoding="utf-8")
        .replace("[givens]", '[display]\nlength = "cm"\nangle = "rad"\n\n[givens]')
    )
    (tmp_path / "own.toml").write_text(own, encoding="utf-8")

    for task, shown in ((TASK, "° mm m/s"), (ROCKER, "° mm m/s"), (tmp_path / "own.toml", "rad cm cm/s")):
        found = solve(task, lang="en")
        rows = {row[0]: row[2] for row in map(str.split, found.table().splitlines()) if len(row) > 2}
        assert " ".join(rows[name] for name in ("nu", "r_0", "v_max")) == shown
        assert found.to_json()["quantities"]["gamma_rise_min"]["unit"] == "rad"


def test_the_reconstructed_law_is_told_wherever_the_cam_is() -> None:
    for lang in ("uk", "ru", "en"):
        note = load_task(TASK).note[lang]
        found = solve(TASK, lang=lang, only="pressure")

        assert found.to_json()["note"] == note
        assert f"<p>{note}</p><pre>" in found._repr_html_()
    drawn = read(sheet(TASK, only="diagrams", lang=lang).svg())
    assert note in " ".join(" ".join(lines_of(drawn["choices"])).split())
    assert "note" not in solve("nau-slider-crank").to_json()


def test_a_task_whose_source_prints_no_answers_says_so() -> None:
    with pytest.raises(InputError, match="the source of rocker-cam prints no answers"):
        check(ROCKER, lang="en").read("printed")


def test_the_document_names_every_law_and_every_column_and_its_python_runs() -> None:
    swept = kulman.sweep(TASK, positions=8)
    assert isinstance(swept, CourseSweep)
    columns = [column.partition(" ")[0] for column in swept.csv("en").splitlines()[0].split(",")[1:]]
    (block,) = re.findall(r"```python\n(.*?)```", DOCUMENT, re.DOTALL)
    defined: dict[str, Any] = {}

    exec(block, defined)

    assert [name for name in (*columns, *LAWS) if f"`{name}`" not in DOCUMENT] == []
    assert defined["solution"].solved.roller.sizes.on == ("rise", "fall")
    assert len(defined["swept"].csv("en").splitlines()) == 361


# what a cam measures on paper


@pytest.fixture(scope="module")
def small() -> Solution:
    return solve(TASK, format="A3")


@pytest.fixture(scope="module")
def drawn() -> Sheet:
    return sheet(TASK, format="A3")


def test_a_small_sheet_is_one_of_smaller_drawn_lengths(small: Solution, solution: Solution) -> None:
    for name, quantity in solve(TASK, set=SMALL).quantities.items():
        assert small[name].value == pytest.approx(quantity.value, rel=1e-12, abs=1e-15), name
    data = json.loads(json.dumps(small.to_json()))
    for symbol, scale in data["scales"].items():
        if symbol in data["quantities"]:
            assert scale["value"] == data["quantities"][symbol]["value"], symbol
    for name, item in data["quantities"].items():
        if "mm" in item:
            assert item["mm"] == pytest.approx(abs(item["value"]) / data["scales"][item["scale"]]["value"]), name
    assert small["S_max_chord"].value == pytest.approx(0.5 * solution["S_max_chord"].value)
    assert small["A_1"].mm == pytest.approx(0.5 * 110.0)


def test_a_small_sheet_prints_what_is_solved_for_it_and_says_that_it_is_smaller(small: Solution, drawn: Sheet) -> None:
    views = read(*(drawn.svg(page) for page in range(1, len(drawn.pages) + 1)))
    diagrams = {MU_S: "mu_s", MU_DS: "mu_ds", MU_D2S: "mu_d2s"}
    for view, own in (("diagrams", diagrams), ("sizes", {MU_S_DS: "mu_s_ds"}), ("plate_sizes", {MU_S_D2S: "mu_s_d2s"})):
        printed = printed_scales(views[view])
        for symbol, name in own.items():
            assert printed[symbol] == pytest.approx(small.scales[name].mu, rel=5e-5), name
    assert measured(views["sizes"], "r_0") == pytest.approx(small["r_0"].mm, abs=0.01)
    said = " ".join(lines_of(views["choices"]))
    assert "0,5 заданих довжин: l_{A1} = 55 мм; H_{a} = 15 мм; H_{v} = 15 мм; 1 мм осі φ відповідає 2°" in said
    assert {"110", "30"} <= {text.string for text in views["givens"].texts}  # the table has what the task gives
    told = "on A3 the diagrams have no room: they are drawn at 0.5 of their size, with l_A1 = 55 mm, H_a = 15 mm"
    for warnings in (small.warnings, drawn.warnings):
        assert [warning.key for warning in warnings if warning.key != "scales-changed"] == ["cam-smaller"]
        assert warnings[0].text("en").startswith(told)


def test_scale_factors_are_those_of_the_usual_sheet_or_chosen(solution: Solution) -> None:
    usual = sheet(TASK)

    assert all(scale.mu == solution.scales[SCALES[plan]].mu for plan, scale in usual.scales.items())
    assert not any("заданих довжин" in line for line in lines_of(read(usual.svg())["choices"]))
    for symbol in EQUAL:
        chosen = solve(TASK, scales={symbol: 0.0005})
        assert chosen.scales[symbol].mu == 0.0005
        assert chosen["r_0" if symbol == "mu_s_ds" else "r_0_flat_min"].scale == symbol
    with pytest.raises(InputError, match=r"^mu_l = 0\.0001 m/mm: the plan has no room on A1; take a coarser scale"):
        sheet(TASK, scales={"mu_l": 0.0001}, only="profile")


def test_what_is_drawn_on_a_small_sheet_is_marked_by_it(tmp_path: Path, small: Solution) -> None:
    answers, own = tmp_path / "answers.csv", (small["s_max"].value or 0.0) / 40.2  # from the student's own segment
    answers.write_text(f"quantity,value\nS_max_chord,40.2\nmu_s,{own!r}\n", encoding="utf-8")

    for format, verdicts in ((None, ["wrong", "carried"]), ("A3", ["right", "right"])):
        asked = check(TASK, "17", lang="en", format=format, only="diagrams")
        (found,) = asked.read(str(answers))
        lines = to_json(asked.mark(found))["lines"]
        assert [line["verdict"] for line in lines if line["quantity"] in ("S_max_chord", "mu_s")] == verdicts
