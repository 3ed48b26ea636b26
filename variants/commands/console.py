"""What commands say: warnings, refusals, JSON, how far a long one is."""

from __future__ import annotations

import errno
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import click

from ...scales.errors import InputError, KulmanError, messages
from ...scales.language import system_language
from ...scales.names import unknown
from ...scales.numbers import SHOWN, quote

if TYPE_CHECKING:
    from ..task import Task

CLOSED = 1
LONGEST = 10_000  # characters of a word of the command line


def refuse(error: KulmanError) -> int:
    """Show an error as one line and return its exit status."""
    with suppress(OSError):  # nobody reads it: the status still says what happened
        click.echo(error.text(system_language()), err=True)
    return error.status


def flush() -> None:
    """Hand over what is still to be printed."""
    if sys.stdout is not None:  # as it is where nothing reads our output: started without a console, or `>&-`
        sys.stdout.flush()


def _printing(problem: OSError) -> bool:
    """Whether an error was raised in printing: by click, which alone prints, or by `flush`."""
    trace = problem.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    module = trace.tb_frame.f_globals.get("__name__", "") if trace is not None else ""
    return module == __name__ or module.partition(".")[0] == "click"


def lost_output(problem: OSError) -> int:
    """Say why the output cannot be written, unless its reader has closed it; return the exit status.

    An error without the name of a file that was not raised in printing is the system's: it is said as that.
    """
    if not _printing(problem):
        return refuse(InputError("system-refused", reason=quote(problem.strerror or problem, SHOWN)))
    # without this Python would complain once more when it flushes at exit
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(problem, BrokenPipeError) or (sys.platform == "win32" and problem.errno == errno.EINVAL):
        return CLOSED
    return refuse(InputError("output-broken", reason=problem.strerror or ""))


def warn(warnings: Sequence[KulmanError]) -> None:
    """Show what a user should know, a line each, on stderr."""
    for warning in warnings:
        click.echo(warning.text(system_language()), err=True)


def note_of(task: Task) -> None:
    """Show on stderr what a task says of its data."""
    language = system_language()
    if note := task.note_in(language):
        click.echo(f"{messages(language)['list-note']}: {note}", err=True)


def print_json(data: Mapping[str, Any]) -> None:
    """Print one JSON object in ASCII, which every console and pipe lets through."""
    import json

    click.echo(json.dumps(data, ensure_ascii=True, allow_nan=False, indent=2))


def say_written(paths: Iterable[object], as_json: bool) -> None:
    """Show the names of files that have been written; beside a JSON object, which is alone on stdout, on stderr."""
    for path in paths:
        click.echo(str(path), err=as_json)


class Found(Protocol):
    """What a command has found."""

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write it to each of `paths`."""

    def to_json(self) -> dict[str, Any]:
        """Return it as plain data."""

    def table(self) -> str:
        """Return it as a readable table."""


def hand_over(found: Found, files: Sequence[Path], as_json: bool, tabled: bool = True) -> None:
    """Write what has been found to files and name these; print it as JSON, or as a table where no file is wanted."""
    say_written(found.save(*files), as_json)
    if as_json:
        print_json(found.to_json())
    elif tabled and not files:
        click.echo(found.table())


@contextmanager
def progress() -> Iterator[Callable[[int, int], None]]:
    """Show on a console how far a class is: told how many students more are done, and of how many."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda done, whole: None
        return
    with click.progressbar(length=0, file=sys.stderr) as bar:

        def advance(done: int, whole: int) -> None:
            bar.length = whole
            bar.update(done)

        yield advance


def refuse_long(words: Sequence[str]) -> None:
    """Refuse a command line with a word that is longer than any name, number or path."""
    for word in words:
        if len(word) > LONGEST:
            raise InputError("cli-long", text=quote(word), n=LONGEST)


def usage_error(error: click.UsageError, words: Sequence[str], commands: click.Group) -> InputError:
    """Return click's error as one of ours, which has a message in every language."""
    called = next((commands.commands[word] for word in words if word in commands.commands), commands)
    command = "kulman" if called is commands else f"kulman {called.name}"
    if isinstance(error, click.NoSuchOption):
        text, like = quote(error.option_name), next(iter(error.possibilities or ()), None)
        if like:
            return InputError("cli-option-unknown-like", text=text, like=like)
        return InputError("cli-option-unknown", text=text, command=command)
    if isinstance(error, click.BadOptionUsage):
        option = next((one for one in called.params if error.option_name in one.opts), None)
        if isinstance(option, click.Option) and option.is_flag:
            return InputError("cli-option-flag", text=quote(error.option_name), command=command)
        value = (option.metavar or "|".join(getattr(option.type, "words", ()))) if option is not None else ""
        return InputError("cli-option-value", text=quote(error.option_name), value=value or "TEXT", command=command)
    if isinstance(error, click.MissingParameter) and error.param is not None:
        name = error.param.human_readable_name if isinstance(error.param, click.Argument) else error.param.opts[0]
        return InputError("cli-missing", text=name, command=command)
    extra = re.search(r"unexpected extra arguments? \((.*)\)", error.message, re.DOTALL)
    if extra:
        return InputError("cli-extra", text=quote(extra[1]), command=command)
    return InputError("cli-usage", text=quote(error.message), command=command)


class Group(click.Group):
    """The commands; a wrong one is refused with the one that was meant."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that `args` begin with."""
        if args and not args[0].startswith("-") and self.get_command(ctx, args[0]) is None:
            raise unknown("cli-command-unknown", args[0], self.list_commands(ctx))
        return super().resolve_command(ctx, args)
