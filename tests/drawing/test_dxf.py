"""DXF read back in mm: vectors with their values, letters, blocks, fields of title blocks; outlines to cut."""

import math
import sys
from collections import Counter
from collections.abc import Iterator
from io import BytesIO, StringIO
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing
from ezdxf.entitydb import EntityDB
from lxml import etree
from shapely import LinearRing, Point

import kulman
from kulman.drawing.dxf import APP, FITTED, LACKING, STYLE
from kulman.drawing.page import Page
from kulman.drawing.shapes import Arc, Circle, Group, Text, Vector
from kulman.drawing.text import lay_out, lettered
from kulman.drawing.writers import WRITERS
from kulman.scales.errors import InputError
from kulman.tests.support.cases import some
from kulman.variants.sheets import Sheet
from kulman.variants.shelf import bundled

FEW = ("nau-slider-crank",)
EVERY = [pytest.param(task, marks=() if task in FEW else pytest.mark.soak) for task in bundled()]
MICRON = 0.001  # mm


def dxf(page: Page) -> Drawing:
    stream = BytesIO()
    WRITERS[".dxf"]([page], stream)
    return ezdxf.read(StringIO(stream.getvalue().decode("utf-8")))


def shapes(page: Page, kind: type) -> Iterator[object]:
    todo = list(page.shapes)
    while todo:
        shape = todo.pop()
        todo += shape.shapes if isinstance(shape, Group) else ()
        if isinstance(shape, kind):
            yield shape


def entities(document: Drawing, kind: str) -> list:
    blocks = [block for block in document.blocks if not block.name.startswith("*")]
    return [part for space in (document.modelspace(), *blocks) for part in space if part.dxftype() == kind]


def letters(page: Page) -> Counter:
    """Return how many of each character are written on a page; what no font of CAD has is drawn."""
    with lettered(page.lettering, page.language):
        runs = [run.string for text in shapes(page, Text) for run in lay_out(text.markup, text.height).runs]
    return Counter(letter for run in runs for letter in run if letter not in LACKING + " ")


@pytest.mark.parametrize("task", EVERY)
def test_a_sheet_is_sound_and_its_vectors_and_letters_are_read_back(task: str) -> None:
    for page in kulman.sheet(task).pages:
        document = dxf(page)
        audit = document.audit()
        assert (audit.errors, audit.fixes) == ([], [])
        vectors = [vector for vector in shapes(page, Vector) if abs(vector.tip - vector.tail) > MICRON]
        lines = [line for line in entities(document, "LINE") if line.has_xdata(APP) and len(line.get_xdata(APP)) == 4]
        assert len(lines) == len(vectors)
        for line in lines:
            (_, quantity), (_, value), (_, unit), (_, mu) = line.get_xdata(APP)
            assert any((quantity, value, unit) == (one.quantity, one.value, one.unit) for one in vectors)
            assert line.dxf.start.distance(line.dxf.end) == pytest.approx(value / mu, abs=MICRON)
        written = Counter(letter for text in entities(document, "TEXT") for letter in text.dxf.text if letter != " ")
        assert written == letters(page)
        assert {text.dxf.style for text in entities(document, "TEXT")} == {STYLE}
        colours = {hatch.dxf.true_color for hatch in entities(document, "HATCH") if hatch.dxf.hasattr("true_color")}
        assert 0xFFFFFF not in colours  # LibreCAD prints white itself as black


def test_letters_stand_where_they_do_on_paper_and_keep_their_width() -> None:
    text = Text(60 + 100j, "План → 100 % і V_{B}", 5.0, "middle")
    runs = lay_out(text.markup, 5.0).runs
    document = dxf(Page(210, 297, (text,), "x", "uk"))
    found = {entity.dxf.text: entity for entity in entities(document, "TEXT")}
    assert list(found) == ["План", "100 % і", "V", "B"]
    start, end = (found["План"].dxf.insert.x, found["План"].dxf.align_point.x)
    assert start == pytest.approx(60 - lay_out(text.markup, 5.0).width / 2 + runs[0].x)
    assert found["План"].dxf.height == pytest.approx(5.0)
    assert 10 < end - start < runs[0].width
    assert [len(name) < FITTED for name in found] == [entity.dxf.halign != 5 for entity in found.values()]
    assert found["V"].dxf.oblique == 15.0  # a symbol leans
    assert len(entities(document, "LWPOLYLINE")) == 2  # the arrow, which the font lacks: shaft and barbs


def test_layers_patterns_and_blocks_are_named() -> None:
    document = dxf(kulman.sheet("nau-slider-crank").pages[0])
    assert {layer.dxf.name for layer in document.layers} >= {
        "frame",
        "given",
        "construction",
        "result",
        "labels",
        "key",
    }
    assert document.layers.get("key").is_off()
    inserted = Counter(insert.dxf.name.rsplit("_", 1)[0] for insert in entities(document, "INSERT"))
    assert inserted["PAIR"] > len([block for block in document.blocks if block.name.startswith("PAIR")]) >= 1
    assert {line.dxf.linetype for line in entities(document, "LINE")} == {"BYLAYER", "KULMAN_AXIS"}
    assert {line.dxf.lineweight for line in entities(document, "LINE")} == {30, 80}


