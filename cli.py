"""The command line: parses, calls, prints; every other module can be used without it."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from .scales.choices import HANDS, PROFILES, READINGS
from .scales.errors import (
    LANGUAGES,
    VARIABLE,
    InputError,
    KulmanError,
    messages,
    of_environment,
    speaking,
    system_language,
)
from .scales.kept import collect_seldom
from .scales.names import unknown
from .scales.numbers import SHOWN, quote
from .scales.version import __version__
from .variants.commands import console, helping
from .variants.commands.console import settings
from .variants.commands.helping import Group
from .variants.commands.teaching import all_variants, batch, check, handout
from .variants.kinds import KINDS

INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit: 0, 2 bad input, 3 no plan in a position, 4 a file is kept, 130 interrupted."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # no matrices here: spares numpy its threads
    for stream in (sys.stdout, sys.stderr):
        console.encode(stream)
    atexit.register(gc.freeze)  # nothing is looked through at the end, which takes a tenth of the time of charts
    words = sys.argv[1:] if arguments is None else arguments
    collect_seldom()  # to the very end
    with speaking(words):
        sys.exit(_run(words))


def _run(words: Sequence[str]) -> int:
    """Run a command and return its status."""
    try:
        if too_long := [word for word in words if len(word) > console.LONGEST]:
            raise InputError("cli-long", text=quote(too_long[0]), n=console.LONGEST)
        usual = settings()
        with speaking(words, usual.get("lang", "")):
            status = _call(words, usual)
    except KulmanError as error:  # of the settings
        status = console.refuse(error)
    return status


def _call(words: Sequence[str], usual: dict[str, str]) -> int:
    """Run a command with the usual values of its options and return its status."""
    try:
        status = commands.main(list(words), prog_name="kulman", standalone_mode=False, obj=usual)
        console.flush()
    except click.UsageError as error:
        status = console.refuse(console.usage_error(error, words, commands))
    except KulmanError as error:
        status = console.refuse(error)
    except (KeyboardInterrupt, click.Abort):
        status = INTERRUPTED
    except OSError as problem:
        if problem.filename is not None:  # not what a stream of ours raises
            raise
        status = console.lost_output(problem)
    return status if isinstance(status, int) else 0


@click.group(
    cls=Group,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="kulman solve nau-slider-crank -v 3",
)
@click.version_option(__version__, message="%(version)s")
@console.of_language
@click.pass_context
def commands(ctx: click.Context, lang: str | None) -> None:
    """Solve and draw problems of the theory of mechanisms and machines, to scale."""
    language = lang or of_environment()
    if language and language not in LANGUAGES:
        raise unknown("cli-choice", language, LANGUAGES, option=VARIABLE)
    usual = {**(ctx.obj or {}), **({"lang": language} if language else {})}
    ctx.default_map = dict.fromkeys(commands.commands, usual) if usual else None
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


@console.command("kulman help solve", name="help")
@click.argument("command", required=False, shell_complete=helping.completing(lambda ctx: commands.commands))
@console.of_language
@click.pass_context
def show_help(ctx: click.Context, command: str | None, lang: str | None) -> None:
    """Show the help of a command, or of all."""
    above = ctx.parent or ctx
    if command is None:
        click.echo(above.get_help())
    else:
        found = commands.named(command)
        click.echo(found.get_help(click.Context(found, parent=above, info_name=found.name)))


@console.command("kulman guide", "kulman guide own-mechanism", name="guide")
@click.argument("topic", required=False, shell_complete=helping.completing(helping.topics))
@console.of_language
def show_guide(topic: str | None, lang: str | None) -> None:
    """Show a guide, page by page on a console; without TOPIC the list of them."""
    from .variants.commands.guides import guide, page
    from .variants.shelf import guides

    if topic is None:
        for name, heading in guides(system_language()).items():
            click.echo(f"{name:<15}{heading}")
        return
    page(guide(topic, system_language()))


@console.command("kulman list", "kulman list {word}", "kulman list --json", name="list")
@click.argument("words", metavar="WORD...", nargs=-1, shell_complete=helping.completing(helping.tasks))
@console.as_json
@click.option("--check", "file", metavar="FILE", shell_complete=helping.files)
@console.of_language
def list_tasks(words: tuple[str, ...], as_json: bool, file: str | None, lang: str | None) -> int:
    """Show the tasks, or those with these words in their names, their variants, and what each draws."""
    from .variants.shelf import bundled, called

    if file is not None:
        return _check((file, *words), as_json)
    tasks = [*called(" ".join(words))]
    if not tasks:
        raise unknown("bundled-unknown", " ".join(words), bundled())
    language = system_language()
    if as_json:
        console.print_json({"tasks": tasks})
        return 0
    said = messages(language)
    for task in tasks:
        click.echo(f"{task['id']}  {task['title'][language]}")
        for key in ("variants", "plans"):
            click.echo(f"    {said[f'list-{key}']}: {', '.join(task[key])}")
        if "note" in task:
            click.echo(f"    {said['list-note']}: {task['note'][language]}")
    return 0


def _check(files: Sequence[str], as_json: bool) -> int:
    """Show all faults of task files, one a line, then what is worth knowing of their variants."""
    from .variants.reader import check_file

    language, found, bad = system_language(), list[dict[str, Any]](), list[KulmanError]()
    words = messages(language)
    for file in dict.fromkeys(files):
        try:
            faults, remarks = check_file(file)
        except InputError as error:  # one that there is not is no reason not to check the others
            bad.append(error)
            continue
        errors, told = ([{"key": e.key, "message": e.text(language)} for e in listed] for listed in (faults, remarks))
        found.append({"file": file, "ok": not faults, "errors": errors, "remarks": told})
        if faults:
            bad.append(InputError("check-bad", file=quote(file, SHOWN), n=len(faults)))
        if not as_json:
            lines = [one["message"] for one in errors]
            lines += [words["check-remark"].format(text=one["message"]) for one in told]
            said = words["check-remarks" if remarks else "check-ok"].format(file=file, n=len(remarks))
            for line in lines if faults else [*lines, said]:
                click.echo(line)
    if as_json and found:
        console.print_json(found[0] if len(files) == 1 else {"files": found})
    return max(map(console.refuse, bad), default=0)


@console.command(
    "kulman solve nau-slider-crank -v 3",
    "kulman solve nau-slider-crank --set l_OA=30 --json",
    "kulman solve nau-slider-crank -v 3 --only velocity --condition",
    "kulman solve nau-slider-crank -v 3 --hand normal --format A3",
)
@console.of_task
@click.option("--condition", is_flag=True)
@click.option("--hand", shell_complete=helping.completing(lambda ctx: HANDS))
@console.sized()
@console.of_norm
@console.output(".solution")
@console.as_json
def solve(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> int:
    """Solve TASK (an id, a TOML file, or - for standard input) and show all quantities."""
    from .variants.solution import solve as solve_task

    solution, language = solve_task(task, set=settings, **options), options["lang"] or system_language()
    told = replace(solution, words=solution.words.speaking(console.of_documents(options["lang"])))
    console.say_written(told.save(*files), as_json, told.words.language)
    if as_json:
        console.print_json(solution.to_json())
    elif solution.reason is None:
        if not files:
            click.echo(solution.table(language) if solution.drawing is None else solution.drawn(language))
            if options["variant"] is None and len(solution.task.variants) > 1:
                said = {"variant": solution.variant, "known": len(solution.task.variants)}
                click.echo(messages(system_language())["variant-first"].format(**said), err=True)
        if note := solution.task.note_in(system_language()):
            click.echo(f"{messages(system_language())['list-note']}: {note}", err=True)
        console.warn(solution.warnings)
    return console.refuse(solution.reason) if solution.reason is not None else 0


@console.command(
    "kulman sheet nau-slider-crank -v 3 -o sheet.svg -o sheet.pdf",
    "kulman sheet nau-slider-crank -o sheet.pdf --format A3 --student '{student}'",
    "kulman sheet scheme-09-shaper --positions 12 -o positions.pdf",
    "kulman sheet scheme-09-shaper -o moving.html -o construction.ggb",
)
@console.of_task
@console.counted("--positions")
@console.output(".sheets", required=True)
@console.sized()
@console.of_norm
@console.tiled
@console.titled("student", *console.BLOCK)
def sheet(task: str, settings: dict[str, str], files: tuple[Path, ...], tile: str | None, **options: Any) -> None:
    """Draw the sheet of TASK (an id, or a TOML file) to scale; as HTML, GGB what moves."""
    from .variants.sheets import sheet as sheet_task

    drawn = sheet_task(task, set=settings, **console.without_none(options))
    console.say_written(drawn.save(*files, tile=tile), False)
    console.warn(drawn.warnings_of(*files))


@console.command("kulman page --all site", "kulman page --all site scheme-09-shaper madi-cam --lang en")
@click.argument("tasks", metavar="TASK...", nargs=-1, shell_complete=helping.completing(helping.tasks, with_files=True))
@click.option("--all", "folder", metavar="FOLDER", required=True, shell_complete=helping.files)
@click.option("--jobs", metavar="N", callback=console.processes)
@console.of_language
def page(tasks: tuple[str, ...], folder: str, jobs: int, lang: str | None) -> int:
    """Write a site of pages on which plans move: all variants of each TASK, or of all, with an index."""
    from .variants.batches.site import site

    with console.progress(folder=folder) as advance:
        made = site(folder, tasks, lang=lang or "uk", jobs=jobs or None, advance=advance)
    click.echo(messages(system_language())["site-done"].format(n=made.pages, file=made.index))
    for problem in made.problems:
        click.echo(problem, err=True)
    return console.refuse(InputError("site-problems", n=len(made.problems))) if made.problems else 0


@console.command(
    "kulman note nau-slider-crank -v 3 -o note.pdf -o note.md --student '{student}'",
    "kulman note madi-four-bar --figure velocity -o velocity.svg",
    "kulman note nau-slider-crank -v 3 --readings ruler --profile dstu3008 -o note.pdf",
)
@console.of_task
@console.output(".notes", required=True)
@click.option("--figure", metavar="NAME")
@click.option("--readings", type=console.Word(*READINGS), default=READINGS[0])
@click.option("--profile", type=console.Word(*PROFILES), default="plain")
@console.sized()
@console.titled("student", "group", "teacher", "department", "date")
def note(task: str, settings: dict[str, str], files: tuple[Path, ...], lang: str | None, **options: Any) -> None:
    """Write the explanatory note of TASK: the work step by step, with equations, figures, tables."""
    from .variants.notes import note as note_task

    written = note_task(task, set=settings, lang=console.of_documents(lang), **console.without_none(options))
    console.say_written(written.save(*files), False)
    console.warn(written.sheet.warnings)


@console.command(
    "kulman sweep nau-slider-crank -v 3 --only velocity",
    "kulman sweep nau-slider-crank -v 3 --positions 24 -o cycle.csv -o cycle.pdf",
    "kulman sweep nau-slider-crank --points B,S2 --chords B --from '30 deg'",
    "kulman sweep madi-cam -o profile.csv",
)
@console.of_task
@console.counted("--positions")
@console.listed("--points", "POINT,...")
@click.option("--from", "start", metavar="PLACE")
@click.option("--to", "end", metavar="PLACE")
@click.option("--chords", metavar="POINT")
@console.output(".sweeps.sweeps")
@console.titled("student", *console.BLOCK)
@console.as_json
def sweep(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> int:
    """Solve TASK (an id, or a TOML file) over its whole cycle: positions, dead positions, strokes, extremes."""
    from .drawing.writers import WRITERS
    from .variants.sweeps.sweeps import sweep as sweep_task

    language = console.of_documents(options.pop("lang"), bool(files))
    block = console.without_none({name: options.pop(name) for name in (*console.BLOCK, "student")})
    swept = sweep_task(task, set=settings, lang=language, **block, **options)
    console.hand_over(swept, files, as_json, tabled=swept.reason is None)
    if any(file.suffix.lower() in WRITERS for file in files):
        console.warn(swept.warnings)
    return console.refuse(swept.reason) if swept.reason is not None else 0


@console.command(
    "kulman chart nau-slider-crank -v 3 --chart depth -o depth.pdf",
    "kulman chart nau-slider-crank --chart stability --quantities V_B,a_B,M_bal -o stability.csv",
    "kulman chart nau-slider-crank --chart stability,depth --positions 24 --tolerance 0.5",
    "kulman chart madi-cam --chart sections -o sections.csv",
)
@console.of_task
@console.listed("--chart", "CHART,...", helping.charts)
@console.listed("--quantities", "NAME,...", helping.quantities)
@console.counted("--positions")
@click.option("--tolerance", metavar="%", default="1", show_default=True)
@click.option("--hand", shell_complete=helping.completing(lambda ctx: HANDS), default="normal", show_default=True)
@console.output(".charts.charts")
@console.as_json
def chart(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> None:
    """Measure TASK: speed against accuracy, stability, which parts of the model it needs, or how many sections."""
    from .variants.charts.charts import chart as measured

    language = console.of_documents(options.pop("lang"), bool(files))
    if options["chart"]:
        options["chart"] = helping.as_explained("chart", "--chart", options["chart"])
    with console.progress() as advance:
        found = measured(task, set=settings, lang=language, advance=advance, **options)
    console.hand_over(found, files, as_json)
    console.warn(found.warnings)


@console.command(
    "kulman new my-mechanism.toml",
    "kulman new {file}",
    "kulman new my-cam.toml --kind cam",
    "kulman new --from scheme-09-shaper my-shaper.toml",
)
@click.argument("file", shell_complete=helping.files)
@click.option("--kind", type=console.Word(*KINDS), default=KINDS[0], show_default=True)
@click.option("--from", "source", metavar="TASK", shell_complete=helping.completing(helping.tasks))
@console.of_language
@click.pass_context
def new(ctx: click.Context, file: str, kind: str, source: str | None, lang: str | None) -> None:
    """Write FILE, a task file with comments, ready to solve: a four-bar linkage, a cam, a gear pair or a hoist."""
    from .variants.making.starter import start

    if source is not None and ctx.get_parameter_source("kind") is click.core.ParameterSource.COMMANDLINE:
        raise InputError("handout-apart", first="--from", second="--kind")
    click.echo(str(start(file, lang or system_language(), kind, source)))


@console.command("kulman show nau-slider-crank")
@click.argument("task", shell_complete=helping.completing(helping.tasks))
@console.of_language
def show(task: str, lang: str | None) -> None:
    """Print the task file of a bundled TASK."""
    from .variants.making.starter import shown

    click.echo(shown(task, lang or system_language()), nl=False)


@console.command("kulman serve --open", "kulman serve --host 0.0.0.0 --password-file passwords.txt --students sheets")
@console.counted("--port")
@click.option("--host", default="127.0.0.1", show_default=True)
@click.option("--name", "names", multiple=True)
@click.option("--password-file", "passwords", metavar="FILE", shell_complete=helping.files)
@click.option("--students", type=console.Word("forms", "sheets", "answers"))
@click.option("--open", "opened", is_flag=True)
@console.of_language
def serve(passwords: str | None, students: str | None, lang: str | None, **options: Any) -> None:
    """Open the whole program in a browser, on this machine."""
    try:
        from .variants.serving.app import serve as serve_pages
    except ModuleNotFoundError as missing:
        if missing.name not in ("markdown_it", "starlette", "uvicorn"):
            raise
        raise InputError("serve-extra") from None

    def tell(address: str) -> None:
        click.echo(messages(system_language())["serve-at"].format(address=address))
        console.flush()

    if students is not None and passwords is None:
        raise InputError("serve-students")
    serve_pages(passwords, students or "forms", lang or "", tell, **options)


_of_students = list_tasks, solve, sheet, page, note, sweep, chart, new, show
for command in (*_of_students, handout, all_variants, batch, check, serve, show_guide, show_help):
    commands.add_command(command)
