"""Mutated rosters, answers and tables, workbooks among them, for the commands about classes and formats.

A third family of cases beside the two of `mutated`, with numbers of its own.
"""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Callable

from kulman.scales.choices import SIZES
from kulman.tests.support.mutated import (
    BLOCK,
    CHARTS,
    COUNTS,
    FORMATS,
    NUMBERS,
    OPTIONS,
    PRESETS,
    TEXTS,
    Case,
    Luck,
    Options,
    Tree,
    about,
    answers,
    givens,
    ruined,
    setting,
    some,
    table,
    task_file,
    tree_of,
)
from kulman.variants.kinds import KINDS
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.tables import xlsx_bytes

XML = (
    "<",
    ">",
    "&",
    "</c>",
    "<c/>",
    "<row/>",
    '="',
    "&lt;",
    "&#0;",
    "&#x1F600;",
    "]]>",
    "<!--",
    "<![CDATA[",
    "r=",
    "s",
)
TABLES = ("csv", "xlsx", "xlsx", "xlsx")  # kinds of tables that are read: mostly workbooks
Rows = list[list[str]]


def workbook(luck: Luck, rows: Rows) -> bytes:
    """Return cells as a workbook: as it is, with bytes that are others, or with a part of its XML that is another."""
    cells = [[_number(cell) if luck.random() < 0.5 else cell for cell in row] for row in ruined(luck, rows)]
    data, what = xlsx_bytes(cells, luck.of(("1",), TEXTS)), luck.random()
    if what < 0.5:
        return data
    if what < 0.7:
        return _bytes_changed(luck, data)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = {name: archive.read(name).decode("utf-8") for name in archive.namelist()}
    for _ in range(luck.choice((1, 1, 2, 4))):
        name = luck.choice([*parts])
        parts[name] = _xml_changed(luck, parts[name])
    if luck.random() < 0.1:
        del parts[luck.choice([*parts])]
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", luck.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))) as archive:
        for name, text in parts.items():
            archive.writestr(zipfile.ZipInfo(name), text.encode("utf-8", "surrogatepass"))
    return stream.getvalue()


def _number(cell: str) -> str | float:
    try:
        return float(cell)
    except ValueError:
        return cell


def _bytes_changed(luck: Luck, data: bytes) -> bytes:
    """Cut an archive off, or put other bytes into it."""
    if luck.random() < 0.2:
        return data[: luck.randrange(len(data))]
    changed = bytearray(data)
    for _ in range(luck.choice((1, 1, 3, 20))):
        changed[luck.randrange(len(changed))] = luck.randrange(256)
    return bytes(changed)


def _xml_changed(luck: Luck, text: str) -> str:
    """Change a number, lose or double an element, put a sign where none belongs."""
    what = luck.randrange(4)
    found = list(re.finditer(r"\d+" if what == 0 else r"<[^<>]*>" if what < 3 else r"\b", text))
    place = luck.choice(found)
    if what == 0:
        new = luck.choice((*NUMBERS, "16384", "16385", "1048577", "4294967296"))
    elif what == 1:
        new = ""
    elif what == 2:
        new = place[0] * luck.choice((2, 2, 3, 500))
    else:
        new = luck.choice(XML)
    return text[: place.start()] + new + text[place.end() :]


def _tabled(luck: Luck, case: Case, name: str, rows: Rows) -> str:
    """Add a table to the files of a case; return its name."""
    file = f"{name}.{luck.choice(TABLES)}"
    case.files[file] = workbook(luck, rows) if file.endswith("xlsx") else table(luck, rows)
    return file


def _roster(luck: Luck, tree: Tree) -> Rows:
    known = givens(tree)
    names = luck.sample([*known], min(len(known), luck.choice((0, 0, 1, 3))))
    head = luck.choice((["name", "group", "variant"], ["Прізвище", "група", "номер заліковки"], ["ФИО", "вариант"]))
    rows = [[*head, *names]]
    for i in range(luck.choice((1, 1, 2))):
        told = (f"Студент {i}", "1", luck.choice(("1", "2", "123456", str(i))))[-len(head) :]
        rows.append([*told, *(setting(luck, known, name) for name in names)])
    return rows


def _batch(luck: Luck, case: Case, tree: Tree) -> None:
    """Draw a class of a student or two."""
    if luck.random() < 0.15:
        case.arguments += ["--form", luck.of(("f.csv", "f.xlsx"), TEXTS)]
    if luck.random() < 0.9:
        roster = _tabled(luck, case, "roster", _roster(luck, tree))
        case.arguments += ["--roster", roster, "--out", luck.of(("out",), ("roster.csv", "out/out", "я", "x" * 300))]
    case.arguments += ["--jobs", "1", "--as", luck.of(("svg", "handout", "note", "pdf"), TEXTS)]
    block = {name: value for name, value in BLOCK.items() if name not in ("--student", "--tile")}
    case.arguments += some(luck, tree, {**block, "--digits": OPTIONS["check"]["--digits"]}, 0.15)


