"""The paper of charts: A4 pages of matplotlib in black on white, their fields and curves, labels that touch nothing.

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
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from ...scales.errors import RAISED

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
    "axes.titley": 1.0,  # where it stands anyhow, found without measuring all axes
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
LINES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (6, 1.5, 1, 1.5)), (0, (1, 1.2)), (0, (10, 3)), (0, (3, 1, 1, 1, 1, 1)))
SOLID, DASHED, CHAINED, DOTTED, LONG, MIXED = LINES
MARKERS = "os^Dvx"
CURVE: dict[str, Any] = {"color": BLACK, "lw": 0.9, "mfc": "white", "mew": 0.8}
BESIDE: dict[str, Any] = {"textcoords": "offset points", "fontsize": SMALL}
LEGEND: dict[str, Any] = {"fontsize": SMALL + 0.5, "frameon": False}
LIMIT: Mapping[str, Any] = {"color": BLACK, "lw": 0.9, "ls": DASHED}  # of the line at a tolerance
WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}  # under a number

Box = tuple[float, float, float, float]
POINT = 4.0  # pixels around a point that stay free
REACHES = (7.0, 11.0, 16.0, 23.0, 31.0)  # pixels from a point to its label
FAR = 16.0  # from here on a thin line leads to the label
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


def box(figure: Figure, place: Box, tall: float = HEIGHT, **settings: Any) -> Axes:
    """Return axes in a box of a page `tall` mm tall: left, bottom, width, height, mm; settings are those of axes."""
    left, bottom, width, height = place
    axes = figure.add_axes((left / WIDTH, bottom / tall, width / WIDTH, height / tall))
    axes.set(**settings)
    return axes


def curve(axes: Axes, k: int, x: Any, y: Any, **look: Any) -> None:
    """Draw a curve with the line and the marker of the k-th of its field."""
    own = {"ls": LINES[k % len(LINES)], "marker": MARKERS[k % len(MARKERS)], "ms": 4.0}
    axes.plot(x, y, **(CURVE | own | look))


def beside(axes: Axes, text: str, at: tuple[float, float], by: tuple[float, float], **look: Any) -> None:
    """Write a small text beside a place, away from it by so many points."""
    axes.annotate(text, at, by, **(BESIDE | look))


def legend(axes: Axes, corner: Any, **look: Any) -> None:
    """Write what the curves of a field are, in one of its corners."""
    axes.legend(loc=corner, **(LEGEND | look))


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


def powers(*axes: Axis) -> None:
    """Write the numbers of axes as powers of ten, of plain letters: those of mathtext take ten times as long."""
    from matplotlib.ticker import FuncFormatter

    for axis in axes:
        axis.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(value)))


def power_of_ten(value: float) -> str:
    """Return a power of ten as it is written.

    >>> power_of_ten(1e-5), power_of_ten(1000)
    ('10⁻⁵', '10³')
    """
    return f"10{str(round(math.log10(value))).translate(RAISED)}"


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
        box_of_frame = frame.x0, frame.y0, frame.x1, frame.y1
        free = _free((x, y), (extent.width, extent.height), label.prefer, busy, box_of_frame)
        if free is None and not label.must:
            continue
        at_x, at_y, reach = free or (x, y + 2.0 * POINT, 0.0)
        per_pixel = 72.0 / axes.figure.dpi  # a label stands in points from its own point, so on every output
        away = (at_x - x) * per_pixel, (at_y - y) * per_pixel
        arrow = {"arrowstyle": "-", "linewidth": 0.3, "color": "0.4", "shrinkA": 0.0, "shrinkB": 2.0}
        look: Any = {"ha": "center", "va": "center", "zorder": 5, "arrowprops": arrow if reach >= FAR else None}
        beside(axes, label.text, (label.x, label.y), away, fontsize=label.size, **look)
        half_w, half_h = extent.width / 2.0, extent.height / 2.0
        busy.append((at_x - half_w, at_y - half_h, at_x + half_w, at_y + half_h))


def _free(
    at: tuple[float, float], size: tuple[float, float], prefer: tuple[float, float], busy: list[Box], frame: Box
) -> tuple[float, float, float] | None:
    """Return the middle of the nearest free box for a text, and how far it is from its point; None without any."""
    half_w, half_h = size[0] / 2.0, size[1] / 2.0
    ranked = sorted(DIRECTIONS, key=lambda d: -(d[0] * prefer[0] + d[1] * prefer[1]) / math.hypot(*d))
    for reach, (dx, dy) in product(REACHES, ranked):
        away = 0.7 * reach if dx and dy else reach
        x, y = at[0] + dx * (away + half_w), at[1] + dy * (away + half_h)
        own = x - half_w, y - half_h, x + half_w, y + half_h
        inside = own[0] > frame[0] and own[1] > frame[1] and own[2] < frame[2] and own[3] < frame[3]
        if inside and not any(b[0] < own[2] and own[0] < b[2] and b[1] < own[3] and own[1] < b[3] for b in busy):
            return x, y, reach
    return None
