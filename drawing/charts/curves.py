"""Curves over a setting: errors of drawings, of steps, of ways to a root, by how fine or how long they are."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...plans.cams import chords
from ...plans.gears.solve import MILLI, ScaleErrors
from ...plans.hands.shaky import PRESETS
from ...plans.lab.hoists import Steps, Ways
from ...plans.lab.integrators import RK4, VERLET, growth
from ...scales.errors import RAISED
from ..words import Words
from . import paper
from .paper import Label, beside, box, curve, decimals, legend, mathtext, page, powers, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[Any]
Points = tuple[list[Label], list[tuple[float, float]]]  # labels at the ends of curves, and all points, for `put`
PERCENT = 100.0
LEFT, APART = 24.0, 158.0  # mm: where fields begin
FOOT, WIDE, TALL = 30.0, 258.0, 152.0  # mm: all fields together
GAP, GEAR_GAP = 11.0, 16.0
RING: Mapping[str, Any] = {"ms": 9.0, "mfc": "none", "mec": paper.BLACK, "mew": 0.8, "zorder": 4}
SYMBOLS: Mapping[str, str] = {  # of quantities of a cam
    chords.V_MAX: "$V_{max}$",
    chords.S_MAX: "$S_{max}$",
    chords.MU_S: "$μ_{s}$",
    chords.R_0: "$r_{0}$",
    chords.CLOSED: "s",
}
# line of each family of curves, and the order of its error
FAMILIES: Mapping[str, tuple[Any, int]] = {chords.NODES: (paper.SOLID, 2), chords.BETWEEN: (paper.DASHED, 1)}
ROUNDING = 1e-4  # per cent below which an error is rounding
FACES = {"drawn": ("white", ""), "speed": ("white", "////"), "stroke": ("0.82", ""), "both": ("0.0", "")}  # and hatch
BAR = 0.19
HIGH = 50.0  # mm, that a drawn tooth should be high
REFUSED, ROW = 6.0, 3.6  # where refused runs stand on the axis of errors, and how far apart those of two methods
LIMITED = {VERLET: (-6.0, 9.0, "right"), RK4: (8.0, -10.0, "left")}  # limits, and where their labels stand
FARTHEST = 4.0  # k h
SHOWN = 50  # evaluations
FLOOR = 3e-17


def _logarithmic(axes: Axes, counts: Sequence[float], words: Words) -> None:
    """Give axes logarithmic scales, with these numbers along the abscissa."""
    from matplotlib.ticker import NullLocator

    axes.set(xscale="log", yscale="log")
    axes.set_xticks(counts, [words.short(n) for n in counts])
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())
    decimals(words, axes.yaxis)


def _by_hands(
    axes: Axes, x: Array, errors: Mapping[str, Array], rings: Mapping[str, int | None], words: Words
) -> Points:
    """Draw what every hand keeps of a quantity, one place of each in a ring."""
    labels, points = [], []
    for k, (hand, parts) in enumerate(errors.items()):
        error, at = PERCENT * parts, rings[hand]
        curve(axes, k, x, error, ms=3.6, zorder=3)
        if at is not None:
            axes.plot(x[at], error[at], "o", **RING)
        points += list(zip(x.tolist(), error.tolist(), strict=True))
        labels.append(Label(*points[-1], words[f"hand.{hand}"], must=True))
    return labels, points


def sections_page(found: chords.Convergence, words: Words, title: str, note: str) -> Figure:
    """Draw errors against numbers of sections: chords alone, jumps on lines and between them; then drawn by hands."""
    # the scale factor errs as the stroke does
    names = [name for name in found.quantities if name != chords.MU_S or chords.S_MAX not in found.quantities]
    tall, across = (TALL - GAP * (len(names) - 1)) / len(names), words["chart.sections_axis"]
    with page(title, note) as figure:
        _chords(box(figure, (LEFT, FOOT, 118.0, TALL), xlabel=across), found, names, words)
        for row, name in enumerate(reversed(names)):
            place = (APART, FOOT + row * (tall + GAP), 108.0, tall)
            _sections(box(figure, place, xlabel=across if row == 0 else ""), found, name, words)
    return figure


def _chords(axes: Axes, found: chords.Convergence, names: Sequence[str], words: Words) -> None:
    """Draw the errors of chords alone, with the slopes that they should have."""
    axes.set_title(words["chart.chords_alone"], fontsize=paper.TEXT + 1.5)
    axes.set(ylabel=words["chart.sections_error"])
    labels, points = [], []
    for where in found.sections:
        for k, name in enumerate(names):
            n, error = _visible(found, where, name)
            if n.size:
                curve(axes, k, n, error, ls=FAMILIES[where][0], ms=4.4)
                points += list(zip(n.tolist(), error.tolist(), strict=True))
                labels.append(Label(*points[-1], SYMBOLS[name], must=True, size=paper.TEXT))
    _logarithmic(axes, found.sections[chords.NODES], words)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.25)
    put(axes, labels, points)
    for where in found.sections:
        _slope(axes, found, where, words)


def _visible(found: chords.Convergence, where: str, name: str) -> tuple[Array, Array]:
    """Return numbers of sections and errors, per cent, that are no rounding."""
    n, error = np.array(found.sections[where], float), PERCENT * np.abs(found.errors[where, name])
    return n[error > ROUNDING], error[error > ROUNDING]


def _slope(axes: Axes, found: chords.Convergence, where: str, words: Words) -> None:
    """Draw the slope of a family's order, beyond its curves where no other family has any, and say what it is."""
    curves = [(n, error) for n, error in (_visible(found, where, name) for name in found.quantities) if n.size > 2]
    if not curves:
        return
    above, power = where == chords.BETWEEN, FAMILIES[where][1]
    n, error = sorted(curves, key=lambda pair: float(pair[1][-1]))[-1 if above else 0]
    i = len(n) // 2
    low, high, start = float(n[i - 1]), float(n[i + 1]), float(error[i - 1]) * (2.6 if above else 0.45)
    axes.plot(
        [low, high], [start, start * (low / high) ** power], color=paper.GREY, lw=2.2, solid_capstyle="butt", zorder=1
    )
    middle = (low * high) ** 0.5
    text, away = f"{words[f'chart.{where}']}: n{str(-power).translate(RAISED)}", 4.0 if above else -4.0
    sides: Any = {"ha": "left", "va": "bottom"} if above else {"ha": "right", "va": "top"}
    beside(axes, text, (middle, start * (low / middle) ** power), (away, away), fontsize=paper.SMALL + 0.5, **sides)


