"""Mutated task files and options for every command: case N is the same on every machine.

`mutated_runs` runs them, the soak some of them (`tests/commands/test_mutated.py`).
"""

from __future__ import annotations

import io
import json
import math
import random
import re
import shlex
import tomllib
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from kulman.scales.choices import HANDS, SIZES
from kulman.variants.kinds import KINDS
from kulman.variants.making.starter import _template
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.tables import _xlsx_bytes

# What stands in the place of a good value: extreme numbers and no numbers, right and wrong units, hostile texts, kinds.
NUMBERS = (
    *("0", "-0", "1", "-1", "2", "0.5", "1e-12", "9e-13", "1e9", "1.1e9", "1e15", "1e154", "1e308", "1e309", "5e-324"),
    *("2.3e-308", "nan", "inf", "-inf", "∞", "1/3", "1/0", "0/0", "1,5", "1 000", "1.000,5", "0x10", "1e", "--1", ""),
    *(" ", "½", "٣", "−5", "1e5000", "9" * 400, "0.1+0.2", "30°15′", "360", "180", "90", "89.999999999999", "1e-9"),
)
UNITS = (
    *("", "mm", "m", "km", "um", "deg", "rad", "rev", "rpm", "rad/s", "kg", "g", "t", "kg*m^2", "N", "kN", "N*m"),
    *("MPa", "Pa", "s", "m/s", "m/s^2", "%", "об/хв", "мм", "кН", "1/mm", "m^4", "mm^9", "furlong", "mm/mm"),
    *("(m/s)/mm", "1/s"),
)
TEXTS = (
    *("", " ", "x", "A", "O", "l_OA", "-l_OA", "О", "а́", "\u202eabc", "\u200b", "\x00", "\n", '"', "'", "{}"),
    *("{0}", "%s"),
    *("=1+1", "../x", "a" * 300, "я" * 300, "\ud7ff", "😀", "nul", "_constant_1", "B" * 70, "id", "1", "R_12", "mu_l"),
    *("velocity", "all", "None", "true", "a,b", ",", "\t", "<b>", "&amp;", "$x$", "_{a}", "^", "\\", "/", "F_3", "V_B"),
)
VALUES: tuple[Any, ...] = (
    *(0, 1, -1, 2, 7, 99, 100, 10**9, 10**30, -(10**400), 0.0, -0.5, 1e-300, 1e154, 1e308, math.inf, math.nan, True),
    *([], {}, [[]], [{}], [1, 2], ["0 mm", "0 mm"], [0, 1], [1, 1], {"a": 1}, [[[[[[1]]]]]], {"a": {"a": {"a": {}}}}),
    "",
)
PLANS = (
    *("structure", "position", "velocity", "acceleration", "forces", "lever", "compound", "cycle", "diagrams", "sizes"),
    *("profile", "pressure", "geometry", "meshing", "sliding", "scheme", "roots", "circle", "beams"),
)
NOTATIONS = ("artobolevsky", "bauman", "bertyaev", "iso", "madi", "nau")
QUANTITIES = (
    *("V_B", "a_B", "M_bal", "omega_2", "F_bal", "R_12", "r_0", "a_w", "S_max", "F_max", "B", "l_OA", "mu_V", "mu_a"),
    *("omega_1", "V_A", "V_BA", "a_A", "a_BA_n", "epsilon_2", "F_3", "h_2", "mu_F_23", "mu_l", "F_i2", "M_i2", "R_03"),
)
SCALES = ("mu_l", "mu_V", "mu_a", "mu_s", "mu_F_23", "mu_F_1", "pa", "p'a'", "OA", "pb")
Tree = dict[str, Any]
_WRITTEN = re.compile(r"[-+]?[0-9].*")
_NAME = re.compile(r"[A-Za-z]\w*")
_FLOAT = re.compile(r"[-+]?[0-9]+(?:[.][0-9]+)?(?:[eE][-+]?[0-9]+)?")


