"""A note as PDF by typst: the document in its language, the figures as SVG at their true size."""

from __future__ import annotations

import importlib.util
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

from ...scales.choices import PLAIN
from ...scales.errors import InputError
from ...scales.packaged import home, packaged
from ..svg import svg_text
from ..tables import cells
from . import blocks as note
from .blocks import Block, Document, Equations, Figure, Heading, Profile, Sentences, Steps, Table

SUSPECTS = b"/Suspects false"
PREAMBLE = """\
#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (left: {left}mm, right: {right}mm, top: {top}mm, bottom: {bottom}mm), {page})
#set text(font: ("Libertinus Serif", "DejaVu Sans"), size: {size}pt, lang: {lang})
#set par(justify: true, leading: {leading}em, spacing: {spacing}em)
#set heading(numbering: "1")
#show heading: set text(size: {heading}pt)
#show table: set par(leading: 0.7em)
#show table: set text(size: 12pt)
#show heading: set block(above: 1.4em, below: 0.8em, sticky: true)
#set table(inset: 4pt, stroke: (x, _) => if x > 0 {{ 0.5pt }})
#show figure: set block(breakable: false)
#show figure.where(kind: table): set block(breakable: true)
#show figure.where(kind: table): set figure.caption(position: top)
#show figure.caption: set par(leading: 0.7em)
#show figure.caption: set text(size: 12pt)
#show figure.caption.where(kind: table): it => align(left, block(sticky: true, it))
#set figure.caption(separator: [ – ])
#show math.equation: set text(font: ("New Computer Modern Math", "Libertinus Serif", "DejaVu Sans"))
#let equation(body, number) = block(width: 100%, spacing: {equation}em, inset: (left: 8mm), {{
  set par(leading: 0.45em)
  grid(columns: (1fr, auto), column-gutter: 4mm, align: (left, right + bottom), body, number)
}})
#let at(block) = box[#metadata(block)<at>]
"""
IMAGE = re.compile(r'image\("\d+\.svg", width: ([\d.]+)mm, height: ([\d.]+)mm\)')
MARKS = """
#context [#metadata(query(<at>).map(at => (at.value, at.location().page(), at.location().position().y.mm())))<marks>]
"""
NUMBERED = 'numbering: "1", number-align: center'
FRAMED = """numbering: none, background: context if counter(page).get().first() == 2 {
  image("form-2.svg")
  place(bottom + left, dx: 170mm, dy: -20mm, box(width: 15mm, height: 5mm, align(center + horizon, sheet[2])))
  place(bottom + left, dx: 185mm, dy: -20mm,
    box(width: 20mm, height: 5mm, align(center + horizon, sheet(str(counter(page).final().first())))))
} else { form("form-2a.svg") }"""
SHEET = """\
#let sheet(number) = text(font: "Kulman Drafting", size: 10pt, number)
#let form(file) = {
  image(file)
  place(bottom + right, dx: -5mm, dy: -5mm,
    box(width: 10mm, height: 8mm, align(center + horizon, sheet(counter(page).display("1")))))
}"""
PLAINLY = "#let folded = (:)"
FRAMED_TOO = (  # larger sheets at the end
    f"#let folded = (margin: (left: {note.FOLDED_SIDES[0]}mm, right: {note.FOLDED_SIDES[1]}mm), "
    'background: context form("form-folded.svg"))'
)
RESERVED = 22.0  # mm by which form 2 is higher than form 2a
GAP = 30.0  # mm at the end of a page that stay empty
SMALLER = 0.85  # of its size, to which a figure may shrink to have room before the end of a page
LINES = 7.0  # mm of a line under a figure
MARGIN = 3.0  # mm by which it is smaller than that room
TOGETHER = 3  # rows of a table that no end of a page parts, at its beginning and at its end
TRIES = 24


