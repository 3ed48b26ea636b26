"""The sheet of one variant of a task, drawn and saved; handouts: blank, with first steps, the key, one plan alone."""

from __future__ import annotations

import hashlib
import io
import json
import math
import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from typing import Any, get_args

from ..drawing.compose import Drawn, compose, on_one_page
from ..drawing.formats import Norm, format_named, printable
from ..drawing.handouts import begun_pages, gridded, keyed, marked, over_page
from ..drawing.markers import scannable
from ..drawing.page import STATEMENT, Page
from ..drawing.shapes import Group
from ..drawing.text import lettered
from ..drawing.titleblock import Stamp
from ..drawing.view import View
from ..drawing.writers import WRITERS, Files, page_files, save_all
from ..plans.names import role
from ..plans.quantities import measured
from ..scales.choices import SIZES
from ..scales.errors import InputError, KulmanError
from ..scales.names import latin, of_its_kinds, of_kind, seen, unknown
from ..scales.numbers import SHOWN, quote
from ..scales.packaged import packaged
from ..scales.scale import Fixed, Scale
from .case import Case, Request, Settings, Wanted, positions_of
from .reader import load_task
from .shelf import bundled
from .tables import picture
from .task import AnyTask, Task

# what a title block says beside what the task does
BLOCK = ("student", "group", "teacher", "department", "designation", "work", "date")
LETTERS = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"  # of base 32 without I, L, O, U, which are misread
LENGTH = 6
_MISREAD = str.maketrans({"O": "0", "I": "1", "L": "1", "І": "1", " ": None, "-": None, "–": None, "−": None})
_NUMBERED = re.compile("[A-Za-z]{0,3}([0-9]{1,6}[a-z]?)")
PAPER = "A4"
APART = (  # what is not asked for together
    ("--hidden-key", "--key"),
    ("--hidden-key", "--over"),
    ("--grid", "--over"),
    ("--steps", "--key"),
    ("--steps", "--over"),
    *(("--scan", other) for other in ("--steps", "--key", "--hidden-key", "--over", "--grid")),
)
NOTE_TEXTS = "kulman.drawing.notes"
MOST_DRAWN = 36  # positions whose plans one sheet shows
_NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
CODED, DIGEST = "KULMAN", 8  # what a QR code begins with, how many digits tell what is printed
ALL = 1000  # steps: no plan has more
TINY = 4.0  # mm of a link on a blank, from which on nobody can draw surely
BESIDE = PAGE, CONSTRUCTION = ".html", ".ggb"  # a page on which plans move, a construction for GeoGebra
SUFFIXES = (*WRITERS, *BESIDE)
ABOUT_PAPER = {
    "scales-changed",
    "scales-reduced",
    "scale-coarser",
    "cam-smaller",
    "gear-smaller",
    "hoist-smaller",
}  # keys of warnings


@dataclass(frozen=True, slots=True, repr=False)
class Sheet:
    """A drawn sheet: one page or several, and the scale factors drawn, by plan; a notebook shows the pages."""

    pages: tuple[Page, ...]
    scales: Mapping[str, Scale]
    format: str
    warnings: tuple[InputError, ...] = ()
    views: tuple[View, ...] = ()
    # files that hold more than pages, by their suffixes: on which the same plans move
    beside: Mapping[str, Callable[[], bytes]] = field(default_factory=dict, compare=False)

    def save(self, *paths: str | os.PathLike[str], tile: str | None = None) -> list[Path]:
        """Write the sheet to each of `paths`; the suffix picks the writer.

        HTML is a page on which the plans move, GGB their construction for GeoGebra.

        A PDF is spread at full size on pages of small paper where a `tile` is said, `A4` or `A3`.

        Returns
        -------
        list of Path
            The files written; several pages as SVG or PNG become `x-1.svg`, `x-2.svg`, ...

        Raises
        ------
        InputError
            A kind of file that is not written, two outputs of one name, a missing extra, or a file that cannot be
            written: then none is.
        """
        return save_all(paths, SUFFIXES, lambda path: self._files(path, tile))

    def warnings_of(self, *paths: str | os.PathLike[str]) -> tuple[InputError, ...]:
        """Return what a user should know of these files: of pages that move nothing that is about paper."""
        on_paper = any(Path(path).suffix.lower() not in BESIDE for path in paths)
        return tuple(warning for warning in self.warnings if on_paper or warning.key not in ABOUT_PAPER)

    def _files(self, path: Path, tile: str | None) -> Files:
        suffix = path.suffix.lower()
        if suffix not in BESIDE:
            return page_files(self.pages, path, tile)
        if suffix not in self.beside:
            raise InputError("output-suffix", file=quote(path, SHOWN), known=", ".join(WRITERS))
        return [(path, self.beside[suffix]())]

    def svg(self, page: int = 1) -> str:
        """Return one page, counted from 1, as SVG text; one that the sheet has not is refused."""
        from ..drawing.svg import write

        of_kind("page", page, (int,), "int")
        if not 1 <= page <= len(self.pages):
            raise InputError("page-missing", number=page, n=len(self.pages))
        stream = io.BytesIO()
        write(self.pages[page - 1 :], stream)
        return stream.getvalue().decode("utf-8")

    def __repr__(self) -> str:
        """Return title, format and the number of pages."""
        return f"<Sheet {self.pages[0].title!r}: {self.format}, pages: {len(self.pages)}>"

    def _repr_html_(self) -> str:
        """Show all pages in a notebook."""
        return "".join(picture(self.svg(number), self.pages[0].title) for number in range(1, len(self.pages) + 1))


