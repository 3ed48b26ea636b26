"""A grid of texts with addresses, as files of cells are read within bounds; what the words over columns mean."""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import takewhile
from pathlib import Path
from typing import Any, TypeAlias

from ...scales.errors import InputError, RowOf, Written
from ...scales.names import GREEK, latin, seen
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged

LARGEST = 20_000_000  # bytes of a file, and of what is unpacked from it: a class of 1000 needs 12
LONGEST, MOST_LETTERS = 32_767, 8_000_000  # characters of a cell, as programs have it, and of all: a class needs 5
MOST_MERGED = 100_000  # rows of ranges of merged cells that are looked at
MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 20_000, 1_000, 270_000
SUFFIXES = (".csv", ".xlsx")
LOOKED_AT = 60  # rows in which the header is looked for
FEWEST = 3  # numbers of columns below a header that are such
LONGEST_HEAD = 300  # characters over a column; what is longer says nothing of one
UNDERSTOOD: Mapping[str, Any] = packaged(__package__, "texts", "understood")
_COLUMN_OF = {word: kind for kind, words in UNDERSTOOD["columns"].items() for word in words}
_ABOUT_OF = {word: kind for kind, words in UNDERSTOOD["about"].items() for word in words}
_ABOUT_LIKE: dict[str, re.Pattern[str]] = {
    kind: re.compile("|".join(words)) for kind, words in UNDERSTOOD["about_like"].items()
}
ORDINALS = frozenset(UNDERSTOOD["ordinals"])  # over the numbers of rows
_COMMA = re.compile("[,:]")  # before a unit without brackets
# a column of a class: a quantity, a part of its answer, a unit
_QUANTITY = re.compile(r"(?P<name>[A-Za-z][\w^{}]*)(?:\.(?P<part>mm|dir|sense|mu))?")
_BEFORE = {
    kind: "|".join(map(re.escape, sorted((*UNDERSTOOD["about"][kind], *more), key=len, reverse=True)))
    for kind, more in UNDERSTOOD["numbered"].items()
}
_NUMBERED = {kind: re.compile(rf"\s*(?:{words})\.?\s*№?\s*", re.IGNORECASE) for kind, words in _BEFORE.items()}
# what stands in a row below a list that sums it up: `Всього: 28`, `Разом студентів – 28`, `Total`
_TOTAL = re.compile(rf"(?:{'|'.join(UNDERSTOOD['totals'])})\b")
_SIGNED = re.compile(rf"(?:{'|'.join(UNDERSTOOD['signed'])})\b")
_TO_SIGN = "__"  # where somebody signs
_LIST = re.compile(rf"(?:{'|'.join(UNDERSTOOD['lists'])})\b", re.IGNORECASE)
_OF_GROUP = rf"\b(?:{'|'.join(UNDERSTOOD['titles'])})\b(?P<ends>\s*[.:№]*)\s*"
_TITLE = re.compile(rf"{_OF_GROUP}(?P<name>.*)", re.IGNORECASE)
_CODED = r"(?:(?-i:[A-ZА-ЯЇІЄҐ]{1,6}) \d{1,4}\w{0,2}|(?=[^\s,;(]*[^\W\d])[^\s,;(]*\d[^\s,;(]*)"  # AT 301, AT-301
_WITHIN = re.compile(rf"{_OF_GROUP}(?P<name>(?:{_CODED}|\d{{1,3}}(?=\s*(?:[,;.(]|$))).*)", re.IGNORECASE)
_BETWEEN_GROUPS = re.compile(rf"(?<!\s)(?:\s*[,;&+]|\s+(?:{'|'.join(UNDERSTOOD['ands'])})(?=\s))\s*", re.IGNORECASE)
_GROUP = re.compile(r"(?:[^\W\d_]{1,6}[-–.]?|[A-ZА-ЯЇІЄҐ]{1,6} )\d{1,4}\w{0,2}|\d{1,3}")
_LETTERS_AND_DIGITS = re.compile(r"^(?=\D*\d)[\W\d]*[^\W\d]")
_BESIDE = frozenset(UNDERSTOOD["beside"])
_NUMBER_WORDS = frozenset(UNDERSTOOD["number_words"])
_NUMBERED_KINDS = ("variant", "book", "group")  # of which "№" before or behind the word says no other thing
MIXED = re.compile(r"[A-Za-z]+_\w+")
_ORNAMENT = re.compile(r"[\s_{}$\\.^]")  # of a symbol: l_OA, l_{OA} and lOA are one


