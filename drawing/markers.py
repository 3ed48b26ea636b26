"""What makes a handout readable from a photograph: square markers, whose numbers tell the page, and a QR code.

A marker is a square of six by six fields, ArUco's: black round four by four that spell its number. Eight of them stand
where a page is empty, as near as may be to its corners and the middles of its sides, so that no view gives way to them:
the sheet is drawn as it is without them. The QR code names task, variant and page, never an answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scales.errors import InputError
from ..scales.packaged import packaged
from .formats import Format, Norm, drawing_area, pens_for
from .page import Page, extent
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, sides_of
from .text import Box, corners

# the fields of the 250 markers of the dictionary 4X4_250, row by row from the top, a white field is 1: 16 bits each
FIELDS = (
    "b5320f9a332d9946549e79cd9e2ec4f2fedacf56f99111a70eb72a0f24b1263e466566006c5e76af868bb02bccd5dd82fe47"
    "9471ace4a5542123346f441557b29ecff0cb08ae0929187504ff0df61c5a17182a28328c38b224e82eeb2d3f4b64502e5013"
    "519455685d415f9768016867612461e96b126fe567df7e1b80a083448ba2937a846c852a859c9c899fa1bb7cbc04b65bbfc8"
    "b7abca1fc962d958d3d5cc98c7a0c537e95df925fbbbee2af74d35758aad76170acf064b2dc149d843f44f364fd369e470c7"
    "7a6eb4eaed4ffce7fea6002500430a880a86026f001c009708370a3109c60b0109fb0b581082182d10781073127412b11af9"
    "13060c0e0cf104330c9f0ef20efd074c0fa4072f05b50f9107db1ee414391d8015c81f8b15ba1db1208028e922a228532af0"
    "22f72940214629b92b9c2bb238ca382e300738e73a493a65325d3b88391d3bd3264727802faa2d1425de25532f7734483ca8"
    "3c41340d34fb369a3de0356a3d093ded3fc43f6c37ce3d5c3d7637b03f173fff48e542684a2d4160495141dd4bdf584f5a48"
    "5816505d5afa5ab551235b8a591951354c6946c14e0b445f4e594d834d7d47d847735c855e44562b5cbb55c35f6e5feb5d12"
    "555e6270621561c26b2063456b5c6b5b780c7acf787f798071e5717479b671d37b33646a66a86ea76e9165226dcb678d6d31"
)
EACH = 8  # markers of a page: their numbers are 8 · (page - 1) + 0 to 7
PAGES = 30
FREE = 31  # what a sheet counts as that has markers stuck on it
SIDE, ROUND = 12.0, 2.5  # mm of a marker; white round it
STUCK = 20.0  # mm of a marker to be stuck on a sheet
CODES = (26.0, 24.0, 22.0, 20.0, 18.0, 16.0, 14.0)  # mm of a QR code, the largest that finds room
QUIET = 3.0  # mm of white round it
EDGE = 5.0  # mm from the edge of the paper that printers do not reach
PAPER = 210.0, 297.0  # mm of the page of those that are stuck on
FEWEST, SAFE = 5, 6  # markers of a page: fewer do not straighten it, and so many there should be
STEP = 2.0  # mm between places that are tried
UNIT = 0.25  # mm, side of the squares of which it is known whether they are empty
DIGITS = 16
CLOSE, NEAR, APART = 0.06, 0.2, 0.2  # parts of the shorter side: how near a marker stands where it should,
# how far from there it may at the most, how far it must from others
# where each marker should be, in parts of what printers reach: corners against the clock from below left, then sides
WANTED = (0j, 1 + 0j, 1 + 1j, 1j, 0.5 + 0j, 1 + 0.5j, 0.5 + 1j, 0.5j)

INKED, INSIDE = 0, 1  # layers of what is taken: by ink, by views

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


class Place(NamedTuple):
    """Where a marker of a number stands: its lower left corner, mm."""

    number: int
    at: complex

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """Its corners with the clock from the top left one, as finders of markers return them."""
        low, side = self.at, SIDE
        return low + 1j * side, low + side + 1j * side, low + side, low


def fields(number: int) -> NDArray[np.bool_]:
    """Return which fields of a marker are black, of shape (6, 6), rows from the top."""
    bits = int(FIELDS[4 * number : 4 * number + 4], DIGITS)
    white = np.array([bits >> (15 - at) & 1 for at in range(16)], bool).reshape(4, 4)
    black = np.ones((6, 6), bool)
    black[1:5, 1:5] = ~white
    return black


def _code_fields(text: str) -> NDArray[np.bool_]:
    """Return which fields of the QR code of a text are black, rows from the top, without white round it.

    Raises InputError: the package that makes it is missing.
    """
    try:
        import zxingcpp
    except ImportError:
        raise InputError("scan-missing") from None
    barcode = zxingcpp.create_barcode(text, zxingcpp.BarcodeFormat.QRCode, ec_level="M")
    black = np.array(barcode.to_image(scale=1, add_quiet_zones=False)) < 128
    rows, columns = np.flatnonzero(black.any(axis=1)), np.flatnonzero(black.any(axis=0))
    return np.asarray(black[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1])


def scannable(page: Page, whole: Sequence[Group], number: int, text: str, sheet: Format, norm: Norm) -> Page:
    """Return a begun page with markers and a QR code of `text`.

    `whole` are the views that stand there, with all that will be drawn; the `number` of the page counts from 1.

    Raises
    ------
    InputError
        There are too many pages, or too little room.
    """
    if number > PAGES:
        raise InputError("scan-pages", n=PAGES)
    room = _Room(page, whole, drawing_area(sheet, norm))
    places = room.markers(number)
    if len(places) < FEWEST:
        raise InputError("scan-room", page=number, format=sheet.letters)
    pen = pens_for(page.width, page.height, norm).width(Pen.THIN)
    shapes = [Group(tuple(_areas(fields(one.number), one.at, SIDE, pen)), "marker", str(one.number)) for one in places]
    found = room.code()
    if found is not None:
        at, side = found
        shapes.append(Group(tuple(_areas(_code_fields(text), at, side, pen)), "qr", text))
    return replace(page, shapes=(*page.shapes, *shapes))


def stickers(language: str) -> Page:
    """Return an A4 page of markers to be cut out and stuck on sheets of one's own: a set of eight in each column."""
    texts, shapes = packaged(__package__, "texts", language), list[Shape]()
    pen = pens_for(*PAPER).width(Pen.THIN)
    pitch, columns = STUCK + 2.0 * ROUND, int((PAPER[0] - 2.0 * EDGE) / (STUCK + 2.0 * ROUND))
    low = complex((PAPER[0] - columns * pitch) / 2.0, EDGE)
    for count, along, across, other in ((columns, 1.0, 1j, EACH), (EACH, 1j, 1.0, columns)):
        for line in range(count + 1):
            start = low + line * pitch * along
            shapes.append(Line(start, start + other * pitch * across, Pen.THIN, role="grid"))
    for own, column in product(range(EACH), range(columns)):
        number = EACH * (FREE - 1) + own
        at = low + complex(column * pitch + ROUND, (EACH - 1 - own) * pitch + ROUND)
        shapes.append(Group(tuple(_areas(fields(number), at, STUCK, pen)), "marker", str(number)))
    for line, said in enumerate(("title", "cut", "stick", "see", "print")):
        at = complex(low.real, PAPER[1] - EDGE - 10.0 - 7.0 * line)
        shapes.append(Text(at, texts[f"stickers.{said}"], 5.0 if line == 0 else 3.5))
    return Page(*PAPER, tuple(shapes), texts["stickers.title"], language)


