"""The one reader of task files: bundled ones by id, one's own by path; every fault with its line and column."""

from __future__ import annotations

import os
import re
import shlex
import stat
import time
import tomllib
from contextlib import suppress
from dataclasses import replace
from functools import cache, partial
from pathlib import Path as FilePath
from typing import Any, BinaryIO

from ..drawing.words import notations
from ..scales.errors import LANGUAGES, InputError, Written, messages
from ..scales.names import cyrillic, latin, of_its_kinds, of_kind, unknown
from ..scales.numbers import SHOWN, quote
from ..scales.scale import ANGLES, LENGTHS, METRE, PAPER, chooser
from .case import Kind, kind_of
from .checks.basics import (
    Checker,
    EnoughError,
    Field,
    Path,
    Places,
    array_of,
    as_is,
    label,
    one_of,
    record,
    text,
    whole_number,
)
from .checks.names import Names, Settings, read_choices, read_givens, read_variants
from .kinds import table_in
from .shelf import bundled, bundled_text, called, numbered
from .task import WITH_FORCES, AnyTask, Given, LocatedError, Task, decoded

FEW = 3  # tasks that a word may be meant for
LARGEST_FILE = 1_000_000
TRIED_FOR = 1.3  # seconds of processor time in which a file is read and its variants are tried
# tomllib takes time as the square of the parts of a dotted key
_LONG_KEY = re.compile(r"""(?<![\w-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){64}""")

_BARE = re.compile(r"""(?<![\w"'.-])[-+−]?[0-9]+([.][0-9]+)?(,[0-9]+|[ \t]*(?!\d)[\w°][^,#\]}]*)""")  # 50,5 or 50 deg
_ROWS = re.compile(r"\s*\[+\s*(variant|(?:mechanism|cam)\.(?!driver)\w+)\s*\]")  # what stands several times
_MARKS = re.compile(r"[“”„‟«»″]|(?<!\w)[‘’‚‹›]|[‘’‚‹›](?!\w)")  # word processors put them for straight ones
_COLON = re.compile(r"([\w.-]+)\s*:\s*(.+)")
_ENDED = re.compile(r"""([\w.-]+\s*=\s*(?:[-+]?[0-9][0-9.]*|"[^"]*"|'[^']*'|\[[^]]*\]|\{[^}]*\}))\s*[,;.]""")
_WORDS = re.compile(
    r"""([\w.-]+)\s*=\s*([^\W\d_][^"'=]*|[-+−]?[0-9]+(?:[.][0-9]+)?(?:,[0-9]+|\s*[^\W\d][^"'=]*|\s*°[^"'=]*))"""
)
_PART = re.compile(r'''"""(?:.|\n)*?"""|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#[^\n]*|[][{}]''')  # texts, comments, brackets
_KEY, _VALUE = re.compile(r"""[\w.-]+\s*="""), re.compile(r"""["'[{0-9+-]""")
_BEGINS = re.compile(r"[ \t]*(?:\[+[ \t]*[^\W\d][\w.]*[ \t]*\]|[\w.-]+[ \t]*=)")
_OPEN = re.compile(r"""[\w.-]+\s*=\s*"[^"]*""")


class TaskFileError(InputError):
    """The faults of a task file; as one line it shows the first and says how many more there are."""

    def __init__(self, file: str, faults: tuple[InputError, ...]) -> None:
        """Collect `faults` of `file`, in the order of its lines."""
        super().__init__(faults[0].key, **faults[0].data)
        self.file = file
        self.faults = faults

    def text(self, language: str = "en") -> str:
        """Return the first fault as one line in `language`, and the number of the others."""
        line = self.faults[0].text(language)
        if len(self.faults) == 1:
            return line
        more = messages(language)["and-more"].format(n=len(self.faults) - 1, file=shlex.quote(self.file))
        return f"{line} {more}"


@of_its_kinds()
def load_task(task: AnyTask) -> Task:
    """Return the bundled task of this id, or the task in a TOML file; one that is read already as it is.

    Raises
    ------
    InputError
        No such task or file, a file that cannot be read, or (`TaskFileError`) one with faults.
    """
    if isinstance(task, Task):
        return task
    of_kind("task", task, (str, os.PathLike), "str | PathLike | Task")
    if isinstance(task, str) and "\n" in task:
        raise InputError("task-text")
    named = numbered(task) if isinstance(task, str) and not os.path.exists(task) else task
    if isinstance(named, str) and named in bundled():
        return _load_bundled(named)
    shown = _shown(task)
    return task_of(_file_text(task, shown), shown)