def _sections(axes: Axes, found: chords.Convergence, name: str, words: Words) -> None:
    """Draw what every hand keeps of one quantity, beside chords without errors of drawing."""
    key = "chart.by_hands_closed" if name == chords.CLOSED else "chart.by_hands"
    axes.set_title(words[key].format(name=SYMBOLS[name]), fontsize=paper.TEXT, pad=3.0)
    n = np.array(found.drawn, float)
    best = {hand: found.drawn.index(found.best(hand, name)[0]) for hand in PRESETS}
    labels, points = _by_hands(axes, n, {hand: found.hands[hand, name] for hand in PRESETS}, best, words)
    counts, alone = _visible(found, chords.NODES, name)
    inside = counts <= n.max() * 1.01
    axes.plot(counts[inside], alone[inside], color=paper.GREY, lw=2.0, zorder=1)
    _logarithmic(axes, found.drawn, words)
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, high * 1e-3), high * 1.6)
    axes.set_xlim(right=axes.get_xlim()[1] * 1.9)
    put(axes, labels, points)


def closing_page(found: chords.Robustness, words: Words, title: str, note: str) -> Figure:
    """Draw how diagrams by chords stand errors: a section line beside a jump, and what closing a drawing brings."""
    with page(title, note) as figure:
        if found.beside:
            _missed(box(figure, (LEFT, 34.0, 112.0, 148.0), title=words["chart.line_beside"]), found, words)
        else:
            figure.text(LEFT / paper.WIDTH, 0.5, words["chart.no_jumps"], fontsize=paper.TEXT)
        _closings(box(figure, (164.0, 34.0, 106.0, 148.0), title=words["chart.travel_error"]), found, words)
    return figure


