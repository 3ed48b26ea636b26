"""Kulman from Python: what is shown, what can be asked, and wrong arguments answered in one line of our own."""

from __future__ import annotations

import csv
import datetime
import html
import inspect
import io
import json
import pickle
import re
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import kulman
from kulman import KulmanError, all_variants, chart, solve, sweep
from kulman.cli import commands
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.commands import Run
from kulman.variants.making.all_variants import AllVariants
from kulman.variants.shelf import text_of
from kulman.variants.solution import Solution
from kulman.variants.tables import FILES, Result

TASK = "nau-slider-crank"
# what `solve`, `sheet` and `sweep` refuse: arguments, and the key of the message
WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "no task": ({"task": None}, "argument-type"),
    "task of bytes": ({"task": b"nau-slider-crank"}, "argument-type"),
    "unknown task": ({"task": "nau-slider-crnk"}, "task-unknown-like"),
    "missing file": ({"task": Path("none.toml")}, "file-missing"),
    "text of a task file": ({"task": 'id = "x"\n[mechanism]\n'}, "task-text"),
    "unknown variant": ({"variant": "11"}, "variant-unknown"),
    "variant of no kind": ({"variant": ["3"]}, "argument-type"),
    "variant of a float": ({"variant": 3.0}, "argument-type"),
    "set as a text": ({"set": "l_OA=3"}, "argument-type"),
    "set by a number": ({"set": {1: 3}}, "argument-type"),
    "set of an unknown given": ({"set": {"l_XX": 3}}, "given-unknown"),
    "set to nan": ({"set": {"l_OA": float("nan")}}, "number-bad"),
    "set to None": ({"set": {"l_OA": None}}, "type-quantity"),
    "set to an array": ({"set": {"l_OA": np.array([40.0, 50.0])}}, "type-quantities"),
    "set to a truth": ({"set": {"l_OA": np.array(True)}}, "type-quantity"),
    "set to no choice": ({"set": {"rotation": 3}}, "choice-unknown"),
    "scale of a text": ({"scales": {"pa": "abc"}}, "number-bad"),
    "scale below zero": ({"scales": {"mu_V": -1}}, "scale-not-positive"),
    "scale of a list": ({"scales": {"pa": [80, "mm"]}}, "argument-type"),
    "scale with the unit of another": ({"scales": {"mu_V": (0.05, "kg")}}, "unit-wrong"),
    "scale of an unknown segment": ({"scales": {"pz": 80}}, "scale-segment"),
    "scale of an unknown symbol": ({"scales": {"mu_F_9": 80}}, "scale-unknown-like"),
    "scale of a plan not drawn": ({"scales": {"mu_a": 80}, "only": "velocity"}, "scale-not-drawn"),
    "scales as a text": ({"scales": "pa=80"}, "argument-type"),
    "unknown plan": ({"only": ["nonsense"]}, "plan-unknown"),
    "plans as a number": ({"only": 3}, "argument-type"),
    "unknown language": ({"lang": "de"}, "language"),
    "unknown notation": ({"notation": "x"}, "notation-unknown"),
    "notation of no kind": ({"notation": 3}, "argument-type"),
}
WRONG_SHEET: dict[str, tuple[dict[str, Any], str]] = {
    "unknown format": ({"format": "A9"}, "format-unknown"),
    "format of no kind": ({"format": 3}, "argument-type"),
    "unknown norm": ({"norm": "din"}, "norm-unknown"),
    "no language": ({"lang": None}, "argument-type"),
    "student of no kind": ({"student": None}, "argument-type"),
    "date of no kind": ({"date": datetime.date(2026, 1, 2)}, "argument-type"),
    "name too long": ({"student": "щ" * 500}, "stamp-too-long"),
    "character of no font": ({"student": "😀"}, "character-missing"),
}


