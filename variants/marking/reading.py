"""Which files hold answers, and what stands in them: one student's form, or a class, a row per student."""

from __future__ import annotations

import glob
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from typing import TypeVar

from ...plans.marking.answers import FREE
from ...scales.errors import InputError, KulmanError, Written
from ...scales.names import latin, unknown
from ...scales.numbers import SHOWN, quote
from ..roster import Who
from ..spreadsheets.files import read_grid
from ..spreadsheets.grid import LOOKED_AT, SUFFIXES, Grid, about_kind, column_kind, quantity_part, split_unit, tidy
from ..task import LocatedError
from . import cells
from .answers import Answers, Asked, Line, Mu, put_back

NUMBERS = ("mm", "mu", "value")
NO_SEGMENT: tuple[float | None, int] = (None, 0)
Cell = tuple[int, int | None, str]  # row, column, and the quantity to which it is an answer
NO_DIRECTION: tuple[float | None, int | None] = (None, None)
PRINTED = "printed"
T = TypeVar("T")


def read_answers(file: str | Path, asked: Asked, called: str = "") -> list[Answers]:
    """Return the answers that a file holds: of one student, or of a class; `called` is its name in messages.

    Raises
    ------
    InputError
        The file cannot be read, or no row of it says what its columns hold.
    """
    grid = read_grid(file)
    grid = replace(grid, file=called) if called else grid
    for row in range(min(len(grid.rows), LOOKED_AT)):
        kinds = _first(column_kind(text) for text in grid.rows[row])
        if "name" in kinds and kinds.keys() & {*NUMBERS, "direction"}:
            return [_form(grid, row, kinds, asked)]
        columns = _of_class(grid.rows[row], asked)
        if len(columns) > 1 or (columns and any(map(about_kind, grid.rows[row]))):
            return list(_class(grid, row, asked))
    raise InputError("answers-header", file=quote(grid.file, SHOWN))


def _first(kinds: Iterator[str | None]) -> dict[str, int]:
    """Return the first column of each kind."""
    found: dict[str, int] = {}
    for column, kind in enumerate(kinds):
        if kind is not None:
            found.setdefault(kind, column)
    return found


