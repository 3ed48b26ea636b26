"""Tiles and files: a large page on small paper, and files that are written whole or not at all."""

from io import BytesIO
from itertools import pairwise
from pathlib import Path

import pytest
from pdfminer.high_level import extract_pages, extract_text
from pypdfium2 import PdfDocument

from kulman.drawing import writers
from kulman.drawing.formats import FORMATS
from kulman.drawing.page import Page
from kulman.drawing.pdf import MARGIN, OVERLAP, tiles, write_tiles
from kulman.drawing.shapes import Line, Text
from kulman.drawing.writers import WRITERS, write_pages
from kulman.scales.errors import InputError


def page(name="A2"):
    sheet = FORMATS[name]
    return Page(sheet.width, sheet.height, (Line(100 + 100j, 100 + 150j), Text(20 + 20j, "Аркуш", 5.0)), "x", "uk")


@pytest.mark.parametrize(("name", "count"), [("A4", 4), ("A3", 6), ("A2", 8), ("A1", 15)])
def test_tiles_cover_the_page_and_overlap(name, count):
    drawn = page(name)

    windows = [tile.window for tile in tiles(drawn)]

    assert len(windows) == count
    for x0, y0, x1, y1 in windows:
        assert x1 - x0 <= 210 - 2 * MARGIN
        assert y1 - y0 <= 297 - 2 * MARGIN
    columns = sorted({(x0, x1) for x0, _, x1, _ in windows})
    assert (columns[0][0], columns[-1][1]) == (0, drawn.width)
    assert all(before[1] - after[0] == OVERLAP for before, after in pairwise(columns))
    rows = sorted({(y0, y1) for _, y0, _, y1 in windows})
    assert (rows[0][0], rows[-1][1]) == (0, drawn.height)
    assert all(before[1] - after[0] == OVERLAP for before, after in pairwise(rows))
    assert len({tile.name for tile in tiles(drawn)}) == count


def test_tiled_sheets_are_small_paper_at_full_size():
    stream = BytesIO()
    write_tiles([page()], stream)

    sheets = list(extract_pages(BytesIO(stream.getvalue())))

    assert len(sheets) == 8
    assert "Аркуш" in extract_text(BytesIO(stream.getvalue()))
    assert {(round(sheet.width * 25.4 / 72), round(sheet.height * 25.4 / 72)) for sheet in sheets} == {(210, 297)}


def test_a_line_is_seen_on_its_tile_and_cut_off_elsewhere():
    stream = BytesIO()
    write_tiles([page()], stream)
    document = PdfDocument(stream.getvalue())
    names = [tile.name for tile in tiles(page())]
    place = (100 + MARGIN, 297 - MARGIN - (420 - 267) + 125)  # of the line's middle on tile A2, from the bottom left

    dark = {}
    for name, sheet in zip(names, document, strict=True):
        image = sheet.render(scale=200 / 72).to_pil().convert("L")
        x, y = place[0] * 200 / 25.4, image.height - place[1] * 200 / 25.4
        dark[name] = image.crop((int(x) - 3, int(y) - 3, int(x) + 3, int(y) + 3)).getextrema()[0] < 128
    document.close()

    assert [name for name, seen in dark.items() if seen] == ["A2"]


def test_unknown_paper_is_refused():
    with pytest.raises(InputError) as problem:
        tiles(page(), "A5")

    assert "A5" in problem.value.text("uk")


@pytest.mark.parametrize(
    ("suffix", "start"), [(".svg", b"<?xml"), (".pdf", b"%PDF"), (".png", b"\x89PNG"), (".PDF", b"%PDF")]
)
def test_the_suffix_picks_the_writer(tmp_path, suffix, start):
    (written,) = write_pages([page("A4")], tmp_path / f"аркуш{suffix}")

    assert written.read_bytes().startswith(start)
    assert list(tmp_path.iterdir()) == [written]


def test_several_pages_become_numbered_pictures_or_one_document(tmp_path):
    pages = [page("A4"), page("A3")]

    assert [path.name for path in write_pages(pages, tmp_path / "x.svg")] == ["x-1.svg", "x-2.svg"]
    assert [path.name for path in write_pages(pages, tmp_path / "x.pdf")] == ["x.pdf"]
    assert len(list(extract_pages(tmp_path / "x.pdf"))) == 2


def test_an_unknown_suffix_names_the_known_ones(tmp_path):
    with pytest.raises(InputError) as problem:
        write_pages([page()], tmp_path / "x.docx")

    assert ".svg, .pdf, .png" in problem.value.text("ru")
    assert not list(tmp_path.iterdir())


def test_only_a_pdf_is_tiled(tmp_path):
    with pytest.raises(InputError) as problem:
        write_pages([page()], tmp_path / "x.svg", tile="A4")

    assert problem.value.key == "tile-suffix"


@pytest.mark.parametrize("broken", [ValueError, KeyboardInterrupt])
def test_a_failed_writer_leaves_the_old_file(tmp_path, monkeypatch, broken):
    target = tmp_path / "x.svg"
    target.write_text("old")

    def fail(pages, stream):
        stream.write(b"half")
        raise broken

    monkeypatch.setitem(WRITERS, ".svg", fail)
    with pytest.raises(broken):
        write_pages([page()], target)

    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_file_that_cannot_be_made_costs_no_older_one(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pypdfium2", None)
    older = tmp_path / "x.svg"
    older.write_text("old")

    with pytest.raises(InputError):
        write_pages([page()], older, tmp_path / "x.png")

    assert older.read_text() == "old"
    assert list(tmp_path.iterdir()) == [older]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a disk that is always full")
def test_a_full_disk_leaves_the_old_file(tmp_path, monkeypatch):
    target = tmp_path / "x.svg"
    target.write_text("old")

    with monkeypatch.context() as patch:
        patch.setattr(type(target), "open", lambda path, mode: open("/dev/full", "wb"))  # noqa: SIM115
        with pytest.raises(InputError) as problem:
            write_pages([page()], target)

    assert problem.value.key == "output-refused"
    assert "No space" in problem.value.text("en")
    assert target.read_text() == "old"


def test_the_same_file_is_not_written_twice(tmp_path):
    with pytest.raises(InputError) as problem:
        write_pages([page()], tmp_path / "x.svg", tmp_path / "." / ".." / tmp_path.name / "x.svg")

    assert problem.value.key == "output-twice"


def test_an_a1_sheet_on_a3_paper_takes_half_the_sheets():
    stream = BytesIO()

    write_tiles([page("A1")], stream, "A3")

    stream.seek(0)
    pages = list(extract_pages(stream))
    assert len(pages) == len(tiles(page("A1"), "A3")) == 8
    assert len(tiles(page("A1"), "A4")) == 15
    assert {(round(sheet.width * 25.4 / 72), round(sheet.height * 25.4 / 72)) for sheet in pages} == {(297, 420)}


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(InputError) as problem:
        write_pages([page()], tmp_path / "none" / "x.svg")

    assert "x.svg" in problem.value.text("uk")


def test_a_picture_without_its_extra_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pypdfium2", None)

    with pytest.raises(InputError) as problem:
        write_pages([page()], tmp_path / "x.png")

    assert "kulman[png]" in problem.value.text("en")
    assert not list(tmp_path.iterdir())


def test_every_file_goes_through_the_table():
    assert set(WRITERS) > set(writers.SEVERAL)
