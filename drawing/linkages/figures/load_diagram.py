"""A load diagram of the task: a force or a moment over the stroke or over the driver's angle, to scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ....plans.linkages.mechanism import ANGLE, BOTH, FRAME, WORKING, Couple, Diagram, Load, Prismatic
from ....scales.scale import Scale, steps
from ...diagram import Axis, Field, axes, curve
from ...printed import value_text
from ...shapes import Circle, Line, Pen
from ...view import Canvas, View
from ..scene import Scene

WIDE, TALL = 18.0, 9.0  # heights of a letter that a diagram is wide and tall


def load_diagram(scene: Scene, diagram: Diagram) -> View:
    """Draw what the task gives: the diagram with its scale factors, and the ordinate of the calculated position."""
    canvas, words = Canvas(scene.style), scene.words
    loads = users(scene, diagram)
    forth, back = (_points(scene, diagram, names) for names in (diagram.values, diagram.back or ()))
    field = _field(scene, diagram, loads, [*forth, *back])
    axes(canvas, field)
    curve(canvas, field, forth, diagram.name)
    curve(canvas, field, back, f"{diagram.name}_back", Pen.DASHED)
    _here(canvas, scene, field, diagram, loads)
    notes = [words["said.load_back"]] if back else []
    if not back and loads and loads[0].stroke != BOTH:
        notes.append(words["said.load_working" if loads[0].stroke == WORKING else "said.load_idle"])
    if diagram.over != ANGLE:
        size, unit = _travel(scene)
        shown = words.display.unit(unit)
        notes.append(f"H = {value_text(words, words.display.value(size, unit))} {words.unit(shown)}")
    heading = (words["heading.load"], words.scale(field.x.scale), words.scale(field.y.scale))
    return canvas.finish(f"load_{diagram.name}", heading, tuple(notes))


def users(scene: Scene, diagram: Diagram) -> list[Load | Couple]:
    """Return the loads whose magnitude the diagram is."""
    mechanism = scene.solved.mechanism
    every: Sequence[Load | Couple] = (*mechanism.loads, *mechanism.couples)
    return [load for load in every if load.magnitude == diagram.name]


def _value(scene: Scene, name: str) -> float:
    """Return a given of a diagram; of one called like a load the magnitude."""
    values = scene.solved.values
    return float(values.get(f"|{name}|", values.get(name, 0.0)))


def _points(scene: Scene, diagram: Diagram, names: Sequence[str]) -> list[tuple[float, float]]:
    """Return places and values of one stroke, in SI; over the angle the first value comes again after a turn."""
    span = 1.0 if diagram.over == ANGLE else _travel(scene)[0]
    points = [(_value(scene, at) * span, _value(scene, name)) for at, name in zip(diagram.at, names, strict=False)]
    if diagram.over == ANGLE and points:
        points.append((points[0][0] + 2.0 * math.pi, points[0][1]))
    elif points:  # level outside of its places
        points = [(0.0, points[0][1]), *points, (span, points[-1][1])]
    return points


def _travel(scene: Scene) -> tuple[float, str]:
    """Return the whole stroke and its unit."""
    mechanism, values = scene.solved.mechanism, scene.solved.values
    assert mechanism.stroke is not None
    number = mechanism.stroke.link
    slides = any(isinstance(p, Prismatic) and number in p.links and FRAME in p.links for p in mechanism.pairs)
    return abs(float(values["_stroke_end"]) - float(values["_stroke_begin"])), "m" if slides else "rad"


def _field(scene: Scene, diagram: Diagram, loads: Sequence[Load | Couple], points: list[tuple[float, float]]) -> Field:
    """Choose round scale factors and return the axes with their divisions."""
    words, letter = scene.words, scene.style.label
    moment = bool(loads) and isinstance(loads[0], Couple)
    turns = diagram.over == ANGLE
    unit = "rad" if turns else _travel(scene)[1]
    low, high = min(x for x, _ in points), max(x for x, _ in points)
    across = Scale("mu_phi" if unit == "rad" else "mu_s", steps(high / (WIDE * letter))[0], unit)
    sizes = [abs(y) for _, y in points]
    up = Scale("mu_M" if moment else "mu_F", steps((max(sizes) or 1.0) / (TALL * letter))[0], "N*m" if moment else "N")
    places = {x: words.short(round(math.degrees(x), 6)) + "°" for x, _ in points} if turns else _parts(scene, diagram)
    divisions = {y: words.short(y) for y in sorted({y for _, y in points}) if y}
    of = " = ".join(words.symbol(load.name) for load in loads) or words.symbol(diagram.name)
    x = Axis(words.symbol("phi") if turns else "s", across, low, high, places)
    least, most = min(0.0, *(y for _, y in points)), max(0.0, *(y for _, y in points))
    return Field(0j, x, Axis(f"{of}, {words.unit(up.unit)}", up, least, most, divisions))


def _parts(scene: Scene, diagram: Diagram) -> dict[float, str]:
    """Return the places of a diagram over the stroke, written as parts of it."""
    span, found = _travel(scene)[0], {0.0: "0"}
    for name in diagram.at:
        part = _value(scene, name)
        if part:
            found[part * span] = "H" if part == 1.0 else f"{scene.words.short(part)}H"
    return {**found, span: "H"}


def _here(canvas: Canvas, scene: Scene, field: Field, diagram: Diagram, loads: Sequence[Load | Couple]) -> None:
    """Mark the calculated position and the load that acts there."""
    values, words = scene.solved.values, scene.words
    if diagram.over == ANGLE:
        place = float(values[f"_diagram_{diagram.name}_angle"])
    else:
        place = min(max(float(values["_stroke_part"]), 0.0), 1.0) * _travel(scene)[0]
    size = float(values[f"_diagram_{diagram.name}"])
    for load in loads[:1]:
        acting = scene.solved.size(load.name)
        if abs(acting - abs(size)) > 1e-9 * abs(size):  # it does not act in this stroke
            size = 0.0
        text = f"{words.symbol(load.name)} = {value_text(words, acting)} {words.unit(field.y.scale.unit)}"
        at = field.at(place, size)
        canvas.add(Line(field.at(place, 0.0), at, Pen.DASHED, role="ordinate", name=load.name))
        canvas.add(Circle(at, scene.style.node, Pen.THIN, fill="white", role="ordinate", name=load.name))
        canvas.label(text, at, prefer=1.0 + 1.0j, clear=1.2, height=scene.style.text)