def _missed(axes: Axes, found: chords.Robustness, words: Words) -> None:
    """Draw errors over the place of a section line beside its jump."""
    axes.set_ylabel(words["chart.sections_error"])
    axes.set_xlabel(words["chart.late"], labelpad=2.0)
    counts, names = ([*dict.fromkeys(keys)] for keys in zip(*found.missed, strict=True))
    labels, points = [], []
    for (n, name), parts in found.missed.items():
        if name == chords.MU_S:
            continue
        error = PERCENT * parts
        curve(axes, names.index(name), found.beside, error, ls=paper.LINES[counts.index(n)], markevery=5, ms=3.8)
        points += list(zip(found.beside, error.tolist(), strict=True))
        if n == counts[0]:
            labels.append(Label(*points[-1], SYMBOLS[name], must=True, size=paper.TEXT))
    axes.axhline(0.0, color=paper.BLACK, lw=0.6)
    axes.axvline(0.0, color=paper.BLACK, lw=0.6)
    axes.set(xlim=(-0.5, 0.6), ylim=(-PERCENT, PERCENT), xticks=[-0.5, -0.25, 0.0, 0.25, 0.5])
    decimals(words, axes.xaxis)
    put(axes, labels, points)
    for n, line in zip(counts, paper.LINES, strict=False):
        axes.plot([], [], ls=line, color=paper.BLACK, lw=0.9, label=f"n = {n}")
    legend(axes, "lower left", handlelength=3.0)


def _closings(axes: Axes, found: chords.Robustness, words: Words) -> None:
    """Draw for every hand a bar for each way of closing."""
    axes.grid(False, axis="x")
    for k, way in enumerate(chords.WAYS):
        face, hatch = FACES[way]
        heights = [PERCENT * closing.errors.get(way, 0.0) for closing in found.closings.values()]
        places = [i + (k - 1.5) * BAR for i in range(len(heights))]
        label = words[f"chart.closed.{way}"].rpartition(",")[0]
        axes.bar(places, heights, BAR, color=face, edgecolor=paper.BLACK, lw=0.7, hatch=hatch, label=label, zorder=2)
        for x, height in zip(places, heights, strict=True):
            if height:
                beside(axes, words.short(height, 2), (x, height), (0.0, 1.5), ha="center", fontsize=paper.SMALL - 0.5)
    axes.set(yscale="log", ylim=(0.5, 300.0))
    decimals(words, axes.yaxis)
    axes.yaxis.minorticks_off()
    axes.set_xticks(range(len(found.closings)), [words[f"hand.{hand}"] for hand in found.closings])
    axes.tick_params(axis="x", length=0.0)
    legend(axes, "upper left", handlelength=1.6)


def scales_page(found: ScaleErrors, words: Words, title: str, note: str) -> Figure:
    """Draw the errors of hands against scales, a field for each quantity, what is let pass of each in rings."""
    from ..gears.scene import lettered  # cams and hoists draw their charts without the sheets of gears

    wide, words = (WIDE - GEAR_GAP * (len(found.quantities) - 1)) / len(found.quantities), lettered(words)
    with page(title, note) as figure:
        for k, name in enumerate(found.quantities):
            place = (LEFT + k * (wide + GEAR_GAP), FOOT, wide, TALL)
            _scales(box(figure, place, xlabel=words["chart.scale_axis"]), found, name, words)
    return figure


def _scales(axes: Axes, found: ScaleErrors, name: str, words: Words) -> None:
    """Draw what every hand keeps of one quantity, what is let pass of it, and where a tooth is as high as usual."""
    axes.set_title(words["chart.by_hands"].format(name=mathtext(words.symbol(name))), fontsize=paper.TEXT, pad=3.0)
    enough = {hand: found.enough(hand, name, preset.tolerance.part) for hand, preset in PRESETS.items()}
    rings = {hand: None if ratio is None else found.ratios.index(ratio) for hand, ratio in enough.items()}
    errors = {hand: found.errors[hand, name] for hand in PRESETS}
    labels, points = _by_hands(axes, np.array(found.ratios), errors, rings, words)
    _logarithmic(axes, found.ratios, words)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * 1.3)
    axes.set_xlim(right=axes.get_xlim()[1] * 2.0)
    ratio = HIGH * MILLI / found.tooth
    if axes.get_xlim()[0] < ratio < axes.get_xlim()[1]:
        axes.axvline(ratio, color=paper.GREY, lw=0.8, ls=(0, (8, 2, 1, 2)), zorder=1)
        text, top = words["chart.scale_tooth"].format(height=words.short(HIGH)), (ratio, axes.get_ylim()[1])
        beside(axes, text, top, (-3.0, -4.0), ha="right", va="top", rotation=90)
    put(axes, [replace(label, x=1.06 * label.x) for label in labels], points)  # clear of a ring


