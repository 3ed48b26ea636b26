"""SVG, PDF, tiles: what is written is read back as it was drawn, the same bytes again, files whole or not at all."""

import math
import random
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from lxml import etree
from pdfminer.high_level import extract_pages, extract_text
from pdfminer.layout import LTChar, LTCurve, LTLine
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfpage import PDFPage
from pdfminer.pdfparser import PDFParser
from pdfminer.pdftypes import resolve1
from pypdfium2 import PdfDocument

from kulman.drawing import writers
from kulman.drawing.formats import FORMATS, pens_for
from kulman.drawing.page import Page, _reach, extent
from kulman.drawing.pdf import MARGIN, OVERLAP, _tiles, write_tiles
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from kulman.drawing.svg import svg_text
from kulman.drawing.text import lay_out
from kulman.drawing.writers import WRITERS, page_files, save_all
from kulman.scales.errors import InputError

SVG = "{http://www.w3.org/2000/svg}"
MM = 25.4 / 72
ONE_OF_EACH = (
    Line(20 + 5j, 205 + 292j),
    Line(30 + 50j, 130 + 50j, Pen.AXIS, role="guide", name="x"),
    Polyline((40 + 60j, 60 + 60j, 60 + 80j), Pen.THIN, closed=True, fill="white"),
    Circle(100 + 100j, 1.5, fill="white", role="point", name="A"),
    Arc(100 + 100j, 20, 0.25, 1.5, role="angle", name="phi", colour="#0072B2"),
    Head(120 + 100j, 1j),
    Vector(50 + 150j, 140.69740024 + 150j, "V_B", 4.534870012345678, "m/s", 0.05, title="V_B = 4,53 м/с <B>"),
    Arrow(30 + 30j, 40 + 30j, name="rotation"),
    Group((Text(60 + 200j, r"\bar{V}_{B} = 5 & 6", 3.5, name="V_B"),), "view", "velocity"),
    Text(60 + 220j, "Аркуш", 2.5, "middle", angle=0.5),
)
BAD: tuple[Callable[[float], Shape], ...] = (
    lambda bad: Line(0j, complex(bad, 1)),
    lambda bad: Circle(1 + 1j, bad),
    lambda bad: Text(complex(1, bad), "A"),
    lambda bad: Vector(0j, complex(bad, bad), "V", 1.0, "m/s", 1.0),
    lambda bad: Polyline((0j, complex(bad, 0))),
    lambda bad: Vector(0j, 1 + 1j, "V", bad, "m/s", 1.0),  # a PDF does not have its value
)


def write_pages(pages: Sequence[Page], *paths: str | Path, tile: str | None = None) -> list[Path]:
    return save_all(paths, WRITERS, lambda path: page_files(pages, path, tile))


def page(*shapes: Shape, size: tuple[float, float] = (210.0, 297.0)) -> Page:
    return Page(*size, shapes, "План", "uk")


def read(drawn: Page) -> etree._Element:
    return etree.fromstring(svg_text(drawn).encode())


def pdf(*pages: Page) -> BytesIO:
    stream = BytesIO()
    write_pdf(pages, stream)
    return BytesIO(stream.getvalue())


def parts(element: Any, kind: type) -> list[Any]:
    found = [element] if isinstance(element, kind) else []
    return found + [part for child in getattr(element, "_objs", []) for part in parts(child, kind)]


def up(x: str | float, y: str | float) -> complex:
    """Return a place of a file, where y points down, as it is drawn."""
    return complex(float(x), 297.0 - float(y))


def test_the_page_is_in_millimetres_and_says_its_title_and_language() -> None:
    root, document = read(page()), PDFDocument(PDFParser(pdf(page())))
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("210mm", "297mm", "0 0 210 297")
    assert root.findtext(f"{SVG}title") == document.info[0]["Title"].decode("utf-16") == "План"
    assert root.get("{http://www.w3.org/XML/1998/namespace}lang") == document.catalog["Lang"].decode() == "uk"
    sheets = extract_pages(pdf(page(size=(420, 297)), page()))
    assert [round(sheet.width * MM) for sheet in sheets] == [420, 210]
    assert read(Page(210, 297, (), "a\x00\x0bb", "en")).findtext(f"{SVG}title") == "ab"  # no control characters


