"""Gear pairs of files solved and swept: faults, units, checks, warnings, limits, conditions, what the document says."""

import csv
import io
import json
import math
import random
import re
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kulman
from kulman import solve, sweep
from kulman.plans.gears.course import GearCourse
from kulman.plans.gears.gear import CCW, CW, PLANS, STANDARD, GearPair
from kulman.plans.gears.geometry import _geometry_program
from kulman.plans.gears.solve import SECTIONS, WHOLE, SolvedGear, conditions_of, scale_errors, section_of, solve_gear
from kulman.plans.hands.shaky import paper_of, preset
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.commands import Run
from kulman.tests.support.gears import SEED, contacts, counted_ratio, madi, random_pairs
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.making.new_variants import _ranges_of
from kulman.variants.reader import check_text, load_task, read_text
from kulman.variants.shelf import bundled_text
from kulman.variants.solution import Solution

CASES = [
    pytest.param({}, CCW, id="project"),
    pytest.param({"x_1": -0.3}, CW, id="undercut"),
    pytest.param({"z_1": 60.0, "z_2": 90.0, "x_1": 0.0, "x_2": 0.0}, CCW, id="many teeth"),
    pytest.param({"x_1": 1.3, "x_2": 0.5}, CW, id="hardly two pairs"),
]
NEARLY = {"m": 5.0, "x_1": 0.2, "x_2": 0.85, "alpha": 20.0, "h_a": 1.0, "h_l": 2.0, "c": 0.25}  # that may err
TASK = "madi-gear"
DOCUMENT = (Path(kulman.__file__).parent / "docs" / "gears.md").read_text(encoding="utf-8")
TEXT = bundled_text(TASK)
# modules of GOST 9563-60
FIRST_ROW = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25)
SECOND_ROW = (1.125, 1.375, 1.75, 2.25, 2.75, 3.5, 4.5, 5.5, 7, 9, 11, 14, 18, 22)
BOTH = "x_1 = 0.2\nx_2 = 0.85\n"
BAD = [
    ("z_1 = 15", "z_1 = 2", "variant.z_1", "from 3 to 10000"),
    ("z_2 = 20", "z_2 = 20.5", "variant.z_2", "z_2 = 20.5: a wheel has a whole number"),
    ('m = "5 mm"', "m = 0", "variant.m", "must be greater than zero"),
    ('m = "5 mm"', "m = -5", "variant.m", "must be greater than zero"),
    ('m = "5 mm"', 'm = "5 deg"', "variant.m", "the unit deg does not fit"),
    ("x_1 = 0.2", "x_1 = 3", "variant.17", "x_1 = 3 leaves wheel 1 no tooth"),  # pointed below its flank
    ("x_1 = 0.2", "x_1 = -1.4", "variant.17", "x_1 = −1.4 leaves wheel 1 no tooth"),  # cut away
    (BOTH, "x_1 = -0.5\nx_2 = -0.4\n", "variant.17", "the pair cannot mesh"),
    (BOTH, "a_w = 60\n", "variant.17", "a_w = 60 mm: the pair cannot mesh"),
    (BOTH, "a_w = 95\nx_1 = 3\n", "variant.17", "from x_1, a_w follows"),
    ("x_2 = 0.85\n", "", "variant.x_1", "given are: x_1; expected two of x_1, x_2"),
    (BOTH, BOTH + "a_w = 92\n", "variant.x_1", "given are: x_1, x_2, a_w"),
    ('"20 deg"', '"40 deg"', "givens.alpha.default", "expected a profile angle of the rack"),
    ("z_1 = 15\n", "z_1 = 15\nalpha = 9\n", "variant.alpha", "alpha = 9°: expected a profile"),
    ("z_1 = 15\n", "z_1 = 15\nh_l = 3\n", "variant.h_l", "no rack has such teeth"),
    ("z_1 = 15\n", "z_1 = 15\nc = -1\n", "variant.c", "must not be negative"),
    ("z_1 = 15\n", 'z_1 = 15\nmaterial = "soft"\n', "variant.material", "'soft' is not a choice"),
    ("m = { unit", "mm = { unit", "givens.mm", "'mm' is no number of a gear pair"),
    ('m = { unit = "mm"', 'm = { unit = "deg"', "givens.m", "not a quantity of this kind; expected one in mm"),
    ('rotation = "rotation"', 'sense = "ccw"', "gear.sense", "unknown key 'sense'"),
    ('rotation = "rotation"', 'rotation = "left"', "gear.rotation", "'left' is not a choice"),
    ("mu_l =", "mu_s =", "scales.mu_s", "has no scale factor 'mu_s'"),
    ('"geometry", ', '"sizes", ', "plans", "known are: geometry, meshing, sliding"),
]
edited = partial(with_changes, TEXT)


