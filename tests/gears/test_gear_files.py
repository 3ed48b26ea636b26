"""Files of tasks about gears: what they may say, what is refused, where, and in three languages."""

from __future__ import annotations

import math
import random
from functools import partial

import pytest

from kulman import solve
from kulman.plans.gears.gear import STANDARD, GearPair
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.making.new_variants import _ranges_of
from kulman.variants.reader import check_text, load_task, read_text
from kulman.variants.shelf import bundled_text

TASK = "madi-gear"
TEXT = bundled_text(TASK)
BOTH = "x_1 = 0.2\nx_2 = 0.85\n"


edited = partial(with_changes, TEXT)


def test_words_of_a_variant_stand_in_the_place_of_the_names_of_choices() -> None:
    task = load_task(TASK)
    assert isinstance(task.subject, GearPair)

    pair = task.subject.chosen(task.words("17", {"rotation": "cw", "material": "hardened"}))

    assert (pair.sense, pair.least_tip) == (-1, 0.4)


def test_words_may_stand_in_the_table_itself_or_be_left_out() -> None:
    said = edited(
        ('rotation = "rotation"', 'rotation = "cw"'),
        ('material = "material"\n', ""),
        (TEXT[TEXT.index("rotation = { choices") : TEXT.index("\n[gear]")], ""),
        ('"rotation", "material", ', ""),
    )

    assert task_of(said).subject == GearPair("cw", "homogeneous")


def test_numbers_of_the_standard_rack_need_not_be_given_and_may_be_set() -> None:
    short = edited(*_without("alpha", "h_a", "h_l", "c", "PW"))

    task = task_of(short)

    assert {name: task.values("17")[name] for name in STANDARD} == pytest.approx(STANDARD)
    assert solve(task)["a_w"].value == pytest.approx(solve(TASK)["a_w"].value, rel=1e-15)


def _without(*names: str) -> list[tuple[str, str]]:
    lines = TEXT.splitlines(keepends=True)
    return [(next(line for line in lines if line.startswith(f"{name} = {{ unit")), "") for name in names]


@pytest.mark.parametrize(
    ("given", "shifts"),
    [
        pytest.param("x_1 = 0.2\na_w = 92\n", 1, id="centre distance"),
        pytest.param("x_2 = 0.85\nx_sum = 1.05\n", 1, id="sum"),
        pytest.param("a_w = 92\n", 2, id="equal sliding by the centre distance"),
        pytest.param("x_sum = 1\n", 2, id="equal sliding by the sum"),
    ],
)
def test_a_variant_may_give_the_centre_distance_or_the_sum_in_the_place_of_shifts(given: str, shifts: int) -> None:
    solution = solve(task_of(edited((BOTH, given))))

    found = [name for name in ("x_1", "x_2") if name in solution]
    assert len(found) == shifts
    for line in given.split("\n")[:-1]:
        name, value = line.split(" = ")
        if name in solution:
            assert solution[name].value == pytest.approx(float(value) * (1e-3 if name == "a_w" else 1.0), rel=1e-12)
    if shifts == 2:
        assert solution["theta_12_A1"].value == pytest.approx(solution["theta_21_A2"].value, rel=1e-9)


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


