"""The paper of charts: A4 pages of matplotlib in black on white, and labels beside points that touch nothing.

The same input gives the same bytes.
"""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

    from ..words import Words

MM = 1.0 / 25.4
WIDTH, HEIGHT = 297.0, 210.0  # mm
LEFT, TOP, BOTTOM = 22.0, 12.0, 9.0  # mm
TEXT, SMALL = 8.5, 7.0  # points
BLACK, GREY, LIGHT = "0.0", "0.45", "0.82"
STYLE: Mapping[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": TEXT,
    "mathtext.fontset": "dejavusans",
    "mathtext.default": "regular",
    "axes.linewidth": 0.6,
    "axes.labelsize": TEXT,
    "axes.labelpad": 1.0,
    "axes.titlesize": TEXT + 0.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 5.0,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.unicode_minus": True,
    "xtick.labelsize": SMALL + 0.5,
    "ytick.labelsize": SMALL + 0.5,
    "lines.linewidth": 1.0,
    "grid.color": LIGHT,
    "grid.linewidth": 0.4,
    "path.simplify": False,  # it bends curves
    "lines.scale_dashes": False,  # patterns as they stand, whatever the line width
    "svg.hashsalt": "kulman",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
}
METADATA: Mapping[str, dict[str, Any]] = {
    ".svg": {"Date": None, "Creator": "Kulman"},
    ".pdf": {"CreationDate": None, "Creator": "Kulman", "Producer": "Kulman"},
    ".png": {"Software": None},
}
DPI = 150
SUFFIXES = tuple(METADATA)
HOLLOW: Mapping[str, Any] = {"mfc": "white", "mew": 0.8}  # markers
LOOK: Mapping[str, Any] = {"color": BLACK, "lw": 0.9, **HOLLOW}  # of a curve with such markers
LIMIT: Mapping[str, Any] = {"color": BLACK, "lw": 0.9, "ls": (0, (6, 2))}  # of the line at a tolerance

Box = tuple[float, float, float, float]
POINT = 4.0  # pixels around a point that stay free
REACHES = (7.0, 11.0, 16.0, 23.0, 31.0)  # pixels from a point to its label
LONG = 16.0  # from here on a thin line leads to the label
DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


@contextmanager
def _styled() -> Iterator[None]:
    """Draw in our style, whatever the user's own settings of matplotlib are."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        for name, value in STYLE.items():
            matplotlib.rcParams[name] = value  # type: ignore[index]
        yield


@contextmanager
def page(title: str, note: str, height: float = HEIGHT) -> Iterator[Figure]:
    """Draw a page, `height` mm tall, between its title and a note at its foot."""
    with _styled():
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        figure = Figure(figsize=(WIDTH * MM, height * MM), dpi=DPI)
        FigureCanvasAgg(figure)
        figure.text(LEFT / WIDTH, 1.0 - (TOP - 4.0) / height, title, fontsize=TEXT + 2.5, va="center")
        lines = "\n".join(line for part in note.split("\n") for line in textwrap.wrap(part, 175) or [""])
        figure.text(LEFT / WIDTH, BOTTOM / height, lines, fontsize=SMALL, va="center", linespacing=1.35)
        yield figure


def box(figure: Figure, left: float, bottom: float, width: float, height: float, tall: float = HEIGHT) -> Axes:
    """Return axes in a box of a page `tall` mm tall, mm."""
    return figure.add_axes((left / WIDTH, bottom / tall, width / WIDTH, height / tall))


def saved(figures: Sequence[Figure], suffix: str) -> list[bytes]:
    """Return the files of pages: one for all as PDF, one for each otherwise."""
    with _styled():
        streams = [BytesIO() for _ in figures]
        if suffix != ".pdf":
            for figure, stream in zip(figures, streams, strict=True):
                figure.savefig(stream, format=suffix.removeprefix("."), metadata=METADATA[suffix])
            return [stream.getvalue() for stream in streams]
        from matplotlib.backends.backend_pdf import PdfPages

        with PdfPages(streams[0], metadata=METADATA[suffix]) as pages:
            for figure in figures:
                pages.savefig(figure)
        return [streams[0].getvalue()]


def mathtext(markup: str) -> str:
    r"""Return the markup of a symbol, `V_{B}`, as matplotlib writes it.

    >>> mathtext(r"\bar{a}^{n}_{BA}")
    '$\\overline{a}^{n}_{BA}$'
    """
    if not re.search(r"[\\^_]", markup):
        return markup
    return "$" + markup.replace(r"\bar", r"\overline") + "$"


def decimals(words: Words, *axes: Axis) -> None:
    """Write the numbers of axes in the language's way."""
    from matplotlib.ticker import FuncFormatter

    for axis in axes:
        axis.set_major_formatter(FuncFormatter(lambda value, _: words.short(float(f"{value:.10g}"))))


