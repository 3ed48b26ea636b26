"""Layers: each thing in one of them, the same in SVG and PDF; a blank without answers, a key that lies on it."""

import re
from collections import Counter
from dataclasses import replace
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import shapely
from lxml import etree
from numpy.typing import NDArray
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfpage import PDFPage
from pdfminer.pdfparser import PDFParser
from pdfminer.pdftypes import resolve1
from pdfminer.utils import decode_text
from pypdfium2 import PdfDocument

from kulman import handout, sheet
from kulman.drawing.formats import FORMATS, drawing_area, printable, reserved_boxes
from kulman.drawing.page import Layer, Page, parts_of
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.pdf import write_tiles
from kulman.drawing.shapes import Group, Line
from kulman.drawing.svg import svg_text
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.commands import Run
from kulman.tests.support.readback import SVG
from kulman.tests.support.shapes import leaves, line_of
from kulman.variants.sheets import Sheet

INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
DRAWN = {f"{SVG}{kind}" for kind in ("line", "polyline", "polygon", "circle", "path", "text")}
TASK, OTHERS = "nau-slider-crank", ("bertyaev-six-bar", "karpenko-hoist", "madi-cam", "madi-gear")
TASKS = (TASK, *(pytest.param(task, marks=pytest.mark.soak) for task in OTHERS))
PLANS = "position,velocity"
DPI = 60


@cache
def printed(task: str = TASK, **how: object) -> Sheet:
    return handout(task, only=PLANS if task == TASK else None, format="A3", **how)  # type: ignore[arg-type]


def layers_of(page: Page) -> list[etree._Element]:
    return [child for child in etree.fromstring(svg_text(page).encode()) if child.get("class") == "layer"]


def names(page: Page) -> list[str]:
    return [layer.get("id").removeprefix("layer-") for layer in layers_of(page)]


def pdf(*pages: Page) -> bytes:
    stream = BytesIO()
    write_pdf(pages, stream)
    return stream.getvalue()


def picture(data: bytes) -> NDArray[np.uint8]:
    """Return all pages side by side."""
    document = PdfDocument(data)
    try:
        return np.hstack([np.asarray(page.render(scale=DPI / 72).to_pil().convert("L")) for page in document])
    finally:
        document.close()


def shown(data: bytes) -> bytes:
    """Switch every layer of a PDF on."""
    changed, count = re.subn(rb"/OFF \[ \d+ 0 R \]", lambda was: b"/OFF [".ljust(len(was[0]) - 1) + b"]", data)
    assert count == 1
    return changed


@pytest.mark.parametrize("task", TASKS)
def test_each_thing_is_in_one_layer(task: str) -> None:
    for page in printed(task, key=True).pages:
        parts = parts_of(page)

        assert Counter(leaves(shape for _, own in parts for shape in own)) == Counter(leaves(page.shapes))
        assert [layer for layer, _ in parts] == [layer for layer in Layer if layer in dict(parts)]
        assert Layer.KEY not in dict(parts)
        root = etree.fromstring(svg_text(page).encode())
        for element in root.iter(*DRAWN):
            assert sum(above.get("class") == "layer" for above in element.iterancestors()) == 1


@pytest.mark.parametrize("language", LANGUAGES)
def test_readers_name_the_layers_in_the_language_of_the_sheet(language: str) -> None:
    everything = (Group((Line(0j, 1j),), "view", str(k), layer=layer.value) for k, layer in enumerate(Layer))
    page = Page(100, 100, tuple(everything), "x", language, layers=True)
    titles = [layer.title(language) for layer in Layer]

    groups = layers_of(page)
    catalog = PDFDocument(PDFParser(BytesIO(pdf(page)))).catalog["OCProperties"]

    assert len(set(titles)) == len(Layer)
    assert names(page) == [layer.value for layer in Layer]
    assert [group.get(f"{INKSCAPE}label") for group in groups] == titles
    assert {group.get(f"{INKSCAPE}groupmode") for group in groups} == {"layer"}
    assert [group.get("display") for group in groups] == ["none" if layer is Layer.KEY else None for layer in Layer]
    assert [decode_text(resolve1(group)["Name"]) for group in catalog["D"]["Order"]] == titles
    assert [decode_text(resolve1(group)["Name"]) for group in catalog["D"]["OFF"]] == titles[-1:]
    assert [group.objid for group in catalog["OCGs"]] == [group.objid for group in catalog["D"]["Order"]]


def test_all_that_a_pdf_paints_is_in_a_layer_that_its_page_knows() -> None:
    pages, painting = printed(hidden_key=True).pages, re.compile(rb"\b(?:S|s|B|b|f|Tj)$", re.MULTILINE)
    document = PDFDocument(PDFParser(BytesIO(pdf(*pages))))
    groups = {group.objid for group in document.catalog["OCProperties"]["OCGs"]}

    for page, drawn in zip(PDFPage.create_pages(document), pages, strict=True):
        known = page.resources["Properties"]
        stream = b"\n".join(resolve1(content).get_data() for content in page.contents)
        runs = re.findall(rb"^/OC /(\w+) BDC$(.*?)^EMC$", stream, re.MULTILINE | re.DOTALL)
        assert [name.decode() for name, _ in runs] == names(drawn)
        assert set(known) == set(names(drawn))
        assert {reference.objid for reference in known.values()} <= groups
        assert all(painting.search(inside) and b" BDC" not in inside for _, inside in runs)
        assert len(painting.findall(stream)) == sum(len(painting.findall(inside)) for _, inside in runs)


