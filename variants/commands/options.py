"""Options of the command line: their kinds, what they are checked for before any work, those that all tasks share."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ...scales.choices import HANDS, SIZES
from ...scales.errors import LANGUAGES, InputError
from ...scales.numbers import quote

# what the title blocks of a class have in common, but for the group that the roster says
BLOCK = ("group", "teacher", "department", "designation", "date")
VARIANTS = (__package__ or "").rpartition(".")[0]
Command = TypeVar("Command", bound=Callable[..., Any])
if TYPE_CHECKING:
    TextType = click.ParamType[str]
else:  # only newer versions of click can be subscripted
    TextType = click.ParamType


class Word(TextType):
    """One of a few words, in capitals or not."""

    name = "word"

    def __init__(self, *words: str) -> None:
        """Accept `words`."""
        self.words = words

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        """Show the words in the help."""
        return "|".join(self.words)

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the word that is meant."""
        for word in self.words:
            if word.lower() == value.strip().lower():
                return word
        option = param.opts[0] if param else ""
        raise InputError("cli-choice", option=option, text=quote(value), known=", ".join(self.words))


def pairs(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> dict[str, str]:
    """Split NAME=VALUE; no name twice."""
    found: dict[str, str] = {}
    for value in values:
        name, equals, text = (part.strip() for part in value.partition("="))
        if not name or not equals or not text:
            raise InputError("cli-setting", option=param.opts[0], text=quote(value))
        if name in found:
            raise InputError("cli-setting-twice", option=param.opts[0], text=quote(name))
        found[name] = text
    return found


def given(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...] | None:
    """Tell an option that was not given at all from an empty one."""
    return values or None


def output(module: str, help: str, required: bool = False) -> Callable[[Command], Command]:
    """Return the option `-o FILE`, which refuses, before any work, files that cannot be written.

    The `SUFFIXES` that can be stand in a module, which is imported when the option is read, not for the help.
    """

    def checked(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[Path, ...]:
        from ...drawing.writers import check_outputs

        paths = tuple(map(Path, values))
        check_outputs(*paths, known=import_module(module, VARIANTS).SUFFIXES)
        return paths

    names = ("-o", "--output", "files")
    said = f"{help} Repeatable."
    return click.option(*names, metavar="FILE", multiple=True, required=required, callback=checked, help=said)


def stacked(*options: Any) -> Callable[[Command], Command]:
    """Return what adds options to a command, in the order in which its help shows them."""

    def add(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return add


# the language, which `main` has already taken for messages
of_language = click.option("--lang", type=Word(*LANGUAGES), help="Of results and messages; else `KULMAN_LANG`.")
_about_task: tuple[Any, ...] = (
    click.option("-v", "--variant", help="A variant of the task; without it the first one."),
    click.option(
        "--set",
        "settings",
        metavar="NAME=VALUE",
        multiple=True,
        callback=pairs,
        help="Another value for a given: l_OA=55, 'n_1=765 об/хв', 'F_3=2 kN'. Repeatable.",
    ),
    click.option(
        "--scale",
        "scales",
        metavar="NAME=VALUE",
        multiple=True,
        callback=pairs,
        help="A scale factor, mu_V=0.05, or a segment in mm, pa=80. Repeatable.",
    ),
    click.option("--only", metavar="PLAN,...", multiple=True, callback=given, help="Only these plans."),
    click.option("--notation", help="Letters of another school: artobolevsky, bauman, bertyaev, iso, madi, nau."),
    of_language,
)
of_task = stacked(click.argument("task"), *_about_task)
of_tasks = stacked(click.argument("tasks", metavar="TASK...", nargs=-1, required=True), *_about_task)
of_norm = click.option(
    "--norm", type=Word("gost", "iso"), default="gost", show_default=True, help="Frame and title block."
)
tiled = click.option("--tile", type=Word("A4", "A3"), help="Cut a PDF into pages of this format for a small printer.")


def example(*lines: str) -> str:
    """Return the end of a help text that shows how the command is used."""
    return "\b\nExample:\n" + "\n".join(f"  {line}" for line in lines)


def count(ctx: click.Context, param: click.Parameter, value: str | None) -> int | None:
    """Read a whole number where there is one."""
    try:
        return None if value is None else int(value)
    except ValueError:
        raise InputError("cli-number", option=param.opts[0], text=quote(value)) from None


def processes(ctx: click.Context, param: click.Parameter, value: str | None) -> int:
    """Read a number of processes; 0, for as many as cores, where there is none."""
    number = count(ctx, param, value)
    if number is None:
        return 0
    if number < 1:
        raise InputError("cli-from-one", option=param.opts[0], text=quote(value))
    return number


def titled(*names: str) -> Callable[[Command], Command]:
    """Return what adds `names`, which a title block or a title page says."""
    none = {"date": "; none is invented"}
    return stacked(*(click.option(f"--{name}", help=f"For the title block{none.get(name, '')}.") for name in names))


def moodle_out(ctx: click.Context, param: click.Parameter, value: str | None) -> Path | None:
    """Refuse, before any work, a file that Moodle would not read, or that cannot be written."""
    from ...drawing.writers import check_outputs

    if value is None:
        return None
    check_outputs(Path(value), known=(".csv",))
    return Path(value)


# what is said of answers to be marked
of_check = stacked(
    click.argument("answers", nargs=-1),
    click.option("--form", metavar="FILE", help="Write an empty form, .csv or .xlsx; with --roster that of a class."),
    click.option(
        "--preset", type=Word(*HANDS), default="normal", show_default=True, help="What may be missed by hand."
    ),
    click.option("--verdict-only", "own", is_flag=True, help="For the student: right or wrong, and no right numbers."),
    click.option("--format", type=Word(*SIZES), help="Mark what is drawn on the sheet of this format."),
    click.option("--rubric", metavar="FILE", help="Weights, worths, tolerances: a small TOML file."),
    click.option(
        "--directions",
        type=Word("required", "optional", "ignored"),
        help="Directions of vectors, senses of what turns: a line without is worth half; what is said is compared; "
        "or sizes alone are. In the place of what the rubric says; else optional.",
    ),
    click.option(
        "--roster", metavar="FILE", help="Students with their variants, record books, own data: .csv or .xlsx."
    ),
    click.option(
        "--digits",
        metavar="N|WORD,...",
        default="1",
        show_default=True,
        help="How many last digits of the record book give the variant, where the roster has none; or what each is "
        "for: variant, scheme, - for nothing.",
    ),
    click.option("--out", "folder", metavar="FOLDER", help="Reports on every student, .html and .txt."),
    click.option("--moodle", metavar="FILE", callback=moodle_out, help="Grades for Moodle, .csv."),
    click.option("--jobs", metavar="N", callback=processes, help="Processes; as many as cores when left out."),
    output(
        ".marking.report",
        "Where to: the report on one student to .html or .txt, the table of a class to .csv or .xlsx.",
    ),
    click.option("--json", "as_json", is_flag=True, help="Print one JSON object (of one student)."),
)
