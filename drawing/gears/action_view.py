"""The line of action straightened, its active part and who touches where; over it velocities and specific sliding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...plans.gears.construction import SLIDING, THETA
from ...plans.gears.course import GearCourse, active_area, sliding_curve
from ...plans.gears.gear import WHEELS
from ...plans.gears.geometry import POINTS
from ...scales.scale import Scale
from ..areas import strokes
from ..dimensions import Axis, Field, axes, curve, divisions, linear, numbered, numbers
from ..figure import ANSWERS, Figure, stages
from ..printed import DEGREES, Input, calculation
from ..shapes import Group, Line, Pen, Polyline, Text
from ..symbols import unit
from ..text import lay_out
from ..view import Canvas, View
from ..words import Words, indexed
from .scene import CURVES, ENDS, GearScene, cut_of

LEVEL = 2.2  # heights of letters for each pair that touches
ROW = 1.8  # heights of letters between dimension lines
FIRST = 3.0  # heights of letters from the line to the first of them
# in which points of the line are marked; all others with the pitches
STAGE = {"N1": "start", "P": "line_of_action", "N2": "line_of_action", "A1": "active_line", "A2": "active_line"}
REDUCTIONS = (1.0, 0.5, 0.4, 0.25, 0.2, 0.1, 0.05, 0.02, 0.01)  # of the ordinates of velocities
TALLEST = {5.0: 130.0, 3.5: 75.0}  # mm of the highest ordinate, by the height of letters
BETWEEN = 4.4  # heights of letters between the diagrams
SIDES = {1: 1.0, 2: -1.0}  # of the pole, on which a wheel's profile is the faster one
PAST = 1.6  # heights of letters by which axes run past their ends
APART = 1.6  # heights of letters between lines of text
ALONG = {1: unit(1.0 + 1.0j), 2: unit(-1.0 + 1.0j)}  # of the strokes under each curve
HATCH, STROKES, DENSEST = 2.5, 8, 1.0  # mm between strokes; where fewer than these fit in they are denser, down to this


def _action_view(overall: GearScene) -> View:
    """Draw N1N2 along the abscissa, N1 on the left."""
    scene = replace(overall, mu_l=overall.rolled)
    canvas = ACTION_FIGURE.canvas(scene, coarse=0.0)
    canvas.part(ANSWERS)
    for k, (first, last, count) in enumerate(GearCourse(scene.solved).zones):  # as many steps as pairs touch
        a, b, top = scene.drawn(first), scene.drawn(last), LEVEL * scene.style.label * count
        corners = complex(a, 0.0), complex(a, top), complex(b, top), complex(b, 0.0)
        canvas.group("zone", f"{k + 1}_{count}", Polyline(corners, Pen.THIN))
        narrow = b - a < lay_out(str(count), scene.style.label).width + 2.0
        level = top + (0.4 if narrow else -0.5 * (LEVEL + 1.0)) * scene.style.label
        canvas.add(
            Text(complex(0.5 * (a + b), level), str(count), scene.style.label, "middle", role="zone", name=str(k + 1))
        )
    _line(canvas, scene)
    canvas.part(ANSWERS)
    _dimensions(canvas, scene)
    heading = scene.words["heading.gear_action"], scene.factor
    notes, words = [*_ratios(scene), *scene.words["said.gear_zones"].split("|")], scene.words
    if scene.lacking:  # say how long the flanks touch, and the contact ratio of that
        touching, mm = scene.touching[1] - scene.touching[0], words.unit("mm")
        parts = [Input(length * 1e3) for length in (touching, scene.size("p_b"))]
        (length, pitch), result = calculation(words, lambda x, y: x / y, parts)
        notes.append(words["said.gear_lacking"].format(length=scene.length(touching)))
        notes.append(f"{words.symbol('epsilon_flanks')} = {length} {mm}/{pitch} {mm} = {result}")
    return canvas.finish("action", heading, tuple(notes))


def _ratios(scene: GearScene) -> tuple[str, ...]:
    """Return the contact ratio by the active line and by the angles of action, printed so that it recomputes."""
    words = scene.words
    epsilon = words.symbol("epsilon_alpha")
    found = []
    ways = [("g_alpha", "p_b", 1e3, words.unit("mm"))]
    ways += [(f"phi_alpha{i}", f"tau_{i}", DEGREES, "°") for i in (1, 2)]
    for over, under, times, sign in ways:
        inputs = [Input(scene.size(name) * times) for name in (over, under)]
        (a, b), result = calculation(words, lambda x, y: x / y, inputs)
        gap = "" if sign == "°" else " "
        ratio = f"{words.symbol(over)}/{words.symbol(under)} = {a}{gap}{sign}/{b}{gap}{sign}"
        found.append(f"{epsilon} = {ratio} = {result}")
    return tuple(found)


def _line(canvas: Canvas, scene: GearScene) -> None:
    """Draw the line with its points."""
    style, line = scene.style, scene.paper("l_N1N2")
    ends = {"A1": scene.paper("rho_p1"), "P": scene.paper("rho_w1"), "A2": scene.paper("rho_a1")}
    low, high = min(0.0, *ends.values()), max(line, *ends.values())
    canvas.part("line_of_action")
    canvas.add(Line(complex(low, 0.0), complex(high, 0.0), Pen.THIN, role="line-of-action", name="N1N2"))
    canvas.part("active_line")
    first, last = map(scene.drawn, scene.touching) if scene.lacking else (ends["A1"], ends["A2"])
    canvas.add(Line(complex(first, 0.0), complex(last, 0.0), Pen.MAIN, role="active", name="A1A2"))
    pitch = scene.paper("p_b")
    ends |= {"N1": 0.0, "N2": line, "K1": ends["A1"] + pitch, "K2": ends["A2"] - pitch}
    for i, x in ((1, scene.paper("rho_l1")), (2, line - scene.paper("rho_l2"))):
        if 0.0 < x < line:
            ends[f"H{i}"] = x
    for name, x in ends.items():
        canvas.part(STAGE.get(name, "pitches"), scene.node(complex(x, 0.0), name, "point"))
        canvas.label(indexed(name), complex(x, 0.0), prefer=-1j, clear=style.node + 0.8)


def _dimensions(canvas: Canvas, scene: GearScene) -> None:
    """Dimension the active line, the base pitch from both its ends, radii of curvature, row by row below the line."""
    names = ("rho_p1", "rho_a1", "l_N1N2", "p_b", "rho_l1", "rho_l2")
    first, last, line, pitch, low_1, low_2 = map(scene.paper, names)
    rows = [
        [("rho_l1", 0.0, low_1, "rho_l1"), ("rho_l2", line - low_2, line, "rho_l2")],
        [("rho_p1", 0.0, first, "rho_p1"), ("rho_p2", last, line, "rho_p2")],
        [("p_b_1", first, first + pitch, "p_b")],
        [("p_b_2", last - pitch, last, "p_b")],
        [("g_alpha", first, last, "g_alpha")],
        [("l_N1N2", 0.0, line, "l_N1N2")],
    ]
    y = -FIRST * scene.style.label
    for row in rows:
        shown = [one for one in row if one[2] - one[1] > 0.0]
        for name, low, high, quantity in shown:
            ends = complex(low, 0.0), complex(high, 0.0)
            linear(canvas, ends, 1j * y, "", name)
            at = ends[0] + 1j * y, ends[1] + 1j * y
            canvas.small(scene.stated(quantity), at, 1j)
        y -= ROW * scene.style.label * bool(shown)


ACTION_FIGURE = Figure(
    "action",
    _action_view,
    ("rolled",),
    stages("start", line_of_action=("", "meshing.line_of_action"), active_line=("", "meshing.active_line"), pitches=""),
    "gear.action",
)


def _sliding_view(scene: GearScene) -> View:
    """Draw both diagrams over N1N2, with the points of the table as section lines through both."""
    canvas, words = SLIDING_FIGURE.canvas(scene, coarse=0.0), scene.words
    highest = max(scene.size(f"y_{i}_{point}") for i in WHEELS for point in POINTS)
    most = TALLEST[scene.style.label] * scene.part
    reduction = next((part for part in REDUCTIONS if highest * 1e3 * part <= most), REDUCTIONS[-1])
    above, below = _fields(scene, highest, 1e-3 / reduction)
    canvas.part("axes")
    for field in (above, below):
        axes(canvas, field, False, PAST * scene.style.label)
    _sections(canvas, scene, above, below)
    _velocities(canvas, scene, above)
    lines = [words["gear.speeds"].format(length=words.short(scene.solved.values["PW"] * 1e3))]
    if reduction < 1.0:
        lines.append(words["gear.reduced"].format(ratio=f"1:{words.short(1.0 / reduction)}"))
    lines += _pole(canvas, scene, above)
    _theta_diagram(canvas, scene, below)
    cut = words["gear.cut"].format(theta=words.number(cut_of(scene.solved), 0))
    theta = theta_said(words, below.y.scale.mu)
    heading = words["heading.gear_sliding"], f"{words.scale(above.x.scale)};  {theta}"
    return canvas.finish("sliding", heading, (f"{words['gear.hatched']}; {cut}", "; ".join(lines)))


def _fields(scene: GearScene, highest: float, mu: float) -> tuple[Field, Field]:
    """Return the axes of velocities, whose greatest is so high, m, and those of specific sliding under them.

    Ordinates of velocities have a scale factor `mu`, m/mm. Along N1N2 the axes are longer where interference puts an
    end of the active line beyond it.
    """
    words, low, scale, lengths = scene.words, cut_of(scene.solved), scene.scale(THETA), scene.places.values()
    x = Axis(words.symbol("rho_1"), scene.scale(SLIDING), min(lengths), max(lengths), {})
    marks = numbered(words, divisions(1.0, low, scale.mu, 9.0))
    origin = 0j - 1j * (BETWEEN * scene.style.label + scale.drawn(1.0))
    above = Field(0j, x, Axis(words.symbol("V_k"), Scale("", mu, "m"), 0.0, highest, {}))
    return above, Field(origin, replace(x, letter=""), Axis(words.symbol("theta"), scale, low, 1.0, marks))


def _place(scene: GearScene, point: str) -> float:
    """Return how far a point of the table is from N1, m."""
    return float(scene.solved.values[f"_rho_1_{point}"])


def _sections(canvas: Canvas, scene: GearScene, above: Field, below: Field) -> None:
    """Draw a line through both diagrams at every point of the table, with its number; the named places with letters.

    The lines begin at the higher ordinate of velocities, so that letters above these stand free.
    """
    height, foot, lines = scene.style.text, below.at(0.0, below.y.low).imag - 1.5, []
    canvas.part(ANSWERS)
    for i, point in enumerate(POINTS, start=1):
        top = above.at(_place(scene, point), max(scene.size(f"y_{k}_{point}") for k in WHEELS))
        canvas.add(Line(top, complex(top.real, foot), Pen.THIN, role="section", name=str(i)))
        lines.append(top.real)
    canvas.add(*numbers(lines, foot - 0.8 - height, height, first=1))
    for name, rho in scene.places.items():
        at = above.at(rho, 0.0)
        part = {"N1": "axes", "A1": "active_line", "A2": "active_line"}.get(name, "pole")
        canvas.part(part, scene.node(at, name, "point", pen=Pen.MAIN))
        canvas.label(indexed(name), at, prefer=-0.6 - 1j if name == "N1" else 0.6 - 1j, clear=1.0, priority=1)


def _velocities(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Draw the lines of both velocities from N1 and N2, marked at the points of the table."""
    words, w = scene.words, field.at(scene.size("rho_w1"), scene.size("PW"))
    for i in WHEELS:
        tips = [field.at(_place(scene, point), scene.size(f"y_{i}_{point}")) for point in POINTS]
        canvas.part("velocities", Group((Line(tips[0], tips[-1], Pen.MAIN),), "curve", f"V_k{i}"))
        canvas.add(*(scene.node(tip, f"y_{i}_{n}", "ordinate") for n, tip in zip(POINTS, tips, strict=True)))
        far = [tip for tip in tips if (tip - w).real * SIDES[i] > -1e-6]
        canvas.label(words.symbol(f"V_k{i}"), _widest(far, w), prefer=1j, clear=1.0)
        point, tip = (POINTS[-1], tips[-1]) if i == 1 else (POINTS[0], tips[0])
        canvas.part(ANSWERS)
        text = f"{words.symbol(f'y_{i}')} = {words.number(scene.size(f'y_{i}_{point}') * 1e3, 2)}"
        linear(canvas, (complex(tip.real, 0.0), tip), 2.0 * scene.style.label * SIDES[i], text, f"y_{i}_{point}")


