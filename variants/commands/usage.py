"""What click complains of, as errors of ours, which have a message in every language."""

from __future__ import annotations

import re
from collections.abc import Sequence

import click

from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import quote

LONGEST = 10_000  # characters of a word of the command line


def refuse_long(words: Sequence[str]) -> None:
    """Refuse a command line with a word that is longer than any name, number or path.

    Raises
    ------
    InputError
        There is one.
    """
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
