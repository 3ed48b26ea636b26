"""Variants as questions for Moodle, answered from themselves alone."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from kulman import all_variants, load_task, solve
from kulman.drawing.shapes import Circle, Text
from kulman.drawing.words import Words
from kulman.plans.hands.shaky import preset
from kulman.plans.hands.spread import drawn
from kulman.plans.names import role
from kulman.scales.units import format_unit
from kulman.tests.support.cases import solve_case, some
from kulman.tests.support.commands import Run
from kulman.tests.support.shapes import leaves
from kulman.variants.making.questions import html, questions_of
from kulman.variants.task import Task

TASK = "nau-slider-crank"


@dataclass(frozen=True)
class Asked:
    """A numerical question as Moodle's importer reads it."""

    category: str
    name: str
    text: str
    data: dict[str, str]  # of its table: values by symbols, or by what they are where there is none
    answers: list[tuple[float, float, float, str]]  # part of the mark, value, tolerance, feedback
    units: list[str]


def questions_in(file: Path) -> Iterator[Asked]:
    """Read questions by what Moodle documents of its XML: types, formats, files of a text, answers, units."""
    category = ""
    for item in ElementTree.parse(file).getroot():
        assert item.tag == "question"
        if item.get("type") == "category":
            category = item.findtext("category/text", "")
            assert category.startswith("$course$/top/")
            continue
        assert (item.get("type"), item.find("questiontext").get("format")) == ("numerical", "html")  # type: ignore[union-attr]
        text, files = item.findtext("questiontext/text", ""), item.findall("questiontext/file")
        assert re.findall('@@PLUGINFILE@@/([^"]+)', text) == [one.get("name") for one in files]
        for one in files:
            assert (one.get("path"), one.get("encoding")) == ("/", "base64")
            assert ElementTree.fromstring(b64decode(one.text or "", validate=True)).tag.endswith("}svg")
        table = ElementTree.fromstring(f"<div>{text}</div>").iter("tr")
        cells = (["".join(cell.itertext()) for cell in row] for row in table)
        answers = [
            (
                float(one.get("fraction", "")),
                *(float(one.findtext(tag, "")) for tag in ("text", "tolerance")),
                one.findtext("feedback/text", ""),
            )
            for one in item.findall("answer")
        ]
        assert [item.findtext(f"units/unit[{n + 1}]/multiplier") for n in range(len(item.findall("units/unit")))] in (
            [],
            ["1"],
            ["1", "1"],
        )
        units = [unit.text or "" for unit in item.iter("unit_name")]
        assert item.findtext("showunits") == ("0" if units else "3")
        assert item.findtext("generalfeedback/text")
        name = item.findtext("name/text", "")
        yield Asked(category, name, text, {symbol or said: value for symbol, said, value in cells}, answers, units)


def set_by(data: Mapping[str, str], task: Task, words: Words) -> dict[str, str]:
    """Return what `--set` takes of the data of a question: each given of the task by its symbol, choices by words."""
    found = {}
    for name, given in task.givens.items():
        symbol = re.sub("<[^>]+>", "", html(words.symbol(name)))
        if given.choices:
            ways = {words.choice(name, choice)[1]: choice for choice in given.choices}
            own = words.texts.get(f"given.{task.kind}_{name}")
            about = own or words.choice(name, given.choices[0])[0]
            found[name] = ways[data[about[:1].upper() + about[1:]]]
        elif symbol in data:
            found[name] = data[symbol]
    return found


