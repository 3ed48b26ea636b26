"""A note as blocks, headings, steps, equations, figures, tables, and the markup of its lines as a tree, for writers."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import repeat

from ...scales.choices import DSTU_3008, PLAIN
from ..formats import FORMATS
from ..page import Page, extent
from ..shapes import Text, shifted
from ..svg import svg_text
from ..text import Piece, Ruling, read
from ..titleblock import Stamp, text_frame
from ..view import View

FOLDED, FOLDED_ROOM = "A3", (267.0, 340.0)  # the sheet of a figure that is too large, and its room there, mm
FOLDED_SIDES = 22.5, 7.5  # mm left and right of that room on a sheet with a frame
LEGIBLE = 0.5  # the part of its size below which the letters of a figure are too small
# mm of its height, so that it stands near its text, and the part of its size to which it is reduced for that at most
NEAR, NEARLY = 130.0, 0.7
ROOM = (180.0, 215.0)  # mm of a page of A4 for a figure, its caption under it


@dataclass(frozen=True, slots=True)
class Heading:
    """The heading of a section; one that is not `numbered`, of an introduction or of conclusions, is in capitals."""

    text: str
    numbered: bool = True

    def __post_init__(self) -> None:
        """Put what has no number in capitals, as standards of reports do."""
        if not self.numbered:
            object.__setattr__(self, "text", self.text.upper())


@dataclass(frozen=True, slots=True)
class Sentences:
    """A paragraph: sentences, in markup; one that `leads` to what follows stands on the same page."""

    texts: tuple[str, ...]
    leads: bool = False


@dataclass(frozen=True, slots=True)
class Steps:
    """What is done, step by step, in markup."""

    texts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Equations:
    """Equations with what they come to, a line each, in chunks of markup between which a line may break.

    `numbers` are those by which the text refers to them, 0 of a line of words.
    """

    lines: tuple[tuple[str, ...], ...]
    numbers: tuple[int, ...] = ()

    @property
    def told(self) -> Iterator[tuple[tuple[str, ...], int]]:
        """The lines with their numbers."""
        return zip(self.lines, self.numbers or repeat(0), strict=False)


@dataclass(frozen=True, slots=True)
class Table:
    """A table under its caption; the first row is its head, a cell that is None belongs to the one on its left."""

    rows: tuple[tuple[str | None, ...], ...]
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure of the sheet without its heading, which is the caption, in markup, with the lines under it."""

    view: View
    caption: str
    under: tuple[str, ...]
    fitted: float | None = None  # the part of its size on the sheet, if it is not as large as it can be

    @property
    def folded(self) -> bool:
        """Whether it stands on a larger sheet at the end of the note, because its letters would be too small."""
        return self._share_of(ROOM) < LEGIBLE

    @property
    def share(self) -> float:
        """The part of its size on the sheet at which it has room on a page of the note, or on that sheet."""
        if self.folded:
            return self._share_of(FOLDED_ROOM)
        return self.fitted or min(self._share_of(ROOM), max(NEARLY, NEAR / self.view.size[1]))

    def _share_of(self, room: tuple[float, float]) -> float:
        width, height = self.view.size
        return min(1.0, room[0] / width, room[1] / height)


@dataclass(frozen=True, slots=True)
class Profile:
    """How pages look: the size of letters, pt, margins, mm, how high lines are; whether they are framed.

    Between lines of typst there are `leading` em; `lines` are those of word processors.
    """

    size: float = 12.0
    left: float = 20.0
    right: float = 10.0
    top: float = 15.0
    bottom: float = 20.0
    leading: float = 0.7
    lines: float = 1.15
    framed: bool = False

    @property
    def wide(self) -> float:
        """How wide a line is, mm."""
        return PAPER[0] - self.left - self.right


PAPER = 210.0, 297.0  # mm of a page
PROFILES = {  # of DSTU 3008 lines are one and a half high; a frame with form 2a leaves 25 mm below them
    PLAIN: Profile(),
    DSTU_3008: Profile(14.0, left=30.0, top=20.0, bottom=25.0, leading=1.05, lines=1.5, framed=True),
}
Block = Heading | Sentences | Steps | Equations | Table | Figure


@dataclass(frozen=True, slots=True)
class TitlePage:
    """What the first page says; what is empty is left out."""

    title: str
    task: str
    variant: str
    department: str = ""
    student: str = ""
    group: str = ""
    teacher: str = ""
    date: str = ""
    identity: str = ""
    designation: str = ""
    document_type: str = ""


