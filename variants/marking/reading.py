"""Which files hold answers, and what stands in them: one student's form, or a class, a row per student."""

from __future__ import annotations

import glob
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple, SupportsFloat, TypeVar

from ...drawing.words import GREEK
from ...plans.marking.answers import FREE, Answer
from ...plans.marking.lines import Drawn, side_by_side
from ...plans.quantities import Quantity
from ...scales.errors import InputError, KulmanError, Written, as_one
from ...scales.names import unknown
from ...scales.numbers import SHOWN, quote, split_number
from ...scales.units import UnitName, unit
from ..crew import digest_of
from ..drawings.files import SUFFIXES as DRAWINGS
from ..drawings.files import read_drawing
from ..photos.pictures import PICTURES, Photo, read_photos, together
from ..roster import NAMED, Who
from ..spreadsheets.files import read_grid
from ..spreadsheets.grid import LOOKED_AT, Grid, about_kind, column_kind, quantity_part, split_unit, tidy
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..task import LocatedError
from . import cells
from .cells import Asked, Mu

NUMBERS = ("mm", "mu", "value")
PARTS = (*NUMBERS, "direction")
PRINTED = "printed"
_PAGE = re.compile(r"(.*[^\W\d].*?)[-_ ]+([1-9])")  # the name of a file, and the number of a page
MOST_PAGES = 6  # of one student's drawing
LONGEST = 2000.0  # mm; no sheet has longer segments
SUFFIXES = (*TABLES, *DRAWINGS, *PICTURES)  # of files with answers
Columns = Mapping[str, tuple[int | None, str]]  # by what they hold: which they are, and the unit over them
Ends = tuple[complex, complex]  # of a vector: tail and tip
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Reply(Answer):
    """One answered quantity as it stands in a file: at which place, and the scale factor beside it.

    What is `foreign` are the units of segment and value that the student has written and that none of the quantity is:
    `5,62 km` for metres a second.
    """

    place: str = ""
    decimals: int = 0  # with which the segment was written
    factor: Mu | None = None
    foreign: tuple[str, str] = ("", "")


@dataclass(frozen=True, slots=True, repr=False)
class Answers:
    """All answers of one student; `about` is what the file says of task, variant and sheet id, as written.

    `problems` are cells that could not be read; what stands beside them is marked all the same. `columns` are the
    quantities that a class was asked, nothing for a form of one's own. `unread` is why a file could not be read, which
    is a student without a mark, not one who has handed in nothing. Of a drawing there are no lines until it is known
    for which variant: what it holds is `drawn`; nor of `photos` of sheets that were drawn by hand, of whose vectors
    somebody may have `told` where they end, mm of their page, or that they are not there. Of `plans`, or of all where
    that is not said, a student of whom there are photographs must have handed in the pages.
    """

    source: str
    who: Who
    about: Mapping[str, str]
    lines: Mapping[str, Reply]
    scales: Mapping[str, Mu]
    problems: tuple[KulmanError, ...] = ()
    columns: tuple[str, ...] = ()
    unread: KulmanError | None = None
    drawn: Drawn | None = None
    photos: tuple[Photo, ...] = ()
    told: Mapping[str, Ends | None] = field(default_factory=dict)
    plans: frozenset[str] | None = None

    def __repr__(self) -> str:
        """Return where they come from, and how many there are."""
        return f"<Answers {self.source}: {len(self.lines)}>"

    @property
    def digest(self) -> str:
        """What tells these answers from any other: all that stands in them, every line and picture too."""
        said = (self.source, self.who, *map(dict, (self.about, self.lines, self.scales, self.told)), self.columns)
        lines = () if self.drawn is None else (self.drawn.tails, self.drawn.tips, self.drawn.arrows)
        drawn = [one.tolist() for one in lines], self.drawn and self.drawn.letters
        pictures = [digest_of(photo.picture) for photo in self.photos]
        plans = None if self.plans is None else sorted(self.plans)
        return digest_of(repr((said, [*map(str, self.problems)], str(self.unread), drawn, pictures, plans)))