def several_groups(text: str) -> str:
    """Return the groups that a text names where they are several; else nothing.

    >>> several_groups("АТ-301, АТ-302 (денна форма)"), several_groups("АТ-301, осінній семестр")
    ('АТ-301, АТ-302', '')
    """
    first, *others = _BETWEEN_GROUPS.split(text.partition("(")[0].rstrip(" :."))
    more = list(takewhile(_GROUP.fullmatch, others))
    return ", ".join((first, *more)) if more and _LETTERS_AND_DIGITS.search(first) else ""


Merged: TypeAlias = Mapping[int, Sequence[tuple[int, int, int]]]


@dataclass(frozen=True, slots=True)
class Grid:
    """The texts of a file's cells by row.

    `formulas` and `dates` are cells (row, column) with a formula that nobody has worked out, or with a date; `merged`
    are those that are one, by row, from left to right: first and last column, and the row that has the text. `sheets`
    are other worksheets with something in them, which are not read.
    """

    file: str
    rows: tuple[tuple[str, ...], ...]
    formulas: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    dates: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    merged: Merged = field(default_factory=dict)
    sheets: tuple[str, ...] = ()

    def text(self, row: int, column: int | None) -> str:
        """Return what a cell shows, nothing beyond the end of its row."""
        cells = self.rows[row]
        return cells[column] if column is not None and column < len(cells) else ""

    @property
    def unread(self) -> tuple[InputError, ...]:
        """That other worksheets are not read, where there are any."""
        names = Written(", ".join(quote(name, SHOWN) for name in self.sheets))
        return (InputError("sheets-unread", file=quote(Path(self.file).name, SHOWN), sheets=names),) if names else ()

    def totals(self, row: int) -> bool:
        """Tell whether a row below a list of students only sums it up, or is signed: no row of a student's.

        Words may stand in it, then, or numbers, but not both beside one another as of somebody who is called so.
        """
        first, *others = [*filter(None, self.rows[row])] or [""]
        if _TO_SIGN in "".join((first, *others)):
            return True
        if _TOTAL.match(tidy(first)):
            return not any(map(str.isalpha, "".join(others)))
        return _SIGNED.match(tidy(first)) is not None and not any(map(str.isdigit, "".join(others)))

    def title(self, row: int, above: bool = False) -> str:
        """Return the group whose title a row is, `Група АТ-301`, in one cell or two; else nothing.

        In two cells its name has letters and digits, or a colon before it: a student may be called Група, too. It may
        stand within the title of a list in one cell, or in any row `above` all lists, where it has letters and digits.
        """
        cells = [*filter(None, self.rows[row])]
        text = " ".join(" ".join(cells).split())
        if len(text) > LONGEST_HEAD:
            return ""
        found = _TITLE.fullmatch(text) if len(cells) in (1, 2) else None
        if found is not None and len(cells) == 2:
            sure = ":" in found["ends"] or _LETTERS_AND_DIGITS.search(found["name"])
            found = found if sure and found["name"].split() == cells[1].split() else None
        if found is None and (above or (len(cells) == 1 and _LIST.match(text))):
            found = _WITHIN.search(text)
        if found is None:
            return ""
        # what is behind a name is no part of it, unless it is the name of another group
        name, coded = found["name"], re.match(_CODED, found["name"])
        return several_groups(name) or (coded[0] if coded else re.split("[,;(]", name)[0]).strip(' :."«»“”')

    def students(self, header: int) -> Iterator[tuple[int, str]]:
        """Go through the rows of students below a header, each with the group in whose list it stands, if one is named.

        Left out are titles of groups, sums, signatures, numbers of columns, and the header again, as it stands over
        each group.
        """
        group = next(filter(None, (self.title(row, above=True) for row in reversed(range(header)))), "")
        for row in range(header + 1, len(self.rows)):
            if title := self.title(row):
                group = title
            elif any(self.rows[row]) and self.rows[row] != self.rows[header] and not self.totals(row):
                filled = [*filter(None, self.rows[row])]
                if len(filled) < FEWEST or filled != [str(number) for number in range(1, len(filled) + 1)]:
                    yield row, group

    def joined(self, header: int) -> Grid:
        """Return the grid with a header of two rows in one: `Студент` may stand over `Прізвище` and `Ім'я`.

        The lower row has words, each under a head of several columns; wherever both stand over a list they are joined.
        """
        upper, lower = self.rows[header : header + 2] if header + 1 < len(self.rows) else ((), ())
        wide = [column for column, text in enumerate(lower) if text]

        def told(cells: Iterable[str]) -> bool:
            return any(about_kind(text) or MIXED.match(latin(text)) for text in cells)

        under = all(not (self.text(header, column) and self.text(header, column + 1)) for column in wide)
        plain = not any(lower[column][0].isdigit() for column in wide)
        if not (under and plain and told(lower) and told(upper)) or self.title(header):
            return self
        width = max(len(upper), len(lower))
        heads = tuple(self.text(header + 1, column) or self.text(header, column) for column in range(width))
        rows, above = list[tuple[str, ...]](), None
        for cells in self.rows:
            both = above == upper and cells == lower
            if both:
                rows[-1] = heads
            rows.append(() if both else cells)
            above = cells
        return replace(self, rows=tuple(rows))

    def shared(self, row: int, column: int) -> str:
        """Return what a cell shows, within a merged one what that shows."""
        text = self.text(row, column)
        if text or not self.merged:
            return text
        ranges = self.merged.get(row, ())
        at = bisect_right(ranges, (column, MOST_COLUMNS, MOST_ROWS)) - 1
        first, last, top = ranges[at] if at >= 0 else (column, column, row)
        return self.text(top, first) if column <= last else ""

    def place(self, row: int, column: int | None = None, of: str = "") -> str:
        """Return the address of a cell as a spreadsheet shows it, `answers.csv: D12`, or of a row, that `of` a name."""
        file = _shown(self.file)
        if column is not None:
            return Written(f"{file}: {letters(column)}{row + 1}")
        return RowOf(file, f"{row + 1}, {quote(of, SHOWN)}" if of else row + 1)