@pytest.mark.parametrize("how", [{}, {"grid": True}, {"steps": 2}], ids=str)
def test_what_students_get_is_given_and_nothing_else(how: dict[str, object]) -> None:
    for page in printed(**how).pages:
        assert set(names(page)) == {"frame", "given"} | ({"grid"} if "grid" in how else set())
        assert b"layer-key" not in svg_text(page).encode()
    document = PDFDocument(PDFParser(BytesIO(pdf(*printed(**how).pages))))
    assert document.catalog["OCProperties"]["D"]["OFF"] == []


@pytest.mark.parametrize("task", TASKS)
def test_blank_and_hidden_key_are_the_key_to_the_last_bit(task: str) -> None:
    teacher, blank, key = (printed(task, **how) for how in ({"hidden_key": True}, {}, {"key": True}))
    for apart, empty, whole in zip(teacher.pages, blank.pages, key.pages, strict=True):
        answers = [shape for shape in apart.shapes if isinstance(shape, Group) and shape.layer == "key"]
        assert [shape for shape in apart.shapes if shape not in answers] == list(empty.shapes)
        together, alone = ([replace(shape, colour=None) for shape in leaves(p.shapes)] for p in (apart, whole))
        assert not Counter(alone) - Counter(together)
        # what is not of the key are lines of the blank, which break off at its letters only
        assert {*map(line_of, together)} == {*map(line_of, alone)}


def test_a_hidden_key_is_not_seen_until_it_is_switched_on_nor_on_tiles() -> None:
    for write in (write_pdf, write_tiles):
        written = []
        for drawn in (printed(), printed(hidden_key=True)):
            stream = BytesIO()
            write(drawn.pages, stream)
            written.append(stream.getvalue())
        blank, teacher = written
        assert np.array_equal(picture(teacher), picture(blank))
        assert not np.array_equal(picture(shown(teacher)), picture(blank))


@pytest.mark.parametrize("name", ["A4", "A3", "A1"])
def test_a_grid_has_squares_of_5_mm_that_keep_clear_of_the_title_block(name: str) -> None:
    page = handout(TASK, only="structure", format=name, grid=True).pages[0]
    paper = printable(FORMATS[name])
    x0, y0, x1, y1 = drawing_area(paper)

    (grid,) = (shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "grid")
    lines = [line for line in grid.shapes if isinstance(line, Line)]

    assert page.shapes[0] is grid
    assert {line.colour for line in lines} == {"#d9d9d9"}
    for along, start, end in ((1.0, x0, x1), (1j, y0, y1)):
        across = [line for line in lines if ((line.b - line.a) / along).real == 0.0]
        places = sorted({round((line.a / along).real - start, 6) for line in across})
        first = 5.0 if along == 1.0 or name != "A4" else 55.0  # there the title block is as wide as the frame
        assert places == [first + 5.0 * k for k in range(len(places))]
        assert 0.0 < end - start - places[-1] <= 5.0
    blocks = shapely.buffer(
        shapely.box(*np.array(reserved_boxes(paper)).T), -1e-6
    )  # files have a millionth of a millimetre
    for line in lines:
        middle = (line.a + line.b) / 2
        assert x0 < middle.real < x1
        assert y0 < middle.imag < y1
        drawn = shapely.LineString([(line.a.real, line.a.imag), (line.b.real, line.b.imag)])
        assert not shapely.intersects(blocks, drawn).any()


@pytest.mark.parametrize("clash", [["--hidden-key", "--key"], ["--hidden-key", "--over"], ["--grid", "--over"]])
def test_what_does_not_go_together_is_said_in_a_line(clash: list[str], tmp_path: Path, run: Run) -> None:
    words = [*clash, "velocity"] if "--over" in clash else clash
    status, out, err = run("handout", TASK, *words, "-o", tmp_path / "h.pdf")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert all(option in err for option in clash)
    assert list(tmp_path.iterdir()) == []


def test_layers_change_nothing_that_is_seen_and_on_a_sheet_each_view_is_one_group() -> None:
    """Where white covers lines, it covers them in layers too, but for lines that end in the circle of a node."""
    drawn = sheet(TASK, only="position,velocity,forces", format="A1")
    [page] = drawn.pages
    apart, whole = (picture(pdf(one)) for one in (replace(page, layers=True), page))
    root = etree.fromstring(svg_text(page).encode())
    groups = [child.get("data-name") for child in root if child.get("class") == "view"]
    assert np.mean(np.abs(apart.astype(int) - whole) > 32) < 2e-5
    assert sorted(groups) == sorted({*groups}) == sorted(view.name for view in drawn.views)
    assert names(page) == []
    assert "OCProperties" not in PDFDocument(PDFParser(BytesIO(pdf(page)))).catalog
