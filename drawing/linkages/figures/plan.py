"""A plan of velocities, accelerations or forces: the recorded steps, drawn; what cannot be read there, in insets.

An inset has the surroundings of forces that are too short, or of points that crowd, enlarged, in a frame of its own.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

from ....plans.board import POSITION, Step
from ....plans.boards.exact import ILL, SMALL
from ....plans.names import FORCES, role
from ....plans.quantities import intersections, pins_together, point_of
from ....scales.scale import SERIES, Scale
from ...areas import clipped
from ...page import extent
from ...shapes import Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, shifted
from ...text import Box, symbol
from ...view import EACH, ELSEWHERE, UNNUMBERED, Canvas, View, write_above
from ...words import Words
from ..reading import Edge
from ..scene import Scene, line_of, plan_heading
from .links import NEAR, Stroke

READABLE, EASY = 1.4, 2.5  # arrowheads: the least length of a vector in an inset, and that which holds its letter
# enlargements, those of points that crowd up to the last; what is less than three times as large looks the same
LEAST_TIMES, MOST_TIMES = 3.0, 10.0
TIMES = tuple(m * 10.0**e for e in range(4) for m in (1, 2, 2.5, 4, 5) if m * 10.0**e >= LEAST_TIMES)
WIDEST, NARROWEST = 26.0, 45.0  # the largest side of what an inset shows, in heights of its letters; mm, the least
MARGIN, GAP = 10.0, 8.0  # mm around what it shows, and between figure and inset
OFF = 1.0  # mm between its letters and its frame
NARROW, WIDER = 8.0, 12.0  # mm by which its frame stands farther out where they leave it, at least and at most
LEAST_PLACE = 3.0  # mm, the least radius of the circle around what an inset shows
TOGETHER = 0.7  # mm within which marks share their letters: side by side they would cover one another
EMPTY: Mapping[str, str] = {}
ENLARGED = "enlarged"  # the stage of insets: all that a figure has is there before them
PAST = 10.0  # mm by which a construction line runs past the point that it finds
LONGER = 5.0  # mm by which its name may reach past the end of such a line
LAST = 0.6  # of a vector to and fro: from there on its letter stands beside its head
FEW = 1  # forces too short to be read that a plan shows as points, said in words
ConstructionLine = tuple[complex, complex, complex, str]  # whence, the point that it finds, its end, what is said of it


class Window(NamedTuple):
    """What an inset shows: a box of the figure, mm, and how many times it is enlarged."""

    box: Box
    times: float

    @classmethod
    def about(cls, ends: Collection[complex], times: float, narrowest: float) -> Window:
        """Return a window around points, whose inset has at least the sides `narrowest`, mm."""
        x0, y0, x1, y1 = _box(ends)
        wide, high = (max(MARGIN, (narrowest - size * times) / 2) / times for size in size_of(ends))
        return cls((x0 - wide, y0 - high, x1 + wide, y1 + high), times)

    def grown(self, by: Box) -> Window:
        """Return a window whose inset has its frame so many mm farther out, by sides."""
        (x0, y0, x1, y1), (left, low, right, high) = self.box, (side / self.times for side in by)
        return self._replace(box=(x0 - left, y0 - low, x1 + right, y1 + high))

    def shows(self, *ends: complex) -> bool:
        """Whether points stand in it."""
        x0, y0, x1, y1 = self.box
        return all(x0 <= end.real <= x1 and y0 <= end.imag <= y1 for end in ends)


def _box(ends: Iterable[complex]) -> Box:
    xs, ys = zip(*((end.real, end.imag) for end in ends), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def size_of(ends: Iterable[complex]) -> tuple[float, float]:
    """Return width and height of the box of points."""
    x0, y0, x1, y1 = _box(ends)
    return x1 - x0, y1 - y0


def length_of(vector: Vector) -> float:
    """Return how long a vector is drawn, mm."""
    return abs(vector.tip - vector.tail)


def hangs(vector: Vector, ends: Iterable[complex]) -> bool:
    """Whether a vector begins or ends at one of these places."""
    return any(abs(end - other) < 1e-6 for end in (vector.tail, vector.tip) for other in ends)


def headed(vector: Vector, least: float) -> Vector:
    """Return a vector without its arrowhead where it is shorter than the `least` length."""
    return replace(vector, head="none") if length_of(vector) < least else vector


def told_apart(vectors: Iterable[Vector]) -> Iterator[Vector]:
    """Go through vectors; of two to and fro between two places the second has its head in the middle.

    A line with a head at both ends would be read as a dimension.
    """
    seen = set[tuple[complex, ...]]()
    for vector in vectors:
        ends = _places(vector.tail, vector.tip)
        yield replace(vector, head="middle") if ends[::-1] in seen and ends not in seen else vector
        seen.add(ends)


def _places(*ends: complex) -> tuple[complex, ...]:
    """Return places as they are compared: two marks in one place may differ by rounding."""
    return tuple(complex(round(at.real, 3), round(at.imag, 3)) for at in ends)


def own_part(vector: Vector, others: Iterable[Vector], least: float) -> tuple[complex, complex]:
    """Return the part of a vector beside which its letter stands: all of it, where no other runs along it.

    It is where it goes on past shorter ones, if only by the `least` length, mm; of two to and fro that about its head.
    """
    along, opposed = vector.tip - vector.tail, False
    covered, free, spans = 0.0, list[tuple[float, float]](), [(1.0, 1.0)]
    for other in others:
        feet = [(end - vector.tail) / along for end in (other.tail, other.tip)]
        if max(abs(foot.imag) for foot in feet) * abs(along) < NEAR:
            opposed |= abs(other.tail - vector.tip) + abs(other.tip - vector.tail) < NEAR
            if length_of(other) < length_of(vector) - NEAR:
                low, high = sorted(min(1.0, max(0.0, foot.real)) for foot in feet)
                spans.append((low, high))
    for low, high in sorted(spans):
        free.append((covered, low))
        covered = max(covered, high)
    low, high = max(free, key=lambda part: part[1] - part[0])
    if opposed:
        low, high = (LAST, 1.0) if vector.head == "tip" else (0.5 * LAST, 1.0 - 0.5 * LAST)
    elif (high - low) * abs(along) < least:
        low, high = 0.0, 1.0
    return vector.tail + low * along, vector.tail + high * along


@dataclass(frozen=True, slots=True)
class Plan:
    """A plan; its insets show what is too short for an arrowhead, where that is more than one force."""

    scene: Scene
    plan: str

    def vectors(self) -> Iterable[Vector]:
        """Return the vectors that can be read on the plan or in an inset."""
        least = READABLE * self.scene.style.arrow / self._times[-1]
        vectors = map(self.scene.vector, dict.fromkeys(self.scene.reading.on(self.plan)))
        return (vector for vector in vectors if length_of(vector) >= least)

    def edges(self) -> Sequence[Edge]:
        """Return the vectors between marks that have letters."""
        return self.scene.reading.on(self.plan)

    def lines(self) -> Iterable[ConstructionLine]:
        """Go through the construction lines."""
        for step, _, start, along in self.scene.reading.meetings(self.plan):
            yield (*_construction_line(self.scene, step, start, along), line_of(self.scene, along))

    def marks(self) -> Mapping[str, complex]:
        """Return the places of the pole and of all ends of vectors."""
        ends = (edge.tip for edge in self.scene.reading.on(self.plan))
        return {mark: self.scene.mm(mark) for mark in (*self.poles(), *ends)}

    def poles(self) -> list[str]:
        """Return the mark at which all begins."""
        return [step.name for step in self.scene.program.on(self.plan) if step.verb == "pole"]

    def windows(self) -> list[Window]:
        """Return what the inset shows: as many of the forces that are too short as one enlargement lets be read.

        There is none where a single force is too short.
        """
        return self.scene.once(lambda scene: Plan(scene, self.plan)._windows(), "windows", self.plan)

    def _windows(self) -> list[Window]:
        short = self._short(1.0)
        if role(self.plan).kind != FORCES or len(short) <= FEW:
            return []
        best, most, clusters = list[Window](), [0, 0, 0], _clusters(short)
        for times, first in product(self._times, clusters):
            shown = _together(first, clusters, WIDEST * self.scene.style.label / times)
            arrows = [length_of(vector) * times / self.scene.style.arrow for vector in shown]
            read = [sum(size >= least for size in arrows) for least in (1.0, READABLE, EASY)]
            if read > most:
                best, most = [Window.about(_ends(shown), times, NARROWEST)], read
        return best

    def _short(self, times: float) -> list[Vector]:
        return [vector for vector in self.vectors() if length_of(vector) * times < self.scene.style.arrow]

    @property
    def _times(self) -> Sequence[float]:
        """The enlargements whose scale factors are of the customary series; all, where there are none."""
        mu = self.scene.scales[self.plan].mu
        return [m for m in TIMES if float(f"{mu / m:e}".partition("e")[0]) in SERIES] or TIMES

    def around(self, marks: Collection[str]) -> Window | None:
        """Return what an inset shows where marks crowd: as many of them as one enlargement gives letters in its frame.

        There is none where no mark has its letter there.
        """
        at, best, least = self.marks(), None, len(marks)
        for times in (times for times in self._times if times <= MOST_TIMES):
            widest, shown = WIDEST * self.scene.style.label / times, list[complex]()
            for mark in marks:
                away = sorted((abs(at[other] - at[mark]), other) for other in marks)
                ends = [at[other] for _, other in away]
                near = [end for k, end in enumerate(ends) if max(size_of(ends[: k + 1])) <= widest]
                shown = max(shown, near, key=len)
            for edge in self.edges():  # short vectors whole, as they are near their poles
                tail, tip = at[edge.tail], at[edge.tip]
                if tip in shown and max(size_of([*shown, tail])) <= widest / 2:
                    shown.append(tail)
            window = Window.about(shown, times, NARROWEST)
            view, wider = _roomy(self, window, self.plan, UNNUMBERED[0])
            bad = len(_unlettered(self.scene, marks, view.shapes)) + len(_outside(view, wider))
            if bad < least:
                best, least = window, bad
            if not least:
                break
        return best

    def read_in(self, window: Window) -> Iterator[str]:
        """Go through the quantities whose vectors, too short for an arrowhead on the plan, can be read in a window."""
        for vector in self.vectors():
            long = length_of(vector) * window.times >= SHORT
            if long and _in_inset(self.scene, [window], (vector.tail, vector.tip)):
                yield vector.quantity


def _lettered_in(plan: Plan, windows: Iterable[Window], marks: Iterable[str]) -> Iterator[str]:
    """Go through the marks that have letters in insets."""
    for window in windows:
        view, wider = _roomy(plan, window, plan.plan, UNNUMBERED[0])
        shown = [mark for mark in marks if wider.shows(plan.scene.mm(mark))]
        yield from {*shown}.difference(_unlettered(plan.scene, shown, view.shapes))


def _unlettered(scene: Scene, marks: Iterable[str], shapes: Iterable[Shape]) -> list[str]:
    """Return the marks that have no letter among shapes."""
    texts = (shape.markup for shape in shapes if isinstance(shape, Text) and shape.role == "label")
    letters = {letter for text in texts for letter in text.split(", ")}
    return [mark for mark in marks if symbol(scene.words.mark(mark)) not in letters]


def enlarged(scene: Scene, quantity: str, plan: str) -> float:
    """Return how many times as large as on its plan a force can be read in an inset, 1 where it is in none."""
    forces = Plan(scene, plan)
    return min((window.times for window in forces.windows() if quantity in forces.read_in(window)), default=1.0)


def magnified(scene: Scene) -> dict[str, float]:
    """Return how many times as large as on their plans forces stand in insets, those that can be read there alone."""
    windows = ((Plan(scene, plan), window) for plan in scene.scales for window in Plan(scene, plan).windows())
    return {quantity: window.times for plan, window in windows for quantity in plan.read_in(window)}


def _in_inset(scene: Scene, shown: Iterable[Window], ends: tuple[complex, complex]) -> bool:
    """Whether a vector is too short to be read in its figure and stands in an inset."""
    return abs(ends[1] - ends[0]) < scene.style.arrow and any(window.shows(*ends) for window in shown)


def _clusters(vectors: Sequence[Vector]) -> list[list[Vector]]:
    clusters: list[list[Vector]] = []
    for vector in vectors:
        own = [c for c in clusters if any(hangs(other, (vector.tail, vector.tip)) for other in c)]
        clusters = [c for c in clusters if c not in own] + [[*(v for c in own for v in c), vector]]
    return clusters


def _ends(vectors: Iterable[Vector]) -> set[complex]:
    return {end for vector in vectors for end in (vector.tail, vector.tip)}


def _together(first: list[Vector], clusters: Sequence[list[Vector]], widest: float) -> list[Vector]:
    """Return vectors that hang together, and the nearest others with which they take no more than so many mm."""
    shown = list[Vector]() if max(size_of(_ends(first))) > widest else [*first]
    for other in sorted(clusters, key=lambda c: max(size_of(_ends([*first, *c])))):
        if shown and max(size_of(_ends([*shown, *other]))) <= widest:
            shown += [vector for vector in other if vector not in shown]
    return shown


def with_insets(
    canvas: Canvas,
    name: str,
    heading: tuple[str, ...],
    notes: tuple[str, ...],
    shown: Sequence[tuple[Plan, Window]],
) -> View:
    """Finish a figure: mark the surroundings of short vectors in it with numerals, and put each enlarged beside it.

    The insets stand to the right of the figure, or under it, whichever takes less room; the heading over all.
    """
    if not shown:
        return canvas.finish(name, heading, notes)
    numerals = UNNUMBERED[: len(shown)]
    roomy = [_roomy(*each, name, numeral) for each, numeral in zip(shown, numerals, strict=True)]
    canvas.part(ENLARGED)
    for (inset, ((x0, y0, x1, y1), _)), numeral in zip(roomy, numerals, strict=True):
        radius = max(LEAST_PLACE, abs(complex(x1 - x0, y1 - y0)) / 2)
        canvas.detail(numeral, complex(x0 + x1, y0 + y1) / 2, radius, inset.name)
    figure = canvas.finish(name)
    notes = (*notes, *figure.notes)  # of letters that are left out
    ways = []
    for right in (True, False):
        x, y = (figure.box[2] + GAP, figure.box[1]) if right else (figure.box[0], figure.box[1] - GAP)
        placed = list[Shape](figure.shapes)
        for inset, _ in roomy:
            (width, height), (left, low, *_) = inset.size, inset.box
            corner = complex(x - left, y - low - (0.0 if right else height))
            placed.append(Group(tuple(shifted(shape, corner) for shape in inset.shapes), ENLARGED, inset.name))
            x, y = (x, y + height + GAP) if right else (x + width + GAP, y)
        x0, y0, x1, y1 = extent(placed)
        ways.append(((x1 - x0) * (y1 - y0), placed))
    _, shapes = min(ways, key=lambda way: way[0])
    before = len(shapes)
    x0, y0, x1, y1 = write_above(shapes, heading, notes, canvas.style)
    parts = (*figure.parts, *(ENLARGED for _ in roomy), *("" for _ in shapes[before:]))
    box = x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0
    return replace(figure, shapes=tuple(shapes), box=box, heading=heading, notes=notes, parts=parts)


def _corners(box: Box) -> tuple[complex, complex, complex, complex]:
    """Return the corners of a box, counter-clockwise; the last two are the upper ones."""
    x0, y0, x1, y1 = box
    return complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1)


def _roomy(plan: Plan, window: Window, figure: str, numeral: str) -> tuple[View, Window]:
    """Return an inset and what it shows: more, above all where its letters leave its frame, if fewer leave it then.

    Where that does not help some letters are told in its notes.
    """
    tries = [(_inset(plan, window, figure, numeral), window)]
    for told in (False, True):
        if out := _outside(*tries[-1]):
            x0, y0, x1, y1 = (min(WIDER, max(NARROW, *by)) for by in zip(*out, strict=True))
            wider = window.grown((x0, y0, x1, y1))
            tries.append((_inset(plan, wider, figure, numeral, told), wider))
    return min(tries, key=lambda shown: len(_outside(*shown)))


def _outside(view: View, window: Window) -> list[Box]:
    """Return by how many mm on each side the letters of an inset, those that do, leave its frame."""
    left, low, right, high = (side * window.times for side in window.box)
    letters = (extent((shape,)) for shape in view.shapes if isinstance(shape, Text) and shape.role == "label")
    past = ((left + OFF - x0, low + OFF - y0, x1 + OFF - right, y1 + OFF - high) for x0, y0, x1, y1 in letters)
    return [by for by in past if max(by) > NEAR]


def _inset(plan: Plan, window: Window, figure: str, numeral: str, told: bool = False) -> View:
    """Draw what stands in the window, enlarged: vectors to a scale factor of their own, those that leave it cut off.

    Letters without room beside their vectors are rather `told` in its notes than led far away.
    """
    name = f"{figure}_detail_{UNNUMBERED.index(numeral) + 1}"
    scene, times, (x0, y0, x1, y1) = plan.scene, window.times, window.box
    bounds: Box = (x0 * times, y0 * times, x1 * times, y1 * times)
    lean = 2 * OFF  # of letters, as they stand in no box of theirs
    room = bounds[0] + lean, bounds[1] + lean, bounds[2] - lean, bounds[3] - lean
    canvas, scale = Canvas(scene.style, bounds=room), scene.scales[plan.plan]
    own = Scale(scale.symbol, float(f"{scale.mu / times:.12g}"), scale.unit)
    for i, (tail, point, end, text) in enumerate(plan.lines()):
        cut, past = (clipped(start * times, end * times, bounds) for start in (tail, point))
        if cut is not None:
            canvas.thin("construction", f"{name}_{i + 1}", *cut)
        if past is not None:
            name_line(canvas, text, past[0], *past)
    letters: dict[tuple[complex, complex], dict[str, None]] = {}  # of vectors from one place to another
    for vector in plan.vectors():
        letters.setdefault((vector.tail, vector.tip), {})[scene.letter(vector.quantity)] = None
    edges = plan.edges()
    said = {scene.ends(edge): _ends_of(scene, edge, edges) for edge in edges}
    for vector in told_apart(plan.vectors()):
        tail, tip, names = vector.tail * times, vector.tip * times, letters.pop((vector.tail, vector.tip), ())
        cut = clipped(tail, tip, bounds)
        if cut is None or abs(cut[1] - cut[0]) < 1e-6:
            continue
        if whole := abs(cut[0] - tail) + abs(cut[1] - tip) < 1e-6:
            canvas.add(headed(replace(vector, tail=tail, tip=tip, mu=own.mu), SHORT))
        else:
            parts: list[Shape] = [Line(*cut)]
            parts += [Head(tip, tip - tail)] if abs(cut[1] - tip) < 1e-6 and vector.head == "tip" else []
            canvas.add(Group(tuple(parts), "cut", vector.quantity))
        if names:
            spare = said.get((vector.tail, vector.tip), "")
            bare = f"{spare} = {scene.length(length_of(vector) * times)}" if spare else ""
            soon = ELSEWHERE if not whole else spare if told else ""  # what is cut off has its letter on the plan
            canvas.label(" = ".join(names), cut, clear=0.9, strict=True, spare=soon, last=spare, bare=bare)
    places = {mark: place * times for mark, place in plan.marks().items()}
    seen = {mark: place for mark, place in places.items() if clipped(place, place, bounds) is not None}
    marks, poles = {mark: scene.words.mark(mark) for mark in seen}, [p for p in plan.poles() if p in seen]
    tips = {edge.tip: said[scene.ends(edge)] for edge in reversed(edges)}
    letter_marks(canvas, scene, marks, seen, poles, tips)
    canvas.add(Polyline(_corners(bounds), Pen.THIN, closed=True, role="inset", name=name))
    return canvas.finish(name, (scene.words["heading.detail"].format(numeral=numeral), scene.words.scale(own)))


def _construction_line(scene: Scene, step: Step, start: str, direction: str) -> tuple[complex, complex, complex]:
    """Return whence a line of a meeting runs, the point that it finds, and its end past it."""
    e, tail, point = scene.solved.point(direction), scene.mm(start), scene.mm(step.name)
    along = ((point - tail) / e).real
    if abs(along) < PAST:
        return point - e * 2 * PAST, point, point + e * 2 * PAST
    return tail, point, point + e * PAST if along > 0 else point - e * PAST


def name_line(canvas: Canvas, text: str, tail: complex, point: complex, end: complex, last: str = "") -> None:
    """Say along a construction line what it is, past the point that it finds, or before it where there is no room.

    At `last` that is said in the notes.
    """
    if abs(end - point) > NEAR:
        beyond = end + (end - point) * (LONGER / abs(end - point))
        mark, before = text.replace(" ", ""), (tail, point) if abs(point - tail) > NEAR else None
        small = canvas.style.text
        canvas.label(mark, (point, beyond), clear=0.6, height=small, optional=True, other=before, last=last)


def letter_marks(
    canvas: Canvas,
    scene: Scene,
    letters: Mapping[str, str],
    places: Mapping[str, complex],
    poles: Collection[str],
    said: Mapping[str, str] = EMPTY,
) -> None:
    """Draw poles and points with their letters outside of the figure; marks that coincide share one letter.

    Of some it is `said` in the notes, or elsewhere, which they are, if there is no room for their letters; those whose
    letters are blank have none.
    """
    if not places:
        return
    middle, at = sum(places.values()) / len(places), dict[complex, list[str]]()
    for mark in filter(letters.get, letters):
        near = next((place for place in at if abs(place - places[mark]) < TOGETHER), places[mark])
        at.setdefault(near, []).append(mark)
    for mark in poles:
        canvas.part(mark, scene.point(places[mark], mark))
    for place, marks in at.items():
        stages = [canvas.parts.get(mark, mark) for mark in marks]
        begun = [mark for mark, stage in zip(marks, stages, strict=True) if stage == stages[0]]
        first = (", ".join(letters[m] for m in begun), stages[0]) if len(begun) < len(marks) else None
        canvas.part(scene.last(stages))
        texts = dict.fromkeys(said.get(mark, "") for mark in marks)
        last, text = next(iter(texts)) if len(texts) == 1 else "", ", ".join(letters[m] for m in marks)
        clear = 1.0 + (canvas.style.node if any(mark in poles for mark in marks) else 0.0)
        canvas.label(text, place, prefer=place - middle, clear=clear, priority=1, last=last, first=first)
    for mark in letters:
        if mark not in poles:
            canvas.part(mark, Group((Circle(places[mark], 0.3, Pen.THIN, fill="black"),), "point", mark))


SHORT = 2.0  # mm below which a vector cannot be drawn as an arrow
LARGE = 1e4  # above it a number is written with a power of ten


def plan_view(scene: Scene, plan: str) -> View:
    """Draw a plan from the steps that made it: construction lines, vectors, letters.

    An inset has forces that are too short, or points that crowd on a plan without such forces.
    """
    shown = Plan(scene, plan).windows()
    view, marks = _drawn(scene, plan, shown, ())
    if shown or not (gone := _unlettered(scene, marks, view.shapes)):
        return view
    window = Plan(scene, plan).around(gone)
    if window is None:
        return view
    return _drawn(scene, plan, [window], [mark for mark in gone if window.shows(scene.mm(mark))])[0]


def _drawn(scene: Scene, plan: str, shown: Sequence[Window], crowd: Collection[str]) -> tuple[View, Sequence[str]]:
    """Draw a plan with insets, which have the letters of a `crowd` of marks; return it, and all marks with letters."""
    canvas, words = scene.canvas(), scene.words
    vectors, forces = scene.reading.on(plan), Plan(scene, plan)
    short_ones = () if crowd else shown
    left = [edge for edge in vectors if not _in_inset(scene, short_ones, scene.ends(edge))]
    for step, number, start, direction in scene.reading.meetings(plan):
        begin, point, end = _construction_line(scene, step, start, direction)
        canvas.part(step.name, Line(begin, end, Pen.THIN, role="construction", name=f"{step.name}_{number}"))
        line = line_of(scene, direction)
        name_line(canvas, line, begin, point, end, f"{words.mark(start)}{words.mark(step.name)} {line}")
    draw_sides(canvas, scene, plan, map(scene.ends, vectors))
    within = {scene.ends(edge) for edge in vectors if crowd and shown[0].shows(*scene.ends(edge))}
    _vectors(canvas, scene, vectors, left, within)
    ends, poles = {mark for edge in left for mark in (edge.tail, edge.tip)}, forces.poles()
    marks = *poles, *(edge.tip for edge in vectors if edge.tip in ends)
    said = {edge.tip: _ends_of(scene, edge, vectors) for edge in reversed(left)}
    places = {m: scene.mm(m) for m in marks}
    # the plan letters no point again that its inset does, but for the pole
    inset = {*crowd, *_lettered_in(forces, short_ones, [m for m in marks if m not in poles])}
    letter_marks(canvas, scene, {m: words.mark(m) * (m not in inset) for m in marks}, places, poles, said)
    notes = [*said_flat(scene, plan)]
    read = {quantity for window in short_ones for quantity in forces.read_in(window)}
    short = [v for v in map(scene.vector, dict.fromkeys(vectors)) if length_of(v) < SHORT and v.quantity not in read]
    lengths = {scene.letter(vector.quantity): length_of(vector) for vector in short}
    notes += [words["said.zero"].format(vector=letter) for letter, length in lengths.items() if length < 1e-6]
    said_short = [f"{letter} ({words.number(mm, 2)})" for letter, mm in lengths.items() if mm >= 1e-6]
    for i in range(0, len(said_short), EACH):
        notes.append(words["said.short"].format(vectors=", ".join(said_short[i : i + EACH])))
    for window in shown:
        inside = map(words.mark, crowd) if crowd else map(scene.letter, forces.read_in(window))
        if symbols := dict.fromkeys(inside):
            notes.append(said_enlarged(words, symbols))
    heading = plan_heading(words, scene.solved.structure, plan), words.scale(scene.scales[plan])
    return with_insets(canvas, plan, heading, tuple(notes), [(forces, window) for window in shown]), marks


def _vectors(
    canvas: Canvas,
    scene: Scene,
    vectors: Sequence[Edge],
    lettered: Sequence[Edge],
    within: Collection[tuple[complex, complex]],
) -> None:
    """Draw vectors with their names; an inset has those `within` it, where these have no room."""
    named, drawn = set[frozenset[complex]](), [*told_apart(map(scene.vector, vectors))]
    for edge, vector in zip(vectors, drawn, strict=True):
        canvas.part(scene.reading.drawn_with(edge))
        canvas.add(headed(vector, SHORT))  # else an arrowhead would be longer than the vector
        names = list(dict.fromkeys(other.name for other in vectors if (other.tail, other.tip) == (edge.tail, edge.tip)))
        # others are told in words under the heading, lettered in an inset, or beside the first of them
        if length_of(vector) < SHORT or edge not in lettered or edge.name != names[0]:
            continue
        across = 1j * (vector.tip - vector.tail)
        ends = _places(vector.tail, vector.tip)
        # the first of two vectors on one line has its letter above it or to the right
        side = (-across if (across / (0.3 + 1j)).real > 0 else across) if frozenset(ends) in named else 0j
        named.add(frozenset(ends))
        text = " = ".join(map(scene.letter, names))
        spare = ELSEWHERE if scene.ends(edge) in within else _ends_of(scene, edge, vectors)
        bare = f"{spare} = {scene.length(length_of(vector))}"
        at = own_part(vector, drawn, 2.0 * scene.style.label)
        canvas.label(text, at, prefer=side, clear=0.9, strict=True, spare=spare, bare=bare)


def _ends_of(scene: Scene, edge: Edge, vectors: Sequence[Edge]) -> str:
    """Say by the letters of its ends which vector is drawn there."""
    names = dict.fromkeys(other.name for other in vectors if (other.tail, other.tip) == (edge.tail, edge.tip))
    return " = ".join([*map(scene.letter, names), scene.words.mark(edge.tail) + scene.words.mark(edge.tip)])


def draw_sides(canvas: Canvas, scene: Scene, plan: str, drawn: Iterable[Stroke]) -> None:
    """Draw thin the sides of the triangles on a plan that no line of `drawn` shows, and a'b' where a point divides it.

    On the plan of the mechanism the triangles are those of its links.
    """
    reading, lines = scene.reading, list(drawn)
    if plan == POSITION:
        figures: list[tuple[str, ...]] = [*map(reading.on_link, reading.triangles("velocity"))]
    else:
        divided = (step.operands[:2] for step in scene.program.on(plan) if step.verb == "divide")
        figures = [*reading.triangles(plan), *divided]
    for first, second in ((a, b) for marks in figures for i, a in enumerate(marks) for b in marks[:i]):
        side = scene.mm(second), scene.mm(first)
        if abs(side[1] - side[0]) > NEAR and not any(_covers(line, side) for line in lines):
            canvas.part(scene.last((first, second)), Line(*side, Pen.THIN, role="similarity", name=f"{second} {first}"))
            lines.append(side)


def _covers(line: Stroke, side: Stroke) -> bool:
    way = line[1] - line[0]
    if abs(way) < NEAR:
        return False
    feet, spare = [(end - line[0]) / way for end in side], NEAR / abs(way)
    return all(abs(foot.imag) < spare and -spare < foot.real < 1.0 + spare for foot in feet)


def said_enlarged(words: Words, letters: Iterable[str]) -> str:
    """Say which vectors or points a detail, which is numbered later, has the letters of."""
    return words["said.inset"].format(vectors=", ".join(letters), inset=UNNUMBERED[0])


def said_flat(scene: Scene, plan: str) -> Iterator[str]:
    """Say of each point of a plan whose lines meet flatly; in an ill-conditioned position of the worst one, with K."""
    solved, words = scene.solved, scene.words
    for mark, sine in solved.sines.items():
        if role(mark).plan == plan and ILL <= sine < SMALL and plan != POSITION:
            yield words["said.ill"].format(**_meeting(scene, mark, sine))
    if solved.status != "ill-conditioned":
        return
    here = {mark: sine for mark, sine in intersections(solved.program, solved.sines).items() if role(mark).plan == plan}
    mark, sine = min(here.items(), key=lambda item: item[1], default=("", 1.0))
    if 0.0 < sine < ILL:
        from ....plans.linkages.solved import worst_condition  # needs numpy, and few positions need it

        quantity, condition = worst_condition(solved, plan)
        symbol = words.mark if solved.quantities[quantity].kind == "point" else words.symbol
        numbers = {**_meeting(scene, mark, sine), "quantity": symbol(quantity), "condition": _large(scene, condition)}
        if pins := pins_together(solved.program, solved.values, mark):
            yield words["said.ill_pins"].format(first=words.mark(pins[0]), second=words.mark(pins[1]))
        else:
            yield words["said.ill_position"].format(**numbers)
        yield words["said.ill_growth"].format(**numbers)


def _meeting(scene: Scene, mark: str, sine: float) -> dict[str, str]:
    """Return which point lines find, at which angle they meet, and by how much errors grow."""
    return {
        "point": scene.words.mark(point_of(scene.program, mark)),
        "angle": scene.words.short(math.degrees(math.asin(sine)), 3),
        "loss": _large(scene, 1.0 / sine),
    }


def _large(scene: Scene, value: float) -> str:
    if value < LARGE:
        return scene.words.short(float(f"{value:.3g}"))
    mantissa, _, power = f"{value:.1e}".partition("e")
    return f"{scene.words.decimal(mantissa)}·10^{{{int(power)}}}"
