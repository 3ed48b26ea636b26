"""A view: one figure of a sheet about its own origin, lettered without collisions, under its heading."""

from __future__ import annotations

import re
from cmath import rect
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import count, pairwise
from math import pi
from typing import NamedTuple, assert_never

from .areas import around, beside, coarser
from .formats import ZERO, Style
from .labels import Labels, Scene, scene_of
from .page import NOTE, extent, head_of
from .shapes import (
    Arc,
    Arrow,
    Circle,
    Group,
    Head,
    Line,
    Pen,
    Polyline,
    Shape,
    Text,
    Vector,
    changed,
    shifted,
    sides_of,
)
from .spots import Obstacles, Request, first_clear, shelf
from .text import Box, lay_out, symbol

WIDE = "circle"  # the role of a circle that goes round other things
ROUND = 48  # pieces of it, for the letters that keep clear of it
SEVERAL, WORTH = 4, 2  # letters that notes would tell of; of these, how many must find room where letters are smaller
EACH = 4  # letters left out that stand in one line of the notes
NEAREST = (1, 4, 1000)  # letters that make room for one without a place; next time these, where it found none
ASKED = 3  # names of vectors that are asked to make room for the letter of an end
SHUT_IN = 8  # letters without a free place of their own: where they are more, not every one has ever found a place
ELSEWHERE = " "  # of a letter that is left out: another figure has it
NUMERAL = 2.5  # mm that letters keep away from the numeral of a detail
# of the details of a sheet: a V would be read as a velocity
NUMERALS = [
    tens + one for tens in ("", "X", "XX", "XXX") for one in ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX")
]
NUMERALS.remove("V")
UNNUMBERED = NUMERALS[2:]  # of the details of a figure that has no number: shelves are as long as VIII needs
_WORD = re.compile("[IVX]+")
BROKEN = 0.5  # mm between a letter and a line broken at it
STRUCK = 0.25  # mm between a letter and a thin line, or the chord of an arc, that seems to run through it
UNBROKEN = ("leader", "shelf", "right-angle", "arrow")  # roles of thin lines that break off nowhere
DOT = 1.2  # mm; what is left of a construction line beside a letter is no shorter
# heights of its letters that a line of a heading has below it for scripts, and above for parentheses, for squares
BELOW, PARENTHESES, SQUARES = 0.42, 1.17, 1.35
BESIDE = 0.5  # heights of its letters on both sides of a heading, which else reads as one line with the next one


class _Whole(NamedTuple):
    """What a shape is a piece of, and the boxes of letters at which it may break off, with their stages."""

    shape: Shape
    boxes: Mapping[Box, str]


