"""Boxes of letters, measured with fontTools on the glyphs of DejaVu Sans: advances and ink in ems."""

import cmath
import io
import math
import re
from functools import cache
from pathlib import Path

Box = tuple[float, float, float, float]


@cache
def _font() -> tuple[dict[int, str], dict[str, tuple[int, int]], object, int]:
    import matplotlib
    from fontTools.ttLib import TTFont

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    font = TTFont(io.BytesIO(path.read_bytes()), lazy=True)
    return font.getBestCmap(), font["hmtx"].metrics, font["glyf"], font["head"].unitsPerEm


@cache
def glyph(letter: str) -> tuple[float, Box | None]:
    """Advance and ink of a letter, in ems."""
    names, metrics, outlines, units = _font()
    name = names[ord(letter)]
    shape = outlines[name]  # type: ignore[index]
    if not shape.numberOfContours:
        return metrics[name][0] / units, None
    return metrics[name][0] / units, tuple(v / units for v in (shape.xMin, shape.yMin, shape.xMax, shape.yMax))  # type: ignore[return-value]


def advance(string: str) -> float:
    return sum(glyph(letter)[0] for letter in string)


@cache
def _ink(string: str) -> Box:
    pen, boxes = 0.0, []
    for letter in string:
        width, box = glyph(letter)
        if box is not None:
            boxes.append((pen + box[0], box[1], pen + box[2], box[3]))
        pen += width
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def ink(string: str, at: complex, size: float, transform: str | None, height: float) -> Box:
    """Box of the ink of a string at a place; a turned one is measured by its corners."""
    x0, y0, x1, y1 = (v * size for v in _ink(string))
    corners = [at + complex(x, y) for x in (x0, x1) for y in (y0, y1)]
    if transform:
        numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", transform)]
        if transform.startswith("rotate"):
            centre = complex(numbers[1], height - numbers[2])
            corners = [centre + (c - centre) * cmath.rect(1.0, -math.radians(numbers[0])) for c in corners]
        else:
            a, b, c, d, e, f = numbers
            down = [complex(p.real, height - p.imag) for p in corners]
            corners = [complex(a * p.real + c * p.imag + e, height - (b * p.real + d * p.imag + f)) for p in down]
    xs, ys = [c.real for c in corners], [c.imag for c in corners]
    return min(xs), min(ys), max(xs), max(ys)
