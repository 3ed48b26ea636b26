"""SVG: what is written is read back as it was drawn, and the same page gives the same bytes."""

import math
import time
from collections import Counter
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
from lxml import etree

from kulman.drawing.page import Page, _reach, extent
from kulman.drawing.pens import pens_for
from kulman.drawing.shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Text, Vector
from kulman.drawing.svg import svg_text
from kulman.drawing.svg import write as write_svg
from kulman.drawing.text import lay_out
from kulman.drawing.walk import Walk

GOLDEN = Path(__file__).parent / "golden" / "one-of-each.svg"
SVG = "{http://www.w3.org/2000/svg}"
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


def page(*shapes, language="uk"):
    return Page(210, 297, shapes, "План", language)


def read(drawn):
    stream = BytesIO()
    write_svg([drawn], stream)
    return etree.fromstring(stream.getvalue())


def without_font(text):
    return "".join(line for line in text.splitlines(keepends=True) if not line.startswith("@font-face"))


def test_the_page_is_in_millimetres():
    root = read(page())

    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("210mm", "297mm", "0 0 210 297")
    assert root.findtext(f"{SVG}title") == "План"
    assert root.get("{http://www.w3.org/XML/1998/namespace}lang") == "uk"


@pytest.mark.parametrize("tip", [50 + 150j + 90.697j, 70.1234567 + 151j, 53 + 150j, 51 + 150j, 50 + 150j])
def test_a_vector_is_read_back_with_all_digits(tip):
    vector = replace(ONE_OF_EACH[6], tip=tip)

    group = read(page(vector)).find(f"{SVG}g")

    line = group.find(f"{SVG}line")
    ends = [complex(float(line.get(f"x{n}")), 297 - float(line.get(f"y{n}"))) for n in (1, 2)]
    assert ends == pytest.approx([vector.tail, vector.tip], abs=1e-6)
    assert float(group.get("data-value")) == vector.value
    assert float(group.get("data-mu")) == vector.mu
    assert (group.get("class"), group.get("data-quantity"), group.get("data-unit")) == ("vector", "V_B", "m/s")
    assert group.findtext(f"{SVG}title") == "V_B = 4,53 м/с <B>"


def test_a_zero_vector_is_a_dot_and_keeps_its_line():
    group = read(page(replace(ONE_OF_EACH[6], tip=50 + 150j, value=0.0))).find(f"{SVG}g")

    line, dot = group.find(f"{SVG}line"), group.find(f"{SVG}circle")
    assert (line.get("x1"), line.get("y1")) == (line.get("x2"), line.get("y2"))
    assert (float(dot.get("cx")), 297 - float(dot.get("cy"))) == (50, 150)


@pytest.mark.parametrize("length", [100.0, 5.1, 3.0, 1.0])
def test_heads_have_one_size_and_point_along_the_arrow(length):
    group = read(page(Arrow(10 + 10j, 10 + 10j + length * 1j))).find(f"{SVG}g")

    corners = [complex(*map(float, pair.split(","))) for pair in group.find(f"{SVG}polygon").get("points").split()]
    tip, left, right = (corner.real + (297 - corner.imag) * 1j for corner in corners)
    assert abs(tip - (left + right) / 2) == pytest.approx(pens_for(210, 297).arrow, abs=1e-6)
    assert (tip - (left + right) / 2).imag > 0
    if length >= 5.0 or length <= 2.5:
        assert tip == pytest.approx(10 + 10j + length * 1j, abs=1e-6)


def test_nothing_that_is_drawn_is_transformed():
    root = read(page(*ONE_OF_EACH))

    assert {element.tag for element in root.iter() if element.get("transform")} == {f"{SVG}text"}


def test_shapes_carry_their_role_and_name():
    root = read(page(*ONE_OF_EACH))

    found = {(element.get("class"), element.get("data-name")) for element in root.iter() if element.get("data-name")}
    names = {("guide", "x"), ("point", "A"), ("angle", "phi"), ("arrow", "rotation"), ("view", "velocity")}
    assert found == names | {("label", "V_B")}


def test_runs_of_a_text_stand_where_its_layout_says():
    text = Text(60 + 200j, "a^{n}_{BA} = 5", 3.5, "right")
    layout = lay_out(text.markup, 3.5)

    elements = list(read(page(text)).iter(f"{SVG}text"))

    start = 60 - layout.width
    for element, run in zip(elements, layout.runs, strict=True):
        place = complex(float(element.get("x")), 297 - float(element.get("y")))
        assert place == pytest.approx(complex(start + run.x, 200 + run.y), abs=1e-6)
        assert float(element.get("font-size")) == pytest.approx(run.size, abs=1e-6)
        assert element.text == run.string


def test_a_squeezed_text_keeps_its_place():
    element = read(page(Text(60 + 200j, "Заболотна", 2.5, squeeze=0.5))).find(f"{SVG}text")

    a, b, c, d, e, f = map(float, element.get("transform")[len("matrix(") : -1].split())
    x, y = float(element.get("x")), float(element.get("y"))
    assert (a * x + c * y + e, b * x + d * y + f) == pytest.approx((x, y), abs=1e-5)
    assert (a, b, c, d) == pytest.approx((0.5, 0, 0, 1), abs=1e-6)


