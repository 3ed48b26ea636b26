"""Where load and drum stand: the greatest force over beta_0 and beta_2, what is permitted, the way of the loop."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.choice import Choice, Trial
from ..words import Words
from .lettering import Label, put
from .paper import BLACK, GREY, LIGHT, SMALL, TEXT, box, decimals, page

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT, TALL, WIDTH = 24.0, 46.0, 132.0, 112.0  # mm
APART, RIGHT = 164.0, 92.0
KILO, MEGA, PERCENT = 1e3, 1e6, 100.0
CURVES = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)  # beta_0 of the curves, where the grid has them
LINES: tuple[Any, ...] = ((0, (1, 1.2)), (0, (3, 1, 1, 1)), (0, (6, 1.5, 1, 1.5)), (0, (5, 2)), (0, (10, 3)), "-")
LINE = 3.0  # pixels on either side of a line that stay free


def choice_page(found: Choice, S: float, words: Words, title: str) -> Figure:
    """Draw the spectrum.

    Parameters
    ----------
    S : float
        Area of the rope, m^2.
    """

    def draw(figure: Figure) -> None:
        _map(box(figure, LEFT, FOOT, WIDTH, TALL), found, words)
        _curves(box(figure, APART, FOOT, RIGHT, TALL), found, S, words)
        text = "\n".join(said(found, words)).replace("F_max", "$F_{max}$")
        figure.text(24.0 / 297.0, (FOOT - 17.0) / 210.0, text, fontsize=TEXT, va="top", linespacing=1.5)

    return page(title, "", draw)


def said(found: Choice, words: Words) -> list[str]:
    """Return what the loop and the search for the best places have found."""

    def shown(trial: Trial) -> dict[str, str]:
        places = {name: words.short(getattr(trial, name), 3) for name in ("beta_0", "beta_2")}
        return places | {"force": words.short(trial.F_max / KILO, 5), "safety": words.short(trial.safety, 4)}

    lines = [words["chart.hoist.loop_said"].format(**shown(found.given), K=words.short(found.K))]
    if len(found.trials) == 1:
        lines.append(words["chart.hoist.loop_at_once"])
    elif found.found:
        lines.append(words["chart.hoist.loop_found"].format(**shown(found.trials[-1]), n=len(found.trials) - 1))
    else:
        lines.append(words["chart.hoist.loop_lost"])
    part = words.short(PERCENT * float(found.spectrum.permitted.mean()), 3)
    lines.append(words["chart.hoist.best_said"].format(**shown(found.best), part=part))
    return lines if found.spectrum.formulas.all() else [*lines, words["chart.hoist.one_sided"]]


def _map(axes: Axes, found: Choice, words: Words) -> None:
    """Draw lines of equal force, and hatch the places that are not safe."""
    axes.set_title(words["chart.hoist.grid"].replace("F_max", "$F_{max}$"), loc="left", fontsize=TEXT + 0.5, pad=9.0)
    grid = found.spectrum
    x, y, force = grid.beta_2, grid.beta_0, grid.F_max / KILO
    limit = float(grid.F_max.flat[0] * grid.safety.flat[0] / found.K / KILO)  # the force that is permitted
    low, high = float(force.min()), float(force.max())
    if limit < high:
        axes.contourf(x, y, force, levels=[min(limit, low - 1.0), high + 1.0], colors=[LIGHT])
    if low < limit < high:
        axes.contourf(x, y, force, levels=[low - 1.0, limit], colors=["1.0"])
        axes.contour(x, y, force, levels=[limit], colors=BLACK, linewidths=2.0)
    lines = axes.contour(x, y, force, levels=10, colors=BLACK, linewidths=0.7)
    box_ = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
    for text in axes.clabel(lines, fontsize=SMALL, fmt=lambda value: words.short(value, 5)):
        text.set_bbox(box_)
    odd = np.argwhere(~grid.formulas)
    axes.plot(x[odd[:, 1]], y[odd[:, 0]], ".", color=BLACK, ms=2.5)
    _places(axes, found, words)
    axes.set_xlabel(words["chart.hoist.beta_2"], labelpad=1.0)
    axes.set_ylabel(words["chart.hoist.beta_0"], labelpad=1.0)
    decimals(axes.xaxis, words)
    decimals(axes.yaxis, words)


def _places(axes: Axes, found: Choice, words: Words) -> None:
    """Mark the given places, the best ones, and where the loop ends."""
    marked = [("given", found.given, "o", "white"), ("best", found.best, "*", BLACK)]
    if found.found and len(found.trials) > 1:
        end = found.trials[-1]
        marked.append(("loop_end", end, "s", GREY))
        axes.plot([found.given.beta_2, end.beta_2], [found.given.beta_0, end.beta_0], color=BLACK, lw=1.2, zorder=4)
    for key, trial, marker, face in marked:
        size = 11.0 if marker == "*" else 7.0
        axes.plot(
            trial.beta_2,
            trial.beta_0,
            marker,
            ms=size,
            mfc=face,
            mec=BLACK,
            mew=1.0,
            ls="none",
            zorder=5,
            clip_on=False,
            label=words[f"chart.hoist.{key}"],
        )
    axes.legend(
        loc="upper left", bbox_to_anchor=(0.0, -0.075), ncols=3, frameon=False, fontsize=SMALL + 0.5, borderaxespad=0.0
    )


def _curves(axes: Axes, found: Choice, S: float, words: Words) -> None:
    """Draw the force over the place of the drum, for some places of the load; stresses stand on the right."""
    axes.set_title(
        words["chart.hoist.spectrum"].replace("F_max", "$F_{max}$"), loc="left", fontsize=TEXT + 0.5, pad=9.0
    )
    grid = found.spectrum
    labels, points = [], []
    rows = [int(np.abs(grid.beta_0 - beta).argmin()) for beta in CURVES]
    for row, line in zip(dict.fromkeys(rows), LINES, strict=False):
        force = grid.F_max[row] / KILO
        axes.plot(grid.beta_2, force, ls=line, color=BLACK, lw=1.0)
        points += list(zip(grid.beta_2.tolist(), force.tolist(), strict=True))
        labels.append(Label(0.5, float(force[-1]), f"β₀ = {words.short(float(grid.beta_0[row]), 3)}", must=True))
    limit = float(grid.F_max.flat[0] * grid.safety.flat[0] / found.K / KILO)
    low, high = axes.get_ylim()
    if low - 0.3 * (high - low) < limit < high + 0.3 * (high - low):
        axes.axhline(limit, color=GREY, lw=2.0, zorder=1)
        axes.set_ylim(min(low, limit - 0.05 * (high - low)), max(high, limit + 0.05 * (high - low)))
        labels.append(Label(0.61, limit, words["chart.hoist.permitted"], (-1, 1), must=True))
    axes.set_xlim(float(grid.beta_2[0]), 0.62)
    axes.set_xticks([0.1, 0.2, 0.3, 0.4, 0.5])
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.set_xlabel(words["chart.hoist.beta_2"], labelpad=1.0)
    axes.set_ylabel(words["chart.hoist.force_axis"].replace("F_max", "$F_{max}$"), labelpad=1.0)
    decimals(axes.xaxis, words)
    decimals(axes.yaxis, words)
    _stresses(axes, S, words)
    box_of = axes.get_window_extent()
    at = float(axes.transData.transform((0.0, limit))[1])
    put(axes, labels, points, [(box_of.x0, at - LINE, box_of.x1, at + LINE)])


def _stresses(axes: Axes, S: float, words: Words) -> None:
    """Put the stresses that go with the forces on the right side."""
    per_force = KILO / S / MEGA
    right = axes.secondary_yaxis(
        "right", functions=(lambda f: np.asarray(f) * per_force, lambda s: np.asarray(s) * (1.0 / per_force))
    )
    right.set_ylabel(words["chart.hoist.stress_axis"].replace("σ_max", "$σ_{max}$"), labelpad=2.0)
    decimals(right.yaxis, words)
