"""Depth of the model: what each simplification changes, one row each, on a logarithmic scale of per cents."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...plans.linkages.accuracy.depth import Cost, Depth
from ...plans.quantities import unit_of
from ...scales.units import format_unit
from ..words import Words
from .paper import BLACK, GREY, SMALL, TEXT, box, decimals, mathtext, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, WIDTH, GAP = 60.0, 104.0, 15.0  # mm
FOOT, HEAD, ROW = 46.0, 34.0, 9.0
TALLEST = 210.0
LEAST, MOST = 1e-3, 1e3  # per cent
SHOWN = 3  # digits


def depth_page(found: Depth, words: Words, title: str) -> Figure:
    """Draw what simplifications cost."""

    tall = min(TALLEST - FOOT - HEAD, ROW * (len(found.costs) + 1))
    height = FOOT + tall + HEAD

    def draw(figure: Figure) -> None:
        fields = 2 if found.reaction else 1
        shown = [box(figure, LEFT + i * (WIDTH + GAP), FOOT, WIDTH * (3 - fields), tall, height) for i in range(fields)]
        for axes, head in zip(shown, _heads(found, words), strict=False):
            axes.set_title(head, fontsize=TEXT, loc="left", pad=5.0)
        _rows(shown[0], found.costs, [(c.balance, c.balance_rms) for c in found.costs], found.tolerance, words)
        if found.reaction:
            pairs = [(c.reaction or 0.0, c.reaction_rms or 0.0) for c in found.costs]
            _rows(shown[1], found.costs, pairs, found.tolerance, words)
            shown[1].tick_params(labelleft=False)
        shown[0].set_yticks(range(len(found.costs)), [named(cost, words) for cost in found.costs], fontsize=TEXT)
        figure.text(
            LEFT / 297.0, (FOOT - 16.0) / height, verdict(found, words), fontsize=TEXT + 0.5, va="top", linespacing=1.5
        )

    return page(title, words["chart.whole"], draw, height)


def _heads(found: Depth, words: Words) -> Sequence[str]:
    """Return what the two fields show."""

    def of(key: str, name: str, value: float) -> str:
        unit = words.display.unit(unit_of(name))
        size = words.short(float(f"{words.display.value(value, unit_of(name)):.4g}"))
        symbol = mathtext(words.symbol(name))
        return words[key].format(name=symbol, value=size, unit=format_unit(unit, words.language, raised=True))

    heads = [of("chart.change_of", found.balance, found.largest_balance)]
    if found.reaction:
        heads.append(of("chart.change_of_reactions", found.reaction, found.largest_reaction or 0.0))
    return heads


def named(cost: Cost, words: Words) -> str:
    """Return the words of a row."""
    if cost.parts == (cost.key,):
        return words["chart.without"].format(part=mathtext(words.symbol(cost.key)))
    return words[f"chart.without.{cost.key}"]


def verdict(found: Depth, words: Words, plain: bool = False) -> str:
    """Return which parts a tolerance asks for, and which may go; `plain` names them as the data do."""

    def names(parts: Sequence[str]) -> str:
        shown = (part if plain else mathtext(words.symbol(part)) for part in parts)
        return ", ".join(shown) or words["chart.nothing"]

    tolerance = words.short(found.tolerance)
    lines = [words["chart.needed"].format(tolerance=tolerance, parts=names(found.needed))]
    cost = _short(found.together.worst, words)
    lines.append(words["chart.spare"].format(parts=names(found.spare), cost=cost))
    return "\n".join(lines)


def _rows(
    axes: Axes, costs: Sequence[Cost], pairs: Sequence[tuple[float, float]], tolerance: float, words: Words
) -> None:
    """Draw a row for each simplification: the largest change filled, the root of the mean square hollow."""
    axes.set_xscale("log")
    axes.set_xlim(LEAST, MOST)
    axes.set_ylim(len(costs) - 0.4, -0.6)
    axes.grid(True, axis="x")
    axes.set_axisbelow(True)
    axes.axvline(tolerance, color=BLACK, lw=0.9, ls=(0, (6, 2)))
    axes.annotate(
        words["chart.tolerance"].format(value=words.short(tolerance)),
        (tolerance, 0.0),
        (0.0, -17.0),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=SMALL,
        arrowprops={"arrowstyle": "-", "lw": 0.5, "shrinkB": 0.0},
    )
    for row, (most, mean) in enumerate(pairs):
        _row(axes, row, most, mean, words)
    decimals(axes.xaxis, words)
    axes.minorticks_off()


def _row(axes: Axes, row: int, most: float, mean: float, words: Words) -> None:
    at, half = (min(max(value, LEAST), MOST) for value in (most, mean))
    axes.plot([LEAST, at], [row, row], color=GREY, lw=2.4, solid_capstyle="butt", zorder=2, clip_on=False)
    axes.plot(half, row, "o", mfc="white", mec=BLACK, ms=4.6, mew=0.8, zorder=3, clip_on=False)
    axes.plot(at, row, "D", mfc=BLACK, mec=BLACK, ms=4.6, zorder=3, clip_on=False)
    axes.annotate(
        _short(most, words),
        (at, row),
        (7.0, 0.0),
        textcoords="offset points",
        va="center",
        fontsize=SMALL,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4},
    )


def _short(value: float, words: Words) -> str:
    return equal(value, words) if value >= LEAST else "0" if value < 1e-12 else f"< {words.short(LEAST)}"


def equal(value: float, words: Words) -> str:
    """Return a number with all its significant digits, zeros at the end too: 2.60."""
    power = math.floor(math.log10(abs(float(f"{value:.{SHOWN - 1}e}")))) if value else 0
    return words.number(value, max(SHOWN - 1 - power, 0))
