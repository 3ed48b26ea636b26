"""Photographs of sheets drawn by hand: markers, bounds, what was drawn is what is read, nothing doubtful is wrong."""

from __future__ import annotations

import cmath
import io
import math
import struct
import sys
import time
import zlib
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
import zxingcpp
from PIL import Image

from kulman import check, handout, load_task
from kulman.drawing.formats import FORMATS, drawing_area
from kulman.drawing.markers import EACH, SIDE, fields, scannable, stands
from kulman.drawing.page import Page
from kulman.drawing.shapes import shifted
from kulman.plans.marking.answers import Verdict
from kulman.plans.marking.drawn import Found, FoundPlan, Recognised
from kulman.plans.marking.lines import Drawn
from kulman.plans.marking.ways import RIGHT, Shape, shapes_of
from kulman.scales.errors import InputError
from kulman.tests.photos.measure import Figures, chosen_ways, compared, linkages, measured, mistakes_of
from kulman.tests.photos.synthesiser import (
    MESSENGER,
    PHONE,
    PX,
    SCANNER,
    Paper,
    Truth,
    drawn,
    photographed,
    printed,
    sheet_for,
)
from kulman.tests.support.cases import some
from kulman.variants.case import Request
from kulman.variants.drawings import apart, pdf
from kulman.variants.drawings.files import read_drawing
from kulman.variants.marking.checks import Check
from kulman.variants.marking.marked import surely
from kulman.variants.marking.reading import Answers
from kulman.variants.marking.report import Report
from kulman.variants.marking.result import Result, result_of
from kulman.variants.marking.seen import Seen
from kulman.variants.photos import matching, pictures
from kulman.variants.photos.matching import SURE, _times, lines_of, matched
from kulman.variants.photos.pictures import Photo, read_photos, together
from kulman.variants.photos.reading import _print_scale, on_page, rendered
from kulman.variants.photos.straight import ASTRAY, PER_MM, _fitted, framed, straightened, without_worst
from kulman.variants.photos.traced import Pencil, ends_at, senses, traced
from kulman.variants.roster import Who
from kulman.variants.sheets import drawing_for_print, scan_code

TASK, PLANS = "nau-slider-crank", "velocity"


@pytest.fixture(scope="module")
def honest(tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, dict[str, Truth]]:
    """The velocity plan of an honest student, photographed with a phone and marked, and what was drawn."""
    sheet, random = sheet_for(TASK, only=PLANS), np.random.default_rng(5)
    page = sheet.poles["velocity"][0]
    ink, truth = drawn(sheet, page, random, chosen_ways(sheet, RIGHT))
    file = tmp_path_factory.mktemp("photos") / "student.jpg"
    file.write_bytes(photographed(ink, random, PHONE))
    ready = check(TASK, "0", only=PLANS, lang="en")
    return ready.mark(ready.read(str(file))[0]), truth


@pytest.mark.parametrize("name", FORMATS)
def test_markers_of_an_empty_page_stand_in_its_corners_and_in_the_middle_of_its_sides(name: str) -> None:
    paper = FORMATS[name]
    page = scannable(Page(paper.width, paper.height, (), "x", "uk"), (), 1, "id", paper, "gost")
    x, y = ((5.0, (size - SIDE) / 2.0, size - SIDE - 5.0) for size in (paper.width, paper.height))

    wanted = [complex(x[i], y[k]) for i, k in ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))]

    assert [place.number for place in stands(page)] == [*range(EACH)]
    assert all(abs(place.at - at) < 2.0 for place, at in zip(stands(page), wanted, strict=True))


def test_markers_are_those_of_the_dictionary() -> None:
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_250)

    for number in range(250):
        assert np.array_equal(cv2.aruco.generateImageMarker(dictionary, number, 6) < 128, fields(number))


def test_a_page_has_as_many_pixels_as_its_paper_is_large() -> None:
    page = sheet_for(TASK, only=PLANS).pages[1]

    for per_mm in (PER_MM, 12):
        assert rendered(page, per_mm).shape[:2] == (round(page.height * per_mm), round(page.width * per_mm))