@pytest.mark.parametrize("tip", [50 + 150j + 90.697j, 70.1234567 + 151j, 53 + 150j, 51 + 150j, 50 + 150j])
def test_a_vector_is_read_back_with_all_digits(tip: complex) -> None:
    vector = replace(ONE_OF_EACH[6], tip=tip)

    group = read(page(vector)).find(f"{SVG}g")

    line, dot = group.find(f"{SVG}line"), group.find(f"{SVG}circle")
    ends = [up(line.get(f"x{n}"), line.get(f"y{n}")) for n in (1, 2)]
    assert ends == pytest.approx([vector.tail, vector.tip], abs=1e-6)
    assert float(group.get("data-value")) == vector.value
    assert float(group.get("data-mu")) == vector.mu
    assert (group.get("class"), group.get("data-quantity"), group.get("data-unit")) == ("vector", "V_B", "m/s")
    assert group.findtext(f"{SVG}title") == "V_B = 4,53 м/с <B>"
    if tip == vector.tail:  # of zero: a dot that keeps its line
        assert up(dot.get("cx"), dot.get("cy")) == tip


@pytest.mark.parametrize("seed", range(4))
def test_a_pdf_says_pens_and_colours_only_where_they_change(seed: int) -> None:
    rng = random.Random(seed)
    pens = [(rng.choice([Pen.MAIN, Pen.THIN, Pen.AXIS]), rng.choice([None, "#0072B2"])) for _ in range(40)]
    lines = [Line(20 + 1j * y, 80 + 1j * y, pen, colour=colour) for y, (pen, colour) in enumerate(pens)]
    heads = [Head(100 + 4j * y, 1j, colour=colour) for y, (_, colour) in enumerate(pens)]
    (one,) = PDFPage.create_pages(PDFDocument(PDFParser(pdf(page(*lines, *heads)))))
    data = b"".join(resolve1(stream).get_data() for stream in one.contents).decode("latin-1")

    for changing, said in ((pens, r".* RG"), ([colour for _, colour in pens], r".* rg")):
        found = re.findall(f"^{said}$", data, re.MULTILINE)
        assert len(found) == 1 + sum(before != after for before, after in pairwise(changing))


@pytest.mark.parametrize("heads", [30.0, 2.1, 1.2, 0.4])
def test_heads_have_one_size_and_point_along_the_arrow(heads: float) -> None:
    length = heads * pens_for(210, 297).arrow
    group = read(page(Arrow(10 + 10j, 10 + 10j + length * 1j))).find(f"{SVG}g")
    tip, left, right = (up(*pair.split(",")) for pair in group.find(f"{SVG}polygon").get("points").split())
    assert abs(tip - (left + right) / 2) == pytest.approx(pens_for(210, 297).arrow, abs=1e-6)
    assert (tip - (left + right) / 2).imag > 0
    if heads >= 2.0 or heads <= 1.0:
        assert tip == pytest.approx(10 + 10j + length * 1j, abs=1e-6)


def test_runs_of_a_text_stand_where_its_layout_says_and_a_squeezed_text_keeps_its_place() -> None:
    text = Text(60 + 200j, "a^{n}_{BA} = 5", 3.5, "right")
    layout = lay_out(text.markup, 3.5)
    squeezed = read(page(Text(60 + 200j, "Заболотна", 2.5, squeeze=0.5))).find(f"{SVG}text")

    for element, run in zip(read(page(text)).iter(f"{SVG}text"), layout.runs, strict=True):
        place = up(element.get("x"), element.get("y"))
        assert place == pytest.approx(complex(60 - layout.width + run.x, 200 + run.y), abs=1e-6)
        assert float(element.get("font-size")) == pytest.approx(run.size, abs=1e-6)
        assert element.text == run.string
    a, b, c, d, e, f = map(float, squeezed.get("transform")[len("matrix(") : -1].split())
    x, y = float(squeezed.get("x")), float(squeezed.get("y"))
    assert (a * x + c * y + e, b * x + d * y + f) == pytest.approx((x, y), abs=1e-5)
    assert (a, b, c, d) == pytest.approx((0.5, 0, 0, 1), abs=1e-6)


def test_letters_as_lines_are_squeezed_and_turned_as_their_text_is() -> None:
    def points(**how: float) -> list[complex]:
        root = read(replace(page(Text(60 + 200j, "Затв.", 5.0, **how)), lettering="strokes"))
        pairs = (pair for line in root.iter(f"{SVG}polyline") for pair in line.get("points").split())
        return [up(*pair.split(",")) - (60 + 200j) for pair in pairs]

    level = points()

    assert points(angle=math.pi / 2) == pytest.approx([1j * at for at in level], abs=1e-5)
    assert points(squeeze=0.5) == pytest.approx([complex(0.5 * at.real, at.imag) for at in level], abs=1e-5)


