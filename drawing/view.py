"""A view: one figure of a sheet about its own origin, lettered without collisions, under its heading; tables, texts."""

from __future__ import annotations

import math
import re
from cmath import phase, rect
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, count, pairwise
from math import pi
from typing import NamedTuple, TypeAlias, assert_never

from .areas import around, beside, coarser
from .formats import HEAD_HALF_WIDTH, ZERO, Style
from .labels import Labels, Scene
from .page import NOTE, extent, head_of
from .shapes import Anchor, Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, shifted, sides_of
from .spots import Obstacles, Request, first_clear, shelf
from .symbols import angle_dimension, dimension, swept, turning_arrow
from .text import Box, lay_out
from .words import Given, Words

WIDE = "circle"  # the role of a circle that goes round other things
ROUND = 48  # pieces of it, for the letters that keep clear of it
EACH = 4  # letters left out that stand in one line of the notes
NEAREST = (1, 4, 1000)  # letters that make room for one without a place; next time these, where it found none
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7)  # of a dimension line at which its text may stand
ELSEWHERE = " "  # of a letter that is left out: another figure has it
SPARE = 2.0  # mm by which a dimension line is longer than its text
SHELF, CLEAR = 2.0, 0.9  # mm from a dimension to a text beside it on the same line, and from the line to the text
NUMERAL = 2.5  # mm that letters keep away from the numeral of a detail
BROKEN = 0.5  # mm between a letter and a line broken at it
STRUCK = 0.15  # mm between a letter and a thin line that seems to run through it
UNBROKEN = ("leader", "shelf", "right-angle", "arrow")  # roles of thin lines that break off nowhere
# heights of its letters that a line of a heading has below it for scripts, and above for parentheses, for squares
BELOW, PARENTHESES, SQUARES = 0.42, 1.17, 1.35
PAST = 2.0  # mm by which an extension line runs past the dimension line


class Whole(NamedTuple):
    """What a shape is a piece of, and the boxes of letters at which it may break off, with their stages."""

    shape: Shape
    boxes: Mapping[Box, str]


@dataclass(frozen=True, slots=True)
class View:
    """A finished figure: its shapes and the box that they fill, mm.

    What it says is kept beside the shapes: the lines of its `heading` and its `notes`, the `lines` of a text, each in
    chunks between which it may break, and the `rows` of a table, the first of which is its head. `stages` are those in
    which it is drawn, in order, with the keys of the sentences that tell them; `parts` has the stage of every shape,
    `needs` the stages of other views that must be done before some of them, `whole`, by the numbers of the shapes, what
    those are pieces of that break off at letters. A table or a text has the `style` and the `width` in which parts of
    it are drawn on several pages; a part tells the view `of` which it is one.
    """

    name: str
    shapes: tuple[Shape, ...]
    box: Box
    heading: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    lines: tuple[tuple[str, ...], ...] = ()
    rows: tuple[tuple[str | None, ...], ...] = ()
    parts: tuple[str, ...] = ()
    stages: Mapping[str, str] = field(default_factory=dict)
    needs: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    whole: Mapping[int, Whole] = field(default_factory=dict)
    style: Style | None = None
    width: float = 0.0
    of: str = ""

    @property
    def pieces(self) -> int:
        """How many rows under the head of a table, or lines of a text, may be parted; none of a figure."""
        return max(len(self.rows) - 1, len(self.lines)) if self.style is not None else 0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.box[2] - self.box[0], self.box[3] - self.box[1]

    def at(self, x: float, y: float) -> Group:
        """Return the view as a group whose lower left corner stands at x, y."""
        by = complex(x - self.box[0], y - self.box[1])
        return Group(tuple(shifted(shape, by) for shape in self.shapes), "view", self.name)


class _Letter(NamedTuple):
    """A letter that is asked for, the stage to which it belongs, and what the notes say where it is left out.

    One that `stays` is left out only where nothing else helps. Of two that the notes would tell by the same words one
    stays, unless these have a `bare` form that tells it without the other.
    """

    request: Request
    markup: str
    height: float
    stage: str
    spare: str
    stays: bool
    bare: str


