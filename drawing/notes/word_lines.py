"""Lines of a note in WordprocessingML: words with formulas among them, fields, the title page, the contents."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby

from ...scales.packaged import packaged
from .atoms import whole
from .blocks import Document, Heading
from .markup import Node, Plain, Scripted, joined, letters, parse, tied
from .omml import node, quoted

TWIPS = 1440 / 25.4  # of a millimetre
HEIGHT = 2.8  # mm of a capital of the text: lines are estimated with the font of the sheet, which is wider
_BEFORE_NAMES, _BEFORE_DATE = 85.0, 30.0  # mm
_UNITS = re.compile(r"(?:\b(?:kg|N|rad|mm|cm|m)[/·]|\bm)$")


def paragraph(style: str, inside: str, properties: str = "") -> str:
    """Return a paragraph; its own properties go before those of its style."""
    styled = f'<w:pStyle w:val="{style}"/>' if style else ""
    told = f"<w:pPr>{styled}{properties}</w:pPr>" if styled or properties else ""
    return f"<w:p>{told}{inside}</w:p>"


def words(text: str, properties: str = "") -> str:
    """Return characters of a paragraph."""
    looks = f"<w:rPr>{properties}</w:rPr>" if properties else ""
    return f'<w:r>{looks}<w:t xml:space="preserve">{quoted(text)}</w:t></w:r>' if text else ""


def line(markup: str, properties: str = "") -> str:
    """Return a line of markup: words as text with `properties`, symbols with scripts and bars as formulas."""
    parts = whole(parse(markup))
    before = "m/" if len(parts) == 1 else ""  # a power of m alone is a unit
    told: list[tuple[bool, str]] = []
    for place, part in enumerate(parts):
        formula = not isinstance(part, Plain) and not _is_unit(part, before)
        told.append((formula, node(part, joined(parts, place)) if formula else _text(part, properties)))
        before = part.text if isinstance(part, Plain) else ""
    shown = ((formula, "".join(text for _, text in some)) for formula, some in groupby(told, lambda pair: pair[0]))
    return "".join(f"<m:oMath>{text}</m:oMath>" if formula else text for formula, text in shown)


def _is_unit(part: Node, before: str) -> bool:
    if not isinstance(part, Scripted) or not isinstance(part.base, Plain) or part.below:
        return False
    cyrillic = "а" <= part.base.text[:1].lower() <= "ґ"
    powers = all(isinstance(up, Plain) for up in part.above)
    return powers and (cyrillic or (part.base.text in ("m", "s") and _UNITS.search(before) is not None))


def _text(part: Node, properties: str) -> str:
    """Return words, or a unit with its power."""
    if isinstance(part, Plain):
        return words(tied(part.text), properties)
    assert isinstance(part, Scripted)
    assert isinstance(part.base, Plain)
    power = "".join(up.text for up in part.above if isinstance(up, Plain))
    raised = words(power, f'{properties}<w:vertAlign w:val="superscript"/>')
    return words(part.base.text, properties) + raised


def _sign(kind: str) -> str:
    return f'<w:r><w:fldChar w:fldCharType="{kind}"/></w:r>'


def _begun(order: str) -> str:
    told = f'<w:r><w:instrText xml:space="preserve"> {quoted(order)} </w:instrText></w:r>'
    return f"{_sign('begin')}{told}{_sign('separate')}"


def numbered(name: str, number: int) -> str:
    """Return the number of a caption, a field that counts captions of this name."""
    return _begun(rf"SEQ {name} \* ARABIC") + words(str(number)) + _sign("end")


def referred(mark: str, number: int) -> str:
    """Return a number that stands at a mark, a field that repeats it."""
    return _begun(rf"REF {mark} \h") + words(str(number)) + _sign("end")


def bookmark(inside: str, mark: str, number: int) -> str:
    """Return what others refer to by a mark."""
    return f'<w:bookmarkStart w:id="{number}" w:name="{mark}"/>{inside}<w:bookmarkEnd w:id="{number}"/>'


def headed(inside: str, number: int) -> str:
    """Return a heading to which the contents lead."""
    return bookmark(inside, _mark(number), number)


def _mark(number: int) -> str:
    return f"_Toc{number:06d}"


def first_pages(document: Document) -> str:
    """Return the title page and the contents."""
    return "".join((*_title(document), *_contents(document)))


def _title(document: Document) -> Iterator[str]:
    said, page = packaged(__package__, "texts", document.language), document.title
    yield paragraph("TitleLine", words(page.department))
    yield paragraph("Title", words(said["title.note"]))
    yield paragraph("Subtitle", words(page.title))
    yield paragraph("TitleLine", words(said["title.variant"].format(variant=page.variant)))
    down = _down(_BEFORE_NAMES)
    for name in ("student", "group", "teacher"):
        value = words(getattr(page, name) or "_" * 24)
        yield paragraph("TitleName", f"{words(said[f'title.{name}'])}<w:r><w:tab/></w:r>{value}", down)
        down = ""
    yield paragraph("TitleLine", words(page.date), _down(_BEFORE_DATE))
    yield paragraph("TitleLine", words(page.identity, '<w:sz w:val="18"/><w:szCs w:val="18"/>'))


def _down(mm: float) -> str:
    return f'<w:spacing w:before="{round(mm * TWIPS)}"/>'


def _contents(document: Document) -> Iterator[str]:
    """Go through the contents, a field with its entries; their pages are known when it is updated."""
    yield paragraph("TOCHeading", words(packaged(__package__, "texts", document.language)["contents"]))
    before = _begun(r'TOC \o "1-2" \h \z \u')
    entries = [letters(block.text) for block in document.blocks if isinstance(block, Heading)]
    for number, entry in enumerate(entries, 1):
        page = _begun(rf"PAGEREF {_mark(number)} \h") + _sign("end")
        shown = f"{words(f'{number} {entry}')}<w:r><w:tab/></w:r>{page}"
        linked = f'<w:hyperlink w:anchor="{_mark(number)}" w:history="1">{shown}</w:hyperlink>'
        yield paragraph("TOC1", before + linked)
        before = ""
    yield paragraph("TOC1", f'{before}{_sign("end")}<w:r><w:br w:type="page"/></w:r>')