@dataclass(slots=True)
class _Sheet:
    """One student's answers while they are read."""

    grid: Grid
    asked: Asked
    lines: dict[str, Line] = field(default_factory=dict)
    scales: dict[str, Mu] = field(default_factory=dict)
    problems: list[LocatedError] = field(default_factory=list)

    def refuse(self, cell: Cell, error: InputError) -> None:
        """Note what cannot be read, with file, cell and quantity."""
        self.problems.append(LocatedError(f"{self.grid.place(*cell[:2])}, {quote(cell[2])}", error))

    def read(self, cell: Cell, reading: Callable[[], T], otherwise: T) -> T:
        """Return what stands in a cell; note why it cannot be read."""
        try:
            return reading()
        except InputError as error:
            self.refuse(cell, error)
            return otherwise

    def number(self, cell: Cell) -> str:
        """Return the text of a cell that should hold a number, of a calculation its result; note what is wrong."""
        text = self.read(cell, lambda: cells.checked(self.grid, *cell[:2]), "")
        slip = cells.slip_in(text)
        if slip is not None:
            makes = Written(f"{slip.makes:.7g}".replace(".", "," if "," in text else "."))
            self.refuse(cell, InputError("answer-calculation", text=slip.text, makes=makes, written=slip.written))
        return cells.signed(text.rpartition("=")[2].strip())

    def mu(self, cell: Cell, written: str = "") -> Mu | None:
        """Read a scale factor: that of a quantity's plan, or one in a place of its own."""
        text, name = self.number(cell), cell[2]
        if not text:
            return None
        drawn = self.asked.scales.get(name) or self.asked.quantities[name].unit
        shown, paper = self.asked.display.of_scales.unit(drawn), self.asked.display.paper
        units = f"({drawn})/mm", f"({shown})/{paper}"
        return self.read(cell, lambda: cells.scale_factor(text, written, *units), None)

    def scale(self, cell: Cell, written: str) -> None:
        """Keep a scale factor that stands in a place of its own, the first of each name."""
        mu = self.mu(cell, written)
        if mu is not None:
            self.scales.setdefault(cell[2], mu)

    def value(self, cell: Cell, text: str, written: str) -> float | None:
        """Read a value; one with a wrong unit is noted, and taken in the unit of the form."""
        try:
            return cells.value(text, written, cell[2], self.asked) if text else None
        except InputError as error:
            self.refuse(cell, error)
            return cells.bare(text, cell[2], self.asked) if error.key.startswith("unit-") else None

    def direction(self, cell: Cell, answered: bool) -> tuple[float | None, int | None]:
        """Read an angle or a sense; an angle is none that a scalar could have, and a sense none of a vector.

        A dash says that there is no answer where nothing else is `answered` to a vector.
        """
        text, kind = self.grid.text(*cell[:2]), self.asked.quantities[cell[2]].kind
        if text in cells.NONE and (text not in ("-", "–") or (kind == "vector" and not answered)):
            return NO_DIRECTION
        angle, sense = self.read(cell, lambda: cells.direction(text, kind == "vector"), NO_DIRECTION)
        if angle is not None and kind == "scalar":
            self.refuse(cell, InputError("answer-sense", text=quote(text)))
            return NO_DIRECTION
        return angle, sense

    def line(self, row: int, name: str, at: Mapping[str, int], units: Mapping[str, str], place: str) -> Line:
        """Read all that is answered to one question.

        `at` and `units` have by "mm", "mu", "value" and "direction" the columns there are, and the units over them or
        beside.
        """
        of_mm, of_mu, of_value, of_direction = ((row, at.get(kind), name) for kind in (*NUMBERS, "direction"))
        segment, (mm, decimals) = self.number(of_mm), NO_SEGMENT
        if segment:
            mm, decimals = self.read(of_mm, lambda: cells.segment(segment, units.get("mm", "")), NO_SEGMENT)
        answered = any(self.grid.text(row, at.get(kind)) not in cells.NONE for kind in NUMBERS)
        direction, sense = self.direction(of_direction, answered)
        mu = self.mu(of_mu, units.get("mu", ""))
        text, written = self.number(of_value), units.get("value", "")
        if self.asked.quantities[name].kind == "scalar":
            text, written, sense = self.sense(of_value, text, written, sense)
        else:
            text, written, direction = self.side(of_value, text, written, direction)
        value = self.value(of_value, text, written)
        plus = value is not None and text.startswith("+")
        last = None if value is None else cells.rounded(text, value)
        return Line(name, place, mm, decimals, mu, value, direction, sense, plus, last)

    def sense(self, cell: Cell, text: str, written: str, said: int | None) -> tuple[str, str, int | None]:
        """Take the sense out of a value and its unit; that of a column of its own counts where they contradict it."""
        (text, of_value), (written, of_unit) = map(cells.split_sense, (text, written))
        senses = of_value | of_unit | ({said} if said is not None else set())
        if len(senses) > 1:
            self.refuse(cell, InputError("answer-senses", text=quote(self.grid.text(*cell[:2]))))
            return text, written, said
        return text, written, next(iter(senses), None)

    def side(self, cell: Cell, text: str, written: str, said: float | None) -> tuple[str, str, float | None]:
        """Take a side out of a vector's value and its unit, and note a sense; the column of directions counts first."""
        bare = [cells.split_sense(one)[0] for one in (text, written)]
        for one, rest in zip((text, written), bare, strict=True):
            if rest != one:
                words = quote(one.replace(rest, "", 1).strip(" ,;"))
                self.refuse(cell, InputError("answer-vector-direction", text=words))
        sign = bare[0][:1]
        if sign in cells.SIGNS and bare[0][1:] and not FREE.match(cell[2]):
            self.refuse(cell, InputError("answer-vector-direction", text=quote(sign)))
        (text, of_value), (written, of_unit) = map(cells.split_side, bare)
        return text, written, next((angle for angle in (said, of_value, of_unit) if angle is not None), None)

    def add(self, line: Line, row: int, column: int | None) -> None:
        """Keep a line that says anything, the first of each name."""
        if (line.mm, line.value, line.direction, line.sense) == (None,) * 4:
            return
        if line.name in self.lines:
            place = Written(self.lines[line.name].place)
            self.refuse((row, column, line.name), InputError("answer-again", place=place))
            return
        self.lines[line.name] = line

    def answers(self, source: str, about: Mapping[str, str], columns: tuple[str, ...] = ()) -> Answers:
        """Return what has been read."""
        return Answers(source, Who.of(about), about, self.lines, self.scales, tuple(self.problems), columns)


