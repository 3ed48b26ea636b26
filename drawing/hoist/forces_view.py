"""The forces over time, to scale: both until the lift-off, the rope's for a swing after it, the article's beside it."""

from __future__ import annotations

import numpy as np

from ...plans.hoist.article import article_force
from ...plans.hoist.course import course, end_of, marks
from ...plans.hoist.diagram_plan import FORCES
from ...plans.laws import TURN
from ..diagram import Axis, Field, curve, divisions
from ..figure import Figure, Stage, stages
from ..shapes import Line, Pen, Text
from ..view import Canvas, View
from .axes import ruled
from .scene import COARSE, POINTS, HoistScene

TALLEST = 1.05
RESTING, HANGING = "resting", "hanging"  # stages: until the lift-off, after it
ROW = 1.7  # heights of letters from time to time above the diagram


def forces_view(scene: HoistScene) -> View:
    """Draw the forces over time."""
    canvas, words = FORCES_FIGURE.canvas(scene, COARSE), scene.words
    field = _field(scene)
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("levels")
    _levels(canvas, scene, field)
    _curves(canvas, scene, field)
    _times(canvas, scene, field)
    _values(canvas, scene, field)
    notes = [words["hoist.article"]]
    if 0 in scene.solved.layout.bent:
        mu = words.short(float(f"{scene.scale('mu_F').mu / scene.size('C_01'):.3g}"))
        unit = words.unit("m/mm")
        notes.append(words["hoist.course"].format(w=words.symbol("w_0"), F=words.symbol("F_01"), mu=mu, unit=unit))
    roots = scene.solved.layout.roots
    if scene.solved.forces.motion is not None:
        notes.append(words["hoist.one_sided"])
    if roots is not None and not roots.times:
        notes.append(words["hoist.no_extremes"])
    heading = (words["heading.hoist_forces"], scene.factors("mu_F", "mu_t"))
    return canvas.finish("forces", heading, tuple(notes))


def _end(scene: HoistScene) -> float:
    return end_of(scene.solved.forces.found, scene.solved.forces.motion)


def _field(scene: HoistScene) -> Field:
    """Return the axes: from -m g to beyond the greatest force, that of the article among them."""
    words, time, force = scene.words, scene.scale("mu_t"), scene.scale("mu_F")
    high = TALLEST * max(scene.size("F_max"), scene.size("P_12_max_printed"))
    low = min(-TALLEST * scene.size("P_st"), 0.0)
    across = {t: words.short(round(t, 9)) for t in divisions(_end(scene), 0.0, time.mu, 16.0)}
    up = {F: words.short(round(F, 6)) for F in divisions(high, low, force.mu, 14.0)}
    x = Axis(f"t, {words.unit('s')}", time, 0.0, _end(scene), across)
    return Field(0j, x, Axis(f"F, {words.unit('N')}", force, low, high, up))