BAD = [
    pytest.param("z_1 = 15", "z_1 = 2", "variant.z_1", "from 3 to 10000", id="two teeth"),
    pytest.param("z_2 = 20", "z_2 = 20.5", "variant.z_2", "z_2 = 20.5: a wheel has a whole number", id="half a tooth"),
    pytest.param('m = "5 mm"', "m = 0", "variant.m", "must be greater than zero", id="no module"),
    pytest.param('m = "5 mm"', "m = -5", "variant.m", "must be greater than zero", id="negative module"),
    pytest.param('m = "5 mm"', 'm = "5 deg"', "variant.m", "the unit deg does not fit", id="module in degrees"),
    pytest.param("x_1 = 0.2", "x_1 = 3", "variant.17", "x_1 = 3 leaves wheel 1 no tooth", id="pointed below its flank"),
    pytest.param("x_1 = 0.2", "x_1 = -1.4", "variant.17", "x_1 = -1.4 leaves wheel 1 no tooth", id="cut away"),
    pytest.param(BOTH, "x_1 = -0.5\nx_2 = -0.4\n", "variant.17", "the pair cannot mesh", id="centres too near"),
    pytest.param(BOTH, "a_w = 60\n", "variant.17", "a_w = 60 mm: the pair cannot mesh", id="base circles overlap"),
    pytest.param(BOTH, "a_w = 95\nx_1 = 3\n", "variant.17", "from x_1, a_w follows", id="found shift without a tooth"),
    pytest.param("x_2 = 0.85\n", "", "variant.x_1", "given are: x_1; expected two of x_1, x_2", id="one shift"),
    pytest.param(BOTH, BOTH + "a_w = 92\n", "variant.x_1", "given are: x_1, x_2, a_w", id="too much"),
    pytest.param('"20 deg"', '"40 deg"', "givens.alpha.default", "expected a profile angle of the rack", id="steep"),
    pytest.param("z_1 = 15\n", "z_1 = 15\nalpha = 9\n", "variant.alpha", "alpha = 9°: expected a profile", id="flat"),
    pytest.param("z_1 = 15\n", "z_1 = 15\nh_l = 3\n", "variant.h_l", "no rack has such teeth", id="no such rack"),
    pytest.param("z_1 = 15\n", "z_1 = 15\nc = -1\n", "variant.c", "must not be negative", id="no clearance"),
    pytest.param(
        "z_1 = 15\n", 'z_1 = 15\nmaterial = "soft"\n', "variant.material", "'soft' is not a choice", id="word"
    ),
    pytest.param("m = { unit", "mm = { unit", "givens.mm", "'mm' is no number of a gear pair", id="no such number"),
    pytest.param(
        'm = { unit = "mm"',
        'm = { unit = "deg"',
        "givens.m",
        "not a quantity of this kind; expected one in mm",
        id="unit",
    ),
    pytest.param('rotation = "rotation"', 'sense = "ccw"', "gear.sense", "unknown key 'sense'", id="no such key"),
    pytest.param('rotation = "rotation"', 'rotation = "left"', "gear.rotation", "'left' is not a choice", id="sense"),
    pytest.param("mu_l =", "mu_s =", "scales.mu_s", "has no scale factor 'mu_s'", id="no such scale factor"),
    pytest.param('"geometry", ', '"sizes", ', "plans", "known are: geometry, meshing, sliding", id="no such plan"),
]


@pytest.mark.parametrize(("old", "new", "place", "message"), BAD)
def test_faults_of_a_file_are_told_with_their_places(old: str, new: str, place: str, message: str) -> None:
    faults, _ = check_text(edited((old, new)), "t.toml")

    told = [fault.text("en") for fault in faults]
    assert any(f"{place}: " in line and message in line for line in told), told
    for language in LANGUAGES:
        assert all("{" not in fault.text(language) and "\n" not in fault.text(language) for fault in faults)


def test_a_fault_of_a_default_is_told_once_for_all_variants() -> None:
    second = TEXT[TEXT.index("[[variant]]") :].replace('id = "17"', 'id = "18"')

    _, faults = read_text(edited(('"20 deg"', '"40 deg"')) + "\n" + second, "t.toml")

    assert len(faults) == 1


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"z_1": 2}, "z_1 = 2: a wheel has a whole number of teeth, from 3 to 10000"),
        ({"alpha": 40}, "alpha = 40°: expected a profile angle of the rack from 10° to 35°"),
        ({"x_1": 3}, "x_1 = 3 leaves wheel 1 no tooth"),
        ({"a_w": 80}, "a_w = 80 mm: the pair cannot mesh"),
        ({"x_sum": 100}, "from x_sum follows x_1 = "),
        ({"m": 0}, "m: '0': must be greater than zero"),
    ],
)
def test_bad_values_of_a_user_are_told_in_one_line(settings: dict[str, float], message: str) -> None:
    with pytest.raises(InputError) as refused:
        solve(TASK, set=settings)

    assert message in refused.value.text("en")
    assert len({refused.value.text(language) for language in LANGUAGES}) == len(LANGUAGES)


def test_limits_that_are_told_are_the_limits() -> None:
    for z in (3, 10000):
        assert load_task(TASK).values("17", {"z_1": z})["z_1"] == z
        solve(TASK, set={"z_1": z, "x_1": 1.0 if z == 3 else 0.0, "x_2": 0.6}, only="geometry")
    for alpha in (10.0, 32.0):
        assert solve(TASK, set={"alpha": alpha, "h_l": 1.8}, only="geometry").solved.givens["alpha"] == math.radians(
            alpha
        )


@pytest.mark.parametrize(
    ("asked", "modules"),
    [
        pytest.param({}, {"4 mm", "4.5 mm", "5 mm", "5.5 mm", "6 mm"}, id="round that of the task"),
        pytest.param({"m": "2..3"}, {"2 mm", "2.25 mm", "2.5 mm", "2.75 mm", "3 mm"}, id="a range"),
        pytest.param({"m": "4..5/0.2"}, {f"{m:g} mm" for m in (4, 4.2, 4.4, 4.6, 4.8, 5)}, id="a range with a step"),
    ],
)
def test_new_variants_have_modules_of_the_standard_unless_a_step_is_said(
    asked: dict[str, str], modules: set[str]
) -> None:
    span, luck = _ranges_of(load_task("madi-gear"), asked)["m"], random.Random(5)

    assert {span.pick(luck) for _ in range(200)} == modules
