"""The PNG writer: a picture of the PDF, for looking at and not for measuring (extra `png`)."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import BinaryIO

from ..scales.errors import InputError
from .page import Page
from .pdf import write_pdf

DPI = 200


def write_png(pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write the first of `pages` as a picture of 200 dots per inch.

    Raises
    ------
    InputError
        The extra `png` is not installed.
    """
    try:
        from pypdfium2 import PdfDocument
    except ImportError:
        raise InputError("extra-missing", extra="png", suffix=".png") from None
    pdf = BytesIO()
    write_pdf(pages[:1], pdf)
    document = PdfDocument(pdf.getvalue())
    try:
        document[0].render(scale=DPI / 72).to_pil().save(stream, "PNG", dpi=(DPI, DPI))
    finally:
        document.close()
