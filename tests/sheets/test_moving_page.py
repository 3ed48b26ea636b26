"""Pages that move: their numbers are those of Python at all places, their words those of the note; they are small."""

from __future__ import annotations

import json
import random
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
import quickjs

import kulman
from kulman.plans.cams import cam as cams
from kulman.plans.cams.solve import solve_cam
from kulman.plans.hoist import hoist as hoists
from kulman.plans.hoist.solve import solve_hoist
from kulman.plans.linkages.cycle import cycle
from kulman.plans.names import role
from kulman.plans.quantities import unit_of
from kulman.scales.errors import InputError
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.variants import sheets
from kulman.variants.case import Case, Request
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled, text_of

from ..support.cams import ROCKER

# among them a rocker, and a hoist whose rope goes slack, so that its motion is in pieces
COURSES = [("madi-cam", {}), ("karpenko-hoist", {"V_0": 1.5}), ("madi-gear", {}), (ROCKER, {}), ("karpenko-hoist", {})]
LINKAGES = bundled("mechanism")
# a crank, a stroke with loads of its own, a group of class III
SOME = ("nau-slider-crank", "scheme-09-shaper", "scheme-20-press-automaton")
# variants whose names are one on a disk
ALIKE = "".join(
    f'\n[[variant]]\nid = "{name}"\nm = "5 mm"\nz_1 = 15\nz_2 = 20\nx_1 = 0.2\nx_2 = 0.85\n' for name in ("1.7", "1-7")
)
PLACES = 24
SAME = 1e-12
LARGEST = 150_000  # bytes
# sizes that are changed on the page, in the units of its task
CHANGED = [("nau-slider-crank", "l_AB", 1.1), ("scheme-01-compressor", "l_AB", 1.2), ("scheme-09-shaper", "l_CD", 1.05)]


@cache
def page_of(task: str, language: str = "uk", **settings: float) -> str:
    """Return a page without drawing the sheet beside which it is written."""
    return sheets.page_of(Request(load_task(task), None, settings, language=language).case())


def data_of(page: str) -> dict[str, Any]:
    found = re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    return dict(json.loads(found[1].replace("<\\/", "</")))


def engine(page: str) -> Any:
    """What calculates in a page, in an engine that has no page."""
    script = page.split("<script>")[1].partition("</script>")[0]
    context = quickjs.Context()
    context.set("text", json.dumps(data_of(page)))
    context.eval(script.replace('document.getElementById("data").textContent', "text"))
    return context


def found_at(context: Any, names: list[str], places: Any) -> dict[str, Any]:
    """Return values by name, and the codes of the statuses, at places of the driver."""
    rows = [json.loads(context.eval(f"JSON.stringify(stand({place!r}))")) for place in places.tolist()]
    values: dict[str, Any] = {"code": np.array([row[0] for row in rows])}
    for at, name in enumerate(names, 1):
        column = [row[at] for row in rows]
        sized = [complex(*(np.nan if x is None else x for x in v)) if isinstance(v, list) else v for v in column]
        values[name] = np.array([np.nan if v is None else v for v in sized])
    return values


def apart(values: dict[str, Any], expected: dict[str, Any]) -> dict[str, float]:
    """Return the names whose values differ, and by how much in parts of the largest of their unit or plan."""
    kinds = {name: role(name).plan if "." in name else unit_of(role(name).shown) for name in expected}
    largest: dict[str, float] = {}
    for name, right in expected.items():
        size = np.abs(right[np.isfinite(right)]).max(initial=0.0)
        largest[kinds[name]] = max(largest.get(kinds[name], 100.0 if kinds[name] == "%" else 0.0), size)
    found = {}
    for name, right in expected.items():
        defined = np.isfinite(right)
        if (np.isfinite(values[name]) != defined).any():
            found[name] = np.inf
        elif defined.any() and (gap := np.abs(values[name] - right)[defined].max()) > SAME * largest[kinds[name]]:
            found[name] = gap
    return found


