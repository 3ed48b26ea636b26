"""The whole cycle: the mechanism all round it with the paths of its points, its diagrams, those of its loads."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....plans.board import POSITION
from ....plans.laws import dot
from ....plans.linkages.cycle import MARGIN, Cycle, Diagrams, diagrams, pole_distance, velocity_field
from ....plans.linkages.mechanism import ANGLE, BOTH, FRAME, WORKING, Couple, Diagram, Driver, Load, Revolute
from ....plans.linkages.solved import SolvedLinkage
from ....plans.linkages.strokes import OutputMotion
from ....plans.names import role
from ....scales.scale import Scale, rounded, steps
from ...dimensions import Axis, Field, Pole, axes, curve, rays
from ...figure import ANSWERS, GIVEN
from ...printed import value_text
from ...shapes import Circle, HeadPlace, Line, Pen, Polyline, Vector
from ...symbols import slider_up
from ...view import Canvas, View
from ..scene import Scene
from .links import draw_links, lay_down, letter_links
from .scheme import turning_of_driver

DENSE = 240  # places through which a path is drawn
STRAIGHT = 0.05  # mm within which a path is a straight line, or a point
ARC, START = 30.0, math.pi / 4  # mm, length of the arc of omega_1, and the direction near which it stands
CLOSE = 2.0  # mm within which two positions share the place of their numbers
PITCH = 5.0  # distance of neighbouring points in arrowheads
MOST = 100.0  # such distances along a side, more than a sheet has room for
APART = 0.9  # longest vector in parts of the distance of neighbouring points
Array = NDArray[Any]
SECTIONS = 180  # sections through whose ends a smooth curve is drawn
LENGTH = {5.0: 180.0, 3.5: 120.0}  # mm of the axis of angles, by the height of letters
TALL = 0.36  # height of a diagram in parts of that length
FARTHEST = 50.0  # mm from the axis beyond which no pole stands
# part of the sections in which a rate is as large as usual; peaks beyond, and what is left of them, in parts of that
USUAL, PEAK, LEFT = 0.9, 8.0, 2.5
GAP = 12.0  # mm between diagrams
LOAD_WIDE, LOAD_TALL = 18.0, 9.0  # heights of a letter that a load diagram is wide and tall


def main_output(cycle: Cycle) -> OutputMotion | None:
    """Return the output that the task names, else the last one that has a stroke."""
    stroke, moving = cycle.mechanism.stroke, [motion for motion in cycle.motions if motion.travel is not None]
    named = [motion for motion in moving if stroke is not None and motion.output.link == stroke.link]
    return next(iter(named or moving[-1:]), None)


def positions_view(scene: Scene, cycle: Cycle) -> View:
    """Draw N positions thin, the calculated one in main lines, dead positions dash-two-dot, and all paths."""
    canvas = scene.canvas()
    for name, path in _paths(scene, cycle):
        canvas.add(Polyline(path, Pen.AXIS, role="curve", name=name))
    stands = dict(standing(scene, cycle, cycle.angles.tolist()))
    motion = main_output(cycle)
    dead = sorted({spot.angle for spot in motion.dead}) if motion else []
    for number, stand in stands.items():
        lay_down(canvas, stand, Pen.THIN, f"position_{number}")
    for _, stand in standing(scene, cycle, dead):
        lay_down(canvas, stand, Pen.EXTREME, "dead-position")
    for point in _numbered(scene, cycle):
        _number(canvas, scene, stands, point)
    scene = replace(scene, runs={**scene.runs, **_ways(scene, stands.values())})
    figures = draw_links(canvas, scene, scene.numbers, whole=True)
    driver = scene.mechanism.driver
    if isinstance(driver, Driver):  # the sense in which the crank turns, outside of its circle
        radius = abs(scene.mm(driver.point) - scene.mm(driver.pivot)) + 2.0 * scene.style.label
        turning_of_driver(canvas, scene, driver, (radius, radius * 1.15, radius * 1.3), ARC / radius, START)
    letter_links(canvas, scene, figures)
    notes = list[str]()
    if dead:
        times, unit = (180.0 / math.pi, "°") if cycle.drive.turns else (1e3, f" {scene.words['unit.mm']}")
        places = "; ".join(f"{scene.words.number(place * times, 2)}{unit}" for place in dead)
        symbol = scene.words.symbol(role(cycle.drive.variable).shown)
        notes = [scene.words["said.dead"].format(symbol=symbol, places=places)]
    heading = scene.heading("heading.positions", "position", n=str(len(stands)))
    return canvas.finish("positions", heading, tuple(notes))


def standing(scene: Scene, cycle: Cycle, places: Iterable[float], plan: str = POSITION) -> Iterator[tuple[int, Scene]]:
    """Go through the scenes with the driver at these places, numbered, but those where there is no such plan."""
    for number, place in enumerate(places):
        solved = cycle.solved(place, plan)
        if solved.trouble is None:
            # a guide on a moving link is drawn as far as the slider: its run is counted from the calculated position
            yield number, replace(scene, solved=solved, runs={})


def _paths(scene: Scene, cycle: Cycle) -> Iterator[tuple[str, tuple[complex, ...]]]:
    """Go through the paths of all lettered points, mm, each in pieces where it breaks; straight ones left out."""
    span = cycle.range
    places = np.linspace(span.low, span.high, DENSE + 1)
    points = [name for name in scene.points if name in cycle.program.names and name not in cycle.mechanism.frame_points]
    seen: list[complex] = []
    for name, values in cycle.at(places, points).items():
        path = values * (1.0 / scene.scales[POSITION].mu)
        known = path[np.isfinite(path)]
        ways = known - known[:1]
        far = ways[np.argmax(np.abs(ways))] if len(ways) > 1 else 0.0
        if any(abs(path[0] - other) < STRAIGHT for other in seen) or abs(far) < STRAIGHT:
            continue
        if np.max(np.abs((ways / far).imag)) * abs(far) < STRAIGHT:  # along a straight line
            continue
        seen.append(complex(path[0]))
        pieces = (piece[np.isfinite(piece)] for piece in np.split(path, np.flatnonzero(~np.isfinite(path))))
        yield from ((name, tuple(piece.tolist())) for piece in pieces if len(piece) > 1)


def _numbered(scene: Scene, cycle: Cycle) -> list[str]:
    """Return the points that have a number in each position: the crank's, that of the output, hinges between them."""
    mechanism = cycle.mechanism
    hinges = (pair.point for pair in mechanism.pairs if isinstance(pair, Revolute) and FRAME not in pair.links)
    found: dict[complex, str] = {}
    for point in (mechanism.driver.point, output_point(cycle), *hinges):
        if all(abs(scene.mm(point) - place) > CLOSE for place in found):
            found[scene.mm(point)] = point
    return [*found.values()]


