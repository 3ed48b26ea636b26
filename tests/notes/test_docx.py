"""The note as DOCX: all that the note says, numbers and underlines as in it, pictures true to size, XML in order."""

from __future__ import annotations

import re
import sys
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from io import BytesIO
from itertools import accumulate
from math import sqrt
from pathlib import Path
from typing import Any

import docx
import matplotlib
import pytest
from fontTools.ttLib import TTFont
from lxml import etree
from PIL import Image

from kulman import batch, note
from kulman.drawing.notes.blocks import (
    Document,
    Equations,
    Figure,
    Heading,
    Sentences,
    Steps,
    Table,
    displayed,
)
from kulman.drawing.notes.docx import SPACES, _folded_in_word, _unbroken, blocks_in_word, docx_bytes, line
from kulman.drawing.notes.markdown import markdown
from kulman.drawing.notes.omml import built_up
from kulman.drawing.text import spelled
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run

NUMBER = re.compile(r"\d+(?:[.,]\d+)*")
ARITHMETIC = re.compile(r"[\d.,()·/+−√^{} ]+")
EMU = 36000
W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
M = "{http://schemas.openxmlformats.org/officeDocument/2006/math}"
A = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
R = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
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
    f"{W}settings": "zoom defaultTabStop autoHyphenation characterSpacingControl updateFields compat mathPr "
    "themeFontLang",
    f"{M}mathPr": "mathFont brkBin smallFrac dispDef lMargin rMargin defJc wrapIndent",
    f"{M}oMathPara": "oMathParaPr oMath",
    **{f"{M}r": "rPr t", f"{M}f": "num den", f"{M}rad": "radPr deg e", f"{M}d": "dPr e", f"{M}dPr": "begChr endChr"},
    **{f"{M}bar": "barPr e", f"{M}sSub": "e sub", f"{M}sSup": "e sup", f"{M}sSubSup": "e sub sup"},
}


def part(data: bytes, name: str) -> Any:
    """Return a part of a document, read without anything but a parser of XML."""
    return etree.fromstring(zipfile.ZipFile(BytesIO(data)).read(f"word/{name}.xml"))


def disordered(root: Any) -> list[str]:
    """Return the elements whose parts stand in a wrong order, or are not known."""
    found = []
    for element in root.iter(*ORDER):
        places, names = ORDER[element.tag].split(), [etree.QName(child).localname for child in element]
        if not set(names) <= set(places) or names != sorted(names, key=places.index):
            found.append(f"{element.tag}: {names}")
    return found


def said(element: Any) -> str:
    """Return what is said: `((a)/(b))` for fractions, `√(a)`, `_{...}`, `^{...}`, `\\bar{...}`, `\\u{...}`."""
    kind = etree.QName(element)
    if kind.localname in ("t", "br", "tab"):
        return {"br": "\n", "tab": "\t"}.get(kind.localname, element.text or "")
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


def parsed(xml: str) -> Any:
    """Return pieces of a document as elements."""
    names = " ".join(f'xmlns:{short}="{name}"' for short, name in SPACES.items())
    return etree.fromstring(f"<w:body {names}>{xml}</w:body>")


def paragraphs(root: Any) -> list[tuple[str, str]]:
    """Return the styles and texts of the paragraphs."""
    styles = ((p, p.find(f"{W}pPr/{W}pStyle")) for p in root.iter(f"{W}p"))
    return [("" if style is None else style.get(f"{W}val"), said(paragraph)) for paragraph, style in styles]


def bare(text: str) -> str:
    """Return a line without spaces, and without what tells scripts and bars from letters."""
    return re.sub(r"\\bar|\\u|[\s\u200b\u2060{}_^]", "", text)


@cache
def document_of() -> Document:
    return note("nau-slider-crank", only="velocity", student="І. Петренко", date="2026").document


@cache
def written() -> bytes:
    return docx_bytes(document_of())


def word_of(data: bytes) -> Any:
    """Return a document as the library reads it."""
    return docx.Document(BytesIO(data))


def kinds(kind: type[Any]) -> list[Any]:
    return [block for block in document_of().blocks if isinstance(block, kind)]