def test_a_page_tells_its_number_and_its_task_but_no_answer() -> None:
    sheet = sheet_for(TASK, only=PLANS)
    number = sheet.poles["velocity"][0]
    places = stands(sheet.pages[number])
    grey = printed(sheet, number)
    (code,) = zxingcpp.read_barcodes(grey)
    said = code.text.split(":")

    assert {place.number // EACH for place in places} == {number}
    assert said[:3] == ["KULMAN", TASK.upper(), "0"]
    assert said[4:7] == [str(number + 1), "UK", "A4"]
    for place in places:  # drawn as large as it is said to be
        x, y = (np.array([place.at.real, grey.shape[0] / PX - place.at.imag - SIDE]) * PX).round().astype(int)
        middles = [round((at + 0.5) * SIDE / 6 * PX) for at in range(6)]
        black = grey[np.ix_([y + m for m in middles], [x + m for m in middles])] < 128
        assert np.array_equal(black, fields(place.number))


def test_what_was_drawn_is_read(honest: tuple[Report, dict[str, Truth]]) -> None:
    marked, truth = honest[0].marked, honest[1]

    assert marked.seen is not None
    read = marked.seen.recognised.vectors
    assert {*truth} <= {*read}
    for name, one in truth.items():
        ends = [on_page(marked.sheets, end)[1] for end in (read[name].tail, read[name].tip)]
        # a point on a line is read where lines cross, of which a stroke may stop short
        assert max(abs(ends[0] - one.tail), abs(ends[1] - one.tip)) < 1.2, name
    assert {line.verdict for line in marked.lines} == {Verdict.RIGHT}
    assert marked.mark == 100.0


def test_a_vector_truly_is_where_its_stroke_was_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    strokes, stroke = set[tuple[complex, complex]](), Paper.stroke

    def watched(paper: Paper, a: complex, b: complex, *how: float) -> None:
        strokes.update(((a, b), (b, a)))
        stroke(paper, a, b, *how)

    monkeypatch.setattr(Paper, "stroke", watched)
    sheet = sheet_for(TASK, only=PLANS)
    ways = chosen_ways(sheet, RIGHT)

    _, truth = drawn(sheet, sheet.poles["velocity"][0], np.random.default_rng(5), ways)

    assert {*truth} == {*ways["velocity"].names}
    assert strokes.issuperset((one.tail, one.tip) for one in truth.values())


def test_the_code_of_a_page_is_the_same_where_numbers_differ_in_their_last_digits() -> None:
    sheet, case = sheet_for(TASK, only=PLANS), Request(load_task(TASK), "0").case()

    def code(by: complex) -> str:
        page = sheet.pages[0]
        return scan_code(case, 1, replace(page, shapes=tuple(shifted(shape, by) for shape in page.shapes)))

    assert code(1e-11 - 1e-11j) == code(-1e-11 + 1e-11j) == code(0j)
    assert code(1.0 + 0j) != code(0j)


def test_other_pictures_and_other_arrowheads_are_other_answers() -> None:
    photo = Photo("x.jpg", 1, {}, 0j, (), b"one")
    lines = Drawn(np.array([0j]), np.array([10 + 0j]))
    answers = Answers("x", Who(), {}, {}, {}, drawn=lines, photos=(photo,))

    others = [
        replace(answers, photos=(replace(photo, picture=b"other"),)),
        replace(answers, drawn=replace(lines, arrows=np.array([0]))),
    ]
    assert len({one.digest for one in (answers, *others)}) == 3
    assert replace(answers).digest == answers.digest


def test_a_mistake_is_named_and_a_line_that_is_not_sure_is_not_wrong(tmp_path: Path) -> None:
    sheet, random = sheet_for(TASK, only=PLANS), np.random.default_rng(3)
    numbers = {sheet.keyed.book.signatures[n].broken.mistake: n for n in mistakes_of(sheet)}
    ink, truth = drawn(sheet, sheet.poles["velocity"][0], random, chosen_ways(sheet, numbers["M26"]))
    file = tmp_path / "student.jpg"
    file.write_bytes(photographed(ink, random, PHONE))
    ready = check(TASK, "0", only=PLANS, lang="en")

    marked = ready.mark(ready.read(str(file))[0]).marked
    figures = Figures()
    compared(figures, sheet, truth, marked, numbers["M26"])

    assert figures.read >= 3
    assert figures.wrong == 0
    assert figures.named == 1


@pytest.mark.parametrize(("by", "quality"), [(8.0 + 0.0j, PHONE), (5.0 - 7.0j, SCANNER)])
def test_a_plan_with_one_point_elsewhere_is_read_as_it_is_drawn_and_judged_line_by_line(
    by: complex, quality: str, tmp_path: Path
) -> None:
    """All its vectors were missing, unless a known mistake put the point there."""
    sheet, random = sheet_for(TASK, only=PLANS), np.random.default_rng(3)
    way = sheet.ways("velocity", False)[0]
    places = way.places.copy()
    a, b, s2 = (way.marks.index(f"velocity.{name}") for name in ("A", "B", "S2"))
    part = (places[s2] - places[a]) / (places[b] - places[a])
    places[b] += by * sheet.mus["velocity"]
    places[s2] = places[a] + part * (places[b] - places[a])  # follows
    ink, truth = drawn(sheet, sheet.poles["velocity"][0], random, {"velocity": replace(way, places=places)})
    (tmp_path / "student.jpg").write_bytes(photographed(ink, random, quality))
    ready, figures = check(TASK, "0", only=PLANS, lang="en"), Figures()

    marked = ready.mark(*ready.read(str(tmp_path / "student.jpg"))).marked
    compared(figures, sheet, truth, marked, RIGHT)

    verdicts = {line.name: line.verdict for line in marked.lines}
    assert {"V_A", "V_BA", "V_B"} <= {*marked.seen.recognised.vectors}
    assert figures.wrong == 0
    assert (verdicts["V_A"], verdicts["V_BA"]) == (Verdict.RIGHT, Verdict.WRONG)
    assert [name for name, verdict in verdicts.items() if verdict is Verdict.WRONG] == ["V_BA"]


@pytest.mark.parametrize("mistake", [True, False])
def test_a_line_of_which_a_right_plan_is_but_a_part_is_read_as_far_as_it_goes(mistake: bool, tmp_path: Path) -> None:
    """All of the right plan was there, so none with a mistake was looked for, and its vectors were asked for."""
    task, plan = "scheme-02-forging-press", "forces_1"
    sheet, random = sheet_for(task), np.random.default_rng(4)
    right, *others = sheet.ways(plan, True)
    longer = [way for way in others if 5.0 < (way.longest - right.longest) / sheet.mus[plan] < 20.0]
    way = next(way for way in longer if np.abs(np.angle(way.spans / right.spans)).max() < 0.01) if mistake else right
    number = sheet.poles[plan][0]
    ink, truth = drawn(sheet, number, random, {**chosen_ways(sheet, RIGHT), plan: way})
    (tmp_path / "student.jpg").write_bytes(photographed(ink, random, PHONE))
    ready, figures = check(task, sheet.case.variant, lang="en"), Figures()
    truth = {name: one for name, one in truth.items() if one.plan == plan}

    marked = ready.mark(*ready.read(str(tmp_path / "student.jpg"))).marked
    compared(figures, sheet, truth, marked, RIGHT)

    assert {name for name in truth if name in marked.seen.recognised.vectors} == {*truth}
    assert figures.wrong == 0
    assert (marked.seen.recognised.plans[plan].mistake == "") is not mistake


@pytest.mark.parametrize("lacks", ["", "V_B"])
def test_no_point_of_a_right_plan_is_elsewhere_where_other_lines_are_drawn(lacks: str) -> None:
    sheet = sheet_for(TASK, only=PLANS)
    number, pole = sheet.poles["velocity"]
    way = sheet.ways("velocity", False)[0]
    own = np.array([at for at, name in enumerate(way.names) if name != lacks])
    tails, tips = (pole + way.places[side[own]] / sheet.mus["velocity"] for side in (way.tails, way.tips))
    others = np.array([(-30 - 20j, 70 + 25j), (15 + 40j, 15 - 40j), (-20 + 12j, 80 + 10j)]) + pole  # also through it

    lines = lines_of(np.append(tails, others[:, 0]), np.append(tips, others[:, 1]))
    found = matched({number: lines}, {"velocity": (number, pole)}, sheet.mus, sheet.keyed).vectors

    spans = {name: way.places[b] - way.places[a] for name, a, b in zip(way.names, way.tails, way.tips, strict=True)}
    assert {*found} >= {name for name in spans if name in sheet.keyed.key.questions} - {"V_B", "V_S2"}
    assert all(abs(one.tip - one.tail - spans[name] / sheet.mus["velocity"]) < 1.0 for name, one in found.items())


FORCES = {"forces_23", "forces_2", "forces_1"}


@cache
def pages_of(only: str | None, *plans: str) -> list[bytes]:
    """Photographs of the pages on which an honest student has drawn these plans."""
    sheet, random = sheet_for(TASK, only=only), np.random.default_rng(5)
    ways, numbers = chosen_ways(sheet, RIGHT), dict.fromkeys(sheet.poles[plan][0] for plan in plans)
    return [photographed(drawn(sheet, number, random, ways)[0], random, PHONE) for number in numbers]


def missing(answers: Answers, ready: Check) -> set[str]:
    """Of which plans vectors are missing."""
    return {line.plan for line in ready.mark(answers).marked.lines if line.verdict is Verdict.MISSING}


def notes_of(result: Result) -> str:
    return " | ".join(result.notes)


@pytest.mark.parametrize("only", some([None, "velocity,forces"], 0))
def test_a_page_that_is_not_handed_in_is_missing_as_empty_cells_of_a_form_are(only: str | None, tmp_path: Path) -> None:
    page = pages_of(only, "velocity", "forces_23")[0]
    (tmp_path / "student.jpg").write_bytes(page)
    ready = check(TASK, "0", only=only, lang="en")
    (answers,) = ready.read(str(tmp_path / "student.jpg"))
    unread = replace(answers, problems=(InputError("photo-few", file="student-3.jpg"),))

    poles = sheet_for(TASK, only=only).poles
    here = {plan for plan in FORCES & poles.keys() if poles[plan][0] == poles["velocity"][0]}
    gone = FORCES - here

    assert gone
    assert missing(answers, ready) == gone
    assert ready.mark(answers).marked.mark < (70.0 if gone == FORCES else 95.0)
    assert missing(unread, ready) == set()  # the page may be the one that could not be read
    assert missing(replace(answers, plans=frozenset()), ready) == (set() if only is None else gone)


@pytest.mark.parametrize(("handed", "asked"), [("velocity", None), ("velocity,acceleration", None), (None, "velocity")])
def test_a_handout_for_other_plans_than_are_asked_for_is_found(
    handed: str | None, asked: str | None, tmp_path: Path
) -> None:
    for number, page in enumerate(pages_of(handed, *("velocity", "acceleration")[: 1 + (handed or "").count(",")])):
        (tmp_path / f"student-{number}.jpg").write_bytes(page)
    ready = check(TASK, "0", only=asked, lang="en")
    (answers,) = ready.read(str(tmp_path))

    marked = ready.mark(answers).marked

    assert {line.plan for line in marked.lines} == {*(asked or handed or "").split(",")}
    assert marked.mark == 100.0


def test_of_a_handout_from_other_data_that_is_told_not_that_nothing_is_drawn(tmp_path: Path) -> None:
    (tmp_path / "student.jpg").write_bytes(pages_of("velocity", "velocity")[0])
    ready = check(TASK, "0", scales={"mu_V": "0.2"}, lang="en")

    with pytest.raises(InputError) as error:
        ready.mark(*ready.read(str(tmp_path / "student.jpg")))

    assert error.value.key == "photo-other"


@pytest.mark.soak
@pytest.mark.parametrize("quality", [PHONE, SCANNER, MESSENGER])
def test_a_plan_is_missing_where_it_begins_nothing_is_drawn_and_not_judged_where_it_is_faint(
    quality: str, tmp_path: Path
) -> None:
    sheet, ready = sheet_for(TASK), check(TASK, "0", lang="en")
    ways, (number, _) = chosen_ways(sheet, RIGHT), sheet.poles["velocity"]
    both = {plan for plan, (page, _) in sheet.poles.items() if page == number}
    found = dict[str, tuple[set[str], str]]()
    for how, plans in (("blank", both - {"velocity"}), ("faint", both)):
        random = np.random.default_rng(7)
        ink, _ = drawn(sheet, number, random, {plan: ways[plan] for plan in plans}, faint={"velocity"})
        (tmp_path / f"{how}.jpg").write_bytes(photographed(ink, random, quality))
        (answers,) = ready.read(str(tmp_path / f"{how}.jpg"))
        found[how] = missing(answers, ready), notes_of(result_of(ready.mark(answers).marked, "en"))

    assert len(both) > 1
    assert found["blank"][0] & both == {"velocity"}
    assert "where it begins nothing is drawn, so it is missing" in found["blank"][1]
    assert not found["faint"][0] & both
    assert "nothing is drawn" not in found["faint"][1]


def test_a_page_on_which_nothing_is_drawn_is_said_to_be_blank_and_one_drawn_faintly_is_not(tmp_path: Path) -> None:
    sheet, ready = sheet_for(TASK), check(TASK, "0", lang="en")
    ways, (number, _) = chosen_ways(sheet, RIGHT), sheet.poles["velocity"]

    def result(how: str, *plans: str) -> Result:
        random = np.random.default_rng(7)
        ink, _ = drawn(sheet, number, random, {plan: ways[plan] for plan in plans}, faint={*plans})
        (tmp_path / f"{how}.jpg").write_bytes(photographed(ink, random, SCANNER))
        return result_of(ready.mark(*ready.read(str(tmp_path / f"{how}.jpg"))).marked, "en")

    with pytest.raises(InputError) as error:
        result("blank")

    assert error.value.key == "photo-blank"
    assert result("faint", "velocity").mark is not None


def test_what_somebody_of_a_class_has_drawn_is_asked_of_all(tmp_path: Path) -> None:
    both = pages_of(None, "velocity", "forces_23")
    for name in ("Koval-2", "Bondar-2", "Melnyk-2"):
        (tmp_path / f"{name}.jpg").write_bytes(both[0])
    ready = check(TASK, "0", lang="en")

    few = ready.mark_all(ready.read(str(tmp_path)), jobs=1)
    (tmp_path / "Koval-3.jpg").write_bytes(both[1])
    found = ready.read(str(tmp_path))
    by_name = {Path(one.source).name.partition("-")[0]: one for one in found}
    broken = InputError("photo-few", file="Melnyk-3.jpg")
    whole = [by_name["Koval"], by_name["Bondar"], replace(by_name["Melnyk"], problems=(broken,))]
    koval, bondar, melnyk = ready.mark_all(whole, tmp_path / "reports", jobs=1)

    assert {one.mark for one in few} == {100.0}  # of nobody's a page with forces is there: it was not asked for
    assert all("it was read of nobody in the class, so it is not asked for" in notes_of(one) for one in few)
    assert koval.mark == melnyk.mark == 100.0
    assert bondar.mark is not None
    assert bondar.mark < 70.0
    assert bondar.counts["missing"] > 5
    assert "has not been handed in, so it is missing" in notes_of(bondar)
    assert "not recognised on the photographs" in notes_of(melnyk)
    report = (tmp_path / "reports" / bondar.reports[1]).read_text(encoding="utf-8")
    assert "has not been handed in, so it is missing" in report


@pytest.mark.parametrize(("beyond", "wrong"), [(0.7, False), (2.0, True)])
def test_a_vector_is_wrong_only_beyond_what_hand_and_reading_may_miss(
    beyond: float, wrong: bool, honest: tuple[Report, dict[str, Truth]]
) -> None:
    marked, name = honest[0].marked, "V_B"
    assert marked.seen is not None
    assert marked.sheets is not None
    read, right = marked.seen.recognised, marked.marking[name]
    mu, vector = marked.seen.mus["velocity"], read.vectors[name]
    tip = vector.tail + right.right / mu * (1.0 + (right.allowed + beyond * mu) / abs(right.right))
    other = replace(read, vectors={**read.vectors, name: replace(vector, tip=tip)})
    rubric = check(TASK, "0", only=PLANS, lang="en").rubric

    found = surely(marked.answers, marked.keyed, marked.sheets, replace(marked.seen, recognised=other), rubric)

    assert (name in found.recognised.vectors) is wrong
    assert (name in found.recognised.missing) is not wrong


def test_a_plan_read_a_little_too_small_makes_no_scale_factor_wrong() -> None:
    sheet, plan = sheet_for("scheme-09-shaper"), "forces_45"
    (way, *_), mu = sheet.ways(plan, False), sheet.mus[plan]
    places = 0.975 * way.places / mu
    ends = zip(way.names, places[way.tails].tolist(), places[way.tips].tolist(), strict=True)
    vectors = {name: Found(tail, tip, plan, 1.0) for name, tail, tip in ends if name in sheet.keyed.key.questions}
    read = Seen(Recognised({plan: FoundPlan(mu, 0.0, 0j, 1.0)}, vectors, ()), {plan: mu}, frozenset())
    answers, rubric = Answers("student.jpg", Who(), {}, {}, {}), check(sheet.case.task, lang="en").rubric

    found = surely(answers, sheet.keyed, SimpleNamespace(drawn=None), read, rubric)  # type: ignore[arg-type]

    assert {*found.recognised.missing} == {"F_5"}  # 1.1 mm too short


@pytest.mark.parametrize(("beside", "asked"), [(0.5, set()), (1.1, {"F_5"})])
def test_a_force_that_is_laid_off_is_right_within_what_a_photograph_tells(beside: float, asked: set[str]) -> None:
    sheet, plan = sheet_for("scheme-09-shaper"), "forces_45"
    (way, *_), mu = sheet.ways(plan, False), sheet.mus[plan]
    places = way.places / mu
    ends = zip(way.names, places[way.tails].tolist(), places[way.tips].tolist(), strict=True)
    vectors = {name: Found(tail, tip, plan, 1.0) for name, tail, tip in ends if name in sheet.keyed.key.questions}
    force = vectors["F_5"]
    way_of = (force.tip - force.tail) / abs(force.tip - force.tail)
    vectors["F_5"] = replace(force, tip=force.tip + beside * way_of)
    read = Seen(Recognised({plan: FoundPlan(mu, 0.0, 0j, 1.0)}, vectors, ()), {plan: mu}, frozenset({plan}))
    answers = Answers("student.jpg", Who(), {}, {}, {}, photos=(Photo("student.jpg", 1, {}, 0j, (), b""),))
    rubric = check(sheet.case.task, lang="en").rubric

    found = surely(answers, sheet.keyed, SimpleNamespace(drawn=None), read, rubric)  # type: ignore[arg-type]

    assert {*found.recognised.missing} == asked


def test_marked_sheets_are_returned(honest: tuple[Report, dict[str, Truth]]) -> None:
    (_, png), (_, pdf) = (next(iter(honest[0].files(Path(f"marked{kind}")))) for kind in (".png", ".pdf"))

    with Image.open(io.BytesIO(png)) as picture:
        assert picture.width == 2100
        below = np.asarray(picture.convert("L"))[2970:]
        assert below[:, :-40].min() < 100  # what lines mean, with a margin
        assert below[:, -40:].min() > 200
    assert pdf.startswith(b"%PDF")


def as_png(width: int, height: int, colour: int = 255) -> bytes:
    stream = io.BytesIO()
    Image.new("L", (width, height), colour).save(stream, "PNG")
    return stream.getvalue()


def huge() -> bytes:
    """The head of a picture of 400 million pixels."""
    head = b"IHDR" + struct.pack(">IIBBBBB", 20_000, 20_000, 8, 0, 0, 0, 0)
    chunk = struct.pack(">I", 13) + head + struct.pack(">I", zlib.crc32(head))
    return b"\x89PNG\r\n\x1a\n" + chunk + struct.pack(">I", 0) + b"IDAT" + struct.pack(">I", zlib.crc32(b"IDAT"))


HOSTILE: dict[str, tuple[str, Callable[[], bytes], str]] = {
    "empty": (".jpg", lambda: b"", "photo-broken"),
    "broken": (".png", lambda: as_png(600, 600)[:200], "photo-broken"),
    "other": (".png", lambda: b"GIF89a" + bytes(500), "photo-broken"),
    "huge": (".png", huge, "photo-pixels"),
    "small": (".png", lambda: as_png(50, 50), "photo-small"),
    "unrelated": (".png", lambda: as_png(800, 600, 90), "photo-no-markers"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_pictures_of_something_else_are_refused(tmp_path: Path, name: str) -> None:
    suffix, made, key = HOSTILE[name]
    file = tmp_path / f"{name}{suffix}"
    file.write_bytes(made())

    with pytest.raises(InputError) as refused:
        read_photos(file)

    assert refused.value.key == key
    assert "\n" not in refused.value.text("uk")


@pytest.mark.parametrize(
    ("parts", "seconds", "more", "wrong", "given"),
    [
        pytest.param((1, 2, 3), 15, 15, "", [1, 2, 3], id="longer in all than for one part"),
        pytest.param((1, 2, 3), 1, 500, "drawing-late", [], id="too long for the first"),
        pytest.param((1, 2, 3), 500, 1, "drawing-late", [1], id="too long for another"),
        pytest.param((1, "photo-twice", 3), 500, 500, "photo-twice", [1], id="something is wrong"),
        pytest.param((), 1, 500, "drawing-late", [], id="too long for nothing"),
    ],
)
@pytest.mark.parametrize("pause", [0.0, 0.03])
def test_what_is_read_must_give_something_time_and_again(
    parts: tuple[str | int, ...],
    seconds: float,
    more: float,
    wrong: str,
    given: list[int],
    pause: float,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each part takes 8 of the clock's seconds, whether it is looked at when all have come or as it comes."""
    clock, found = [0.0], list[int]()

    def busy(data: bytes) -> Iterator[str | int]:
        for part in parts:
            clock[0] += 8
            yield part
            time.sleep(pause)
        clock[0] += 8

    monkeypatch.setattr(apart, "process_time", lambda: clock[0])

    said = apart._bounded(lambda n, part: found.append(part), busy, b"", seconds, more)

    assert (said, found) == (wrong, given)


def test_pages_of_handouts_are_found_among_others_and_whatever_does_not_look_like_one_is_soon_refused(
    tmp_path: Path,
) -> None:
    sheet, empty = sheet_for(TASK, only=PLANS), Image.new("L", (1240, 1754), 240)
    page = Image.fromarray(printed(sheet, 1)).resize((1754, 1240))
    scan, other = tmp_path / "scan.pdf", tmp_path / "other.pdf"
    empty.save(scan, save_all=True, append_images=[empty, page, empty], resolution=150)
    empty.save(other, save_all=True, append_images=[empty] * 60, resolution=150)

    (answers,) = check(TASK, only=PLANS).read(str(scan))
    with pytest.raises(InputError, match=r"no markers|more time"):
        read_photos(other)

    assert [photo.number for photo in answers.photos] == [2]


def test_markers_of_a_large_picture_are_found_on_a_smaller_one_and_put_right(monkeypatch: pytest.MonkeyPatch) -> None:
    page = printed(sheet_for(TASK, only=PLANS), 1)
    own = dict(zip(*pictures._markers(page)[::-1], strict=True))
    monkeypatch.setattr(pictures, "LOOKED", page.size // 5)

    coarse = dict(zip(*pictures._markers(page)[::-1], strict=True))

    assert {*coarse} == {*own}
    assert max(np.abs(coarse[number] - own[number]).max() for number in own) < 0.3


def test_what_only_looks_like_a_small_marker_is_none() -> None:
    page = printed(sheet_for(TASK, only=PLANS), 1).copy()
    own = dict(zip(*pictures._markers(page)[::-1], strict=True))
    again, times = EACH + 1, 5  # pixels of a field: a marker of the page has 24
    small = np.kron(np.where(np.pad(fields(again), 1), 0, 255).astype(np.uint8), np.ones((times, times), np.uint8))
    page[1500 : 1500 + len(small), 900 : 900 + len(small)] = small

    found = pictures._markers(page)[1]

    assert again in own
    assert sorted(found) == sorted(own)


def of_16_bits(page: Image.Image) -> Image.Image:
    return Image.fromarray(np.asarray(page).astype(np.uint16) * 257)


def of_transparent_paper(page: Image.Image) -> Image.Image:
    ink = np.zeros((page.height, page.width, 4), np.uint8)
    ink[..., 3] = 255 - np.asarray(page)
    return Image.fromarray(ink)


@pytest.mark.parametrize(
    ("made", "suffix", "turn"),
    [
        pytest.param(of_16_bits, ".png", 1, id="16 bits"),
        pytest.param(of_transparent_paper, ".png", 1, id="transparent paper"),
        pytest.param(lambda page: page.convert("CMYK"), ".jpg", 1, id="four inks"),
        pytest.param(lambda page: page.rotate(180), ".jpg", 3, id="turned as EXIF says"),
    ],
)
def test_pictures_of_all_kinds_are_read(
    made: Callable[[Image.Image], Image.Image], suffix: str, turn: int, tmp_path: Path
) -> None:
    page = Image.fromarray(printed(sheet_for(TASK, only=PLANS), 1)).reduce(3)
    exif = Image.Exif()
    exif[0x112] = turn
    made(page).save(tmp_path / f"page{suffix}", exif=exif)

    (photo,) = read_photos(tmp_path / f"page{suffix}")

    assert photo.number == 2
    top, bottom = (photo.markers[EACH + own][0].imag for own in (2, 0))
    assert top < bottom


def test_a_missing_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "zxingcpp", None)

    with pytest.raises(InputError, match="pip install opencv-python-headless") as refused:
        handout(TASK, only="velocity", scan=True)

    assert refused.value.key == "scan-missing"


@pytest.mark.parametrize(
    ("room", "read", "suffix", "key"),
    [(pictures, read_photos, ".png", "scan-missing"), (pdf, read_drawing, ".pdf", "extra-missing")],
)
def test_a_file_is_not_called_broken_where_a_package_is_missing(
    room: Any, read: Any, suffix: str, key: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing_package(*how: object) -> object:
        raise InputError(key, packages="pypdfium2", suffix=suffix)

    monkeypatch.setattr(room, "apart", missing_package)
    (file := tmp_path / f"x{suffix}").write_bytes(b"%PDF-1.7 or so")
    with pytest.raises(InputError) as refused:
        read(file)
    assert refused.value.key == key


def test_pages_go_to_their_students() -> None:
    def page(number: int, sheet: str) -> Photo:
        code = ("KULMAN", "T", "1", sheet, str(number), "UK", "A4", "0") if sheet else ()
        return Photo("stack.pdf", number, {}, 0j, code, b"")

    stack = [page(3, "A"), page(2, "A"), page(2, "B"), page(3, ""), page(2, "A"), page(3, "A")]

    assert [[one.number for one in of] for of in together(stack)] == [[3, 2], [2, 3], [2, 3]]


def test_corners_that_lie_badly_are_told() -> None:
    places = stands(sheet_for(TASK, only=PLANS).pages[1])
    seen = {place.number: tuple(1000 + 10 * z.conjugate() for z in place.corners) for place in places}
    moved = {**seen, places[0].number: tuple(z + 60 for z in seen[places[0].number])}

    assert straightened(seen, places, 1000 - 1000j).error < 0.01
    assert straightened(moved, places, 1000 - 1000j).error > 0.3


def test_a_marker_that_is_drawn_over_does_not_spoil_its_page() -> None:
    places, centre = stands(sheet_for(TASK, only=PLANS).pages[1]), 1000 - 1000j
    seen = {place.number: tuple(1000 + 10 * z.conjugate() for z in place.corners) for place in places}
    moved = {**seen, places[2].number: tuple(z + 30 for z in seen[places[2].number])}

    kept = without_worst(moved, places, centre)

    assert straightened(moved, places, centre).error > ASTRAY
    assert {*seen} - {*kept} == {places[2].number}
    assert straightened(kept, places, centre).error < 0.01


def test_the_frame_holds_a_page_flat_where_no_markers_are() -> None:
    sheet, random = sheet_for(TASK, only=PLANS), np.random.default_rng(1)
    grey, page = printed(sheet, 1), sheet.pages[1]
    upper = [place for place in stands(page) if place.at.imag > 100]
    shake = lambda: complex(*random.normal(0, 1.0, 2))  # noqa: E731
    seen = {one.number: tuple(PX * (z.conjugate() + 1j * page.height) + shake() for z in one.corners) for one in upper}
    foot = np.array([30 + 10j, 100 + 10j, 180 + 10j])
    centre = PX * complex(page.width, page.height) / 2
    area = drawing_area(drawing_for_print(sheet.case).sheets[1], "gost")

    markers = straightened(seen, upper, centre)
    both = straightened(seen, upper, centre, framed(grey, markers, area))

    off = [np.abs(way.at(foot) / PX - foot.conj() - 1j * page.height).max() for way in (markers, both)]
    assert off[1] < 0.2
    assert off[0] > 2 * off[1]


@pytest.mark.soak
def test_photographs_of_two_linkages_at_all_qualities() -> None:
    whole = Figures()
    for _, _, figures in measured(linkages(), 6):
        whole.add(figures)

    assert whole.pages >= 12
    assert whole.found_pages >= 0.98 * whole.pages
    assert whole.read >= 0.8 * whole.vectors
    assert whole.wrong <= 0.02 * whole.read
    assert np.percentile(whole.misses, 95) <= 0.8


def pencil_of(ends: list[tuple[complex, complex]], arrows: list[tuple[complex, complex]]) -> Pencil:
    """A page of 120 x 60 mm with lines, and arrowheads at the tips of others."""
    dark = np.zeros((60 * PER_MM, 120 * PER_MM), np.uint8)
    wings = [
        (b, b + min(3.2, abs(b - a) / 3) * np.exp(1j * turn) * (a - b) / abs(b - a))
        for a, b in arrows
        for turn in (0.27, -0.27)
    ]
    for line in (*ends, *wings):
        at = [round(part * PER_MM * 16 - 8) for z in line for part in (z.real, 60 - z.imag)]
        cv2.line(dark, (at[0], at[1]), (at[2], at[3]), 150, 4, cv2.LINE_AA, 4)
    return Pencil(cv2.GaussianBlur(dark, (0, 0), 1.5))


def plan_of(places: list[complex], *edges: tuple[int, int]) -> Shape:
    tails, tips = np.array(edges).T
    names = tuple(f"v{number}" for number in range(len(edges)))
    return Shape("plan", names, np.array(places, complex), names, tails, tips, np.arange(len(edges)))


def test_a_point_between_lines_in_one_direction_is_where_its_arrowhead_is() -> None:
    pole, drawn_at, end = 20 + 20j, 52.4 + 20j, 90.3 + 20j
    pencil = pencil_of([(pole, end)], [(pole, drawn_at), (drawn_at, end)])
    way = plan_of([0j, 31.5 + 0j, 70 + 0j], (0, 1), (1, 2))  # where they should be

    points, errors, found = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert {*found} == {0, 1}
    assert abs(points - [pole, drawn_at, end]).max() < 0.3
    assert errors.max() < 0.5


def test_an_arrowhead_alone_tells_nothing_far_from_where_it_should_be() -> None:
    pole, drawn_at, end = 20 + 20j, 53.5 + 20j, 90.3 + 20j  # it may be a letter, and no crossing says which
    pencil = pencil_of([(pole, end)], [(pole, drawn_at), (drawn_at, end)])
    way = plan_of([0j, 31.5 + 0j, 70 + 0j], (0, 1), (1, 2))

    _, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert errors[1] > 5.0


def test_a_flat_bend_is_where_its_arrowhead_is_not_where_lines_part() -> None:
    pole, bend = 20 + 20j, 60 + 20j
    end = bend + cmath.rect(40.0, -math.radians(7.0))
    pencil = pencil_of([(pole, bend), (bend, end)], [(pole, bend), (bend, end)])
    way = plan_of([0j, 39.2 + 0j, end - pole], (0, 1), (1, 2))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - bend) < 0.4
    assert errors[1] < 0.5


def test_a_line_ends_before_a_letter_that_stands_in_its_direction() -> None:
    pole, end = 20 + 20j, 90 + 20j
    way = plan_of([0j, 70 + 0j], (0, 1))
    pencil = pencil_of([(pole, end), (end + 1.3, end + 3.3)], [(pole, end)])

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - end) < 0.3
    assert errors[1] < 0.5


@pytest.mark.parametrize(
    ("end", "stop"),
    [
        pytest.param(90, 92.4, id="a letter touches it beyond its arrowhead"),
        pytest.param(91.9, 91.9, id="end and arrowhead are both far from where they should be"),
    ],
)
def test_an_end_is_where_its_arrowhead_is(end: float, stop: float) -> None:
    pole = 20 + 20j
    pencil, way = pencil_of([(pole, stop + 20j)], [(pole, end + 20j)]), plan_of([0j, 70 + 0j], (0, 1))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - end - 20j) < 0.3
    assert errors[1] < 0.5


@pytest.mark.parametrize("both", [True, False])
def test_a_small_arrowhead_tells_where_a_line_goes_on(both: bool) -> None:
    pole, head, end = 20 + 20j, 27.6 + 20j, 60 + 20j
    beside = [] if both else [(head - 2.3 - 0.8j, head - 0.3j)]  # a letter
    pencil = pencil_of([(pole, end), *beside], [(pole, head), (head, end)] if both else [(head, end)])
    way = plan_of([0j, 7 + 0j, 40 + 0j], (0, 1), (1, 2))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert not both or abs(points[1] - head) < 0.4
    assert bool(errors[1] < 0.5) is both


def test_an_arrowhead_that_is_filled_does_not_point_beyond_where_its_line_ends() -> None:
    pole, reach, off = 60 + 30j, 24.0, list[float]()
    for number in range(12):
        unit = cmath.rect(1.0, 0.1 + number * math.tau / 12)
        paper, head = (
            Paper(np.full((60 * 12, 120 * 12), 255, np.uint8), np.random.default_rng(number)),
            pole + reach * unit,
        )
        paper.stroke(pole, head, 0.7, 0.4)
        for end, turn in product((head, head + 0.6j * unit), (0.26, -0.26)):  # those of two vectors
            paper.stroke(end, end - 3.5 * unit * np.exp(1j * turn), 0.7, 0.5, 0.02)
        paper.stroke(head, head + 5 * cmath.exp(1.4j) * unit, 0.7, 0.4)
        small = cv2.resize(paper.ink, (120 * PER_MM, 60 * PER_MM), interpolation=cv2.INTER_AREA)
        pencil = Pencil((cv2.GaussianBlur(small, (0, 0), 1.0) * 254).astype(np.uint8))
        points, errors, _ = traced(
            pencil, plan_of([0j, reach * unit], (0, 1)), np.array([pole, head]), np.array([pole, head]), pole
        )
        off += [((points[1] - head) / unit).real] * bool(errors[1] <= SURE)

    assert len(off) == 12  # only half of them were told
    assert np.median(np.abs(off)) < 0.15
    assert np.abs(off).max() < 0.5


def test_an_arrowhead_whose_wings_letters_touch_is_found() -> None:
    pole, head, end = 20 + 20j, 52 + 20j, 90.3 + 20j
    letters = [(head - 3 + 1.1j * side, head + 1 + 1.1j * side) for side in (1, -1)]
    pencil = pencil_of([(pole, end), *letters], [(pole, head), (head, end)])
    way = plan_of([0j, 31.5 + 0j, 70 + 0j], (0, 1), (1, 2))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - head) < 0.3
    assert errors[1] < 0.5


def test_an_arrowhead_of_a_short_vector_is_found_before_a_letter() -> None:
    pole, head, end = 20 + 20j, 27.6 + 20j, 60 + 20j
    letter = [(head + 0.3 + 0.7j * side, head + 1.2 + 0.7j * side) for side in (1, -1)]
    pencil = pencil_of([(pole, end), *letter], [(pole, head), (head, end)])
    way = plan_of([0j, 7 + 0j, 40 + 0j], (0, 1), (1, 2))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - head) < 0.4
    assert errors[1] < 0.5