Warn = Callable[[KulmanError], None]


def _read_answers(file: str | Path, asked: Asked, called: str = "", warn: Warn | None = None) -> list[Answers]:
    """Return the answers that a file holds: of one student, or of a class; `called` is its name in messages.

    Whoever is there to `warn` is told of columns of a class that nobody knows; else they are a problem of the first
    student who has answered.

    Raises
    ------
    InputError
        The file cannot be read, or no row of it says what its columns hold, or whose answers they are.
    """
    if Path(file).suffix.lower() in PICTURES:
        return _photographed(file)
    if Path(file).suffix.lower() in DRAWINGS:
        try:
            return [Answers(str(file), Who(), {}, {}, {}, drawn=read_drawing(file))]
        except InputError as error:
            if error.key != "drawing-picture":
                raise
        return _photographed(file)
    if Path(file).suffix.lower() not in SUFFIXES:
        key = "answers-kind" if Path(file).exists() else "file-missing"
        raise InputError(key, file=quote(file, SHOWN), known=", ".join(SUFFIXES))
    grid = read_grid(file)
    grid = replace(grid, file=called or grid.file)
    for row, texts in enumerate(grid.rows[:LOOKED_AT]):
        kinds = _first(map(column_kind, texts))
        if "name" in kinds and not kinds.keys().isdisjoint(PARTS):
            return [_form(grid, row, kinds, asked)]
        headed = grid.joined(row)
        texts = headed.rows[row]
        parts = ((column, quantity_part(text)) for column, text in enumerate(_with_greek(texts, asked)))
        meant = ((column, (asked.meant(part[0]), *part[1:])) for column, part in parts if part is not None)
        columns = {column: part for column, part in meant if part[0] in asked.names}
        about = _first(map(about_kind, texts))
        if len(columns) > 1 or (columns and about):
            students = list(_class(headed, row, columns, about, asked, warn))
            if len(students) > 1 and about.keys().isdisjoint(NAMED):
                raise LocatedError(grid.place(row), InputError("answers-nameless"))
            return students
    raise InputError("answers-header", file=quote(grid.file, SHOWN))


def _photographed(file: str | Path) -> list[Answers]:
    """Return the answers on pictures of sheets, of one student or several; their QR codes tell task and variant."""
    found = list[Answers]()
    for photos in together(read_photos(file)):
        code = next((photo.code for photo in photos if photo.code), ())
        about = {"task": code[1].lower(), "variant": code[2].lower(), "sheet": code[3]} if code else {}
        found.append(Answers(str(file), Who(), about, {}, {}, photos=tuple(photos)))
    return found


def _with_greek(texts: Sequence[str], asked: Asked) -> list[str]:
    """Return headers of a class with their Greek letters where cp1251, which has none, left question marks.

    What stands behind the letter tells the quantity, and its unit; of several it is the next in the form's order.
    """
    left = [name for name in asked.names if name.partition("_")[0] in GREEK]
    found, whole = "", list[str]()
    for text in texts:
        head, written = split_unit(text)
        if not head.startswith("?_"):
            whole.append(text)
            continue
        if column_kind(written) != "direction" or not found.endswith(head[1:]):
            fits = (
                n for n in left if n.partition("_")[2] == head[2:] and _has_unit(n, written.replace("?", "2"), asked)
            )
            found = next(fits, "")
            left = [name for name in left if name != found]
        whole.append(text.replace("?", found.partition("_")[0] or "?", 1))
    return whole


def _has_unit(name: str, written: str, asked: Asked) -> bool:
    """Whether a unit may stand over a quantity; none does over scale factors and plain numbers."""
    wanted = unit("1" if name in asked.scales else asked.quantities[name].unit)
    with suppress(InputError):
        return unit(written or "1").dimension == wanted.dimension
    return False


