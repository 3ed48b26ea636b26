"""PDF: the same places as in the drawing, text that can be searched, and the same bytes again."""

import math
import re
import time
from io import BytesIO

import pytest
from pdfminer.high_level import extract_pages, extract_text
from pdfminer.layout import LTChar, LTCurve, LTLine
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfparser import PDFParser

from kulman.drawing.page import Page
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.shapes import Arc, Circle, Line, Pen, Polyline, Text, Vector

MM = 25.4 / 72


def written(*pages):
    stream = BytesIO()
    write_pdf(pages, stream)
    return BytesIO(stream.getvalue())


def page(*shapes, size=(420, 297)):
    return Page(*size, shapes, "План швидкостей", "uk")


def parts(element, kind):
    found = [element] if isinstance(element, kind) else []
    return found + [part for child in getattr(element, "_objs", []) for part in parts(child, kind)]


def test_lines_lie_where_they_were_drawn():
    ends = [(20 + 5j, 415 + 292j), (33.333333 + 7j, 100 + 99.99999j)]

    sheet = next(iter(extract_pages(written(page(*(Line(a, b) for a, b in ends))))))

    found = [(complex(*line.pts[0]) * MM, complex(*line.pts[1]) * MM) for line in parts(sheet, LTLine)]
    assert (sheet.width * MM, sheet.height * MM) == pytest.approx((420, 297), abs=1e-4)
    assert [point for pair in found for point in pair] == pytest.approx([p for pair in ends for p in pair], abs=1e-4)


@pytest.mark.parametrize("shape", [Circle(100 + 100j, 60), Arc(100 + 100j, 60, 1.0, -4.0)])
def test_curves_stay_on_their_circle(shape):
    sheet = next(iter(extract_pages(written(page(shape)))))

    (curve,) = parts(sheet, LTCurve)
    points = [complex(*step[-1]) for step in curve.original_path if step[0] != "h"]
    assert [abs(point * MM - (100 + 100j)) for point in points] == pytest.approx([60] * len(points), abs=1e-4)


def test_text_can_be_searched_and_stands_in_its_place():
    drawn = page(Text(60 + 200j, "Прискорення точки S_{2}", 5.0), Text(60 + 100j, "Затв.", 2.5, squeeze=0.5))

    stream = written(drawn)

    text = extract_text(stream)
    assert "Прискорення точки" in text
    assert "Затв." in text
    letters = parts(next(iter(extract_pages(stream))), LTChar)
    assert complex(*letters[0].matrix[4:]) * MM == pytest.approx(60 + 200j, abs=1e-3)


def test_every_page_has_its_own_size():
    sheets = list(extract_pages(written(page(), page(size=(210, 297)))))

    assert [round(sheet.width * MM) for sheet in sheets] == [420, 210]


def test_title_and_language_are_stated():
    document = PDFDocument(PDFParser(written(page())))

    assert document.catalog["Lang"] == b"uk"
    assert document.info[0]["Title"].decode("utf-16") == "План швидкостей"


def test_only_the_embedded_font_is_used():
    stream = written(page(Text(60 + 200j, "Прискорення", 5.0))).getvalue()

    assert set(re.findall(rb"/BaseFont /(?:\w+\+)?([\w-]+)", stream)) == {b"DejaVuSans"}


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_what_is_not_a_number_is_refused(bad):
    for shape in (
        Line(0j, complex(bad, 1)),
        Circle(1 + 1j, bad),
        Text(complex(1, bad), "A"),
        Vector(0j, complex(bad, bad), "V", 1.0, "m/s", 1.0),
        Polyline((0j, complex(bad, 0)), Pen.AXIS),
    ):
        with pytest.raises(ValueError):
            written(page(shape))


def test_the_same_pages_give_the_same_bytes_later():
    drawn = page(Line(0j, 10 + 10j), Text(60 + 200j, "Прискорення", 5.0))
    first = written(drawn).getvalue()
    time.sleep(1.1)

    assert written(drawn).getvalue() == first