def test_a_scale_factor_as_the_sheet_has_it_is_that_of_all_plans_of_forces() -> None:
    for same in ({"mu_V": (0.05, "(m/s)/mm")}, {"mu_V": (20, "mm/(m/s)")}, {"mu_V": "5 (cm/s)/mm"}, {"mu_V": 0.05}):
        assert kulman.solve(TASK, "3", scales=same).scales["mu_V"].mu == pytest.approx(0.05)
    of = kulman.solve(TASK, "3", scales={"mu_F": 50, "mu_F_1": 20}).scales
    assert {name: scale.mu for name, scale in of.items() if name.startswith("mu_F")} == {"mu_F_23": 50, "mu_F_1": 20}


@pytest.mark.parametrize("task", kulman.tasks())
def test_the_scale_factors_that_are_told_are_those_that_may_be_chosen(task: str) -> None:
    usual = {symbol: scale.mu for symbol, scale in kulman.solve(task).scales.items()}
    with pytest.raises(KulmanError) as caught:
        kulman.solve(task, scales={"mu_none": 1})
    told = str(caught.value).partition(": ")[2].split(", ")

    for symbol in told:
        chosen = kulman.solve(task, scales={symbol: 1.25 * usual[symbol]}).scales[symbol].mu
        assert chosen == pytest.approx(1.25 * usual[symbol])
    for symbol in {*usual} - {*told}:
        with pytest.raises(KulmanError, match="follows from"):
            kulman.solve(task, scales={symbol: usual[symbol]})


@pytest.fixture(scope="module")
def solution() -> Solution:
    return kulman.solve(TASK, "3")


@pytest.mark.parametrize(
    ("verb", "name"),
    [*((verb, name) for verb in ("solve", "sheet", "sweep") for name in WRONG), *(("sheet", n) for n in WRONG_SHEET)],
)
def test_a_wrong_argument_is_answered_in_one_line(verb: str, name: str) -> None:
    arguments, key = {**WRONG, **WRONG_SHEET}[name]

    with pytest.raises(KulmanError) as caught:
        getattr(kulman, verb)(**{"task": TASK, **arguments})

    assert caught.value.key == key
    assert all(caught.value.text(language).isprintable() for language in LANGUAGES)


_APART = ("help", "guide", "list", "show", "new", "variants", "page", "serve")
VERBS = {name: getattr(kulman, name) for name in commands.commands if name not in _APART}
VERBS["variants"] = kulman.all_variants


@pytest.mark.parametrize("verb", VERBS)
def test_what_is_not_said_is_the_same_from_python_and_the_command_line(verb: str) -> None:
    options = {option.name: option.default for option in commands.commands[verb].params}
    shared = {k: v for k, v in inspect.signature(VERBS[verb]).parameters.items() if k in options}

    assert {"task", "variant", "only"} & {*shared}
    for name, parameter in shared.items():
        if isinstance(options[name], (str, int, float, tuple)) and not isinstance(options[name], bool):
            assert str(parameter.default).removesuffix(".0") == str(options[name]), name
        else:  # nothing; of documents Ukrainian, when no language is said
            assert parameter.default in (parameter.empty, None, False, "", "uk"), name


@pytest.mark.parametrize("verb", VERBS)
def test_an_argument_of_another_kind_is_refused_by_its_name(verb: str, tmp_path: Path) -> None:
    needed = {"task": TASK, "roster": "class.csv", "folder": tmp_path, "only": "position", "make": 1}
    arguments = inspect.signature(VERBS[verb]).parameters
    named = [name for name, one in arguments.items() if one.kind is not one.VAR_KEYWORD]

    for name in {*named} - {"norm", "advance"}:  # a word that is compared, and what may be anything that is called
        with pytest.raises(KulmanError, match=f"^{name}: expected "):
            VERBS[verb](**{key: needed[key] for key in needed if key in named} | {name: object()})


