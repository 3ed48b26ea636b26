"""The paper of charts: A4 pages of matplotlib in black on white; the same input gives the same bytes."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

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
    "axes.titlesize": TEXT + 1.5,
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


@contextmanager
def _styled() -> Iterator[None]:
    """Draw in our style, whatever the user's own settings of matplotlib are."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        for name, value in STYLE.items():
            matplotlib.rcParams[name] = value  # type: ignore[index]
        yield


def page(title: str, note: str, draw: Callable[[Figure], None], height: float = HEIGHT) -> Figure:
    """Return a page, `height` mm tall, with its title, what `draw` draws between, and a note at its foot."""
    with _styled():
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        figure = Figure(figsize=(WIDTH * MM, height * MM), dpi=DPI)
        FigureCanvasAgg(figure)
        figure.text(LEFT / WIDTH, 1.0 - (TOP - 4.0) / height, title, fontsize=TEXT + 2.5, va="center")
        lines = "\n".join(line for part in note.split("\n") for line in textwrap.wrap(part, 175) or [""])
        figure.text(LEFT / WIDTH, BOTTOM / height, lines, fontsize=SMALL, va="center", linespacing=1.35)
        draw(figure)
    return figure


def box(figure: Figure, left: float, bottom: float, width: float, height: float, tall: float = HEIGHT) -> Axes:
    """Return axes in a box of a page `tall` mm tall, mm."""
    return figure.add_axes((left / WIDTH, bottom / tall, width / WIDTH, height / tall))


def saved(figures: Sequence[Figure], suffix: str) -> list[bytes]:
    """Return the files of pages: one for all as PDF, one for each otherwise."""
    with _styled():
        if suffix != ".pdf":
            return [_bytes(figure, suffix) for figure in figures]
        from matplotlib.backends.backend_pdf import PdfPages

        stream = BytesIO()
        with PdfPages(stream, metadata=METADATA[suffix]) as pages:
            for figure in figures:
                pages.savefig(figure)
        return [stream.getvalue()]


def _bytes(figure: Figure, suffix: str) -> bytes:
    stream = BytesIO()
    figure.savefig(stream, format=suffix.removeprefix("."), metadata=METADATA[suffix])
    return stream.getvalue()


def mathtext(markup: str) -> str:
    r"""Return the markup of a symbol, `V_{B}`, as matplotlib writes it.

    >>> mathtext(r"\bar{a}^{n}_{BA}")
    '$\\overline{a}^{n}_{BA}$'
    """
    if not re.search(r"[\\^_]", markup):
        return markup
    return "$" + markup.replace(r"\bar", r"\overline") + "$"


def decimals(axis: Axis, words: Words) -> None:
    """Write the numbers of an axis in the language's way."""
    from matplotlib.ticker import FuncFormatter

    axis.set_major_formatter(FuncFormatter(lambda value, _: words.short(float(f"{value:.10g}"))))
