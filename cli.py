"""The command line: parses, calls, prints; every other module can be used without it."""

from __future__ import annotations

import errno
import os
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from . import __version__
from .scales.errors import LANGUAGES, InputError, KulmanError, messages
from .scales.numbers import quote

INTERRUPTED, CLOSED = 130, 1
Command = TypeVar("Command", bound=Callable[..., Any])
if TYPE_CHECKING:
    TextType = click.ParamType[str]
else:  # only newer versions of click can be subscripted
    TextType = click.ParamType


def system_language() -> str:
    """Return the language of messages: that of the environment, or of Windows; English for any other."""
    for variable in ("LC_ALL", "LC_MESSAGES", "LANG"):
        if os.environ.get(variable):
            name = os.environ[variable]
            break
    else:
        name = _windows_language()
    return name[:2].lower() if name[:2].lower() in LANGUAGES else "en"


def _windows_language() -> str:
    """Return the language in which Windows shows itself to the user; nothing elsewhere."""
    if sys.platform != "win32":
        return ""
    import ctypes
    import locale

    return locale.windows_locale.get(ctypes.windll.kernel32.GetUserDefaultUILanguage(), "")


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit: 0, 2 for bad input, 3 for a position without a plan, 130 when interrupted."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        status = commands.main(arguments, prog_name="kulman", standalone_mode=False)
        if sys.stdout is not None:  # as it is where nothing reads our output: started without a console, or `>&-`
            sys.stdout.flush()
    except click.UsageError as error:
        status = _refuse(_usage_error(error))
    except KulmanError as error:
        status = _refuse(error)
    except (KeyboardInterrupt, click.Abort):
        status = INTERRUPTED
    except OSError as problem:
        if problem.filename is not None:  # not what a stream of ours raises
            raise
        status = _lost_output(problem)
    sys.exit(status if isinstance(status, int) else 0)


def _refuse(error: KulmanError) -> int:
    """Show an error as one line and return its exit status."""
    with suppress(OSError):  # nobody reads it: the status still says what happened
        click.echo(error.text(system_language()), err=True)
    return error.status


def _lost_output(problem: OSError) -> int:
    """Say why the output cannot be written, unless its reader has closed it; return the exit status."""
    # without this Python would complain once more when it flushes at exit
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(problem, BrokenPipeError) or (sys.platform == "win32" and problem.errno == errno.EINVAL):
        return CLOSED
    return _refuse(InputError("output-broken", reason=problem.strerror or ""))


def _usage_error(error: click.UsageError) -> InputError:
    """Return click's error as one of ours, which has a message in every language."""
    command = error.ctx.command_path if error.ctx else "kulman"
    if isinstance(error, click.NoSuchOption):
        text, like = quote(error.option_name), next(iter(error.possibilities or ()), None)
        if like:
            return InputError("cli-option-unknown-like", text=text, like=like)
        return InputError("cli-option-unknown", text=text, command=command)
    if isinstance(error, click.BadOptionUsage):
        return InputError("cli-option-value", text=quote(error.option_name), command=command)
    if isinstance(error, click.MissingParameter) and error.param is not None:
        name = error.param.human_readable_name if isinstance(error.param, click.Argument) else error.param.opts[0]
        return InputError("cli-missing", text=name, command=command)
    extra = re.search(r"unexpected extra arguments? \((.*)\)", error.message, re.DOTALL)
    if extra:
        return InputError("cli-extra", text=quote(extra[1]), command=command)
    return InputError("cli-usage", text=quote(error.message), command=command)


class _Group(click.Group):
    """The commands; a wrong one is refused with the one that was meant."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that `args` begin with."""
        if args and not args[0].startswith("-") and self.get_command(ctx, args[0]) is None:
            from .scales.names import unknown

            raise unknown("cli-command-unknown", args[0], self.list_commands(ctx))
        return super().resolve_command(ctx, args)


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


