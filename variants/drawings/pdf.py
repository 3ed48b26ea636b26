"""PDF read back: what stands on its pages, as the library tells it that also shows PDF, in a process of its own."""

from __future__ import annotations

import ctypes
import re
from collections.abc import Iterator
from typing import Any

from ...scales.errors import InputError
from .apart import apart
from .marks import CAPITAL, DEEPEST, LONGEST, POINT, Affine, FaultError, Marks, beside

SECONDS = 0.6  # of the processor: of reading one
_LINE, _MOVE = 0, 2  # kinds of steps of a path
_TEXT, _PATH, _IMAGE, _FORM = 1, 2, 3, 5  # kinds of objects of a page


def read_pdf(data: bytes) -> Marks:
    """Read a PDF in another process; one that holds only a picture is refused as such."""
    if not re.search(rb"%PDF-[0-9]", data[:2000]):
        raise ValueError
    (marks,) = apart(_begun, _pages, data, SECONDS)
    return Marks(*marks)


def _begun(advance: Any) -> None:
    """Load the library."""
    try:
        import pypdfium2  # noqa: F401
    except ImportError:
        raise InputError("extra-missing", packages="pypdfium2", suffix=".pdf") from None


def _pages(data: bytes) -> Iterator[tuple[Any, ...] | str]:
    """Give the lines, filled triangles and letters of a PDF in mm, or the key of what is wrong with it."""
    import pypdfium2

    try:
        document = pypdfium2.PdfDocument(data)
        found = _Pdf()
        for page in document:
            found.marks.count()
            found.page(page)
    except (pypdfium2.PdfiumError, ValueError, LookupError, ArithmeticError, OSError, MemoryError):
        yield "drawing-broken"
    except FaultError as fault:
        yield str(fault)
    else:
        picture = found.pictures and not found.marks.lines
        yield "drawing-picture" if picture else (found.marks.lines, found.marks.heads, found.marks.pieces)


class _Pdf:
    """Draws the objects of pages, and those of forms in them."""

    def __init__(self) -> None:
        import pypdfium2.raw as raw

        self.raw, self.marks, self.pictures = raw, Marks(), 0
        self.text: Any = None  # that of a page, kept as long as it is needed

    def page(self, page: Any) -> None:
        """Draw a page, turned as it is shown, beside those before it."""
        left, bottom, right, top = page.get_mediabox()
        turn, middle = (-1j) ** (page.get_rotation() // 90), complex(left + right, bottom + top) / 2.0
        size = complex(right - left, top - bottom)
        half = size / 2.0 if turn.real else complex(size.imag, size.real) / 2.0
        to = beside(self.marks) if self.marks.lines else 0j
        way = Affine(POINT * turn, t=to + POINT * (half - turn * middle))
        self.text = page.get_textpage()
        objects = self.raw.FPDFPage_CountObjects(page.raw)
        self.objects((self.raw.FPDFPage_GetObject(page.raw, n) for n in range(objects)), way, 0)

    def objects(self, objects: Iterator[Any], way: Affine, depth: int) -> None:
        """Draw objects, moved by `way`."""
        if depth > DEEPEST:
            raise FaultError("drawing-deep")
        raw = self.raw
        for item in objects:
            self.marks.count()
            kind, own = raw.FPDFPageObj_GetType(item), way.after(self.matrix(item))
            if kind == _PATH:
                self.path(item, own)
            elif kind == _TEXT:
                self.letters(item, way, own)
            elif kind == _FORM:
                inside = raw.FPDFFormObj_CountObjects(item)
                self.objects((raw.FPDFFormObj_GetObject(item, n) for n in range(inside)), own, depth + 1)
            self.pictures += kind == _IMAGE

    def matrix(self, item: Any) -> Affine:
        """Return the map of an object."""
        found = self.raw.FS_MATRIX()
        self.raw.FPDFPageObj_GetMatrix(item, found)
        return Affine.of(complex(found.a, found.b), complex(found.c, found.d), complex(found.e, found.f))

    def path(self, item: Any, way: Affine) -> None:
        """Draw the straight steps of a path that has a line; a filled triangle may be an arrowhead."""
        raw, fill, stroke = self.raw, ctypes.c_int(), ctypes.c_int()
        raw.FPDFPath_GetDrawMode(item, fill, stroke)
        x, y = ctypes.c_float(), ctypes.c_float()
        pieces, straight = [list[complex]()], True
        count = raw.FPDFPath_CountSegments(item)
        self.marks.count(max(count, 0))
        for number in range(count):
            step = raw.FPDFPath_GetPathSegment(item, number)
            raw.FPDFPathSegment_GetPoint(step, x, y)
            place, kind = way.at(complex(x.value, y.value)), raw.FPDFPathSegment_GetType(step)
            straight = straight and kind in (_LINE, _MOVE)
            if kind == _LINE:
                pieces[-1].append(place)
            else:
                pieces.append([place])
            if raw.FPDFPathSegment_GetClose(step):
                begun = next(piece for piece in reversed(pieces) if piece)[0]
                pieces[-1].append(begun)
        if stroke.value:
            for piece in pieces:
                self.marks.path(piece)
        elif fill.value and straight:
            for corners in (list(dict.fromkeys(piece)) for piece in pieces):
                if len(corners) == 3:
                    self.marks.heads.append((corners[0], corners[1], corners[2]))

    def letters(self, item: Any, way: Affine, own: Affine) -> None:
        """Draw a run of letters."""
        raw, size = self.raw, ctypes.c_float()
        raw.FPDFTextObj_GetFontSize(item, size)
        long = raw.FPDFTextObj_GetText(item, self.text.raw, None, 0)
        if not 2 < long <= 4 * LONGEST:
            return
        buffer = ctypes.create_string_buffer(long)
        raw.FPDFTextObj_GetText(item, self.text.raw, ctypes.cast(buffer, ctypes.POINTER(ctypes.c_ushort)), long)
        text = buffer.raw[:long].decode("utf-16-le", "replace").rstrip("\0")
        sides = [ctypes.c_float() for _ in range(4)]
        raw.FPDFPageObj_GetBounds(item, *sides)
        left, bottom, right, top = (side.value for side in sides)
        level = own.at(1 + 0j) - own.at(0j)
        level = level / abs(level) if level else 1.0 + 0j
        upright = way.at(complex(right, top)) - way.at(complex(left, bottom))
        height, start = CAPITAL * size.value * own.scale, own.at(0j)
        along, across = abs(level.real), abs(level.imag)
        room = abs(upright.real) * along + abs(upright.imag) * across - 2.0 * height * along * across
        self.marks.text(text, start, start + level * max(room, 0.0), height)
