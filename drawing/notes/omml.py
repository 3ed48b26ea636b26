"""The mathematics of a note in OMML, the equations of word processors: scripts, bars, underlines."""

from __future__ import annotations

from .markup import Node, Plain, Ruled, Scripted, printable

_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})
_EMPTY = "\u200b"  # an argument without a character would be shown as a box to fill in


def quoted(text: str) -> str:
    """Return characters as XML allows them, in an attribute or in an element."""
    return printable(text).translate(_ENTITIES)


def run(text: str, style: str = "") -> str:
    """Return characters within a formula: in italics, or plain (`p`), or as words outside mathematics (`nor`)."""
    looks = {"": "", "p": '<m:rPr><m:sty m:val="p"/></m:rPr>', "nor": "<m:rPr><m:nor/></m:rPr>"}[style]
    return f'<m:r>{looks}<m:t xml:space="preserve">{quoted(text)}</m:t></m:r>'


def letters(text: str) -> str:
    """Return plain characters of a formula: a letter alone in italics, several plain, words as words."""
    if len(text) == 1:
        return run(text)
    return run(text, "nor" if any(c.isspace() for c in text) else "p")


def node(found: Node, upright: bool = False) -> str:
    """Return a part of a formula; a letter alone is slanted, unless it is `upright`."""
    if isinstance(found, Plain):
        return (run(found.text, "p") if upright else letters(found.text)) if found.text else run(_EMPTY, "p")
    if isinstance(found, Ruled):
        inner = "".join(map(node, found.parts)) or run(_EMPTY, "p")
        return {"bar": bar(inner, "top"), "u": bar(inner, "bot"), "uu": bar(bar(inner, "bot"), "bot")}[found.kind]
    return scripted(node(found.base, upright), *scripts(found))


def scripts(found: Scripted) -> tuple[str, str]:
    """Return what stands above and below behind a letter."""
    above, below = ("".join(map(_script, parts)) for parts in (found.above, found.below))
    return above, below


def _script(found: Node) -> str:
    """Return a part of a script, whose letters are names, not quantities."""
    if isinstance(found, Plain):
        return run(found.text, "nor" if any(c.isspace() for c in found.text) else "p")
    return node(found)


def bar(inner: str, place: str) -> str:
    """Return a formula with a line over it (`top`) or under it (`bot`)."""
    return f'<m:bar><m:barPr><m:pos m:val="{place}"/></m:barPr><m:e>{inner}</m:e></m:bar>'


def scripted(base: str, above: str, below: str) -> str:
    """Return a formula with what stands above and below behind it."""
    e, sup, sub = f"<m:e>{base}</m:e>", f"<m:sup>{above}</m:sup>", f"<m:sub>{below}</m:sub>"
    match bool(above), bool(below):
        case True, True:
            return f"<m:sSubSup>{e}{sub}{sup}</m:sSubSup>"
        case True, False:
            return f"<m:sSup>{e}{sup}</m:sSup>"
        case False, True:
            return f"<m:sSub>{e}{sub}</m:sSub>"
        case _:
            return base


def fraction(above: str, below: str) -> str:
    """Return a quotient."""
    return f"<m:f><m:num>{above}</m:num><m:den>{below}</m:den></m:f>"


def root(inner: str) -> str:
    """Return a square root."""
    return f'<m:rad><m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/><m:e>{inner}</m:e></m:rad>'


def bracketed(inner: str, signs: str) -> str:
    """Return a formula between two brackets as high as it is."""
    pair = f'<m:begChr m:val="{signs[0]}"/><m:endChr m:val="{signs[1]}"/>'
    return f"<m:d><m:dPr>{pair}</m:dPr><m:e>{inner}</m:e></m:d>"


def formula(inner: str) -> str:
    """Return a formula that stands among words."""
    return f"<m:oMath>{inner}</m:oMath>"
