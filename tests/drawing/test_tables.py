"""Tables, blocks of text, dimensions: letters in the middle of rows, numbers by the comma, texts over lines; heads."""

import cmath
import random
import re
from itertools import pairwise

import pytest

from kulman.drawing.dimensions import linear
from kulman.drawing.formats import FORMATS, STYLES, Style, pens_for
from kulman.drawing.page import extent
from kulman.drawing.shapes import Arc, Group, Head, Line, Text
from kulman.drawing.symbols import angle_dimension, clear_ray
from kulman.drawing.tables import table, text_block
from kulman.drawing.text import lay_out, placer
from kulman.drawing.view import Canvas, View

CASES = range(60)
SYMBOLS = ("m", "V_{B}", "a^{n}_{BA}", "φ", "J_{S2}", r"\bar{R}^{τ}_{12}", "P^{ст}_{12 max}", "Δl")
NUMBERS = ("0", "5", "−12", "206000", "12250133", "0,0002676", "16,5", "−0,86", "2641422", "5.343", "∞")
UNITS = ("", "м", "мм^{2}", "кг·м^{2}", "(м/с)/мм")
WORDS = ("Канат натягнутий у першій фазі", "Міцність", "Вантаж не повертається на опору")
LINES = (
    r"\uu{\bar{V}_{B}} = \uu{\bar{V}_{A}} + \u{\bar{V}_{BA}}",
    r"\bar{R}^{τ}_{12} + \bar{R}_{03} = 0",
    "W = 3n",
    "x^{2}_{φ}",
)


def drawn(view: View) -> tuple[list[Text], list[Line]]:
    """Return the cells or lines of text of a view, and its ruled lines."""
    (body,) = (shape for shape in view.shapes if isinstance(shape, Group))
    return [s for s in body.shapes if isinstance(s, Text)], [s for s in body.shapes if isinstance(s, Line)]


def any_table(seed: int) -> tuple[View, Style, list[list[str | None]]]:
    chance = random.Random(seed)
    style = STYLES[chance.choice([*STYLES])]
    kinds = [chance.choice((SYMBOLS, NUMBERS, NUMBERS, UNITS, WORDS)) for _ in range(chance.randint(1, 6))]
    rows: list[list[str | None]] = [["Познач."] * len(kinds)]
    rows += [[chance.choice(kind) for kind in kinds] for _ in range(chance.randint(1, 12))]
    if len(kinds) > 2 and chance.random() < 0.3:
        rows[-1][1] = None
    return table("t", "Вихідні дані", rows, style), style, rows


@pytest.mark.parametrize("seed", CASES)
def test_capitals_stand_in_the_middle_of_their_rows_clear_of_the_lines(seed: int) -> None:
    view, style, rows = any_table(seed)

    texts, lines = drawn(view)

    levels = sorted({round(line.a.imag, 6) for line in lines if line.a.imag == line.b.imag}, reverse=True)
    heights = [a - b for a, b in pairwise(levels)]
    assert len(heights) == len(rows)
    assert min(heights) >= 2.0 * style.text - 1e-5
    for text in texts:
        top, bottom = next((a, b) for a, b in pairwise(levels) if a > text.at.imag > b)
        assert text.at.imag + 0.5 * style.text == pytest.approx(0.5 * (top + bottom), abs=1e-5)
        _, low, _, high = extent((text,))
        assert low > bottom + 0.12 * style.text
        assert high < top - 0.12 * style.text


@pytest.mark.parametrize("seed", CASES)
def test_numbers_of_a_column_stand_with_their_commas_under_one_another(seed: int) -> None:
    view, style, rows = any_table(seed)
    spans = None in rows[-1]

    texts, lines = drawn(view)

    edges = sorted({round(line.a.real, 6) for line in lines if line.a.real == line.b.real})
    commas: dict[int, set[float]] = {}
    for text in texts:
        left, _, right, _ = extent((text,))
        column = sum(edge < left for edge in edges) - 1
        assert edges[column] + 1.5 < left  # clear of the lines on both sides
        if not (spans and text.at.imag == texts[-1].at.imag):  # one of these may go on over the next column
            assert min(edge for edge in edges if edge > left) > right + 1.5
        if spans and column == 0 and text.at.imag == texts[-1].at.imag:
            continue  # it goes on over the next column
        if number := re.fullmatch(r"(−?\d+)([.,]\d+)?", text.markup):
            start = placer(text)(0.0, 0.0).real
            commas.setdefault(column, set()).add(round(start + lay_out(number[1], style.text).width, 6))
    assert all(max(places) - min(places) < 1e-5 for places in commas.values())


def test_symbols_stand_in_the_middle_of_a_column_that_has_sentences_too() -> None:
    style = STYLES["A1"]
    view = table("givens", "Givens", [["Symbol"], ["l_{OA}"], ["rotation of link 1"]], style)

    symbol, sentence = (text for text in drawn(view)[0] if text.markup != "Symbol")

    assert symbol.anchor == "middle"
    assert symbol.at.real == pytest.approx(0.5 * (view.box[0] + view.box[2]), abs=0.01)
    assert sentence.anchor == "left"