def output_point(cycle: Cycle) -> str:
    """Return a point of the main output that moves, to be numbered like the crank's."""
    mechanism, motion = cycle.mechanism, main_output(cycle)
    number = mechanism.driver.link if motion is None else motion.output.link
    points = [] if motion is None else mechanism.link(number).points
    shared = [pair.point for pair in mechanism.pairs if number in pair.links]
    free = (p for p in (*shared, *points) if p in points and p not in mechanism.frame_points)
    return next(free, mechanism.driver.point)


def _number(canvas: Canvas, scene: Scene, stands: Mapping[int, Scene], point: str) -> None:
    at: dict[complex, list[str]] = {}
    for number, stand in stands.items():
        place = stand.mm(point)
        key = next((other for other in at if abs(other - place) < CLOSE), place)
        at.setdefault(key, []).append(str(number))
    middle = sum(at) / len(at) if at else 0j
    far = max((place - middle for place in at), key=abs, default=0j)
    straight = bool(far) and all(abs(((place - middle) / far).imag) * abs(far) < STRAIGHT for place in at)
    for place, numbers in at.items():
        # beside a straight path all on one side, outside of a curved one
        away = -slider_up(far / abs(far)) if straight else place - middle
        # as of a point, for bare numbers are those of links
        text = f"{scene.words.mark(point)}_{{{','.join(numbers)}}}"
        canvas.small(text, place, away, scene.style.node + 0.6)


def _ways(scene: Scene, stands: Iterable[Scene]) -> dict[str, tuple[float, float]]:
    """Return by guide of the frame how far its slider stands back and forth of its calculated place, metres."""
    ends = {}
    for pair in scene.sliding():
        name, at = scene.solved.guide_name(pair), scene.solved.point(pair.point)
        ways = [dot(stand.solved.point(pair.point) - at, scene.solved.point(name)) for stand in stands]
        low, high = scene.runs.get(name, (0.0, 0.0))
        ends[name] = min([low, *ways]), max([high, *ways])
    return ends