@pytest.mark.parametrize("verb", [*VERBS.values(), kulman.solve_many, kulman.load_task, kulman.tasks])
def test_arguments_that_python_itself_would_refuse_are_refused_in_the_users_language(verb: Callable[..., Any]) -> None:
    signed = [*inspect.signature(verb).parameters.values()]
    needed = [one.name for one in signed if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD]
    unnamed = [one.name for one in signed if one.kind is one.POSITIONAL_OR_KEYWORD]
    wrong: list[tuple[list[str], dict[str, Any], str, str]] = [
        (["a"] * (len(unnamed) + 1), {}, "argument-unnamed", ", ".join(unnamed)),
        (["a"] * len(unnamed), {unnamed[0]: "a"}, "argument-unnamed", ", ".join(unnamed)),
    ]
    if needed:
        wrong.append(([], {}, "argument-missing", ", ".join(needed)))
    if verb is not kulman.solve_many:  # whose other arguments are givens
        wrong.append((["a"], {f"{unnamed[-1]}x": 3}, "argument-unknown-like", unnamed[-1]))

    for arguments, named, key, part in wrong:
        with pytest.raises(KulmanError) as caught:
            verb(*arguments, **named)
        assert caught.value.key == key
        assert all(part in caught.value.text(language) for language in LANGUAGES)


def test_an_argument_that_there_is_not_is_answered_with_all_that_there_are() -> None:
    with pytest.raises(KulmanError, match="unknown argument 'tile'; expected one of: task, variant, steps, key, "):
        kulman.handout(TASK, tile="A4")
    for language in LANGUAGES:
        with pytest.raises(KulmanError) as caught:
            kulman.solve(TASK, l_OA=30, phi=30)  # they may be givens
        assert 'set={"l_OA": ...}; ' in caught.value.text(language)
        assert caught.value.text(language).endswith(' set={"phi": ...}')
    with pytest.raises(KulmanError, match="unknown argument 'position'; did you mean positions"):
        kulman.sweep(TASK, position=5)


@pytest.mark.parametrize("variant", ["3", 3, np.int64(3)])
def test_a_variant_is_a_text_or_a_whole_number(variant: Any) -> None:
    assert kulman.solve(TASK, variant).variant == kulman.check(TASK, variant).request.variant == "3"


def test_what_a_result_has_not_is_missing_as_of_any_mapping(solution: Solution) -> None:
    states, swept = kulman.solve_many(TASK, phi=[1.0, 2.0], names="V_B"), kulman.sweep(TASK, only="velocity")
    for found in (solution, states, swept):
        assert "V_X" not in found
        with pytest.raises(KeyError, match="there is no quantity 'V_X'"):
            found["V_X"]
    assert solution.get("V_X") is None


@pytest.mark.parametrize("value", [40, 40.0, "40", "4 cm", np.float64(40), np.int64(40), np.float32(40)])
def test_a_given_is_any_real_number_or_a_text_with_a_unit(value: Any) -> None:
    assert kulman.solve(TASK, set={"l_OA": value})["l_OA"].value == pytest.approx(0.04, rel=1e-15)


@pytest.mark.parametrize(
    "only",
    [
        *("velocity,lever", ["velocity", "lever"], ("velocity,lever",), iter(["velocity", "lever"])),
        *("Швидкості, важіль", ["скорости", "рычаг"]),  # as reports call them
    ],
)
def test_plans_are_named_one_by_one_or_with_commas(only: Any) -> None:
    drawn = kulman.sheet(TASK, only=only)

    views = [shape.name for page in drawn.pages for shape in page.shapes if getattr(shape, "role", "") == "view"]
    assert {"velocity", "lever"} <= set(views)
    assert "forces_23" not in views