def solved_for(others: dict[str, float], rotation: str) -> SolvedGear:
    return solve_gear(GearPair(rotation), madi(**others))


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK, lang="en")


def test_every_calculated_quantity_is_there_in_si_with_its_unit(solution: Solution) -> None:
    others = {"mu_rho": "m/mm", "mu_theta": "1/mm"}
    begin = {"rad": "alpha_ tau_ nu_ phi_", "1": "x_ inv_ epsilon_ theta_ z_W u y delta_y"}
    assert {name for name in _geometry_program().names if not name.startswith("_")} <= set(solution)
    for name, quantity in solution.quantities.items():
        if quantity.unit in begin:
            assert name.startswith(tuple(begin[quantity.unit].split()))
        else:
            assert quantity.unit == others.get(name, "m")
    assert solution["d_a1"].value == pytest.approx(0.0854997, abs=5e-8)
    assert (solution["a_w"].mm, solution["a_w"].scale) == (pytest.approx(460.0, abs=1e-3), "mu_l")


def test_infinite_sliding_is_null_in_json_and_a_dash_in_the_table(solution: Solution) -> None:
    data = json.loads(json.dumps(solution.to_json(), allow_nan=False))["quantities"]
    assert [name for name, item in data.items() if item.get("value", 0.0) is None] == ["theta_12_01", "theta_21_12"]
    assert [name for name in data if name.endswith("_01")] == ["y_1_01", "y_2_01", "theta_12_01", "theta_21_01"]
    assert any(line.split() == ["theta_12_01", "–"] for line in solution.table().splitlines())


@pytest.mark.parametrize(
    ("settings", "failing", "told"),
    [
        ({"x_1": 0.1}, {"undercut_1"}, ("x_1 = 0.1 is less than 0.1227",)),
        (
            {"x_1": 1.3, "x_2": 0.3},
            {"interference_1", "contact_ratio", "tip_1"},
            ("rho_l1 = 17.21 mm is greater than rho_p1 = 16.97 mm", "contact ratio 1.01", "s_a1 = 1.286 mm"),
        ),
        (
            {"z_1": 12, "x_1": 0.3, "x_2": 1.6},
            {"interference_2", "contact_ratio"},
            ("wheel 2", "less than 1: for a part of the turn"),
        ),
        ({"material": "hardened", "x_1": 0.6}, {"contact_ratio"}, ("1.2, the least advised",)),
        ({"x_1": 2.5, "x_2": 0.4}, {"tip_1", "interference_1", "contact_ratio"}, ("its teeth are pointed",)),
    ],
)
def test_limits_that_are_not_kept_are_told(
    settings: dict[str, object], failing: set[str], told: tuple[str, ...], solution: Solution
) -> None:
    found = solve(TASK, set=settings)  # type: ignore[arg-type]
    assert failing <= {name for name, check in found.checks.items() if not check["ok"]}
    warnings = [warning.text("en") for warning in found.warnings]
    assert all(any(text in warning for warning in warnings) for text in told), warnings
    assert not [text for language in LANGUAGES for text in (w.text(language) for w in found.warnings) if "{" in text]
    assert solution.warnings == ()


