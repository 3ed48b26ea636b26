"""Drawings marked: as the same vectors in a form would be, what was not found told, the drawing returned."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kulman import check, handout, sheet
from kulman.drawing.linkages.reading import read
from kulman.drawing.shapes import Group, Line, Text
from kulman.drawing.writers import slug
from kulman.plans.board import POSITION
from kulman.plans.marking.answers import Verdict
from kulman.plans.marking.lines import Drawn, Letter
from kulman.plans.names import LEVER, role
from kulman.scales.errors import InputError
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.variants.drawings.files import read_drawing
from kulman.variants.marking.checks import Check
from kulman.variants.marking.keyed import Keyed
from kulman.variants.marking.marked import Desk, Marked
from kulman.variants.marking.overlay import _under

TASKS = ("nau-slider-crank", "madi-four-bar", "scheme-09-shaper")
APART = 400.0  # mm between plans
Lines = list[tuple[complex, complex]]
Texts = list[tuple[complex, str]]


def asked(task: str, **how: Any) -> tuple[Check, Keyed]:
    ready = check(task, how.pop("variant", None), lang="en", **how)
    variant = ready.request.variant or next(iter(ready.request.task.variants))
    return check(task, variant, lang="en", **how), Desk(ready).keyed(variant, {})


def plans_of(key: Keyed, program: Any, values: Mapping[str, Any]) -> tuple[Lines, Texts]:
    """The plans of a program as a student draws them, at other places than the sheet has, each with its scale."""
    lines, texts, reading = Lines(), Texts(), read(program)
    drawn = [plan for plan in program.plans if role(plan).kind != LEVER and plan in key.key.paper.mus]
    for number, plan in enumerate(drawn):
        mu, pole = key.key.paper.mus[plan], complex(APART * (number % 3), APART * (number // 3))
        for edge in reading.on(plan):
            ends = [pole + complex(values[end]) / mu for end in (edge.tail, edge.tip)]
            lines.append((ends[0], ends[1]))
        symbol = key.solution.solved.scale_of_plan[plan]
        si, display = key.asked.scales.get(symbol, ""), key.asked.display
        if si and plan != POSITION:
            kind = symbol.split("_")[1]
            shown = f"{display.of_scales.value(mu, si):.9g}".replace(".", ",")
            texts.append((pole + 5j, f"μ_{kind} = {shown} ({display.of_scales.unit(si)})/mm"))
    return lines, texts


def as_dxf(lines: Lines, texts: Texts) -> bytes:
    place = lambda code, z: f"{code}\n{z.real!r}\n{code + 10}\n{z.imag!r}\n"  # noqa: E731
    body = "".join(f"0\nLINE\n8\n0\n{place(10, a)}{place(11, b)}" for a, b in lines)
    body += "".join(f"0\nTEXT\n8\n0\n{place(10, at)}40\n3.5\n1\n{text}\n" for at, text in texts)
    return f"0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n".encode()


def as_svg(lines: Lines, texts: Texts) -> bytes:
    body = "".join(f'<path d="M{a.real} {-a.imag}L{b.real} {-b.imag}"/>' for a, b in lines)
    body += "".join(f'<text x="{at.real}" y="{-at.imag}" font-size="5">{text}</text>' for at, text in texts)
    box = 'width="2000mm" height="2000mm" viewBox="-500 -1500 2000 2000"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {box}><g stroke="#000">{body}</g></svg>'.encode()


def as_pdf(lines: Lines, texts: Texts) -> bytes:
    import matplotlib
    from reportlab.pdfbase.pdfmetrics import registerFont
    from reportlab.pdfbase.ttfonts import TTFont
    from reportlab.pdfgen.canvas import Canvas

    registerFont(TTFont("Plain", Path(matplotlib.get_data_path()) / "fonts/ttf/DejaVuSans.ttf"))
    point, by = 72.0 / 25.4, 500 + 500j
    canvas = Canvas("unused", (2000 * point, 2000 * point))
    canvas.setFont("Plain", 5 * point)
    for a, b in lines:
        canvas.line(*(side * point for z in (a + by, b + by) for side in (z.real, z.imag)))
    for at, text in texts:
        canvas.drawString((at + by).real * point, (at + by).imag * point, text)
    return canvas.getpdfdata()


WRITERS: dict[str, Callable[[Lines, Texts], bytes]] = {".dxf": as_dxf, ".svg": as_svg, ".pdf": as_pdf}


def handed_in(folder: Path, key: Keyed, program: Any, values: Mapping[str, Any], suffix: str = ".dxf") -> Path:
    file = folder / f"plans{suffix}"
    file.write_bytes(WRITERS[suffix](*plans_of(key, program, values)))
    return file


def marked(ready: Check, file: Path) -> Marked:
    return ready.mark(ready.read(str(file))[0]).marked


def verdicts(of: Marked) -> dict[str, Verdict]:
    return {line.name: line.verdict for line in of.lines if line.verdict is not Verdict.MISSING}


@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize("task", some(TASKS, 0))
def test_a_right_drawing_is_right(tmp_path: Path, task: str, suffix: str) -> None:
    ready, key = asked(task, preset="cad")

    found = marked(ready, handed_in(tmp_path, key, key.key.paper.program, key.key.values, suffix))

    assert len(verdicts(found)) >= 0.9 * len(found.lines) > 3
    assert set(verdicts(found).values()) == {Verdict.RIGHT}
    assert found.seen is not None
    assert {plan: found.seen.mus[plan] / key.key.paper.mus[plan] for plan in found.seen.written} == {
        plan: pytest.approx(1.0) for plan in found.seen.written
    }


@pytest.mark.parametrize(("task", "mistake"), some([
    ("nau-slider-crank", "M30"), ("nau-slider-crank", "M39"), ("madi-four-bar", "M38"), ("madi-four-bar", "M23"),
    ("scheme-09-shaper", "M49"),
], 0))  # fmt: skip
def test_a_drawing_with_a_mistake_is_marked_as_its_vectors_in_a_form_are(
    tmp_path: Path, task: str, mistake: str
) -> None:
    ready, key = asked(task)
    one = next(one for one in key.book.signatures if one.broken.mistake == mistake)
    file = handed_in(tmp_path, key, one.broken.program, one.values)

    found = marked(ready, file)

    typed = {line.name: line.answer for line in found.lines if line.answer is not None}
    rows = "".join(
        f"{name};{abs(one.values[name]) / key.key.paper.mus[key.key.questions[name].plan]:.6f};"
        f"{math.degrees(math.atan2(complex(one.values[name]).imag, complex(one.values[name]).real)):.4f}\n"
        for name in typed
    )
    form = tmp_path / "form.csv"
    form.write_text(f"quantity;mm;direction\n{rows}", encoding="utf-8")
    assert found.marking.first_wrong is not None
    assert found.marking.first_wrong == marked(ready, form).marking.first_wrong
    assert mistake in found.candidates[0].ids


def test_a_scale_factor_that_does_not_fit_the_plan_is_a_scale_error(tmp_path: Path) -> None:
    ready, key = asked("nau-slider-crank")
    lines, texts = plans_of(key, key.key.paper.program, key.key.values)
    wrong = [(at, text.replace("μ_V = 0", "μ_V = 1")) for at, text in texts]
    assert wrong != texts
    file = tmp_path / "x.dxf"
    file.write_bytes(as_dxf(lines, wrong))

    found = marked(ready, file)

    assert found.marking.first_wrong == "V_A"
    assert verdicts(found)["V_A"] is Verdict.SCALE
    assert verdicts(found)["a_B"] is Verdict.RIGHT


@pytest.mark.parametrize("variant", some(["4", "0"], 0))
def test_the_scale_factor_of_a_detail_is_not_that_of_its_plan(tmp_path: Path, variant: str) -> None:
    """Points of the acceleration plan crowd on the sheet of variant 4: it has them in a detail, too."""
    only, file = "velocity,acceleration", tmp_path / "own.svg"
    drawn = sheet("scheme-09-shaper", variant, only=only)
    drawn.save(file)
    ready, _ = asked("scheme-09-shaper", variant=variant, only=only)

    found = marked(ready, file)

    assert ('class="enlarged"' in file.read_text(encoding="utf-8")) == (variant == "4")
    assert found.seen is not None
    assert {plan: found.seen.mus[plan] for plan in found.seen.written} == {
        plan: pytest.approx(drawn.scales[plan].mu) for plan in only.split(",")
    }
    assert set(verdicts(found).values()) == {Verdict.RIGHT}


def test_a_plan_that_is_missing_is_told_and_not_wrong(tmp_path: Path) -> None:
    ready, key = asked("nau-slider-crank")
    lines, texts = plans_of(key, key.key.paper.program, key.key.values)
    velocity = [plan for plan in key.key.paper.program.plans if plan in key.key.paper.mus].index("velocity")
    pole = complex(APART * (velocity % 3), APART * (velocity // 3))
    file = tmp_path / "x.dxf"
    file.write_bytes(as_dxf([line for line in lines if abs(line[0] - pole) > 0.4 * APART], texts))

    found = marked(ready, file)

    assert {line.name for line in found.lines if line.verdict.faulty} == set()
    assert {line.verdict for line in found.lines if line.plan == "velocity"} == {Verdict.MISSING}
    assert any("Velocity plan" in note.text("en") and "V_B" in note.text("en") for note in found.notes)


@pytest.mark.parametrize(("names", "students"), [
    pytest.param(("plans-1", "plans-2"), 1, id="pages"),
    pytest.param(("plans-3", "plans-4"), 2, id="variants"),
    pytest.param(("plans-1", "other-2"), 2, id="two names"),
    pytest.param(("AT 23-1", "AT 23-2"), 2, id="record books"),
])  # fmt: skip
def test_drawings_numbered_as_pages_are_are_one_students(tmp_path: Path, names: tuple[str, str], students: int) -> None:
    roster = tmp_path / "class.csv"
    roster.write_text("student;record book;variant\nKoval;AT 23-1;0\nBondar;AT 23-2;0\n", encoding="utf-8")
    (tmp_path / "works").mkdir()
    ready, key = asked("nau-slider-crank", roster=roster)
    lines, texts = plans_of(key, key.key.paper.program, key.key.values)
    half = {
        name: [line for line in lines if (line[0].imag < 0.6 * APART) is under]
        for name, under in zip(names, (True, False), strict=True)
    }
    for name, page in half.items():
        low = min(end.imag for line in page for end in line)
        moved = [(a - 1j * low, b - 1j * low) for a, b in page]
        own = [(at - 1j * low, text) for at, text in texts if (at.imag < 0.6 * APART) is (name == names[0])]
        (tmp_path / "works" / f"{name}.dxf").write_bytes(as_dxf(moved, own))

    answers = ready.read(str(tmp_path / "works"))
    first = ready.mark(answers[0]).marked

    assert len(answers) == students
    assert {line.verdict for line in first.lines if line.verdict.faulty} == set()
    whole = {line.plan for line in first.lines if line.verdict is Verdict.RIGHT} >= {"velocity", "forces_23"}
    assert whole is (students == 1)
    assert any(note.key == "drawing-pages" for note in first.notes) is (students == 1)


def of_plan(key: Keyed, lines: Lines, plan: str) -> Lines:
    """The lines of one plan of those that `plans_of` draws."""
    drawn = [plan for plan in key.key.paper.program.plans if role(plan).kind != LEVER and plan in key.key.paper.mus]
    number = drawn.index(plan)
    pole = complex(APART * (number % 3), APART * (number // 3))
    return [line for line in lines if abs(line[0] - pole) < 0.5 * APART]


@pytest.mark.parametrize(("task", "variant"), some([("scheme-08-planer", "0"), ("scheme-09-shaper", "1")], 0))
def test_a_lever_is_no_velocity_plan_of_a_sheet_that_is_turned(tmp_path: Path, task: str, variant: str) -> None:
    """The second page of a sheet has force plans and Zhukovsky's lever, the velocity plan turned by a right angle."""
    ready, key = asked(task, variant=variant)
    lines, texts = plans_of(key, key.key.paper.program, key.key.values)
    forces = [line for plan in ("forces_23", "forces_1") for line in of_plan(key, lines, plan)]
    lever = [(1.25j * a, 1.25j * b) for a, b in of_plan(key, lines, "velocity")]
    file = tmp_path / "x.dxf"
    file.write_bytes(as_dxf([*forces, *lever], texts))

    found = marked(ready, file)

    assert set(verdicts(found).values()) == {Verdict.RIGHT}
    assert {line.plan for line in found.lines if line.verdict is Verdict.RIGHT} >= {"forces_23", "forces_1"}
    assert {line.verdict for line in found.lines if line.plan == "velocity"} == {Verdict.MISSING}


