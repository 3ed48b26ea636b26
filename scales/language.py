"""The language of messages: what the user has said, else that of the system."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import pairwise

from .errors import LANGUAGES

VARIABLE = "KULMAN_LANG"
_spoken: ContextVar[str | None] = ContextVar("spoken", default=None)


@contextmanager
def speaking(words: Sequence[str]) -> Iterator[None]:
    """Take the language of messages from the words of a command line, wrong ones too, or from `KULMAN_LANG`.

    >>> with speaking(["solve", "--lang=ru"]): system_language()
    'ru'
    """
    said = [word for before, word in pairwise(words) if before == "--lang"]
    said += [word.partition("=")[2] for word in words if word.startswith("--lang=")]
    known = [word for word in (of_environment(), *map(_plain, said)) if word in LANGUAGES]
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
    for variable in ("LC_ALL", "LC_MESSAGES", "LANG"):
        if os.environ.get(variable):
            name = os.environ[variable]
            break
    else:
        name = _windows_language()
    return name[:2].lower() if name[:2].lower() in LANGUAGES else "en"


def _windows_language() -> str:
    """Return the language in which Windows shows itself to the user; nothing elsewhere."""
    if sys.platform != "win32":
        return ""
    import ctypes
    import locale

    return locale.windows_locale.get(ctypes.windll.kernel32.GetUserDefaultUILanguage(), "")
