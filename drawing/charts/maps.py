"""A map of a hoist: the greatest force over the places of load and drum, what is permitted, the way of the loop."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.forces import Choice, Trial
from ..words import Words
from .paper import BLACK, GREY, HEIGHT, LIGHT, LINES, SMALL, TEXT, WHITE, WIDTH, Label, box, decimals, legend, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT, FOOT = 24.0, 46.0  # mm
KILO, MEGA, PERCENT = 1e3, 1e6, 100.0
BETA_0 = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)  # of the curves, where the grid has them
LINE = 3.0  # pixels on either side of a line that stay free


def choice_page(found: Choice, words: Words, title: str, note: str, S: float) -> Figure:
    """Draw the greatest force over beta_0 and beta_2, what is permitted, the way of the loop; S is the rope's, m^2."""
    with page(title, note) as figure:
        _map(box(figure, (LEFT, FOOT, 112.0, 132.0)), found, words)
        _curves(box(figure, (164.0, FOOT, 92.0, 132.0)), found, S, words)
        text = _lettered("\n".join(choice_verdict(found, words)))
        figure.text(LEFT / WIDTH, (FOOT - 17.0) / HEIGHT, text, fontsize=TEXT, va="top", linespacing=1.5)
    return figure


def _lettered(text: str) -> str:
    return text.replace("F_max", "$F_{max}$").replace("σ_max", "$σ_{max}$")


def choice_verdict(found: Choice, words: Words) -> list[str]:
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


def _permitted(found: Choice) -> float:
    """Return the force that is permitted, kN."""
    grid = found.spectrum
    return float(grid.F_max.flat[0] * grid.safety.flat[0] / found.K / KILO)


def _map(axes: Axes, found: Choice, words: Words) -> None:
    """Draw lines of equal force, and hatch the places that are not safe."""
    axes.set_title(_lettered(words["chart.hoist.grid"]), pad=9.0)
    axes.set(xlabel=words["chart.hoist.beta_2"], ylabel=words["chart.hoist.beta_0"])
    axes.grid(False)
    axes.set_axisbelow("line")
    grid, limit = found.spectrum, _permitted(found)
    x, y, force = grid.beta_2, grid.beta_0, grid.F_max / KILO
    low, high = float(force.min()), float(force.max())
    if limit < high:
        axes.contourf(x, y, force, levels=[min(limit, low - 1.0), high + 1.0], colors=[LIGHT])
    if low < limit < high:
        axes.contourf(x, y, force, levels=[low - 1.0, limit], colors=["1.0"])
        axes.contour(x, y, force, levels=[limit], colors=BLACK, linewidths=2.0)
    lines = axes.contour(x, y, force, levels=10, colors=BLACK, linewidths=0.7)
    for text in axes.clabel(lines, fontsize=SMALL, fmt=lambda value: words.short(value, 5)):
        text.set_bbox(WHITE | {"pad": 0.5})
    odd = np.argwhere(~grid.formulas)
    axes.plot(x[odd[:, 1]], y[odd[:, 0]], ".", color=BLACK, ms=2.5)
    _places(axes, found, words)
    decimals(words, axes.xaxis, axes.yaxis)


def _places(axes: Axes, found: Choice, words: Words) -> None:
    """Mark the given places, the best ones, and where the loop ends."""
    marked = [("given", found.given, "o", "white"), ("best", found.best, "*", BLACK)]
    if found.found and len(found.trials) > 1:
        end = found.trials[-1]
        marked.append(("loop_end", end, "s", GREY))
        axes.plot([found.given.beta_2, end.beta_2], [found.given.beta_0, end.beta_0], color=BLACK, lw=1.2, zorder=4)
    for key, trial, marker, face in marked:
        look: Any = {"mfc": face, "mec": BLACK, "mew": 1.0, "ms": 11.0 if marker == "*" else 7.0, "clip_on": False}
        axes.plot(trial.beta_2, trial.beta_0, marker, zorder=5, label=words[f"chart.hoist.{key}"], **look)
    legend(axes, "upper left", bbox_to_anchor=(0.0, -0.075), ncols=3, borderaxespad=0.0)


def _curves(axes: Axes, found: Choice, S: float, words: Words) -> None:
    """Draw the force over the place of the drum, for some places of the load; stresses stand on the right."""
    axes.set_title(_lettered(words["chart.hoist.spectrum"]), pad=9.0)
    axes.set(xlabel=words["chart.hoist.beta_2"], ylabel=_lettered(words["chart.hoist.force_axis"]))
    grid, limit = found.spectrum, _permitted(found)
    labels, points = [], []
    rows = [int(np.abs(grid.beta_0 - beta).argmin()) for beta in BETA_0]
    for k, row in enumerate(dict.fromkeys(rows)):
        force = grid.F_max[row] / KILO
        axes.plot(grid.beta_2, force, ls=LINES[-1 - k], color=BLACK, lw=1.0)
        points += list(zip(grid.beta_2.tolist(), force.tolist(), strict=True))
        labels.append(Label(0.5, float(force[-1]), f"β₀ = {words.short(float(grid.beta_0[row]), 3)}", must=True))
    low, high = axes.get_ylim()
    if low - 0.3 * (high - low) < limit < high + 0.3 * (high - low):
        axes.axhline(limit, color=GREY, lw=2.0, zorder=1)
        axes.set_ylim(min(low, limit - 0.05 * (high - low)), max(high, limit + 0.05 * (high - low)))
        labels.append(Label(0.61, limit, words["chart.hoist.permitted"], (-1, 1), must=True))
    axes.set(xlim=(float(grid.beta_2[0]), 0.62), xticks=[0.1, 0.2, 0.3, 0.4, 0.5])
    per_force = KILO / S / MEGA
    stresses = lambda force: np.asarray(force) * per_force, lambda stress: np.asarray(stress) * (1.0 / per_force)
    right = axes.secondary_yaxis("right", functions=stresses)
    right.grid(False)
    right.set_ylabel(_lettered(words["chart.hoist.stress_axis"]), labelpad=2.0)
    decimals(words, axes.xaxis, axes.yaxis, right.yaxis)
    frame = axes.get_window_extent()
    at = float(axes.transData.transform((0.0, limit))[1])
    put(axes, labels, points, [(frame.x0, at - LINE, frame.x1, at + LINE)])
