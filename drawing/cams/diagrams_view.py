"""The three diagrams over one axis of angles: exact curves, and chords of graphical integration; the pressure angle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, groupby, pairwise

from ...plans.cams.construction import ACCELERATION, DIAGRAMS, TRAVEL, VELOCITY
from ...plans.cams.course import courses, diagram, permitted
from ...plans.cams.motion import PHASES, RISE
from ...plans.names import role
from ...scales.scale import Scale, steps
from ..areas import beside
from ..dimensions import AT_POLE, Axis, Field, Pole, axes, divisions, linear, mark_pole, numbers, small
from ..figure import Figure, Stage, stages
from ..page import extent
from ..printed import DEGREES
from ..shapes import Group, Line, Pen, Polyline, Text
from ..text import Box, lay_out
from ..view import Canvas, View
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
ONE, COLUMNS = 0.1, 3  # mm within which rays coincide, and columns of their numbers at most
APART_CHORDS = 0.2  # mm by which the greatest ordinate of chords has a dimension of its own
AROUND = 0.5  # mm between a number and the broken lines beside it
RUN = 3  # how many numbers in a row are written with a dash
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)  # of the line of a limit at which its text may stand
CLEAR = 0.8  # mm around that text
Number = tuple[str, float]  # of rays that end in almost one place, at their mean height, mm above the zero
WIDE = {5.0: 160.0, 3.5: 120.0}  # mm of the axis of angles beyond which it is half as long as on the diagrams
LAW = 120.0, 15.0  # mm of the axis of angles, and of each curve, where only their shape is told
TALL = {5.0: 60.0, 3.5: 45.0}  # mm of the axis of pressure angles, by the height of letters


def _diagrams_view(scene: CamScene) -> View:
    """Draw the diagrams under one another, the one that the law gives on top."""
    canvas, solved, given = DIAGRAMS_FIGURE.canvas(scene), scene.solved, scene.solved.layout.given
    fields: dict[str, Field] = {}
    level = 0.0
    for plan in (plan for plan in DIAGRAMS if f"{plan}.0" in solved.values):
        scale, curves = scene.scale(plan), diagram(solved, ORDER[plan], *solved.motion.phases)
        heights = [scale.drawn(y) for curve in curves for _, y in curve]
        heights += [0.0, *(scene.mm(f"{plan}.{i}").imag for i in _nodes(scene, plan))]
        low, high = min(heights), max(heights)
        level -= high + BETWEEN[scene.style.label] if fields else 0.0
        across = Axis(scene.symbol("phi"), scene.across, 0.0, float(solved.angles[-1]), {})
        up = Axis(scene.symbol(LETTER[plan]), scale, scale.measured(low), scale.measured(high), {})
        fields[plan] = Field(1j * level, across, up)
        level += low
    canvas.part("scales")
    boxes = [_scales(canvas, scene, plan, field) for plan, field in fields.items()]
    canvas.part("sections")
    _section_lines(canvas, scene, [*fields.values()], boxes)
    means = {plan: [(i, mean.imag) for i, mean in _means(scene, plan)] for plan in fields}
    away = _aside([*means.values()], scene.style.text)
    for plan, field in fields.items():
        canvas.part("axes")
        axes(canvas, field, False, PAST * scene.style.label)
        shown = role(plan).of
        canvas.part(f"law_{shown}" if plan == given else f"chords_{shown}")
        _exact(canvas, scene, plan, field)
        _board(canvas, scene, plan, field, away)
        canvas.part(f"law_{shown}" if plan == given else "scales")
        _amplitudes(canvas, scene, plan, field)
    canvas.part("sections")
    _phases(canvas, scene, field, 3.5 + scene.style.text)  # clear of the numbers
    heading = (scene.words["heading.cam_diagrams"], f"{scene.factor(scene.across)}  ({scene.axis})")
    return canvas.finish("diagrams", heading)


def law_view(scene: CamScene, part: float) -> View:
    """Draw what is given of the motion: the shapes of acceleration and travel without scales, the phases in degrees."""
    canvas, solved, end = Canvas(scene.style), scene.solved, float(scene.solved.angles[-1])
    wide, high = (part * size for size in LAW)
    across = Axis(scene.symbol("phi"), Scale("mu_phi", end / wide, "rad"), 0.0, end, {})
    level = 0.0
    for plan in (ACCELERATION, TRAVEL):
        pieces = diagram(solved, ORDER[plan], *solved.motion.phases[:3])
        low, top = (pick([0.0, *(y for piece in pieces for _, y in piece)]) for pick in (min, max))
        up = Axis(scene.symbol(LETTER[plan]), Scale("mu_s", (top - low) / high or 1.0, "m"), low, top, {})
        field = Field(1j * (level - high), across, up)
        axes(canvas, field, False, PAST * scene.style.label)
        _exact(canvas, scene, plan, field)
        level -= high - up.scale.drawn(low) + BETWEEN[scene.style.label]
    _phases(canvas, scene, field, 3.5)
    return canvas.finish("kinematic", (scene.words["heading.cam_law"],))


def _phases(canvas: Canvas, scene: CamScene, field: Field, below: float) -> None:
    """Dimension the phases in degrees, so many mm `below` the lowest diagram."""
    level = field.y.low - field.y.scale.measured(below)
    for phase in scene.solved.motion.phases[:3]:
        ends, name = (field.at(phase.start, level), field.at(phase.end, level)), f"phi_{phase.name}"
        linear(canvas, ends, -2j * scene.style.text, scene.angle(name, phase.length), name, chained=True)


def _nodes(scene: CamScene, plan: str) -> list[int]:
    """Return the section lines on which a diagram has nodes of chords."""
    return [i for i in scene.division.lines if f"{plan}.{i}" in scene.solved.values]


def _scales(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> Box:
    """Write the scale factors of a diagram beside the top of its axis; return the box that they fill.

    On top of all they stand above the numbers of the section lines.
    """
    texts = [scene.factor(scene.scale(plan))]
    if plan in RATES:
        symbol, unit = RATES[plan]
        texts.append(scene.factor(Scale(symbol, scene.mu(symbol), unit)))
    top = RAISED + 1.6 * scene.style.text * (plan == scene.solved.layout.given)
    at = field.at(0.0, field.y.high) + complex(0.8 * scene.style.label, top)
    text = Text(at, ";  ".join(texts), scene.style.text)
    canvas.add(text)
    return _around(text, 1.0)


def _around(text: Text, gap: float) -> Box:
    x0, y0, x1, y1 = extent((text,))
    return x0 - gap, y0 - gap, x1 + gap, y1 + gap


def _section_lines(canvas: Canvas, scene: CamScene, fields: Sequence[Field], boxes: Sequence[Box]) -> None:
    """Draw each section line through all diagrams, broken where a text stands, with its number below and above."""
    top, bottom, height, angles = fields[0], fields[-1], scene.style.text, scene.solved.angles.tolist()
    for i, phi in enumerate(angles):
        a, b = top.at(phi, top.y.high) + 1.5j, bottom.at(phi, bottom.y.low) - 1.5j
        canvas.group("section", str(i), *(Line(*part, Pen.THIN) for part in beside(a, b, boxes)))
    lines = [top.at(phi, 0.0).real for phi in angles]
    above, below = top.at(0.0, top.y.high).imag + 2.3, bottom.at(0.0, bottom.y.low).imag - 2.3 - height
    canvas.add(*numbers(lines, above, height)[1:], *numbers(lines, below, height))


def _exact(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> None:
    """Draw the exact curve; at a jump a line across, between its two ends."""
    exact = diagram(scene.solved, ORDER[plan], *scene.solved.motion.phases[:3])
    curves = [[field.at(*place) for place in curve] for curve in exact]
    canvas.group("curve", plan, *(Polyline(tuple(points), Pen.MAIN) for points in curves))
    jumps(canvas, [[field.at(0.0, 0.0)], *curves, [field.at(field.x.high, 0.0)]], plan)


def jumps(canvas: Canvas, pieces: Sequence[Sequence[complex]], name: str) -> None:
    """Draw the lines from the end of a piece of a curve to the beginning of the next, where they are apart."""
    steps = [(a[-1], b[0]) for a, b in pairwise(pieces) if abs(b[0] - a[-1]) > SAME]
    for k, (a, b) in enumerate(steps, start=1):
        canvas.group("jump", f"{name}.{k}", Line(a, b, Pen.MAIN))


def _board(canvas: Canvas, scene: CamScene, plan: str, field: Field, away: float) -> None:
    """Draw what the board has constructed: mean ordinates, the pole and its rays, chords and their nodes."""
    solved, words, origin, shown = scene.solved, scene.words, field.origin, role(plan).of
    nodes = [(i, origin + scene.mm(f"{plan}.{i}")) for i in _nodes(scene, plan)]
    if len(nodes) == len(solved.layout.division.lines) and plan != solved.layout.given:
        chords = tuple(Line(a, b, Pen.THIN, name=str(i)) for (_, a), (i, b) in pairwise(nodes))
        canvas.add(Group(chords, "chords", plan), *(scene.node(at, str(i)) for i, at in nodes))
    means = [(i, origin + mean) for i, mean in _means(scene, plan)]
    if means:
        curve, (name, letter) = canvas.part(f"rays_{shown}"), POLES[plan]
        text = f"{words.symbol(name)} = {words.short(round(scene.paper(name), 2))}"
        _fan(canvas, field, Pole(scene.paper(name), letter, name, text), means, away)
        canvas.part(curve if plan == solved.layout.given else f"means_{shown}")
        canvas.add(*(scene.node(mean, str(i), "mean") for i, mean in means))


def _means(scene: CamScene, plan: str) -> list[tuple[int, complex]]:
    """Return the mean ordinates of a diagram that is integrated, by section, mm from its origin."""
    sections = scene.division.sections if f"{plan}.O" in scene.solved.values else ()
    return [(i, scene.mm(f"{plan}.m{i}")) for i in sections]


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
        canvas.thin("extension", "", field.at(extreme.phi, extreme.value), peak)
        symbol = words.symbol("V_max" if name == "V_min" else name)
        linear(canvas, (foot, peak), 14.0, f"{symbol} = {words.short(round(abs(peak - foot), 2))}", name)
    drawn = [field.origin + scene.mm(f"{plan}.{i}") for i in _nodes(scene, plan)] if plan == TRAVEL else []
    top = max(drawn, key=lambda node: node.imag, default=field.origin)
    if drawn and abs(top.imag - peak.imag) > APART_CHORDS:  # of the chords, at the node where they are highest
        level = complex(peak.real, top.imag)
        canvas.thin("extension", "", top, level)
        text = f"{scene.symbol('S_max_chord')} = {words.short(round(abs(level - foot), 2))}"
        linear(canvas, (foot, level), 14.0 + 3.2 * scene.style.text, text, "S_max_chord")


def _grouped(ordinates: Iterable[tuple[int, float]], height: float) -> list[Number]:
    """Return the numbers of rays to these ordinates, mm, from below; those that coincide stand together.

    Of so many rays that their numbers take more columns than there may be, those nearest to one another do, too.
    """
    groups = sorted(([y], [i]) for i, y in ordinates)
    while True:
        means = [sum(ys) / len(ys) for ys, _ in groups]
        gaps = [b - a for a, b in pairwise(means)]
        if not gaps or (min(gaps) >= ONE and max(_columns(means, height)) < COLUMNS):
            return [(_joined(rays), mean) for (_, rays), mean in zip(groups, means, strict=True)]
        k = gaps.index(min(gaps))
        groups[k : k + 2] = [(groups[k][0] + groups[k + 1][0], groups[k][1] + groups[k + 1][1])]


def _columns(levels: Iterable[float], height: float) -> list[int]:
    """Return for rising levels of numbers the columns, side by side, in which none stands over another."""
    columns, lasts = list[int](), list[float]()
    for level in levels:
        column = next((k for k, last in enumerate(lasts) if level - last >= APART * height), len(lasts))
        lasts[column : column + 1] = [level]
        columns.append(column)
    return columns


def _joined(rays: Iterable[int]) -> str:
    """Return numbers as text: 2, 9-12, 25."""
    runs = [[i for _, i in run] for _, run in groupby(enumerate(sorted(rays)), lambda at: at[1] - at[0])]
    return ", ".join(f"{run[0]}–{run[-1]}" if len(run) >= RUN else ", ".join(map(str, run)) for run in runs)


def _shelved(rays: Sequence[Number], height: float) -> Number | None:
    """Return the number of several rays that run almost along the axis: it stands beyond the pole, on their shelf."""
    near = [ray for ray in rays if abs(ray[1]) < APART * height and not ray[0].isdigit()]
    return min(near, key=lambda ray: abs(ray[1]), default=None)


def _aside(ordinates: Sequence[Sequence[tuple[int, float]]], text: float) -> float:
    """Return how far to the left of the ordinates the rays of several diagrams end: there is room for all numbers."""
    height = small(text)
    every = (_grouped(diagram, height) for diagram in ordinates)
    beside = ([ray for ray in rays if ray is not _shelved(rays, height)] for rays in every)
    wide = (sum(_widths(rays, height)) for rays in beside)
    return max(wide, default=0.0) + 2.0 * AROUND + 1.0


def _widths(rays: Sequence[Number], height: float) -> list[float]:
    """Return how wide the columns of numbers are, with the room on both sides of them."""
    widths = dict[int, float]()
    for column, (text, _) in zip(_columns((level for _, level in rays), height), rays, strict=True):
        widths[column] = max(widths.get(column, 0.0), lay_out(text, height).width + 2.0 * AROUND)
    return [widths[column] for column in sorted(widths)]


def _fan(canvas: Canvas, field: Field, pole: Pole, means: Sequence[tuple[int, complex]], away: float) -> None:
    """Draw projections of mean ordinates to a line `away` mm to the left, and rays from the pole to their feet.

    The `means` are numbers of sections with the places of their ordinates; those of one height have one ray. The pole,
    and the line from which its distance counts, are there with the axes, before any ray.
    """
    height, zero = small(canvas.style.text), field.origin - away
    at = zero - pole.reach
    rays = _grouped(((i, (mean - field.origin).imag) for i, mean in means), height)
    beyond = _shelved(rays, height)
    boxes = list(_written(canvas, [ray for ray in rays if ray is not beyond], field.origin - 0.5 * away, height))
    cuts: dict[float, list[tuple[int, complex]]] = {}
    for i, mean in means:
        cuts.setdefault(round(mean.imag, 4), []).append((i, mean))
    feet = [complex(zero.real, cut) for cut in sorted(cuts)]
    for foot, (_, equal) in zip(feet, sorted(cuts.items()), strict=True):
        canvas.thin("ray", " ".join(str(i) for i, _ in equal), at, foot)
        nearest = min((mean for _, mean in equal), key=lambda mean: mean.real)
        level = complex(foot.real, nearest.imag)
        canvas.add(*(Line(*part, Pen.DASHED, role="projection") for part in beside(nearest, level, boxes)))
    stage = canvas.part("axes")
    lowest, highest = (end(foot, zero, key=lambda place: place.imag) for end, foot in ((min, feet[0]), (max, feet[-1])))
    if len(feet) > 1:
        canvas.thin("feet", "", lowest, highest)
    wide = lay_out(beyond[0], height).width + AROUND if beyond else 0.0
    axis = beside(field.origin, at - max(AT_POLE, wide), boxes)
    canvas.add(*(Line(*part, Pen.THIN, role="axis") for part in axis))
    if beyond:
        canvas.part(stage, Text(at - wide - 1j * (height + 2.0 * AROUND), beyond[0], height, role="number"))
        canvas.part("axes")
    mark_pole(canvas, pole, at, lowest, 5.0)


def _written(canvas: Canvas, rays: Sequence[Number], middle: complex, height: float) -> Iterator[Box]:
    """Write numbers in columns about the middle of the strip, go through the boxes that they fill."""
    widths = _widths(rays, height)
    starts = [*accumulate(widths, initial=-0.5 * sum(widths))]
    for column, (text, level) in zip(_columns((level for _, level in rays), height), rays, strict=True):
        at = middle + complex(starts[column] + 0.5 * widths[column], level - 0.5 * height)
        half = 0.5 * lay_out(text, height).width + AROUND
        canvas.add(Text(at, text, height, "middle", role="number"))
        yield at.real - half, at.imag - AROUND, at.real + half, at.imag + height + AROUND


DIAGRAMS_FIGURE = Figure(
    "diagrams",
    _diagrams_view,
    ("reduction",),
    (
        *stages(axes="diagram_s.#", sections="diagram_s.f#", law_a="diagram_a.m#"),
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


def _pressure_view(scene: CamScene) -> View:
    """Draw theta over phi with the limits dashed over their phases."""
    solved, words, height = scene.solved, scene.words, scene.style.text
    canvas, limits = PRESSURE_FIGURE.canvas(scene), permitted(solved)
    curves = courses(solved)
    every = [y for points in curves for _, y in points] + [limit for _, limit in limits] + [0.0]
    field = _pressure_field(scene, min(every), max(every))
    canvas.part("axes")
    axes(canvas, field, lettered=False)
    canvas.part("curve")
    points = [tuple(field.at(*place) for place in curve) for curve in curves]
    canvas.group("curve", "theta", *map(Polyline, points))
    canvas.part("limits")
    places = [place for curve in points for place in curve]
    boxes = [box for name, limit in limits if (box := _pressure_limit(canvas, scene, field, places, name, limit))]
    canvas.part("curve")  # the section lines with their numbers, broken where a text stands; the curve marked on them
    angles, values = solved.angles.tolist(), scene.rolling.profile.pressure(solved.angles).tolist()
    lines = [field.at(phi, 0.0).real for phi in angles]
    canvas.add(*numbers(lines, field.at(0.0, field.y.low).imag - 2.3 - height, height))
    for i, (phi, value) in enumerate(zip(angles, values, strict=True)):
        for a, b in beside(field.at(phi, field.y.high), field.at(phi, field.y.low) - 1.5j, boxes):
            canvas.thin("section", str(i), a, b)
        canvas.add(scene.node(field.at(phi, value), str(i)))
    per_mm = f"{words.symbol('mu_theta')} = {scene.degrees(field.y.scale.mu)}/{words.unit('mm')}"
    heading = words["heading.cam_pressure"], f"{per_mm};  {scene.factor(field.x.scale)}"
    return canvas.finish("pressure", heading)


def _pressure_field(scene: CamScene, low: float, high: float) -> Field:
    words, label, last = scene.words, scene.style.label, float(scene.solved.angles[-1])
    mu = steps((high - low) * DEGREES / TALL[label])[0] / DEGREES
    half = scene.across.drawn(last) > WIDE[label]
    across = Axis(
        words.symbol("phi"), Scale("mu_phi", scene.across.measured(2.0 if half else 1.0), "rad"), 0.0, last, {}
    )
    marks = {x / DEGREES: f"{words.short(x)}°" for x in divisions(high * DEGREES, low * DEGREES, mu * DEGREES, 9.0)}
    return Field(0j, across, Axis(words.symbol("theta"), Scale("mu_theta", mu, "rad"), low, high, marks))


def _pressure_limit(
    canvas: Canvas, scene: CamScene, field: Field, places: Sequence[complex], name: str, limit: float
) -> Box | None:
    """Draw a limit over its phase, and write it on the line; return the box of what stands among section lines."""
    phase, height = scene.solved.motion.phase(name), scene.style.text
    ends = field.at(phase.start, limit), field.at(phase.end, limit)
    canvas.group("limit", f"{name}{'' if limit > 0 else '-'}", Line(*ends, Pen.DASHED))
    markup = f"[{scene.symbol('theta')}] = {scene.degrees(abs(limit))}"
    for share in SHARES if limit < field.y.high else ():  # section lines run through, or their numbers stand below
        text = Text(ends[0] + share * (ends[1] - ends[0]) + 0.5j * height, markup, height, "middle", role="label")
        box = x0, y0, x1, y1 = _around(text, CLEAR)
        if not any(x0 < p.real < x1 and y0 < p.imag < y1 for p in places):
            canvas.add(text)
            return box
    canvas.small(markup, ends, complex(0.0, limit))
    return None


PRESSURE_FIGURE = Figure(
    "pressure",
    _pressure_view,
    ("reduction",),
    stages("axes", curve=("", "sizes.centre", "rocker_sizes.centre"), limits=""),
    "cam.pressure",
)