@pytest.mark.parametrize(
    ("said", "meant"), [("скорость", "скорости"), ("швидкість", "швидкості"), ("velocitys", "velocity")]
)
def test_a_plan_that_there_is_not_is_told_with_those_of_the_task(said: str, meant: str) -> None:
    with pytest.raises(KulmanError, match=rf"did you mean '{meant}'\?"):
        kulman.sheet(TASK, only=said)
    with pytest.raises(KulmanError, match=r"known are: structure, position, velocity, acceleration, forces, lever$"):
        kulman.sheet(TASK, only="nonsense")
    with pytest.raises(KulmanError, match=r"known are: diagrams, sizes, profile, pressure$"):
        kulman.sheet("madi-cam", only=said)


def test_a_variant_may_be_a_number_and_a_task_one_that_has_been_read(solution: Solution) -> None:
    again = kulman.solve(kulman.load_task(TASK), 3)  # type: ignore[arg-type]

    assert again.variant == "3"
    assert again.quantities == solution.quantities


def test_a_solution_is_asked_by_the_names_of_its_quantities(solution: Solution) -> None:
    assert "V_B" in solution
    assert "V_Q" not in solution
    assert None not in solution
    assert dict(solution.items()) == solution.quantities
    assert list(solution) == list(solution.quantities)
    assert len(solution) == len(solution.quantities)
    for name in ("V_Q", None, 3):
        with pytest.raises(KulmanError):
            solution[name]  # type: ignore[index]


def test_a_solution_has_the_checks_of_its_json_and_is_short_on_a_prompt(solution: Solution) -> None:
    assert solution.checks["lever"]["ok"]
    assert solution.to_json()["checks"] == solution.checks
    assert kulman.solve(TASK, only="velocity").checks == {}
    assert repr(solution) == f"<Solution {TASK} 3: ok, {len(solution)} quantities>"
    assert repr(kulman.sheet(TASK, only="velocity", lang="en")) == ("<Sheet 'Slider-crank': A4, pages: 1>")


def test_a_notebook_shows_a_solution_as_its_table_or_why_there_is_none(solution: Solution) -> None:
    apart = kulman.solve(TASK, set={"l_AB": 20, "phi": 90}, lang="uk")
    same = pickle.loads(pickle.dumps(apart))

    assert solution._repr_html_().startswith(
        '<div style="max-width: 100%; overflow-x: auto"><table'
    )  # which is not cut off
    assert all(f">{name}<" in solution._repr_html_() for name in solution.listed)
    assert apart.status == "no-assembly"
    assert repr(apart["V_B"]) == "V_B = – m/s"
    assert apart.reason is not None
    assert apart.reason.text("uk") in apart._repr_html_()
    assert (same.to_json(), str(same.reason)) == (apart.to_json(), str(apart.reason))  # in another process, too


def test_a_notebook_shows_all_pages_of_a_sheet() -> None:
    pages = kulman.sheet(TASK, "3", format="A3")

    assert len(pages.pages) > 1
    assert pages._repr_html_().count("<img ") == len(pages.pages)
    assert pages.svg(1) != pages.svg(2)
    for number in (0, len(pages.pages) + 1):
        with pytest.raises(KulmanError, match="there is no page"):
            pages.svg(number)
    with pytest.raises(KulmanError, match="page: expected int"):
        pages.svg("x")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("paths", "key"),
    [
        ((None,), "argument-type"),
        ((["x.svg"],), "argument-type"),
        (("x",), "output-suffix"),
        (("a\0.svg",), "output-name"),
        (("none/x.svg",), "output-folder-missing"),
        (("x.svg", "y.doc"), "output-suffix"),
        (("x.svg", "./x.svg"), "output-twice"),
    ],
)
def test_a_sheet_that_cannot_be_saved_writes_nothing(paths: tuple[Any, ...], key: str, folder: Path) -> None:
    with pytest.raises(KulmanError) as caught:
        kulman.sheet(TASK, only="velocity").save(*paths)

    assert caught.value.key == key
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize(
    ("verb", "arguments"),
    [("solve", {"variant": "99"}), ("solve", {"set": {"l_OA": -1}}), ("sheet", {"set": {"l_AB": 20, "phi": 90}})],
)
def test_an_error_crosses_to_another_process_whole(verb: str, arguments: dict[str, Any]) -> None:
    with pytest.raises(KulmanError) as caught:
        getattr(kulman, verb)(TASK, **arguments)

    same = pickle.loads(pickle.dumps(caught.value))

    assert type(same) is type(caught.value)
    assert (same.text("uk"), same.status) == (caught.value.text("uk"), caught.value.status)