@dataclass(slots=True)
class Canvas:
    """Where a view is drawn; letters are asked for here and placed when all lines are known."""

    style: Style
    shapes: list[Shape] = field(default_factory=list)
    _letters: dict[str, _Letter] = field(default_factory=dict)  # by the names under which they are placed
    _boxes: list[Box] = field(default_factory=list)
    _begun: list[tuple[int, str]] = field(default_factory=list)
    bounds: Box | None = None  # letters stay inside of it
    # roles of thin lines that break off at letters, and whether letters take no heed of them
    breaks: Mapping[str, bool] = field(default_factory=dict)
    coarse: float = 0.0  # mm by which letters may take a curve of many points for a shorter broken line
    parts: Mapping[str, str] = field(default_factory=dict)  # stages of a figure, with those in which they are drawn
    stages: Mapping[str, str] = field(default_factory=dict)  # these, with the keys of their sentences if they have any
    needs: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # and the stages of other views that they need

    def add(self, *shapes: Shape) -> None:
        """Draw shapes."""
        self.shapes.extend(shapes)

    def group(self, role: str, name: str, *shapes: Shape) -> None:
        """Draw shapes that are one thing."""
        self.shapes.append(Group(shapes, role, name))

    def thin(self, role: str, name: str, a: complex, b: complex) -> None:
        """Draw a thin line."""
        self.shapes.append(Line(a, b, Pen.THIN, role, name))

    def part(self, name: str, *shapes: Shape) -> str:
        """Begin, or go on with, a stage, of these shapes and all that is drawn from here on; return the one before."""
        before = self._begun[-1][1] if self._begun else ""
        own = self.parts[name] if self.stages else self.parts.get(name, name)
        self._begun.append((len(self.shapes), own))
        self.shapes.extend(shapes)
        return before

    def keep_clear(self, *points: complex) -> None:
        """Let no letter stand in the box of these points."""
        xs, ys = [p.real for p in points], [p.imag for p in points]
        self._boxes.append((min(xs), min(ys), max(xs), max(ys)))

    def label(
        self,
        markup: str,
        anchor: complex | tuple[complex, complex],
        *,
        prefer: complex = 0j,
        clear: float = 1.0,
        height: float | None = None,
        priority: int = 0,
        strict: bool = False,
        spare: str = "",
        along: bool = True,
        optional: bool = False,
        last: str = "",
        bare: str = "",
    ) -> None:
        """Ask for a letter beside a node, or beside a line from one point to another.

        One that would cover something and has a `spare` text is left out, and the text goes into the notes. It may be
        turned `along` the line; an `optional` one is so where it can, and is left out where there is no room. One that
        has only a `last` text is left out where nothing else helps; a blank text is said elsewhere. Where another
        letter with the same text is left out, too, the notes have the `bare` one.
        """
        height = height or self.style.label
        layout = lay_out(markup, height)
        name, stage = str(len(self._letters)), self._begun[-1][1] if self._begun else ""
        request = Request(name, *layout.size, anchor, clear, prefer, priority, strict, not spare, along, optional)
        self._letters[name] = _Letter(request, markup, height, stage, spare or last, not spare, bare)

    def small(
        self, markup: str, anchor: complex | tuple[complex, complex], prefer: complex = 0j, clear: float = 0.8
    ) -> None:
        """Ask for a letter as small as texts beside a node or a line."""
        self.label(markup, anchor, prefer=prefer, clear=clear, height=self.style.text)

    def write(self, markup: str, places: Sequence[complex], height: float, upright: bool = False) -> bool:
        """Write a letter about the first of some places that is clear of all that is drawn; tell whether there is one.

        What is drawn afterwards, and other letters, keep clear of it. An `upright` one is read from below.
        """
        layout, turn = lay_out(markup, height), 0.5 * pi * upright
        size = layout.width, layout.top - layout.bottom
        middle = self.clear(places, size[::-1] if upright else size)
        if middle is None:
            return False
        at = middle - rect(0.5 * (layout.top + layout.bottom), turn + 0.5 * pi)
        self.add(Text(at, markup, height, "middle", turn, role="label"))
        return True

    def clear(self, places: Sequence[complex], size: tuple[float, float]) -> complex | None:
        """Return the first of some places about which a box is clear of all that is drawn so far."""
        return first_clear(places, size, _obstacles(self.shapes, self._boxes, self.style), 0.8)

    def detail(self, numeral: str, centre: complex, radius: float, name: str) -> None:
        """Mark a place by a circle, its numeral on the shelf of a leader that is clear of all that is drawn."""
        height = self.style.label
        size = lay_out(numeral, height).width + 2.0, height + 1.0
        start, knee, end = shelf(centre, radius, size, _obstacles(self.shapes, self._boxes, self.style))
        self.add(Arc(centre, radius, 0.0, 2.0 * pi, Pen.THIN, role="window", name=name))
        self.add(Line(knee, start, Pen.THIN, role="leader", name=numeral))
        self.thin("shelf", numeral, knee, end)
        self.add(Text(0.5 * (knee + end) + 1j, numeral, height, "middle", role="label"))
        aside = NUMERAL * (1.0 if end.real > knee.real else -1.0)
        self.keep_clear(knee - aside, end + aside + 1j * (height + 1.0))  # beside a letter it would read as its index

    def finish(self, name: str, heading: tuple[str, ...] = (), notes: tuple[str, ...] = ()) -> View:
        """Place the letters, write the heading lines and smaller notes above, and close the view.

        Without a heading it has its notes only as text: they go under that of the figure of which it is a part.
        """
        kept, placed, scene = self._placed()
        starts = [0, *(start for start, _ in self._begun), len(self.shapes)]
        names = ["", *(name for _, name in self._begun)]
        parts = [name for name, (a, b) in zip(names, pairwise(starts), strict=True) for _ in range(a, b)]
        letters, whole = list[Text](), dict[int, Whole]()
        for label, letter in kept.items():
            angle, layout = placed.angles.get(label, 0.0), lay_out(letter.markup, letter.height)
            corner = complex(layout.left, layout.bottom) * rect(1.0, angle)
            at, of = placed.corners[label] - corner, letter.request.anchor
            ends = of if isinstance(of, tuple) else (of,)
            letters.append(Text(at, letter.markup, letter.height, angle=angle, role="label", of=ends))
        stages = [letter.stage for letter in kept.values()]
        parts, whole = self._broken([*zip(letters, stages, strict=True)], parts, scene)
        parts += (letter.stage for letter in kept.values())
        spare = self._left_out(kept)
        notes = (*notes, *("; ".join(spare[i : i + EACH]) for i in range(0, len(spare), EACH)))
        self.shapes += letters
        for label, way in placed.leaders.items():
            bent = Polyline(way, Pen.THIN, role="leader", name=kept[label].markup)
            self.shapes.append(bent if len(way) > 2 else Line(way[0], way[1], Pen.THIN, role="leader", name=bent.name))
            parts.append(kept[label].stage)
        x0, y0, x1, y1 = write_above(self.shapes, heading, notes if heading else (), self.style)
        box = x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0
        every = (*parts, *("" for _ in self.shapes[len(parts) :])) if self._begun else ()
        drawn = name, tuple(self.shapes), box, heading, tuple(notes)
        return View(*drawn, parts=every, stages=self.stages, needs=self.needs, whole=whole)

    def _left_out(self, kept: Mapping[str, _Letter]) -> list[str]:
        """Return what the notes say of letters left out: each text once, bare where no letter has what it speaks of."""
        gone = [letter for name, letter in self._letters.items() if name not in kept and letter.spare.strip()]
        each = Counter(letter.spare for letter in gone)
        bare = {letter.spare: letter.bare for letter in gone if letter.bare and each[letter.spare] > 1}
        return [bare.get(text, text) for text in each]

    def _broken(
        self, letters: Sequence[tuple[Text, str]], parts: Sequence[str], scene: Scene
    ) -> tuple[list[str], dict[int, Whole]]:
        """Break thin lines at letters, which come with their stages: those of some roles at all, others where struck.

        Returned are the stages of all shapes, and by the numbers of the pieces what is whole without the letters.
        """
        fixed = ((shape, part) for shape, part in zip(self.shapes, parts, strict=True) if isinstance(shape, Text))
        every = [(_inked(text), stage, text.angle) for text, stage in (*letters, *fixed)]
        boxes = {_grown(box, BROKEN): stage for box, stage, _ in every}
        level = [(box, stage) for box, stage, angle in every if angle % (0.5 * pi) < ZERO]  # turned ones stand clear
        struck = scene.struck([_grown(box, STRUCK) for box, _ in level])
        through = {_grown(box, BROKEN): stage for (box, stage), bad in zip(level, struck, strict=True) if bad}
        if not (self.breaks or through):
            return [*parts], {}
        shapes, stages, whole = list[Shape](), list[str](), dict[int, Whole]()
        for shape, part in zip(self.shapes, parts, strict=True):
            at = boxes if getattr(shape, "role", "") in self.breaks else through
            pieces = left_of(shape, tuple(at)) if at else [shape]
            if pieces != [shape]:
                whole |= dict.fromkeys(range(len(shapes), len(shapes) + len(pieces)), Whole(shape, at))
            shapes += pieces
            stages += [part] * len(pieces)
        self.shapes = shapes
        return stages, whole

    def _placed(self) -> tuple[dict[str, _Letter], Labels, Scene]:
        """Place the letters, all as small as texts where not every one has a place; then some are left out.

        Where that does not help, either, leaders cross lines.
        """
        thin = (Line, Arc, Group)
        shapes = [shape for shape in self.shapes if not (isinstance(shape, thin) and self.breaks.get(shape.role))]
        shapes = [coarser(shape, self.coarse) for shape in shapes] if self.coarse else shapes
        scene = self._scene(_obstacles(shapes, self._boxes, self.style))
        placed, last = self._settled(scene), False
        if placed.failed:
            self._letters = {name: self._small(letter) for name, letter in self._letters.items()}
            scene = self._scene(scene)
            placed = self._settled(scene)
        if placed.failed and (last := any(letter.stays and letter.spare for letter in self._letters.values())):
            scene = self._scene(scene, last)
            placed = self._settled(scene, last)
        if placed.failed:
            placed = self._settled(scene, last, cross=True)
        return {name: letter for name, letter in self._letters.items() if name in placed.corners}, placed, scene

    def _small(self, letter: _Letter) -> _Letter:
        """Return a letter no higher than texts."""
        if letter.height <= self.style.text:
            return letter
        width, height = lay_out(letter.markup, self.style.text).size
        request = replace(letter.request, width=width, height=height)
        return letter._replace(request=request, height=self.style.text)

    def _scene(self, drawn: Obstacles | Scene, last: bool = False) -> Scene:
        """Return what is to be lettered; at `last` vectors whose ends may have no letters have theirs far away."""
        requests = [letter.request for letter in self._letters.values()]
        if last:
            ends = {letter.spare for letter in self._letters.values() if letter.stays}
            requests = [replace(r, afield=r.afield or self._letters[r.name].spare in ends) for r in requests]
        return drawn.asking(requests) if isinstance(drawn, Scene) else Scene(requests, drawn, bounds=self.bounds)

    def _settled(self, scene: Scene, last: bool = False, cross: bool = False) -> Labels:
        """Place the letters; leave out spare ones that cover something.

        At `last` also those that stay where there is any place for them. Where leaders may `cross` lines those are left
        out, too, whose leaders do, that stand in the way of others, or which the notes can tell without another letter.
        """
        best = placed = scene.place(may_cross=cross)
        out, vain = set[str](), 0  # who was left out, and how often since the fewest failed that must stay: the best
        while True:
            said = {self._letters[name].spare for name in out} - {ELSEWHERE}
            said -= {letter.spare for letter in self._letters.values() if letter.bare} if cross else set()
            spare = [
                name
                for name in placed.corners
                if (text := self._letters[name].spare) and text not in said and (last or not self._letters[name].stays)
            ]
            bad = {*placed.failed, *(name for name in placed.crossed if name in placed.leaders)}
            gone = {name for name in spare if name in bad and (cross or self._letters[name].stays)}
            gone = gone or {name for name in placed.failed if name in spare}
            # or numbers of arms that lines cross, which say the same under the heading
            gone = gone or {name for name in placed.crossed if self._letters[name].spare == self._letters[name].markup}
            if not gone:
                if not vain or len(placed.failed) < len(best.failed):
                    best, vain = placed, 0
                if not (spare and placed.failed and cross) or vain == len(NEAREST):
                    return best
                gone = _near_failed(placed, spare, NEAREST[vain])
                vain += 1
            # of two of which the notes would say the same one stays
            each = {text if (text := self._letters[name].spare) != ELSEWHERE else name: name for name in sorted(gone)}
            out.update(each.values())
            placed = scene.place(out, cross)