def answers_of(said: Mapping[str, Any], asked: Asked) -> Answers:
    """Return the answers of a mapping by quantity: a `Quantity`, a text with its unit, a number in SI.

    What a solution has and nobody is asked for, points and lengths, is no answer.
    """
    rows = [("name", "value", "unit")]
    for name, value in said.items():
        if isinstance(value, Quantity) and value.name == name and name not in asked.names:
            continue
        if isinstance(value, Quantity) and value.kind == "point":
            raise unknown("quantity-unknown", name, asked.names)
        if isinstance(value, Quantity):
            rows.append((name, f"{float(value)!r}", value.unit))
        elif isinstance(value, str):
            rows.append((name, value, ""))
        elif isinstance(value, SupportsFloat) and name in asked.quantities:
            rows.append((name, f"{float(value)!r}", asked.quantities[name].unit))
        else:
            if name not in asked.names:
                raise unknown("quantity-unknown", name, asked.names)
            raise LocatedError(name, InputError("type-quantity", expected=UnitName(asked.quantities[name].unit)))
    found = _form(Grid("answers", tuple(rows)), 0, {"name": 0, "value": 1, "unit": 2}, asked)
    if not found.lines and not found.scales and found.problems:  # which nobody would look for in a report without marks
        raise as_one(found.problems)
    return found


def _first(kinds: Iterable[str | None]) -> dict[str, int]:
    """Return the first column of each kind."""
    found: dict[str, int] = {}
    for column, kind in enumerate(kinds):
        if kind is not None:
            found.setdefault(kind, column)
    return found


class _Cell(NamedTuple):
    """Where an answer stands, to which quantity it is one, and the unit that is written beside or over it."""

    row: int
    column: int | None
    name: str
    unit: str = ""


