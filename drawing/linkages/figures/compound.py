"""Compound motion drawn at the points themselves: the mechanism to scale, and at each point of a coupler its vectors.

One figure shows the velocities of all points, one the accelerations of each. Links are thin here, so that the vectors
stand out; what is too short to be read stands once more in an inset, enlarged.

Source: Bertyaev and others, Mechanics: course works with Mathcad, figs. 13-16.
"""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ....plans.board import POSITION
from ....plans.linkages.compound import Coupler
from ....plans.names import mark
from ...figure import ANSWERS
from ...shapes import Arrow, Group, Line, Pen, Shape, Vector
from ...symbols import turning_arrow
from ...view import Canvas, View
from ..reading import Edge
from ..scene import Scene
from ..skeleton import Skeleton, Stroke, pins_of
from .inset import At, shown_of, shows, windows, with_insets
from .links import draw_frame, draw_links, foot_of

SIZES = (0.5, 0.75, 1.0)  # radii of arcs of turning beyond the joint, in arrows
FAR = 0.75  # part of the mechanism's size within which an instant centre is drawn


def velocity_figure(scene: Scene, couplers: Sequence[Coupler]) -> View:
    """Draw v = v^e + v^r at every point of the couplers, instant centres with their rays, and all rates of turning."""
    canvas = scene.canvas()
    figures = _mechanism(canvas, scene, [link.number for link in scene.mechanism.links])
    points = [At(scene, c, point, "V") for c in couplers for point in c.letters]
    busy = _busy(scene, points, figures)
    shown = {at.point for at in points}  # a hinge may be a point of another coupler, which shows its velocity
    for hinge in dict.fromkeys(c.hinge for c in couplers if c.hinge not in shown):
        canvas.part(ANSWERS)
        moved = scene.vector(Edge(f"V_{hinge}", "velocity.p", f"velocity.{hinge}"), at=scene.mm(hinge))
        _vector(canvas, scene, moved)
        busy.append((moved.tail, moved.tip))
    for at in points:
        _distance(canvas, scene, at)
    _at_points(canvas, scene, points)
    beyond = [note for c in couplers for note in _instant_centre(canvas, scene, c, figures, busy)]
    for c in couplers:
        _turn(canvas, scene, c.omega_e, c.pivot, busy)
        _turn(canvas, scene, f"omega_r_{c.number}", c.hinge, busy)
    vectors = [vector for at in points for vector in at.vectors()]
    heading = scene.heading("heading.compound_velocity", POSITION, points[0].plan)
    return with_insets(canvas, "compound_velocity", heading, (*beyond, *_said(scene, vectors)), shown_of(points))


def acceleration_figure(scene: Scene, coupler: Coupler, point: str) -> View:
    """Draw the accelerations of one point of a coupler: the chain of its parts, closed by the absolute one."""
    canvas = scene.canvas()
    at = At(scene, coupler, point, "a")
    group = next(g for g in scene.solved.structure.groups if coupler.number in g.links)
    # the link that carries the coupler, itself, the other of its group
    figures = _mechanism(canvas, scene, sorted({coupler.carrier.number, *group.links}))
    _distance(canvas, scene, at)
    _at_points(canvas, scene, [at])
    busy = _busy(scene, [at], figures)
    _sliding_sense(canvas, scene, at, busy)
    for rate in (coupler.omega_e, coupler.epsilon_e):
        _turn(canvas, scene, rate, coupler.pivot, busy)
    for kind in ("omega", "epsilon"):
        _turn(canvas, scene, f"{kind}_r_{coupler.number}", coupler.hinge, busy)
    heading = scene.heading("heading.compound_acceleration", POSITION, at.plan, point=scene.words.mark(point))
    notes = tuple(_said(scene, at.vectors()))
    return with_insets(canvas, f"compound_a_{at.letter}", heading, notes, shown_of([at]))


