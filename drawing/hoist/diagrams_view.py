"""The diagrams of a hoist: its equations solved by drawing, the forces over time, the circle of phase 2."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...plans.hoist.construction import EXTREMES, FORCES, LIFT_OFF, Roots
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import POINTS, equation, forces_over
from ...plans.solved import PAPER_MM
from ..areas import clipped
from ..diagram import Axis, Field, divisions, drawn_through
from ..figure import Figure, Stage, stages
from ..shapes import Group, Head, Line, Pen, Polyline, Shape, Text
from ..symbols import arc_between
from ..view import Canvas, View, angle
from .scene import HoistScene

MANY, BESIDE_CROSSING = 48, 4  # section lines
BELOW = 1.08  # times the least ordinate, the foot of the diagram
FEW = 4  # crossings with their times beside them, and times in a line
CURVES = {"parabola": "Y", "sinusoid": "O"}  # of (11), and the letters of their marks
BESIDE = 24.0  # mm from a diagram to what is magnified of it
TICK = 1.4  # mm
PAST = 6.0  # mm by which an axis runs past its end
TIMES, HALF = 10.0, 16.0  # how many times as large the crossing is, and half the side of its square, mm
TALLEST = 1.05
BROKEN = complex("nan+nanj")  # where a curve is interrupted
RESTING, HANGING = "resting", "hanging"  # stages: until the lift-off, after it
ROW = 1.7  # heights of letters from time to time above the diagram
CIRCLE_PAST = 14.0  # mm by which the axis runs past the circle
SAME = 1e-6  # part of the radius
ANGLE = 0.3  # part of the radius at which the angle is dimensioned


def _lift_off_view(scene: HoistScene) -> View:
    """Draw the crossing of parabola and sinusoid."""
    canvas, words, roots = LIFT_OFF_FIGURE.canvas(scene), scene.words, _roots(scene)
    curves = {name: scene.places(equation(scene.solved, letter)) for name, letter in CURVES.items()}
    heights = [place.imag for places in curves.values() for place in places]
    field = _field(scene, f"y, {words.unit('m')}", "mu_y", heights)
    canvas.part("axes")
    _ruled(canvas, field)
    canvas.part("curves")
    for name, places in curves.items():
        drawn_through(canvas, places, name)
    canvas.part("points")
    for letter in CURVES.values():
        marks = (f"{letter}{i}" for i in _shown(roots, (roots.lift_off,)))
        canvas.add(*(scene.node(scene.mm(f"{LIFT_OFF}.{mark}"), mark) for mark in marks))
    canvas.part("curves")
    for text, name, prefer in (("y − mg/C", "parabola", -1j), ("osc", "sinusoid", 1j)):
        canvas.small(text, curves[name][POINTS // 4], prefer, 1.5)
    canvas.part("crossing")
    _crossing(canvas, scene, LIFT_OFF, "X", "t_1_drawn")
    _magnified(canvas, scene, complex(field.at(field.x.high, 0.0).real + BESIDE, field.at(0.0, field.y.low).imag))
    heading = (words["heading.hoist_lift_off"], scene.factors("mu_y", "mu_t1"))
    return canvas.finish("lift_off", heading, (scene.stated("t_1", unit="s"),))


def _extremes_view(scene: HoistScene) -> View:
    """Draw the crossings of sinusoid and straight line."""
    canvas, words, roots = EXTREMES_FIGURE.canvas(scene), scene.words, _roots(scene)
    wave = scene.places(equation(scene.solved, "W"))
    left, right = (scene.mm(f"{EXTREMES}.L{i}") for i in range(2))
    heights = [place.imag for place in wave]
    least = BELOW * min(left.imag, right.imag, *heights)
    field = _field(scene, words.unit("m/s"), "mu_v", (least, max(heights)))
    canvas.part("axes")
    _ruled(canvas, field)
    canvas.part("curves")
    drawn_through(canvas, wave, "sinusoid")
    canvas.add(Line(left, right, Pen.MAIN, role="curve", name="line"))
    canvas.add(*(scene.node(scene.mm(f"{EXTREMES}.W{i}"), f"W{i}") for i in _shown(roots, roots.extremes)))
    speed = words.symbol("V_t")
    canvas.small(f"{speed} cos kt + (a/k) sin kt", wave[POINTS // 6], 1j, 1.5)
    name = f"−({words.symbol('C_01')}/{words.symbol('C_12')})({speed} + at)"
    canvas.small(name, (left, right), -1j, 1.5)
    canvas.part("crossing")
    for n in range(1, len(roots.times) + 1):
        number = f"({n})" if len(roots.times) > FEW else ""
        _crossing(canvas, scene, EXTREMES, f"X{n}", f"t_2_{n}_drawn", number)
    notes = [scene.stated(f"t_2_{n}", time, "s") for n, time in enumerate(roots.times, 1)]
    lines = tuple("; ".join(notes[i : i + FEW]) for i in range(0, len(notes), FEW))
    said = lines or (words["hoist.no_extremes"],)
    return canvas.finish("extremes", (words["heading.hoist_extremes"], scene.factors("mu_v", "mu_t1")), said)


LIFT_OFF_FIGURE = Figure(
    "lift_off", _lift_off_view, ("part",), stages("axes", "points", "curves", "crossing"), "hoist.lift_off"
)
EXTREMES_FIGURE = Figure("extremes", _extremes_view, ("part",), stages("axes", "curves", "crossing"), "hoist.extremes")


def _roots(scene: HoistScene) -> Roots:
    roots = scene.solved.layout.roots
    assert roots is not None
    return roots


def _field(scene: HoistScene, letter: str, symbol: str, heights: Sequence[float]) -> Field:
    """Return the axes of a diagram whose ordinates have these heights, mm; times count from where it begins."""
    roots, scale = _roots(scene), scene.scale(symbol)
    low, high = (scale.measured(end(*heights, 0.0)) for end in (min, max))
    up = {y: scene.words.short(round(y, 9)) for y in divisions(high, low, scale.mu, 12.0)}
    x = _times_axis(scene, "mu_t1", roots.begin, roots.sections * roots.section)
    return Field(0j, x, Axis(letter, scale, low, high, up))


def _ruled(canvas: Canvas, field: Field) -> None:
    """Draw axes with numbers in fixed places, those of the abscissas at the foot: no grid runs through curves."""
    x, y, h = field.x, field.y, canvas.style.text
    foot, top = field.at(0.0, y.low), field.at(0.0, y.high) + 1j * PAST
    left, right = field.at(x.low, 0.0), field.at(x.high, 0.0) + PAST
    for a, b in ((foot, top), (left, right)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.add(Line(foot, field.at(x.high, y.low), Pen.THIN, role="scale"))
    canvas.label(y.letter, top, prefer=1.0 + 0.2j, clear=1.2)
    canvas.label(x.letter, right, prefer=1j, clear=1.2)
    for value, number in x.divisions.items():
        at = field.at(value, y.low)
        canvas.add(Line(at - 1j * TICK, at, Pen.THIN, role="division"))
        canvas.add(Text(at - 1j * (TICK + 0.6 + h), number, h, "middle", role="number"))
    for value, number in y.divisions.items():
        at = field.at(0.0, value)
        canvas.add(Line(at - TICK, at, Pen.THIN, role="division"))
        canvas.add(Text(at - complex(TICK + 0.8, 0.5 * h), number, h, "right", role="number"))


def _shown(roots: Roots, crossed: tuple[int, ...]) -> list[int]:
    """Return the section lines whose points are marked: all, or of very many those beside a crossing."""
    lines = range(roots.sections + 1)
    if roots.sections <= MANY:
        return list(lines)
    return [i for i in lines if any(abs(i - k) <= BESIDE_CROSSING for k in crossed)]


def _crossing(canvas: Canvas, scene: HoistScene, plan: str, mark: str, name: str, number: str = "") -> None:
    """Mark a crossing with its time or, where there are many, its number; carry it down to the axis of times."""
    at = scene.mm(f"{plan}.{mark}")
    if abs(at.imag) > 0.01:
        canvas.add(Line(at, complex(at.real, 0.0), Pen.DASHED, role="projection", name=name))
    canvas.add(scene.node(at, mark, filled=True))
    text = number or scene.stated(name, scene.solved.quantities[name].value or 0.0, "s")
    canvas.small(text, at, 1.0 - 1j, 1.2)


def _magnified(canvas: Canvas, scene: HoistScene, corner: complex) -> None:
    """Draw the crossing with its chords, larger, in a square whose lower left corner is given."""
    centre, middle, h = scene.mm(f"{LIFT_OFF}.X"), corner + complex(HALF, HALF), scene.style.text
    box = corner.real, corner.imag, corner.real + 2.0 * HALF, corner.imag + 2.0 * HALF
    curves: list[Shape] = []
    chords: list[Shape] = []
    for letter in CURVES.values():
        dense = scene.places(equation(scene.solved, letter, centre.real, HALF / TIMES))
        places = [middle + TIMES * (place - centre) for place in dense]
        curves += (Polyline(part, Pen.MAIN) for ends in pairwise(places) if (part := clipped(*ends, box)))
        nodes = (scene.mm(f"{LIFT_OFF}.{letter}{_roots(scene).lift_off + n}") for n in (0, 1))
        a, b = (middle + TIMES * (node - centre) for node in nodes)
        chord = clipped(a - (b - a), b + (b - a), box)
        chords += [Line(*chord, Pen.THIN)] if chord else []
    square = tuple(middle + HALF * complex(x, y) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    frame = Group((Polyline(square, Pen.THIN, closed=True),), "frame", "magnified")
    canvas.add(Group((*curves, *chords), "magnified", "X"), frame, scene.node(middle, "magnified"))
    at = middle + 1j * (HALF + 0.6 * h)
    canvas.add(Text(at, f"{scene.words.short(TIMES)}:1", h, "middle", role="magnified"))


def _forces_view(scene: HoistScene) -> View:
    """Draw the forces over time."""
    canvas, words = FORCES_FIGURE.canvas(scene), scene.words
    field = _forces_field(scene)
    canvas.part("axes")
    _ruled(canvas, field)
    canvas.part("levels")
    for name in ("P_st", "P_m"):
        ends = field.at(0.0, scene.size(name)), field.at(field.x.high, scene.size(name))
        canvas.add(Line(*ends, Pen.AXIS, role="level", name=name))
        if name == "P_st" or scene.size("P_m") != scene.size("P_st"):
            canvas.label(scene.stated(name), ends[1], prefer=1.0 + (0.6j if name == "P_m" else -0.6j), clear=1.5)
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


def _forces_field(scene: HoistScene) -> Field:
    """Return the axes: from -m g to beyond the greatest force, that of the article among them."""
    words, force = scene.words, scene.scale("mu_F")
    high = TALLEST * max(scene.size("F_max"), scene.size("P_12_max_printed"))
    low = min(-TALLEST * scene.size("P_st"), 0.0)
    up = {F: words.short(round(F, 6)) for F in divisions(high, low, force.mu, 14.0)}
    x = _times_axis(scene, "mu_t", 0.0, scene.solved.forces.end)
    return Field(0j, x, Axis(f"F, {words.unit('N')}", force, low, high, up))


def _times_axis(scene: HoistScene, symbol: str, begin: float, last: float) -> Axis:
    """Return an axis of times from `begin` on, where it has its zero, as long as `last`."""
    words, scale = scene.words, scene.scale(symbol)
    times = (t for t in divisions(begin + last, begin, scale.mu, 16.0) if t >= begin)
    return Axis(f"t, {words.unit('s')}", scale, 0.0, last, {t - begin: words.short(round(t, 9)) for t in times})


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
        canvas.part(part, scene.node(at, name, filled=True))
        canvas.small(scene.stated(name), at, prefer, 1.2)


# where the closed formulas are not valid, the first step says so, and draws nothing
MOVED = Stage("moved", when=lambda scene: scene.solved.forces.motion is not None)
FORCES_FIGURE = Figure(
    "forces",
    _forces_view,
    ("part",),
    (Stage("axes"), MOVED, *stages("levels", RESTING, HANGING, "article")),
    "hoist.forces",
)


def _circle_view(scene: HoistScene) -> View:
    """Draw the circle with its start, its diameter and the angle run through."""
    canvas, words = CIRCLE_FIGURE.canvas(scene), scene.words
    centre = scene.mm(f"{CIRCLE}.C")  # the origin of the view
    start, right, left = (scene.mm(f"{CIRCLE}.{mark}") - centre for mark in ("1", "max", "min"))
    radius = right.real
    canvas.part("axes")
    end, top = right + CIRCLE_PAST, 1j * (radius + CIRCLE_PAST)
    for a, b in ((left - CIRCLE_PAST, end), (-top, top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(f"{words.symbol('P_12')}, {words.unit('N')}", end, prefer=-1j, clear=1.2)
    canvas.label(f"P′_{{12}}/k_{{1}}, {words.unit('N')}", top, prefer=1.0 + 0j, clear=1.2)
    canvas.part("circle")
    _circle(canvas, scene, (left, right))
    canvas.add(Line(0j, start, Pen.MAIN, role="radius", name="R"))
    canvas.part("ends")
    angle(canvas, 0j, (start, right), max(ANGLE * radius, 8.0), "phi_1", scene.stated("phi_1", unit="rad"), turn=-1)
    canvas.part("circle")
    canvas.label(words.symbol("R"), (0j, start), clear=1.0, height=scene.style.text)
    marks = {"P_m": 0j, "F_12_t1": start, "P_12_max": right, "P_12_min": left}
    reached = {"P_12_max": scene.size("P_m") + scene.size("R"), "P_12_min": scene.size("P_m") - scene.size("R")}
    for name, at in marks.items():
        if abs(reached.get(name, scene.size(name)) - scene.size(name)) > SAME * scene.size("R"):
            continue  # the rope goes slack before, or the load comes back
        canvas.part("ends" if name in reached else "start", scene.node(at, name, filled=True))
        canvas.small(scene.stated(name), at, (at or -1j) - 0.6j, 1.2)
    notes = (scene.stated("R"), *([words["hoist.slack"]] if scene.solved.layout.slack else []))
    return canvas.finish("circle", (words["heading.hoist_circle"], scene.factors("mu_F_circle")), notes)


def _circle(canvas: Canvas, scene: HoistScene, ends: tuple[complex, complex]) -> None:
    """Draw the circle; where the rope would push it is only dashed, beyond a line where its force is zero."""
    if not scene.solved.layout.slack:
        canvas.add(Group(tuple(arc_between(0j, *pair, Pen.MAIN) for pair in (ends[::-1], ends)), "circle", "R"))
        return
    high, low = (scene.mm(f"{CIRCLE}.{mark}") - scene.mm(f"{CIRCLE}.C") for mark in ("high", "low"))
    pulled = (arc_between(0j, *pair, Pen.MAIN) for pair in ((low, ends[1]), (ends[1], high)))
    canvas.add(Group(tuple(pulled), "circle", "R"), arc_between(0j, high, low, Pen.DASHED, role="slack"))
    canvas.add(Line(low, high, Pen.THIN, role="level", name="slack"))
    symbol = scene.words.symbol("P_12")
    canvas.small(f"{symbol} = 0", high, -1.0 + 1j, 1.2)


# a rope that goes slack need not reach the ends of the diameter: they are no step of their own
ENDS = Stage("ends", when=lambda scene: scene.solved.forces.motion is None)
CIRCLE_FIGURE = Figure(
    "circle", _circle_view, ("mu_F_circle",), (*stages("axes", "start", "circle"), ENDS), "hoist.circle"
)