@pytest.mark.parametrize("letters", [True, False])
def test_what_is_drawn_right_is_right_whatever_follows_it(tmp_path: Path, letters: bool) -> None:
    """V_BA askew was read as the plan of a crank that stands elsewhere, on a sheet upside down: V_A was wrong."""
    ready, _ = asked("nau-slider-crank", variant="3", only="velocity")
    p, a, b = (100.0, 100.0), (150.8, 129.3), (145.0, 100.0)
    p, a, b = (complex(*point) for point in (p, a, b))
    file = tmp_path / "own.dxf"
    names = [(p - 5, "p"), (a + 2, "a"), (b + 1 - 4j, "b")] if letters else []
    file.write_bytes(as_dxf([(p, a), (a, b), (p, b)], [(20 + 190j, "μ_V = 0,1 (м/с)/мм"), *names]))

    said = verdicts(marked(ready, file))

    assert said == {"V_A": Verdict.RIGHT, "V_BA": Verdict.WRONG, "V_B": Verdict.CARRIED}


@pytest.mark.parametrize(("b", "wrong"), [(57.5, None), (59.0, "V_BA"), (50.0, "V_BA"), (66.0, "V_BA")])
def test_a_plan_with_one_point_elsewhere_is_judged_line_by_line(tmp_path: Path, b: float, wrong: str | None) -> None:
    """It was not recognised, and all its vectors were missing, unless a known mistake put the point there."""
    ready, key = asked("nau-slider-crank", variant="3", only="velocity,acceleration")
    lines, texts = plans_of(key, key.key.paper.program, key.key.values)
    (p, a), *_ = velocity = of_plan(key, lines, "velocity")
    s2 = a + (p + b - a) * 65.0 / 190.0
    assert len(velocity) == 4
    own = [(p, a), (a, p + b), (p, p + b), (p, s2)]
    file = tmp_path / "own.dxf"
    file.write_bytes(as_dxf([*own, *of_plan(key, lines, "acceleration")], texts))

    found = marked(ready, file)

    said, mm = verdicts(found), {line.name: line.answer.mm for line in found.lines if line.answer}
    assert {name for name, verdict in said.items() if verdict.faulty and verdict is not Verdict.CARRIED} == {wrong} - {
        None
    }
    assert said["V_A"] is Verdict.RIGHT
    assert [mm[name] for name in ("V_BA", "V_B", "V_S2")] == pytest.approx([abs(p + b - a), b, abs(s2 - p)], abs=0.1)


