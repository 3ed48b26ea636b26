"""Errors of drawings: diagrams of cams over the number of sections, the meshing of gears over the scale, by hands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...plans.cams import chords
from ...plans.gears.solve import MILLI, ScaleErrors
from ..gears.sheet import lettered
from ..words import Words
from .paper import BLACK, GREY, LOOK, SMALL, TEXT, Label, box, decimals, mathtext, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, APART = 24.0, 158.0  # mm: where fields begin
FOOT, WIDE, TALL = 30.0, 258.0, 152.0  # mm: all fields together
GAP, GEAR_GAP = 11.0, 16.0
RING: Mapping[str, Any] = {"ms": 9.0, "mfc": "none", "mec": BLACK, "mew": 0.8, "zorder": 4}
HANDS: Mapping[str, tuple[Any, str]] = {  # line and marker of the curve of each
    "cad": ((0, (1, 1.2)), "D"),
    "careful": ((0, (6, 1.5, 1, 1.5)), "s"),
    "normal": ("-", "o"),
    "lenient": ((0, (5, 2)), "^"),
}
LOOKS: Mapping[str, tuple[str, str]] = {  # symbol and marker of each quantity of a cam
    chords.V_MAX: ("$V_{max}$", "s"),
    chords.S_MAX: ("$S_{max}$", "o"),
    chords.MU_S: ("$μ_{s}$", "x"),
    chords.R_0: ("$r_{0}$", "^"),
    chords.CLOSED: ("s", "D"),
}
# line of each family of curves, and the order of its error
FAMILIES: Mapping[str, tuple[Any, int]] = {chords.NODES: ("-", 2), chords.BETWEEN: ((0, (5, 2)), 1)}
SHOWN = 1e-4  # per cent below which an error is rounding
BY_COUNT: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (1, 1.3)))  # lines by the number of sections
FACES: Mapping[str, tuple[str, str]] = {  # face and hatch of what has been closed
    "drawn": ("white", ""),
    "speed": ("white", "////"),
    "stroke": ("0.82", ""),
    "both": ("0.0", ""),
}
BAR = 0.19
MOST = 100.0  # per cent
BESIDE = 1.06  # of the last scale: clear of a ring
HIGH = 50.0  # mm, that a drawn tooth should be high
LEGEND: Any = {"frameon": False, "fontsize": SMALL + 0.5}


def logarithmic(axes: Axes, counts: Sequence[float], words: Words) -> None:
    """Give axes logarithmic scales, with these numbers along the abscissa."""
    from matplotlib.ticker import NullLocator

    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticks(counts, [words.short(n) for n in counts])
    axes.yaxis.set_minor_locator(NullLocator())
    decimals(words, axes.yaxis)


def curves_of_hands(
    axes: Axes,
    x: NDArray[Any],
    errors: Mapping[str, NDArray[Any]],
    ringed: Mapping[str, tuple[float, float] | None],
    words: Words,
) -> tuple[list[Label], list[tuple[float, float]]]:
    """Draw what every hand keeps of a quantity, per cent, one place of each in a ring.

    Returns labels at the ends of the curves, and points, for `put`.
    """
    labels, points = [], []
    for hand, (line, marker) in HANDS.items():
        axes.plot(x, errors[hand], ls=line, marker=marker, ms=3.6, zorder=3, **LOOK)
        if (place := ringed[hand]) is not None:
            axes.plot(*place, "o", **RING)
        points += list(zip(x.tolist(), errors[hand].tolist(), strict=True))
        labels.append(Label(float(x[-1]), float(errors[hand][-1]), words[f"hand.{hand}"], must=True))
    return labels, points


def sections_page(found: chords.Convergence, words: Words, title: str, note: str) -> Figure:
    """Draw errors against numbers of sections: chords alone, jumps on lines and between them; then drawn by hands."""
    # the scale factor errs as the stroke does
    names = [name for name in found.quantities if name != chords.MU_S or chords.S_MAX not in found.quantities]
    tall = (TALL - GAP * (len(names) - 1)) / len(names)
    with page(title, note) as figure:
        _chords(box(figure, LEFT, FOOT, 118.0, TALL), found, names, words)
        for row, name in enumerate(reversed(names)):
            axes = box(figure, APART, FOOT + row * (tall + GAP), 108.0, tall)
            _hands(axes, found, name, words, words["chart.sections_axis"] if row == 0 else "")
    return figure


def _chords(axes: Axes, found: chords.Convergence, names: Sequence[str], words: Words) -> None:
    """Draw the errors of chords alone, with the slopes that they should have."""
    axes.set_title(words["chart.chords_alone"], fontsize=TEXT + 1.5)
    axes.set(xlabel=words["chart.sections_axis"], ylabel=words["chart.sections_error"])
    labels, points = [], []
    for where, counts in found.sections.items():
        for name in names:
            n, error = _visible(counts, found.errors[where, name])
            if not n.size:
                continue
            symbol, marker = LOOKS[name]
            axes.plot(n, error, ls=FAMILIES[where][0], marker=marker, ms=4.4, **LOOK)
            points += list(zip(n.tolist(), error.tolist(), strict=True))
            labels.append(Label(float(n[-1]), float(error[-1]), symbol, must=True, size=TEXT))
    logarithmic(axes, found.sections[chords.NODES], words)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.25)
    put(axes, labels, points)
    for where in found.sections:
        _slope(axes, found, where, words)


def _visible(counts: tuple[int, ...], errors: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return numbers of sections and errors, per cent, that are no rounding."""
    n, error = np.array(counts, float), 100.0 * np.abs(errors)
    return n[error > SHOWN], error[error > SHOWN]


