"""The errors everybody raises: a key, the data that explain it, and the exit status they mean; their language."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from copy import copy
from itertools import pairwise
from typing import Any

from .packaged import packaged

LANGUAGES = ("uk", "ru", "en")
VARIABLE = "KULMAN_LANG"
# options, but for those of a command that is named, and what those are called in Python that have another name there
_OPTION = re.compile(r"kulman \w+ [^;:,`]*|(?<![\w-])--([a-z]+(?:-[a-z]+)*)")
ARGUMENTS = {"scale": "scales", "range": "ranges", "from": "table", "to": "end", "as": "kinds", "out": "folder"}
_spoken: ContextVar[str | None] = ContextVar("spoken", default=None)
_DECIMAL = re.compile(r"(?<![\w.=/])(\d+)\.(\d+(?:e[-+]?\d+)?)(?![\w.])")  # no part of a name, a path, a date

_NUMBER = re.compile(r"(-?)(\d+(?:\.\d+)?)(?:e([-+]?\d+))?")
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Written(str):
    """What the user has written or may type: a message leaves it as it is."""

    __slots__ = ()


class Option(Written):
    """An option of a command; in Python another `argument` says the same."""

    __slots__ = ("argument",)
    argument: str

    def __new__(cls, text: str, argument: str) -> Option:
        """Return the option with the name of the argument."""
        option = super().__new__(cls, text)
        option.argument = argument
        return option


class Spoken(str):
    """What a message says in its language."""

    __slots__ = ()

    def said(self, language: str) -> str:
        """Return the words for it in `language`."""
        return str(self)


class RowOf(Spoken):
    """Where a row of a table stands: `class.csv: row 12`; `12, Koval` where a name tells more."""

    __slots__ = ("file", "row")
    file: str
    row: int | str

    def __new__(cls, file: str, row: int | str) -> RowOf:
        """Return the place of a row, counted from 1, of a file as it is shown."""
        place = super().__new__(cls, messages("en")["row-of"].format(file=file, row=row))
        place.file, place.row = file, row
        return place

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what makes it again in another process."""
        return RowOf, (self.file, self.row)

    def said(self, language: str) -> str:
        """Return the words for it in `language`."""
        return messages(language)["row-of"].format(file=self.file, row=self.row)


