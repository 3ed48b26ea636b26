"""The reader of drawn sheets: an SVG parsed with lxml, y turned up, lengths in mm; it imports nothing that draws.

The boxes of letters are measured with fontTools on the fonts that the SVG embeds, not with the layout that placed them.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from lxml import etree

from kulman.tests.support.glyphs import Box, Lettering, advance, ink

SVG = "{http://www.w3.org/2000/svg}"
MARKED = ("pair", "pivot", "centre", "point")  # groups whose circle is a point
APART = 30.0  # mm between pieces of a line that is broken at a letter
Path = tuple[tuple[str, str], ...]
Rules = tuple[tuple[complex, complex], ...]

DOWN = 2000.0  # mm, farther than any page reaches


@dataclass(frozen=True)
class Stroke:
    """A drawn line, broken line or arc (as a broken line), with the classes and names of the groups around it."""

    points: tuple[complex, ...]
    width: float
    role: str
    name: str
    dashed: bool
    colour: str
    fill: str
    path: Path
    arc: tuple[complex, float, float] | None = None  # centre, radius, sweep

    @cached_property
    def ink(self) -> shapely.Geometry:
        line = shapely.LineString([(p.real, p.imag) for p in self.points])
        return line.buffer(self.width / 2, cap_style="flat")


@dataclass(frozen=True)
class Ring:
    centre: complex
    radius: float
    width: float
    fill: str
    path: Path


@dataclass(frozen=True)
class Tip:
    """An arrowhead; its first corner is the tip."""

    corners: tuple[complex, complex, complex]
    path: Path

    @property
    def length(self) -> float:
        return abs(self.corners[0] - (self.corners[1] + self.corners[2]) / 2)


@dataclass(frozen=True)
class Vec:
    quantity: str
    value: float
    unit: str
    mu: float
    tail: complex
    tip: complex

    @property
    def span(self) -> complex:
        return self.tip - self.tail


@dataclass(frozen=True)
class Arrow:
    """An arrow as it is drawn; `aside` is by how much it stands beside its own line, to which a thin line leads."""

    name: str
    tail: complex
    tip: complex
    aside: complex = 0j

    @property
    def on(self) -> complex:
        """A place on the line of the force."""
        return self.tail - self.aside

    @property
    def unit(self) -> complex:
        return (self.tip - self.tail) / abs(self.tip - self.tail)


@dataclass(frozen=True)
class Run:
    at: complex
    size: float
    string: str
    corners: tuple[complex, ...]  # of its ink
    advance: float  # mm
    cap: float  # mm, the height of its capitals


@dataclass(frozen=True)
class Text:
    """One text: `string` has scripts as `_{}` and `^{}`; `rules` are bars over it and underlines."""

    role: str
    name: str
    runs: tuple[Run, ...]
    rules: Rules
    string: str
    path: Path
    turned: bool
    of: tuple[complex, ...] = ()  # the node, or the ends of the line, that it letters

    @cached_property
    def corners(self) -> list[complex]:
        """Corners of its runs and of the ink of its rules."""
        rules = [end + half for rule in self.rules for end in rule for half in (-0.1j, 0.1j)]
        return [*(corner for run in self.runs for corner in run.corners), *rules]

    @cached_property
    def box(self) -> Box:
        xs, ys = [p.real for p in self.corners], [p.imag for p in self.corners]
        return min(xs), min(ys), max(xs), max(ys)

    @cached_property
    def area(self) -> shapely.Geometry:
        """Its box, turned with it."""
        if not self.turned:
            return shapely.box(*self.box)
        return shapely.MultiPoint([(p.real, p.imag) for p in self.corners]).convex_hull

    @property
    def baseline(self) -> float:
        return max(self.runs, key=lambda run: run.size).at.imag


def joined(strokes: Iterable[Stroke]) -> list[Stroke]:
    """Strokes, pieces in a row of one line or arc with a name, at most so many mm apart, as the whole of it."""
    wholes: list[Stroke] = []
    for stroke in strokes:
        before = wholes[-1] if wholes else stroke
        alike = replace(before, points=stroke.points, arc=stroke.arc) == stroke and (stroke.name or stroke.path)
        apart = 0.01 < abs(stroke.points[0] - before.points[-1]) < APART
        if wholes and alike and apart and (stroke.arc is None) == (before.arc is None) and _in_line(before, stroke):
            arc = stroke.arc and (*stroke.arc[:2], _swept(before, stroke))
            wholes[-1] = replace(
                before, points=(*before.points, *stroke.points) if arc else _ends(before, stroke), arc=arc
            )
        else:
            wholes.append(stroke)
    return wholes


def _ends(first: Stroke, last: Stroke) -> tuple[complex, complex]:
    return first.points[0], last.points[-1]


def _in_line(first: Stroke, second: Stroke) -> bool:
    """Whether the second stroke goes on where the first ends."""
    if first.arc and second.arc:
        same = abs(first.arc[0] - second.arc[0]) < 0.01 and abs(first.arc[1] - second.arc[1]) < 0.01
        return same and first.arc[2] * second.arc[2] > 0
    if len(first.points) != 2 or len(second.points) != 2:
        return False
    way = first.points[1] - first.points[0]
    on = [(end - first.points[0]) / way for end in second.points]
    return 1.0 < on[0].real < on[1].real and all(abs(at.imag * way) < 0.02 for at in on)


def _swept(first: Stroke, last: Stroke) -> float:
    assert first.arc is not None
    assert last.arc is not None
    centre, _, sweep = first.arc
    gap = cmath.phase((last.points[0] - centre) / (first.points[-1] - centre))
    return sweep + gap + last.arc[2]


@dataclass
class View:
    """All that stands in one group: a view, or what is outside of all views (frame and title block).

    Of a line that is broken at letters the whole is in `strokes`, what is drawn of it in `pieces`.
    """

    name: str
    page: int
    strokes: list[Stroke] = field(default_factory=list)
    pieces: list[Stroke] = field(default_factory=list)
    rings: list[Ring] = field(default_factory=list)
    tips: list[Tip] = field(default_factory=list)
    vectors: list[Vec] = field(default_factory=list)
    arrows: list[Arrow] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    insets: list[View] = field(default_factory=list)

    def of(self, role: str) -> list[Text]:
        return [text for text in self.texts if text.role == role]

    def lines(self, role: str = "", name: str = "") -> list[Stroke]:
        return [s for s in self.strokes if role in ("", s.role) and name in ("", s.name)]

    def inside(self, role: str, name: str = "") -> list[Stroke]:
        """Strokes in groups of the class `role` called `name`."""
        return [s for s in self.strokes if any(k == role and name in ("", n) for k, n in s.path)]

    def vector(self, quantity: str) -> Vec:
        (found,) = [v for v in self.vectors if v.quantity == quantity]
        return found

    def arrow(self, name: str) -> Arrow:
        (found,) = [a for a in self.arrows if a.name == name]
        return found

    def marked(self, name: str) -> list[Ring]:
        return [ring for ring in self.rings if any(k in MARKED and n == name for k, n in ring.path)]

    @property
    def nodes(self) -> list[Ring]:
        """Circles of joints, centres of mass, points of loads, ends of vectors; in a group of points the innermost."""
        return [ring for ring in self.rings if ring.path and ring.path[-1][0] in MARKED]

    def point(self, name: str) -> complex:
        """Centre of the circle in the group (pair, pivot, centre, point) called `name`."""
        (found,) = self.marked(name)
        return found.centre

    def has(self, name: str) -> bool:
        return bool(self.marked(name))

    def turning(self, name: str) -> tuple[complex, float, complex] | None:
        """Centre, sense (+1 counter-clockwise) and tip of a turning arrow; the head must stand at the arc's end."""
        arcs = [s for s in self.inside("arrow", name) if s.arc]
        heads = [t for t in self.tips if ("arrow", name) in t.path]
        if not arcs:
            return None
        ((arc,), (head,)) = arcs, heads
        assert arc.arc is not None
        assert abs(head.corners[0] - arc.points[-1]) < 0.01, name
        centre, _, sweep = arc.arc
        lever = (head.corners[1] + head.corners[2]) / 2 - centre
        assert cross(lever, head.corners[0] - centre) * sweep > 0, name
        return centre, math.copysign(1.0, sweep), head.corners[0]

    @property
    def box(self) -> Box:
        round_ = [(p, s.width / 2) for s in self.strokes for p in s.points]
        round_ += [(ring.centre, ring.radius + ring.width / 2) for ring in self.rings]
        points = [c for t in self.tips for c in t.corners]
        points += [at + sign * reach * (1 + 1j) for at, reach in round_ for sign in (-1.0, 1.0)]
        for x0, y0, x1, y1 in (part.box for part in (*self.texts, *self.insets)):
            points += [complex(x0, y0), complex(x1, y1)]
        xs, ys = [p.real for p in points], [p.imag for p in points]
        return min(xs), min(ys), max(xs), max(ys)