@pytest.mark.parametrize("clean", [True, False])
def test_an_end_beside_which_nothing_is_drawn_is_no_letter(clean: bool) -> None:
    pole, bend, end = 20 + 10j, 60 + 10j, 60 + 41.4j
    pencil = pencil_of([(pole, bend), (bend, end), *([] if clean else [(end - 0.8j, end + 1 - 0.4j)])], [])
    way = plan_of([0j, 40 + 0j, 40 + 30j], (0, 1), (2, 1))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert not clean or abs(points[2] - end) < 0.2
    assert bool(errors[2] < 0.5) is clean


def test_the_stem_of_a_letter_is_not_an_end_beside_where_a_short_vector_has_it() -> None:
    pole, a, b, end = 20 + 10j, 60 + 10j, 60 + 40j, 58 + 40j
    stem, letter = end + 1.2j, [(end + 1.2j, end - 1 + 1.1j), (end - 1 + 1.1j, end - 1 + 0.5j)]
    foot = 58 + 10j
    pencil = pencil_of([(pole, a), (a, b), (b, pole), (foot, stem), *letter], [])
    way = plan_of([0j, 40 + 0j, 40 + 30j, 38 + 30j, 38 + 0j], (0, 1), (1, 2), (2, 0), (3, 2), (3, 4), (4, 1))

    points, _, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[3] - end) < 0.5