def test_a_document_is_read_by_the_library_with_its_looks() -> None:
    word = word_of(written())
    section = word.sections[0]

    sizes = (section.page_width, section.page_height, section.left_margin, section.right_margin)
    assert [round(size.mm) for size in sizes] == [210, 297, 20, 10]
    assert section.different_first_page_header_footer
    assert " PAGE " in section.footer.part.blob.decode()
    assert {"Heading 1", "Title", "toc 1", "Caption", "List Number"} <= {style.name for style in word.styles}
    assert word.core_properties.title.startswith("Пояснювальна записка. ")
    assert (word.core_properties.author, word.core_properties.language) == ("І. Петренко", "uk-UA")
    tables = list(part(written(), "document").iter(f"{W}tblStyle"))  # an equation and its number have none
    assert len(tables) == len(list(part(written(), "document").iter(f"{W}tblHeader"))) == len(kinds(Table))
    for name in ("document", "styles", "numbering", "settings", "footer1"):
        assert disordered(part(written(), name)) == []


def test_what_leads_somewhere_leads_there_and_the_contents_to_every_heading() -> None:
    body, headings = part(written(), "document"), kinds(Heading)
    told = paragraphs(body)

    marks = {mark.get(f"{W}name") for mark in body.iter(f"{W}bookmarkStart")}
    assert {link.get(f"{W}anchor") for link in body.iter(f"{W}hyperlink")} == marks
    assert len(marks) == len(headings)
    entries = [line.strip() for style, line in told if style == "TOC1" and line.strip()]
    counted = accumulate(heading.numbered for heading in headings)
    assert entries == [
        f"{number} {spelled(one.text)}" if one.numbered else one.text
        for one, number in zip(headings, counted, strict=True)
    ]
    assert [one.text for one in headings if not one.numbered] == ["ВСТУП", "ВИСНОВКИ", "СПИСОК ВИКОРИСТАНИХ ДЖЕРЕЛ"]
    styles = {style.get(f"{W}styleId") for style in part(written(), "styles").iter(f"{W}style")}
    assert {style for style, _ in told} - {""} <= styles
    lists = {item.get(f"{W}numId") for item in part(written(), "numbering").iter(f"{W}num")}
    used = {item.get(f"{W}val") for item in body.iter(f"{W}numId")} - {"0"}
    assert used <= lists
    assert len(used) == len(kinds(Steps))


def assert_all_blocks(document: Document, body: Any, told: list[tuple[str, str]]) -> None:
    text = [bare(line) for _, line in told]
    headings = [bare(spelled(block.text)) for block in document.blocks if isinstance(block, Heading)]
    assert [bare(line) for style, line in told if style == "Heading1"] == headings
    for block in document.blocks:
        match block:
            case Sentences(texts=texts):
                assert bare(" ".join(map(spelled, texts))) in text
            case Steps(texts=texts):
                assert {bare(spelled(step)) for step in texts} <= set(text)
            case Figure(caption=caption):
                assert any(bare(spelled(caption)) in bare(line) for style, line in told if style == "Caption")
    tables = [block for block in document.blocks if isinstance(block, Table)]
    shown = [table for table in body.findall(f"{W}tbl") if table.find(f"{W}tblPr/{W}tblStyle") is not None]
    for block, table in zip(tables, shown, strict=True):
        cells = [bare(spelled(cell)) for row in block.rows for cell in row if cell]
        assert cells == [bare(line) for _, line in paragraphs(table) if line]


def value(text: str) -> float:
    """Return what arithmetic comes to; a script is a power."""
    for sign, python in (("√", "sqrt"), ("^{", "**("), ("}", ")"), ("·", "*"), ("−", "-"), (",", "."), ("\u200b", "")):
        text = text.replace(sign, python)
    return float(eval(text, {"sqrt": sqrt}))


def sides(document: Document) -> Iterator[tuple[str, str]]:
    """Go through the sides of all equations that are arithmetic: as the note has them, and as they are built up."""
    for block in document.blocks:
        for markup in map(" ".join, block.lines if isinstance(block, Equations) else ()):
            if displayed(markup):
                built = said(parsed(built_up(markup))).split("=")
                for plain, side in zip(markup.split("="), built, strict=True):
                    if ARITHMETIC.fullmatch(plain) and "/" in plain and plain.count("(") == plain.count(")"):
                        yield plain, side


def assert_a_document_says_all(document: Document) -> None:
    pictures = [("rId1", "rId2")] * sum(isinstance(block, Figure) for block in document.blocks)
    body = parsed(blocks_in_word(document, pictures) + _folded_in_word(document, pictures))
    told = paragraphs(body)

    assert disordered(body) == []
    assert_all_blocks(document, body, told)
    shown = re.sub(r"^\d+\. |^!\[.*$", "", markdown(document, ["x"] * len(document.blocks)), flags=re.MULTILINE)
    shown = re.sub(r"</?(?:sup|sub|u)>", " ", shown.partition("\n## ")[2])
    assert Counter(NUMBER.findall(shown)) - Counter(NUMBER.findall(" ".join(line for _, line in told))) == Counter()
    pairs = list(sides(document))
    assert pairs
    assert [value(built) for _, built in pairs] == pytest.approx([value(plain) for plain, _ in pairs], rel=1e-12)


