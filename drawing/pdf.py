"""The PDF writer: the same shapes in points, with selectable text in an embedded subset of the font, in layers.

Pages as large as they are, or spread over small paper; a PNG is a picture of one.
"""

from __future__ import annotations

import re
from cmath import rect
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import cache, lru_cache
from io import BytesIO
from itertools import pairwise
from math import ceil, cos, pi, sin, tan
from typing import TYPE_CHECKING, BinaryIO
from zlib import compress

from ..scales.errors import InputError
from ..scales.numbers import quote
from .font import UPRIGHT, font
from .page import BLACK, Layer, Page, Part, Stroke, Walk, filled
from .shapes import Arc, Arrow, Circle, Group, Line, Pen, Polyline, Shape, Text, Vector
from .text import Box, Run

if TYPE_CHECKING:
    from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFResourceDictionary
    from reportlab.pdfbase.ttfonts import TTFont
    from reportlab.pdfgen.canvas import Canvas


POINT = 72 / 25.4  # points in a millimetre
FONT = "letters"
QUICK = 4  # how hard zlib tries
PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}  # small paper, mm
MARGIN = 10.0  # of small paper, mm: no printer reaches its edge
OVERLAP = 10.0  # mm of small sheets, to glue on
MARK = 5.0  # length of a cut mark, mm


class _Document:
    """An empty document with the title and language of a page, and its layers.

    Layers are optional content groups (ISO 32000-1, 8.11), which readers list, show and hide: pages name them as
    resources, the catalog says which are shown at first.
    """

    def __init__(self, page: Page) -> None:
        from reportlab.pdfgen.canvas import Canvas

        _font(UPRIGHT)
        self.canvas = Canvas(
            BytesIO(),
            pagesize=(page.width * POINT, page.height * POINT),
            invariant=1,
            pageCompression=1,
            lang=page.language,
            initialFontName=f"{FONT}-{UPRIGHT}",
            pdfVersion=(1, 5),  # the first with layers
        )
        self.canvas.setTitle(page.title)
        self.canvas.setAuthor("")
        self.canvas.setCreator("Kulman")
        self.canvas.setViewerPreference("DisplayDocTitle", "true")
        self.language = page.language
        self.groups: dict[Layer, PDFDictionary] = {}

    def resources(self, layers: Iterable[Layer]) -> PDFResourceDictionary:
        """Return the resources of a page or form on which these layers are."""
        from reportlab.pdfbase.pdfdoc import PDFResourceDictionary

        found = PDFResourceDictionary(Properties={layer.value: self._reference(layer) for layer in layers})
        found.basicFonts()
        return found

    def data(self) -> bytes:
        """Return the whole file; its catalog tells of the layers of all pages, if there are any."""
        from reportlab.pdfbase.pdfdoc import PDFArray, PDFDictionary

        if self.groups:
            listed = [layer for layer in Layer if layer in self.groups]
            hidden = PDFArray([self._reference(layer) for layer in listed if layer.hidden])
            groups = PDFArray([self._reference(layer) for layer in listed])
            catalog = self.canvas._doc.Catalog
            catalog.__NoDefault__ = [*catalog.__NoDefault__, "OCProperties"]  # it writes the entries that it lists
            catalog.OCProperties = PDFDictionary({"OCGs": groups, "D": PDFDictionary({"Order": groups, "OFF": hidden})})
        return bytes(self.canvas.getpdfdata())

    def _reference(self, layer: Layer) -> object:
        from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFName, PDFString

        if layer not in self.groups:
            title = PDFString(layer.title(self.language))
            self.groups[layer] = PDFDictionary({"Type": PDFName("OCG"), "Name": title})
        return self.canvas._doc.Reference(self.groups[layer], f"layer-{layer.value}")