@dataclass(frozen=True)
class View:
    """A finished figure: its shapes and the box that they fill, mm.

    What it says is kept beside the shapes: the lines of its `heading` and its `notes`, the `lines` of a text, each in
    chunks between which it may break, and the `rows` of a table, the first of which is its head. `stages` are those in
    which it is drawn, in order, with the keys of the sentences that tell them; `parts` has the stage of every shape,
    `needs` the stages of other views that must be done before some of them, `whole`, by the numbers of the shapes, what
    those are pieces of that break off at letters, `details` the numerals of its details. A table or a text has the
    `style` and the `width` in which parts of it are drawn on several pages; a part tells the view `of` which it is one.
    There it follows the figure that it is `about`, or, being about "", begins; where nothing is said it comes in the
    order of the work.
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
    whole: Mapping[int, _Whole] = field(default_factory=dict)
    style: Style | None = None
    details: tuple[str, ...] = ()
    width: float = 0.0
    of: str = ""
    about: str | None = None

    @property
    def pieces(self) -> int:
        """How many rows under the head of a table, or lines of a text, may be parted; none of a figure."""
        return max(len(self.rows) - 1, len(self.lines)) if self.style is not None else 0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.box[2] - self.box[0], self.box[3] - self.box[1]

    @cached_property
    def ink(self) -> Box:
        """The box of what is drawn, mm: less than that of the view, which keeps clear of others."""
        return extent(self.shapes) if self.shapes else self.box

    def at(self, x: float, y: float) -> Group:
        """Return the view as a group whose lower left corner stands at x, y."""
        by = complex(x - self.box[0], y - self.box[1])
        return Group(tuple(shifted(shape, by) for shape in self.shapes), "view", self.name)


class _Letter(NamedTuple):
    """A letter that is asked for, the stage to which it belongs, and what the notes say where it is left out.

    One that `stays` is left out only where nothing else helps. Of two that the notes would tell by the same words one
    stays, unless these have a `bare` form that tells it without the other. Its `first` letters are those of an earlier
    stage, with that stage.
    """

    request: Request
    markup: str
    height: float
    stage: str
    spare: str
    stays: bool
    bare: str
    first: tuple[str, str] | None


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
    _details: list[str] = field(default_factory=list)  # numerals

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
        first: tuple[str, str] | None = None,
        other: tuple[complex, complex] | None = None,
    ) -> None:
        """Ask for a letter beside a node, or beside a line from one point to another.

        One that would cover something and has a `spare` text is left out, and the text goes into the notes. It may be
        turned `along` the line; an `optional` one is so where it can, else along an `other` part of it, and is left out
        where there is no room. One that has only a `last` text is left out where nothing else helps; a blank text is
        said elsewhere. Where another letter with the same text is left out, too, the notes have the `bare` one. What it
        begins with may be all of it in an earlier stage: the `first` markup, and that stage.
        """
        height, markup = height or self.style.label, symbol(markup)
        layout = lay_out(markup, height)
        name, stage = str(len(self._letters)), self._begun[-1][1] if self._begun else ""
        wide, high = layout.size
        request = Request(
            name, wide, high, anchor, clear, prefer, priority, strict, not spare, along, optional, other, layout.bare
        )
        self._letters[name] = _Letter(request, markup, height, stage, spare or last, not spare, bare, first)

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
        """Mark a place by a circle, its numeral on the shelf of a leader that is clear of all that is drawn.

        The circle is a little wider than that where no leader is clear else. The numeral is one of `UNNUMBERED`,
        instead of which it has its own once figures are `numbered`.
        """
        height = self.style.label
        self._details.append(numeral)
        size = lay_out(numeral, height).width + 2.0, height + 1.0
        start, knee, end = shelf(centre, radius, size, _obstacles(self.shapes, self._boxes, self.style))
        self.add(Arc(centre, abs(start - centre), 0.0, 2.0 * pi, Pen.THIN, role="window", name=name))
        self.add(Line(knee, start, Pen.THIN, role="leader", name=numeral))
        self.thin("shelf", numeral, knee, end)
        self.add(Text(0.5 * (knee + end) + 1j, numeral, height, "middle", role="label"))
        aside = NUMERAL * (1.0 if end.real > knee.real else -1.0)
        self.keep_clear(knee - aside, end + aside + 1j * (height + 1.0))  # beside a letter it would read as its index

    def finish(
        self, name: str, heading: tuple[str, ...] = (), notes: tuple[str, ...] = (), joined: bool = False
    ) -> View:
        """Place the letters, write the heading lines and smaller notes above, and close the view.

        Without a heading it has its notes only as text: they go under that of the figure of which it is a part.
        Notes that are `joined` share lines, as many in each as have room in the width of the view.
        """
        kept, placed, scene = self._placed()
        starts = [0, *(start for start, _ in self._begun), len(self.shapes)]
        names = ["", *(name for _, name in self._begun)]
        parts = [name for name, (a, b) in zip(names, pairwise(starts), strict=True) for _ in range(a, b)]
        letters, whole = list[Text](), dict[int, _Whole]()
        for label, letter in kept.items():
            angle, layout = placed.angles.get(label, 0.0), lay_out(letter.markup, letter.height)
            corner = complex(layout.left, layout.bottom) * rect(1.0, angle)
            at, of = placed.corners[label] - corner, letter.request.anchor
            ends = of if isinstance(of, tuple) else (of,)
            letters.append(Text(at, letter.markup, letter.height, angle=angle, role="label", of=ends))
        stages = [letter.first[1] if letter.first else letter.stage for letter in kept.values()]
        parts, whole = self._broken([*zip(letters, stages, strict=True)], parts, scene)
        for text, letter in zip(letters, kept.values(), strict=True):
            if letter.first:  # whole, as a line is that breaks off at letters to come, until these are there
                begun = replace(text, markup=letter.first[0])
                whole[len(self.shapes) + letters.index(text)] = _Whole(begun, {extent((text,)): letter.stage})
        parts += stages
        spare = self._left_out(kept)
        notes = (*notes, *("; ".join(spare[i : i + EACH]) for i in range(0, len(spare), EACH)))
        self.shapes += letters
        for label, way in placed.leaders.items():
            bent = Polyline(way, Pen.THIN, role="leader", name=kept[label].markup)
            self.shapes.append(bent if len(way) > 2 else Line(way[0], way[1], Pen.THIN, role="leader", name=bent.name))
            parts.append(stages[[*kept].index(label)])
        if joined:
            notes = _joined(self.shapes, heading, notes, self.style)
        x0, y0, x1, y1 = write_above(self.shapes, heading, notes if heading else (), self.style)
        box = x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0
        every = (*parts, *("" for _ in self.shapes[len(parts) :])) if self._begun else ()
        drawn = name, tuple(self.shapes), box, heading, tuple(notes)
        details = tuple(self._details)
        return View(*drawn, parts=every, stages=self.stages, needs=self.needs, whole=whole, details=details)

    def _left_out(self, kept: Collection[str]) -> list[str]:
        """Return what the notes say of letters left out: each text once, bare where no letter has what it speaks of."""
        gone = [letter for name, letter in self._letters.items() if name not in kept and letter.spare.strip()]
        each = Counter(letter.spare for letter in gone)
        bare = {letter.spare: letter.bare for letter in gone if letter.bare and each[letter.spare] > 1}
        return [bare.get(text, text) for text in each]

    def _broken(
        self, letters: Sequence[tuple[Text, str]], parts: Sequence[str], scene: Scene
    ) -> tuple[list[str], dict[int, _Whole]]:
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
        shapes, stages, whole = list[Shape](), list[str](), dict[int, _Whole]()
        for shape, part in zip(self.shapes, parts, strict=True):
            at = boxes if getattr(shape, "role", "") in self.breaks else through
            pieces = left_of(shape, tuple(at)) if at else [shape]
            if pieces != [shape]:
                whole |= dict.fromkeys(range(len(shapes), len(shapes) + len(pieces)), _Whole(shape, at))
            shapes += pieces
            stages += [part] * len(pieces)
        self.shapes = shapes
        return stages, whole

    def _placed(self) -> tuple[dict[str, _Letter], Labels, Scene]:
        """Place the letters, all as small as texts where not every one has a place; then some are left out.

        They are so, too, where `SEVERAL` would be left out else and `WORTH` fewer are then. Where that does not help,
        either, leaders cross lines.
        """
        thin = (Line, Arc, Group)
        shapes = [shape for shape in self.shapes if not (isinstance(shape, thin) and self.breaks.get(shape.role))]
        shapes = [coarser(shape, self.coarse) for shape in shapes] if self.coarse else shapes
        scene = self._scene(_obstacles(shapes, self._boxes, self.style))
        letters, drawn, last = self._letters, scene, False
        large = self._settled(scene) if scene.shut_in <= SHUT_IN else None
        placed = large = None if large is None or large.failed else large
        gone = 0 if large is None else len(self._left_out(large.corners))
        if placed is None or gone >= SEVERAL:
            self._letters = {name: self._small(letter) for name, letter in self._letters.items()}
            scene = self._scene(scene)
            placed = self._settled(scene)
            if large is not None and (placed.failed or len(self._left_out(placed.corners)) > gone - WORTH):
                self._letters, scene, placed = letters, drawn, large
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
        layout = lay_out(letter.markup, self.style.text)
        width, height = layout.size
        request = replace(letter.request, width=width, height=height, bare=layout.bare)
        return letter._replace(request=request, height=self.style.text)

    def _scene(self, drawn: Obstacles | Scene, last: bool = False) -> Scene:
        """Return what is to be lettered; at `last` vectors whose ends may have no letters have theirs far away."""
        requests = tuple(letter.request for letter in self._letters.values())
        if last:
            ends = {letter.spare for letter in self._letters.values() if letter.stays}
            requests = tuple(replace(r, afield=r.afield or self._letters[r.name].spare in ends) for r in requests)
        return drawn.asking(requests) if isinstance(drawn, Scene) else scene_of(requests, drawn, self.bounds)

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
            if gone and all(self._letters[name].stays for name in gone):  # the end of a vector says more than its name
                sides = [name for name in spare if not self._letters[name].stays]
                if (fewer := _given_way(scene, placed, out, gone, sides, cross)) is not None:
                    out, placed = fewer
                    continue
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


def _given_way(
    scene: Scene, placed: Labels, out: set[str], gone: Collection[str], others: Sequence[str], cross: bool
) -> tuple[set[str], Labels] | None:
    """Return who is left out, and where all stand, where one or all of the nearest `others` make room for `gone` ones.

    There is nothing to return where they do not.
    """
    at = placed.corners
    near = sorted(others, key=lambda name: (min(abs(at[name] - at[other]) for other in gone), name))[:ASKED]
    for aside in (*((name,) for name in near), near):
        again = scene.place(out.union(aside), cross)
        if len(again.failed) < len(placed.failed):
            return out.union(aside), again
    return None


def left_of(shape: Shape, boxes: tuple[Box, ...]) -> list[Shape]:
    """Return what is left of a thin line, or of thin lines in a group, beside boxes; all of it where nothing is."""
    match shape:
        case Line(a=a, b=b, pen=pen, role=role) if pen is not Pen.MAIN and role not in UNBROKEN:
            sides = beside(a, b, boxes)
            if role == "construction":  # its ends are free: a dot beside a letter would read as a prime
                sides = [side for side in sides if abs(side[1] - side[0]) >= DOT] or sides
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
    """Return views with the numbers of the figures among them, in order, before their headings, and of details."""
    number, numerals = count(1), iter(NUMERALS)
    return [
        _numbered(v, next(number), dict(zip(v.details, numerals, strict=False)))
        if v.heading and not (v.rows or v.lines)
        else v
        for v in views
    ]


def _numbered(view: View, number: int, numerals: Mapping[str, str]) -> View:
    """Return a view with its number before its heading, as wide as that needs, and the `numerals` of its details."""

    def said(text: str) -> str:
        return _WORD.sub(lambda found: numerals.get(found[0], found[0]), text)

    def with_numerals(shape: Shape) -> Shape:
        match shape:
            case Text(markup=markup):
                return replace(shape, markup=said(markup))
            case Line(role="leader" | "shelf", name=name):
                return replace(shape, name=said(name))
        return shape

    if numerals:
        told = tuple(changed(shape, with_numerals) for shape in view.shapes)
        view = replace(view, shapes=told, notes=tuple(map(said, view.notes)))
    shapes, (x0, y0, x1, y1) = list(view.shapes), view.box
    for i, shape in enumerate(shapes):
        if isinstance(shape, Text) and shape.role == "heading" and shape.markup == view.heading[0]:
            text = replace(shape, markup=f"{number}. {shape.markup}")
            half = 0.5 * lay_out(text.markup, text.height).width + BESIDE * text.height
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


def _joined(shapes: Sequence[Shape], heading: Sequence[str], notes: Sequence[str], style: Style) -> tuple[str, ...]:
    """Return notes as many in a line as have room over these shapes, or in the longest line without that."""

    def wide(line: str, height: float = style.text) -> float:
        layout = lay_out(line, height)
        return layout.right - layout.left

    x0, _, x1, _ = extent(shapes)
    room = max(x1 - x0, *(wide(line, style.heading) for line in heading), *map(wide, notes))
    lines = list[str]()
    for note in notes:
        if lines and wide(longer := f"{lines[-1]}; {note}") <= room:
            lines[-1] = longer
        else:
            lines.append(note)
    return tuple(lines)


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
                filled = isinstance(shape, Polyline) and shape.fill not in (False, "white")
                strokes[whole or filled or shape.pen is Pen.MAIN or shape.role in UNBROKEN].extend(sides_of(shape))
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
    main, thin = map(tuple, strokes.values())
    return Obstacles(main, thin, tuple(circles), tuple(texts), tuple(heads), tuple(boxes))