@of_its_kinds()
def sheet(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    format: str | None = None,
    norm: Norm = "gost",
    lettering: str = "gost",
    notation: str | None = None,
    lang: str = "uk",
    positions: int | None = None,
    student: str = "",
    group: str = "",
    teacher: str = "",
    department: str = "",
    designation: str = "",
    work: str = "",
    date: str = "",
) -> Sheet:
    """Draw the sheet of one variant of a task to scale.

    Parameters
    ----------
    task, variant, set, only, scales, notation
        As for `solve`.
    format : str, optional
        `A4`, `A3`, `A2`, `A1`; without it the smallest of which one sheet holds everything. On a smaller one the
        sheet has several pages.
    norm : {"gost", "iso"}
        Lines, frame and title block by GOST, or by ISO 5457 and 7200.
    lettering : {"gost", "gost-slanted", "dejavu"}
        Letters of GOST 2.304, type B, words upright and symbols slanted, or all slanted; or a screen font.
    lang : {"uk", "ru", "en"}
        Language of all words on the sheet.
    positions : int, optional
        The sheet of so many positions instead, as of a course project: their plan, the plans of velocities and
        accelerations of each, diagrams over the cycle with their extremes.
    student, group, teacher, department, designation, work, date : str
        For the title block; what is left out stays blank, but for the designation, which is composed (`designation`),
        and the kind of work, in which `КР` or `КП` may stand for `РГР`.

    Raises
    ------
    InputError
        As for `solve`; also an unknown format or norm, words that the title block cannot hold, and a scale factor at
        which a plan does not fit.
    PositionError
        The position has no plan.
    """
    block = {"student": student, "group": group, "teacher": teacher, "department": department}
    block |= {"designation": designation, "work": work, "date": date}
    how = set, only, scales, notation, lang, format, norm, block, lettering, positions
    case = Request(load_task(task), variant, *how).case()
    drawn = draw_case(case)
    made = partial(_page_bytes, case), partial(_construction_of, case, drawn.scales)
    return replace(drawn, beside=dict(zip(BESIDE, made, strict=True)))


def _page_bytes(case: Case) -> bytes:
    return page_of(case).encode("utf-8")


def _construction_of(case: Case, scales: Mapping[str, Scale]) -> bytes:
    """Return the construction of a case, with scale factors by plan, as a file of GeoGebra.

    Raises InputError: constructions of this kind of task are not written.
    """
    if case.positions is not None:
        raise InputError("handout-apart", first="--positions", second=f"-o *{CONSTRUCTION}")
    words = case.words()
    code = sheet_id(case.task, case.variant, case.settings)
    about = words["moving.about"].format(task=case.task.id, variant=case.variant, code=code)
    return case.kind.construction(case, scales, words, (case.task.title[case.language], about))


def page_of(case: Case) -> str:
    """Return a page of HTML on which the mechanism of a case and its plans move, which needs nothing else.

    Raises InputError: pages of this kind of task do not move yet.
    """
    from ..drawing.moving import page

    if case.positions is not None:
        raise InputError("handout-apart", first="--positions", second=f"-o *{PAGE}")
    words, code = case.words(), sheet_id(case.task, case.variant, case.settings)
    data = case.kind.moving(case, words)
    about = words["moving.about"].format(task=case.task.id, variant=case.variant, code=code)
    return page(data, words, case.task.title[case.language], about)


def draw_case(case: Case) -> Sheet:
    """Draw the sheet of a case; errors as of `sheet`."""
    return sheet_of(case, drawing_of(case), stamp_of(case))


