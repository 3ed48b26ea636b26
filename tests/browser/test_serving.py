"""The program in a browser, walked through with the keyboard alone: a student's way and a teacher's."""

from __future__ import annotations

import io
import zipfile
from itertools import product
from pathlib import Path
from typing import Any

import pypdfium2
import pytest

import kulman
from kulman.variants.marking.class_page import ClassPage
from kulman.variants.marking.result import Result
from kulman.variants.roster import Who
from kulman.variants.shelf import GUIDES

TASK = "nau-slider-crank"
ROSTER = "student;group;variant\nІ. Петренко;АТ-301;3\nО. Коваль;АТ-301;7\n"


def reach(page: Any, selector: str) -> Any:
    """Go to an element with TAB, as long as it takes."""
    for _ in range(200):
        page.keyboard.press("Tab")
        if page.evaluate("selector => document.activeElement.matches(selector)", selector):
            return page.locator(selector)
    raise AssertionError(f"TAB does not lead to {selector}")


def fault_free(page: Any) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    found = axe.Axe().run(page).response["violations"]
    assert [(fault["id"], [node["html"] for node in fault["nodes"]][:3]) for fault in found] == []
    assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0


def followed(page: Any, selector: str) -> None:
    """Follow a link, or send a form, with the keyboard."""
    reach(page, selector)
    with page.expect_navigation():
        page.keyboard.press("Enter")


def choose(page: Any, selector: str, value: str) -> None:
    """Choose in a list with the arrows."""
    found = reach(page, selector)
    for _ in range(60):
        page.keyboard.press("ArrowDown")
        if found.input_value() == value:
            return
    raise AssertionError(f"{selector} has no {value}")


def saved(page: Any, selector: str) -> bytes:
    reach(page, selector)
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    return Path(download.value.path()).read_bytes()


def test_guides_are_read_without_a_terminal(page: Any) -> None:
    followed(page, "header a[href*='/guide']")
    for topic in GUIDES:
        followed(page, f"main a[href$='/guide/{topic}'], main a[href*='/guide/{topic}?']")
        fault_free(page)
        followed(page, "main a[href*='/guide?'], main a[href$='/guide']")


def test_a_student_chooses_sees_saves_and_is_checked(page: Any, tmp_path: Path) -> None:
    fault_free(page)
    followed(page, f"a[href*='/task/{TASK}']")
    reach(page, "#v")
    page.keyboard.type("3")
    followed(page, "button.main")
    assert page.locator("#v").input_value() == "3"
    assert page.evaluate("document.querySelector('.paper img').naturalWidth") > 0
    fault_free(page)

    kulman.sheet(TASK, "3").save(tmp_path / "sheet.pdf")
    assert saved(page, "a[href*='/sheet.pdf']") == (tmp_path / "sheet.pdf").read_bytes()

    followed(page, "a.button[href*='/check']")
    fault_free(page)
    reach(page, "input[aria-label^='V_B:'][data-head^='знач']")
    page.keyboard.type("5,62")
    followed(page, "button.main")
    assert page.locator("tr.right").count() == 1
    fault_free(page)


def test_data_of_ones_own_are_taken(page: Any) -> None:
    followed(page, f"a[href*='/task/{TASK}']")
    reach(page, "summary")
    page.keyboard.press("Enter")
    reach(page, "[name='g.l_OA']")
    page.keyboard.press("Control+A")
    page.keyboard.type("5,5 см")
    followed(page, "button.main")
    assert page.locator(".own input").input_value() == "5,5 см"
    assert page.locator(".problem").count() == 0


def test_a_teacher_draws_a_class_and_marks_it(page: Any, tmp_path: Path) -> None:
    (tmp_path / "roster.csv").write_text(ROSTER, encoding="utf-8")
    (tmp_path / "form.csv").write_text("student;V_A, м/с;V_B, м/с\nІ. Петренко;5,86;5,6\n", encoding="utf-8")
    followed(page, "a[href$='/class']")
    fault_free(page)
    choose(page, "#tasks", TASK)
    reach(page, "#roster").set_input_files(tmp_path / "roster.csv")  # what a dialogue of the system does
    for kind in ("pdf", "note", "svg"):
        reach(page, f"[name='kinds'][value='{kind}']")
        page.keyboard.press("Space")
    reach(page, "button.main")
    page.keyboard.press("Enter")
    page.locator("a[href$='.zip']").wait_for(timeout=60_000)
    fault_free(page)
    kulman.batch(TASK, tmp_path / "roster.csv", tmp_path / "out", kinds=("svg",))
    with zipfile.ZipFile(io.BytesIO(saved(page, "a[href$='.zip']"))) as archive:
        made = {name: archive.read(name) for name in archive.namelist()}
    own = (path for path in (tmp_path / "out").iterdir() if not path.name.startswith("."))
    assert made == {path.name: path.read_bytes() for path in own}

    followed(page, "a[href$='/marks']")
    fault_free(page)
    choose(page, "#tasks", TASK)
    reach(page, "#forms").set_input_files(tmp_path / "form.csv")
    reach(page, "#roster").set_input_files(tmp_path / "roster.csv")
    reach(page, "button.main")
    page.keyboard.press("Enter")
    page.locator("a[href$='.zip']").wait_for(timeout=60_000)
    assert "І. Петренко" in page.locator(".lines").inner_text()
    followed(page, "a[href$='/class.html']")
    fault_free(page)


def test_the_page_about_a_class_fits_the_window_and_the_paper(browser: Any) -> None:
    """What a teacher is to check was cut off at the edge of the paper, behind long names of files; its table began on
    the second page.
    """
    asked = kulman.check(TASK, "3", lang="uk")
    who = [Who(f"Нечипоренко-Задунайський Святослав Володимирович {n}", "АТ-301") for n in range(40)]
    odd = f"works/{'_'.join(['Нечипоренко-Задунайський'] * 4)}.xlsx: бланк порожній"
    lines = [Result("a.csv", one, "3", mark=None if n else 50.0, notes=(odd,)) for n, one in enumerate(who)]
    page = browser.new_page(viewport={"width": 1000, "height": 800})
    page.set_content(ClassPage(asked.request, asked.rubric, lines, lambda one: pytest.fail(one.source)).html())

    assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
    pages = pypdfium2.PdfDocument(page.pdf(prefer_css_page_size=True))
    page.close()
    texts = [one.get_textpage().get_text_bounded() for one in pages]
    assert "Володимирович 0" in texts[0]
    assert "Оцінки групи" not in texts[1]
    assert all(abs(one.get_width() - 297.0 / 25.4 * 72.0) < 1.0 for one in pages)  # A4 on its side


@pytest.mark.parametrize("path", ["?lang=en", f"task/{TASK}?v=3", f"task/{TASK}/check?v=3", "own?kind=cam", "class"])
def test_pages_can_be_read_by_all(path: str, browser: Any, address: str) -> None:
    page = browser.new_page()
    page.goto(f"{address}{path}")
    for width, scheme in product((1280, 390), ("light", "dark")):
        page.set_viewport_size({"width": width, "height": 844})
        page.emulate_media(color_scheme=scheme)
        fault_free(page)
    page.close()
