"""What commands take and say: options, checked before any work; warnings, refusals, JSON, how far a long one is.

The usual values of options are what a user always says, written once in `kulman.toml` of their home.
"""

from __future__ import annotations

import codecs
import errno
import io
import os
import re
import sys
import tomllib
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO, TypeVar

import click

from ...scales.choices import FORMATS, LETTERINGS, PROFILES
from ...scales.errors import LANGUAGES, InputError, KulmanError, StoppedError, as_one, system_language
from ...scales.names import latin, unknown
from ...scales.numbers import SHOWN, quote
from . import helping
from .helping import Command, place

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from ..tables import Result

PLACE = "KULMAN_CONFIG"  # names another file; none where it is empty
NORMS = ("gost", "iso")
# by key: the parameter of commands that it is the usual value of
KEYS = ("name", "group", "teacher", "department", "work", "language", "norm", "notation", "profile")
PARAMETERS = {key: key for key in KEYS} | {"name": "student", "language": "lang"}


def _notations() -> tuple[str, ...]:
    from ...drawing.words import notations

    return notations()


_CHOICES: dict[str, Callable[[], tuple[str, ...]]] = {
    "language": lambda: LANGUAGES,
    "norm": lambda: NORMS,
    "notation": _notations,
    "profile": lambda: PROFILES,
}


def _settings_file() -> Path | None:
    """Return where the settings are looked for: `KULMAN_CONFIG`, else `kulman.toml` in the system's folder for them."""
    named = os.environ.get(PLACE)
    if named is not None:
        return Path(named) if named else None
    folder = os.environ.get("APPDATA" if sys.platform == "win32" else "XDG_CONFIG_HOME", "")
    if os.path.isabs(folder):
        return Path(folder) / "kulman.toml"
    home = os.path.expanduser("~")
    return Path(home) / ".config" / "kulman.toml" if os.path.isabs(home) else None


def settings() -> dict[str, str]:
    """Return the usual values of parameters; none where there is no file.

    Raises
    ------
    InputError
        The file cannot be read, or keys of it, which are all named, are none of `PARAMETERS` or have no value that they
        can have.
    """
    file = _settings_file()
    if file is None:
        return {}
    shown, text = quote(file, SHOWN), ""
    if not file.exists():
        if os.environ.get(PLACE):
            raise InputError("file-missing", file=f"{PLACE}: {shown}")
        return {}
    try:
        if not file.is_file():
            raise InputError("file-not-regular", file=shown)
        text = file.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
        raw = tomllib.loads(text)
    except OSError:
        raise InputError("file-unreadable", file=shown) from None
    except UnicodeDecodeError:
        raise InputError("settings-encoding", file=shown) from None
    except (tomllib.TOMLDecodeError, RecursionError) as problem:
        from ..reader import syntax_fault

        raise syntax_fault(text, shown, str(problem)) from None
    values, faults = {}, {}
    for key, given in raw.items():
        try:
            values[PARAMETERS.get(key, key)] = _value(key, given)
        except InputError as refused:
            faults[key] = refused
    if faults:
        from ..checks.basics import Checker, Places

        checker = Checker(shown, Places(text))
        for key, fault in faults.items():
            checker.fault((key,), fault)
        raise as_one(fault for _, _, fault in sorted(checker.faults, key=lambda one: one[:2]))
    return {name: value for name, value in values.items() if value}


def _value(key: str, given: object) -> str:
    """Return the value of a key, checked."""
    if key not in PARAMETERS:
        raise unknown("key-unknown", key, PARAMETERS)
    if not isinstance(given, str):
        raise InputError("type-text")
    if key not in _CHOICES or not given.strip():
        return given.strip()
    value = given.strip().lower()
    if value not in (known := _CHOICES[key]()):
        raise unknown("choice-unknown", given.strip(), known)
    return value


CLOSED = 1
STREAM = "-"  # the task in standard input
_TABLES = (".csv", ".html", ".xlsx")
WRITTEN = "uk"  # the language of files where none is said
LONGEST = 10_000  # characters of a word of the command line: longer is no name, number or path
# what the title blocks of a class have in common, but for the group that the roster says
BLOCK = ("group", "teacher", "department", "designation", "work", "date")
VARIANTS = (__package__ or "").rpartition(".")[0]
Function = TypeVar("Function", bound=Callable[..., Any])
if TYPE_CHECKING:
    TextType = click.ParamType[str]
else:  # only newer versions of click can be subscripted
    TextType = click.ParamType


def _nearest(problem: UnicodeError) -> tuple[str, int]:
    """Return what a console shows for letters and signs that its encoding lacks: like ones, else question marks."""
    if not isinstance(problem, UnicodeEncodeError):
        raise problem
    signs = problem.object[problem.start : problem.end]
    return "".join(_like(sign, problem.encoding) for sign in signs), problem.end