@dataclass(frozen=True, slots=True)
class Label:
    """A text beside a point; `prefer` is the side where it would stand best, `must` says that it cannot be left out."""

    x: float
    y: float
    text: str
    prefer: tuple[float, float] = (1, 0)
    must: bool = False
    size: float = SMALL


def put(axes: Axes, labels: Iterable[Label], points: Sequence[tuple[float, float]], taken: Iterable[Box] = ()) -> None:
    """Put labels beside their points, those that must stand first; what finds no room is left out.

    All `points`, in the data's coordinates, stay free, and so do the boxes `taken`, x0, y0, x1, y1 in pixels.
    """
    renderer: Any = axes.figure.canvas.get_renderer()  # type: ignore[attr-defined]
    frame = axes.get_window_extent(renderer)
    spots = axes.transData.transform(np.asarray(points)) if points else np.zeros((0, 2))
    busy: list[Box] = [(x - POINT, y - POINT, x + POINT, y + POINT) for x, y in spots.tolist()]
    busy += list(taken)
    for label in sorted(labels, key=lambda label: not label.must):
        x, y = axes.transData.transform((label.x, label.y))
        text = axes.text(0.0, 0.0, label.text, fontsize=label.size, transform=None, ha="center", va="center", zorder=5)
        extent = text.get_window_extent(renderer)
        text.remove()
        found = _free(x, y, extent.width, extent.height, label.prefer, busy, (frame.x0, frame.y0, frame.x1, frame.y1))
        if found is None and not label.must:
            continue
        at_x, at_y, reach = found or (x, y + 2.0 * POINT, 0.0)
        _write(axes, label, (x, y), (at_x, at_y), reach)
        half_w, half_h = extent.width / 2.0, extent.height / 2.0
        busy.append((at_x - half_w, at_y - half_h, at_x + half_w, at_y + half_h))


def _free(
    x: float, y: float, width: float, height: float, prefer: tuple[float, float], busy: list[Box], frame: Box
) -> tuple[float, float, float] | None:
    """Return the middle of the nearest free box for a text, and how far it is from its point; None without any."""
    size = math.hypot(*prefer) or 1.0
    ranked = sorted(DIRECTIONS, key=lambda d: -(d[0] * prefer[0] + d[1] * prefer[1]) / (math.hypot(*d) * size))
    for reach in REACHES:
        for dx, dy in ranked:
            at_x, at_y = x + dx * (reach + width / 2.0), y + dy * (reach + height / 2.0)
            if dx and dy:
                at_x, at_y = x + dx * (0.7 * reach + width / 2.0), y + dy * (0.7 * reach + height / 2.0)
            own = at_x - width / 2.0, at_y - height / 2.0, at_x + width / 2.0, at_y + height / 2.0
            inside = own[0] > frame[0] and own[1] > frame[1] and own[2] < frame[2] and own[3] < frame[3]
            touching = (b[0] < own[2] and own[0] < b[2] and b[1] < own[3] and own[1] < b[3] for b in busy)
            if inside and not any(touching):
                return at_x, at_y, reach
    return None


def _write(axes: Axes, label: Label, at: tuple[float, float], middle: tuple[float, float], reach: float) -> None:
    """Write a label, in points from its own point so that it stays there on every output."""
    per_pixel = 72.0 / axes.figure.dpi
    away = (middle[0] - at[0]) * per_pixel, (middle[1] - at[1]) * per_pixel
    arrow = {"arrowstyle": "-", "linewidth": 0.3, "color": "0.4", "shrinkA": 0.0, "shrinkB": 2.0}
    axes.annotate(
        label.text,
        (label.x, label.y),
        away,
        textcoords="offset points",
        fontsize=label.size,
        ha="center",
        va="center",
        zorder=5,
        arrowprops=arrow if reach >= LONG else None,
    )