def test_the_document_says_what_the_note_says() -> None:
    assert_a_document_says_all(document_of())


def assert_it_becomes_a_document(document: Document) -> None:
    data = docx_bytes(document)

    figures = sum(isinstance(block, Figure) for block in document.blocks)
    assert len(word_of(data).inline_shapes) == figures
    assert disordered(part(data, "document")) == []


def test_a_class_has_its_notes_of_the_same_bytes_without_a_date(tmp_path: Path) -> None:
    with zipfile.ZipFile(BytesIO(written())) as archive:
        assert {entry.date_time[:3] for entry in archive.infolist()} == {(1980, 1, 1)}
        assert b"created" not in archive.read("docProps/core.xml")

    (tmp_path / "class.csv").write_text("student;group;variant\nІ. Петренко;ММ-31;3\n", encoding="utf-8")
    batch("nau-slider-crank", tmp_path / "class.csv", tmp_path / "out", kinds=["docx"], only="structure", jobs=1)
    alone = note("nau-slider-crank", "3", only="structure", student="І. Петренко", group="ММ-31").document
    (file,) = (tmp_path / "out").glob("*.docx")
    assert file.name == "001-І-Петренко-3-note.docx"
    assert file.read_bytes() == docx_bytes(alone)


@pytest.mark.parametrize(
    ("markup", "shown"),
    [
        (r"\u{\bar{V}_{B}} = \uu{\bar{V}_{A}} + \bar{V}_{BA}", r"\u{\bar{V}_{B}}=\u{\u{\bar{V}_{A}}}+\bar{V}_{BA}"),
        ("a^{n}_{BA} = V^{2}_{BA}/l_{AB}", "a^{n}_{BA}=((V^{2}_{BA})/(l_{AB}))"),
        ("π·2000/30 = 209,4 рад/с", "((π·2000)/(30))=209,4 рад/с"),
        ("(a + b)/c·d", "((a+b)/(c))·d"),
        ("(a + b)^{2}/(c·d)", "(((a+b)^{2})/(c·d))"),
        ("a/b/c", "((((a)/(b)))/(c))"),
        ("√((C_{1} + C_{2})/m)", "√(((C_{1}+C_{2})/(m)))"),
        ("π/2·cos^{2} α", "((π)/(2))·cos^{2} α"),
        ("tg α/sin 20°", "((tg α)/(sin 20°))"),
        ("+ M_{i2})/l_{AB} =", "+M_{i2})/l_{AB}="),
        ("0,0654 (м/с^{2})/мм", "0,0654 (м/с^{2})/мм"),
        ("10^{11}/6^{3}", "((10^{11})/(6^{3}))"),
        ("= 0.1745 rad/s, clockwise", "=0.1745 rad/s, clockwise"),
        ("ω·(ds/dφ)_{max}", "ω·(((ds)/(dφ)))_{max}"),
        ("a < b & c", "a<b&c"),
    ],
)
def test_an_equation_is_built_up(markup: str, shown: str) -> None:
    assert said(parsed(built_up(markup))) == shown


@pytest.mark.parametrize(
    ("markup", "formulas"),
    [
        *(("M_{a} = 0.05 (cm/s^{2})/cm", ["M_{a}"]), ("23,95 (м/с^{2})/мм", []), ("mm^{2}", []), ("m^{4}", [])),
        *(("kg·m^{2}", []), ("вектор \\bar{V}_{B}, k^{2}", ["\\bar{V}_{B}", "k^{2}"])),
        ("O_{1}A_{1}", ["O_{1}A_{1}"]),
    ],
)
def test_units_are_words_and_symbols_formulas(markup: str, formulas: list[str]) -> None:
    found = parsed(line(markup))

    assert [said(formula) for formula in found.iter(f"{M}oMath")] == formulas
    assert bare(said(found)) == bare(spelled(markup))
    tied = parsed(line("r_{0} = 45.26 mm, more"))  # no line ends between a letter, its number and the unit
    assert said(tied) == "r_{0}\u00a0= 45.26\u00a0mm, more"
    opposite = parsed(line(r"\bar{R}_{21} = −\bar{R}_{12}"))  # nor between a minus and what it is of
    assert "= −\u2060" in said(opposite)


