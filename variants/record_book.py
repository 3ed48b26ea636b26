"""What the last digits of a record book give: the scheme that is drawn, the column of its table of data."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..scales.arguments import of_kind
from ..scales.errors import InputError
from ..scales.names import latin, unknown
from ..scales.numbers import SHOWN, quote
from .spreadsheets.headers import about_kind
from .task import Task

SCHEME, VARIANT, NOTHING = "scheme", "variant", "-"
MEANINGS = (VARIANT, SCHEME, NOTHING)
_MEANT = {"task": SCHEME, "variant": VARIANT}  # by what a column of such a name holds
MOST = 9  # digits that have a meaning
_SHORTENED = re.compile(r"\d[.,]\d*E\+?\d+", re.IGNORECASE)  # 1,23E+11: what a spreadsheet leaves of a long number
_FLOAT = re.compile(r"(\d+)[.,]0")  # 417.0: what a table of numbers makes of 417


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

        Raises
        ------
        InputError
            No such number, or another word.
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
        """Return the number that a record book has for a scheme or a variant; None where no digit is for that.

        Raises
        ------
        InputError
            The record book has too few digits, or is no longer whole.
        """
        if meaning not in self.meanings:
            return None
        if _SHORTENED.fullmatch(book.strip()):
            raise InputError("roster-book-shortened", text=quote(book))
        whole = _FLOAT.fullmatch(book.strip())
        found = re.sub(r"\D", "", latin(whole[1] if whole else book))[-len(self.meanings) :]
        if len(found) < len(self.meanings):
            raise InputError("roster-book", text=quote(book), n=len(self.meanings))
        return int("".join(digit for digit, what in zip(found, self.meanings, strict=True) if what == meaning))

    def top(self, meaning: str) -> int:
        """Return what zeros alone stand for where counting begins at one: 10 of one digit, 100 of two."""
        return int(10 ** self.meanings.count(meaning))


def variant_of_book(task: Task, book: str, digits: int | str = 1) -> str:
    """Return the variant by the last digits of a record book: the one of this number, else counted round.

    Where no variant is numbered 0, zeros are the tenth, of two digits the hundredth.

    Raises
    ------
    InputError
        The record book has no such digits, or they give no variant.

    >>> from kulman import load_task
    >>> variant_of_book(load_task("nau-slider-crank"), "АТ-2023/417")
    '7'
    """
    return _variant(task, book, Digits.of(digits))


def _variant(task: Task, book: str, meant: Digits) -> str:
    number = meant.number(VARIANT, book)
    if number is None:
        return ""
    names = _numbered(task.variants) or dict(enumerate(task.variants, 1))
    if number not in names:
        number = number or meant.top(VARIANT)
    order = list(names.values())
    return names.get(number) or order[(number - (0 not in names)) % len(order)]


def _numbered(variants: Mapping[str, object]) -> dict[int, str]:
    """Return the variants by the one number in the id of each, `7`, `V07`; those without one are left out."""
    found: dict[int, str] = {}
    for name in variants:
        number = re.fullmatch(r"[^\W\d]*(\d{1,9})", name)
        if number is not None:
            found.setdefault(int(number[1]), name)
    return found


@dataclass(frozen=True, slots=True)
class Schemes:
    """The tasks of a class, the first of which is scheme 1, and how a record book chooses one of them."""

    tasks: tuple[Task, ...]
    digits: Digits

    def of(self, said: str, book: str) -> Task:
        """Return the task that a roster names by id or number, else that of the record book, else the only one.

        Raises
        ------
        InputError
            There is no such task, or nothing says which.
        """
        if said:
            return self._named(said)
        number = self.digits.number(SCHEME, book) if book else None
        if number is not None:
            number = number or self.digits.top(SCHEME)
            if number > len(self.tasks):
                raise InputError("roster-scheme", text=quote(book), number=number, n=len(self.tasks))
            return self.tasks[number - 1]
        if len(ids := self.ids) > 1:
            raise InputError("batch-no-task", known=quote(", ".join(ids), SHOWN))
        return self.tasks[0]

    def variant_of(self, task: Task, said: str, book: str) -> str:
        """Return the variant that a roster names, else that of the record book.

        Raises
        ------
        InputError
            There is no such variant, or nothing says which.
        """
        if said:
            return task.variant(said).id
        found = _variant(task, book, self.digits) if book else ""
        if not found:
            raise InputError("batch-no-variant", known=quote(", ".join(task.variants), SHOWN))
        return found

    @property
    def ids(self) -> Sequence[str]:
        """The ids of the tasks, each once."""
        return tuple(dict.fromkeys(task.id for task in self.tasks))

    def _named(self, said: str) -> Task:
        for number, task in enumerate(self.tasks, 1):
            if said.strip() in (task.id, str(number)):
                return task
        raise unknown("task-other", said, self.ids)
