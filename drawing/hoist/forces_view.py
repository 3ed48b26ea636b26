"""The forces over time, to scale: both until the lift-off, the rope's for a swing after it, the article's beside it."""

from __future__ import annotations

from ...plans.hoist.construction import FORCES
from ...plans.hoist.course import end_of
from ...plans.hoist.solve import POINTS, forces_over
from ...plans.solved import PAPER_MM
from ..diagram import Axis, Field, divisions, drawn_through
from ..figure import Figure, Stage, stages
from ..shapes import Line, Pen, Text
from ..view import Canvas, View
from .roots_view import ruled
from .scene import HoistScene

TALLEST = 1.05
BROKEN = complex("nan+nanj")  # where a curve is interrupted
RESTING, HANGING = "resting", "hanging"  # stages: until the lift-off, after it
ROW = 1.7  # heights of letters from time to time above the diagram


def forces_view(scene: HoistScene) -> View:
    """Draw the forces over time."""
    canvas, words = FORCES_FIGURE.canvas(scene), scene.words
    field = _field(scene)
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("levels")
    _levels(canvas, scene, field)
    _curves(canvas, scene, field)
    _times(canvas, scene, field)
    _values(canvas, scene)
    notes = [words["hoist.article"]]
    if 0 in scene.solved.layout.bent:
        mu = words.short(float(f"{scene.solved.size('_mu_w_0') * PAPER_MM:.3g}"))
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
    """Draw the forces in both phases, and the article's as far as the axis goes."""
    curves = {name: scene.places(places) for name, places in forces_over(scene.solved).items()}
    foot, printed = field.at(0.0, field.y.low).imag, curves["printed"]
    stage = {"F_01": RESTING, "F_12": RESTING, "P_12": HANGING}
    for name, part in stage.items():
        canvas.part(part)
        drawn_through(canvas, curves[name], name)
    canvas.part("article")
    drawn_through(canvas, (p if p.imag >= foot else BROKEN for p in printed), "printed", Pen.DASHED)
    canvas.add(Line(curves["P_12"][0], printed[0], Pen.DASHED, role="jump", name="printed"))
    for name, k in (("F_01", POINTS // 3), ("F_12", POINTS // 3), ("P_12", 3 * POINTS // 5)):
        canvas.part(stage[name])
        canvas.label(scene.words.symbol(name), curves[name][k], prefer=1j, clear=1.5)


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
    roots, shown = scene.solved.layout.roots, scene.solved.quantities
    times = enumerate(roots.times, 1) if roots else ()
    marked |= {name: t for n, t in times if n % 2 and (name := f"t_2_{n}") in shown}  # the maxima
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


def _values(canvas: Canvas, scene: HoistScene) -> None:
    """Mark the greatest and the least forces with their values."""
    marks = [("P_12_max", "T", HANGING, 1.0 + 1j), ("F_12_t1", f"R{scene.solved.layout.resting}", RESTING, 1.0 + 1j)]
    if scene.size("t_F12_max") != scene.size("t_1"):
        marks.append(("F_12_max", "M", RESTING, 1j))
    for name, mark, part, prefer in (*marks, ("P_12_min", "L", HANGING, -1j)):
        at = scene.mm(f"{FORCES}.{mark}")
        canvas.part(part)
        canvas.add(scene.node(at, name, filled=True))
        canvas.label(scene.stated(name), at, prefer=prefer, clear=1.2, height=scene.style.text)


# where the closed formulas are not valid, the first step says so, and draws nothing
MOVED = Stage("moved", when=lambda scene: scene.solved.forces.motion is not None)
FORCES_FIGURE = Figure(
    "forces",
    forces_view,
    ("part",),
    (Stage("axes"), MOVED, *stages("levels", RESTING, HANGING, "article")),
    "hoist.forces",
)
