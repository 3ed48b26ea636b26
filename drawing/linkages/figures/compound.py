"""Compound motion drawn at the points themselves, with the mechanism to scale.

One figure shows the velocities of all points, one the accelerations of each. Links are thin here, so that the vectors
stand out; what is too short to be read stands once more in an inset, enlarged. At every point of a coupler its parts
are hung on one another.

Source: Bertyaev and others, Mechanics: course works with Mathcad, figs. 13-16.
"""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ....plans.board import POSITION
from ....plans.linkages.chain import hinged
from ....plans.linkages.compound import ACCELERATION, TOTAL, VELOCITY, Coupler
from ....plans.names import mark, spelled
from ....plans.names import vector as named
from ...figure import ANSWERS
from ...shapes import Arrow, Line, Pen, Shape, Vector, changed
from ...symbols import clear_ray, turning_arrow, unit
from ...view import Canvas, View
from ..reading import Edge
from ..scene import Scene, is_at_point, line_of
from . import plan as plans
from .links import Skeleton, draw_links, pins_of, rays_at, rays_of
from .plan import ConstructionLine, Plan, Window, headed, length_of, with_insets
from .scheme import free_arc

SIZES, SPREAD, UP = (0.5, 0.75, 1.0), 1.2, 0.5 * math.pi  # of arcs of turning: radii beyond the joint in arrows, angles
FAR = 0.75  # part of the mechanism's size within which an instant centre is drawn
SHORT, NARROWEST = 1.05, 60.0  # arrowheads: a shorter vector cannot be read; mm, the least side of an inset
VELOCITIES, ACCELERATIONS = "compound_velocity", "compound_a_"  # names of the views


@dataclass(frozen=True, slots=True)
class At(Plan):
    """The vectors of one point of a coupler, `kind` "V" or "a": the plan drawn there."""

    coupler: Coupler
    point: str
    kind: str

    @classmethod
    def of(cls, scene: Scene, coupler: Coupler, point: str, kind: str) -> At:
        """Return the plan of the velocities or of the accelerations at a point."""
        plan = spelled(VELOCITY if kind == "V" else ACCELERATION, coupler.letters[point])
        return cls(scene, plan, coupler, point, kind)

    @property
    def letter(self) -> str:
        """The point's letter in the names of its parts."""
        return self.coupler.letters[self.point]

    @property
    def place(self) -> complex:
        """Where the point stands, mm."""
        return self.scene.mm(self.point)

    def vectors(self) -> Iterator[Vector]:
        """Go through the vectors as they were drawn, the total last, each with the name of the quantity it shows."""
        edges, (n, end) = [*self.scene.reading.on(self.plan)], (mark(self.plan, k) for k in ("n", self.letter))
        if n in self.scene.values:
            edges.append(Edge(named("a", self.point, part="t"), n, end))
        total = named(self.kind, self.letter, part=TOTAL).size
        for edge in sorted(edges, key=lambda edge: edge.name == total):
            plain = named(self.kind, self.point) if edge.name == total else edge.name
            yield self.scene.vector(replace(edge, name=plain), at=self.place)

    def edges(self) -> Sequence[Edge]:
        """Return no vectors: their ends have no letters."""
        return ()

    def lines(self) -> Iterator[ConstructionLine]:
        """Go through the construction lines, which are lettered with their directions."""
        for step, _, start, direction in self.scene.reading.meetings(self.plan):
            tail, end = (self.scene.mm(mark) + self.place for mark in (start, step.name))
            e = self.scene.solved.point(direction)
            sense = 1.0 if ((end - tail) / e).real >= 0 else -1.0
            yield tail, end, end + e * sense * plans.PAST, line_of(self.scene, direction)

    def marks(self) -> Mapping[str, complex]:
        """Return where the point itself stands."""
        return {self.point: self.place}

    def poles(self) -> list[str]:
        """Return the point: its vectors begin there."""
        return [self.point]

    def windows(self) -> list[Window]:
        """Return what the inset shows: as many short vectors as one of them, enlarged to be read, has beside it."""
        arrow, widest, windows = self.scene.style.arrow, plans.WIDEST * self.scene.style.label, list[Window]()
        vectors = sorted((v for v in self.vectors() if length_of(v) > 1e-6), key=length_of)
        for short in (v for v in vectors if length_of(v) < SHORT * arrow):
            if any(window.shows(short.tail, short.tip) for window in windows):
                continue
            times = next((m for m in plans.TIMES if length_of(short) * m >= plans.READABLE * arrow), plans.TIMES[-1])
            ends = {short.tail, short.tip}
            for other in vectors:
                wider = ends | {other.tail, other.tip}
                if plans.hangs(other, ends) and max(plans.size_of(wider)) * times <= widest:
                    ends = wider
            windows.append(Window.about(ends, times, NARROWEST))
        small = [v for v in vectors if length_of(v) < SHORT * arrow]
        return sorted(windows, key=lambda window: -sum(window.shows(v.tail, v.tip) for v in small))[:1]


