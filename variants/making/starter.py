"""Task files to begin with: of a kind with comments, or made of its table of givens."""

from __future__ import annotations

import json
import math
import os
import re
import textwrap
from dataclasses import replace
from pathlib import Path

from ...drawing.words import Words
from ...scales.errors import LANGUAGES, InputError, KeptError, messages
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import home
from ..case import kind_of
from ..kinds import KINDS, MODULES, table_in
from ..marking.wording import plain
from ..reader import load_task
from ..shelf import HEADS, summary, text_of
from ..task import Task

VARIANTS = (__package__ or "").rpartition(".")[0]
SUFFIX = ".toml"
_OWN = re.compile(r'^id = "([^"]+)"', re.MULTILINE)  # what a template calls itself
_ID = re.compile(r"""^id\s*=\s*(?:"[^"\n]*"|'[^'\n]*')""", re.MULTILINE)
_HOW = re.compile(r"^#\n(?:#     kulman.*\n)+(?:#.*\n)*", re.MULTILINE)  # how to check, solve and draw it
_FIRST = re.compile(r"((?:-v|variant|варіанта|варианта) )1\b")
_ABOUT = re.compile(r"^# (\w\w): (.+\n(?:#     .+\n)*)", re.MULTILINE)  # what a bundled file says of itself
_ALIKE = r"title|givens|mechanism\.link|mechanism\.pair|cam|gear|hoist|variant"  # tables whose comments suit all tasks
_TOLD = re.compile(rf"^((?:#.*\n)+)(\[+(?:{_ALIKE})\]+)\n", re.MULTILINE)
_GIVENS = re.compile(r"(?<=^\[givens\]\n)(?:\w+ = .*\n)+", re.MULTILINE)
_POINT = re.compile(r"\b[A-Z]\d+\b")
_WIDE = 80  # columns from which on a given has its comment closely behind it
_LABELLED = re.compile(r'^(id = "[^"]*") *(?=  # )', re.MULTILINE)  # as wide as the line below it
_KEYS = [re.compile(rf"^{key} = .*\n", re.MULTILINE) for key in ("id", "source")]  # with their comments
_FOREIGN = re.compile(r"^number = .*\n(?=source)|^\[note\]\n(?:.+\n)+\n", re.MULTILINE)


def _template(language: str, kind: str = KINDS[0]) -> str:
    """Return the task file of a kind that `start` writes, with its comments in `language`.

    For a kind that has none it is made of the table of givens, in the middle of their usual ranges.
    """
    file = home(VARIANTS) / "templates" / f"{kind}.{language}.toml"
    return file.read_text(encoding="utf-8") if file.exists() else _drafted(kind)


def _drafted(name: str) -> str:
    """Return a task file for what a table of givens describes."""
    table = next(table for table, module in MODULES.items() if module.rpartition(".")[2] == name)
    kind = kind_of(table)
    words = {key: given.default or given.choices[0] for key, given in kind.givens.items() if given.choices}
    numbers = {key: given for key, given in kind.givens.items() if not given.choices}
    head = {"id": f"my-{name}", "source": "-", "notation": "nau", "plans": list(kind.plans)}
    givens = []
    for key, given in numbers.items():
        usual = f", default = {given.default:.12g}" if isinstance(given.default, float) else ""
        givens.append(f'{key} = {{ unit = "{given.unit or 1}"{usual} }}')
    ranged = {key: given.usual for key, given in numbers.items() if given.default is None and given.usual is not None}
    rows = (f"{key} = {math.sqrt(least * most):.3g}" for key, (least, most) in ranged.items())
    return "\n".join((
        *(f"{key} = {json.dumps(value)}" for key, value in head.items()),
        *("", "[title]", *(f'{language} = "{name}"' for language in LANGUAGES)),
        *("", "[givens]", *givens),
        *("", f"[{table}]", *(f'{key} = "{word}"' for key, word in words.items())),
        *("", "[[variant]]", 'id = "1"', *rows, ""),
    ))  # fmt: skip


def shown(task: str, language: str) -> str:
    """Return a bundled task with its comments in one language. Raises InputError: there is none of that name."""
    text = text_of(task)
    return spoken(load_task(task), text, language)


