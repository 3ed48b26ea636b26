"""A note as DOCX (extra `docx`): title page, contents, text, lists, equations, tables, pictures with captions.

What is written in WordprocessingML is put into a document of the library with styles, page numbers and settings.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from importlib.util import find_spec
from io import BytesIO
from itertools import accumulate, chain, count, groupby
from typing import TYPE_CHECKING, Any, NamedTuple

from ...scales.errors import InputError
from ...scales.packaged import home, packaged
from ..font import SCREEN, SLANTED, UPRIGHT, font
from ..formats import FORMATS
from ..page import Page
from ..pdf import write_png
from ..svg import svg_text
from ..tables import cells as cells_of
from ..text import lay_out, spelled
from . import blocks as note
from .blocks import Block, Document, Equations, Figure, Heading, Profile, Sentences, Steps, Table, displayed
from .omml import built_up, node, quoted, whole

if TYPE_CHECKING:
    from docx.document import Document as Word

LIBRARIES = ("docx", "fontTools", "pypdfium2")  # for the document, the letters and the dots of its pictures
DPI = 300  # of the pictures for readers that draw no SVG, as large as they are shown
LONGEST = 255  # characters of a property of a document
SPACES = {
    "w": "http://schemas.openxmlformats.org/wordprocessingml/2006/main",
    "m": "http://schemas.openxmlformats.org/officeDocument/2006/math",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
}
_LONG_AGO = (1980, 1, 1, 0, 0, 0)  # the first date that a file in a ZIP can have: the same note, the same bytes
TWIPS = 1440 / 25.4  # of a millimetre
HEIGHT = 2.8  # mm of a capital of the text: lines are estimated with the font of the sheet, which is wider
_BEFORE = 85.0, 30.0  # mm before names, before the date; larger lines leave less
EMU = 36000  # of a millimetre
WIDE = 180.0  # mm of a line
FRAMES = 9001  # numbers of the pictures of frames, beyond those of figures
HIGH_2 = 37.0  # mm of the foot of a page that form 2 takes, over the distance of footers
# fields in cells of title blocks by their form: mm from the top left corner of a page, width, height
NUMBERED = {
    "": (),
    "2": (("PAGE", (170.0, 272.0, 15.0, 5.0)), ("NUMPAGES", (185.0, 272.0, 20.0, 5.0))),
    "2a": (("PAGE", (195.0, 284.0, 10.0, 8.0)),),
    "folded": (("PAGE", (282.0, 407.0, 10.0, 8.0)),),
}
PERCENT = 5000  # fiftieths of a per cent
OF_NUMBER = 14.0  # mm at the end of a line for the number of an equation
KEPT = "<w:keepNext/>"  # of a paragraph that stands on the page of what follows
TOGETHER = 3  # rows of a table that no end of a page parts, at its beginning and at its end
INDENT = 8.0  # mm before an equation; what goes on in another line stands in twice as far
UNNUMBERED = '<w:numPr><w:numId w:val="0"/></w:numPr><w:jc w:val="center"/>'
FIGURES = 1000  # before the number of a figure to which something refers, among those of headings
LISTS = 3  # the number of the first list of steps
_END = '<w:r><w:fldChar w:fldCharType="end"/></w:r>'  # of a field
PAD = 4.0  # mm in a cell beside its text
SERIF = 1.35  # times as wide as on the sheet a word is in the bold roman of a table's head
_PICTURES = "http://schemas.openxmlformats.org/drawingml/2006"
_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"


class Drawing(NamedTuple):
    """A figure as PNG, and as SVG with outlines for letters."""

    png: bytes
    svg: bytes


Picture = tuple[str, str]  # by what names a document knows the parts of a picture: for any reader, and sharp


def docx_bytes(document: Document, drawings: Sequence[Drawing] | None = None) -> bytes:
    """Return a note as DOCX; the same note gives the same bytes.

    The `drawings` of its figures may be those of another note with the same blocks.

    Raises InputError: the extra `docx` is not installed.
    """
    _needs_libraries()
    import docx.shared

    word = docx.Document()
    _dress(word, document)
    _pages(word, document.profile)
    _sign(word, document)
    drawings = drawings_of(document.blocks, document.language) if drawings is None else drawings
    pictures = [_picture(word.part, drawing, number) for number, drawing in enumerate(drawings, 1)]
    _append(word, "".join(_title(document)))
    frames = note.framed_pages(document) if document.profile.framed else {}
    if frames:
        _frame(word, frames)
    _append(word, f"{''.join(_contents(document))}{blocks_in_word(document, pictures)}")
    if document.folds:
        section, sheet = word.add_section(), FORMATS[f"{note.FOLDED}-portrait"]  # for what is too large for a page
        section.page_width, section.page_height = docx.shared.Mm(sheet.width), docx.shared.Mm(sheet.height)
        section.different_first_page_header_footer = False  # numbers of pages go on
        section.header.is_linked_to_previous = False  # no frame of a smaller page
        if frames:
            section.left_margin, section.right_margin = map(docx.shared.Mm, note.FOLDED_SIDES)
            _framed(section.header, frames, "folded")
        _append(word, _folded_in_word(document, pictures))
    stream = BytesIO()
    word.save(stream)
    return _undated(stream.getvalue())


def drawings_of(blocks: Iterable[Block], language: str) -> list[Drawing]:
    """Draw the figures of a note; errors as of `docx_bytes`."""
    _needs_libraries()
    drawings = []
    for figure in (block for block in blocks if isinstance(block, Figure)):
        png = BytesIO()
        write_png([note.figure_page(figure, language)], png, DPI * figure.share)
        drawings.append(Drawing(png.getvalue(), _outlined(note.figure_svg(figure, language))))
    return drawings


def _needs_libraries() -> None:
    if any(find_spec(name) is None for name in LIBRARIES):
        raise InputError("extra-missing", packages="fonttools pypdfium2 python-docx", suffix=".docx")


def _append(word: Word, inside: str) -> None:
    last = word.element.body[-1]  # the properties of the last pages
    for part in _parsed(inside):
        last.addprevious(part)


def _parsed(inside: str) -> list[Any]:
    from docx.oxml import parse_xml

    names = " ".join(f'xmlns:{short}="{name}"' for short, name in SPACES.items())
    return list(parse_xml(f"<w:body {names}>{inside}</w:body>"))


def _dress(word: Word, document: Document) -> None:
    """Put the styles, lists and settings of a note in the place of those of the library."""
    from docx.opc.constants import RELATIONSHIP_TYPE as KIND
    from docx.oxml import parse_xml

    parts: Any = word.part
    dressed = {KIND.STYLES: "styles", KIND.NUMBERING: "numbering", KIND.SETTINGS: "settings"}
    for rels, kept in (
        (parts.rels, {*dressed, KIND.THEME, KIND.FONT_TABLE}),
        (parts.package.rels, {KIND.OFFICE_DOCUMENT, KIND.CORE_PROPERTIES}),
    ):
        for name in [name for name, rel in rels.items() if rel.reltype not in kept]:
            del rels[name]
    lists = sum(isinstance(block, Steps) for block in document.blocks)
    first = '<w:lvlOverride w:ilvl="0"><w:startOverride w:val="1"/></w:lvlOverride>'  # every list begins with 1
    numbers = "".join(
        f'<w:num w:numId="{LISTS + number}"><w:abstractNumId w:val="2"/>{first}</w:num>' for number in range(lists)
    )
    for kind, name in dressed.items():
        text = (home(__package__) / "word" / f"{name}.xml").read_text(encoding="utf-8")
        looks = document.profile
        sizes = {"size": round(2 * looks.size), "between": round(240 * looks.lines), "wide": round(looks.wide * TWIPS)}
        locale = packaged(__package__, "texts", document.language)["locale"]
        filled = parse_xml(text.format(lang=locale, lists=numbers, **sizes))
        parts.part_related_by(kind).element[:] = list(filled)


def _pages(word: Word, profile: Profile) -> None:
    """Set the pages: A4 with the margins of a profile, a number at the foot of all but the first."""
    from docx.shared import Mm

    section = word.sections[0]
    section.page_width, section.page_height = Mm(210), Mm(297)
    section.left_margin, section.right_margin = Mm(profile.left), Mm(profile.right)
    section.top_margin, section.bottom_margin = Mm(profile.top), Mm(profile.bottom)
    section.header_distance = section.footer_distance = Mm(10)
    section.different_first_page_header_footer = True
    section.footer.is_linked_to_previous = False
    section.footer.part.element[:] = _parsed(_paragraph("Footer", "" if profile.framed else _field("PAGE")))


def _field(code: str) -> str:
    return f'<w:fldSimple w:instr=" {code} ">{_words("2")}</w:fldSimple>'


def _frame(word: Word, frames: Mapping[str, Page]) -> None:
    """Draw the frame of each page behind its text: of the title page, with form 2 of the contents, then form 2a.

    Numbers stand in cells of the title blocks; what forms take is left free by a footer.
    """
    word.add_section()
    first, own = word.sections
    first.different_first_page_header_footer, own.different_first_page_header_footer = False, True
    headers = {"": first.header, "2": own.first_page_header, "2a": own.header}
    for form, header in headers.items():
        header.is_linked_to_previous = False
        _framed(header, frames, form)
    own.first_page_footer.is_linked_to_previous = False
    high = f'<w:spacing w:before="0" w:after="0" w:line="{round(HIGH_2 * TWIPS)}" w:lineRule="exact"/>'
    own.first_page_footer.part.element[:] = _parsed(_paragraph("Footer", "", high))


def _framed(header: Any, frames: Mapping[str, Page], form: str) -> None:
    """Put the frame of a form into the header of its pages."""
    page, number, png = frames[form], FRAMES + [*frames].index(form), BytesIO()
    write_png([page], png, DPI)
    svg = _outlined(svg_text(page, with_font=False).encode("utf-8"))
    picture = _picture(header.part, Drawing(png.getvalue(), svg), number)
    cells = "".join(_paragraph("Footer", _field(code), _placed(*box)) for code, box in NUMBERED[form])
    size = round(page.width * EMU), round(page.height * EMU)
    header.part.element[:] = _parsed(cells + _paragraph("Footer", _behind(picture, number, size)))


def _placed(x: float, y: float, wide: float, high: float) -> str:
    """Return where a paragraph stands on its page, mm from the top left corner."""
    box = {"w": wide, "h": high, "x": x, "y": y}
    sizes = " ".join(f'w:{name}="{round(mm * TWIPS)}"' for name, mm in box.items())
    return (
        f'<w:framePr {sizes} w:hRule="exact" w:wrap="around" w:vAnchor="page" w:hAnchor="page"/><w:jc w:val="center"/>'
    )


def _sign(word: Word, document: Document) -> None:
    """Say in the properties what the note is and whose it is, and no date."""
    from docx.opc.constants import RELATIONSHIP_TYPE as KIND

    said, page = packaged(__package__, "texts", document.language), document.title
    word.part.package.part_related_by(KIND.CORE_PROPERTIES).element[:] = []
    about = word.core_properties
    about.title = _short(f"{said['title.note']}. {page.title}")
    about.subject = _short(said["title.variant"].format(variant=page.variant))
    about.author, about.keywords = _short(page.student), _short(page.identity)
    about.language = said["locale"]


def _short(text: str) -> str:
    return note.printable(text)[:LONGEST]


def _picture(owner: Any, drawing: Drawing, number: int) -> Picture:
    """Put the picture of a figure into a part of the document."""
    from docx.opc.constants import RELATIONSHIP_TYPE as KIND
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    name = PackURI(f"/word/media/figure{number}.svg")
    part = Part(name, "image/svg+xml", drawing.svg, owner.package)
    return owner.get_or_add_image(BytesIO(drawing.png))[0], owner.relate_to(part, KIND.IMAGE)


def _undated(data: bytes) -> bytes:
    """Return a ZIP whose files have no date of today."""
    stream = BytesIO()
    with zipfile.ZipFile(BytesIO(data)) as dated, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as undated:
        for name in dated.namelist():
            undated.writestr(zipfile.ZipInfo(name, _LONG_AGO), dated.read(name), zipfile.ZIP_DEFLATED)
    return stream.getvalue()


_SHAPES = "{http://www.w3.org/2000/svg}"


def _outlined(svg: bytes) -> bytes:
    """Return a drawing whose letters are paths at the same places."""
    from lxml import etree

    root = etree.fromstring(svg)
    for text in root.findall(f".//{_SHAPES}text"):
        face = SCREEN if text.get("font-family") else SLANTED if text.get("font-style") else UPRIGHT
        size = float(text.get("font-size")) / font(face).units
        place = f"translate({text.get('x')} {text.get('y')}) scale({size:.8f} {-size:.8f})"
        path = etree.Element(f"{_SHAPES}path", d=_path(text.text or "", face))
        path.set("transform", f"{text.get('transform', '')} {place}".strip())
        for name in ("class", "data-name", "fill"):
            if text.get(name) is not None:
                path.set(name, text.get(name))
        path.tail = text.tail
        text.getparent().replace(text, path)
    for styles in root.findall(f"{_SHAPES}defs"):
        root.remove(styles)
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8"))


@cache
def _glyphs(face: str) -> tuple[dict[int, str], Any]:
    from fontTools.ttLib import TTFont

    found = TTFont(BytesIO(font(face).data), lazy=True)
    return found.getBestCmap(), found.getGlyphSet()


@lru_cache(maxsize=4096)
def _path(string: str, face: str) -> str:
    """Return letters of a face as commands of a path, in units of the font, y up."""
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen

    names, glyphs = _glyphs(face)
    pen, at = SVGPathPen(glyphs), 0
    for letter in string:
        glyph = glyphs[names[ord(letter)]]
        glyph.draw(TransformPen(pen, (1, 0, 0, 1, at, 0)))
        at += glyph.width
    return str(pen.getCommands())


def _paragraph(style: str, inside: str, properties: str = "") -> str:
    """Return a paragraph; its own properties go before those of its style."""
    styled = f'<w:pStyle w:val="{style}"/>' if style else ""
    told = f"<w:pPr>{styled}{properties}</w:pPr>" if styled or properties else ""
    return f"<w:p>{told}{inside}</w:p>"


def _words(text: str, properties: str = "") -> str:
    """Return characters of a paragraph."""
    looks = f"<w:rPr>{properties}</w:rPr>" if properties else ""
    return f'<w:r>{looks}<w:t xml:space="preserve">{quoted(text)}</w:t></w:r>' if text else ""


def line(markup: str, properties: str = "") -> str:
    """Return a line of markup: words as text with `properties`, symbols with scripts and bars as formulas."""
    parts = whole(note.parse(markup))
    told: list[tuple[bool, str]] = []
    for place, part in enumerate(parts):
        formula = not isinstance(part, note.Plain) and not note.is_unit(parts, place)
        told.append((formula, node(part, note.joined(parts, place)) if formula else _text(part, properties)))
    shown = ((formula, "".join(text for _, text in some)) for formula, some in groupby(told, lambda pair: pair[0]))
    return "".join(f"<m:oMath>{text}</m:oMath>" if formula else text for formula, text in shown)


def _text(part: note.Node, properties: str) -> str:
    """Return words, or a unit with its power."""
    if isinstance(part, note.Plain):
        return _words(note.tied(part.text), properties)
    assert isinstance(part, note.Scripted)
    assert isinstance(part.base, note.Plain)
    power = "".join(up.text for up in part.above if isinstance(up, note.Plain))
    raised = _words(power, f'{properties}<w:vertAlign w:val="superscript"/>')
    return _words(part.base.text, properties) + raised


def _begun(order: str) -> str:
    """Return the beginning of a field, up to what it shows."""
    told = f'<w:r><w:instrText xml:space="preserve"> {quoted(order)} </w:instrText></w:r>'
    return f'<w:r><w:fldChar w:fldCharType="begin"/></w:r>{told}<w:r><w:fldChar w:fldCharType="separate"/></w:r>'


def _number_field(order: str, number: int) -> str:
    """Return a field that shows a number: of a caption, or of what it refers to."""
    return _begun(order) + _words(str(number)) + _END


def _bookmark(inside: str, mark: str, number: int) -> str:
    """Return what others refer to by a mark."""
    return f'<w:bookmarkStart w:id="{number}" w:name="{mark}"/>{inside}<w:bookmarkEnd w:id="{number}"/>'


def _mark(number: int) -> str:
    return f"_Toc{number:06d}"


def _title(document: Document) -> Iterator[str]:
    said, page = packaged(__package__, "texts", document.language), document.title
    yield _paragraph("TitleLine", _words(page.department))
    yield _paragraph("Title", _words(said["title.note"]))
    yield _paragraph("Subtitle", _words(page.title))
    yield _paragraph("TitleLine", _words(said["title.variant"].format(variant=page.variant)))
    usual, looks = note.Profile(), document.profile
    share = usual.size * usual.lines / (looks.size * looks.lines)
    names, date = (f'<w:spacing w:before="{round(mm * share * TWIPS)}"/>' for mm in _BEFORE)
    for name in ("student", "group", "teacher"):
        value = _words(getattr(page, name)) or "<w:r><w:tab/></w:r>"  # to the right edge, over a line
        yield _paragraph("TitleName", f"{_words(said[f'title.{name}'])}<w:r><w:tab/></w:r>{value}", names)
        names = ""
    yield _paragraph("TitleLine", _words(page.date), date)
    yield _paragraph("TitleLine", _words(page.identity, '<w:sz w:val="18"/><w:szCs w:val="18"/>'))


def _contents(document: Document) -> Iterator[str]:
    """Go through the contents, a field with its entries; their pages are known when it is updated."""
    yield _paragraph("TOCHeading", _words(packaged(__package__, "texts", document.language)["contents"].upper()))
    before = _begun(r'TOC \o "1-2" \h \z \u')
    entries = [block for block in document.blocks if isinstance(block, Heading)]
    ends = len(entries) if isinstance(document.blocks[0], Heading) else 0  # the last entry; a heading begins its page
    counted = accumulate(block.numbered for block in entries)
    for number, (block, place) in enumerate(zip(entries, counted, strict=True), 1):
        entry = f"{f'{place} ' if block.numbered else ''}{spelled(block.text)}"
        page = _begun(rf"PAGEREF {_mark(number)} \h") + _END
        shown = f"{_words(entry)}<w:r><w:tab/></w:r>{page}"
        linked = f'<w:hyperlink w:anchor="{_mark(number)}" w:history="1">{shown}</w:hyperlink>'
        yield _paragraph("TOC1", before + linked + (_END if number == ends else ""))
        before = ""
    if not ends:
        yield _paragraph("TOC1", f'{before}{_END}<w:r><w:br w:type="page"/></w:r>')


def blocks_in_word(document: Document, pictures: Sequence[Picture]) -> str:
    """Return all that follows the contents; `pictures` are those of the figures, in order."""
    said = packaged(__package__, "texts", document.language)
    looks = document.profile
    parts = (_block(block, n, said, pictures, looks) for block, n in note.numbered(document.blocks))
    return "".join(chain.from_iterable(parts))


def _folded_in_word(document: Document, pictures: Sequence[Picture]) -> str:
    """Return the figures that stand on larger sheets at the end."""
    said = packaged(__package__, "texts", document.language)
    figures = ((block, n) for block, n in note.numbered(document.blocks) if isinstance(block, Figure) and block.folded)
    return "".join(
        _paragraph("Figure", _drawing(figure, pictures[n - 1], n), "<w:pageBreakBefore/>" if place else "")
        + _paragraph("Caption", _caption(figure, said, _number_field(rf"REF _Figure{n} \h", n)))
        for place, (figure, n) in enumerate(figures)
    )


def _block(
    block: Block, number: int, said: dict[str, str], pictures: Sequence[Picture], profile: Profile
) -> Iterator[str]:
    match block:
        case Heading(text=text, numbered=numbered):
            marked = _bookmark(line(text), _mark(number), number)  # the contents lead there
            page = "<w:pageBreakBefore/>" if number == 1 else ""  # behind the contents, however full their page is
            yield _paragraph("Heading1", marked, page + ("" if numbered else UNNUMBERED))
        case Sentences(texts=texts, leads=leads):
            yield _paragraph("", _words(" ").join(map(line, texts)), KEPT if leads else "")
        case Steps(texts=texts):
            one = f'<w:numPr><w:ilvl w:val="0"/><w:numId w:val="{LISTS + number - 1}"/></w:numPr>'
            yield from (_paragraph("ListNumber", line(text), one) for text in texts)
        case Equations():
            for chunks, of in block.told:
                yield _numbered("".join(_equation(chunks)), of) if of else "".join(_equation(chunks))
        case Table(rows=rows, caption=caption):
            if caption:
                here = _number_field(rf"SEQ {said['table']} \* ARABIC", number)
                yield _paragraph("TableCaption", f"{_words(said['table'] + ' ')}{here}{_words(' – ')}{line(caption)}")
            yield _table(rows, profile)
            yield _paragraph("Cell", "")
        case Figure():
            here = _number_field(rf"SEQ {said['figure']} \* ARABIC", number)
            if block.folded:
                before, _, after = said["figure.folded"].format(number="\0", format=note.FOLDED).partition("\0")
                marked = _bookmark(here, f"_Figure{number}", FIGURES + number)
                yield _paragraph("", _words(before) + marked + _words(after))
                return
            yield _paragraph("Figure", _drawing(block, pictures[number - 1], number))
            yield _paragraph("Caption", _caption(block, said, here))


def _numbered(equation: str, number: int) -> str:
    """Return an equation with its number at the end of the line: two cells that nothing shows."""
    widths = [round(PERCENT * mm / WIDE) for mm in (WIDE - OF_NUMBER, OF_NUMBER)]  # of a line, however wide it is
    of = _paragraph("EquationNumber", _words(f"({number})"))
    cells = "".join(
        f'<w:tc><w:tcPr><w:tcW w:w="{wide}" w:type="pct"/><w:vAlign w:val="bottom"/></w:tcPr>{inside}</w:tc>'
        for wide, inside in zip(widths, (equation, of), strict=True)
    )
    grid = "".join(f'<w:gridCol w:w="{round(mm * TWIPS)}"/>' for mm in (WIDE - OF_NUMBER, OF_NUMBER))
    none = '<w:tblCellMar><w:left w:w="0" w:type="dxa"/><w:right w:w="0" w:type="dxa"/></w:tblCellMar>'
    whole = f'<w:tblW w:w="{sum(widths)}" w:type="pct"/><w:tblLayout w:type="fixed"/>{none}'
    row = f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{cells}</w:tr>"
    return f"<w:tbl><w:tblPr>{whole}</w:tblPr><w:tblGrid>{grid}</w:tblGrid>{row}</w:tbl>"


def _equation(chunks: Sequence[str]) -> Iterator[str]:
    """Go through the lines of an equation, which is broken where it may be; words without one are a line of words."""
    markup = " ".join(chunks)
    if not displayed(markup):
        yield _paragraph("Equation", line(markup))
        return
    rows = [""]
    for part in _unbroken(chunks):
        longer = f"{rows[-1]} {part}".strip()
        rows[-1:] = [longer] if not rows[-1] or _fits(longer, 1 if len(rows) == 1 else 2) else [rows[-1], part]
    for place, row in enumerate(rows):
        further = f'<w:ind w:left="{round(2 * INDENT * TWIPS)}"/>' if place else ""
        left = '<m:oMathParaPr><m:jc m:val="left"/></m:oMathParaPr>'
        inside = f"<m:oMathPara>{left}<m:oMath>{built_up(row)}</m:oMath></m:oMathPara>"
        yield _paragraph("Equation", inside, further)


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
    return lay_out(markup, HEIGHT).width <= WIDE - OF_NUMBER - indents * INDENT


def _table(rows: tuple[tuple[str | None, ...], ...], profile: Profile) -> str:
    """Return a table whose first row is repeated on every page; no row is parted by the end of a page."""
    wide = [PAD] * len(rows[0])
    times = SERIF * profile.size / note.Profile().size
    for row in rows:
        for start, end, cell in cells_of(row):
            if end == start + 1:
                wide[start] = max(wide[start], lay_out(cell, HEIGHT).width * times + PAD)
    most = _narrowed(wide, profile.wide)
    grid = "".join(f'<w:gridCol w:w="{round(min(mm, most) * TWIPS)}"/>' for mm in wide)
    look = '<w:tblLook w:val="0020" w:firstRow="1" w:lastRow="0" w:firstColumn="0" w:lastColumn="0"'
    properties = (
        '<w:tblPr><w:tblStyle w:val="TableGrid"/><w:tblW w:w="0" w:type="auto"/><w:jc w:val="center"/>'
        f'{look} w:noHBand="1" w:noVBand="1"/></w:tblPr>'
    )
    few = TOGETHER + 1  # with the head
    kept = (n < few - 1 or len(rows) - few < n < len(rows) - 1 for n in count())
    body = "".join(map(_row, rows, count(), kept))
    return f"<w:tbl>{properties}<w:tblGrid>{grid}</w:tblGrid>{body}</w:tbl>"


def _narrowed(wide: Sequence[float], room: float) -> float:
    """Return how wide the widest columns of a table may be, mm, for all to stand in a room; the others stay."""
    left, several = room, len(wide)
    for mm in sorted(wide):
        if mm * several >= left:
            return left / several
        left, several = left - mm, several - 1
    return max(wide)


def _row(row: tuple[str | None, ...], number: int, kept: bool) -> str:
    head, bold = ("<w:tblHeader/>", "<w:b/><w:bCs/>") if number == 0 else ("", "")
    cells = []
    for start, end, cell in cells_of(row):
        spanned = f'<w:gridSpan w:val="{end - start}"/>' if end - start > 1 else ""
        text = _paragraph("Cell", line(cell, bold), KEPT if kept else "")
        cells.append(
            f'<w:tc><w:tcPr><w:tcW w:w="0" w:type="auto"/>{spanned}<w:vAlign w:val="center"/></w:tcPr>{text}</w:tc>'
        )
    return f"<w:tr><w:trPr><w:cantSplit/>{head}</w:trPr>{''.join(cells)}</w:tr>"


def _caption(figure: Figure, said: dict[str, str], number: str) -> str:
    lines = [line(text) for text in (figure.caption, *note.said_under(figure, said))]
    return f"{_words(said['figure'] + ' ')}{number}{_words(' – ')}" + "<w:r><w:br/></w:r>".join(lines)


def _drawing(figure: Figure, picture: Picture, number: int) -> str:
    """Return a picture as large as the figure is shown; what it shows is told to who cannot see it."""
    cx, cy = (round(mm * figure.share * EMU) for mm in figure.view.size)
    told = quoted("; ".join(map(spelled, (figure.caption, *figure.under))))
    name, size = f'id="{number}" name="{quoted(figure.view.name)}" descr="{told}"', f'cx="{cx}" cy="{cy}"'
    return (
        f'<w:r><w:drawing><wp:inline distT="0" distB="0" distL="0" distR="0"><wp:extent {size}/><wp:docPr {name}/>'
        f"{_graphic(picture, name, size)}</wp:inline></w:drawing></w:r>"
    )


def _behind(picture: Picture, number: int, extent: tuple[int, int]) -> str:
    """Return a picture that covers its page behind the text."""
    name, size = f'id="{number}" name="frame{number}"', f'cx="{extent[0]}" cy="{extent[1]}"'
    at = "".join(
        f'<wp:position{way} relativeFrom="page"><wp:posOffset>0</wp:posOffset></wp:position{way}>' for way in "HV"
    )
    return (
        '<w:r><w:drawing><wp:anchor distT="0" distB="0" distL="0" distR="0" simplePos="0" relativeHeight="0" '
        'behindDoc="1" locked="0" layoutInCell="1" allowOverlap="1"><wp:simplePos x="0" y="0"/>'
        f'{at}<wp:extent {size}/><wp:effectExtent l="0" t="0" r="0" b="0"/><wp:wrapNone/><wp:docPr {name}/>'
        f"<wp:cNvGraphicFramePr/>{_graphic(picture, name, size)}</wp:anchor></w:drawing></w:r>"
    )


def _graphic(picture: Picture, name: str, size: str) -> str:
    sharp = (
        f'<a:extLst><a:ext uri="{{96DAC541-7B7A-43D3-8B79-37D633B846F1}}"><asvg:svgBlip xmlns:asvg="{_SVG}" '
        f'r:embed="{picture[1]}"/></a:ext></a:extLst>'
    )
    return (
        f'<a:graphic xmlns:a="{_PICTURES}/main"><a:graphicData uri="{_PICTURES}/picture">'
        f'<pic:pic xmlns:pic="{_PICTURES}/picture"><pic:nvPicPr><pic:cNvPr {name}/><pic:cNvPicPr/></pic:nvPicPr>'
        f'<pic:blipFill><a:blip r:embed="{picture[0]}">{sharp}</a:blip>'
        "<a:stretch><a:fillRect/></a:stretch></pic:blipFill>"
        f'<pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext {size}/></a:xfrm>'
        '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr></pic:pic></a:graphicData></a:graphic>'
    )