@pytest.mark.parametrize(
    ("task", "places"),
    some([(task, PLACES) for task in SOME], 0, 1) + [pytest.param(t, 360, marks=pytest.mark.soak) for t in LINKAGES],
)
def test_a_page_finds_what_python_finds(task: str, places: int) -> None:
    case = Request(load_task(task)).case()
    whole = cycle(case.task.mechanism, case.values, case.plans)
    page = page_of(task)
    names = data_of(page)["names"]
    at = np.linspace(whole.range.low, whole.range.high, places, endpoint=False) + 0.00137 * whole.drive.turns

    expected = whole.at(at, names)

    assert apart(found_at(engine(page), names, at), expected) == {}
    assert len(page.encode()) <= LARGEST


@pytest.mark.parametrize(("task", "settings"), some(COURSES, 0, 3))
def test_a_page_of_a_course_finds_what_python_finds(task: str, settings: dict[str, float]) -> None:
    case = Request(load_task(task), None, settings).case()
    course = case.kind.course(case.solved)
    assert course is not None
    page = page_of(task, **settings)
    at = course.places(360) + (0.00137 if case.task.kind == "cam" else 0.0)
    expected = {column.name: column.values for column in course.columns(at)}

    found = found_at(engine(page), data_of(page)["names"], at)

    for name, right in expected.items():
        size = np.abs(right[np.isfinite(right)]).max()
        np.testing.assert_allclose(
            found[name], np.where(np.isfinite(right), right, np.nan), 0.0, SAME * size, err_msg=name
        )
    assert {q["name"] for q in data_of(page)["quantities"]} <= expected.keys()
    assert len(page.encode()) <= LARGEST


@pytest.mark.parametrize("task", some(["madi-cam", ROCKER, "karpenko-hoist"], 0, 2))
def test_a_page_of_a_course_finds_what_python_finds_of_other_data(task: str) -> None:
    choose = random.Random(13)
    before = Request(load_task(task)).case()
    now = before.kind.course(before.solved)
    assert now is not None
    page = page_of(task)
    context, names = engine(page), data_of(page)["names"]
    solve, known = (solve_hoist, hoists) if "hoist" in task else (solve_cam, cams)
    numbers = {name: before.solved.givens[name] for name in known.VALUES if name in before.solved.givens}
    for _ in range(4):
        other = {name: value * choose.uniform(0.97, 1.03) for name, value in now.changeable.items()}
        solved = solve(getattr(before.solved, before.task.kind), {**numbers, **other, "rho_flat": 1e-3})
        course = before.kind.course(solved)
        assert course is not None
        beyond = context.eval(f"Object.assign(given, {json.dumps(other)}); taken()")
        at = course.places(90) + (0.00137 if before.task.kind == "cam" else 0.0)
        expected = {column.name: column.values for column in course.columns(at)}

        found = found_at(context, names, at)

        assert beyond is None
        for name, right in expected.items():
            size = np.abs(right[np.isfinite(right)]).max()
            right = np.where(np.isfinite(right), right, np.nan)
            np.testing.assert_allclose(found[name], right, 0.0, 10.0 * SAME * size, err_msg=name)


@pytest.mark.parametrize(
    ("task", "other", "limit"),
    some(
        [
            ("madi-cam", {"R_roller": 0.04}, "limit.undercut"),
            ("madi-cam", {"e": 0.05}, "."),
            ("madi-cam", {"r_0_flat": 0.02}, "limit.undercut_plate"),
            ("karpenko-hoist", {"V_0": 1.5}, "limit.slack"),
            ("karpenko-hoist", {"V_0": 0.0, "a": 0.0}, "."),
        ],
        0,
        3,
    ),
)
def test_a_page_refuses_data_for_which_its_formulas_are_not_valid(task: str, other: Any, limit: str) -> None:
    context = engine(page_of(task))

    assert context.eval("taken()") is None
    assert context.eval(f"Object.assign(given, {json.dumps(other)}); taken()") == limit
    assert context.eval("Object.assign(given, D.board); taken()") is None