@pytest.mark.parametrize("write", [line, built_up])
@pytest.mark.parametrize(
    ("markup", "slanted"),
    [("d^{2}s/dφ^{2}", ""), ("O_{1}B", ""), ("ω^{2}·r_{0}", "ωr"), ("P_{1}B_{1}", "PB"), ("II_{2}(2, 3)", "")],
)
def test_letters_of_one_word_are_all_upright(markup: str, slanted: str, write: Callable[[str], str]) -> None:
    found = parsed(write(markup))

    letter = "".join(said(run) for run in found.iter(f"{M}r") if run.find(f"{M}rPr") is None)
    assert "".join(c for c in letter if c.isalpha()) == slanted


def test_pictures_are_as_large_as_the_figures() -> None:
    word = word_of(written())

    for figure, shape in zip(kinds(Figure), word.inline_shapes, strict=True):
        size = [mm * figure.share for mm in figure.view.size]
        assert (shape.width, shape.height) == tuple(round(mm * EMU) for mm in size)
        assert spelled(figure.caption) in shape._inline.docPr.get("descr")
        blip = next(shape._inline.iter(f"{A}blip"))
        png = Image.open(BytesIO(word.part.related_parts[blip.embed].blob))
        assert [n / 300 * 25.4 for n in png.size] == pytest.approx(size, abs=25.4 / 300)
        sharp = next(element for element in blip.iter() if element.tag.endswith("svgBlip"))
        svg = etree.fromstring(word.part.related_parts[sharp.get(f"{R}embed")].blob)
        sides = [float(svg.get(name).removesuffix("mm")) for name in ("width", "height")]
        assert sides == pytest.approx(figure.view.size, abs=1e-6)
        assert {etree.QName(element).localname for element in svg.iter()} & {"text", "style", "image"} == set()


def test_names_that_are_missing_are_a_line_to_the_edge_and_the_text_begins_its_page_itself() -> None:
    looks = note("nau-slider-crank", "3", only="velocity", lang="ru", student="І. Петренко").document

    paragraphs = [*part(docx_bytes(looks), "document").iter(f"{W}p")]

    names = [one for one in paragraphs if "TitleName" in [of.get(f"{W}val") for of in one.iter(f"{W}pStyle")]]
    assert [len([*one.iter(f"{W}tab")]) for one in names] == [1, 2, 2]  # the student, group and teacher
    assert not any("_" in text for one in names for text in one.itertext())
    assert not any(True for one in paragraphs for _ in one.iter(f"{W}br") if _.get(f"{W}type") == "page")
    assert sum(1 for one in paragraphs for _ in one.iter(f"{W}pageBreakBefore")) == 1


@pytest.mark.parametrize("profile", ["plain", "dstu3008"])
def test_the_title_is_one_page_under_a_title_of_two_lines(profile: str) -> None:
    looks = note("nau-slider-crank", "3", only="velocity", student="І. Петренко", profile=profile).document
    high = looks.profile.size * looks.profile.lines * 1.15 / 72 * 25.4  # of a line of Times New Roman

    body = part(docx_bytes(looks), "document")

    lines, apart = 1, 3402 / 1440 * 25.4  # what a long title has more, what stands before the heading
    for paragraph in body.iter(f"{W}p"):
        style = next((of.get(f"{W}val") for of in paragraph.iter(f"{W}pStyle")), "")
        if style == "TOCHeading":
            break
        lines += 1
        apart += (
            120 / 1440 * 25.4
            + sum(int(space.get(f"{W}before", "0")) for space in paragraph.iter(f"{W}spacing")) / 1440 * 25.4
        )
    assert lines > 8
    assert lines * high + apart < 297.0 - looks.profile.top - looks.profile.bottom


@pytest.mark.soak
@pytest.mark.parametrize("profile", some(["plain", "dstu3008"], 0))
def test_no_column_of_a_table_parts_a_word_or_a_number(profile: str) -> None:
    document = note("nau-slider-crank", "3", lang="uk", profile=profile).document
    bold = TTFont(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "STIXGeneralBol.ttf")
    widths, letter = bold["hmtx"], bold.getBestCmap()
    em = document.profile.size / 72 * 25.4 / bold["head"].unitsPerEm

    body = part(docx_bytes(document), "document")

    for table in body.iter(f"{W}tbl"):
        wide = [int(column.get(f"{W}w")) / 1440 * 25.4 for column in table.iter(f"{W}gridCol")]
        if len(wide) == 2:  # an equation and its number
            continue
        rows = [[said(cell).split() for cell in row.iter(f"{W}tc")] for row in table.iter(f"{W}tr")]
        rows = [[[word for word in words if not {*"_^"} & {*word}] for words in row] for row in rows]  # no scripts
        for row in (row for row in rows if len(row) == len(wide)):
            for column, words in zip(wide, row, strict=True):
                long = max((sum(widths[letter[ord(c)]][0] for c in word) * em for word in words), default=0.0)
                assert long <= column - 3.81, words
        assert sum(wide) <= document.profile.wide + 0.1


