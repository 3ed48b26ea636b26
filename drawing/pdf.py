"""The PDF writer: the same shapes in points, with selectable text in an embedded subset of the font."""

from __future__ import annotations

from cmath import rect
from collections.abc import Sequence
from contextlib import closing
from functools import cache, lru_cache
from io import BytesIO
from math import ceil, cos, pi, sin, tan
from typing import TYPE_CHECKING, BinaryIO, assert_never
from zlib import compress

from .font import font
from .layers import Layer, parts_of
from .page import Page
from .pdf_layers import DocumentLayers, opened
from .pens import Pens, arrow_parts, head_outline, length_of
from .shapes import Arc, Arrow, Circle, Fill, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from .text import lay_out, placer

if TYPE_CHECKING:
    from reportlab.pdfbase.pdfdoc import PDFStream
    from reportlab.pdfbase.ttfonts import TTFont
    from reportlab.pdfgen.canvas import Canvas

POINT = 72 / 25.4  # points in a millimetre
FONT = "DejaVuSans"
BLACK = "#000"
QUICK = 4  # how hard zlib tries
_SOLID = (Pen.MAIN, Pen.THIN)


def write_pdf(pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write pages as one PDF document; the same pages give the same bytes.

    Raises
    ------
    ValueError
        A coordinate is not a finite number.
    """
    canvas, out = new_canvas(pages[0])
    document = DocumentLayers(canvas, pages[0].language)
    for page in pages:
        canvas.setPageSize((page.width * POINT, page.height * POINT))
        layers = draw_page(canvas, page)
        canvas.showPage()
        shown = canvas._doc.Pages.pages[-1]
        shown.Resources = document.resources(layers)
        shown.Contents = _packed(shown.stream)
    document.close()
    canvas.save()
    stream.write(out.getvalue())


def new_canvas(page: Page) -> tuple[Canvas, BytesIO]:
    """Return an empty document with the title and language of `page`, and the stream it will fill."""
    from reportlab.pdfgen.canvas import Canvas

    _font()
    out = BytesIO()
    size = (page.width * POINT, page.height * POINT)
    canvas = Canvas(
        out,
        pagesize=size,
        invariant=1,
        pageCompression=1,
        lang=page.language,
        initialFontName=FONT,
        pdfVersion=(1, 5),  # the first with layers
    )
    canvas.setTitle(page.title)
    canvas.setAuthor("")
    canvas.setCreator("Kulman")
    canvas.setViewerPreference("DisplayDocTitle", "true")
    return canvas, out


@cache
def _font() -> TTFont:
    """Return reportlab's view of the font, registered once for the life of the program."""
    from reportlab import rl_config
    from reportlab.pdfbase.pdfmetrics import registerFont
    from reportlab.pdfbase.ttfonts import TTFont

    with closing(BytesIO(font().data)) as data:
        face = TTFont(FONT, data)
    registerFont(face)
    rl_config.useA85 = 0  # its base 85, in Python, takes longer than all the rest of a page
    return face


def _packed(code: str) -> PDFStream:
    """Return what a page draws, compressed: at this level in half the time, and only 3 % larger."""
    from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFName, PDFStream

    return PDFStream(PDFDictionary({"Filter": PDFName("FlateDecode")}), compress(code.encode("ascii"), QUICK))


def draw_page(canvas: Canvas, page: Page) -> list[Layer]:
    """Draw a page layer by layer on a canvas whose unit is the point and whose y points up; return its layers."""
    canvas.saveState()
    writer = _Writer(canvas, page.pens)
    parts = parts_of(page)
    for layer, shapes in parts:
        if layer is not None:
            writer.put(opened(layer))
        for shape in shapes:
            writer.draw(shape)
        if layer is not None:
            writer.put("EMC")
    canvas.restoreState()
    return [layer for layer, _ in parts if layer is not None]


def draw_shapes(canvas: Canvas, shapes: Sequence[Shape], pens: Pens) -> None:
    """Draw shapes of no layer on a canvas whose unit is the point and whose y points up."""
    canvas.saveState()
    writer = _Writer(canvas, pens)
    for shape in shapes:
        writer.draw(shape)
    canvas.restoreState()


def _place(point: complex) -> str:
    """Return a point of the sheet in points, to 1e-4 of them."""
    text = f"{point.real * POINT:.4f} {point.imag * POINT:.4f}"
    if "n" in text:  # inf, nan
        raise ValueError(f"not a place on a sheet: {point}")
    return text


@cache
def _channels(colour: str) -> str:
    """Return red, green and blue of `#rrggbb` or `#rgb`, from 0 to 1."""
    digits = colour.removeprefix("#")
    if len(digits) == 3:
        digits = "".join(digit * 2 for digit in digits)
    return " ".join(f"{int(digits[at : at + 2], 16) / 255:.4g}" for at in (0, 2, 4))


class _Writer:
    """Draws shapes as operators of the page, and changes the pen only when it has to.

    Lines and letters are put down as literal operators: the canvas's own methods take three times as long.
    """

    def __init__(self, canvas: Canvas, pens: Pens) -> None:
        self.put = canvas.addLiteral
        self.document = canvas._doc
        self.font = _font()
        self.pens = pens
        self.inked: tuple[object, ...] = ()
        self.filled = ""
        self.lettered = ""
        self.codes: dict[tuple[str, float], list[tuple[str, str]]] = {}

    def draw(self, shape: Shape) -> None:
        """Draw one shape."""
        match shape:
            case Line(a=a, b=b):
                self.ink(shape)
                self.put(f"{_place(a)} m {_place(b)} l S")
            case Polyline(points=points, closed=closed, fill=fill, colour=colour):
                self.ink(shape)
                self.fill(fill, colour)
                self.put(f"{_outline(points)} {_paint(closed, fill)}")
            case Circle(centre=centre, radius=radius, fill=fill, colour=colour):
                self.ink(shape)
                self.fill(fill, colour)
                self.put(f"{_curve(centre, radius, 0.0, 2 * pi)} {_paint(True, fill)}")
            case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
                self.ink(shape)
                self.put(f"{_curve(centre, radius, start, sweep)} S")
            case Head(colour=colour):
                self.fill(True, colour)
                self.put(f"{_outline(head_outline(shape, self.pens))} h f")
            case Text():
                self.text(shape)
            case Vector() | Arrow():
                _place(shape.tail), _place(shape.tip)  # refuse what is not a number before its direction is taken
                for part in arrow_parts(shape, self.pens):
                    self.draw(part)
            case Group(shapes=shapes):
                for part in shapes:
                    self.draw(part)
            case _:
                assert_never(shape)

    def ink(self, shape: Line | Polyline | Circle | Arc) -> None:
        """Set width, dashes and colour of the lines to come."""
        dashes = () if shape.pen in _SOLID else self.pens.dashes(shape.pen, length_of(shape))
        wanted = (self.pens.width(shape.pen), dashes, shape.colour or BLACK)
        if wanted != self.inked:
            self.inked = wanted
            pattern = " ".join(f"{dash * POINT:.5f}" for dash in dashes)
            self.put(f"{wanted[0] * POINT:.5f} w [{pattern}] 0 d {_channels(wanted[2])} RG")

    def fill(self, fill: Fill, colour: str | None) -> None:
        """Set the colour of areas and letters to come."""
        if fill is False:
            return
        wanted = "#fff" if fill == "white" else BLACK if fill == "black" else colour or BLACK
        if wanted != self.filled:
            self.filled = wanted
            self.put(f"{_channels(wanted)} rg")

    def text(self, text: Text) -> None:
        """Draw the runs of a text as one text object, and its rules as thin lines."""
        lines = lay_out(text.markup, text.height)
        self.fill(True, text.colour)
        turn, place = _turn(text.angle, text.squeeze), placer(text)
        words = ["BT"]
        for run in lines.runs:
            words += (turn, _place(place(run.x, run.y)), "Tm")
            for face, shown in self.shown(run.string, run.size):
                if face != self.lettered:
                    self.lettered = face
                    words.append(face)
                words.append(shown)
        words.append("ET")
        self.put(" ".join(words))
        for x0, y0, x1, y1 in lines.rules:
            self.draw(Line(place(x0, y0), place(x1, y1), Pen.THIN, colour=text.colour))

    def shown(self, string: str, size: float) -> list[tuple[str, str]]:
        """Return what sets the font and what shows characters of one size, for each subset of the font they are in."""
        codes = self.codes.get((string, size))
        if codes is None:
            faces, big = self.font.getSubsetInternalName, f"{size * POINT:.5f}"
            split = self.font.splitString(string, self.document)
            codes = [(f"{faces(subset, self.document)} {big} Tf", f"<{code.hex()}> Tj") for subset, code in split]
            self.codes[string, size] = codes
        return codes


@lru_cache(maxsize=64)
def _turn(angle: float, squeeze: float) -> str:
    """Return the first four numbers of the matrix of a turned or squeezed text."""
    c, s, k = cos(angle), sin(angle), squeeze
    return " ".join(f"{part:.6f}".rstrip("0").rstrip(".") for part in (k * c, k * s + 0.0, 0.0 - s, c))


def _outline(points: tuple[complex, ...]) -> str:
    return f"{_place(points[0])} m " + " ".join(f"{_place(point)} l" for point in points[1:])


def _paint(closed: bool, fill: Fill) -> str:
    """Return the operator that strokes a path, closed and filled as asked."""
    return ("S" if fill is False else "B") if not closed else ("s" if fill is False else "b")


def _curve(centre: complex, radius: float, start: float, sweep: float) -> str:
    """Return an arc as cubic curves of at most 45 degrees each: 4e-6 of the radius from the circle."""
    pieces = max(1, ceil(abs(sweep) / (pi / 4) - 1e-9))
    step = sweep / pieces
    pull = 4 / 3 * tan(step / 4) * 1j
    here = rect(radius, start)
    path = f"{_place(centre + here)} m"
    for index in range(pieces):
        there = rect(radius, start + step * (index + 1))
        ends = (here + here * pull, there - there * pull, there)
        path += f" {' '.join(_place(centre + end) for end in ends)} c"
        here = there
    return path
