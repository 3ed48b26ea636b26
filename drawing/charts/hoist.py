"""Charts of hoists: steps of integrators, ways to the lift-off, depth of the model, where load and drum may stand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plans.hoist.forces import Choice, Trial
from ...plans.lab.finders import BISECTION, BRENT, ILLINOIS, NEWTON, SECANT
from ...plans.lab.hoists import RootRace, StepLimits, Ways
from ...plans.lab.integrators import EXPLICIT, RK4, SYMPLECTIC, TRAPEZOID, VERLET, growth
from ...plans.lab.ropes import MANY, Changes, HoistDepth
from ...scales.units import format_unit
from ..words import Words
from .paper import BLACK, GREY, HEIGHT, LIGHT, LIMIT, LOOK, SMALL, TEXT, WIDTH, Label, box, decimals, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT = 24.0  # mm
KILO, MEGA, PERCENT = 1e3, 1e6, 100.0
WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}  # under a number
LEGEND: Any = {"fontsize": SMALL + 0.5}
ON_WHITE: Any = {**LEGEND, "framealpha": 1.0, "edgecolor": "white"}
OFFSET: Any = {"textcoords": "offset points", "va": "center"}

INTEGRATORS: Mapping[str, tuple[Any, str]] = {  # lines and markers
    RK4: ("-", "o"),
    VERLET: ((0, (6, 2)), "s"),
    TRAPEZOID: ((0, (6, 1.5, 1, 1.5)), "^"),
    SYMPLECTIC: ((0, (1, 1.2)), "D"),
    EXPLICIT: ((0, (10, 3)), "v"),
}
REFUSED, ROW = 6.0, 3.6  # where refused runs stand on the axis of errors, and how far apart those of two methods
LIMITED = {VERLET: (-6.0, 9.0, "right"), RK4: (8.0, -10.0, "left")}  # limits, and where their labels stand
FARTHEST = 4.0  # k h of the right field

FINDERS: Mapping[str, tuple[Any, str]] = {
    BISECTION: ((0, (1, 1.2)), "s"),
    NEWTON: ((0, (5, 2)), "^"),
    SECANT: ((0, (3, 1, 1, 1)), "D"),
    ILLINOIS: ("-", "o"),
    BRENT: ((0, (10, 3)), "v"),
}
SHOWN = 50  # evaluations
FLOOR = 3e-17

LEAST, MOST = 1e-3, 1e3  # per cent
ERRORS: Mapping[tuple[str, str], tuple[Any, str]] = {  # lines and markers by the key and the name of an error
    ("at_drum", "at_drum"): ("-", "o"),
    ("at_load", "at_load"): ((0, (6, 2)), "s"),
    ("of_t_1", "t_1"): ((0, (1, 1.2)), "D"),
}

BETA_0 = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)  # of the curves, where the grid has them
LINES: tuple[Any, ...] = ((0, (1, 1.2)), (0, (3, 1, 1, 1)), (0, (6, 1.5, 1, 1.5)), (0, (5, 2)), (0, (10, 3)), "-")
LINE = 3.0  # pixels on either side of a line that stay free


def steps_page(found: StepLimits, words: Words, title: str, note: str) -> Figure:
    """Draw what steps of what size do: errors over the step with their orders, and by what a period grows."""
    with page(title, note) as figure:
        _errors(box(figure, LEFT, 32.0, 126.0, 150.0), found, words)
        _growths(box(figure, 170.0, 32.0, 104.0, 150.0), found, words)
    return figure


def _errors(axes: Axes, found: StepLimits, words: Words) -> None:
    """Draw errors over steps; crosses at the top are runs that are refused."""
    said = {"title": "chart.hoist.errors", "xlabel": "chart.hoist.step", "ylabel": "chart.error.course"}
    axes.set(**{name: words[key] for name, key in said.items()})
    for limit in {found.limit(method) for method in INTEGRATORS}:
        if 0.0 < limit < math.inf:
            axes.axvline(limit, color=GREY, lw=0.8, ls=(0, (4, 2)), zorder=1)
    for row, (method, (line, marker)) in enumerate(INTEGRATORS.items()):
        order = np.argsort(found.steps[method])
        z, error = found.steps[method][order], found.errors[method][order]
        power = found.order(method)
        name = label = words[f"chart.{method}"]
        if power is not None:
            label = words["chart.hoist.of_order"].format(method=name, order=words.number(power, 2))
        axes.plot(z, error, ls=line, marker=marker, ms=4.0, zorder=3, label=label, **LOOK)
        refused = z[np.isnan(error)]
        if refused.size:
            height = REFUSED * ROW**row
            axes.plot(refused, np.full(refused.shape, height), "x", color=BLACK, ms=3.6, mew=0.8)
            first = float(refused.min()), height  # whose runs are refused stands to the left of it
            axes.annotate(name, first, (-5.0, 0.0), ha="right", fontsize=SMALL, bbox=WHITE, **OFFSET)
    axes.set(xscale="log", yscale="log", ylim=(1e-9, 3e3))
    axes.set(xlim=(axes.get_xlim()[0] * 0.9, 6.0), xticks=[0.01, 0.1, 1.0], yticks=[10.0**n for n in range(-9, 1)])
    axes.yaxis.minorticks_off()
    decimals(words, axes.xaxis)
    axes.legend(loc="lower right", frameon=False, handlelength=4.0, borderaxespad=0.8, **LEGEND)


def _growths(axes: Axes, found: StepLimits, words: Words) -> None:
    """Draw by what an oscillation grows in a period, over the step."""
    axes.set(title=words["chart.hoist.growths"], xlabel=words["chart.hoist.step_any"])
    z = np.linspace(0.002, FARTHEST, 2000)
    for i, (method, (line, marker)) in enumerate(INTEGRATORS.items()):
        grown = growth(method, z) ** (2.0 * math.pi / z)
        every, label = (40 * i, 200), words[f"chart.{method}"]
        axes.plot(z, grown, label=label, ls=line, marker=marker, markevery=every, ms=4.0, **LOOK)
    for method, (dx, dy, side) in LIMITED.items():
        limit = found.limit(method)
        axes.plot(limit, 1.0, "o", ms=6.0, mfc=BLACK, mec=BLACK, zorder=4)
        text = words["chart.hoist.limit"].format(value=words.short(limit, 4))
        axes.annotate(text, (limit, 1.0), (dx, dy), ha=side, fontsize=TEXT, **OFFSET)
    axes.set(yscale="log", ylim=(1e-1, 1e3), xlim=(0.0, FARTHEST))
    decimals(words, axes.xaxis, axes.yaxis)
    axes.legend(loc="upper left", frameon=False, handlelength=4.0, borderaxespad=0.8, **LEGEND)


def roots_page(found: RootRace, words: Words, title: str, note: str) -> Figure:
    """Draw the error over the evaluations of all ways, at the hoist's own root and at one that is nearly triple."""
    with page(title, note) as figure:
        _ways(box(figure, LEFT, 30.0, 116.0, 152.0), found.own, words, "chart.hoist.own_root", "right")
        _ways(box(figure, 158.0, 30.0, 116.0, 152.0), found.triple, words, "chart.hoist.triple_root", "lower left")
    return figure