def drawing_of(case: Case) -> Drawn:
    """Draw the sheet of a case but for its title block; errors as of `sheet`."""
    paper = None if case.format is None else format_named(case.format)
    if case.norm not in get_args(Norm):
        raise unknown("norm-unknown", case.norm, get_args(Norm))
    if case.positions is not None:
        if case.kind.moves:
            raise InputError("kind-without", task=quote(case.task.id), text="--positions")
        positions_of(case.positions, MOST_DRAWN)
    error = case.error()
    if error is not None:
        raise error
    try:
        with lettered(case.lettering, case.language):
            return case.kind.draw(case, case.words(), case.norm, paper)
    except InputError as refusal:
        raise case.explained(refusal) from None


def said_of(block: Mapping[str, str]) -> dict[str, str]:
    """Return what a title block or a title page says, all of it texts, without signs that nobody sees."""
    for name, text in block.items():
        of_kind(name, text, (str,), "str")
    return {name: _legible(name, text) for name, text in block.items()}


def stamp_of(case: Case) -> Stamp:
    """Return what the title block of a case says."""
    said: dict[str, Any] = dict.fromkeys(BLOCK, "") | said_of(case.block)
    return Stamp(
        **{name: said[name] for name in ("designation", "group", "student", "teacher", "date")},
        organisation=said["department"],
        title=case.title,
        document_type=said["work"] or case.words()["sheet.document"],
        language=case.language,
        # a sheet of the cycle is marked by nothing: it is numbered in a series of its own
        identity=sheet_id(case.task, case.variant, case.settings) if case.positions is None else "",
        series=0 if case.positions is None else 1,
        code=work_code(case),
    )


def work_code(case: Case) -> str:
    """Return what designations of the sheets of a case begin with: subject, number of the task, variant (`ТММ.14.03`).

    Of letters and a number, as V03, it is the number if no other variant has it; a variant whose name is neither is
    known by its place among the others.
    """
    variant, numbers = case.variant, [_number_of(name) for name in case.task.variants]
    if _NUMBERED.fullmatch(variant) is None:
        variant = str([*case.task.variants].index(variant) + 1)
    elif numbers.count(_number_of(variant)) == 1:
        variant = _number_of(variant)
    return f"{case.words()['sheet.subject']}.{case.task.number:02d}.{variant.zfill(2)}"


def _number_of(variant: str) -> str:
    return _NUMBERED.sub(r"\1", variant).zfill(2)


def sheet_of(case: Case, drawn: Drawn, stamp: Stamp) -> Sheet:
    """Return the sheet of a case that has been drawn, with what a user should know of it."""
    warnings = [*case.warnings, *case.kind.fitted(case.solved, drawn)[1]]
    for scale in dict.fromkeys(drawn.scales.values()):  # fixed by the task, but the plan has no room on the format
        chosen = case.choosers.get(scale.symbol)
        if isinstance(chosen, Fixed) and scale.mu != chosen.mu:
            said = {"mu": f"{chosen.mu:g}", "drawn": f"{scale.mu:g}", "unit": scale.per_mm_unit}
            warnings.append(InputError("scale-coarser", symbol=scale.symbol, format=drawn.format, **said))
    # others than `solve` shows, which follow from the extents alone, of a sheet of one position
    paper, scales = case.kind.first_scales(case.solved, case.choosers, case.plans)
    changed, coarser = dict[str, KulmanError](), False
    for plan in case.solved.scale_of_plan if case.positions is None else ():
        usual, scale = scales[plan], drawn.scales[plan]
        if scale.mu != usual.mu and not isinstance(case.choosers.get(scale.symbol), Fixed):
            before, now = (case.display.scale(one) for one in (usual, scale))
            said = {"before": f"{before.mu:g}", "now": f"{now.mu:g}", "unit": now.per_mm_unit}
            changed[scale.symbol] = InputError("scale-changed", symbol=scale.symbol, **said)
            coarser |= scale.mu > usual.mu
    if changed:
        shows = case.command("solve", "--format", drawn.sheet.name)
        said = {"format": drawn.sheet.letters, "usual": paper.name, "command": shows}
        key = "scales-reduced" if paper.name == drawn.sheet.letters and coarser else "scales-changed"
        warnings.append(InputError(key, changes=tuple(changed.values()), **said))
    with lettered(case.lettering, case.language):
        pages = drawn.pages(stamp)
    return Sheet(pages, drawn.scales, drawn.format, tuple(warnings), drawn.views)


