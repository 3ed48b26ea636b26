"""DXF read back, a text of pairs of lines: what follows, and its value. Blocks are drawn where they are inserted.

It is read here and not by a library so that every entity is counted before it costs anything, also in blocks of blocks.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from .marks import CAPITAL, DEEPEST, INCH, LONGEST, MOST, WIDE, Affine, FaultError, Marks, beside

_BINARY = (b"AutoCAD Binary DXF", b"AC10")  # the latter a DWG
UNITS = {1: INCH, 2: 12 * INCH, 5: 10.0, 6: 1000.0}  # mm, of $INSUNITS; of others one
Groups = Sequence[tuple[int, str]]
Entities = list[tuple[str, Groups]]
MIRRORED = Affine(0j, -1 + 0j)  # what lies on the back of the plane is turned over
_RECORD = re.compile(rb"\n[ \t]*0[ \t]*\r?\n[A-Z]")
_INSUNITS = re.compile(r"\$INSUNITS\s*\n\s*70\s*\n\s*([0-9]{1,3})\b")
_CODEPAGE = re.compile(rb"\$DWGCODEPAGE\s*\n\s*3\s*\n\s*ANSI_(125[0-8])\b")
_ESCAPE = re.compile(r"\\U\+([0-9A-Fa-f]{4})")
_FORMAT = re.compile(r"\\[ACFHQTWfpc][^;\\]{0,80};|\\[LlOoKk]|[{}]")
_STACK = re.compile(r"\\S([^;^#/]{0,80})[\^#/ ]*([^;]{0,80});")
_SIGNS = {"%%c": "⌀", "%%d": "°", "%%p": "±", "%%u": "", "%%o": "", "%%%": "%", "^ ": "^"}


def read_dxf(data: bytes) -> Marks:
    """Read a DXF: model space and beside it paper space, without layers that are off or frozen."""
    if data.startswith(_BINARY):
        raise FaultError("drawing-binary")
    if sum(1 for _ in _RECORD.finditer(data)) > 3 * MOST:  # before they cost anything
        raise FaultError("drawing-many")
    page = _CODEPAGE.search(data[:100_000])
    text = _decoded(data, f"cp{page[1].decode()}" if page else "cp1251").replace("\r\n", "\n")
    unit = _INSUNITS.search(text[:1_000_000])
    hidden, blocks, spaces = set[str](), dict[str, tuple[complex, Entities]](), (Entities(), Entities())
    section, inside, ended = "", Entities(), False
    left = 2 * MOST  # entities that are kept, also in blocks that nobody inserts
    for kind, groups in _records(text):
        left -= section in ("BLOCKS", "ENTITIES")
        if left < 0:
            raise FaultError("drawing-many")
        if kind == "SECTION":
            section = _said(groups, 2)
        elif kind == "EOF":
            ended = True
        elif kind == "LAYER" and section == "TABLES":
            if _number(groups, 62) < 0 or int(_number(groups, 70)) & 1:
                hidden.add(_said(groups, 2))
        elif section == "BLOCKS":
            if kind == "BLOCK":
                inside = Entities()
                blocks[_said(groups, 2)] = _place(groups), inside
            else:
                inside.append((kind, groups))
        elif section == "ENTITIES" and kind != "ENDSEC":
            spaces[_number(groups, 67) == 1].append((kind, groups))
    if not ended:  # cut off, or something else
        raise ValueError
    found = _Dxf(blocks, hidden)
    mm = UNITS.get(int(unit[1]) if unit else 4, 1.0) + 0j
    for number, space in enumerate(spaces):
        found.draw(space, Affine(mm, t=beside(found.marks) if number and space else 0j))
    return found.marks


def _decoded(data: bytes, other: str) -> str:
    """Return a text in UTF-8 or in another encoding; none has a NUL."""
    if b"\0" in data:
        raise FaultError("drawing-binary")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode(other, "replace")


def _records(text: str) -> Iterator[tuple[str, Groups]]:
    """Go through what stands in a DXF: its kind and its groups."""
    lines = text.split("\n")
    kind, groups = "", list[tuple[int, str]]()
    for code, value in zip(lines[::2], lines[1::2], strict=False):
        if (number := int(code)) == 0:
            if kind:
                yield kind, groups
            kind, groups = value.strip(), []
        else:
            groups.append((number, value))
    yield kind, groups


def _said(groups: Groups, code: int, usual: str = "") -> str:
    return next((value.strip() for own, value in groups if own == code), usual)


def _number(groups: Groups, code: int, usual: float = 0.0) -> float:
    return float(_said(groups, code, "") or usual)


def _place(groups: Groups, x: int = 10) -> complex:
    return complex(_number(groups, x), _number(groups, x + 10))


@dataclass(slots=True)
class _Dxf:
    """Draws the entities of a DXF, blocks where they are inserted."""

    blocks: Mapping[str, tuple[complex, Entities]]
    hidden: set[str]
    marks: Marks = field(default_factory=Marks)

    def draw(self, entities: Entities, way: Affine, depth: int = 0) -> None:
        """Draw entities moved by `way`."""
        if depth > DEEPEST:
            raise FaultError("drawing-deep")
        line: tuple[list[complex], bool] | None = None  # an old polyline, whose vertices follow it
        for kind, groups in entities:
            self.marks.count()
            if _said(groups, 8) in self.hidden or _number(groups, 60) == 1:
                continue
            if kind == "POLYLINE":
                line = ([], bool(int(_number(groups, 70)) & 1)) if not int(_number(groups, 70)) & 80 else None
            elif kind == "VERTEX" and line is not None:
                line[0].append(way.at(_place(groups)))
            elif kind == "SEQEND" and line is not None:
                self.marks.path(*line)
                line = None
            else:
                turned = way.after(MIRRORED) if _number(groups, 230, 1.0) < 0.0 and kind != "LINE" else way
                self.entity(kind, groups, turned, depth)

    def entity(self, kind: str, groups: Groups, way: Affine, depth: int) -> None:
        """Draw an entity; curves, areas and what else there is are passed over."""
        if kind == "LINE":
            self.marks.path([way.at(_place(groups)), way.at(_place(groups, 11))])
        elif kind in ("LWPOLYLINE", "LEADER"):
            self.broken(groups, way)
        elif kind == "MLINE":  # drawn through its vertices, whatever lines run beside them
            ends = [float(value) for code, value in groups if code in (11, 21)]
            corners = [way.at(complex(x, y)) for x, y in zip(ends[::2], ends[1::2], strict=True)]
            self.marks.path(corners, bool(int(_number(groups, 71)) & 2))
        elif kind in ("SOLID", "TRACE"):
            corners = list(dict.fromkeys(way.at(_place(groups, code)) for code in (10, 11, 12, 13)))
            if len(corners) == 3:
                self.marks.heads.append((corners[0], corners[1], corners[2]))
        elif kind in ("TEXT", "ATTRIB", "MTEXT"):
            if kind != "ATTRIB" or not int(_number(groups, 70)) & 1:
                self.letters(kind, groups, way)
        elif kind in ("INSERT", "DIMENSION"):
            self.inserted(kind, groups, way, depth)

    def broken(self, groups: Groups, way: Affine) -> None:
        """Draw a broken line without its arcs."""
        corners, x = list[list[float]](), 0.0
        for code, value in groups:
            if code == 10:
                x = float(value)
            elif code == 20:
                corners.append([x, float(value), 0.0])
            elif code == 42 and corners:
                corners[-1][2] = float(value)
        self.marks.count(len(corners))
        closed = int(_number(groups, 70)) & 1 and len(corners) > 2
        for (x0, y0, bulge), (x1, y1, _) in pairwise([*corners, *corners[:1]] if closed else corners):
            if not bulge:
                self.marks.lines.append((way.at(complex(x0, y0)), way.at(complex(x1, y1))))

    def letters(self, kind: str, groups: Groups, way: Affine) -> None:
        """Draw a text between its ends, which those of an old kind have where they are fitted."""
        text, height = _written("".join(value for code, value in groups if code in (1, 3))), _number(groups, 40)
        angle, at = math.radians(_number(groups, 50)), _place(groups)
        across, up = int(_number(groups, 72)), 0.0
        if kind == "MTEXT":
            where = int(_number(groups, 71, 1.0))
            across, up = (where - 1) % 3, {0: -1.0, 1: -0.5}.get((where - 1) // 3, 0.0)
            axis = _place(groups, 11)
            angle = math.atan2(axis.imag, axis.real) if axis else angle
        elif across:
            at = _place(groups, 11)
        level = complex(math.cos(angle), math.sin(angle))
        long = level * WIDE * height / CAPITAL * len(text) * _number(groups, 41, 1.0 if kind != "MTEXT" else 0.0)
        if kind == "MTEXT":
            long = level * WIDE * height / CAPITAL * len(text)
        start = at + up * 1j * level * height - long * {1: 0.5, 2: 1.0, 4: 0.5}.get(across, 0.0)
        end = start + long
        if kind != "MTEXT" and across in (3, 5):
            start, end = _place(groups), at
        self.marks.text(text, way.at(start), way.at(end), height * way.scale)

    def inserted(self, kind: str, groups: Groups, way: Affine, depth: int) -> None:
        """Draw a block, in rows and columns where it is so inserted; that of a dimension stands where it is."""
        base, entities = self.blocks.get(_said(groups, 2), (0j, []))
        if kind == "DIMENSION":
            return self.draw(entities, way, depth + 1)
        level = complex(math.cos(angle := math.radians(_number(groups, 50))), math.sin(angle))
        own = Affine.of(level * _number(groups, 41, 1.0), 1j * level * _number(groups, 42, 1.0))
        columns, rows = int(_number(groups, 70, 1.0)), int(_number(groups, 71, 1.0))
        for number in range(max(columns, 1) * max(rows, 1)):
            self.marks.count()
            row, column = divmod(number, max(columns, 1))
            step = complex(column * _number(groups, 44), row * _number(groups, 45))
            there = own._replace(t=_place(groups) + level * step - own.at(base))
            self.draw(entities, way.after(there), depth + 1)
        return None


def _written(text: str) -> str:
    """Return what a text of CAD says, without how it is to look."""
    text = _ESCAPE.sub(lambda found: chr(int(found[1], 16)), text[: 20 * LONGEST])
    text = _STACK.sub(r"\1\2", text).replace("\\P", " ").replace("\\~", " ").replace("\\\\", "\\")
    text = _FORMAT.sub("", text)
    for sign, letter in _SIGNS.items():
        text = text.replace(sign, letter).replace(sign.upper(), letter)
    return text
