"""Pages that move: a subject's solver and views as data, the script that draws them, in one file of HTML.

The page calculates with the recorded program, written down as JavaScript; Python gives it names, shapes and words.
"""

from __future__ import annotations

import json
import math
import re
from html import escape
from importlib.resources import files
from typing import Any, TypeAlias

from ...plans.boards.batch import script_names
from ..text import Ruling, read, told_apart
from ..words import Words

Data: TypeAlias = dict[str, Any]
COMMENT = re.compile(r"(?:^|\s)// .*")
SPACED = re.compile(r" ?([*/=<>&|?:,;{}()]) ?")  # signs of formulas; two minus signs stay apart
TAGS = {"_": "sub", "^": "sup"}


def number(value: float, digits: int = 17) -> float | None:
    """Return a number as JSON has it, with so many digits; none where it is no number."""
    return float(f"{value:.{digits}g}") if math.isfinite(value) else None


def html(markup: str) -> str:
    """Return a line of markup as HTML: scripts raised and lowered, symbols slanted, vectors under a bar."""
    return _html(read(markup))


def _html(pieces: list[Any], slanted: bool = False) -> str:
    parts = []
    for piece, is_symbol in told_apart(pieces):
        if isinstance(piece, str):
            text = escape(piece, quote=False)
            parts.append(f"<i>{text}</i>" if is_symbol and not slanted else text)
        elif isinstance(piece, Ruling):
            parts.append(f'<span class="{piece.kind}">{_html(piece.pieces, slanted)}</span>')
        else:
            parts += [f"<{TAGS[kind]}>{_html(script, slanted)}</{TAGS[kind]}>" for kind, script in piece.items()]
    return "".join(parts)


def page(data: Data, words: Words, title: str, about: str) -> str:
    """Return a page of HTML that needs nothing else: a title, what stands under it, what moves and how."""
    own = files(__name__)
    said = {key.removeprefix("moving."): text for key, text in words.texts.items() if key.startswith("moving.")}
    solve = data.pop("solve")
    script = own.joinpath("page.js").read_text("utf-8")
    asked = {key: text for key, text in said.items() if re.search(rf"\b{key}\b", script)}
    payload = json.dumps({**data, "words": asked, "lang": words.language}, ensure_ascii=False, separators=(",", ":"))
    parts = {
        "lang": words.language,
        "title": escape(title),
        "task": escape(about),
        "style": own.joinpath("page.css").read_text("utf-8"),
        "data": payload.replace("</", "<\\/"),
        "solver": _short(script_names("cosines[" in solve)) + "\n" + SPACED.sub(r"\1", _short(solve)),
        "places": _short(own.joinpath("places.js").read_text("utf-8")),
        "script": _short(script),
        **{f"said.{key}": escape(text) for key, text in said.items()},
    }
    text = own.joinpath("page.html").read_text("utf-8")
    for key, part in parts.items():
        text = text.replace(f"{{{{{key}}}}}", part)
    return text


def _short(script: str) -> str:
    """Return a script without what only its readers need, comments and indents: pages go by mail, too."""
    return "\n".join(filter(None, (COMMENT.sub("", line).strip() for line in script.splitlines())))