# What commands have found, as data: columns, rows and files alike from Python and the command line.
FOUND = {
    "solve": lambda: solve(TASK, "3", only="velocity", lang="en", condition=True),
    "sweep": lambda: sweep(TASK, "3", only="velocity", lang="en"),
    "sweep of a hoist": lambda: sweep("karpenko-hoist", positions=9, lang="en"),
    "chart": lambda: chart(TASK, "3", chart="depth", positions=9, lang="en"),
    "variants": lambda: all_variants(TASK, quantities=["V_B", "a_B"], lang="en"),
}


@pytest.mark.parametrize("name", FOUND)
def test_rows_are_the_same_in_every_kind_of_file(name: str, tmp_path: Path) -> None:
    found = FOUND[name]()
    assert isinstance(found, Result)

    written = {path.suffix: path for path in found.save(*(tmp_path / f"x{suffix}" for suffix in FILES))}

    def same(cell: object, text: object) -> bool:
        if cell is None or cell == "":
            return text in (None, "")
        if isinstance(cell, str):
            return str(text).lstrip("'") == cell
        return float(str(text)) == pytest.approx(float(cell), rel=1e-9, abs=1e-12)

    [sheet] = openpyxl.load_workbook(written[".xlsx"]).worksheets
    page = written[".html"].read_text(encoding="utf-8")
    tables = {
        "csv": list(csv.reader(io.StringIO(written[".csv"].read_text(encoding="utf-8-sig"), newline=""))),
        "xlsx": [list(row) for row in sheet.iter_rows(values_only=True)],
        "html": [[html.unescape(x) for x in re.findall("<td>(.*?)</td>", row)] for row in page.split("<tr>")[1:]],
    }
    if isinstance(found, AllVariants):
        del tables["html"]  # a key to be printed
    assert len(found.rows) > 1
    for kind, rows in tables.items():
        assert len(rows) == 1 + len(found.rows), kind
        for row, own in zip(rows, (found.columns, *map(tuple, found.rows)), strict=True):
            assert len(row) == len(own), kind
            assert all(map(same, own, row)), (kind, own, row)
    assert json.loads(written[".json"].read_text(encoding="ascii")) == json.loads(json.dumps(found.to_json()))
    assert found.csv("uk").count(";") >= len(found.columns) - 1
    shown = found._repr_html_()
    assert shown.count("<table") == 1
    assert "<pre>" not in shown
    assert all(f">{html.escape(str(name))}<" in shown for name in found.columns) or name == "solve"


@pytest.mark.parametrize("command", ["solve", "sweep", "chart --chart depth --positions 36", "variants"])
def test_the_command_line_writes_what_python_does(command: str, tmp_path: Path, run: Run) -> None:
    name, *options = command.split()
    files = [str(tmp_path / f"x{suffix}") for suffix in FILES]

    assert run(name, TASK, *options, "--lang", "en", *(word for file in files for word in ("-o", file)))[0] == 0

    made = {
        "solve": lambda: solve(TASK, lang="en"),
        "sweep": lambda: sweep(TASK, lang="en"),
        "chart": lambda: chart(TASK, chart="depth", positions=36, lang="en"),
        "variants": lambda: all_variants(TASK, lang="en"),
    }[name]()
    again = made.save(*(tmp_path / f"y{suffix}" for suffix in FILES))
    for file, other in zip(files, again, strict=True):
        if not file.endswith(".xlsx"):
            assert Path(file).read_bytes() == other.read_bytes()