def test_contact_of_cut_flanks_is_judged_by_what_is_left_of_them() -> None:
    for z_1, z_2, ratio in ((8, 25, 0.9127), (7, 7, 0.3768)):
        found = solve(TASK, set={"z_1": z_1, "z_2": z_2, "x_1": 0, "x_2": 0})

        assert found.checks["contact_ratio"]["ok"]  # by the formula, which counts the flanks that are cut away
        assert not found.checks["contact_flanks"]["ok"]
        assert found.checks["contact_flanks"]["value"] == pytest.approx(ratio, abs=1e-4)
        assert counted_ratio(found.solved.meshing) == pytest.approx(ratio, abs=2e-3)
        assert any("less than 1: for a part of the turn no flanks touch" in w.text("en") for w in found.warnings)


def test_angles_may_miss_what_their_marks_miss_and_what_honest_drawings_give_is_let_pass(solution: Solution) -> None:
    paper = paper_of(solution.solved, {scale.symbol: scale.mu for scale in solution.scales.values()})
    drawing = solve(TASK, hand="normal").drawing

    careful, normal = (
        solution.kind.limits(solution.solved, paper, preset(name).tolerance) for name in ("careful", "normal")
    )

    assert {"phi_alpha1_drawn", "phi_alpha2_drawn", "epsilon_alpha_arc1", "epsilon_alpha_arc2"} <= set(normal)
    assert math.radians(1.0) < normal["phi_alpha1_drawn"] < math.radians(4.0)
    assert all(careful[name] < limit for name, limit in normal.items())
    assert normal["epsilon_alpha_arc1"] == pytest.approx(normal["phi_alpha1_drawn"] / solution["tau_1"].value, rel=1e-6)
    assert drawing is not None
    assert [name for name, expected in drawing.expected.items() if expected.failed > 0.06] == []


def test_conditions_tell_how_quantities_hang_on_the_data() -> None:
    found = solve(TASK, condition=True)
    known = {name: condition.value for name, condition in found.conditions.items()}

    assert set(known) == set(found)
    assert known["a"] == pytest.approx(1.0, rel=1e-8)  # m alone, for whole numbers do not err
    assert known["d_b1"] == pytest.approx(1.0 + 20.0 * math.tan(math.radians(20.0)) * math.pi / 180.0, rel=1e-8)
    assert known["tau_1"] == known["u"] == 0.0
    assert known["mu_theta"] == pytest.approx(1.0)
    assert known["theta_12_01"] is None
    assert known["rho_l1"] > 10.0 > known["rho_l2"]  # nearly undercut
    assert found.conditions["g_alpha_drawn"].sine == pytest.approx(math.sin(found["alpha_a1"].value or 0.0), rel=1e-12)
    total = 0.0  # by the givens of a task, one after the other
    for name, value in NEARLY.items():
        more, less = (solve(TASK, set={name: value * (1.0 + step)})["g_alpha"].value for step in (1e-4, -1e-4))
        total += abs((more or 0.0) - (less or 0.0)) / 2e-4
    assert known["g_alpha"] == pytest.approx(total / (found["g_alpha"].value or 1.0), rel=1e-5)


@pytest.mark.parametrize("count", [5, pytest.param(100, marks=pytest.mark.soak)])
def test_no_quantity_of_a_pair_loses_more_than_its_condition_says(count: int) -> None:
    random, err = np.random.default_rng(SEED), 1e-7
    pairs = random_pairs(random, count)
    for i in range(count):
        numbers = {name: float(values[i]) for name, values in pairs.items()}
        right = solve_gear(GearPair(), numbers)
        erring = {
            name: value if name in WHOLE else value * (1.0 + err * random.choice((-1.0, 1.0)))
            for name, value in numbers.items()
        }
        there = solve_gear(GearPair(), erring)

        for name, condition in conditions_of(right).items():
            value, moved = right.values[name], there.values[name]
            if condition.value is None or not math.isfinite(value):
                continue
            size = max(abs(value), numbers["m"]) if name in right.shown_on else abs(value)
            assert abs(moved - value) <= err * (condition.value * 1.001 + 1e-3) * size, (i, name)


