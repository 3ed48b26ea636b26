"""Labels of a chart: each beside its point, where it touches no other label and no point."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .paper import SMALL

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Box = tuple[float, float, float, float]
POINT = 4.0  # pixels around a point that stay free
REACHES = (7.0, 11.0, 16.0, 23.0, 31.0)  # pixels from a point to its label
LONG = 16.0  # from here on a thin line leads to the label
DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


@dataclass(frozen=True, slots=True)
class Label:
    """A text beside a point; `prefer` is the side where it would stand best, `must` says that it cannot be left out."""

    x: float
    y: float
    text: str
    prefer: tuple[float, float] = (1, 0)
    must: bool = False
    size: float = SMALL


def put(axes: Axes, labels: Iterable[Label], points: Sequence[tuple[float, float]], taken: Iterable[Box] = ()) -> None:
    """Put labels beside their points, those that must stand first; what finds no room is left out.

    Parameters
    ----------
    points : sequence of (x, y)
        All points that stay free, in the data's coordinates.
    taken : iterable of box
        Other boxes that do, x0, y0, x1, y1 in pixels.
    """
    renderer: Any = axes.figure.canvas.get_renderer()  # type: ignore[attr-defined]
    frame = axes.get_window_extent(renderer)
    spots = axes.transData.transform(np.asarray(points)) if points else np.zeros((0, 2))
    busy: list[Box] = [(x - POINT, y - POINT, x + POINT, y + POINT) for x, y in spots.tolist()]
    busy += list(taken)
    for label in sorted(labels, key=lambda label: not label.must):
        x, y = axes.transData.transform((label.x, label.y))
        text = axes.text(0.0, 0.0, label.text, fontsize=label.size, transform=None, ha="center", va="center", zorder=5)
        extent = text.get_window_extent(renderer)
        found = _free(x, y, extent.width, extent.height, label.prefer, busy, (frame.x0, frame.y0, frame.x1, frame.y1))
        if found is None:
            if not label.must:
                text.remove()
                continue
            found = (x, y + 2.0 * POINT, 0.0)
        at_x, at_y, reach = found
        text.remove()
        _write(axes, label, (x, y), (at_x, at_y), reach)
        half_w, half_h = extent.width / 2.0, extent.height / 2.0
        busy.append((at_x - half_w, at_y - half_h, at_x + half_w, at_y + half_h))


def _free(
    x: float, y: float, width: float, height: float, prefer: tuple[float, float], busy: list[Box], frame: Box
) -> tuple[float, float, float] | None:
    """Return the middle of the nearest free box for a text, and how far it is from its point; None without any."""
    size = math.hypot(*prefer) or 1.0
    ranked = sorted(DIRECTIONS, key=lambda d: -(d[0] * prefer[0] + d[1] * prefer[1]) / (math.hypot(*d) * size))
    for reach in REACHES:
        for dx, dy in ranked:
            at_x, at_y = x + dx * (reach + width / 2.0), y + dy * (reach + height / 2.0)
            if dx and dy:
                at_x, at_y = x + dx * (0.7 * reach + width / 2.0), y + dy * (0.7 * reach + height / 2.0)
            own = at_x - width / 2.0, at_y - height / 2.0, at_x + width / 2.0, at_y + height / 2.0
            inside = own[0] > frame[0] and own[1] > frame[1] and own[2] < frame[2] and own[3] < frame[3]
            if inside and not any(_touch(own, other) for other in busy):
                return at_x, at_y, reach
    return None


def _touch(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _write(axes: Axes, label: Label, at: tuple[float, float], middle: tuple[float, float], reach: float) -> None:
    """Write a label, in points from its own point so that it stays there on every output."""
    per_pixel = 72.0 / axes.figure.dpi
    away = (middle[0] - at[0]) * per_pixel, (middle[1] - at[1]) * per_pixel
    arrow = {"arrowstyle": "-", "linewidth": 0.3, "color": "0.4", "shrinkA": 0.0, "shrinkB": 2.0}
    axes.annotate(
        label.text,
        (label.x, label.y),
        away,
        textcoords="offset points",
        fontsize=label.size,
        ha="center",
        va="center",
        zorder=5,
        arrowprops=arrow if reach >= LONG else None,
    )