@dataclass
class Case:
    """A command line, the files that it reads by name, and the language of the system."""

    arguments: list[str]
    files: dict[str, bytes] = field(default_factory=dict)
    language: str = "en"

    @property
    def line(self) -> str:
        """The command as a shell takes it."""
        return f"LC_ALL={self.language} kulman {shlex.join(self.arguments)}"


@cache
def sources() -> tuple[str, ...]:
    """The texts of all bundled tasks, and of the templates of each kind, which have more of its keys."""
    return (*map(bundled_text, sorted(bundled())), *(_template("en", kind) for kind in KINDS))


@cache
def tree_of(source: str) -> str:
    """Return the JSON of a task, its variants cut down to three: solving all of them takes most of the time."""
    raw = tomllib.loads(source)
    return json.dumps({**raw, "variant": raw["variant"][:3]}, default=str)


class Luck(random.Random):
    """Random choices of one case; `wild` is how often something is chosen that nobody would write."""

    def __init__(self, seed: str) -> None:
        super().__init__(seed)
        self.wild = self.choice((0.0, 0.01, 0.03, 0.15, 0.6))

    def of(self, good: Sequence[Any], bad: Sequence[Any]) -> Any:
        """Return one of the good, or, as often as this case is wild, of the bad."""
        return self.choice(bad if not good or self.random() < self.wild else good)

    def number(self, like: object = None) -> str:
        """Return a number near that which stands there, far from it, or an extreme one; with its unit, or another."""
        if isinstance(like, (int, float)) and not isinstance(like, bool):
            like = str(like)
        value, _, rest = like.partition(" ") if isinstance(like, str) else ("", "", "")
        if self.random() < self.wild or not _FLOAT.fullmatch(value):
            return f"{self.choice(NUMBERS)} {self.of((rest,), UNITS)}".strip()
        power = self.choice((0.0, 0.1, 0.3, 1.0, 6.0, 12.0))
        factor = self.of((1.0,), (1.0, -1.0, 0.0)) * 10.0 ** self.uniform(-power, power)
        shown = f"{float(value) * factor:.{self.choice((2, 3, 17))}g}"
        return f"{shown} {self.of((rest,), UNITS)}".strip()


Options = Mapping[str, Callable[[Luck, Tree], str] | tuple[Sequence[str], Sequence[str]] | None]


# --- task files -------------------------------------------------------------------------------------------------------


def places(tree: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the paths of everything that stands in a tree."""
    items: list[tuple[Any, Any]] = []
    if isinstance(tree, dict):
        items = list(tree.items())
    elif isinstance(tree, list):
        items = list(enumerate(tree))
    return [place for key, value in items for place in ((*path, key), *places(value, (*path, key)))]


def at(tree: Any, path: tuple[Any, ...]) -> Any:
    """Return what stands at a path."""
    for key in path:
        tree = tree[key]
    return tree


def mutate(luck: Luck, tree: Tree) -> None:
    """Change one thing in a task: a value, a key, a whole table."""
    known = places(tree)
    if luck.random() >= luck.wild:  # a number, or sometimes the name of one, of a point, of a word
        written = _WRITTEN if luck.random() < 0.8 else _NAME
        known = [path for path in known if written.fullmatch(str(at(tree, path)))] or known
    if not known:
        return
    path = luck.choice(known)
    parent, key, value = at(tree, path[:-1]), path[-1], at(tree, path)
    alike = [other for other in known if other[-1] == key] if luck.random() < 0.8 else known
    if luck.random() < luck.wild:
        _ruin(luck, parent, key, known)
    elif luck.random() < 0.7 and _WRITTEN.fullmatch(str(value)):
        parent[key] = luck.number(value)
    else:  # what stands elsewhere: references to other points and links, loops, equal lengths
        parent[key] = json.loads(json.dumps(at(tree, luck.choice(alike))))


def _ruin(luck: Luck, parent: Any, key: Any, known: list[tuple[Any, ...]]) -> None:
    """Lose, double, rename, shuffle or wrap up what stands at a key, or put something else there."""
    value, what = parent[key], luck.randrange(7)
    if what == 0:
        parent[key] = luck.choice((*TEXTS, *VALUES))
    elif what == 1:
        del parent[key]
    elif what == 2 and isinstance(parent, list):
        more = luck.randint(10, 200) if luck.random() < 0.02 else 1
        parent[key:key] = [json.loads(json.dumps(value)) for _ in range(more)]
    elif what == 3 and isinstance(parent, dict):
        names = (*TEXTS, f"{key}x", key[:-1], *(str(other[-1]) for other in known[:40]))
        parent[luck.choice(names)] = parent.pop(key)
    elif what == 4 and isinstance(value, list):
        luck.shuffle(value)
    elif what == 5 and isinstance(value, dict):
        parent[key] = [value]
    else:
        parent[key] = {str(key): value} if luck.random() < 0.5 else [value]


def toml(value: Any) -> str:
    """Return a value as TOML writes it within a line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml(str(key))} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value).lower() if isinstance(value, bool) or value != value else str(value)