@pytest.mark.parametrize(("others", "rotation"), CASES)
def test_columns_are_what_turned_wheels_show(others: dict[str, float], rotation: str) -> None:
    solved = solved_for(others, rotation)
    meshing, sense = solved.meshing, solved.pair.sense
    rho_1 = np.linspace(*meshing.touching, 7)

    found = {column.name: column.values for column in GearCourse(solved).columns(rho_1)}

    for k, rho in enumerate(rho_1.tolist()):
        place = meshing.place(rho)
        across = meshing.along * 1j  # along both profiles
        turning = (sense * 1.0, -sense * solved.givens["z_1"] / solved.givens["z_2"])
        v_1, v_2 = (  # the pinion's velocity along its profile counts as positive
            sense * (across.conjugate() * (1j * rate * (place - centre))).real
            for rate, centre in zip(turning, meshing.centres, strict=True)
        )
        shown = {"v_k1": v_1, "v_k2": v_2, "v_s": v_1 - v_2, "phi": meshing.angle(rho)}
        shown |= {f"r_{i}": abs(place - centre) for i, centre in enumerate(meshing.centres, 1)}
        assert {name: found[name][k] for name in shown} == pytest.approx(shown, rel=1e-13, abs=1e-15)
        slides = (found["theta_12"][k], found["theta_21"][k])
        assert slides == pytest.approx(((v_1 - v_2) / v_1, (v_2 - v_1) / v_2), abs=1e-10)
        if 0 < k < 6:
            assert found["pairs"][k] == len(contacts(meshing, meshing.angle(rho)))


@pytest.mark.parametrize(("others", "rotation"), CASES)
def test_zones_follow_one_another_and_hold_as_many_pairs_as_touch(others: dict[str, float], rotation: str) -> None:
    solved = solved_for(others, rotation)
    first, last = solved.meshing.touching
    course = GearCourse(solved)

    assert (course.zones[0].first, course.zones[-1].last) == (first, pytest.approx(last, rel=1e-14))
    assert all(a.last == b.first and a.pairs != b.pairs for a, b in pairwise(course.zones))
    for zone in course.zones:
        for part in (0.01, 0.5, 0.99):
            rho = zone.first + part * (zone.last - zone.first)
            touching = len(contacts(solved.meshing, solved.meshing.angle(rho)))
            assert touching == zone.pairs == course.pairs(np.array(rho))
    # as many pairs as touch on average over a pitch
    mean = sum(zone.last - zone.first for zone in course.zones) / solved.sizes["p_b"]
    assert mean == pytest.approx(counted_ratio(solved.meshing, 4000), abs=2e-3)


def test_extremes_are_at_the_ends_of_the_contact_and_ends_of_an_undercut_one_are_called_otherwise() -> None:
    solved = solved_for({}, CCW)
    course, rho_1 = GearCourse(solved), np.linspace(*solved.meshing.touching, 1001)
    fine = {column.name: column.values for column in course.columns(rho_1)}
    for one in course.extremes():
        assert (one.most, one.least) == (np.max(fine[one.name]), np.min(fine[one.name]))
    least = {one.name: one.least for one in course.extremes()}["theta_12"]
    assert least == pytest.approx(solved.sizes["theta_12_A1"], rel=1e-13)  # arrays and numbers round apart by machine
    assert list(course.marks) == ["A1", "K2", "P", "K1", "A2"]
    assert next(iter(GearCourse(solved_for({"z_1": 10.0, "x_1": -0.2}, CCW)).marks)) == "start"