@dataclass(frozen=True, slots=True)
class Document:
    """A note, ready for any writer."""

    title: TitlePage
    blocks: tuple[Block, ...]
    language: str
    profile: Profile = field(default_factory=Profile)

    @property
    def folds(self) -> bool:
        """Whether figures stand on larger sheets at the end."""
        return any(isinstance(block, Figure) and block.folded for block in self.blocks)


@dataclass(frozen=True, slots=True)
class Story:
    """What a note says beside the views of the sheet, by their names.

    `steps` are those of a view that has no stages: the sentences of these stand in `texts` under their keys, with what
    is `said` put in. `equations` stand before the steps of a plan, and in the place of views that are `told` so;
    `conclusions` are sentences for the end; the blocks `before` a view have headings of their own. The views named
    `first` come so, before all others; those of the statement, `head`, take the place of what is called so on the
    sheet. The `aims` say what is to be found. The `meanings` of symbols stand under the equations that use them first.
    """

    steps: Mapping[str, Sequence[str]] = field(default_factory=dict)
    equations: Mapping[str, Sequence[Sequence[str]]] = field(default_factory=dict)
    told: frozenset[str] = frozenset()
    conclusions: tuple[str, ...] = ()
    before: Mapping[str, Sequence[Block]] = field(default_factory=dict)
    texts: Mapping[str, str] = field(default_factory=dict)
    said: Mapping[str, str] = field(default_factory=dict)
    first: tuple[str, ...] = ("kinematic", "givens", "data")
    head: tuple[View, ...] = ()
    aims: tuple[str, ...] = ()
    meanings: Mapping[str, str] = field(default_factory=dict)

    def steps_of(self, view: View) -> tuple[str, ...]:
        """Return what is done, step by step, until a view is drawn."""
        keys = (key for key in view.stages.values() if key)
        return (*self.steps.get(view.name, ()), *(self.texts[key].format(**self.said) for key in keys))


REFERS = "⟦{}⟧"  # in a step, what refers to the equation that gives a symbol, or to nothing where none does
_REFERRING = re.compile(r"⟦(.*?)⟧")
_WORDS = re.compile(r"(?:[^\W\d_]|’){4,} ")
_BARRED = re.compile(r"\\bar\{(\w+)\}")
_DISPLAYED = re.compile(r"[=≤≥]|\\u{1,2}\{")
_MEANT = re.compile(r": [^\W\d_]+ [^\W\d_]{2,} ")  # what an equation before it means, in words


def displayed(markup: str) -> bool:
    """Whether a line is an equation, not words, in which something may be equal to something, too."""
    return _DISPLAYED.search(markup) is not None and _WORDS.match(markup) is None and _MEANT.search(markup) is None


@dataclass(slots=True)
class _Writing:
    """Blocks as they are written one after the other, with their numbers and what refers to these."""

    story: Story
    said: Mapping[str, str]
    equations: int = 0
    counts: Counter[type[Block]] = field(default_factory=Counter)
    given: dict[str, int] = field(default_factory=dict)  # numbers of equations, also by the symbols that they give
    explained: set[str] = field(default_factory=set)

    def refer(self, key: str, first: int, last: int = 0, leads: bool = True) -> Sentences:
        """Return a sentence that refers to a number, or to those from the first to the last."""
        many = "_many" if last > first else ""
        return Sentences((self.said[f"note.{key}{many}"].format(number=first, last=last),), leads)

    def calculated(self, lines: Iterable[Sequence[str]]) -> Iterator[Block]:
        """Number equations, after a sentence that refers to them."""
        numbers, before, told = list[int](), self.equations, tuple(map(tuple, lines))
        for line in told:
            markup = " ".join(line)
            self.equations += displayed(markup)
            numbers.append(self.equations if displayed(markup) else 0)
            if numbers[-1]:
                self.given |= dict.fromkeys((markup.partition(" =")[0], markup), numbers[-1])
        if self.equations > before:
            yield self.refer("calculated", before + 1, self.equations)
        yield Equations(told, tuple(numbers))
        yield from self.explaining(" ".join(" ".join(line) for line in told))

    def explaining(self, markup: str) -> Iterator[Sentences]:
        """Say what the symbols mean that equations use and none before them has used."""
        used = _BARRED.sub(r"\1", markup)
        new = [symbol for symbol in self.story.meanings if symbol in used and symbol not in self.explained]
        self.explained.update(new)
        if new:
            said = (self.said["note.meaning"].format(symbol=s, meaning=self.story.meanings[s]) for s in new)
            yield Sentences((self.said["note.where"].format(meanings="; ".join(said)),))

    def section(self, view: View) -> Iterator[Block]:
        """Write of a view: its heading, equations, steps, and the figure that they make."""
        for block in self.story.before.get(view.name, ()):
            yield from self.calculated(block.lines) if isinstance(block, Equations) else [block]
        heading = view.heading[0] if view.heading else ""
        if heading:
            yield Heading(heading)
        if view.rows:
            yield from self.tabled([view])
        elif view.lines:
            yield from self.calculated(view.lines)
        else:
            if equations := self.story.equations.get(view.name):
                yield from self.calculated(equations)
            self.counts[Figure] += 1
            steps = self.story.steps_of(view)
            yield self.refer("built" if steps else "shown", self.counts[Figure], leads=bool(steps))
            if steps:
                yield Steps(tuple(_REFERRING.sub(self._referring, step) for step in steps))
            yield _figure_of(view)

    def _referring(self, found: re.Match[str]) -> str:
        number = self.given.get(found[1], 0)
        return self.said["note.by_equation"].format(number=number) if number else ""

    def tabled(self, views: Sequence[View]) -> Iterator[Block]:
        """Write tables, after a sentence that refers to them."""
        first = self.counts[Table] + 1
        self.counts[Table] += len(views)
        yield self.refer("tabled", first, self.counts[Table])
        yield from (Table(view.rows, view.heading[0] if view.heading else "") for view in views)


