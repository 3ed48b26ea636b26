"""SVG read back: elements in one another, each with a map of its own and the looks of those about it."""

from __future__ import annotations

import math
import re
import zlib
from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree import ElementTree

from .marks import CAPITAL, DEEPEST, INCH, LARGEST, LONGEST, PIXEL, POINT, WIDE, Affine, FaultError, Marks

MOST_TAGS = 200_000
_GZIP = b"\x1f\x8b"
_SVG = "{http://www.w3.org/2000/svg}"
_HREF = "{http://www.w3.org/1999/xlink}href"
_PARSED = 32_768  # bytes parsed at a time
_DECLARED = re.compile(rb"<!ENTITY|<!DOCTYPE[^>]{0,2000}\[")
_RULE = re.compile(r"\.([\w-]{1,80})\s*\{([^{}]{0,2000})\}")
_LENGTH = re.compile(r"\s*([-+]?[0-9.]{1,20}(?:[eE][-+]?[0-9]{1,3})?)\s*(mm|cm|in|pt|pc|px|%)?\s*")
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_STEP = re.compile(rf"[A-DF-Za-df-z]|{_NUMBER.pattern}")
_CHANGE = re.compile(r"(matrix|translate|scale|rotate|skewX|skewY)\s*\(([^()]{0,400})\)")
LENGTHS = {"mm": 1.0, "cm": 10.0, "in": INCH, "pt": POINT, "pc": 12 * POINT, "px": PIXEL, None: PIXEL}
LOOKS = ("stroke", "fill", "font-size", "text-anchor", "display", "visibility")
UNSEEN = {"defs", "symbol", "clipPath", "marker", "mask", "pattern", "metadata", "title", "desc", "style", "script",
          "foreignObject", "linearGradient", "radialGradient", "filter", "animate"}  # fmt: skip
TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}  # numbers of a step of a path


def read_svg(data: bytes) -> Marks:
    """Read an SVG, also one packed with gzip; declarations of entities are refused."""
    if data.startswith(_GZIP):
        data = zlib.decompressobj(31).decompress(data, LARGEST + 1)
        if len(data) > LARGEST:
            raise FaultError("drawing-large")
    if data.count(b"<") > MOST_TAGS:
        raise FaultError("drawing-many")
    if _DECLARED.search(data) or b"\0" in data:
        raise FaultError("drawing-declared")
    root, depth = None, 0
    parser: Any = ElementTree.XMLPullParser(("start", "end"))
    for at in range(0, len(data), _PARSED):
        parser.feed(data[at : at + _PARSED])
        for event, element in parser.read_events():
            root = element if root is None else root
            depth += 1 if event == "start" else -1
            if depth > 4 * DEEPEST:
                raise FaultError("drawing-deep")
    parser.close()
    if root is None or root.tag != f"{_SVG}svg":
        raise ValueError
    found = _Svg(root)
    found.draw(root, found.page(), {}, 0)
    return found.marks