def test_table_csv_and_json_tell_the_same(tmp_path: Path, run: Run) -> None:
    swept = sweep(TASK, lang="en", positions=5)

    head, *rows = csv.reader(io.StringIO(swept.csv()))
    data = json.loads(json.dumps(swept.to_json()))

    assert (head[:4], head[-1], len(rows)) == (["k", "phi [°]", "rho_1 [mm]", "rho_2 [mm]"], "pairs", 5)
    for k, row in enumerate(rows):
        assert float(row[2]) * 1e-3 == pytest.approx(data["columns"]["rho_1"]["value"][k], rel=1e-15)
        assert math.radians(float(row[1])) == pytest.approx(data["columns"]["phi"]["value"][k], abs=1e-9)
    assert f"{data['columns']['theta_12']['value'][0]:.3f}".replace("-", "−") in swept.table()
    assert [line.split()[0] for line in swept.table().partition("\n\n")[0].splitlines()[1:]] == [*"01234"]
    assert [zone["pairs"] for zone in data["zones"]] == [2, 1, 2]
    _, out, _ = run("sweep", TASK, "-o", tmp_path / "x.csv", "--lang", "uk")
    assert (tmp_path / "x.csv").read_bytes().count(b"\r\n") == 102
    assert out.strip().endswith("x.csv")


def test_what_a_pair_has_not_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    for symbol in ("mu_V", "mu_rho"):
        with pytest.raises(InputError):
            solve(TASK, scales={symbol: "0.05"})
    for asked in ({"points": "A"}, {"start": "3 deg"}, {"chords": "B"}):
        with pytest.raises(InputError) as refused:
            sweep(TASK, **asked)  # type: ignore[arg-type]
        assert refused.value.key == "kind-without"
    with pytest.raises(InputError) as refused:
        sweep(TASK).save(tmp_path / "a.csv", tmp_path / "b.svg")
    assert refused.value.key == "sweep-drawing"
    assert not list(tmp_path.iterdir())


def test_the_document_names_every_quantity_check_and_column_and_its_python_runs() -> None:
    solution, swept = solve(TASK), sweep(TASK)
    names = [name for name in solution.quantities if not re.match(r"(y|theta)_.*\d\d$|mu_|PW$", name)]
    of_pinion = {name: re.sub(r"(?<=[A-Za-z_])2(?=_|$)", "1", name) for name in names}  # of the wheel alike
    columns = [column.partition(" ")[0] for column in swept.csv("en").splitlines()[0].split(",")[1:]]
    checks = {re.sub(r"2$", "1", name) for name in solution.checks if not name.startswith("centre")}
    (block,) = re.findall(r"```python\n(.*?)```", DOCUMENT, re.DOTALL)
    run: dict[str, Any] = {}

    exec(block, run)

    prose = re.sub(r"```.*?```", "", DOCUMENT, flags=re.DOTALL)
    named = {found for quoted in re.findall(r"`([^`]+)`", prose) for found in quoted.split()}
    assert [name for name in names if not named & {name, of_pinion[name]}] == []
    assert [name for name in (*columns, *checks) if name not in named] == []
    assert run["solution"]["z_W1"].value == 2.0
    assert len(run["pinion"]) > 1000


def test_only_the_plans_wanted_are_built_in_sections_that_have_headings(solution: Solution) -> None:
    for only, sections, drawn in (
        ("geometry", SECTIONS[:6], ()),
        ("meshing", SECTIONS[:7], ("meshing",)),
        ("sliding", (*SECTIONS[:6], SECTIONS[7]), ("sliding", "theta")),
        ("sliding,meshing", SECTIONS, ("meshing", "sliding", "theta")),
    ):
        found = solve(TASK, only=only)
        assert found.case.plans == tuple(plan for plan in PLANS if plan in only.split(","))
        assert tuple(dict.fromkeys(map(section_of, found))) == sections
        assert tuple(found.solved.scale_of_plan) == drawn
        assert set(PLANS) >= {*only.split(",")}
    for language in LANGUAGES:
        headings = solution.kind.headings(solution.solved, solution.words.speaking(language))
        assert [section_of(name) for name in headings] == list(SECTIONS)
        assert {*headings.values()} <= {*solution.table(language).splitlines()}


def test_words_of_a_variant_take_the_place_of_choices_stand_in_the_table_or_are_left_out() -> None:
    task = load_task(TASK)
    said = edited(
        ('rotation = "rotation"', 'rotation = "cw"'),
        ('material = "material"\n', ""),
        (TEXT[TEXT.index("rotation = { choices") : TEXT.index("\n[gear]")], ""),
        ('"rotation", "material", ', ""),
    )

    assert isinstance(task.subject, GearPair)
    pair = task.subject.chosen(task.words("17", {"rotation": "cw", "material": "hardened"}))
    assert (pair.sense, pair.least_tip) == (-1, 0.4)
    assert (GearPair().sense, GearPair().least_tip) == (1, 0.3)
    assert task_of(said).subject == GearPair("cw", "homogeneous")


