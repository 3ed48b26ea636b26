"""Photographed sheets returned: each page laid flat, over it the vectors that were read, by their verdicts."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.page import Page, extent
from ...drawing.shapes import Shape, shifted
from ..marking.marked import Marked
from ..marking.overlay import Vector, legend, over, right, vectors
from .reading import Flat, on_page, rendered
from .straight import PER_MM

SMALL, LEFT, FOOT = 3.5, 24.0, 8.0  # mm of letters; of the legend from the left; of paper under it
QUALITY = 85  # of JPEG in a report


def photo_files(marked: Marked, language: str, own: bool, path: Path) -> Iterator[tuple[Path, bytes]]:
    """Make the files of marked sheets: .pdf with a page for each, or .png, of several pages `x-1.png`, `x-2.png`."""
    pages = _pages(marked, language, own)
    if path.suffix.lower() == ".pdf":
        yield path, _pdf(pages)
        return
    alone = len(_with_plans(marked)) == 1
    for number, page in enumerate(pages, start=1):
        name = path if alone else path.with_name(f"{path.stem}-{number}{path.suffix}")
        yield name, _written(page, "PNG", dpi=(PER_MM * 25.4,) * 2)


def stacked(files: Sequence[Path]) -> bytes:
    """Return one PDF of all pages of several."""
    import pypdfium2

    whole, stream = pypdfium2.PdfDocument.new(), io.BytesIO()
    for file in files:
        whole.import_pages(pypdfium2.PdfDocument(file))
    whole.save(stream)
    return stream.getvalue()


def pictures(marked: Marked, language: str, own: bool) -> Iterator[str]:
    """Go through the marked sheets as addresses of pictures in a page."""
    for page in _pages(marked, language, own):
        yield f"data:image/jpeg;base64,{b64encode(_written(page, 'JPEG', quality=QUALITY)).decode()}"


def _with_plans(marked: Marked) -> list[Flat]:
    """Return the pages on which plans are."""
    assert marked.sheets is not None
    return [page for page in marked.sheets.pages if page.number in marked.sheets.blank.pages_with_plans]


def _pages(marked: Marked, language: str, own: bool) -> Iterator[Any]:
    """Go through the pages as pictures: each is large."""
    sheets, found = marked.sheets, dict[int, list[Vector]]()
    assert sheets is not None
    for line, *places in vectors(marked):
        at = [on_page(sheets, place) for place in places]
        found.setdefault(at[0][0], []).append((line, at[0][1], at[1][1], at[2][1]))
    for page in _with_plans(marked):
        yield _page(marked, page, found.get(page.number, []), language, own)


def _page(marked: Marked, page: Flat, found: list[Vector], language: str, own: bool) -> Any:
    """Return a page as a picture, with its vectors and what lines mean below it."""
    from PIL import Image

    rows, columns = page.picture.shape
    width, height = columns / PER_MM, rows / PER_MM
    shapes: list[Shape] = [*(() if own else right(found)), *over(marked, found, SMALL)]
    at = complex(LEFT, -2.0 * SMALL)
    said = list(legend(marked, language, own, at, SMALL))
    fits = (width - FOOT - LEFT) / (extent(said)[2] - LEFT)
    shapes += said if fits >= 1.0 else legend(marked, language, own, at, SMALL * fits)
    foot = FOOT - min(extent(shapes)[1], 0.0)
    moved = tuple(shifted(shape, 1j * foot) for shape in shapes)
    whole = Page(width, height + foot, moved, marked.keyed.solution.task.title[language], language)
    drawn = rendered(whole, rev_byteorder=True)[..., :3]
    under: NDArray[np.uint8] = np.full(drawn.shape[:2], 255, np.uint8)
    high, wide = min(rows, len(under)), min(columns, under.shape[1])
    under[:high, :wide] = page.picture[:high, :wide]
    both = np.multiply(drawn, under[..., None], dtype=np.uint16)
    both //= 255
    return Image.fromarray(both.astype(np.uint8))


def _written(page: Any, kind: str, **how: Any) -> bytes:
    stream = io.BytesIO()
    page.save(stream, kind, **how)
    return stream.getvalue()


def _pdf(pages: Iterable[Any]) -> bytes:
    """Return a PDF with a picture on each page, at full size."""
    from reportlab.lib.utils import ImageReader
    from reportlab.pdfgen.canvas import Canvas

    stream = io.BytesIO()
    canvas = Canvas(stream, invariant=1)
    for page in pages:
        size = page.width / PER_MM / 25.4 * 72.0, page.height / PER_MM / 25.4 * 72.0
        canvas.setPageSize(size)
        jpeg = _written(page, "JPEG", quality=QUALITY)
        reader = ImageReader(io.BytesIO(jpeg))
        # what tells pictures apart: the bytes of the file do, too, and it is not unpacked and kept
        reader.getRGBData, reader._dataA = (lambda data=jpeg: data), None
        canvas.drawImage(reader, 0, 0, *size)
        canvas.showPage()
    canvas.save()
    return stream.getvalue()