def written(table: dict[str, Any], path: tuple[str, ...] = ()) -> list[str]:
    """Return a table as the lines of a TOML file."""
    lines, after = [], []
    for key, value in table.items():
        name = key if str(key).isascii() and str(key).replace("_", "").isalnum() else toml(str(key))
        if isinstance(value, dict):
            after += [f"[{'.'.join((*path, name))}]", *written(value, (*path, name))]
        elif isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
            for item in value:
                after += [f"[[{'.'.join((*path, name))}]]", *written(item, (*path, name))]
        else:
            lines.append(f"{name} = {toml(value)}")
    return lines + after


def mangled(luck: Luck, text: str) -> str:
    """Change the letters of a file: lines lost, doubled or swapped, signs put in, the end cut off."""
    lines = text.split("\n")
    i, k = luck.randrange(len(lines)), luck.randrange(len(lines))
    what = luck.randrange(6)
    if what == 0:
        del lines[i]
    elif what == 1:
        lines.insert(i, lines[k])
    elif what == 2:
        lines[i], lines[k] = lines[k], lines[i]
    elif what == 3:
        at = luck.randint(0, len(lines[i]))
        lines[i] = lines[i][:at] + luck.choice((*TEXTS, *NUMBERS, "]", "[", "=", "#", '"""')) + lines[i][at:]
    elif what == 4:
        lines = lines[: i + 1]
    else:
        at = luck.randint(0, len(lines[i]))
        lines[i] = lines[i][:at] + lines[i][at + luck.randint(1, 3) :]
    return "\n".join(lines)


def task_file(luck: Luck) -> tuple[str, Tree]:
    """Return a mutated task file, and what it was made of."""
    tree = json.loads(tree_of(luck.choice(sources())))
    for _ in range(luck.choice((0, 1, 1, 1, 2, 2, 3, 5, 8))):
        mutate(luck, tree)
    text = "\n".join(written(tree)) + "\n"
    while luck.random() < 0.3 * luck.wild:
        text = mangled(luck, text)
    return text, tree


# --- options ----------------------------------------------------------------------------------------------------------


def givens(tree: Tree) -> dict[str, Any]:
    """Return the givens of a task with values that one of its variants has, or the words of a choice."""
    stated, variants = tree.get("givens"), tree.get("variant")
    first = variants[0] if isinstance(variants, list) and variants and isinstance(variants[0], dict) else {}
    if not isinstance(stated, dict):
        return {}
    plain = {key: given if isinstance(given, dict) else {} for key, given in stated.items()}
    return {key: first.get(key, given.get("choices", given.get("default"))) for key, given in plain.items()}


