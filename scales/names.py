"""Names that are asked for: one that does not exist is refused with the one that was meant."""

from __future__ import annotations

import difflib
import textwrap
from collections.abc import Iterable
from typing import Any

from .errors import InputError
from .numbers import quote

LONGEST = 200  # characters of a list of names in a message


def unknown(key: str, asked: object, known: Iterable[str], **data: Any) -> InputError:
    """Return the error for a name that is not in `known`: with the name that was meant, or with all there are.

    Parameters
    ----------
    key : str
        Message that takes `text` and `known`; the message `key-like` takes `text` and `like`.
    asked : object
        What was asked for; from Python it need not even be a text.
    known : iterable of str
        The names there are.
    """
    names, text = list(known), str(asked)
    like = difflib.get_close_matches(text, names, n=1, cutoff=0.6) if 2 < len(text) < 100 else []
    if like:
        return InputError(f"{key}-like", text=quote(text), like=like[0], **data)
    shown = textwrap.shorten(", ".join(names), LONGEST, placeholder=" …")
    return InputError(key, text=quote(text), known=shown or "—", **data)