@pytest.mark.parametrize(
    ("key", "variant", "language", "names"),
    some(
        [
            pytest.param(TASK, "3,example", "uk", None, id="slider-crank"),
            pytest.param(
                "madi-four-bar", None, "ru", "V_C,omega_3,a_C,R_03", id="moment on a rocker", marks=pytest.mark.soak
            ),
            pytest.param(
                "scheme-09-shaper", "0,4", "en", "a_A3A2_k,epsilon_3,M_bal,R_34", id="guide that turns, weights"
            ),
            pytest.param(
                "scheme-18-hydraulic-drive", "0", "uk", "V_D,F_bal", id="sliding driver", marks=pytest.mark.soak
            ),
            pytest.param("madi-cam", None, "ru", None, id="cam"),
            pytest.param("madi-gear", None, "en", None, id="gears"),
            pytest.param("karpenko-hoist", "V01,V10", "uk", None, id="hoist", marks=pytest.mark.soak),
        ],
        0,
        4,
    ),
)
def test_a_question_for_moodle_is_answered_from_itself_alone(
    key: str, variant: str | None, language: str, names: str | None, tmp_path: Path
) -> None:
    task = load_task(key)
    found = all_variants(task, variant, quantities=names, lang=language)
    (file,) = found.save(tmp_path / "q.xml")

    asked = [*questions_in(file)]
    assert (
        len({one.name for one in asked}) == len(asked) >= len(found.keys) * (4 if names is None else names.count(","))
    )
    for one in asked:
        variant, quantity = one.name.split("-", 1)
        words, own = found.keys[variant].words, set_by(one.data, task, found.keys[variant].words)
        # data of loads and masses have no place in a question of motion
        assert own.keys() == {*found.keys[variant].solution.case.givens} or quantity[0] in "Vaoe"
        other = next(name for name in reversed(task.variants) if len(task.variants) == 1 or name != variant)
        item = solve(task, other, set={**own})[quantity]
        shown = item.shown(words.display).value
        assert shown is not None
        value = abs(shown) if "no sign" in one.text or "без знак" in one.text or "without a sign" in one.text else shown
        (part, right, miss, told), *others = one.answers
        assert (part, right, told) == (100.0, pytest.approx(value, rel=1e-6), "")
        assert 0.004 * abs(right) < miss <= 0.15 * abs(right)
        assert [one[:2] for one in others[:1]] == [(50.0, right)]
        assert others[0][2] == pytest.approx(min(2.0 * miss, 0.2 * abs(right)), rel=0.01)
        turns = item.unit in ("rad/s", "rad/s^2", "N*m")
        assert [(half, way) for half, way, _, _ in others[1:]] == ([(50.0, -right)] if turns else [])
        assert all(feedback for *_, feedback in others)
        rule = {"uk": "проти годинникової стрілки", "ru": "против часовой стрелки", "en": "counter-clockwise"}[language]
        assert (f"{rule}, " in one.text) == turns
        assert one.units[:1] == ([unit] if (unit := format_unit(item.shown(words.display).unit, language)) else [])
        assert "Pa" not in one.units
        assert one.category.endswith(f" {variant}")
        assert "@@PLUGINFILE@@" in one.text
        assert not any(re.match(r"\d{7}", value) for value in one.data.values())  # 206000 MPa, not 206000000000 Pa
    for variant, found_key in found.keys.items():
        rates = [role(one.name.split("-", 1)[1]) for one in asked if one.name.startswith(f"{variant}-")]
        sizes = [(q.kind, abs(found_key.solution[q].value)) for q in rates if q.kind in ("V", "a", "omega", "epsilon")]
        assert names or len({(kind, f"{size:.9e}") for kind, size in sizes}) == len(sizes)  # each is asked for once


@pytest.mark.parametrize(
    ("key", "name", "sentence"),
    [("karpenko-hoist", "P_st", "треть веса каната"), ("madi-gear", "d_a1", "зубья укорочены")],
)
def test_what_schools_reckon_otherwise_is_said_in_a_question(
    key: str, name: str, sentence: str, tmp_path: Path
) -> None:
    found = all_variants(key, [next(iter(load_task(key).variants))], quantities=name, lang="ru")
    (file,) = found.save(tmp_path / "q.xml")

    assert [sentence in one.text for one in questions_in(file)] == [True]


def test_a_point_that_is_in_no_figure_is_not_asked_about() -> None:
    found = all_variants("scheme-20-press-automaton", "2")

    names = {one.name for key in found.keys.values() for one in questions_of(key, found.quantities, False, found.hand)}

    assert {"2-V_D", "2-V_C"} <= names
    assert not [name for name in names if "X3" in name]


@pytest.mark.parametrize(
    ("key", "said"),
    [(TASK, "Kinematic scheme"), ("madi-cam", "Law of motion"), ("madi-gear", "gears"), ("karpenko-hoist", "hoist")],
)
def test_the_figure_of_a_question_is_called_what_it_is(key: str, said: str, tmp_path: Path) -> None:
    found = all_variants(key, [next(iter(load_task(key).variants))], lang="en")
    (file,) = found.save(tmp_path / "q.xml")

    assert all(said in re.findall('alt="([^"]+)"', one.text)[0] for one in questions_in(file))


