"""Title blocks: every line where the standard has it, every word clear of the lines."""

from dataclasses import fields, replace
from io import BytesIO

import pytest
from lxml import etree
from pdfminer.high_level import extract_pages
from pdfminer.layout import LTLine

from kulman.drawing.formats import FORMATS, block_box, drawing_area
from kulman.drawing.page import Page, extent
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.pens import pens_for
from kulman.drawing.shapes import Group, Line, Pen, Polyline, Text
from kulman.drawing.svg import svg_text
from kulman.drawing.titleblock import Stamp, frame_shapes, named, words
from kulman.scales.errors import InputError
from kulman.tests.support.shapes import leaves

SVG = "{http://www.w3.org/2000/svg}"

# Form 1 of GOST 2.104 as published: distances from the RIGHT edge of the block, heights from its bottom.
HEAVY_LEVELS = {
    55: [(185, 0)], 40: [(120, 0)], 35: [(185, 120), (50, 0)], 30: [(185, 120)], 20: [(50, 0)], 15: [(120, 0)],
}  # fmt: skip
THIN_LEVELS = {level: [(185, 120)] for level in (50, 45, 40, 25, 20, 15, 10, 5)}
HEAVY_UPRIGHTS = {
    185: (0, 55), 178: (30, 55), 168: (0, 55), 145: (0, 55), 130: (0, 55), 120: (0, 55), 50: (0, 40),
    35: (20, 40), 18: (20, 40), 30: (15, 20),
}  # fmt: skip
THIN_UPRIGHTS = {45: (20, 35), 40: (20, 35)}
FORM_1 = (
    {((185 - a, y), (185 - b, y), True) for y, spans in HEAVY_LEVELS.items() for a, b in spans}
    | {((185 - a, y), (185 - b, y), False) for y, spans in THIN_LEVELS.items() for a, b in spans}
    | {((185 - x, a), (185 - x, b), True) for x, (a, b) in HEAVY_UPRIGHTS.items()}
    | {((185 - x, a), (185 - x, b), False) for x, (a, b) in THIN_UPRIGHTS.items()}
)
FORM_2A = (
    {((0, 15), (185, 15), True), ((0, 10), (65, 10), False), ((0, 5), (65, 5), True), ((175, 8), (185, 8), True)}
    | {((x, 0), (x, 15), True) for x in (0, 7, 17, 40, 55, 65, 175)}
)  # fmt: skip
ISO_7200 = {
    ((0, 36), (180, 36), True), ((0, 0), (0, 36), True),
    ((0, 24), (140, 24), False), ((0, 12), (180, 12), False), ((140, 0), (140, 36), False),
    ((80, 0), (80, 36), False), ((100, 0), (100, 12), False), ((160, 0), (160, 12), False),
}  # fmt: skip

STAMPS = {
    "uk": Stamp(
        title="Кінематичний і силовий аналіз важільного механізму",
        designation="ТММ.РГР.12.05.01",
        organisation="НАУ, кафедра прикладної механіки",
        group="гр. АБ-301",
        student="Йосипенко-Щука Ї. Й.",
        teacher="Коваленко-Заболотна",
        date="21.11.2026",
        document_type="Розрахунково-графічна робота",
        sheet=1,
        sheets=12,
        scale="1:2,5",
        language="uk",
    ),
    "ru": Stamp(title="Рычажный механизм", student="Щукин Ю. Й.", teacher="Ёлкин Р.", language="ru"),
    "en": Stamp(title="Slider-crank mechanism", student="J. Gypsy (Query)", date="2026-11-21", language="en"),
}
EVERY = [(name, language, norm, first) for name in FORMATS for language in STAMPS for norm in ("gost", "iso")
         for first in (True, False)]  # fmt: skip


def page(name, language, norm="gost", first=True, stamp=None):
    sheet = FORMATS[name]
    shapes = frame_shapes(sheet, stamp or STAMPS[language], norm, first)
    return Page(sheet.width, sheet.height, shapes, "x", language, norm)