@dataclass(slots=True)
class _Sheet:
    """One student's answers while they are read."""

    grid: Grid
    asked: Asked
    problems: list[LocatedError] = field(default_factory=list)
    lines: dict[str, Reply] = field(default_factory=dict)
    scales: dict[str, Mu] = field(default_factory=dict)

    def refuse(self, cell: _Cell, key: str | InputError, text: object = "") -> None:
        """Note what cannot be read, with file, cell and quantity."""
        error = InputError(key, text=quote(text)) if isinstance(key, str) else key
        self.problems.append(LocatedError(f"{self.grid.place(cell.row, cell.column)}, {quote(cell.name)}", error))

    def read(self, cell: _Cell, reading: Callable[[], T]) -> T | None:
        """Return what stands in a cell; note why it cannot be read, and return None."""
        try:
            return reading()
        except InputError as error:
            self.refuse(cell, error)
            return None

    def filled(self, row: int, column: int | None) -> bool:
        """Whether a cell holds an answer."""
        return self.grid.text(row, column) not in cells.NONE

    def keyed(self, cell: _Cell, text: str) -> str:
        """Return the text of a cell with the decimal signs that are meant; note letters of their keys."""
        meant = cells.with_signs(text)
        if meant != text:
            self.refuse(cell, InputError("answer-decimal", text=quote(text), meant=quote(meant)))
        return meant

    def number(self, cell: _Cell) -> str:
        """Return the text of a cell that should hold a number, of a calculation its result; note what is wrong."""
        text = self.keyed(cell, self.read(cell, lambda: cells.checked(self.grid, cell.row, cell.column)) or "")
        slip = cells.slip_in(text)
        if slip is not None:
            makes = f"{slip.makes:.7g}"
            if "," in text or "." in text:  # as the student writes
                makes = Written(makes.replace(".", "," if "," in text else "."))
            self.refuse(cell, InputError("answer-calculation", text=slip.text, makes=makes, written=slip.written))
        return cells.signed(text.rpartition("=")[2].strip())

    def mu(self, cell: _Cell) -> Mu | None:
        """Read a scale factor: that of a quantity's plan, or one in a place of its own."""
        text = self.number(cell)
        if not text:
            return None
        drawn = self.asked.scales.get(cell.name) or self.asked.quantities[cell.name].unit
        shown, paper = self.asked.display.of_scales.unit(drawn), self.asked.display.paper
        units = f"({drawn})/mm", f"({shown})/{paper}"
        return self.read(cell, lambda: cells.scale_factor(text, cell.unit, *units))

    def scale(self, cell: _Cell) -> None:
        """Keep a scale factor that stands in a place of its own, the first of each name."""
        mu = self.mu(cell)
        if mu is not None:
            self.scales.setdefault(cell.name, mu)

    def value(self, cell: _Cell, text: str) -> tuple[float | None, str]:
        """Read a value; one with a wrong unit is noted, and taken in the unit of the form.

        The unit is returned, too, if it is that of another quantity: one that is none, or has only lost its signs (`мс`
        for m/s), is a slip of the pen.
        """
        try:
            return cells.value(text, cell.unit, cell.name, self.asked) if text else None, ""
        except InputError as error:
            garbled = error.key.startswith("unit-unknown") and cells.is_garbled(text)
            self.refuse(cell, "number-bad" if garbled else error, text)
            if garbled or not error.key.startswith("unit-"):
                return None, ""
            names = (error.data.get("text", ""), self.asked.quantities[cell.name].unit)
            slip = error.key != "unit-wrong" or len({re.sub(r"\W", "", name) for name in names}) == 1
            return cells.bare(text, cell.name, self.asked), "" if slip else split_number(text)[1] or cell.unit

    def segment(self, cell: _Cell, text: str) -> tuple[float | None, int, str]:
        """Read a segment, its decimals, and its unit if it is none of paper: one of kilometres is of millimetres."""
        read = self.read(cell, lambda: cells.segment(text, cell.unit)) if text else None
        if read is None:
            return None, 0, ""
        written = split_number(text)[1]
        if read[0] <= LONGEST or not written:
            return *read, ""
        self.refuse(cell, InputError("unit-wrong", text=written, expected=UnitName("mm")))
        return *cells.segment(text.removesuffix(written), ""), written

    def direction(self, cell: _Cell, answered: bool) -> tuple[float | None, int | None]:
        """Read an angle or a sense; an angle is none that a scalar could have, and a sense none of a vector.

        A dash says that there is no answer where nothing else is `answered` to a vector.
        """
        text, vector = self.grid.text(cell.row, cell.column), self.asked.quantities[cell.name].kind == "vector"
        if text in cells.NONE and (text not in ("-", "–") or (vector and not answered)):
            return None, None
        text = self.keyed(cell, text)
        angle, sense = self.read(cell, lambda: cells.direction(text, vector)) or (None, None)
        if angle is not None and self.asked.quantities[cell.name].kind == "scalar":
            self.refuse(cell, "answer-sense", text)
            return None, None
        return angle, sense

    def reply(self, row: int, name: str, columns: Columns, place: str, own: int | None = None) -> None:
        """Read all that is answered to one question, and keep what says anything, the first of each name.

        The name of the quantity stands in a column of its `own`, if it does.
        """
        found = (columns.get(part, (None, "")) for part in PARTS)
        of_mm, of_mu, of_value, of_direction = (_Cell(row, column, name, written) for column, written in found)
        mm, decimals, of_no_paper = self.segment(of_mm, self.number(of_mm))
        answered = any(self.filled(row, cell.column) for cell in (of_mm, of_mu, of_value))
        angle, sense = self.direction(of_direction, answered)
        mu, text = self.mu(of_mu), self.number(of_value)
        text, written, angle, sense = self.turned(of_value, text, angle, sense)
        value, foreign = self.value(of_value._replace(unit=written), text)
        if foreign and own is None and not split_number(text)[1]:  # over a column it is no student's
            foreign = ""
        plus = value is not None and text.startswith("+")
        last = None if value is None else cells.rounded(text, value)
        side = angle is not None and not any(map(str.isdigit, self.grid.text(row, of_direction.column)))
        told = (value, angle, side, sense, plus, last)
        reply = Reply(name, mm, None, *told, place, decimals, mu, (of_no_paper, foreign))
        if not reply.empty and name in self.lines:
            again = InputError("answer-again", place=self.lines[name].place)
            self.refuse(_Cell(row, own, name), again)
        elif not reply.empty:
            self.lines[name] = reply

    def turned(
        self, cell: _Cell, text: str, angle: float | None, sense: int | None
    ) -> tuple[str, str, float | None, int | None]:
        """Take a sense, of a vector a side, out of a value and its unit; what its own column says counts first.

        A sense of a vector is noted and passed over, as are senses that contradict one another.
        """
        (bare, of_value), (written, of_unit) = map(cells.split_sense, (text, cell.unit))
        if self.asked.quantities[cell.name].kind == "scalar":
            senses = (of_value | of_unit | {sense}) - {None}
            if len(senses) > 1:
                self.refuse(cell, "answer-senses", self.grid.text(cell.row, cell.column))
                return bare, written, angle, sense
            return bare, written, angle, next(iter(senses), None)
        for whole, rest in ((text, bare), (cell.unit, written)):
            if rest != whole:
                self.refuse(cell, "answer-vector-direction", whole.replace(rest, "", 1).strip(" ,;"))
        if bare[:1] in cells.SIGNS and bare[1:] and not FREE.match(cell.name):
            self.refuse(cell, "answer-vector-direction", bare[:1])
        (bare, side), (written, other) = map(cells.split_side, (bare, written))
        return bare, written, next((x for x in (angle, side, other) if x is not None), None), sense

    def put_in_place(self, place: str) -> None:
        """Exchange segments and values where nearly all lines of a student agree only so; `place` is told of it.

        Of others a line is exchanged alone where its value is of the size of the task's only so, and its scale factor
        would be meant otherwise than on all other lines.
        """
        only = [_only_exchanged(line, self.scales, self.asked) for line in self.lines.values()]
        told = [exchanged for exchanged in only if exchanged is not None]
        if len(told) >= FEWEST and sum(told) >= MOST * len(told):
            self.lines = {name: _in_place(line, self.asked) for name, line in self.lines.items()}
            self.problems.append(LocatedError(place, InputError("answers-swapped")))
            return
        meant = [_meant(line, self.scales, self.asked) for line in self.lines.values()]
        for (name, line), exchanged, way in zip([*self.lines.items()], only, meant, strict=True):
            alone = way is None or (meant.count(way) == 1 and meant.count(1 - way) >= FEWEST - 1)
            instead = _exchanged(line, self.asked)
            if exchanged and alone and apart(instead.value or 0.0, self._size(name)) < CLEAR:
                self.lines[name] = instead
                self.problems.append(LocatedError(line.place, InputError("answers-swapped-line", name=quote(name))))

    def _size(self, name: str) -> float:
        """Return how large a quantity is in the task."""
        return abs(self.asked.quantities[name].value or 0.0)

    def answers(self, source: str, about: Mapping[str, str], columns: tuple[str, ...] = ()) -> Answers:
        """Return what has been read."""
        return Answers(source, Who.of(about), about, self.lines, self.scales, tuple(self.problems), columns)