def setting(luck: Luck, known: dict[str, Any], name: str) -> str:
    """Return a value for a given: a word, that of another given, or a number near its own."""
    like = known[name]
    if isinstance(like, list):
        return str(luck.of(like, TEXTS))
    return str(luck.choice([*known.values()])) if luck.random() < 0.1 else luck.number(like)


def about(luck: Luck, tree: Tree, often: float) -> list[str]:
    """Return options that every command about a task takes; each as `often`."""
    known, scales, options = givens(tree), tree.get("scales"), list[str]()
    for name in luck.sample([*known], min(luck.choice((0, 1, 1, 2, 3)), len(known))):
        options += ["--set", f"{name}={setting(luck, known, name)}"]
    if luck.random() < often:
        name = luck.of((*(scales if isinstance(scales, dict) else ()), *SCALES), TEXTS)
        options += ["--scale", f"{name}={luck.number(luck.choice(('80', '0.05', '0.002', '5', '50 mm')))}"]
    if luck.random() < often:
        own = tree.get("plans")
        plans = [str(luck.of(own if isinstance(own, list) else (), PLANS)) for _ in range(luck.choice((1, 1, 2, 3)))]
        options += ["--only", ",".join(plans)]
    if luck.random() < often:
        rows = tree.get("variant")
        own = [str(row.get("id")) for row in rows if isinstance(row, dict)] if isinstance(rows, list) else []
        options += ["-v", luck.of(own, TEXTS)]
    return options + some(luck, tree, {"--notation": (NOTATIONS, TEXTS), "--lang": (("uk", "ru", "en"), TEXTS)}, often)


def some(luck: Luck, tree: Tree, options: Options, often: float) -> list[str]:
    """Return some of the options of a command: flags, or with one of good or bad values, or one that is made."""
    chosen = []
    for name, values in options.items():
        if luck.random() < often:
            value = values(luck, tree) if callable(values) else luck.of(*values) if values else None
            chosen += [name] if value is None else [name, value]
    return chosen


def _hand(luck: Luck, tree: Tree) -> str:
    own = ", ".join(luck.number(like) for like in ("0.2 mm", "0.5 deg", "0.2 mm"))
    return str(luck.of((*HANDS, own, own, own), TEXTS))


def _names(luck: Luck, tree: Tree) -> str:
    return ",".join(luck.of(QUANTITIES, TEXTS) for _ in range(luck.choice((1, 1, 2, 3))))


def _range(luck: Luck, tree: Tree) -> str:
    known = givens(tree)
    name = luck.of([*known], TEXTS)
    low, high, step = (luck.number(known.get(name, "1")).split(" ")[0] for _ in range(3))
    return f"{name}={low}..{high}" + luck.choice(("", f"/{step}", f"/{step} {luck.choice(UNITS)}"))


