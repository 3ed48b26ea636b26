"""The commands for teachers: handouts, variants, a class's sheets, marking."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ...scales.choices import HANDS, SHEETS
from ...scales.errors import InputError, system_language
from ...scales.numbers import SHOWN, quote
from . import console, helping

if TYPE_CHECKING:
    from ..marking.checks import Check
    from ..marking.reading import Answers


@console.command(
    "kulman handout nau-slider-crank -v 3 -o blank.pdf",
    "kulman handout nau-slider-crank -v 3 --steps 3 --format A3 -o begun.pdf",
    "kulman handout nau-slider-crank -v 3 --key -o key.pdf",
    "kulman handout nau-slider-crank -v 3 --grid --hidden-key -o teacher.svg",
    "kulman handout nau-slider-crank -v 3 --over velocity -o transparency.pdf",
    "kulman handout nau-slider-crank -v 3 --scan -o to-be-photographed.pdf",
    "kulman handout --markers -o to-stick-on.pdf",
)
@console.of_any_task
@console.output("..drawing.writers", required=True)
@click.option("--steps", metavar="K", default="0", show_default=True, callback=console.count)
@click.option("--key", is_flag=True)
@click.option("--hidden-key", is_flag=True)
@click.option("--over", metavar="PLAN", shell_complete=helping.completing(helping.plans))
@click.option("--grid", is_flag=True)
@click.option("--scan", is_flag=True)
@click.option("--markers", is_flag=True)
@console.sized(default="A4", show_default=True)
@console.of_norm
@console.tiled
@console.titled("student", *console.BLOCK)
@click.pass_context
def handout(
    context: click.Context,
    /,
    task: str | None,
    settings: dict[str, str],
    files: tuple[Path, ...],
    tile: str | None,
    **options: Any,
) -> None:
    """Draw a handout of TASK: givens, scales and poles, no answers; with rulers that prove the print."""
    from ..sheets import handout as handout_task

    if options.pop("markers"):
        _markers(files, tile, options)
        return
    if task is None:
        raise click.MissingParameter(ctx=context, param=context.command.params[0])

    flat = [file for file in files if file.suffix.lower() == ".png"]
    if flat and options["hidden_key"]:  # a picture has no layers
        raise InputError("handout-apart", first="--hidden-key", second=quote(f"-o {flat[0]}", SHOWN))
    block = console.without_none({name: options.pop(name) for name in (*console.BLOCK, "student")})
    drawn = handout_task(task, set=settings, **block, **{**options, "lang": console.of_documents(options["lang"])})
    console.say_written(drawn.save(*files, tile=tile), False)
    console.warn(drawn.warnings)


def _markers(files: tuple[Path, ...], tile: str | None, options: dict[str, Any]) -> None:
    """Write the page of markers that are stuck on sheets."""
    from ...drawing.markers import stickers
    from ...drawing.writers import WRITERS, page_files, save_all

    for name in ("steps", "key", "hidden_key", "over", "grid", "scan"):
        if options[name]:
            raise InputError("handout-apart", first="--markers", second=f"--{name.replace('_', '-')}")
    if options["format"] != "A4":
        raise InputError("handout-apart", first="--markers", second=f"--format {options['format']}")
    page = stickers(console.of_documents(options["lang"]))
    console.say_written(save_all(files, WRITERS, lambda path: page_files([page], path, tile)), False)


@console.command(
    "kulman variants nau-slider-crank --quantities V_B,a_B,M_bal",
    "kulman variants nau-slider-crank --make 3 --range 'l_OA=25..45/5 mm' -o my-class.toml -o key.xlsx",
    "kulman variants my-class.toml --quantities V_B -o questions.xml -o questions.gift",
    name="variants",
)
@console.of_task
@console.listed("--quantities", "NAME,...", helping.quantities)
@console.counted("--make")
@console.paired("--range", "ranges", metavar="NAME=RANGE", source=helping.givens)
@console.counted("--seed")
@click.option("--from", "table", metavar="FILE", shell_complete=helping.files)
@click.option("--preset", type=console.Word(*HANDS), default="normal", show_default=True)
@click.option("--by", type=console.Word("variant", "quantity"), default="variant", show_default=True)
@console.sized()
@console.output(".making.all_variants")
@console.as_json
def all_variants(task: str, settings: dict[str, str], files: tuple[Path, ...], as_json: bool, **options: Any) -> int:
    """Show the answers of all variants of TASK beside one another; make new variants, or read them."""
    from ..making.all_variants import all_variants as solve_all

    language = console.of_documents(options.pop("lang"), bool(files))
    with console.progress() as advance:
        found = solve_all(task, set=settings, lang=language, advance=advance, **options)
    console.hand_over(found, files, as_json)
    console.warn(found.warnings)
    return console.refuse(InputError("variants-problems", n=len(found.left_out))) if found.left_out else 0


@console.command(
    "kulman batch nau-slider-crank --form class.xlsx",
    "kulman batch nau-slider-crank --roster class.xlsx --out sheets --as pdf --teacher '{teacher}'",
    "kulman batch nau-slider-crank --roster class.xlsx --out blanks --as handout --only velocity --merge",
    "kulman batch scheme-08-planer scheme-09-shaper --form schemes.xlsx",
)
@console.of_tasks
@click.option("--roster", metavar="FILE", shell_complete=helping.files)
@click.option("--form", metavar="FILE", shell_complete=helping.files)
@click.option("--out", "folder", metavar="FOLDER", shell_complete=helping.files)
@click.option(
    "--as",
    "kinds",
    type=console.Word(*SHEETS, "note", "docx", "handout", "card"),
    multiple=True,
    default=("svg", "pdf", "note"),
    show_default=True,
)
@click.option("--merge", is_flag=True)
@click.option("--scan", is_flag=True)
@click.option("--digits", metavar="N|WORD,...")
@console.sized()
@console.of_norm
@console.titled(*console.BLOCK)
@click.option("--jobs", metavar="N", callback=console.processes)
@click.option("--dask", metavar="ADDRESS")
def batch(tasks: tuple[str, ...], settings: dict[str, str], kinds: tuple[str, ...], **options: Any) -> int:
    """Draw the sheets of TASK for a class and write their notes, with a list of files and the key."""
    if options.pop("variant") is not None:
        raise InputError("batch-variant")
    language, form = console.of_documents(options.pop("lang")), options.pop("form")
    if form is not None:
        from ..batches.batch import write_roster

        click.echo(str(write_roster(tasks, form, language)))
    if options["roster"] is not None and options["folder"] is not None:
        return _draw_class(tasks, set=settings, lang=language, kinds=kinds, **options)
    if form is None:
        raise InputError("batch-nothing")
    return 0


def _draw_class(tasks: tuple[str, ...], roster: str, folder: str, jobs: int, **options: Any) -> int:
    """Draw the sheets of a class; a console shows how far it is."""
    from ..batches.batch import MANIFEST
    from ..batches.batch import batch as draw_class

    block = console.without_none({name: options.pop(name) for name in console.BLOCK})
    with console.progress(folder=folder) as advance:
        made = draw_class(tasks, roster, folder, **block, advance=advance, jobs=jobs or None, **options)
    console.warn(made.warnings)
    bad = made.problems
    click.echo(made.whole(system_language()))
    for problem in made.told:
        click.echo(problem, err=True)
    listed = quote(Path(folder) / MANIFEST, SHOWN)
    return console.refuse(InputError("batch-problems", n=len(bad), file=listed)) if bad else 0


@console.command(
    "kulman check nau-slider-crank -v 3 --form answers.xlsx",
    "kulman check nau-slider-crank printed --verdict-only",
    "kulman check nau-slider-crank printed --preset lenient -o report.html",
)
@console.of_task
@click.argument("answers", nargs=-1, shell_complete=helping.files)
@click.option("--form", metavar="FILE", shell_complete=helping.files)
@click.option("--preset", type=console.Word(*HANDS), default="normal", show_default=True)
@click.option("--verdict-only", "own", is_flag=True)
@console.sized()
@click.option("--rubric", metavar="FILE", shell_complete=helping.files)
@click.option("--directions", type=console.Word("required", "optional", "ignored"))
@click.option("--roster", metavar="FILE", shell_complete=helping.files)
@console.listed("--schemes", "TASK,...", helping.tasks)
@click.option("--digits", metavar="N|WORD,...")
@click.option("--out", "folder", metavar="FOLDER", shell_complete=helping.files)
@click.option("--moodle", metavar="FILE", shell_complete=helping.files, type=Path)
@click.option("--jobs", metavar="N", callback=console.processes)
@console.output(".marking.report")
@click.option("--json", "as_json", is_flag=True)
def check(task: str, answers: tuple[str, ...], lang: str | None, settings: dict[str, str], **options: Any) -> None:
    """Mark ANSWERS to TASK: files with one student's answers or a class's, a folder of them, or a pattern."""
    from ...drawing.writers import check_outputs
    from ..marking.checks import check as ready
    from ..marking.reading import SUFFIXES

    if isinstance(task, str) and task.lower().endswith(SUFFIXES) and os.path.isfile(task):
        raise InputError("check-no-task", file=quote(task, SHOWN))
    if options["moodle"] is not None:  # before any work
        check_outputs(options["moodle"], known=(".csv",))
    shown = {name: options.pop(name) for name in ("files", "folder", "moodle", "jobs", "as_json")}
    form = options.pop("form")
    if form is None and not answers:
        raise InputError("check-nothing")
    written = form is not None or any(shown[name] for name in ("files", "folder", "moodle"))
    asked = ready(task, set=settings, lang=console.of_documents(lang, written), **options)
    console.warn(asked.warnings)
    if form is not None:
        console.say_written([asked.write_form(form)], shown["as_json"])
    if answers:
        _mark(asked, asked.read(*answers, warn=lambda error: console.warn([error])), **shown)


def _mark(
    asked: Check, found: list[Answers], files: tuple[Path, ...], folder: str | None, moodle: Path | None, **how: Any
) -> None:
    """Mark one student, or a class: to files, and to the console."""
    from ..drawings.files import SUFFIXES as DRAWINGS
    from ..marking.checks import write_tables
    from ..marking.class_page import PAGE
    from ..marking.report import PHOTOS, REPORTS
    from ..marking.result import class_lines

    reports = [file for file in files if file.suffix.lower() in (*REPORTS, *DRAWINGS, *PHOTOS)]
    drawings = [file for file in reports if file.suffix.lower() not in REPORTS]
    alone = len(found) == 1 and folder is None and moodle is None and len(reports) == len(files)
    known = PHOTOS if alone and found[0].photos else DRAWINGS if alone and found[0].drawn is not None else ()
    drawings = [file for file in drawings if file.suffix.lower() not in known]
    if drawings:
        raise InputError("drawing-alone", file=quote(drawings[0], SHOWN))
    if not alone and (how["as_json"] or any(file.suffix.lower() != PAGE for file in reports)):
        raise InputError("check-class")
    if alone:
        told = asked.mark(found[0])
        if how["as_json"]:
            console.print_json(told.to_json())
        elif not files:
            click.echo(told.text(), nl=False)
        told.save(*files)
    else:
        found = asked.ordered(found)
        with console.progress(folder=folder) as advance:
            results = asked.mark_all(found, folder, advance, how["jobs"] or None)
        write_tables(asked, results, found, files, moodle)
        for line in class_lines(asked.listed(found, results), system_language()):
            click.echo(line)
    console.say_written((*files, *filter(None, (folder, moodle))), how["as_json"])