def _figure_of(view: View) -> Figure:
    """Return a view as a figure, without its heading."""
    bare = tuple(shape for shape in view.shapes if not (isinstance(shape, Text) and shape.role == "heading"))
    x0, y0, x1, y1 = extent(bare)
    figure = replace(view, shapes=bare, box=(x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0))
    return Figure(figure, view.heading[0] if view.heading else "", (*view.heading[1:], *view.notes))


def blocks_of(views: Iterable[View], story: Story, said: Mapping[str, str]) -> Iterator[Block]:
    """Go through the blocks of a sheet's views: those that come first, the others in the order of the work, tables.

    What is `said` are words of notes by their keys.
    """
    writing, stated = _Writing(story, said), {view.name: view for view in story.head}
    # of what is parted the whole is there, too
    own = (view for view in views if view.name not in {*story.told, *stated} and not view.of)
    told = [*stated.values(), *own]
    if story.aims:
        yield from (Sentences((said["note.aims"],), leads=True), Steps(story.aims))
    first = sorted((view for view in told if view.name in story.first), key=lambda view: story.first.index(view.name))
    others = [view for view in told if view.name not in story.first]
    for view in (*first, *(view for view in others if not view.rows)):
        yield from writing.section(view)
    if tables := [view for view in others if view.rows]:
        yield Heading(said["note.results"])
        yield from writing.tabled(tables)


def numbered(blocks: Iterable[Block]) -> Iterator[tuple[Block, int]]:
    """Go through blocks, each with its number among those of its kind, from 1."""
    counts: Counter[type[Block]] = Counter()
    for block in blocks:
        counts[type(block)] += 1
        yield block, counts[type(block)]


def figure_page(figure: Figure, language: str) -> Page:
    """Return a page as large as the figure."""
    x0, y0, x1, y1 = figure.view.box
    shapes = tuple(shifted(shape, complex(-x0, -y0)) for shape in figure.view.shapes)
    return Page(x1 - x0, y1 - y0, shapes, figure.caption, language)


def figure_svg(figure: Figure, language: str) -> bytes:
    """Return the figure as SVG for a reader that has its font."""
    return svg_text(figure_page(figure, language), with_font=False).encode("utf-8", "replace")


def framed_pages(document: Document) -> dict[str, Page]:
    """Return frames of pages of a text by their forms: of the first one bare, then with title blocks `2` and `2a`.

    Larger sheets at the end have the frame `folded`.
    """
    page, sheets = document.title, dict.fromkeys(("", "2", "2a"), FORMATS["A4"])
    same = ("title", "designation", "group", "student", "teacher", "date", "document_type")
    named = {name: getattr(page, name) for name in same}
    stamp = Stamp(**named, organisation=page.department, language=document.language)
    if document.folds:
        sheets["folded"] = FORMATS[f"{FOLDED}-portrait"]
    return {
        form: Page(
            sheet.width,
            sheet.height,
            text_frame(sheet, stamp, "2a" if form == "folded" else form),
            page.title,
            document.language,
        )
        for form, sheet in sheets.items()
    }