COUNTS = ("0", "-1", str(10**9), str(10**30), "x", "", "1.5", "٣")
PRESETS = (HANDS, TEXTS)
FORMATS = (SIZES, TEXTS)
TEXT = (("І. Петренко", *TEXTS), TEXTS)
POINTS = (("A", "B", "S2", "B,C", "2", "12"), TEXTS)
DIGITS = (("1", "2", "variant", "variant,scheme", "-"), TEXTS)
BLOCK: Options = {
    **{"--student": TEXT, "--group": TEXT, "--date": TEXT, "--format": FORMATS},
    **{"--norm": (("gost", "iso"), TEXTS), "--tile": (("A4", "A3"), TEXTS)},
}
OPTIONS: dict[str, Options] = {
    "solve": {"--condition": None, "--json": None, "--hand": _hand, "--format": FORMATS},
    "list --check": {"--json": None},
    "list": {"--json": None, "--check": (("task.toml",), TEXTS)},
    "new": {"--kind": (KINDS, TEXTS)},
    "sweep": {
        **{"--positions": (("8", "12", "24"), COUNTS), "--points": POINTS, "--chords": POINTS, "--json": None},
        **{"--from": lambda luck, tree: luck.number("30 deg"), "--to": lambda luck, tree: luck.number("50 mm")},
        **{"-o": (("s.csv", "s.svg"), TEXTS)},
    },
    "variants": {
        **{"--quantities": _names, "--preset": PRESETS, "--json": None},
        **{"-o": (("v.csv", "v.xml", "v.gift", "v.toml", "v.xlsx"), TEXTS)},
    },
    "check": {
        **{"--preset": PRESETS, "--verdict-only": None, "--json": None, "--out": (("out",), ("a" * 300, *TEXTS))},
        **{"--digits": DIGITS, "--form": (("form.csv", "form.xlsx"), TEXTS), "--moodle": (("m.csv",), TEXTS)},
        **{"-o": (("r.html", "r.txt", "r.csv", "r.xlsx"), TEXTS), "--rubric": (("rubric.toml",), TEXTS)},
        **{"--format": FORMATS, "--directions": (("required", "optional", "ignored"), TEXTS)},
    },
    "batch": {
        **{name: value for name, value in BLOCK.items() if name not in ("--student", "--tile")},
        "--digits": DIGITS,
    },
    "sheet": BLOCK,
    "note": {"--student": TEXT, "--date": TEXT, "--format": FORMATS, "--figure": ((*PLANS, "forces_23"), TEXTS)},
    "handout": {
        **BLOCK,
        **{"--steps": (("1", "2", "5"), COUNTS), "--key": None, "--hidden-key": None, "--grid": None},
        "--over": (PLANS, TEXTS),
    },
    "chart": {
        **{"--positions": (("8", "12"), COUNTS), "--tolerance": lambda luck, tree: luck.number("1 %"), "--hand": _hand},
        **{"--quantities": _names, "--json": None},
    },
}
CHARTS = {
    "mechanism": ("accuracy", "stability", "depth"),
    "cam": ("sections", "accuracy", "stability"),
    "gear": ("scale",),
    "hoist": ("accuracy", "stability", "roots", "depth", "choice"),
}
OUTPUTS = {
    **{"sheet": ("x.svg", "x.svg", "x.pdf"), "note": ("x.md", "x.md", "x.docx"), "handout": ("x.svg", "x.pdf")},
    **{"chart": ("x.svg", "x.csv", "x.csv")},
}
XML = (
    *("<", ">", "&", "</c>", "<c/>", "<row/>", '="', "&lt;", "&#0;", "&#x1F600;", "]]>", "<!--", "<![CDATA["),
    *("r=", "s"),
)


# --- tables: answers, rosters, rubrics, as CSV or as workbooks --------------------------------------------------------


def ruined(luck: Luck, rows: list[list[str]]) -> list[list[str]]:
    """Return the cells, some of them something else, some rows doubled."""
    while luck.random() < 2.0 * luck.wild / (1.0 + luck.wild):
        row = luck.choice(rows)
        row[luck.randrange(len(row))] = luck.choice((*TEXTS, *NUMBERS))
        if luck.random() < 0.2:
            rows.insert(luck.randrange(len(rows)), list(luck.choice(rows)))
    return rows


def table(luck: Luck, rows: list[list[str]]) -> bytes:
    """Return the cells as CSV, some of them ruined."""
    ruined(luck, rows)
    mark = luck.choice((",", ",", ";", "\t"))
    lines = (mark.join('"' + cell.replace('"', '""') + '"' for cell in row) for row in rows)
    return ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")