@dataclass(slots=True)
class _Plan:
    """Where figures stand that leave too much of a page empty: at the top of the next one, or smaller; by their block.

    Text that follows a figure goes on before it, so that no page is left half empty.
    """

    bottom: float  # mm from the top of a page to the end of its text
    floating: set[int] = field(default_factory=set)
    shares: dict[int, float] = field(default_factory=dict)

    def mend(self, blocks: Sequence[Block], marks: Sequence[tuple[int, int, float]]) -> bool:
        """Look where blocks stand, the page and the place on it for each; tell whether some should stand elsewhere."""
        if self._shrink(blocks, {n: y - self.bottom for n, _, y in marks if y > self.bottom}):
            return True
        ends, last = dict[int, float](), max((page for _, page, _ in marks), default=0)
        for _, page, y in marks:
            ends[page] = max(y, ends.get(page, 0.0))
        inline = [mark for mark in marks if mark[0] not in self.floating]
        for (_, page, _), (block, after, _) in pairwise(inline):
            room, at = max(((self.bottom - ends.get(at, 0.0), at) for at in range(page, after)), default=(0.0, page))
            figure = blocks[block]
            if isinstance(figure, Figure) and room > GAP and after <= last:
                self._move(block, figure, room if at == after - 1 else 0.0)
                return True
        pages = {block: page for block, page, _ in marks}
        behind = [
            block
            for block, page, _ in inline
            if isinstance(blocks[block], Figure) and any(n < block and pages[n] > page for n in self.floating)
        ]
        self.floating.update(behind)
        return bool(behind)

    def _shrink(self, blocks: Sequence[Block], beyond: Mapping[int, float]) -> bool:
        """Make figures smaller by the mm by which what stands under them runs over the end of the text."""
        for place, mm in beyond.items():
            if isinstance(figure := blocks[place], Figure):
                self.shares[place] = self.shares.get(place, figure.share) - (mm + MARGIN) / figure.view.size[1]
        return any(isinstance(blocks[place], Figure) for place in beyond)

    def _move(self, place: int, figure: Figure, room: float) -> None:
        """Let a figure be smaller if it nearly has room, else stand on the next page."""
        height = room - MARGIN - LINES * (1 + len(figure.under))
        share = min(figure.share, height / figure.view.size[1])
        if place in self.shares or share < max(SMALLER * figure.share, note.LEGIBLE):
            self.floating.add(place)
        else:
            self.shares[place] = share


@dataclass(frozen=True, slots=True)
class Body:
    """What follows the first page: its text in the language of typst, its figures by file."""

    text: str
    figures: Mapping[str, bytes]
    profile: Profile = note.PROFILES[PLAIN]

    @classmethod
    def of(cls, blocks: Sequence[Block], language: str, profile: Profile = note.PROFILES[PLAIN]) -> Body:
        """Write the blocks of a note, figures where they leave no page half empty.

        Raises InputError: the extra `note` is not installed.
        """
        said, plan = packaged(__package__, "texts", language), _Plan(note.PAPER[1] - profile.bottom)
        figures = [(block, number) for block, number in note.numbered(blocks) if isinstance(block, Figure)]
        files = {f"{number}.svg": note.figure_svg(figure, language) for figure, number in figures}
        told = _told(blocks, said)
        for _ in range(TRIES):
            body = cls(_written(blocks, said, plan, profile, told), files, profile)
            if not plan.mend(blocks, body.marks(language)):
                break
        return body

    def source(self, title: str, language: str, before: str) -> dict[str, Any]:
        """Return the files of a note, with what stands before the body."""
        looks = self.profile
        framed = looks.framed and before
        named = {"title": _quoted(title), "lang": _quoted(language), "page": FRAMED if framed else NUMBERED}
        sizes = {name: getattr(looks, name) for name in ("left", "right", "top", "bottom", "size", "leading")}
        preamble = PREAMBLE.format(
            **named, **sizes, spacing=looks.leading + 0.1, heading=looks.size + 1.0, equation=looks.leading
        )
        preamble = f"{SHEET}\n{FRAMED_TOO if framed else PLAINLY}\n{preamble}"
        return {"main.typ": "\n".join((preamble, before, self.text)).encode("utf-8"), **self.figures}

    def marks(self, language: str) -> list[tuple[int, int, float]]:
        """Return the pages and the heights at which blocks end, mm from the top, in their order."""
        files = self.source("", language, "")
        text = files["main.typ"].decode("utf-8") + MARKS
        boxes = {"main.typ": IMAGE.sub(r"rect(width: \1mm, height: \2mm)", text).encode("utf-8")}  # they are as large
        (found,) = json.loads(_typst().query(boxes, "<marks>", field="value", font_paths=_fonts()))
        return [(int(block), int(page), float(y)) for block, page, y in found]