def test_of_several_charts_each_has_rows_of_its_own(tmp_path: Path) -> None:
    charts = chart(TASK, "3", chart="depth,stability", positions=36, lang="en")

    with pytest.raises(InputError, match="each chart has rows of its own: depth, stability"):
        charts.csv()
    assert [path.name for path in charts.save(tmp_path / "x.html")] == ["x-depth.html", "x-stability.html"]


def test_a_quantity_is_compared_and_calculated_with_as_a_number_in_its_unit(solution: Solution) -> None:
    speed, size = solution["V_B"], float(solution["V_B"])

    assert speed < size + 1
    assert speed > f"{size * 1000 - 1} mm/s"
    assert speed <= speed.to("km/h") * 1
    assert speed + speed.to("mm/s") == pytest.approx(2 * size)
    assert 1 / speed == pytest.approx(1 / size)
    assert (round(speed, 2), round(speed)) == (round(size, 2), round(size))
    assert (abs(speed), -speed, 1 - speed, 2 * speed, speed / speed) == (size, -size, 1 - size, 2 * size, 1)
    with pytest.raises(KulmanError):
        speed + solution["a_B"]


def test_a_quantity_equals_a_number_in_its_unit_and_a_text_that_says_it(solution: Solution) -> None:
    speed, idle = solution["V_B"], solution["M_03"]

    assert (speed == float(speed), speed == np.float64(float(speed)), idle == 0, speed == 5) == (
        True,
        True,
        True,
        False,
    )
    assert (idle == "0 N*m", idle == "0 Н·м", idle == "0 kg", idle == "nothing") == (True, True, False, False)
    assert idle in (1, 0)
    assert {0: "idle"}[idle] == "idle"  # type: ignore[index]
    assert solution["B"] != 0
    assert kulman.solve(TASK, set={"l_AB": 20, "phi": 90})["V_B"] not in (0, None)
    assert speed == kulman.solve(TASK, "3")["V_B"] != replace(speed, name="V_C")
    assert pickle.loads(pickle.dumps(speed)) in {speed}