def _ways(axes: Axes, ways: Ways, words: Words, key: str, corner: Any) -> None:
    axes.set_title(words[key].format(x=words.short(ways.root, 5)))
    axes.set(xlabel=words["chart.hoist.evaluations"], ylabel=words["chart.error.lift_off"])
    for method, (line, marker) in FINDERS.items():
        found = ways.found[method]
        error = np.maximum(ways.errors[method][: min(found.evaluations + 1, SHOWN)], FLOOR)
        said = "chart.hoist.fails" if np.isnan(found.root) else "chart.hoist.stops"
        label = words[said].format(method=words[f"chart.{method}"], n=found.evaluations)
        axes.plot(np.arange(1, len(error) + 1), error, ls=line, marker=marker, ms=3.8, label=label, **LOOK)
    axes.set(yscale="log", ylim=(1e-17, 1e2), xlim=(0.0, SHOWN))
    axes.legend(loc=corner, handlelength=4.0, **ON_WHITE)


def depth_page(found: HoistDepth, words: Words, title: str, note: str) -> Figure:
    """Draw how deep the model must be: what simplifications change, and one mass beside a rope of many."""
    with page(title, note) as figure:
        _simplified(box(figure, 58.0, 52.0, 84.0, 128.0), found, words)
        if found.one_mass:
            _ropes(box(figure, 172.0, 52.0, 104.0, 128.0), found, words)
        _below(figure, 52.0 - 18.0, "\n".join(depth_verdict(found, words)), TEXT + 0.5)
    return figure


def _below(figure: Figure, y: float, text: str, size: float) -> None:
    """Write what a chart says below its fields, from `y` mm down."""
    figure.text(LEFT / WIDTH, y / HEIGHT, text, fontsize=size, va="top", linespacing=1.5)


def depth_verdict(found: HoistDepth, words: Words) -> list[str]:
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


def _simplified(axes: Axes, found: HoistDepth, words: Words) -> None:
    """Draw a row for each simplification: filled the greatest force, hollow the lift-off."""
    force = f"{words.short(found.full['F_max'] / KILO, 4)} {format_unit('kN', words.language)}"
    time = f"{words.short(found.full['t_1'], 4)} {format_unit('s', words.language)}"
    head = words["chart.hoist.change"].format(force=force, time=time).replace("F_max", "$F_{max}$")
    axes.set_title(head, fontsize=TEXT, linespacing=1.4)
    axes.grid(False, axis="y")
    axes.set(xscale="log", xlim=(LEAST, MOST), ylim=(len(found.simpler) - 0.4, -0.6))
    axes.axvline(PERCENT * found.tolerance, **LIMIT)
    for row, changes in enumerate(found.simpler.values()):
        _row(axes, row, changes, words)
    names = [words[f"chart.hoist.without.{key}"] for key in found.simpler]
    axes.set_yticks(range(len(names)), names, fontsize=TEXT)
    decimals(words, axes.xaxis)
    axes.minorticks_off()