def _typst() -> Any:
    try:
        import typst
    except ImportError:
        raise InputError("note-extra") from None
    return typst


def _told(blocks: Sequence[Block], said: dict[str, str]) -> list[str]:
    """Return the text of each block, wherever figures stand; nothing for these."""
    return [
        "" if isinstance(block, Figure) and not block.folded else _block(block, number, place, said)
        for place, (block, number) in enumerate(note.numbered(blocks))
    ]


def _written(blocks: Sequence[Block], said: dict[str, str], plan: _Plan, profile: Profile, told: Sequence[str]) -> str:
    texts = list[str]()
    for place, (block, number) in enumerate(note.numbered(blocks)):
        if isinstance(block, Figure) and not block.folded:
            # as many words either way: what has been set of the rest of the note holds
            where = f"placement: {'top' if place in plan.floating else 'none'}, "
            share = min(plan.shares.get(place, block.share), profile.wide / block.view.size[0])
            texts.append(_figure(replace(block, fitted=share), said, number, place, where))
        else:
            texts.append(told[place])
    for figure, number in note.numbered(blocks):
        if isinstance(figure, Figure) and figure.folded:  # on its sheet, with its number
            text = _figure(figure, said, number, -1, f'numbering: _ => "{number}", ')
            texts.append(f'#page(paper: "{note.FOLDED.lower()}", ..folded)[{text}]\n')
    return "\n".join(texts)


def pdf_bytes(document: Document, body: Body | None = None) -> bytes:
    """Return a note as PDF, the same bytes for the same note; its `body` may be that of another with the same blocks.

    Raises InputError: the extra `note` is not installed.
    """
    typst, body = _typst(), body or Body.of(document.blocks, document.language, document.profile)
    files = body.source(document.title.title, document.language, _title(document))
    if document.profile.framed:
        files |= {
            f"form-{form}.svg" if form else "frame.svg": svg_text(page, with_font=False).encode()
            for form, page in note.framed_pages(document).items()
        }
    # the same is meant where nothing is said, and Poppler takes that for an error; all else stays at its place
    return bytes(typst.compile(files, font_paths=_fonts())).replace(SUSPECTS, b" " * len(SUSPECTS), 1)


@cache
def _fonts() -> Any:
    """Return the fonts of notes: those of typst, and those in which figures are lettered; none of the system."""
    import typst

    found = importlib.util.find_spec("matplotlib")
    assert found is not None
    assert found.origin is not None
    folder = Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"
    return typst.Fonts(
        include_system_fonts=False, include_embedded_fonts=True, font_paths=[str(folder), str(home(__package__).parent)]
    )


def _title(document: Document) -> str:
    """Return the first page and the contents."""
    said, page = packaged(__package__, "texts", document.language), document.title
    rows = [(said[f"title.{name}"], getattr(page, name)) for name in ("student", "group", "teacher")]
    cells = "".join(f"[{_text(label)}], [{_text(value or '_' * 24)}],\n" for label, value in rows)
    about = said["title.variant"].format(variant=page.variant)
    framed = document.profile.framed
    frame = ', background: image("frame.svg")' if framed else ""
    reserved = f"#place(bottom, float: true, clearance: 0pt, block(height: {RESERVED}mm))\n" if framed else ""
    return f"""\
#page(numbering: none{frame})[
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
{reserved}#outline(title: align(center, {_quoted(said["contents"].upper())}))
#pagebreak()"""


