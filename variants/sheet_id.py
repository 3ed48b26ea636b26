"""The id of a sheet: a few characters that say for which task, variant and data it was drawn.

It stands on the sheet, is asked for in the form, and shows at once that a student has solved another variant.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping

from ..scales.names import latin
from .task import Task

LETTERS = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"  # of base 32 without I, L, O, U, which are misread
LENGTH = 6
_MISREAD = str.maketrans({"O": "0", "I": "1", "L": "1", "І": "1", " ": None, "-": None, "–": None, "−": None})


def sheet_id(task: Task, variant: str, settings: Mapping[str, str | float] | None = None) -> str:
    """Return the id of the sheet of a variant with its data, such as `3F7-K2M`; the same data give the same id.

    Raises
    ------
    InputError
        An unknown variant or given.
    """
    data = {
        name: value if isinstance(value, str) else f"{value:.9e}"
        for name, value in task.resolve(variant, settings).items()
    }
    text = json.dumps([task.id, variant, data], ensure_ascii=True, sort_keys=True)
    number = int.from_bytes(hashlib.blake2s(text.encode("ascii"), digest_size=8).digest(), "big")
    letters = ""
    for _ in range(LENGTH):
        number, at = divmod(number, len(LETTERS))
        letters += LETTERS[at]
    return f"{letters[:3]}-{letters[3:]}"


def same_id(written: str, right: str) -> bool:
    """Tell whether a student has copied an id, letters that are easily misread counting as one."""
    return _plain(written) == _plain(right)


def _plain(text: str) -> str:
    return latin(text.strip().upper()).translate(_MISREAD)


def variant_of_id(task: Task, written: str) -> str | None:
    """Return the variant of a task, with its own data, to which an id belongs."""
    return next((name for name in task.variants if same_id(written, sheet_id(task, name))), None)