def test_numbers_of_the_standard_rack_need_not_be_given_and_may_be_set() -> None:
    names = tuple(f"{name} = {{ unit" for name in ("alpha", "h_a", "h_l", "c", "PW"))
    standard = [line for line in TEXT.splitlines(keepends=True) if line.startswith(names)]
    task = task_of(edited(*((line, "") for line in standard)))
    assert len(standard) == 5
    assert {name: task.values("17")[name] for name in STANDARD} == pytest.approx(STANDARD)
    assert solve(task)["a_w"].value == pytest.approx(solve(TASK)["a_w"].value, rel=1e-15)


@pytest.mark.parametrize(
    ("given", "shifts"),
    [("x_1 = 0.2\na_w = 92\n", 1), ("x_2 = 0.85\nx_sum = 1.05\n", 1), ("a_w = 92\n", 2), ("x_sum = 1\n", 2)],
)
def test_a_variant_may_give_the_centre_distance_or_the_sum_in_the_place_of_shifts(given: str, shifts: int) -> None:
    solution = solve(task_of(edited((BOTH, given))))
    found = [name for name in ("x_1", "x_2") if name in solution.quantities]
    assert len(found) == shifts
    for line in given.split("\n")[:-1]:
        name, value = line.split(" = ")
        if name in solution:
            assert solution[name].value == pytest.approx(float(value) * (1e-3 if name == "a_w" else 1.0), rel=1e-12)
    if shifts == 2:  # equal sliding
        assert solution["theta_12_A1"].value == pytest.approx(solution["theta_21_A2"].value, rel=1e-9)


def test_faults_of_a_file_are_told_with_their_places_once_for_all_variants() -> None:
    for old, new, place, message in BAD:
        faults, _ = check_text(edited((old, new)), "t.toml")

        told = [fault.text("en") for fault in faults]
        assert any(f"{place}: " in line and message in line for line in told), told
        texts = [fault.text(language) for fault in faults for language in LANGUAGES]
        assert not [text for text in texts if "{" in text or "\n" in text]
    second = TEXT[TEXT.index("[[variant]]") :].replace('id = "17"', 'id = "18"')
    assert len(read_text(edited(('"20 deg"', '"40 deg"')) + "\n" + second, "t.toml")[1]) == 1


def test_what_a_user_sets_stands_in_the_place_of_the_shifts_of_the_variant() -> None:
    by_centre = solve(TASK, set={"a_w": "92 mm"})
    both = solve(TASK, set={"a_w": "92 mm", "x_1": 0.3})
    own = task_of(edited((BOTH, "a_w = 92\n")))

    assert by_centre["a_w"].value == pytest.approx(0.092, rel=1e-13)
    assert by_centre["theta_12_A1"].value == pytest.approx(by_centre["theta_21_A2"].value, rel=1e-9)
    assert both.solved.givens["x_1"] == 0.3
    assert both["a_w"].value == pytest.approx(0.092, rel=1e-13)
    assert solve(TASK, set={"x_1": 0.3}).solved.givens["x_2"] == 0.85
    assert solve(own, set={"x_1": 0.1, "x_2": 0.3})["x_sum"].value == pytest.approx(0.4)
    assert solve(own, set={"x_sum": 0.9})["x_sum"].value == pytest.approx(0.9)
    assert load_task(TASK).resolve("17", {"a_w": 92})["m"] == 0.005


