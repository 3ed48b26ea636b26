"""Numerical questions as Moodle imports them: its XML, and GIFT."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from xml.sax.saxutils import escape

HALF = 2.0  # how many tolerances off an answer still gets half


@dataclass(frozen=True, slots=True)
class Question:
    """A numerical question: a name, the text, the right value and by how much an answer may miss."""

    name: str
    text: str
    value: float
    tolerance: float


def gift_bytes(category: str, questions: Iterable[Question]) -> bytes:
    """Return questions as GIFT: an answer that misses by up to twice the tolerance gets half."""
    lines = [f"$CATEGORY: {_gift(category)}", ""]
    for asked in questions:
        right = f"={asked.value:.10g}:{asked.tolerance:.3g}"
        half = f"=%50%{asked.value:.10g}:{HALF * asked.tolerance:.3g}"
        lines += [f"::{_gift(asked.name)}::[plain]{_gift(asked.text)} {{#{right} {half}}}", ""]
    return "\n".join(lines).encode("utf-8")


def _gift(text: str) -> str:
    """Return a text on one line in which nothing is taken for a sign of GIFT."""
    return re.sub(r"([~=#{}:\\])", r"\\\1", " ".join(text.split()))


def xml_bytes(category: str, questions: Iterable[Question]) -> bytes:
    """Return questions as Moodle's XML: an answer that misses by up to twice the tolerance gets half."""
    parts = [
        '<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n',
        f'<question type="category"><category><text>$course$/{_xml(category)}</text></category></question>\n',
        *map(_question, questions),
        "</quiz>\n",
    ]
    return "".join(parts).encode("utf-8")


def _question(asked: Question) -> str:
    answers = "".join(
        f'<answer fraction="{fraction}"><text>{asked.value:.10g}</text>'
        f"<tolerance>{times * asked.tolerance:.3g}</tolerance></answer>"
        for fraction, times in ((100, 1.0), (50, HALF))
    )
    return (
        f'<question type="numerical"><name><text>{_xml(asked.name)}</text></name>'
        f'<questiontext format="plain_text"><text>{_xml(asked.text)}</text></questiontext>{answers}</question>\n'
    )


def _xml(text: str) -> str:
    """Return a text for XML, without characters that it cannot hold."""
    return escape("".join(sign if sign.isprintable() else " " for sign in text))
