"""What is asked of a task, a case of it, and what can be asked of one whatever it is about.

A case is one variant of a task, solved for the plans wanted. Reader, solution, sheet and marking speak to its kind
without knowing which it is.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cache
from importlib import import_module
from numbers import Real
from typing import TYPE_CHECKING, Any, ClassVar, Generic, NamedTuple, TypeVar, cast

from ..drawing.words import Given, Words
from ..plans.names import role, scale_factor
from ..plans.solved import Check, Course, Solved
from ..scales.choices import RULER, SHEET
from ..scales.errors import LANGUAGES, InputError, KulmanError, PositionError, Written, as_one
from ..scales.givens import Bound, Described, Givens
from ..scales.names import by_name, named, names_of, of_kind, unknown
from ..scales.numbers import quote
from ..scales.packaged import packaged
from ..scales.scale import AS_INSIDE, Chooser, Choosers, Display, Scale, Segment, chooser, segment_symbol
from ..scales.units import UnitName
from .checks.basics import Checker, Field, record
from .checks.names import Names, check_numbers, word_or_choice
from .kinds import MODULES
from .task import WITH_FORCES, Instead, LocatedError, Task, as_text
from .task import Given as Stated
from .task import Settings as Settings

FAR = 100.0  # times more, or less, than any variant has
if TYPE_CHECKING:  # what a list of tasks, or their reader, does without
    from ..drawing.compose import Drawn
    from ..drawing.formats import Format, Norm
    from ..drawing.handouts import Shown
    from ..drawing.notes.blocks import Story
    from ..drawing.tables import Row
    from ..drawing.view import View
    from ..plans.condition import Condition
    from ..plans.hands.shaky import Paper, Tolerance
    from ..plans.marking.key import Question

Wanted = str | Iterable[str] | None  # names, each alone or several with commas between; all for none
Numbers = Mapping[str, float]  # of a variant, SI
Choices = Mapping[str, str]  # of a variant: its word of each choice
Plans = tuple[str, ...]
Scales = Mapping[str, Scale]  # by plan
Subject = TypeVar("Subject")  # what is described: a mechanism, a cam, a gear pair, a hoist
Answer = TypeVar("Answer", bound=Solved)
LINE = 2000  # letters of a command that a message names
WIDTH = 170.0  # mm of lines of text of a card
# options by which letters and frames take other room on a sheet, so that its scale factors may be others
_PRINTED = {"notation": "--notation", "language": "--lang", "norm": "--norm", "lettering": "--lettering"}
PARTS = (1.0, 0.8, 0.5, 0.4, 0.2)  # of its usual size that the picture of a card has


@dataclass(frozen=True, slots=True)
class Request:
    """What is asked of a task, by the keywords that every function of the package has; `block` is for title blocks."""

    task: Task
    variant: str | int | None = None
    settings: Settings | None = None  # in the place of givens
    only: Wanted = None
    scales: Settings | None = None
    notation: str | None = None
    language: str = "uk"
    format: str | Format | None = None
    norm: Norm = "gost"
    block: Mapping[str, str] = field(default_factory=dict)
    lettering: str = "gost"
    positions: int | None = None  # of the whole cycle, where that is drawn instead
    readings: str = SHEET  # or `ruler`: how segments are read
    as_wanted: bool = False  # whether the sheet of a cam, a gear pair, a hoist is refused where it has to be smaller

    def case(self) -> Case:
        """Solve what is asked for; what there is not, or is of the wrong kind, is refused."""
        task = self.task
        variant, said = task.variant(self.variant).id, by_name("set", self.settings)
        settings = {named(name, task.givens): value for name, value in said.items()}
        plans = plans_wanted(self.only, task)
        values, words = task.values(variant, settings), task.words(variant, settings)
        solved = kind_of(task.kind).solve(task.subject, values, words, plans)
        choosers = _choosers(task, by_name("scales", self.scales), solved)
        asked = {item.name: getattr(self, item.name) for item in fields(self)}
        return Case(**asked | {"variant": variant, "settings": settings}, plans=plans, solved=solved, choosers=choosers)


@dataclass(frozen=True, slots=True)
class Case(Request):
    """One variant of a task in one position; `choosers` are by scale factor."""

    variant: str = ""
    settings: Settings = field(default_factory=dict)
    plans: tuple[str, ...] = field(kw_only=True)
    solved: Solved = field(kw_only=True)
    choosers: Mapping[str, Chooser] = field(kw_only=True)

    @property
    def title(self) -> str:
        """The title of the task; where fewer plans are asked for, without what is studied, which a colon parts off."""
        whole: str = self.task.title[self.language]
        return whole if {*self.task.plans} <= {*self.plans} else whole.partition(":")[0]

    def command(self, verb: str, *options: str) -> Written:
        """Return the line that asks for the same from the command line, with all that changes numbers."""
        own = [
            *(("--set", item) for item in self.settings.items()),
            *(("--scale", item) for item in (self.scales or {}).items()),
        ]
        said = [part for option, (name, value) in own for part in (option, f"{name}={as_text(value)}")]
        only = [] if self.only is None else ["--only", ",".join(self.plans)]
        how = (one for one in fields(Request) if one.name in _PRINTED and getattr(self, one.name) != one.default)
        printed = (part for one in how for part in (_PRINTED[one.name], getattr(self, one.name)))
        words = "kulman", verb, self.task.file or self.task.id, "-v", self.variant, *said, *only, *printed, *options
        return quote(shlex.join(words), LINE)

    @property
    def values(self) -> dict[str, float]:
        """Every number that the subject names, SI."""
        return self.task.values(self.variant, self.settings)

    @property
    def givens(self) -> dict[str, Given]:
        """The givens as the task states them, each in its own unit."""
        stated = {}
        for name, value in self.task.resolve(self.variant, self.settings).items():
            unit = self.task.givens[name].unit
            if isinstance(value, str) or unit is None:
                stated[name] = Given(str(value))
            else:
                stated[name] = Given(float(f"{unit.from_si(value):.12g}"), unit.name)
        return stated

    @property
    def display(self) -> Display:
        """The units of results: those of the task, but SI where forces are wanted."""
        return Display(paper=self.task.display.paper) if WITH_FORCES.intersection(self.plans) else self.task.display

    def words(self, language: str | None = None) -> Words:
        """Return the words of results in their units; in the language that was asked for where none is said."""
        notation = self.task.notation if self.notation is None else self.notation
        words = Words.of(self.language if language is None else language, notation).showing(self.display)
        return replace(words, ruler=self.readings == RULER)

    def error(self) -> PositionError | None:
        """Return why there is no plan, or None; and which numbers that were set are far from those of the task."""
        error, beyond = self.solved.error(), [*self._far()]
        if error is None or not beyond:
            return error
        return PositionError("faults", status_word=error.status_word, faults=[*beyond, error])

    def explained(self, refusal: InputError) -> KulmanError:
        """Return why nothing is drawn, after the numbers that were set and are far from those of the task."""
        return as_one([*self._far(), refusal])

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a user should know: data far from those of the task, lines that meet at a small angle."""
        return *self._far(), *self.kind.warnings(self.solved)

    def _far(self) -> Iterator[InputError]:
        """Go through the numbers that were set and are far from those of the task."""
        values = self.task.resolve(self.variant, {**self.settings})
        return far(self.task, {name: value for name, value in values.items() if name in self.settings})

    @property
    def kind(self) -> Kind[Any, Any]:
        """Of which kind the task is."""
        return kind_of(self.task.kind)