def write(pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write pages as one PDF document; the same pages give the same bytes.

    Raises ValueError: a coordinate is not a finite number.
    """
    from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFName, PDFStream

    document = _Document(pages[0])
    canvas = document.canvas
    for page in pages:
        canvas.setPageSize((page.width * POINT, page.height * POINT))
        layers = _draw_page(canvas, page)
        canvas.showPage()
        shown = canvas._doc.Pages.pages[-1]
        shown.Resources = document.resources(layers)
        # compressed at this level in half the time, and only 3 % larger
        packed = compress(shown.stream.encode("ascii"), QUICK)
        shown.Contents = PDFStream(PDFDictionary({"Filter": PDFName("FlateDecode")}), packed)
    stream.write(document.data())


@cache
def _font(name: str) -> TTFont:
    """Return reportlab's view of a face, registered once for the life of the program."""
    from reportlab import rl_config
    from reportlab.pdfbase.pdfmetrics import registerFont
    from reportlab.pdfbase.ttfonts import TTFont

    with closing(BytesIO(font(name).data)) as data:
        face = TTFont(f"{FONT}-{name}", data)
    registerFont(face)
    rl_config.useA85 = 0  # its base 85, in Python, takes longer than all the rest of a page
    return face


def _draw_page(canvas: Canvas, page: Page) -> list[Layer]:
    """Draw a page layer by layer on a canvas whose unit is the point and whose y points up; return its layers."""
    canvas.saveState()
    walk = _Walk(page, canvas)
    walk.whole()
    canvas.restoreState()
    return walk.layers


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


class _Walk(Walk):
    """Puts shapes down as operators of the page, and changes the pen only when it has to.

    Lines and letters are literal operators: the canvas's own methods take three times as long.
    """

    def __init__(self, page: Page, canvas: Canvas) -> None:
        super().__init__(page)
        self.put = canvas.addLiteral
        self.document = canvas._doc
        self.layers: list[Layer] = []
        self.inked: tuple[object, ...] = ()
        self.filled = ""
        self.lettered = ""
        self.codes: dict[tuple[str, float, str], list[tuple[str, str]]] = {}

    def stroke(self, shape: Stroke, dashes: tuple[float, ...]) -> None:
        """Put down a path, in the pen and the colour of areas that it wants."""
        wanted = (self.pens.width(shape.pen), dashes, shape.colour or BLACK)
        if wanted != self.inked:
            self.inked = wanted
            pattern = " ".join(f"{dash * POINT:.5f}" for dash in dashes)
            self.put(f"{wanted[0] * POINT:.5f} w [{pattern}] 0 d {_channels(wanted[2])} RG")
        closed, filling = isinstance(shape, Circle), None
        match shape:
            case Line(a=a, b=b):
                path = f"{_place(a)} m {_place(b)} l"
            case Polyline(points=points):
                path, closed, filling = _outline(points), shape.closed, filled(shape)
            case Circle(centre=centre, radius=radius):
                path, filling = _curve(centre, radius, 0.0, 2 * pi), filled(shape)
            case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
                path = _curve(centre, radius, start, sweep)
        self.fill(filling)
        self.put(f"{path} {_PAINT[closed, filling is not None]}")

    def fill(self, wanted: str | None) -> None:
        """Set the colour of areas and letters to come, if there are any."""
        if wanted is not None and wanted != self.filled:
            self.filled = wanted
            self.put(f"{_channels(wanted)} rg")

    def head(self, corners: tuple[complex, complex, complex], colour: str) -> None:
        """Put down a triangle."""
        self.fill(colour)
        self.put(f"{_outline(corners)} h f")

    def letters(self, text: Text, runs: Sequence[tuple[Run, complex]], alone: bool) -> None:
        """Put down runs as one text object."""
        self.fill(text.colour or BLACK)
        turn, words = _turn(text.angle, text.squeeze), ["BT"]
        for run, at in runs:
            words += (turn, _place(at), "Tm")
            for face, shown in self.shown(run.string, run.size, run.face):
                if face != self.lettered:
                    self.lettered = face
                    words.append(face)
                words.append(shown)
        words.append("ET")
        self.put(" ".join(words))

    def shown(self, string: str, size: float, face: str) -> list[tuple[str, str]]:
        """Return what sets the font and what shows characters of one size, for each subset of the font they are in."""
        codes = self.codes.get((string, size, face))
        if codes is None:
            font, big = _font(face), f"{size * POINT:.5f}"
            faces, split = font.getSubsetInternalName, font.splitString(string, self.document)
            codes = [(f"{faces(subset, self.document)} {big} Tf", f"<{code.hex()}> Tj") for subset, code in split]
            self.codes[string, size, face] = codes
        return codes

    def begin(self, part: Part) -> None:
        """Begin a layer: all is in it up to its end."""
        if isinstance(part, Layer):
            self.layers.append(part)
            self.put(f"/OC /{part.value} BDC")
        elif isinstance(part, Vector | Arrow):
            _place(part.tail), _place(part.tip)  # refuse what is not a number before its direction is taken

    def end(self, part: Part) -> None:
        """End a layer."""
        if isinstance(part, Layer):
            self.put("EMC")


# what strokes a path, by whether it is closed and filled
_PAINT = {(False, False): "S", (False, True): "B", (True, False): "s", (True, True): "b"}


@lru_cache(maxsize=64)
def _turn(angle: float, squeeze: float) -> str:
    """Return the first four numbers of the matrix of a turned or squeezed text."""
    c, s, k = cos(angle), sin(angle), squeeze
    return " ".join(f"{part:.6f}".rstrip("0").rstrip(".") for part in (k * c, k * s + 0.0, 0.0 - s, c))


def _outline(points: tuple[complex, ...]) -> str:
    return f"{_place(points[0])} m " + " ".join(f"{_place(point)} l" for point in points[1:])


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


@dataclass(frozen=True, slots=True)
class _Tile:
    """One small sheet: its name (column letter, row number from the top) and the part of the page that it shows."""

    name: str
    window: Box


def _tiles(page: Page, paper: str = "A4") -> list[_Tile]:
    """Return the tiles of a page, row by row from the top left; neighbours share a strip.

    Raises InputError: `paper` is not a paper for tiles.
    """
    if paper not in PAPERS:
        raise InputError("tile-unknown", text=quote(paper), known=", ".join(PAPERS))
    wide, high = (side - 2 * MARGIN for side in PAPERS[paper])
    columns, rows = (
        max(1, ceil((length - OVERLAP) / (room - OVERLAP) - 1e-9))
        for length, room in ((page.width, wide), (page.height, high))
    )
    found = []
    for row in range(rows):
        for column in range(columns):
            x, y = column * (wide - OVERLAP), page.height - row * (high - OVERLAP)
            window = (x, max(0.0, y - high), min(page.width, x + wide), y)
            found.append(_Tile(f"{chr(ord('A') + column)}{row + 1}", window))
    return found


def write_tiles(pages: Sequence[Page], stream: BinaryIO, paper: str = "A4") -> None:
    """Write pages as a PDF of small sheets at full size: print it at 100 %, cut at the marks, glue."""
    document = _Document(pages[0])
    canvas = document.canvas
    width, height = PAPERS.get(paper, PAPERS["A4"])
    for number, page in enumerate(pages):
        whole = f"page-{number}"
        parts = _tiles(page, paper)
        canvas.beginForm(whole, 0, 0, page.width * POINT, page.height * POINT)
        layers = _draw_page(canvas, page)
        canvas.endForm(Resources=document.resources(layers))
        for part in parts:
            canvas.setPageSize((width * POINT, height * POINT))
            x0, y0, x1, y1 = part.window
            left, bottom = MARGIN, height - MARGIN - (y1 - y0)
            canvas.saveState()
            clip = canvas.beginPath()
            clip.rect(left * POINT, bottom * POINT, (x1 - x0) * POINT, (y1 - y0) * POINT)
            canvas.clipPath(clip, stroke=0, fill=0)
            canvas.translate((left - x0) * POINT, (bottom - y0) * POINT)
            canvas.doForm(whole)
            canvas.restoreState()
            marks = _marks(part.name, (left, bottom, left + x1 - x0, bottom + y1 - y0))
            _draw_page(canvas, Page(width, height, tuple(marks), part.name, page.language))
            canvas.showPage()
    stream.write(document.data())


REFERENCE = re.compile(rb"(\d+) 0 R")
GROUPS = re.compile(rb"(/OFF|/Order|/OCGs) \[([^]]*)\]")  # layers, as a catalog lists them
STREAM = b"stream"


def on_leaves(files: Sequence[bytes]) -> list[bytes]:
    """Return documents with an empty page behind each that has an odd number of them: printed on both sides none shares
    a leaf with the next one. Where each is a page, which is printed on one side, they stay.
    """
    counts = [int(re.findall(rb"/Count (\d+)", data)[-1]) for data in files]
    if all(count == 1 for count in counts):
        return [*files]
    found = list[bytes]()
    for data, count in zip(files, counts, strict=True):
        found.append(data)
        if count % 2:
            empty, (wide, high) = BytesIO(), map(float, re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+)", data)[-1])
            write([Page(wide / POINT, high / POINT, (), "", "en")], empty)
            found.append(empty.getvalue())
    return found


def joined(files: Sequence[bytes]) -> bytes:
    """Join documents that `write` has made into one, in their order; layers of one name are one layer."""
    objects, catalogs, trees = list[bytes](), list[bytes](), list[int]()
    same, told = dict[bytes, int](), 0  # objects that refer to no other one, each of which is kept once
    for data in files:
        own, root, info = _objects(data)
        numbers = dict[int, int]()
        for number, text in own.items():
            alone = REFERENCE.search(text.partition(STREAM)[0]) is None
            numbers[number] = same.get(text, len(objects) + 1) if alone else len(objects) + 1
            if numbers[number] > len(objects):
                objects.append(text)
                same |= {text: len(objects)} if alone else {}
        for number, text in own.items():
            objects[numbers[number] - 1] = _renumbered(text, numbers)
        catalogs.append(objects[numbers[root] - 1])
        told = told or numbers[info]
        trees.append(int(re.findall(rb"/Pages (\d+) 0 R", catalogs[-1])[0]))
    top = b"%d 0 R" % (len(objects) + 1)
    pages = sum(int(re.findall(rb"/Count (\d+)", objects[at - 1])[0]) for at in trees)
    for at in trees:
        objects[at - 1] = objects[at - 1].replace(b"/Type /Pages", b"/Parent %s /Type /Pages" % top)
    kids = b" ".join(b"%d 0 R" % at for at in trees)
    every = dict[bytes, dict[bytes, None]]()
    for name, listed in (found for catalog in catalogs for found in GROUPS.findall(catalog)):
        every.setdefault(name, {}).update(dict.fromkeys(REFERENCE.findall(listed)))
    catalog = GROUPS.sub(lambda m: b"%s [ %s ]" % (m[1], b" ".join(b"%s 0 R" % n for n in every[m[1]])), catalogs[0])
    catalog = re.sub(rb"/Pages \d+ 0 R", b"/Pages " + top, catalog)
    return _assembled([*objects, b"<< /Count %d /Kids [ %s ] /Type /Pages >>" % (pages, kids), catalog], told)


def _objects(data: bytes) -> tuple[dict[int, bytes], int, int]:
    """Return what the objects of a document hold, by number, and the numbers of its catalog and of its title."""
    start = int(data[data.rindex(b"startxref") :].split()[1])
    places = [int(line[:10]) for line in data[start : data.index(b"trailer", start)].split(b"\n")[2:] if b" n" in line]
    ends = dict(pairwise([*sorted(places), start]))
    whole = {int(data[at : at + 12].split()[0]): data[at : ends[at]] for at in places}
    inner = {number: text[text.index(b"obj") + 3 : text.rindex(b"endobj")].strip() for number, text in whole.items()}
    root, info = (int(re.findall(rb"/%s (\d+) 0 R" % name, data[start:])[0]) for name in (b"Root", b"Info"))
    return inner, root, info


def _renumbered(text: bytes, numbers: Mapping[int, int]) -> bytes:
    head, stream, rest = text.partition(STREAM)
    return REFERENCE.sub(lambda found: b"%d 0 R" % numbers[int(found[1])], head) + stream + rest


def _assembled(objects: Sequence[bytes], info: int) -> bytes:
    """Return a file of these objects, the last of which is its catalog, and that of this number tells its title."""
    written, places = bytearray(b"%PDF-1.5\n%\xe2\xe3\xcf\xd3\n"), list[int]()
    for number, text in enumerate(objects, 1):
        places.append(len(written))
        written += b"%d 0 obj\n%s\nendobj\n" % (number, text)
    table = b"".join(b"%010d 00000 n \n" % at for at in places)
    size, start = len(objects) + 1, len(written)
    written += b"xref\n0 %d\n0000000000 65535 f \n%strailer\n" % (size, table)
    written += b"<< /Info %d 0 R /Root %d 0 R /Size %d >>\n" % (info, size - 1, size)
    return bytes(written + b"startxref\n%d\n%%%%EOF\n" % start)


def _marks(name: str, box: Box) -> list[Shape]:
    """Return cut marks outside the corners of `box`, and the name of a tile under its left bottom corner."""
    x0, y0, x1, y1 = box
    shapes: list[Shape] = []
    for x, outward in ((x0, -1), (x1, 1)):
        for y, up in ((y0, -1), (y1, 1)):
            corner = complex(x, y)
            shapes.append(Line(corner + outward, corner + outward * MARK, Pen.THIN))
            shapes.append(Line(corner + up * 1j, corner + up * MARK * 1j, Pen.THIN))
    return [*shapes, Text(complex(x0 + 3, y0 - 5), name, 3.5)]


DPI = 200


def write_png(pages: Sequence[Page], stream: BinaryIO, dpi: float = DPI) -> None:
    """Write the first of `pages` as a picture of `dpi` dots per inch.

    Raises InputError: the extra `png` is not installed.
    """
    try:
        from pypdfium2 import PdfDocument
    except ImportError:
        raise InputError("extra-missing", packages="pypdfium2", suffix=".png") from None
    picture = BytesIO()
    write(pages[:1], picture)
    document = PdfDocument(picture.getvalue())
    try:
        grey = not _coloured(pages[0].shapes)
        document[0].render(scale=dpi / 72, grayscale=grey).to_pil().save(stream, "PNG", dpi=(dpi, dpi))
    finally:
        document.close()


def _coloured(shapes: Iterable[Shape]) -> bool:
    return any(_coloured(shape.shapes) if isinstance(shape, Group) else shape.colour is not None for shape in shapes)