@pytest.mark.parametrize("sweep", [0.5, -0.5, 3.0, -6.0])
def test_arcs_run_the_way_they_are_meant(sweep):
    path = read(page(Arc(100 + 100j, 20, 0.3, sweep))).find(f"{SVG}path").get("d")

    numbers = [float(part) for part in path.replace("M", "").replace("A", " ").split()]
    ends = [complex(x, 297 - y) - (100 + 100j) for x, y in zip(numbers[7::7], numbers[8::7], strict=True)]
    turn = 0 if sweep > 0 else 1  # y points down in the file
    assert set(numbers[6::7]) == {turn}
    assert set(numbers[5::7]) == {0}  # no large arcs
    assert ends[-1] == pytest.approx(20 * complex(math.cos(0.3 + sweep), math.sin(0.3 + sweep)), abs=2e-6)


@pytest.mark.parametrize("pen", [Pen.DASHED, Pen.AXIS])
@pytest.mark.parametrize("length", [3.0, 17.0, 40.0, 123.456])
def test_dashed_lines_start_and_end_with_a_dash(pen, length):
    dashes = pens_for(210, 297).dashes(pen, length)

    repeats = (length - dashes[0]) / sum(dashes) if dashes else 0
    assert repeats == pytest.approx(round(repeats), abs=1e-9)
    if dashes:
        assert 0.7 < dashes[0] / (pens_for(210, 297).dashed if pen is Pen.DASHED else pens_for(210, 297).axis)[0] < 1.5


@pytest.mark.parametrize("norm", ["gost", "iso"])
@pytest.mark.parametrize(
    ("size", "thinnest"), [((841, 594), 0.3), ((594, 420), 0.25), ((420, 297), 0.25), ((210, 297), 0.2)]
)
def test_two_widths_serve_a_sheet(norm, size, thinnest):
    pens = pens_for(*size, norm)

    assert pens.main / 3 <= pens.thin <= pens.main / 2
    assert pens.main >= 0.5
    assert pens.thin >= thinnest
    assert pens.arrow >= 2.5


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(
    "shape",
    [
        lambda bad: Line(0j, complex(bad, 1)),
        lambda bad: Circle(1 + 1j, bad),
        lambda bad: Text(complex(1, bad), "A"),
        lambda bad: Vector(0j, 1 + 1j, "V", bad, "m/s", 1.0),
        lambda bad: Polyline((0j, complex(bad, 0))),
    ],
)
def test_what_is_not_a_number_is_refused(bad, shape):
    with pytest.raises(ValueError):
        svg_text(page(shape(bad)))


def test_control_characters_never_reach_the_file():
    assert read(Page(210, 297, (), "a\x00\x0bb", "en")).findtext(f"{SVG}title") == "ab"


class Tally(Walk):
    """A writer that counts what it is told to put down."""

    def __init__(self, page):
        super().__init__(page)
        self.counts, self.open = Counter(), []

    def stroke(self, shape, dashes):
        self.counts["stroke"] += 1
        self.counts["dashed"] += bool(dashes)

    def head(self, corners, colour):
        self.counts["head"] += 1

    def letters(self, text, runs, alone):
        self.counts["text"] += len(runs)

    def begin(self, part):
        self.open.append(part)

    def end(self, part):
        assert self.open.pop() is part
        self.counts["g"] += 1


def test_every_writer_is_told_the_same_of_a_page():
    drawn = replace(page(*ONE_OF_EACH), layers=True)
    tally, root = Tally(drawn), read(drawn)
    seen = [element for element in root.iter() if element.get("class") not in ("span", None) or element.get("x")]

    tally.whole()

    kinds = Counter("head" if e.get("class") == "head" else etree.QName(e).localname for e in seen)
    strokes = sum(kinds[kind] for kind in ("line", "polygon", "polyline", "circle", "path"))
    found = {"stroke": strokes, "dashed": len(root.findall(".//*[@stroke-dasharray]"))}
    assert tally.counts == {**found, "head": kinds["head"], "text": kinds["text"], "g": kinds["g"]}
    assert tally.open == []


def test_the_same_page_gives_the_same_bytes_later():
    first = svg_text(page(*ONE_OF_EACH))
    time.sleep(1.1)

    assert svg_text(page(*ONE_OF_EACH)) == first


def test_one_of_each_shape_is_drawn_as_before():
    assert without_font(svg_text(page(*ONE_OF_EACH))) == GOLDEN.read_text(encoding="utf-8")


def test_the_comparison_with_the_golden_drawing_can_fail():
    moved = replace(ONE_OF_EACH[0], b=205.00001 + 292j)

    assert without_font(svg_text(page(moved, *ONE_OF_EACH[1:]))) != GOLDEN.read_text(encoding="utf-8")


@pytest.mark.parametrize("sweep", [math.tau, 1e5, -1e5])
def test_an_arc_covers_a_circle_however_often_it_goes_round(sweep: float):
    arc = Arc(1.0 + 2.0j, 5.0, 0.0, sweep)

    assert extent([arc]) == pytest.approx((-4.0, -3.0, 6.0, 7.0), abs=1e-6)
    assert len(_reach(arc)) <= 7  # not one for every quarter of a turn
