"""The plan of positions: the mechanism all round its cycle, the paths of its points, its dead positions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from ....plans.board import POSITION
from ....plans.laws import dot
from ....plans.linkages.cycles.cycle import MARGIN, Cycle, velocity_field
from ....plans.linkages.cycles.strokes import OutputMotion
from ....plans.linkages.mechanism import FRAME, Driver, Prismatic
from ....plans.linkages.solved import SolvedLinkage, solve_linkage
from ....plans.names import role
from ....scales.scale import Scale, steps
from ...shapes import Circle, HeadPlace, Line, Pen, Polyline, Vector
from ...symbols import slider_up
from ...view import Canvas, View
from ..scene import Scene
from ..skeleton import skeleton
from .links import draw_frame, draw_links, letter_links
from .scheme import turning_of_driver

DENSE = 240  # places through which a path is drawn
STRAIGHT = 0.05  # mm within which a path is a straight line, or a point
ARC, START = 30.0, math.pi / 4  # mm, length of the arc of omega_1, and the direction near which it stands
CLOSE = 2.0  # mm within which two positions share the place of their numbers
PITCH = 5.0  # distance of neighbouring points in arrowheads
MOST = 100.0  # such distances along a side, more than a sheet has room for
APART = 0.9  # longest vector in parts of the distance of neighbouring points


def main_output(cycle: Cycle) -> OutputMotion | None:
    """Return the output that the task names, else the last one that has a stroke."""
    stroke = cycle.mechanism.stroke
    moving = [motion for motion in cycle.motions if motion.travel is not None]
    named = [motion for motion in moving if stroke is not None and motion.output.link == stroke.link]
    return next(iter(named or moving[-1:]), None)


def positions_view(scene: Scene, cycle: Cycle) -> View:
    """Draw N positions thin, the calculated one in main lines, dead positions dash-two-dot, and all paths."""
    canvas = scene.canvas()
    numbers = [link.number for link in scene.mechanism.links]
    for name, path in paths(scene, cycle):
        canvas.add(Polyline(path, Pen.AXIS, role="curve", name=name))
    stands = dict(_stands(scene, cycle, cycle.angles.tolist()))
    motion = main_output(cycle)
    dead = sorted({spot.angle for spot in motion.dead}) if motion else []
    for number, stand in stands.items():
        _lay_down(canvas, stand, numbers, Pen.THIN, f"position_{number}")
    for _, stand in _stands(scene, cycle, dead):
        _lay_down(canvas, stand, numbers, Pen.EXTREME, "dead-position")
    _number(canvas, scene, stands, cycle.mechanism.driver.point)
    _number(canvas, scene, stands, _output_point(cycle))
    scene = replace(scene, runs={**scene.runs, **_ways(scene, stands.values())})
    figures = draw_links(canvas, scene, numbers, whole=True)
    draw_frame(canvas, scene, numbers, figures)
    driver = scene.mechanism.driver
    if isinstance(driver, Driver):  # the sense in which the crank turns, outside of its circle
        radius = abs(scene.mm(driver.point) - scene.mm(driver.pivot)) + 2.0 * scene.style.label
        turning_of_driver(canvas, scene, driver, (radius, radius * 1.15, radius * 1.3), ARC / radius, START)
    letter_links(canvas, scene, numbers, figures)
    heading = scene.heading("heading.positions", "position", n=str(len(stands)))
    return canvas.finish("positions", heading, _notes(scene, cycle, dead))


def _stands(scene: Scene, cycle: Cycle, places: Iterable[float]) -> Iterator[tuple[int, Scene]]:
    """Go through the scenes with the driver at these places, numbered, but those where the mechanism cannot stand."""
    for number, place in enumerate(places):
        solved = solve_linkage(cycle.mechanism, {**cycle.givens, cycle.drive.variable: place}, ("position",))
        if solved.trouble is None:
            # a guide on a moving link is drawn as far as the slider: its run is counted from the calculated position
            yield number, replace(scene, solved=solved, runs={})


def _lay_down(canvas: Canvas, scene: Scene, numbers: list[int], pen: Pen, role: str) -> None:
    """Draw all links in one position as plain lines with small joints."""
    pins: dict[complex, None] = {}
    for number in numbers:
        figure = skeleton(scene, number)
        canvas.add(*(Line(a, b, pen, role=role, name=str(number)) for a, b in figure.strokes))
        pins |= dict.fromkeys(complex(round(at.real, 4), round(at.imag, 4)) for at in figure.nodes)
    canvas.add(*(Circle(at, scene.style.node, Pen.THIN, fill="white", role=role) for at in pins))


def paths(scene: Scene, cycle: Cycle) -> Iterator[tuple[str, tuple[complex, ...]]]:
    """Go through the paths of all lettered points, mm, each in pieces where it breaks; straight ones left out."""
    span = cycle.range
    places = np.linspace(span.low, span.high, DENSE + 1)
    names = [name for link in cycle.mechanism.links for name in link.points]
    points = [name for name in dict.fromkeys(names) if name in cycle.program.names]
    found = cycle.at(places, [point for point in points if point not in cycle.mechanism.frame_points])
    seen: list[complex] = []
    for name, values in found.items():
        path = values * (1.0 / scene.scales["position"].mu)
        first = complex(path[0])
        if any(abs(first - other) < STRAIGHT for other in seen) or _is_straight(path):
            continue
        seen.append(first)
        for piece in _pieces(path):
            yield name, piece


def _is_straight(path: np.ndarray) -> bool:
    known = path[np.isfinite(path)]
    if len(known) < 2:
        return True
    far = known[np.argmax(np.abs(known - known[0]))] - known[0]
    if abs(far) < STRAIGHT:
        return True
    return bool(np.max(np.abs(((known - known[0]) / far).imag)) * abs(far) < STRAIGHT)


def _pieces(path: np.ndarray) -> Iterator[tuple[complex, ...]]:
    """Cut a path where it has no places."""
    breaks = np.flatnonzero(~np.isfinite(path))
    for piece in np.split(path, breaks):
        known = piece[np.isfinite(piece)]
        if len(known) > 1:
            yield tuple(known.tolist())


def _output_point(cycle: Cycle) -> str:
    """Return a point of the main output that moves, to be numbered like the crank's."""
    motion = main_output(cycle)
    if motion is None:
        return cycle.mechanism.driver.point
    points = cycle.mechanism.link(motion.output.link).points
    held = cycle.mechanism.frame_points
    shared = [pair.point for pair in cycle.mechanism.pairs if motion.output.link in pair.links]
    return next((p for p in (*shared, *points) if p not in held and p in points), cycle.mechanism.driver.point)