class _Svg:
    """Draws the elements of an SVG."""

    def __init__(self, root: ElementTree.Element) -> None:
        self.root, self.marks = root, Marks()
        self.named = {element.get("id", ""): element for element in root.iter()}
        styles = "".join("".join(element.itertext()) for element in root.iter(f"{_SVG}style"))
        self.classes = {name: _style(rules) for name, rules in _RULE.findall(styles[:1_000_000])}

    def page(self) -> Affine:
        """Return the map from user units to mm, y up."""
        box = [float(number) for number in _NUMBER.findall(self.root.get("viewBox", ""))]
        width, height = (_length(self.root.get(name), math.nan) for name in ("width", "height"))
        if len(box) != 4 or not box[2] > 0.0 < box[3]:
            return Affine.of(PIXEL, -PIXEL * 1j)
        scales = [s for s in (width / box[2], height / box[3]) if s == s and s > 0.0] or [PIXEL]
        scale = min(scales)
        return Affine.of(scale + 0j, -scale * 1j, scale * complex(-box[0], box[1] + box[3]))

    def draw(self, element: ElementTree.Element, way: Affine, looks: Mapping[str, str], depth: int) -> None:
        """Draw an element and what stands in it; what is drawn from elsewhere counts each time."""
        self.marks.count()
        if depth > 4 * DEEPEST:
            raise FaultError("drawing-deep")
        kind = element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
        if kind in UNSEEN and depth:
            return
        looks = {**looks, **self.looks(element)}
        if looks.get("display") == "none":
            return
        way = way.after(_change(element.get("transform", "")))
        if kind in ("use", "svg") and depth:
            way = way.after(Affine(t=complex(_length(element.get("x")), _length(element.get("y"))) / PIXEL))
        if kind == "use":
            other = self.named.get((element.get("href") or element.get(_HREF) or "").removeprefix("#"))
            if other is not None:
                self.copy(other, way, looks, depth)
        elif kind in ("svg", "g", "a", "switch"):
            for child in element:
                self.draw(child, way, looks, depth + 1)
        elif kind == "text":
            self.letters(element, way, looks)
        elif looks.get("visibility") not in ("hidden", "collapse"):
            self.shape(kind, element, way, looks)

    def copy(self, other: ElementTree.Element, way: Affine, looks: Mapping[str, str], depth: int) -> None:
        """Draw what is used from elsewhere; a copy of copies is bounded more closely than groups are."""
        if other.tag == f"{_SVG}symbol":
            for child in other:
                self.draw(child, way, looks, depth + 4)
        else:
            self.draw(other, way, looks, depth + 4)

    def looks(self, element: ElementTree.Element) -> dict[str, str]:
        """Return how an element looks: by its attributes, its classes, its style."""
        found = {name: text for name in LOOKS if (text := element.get(name)) is not None}
        for name in element.get("class", "").split()[:8]:
            found |= self.classes.get(name, {})
        return found | _style(element.get("style", ""))

    def shape(self, kind: str, element: ElementTree.Element, way: Affine, looks: Mapping[str, str]) -> None:
        """Draw the straight lines of a shape that has a line; a filled triangle may be an arrowhead."""
        pieces: list[tuple[list[complex], bool]] = []
        if kind == "line":
            ends = [complex(_length(element.get(f"x{n}")), _length(element.get(f"y{n}"))) / PIXEL for n in (1, 2)]
            pieces = [(ends, False)]
        elif kind in ("polyline", "polygon"):
            numbers = [float(number) for number in _NUMBER.findall(element.get("points", ""))]
            pieces = [([complex(*pair) for pair in zip(numbers[::2], numbers[1::2], strict=False)], kind == "polygon")]
        elif kind == "rect":
            size = complex(_length(element.get("width")), _length(element.get("height"))) / PIXEL
            at = complex(_length(element.get("x")), _length(element.get("y"))) / PIXEL
            pieces = [([at, at + size.real, at + size, at + 1j * size.imag], True)]
        elif kind == "path":
            pieces = list(_path(element.get("d", ""), self.marks))
        for points, closed in pieces:
            places = [way.at(point) for point in points]
            corners = places[:-1] if len(places) == 4 and places[0] == places[3] else places
            if len(corners) == 3 and looks.get("fill") != "none" and (closed or len(places) == 4):
                self.marks.heads.append((corners[0], corners[1], corners[2]))
            elif looks.get("stroke", "none") not in ("none", "transparent"):
                self.marks.path(places, closed)

    def letters(self, element: ElementTree.Element, way: Affine, looks: Mapping[str, str]) -> None:
        """Draw a text, with those that stand in it one after the other."""
        text = " ".join("".join(element.itertext())[: 2 * LONGEST].split())
        first = next(iter(element), element) if not (element.text or "").strip() else element
        size = _length(({**looks, **self.looks(first)}).get("font-size"), 16.0 * PIXEL) / PIXEL
        at = complex(*(_length(element.get(name) or first.get(name)) / PIXEL for name in ("x", "y")))
        long = WIDE * size * len(text)
        start = at - long * {"middle": 0.5, "end": 1.0}.get({**looks, **self.looks(first)}.get("text-anchor", ""), 0.0)
        self.marks.text(text, way.at(start), way.at(start + long), CAPITAL * size * way.scale)


def _style(text: str) -> dict[str, str]:
    pairs = (rule.partition(":") for rule in text[:2000].split(";"))
    return {name.strip(): value.strip() for name, _, value in pairs if name.strip() in LOOKS}


def _length(text: str | None, usual: float = 0.0) -> float:
    """Return a length in mm; a number alone has pixels."""
    found = _LENGTH.fullmatch(text or "")
    return usual if found is None or found[2] == "%" else float(found[1]) * LENGTHS[found[2]]


def _change(text: str) -> Affine:
    """Return the map of an attribute `transform`."""
    whole = Affine()
    for kind, rest in _CHANGE.findall(text[:10_000]):
        numbers = [float(number) for number in _NUMBER.findall(rest)]
        x, y = (*numbers, *(0.0,) * 2)[:2]
        if kind == "matrix" and len(numbers) == 6:
            own = Affine.of(*(complex(*pair) for pair in zip(numbers[::2], numbers[1::2], strict=True)))
        elif kind == "translate":
            own = Affine(t=complex(x, y))
        elif kind == "scale":
            own = Affine.of(x + 0j, 1j * (y if len(numbers) > 1 else x))
        elif kind == "rotate":
            turn = complex(math.cos(math.radians(x)), math.sin(math.radians(x)))
            about = complex(*numbers[1:3]) if len(numbers) == 3 else 0j
            own = Affine(turn, t=about - turn * about)
        else:
            lean = math.tan(math.radians(x))
            own = Affine.of(1 + 0j, 1j + lean) if kind == "skewX" else Affine.of(1 + 1j * lean, 1j)
        whole = whole.after(own)
    return whole


def _path(text: str, marks: Marks) -> Iterator[tuple[list[complex], bool]]:
    """Go through the pieces of a path that are straight; a curve only moves on."""
    steps = iter(_STEP.findall(text))
    verb, here, begun, piece = "", 0j, 0j, list[complex]()
    pending = next(steps, None)
    while pending is not None:
        marks.count()
        if pending.isalpha():
            verb, pending = pending, None
        upper, numbers = verb.upper(), list[float]()
        for _ in range(TAKES[upper]):
            numbers.append(float(pending if pending is not None else next(steps)))
            pending = None
        pending = next(steps, None) if pending is None else pending
        base = here if verb.islower() else 0j
        if upper == "Z":
            yield piece, len(piece) > 1
            here, piece = begun, [begun]
            continue
        if upper in "HV":
            here = (
                complex(numbers[0] + base.real, here.imag)
                if upper == "H"
                else complex(here.real, numbers[0] + base.imag)
            )
        else:
            here = base + complex(*numbers[-2:])
        if upper == "M":
            begun, verb = here, "l" if verb == "m" else "L"
        if upper in "LHV":
            piece.append(here)
        else:
            yield piece, False
            piece = [here]
    yield piece, False
