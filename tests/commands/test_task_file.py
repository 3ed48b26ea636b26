"""Task files: where keys stand, what a good file gives, and the bundled tasks against their sources."""

import math
import string
import tomllib
from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kulman.plans.linkages.mechanism import ZERO, Prismatic
from kulman.scales.errors import InputError
from kulman.variants.checks.basics import Places
from kulman.variants.reader import load_task, read_text
from kulman.variants.shelf import bundled, bundled_text, summary

PLACED = '''\
# a comment [not a table]
title = "x # y"
[givens]   # more
phi = { unit = "deg", "a b" = [1, { c = 2 }] }
a.b . "c d" = 1
text = """
[fake]
key = "no" \\""" ""
"""  # end
raw = \'\'\'
[[fake]]\'\'\'
list = [
  "one", # first
  [ 2, 3 ],
]
[[variant]]
id = "0"
[variant.more]
deep = 1979-05-27 07:32:00
[[variant]]
id = "1"
[[variant.row]]
x = 1
[[variant.row]]
x = 2
'''


@pytest.mark.parametrize(
    ("path", "place"),
    [
        (("title",), (2, 1)),
        (("givens",), (3, 1)),
        (("givens", "phi"), (4, 1)),
        (("givens", "phi", "unit"), (4, 9)),
        (("givens", "phi", "a b", 0), (4, 32)),
        (("givens", "phi", "a b", 1, "c"), (4, 37)),
        (("givens", "a", "b", "c d"), (5, 7)),
        (("givens", "raw"), (10, 1)),
        (("givens", "list"), (12, 1)),
        (("givens", "list", 1), (14, 3)),
        (("givens", "list", 1, 1), (14, 8)),
        (("variant", 0), (16, 1)),
        (("variant", 0, "id"), (17, 1)),
        (("variant", 0, "more", "deep"), (19, 1)),
        (("variant", 1, "id"), (21, 1)),
        (("variant", 1, "row", 0, "x"), (23, 1)),
        (("variant", 1, "row", 1, "x"), (25, 1)),
        (("variant", 1, "missing"), (20, 1)),
        (("missing",), (1, 1)),
    ],
)
def test_every_key_has_its_place(path: tuple[str | int, ...], place: tuple[int, int]) -> None:
    tomllib.loads(PLACED)

    assert Places(PLACED)[path] == place
    assert Places(PLACED.replace("\n", "\r\n"))[path] == place


KEYS = st.text(string.ascii_letters + string.digits + "_-", min_size=1, max_size=6)
VALUES = st.recursive(
    st.integers(-99, 99).map(str) | st.text("ab[]{}#=,.'", max_size=6).map(lambda s: f'"{s}"') | st.just("'''\n]'''"),
    lambda inner: (
        st.lists(inner, max_size=3).map(lambda items: "[" + ", ".join(items) + "]")
        | st.dictionaries(KEYS, inner, max_size=3).map(
            lambda d: "{" + ", ".join(f"{k} = {v}" for k, v in d.items()) + "}"
        )
    ),
    max_leaves=6,
)


@given(st.dictionaries(KEYS, st.dictionaries(KEYS, VALUES, max_size=4), max_size=4))
def test_places_point_at_the_keys_of_any_file(tables: dict[str, dict[str, str]]) -> None:
    text = "".join(f"[{table}]\n" + "".join(f"{k} = {v}\n" for k, v in rows.items()) for table, rows in tables.items())
    lines = text.split("\n")
    tomllib.loads(text)

    places = Places(text)

    for table, rows in tables.items():
        line, column = places[(table,)]
        assert lines[line - 1].startswith(f"[{table}]", column - 1)
        for key in rows:
            line, column = places[(table, key)]
            assert lines[line - 1].startswith(f"{key} = ", column - 1)


@pytest.mark.parametrize("task", bundled())
def test_every_bundled_task_is_without_fault(task: str) -> None:
    found, faults = read_text(bundled_text(task), task)

    assert faults == ()
    assert found is not None
    assert found.id == task
    assert set(found.title) == {"uk", "ru", "en"}
    for variant in found.variants:
        assert all(math.isfinite(value) for value in found.values(variant).values())
    assert summary(task)["variants"] == list(found.variants)


def test_every_bundled_task_comes_with_the_package() -> None:
    assert {f"{task}.toml" for task in bundled()} == {
        entry.name for entry in (files("kulman.variants") / "tasks").iterdir() if entry.name.endswith(".toml")
    }


def test_the_slider_crank_has_the_numbers_of_its_table() -> None:
    task = load_task("nau-slider-crank")
    printed = {  # NAU guide 2016, table of variants: columns 0, 4, 9 and the worked example
        "0": (30, 25, 125, 42, 2000, 0.8, 0.6, 2.0),
        "4": (150, 45, 215, 72, 1200, 3.5, 3.0, 5.0),
        "9": (330, 46, 220, 75, 1150, 3.4, 2.9, 4.8),
        "example": (60, 50, 130, 60, 765, 2.5, 2.0, 1.5),
    }

    assert list(task.variants) == [*"0123456789", "example"]
    for variant, (phi, crank, rod, centre, speed, m_2, m_3, force) in printed.items():
        values = task.values(variant)
        assert values["phi"] == phi * math.pi / 180
        assert (values["l_OA"], values["l_AB"], values["l_AS2"]) == (crank / 1000, rod / 1000, centre / 1000)
        assert values["n_1"] == speed * math.pi / 30
        assert (values["m_2"], values["m_3"], values["F_3"]) == (m_2, m_3, force * 1000)
        assert task.variants[variant].reconstructed == (() if variant == "example" else ("J_S2",))


