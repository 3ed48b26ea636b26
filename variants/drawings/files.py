"""Drawings read back: the straight lines and letters of a DXF, SVG or PDF file, in mm of paper, behind bounds.

A file that somebody hands in is hostile until it is read. DXF and SVG are gone through piece by piece and counted, so
that none takes longer than the count allows, however often blocks and groups repeat one another; a PDF, whose forms can
do the same inside of a library, is read by a process of its own with bounds of time and memory. Nothing is executed,
nothing is fetched. Curves are passed over: the ends of vectors are the ends of straight lines.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from xml.etree import ElementTree

from ...plans.marking.lines import Drawn
from ...scales.errors import InputError
from .apart import handed_in
from .dxf import read_dxf
from .marks import LARGEST, MOST, FaultError, Marks
from .pdf import read_pdf
from .svg import read_svg

READERS: Mapping[str, Callable[[bytes], Marks]] = {".dxf": read_dxf, ".svg": read_svg, ".pdf": read_pdf}
SUFFIXES = tuple(READERS)


def read_drawing(file: str | Path) -> Drawn:
    """Return the straight lines and letters of a drawing, .dxf, .svg or .pdf.

    Pages, and model and paper space, stand beside one another, far apart.

    Raises
    ------
    InputError
        The file cannot be read, is not what its suffix says, has no lines, or more than is allowed.
    """
    data, shown, suffix = handed_in(file, LARGEST, "drawing-not-file")
    try:
        if len(data) > LARGEST:
            raise FaultError("drawing-large")
        return READERS[suffix](data).drawn()
    except InputError:  # of a package that is missing
        raise
    except FaultError as fault:
        key, known = str(fault), ", ".join(READERS)
    except (ValueError, LookupError, ArithmeticError, TypeError, RecursionError, zlib.error, ElementTree.ParseError):
        key, known = "drawing-broken", suffix[1:].upper()  # whatever a parser does not like
    raise InputError(key, file=shown, n=LARGEST // 1_000_000 if key == "drawing-large" else MOST, known=known)