def test_bad_values_of_a_user_are_told_in_one_line() -> None:
    for settings, message in (
        ({"z_1": 2}, "z_1 = 2: a wheel has a whole number of teeth, from 3 to 10000"),
        ({"alpha": 40}, "alpha = 40°: expected a profile angle of the rack from 10° to 35°"),
        ({"x_1": 3}, "x_1 = 3 leaves wheel 1 no tooth"),
        ({"a_w": 80}, "a_w = 80 mm: the pair cannot mesh"),
        ({"x_sum": 100}, "from x_sum follows x_1 = "),
        ({"m": 0}, "m: '0': must be greater than zero"),
    ):
        with pytest.raises(InputError) as refused:
            solve(TASK, set=settings)
        assert message in refused.value.text("en")
        assert len({refused.value.text(language) for language in LANGUAGES}) == len(LANGUAGES)


@pytest.mark.parametrize(
    ("asked", "modules"),
    [
        pytest.param({}, (4, 4.5, 5, 5.5, 6), id="round that of the task"),
        pytest.param({"m": "1..25"}, (*FIRST_ROW, *SECOND_ROW), id="a range"),
        pytest.param({"m": "4..5/0.2"}, (4, 4.2, 4.4, 4.6, 4.8, 5), id="a range with a step"),
    ],
)
def test_new_variants_have_standard_modules_unless_a_step_is_said(
    asked: dict[str, str], modules: tuple[float, ...]
) -> None:
    span, luck = _ranges_of(load_task(TASK), asked)["m"], random.Random(5)
    assert {span.pick(luck) for _ in range(2000)} == {f"{m:g} mm" for m in modules}


@pytest.mark.parametrize(
    "given", [{"x_sum": 0.6}, {"x_sum": 0.0}, {"a_w": 0.0975}, {"x_1": 0.25, "x_2": 0.25}], ids=str
)
def test_a_pair_of_like_wheels_is_its_own_mirror_image(given: dict[str, float]) -> None:
    values = {"m": 3e-3, "z_1": 32.0, "z_2": 32.0, **given}

    solved = solve_gear(GearPair(), values)

    sizes, conditions = solved.sizes, conditions_of(solved)
    assert sizes["x_1"] == pytest.approx(sizes["x_2"], abs=1e-12)
    assert sizes["u"] == 1.0
    assert sizes["rho_w1"] == pytest.approx(0.5 * sizes["l_N1N2"], rel=1e-12)  # the pole halves the line of action
    mirrored = {"theta_12_A1": "theta_21_A2", "rho_p1": "rho_p2", "d_a1": "d_a2", "s_a1": "s_a2", "x_min1": "x_min2"}
    for one, other in mirrored.items():
        assert sizes[one] == pytest.approx(sizes[other], rel=1e-9), one
        assert conditions[one].value == pytest.approx(conditions[other].value, rel=1e-6), one
    checks = {check.name: check for check in solved.checks}
    for rule in ("undercut", "interference", "tip"):
        assert checks[f"{rule}_1"].value == pytest.approx(checks[f"{rule}_2"].value, rel=1e-9)


def test_scales_of_the_meshing_go_from_natural_size_up_the_series_of_gost_2_302() -> None:
    solved = SolvedGear.of(solve(TASK, only="meshing").solved)

    found = scale_errors(solved, {"careful": preset("careful").hand}, ("c_1",))

    assert found.ratios[0] == 1.0  # a millimetre of paper for one of the wheels
    assert {*found.ratios[1:]} <= {2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0, 100.0}
    assert found.ratios == tuple(sorted(found.ratios))
    # a segment is missed by so many millimetres of paper, however long it is
    assert found.errors["careful", "c_1"] * found.ratios == pytest.approx(found.errors["careful", "c_1"][0], rel=0.05)


@pytest.mark.parametrize(("mm", "drawn"), [(249.9, 249.9), (250.5, 125.25)])
def test_n1n2_takes_250_mm_at_most_under_the_diagrams_of_sliding(mm: float, drawn: float) -> None:
    usual = solve_gear(GearPair(), madi()).sizes["l_N1N2"]
    solved = solve_gear(GearPair(), madi(m=madi()["m"] * 1e-3 * mm / usual))

    assert solved.sizes["l_N1N2"] / solved.quantities["mu_rho"].value == pytest.approx(drawn)