def _like(sign: str, encoding: str) -> str:
    """Return what stands for a sign: one like it, its letter in Latin ones, the name of a Greek one, its plain form."""
    small, name = _LATIN.get(sign.lower(), ""), unicodedata.name(sign, "")
    ways = [_LIKE.get(sign, ""), small if sign.islower() else small.capitalize()]
    ways += [name.rpartition(" ")[2].lower()] if name.startswith("GREEK") and " WITH " not in name else []
    raised = "^" if name.startswith("SUPERSCRIPT") else ""
    for way in (*ways, raised + unicodedata.normalize("NFKD", sign)):
        with suppress(UnicodeEncodeError):
            if way.encode(encoding):
                return way
    return "?"


_LIKE = {**dict.fromkeys("−–—", "-"), **dict.fromkeys("′’", "'"), **dict.fromkeys("«»", '"'), "…": "...", "→": "->"}
_LIKE |= {
    "·": "*",
    "×": "x",
    "≤": "<=",
    "≥": ">=",
    "✓": "+",
    "✗": "x",
    "°": " deg",
    "√": "sqrt",
    "і": "i",
    "І": "I",
    "ґ": "г",
    "Ґ": "Г",
}
_SPELT = (
    "а=a б=b в=v г=h ґ=g д=d е=e є=ie ж=zh з=z и=y і=i ї=i й=i к=k л=l м=m н=n о=o п=p р=r с=s т=t у=u ф=f х=kh ц=ts "
)
_SPELT += "ч=ch ш=sh щ=shch ь=' ю=iu я=ia ы=y э=e ъ=' ё=e"
_LATIN = dict(pair.split("=") for pair in _SPELT.split())
codecs.register_error("kulman-nearest", _nearest)
_ASCII = codecs.lookup("ascii")
_PLAIN = codecs.CodecInfo(
    *(_ASCII.encode, _ASCII.decode, _ASCII.streamreader, _ASCII.streamwriter),
    *(_ASCII.incrementalencoder, _ASCII.incrementaldecoder),
    name="kulman-ascii",  # by its own name click would take UTF-8 for it
)
codecs.register({"kulman_ascii": _PLAIN}.get)


def encode(stream: TextIO | None) -> None:
    """Let pipes and files have UTF-8, whatever the system says, and a console its own encoding."""
    if not isinstance(stream, io.TextIOWrapper):
        return
    spoken = codecs.lookup(stream.encoding).name
    if stream.isatty() and spoken != "utf-8":
        stream.reconfigure(encoding="kulman-ascii" if spoken == "ascii" else None, errors="kulman-nearest")
    else:
        stream.reconfigure(encoding="utf-8", errors="backslashreplace")


def refuse(error: KulmanError) -> int:
    """Show an error as one line and return its exit status."""
    with suppress(OSError):  # nobody reads it: the status still says what happened
        click.echo(error.text(system_language()), err=True)
    return error.status


def flush() -> None:
    """Hand over what is still to be printed."""
    if sys.stdout is not None:  # as it is where nothing reads our output: started without a console, or `>&-`
        sys.stdout.flush()


def lost_output(problem: OSError) -> int:
    """Say why the output cannot be written, unless its reader has closed it; return the exit status.

    An error without the name of a file that was not raised in printing is the system's: it is said as that.
    """
    trace = problem.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    module = trace.tb_frame.f_globals.get("__name__", "") if trace is not None else ""
    if module != __name__ and module.partition(".")[0] != "click":  # which alone prints, but for what `flush` does
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


def print_json(data: Mapping[str, Any]) -> None:
    """Print one JSON object."""
    from ..tables import json_text

    click.echo(json_text(data))


def say_written(paths: Sequence[object], as_json: bool, language: str = "") -> None:
    """Show the names of files that have been written; beside a JSON object, which is alone on stdout, on stderr.

    Of tables, which programs read, it is told in which `language` they are where nobody has chosen it.
    """
    for path in paths:
        click.echo(str(path), err=as_json)
    tables = [path for path in map(str, paths) if path.lower().endswith(_TABLES)]
    if tables and language not in ("", system_language()):
        warn([InputError("tables-language", file=quote(tables[0], SHOWN), lang=system_language())])


def of_documents(lang: str | None, written: bool = True) -> str:
    """Return the language of what is `written` into files: what has been said, else Ukrainian, which the tasks are in.

    What stands on the console alone is in the language of messages.
    """
    return lang or (WRITTEN if written else system_language())


