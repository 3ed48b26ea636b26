"""Options of the command line: their kinds, what they are checked for before any work, those that all tasks share."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ..scales.errors import LANGUAGES, InputError
from ..scales.numbers import quote

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


def files_out(module: str) -> Callable[[click.Context, click.Parameter, tuple[str, ...]], tuple[Path, ...]]:
    """Return a callback that refuses, before any work, files that cannot be written.

    Parameters
    ----------
    module : str
        Where the `SUFFIXES` that can be written stand; it is imported when the option is read, not for the help.
    """

    def checked(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[Path, ...]:
        from ..drawing.writers import check_outputs

        paths = tuple(map(Path, values))
        check_outputs(*paths, known=import_module(module, __package__).SUFFIXES)
        return paths

    return checked


def of_task(command: Command) -> Command:
    """Add what every command about a task takes."""
    options = (
        click.argument("task"),
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
        click.option("--lang", type=Word(*LANGUAGES), help="Language of the results."),
    )
    for option in reversed(options):
        command = option(command)
    return command


def example(*lines: str) -> str:
    """Return the end of a help text that shows how the command is used."""
    return "\b\nExample:\n" + "\n".join(f"  {line}" for line in lines)


def count(ctx: click.Context, param: click.Parameter, value: str) -> int:
    """Read a whole number."""
    try:
        return int(value)
    except ValueError:
        raise InputError("cli-number", option=param.opts[0], text=quote(value)) from None


def count_if_given(ctx: click.Context, param: click.Parameter, value: str | None) -> int | None:
    """Read a whole number where there is one."""
    return None if value is None else count(ctx, param, value)