def coupler(solved: SolvedLinkage) -> int | None:
    """Return the first link with two joints that is not on the frame: only such a link has a field worth drawing."""
    mechanism = solved.mechanism
    on_frame = {number for pair in mechanism.pairs if FRAME in pair.links for number in pair.links}
    free = (n for group in solved.structure.groups for n in group.links if n not in on_frame)
    turning = (number for number in free if solved.values.get(f"omega_{number}"))
    return next((n for n in turning if len({p.point for p in mechanism.pairs if n in p.links}) > 1), None)


def field_view(scene: Scene, link: int) -> View:
    """Draw a link with the velocities of a grid of its points, at a scale factor at which they do not cross."""
    canvas, per_mm = scene.canvas(), 1.0 / scene.scales[POSITION].mu
    points = [scene.solved.point(point) for point in scene.mechanism.link(link).points]
    sides = [float(np.ptp(part)) for part in (np.real(points), np.imag(points))]
    pitch = PITCH * scene.style.arrow * scene.scales[POSITION].mu  # so far apart arrows have room between them
    wanted = ((part + 2.0 * MARGIN * max(sides)) / pitch for part in sides)
    columns, rows = (max(2, round(min(count, MOST)) + 1) for count in wanted)
    places, velocities = velocity_field(scene.solved, link, columns, rows)
    nearest = min(abs(places[0, 1] - places[0, 0]), abs(places[1, 0] - places[0, 0])) * per_mm
    scale = Scale("mu_V", steps(float(np.max(np.abs(velocities))) / (APART * nearest))[0], "m/s")
    for at, velocity in zip(places.ravel().tolist(), velocities.ravel().tolist(), strict=True):
        tail = at * per_mm
        tip = tail + velocity * (1.0 / scale.mu)
        head: HeadPlace = "none" if abs(tip - tail) < scene.style.arrow else "tip"
        canvas.add(Circle(tail, 0.3, Pen.THIN, fill="black"))
        canvas.add(Vector(tail, tip, f"v_{link}", abs(velocity), scale.unit, scale.mu, Pen.THIN, head=head))
    figures = draw_links(canvas, scene, [link], framed=False)
    letter_links(canvas, scene, figures)
    heading = scene.heading("heading.field", POSITION, link=str(link))
    return canvas.finish("field", (*heading, scene.words.scale(scale)))