@cache
def _shown(file: str) -> str:
    return quote(file, SHOWN)


@cache
def letters(column: int) -> str:
    """Return the letters of a column, counted from 0.

    >>> letters(0), letters(25), letters(26)
    ('A', 'Z', 'AA')
    """
    name = ""
    column += 1
    while column:
        column, at = divmod(column - 1, 26)
        name = chr(ord("A") + at) + name
    return name


def by_row(ranges: Iterable[tuple[tuple[int, int], tuple[int, int]]], rows: int) -> Merged:
    """Return ranges of merged cells, given by their first and last ones, as a grid of so many rows has them."""
    found: dict[int, list[tuple[int, int, int]]] = defaultdict(list)
    left = MOST_MERGED
    for (top, first), (bottom, last) in ranges:
        bottom = min(bottom, rows - 1)
        left -= max(bottom - top + 1, 0)
        if left < 0:
            break
        for row in range(top, bottom + 1):
            found[row].append((first, last, top))
    return {row: sorted(spans) for row, spans in found.items()}


def bounded(file: str, rows: list[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return the rows without blank ones at the end and signs that nobody sees; refuse more than a class needs."""
    rows = [row if all(map(str.isprintable, row)) else tuple(seen(text).strip() for text in row) for row in rows]
    while rows and not any(rows[-1]):
        rows.pop()
    if len(rows) > MOST_ROWS or max(map(len, rows), default=0) > MOST_COLUMNS:
        raise too_many_cells(file)
    if not rows:
        raise InputError("answers-empty", file=quote(file, SHOWN))
    return tuple(rows)


def too_many_cells(file: str) -> InputError:
    """Return the error for a file with more rows or columns than any class has."""
    return InputError("answers-cells", file=quote(file, SHOWN), rows=MOST_ROWS, columns=MOST_COLUMNS)


def too_many_texts(file: str) -> InputError:
    """Return the error for a file with more in its cells than any class has."""
    return InputError("answers-many", file=quote(file, SHOWN))


def too_long(file: str, row: int, column: int) -> InputError:
    """Return the error for a cell with a text that belongs in no table."""
    return InputError("answers-long", place=Grid(file, ()).place(row, column), n=LONGEST)


def tidy(text: str) -> str:
    """Return a header word in small letters, with plain spaces and apostrophes."""
    plain = " ".join(re.sub("[’ʼ`´′‘]", "'", text.lower().replace("ё", "е").replace(".", " ")).split())
    return plain.rstrip(":*? ")


def split_unit(text: str) -> tuple[str, str]:
    """Return a header without the unit that stands behind it in brackets or after a comma, and the unit.

    >>> split_unit("V_B [м/с]"), split_unit("відрізок, мм"), split_unit("V_B")
    (('V_B', 'м/с'), ('відрізок', 'мм'), ('V_B', ''))
    """
    text = text.strip()
    opened = -1
    if len(text) > LONGEST_HEAD:
        return text, ""
    if text.endswith("]"):
        opened = text.find("[", text.rfind("]", 0, -1) + 1)
    elif text.endswith(")"):
        opened = text.find("(", text.rfind("\n") + 1)
    if opened >= 0:
        return text[:opened].strip(), text[opened + 1 : -1].strip()
    comma = _COMMA.search(text, max(text.rfind("["), text.rfind("(")) + 1, len(text) - 1)
    return (text, "") if comma is None else (text[: comma.start()].strip(), text[comma.end() :].strip())


def column_kind(text: str) -> str | None:
    """Return what a column of a form holds, by the word over it."""
    return _COLUMN_OF.get(tidy(text)) or _COLUMN_OF.get(tidy(split_unit(text)[0]))


def about_kind(text: str) -> str | None:
    """Return what a cell says of the student, by the word before it or over it."""
    head = split_unit(text)[0]
    return _ABOUT_OF.get(tidy(text)) or _ABOUT_OF.get(tidy(head)) or _about_abbreviated(tidy(head))


def _about_abbreviated(head: str) -> str | None:
    """Return what a column says of whom by its word without initials, or by initials alone: `Фамилия И.О.`, `Ф.И.О.`"""
    if (kind := next((kind for kind, words in _ABOUT_LIKE.items() if words.fullmatch(head)), None)) is not None:
        return kind
    words = ["№" if word in _NUMBER_WORDS else word for word in head.replace("№", " № ").split()]
    if all(len(word) == 1 for word in words):
        return _ABOUT_OF.get("".join(words))
    telling = [word for word in words if len(word) > 1 and word not in _BESIDE]
    kind = _ABOUT_OF.get(telling[0]) if len(telling) == 1 else None
    return kind if kind == "student" or (kind in _NUMBERED_KINDS and words[0] in ("№", telling[0])) else None


def quantity_part(text: str) -> tuple[str, str, str] | None:
    """Return name, part and unit of a class's column; None where it can be no quantity.

    The part is "", "mm", "mu", "dir" or "sense".

    >>> quantity_part("V_B.mm"), quantity_part("ω_2, рад/с"), quantity_part("V_B, напрям"), quantity_part("прізвище")
    (('V_B', 'mm', ''), ('omega_2', '', 'рад/с'), ('V_B', 'dir', ''), None)
    >>> quantity_part("l_CA, відрізок, мм"), quantity_part("l_CA, мм")
    (('l_CA', 'mm', 'мм'), ('l_CA', '', 'мм'))
    """
    head, unit = split_unit(text)
    found = _QUANTITY.fullmatch(latin(head).translate(GREEK))
    if found is None:
        return None
    if not found["part"] and column_kind(unit) == "direction":
        return found["name"], "dir", ""
    word, of_paper = split_unit(unit)
    if not found["part"] and of_paper and column_kind(word) == "mm":
        return found["name"], "mm", of_paper
    return found["name"], found["part"] or "", unit


def symbol(text: str) -> str:
    """Return a symbol as plain letters and digits, however it is written.

    >>> symbol("l_{OA}"), symbol("φ"), symbol("J_{S_2}"), symbol("n₁")
    ('lOA', 'phi', 'JS2', 'n1')
    """
    if len(text) > LONGEST_HEAD:
        return ""
    return latin(_ORNAMENT.sub("", unicodedata.normalize("NFKC", text))).translate(GREEK)


def number_said(text: str, kind: str = "variant") -> str:
    """Return the id of a variant, or the number of a task, without the words before it.

    >>> number_said("Варіант № 7"), number_said("в. 12"), number_said("А3"), number_said("схема 9", "task")
    ('7', '12', 'А3', '9')
    """
    before = _NUMBERED[kind].match(text)
    return text if before is None else text[before.end() :]


def recognised(rows: Sequence[Sequence[str]]) -> int:
    """Return how many cells of the most telling row are headers; to choose a separator by."""
    best = 0
    for row in rows:
        words = [cell for cell in row if cell and not cell[0].isdigit()]  # no header begins with a digit
        kinds = {kind for cell in words if (kind := column_kind(cell))}
        names = {cell for cell in words if MIXED.match(latin(cell.strip()))}
        about = {kind for cell in words if (kind := about_kind(cell))}
        best = max(best, len(kinds | about) + (len(names) if len(row) > 1 else 0))
    return best
