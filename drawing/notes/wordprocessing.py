"""A note in WordprocessingML: first pages, headings, lines, lists, equations, tables, pictures with captions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count, groupby

from ...scales.packaged import packaged
from ..table import cells as cells_of
from ..text import lay_out
from .blocks import FOLDED, FOLDED_ROOM, Block, Document, Equations, Figure, Heading, Sentences, Steps, Table, reduced
from .markup import Node, Plain, Scripted, joined, letters, parse, tied
from .omml import built_up, displayed, node, quoted, whole

TWIPS = 1440 / 25.4  # of a millimetre
HEIGHT = 2.8  # mm of a capital of the text: lines are estimated with the font of the sheet, which is wider
_BEFORE_NAMES, _BEFORE_DATE = 85.0, 30.0  # mm
EMU = 36000  # of a millimetre
WIDE = 180.0  # mm of a line
INDENT = 8.0  # mm before an equation; what goes on in another line stands in twice as far
FIGURES = 1000  # before the number of a figure to which something refers, among those of headings
LISTS = 3  # the number of the first list of steps
PAD = 4.0  # mm in a cell beside its text
_PICTURES = "http://schemas.openxmlformats.org/drawingml/2006"
_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
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


def _number_field(order: str, number: int) -> str:
    """Return a field that shows a number: of a caption, or of what it refers to."""
    return _begun(order) + words(str(number)) + _sign("end")


def _bookmark(inside: str, mark: str, number: int) -> str:
    """Return what others refer to by a mark."""
    return f'<w:bookmarkStart w:id="{number}" w:name="{mark}"/>{inside}<w:bookmarkEnd w:id="{number}"/>'


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


@dataclass(frozen=True, slots=True)
class Picture:
    """By what names a document knows the parts that hold a picture: one for any reader, one that is sharp."""

    png: str
    svg: str


@dataclass(slots=True)
class _Counted:
    """What is numbered through a note."""

    pictures: Iterator[tuple[int, Picture]]
    headings: Iterator[int] = field(default_factory=lambda: count(1))
    lists: Iterator[int] = field(default_factory=lambda: count(LISTS))


def blocks_in_word(document: Document, pictures: Sequence[Picture]) -> str:
    """Return all that follows the contents; `pictures` are those of the figures, in order."""
    said = packaged(__package__, "texts", document.language)
    counted = _Counted(iter(enumerate(pictures, 1)))
    return "".join(part for block in document.blocks for part in _block(block, said, counted))


def folded_in_word(document: Document, pictures: Sequence[Picture]) -> str:
    """Return the figures that stand on larger sheets at the end."""
    said = packaged(__package__, "texts", document.language)
    figures = zip((block for block in document.blocks if isinstance(block, Figure)), pictures, count(1), strict=False)
    found = [(figure, picture, number) for figure, picture, number in figures if figure.folded]
    return "".join(
        paragraph("Figure", _drawing(figure, picture, number), "<w:pageBreakBefore/>" if place else "")
        + paragraph("Caption", _caption(figure, said, _number_field(rf"REF {_figure_mark(number)} \h", number)))
        for place, (figure, picture, number) in enumerate(found)
    )


def _block(block: Block, said: dict[str, str], counted: _Counted) -> Iterator[str]:
    match block:
        case Heading(text=text):
            number = next(counted.headings)
            yield paragraph("Heading1", _bookmark(line(text), _mark(number), number))  # the contents lead there
        case Sentences(texts=texts):
            yield paragraph("", words(" ").join(map(line, texts)))
        case Steps(texts=texts):
            one = f'<w:numPr><w:ilvl w:val="0"/><w:numId w:val="{next(counted.lists)}"/></w:numPr>'
            yield from (paragraph("ListNumber", line(text), one) for text in texts)
        case Equations(lines=lines):
            yield from (part for chunks in lines for part in _equation(chunks))
        case Table(rows=rows):
            yield _table(rows)
            yield paragraph("Cell", "")
        case Figure():
            number, picture = next(counted.pictures)
            here = _number_field(rf"SEQ {said['figure']} \* ARABIC", number)
            if block.folded:
                before, _, after = said["figure.folded"].format(number="\0", format=FOLDED).partition("\0")
                marked = _bookmark(here, _figure_mark(number), FIGURES + number)
                yield paragraph("", words(before) + marked + words(after))
                return
            yield paragraph("Figure", _drawing(block, picture, number))
            yield paragraph("Caption", _caption(block, said, here))


def _equation(chunks: Sequence[str]) -> Iterator[str]:
    """Go through the lines of an equation, which is broken where it may be; words without one are a line of words."""
    markup = " ".join(chunks)
    if not displayed(markup):
        yield paragraph("Equation", line(markup))
        return
    rows = [""]
    for part in _unbroken(chunks):
        longer = f"{rows[-1]} {part}".strip()
        rows[-1:] = [longer] if not rows[-1] or _fits(longer, 1 if len(rows) == 1 else 2) else [rows[-1], part]
    for place, row in enumerate(rows):
        further = f'<w:ind w:left="{round(2 * INDENT * TWIPS)}"/>' if place else ""
        left = '<m:oMathParaPr><m:jc m:val="left"/></m:oMathParaPr>'
        inside = f"<m:oMathPara>{left}<m:oMath>{built_up(row)}</m:oMath></m:oMathPara>"
        yield paragraph("Equation", inside, further)


def _unbroken(chunks: Sequence[str]) -> Iterator[str]:
    """Go through what is not broken: all that stands in brackets, unless it is longer than a line."""
    some: list[str] = []
    for chunk in chunks:
        some.append(chunk)
        depth = sum((c in "([") - (c in ")]") for part in some for c in part)
        if depth <= 0:
            yield from [unbroken] if _fits(unbroken := " ".join(some), 2) else some
            some = []
    yield from some


def _fits(markup: str, indents: int) -> bool:
    return lay_out(markup, HEIGHT).width <= WIDE - indents * INDENT


def _table(rows: tuple[tuple[str | None, ...], ...]) -> str:
    """Return a table whose first row is repeated on every page; no row is parted by the end of a page."""
    wide = [PAD] * len(rows[0])
    for row in rows:
        for start, end, cell in cells_of(row):
            if end == start + 1:
                wide[start] = max(wide[start], lay_out(cell, HEIGHT).width + PAD)
    share = min(1.0, WIDE / sum(wide))
    grid = "".join(f'<w:gridCol w:w="{round(mm * share * TWIPS)}"/>' for mm in wide)
    look = '<w:tblLook w:val="0020" w:firstRow="1" w:lastRow="0" w:firstColumn="0" w:lastColumn="0"'
    properties = (
        '<w:tblPr><w:tblStyle w:val="TableGrid"/><w:tblW w:w="0" w:type="auto"/><w:jc w:val="center"/>'
        f'{look} w:noHBand="1" w:noVBand="1"/></w:tblPr>'
    )
    return f"<w:tbl>{properties}<w:tblGrid>{grid}</w:tblGrid>{''.join(map(_row, rows, count()))}</w:tbl>"


def _row(row: tuple[str | None, ...], number: int) -> str:
    head, bold = ("<w:tblHeader/>", "<w:b/><w:bCs/>") if number == 0 else ("", "")
    cells = []
    for start, end, cell in cells_of(row):
        joined = f'<w:gridSpan w:val="{end - start}"/>' if end - start > 1 else ""
        text = paragraph("Cell", line(cell, bold))
        cells.append(
            f'<w:tc><w:tcPr><w:tcW w:w="0" w:type="auto"/>{joined}<w:vAlign w:val="center"/></w:tcPr>{text}</w:tc>'
        )
    return f"<w:tr><w:trPr><w:cantSplit/>{head}</w:trPr>{''.join(cells)}</w:tr>"


def _caption(figure: Figure, said: dict[str, str], number: str) -> str:
    lines = [line(text) for text in (figure.caption, *figure.under, *reduced(said, shown_share(figure)))]
    return f"{words(said['figure'] + ' ')}{number}{words(' – ')}" + "<w:r><w:br/></w:r>".join(lines)


def shown_share(figure: Figure) -> float:
    """Return the part of its size at which a figure is shown."""
    return figure.share_of(FOLDED_ROOM) if figure.folded else figure.share


def _figure_mark(number: int) -> str:
    return f"_Figure{number}"


def _drawing(figure: Figure, picture: Picture, number: int) -> str:
    """Return a picture as large as the figure is shown; what it shows is told to who cannot see it."""
    cx, cy = (round(mm * shown_share(figure) * EMU) for mm in figure.view.size)
    told = quoted("; ".join(map(letters, (figure.caption, *figure.under))))
    size = f'cx="{cx}" cy="{cy}"'
    name = f'id="{number}" name="{quoted(figure.view.name)}" descr="{told}"'
    sharp = (
        f'<a:extLst><a:ext uri="{{96DAC541-7B7A-43D3-8B79-37D633B846F1}}"><asvg:svgBlip xmlns:asvg="{_SVG}" '
        f'r:embed="{picture.svg}"/></a:ext></a:extLst>'
    )
    return (
        f'<w:r><w:drawing><wp:inline distT="0" distB="0" distL="0" distR="0"><wp:extent {size}/><wp:docPr {name}/>'
        f'<a:graphic xmlns:a="{_PICTURES}/main"><a:graphicData uri="{_PICTURES}/picture">'
        f'<pic:pic xmlns:pic="{_PICTURES}/picture"><pic:nvPicPr><pic:cNvPr {name}/><pic:cNvPicPr/></pic:nvPicPr>'
        f'<pic:blipFill><a:blip r:embed="{picture.png}">{sharp}</a:blip>'
        "<a:stretch><a:fillRect/></a:stretch></pic:blipFill>"
        f'<pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext {size}/></a:xfrm>'
        '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr></pic:pic></a:graphicData></a:graphic>'
        "</wp:inline></w:drawing></w:r>"
    )
