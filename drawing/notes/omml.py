"""The mathematics of a note in OMML, the equations of word processors: scripts, bars, and equations built up.

An equation is parted into atoms: numbers, names, functions, signs, brackets, units, words. Then quotients become
fractions, roots are drawn, brackets are as high as what they hold; not so units. What stands in line, `a·b/c·d`, reads
from left to right: the product before a stroke is divided by the factor behind.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

from .blocks import Node, Plain, Ruled, Scripted, parse, printable

_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})
_EMPTY = "\u200b"  # an argument without a character would be shown as a box to fill in
_TOKENS = re.compile(
    r"(?P<space>\s+)|(?P<number>\d+(?:[.,]\d+)*[°%]?)|(?P<word>[^\W\d_]+(?:[-’'][^\W\d_]+)*[′″]*)"
    r"|(?P<dot>·)|(?P<stroke>/)|(?P<root>√)|(?P<open>[(\[])|(?P<close>[)\]])|(?P<sign>.)"
)
_FUNCTIONS = frozenset(("sin", "cos", "tg", "ctg", "tan", "cot", "arcsin", "arccos", "arctg", "arctan", "inv"))
_ROMAN = re.compile(r"[IVX]{2,}")
PAIRS = {"(": ")", "[": "]"}
_NAMED = frozenset("ΔΣ")
_SYMBOL = 2  # letters of a name at most; a longer one is a word, and makes words of its neighbours
_ENDS = frozenset("=+−<>≤≥≈→⊥∥,;:")  # of a unit
# Forms: a line over a formula (`top`) or under it (`bot`), a quotient, a root, brackets as high as what they hold, and
# scripts by whether any stand above and below.
_BAR = '<m:bar><m:barPr><m:pos m:val="{place}"/></m:barPr><m:e>{inner}</m:e></m:bar>'
_FRACTION = "<m:f><m:num>{above}</m:num><m:den>{below}</m:den></m:f>"
_ROOT = '<m:rad><m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/><m:e>{inner}</m:e></m:rad>'
_BRACKETED = '<m:d><m:dPr><m:begChr m:val="{open}"/><m:endChr m:val="{close}"/></m:dPr><m:e>{inner}</m:e></m:d>'
_SCRIPTS = {
    (False, False): "{base}",
    (True, False): "<m:sSup><m:e>{base}</m:e><m:sup>{above}</m:sup></m:sSup>",
    (False, True): "<m:sSub><m:e>{base}</m:e><m:sub>{below}</m:sub></m:sSub>",
    (True, True): "<m:sSubSup><m:e>{base}</m:e><m:sub>{below}</m:sub><m:sup>{above}</m:sup></m:sSubSup>",
}


def quoted(text: str) -> str:
    """Return characters as XML allows them, in an attribute or in an element."""
    return printable(text).translate(_ENTITIES)


def _run(text: str, style: str = "") -> str:
    """Return characters within a formula: in italics, or plain (`p`), or as words outside mathematics (`nor`)."""
    looks = {"": "", "p": '<m:rPr><m:sty m:val="p"/></m:rPr>', "nor": "<m:rPr><m:nor/></m:rPr>"}[style]
    return f'<m:r>{looks}<m:t xml:space="preserve">{quoted(text)}</m:t></m:r>'


def node(found: Node, upright: bool = False) -> str:
    """Return a part of a formula; a letter alone is slanted, unless it is `upright`."""
    if isinstance(found, Plain):
        if upright or not found.text:
            return _run(found.text or _EMPTY, "p")
        return _run(found.text) if len(found.text) == 1 else _script(found)
    if isinstance(found, Ruled):
        inner = "".join(map(node, found.parts)) or _run(_EMPTY, "p")
        once = _BAR.format(place="top" if found.kind == "bar" else "bot", inner=inner)
        return _BAR.format(place="bot", inner=once) if found.kind == "uu" else once
    return _scripted(node(found.base, upright), *_scripts(found))


def _scripts(found: Scripted) -> tuple[str, str]:
    """Return what stands above and below behind a letter."""
    above, below = ("".join(map(_script, parts)) for parts in (found.above, found.below))
    return above, below


def _script(found: Node) -> str:
    """Return a part of a script, whose letters are names, not quantities: plain, or words as words."""
    if isinstance(found, Plain):
        return _run(found.text, "nor" if any(c.isspace() for c in found.text) else "p")
    return node(found)


def _scripted(base: str, above: str, below: str) -> str:
    """Return a formula with what stands above and below behind it."""
    return _SCRIPTS[bool(above), bool(below)].format(base=base, above=above, below=below)


@dataclass(frozen=True, slots=True)
class _Atom:
    """A part of a line: its kind, its characters, how it is shown, also without its brackets, its scripts."""

    kind: str
    text: str
    shown: str
    bare: str = ""
    scripts: tuple[str, str] = ("", "")

    @property
    def inside(self) -> str:
        """What is shown where nothing else stands, so that brackets say nothing."""
        return self.bare or self.shown


def _atoms_of(markup: str) -> list[_Atom]:
    """Return the atoms of a line of markup."""
    return _told(_joined(_units(list(_atoms(whole(parse(markup)))))))


def whole(parts: Iterable[Node]) -> tuple[Node, ...]:
    """Give scripts the whole number, function or Roman number before them, not its last sign alone."""
    found: list[Node] = []
    for part in parts:
        before = found[-1] if found else None
        if isinstance(before, Plain) and isinstance(part, Scripted) and isinstance(part.base, Plain):
            base = part.base.text
            match = re.search(r"[\d.,]*$" if base.isdigit() else r"[A-Za-z]*$", before.text)
            tail = match.group() if match else ""
            if base.isdigit() or tail + base in _FUNCTIONS or _ROMAN.fullmatch(tail + base):
                kept = before.text.removesuffix(tail)
                found[-1:] = [Plain(kept)] if kept else []
                part = replace(part, base=Plain(tail + base))
        found.append(part)
    return tuple(found)


def _atoms(parts: Iterable[Node]) -> Iterator[_Atom]:
    for part in parts:
        match part:
            case Plain(text=text):
                yield from (
                    _Atom(str(found.lastgroup), found.group(), _plain(found)) for found in _TOKENS.finditer(text)
                )
            case Scripted(base=Plain(text=text)) if text in PAIRS.values():
                yield _Atom("close", text, node(part), "", _scripts(part))
            case Scripted(base=Plain(text=text)) if text in _FUNCTIONS:
                yield _Atom("function", text, _scripted(_run(text, "p"), *_scripts(part)))
            case Scripted(base=Plain(text=text)) if text[:1].isdigit():
                yield _Atom("number", text, node(part))
            case Scripted(base=Plain(text=text)):
                yield _Atom("name", text, node(part), "", _scripts(part))
            case _:
                yield _Atom("name", "", node(part))


def _plain(found: re.Match[str]) -> str:
    kind, text = found.lastgroup, found.group()
    if kind == "space":
        return _run(" ", "nor")
    letter = kind == "word" and len(text.rstrip("′″")) == 1 and text not in _NAMED
    return _run(text, "" if letter or kind == "sign" else "p")


def _units(atoms: list[_Atom]) -> list[_Atom]:
    """Put what stands behind a number, after a space, into one: its unit."""
    found: list[_Atom] = []
    at = 0
    while at < len(atoms):
        found.append(atoms[at])
        at += 1
        starts = [atom.kind for atom in atoms[at - 1 : at + 2]]
        if starts[:2] == ["number", "space"] and starts[2:] in (["word"], ["name"], ["open"]):
            end = _unit_end(atoms, at)
            found.append(_Atom("unit", "", "".join(_upright(atom) for atom in atoms[at:end])))
            at = end
    return found


def _unit_end(atoms: list[_Atom], at: int) -> int:
    depth = 0
    for place in range(at, len(atoms)):
        atom = atoms[place]
        depth += (atom.kind == "open") - (atom.kind == "close")
        if depth < 0 or (atom.kind == "sign" and atom.text in _ENDS) or (place > at and atom.kind == "space"):
            return place
    return len(atoms)


def _upright(atom: _Atom) -> str:
    return _scripted(_run(atom.text, "nor"), *atom.scripts) if atom.kind in ("word", "name") else atom.shown


def _joined(atoms: list[_Atom]) -> list[_Atom]:
    """Set letters upright that stand in one word with others."""
    found = list(atoms)
    for place, (one, other) in enumerate(pairwise(atoms)):
        both = (one, other)
        if {one.kind, other.kind} == {"word", "name"} and not any(atom.text in ("", *_NAMED) for atom in both):
            found[place : place + 2] = [
                replace(atom, shown=_scripted(_run(atom.text, "p"), *atom.scripts)) for atom in both
            ]
    return found


def _told(atoms: list[_Atom]) -> list[_Atom]:
    """Tell symbols from words: what stands between signs is speech if there is a word in it."""
    found: list[_Atom] = []
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


def _named(atom: _Atom, speech: bool) -> _Atom:
    if atom.text in _FUNCTIONS:
        return replace(atom, kind="function")
    return replace(atom, kind="prose", shown=_run(atom.text, "nor")) if speech else replace(atom, kind="name")


def built_up(markup: str) -> str:
    """Return a line of markup as the inside of a formula.

    >>> "<m:f>" in built_up("v = s/t"), "<m:f>" in built_up("2 m/s")
    (True, False)
    """
    found: list[_Atom] = []
    opened: list[int] = []
    for atom in _atoms_of(markup):  # what stands in brackets first
        if atom.kind == "close" and opened and PAIRS[found[opened[-1]].text] == atom.text:
            start = opened.pop()
            inner = _line(found[start + 1 :])
            shown = _scripted(_BRACKETED.format(open=found[start].text, close=atom.text, inner=inner), *atom.scripts)
            found[start:] = [_Atom("name", "", shown, "" if any(atom.scripts) else inner)]
            continue
        if atom.kind == "open":
            opened.append(len(found))
        found.append(atom)
    return _line(found)


def _line(atoms: list[_Atom]) -> str:
    """Return atoms without brackets to look for, their quotients built up."""
    found: list[_Atom] = []
    product: list[_Atom] = []
    factors = _factors(_spaced(atoms))
    for place, atom in enumerate(factors):
        after = factors[place + 1].kind if place + 1 < len(factors) else ""
        if product and product[-1].kind == "stroke" and atom.kind == "factor":
            above = product[0].inside if len(product) == 2 else "".join(part.shown for part in product[:-1])
            product = [_Atom("factor", "", _FRACTION.format(above=above, below=atom.inside))]
        elif atom.kind == "factor" or (product and atom.kind in ("dot", "stroke") and after == "factor"):
            product.append(atom)
        else:
            found += [*product, atom]
            product = []
    return "".join(atom.shown for atom in (*found, *product))


def _spaced(atoms: list[_Atom]) -> list[_Atom]:
    """Leave out spaces beside signs, which have their own."""
    found = []
    for place, atom in enumerate(atoms):
        beside = [*atoms[max(place - 1, 0) : place], *atoms[place + 1 : place + 2]]
        idle = len(beside) < 2 or any(near.kind == "sign" and near.text not in ",;:" for near in beside)
        if atom.kind != "space" or not idle:
            found.append(atom)
    return found


def _factors(atoms: list[_Atom]) -> list[_Atom]:
    """Join what is multiplied by standing side by side, functions with their arguments."""
    found: list[_Atom] = []
    at = 0
    while at < len(atoms):
        start = at
        while at < len(atoms) and atoms[at].kind in ("function", "root"):
            at += 1 + (atoms[at].kind == "function" and [a.kind for a in atoms[at + 1 : at + 2]] == ["space"])
        heads, first = atoms[start:at], at
        while at < len(atoms) and atoms[at].kind in ("number", "name"):
            at += 1
        body = atoms[first:at]
        if not body:
            found += heads or [atoms[start]]
            at = at if heads else start + 1
            continue
        if heads and heads[-1].kind == "root":
            body[0] = _Atom("name", "", _ROOT.format(inner=body[0].inside))
            heads.pop()
        shown = "".join(atom.shown for atom in (*heads, *body))
        found.append(_Atom("factor", "", shown, body[0].bare if len(body) == 1 and not heads else ""))
    return found