BLANKS = [
    ("nau-slider-crank", "3", "velocity"), ("nau-slider-crank", "4", None), ("scheme-06-opposed-compressor", "1", None),
    ("nau-slider-crank", "0", None), ("scheme-01-compressor", "1", None), ("scheme-04-v-engine", "1", None),
    ("madi-four-bar", "17", None), ("scheme-14-jaw-crusher", "1", None),
]  # fmt: skip


@pytest.mark.parametrize(("task", "variant", "only"), some(BLANKS, 0, 1))
def test_nothing_is_drawn_on_a_blank(tmp_path: Path, task: str, variant: str, only: str | None) -> None:
    """Lines of its tables were read as the plan of a crank along the edges of the sheet; blanks got 20 to 40 of 100."""
    file = tmp_path / "blank.pdf"
    handout(task, variant, only=only, lang="uk").save(file)

    with pytest.raises(InputError) as error:
        marked(check(task, variant, only=only, lang="en"), file)

    assert error.value.key == "drawing-unknown"


@pytest.mark.parametrize(("task", "variant"), some([
    pytest.param("scheme-19-scotch-yoke", "4", id="forces along one line, whose arrowheads meet"),
    pytest.param("scheme-02-forging-press", "2", id="the scale factor of a detail is nearest to a plan"),
    pytest.param("scheme-01-compressor", "2", id="that of a diagram is"),
    pytest.param("scheme-16-hay-baler", "1", id="vectors too short to be found are not found elsewhere"),
], 0, 1, 2))  # fmt: skip
def test_nothing_is_wrong_on_a_sheet_of_kulmans(tmp_path: Path, task: str, variant: str) -> None:
    file = tmp_path / "whole.pdf"
    sheet(task, variant, lang="uk").save(file)

    found = marked(check(task, variant, lang="uk"), file)

    assert {line.name for line in found.lines if line.verdict.faulty} == set()
    assert len(verdicts(found)) >= 0.9 * len(found.lines)


