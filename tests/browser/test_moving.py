"""Pages that move, driven as people do: by slider, crank, keyboard; what they show is what Python finds."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kulman
from kulman.variants.batches.site import site
from kulman.variants.case import Request
from kulman.variants.reader import load_task

TASKS = (
    "nau-slider-crank",
    "madi-four-bar",
    "scheme-09-shaper",
    "scheme-14-jaw-crusher",
    "scheme-18-hydraulic-drive",
    "scheme-20-press-automaton",
)
COURSES = ("madi-cam", "madi-gear", "karpenko-hoist")
LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
SHOWN = 2e-3  # part of a value within which four digits show it
PLAIN = 1.5  # ms for 2000 attributes, where a frame of the largest page takes 1.2 to 1.5
Opened = Callable[[str], Any]


@cache
def written(task: str, language: str, variant: str | None = None) -> bytes:
    """The page of a task, drawn once for all tests."""
    return kulman.sheet(task, variant, lang=language).beside[".html"]()


@pytest.fixture
def opened(browser: Any, tmp_path: Path) -> Any:
    """Open the page of a task; nothing may be asked of a network, nor said on the console, while it is used."""
    wrong: list[str] = []
    pages: list[Any] = []

    def open_page(task: str, width: int = 1300, language: str = "uk", variant: str | None = None) -> Any:
        (tmp_path / "moving.html").write_bytes(written(task, language, variant))
        page = browser.new_page(viewport={"width": width, "height": 900})
        page.on("console", lambda message: wrong.append(message.text))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda request: wrong.append(request.url) if request.url[:5] != "file:" else None)
        page.goto((tmp_path / "moving.html").as_uri())
        pages.append(page)
        return page

    yield open_page
    for page in pages:
        page.close()
    assert wrong == []


def number(text: str) -> float:
    plain = text.replace("\u2212", "-").replace(",", ".").replace("·10", "e").translate(LOWERED)
    return float(re.sub(r"[^-0-9.e]", "", plain))


def values(page: Any) -> dict[str, float]:
    rows = page.eval_on_selector_all("#values tbody tr", "rows => rows.map(r => [r.dataset.q, r.cells[1].textContent])")
    return {name: number(text) for name, text in rows if text != "–"}


def at(page: Any) -> float:
    return float(page.evaluate("here.at"))


def right_course(page: Any, task: str, settings: dict[str, float | str]) -> None:
    """What the page shows is what Python finds of the course at the same place."""
    case = Request(load_task(task), None, settings).case()
    course = case.kind.course(case.solved)
    assert course is not None
    columns = {column.name: float(column.values[0]) for column in course.columns(np.array([at(page)]))}
    by = page.evaluate("Object.fromEntries(D.quantities.map(q => [q.name, q.by]))")
    shown = values(page)
    assert len(shown) > 6
    for name, value in shown.items():
        assert value == pytest.approx(columns[name] * by[name], rel=SHOWN, abs=1e-9), name


def right(page: Any, task: str, settings: dict[str, float | str]) -> None:
    """What the page shows is what Python finds at the same place of the driver."""
    drive = page.evaluate("drive.name")
    place = f"{at(page):.15g} {'rad' if page.evaluate('drive.turns') else 'm'}"
    if task in COURSES:
        return right_course(page, task, settings)
    solved = kulman.solve(task, set={**settings, drive: place})
    units = {name: solved.case.display.value(1.0, solved[name].unit) for name in solved}
    shown = values(page)
    assert len(shown) > 10
    largest: dict[str, float] = {}
    for name in shown:
        size = abs(float(solved[name]))
        largest[solved[name].unit] = max(size, largest.get(solved[name].unit, 0.0))
    for name, value in shown.items():
        if solved[name].unit != "%":
            exact = float(solved[name]) * units[name]
            assert value == pytest.approx(exact, rel=SHOWN, abs=1e-9 * largest[solved[name].unit] * units[name]), name


@pytest.mark.parametrize("task", [*TASKS, *COURSES])
def test_a_plan_moves_under_the_hand_of_a_user(task: str, opened: Opened) -> None:
    page = opened(task)
    right(page, task, {})

    slider = page.locator("#place")
    slider.focus()
    before = at(page)
    for _ in range(7):
        page.keyboard.press("ArrowRight")
    assert at(page) != before
    right(page, task, {})

    if page.evaluate("drive.crank"):  # a hoist has only its time
        box = page.locator("#left .grip").bounding_box()
        before = at(page)
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] + 25, box["y"] - 15, steps=4)
        page.mouse.up()
        assert at(page) != before
        right(page, task, {})

    before = at(page)
    page.locator("#play").click()
    page.wait_for_function("before => here.at !== before", arg=before)
    page.locator("#play").click()
    right(page, task, {})


@pytest.mark.parametrize("task", [*TASKS, *COURSES])
def test_the_construction_is_told_to_its_end(task: str, opened: Opened) -> None:
    page = opened(task)
    for view in page.evaluate("D.views.filter(view => view.steps.length).map(view => view.name)"):
        page.select_option("#replayed", view)
        count = page.locator("#told li").count()
        page.locator("#first").click()
        side = "#left" if view == "position" else "#right"
        hidden = page.locator(f"{side} .gone").count()
        for _ in range(count):
            page.locator("#next").focus()
            page.keyboard.press("Enter")
        assert page.locator("#told li.now").count() == 1
        assert page.locator("#told li.later").count() == 0
        assert page.locator(f"{side} .gone").count() == 0 < hidden
        assert not any("\ue000" <= sign <= "\uf8ff" for sign in page.locator("#told").inner_text())


def test_other_data_are_taken_as_long_as_links_meet(opened: Opened) -> None:
    page = opened("nau-slider-crank")
    field = page.locator("#given-l_AB")
    field.fill("140,5")
    field.press("Tab")
    right(page, "nau-slider-crank", {"l_AB": "140.5"})
    for value in ("0", "-2"):
        page.locator("#given-F_3").fill(value)
        page.locator("#given-F_3").press("Tab")
        right(page, "nau-slider-crank", {"l_AB": "140.5", "F_3": value})

    page.locator("#given-l_OA").fill("900")
    page.locator("#given-l_OA").press("Tab")
    field.fill("-5")
    field.press("Tab")
    assert field.input_value() == "140,5"
    assert "більше за нуль" in page.locator("#status").inner_text()

    page.locator("#again").click()
    right(page, "nau-slider-crank", {})


@pytest.mark.parametrize(
    ("task", "name", "value", "bad"), [("madi-cam", "R_roller", "12", "40"), ("karpenko-hoist", "V_0", "0,12", "1,5")]
)
def test_other_data_of_a_course_are_taken_as_long_as_its_formulas_hold(
    task: str, name: str, value: str, bad: str, opened: Opened
) -> None:
    page = opened(task)
    field = page.locator(f"#given-{name}")
    sizes = page.evaluate("Object.fromEntries(D.givens.map(item => [item.name, given[item.name]]))")
    found = {key: f"{sizes[key]!r} m" for key in ("r_0", "e", "r_0_flat") if key in sizes}  # the page keeps them
    field.fill(value)
    field.press("Tab")
    right(page, task, {**found, name: value})
    assert page.locator("#which option:not([disabled])").count() == page.evaluate(
        "D.views.filter(v => !v.drawn).length - 1"
    )
    assert page.evaluate("shownViews().every(view => !view.drawn)")

    field.fill(bad)
    field.press("Tab")
    assert field.input_value() == value
    assert page.locator("#status").inner_text() != ""
    right(page, task, {**found, name: value})

    page.locator("#again").click()
    right(page, task, {})
    assert page.locator("#which option[disabled]").count() == 0
    assert page.locator("#right").is_visible()


def test_what_a_position_has_not_is_not_shown(opened: Opened) -> None:
    page = opened("nau-slider-crank")
    page.locator("#given-l_AB").fill("20")
    page.locator("#given-l_AB").press("Tab")
    page.evaluate("go(Math.PI / 2)")

    assert page.locator("#status").inner_text() == "Положення недосяжне: ланки не сходяться."
    assert values(page) == {}


def test_play_says_what_it_passes_by(opened: Opened) -> None:
    page = opened("nau-slider-crank")
    page.locator("#given-l_AB").fill("20")
    page.locator("#given-l_AB").press("Tab")
    page.evaluate("for (let k = 0; k < 360 && stand(place(k))[0] < FAILED; k++) go(place(k))")  # to the edge of the arc
    page.locator("#play").click()
    page.wait_for_function("$('status').textContent.startsWith('Пропущено від')", timeout=20_000)
    page.locator("#play").click()
    assert values(page) != {}

    page.locator("#again").click()
    assert at(page) == page.evaluate("drive.start")


def test_the_construction_that_is_chosen_is_seen_at_once_and_stays_in_view(opened: Opened) -> None:
    page = opened("scheme-09-shaper", 390)
    page.select_option("#replayed", "acceleration")
    assert page.locator("#which").input_value() == "acceleration"
    page.locator("#next").scroll_into_view_if_needed()
    for _ in range(6):
        page.locator("#next").click()
    box = page.locator("#right").bounding_box()
    assert -1.0 <= box["y"] <= page.viewport_size["height"] - box["height"]


# how many lines go through the inner part of each letter
CUT = """inside => [...document.querySelectorAll("#right text:not(.crowded):not(.short):not(.gone)")].map(text => {
    const { x, y, width, height } = text.getBoundingClientRect();
    const inner = [x + width * (1 - inside), y + height * (1 - inside), x + width * inside, y + height * inside];
    const through = [...document.querySelectorAll("#right line.main")].filter(line => {
        const ends = [1, 2].map(k => new DOMPoint(line[`x${k}`].baseVal.value, line[`y${k}`].baseVal.value));
        const [a, b] = ends.map(end => end.matrixTransform(line.getScreenCTM())).map(({ x, y }) => [x, y]);
        return crosses(a, b, inner);
    });
    return [text.textContent, through.length];
})"""


def test_letters_of_a_simple_plan_stand_on_no_line(opened: Opened) -> None:
    page = opened("nau-slider-crank", variant="3")
    for part in (120, 140, 240, 300):
        page.evaluate(f"go({math.radians(part)})")
        assert [text for text, lines in page.evaluate(CUT, 0.93) if lines] == []


@pytest.mark.parametrize("task", ["scheme-09-shaper", "scheme-20-press-automaton"])
def test_no_letter_of_a_crowded_plan_stands_on_others_or_on_many_lines(task: str, opened: Opened) -> None:
    page = opened(task)
    boxes = """() => [...document.querySelectorAll("#right text:not(.crowded):not(.short):not(.gone)")]
        .map(text => [text.getBoundingClientRect(), text.textContent])
        .map(([box, text]) => [box.x, box.y, box.right, box.bottom, text])"""
    for part in range(0, 360, 30):
        page.evaluate(f"go({math.radians(part)})")
        assert [text for text, lines in page.evaluate(CUT, 0.77) if lines > 2] == []
        placed = page.evaluate(boxes)
        for k, (x0, y0, x1, y1, one) in enumerate(placed):
            for u0, v0, u1, v1, other in placed[k + 1 :]:
                across, down = min(x1, u1) - max(x0, u0), min(y1, v1) - max(y0, v0)
                assert across <= 0.35 * min(x1 - x0, u1 - u0) or down <= 0.35 * min(y1 - y0, v1 - v0), (
                    part,
                    one,
                    other,
                )

    # the quickest of many, lest it be the machine that is slow
    frames = """() => Math.min(...Array.from({ length: 40 }, (_, k) => {
        const begin = performance.now();
        for (let n = 0; n < 9; n++) go(place(k * 9 + n));
        return (performance.now() - begin) / 9 }))"""
    # a machine that is slow, or has other work, is slow at plain attributes, too
    plain = """() => { const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
        return Math.min(...Array.from({ length: 40 }, () => {
            const begin = performance.now();
            for (let n = 0; n < 2000; n++) line.setAttribute("x1", n + 0.5);
            return performance.now() - begin })) }"""
    before, frame, after = map(page.evaluate, (plain, frames, plain))
    assert frame < 2.0 * max(1.0, before / PLAIN, after / PLAIN)


def test_keyboard_alone_suffices_and_nothing_is_out_of_reach(opened: Opened) -> None:
    page = opened("nau-slider-crank")
    reached = set[str]()
    for _ in range(160):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id || document.activeElement.getAttribute('class') || ''"))
    assert {"play", "place", "which", "replayed", "first", "back", "next", "all", "again", "grip"} <= reached
    page.locator(".grip").focus()
    before = at(page)
    page.keyboard.press("ArrowUp")
    turned = (before - at(page)) % math.tau
    assert min(turned, math.tau - turned) == pytest.approx(math.radians(1.0), abs=1e-6)


def test_the_index_of_a_site_can_be_read_by_all_and_leads_to_its_pages(browser: Any, tmp_path: Path) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page = browser.new_page(viewport={"width": 390, "height": 800})
    page.goto(site(tmp_path, ["madi-gear"], lang="en", jobs=1).index.as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert axe.Axe().run(page).response["violations"] == []
    page.locator("a").first.press("Enter")
    page.wait_for_selector("#play")
    assert page.url.endswith("/madi-gear/17.html")


@pytest.mark.parametrize("language", ["uk", "en"])
@pytest.mark.parametrize("task", ["scheme-09-shaper", *COURSES])
def test_a_page_can_be_read_by_all(task: str, language: str, opened: Any) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page = opened(task, 1300, language)
    for width in (1300, 390):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        found = axe.Axe().run(page).response["violations"]
        assert [(fault["id"], [node["html"] for node in fault["nodes"]][:3]) for fault in found] == []