def _near_failed(placed: Labels, spare: Sequence[str], most: int) -> set[str]:
    """Return which of the `spare` letters are among the `most` nearest to one that found no place."""
    at, near = placed.corners, set[str]()
    for failed in placed.failed:
        near.update(name for _, name in sorted((abs(at[name] - at[failed]), name) for name in spare)[:most])
    return near


def left_of(shape: Shape, boxes: tuple[Box, ...]) -> list[Shape]:
    """Return what is left of a thin line, or of thin lines in a group, beside boxes; all of it where nothing is."""
    match shape:
        case Line(a=a, b=b, pen=pen, role=role) if pen is not Pen.MAIN and role not in UNBROKEN:
            sides = beside(a, b, boxes)
            return [replace(shape, a=start, b=end) for start, end in sides] if sides not in ([], [(a, b)]) else [shape]
        case Arc(pen=pen) if pen is not Pen.MAIN:
            return [*around(shape, boxes)] or [shape]
        case Polyline(pen=pen, role=role, fill=False) if pen is not Pen.MAIN and role not in UNBROKEN:
            return [*around(shape, boxes)] or [shape]
        case Group(shapes=parts, role=role) if role not in UNBROKEN:
            pieces = tuple(piece for part in parts for piece in left_of(part, boxes))
            return [replace(shape, shapes=pieces)] if pieces != parts else [shape]
    return [shape]


