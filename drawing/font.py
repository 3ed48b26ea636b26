"""The faces of letters on sheets: our drafting letters, upright and slanted, and DejaVu Sans for what they lack.

Their advances and outlines, and a small subset for embedding. A font file is read with `struct` alone, and only the
tables that are asked for: opening it costs about a millisecond, a tenth of what a general font library costs to import.
"""

from __future__ import annotations

import struct
import sys
import zlib
from array import array
from bisect import bisect_left
from collections.abc import Iterable
from functools import cache, cached_property, lru_cache
from importlib.util import find_spec
from pathlib import Path

from ..scales.errors import InputError
from ..scales.numbers import SHOWN, quote

UPRIGHT, SLANTED, SCREEN = "upright", "slanted", "screen"  # faces: drafting letters of GOST 2.304, and DejaVu Sans
DRAFTING = "Kulman Drafting"
FAMILIES = {UPRIGHT: DRAFTING, SLANTED: DRAFTING, SCREEN: "DejaVu Sans"}
CAPITALS = {UPRIGHT: 1000, SLANTED: 1000, SCREEN: 1493}  # height of a capital in units of the font

# Flags of a part of a composite glyph.
_WORDS, _SCALE, _MORE, _XY_SCALE, _TWO_BY_TWO, _INSTRUCTIONS = 0x1, 0x8, 0x20, 0x40, 0x80, 0x100


