"""A note as DOCX (extra `docx`): the document for word processors with its styles, lists, page numbers, pictures."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Sequence
from functools import cache, lru_cache
from importlib.util import find_spec
from io import BytesIO
from typing import TYPE_CHECKING, Any, NamedTuple

from ...scales.errors import InputError
from ...scales.packaged import home, packaged
from ..font import font
from ..formats import FORMATS
from ..pdf import write_png
from .blocks import FOLDED, Block, Document, Figure, Steps, figure_page, figure_svg
from .markup import printable
from .wordprocessing import LISTS, Picture, blocks_in_word, first_pages, folded_in_word, paragraph, shown_share, words

if TYPE_CHECKING:
    from docx.document import Document as Word


LIBRARIES = ("docx", "fontTools", "pypdfium2")  # for the document, the letters and the dots of its pictures
DPI = 300  # of the pictures for readers that draw no SVG, as large as they are shown
LONGEST = 255  # characters of a property of a document
LANGUAGES = {"uk": "uk-UA", "ru": "ru-RU", "en": "en-GB"}
SPACES = {
    "w": "http://schemas.openxmlformats.org/wordprocessingml/2006/main",
    "m": "http://schemas.openxmlformats.org/officeDocument/2006/math",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
}
_FOOTER = paragraph("Footer", f'<w:fldSimple w:instr=" PAGE ">{words("2")}</w:fldSimple>')
_LONG_AGO = (1980, 1, 1, 0, 0, 0)  # the first date that a file in a ZIP can have: the same note, the same bytes


class Drawing(NamedTuple):
    """A figure as PNG, and as SVG with outlines for letters."""

    png: bytes
    svg: bytes


def docx_bytes(document: Document, drawings: Sequence[Drawing] | None = None) -> bytes:
    """Return a note as DOCX; the same note gives the same bytes.

    Parameters
    ----------
    drawings : sequence of Drawing, optional
        Those of its figures, where they are drawn already for another note with the same blocks.

    Raises InputError: the extra `docx` is not installed.
    """
    _needs_libraries()
    import docx.shared

    word = docx.Document()
    _dress(word, document)
    _pages(word)
    _sign(word, document)
    drawings = drawings_of(document.blocks, document.language) if drawings is None else drawings
    pictures = [_picture(word, drawing, number) for number, drawing in enumerate(drawings, 1)]
    _append(word, f"{first_pages(document)}{blocks_in_word(document, pictures)}")
    if any(isinstance(block, Figure) and block.folded for block in document.blocks):
        section, sheet = word.add_section(), FORMATS[f"{FOLDED}-portrait"]  # for what is too large for a page
        section.page_width, section.page_height = docx.shared.Mm(sheet.width), docx.shared.Mm(sheet.height)
        section.different_first_page_header_footer = False  # numbers of pages go on
        _append(word, folded_in_word(document, pictures))
    stream = BytesIO()
    word.save(stream)
    return _undated(stream.getvalue())


def drawings_of(blocks: Iterable[Block], language: str) -> list[Drawing]:
    """Draw the figures of a note; errors as of `docx_bytes`."""
    _needs_libraries()
    drawings = []
    for figure in (block for block in blocks if isinstance(block, Figure)):
        png = BytesIO()
        write_png([figure_page(figure, language)], png, DPI * shown_share(figure))
        drawings.append(Drawing(png.getvalue(), outlined(figure_svg(figure, language))))
    return drawings


def _needs_libraries() -> None:
    if any(find_spec(name) is None for name in LIBRARIES):
        raise InputError("extra-missing", extra="docx", suffix=".docx")


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
        filled = parse_xml(text.format(lang=LANGUAGES[document.language], lists=numbers))
        parts.part_related_by(kind).element[:] = list(filled)


def _pages(word: Word) -> None:
    """Set the pages: A4 with the margins of the PDF, a number at the foot of all but the first."""
    from docx.shared import Mm

    section = word.sections[0]
    section.page_width, section.page_height = Mm(210), Mm(297)
    section.left_margin, section.right_margin = Mm(20), Mm(10)
    section.top_margin, section.bottom_margin = Mm(15), Mm(20)
    section.header_distance = section.footer_distance = Mm(10)
    section.different_first_page_header_footer = True
    section.footer.is_linked_to_previous = False
    section.footer.part.element[:] = _parsed(_FOOTER)


def _sign(word: Word, document: Document) -> None:
    """Say in the properties what the note is and whose it is, and no date."""
    from docx.opc.constants import RELATIONSHIP_TYPE as KIND

    said, page = packaged(__package__, "texts", document.language), document.title
    word.part.package.part_related_by(KIND.CORE_PROPERTIES).element[:] = []
    about = word.core_properties
    about.title = _short(f"{said['title.note']}. {page.title}")
    about.subject = _short(said["title.variant"].format(variant=page.variant))
    about.author, about.keywords = _short(page.student), _short(page.identity)
    about.language = LANGUAGES[document.language]


def _short(text: str) -> str:
    return printable(text)[:LONGEST]


def _picture(word: Word, drawing: Drawing, number: int) -> Picture:
    """Put the picture of a figure into the document."""
    from docx.opc.constants import RELATIONSHIP_TYPE as KIND
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    name = PackURI(f"/word/media/figure{number}.svg")
    part = Part(name, "image/svg+xml", drawing.svg, word.part.package)
    return Picture(word.part.get_or_add_image(BytesIO(drawing.png))[0], word.part.relate_to(part, KIND.IMAGE))


def _undated(data: bytes) -> bytes:
    """Return a ZIP whose files have no date of today."""
    stream = BytesIO()
    with zipfile.ZipFile(BytesIO(data)) as dated, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as undated:
        for name in dated.namelist():
            undated.writestr(zipfile.ZipInfo(name, _LONG_AGO), dated.read(name), zipfile.ZIP_DEFLATED)
    return stream.getvalue()


_SVG = "{http://www.w3.org/2000/svg}"


def outlined(svg: bytes) -> bytes:
    """Return a drawing whose letters are paths at the same places."""
    from lxml import etree

    root = etree.fromstring(svg)
    for text in root.findall(f".//{_SVG}text"):
        size = float(text.get("font-size")) / font().units
        place = f"translate({text.get('x')} {text.get('y')}) scale({size:.8f} {-size:.8f})"
        path = etree.Element(f"{_SVG}path", d=_path(text.text or ""))
        path.set("transform", f"{text.get('transform', '')} {place}".strip())
        for name in ("class", "data-name", "fill"):
            if text.get(name) is not None:
                path.set(name, text.get(name))
        path.tail = text.tail
        text.getparent().replace(text, path)
    for style in root.findall(f"{_SVG}style"):
        root.remove(style)
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8"))


@cache
def _glyphs() -> tuple[dict[int, str], Any]:
    from fontTools.ttLib import TTFont

    found = TTFont(BytesIO(font().data), lazy=True)
    return found.getBestCmap(), found.getGlyphSet()


@lru_cache(maxsize=4096)
def _path(string: str) -> str:
    """Return letters as commands of a path, in units of the font, y up."""
    from fontTools.pens.svgPathPen import SVGPathPen
    from fontTools.pens.transformPen import TransformPen

    names, glyphs = _glyphs()
    pen, at = SVGPathPen(glyphs), 0
    for letter in string:
        glyph = glyphs[names[ord(letter)]]
        glyph.draw(TransformPen(pen, (1, 0, 0, 1, at, 0)))
        at += glyph.width
    return str(pen.getCommands())
