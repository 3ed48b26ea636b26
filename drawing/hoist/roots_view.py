"""The equations (11) and (12) solved by drawing: curves that cross, and the times read at their crossings."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...plans.hoist.construction import Roots
from ...plans.hoist.root_plans import EXTREMES, LIFT_OFF
from ...plans.laws import LAWS
from ..diagram import Axis, Field, curve, divisions
from ..figure import Figure, stages
from ..shapes import Line, Pen
from ..view import Canvas, View
from .axes import ruled
from .magnified import magnified
from .scene import COARSE, POINTS, HoistScene

MANY, BESIDE_CROSSING = 48, 4  # section lines
BELOW = 1.08  # times the least ordinate, the foot of the diagram
FEW = 4  # crossings with their times beside them, and times in a line
CROSSING = "crossing"  # the stage in which times are read
BESIDE = 24.0  # mm from a diagram to what is magnified of it


def _roots(scene: HoistScene) -> Roots:
    roots = scene.solved.layout.roots
    assert roots is not None
    return roots


def _times(scene: HoistScene) -> Any:
    roots = _roots(scene)
    return np.linspace(0.0, roots.sections * roots.section, POINTS)


def _field(scene: HoistScene, letter: str, symbol: str, ends: tuple[float, float]) -> Field:
    """Return the axes of a diagram; times count from where it begins."""
    words, roots, time, scale = scene.words, _roots(scene), scene.scale("mu_t1"), scene.scale(symbol)
    end = roots.sections * roots.section
    across = {
        t - roots.begin: words.short(round(t, 9))
        for t in divisions(roots.begin + end, roots.begin, time.mu, 16.0)
        if t >= roots.begin
    }
    up = {y: words.short(round(y, 9)) for y in divisions(max(ends[1], 0.0), min(ends[0], 0.0), scale.mu, 12.0)}
    x = Axis(f"t, {words.unit('s')}", time, 0.0, end, across)
    return Field(0j, x, Axis(letter, scale, min(ends[0], 0.0), max(ends[1], 0.0), up))


def lift_off_view(scene: HoistScene) -> View:
    """Draw the crossing of parabola and sinusoid."""
    canvas, words, found, roots = (
        LIFT_OFF_FIGURE.canvas(scene, COARSE),
        scene.words,
        scene.solved.forces.found,
        _roots(scene),
    )
    t = _times(scene)
    V, a, k = found["V_t"], found["a"], found["k"]
    with np.errstate(invalid="ignore"):
        wave = np.asarray(LAWS["oscillation"](V, a, k, roots.begin + t)) + 0.0 * t
    parabola = np.asarray(LAWS["wound"](V, a, roots.begin + t)) - found["P_st"] / found["C"]
    low, high = float(min(parabola.min(), wave.min())), float(max(parabola.max(), wave.max()))
    field = _field(scene, f"y, {words.unit('m')}", "mu_y", (low, high))
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("curves")
    for name, ordinates in (("parabola", parabola), ("sinusoid", wave)):
        curve(canvas, field, zip(t.tolist(), ordinates.tolist(), strict=True), name)
    canvas.part("points")
    for letter in "YO":
        canvas.add(*(_node(scene, LIFT_OFF, f"{letter}{i}") for i in _shown(roots, (roots.lift_off,))))
    canvas.part("curves")
    at = POINTS // 4
    canvas.label(
        "y − mg/C", field.at(float(t[at]), float(parabola[at])), prefer=-1j, clear=1.5, height=scene.style.text
    )
    canvas.label("osc", field.at(float(t[at]), float(wave[at])), prefer=1j, clear=1.5, height=scene.style.text)
    canvas.part(CROSSING)
    _crossing(canvas, scene, LIFT_OFF, "X", "t_1_drawn")
    magnified(canvas, scene, complex(field.at(field.x.high, 0.0).real + BESIDE, field.at(0.0, field.y.low).imag))
    heading = (words["heading.hoist_lift_off"], scene.factors("mu_y", "mu_t1"))
    return canvas.finish("lift_off", heading, (scene.stated("t_1", unit="s"),))


def extremes_view(scene: HoistScene) -> View:
    """Draw the crossings of sinusoid and straight line."""
    canvas, words, found, roots = (
        EXTREMES_FIGURE.canvas(scene, COARSE),
        scene.words,
        scene.solved.forces.found,
        _roots(scene),
    )
    t = _times(scene)
    V, a, k = found["V_t"], found["a"], found["k"]
    wave = np.asarray(LAWS["oscillation_rate"](V, a, k, roots.begin + t))
    ends = [scene.mm(f"{EXTREMES}.L{i}") for i in range(2)]
    mu = scene.scale("mu_v").mu
    levels = [end.imag * mu for end in ends]
    field = _field(scene, words.unit("m/s"), "mu_v", (BELOW * min(*levels, float(wave.min())), float(wave.max())))
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("curves")
    curve(canvas, field, zip(t.tolist(), wave.tolist(), strict=True), "sinusoid")
    canvas.add(Line(ends[0], ends[1], Pen.MAIN, role="curve", name="line"))
    canvas.add(*(_node(scene, EXTREMES, f"W{i}") for i in _shown(roots, roots.extremes)))
    at = POINTS // 6
    speed = words.symbol("V_t")
    canvas.label(
        f"{speed} cos kt + (a/k) sin kt",
        field.at(float(t[at]), float(wave[at])),
        prefer=1j,
        clear=1.5,
        height=scene.style.text,
    )
    name = f"−({words.symbol('C_01')}/{words.symbol('C_12')})({speed} + at)"
    canvas.label(name, (ends[0], ends[1]), prefer=-1j, clear=1.5, height=scene.style.text)
    canvas.part(CROSSING)
    for n in range(1, len(roots.times) + 1):
        number = f"({n})" if len(roots.times) > FEW else ""
        _crossing(canvas, scene, EXTREMES, f"X{n}", f"t_2_{n}_drawn", number)
    notes = [scene.stated(f"t_2_{n}", time, "s") for n, time in enumerate(roots.times, 1)]
    lines = tuple("; ".join(notes[i : i + FEW]) for i in range(0, len(notes), FEW))
    said = lines or (words["hoist.no_extremes"],)
    return canvas.finish("extremes", (words["heading.hoist_extremes"], scene.factors("mu_v", "mu_t1")), said)


def _shown(roots: Roots, crossed: tuple[int, ...]) -> list[int]:
    """Return the section lines whose points are marked: all, or of very many those beside a crossing."""
    lines = range(roots.sections + 1)
    if roots.sections <= MANY:
        return list(lines)
    return [i for i in lines if any(abs(i - k) <= BESIDE_CROSSING for k in crossed)]


def _node(scene: HoistScene, plan: str, mark: str) -> Any:
    return scene.node(scene.mm(f"{plan}.{mark}"), mark)


def _crossing(canvas: Canvas, scene: HoistScene, plan: str, mark: str, name: str, number: str = "") -> None:
    """Mark a crossing with its time or, where there are many, its number; carry it down to the axis of times."""
    at = scene.mm(f"{plan}.{mark}")
    quantity = scene.solved.quantities[name]
    if abs(at.imag) > 0.01:
        canvas.add(Line(at, complex(at.real, 0.0), Pen.DASHED, role="projection", name=name))
    canvas.add(scene.node(at, mark, filled=True))
    canvas.label(
        number or scene.stated(name, quantity.value or 0.0, "s"),
        at,
        prefer=1.0 - 1j,
        clear=1.2,
        height=scene.style.text,
    )


LIFT_OFF_FIGURE = Figure(
    "lift_off", lift_off_view, ("part",), stages("axes", "points", "curves", CROSSING), "hoist.lift_off"
)
EXTREMES_FIGURE = Figure("extremes", extremes_view, ("part",), stages("axes", "curves", CROSSING), "hoist.extremes")
