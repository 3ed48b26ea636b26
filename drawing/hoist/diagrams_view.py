"""The diagrams of a hoist: its equations solved by drawing, the forces over time, the circle of phase 2."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ...plans.hoist.construction import EXTREMES, FORCES, LIFT_OFF, Roots
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import POINTS, equation, forces_over
from ...plans.solved import PAPER_MM
from ..areas import clipped
from ..dimensions import Axis, Field, angle, divisions, drawn_through, linear, numbered
from ..figure import Figure, Stage, stages
from ..shapes import Group, Head, Line, Pen, Polyline, Shape, Text
from ..symbols import arc_between
from ..text import Box
from ..view import UNNUMBERED, Canvas, View
from .scene import HoistScene

MANY, BESIDE_CROSSING = 48, 4  # section lines
BELOW = 1.08  # times the least ordinate, the foot of the diagram
FEW = 4  # crossings with their times beside them, and times in a line
CURVES = {"parabola": "Y", "sinusoid": "O"}  # of (11), and the letters of their marks
LETTERS = {"parabola": "y − mg/C", "sinusoid": "δ"}
LEVELS = {"P_st": Pen.AXIS, "P_m": Pen.THIN}  # of the load at rest and of its mean force, often close together
BESIDE = 24.0  # mm from a diagram to what is magnified of it
TICK = 1.4  # mm
PAST = 6.0  # mm by which an axis runs past its end
TIMES, HALF = 10.0, 16.0  # how many times as large the crossing is, and half the side of its square, mm
LARGER = (50.0, 20.0, 10.0, 5.0, 2.0)  # times as large as the jump of the article's curve may be
JUMP = 0.7  # of the square's side, that the jump takes at most
LETTER = 5.0  # mm from the ends of a curve in the square to where its letter may stand
ARTICLE = "(14)"  # the formula of its curve
LEAST = 2.5  # mm of a jump in a detail
APART = 0.5  # mm between the times of a crossing that are two lines in a detail
SEEN = 10.0  # mm of a jump that is seen as it is
FREE = 8.0  # mm about a detail inside of a diagram
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
    for name, prefer in (("parabola", -1.0 + 1j), ("sinusoid", 1j)):
        canvas.small(LETTERS[name], curves[name][POINTS // 4], prefer, 1.5)
    canvas.part("crossing")
    _crossing(canvas, scene, LIFT_OFF, "X", "t_1_drawn")
    _magnified(canvas, scene, _room(field, curves["parabola"]), field.at(scene.size("t_1"), 0.0))
    heading = (words["heading.hoist_lift_off"], scene.factors("mu_y", "mu_t1"))
    return canvas.finish("lift_off", heading, (scene.stated("t_1", unit="s"),))


def _extremes_view(scene: HoistScene) -> View:
    """Draw the crossings of sinusoid and straight line."""
    canvas, words, roots = EXTREMES_FIGURE.canvas(scene), scene.words, _roots(scene)
    wave = scene.places(equation(scene.solved, "W"))
    left, right = (scene.mm(f"{EXTREMES}.L{i}") for i in range(2))
    heights = [place.imag for place in wave]
    least = BELOW * min(left.imag, right.imag, *heights)
    field = _field(scene, f"V, {words.unit('m/s')}", "mu_v", (least, max(heights)))
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
EXTREMES_FIGURE = Figure(
    "extremes",
    _extremes_view,
    ("part",),
    stages("axes", "curves", crossing=("", "lift_off.crossing")),
    "hoist.extremes",
)


def _roots(scene: HoistScene) -> Roots:
    roots = scene.solved.layout.roots
    assert roots is not None
    return roots


def _field(scene: HoistScene, letter: str, symbol: str, heights: Sequence[float]) -> Field:
    """Return the axes of a diagram whose ordinates have these heights, mm; times count from where it begins."""
    roots, scale = _roots(scene), scene.scale(symbol)
    low, high = (scale.measured(end(*heights, 0.0)) for end in (min, max))
    up = numbered(scene.words, (0.0, *divisions(high, low, scale.mu, 12.0)))
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
    canvas.keep_clear(
        foot, field.at(x.high, y.low) - 1j * (TICK + 0.6 + 4.0 * h)
    )  # no letter among the numbers, or under them
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


@dataclass(frozen=True, slots=True)
class _Detail:
    """A place of a diagram drawn again in a square, so many `times` as large; `corner` is the lower left one, mm."""

    canvas: Canvas
    scene: HoistScene
    centre: complex
    corner: complex
    times: float

    @property
    def box(self) -> Box:
        """The square."""
        return self.corner.real, self.corner.imag, self.corner.real + 2.0 * HALF, self.corner.imag + 2.0 * HALF

    def at(self, place: complex) -> complex:
        """Return where a place of the diagram is in the square."""
        return self.corner + complex(HALF, HALF) + self.times * (place - self.centre)

    def has(self, place: complex) -> bool:
        """Whether a place of the square is in it, with room for a letter."""
        x0, y0, x1, y1 = self.box
        return x0 <= place.real <= x1 and y0 + LETTER <= place.imag <= y1 - LETTER

    def line(self, a: complex, b: complex, pen: Pen, role: str = "", name: str = "") -> list[Shape]:
        """Return what the square has of a line between two places of the diagram."""
        ends = clipped(self.at(a), self.at(b), self.box)
        return [Line(*ends, pen, role, name)] if ends else []

    def curve(self, places: Iterable[complex], pen: Pen, name: str) -> list[Shape]:
        """Return what the square has of a curve."""
        ends = (clipped(self.at(a), self.at(b), self.box) for a, b in pairwise(places))
        pieces = [part for part in ends if part]
        whole = (*(a for a, _ in pieces), pieces[-1][1]) if pieces else ()
        return [Group((Polyline(whole, pen),), "curve", name)] if pieces else []

    def level(self, name: str, height: complex, text: str) -> None:
        """Draw a level through the square, if it is there, with its letter beside it on the right."""
        line = self.line(height - 2.0 * HALF, height + 2.0 * HALF, LEVELS[name], "level", f"{name}_magnified")
        self.canvas.add(*line)
        if line:
            self.canvas.small(text, complex(self.box[2], self.at(height).imag), 1.0 + 0j, 0.8)

    def moment(self, name: str, at: complex, prefer: complex = -1j) -> None:
        """Draw the line of a time through the square, with its letter under it."""
        self.canvas.add(*self.line(at - 2j * HALF, at + 2j * HALF, Pen.THIN, "time", name))
        self.canvas.small(self.scene.words.symbol(name), complex(self.at(at).real, self.box[1]), prefer, 0.8)

    def framed(self, *shapes: Shape) -> None:
        """Draw the square round its `shapes`, its letter and scale above, and mark the place in the diagram."""
        canvas, h, (x0, y0, x1, y1) = self.canvas, self.scene.style.text, self.box
        square = complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1)
        frame = Group((Polyline(square, Pen.THIN, closed=True),), "frame", "magnified")
        canvas.add(Group(shapes, "magnified", "X"), frame)
        title = f"{UNNUMBERED[0]} ({self.scene.words.short(self.times)}:1)"
        canvas.add(Text(complex(x0 + HALF, y1 + 0.6 * h), title, h, "middle", role="magnified"))
        canvas.detail(UNNUMBERED[0], self.centre, abs(complex(HALF, HALF)) / self.times, "magnified")


def _room(field: Field, curve: Sequence[complex]) -> complex:
    """Return the lower left corner of the square of a detail: below a curve that rises, or else beside the diagram."""
    right, low = field.at(field.x.high, 0.0).real, field.at(0.0, field.y.low).imag
    inner = complex(right - 2.0 * HALF - FREE, low + FREE)
    over = [place.imag for place in curve if place.real > inner.real - FREE]
    if inner.real > 2.0 * HALF and min(*over, 0.0) > inner.imag + 2.0 * (HALF + FREE):
        return inner
    return complex(right + BESIDE, low)


def _magnified(canvas: Canvas, scene: HoistScene, corner: complex, exact: complex) -> None:
    """Draw the crossing of the curves, at the `exact` time, and that of their chords, larger, in a square.

    Its lower left corner is given.
    """
    centre = scene.mm(f"{LIFT_OFF}.X")
    detail = _Detail(canvas, scene, centre, corner, TIMES)
    shapes: list[Shape] = []
    for name, letter in CURVES.items():
        dense = scene.places(equation(scene.solved, letter, centre.real, HALF / TIMES))
        shapes += detail.curve(dense, Pen.MAIN, f"{name}_magnified")
        a, b = (scene.mm(f"{LIFT_OFF}.{letter}{_roots(scene).lift_off + n}") for n in (0, 1))
        shapes += detail.line(a - (b - a), b + (b - a), Pen.THIN)
    later = exact.real - centre.real
    if TIMES * abs(later) >= APART:
        detail.moment("t_1_drawn", complex(centre.real, exact.imag), complex(1.0 if later < 0.0 else -1.0, -1.0))
    detail.moment("t_1", exact, complex(-1.0 if later < 0.0 else 1.0, -1.0))
    shapes += detail.line(complex(centre.real - HALF, 0.0), complex(centre.real + HALF, 0.0), Pen.THIN, "axis")
    detail.framed(*shapes)
    canvas.add(scene.node(detail.at(centre), "magnified"))
    for name, letter in CURVES.items():
        every = map(detail.at, scene.places(equation(scene.solved, letter, centre.real, HALF / TIMES)))
        inside = sorted(filter(detail.has, every), key=lambda place: place.real)
        canvas.small(LETTERS[name], inside[len(inside) // 5], 1j if name == "sinusoid" else -1j, 1.0)


def _forces_view(scene: HoistScene) -> View:
    """Draw the forces over time."""
    canvas, words = FORCES_FIGURE.canvas(scene), scene.words
    field = forces_field(scene)
    canvas.part("axes")
    _ruled(canvas, field)
    canvas.part("levels")
    for name in LEVELS:
        ends = field.at(0.0, scene.size(name)), field.at(field.x.high, scene.size(name))
        canvas.add(Line(*ends, LEVELS[name], role="level", name=name))
        if name == "P_st" or scene.size("P_m") != scene.size("P_st"):
            said = scene.stated(name).replace(" = ", " = mg + ma = " if name == "P_m" else " = ", 1)
            canvas.small(said, ends[1], 1.0 + (0.6j if name == "P_m" else -0.6j), 1.0)
    curves = _curves(canvas, scene, field)
    _times(canvas, scene, field)
    _values(canvas, scene, field)
    canvas.part("article")
    _jump(canvas, scene, field, curves)
    jump = abs(scene.size("P_st") - scene.size("F_12_t1"))  # it begins as if the load hung at rest
    notes = [words["hoist.article"].format(jump=f"{scene.value(jump)} {words.unit('N')}")]
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


def forces_field(scene: HoistScene) -> Field:
    """Return the axes: from -m g to beyond the greatest force, that of the article among them."""
    words, force = scene.words, scene.scale("mu_F")
    high = TALLEST * max(scene.size("F_max"), scene.size("P_12_max_printed"))
    low = min(-TALLEST * scene.size("P_st"), 0.0)
    up = numbered(words, (0.0, *divisions(high, low, force.mu, 14.0)))
    x = _times_axis(scene, "mu_t", 0.0, scene.solved.forces.end)
    return Field(0j, x, Axis(f"F, {words.unit('N')}", force, low, high, up))


def _times_axis(scene: HoistScene, symbol: str, begin: float, last: float) -> Axis:
    """Return an axis of times from `begin` on, where it has its zero, as long as `last`."""
    words, scale = scene.words, scene.scale(symbol)
    times = numbered(words, (0.0, *divisions(begin + last, begin, scale.mu, 16.0))).items()
    return Axis(f"t, {words.unit('s')}", scale, 0.0, last, {t - begin: text for t, text in times if t >= begin})


def _jump(canvas: Canvas, scene: HoistScene, field: Field, curves: Mapping[str, list[complex]]) -> None:
    """Dimension the jump of the article's curve, in a detail where it is small on the diagram."""
    words, t_1 = scene.words, scene.size("t_1")
    at = {name: field.at(t_1, scene.size(name)) for name in ("F_12_t1", "P_st", "P_m")}
    text = f"{scene.value(abs(scene.size('P_st') - scene.size('F_12_t1')))} {words.unit('N')}"
    jump = abs(at["P_st"] - at["F_12_t1"])
    shown = [*at.values()]  # in the detail, with both levels where the jump is large enough then
    times = _times_as_large(shown)
    if jump < LEAST / times:
        shown = [at["P_st"], at["F_12_t1"]]
        times = _times_as_large(shown)
    last = max(field.at(t, 0.0).real for t in (t_1, t_1 + scene.size("T_1")) if t <= field.x.high)
    if jump > SEEN or times == 1.0:  # on the left, or beyond the lines of times where the axis is near
        out = -SEEN if at["P_st"].real > 2.0 * SEEN else last + FREE - at["P_st"].real
        linear(canvas, (at["F_12_t1"], at["P_st"]), complex(out), text, "jump")
        return
    corner = complex(last + FREE, field.at(0.0, 0.0).imag - 2.0 * HALF - FREE)
    if (
        corner.real + 2.0 * HALF + FREE > field.at(field.x.high, 0.0).real
        or corner.imag < field.at(0.0, field.y.low).imag
    ):
        corner = complex(field.at(field.x.high, 0.0).real + BESIDE, field.at(0.0, field.y.low).imag)
    heights = [place.imag for place in shown]
    centre = complex(shown[0].real, 0.5 * (min(heights) + max(heights)))
    detail = _Detail(canvas, scene, centre, corner, times)
    detail.moment("t_1", centre)
    for name in [*LEVELS][: 1 + (at["P_m"] != at["P_st"])]:
        detail.level(name, at[name], words.symbol(name))
    pens = {"F_12": Pen.MAIN, "P_12": Pen.MAIN, "printed": Pen.DASHED}
    shapes = [shape for name, pen in pens.items() for shape in detail.curve(curves[name], pen, f"{name}_magnified")]
    shapes += detail.line(at["F_12_t1"], at["P_st"], Pen.DASHED)
    detail.framed(*shapes)
    canvas.add(scene.node(detail.at(at["F_12_t1"]), "magnified", filled=True))
    linear(canvas, (detail.at(at["F_12_t1"]), detail.at(at["P_st"])), complex(-HALF - 0.5 * FREE), text, "jump")
    # letters at the ends of the curves, that of P_12 in the middle: the levels have theirs beside its end
    for name, share, prefer in (("F_12", 0.0, -1.0 - 1j), ("P_12", 0.5, 1.0 - 1j), ("printed", 1.0, 1.0 + 0.5j)):
        inside = [place for place in map(detail.at, curves[name]) if detail.has(place)]
        if inside:
            said = ARTICLE if name == "printed" else words.symbol(name)
            canvas.small(said, inside[round(share * (len(inside) - 1))], prefer, 1.0)