def _curves(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    forces, t_1 = scene.solved.forces, scene.size("t_1")
    before = np.linspace(0.0, t_1 * (1.0 - 1e-12), POINTS)
    after = np.linspace(t_1, _end(scene) * (1.0 - 1e-12), POINTS)
    first, second = (course(forces.found, forces.motion, t).columns for t in (before, after))
    canvas.part(RESTING)
    curve(canvas, field, zip(before.tolist(), first["F_01"].tolist(), strict=True), "F_01")
    curve(canvas, field, zip(before.tolist(), first["F_12"].tolist(), strict=True), "F_12")
    canvas.part(HANGING)
    curve(canvas, field, zip(after.tolist(), second["F_12"].tolist(), strict=True), "P_12")
    printed = np.asarray(article_force(forces.found, after - t_1))
    swing = after <= t_1 + TURN / scene.size("k_1")
    within = np.where(printed >= field.y.low, printed, np.nan)[swing]
    canvas.part("article")
    curve(canvas, field, zip(after[swing].tolist(), within.tolist(), strict=True), "printed", Pen.DASHED)
    jump = field.at(t_1, float(second["F_12"][0])), field.at(t_1, float(printed[0]))
    canvas.add(Line(*jump, Pen.DASHED, role="jump", name="printed"))
    canvas.part(RESTING)
    for name, t, column in (("F_01", before[POINTS // 3], first["F_01"]), ("F_12", before[POINTS // 3], first["F_12"])):
        canvas.label(scene.words.symbol(name), field.at(float(t), float(column[POINTS // 3])), prefer=1j, clear=1.5)
    k = 3 * POINTS // 5
    canvas.part(HANGING)
    canvas.label(scene.words.symbol("P_12"), field.at(float(after[k]), float(second["F_12"][k])), prefer=1j, clear=1.5)


def _levels(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    """Draw the levels m g and m (g + a)."""
    for name in ("P_st", "P_m"):
        ends = field.at(0.0, scene.size(name)), field.at(field.x.high, scene.size(name))
        canvas.add(Line(*ends, Pen.AXIS, role="level", name=name))
        if name == "P_m" and scene.size("P_m") == scene.size("P_st"):
            continue
        canvas.label(scene.stated(name), ends[1], prefer=1.0 + (0.6j if name == "P_m" else -0.6j), clear=1.5)


def _times(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    """Draw upright lines at the lift-off, the maxima before it, and the greatest force after it."""
    marked = {"t_1": scene.size("t_1"), "t_P12_max": scene.size("t_1") + scene.size("T_1")}
    maxima = [q for name, q in scene.solved.quantities.items() if name.startswith("t_2_") and name[4:].isdigit()]
    marked |= {quantity.name: float(quantity.value or 0.0) for quantity in maxima[::2]}
    height, rows = scene.style.text, 0
    top = field.at(0.0, field.y.high).imag
    for name, t in sorted(marked.items(), key=lambda mark: -mark[1]):  # the later, the lower: no text meets a line
        if t > field.x.high:
            continue
        level = top + ROW * height * (rows + 1)
        canvas.part(HANGING if name == "t_P12_max" else RESTING)
        foot, end = field.at(t, field.y.low), complex(field.at(t, 0.0).real, level + height)
        canvas.add(Line(foot, end, Pen.THIN, role="time", name=name))
        canvas.add(Text(complex(end.real + 0.5, level), scene.stated(name, t, "s"), height, "left", role="time"))
        rows += 1


def _values(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    """Mark the greatest and the least forces with their values."""
    shown = {"P_12_max": f"{FORCES}.T", "F_12_t1": f"{FORCES}.R{scene.solved.layout.resting}"}
    for name, mark in shown.items():
        at = field.origin + scene.mm(mark)
        canvas.part(HANGING if name == "P_12_max" else RESTING)
        canvas.add(scene.node(at, name, filled=True))
        canvas.label(scene.stated(name), at, prefer=1.0 + 1j, clear=1.2, height=scene.style.text)
    extra = {"F_12_max": scene.size("t_F12_max")} if scene.size("t_F12_max") != scene.size("t_1") else {}
    extra |= {"P_12_min": marks(scene.solved.forces.found, scene.solved.forces.motion)["P_12_min"]}
    for name, t in extra.items():
        at = field.at(t, scene.size(name))
        canvas.part(HANGING if name == "P_12_min" else RESTING)
        canvas.add(scene.node(at, name, filled=True))
        canvas.label(scene.stated(name), at, prefer=1j if "max" in name else -1j, clear=1.2, height=scene.style.text)


# where the closed formulas are not valid, the first step says so, and draws nothing
MOVED = Stage("moved", when=lambda scene: scene.solved.forces.motion is not None)
FORCES_FIGURE = Figure(
    "forces",
    forces_view,
    ("part",),
    (Stage("axes"), MOVED, *stages("levels", RESTING, HANGING, "article")),
    "hoist.forces",
)
