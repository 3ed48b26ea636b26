"""Insets: the surroundings of vectors that are too short to be read, enlarged in a frame of their own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from ....plans.board import Step
from ....plans.linkages.chain import hinged
from ....plans.linkages.compound import ACCELERATION, TOTAL, VELOCITY, Coupler
from ....plans.names import FORCES, role, spelled
from ....plans.names import mark as mark_named
from ....plans.names import vector as vector_named
from ....scales.scale import SERIES, Scale
from ...areas import clipped
from ...formats import Style
from ...page import extent
from ...shapes import Circle, Group, Head, Line, Pen, Polyline, Shape, Vector, shifted
from ...text import Box
from ...view import Canvas, View, write_above
from ..calculations.equations import line_of
from ..reading import Edge, meetings
from ..scene import Scene, is_at_point

SHORT, READABLE = 1.25, 1.7  # arrowheads: a shorter vector cannot be read; the least length in an inset
TIMES = tuple(m * 10.0**e for e in range(4) for m in (1, 2, 2.5, 4, 5) if m * 10.0**e > 1)
WIDEST, NARROWEST = 85.0, 60.0  # mm, the largest side of what an inset shows, the least side of the inset
MARGIN, GAP = 10.0, 8.0  # mm around what it shows, and between figure and inset
LEAST_FRAME = 5.0  # mm, the least side of the frame around what an inset shows
TOGETHER = 0.7  # mm within which marks share their letters: side by side they would cover one another
NUMERALS = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X"]
NARROWEST_FORCES = 45.0  # mm, the least side of an inset of forces
ENLARGED = "enlarged"  # the stage of insets: all that a figure has is there before them
PAST = 6.0  # mm by which a construction line runs past the point that it finds
FEW = 1  # forces too short to be read that a plan shows as points, said in words
VELOCITIES, ACCELERATIONS = "compound_velocity", "compound_a_"  # names of the views
PAST_AT_POINT = 8.0  # of those at a point of a coupler


Plan: TypeAlias = "ForcePlan | At"  # plans whose short vectors insets show
Shown: TypeAlias = "tuple[Plan, Window]"


def with_insets(
    canvas: Canvas, name: str, heading: tuple[str, ...], notes: tuple[str, ...], shown: Sequence[Shown]
) -> View:
    """Finish a figure: frame the surroundings of short vectors in it, and put each enlarged beside it."""
    if not shown:
        return canvas.finish(name, heading, notes)
    numerals = [NUMERALS[i % len(NUMERALS)] for i in range(len(shown))]
    hosts = [_host(i, [window for _, window in shown]) for i in range(len(shown))]
    insets = []
    for i, (plan, window) in enumerate(shown):
        framed = [(shown[k][1].box, numerals[k]) for k, host in enumerate(hosts) if host == i]
        insets.append(_inset(plan, window, name, numerals[i], framed))
    canvas.part(ENLARGED)
    for k, host in enumerate(hosts):
        if host is None:
            _framed(canvas, shown[k][1].box, 1.0, f"{name}_{numerals[k]}", numerals[k])
    return _together(canvas.finish(name), insets, heading, notes, canvas.style)


def _host(i: int, shown: Sequence[Window]) -> int | None:
    """Return the inset in which the frame of inset `i` stands: the finest of the coarser ones that show its middle."""
    x0, y0, x1, y1 = shown[i].box
    middle = complex(x0 + x1, y0 + y1) / 2
    coarser = [k for k, window in enumerate(shown) if window.times < shown[i].times and window.shows(middle)]
    return max(coarser, key=lambda k: shown[k].times, default=None)


def _framed(canvas: Canvas, box: Box, times: float, name: str, numeral: str) -> None:
    x0, y0, x1, y1 = (side * times for side in box)
    wide, high = (max(0.0, LEAST_FRAME - size) / 2 for size in (x1 - x0, y1 - y0))
    frame = x0 - wide, y0 - high, x1 + wide, y1 + high
    canvas.add(Polyline(_corners(frame), Pen.THIN, closed=True, role="window", name=name))
    canvas.label(numeral, _corners(frame)[2:], prefer=1j, clear=0.8)


class Window(NamedTuple):
    """What an inset shows: a box of the figure, mm, and how many times it is enlarged."""

    box: Box
    times: float

    def shows(self, *ends: complex) -> bool:
        """Whether points stand in it."""
        x0, y0, x1, y1 = self.box
        return all(x0 <= end.real <= x1 and y0 <= end.imag <= y1 for end in ends)


def windows(plan: Plan) -> list[Window]:
    """Return what the insets of a plan show: short vectors, each with those beside it that find room."""
    vectors = [vector for vector in plan.vectors() if abs(vector.tip - vector.tail) > 1e-6]
    left = [vector for vector in vectors if abs(vector.tip - vector.tail) < SHORT * plan.scene.style.arrow]
    found = []
    while left:
        first = min(left, key=lambda vector: abs(vector.tip - vector.tail))
        window = _window(plan.scene, first, vectors)
        left = [vector for vector in left if vector is not first and not window.shows(vector.tail, vector.tip)]
        found.append(window)
    return found


def _window(scene: Scene, short: Vector, vectors: Sequence[Vector]) -> Window:
    """Choose the enlargement at which a short vector can be read, and take in the vectors that hang on it."""
    least = abs(short.tip - short.tail)
    times = next((m for m in TIMES if least * m >= READABLE * scene.style.arrow), TIMES[-1])
    ends = {short.tail, short.tip}
    for vector in sorted(vectors, key=lambda vector: abs(vector.tip - vector.tail)):
        wider = ends | {vector.tail, vector.tip}
        if _hangs(vector, ends) and max(size_of(wider)) * times <= WIDEST:
            ends = wider
    return window_about(ends, times, NARROWEST)


def window_about(ends: set[complex], times: float, narrowest: float) -> Window:
    """Return a window around points, whose inset has at least the sides `narrowest`, mm."""
    x0, y0, x1, y1 = _box(ends)
    wide, high = (max(MARGIN, (narrowest - size * times) / 2) / times for size in size_of(ends))
    return Window((x0 - wide, y0 - high, x1 + wide, y1 + high), times)


def _hangs(vector: Vector, ends: set[complex]) -> bool:
    return any(abs(end - other) < 1e-6 for end in (vector.tail, vector.tip) for other in ends)


def _box(ends: set[complex]) -> Box:
    xs, ys = [end.real for end in ends], [end.imag for end in ends]
    return min(xs), min(ys), max(xs), max(ys)


def size_of(ends: set[complex]) -> tuple[float, float]:
    """Return width and height of the box of points."""
    x0, y0, x1, y1 = _box(ends)
    return x1 - x0, y1 - y0


def _corners(box: Box) -> tuple[complex, complex, complex, complex]:
    """Return the corners of a box, counter-clockwise; the last two are the upper ones."""
    x0, y0, x1, y1 = box
    return complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1)


def _inset(plan: Plan, window: Window, figure: str, numeral: str, framed: Sequence[tuple[Box, str]]) -> View:
    """Draw what stands in the window, enlarged: vectors to a scale factor of their own, those that leave it cut off."""
    scene, times, (x0, y0, x1, y1), name = plan.scene, window.times, window.box, f"{figure}_{numeral}"
    bounds: Box = (x0 * times, y0 * times, x1 * times, y1 * times)
    canvas = Canvas(scene.style, bounds=bounds)
    for i, (tail, found, end, said) in enumerate(plan.lines()):
        cut, past = (clipped(start * times, end * times, bounds) for start in (tail, found))
        if cut is not None:
            canvas.add(Line(*cut, Pen.DASHED, role="construction", name=f"{name}_{i + 1}"))
        if past is not None and said:
            canvas.label(said, past, clear=0.8)
    named: dict[tuple[complex, complex], dict[str, None]] = {}
    for vector in plan.vectors():
        named.setdefault((vector.tail, vector.tip), {})[scene.letter(vector.quantity)] = None
    for vector in plan.vectors():
        symbols = " = ".join(named.pop((vector.tail, vector.tip), ()))
        _enlarged(canvas, scene, vector, times, bounds, symbols)
    for box, other in framed:
        _framed(canvas, box, times, f"{figure}_{other}", other)
    places = {mark: place * times for mark, place in plan.marks().items()}
    seen = {mark: place for mark, place in places.items() if clipped(place, place, bounds) is not None}
    letters = {mark: scene.words.mark(mark) for mark in seen}
    letter_marks(canvas, scene, letters, seen, [pole for pole in plan.poles() if pole in seen])
    canvas.add(Polyline(_corners(bounds), Pen.THIN, closed=True, role="inset", name=name))
    scale = scene.scales[plan.plan]
    own = Scale(scale.symbol, float(f"{scale.mu / times:.12g}"), scale.unit)
    return canvas.finish(name, (f"{numeral}:  {scene.words.scale(own)}",))


def _enlarged(canvas: Canvas, scene: Scene, vector: Vector, times: float, bounds: Box, name: str) -> None:
    tail, tip = vector.tail * times, vector.tip * times
    cut = clipped(tail, tip, bounds)
    if cut is None or abs(cut[1] - cut[0]) < 1e-6:
        return
    if abs(cut[0] - tail) + abs(cut[1] - tip) < 1e-6:  # the whole of it
        mu = float(f"{vector.mu / times:.12g}")
        enlarged = replace(vector, tail=tail, tip=tip, mu=mu)
        canvas.add(enlarged if abs(tip - tail) >= scene.style.arrow else replace(enlarged, head="none"))
    else:
        parts: list[Shape] = [Line(*cut, Pen.MAIN)]
        if abs(cut[1] - tip) < 1e-6:
            parts.append(Head(tip, tip - tail))
        canvas.add(Group(tuple(parts), "cut", vector.quantity))
    if name:
        canvas.label(name, cut, clear=0.9, strict=True)


def _together(
    figure: View, insets: Sequence[View], heading: tuple[str, ...], notes: tuple[str, ...], style: Style
) -> View:
    """Put the insets to the right of a figure, or under it, whichever takes less room; the heading over all."""
    ways = ([*figure.shapes, *_placed(figure.box, insets, right)] for right in (True, False))
    shapes = min(ways, key=lambda shapes: _area(extent(shapes)))
    x0, y0, x1, y1 = write_above(shapes, heading, notes, style)
    parts = (*figure.parts, *(ENLARGED for _ in insets))
    parts = (*parts, *("" for _ in shapes[len(parts) :]))
    return View(figure.name, tuple(shapes), (x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0), heading, notes, parts=parts)


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _placed(figure: Box, insets: Sequence[View], right: bool) -> Iterator[Group]:
    x0, y0, x1, _ = figure
    x, y = (x1 + GAP, y0) if right else (x0, y0 - GAP)
    for inset in insets:
        width, height = inset.size
        corner = complex(x - inset.box[0], y - inset.box[1] - (0.0 if right else height))
        yield Group(tuple(shifted(shape, corner) for shape in inset.shapes), ENLARGED, inset.name)
        x, y = (x, y + height + GAP) if right else (x + width + GAP, y)


class ForcePlan(NamedTuple):
    """A plan of forces; its insets show what is too short for an arrowhead, where that is more than one force."""

    scene: Scene
    plan: str

    def vectors(self) -> Iterator[Vector]:
        """Go through the forces that can be read on the plan or in an inset."""
        least = READABLE * self.scene.style.arrow / self._times()[-1]
        vectors = map(self.scene.vector, dict.fromkeys(self.scene.reading.on(self.plan)))
        return (vector for vector in vectors if abs(vector.tip - vector.tail) >= least)

    def lines(self) -> Iterator[tuple[complex, complex, complex, str]]:
        """Go through the construction lines, of which nothing is said."""
        lines = meetings(self.scene.program.on(self.plan))
        return ((*construction_line(self.scene, step, start, along), "") for step, _, start, along in lines)

    def marks(self) -> Mapping[str, complex]:
        """Return the places of the pole and of all ends of forces."""
        ends = (edge.tip for edge in self.scene.reading.on(self.plan))
        return {mark: self.scene.mm(mark) for mark in (*self.poles(), *ends)}

    def poles(self) -> Sequence[str]:
        """Return the pole."""
        return [step.name for step in self.scene.program.on(self.plan) if step.verb == "pole"]

    def windows(self) -> list[Window]:
        """Return what the insets show, the coarser ones first; none where a single force is too short."""
        short = self._short(1.0)
        found, left = list[Window](), _clusters(short) if len(short) > FEW else []
        while left:
            cluster = left.pop(0)
            window = self._window(cluster)
            found.append(window)
            finer = [vector for vector in cluster if vector in self._short(window.times)]
            left += _clusters(finer) if len(finer) < len(cluster) or window.times < self._times()[-1] else []
        return found

    def _short(self, times: float) -> list[Vector]:
        return [v for v in self.vectors() if abs(v.tip - v.tail) * times < self.scene.style.arrow]

    def _window(self, cluster: Sequence[Vector]) -> Window:
        """Return the window for forces that hang together, as large as they are readable or as an inset may be."""
        ends, times = {end for vector in cluster for end in (vector.tail, vector.tip)}, self._times()
        least = min(abs(vector.tip - vector.tail) for vector in cluster)
        readable = next((m for m in times if least * m >= READABLE * self.scene.style.arrow), times[-1])
        fitting = [m for m in times if max(size_of(ends)) * m <= WIDEST] or times[:1]
        return window_about(ends, min(readable, fitting[-1]), NARROWEST_FORCES)

    def _times(self) -> Sequence[float]:
        """Return the enlargements whose scale factors are of the customary series; all, where there are none."""
        mu = self.scene.scales[self.plan].mu
        return [m for m in TIMES if float(f"{mu / m:e}".partition("e")[0]) in SERIES] or TIMES

    def said(self, shown: Sequence[Window]) -> Iterator[str]:
        """Say which forces stand in which inset."""
        for numeral, window in zip(NUMERALS, shown, strict=False):
            readable = (vector.quantity for vector in self.vectors() if _seen(self.scene, window, vector))
            if symbols := dict.fromkeys(map(self.scene.letter, readable)):
                yield self.scene.words["said.inset"].format(vectors=", ".join(symbols), inset=numeral)


def enlarged(scene: Scene, quantity: str, plan: str) -> float:
    """Return how many times as large as on its plan a force can be read in an inset, 1 where it is in none."""
    if role(plan).kind != FORCES:
        return 1.0
    shown = (forces := ForcePlan(scene, plan)).windows()
    own = [vector for vector in forces.vectors() if vector.quantity == quantity] if shown else []
    return min((w.times for w in shown if any(_seen(scene, w, v) for v in own)), default=1.0)


def _seen(scene: Scene, window: Window, vector: Vector) -> bool:
    """Whether a vector too short for an arrowhead on its plan can be read in a window."""
    ends, long = (vector.tail, vector.tip), abs(vector.tip - vector.tail) * window.times >= scene.style.arrow
    return long and in_inset(scene, [window], ends)


def _clusters(vectors: Sequence[Vector]) -> list[list[Vector]]:
    clusters: list[list[Vector]] = []
    for vector in vectors:
        ends = {vector.tail, vector.tip}
        own = [c for c in clusters if any(_hangs(other, ends) for other in c)]
        clusters = [c for c in clusters if c not in own] + [[*(v for c in own for v in c), vector]]
    return clusters


def in_inset(scene: Scene, shown: Sequence[Window], ends: tuple[complex, complex]) -> bool:
    """Whether a vector is too short to be read in its figure and stands in an inset."""
    short = abs(ends[1] - ends[0]) < scene.style.arrow
    return short and any(window.shows(*ends) for window in shown)


def construction_line(scene: Scene, step: Step, start: str, direction: str) -> tuple[complex, complex, complex]:
    """Return whence a line of a meeting runs, the point that it finds, and its end past it."""
    e, tail, found = scene.solved.point(direction), scene.mm(start), scene.mm(step.name)
    along = ((found - tail) / e).real
    if abs(along) < PAST:
        return found - e * 2 * PAST, found, found + e * 2 * PAST
    return tail, found, found + e * PAST if along > 0 else found - e * PAST


def letter_marks(
    canvas: Canvas, scene: Scene, letters: Mapping[str, str], places: Mapping[str, complex], poles: Sequence[str]
) -> None:
    """Draw poles and points with their letters outside of the figure; marks that coincide share one letter."""
    if not places:
        return
    middle, at = sum(places.values()) / len(places), dict[complex, list[str]]()
    for mark in letters:
        near = next((place for place in at if abs(place - places[mark]) < TOGETHER), places[mark])
        at.setdefault(near, []).append(mark)
    for mark in poles:
        canvas.part(mark)
        canvas.add(scene.point(places[mark], mark))
    for place, marks in at.items():
        canvas.part(scene.last(canvas.parts.get(mark, mark) for mark in marks))
        canvas.label(", ".join(letters[mark] for mark in marks), place, prefer=place - middle, clear=1.0, priority=1)
    for mark in letters:
        if mark not in poles:
            canvas.part(mark)
            canvas.add(Group((Circle(places[mark], 0.3, Pen.THIN, fill="black"),), "point", mark))


class At(NamedTuple):
    """The vectors of one point of a coupler: the plan drawn there, and where the point stands."""

    scene: Scene
    coupler: Coupler
    point: str
    kind: str  # "V" or "a"

    @property
    def letter(self) -> str:
        """The point's letter in the names of its parts."""
        return self.coupler.letters[self.point]

    @property
    def plan(self) -> str:
        """The plan at the point."""
        return spelled(VELOCITY if self.kind == "V" else ACCELERATION, self.letter)

    def vectors(self) -> Iterator[Vector]:
        """Go through the vectors as they were drawn, the total last, each with the name of the quantity it shows."""
        edges, (n, end) = [*self.scene.reading.on(self.plan)], (mark_named(self.plan, k) for k in ("n", self.letter))
        if n in self.scene.solved.values:
            edges.append(Edge(vector_named("a", self.point, part="t"), n, end))
        total = vector_named(self.kind, self.letter, part=TOTAL).size
        for edge in sorted(edges, key=lambda edge: edge.name == total):
            plain = vector_named(self.kind, self.point) if edge.name == total else edge.name
            yield self.scene.vector(replace(edge, name=plain), at=self.scene.mm(self.point))

    def drawn_with(self, quantity: str) -> str:
        """Return the step that draws the vector of a quantity; what the closed figure shows has steps of its own."""
        edges = (edge for edge in self.scene.reading.on(self.plan) if edge.name == quantity)
        return next(map(self.scene.reading.drawn_with, edges), quantity)

    def lines(self) -> Iterator[tuple[complex, complex, complex, str]]:
        """Go through the construction lines: whence, the point that they find, their end, their direction in words."""
        for step, _, start, direction in meetings(self.scene.program.on(self.plan)):
            at, e = self.scene.mm(self.point), self.scene.solved.point(direction)
            tail, end = (self.scene.mm(mark) + at for mark in (start, step.name))
            sense = 1.0 if ((end - tail) / e).real >= 0 else -1.0
            yield tail, end, end + e * sense * PAST_AT_POINT, line_of(self.scene, direction).replace(" ", "")

    def marks(self) -> Mapping[str, complex]:
        """Return where the point itself stands."""
        return {self.point: self.scene.mm(self.point)}

    def poles(self) -> Sequence[str]:
        """Return the point: its vectors begin there."""
        return (self.point,)


def figures_of(scene: Scene) -> dict[str, tuple[At, ...]]:
    """Return the points whose vectors the figures of compound motion show, by the name of the view."""
    solved = scene.solved
    if not any(is_at_point(plan) and plan in scene.scales for plan in solved.program.plans):
        return {}
    points = [(c, point) for c in hinged(solved.mechanism, solved.structure) for point in c.letters]
    found = {VELOCITIES: tuple(At(scene, c, point, "V") for c, point in points)}
    return found | {f"{ACCELERATIONS}{c.letters[point]}": (At(scene, c, point, "a"),) for c, point in points}
