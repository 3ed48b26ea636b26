"""The SVG writer: svgwrite's elements in millimetres; y is turned down here and nowhere else."""

from __future__ import annotations

import re
from base64 import b64encode
from cmath import rect
from functools import lru_cache
from math import cos, degrees, isfinite, pi, sin
from typing import Any, BinaryIO, assert_never
from xml.etree import ElementTree

from .font import FAMILY, web_subset
from .page import Page, parts_of
from .pens import arrow_parts, head_outline, length_of
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from .text import lay_out, placer

BLACK = "#000"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"  # which shows groups of its mode as layers
LETTERS = "text{font-kerning:none;font-variant-ligatures:none;white-space:pre}"  # each where it has been measured
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # by XML, in every spelling


def write_svg(page: Page, stream: BinaryIO) -> None:
    """Write one page as SVG in UTF-8, always the same bytes. Raises ValueError: a coordinate is not a finite number."""
    stream.write(svg_text(page).encode("utf-8", "replace"))


def svg_text(page: Page, with_font: bool = True) -> str:
    """Return one page as the text of an SVG file; without its font it is for a reader that has it."""
    from svgwrite import Drawing

    width, height = _number(page.width), _number(page.height)
    of_layers = {"xmlns:inkscape": INKSCAPE} if page.layers else {}
    drawing = Drawing(
        size=(f"{width}mm", f"{height}mm"),
        viewBox=f"0 0 {width} {height}",
        font_family=f"{FAMILY}, sans-serif",
        debug=False,  # else it refuses names of data
        **{"xml:lang": page.language, **of_layers},
    )
    drawing.set_desc(title=page.title)
    writer = _Writer(page, drawing)
    for layer, shapes in parts_of(page):
        group = drawing
        if layer is not None:
            shown = {"inkscape:groupmode": "layer", "inkscape:label": layer.title(page.language)}
            hidden = "none" if layer.hidden else None
            group = drawing.add(drawing.g(id=f"layer-{layer.value}", class_="layer", display=hidden, **shown))
        for shape in shapes:
            writer.draw(shape, group)
    face = ""
    if with_font and writer.characters:  # so that every reader sees the same letters
        font = b64encode(web_subset("".join(sorted(writer.characters)))).decode()
        face = f"@font-face{{font-family:'{FAMILY}';src:url(data:font/woff;base64,{font})}}\n"
    drawing.embed_stylesheet(f"\n{face}{LETTERS}\n")
    tree = drawing.get_xml()
    ElementTree.indent(tree, "")  # a line for each element: drawings are compared as texts
    text = ElementTree.tostring(tree, "unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{_FORBIDDEN.sub("", text)}\n'


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


class _Writer:
    """Adds shapes to a drawing as elements, all numbers already written; notes the characters that they use."""

    def __init__(self, page: Page, drawing: Any) -> None:
        self.height, self.pens = page.height, page.pens
        self.new = drawing
        self.characters: set[str] = set()

    def places(self, *points: complex) -> list[tuple[str, str]]:
        """Return the coordinates of points as they are written."""
        height = self.height
        return [(_number(point.real), _number(height - point.imag)) for point in points]

    def draw(self, shape: Shape, group: Any) -> None:
        """Add the elements of one shape to a group."""
        match shape:
            case Line(a=a, b=b):
                group.add(self.new.line(*self.places(a, b), **self.looks(shape)))
            case Polyline(points=points, closed=closed):
                make = self.new.polygon if closed else self.new.polyline
                group.add(make(self.places(*points), **self.looks(shape), fill=_fill(shape)))
            case Circle(centre=centre, radius=radius):
                looks = self.looks(shape)
                group.add(self.new.circle(*self.places(centre), _number(radius), **looks, fill=_fill(shape)))
            case Arc():
                group.add(self.new.path(self.arc(shape), **self.looks(shape), fill="none"))
            case Head():
                corners = self.places(*head_outline(shape, self.pens))
                group.add(self.new.polygon(corners, class_="head", fill=shape.colour or BLACK))
            case Text():
                self.text(shape, group)
            case Vector():
                facts = {"data_quantity": shape.quantity, "data_unit": shape.unit}
                values = {"data_value": _exact(shape.value), "data_mu": _exact(shape.mu)}
                self.arrow(shape, group, class_="vector", **facts, **values)
            case Arrow(name=name):
                self.arrow(shape, group, class_="arrow", data_name=name)
            case Group(shapes=shapes, role=role, name=name, title=title):
                inner = self.group(group, title, class_=role, data_name=name)
                for part in shapes:
                    self.draw(part, inner)
            case _:
                assert_never(shape)

    def group(self, group: Any, title: str = "", **identity: str) -> Any:
        """Add a group to a group and return it."""
        inner = group.add(self.new.g(**identity))
        if title:
            inner.set_desc(title=title)
        return inner

    def looks(self, shape: Line | Polyline | Circle | Arc) -> dict[str, str | None]:
        """Return the attributes by which a line is read back, and those of its stroke."""
        dashes = self.pens.dashes(shape.pen, length_of(shape)) if shape.pen not in (Pen.MAIN, Pen.THIN) else ()
        return {
            "class_": shape.role or shape.pen.value,
            "data_name": shape.name,
            "stroke": shape.colour or BLACK,
            "stroke_width": _number(self.pens.width(shape.pen)),
            "stroke_dasharray": " ".join(map(_number, dashes)),
        }

    def arc(self, arc: Arc) -> str:
        """Return the path of an arc, in two halves if it is more than half a circle: one command would be ambiguous."""
        halves = 2 if abs(arc.sweep) > pi / 2 else 1
        r, turn = _number(arc.radius), 0 if arc.sweep > 0 else 1
        ends = (arc.centre + rect(arc.radius, arc.start + arc.sweep * step / halves) for step in range(halves + 1))
        first, *others = (f"{x} {y}" for x, y in self.places(*ends))
        return f"M{first}" + "".join(f"A{r} {r} 0 0 {turn} {end}" for end in others)

    def arrow(self, arrow: Vector | Arrow, group: Any, **identity: str) -> None:
        """Add a group whose first line runs from tail to tip without ink; what is seen follows it."""
        inner = self.group(group, arrow.title, **identity)
        inner.add(self.new.line(*self.places(arrow.tail, arrow.tip), class_="span", stroke="none"))
        for part in arrow_parts(arrow, self.pens):
            self.draw(part, inner)

    def text(self, text: Text, group: Any) -> None:
        """Add one `text` element, or a group of them when there are scripts or rules."""
        lines, place_of = lay_out(text.markup, text.height), placer(text)
        identity = {"class_": text.role, "data_name": text.name}
        if len(lines.runs) != 1 or lines.rules:
            group, identity = self.group(group, **identity), {}
        for run in lines.runs:
            self.characters.update(run.string)
            at = place_of(run.x, run.y)
            looks = {"font_size": _number(run.size), "fill": text.colour, "transform": self.turn(text, at)}
            group.add(self.new.text(run.string, *self.places(at), **identity, **looks))
        for x0, y0, x1, y1 in lines.rules:
            self.draw(Line(place_of(x0, y0), place_of(x1, y1), Pen.THIN, "rule", "", text.colour), group)

    def turn(self, text: Text, at: complex) -> str | None:
        """Return the transform of a turned or squeezed text, which keeps the point `at` in its place."""
        if text.squeeze == 1.0 and text.angle == 0.0:
            return None
        x, y = at.real, self.height - at.imag
        if text.squeeze == 1.0:
            return f"rotate({_number(-degrees(text.angle))} {_number(x)} {_number(y)})"
        c, s, k = cos(text.angle), -sin(text.angle), text.squeeze
        matrix = (k * c, k * s, -s, c, x - k * c * x + s * y, y - k * s * x - c * y)
        return f"matrix({' '.join(map(_number, matrix))})"


def _fill(shape: Polyline | Circle) -> str:
    match shape.fill:
        case "white":
            return "#fff"
        case "black":
            return BLACK
        case True:
            return shape.colour or BLACK
        case False:
            return "none"
        case _:
            assert_never(shape.fill)