def task_of(toml: str, file: str) -> Task:
    """Return the task in the text of a file that messages call `file`; one with faults is a `TaskFileError`."""
    found, faults = read_text(toml, file)
    if found is None:
        raise TaskFileError(file, faults)
    return found


def check_file(task: str | os.PathLike[str]) -> tuple[tuple[InputError, ...], tuple[InputError, ...]]:
    """Return the faults of a bundled task or of a file, those too that only solving each variant tells, and remarks."""
    shown = _shown(task)
    if isinstance(task, str) and task in bundled():
        return check_text(bundled_text(task), shown)
    return check_text(_file_text(task, shown), shown)


def read_text(toml: str, file: str) -> tuple[Task | None, tuple[InputError, ...]]:
    """Read a task from the text of a file that messages call `file`: the task, or all its faults."""
    return _read(toml, file)[:2]


def check_text(toml: str, file: str) -> tuple[tuple[InputError, ...], tuple[InputError, ...]]:
    """Return faults and remarks of the text of a file that messages call `file`, as `check_file`."""
    return _read(toml, file, thorough=True)[1:]


def _read(
    toml: str, file: str, thorough: bool = False
) -> tuple[Task | None, tuple[InputError, ...], tuple[InputError, ...]]:
    """Read a task: it, unless it has faults, its faults and remarks; if `thorough` its variants are solved."""
    try:
        if _LONG_KEY.search(toml):
            raise RecursionError
        raw = tomllib.loads(toml)
        checker = Checker(file, Places(toml))
    except RecursionError as error:
        raise LocatedError(file, InputError("toml-nested")) from error
    except ValueError as error:
        return None, (syntax_fault(toml, file, str(error)),), ()
    found = None
    with suppress(EnoughError):
        found = _task(checker, raw, thorough)
    # in the order of the lines of the file
    faults, remarks = (
        tuple(error for _, _, error in sorted(located, key=lambda one: one[:2]))
        for located in (checker.faults, checker.remarks)
    )
    return None if checker.faults else found, faults, remarks


@cache
def _load_bundled(task: str) -> Task:
    """Return a bundled task; its `file` is `None`."""
    return replace(task_of(bundled_text(task), f"{task}.toml"), file=None)


