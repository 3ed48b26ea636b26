"""Boxes of letters, measured with fontTools on the glyphs of the fonts that an SVG embeds: advances and ink in ems."""

import cmath
import io
import math
import re
from base64 import b64decode
from functools import cache, lru_cache
from pathlib import Path

from lxml import etree

Box = tuple[float, float, float, float]
_RULE = re.compile(r"@font-face\s*\{([^}]*)\}")
_DATA = re.compile(r"base64,([A-Za-z0-9+/=]+)")
CAP = 1493 / 2048  # of DejaVu Sans, whose file does not say it


class Face:
    """One font: what its letters take up."""

    def __init__(self, data: bytes) -> None:
        from fontTools.ttLib import TTFont

        font = TTFont(io.BytesIO(data), lazy=True)
        self._names, self._metrics = font.getBestCmap(), font["hmtx"].metrics
        self._outlines, self._units = font["glyf"], font["head"].unitsPerEm
        self._known: dict[str, tuple[float, Box | None]] = {}
        self.cap = getattr(font["OS/2"], "sCapHeight", CAP * self._units) / self._units

    def __contains__(self, letter: str) -> bool:
        return ord(letter) in self._names

    def glyph(self, letter: str) -> tuple[float, Box | None]:
        """Advance and ink of a letter, in ems."""
        if letter not in self._known:
            name = self._names[ord(letter)]
            shape, wide = self._outlines[name], self._metrics[name][0] / self._units
            box = (
                tuple(v / self._units for v in (shape.xMin, shape.yMin, shape.xMax, shape.yMax))
                if (shape.numberOfContours)
                else None
            )
            self._known[letter] = wide, box  # type: ignore[assignment]
        return self._known[letter]


@cache
def _face(encoded: str) -> Face:
    return Face(b64decode(encoded))


@cache
def _screen() -> Face:
    """Return DejaVu Sans, the face of files that embed none."""
    import matplotlib

    return Face((Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf").read_bytes())


class Lettering:
    """The faces that an SVG embeds, by family and slant; a text takes each letter from the first that has it."""

    def __init__(self, root: etree._Element) -> None:
        self.faces: dict[tuple[str, bool], Face] = {}
        for style in root.iter("{http://www.w3.org/2000/svg}style"):
            for rule in _RULE.findall(style.text or ""):
                family = re.search(r"font-family:\s*['\"]?([^;'\"]+)", rule)
                data = _DATA.search(rule)
                if family and data:
                    slanted = re.search(r"font-style:\s*(italic|oblique)", rule) is not None
                    self.faces[family[1].strip(), slanted] = _face(data[1])

    def of(self, element: etree._Element) -> tuple[Face, ...]:
        """Return the faces of a text, in the order in which a reader looks for its letters."""
        families = [name.strip(" '\"") for name in _inherited(element, "font-family").split(",")]
        slanted = _inherited(element, "font-style") in ("italic", "oblique")
        found = [
            self.faces[key] for name in families for key in ((name, slanted), (name, not slanted)) if key in self.faces
        ]
        return tuple(found) or (_screen(),)


def _inherited(element: etree._Element, name: str) -> str:
    around = (element, *element.iterancestors())
    return next((e.get(name) for e in around if e.get(name)), "")


def advance(string: str, faces: tuple[Face, ...]) -> float:
    return _measured(string, faces)[0]


@lru_cache(maxsize=8192)
def _measured(string: str, faces: tuple[Face, ...]) -> tuple[float, Box]:
    """Advance and ink of a string, in ems."""
    pen, boxes = 0.0, []
    for wide, box in (next(face for face in faces if letter in face).glyph(letter) for letter in string):
        if box is not None:
            boxes.append((pen + box[0], box[1], pen + box[2], box[3]))
        pen += wide
    x0, y0, x1, y1 = zip(*boxes or [(0.0,) * 4], strict=True)
    return pen, (min(x0), min(y0), max(x1), max(y1))


def ink(
    string: str, faces: tuple[Face, ...], at: complex, size: float, transform: str | None, height: float
) -> tuple[complex, ...]:
    """Corners of the ink of a string at a place, one after the other, turned and squeezed with it."""
    x0, y0, x1, y1 = (v * size for v in _measured(string, faces)[1])
    corners = [at + complex(x, y) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    if transform:
        numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", transform)]
        if transform.startswith("rotate"):
            centre = complex(numbers[1], height - numbers[2])
            corners = [centre + (c - centre) * cmath.rect(1.0, -math.radians(numbers[0])) for c in corners]
        else:
            a, b, c, d, e, f = numbers
            down = [complex(p.real, height - p.imag) for p in corners]
            corners = [complex(a * p.real + c * p.imag + e, height - (b * p.real + d * p.imag + f)) for p in down]
    return tuple(corners)
