"""What the words over columns, and before the answers, mean: in Ukrainian, Russian and English, in any order."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from typing import Any

from ...scales.names import latin
from ...scales.packaged import packaged

LOOKED_AT = 60  # rows in which the header is looked for
LONGEST_HEAD = 300  # characters over a column; what is longer says nothing of one
UNDERSTOOD: Mapping[str, Any] = packaged(__package__, "texts", "understood")
_COLUMN_OF = {word: kind for kind, words in UNDERSTOOD["columns"].items() for word in words}
_ABOUT_OF = {word: kind for kind, words in UNDERSTOOD["about"].items() for word in words}
_COMMA = re.compile("[,:]")  # before a unit without brackets
# a column of a class: a quantity, a part of its answer, a unit
_QUANTITY = re.compile(r"(?P<name>[A-Za-z]\w*)(?:\.(?P<part>mm|dir|sense|mu))?")
_BEFORE = sorted((*UNDERSTOOD["about"]["variant"], *UNDERSTOOD["numbered"]["variant"]), key=len, reverse=True)
_NUMBERED = re.compile(rf"\s*(?:{'|'.join(map(re.escape, _BEFORE))})\.?\s*№?\s*", re.IGNORECASE)
MIXED = re.compile(r"[A-Za-z]+_\w+")
_ORNAMENT = re.compile(r"[\s_{}$\\.^]")  # of a symbol: l_OA, l_{OA} and lOA are one
_GREEK = re.compile(r"GREEK (?:SMALL LETTER |CAPITAL LETTER )?(\w+)")
_LETTERS = {  # of Greek by their names
    ord(sign): found[1].lower().replace("lamda", "lambda")
    for sign in map(chr, range(0x370, 0x400))
    if (found := _GREEK.match(unicodedata.name(sign, "")))
}


def tidy(text: str) -> str:
    """Return a header word in small letters, with plain spaces and apostrophes."""
    plain = " ".join(text.lower().replace("ё", "е").replace("’", "'").replace("ʼ", "'").replace(".", " ").split())
    return plain.rstrip(":*? ")


def split_unit(text: str) -> tuple[str, str]:
    """Return a header without the unit that stands behind it in brackets or after a comma, and the unit.

    >>> split_unit("V_B [м/с]"), split_unit("відрізок, мм"), split_unit("V_B")
    (('V_B', 'м/с'), ('відрізок', 'мм'), ('V_B', ''))
    """
    text = text.strip()
    opened = -1
    if len(text) > LONGEST_HEAD:
        return text, ""
    if text.endswith("]"):
        opened = text.find("[", text.rfind("]", 0, -1) + 1)
    elif text.endswith(")"):
        opened = text.find("(", text.rfind("\n") + 1)
    if opened >= 0:
        return text[:opened].strip(), text[opened + 1 : -1].strip()
    comma = _COMMA.search(text, max(text.rfind("["), text.rfind("(")) + 1, len(text) - 1)
    return (text, "") if comma is None else (text[: comma.start()].strip(), text[comma.end() :].strip())


def column_kind(text: str) -> str | None:
    """Return what a column of a form holds, by the word over it."""
    return _COLUMN_OF.get(tidy(text)) or _COLUMN_OF.get(tidy(split_unit(text)[0]))


def about_kind(text: str) -> str | None:
    """Return what a cell says of the student, by the word before it or over it."""
    return _ABOUT_OF.get(tidy(text)) or _ABOUT_OF.get(tidy(split_unit(text)[0]))


def quantity_part(text: str) -> tuple[str, str, str] | None:
    """Return name, part and unit of a class's column; None where it can be no quantity.

    The part is "", "mm", "mu", "dir" or "sense".

    >>> quantity_part("V_B.mm"), quantity_part("omega_2 [рад/с]"), quantity_part("прізвище")
    (('V_B', 'mm', ''), ('omega_2', '', 'рад/с'), None)
    """
    head, unit = split_unit(text)
    found = _QUANTITY.fullmatch(latin(head))
    return None if found is None else (found["name"], found["part"] or "", unit)


def symbol(text: str) -> str:
    """Return a symbol as plain letters and digits, however it is written.

    >>> symbol("l_{OA}"), symbol("φ"), symbol("J_{S_2}"), symbol("n₁")
    ('lOA', 'phi', 'JS2', 'n1')
    """
    if len(text) > LONGEST_HEAD:
        return ""
    return latin(_ORNAMENT.sub("", unicodedata.normalize("NFKC", text))).translate(_LETTERS)


def variant_said(text: str) -> str:
    """Return the id of a variant without the words before it.

    >>> variant_said("Варіант № 7"), variant_said("var. 12"), variant_said("А3")
    ('7', '12', 'А3')
    """
    before = _NUMBERED.match(text)
    return text if before is None else text[before.end() :]


def recognised(rows: Sequence[Sequence[str]]) -> int:
    """Return how many cells of the most telling row are headers; to choose a separator by."""
    best = 0
    for row in rows:
        words = [cell for cell in row if cell and not cell[0].isdigit()]  # no header begins with a digit
        kinds = {kind for cell in words if (kind := column_kind(cell))}
        names = {cell for cell in words if MIXED.match(latin(cell.strip()))}
        about = {kind for cell in words if (kind := about_kind(cell))}
        best = max(best, len(kinds | about) + (len(names) if len(row) > 1 else 0))
    return best