class _Band(NamedTuple):
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

    Raises ValueError: there is no output that moves to and fro.
    """
    motion = main_output(cycle)
    if motion is None:
        raise ValueError("no output has a stroke")
    canvas, of, length = scene.canvas(), str(motion.output.link), LENGTH[scene.style.label]
    drawn, dense = (diagrams(cycle, of, sections) for sections in (cycle.sections, SECTIONS))
    across = Scale("mu_t", rounded(float(drawn.times[-1]) / length, 6), "s")
    bands, low, times = _bands(scene, drawn, dense, across, motion), 0.0, drawn.times.tolist()
    for number, band in enumerate(bands):
        below, above = (band.scale.drawn(end) for end in band.ends)
        low -= above + (GAP + scene.style.label * 2 if number else 0.0)
        letter = f"{scene.words.symbol(band.name)};  {scene.words.scale(band.scale)}"
        x = Axis("t", across, 0.0, times[-1], {t: str(k) for k, t in enumerate(times)})
        field = Field(1j * low, x, Axis(letter, band.scale, *band.ends, {}))
        axes(canvas, field)
        places = np.linspace(0.0, times[-1], len(band.curve)).tolist()
        curve(canvas, field, zip(places, band.curve.tolist(), strict=True), band.name)
        if number:
            _chords(canvas, scene, field, bands[number - 1].scale, band, f"P_{{{number}}}")
        else:
            top = field
        low += below
    travel = (drawn.s - np.nanmin(dense.s)).tolist()
    ends = (top.at(t, s) for t, s in zip(times, travel, strict=True))
    chords = Polyline(tuple(end for end in ends if math.isfinite(end.imag)), Pen.THIN)  # of the travel
    canvas.group("chords", "s", chords)
    scales = [across]
    if cycle.drive.turns:  # a sliding driver has no angle
        scales.append(Scale("mu_phi", rounded(2.0 * math.pi / length, 6), "rad"))
    heading = (scene.words["heading.diagrams"].format(link=of), *map(scene.words.scale, scales))
    return canvas.finish("diagrams", heading, _chord_notes(scene, drawn, bands))


def _bands(scene: Scene, drawn: Diagrams, dense: Diagrams, across: Scale, motion: OutputMotion) -> tuple[_Band, ...]:
    """Choose the scale factors: round ones with which the diagrams are tall enough and the poles near enough."""
    tall, travel = TALL * LENGTH[scene.style.label], dense.s - np.nanmin(dense.s)
    kinds, unit = (("s", "V", "a"), "m") if motion.output.slides else (("phi", "omega", "epsilon"), "rad")
    names = [f"{kind}_{motion.output.link}" for kind in kinds]
    bands = [_Band(names[0], _round(f"mu_{names[0]}", travel, tall, unit), travel)]
    rates = (dense.v, drawn.velocity, "s"), (dense.a, drawn.acceleration, "s^2")
    for name, (values, found, per) in zip(names[1:], rates, strict=True):
        shown, chords = cut(values, found.chords)
        scale = _round(f"mu_{name}", shown, tall, f"{unit}/{per}")
        for mu in steps(scale.mu):
            scale = Scale(scale.symbol, mu, scale.unit)
            if pole_distance(bands[-1].scale.mu, across.mu, mu) <= FARTHEST:
                break
        bands.append(_Band(name, scale, shown, (found.times, chords), shown is not values))
    return tuple(bands)


def cut(values: Array, chords: Array) -> tuple[Array, Array]:
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


def _chords(canvas: Canvas, scene: Scene, field: Field, above: Scale, band: _Band, letter: str) -> None:
    """Draw points found by chords on a dashed line, the pole, and a ray parallel to each chord of the diagram above."""
    assert band.chords is not None
    points = list(zip(*(values.tolist() for values in band.chords), strict=True))
    curve(canvas, field, points, f"{band.name}_chords", Pen.DASHED)
    places = (field.at(t, y) for t, y in points if math.isfinite(y))
    canvas.add(*(Circle(at, scene.style.node, Pen.THIN, fill="white", role="chord-point") for at in places))
    # the pole stands at its distance to the left of the axis
    reach, name = pole_distance(above.mu, field.x.scale.mu, band.scale.mu), f"H_{role(band.name).kind or band.name}"
    text = f"{scene.words.symbol(name)} = {scene.words.number(reach, 2)}"
    ordinates = ((i, band.scale.drawn(y)) for i, (_, y) in enumerate(points, 1) if math.isfinite(y))
    rays(canvas, field, Pole(reach, letter, name, text), ordinates)


def _chord_notes(scene: Scene, drawn: Diagrams, bands: Sequence[_Band]) -> tuple[str, ...]:
    parts = []
    for band, found in zip(bands[1:], (drawn.velocity, drawn.acceleration), strict=True):
        most = float(np.nanmax(found.per_cent, initial=0.0))
        parts.append(f"{scene.words.symbol(band.name)} {scene.words.number(most, 1)} %")
    notes = scene.words["said.chords"], scene.words["said.chords_off"].format(values="; ".join(parts))
    gone = ", ".join(scene.words.symbol(band.name) for band in bands if band.cut)
    return (*notes, scene.words["said.cut"].format(values=gone)) if gone else notes


def load_diagram(scene: Scene, diagram: Diagram) -> View:
    """Draw what the task gives: the diagram with its scale factors, and the ordinate of the calculated position."""
    canvas, words, turns = scene.canvas(), scene.words, diagram.over == ANGLE
    every: Sequence[Load | Couple] = (*scene.mechanism.loads, *scene.mechanism.couples)
    loads, (span, unit) = [load for load in every if load.magnitude == diagram.name], _span(scene, diagram)
    forth, back = (_points(scene, diagram, names, span) for names in (diagram.values, diagram.back or ()))
    canvas.part(GIVEN)
    field = _load_field(scene, diagram, loads, [*forth, *back])
    axes(canvas, field)
    curve(canvas, field, forth, diagram.name)
    curve(canvas, field, back, f"{diagram.name}_back", Pen.DASHED)
    if loads:  # mark the calculated position and the load that acts there, which may not act in this stroke
        canvas.part(ANSWERS)
        name, values = loads[0].name, scene.values
        part = min(max(float(values["_stroke_part"]), 0.0), 1.0) if not turns else 0.0
        place = float(values[f"_diagram_{diagram.name}_angle"]) if turns else part * span
        size, acting = float(values[f"_diagram_{diagram.name}"]), scene.solved.size(name)
        at = field.at(place, 0.0 if abs(acting - abs(size)) > 1e-9 * abs(size) else size)
        text = f"{words.symbol(name)} = {value_text(words, acting)} {words.unit(field.y.scale.unit)}"
        canvas.add(Line(field.at(place, 0.0), at, Pen.DASHED, role="ordinate", name=name))
        canvas.add(Circle(at, scene.style.node, Pen.THIN, fill="white", role="ordinate", name=name))
        canvas.small(text, at, 1.0 + 1.0j, 1.2)
    notes = [words["said.load_back"]] if back else []
    if not back and loads and loads[0].stroke != BOTH:
        notes.append(words["said.load_working" if loads[0].stroke == WORKING else "said.load_idle"])
    if not turns:
        shown = words.unit(words.display.unit(unit))
        notes.append(f"H = {value_text(words, words.display.value(span, unit))} {shown}")
    heading = (words["heading.load"], words.scale(field.x.scale), words.scale(field.y.scale))
    return canvas.finish(f"load_{diagram.name}", heading, tuple(notes))


def _value(scene: Scene, name: str) -> float:
    return float(scene.values.get(f"|{name}|", scene.values.get(name, 0.0)))


def _points(scene: Scene, diagram: Diagram, names: Sequence[str], span: float) -> list[tuple[float, float]]:
    """Return places and values of one stroke, in SI; over the angle the first value comes again after a turn."""
    points = [(_value(scene, at) * span, _value(scene, name)) for at, name in zip(diagram.at, names, strict=False)]
    if diagram.over == ANGLE and points:
        points.append((points[0][0] + 2.0 * math.pi, points[0][1]))
    elif points:  # level outside of its places
        points = [(0.0, points[0][1]), *points, (span, points[-1][1])]
    return points


def _span(scene: Scene, diagram: Diagram) -> tuple[float, str]:
    """Return what a place of 1 on a diagram is, and its unit: a radian, or the whole stroke."""
    mechanism, values = scene.mechanism, scene.values
    if diagram.over == ANGLE:
        return 1.0, "rad"
    assert mechanism.stroke is not None
    slides = any(mechanism.stroke.link in pair.links for pair in scene.sliding())
    return abs(float(values["_stroke_end"]) - float(values["_stroke_begin"])), "m" if slides else "rad"


def _load_field(
    scene: Scene, diagram: Diagram, loads: Sequence[Load | Couple], points: list[tuple[float, float]]
) -> Field:
    """Choose round scale factors and return the axes with their divisions; those of a stroke are parts of it."""
    words, letter, (span, unit), (xs, ys) = (
        scene.words,
        scene.style.label,
        _span(scene, diagram),
        zip(*points, strict=True),
    )
    across = Scale("mu_phi" if unit == "rad" else "mu_s", steps(max(xs) / (LOAD_WIDE * letter))[0], unit)
    symbol, up_unit = ("mu_M", "N*m") if loads and isinstance(loads[0], Couple) else ("mu_F", "N")
    up = Scale(symbol, steps((max(map(abs, ys)) or 1.0) / (LOAD_TALL * letter))[0], up_unit)
    if turns := diagram.over == ANGLE:
        places = {x: words.short(round(math.degrees(x), 6)) + "°" for x in xs}
    else:
        parts = filter(None, (_value(scene, name) for name in diagram.at))
        places = {0.0: "0"} | {part * span: f"{words.short(part)}H" for part in parts} | {span: "H"}
    divisions = {y: words.short(y) for y in sorted({*ys}) if y}
    of = " = ".join(words.symbol(load.name) for load in loads) or words.symbol(diagram.name)
    x = Axis(words.symbol("phi") if turns else "s", across, min(xs), max(xs), places)
    return Field(0j, x, Axis(f"{of}, {words.unit(up.unit)}", up, min(0.0, *ys), max(0.0, *ys), divisions))