@dataclass
class Page:
    width: float
    height: float
    root: etree._Element
    views: list[View]
    rest: View

    @property
    def all(self) -> list[View]:
        return [*self.views, *(inset for view in self.views for inset in view.insets), self.rest]


@dataclass
class Sheet:
    pages: list[Page]

    def __getitem__(self, name: str) -> View:
        """The view of a name; what goes on with its table or text on later pages is below it."""
        (found,) = [v for v in self.views if v.name == name]
        more = [v for v in self.views if v.name.startswith(f"{name}_continued")]
        if not more:
            return found
        return replace(found, texts=[*found.texts, *(t for k, v in enumerate(more, 1) for t in _below(v, k))])

    @property
    def views(self) -> list[View]:
        return [v for p in self.pages for v in p.views]

    @property
    def names(self) -> list[str]:
        return [v.name for v in self.views]

    @property
    def vectors(self) -> list[Vec]:
        return [v for page in self.pages for view in page.all for v in view.vectors]

    @property
    def texts(self) -> list[Text]:
        return [t for p in self.pages for v in p.all for t in v.texts]


def _below(view: View, number: int) -> list[Text]:
    """The texts of what goes on, without the head of a table, so far down as no page reaches."""
    head = max((text.baseline for text in view.of("cell")), default=math.inf)
    kept = [text for text in view.texts if text.role != "cell" or abs(text.baseline - head) > 0.01]
    by = -1j * number * DOWN
    return [replace(text, runs=tuple(_moved(run, by) for run in text.runs)) for text in kept]