def answers(luck: Luck) -> list[list[str]]:
    """Return what a student or a class has filled in: quantities with segments, scale factors, values, directions."""

    def cell() -> str:
        like = luck.choice(("55", "2.76", "0.05", "-28.9", "180", "100"))
        return str(luck.of((luck.number(like), luck.number(like), like, ""), (*NUMBERS, *TEXTS)))

    names = luck.sample(QUANTITIES, luck.randint(1, 12))
    if luck.random() < 0.5:
        rows = [["quantity", "symbol", "vector", "segment, mm", "scale", "value", "unit", "direction or sense"]]
        for name in names:
            senses = (cell(), "+", "-", "cw", "проти")
            rows.append([name, "", "", cell(), cell(), cell(), luck.of(("",), UNITS), luck.choice(senses)])
    else:
        rows = [["student", "variant", *(f"{name}{luck.choice(('', '.mm', '.dir'))}" for name in names)]]
        rows += [[luck.of(("А", "Б"), TEXTS), luck.of(("1", "2"), TEXTS), *(cell() for _ in names)] for _ in "123"]
    return rows


def rubric(luck: Luck) -> bytes:
    """Return a mutated rubric."""
    tree: Tree = {
        **{"out_of": 100, "asked": ["V_B", "omega_2"], "directions": "required", "weights": {"a_B": 3, "V_B": 1}},
        **{"worth": {"carried": 0.8}, "tolerance": {"mm": 2, "percent": 5, "degrees": 1}, "limits": {"V_B": "0.1 m/s"}},
    }
    for _ in range(luck.choice((0, 1, 2, 4))):
        mutate(luck, tree)
    return "\n".join(written(tree)).encode("utf-8", "surrogatepass")


def roster(luck: Luck, tree: Tree) -> list[list[str]]:
    """Return students with variants and some of the givens of their own."""
    known = givens(tree)
    names = luck.sample([*known], min(len(known), luck.choice((0, 0, 1, 3))))
    head = luck.choice((["name", "group", "variant"], ["Прізвище", "група", "номер заліковки"], ["ФИО", "вариант"]))
    rows = [[*head, *names]]
    for i in range(luck.choice((1, 1, 2))):
        told = (f"Студент {i}", "1", luck.choice(("1", "2", "123456", str(i))))[-len(head) :]
        rows.append([*told, *(setting(luck, known, name) for name in names)])
    return rows


def workbook(luck: Luck, rows: list[list[str]]) -> bytes:
    """Return cells as a workbook: as it is, with bytes that are others, or with a part of its XML that is another."""
    cells = [[_number(cell) if luck.random() < 0.5 else cell for cell in row] for row in ruined(luck, rows)]
    data, what = _xlsx_bytes(cells, luck.of(("1",), TEXTS)), luck.random()
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


def tabled(luck: Luck, case: Case, name: str, rows: list[list[str]]) -> str:
    """Add a table to the files of a case; return its name."""
    file = f"{name}.{luck.choice(('csv', 'xlsx'))}"
    case.files[file] = workbook(luck, rows) if file.endswith("xlsx") else table(luck, rows)
    return file


# --- commands: what each takes beside its options ---------------------------------------------------------------------


def _check(luck: Luck, case: Case, tree: Tree) -> None:
    """Mark answers of a student or a class."""
    case.arguments += [tabled(luck, case, "answers", answers(luck)), "--jobs", "1"]
    case.files["rubric.toml"] = rubric(luck)
    if luck.random() < 0.3:
        case.arguments += ["--roster", tabled(luck, case, "roster", roster(luck, tree))]


def _batch(luck: Luck, case: Case, tree: Tree) -> None:
    """Draw a class of a student or two."""
    if luck.random() < 0.15:
        case.arguments += ["--form", luck.of(("f.csv", "f.xlsx"), TEXTS)]
    if luck.random() < 0.9:
        file = tabled(luck, case, "roster", roster(luck, tree))
        case.arguments += ["--roster", file, "--out", luck.of(("out",), ("roster.csv", "out/out", "я", "x" * 300))]
    case.arguments += ["--jobs", "1", "--as", luck.of(("svg", "handout", "note", "pdf"), TEXTS)]


