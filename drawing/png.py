"""The PNG writer: a picture of the PDF."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import BytesIO
from typing import BinaryIO

from ..scales.errors import InputError
from . import pdf
from .page import Page
from .shapes import Group, Shape

DPI = 200


def write(pages: Sequence[Page], stream: BinaryIO, dpi: float = DPI) -> None:
    """Write the first of `pages` as a picture of `dpi` dots per inch.

    Raises InputError: the extra `png` is not installed.
    """
    try:
        from pypdfium2 import PdfDocument
    except ImportError:
        raise InputError("extra-missing", extra="png", suffix=".png") from None
    picture = BytesIO()
    pdf.write(pages[:1], picture)
    document = PdfDocument(picture.getvalue())
    try:
        grey = not _coloured(pages[0].shapes)
        document[0].render(scale=dpi / 72, grayscale=grey).to_pil().save(stream, "PNG", dpi=(dpi, dpi))
    finally:
        document.close()


def _coloured(shapes: Iterable[Shape]) -> bool:
    return any(_coloured(shape.shapes) if isinstance(shape, Group) else shape.colour is not None for shape in shapes)