def _inked(text: Text) -> Box:
    """Return the box of a text, and of what leans out of it."""
    (x0, y0, x1, y1), layout = extent((text,)), lay_out(text.markup, text.height)
    return x0 + layout.left, y0, x1 + layout.right - layout.width, y1


def _grown(box: Box, by: float) -> Box:
    x0, y0, x1, y1 = box
    return x0 - by, y0 - by, x1 + by, y1 + by


def numbered(views: Iterable[View]) -> list[View]:
    """Return views with the numbers of the figures among them, in order, before their headings."""
    number = count(1)
    return [_numbered(v, next(number)) if v.heading and not (v.rows or v.lines) else v for v in views]


def _numbered(view: View, number: int) -> View:
    """Return a view with its number before its heading, its box being as wide as that needs."""
    shapes, (x0, y0, x1, y1) = list(view.shapes), view.box
    for i, shape in enumerate(shapes):
        if isinstance(shape, Text) and shape.role == "heading" and shape.markup == view.heading[0]:
            text = replace(shape, markup=f"{number}. {shape.markup}")
            half = 0.5 * lay_out(text.markup, text.height).width
            shapes[i], x0, x1 = text, min(x0, text.at.real - half), max(x1, text.at.real + half)
    return replace(view, shapes=tuple(shapes), box=(x0, y0, x1, y1))