def _times_as_large(places: Sequence[complex]) -> float:
    """Return how many times as large upright distances may be in a detail."""
    heights = [place.imag for place in places]
    return next((times for times in LARGER if times * (max(heights) - min(heights)) <= JUMP * 2.0 * HALF), 1.0)


def _curves(canvas: Canvas, scene: HoistScene, field: Field) -> dict[str, list[complex]]:
    """Draw the forces in both phases, and the article's as far as the axis goes; return them."""
    curves = {name: scene.places(places) for name, places in forces_over(scene.solved).items()}
    foot, printed = field.at(0.0, field.y.low).imag, curves["printed"]
    stage = {"F_01": RESTING, "F_12": RESTING, "P_12": HANGING}
    for name, part in stage.items():
        canvas.part(part)
        drawn_through(canvas, curves[name], name)
    canvas.part("article")
    drawn_through(canvas, (p if p.imag >= foot else BROKEN for p in printed), "printed", Pen.DASHED)
    canvas.add(Line(curves["P_12"][0], printed[0], Pen.DASHED, role="jump", name="printed"))
    apart = max(range(len(printed)), key=lambda k: abs(printed[k] - curves["P_12"][k]))
    canvas.small(ARTICLE, printed[apart], printed[apart] - curves["P_12"][apart], 1.2)
    for name, k in (("F_01", POINTS // 3), ("F_12", POINTS // 3), ("P_12", 3 * POINTS // 5)):
        canvas.part(stage[name])
        canvas.label(scene.words.symbol(name), curves[name][k], prefer=1j, clear=1.5)
    return curves


def _times(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    """Draw upright lines at the lift-off, the maxima before it, and the greatest force after it."""
    marked = {"t_1": scene.size("t_1"), "t_P12_max": scene.sum_of("t_1", "T_1")}
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
        canvas.add(
            Text(complex(end.real + 0.4 * height, level), scene.stated(name, t, "s"), height, "left", role="time")
        )
        rows += 1


def _values(canvas: Canvas, scene: HoistScene, field: Field) -> None:
    """Mark the greatest and the least forces with their values."""
    marks = [("P_12_max", "T", HANGING, 1.0 + 1j), ("F_12_t1", f"R{scene.solved.layout.resting}", RESTING, 1.0 + 1j)]
    marks.append(("P_12_min", "L", HANGING, -1j))
    if scene.size("t_F12_max") != scene.size("t_1"):
        marks.append(("F_12_max", "M", RESTING, 1j))
    places = [(name, scene.mm(f"{FORCES}.{mark}"), part, prefer) for name, mark, part, prefer in marks]
    roots = scene.solved.layout.roots
    if scene.size("F_12_min") != scene.size("F_12_t1") and roots and len(roots.times) > 1:  # the first trough
        places.append(("F_12_min", field.at(roots.times[1], scene.size("F_12_min")), RESTING, -1j))
    for name, at, part, prefer in places:
        canvas.part(part, scene.node(at, name, filled=True))
        canvas.small(scene.stated(name), at, prefer, 1.2)


# where the closed formulas are not valid, the first step says so, and draws nothing
MOVED = Stage("moved", when=lambda scene: scene.solved.forces.motion is not None)
FORCES_FIGURE = Figure(
    "forces",
    _forces_view,
    ("part",),
    (
        Stage("axes"),
        MOVED,
        *stages("levels", **{RESTING: ("", "lift_off.crossing"), HANGING: ("", "circle.ends")}, article=""),
    ),
    "hoist.forces",
)


def _circle_view(scene: HoistScene) -> View:
    """Draw the circle with its start, its diameter and the angle run through."""
    canvas, words = CIRCLE_FIGURE.canvas(scene), scene.words
    canvas.breaks = {"axis": False}
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
        canvas.small(scene.stated(name), at, (at or -1.0 - 0.4j) - 0.6j, 2.0 if name in reached else 1.2)
    notes = (
        f"{scene.stated('R')};  {words['hoist.equal']}",
        *([words["hoist.slack"]] if scene.solved.layout.slack else []),
    )
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
    "circle",
    _circle_view,
    ("mu_F_circle",),
    (*stages("axes", start=("", "lift_off.crossing"), circle=""), ENDS),
    "hoist.circle",
)