def _moved(run: Run, by: complex) -> Run:
    return replace(run, at=run.at + by, corners=tuple(corner + by for corner in run.corners))


def svgs(drawn: Any) -> list[str]:
    """Return the pages of what has been drawn, as SVG."""
    return [drawn.svg(number) for number in range(1, len(drawn.pages) + 1)]


def read_back(drawn: Any) -> Sheet:
    """Return a sheet as it is read of its pages."""
    return read(*svgs(drawn))


def read(*svgs: str | bytes) -> Sheet:
    """Read the pages of a sheet."""
    return Sheet([_page(number, svg) for number, svg in enumerate(svgs, start=1)])


def _page(number: int, svg: str | bytes) -> Page:
    root = etree.fromstring(svg.encode() if isinstance(svg, str) else svg)
    _, _, width, height = map(float, root.get("viewBox").split())
    views: dict[str, View] = {}
    rest, reader = View("", number), _Reader(height, Lettering(root))
    layers = [child for child in root if child.get("class") == "layer"]
    layers.sort(key=lambda layer: layer.get("id") != "layer-given")  # there every view has its heading
    for child in (*(child for layer in layers for child in layer), *(child for child in root if child not in layers)):
        if child.tag == f"{SVG}g" and child.get("class") == "view":
            name = child.get("data-name")
            reader.inside(child, views.setdefault(name, View(name, number)), ())
        else:
            reader.element(child, rest, ())
    page = Page(width, height, root, list(views.values()), rest)
    for view in page.all:
        view.pieces, view.strokes = view.strokes, joined(view.strokes)
        view.arrows = [_beside(view, arrow) for arrow in view.arrows]
    return page


def _beside(view: View, arrow: Arrow) -> Arrow:
    """An arrow with what the line says that leads from its point to its end, where it stands beside its own line."""
    for line in view.lines("extension", arrow.name):
        lead = line.points[-1] - line.points[0]
        if min(abs(line.points[-1] - end) for end in (arrow.tail, arrow.tip)) < 0.01:
            return replace(arrow, aside=1j * arrow.unit * (lead / arrow.unit).imag)
    return arrow


