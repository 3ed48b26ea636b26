"""Handouts: no answer on the blank, nothing moved against the key; prints read back from PDF fit on one another."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from pdfminer.high_level import extract_pages
from pdfminer.layout import LAParams, LTChar, LTCurve

from kulman import handout, note, solve
from kulman.drawing.cams.diagrams_view import DIAGRAMS_FIGURE
from kulman.drawing.cams.profile_view import FIGURES as PROFILE_FIGURES
from kulman.drawing.cams.sizes_view import FIGURES as SIZE_FIGURES
from kulman.drawing.compose import Drawn
from kulman.drawing.figure import _family
from kulman.drawing.formats import FORMATS
from kulman.drawing.handouts import _begun_stages, _done
from kulman.drawing.linkages.asking import given_name
from kulman.drawing.notes.blocks import Figure, Steps
from kulman.drawing.page import TASK as ASKING
from kulman.drawing.page import extent
from kulman.drawing.pdf import MARGIN, _tiles, write_tiles
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.shapes import Group, Line, Shape, Text, Vector
from kulman.drawing.words import Words
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.tests.support.shapes import leaves, line_of
from kulman.variants.case import Case, Request
from kulman.variants.kinds.linkage import placed
from kulman.variants.making.starter import start
from kulman.variants.reader import load_task
from kulman.variants.sheets import PAPER, Sheet, drawing_for_print
from kulman.variants.shelf import bundled

TASK = "nau-slider-crank"
GIVEN = ("kinematic", "givens", "task", "data", "choices", "scales")  # what a blank may show in full
ASKED = ("table.quantity", "table.symbol", "table.unit", "table.check", "table.condition", "gear.point")
ASKED += ("table.cam_row",)  # columns in which a table asks
EVERY_KIND = (TASK, "madi-gear", "madi-cam", "karpenko-hoist")
PLANS = ("velocity", "acceleration", "forces_", "lever")
LINKAGES = ("madi-four-bar", "scheme-09-shaper", "scheme-18-hydraulic-drive", "scheme-20-press-automaton")
TASKS = [name if name == TASK else pytest.param(name, marks=pytest.mark.soak) for name in bundled()]


def vectors(sheet: Sheet) -> list[str]:
    return [shape.quantity for page in sheet.pages for shape in leaves(page.shapes) if isinstance(shape, Vector)]


def views_of(sheet: Sheet) -> Iterator[Group]:
    """Go through the views as they stand on the pages."""
    for page in sheet.pages:
        yield from (shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view")


def all_groups(group: Group) -> Iterator[Group]:
    """Go through the groups in a group."""
    for part in group.shapes:
        if isinstance(part, Group):
            yield part
            yield from all_groups(part)


def plans(sheet: Sheet) -> dict[str, set[Shape]]:
    """Return the shapes of each plan that is told step by step, but for the equations beside it."""
    return {view.name: set(view.shapes) for view in views_of(sheet) if view.name.startswith(PLANS)}


@pytest.mark.parametrize("task", TASKS)
def test_a_handout_grows_step_by_step_into_the_key(task: str) -> None:
    def drawn(**how: Any) -> list[set[object]]:
        return [{line_of(shape) for shape in leaves(page.shapes)} for page in handout(task, **how).pages]

    key = drawn(key=True)
    before: list[set[object]] = [set() for _ in key]
    for steps in (0, 1, 2, 5, 1000):
        now = drawn(steps=steps)
        assert len(now) == len(key)
        for own, earlier, whole in zip(now, before, key, strict=True):
            assert earlier <= own <= whole  # the same places, to the last bit
        before = now


@pytest.mark.soak
@pytest.mark.parametrize("task", [pytest.param("madi-cam", marks=pytest.mark.soak), "madi-gear"])
def test_lines_break_off_only_at_letters_that_a_begun_handout_shows(task: str) -> None:
    for view in (view for steps in (1, 2, 3) for view in views_of(handout(task, steps=steps))):
        parts = [*leaves(view.shapes)]
        boxes = [shapely.box(*extent((text,))).buffer(1.0) for text in parts if isinstance(text, Text)]
        lines = [line for line in parts if isinstance(line, Line) and line.role in ("position", "ray", "tangent")]
        for a, b in pairwise(lines):
            if a.name and line_of(a) == line_of(b):  # two pieces: a letter stands between
                gap = shapely.LineString([(p.real, p.imag) for p in (a.b, b.a)])
                assert any(box.intersects(gap) for box in boxes), (view.name, a.name)


@pytest.mark.parametrize("task", TASKS)
def test_a_blank_has_no_answers(task: str) -> None:
    blank = handout(task)

    assert vectors(blank) == []
    for view in views_of(blank):
        if view.name not in GIVEN:
            numbers = [t.markup for t in leaves(view.shapes) if isinstance(t, Text) and t.role in ("cell", "line")]
            assert not [text for text in numbers if re.search(r"\d[.,]\d", text)]
    said = {text.markup for page in blank.pages for text in leaves(page.shapes) if isinstance(text, Text)}
    drawn = (view for view in blank.views if not (view.rows or view.lines or view.name.startswith("load_")))
    notes = {line for view in drawn for line in view.notes}
    assert said & {line for view in blank.views for line in view.heading}
    assert not [line for line in said & notes if re.search(r"= ?\d", line)]


LETTERED = [
    ("scheme-14-jaw-crusher", "0", 0),  # where the first normal acceleration is shorter than a dot
    ("scheme-09-shaper", "3", 3),  # where an inset shows the pole of forces
    *((task, None, steps) for task in bundled() for steps in (0, 3)),
]


@pytest.mark.parametrize(("task", "variant", "steps"), some(LETTERED, 0, 1))
def test_a_begun_handout_letters_each_pole_that_the_key_letters(task: str, variant: str | None, steps: int) -> None:
    case, drawn = Request(load_task(task), variant).case(), 0
    words, begun = case.words(), handout(task, variant, steps=steps)
    whole = {view.name: view.shapes for view in begun.views}

    def labels(shapes: Iterable[Shape]) -> list[str]:
        return [shape.markup for shape in shapes if isinstance(shape, Text) and shape.role == "label"]

    for view in views_of(begun):
        for pole in (g.name for g in all_groups(view) if g.role == "point" and g.name.endswith((".p", ".0"))):
            letter = re.compile(rf"{re.escape(words.mark(pole))}(,|$)")
            if any(map(letter.match, labels(whole[view.name]))):  # else its inset has it
                assert any(map(letter.match, labels(view.shapes))), (view.name, pole)
                drawn += 1
    assert drawn or case.kind.table != "mechanism"


@pytest.mark.parametrize(
    ("task", "lang"), [(TASK, "uk"), ("scheme-09-shaper", "ru"), ("scheme-18-hydraulic-drive", "en")]
)
def test_a_blank_of_velocities_states_the_task_on_two_pages(task: str, lang: str) -> None:
    blank = handout(task, only="velocity", lang=lang)

    views = {view.name: view for view in blank.views}
    ruled = (line for line in leaves(views["results_velocity"].shapes) if isinstance(line, Line))
    levels = sorted({round(line.a.imag, 6) for line in ruled if line.a.imag == line.b.imag})
    assert len(blank.pages) == 2
    assert {"kinematic", "givens", "task"} <= {view.name for view in views_of(blank) if view.shapes}
    assert all(called for _, called, *_ in views["givens"].rows)
    assert not any(symbol and symbol.startswith("m_") for symbol, *_ in views["givens"].rows)  # no mass moves faster
    assert "V_" in " ".join(map(" ".join, views["task"].lines))
    assert min(b - a for a, b in pairwise(levels)) >= 8.0


def test_a_blank_of_a_mechanism_of_one_s_own_has_all_that_it_takes(tmp_path: Path) -> None:
    file = start(tmp_path / "own.toml", "en")
    file.write_text(file.read_text("utf-8").replace('speed = "n_1"', 'speed = "120 rpm"'), encoding="utf-8")

    blank = handout(file, "1", only="velocity", lang="en")
    forces = handout(file, "1", only="forces", lang="en")

    rows, loaded = (next(view.rows for view in sheet.views if view.name == "givens") for sheet in (blank, forces))
    said = {called: (value, of) for _, called, value, of in rows}
    assert said["Length CB (link 3)"] == ("220", "mm")
    assert said["Coordinate x of pivot C"] == ("280", "mm")
    assert said["Angular velocity of link 1"] == ("12.5663706", "rad/s")
    assert said["Rotation of link 1"] == ("counter-clockwise", None)
    assert not any("ass of" in called or "oment" in called for called in said if called)
    assert ("m_{3}", "Mass of link 3", "2.4", "kg") in loaded
    assert ("", "Sense of the moment M_{3}", "clockwise", None) in loaded


def test_a_paper_speaks_of_what_it_asks_for() -> None:
    velocities, whole = handout(TASK, only="velocity", lang="en"), handout(TASK, lang="en")

    def said(sheet: Sheet) -> str:
        return " ".join(" ".join(line) for view in sheet.views if view.name == "task" for line in view.lines)

    assert "Of ω write the sense" in said(velocities)
    assert "Of ω, ε and M write the sense" in said(whole)
    assert velocities.pages[0].title == "Slider-crank"
    assert "force" in whole.pages[0].title
    assert not any("μ_{l}" in line for view in velocities.views for line in view.heading)


@pytest.mark.parametrize("task", some([TASK, "scheme-09-shaper", "karpenko-hoist", "scheme-14-jaw-crusher"], 0, 1, 2))
def test_blank_form_and_solution_have_the_same_scale_factors(task: str) -> None:
    asked = {"only": None if "hoist" in task else "velocity", "lang": "en"}
    blank = handout(task, **asked)

    solution = solve(task, **asked, format=PAPER)

    plans = [plan for plan in solution.solved.scale_of_plan if plan in blank.scales]
    assert len(plans) > 1
    for scale in (blank.scales[plan] for plan in plans):
        assert solution.scales[scale.symbol] == scale
    if any("l_{CA}" in row for view in blank.views for row in view.rows):  # taken off the scheme
        scheme = next(view for view in blank.views if view.name == "kinematic")
        assert Words.of("en").scale(blank.scales["position"]) in scheme.heading


CRUSHER = ("scheme-14-jaw-crusher", "4", {"l_OA": "38 mm", "l_BD": 330, "phi": 105}, 3)
SHAPER, PRESS = ("scheme-09-shaper", "1", {}, 2), ("scheme-13-toggle-press", "4", {}, 3)
LEAF = [(name, None, {}, 2) for name in (TASK, "scheme-03-crank-rocker", "scheme-17-sewing-machine")]
SMALL = ("scheme-05-articulated-rod", "4", {}, 2), ("scheme-15-lever-shears", "8", {}, 2)  # with a smaller scheme
# equations that begin on the first page, that are yet narrower, and plans two steps coarser than those that fit first
TIGHT = [
    ("scheme-20-press-automaton", "1", {}, 2),
    ("scheme-10-shaper-two-blocks", "2", {}, 2),
    ("scheme-08-planer", "9", {}, 2),
]


@pytest.mark.parametrize(
    ("task", "variant", "settings", "most"), some([CRUSHER, SHAPER, PRESS, *LEAF, *SMALL, *TIGHT], 0, 1, 5, 6, 8)
)
def test_a_plan_is_not_much_smaller_beside_another_than_alone_on_a_blank(
    task: str, variant: str | None, settings: dict[str, Any], most: int
) -> None:
    both = handout(task, variant, set=settings, only="position,velocity")

    assert len(both.pages) <= most
    for plan in ("position", "velocity"):
        alone = handout(task, variant, set=settings, only=plan)
        assert both.scales[plan].mu <= 2.501 * alone.scales[plan].mu


@pytest.mark.parametrize("task", ["scheme-08-planer", "scheme-12-shaking-conveyor"])
def test_equations_of_a_leaf_are_narrower_rather_than_a_crank_too_short_to_be_drawn(task: str) -> None:
    both = handout(task, "0", only="position,velocity")

    assert len(both.pages) == 2
    assert solve(task, "0")["l_OA"].value / both.scales["position"].mu >= 8.0  # mm


def test_what_a_task_fixes_stays_on_a_blank() -> None:
    blank = handout("madi-four-bar", only="velocity,acceleration")

    assert [error.key for error in blank.warnings] == []
    assert {scale.mu for plan, scale in blank.scales.items() if plan in ("velocity", "acceleration")} == {0.189, 21.318}
    (task,) = (leaves(view.shapes) for view in views_of(blank) if view.name == "task")
    fixed = ", ".join(view.heading[-1] for view in blank.views if view.name in ("velocity", "acceleration"))
    assert f"Масштабні коефіцієнти: {fixed}." in {text.markup for text in task if isinstance(text, Text)}


def test_a_load_diagram_is_given() -> None:
    blank = handout("scheme-01-compressor", "1", only="forces", lang="en")

    figure = next(view for view in views_of(blank) if view.name == "load_p_gas")
    texts = {text.markup for text in leaves(figure.shapes) if isinstance(text, Text)}
    assert {"0.4H", "1200", "3000"} <= texts
    assert not [text for text in texts if text.startswith("F_{3} =")]


@pytest.mark.soak
def test_lines_of_a_task_break_within_no_index() -> None:
    blank = handout("bertyaev-six-bar", only="compound")

    chunks = [chunk for view in blank.views if view.name == "task" for line in view.lines for chunk in line]
    assert any("{" in chunk for chunk in chunks)
    assert all(chunk.count("{") == chunk.count("}") for chunk in chunks)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_given_of_a_bundled_linkage_has_a_name(lang: str) -> None:
    tasks = [*map(load_task, bundled("mechanism"))]

    named = {
        (task.id, name): given_name(task.mechanism, Words.of(lang, task.notation), name)
        for task in tasks
        for name, given in task.givens.items()
        if not given.choices
    }

    assert len(named) > 300
    assert [key for key, text in named.items() if not text or re.search(r"(?<![_^]){", text)] == []


@pytest.mark.parametrize("task", some(LINKAGES, 0, 2))
def test_a_blank_says_what_each_plan_has_to_find(task: str) -> None:
    (asked,) = (view for view in views_of(handout(task, lang="en")) if view.name == ASKING)
    said = " ".join(text.markup for text in leaves(asked.shapes) if isinstance(text, Text))

    assert "; find " in said
    assert "find ." not in said
    factors = re.findall(r"(μ_\{\w+\}(?: \([^)]+\))?) = ", said)
    assert len(set(factors)) == len(factors)


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=[pytest.mark.soak] * (task not in EVERY_KIND[:1])) for task in EVERY_KIND]
)
def test_a_table_of_a_blank_asks_and_a_text_has_only_its_heading(task: str) -> None:
    case = Request(load_task(task)).case()
    texts = case.words().texts
    asked = {texts[key] for key in ASKED if key in texts}
    blank = handout(task, lang=case.language)
    key = {view.name: view for view in blank.views}

    for shown in views_of(blank):
        if (key[shown.name].of or shown.name) in GIVEN:
            continue
        view, texts = key[shown.name], [t for t in leaves(shown.shapes) if isinstance(t, Text) and t.role != "heading"]
        if view.lines:
            assert texts == [], view.name
        elif view.rows:
            head = dict(enumerate(view.rows[0]))
            columns = {at for at, text in head.items() if text in asked}
            assert columns, view.name
            known = {row[at] for row in view.rows for at in columns} | {*head.values()}
            assert {text.markup for text in texts} <= known, view.name


def test_no_distance_can_be_measured_on_a_blank_of_gears() -> None:
    for view in views_of(handout("madi-gear")):
        points = [part.name for part in all_groups(view) if part.role in ("point", "pivot")]
        assert len(points) <= 1, (view.name, points)


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=() if task == "madi-four-bar" else pytest.mark.soak) for task in LINKAGES]
)
def test_all_steps_of_plans_draw_all_that_they_show(task: str) -> None:
    whole, done = (plans(handout(task, format="A1", **how)) for how in ({"key": True}, {"steps": 1000}))

    assert {"velocity", "lever"} <= set(whole)
    assert done == whole


def shown_after(case: Case, drawn: Drawn, steps: int) -> dict[str, set[str]]:
    """Return by view the stages that a handout shows; those of a plan have the names of its steps."""
    shown = case.kind.begun(case, drawn.scales, case.words("en"), steps)
    staged = {view.name: view for view in drawn.views if view.stages}
    counts = _done(staged, steps)
    return {
        **{name: set(_begun_stages(view, counts[name]).stages) for name, view in staged.items()},
        **{name: set(one.stages) for name, one in shown.items() if name in {view.name for view in drawn.views}},
    }


def finders(case: Case, drawn: Drawn) -> dict[str, tuple[str, str]]:
    """Return the view and the stage in which a step of the program is drawn, by its name, where one is."""
    found: dict[str, tuple[str, str]] = {}
    if case.task.kind == "mechanism":
        every = case.kind.begun(case, drawn.scales, case.words("en"), 1000)
        own = {view: one for view, one in every.items() if view in {view.name for view in drawn.views}}
        steps = {step.name for step in placed(case).program}
        return {name: (view, name) for view, one in own.items() for name in steps & one.stages}
    for view in drawn.views:
        for stage in CAM_STAGES.get(view.name, ())[1:]:  # the first is there before any step
            if stage.name in view.stages and stage.marks:
                for step in case.solved.program:
                    if _family(step.name) == stage.marks and stage.verb in ("", step.verb):
                        found.setdefault(step.name, (view.name, stage.name))
    return found


CAM_FIGURES = (DIAGRAMS_FIGURE, *SIZE_FIGURES.values(), *PROFILE_FIGURES.values())
CAM_STAGES = {figure.name: figure.stages for figure in CAM_FIGURES}


OTHERS = [name for name in bundled() if name not in (TASK, "madi-gear", "karpenko-hoist")]


@pytest.mark.parametrize("task", [TASK, *(pytest.param(name, marks=pytest.mark.soak) for name in OTHERS)])
def test_nothing_is_drawn_from_what_an_earlier_plan_has_yet_to_find(task: str) -> None:
    case = Request(load_task(task), "0" if task == TASK else None).case()
    drawn, program = drawing_for_print(case), {step.name: step for step in case.solved.program}
    if case.task.kind == "mechanism":
        program = {step.name: step for step in placed(case).program}
    found = finders(case, drawn)
    behind: dict[str, set[str]] = {}  # what a step is made of, however far back
    for name, step in program.items():
        behind[name] = {*step.operands}.union(*(behind.get(operand, set()) for operand in step.operands))
    assert len({view for view, _ in found.values()}) > 2

    grown = 0
    for steps in range(25):
        shown = shown_after(case, drawn, steps)
        for name, (view, stage) in found.items():
            if stage in shown[view]:
                grown += 1
                late = {on for on in behind[name] & {*found} if found[on][1] not in shown[found[on][0]]}
                assert not late, (steps, view, name, late)
    assert grown > 100


NEEDS = {  # of gears and hoists, whose figures show what formulas give: what must be found before a stage
    ("madi-gear", "action", "active_line"): ("meshing", "active_line"),
    ("madi-gear", "rolling", "line_of_action"): ("meshing", "line_of_action"),
    ("karpenko-hoist", "circle", "start"): ("lift_off", "crossing"),
    ("karpenko-hoist", "forces", "resting"): ("lift_off", "crossing"),
    ("karpenko-hoist", "forces", "hanging"): ("circle", "circle"),
    ("karpenko-hoist", "beams", "bent"): ("circle", "circle"),
}


@pytest.mark.parametrize("task", ["madi-gear", "karpenko-hoist"])
def test_figures_of_formulas_wait_for_what_others_find(task: str) -> None:
    case = Request(load_task(task), None).case()
    drawn = drawing_for_print(case)
    for steps in range(12):
        shown = shown_after(case, drawn, steps)
        for (_, view, stage), (other, need) in ((key, at) for key, at in NEEDS.items() if key[0] == task):
            assert stage not in shown[view] or need in shown[other], (steps, view, stage)
    assert all(stage in shown[view] for own, view, stage in NEEDS if own == task)


def test_steps_are_those_that_the_note_numbers() -> None:
    blocks = [block for block in note(TASK, "3", lang="en").document.blocks if isinstance(block, (Steps, Figure))]
    texts = next(
        steps.texts
        for steps, figure in pairwise(blocks)
        if isinstance(steps, Steps) and isinstance(figure, Figure) and figure.view.name == "velocity"
    )
    number = next(number for number, text in enumerate(texts, 1) if "lay off" in text)
    before, begun = (handout(TASK, "3", steps=k, only="velocity") for k in (number - 1, number))

    assert number == 2  # after the pole, which a blank has, too
    assert (vectors(before), vectors(begun)) == ([], ["V_A"])
    assert not before.warnings


@pytest.mark.parametrize(("format", "told"), [("A4", ["l_OA"]), ("A2", [])])
def test_a_link_too_short_to_draw_from_is_told_of_a_blank(format: str, told: list[str]) -> None:
    blank = handout("scheme-14-jaw-crusher", "4", only="position,velocity", format=format)

    short = [error for error in blank.warnings if error.key == "handout-tiny"]
    assert [error.data["quantity"] for error in short] == told
    assert all("3,5 мм" in error.text("uk") and "3.5 mm" in error.text("en") for error in short)


@pytest.mark.parametrize(("task", "only"), [(TASK, "velocity"), ("madi-gear", "geometry")])
def test_steps_warn_where_nothing_drawn_has_any(task: str, only: str) -> None:
    begun, blank = (handout(task, only=only, steps=steps) for steps in (3, 0))

    idle = [warning for warning in begun.warnings if warning.key == "handout-stepless"]
    assert bool(idle) == (begun.pages == blank.pages) == (only == "geometry")
    assert all("--steps 3" in warning.text(language) for warning in idle for language in LANGUAGES)
    assert idle == [warning for warning in begun.warnings if warning not in blank.warnings]


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
def test_what_cannot_be_done_is_said_in_a_line(arguments: list[str], said: str, tmp_path: Path, run: Run) -> None:
    status, out, err = run("handout", TASK, *arguments, "-o", tmp_path / "h.pdf")

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert list(tmp_path.iterdir()) == []


COINCIDES = 0.01  # mm
AT_LETTER = 1.5  # mm from the box of a letter, in which lines may break off
FIGURES = 3  # of a sheet that are laid over it: each is drawn with its whole sheet
FEW = {TASK: "velocity", "karpenko-hoist": "scheme"}
WHOLE = (TASK, "madi-cam", "madi-gear", "karpenko-hoist", "bertyaev-six-bar", "scheme-20-press-automaton")
MM = 25.4 / 72
Stroke = NDArray[np.complex128]  # the points of a line or a curve, mm from the lower left corner


def printed_tasks(*few: str) -> list[Any]:
    """Return tasks of some kinds with one plan each; for the soak whole sheets of every kind."""
    return [*((task, FEW[task]) for task in few), *(pytest.param(task, None, marks=pytest.mark.soak) for task in WHOLE)]


@dataclass(frozen=True, slots=True)
class Print:
    """A page as a printer gets it: its size in mm, all that is stroked or filled on it, boxes of letters."""

    width: float
    height: float
    strokes: tuple[Stroke, ...]
    letters: tuple[shapely.Polygon, ...]

    def straight(self, along: complex) -> list[Stroke]:
        """Return the straight lines in a direction, 1 or 1j, from their lower or left end."""
        lines = [stroke for stroke in self.strokes if len(stroke) == 2]
        lines = [line if ((line[1] - line[0]) / along).real > 0.0 else line[::-1] for line in lines]
        spans = ((line, (line[1] - line[0]) / along) for line in lines)
        return [line for line, span in spans if span.real > 0.0 and abs(span.imag) < 1e-3]


def prints(pdf: bytes) -> list[Print]:
    """Return the pages of a PDF."""

    def parts(element: Any) -> Iterator[LTCurve | LTChar]:
        if isinstance(element, LTCurve | LTChar):
            yield element
        for child in getattr(element, "_objs", ()):
            yield from parts(child)

    found = []
    for page in extract_pages(BytesIO(pdf), laparams=LAParams(boxes_flow=None)):
        drawn = [*parts(page)]
        pens = (part for part in drawn if isinstance(part, LTCurve))
        strokes = (np.array([complex(*point) * MM for point in part.pts]) for part in pens)
        boxes = tuple(shapely.box(*(MM * side for side in part.bbox)) for part in drawn if isinstance(part, LTChar))
        found.append(
            Print(page.width * MM, page.height * MM, tuple(stroke for stroke in strokes if len(stroke)), boxes)
        )
    return found


def misses(these: Iterable[Stroke], those: Iterable[Stroke]) -> list[tuple[float, Stroke]]:
    """Return each of `these` with the mm by which it misses the nearest of `those`; inf without any."""
    by_count: dict[int, list[Stroke]] = {}
    for stroke in those:
        by_count.setdefault(len(stroke), []).append(stroke)
    tables = {count: np.array(strokes) for count, strokes in by_count.items()}
    return [
        (float(abs(tables[len(stroke)] - stroke).max(axis=1).min()) if len(stroke) in tables else np.inf, stroke)
        for stroke in these
    ]


def farthest(these: Iterable[Stroke], those: Iterable[Stroke]) -> float:
    """Return by how many mm the one of `these` that fits worst misses the nearest of `those`."""
    return max((by for by, _ in misses(these, those)), default=0.0)


def broken_at_letters(line: Stroke, whole: Print) -> bool:
    """Whether a straight line is on a print but for gaps, in each of which one of its letters stands."""
    if len(line) != 2:
        return False
    pieces = [shapely.LineString([(p.real, p.imag) for p in stroke]) for stroke in whole.strokes if len(stroke) == 2]
    drawn = shapely.union_all(pieces).buffer(COINCIDES)
    gaps = shapely.get_parts(shapely.LineString([(p.real, p.imag) for p in line]).difference(drawn))
    at = shapely.union_all(whole.letters).buffer(AT_LETTER)
    return all(gap.within(at) for gap in gaps)


@lru_cache(maxsize=16)
def printed(task: str, only: str | None, **how: Any) -> tuple[Sheet, tuple[Print, ...]]:
    drawn, stream = handout(task, only=only, **how), BytesIO()
    write_pdf(drawn.pages, stream)
    return drawn, tuple(prints(stream.getvalue()))


def ruler(page: Print, along: complex) -> tuple[Stroke, list[float]]:
    """Return the ruler of a print, a line of 100 mm in the margin, and where on it the marks stand, mm."""
    base = next(
        line
        for line in page.straight(along)
        if abs(abs(line[1] - line[0]) - 100.0) < 0.05 and (line[0].imag if along == 1 else line[0].real) < 14.0
    )
    ends = [(end - base[0]) / along for line in page.straight(1j if along == 1 else 1) for end in line]
    places = sorted({round(float(end.real), 3) for end in ends if abs(end.imag) < 1e-3})
    return base, [place for place in places if -1.0 < place < 101.0]


@pytest.mark.parametrize("lang", some(LANGUAGES, 2))
def test_rulers_say_their_length_and_pivots_come_with_their_letters(lang: str) -> None:
    blank = handout(TASK, lang=lang)

    for page in blank.pages:
        prints = [text for text in leaves(page.shapes) if isinstance(text, Text) and text.name == "print"]
        said = [text.markup for text in prints]
        mm = "mm" if lang == "en" else "мм"
        assert (said.count("0"), said.count("100"), sum(text.startswith(f"100 {mm};") for text in said)) == (2, 1, 1)
        assert {text.height for text in prints} == {2.5}  # the least of the row
    driver = next(view for view in views_of(blank) if view.name == "driver")
    assert [group.name for group in all_groups(driver) if group.role == "pivot"] == ["O"]
    assert "O" in [text.markup for text in leaves(driver.shapes) if isinstance(text, Text)]


@pytest.mark.parametrize(("task", "only"), printed_tasks(TASK))
def test_a_print_has_the_size_of_its_paper_and_rulers_of_100_mm(task: str, only: str | None) -> None:
    drawn, pages = printed(task, only)

    paper = FORMATS[drawn.format]
    assert len(pages) == len(drawn.pages)
    for page in pages:
        assert (page.width, page.height) == pytest.approx((paper.width, paper.height), abs=COINCIDES)
        for along in (1, 1j):
            line, marks = ruler(page, along)
            assert abs(line[1] - line[0]) == pytest.approx(100.0, abs=COINCIDES)
            assert marks == pytest.approx([5.0 * k for k in range(21)], abs=COINCIDES)


@pytest.mark.parametrize(
    ("format", "norm"), [("A4", "gost"), ("A4", "iso"), pytest.param("A3", "gost", marks=pytest.mark.soak)]
)
def test_the_frame_keeps_the_margin_that_printers_need_and_the_rulers_stand_in_it(format: str, norm: str) -> None:
    for page in printed(TASK, "velocity", format=format, norm=norm)[1]:
        boxes = [(min(s.real), min(s.imag), max(s.real), max(s.imag)) for s in page.strokes if len(s) > 2]
        large = sorted((box for box in boxes if box[2] - box[0] > 0.8 * page.width), key=lambda box: box[0])
        edge, (x0, y0, x1, y1), *_ = large  # the paper's own edge, then the frame
        assert edge == pytest.approx((0.0, 0.0, page.width, page.height), abs=COINCIDES)
        assert min(x0, y0, page.width - x1, page.height - y1) >= 8.0 - COINCIDES
        assert max(ruler(page, 1)[0].imag) < y0
        assert max(ruler(page, 1j)[0].real) < x0


@pytest.mark.parametrize(("task", "only"), printed_tasks(TASK, "karpenko-hoist"))
def test_the_key_on_top_of_a_blank_coincides(task: str, only: str | None) -> None:
    _, blank = printed(task, only)
    _, key = printed(task, only, key=True)

    for page, whole in zip(blank, key, strict=True):
        assert (page.width, page.height) == (whole.width, whole.height)
        missed = [stroke for by, stroke in misses(page.strokes, whole.strokes) if by > COINCIDES]
        assert all(broken_at_letters(stroke, whole) for stroke in missed)  # where only the key has the letters
    assert sum(len(page.strokes) for page in key) > sum(len(page.strokes) for page in blank)


def corner(shapes: Iterable[Shape]) -> complex:
    x, y, *_ = extent(tuple(shapes))
    return complex(x, y)


@pytest.mark.parametrize(("task", "only"), printed_tasks(TASK))
def test_a_transparency_coincides_with_the_key(task: str, only: str | None) -> None:
    drawn, pages = printed(task, only, key=True)

    placed = {
        shape.name: (shape.shapes, page)
        for drawing, page in zip(drawn.pages, pages, strict=True)
        for shape in drawing.shapes
        if isinstance(shape, Group) and shape.role == "view"
    }
    for view in [view for view in drawn.views if not (view.rows or view.lines)][:FIGURES]:
        over, (alone,) = printed(task, only, over=view.name)
        shapes, page = placed[view.name]
        rulers = [shape for shape in over.pages[0].shapes if isinstance(shape, Group) and shape.role == "ruler"]
        shift = corner(shapes) - corner(shape for shape in over.pages[0].shapes if shape not in rulers)
        # rulers stand in the margins below and on the left
        own = [stroke for stroke in alone.strokes if stroke.imag.max() >= 14.0 and stroke.real.max() >= 20.0]
        assert len(own) > 4
        assert farthest((stroke + shift for stroke in own), page.strokes) <= COINCIDES
        assert ruler(alone, 1)[1] == pytest.approx([5.0 * k for k in range(21)], abs=COINCIDES)


@pytest.mark.parametrize("format", ["A3", pytest.param("A1", marks=pytest.mark.soak)])
def test_tiles_join_to_the_sheet(format: str) -> None:
    drawn, (page,) = printed(TASK, "velocity", format=format)
    stream = BytesIO()
    write_tiles(drawn.pages, stream)

    parts = prints(stream.getvalue())
    windows = [tile.window for tile in _tiles(drawn.pages[0])]
    assert len(parts) == len(windows) > 1
    for part, (x0, _, x1, y1) in zip(parts, windows, strict=True):
        assert (part.width, part.height) == pytest.approx((210.0, 297.0), abs=COINCIDES)
        assert x1 - x0 <= 210.0 - 2 * MARGIN
        top = complex(x0 - MARGIN, y1 - (part.height - MARGIN))  # tiles hang from their upper left corner
        assert farthest(page.strokes, [stroke + top for stroke in part.strokes]) <= COINCIDES
    left, below, right, above = zip(*windows, strict=True)
    assert (min(left), min(below)) == (0.0, 0.0)
    assert (max(right), max(above)) == pytest.approx((page.width, page.height))
