"""Error against the scale of the drawing: what hands keep of what is measured on the meshing of gears."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ...plans.gears.scale_errors import DRAWINGS, MILLI, ScaleErrors
from ..words import Words
from .lettering import Label, put
from .paper import BLACK, GREY, SMALL, TEXT, box, mathtext, page
from .sections import HANDS, logarithmic

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT, WIDE, TALL = 24.0, 30.0, 258.0, 152.0  # mm: all fields together
GAP = 16.0
BESIDE = 1.06  # of the last scale: clear of a ring
HIGH = 50.0  # mm, that a drawn tooth should be high


def scales_page(found: ScaleErrors, words: Words, title: str, tolerances: Mapping[str, float]) -> Figure:
    """Draw the errors of hands against scales, a field for each quantity; `tolerances` are parts, by hand."""

    def draw(figure: Figure) -> None:
        count = len(found.quantities)
        wide = (WIDE - GAP * (count - 1)) / count
        for k, name in enumerate(found.quantities):
            axes = box(figure, LEFT + k * (wide + GAP), FOOT, wide, TALL)
            _field(axes, found, name, words, tolerances)

    return page(title, words["chart.scale_note"].format(n=DRAWINGS), draw)


def _field(axes: Axes, found: ScaleErrors, name: str, words: Words, tolerances: Mapping[str, float]) -> None:
    """Draw what every hand keeps of one quantity, and what is let pass of it."""
    axes.set_title(
        words["chart.by_hands"].format(name=mathtext(words.symbol(name))), loc="left", fontsize=TEXT, pad=3.0
    )
    ratios = np.array(found.ratios)
    labels, points = [], []
    for hand, (line, marker) in HANDS.items():
        error = 100.0 * found.errors[hand, name]
        axes.plot(ratios, error, ls=line, marker=marker, color=BLACK, ms=3.6, mfc="white", mew=0.8, lw=0.9, zorder=3)
        enough = found.enough(hand, name, tolerances[hand])
        if enough is not None:
            axes.plot(enough, error[found.ratios.index(enough)], "o", ms=9.0, mfc="none", mec=BLACK, mew=0.8, zorder=4)
        points += list(zip(ratios.tolist(), error.tolist(), strict=True))
        labels.append(Label(BESIDE * float(ratios[-1]), float(error[-1]), words[f"hand.{hand}"], must=True))
    logarithmic(axes, found.ratios, words)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * 1.3)
    axes.set_xlim(right=axes.get_xlim()[1] * 2.0)
    axes.set_xlabel(words["chart.scale_axis"], labelpad=1.0)
    _customary(axes, HIGH * MILLI / found.tooth, words)
    put(axes, labels, points)


def _customary(axes: Axes, ratio: float, words: Words) -> None:
    """Mark from which scale on a tooth is as high as is customary."""
    if axes.get_xlim()[0] < ratio < axes.get_xlim()[1]:
        axes.axvline(ratio, color=GREY, lw=0.8, ls=(0, (8, 2, 1, 2)), zorder=1)
        axes.annotate(
            words["chart.scale_tooth"].format(height=words.short(HIGH)),
            (ratio, axes.get_ylim()[1]),
            (-3.0, -4.0),
            textcoords="offset points",
            ha="right",
            va="top",
            rotation=90,
            fontsize=SMALL,
        )
