"""The markup of texts on a sheet as a tree, for writers that set it in their own way."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from ..text import Piece, Ruling, read

_WORD = re.compile(r"[^\W\d_]$|(?:^|\d |, )\(?[^\W\d_]+/$")  # a letter at the end, or a unit: 2 m/s²
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
    """Return the parts of a line of markup, scripts with the letters behind which they stand.

    >>> parse("a_{B}")
    (Scripted(base=Plain(text='a'), above=(), below=(Plain(text='B'),)),)
    """
    return _nodes(read(markup))


def _nodes(pieces: Sequence[Piece]) -> tuple[Node, ...]:
    nodes: list[Node] = []
    for piece in pieces:
        if isinstance(piece, str):
            nodes.append(Plain(piece))
        elif isinstance(piece, Ruling):
            nodes.append(Ruled(piece.kind, _nodes(piece.pieces)))
        else:
            base = _base(nodes)
            nodes.append(Scripted(base, _nodes(piece.get("^", ())), _nodes(piece.get("_", ()))))
    return tuple(nodes)


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