def _row(axes: Axes, row: int, changes: Changes, words: Words) -> None:
    force, time = changes["F_max"], changes["t_1"]
    if force is None:
        return
    at = min(max(PERCENT * abs(force), LEAST), MOST)
    axes.plot([LEAST, at], [row, row], color=GREY, lw=2.4, solid_capstyle="butt", zorder=2)
    if time is not None:
        hollow: Any = {"mfc": "white", "mec": BLACK, "ms": 5.0, "mew": 0.8}
        axes.plot(min(max(PERCENT * abs(time), LEAST), MOST), row, "o", zorder=3, **hollow)
    axes.plot(at, row, "D", mfc=BLACK, mec=BLACK, ms=4.6, zorder=3)
    text = f"{'+' if force > 0.0 else '−'}{words.short(PERCENT * abs(force), 3)}"
    axes.annotate(text, (at, row), (0.0, 7.0), textcoords="offset points", ha="center", fontsize=SMALL, bbox=WHITE)


def _ropes(axes: Axes, found: HoistDepth, words: Words) -> None:
    """Draw errors of one mass over the weight of the rope."""
    head = words["chart.hoist.one_mass"].format(n=MANY).replace("F_max", "$F_{max}$")
    axes.set_title(head, fontsize=TEXT)
    axes.set_xlabel(words["chart.hoist.ratio"])
    ratios = [one.ratio for one in found.one_mass]
    for (key, error), (line, marker) in ERRORS.items():
        shown = [max(PERCENT * abs(getattr(one, error)), LEAST) for one in found.one_mass]
        axes.plot(ratios, shown, label=words[f"chart.hoist.{key}"], ls=line, marker=marker, ms=4.0, **LOOK)
    axes.axhline(PERCENT * found.tolerance, **LIMIT)
    if found.ratio > 0.0:
        axes.axvline(found.ratio, color=GREY, lw=1.6, zorder=1, label=words["chart.hoist.this_rope"])
    axes.set(xscale="log", yscale="log")
    decimals(words, axes.xaxis, axes.yaxis)
    axes.legend(loc="upper left", handlelength=3.5, **ON_WHITE)


def choice_page(found: Choice, words: Words, title: str, note: str, S: float) -> Figure:
    """Draw the greatest force over beta_0 and beta_2, what is permitted, the way of the loop; S is the rope's, m^2."""
    with page(title, note) as figure:
        _map(box(figure, LEFT, 46.0, 112.0, 132.0), found, words)
        _curves(box(figure, 164.0, 46.0, 92.0, 132.0), found, S, words)
        _below(figure, 46.0 - 17.0, "\n".join(choice_said(found, words)).replace("F_max", "$F_{max}$"), TEXT)
    return figure


def choice_said(found: Choice, words: Words) -> list[str]:
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
    axes.set_title(words["chart.hoist.grid"].replace("F_max", "$F_{max}$"), pad=9.0)
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
    look: Any = {"mec": BLACK, "mew": 1.0, "ls": "none", "zorder": 5, "clip_on": False}
    for key, trial, marker, face in marked:
        look |= {"marker": marker, "mfc": face, "ms": 11.0 if marker == "*" else 7.0}
        axes.plot(trial.beta_2, trial.beta_0, label=words[f"chart.hoist.{key}"], **look)
    below = (0.0, -0.075)
    axes.legend(loc="upper left", bbox_to_anchor=below, ncols=3, frameon=False, borderaxespad=0.0, **LEGEND)


def _curves(axes: Axes, found: Choice, S: float, words: Words) -> None:
    """Draw the force over the place of the drum, for some places of the load; stresses stand on the right."""
    axes.set_title(words["chart.hoist.spectrum"].replace("F_max", "$F_{max}$"), pad=9.0)
    axes.set(xlabel=words["chart.hoist.beta_2"])
    axes.set(ylabel=words["chart.hoist.force_axis"].replace("F_max", "$F_{max}$"))
    grid, limit = found.spectrum, _permitted(found)
    labels, points = [], []
    rows = [int(np.abs(grid.beta_0 - beta).argmin()) for beta in BETA_0]
    for row, line in zip(dict.fromkeys(rows), LINES, strict=False):
        force = grid.F_max[row] / KILO
        axes.plot(grid.beta_2, force, ls=line, color=BLACK, lw=1.0)
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
    right.set_ylabel(words["chart.hoist.stress_axis"].replace("σ_max", "$σ_{max}$"), labelpad=2.0)
    decimals(words, axes.xaxis, axes.yaxis, right.yaxis)
    frame = axes.get_window_extent()
    at = float(axes.transData.transform((0.0, limit))[1])
    put(axes, labels, points, [(frame.x0, at - LINE, frame.x1, at + LINE)])
