"""Photographed sheets returned: each page laid flat, over it the vectors that were read, by their verdicts."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...drawing.page import Page, extent
from ...drawing.shapes import Shape, shifted
from ...drawing.writers import page_files
from ..marking.marked import Marked
from ..marking.overlay import Vector, legend, over, right, vectors
from .reading import Flat, on_page
from .straight import PER_MM

SMALL, LEFT, FOOT = 3.5, 24.0, 8.0  # mm of letters; of the legend from the left; of paper under it
QUALITY = 85  # of JPEG in a report


def photo_files(marked: Marked, language: str, own: bool, path: Path) -> Iterator[tuple[Path, bytes]]:
    """Make the files of marked sheets: .pdf with a page for each, or .png, of several pages `x-1.png`, `x-2.png`."""
    pages = list(_pages(marked, language, own))
    if path.suffix.lower() == ".pdf":
        yield path, _pdf(pages)
        return
    for number, page in enumerate(pages, start=1):
        name = path if len(pages) == 1 else path.with_name(f"{path.stem}-{number}{path.suffix}")
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


def _pages(marked: Marked, language: str, own: bool) -> Iterator[Any]:
    """Go through the pages as pictures."""
    sheets, found = marked.sheets, dict[int, list[Vector]]()
    assert sheets is not None
    for line, *places in vectors(marked):
        at = [on_page(sheets, place) for place in places]
        found.setdefault(at[0][0], []).append((line, at[0][1], at[1][1], at[2][1]))
    for page in sheets.pages:
        if page.number in sheets.blank.pages_with_plans:
            yield _page(marked, page, found.get(page.number, []), language, own)


def _page(marked: Marked, page: Flat, found: list[Vector], language: str, own: bool) -> Any:
    """Return a page as a picture, with its vectors and what lines mean below it."""
    import pypdfium2
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
    ((_, data),) = page_files([whole], Path("page.pdf"))
    drawn = pypdfium2.PdfDocument(data)[0].render(scale=PER_MM * 25.4 / 72.0, rev_byteorder=True).to_numpy()[..., :3]
    under = np.full(drawn.shape[:2], 255, np.uint16)
    high, wide = min(rows, len(under)), min(columns, under.shape[1])
    under[:high, :wide] = page.picture[:high, :wide]
    return Image.fromarray((drawn.astype(np.uint16) * under[..., None] // 255).astype(np.uint8))


def _written(page: Any, kind: str, **how: Any) -> bytes:
    stream = io.BytesIO()
    page.save(stream, kind, **how)
    return stream.getvalue()


def _pdf(pages: list[Any]) -> bytes:
    """Return a PDF with a picture on each page, at full size."""
    from reportlab.lib.utils import ImageReader
    from reportlab.pdfgen.canvas import Canvas

    stream = io.BytesIO()
    canvas = Canvas(stream, invariant=1)
    for page in pages:
        size = page.width / PER_MM / 25.4 * 72.0, page.height / PER_MM / 25.4 * 72.0
        canvas.setPageSize(size)
        canvas.drawImage(ImageReader(io.BytesIO(_written(page, "JPEG", quality=QUALITY))), 0, 0, *size)
        canvas.showPage()
    canvas.save()
    return stream.getvalue()
