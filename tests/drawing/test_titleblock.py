"""Formats and title blocks: every line where the standard has it, every word clear of the lines."""

from dataclasses import replace

import pytest
import shapely
from lxml import etree

import kulman
from kulman.drawing.font import SLANTED
from kulman.drawing.formats import FORMATS, block_box, drawing_area, format_named, pens_for, reserved_boxes
from kulman.drawing.page import Page, extent
from kulman.drawing.shapes import Line, Pen, Polyline, Text
from kulman.drawing.svg import svg_text
from kulman.drawing.text import laid_out
from kulman.drawing.titleblock import CLEAR, Stamp, _fits, _named, _placed, frame_shapes, words
from kulman.scales.errors import InputError
from kulman.tests.support.shapes import leaves
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

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
FORM_1 = (
    {((185 - a, y), (185 - b, y), True) for y, spans in HEAVY_LEVELS.items() for a, b in spans}
    | {((185 - a, y), (185 - b, y), False) for y, spans in THIN_LEVELS.items() for a, b in spans}
    | {((185 - x, a), (185 - x, b), True) for x, (a, b) in HEAVY_UPRIGHTS.items()}
    | {((185 - x, 20), (185 - x, 35), False) for x in (45, 40)}
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
BLOCKS = {("gost", True): ("form-1", FORM_1), ("gost", False): ("form-2a", FORM_2A)}


BLOCKS |= dict.fromkeys((("iso", True), ("iso", False)), ("iso-7200", ISO_7200))


# sheets; the frames of GOST, and the drawing spaces of ISO 5457
SIZES = {"A4": (210, 297), "A3": (420, 297), "A3-portrait": (297, 420), "A2": (594, 420), "A1": (841, 594)}
FRAMES = {
    "gost": {"A4": (185, 287), "A3": (395, 287), "A3-portrait": (272, 410), "A2": (569, 410), "A1": (816, 584)},
    "iso": {"A4": (180, 277), "A3": (390, 277), "A2": (564, 400), "A1": (811, 574)},
}
EVERY = [(name, norm, first) for name in FORMATS for norm in ("gost", "iso") for first in (True, False)]
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
CELL = (17.0, 25.0, 40.0, 30.0)


def page(name: str, language: str, norm: str = "gost", first: bool = True, stamp: Stamp | None = None) -> Page:
    sheet = FORMATS[name]
    shapes = frame_shapes(sheet, stamp or STAMPS[language], norm, first)
    return Page(sheet.width, sheet.height, shapes, "x", language, norm)


def written(page: Page, *names: str) -> list[Text]:
    return [text for text in leaves(page.shapes) if isinstance(text, Text) and (not names or text.name in names)]


@pytest.mark.parametrize(("name", "norm", "first"), EVERY)
@pytest.mark.parametrize("language", STAMPS)
def test_texts_touch_nothing_and_have_heights_of_the_row(name: str, language: str, norm: str, first: bool) -> None:
    drawn = page(name, language, norm, first)
    texts = [(text, shapely.box(*extent((text,)))) for text in written(drawn)]
    strokes = []
    for part in leaves(drawn.shapes):
        points = (part.a, part.b) if isinstance(part, Line) else getattr(part, "points", ())
        ends = points[1:] + points[:1] if getattr(part, "closed", False) else points[1:]
        for a, b in zip(points, ends, strict=False):
            line = shapely.LineString([(a.real, a.imag), (b.real, b.imag)])
            strokes.append(line.buffer(drawn.pens.width(part.pen) / 2, cap_style="square"))

    for index, (text, box) in enumerate(texts):
        assert not shapely.intersects(box, strokes).any(), text.markup
        assert not any(box.intersects(other) for _, other in texts[index + 1 :]), text.markup
    assert {text.height for text, _ in texts} <= {2.5, 3.5, 5.0, 7.0}


def test_fields_are_blank_where_nothing_is_said_and_hold_braces_as_they_are() -> None:
    fields = ("student", "teacher", "designation", "date_value", "title", "scale", "organisation")
    for norm in ("gost", "iso"):
        assert written(page("A3", "en", norm, stamp=Stamp(language="en")), *fields) == []
        shown = " ".join(text.markup for text in written(page("A3", "en", norm)))
        assert [filler for filler in ("None", "TODO", "{", "}") if filler in shown] == []
    odd = written(page("A3", "uk", stamp=Stamp(designation=r"A_{1}\bar{2}")), "designation")
    assert [text.markup for text in odd] == [r"A\_\{1\}\\bar\{2\}"]


@pytest.mark.parametrize("said", ["J. O'Brien", "J. OʼBrien", "AT-1", "К-ра ТММ_1 p1", "m = 2", "ω φ", "A–B N"])
def test_what_a_user_says_is_words_and_no_symbol_of_a_quantity(said: str) -> None:
    named = ("title", "designation", "organisation", "group", "student", "teacher", "document_type")
    for norm, first, language in (("gost", True, "uk"), ("gost", False, "ru"), ("iso", True, "en")):
        sheet = page("A3", language, norm, first, Stamp(**dict.fromkeys(named, said), language=language, identity=said))
        runs = [run for text in written(sheet) for run in laid_out(text).runs]
        assert [run.string for run in runs if run.face == SLANTED] == []
        assert any(run.string in said for run in runs)


@pytest.mark.parametrize(
    ("task", "variant", "language", "format", "designations"),
    [
        pytest.param(*("scheme-14-jaw-crusher", "3", "uk", None, ["ТММ.14.03.001"] * 2), marks=pytest.mark.soak),
        pytest.param("madi-gear", "17", "en", None, ["TMM.25.17.001"] * 2, marks=pytest.mark.soak),
        ("karpenko-hoist", "V07", "ru", None, ["ТММ.26.07.001"]),
        ("nau-slider-crank", "example", "uk", None, ["ТММ.23.11.001"]),
    ],
)
def test_a_designation_is_composed_of_task_and_variant_and_is_that_of_all_sheets(
    task: str, variant: str, language: str, format: str | None, designations: list[str]
) -> None:
    pages = kulman.sheet(task, variant, lang=language, format=format).pages
    assert [text.markup for page in pages for text in written(page, "designation")] == designations
    told = [text.markup for text in written(pages[0], "document_type", "student", "teacher", "date_value")]
    assert told == [{"en": "Course work"}.get(language, "РГР")]


def test_a_designation_that_is_said_stands_on_every_page() -> None:
    pages = kulman.sheet("nau-slider-crank", format="A4", designation="АБ-1", work="КП").pages
    assert len(pages) > 1
    assert [text.markup for page in pages for text in written(page, "designation")] == ["АБ-1"] * len(pages)
    assert [text.markup for text in written(pages[0], "document_type")] == ["КП"]


def test_every_task_has_a_number_of_its_own_and_another_series_is_101() -> None:
    numbers = {name: load_task(name).number for name in bundled()}
    assert sorted(numbers.values()) == [*range(1, len(numbers) + 1)]
    assert all(f"scheme-{n:02d}" in name for name, n in numbers.items() if name.startswith("scheme"))
    stamp = Stamp(code="ТММ.14.03", sheet=2, series=1)
    assert stamp.designated == "ТММ.14.03.101"
    assert replace(stamp, designation="АБ").designated == "АБ"
    assert Stamp().designated == ""


def test_pages_after_the_first_say_whose_they_are() -> None:
    stamp = replace(STAMPS["uk"], code="ТММ.01.02", designation="", sheet=2)
    for norm in ("gost", "iso"):
        shown = " ".join(text.markup for text in written(page("A3", "uk", norm, first=False, stamp=stamp)))
        assert all(part in shown for part in ("ТММ.01.02.001", stamp.student, stamp.group))


def test_a_long_title_shrinks_and_wraps_and_a_name_that_no_letters_can_fit_is_refused() -> None:
    short = replace(STAMPS["uk"], title="Важільний механізм", document_type="")
    long = replace(short, title=STAMPS["uk"].title + " і ще одного механізму з кулісою")
    titles = [written(page("A3", "uk", stamp=stamp), "title") for stamp in (short, long)]
    assert [{text.height for text in title} for title in titles] == [{5.0}, {3.5}]
    assert len(titles[1]) == 3
    with pytest.raises(InputError) as problem:
        page("A3", "uk", stamp=Stamp(student="Ш" * 60))
    assert problem.value.key == "stamp-too-long"
    assert all(problem.value.text(language) for language in STAMPS)


@pytest.mark.parametrize("lines", [["Йосип"], ["[щ]"], ["Йод", "[щ]"]], ids=["breve", "brackets", "both"])
def test_ink_keeps_clear_of_the_lines_of_every_cell_that_it_fits_in(lines: list[str]) -> None:
    fitting = [0.1 * high for high in range(30, 200) if _fits(lines, 3.5, 0.1 * high)]

    for high in fitting:
        _, low, _, top = extent(_placed(lines, (0.0, 0.0, 50.0, high), 3.5, "left", "title"))
        assert CLEAR - 1e-9 < low < top < high - CLEAR + 1e-9
    assert len(fitting) > 50


def test_captions_are_words_of_their_language() -> None:
    tables = {language: words(language) for language in STAMPS}
    assert all(caption.isascii() for caption in tables["en"].values())
    assert "Лист" not in " ".join(tables["uk"].values())


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("Студент 0001", "Студент 0001"),
        ("Коваль Іван Петрович", "Коваль І. П."),
        ("Заболотна Олександра Володимирівна", "Заболотна О. В."),
        ("Олександра Володимирівна Заболотна", "О. В. Заболотна"),
        ("Oleksandra Volodymyrivna Zabolotna", "O. V. Zabolotna"),
        ("доц. Заболотна Олександра Володимирівна", "доц. Заболотна О. В."),
        ("доц. Заболотна О. В.", "доц. Заболотна О. В."),
        ("Коваль-Петренко О. В.", "Коваль-Петренко О. В."),
        ("Кропивницька-Заболотна Олександра-Вікторія Олегівна", "Кропивницька-Заболотна"),
        ("Maximiliana Konstantinopolskaya-Smith", "Konstantinopolskaya-Smith"),
        ("Олександр Коваленко", "О. Коваленко"),
        ("Коваленко Олександр", "Коваленко О."),
        ("Александра Красовская", "А. Красовская"),
        ("Олександр КРИВОВ'ЯЗ", "О. КРИВОВ'ЯЗ"),
        ("Любов-Катерина Лебедєва", "Л.-К. Лебедєва"),
        ("Костянтин Петрович Мацкевич", "К. П. Мацкевич"),
        ("Кривов'яз, Костянтин Петрович", "Кривов'яз, К. П."),
        # which word the surname is nobody can tell: both stay
        ("Олена Гринько-Ґалаґан", "Олена Гринько-Ґалаґан"),
        ("Гринько-Ґалаґан Олена", "Гринько-Ґалаґан Олена"),
        ("Костянтин Станіславович", "Костянтин Станіславович"),
        ("доц. каф. ТММ Красовская А. И.", "Красовская А. И."),
        ("проф. Олександра Коваленко-Заболотна", "О. Коваленко-Заболотна"),
        ("Prof. Krasovskaya-Smith O. V.", "Krasovskaya-Smith O. V."),
        ("Wolfenbarger Alexandra", "Wolfenbarger Alexandra"),
        ("проф. д.т.н. Коваленко-Сидорчук Александр", "Коваленко-Сидорчук А."),
    ],
)
def test_a_long_name_is_shown_with_initials_before_it_is_refused(name: str, shown: str) -> None:
    [text] = _named(name, CELL, (2.5,), "left", "student")
    assert text.markup == shown
    assert extent((text,))[2] <= CELL[2]
    with pytest.raises(InputError, match="too long"):
        _named("щ" * 60, CELL, (2.5,), "left", "student")