@pytest.mark.parametrize(("short", "told"), [(4.0, True), (8.0, False)])
def test_where_a_short_vector_goes_on_in_line_a_longer_one_begins(short: float, told: bool) -> None:
    pole, a, end = 20 + 10j, 60 + 10j, 60 + (40 + short) * 1j
    pencil = pencil_of([(pole, a), (a, end), (end, pole)], [])
    way = plan_of([0j, 40 + 0j, 40 + 30j, 40 + (30 + short) * 1j], (0, 1), (1, 2), (2, 3), (3, 0))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert (errors[2] < SURE) == told
    assert abs(points[2] - (a + 30j)) < 0.5


@pytest.mark.parametrize("longer", [0.0, 2.5])
def test_what_only_a_short_vector_tells_is_not_sure_where_its_line_ends_elsewhere(longer: float) -> None:
    pole, a, end = 20 + 10j, 60 + 10j, 60 + (54 + longer) * 1j
    pencil = pencil_of([(pole, a), (a, end), (end, end - 4j), (a + 40j, pole)], [])
    way = plan_of([0j, 40 + 0j, 40 + 44j, 40 + 40j], (0, 1), (1, 2), (2, 3), (3, 0))

    _, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert bool(errors[2] < SURE) is (longer == 0.0)
    assert errors[3] < SURE