def test_pens_are_of_two_widths_and_dashed_lines_start_and_end_with_a_dash() -> None:
    thinnest = {(841, 594): 0.3, (594, 420): 0.25, (420, 297): 0.25, (210, 297): 0.2}
    for size, least in thinnest.items():
        for pens in (pens_for(*size, norm) for norm in ("gost", "iso")):
            assert pens.main / 3 <= pens.thin <= pens.main / 2
            assert pens.main >= 0.5
            assert pens.thin >= least
            assert pens.arrow >= 2.5
    pens = pens_for(210, 297)
    for pen, pattern in ((Pen.DASHED, pens.dashed), (Pen.AXIS, pens.axis)):
        for length in (17.0, 40.0, 123.456):
            dashes = pens.dashes(pen, length)
            repeats = (length - dashes[0]) / sum(dashes)
            assert repeats == pytest.approx(round(repeats), abs=1e-9)
            assert 0.7 < dashes[0] / pattern[0] < 1.5
        assert not pens.dashes(pen, 3.0)  # too short


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_not_a_number_is_refused(bad: float) -> None:
    for write, shapes in ((svg_text, BAD), (pdf, BAD[:-1])):
        for shape in shapes:
            with pytest.raises(ValueError):
                write(page(shape(bad)))


def test_a_pdf_has_lines_curves_and_texts_where_they_were_drawn_in_the_embedded_font() -> None:
    ends = [(20 + 5j, 415 + 292j), (33.333333 + 7j, 100 + 99.99999j)]
    texts = Text(60 + 200j, "Прискорення точки S_{2}", 5.0), Text(60 + 100j, "Затв.", 2.5, squeeze=0.5)
    stream = pdf(page(*(Line(a, b) for a, b in ends), *texts, size=(420, 297)))

    [sheet] = extract_pages(stream)

    found = [complex(*point) * MM for line in parts(sheet, LTLine) for point in line.pts]
    assert found == pytest.approx([point for pair in ends for point in pair], abs=1e-4)
    assert (sheet.width * MM, sheet.height * MM) == pytest.approx((420, 297), abs=1e-4)
    assert complex(*parts(sheet, LTChar)[0].matrix[4:]) * MM == pytest.approx(60 + 200j, abs=1e-3)
    assert [word for word in ("Прискорення точки", "Затв.") if word not in extract_text(stream)] == []
    assert set(re.findall(rb"/BaseFont /(?:\w+\+)?([\w-]+)", stream.getvalue())) == {
        b"KulmanDrafting-Regular",
        b"KulmanDrafting-Slanted",
    }
    for shape in (Circle(100 + 100j, 60), Arc(100 + 100j, 60, 1.0, -4.0)):
        [curve] = parts(next(iter(extract_pages(pdf(page(shape, size=(420, 297)))))), LTCurve)
        points = [complex(*step[-1]) for step in curve.original_path if step[0] != "h"]
        assert [abs(p * MM - (100 + 100j)) for p in points] == pytest.approx([60] * len(points), abs=1e-4)


def sheet(name: str = "A2") -> Page:
    size = FORMATS[name].width, FORMATS[name].height
    return page(Line(100 + 100j, 100 + 150j), Text(20 + 20j, "Аркуш", 5.0), size=size)


@pytest.mark.parametrize(
    ("name", "paper", "count"), [("A4", "A4", 4), ("A3", "A4", 6), ("A2", "A4", 8), ("A1", "A4", 15), ("A1", "A3", 8)]
)
def test_tiles_cover_the_page_and_overlap_on_small_paper_at_full_size(name: str, paper: str, count: int) -> None:
    drawn, stream = sheet(name), BytesIO()
    width, height = sorted((FORMATS[paper].width, FORMATS[paper].height))

    windows = [tile.window for tile in _tiles(drawn, paper)]
    write_tiles([drawn], stream, paper)

    assert len(windows) == len({tile.name for tile in _tiles(drawn, paper)}) == count
    for x0, y0, x1, y1 in windows:
        assert x1 - x0 <= width - 2 * MARGIN
        assert y1 - y0 <= height - 2 * MARGIN
    for low, high, size in ((0, 2, drawn.width), (1, 3, drawn.height)):
        spans = sorted({(window[low], window[high]) for window in windows})
        assert (spans[0][0], spans[-1][1]) == (0, size)
        assert all(before[1] - after[0] == OVERLAP for before, after in pairwise(spans))
    pages = [(round(one.width * MM), round(one.height * MM)) for one in extract_pages(BytesIO(stream.getvalue()))]
    assert pages == [(width, height)] * count
    assert "Аркуш" in extract_text(BytesIO(stream.getvalue()))


def test_a_line_is_seen_on_its_tile_and_cut_off_elsewhere() -> None:
    stream = BytesIO()
    write_tiles([sheet()], stream)
    document = PdfDocument(stream.getvalue())
    place = (100 + MARGIN, 297 - MARGIN - (420 - 267) + 125)  # of the line's middle on tile A2, from the bottom left

    seen = []
    for tile, small in zip(_tiles(sheet()), document, strict=True):
        image = small.render(scale=200 / 72).to_pil().convert("L")
        x, y = place[0] * 200 / 25.4, image.height - place[1] * 200 / 25.4
        dark = image.crop((int(x) - 3, int(y) - 3, int(x) + 3, int(y) + 3)).getextrema()[0] < 128
        seen += [tile.name] if dark else []
    document.close()

    assert seen == ["A2"]