@pytest.mark.parametrize(("task", "name", "times"), some(CHANGED, 0, 1))
def test_a_page_finds_what_python_finds_of_other_data(task: str, name: str, times: float) -> None:
    page = page_of(task)
    item = next(given for given in data_of(page)["givens"] if given["name"] == name)
    case = Request(load_task(task), None, {name: str(item["value"] * times)}).case()
    whole = cycle(case.task.mechanism, case.values, case.plans)
    context, names = engine(page), data_of(page)["names"]
    board = json.dumps(item["board"])
    context.eval(f"for (const name of {board}) given[name] *= {times!r}; here.changed = true; sample()")
    at = np.linspace(0.01, 6.2, 12)

    gaps = apart(found_at(context, names, at), whole.at(at, names))

    # the ends of a stroke are found by another search, which ends where the travel is flat
    assert {key: gap for key, gap in gaps.items() if not (data_of(page)["stroke"] and gap < 1e-9)} == {}


@pytest.mark.parametrize("language", ["ru", *(pytest.param(lang, marks=pytest.mark.soak) for lang in ("uk", "en"))])
def test_a_page_speaks_its_language_and_needs_nothing_else(language: str) -> None:
    page = page_of("scheme-09-shaper", language)
    data = data_of(page)

    assert f'<html lang="{language}">' in page
    assert "{{" not in page
    assert not re.search(r"(?:src|href)=|https?://(?!www\.w3\.org/2000/svg)|@import|fetch\(", page)
    asked = {sign for view in data["views"] for step in view["steps"] for sign in step if "\ue000" <= sign <= "\uf8ff"}
    assert not any("⟦" in step for view in data["views"] for step in view["steps"])
    assert asked <= {chr(0xE000 + k) for k in range(len(data["asked"]))}
    assert [view["name"] for view in data["views"]][:3] == ["position", "velocity", "acceleration"]
    assert all(view["steps"] and view["shapes"] for view in data["views"])


def test_figures_of_a_page_are_those_of_the_sheet_and_their_steps_those_of_the_note() -> None:
    note = kulman.note("madi-cam", lang="uk")
    told = {view.name: len([key for key in view.stages.values() if key]) for view in note.sheet.views if view.stages}
    data = data_of(page_of("madi-cam"))
    drawn = {view["name"]: view for view in data["views"] if "drawn" in view}

    assert {name: len(view["steps"]) for name, view in drawn.items()} == told
    for view in drawn.values():  # every step draws something, and nothing is left for after the last one
        assert {stage for stage, *_ in view["drawn"]} == set(range(len(view["steps"]) + 1))


@pytest.mark.parametrize("task", ["scheme-14-jaw-crusher", "scheme-15-lever-shears", "scheme-08-planer"])
def test_every_point_with_a_letter_is_drawn_and_every_link_between_joints_has_its_number(task: str) -> None:
    shapes, mechanism = data_of(page_of(task))["views"][0]["shapes"], load_task(task).mechanism
    ends = {
        link.number: {pair.point for pair in mechanism.pairs if link.number in pair.links} for link in mechanism.links
    }
    lettered = {shape["at"] for shape in shapes if shape["k"] == "letter"}
    assert lettered == {shape["at"] for shape in shapes if shape["k"] in ("pin", "pivot", "centre", "block", "guide")}
    numbered = {shape["link"] for shape in shapes if shape["k"] == "number"}
    assert numbered == {number for number, points in ends.items() if len(points) > 1}


@pytest.mark.parametrize("task", some(SOME, 0))
def test_poles_are_there_from_the_beginning_and_other_points_of_plans_with_a_step(task: str) -> None:
    plans = [view for view in data_of(page_of(task))["views"] if view["name"] != "position"]
    for plan in plans:
        begins = {kind: {s["from"] for s in plan["shapes"] if s["k"] == kind} for kind in ("pole", "mark")}
        assert begins["pole"] == {0}
        assert begins["mark"] <= {*range(1, len(plan["steps"]) + 1)}
    assert "lever" in {plan["name"] for plan in plans}


