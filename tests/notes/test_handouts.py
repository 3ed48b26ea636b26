"""Handouts: no answer on the blank, nothing moved against the key, rulers that are as long as they say."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest

from kulman import cli, handout, note
from kulman.drawing.compose import Drawn
from kulman.drawing.formats import BLOCK, FORMATS, drawing_area, printable
from kulman.drawing.notes.blocks import Figure, Steps
from kulman.drawing.shapes import Arrow, Group, Line, Shape, Text, Vector
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.shapes import leaves
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet, drawing_for_print
from kulman.variants.shelf import bundled

GIVEN = ("givens", "data", "choices", "note", "structure", "scales")  # what a blank may show in full
FEW = ("nau-slider-crank",)


def tasks(few: tuple[str, ...] = FEW) -> list[object]:
    return [name if name in few else pytest.param(name, marks=pytest.mark.soak) for name in bundled()]


def drawn(sheet: Sheet) -> list[set[Shape]]:
    return [set(leaves(page.shapes)) for page in sheet.pages]


def vectors(sheet: Sheet) -> list[str]:
    return [shape.quantity for page in sheet.pages for shape in leaves(page.shapes) if isinstance(shape, Vector)]


def draw_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let handouts of one case share their drawing from here on."""
    kept: dict[object, Drawn] = {}

    def drawing(case: Case) -> Drawn:
        asked = (case.task.id, case.variant, case.format, case.norm, case.notation, case.language)
        if asked not in kept:
            kept[asked] = drawing_for_print(case)
        return kept[asked]

    monkeypatch.setattr("kulman.variants.sheets.drawing_for_print", drawing)


@pytest.mark.parametrize("task", tasks())
def test_a_handout_grows_step_by_step_into_the_key(task: str, monkeypatch: pytest.MonkeyPatch) -> None:
    key = drawn(handout(task, key=True))
    draw_once(monkeypatch)

    before: list[set[Shape]] = [set() for _ in key]
    for steps in (0, 1, 2, 5, 1000):
        now = drawn(handout(task, steps=steps))
        assert len(now) == len(key)
        for own, earlier, whole in zip(now, before, key, strict=True):
            assert earlier <= own <= whole  # the same places, to the last bit
        before = now


@pytest.mark.parametrize("task", tasks())
def test_a_blank_has_no_answers(task: str) -> None:
    blank = handout(task)

    assert vectors(blank) == []
    for page in blank.pages:
        for view in page.shapes:
            if isinstance(view, Group) and view.role == "view" and view.name not in GIVEN:
                numbers = [t.markup for t in leaves(view.shapes) if isinstance(t, Text) and t.role in ("cell", "line")]
                assert not [text for text in numbers if re.search(r"\d[.,]\d", text)]
    said = {text.markup for page in blank.pages for text in leaves(page.shapes) if isinstance(text, Text)}
    notes = {line for view in blank.views if not (view.rows or view.lines) for line in view.notes}
    assert said & {line for view in blank.views for line in view.heading}
    assert not [line for line in said & notes if re.search(r"= ?\d", line)]


PLANS = ("velocity", "acceleration", "forces_", "lever")
LINKAGES = ("madi-four-bar", "scheme-09-shaper", "scheme-18-hydraulic-drive", "scheme-20-press-automaton")


def plans(sheet: Sheet) -> dict[str, set[Shape]]:
    """The shapes of each plan that is told step by step, but for the equations beside it."""
    views = (view for page in sheet.pages for view in page.shapes if isinstance(view, Group) and view.role == "view")
    return {view.name: set(view.shapes) for view in views if view.name.startswith(PLANS)}


@pytest.mark.parametrize(
    "task",
    [name if name == "madi-four-bar" else pytest.param(name, marks=pytest.mark.soak) for name in LINKAGES],
)
def test_all_steps_of_plans_draw_all_that_they_show(task: str, monkeypatch: pytest.MonkeyPatch) -> None:
    draw_once(monkeypatch)

    whole, done = (plans(handout(task, format="A1", **how)) for how in ({"key": True}, {"steps": 1000}))

    assert {"velocity", "lever"} <= set(whole)
    assert done == whole


def test_a_lever_begins_with_its_plan_then_forces_hang_on_it() -> None:
    begun = [plans(handout("nau-slider-crank", "3", steps=steps, only="lever"))["lever"] for steps in (2, 4, 5)]

    lines, arrows = (
        [{shape.name for shape in shapes if isinstance(shape, kind)} for shapes in begun] for kind in (Line, Arrow)
    )
    assert lines[0] == {"V_A"}
    assert lines[1] == {"V_A", "V_BA", "V_B", "V_S2"}
    assert arrows == [set(), set(), {"F_i2"}]


