"""A note as PDF by typst: the document in its language, the figures as SVG at their true size."""

from __future__ import annotations

import importlib.util
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...scales.errors import InputError
from ...scales.packaged import packaged
from ..view import cells
from . import blocks as note
from .blocks import Block, Document, Equations, Figure, Heading, Sentences, Steps, Table

PREAMBLE = """\
#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (left: 20mm, right: 10mm, top: 15mm, bottom: 20mm), numbering: "1", number-align: center)
#set text(font: ("Libertinus Serif", "DejaVu Sans"), size: 12pt, lang: {lang})
#set par(justify: true, leading: 0.7em, spacing: 0.8em)
#set heading(numbering: "1")
#show heading: set text(size: 13pt)
#show heading: set block(above: 1.4em, below: 0.8em, sticky: true)
#set table(stroke: 0.5pt, inset: 4pt)
#show figure: set block(breakable: false)
#set figure.caption(separator: [ – ])
#show math.equation: set text(font: ("New Computer Modern Math", "Libertinus Serif", "DejaVu Sans"))
#let equation(body) = block(inset: (left: 8mm), spacing: 0.75em, body)
"""


@dataclass(frozen=True, slots=True)
class Body:
    """What follows the first page: its text in the language of typst, its figures by file."""

    text: str
    figures: Mapping[str, bytes]

    @classmethod
    def of(cls, blocks: Sequence[Block], language: str) -> Body:
        """Write the blocks of a note."""
        said = packaged(__package__, "texts", language)
        texts = [_block(block, number, said) for block, number in note.numbered(blocks)]
        figures = [(block, number) for block, number in note.numbered(blocks) if isinstance(block, Figure)]
        for figure, number in figures:
            if figure.folded:  # on its sheet, with its number
                text = _figure(figure, said, number, f'numbering: _ => "{number}", ')
                texts.append(f'#page(paper: "{note.FOLDED.lower()}")[{text}]\n')
        return cls("\n".join(texts), {f"{number}.svg": note.figure_svg(figure, language) for figure, number in figures})


def pdf_bytes(document: Document, body: Body | None = None) -> bytes:
    """Return a note as PDF, the same bytes for the same note; its `body` may be that of another with the same blocks.

    Raises InputError: the extra `note` is not installed.
    """
    try:
        import typst
    except ImportError:
        raise InputError("note-extra") from None
    body = body or Body.of(document.blocks, document.language)
    preamble = PREAMBLE.format(title=_quoted(document.title.title), lang=_quoted(document.language))
    source = "\n".join((preamble, _title(document), body.text))
    files: Any = {"main.typ": source.encode("utf-8"), **body.figures}
    return bytes(typst.compile(files, font_paths=_fonts()))


@cache
def _fonts() -> Any:
    """Return the fonts of notes: those of typst, and that in which figures are lettered; none of the system."""
    import typst

    found = importlib.util.find_spec("matplotlib")
    assert found is not None
    assert found.origin is not None
    folder = Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"
    return typst.Fonts(include_system_fonts=False, include_embedded_fonts=True, font_paths=[str(folder)])


def _title(document: Document) -> str:
    """Return the first page and the contents."""
    said, page = packaged(__package__, "texts", document.language), document.title
    rows = [(said[f"title.{name}"], getattr(page, name)) for name in ("student", "group", "teacher")]
    cells = "".join(f"[{_text(label)}], [{_text(value or '_' * 24)}],\n" for label, value in rows)
    about = said["title.variant"].format(variant=page.variant)
    return f"""\
#page(numbering: none)[
#align(center)[{_text(page.department)}]
#v(60mm)
#align(center)[#text(size: 16pt, weight: "bold")[{_text(said["title.note"])}]]
#align(center)[#text(size: 14pt)[{_text(page.title)}]]
#align(center)[{_text(about)}]
#v(1fr)
#align(right)[#grid(columns: 2, align: left, gutter: 4mm,\n{cells})]
#v(30mm)
#align(center)[{_text(page.date)}]
#align(center)[#text(size: 9pt)[{_text(page.identity)}]]
]
#outline(title: {_quoted(said["contents"])})
#pagebreak()"""