def test_a_figure_too_large_for_a_page_stands_on_a_larger_one() -> None:
    document, figure = document_of(), kinds(Figure)[0]
    large = replace(figure, view=replace(figure.view, box=(-200.0, -250.0, 200.0, 250.0)))
    after = document.blocks[document.blocks.index(figure) :]

    data = docx_bytes(replace(document, blocks=(large, *after)))

    word, body = word_of(data), part(data, "document")
    assert [round(section.page_width.mm) for section in word.sections] == [210, 297]
    assert [section.different_first_page_header_footer for section in word.sections] == [True, False]
    last = word.inline_shapes[len(word.inline_shapes) - 1]
    assert (last.width.mm, last.height.mm) == pytest.approx((267.0, 267.0 * 500 / 400), abs=1e-4)
    told = [line for _, line in paragraphs(body)]
    assert any(line.startswith("Рисунок 1 вміщено на аркуші A3") for line in told)
    assert told[-1].startswith("Рисунок 1 – ")
    assert disordered(body) == []
    (mark,) = (m.get(f"{W}name") for m in body.iter(f"{W}bookmarkStart") if m.get(f"{W}name").startswith("_Figure"))
    assert f" REF {mark} \\h " in [order.text for order in body.iter(f"{W}instrText")]


def few_words(**title: str) -> Document:
    document = document_of()
    return replace(document, blocks=document.blocks[:2], title=replace(document.title, **title))


@pytest.mark.parametrize(
    "name",
    [
        *("</w:t><w:br/>", "<!--", "]]>", "&amp;", "\x00\x07\x1b", "\u202eab\u2066", "שלום", "\ufffe", "\ud800", "😀"),
        *("a" * 300, "{lang}"),
    ],
)
def test_a_name_is_never_taken_for_a_sign(name: str) -> None:
    data = docx_bytes(few_words(student=name, teacher=name, date=name, title=name))

    word = word_of(data)
    plain = "".join(c if c.isprintable() else " " for c in name)
    texts = [paragraph.text for paragraph in word.paragraphs]
    assert texts.count(plain) == 2
    assert sum(text.endswith(f"\t{plain}") for text in texts) == 2
    assert word.core_properties.author == plain[:255]
    assert disordered(part(data, "document")) == []


@pytest.mark.parametrize("library", ["docx", "fontTools", "pypdfium2"])
def test_without_the_extra_a_line_says_so_and_nothing_is_written(
    library: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    files = [argument for kind in ("md", "docx") for argument in ("-o", str(tmp_path / f"a.{kind}"))]

    status, out, err = run("note", "nau-slider-crank", "--only", "structure", *files)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "pip install fonttools pypdfium2 python-docx" in err
    assert list(tmp_path.iterdir()) == []


def test_a_framed_note_has_its_frames_behind_the_text_and_numbers_in_their_cells() -> None:
    pages = word_of(docx_bytes(note("nau-slider-crank", "3", profile="dstu3008").document))
    first, own = pages.sections
    headers = [part.part for part in (first.header, own.first_page_header, own.header)]
    fields = [re.findall(r' w:x="(\d+)"|instr=" (\w+) "', part.blob.decode()) for part in headers]

    assert [own.different_first_page_header_footer, first.different_first_page_header_footer] == [True, False]
    assert [["".join(field) for field in found] for found in fields] == [
        [],
        ["9638", "PAGE", "10488", "NUMPAGES"],
        ["11055", "PAGE"],
    ]
    for part in headers:
        assert 'behindDoc="1"' in part.blob.decode()
        pictures = {rel.target_part.partname.ext for rel in part.rels.values()}
        assert pictures == {"png", "svg"}
    assert len({rel.target_part.sha1 for part in headers for rel in part.rels.values() if "png" in rel.target_ref}) == 3


def test_equations_are_broken_in_no_brackets_that_a_line_holds() -> None:
    chunks = ["a =", "(b +", "[c −", "d])·e", "+ f", "= (g", "+ h)"]

    assert [*_unbroken(chunks)] == ["a =", "(b + [c − d])·e", "+ f", "= (g + h)"]
    assert [*_unbroken(["(" + "b" * 200, "+ c)"])] == ["(" + "b" * 200, "+ c)"]