@pytest.mark.parametrize("fill", [False, True, "white"])
def test_circles_and_arcs_are_read_back(fill: bool | str) -> None:
    rng = np.random.default_rng(8)
    round_ones = [Circle(complex(*rng.uniform(20.0, 180.0, 2)), rng.uniform(1.0, 20.0), fill=fill) for _ in range(9)]
    turns = [(rng.uniform(-7.0, 7.0), rng.uniform(-6.0, 6.0)) for _ in range(9)] + [(0.3, math.tau), (0.3, -math.tau)]
    arcs = [Arc(complex(*rng.uniform(20.0, 180.0, 2)), rng.uniform(1.0, 20.0), *turn) for turn in turns]
    document = dxf(Page(210, 297, (*round_ones, *arcs), "x", "uk"))

    found = [(*entity.dxf.center.vec2, entity.dxf.radius) for entity in entities(document, "CIRCLE")]
    whole = [*round_ones, *(arc for arc in arcs if abs(arc.sweep) >= math.tau)]
    parts = [arc for arc in arcs if arc not in whole]
    right = sorted((one.centre.real, one.centre.imag, one.radius) for one in whole)
    assert np.array(sorted(found)) == pytest.approx(np.array(right))
    for entity, arc in zip(entities(document, "ARC"), parts, strict=True):
        assert (*entity.dxf.center.vec2, entity.dxf.radius) == pytest.approx(
            (arc.centre.real, arc.centre.imag, arc.radius)
        )
        ends = {arc.start, arc.start + arc.sweep}
        assert [math.cos(math.radians(entity.dxf.start_angle) - min(ends))] == pytest.approx([1.0])
        assert [math.cos(math.radians(entity.dxf.end_angle) - max(ends))] == pytest.approx([1.0])


@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_fields_of_the_title_block_are_attributes_blank_ones_too(norm: str) -> None:
    sheet = kulman.sheet("nau-slider-crank", norm=norm, student="Коваль І. П.", only="velocity", format="A1")
    (block,) = [insert for insert in entities(dxf(sheet.pages[0]), "INSERT") if len(insert.attribs) > 3]
    fields = {field.dxf.tag: field for field in block.attribs}
    student, teacher = ("STUDENT", "TEACHER") if norm == "gost" else ("CREATOR", "APPROVER")
    assert (fields[student].dxf.text, fields[student].is_invisible) == ("Коваль І. П.", True)
    assert (fields[teacher].dxf.text, fields[teacher].is_invisible) == ("", False)
    assert fields[teacher].dxf.insert.y < fields[student].dxf.insert.y
    aligned = {field.get_align_enum().name for field in fields.values()}
    assert fields[student].get_align_enum().name == "LEFT"
    assert aligned == ({"LEFT", "CENTER"} if norm == "gost" else {"LEFT"})
    width, height = sheet.pages[0].width, sheet.pages[0].height
    assert all(
        width / 2 < field.dxf.insert.x < width and 5 < field.dxf.insert.y < height / 4 for field in block.attribs
    )


def test_letters_as_lines_need_no_font() -> None:
    sheet = kulman.sheet("nau-slider-crank", only="velocity", lettering="strokes")
    document = dxf(sheet.pages[0])
    assert not entities(document, "TEXT")
    assert len(entities(document, "LWPOLYLINE")) > 800
    root = etree.fromstring(sheet.svg().encode())
    assert not root.findall(".//{*}text")
    assert "font-face" not in sheet.svg()


def test_bytes_do_not_hang_on_the_order_of_a_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet, found, kinds = kulman.sheet("nau-slider-crank", only="velocity"), set[bytes](), EntityDB.dxf_types_in_use
    for down in (False, True):
        monkeypatch.setattr(EntityDB, "dxf_types_in_use", lambda own, down=down: sorted(kinds(own), reverse=down))
        (file,) = sheet.save(tmp_path / f"{down}.dxf")
        found.add(file.read_bytes())
    assert len(found) == 1


def test_a_file_is_the_same_again_and_needs_its_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet: Sheet = kulman.sheet("nau-slider-crank", only="velocity")
    (first,), (second,) = sheet.save(tmp_path / "a.dxf"), sheet.save(tmp_path / "b.dxf")
    assert first.read_bytes() == second.read_bytes()
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(InputError, match="ezdxf"):
        sheet.save(tmp_path / "c.dxf")
    assert not (tmp_path / "c.dxf").exists()


def outlines(task: str, folder: Path, **given: object) -> dict[str, np.ndarray]:
    kulman.sweep(task, **given).save(folder / "cut.dxf")
    document = ezdxf.readfile(folder / "cut.dxf")
    assert not document.audit().errors
    lines = list(document.modelspace())
    assert all(line.closed and not any(bulge for *_, bulge in line.get_points()) for line in lines)
    return {line.dxf.layer: np.array([complex(x, y) for x, y in line.get_points("xy")]) for line in lines}


@pytest.mark.parametrize("task", some([*bundled("cam"), *bundled("gear")], 0))
def test_outlines_are_closed_simple_and_within_a_micron_of_the_profile(task: str, tmp_path: Path) -> None:
    swept, found = kulman.sweep(task), outlines(task, tmp_path)
    solved = swept.course.solved
    if swept.task.kind == "cam":
        turn = np.linspace(0.0, 2 * np.pi, 1999)
        true = {
            f"profile_{follower}": [complex(point) for side in (1, -1) for point in profile.practical(turn, side)]
            for _, follower, profile in solved.profiles
            if not profile.undercuts
        }
    else:
        flanks = {i: tooth.outline(97) for i, tooth in enumerate(solved.meshing.teeth, start=1)}
        true = {f"wheel_{i}": [*flank] for i, flank in flanks.items()}
    assert set(true) <= set(found)
    assert found
    for name, points in found.items():
        ring = LinearRing([(point.real, point.imag) for point in points])
        assert ring.is_simple
        if name in true:
            where = 1000 * np.array(true[name])
            where += np.max(points.real) - np.max(where.real) if np.min(points.real) > 0 else 0  # beside another
            assert max(ring.distance(Point(point.real, point.imag)) for point in where) < MICRON
