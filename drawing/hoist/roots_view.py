"""The equations (11) and (12) solved by drawing: curves that cross, and the times read at their crossings."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...plans.hoist.construction import EXTREMES, LIFT_OFF, Roots
from ...plans.hoist.solve import POINTS, equation
from ..areas import clipped
from ..diagram import Axis, Field, divisions, drawn_through
from ..figure import Figure, stages
from ..shapes import Group, Head, Line, Pen, Polyline, Shape, Text
from ..view import Canvas, View
from .scene import HoistScene

MANY, BESIDE_CROSSING = 48, 4  # section lines
BELOW = 1.08  # times the least ordinate, the foot of the diagram
FEW = 4  # crossings with their times beside them, and times in a line
CURVES = {"parabola": "Y", "sinusoid": "O"}  # of (11), and the letters of their marks
BESIDE = 24.0  # mm from a diagram to what is magnified of it
TICK = 1.4  # mm
PAST = 6.0  # mm by which an axis runs past its end
TIMES, HALF = 10.0, 16.0  # how many times as large the crossing is, and half the side of its square, mm


def lift_off_view(scene: HoistScene) -> View:
    """Draw the crossing of parabola and sinusoid."""
    canvas, words, roots, h = LIFT_OFF_FIGURE.canvas(scene), scene.words, _roots(scene), scene.style.text
    curves = {name: scene.places(equation(scene.solved, letter)) for name, letter in CURVES.items()}
    heights = [place.imag for places in curves.values() for place in places]
    field = _field(scene, f"y, {words.unit('m')}", "mu_y", heights)
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("curves")
    for name, places in curves.items():
        drawn_through(canvas, places, name)
    canvas.part("points")
    for letter in CURVES.values():
        canvas.add(*(_node(scene, LIFT_OFF, f"{letter}{i}") for i in _shown(roots, (roots.lift_off,))))
    canvas.part("curves")
    for text, name, prefer in (("y − mg/C", "parabola", -1j), ("osc", "sinusoid", 1j)):
        canvas.label(text, curves[name][POINTS // 4], prefer=prefer, clear=1.5, height=h)
    canvas.part("crossing")
    _crossing(canvas, scene, LIFT_OFF, "X", "t_1_drawn")
    _magnified(canvas, scene, complex(field.at(field.x.high, 0.0).real + BESIDE, field.at(0.0, field.y.low).imag))
    heading = (words["heading.hoist_lift_off"], scene.factors("mu_y", "mu_t1"))
    return canvas.finish("lift_off", heading, (scene.stated("t_1", unit="s"),))


def extremes_view(scene: HoistScene) -> View:
    """Draw the crossings of sinusoid and straight line."""
    canvas, words, roots, h = EXTREMES_FIGURE.canvas(scene), scene.words, _roots(scene), scene.style.text
    wave = scene.places(equation(scene.solved, "W"))
    left, right = (scene.mm(f"{EXTREMES}.L{i}") for i in range(2))
    heights = [place.imag for place in wave]
    least = BELOW * min(left.imag, right.imag, *heights)
    field = _field(scene, words.unit("m/s"), "mu_v", (least, max(heights)))
    canvas.part("axes")
    ruled(canvas, field)
    canvas.part("curves")
    drawn_through(canvas, wave, "sinusoid")
    canvas.add(Line(left, right, Pen.MAIN, role="curve", name="line"))
    canvas.add(*(_node(scene, EXTREMES, f"W{i}") for i in _shown(roots, roots.extremes)))
    speed = words.symbol("V_t")
    canvas.label(f"{speed} cos kt + (a/k) sin kt", wave[POINTS // 6], prefer=1j, clear=1.5, height=h)
    name = f"−({words.symbol('C_01')}/{words.symbol('C_12')})({speed} + at)"
    canvas.label(name, (left, right), prefer=-1j, clear=1.5, height=h)
    canvas.part("crossing")
    for n in range(1, len(roots.times) + 1):
        number = f"({n})" if len(roots.times) > FEW else ""
        _crossing(canvas, scene, EXTREMES, f"X{n}", f"t_2_{n}_drawn", number)
    notes = [scene.stated(f"t_2_{n}", time, "s") for n, time in enumerate(roots.times, 1)]
    lines = tuple("; ".join(notes[i : i + FEW]) for i in range(0, len(notes), FEW))
    said = lines or (words["hoist.no_extremes"],)
    return canvas.finish("extremes", (words["heading.hoist_extremes"], scene.factors("mu_v", "mu_t1")), said)


LIFT_OFF_FIGURE = Figure(
    "lift_off", lift_off_view, ("part",), stages("axes", "points", "curves", "crossing"), "hoist.lift_off"
)
EXTREMES_FIGURE = Figure("extremes", extremes_view, ("part",), stages("axes", "curves", "crossing"), "hoist.extremes")


def _roots(scene: HoistScene) -> Roots:
    roots = scene.solved.layout.roots
    assert roots is not None
    return roots


def _field(scene: HoistScene, letter: str, symbol: str, heights: Sequence[float]) -> Field:
    """Return the axes of a diagram whose ordinates have these heights, mm; times count from where it begins."""
    words, roots, time, scale = scene.words, _roots(scene), scene.scale("mu_t1"), scene.scale(symbol)
    low, high = (scale.measured(end(*heights, 0.0)) for end in (min, max))
    last = roots.sections * roots.section
    across = {
        t - roots.begin: words.short(round(t, 9))
        for t in divisions(roots.begin + last, roots.begin, time.mu, 16.0)
        if t >= roots.begin
    }
    up = {y: words.short(round(y, 9)) for y in divisions(high, low, scale.mu, 12.0)}
    return Field(0j, Axis(f"t, {words.unit('s')}", time, 0.0, last, across), Axis(letter, scale, low, high, up))


def ruled(canvas: Canvas, field: Field) -> None:
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


def _node(scene: HoistScene, plan: str, mark: str) -> Group:
    return scene.node(scene.mm(f"{plan}.{mark}"), mark)


def _crossing(canvas: Canvas, scene: HoistScene, plan: str, mark: str, name: str, number: str = "") -> None:
    """Mark a crossing with its time or, where there are many, its number; carry it down to the axis of times."""
    at = scene.mm(f"{plan}.{mark}")
    if abs(at.imag) > 0.01:
        canvas.add(Line(at, complex(at.real, 0.0), Pen.DASHED, role="projection", name=name))
    canvas.add(scene.node(at, mark, filled=True))
    text = number or scene.stated(name, scene.solved.quantities[name].value or 0.0, "s")
    canvas.label(text, at, prefer=1.0 - 1j, clear=1.2, height=scene.style.text)


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
