"""The SVG writer: one user unit is 1 mm, and y is turned down here and nowhere else.

Elements are written as strings: `docs/design/writers.md` has the measurement that decided it.
"""

from __future__ import annotations

from base64 import b64encode
from cmath import rect
from functools import lru_cache
from math import cos, degrees, isfinite, pi, sin
from typing import BinaryIO, assert_never

from .font import FAMILY, web_subset
from .page import Page, parts_of
from .pens import Pens, arrow_parts, head_outline, length_of
from .shapes import Arc, Arrow, Circle, Fill, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from .text import lay_out, placer

BLACK = "#000"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"  # which shows groups of its mode as layers
_CONTROLS = dict.fromkeys((*range(9), 11, 12, *range(14, 32), 0xFFFE, 0xFFFF), "")  # XML forbids them
_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"}) | _CONTROLS


def write_svg(page: Page, stream: BinaryIO) -> None:
    """Write one page as SVG in UTF-8, always the same bytes. Raises ValueError: a coordinate is not a finite number."""
    stream.write(svg_text(page).encode("utf-8", "replace"))


def svg_text(page: Page, with_font: bool = True) -> str:
    """Return one page as the text of an SVG file; without its font it is for a reader that has it."""
    writer = _Writer(page.height, page.pens)
    for layer, shapes in parts_of(page):
        if layer is not None:
            identity = f'id="layer-{layer.value}" class="layer" inkscape:groupmode="layer"'
            shown = ' display="none"' if layer.hidden else ""
            writer.parts.append(f'<g {identity} inkscape:label="{_quoted(layer.title(page.language))}"{shown}>')
        for shape in shapes:
            writer.draw(shape)
        if layer is not None:
            writer.parts.append("</g>")
    width, height = _number(page.width), _number(page.height)
    of_layers = f' xmlns:inkscape="{INKSCAPE}"' if page.layers else ""
    head = (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg"{of_layers} version="1.1" width="{width}mm" height="{height}mm" '
        f'viewBox="0 0 {width} {height}" xml:lang="{_quoted(page.language)}" font-family="{FAMILY}, sans-serif">\n'
        f"<title>{_quoted(page.title)}</title>\n"
    )
    characters = "".join(sorted(writer.characters)) if with_font else ""
    return head + _style(characters) + "\n".join([*writer.parts, "</svg>\n"])


def _style(characters: str) -> str:
    """Return the style sheet with the glyphs of `characters`, so that every reader sees the same letters."""
    face = ""
    if characters:
        source = f"data:font/woff;base64,{b64encode(web_subset(characters)).decode()}"
        face = f"@font-face{{font-family:'{FAMILY}';src:url({source})}}\n"
    return f"<style>\n{face}text{{font-kerning:none;font-variant-ligatures:none;white-space:pre}}\n</style>\n"


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


@lru_cache(maxsize=1024)
def _quoted(text: str) -> str:
    """Return `text` as XML allows it, in an attribute or in an element."""
    return text.translate(_ENTITIES)


@lru_cache(maxsize=1024)
def _identity(role: str, name: str) -> str:
    """Return the attributes by which a shape is read back."""
    return f' class="{_quoted(role)}"' + (f' data-name="{_quoted(name)}"' if name else "")


