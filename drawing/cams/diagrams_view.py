"""The three diagrams over one axis of angles: exact curves, and chords of graphical integration; the pressure angle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ...plans.cams.construction import ACCELERATION, DIAGRAMS, TRAVEL, VELOCITY
from ...plans.cams.course import courses, diagram, permitted, theta
from ...plans.cams.motion import PHASES, RISE
from ...plans.names import role
from ...scales.scale import Scale, steps
from ..areas import beside
from ..diagram import AT_POLE, Axis, Field, Pole, axes, divisions, mark_pole, numbers, small
from ..figure import Figure, Stage, stages
from ..page import extent
from ..printed import DEGREES
from ..shapes import Group, Line, Pen, Polyline, Text
from ..text import Box, lay_out
from ..view import Canvas, View, linear
from .scene import CamScene

ORDER = {TRAVEL: 0, VELOCITY: 1, ACCELERATION: 2}  # of the derivative that a diagram shows
LETTER = {TRAVEL: "s", VELOCITY: "ds", ACCELERATION: "d2s"}
POLES = {ACCELERATION: ("H_a", "O_{a}"), VELOCITY: ("H_v", "O_{v}")}
RATES = {VELOCITY: ("mu_v", "m/s"), ACCELERATION: ("mu_a", "m/s^2")}  # scale factors of v and a
BETWEEN = {5.0: 26.0, 3.5: 10.2}  # mm between diagrams, by the height of letters
PAST = 1.6  # heights of letters by which axes run past their curves
RAISED = 3.3  # mm between the numbers of section lines and what is below or above them
SAME = 1e-6  # mm, of ends of a jump
APART = 1.2  # heights of letters between the numbers of rays under one another
AROUND = 0.5  # mm between a number and the broken lines beside it
RUN = 3  # how many numbers in a row are written with a dash
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)  # of the line of a limit at which its text may stand
CLEAR = 0.8  # mm around that text
Place = tuple[float, float]
WIDE = {5.0: 160.0, 3.5: 120.0}  # mm of the axis of angles beyond which it is half as long as on the diagrams
TALL = {5.0: 60.0, 3.5: 45.0}  # mm of the axis of pressure angles, by the height of letters


def diagrams_view(scene: CamScene) -> View:
    """Draw the diagrams under one another, the one that the law gives on top."""
    canvas, solved = DIAGRAMS_FIGURE.canvas(scene), scene.solved
    drawn = [plan for plan in DIAGRAMS if f"{plan}.0" in solved.values]
    fields: list[Field] = []
    low = 0.0
    for plan in drawn:
        least, most = _ends(scene, plan)
        if fields:
            low -= most + BETWEEN[scene.style.label]
        fields.append(_field(scene, plan, (least, most), 1j * low))
        low += least
    canvas.part("scales")
    boxes = [_scales(canvas, scene, plan, field) for plan, field in zip(drawn, fields, strict=True)]
    canvas.part("sections")
    _section_lines(canvas, scene, fields, boxes)
    away = aside([[(i, mean.imag) for i, mean in _means(scene, plan)] for plan in drawn], scene.style.text)
    for plan, field in zip(drawn, fields, strict=True):
        canvas.part("axes")
        axes(canvas, field, False, PAST * scene.style.label)
        given, shown = plan == solved.layout.given, role(plan).of
        canvas.part(f"law_{shown}" if given else f"chords_{shown}")
        _exact(canvas, scene, plan, field)
        _board(canvas, scene, plan, field, away)
        canvas.part(f"law_{shown}" if given else "scales")
        _amplitudes(canvas, scene, plan, field)
    canvas.part("sections")
    _phases(canvas, scene, fields[-1])
    per_mm = scene.words["said.cam_axis"].format(angle=scene.degrees(scene.across.mu))
    heading = (scene.words["heading.cam_diagrams"], f"{scene.factor(scene.across)}  ({per_mm})")
    return canvas.finish("diagrams", heading)


def _ends(scene: CamScene, plan: str) -> tuple[float, float]:
    """Return the least and the greatest ordinate of a diagram, mm, those of the chords among them."""
    curves = diagram(scene.solved, ORDER[plan], scene.solved.motion.phases)
    exact = [scene.scale(plan).drawn(y) for curve in curves for _, y in curve]
    marks = [scene.mm(f"{plan}.{i}").imag for i in _nodes(scene, plan)]
    return min(0.0, *exact, *marks), max(0.0, *exact, *marks)


def _nodes(scene: CamScene, plan: str) -> list[int]:
    """Return the section lines on which a diagram has nodes of chords."""
    return [i for i in scene.solved.layout.division.lines if f"{plan}.{i}" in scene.solved.values]


def _field(scene: CamScene, plan: str, ends: tuple[float, float], origin: complex) -> Field:
    scale, words = scene.scale(plan), scene.words
    low, high = ends
    across = Axis(words.symbol("phi"), scene.across, 0.0, float(scene.solved.angles[-1]), {})
    return Field(origin, across, Axis(words.symbol(LETTER[plan]), scale, scale.measured(low), scale.measured(high), {}))


def _scales(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> Box:
    """Write the scale factors of a diagram beside the top of its axis; return the box that they fill.

    On top of all they stand above the numbers of the section lines.
    """
    texts = [scene.factor(scene.scale(plan))]
    if plan in RATES:
        texts.append(scene.factors(RATES[plan][0], unit=RATES[plan][1]))
    top = RAISED + 1.6 * scene.style.text * (plan == scene.solved.layout.given)
    at = field.at(0.0, field.y.high) + complex(0.8 * scene.style.label, top)
    text = Text(at, ";  ".join(texts), scene.style.text)
    canvas.add(text)
    x0, y0, x1, y1 = extent((text,))
    return x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0


def _section_lines(canvas: Canvas, scene: CamScene, fields: Sequence[Field], boxes: Sequence[Box]) -> None:
    """Draw each section line through all diagrams, broken where a text stands, with its number below and above."""
    top, bottom, height = fields[0], fields[-1], scene.style.text
    for i, phi in enumerate(scene.solved.angles.tolist()):
        a, b = top.at(phi, top.y.high) + 1.5j, bottom.at(phi, bottom.y.low) - 1.5j
        canvas.add(Group(tuple(Line(*part, Pen.THIN) for part in beside(a, b, boxes)), "section", str(i)))
    lines = [top.at(phi, 0.0).real for phi in scene.solved.angles.tolist()]
    above, below = top.at(0.0, top.y.high).imag + 2.3, bottom.at(0.0, bottom.y.low).imag - 2.3 - height
    canvas.add(*numbers(lines, above, height)[1:], *numbers(lines, below, height))


def _exact(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> None:
    """Draw the exact curve; at a jump a line across, between its two ends."""
    exact = diagram(scene.solved, ORDER[plan], scene.solved.motion.phases[:3])
    curves = [[field.at(*place) for place in curve] for curve in exact]
    ends = [[field.at(0.0, 0.0)], *curves, [field.at(field.x.high, 0.0)]]
    canvas.add(Group(tuple(Polyline(tuple(points), Pen.MAIN) for points in curves), "curve", plan))
    jumps(canvas, ends, plan)


def jumps(canvas: Canvas, pieces: Sequence[Sequence[complex]], name: str) -> None:
    """Draw the lines from the end of a piece of a curve to the beginning of the next, where they are apart."""
    steps = [(a[-1], b[0]) for a, b in pairwise(pieces) if abs(b[0] - a[-1]) > SAME]
    for k, (a, b) in enumerate(steps, start=1):
        canvas.add(Group((Line(a, b, Pen.MAIN),), "jump", f"{name}.{k}"))


def _board(canvas: Canvas, scene: CamScene, plan: str, field: Field, away: float) -> None:
    """Draw what the board has constructed: mean ordinates, the pole and its rays, chords and their nodes."""
    solved, words, origin = scene.solved, scene.words, field.origin
    nodes = [(i, origin + scene.mm(f"{plan}.{i}")) for i in _nodes(scene, plan)]
    if len(nodes) == len(solved.layout.division.sections) + 1 and plan != solved.layout.given:
        chords = tuple(Line(a, b, Pen.THIN, name=str(i)) for (_, a), (i, b) in pairwise(nodes))
        canvas.add(Group(chords, "chords", plan))
        canvas.add(*(scene.node(at, str(i)) for i, at in nodes))
    means = [(i, origin + mean) for i, mean in _means(scene, plan)]
    if means:
        curve = canvas.part(f"rays_{role(plan).of}")
        name, letter = POLES[plan]
        text = f"{words.symbol(name)} = {words.short(round(scene.paper(name), 2))}"
        fan(canvas, field, Pole(scene.paper(name), letter, name, text), means, away)
        canvas.part(curve if plan == solved.layout.given else f"means_{role(plan).of}")
        canvas.add(*(scene.node(mean, str(i), "mean") for i, mean in means))


def _means(scene: CamScene, plan: str) -> list[tuple[int, complex]]:
    """Return the mean ordinates of a diagram that is integrated, by section, mm from its origin."""
    if f"{plan}.O" not in scene.solved.values:
        return []
    return [(i, scene.mm(f"{plan}.m{i}")) for i in scene.solved.layout.division.sections]


def _amplitudes(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> None:
    """Dimension the greatest ordinates in mm, to the right of the diagram."""
    last, words, motion = field.x.high, scene.words, scene.solved.motion
    s, ds, d2s = (float(order == ORDER[plan]) for order in range(3))
    phases = (RISE,) if plan == ACCELERATION else PHASES
    up, down = motion.maximum(s, ds, d2s, phases), motion.minimum(s, ds, d2s, phases)
    names = {TRAVEL: ("S_max", ""), VELOCITY: ("V_max", "V_min"), ACCELERATION: ("l_A1", "l_A2")}[plan]
    for name, extreme in zip(names, (up, down), strict=True):
        if not name or abs(extreme.value) < SAME * field.y.scale.mu:
            continue
        peak, foot = field.at(last, extreme.value), field.at(last, 0.0)
        canvas.add(Line(field.at(extreme.phi, extreme.value), peak, Pen.THIN, role="extension"))
        symbol = words.symbol("V_max" if name == "V_min" else name)
        linear(canvas, (foot, peak), 14.0, f"{symbol} = {words.short(round(abs(peak - foot), 2))}", name)


def _phases(canvas: Canvas, scene: CamScene, field: Field) -> None:
    """Dimension the phases in degrees under the lowest diagram."""
    for phase in scene.solved.motion.phases[:3]:
        below = field.y.low - field.y.scale.measured(3.5 + scene.style.text)  # clear of the numbers
        ends, name = (field.at(phase.start, below), field.at(phase.end, below)), f"phi_{phase.name}"
        linear(canvas, ends, -1j * (2.0 * scene.style.text), scene.angle(name, phase.length), name)


@dataclass(frozen=True, slots=True)
class Number:
    """The numbers of rays that end in almost one place, at their mean height, mm above the zero of the ordinates."""

    text: str
    level: float


def grouped(ordinates: Iterable[tuple[int, float]], height: float) -> list[Number]:
    """Return the numbers of rays to these ordinates, mm, from below; those too near to one another stand together."""
    groups = sorted(([y], [i]) for i, y in ordinates)
    while True:
        means = [sum(ys) / len(ys) for ys, _ in groups]
        gaps = [b - a for a, b in pairwise(means)]
        if not gaps or min(gaps) >= APART * height:
            return [Number(_joined(found), mean) for (_, found), mean in zip(groups, means, strict=True)]
        k = gaps.index(min(gaps))
        groups[k : k + 2] = [(groups[k][0] + groups[k + 1][0], groups[k][1] + groups[k + 1][1])]


def _joined(found: Sequence[int]) -> str:
    """Return numbers as text: 2, 9-12, 25."""
    every, runs = sorted(found), list[list[int]]()
    for i in every:
        if runs and i == runs[-1][-1] + 1:
            runs[-1].append(i)
        else:
            runs.append([i])
    parts = (f"{run[0]}–{run[-1]}" if len(run) >= RUN else ", ".join(map(str, run)) for run in runs)
    return ", ".join(parts)


def shelved(found: Sequence[Number], height: float) -> Number | None:
    """Return the number of several rays that run almost along the axis: it stands beyond the pole, on their shelf."""
    near = [n for n in found if abs(n.level) < APART * height and not n.text.isdigit()]
    return min(near, key=lambda n: abs(n.level), default=None)


def aside(ordinates: Sequence[Sequence[tuple[int, float]]], text: float) -> float:
    """Return how far to the left of the ordinates the rays of several diagrams end: there is room for all numbers."""
    height = small(text)
    every = (grouped(found, height) for found in ordinates)
    wide = (lay_out(n.text, height).width for found in every for n in found if n is not shelved(found, height))
    return max(wide, default=0.0) + 4.0 * AROUND + 1.0


def fan(canvas: Canvas, field: Field, pole: Pole, means: Sequence[tuple[int, complex]], away: float) -> None:
    """Draw projections of mean ordinates to a line `away` mm to the left, and rays from the pole to their feet.

    The `means` are numbers of sections with the places of their ordinates; those of one height have one ray. The pole,
    and the line from which its distance counts, are there with the axes, before any ray.
    """
    style, zero = canvas.style, field.origin - away
    height = small(style.text)
    at = zero - pole.reach
    ordinates = [(i, (mean - field.origin).imag) for i, mean in means]
    found = grouped(ordinates, height)
    beyond = shelved(found, height)
    boxes = list(_written(canvas, [n for n in found if n is not beyond], field.origin - 0.5 * away, height))
    cuts: dict[float, list[tuple[int, complex]]] = {}
    for i, mean in means:
        cuts.setdefault(round(mean.imag, 4), []).append((i, mean))
    feet = [complex(zero.real, cut) for cut in sorted(cuts)]
    for foot, (_, equal) in zip(feet, sorted(cuts.items()), strict=True):
        canvas.add(Line(at, foot, Pen.THIN, role="ray", name=" ".join(str(i) for i, _ in equal)))
        nearest = min((mean for _, mean in equal), key=lambda mean: mean.real)
        level = complex(foot.real, nearest.imag)
        canvas.add(*(Line(*part, Pen.DASHED, role="projection") for part in beside(nearest, level, boxes)))
    rays = canvas.part("axes")
    lowest, highest = (end(foot, zero, key=lambda place: place.imag) for end, foot in ((min, feet[0]), (max, feet[-1])))
    if len(feet) > 1:
        canvas.add(Line(lowest, highest, Pen.THIN, role="feet"))
    wide = lay_out(beyond.text, height).width + AROUND if beyond else 0.0
    axis = beside(field.origin, at - max(AT_POLE, wide), boxes)
    canvas.add(*(Line(*part, Pen.THIN, role="axis") for part in axis))
    if beyond:
        canvas.part(rays)
        canvas.add(Text(at - wide - 1j * (height + 2.0 * AROUND), beyond.text, height, role="number"))
        canvas.part("axes")
    mark_pole(canvas, pole, at, lowest, 5.0)


def _written(canvas: Canvas, found: Sequence[Number], middle: complex, height: float) -> Iterator[Box]:
    """Write numbers in the middle of the strip, go through the boxes that they fill."""
    for number in found:
        at = middle + 1j * (number.level - 0.5 * height)
        half = 0.5 * lay_out(number.text, height).width + AROUND
        canvas.add(Text(at, number.text, height, "middle", role="number"))
        yield at.real - half, at.imag - AROUND, at.real + half, at.imag + height + AROUND


DIAGRAMS_FIGURE = Figure(
    "diagrams",
    diagrams_view,
    ("reduction",),
    (
        Stage("axes", "diagram_s.#"),
        Stage("sections", "diagram_s.f#"),
        Stage("law_a", "diagram_a.m#"),
        Stage("law_v", "diagram_v.m#", "place"),
        Stage("rays_a", "diagram_a.p#"),
        Stage("chords_v", "diagram_v.#", "meet"),
        Stage("means_v", "diagram_v.m#", "divide"),
        Stage("rays_v", "diagram_v.p#"),
        Stage("chords_s", "diagram_s.#", "meet"),
        Stage("scales"),
    ),
    "cam.diagrams",
)


def pressure_view(scene: CamScene) -> View:
    """Draw theta over phi with the limits dashed over their phases."""
    solved, words = scene.solved, scene.words
    canvas, limits = PRESSURE_FIGURE.canvas(scene), permitted(solved)
    curves = courses(solved)
    every = [y for points in curves for _, y in points] + [limit for _, limit in limits] + [0.0]
    field = _pressure_field(scene, min(every), max(every))
    canvas.part("axes")
    axes(canvas, field, lettered=False)
    canvas.part("curve")
    canvas.add(Group(tuple(Polyline(tuple(field.at(*p) for p in points)) for points in curves), "curve", "theta"))
    canvas.part("limits")
    boxes = [_pressure_limit(canvas, scene, field, curves, at) for at in limits]
    canvas.part("curve")
    _pressure_sections(canvas, scene, field, [found for found in boxes if found is not None])
    per_mm = f"{words.symbol('mu_theta')} = {scene.degrees(field.y.scale.mu)}/{words.unit('mm')}"
    heading = words["heading.cam_pressure"], f"{per_mm};  {scene.factor(field.x.scale)}"
    return canvas.finish("pressure", heading)


def _pressure_field(scene: CamScene, low: float, high: float) -> Field:
    words = scene.words
    tall = TALL[scene.style.label]
    mu = steps((high - low) * DEGREES / tall)[0] / DEGREES
    last = float(scene.solved.angles[-1])
    half = scene.across.drawn(last) > WIDE[scene.style.label]
    scale = Scale("mu_phi", scene.across.measured(2.0 if half else 1.0), "rad")
    across = Axis(words.symbol("phi"), scale, 0.0, last, {})
    marks = {x / DEGREES: f"{words.short(x)}°" for x in divisions(high * DEGREES, low * DEGREES, mu * DEGREES, 9.0)}
    return Field(0j, across, Axis(words.symbol("theta"), Scale("mu_theta", mu, "rad"), low, high, marks))


def _pressure_limit(
    canvas: Canvas, scene: CamScene, field: Field, curves: Sequence[Sequence[Place]], at: tuple[str, float]
) -> Box | None:
    """Draw a limit over its phase, and write it on the line; return the box of what stands among section lines."""
    name, limit = at
    phase, height = scene.solved.motion.phase(name), scene.style.text
    ends = field.at(phase.start, limit), field.at(phase.end, limit)
    canvas.add(Group((Line(*ends, Pen.DASHED),), "limit", f"{name}{'' if limit > 0 else '-'}"))
    markup = f"[{scene.words.symbol('theta')}] = {scene.degrees(abs(limit))}"
    points = [field.at(*p) for course in curves for p in course]
    for share in SHARES if limit < field.y.high else ():  # section lines run through, or their numbers stand below
        text = Text(ends[0] + share * (ends[1] - ends[0]) + 0.5j * height, markup, height, "middle", role="label")
        x0, y0, x1, y1 = (side + CLEAR * way for side, way in zip(extent((text,)), (-1, -1, 1, 1), strict=True))
        if not any(x0 < p.real < x1 and y0 < p.imag < y1 for p in points):
            canvas.add(text)
            return x0, y0, x1, y1
    canvas.label(markup, ends, prefer=complex(0.0, limit), clear=0.8, height=height)
    return None


def _pressure_sections(canvas: Canvas, scene: CamScene, field: Field, boxes: Sequence[Box]) -> None:
    """Draw the section lines with their numbers, broken where a text stands, and mark the curve on them."""
    solved, height = scene.solved, scene.style.text
    values = theta(solved, solved.angles)
    lines = [field.at(phi, 0.0).real for phi in solved.angles.tolist()]
    canvas.add(*numbers(lines, field.at(0.0, field.y.low).imag - 2.3 - height, height))
    for i, (phi, value) in enumerate(zip(solved.angles.tolist(), values.tolist(), strict=True)):
        foot = field.at(phi, field.y.low) - 1.5j
        for a, b in beside(field.at(phi, field.y.high), foot, boxes):
            canvas.add(Line(a, b, Pen.THIN, role="section", name=str(i)))
        canvas.add(scene.node(field.at(phi, value), str(i)))


PRESSURE_FIGURE = Figure("pressure", pressure_view, ("reduction",), stages("axes", "curve", "limits"), "cam.pressure")
