"""Photographs in a real browser with the keyboard alone: a teacher's small stack ends as typed forms do."""

from __future__ import annotations

import csv
import io
import zipfile
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest

from kulman import check
from kulman.tests.browser.test_serving import choose, fault_free, followed, reach, saved
from kulman.tests.photos.stacks import CLASS, TASK, Stack, stack_of
from kulman.variants.marking.checks import write_tables

MINUTES = 8 * 60_000


@pytest.fixture(autouse=True)
def patient(page: Any) -> None:
    page.set_default_timeout(MINUTES)


def pressed(page: Any, times: int = 1) -> None:
    """Press Enter on what has the focus, and wait for the page that follows."""
    for _ in range(times):
        with page.expect_navigation():
            page.keyboard.press("Enter")
        page.wait_for_load_state("networkidle")  # what is asked next is all there


def answered(page: Any, stack: Stack, seen: set[str]) -> int:
    """Answer the question that is shown, and return with how many keys that choose something.

    The first of each kind, whose kinds have been `seen`, is looked at for faults.
    """
    kind = next((kind for kind in ("#keep-0", "button[value^='#']", "#yes") if page.locator(kind).count()), "")
    if kind not in seen:
        fault_free(page)
        seen.add(kind)
    if page.locator("#keep-0").count():
        followed(page, "#keep-0")
        return 1
    if page.locator("button[value^='#']").count():
        about = page.locator(".about").first.inner_text()
        whose = next((f"#{number}" for name, number in stack.whose.items() if name in about), "-")
        assert (whose == "-") == bool(page.locator(".problem").count())
        followed(page, f"button[value='{whose}']")
        return 1
    if page.locator("#yes").count():
        reach(page, "svg a")  # the nearest point: that of the end itself
    else:
        reach(page, f"svg a[href='{nearest(page, stack)}']")
    pressed(page)
    assert page.evaluate("document.activeElement.id") == "yes"
    pressed(page)
    return 2


def nearest(page: Any, stack: Stack) -> str:
    """Return the address of the point that is nearest to where the vector that is asked about was drawn to end."""
    symbol = page.locator("h1").inner_text().rstrip("?").split()[-1]  # of a^n_BA the letters stand in another order
    about, students = page.locator(".about").first.inner_text(), [*stack.truth]
    called = {student: student for student in students} | {name: students[n] for name, n in stack.whose.items()}
    (truth,) = (stack.truth[student] for name, student in called.items() if name in about)
    (tip,) = (one.tip for name, one in truth.items() if sorted(name.replace("_", "")) == sorted(symbol))

    def off(address: str) -> float:
        x, y = parse_qs(urlsplit(address).query)["tip"][0].split(",")
        return abs(complex(float(x), float(y)) - tip)

    return min((one.get_attribute("href") for one in page.locator("svg a").all()), key=off)


@pytest.fixture(params=[2, pytest.param(30, marks=pytest.mark.soak)], ids=["two", "thirty"])
def handed_in(request: pytest.FixtureRequest, tmp_path: Path) -> Stack:
    """Pictures of two students, or thirty: three that cannot be read, two without a name, one twice."""
    if request.param == 2:
        return request.getfixturevalue("stack")
    return stack_of(tmp_path, CLASS, nameless=2, blurred=3, seed=11)


def test_a_teacher_is_asked_and_marks_are_those_of_typed_forms(page: Any, handed_in: Stack, tmp_path: Path) -> None:
    stack = handed_in
    followed(page, "a[href$='/marks']")
    choose(page, "#tasks", TASK)
    reach(page, "#forms").set_input_files(stack.pictures)
    reach(page, "#roster").set_input_files(stack.roster)
    reach(page, "button.main")
    page.keyboard.press("Enter")
    page.locator("a[href*='/asked/']").first.wait_for(timeout=MINUTES)
    fault_free(page)
    asked = page.locator(".files li").count()
    followed(page, "a.main")
    seen = set[str]()
    for _ in range(asked):
        assert answered(page, stack, seen) <= 2
        if page.locator("#done").count():
            break

    assert page.evaluate("document.activeElement.id") == "done"
    pressed(page)
    page.locator("a[href*='.zip']").wait_for(timeout=MINUTES)
    with zipfile.ZipFile(io.BytesIO(saved(page, "a[href*='.zip']"))) as archive:
        made = {name: archive.read(name) for name in archive.namelist()}
    assert page.locator("a.button[href*='/asked/']").count() == 1  # answers can be changed
    typed = check(TASK, roster=stack.roster, lang="uk")
    answers = typed.ordered(typed.read(str(stack.typed)))
    write_tables(typed, typed.mark_all(answers, jobs=1), answers, [], tmp_path / "moodle.csv")

    rows, wanted = (
        [(row["Full name"], row["Grade"]) for row in csv.DictReader(io.StringIO(data.decode("utf-8-sig")))]
        for data in (made["moodle.csv"], (tmp_path / "moodle.csv").read_bytes())
    )
    assert rows == wanted
    assert made["sheets.pdf"].startswith(b"%PDF")
    assert sum(name.endswith(".pdf") for name in made) == len(wanted) + 1  # one of each, one of all


def test_an_end_is_moved_by_a_click_on_the_picture(page: Any, stack: Stack) -> None:
    page.goto(f"{page.url}task/{TASK}/check?v=3")
    page.set_input_files("#drawing", stack.pictures[0])
    page.locator("form[enctype] button.main").click(timeout=MINUTES)
    page.locator("a[href*='/asked/']").click(timeout=MINUTES)
    page.locator("a.main").click()
    page.wait_for_load_state("networkidle")  # the script that takes clicks has come
    before = page.locator("[name='tip']").input_value()
    box = page.locator("#plan").bounding_box()
    with page.expect_navigation():
        page.mouse.click(box["x"] + 0.6 * box["width"], box["y"] + 0.3 * box["height"])
    assert page.locator("[name='tip']").input_value() != before
    assert page.evaluate("document.activeElement.id") == "yes"
    for width in (1280, 390):
        page.set_viewport_size({"width": width, "height": 844})
        fault_free(page)
