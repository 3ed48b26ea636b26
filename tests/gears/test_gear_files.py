"""Files of tasks about gears: what they may say, what is refused, where, and in three languages."""

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
BAD = [
    ("z_1 = 15", "z_1 = 2", "variant.z_1", "from 3 to 10000"),
    ("z_2 = 20", "z_2 = 20.5", "variant.z_2", "z_2 = 20.5: a wheel has a whole number"),
    ('m = "5 mm"', "m = 0", "variant.m", "must be greater than zero"),
    ('m = "5 mm"', "m = -5", "variant.m", "must be greater than zero"),
    ('m = "5 mm"', 'm = "5 deg"', "variant.m", "the unit deg does not fit"),
    ("x_1 = 0.2", "x_1 = 3", "variant.17", "x_1 = 3 leaves wheel 1 no tooth"),  # pointed below its flank
    ("x_1 = 0.2", "x_1 = -1.4", "variant.17", "x_1 = -1.4 leaves wheel 1 no tooth"),  # cut away
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


edited = partial(with_changes, TEXT)


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

    found = [name for name in ("x_1", "x_2") if name in solution]
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


@pytest.mark.parametrize(
    ("asked", "modules"),
    [
        pytest.param({}, (4, 4.5, 5, 5.5, 6), id="round that of the task"),
        pytest.param({"m": "2..3"}, (2, 2.25, 2.5, 2.75, 3), id="a range"),
        pytest.param({"m": "4..5/0.2"}, (4, 4.2, 4.4, 4.6, 4.8, 5), id="a range with a step"),
    ],
)
def test_new_variants_have_modules_of_the_standard_unless_a_step_is_said(
    asked: dict[str, str], modules: tuple[float, ...]
) -> None:
    span, luck = _ranges_of(load_task(TASK), asked)["m"], random.Random(5)

    assert {span.pick(luck) for _ in range(200)} == {f"{m:g} mm" for m in modules}