def test_what_stands_in_several_columns_has_room_between_their_edges() -> None:
    """The part of a table that goes on elsewhere may have nothing else in the last of its columns."""
    view = table("t", "t", [["Quantity", "Value", None], ["p", "15.708", None], ["q", "123.456", None]], STYLES["A3"])
    cells, lines = drawn(view)
    left, right = (edge(line.a.real for line in lines if line.a.real == line.b.real) for edge in (min, max))
    value = next(text for text in cells if text.markup == "123.456")
    half = lay_out(value.markup, value.height).width / 2

    assert left < value.at.real - half
    assert value.at.real + half < right - 1.0


@pytest.mark.parametrize("seed", CASES)
def test_lines_of_a_block_are_far_enough_apart_to_keep_underlines_and_bars_asunder(seed: int) -> None:
    chance = random.Random(seed)
    style = STYLES[chance.choice([*STYLES])]
    block = [[chance.choice(LINES) for _ in range(chance.randint(1, 3))] for _ in range(8)]

    texts, _ = drawn(text_block("b", "Рівняння", block, style, 40.0 * style.text))

    for above, below in pairwise(texts):
        assert above.at.imag - below.at.imag >= 1.7 * style.text - 1e-9
        own, other = lay_out(above.markup, style.text), lay_out(below.markup, style.text)
        between = above.at.imag + own.bottom - below.at.imag - other.top
        under = [rule for rule in own.rules if rule[1] < 0.0]
        assert between > (0.7 if under else 0.3) * style.text  # two underlines are 0.22 apart


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_arrowheads_are_six_to_ten_line_widths_long_and_all_of_one_size(name: str, norm: str) -> None:
    sheet = FORMATS[name]

    pens = pens_for(sheet.width, sheet.height, norm)  # type: ignore[arg-type]

    assert 6.0 - 1e-9 <= pens.arrow / pens.main <= 10.0
    assert pens.arrow >= 2.5
    assert STYLES[sheet.letters].arrow == pens.arrow


@pytest.mark.parametrize("seed", CASES)
def test_texts_of_level_dimensions_stand_over_their_lines_or_over_these_drawn_on(seed: int) -> None:
    chance = random.Random(seed)
    style = STYLES[chance.choice([*STYLES])]
    canvas, text = Canvas(style), chance.choice(("e", "b_{0} = 3,000 м", "φ_{вв} = 15°"))
    level, x0, reach = chance.uniform(-50, 50), chance.uniform(-50, 50), chance.uniform(3.0, 60.0)
    bodies = chance.uniform(0.0, 4.0), chance.uniform(0.0, 4.0)
    out = chance.choice((-1j, 1j)) * chance.uniform(8.0, 20.0)
    ends = complex(x0, level), complex(x0 + reach, level)

    linear(canvas, ends, out, text, "d", bodies=bodies)

    view = canvas.finish("v")
    (written,) = (shape for shape in view.shapes if isinstance(shape, Text))
    (group,) = (shape for shape in view.shapes if isinstance(shape, Group))
    lines = [shape for shape in view.shapes if isinstance(shape, Line)]
    (own,) = (shape for shape in group.shapes if isinstance(shape, Line))
    shelf = [line for line in lines if line.role == "shelf"]
    left, low, right, _ = extent((written,))
    assert 0.8 < low - own.a.imag < 1.0 + 0.2 * style.arrow  # over the heads where it is as long
    whole = [end.real for line in (own, *shelf) for end in (line.a, line.b)]
    assert min(whole) <= left + 1e-6
    assert max(whole) >= right - 1e-6
    for line, end, body in zip((line for line in lines if line.role == "extension"), ends, bodies, strict=True):
        assert abs(line.a - end) == pytest.approx(body)
        assert not left < line.a.real < right  # no extension line runs through the text
    assert bool(shelf) == (reach <= lay_out(text, style.text).width + 2.0)


@pytest.mark.parametrize("seed", CASES)
def test_heads_of_a_dimensioned_angle_touch_its_rays_from_inside_or_from_outside(seed: int) -> None:
    chance = random.Random(seed)
    style = STYLES[chance.choice([*STYLES])]
    radius, start = chance.uniform(2.5, 12.0) * style.arrow, chance.uniform(-4.0, 4.0)
    sweep = chance.choice((-1.0, 1.0)) * chance.uniform(0.1, 1.5)

    group = angle_dimension(0j, radius, start, sweep, "phi", style)

    own, *tails = (shape for shape in group.shapes if isinstance(shape, Arc))
    heads = [shape for shape in group.shapes if isinstance(shape, Head)]
    assert (own.start, own.sweep) == (start, sweep)
    assert len(heads) == 2
    for head, end in zip(heads, (start + sweep, start), strict=True):
        assert head.tip == pytest.approx(cmath.rect(radius, end))
        foot = head.tip - head.direction / abs(head.direction) * style.arrow
        assert abs(foot) == pytest.approx(radius, rel=0.05)  # it lies along the arc
        turned = cmath.phase(foot / cmath.rect(1.0, start + 0.5 * sweep))
        assert (abs(turned) < 0.5 * abs(sweep)) == (not tails)
    assert bool(tails) == (radius * abs(sweep) <= 2.5 * style.arrow)


@pytest.mark.parametrize(
    ("lines", "ray"),
    [((), 1j), ((1j,), -1j), ((-1j,), 1j), ((1j, -1.0 + 0j), -1j), ((1.0 + 0j,), 1j), ((1.0 + 2j, -1.0 + 1.9j), -1j)],
)
def test_an_arrow_lies_where_links_leave_it_more_room_and_points_as_it_should(
    lines: tuple[complex, ...], ray: complex
) -> None:
    assert clear_ray(1j, lines) == ray
