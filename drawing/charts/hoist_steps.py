"""Steps of integrators of a hoist: errors over the step with their orders, and by what a period grows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.step_limits import StepLimits
from ...plans.hoist.steppers import EXPLICIT, RK4, SYMPLECTIC, TRAPEZOID, VERLET, growth
from ..words import Words
from .paper import BLACK, GREY, SMALL, TEXT, box, decimals, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT, TALL, WIDTH = 24.0, 32.0, 150.0, 126.0  # mm
APART, RIGHT = 170.0, 104.0
LOOKS: Mapping[str, tuple[Any, str]] = {  # lines and markers
    RK4: ("-", "o"),
    VERLET: ((0, (6, 2)), "s"),
    TRAPEZOID: ((0, (6, 1.5, 1, 1.5)), "^"),
    SYMPLECTIC: ((0, (1, 1.2)), "D"),
    EXPLICIT: ((0, (10, 3)), "v"),
}
LOWEST, HIGHEST = 1e-9, 3e3
REFUSED, ROW = 6.0, 3.6  # where refused runs stand on the axis of errors, and how far apart those of two methods
LIMITED = {VERLET: (-6.0, 9.0, "right"), RK4: (8.0, -10.0, "left")}  # limits, and where their labels stand
LEGEND: Any = {"frameon": False, "fontsize": SMALL + 0.5, "handlelength": 4.0, "borderaxespad": 0.8}
FARTHEST, MOST = 4.0, 1e3  # of the right field: k h, growth in a period


def steps_page(found: StepLimits, words: Words, title: str, note: str) -> Figure:
    """Draw what steps of what size do."""

    def draw(figure: Figure) -> None:
        _errors(box(figure, LEFT, FOOT, WIDTH, TALL), found, words)
        _growths(box(figure, APART, FOOT, RIGHT, TALL), found, words)

    return page(title, note, draw)


def _errors(axes: Axes, found: StepLimits, words: Words) -> None:
    """Draw errors over steps; crosses at the top are runs that are refused."""
    axes.set_title(words["chart.hoist.errors"], loc="left", fontsize=TEXT + 0.5, pad=5.0)
    _limits(axes, found)
    for row, (method, (line, marker)) in enumerate(LOOKS.items()):
        order = np.argsort(found.steps[method])
        z, error = found.steps[method][order], found.errors[method][order]
        power = found.order(method)
        said = words[f"chart.{method}"]
        if power is not None:
            said = words["chart.hoist.of_order"].format(method=said, order=words.number(power, 2))
        look: Any = {"marker": marker, "ms": 4.0, "mfc": "white", "mew": 0.8, "lw": 0.9}
        axes.plot(z, error, ls=line, color=BLACK, zorder=3, label=said, **look)
        refused = z[np.isnan(error)]
        if refused.size:
            height = REFUSED * ROW**row
            axes.plot(refused, np.full(refused.shape, height), "x", color=BLACK, ms=3.6, mew=0.8)
            _beside(axes, float(refused.min()), height, words[f"chart.{method}"])
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(LOWEST, HIGHEST)
    axes.set_xlim(axes.get_xlim()[0] * 0.9, 6.0)
    axes.set_xticks([0.01, 0.1, 1.0])
    axes.set_yticks([10.0**n for n in range(-9, 1)])
    axes.yaxis.minorticks_off()
    decimals(axes.xaxis, words)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.hoist.step"], labelpad=1.0)
    axes.set_ylabel(words["chart.error.course"], labelpad=1.0)
    axes.legend(loc="lower right", **LEGEND)


def _beside(axes: Axes, x: float, y: float, text: str) -> None:
    """Write whose runs are refused to the left of the first of them."""
    axes.annotate(
        text,
        (x, y),
        (-5.0, 0.0),
        textcoords="offset points",
        ha="right",
        va="center",
        fontsize=SMALL,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
    )


def _limits(axes: Axes, found: StepLimits) -> None:
    for limit in {found.limit(method) for method in LOOKS}:
        if 0.0 < limit < math.inf:
            axes.axvline(limit, color=GREY, lw=0.8, ls=(0, (4, 2)), zorder=1)


def _growths(axes: Axes, found: StepLimits, words: Words) -> None:
    """Draw by what an oscillation grows in a period, over the step."""
    axes.set_title(words["chart.hoist.growths"], loc="left", fontsize=TEXT + 0.5, pad=5.0)
    z = np.linspace(0.002, FARTHEST, 2000)
    for i, (method, (line, marker)) in enumerate(LOOKS.items()):
        grown = growth(method, z) ** (2.0 * math.pi / z)
        look: Any = {"marker": marker, "markevery": (40 * i, 200), "ms": 4.0, "mfc": "white", "mew": 0.8, "lw": 0.9}
        axes.plot(z, grown, ls=line, color=BLACK, label=words[f"chart.{method}"], **look)
    for method, (dx, dy, side) in LIMITED.items():
        limit = found.limit(method)
        axes.plot(limit, 1.0, "o", ms=6.0, mfc=BLACK, mec=BLACK, zorder=4)
        text = words["chart.hoist.limit"].format(value=words.short(limit, 4))
        axes.annotate(text, (limit, 1.0), (dx, dy), textcoords="offset points", ha=side, va="center", fontsize=TEXT)
    axes.set_yscale("log")
    axes.set_ylim(1e-1, MOST)
    axes.set_xlim(0.0, FARTHEST)
    decimals(axes.xaxis, words)
    decimals(axes.yaxis, words)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.hoist.step_any"], labelpad=1.0)
    axes.legend(loc="upper left", **LEGEND)
