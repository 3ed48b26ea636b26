"""The letters of a drawing in SVG as outlines, for readers that take no font but their own."""

from __future__ import annotations

from functools import cache, lru_cache
from io import BytesIO
from typing import Any

from ..font import font

_SVG = "{http://www.w3.org/2000/svg}"


def outlined(svg: bytes) -> bytes:
    """Return a drawing whose letters are paths at the same places."""
    from lxml import etree

    root = etree.fromstring(svg)
    for text in root.findall(f".//{_SVG}text"):
        size = float(text.get("font-size")) / font().units
        place = f"translate({text.get('x')} {text.get('y')}) scale({size:.8f} {-size:.8f})"
        path = etree.Element(f"{_SVG}path", d=_path(text.text or ""))
        path.set("transform", f"{text.get('transform', '')} {place}".strip())
        for name in ("class", "data-name", "fill"):
            if text.get(name) is not None:
                path.set(name, text.get(name))
        path.tail = text.tail
        text.getparent().replace(text, path)
    for style in root.findall(f"{_SVG}style"):
        root.remove(style)
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8"))


@cache
def _glyphs() -> tuple[dict[int, str], Any]:
    from fontTools.ttLib import TTFont

    found = TTFont(BytesIO(font().data), lazy=True)
    return found.getBestCmap(), found.getGlyphSet()


@lru_cache(maxsize=4096)
def _path(string: str) -> str:
    """Return letters as commands of a path, in units of the font, y up."""
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen

    names, glyphs = _glyphs()
    pen, at = SVGPathPen(glyphs), 0
    for letter in string:
        glyph = glyphs[names[ord(letter)]]
        glyph.draw(TransformPen(pen, (1, 0, 0, 1, at, 0)))
        at += glyph.width
    return str(pen.getCommands())
