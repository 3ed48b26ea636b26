"""Error against the scale of the drawing: what hands keep of what is measured on the meshing of gears."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.gears.scale_errors import DRAWINGS, MILLI, ScaleErrors
from ..words import Words
from .paper import GREY, HANDS, SMALL, TEXT, box, curves_of_hands, logarithmic, mathtext, page, put

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
    title = words["chart.by_hands"].format(name=mathtext(words.symbol(name)))
    axes.set_title(title, fontsize=TEXT, pad=3.0)
    axes.set_xlabel(words["chart.scale_axis"])
    errors = {hand: 100.0 * found.errors[hand, name] for hand in HANDS}
    enough = {hand: found.enough(hand, name, tolerances[hand]) for hand in HANDS}
    ringed = {
        hand: None if ratio is None else (ratio, errors[hand][found.ratios.index(ratio)])
        for hand, ratio in enough.items()
    }
    labels, points = curves_of_hands(axes, np.array(found.ratios), errors, ringed, words)
    labels = [replace(label, x=BESIDE * label.x) for label in labels]
    logarithmic(axes, found.ratios, words)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * 1.3)
    axes.set_xlim(right=axes.get_xlim()[1] * 2.0)
    _customary(axes, HIGH * MILLI / found.tooth, words)
    put(axes, labels, points)


def _customary(axes: Axes, ratio: float, words: Words) -> None:
    """Mark from which scale on a tooth is as high as is customary."""
    if axes.get_xlim()[0] < ratio < axes.get_xlim()[1]:
        axes.axvline(ratio, color=GREY, lw=0.8, ls=(0, (8, 2, 1, 2)), zorder=1)
        text, top = words["chart.scale_tooth"].format(height=words.short(HIGH)), (ratio, axes.get_ylim()[1])
        place: Any = {"xytext": (-3.0, -4.0), "textcoords": "offset points", "ha": "right", "va": "top"}
        axes.annotate(text, top, rotation=90, fontsize=SMALL, **place)
