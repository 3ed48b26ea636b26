"""The command line: parses, calls, prints; every other module can be used without it."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from . import __version__
from .scales.choices import HANDS, SIZES
from .scales.errors import LANGUAGES, InputError, KulmanError, messages
from .scales.language import system_language
from .variants.kinds import KINDS
from .variants.options import (
    BLOCK,
    Word,
    count,
    count_if_given,
    example,
    given,
    of_check,
    of_norm,
    of_task,
    output,
    pairs,
    tiled,
    titled,
)
from .variants.usage import Group, usage_error

if TYPE_CHECKING:
    from .variants.marking.answers import Answers
    from .variants.marking.checks import Check
    from .variants.marking.result import Result
    from .variants.task import Task

INTERRUPTED, CLOSED = 130, 1


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit: 0, 2 for bad input, 3 for a position without a plan, 130 when interrupted."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # no matrices here: spares numpy its threads
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        status = commands.main(arguments, prog_name="kulman", standalone_mode=False)
        if sys.stdout is not None:  # as it is where nothing reads our output: started without a console, or `>&-`
            sys.stdout.flush()
    except click.UsageError as error:
        status = _refuse(usage_error(error))
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


@click.group(cls=Group, invoke_without_command=True, epilog=example("kulman solve nau-slider-crank -v 3"))
@click.version_option(__version__, message="%(version)s")
@click.pass_context
def commands(ctx: click.Context) -> None:
    """Solve and draw problems of the theory of mechanisms and machines, to scale."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


@commands.command("list", epilog=example("kulman list", "kulman list --json"))
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
        if "note" in task:
            click.echo(f"    {words['list-note']}: {task['note'][language]}")
    return 0


def _check(file: str, as_json: bool) -> int:
    """Show all faults of a task file, one a line."""
    from .variants.reader import read_file

    language = system_language()
    _, faults = read_file(file, thorough=True)
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


def _note(task: Task) -> None:
    """Show on stderr what a task says of its data."""
    language = system_language()
    if note := task.note_in(language):
        click.echo(f"{messages(language)['list-note']}: {note}", err=True)


def _print_json(data: Mapping[str, Any]) -> None:
    """Print one JSON object in ASCII, which every console and pipe lets through."""
    import json

    click.echo(json.dumps(data, ensure_ascii=True, allow_nan=False, indent=2))


