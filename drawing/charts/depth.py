"""How deep a model must be: what simplifications of linkages and hoists change; a hoist's force over its places."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.forces import Choice, Trial
from ...plans.lab.ropes import MANY, Changes, HoistDepth
from ...plans.lab.stability import Cost, Depth
from ...plans.quantities import unit_of
from ...scales.units import format_unit
from ..words import Words
from . import paper
from .paper import Label, beside, box, curve, decimals, legend, mathtext, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Row = tuple[str, float | None, float | None]  # what is written, the change that is filled and the one that is hollow
MARGIN, COLUMN, APART = 60.0, 104.0, 15.0  # mm: the rows
BELOW, ABOVE, ROW = 46.0, 34.0, 9.0
FOOT = 52.0  # mm: the fields of a hoist
LEAST, MOST = 1e-3, 1e3  # per cent
SHOWN = 3  # digits
KILO, PERCENT = 1e3, 100.0
ERRORS = (("at_drum", "at_drum"), ("at_load", "at_load"), ("of_t_1", "t_1"))  # keys of texts, and names


def _rows(axes: Axes, rows: Mapping[str, Row], tolerance: float, by: tuple[float, float], words: Words) -> None:
    """Draw a row for each simplification, on a logarithmic scale of per cents, with the tolerance.

    What is written stands by so many points from the end of its row.
    """
    axes.set(xscale="log", xlim=(LEAST, MOST), ylim=(len(rows) - 0.4, -0.6))
    axes.grid(False, axis="y")
    axes.axvline(tolerance, **paper.LIMIT)
    text = words["chart.tolerance"].format(value=words.short(tolerance))
    line = {"arrowstyle": "-", "lw": 0.5, "shrinkB": 0.0}
    below: Any = {"xycoords": axes.get_xaxis_transform(), "ha": "center", "va": "top", "arrowprops": line}
    beside(axes, text, (tolerance, 0.0), (0.0, -17.0), **below)
    for y, (text, filled, hollow) in enumerate(rows.values()):
        if filled is None:
            continue
        x, *others = (min(max(value, LEAST), MOST) for value in (filled, hollow) if value is not None)
        marker: Any = {"mec": paper.BLACK, "ms": 4.6, "zorder": 3, "clip_on": False}
        axes.plot([LEAST, x], [y, y], color=paper.GREY, lw=2.4, solid_capstyle="butt", zorder=2, clip_on=False)
        axes.plot(others, [y] * len(others), "o", mfc="white", mew=0.8, **marker)
        axes.plot(x, y, "D", mfc=paper.BLACK, **marker)
        beside(axes, text, (x, y), by, ha="left" if by[0] else "center", va="center", bbox=paper.WHITE | {"pad": 0.4})
    axes.set_yticks(range(len(rows)), rows, fontsize=paper.TEXT)
    decimals(words, axes.xaxis)
    axes.minorticks_off()


def depth_page(found: Depth, words: Words, title: str, note: str) -> Figure:
    """Draw what each simplification of a linkage changes: the largest change filled, the root mean square hollow."""
    tall = min(paper.HEIGHT - BELOW - ABOVE, ROW * (len(found.costs) + 1))
    height, names = BELOW + tall + ABOVE, [_simplified(cost, words) for cost in found.costs]
    changes = [[(cost.balance, cost.balance_rms) for cost in found.costs]]
    heads = [_change_of("chart.change_of", found.balance, found.largest_balance, words)]
    if found.reaction:
        changes.append([(cost.reaction or 0.0, cost.reaction_rms or 0.0) for cost in found.costs])
        heads.append(_change_of("chart.change_of_reactions", found.reaction, found.largest_reaction or 0.0, words))
    with page(title, note, height) as figure:
        for i, (head, pairs) in enumerate(zip(heads, changes, strict=True)):
            place = (MARGIN + i * (COLUMN + APART), BELOW, COLUMN * (3 - len(heads)), tall)
            axes = box(figure, place, height)
            axes.set_title(head, fontsize=paper.TEXT)
            rows = {name: (_short(most, words), most, rms) for name, (most, rms) in zip(names, pairs, strict=True)}
            _rows(axes, rows, found.tolerance, (7.0, 0.0), words)
            axes.tick_params(labelleft=not i)
        below, verdict = (BELOW - 16.0) / height, depth_verdict(found, words)
        figure.text(MARGIN / paper.WIDTH, below, verdict, fontsize=paper.TEXT + 0.5, va="top", linespacing=1.5)
    return figure


def _change_of(key: str, name: str, value: float, words: Words) -> str:
    """Return of what a field shows the changes, and how large that is."""
    size = words.short(float(f"{words.display.value(value, unit_of(name)):.4g}"))
    unit = words.unit(words.display.unit(unit_of(name)))
    return words[key].format(name=mathtext(words.symbol(name)), value=size, unit=unit)


def _simplified(cost: Cost, words: Words) -> str:
    if cost.parts == (cost.key,):
        return words["chart.without"].format(part=mathtext(words.symbol(cost.key)))
    return words[f"chart.without.{cost.key}"]


def depth_verdict(found: Depth, words: Words, plain: bool = False) -> str:
    """Return which parts a tolerance asks for, and which may go; `plain` names them as the data do."""

    def names(parts: Sequence[str]) -> str:
        return ", ".join(part if plain else mathtext(words.symbol(part)) for part in parts) or words["chart.nothing"]

    needed = words["chart.needed"].format(tolerance=words.short(found.tolerance), parts=names(found.needed))
    spare = words["chart.spare"].format(parts=names(found.spare), cost=_short(found.together.worst, words))
    return f"{needed}\n{spare}"


def _short(value: float, words: Words) -> str:
    return _equal(value, words) if value >= LEAST else "0" if value < 1e-12 else f"< {words.short(LEAST)}"


def _equal(value: float, words: Words) -> str:
    """Return a number with all its significant digits, zeros at the end too: 2.60."""
    power = math.floor(math.log10(abs(float(f"{value:.{SHOWN - 1}e}")))) if value else 0
    return words.number(value, max(SHOWN - 1 - power, 0))


def hoist_page(found: HoistDepth, words: Words, title: str, note: str) -> Figure:
    """Draw what simplifications of a hoist change, and one mass beside a rope of many."""
    with page(title, note) as figure:
        axes = box(figure, (58.0, FOOT, 84.0, 128.0))
        force = f"{words.short(found.full['F_max'] / KILO, 4)} {format_unit('kN', words.language)}"
        time = f"{words.short(found.full['t_1'], 4)} {format_unit('s', words.language)}"
        head = words["chart.hoist.change"].format(force=force, time=time).replace("F_max", "$F_{max}$")
        axes.set_title(head, fontsize=paper.TEXT, linespacing=1.4)
        rows = {words[f"chart.hoist.without.{key}"]: _changed(of, words) for key, of in found.simpler.items()}
        _rows(axes, rows, PERCENT * found.tolerance, (0.0, 9.0), words)
        if found.one_mass:
            _ropes(box(figure, (172.0, FOOT, 104.0, 128.0), xlabel=words["chart.hoist.ratio"]), found, words)
        look: Any = {"fontsize": paper.TEXT + 0.5, "va": "top", "linespacing": 1.5}
        figure.text(24.0 / paper.WIDTH, (FOOT - 18.0) / paper.HEIGHT, "\n".join(hoist_verdict(found, words)), **look)
    return figure


def _changed(changes: Changes, words: Words) -> Row:
    """Return the change of the greatest force, filled, and of the lift-off."""
    force, time = (None if part is None else PERCENT * part for part in (changes["F_max"], changes["t_1"]))
    if force is None:
        return "", None, None
    text = f"{'+' if force > 0.0 else '−'}{words.short(abs(force), 3)}"
    return text, abs(force), None if time is None else abs(time)


def hoist_verdict(found: HoistDepth, words: Words) -> list[str]:
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


def _ropes(axes: Axes, found: HoistDepth, words: Words) -> None:
    """Draw errors of one mass over the weight of the rope."""
    axes.set_title(words["chart.hoist.one_mass"].format(n=MANY).replace("F_max", "$F_{max}$"), fontsize=paper.TEXT)
    ratios = [mass.ratio for mass in found.one_mass]
    for k, (key, error) in enumerate(ERRORS):
        shown = [max(PERCENT * abs(getattr(mass, error)), LEAST) for mass in found.one_mass]
        curve(axes, k, ratios, shown, label=words[f"chart.hoist.{key}"])
    axes.axhline(PERCENT * found.tolerance, **paper.LIMIT)
    if found.ratio > 0.0:
        axes.axvline(found.ratio, color=paper.GREY, lw=1.6, zorder=1, label=words["chart.hoist.this_rope"])
    axes.set(xscale="log", yscale="log")
    decimals(words, axes.xaxis, axes.yaxis)
    legend(axes, "upper left", handlelength=3.5, frameon=True, framealpha=1.0, edgecolor="white")


LEFT, MAP_FOOT = 24.0, 46.0  # mm
MEGA = 1e6
BETA_0 = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)  # of the curves, where the grid has them
LINE = 3.0  # pixels on either side of a line that stay free


def choice_page(found: Choice, words: Words, title: str, note: str, S: float) -> Figure:
    """Draw the greatest force over beta_0 and beta_2, what is permitted, the way of the loop; S is the rope's, m^2."""
    with page(title, note) as figure:
        _map(box(figure, (LEFT, MAP_FOOT, 112.0, 132.0)), found, words)
        _curves(box(figure, (164.0, MAP_FOOT, 92.0, 132.0)), found, S, words)
        text = _lettered("\n".join(choice_verdict(found, words)))
        figure.text(
            LEFT / paper.WIDTH, (MAP_FOOT - 17.0) / paper.HEIGHT, text, fontsize=paper.TEXT, va="top", linespacing=1.5
        )
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
        axes.contourf(x, y, force, levels=[min(limit, low - 1.0), high + 1.0], colors=[paper.LIGHT])
    if low < limit < high:
        axes.contourf(x, y, force, levels=[low - 1.0, limit], colors=["1.0"])
        axes.contour(x, y, force, levels=[limit], colors=paper.BLACK, linewidths=2.0)
    lines = axes.contour(x, y, force, levels=10, colors=paper.BLACK, linewidths=0.7)
    for text in axes.clabel(lines, fontsize=paper.SMALL, fmt=lambda value: words.short(value, 5)):
        text.set_bbox(paper.WHITE | {"pad": 0.5})
    odd = np.argwhere(~grid.formulas)
    axes.plot(x[odd[:, 1]], y[odd[:, 0]], ".", color=paper.BLACK, ms=2.5)
    _places(axes, found, words)
    decimals(words, axes.xaxis, axes.yaxis)


