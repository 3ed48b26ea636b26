"""A document of a word processor read back: its words and formulas in line, the order of its elements."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from io import BytesIO
from typing import Any

from lxml import etree

W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
M = "{http://schemas.openxmlformats.org/officeDocument/2006/math}"
# what ECMA-376 lets stand in these elements, in its order: a word processor refuses a file with another one
ORDER = {
    f"{W}pPr": "pStyle keepNext keepLines pageBreakBefore numPr tabs suppressAutoHyphens spacing ind jc "
    "outlineLvl sectPr",
    f"{W}rPr": "rStyle rFonts b bCs i iCs sz szCs vertAlign lang",
    f"{W}tblPr": "tblStyle tblW jc tblInd tblBorders tblLayout tblCellMar tblLook",
    f"{W}tcPr": "tcW gridSpan shd vAlign",
    f"{W}trPr": "cantSplit tblHeader",
    f"{W}tbl": "tblPr tblGrid tr",
    f"{W}num": "abstractNumId lvlOverride",
    f"{W}lvl": "start numFmt pStyle suff lvlText lvlJc pPr",
    f"{W}style": "name basedOn next autoRedefine uiPriority semiHidden unhideWhenUsed qFormat pPr rPr tblPr",
    f"{W}settings": (
        "zoom defaultTabStop autoHyphenation characterSpacingControl updateFields compat mathPr themeFontLang"
    ),
    f"{M}mathPr": "mathFont brkBin smallFrac dispDef lMargin rMargin defJc wrapIndent",
    f"{M}oMathPara": "oMathParaPr oMath",
    f"{M}r": "rPr t",
    f"{M}f": "num den",
    f"{M}rad": "radPr deg e",
    f"{M}d": "dPr e",
    f"{M}dPr": "begChr endChr",
    f"{M}bar": "barPr e",
    f"{M}sSub": "e sub",
    f"{M}sSup": "e sup",
    f"{M}sSubSup": "e sub sup",
}


def part(data: bytes, name: str) -> Any:
    """Return a part of a document, read without anything but a parser of XML."""
    return etree.fromstring(zipfile.ZipFile(BytesIO(data)).read(name))


def disordered(root: Any) -> Iterator[str]:
    """Go through the elements whose parts stand in a wrong order, or are not known."""
    for element in root.iter(*ORDER):
        places = ORDER[element.tag].split()
        names = [etree.QName(child).localname for child in element]
        if not set(names) <= set(places) or names != sorted(names, key=places.index):
            yield f"{element.tag}: {names}"


def said(element: Any) -> str:
    """Return what is said: `((a)/(b))` for fractions, `√(a)`, `_{...}`, `^{...}`, `\\bar{...}`, `\\u{...}`."""
    kind = etree.QName(element)
    if kind.localname == "t":
        return element.text or ""
    if kind.localname in ("br", "tab"):
        return "\n" if kind.localname == "br" else "\t"
    inside = {etree.QName(child).localname: said(child) for child in element} if kind.namespace == M[1:-1] else {}
    match kind.localname if inside else "":
        case "f":
            return f"(({inside['num']})/({inside['den']}))"
        case "rad":
            return f"√({inside['e']})"
        case "d":
            begin, end = (element.find(f"{M}dPr/{M}{name}Chr").get(f"{M}val") for name in ("beg", "end"))
            return f"{begin}{inside['e']}{end}"
        case "bar":
            over = element.find(f"{M}barPr/{M}pos").get(f"{M}val") == "top"
            return ("\\bar{" if over else "\\u{") + inside["e"] + "}"
        case "sSub" | "sSup" | "sSubSup":
            scripts = (f"{sign}{{{inside[name]}}}" for sign, name in (("^", "sup"), ("_", "sub")) if name in inside)
            return inside["e"] + "".join(scripts)
    return "".join(map(said, element))