def write_above(shapes: list[Shape], heading: tuple[str, ...], notes: tuple[str, ...], style: Style) -> Box:
    """Write heading lines over shapes, and smaller notes between; return the box of all, with the top of the lines."""
    x0, y0, x1, y1 = extent(shapes)
    for texts, height, name in ((notes, style.text, NOTE), (heading, style.heading, "")):
        lines, y1 = heading_shapes(texts, height, (x0 + x1) / 2, y1, name)
        shapes += lines
    x0, _, x1, _ = extent(shapes)
    return x0, y0, x1, y1


def heading_shapes(
    lines: tuple[str, ...], height: float, middle: float, top: float, name: str = ""
) -> tuple[list[Shape], float]:
    """Write centred lines above `top`; return them and the new top.

    What hangs below a line, or stands over capitals, is not more in one than in another: views in a row have their
    headings on common baselines.
    """
    texts: list[Shape] = []
    y = top + 0.7 * height if lines else top
    for line in reversed(lines):
        layout = lay_out(line, height)
        y -= min(layout.bottom, -BELOW * height)
        texts.append(Text(complex(middle, y), line, height, "middle", role="heading", name=name))
        y += max(layout.top, (PARENTHESES if line is lines[0] else SQUARES) * height) + 0.25 * height
    return texts, y


def _obstacles(shapes: list[Shape], boxes: list[Box], style: Style) -> Obstacles:
    circles: list[tuple[complex, float]] = []
    strokes: dict[bool, list[tuple[complex, complex]]] = {True: [], False: []}  # of the main pen, of others
    texts, heads = list[Box](), list[tuple[complex, complex]]()

    def head(tip: complex, direction: complex) -> None:
        heads.append((tip - direction / abs(direction) * style.arrow, tip))

    def gather(shape: Shape, whole: bool = False) -> None:
        match shape:
            case Line() | Polyline() | Arc():
                strokes[whole or shape.pen is Pen.MAIN or shape.role in UNBROKEN].extend(sides_of(shape))
            case Circle(centre=centre, radius=radius):
                circles.append((centre, radius))
            case Head(tip=tip, direction=direction):
                head(tip, direction)
            case Text():
                texts.append(extent((shape,)))
            case Vector(tail=tail, tip=tip) | Arrow(tail=tail, tip=tip):
                strokes[True].append((tail, tip))
                if (point := head_of(shape, style.arrow)) is not None:
                    head(point, tip - tail)
            case Group(shapes=parts, role=role):
                for part in parts:
                    if role == WIDE and isinstance(part, Circle):  # a letter may stand inside
                        ring = (part.centre + rect(part.radius, 2.0 * pi * k / ROUND) for k in range(ROUND))
                        part = Polyline(tuple(ring), part.pen, closed=True)
                    gather(part, whole or role in UNBROKEN)
            case _:
                assert_never(shape)

    for shape in shapes:
        gather(shape)
    return Obstacles(strokes[True], strokes[False], circles, texts, heads, boxes)


