"""Files of GeoGebra (.ggb): a ZIP of documented XML, in which objects stand in the order of their construction.

The view is in millimetres of the drawing. The bar under it goes from breakpoint to breakpoint: a step of the record.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from io import BytesIO
from xml.sax.saxutils import quoteattr

from ..plans.boards.geogebra import Item
from .text import spelled

INK, THIN, GRIP = (0, 0, 0), (110, 110, 110), (179, 38, 30)  # results, construction, what is meant to be dragged
FULL, DASHED, AXIS, DOTTED = 0, 10, 30, 20  # types of lines
FILLED, RING, SUPPORT = 0, 2, 6  # styles of points
WIDE, HIGH = 1240, 760  # pixels of the view, beside the list of objects
DIGITS = 4  # of numbers
LINE, LETTER = 18.0, 7.5  # pixels of a line of text and of a letter
HEADING, VALUE = 32, 15  # letters of a line of a heading, of a value
MARGIN, APART = 8.0, 15.0  # mm about drawings, and between them
HEAD = 5  # lines over the drawings: titles, a slider
LARGEST, SMALLEST, STEP = 3.0, 0.01, 0.96  # pixels of a millimetre that are tried, one after the other
TRIED = 24  # widths of shelves
RAISED = dict(zip("23nktrem", "²³ⁿᵏᵗʳᵉᵐ", strict=True))
Colour = tuple[int, int, int]
Box = tuple[float, float, float, float]  # left, low, right, high, mm


@dataclass(frozen=True, slots=True)
class Look:
    """How an object is seen; a `caption` tells the step that it ends, where the bar stops."""

    seen: bool = False
    labelled: bool = False
    colour: Colour = INK
    width: int = 2
    dashes: int = FULL
    size: int = 3
    style: int = FILLED
    caption: str = ""
    stops: bool = False
    lists: bool = False  # whether the list of objects shows it: the fewer, the faster all is moved
    more: str = ""  # tags of its own


HIDDEN = Look()


def tag(name: str, **values: object) -> str:
    """Return a tag of XML without content."""
    return f"<{name}{''.join(f' {key}={quoteattr(_value(value))}' for key, value in values.items())}/>"


def _value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def string(text: str) -> str:
    """Return a text as it stands in an expression."""
    return '"' + text.replace('"', "″") + '"'


def indexed(markup: str) -> str:
    """Return a line of markup as GeoGebra shows plain texts: indices are lowered, some letters stand raised."""

    def scripted(above: str, below: str) -> str:
        raised = "".join(RAISED.get(letter, "") for letter in above)
        index = below if len(raised) == len(above) else f"{below} {above}".strip()
        return (raised if index == below else "") + (f"_{{{index}}}" if index else "")

    return spelled(markup, scripted=scripted)


def tex(markup: str) -> str:
    """Return a symbol as LaTeX, in which scripts stand over one another and vectors have their bars."""

    def plain(text: str) -> str:
        text = text.replace("′", "'").replace("″", "''")
        return text if text.isascii() or len(text) == 1 else f"\\text{{{text}}}"

    def scripted(above: str, below: str) -> str:
        return "".join(f"{sign}{{{script}}}" for sign, script in (("^", above), ("_", below)) if script)

    return spelled(markup, plain, scripted, lambda kind, text: f"\\overline{{{text}}}" if kind == "bar" else text)


def _written(item: Item, look: Look) -> str:
    """Return an object as XML: what makes it, then how it is seen."""
    made = ""
    if item.command:
        inputs = tag("input", **{f"a{n}": text for n, text in enumerate(item.inputs)})
        made = f"<command name={quoteattr(item.command)}>{inputs}{tag('output', a0=item.label)}</command>"
    elif item.said:
        kind = {"type": item.kind} if item.kind in ("point", "vector") else {}
        made = tag("expression", label=item.label, exp=item.said, **kind)
    red, green, blue = look.colour
    parts = [
        tag("show", object=look.seen, label=look.labelled),
        tag("objColor", r=red, g=green, b=blue, alpha="0.0"),
        tag("layer", val=0),
        tag("labelMode", val=0),
    ]
    if not look.lists:
        parts.append(tag("auxiliary", val=True))
    if look.stops:
        parts.append(tag("breakpoint", val=True))
    if item.kind == "point":
        parts += [tag("pointSize", val=look.size), tag("pointStyle", val=look.style)]
    elif item.kind in ("vector", "segment", "line", "conic"):
        parts.append(tag("lineStyle", thickness=look.width, type=look.dashes))
    if look.caption:
        parts.append(tag("caption", val=look.caption))
    body = "\n".join((*parts, *filter(None, [look.more])))
    return f"{made}\n<element type={quoteattr(item.kind)} label={quoteattr(item.label)}>\n{body}\n</element>"


@dataclass(frozen=True, slots=True)
class Arranged:
    """Where the origins of drawings are, the box of all of them, and the height of a line of text, mm."""

    places: Mapping[str, complex]
    box: Box
    line: float


def arranged(drawings: Mapping[str, tuple[Box, int]]) -> Arranged:
    """Put drawings beside each other: their boxes about their origins, each with lines of text on its right side."""
    scale = LARGEST
    while True:  # texts keep their size on the screen: the smaller the scale, the more room they take
        cells = {name: _cell(*drawing, scale) for name, drawing in drawings.items()}
        least, most = (of(right - left for left, _, right, _ in cells.values()) for of in (max, sum))
        ways = (_shelved(cells, least + (most - least) * part / TRIED) for part in range(TRIED + 1))
        places, (wide, low) = max(ways, key=lambda way: min(WIDE / way[1][0], HIGH / -way[1][1]))
        found = Arranged(places, (-APART, low, wide, HEAD * LINE / scale), LINE / scale)
        if _fit(found.box) >= scale or scale < SMALLEST:
            return found
        scale *= STEP


def _cell(box: Box, lines: int, scale: float) -> Box:
    """Return the room of a drawing with its heading and its text."""
    (left, low, right, high), line = box, LINE / scale
    low = min(low, high - line * (lines + 2)) - APART
    right = max(right + APART + (VALUE * LETTER / scale if lines else 0.0), left + HEADING * LETTER / scale + APART)
    return left, low, right, high + 3 * line


def _shelved(cells: Mapping[str, Box], wide: float) -> tuple[dict[str, complex], tuple[float, float]]:
    """Put boxes on shelves so wide, in their order; return where the origin of each is, and the far corner of all."""
    places: dict[str, complex] = {}
    x = y = deepest = end = 0.0
    for name, (left, low, right, high) in cells.items():
        if x > 0.0 and x + right - left > wide * (1.0 + 1e-9):
            x, y, deepest = 0.0, y - deepest, 0.0
        places[name] = complex(round(x - left), round(y - high))
        x, deepest = x + right - left, max(deepest, high - low)
        end = max(end, x)
    return places, (end, y - deepest)


def _fit(box: Box) -> float:
    """Return the pixels of a millimetre with which the view shows a box."""
    left, low, right, high = box
    return min(WIDE / (right - left), HIGH / (high - low))


def packed(objects: Iterable[tuple[Item, Look]], title: str, box: Box) -> bytes:
    """Return a construction as a file; the view shows what is in the box."""
    left, high, scale = box[0], box[3], _fit(box)
    zero = {"xZero": f"{-left * scale:.6g}", "yZero": f"{high * scale:.6g}"}
    view = [
        tag("size", width=WIDE, height=HIGH),
        tag("coordSystem", **zero, scale=f"{scale:.6g}", yscale=f"{scale:.6g}"),
        tag("evSettings", axes=False, grid=False, gridIsBold=False, pointCapturing=0, rightAngleStyle=1),
        tag("bgColor", r=255, g=255, b=255),
        *(tag("axis", id=axis, show=False, label="", unitLabel="", tickStyle=1, showNumbers=False) for axis in (0, 1)),
    ]
    bar = tag("consProtNavigationBar", show=True, playButton=True, playDelay="2.0", protButton=True)
    gui = [tag("font", size=12), tag("consProtocol", useColors=True, addIcons=False, showOnlyBreakpoints=True), bar]
    kernel = [tag("continuous", val=False), tag("significantfigures", val=DIGITS), tag("angleUnit", val="degree")]
    parts = [
        '<?xml version="1.0" encoding="utf-8"?>\n<geogebra format="5.0" app="classic">',
        *_section("gui", gui),
        *_section("euclidianView", view),
        *_section("kernel", kernel),
        f'<construction title={quoteattr(title)} author="" date="">',
        *(_written(item, look) for item, look in objects),
        "</construction>\n</geogebra>\n",
    ]
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:  # without the hour: the same construction is the same bytes
        archive.writestr(zipfile.ZipInfo("geogebra.xml"), "\n".join(parts).encode("utf-8"), zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def _section(name: str, parts: Iterable[str]) -> tuple[str, ...]:
    return f"<{name}>", *parts, f"</{name}>"