def _check(luck: Luck, case: Case, tree: Tree) -> None:
    """Mark answers in workbooks, of a student or a class, against a sheet of any format."""
    file = _tabled(luck, case, "answers", answers(luck))
    case.arguments += [file, "--jobs", "1"]
    own: Options = {
        **{"--format": FORMATS, "--preset": PRESETS, "--verdict-only": None, "--out": (("out",), ("a" * 300,))},
        **{"-o": (("r.html", "r.csv", "r.xlsx"), TEXTS), "--form": (("form.xlsx",), TEXTS)},
        **{"--moodle": (("m.csv",), TEXTS), "--digits": OPTIONS["check"]["--digits"]},
        "--directions": (("required", "optional", "ignored"), TEXTS),
    }
    case.arguments += some(luck, tree, own, 0.25)
    if luck.random() < 0.4:
        case.arguments += ["--roster", _tabled(luck, case, "roster", _roster(luck, tree))]


def _variants(luck: Luck, case: Case, tree: Tree) -> None:
    """Read new variants from a workbook, parameters in rows or in columns."""
    known = givens(tree)
    rows = [["id", "1", "2"], *([name, *(setting(luck, known, name) for _ in "12")] for name in known)]
    if luck.random() < 0.4:
        rows = [list(column) for column in zip(*rows, strict=True)]
    case.arguments += ["--from", _tabled(luck, case, "table", rows)]
    case.arguments += some(luck, tree, OPTIONS["variants"], 0.2)


def _chart(luck: Luck, case: Case, tree: Tree) -> None:
    """Measure several charts at once; that of accuracy measures times and has its turn among those that draw."""
    kind = next((kind for kind in CHARTS if kind in tree), "cam")
    charts = [luck.of([name for name in CHARTS[kind] if name != "accuracy"], (*TEXTS, "depth")) for _ in "12"]
    case.arguments += ["--chart", ",".join(charts), "--positions", luck.of(("8", "12"), COUNTS)]
    case.arguments += some(luck, tree, {**OPTIONS["chart"], "-o": (("c.csv", "c.svg"), TEXTS)}, 0.2)


def _formats(luck: Luck, case: Case, tree: Tree) -> None:
    """Draw on a format, cut for a small printer."""
    case.arguments += ["-o", luck.of(("x.pdf", "x.svg"), TEXTS), "--format", luck.of(SIZES, TEXTS)]
    case.arguments += some(luck, tree, BLOCK, 0.3)


def _new(luck: Luck, case: Case, tree: Tree) -> None:
    """Begin a task file."""
    names = [name for name in TEXTS if not {"/", "\\"} & {*name}]
    case.arguments[1:] = [luck.of(("new.toml", "новий", "task.toml"), names)]
    case.arguments += some(luck, tree, {"--kind": (KINDS, TEXTS)}, 0.7)


def _list(luck: Luck, case: Case, tree: Tree) -> None:
    """Show the tasks."""
    case.arguments[1:] = some(luck, tree, {"--json": None, "--check": (("task.toml",), TEXTS)}, 0.5)


COMMANDS: dict[str, tuple[int, Callable[[Luck, Case, Tree], None]]] = {
    **{"batch": (25, _batch), "check": (30, _check), "variants": (20, _variants), "chart": (8, _chart)},
    **{"sheet": (5, _formats), "handout": (5, _formats), "new": (4, _new), "list": (3, _list)},
}


def made(n: int) -> Case:
    """Return case `n` of the commands about classes and formats."""
    luck = Luck(f"{n} classes")
    command = luck.choices([*COMMANDS], [weight for weight, _ in COMMANDS.values()])[0]
    if luck.random() < 0.5:
        text, tree = task_file(luck)
        case = Case([command, "task.toml"], {"task.toml": text.encode("utf-8", "surrogatepass")})
    else:
        task = luck.choice(sorted(bundled()))
        case, tree = Case([command, task]), json.loads(tree_of(bundled_text(task)))
    if command not in ("new", "list"):
        case.arguments += [word for word in about(luck, tree, 0.08) if word != "-v" or command != "batch"]
    COMMANDS[command][1](luck, case, tree)
    if luck.random() < 0.2:
        case.arguments[:0] = ["--lang", luck.of(("uk", "ru", "en"), TEXTS)]
    case.language = luck.choice(("uk", "ru", "en"))
    case.arguments = [argument.replace("\0", "") for argument in case.arguments]
    return case