def spoken(task: Task, text: str, language: str) -> str:
    """Return the text of a bundled task with comments in one language: what it is, what parts and givens are.

    That of a user stays as it is.
    """
    about = dict(_ABOUT.findall(text)).get(language)
    if about is None:
        return text
    return _comment(about.replace("\n#     ", " ")) + _told(task, _ABOUT.sub("", text), language)


def _comment(said: str) -> str:
    return textwrap.fill(said, 120, initial_indent="# ", subsequent_indent="# ", break_on_hyphens=False) + "\n"


def _usual(text: str, language: str) -> str:
    return _template(language, MODULES[table_in(HEADS.findall(text))].rpartition(".")[2])


def _told(task: Task, text: str, language: str) -> str:
    """Return a text with comments: before the first table of each sort, behind each given."""
    for said, head in reversed(_TOLD.findall(_usual(text, language))):
        text = re.sub(rf"^(?:#.*\n)*{re.escape(head)}$", f"{said}{head}", text, count=1, flags=re.MULTILINE)
    words = replace(Words.of(language, task.notation), letters={of: of for of in _POINT.findall(text)})
    rows = _GIVENS.findall(text)[0].splitlines()
    wide = max(len(row) for row in rows if len(row) < _WIDE)
    called = (plain(kind_of(task.kind).called(task.subject, words, row.split()[0])) for row in rows)
    told = (f"{row:{wide}}  # {name}".rstrip(" #") for row, name in zip(rows, called, strict=True))
    return _GIVENS.sub(lambda _: "\n".join((*told, "")), text)


def _copied(source: str, language: str) -> str:
    """Return a bundled task as one's own: comments in a language, no number, source or note of another's."""
    whole = shown(source, language)
    usual, about = _usual(whole, language), summary(source)
    said = messages(language)["task-copied"].format(task=source, title=about["title"][language])
    how = _FIRST.sub(rf"\g<1>{about['variants'][0]}", "".join(_HOW.findall(usual)[:1]))
    text = _FOREIGN.sub("", whole)
    for key in _KEYS:
        text = text.replace(key.findall(text)[0], key.findall(usual)[0], 1)
    head, _, rest = text.partition("\nid = ")
    return "".join((_comment(said), "#\n", head, "\n", how, "\nid = ", rest)).replace(_OWN.findall(usual)[0], source)


def start(file: str | os.PathLike[str], language: str, kind: str = KINDS[0], source: str | None = None) -> Path:
    """Write a task file to begin with: of a kind, its comments in a language, or a copy of a bundled one, `source`.

    Its path is returned. A name without a suffix gets one; a file that is there already stays, and is an error.
    """
    path = Path(file)
    shown = quote(path, SHOWN)
    if "\0" in str(path) or not path.name:
        raise InputError("output-name", file=shown)
    if not path.suffix:
        path = path.with_suffix(SUFFIX)
        shown = quote(path, SHOWN)
    if path.suffix != SUFFIX:
        raise InputError("output-suffix", file=shown, known=SUFFIX)
    if not path.parent.is_dir():
        raise InputError("output-folder-missing", file=shown, folder=quote(path.parent, SHOWN))
    called = f'"{path}"' if " " in str(path) else str(path)
    text = _template(language, kind) if source is None else _copied(source, language)
    own = _OWN.findall(text)[0]
    text = text.replace(f'"{own}"', f'"{_label(path.stem) or own}"').replace(f"{own}{SUFFIX}", called)
    text = _LABELLED.sub(lambda found: f"{found[1]:36}", text)
    try:
        with path.open("x", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    except FileExistsError as error:
        raise KeptError("output-exists", file=shown) from error
    except OSError as error:
        raise InputError("output-refused", file=shown, reason=error.strerror or "") from error
    return path


def called(text: str, path: Path) -> str:
    """Return a task file that is called by its own name, where an id is in it: messages and forms say that."""
    own = _label(path.stem)
    return _ID.sub(lambda _: f'id = "{own}"', text, count=1) if own else text


def _label(stem: str) -> str:
    """Return the id of a task out of the name of its file, nothing where there is none in it."""
    return re.sub(r"^[.-]+|[^\w.-]+", "-", stem).strip("-")