def _areas(black: NDArray[np.bool_], at: complex, side: float, pen: float) -> Iterator[Polyline]:
    """Go through the black runs of rows as areas; what their outlines add is taken off."""
    field = side / len(black)
    for row, line in enumerate(black):
        edges = np.flatnonzero(np.diff(np.concatenate(([False], line, [False])).astype(int)))
        for start, end in edges.reshape(-1, 2).tolist():
            low = at + complex(start * field, side - (row + 1) * field) + pen / 2 * (1 + 1j)
            wide, high = (end - start) * field - pen, field - pen
            area = low, low + wide, low + complex(wide, high), low + 1j * high
            yield Polyline(area, Pen.THIN, closed=True, fill=True, role="marker")


class _Room:
    """Which places of a page are empty, now and when all is drawn."""

    def __init__(self, page: Page, whole: Sequence[Group], area: Box) -> None:
        """Look at all that stands on a page."""
        self.width, self.height, self.area = page.width, page.height, area
        # in all that is drawn; in views, too, where what is drawn wrong has room, and letters
        self.layers = [np.zeros((round(page.height / UNIT) + 1, round(page.width / UNIT) + 1), bool) for _ in range(2)]
        for shape in (*page.shapes, *whole):
            self.draw(shape)
        for view in whole:
            x0, y0, x1, y1 = extent(view.shapes)
            self.box(complex(x0, y0), complex(x1, y1), INSIDE)
        # how much is taken below and left of each place, but for markers that have been stood there since
        self.sums = [np.pad(layer.astype(np.int64).cumsum(0).cumsum(1), ((1, 0), (1, 0))) for layer in self.layers]
        self.stood = list[tuple[int, ...]]()

    def draw(self, shape: Shape) -> None:
        """Take the places of a shape."""
        match shape:
            case Group(shapes=shapes):
                for part in shapes:
                    self.draw(part)
            case Line() | Polyline() | Arc():
                for a, b in sides_of(shape):
                    self.line(a, b)
            case Vector(tail=a, tip=b) | Arrow(tail=a, tip=b):
                self.line(a, b)
            case Circle(centre=centre, radius=radius):
                self.box(centre - radius * (1 + 1j), centre + radius * (1 + 1j))
            case Head(tip=tip):
                self.box(tip - 2 - 2j, tip + 2 + 2j)
            case Text():
                around = corners(shape)
                xs, ys = [z.real for z in around], [z.imag for z in around]
                self.box(complex(min(xs), min(ys)), complex(max(xs), max(ys)))

    def line(self, a: complex, b: complex) -> None:
        """Take the places of a straight line."""
        count = int(abs(b - a) / (UNIT / 2)) + 2
        at = (a + (b - a) * np.linspace(0.0, 1.0, count)) / UNIT
        rows, columns = self.layers[INKED].shape
        x, y = np.clip(at.real.astype(int), 0, columns - 1), np.clip(at.imag.astype(int), 0, rows - 1)
        for layer in self.layers:
            layer[y, x] = True

    def box(self, low: complex, high: complex, first: int = 0) -> None:
        """Take all places of a box, from the first layer on."""
        x0, y0, x1, y1 = self.cells(low, high)
        for layer in self.layers[first:]:
            layer[y0 : y1 + 1, x0 : x1 + 1] = True

    def cells(self, low: complex, high: complex) -> tuple[int, ...]:
        """Return the first and the last columns and rows of places of a box: left, lower, right, upper."""
        return tuple(max(0, int(edge / UNIT)) for edge in (low.real, low.imag, high.real, high.imag))

    def free(self, at: Complex, side: float, white: float, where: int) -> NDArray[np.bool_]:
        """Return at which lower left corners a square is empty, with white round it, and printers reach it."""
        inside = (at.real >= EDGE) & (at.imag >= EDGE)
        inside &= (at.real + side <= self.width - EDGE) & (at.imag + side <= self.height - EDGE)
        rows, columns = self.layers[where].shape
        x0, y0 = ((part - white) / UNIT for part in (at.real, at.imag))
        x1, y1 = ((part + side + white) / UNIT for part in (at.real, at.imag))
        x0, x1 = (np.clip(x.astype(int), 0, columns) for x in (x0, x1 + 1))
        y0, y1 = (np.clip(y.astype(int), 0, rows) for y in (y0, y1 + 1))
        s = self.sums[where]
        inside &= s[y1, x1] - s[y0, x1] - s[y1, x0] + s[y0, x0] == 0
        for left, low, right, high in self.stood:
            inside &= (x0 > right) | (x1 <= left) | (y0 > high) | (y1 <= low)
        return np.asarray(inside)

    def places(self, side: float) -> Complex:
        """Return all lower left corners that are tried."""
        x, y = (np.arange(EDGE, most - EDGE - side + 1e-9, STEP) for most in (self.width, self.height))
        return np.asarray((x[None, :] + 1j * y[:, None]).ravel())

    def markers(self, number: int) -> list[Place]:
        """Return where markers stand: each as near as may be to where it should be, the others far from those."""
        every, found = self.places(SIDE), dict[int, complex]()
        low, size = EDGE * (1 + 1j), complex(self.width - 2 * EDGE - SIDE, self.height - 2 * EDGE - SIDE)
        least = min(size.real, size.imag)
        for own, part in enumerate(WANTED):
            away = np.abs(every - low - complex(part.real * size.real, part.imag * size.imag))
            for where, most in ((INSIDE, CLOSE * least), (INKED, NEAR * least), (INSIDE, NEAR * least)):
                if own not in found:
                    self.stand(own, every, away, most, found, where)
        for where, count in ((INSIDE, EACH), (INKED, SAFE)):
            for own in sorted({*range(EACH)} - {*found})[: max(count - len(found), 0)]:
                others = np.array([*found.values()] or [complex(-self.width, -self.height)])
                near = np.abs(every[:, None] - others[None, :]).min(axis=1)
                self.stand(own, every, -near, -APART * least, found, where)
        return [Place(EACH * (number - 1) + own, at) for own, at in sorted(found.items())]

    def stand(self, own: int, every: Complex, cost: Floats, most: float, found: dict[int, complex], where: int) -> None:
        """Stand a marker where it costs least of what is free, if that is no more than `most`."""
        free = self.free(every, SIDE, ROUND, where)
        if free.any() and cost[free].min() <= most:
            at = found[own] = complex(every[free][cost[free].argmin()])
            self.stood.append(self.cells(at, at + SIDE * (1 + 1j)))

    def code(self) -> tuple[complex, float] | None:
        """Return where a QR code has room inside the frame, and its side; the lowest place, then the rightmost."""
        x0, y0, x1, y1 = self.area
        for side, where in ((side, where) for where in (INSIDE, INKED) for side in CODES):
            every = self.places(side)
            inside = (every.real >= x0 + QUIET) & (every.imag >= y0 + QUIET)
            inside &= (every.real + side <= x1 - QUIET) & (every.imag + side <= y1 - QUIET)
            free = every[inside & self.free(every, side, QUIET, where)]
            if len(free):
                return complex(free[np.lexsort((-free.real, free.imag))[0]]), side
        return None


def stands(page: Page) -> list[Place]:
    """Return where the markers of a page stand."""
    found = list[Place]()
    for shape in page.shapes:
        if isinstance(shape, Group) and shape.role == "marker":
            points = [z for part in shape.shapes if isinstance(part, Polyline) for z in part.points]
            xs, ys = [z.real for z in points], [z.imag for z in points]
            middle = complex(min(xs) + max(xs), min(ys) + max(ys)) / 2
            found.append(Place(int(shape.name), middle - SIDE / 2 * (1 + 1j)))
    return found