def sheet_id(task: Task, variant: str, settings: Settings | None = None) -> str:
    """Return the id of the sheet of a variant with its data, such as `3F7-K2M`; the same data give the same id."""
    data = {
        name: value if isinstance(value, str) else f"{value:.9e}"
        for name, value in task.resolve(variant, settings).items()
    }
    text = json.dumps([task.id, variant, data], ensure_ascii=True, sort_keys=True)
    number = int.from_bytes(hashlib.blake2s(text.encode("ascii"), digest_size=8).digest(), "big")
    letters = ""
    for _ in range(LENGTH):
        number, at = divmod(number, len(LETTERS))
        letters += LETTERS[at]
    return f"{letters[:3]}-{letters[3:]}"


def same_id(written: str, right: str) -> bool:
    """Tell whether a student has copied an id, letters that are easily misread counting as one."""
    return _copied(written) == _copied(right)


def _copied(text: str) -> str:
    return latin(text.strip().upper()).translate(_MISREAD)


def variant_of_id(task: Task, written: str) -> str | None:
    """Return the variant of a task, with its own data, to which an id belongs."""
    return next((name for name in task.variants if same_id(written, sheet_id(task, name))), None)


def task_of_id(written: str) -> str | None:
    """Return the bundled task to one of whose variants, with its own data, an id belongs."""
    return _bundled_ids().get(_copied(written))


@cache
def _bundled_ids() -> dict[str, str]:
    tasks = map(load_task, bundled())
    return {_copied(sheet_id(task, variant)): task.id for task in tasks for variant in task.variants}


@of_its_kinds(*BLOCK)
def handout(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    steps: int = 0,
    key: bool = False,
    hidden_key: bool = False,
    over: str | None = None,
    grid: bool = False,
    scan: bool = False,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    format: str = PAPER,
    norm: Norm = "gost",
    lettering: str = "gost",
    notation: str | None = None,
    lang: str = "uk",
    **block: str,
) -> Sheet:
    """Draw a handout: the sheet of a variant with its answers left out, at the same places and scales as the key.

    Parameters
    ----------
    task, variant, set, only, scales, format, norm, lettering, notation, lang
        As for `sheet`.
    steps : int
        How many steps of every plan are done, as the note numbers them; poles, pivots, guides are always there. None is
        drawn from what an earlier plan has yet to find. Where nothing that is drawn has steps, a warning says so.
    key : bool
        Draw the whole work, to be laid on the blank.
    hidden_key : bool
        Add what the handout leaves out as a layer that SVG and PDF open without: for the teacher, never for students.
    over : str, optional
        The view that is drawn alone on its page, to be printed on a transparency and laid over a student's plan.
    grid : bool
        Lay a light grid of 5 mm under the drawing.
    scan : bool
        Add markers and a QR code, by which `check` reads a photograph of the sheet when it has been drawn by hand.
    **block : str
        `student`, `group` and so on for the title block, as for `sheet`.

    Raises
    ------
    InputError, PositionError
        As for `sheet`; a number of steps below zero; no such view; steps or a hidden key beside the key; steps, a grid
        or a hidden key with one view alone; markers beside any of these, without their package or without room.
    """
    if steps < 0:
        raise InputError("handout-steps", text=quote(steps))
    asked = {"--key": key, "--over": over is not None, "--hidden-key": hidden_key, "--grid": grid, "--steps": steps > 0}
    asked["--scan"] = scan
    for first, second in APART:
        if asked[first] and asked[second]:
            raise InputError("handout-apart", first=first, second=second)
    how = set, only, scales, notation, lang, format, norm, block, lettering
    case = Request(load_task(task), variant, *how).case()
    drawing = drawing_for_print(case)
    if scan:
        return scannable_of_case(case, drawing)
    if over is None and not key:
        drawn = begun_of_case(case, drawing, steps)
    else:
        drawn = sheet_of(case, drawing, stamp_of(case))
        figures = {view.name: view for view in drawn.views if not (view.rows or view.lines)}
        if over is not None and over not in figures:
            raise unknown("figure-unknown", over, figures)
        pages = drawn.pages if over is None else (over_page(figures[over], drawn.pages[0]),)
        drawn = replace(drawn, pages=tuple(map(marked, pages)))
    if hidden_key:
        drawn = replace(drawn, pages=tuple(map(keyed, drawn.pages, drawing.placed)))
    if not grid:
        return drawn
    sheet, norm = drawing.sheet, drawing.norm
    return replace(drawn, pages=tuple(gridded(page, sheet, norm, at == 0) for at, page in enumerate(drawn.pages)))