def _pole(canvas: Canvas, scene: GearScene, field: Field) -> list[str]:
    """Mark W over the pole, and dimension PW; return its text where it has no room along its line."""
    w, words = field.at(scene.size("rho_w1"), scene.size("PW")), scene.words
    text = f"{words.symbol('PW')} = {words.short(round(scene.size('PW') * 1e3, 6))}"
    canvas.part(ANSWERS)
    fits = w.imag - 2.0 * scene.style.arrow > lay_out(text, scene.style.text).width
    linear(canvas, (complex(w.real, 0.0), w), 0j, text if fits else "", "PW")
    canvas.part("pole", scene.node(w, "W", "point", pen=Pen.MAIN))
    canvas.label("W", w, prefer=1j, clear=1.2, priority=1)
    return [] if fits else [f"{text} {words.unit('mm')}"]


def theta_said(words: Words, mu: float) -> str:
    """Return the scale factor of specific sliding, which has no unit of its own."""
    return f"{words.symbol('mu_theta')} = {words.short(mu)} {words.unit('mm')}^{{−1}}"


def _theta_diagram(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Draw both curves with the points of the table, the active part hatched, its extremes with their values."""
    canvas.part("sliding")
    pole, low = scene.size("rho_w1"), field.y.low
    for i, name in CURVES.items():
        tips = {point: (_place(scene, point), scene.size(f"{name}_{point}")) for point in POINTS}
        curve(canvas, field, sliding_curve(scene.solved, i, low), name)
        canvas.add(*(scene.node(field.at(*tip), f"{name}_{point}") for point, tip in tips.items() if tip[1] >= low))
        outline = [field.at(*place) for place in active_area(scene.solved, i, low)]
        if outline:
            across = [(place * ALONG[i].conjugate()).imag for place in outline]
            apart = max(DENSEST, min(HATCH, (max(across) - min(across)) / STROKES))
            canvas.add(Group(tuple(strokes(outline, ALONG[i], apart)), "active", name))
        beyond = [field.at(*tip) for tip in tips.values() if (tip[0] - pole) * SIDES[i] >= 0.0]
        canvas.label(scene.words.symbol(name), _widest(beyond, field.at(pole, 0.0)), prefer=1j, clear=1.0)
    canvas.part(ANSWERS)
    _extremes(canvas, scene, field)


def _widest(tips: Sequence[complex], pole: complex) -> tuple[complex, complex]:
    """Return the two neighbours that are farthest apart across, room for a letter, but for those beside the pole."""
    pairs = sorted(pairwise(tips), key=lambda ends: abs((ends[0] + ends[1]).real - 2.0 * pole.real))
    return max(pairs[1:] or pairs, key=lambda ends: abs((ends[1] - ends[0]).real))


def _extremes(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Carry the ends of the active part of both curves to the right of the diagram, where their values stand."""
    words, height = scene.words, scene.style.text
    right = field.at(field.x.high, 0.0).real
    shown = []
    for end, rho in ENDS.items():
        values = {name: scene.size(f"{name}_{end}") for name in CURVES.values()}
        seen = {name: value for name, value in values.items() if field.y.low <= value <= 1.0}
        tips = [field.at(scene.size(rho), value) for value in (*seen.values(), 0.0)]
        low, high = (pick(tips, key=lambda tip: tip.imag) for pick in (min, max))
        if high != low:
            canvas.add(Line(low, high, Pen.MAIN, role="end", name=end))
        for (name, value), at in zip(seen.items(), tips, strict=False):
            canvas.add(scene.node(at, f"{name}_{end}", "extreme", filled=True))
            shown.append((at, f"{words.symbol(f'{name}_{end}')} = {words.number(value, 2)}"))
    levels = _spread([at.imag for at, _ in shown], field.origin.imag, APART * height)
    for (at, text), level in zip(shown, levels, strict=True):
        corner, start = complex(right + 1.5, at.imag), complex(right + 1.5 + 0.8 * height, level)
        canvas.add(Line(at, corner, Pen.DASHED, role="projection"), Line(corner, start, Pen.THIN, role="leader"))
        canvas.add(Text(start + complex(0.4 * height, -0.5 * height), text, height, role="extreme"))


def _spread(levels: Sequence[float], axis: float, apart: float) -> list[float]:
    """Return levels of texts, in the order given, so far apart, and from the axis: moved away from this."""
    found = dict.fromkeys(range(len(levels)), 0.0)
    for side in (1.0, -1.0):
        last = axis
        for n in sorted(range(len(levels)), key=lambda n: side * levels[n]):
            if side * (levels[n] - axis) >= 0.0 and (side > 0.0 or levels[n] < axis):
                last = side * max(side * levels[n], side * last + apart)
                found[n] = last
    return list(found.values())


SLIDING_FIGURE = Figure(
    "sliding",
    _sliding_view,
    ("part",),
    stages(
        "axes", pole=("", "meshing.line_of_action"), velocities="", active_line=("", "meshing.active_line"), sliding=""
    ),
    "gear.sliding",
)
