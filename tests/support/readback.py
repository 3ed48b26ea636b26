"""The reader of drawn sheets: an SVG parsed with lxml, y turned up, lengths in mm; it imports nothing that draws.

The boxes of letters are measured with fontTools on the glyphs that the SVG names, not with the layout that placed them.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from lxml import etree

from kulman.tests.support.glyphs import Box, advance, ink

SVG = "{http://www.w3.org/2000/svg}"
CAP = 0.729  # cap height of DejaVu Sans in ems


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
    path: tuple[tuple[str, str], ...]
    arc: tuple[complex, float, float] | None = None  # centre, radius, sweep


@dataclass(frozen=True)
class Ring:
    centre: complex
    radius: float
    width: float
    fill: str
    path: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Tip:
    """An arrowhead; its first corner is the tip."""

    corners: tuple[complex, complex, complex]
    path: tuple[tuple[str, str], ...]

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
    name: str
    tail: complex
    tip: complex

    @property
    def unit(self) -> complex:
        return (self.tip - self.tail) / abs(self.tip - self.tail)


@dataclass(frozen=True)
class Run:
    at: complex
    size: float
    string: str
    box: Box


@dataclass(frozen=True)
class Text:
    """One text: `string` has scripts as `_{}` and `^{}`; `rules` are bars over it and underlines."""

    role: str
    name: str
    runs: tuple[Run, ...]
    rules: tuple[tuple[complex, complex], ...]
    string: str
    path: tuple[tuple[str, str], ...]
    turned: bool

    @property
    def box(self) -> Box:
        boxes = [run.box for run in self.runs]
        boxes += [(min(a.real, b.real), a.imag - 0.1, max(a.real, b.real), a.imag + 0.1) for a, b in self.rules]
        x0, y0, x1, y1 = zip(*boxes, strict=True)
        return min(x0), min(y0), max(x1), max(y1)

    @property
    def baseline(self) -> float:
        return max(self.runs, key=lambda run: run.size).at.imag


@dataclass
class View:
    """All that stands in one group: a view, or what is outside of all views (frame and title block)."""

    name: str
    page: int
    strokes: list[Stroke] = field(default_factory=list)
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

    def point(self, name: str) -> complex:
        """Centre of the circle in the group (pair, pivot, centre, point) called `name`."""
        kinds = ("pair", "pivot", "centre", "point")
        (found,) = [r for r in self.rings if any(k in kinds and n == name for k, n in r.path)]
        return found.centre

    def has(self, name: str) -> bool:
        kinds = ("pair", "pivot", "centre", "point")
        return any(k in kinds and n == name for r in self.rings for k, n in r.path)

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
        points = [p for s in self.strokes for p in _thick(s)]
        points += [c for t in self.tips for c in t.corners]
        for r in self.rings:
            reach = (r.radius + r.width / 2) * (1 + 1j)
            points += [r.centre - reach, r.centre + reach]
        for text in self.texts:
            x0, y0, x1, y1 = text.box
            points += [complex(x0, y0), complex(x1, y1)]
        for inset in self.insets:
            x0, y0, x1, y1 = inset.box
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
        (found,) = [v for v in self.views if v.name == name]
        return found

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


def read(*svgs: str | bytes) -> Sheet:
    """Read the pages of a sheet."""
    return Sheet([_page(number, svg) for number, svg in enumerate(svgs, start=1)])


def _page(number: int, svg: str | bytes) -> Page:
    root = etree.fromstring(svg.encode() if isinstance(svg, str) else svg)
    _, _, width, height = map(float, root.get("viewBox").split())
    views: dict[str, View] = {}
    rest = View("", number)
    for child in _leafed(root):
        if child.tag == f"{SVG}g" and child.get("class") == "view":
            name = child.get("data-name")
            _walk(child, views.setdefault(name, View(name, number)), (), height)
        else:
            _element(child, rest, (), height)
    return Page(width, height, root, list(views.values()), rest)


def _leafed(root: etree._Element) -> Iterator[etree._Element]:
    """Go through what a page or its layers hold: first what is given, where every view has its heading."""
    layers = [child for child in root if child.get("class") == "layer"]
    for layer in sorted(layers, key=lambda layer: layer.get("id") != "layer-given"):
        yield from layer
    yield from (child for child in root if child not in layers)


def _walk(group: etree._Element, view: View, path: tuple[tuple[str, str], ...], height: float) -> None:
    for child in group:
        _element(child, view, path, height)


def _element(e: etree._Element, view: View, path: tuple[tuple[str, str], ...], height: float) -> None:
    kind = etree.QName(e).localname
    role, name = e.get("class", ""), e.get("data-name", "")
    if kind == "g":
        inner = (*path, (role, name or e.get("data-quantity", "")))
        if role == "enlarged":
            view.insets.append(View(name, view.page))
            _walk(e, view.insets[-1], (), height)
            return
        texts = e.findall(f"{SVG}text")
        if texts and all(etree.QName(c).localname in ("text", "line") for c in e) and role not in ("table", "text"):
            rules = tuple(_ends(c, height) for c in e.findall(f"{SVG}line"))
            if all(c.get("class") == "rule" for c in e.findall(f"{SVG}line")) and not _separate(e):
                view.texts.append(_text(texts, rules, role, name, path, height))
                return
        if role == "vector":
            tail, tip = _ends(e.find(f"{SVG}line"), height)
            facts = float(e.get("data-value")), e.get("data-unit"), float(e.get("data-mu"))
            view.vectors.append(Vec(e.get("data-quantity"), *facts, tail, tip))
        span = e.find(f"{SVG}line[@class='span']")
        if role == "arrow" and span is not None:
            view.arrows.append(Arrow(name, *_ends(span, height)))
        _walk(e, view, inner, height)
    elif kind == "text":
        view.texts.append(_text([e], (), role, name, path, height))
    elif kind == "circle":
        centre = complex(float(e.get("cx")), height - float(e.get("cy")))
        width = float(e.get("stroke-width", "0"))
        view.rings.append(Ring(centre, float(e.get("r")), width, e.get("fill", ""), path))
    elif kind in ("line", "polyline", "polygon", "path") and role not in ("span",):
        if role == "head":
            a, b, c = _places(e.get("points"), height)
            view.tips.append(Tip((a, b, c), path))
        else:
            view.strokes.append(_stroke(e, kind, role, name, path, height))


def _separate(group: etree._Element) -> bool:
    """Tell a group of texts that have a class of their own from the runs of one text."""
    return any(text.get("class") for text in group.findall(f"{SVG}text"))


def _ends(line: etree._Element, height: float) -> tuple[complex, complex]:
    x1, y1, x2, y2 = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
    return complex(x1, height - y1), complex(x2, height - y2)


def _places(text: str, height: float) -> tuple[complex, ...]:
    pairs = (pair.split(",") for pair in text.split())
    return tuple(complex(float(x), height - float(y)) for x, y in pairs)


def _stroke(
    e: etree._Element, kind: str, role: str, name: str, path: tuple[tuple[str, str], ...], height: float
) -> Stroke:
    arc = None
    if kind == "line":
        points: tuple[complex, ...] = _ends(e, height)
    elif kind == "path":
        points, arc = _arc(e.get("d"), height)
    else:
        points = _places(e.get("points"), height)
        points = (*points, points[0]) if kind == "polygon" else points
    width = float(e.get("stroke-width", "0"))
    dashed = e.get("stroke-dasharray") is not None
    return Stroke(points, width, role, name, dashed, e.get("stroke", ""), e.get("fill", ""), path, arc)


def _arc(d: str, height: float) -> tuple[tuple[complex, ...], tuple[complex, float, float]]:
    """Read `M x y A r r 0 0 f x y ...`: points every few degrees, centre, radius, sweep counter-clockwise."""
    numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", d)]
    start = complex(numbers[0], height - numbers[1])
    points, total, centre, radius = [start], 0.0, 0j, 0.0
    for at in range(2, len(numbers), 7):
        radius, flag = numbers[at], numbers[at + 4]
        end = complex(numbers[at + 5], height - numbers[at + 6])
        chord = end - points[-1]
        sense = -1.0 if flag else 1.0  # y is turned up
        depth = math.sqrt(max(radius**2 - abs(chord) ** 2 / 4, 0.0))
        centre = points[-1] + chord / 2 + sense * 1j * chord / abs(chord) * depth
        sweep = sense * abs(cmath.phase((end - centre) / (points[-1] - centre)))
        first = points[-1] - centre
        points += [centre + first * cmath.rect(1.0, sweep * k / 12) for k in range(1, 13)]
        points[-1] = end
        total += sweep
    return tuple(points), (centre, radius, total)


def _text(
    texts: Sequence[etree._Element],
    rules: tuple[tuple[complex, complex], ...],
    role: str,
    name: str,
    path: tuple[tuple[str, str], ...],
    height: float,
) -> Text:
    runs = []
    for e in texts:
        at, size = complex(float(e.get("x")), height - float(e.get("y"))), float(e.get("font-size"))
        runs.append(Run(at, size, e.text or "", ink(e.text or "", at, size, e.get("transform"), height)))
    first = texts[0]
    role, name = (role, name) if role else (first.get("class", ""), first.get("data-name", ""))
    turned = any(e.get("transform") for e in texts)
    return Text(role, name, tuple(runs), rules, _joined(runs), path, turned)


def _joined(runs: Sequence[Run]) -> str:
    """Write the runs as one line, the small ones as scripts."""
    main = max(run.size for run in runs)
    (base, *_) = [run.at.imag for run in runs if run.size == main]
    out, end = "", runs[0].at.real
    for run in runs:
        script = "" if run.size > 0.9 * main else "_" if run.at.imag < base else "^"
        if not script and out and run.at.real - end > 0.2 * main:
            out += " "
        out += f"{script}{{{run.string}}}" if script else run.string
        end = run.at.real + advance(run.string) * run.size
    return out


def _thick(stroke: Stroke) -> Iterator[complex]:
    half = stroke.width / 2 * (1 + 1j)
    for point in stroke.points:
        yield point - half
        yield point + half


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


def thick(stroke: Stroke) -> shapely.Geometry:
    """The ink of a stroke."""
    line = shapely.LineString([(p.real, p.imag) for p in stroke.points])
    return line.buffer(stroke.width / 2, cap_style="flat")