def drawing_for_print(case: Case) -> Drawn:
    """Draw the sheet of a case, but for its title block, on paper whose edge printers leave white."""
    return drawing_of(replace(case, format=printable(format_named(case.format or PAPER))))


def card_of_case(case: Case, drawing: Drawn) -> Sheet:
    """Return the task of a case, whose `drawing` is for print, on a page of its own.

    Raises InputError: it takes more than a page.
    """
    given = (*STATEMENT, *case.kind.given_views(case))
    views, places = [view for view in drawing.views if (view.of or view.name) in given], None
    paper = drawing.sheet, drawing.norm
    if {*STATEMENT} <= {view.name for view in views}:
        places = on_one_page([view.size for view in views], *paper)
    begins = places is not None
    if places is None:
        words, said = case.words(), packaged(NOTE_TEXTS, "texts", case.language)
        with lettered(case.lettering, case.language):
            aims = case.kind.story(case, drawing.scales, words, said).aims
            every = [*case.kind.statements(case, case.kind.lettered(words, case.solved), aims)]
        ways = ((own, on_one_page([view.size for view in own], *paper, first=False)) for own in every)
        views, places = next((way for way in ways if way[1] is not None), (views, None))
    if places is None:
        raise InputError("sheet-too-small", format=drawing.format)
    card = compose(views, places, drawing.scales, drawing.sheet, drawing.norm, goes_on="")
    return replace(sheet_of(case, replace(card, begins=begins), stamp_of(case)), warnings=())


def begun_of_case(case: Case, drawing: Drawn, steps: int = 0) -> Sheet:
    """Return the handout of a case whose `drawing` is for print, with so many steps done."""
    drawn = sheet_of(case, drawing, stamp_of(case))
    words = case.words()

    def done(count: int) -> list[Page]:
        return begun_pages(drawn.pages, drawn.views, case.kind.begun(case, drawn.scales, words, count), count)

    begun = done(steps)
    stepless = steps > 0 and begun == done(0) == done(ALL)  # the first ones may set a plan up, as on the blank
    idle = (InputError("handout-stepless", task=quote(case.task.id), steps=steps),) if stepless else ()
    return replace(drawn, pages=tuple(map(marked, begun)), warnings=(*drawn.warnings, *_tiny(case, drawn), *idle))


def _tiny(case: Case, drawn: Sheet) -> Iterator[InputError]:
    """Tell of the shortest link where half a millimetre, by which a hand errs, is much of it on a blank."""
    found = measured(case.solved.quantities, case.solved.shown_on, drawn.scales).items() if drawn.scales else ()
    links = ((one.mm, name) for name, one in found if name in case.task.givens and role(name).kind == "l" and one.mm)
    least, name = min(links, default=(TINY, ""))
    if least < TINY and drawn.format != SIZES[-1]:
        yield InputError("handout-tiny", format=drawn.format, quantity=name, mm=f"{least:.2g}")


def scannable_of_case(case: Case, drawing: Drawn) -> Sheet:
    """Return the blank handout of a case whose `drawing` is for print, with markers and codes to be photographed."""
    begun, pages = begun_of_case(case, drawing), list[Page]()
    for number, (page, figures) in enumerate(zip(begun.pages, drawing.placed, strict=True), start=1):
        code = scan_code(case, number, page)
        pages.append(scannable(page, figures, number, code, drawing.sheets[number - 1], drawing.norm))
    return replace(begun, pages=tuple(pages))


def scan_code(case: Case, number: int, page: Page) -> str:
    """Return what the QR code of a page says: task, variant, sheet id, page, and a hash of what is printed there.

    Machines that differ in the last digits of their numbers print the same; those are 1/e mm apart that count as
    others, which no size of a drawing is rounded to.
    """
    from .crew import digest_of  # loads what starts processes: other sheets do without

    printed = [shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"]
    digest = digest_of(_NUMBER.sub(lambda one: f"{round(float(one[0]) * math.e)} ", repr(printed)))[:DIGEST]
    identity = sheet_id(case.task, case.variant, case.settings)
    how = case.language, format_named(case.format or PAPER).name
    return ":".join((CODED, case.task.id, case.variant, identity, str(number), *how, digest)).upper()


def _legible(name: str, text: str) -> str:
    """Return a text of a title block or a title page, of a person or a group, as it is shown.

    Raises
    ------
    InputError
        What stands in it is no text: bytes of a command line in another encoding.
    """
    if any("\ud800" <= sign <= "\udfff" for sign in text):
        raise InputError("text-bytes", name=name, text=quote(text))
    return " ".join(seen(text).split())