def test_one_point_that_is_taken_for_another_makes_no_plan_larger() -> None:
    places = np.array([10 + 5j, 60 + 0j, 58 + 2j, 95 - 20j])

    assert abs(_times(places, places + np.array([0.1, 4.0, -0.1j, 0.1])) - 1.0) < 0.003


def test_an_end_and_an_arrowhead_that_differ_tell_nothing() -> None:
    pole, end = 20 + 20j, 90 + 20j
    way = plan_of([0j, 70 + 0j], (0, 1))
    pencil = pencil_of([(pole, end)], [(pole, end - 1.5)])  # as where a letter touches one of them

    _, errors, found = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert {*found} == {0}
    assert errors[1] > 5.0


@pytest.mark.parametrize(("end", "head", "sure"), [(62, 62, False), (60, 60, True), (80, 60, True), (80, 80, True)])
def test_a_crossing_is_not_sure_where_its_line_ends_in_an_arrowhead_beside_it(end: int, head: int, sure: bool) -> None:
    pole, a, b = 20 + 20j, 60 + 20j, 60 + 45j
    way = plan_of([0j, 40 + 0j, 40 + 25j], (0, 1), (1, 2))
    pencil = pencil_of([(pole, end + 20j), (a, b)], [(pole, head + 20j), (a, b)])

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points[1] - a) < 0.3
    assert bool(errors[1] < 0.5) is sure