def _form(grid: Grid, header: int, kinds: Mapping[str, int], asked: Asked) -> Answers:
    """Read a form: what it says of the student, then a row per quantity."""
    about: dict[str, str] = {}
    for row in range(header):
        kind = about_kind(grid.text(row, 0))
        if kind is not None and grid.text(row, 1):
            about.setdefault(kind, grid.text(row, 1))
    sheet = _Sheet(grid, asked)
    columns = {kind: (column, split_unit(grid.text(header, column))[1]) for kind, column in kinds.items()}
    alone = grid.text(header, kinds.get("mm"))  # a header that is itself a unit: "мм"
    if "mm" in kinds and not columns["mm"][1] and cells.of_paper(alone):
        columns["mm"] = kinds["mm"], alone
    for row in range(header + 1, len(grid.rows)):
        _form_row(sheet, row, kinds, columns)
    if not sheet.lines and not sheet.problems:
        raise LocatedError(quote(grid.file, SHOWN), InputError("answers-none"))
    sheet.put_in_place(grid.place(header))
    return sheet.answers(grid.file, about)


def _form_row(sheet: _Sheet, row: int, kinds: Mapping[str, int], columns: Columns) -> None:
    """Read a row of a form; rows with nothing but a name are headings, or have no answer."""
    grid, asked, own = sheet.grid, sheet.asked, kinds["name"]
    text, written, of_value = grid.text(row, own), grid.text(row, kinds.get("unit")), kinds.get("value")
    if tidy(text) in cells.CALCULATIONS:
        sheet.number(_Cell(row, of_value, text))
        return
    name = asked.meant(text)
    filled = any(grid.text(row, kinds.get(part)) not in cells.NONE - {"-"} for part in PARTS)
    if not name or not filled or column_kind(name) == "name" or name in asked.others:
        return
    if name not in asked.names:
        sheet.refuse(_Cell(row, own, name), unknown("quantity-unknown", text, asked.names))
        return
    in_mu = sheet.filled(row, kinds.get("mu"))
    if name in asked.scales:
        sheet.scale(_Cell(row, kinds["mu"] if in_mu else of_value, name, written))
        return
    here = {**columns}
    paper = cells.of_paper(written) and asked.quantities[name].unit != "m"
    if of_value is not None:
        here["value"] = of_value, columns["value"][1] if paper else written or columns["value"][1]
    if paper and of_value is not None and not sheet.filled(row, kinds.get("mm")):
        here["mm"] = of_value, written  # of an arm on the lever
        here.pop("value")
    elif paper and sheet.filled(row, of_value):
        with suppress(InputError):  # both cells may have its millimetres
            both = (kinds["mm"], columns["mm"][1]), (of_value, written)
            if len({cells.segment(grid.text(row, column), own_unit)[0] for column, own_unit in both}) == 1:
                here.pop("value")
    if in_mu and asked.quantities[name].unit.endswith("/mm"):
        # what is asked is a scale factor itself: that it stands in the column of scales makes it no scale of its own
        factor = here.pop("mu")[0]
        if not sheet.filled(row, of_value):
            here["value"] = factor, written or columns.get("value", (0, ""))[1]
    sheet.reply(row, name, here, grid.place(row), own)


