"""How diagrams by chords stand errors: a section line beside a jump, and what closing a drawing brings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ...plans.cams.closing import WAYS
from ...plans.cams.robustness import Robustness
from ...plans.cams.sectioned import R_0, S_MAX, V_MAX
from ..words import Words
from .lettering import Label, put
from .paper import BLACK, SMALL, TEXT, box, decimals, page
from .sections import SYMBOLS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT, TALL, WIDTH = 24.0, 34.0, 148.0, 112.0  # mm
APART, RIGHT = 164.0, 106.0
CURVES = ((V_MAX, "s"), (S_MAX, "o"), (R_0, "^"))
LINES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (1, 1.3)))  # by the number of sections
FACES: Mapping[str, tuple[str, str]] = {  # face and hatch of what has been closed
    "drawn": ("white", ""),
    "speed": ("white", "////"),
    "stroke": ("0.82", ""),
    "both": ("0.0", ""),
}
BAR = 0.19
MOST = 100.0  # per cent


def stability_page(found: Robustness, words: Words, title: str, note: str) -> Figure:
    """Draw how the diagrams of a cam stand errors."""

    def draw(figure: Figure) -> None:
        if found.beside:
            _missed(box(figure, LEFT, FOOT, WIDTH, TALL), found, words)
        else:
            figure.text(LEFT / 297.0, 0.5, words["chart.no_jumps"], fontsize=TEXT)
        _closings(box(figure, APART, FOOT, RIGHT, TALL), found, words)

    return page(title, note, draw)


def _missed(axes: Axes, found: Robustness, words: Words) -> None:
    """Draw errors over the place of a section line beside its jump."""
    axes.set_title(words["chart.line_beside"], loc="left", fontsize=TEXT + 0.5, pad=5.0)
    counts = list(dict.fromkeys(n for n, _ in found.missed))
    labels, points = [], []
    for n, line in zip(counts, LINES, strict=False):
        for name, marker in CURVES:
            if (n, name) not in found.missed:
                continue
            error = 100.0 * found.missed[n, name]
            look = {"ls": line, "marker": marker, "markevery": 5, "ms": 3.8, "mfc": "white", "mew": 0.8, "lw": 0.9}
            axes.plot(found.beside, error, color=BLACK, **look)
            points += list(zip(found.beside, error.tolist(), strict=True))
            if n == counts[0]:
                labels.append(Label(found.beside[-1], float(error[-1]), SYMBOLS[name], must=True, size=TEXT))
    axes.axhline(0.0, color=BLACK, lw=0.6)
    axes.axvline(0.0, color=BLACK, lw=0.6)
    axes.set_xlim(-0.5, 0.6)
    axes.set_ylim(-MOST, MOST)
    axes.set_xticks([-0.5, -0.25, 0.0, 0.25, 0.5])
    decimals(axes.xaxis, words)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.late"], labelpad=2.0)
    axes.set_ylabel(words["chart.sections_error"], labelpad=1.0)
    put(axes, labels, points)
    for n, line in zip(counts, LINES, strict=False):
        axes.plot([], [], ls=line, color=BLACK, lw=0.9, label=f"n = {n}")
    axes.legend(loc="lower left", frameon=False, fontsize=SMALL + 0.5, handlelength=3.0)


def _closings(axes: Axes, found: Robustness, words: Words) -> None:
    """Draw for every hand a bar for each way of closing."""
    axes.set_title(words["chart.travel_error"], loc="left", fontsize=TEXT + 0.5, pad=5.0)
    for k, way in enumerate(WAYS):
        face, hatch = FACES[way]
        heights = [100.0 * closing.errors.get(way, 0.0) for closing in found.closings.values()]
        places = [i + (k - 1.5) * BAR for i in range(len(heights))]
        said = words[f"chart.closed.{way}"].rpartition(",")[0]
        axes.bar(places, heights, BAR, color=face, edgecolor=BLACK, lw=0.7, hatch=hatch, label=said, zorder=2)
        for x, height in zip(places, heights, strict=True):
            if height:
                number = words.short(height, 2)
                axes.annotate(
                    number, (x, height), (0.0, 1.5), textcoords="offset points", ha="center", fontsize=SMALL - 0.5
                )
    axes.set_yscale("log")
    axes.set_ylim(0.5, 300.0)
    decimals(axes.yaxis, words)
    axes.yaxis.minorticks_off()
    axes.set_xticks(range(len(found.closings)), [words[f"hand.{hand}"] for hand in found.closings])
    axes.tick_params(axis="x", length=0.0)
    axes.grid(True, axis="y")
    axes.set_axisbelow(True)
    axes.legend(loc="upper left", frameon=False, fontsize=SMALL + 0.5, handlelength=1.6)