def _form(grid: Grid, header: int, columns: Mapping[str, int], asked: Asked) -> Answers:
    """Read a form: what it says of the student, then a row per quantity."""
    about: dict[str, str] = {}
    for row in range(header):
        kind = about_kind(grid.text(row, 0))
        if kind is not None and grid.text(row, 1):
            about.setdefault(kind, grid.text(row, 1))
    sheet = _Sheet(grid, asked)
    over = {kind: split_unit(grid.text(header, column))[1] for kind, column in columns.items()}
    alone = grid.text(header, columns.get("mm"))  # a header that is itself a unit: "мм"
    over["mm"] = over.get("mm") or (alone if cells.of_paper(alone) else "")
    for row in range(header + 1, len(grid.rows)):
        _form_row(sheet, row, columns, over)
    if not sheet.lines and not sheet.problems:
        raise InputError("answers-none", file=quote(grid.file, SHOWN))
    exchanged = put_back(sheet.lines, sheet.scales, asked)
    if exchanged is not None:
        sheet.lines = exchanged
        sheet.problems.append(LocatedError(grid.place(header), InputError("answers-swapped")))
    return sheet.answers(grid.file, about)


def _form_row(sheet: _Sheet, row: int, columns: Mapping[str, int], over: Mapping[str, str]) -> None:
    """Read a row of a form; rows with nothing but a name are headings, or have no answer."""
    grid = sheet.grid
    if tidy(grid.text(row, columns["name"])) in cells.CALCULATIONS:
        sheet.number((row, columns.get("value"), grid.text(row, columns["name"])))
        return
    name = latin(grid.text(row, columns["name"]))
    filled = [kind for kind in (*NUMBERS, "direction") if grid.text(row, columns.get(kind)) not in cells.NONE - {"-"}]
    if not name or not filled or column_kind(name) == "name" or name in sheet.asked.others:
        return
    if name not in sheet.asked.names:
        sheet.refuse((row, columns["name"], name), unknown("quantity-unknown", name, sheet.asked.names))
        return
    written = grid.text(row, columns.get("unit"))
    scale_at = columns.get("mu") if grid.text(row, columns.get("mu")) not in cells.NONE else None
    if name in sheet.asked.scales:
        sheet.scale((row, columns.get("value") if scale_at is None else scale_at, name), written)
        return
    units = {**over, "value": written or over.get("value", "")}
    if scale_at is not None and sheet.asked.quantities[name].unit.endswith("/mm"):
        # what is asked is a scale factor itself: that it stands in the column of scales makes it no scale of its own
        columns = {kind: at for kind, at in columns.items() if kind != "mu"}
        columns |= {} if grid.text(row, columns.get("value")) not in cells.NONE else {"value": scale_at}
    sheet.add(sheet.line(row, name, columns, units, grid.place(row)), row, columns["name"])


def _of_class(header: tuple[str, ...], asked: Asked) -> dict[int, tuple[str, str, str]]:
    """Return the columns of a class that hold answers: name, part and unit by column."""
    found = {}
    for column, text in enumerate(header):
        part = quantity_part(text)
        if part is not None and part[0] in asked.names:
            found[column] = part
    return found


