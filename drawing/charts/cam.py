"""Charts of cams: errors of diagrams by chords against the number of sections, and how the diagrams stand errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...plans.cams.chords import (
    BETWEEN,
    CLOSED,
    DRAWINGS,
    MU_S,
    NODES,
    R_0,
    S_MAX,
    V_MAX,
    WAYS,
    Convergence,
    Robustness,
)
from ..words import Words
from .paper import BLACK, GREY, HANDS, LOOK, SMALL, TEXT, Label, box, curves_of_hands, decimals, logarithmic, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, APART = 24.0, 158.0  # mm: where fields begin
SYMBOLS = {V_MAX: "$V_{max}$", S_MAX: "$S_{max}$", MU_S: "$μ_{s}$", R_0: "$r_{0}$", CLOSED: "s"}
MARKERS = {V_MAX: "s", S_MAX: "o", MU_S: "x", R_0: "^", CLOSED: "D"}
LINES: Mapping[str, Any] = {NODES: "-", BETWEEN: (0, (5, 2))}
GAP = 11.0
SHOWN = 1e-4  # per cent below which an error is rounding
STEEP = {NODES: 2, BETWEEN: 1}
BY_COUNT: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (1, 1.3)))  # lines by the number of sections
FACES: Mapping[str, tuple[str, str]] = {  # face and hatch of what has been closed
    "drawn": ("white", ""),
    "speed": ("white", "////"),
    "stroke": ("0.82", ""),
    "both": ("0.0", ""),
}
BAR = 0.19
MOST = 100.0  # per cent


def sections_page(found: Convergence, words: Words, title: str) -> Figure:
    """Draw errors against numbers of sections: chords alone, jumps on lines and between them; then drawn by hands."""

    def draw(figure: Figure) -> None:
        foot, tall = 30.0, 152.0  # mm
        # the scale factor errs as the stroke does
        names = [name for name in found.quantities if name != MU_S or S_MAX not in found.quantities]
        _chords(box(figure, LEFT, foot, 118.0, tall), found, names, words)
        tall = (tall - GAP * (len(names) - 1)) / len(names)
        for row, name in enumerate(reversed(names)):
            axes = box(figure, APART, foot + row * (tall + GAP), 108.0, tall)
            _hands(axes, found, name, words, words["chart.sections_axis"] if row == 0 else "")

    return page(title, words["chart.sections_note"].format(n=DRAWINGS), draw)


def _chords(axes: Axes, found: Convergence, names: Sequence[str], words: Words) -> None:
    """Draw the errors of chords alone, with the slopes that they should have."""
    axes.set_title(words["chart.chords_alone"], fontsize=TEXT + 1.5)
    axes.set_xlabel(words["chart.sections_axis"])
    axes.set_ylabel(words["chart.sections_error"])
    labels, points = [], []
    for where, counts in found.sections.items():
        for name in names:
            n, error = _visible(counts, found.errors[where, name])
            if not n.size:
                continue
            axes.plot(n, error, ls=LINES[where], marker=MARKERS[name], ms=4.4, **LOOK)
            points += list(zip(n.tolist(), error.tolist(), strict=True))
            labels.append(Label(float(n[-1]), float(error[-1]), SYMBOLS[name], must=True, size=TEXT))
    logarithmic(axes, found.sections[NODES], words)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.25)
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


def _hands(axes: Axes, found: Convergence, name: str, words: Words, across: str) -> None:
    """Draw what every hand keeps of one quantity, beside chords without errors of drawing."""
    key = "chart.by_hands_closed" if name == CLOSED else "chart.by_hands"
    axes.set_title(words[key].format(name=SYMBOLS[name]), fontsize=TEXT, pad=3.0)
    axes.set_xlabel(across)
    n = np.array(found.drawn, float)
    best = {hand: found.best(hand, name) for hand in HANDS}
    ringed = {hand: (count, 100.0 * least) for hand, (count, least) in best.items()}
    errors = {hand: 100.0 * found.hands[hand, name] for hand in HANDS}
    labels, points = curves_of_hands(axes, n, errors, ringed, words)
    counts, chords = _visible(found.sections[NODES], found.errors[NODES, name])
    inside = counts <= n.max() * 1.01
    axes.plot(counts[inside], chords[inside], color=GREY, lw=2.0, zorder=1)
    logarithmic(axes, found.drawn, words)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, high * 1e-3), high * 1.6)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.9)
    put(axes, labels, points)


def stability_page(found: Robustness, words: Words, title: str, note: str) -> Figure:
    """Draw how diagrams by chords stand errors: a section line beside a jump, and what closing a drawing brings."""

    def draw(figure: Figure) -> None:
        if found.beside:
            _missed(box(figure, LEFT, 34.0, 112.0, 148.0), found, words)
        else:
            figure.text(LEFT / 297.0, 0.5, words["chart.no_jumps"], fontsize=TEXT)
        _closings(box(figure, 164.0, 34.0, 106.0, 148.0), found, words)

    return page(title, note, draw)


def _missed(axes: Axes, found: Robustness, words: Words) -> None:
    """Draw errors over the place of a section line beside its jump."""
    axes.set_title(words["chart.line_beside"])
    axes.set_xlabel(words["chart.late"], labelpad=2.0)
    axes.set_ylabel(words["chart.sections_error"])
    counts = list(dict.fromkeys(n for n, _ in found.missed))
    labels, points = [], []
    for n, line in zip(counts, BY_COUNT, strict=False):
        for name in (V_MAX, S_MAX, R_0):
            if (n, name) not in found.missed:
                continue
            error = 100.0 * found.missed[n, name]
            axes.plot(found.beside, error, ls=line, marker=MARKERS[name], markevery=5, ms=3.8, **LOOK)
            points += list(zip(found.beside, error.tolist(), strict=True))
            if n == counts[0]:
                labels.append(Label(found.beside[-1], float(error[-1]), SYMBOLS[name], must=True, size=TEXT))
    axes.axhline(0.0, color=BLACK, lw=0.6)
    axes.axvline(0.0, color=BLACK, lw=0.6)
    axes.set_xlim(-0.5, 0.6)
    axes.set_ylim(-MOST, MOST)
    axes.set_xticks([-0.5, -0.25, 0.0, 0.25, 0.5])
    decimals(axes.xaxis, words)
    put(axes, labels, points)
    for n, line in zip(counts, BY_COUNT, strict=False):
        axes.plot([], [], ls=line, color=BLACK, lw=0.9, label=f"n = {n}")
    axes.legend(loc="lower left", frameon=False, fontsize=SMALL + 0.5, handlelength=3.0)


def _closings(axes: Axes, found: Robustness, words: Words) -> None:
    """Draw for every hand a bar for each way of closing."""
    axes.set_title(words["chart.travel_error"])
    axes.grid(False, axis="x")
    for k, way in enumerate(WAYS):
        face, hatch = FACES[way]
        heights = [100.0 * closing.errors.get(way, 0.0) for closing in found.closings.values()]
        places = [i + (k - 1.5) * BAR for i in range(len(heights))]
        said = words[f"chart.closed.{way}"].rpartition(",")[0]
        axes.bar(places, heights, BAR, color=face, edgecolor=BLACK, lw=0.7, hatch=hatch, label=said, zorder=2)
        for x, height in zip(places, heights, strict=True):
            if height:
                beside: dict[str, Any] = {"xytext": (0.0, 1.5), "textcoords": "offset points", "ha": "center"}
                axes.annotate(words.short(height, 2), (x, height), fontsize=SMALL - 0.5, **beside)
    axes.set_yscale("log")
    axes.set_ylim(0.5, 300.0)
    decimals(axes.yaxis, words)
    axes.yaxis.minorticks_off()
    axes.set_xticks(range(len(found.closings)), [words[f"hand.{hand}"] for hand in found.closings])
    axes.tick_params(axis="x", length=0.0)
    axes.legend(loc="upper left", frameon=False, fontsize=SMALL + 0.5, handlelength=1.6)