A, B, C = 20 + 20j, 80 + 20j, 60 + 45j
NEARLY = B + 4j  # beside B, as a reaction and its normal part end
ASLANT = B + 40 * np.exp(1j * np.radians(162))  # from there a line hides a wing of the arrowhead at B
ACROSS, LOOKS = B - (ASLANT - B) / 2, A + 30 * np.exp(1j * np.radians(16))  # where it goes on; a wing at A, it seems


@pytest.mark.parametrize(
    ("edges", "arrows", "told"),
    [
        pytest.param([(0, 1), (1, 2)], [(A, B), (B, C)], {0: 1, 1: 1}, id="as they should"),
        pytest.param([(0, 1), (1, 2)], [(B, A), (B, C)], {0: -1, 1: 1}, id="one the other way round"),
        pytest.param([(0, 1), (1, 2)], [(B, C)], {1: 1}, id="none"),
        pytest.param([(0, 1), (1, 2)], [(A, B), (B, A), (B, C)], {1: 1}, id="at both ends"),
        pytest.param([(0, 1), (1, 0)], [(B, A)], {}, id="a vector both ways"),
        pytest.param([(0, 1), (0, 3)], [(B, A), (A, NEARLY)], {0: 0}, id="of lines nearly in one direction"),
        pytest.param([(0, 1), (3, 0)], [(B, A), (NEARLY, A)], {0: 0}, id="of which the other has its own there"),
        pytest.param([(0, 1), (4, 1)], [(B, A), (ASLANT, B)], {0: 0}, id="of which the other has its own at the tip"),
        pytest.param([(0, 1), (4, 1)], [(A, B), (ASLANT, B), (B, A)], {0: 0}, id="a hidden wing is not a bare one"),
        pytest.param([(0, 1), (5, 4), (0, 6)], [(A, B)], {}, id="nor is it where a line hides it from most sides"),
    ],
)
def test_arrowheads_tell_which_way_a_vector_goes(
    edges: list[tuple[int, int]], arrows: list[tuple[complex, complex]], told: dict[int, int]
) -> None:
    points = np.array([A, B, C, NEARLY, ASLANT, ACROSS, LOOKS])
    pencil, way = pencil_of([(points[a], points[b]) for a, b in edges], arrows), plan_of([*(points - A)], *edges)
    way = replace(way, lines=way.lines[: 1 if edges[1] == (1, 0) else 2])
    _, _, found = traced(pencil, way, points, points, A)

    said = senses(pencil, way, points, found)

    assert {n: said[n] for n in said if n in told or said[n] != 1} == told