def test_what_is_given_is_not_asked_for() -> None:
    found = all_variants("scheme-18-hydraulic-drive", "0")

    names = {one.name for key in found.keys.values() for one in questions_of(key, found.quantities, False, found.hand)}
    assert "0-V_A" not in names
    assert "0-V_D" in names


@pytest.mark.parametrize(("settings", "asked"), [({}, True), ({"r_0": "60 mm"}, False)])
def test_the_offset_of_a_cam_is_asked_for_where_the_smallest_cam_has_it(
    settings: dict[str, str], asked: bool, tmp_path: Path
) -> None:
    (file,) = all_variants("madi-cam", set=settings, lang="en").save(tmp_path / "q.xml")

    assert any("with which the cam is smallest" in one.text for one in questions_in(file)) == asked


def test_centres_of_a_gear_pair_have_their_letters_beside_them() -> None:
    case = solve_case("madi-gear")
    view = case.kind.pictured(case, case.words())
    assert view is not None
    shown = [*leaves(view.shapes)]

    letters = {one.markup: one.at for one in shown if isinstance(one, Text)}
    pitch = sorted((one for one in shown if isinstance(one, Circle)), key=lambda one: one.radius)[-2:]
    for name, circle in zip(("O_{1}", "O_{2}"), pitch, strict=True):
        assert abs(letters[name] - circle.centre) < 0.5 * circle.radius
    assert "ω_{1}" in letters


def test_a_velocity_about_a_pivot_is_asked_for_as_that_of_the_point() -> None:
    found = all_variants("scheme-09-shaper", "0")

    names = {one.name for key in found.keys.values() for one in questions_of(key, found.quantities, False, found.hand)}
    assert {"0-V_D", "0-V_A3", "0-omega_3"} <= names
    assert not {"0-V_DC", "0-V_A3C", "0-omega_2"} & names


def test_a_quiz_may_draw_one_variant_of_each_question(tmp_path: Path, run: Run) -> None:
    file, gift = tmp_path / "q.xml", tmp_path / "q.gift"
    options = ("-v", "3,4,5", "--quantities", "V_B,omega_2", "--by", "quantity", "--lang", "uk")

    assert run("variants", TASK, *options, "-o", str(file), "-o", str(gift))[0] == 0

    asked = [(one.category.rpartition("/")[2], one.name) for one in questions_in(file)]
    assert asked == [("VB", f"{n}-V_B") for n in (3, 4, 5)] + [("ω2", f"{n}-omega_2") for n in (3, 4, 5)]
    text = gift.read_text("utf-8")
    assert re.findall(r"^::(.+?)::\[html\]", text, re.MULTILINE) == [name for _, name in asked]
    assert text.count("$CATEGORY: ") == 2
    assert text.count("data\\:image/svg+xml;base64,") == len(asked)
    assert all(
        re.search(r"(?<!\\)\{#=[-.\d]+:[.\d]+ =%50%", line) for line in text.splitlines() if line.startswith("::")
    )


def test_honest_drawings_pass_a_question_and_coarse_ones_do_not(tmp_path: Path) -> None:
    (file,) = all_variants(TASK, "3", lang="en").save(tmp_path / "q.xml")
    key = all_variants(TASK, "3").keys["3"].key
    shares = {}
    for name in ("normal", "lenient"):
        drawings = drawn(key.paper, preset(name).hand, np.random.default_rng(77), 1000)
        for one in questions_in(file):
            quantity = one.name.split("-", 1)[1]
            (_, right, miss, _), *_ = one.answers
            sizes = np.abs(drawings[quantity])
            shares[name, quantity] = float(np.mean(np.abs(sizes - abs(right)) <= miss))
    normal, lenient = ([share for (hand, _), share in shares.items() if hand == of] for of in ("normal", "lenient"))
    assert min(normal) > 0.96
    assert np.median(normal) < 0.995  # no wider than that takes
    assert np.mean(lenient) < np.mean(normal) - 0.05