@commands.command(
    epilog=example(
        "kulman solve nau-slider-crank -v 3",
        "kulman solve nau-slider-crank --set l_OA=30 --json",
        "kulman solve nau-slider-crank -v 3 --only velocity --condition",
        "kulman solve nau-slider-crank -v 3 --hand normal --format A3",
    )
)
@of_task
@click.option(
    "--condition",
    is_flag=True,
    help="Show for each quantity its condition K (errors of the data come through so many times, in parts of the "
    "largest vector of the plan) and the sine of the flattest intersection behind it.",
)
@click.option(
    "--hand",
    help=f"Show what a hand draws: {', '.join(HANDS)}, or errors of one's own (standard deviations of marks, "
    "directions, readings): '0.2 mm, 0.5 deg, 0.2 mm'. For each quantity where 95 % of drawings lie, half of that in "
    "mm and per cent, what a teacher should let pass, and the step that errs most.",
)
@click.option("--format", type=Word(*SIZES), help="Take the scale factors of the sheet of this format.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def solve(task: str, settings: dict[str, str], as_json: bool, lang: str | None, **options: Any) -> int:
    """Solve TASK (an id, or a TOML file) and show all quantities."""
    from . import variants

    solution = variants.solve(task, set=settings, lang=lang, **options)
    if as_json:
        _print_json(solution.to_json())
    elif solution.reason is None:
        language = lang or system_language()
        click.echo(solution.table(language) if solution.drawing is None else solution.drawn(language))
        _note(solution.task)
        _warn(solution.warnings)
    return _refuse(solution.reason) if solution.reason is not None else 0


@commands.command(
    epilog=example(
        "kulman sheet nau-slider-crank -v 3 -o sheet.svg -o sheet.pdf",
        "kulman sheet nau-slider-crank -o sheet.pdf --format A3 --student 'І. Петренко'",
    )
)
@of_task
@output("..drawing.writers", "Where to; the suffix picks the kind of file.", required=True)
@click.option("--format", type=Word(*SIZES), help="Without it the smallest one that holds everything.")
@of_norm
@tiled
@titled("student", *BLOCK)
def sheet(task: str, settings: dict[str, str], files: tuple[Path, ...], tile: str | None, **options: Any) -> None:
    """Draw the sheet of TASK (an id, or a TOML file) to scale."""
    from . import variants

    settled = {name: value for name, value in options.items() if value is not None}
    drawn = variants.sheet(task, set=settings, **settled)
    saved = drawn.save(*files, tile=tile)
    for path in saved:
        click.echo(str(path))
    _warn(drawn.warnings)


@commands.command(
    epilog=example(
        "kulman note nau-slider-crank -v 3 -o note.pdf -o note.md --student 'І. Петренко'",
        "kulman note madi-four-bar --figure velocity -o velocity.svg",
    )
)
@of_task
@output(".notes", "Where to: .pdf, .md with its figures beside it; of one figure .svg, .png.", required=True)
@click.option("--figure", metavar="NAME", help="One figure of the note alone: position, velocity, forces_23.")
@click.option("--format", type=Word(*SIZES), help="That of the sheet whose figures and numbers the note has.")
@titled("student", "group", "teacher", "department", "date")
def note(task: str, settings: dict[str, str], files: tuple[Path, ...], lang: str | None, **options: Any) -> None:
    """Write the explanatory note of TASK: the work step by step, with equations, figures, tables."""
    from . import variants

    said = {name: value for name, value in options.items() if value is not None}
    written = variants.note(task, set=settings, lang=lang or "uk", **said)
    for path in written.save(*files):
        click.echo(str(path))
    _warn(written.sheet.warnings)


@commands.command(
    epilog=example(
        "kulman handout nau-slider-crank -v 3 -o blank.pdf",
        "kulman handout nau-slider-crank -v 3 --steps 3 --format A3 -o begun.pdf",
        "kulman handout nau-slider-crank -v 3 --key -o key.pdf",
        "kulman handout nau-slider-crank -v 3 --over velocity -o transparency.pdf",
    )
)
@of_task
@output("..drawing.writers", "Where to; the suffix picks the kind of file.", required=True)
@click.option(
    "--steps", metavar="K", default="0", show_default=True, callback=count, help="So many steps of each plan."
)
@click.option("--key", is_flag=True, help="The whole work, at the same places.")
@click.option("--over", metavar="PLAN", help="One plan alone, for a transparency to lay over a student's drawing.")
@click.option("--format", type=Word(*SIZES), default="A4", show_default=True, help="The paper that is printed on.")
@of_norm
@tiled
@titled("student", *BLOCK)
def handout(task: str, settings: dict[str, str], files: tuple[Path, ...], tile: str | None, **options: Any) -> None:
    """Draw a handout of TASK: givens, scales and poles, no answers; with rulers that prove the print."""
    from . import variants

    said = {name: options.pop(name) for name in (*BLOCK, "student")}
    block = {name: text for name, text in said.items() if text is not None}
    drawn = variants.handout(task, set=settings, block=block, **{**options, "lang": options["lang"] or "uk"})
    for path in drawn.save(*files, tile=tile):
        click.echo(str(path))
    _warn(drawn.warnings)


@commands.command(
    epilog=example(
        "kulman sweep nau-slider-crank -v 3 --only velocity",
        "kulman sweep nau-slider-crank -v 3 --positions 24 -o cycle.csv -o cycle.pdf",
        "kulman sweep nau-slider-crank --points B,S2 --chords B --from '30 deg'",
        "kulman sweep madi-cam -o profile.csv",
    )
)
@of_task
@click.option(
    "--positions",
    metavar="N",
    callback=count_if_given,
    help="How many positions: 8, 12, 24, ...; without it 12, of a cam its section lines, and every degree in files.",
)
@click.option(
    "--points", metavar="POINT,...", multiple=True, callback=given, help="Only these points, or numbered links."
)
@click.option("--from", "start", metavar="PLACE", help="Where the driver begins; without it at the zero position.")
@click.option("--to", "end", metavar="PLACE", help="Where a sliding driver stops.")
@click.option(
    "--chords", metavar="POINT", help="Velocities and accelerations of a point or link by plans and by chords."
)
@output(".sweeps.sweeps", "Where to: all columns, points of profiles too, to a .csv; the drawing to .svg, .pdf, .png.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def sweep(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> int:
    """Solve TASK (an id, or a TOML file) over its whole cycle: positions, dead positions, strokes, extremes."""
    from . import variants

    language = options.pop("lang") or system_language()
    swept = variants.sweep(task, set=settings, lang=language, **options)
    for path in swept.save(*files):
        click.echo(str(path))
    if as_json:
        _print_json(swept.to_json())
    elif swept.reason is None and not files:
        click.echo(swept.table())
    return _refuse(swept.reason) if swept.reason is not None else 0


@commands.command(
    epilog=example(
        "kulman chart nau-slider-crank -v 3 --chart depth -o depth.pdf",
        "kulman chart nau-slider-crank --chart stability --quantities V_B,a_B,M_bal -o stability.csv",
        "kulman chart nau-slider-crank --chart stability,depth --positions 24 --tolerance 0.5",
        "kulman chart madi-cam --chart sections -o sections.csv",
    )
)
@of_task
@click.option(
    "--chart",
    metavar="CHART,...",
    multiple=True,
    callback=given,
    help="Of accuracy, stability, depth, of a cam sections, accuracy, stability, of gears scale; else all.",
)
@click.option("--quantities", metavar="NAME,...", multiple=True, callback=given, help="Only these: V_B,a_B,M_bal.")
@click.option(
    "--positions", metavar="N", callback=count_if_given, help="Positions of the cycle: 36 for accuracy, else 360."
)
@click.option("--tolerance", metavar="%", default="1", show_default=True, help="By how much a simpler model may miss.")
@click.option("--hand", default="normal", show_default=True, help=f"Who draws: {', '.join(HANDS)}.")
@output(".charts.charts", "Where to: pictures to .svg, .pdf, .png, rows to .csv; of several charts x-accuracy.svg, ...")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def chart(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> None:
    """Measure TASK: speed against accuracy, stability, which parts of the model it needs, or how many sections."""
    from .variants.charts.charts import chart as measured

    language = options.pop("lang") or system_language()
    found = measured(task, set=settings, lang=language, **options)
    for path in found.save(*files):
        click.echo(str(path))
    if as_json:
        _print_json(found.to_json())
    elif not files:
        click.echo(found.table())
    _warn(found.warnings)


@commands.command(
    epilog=example(
        "kulman check nau-slider-crank -v 3 --form answers.xlsx",
        "kulman check nau-slider-crank printed --verdict-only",
        "kulman check nau-slider-crank printed --preset lenient -o report.html",
    )
)
@of_task
@of_check
def check(task: str, answers: tuple[str, ...], lang: str | None, settings: dict[str, str], **options: Any) -> None:
    """Mark ANSWERS to TASK: files with one student's answers or a class's, a folder of them, or a pattern.

    The variant is that of the roster, of -v, or what the file says. The word `printed` stands for the answers that the
    source of a bundled task prints.
    """
    from . import variants

    shown = {name: options.pop(name) for name in ("files", "folder", "moodle", "jobs", "as_json")}
    form = options.pop("form")
    if form is None and not answers:
        raise InputError("check-nothing")
    asked = variants.check(task, set=settings, lang=lang or system_language(), **options)
    if form is not None:
        click.echo(str(asked.write_form(form)))
    if answers:
        _mark(asked, asked.read(*answers, warn=lambda error: _warn([error])), **shown)


def _mark(
    asked: Check, found: list[Answers], files: tuple[Path, ...], folder: str | None, moodle: Path | None, **how: Any
) -> None:
    """Mark one student, or a class: to files, and to the console."""
    from .variants.marking.reports import REPORTS

    reports = [file for file in files if file.suffix.lower() in REPORTS]
    alone = len(found) == 1 and folder is None and moodle is None and len(reports) == len(files)
    if not alone and (how["as_json"] or reports):
        raise InputError("check-class")
    if alone:
        _mark_one(asked, found[0], files, how["as_json"])
    else:
        results = _mark_class(asked, found, folder, how["jobs"] or None)
        _print_class(asked, found, results, files, moodle)
    for path in (*files, *filter(None, (folder, moodle))):
        click.echo(str(path))


def _mark_one(asked: Check, answers: Answers, files: tuple[Path, ...], as_json: bool) -> None:
    """Mark one student: the report to files, else to the console."""
    from .variants.marking.filing import write_reports
    from .variants.marking.report_json import to_json
    from .variants.marking.report_text import report_text

    told = asked.mark(answers)
    if as_json:
        _print_json(to_json(told, asked.rubric))
    elif not files:
        click.echo(report_text(told), nl=False)
    write_reports(told, files)


def _mark_class(asked: Check, found: list[Answers], folder: str | None, jobs: int | None) -> list[Result]:
    """Mark a class; a console shows how far it is."""
    with _progress() as advance:
        return asked.mark_all(found, folder, lambda done: advance(done, len(found)), jobs)


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """Show on a console how far a class is: told how many students more are done, and of how many."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda done, whole: None
        return
    with click.progressbar(length=0, file=sys.stderr) as bar:

        def advance(done: int, whole: int) -> None:
            bar.length = whole
            bar.update(done)

        yield advance


def _print_class(
    asked: Check, found: list[Answers], results: list[Result], files: tuple[Path, ...], moodle: Path | None
) -> None:
    """Write the tables of a class, and print a line per student."""
    from .variants.marking.class_table import class_lines
    from .variants.marking.filing import write_tables

    write_tables(asked, results, found, files, moodle)
    absent = asked.roster.missing(found) if asked.roster else []
    for line in class_lines(results, absent, asked.request.language):
        click.echo(line)


@commands.command(
    epilog=example(
        "kulman batch nau-slider-crank --form class.xlsx",
        "kulman batch nau-slider-crank --roster class.xlsx --out sheets --as pdf --teacher 'О. Коваль'",
    )
)
@of_task
@click.option(
    "--roster",
    metavar="FILE",
    help="A student a row: name, group, variant or record book, givens of one's own: .csv or .xlsx.",
)
@click.option("--form", metavar="FILE", help="Write a roster to fill in, .csv or .xlsx, a row for each variant.")
@click.option("--out", "folder", metavar="FOLDER", help="Where the files go, manifest.csv and key.csv.")
@click.option(
    "--as",
    "kinds",
    type=Word("svg", "pdf", "png", "note", "handout"),
    multiple=True,
    default=("svg", "pdf", "note"),
    show_default=True,
    help="What each student gets: the sheet, the explanatory note, a blank handout. Repeatable.",
)
@click.option(
    "--digits",
    metavar="N",
    default="1",
    show_default=True,
    callback=count,
    help="How many last digits of the record book give the variant, where the roster has none.",
)
@click.option("--format", type=Word(*SIZES), help="Without it the smallest one that holds everything.")
@of_norm
@titled(*BLOCK)
@click.option("--jobs", metavar="N", default="0", callback=count, help="Processes; as many as cores when left out.")
@click.option(
    "--dask", metavar="ADDRESS", help="Work on a Dask cluster: the address of its scheduler, tcp://host:8786."
)
def batch(task: str, settings: dict[str, str], kinds: tuple[str, ...], **options: Any) -> int:
    """Draw the sheets of TASK for a class and write their notes, with a list of the files and the key for the teacher.

    A run that was stopped goes on where it was; one with a longer roster draws the new sheets alone. A row that is
    wrong costs no other student anything.
    """
    if options.pop("variant") is not None:
        raise InputError("batch-variant")
    language, form = options.pop("lang") or "uk", options.pop("form")
    if form is not None:
        from .variants.classes.batch import write_roster

        click.echo(str(write_roster(task, form, language)))
    if options["roster"] is not None and options["folder"] is not None:
        return _draw_class(task, set=settings, lang=language, kinds=kinds, **options)
    if form is None:
        raise InputError("batch-nothing")
    return 0


def _draw_class(task: str, roster: str, folder: str, jobs: int, **options: Any) -> int:
    """Draw the sheets of a class; a console shows how far it is."""
    from . import variants
    from .variants.classes.batch import MANIFEST

    block = {name: text for name in BLOCK if (text := options.pop(name)) is not None}
    with _progress() as advance:
        made = variants.batch(task, roster, folder, block=block, advance=advance, jobs=jobs or None, **options)
    n, bad = len(made.students), made.problems
    click.echo(messages(system_language())["batch-done"].format(n=n, done=n - len(bad)))
    for problem in bad:
        click.echo(problem, err=True)
    return _refuse(InputError("batch-problems", n=len(bad), file=str(Path(folder) / MANIFEST))) if bad else 0


@commands.command(
    "variants",
    epilog=example(
        "kulman variants nau-slider-crank --quantities V_B,a_B,M_bal",
        "kulman variants nau-slider-crank --make 3 --range 'l_OA=25..45/5 mm' -o my-class.toml -o key.xlsx",
        "kulman variants my-class.toml --quantities V_B -o questions.xml -o questions.gift",
    ),
)
@of_task
@click.option("--quantities", metavar="NAME,...", multiple=True, callback=given, help="Only these: V_B,a_B,M_bal.")
@click.option("--make", metavar="N", callback=count_if_given, help="Make N new variants, each a good exercise.")
@click.option(
    "--range",
    "ranges",
    metavar="NAME=RANGE",
    multiple=True,
    callback=pairs,
    help="From, to and step of a given of new variants: 'l_OA=25..60/5 mm'; without it what the task's variants span.",
)
@click.option("--seed", metavar="N", callback=count_if_given, help="Another number makes other variants; else 1.")
@click.option(
    "--from",
    "table",
    metavar="FILE",
    help="Read new variants from a spreadsheet, .csv or .xlsx: parameters in rows and variants in columns, or turned.",
)
@click.option("--preset", type=Word(*HANDS), default="normal", show_default=True, help="What a question lets pass.")
@output(
    ".classes.answers",
    "Where to: all values to .csv or .xlsx, questions for Moodle to .xml or .gift, new variants to a task file, .toml.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def all_variants(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> int:
    """Show the answers of all variants of TASK beside one another; make new variants, or read them from a spreadsheet.

    A variant that is made can be solved and drawn on one sheet; its crank turns round, its lines meet at no small
    angles, its plans fit at the task's scale factors.
    """
    from . import variants

    if options.pop("variant") is not None:
        raise InputError("variants-one")
    language = options.pop("lang") or "uk"
    with _progress() as advance:
        found = variants.all_variants(task, set=settings, lang=language, advance=advance, **options)
    for path in found.save(*files):
        click.echo(str(path))
    if as_json:
        _print_json(found.to_json())
    elif not files:
        click.echo(found.table())
    _warn(found.warnings)
    return _refuse(InputError("variants-problems", n=len(found.left_out))) if found.left_out else 0


@commands.command(
    epilog=example(
        "kulman new my-mechanism.toml", "kulman new мій-механізм.toml --lang uk", "kulman new my-cam.toml --kind cam"
    )
)
@click.argument("file")
@click.option("--kind", type=Word(*KINDS), default=KINDS[0], show_default=True, help="What the task is about.")
@click.option("--lang", type=Word(*LANGUAGES), help="Language of the comments.")
def new(file: str, kind: str, lang: str | None) -> None:
    """Write FILE, a task file with comments, to begin a mechanism of one's own: a four-bar linkage, ready to solve."""
    from .variants.starter import start

    click.echo(str(start(file, lang or system_language(), kind)))