SOME_PLANS = [
    ("nau-slider-crank", "3"), ("scheme-14-jaw-crusher", "1"), ("scheme-04-v-engine", "3"),
    pytest.param("scheme-02-forging-press", "1", id="vectors over one another"),
]  # fmt: skip


@pytest.mark.parametrize("only", some(["velocity", "position,velocity", "position,velocity,acceleration"], 0, 2))
@pytest.mark.parametrize(("task", "variant"), some(SOME_PLANS, 0, 3))
def test_plans_that_are_not_drawn_are_not_found_in_other_lines(
    tmp_path: Path, task: str, variant: str, only: str
) -> None:
    file = tmp_path / "some.dxf"
    sheet(task, variant, only=only).save(file)

    found = marked(check(task, variant, lang="en"), file)

    assert set(verdicts(found).values()) == {Verdict.RIGHT}
    assert {line.plan for line in found.lines if line.verdict is Verdict.RIGHT} == {*only.split(",")} - {"position"}


def test_a_vector_too_short_to_be_seen_costs_nothing(tmp_path: Path) -> None:
    ready, key = asked("scheme-13-toggle-press", variant="3")
    file = handed_in(tmp_path, key, key.key.paper.program, key.key.values)
    result = marked(ready, file)
    tiny = {
        n for n, q in key.key.questions.items() if q.vector and 0 < abs(key.key[n]) < 2.0 * key.key.paper.mus[q.plan]
    }
    assert {"F_i2", "F_i3", "R_12_t"} <= tiny
    assert Verdict.MISSING not in {verdict for name, verdict in verdicts(result).items() if name in tiny}
    assert result.mark == pytest.approx(100.0)
    (note,) = {str(note) for note in result.notes if note.key == "drawing-tiny" and "F_i2" in str(note)}
    assert "R^t_12" in note
    assert "F_i3" in note