def test_answers_are_marked_as_a_mapping_too(solution: Solution) -> None:
    checked = kulman.check(TASK, "3", lang="en")
    right = solution["V_B"]

    for value in (right, float(right), f"{float(right) * 1000:.2f} mm/s"):
        assert checked.mark({"V_B": value}).marked.mark > 0
    assert checked.mark({"V_B": 77}).marked.mark == 0
    for wrong in ({"V_Q": 3}, {"V_B": None}, 3):
        with pytest.raises(KulmanError):
            checked.mark(wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("task", [TASK, "madi-cam", "madi-gear", "karpenko-hoist"])
def test_a_report_crosses_to_another_process_whole(task: str) -> None:
    """A class may be marked by a pool of processes, whose results are sent back."""
    checked = kulman.check(task, lang="en")
    first, second = list(checked.asked.quantities)[:2]
    report = checked.mark({first: 1.0, second: 2.0})
    same = pickle.loads(pickle.dumps(report))

    assert (same.mark, same.text(), same._repr_html_()) == (report.mark, report.text(), report._repr_html_())
    marker, again = report.marked.marking.marker, same.marked.marking.marker
    assert (again.mus, again.written, again.segments) == (marker.mus, marker.written, marker.segments)
    assert repr([*again.lines()]) == repr([*marker.lines()])


@pytest.mark.parametrize("number", [np.array(55.0), np.float32(55.0), Decimal("55"), Fraction(110, 2), np.int64(55)])
def test_a_number_of_any_kind_is_a_number(number: Any) -> None:
    for way in (number, (number, "mm")):
        assert kulman.solve(TASK, set={"l_OA": way}, only="position")["l_OA"].value == pytest.approx(0.055)


def test_the_answers_of_a_solution_are_all_right() -> None:
    checked, own = kulman.check(TASK, "3", lang="en"), kulman.solve(TASK, "3")

    for answers in (own, dict(own)):
        assert checked.mark(answers).mark == 100.0
    with pytest.raises(KulmanError, match="there is no quantity 'V_Q'"):
        checked.mark({"V_Q": own["V_B"]})
    with pytest.raises(KulmanError, match="there is no quantity 'O'"):
        checked.mark({"O": own["B"], "V_B": own["V_B"]})


def test_answers_are_read_from_a_path(tmp_path: Path) -> None:
    checked = kulman.check(TASK, "3", lang="en")
    form = tmp_path / "answers.csv"
    form.write_text("name,value\nV_B,5.6\n", encoding="utf-8")

    assert [one.source for one in checked.read(form)] == [one.source for one in checked.read(str(form))]
    with pytest.raises(KulmanError, match="names: expected PathLike, not int"):
        checked.read(3)  # type: ignore[arg-type]


def test_what_there_is_not_is_refused_in_one_line_wherever_it_is_asked_for() -> None:
    charts = kulman.chart(TASK, chart="depth", positions=36)
    with pytest.raises(KulmanError) as caught:
        kulman.solve("none.toml")
    for asked, line in (
        (lambda: caught.value.text("de"), "unknown language 'de'; known are: uk, ru, en"),
        (lambda: charts["depht"], "unknown chart 'depht'; did you mean 'depth'"),
        (lambda: kulman.tasks("cams"), "unknown kind of task 'cams'; did you mean 'cam'"),
        (lambda: kulman.tasks("lever"), "unknown kind of task 'lever'; known are: mechanism, cam, gear, hoist"),
    ):
        with pytest.raises(KulmanError) as refused:
            asked()
        assert line in str(refused.value)
    assert repr(charts["depth"]) == "<Chart depth>"
    assert kulman.tasks("gear") == ("madi-gear",)


@pytest.mark.parametrize("variant", [3, np.int64(3), "3", [np.int64(3)], range(3, 4)])
def test_variants_are_named_by_texts_and_numbers(variant: Any) -> None:
    assert [*all_variants(TASK, variant, quantities="V_B").keys] == ["3"]


def test_a_unit_that_was_expected_is_spelled_as_the_language_does() -> None:
    said = []
    for asked in (
        lambda: kulman.solve(TASK, set={"l_OA": None}),
        lambda: kulman.solve_many(TASK, l_OA=["a"]),
        lambda: kulman.check(TASK, "3").mark({"V_B": None}),  # type: ignore[dict-item]
    ):
        with pytest.raises(KulmanError) as caught:
            asked()
        said.append([caught.value.text(language).partition(": ")[2] for language in ("en", "uk")])

    assert said[0] == ['a quantity was expected, such as "1 mm"', 'очікувалася величина, наприклад "1 мм"']
    assert "чисел у м або" in said[1][1]
    assert [text.rpartition("1 ")[2] for text in said[2]] == ['m/s"', 'м/с"']


def test_an_argument_that_a_note_lacks_is_compared_with_those_it_has() -> None:
    for call in (kulman.note, kulman.handout, kulman.sweep):
        with pytest.raises(KulmanError, match="unknown argument 'studnt'; did you mean student"):
            call(TASK, studnt="x")


@pytest.mark.parametrize(
    ("verb", "arguments", "said"),
    [
        ("sweep", {"end": "2 deg"}, "a crank makes a full turn: end is for sliding drivers only"),
        ("sweep", {"task": "madi-cam", "start": "2 deg"}, "madi-cam: start is not available for tasks of this kind"),
        ("sweep", {"start": "x"}, "start: 'x' is not a number"),
        ("sweep", {"end": "x"}, "end: 'x' is not a number"),
        ("chart", {"tolerance": -1}, "tolerance: '-1': must not be negative"),
        ("handout", {"steps": 3, "key": True}, "steps without key"),
        ("all_variants", {"ranges": {"l_OA": "20..30/5 mm"}}, "ranges and seed go with make"),
        ("solve", {"scales": {"mu_v": 1}}, "no scale factor 'mu_v'; did you mean 'mu_V'"),
        ("solve", {"set": {"l_oa": 1}}, "no given 'l_oa'; did you mean 'l_OA'"),
        ("solve", {"variant": "exampel"}, "no variant 'exampel'; did you mean 'example'"),
        ("solve", {"task": "shaper"}, "the tasks are: scheme-09-shaper, scheme-10-shaper-two-blocks, "),
        ("sheet", {"positions": 37}, "a cycle has from 3 to 36 positions, not 37"),
    ],
)
def test_an_error_speaks_of_arguments_and_knows_what_was_meant(
    verb: str, arguments: dict[str, Any], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(KulmanError, match=said) as caught:
        getattr(kulman, verb)(**{"task": TASK, **arguments})
    monkeypatch.setenv("KULMAN_LANG", "uk")

    assert re.search("[а-яі]{3}", str(caught.value))


def test_what_was_set_far_from_all_variants_is_warned_of() -> None:
    (warning,) = solve(TASK, "3", set={"l_OA": 0.04}, only="position").warnings

    assert "l_OA: 0.04 mm is far from what the variants of the task have, from 25 to 50 mm" in str(warning)
    assert solve(TASK, "3", set={"l_OA": "4 cm", "phi": 1.3}, only="position").warnings == ()


def test_newtons_for_kilonewtons_are_warned_of_and_a_small_force_is_not() -> None:
    """A force may have either sign, and 2000 kN were taken without a word."""
    (warning,) = solve(TASK, "3", set={"F_3": 2000}).warnings

    assert "F_3: 2000 kN is far from what the variants of the task have, from 1.5 to 6 kN" in str(warning)
    assert len(solve(TASK, "3", set={"F_3": -2000}).warnings) == 1
    assert solve(TASK, "3", set={"F_3": 0.001}).warnings == ()
    assert solve(TASK, "3", set={"F_3": "2000 N"}).warnings == ()


def test_no_angle_is_far_from_another(tmp_path: Path) -> None:
    (file := tmp_path / "task.toml").write_text(re.sub(r'phi = "\d+ deg"', 'phi = "1 deg"', text_of(TASK)), "utf-8")

    assert solve(str(file), "3", set={"phi": 150}).warnings == ()


def test_a_report_has_its_mark_and_is_text_or_files(tmp_path: Path) -> None:
    report = kulman.check(TASK, "3", lang="en").mark({"V_B": 5.62, "omega_2": "99 rad/s"})

    assert report.text().startswith("Slider-crank: kinematic and force analysis\n")
    assert 0.0 < report.mark == report.to_json()["mark"] < 10.0
    page, text = report.save(tmp_path / "report.html", tmp_path / "report.txt")
    assert text.read_text("utf-8") == report.text()
    assert page.read_text("utf-8").startswith("<!DOCTYPE html>")
    with pytest.raises(KulmanError, match="a marked drawing can be written only for one drawing of one student"):
        report.save(tmp_path / "report.pdf")


def test_what_changes_nothing_on_a_chart_is_told_by_the_name_of_the_argument() -> None:
    said = kulman.chart(TASK, chart="stability", quantities="V_B", positions=4, tolerance=5).warnings

    assert [str(one) for one in said] == ["tolerance changes nothing on charts of this kind: stability"]
    assert repr(said) == "(InputError('tolerance changes nothing on charts of this kind: stability'),)"


@pytest.mark.parametrize("task", ["madi-cam", "madi-gear", "karpenko-hoist"])
def test_only_a_linkage_has_positions_and_whatever_else_says_so(task: str) -> None:
    assert sweep("nau-slider-crank").cycle.motions[0].travel.length == pytest.approx(0.05)

    with pytest.raises(InputError) as refused:
        _ = sweep(task).cycle
    assert (refused.value.key, refused.value.data["text"]) == ("kind-without", "cycle")
