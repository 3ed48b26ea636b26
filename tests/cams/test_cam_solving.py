"""Tasks about cams solved: the construction on the board, rules, what is listed, told and measured on paper."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kulman
from kulman import check, load_task, sheet, solve
from kulman.plans.boards.exact import run
from kulman.plans.cams.cam import LAWS, PLANS, Cam
from kulman.plans.cams.construction import construct
from kulman.plans.cams.motion import motion_of
from kulman.plans.cams.solve import EQUAL, OF_PLAN, PRESSURES, SCALES, SolvedCam, diagram_givens, section_of, solve_cam
from kulman.plans.hands.shaky import draw, paper_of, preset
from kulman.scales.errors import InputError
from kulman.tests.support.cam_points import MU_D2S, MU_DS, MU_S, MU_S_D2S, MU_S_DS, measured, printed_scales
from kulman.tests.support.cams import ROCKER
from kulman.tests.support.printed_numbers import lines_of
from kulman.tests.support.readback import read, read_back
from kulman.variants.sheets import Sheet
from kulman.variants.solution import Solution
from kulman.variants.sweeps.sweeps import CourseSweep

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
    with pytest.raises(InputError, match=r"at r_0 = 45 mm no offset keeps .* takes at least 45\.2582 mm"):
        solve(TASK, set={"r_0": 45})
    assert "e_least" not in solution
    for name in ("e_least", "e_most"):  # at either end a limit is just kept
        at_end = solve(TASK, set={"r_0": "60 mm", "e": f"{wide[name]!r} m"}).solved.values
        slack = [at_end[f"gamma_{phase}_min"] - at_end[f"gamma_{phase}"] for phase in ("rise", "fall")]
        assert min(slack) == pytest.approx(0.0, abs=1e-9)
    aside = solve(TASK, set={"e": 100})  # pressed to one side alone: no more than a right angle
    assert aside["gamma_rise_min"].value == pytest.approx(math.pi / 2)
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
        assert f"<p>{note}</p><div" in found._repr_html_()
    drawn = read(sheet(TASK, only="diagrams", lang=lang).svg())
    assert note not in " ".join(" ".join(lines_of(drawn["choices"])).split())  # a student has no figure to lose
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


@pytest.mark.soak
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
    views = read_back(drawn)
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
        assert [warning.key for warning in warnings if not warning.key.startswith("scales-")] == ["cam-smaller"]
        assert warnings[0].text("en").startswith(told)


@pytest.mark.soak
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
        lines = asked.mark(found).to_json()["lines"]
        assert [line["verdict"] for line in lines if line["quantity"] in ("S_max_chord", "mu_s")] == verdicts


DEGREE = math.radians(1.0)
MADI = {**load_task("madi-cam").values("17"), "mu_phi": DEGREE}
FOLLOWERS = ("roller", "plate")
LAWS_OF_CHORDS = [
    law if law in ("sawtooth", "modified-sine") else pytest.param(law, marks=pytest.mark.soak)
    for law in LAWS
    if law != "uniform"
]


def test_the_scale_factors_of_the_project_follow_from_its_amplitude() -> None:
    # by hand: V = A u x / (2 H), S = A x^2 u (u + (1 - u)) / (6 H^2) * ... of a sawtooth, all in mm of paper
    v_max = 110 * 36 / 2 / 30
    s_max = (110 * 36**2 / 6 + (110 * 36 / 2) * 72 / 3) / 30**2
    mu_s = 0.013 / s_max
    mu_ds = mu_s / (DEGREE * 30)
    mu_d2s = mu_ds / (DEGREE * 30)
    by_hand = {"mu_s": mu_s, "mu_ds": mu_ds, "mu_d2s": mu_d2s, "mu_v": 200 * mu_ds, "mu_a": 200**2 * mu_d2s}
    by_hand |= {"ds_max": v_max * mu_ds, "nu": math.atan(mu_s / mu_ds), "l_A2": 0.055}

    found = solve_cam(Cam(FOLLOWERS, "sawtooth"), MADI).quantities

    assert {name: found[name].value for name in by_hand} == pytest.approx(by_hand, rel=1e-13)


def random_cams(count: int) -> list[tuple[Cam, dict[str, float]]]:
    """Return cams with random laws, phases, amplitudes, pole distances, both senses and orders of the fall."""
    random = np.random.default_rng(20261122)
    cams = []
    for _ in range(count):
        law, law_fall = random.choice(LAWS, 2)
        rise, fall = random.uniform(40, 150, 2)
        upper = random.choice([0.0, random.uniform(1, 60)])
        numbers = {"phi_rise": rise * DEGREE, "phi_upper": upper * DEGREE, "phi_fall": fall * DEGREE}
        numbers |= {"h": random.uniform(0.004, 0.06), "u": random.uniform(0.25, 0.75)}
        numbers |= {"l_A1": random.uniform(0.04, 0.2), "H_a": random.uniform(0.02, 0.06)}
        numbers |= {"H_v": random.uniform(0.02, 0.06), "gamma_rise": random.uniform(50, 80) * DEGREE}
        numbers |= {"gamma_fall": random.uniform(45, 80) * DEGREE}
        words = (str(random.choice(two)) for two in (("mirror", "same"), ("ccw", "cw"), ("one-sided", "two-sided")))
        cams.append((Cam(FOLLOWERS, str(law), str(law_fall), *words), MADI | numbers))
    return cams


MANY = pytest.mark.parametrize("count", [pytest.param(5, id="5"), pytest.param(40, id="40", marks=pytest.mark.soak)])


@MANY
def test_scale_factors_show_what_the_motion_has(count: int) -> None:
    for cam, values in random_cams(count):
        solved = solve_cam(cam, values, ("diagrams",))
        motion, found = solved.motion, solved.quantities

        assert found["s_max"].value == pytest.approx(values["h"], rel=1e-12)
        assert found["ds_max"].value == pytest.approx(motion.ds_max.value, rel=1e-12)
        if "A_1" in found:
            rise = motion.maximum(0.0, 0.0, 1.0, ("rise",)).value
            slowing = motion.maximum(0.0, 0.0, -1.0, ("rise",)).value
            assert found["A_1"].value == pytest.approx(rise, rel=1e-12)
            assert found["A_2"].value == pytest.approx(slowing, rel=1e-10)
            assert found["a_max"].value == pytest.approx(values["omega"] ** 2 * motion.d2s_max.value, rel=1e-12)


def errors(cam: Cam, sections: int, shift: float = 0.0) -> tuple[float, float]:
    """Return by which parts chords miss velocity and stroke; `shift` moves all inner section lines by a part."""
    motion = motion_of(cam, MADI)
    solved = solve_cam(Cam(cam.followers, cam.law, fall=cam.fall, sections=sections), MADI, ("diagrams",))
    division = replace(solved.layout.division, angles=solved.angles.copy())
    angles = division.angles
    inside = [i for i in division.lines if i not in (0, division.top, division.leave, division.last)]
    angles[inside] += shift * (angles[1] - angles[0])
    givens = solved.givens | diagram_givens(motion, division, "diagram_a")
    board = run(construct(solved.layout, ("diagrams",)), givens)
    drawn = (board.values["V_max_chord"] / board.values["_V_max"], board.values["S_max_chord"] / board.values["_S_max"])
    return abs(drawn[0] - 1.0), abs(drawn[1] - 1.0)


@pytest.mark.parametrize("law", LAWS_OF_CHORDS)
def test_chords_are_of_second_order_when_jumps_lie_on_nodes(law: str) -> None:
    few, many = (errors(Cam(FOLLOWERS, law), sections) for sections in (24, 96))

    for coarse, fine in zip(few, many, strict=True):
        assert fine < 2e-3
        assert fine < 1e-12 or math.log(coarse / fine, 4.0) > 1.8


@pytest.mark.parametrize("law", ["sawtooth", pytest.param("constant", marks=pytest.mark.soak)])
def test_chords_are_of_first_order_when_jumps_lie_between_nodes(law: str) -> None:
    coarse, fine = (errors(Cam(FOLLOWERS, law), sections, 0.3)[1] for sections in (24, 192))

    assert 0.7 < math.log(coarse / fine, 8.0) < 1.4


@MANY
def test_sizes_by_tangents_come_to_those_of_the_exact_curves(count: int) -> None:
    for cam, values in random_cams(count):
        fine = Cam(cam.followers, cam.law, cam.law_fall, cam.fall, cam.rotation, cam.limits, sections=96)
        solved = solve_cam(fine, values, ("sizes",))
        exact = solved.roller.by_tangents
        found = solved.quantities

        assert found["r_0_tangents"].value == pytest.approx(exact.r_0, rel=8e-3)
        assert found["e_tangents"].value == pytest.approx(exact.e, abs=8e-3 * exact.r_0)
        assert found["r_0"].value <= exact.r_0 * (1 + 1e-12)
        if solved.plate is not None:
            size = max(found["r_0_flat_min"].value, found["A_1"].value)
            kinks = "trapezoid" in cam.law + cam.falls_by  # lie between section lines: the curve is cut there
            part = 0.04 if kinks else 8e-3
            assert found["r_0_flat_tangent"].value == pytest.approx(solved.plate.sizes.r_0_min, abs=part * size)


@MANY
def test_profiles_by_inversion_are_the_exact_ones(count: int) -> None:
    rocking = [(Cam(("rocker",), "modified-sine", rotation="cw"), ROCKING | given) for given in ({}, {"l_OC": 0.12})]
    for cam, values in random_cams(count) + rocking:
        solved = solve_cam(cam, values)
        assert solved.rolling is not None
        profile, plate = solved.rolling.profile, solved.plate
        exact = {"profile.B": profile.pitch(solved.angles, -1), "profile.K": profile.practical(solved.angles, -1)}
        if plate is not None:
            exact["plate_profile.K"] = plate.profile.practical(solved.angles, -1)
        for mark, places in exact.items():
            for i in solved.layout.division.lines:
                assert solved.point(f"{mark}{i}") == pytest.approx(complex(places[i]), abs=1e-12)
        if "l_OC" in values:
            assert solved.quantities["l_OC"].value == pytest.approx(values["l_OC"], rel=1e-12)


def test_a_cam_for_one_follower_draws_nothing_of_the_other_and_profiles_where_they_are_wanted() -> None:
    plans = set(solve_cam(Cam(("plate",), "sine"), MADI).program.plans)

    assert "plate_profile" in plans
    assert plans.isdisjoint({"sizes", "profile"})
    assert [plan for plan in PLANS if solve_cam(Cam(FOLLOWERS, "sine"), MADI, (plan,)).draws_profiles] == ["profile"]


def test_a_hand_draws_the_cam_as_well_as_its_pencil_lets_it() -> None:
    solved = solve_cam(Cam(FOLLOWERS, "sawtooth"), MADI)
    hand = preset("normal").hand
    chosen = {"mu_l": 1e-3, **{symbol: solved.values[mu] for symbol, mu in EQUAL.items()}}
    board = draw(paper_of(solved, {**solved.values, **chosen}), hand, np.random.default_rng(1), 400)

    for name in ("mu_s_chord", "r_0_tangents"):
        exact = solved.values[name]
        spread = np.std(board.values[name]) / abs(exact)
        assert 1e-4 < spread < 0.3, name
        assert abs(np.mean(board.values[name]) / exact - 1.0) < spread
    assert np.std(board.values["mu_s"]) == 0.0  # calculated from data


ROCKING = {name: value for name, value in MADI.items() if name != "h"} | {
    **{"psi": 25 * DEGREE, "l_rocker": 0.1, "gamma_rise": 50 * DEGREE, "gamma_fall": 45 * DEGREE}
}


def test_sizes_that_are_given_are_kept_or_explained() -> None:
    at_r_0, at_e, at_both = (
        solve_cam(Cam(("roller",), "sine"), MADI | given).quantities
        for given in ({"r_0": 0.05}, {"e": 0.0}, {"r_0": 0.05, "e": 0.012})
    )

    assert at_r_0["r_0"].value == pytest.approx(0.05, rel=1e-14)
    assert at_r_0["e_least"].value < at_r_0["e"].value < at_r_0["e_most"].value
    assert at_r_0["gamma_rise_min"].value >= MADI["gamma_rise"]
    assert (at_e["e"].value, "e_least" in at_e) == (0.0, False)
    assert at_e["gamma_rise_min"].value == pytest.approx(MADI["gamma_rise"], rel=1e-12)
    assert (at_both["e"].value, at_both["r_0"].value) == pytest.approx((0.012, 0.05))
    with pytest.raises(InputError, match=r"r_0 = 20 mm .* at least 2[0-9.]+ mm"):
        solve_cam(Cam(("roller",), "sine"), MADI | {"r_0": 0.02})