def _pairs(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> dict[str, str]:
    """Split NAME=VALUE; no name twice."""
    pairs: dict[str, str] = {}
    for value in values:
        name, equals, text = (part.strip() for part in value.partition("="))
        if not name or not equals or not text:
            raise InputError("cli-setting", option=param.opts[0], text=quote(value))
        if name in pairs:
            raise InputError("cli-setting-twice", option=param.opts[0], text=quote(name))
        pairs[name] = text
    return pairs


def _given(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...] | None:
    """Tell an option that was not given at all from an empty one."""
    return values or None


def _outputs(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[Path, ...]:
    """Refuse, before any work, files that cannot be written."""
    from .drawing.writers import check_outputs

    paths = tuple(map(Path, values))
    check_outputs(*paths)
    return paths


def _of_task(command: Command) -> Command:
    """Add what every command about a task takes."""
    options = (
        click.argument("task"),
        click.option("-v", "--variant", help="A variant of the task; without it the first one."),
        click.option(
            "--set",
            "settings",
            metavar="NAME=VALUE",
            multiple=True,
            callback=_pairs,
            help="Another value for a given: l_OA=55, 'n_1=765 об/хв', 'F_3=2 kN'. Repeatable.",
        ),
        click.option(
            "--scale",
            "scales",
            metavar="NAME=VALUE",
            multiple=True,
            callback=_pairs,
            help="A scale factor, mu_V=0.05, or a segment in mm, pa=80. Repeatable.",
        ),
        click.option("--only", metavar="PLAN,...", multiple=True, callback=_given, help="Only these plans."),
        click.option("--notation", help="Letters of another school: artobolevsky, bauman, bertyaev, iso, madi, nau."),
        click.option("--lang", type=Word(*LANGUAGES), help="Language of the results."),
    )
    for option in reversed(options):
        command = option(command)
    return command


def _example(*lines: str) -> str:
    """Return the end of a help text that shows how the command is used."""
    return "\b\nExample:\n" + "\n".join(f"  {line}" for line in lines)


@click.group(cls=_Group, invoke_without_command=True, epilog=_example("kulman solve nau-slider-crank -v 3"))
@click.version_option(__version__, message="%(version)s")
@click.pass_context
def commands(ctx: click.Context) -> None:
    """Solve and draw problems of the theory of mechanisms and machines, to scale."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


@commands.command("list", epilog=_example("kulman list", "kulman list --json"))
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@click.option("--check", "file", metavar="FILE", help="Show every fault of a task file instead.")
def list_tasks(as_json: bool, file: str | None) -> int:
    """Show the tasks, their variants, and what each draws."""
    from .variants.shelf import bundled, summary

    if file is not None:
        return _check(file, as_json)
    tasks = [summary(task) for task in bundled()]
    language = system_language()
    if as_json:
        _print_json({"tasks": tasks})
        return 0
    words = messages(language)
    for task in tasks:
        click.echo(f"{task['id']}  {task['title'][language]}")
        for key in ("variants", "plans"):
            click.echo(f"    {words[f'list-{key}']}: {', '.join(task[key])}")
    return 0


def _check(file: str, as_json: bool) -> int:
    """Show all faults of a task file, one a line."""
    from .variants.reader import read_file

    language = system_language()
    _, faults = read_file(file)
    if as_json:
        lines = [{"key": fault.key, "message": fault.text(language)} for fault in faults]
        _print_json({"file": file, "ok": not faults, "errors": lines})
    else:
        for fault in faults:
            click.echo(fault.text(language))
    if faults:
        return _refuse(InputError("check-bad", file=file, n=len(faults)))
    if not as_json:
        click.echo(messages(language)["check-ok"].format(file=file))
    return 0


def _warn(warnings: Sequence[KulmanError]) -> None:
    """Show what a user should know, a line each, on stderr."""
    for warning in warnings:
        click.echo(warning.text(system_language()), err=True)


def _print_json(data: Mapping[str, Any]) -> None:
    """Print one JSON object in ASCII, which every console and pipe lets through."""
    import json

    click.echo(json.dumps(data, ensure_ascii=True, allow_nan=False, indent=2))


@commands.command(
    epilog=_example(
        "kulman solve nau-slider-crank -v 3",
        "kulman solve nau-slider-crank --set l_OA=30 --json",
        "kulman solve nau-slider-crank -v 3 --only velocity --condition",
    )
)
@_of_task
@click.option(
    "--condition",
    is_flag=True,
    help="Show for each quantity its condition K (errors of the data come through so many times, in parts of the "
    "largest vector of the plan) and the sine of the flattest intersection behind it.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def solve(task: str, settings: dict[str, str], as_json: bool, lang: str | None, **options: Any) -> int:
    """Solve TASK (an id, or a TOML file) and show all quantities."""
    from . import variants

    solution = variants.solve(task, set=settings, lang=lang, **options)
    if as_json:
        _print_json(solution.to_json())
    elif solution.reason is None:
        click.echo(solution.table(lang or system_language()))
        _warn(solution.warnings)
    return _refuse(solution.reason) if solution.reason is not None else 0


@commands.command(
    epilog=_example(
        "kulman sheet nau-slider-crank -v 3 -o sheet.svg -o sheet.pdf",
        "kulman sheet nau-slider-crank -o sheet.pdf --format A3 --student 'І. Петренко'",
    )
)
@_of_task
@click.option(
    "-o",
    "--output",
    "files",
    metavar="FILE",
    multiple=True,
    required=True,
    callback=_outputs,
    help="Where to; the suffix picks the kind of file. Repeatable.",
)
@click.option("--format", type=Word("A4", "A3", "A2", "A1"), help="Without it the smallest one that holds everything.")
@click.option("--norm", type=Word("gost", "iso"), default="gost", show_default=True, help="Frame and title block.")
@click.option("--tile", type=Word("A4", "A3"), help="Cut a PDF into pages of this format for a small printer.")
@click.option("--student", help="For the title block.")
@click.option("--group", help="For the title block.")
@click.option("--teacher", help="For the title block.")
@click.option("--department", help="For the title block.")
@click.option("--designation", help="For the title block.")
@click.option("--date", help="For the title block; none is invented.")
def sheet(task: str, settings: dict[str, str], files: tuple[Path, ...], tile: str | None, **options: Any) -> None:
    """Draw the sheet of TASK (an id, or a TOML file) to scale."""
    from . import variants

    given = {name: value for name, value in options.items() if value is not None}
    drawn = variants.sheet(task, set=settings, **given)
    saved = drawn.save(*files, tile=tile)
    for path in saved:
        click.echo(str(path))
    _warn(drawn.warnings)


def _columns_out(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[Path, ...]:
    """Refuse, before any work, files that a sweep cannot be written to."""
    from .drawing.writers import check_outputs
    from .variants.sweeps import SUFFIXES

    paths = tuple(map(Path, values))
    check_outputs(*paths, known=SUFFIXES)
    return paths


def _count(ctx: click.Context, param: click.Parameter, value: str) -> int:
    """Read a whole number."""
    try:
        return int(value)
    except ValueError:
        raise InputError("cli-number", option=param.opts[0], text=quote(value)) from None


@commands.command(
    epilog=_example(
        "kulman sweep nau-slider-crank -v 3 --only velocity",
        "kulman sweep nau-slider-crank -v 3 --positions 24 -o cycle.csv -o cycle.pdf",
        "kulman sweep nau-slider-crank --points B,S2 --chords B --from '30 deg'",
    )
)
@_of_task
@click.option(
    "--positions",
    metavar="N",
    default="12",
    show_default=True,
    callback=_count,
    help="How many positions: 8, 12, 24, ...",
)
@click.option(
    "--points", metavar="POINT,...", multiple=True, callback=_given, help="Only these points, or numbered links."
)
@click.option("--from", "start", metavar="PLACE", help="Where the driver begins; without it at the zero position.")
@click.option("--to", "end", metavar="PLACE", help="Where a sliding driver stops.")
@click.option(
    "--chords", metavar="POINT", help="Velocities and accelerations of a point or link by plans and by chords."
)
@click.option(
    "-o",
    "--output",
    "files",
    metavar="FILE",
    multiple=True,
    callback=_columns_out,
    help="Where to: all columns to a .csv, the drawing to .svg, .pdf, .png. Repeatable.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def sweep(
    task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, chords: str | None, **options: Any
) -> int:
    """Solve TASK (an id, or a TOML file) over its whole cycle: positions, dead positions, strokes, extremes."""
    from . import variants

    language = options.pop("lang") or system_language()
    swept = variants.sweep(task, set=settings, lang=language, **options)
    for path in swept.save(*files):
        click.echo(str(path))
    if as_json:
        _print_json(swept.to_json())
    elif swept.reason is None and not files:
        click.echo(swept.table() if chords is None else swept.chords(chords))
    return _refuse(swept.reason) if swept.reason is not None else 0


@commands.command(epilog=_example("kulman new my-mechanism.toml", "kulman new мій-механізм.toml --lang uk"))
@click.argument("file")
@click.option("--lang", type=Word(*LANGUAGES), help="Language of the comments.")
def new(file: str, lang: str | None) -> None:
    """Write FILE, a task file with comments, to begin a mechanism of one's own: a four-bar linkage, ready to solve."""
    from .variants.starter import start

    click.echo(str(start(file, lang or system_language())))