class _Font:
    """A TrueType font file, read lazily from its bytes; letters of 1 mm height have the font size `size`."""

    def __init__(self, face: str, data: bytes) -> None:
        self.face, self.data = face, data
        count = struct.unpack_from(">H", data, 4)[0]
        entries = (struct.unpack_from(">4sLLL", data, 12 + 16 * index) for index in range(count))
        self.tables = {tag.decode(): (offset, length) for tag, _, offset, length in entries}
        self.units: int = struct.unpack_from(">H", self.table("head"), 18)[0]
        self.size = self.units / CAPITALS[face]

    def table(self, tag: str) -> bytes:
        """Return the bytes of one table."""
        offset, length = self.tables[tag]
        return self.data[offset : offset + length]

    def _words(self, tag: str, kind: str, start: int = 0, count: int | None = None) -> array[int]:
        size = array(kind).itemsize
        offset, length = self.tables[tag]
        end = offset + length if count is None else offset + start + count * size
        words = array(kind, self.data[offset + start : end])
        if sys.byteorder == "little":
            words.byteswap()
        return words

    @cached_property
    def _segments(self) -> tuple[array[int], int, int]:
        """Return ends of the ranges of the character map, their count, and where the map starts."""
        offset = self.tables["cmap"][0]
        for index in range(struct.unpack_from(">H", self.data, offset + 2)[0]):
            platform, encoding, start = struct.unpack_from(">HHL", self.data, offset + 4 + 8 * index)
            if (platform, encoding) == (3, 1):
                segments = struct.unpack_from(">H", self.data, offset + start + 6)[0] // 2
                return self._words("cmap", "H", start + 14, segments), segments, offset + start
        raise LookupError("no Unicode map in the font")

    @cached_property
    def _advances(self) -> array[int]:
        count = struct.unpack_from(">H", self.table("hhea"), 34)[0]
        return self._words("hmtx", "H", 0, 2 * count)

    @cached_property
    def _places(self) -> array[int]:
        """Return where each outline starts in the table `glyf`."""
        if struct.unpack_from(">H", self.table("head"), 50)[0]:
            return self._words("loca", "I")
        return array("I", (2 * half for half in self._words("loca", "H")))

    @cache  # noqa: B019 - one font lives as long as the program
    def glyph(self, character: str) -> int:
        """Return the number of the glyph of `character`; 0 when the font has none."""
        code = ord(character)
        ends, count, start = self._segments
        index = bisect_left(ends, code)
        at = start + 16 + 2 * count + 2 * index
        first = struct.unpack_from(">H", self.data, at)[0]
        delta = struct.unpack_from(">H", self.data, at + 2 * count)[0]
        place = struct.unpack_from(">H", self.data, at + 4 * count)[0]
        if code > 0xFFFF or code < first:
            return 0
        if place == 0:
            return int(code + delta) & 0xFFFF
        glyph = struct.unpack_from(">H", self.data, at + 4 * count + place + 2 * (code - first))[0]
        return int(glyph + delta) & 0xFFFF if glyph else 0

    def strict_glyph(self, character: str) -> int:
        """Return the glyph of `character`.

        Raises InputError: the font has no such character, so a reader would see a box.
        """
        glyph = self.glyph(character)
        if glyph == 0:
            shown = character if character.isprintable() else repr(character)[1:-1]
            raise InputError("character-missing", character=shown, code=f"U+{ord(character):04X}")
        return glyph

    def _box(self, character: str) -> tuple[int, ...]:
        """Return the advance of a character, and its left, lowest, right and highest point, in units of the font."""
        glyph = self.strict_glyph(character)
        outline, advance = self.outline(glyph), self.metric(glyph)[0]
        return advance, *(struct.unpack_from(">4h", outline, 2) if outline else (0, 0, advance, 0))

    @cache  # noqa: B019
    def ink(self, character: str) -> tuple[float, float, float]:
        """Return advance, lowest and highest point of a character, in units of the font size."""
        advance, _, low, _, high = self._box(character)
        return advance / self.units, low / self.units, high / self.units

    @cache  # noqa: B019
    def beyond(self, character: str) -> tuple[float, float]:
        """Return how far the ink of a character begins before its place and ends behind its advance.

        Where it begins behind its place, or ends before its advance, that is negative.
        """
        advance, left, _, right, _ = self._box(character)
        return -left / self.units, (right - advance) / self.units

    def outline(self, glyph: int) -> bytes:
        """Return the outline of a glyph as it stands in the file; empty for a space."""
        start = self.tables["glyf"][0]
        return self.data[start + self._places[glyph] : start + self._places[glyph + 1]]

    def metric(self, glyph: int) -> tuple[int, int]:
        """Return advance and left side bearing of a glyph in the font's own units."""
        advances = self._advances
        if 2 * glyph < len(advances):
            bearing = advances[2 * glyph + 1]
            return advances[2 * glyph], bearing - 0x10000 if bearing > 0x7FFF else bearing
        extra = 2 * len(advances) + 2 * (glyph - len(advances) // 2)
        return advances[-2], struct.unpack_from(">h", self.table("hmtx"), extra)[0]


@cache
def font(face: str) -> _Font:
    """Return a face: our letters lie beside this file, DejaVu Sans in matplotlib's data, which is not imported."""
    if face == SCREEN:
        spec = find_spec("matplotlib")
        if spec is None or spec.origin is None:
            raise InputError("font-missing", file="DejaVuSans.ttf")
        path = Path(spec.origin).parent / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf"
    else:
        path = Path(__file__).with_name(f"letters-{face}.ttf")
    if not path.is_file():
        raise InputError("font-missing", file=quote(path, SHOWN))
    return _Font(face, path.read_bytes())


def _parts(outline: bytes) -> tuple[list[tuple[int, int]], int]:
    """Return the places and glyph numbers of the parts of a composite outline, and where the last part ends."""
    parts, at, flags = [], 10, _MORE
    while flags & _MORE:
        flags, glyph = struct.unpack_from(">HH", outline, at)
        parts.append((at + 2, glyph))
        at += 4 + (4 if flags & _WORDS else 2)
        at += 2 if flags & _SCALE else 4 if flags & _XY_SCALE else 8 if flags & _TWO_BY_TWO else 0
    return parts, at


def _stripped(outline: bytes, numbers: dict[int, int]) -> bytes:
    """Return an outline without hinting instructions, its parts under their new numbers."""
    if not outline:
        return b""
    contours = struct.unpack_from(">h", outline)[0]
    new = bytearray(outline)
    if contours >= 0:
        at = 10 + 2 * contours
        length = struct.unpack_from(">H", outline, at)[0]
        new[at : at + 2 + length] = b"\0\0"
    else:
        parts, end = _parts(outline)
        for at, glyph in parts:
            flags = struct.unpack_from(">H", outline, at - 2)[0]
            struct.pack_into(">HH", new, at - 2, flags & ~_INSTRUCTIONS, numbers[glyph])
        del new[end:]
    return bytes(new)


def _character_map(pairs: list[tuple[int, int]]) -> bytes:
    """Return a `cmap` of format 4 with one segment for each run of characters and glyphs."""
    runs: list[list[int]] = []
    for code, glyph in pairs:
        if runs and runs[-1][1] == code - 1 and code - runs[-1][0] == glyph - runs[-1][2]:
            runs[-1][1] = code
        else:
            runs.append([code, code, glyph])
    runs.append([0xFFFF, 0xFFFF, 0])
    count = len(runs)
    power = 1 << (count.bit_length() - 1)
    ends = struct.pack(f">{count}H", *(end for _, end, _ in runs))
    starts = struct.pack(f">{count}H", *(start for start, _, _ in runs))
    deltas = struct.pack(f">{count}H", *((glyph - start) & 0xFFFF for start, _, glyph in runs))
    search = struct.pack(">4H", 2 * count, 2 * power, power.bit_length() - 1, 2 * (count - power))
    body = search + ends + b"\0\0" + starts + deltas + bytes(2 * count)
    return struct.pack(">HHHHL", 0, 1, 3, 1, 12) + struct.pack(">HHH", 4, 6 + len(body), 0) + body


def _name_table(face: str) -> bytes:
    """Return the names a font must carry: family, style, identity, full name, version, PostScript name."""
    family, style = FAMILIES[face], "Italic" if face == SLANTED else "Regular"
    whole = f"{family} {style}"
    texts = [family, style, f"{whole} subset", whole, "Version 1.0", family.replace(" ", "") + style]
    records, strings = b"", b""
    for number, text in enumerate(texts, start=1):
        encoded = text.encode("utf-16-be")
        records += struct.pack(">6H", 3, 1, 0x409, number, len(encoded), len(strings))
        strings += encoded
    return struct.pack(">HHH", 0, len(texts), 6 + len(records)) + records + strings


def _padded(data: bytes) -> bytes:
    return data + b"\0" * (-len(data) % 4)


def _checksum(data: bytes) -> int:
    words = _padded(data)
    return int(sum(struct.unpack(f">{len(words) // 4}L", words))) & 0xFFFFFFFF


def _closure(source: _Font, characters: Iterable[str]) -> tuple[list[tuple[int, int]], dict[int, int]]:
    """Return pairs of character code and new glyph number, and the new number of every glyph needed."""
    codes = sorted({ord(character) for character in characters})
    numbers = {0: 0}
    for code in codes:
        numbers.setdefault(source.strict_glyph(chr(code)), len(numbers))
    waiting = list(numbers)
    while waiting:
        outline = source.outline(waiting.pop())
        if outline[:1] >= b"\x80":  # a negative number of contours
            for _, part in _parts(outline)[0]:
                if part not in numbers:
                    numbers[part] = len(numbers)
                    waiting.append(part)
    return [(code, numbers[source.glyph(chr(code))]) for code in codes], numbers


def _subset_tables(source: _Font, characters: Iterable[str]) -> dict[str, bytes]:
    pairs, numbers = _closure(source, characters)
    outlines = [_stripped(source.outline(glyph), numbers) for glyph in numbers]
    places = [0]
    for outline in outlines:
        places.append(places[-1] + len(outline))
    head = bytearray(source.table("head"))
    struct.pack_into(">L", head, 8, 0)  # the sum of the whole file follows later
    struct.pack_into(">H", head, 50, 1)
    hhea = bytearray(source.table("hhea"))
    struct.pack_into(">H", hhea, 34, len(numbers))
    maxp = bytearray(source.table("maxp"))
    struct.pack_into(">H", maxp, 4, len(numbers))
    struct.pack_into(">H", maxp, 26, 0)  # no instructions are left
    return {
        "OS/2": source.table("OS/2"),
        "cmap": _character_map(pairs),
        "glyf": b"".join(outlines),
        "head": bytes(head),
        "hhea": bytes(hhea),
        "hmtx": b"".join(struct.pack(">Hh", *source.metric(glyph)) for glyph in numbers),
        "loca": struct.pack(f">{len(places)}L", *places),
        "maxp": bytes(maxp),
        "name": _name_table(source.face),
        "post": struct.pack(">L", 0x30000) + source.table("post")[4:32],
    }


@lru_cache(maxsize=64)
def web_subset(face: str, characters: str) -> bytes:
    """Return a face with the glyphs of `characters` only, compressed as web pages have it (WOFF 1), without hinting.

    It is always smaller than the plain file of which it has the checksums.
    """
    plain = _subset_tables(font(face), characters)
    sums = {tag: _checksum(data) for tag, data in plain.items()}
    power = 1 << (len(plain).bit_length() - 1)
    file = struct.pack(">L4H", 0x10000, len(plain), 16 * power, power.bit_length() - 1, 16 * (len(plain) - power))
    at = 12 + 16 * len(plain)
    for tag, data in plain.items():
        file += struct.pack(">4sLLL", tag.encode(), sums[tag], at, len(data))
        at += len(_padded(data))
    head, file = bytearray(plain["head"]), file + b"".join(map(_padded, plain.values()))
    struct.pack_into(">L", head, 8, (0xB1B0AFBA - _checksum(file)) & 0xFFFFFFFF)
    whole = plain | {"head": bytes(head)}
    size = 12 + sum(16 + len(_padded(data)) for data in plain.values())
    at, entries, body = 44 + 20 * len(plain), b"", b""
    for tag, data in whole.items():
        packed = min(data, zlib.compress(data, 9), key=len)  # as it is where it is as short: so readers tell them apart
        entries += struct.pack(">4sLLLL", tag.encode(), at + len(body), len(packed), len(data), sums[tag])
        body += _padded(packed)
    header = struct.pack(">4sLLHHLHH5L", b"wOFF", 0x10000, at + len(body), len(plain), 0, size, 2, 37, 0, 0, 0, 0, 0)
    return header + entries + body