def test_formats_are_the_trimmed_sheets_from_the_smallest_with_frames_as_large_as_the_standard_says() -> None:
    areas = [width * height for width, height in SIZES.values()]
    assert {name: (item.width, item.height) for name, item in FORMATS.items()} == SIZES
    assert [item.width * item.height for item in FORMATS.values()] == sorted(areas)
    for norm, frames in FRAMES.items():
        found = {name: drawing_area(FORMATS[name], norm) for name in frames}
        assert {name: (x1 - x0, y1 - y0) for name, (x0, y0, x1, y1) in found.items()} == frames
        assert {box[0] for box in found.values()} == {20}


def test_a_format_is_found_as_people_write_it_and_an_unknown_one_refused_with_the_known() -> None:
    for name in ("a3", " A3 ", "А3", "а3"):
        assert format_named(name) is FORMATS["A3"]
    for name in ("", "A5", "Letter", "A3 landscape"):
        with pytest.raises(InputError) as problem:
            format_named(name)
        assert all("A4, A3, A3-portrait, A2, A1" in problem.value.text(language) for language in STAMPS)


@pytest.mark.parametrize(("name", "norm", "first"), EVERY)
def test_blocks_and_frames_are_where_the_standard_has_them(name: str, norm: str, first: bool) -> None:
    drawn, sheet, (block, table) = page(name, "uk", norm, first), FORMATS[name], BLOCKS[norm, first]
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    left, low = block_box(sheet, norm, first)[:2]
    root, boxes = etree.fromstring(svg_text(drawn).encode()), reserved_boxes(sheet, norm, first)

    found = set()
    for line in root.find(f".//{SVG}g[@data-name='{block}']").iter(f"{SVG}line"):
        a, b, c, d = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
        ends = sorted((round(x - left, 2), round(drawn.height - y - low, 2)) for x, y in ((a, b), (c, d)))
        found.add((*ends, float(line.get("stroke-width")) == drawn.pens.main))

    assert found == table
    edge, frame, *_ = drawn.shapes
    assert frame == Polyline((x0 + y0 * 1j, x1 + y0 * 1j, x1 + y1 * 1j, x0 + y1 * 1j), Pen.MAIN, True, role="frame")
    assert (edge.pen, edge.points[2]) == (Pen.THIN, complex(sheet.width, sheet.height))
    pens = pens_for(sheet.width, sheet.height, norm)
    widths = {float(element.get("stroke-width")) for element in root.iter() if element.get("stroke-width")}
    assert widths == {pens.main, pens.thin}
    assert boxes[0] == block_box(sheet, norm, first)
    assert boxes[0][1:3] == (y0, x1)
    corner = (max(end[axis] for *ends, _ in table for end in ends) for axis in (0, 1))  # as large as what is drawn
    assert (x1 - left, boxes[0][3] - y0) == pytest.approx((*corner,))
    for a, b, c, d in boxes:
        assert x0 <= a < c <= x1
        assert y0 <= b < d <= y1
        assert (a == x0 or c == x1) and (b == y0 or d == y1)  # noqa: PT018
    assert len(boxes) == 1 or boxes[1][1] > boxes[0][3]