def test_what_hangs_on_the_rope_of_a_hoist_moves_along_it() -> None:
    shapes = data_of(page_of("karpenko-hoist"))["views"][0]["shapes"]
    ends = [shape[key] for shape in shapes for key in ("a", "b", "at") if isinstance(shape.get(key), list)]

    assert {(way, across) for _, way, _, across in ends} == {("load.s", 0.0), ("drum.w_2", 0.0)}


def test_a_page_is_written_beside_the_sheet(tmp_path: Any, run: Run) -> None:
    files = [str(tmp_path / name) for name in ("moving.html", "sheet.svg")]
    status, *_ = run("sheet", "nau-slider-crank", "-o", files[0], "-o", files[1])
    assert status == 0
    assert (tmp_path / "moving.html").read_text("utf-8") == page_of("nau-slider-crank")


def test_a_page_has_neither_paper_nor_positions(tmp_path: Any, run: Run) -> None:
    def told(*words: str) -> tuple[object, str]:
        status, _, err = run("sheet", "nau-slider-crank", "--lang", "en", *words)
        return status, err

    page, sheet = (["-o", str(tmp_path / name)] for name in ("page.html", "sheet.svg"))
    assert told(*page, "--format", "A4") == (0, "")
    assert "scale factors are not those" in told(*page, *sheet, "--format", "A4")[1]
    assert told("-o", str(tmp_path / "x.html"), "--positions", "12") == (2, "expected --positions without -o *.html\n")
    assert not (tmp_path / "x.html").exists()


@pytest.mark.soak
def test_a_site_has_a_page_for_every_variant_and_an_index(tmp_path: Any, run: Run) -> None:
    own = tmp_path / "own.toml"
    own.write_text(text_of("madi-gear").replace('id = "madi-gear"', 'id = "own"') + ALIKE, "utf-8")
    status, _, err = run("page", "--all", tmp_path / "site", "madi-gear", own, "--lang", "ru", "--jobs", "1")

    index = (tmp_path / "site" / "index.html").read_text("utf-8")
    links = re.findall(r'href="([^"]+)"', index)
    assert (status, err) == (0, "")
    assert '<html lang="ru">' in index
    assert links == ["madi-gear/17.html", "own/17.html", "own/1-7.html", "own/1-7-2.html"]
    assert all('<html lang="ru">' in (tmp_path / "site" / link).read_text("utf-8") for link in links)
    assert (tmp_path / "site" / links[0]).read_text("utf-8") == page_of("madi-gear", "ru")


def test_a_site_is_bounded_and_says_what_it_could_not_draw(tmp_path: Any, monkeypatch: Any, run: Run) -> None:
    monkeypatch.setattr("kulman.variants.batches.site.MOST", 3)
    status, _, err = run("page", "--all", tmp_path / "site", "nau-slider-crank", "--lang", "en")
    assert status == 2
    assert err == "11 pages, 3 at most: name the tasks of the site\n"
    assert not (tmp_path / "site").exists()


def test_a_site_says_which_pages_it_could_not_make(tmp_path: Any, monkeypatch: Any, run: Run) -> None:
    def broken(case: Case) -> str:
        if case.variant == "4":
            raise InputError("kind-without", task="x", text="y")
        return "page"

    monkeypatch.setattr("kulman.variants.batches.site.page_of", broken)
    status, _, said = run("page", "--all", tmp_path / "site", "nau-slider-crank", "--lang", "en", "--jobs", "1")

    index = (tmp_path / "site" / "index.html").read_text("utf-8")
    assert status == 2
    assert said.startswith("nau-slider-crank 4: ")
    assert said.endswith("pages that could not be made: 1\n")
    assert "nau-slider-crank/3.html" in index
    assert "nau-slider-crank/4.html" not in index