def _shown(task: str | os.PathLike[str]) -> str:
    """Return a path as messages show it, without control characters."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in os.fspath(task))


def _file_text(task: str | os.PathLike[str], shown: str) -> str:
    """Return the text of a regular file of at most 1 MB."""
    path = FilePath(task)
    if not shown.strip():
        raise unknown("task-unknown", shown, bundled())
    try:
        state = path.stat()
    except (OSError, ValueError) as error:
        if isinstance(task, str) and not re.search(r"[./\\]", task):
            if os.path.isfile(f"{task}.toml"):
                raise InputError("task-unknown-like", text=quote(task), like=quote(f"{task}.toml")) from error
            refused = unknown("task-unknown", task, bundled())
            part = any(task.casefold() in one for one in bundled())  # of names, which are told then
            meant = [] if part or refused.key != "task-unknown" else [one["id"] for one in called(task)]
            if not 0 < len(meant) <= FEW:
                raise refused from error
            raise InputError("task-unknown-like", text=quote(task), like=Written(", ".join(meant))) from error
        raise InputError("file-missing", file=quote(shown, 200)) from error
    if not stat.S_ISREG(state.st_mode):
        raise InputError("file-not-regular", file=shown)
    if state.st_size > LARGEST_FILE:
        raise InputError("file-large", file=shown, n=LARGEST_FILE // 1_000_000)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError("file-unreadable", file=shown) from error
    return _text_of(data, shown)


def task_of_stream(stream: BinaryIO, shown: str) -> Task:
    """Return the task in a stream of bytes, such as standard input, as one in a file that messages call `shown`."""
    data = stream.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise InputError("file-large", file=shown, n=LARGEST_FILE // 1_000_000)
    text = _text_of(data, shown)
    return replace(task_of(text, shown), written=text)


def _text_of(data: bytes, shown: str) -> str:
    """Return the text of a task file."""
    if not data.strip():
        raise InputError("file-empty", file=shown)
    try:
        text = decoded(data)
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise LocatedError(f"{shown}:{line}", InputError("file-encoding")) from error
    if "\0" in text:
        raise LocatedError(f"{shown}:{text.count(chr(10), 0, text.index(chr(0))) + 1}", InputError("file-binary"))
    return text


def syntax_fault(toml: str, file: str, reason: str) -> InputError:
    """Return the fault that tomllib found in a text, at its place, with its cure."""
    lines = toml.replace("\r\n", "\n").split("\n")
    found = re.search(r"\(at line ([0-9]+), column ([0-9]+)\)", reason)
    # Python refuses to read a number of so many digits, and tomllib does not say where it stands
    endless = re.search(r"(?<![0-9_])[0-9_]{4000}", toml)
    if endless and not found:
        before = toml[: endless.start()].split("\n")
        place = f"{file}:{len(before)}:{len(before[-1]) + 1}"
        return LocatedError(place, InputError("number-infinite", text=quote(endless[0])))
    line, column = (int(found[1]), int(found[2])) if found else (len(lines), len(lines[-1]) + 1)
    written = lines[line - 1] if line <= len(lines) else ""
    if re.match("Cannot (overwrite|declare|mutate)|Duplicate", reason):
        column = len(written) - len(written.lstrip()) + 1
        key = re.search(r"(?:inline table key |immutable namespace \()'(.*?)'", reason)
        text = quote(key[1] if key else written.split("=")[0].strip())
        rows = _ROWS.match(written)
        single = re.search(rf"^\s*\[\s*{re.escape(rows[1])}\s*\]", toml, re.MULTILINE) if rows else None
        if rows and single:  # where it should be [[...]]
            line = toml.count("\n", 0, toml.index("[", single.start())) + 1
            return LocatedError(f"{file}:{line}:1", InputError("toml-rows", text=text, cure=Written(f"[[{rows[1]}]]")))
        return LocatedError(f"{file}:{line}:{column}", InputError("toml-twice", text=text))
    offset = sum(len(one) + 1 for one in lines[: line - 1]) + column - 1
    whole, quoted = "\n".join(lines), _MARKS.search(written) or written.count('"') % 2
    if not quoted and (missing := _in_brackets(whole, offset)) is not None:
        at, error = missing
        before = whole[:at].split("\n")
        return LocatedError(f"{file}:{len(before)}:{len(before[-1]) + 1}", error)
    return LocatedError(f"{file}:{line}:{column}", _ill_written(written, column))


def _in_brackets(toml: str, offset: int) -> tuple[int, InputError] | None:
    """Return what is missing within brackets before an offset, and where: a comma, or the bracket that closes them."""
    start = toml.rfind("\n", 0, offset) + 1
    begun = _opened(toml[:start])
    if begun and _BEGINS.match(toml, start):  # the next table, or the next key
        return begun[-1], InputError("toml-unclosed", text=quote(_line(toml, begun[-1])))
    opened = _opened(toml[:offset])
    if not opened:
        return None
    table, rest = toml[opened[-1]] == "{", toml[offset:].lstrip(" \t")
    before = _PART.sub(lambda part: "" if part[0].startswith("#") else part[0], toml[:offset]).rstrip()
    if (_KEY if table else _VALUE).match(rest) and before[-1:] not in ("", ",", "=", "[", "{"):
        last = before.rpartition("\n")[2].split()[-1]
        end = toml.rindex(last, 0, offset) + len(last)
        return end, InputError("toml-comma", text=quote(toml[end - len(last) :].partition("\n")[0]), cure=f"{last},")
    if table and (not rest or rest.startswith(("\n", "#"))):
        return opened[-1], InputError("toml-unclosed", text=quote(_line(toml, opened[-1])))
    return None


def _line(toml: str, at: int) -> str:
    return toml[toml.rfind("\n", 0, at) + 1 :].partition("\n")[0].strip()


def _opened(toml: str) -> list[int]:
    """Return where the brackets stand that are open at the end of a text, the innermost last."""
    opened = list[int]()
    for part in _PART.finditer(toml):
        if part[0] in "[{":
            opened.append(part.start())
        elif part[0] in "]}" and opened:
            opened.pop()
    return opened


def _ill_written(line: str, column: int) -> InputError:
    """Return what is wrong at a column of a line that is no TOML, with the cure where it is known."""
    plain = line.partition(" #")[0].strip()
    shown = quote(plain)
    marks = _MARKS.findall(plain)
    if marks and (line[column - 1 : column] in marks or plain.count('"') % 2):
        return InputError("toml-quotes", text=shown, mark=Written(marks[0]), cure=quote(_MARKS.sub('"', plain), SHOWN))
    if colon := _COLON.fullmatch(plain):
        return InputError("toml-colon", text=shown, cure=quote(f"{colon[1]} = {colon[2]}", SHOWN))
    if ended := _ENDED.fullmatch(plain):
        return InputError("toml-end", text=shown, cure=quote(ended[1], SHOWN))
    if bare := _WORDS.fullmatch(plain):
        return InputError("toml-bare", text=shown, cure=quote(f'{bare[1]} = "{bare[2]}"', SHOWN))
    for value in _BARE.finditer(line):
        if value.start() < column <= value.end() + 1:
            return InputError("toml-bare", text=shown, cure=quote(f'"{value[0].strip()}"', SHOWN))
    if _OPEN.fullmatch(plain):
        return InputError("toml-open", text=shown, cure=quote(f'{plain}"', SHOWN))
    word = next((word[0] for word in re.finditer(r"\w+", line) if word.start() < column <= word.end()), "")
    if latin(word) != word:
        return cyrillic(word)
    if word and re.search(rf"=\s*{word}\s*[,}}\]]", line):  # phi = sixty, in a row
        return InputError("toml-bare", text=shown, cure=quote(f'"{word}"', SHOWN))
    return InputError("toml-bad", text=shown)


def _scales(checker: Checker, path: Path, raw: object) -> dict[str, str]:
    """Read `[scales]`: choosers such as `"pa=80 mm"` or `"15 N/mm"`."""
    good = {}
    for name, value in checker.table(path, raw).items():
        written = text(checker, (*path, name), value)
        if written is None:
            continue
        with checker.at((*path, name)):
            chooser(name, written)
            good[name] = written
    return good


_SAID = {language: Field(text, required=False) for language in LANGUAGES}


def _said(checker: Checker, path: Path, raw: object) -> dict[str, str]:
    """Read what is said in a language or more; where one says nothing, the first of the others stands."""
    before, read = len(checker.faults), record(checker, path, raw, _SAID)
    if not read and len(checker.faults) == before:
        checker.fault(path, InputError("key-missing", name=LANGUAGES[0]))
    return {language: read.get(language, said) for said in [*read.values()][:1] for language in LANGUAGES}


def _in_languages(checker: Checker, path: Path, raw: object) -> Any:
    """Read the title, or where numbers come from: in a text for all languages, or in a language or more."""
    if not isinstance(raw, str):
        return _said(checker, path, raw)
    return dict.fromkeys(LANGUAGES, said) if (said := text(checker, path, raw)) else None


_UNITS = {"length": LENGTHS, "size": LENGTHS, "paper": PAPER, "angle": ANGLES}  # of results; of segments
_IN_UNITS = {
    name: Field(one_of("display-unit", partial(tuple, known)), required=False) for name, known in _UNITS.items()
}
_FIELDS = {  # and the table of its kind
    "id": Field(label),
    "number": Field(whole_number, required=False),
    "source": Field(_in_languages),
    "notation": Field(one_of("notation-unknown", notations)),
    "title": Field(_in_languages),
    "note": Field(_said, required=False),
    "givens": Field(as_is),
    "choices": Field(as_is, required=False),
    "scales": Field(_scales, required=False),
    "display": Field(lambda checker, path, raw: record(checker, path, raw, _IN_UNITS), required=False),
    "variant": Field(as_is),
}


def _task(checker: Checker, raw: dict[str, Any], thorough: bool) -> Task | None:
    """Read a task out of parsed TOML; the faults go to `checker`."""
    table = table_in(raw)
    kind = kind_of(table)
    own = {"plans": Field(array_of(one_of("plan-unknown", lambda: kind.plans))), table: Field(as_is)}
    head = record(checker, (), raw, _FIELDS | own)
    givens = read_givens(checker, raw["givens"]) if "givens" in raw else {}
    choices = read_choices(checker, raw.get("choices", {}), givens, _words(kind, raw.get(table)))
    names = _names(checker, givens, choices)
    subject = kind.read(checker, raw[table], names, givens) if table in raw else None
    givens = {key: _bounded(checker, given, names) for key, given in givens.items()}
    variants = read_variants(checker, raw["variant"], givens, names.optional) if "variant" in raw else {}
    _signs(checker, names, choices)
    units = head.get("display", {})
    # a unit for whatever has lengths is that of lengths alone, too
    display = replace(kind.display, **{"size": "", **units} if "length" in units else units)
    if display.length != METRE and WITH_FORCES.intersection(head.get("plans", ())):
        checker.fault(("display", "length"), InputError("display-forces"))
    if subject is not None and "plans" in head:
        kind.fits(checker, subject, head)
    if checker.faults or subject is None:
        return None
    task = Task(
        **{name: head[name] for name in ("id", "title", "source", "notation", "plans")},
        givens=givens,
        choices={
            key: {word: {name: s.value for name, s in settings.items()} for word, settings in words.items()}
            for key, words in choices.items()
        },
        constants=names.constants,
        subject=subject,
        scales=head.get("scales", {}),
        display=display,
        variants=variants,
        file=checker.file,
        kind=table,
        instead=kind.instead,
        note=head.get("note", {}),
        number=head.get("number", 0),
    )
    kind.varies(checker, task)
    if thorough:
        _try(checker, kind, task)
    return None if checker.faults else task


def _words(kind: Kind[Any, Any], raw: object) -> frozenset[str]:
    """Return what the table `raw` says in words that may be names of choices: these need not set numbers."""
    told = raw if isinstance(raw, dict) else {}
    return frozenset(word for key in kind.givens if isinstance(word := told.get(key), str))


def _try(checker: Checker, kind: Kind[Any, Any], task: Task) -> None:
    """Solve every variant: one that has no solution is a fault, and what else a teacher should know a remark.

    `TRIED_FOR` seconds after the file was begun it is said how many variants were not tried.
    """
    if any(path[:1] != ("variant",) for path in checker.faulty):
        return
    wrong = {path[1] for path in checker.faulty if len(path) > 1}
    for row, variant in enumerate(task.variants):
        path = ("variant", row)
        if time.process_time() - checker.begun > TRIED_FOR:
            counts = {
                "n": len(task.variants) - row,
                "all": len(task.variants),
                "file": Written(shlex.quote(checker.file)),
            }
            checker.remark(path, InputError("check-untried", **counts), variant)
            return
        if row in wrong:
            continue
        try:
            solved = kind.solve(task.subject, task.values(variant), task.words(variant), task.plans)
            error = solved.error()
        except InputError as refused:
            checker.fault(path, refused, variant)
            continue
        if error is not None:
            checker.fault(path, error, variant)
        for remark in kind.remarks(task, variant, solved):
            checker.remark(path, remark, variant)


def _names(checker: Checker, givens: dict[str, Given], choices: Settings) -> Names:
    """Return the values that the subject may name: givens and what choices set, no name twice."""
    names = Names({key: given.unit.dimension for key, given in givens.items() if given.unit is not None})
    names.dimensions.update(dict.fromkeys(checker.unread))
    names.stated.update({key: ("givens", key) for key in names.dimensions})
    for choice, words in choices.items():
        first = next(iter(words), "")
        for key, setting in words.get(first, {}).items():
            if key in names.dimensions:
                checker.twice(("choices", choice, first, key), key, names.stated[key])
            names.dimensions[key] = setting.dimension
            names.stated.setdefault(key, ("choices", choice, first, key))
    return names


def _bounded(checker: Checker, given: Given, names: Names) -> Given:
    """Return a given with the bound of what it is, which its default keeps too: a distance on a link is positive."""
    bound, default = names.bounds.get(given.name, given.bound), given.default
    if given.unit is not None and isinstance(default, float) and not bound.admits(default):
        text = quote(f"{given.unit.from_si(default):.7g} {given.unit.name}")
        checker.fault(("givens", given.name, "default"), InputError(bound.value, text=text))
    return replace(given, bound=bound)


def _signs(checker: Checker, names: Names, choices: Settings) -> None:
    """Check that senses and branches that a choice sets are +1 or -1."""
    for choice, words in choices.items():
        for word, settings in words.items():
            for key, setting in settings.items():
                if key in names.signs and abs(setting.value) != 1.0:
                    checker.fault(("choices", choice, word, key), InputError("sign-bad", text=f"{setting.value:g}"))