def _mechanism(canvas: Canvas, scene: Scene, numbers: Sequence[int]) -> list[Skeleton]:
    """Draw links in thin lines, and letter their points."""
    start = len(canvas.shapes)
    figures = draw_links(canvas, scene, numbers)
    draw_frame(canvas, scene, numbers, figures)
    canvas.shapes[start:] = [_thin(shape) for shape in canvas.shapes[start:]]
    joints = {point for number in numbers for point in pins_of(scene, number)}
    centres = [block.at for figure in figures for block in figure.blocks]
    blocks = {p for p in joints if any(abs(centre - scene.mm(p)) < scene.style.pair for centre in centres)}
    for point in dict.fromkeys(p for number in numbers for p in scene.mechanism.link(number).points):
        at = scene.mm(point)
        canvas.part(point)
        if point not in joints:
            canvas.add(scene.point(at, point))
        reach = scene.style.slider[1] / 2 if point in blocks else scene.style.pair
        canvas.label(scene.words.mark(point), at, clear=reach + 0.8, priority=1)
    return figures


def _thin(shape: Shape) -> Shape:
    match shape:
        case Group(shapes=parts):
            return replace(shape, shapes=tuple(_thin(part) for part in parts))
        case Line(pen=Pen.MAIN):
            return replace(shape, pen=Pen.THIN)
    return shape


def _distance(canvas: Canvas, scene: Scene, at: At) -> None:
    """Draw the line from the pivot whose length is measured, from the pivot's circle on."""
    start, end = scene.mm(at.coupler.pivot), scene.mm(at.point)
    rim = scene.style.pair
    if abs(end - start) > 4 * rim:
        e = (end - start) / abs(end - start)
        name = f"l_{at.coupler.pivot}{at.point}"
        canvas.part(name)
        canvas.add(Line(start + e * rim, end - e * rim, Pen.AXIS, role="measured", name=name))


def _at_points(canvas: Canvas, scene: Scene, points: Sequence[At]) -> None:
    """Draw the construction lines and the vectors at the points; what an inset shows has its letters there."""
    for at in points:
        shown = windows(at)
        canvas.part(mark(at.plan, at.letter))
        for i, (tail, found, end, said) in enumerate(at.lines()):
            canvas.add(Line(tail, end, Pen.DASHED, role="construction", name=f"{at.plan}_{i + 1}"))
            if not any(shows(window, (found,)) for window in shown):
                canvas.label(said, (found, end), clear=0.8)
    for at in points:
        shown = windows(at)
        for vector in at.vectors():
            canvas.part(at.drawn_with(vector.quantity))
            seen = any(shows(window, (vector.tail, vector.tip)) for window in shown)
            _vector(canvas, scene, vector, lettered=not seen)


def _vector(canvas: Canvas, scene: Scene, vector: Vector, lettered: bool = True) -> None:
    """Draw a vector with its letter; one too short for an arrowhead is only a line."""
    length = abs(vector.tip - vector.tail)
    canvas.add(replace(vector, head="none") if length < scene.style.arrow else vector)
    if lettered and length > 1e-6:
        symbol = scene.words.symbol(vector.quantity, bar=True)
        canvas.label(symbol, (vector.tail, vector.tip), clear=0.9, strict=True)


def _sliding_sense(canvas: Canvas, scene: Scene, at: At, busy: list[Stroke]) -> None:
    """Show the sense of the relative velocity, which turned by 90 degrees gives that of Coriolis.

    The arrow leaves the point or ends at it, on the side where there is more room.
    """
    name, start, length = f"V_{at.letter}_r", scene.mm(at.point), 0.6 * scene.style.force
    e = scene.direction(name)
    if not e:
        return
    side = e if _room(busy, start + e * length) >= _room(busy, start - e * length) - scene.style.arrow else -e
    near, far = start + side * scene.style.pair, start + side * (length + scene.style.pair)
    tail, tip = (near, far) if side == e else (far, near)
    canvas.part(ANSWERS)
    canvas.add(Arrow(tail, tip, Pen.THIN, name=name))
    canvas.label(scene.words.symbol(name, bar=True), ((near + far) / 2, far), clear=0.9)
    busy.append((near, far))