def drawn_lines(root, name, height, corner, heavy):
    """Read the cell lines of one block back, measured from its bottom left corner."""
    found = set()
    for line in root.find(f".//{SVG}g[@data-name='{name}']").iter(f"{SVG}line"):
        x1, y1, x2, y2 = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
        ends = sorted(((x1 - corner[0], height - y1 - corner[1]), (x2 - corner[0], height - y2 - corner[1])))
        found.add((*(tuple(round(v, 2) for v in end) for end in ends), float(line.get("stroke-width")) == heavy))
    return found


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize(
    ("norm", "first", "block", "table"),
    [("gost", True, "form-1", FORM_1), ("gost", False, "form-2a", FORM_2A), ("iso", True, "iso-7200", ISO_7200)],
    ids=["form-1", "form-2a", "iso-7200"],
)
def test_every_line_of_the_block_is_where_the_standard_has_it(name, norm, first, block, table):
    drawn = page(name, "uk", norm, first)
    corner = block_box(FORMATS[name], norm, first)[:2]

    found = drawn_lines(etree.fromstring(svg_text(drawn).encode()), block, drawn.height, corner, drawn.pens.main)

    assert found == table


def test_the_pdf_has_the_same_lines():
    stream = BytesIO()
    write_pdf([page("A3", "uk")], stream)
    x0, y0, _, _ = block_box(FORMATS["A3"])

    (sheet,) = extract_pages(BytesIO(stream.getvalue()))

    found = set()
    for line in sheet:
        if isinstance(line, LTLine):
            ends = sorted((x * 25.4 / 72 - x0, y * 25.4 / 72 - y0) for x, y in line.pts)
            found.add((*(tuple(round(v, 2) + 0.0 for v in end) for end in ends), line.linewidth * 25.4 / 72 > 0.5))
    assert found >= FORM_1


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_the_frame_is_a_main_line_and_the_edge_a_thin_one(name, norm):
    sheet = FORMATS[name]

    edge, frame, *_ = frame_shapes(sheet, STAMPS["uk"], norm)

    x0, y0, x1, y1 = drawing_area(sheet, norm)
    assert frame == Polyline((x0 + y0 * 1j, x1 + y0 * 1j, x1 + y1 * 1j, x0 + y1 * 1j), Pen.MAIN, True, role="frame")
    assert (edge.pen, edge.points[2]) == (Pen.THIN, complex(sheet.width, sheet.height))


@pytest.mark.parametrize(("name", "language", "norm", "first"), EVERY)
def test_no_text_touches_a_line_or_another_text(name, language, norm, first):
    drawn = page(name, language, norm, first)
    parts = list(leaves(drawn.shapes))
    texts = [(text, extent((text,))) for text in parts if isinstance(text, Text)]
    strokes = []
    for part in parts:
        points = (part.a, part.b) if isinstance(part, Line) else getattr(part, "points", ())
        ends = points[1:] + points[:1] if getattr(part, "closed", False) else points[1:]
        strokes += [(a, b, drawn.pens.width(part.pen) / 2) for a, b in zip(points, ends, strict=False)]

    for index, (text, (x0, y0, x1, y1)) in enumerate(texts):
        for a, b, half in strokes:
            left, right = sorted((a.real, b.real))
            low, high = sorted((a.imag, b.imag))
            apart = x1 < left - half or x0 > right + half or y1 < low - half or y0 > high + half
            assert apart, (text.markup, a, b)
        for _, (u0, v0, u1, v1) in texts[index + 1 :]:
            assert x1 < u0 or x0 > u1 or y1 < v0 or y0 > v1, text.markup


@pytest.mark.parametrize(("name", "language", "norm", "first"), EVERY)
def test_letters_have_a_height_of_the_row(name, language, norm, first):
    heights = {text.height for text in leaves(page(name, language, norm, first).shapes) if isinstance(text, Text)}

    assert heights <= {2.5, 3.5, 5.0, 7.0}


@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_empty_fields_stay_blank(norm):
    full = replace(STAMPS["en"], language="en")
    empty = Stamp(language="en")

    names = {text.name for text in leaves(page("A3", "en", norm, stamp=empty).shapes) if isinstance(text, Text)}

    assert not names & {"student", "teacher", "designation", "date_value", "title", "scale", "organisation"}
    shown = " ".join(
        text.markup for text in leaves(page("A3", "en", norm, stamp=full).shapes) if isinstance(text, Text)
    )
    for filler in ("None", "TODO", "{", "}"):
        assert filler not in shown


