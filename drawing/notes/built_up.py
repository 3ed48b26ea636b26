"""A line of an equation built up: quotients as fractions, roots, brackets as high as what they hold; not so units.

What stands in line, `a·b/c·d`, reads from left to right: the product before a stroke is divided by the factor behind.
"""

from __future__ import annotations

import re

from .atoms import PAIRS, Atom, atoms_of
from .omml import bracketed, fraction, root, scripted

_DISPLAYED = re.compile(r"[=≤≥]|\\u{1,2}\{")


def displayed(markup: str) -> bool:
    """Whether a line is an equation, and not words with symbols among them."""
    return _DISPLAYED.search(markup) is not None


def built_up(markup: str) -> str:
    """Return a line of markup as the inside of a formula.

    >>> "<m:f>" in built_up("v = s/t"), "<m:f>" in built_up("2 m/s")
    (True, False)
    """
    return _shown(atoms_of(markup))


def _shown(atoms: list[Atom]) -> str:
    """Return how atoms are shown, what stands in brackets first."""
    found: list[Atom] = []
    opened: list[int] = []
    for atom in atoms:
        if atom.kind == "close" and opened and PAIRS[found[opened[-1]].text] == atom.text:
            start = opened.pop()
            inner = _line(found[start + 1 :])
            whole = bracketed(inner, found[start].text + atom.text)
            scripted_whole = scripted(whole, atom.above, atom.below)
            found[start:] = [Atom("name", "", scripted_whole, inner if scripted_whole == whole else "")]
            continue
        if atom.kind == "open":
            opened.append(len(found))
        found.append(atom)
    return _line(found)


def _line(atoms: list[Atom]) -> str:
    """Return atoms without brackets to look for, their quotients built up."""
    found: list[Atom] = []
    product: list[Atom] = []
    factors = _factors(_spaced(atoms))
    for place, atom in enumerate(factors):
        after = factors[place + 1].kind if place + 1 < len(factors) else ""
        if product and product[-1].kind == "stroke" and atom.kind == "factor":
            above = product[0].inside if len(product) == 2 else "".join(part.shown for part in product[:-1])
            product = [Atom("factor", "", fraction(above, atom.inside))]
        elif atom.kind == "factor" or (product and atom.kind in ("dot", "stroke") and after == "factor"):
            product.append(atom)
        else:
            found += [*product, atom]
            product = []
    return "".join(atom.shown for atom in (*found, *product))


def _spaced(atoms: list[Atom]) -> list[Atom]:
    """Leave out spaces beside signs, which have their own."""
    found = []
    for place, atom in enumerate(atoms):
        beside = [*atoms[max(place - 1, 0) : place], *atoms[place + 1 : place + 2]]
        idle = len(beside) < 2 or any(near.kind == "sign" and near.text not in ",;:" for near in beside)
        if atom.kind != "space" or not idle:
            found.append(atom)
    return found


def _factors(atoms: list[Atom]) -> list[Atom]:
    """Join what is multiplied by standing side by side, functions with their arguments."""
    found: list[Atom] = []
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
        found.append(_factor(heads, body))
    return found


def _factor(heads: list[Atom], body: list[Atom]) -> Atom:
    if heads and heads[-1].kind == "root":
        body = [Atom("name", "", root(body[0].inside)), *body[1:]]
        heads = heads[:-1]
    shown = "".join(atom.shown for atom in (*heads, *body))
    return Atom("factor", "", shown, body[0].bare if len(body) == 1 and not heads else "")