@pytest.mark.parametrize(("task", "theirs"), [
    ("nau-slider-crank", "7"),
    pytest.param("scheme-14-jaw-crusher", "5", id="a fifth of its vectors too short to be seen"),
])  # fmt: skip
def test_a_drawing_of_another_variant_is_recognised_and_measured_as_it_is_drawn(
    tmp_path: Path, task: str, theirs: str
) -> None:
    ready, _ = asked(task, variant="3")
    _, other = asked(task, variant=theirs)

    found = marked(ready, handed_in(tmp_path, other, other.key.paper.program, other.key.values))

    assert found.fits == theirs
    measured = {line.name: line.answer.mm for line in found.lines if line.answer is not None}
    assert len(measured) >= 0.9 * len(found.lines) > 3
    mus = {name: other.key.paper.mus[question.plan] for name, question in other.key.questions.items()}
    assert measured == {name: pytest.approx(abs(other.key.values[name]) / mus[name], abs=0.1) for name in measured}


def test_a_drawing_of_something_else_is_refused(tmp_path: Path) -> None:
    ready, _ = asked("nau-slider-crank")
    file = tmp_path / "x.svg"
    file.write_bytes(as_svg([(0j, 100 + 0j), (100 + 0j, 100 + 50j), (100 + 50j, 0j)], []))

    with pytest.raises(InputError) as error:
        marked(ready, file)

    assert error.value.key == "drawing-unknown"


