"""The SVG writer: svgwrite's elements in millimetres; y is turned down here and nowhere else."""

from __future__ import annotations

import re
from base64 import b64encode
from cmath import rect
from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import lru_cache
from math import cos, degrees, isfinite, pi, sin
from typing import Any, BinaryIO, assert_never
from xml.etree import ElementTree

from .font import DRAFTING, FAMILIES, SCREEN, SLANTED, web_subset
from .page import BLACK, Layer, Page, Part, Stroke, Walk, filled
from .shapes import Arc, Arrow, Circle, Group, Line, Polyline, Text, Vector
from .text import Run

INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"  # which shows groups of its mode as layers
LETTERS = "text{font-kerning:none;font-variant-ligatures:none;white-space:pre}"  # each where it has been measured
CDATA = "<![CDATA[%s]]>"  # the name under which svgwrite keeps a style
MARKS = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})
QUOTED = MARKS | str.maketrans({'"': "&quot;", "\r": "&#13;", "\n": "&#10;", "\t": "&#09;"})  # in attributes
_QUOTED = re.compile('[&<>"\r\n\t]')
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # by XML, in every spelling


def write(pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write the first of `pages` as SVG in UTF-8, always the same bytes.

    Raises ValueError: a coordinate is not a finite number.
    """
    stream.write(svg_text(pages[0]).encode("utf-8", "replace"))


def svg_text(page: Page, with_font: bool = True) -> str:
    """Return one page as the text of an SVG file; without its font it is for a reader that has it."""
    from svgwrite import Drawing

    width, height = _number(page.width), _number(page.height)
    of_layers = {"xmlns:inkscape": INKSCAPE} if page.layers else {}
    drawing = Drawing(
        size=(f"{width}mm", f"{height}mm"),
        viewBox=f"0 0 {width} {height}",
        font_family=f"{DRAFTING}, {FAMILIES[SCREEN]}, sans-serif",
        debug=False,  # else it refuses names of data
        **{"xml:lang": page.language, **of_layers},
    )
    drawing.set_desc(title=page.title)
    walk = _Walk(page, drawing)
    walk.whole()
    faces = "".join(_embedded(face, walk.characters[face]) for face in sorted(walk.characters)) if with_font else ""
    drawing.embed_stylesheet(f"\n{faces}{LETTERS}\n")
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']  # drawings are compared as texts, by lines
    _put_down(drawing.get_xml(), lines)
    return _FORBIDDEN.sub("", "\n".join([*lines, ""]))


def _put_down(element: ElementTree.Element, lines: list[str]) -> None:
    """Put down an element and those in it, a line for each, with no search for namespaces as `tostring` begins with."""
    attributes = "".join(
        [f' {name}="{value.translate(QUOTED) if _QUOTED.search(value) else value}"' for name, value in element.items()]
    )
    if len(element):
        lines.append(f"<{element.tag}{attributes}>")
        if element[0].tag == CDATA:
            lines.append(f"{CDATA % element[0].text}</{element.tag}>")
            return
        for child in element:
            _put_down(child, lines)
        lines.append(f"</{element.tag}>")
    elif element.text:
        lines.append(f"<{element.tag}{attributes}>{element.text.translate(MARKS)}</{element.tag}>")
    else:
        lines.append(f"<{element.tag}{attributes} />")


def _embedded(face: str, characters: set[str]) -> str:
    """Return the rule that embeds a face, so that every reader sees the same letters."""
    font = b64encode(web_subset(face, "".join(sorted(characters)))).decode()
    style = "font-style:italic;" if face == SLANTED else ""
    return f"@font-face{{font-family:'{FAMILIES[face]}';{style}src:url(data:font/woff;base64,{font})}}\n"


@lru_cache(maxsize=8192)
def _number(value: float) -> str:
    """Return a length in mm to 1e-6 mm, without an exponent."""
    text = f"{value:.6f}"
    if text[-1] == "0":
        text = text.rstrip("0").rstrip(".")
        return "0" if text == "-0" else text
    if text[-1] in "fn":  # inf, nan
        raise ValueError(f"not a place on a sheet: {value}")
    return text


def _exact(value: float) -> str:
    """Return a value with all its digits."""
    if not isfinite(value):
        raise ValueError(f"not a value to write on a sheet: {value}")
    return repr(float(value))


class _Walk(Walk):
    """Adds shapes to a drawing as elements, all numbers already written; notes the characters that they use."""

    def __init__(self, page: Page, drawing: Any) -> None:
        super().__init__(page)
        self.groups = [drawing]
        # svgwrite makes a builder anew for each element that is asked for by its name
        self.line, self.polygon, self.polyline = drawing.line, drawing.polygon, drawing.polyline
        self.circle, self.path, self.text, self.group = drawing.circle, drawing.path, drawing.text, drawing.g
        self.characters: defaultdict[str, set[str]] = defaultdict(set)

    def places(self, *points: complex) -> list[tuple[str, str]]:
        """Return the coordinates of points as they are written."""
        height = self.page.height
        return [(_number(point.real), _number(height - point.imag)) for point in points]

    def stroke(self, shape: Stroke, dashes: tuple[float, ...]) -> None:
        """Add an element with the attributes by which it is read back."""
        match shape:
            case Line(a=a, b=b):
                element, area = self.line(*self.places(a, b)), None
            case Polyline(points=points, closed=closed):
                make = self.polygon if closed else self.polyline
                element, area = make(self.places(*points)), filled(shape) or "none"
            case Circle(centre=centre, radius=radius):
                element, area = self.circle(*self.places(centre), _number(radius)), filled(shape) or "none"
            case Arc():
                element, area = self.path(self.arc(shape)), "none"
        looks = {"stroke": shape.colour or BLACK, "stroke-width": _number(self.pens.width(shape.pen)), "fill": area}
        identity = {"class": shape.role or shape.pen.value, "data-name": shape.name}
        self.add(element, identity | looks | {"stroke-dasharray": " ".join(map(_number, dashes))})

    def add(self, element: Any, attributes: Mapping[str, str | None]) -> Any:
        """Add an element with attributes as they are written: by keywords svgwrite takes twice the time."""
        element.attribs |= attributes
        return self.groups[-1].add(element)

    def arc(self, arc: Arc) -> str:
        """Return the path of an arc, in two halves if it is more than half a circle: one command would be ambiguous."""
        halves = 2 if abs(arc.sweep) > pi / 2 else 1
        r, turn = _number(arc.radius), 0 if arc.sweep > 0 else 1
        ends = (arc.centre + rect(arc.radius, arc.start + arc.sweep * step / halves) for step in range(halves + 1))
        first, *others = (f"{x} {y}" for x, y in self.places(*ends))
        return f"M{first}" + "".join(f"A{r} {r} 0 0 {turn} {end}" for end in others)

    def head(self, corners: tuple[complex, complex, complex], colour: str) -> None:
        """Add a triangle."""
        self.add(self.polygon(self.places(*corners)), {"class": "head", "fill": colour})

    def letters(self, text: Text, runs: Sequence[tuple[Run, complex]], alone: bool) -> None:
        """Add a `text` element for each run; one that is alone carries what a group would."""
        identity = self.identity(text) if alone else {}
        for run, at in runs:
            self.characters[run.face].update(run.string)
            ((x, y),) = self.places(at)
            face = {"font-style": "italic" if run.face == SLANTED else None}
            if run.face == SCREEN:
                face["font-family"] = FAMILIES[SCREEN]
            looks = {"font-size": _number(run.size), "fill": text.colour, "transform": self.turn(text, at), **face}
            self.add(self.text(run.string), {**identity, **looks, "x": x, "y": y})

    def identity(self, text: Text) -> dict[str, str | None]:
        """Return what a text is, and the node or the line that it letters."""
        of = " ".join(map(",".join, self.places(*text.of))) or None
        return {"class": text.role, "data-name": text.name, "data-of": of}

    def turn(self, text: Text, at: complex) -> str | None:
        """Return the transform of a turned or squeezed text, which keeps the point `at` in its place."""
        if text.squeeze == 1.0 and text.angle == 0.0:
            return None
        x, y = at.real, self.page.height - at.imag
        if text.squeeze == 1.0:
            return f"rotate({_number(-degrees(text.angle))} {_number(x)} {_number(y)})"
        c, s, k = cos(text.angle), -sin(text.angle), text.squeeze
        matrix = (k * c, k * s, -s, c, x - k * c * x + s * y, y - k * s * x - c * y)
        return f"matrix({' '.join(map(_number, matrix))})"

    def begin(self, part: Part) -> None:
        """Add a group; the first line of an arrow runs from tail to tip without ink, what is seen follows it."""
        identity: dict[str, str | None]
        match part:
            case Layer():
                shown = {"inkscape:groupmode": "layer", "inkscape:label": part.title(self.page.language)}
                hidden = "none" if part.hidden else None
                identity = {"id": f"layer-{part.value}", "class": "layer", "display": hidden, **shown}
            case Vector(quantity=quantity, unit=unit):
                values = {"data-value": _exact(part.value), "data-mu": _exact(part.mu)}
                identity = {"class": "vector", "data-quantity": quantity, "data-unit": unit, **values}
            case Arrow(name=name):
                identity = {"class": "arrow", "data-name": name}
            case Text():
                identity = self.identity(part)
            case Group(role=role, name=name):
                identity = {"class": role, "data-name": name}
            case _:
                assert_never(part)
        group = self.add(self.group(), identity)
        self.groups.append(group)
        if isinstance(part, Vector | Arrow | Group) and part.title:
            group.set_desc(title=part.title)
        if isinstance(part, Vector | Arrow):
            self.add(self.line(*self.places(part.tail, part.tip)), {"class": "span", "stroke": "none"})

    def end(self, part: Part) -> None:
        """Go on with the group before."""
        self.groups.pop()