def _class(grid: Grid, header: int, asked: Asked) -> Iterator[Answers]:
    """Go through the students of a class."""
    columns, about = _of_class(grid.rows[header], asked), _first(about_kind(text) for text in grid.rows[header])
    parts: dict[str, dict[str, tuple[int, str]]] = {}
    for column, (name, part, written) in columns.items():
        parts.setdefault(name, {}).setdefault(_part(asked, name, part, written), (column, written))
    asked_here = tuple(dict.fromkeys(name for name, _, _ in columns.values() if name in asked.quantities))
    strangers = _strangers(grid, header, asked, {*columns, *about.values()})
    for row in range(header + 1, len(grid.rows)):
        if not any(text not in cells.NONE for text in grid.rows[row]):
            continue
        said = {kind: grid.text(row, column) for kind, column in about.items() if grid.text(row, column)}
        sheet = _Sheet(grid, asked, problems=list(strangers))
        strangers = []  # told once, not for each student
        _class_row(sheet, row, parts)
        yield sheet.answers(grid.place(row), said, asked_here)


def _strangers(grid: Grid, header: int, asked: Asked, read: set[int]) -> list[LocatedError]:
    """Return an error for each column whose name looks like a quantity's and is none."""
    found = []
    for column, text in enumerate(grid.rows[header]):
        part = quantity_part(text)
        own = part is not None and part[0] in asked.others
        if column not in read and not own and part is not None and ("_" in text or part[1]):
            error = unknown("quantity-unknown", part[0], asked.names)
            found.append(LocatedError(f"{grid.place(header, column)}, {quote(text)}", error))
    return found


def _class_row(sheet: _Sheet, row: int, parts: Mapping[str, Mapping[str, tuple[int, str]]]) -> None:
    """Read the answers of one student, all parts of each quantity together."""
    for name, at in parts.items():
        if name in sheet.asked.scales:
            column, written = next(iter(at.values()))
            sheet.scale((row, column, name), written)
            continue
        columns = {part: column for part, (column, _) in at.items()}
        units = {part: written for part, (_, written) in at.items()}
        sheet.add(sheet.line(row, name, columns, units, sheet.grid.place(row, min(columns.values()))), row, None)


def _part(asked: Asked, name: str, part: str, written: str) -> str:
    """Return what a column of a class holds: millimetres over a quantity that is no length are those of paper."""
    if part or name in asked.scales:
        return "direction" if part in ("dir", "sense") else part
    return "mm" if cells.of_paper(written) and asked.quantities[name].unit != "m" else "value"


def found_files(names: Sequence[str], task: str = "") -> list[str]:
    """Return the files that are meant: files as they are, all answers in a folder, all that a pattern fits.

    The word `printed` means the answers that the source of a bundled task prints.

    Raises
    ------
    InputError
        A folder or a pattern without answers, or a task whose source prints none.
    """
    found: list[str] = []
    for name in names:
        path = Path(name)
        if name == PRINTED and not path.exists():
            inside = [str(_printed(task))]
            if not _printed(task).is_file():
                raise InputError("answers-none-printed", task=quote(task))
        elif path.is_dir():
            inside = sorted(str(file) for file in path.iterdir() if _is_answers(file))
        elif not path.exists() and glob.has_magic(name):
            inside = sorted(file for file in glob.glob(name) if _is_answers(Path(file)))
        else:
            inside = [name]
        if not inside:
            raise InputError("answers-nowhere", file=quote(name, SHOWN), known=", ".join(SUFFIXES))
        found += inside
    return list(dict.fromkeys(found))


def _printed(task: str) -> Path:
    return Path(str(files(__package__) / "printed" / f"{task}.csv"))


def _is_answers(path: Path) -> bool:
    return path.suffix.lower() in SUFFIXES and path.is_file() and not path.name.startswith((".", "~$"))


def read_all(names: Sequence[str], task: str, asked: Asked, warn: Callable[[KulmanError], None]) -> list[Answers]:
    """Read all answers; a file that cannot be read is told of and has its place, and those beside it are marked.

    Raises
    ------
    InputError
        The only file there is cannot be read.
    """
    inside, found = found_files(names, task), list[Answers]()
    for file in inside:
        try:
            of_source = file == str(_printed(task))
            read = read_answers(file, asked, PRINTED if of_source else "")
        except InputError as error:
            if len(inside) == 1:
                raise
            warn(error)
            found.append(Answers(file, Who(), {}, {}, {}, unread=error))
            continue
        # what a source does not print is not missing
        found += [replace(one, source=PRINTED, columns=tuple(one.lines)) if of_source else one for one in read]
    return found
