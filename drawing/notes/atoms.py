"""A line of an equation in its smallest parts: numbers, names, functions, signs, brackets, units, words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

from .markup import Node, Plain, Scripted, parse
from .omml import node, run, scripted, scripts

_TOKENS = re.compile(
    r"(?P<space>\s+)|(?P<number>\d+(?:[.,]\d+)*[°%]?)|(?P<word>[^\W\d_]+(?:[-’'][^\W\d_]+)*[′″]*)"
    r"|(?P<dot>·)|(?P<stroke>/)|(?P<root>√)|(?P<open>[(\[])|(?P<close>[)\]])|(?P<sign>.)"
)
_FUNCTIONS = frozenset(("sin", "cos", "tg", "ctg", "tan", "cot", "arcsin", "arccos", "arctg", "arctan", "inv", "osc"))
_ROMAN = re.compile(r"[IVX]{2,}")
PAIRS = {"(": ")", "[": "]"}
_NAMED = frozenset("ΔΣ")
_SYMBOL = 2  # letters of a name at most; a longer one is a word, and makes words of its neighbours
_ENDS = frozenset("=+−<>≤≥≈→⊥∥,;:")  # of a unit


@dataclass(frozen=True, slots=True)
class Atom:
    """A part of a line: its kind, its characters, how it is shown, also without its brackets; `above`, `below` it."""

    kind: str
    text: str
    shown: str
    bare: str = ""
    above: str = ""
    below: str = ""

    @property
    def inside(self) -> str:
        """What is shown where nothing else stands, so that brackets say nothing."""
        return self.bare or self.shown


def atoms_of(markup: str) -> list[Atom]:
    """Return the atoms of a line of markup."""
    return _told(_joined(_units(list(_atoms(whole(parse(markup)))))))


def whole(parts: Iterable[Node]) -> tuple[Node, ...]:
    """Give scripts the whole number, function or Roman number before them, not its last sign alone."""
    found: list[Node] = []
    for part in parts:
        before = found[-1] if found else None
        if isinstance(before, Plain) and isinstance(part, Scripted) and isinstance(part.base, Plain):
            kept, taken = _split(before.text, part.base.text)
            found[-1:] = [Plain(kept)] if kept else []
            part = replace(part, base=Plain(taken + part.base.text))
        found.append(part)
    return tuple(found)


def _split(text: str, base: str) -> tuple[str, str]:
    """Split characters into those that stay before a base and those that belong to it."""
    kind = r"[\d.,]*$" if base.isdigit() else r"[A-Za-z]*$"
    match = re.search(kind, text)
    tail = match.group() if match else ""
    belongs = base.isdigit() or tail + base in _FUNCTIONS or _ROMAN.fullmatch(tail + base)
    return (text[: len(text) - len(tail)], tail) if belongs else (text, "")


def _atoms(parts: Iterable[Node]) -> Iterator[Atom]:
    for part in parts:
        match part:
            case Plain(text=text):
                yield from (
                    Atom(str(found.lastgroup), found.group(), _plain(found)) for found in _TOKENS.finditer(text)
                )
            case Scripted(base=Plain(text=text)) if text in PAIRS.values():
                yield Atom("close", text, node(part), "", *scripts(part))
            case Scripted(base=Plain(text=text)) if text in _FUNCTIONS:
                yield Atom("function", text, scripted(run(text, "p"), *scripts(part)))
            case Scripted(base=Plain(text=text)) if text[:1].isdigit():
                yield Atom("number", text, node(part))
            case Scripted(base=Plain(text=text)):
                yield Atom("name", text, node(part), "", *scripts(part))
            case _:
                yield Atom("name", "", node(part))


def _plain(found: re.Match[str]) -> str:
    kind, text = found.lastgroup, found.group()
    if kind == "space":
        return run(" ", "nor")
    letter = kind == "word" and len(text.rstrip("′″")) == 1 and text not in _NAMED
    return run(text, "" if letter or kind == "sign" else "p")


def _units(atoms: list[Atom]) -> list[Atom]:
    """Put what stands behind a number, after a space, into one: its unit."""
    found: list[Atom] = []
    at = 0
    while at < len(atoms):
        found.append(atoms[at])
        at += 1
        starts = [atom.kind for atom in atoms[at - 1 : at + 2]]
        if starts[:2] == ["number", "space"] and starts[2:] in (["word"], ["name"], ["open"]):
            end = _unit_end(atoms, at)
            found.append(Atom("unit", "", "".join(_upright(atom) for atom in atoms[at:end])))
            at = end
    return found


def _unit_end(atoms: list[Atom], at: int) -> int:
    depth = 0
    for place in range(at, len(atoms)):
        atom = atoms[place]
        depth += (atom.kind == "open") - (atom.kind == "close")
        if depth < 0 or (atom.kind == "sign" and atom.text in _ENDS) or (place > at and atom.kind == "space"):
            return place
    return len(atoms)


def _upright(atom: Atom) -> str:
    return scripted(run(atom.text, "nor"), atom.above, atom.below) if atom.kind in ("word", "name") else atom.shown


def _joined(atoms: list[Atom]) -> list[Atom]:
    """Set letters upright that stand in one word with others."""
    found = list(atoms)
    for place, (one, other) in enumerate(pairwise(atoms)):
        both = (one, other)
        if {one.kind, other.kind} == {"word", "name"} and not any(atom.text in ("", *_NAMED) for atom in both):
            found[place : place + 2] = [_straight(atom) for atom in both]
    return found


def _straight(atom: Atom) -> Atom:
    return replace(atom, shown=scripted(run(atom.text, "p"), atom.above, atom.below))


def _told(atoms: list[Atom]) -> list[Atom]:
    """Tell symbols from words: what stands between signs is speech if there is a word in it."""
    found: list[Atom] = []
    for apart, group in groupby(atoms, lambda atom: atom.kind in ("sign", "dot", "stroke", "open", "close", "root")):
        some = list(group)
        if apart:
            found += some
            continue
        speech = any(atom.kind == "word" and _spoken(atom.text) for atom in some)
        found += [_named(atom, speech) if atom.kind == "word" else atom for atom in some]
    return found


def _spoken(text: str) -> bool:
    return text not in _FUNCTIONS and (len(text.rstrip("′″")) > _SYMBOL or "а" <= text[0].lower() <= "ґ")


def _named(atom: Atom, speech: bool) -> Atom:
    if atom.text in _FUNCTIONS:
        return replace(atom, kind="function")
    return replace(atom, kind="prose", shown=run(atom.text, "nor")) if speech else replace(atom, kind="name")