def angle(
    canvas: Canvas,
    vertex: complex,
    rays: tuple[complex, complex],
    radius: float,
    name: str,
    text: str = "",
    *,
    turn: int = 0,
    inside: bool = False,
    prefer: complex = 0j,
    clear: float = 1.0,
    spare: str = "",
) -> None:
    """Dimension the angle from one ray to another with its text at the middle of the arc.

    `turn` says whether it runs counter-clockwise, 1, or clockwise, -1; without it the shorter way. The text stands
    beyond the arc, or `inside` of it, or to the side that it should `prefer`.
    """
    start, sweep = phase(rays[0]), swept(*rays, turn)
    canvas.add(angle_dimension(vertex, radius, start, sweep, name, canvas.style))
    if text:
        out = rect(1.0, start + 0.5 * sweep)
        at = vertex + radius * out
        toward = prefer or (-out if inside else out)
        canvas.label(text, at, prefer=toward, clear=clear, height=canvas.style.text, spare=spare)


def turning(
    canvas: Canvas, centre: complex, radius: float, middle: float, spread: float, sense: float, name: str, text: str
) -> None:
    """Draw an arrow about a centre that shows in which sense something turns, its letter beyond its middle.

    The arrow reaches to both sides of the direction `middle` by half of `spread`, rad.
    """
    at = centre + rect(radius, middle)
    canvas.add(turning_arrow(centre, radius, middle, spread, sense, name))
    canvas.label(text, at, prefer=at - centre, clear=1.0)


def linear(
    canvas: Canvas,
    ends: tuple[complex, complex],
    out: complex,
    text: str,
    name: str,
    *,
    bodies: tuple[float, float] = (0.0, 0.0),
    chained: bool = False,
) -> None:
    """Dimension the distance between two points on a line parallel to it, moved by the vector `out`.

    Points in one place have no dimension; one that says the same as another may have no text. Extension lines begin
    beyond the `bodies` that stand at the points, which reach so many mm. Of `chained` dimensions others stand beside it
    on the same line.
    """
    a, b = ends
    if abs(b - a) < ZERO:
        return
    if abs(out) > PAST:
        e = out / abs(out)
        lines = (Line(end + e * gap, end + out + e * PAST, Pen.THIN) for end, gap in zip(ends, bodies, strict=True))
        canvas.add(*(replace(line, role="extension") for line in lines))
    canvas.add(dimension(a + out, b + out, name, canvas.style))
    if not text:
        return
    line, level, upright = (a + out, b + out), abs((b - a).imag) < ZERO, abs((b - a).real) < ZERO
    if (level and over_line(canvas, line, text, chained)) or (upright and _along(canvas, line, text)):
        return
    canvas.label(text, line, prefer=1j if level else out, clear=0.8, height=canvas.style.text)


def _along(canvas: Canvas, ends: tuple[complex, complex], text: str) -> bool:
    """Write the text of an upright dimension along its line, on its left; tell whether it has room there."""
    (a, b), layout = ends, lay_out(text, canvas.style.text)
    spare = abs(b - a) - 2.0 * canvas.style.arrow - layout.width  # between the arrowheads
    aside = CLEAR + 0.5 * (layout.top - layout.bottom)
    shares = [share for share in SHARES if abs(share - 0.5) * abs(b - a) <= 0.5 * spare]
    return canvas.write(text, [a + share * (b - a) - aside for share in shares], canvas.style.text, upright=True)


def above(text: str, height: float) -> float:
    """Return how far above a line a text has its baseline, so that it stands clear of the line, mm."""
    return CLEAR - lay_out(text, height).bottom


def over_line(canvas: Canvas, ends: tuple[complex, complex], text: str, chained: bool = False) -> bool:
    """Write the text of a level dimension over its line; tell whether it has room there.

    Else it stands over the line drawn on, if none is there, on the side on which the figure ends sooner.
    """
    layout, arrow = lay_out(text, canvas.style.text), canvas.style.arrow
    left, right = sorted(ends, key=lambda end: end.real)
    reach, up = abs(right - left), 1j * (CLEAR + 0.5 * (layout.top - layout.bottom))
    over_heads = 1j * arrow * HEAD_HALF_WIDTH
    if reach > layout.width + SPARE:
        spare = 0.5 * (reach - layout.width - SPARE) / reach
        shares = [share for share in SHARES if abs(share - 0.5) <= spare]
        places = [left + share * reach + up + more for more in (0j, over_heads) for share in shares]
        if canvas.write(text, places, canvas.style.text):
            return True
    if chained:
        return False
    beyond = 2.0 * arrow if reach <= 2.5 * arrow else 0.0  # the heads stand there
    x0, _, x1, _ = extent(canvas.shapes)
    sides = [(left, -1.0), (right, 1.0)] if left.real - x0 <= x1 - right.real else [(right, 1.0), (left, -1.0)]
    for end, side in sides:
        far = end + side * (beyond + layout.width + SHELF)
        if canvas.write(text, [far - side * 0.5 * layout.width + up], canvas.style.text):
            canvas.add(Line(end, far, Pen.THIN, role="shelf"))
            return True
    return False


