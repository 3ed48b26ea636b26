"""The frame of a sheet, and what stands in and round it: a title block after GOST 2.104 or ISO 7200, column 26.

Text in a cell is as large as fits, wrapped, shrunk, at last made narrower; of people's names surname and initials stay.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, pi
from typing import TypeAlias

from ..scales.errors import InputError
from ..scales.numbers import quote
from ..scales.packaged import packaged
from .formats import Format, Norm, block_box, drawing_area, turned_box
from .shapes import Anchor, Group, Line, Pen, Polyline, Shape, Text, shifted
from .text import Box, escape, lay_out

T, t = Pen.MAIN, Pen.THIN
CAPTION = (2.5,)
UNDER = 3.7  # mm from the frame down to the words under it
SIDE, EDGE = 1.0, 0.65  # clear of the lines of the cell, mm; half of the widest line is 0.4
BESIDE = 0.3  # of their height, what letters keep clear of the lines beside them where smaller ones would do
CLEAR = 0.45  # what the ink of a high or deep letter may leave of it
PITCH = 1.5  # from baseline to baseline, in heights of a capital
FALL = 0.3  # of p and y below the baseline, in heights of a capital
SHOWN = 60  # characters of a text in a message
NARROWEST = 40  # per cent of a letter's own width
# how narrow letters of a name may be made: of a full one, which initials may stand for, and of any that one can read
ROOMY, LEGIBLE = 0.75, 0.5
_PATRONYMIC = re.compile(r"\w+(вич|івна|ївна|ична|овна|евна|vych|vich|ivna|yivna|ovna|evna)", re.IGNORECASE)
_INITIALS = re.compile(r"(?:[A-ZА-ЯҐЁЄІЇ]\.-?)+")
ABBREVIATED = 3  # letters of a department in capitals
# endings that surnames have, and the given names that have them
_OF_SURNAMES = (
    *("енко", "йко", "чук", "щук", "ський", "ська", "цький", "цька", "ский", "ская", "цкий", "цкая", "зький", "зька"),
    *("ов", "ова", "ев", "ева", "єв", "єва", "ьов", "ьова", "ёв", "ёва", "ишин", "ець", "єць", "дзе", "швілі"),
    *("enko", "chuk", "ska", "ski", "sky", "skyi", "skaya"),
)
_OF_GIVEN = ("любов", "лев", "єва", "ева")
Ruling: TypeAlias = tuple[tuple[float, float, float, float, Pen], ...]  # ends and pens of lines


@dataclass(frozen=True, slots=True)
class Stamp:
    """What the title block says; an empty field stays blank on the sheet.

    Where no `designation` is said, one is composed of the `code` of the work and the number of the drawing, which all
    its sheets have (GOST 2.104): 001, of a further `series` 101. `identity` stands under the frame: what tells the data
    of a sheet from others.
    """

    title: str = ""
    designation: str = ""
    organisation: str = ""
    group: str = ""
    student: str = ""
    teacher: str = ""
    date: str = ""
    document_type: str = ""
    sheet: int = 1
    sheets: int = 1
    scale: str = ""
    language: str = "uk"
    identity: str = ""
    code: str = ""
    series: int = 0

    @property
    def designated(self) -> str:
        """The designation of the drawing."""
        return self.designation or (f"{self.code}.{100 * self.series + 1:03d}" if self.code else "")


# From the bottom left corner of the block: level and ends of horizontal lines, place and ends of vertical ones, mm.
# The bottom and the right side of every block are lines of the frame.
FORM_1: Ruling = (
    (0, 55, 185, 55, T),
    *((0, y, 65, y, t) for y in (50, 45, 40)),
    (65, 40, 185, 40, T),
    (0, 35, 65, 35, T),
    (135, 35, 185, 35, T),
    (0, 30, 65, 30, T),
    *((0, y, 65, y, t) for y in (25, 20, 15, 10, 5)),
    (135, 20, 185, 20, T),
    (65, 15, 185, 15, T),
    (0, 0, 0, 55, T),
    (7, 30, 7, 55, T),
    *((x, 0, x, 55, T) for x in (17, 40, 55, 65)),
    (135, 0, 135, 40, T),
    *((x, 20, x, 35, t) for x in (140, 145)),
    *((x, 20, x, 40, T) for x in (150, 167)),
    (155, 15, 155, 20, T),
)
FORM_2A: Ruling = (
    (0, 15, 185, 15, T),
    (0, 10, 65, 10, t),
    (0, 5, 65, 5, T),
    (175, 8, 185, 8, T),
    *((x, 0, x, 15, T) for x in (0, 7, 17, 40, 55, 65, 175)),
)
FORM_2: Ruling = (  # of the first sheet of a text
    (0, 40, 185, 40, T),
    (0, 35, 65, 35, t),
    (0, 30, 65, 30, T),
    (0, 25, 185, 25, T),
    *((x, y, end, y, pen) for y in (20, 15) for x, end, pen in ((0, 65, t), (135, 185, T))),
    *((0, y, 65, y, t) for y in (10, 5)),
    *((x, 0, x, 40, T) for x in (0, 17, 40, 55, 65)),
    (7, 25, 7, 40, T),
    (135, 0, 135, 25, T),
    *((x, 15, x, 20, t) for x in (140, 145)),
    *((x, 15, x, 25, T) for x in (150, 165)),
)
CHANGES = (("change", 0, 7), ("row_sheet", 7, 17), ("document_no", 17, 40), ("signature", 40, 55), ("date", 55, 65))
# heights, mm, at which it stands who has done what
ROLES = {"drawn": 25.0, "checked": 20.0, "technical": 15.0, "norms": 5.0, "approved": 0.0}
TEXT_ROLES = {"drawn": 20.0, "checked": 15.0, "norms": 5.0, "approved": 0.0}


def words(language: str) -> dict[str, str]:
    """Return the captions of title blocks in `language`, by key."""
    captions: dict[str, str] = packaged(__package__, "texts", f"titleblock.{language}")["titleblock"]
    return captions


def _ruled(lines: Ruling) -> list[Shape]:
    """Return the lines of a table of ends and pens."""
    return [Line(complex(x0, y0), complex(x1, y1), pen, role="cell") for x0, y0, x1, y1, pen in lines]


def _changes(caption: dict[str, str], y: float) -> list[Text]:
    cells = (_fitted(caption[key], (float(x0), y, float(x1), y + 5.0), CAPTION, name=key) for key, x0, x1 in CHANGES)
    return [text for cell in cells for text in cell]


def _signed(stamp: Stamp, roles: Mapping[str, float]) -> list[Shape]:
    """Return who has drawn and checked, and when, each role at its height in mm, under the heads of changes."""
    caption, level = words(stamp.language), roles["drawn"]
    filled: list[Shape] = [*_changes(caption, level + 5.0)]
    for key, y in roles.items():
        filled += _fitted(caption[key], (0.0, y, 17.0, y + 5.0), CAPTION, "left", key)
    for key, plain, y in (("student", stamp.student, level), ("teacher", stamp.teacher, roles["checked"])):
        filled += _named(plain, (17.0, y, 40.0, y + 5.0), CAPTION, "left", key)
    return [*filled, *_fitted(stamp.date, (55.0, level, 65.0, level + 5.0), CAPTION, name="date_value")]


def _form_1(stamp: Stamp) -> list[Shape]:
    """Return form 1, 185 x 55 mm, filled in."""
    caption, filled = words(stamp.language), _signed(stamp, ROLES)
    name_cell = (65.0, 22.0 if stamp.document_type else 15.0, 135.0, 40.0)
    owner = ", ".join(part for part in (stamp.organisation, stamp.group) if part)
    for key, plain, cell, heights in (
        ("designation", stamp.designated, (65.0, 40.0, 185.0, 55.0), (7.0, 5.0, 3.5, 2.5)),
        ("title", stamp.title, name_cell, (5.0, 3.5, 2.5)),
        ("document_type", stamp.document_type, (65.0, 15.0, 135.0, 22.5), (3.5, 2.5)),
        ("organisation", owner, (135.0, 0.0, 185.0, 15.0), (5.0, 3.5, 2.5)),
        ("letter", caption["letter"], (135.0, 35.0, 150.0, 40.0), CAPTION),
        ("letter_value", caption["letter_value"], (135.0, 20.0, 140.0, 35.0), (3.5, 2.5)),
        ("mass", caption["mass"], (150.0, 35.0, 167.0, 40.0), CAPTION),
        ("scale_caption", caption["scale"], (167.0, 35.0, 185.0, 40.0), CAPTION),
        ("scale", stamp.scale, (167.0, 20.0, 185.0, 35.0), (5.0, 3.5, 2.5)),
        ("sheet", f"{caption['sheet']} {stamp.sheet}", (135.0, 15.0, 155.0, 20.0), CAPTION),
        ("sheets", f"{caption['sheets']} {stamp.sheets}", (155.0, 15.0, 185.0, 20.0), CAPTION),
    ):
        filled += _fitted(plain, cell, heights, name=key)
    return [*_ruled(FORM_1), *filled]


def _form_2a(stamp: Stamp) -> list[Shape]:
    """Return form 2a, 185 x 15 mm, for the sheets after the first."""
    caption = words(stamp.language)
    filled: list[Shape] = [*_changes(caption, 0.0)]
    who = ", ".join(part for part in (stamp.student, stamp.group) if part)
    level = 5.5 if who else 0.0
    filled += _fitted(stamp.designated, (65.0, level, 175.0, 15.0), (7.0, 5.0, 3.5, 2.5), name="designation")
    filled += _fitted(who, (65.0, 0.0, 175.0, level), (3.5, 2.5), name="student")
    filled += _fitted(caption["row_sheet"], (175.0, 8.0, 185.0, 15.0), CAPTION, name="sheet_caption")
    filled += _fitted(str(stamp.sheet or ""), (175.0, 0.0, 185.0, 8.0), (3.5, 2.5), name="sheet")
    return [*_ruled(FORM_2A), *filled]


def _form_2(stamp: Stamp) -> list[Shape]:
    """Return form 2, 185 x 40 mm, for the first sheet of a text; its numbers of sheets are left blank."""
    caption, filled = words(stamp.language), _signed(stamp, TEXT_ROLES)
    owner = ", ".join(part for part in (stamp.organisation, stamp.group) if part)
    for key, plain, cell, heights in (
        ("designation", stamp.designation, (65.0, 25.0, 185.0, 40.0), (7.0, 5.0, 3.5, 2.5)),
        ("title", stamp.title, (65.0, 8.0, 135.0, 25.0), (5.0, 3.5, 2.5)),
        ("document_type", stamp.document_type, (65.0, 0.0, 135.0, 8.0), (3.5, 2.5)),
        ("organisation", owner, (135.0, 0.0, 185.0, 15.0), (5.0, 3.5, 2.5)),
        ("letter", caption["letter"], (135.0, 20.0, 150.0, 25.0), CAPTION),
        ("letter_value", caption["letter_value"], (135.0, 15.0, 140.0, 20.0), (3.5, 2.5)),
        ("sheet_caption", caption["row_sheet"], (150.0, 20.0, 165.0, 25.0), CAPTION),
        ("sheets", caption["sheets"], (165.0, 20.0, 185.0, 25.0), CAPTION),
    ):
        filled += _fitted(plain, cell, heights, name=key)
    return [*_ruled(FORM_2), *filled]


def fields(form: str, language: str) -> dict[str, Text]:
    """Return a mark at the place of each field of a title block by its name, from its corner; none of other forms."""
    blocks = {"form-1": _form_1, "form-2a": _form_2a, "iso-7200": _iso_block}
    stamp = Stamp("-", "-", "-", "", "-", "-", "-", "-", language=language)
    parts = blocks[form](stamp) if form in blocks else []
    return {part.name: part for part in parts if isinstance(part, Text) and part.markup == "-"}


def text_frame(sheet: Format, stamp: Stamp, form: str) -> tuple[Shape, ...]:
    """Return the frame of a page of a text, with the block of form `2` or `2a`, or none; its number is left blank.

    Raises InputError: a field is too long for its cell.
    """
    area = drawing_area(sheet)
    frame = _rectangle(area, T, "frame")
    if not form:
        return (frame,)
    parts = _form_2(stamp) if form == "2" else _form_2a(replace(stamp, sheet=0, code=""))
    x0 = block_box(sheet, first=False)[0]  # either form is as wide
    return frame, _at_corner(parts, f"form-{form}", x0, area[1])


# From the bottom left corner of the block, mm: 180 x 36 in three rows of 12.
ISO_7200: Ruling = (
    (0, 36, 180, 36, T),
    (0, 0, 0, 36, T),
    (0, 24, 140, 24, t),
    (0, 12, 180, 12, t),
    (80, 0, 80, 36, t),
    (100, 0, 100, 12, t),
    (140, 0, 140, 36, t),
    (160, 0, 160, 12, t),
)


def _iso_block(stamp: Stamp) -> list[Shape]:
    """Return the block of ISO 7200, filled in; a caption stands in the top left of each cell."""
    caption = words(stamp.language)
    creator = " ".join(part for part in (stamp.student, stamp.group) if part)
    parts = _ruled(ISO_7200)
    for key, value, (x0, y0, x1, y1) in (
        ("title", stamp.title, (0.0, 24.0, 80.0, 36.0)),
        ("document_type", stamp.document_type, (0.0, 12.0, 80.0, 24.0)),
        ("identification", stamp.designated, (0.0, 0.0, 80.0, 12.0)),
        ("creator", creator, (80.0, 24.0, 140.0, 36.0)),
        ("approver", stamp.teacher, (80.0, 12.0, 140.0, 24.0)),
        ("owner", stamp.organisation, (140.0, 12.0, 180.0, 36.0)),
        ("language", stamp.language, (80.0, 0.0, 100.0, 12.0)),
        ("issued", stamp.date, (100.0, 0.0, 140.0, 12.0)),
        ("revision", "", (140.0, 0.0, 160.0, 12.0)),
        ("sheet", f"{stamp.sheet}/{stamp.sheets}", (160.0, 0.0, 180.0, 12.0)),
    ):
        parts += _fitted(caption[f"iso_{key}"], (x0, y1 - 4.6, x1, y1), CAPTION, "left", f"{key}_caption")
        parts += _fitted(value, (x0, y0, x1, y1 - 3.69), (3.5, 2.5), "left", key)
    return parts


def _centring_marks(sheet: Format) -> Group:
    """Return the four marks in the middles of the sides, from 5 mm outside the frame to 5 mm inside it."""
    x0, y0, x1, y1 = drawing_area(sheet, "iso")
    across, up = sheet.width / 2, sheet.height / 2
    left, _, right, _ = block_box(sheet, "iso")
    inward = 0 if left < across < right else 5  # a mark through the title block would cross its words
    ends = (
        (complex(x0 - 5, up), complex(x0 + 5, up)),
        (complex(x1 + 5, up), complex(x1 - 5, up)),
        (complex(across, y0 - 5), complex(across, y0 + inward)),
        (complex(across, y1 + 5), complex(across, y1 - 5)),
    )
    return Group(tuple(Line(a, b, T) for a, b in ends), "margin", "centring")


def frame_shapes(sheet: Format, stamp: Stamp, norm: Norm, first: bool) -> tuple[Shape, ...]:
    """Return edge, frame, title block and what stands round them; following sheets get the small block.

    Raises InputError: a field is too long for its cell, or the font lacks one of its characters.
    """
    edge = _rectangle((0.0, 0.0, sheet.width, sheet.height), t, "edge")
    frame = _rectangle(drawing_area(sheet, norm), T, "frame")
    x0, y0, _, _ = block_box(sheet, norm, first)
    identity: tuple[Shape, ...] = ()
    if stamp.identity:  # at the left end under the frame, to be copied into a form of answers
        text = words(stamp.language)["identity"].format(stamp.identity)
        at = drawing_area(sheet)[0] + 2.0
        identity = (Group((_under(sheet, at, text, "identity"),), "margin", "identity"),)
    if norm == "iso":
        return edge, frame, _centring_marks(sheet), _at_corner(_iso_block(stamp), "iso-7200", x0, y0), *identity
    parts, name = (_form_1(stamp), "form-1") if first else (_form_2a(stamp), "form-2a")
    caption, right = words(stamp.language), drawing_area(sheet)[2]
    size = _under(sheet, right - 50, caption["format"].format(sheet.letters), "format")
    below = Group((_under(sheet, right - 120, caption["copied"], "copied"), size), "margin")
    turned = (_turned(sheet, stamp),) if first else ()
    return edge, frame, _at_corner(parts, name, x0, y0), below, *turned, *identity


def _rectangle(box: Box, pen: Pen, role: str) -> Polyline:
    x0, y0, x1, y1 = box
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Polyline(corners, pen, closed=True, role=role)


def _at_corner(parts: Iterable[Shape], name: str, x0: float, y0: float) -> Group:
    """Return a title block whose bottom left corner lies at (x0, y0), its outer corner mitred."""
    moved = [shifted(part, complex(x0, y0)) for part in parts]
    lines = [part for part in moved if isinstance(part, Line)]
    corner = complex(x0, max(line.a.imag for line in lines))
    return Group((*moved, Polyline((corner - 1j, corner, corner + 1), T, role="corner")), "titleblock", name)


def _under(sheet: Format, x: float, text: str, name: str) -> Text:
    return Text(complex(x, drawing_area(sheet)[1] - UNDER), text, 2.5, role="stamp", name=name)


def _turned(sheet: Format, stamp: Stamp) -> Group:
    """Return column 26: the designation turned round, for whoever looks through a pile of folded sheets."""
    x0, y0, x1, y1 = turned_box(sheet)
    tall = y1 - y0 > x1 - x0
    near, far = (x0, x1) if tall else (x1, x0)
    bend = complex(near, y0)
    lines = Polyline((complex(far, y0), bend, complex(near, y1)), T, role="cell")
    middle, turn, angle = complex((x0 + x1) / 2, (y0 + y1) / 2), (-1j if tall else -1), (-pi / 2 if tall else pi)
    texts = _fitted(stamp.designated, (-35.0, -7.0, 35.0, 7.0), (7.0, 5.0, 3.5, 2.5), name="designation_turned")
    turned = (replace(text, at=middle + text.at * turn, angle=angle) for text in texts)
    return Group((lines, *turned), "titleblock", "column-26")


def _fitted(plain: str, cell: Box, heights: Sequence[float], anchor: Anchor = "middle", name: str = "") -> list[Text]:
    """Return the lines of `plain` text that fill `cell`, in the largest of `heights` that fits.

    An InputError says that it is too long even for the smallest and narrowest letters.
    """
    words = plain.split()
    if not words:
        return []
    wide, high = cell[2] - cell[0] - 2 * SIDE, cell[3] - cell[1]
    for height in heights:
        lines = _wrapped(words, height, cell[2] - cell[0] - 2 * max(SIDE, BESIDE * height))
        if lines and _fits(lines, height, high):
            return _placed(lines, cell, height, anchor, name)
    height = heights[-1]
    for percent in range(98, NARROWEST - 1, -2):
        lines = _wrapped(words, height, wide * 100 / percent)
        if lines and (len(lines) == 1 or _fits(lines, height, high)):
            return [replace(line, squeeze=percent / 100) for line in _placed(lines, cell, height, anchor, name)]
    raise InputError("stamp-too-long", field=name, text=quote(" ".join(words), SHOWN))


def _extent(lines: list[str], height: float) -> tuple[float, float, float]:
    """Return the height of a block of lines, from the capitals of the first to the tails of the last, and its ink.

    That is bottom and top of what is seen, measured from the baseline of the first line.
    """
    layouts = [lay_out(escape(line), height, symbols=False) for line in lines]
    bottom = min(layout.bottom - row * PITCH * height for row, layout in enumerate(layouts))
    top = max(layout.top - row * PITCH * height for row, layout in enumerate(layouts))
    return ((len(lines) - 1) * PITCH + 1 + FALL) * height, bottom, top


def _fits(lines: list[str], height: float, high: float) -> bool:
    """Tell whether a block, and what its letters have above capitals, finds room in a cell `high` mm high."""
    depth, bottom, top = _extent(lines, height)
    return depth <= high - 2 * EDGE and top - bottom <= high - 2 * CLEAR


def _wrapped(words: list[str], height: float, wide: float) -> list[str]:
    """Return lines no wider than `wide`, or nothing when one word is wider than that."""
    lines: list[str] = []
    for word in words:
        longer = f"{lines[-1]} {word}" if lines else word
        if lay_out(escape(word), height, symbols=False).width > wide:
            return []
        if lines and lay_out(escape(longer), height, symbols=False).width <= wide:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def _placed(lines: list[str], cell: Box, height: float, anchor: Anchor, name: str) -> list[Text]:
    """Return lines centred in the height of the cell, one under the other."""
    x0, y0, x1, y1 = cell
    x = {"left": x0 + SIDE, "middle": (x0 + x1) / 2, "right": x1 - SIDE}[anchor]
    depth, bottom, top = _extent(lines, height)
    y = (y0 + y1 + depth) / 2 - height
    if y + top > y1 - CLEAR:  # a capital with a breve; no tail is so deep
        y = (y0 + y1 - top - bottom) / 2
    return [
        Text(complex(x, y - row * PITCH * height), escape(line), height, anchor, role="stamp", name=name)
        for row, line in enumerate(lines)
    ]


def _named(plain: str, cell: Box, heights: Sequence[float], anchor: Anchor, name: str) -> list[Text]:
    """Return the lines of a person's name in `cell`, in letters that one can read where that is possible.

    Where not even the surname has room an InputError says so.
    """
    found: list[list[Text]] = []
    refused: list[InputError] = []
    short = (_surname(plain), _with_initials(plain, titles=False), _with_initials(plain))
    known = _surname_at(plain.split())[1]
    ways = dict.fromkeys(short, LEGIBLE if known else inf)
    for way, least in (ways | {plain: LEGIBLE if plain in short else ROOMY if known else 0.0}).items():
        try:
            texts = _fitted(way, cell, heights, anchor, name)
        except InputError as error:
            refused.append(error)
        else:
            found.insert(0 if all(text.squeeze >= least for text in texts) else len(found), texts)
    if not found:
        raise refused[-1]
    return found[0]


def _surname(plain: str) -> str:
    """Return the surname of a full name.

    >>> _surname("Коваль Іван Петрович"), _surname("Іван Петрович Коваль"), _surname("Ivan Koval")
    ('Коваль', 'Коваль', 'Koval')
    """
    words = plain.split()
    return words[_surname_at(words)[0]] if words else ""


def _with_initials(plain: str, titles: bool = True) -> str:
    """Return a full name as surname and initials, in the order in which it is written.

    >>> _with_initials("Коваль Анна-Марія Петрівна"), _with_initials("Ivan Koval"), _with_initials("доц. Коваль Ольга")
    ('Коваль А.-М. П.', 'I. Koval', 'доц. Коваль О.')
    """
    words = plain.split()
    surname = _surname_at(words)[0]
    has_initials = any(map(_INITIALS.fullmatch, words))

    def written(at: int, word: str) -> str:
        if at == surname or _INITIALS.fullmatch(word):
            return word
        if has_initials or word.endswith(".") or not word[:1].isalpha():
            return word if titles else ""
        return re.sub(r"(\w)\w+", r"\1.", word)

    return " ".join(filter(None, map(written, range(len(words)), words)))


def _surname_at(words: Sequence[str]) -> tuple[int, bool]:
    """Return which word of a name is the surname, and whether anything tells so: of `Олена Лось` nothing does.

    What does: initials beside it, a comma behind it, its capitals, a patronymic, its ending. Else it is taken for the
    first word, in Latin for the last.
    """
    if not words:
        return 0, True
    names = [at for at, word in enumerate(words) if not word.endswith(".")] or [0]  # neither titles nor initials
    initials = [at for at, word in enumerate(words) if _INITIALS.fullmatch(word)]
    if initials and len(names) < len(words):
        behind = [at for at in names if at > initials[-1]]
        return (behind[0] if behind else [at for at in names if at <= initials[0]][-1]), True
    for told in (
        [at for at in names if words[at].endswith(",")],
        [at for at in names if words[at].isupper() and len(words[at]) > ABBREVIATED],
        [names[-1]] if len(names) > 2 and _PATRONYMIC.fullmatch(words[names[-2]]) else [],
        [names[-3]] if len(names) > 2 and _PATRONYMIC.fullmatch(words[names[-1]]) else [],
        [at for at in names if any(map(_is_surname, words[at].casefold().split("-")))],
    ):
        if len(told) == 1:
            return told[0], True
    return names[-1 if re.match("[A-Za-z]", words[names[0]]) else 0], len(names) == 1


def _is_surname(part: str) -> bool:
    return part.endswith(_OF_SURNAMES) and part not in _OF_GIVEN