def steps_page(found: Mapping[str, Steps], words: Words, title: str, note: str) -> Figure:
    """Draw what steps of what size do: errors over the step with their orders, and by what a period grows."""
    with page(title, note) as figure:
        axes = box(figure, (LEFT, 32.0, 126.0, 150.0), title=words["chart.hoist.errors"])
        axes.set(xlabel=words["chart.hoist.step"], ylabel=words["chart.error.course"])
        _errors(axes, found, words)
        axes = box(figure, (170.0, 32.0, 104.0, 150.0), title=words["chart.hoist.growths"])
        axes.set(xlabel=words["chart.hoist.step_any"])
        _growths(axes, found, words)
    return figure


def _errors(axes: Axes, found: Mapping[str, Steps], words: Words) -> None:
    """Draw errors over steps; crosses at the top are runs that are refused."""
    for limit in {runs.limit for runs in found.values()}:
        if 0.0 < limit < math.inf:
            axes.axvline(limit, color=paper.GREY, lw=0.8, ls=(0, (4, 2)), zorder=1)
    for k, (method, runs) in enumerate(found.items()):
        rising, name = np.argsort(runs.steps), words[f"chart.{method}"]
        z, error = runs.steps[rising], runs.errors[rising]
        of_order = words["chart.hoist.of_order"].format(method=name, order=words.number(runs.order or 0.0, 2))
        curve(axes, k, z, error, zorder=3, label=name if runs.order is None else of_order)
        refused = z[np.isnan(error)]
        if refused.size:
            height = REFUSED * ROW**k
            axes.plot(refused, np.full(refused.shape, height), "x", color=paper.BLACK, ms=3.6, mew=0.8)
            # whose runs are refused stands to the left of the first
            beside(axes, name, (float(refused.min()), height), (-5.0, 0.0), ha="right", va="center", bbox=paper.WHITE)
    axes.set(xscale="log", yscale="log", ylim=(1e-9, 3e3))
    axes.set(xlim=(axes.get_xlim()[0] * 0.9, 6.0), xticks=[0.01, 0.1, 1.0], yticks=[10.0**n for n in range(-9, 1)])
    axes.yaxis.minorticks_off()
    decimals(words, axes.xaxis)
    powers(axes.yaxis)
    legend(axes, "upper left", bbox_to_anchor=(0.0, 0.94), handlelength=4.0)  # between refused runs and all curves


def _growths(axes: Axes, found: Mapping[str, Steps], words: Words) -> None:
    """Draw by what an oscillation grows in a period, over the step."""
    z = np.linspace(0.002, FARTHEST, 2000)
    for k, method in enumerate(found):
        grown = growth(method, z) ** (2.0 * math.pi / z)
        curve(axes, k, z, grown, label=words[f"chart.{method}"], markevery=(40 * k, 200))
    for method, (dx, dy, side) in LIMITED.items():
        limit = found[method].limit
        axes.plot(limit, 1.0, "o", ms=6.0, mfc=paper.BLACK, mec=paper.BLACK, zorder=4)
        text = words["chart.hoist.limit"].format(value=words.short(limit, 4))
        beside(axes, text, (limit, 1.0), (dx, dy), ha=side, va="center", fontsize=paper.TEXT)
    axes.set(yscale="log", ylim=(1e-1, 1e3), xlim=(0.0, FARTHEST))
    decimals(words, axes.xaxis, axes.yaxis)
    legend(axes, "upper left", handlelength=4.0, borderaxespad=0.8)


def roots_page(found: Mapping[str, Ways], words: Words, title: str, note: str) -> Figure:
    """Draw the error over the evaluations of all ways, at the hoist's own root and at one that is nearly triple."""
    with page(title, note) as figure:
        for left, corner, (name, ways) in zip((LEFT, APART), ("right", "lower left"), found.items(), strict=True):
            axes = box(figure, (left, 30.0, 116.0, 152.0), xlabel=words["chart.hoist.evaluations"])
            head = words[f"chart.hoist.root.{name}"].format(x=words.short(ways.root, 5))
            axes.set(title=head, ylabel=words["chart.error.lift_off"])
            for k, (method, root) in enumerate(ways.found.items()):
                error = np.maximum(ways.errors[method][: min(root.evaluations + 1, SHOWN)], FLOOR)
                key = "chart.hoist.fails" if np.isnan(root.root) else "chart.hoist.stops"
                label = words[key].format(method=words[f"chart.{method}"], n=root.evaluations)
                curve(axes, k, np.arange(1, len(error) + 1), error, ms=3.8, label=label)
            axes.set(yscale="log", ylim=(1e-17, 1e2), xlim=(0.0, SHOWN))
            powers(axes.yaxis)
            legend(axes, corner, handlelength=4.0, frameon=True, framealpha=1.0, edgecolor="white")
    return figure
