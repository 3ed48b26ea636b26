"""A note as Markdown, with its figures as files beside it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from ...scales.packaged import packaged
from ..text import html_scripts, spelled
from . import blocks as note
from .blocks import Block, Document, Equations, Figure, Heading, Sentences, Steps, Table

_SIGNS = re.compile(r"([\\`*_{}\[\]<>#|~])")


def markdown(document: Document, figures: list[str]) -> str:
    """Return a note as Markdown; `figures` are the names of the figures' files, in order."""
    said, page = packaged(__package__, "texts", document.language), document.title
    about = [said["title.variant"].format(variant=page.variant)]
    about += [
        f"{said[f'title.{name}']}: {text}" for name in ("student", "group", "teacher") if (text := getattr(page, name))
    ]
    about += [text for text in (page.department, page.date, page.identity) if text]
    head = [f"# {_plain(said['title.note'])}", f"**{_plain(page.title)}**", "  \n".join(map(_plain, about))]
    texts = (text for block, number in note.numbered(document.blocks) for text in _block(block, number, said, figures))
    return "\n\n".join([*head, *texts]) + "\n"


def _block(block: Block, number: int, said: dict[str, str], figures: Sequence[str]) -> Iterator[str]:
    match block:
        case Heading(text=text):
            yield f"## {_line(text)}"
        case Sentences(texts=texts):
            yield " ".join(map(_line, texts))
        case Steps(texts=texts):
            yield "\n".join(f"{place}. {_line(text)}" for place, text in enumerate(texts, 1))
        case Equations():
            yield "  \n".join(_line(" ".join(chunks)) + (f" ({n})" if n else "") for chunks, n in block.told)
        case Table(rows=rows, caption=caption):
            if caption:
                yield f"*{said['table']} {number} – {_line(caption)}*"
            head, *body = ([_line(cell or "") for cell in row] for row in rows)
            ruled = ["|".join(("", *row, "")) for row in (head, ["---"] * len(head), *body)]
            yield "\n".join(ruled)
        case Figure(caption=caption, under=under):
            name = figures[number - 1]
            if re.search(r"[\s()<>]", name):  # the target of a link holds these only within signs of its own
                name = "<" + re.sub(r"([<>\\])", r"\\\1", name) + ">"
            yield f"![{_plain(spelled(caption))}]({name})"
            yield "  \n".join((f"*{said['figure']} {number} – {_line(caption)}*", *map(_line, under)))


def _line(markup: str) -> str:
    return spelled(markup, _plain, html_scripts, lambda kind, text: RULED[kind](text))


RULED: dict[str, Callable[[str], str]] = {
    "bar": lambda text: re.sub(r"(\w)", "\\1\u0305", text),  # a bar over every letter
    "u": "<u>{}</u>".format,
    "uu": lambda text: re.sub(r"(\w\u0305?)", "\\1\u0333", text, count=1),  # under the first one: tags know one line
}


def _plain(text: str) -> str:
    """Return characters that Markdown does not take for signs of its own."""
    return _SIGNS.sub(r"\\\1", text)