def _variants(luck: Luck, case: Case, tree: Tree) -> None:
    """Ask for new variants: made from ranges, or read from a table, with parameters in rows or in columns."""
    if luck.random() < 0.15:
        own: Options = {"--range": _range, "--seed": (("1", "5"), COUNTS)}
        case.arguments += ["--make", luck.of(("1", "2"), COUNTS), *some(luck, tree, own, 0.6)]
    elif luck.random() < 0.5:
        known = givens(tree)
        rows = [["id", "1", "2"], *([name, *(setting(luck, known, name) for _ in "12")] for name in known)]
        rows = [list(column) for column in zip(*rows, strict=True)] if luck.random() < 0.3 else rows
        case.arguments += ["--from", tabled(luck, case, "table", rows)]


def _chart(luck: Luck, case: Case, tree: Tree) -> None:
    """Draw a chart, or several at once without that of accuracy, which measures times."""
    charts = CHARTS[next((kind for kind in CHARTS if kind in tree), "cam")]
    several = [luck.of([name for name in charts if name != "accuracy"], (*TEXTS, "depth")) for _ in "12"]
    case.arguments += ["--chart", ",".join(several) if luck.random() < 0.3 else luck.of(charts, TEXTS)]


def _new(luck: Luck, case: Case, tree: Tree) -> None:
    """Begin a task file."""
    names = [name for name in TEXTS if not {"/", "\\"} & {*name}]
    case.arguments[1:] = [luck.of(("new.toml", "новий", "task.toml"), names)]


def _list(luck: Luck, case: Case, tree: Tree) -> None:
    """Show the tasks."""
    del case.arguments[1:]


MAKERS: dict[str, Callable[[Luck, Case, Tree], None]] = {
    **{"check": _check, "batch": _batch, "variants": _variants, "chart": _chart, "new": _new, "list": _list},
}
# Commands by how often each is run: of those that calculate, of those that draw, of those about classes and formats.
# Of a chart the figure is another one: a chart of everything measures times for longer than a case may take.
FAMILIES: dict[str, dict[str, int]] = {
    "solved": {"solve": 40, "list --check": 22, "check": 16, "variants": 12, "sweep": 10},
    "drawn": {"sheet": 40, "note": 20, "handout": 20, "chart": 20},
    "classes": {"batch": 30, "check": 35, "variants": 20, "sheet": 5, "handout": 5, "new": 5, "list": 5},
}


def made(n: int, family: str) -> Case:
    """Return case `n` of a family."""
    luck, weights = Luck(f"{n} {family}"), FAMILIES[family]
    command = luck.choices([*weights], [*weights.values()])[0]
    if luck.random() < 0.4 and command != "list --check":  # a good task, so that the options are reached
        task = luck.choice(sorted(bundled()))
        case, tree = Case([command, task]), json.loads(tree_of(bundled_text(task)))
    else:
        text, tree = task_file(luck)
        case = Case([*command.split(), "task.toml"], {"task.toml": text.encode("utf-8", "surrogatepass")})
    if command not in ("list --check", "list", "new"):
        case.arguments += about(luck, tree, 0.1)
    if command in MAKERS:
        MAKERS[command](luck, case, tree)
    case.arguments += some(luck, tree, OPTIONS[command], 0.2)
    if command in OUTPUTS and (command != "chart" or luck.random() < 0.5):
        case.arguments += ["-o", luck.choice(OUTPUTS[command])]
    if luck.random() < 0.05:
        case.arguments[:0] = ["--lang", luck.of(("uk", "ru", "en"), TEXTS)]
    case.language = luck.choice(("uk", "ru", "en"))
    case.arguments = [argument.replace("\0", "") for argument in case.arguments]  # which no shell hands over
    return case


def lay_out(case: Case, folder: Path) -> None:
    """Write the files of a case."""
    for name, content in case.files.items():
        (folder / name).write_bytes(content)