def test_steps_are_those_that_the_note_numbers() -> None:
    written = note("nau-slider-crank", "3", lang="en")
    figures = [block for block in written.document.blocks if isinstance(block, (Steps, Figure))]
    steps = {
        figure.view.name: block.texts
        for block, figure in pairwise(figures)
        if isinstance(block, Steps) and isinstance(figure, Figure)
    }
    number = next(number for number, text in enumerate(steps["velocity"], 1) if "lay off" in text)
    before, begun = (handout("nau-slider-crank", "3", steps=k, only="velocity") for k in (number - 1, number))

    assert number == 2  # after the pole, which a blank has, too
    assert (vectors(before), vectors(begun)) == ([], ["V_A"])
    assert not before.warnings


@pytest.mark.parametrize("name", ["A4", "A3", "A1"])
@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_a_frame_keeps_clear_of_where_printers_do_not_reach(name: str, norm: str) -> None:
    sheet = printable(FORMATS[name])

    x0, y0, x1, y1 = drawing_area(sheet, norm)  # type: ignore[arg-type]

    assert min(x0, y0, sheet.width - x1, sheet.height - y1) >= 8.0
    assert x1 - x0 >= BLOCK[norm][0]  # room for the title block
    assert drawing_area(FORMATS[name]) == (20.0, 5.0, sheet.width - 5.0, sheet.height - 5.0)


def test_rulers_measure_100_mm_and_stand_in_the_margins() -> None:
    page = handout("nau-slider-crank", only="structure").pages[0]
    rulers = {shape.name: shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "ruler"}

    for ruler, along in (("across", 1.0), ("up", 1j)):
        lines = [line for line in rulers[ruler].shapes if isinstance(line, Line)]
        assert lines[0].b - lines[0].a == 100.0 * along
        assert len(lines) == 1 + 21
        places = sorted(((line.a - lines[0].a) / along).real for line in lines[1:])
        assert places == pytest.approx([5.0 * k for k in range(21)])
    frame = drawing_area(printable(FORMATS["A4"]))
    assert max(shape.b.imag for shape in leaves(rulers["across"].shapes) if isinstance(shape, Line)) < frame[1]
    assert max(max(s.a.real, s.b.real) for s in leaves(rulers["up"].shapes) if isinstance(s, Line)) < frame[0]


@pytest.mark.parametrize(("task", "only"), [("nau-slider-crank", "velocity"), ("madi-gear", "geometry")])
def test_steps_warn_where_nothing_drawn_has_any(task: str, only: str) -> None:
    begun, blank = (handout(task, only=only, steps=steps) for steps in (3, 0))

    idle = [warning for warning in begun.warnings if warning.key == "handout-stepless"]
    assert bool(idle) == (begun.pages == blank.pages) == (only == "geometry")
    assert all("--steps 3" in warning.text(language) for warning in idle for language in LANGUAGES)
    assert idle == [warning for warning in begun.warnings if warning not in blank.warnings]


def test_a_transparency_has_the_plan_at_its_size() -> None:
    over, key = (handout("nau-slider-crank", "3", **how) for how in ({"over": "velocity"}, {"key": True}))

    assert len(over.pages) == 1
    own = {s.quantity: s.tip - s.tail for s in leaves(over.pages[0].shapes) if isinstance(s, Vector)}
    assert own.keys() == {"V_A", "V_BA", "V_B", "V_S2"}
    for page in key.pages:
        for shape in leaves(page.shapes):
            if isinstance(shape, Vector) and shape.quantity in own and shape.unit == "m/s":
                assert own[shape.quantity] == pytest.approx(shape.tip - shape.tail, abs=1e-9)


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as left:
        cli.main(["handout", *arguments])
    out, err = capsys.readouterr()
    return int(left.value.code or 0), out, err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--steps", "-1"], "-1"),
        (["--steps", "two"], "two"),
        (["--over", "veloc"], "'velocity'"),
        (["--steps", "3", "--key"], "--steps without --key"),
        (["--hidden-key", "-o", "teacher.png"], "--hidden-key without -o teacher.png"),
        (["--format", "A9"], "A9"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, out, err = run(capsys, "nau-slider-crank", *arguments, "-o", str(tmp_path / "h.pdf"))

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert list(tmp_path.iterdir()) == []
