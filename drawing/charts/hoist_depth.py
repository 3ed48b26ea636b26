"""Depth of the model of a hoist: what simplifications change, and one mass beside a rope of many."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ...plans.hoist.depth import MANY, HoistDepth, Simplification
from ...scales.units import format_unit
from ..words import Words
from .paper import BLACK, GREY, SMALL, TEXT, box, decimals, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, WIDTH, FOOT, TALL = 58.0, 84.0, 52.0, 128.0  # mm
APART, RIGHT = 172.0, 104.0
LEAST, MOST = 1e-3, 1e3  # per cent
PERCENT, KILO = 100.0, 1e3
WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}


def hoist_depth_page(found: HoistDepth, words: Words, title: str) -> Figure:
    """Draw how deep the model must be."""

    def draw(figure: Figure) -> None:
        _rows(box(figure, LEFT, FOOT, WIDTH, TALL), found, words)
        if found.one_mass:
            _ropes(box(figure, APART, FOOT, RIGHT, TALL), found, words)
        said = "\n".join(verdict(found, words))
        figure.text(24.0 / 297.0, (FOOT - 18.0) / 210.0, said, fontsize=TEXT + 0.5, va="top", linespacing=1.5)

    return page(title, words["chart.hoist.depth_note"], draw)


def verdict(found: HoistDepth, words: Words) -> list[str]:
    """Return what may go, and up to which weight of the rope one mass is enough."""
    tolerance = words.short(PERCENT * found.tolerance)
    parts = ", ".join(words[f"chart.hoist.without.{key}"] for key in found.spare) or words["chart.nothing"]
    lines = [words["chart.hoist.may_go"].format(tolerance=tolerance, parts=parts)]
    here = found.here
    if here is None:
        return [*lines, words["chart.hoist.no_ropes"]]
    key = "enough" if math.isfinite(found.enough_to) else "enough_always"
    shown = {"here": words.short(found.ratio, 3), "error": words.short(PERCENT * here.worst, 3)}
    shown |= {"tolerance": tolerance, "ratio": words.short(found.enough_to, 3)}
    return [*lines, words[f"chart.hoist.{key}"].format(**shown)]


def _rows(axes: Axes, found: HoistDepth, words: Words) -> None:
    """Draw a row for each simplification: filled the greatest force, hollow the lift-off."""
    force = f"{words.short(found.full['F_max'] / KILO, 4)} {format_unit('kN', words.language)}"
    time = f"{words.short(found.full['t_1'], 4)} {format_unit('s', words.language)}"
    head = words["chart.hoist.change"].format(force=force, time=time).replace("F_max", "$F_{max}$")
    axes.set_title(head, loc="left", fontsize=TEXT, pad=5.0, linespacing=1.4)
    axes.set_xscale("log")
    axes.set_xlim(LEAST, MOST)
    axes.set_ylim(len(found.simpler) - 0.4, -0.6)
    axes.grid(True, axis="x")
    axes.set_axisbelow(True)
    axes.axvline(PERCENT * found.tolerance, color=BLACK, lw=0.9, ls=(0, (6, 2)))
    for row, one in enumerate(found.simpler):
        _row(axes, row, one, words)
    names = [words[f"chart.hoist.without.{one.key}"] for one in found.simpler]
    axes.set_yticks(range(len(names)), names, fontsize=TEXT)
    decimals(axes.xaxis, words)
    axes.minorticks_off()


def _row(axes: Axes, row: int, one: Simplification, words: Words) -> None:
    force, time = (_per_cent(one.changes[name]) for name in ("F_max", "t_1"))
    if force is None:
        return
    at = min(max(abs(force), LEAST), MOST)
    axes.plot([LEAST, at], [row, row], color=GREY, lw=2.4, solid_capstyle="butt", zorder=2)
    if time is not None:
        axes.plot(min(max(abs(time), LEAST), MOST), row, "o", mfc="white", mec=BLACK, ms=5.0, mew=0.8, zorder=3)
    axes.plot(at, row, "D", mfc=BLACK, mec=BLACK, ms=4.6, zorder=3)
    sign = "+" if force > 0.0 else "−"
    axes.annotate(
        f"{sign}{words.short(abs(force), 3)}",
        (at, row),
        (0.0, 7.0),
        textcoords="offset points",
        ha="center",
        fontsize=SMALL,
        bbox=WHITE,
    )


def _per_cent(change: float | None) -> float | None:
    return None if change is None else PERCENT * change


def _ropes(axes: Axes, found: HoistDepth, words: Words) -> None:
    """Draw errors of one mass over the weight of the rope."""
    head = words["chart.hoist.one_mass"].format(n=MANY).replace("F_max", "$F_{max}$")
    axes.set_title(head, loc="left", fontsize=TEXT, pad=5.0)
    ratios = [one.ratio for one in found.one_mass]
    curves = (
        ("at_drum", "-", "o", [one.at_drum for one in found.one_mass]),
        ("at_load", (0, (6, 2)), "s", [one.at_load for one in found.one_mass]),
        ("of_t_1", (0, (1, 1.2)), "D", [one.t_1 for one in found.one_mass]),
    )
    for key, line, marker, errors in curves:
        shown = [max(PERCENT * abs(error), LEAST) for error in errors]
        look: Any = {"marker": marker, "ms": 4.0, "mfc": "white", "mew": 0.8, "lw": 0.9}
        axes.plot(ratios, shown, ls=line, color=BLACK, label=words[f"chart.hoist.{key}"], **look)
    axes.axhline(PERCENT * found.tolerance, color=BLACK, lw=0.9, ls=(0, (6, 2)))
    if found.ratio > 0.0:
        axes.axvline(found.ratio, color=GREY, lw=1.6, zorder=1, label=words["chart.hoist.this_rope"])
    axes.set_xscale("log")
    axes.set_yscale("log")
    decimals(axes.xaxis, words)
    decimals(axes.yaxis, words)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.hoist.ratio"], labelpad=1.0)
    axes.legend(loc="upper left", fontsize=SMALL + 0.5, handlelength=3.5, framealpha=1.0, edgecolor="white")
