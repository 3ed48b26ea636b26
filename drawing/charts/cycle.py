"""Curves over the cycle of a linkage: the worst intersection, the condition, the errors of drawing, special places."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...plans.boards.exact import SMALL as SMALL_SINE
from ...plans.lab.stability import CHANGE, DEAD, DIGITS, LIMIT, POLE, Spot, Stability
from ...plans.laws import TURN
from ...plans.linkages.limits import Arc
from ..words import Words
from .paper import BLACK, GREY, HEIGHT, LIGHT, SMALL, TEXT, box, curve, decimals, mathtext, page, powers

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[Any]
LEFT, WIDE = 24.0, 232.0  # mm: the fields
FOOT, HEAD, GAP = 27.0, 27.0, 9.0
CURVE: Mapping[str, Any] = {"lw": 1.0, "ms": 3.6}
FARTHEST = 1e3  # mm or per cent beyond which nothing is drawn
SHOWN_DIGITS = 6
DECADES = 1.2  # at least, of a logarithmic axis
FEWEST_DIGITS = 3  # whole numbers of digits on the right axis; where there are fewer, halves stand between
ROOM = 0.2  # of the axis, between special places that are named in full
MARKED = 12  # markers along a curve
SPOTS = {CHANGE: "chart.change", POLE: "chart.parallel", LIMIT: "chart.limit"}


@dataclass(frozen=True, slots=True)
class Abscissa:
    """The driver's place as the axis shows it: its name and unit, degrees within a turn or millimetres.

    `apart` is where the mechanism cannot be assembled.
    """

    label: str
    turns: bool
    apart: Sequence[Arc]

    def shown(self, places: Array | float) -> Array:
        """Return places as they are shown."""
        shown = np.degrees(np.asarray(places) % TURN) if self.turns else np.asarray(places) * 1e3
        return np.where(self.turns & (shown > 360.0 - 1e-9), 0.0, shown)

    def limit(self, axes: Axes, x: Array) -> None:
        """Let a field show a turn, or all travels `x`."""
        if self.turns:
            axes.set(xlim=(0.0, 360.0), xticks=range(0, 361, 30))
        else:
            axes.set_xlim(float(x.min()), float(x.max()))

    def stretches(self) -> Iterator[tuple[float, float]]:
        """Go through where the mechanism cannot be assembled, cut at the end of a turn."""
        for arc in self.apart:
            low, high = (float(self.shown(end)) for end in (arc.low, arc.high))
            if self.turns and arc.high - arc.low >= TURN:
                yield 0.0, 360.0
            elif self.turns and high < low:
                yield from ((low, 360.0), (0.0, high))
            else:
                yield low, high


def stability_page(found: Stability, words: Words, title: str, note: str, along: Abscissa) -> Figure:
    """Draw what is lost over a cycle: the worst intersection, the condition, the error of drawing."""
    missed: dict[str, list[str]] = {}
    for name, in_mm in sorted(found.in_mm.items(), key=lambda item: not item[1]):
        missed.setdefault("millimetres" if in_mm else "per_cent", []).append(name)
    x = along.shown(found.places)
    order = np.argsort(x, kind="stable")
    with page(title, note) as figure:
        tall = (HEIGHT - FOOT - HEAD - GAP * (1 + len(missed))) / (2 + len(missed))
        bottoms = (FOOT + (tall + GAP) * i for i in reversed(range(2 + len(missed))))
        fields = [box(figure, (LEFT, bottom, WIDE, tall)) for bottom in bottoms]
        for axes in fields[:-1]:
            axes.tick_params(labelbottom=False)
        _angles(fields[0], x[order], found.angles[order], words)
        numbers = {name: k for k, name in enumerate(found.conditions)}
        _curves(fields[1], x[order], {name: (k, found.conditions[name][order]) for name, k in numbers.items()}, words)
        _log(fields[1], words["chart.condition"])
        _digits(fields[1], words)
        for axes, (key, names) in zip(fields[2:], missed.items(), strict=True):
            _curves(axes, x[order], {name: (numbers[name], found.misses[name][order]) for name in names}, words)
            axes.set_ylim(top=min(axes.get_ylim()[1], FARTHEST))
            _log(axes, words[f"chart.{key}"], words)
        for axes in fields:
            along.limit(axes, x)
            _special(axes, found.spots, along)
        _named(fields[0], found.spots, along, words)
        fields[-1].set_xlabel(along.label)
    return figure


def _angles(axes: Axes, x: Array, angles: Array, words: Words) -> None:
    axes.plot(x, angles, color=BLACK, lw=1.1)
    small = math.degrees(math.asin(SMALL_SINE))
    axes.axhline(small, color=GREY, lw=0.7, ls=(0, (4, 2)))
    at: Any = {"transform": axes.get_yaxis_transform(), "fontsize": SMALL, "va": "center", "wrap": True}
    axes.text(1.005, small, words["chart.small"], **at)
    axes.set(ylim=(0.0, 92.0), yticks=range(0, 91, 30))
    axes.set_title(words["chart.angle"], fontsize=TEXT, pad=3.0)


def _curves(axes: Axes, x: Array, curves: Mapping[str, tuple[int, Array]], words: Words) -> None:
    """Draw numbered curves with a marker here and there, and the symbol of each at its right end."""
    ends, every = {}, max(len(x) // MARKED, 1)
    for i, (name, (k, values)) in enumerate(curves.items()):
        positive = np.where(values > 0.0, values, np.nan)
        curve(axes, k, x, positive, markevery=((i * every) // len(curves), every), **CURVE)
        known = positive[np.isfinite(positive)]
        if known.size:
            ends[name] = float(known[-1])
    axes.set_yscale("log")
    bottom, top = axes.get_ylim()
    if top < 10.0**DECADES * bottom:  # at least one power of ten and a bit, so that it has divisions
        middle, factor = math.sqrt(bottom * top), 10.0 ** (DECADES / 2.0)
        axes.set_ylim(middle / factor, middle * factor)
    # the symbols of curves stand to the right of the field, with their lines, none over another
    low, high = (math.log10(y) for y in axes.get_ylim())
    apart = 3.6 / (axes.get_position().height * HEIGHT)  # 3.6 mm
    wanted = sorted(((math.log10(value) - low) / (high - low), name) for name, value in ends.items())
    heights: list[float] = []
    for height, _ in wanted:
        heights.append(max(height, heights[-1] + apart) if heights else height)
    over = max(heights[-1] - 0.97, 0.0) if heights else 0.0
    for height, (_, name) in zip(heights, wanted, strict=True):
        y, right = height - over, axes.transAxes
        curve(axes, curves[name][0], [1.045, 1.075], [y, y], markevery=[0], clip_on=False, transform=right, **CURVE)
        axes.text(1.082, y, mathtext(words.symbol(name)), va="center", fontsize=TEXT, transform=right)


def _log(axes: Axes, label: str, words: Words | None = None) -> None:
    """Give an axis numbers, the more in each power of ten the shorter it is, and say above the field what it shows."""
    from matplotlib.ticker import LogLocator, NullFormatter

    low, high = axes.get_ylim()
    decades = math.log10(high / low)
    subs = (1.0, 2.0, 3.0, 5.0, 7.0) if decades < 1.5 else (1.0, 2.0, 5.0) if decades < 3.0 else (1.0,)
    axes.yaxis.set_major_locator(LogLocator(10.0, subs=subs, numticks=20))
    axes.yaxis.set_minor_formatter(NullFormatter())
    if decades < 5.0 and words is not None:
        decimals(words, axes.yaxis)
    elif decades < 5.0:
        axes.yaxis.set_major_formatter("{x:g}")
    else:
        powers(axes.yaxis)
    axes.set_title(label, fontsize=TEXT, pad=3.0)


def _digits(axes: Axes, words: Words) -> None:
    """Write at the right how many digits are left."""
    low, high = (math.log10(y) for y in axes.get_ylim())
    small: Any = {"transform": axes.transAxes, "fontsize": SMALL, "color": GREY}
    for k in _lost(low, high):
        axes.text(1.008, (k - low) / (high - low), words.short(DIGITS - k), va="center", **small)
    axes.text(1.008, 1.09, words["chart.digits"], va="bottom", **small)


def _lost(low: float, high: float) -> list[float]:
    """Return how many lost digits the axis names: whole numbers where there are enough, otherwise also halves.

    >>> _lost(-0.3, 1.2), _lost(0.1, 3.4)
    ([0.0, 0.5, 1.0], [1.0, 2.0, 3.0])
    """
    whole, halves = ([k / n for k in range(math.ceil(low * n), math.floor(high * n) + 1) if k >= 0] for n in (1, 2))
    shown = whole if len(whole) >= FEWEST_DIGITS else halves
    return shown[:: math.ceil(len(shown) / SHOWN_DIGITS) or 1]


def _special(axes: Axes, spots: Sequence[Spot], along: Abscissa) -> None:
    """Draw special places as vertical lines, and hatch what cannot be assembled."""
    for spot in spots:
        dashes = (0, (1, 2)) if spot.kind == DEAD else (0, (7, 2, 1, 2, 1, 2))
        axes.axvline(float(along.shown(spot.place)), color=BLACK, lw=0.8, ls=dashes, zorder=1)
    for low, high in along.stretches():
        axes.axvspan(low, high, facecolor="none", edgecolor=LIGHT, hatch="///", lw=0.0, zorder=0)


def _named(axes: Axes, spots: Sequence[Spot], along: Abscissa, words: Words) -> None:
    """Write above the first field what its vertical lines are."""
    texts: dict[float, list[str]] = {}
    dead: dict[float, list[int]] = {}
    for spot in spots:
        x = round(float(along.shown(spot.place)), 3)
        if spot.kind == DEAD:
            dead.setdefault(x, []).append(spot.link or 0)
        elif words[SPOTS[spot.kind]] not in texts.setdefault(x, []):
            texts[x].append(words[SPOTS[spot.kind]])
    low, high = axes.get_xlim()
    roomy = all((b - a) / (high - low) >= ROOM for a, b in pairwise(sorted({*texts, *dead})))
    for x, links in dead.items():
        key = "chart.dead" if not roomy else "chart.dead_position" if len(links) == 1 else "chart.dead_positions"
        texts.setdefault(x, []).insert(0, words[key].format(links=", ".join(map(str, links))))
    last, row = -math.inf, 0
    for x, names in sorted(texts.items()):
        row = row + 1 if (x - last) / (high - low) < 0.09 else 0
        side = "left" if x - low < 0.03 * (high - low) else "right" if high - x < 0.03 * (high - low) else "center"
        above: Any = {"transform": axes.get_xaxis_transform(), "fontsize": SMALL, "va": "bottom"}
        axes.text(x, 1.16 + 0.1 * (row % 3), "; ".join(names), ha=side, **above)
        last = x