def _class(
    grid: Grid,
    header: int,
    columns: Mapping[int, tuple[str, str, str]],
    about: Mapping[str, int],
    asked: Asked,
    warn: Warn | None,
) -> Iterator[Answers]:
    """Go through the students of a class; `columns` hold answers: name, part and unit of each."""
    by_name: dict[str, dict[str, tuple[int, str]]] = {}
    for column, (name, part, written) in columns.items():
        if name not in asked.scales:
            # millimetres over a quantity that is no length are those of paper
            paper = cells.of_paper(written) and asked.quantities[name].unit != "m"
            part = "direction" if part in ("dir", "sense") else part or ("mm" if paper else "value")
        by_name.setdefault(name, {}).setdefault(part, (column, written))
    asked_here = tuple(name for name in by_name if name in asked.quantities)
    strangers, unknown_names = list[LocatedError](), dict[str, None]()
    for column, text in enumerate(grid.rows[header]):  # what looks like a quantity and is none
        lost = (text, "", "") if text.startswith("?_") else None
        of, read = quantity_part(text) or lost, column in columns or column in about.values()
        if of is not None and not read and of[0] not in asked.others | asked.unasked and ("_" in text or of[1]):
            place = f"{grid.place(header, column)}, {quote(text)}"
            strangers.append(LocatedError(place, unknown("quantity-unknown", of[0], asked.names)))
            unknown_names[of[0]] = None
    if len(unknown_names) > len(by_name):
        raise LocatedError(grid.place(header), InputError("answers-other", names=quote(", ".join(unknown_names))))
    if warn is not None:
        for error in (*grid.unread, *strangers):
            warn(error)
    for row, group in grid.students(header):
        if cells.NONE.issuperset(grid.rows[row]):
            continue
        said = {"group": group} if group else {}
        said |= {kind: grid.text(row, column) for kind, column in about.items() if grid.text(row, column)}
        sheet = _Sheet(grid, asked)
        for name, parts in by_name.items():
            first, written = next(iter(parts.values()))
            if name in asked.scales:
                sheet.scale(_Cell(row, first, name, written))
            else:
                sheet.reply(row, name, parts, grid.place(row, min(column for column, _ in parts.values())))
        sheet.put_in_place(grid.place(row))
        if strangers and not warn and sheet.lines:
            sheet.problems[:0], strangers = strangers, []  # told once, not for each student
        yield sheet.answers(grid.place(row), said, asked_here)


