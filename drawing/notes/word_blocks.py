"""The blocks of a note in WordprocessingML: headings, lines, lists, equations, tables, pictures with captions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count

from ...scales.packaged import packaged
from ..text import lay_out
from .blocks import FOLDED, FOLDED_ROOM, Block, Document, Equations, Figure, Heading, Sentences, Steps, Table
from .built_up import built_up, displayed
from .figures import reduced
from .markup import letters
from .omml import quoted
from .word_lines import HEIGHT, TWIPS, bookmark, headed, line, numbered, paragraph, referred, words

EMU = 36000  # of a millimetre
WIDE = 180.0  # mm of a line
INDENT = 8.0  # mm before an equation; what goes on in another line stands in twice as far
FIGURES = 1000  # before the number of a figure to which something refers, among those of headings
LISTS = 3  # the number of the first list of steps
PAD = 4.0  # mm in a cell beside its text
_PICTURES = "http://schemas.openxmlformats.org/drawingml/2006"
_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"


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
        + paragraph("Caption", _caption(figure, said, referred(_figure_mark(number), number)))
        for place, (figure, picture, number) in enumerate(found)
    )


def _block(block: Block, said: dict[str, str], counted: _Counted) -> Iterator[str]:
    match block:
        case Heading(text=text):
            yield paragraph("Heading1", headed(line(text), next(counted.headings)))
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
            here = numbered(said["figure"], number)
            if block.folded:
                before, _, after = said["figure.folded"].format(number="\0", format=FOLDED).partition("\0")
                marked = bookmark(here, _figure_mark(number), FIGURES + number)
                yield paragraph("", words(before) + marked + words(after))
                return
            yield paragraph("Figure", _drawing(block, picture, number))
            yield paragraph("Caption", _caption(block, said, here))


def _equation(chunks: Sequence[str]) -> Iterator[str]:
    """Go through the lines of an equation, which is broken where it may be; words without one are a line of words."""
    whole = " ".join(chunks)
    if not displayed(whole):
        yield paragraph("Equation", line(whole))
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
            yield from [joined] if _fits(joined := " ".join(some), 2) else some
            some = []
    yield from some


def _fits(markup: str, indents: int) -> bool:
    return lay_out(markup, HEIGHT).width <= WIDE - indents * INDENT


def _table(rows: tuple[tuple[str | None, ...], ...]) -> str:
    """Return a table whose first row is repeated on every page; no row is parted by the end of a page."""
    wide = [0.0] * len(rows[0])
    for row in rows:
        for column, cell in enumerate(row):
            alone = column + 1 == len(row) or row[column + 1] is not None
            wide[column] = max(wide[column], lay_out(cell, HEIGHT).width + PAD if cell and alone else PAD)
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
    for column, cell in enumerate(row):
        if cell is None and column:
            continue
        span = next((k for k in range(column + 1, len(row)) if row[k] is not None), len(row)) - column
        joined = f'<w:gridSpan w:val="{span}"/>' if span > 1 else ""
        text = paragraph("Cell", line(cell or "", bold))
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
