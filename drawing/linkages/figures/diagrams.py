"""Kinematic diagrams of the output: travel, velocity and acceleration over the cycle, by plans and by chords."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....plans.linkages.cycles.cycle import Cycle, Diagrams, diagrams, pole_distance
from ....plans.linkages.cycles.strokes import OutputMotion
from ....plans.linkages.mechanism import ANGLE, BOTH, FRAME, WORKING, Couple, Diagram, Load, Prismatic
from ....plans.names import role
from ....scales.scale import Scale, rounded, steps
from ...diagram import Axis, Field, Pole, axes, curve, rays
from ...printed import value_text
from ...shapes import Circle, Group, Line, Pen, Polyline
from ...view import Canvas, View
from ..scene import Scene
from .positions import main_output

Array = NDArray[Any]
DENSE = 180  # sections through whose ends a smooth curve is drawn
LENGTH = {5.0: 180.0, 3.5: 120.0}  # mm of the axis of angles, by the height of letters
TALL = 0.36  # height of a diagram in parts of that length
FARTHEST = 50.0  # mm from the axis beyond which no pole stands
# part of the sections in which a rate is as large as usual; peaks beyond, and what is left of them, in parts of that
USUAL, PEAK, LEFT = 0.9, 8.0, 2.5
GAP = 12.0  # mm between diagrams
LOAD_WIDE, LOAD_TALL = 18.0, 9.0  # heights of a letter that a load diagram is wide and tall


@dataclass(frozen=True, slots=True)
class Band:
    """One of the diagrams over one another: its smooth curve, the points found by chords, its scale factor."""

    name: str
    scale: Scale
    curve: Array
    chords: tuple[Array, Array] | None = None  # seconds, values
    cut: bool = False  # whether what grows without limit is left out

    @property
    def ends(self) -> tuple[float, float]:
        """The least and largest ordinate, zero included."""
        every = self.curve if self.chords is None else np.concatenate((self.curve, self.chords[1]))
        return min(0.0, float(np.nanmin(every))), max(0.0, float(np.nanmax(every)))


def diagrams_view(scene: Scene, cycle: Cycle) -> View:
    """Draw the three diagrams of the main output; its letter is the point's, or the link's number.

    Raises
    ------
    ValueError
        When there is no output that moves to and fro.
    """
    motion = main_output(cycle)
    if motion is None:
        raise ValueError("no output has a stroke")
    canvas, of, length = scene.canvas(), str(motion.output.link), LENGTH[scene.style.label]
    drawn, dense = (diagrams(cycle, of, sections) for sections in (len(cycle.angles), DENSE))
    across = Scale("mu_t", rounded(float(drawn.times[-1]) / length, 6), "s")
    bands, fields, low = _bands(scene, drawn, dense, across, motion), list[Field](), 0.0
    for number, band in enumerate(bands):
        below, above = (band.scale.drawn(end) for end in band.ends)
        low -= above + (GAP + scene.style.label * 2 if number else 0.0)
        fields.append(_field(scene, band, across, drawn, 1j * low))
        _draw(canvas, scene, fields[-1], band)
        if number:
            _pole(canvas, scene, fields[-1], bands[number - 1 : number + 1], f"P_{{{number}}}")
        low += below
    _chords(canvas, fields[0], drawn, float(np.nanmin(dense.s)))
    scales = [across]
    if cycle.drive.turns:  # a sliding driver has no angle
        scales.append(Scale("mu_phi", rounded(2.0 * math.pi / length, 6), "rad"))
    heading = (scene.words["heading.diagrams"].format(link=of), *map(scene.words.scale, scales))
    return canvas.finish("diagrams", heading, _notes(scene, drawn, bands))


def _chords(canvas: Canvas, field: Field, drawn: Diagrams, least: float) -> None:
    """Draw the chords of the travel, between points of the smooth curve."""
    ends = [field.at(t, s - least) for t, s in zip(drawn.times.tolist(), drawn.s.tolist(), strict=True)]
    known = tuple(end for end in ends if math.isfinite(end.imag))
    canvas.add(Group((Polyline(known, Pen.THIN),), "chords", "s"))


def _bands(scene: Scene, drawn: Diagrams, dense: Diagrams, across: Scale, motion: OutputMotion) -> tuple[Band, ...]:
    """Choose the scale factors: round ones with which the diagrams are tall enough and the poles near enough."""
    tall = TALL * LENGTH[scene.style.label]
    slides, link = motion.output.slides, motion.output.link
    names = (f"s_{link}", f"V_{link}", f"a_{link}") if slides else (f"phi_{link}", f"omega_{link}", f"epsilon_{link}")
    unit = "m" if slides else "rad"
    travel = dense.s - np.nanmin(dense.s)
    bands = [Band(names[0], _round(f"mu_{names[0]}", travel, tall, unit), travel)]
    for name, values, found, per in zip(
        names[1:], (dense.v, dense.a), (drawn.velocity, drawn.acceleration), ("s", "s^2"), strict=True
    ):
        shown, chords = _cut(values, found.chords)
        scale = _round(f"mu_{name}", shown, tall, f"{unit}/{per}")
        for mu in steps(scale.mu):
            scale = Scale(scale.symbol, mu, scale.unit)
            if pole_distance(bands[-1].scale.mu, across.mu, mu) <= FARTHEST:
                break
        bands.append(Band(name, scale, shown, (found.times, chords), shown is not values))
    return tuple(bands)


def _cut(values: Array, chords: Array) -> tuple[Array, Array]:
    """Leave out what has no bound: where the range ends at a limiting position, rates grow there without limit."""
    sizes = np.abs(values[np.isfinite(values)])
    usual = float(np.quantile(sizes, USUAL)) if len(sizes) else 0.0
    if not len(sizes) or float(sizes.max()) <= PEAK * usual:
        return values, chords
    most = LEFT * usual
    return np.where(np.abs(values) <= most, values, np.nan), np.where(np.abs(chords) <= most, chords, np.nan)


def _round(symbol: str, values: Array, tall: float, unit: str) -> Scale:
    reach = max(float(np.nanmax(values)), 0.0) - min(float(np.nanmin(values)), 0.0)
    return Scale(symbol, steps(reach / tall)[0] if reach > 0.0 else 1.0, unit)


def _field(scene: Scene, band: Band, across: Scale, drawn: Diagrams, origin: complex) -> Field:
    times = drawn.times.tolist()
    x = Axis("t", across, 0.0, times[-1], {t: str(k) for k, t in enumerate(times)})
    low, high = band.ends
    letter = f"{scene.words.symbol(band.name)};  {scene.words.scale(band.scale)}"
    return Field(origin, x, Axis(letter, band.scale, low, high, {}))


def _draw(canvas: Canvas, scene: Scene, field: Field, band: Band) -> None:
    """Draw the axes, the curve by plans in main lines, the points by chords on a dashed line."""
    axes(canvas, field)
    places = np.linspace(0.0, field.x.high, len(band.curve))
    curve(canvas, field, zip(places.tolist(), band.curve.tolist(), strict=True), band.name)
    if band.chords is None:
        return
    found = list(zip(*(values.tolist() for values in band.chords), strict=True))
    curve(canvas, field, found, f"{band.name}_chords", Pen.DASHED)
    points = (field.at(t, y) for t, y in found if math.isfinite(y))
    canvas.add(*(Circle(at, scene.style.node, Pen.THIN, fill="white", role="chord-point") for at in points))


def _pole(canvas: Canvas, scene: Scene, field: Field, bands: Sequence[Band], letter: str) -> None:
    """Draw the pole at its distance to the left of the axis, and a ray parallel to each chord of the diagram above."""
    above, band = bands
    reach = pole_distance(above.scale.mu, field.x.scale.mu, band.scale.mu)
    assert band.chords is not None
    name = f"H_{role(band.name).kind or band.name}"
    text = f"{scene.words.symbol(name)} = {scene.words.number(reach, 2)}"
    ordinates = ((i, field.y.mm(y)) for i, y in enumerate(band.chords[1].tolist(), 1) if math.isfinite(y))
    rays(canvas, field, Pole(reach, letter, name, text), ordinates)


def _notes(scene: Scene, drawn: Diagrams, bands: Sequence[Band]) -> tuple[str, ...]:
    """Say how far the chords are from the plans."""
    parts = []
    for band, found in zip(bands[1:], (drawn.velocity, drawn.acceleration), strict=True):
        most = float(np.nanmax(found.per_cent, initial=0.0))
        parts.append(f"{scene.words.symbol(band.name)} {scene.words.number(most, 1)} %")
    notes = scene.words["said.chords"], scene.words["said.chords_off"].format(values="; ".join(parts))
    gone = ", ".join(scene.words.symbol(band.name) for band in bands if band.cut)
    return (*notes, scene.words["said.cut"].format(values=gone)) if gone else notes


def load_diagram(scene: Scene, diagram: Diagram) -> View:
    """Draw what the task gives: the diagram with its scale factors, and the ordinate of the calculated position."""
    canvas, words = scene.canvas(), scene.words
    every: Sequence[Load | Couple] = (*scene.mechanism.loads, *scene.mechanism.couples)
    loads = [load for load in every if load.magnitude == diagram.name]
    forth, back = (_points(scene, diagram, names) for names in (diagram.values, diagram.back or ()))
    field = _load_field(scene, diagram, loads, [*forth, *back])
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
    mechanism, values = scene.mechanism, scene.solved.values
    assert mechanism.stroke is not None
    number = mechanism.stroke.link
    slides = any(isinstance(p, Prismatic) and number in p.links and FRAME in p.links for p in mechanism.pairs)
    return abs(float(values["_stroke_end"]) - float(values["_stroke_begin"])), "m" if slides else "rad"


def _load_field(
    scene: Scene, diagram: Diagram, loads: Sequence[Load | Couple], points: list[tuple[float, float]]
) -> Field:
    """Choose round scale factors and return the axes with their divisions."""
    words, letter = scene.words, scene.style.label
    moment = bool(loads) and isinstance(loads[0], Couple)
    turns = diagram.over == ANGLE
    unit = "rad" if turns else _travel(scene)[1]
    low, high = min(x for x, _ in points), max(x for x, _ in points)
    across = Scale("mu_phi" if unit == "rad" else "mu_s", steps(high / (LOAD_WIDE * letter))[0], unit)
    sizes = [abs(y) for _, y in points]
    up = Scale(
        "mu_M" if moment else "mu_F", steps((max(sizes) or 1.0) / (LOAD_TALL * letter))[0], "N*m" if moment else "N"
    )
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