def _slope(axes: Axes, found: chords.Convergence, where: str, words: Words) -> None:
    """Draw the slope of a family's order, beyond its curves where no other family has any, and say what it is."""
    curves = [_visible(found.sections[where], found.errors[where, name]) for name in found.quantities]
    curves = [(n, error) for n, error in curves if n.size > 2]
    if not curves:
        return
    above, power = where == chords.BETWEEN, FAMILIES[where][1]
    n, error = sorted(curves, key=lambda curve: float(curve[1][-1]))[-1 if above else 0]
    i = len(n) // 2
    low, high = float(n[i - 1]), float(n[i + 1])
    start = float(error[i - 1]) * (2.6 if above else 0.45)
    axes.plot([low, high], [start, start * (low / high) ** power], color=GREY, lw=2.2, solid_capstyle="butt", zorder=1)
    middle = (low * high) ** 0.5
    text, side = f"{words[f'chart.{where}']}: $n^{{-{power}}}$".replace("-", "−"), 1.0 if above else -1.0
    place: Any = {"ha": "left", "va": "bottom"} if above else {"ha": "right", "va": "top"}
    place |= {"xytext": (4.0 * side, 4.0 * side), "textcoords": "offset points", "fontsize": SMALL + 0.5}
    axes.annotate(text, (middle, start * (low / middle) ** power), **place)


def _hands(axes: Axes, found: chords.Convergence, name: str, words: Words, across: str) -> None:
    """Draw what every hand keeps of one quantity, beside chords without errors of drawing."""
    key = "chart.by_hands_closed" if name == chords.CLOSED else "chart.by_hands"
    axes.set_title(words[key].format(name=LOOKS[name][0]), fontsize=TEXT, pad=3.0)
    axes.set_xlabel(across)
    n = np.array(found.drawn, float)
    best = {hand: found.best(hand, name) for hand in HANDS}
    ringed = {hand: (count, 100.0 * least) for hand, (count, least) in best.items()}
    errors = {hand: 100.0 * found.hands[hand, name] for hand in HANDS}
    labels, points = curves_of_hands(axes, n, errors, ringed, words)
    counts, alone = _visible(found.sections[chords.NODES], found.errors[chords.NODES, name])
    inside = counts <= n.max() * 1.01
    axes.plot(counts[inside], alone[inside], color=GREY, lw=2.0, zorder=1)
    logarithmic(axes, found.drawn, words)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, high * 1e-3), high * 1.6)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.9)
    put(axes, labels, points)


def closing_page(found: chords.Robustness, words: Words, title: str, note: str) -> Figure:
    """Draw how diagrams by chords stand errors: a section line beside a jump, and what closing a drawing brings."""
    with page(title, note) as figure:
        if found.beside:
            _missed(box(figure, LEFT, 34.0, 112.0, 148.0), found, words)
        else:
            figure.text(LEFT / 297.0, 0.5, words["chart.no_jumps"], fontsize=TEXT)
        _closings(box(figure, 164.0, 34.0, 106.0, 148.0), found, words)
    return figure