@pytest.mark.parametrize("times", some([10.0, 0.02], 1))
def test_a_drawing_in_another_unit_is_refused_by_its_size(tmp_path: Path, times: float) -> None:
    ready, own = asked("nau-slider-crank")
    lines, _ = plans_of(own, own.solution.solved.program, own.key.values)
    file = tmp_path / "x.dxf"
    file.write_bytes(as_dxf([(a * times, b * times) for a, b in lines], []))

    with pytest.raises(InputError) as error:
        marked(ready, file)

    assert error.value.key == "drawing-size"
    assert str(round(times * max(abs(a - b) for a, b in lines))) in str(error.value)


def test_a_drawing_is_returned_with_verdicts(tmp_path: Path, run: Run) -> None:
    _, key = asked("nau-slider-crank")
    one = next(one for one in key.book.signatures if one.broken.mistake == "M39")
    file = handed_in(tmp_path, key, one.broken.program, one.values)
    outputs = [tmp_path / f"marked{kind}" for kind in (".svg", ".pdf", ".dxf", ".html")]

    status, _, stderr = run("check", "nau-slider-crank", str(file), "--lang", "en", *(f"-o{out}" for out in outputs))

    assert status == 0, stderr
    before, after = read_drawing(file), read_drawing(outputs[2])
    assert len(after.tails) > len(before.tails)
    texts = {letter.text.replace(" ", "") for letter in after.letters}
    assert any(text.startswith("dashed") for text in texts)
    svg = outputs[0].read_text("utf-8")
    told = re.findall(r'<(?:g|text) class="label" data-name="(\w+)"[^>]*>([^✓✗]*?)([✓✗])', svg)
    assert {mark for *_, mark in told} == {"✓", "✗"}
    assert {name for name, *_ in told} == {*re.findall(r'class="arrow" data-name="(\w+)"', svg)}
    assert "stroke-dasharray" in svg
    assert "data:image/svg+xml" in outputs[3].read_text("utf-8")


@pytest.mark.soak
def test_a_student_is_not_shown_where_a_wrong_vector_should_be(tmp_path: Path, run: Run) -> None:
    _, key = asked("nau-slider-crank")
    one = next(one for one in key.book.signatures if one.broken.mistake == "M39")
    file = handed_in(tmp_path, key, one.broken.program, one.values)
    drawings = {}
    for own in ((), ("--verdict-only",)):
        out = tmp_path / f"marked{len(own)}.dxf"
        run("check", "nau-slider-crank", str(file), *own, "-o", str(out))
        drawings[own] = read_drawing(out)

    assert len(drawings[()].tails) > len(drawings["--verdict-only",].tails)


def test_a_marked_drawing_is_refused_for_a_form(tmp_path: Path, run: Run) -> None:
    status, _, stderr = run("check", "nau-slider-crank", "printed", "-o", str(tmp_path / "marked.svg"), "--lang", "en")

    assert status == 2
    assert "only for one drawing" in stderr
    assert not (tmp_path / "marked.svg").exists()


