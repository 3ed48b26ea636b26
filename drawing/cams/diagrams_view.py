"""The three diagrams over one axis of angles: exact curves, and chords of graphical integration with their poles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from ...plans.cams.integration import ACCELERATION, DIAGRAMS, TRAVEL, VELOCITY
from ...plans.cams.motion import PHASES, RISE
from ...plans.names import role
from ..diagram import Axis, Field, Pole, axes, numbers
from ..dimensions import linear
from ..figure import Figure, Stage
from ..shapes import Circle, Group, Line, Pen, Polyline, Text
from ..text import Box, box
from ..view import Canvas, View
from .fan import aside, fan
from .scene import COARSE, CamScene, pieces

ORDER = {TRAVEL: 0, VELOCITY: 1, ACCELERATION: 2}  # of the derivative that a diagram shows
LETTER = {TRAVEL: "s", VELOCITY: "ds", ACCELERATION: "d2s"}
POLES = {ACCELERATION: ("H_a", "O_{a}"), VELOCITY: ("H_v", "O_{v}")}
RATES = {VELOCITY: ("mu_v", "m/s"), ACCELERATION: ("mu_a", "m/s^2")}  # scale factors of v and a
BETWEEN = {5.0: 26.0, 3.5: 10.2}  # mm between diagrams, by the height of letters
PAST = 1.6  # heights of letters by which axes run past their curves
RAISED = 3.3  # mm between the numbers of section lines and what is below or above them
SAME = 1e-6  # mm, of ends of a jump


def diagrams_view(scene: CamScene) -> View:
    """Draw the diagrams under one another, the one that the law gives on top."""
    canvas, solved = DIAGRAMS_FIGURE.canvas(scene, COARSE), scene.solved
    drawn = [plan for plan in DIAGRAMS if f"{plan}.0" in solved.values]
    fields: list[Field] = []
    low = 0.0
    for plan in drawn:
        most = _ends(scene, plan)[1]
        if fields:
            low -= most + BETWEEN[scene.style.label]
        fields.append(_field(scene, plan, 1j * low))
        low += _ends(scene, plan)[0]
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
    mu = scene.scale(plan).mu
    values = [v for phase in scene.solved.motion.phases for part in pieces(scene.solved, phase) for v in part[1:]]
    exact = np.concatenate(values[ORDER[plan] :: 3]) / mu
    marks = [scene.mm(f"{plan}.{i}").imag for i in _nodes(scene, plan)]
    return min(0.0, float(exact.min()), *marks), max(0.0, float(exact.max()), *marks)


def _nodes(scene: CamScene, plan: str) -> list[int]:
    """Return the section lines on which a diagram has nodes of chords."""
    return [i for i in scene.solved.layout.division.lines if f"{plan}.{i}" in scene.solved.values]


def _field(scene: CamScene, plan: str, origin: complex) -> Field:
    scale, words = scene.scale(plan), scene.words
    low, high = _ends(scene, plan)
    across = Axis(words.symbol("phi"), scene.across, 0.0, float(scene.solved.angles[-1]), {})
    return Field(origin, across, Axis(words.symbol(LETTER[plan]), scale, low * scale.mu, high * scale.mu, {}))


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
    x0, y0, x1, y1 = box(text)
    return x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0


def _section_lines(canvas: Canvas, scene: CamScene, fields: Sequence[Field], boxes: Sequence[Box]) -> None:
    """Draw each section line through all diagrams, broken where a text stands, with its number below and above."""
    top, bottom, height = fields[0], fields[-1], scene.style.text
    for i, phi in enumerate(scene.solved.angles.tolist()):
        a, b = top.at(phi, top.y.high) + 1.5j, bottom.at(phi, bottom.y.low) - 1.5j
        canvas.add(Group(tuple(Line(*part, Pen.THIN) for part in broken(a, b, boxes)), "section", str(i)))
    lines = [top.at(phi, 0.0).real for phi in scene.solved.angles.tolist()]
    above, below = top.at(0.0, top.y.high).imag + 2.3, bottom.at(0.0, bottom.y.low).imag - 2.3 - height
    canvas.add(*numbers(lines, above, height)[1:], *numbers(lines, below, height))


def broken(a: complex, b: complex, boxes: Sequence[Box]) -> Iterator[tuple[complex, complex]]:
    """Go through the pieces of an upright line, from its upper end, that lie beside the boxes."""
    through = (box for box in boxes if box[0] < a.real < box[2] and b.imag < box[3] and box[1] < a.imag)
    gaps = [(min(y1, a.imag), max(y0, b.imag)) for _, y0, _, y1 in through]
    ends = [a.imag, *(y for gap in sorted(gaps, reverse=True) for y in gap), b.imag]
    for start, end in zip(ends[::2], ends[1::2], strict=True):
        if start > end:
            yield complex(a.real, start), complex(a.real, end)


def _exact(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> None:
    """Draw the exact curve; at a jump a line across, between its two ends."""
    curves: list[list[complex]] = []
    for phase in scene.solved.motion.phases[:3]:
        for part in pieces(scene.solved, phase):
            values = part[1 + ORDER[plan]]
            curves.append([field.at(x, y) for x, y in zip(part[0].tolist(), values.tolist(), strict=True)])
    ends = [[field.at(0.0, 0.0)], *curves, [field.at(field.x.high, 0.0)]]
    steps = [(a[-1], b[0]) for a, b in pairwise(ends) if abs(b[0] - a[-1]) > SAME]
    canvas.add(Group(tuple(Polyline(tuple(points), Pen.MAIN) for points in curves), "curve", plan))
    for k, (a, b) in enumerate(steps, start=1):
        canvas.add(Group((Line(a, b, Pen.MAIN),), "jump", f"{plan}.{k}"))


def _board(canvas: Canvas, scene: CamScene, plan: str, field: Field, away: float) -> None:
    """Draw what the board has constructed: mean ordinates, the pole and its rays, chords and their nodes."""
    solved, words, origin = scene.solved, scene.words, field.origin
    nodes = [(i, origin + scene.mm(f"{plan}.{i}")) for i in _nodes(scene, plan)]
    if len(nodes) == len(solved.layout.division.sections) + 1 and plan != solved.layout.given:
        chords = tuple(Line(a, b, Pen.THIN, name=str(i)) for (_, a), (i, b) in pairwise(nodes))
        canvas.add(Group(chords, "chords", plan))
        canvas.add(*(_mark(scene, at, "node", str(i)) for i, at in nodes))
    means = [(i, origin + mean) for i, mean in _means(scene, plan)]
    if means:
        curve = canvas.part(f"rays_{role(plan).of}")
        name, letter = POLES[plan]
        text = f"{words.symbol(name)} = {words.short(round(scene.paper(name), 2))}"
        fan(canvas, field, Pole(scene.paper(name), letter, name, text), means, away)
        canvas.part(curve if plan == solved.layout.given else f"means_{role(plan).of}")
        canvas.add(*(_mark(scene, mean, "mean", str(i)) for i, mean in means))


def _means(scene: CamScene, plan: str) -> list[tuple[int, complex]]:
    """Return the mean ordinates of a diagram that is integrated, by section, mm from its origin."""
    if f"{plan}.O" not in scene.solved.values:
        return []
    return [(i, scene.mm(f"{plan}.m{i}")) for i in scene.solved.layout.division.sections]


def _mark(scene: CamScene, at: complex, role: str, name: str) -> Group:
    return Group((Circle(at, scene.style.node, Pen.THIN, fill="white"),), role, name)


def _amplitudes(canvas: Canvas, scene: CamScene, plan: str, field: Field) -> None:
    """Dimension the greatest ordinates in mm, to the right of the diagram."""
    last, words = field.x.high, scene.words
    motion = scene.solved.motion
    s, ds, d2s = (float(order == ORDER[plan]) for order in range(3))
    phases = (RISE,) if plan == ACCELERATION else PHASES
    up, down = motion.maximum(s, ds, d2s, phases), motion.minimum(s, ds, d2s, phases)
    names = {TRAVEL: ("S_max", ""), VELOCITY: ("V_max", "V_min"), ACCELERATION: ("l_A1", "l_A2")}[plan]
    for name, extreme in zip(names, (up, down), strict=True):
        if not name or abs(extreme.value) < SAME * field.y.scale.mu:
            continue
        peak, foot = field.at(last, extreme.value), field.at(last, 0.0)
        place = field.at(extreme.phi, extreme.value)
        canvas.add(Line(place, peak, Pen.THIN, role="extension"))
        symbol = words.symbol("V_max" if name == "V_min" else name)
        linear(canvas, (foot, peak), 14.0, f"{symbol} = {words.short(round(abs(peak - foot), 2))}", name)


def _phases(canvas: Canvas, scene: CamScene, field: Field) -> None:
    """Dimension the phases in degrees under the lowest diagram."""
    motion = scene.solved.motion
    for phase in motion.phases[:3]:
        below = field.y.low - field.y.scale.measured(3.5 + scene.style.text)  # clear of the numbers
        ends = field.at(phase.start, below), field.at(phase.end, below)
        symbol = scene.words.symbol(f"phi_{phase.name}")
        text = f"{symbol} = {scene.degrees(phase.length)}"
        linear(canvas, ends, -1j * (2.0 * scene.style.text), text, f"phi_{phase.name}")


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