def figures_of(scene: Scene) -> dict[str, list[At]]:
    """Return the points whose vectors the figures of compound motion show, by the name of the view."""
    solved = scene.solved
    if not any(is_at_point(plan) and plan in scene.scales for plan in solved.program.plans):
        return {}
    points = [(c, point) for c in hinged(solved.mechanism, solved.structure) for point in c.letters]
    by_view = {VELOCITIES: [At.of(scene, c, point, "V") for c, point in points]}
    return by_view | {f"{ACCELERATIONS}{c.letters[point]}": [At.of(scene, c, point, "a")] for c, point in points}


def velocity_figure(scene: Scene, couplers: Sequence[Coupler]) -> View:
    """Draw v = v^e + v^r at every point of the couplers, instant centres with their rays, and all rates of turning."""
    canvas = scene.canvas()
    figures = _mechanism(canvas, scene, scene.numbers)
    points = [At.of(scene, c, point, "V") for c in couplers for point in c.letters]
    shown = {at.point for at in points}  # a hinge may be a point of another coupler, which shows its velocity
    for hinge in dict.fromkeys(c.hinge for c in couplers if c.hinge not in shown):
        canvas.part(ANSWERS)
        edge = Edge(f"V_{hinge}", "velocity.p", f"velocity.{hinge}")
        _vector(canvas, scene, scene.vector(edge, at=scene.mm(hinge)))
    windows = _at_points(canvas, points)
    beyond = [note for c in couplers for note in _instant_centre(canvas, scene, c, figures)]
    for c in couplers:
        _turn(canvas, scene, c.omega_e, c.pivot)
        _turn(canvas, scene, f"omega_r_{c.number}", c.hinge)
    heading = scene.heading("heading.compound_velocity", POSITION, points[0].plan)
    return with_insets(canvas, VELOCITIES, heading, (*beyond, *_zeros(points), *_enlarged(windows)), windows)


def acceleration_figure(scene: Scene, coupler: Coupler, point: str) -> View:
    """Draw the accelerations of one point of a coupler: the chain of its parts, closed by the absolute one.

    An arrow shows the sense of the relative velocity, which turned by 90 degrees gives that of Coriolis; it leaves the
    point or ends at it, on the side where there is more room.
    """
    canvas, at = scene.canvas(), At.of(scene, coupler, point, "a")
    group = next(g for g in scene.solved.structure.groups if coupler.number in g.links)
    # the link that carries the coupler, itself, the other of its group
    figures = _mechanism(canvas, scene, sorted({coupler.carrier.number, *group.links}))
    windows, name = _at_points(canvas, [at]), f"V_{at.letter}_r"
    if e := scene.direction(name):
        lines = rays_at(at.place, figures) + rays_of(at.place, ((v.tail, v.tip) for v in at.vectors()))
        side = clear_ray(e, lines)
        near, far = (at.place + side * (scene.style.pair + out) for out in (0.0, 0.6 * scene.style.force))
        canvas.part(ANSWERS, Arrow(*((near, far) if side == e else (far, near)), name=name))
        canvas.label(scene.letter(name), ((near + far) / 2, far), clear=0.9)
    for rate in (coupler.omega_e, coupler.epsilon_e):
        _turn(canvas, scene, rate, coupler.pivot)
    for kind in ("omega", "epsilon"):
        _turn(canvas, scene, f"{kind}_r_{coupler.number}", coupler.hinge)
    heading = scene.heading("heading.compound_acceleration", POSITION, at.plan, point=scene.words.mark(point))
    return with_insets(canvas, f"{ACCELERATIONS}{at.letter}", heading, (*_zeros([at]), *_enlarged(windows)), windows)


def _zeros(points: Sequence[At]) -> Iterator[str]:
    """Say which vectors are zero."""
    for scene, vector in ((at.scene, vector) for at in points for vector in at.vectors()):
        if length_of(vector) < 1e-6:
            yield scene.words["said.zero"].format(vector=scene.letter(vector.quantity))