def test_the_slider_is_on_the_left_unless_it_is_said_to_be_on_the_right() -> None:
    task = load_task("nau-slider-crank")

    left, right = task.values("example"), task.values("example", {"side": "right"})

    assert (left["branch_B"], left["alpha_F3"]) == (-1.0, 0.0)
    assert (right["branch_B"], right["alpha_F3"]) == (1.0, math.pi)
    assert {name for name in left if left[name] != right[name]} == {"branch_B", "alpha_F3"}


def test_settings_take_any_unit_of_the_kind_and_the_tasks_own_without_one() -> None:
    task = load_task("nau-slider-crank")
    settings: dict[str, str | float] = {
        "l_OA": "5,5 см",
        "l_AB": "140",
        "n_1": "80 рад/с",
        "F_3": 2,
        "phi": 90.0,
        "rotation": "ccw",
    }

    values = task.values(None, settings)

    assert values["l_OA"] == 0.055
    assert values["l_AB"] == 0.14
    assert values["n_1"] == 80.0
    assert values["F_3"] == 2000.0
    assert values["phi"] == math.pi / 2
    assert values["sense_1"] == 1.0
    assert task.resolve(None, settings)["rotation"] == "ccw"
    assert values["m_2"] == 0.8  # the first variant


@pytest.mark.parametrize(
    ("variant", "settings", "key"),
    [
        ("11", {}, "variant-unknown"),
        ("exmple", {}, "variant-unknown-like"),
        ("0", {"l_0A": "5 mm"}, "given-unknown-like"),
        ("0", {"zzz": 5}, "given-unknown"),
        ("0", {"l_OA": "5 kg"}, "unit-wrong"),
        ("0", {"l_OA": "0 mm"}, "not-positive"),
        ("0", {"l_OA": -5}, "not-positive"),
        ("0", {"m_2": "-1 kg"}, "negative"),
        ("0", {"n_1": "-1"}, "not-positive"),
        ("0", {"n_1": 0}, "not-positive"),
        ("0", {"l_OA": math.nan}, "number-bad"),
        ("0", {"l_OA": 10**400}, "number-infinite"),
        ("0", {"l_OA": "1e13"}, "number-infinite"),
        ("0", {"l_OA": True}, "type-quantity"),
        ("0", {"side": "top"}, "choice-unknown"),
        ("0", {"side": 1}, "choice-unknown"),
    ],
)
def test_a_setting_that_cannot_be_used_is_refused(variant: str, settings: dict[str, float | str], key: str) -> None:
    with pytest.raises(InputError) as caught:
        load_task("nau-slider-crank").values(variant, settings)

    assert caught.value.key == key


def test_a_message_about_a_setting_names_it() -> None:
    with pytest.raises(InputError, match=r"^l_OA: the unit kg does not fit"):
        load_task("nau-slider-crank").values("0", {"l_OA": "5 kg"})


def test_a_file_of_ones_own_is_read_like_a_bundled_task(tmp_path: Path) -> None:
    file = tmp_path / "мій механізм.toml"
    file.write_bytes(b"\xef\xbb\xbf" + bundled_text("nau-slider-crank").replace("\n", "\r\n").encode())

    own = load_task(file)

    assert own.file == str(file)
    assert own.mechanism == load_task("nau-slider-crank").mechanism
    assert own.values("7") == load_task(str(file)).values("7") == load_task("nau-slider-crank").values("7")


def test_literals_of_the_mechanism_become_constants() -> None:
    text = bundled_text("nau-slider-crank").replace('offset = "0 mm"', 'offset = "5 mm"')
    text = text.replace('direction = "0 deg"', 'direction = "90 deg"')

    task, _ = read_text(text, "x.toml")

    assert task is not None
    guide = task.mechanism.pairs[3]
    assert isinstance(guide, Prismatic)
    values = task.values("0")
    assert guide.through == (ZERO, ZERO)
    assert (values[guide.offset], values[guide.direction], values[ZERO]) == (0.005, math.pi / 2, 0.0)


def test_a_length_that_is_no_distance_may_be_negative_or_zero() -> None:
    text = bundled_text("nau-slider-crank").replace('offset = "0 mm"', 'offset = "e"')
    text = text.replace("[givens]\n", '[givens]\ne = { unit = "mm", default = 0 }\n')

    task, faults = read_text(text, "x.toml")

    assert faults == ()
    assert task is not None
    assert task.values("0")["e"] == 0.0
    assert task.values("0", {"e": -12})["e"] == -0.012


def test_all_faults_are_found_at_once_in_the_order_of_their_lines(tmp_path: Path) -> None:
    text = bundled_text("nau-slider-crank")
    for old, new in (
        ('unit = "kg*m^2"', 'unit = "kg*mm^2x"'),
        ('centre = "S2"', 'centre = "S3"'),
        ('speed = "n_1"', 'speed = "n1"'),
        ('phi = "30 deg"', 'phi = "30 mm"'),
        ('l_OA = "28 mm"', 'l_OA = "-28 mm"'),
    ):
        assert old in text
        text = text.replace(old, new)
    file = tmp_path / "t.toml"
    file.write_text(text, encoding="utf-8")

    _, faults = read_text(file.read_text(encoding="utf-8-sig"), str(file))

    lines = [int(str(fault).removeprefix(str(file)).split(":")[1]) for fault in faults]
    assert len(faults) >= 5
    assert lines == sorted(lines)
    with pytest.raises(InputError) as caught:
        load_task(file)
    assert str(caught.value) == f"{faults[0]} (and {len(faults) - 1} more: kulman list --check {file})"