# Answers of which segments and values stand in each other's column.

NEAR = 0.05  # part by which a product may differ from what it should be
FEWEST, MOST = 3, 0.8  # lines that must tell, and what part of them that they are exchanged
CLEAR = math.log(3.0)  # by how much nearer to the task's size a value must be


def _in_place(line: Reply, asked: Asked) -> Reply:
    """Return a line exchanged; of a lone number the size tells what it is, for what is calculated has no segment."""
    if line.mm is None or line.value is None:
        own, quantity = unit(asked.unit(line.name)), asked.quantities[line.name]
        lone = line.value if line.mm is None else own.to_si(line.mm)
        if not lone:
            return line
        segment = quantity.mm and own.to_si(quantity.mm)
        if (line.mm is None) is (not segment or apart(lone, quantity.value) <= apart(lone, segment)):
            return line
    return _exchanged(line, asked)


def apart(number: float, other: float | None) -> float:
    """Return the logarithm of the ratio of two magnitudes."""
    return abs(math.log(abs(number / other))) if other else math.inf


def _only_exchanged(line: Reply, scales: Mapping[str, Mu], asked: Asked) -> bool | None:
    """Whether a line with segment, scale and value is right only when exchanged; None where it tells nothing.

    `scales` are the factors that stand in rows of their own, by symbol.
    A scale factor without a unit agrees either way, as value per millimetre and as millimetres per unit: then that
    value is meant which is of the size of the task's.
    """
    quantity = asked.quantities[line.name]
    mu, size = line.factor or scales.get(quantity.scale or ""), abs(quantity.value or 0.0)
    if mu is None or not line.mm or not line.value or not size:
        return None
    ways = line, _exchanged(line, asked)
    agrees, instead = (any(_fitting(x, mu)) for x in ways)
    off, then = (apart(x.value or size, size) for x in ways)
    if agrees is instead and not (agrees and abs(off - then) > CLEAR):
        return None
    return then < off if agrees is instead else instead


def _fitting(line: Reply, mu: Mu) -> list[bool]:
    """Return in which of the ways of a scale factor segment and value agree."""
    mm, value = line.mm or 0.0, abs(line.value or 0.0)
    return [abs(mm * way - value) <= NEAR * value for way in mu.ways]


def _meant(line: Reply, scales: Mapping[str, Mu], asked: Asked) -> int | None:
    """Return in which way a line has its scale factor, as it stands: the first one, the other one, or in neither."""
    mu = line.factor or scales.get(asked.quantities[line.name].scale or "")
    ways = [] if mu is None or not line.mm or not line.value else _fitting(line, mu)
    return ways.index(True) if any(ways) else None


def _exchanged(line: Reply, asked: Asked) -> Reply:
    """Return a line with the two numbers exchanged, each read in the unit of its new column."""
    own = unit(asked.unit(line.name))
    value = None if line.mm is None else own.to_si(line.mm)
    mm = None if line.value is None else abs(own.from_si(line.value))
    return replace(line, mm=mm, value=value, rounded=None)