@pytest.mark.parametrize("reverse", [False, True])
def test_a_wing_that_a_line_hides_from_most_sides_is_not_a_bare_one(reverse: bool) -> None:
    tip, letter = B - 10, [(A, A + 3.3 * np.exp(1j * np.radians(turn))) for turn in (15, -25)]
    points = np.array([A, tip, tip + 40 * np.exp(1j * np.radians(164))])
    pencil = pencil_of([(A, tip), (points[2], tip), *letter], [(tip, A) if reverse else (A, tip)])
    way = plan_of([*(points - A)], (0, 1), (1, 2))
    _, _, found = traced(pencil, way, points, points, A)

    said = senses(pencil, way, points, found)

    assert said.get(0) == (-1 if reverse else None)


def test_a_vector_that_is_longer_than_it_should_be_ends_where_its_arrowhead_is() -> None:
    pole, end, right = 20 + 20j, 90 + 20j, 60 + 20j
    longer, doubtful = pencil_of([(pole, end)], [(pole, end)]), pencil_of([(pole, end)], [(pole, end), (pole, right)])

    assert ends_at(longer, pole, end, right)
    assert not ends_at(longer, pole, right, end)
    assert not ends_at(doubtful, pole, end, right)
    assert not ends_at(longer, pole, end, pole + 5)  # too short for an arrowhead


def test_a_point_that_nothing_tells_is_not_taken_from_where_it_should_be() -> None:
    pole, end = 20 + 20j, 90 + 20j
    pencil = pencil_of([(pole, end)], [(pole, end)])
    way = plan_of([0j, 31.5 + 0j, 70 + 0j, 31.5 + 30j], (0, 1), (1, 2), (1, 3))

    _, errors, found = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert {*found} == {0, 1}  # a line that is not drawn is not found
    assert errors[1] > 5.0
    assert errors[3] > 5.0