def _block(block: Block, number: int, place: int, said: dict[str, str]) -> str:
    at = f"#at({place})"
    match block:
        case Heading(text=text, numbered=numbered):
            return f"= {_line(text)}" if numbered else f"#align(center, heading(numbering: none)[{_line(text)}])"
        case Sentences(texts=texts, leads=leads):
            text = " ".join(map(_sentence, texts)) + at
            return f"#block(sticky: true, spacing: 0.8em)[{text}]\n" if leads else f"{text}\n"
        case Steps(texts=texts):
            return "\n".join(f"+ {_sentence(text)}{at}" for text in texts) + "\n"
        case Equations():
            lines = (f"[{_line(' '.join(chunks))}{at}], [{f'({n})' if n else ''}]" for chunks, n in block.told)
            return "\n".join(f"#equation({line})" for line in lines) + "\n"
        case Table():
            return _table(block, number, place, said)
        case Figure():
            text = _text(said["figure.folded"].format(number=number, format=note.FOLDED))  # its number counts here
            return f"#counter(figure.where(kind: image)).step()\n{text}{at}\n"


def _figure(figure: Figure, said: dict[str, str], number: int, place: int, more: str = "") -> str:
    below = "".join(f" #linebreak() {_line(text)}" for text in note.said_under(figure, said))
    width, height = (mm * figure.share for mm in figure.view.size)
    shown = f'image("{number}.svg", width: {width:.4f}mm, height: {height:.4f}mm)'
    at = f"#at({place})" if place >= 0 else ""
    return (
        f"#figure({shown}, kind: image, {more}supplement: {_quoted(said['figure'])}, "
        f"caption: [{_line(figure.caption)}{below}{at}])\n"
    )


def _table(table: Table, number: int, place: int, said: dict[str, str]) -> str:
    """Return a table with its head on every page; a column without width keeps some of its rows together."""
    head, *rows = table.rows
    wide = len(head) + 1
    marked = f"#box[#metadata(none)<table{number}>]"
    there = f"query(<table{number}>).first().location().page() < here().page()"
    text = _text(f"{said['table.more']} {number}")  # no column becomes wider for it
    more = f"#context if {there} [#block(width: 0pt, inset: (bottom: 5pt), box(width: 60mm)[{text}])]"
    top = f"table.cell(colspan: {wide}, stroke: none, inset: 0pt, align: left)[{more}]"
    few = len(rows) < 2 * TOGETHER
    kept = {0: len(rows)} if few else {0: TOGETHER, len(rows) - TOGETHER: TOGETHER}
    body = []
    for k, row in enumerate(rows):
        held = kept.get(k, 0)
        if held or any(start <= k < start + count for start, count in kept.items()):
            body += [f"table.cell(rowspan: {held}, breakable: false, inset: 0pt)[]"] if held else []
        else:
            body.append("[]")
        *others, last = _cells(row)
        body += [*others, f"{last[:-1]}#at({place})]"]
    shape = f"columns: (0pt, {'auto, ' * len(head)}), align: center + horizon"
    held_head = ", ".join(["[]", *_cells(head, bold=True)])
    caption = f"caption: [{_line(table.caption)}{marked}], " if table.caption else ""
    inside = f"table({shape}, table.header({top}, {held_head}),\n{', '.join(body)})"
    return f"#figure({inside}, kind: table, {caption}supplement: {_quoted(said['table'])})\n"


def _cells(row: Sequence[str | None], bold: bool = False) -> list[str]:
    found = []
    for start, end, cell in cells(row):
        text = f"*{_line(cell)}*" if bold and cell else _line(cell)
        found.append(f"table.cell(colspan: {end - start})[{text}]")
    return found


def _line(markup: str, plain: Callable[[str], str] | None = None) -> str:
    """Return a line of markup: words as text, or as `plain` has them, symbols with scripts and bars as formulas."""
    said, nodes = plain or _text, note.parse(markup)
    return "".join(
        said(node.text) if isinstance(node, note.Plain) else f"${_formula(node, note.joined(nodes, k))}$"
        for k, node in enumerate(nodes)
    )


def _sentence(markup: str) -> str:
    """Return a sentence in which no line ends before what a letter is equal to, before a unit or within one."""
    return _line(markup, lambda plain: _text(note.tied(plain).replace("/", f"/{note.JOINER}")))


def _formula(node: note.Node, upright: bool = False) -> str:
    """Return a node within a formula; a letter alone is slanted, unless it is `upright`."""
    if isinstance(node, note.Plain):
        letter = node.text.rstrip("′″")
        slanted = len(letter) == 1 and letter.isalpha() and not upright
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
