"""The words of forms and reports, and plain text of what a sheet sets with scripts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ...drawing.words import Words
from ...plans.linkages.compound import ACCELERATION, VELOCITY
from ...plans.names import role
from ...scales.packaged import packaged

SYMBOL = re.compile(r"([^\W\d_][′″]*)(?:\^([^\W_]+))?(?:_([^\W_]+(?:,[0-9]+)*))?(?![\w^])")


def texts(language: str) -> dict[str, str]:
    """Return the texts of forms and reports, by key."""
    return packaged(__package__, "texts", language)


def plain(markup: str) -> str:
    """Return markup as plain text.

    >>> plain("a^{n}_{BA}"), plain("h_{21}")
    ('a^n_BA', 'h_21')
    """
    return re.sub(r"[{}]", "", re.sub(r"\\bar\{([^{}]*)\}", r"\1", markup))


def script_runs(text: str) -> Iterator[tuple[str, int]]:
    """Go through text piece by piece, each with its level: 0 on the line, 1 above it, -1 below it.

    >>> list(script_runs("a^n_BA < V_B"))
    [('a', 0), ('n', 1), ('BA', -1), (' < V', 0), ('B', -1)]
    """
    start = 0
    for found in SYMBOL.finditer(text):
        yield text[start : found.end(1)], 0
        yield from ((script, level) for script, level in ((found[2], 1), (found[3], -1)) if script)
        start = found.end()
    if text[start:]:
        yield text[start:], 0


def heads(keys: Iterable[str], language: str) -> tuple[str, ...]:
    """Return words over columns, which all begin small, also those that stand over a part of a report elsewhere."""
    said = texts(language)
    return tuple(said[key][:1].lower() + said[key][1:] for key in keys)


def mistake_texts(language: str) -> dict[str, str]:
    """Return what was done by whoever made a mistake, by its id."""
    return packaged(__package__, "texts", f"mistakes.{language}")


def letter(words: Words, mark: str) -> str:
    """Return the letter of a mark on a plan, its number beside it: s2.

    At a point whose motion is split marks have none of their own.
    """
    name = role(mark)
    if name.plan.kind in (VELOCITY, ACCELERATION):
        return name.of
    return plain(re.sub(r"(?<![A-Z])([a-z]′*)_\{(\d+)\}$", r"\1\2", words.mark(mark)))
