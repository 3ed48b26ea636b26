"""The report on one student as a file: its suffix picks text or HTML."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..spreadsheets.grid import SUFFIXES as TABLES
from .report import Report
from .report_html import report_html
from .report_text import report_text

REPORTS: Mapping[str, Callable[[Report], str]] = {".html": report_html, ".txt": report_text}
SUFFIXES = (*REPORTS, *TABLES)  # of all that marks can be written to


def report_bytes(found: Report, suffix: str) -> bytes:
    """Return what a file of a report holds."""
    return REPORTS[suffix.lower()](found).encode("utf-8", "replace")  # bytes in a name of a file