def _missed(axes: Axes, found: chords.Robustness, words: Words) -> None:
    """Draw errors over the place of a section line beside its jump."""
    axes.set(title=words["chart.line_beside"], ylabel=words["chart.sections_error"])
    axes.set_xlabel(words["chart.late"], labelpad=2.0)
    counts = list(dict.fromkeys(n for n, _ in found.missed))
    labels, points = [], []
    for n, line in zip(counts, BY_COUNT, strict=False):
        for name in (chords.V_MAX, chords.S_MAX, chords.R_0):
            if (n, name) not in found.missed:
                continue
            error, (symbol, marker) = 100.0 * found.missed[n, name], LOOKS[name]
            axes.plot(found.beside, error, ls=line, marker=marker, markevery=5, ms=3.8, **LOOK)
            points += list(zip(found.beside, error.tolist(), strict=True))
            if n == counts[0]:
                labels.append(Label(found.beside[-1], float(error[-1]), symbol, must=True, size=TEXT))
    axes.axhline(0.0, color=BLACK, lw=0.6)
    axes.axvline(0.0, color=BLACK, lw=0.6)
    axes.set(xlim=(-0.5, 0.6), ylim=(-MOST, MOST), xticks=[-0.5, -0.25, 0.0, 0.25, 0.5])
    decimals(words, axes.xaxis)
    put(axes, labels, points)
    for n, line in zip(counts, BY_COUNT, strict=False):
        axes.plot([], [], ls=line, color=BLACK, lw=0.9, label=f"n = {n}")
    axes.legend(loc="lower left", handlelength=3.0, **LEGEND)


def _closings(axes: Axes, found: chords.Robustness, words: Words) -> None:
    """Draw for every hand a bar for each way of closing."""
    axes.set_title(words["chart.travel_error"])
    axes.grid(False, axis="x")
    for k, way in enumerate(chords.WAYS):
        face, hatch = FACES[way]
        heights = [100.0 * closing.errors.get(way, 0.0) for closing in found.closings.values()]
        places = [i + (k - 1.5) * BAR for i in range(len(heights))]
        said = words[f"chart.closed.{way}"].rpartition(",")[0]
        axes.bar(places, heights, BAR, color=face, edgecolor=BLACK, lw=0.7, hatch=hatch, label=said, zorder=2)
        for x, height in zip(places, heights, strict=True):
            if height:
                beside: dict[str, Any] = {"xytext": (0.0, 1.5), "textcoords": "offset points", "ha": "center"}
                axes.annotate(words.short(height, 2), (x, height), fontsize=SMALL - 0.5, **beside)
    axes.set(yscale="log", ylim=(0.5, 300.0))
    decimals(words, axes.yaxis)
    axes.yaxis.minorticks_off()
    axes.set_xticks(range(len(found.closings)), [words[f"hand.{hand}"] for hand in found.closings])
    axes.tick_params(axis="x", length=0.0)
    axes.legend(loc="upper left", handlelength=1.6, **LEGEND)


def scales_page(found: ScaleErrors, words: Words, title: str, note: str, tolerances: Mapping[str, float]) -> Figure:
    """Draw the errors of hands against scales, a field for each quantity; `tolerances` are parts, by hand."""
    count = len(found.quantities)
    wide = (WIDE - GEAR_GAP * (count - 1)) / count
    with page(title, note) as figure:
        for k, name in enumerate(found.quantities):
            axes = box(figure, LEFT + k * (wide + GEAR_GAP), FOOT, wide, TALL)
            _scales(axes, found, name, lettered(words), tolerances)
    return figure


def _scales(axes: Axes, found: ScaleErrors, name: str, words: Words, tolerances: Mapping[str, float]) -> None:
    """Draw what every hand keeps of one quantity, what is let pass of it, and where a tooth is as high as usual."""
    axes.set_title(words["chart.by_hands"].format(name=mathtext(words.symbol(name))), fontsize=TEXT, pad=3.0)
    axes.set_xlabel(words["chart.scale_axis"])
    errors = {hand: 100.0 * found.errors[hand, name] for hand in HANDS}
    enough = {hand: found.enough(hand, name, tolerances[hand]) for hand in HANDS}
    ringed = {
        hand: None if ratio is None else (ratio, errors[hand][found.ratios.index(ratio)])
        for hand, ratio in enough.items()
    }
    labels, points = curves_of_hands(axes, np.array(found.ratios), errors, ringed, words)
    logarithmic(axes, found.ratios, words)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * 1.3)
    axes.set_xlim(right=axes.get_xlim()[1] * 2.0)
    ratio = HIGH * MILLI / found.tooth
    if axes.get_xlim()[0] < ratio < axes.get_xlim()[1]:
        axes.axvline(ratio, color=GREY, lw=0.8, ls=(0, (8, 2, 1, 2)), zorder=1)
        text, top = words["chart.scale_tooth"].format(height=words.short(HIGH)), (ratio, axes.get_ylim()[1])
        place: Any = {"xytext": (-3.0, -4.0), "textcoords": "offset points", "ha": "right", "va": "top"}
        axes.annotate(text, top, rotation=90, fontsize=SMALL, **place)
    put(axes, [replace(label, x=BESIDE * label.x) for label in labels], points)