Row: TypeAlias = Sequence[str | None]
INDENT = "    "
NUMBER = re.compile(r"([−±]?\d+)(?:[.,]\d+)?(?:·10\^\{−?\d+\})?")  # and what of it stands before the comma
SENTENCE = re.compile(r"[^\W\d_]{3,} +[^\W\d_]{2,}(?![\w.])")  # two words, none cut short
WORD, SCRIPTS = re.compile(r"[^\W\d_]{3,}"), re.compile(r"[_^]\{[^}]*\}")  # in words; in symbols what is no letter
PITCH = 1.7  # heights of letters from line to line (GOST 2.304)
CELL = 1.75  # mm at least on both sides of what stands in a cell
BETWEEN, UNDERLINED = 0.45, 0.9  # heights of letters between lines of text, and below one that is underlined
LONG, DENOMINATOR, ROUNDING = 10, 100, 1e-11  # characters of a number that may be a simple fraction


def table(name: str, heading: str, rows: Sequence[Row], style: Style) -> View:
    """Return a ruled table; the first row is its head. A cell that is None belongs to the one on its left.

    Capitals stand in the middle of their row; numbers of a column with their commas under one another, sentences and
    the words above and below them from its left edge, all else in its middle.
    """
    h, columns = style.text, range(len(rows[0]))
    alone = [
        {j: cell for j, row in enumerate(rows) for k, end, cell in cells(row) if k == i == end - 1} for i in columns
    ]
    placed = [_in_column(column, h) for column in alone]
    widths = [wide + 2.0 * max(0.5 * h, CELL) for wide, _ in placed]
    edges = [0.0, *accumulate(widths)]
    # scripts reach past the capitals in the middle of a row: it is as much higher on both sides
    reach = (max(top - h, -bottom) for top, bottom in (_span(row, h) for row in rows))
    levels = [0.0, *accumulate(-max(2.0 * h, 1.25 * h + 2.0 * past, style.row) for past in reach)]
    shapes: list[Shape] = []
    for i, y in enumerate(levels):
        pen = Pen.MAIN if i in (0, 1, len(rows)) else Pen.THIN
        shapes.append(Line(complex(0, y), complex(edges[-1], y), pen))
    for i, x in enumerate(edges):
        pen = Pen.MAIN if i in (0, len(edges) - 1) else Pen.THIN
        shapes += (Line(complex(x, levels[j]), complex(x, levels[k]), pen) for j, k in _ruled(rows, i))
    for j, row in enumerate(rows):
        baseline = 0.5 * (levels[j] + levels[j + 1] - h)
        for i, end, cell in cells(row):
            start = placed[i][1].get(j) if end == i + 1 else None
            x = 0.5 * (edges[i] + edges[end]) if start is None else edges[i] + start
            if cell:
                anchor: Anchor = "middle" if start is None else "left"
                shapes.append(Text(complex(x, baseline), cell, h, anchor, role="cell"))
    view = _view(name, heading, shapes, (0.0, levels[-1], edges[-1], 0.0), style, role="table")
    return replace(view, rows=tuple(tuple(row) for row in rows), style=style)


def _in_column(column: Mapping[int, str], h: float) -> tuple[float, dict[int, float]]:
    """Return how wide the texts of a column are, and where those begin that do not stand in its middle, by row."""
    wide = {j: lay_out(cell, h).width for j, cell in column.items()}
    widest = max(wide.values(), default=0.0)
    if any(SENTENCE.search(cell) for j, cell in column.items() if j):
        return widest, {j: max(0.5 * h, CELL) for j, cell in column.items() if j and WORD.search(SCRIPTS.sub("", cell))}
    before = {j: lay_out(number[1], h).width for j, cell in column.items() if (number := NUMBER.fullmatch(cell))}
    left, right = max(before.values(), default=0.0), max((wide[j] - before[j] for j in before), default=0.0)
    widest = max(widest, left + right)
    return widest, {j: max(0.5 * h, CELL) + 0.5 * (widest - left - right) + left - own for j, own in before.items()}


def cells(row: Row) -> Iterator[tuple[int, int, str]]:
    """Go through the cells of a row: the columns where they begin and before which they end, and their text."""
    for i, cell in enumerate(row):
        if cell is not None or i == 0:
            yield i, next((k for k in range(i + 1, len(row)) if row[k] is not None), len(row)), cell or ""


def _ruled(rows: Sequence[Row], edge: int) -> list[tuple[int, int]]:
    """Return from which level to which a line runs on the left of a column: broken where a cell goes on over it."""
    crossed = [j for j, row in enumerate(rows) if 0 < edge < len(row) and row[edge] is None]
    ends = [-1, *crossed, len(rows)]
    return [(a + 1, b) for a, b in pairwise(ends) if b > a + 1]