def said_under(figure: Figure, said: dict[str, str]) -> tuple[str, ...]:
    """Return the lines under a figure; the last one says by how much it is smaller than on the sheet, if it is."""
    part = round(100.0 * figure.share)
    return (*figure.under, *((said["figure.reduced"].format(part=part),) if part < 100 else ()))


_WORD = re.compile(r"[^\W\d_]$|(?:^|\d |, )\(?[^\W\d_]+/$")  # a letter at the end, or a unit: 2 m/s²
_UNITS = re.compile(r"(?:\b(?:kg|N|rad|mm|cm|m)[/·]|\bm)$")  # before a unit with its power
TIE, JOINER = "\u00a0", "\u2060"  # a space at which no line ends, what keeps one from ending behind a sign
_BEFORE_SIGN, _AFTER_NUMBER = re.compile(r" (?=[=≤≥<>] )"), re.compile(r"(?<=\d) (?=\w)")


@dataclass(frozen=True, slots=True)
class Plain:
    """Characters that mean themselves."""

    text: str


@dataclass(frozen=True, slots=True)
class Ruled:
    """A group under a vector bar (`bar`), or over one line or two (`u`, `uu`)."""

    kind: str
    parts: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Scripted:
    """A letter, or a ruled group, with what stands above and below behind it."""

    base: Node
    above: tuple[Node, ...]
    below: tuple[Node, ...]


Node = Plain | Ruled | Scripted


@lru_cache(maxsize=4096)
def parse(markup: str) -> tuple[Node, ...]:
    """Return the parts of a line of markup, scripts with the letters behind which they stand.

    >>> parse("a_{B}")
    (Scripted(base=Plain(text='a'), above=(), below=(Plain(text='B'),)),)
    """
    return _nodes(read(markup))


def _nodes(pieces: Sequence[Piece]) -> tuple[Node, ...]:
    nodes: list[Node] = []
    for piece in pieces:
        if isinstance(piece, str):
            nodes.append(Plain(piece))
        elif isinstance(piece, Ruling):
            nodes.append(Ruled(piece.kind, _nodes(piece.pieces)))
        else:
            base = _base(nodes)
            nodes.append(Scripted(base, _nodes(piece.get("^", ())), _nodes(piece.get("_", ()))))
    return tuple(nodes)


def _base(parts: list[Node]) -> Node:
    """Take from what has been read the letter to which scripts belong, with its primes."""
    if not parts:
        return Plain("")
    last = parts.pop()
    if not isinstance(last, Plain):
        return last
    cut = len(last.text.rstrip("′″'"))
    cut -= bool(re.fullmatch(r"[^\s(]", last.text[cut - 1 : cut]))
    if cut:
        parts.append(Plain(last.text[:cut]))
    return Plain(last.text[cut:])


def printable(text: str) -> str:
    """Return characters that can be seen, and spaces for others, which may turn a line about or end a file.

    >>> printable("a\\u202eb\\x07")
    'a b '
    """
    kept = (TIE, JOINER)
    return text if text.isprintable() else "".join(c if c.isprintable() or c in kept else " " for c in text)


def tied(text: str) -> str:
    """Return words of which no line ends between a letter and what it is equal to, a number and its unit, a minus."""
    return _BEFORE_SIGN.sub(TIE, _AFTER_NUMBER.sub(TIE, text)) + JOINER * text.endswith("−")


def is_unit(parts: Sequence[Node], place: int) -> bool:
    """Whether a part of a line is a unit with its power, behind another one or alone: the m² of kg·m²."""
    part, before = parts[place], parts[place - 1] if place else None
    if not isinstance(part, Scripted) or not isinstance(part.base, Plain) or part.below:
        return False
    cyrillic = "а" <= part.base.text[:1].lower() <= "ґ"
    behind = len(parts) == 1 if before is None else isinstance(before, Plain) and _UNITS.search(before.text) is not None
    return all(isinstance(up, Plain) for up in part.above) and (cyrillic or (behind and part.base.text in ("m", "s")))


def joined(parts: Sequence[Node], place: int) -> bool:
    """Whether a part stands in one word with plain letters, which are upright: the d and the φ of d²s/dφ², a unit."""
    if is_unit(parts, place):
        return True
    before, after = (parts[near] if 0 <= near < len(parts) else None for near in (place - 1, place + 1))
    if isinstance(before, Plain) and _WORD.search(before.text):
        return True
    return isinstance(after, Plain) and after.text[:1].isalpha()
