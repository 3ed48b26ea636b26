"""Error against the number of sections: chords alone, jumps on lines and between them; then drawn by hands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...plans.cams.convergence import BETWEEN, CLOSED, DRAWINGS, NODES, Convergence
from ...plans.cams.sectioned import MU_S, R_0, S_MAX, V_MAX
from ..words import Words
from .lettering import Label, put
from .paper import BLACK, GREY, SMALL, TEXT, box, decimals, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SYMBOLS = {V_MAX: "$V_{max}$", S_MAX: "$S_{max}$", MU_S: "$μ_{s}$", R_0: "$r_{0}$", CLOSED: "s"}
MARKERS = {V_MAX: "s", S_MAX: "o", MU_S: "x", R_0: "^", CLOSED: "D"}
LINES: Mapping[str, Any] = {NODES: "-", BETWEEN: (0, (5, 2))}
HANDS: Mapping[str, tuple[Any, str]] = {
    "cad": ((0, (1, 1.2)), "D"),
    "careful": ((0, (6, 1.5, 1, 1.5)), "s"),
    "normal": ("-", "o"),
    "lenient": ((0, (5, 2)), "^"),
}
LEFT, FOOT, TALL, WIDTH = 24.0, 30.0, 152.0, 118.0  # mm
APART, RIGHT = 158.0, 108.0  # mm: where fields of hands begin, and how wide they are
GAP = 11.0
SHOWN = 1e-4  # per cent below which an error is rounding
STEEP = {NODES: 2, BETWEEN: 1}


def sections_page(found: Convergence, words: Words, title: str) -> Figure:
    """Draw errors against numbers of sections."""

    def draw(figure: Figure) -> None:
        # the scale factor errs as the stroke does
        names = [name for name in found.quantities if name != MU_S or S_MAX not in found.quantities]
        _chords(box(figure, LEFT, FOOT, WIDTH, TALL), found, names, words)
        tall = (TALL - GAP * (len(names) - 1)) / len(names)
        for row, name in enumerate(reversed(names)):
            axes = box(figure, APART, FOOT + row * (tall + GAP), RIGHT, tall)
            _hands(axes, found, name, words, row == 0)

    return page(title, words["chart.sections_note"].format(n=DRAWINGS), draw)


def _chords(axes: Axes, found: Convergence, names: Sequence[str], words: Words) -> None:
    """Draw the errors of chords alone, with the slopes that they should have."""
    axes.set_title(words["chart.chords_alone"], loc="left", pad=5.0)
    labels, points = [], []
    for where, counts in found.sections.items():
        for name in names:
            n, error = _visible(counts, found.errors[where, name])
            if not n.size:
                continue
            axes.plot(
                n, error, ls=LINES[where], marker=MARKERS[name], color=BLACK, ms=4.4, mfc="white", mew=0.8, lw=0.9
            )
            points += list(zip(n.tolist(), error.tolist(), strict=True))
            labels.append(Label(float(n[-1]), float(error[-1]), SYMBOLS[name], must=True, size=TEXT))
    logarithmic(axes, found.sections[NODES], words)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.25)
    axes.set_ylabel(words["chart.sections_error"], labelpad=1.0)
    axes.set_xlabel(words["chart.sections_axis"], labelpad=1.0)
    put(axes, labels, points)
    for where in found.sections:
        _slope(axes, found, where, words)


def _visible(counts: tuple[int, ...], errors: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return numbers of sections and errors, per cent, that are no rounding."""
    n, error = np.array(counts, float), 100.0 * np.abs(errors)
    return n[error > SHOWN], error[error > SHOWN]


def _slope(axes: Axes, found: Convergence, where: str, words: Words) -> None:
    """Draw the slope of a family's order, beyond its curves where no other family has any, and say what it is."""
    curves = [_visible(found.sections[where], found.errors[where, name]) for name in found.quantities]
    curves = [(n, error) for n, error in curves if n.size > 2]
    if not curves:
        return
    above = where == BETWEEN
    n, error = sorted(curves, key=lambda curve: float(curve[1][-1]))[-1 if above else 0]
    power, i = STEEP[where], len(n) // 2
    low, high = float(n[i - 1]), float(n[i + 1])
    start = float(error[i - 1]) * (2.6 if above else 0.45)
    axes.plot([low, high], [start, start * (low / high) ** power], color=GREY, lw=2.2, solid_capstyle="butt", zorder=1)
    middle = (low * high) ** 0.5
    axes.annotate(
        f"{words[f'chart.{where}']}: $n^{{-{power}}}$".replace("-", "−"),
        (middle, start * (low / middle) ** power),
        (4.0, 4.0) if above else (-4.0, -4.0),
        textcoords="offset points",
        ha="left" if above else "right",
        va="bottom" if above else "top",
        fontsize=SMALL + 0.5,
    )


def _hands(axes: Axes, found: Convergence, name: str, words: Words, last: bool) -> None:
    """Draw what every hand keeps of one quantity, beside chords without errors of drawing."""
    key = "chart.by_hands_closed" if name == CLOSED else "chart.by_hands"
    said = words[key].format(name=SYMBOLS[name])
    axes.set_title(said, loc="left", fontsize=TEXT, pad=3.0)
    n = np.array(found.drawn, float)
    labels, points = [], []
    for hand, (line, marker) in HANDS.items():
        error = 100.0 * found.hands[hand, name]
        best, least = found.best(hand, name)
        axes.plot(n, error, ls=line, marker=marker, color=BLACK, ms=3.6, mfc="white", mew=0.8, lw=0.9, zorder=3)
        axes.plot(best, 100.0 * least, "o", ms=9.0, mfc="none", mec=BLACK, mew=0.8, zorder=4)
        points += list(zip(n.tolist(), error.tolist(), strict=True))
        labels.append(Label(float(n[-1]), float(error[-1]), words[f"hand.{hand}"], must=True))
    counts, chords = _visible(found.sections[NODES], found.errors[NODES, name])
    inside = counts <= n.max() * 1.01
    axes.plot(counts[inside], chords[inside], color=GREY, lw=2.0, zorder=1)
    logarithmic(axes, found.drawn, words)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, high * 1e-3), high * 1.6)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.9)
    if last:
        axes.set_xlabel(words["chart.sections_axis"], labelpad=1.0)
    put(axes, labels, points)


def logarithmic(axes: Axes, counts: Sequence[float], words: Words) -> None:
    """Give axes logarithmic scales, with these numbers along the abscissa."""
    from matplotlib.ticker import NullLocator

    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticks(counts, [words.short(n) for n in counts])
    axes.yaxis.set_minor_locator(NullLocator())
    decimals(axes.yaxis, words)
    axes.grid(True)
    axes.set_axisbelow(True)