def _instant_centre(
    canvas: Canvas, scene: Scene, c: Coupler, figures: Sequence[Skeleton], busy: list[Stroke]
) -> Iterator[str]:
    """Mark the instant centre and the rays to it; say in words that it lies far away, or nowhere."""
    symbol = scene.words.symbol(c.centre)
    ends = [end for figure in figures for stroke in figure.strokes for end in stroke]
    size = max((abs(a - b) for a in ends for b in ends), default=0.0)
    if not scene.defined(c.centre):
        yield scene.words["said.no_centre"].format(link=scene.words.ends.get(str(c.number), c.number))
        return
    P = scene.mm(c.centre)
    if min((abs(P - end) for end in ends), default=0.0) > FAR * size:
        yield scene.words["said.far_centre"].format(centre=symbol)
        return
    canvas.part(c.centre)
    for joint in (c.hinge, c.span.end):
        way = P - scene.mm(joint)
        if abs(way) > 2 * scene.style.pair:  # it may stand in the joint itself
            rim = way / abs(way) * scene.style.pair
            canvas.add(Line(scene.mm(joint) + rim, P, Pen.AXIS, role="ray", name=f"{c.centre}_{joint}"))
            busy.append((scene.mm(joint), P))
    canvas.add(scene.point(P, c.centre))
    canvas.label(symbol, P, clear=1.2, priority=1)
    _turn(canvas, scene, f"omega_{c.number}", c.centre, busy)


def _busy(scene: Scene, points: Iterable[At], figures: Sequence[Skeleton]) -> list[Stroke]:
    """Return all strokes near which an arc of turning should not stand."""
    strokes = [stroke for figure in figures for stroke in figure.strokes]
    for pivot in scene.mechanism.frame_points:
        down, (_, height, base) = foot_of(scene, pivot, figures), scene.style.pivot
        ground = scene.mm(pivot) + down * (height + scene.style.pair + scene.style.hatch[0])
        strokes += [(scene.mm(pivot), ground + side * 1j * down * base / 2) for side in (-1, 1)]
    for centre, u, _ in (block for figure in figures for block in figure.blocks):
        length, height = scene.style.slider
        beside = 1j * u * (height / 2 + scene.style.hatch[0])  # the guide is on one of the two sides
        edges = centre, centre - beside, centre + beside
        strokes += [(edge - u * length * 1.1, edge + u * length * 1.1) for edge in edges]
    for at in points:
        strokes += [(vector.tail, vector.tip) for vector in at.vectors()]
        strokes += [(tail, end) for tail, _, end, _ in at.lines()]
        strokes.append((scene.mm(at.coupler.pivot), scene.mm(at.point)))
    return strokes


def _turn(canvas: Canvas, scene: Scene, rate: str, centre: str, busy: list[Stroke]) -> None:
    """Draw the arc of a rate about a joint where there is most room; each arc takes its own place."""
    value = scene.solved.values.get(rate)
    if not value or value != value:
        return
    c, style = scene.mm(centre), scene.style
    canvas.part(ANSWERS)
    places = [(style.pair + size * style.force, k * math.pi / 12) for size in SIZES for k in range(24)]
    # farthest from all strokes, rather a small one
    polar = np.array(places)
    spots = c + polar[:, :1] * np.exp(1j * (polar[:, 1:] + np.array([-0.5, 0.0, 0.5])))
    room = _distances(busy, spots).min(axis=(1, 2), initial=4.0 * polar[:, 0].max()) - 0.1 * polar[:, 0]
    radius, middle = places[int(np.round(room, 3).argmax())]
    spread = 1.1 * SIZES[0] * style.force / (radius - style.pair) + 0.2
    canvas.add(turning_arrow(c, radius, middle, spread, math.copysign(1.0, value), rate))
    canvas.label(scene.words.symbol(rate), c + rect(radius, middle), prefer=rect(1.0, middle), clear=1.2)
    ends = (middle - 0.6 * spread, middle, middle + 0.6 * spread)
    busy += [(c + rect(radius, a), c + rect(radius, b)) for a, b in pairwise(ends)]


def _room(busy: Sequence[Stroke], spot: complex) -> float:
    """Return the distance of a place from the nearest stroke."""
    return float(_distances(busy, np.array(spot)).min(initial=1e9))


def _distances(busy: Sequence[Stroke], spots: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return the distance of each place from each stroke, the strokes along a last axis of their own."""
    a, b = np.array(busy, complex).reshape(-1, 2).T
    way = np.where(b == a, 1.0, b - a)
    along = np.clip(((spots[..., None] - a) / way).real, 0.0, 1.0)
    result: NDArray[np.float64] = abs(spots[..., None] - a - way * along)
    return result


def _said(scene: Scene, vectors: Iterable[Vector]) -> Iterator[str]:
    """Say which vectors are zero."""
    for vector in vectors:
        if abs(vector.tip - vector.tail) < 1e-6:
            yield scene.words["said.zero"].format(vector=scene.letter(vector.quantity))