def _places(axes: Axes, found: Choice, words: Words) -> None:
    """Mark the given places, the best ones, and where the loop ends."""
    marked = [("given", found.given, "o", "white"), ("best", found.best, "*", paper.BLACK)]
    if found.found and len(found.trials) > 1:
        end = found.trials[-1]
        marked.append(("loop_end", end, "s", paper.GREY))
        axes.plot(
            [found.given.beta_2, end.beta_2], [found.given.beta_0, end.beta_0], color=paper.BLACK, lw=1.2, zorder=4
        )
    for key, trial, marker, face in marked:
        size = 11.0 if marker == "*" else 7.0
        look: Any = {"mfc": face, "mec": paper.BLACK, "mew": 1.0, "ms": size, "clip_on": False}
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
        axes.plot(grid.beta_2, force, ls=paper.LINES[-1 - k], color=paper.BLACK, lw=1.0)
        points += list(zip(grid.beta_2.tolist(), force.tolist(), strict=True))
        labels.append(Label(0.5, float(force[-1]), f"β₀ = {words.short(float(grid.beta_0[row]), 3)}", must=True))
    low, high = axes.get_ylim()
    if low - 0.3 * (high - low) < limit < high + 0.3 * (high - low):
        axes.axhline(limit, color=paper.GREY, lw=2.0, zorder=1, label=words["chart.hoist.permitted"])
        axes.set_ylim(min(low, limit - 0.05 * (high - low)), max(high, limit + 0.05 * (high - low)))
        legend(axes, "upper left", bbox_to_anchor=(0.0, -0.075), borderaxespad=0.0)
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