def _enlarged(windows: Sequence[tuple[At, Window]]) -> Iterator[str]:
    """Say which vectors have their letters in a detail."""
    for at, window in windows:
        shown = [v for v in at.vectors() if window.shows(v.tail, v.tip) and length_of(v) > 1e-6]
        yield plans.said_enlarged(at.scene.words, (at.scene.letter(vector.quantity) for vector in shown))


def _mechanism(canvas: Canvas, scene: Scene, numbers: Sequence[int]) -> list[Skeleton]:
    start, style = len(canvas.shapes), scene.style
    figures = draw_links(canvas, scene, numbers)
    drawn = canvas.shapes[start:]
    canvas.shapes[start:] = [changed(shape, _thin) for shape in drawn]
    joints = {point for number in numbers for point in pins_of(scene, number)}
    blocks = [block.at for figure in figures for block in figure.blocks]
    for point in dict.fromkeys(p for number in numbers for p in scene.mechanism.link(number).points):
        at = scene.mm(point)
        canvas.part(point)
        if point not in joints:
            canvas.add(scene.point(at, point))
        in_block = point in joints and any(abs(block - at) < style.pair for block in blocks)
        rim = style.slider[1] / 2 if in_block else style.pair if point in joints else style.node
        canvas.label(scene.words.mark(point), at, clear=rim + 0.8, priority=1)
    return figures


def _thin(shape: Shape) -> Shape:
    return replace(shape, pen=Pen.THIN) if isinstance(shape, Line) and shape.pen is Pen.MAIN else shape


def _at_points(canvas: Canvas, points: Sequence[At]) -> list[tuple[At, Window]]:
    """Draw the arms, the construction lines and the vectors at points; return the insets, where some have letters."""
    for at in points:
        start, end, rim = at.scene.mm(at.coupler.pivot), at.place, at.scene.style.pair
        if abs(end - start) > 4 * rim:
            e, name = unit(end - start), f"l_{at.coupler.pivot}{at.point}"
            canvas.part(name, Line(start + e * rim, end - e * rim, Pen.AXIS, role="measured", name=name))
    shown = {at.plan: at.windows() for at in points}
    for at in points:
        canvas.part(mark(at.plan, at.letter))
        for i, (tail, point, end, text) in enumerate(at.lines()):
            canvas.thin("construction", f"{at.plan}_{i + 1}", tail, end)
            if not any(window.shows(point) for window in shown[at.plan]):
                plans.name_line(canvas, text, tail, point, end)
    for at in points:
        reading = at.scene.reading
        # what the closed figure shows has steps of its own
        drawn_with = {edge.name: reading.drawn_with(edge) for edge in reversed(reading.on(at.plan))}
        for vector in at.vectors():
            canvas.part(drawn_with.get(vector.quantity, vector.quantity))
            seen = any(window.shows(vector.tail, vector.tip) for window in shown[at.plan])
            _vector(canvas, at.scene, vector, lettered=not seen)
    return [(at, window) for at in points for window in shown[at.plan]]


def _vector(canvas: Canvas, scene: Scene, vector: Vector, lettered: bool = True) -> None:
    canvas.add(headed(vector, scene.style.arrow))
    if lettered and length_of(vector) > 1e-6:
        canvas.label(scene.letter(vector.quantity), (vector.tail, vector.tip), clear=0.9, strict=True)


def _instant_centre(canvas: Canvas, scene: Scene, c: Coupler, figures: Sequence[Skeleton]) -> Iterator[str]:
    """Mark the instant centre and the rays to it; say in words that it lies far away, or nowhere."""
    symbol, ends = scene.words.symbol(c.centre), [e for figure in figures for stroke in figure.strokes for e in stroke]
    size = max((abs(a - b) for a in ends for b in ends), default=0.0)
    if not scene.defined(c.centre):
        yield scene.words["said.no_centre"].format(link=scene.link_name(c.number))
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
    canvas.add(scene.point(P, c.centre))
    canvas.label(symbol, P, clear=1.2, priority=1)
    _turn(canvas, scene, f"omega_{c.number}", c.centre)


def _turn(canvas: Canvas, scene: Scene, rate: str, centre: str) -> None:
    value, c, style = scene.values.get(rate), scene.mm(centre), scene.style
    if not value or value != value:
        return
    canvas.part(ANSWERS)
    radii = tuple(style.pair + size * style.force for size in SIZES)
    radius, middle = free_arc(c, radii, SPREAD, UP, canvas.shapes)
    canvas.add(turning_arrow(c, radius, middle, SPREAD, math.copysign(1.0, value), rate))
    canvas.label(scene.words.symbol(rate), c + rect(radius, middle), prefer=rect(1.0, middle), clear=1.2)