def test_lines_are_read_as_they_are_drawn_not_as_they_should_be() -> None:
    pole, a, b = 20 + 15j, 60.7 + 15.5j, 70.2 + 40.9j
    pencil = pencil_of([(pole, a), (a, b), (pole, b)], [(pole, a)])
    way = plan_of([0j, 40 + 0j, 50 + 25j], (0, 1), (1, 2), (0, 2))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points - [pole, a, b]).max() < 0.15
    assert errors.max() < 0.3


def test_the_darker_line_of_a_neighbour_is_not_taken() -> None:
    pole, end, beside, other = 20 + 20j, 90 + 20j, 88 + 21.1j, 88 + 45j
    dark = pencil_of([(pole, end)], [(pole, end)]).dark
    pale = pencil_of([(pole, beside), (other, beside)], [(pole, beside)]).dark * 0.75
    way = plan_of([0j, end - pole, beside - pole, other - pole], (0, 1), (0, 2), (3, 2))

    points, errors, _ = traced(
        Pencil(np.maximum(dark, pale.astype(np.uint8))), way, pole + way.places, pole + way.places, pole
    )

    assert abs(points[1:3] - [end, beside]).max() < 0.3
    assert errors[1:3].max() < 0.5


def test_an_end_where_it_should_be_tells_of_lines_nearly_in_one_direction() -> None:
    pole, end = 90 + 20j, 30 + 20j
    beside = end - 1.7j
    pencil = pencil_of([(pole, end), (end, beside), (beside, pole)], [(pole, end), (beside, pole)])
    way = plan_of([0j, end - pole, beside - pole], (0, 1), (1, 2), (2, 0))

    points, errors, _ = traced(pencil, way, pole + way.places, pole + way.places, pole)

    assert abs(points - [pole, end, beside]).max() < 0.4
    assert errors.max() < 0.5


def test_a_sheet_printed_smaller_is_noticed() -> None:
    sheet = sheet_for(TASK, only=PLANS)
    number, pole = sheet.poles["velocity"]
    (way,) = sheet.ways("velocity", False)
    for times in (1.0, 1.03):  # the student's ruler is as it was
        ends = [pole + times * way.places[at] / sheet.mus["velocity"] for at in (way.tails, way.tips)]
        poles = {"velocity": (number, pole)}
        found = matched({number: lines_of(*ends)}, poles, sheet.mus, sheet.keyed)
        printed_so = SimpleNamespace(blank=SimpleNamespace(mus=sheet.mus))

        assert _print_scale(printed_so, sheet.keyed, found) == pytest.approx(times, abs=0.003)


def test_one_plan_that_a_mistake_makes_larger_is_no_smaller_print() -> None:
    sheet = sheet_for(TASK, only=PLANS)
    mu, vectors = sheet.mus["velocity"], dict[str, Found]()
    for name, times in (("V_A", 1.0), ("V_BA", 1.03), ("V_B", 1.03), ("V_S2", 1.03)):
        vectors[name] = Found(0j, complex(sheet.keyed.key[name]) / mu * times, "velocity", 1.0)
    found = Recognised({"velocity": FoundPlan(mu / 1.03, 0.0, 0j, 1.0)}, vectors, ())

    assert _print_scale(SimpleNamespace(blank=SimpleNamespace(mus=sheet.mus)), sheet.keyed, found) == 1.0


def test_larger_forces_that_follow_from_a_mistake_are_no_smaller_print() -> None:
    sheet = sheet_for(TASK, only=PLANS)
    mu = sheet.mus["velocity"]
    vectors = {
        name: Found(0j, complex(sheet.keyed.key[name]) / mu * 1.03, "velocity", 1.0)
        for name in ("V_A", "V_BA", "V_B", "V_S2")
    }
    larger, printed_so = (
        FoundPlan(mu / 1.03, 0.0, 0j, 1.0),
        SimpleNamespace(blank=SimpleNamespace(mus={**sheet.mus, "other": 2.0})),
    )
    # a plan with a mistake is all there, as large as it should be: the ruler is as the sheet
    for wrong, times in ((2.0, 1.0), (2.0 / 1.03, 1.03)):
        plans = {"velocity": larger, "other": FoundPlan(wrong, 0.0, 0j, 1.0, "M26")}
        found = Recognised(plans, vectors, ())

        assert _print_scale(printed_so, sheet.keyed, found) == pytest.approx(times, abs=0.003)


@pytest.mark.parametrize(
    ("right", "larger", "whole", "chosen"),
    [
        ((0.93, 47.0), (0.84, 117.0), (1.0, 48.0), 2),  # all of a smaller plan goes before a part of a larger one
        ((0.93, 140.0), (0.93, 146.0), (0.99, 123.0), 2),  # also where more of the right one is there
        ((0.93, 140.0), (0.96, 150.0), (1.0, 20.0), 1),  # not where that is hardly anything
        ((0.93, 140.0), (0.94, 143.0), (0.9, 141.0), 0),  # a part of a wrong plan must be clearly more
        ((0.98, 140.0), (1.0, 170.0), (1.0, 160.0), 0),
    ],
)
def test_a_plan_that_is_all_there_goes_before_one_of_which_a_part_is(
    right: tuple[float, float],
    larger: tuple[float, float],
    whole: tuple[float, float],
    chosen: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sheet = sheet_for(TASK, only=PLANS)
    ways = shapes_of(sheet.keyed.key, sheet.keyed.book, "velocity")[:3]
    worth = {way.places.tobytes(): one for way, one in zip(ways, (right, larger, whole), strict=True)}

    def laid(lines: Any, pole: complex, mu: float, way: Shape) -> Any:
        quality, mm = worth.get(way.places.tobytes(), (0.0, 0.0))
        return matching._Fit(way, way.places, np.zeros(len(way.places)), 1.0, quality, mm, 0.0, frozenset())

    monkeypatch.setattr(matching, "_laid", laid)
    monkeypatch.setattr(matching, "_traced", lambda lines, fit, pole, mu: fit)
    found = matching._best(lines_of(np.zeros(1, complex), np.full(1, 9.0 + 0j)), 0j, 1.0, "velocity", sheet.keyed)

    assert found is not None
    assert found.way.places.tobytes() == ways[chosen].places.tobytes()


def test_one_mark_that_lies_far_off_moves_what_is_fitted_to_the_others_hardly_at_all() -> None:
    at = np.arange(12.0)
    seen = 2.0 + 3.0 * at
    seen[4] += 500.0  # a mark that something else was taken for
    held, begun = np.zeros(8), np.array([0.5, 1.0, *np.zeros(6)])

    def missed(values: np.ndarray) -> np.ndarray:
        return values[0] + values[1] * at - seen + 0.0 * values[2:].sum()

    found = _fitted(begun, [missed], held)

    assert found[:2] == pytest.approx([2.0, 3.0], abs=0.02)
    assert np.polyfit(at, seen, 1)[1] > 50.0  # where every miss counts alike, the line is carried off
    assert _fitted(begun, [missed], np.full(8, 1e6))[:2] == pytest.approx(begun[:2], abs=1e-3)  # what is held stays
