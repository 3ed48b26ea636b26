"""The roster of a class: who is in it, which task, variant and data each one has, by the record book where it must."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..scales.errors import InputError, UnknownNameError, Written
from ..scales.names import latin, of_kind, unknown, unknown_given
from ..scales.numbers import SHOWN, quote
from .spreadsheets.files import read_grid
from .spreadsheets.grid import (
    LOOKED_AT,
    ORDINALS,
    Grid,
    about_kind,
    number_said,
    quantity_part,
    several_groups,
    split_unit,
    symbol,
    tidy,
)
from .task import NUMBERED, LocatedError, Task

WHO = ("student", "group", "book", "number", "email")
KEYS = ("number", "book", "email", "student")  # by which a student is found, the surest first
GIVEN = ("first", "middle")  # names behind the surname that have columns of their own
NAMED = {*KEYS, "first"}  # columns of which a roster has one
SCHEME, VARIANT, NOTHING = "scheme", "variant", "-"
MEANINGS = (VARIANT, SCHEME, NOTHING)
_MEANT = {"task": SCHEME, "variant": VARIANT}  # by what a column of such a name holds
INITIALS = 3  # letters that may stand for a name
MOST = 9  # digits that have a meaning
_BARS = re.compile(r"[-‐‑–'’ʼ`]")
_COMPOUND = re.compile(rf"\b\w+(?:{_BARS.pattern}\w+)+")
_SHORTENED = re.compile(r"\d[.,]\d*E\+?\d+", re.IGNORECASE)  # 1,23E+11: what a spreadsheet leaves of a long number


@dataclass(frozen=True, slots=True)
class Who:
    """A student as the file, or the roster, names one; what is not said is empty."""

    student: str = ""
    group: str = ""
    book: str = ""
    number: str = ""
    email: str = ""

    @classmethod
    def of(cls, about: Mapping[str, str]) -> Who:
        """Return the student of whom a file says so."""
        said = {key: " ".join(about.get(key, "").split()) for key in (*WHO, *GIVEN)}
        said["student"] = " ".join(filter(None, (said["student"], *map(said.pop, GIVEN))))
        return cls(**said)


@dataclass(frozen=True, slots=True)
class Entry:
    """One student of the roster: the variant, empty where neither row nor record book says it, and other data.

    `problem` is why the row cannot be used, where others can be without it; `task` is the id of the student's task.
    """

    who: Who
    variant: str
    settings: Mapping[str, str]
    place: str
    problem: InputError | None = None
    task: str = ""


@dataclass(frozen=True)
class Roster:
    """The students of a class, in the order of the file; `unread` are the heads of columns that say nothing here.

    Of a class with one task `elsewhere` are the tasks of those who are left out. `sheets` says which worksheets are
    not read.
    """

    entries: tuple[Entry, ...]
    unread: tuple[str, ...] = ()
    elsewhere: tuple[str, ...] = ()
    sheets: tuple[InputError, ...] = ()

    @cached_property
    def _by_key(self) -> Mapping[tuple[str, str], list[Entry]]:
        """The entries by what they are found by."""
        found: dict[tuple[str, str], list[Entry]] = {}
        for entry in self.entries:
            for key in KEYS:
                found.setdefault((key, _folded(getattr(entry.who, key))), []).append(entry)
        return found

    def find(self, who: Who, variant: str = "") -> Entry | None:
        """Return the entry of a student: by number, record book, e-mail or name, whichever is there first.

        Of several the one of the same group, then of the same variant, is meant. A name that nobody has so may be one
        with initials, without a patronymic, or with the surname last.
        """
        for found in self._called(who):
            grouped = [entry for entry in found if _folded(entry.who.group) == _folded(who.group)] or found
            for several in (found, grouped, [entry for entry in grouped if variant and entry.variant == variant]):
                if len(several) == 1:
                    return several[0]
        return None

    def _called(self, who: Who) -> Iterator[list[Entry]]:
        """Go through the entries that a student may be, by each of the ways in turn."""
        for key in KEYS:
            said = _folded(getattr(who, key))
            yield self._by_key.get((key, said), []) if said else []
        yield [one for one in self.entries if _same_person(who.student, one.who.student)]

    def stranger(self, who: Who, source: str) -> InputError:
        """Return why a student, of whom answers come from `source`, is not found: who may be meant, if anybody is."""
        several = next(filter(None, self._called(who)), [])
        if several:
            return InputError("marked-namesakes", text=quote(who.student), students=named(one.who for one in several))
        names = [one.who.student for one in self.entries]
        words = {*map(_folded, who.student.split())}
        alike = [name for name in names if words & {*map(_folded, name.split())}]  # however short: Xu
        if len(alike) == 1:
            return UnknownNameError("marked-stranger-like", text=quote(who.student), like=Written(alike[0]))
        return unknown("marked-stranger", who.student or source, names)


def shared_books(students: Iterable[tuple[Who, str]]) -> Iterator[InputError]:
    """Go through the record books that several students have; one may have a row for each of several tasks."""
    books = dict[str, list[tuple[Who, str]]]()
    for who, task in students:
        books.setdefault(who.book, []).append((who, task))
    for book, several in books.items():
        alone = len({_folded(who.student) for who, _ in several}) == 1
        if book and len(several) > (len({task for _, task in several}) if alone else 1):
            yield InputError("roster-book-twice", text=quote(book), students=named(who for who, _ in several))


def shared_by_mistake(students: Iterable[tuple[Who, object]], possible: int) -> Iterator[InputError]:
    """Go through the works that several students of a class have though each should have an own one.

    That is what `students` come with, a variant with all its data. Where there are fewer `possible` variants than
    students they must share them.
    """
    works = dict[object, list[Who]]()
    for who, work in students:
        works.setdefault(work, []).append(who)
    if len([who for several in works.values() for who in several]) <= possible:
        for work, several in works.items():
            if work and len(several) > 1:
                yield InputError("roster-variant-shared", text=quote(str(work)), students=named(several))


def of_several_groups(students: Iterable[Who]) -> Iterator[InputError]:
    """Go through what is written for a group and names several, of which a student has but one."""
    groups = dict[str, list[Who]]()
    for who in students:
        groups.setdefault(who.group, []).append(who)
    for group, those in groups.items():
        if several_groups(group):
            yield InputError("roster-groups", text=quote(group), students=named(those))


def named(students: Iterable[Who]) -> Written:
    """Return the names of students for a message, namesakes with what tells them apart.

    >>> str(named([Who("Lee", group="A", book="1"), Who("Lee", group="A", book="2"), Who("Kim")]))
    'Lee (1), Lee (2), Kim'
    >>> str(named([Who("Lee"), Who("Lee"), Who(book="7")]))
    'Lee, Lee, 7'
    """
    people, shown = [*students], list[str]()
    for who in people:
        same = [one for one in people if one.student == who.student]
        apart = (
            key for key in ("group", "book", "number", "email") if len({getattr(o, key) for o in same}) == len(same)
        )
        more = getattr(who, next(apart, "student")) if len(same) > 1 else who.student
        shown.append(
            quote(who.student or who.book, SHOWN) + (f" ({quote(more, SHOWN)})" if more != who.student else "")
        )
    return Written(", ".join(shown))


ALPHABETS = {"uk": "абвгґдеєжзиіїйклмнопрстуфхцчшщьюя", "ru": "абвгдеёжзийклмнопрстуфхцчшщъыьэюя"}


def collated(text: str, language: str) -> tuple[tuple[int, str], ...]:
    """Return by what a name is put in its place in the alphabet of a language; letters of others follow.

    >>> sorted(["Ївга", "Йосип", "Ганна", "Ґудзь", "Іван"], key=lambda name: collated(name, "uk"))
    ['Ганна', 'Ґудзь', 'Іван', 'Ївга', 'Йосип']
    """
    alphabet = ALPHABETS.get(language, "")
    return tuple((alphabet.find(letter) if letter in alphabet else 99, letter) for letter in text.casefold())


def _folded(text: str) -> str:
    """Return a name without what people write differently: capitals, apostrophes, dots, spaces."""
    return re.sub(r"[\s.'’ʼ`]+", "", text.casefold().replace("ё", "е"))


def _compound(name: str, other: str) -> str:
    """Return a name with double-barrelled ones and apostrophes as another has them: names of files have lost them."""
    for compound in _COMPOUND.findall(other):
        apart = r"[\s_-]+".join(map(re.escape, _BARS.split(compound)))
        name = re.sub(rf"\b{apart}\b", compound, name, flags=re.IGNORECASE)
    return name


def _same_person(one: str, other: str) -> bool:
    """Whether two names may be one student's: words in any order, or surname and initials, or fewer given names.

    >>> _same_person("Коваль О. І.", "Коваль Ольга"), _same_person("Ольга Коваль", "Коваль Ольга Іванівна")
    (True, True)
    >>> _same_person("Коваль Олег", "Коваль Ольга"), _same_person("Ольга", "Коваль Ольга")
    (False, False)
    >>> _same_person("Мар яненко Анна Марія 6 handout", "Мар'яненко Анна-Марія")
    True
    """
    words = (re.split(r"[\s.]+", _compound(name, of)) for name, of in ((one, other), (other, one)))
    short, whole = sorted(([_folded(word) for word in some if word] for some in words), key=len)
    if len(short) < 2:
        return False
    if {*short} <= {*whole}:
        return True
    pairs = (sorted(pair, key=len) for pair in zip(short[1:], whole[1:], strict=False))
    alike = (a == b or (len(a) <= INITIALS and b.startswith(a)) for a, b in pairs)
    return short[0] == whole[0] and all(alike)


@dataclass(frozen=True, slots=True)
class _Columns:
    """A grid with what its columns hold: `about` of a student, and givens with their units.

    The rows are those `of` one task, of all without it, which then must say which variant a student has; `groups` are
    those of the titles over rows.
    """

    grid: Grid
    about: Mapping[str, int]
    givens: Mapping[int, tuple[str, str]]
    schemes: Schemes
    of: Task | None
    groups: Mapping[int, str]

    @property
    def by_name(self) -> bool:
        """Whether a row names the task that is asked for by its number: then other numbers are other tasks."""
        said = (self.said(row).get("task", "") for row in self.groups) if "task" in self.about else ()
        return self.of is not None and any(_number(text) in _numbers(self.of) for text in said)

    def said(self, row: int) -> dict[str, str]:
        """Return what a row says of the student, the group where it is only said above it, too."""
        said = {kind: self.grid.shared(row, column) for kind, column in self.about.items()}
        return said if said.get("group") else said | {"group": self.groups[row]}

    def other(self, row: int) -> str:
        """Return the other task than the one that is asked for that a student has; nothing where it is that one."""
        said = self.said(row)
        name, book = said.get("task", ""), said.get("book", "")
        try:
            with _located(self, row, "task"):
                found = self.schemes.of(name, book).id
        except InputError as error:  # a task of another class; or a wrong record book, which may be anybody's
            if error.key == "roster-schemes" and not (name and self.by_name):
                raise
            found = name
        return found if self.of and found != self.of.id else ""


def read_roster(file: str | Path, schemes: Task | Schemes, each: bool = False, of: Task | None = None) -> Roster:
    """Read a roster: CSV or XLSX with a column `student`, and `variant`, `record book`, givens such as `phi [deg]`.

    Students of other tasks than that it is read `of` are left out; without one, each must have a task and a variant.
    What is wrong is said with its cell; with `each` a row that is wrong is the problem of its student alone.
    """
    if isinstance(schemes, Task):
        of, schemes = schemes, Schemes((schemes,), numbered=False)
    grid = read_grid(file)
    for header in range(min(len(grid.rows), LOOKED_AT)):
        headed = grid.joined(header)
        if len(headed.rows[header]) > 1 and not NAMED.isdisjoint(map(about_kind, headed.rows[header])):
            grid = headed
            break
    else:
        raise InputError("roster-header", file=quote(grid.file, SHOWN))
    columns = _columns(grid, header, schemes, of)
    others = {row: columns.other(row) for row in columns.groups}

    def read(row: int) -> Entry:
        try:
            return _entry(columns, row)
        except InputError as error:
            if not each:
                raise
            return Entry(Who.of(columns.said(row)), "", {}, grid.place(row), error)

    said = {*columns.about.values(), *columns.givens}
    unsaid = (text for column, text in enumerate(grid.rows[header]) if column not in said)
    unread = (text for text in unsaid if any(map(str.isalpha, text)) and tidy(text) not in ORDINALS)
    entries = (read(row) for row, other in others.items() if not other)
    return Roster(tuple(entries), tuple(unread), tuple(dict.fromkeys(filter(None, others.values()))), grid.unread)


def _columns(grid: Grid, header: int, schemes: Schemes, of: Task | None) -> _Columns:
    """Return what the columns hold, by the words over them."""
    known = tuple(dict.fromkeys(name for task in schemes.tasks for name in task.givens))
    symbols = {symbol(name): name for name in known}
    about: dict[str, int] = {}
    givens: dict[int, tuple[str, str]] = {}
    for column, text in enumerate(grid.rows[header]):
        kind, part, (head, unit) = about_kind(text), quantity_part(text), split_unit(text)
        if kind is not None:
            about.setdefault(kind, column)
        elif symbol(head) in symbols:
            givens[column] = (symbols[symbol(head)], unit)
        elif part is not None and "_" in text:
            error = unknown_given(part[0], known, ", ".join(schemes.ids))
            raise LocatedError(grid.place(header, column), error)
    return _Columns(grid, about, givens, schemes, of, dict(grid.students(header)))


def _entry(columns: _Columns, row: int) -> Entry:
    """Read one student."""
    said = columns.said(row)
    who, schemes = Who.of(said), columns.schemes
    with _located(columns, row, "task"):
        task = schemes.of(said.get("task", ""), who.book)
    variant = said.get("variant", "")
    with _located(columns, row, "variant"):
        if variant:
            variant = task.variant(variant).id
        elif who.book:
            variant = variant_of_book(task, who.book, schemes.digits_of(said.get("task", "")))
        if not variant and columns.of is None:
            raise InputError("batch-no-variant", known=quote(", ".join(task.variants), SHOWN))
    settings = dict(_settings(columns, row, task))
    return Entry(who, variant, settings, columns.grid.place(row), task=task.id)


@contextmanager
def _located(columns: _Columns, row: int, kind: str) -> Iterator[None]:
    """Say with a problem in which cell it is: that of `kind`, of the record book where it is empty, or whose row."""
    grid, about, said = columns.grid, columns.about, columns.said(row)
    try:
        yield
    except InputError as problem:
        column = next((about[one] for one in (kind, "book") if said.get(one)), None)
        raise LocatedError(grid.place(row, column, Who.of(said).student), problem) from problem


def _settings(columns: _Columns, row: int, task: Task) -> Iterator[tuple[str, str]]:
    """Go through the data that a student has alone."""
    for column, (name, unit) in columns.givens.items():
        text = columns.grid.text(row, column)
        if not text:
            continue
        value = f"{text} {unit}" if unit and re.fullmatch(r"[-−+0-9.,\s]+", text) else text
        try:
            if name not in task.givens:
                raise unknown_given(name, task.givens, task.id)
            task.givens[name].read(value)
        except InputError as error:
            raise LocatedError(f"{columns.grid.place(row, column)}, {name}", error) from error
        yield name, value


@dataclass(frozen=True, slots=True)
class Digits:
    """What each of the last digits of a record book is for, from left to right; digits of one meaning are one number.

    >>> Digits.of("variant,scheme").number("scheme", "АТ-2023/417")
    7
    >>> Digits.of(2).number("variant", "АТ-2023/417")
    17
    """

    meanings: tuple[str, ...]

    @classmethod
    def of(cls, said: int | str) -> Digits:
        """Return what is meant by a number of digits for the variant, or by words such as `variant,scheme`.

        The words may be those over the columns of a roster, in any language.
        """
        of_kind("digits", said, (int, str), "int | str")
        words = [_MEANT.get(about_kind(word) or "", word.strip().lower()) for word in str(said).split(",")]
        if len(words) == 1 and re.fullmatch("[0-9]{1,9}", words[0]):
            words = [VARIANT] * min(int(words[0]), MOST + 1)
        for word in words:
            if word not in MEANINGS:
                raise InputError("digits-word", text=quote(word), known=", ".join(MEANINGS))
        if not 1 <= len(words) <= MOST:
            raise InputError("digits-number", n=MOST)
        return cls(tuple(words))

    def number(self, meaning: str, book: str) -> int | None:
        """Return the number that a record book has for a scheme or a variant; None where no digit is for that."""
        if meaning not in self.meanings:
            return None
        if _SHORTENED.fullmatch(book.strip()):
            raise InputError("roster-book-shortened", text=quote(book))
        whole = NUMBERED.fullmatch(book.strip())
        found = re.sub(r"\D", "", latin(whole[2] if whole else book))[-len(self.meanings) :]
        if len(found) < len(self.meanings):
            raise InputError("roster-book", text=quote(book), n=len(self.meanings))
        return int("".join(digit for digit, what in zip(found, self.meanings, strict=True) if what == meaning))

    def top(self, meaning: str) -> int:
        """Return what zeros alone stand for where counting begins at one: 10 of one digit, 100 of two."""
        return int(10 ** self.meanings.count(meaning))


def variant_of_book(task: Task, book: str, digits: int | str | Digits = 1) -> str:
    """Return the variant by the last digits of a record book: the one of this number, else counted round.

    Where no variant is numbered 0, zeros are the tenth, of two digits the hundredth.

    >>> from kulman import load_task
    >>> variant_of_book(load_task("nau-slider-crank"), "АТ-2023/417")
    '7'
    """
    meant = digits if isinstance(digits, Digits) else Digits.of(digits)
    number = meant.number(VARIANT, book)
    if number is None:
        return ""
    names = task.numbered or dict(enumerate(task.variants, 1))
    if number not in names:
        number = number or meant.top(VARIANT)
    order = list(names.values())
    return names.get(number) or order[(number - (0 not in names)) % len(order)]


def _number(said: str) -> int | None:
    """Return the number by which a roster names a task, `9`, `№ 9`, `схема 9`; None where it is no number."""
    found = NUMBERED.fullmatch(number_said(said, "task").strip())
    return int(found[2]) if found is not None and not found[1] else None


def _numbers(task: Task) -> list[int]:
    """Return the numbers in the name of a task; where it has none, that which its file says."""
    return [*map(int, re.findall(r"\d+", task.id))] or [*filter(None, [task.number])]


@dataclass(frozen=True, slots=True)
class Schemes:
    """The tasks of a class, and how a record book chooses one of them, of which the first is scheme 1.

    In a roster the number of a task is that in its name, or of its file, else its place. Without `digits` the last one
    is the variant; of several tasks, where a student's is not named, the last but one, and the last is the scheme.
    Where they are not `numbered`, nothing but its name tells which one a student has.
    """

    tasks: tuple[Task, ...]
    digits: Digits | None = None
    numbered: bool = True

    def of(self, said: str, book: str) -> Task:
        """Return the task that a roster names by id or number, else that of the record book, else the only one."""
        digits, told = self.digits_of(said), {task.id: task for task in self.tasks}
        if said.strip() in told:
            return told[said.strip()]
        place = _number(said)
        if place is not None:
            named = [task for task in told.values() if place in _numbers(task)]
            if not named and self.numbered:
                named = [*self.tasks[place - 1 : place]]
            if len(named) == 1:
                return named[0]
        if not self.numbered and (place is not None if said else SCHEME in digits.meanings):
            raise InputError("roster-schemes")
        if said:
            raise unknown("task-other", said, self.ids)
        scheme = digits.number(SCHEME, book) if book else None
        if scheme is not None:
            scheme = scheme or digits.top(SCHEME)
            if scheme > len(self.tasks):
                raise InputError("roster-scheme", text=quote(book), number=scheme, n=len(self.tasks))
            return self.tasks[scheme - 1]
        if len(ids := self.ids) > 1:
            raise InputError("batch-no-task", known=quote(", ".join(ids), SHOWN))
        return self.tasks[0]

    def digits_of(self, said: str) -> Digits:
        """Return what the digits of a record book are for, where a roster has `said` so of the task."""
        return self.digits or Digits.of(VARIANT if said or len(self.tasks) == 1 else f"{VARIANT},{SCHEME}")

    @property
    def ids(self) -> Sequence[str]:
        """The ids of the tasks, each once."""
        return tuple(dict.fromkeys(task.id for task in self.tasks))
