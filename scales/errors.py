"""The errors everybody raises: a key, the data that explain it, and the exit status they mean."""

from __future__ import annotations

import re
from typing import Any

from .packaged import packaged

LANGUAGES = ("uk", "ru", "en")
_DECIMAL = re.compile(r"(?<![\w.=/])(\d+)\.(\d+(?:e[-+]?\d+)?)(?![\w.])")  # no part of a name, a path, a date


class Written(str):
    """What the user has written or may type: a message leaves it as it is."""

    __slots__ = ()


def messages(language: str) -> dict[str, str]:
    """Return the templates of all messages in `language`, by key."""
    return packaged(__package__, "messages", language)


class KulmanError(Exception):
    """A problem that a user can mend: `key` names the message, `data` fills it in.

    Parameters
    ----------
    key : str
        Key of the template in `scales/messages/*.toml`.
    **data
        What the template names: `file`, `row`, `column`, `name`, `expected`, ... Numbers in texts have the decimal
        sign of the language, but for what is `Written`.
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
        """Return the message in English."""
        return self.text()


def _shown(value: object, language: str) -> object:
    """Return a value of a message in a language, with its decimal sign; an error, too."""
    if isinstance(value, KulmanError):
        return value.text(language)
    if language == "en" or isinstance(value, Written) or not isinstance(value, (str, float)):
        return value
    return _DECIMAL.sub(r"\1,\2", str(value))


class InputError(KulmanError, ValueError):
    """What was asked or given cannot be used; nothing has been written."""


class PositionError(KulmanError, ArithmeticError):
    """The mechanism has no plan in this position: it is singular or cannot be assembled.

    `status_word` is the status that JSON and batches use, `singular` or `no-assembly`.
    """

    status = 3

    def __init__(self, key: str, /, *, status_word: str, **data: Any) -> None:
        super().__init__(key, **data)
        self.status_word = status_word