def test_drawings_of_a_class_are_named_after_students(tmp_path: Path) -> None:
    _, key = asked("nau-slider-crank", variant="3")
    folder = tmp_path / "works"
    folder.mkdir()
    drawing = handed_in(tmp_path, key, key.key.paper.program, key.key.values)
    (folder / "Koval_Olha.dxf").write_bytes(drawing.read_bytes())
    (folder / "broken.svg").write_text("<svg")
    roster = tmp_path / "class.csv"
    roster.write_text("student;variant\nKoval Olha;3\nBondar Ivan;4\n", encoding="utf-8")
    told: list[str] = []
    ready = check("nau-slider-crank", roster=roster, lang="en")

    answers = ready.read(str(folder), warn=lambda error: told.append(error.text("en")))
    results = ready.mark_all(answers, tmp_path / "out", jobs=1)

    by_name = {result.who.student: result for result in results}
    assert by_name["Koval Olha"].mark == pytest.approx(100.0, abs=5.0)
    assert not by_name["Koval Olha"].exact
    assert [one.mark for name, one in by_name.items() if name != "Koval Olha"] == [None]
    assert len(told) == 1


@pytest.mark.parametrize("name", [
    pytest.param("Лисенко_Соломія_Ірина_Богданівна", id="by hand"),
    pytest.param(f"017-{slug('Лисенко Соломія-Ірина Богданівна 6')}-handout", id="by batch"),
    pytest.param("Лисенко Соломія-Ірина", id="as it is"),
    pytest.param(f"018-{slug(chr(39).join(('Мар', 'яненко О.')))}-2", id="an apostrophe"),
])  # fmt: skip
def test_a_file_is_a_students_whatever_its_name_has_lost(tmp_path: Path, name: str) -> None:
    students = "Лисенко Соломія-Ірина Богданівна", "Мар'яненко Олена", "Лисенко Олег"
    roster, works = tmp_path / "class.csv", tmp_path / "works"
    roster.write_text("student;variant\n" + "".join(f"{who};3\n" for who in students), encoding="utf-8")
    works.mkdir()
    for file in (name, "Nobody"):
        (works / f"{file}.svg").write_text("<svg")
    ready = check("nau-slider-crank", roster=roster)

    one, other = sorted(ready.read(str(works), warn=lambda error: None), key=lambda one: "Nobody" in one.source)

    assert one.who.student in students[:2]
    assert ready.entry_of(other) is None


def test_a_marked_drawing_is_plain_data_too(tmp_path: Path, run: Run) -> None:
    _, key = asked("nau-slider-crank")
    file = handed_in(tmp_path, key, key.key.paper.program, key.key.values)

    _, stdout, _ = run("check", "nau-slider-crank", str(file), "--json", "--lang", "en")

    said = json.loads(stdout)
    assert said["counts"]["wrong"] == 0
    assert {line["verdict"] for line in said["lines"]} <= {"right", "missing"}


def test_lines_and_letters_of_a_drawing_lie_under_its_verdicts_as_far_as_it_is_shown() -> None:
    letters = (Letter("A", 5.0 + 5.0j, 3.5), Letter("B", 9.0 + 5.0j, 300.0), Letter("C", 12.0 + 5.0j, 3.5))
    drawn = Drawn(np.array([0j, 1j, 9.0 + 0j]), np.array([10.0 + 10.0j, 11.0 + 0j, 9.0 + 8.0j]), letters)

    lines, *texts = _under(drawn, (0.0, 0.0, 10.0, 10.0))

    assert isinstance(lines, Group)
    assert [(line.a, line.b) for line in lines.shapes if isinstance(line, Line)] == [(0j, 10 + 10j), (9 + 0j, 9 + 8j)]
    # as high as they are, but no higher than 20 mm
    assert {shape.markup: shape.height for shape in texts if isinstance(shape, Text)} == {"A": 3.5, "B": 20.0}