def read_all(names: Sequence[str], task: str, asked: Asked, warn: Warn | None) -> list[Answers]:
    """Read all answers; a file that cannot be read is told of and has its place, and those beside it are marked.

    Raises
    ------
    InputError
        The only file there is cannot be read, or any where nobody is told; there is none; the source prints no answers.
    """
    inside, found = _found_files(names, task, warn), list[Answers]()
    for file in inside:
        try:
            of_source = file == _printed(task)
            answers = _read_answers(file, asked, PRINTED if of_source else "", warn)
        except InputError as error:
            if warn is None or len(inside) == 1:
                raise
            warn(error)
            answers = [Answers(file, Who(), {}, {}, {}, unread=error)]
        # what a source does not print is not missing
        found += [replace(one, source=PRINTED, columns=tuple(one.lines)) if of_source else one for one in answers]
    return list(_of_students(found))


def _of_students(found: Iterable[Answers]) -> Iterator[Answers]:
    """Go through answers, pages of one student that are on pictures with names alike but for a number together."""
    before: Answers | None = None
    for one in found:
        if before is not None and before.photos and one.photos and stem_of(before.source) == stem_of(one.source):
            groups = together([*before.photos, *one.photos])
            if len(groups) == 1:
                before = replace(before, photos=tuple(groups[0]), about={**one.about, **before.about})
                continue
        if before is not None:
            yield before
        before = one
    if before is not None:
        yield before


def drawn_together(found: Sequence[Answers], owner: Callable[[Answers], object]) -> Iterator[Answers]:
    """Go through answers, drawings of one owner that are numbered as pages are, from 1 on, as one, side by side."""
    pages, first = dict[tuple[Path, str, int], dict[int, Answers]](), dict[int, list[Answers]]()
    for one in found:
        path = Path(one.source)
        numbered = _PAGE.fullmatch(path.stem)
        if one.drawn is not None and numbered:
            alike = path.with_name(numbered[1]), path.suffix, id(owner(one))
            pages.setdefault(alike, {}).setdefault(int(numbered[2]), one)
    for several in pages.values():
        if 1 < len(several) == max(several) <= MOST_PAGES:
            of_one = [several[number] for number in sorted(several)]
            first |= {id(page): of_one if number == 1 else [] for number, page in several.items()}
    for one in found:
        own = first.get(id(one), [one])
        if len(own) > 1:
            drawn = side_by_side([page.drawn for page in own if page.drawn is not None])
            told = InputError("drawing-pages", file=quote(one.source, SHOWN), n=len(own))
            yield replace(one, drawn=drawn, problems=(*one.problems, told))
        elif own:
            yield one


def stem_of(source: str) -> str:
    """Return the name of a file without a number of three digits before it, and the number of a page behind it.

    >>> stem_of("works/007-Koval_Olha-2.jpg")
    'Koval_Olha'
    """
    return re.sub(r"^[0-9]{3}-", "", Path(source).stem).rstrip("0123456789()_- .")


def _found_files(names: Iterable[str], task: str, warn: Warn | None) -> list[str]:
    """Return the files that are meant: files as they are, all answers in a folder, all that a pattern fits.

    What else lies there is told of. The word `printed` means the answers that the source of a bundled task prints.
    """
    found: list[str] = []
    for name in names:
        path, inside = Path(name), [name]
        if name == PRINTED and not path.exists():
            inside = [_printed(task)]
            if not Path(inside[0]).is_file():
                raise InputError("answers-none-printed", task=quote(task))
        elif path.is_dir() or (not path.exists() and glob.has_magic(name)):
            within = map(str, path.iterdir()) if path.is_dir() else glob.glob(name)
            seen = sorted(file for file in within if not Path(file).name.startswith((".", "~$")))
            inside = [file for file in seen if (of := Path(file)).suffix.lower() in SUFFIXES and of.is_file()]
            others = [Path(file).name for file in seen if file not in {*inside}]
            if inside and others and warn:
                listed = {"files": quote(", ".join(others), SHOWN), "known": ", ".join(SUFFIXES)}
                warn(InputError("answers-others", file=quote(name, SHOWN), **listed))
        if not inside:
            raise InputError("answers-nowhere", file=quote(name, SHOWN), known=", ".join(SUFFIXES))
        found += inside
    return list(dict.fromkeys(found))


def _printed(task: str) -> str:
    return str(files(__package__) / "printed" / f"{task}.csv")