def hand_over(found: Result, files: Sequence[Path], as_json: bool, tabled: bool = True) -> None:
    """Write what has been found to files and name these; print it as JSON, or as a table where no file is wanted."""
    from ..tables import watching

    with progress(lazy=True) as advance:
        token = watching.set(advance)
        try:
            written = found.save(*files)
        finally:
            watching.reset(token)
    say_written(written, as_json, found.words.language)
    if as_json:
        print_json(found.to_json())
    elif tabled and not files:
        click.echo(found.table(system_language()))


@contextmanager
def progress(lazy: bool = False, folder: str | None = None) -> Iterator[Callable[[int, int], None]]:
    """Show on a console how far long work is: told how many students, or charts, more are done, and of how many.

    What may not be long is `lazy`: nothing is shown before it is told of. Where it is interrupted it is said what has
    been written: what is done into a `folder` stays there, nothing else is written before all is done.
    """
    done = [0, 0]
    try:
        with _bar(lazy) as show:

            def advance(more: int, whole: int) -> None:
                done[:] = done[0] + more, whole
                show(more, whole)

            yield advance
    except KeyboardInterrupt:
        if folder is None or not done[0]:
            raise StoppedError("interrupted") from None
        raise StoppedError("interrupted-within", n=done[0], whole=done[1], folder=quote(folder, SHOWN)) from None


@contextmanager
def _bar(lazy: bool) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on a console, and nothing elsewhere."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda done, whole: None
        return
    bar = click.progressbar(length=0, file=sys.stderr)
    with ExitStack() as shown:
        begin = cache(lambda: shown.enter_context(bar))
        if not lazy:
            begin()

        def advance(done: int, whole: int) -> None:
            bar.length = whole
            begin()
            bar.update(done)

        yield advance


def usage_error(error: click.UsageError, words: Sequence[str], commands: click.Group) -> InputError:
    """Return click's error as one of ours, which has a message in every language."""
    called = next((commands.commands[word] for word in words if word in commands.commands), commands)
    command = "kulman" if called is commands else f"kulman {called.name}"
    if isinstance(error, click.NoSuchOption):
        # of `-set` click has read -s
        whole = next((word for word in words if word[:2] == error.option_name and len(word) > 2), error.option_name)
        longer = f"-{whole.partition('=')[0]}"
        known = [longer] if any(longer in one.opts for one in called.params) else error.possibilities
        text, like = quote(whole), next(iter(known or ()), None)
        if like:
            return InputError("cli-option-unknown-like", text=text, like=like)
        return InputError("cli-option-unknown", text=text, command=command)
    if isinstance(error, click.BadOptionUsage):
        option = next((one for one in called.params if error.option_name in one.opts), None)
        if isinstance(option, click.Option) and option.is_flag:
            return InputError("cli-option-flag", text=quote(error.option_name), command=command)
        value = place(option) if option is not None else ""
        return InputError("cli-option-value", text=quote(error.option_name), value=value, command=command)
    if isinstance(error, click.MissingParameter) and error.param is not None:
        name = place(error.param) if isinstance(error.param, click.Argument) else error.param.opts[0]
        return InputError("cli-missing", text=name, command=command)
    extra = re.search(r"unexpected extra arguments? \((.*)\)", error.message, re.DOTALL)
    if extra:
        meant = "--set" if "=" in extra[1] else "-o" if "." in extra[1] else "-v"  # which many leave out
        lists = {name for one in called.params if str(one.metavar).endswith(",...") for name in one.opts}
        behind = words[words.index(extra[1]) - 2] if extra[1] in words[2:] else ""  # of a list without its commas
        meant = behind if behind in lists else meant
        if " " not in extra[1] and any(meant in one.opts for one in called.params):
            return InputError("cli-extra-of", text=quote(extra[1]), option=meant)
        return InputError("cli-extra", text=quote(extra[1]), command=command)
    return InputError("cli-usage", text=quote(error.message), command=command)


