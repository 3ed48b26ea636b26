"""The words of forms and reports, and plain text of what a sheet sets with scripts."""

from __future__ import annotations

import re

from ...drawing.words import Words
from ...scales.packaged import packaged

SYMBOL = re.compile(r"([^\W\d_][′″]*)(?:\^([^\W_]+))?(?:_([^\W_]+))?(?![\w^])")


def texts(language: str) -> dict[str, str]:
    """Return the texts of forms and reports, by key."""
    return packaged(__package__, "texts", language)


def plain(markup: str) -> str:
    """Return markup as plain text.

    >>> plain("a^{n}_{BA}"), plain("s_{2}")
    ('a^n_BA', 's2')
    """
    text = re.sub(r"\\bar\{([^{}]*)\}", r"\1", markup)
    text = re.sub(r"(?<![A-Z])([a-z]′*)_\{(\d+)\}$", r"\1\2", text)
    return re.sub(r"[{}]", "", text)


def set_scripts(text: str, raised: str, lowered: str) -> str:
    """Return escaped text with the scripts of its symbols in markup; {} stands for the script.

    >>> set_scripts("a^n_BA &lt; V_B", "<sup>{}</sup>", "<sub>{}</sub>")
    'a<sup>n</sup><sub>BA</sub> &lt; V<sub>B</sub>'
    """

    def written(found: re.Match[str]) -> str:
        letter, above, below = found.groups()
        return letter + (raised.format(above) if above else "") + (lowered.format(below) if below else "")

    return SYMBOL.sub(written, text)


def mistake_texts(language: str) -> dict[str, str]:
    """Return what was done by whoever made a mistake, by its id."""
    return packaged(__package__, "texts", f"mistakes.{language}")


def letter(words: Words, mark: str) -> str:
    """Return the letter of a mark on a plan; at a point whose motion is split marks have none of their own."""
    plan, _, name = mark.rpartition(".")
    return name if plan.startswith(("V_at_", "a_at_")) else plain(words.mark(mark))