def test_a_long_title_shrinks_and_wraps():
    short = replace(STAMPS["uk"], title="Важільний механізм", document_type="")
    long = replace(short, title=STAMPS["uk"].title + " і ще одного механізму з кулісою")

    def title(stamp):
        texts = leaves(page("A3", "uk", stamp=stamp).shapes)
        return [text for text in texts if isinstance(text, Text) and text.name == "title"]

    assert {text.height for text in title(short)} == {5.0}
    assert {text.height for text in title(long)} == {3.5}
    assert len(title(long)) == 4


def test_a_name_that_no_letters_can_fit_is_refused():
    with pytest.raises(InputError) as problem:
        page("A3", "uk", stamp=Stamp(student="Ш" * 60))

    assert problem.value.key == "stamp-too-long"
    assert all(problem.value.text(language) for language in ("en", "uk", "ru"))


def test_braces_and_backslashes_of_a_name_are_shown():
    texts = leaves(page("A3", "uk", stamp=Stamp(designation=r"A_{1}\bar{2}")).shapes)

    assert [text.markup for text in texts if getattr(text, "name", "") == "designation"] == [r"A\_\{1\}\\bar\{2\}"]


@pytest.mark.parametrize(
    ("name", "corner", "angle"), [("A3", "left", 180), ("A4", "left", 180), ("A3-portrait", "right", -90)]
)
def test_the_designation_stands_turned_in_the_upper_corner(name, corner, angle):
    drawn = page(name, "uk")

    group = next(part for part in drawn.shapes if isinstance(part, Group) and part.name == "column-26")

    (text,) = (part for part in group.shapes if isinstance(part, Text))
    x0, y0, x1, y1 = extent((text,))
    frame = drawing_area(FORMATS[name])
    wide, high = (14, 70) if angle == -90 else (70, 14)
    inside = (frame[2] - wide, frame[2]) if corner == "right" else (frame[0], frame[0] + wide)
    assert inside[0] < x0 < x1 < inside[1]
    assert frame[3] - high < y0 < y1 < frame[3]
    assert round(text.angle * 57.29577951308232) == angle


def test_captions_exist_in_every_language_and_are_words_of_it():
    tables = {language: words(language) for language in STAMPS}

    assert tables["uk"].keys() == tables["ru"].keys() == tables["en"].keys()
    assert not set("".join(tables["uk"].values())) & set("ыэъё")
    assert not set("".join(tables["ru"].values())) & set("іїєґ")
    assert all(caption.isascii() for caption in tables["en"].values())
    assert "Лист" not in " ".join(tables["uk"].values())


def test_a_stamp_has_the_fields_that_the_command_line_fills():
    wanted = "title designation organisation group student teacher date document_type sheet sheets scale language"

    assert [field.name for field in fields(Stamp)] == [*wanted.split(), "identity"]


def test_pens_of_the_block_are_those_of_the_format():
    root = etree.fromstring(svg_text(page("A1", "uk")).encode())

    widths = {float(element.get("stroke-width")) for element in root.iter() if element.get("stroke-width")}

    assert widths == {pens_for(841, 594).main, pens_for(841, 594).thin}


CELL = (17.0, 25.0, 40.0, 30.0)


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("Студент 0001", "Студент 0001"),
        ("Коваль Іван Петрович", "Коваль Іван Петрович"),
        ("Заболотна Олександра Володимирівна", "Заболотна О. В."),
        ("Олександра Володимирівна Заболотна", "О. В. Заболотна"),
        ("Oleksandra Volodymyrivna Zabolotna", "O. V. Zabolotna"),
        ("доц. Заболотна Олександра Володимирівна", "доц. Заболотна О. В."),
        ("Кропивницька-Заболотна Олександра-Вікторія Олегівна", "Кропивницька-Заболотна"),
        ("Maximiliana Konstantinopolskaya-Smith", "M. Konstantinopolskaya-Smith"),
    ],
)
def test_a_long_name_is_shown_with_initials_before_it_is_refused(name: str, shown: str) -> None:
    [text] = named(name, CELL, (2.5,), "left", "student")

    assert text.markup == shown
    assert extent((text,))[2] <= CELL[2]
    with pytest.raises(InputError, match="too long"):
        named("щ" * 60, CELL, (2.5,), "left", "student")
