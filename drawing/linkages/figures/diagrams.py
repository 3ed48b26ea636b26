"""Kinematic diagrams of the output: travel, velocity and acceleration over the cycle, by plans and by chords."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....plans.graphs import Diagrams, pole_distance
from ....plans.linkages.cycles.cycle import Cycle
from ....plans.linkages.cycles.diagrams import diagrams
from ....plans.linkages.cycles.strokes import OutputMotion
from ....plans.names import role
from ....scales.scale import Scale, rounded, steps
from ...diagram import Axis, Field, Pole, axes, curve, rays
from ...shapes import Circle, Group, Pen, Polyline
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
    canvas, sections = Canvas(scene.style), len(cycle.angles)
    of = str(motion.output.link)
    drawn = diagrams(cycle, of, sections)
    length = LENGTH[scene.style.label]
    duration = float(drawn.times[-1])
    across = Scale("mu_t", rounded(duration / length, 6), "s")
    dense = diagrams(cycle, of, DENSE)
    bands = _bands(scene, drawn, dense, across, motion)
    low = 0.0
    for number, band in enumerate(bands):
        least, most = (band.scale.drawn(end) for end in band.ends)
        low -= most + (GAP + scene.style.label * 2 if number else 0.0)
        _draw(canvas, scene, _field(scene, band, across, drawn, 1j * low), band)
        if number:
            pair = bands[number - 1 : number + 1]
            _pole(canvas, scene, _field(scene, band, across, drawn, 1j * low), pair, f"P_{{{number}}}")
        low += least
    top = _field(scene, bands[0], across, drawn, -1j * bands[0].scale.drawn(bands[0].ends[1]))
    _chords(canvas, top, drawn, float(np.nanmin(dense.s)))
    heading = (
        scene.words["heading.diagrams"].format(link=of),
        scene.words.scale(across),
        _turning(scene, cycle, length),
    )
    return canvas.finish("diagrams", tuple(filter(None, heading)), _notes(scene, drawn, bands))


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


def _chords(canvas: Canvas, field: Field, drawn: Diagrams, least: float) -> None:
    """Draw the chords of the travel, between points of the smooth curve."""
    points = [field.at(t, s - least) for t, s in zip(drawn.times.tolist(), drawn.s.tolist(), strict=True)]
    known = tuple(point for point in points if math.isfinite(point.imag))
    canvas.add(Group((Polyline(known, Pen.THIN),), "chords", "s"))


def _turning(scene: Scene, cycle: Cycle, length: float) -> str:
    """Return the scale factor of the crank's angle; a sliding driver has none."""
    if not cycle.drive.turns:
        return ""
    return scene.words.scale(Scale("mu_phi", rounded(2.0 * math.pi / length, 6), "rad"))


def _notes(scene: Scene, drawn: Diagrams, bands: Sequence[Band]) -> tuple[str, ...]:
    """Say how far the chords are from the plans."""
    parts = []
    for band, found in zip(bands[1:], (drawn.velocity, drawn.acceleration), strict=True):
        most = float(np.nanmax(found.per_cent, initial=0.0))
        parts.append(f"{scene.words.symbol(band.name)} {scene.words.number(most, 1)} %")
    notes = scene.words["said.chords"], scene.words["said.chords_off"].format(values="; ".join(parts))
    gone = ", ".join(scene.words.symbol(band.name) for band in bands if band.cut)
    return (*notes, scene.words["said.cut"].format(values=gone)) if gone else notes