@dataclass(frozen=True)
class _Reader:
    """Reads elements of a page of this height into views; `path` are classes and names of the groups around them."""

    height: float
    lettering: Lettering

    def inside(self, group: etree._Element, view: View, path: Path) -> None:
        for child in group:
            self.element(child, view, path)

    def element(self, e: etree._Element, view: View, path: Path) -> None:
        kind, role, name = etree.QName(e).localname, e.get("class", ""), e.get("data-name", "")
        if kind == "g":
            self.group(e, view, path)
        elif kind == "text":
            view.texts.append(self.text(e, [e], (), path))
        elif kind == "circle":
            width, fill = float(e.get("stroke-width", "0")), e.get("fill", "")
            view.rings.append(Ring(self.at(e.get("cx"), e.get("cy")), float(e.get("r")), width, fill, path))
        elif role == "head":
            a, b, c = self.places(e.get("points"))
            view.tips.append(Tip((a, b, c), path))
        elif kind in ("line", "polyline", "polygon", "path") and role != "span":
            view.strokes.append(self.stroke(e, kind, role, name, path))

    def group(self, e: etree._Element, view: View, path: Path) -> None:
        role, name = e.get("class", ""), e.get("data-name", "")
        texts, lines = e.findall(f"{SVG}text"), e.findall(f"{SVG}line")
        runs = not any(text.get("class") for text in texts) and all(line.get("class") == "rule" for line in lines)
        if role == "enlarged":
            view.insets.append(View(name, view.page))
            self.inside(e, view.insets[-1], ())
        elif texts and runs and len(texts) + len(lines) == len(e) and role not in ("table", "text"):
            view.texts.append(self.text(e, texts, tuple(map(self.ends, lines)), path))
        else:
            if role == "vector":
                facts = float(e.get("data-value")), e.get("data-unit"), float(e.get("data-mu"))
                view.vectors.append(Vec(e.get("data-quantity"), *facts, *self.ends(lines[0])))
            span = e.find(f"{SVG}line[@class='span']")
            if role == "arrow" and span is not None:
                view.arrows.append(Arrow(name, *self.ends(span)))
            self.inside(e, view, (*path, (role, name or e.get("data-quantity", ""))))

    def at(self, x: str | float, y: str | float) -> complex:
        return complex(float(x), self.height - float(y))

    def ends(self, line: etree._Element) -> tuple[complex, complex]:
        return self.at(line.get("x1"), line.get("y1")), self.at(line.get("x2"), line.get("y2"))

    def places(self, text: str) -> tuple[complex, ...]:
        return tuple(self.at(*pair.split(",")) for pair in text.split())

    def stroke(self, e: etree._Element, kind: str, role: str, name: str, path: Path) -> Stroke:
        arc = None
        if kind == "line":
            points: tuple[complex, ...] = self.ends(e)
        elif kind == "path":
            points, arc = self.arc(e.get("d"))
        else:
            points = self.places(e.get("points"))
            points = (*points, points[0]) if kind == "polygon" else points
        width, dashed = float(e.get("stroke-width", "0")), e.get("stroke-dasharray") is not None
        return Stroke(points, width, role, name, dashed, e.get("stroke", ""), e.get("fill", ""), path, arc)

    def arc(self, d: str) -> tuple[tuple[complex, ...], tuple[complex, float, float]]:
        """Read `M x y A r r 0 0 f x y ...`: points every few degrees, centre, radius, sweep counter-clockwise."""
        numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", d)]
        points, total, centre, radius = [self.at(*numbers[:2])], 0.0, 0j, 0.0
        for k in range(2, len(numbers), 7):
            radius, sense = numbers[k], -1.0 if numbers[k + 4] else 1.0  # y is turned up
            start, end = points[-1], self.at(*numbers[k + 5 : k + 7])
            depth = math.sqrt(max(radius**2 - abs(end - start) ** 2 / 4, 0.0))
            centre = (start + end) / 2 + sense * 1j * (end - start) / abs(end - start) * depth
            sweep = sense * abs(cmath.phase((end - centre) / (start - centre)))
            points += [centre + (start - centre) * cmath.rect(1.0, sweep * i / 12) for i in range(1, 12)] + [end]
            total += sweep
        return tuple(points), (centre, radius, total)

    def text(self, owner: etree._Element, texts: Sequence[etree._Element], rules: Rules, path: Path) -> Text:
        runs = []
        for e in texts:
            at, size, string = self.at(e.get("x"), e.get("y")), float(e.get("font-size")), e.text or ""
            faces = self.lettering.of(e)
            corners = ink(string, faces, at, size, e.get("transform"), self.height)
            runs.append(Run(at, size, string, corners, advance(string, faces) * size, faces[0].cap * size))
        turn = re.match(r"rotate\((-?[\d.]+)", texts[0].get("transform") or "")
        level = cmath.rect(1.0, math.radians(float(turn[1]))) if turn else 1.0
        e = owner if owner.get("class") else texts[0]
        of, turned = self.places(e.get("data-of", "")), any(t.get("transform") for t in texts)
        return Text(
            e.get("class", ""), e.get("data-name", ""), tuple(runs), rules, _joined(runs, level), path, turned, of
        )


def _joined(runs: Sequence[Run], level: complex = 1.0) -> str:
    """Write the runs as one line, the small ones as scripts; `level` turns a turned text back."""
    main = max(run.size for run in runs)
    (base, *_) = [(run.at * level).imag for run in runs if run.size == main]
    out, end = "", (runs[0].at * level).real
    for run in runs:
        at = run.at * level
        script = "" if run.size > 0.9 * main else "_" if at.imag < base else "^"
        if not script and out and at.real - end > 0.2 * main:
            out += " "
        out += f"{script}{{{run.string}}}" if script else run.string
        end = at.real + run.advance
    return out


def cross(a: complex, b: complex) -> float:
    """Positive when b is turned counter-clockwise from a."""
    return (a.conjugate() * b).imag


def angle(a: complex, b: complex) -> float:
    """Angle from a to b in degrees."""
    return math.degrees(cmath.phase(b / a))


def parallel(a: complex, b: complex, degrees: float = 0.01) -> bool:
    """Same direction within so many degrees."""
    return abs(angle(a, b)) < degrees


def polygon(points: Sequence[complex]) -> shapely.Polygon:
    return shapely.Polygon([(p.real, p.imag) for p in points])


def boxes(many: Sequence[Box]) -> np.ndarray:
    array = np.array(many, dtype=float).reshape(-1, 4)
    return shapely.box(*array.T)
