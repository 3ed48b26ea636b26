"""The markup of texts on a sheet as a tree, for writers that set it in their own way."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from ..text import ESCAPED, RULES

_PLAIN = re.compile(r"(?:[^\\{}_^]|\\[\\{}_^]|[_^](?!\{))+")
_WORD = re.compile(r"[^\W\d_]$|(?:^|\d |, )\(?[^\W\d_]+/$")  # a letter at the end, or a unit: 2 m/s²
_ESCAPE = re.compile(r"\\([\\{}_^])")


TIE = "\u00a0"  # a space at which no line ends
_BEFORE_SIGN, _AFTER_NUMBER = re.compile(r" (?=[=≤≥<>] )"), re.compile(r"(?<=\d) (?=\w)")


@dataclass(frozen=True, slots=True)
class Plain:
    """Characters that mean themselves."""

    text: str


@dataclass(frozen=True, slots=True)
class Ruled:
    """A group under a vector bar (`bar`), or over one line or two (`u`, `uu`)."""

    kind: str
    parts: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Scripted:
    """A letter, or a ruled group, with what stands above and below behind it."""

    base: Node
    above: tuple[Node, ...]
    below: tuple[Node, ...]


Node = Plain | Ruled | Scripted


@lru_cache(maxsize=4096)
def parse(markup: str) -> tuple[Node, ...]:
    """Return the parts of a line of markup, which is one that can be drawn.

    >>> parse("a_{B}")
    (Scripted(base=Plain(text='a'), above=(), below=(Plain(text='B'),)),)
    """
    parts, at = _line(markup, 0)
    return parts if at >= len(markup) else (*parts, Plain(markup[at:]))


def _line(markup: str, at: int) -> tuple[tuple[Node, ...], int]:
    """Read up to the end, or to a closing brace."""
    parts: list[Node] = []
    while at < len(markup) and markup[at] != "}":
        if markup[at] in "_^" and markup[at + 1 : at + 2] == "{":
            base = _base(parts)
            found, at = _scripts(markup, at)
            parts.append(Scripted(base, found.get("^", ()), found.get("_", ())))
        elif markup[at] == "\\" and markup[at + 1 : at + 2] not in ESCAPED:
            kind = markup[at + 1 : markup.index("{", at)]
            inner, at = _line(markup, markup.index("{", at) + 1)
            parts.append(Ruled(kind if kind in RULES else "u", inner))
            at += 1
        else:
            plain = _PLAIN.match(markup, at)
            assert plain is not None
            parts.append(Plain(_ESCAPE.sub(r"\1", plain.group())))
            at = plain.end()
    return tuple(parts), at


def _scripts(markup: str, at: int) -> tuple[dict[str, tuple[Node, ...]], int]:
    """Read scripts that stand one over the other."""
    found: dict[str, tuple[Node, ...]] = {}
    while markup[at : at + 1] in ("_", "^") and markup[at + 1 : at + 2] == "{" and markup[at] not in found:
        sign = markup[at]
        found[sign], at = _line(markup, at + 2)
        at += 1
    return found, at


def _base(parts: list[Node]) -> Node:
    """Take from what has been read the letter to which scripts belong, with its primes."""
    if not parts:
        return Plain("")
    last = parts.pop()
    if not isinstance(last, Plain):
        return last
    cut = len(last.text.rstrip("′″'"))
    cut -= bool(re.fullmatch(r"[^\s(]", last.text[cut - 1 : cut]))
    if cut:
        parts.append(Plain(last.text[:cut]))
    return Plain(last.text[cut:])


def letters(markup: str) -> str:
    """Return a line without anything but its characters."""

    def text(node: Node) -> str:
        match node:
            case Plain(text=plain):
                return plain
            case Ruled(parts=parts):
                return "".join(map(text, parts))
            case _:
                return text(node.base) + "".join(map(text, (*node.above, *node.below)))

    return "".join(map(text, parse(markup)))


def printable(text: str) -> str:
    """Return characters that can be seen, and spaces for others, which may turn a line about or end a file.

    >>> printable("a\\u202eb\\x07")
    'a b '
    """
    return text if text.isprintable() else "".join(c if c.isprintable() or c == TIE else " " for c in text)


def tied(text: str) -> str:
    """Return words of which no line ends between a letter and what it is equal to, a number and its unit."""
    return _BEFORE_SIGN.sub(TIE, _AFTER_NUMBER.sub(TIE, text))


def joined(parts: Sequence[Node], place: int) -> bool:
    """Whether a part stands in one word with plain letters, which are upright: the d and the φ of d²s/dφ²."""
    before, after = (parts[near] if 0 <= near < len(parts) else None for near in (place - 1, place + 1))
    if isinstance(before, Plain) and _WORD.search(before.text):
        return True
    return isinstance(after, Plain) and after.text[:1].isalpha()