class Told(Spoken):
    """A text that is written in one language, and can be said in all."""

    __slots__ = ("texts",)
    texts: Mapping[str, str]

    def __new__(cls, texts: Mapping[str, str], language: str) -> Told:
        """Return it as it is written in `language`."""
        told = super().__new__(cls, texts[language])
        told.texts = texts
        return told

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what makes it again in another process."""
        return Told, (self.texts, next(language for language, text in self.texts.items() if text == self))

    def said(self, language: str) -> str:
        """Return it in `language`."""
        return self.texts[language]


def spoken(place: str, language: str) -> str:
    """Return a place in the words of a language."""
    return place.said(language) if isinstance(place, Spoken) else place


def messages(language: str) -> dict[str, str]:
    """Return the templates of all messages in `language`, by key."""
    if language not in LANGUAGES:
        raise InputError("language", language=language, known=", ".join(LANGUAGES))
    return packaged(__package__, "messages", language)


class KulmanError(Exception):
    """A problem that a user can mend: `key` names the message, `data` fills it in.

    Parameters
    ----------
    key : str
        Key of the template in `scales/messages/*.toml`.
    **data
        What the template names: `file`, `row`, `column`, `name`, `expected`, ... Numbers in texts have the decimal
        sign of the language, but for what is `Written`; what is `Spoken` is said in it, a tuple has commas between,
        a list semicolons.
    """

    status = 2

    def __init__(self, key: str, /, **data: Any) -> None:
        super().__init__(key)
        self.key = key
        self.data = data

    def __reduce__(self) -> tuple[Any, ...]:
        """Keep the data when the error crosses to another process."""
        return type(self).__new__, (type(self), *self.args), self.__dict__  # whatever its constructor asks for

    def text(self, language: str = "en") -> str:
        """Return the message as one line in `language`."""
        data = {name: _shown(value, language) for name, value in self.data.items()}
        line = messages(language)[self.key].format(**data)
        return " ".join(line.split())

    def __str__(self) -> str:
        """Return the message in the language of `KULMAN_LANG`, else in English; options as arguments of functions."""
        said, language = copy(self), of_environment()
        said.data = {name: getattr(value, "argument", value) for name, value in self.data.items()}
        line = said.text(language if language in LANGUAGES else "en")

        def spelled(found: re.Match[str]) -> str:
            option: str | None = found[1]
            return found[0] if option is None else ARGUMENTS.get(option, option.replace("-", "_"))

        return _OPTION.sub(spelled, line)

    def __repr__(self) -> str:
        """Return kind and message, as lists of warnings show it."""
        return f"{type(self).__name__}({str(self)!r})" if self.key in messages("en") else super().__repr__()


def _shown(value: object, language: str) -> object:
    """Return a value of a message in a language, with its decimal sign and its units; an error, and several, too."""
    if isinstance(value, KulmanError):
        return value.text(language)
    if isinstance(value, (tuple, list)):
        between = "; " if isinstance(value, list) else ", "
        return between.join(str(_shown(one, language)) for one in value)
    if isinstance(value, Written) or not isinstance(value, (str, float)):
        return value
    if isinstance(value, Spoken):
        return value if language == "en" else value.said(language)
    number = _NUMBER.fullmatch(str(value))
    if number:  # -1.7201e+08 as it is written by hand
        power = f"·10{str(int(number[3])).translate(RAISED)}" if number[3] else ""
        value = f"{'−' if number[1] else ''}{number[2]}{power}"
    return value if language == "en" else _DECIMAL.sub(r"\1,\2", str(value))


class InputError(KulmanError, ValueError):
    """What was asked or given cannot be used; nothing has been written."""


class KeptError(InputError):
    """What would be written takes the place of something that people have made: it is left as it is."""

    status = 4


class StoppedError(KulmanError):
    """Somebody has interrupted long work."""

    status = 130


def as_one(faults: Iterable[KulmanError]) -> KulmanError:
    """Return one error that tells all of the faults, of which there is at least one; a single one is itself."""
    found = [*faults]
    return found[0] if len(found) == 1 else InputError("faults", faults=found)


class UnknownNameError(InputError, KeyError):
    """A mapping has nothing of this name: `solution.get` and `in` know it as the usual error of mappings."""


class PositionError(KulmanError, ArithmeticError):
    """The mechanism has no plan in this position: it is singular or cannot be assembled.

    `status_word` is the status that JSON and batches use, `singular` or `no-assembly`.
    """

    status = 3

    def __init__(self, key: str, /, *, status_word: str, **data: Any) -> None:
        super().__init__(key, **data)
        self.status_word = status_word


@contextmanager
def speaking(words: Sequence[str], usual: str = "") -> Iterator[None]:
    """Take the language of messages from the words of a command line, wrong ones too, `KULMAN_LANG`, or the usual one.

    >>> with speaking(["solve", "--lang=ru"]): system_language()
    'ru'
    """
    said = [word for before, word in pairwise(words) if before == "--lang"]
    said += [word.partition("=")[2] for word in words if word.startswith("--lang=")]
    known = [word for word in (usual, of_environment(), *map(_plain, said)) if word in LANGUAGES]
    token = _spoken.set(known[-1] if known else None)
    try:
        yield
    finally:
        _spoken.reset(token)


def of_environment() -> str:
    """Return what `KULMAN_LANG` says, in small letters; nothing where it is not set."""
    return _plain(os.environ.get(VARIABLE, ""))


def _plain(word: str) -> str:
    return word.strip().lower()


def system_language() -> str:
    """Return the language of messages: what has been said, else that of the system, English for any other."""
    spoken = _spoken.get()
    if spoken is not None:
        return spoken
    name = next(filter(None, map(os.environ.get, ("LC_ALL", "LC_MESSAGES", "LANG"))), "")
    if not name and sys.platform == "win32":  # in which Windows shows itself to the user
        import ctypes
        import locale

        name = locale.windows_locale.get(ctypes.windll.kernel32.GetUserDefaultUILanguage(), "")
    return name[:2].lower() if name[:2].lower() in LANGUAGES else "en"