class _Writer:
    """Collects the elements of one page and the characters that they use."""

    def __init__(self, height: float, pens: Pens) -> None:
        self.height = height
        self.pens = pens
        self.parts: list[str] = []
        self.characters: set[str] = set()

    def point(self, point: complex) -> tuple[str, str]:
        return _number(point.real), _number(self.height - point.imag)

    def places(self, points: tuple[complex, ...]) -> str:
        return " ".join(f"{_number(p.real)},{_number(self.height - p.imag)}" for p in points)

    def draw(self, shape: Shape) -> None:
        """Add the elements of one shape."""
        match shape:
            case Line(a=a, b=b):
                self.parts.append(f"<line{self.role(shape)}{self.ends(a, b)}{self.stroke(shape)}/>")
            case Polyline(points=points, closed=closed, fill=fill):
                kind, places = "polygon" if closed else "polyline", self.places(points)
                filled = _fill(fill, shape.colour)
                self.parts.append(f'<{kind}{self.role(shape)} points="{places}"{self.stroke(shape)}{filled}/>')
            case Circle(centre=centre, radius=radius, fill=fill):
                x, y = self.point(centre)
                place, style = f' cx="{x}" cy="{y}" r="{_number(radius)}"', self.stroke(shape)
                self.parts.append(f"<circle{self.role(shape)}{place}{style}{_fill(fill, shape.colour)}/>")
            case Arc():
                self.arc(shape)
            case Head():
                places = self.places(head_outline(shape, self.pens))
                self.parts.append(f'<polygon class="head" points="{places}" fill="{_colour(shape.colour)}"/>')
            case Text():
                self.text(shape)
            case Vector() | Arrow():
                self.arrow(shape)
            case Group(shapes=shapes, role=role, name=name, title=title):
                self.parts.append(f"<g{_identity(role, name)}>{_title(title)}")
                for part in shapes:
                    self.draw(part)
                self.parts.append("</g>")
            case _:
                assert_never(shape)

    def role(self, shape: Line | Polyline | Circle | Arc) -> str:
        return _identity(shape.role or shape.pen.value, shape.name)

    def ends(self, a: complex, b: complex) -> str:
        y1, y2 = _number(self.height - a.imag), _number(self.height - b.imag)
        return f' x1="{_number(a.real)}" y1="{y1}" x2="{_number(b.real)}" y2="{y2}"'

    def stroke(self, shape: Line | Polyline | Circle | Arc) -> str:
        style = _stroke(shape.colour, self.pens.width(shape.pen))
        if shape.pen in (Pen.DASHED, Pen.AXIS, Pen.EXTREME):
            dashes = self.pens.dashes(shape.pen, length_of(shape))
            if dashes:
                style += f' stroke-dasharray="{" ".join(map(_number, dashes))}"'
        return style

    def arc(self, arc: Arc) -> None:
        """Add an arc, in two halves if it is more than half a circle, since one command would be ambiguous."""
        halves = 2 if abs(arc.sweep) > pi / 2 else 1
        r, turn = _number(arc.radius), 0 if arc.sweep > 0 else 1
        x, y = self.point(arc.centre + rect(arc.radius, arc.start))
        path = f"M{x} {y}"
        for step in range(halves):
            x, y = self.point(arc.centre + rect(arc.radius, arc.start + arc.sweep * (step + 1) / halves))
            path += f"A{r} {r} 0 0 {turn} {x} {y}"
        self.parts.append(f'<path{self.role(arc)} d="{path}"{self.stroke(arc)} fill="none"/>')

    def arrow(self, arrow: Vector | Arrow) -> None:
        """Add a group whose first line runs from tail to tip without ink; what is seen follows it."""
        if isinstance(arrow, Vector):
            value, mu = _exact(arrow.value), _exact(arrow.mu)
            facts = f' data-quantity="{_quoted(arrow.quantity)}" data-value="{value}"'
            identity = f' class="vector"{facts} data-unit="{_quoted(arrow.unit)}" data-mu="{mu}"'
        else:
            identity = _identity("arrow", arrow.name)
        span = f'<line class="span"{self.ends(arrow.tail, arrow.tip)} stroke="none"/>'
        self.parts.append(f"<g{identity}>{_title(arrow.title)}{span}")
        for part in arrow_parts(arrow, self.pens):
            self.draw(part)
        self.parts.append("</g>")

    def text(self, text: Text) -> None:
        """Add one `text` element, or a group of them when there are scripts or rules."""
        lines = lay_out(text.markup, text.height)
        identity = _identity(text.role, text.name)
        ink = "" if text.colour is None else f' fill="{_colour(text.colour)}"'
        grouped = len(lines.runs) != 1 or bool(lines.rules)
        if grouped:
            self.parts.append(f"<g{identity}>")
            identity = ""
        place_of = placer(text)
        for run in lines.runs:
            self.characters.update(run.string)
            x, y = self.point(at := place_of(run.x, run.y))
            place = f' x="{x}" y="{y}" font-size="{_number(run.size)}"{self.turn(text, at)}'
            self.parts.append(f"<text{identity}{place}{ink}>{_quoted(run.string)}</text>")
        for x0, y0, x1, y1 in lines.rules:
            self.draw(Line(place_of(x0, y0), place_of(x1, y1), Pen.THIN, "rule", "", text.colour))
        if grouped:
            self.parts.append("</g>")

    def turn(self, text: Text, at: complex) -> str:
        """Return the transform of a turned or squeezed text, which keeps the point `at` in its place."""
        if text.squeeze == 1.0 and text.angle == 0.0:
            return ""
        x, y = at.real, self.height - at.imag
        if text.squeeze == 1.0:
            return f' transform="rotate({_number(-degrees(text.angle))} {_number(x)} {_number(y)})"'
        c, s, k = cos(text.angle), -sin(text.angle), text.squeeze
        matrix = (k * c, k * s, -s, c, x - k * c * x + s * y, y - k * s * x - c * y)
        return f' transform="matrix({" ".join(map(_number, matrix))})"'


@lru_cache(maxsize=256)
def _stroke(colour: str | None, width: float) -> str:
    return f' stroke="{_colour(colour)}" stroke-width="{_number(width)}"'


def _colour(colour: str | None) -> str:
    return BLACK if colour is None else _quoted(colour)


def _fill(fill: Fill, colour: str | None) -> str:
    match fill:
        case "white":
            return ' fill="#fff"'
        case "black":
            return f' fill="{BLACK}"'
        case True:
            return f' fill="{_colour(colour)}"'
        case False:
            return ' fill="none"'
        case _:
            assert_never(fill)


def _title(title: str) -> str:
    return f"<title>{_quoted(title)}</title>" if title else ""
