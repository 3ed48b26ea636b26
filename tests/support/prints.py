"""Prints read back from their PDF: the sizes of pages, the strokes on them in millimetres, rulers, frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pdfminer.high_level import extract_pages
from pdfminer.layout import LAParams, LTCurve

MM = 25.4 / 72
Stroke = NDArray[np.complex128]  # the points of a line or a curve, mm from the lower left corner


@dataclass(frozen=True, slots=True)
class Print:
    """A page as a printer gets it: its size in mm and all that is stroked or filled on it."""

    width: float
    height: float
    strokes: tuple[Stroke, ...]

    def straight(self, along: complex) -> list[Stroke]:
        """Return the straight lines in a direction, 1 or 1j, from their lower or left end."""
        lines = [stroke if _runs(stroke, along) else stroke[::-1] for stroke in self.strokes if len(stroke) == 2]
        return [line for line in lines if _runs(line, along) and abs(_across(line, along)) < 1e-3]


def _runs(line: Stroke, along: complex) -> bool:
    return float(((line[1] - line[0]) / along).real) > 0.0


def _across(line: Stroke, along: complex) -> float:
    return float(((line[1] - line[0]) / along).imag)


def prints(pdf: bytes) -> list[Print]:
    """Return the pages of a PDF."""
    found = []
    for page in extract_pages(BytesIO(pdf), laparams=LAParams(boxes_flow=None)):
        strokes = (np.array([complex(*point) * MM for point in part.pts]) for part in _parts(page))
        found.append(Print(page.width * MM, page.height * MM, tuple(stroke for stroke in strokes if len(stroke))))
    return found


def _parts(element: Any) -> Iterator[LTCurve]:
    if isinstance(element, LTCurve):
        yield element
    for child in getattr(element, "_objs", ()):
        yield from _parts(child)


def farthest(these: Iterable[Stroke], those: Iterable[Stroke]) -> float:
    """Return by how many mm the one of `these` that fits worst misses the nearest of `those`; inf without any."""
    by_count: dict[int, list[Stroke]] = {}
    for stroke in those:
        by_count.setdefault(len(stroke), []).append(stroke)
    tables = {count: np.array(strokes) for count, strokes in by_count.items()}
    worst = 0.0
    for stroke in these:
        if len(stroke) not in tables:
            return float("inf")
        worst = max(worst, float(abs(tables[len(stroke)] - stroke).max(axis=1).min()))
    return worst