@pytest.mark.parametrize(
    ("names", "tile", "key", "told"),
    [
        (["x.docx"], None, "output-suffix", ".svg, .pdf, .png, .dxf"),
        (["x.svg"], "A4", "tile-suffix", ".svg"),
        (["x.pdf"], "A5", "tile-unknown", "A5"),
        (["none/x.svg"], None, "output-folder-missing", "x.svg"),
        (["x.svg", "./x.svg"], None, "output-twice", "x.svg"),
        (["x.png"], None, "extra-missing", "pip install pypdfium2"),
    ],
)
def test_what_cannot_be_written_is_refused_and_nothing_is(
    names: list[str], tile: str | None, key: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pypdfium2", None)
    with pytest.raises(InputError) as problem:
        write_pages([sheet()], *(f"{tmp_path}/{name}" for name in names), tile=tile)
    assert problem.value.key == key
    assert told in problem.value.text("uk")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("broken", [ValueError, KeyboardInterrupt, InputError])
def test_a_failed_writer_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, broken: type[BaseException]
) -> None:
    target, others = tmp_path / "x.svg", []
    write_pages([sheet()], target)
    old = target.read_bytes()

    def fail(pages: object, stream: BytesIO) -> None:
        stream.write(b"half")
        raise broken

    if broken is InputError:  # a file that cannot be made costs no older one
        monkeypatch.setitem(sys.modules, "pypdfium2", None)
        others = [tmp_path / "x.png"]
    else:
        monkeypatch.setitem(WRITERS, ".svg", fail)
    with pytest.raises(broken):
        write_pages([sheet()], target, *others)

    assert target.read_bytes() == old
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a disk that is always full")
def test_a_full_disk_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "x.svg"
    write_pages([sheet()], target)
    old = target.read_bytes()
    with monkeypatch.context() as patch:

        def opened(path: Path, mode: str, **more: int) -> object:
            return open("/dev/full", "wb") if mode == "xb" else open(path, mode, **more)

        patch.setattr(type(target), "open", opened)
        with pytest.raises(InputError) as problem:
            write_pages([sheet()], target)
    assert problem.value.key == "output-refused"
    assert "No space" in problem.value.text("en")
    assert target.read_bytes() == old


@pytest.mark.parametrize("sweep", [0.5, -0.5, 3.0, -6.0, math.tau, 1e5, -1e5])
def test_arcs_run_the_way_they_are_meant_and_cover_a_circle_however_often_they_go_round(sweep: float) -> None:
    arc = Arc(100 + 100j, 20, 0.3, sweep)
    path = read(page(arc)).find(f"{SVG}path").get("d")

    numbers = [float(part) for part in path.replace("M", "").replace("A", " ").split()]
    ends = [up(x, y) - (100 + 100j) for x, y in zip(numbers[7::7], numbers[8::7], strict=True)]
    assert set(numbers[6::7]) == {0 if sweep > 0 else 1}  # y points down in the file
    assert set(numbers[5::7]) == {0}  # no large arcs
    if abs(sweep) < math.tau:
        assert ends[-1] == pytest.approx(20 * complex(math.cos(0.3 + sweep), math.sin(0.3 + sweep)), abs=2e-6)
    else:
        assert extent([arc]) == pytest.approx((80.0, 80.0, 120.0, 120.0), abs=1e-6)
        assert len(_reach(arc)) <= 7  # not one for every quarter of a turn


def test_the_suffix_picks_the_writer_and_several_pages_become_numbered_pictures_or_one_document(tmp_path: Path) -> None:
    starts = {".svg": b"<?xml", ".pdf": b"%PDF", ".png": b"\x89PNG", ".PDF": b"%PDF"}
    one = write_pages([sheet("A4")], *(tmp_path / f"аркуш{k}{suffix}" for k, suffix in enumerate(starts)))
    two = write_pages([sheet("A4"), sheet("A3")], tmp_path / "x.svg", tmp_path / "x.pdf")
    assert [path.read_bytes().startswith(start) for path, start in zip(one, starts.values(), strict=True)] == [True] * 4
    assert [path.name for path in two] == ["x-1.svg", "x-2.svg", "x.pdf"]
    assert {*tmp_path.iterdir()} == {*one, *two}
    assert len(list(extract_pages(tmp_path / "x.pdf"))) == 2
    assert set(WRITERS) > set(writers.SEVERAL)  # every file goes through the table