class Tie(NamedTuple):
    """Of which given another one is a part, and which part it is at least and at most."""

    whole: str
    least: float
    most: float


class Kind(Generic[Subject, Answer]):
    """A kind of tasks; `table` is where their files describe the subject, `plans` what can be drawn of it.

    As it is here, a subject is described by words, and by numbers that all have names: cams, gear pairs, hoists. `room`
    is the folder of its plans and of its drawings. There what has one use is called alike, after the table:
    `solve_cam`, `CamScene`, `CamFitting` of `[cam]`.
    """

    home: ClassVar[str] = __name__.partition(".")[0]  # the package whose layers have the room
    room: ClassVar[str]
    elsewhere: ClassVar[Mapping[str, str]] = {}  # modules of functions that stand in others than usual
    table: ClassVar[str]
    made: ClassVar[type[Described]]
    givens: ClassVar[Givens] = {}  # what describes a subject; nothing where every task has names of its own
    stranger: ClassVar[str] = ""  # key of the message for a number of no such subject, where it has none of its own
    instead: ClassVar[Instead] = ()  # which givens of a user stand in the place of others
    display: ClassVar[Display] = AS_INSIDE  # the units of results where a file says no others
    plans: ClassVar[tuple[str, ...]]
    symbols: ClassVar[tuple[str, ...]]  # of the scale factors that may be chosen
    segments: ClassVar[bool] = True  # whether a segment may choose a scale factor
    pages: ClassVar[int] = 1  # how many a sheet has at most that holds everything well
    moves: ClassVar[bool] = True  # whether its plans have a course
    judged: ClassVar[str] = ""  # key of the heading of its checks, where a list of quantities ends in these
    rules: ClassVar[Mapping[str, str]] = {}  # keys of what is told of checks that fail
    unasked: ClassVar[tuple[str, ...]] = ()  # quantities that no form asks for
    unequal: ClassVar[bool] = False  # whether some variants of a task have more quantities than others
    limits_add_up: ClassVar[bool] = False  # whether limits are those of errors of drawing, else of what is read off
    # keys, after `form.`, of what a form says beside what every form does, by the plan to which it belongs, or by none
    form_notes: ClassVar[Mapping[str, str]] = {}

    def _in(self, layer: str, module: str, name: str) -> Any:
        """Return what a module of this kind's plans or drawings calls `name`; most need numpy."""
        return getattr(import_module(f"{self.home}.{layer}.{self.room}.{self.elsewhere.get(name, module)}"), name)

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Stated]) -> Subject | None:
        """Read the table of this kind, and hold the numbers of the task against its own; None where it is at fault."""
        before = len(checker.faults)
        words = {key: given.choices for key, given in self.givens.items() if given.choices}
        fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in words.items()}
        read = record(checker, (self.table,), raw, fields)
        check_numbers(checker, names, self.givens, self.stranger or f"{self.table}-number-unknown")
        return cast(Any, self.made)(**read) if len(checker.faults) == before else None

    def fits(self, checker: Checker, subject: Subject, head: Mapping[str, Any]) -> None:
        """Check that the subject has the plans and the scale factors that the `head` of the file wants."""
        for name in head.get("scales", {}):
            if name not in self.symbols:
                checker.fault(("scales", name), unknown("scale-unknown", name, self.symbols, task=head.get("id", "")))

    def impossible(self, values: Numbers) -> Iterable[tuple[str, InputError]]:
        """Go through what no such subject can have, each with the name of the number at fault, or without one."""
        return ()

    def varies(self, checker: Checker, task: Task) -> None:
        """Check what can be wrong in single variants only, without solving them."""
        told: set[str] = set()  # what is at fault in a default is so in every variant
        for row, variant in enumerate(task.variants.values()):
            for name, error in self.impossible(task.values(variant.id)):
                given = task.givens.get(name)
                if name in variant.values:
                    checker.fault(("variant", row, name), error)
                elif given is None or given.default is None:
                    checker.fault(("variant", row), error)
                elif name not in told:
                    told.add(name)
                    checker.fault(("givens", name, "default"), error)

    def remarks(self, task: Task, variant: str, solved: Answer) -> Iterator[InputError]:
        """Go through what a teacher should know of a variant that is no fault of it."""
        yield from self.warnings(solved)

    def solve(self, subject: Any, values: Numbers, words: Choices, plans: Plans) -> Answer:
        """Solve a variant with its `values` in SI and the `words` of its choices; impossible values are refused."""
        for _, error in self.impossible(values):
            raise error
        return cast("Answer", self._in("plans", "solve", f"solve_{self.table}")(subject.chosen(words), values, plans))

    def scale_symbols(self, solved: Answer) -> tuple[str, ...]:
        """Return the symbols of all scale factors that a task or a user may choose."""
        return self.symbols

    def first_scales(self, solved: Answer, choosers: Choosers, plans: Plans) -> tuple[Format, Scales]:
        """Return format and scale factors by plan as they follow from the extents of plans, of which none is drawn."""
        return cast("tuple[Format, Scales]", self._in("drawing", "sheet", "first_scales")(solved, choosers, plans))

    def conditions(self, solved: Answer) -> dict[str, Condition]:
        """Return the condition of every quantity."""
        return cast("dict[str, Condition]", self._in("plans", "solve", "conditions_of")(solved))

    def warnings(self, solved: Answer) -> tuple[InputError, ...]:
        """Return what a user should know of what has been solved: which `rules` do not hold."""
        failed = [check for check in self.checks(solved) if not check.ok and check.name in self.rules]
        return tuple(InputError(self.rules[c.name], value=f"{c.value:.5g}", limit=f"{c.limit:.5g}") for c in failed)

    def unfit(self, case: Case) -> Iterator[InputError]:
        """Go through what makes a variant a poor exercise: what users are warned of, rules that it breaks."""
        yield from case.warnings
        solved: Any = case.solved
        for check in self.checks(solved):
            if not check.ok:
                yield InputError("variant-check", check=check.name)

    def ties(self, task: Task) -> dict[str, Tie]:
        """Return which givens are parts of others, as far as new variants must keep to them."""
        return {}

    def checks(self, solved: Answer) -> tuple[Check, ...]:
        """Return what a second route, or a rule of good design, says of a solution."""
        return ()

    def course(self, solved: Answer) -> Course | None:
        """Return the subject over its motion; None where a cycle of positions takes the place of columns."""
        if not self.moves:
            return None
        return cast("Course", self._in("plans", "course", f"{self.table.title()}Course")(solved))

    def listed(self, solved: Answer, plans: tuple[str, ...]) -> tuple[str, ...]:
        """Return the names of the quantities and scale factors that a list for some plans shows, in its order."""
        return tuple(solved.quantities)

    def headings(self, solved: Answer, words: Words) -> dict[str, str]:
        """Return the headings in a list of quantities, each by the first quantity under it: those of the note."""
        first: dict[str, str] = {}
        for name in self.listed(solved, self.plans):
            first.setdefault(self._in("plans", "solve", "section_of")(name), name)
        return {name: words[f"heading.{self.table}_{self._headed(solved, section)}"] for section, name in first.items()}

    def _headed(self, solved: Answer, section: str) -> str:
        """Return what the heading of a section of the note is called."""
        return section

    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a case; on the smallest format that holds everything where `paper` is not said."""
        from ..drawing.figure import SheetContents

        contents = SheetContents(
            case.solved, case.plans, case.choosers, case.givens, words, norm, as_wanted=case.as_wanted
        )
        return cast("Drawn", self._in("drawing", "sheet", f"{self.table.title()}Fitting")(contents).draw(paper))

    def moving(self, case: Case, words: Words) -> dict[str, Any]:
        """Return what a page on which the plans of a case move needs of it (`drawing.moving`)."""
        from ..drawing.moving.courses import moving_course

        drawn, texts = self.draw(case, words), packaged("kulman.drawing.notes", "texts", case.language)
        solved: Any = case.solved
        course = self.course(solved)
        if course is None:
            raise InputError("kind-without", task=quote(case.task.id), text="-o *.html")
        scene, story = self.scene(case, drawn.scales, words), self.story(case, drawn.scales, words, texts)
        moved = self._in("drawing", "moving", "moving")(scene)
        bounds = {name: given.bound.value for name, given in case.task.givens.items()}
        return moving_course(moved, course, drawn, story, case.givens, self.lettered(words, solved), bounds)

    def construction(self, case: Case, scales: Scales, words: Words, titles: tuple[str, str]) -> bytes:
        """Return a construction as a file of GeoGebra, with scale factors by plan, its name and that of its variant.

        Raises InputError: those of this kind are not written.
        """
        raise InputError("construction-kinds", task=quote(case.task.id))

    def fitted(self, solved: Answer, drawn: Drawn) -> tuple[Answer, tuple[InputError, ...]]:
        """Return what has been solved as large as a sheet draws it, and what a user should know of that."""
        if drawn.reduction == 1.0:
            return solved, ()
        smaller: Answer = self._in("plans", "solve", "reduced")(solved, drawn.reduction)
        said = {"format": drawn.format, "part": f"{drawn.reduction:g}", **self.drawn_lengths(smaller)}
        return smaller, (InputError(f"{self.table}-smaller", **said),)

    def drawn_lengths(self, solved: Answer) -> dict[str, str]:
        """Return what is told of the lengths of smaller diagrams."""
        return {}

    def scene(self, case: Case, scales: Scales, words: Words) -> Any:
        """Return the case with its letters, for what is said of it."""
        from ..drawing.formats import STYLES

        solved: Any = case.solved
        made = self._in("drawing", "sheet", f"{self.table.title()}Scene")
        return made(solved, self.lettered(words, solved), STYLES["A4"], case.givens)

    def story(self, case: Case, scales: Scales, words: Words, texts: Mapping[str, str]) -> Story:
        """Return what the explanatory note says beside the views of the sheet, drawn with `scales` by plan."""
        told = cast("Story", self._in("drawing", "text", "story")(self.scene(case, scales, words), scales, texts))
        aims = (texts.get(f"{self.table}.aim.{plan}") for plan in case.plans)
        return replace(told, aims=told.aims or tuple(filter(None, aims)))

    def given_views(self, case: Case) -> tuple[str, ...]:
        """Return the views, beside those of the statement, of what is given."""
        return ()

    def begun(self, case: Case, scales: Scales, words: Words, steps: int) -> Mapping[str, Shown]:
        """Return what is drawn, after the first steps, of views that are not drawn in stages: of tables."""
        return cast("Mapping[str, Shown]", self._in("drawing", "text", "begun")(self.scene(case, scales, words), steps))

    def lettered(self, words: Words, solved: Answer) -> Words:
        """Return the words with the letters of the subject's quantities."""
        return cast("Words", self._in("drawing", "sheet", "lettered")(words, solved))

    def pictured(self, case: Case, words: Words, part: float = 1.0) -> View | None:
        """Return a figure of what is given, to stand beside a question, so large; None where words tell it."""
        return None

    def loaded(self, name: str) -> bool:
        """Whether a quantity hangs on loads and masses."""
        return True

    def stated(self, case: Case, words: Words, loaded: bool = True) -> Iterable[tuple[str, str, str]]:
        """Go through the data of a case as markup: symbol, what it is, value with its unit; or those without loads."""
        from ..drawing.tables import with_unit

        for symbol, said, value, of in self.rows(case, words):
            yield symbol or "", said or "", with_unit(value or "", of or "")
        if sentence := words.texts.get(f"stated.{self.table}"):  # what holds besides the data
            yield "", sentence, ""

    def rows(self, case: Case, words: Words) -> Sequence[Row]:
        """Return the data as a table has them: symbol, what it is, value, unit."""
        from ..drawing.formats import STYLES
        from ..drawing.tables import givens_view

        called = {name: self.called(case.task.subject, words, name) for name in case.givens}
        found = givens_view(case.givens, words, STYLES["A4"], called=called).rows[1:]
        return [(row[0], called[name], *row[2:]) for name, row in zip(case.givens, found, strict=True)]

    def called(self, subject: Any, words: Words, name: str) -> str:
        """Return what a given is, as markup; nothing where nothing tells it."""
        chosen = words.texts.get(f"given.{self.table}_{name}", words.texts.get(f"given.{name}", ""))
        return words.texts.get(f"called.{self.table}.{name}", chosen[:1].upper() + chosen[1:])

    def statements(self, case: Case, words: Words, aims: Sequence[str]) -> Iterator[list[View]]:
        """Go through the views of a task that stands alone, with ever smaller pictures: data, what is to be found."""
        from ..drawing.formats import STYLES
        from ..drawing.page import DATA, TASK
        from ..drawing.tables import table, text_block, words_of

        head = [words[f"table.{key}"] for key in ("symbol", "called", "value", "unit")]
        data = table(DATA, words["heading.givens"], [head, *self.rows(case, words)], STYLES["A4"])
        solved = cast("Answer", case.solved)
        wanted = [words.symbol(name) for name in solved.quantities if self.sought(solved, words, name)]
        lines = [*aims, words["task.find"].format(names=", ".join(wanted))]
        heading = words["heading.task"].format(variant=case.variant)
        task = text_block(TASK, heading, [*map(words_of, lines)], STYLES["A4"], WIDTH)
        for part in PARTS:
            yield [*filter(None, [self.pictured(case, words, part)]), data, task]

    def sought(self, solved: Answer, words: Words, name: str) -> str:
        """Return in words, as markup, what a quantity is that a question may ask for; nothing for any other."""
        return words.texts.get(f"sought.{self.table}.{name}", "")

    def asks(self, solved: Answer, question: Question) -> bool:
        """Whether a form asks for a quantity: for what is found, not for what is given."""
        return question.name not in self.unasked and question.name not in solved.givens

    def as_drawn(self, solved: Answer) -> tuple[Answer, Mapping[str, str]]:
        """Return what has been solved as a student draws it, with what hangs on the drawing: it is marked.

        Quantities that are called otherwise there follow, by the names that they have in `solved`.
        """
        return solved, {}

    def read_by_ruler(self, case: Case, scales: Scales) -> Answer:
        """Return what is solved as it is read with a ruler off drawings with scale factors by plan.

        Raises InputError: what is drawn of it is not read so.
        """
        raise InputError("kind-without", task=quote(case.task.id), text="--readings ruler")

    def magnified(self, case: Case, scales: Scales, words: Words) -> Mapping[str, float]:
        """Return how many times as large as on its plan a quantity is read in a detail beside it, where one is."""
        return {}

    def limits(self, drawn: Answer, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Return by how much single quantities may miss, SI, where the usual rule does not hold: errors add up.

        What is `drawn` is as `as_drawn` returns it, `paper` the same on paper, with its scale factors.
        """
        return cast("dict[str, float]", self._in("plans", "solve", "tolerances_of")(drawn, paper, tolerance))

    def section(self, solved: Answer, question: Question, current: str) -> str:
        """Return the section of the form in which a question stands; `current` is that of the one before it."""
        return cast("str", self._in("plans", "solve", "section_of")(question.name))

    def plan_heading(self, solved: Answer, plan: str, words: Words) -> str:
        """Return the heading of a plan, as the sheet has it, or of a section of the form."""
        return words[f"heading.{self.table}_{plan}"]

    def vector_letters(self, solved: Answer, words: Words) -> dict[str, str]:
        """Return the letters of the vectors that show quantities on their plans."""
        return {}


@cache
def kind_of(table: str) -> Kind[Any, Any]:
    """Return the kind of the tasks that have this table."""
    name = MODULES[table]
    return cast("Kind[Any, Any]", import_module(name if "." in name else f".kinds.{name}", __package__).KIND)


def far(task: Task, values: Mapping[str, float | str]) -> Iterator[InputError]:
    """Go through values that are hundreds of times more or less than any variant has: metres for millimetres."""
    for name, value in values.items():
        given, row = task.givens[name], (variant.values.get(name) for variant in task.variants.values())
        if isinstance(value, str) or given.unit is None or (given.bound is Bound.FREE and given.unit.dimension.angle):
            continue
        sizes = [size for size in row if not isinstance(size, str) and size]
        # a coordinate or a force of either sense may be as small as it likes
        least = 0.0 if given.bound is Bound.FREE else min(map(abs, sizes), default=0.0) / FAR
        if sizes and value and not least < abs(value) < max(map(abs, sizes)) * FAR:
            own = {"text": value, "least": min(sizes), "most": max(sizes)}
            said = {key: f"{given.unit.from_si(size):.6g}" for key, size in own.items()}
            yield LocatedError(name, InputError("given-far", unit=UnitName(given.unit.name), **said))


def beside(task: Task, folder: str) -> Any:
    """Return the module about the kind of a task in a folder of what is done with tasks; else refuse it."""
    name = MODULES.get(task.kind, ".")
    if "." in name:
        raise InputError("kind-without", task=quote(task.id), text=folder[:-1])
    return import_module(f".{folder}.{name}", __package__)


def _choosers(task: Task, scales: Settings, solved: Solved) -> dict[str, Chooser]:
    """Return how each scale factor is chosen: as the task says, unless the user says otherwise."""
    choosers = {symbol: chooser(symbol, text) for symbol, text in task.scales.items()}
    symbols = kind_of(task.kind).scale_symbols(solved)
    drawn = {*solved.scale_of_plan.values(), *solved.scale_of_figure.values()}
    known = tuple(symbol for symbol in symbols if symbol in drawn)
    scales = {named(name, known): text for name, text in scales.items()}
    for name, said in _by_symbol(scales, symbols, solved).items():
        text = as_text(said)
        of_kind(name, text, (str, Real), "str | float | tuple[float, str]")
        if role(name).kind == "mu" and name not in symbols:
            if name in solved.quantities:
                raise InputError("scale-follows", symbol=name, known=", ".join(known))
            if name in solved.scale_of_figure.values():
                raise InputError("scale-larger", symbol=name, known=", ".join(known))
            raise unknown("scale-unknown", name, known, task=task.id)
        segment = name if role(name).kind != "mu" else str(text) if "=" in str(text) else ""
        if segment and not kind_of(task.kind).segments:
            raise InputError("scale-no-segments", text=quote(segment), known=", ".join(known))
        try:
            symbol = name if role(name).kind == "mu" else segment_symbol(name)
            chosen = chooser(symbol, str(text) if symbol == name else f"{name}={text}", firm=True)
            shown = {*solved.values, *solved.quantities}
            if symbol in known and isinstance(chosen, Segment) and chosen.quantity not in shown:
                raise InputError("scale-segment", text=quote(name))
        except InputError as error:
            raise LocatedError(name, error) from error
        if symbol not in known:
            raise InputError("scale-not-drawn", text=quote(name), known=", ".join(known) or "-")
        choosers[symbol] = chosen
    return choosers


def _by_symbol(scales: Settings, known: Sequence[str], solved: Solved) -> Settings:
    """Return what is said of each scale factor: of all plans of forces where mu_F is said, as sheets have it."""
    found = dict(scales)
    for name, text in scales.items():
        of_all = role(name).kind == "mu" and name == scale_factor(role(name).of)
        if of_all and name not in known and name not in solved.quantities:
            drawn = [symbol for symbol in solved.scale_of_plan.values() if symbol in known]
            same = [symbol for symbol in drawn if role(symbol).of == role(name).of]
            if same:
                del found[name]
                found |= {symbol: scales.get(symbol, text) for symbol in same}
    return found


def positions_of(value: int, most: int | None = None) -> int:
    """Return a number of positions or sections that a cycle can have, at `most` so many."""
    from ..plans.linkages.cycle import FEWEST, MOST  # brings numpy, which most commands do without

    if not FEWEST <= value <= (most or MOST):
        raise InputError("positions-number", n=quote(value), least=FEWEST, most=most or MOST)
    return value


def plans_wanted(value: Wanted, task: Task) -> tuple[str, ...]:
    """Return the plans that `only` names, each alone or several with commas between; all of the task for none.

    They come in the order of the work, however they are named: reports name them in the language of their reader. One
    that the task does not have of itself may be asked for, too; of one that there is not, its own are told.
    """
    if value is None:
        return task.plans
    of_kind("only", value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    plans, known = names_of("only", items), kind_of(task.kind).plans
    if not plans or not {*plans}.issubset(known):
        texts = [packaged(f"{Kind.home}.drawing", "texts", language) for language in LANGUAGES]
        said = {text[key].casefold(): plan for text in texts for plan in known if (key := f"hand.plan.{plan}") in text}
        plans = tuple(said.get(name.casefold(), name) for name in plans)
        for name in plans or items[:1]:
            if name not in known:
                raise unknown("plan-unknown", name, task.plans, (*known, *said))
    return tuple(plan for plan in known if plan in plans) or task.plans