def _span(row: Row, h: float) -> tuple[float, float]:
    """Return how far a row of cells reaches above and below its baseline, at least as far as a capital letter."""
    layouts = [lay_out(cell or "", h) for cell in row]
    return max(h, *(layout.top for layout in layouts)), min(0.0, *(layout.bottom for layout in layouts))


def givens_view(
    givens: Mapping[str, Given],
    words: Words,
    style: Style,
    more: Sequence[tuple[str, str, str]] = (),
    called: Mapping[str, str] | None = None,
) -> View:
    """Return the table of the givens in the task's own units; `more` rows of the same columns follow.

    Where it is said what they are `called`, that stands in a column of its own, and nothing follows.
    """
    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in givens.items():
        if isinstance(given.value, str):
            rows.append([*words.choice(name, given.value), ""])
        else:
            rows.append([words.symbol(name), _number(words, given.value), words.unit(given.unit)])
    rows += map(list, more)
    if called is None:
        return table("givens", words["heading.givens"], rows, style)
    named: list[Row] = [[rows[0][0], words["table.called"], *rows[0][1:]]]
    for (symbol, *cells), (name, given) in zip(rows[1:], givens.items(), strict=False):
        chosen = ["", symbol[:1].upper() + symbol[1:], cells[0], None]
        named.append(chosen if isinstance(given.value, str) else [symbol, called.get(name, ""), *cells])
    return table("givens", words["heading.givens"], named, style)


def with_unit(value: str, unit: str) -> str:
    """Return a number with its unit; the sign of degrees stands close."""
    return f"{value}{'' if unit.startswith('°') else ' '}{unit}".rstrip()


def _number(words: Words, value: float) -> str:
    """Return a number as short as it is: a third as a fraction."""
    if math.isinf(value):
        return "∞"
    if len(text := words.short(value)) > LONG:
        from fractions import Fraction  # few numbers need it

        simple = Fraction(value).limit_denominator(DENOMINATOR)
        if simple.denominator != 1 and abs(value - simple) < ROUNDING * abs(value):
            return f"{simple.numerator}/{simple.denominator}"
    return text


def text_block(name: str, heading: str, lines: Sequence[Sequence[str]], style: Style, width: float) -> View:
    """Return lines of text; each line comes in chunks, and breaks between chunks where it is wider than `width`."""
    h = style.text
    shapes: list[Shape] = []
    base, low, widest = 0.0, 0.0, 0.0  # of the line before
    for first, *others in lines:
        broken = [first]
        for chunk in others:
            longer = f"{broken[-1]} {chunk}"
            broken[-1:] = [broken[-1], INDENT + chunk] if lay_out(longer, h).width > width else [longer]
        for line in broken:
            layout = lay_out(line, h)
            base = min(low - layout.top, base - PITCH * h) if shapes else -layout.top
            shapes.append(Text(complex(0.0, base), line, h, role="line"))
            underlined = any(rule[1] < 0.0 for rule in layout.rules)
            low = base + layout.bottom - (UNDERLINED if underlined else BETWEEN) * h
            widest = max(widest, layout.width)
    view = _view(name, heading, shapes, (0.0, low, widest, 0.0), style, role="text")
    return replace(view, lines=tuple(tuple(line) for line in lines), style=style, width=width)


def part_of(view: View, begin: int, end: int, heading: str) -> View:
    """Return these rows of a table, under its head, or lines of a text; the first part has its name."""
    name, style = view.name if begin == 0 else f"{view.name}_continued", view.style
    if style is None:
        raise ValueError(f"{view.name} has no parts")
    if view.rows:
        part = table(name, heading, [view.rows[0], *view.rows[1 + begin : 1 + end]], style)
    else:
        part = text_block(name, heading, view.lines[begin:end], style, view.width)
    return replace(part, of=view.of or view.name)


def words_of(sentence: str) -> tuple[str, ...]:
    """Return a sentence as a line of text that may break between any two words."""
    return tuple(sentence.split())


def _view(name: str, heading: str, shapes: list[Shape], box: Box, style: Style, role: str) -> View:
    """Return a view of `shapes`, which fill `box`, under their heading."""
    x0, y0, x1, _ = box
    middle = (x0 + x1) / 2
    lines, top = heading_shapes((heading,), style.heading, middle, 0.0)
    half = max((lay_out(heading, style.heading).width / 2, (x1 - x0) / 2))
    body = Group(tuple(shapes), role, name)
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top + 1.0), (heading,))