class Word(TextType):
    """One of a few words, in capitals or not, also with Cyrillic letters that look like theirs: А3."""

    name = "word"

    def __init__(self, *words: str) -> None:
        """Accept `words`."""
        self.words = words

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the word that is meant."""
        meant = latin(value.strip()).lower()
        for word in self.words:
            if word.lower() == meant:
                return word
        option = param.opts[0] if param else ""
        raise unknown("cli-choice", value.strip(), self.words, option=option)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
        """Return the words that a shell may complete."""
        return [helping.item(word) for word in self.words if word.lower().startswith(incomplete.lower())]


def pairs(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> dict[str, str]:
    """Split NAME=VALUE; no name twice."""
    found: dict[str, str] = {}
    for value in values:
        name, equals, text = (part.strip() for part in value.partition("="))
        if not name or not equals or not text:
            raise InputError("cli-setting", option=param.opts[0], text=quote(value))
        if several := re.search(r"[,;]\s*(?=[^\W\d]\w*\s*=)", text):
            option, others = param.opts[0], text[several.end() :]
            raise InputError("cli-setting-again", option=option, text=quote(value), other=quote(others))
        if name in found:
            raise InputError("cli-setting-twice", option=param.opts[0], text=quote(name))
        found[name] = text
    return found


def _given(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...] | None:
    """Tell an option that was not given at all from an empty one."""
    return values or None


def output(module: str, required: bool = False) -> Callable[[Function], Function]:
    """Return the option `-o FILE`, which refuses, before any work, files that cannot be written.

    The `SUFFIXES` that can be stand in a module, which is imported when the option is read, not for the help.
    """

    def checked(ctx: click.Context, param: click.Parameter, values: tuple[str, ...]) -> tuple[Path, ...]:
        if ctx.resilient_parsing:  # for a shell that completes
            return ()
        from ...drawing.writers import check_outputs

        paths = tuple(map(Path, values))
        check_outputs(*paths, known=import_module(module, VARIANTS).SUFFIXES)
        return paths

    names, ending = ("-o", "--output", "files"), helping.suffixed(module, VARIANTS)
    return click.option(
        *names, metavar="FILE", multiple=True, required=required, callback=checked, shell_complete=ending
    )


def paired(*names: str, metavar: str = "NAME=VALUE", source: helping.Source) -> Callable[[Function], Function]:
    """Return an option for pairs NAME=VALUE, of which a shell completes the beginnings of a source."""
    return click.option(
        *names, metavar=metavar, multiple=True, callback=pairs, shell_complete=helping.completing(source)
    )


def _stacked(*options: Any) -> Callable[[Function], Function]:
    """Return what adds options to a command, in the order in which its help shows them."""

    def add(command: Function) -> Function:
        for option in reversed(options):
            command = option(command)
        return command

    return add


def listed(name: str, metavar: str, source: helping.Source | None = None) -> Callable[[Function], Function]:
    """Return an option for names, each alone or several with commas between; a shell completes those of a source."""
    complete = helping.completing(source) if source is not None else None
    return click.option(name, metavar=metavar, multiple=True, callback=_given, shell_complete=complete)


def piped(ctx: click.Context, param: click.Parameter, value: Any) -> Any:
    """Take the task from standard input where it is called `-`."""
    names = value if isinstance(value, tuple) else (value,)
    if ctx.resilient_parsing or STREAM not in names or os.path.exists(STREAM):
        return value
    from ..reader import task_of_stream

    task = task_of_stream(sys.stdin.buffer, STREAM)
    return tuple(task if one == STREAM else one for one in names) if isinstance(value, tuple) else task


_named = helping.completing(helping.tasks, with_files=True)
# the language, which `main` has already taken for messages
of_language = click.option("--lang", type=Word(*LANGUAGES))
_about_task: tuple[Any, ...] = (
    click.option("-v", "--variant", shell_complete=helping.completing(helping.variants)),
    paired("--set", "settings", source=helping.givens),
    paired("--scale", "scales", source=helping.scales),
    listed("--only", "PLAN,...", helping.plans),
    click.option("--notation", shell_complete=helping.completing(helping.notations)),
    of_language,
)
_task: dict[str, Any] = {"shell_complete": _named, "callback": piped}
of_task = _stacked(click.argument("task", **_task), *_about_task)
of_any_task = _stacked(click.argument("task", metavar="TASK", required=False, **_task), *_about_task)
of_tasks = _stacked(click.argument("tasks", metavar="TASK...", nargs=-1, required=True, **_task), *_about_task)
of_norm = _stacked(
    click.option("--norm", type=Word(*NORMS), default=NORMS[0], show_default=True),
    click.option("--lettering", type=Word(*LETTERINGS), default=LETTERINGS[0], show_default=True),
)
tiled = click.option("--tile", type=Word("A4", "A3"))


def command(*examples: str, name: str | None = None) -> Callable[[Callable[..., Any]], click.Command]:
    """Return what makes a command whose help ends with examples; it is called like its function without a `name`."""
    return click.command(name, cls=Command, epilog="\n".join(examples))


def counted(name: str) -> Callable[[Function], Function]:
    """Return an option for a whole number."""
    return click.option(name, metavar="N", callback=count)


def sized(**more: Any) -> Callable[[Function], Function]:
    """Return the option for the format of a sheet."""
    return click.option("--format", type=Word(*FORMATS), **more)


as_json = click.option("--json", "as_json", is_flag=True)


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


def titled(*names: str) -> Callable[[Function], Function]:
    """Return what adds `names`, which a title block or a title page says."""
    return _stacked(*(click.option(f"--{name}") for name in names))


def without_none(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options that were given."""
    return {name: value for name, value in options.items() if value is not None}