def _block(block: Block, number: int, said: dict[str, str]) -> str:
    match block:
        case Heading(text=text):
            return f"= {_line(text)}"
        case Sentences(texts=texts):
            return " ".join(map(_sentence, texts)) + "\n"
        case Steps(texts=texts):
            return "\n".join(f"+ {_sentence(text)}" for text in texts) + "\n"
        case Equations(lines=lines):
            return "\n".join(f"#equation[{_line(' '.join(chunks))}]" for chunks in lines) + "\n"
        case Table(rows=rows):
            return _table(rows)
        case Figure():
            if not block.folded:
                return _figure(block, said, number)
            text = _text(said["figure.folded"].format(number=number, format=note.FOLDED))  # its number counts here
            return f"#counter(figure.where(kind: image)).step()\n{text}\n"


def _figure(figure: Figure, said: dict[str, str], number: int, more: str = "") -> str:
    below = "".join(f" #linebreak() {_line(text)}" for text in note.said_under(figure, said))
    shown = f'image("{number}.svg", width: {figure.view.size[0] * figure.share:.4f}mm)'
    return (
        f"#figure({shown}, kind: image, {more}supplement: {_quoted(said['figure'])}, "
        f"caption: [{_line(figure.caption)}{below}])\n"
    )


def _table(rows: tuple[tuple[str | None, ...], ...]) -> str:
    sides: tuple[list[str], list[str]] = [], []  # of the head, which stands on every page, and of what follows
    for number, row in enumerate(rows):
        for start, end, cell in cells(row):
            text = f"*{_line(cell)}*" if number == 0 and cell else _line(cell)
            sides[number > 0].append(f"table.cell(colspan: {end - start})[{text}]")
    head, body = (", ".join(side) for side in sides)
    shape = f"columns: {len(rows[0])}, align: center + horizon"
    return f"#align(center)[#table({shape}, table.header({head}),\n{body})]\n"


def _line(markup: str, plain: Callable[[str], str] | None = None) -> str:
    """Return a line of markup: words as text, or as `plain` has them, symbols with scripts and bars as formulas."""
    said, nodes = plain or _text, note.parse(markup)
    return "".join(
        said(node.text) if isinstance(node, note.Plain) else f"${_formula(node, note.joined(nodes, k))}$"
        for k, node in enumerate(nodes)
    )


def _sentence(markup: str) -> str:
    """Return a sentence in which no line ends between a letter and what it is equal to, a number and its unit."""
    return _line(markup, lambda plain: _text(note.tied(plain)))


def _formula(node: note.Node, upright: bool = False) -> str:
    """Return a node within a formula; a letter alone is slanted, unless it is `upright`."""
    if isinstance(node, note.Plain):
        slanted = len(node.text) == 1 and node.text.isalpha() and not upright
        return f"italic({_quoted(node.text)})" if slanted else _quoted(node.text)
    if isinstance(node, note.Ruled):
        inner = " ".join(map(_formula, node.parts)) or '""'
        return {"bar": f"overline({inner})", "u": f"underline({inner})", "uu": f"underline(underline({inner}))"}[
            node.kind
        ]
    scripts = "".join(
        f", {place}: {''.join(_script(part, note.joined(parts, k)) for k, part in enumerate(parts))}"
        for place, parts in (("t", node.above), ("b", node.below))
        if parts
    )
    return f"attach({_formula(node.base, upright)}{scripts})"


def _script(node: note.Node, upright: bool) -> str:
    return _quoted(node.text) if isinstance(node, note.Plain) else _formula(node, upright)


def _text(plain: str) -> str:
    """Return plain characters as content in which nothing is a sign of the language."""
    return f"#{_quoted(plain)}" if plain else ""


def _quoted(text: str) -> str:
    return json.dumps(note.printable(text), ensure_ascii=False)