def _number(canvas: Canvas, scene: Scene, stands: Mapping[int, Scene], point: str) -> None:
    """Number the places of a point; places that coincide share one label."""
    at: dict[complex, list[str]] = {}
    for number, stand in stands.items():
        place = stand.mm(point)
        key = next((other for other in at if abs(other - place) < CLOSE), place)
        at.setdefault(key, []).append(str(number))
    middle = sum(at) / len(at) if at else 0j
    ends = [place - middle for place in at]
    far = max(ends, key=abs, default=0j)
    straight = bool(far) and all(abs((way / far).imag) * abs(far) < STRAIGHT for way in ends)
    for place, numbers in at.items():
        # beside a straight path all on one side, outside of a curved one
        away = -slider_up(far / abs(far)) if straight else place - middle
        # as of a point, for bare numbers are those of links
        text = f"{scene.words.mark(point)}_{{{','.join(numbers)}}}"
        canvas.label(text, place, prefer=away, clear=scene.style.node + 0.6, height=scene.style.text)


def _ways(scene: Scene, stands: Iterable[Scene]) -> dict[str, tuple[float, float]]:
    """Return by guide of the frame how far its slider stands back and forth of its calculated place, metres."""
    found = {}
    for pair in scene.mechanism.pairs:
        if isinstance(pair, Prismatic) and FRAME in pair.links:
            name, point = scene.solved.guide_name(pair), pair.point
            at, u = scene.solved.point(point), scene.solved.point(name)
            ways = [dot(stand.solved.point(point) - at, u) for stand in stands]
            low, high = scene.runs.get(name, (0.0, 0.0))
            found[name] = min([low, *ways]), max([high, *ways])
    return found


def _notes(scene: Scene, cycle: Cycle, dead: list[float]) -> tuple[str, ...]:
    if not dead:
        return ()
    if cycle.drive.turns:
        places = "; ".join(f"{scene.words.number(math.degrees(angle), 2)}°" for angle in dead)
    else:
        places = "; ".join(f"{scene.words.number(place * 1e3, 2)} {scene.words['unit.mm']}" for place in dead)
    symbol = scene.words.symbol(role(cycle.drive.variable).shown)
    return (scene.words["said.dead"].format(symbol=symbol, places=places),)


def coupler(solved: SolvedLinkage) -> int | None:
    """Return the first link with two joints that is not on the frame: only such a link has a field worth drawing."""
    mechanism = solved.mechanism
    on_frame = {number for pair in mechanism.pairs if FRAME in pair.links for number in pair.links}
    for number in (n for group in solved.structure.groups for n in group.links if n not in on_frame):
        joints = {pair.point for pair in mechanism.pairs if number in pair.links}
        if len(joints) > 1 and solved.values.get(f"omega_{number}"):
            return number
    return None


def _grid(scene: Scene, link: int) -> tuple[int, int]:
    """Return how many columns and rows stand so far apart that arrows have room between them."""
    pitch = PITCH * scene.style.arrow * scene.scales[POSITION].mu
    points = [scene.solved.point(point) for point in scene.mechanism.link(link).points]
    width, height = (float(np.ptp(part)) for part in (np.real(points), np.imag(points)))
    side = max(width, height)
    wanted = ((part + 2.0 * MARGIN * side) / pitch for part in (width, height))
    columns, rows = (max(2, round(min(count, MOST)) + 1) for count in wanted)
    return columns, rows


def field_view(scene: Scene, link: int) -> View:
    """Draw a link with the velocities of a grid of its points, at a scale factor at which they do not cross."""
    canvas = scene.canvas()
    places, velocities = velocity_field(scene.solved, link, *_grid(scene, link))
    per_mm = 1.0 / scene.scales[POSITION].mu
    nearest = min(abs(places[0, 1] - places[0, 0]), abs(places[1, 0] - places[0, 0])) * per_mm
    largest = float(np.max(np.abs(velocities)))
    scale = Scale("mu_V", steps(largest / (APART * nearest))[0], "m/s")
    for at, velocity in zip(places.ravel().tolist(), velocities.ravel().tolist(), strict=True):
        tail, value = at * per_mm, abs(velocity)
        tip = tail + velocity * (1.0 / scale.mu)
        short = abs(tip - tail) < scene.style.arrow
        canvas.add(Circle(tail, 0.3, Pen.THIN, fill="black"))
        head: HeadPlace = "none" if short else "tip"
        canvas.add(Vector(tail, tip, f"v_{link}", value, scale.unit, scale.mu, Pen.THIN, head=head))
    figures = draw_links(canvas, scene, [link], framed=False)
    letter_links(canvas, scene, [link], figures)
    heading = scene.heading("heading.field", POSITION, link=str(link))
    return canvas.finish("field", (*heading, scene.words.scale(scale)))
