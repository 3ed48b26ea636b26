"""What `--help` says: the words of `help/*.toml`, in the language of messages, laid out as click does.

And what a shell offers when TAB is pressed: tasks, variants, plans, quantities, charts, kinds of files, guides.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from glob import glob
from importlib import import_module
from typing import TYPE_CHECKING, Any

import click

from ...scales.choices import HANDS
from ...scales.errors import LANGUAGES, KeptError, KulmanError, system_language
from ...scales.names import unknown
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

Source = Callable[[click.Context], Iterable[str]]  # of what is typed so far: names, or names with what they mean
Completer = Callable[[click.Context, click.Parameter, str], "list[CompletionItem[str]]"]


def item(value: str, type: str = "plain", help: str | None = None) -> CompletionItem[str]:
    """Return one thing that is offered; click's part for shells is imported when a shell asks."""
    from click.shell_completion import CompletionItem

    return CompletionItem(value, type, help)


def files(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
    """Let the shell complete a file."""
    return [item(incomplete, "dir" if param.metavar == "FOLDER" else "file")]


def completing(source: Source, with_files: bool = False) -> Completer:
    """Return what completes a name, the last one of several with commas between; also a file where that may stand."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
        before, comma, begun = incomplete.rpartition(",")
        try:
            names = source(ctx)
        except KulmanError:  # of a task that is not there, or has no plan: nothing can be offered
            names = ()
        told = names if isinstance(names, Mapping) else {}
        offered = [item(f"{before}{comma}{name}", help=told.get(name)) for name in names if name.startswith(begun)]
        return [*([item(incomplete, "file")] if with_files else []), *offered]

    return complete


def suffixed(module: str, package: str) -> Completer:
    """Return what completes a file: with the suffixes of a module, which `SUFFIXES` of it says; also one there is."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
        if not os.path.basename(incomplete):
            return files(ctx, param, incomplete)
        name, begun = os.path.splitext(incomplete)
        known: Iterable[str] = import_module(module, package).SUFFIXES
        return [item(f"{name}{suffix}") for suffix in known if suffix.startswith(begun)]

    return complete


def tasks(ctx: click.Context) -> Mapping[str, str]:
    """Return the bundled tasks with their titles."""
    from ..shelf import bundled, summary

    return {task: summary(task)["title"][system_language()] for task in bundled()}


def _task(ctx: click.Context) -> Any:
    """Return the task that stands before, in an argument; what is left unparsed where an option has no value yet."""
    from ..reader import load_task

    named = ctx.params.get("task") or ctx.params.get("tasks") or next(iter(ctx.args), "")
    return load_task(named if isinstance(named, str) else named[0])


def variants(ctx: click.Context) -> Iterable[str]:
    """Return the variants of the task."""
    return [*_task(ctx).variants]


def plans(ctx: click.Context) -> Iterable[str]:
    """Return the plans of the task."""
    plans: Iterable[str] = _task(ctx).plans
    return plans


def quantities(ctx: click.Context) -> Iterable[str]:
    """Return the quantities of the task, in order of construction."""
    from ..solution import solve

    return solve(_task(ctx))


def givens(ctx: click.Context) -> Iterator[str]:
    """Go through the givens of the task, each as it is set: numbers, words with what may be chosen."""
    for name, given in _task(ctx).givens.items():
        yield from (f"{name}={word}" for word in (given.choices or ("",)))


def scales(ctx: click.Context) -> Iterable[str]:
    """Return the scale factors of the task, as they are set."""
    from ..solution import solve

    return [f"{symbol}=" for symbol in solve(_task(ctx)).scales]


def charts(ctx: click.Context) -> Iterable[str]:
    """Return the charts that the task can have."""
    from ..case import beside

    names: Iterable[str] = beside(_task(ctx), "charts").CHARTS
    return names


def notations(ctx: click.Context) -> Iterable[str]:
    """Return the schools whose letters are known."""
    from ...drawing.words import notations as known

    return known()


def topics(ctx: click.Context) -> Mapping[str, str]:
    """Return the guides with their headings."""
    from ..shelf import guides

    return guides(system_language())


_EXPLAINED = re.compile(r"([a-z]+) \(([^)]+)\)")  # a value with what it means
_PLACE = re.compile(r"[A-Z]{2,}")  # what stands for a word of the user: FILE, NAME=VALUE; not N, not A4


def texts(language: str) -> dict[str, Any]:
    """Return the words of the help in `language`: `words`, `places`, what several commands share, a table a command."""
    return packaged(__package__, "help", language)


def told(command: str, key: str, language: str) -> str:
    """Return the text of an option, `--set`, or `about`, of a command, or what commands share."""
    whole = texts(language)
    text: str = whole[command][key] if key in whole[command] else whole["shared"][key]
    return text.format(hands=", ".join(HANDS)).strip()


def as_explained(command: str, option: str, said: Iterable[str]) -> tuple[str, ...]:
    """Return the names of an option's values, also where one is said in the words behind it in any help: глибина."""
    help_of = " ".join(" ".join(told(command, option, language).split()) for language in LANGUAGES)
    names = {word: name for name, words in _EXPLAINED.findall(help_of) for word in (words, words.split()[0])}
    return tuple(names.get(one.strip().lower(), one.strip()) for several in said for one in several.split(","))


def place(param: click.Parameter) -> str:
    """Return what stands for the value of an option or an argument, in the language of messages."""
    if choices := getattr(param.type, "words", ()):
        return "|".join(choices)
    raw = param.metavar or ("TEXT" if isinstance(param, click.Option) else (param.name or "").upper())
    return _PLACE.sub(lambda word: texts(system_language())["places"][word[0]], raw)


def _usage(param: click.Parameter) -> str:
    """Return how an argument stands in the line of usage."""
    name = place(param).removesuffix("...")
    return (name if param.required else f"[{name}]") + ("..." if param.nargs != 1 else "")


def _longest(option: click.Option) -> str:
    """Return the name of an option by which its text is found."""
    return max(option.opts, key=len)


def _row(ctx: click.Context, command: str, option: click.Option) -> tuple[str, str]:
    """Return an option as a row of the help: its names with the place of its value, its text."""
    language = system_language()
    words, names = texts(language)["words"], ", ".join(sorted(option.opts, key=len))
    text = told(command, _longest(option), language)
    if option.multiple and not (option.metavar or "").endswith(",..."):
        text += f" {words['repeatable']}"
    extra = []
    own = (ctx.default_map or {}).get(option.name or "")  # of the settings
    if option.show_default or (own and option.name != "lang"):
        default = own or option.default
        usual = default if isinstance(default, tuple) else (default,)
        extra.append(f"{words['default']}: {', '.join(map(str, usual))}")
    if option.required:
        extra.append(words["required"])
    return names if option.is_flag else f"{names} {place(option)}", f"{text}  [{'; '.join(extra)}]" if extra else text


def _files_named(values: Iterable[object]) -> Iterator[str]:
    """Go through the names of files that values of parameters may be, one or several, or a pattern."""
    for value in values:
        for name in value if isinstance(value, tuple) else (value,):
            if isinstance(name, str) and "\0" not in name:
                yield from (name, *glob(name))


class Command(click.Command):
    """A command whose help is in the language of messages; its `epilog` is example commands, a line each.

    Names of people, files and words to look for are those of the language.
    """

    @property
    def told(self) -> str:
        """The name of its table of texts."""
        return self.name or ""

    def invoke(self, ctx: click.Context) -> Any:
        """Do it, unless a file of people would be written over, whose work it is: one that is read, or filled in."""
        outputs = (*ctx.params.get("files", ()), *filter(None, [ctx.params.get("moodle")]))
        for output in filter(os.path.exists, outputs):
            for name in filter(os.path.exists, _files_named(ctx.params.values())):
                if os.path.samefile(name, output):
                    raise KeptError("output-read", file=quote(output, SHOWN))
            from ..spreadsheets.files import keep_filled_in

            keep_filled_in(output)
        return super().invoke(ctx)

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Return the words after the command in the line of usage."""
        options = f"[{texts(system_language())['places']['OPTIONS']}]"
        return [options, *(_usage(param) for param in self.get_params(ctx) if isinstance(param, click.Argument))]

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write usage, what the command does, its options, commands of it, examples."""
        words = texts(system_language())["words"]
        usage = " ".join(self.collect_usage_pieces(ctx))
        formatter.write_usage(ctx.command_path, usage, f"{words['usage']}: ")
        for paragraph in told(self.told, "about", system_language()).split("\n\n"):
            formatter.write_paragraph()
            with formatter.indentation():
                formatter.write_text(" ".join(paragraph.split()))
        options = (param for param in self.get_params(ctx) if isinstance(param, click.Option))
        with formatter.section(words["options"]):
            formatter.write_dl([_row(ctx, self.told, option) for option in options])
        if rows := list(self.commands_told(ctx)):
            with formatter.section(words["commands"]):
                formatter.write_dl(rows)
        with formatter.section(words["example"]), formatter.indentation():
            lines = (self.epilog or "").format(**words).splitlines()
            formatter.write("".join(f"  {line}\n" for line in lines))

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem[str]]:
        """Return what a shell may complete, options and commands, with what they do."""
        options = (param for param in self.get_params(ctx) if isinstance(param, click.Option))
        rows = {name: _row(ctx, self.told, option)[1] for option in options for name in option.opts}
        rows.update(self.commands_told(ctx))
        offered = super().shell_complete(ctx, incomplete)
        return [item(one.value, help=rows.get(one.value)) for one in offered]

    def commands_told(self, ctx: click.Context) -> Iterator[tuple[str, str]]:
        """Yield the commands of a group with what they do, whole: no summary is cut."""
        yield from ()


class Group(Command, click.Group):
    """The commands; a wrong one is refused with the one that was meant."""

    @property
    def told(self) -> str:
        """The name of its table of texts."""
        return "kulman"

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Return the words after the command in the line of usage."""
        places = texts(system_language())["places"]
        return [*super().collect_usage_pieces(ctx)[:1], f"[{places['COMMAND']}]", f"[{places['ARGS']}]..."]

    def commands_told(self, ctx: click.Context) -> Iterator[tuple[str, str]]:
        """Yield the commands with what they do, in the order in which they were added."""
        for name in self.commands:
            yield name, " ".join(told(name, "about", system_language()).partition("\n\n")[0].split())

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that `args` begin with."""
        if args and not args[0].startswith("-") and not ctx.resilient_parsing:
            self.named(args[0])
        return super().resolve_command(ctx, args)

    def named(self, name: str) -> click.Command:
        """Return a command by its name; refuse an unknown one."""
        if name not in self.commands:
            raise unknown("cli-command-unknown", name, sorted(self.commands))
        return self.commands[name]
