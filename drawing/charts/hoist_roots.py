"""Ways to the lift-off: the error over the evaluations, at the hoist's own root and at one that is nearly triple."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.finders import BISECTION, BRENT, ILLINOIS, NEWTON, SECANT
from ...plans.hoist.root_race import RootRace, Ways
from ..words import Words
from .paper import BLACK, SMALL, TEXT, box, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT, TALL, WIDTH, APART = 24.0, 30.0, 152.0, 116.0, 158.0  # mm
LOOKS: Mapping[str, tuple[Any, str]] = {
    BISECTION: ((0, (1, 1.2)), "s"),
    NEWTON: ((0, (5, 2)), "^"),
    SECANT: ((0, (3, 1, 1, 1)), "D"),
    ILLINOIS: ("-", "o"),
    BRENT: ((0, (10, 3)), "v"),
}
HIGHEST = 1e2
SHOWN = 50  # evaluations
FLOOR = 3e-17
LEGEND: Any = {"fontsize": SMALL + 0.5, "handlelength": 4.0, "framealpha": 1.0, "edgecolor": "white"}


def roots_page(found: RootRace, words: Words, title: str) -> Figure:
    """Draw all ways to both roots."""

    def draw(figure: Figure) -> None:
        _field(box(figure, LEFT, FOOT, WIDTH, TALL), found.own, words, "chart.hoist.own_root", "right")
        _field(box(figure, APART, FOOT, WIDTH, TALL), found.triple, words, "chart.hoist.triple_root", "lower left")

    return page(title, words["chart.hoist.roots_note"], draw)


def _field(axes: Axes, ways: Ways, words: Words, key: str, corner: str) -> None:
    axes.set_title(words[key].format(x=words.short(ways.root, 5)), loc="left", fontsize=TEXT + 0.5, pad=5.0)
    for method, (line, marker) in LOOKS.items():
        found = ways.found[method]
        error = np.maximum(ways.errors[method][: min(found.evaluations + 1, SHOWN)], FLOOR)
        said = "chart.hoist.fails" if np.isnan(found.root) else "chart.hoist.stops"
        label = words[said].format(method=words[f"chart.{method}"], n=found.evaluations)
        look: Any = {"marker": marker, "ms": 3.8, "mfc": "white", "mew": 0.8, "lw": 0.9, "clip_on": True}
        axes.plot(np.arange(1, len(error) + 1), error, ls=line, color=BLACK, label=label, **look)
    axes.set_yscale("log")
    axes.set_ylim(1e-17, HIGHEST)
    axes.set_xlim(0.0, SHOWN)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.hoist.evaluations"], labelpad=1.0)
    axes.set_ylabel(words["chart.error.lift_off"], labelpad=1.0)
    axes.legend(**{"loc": corner, **LEGEND})
