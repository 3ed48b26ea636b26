"""What the reader, the solution, the sheet and the marking ask of a task without knowing of which kind it is."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, cast

from ...plans.solved import Check, Solved
from ...scales.choose import Choosers
from ...scales.display import AS_INSIDE, Display
from ...scales.errors import InputError
from ...scales.givens import Described, Givens
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.scale import Scale
from ..checks.basics import Checker, Field, record
from ..checks.names import Names, check_numbers, word_or_choice
from ..task import Given, Instead, Task
from . import MODULES

if TYPE_CHECKING:  # what a list of tasks, or their reader, does without
    from ...drawing.compose import Drawn
    from ...drawing.formats import Format
    from ...drawing.handouts import Shown
    from ...drawing.notes.blocks import Story
    from ...drawing.pens import Norm
    from ...drawing.words import Words
    from ...plans.condition import Condition
    from ...plans.hands.shaky import Paper, Tolerance
    from ...plans.marking.key import Question
    from ...plans.quantities import Quantity
    from ..case import Case
    from ..charts.charts import Gallery
    from ..sweeps.sweeps import SweepRequest, Swept

TRIED_FOR = 1.3  # seconds of processor time in which a file is read and its variants are tried

Numbers = Mapping[str, float]  # of a variant, SI
Choices = Mapping[str, str]  # of a variant: its word of each choice
Plans = tuple[str, ...]
Scales = Mapping[str, Scale]  # by plan
Subject = TypeVar("Subject")  # what is described: a mechanism, a cam, a gear pair, a hoist
Answer = TypeVar("Answer", bound=Solved)


class Kind(ABC, Generic[Subject, Answer]):
    """A kind of tasks; `table` is where their files describe the subject, `plans` what can be drawn of it."""

    table: ClassVar[str]
    givens: ClassVar[Givens] = {}  # what describes a subject; nothing where every task has names of its own
    display: ClassVar[Display] = AS_INSIDE  # the units of results where a file says no others
    plans: ClassVar[tuple[str, ...]]
    judged: ClassVar[str] = ""  # key of the heading of its checks, where a list of quantities ends in these
    pages: ClassVar[int] = 1  # how many a sheet has at most that holds everything well
    segments: ClassVar[bool] = True  # whether a segment may choose a scale factor
    instead: ClassVar[Instead] = ()  # which givens of a user stand in the place of others

    # Reading a task file. Faults go to the checker.

    def words(self, raw: object) -> frozenset[str]:
        """Return what the table `raw` says in words that may be names of choices: these need not set numbers."""
        if not isinstance(raw, dict):
            return frozenset()
        keys = (key for key, given in self.givens.items() if given.choices)
        return frozenset(name for key in keys if isinstance(name := raw.get(key), str))

    @abstractmethod
    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Subject | None:
        """Read the table of this kind; None when a part of it is at fault."""

    @abstractmethod
    def fits(self, checker: Checker, subject: Subject, head: Mapping[str, Any]) -> None:
        """Check that the subject has the plans and the scale factors that the `head` of the file wants."""

    def varies(self, checker: Checker, task: Task) -> None:
        """Check what can be wrong in single variants only, without solving them."""

    def tries(self, checker: Checker, task: Task) -> None:
        """Solve every variant: one that has no solution is a fault, and what else a teacher should know a remark.

        `TRIED_FOR` seconds after the file was begun it is said how many variants were not tried.
        """
        if any(path[:1] != ("variant",) for path in checker.faulty):
            return
        wrong, subject = {path[1] for path in checker.faulty if len(path) > 1}, cast(Any, task.subject)
        for row, variant in enumerate(task.variants):
            path = ("variant", row)
            if time.process_time() - checker.begun > TRIED_FOR:
                counts = {"n": len(task.variants) - row, "all": len(task.variants), "file": checker.file}
                checker.remark_of(path, variant, InputError("check-untried", **counts))
                return
            if row in wrong:
                continue
            try:
                solved = self.solve(subject, task.values(variant), task.words(variant), task.plans)
                error = solved.error()
            except InputError as refused:
                checker.fault_of(path, variant, refused)
                continue
            if error is not None:
                checker.fault_of(path, variant, error)
            for remark in self.remarks(task, variant, solved):
                checker.remark_of(path, variant, remark)

    def remarks(self, task: Task, variant: str, solved: Answer) -> Iterator[InputError]:
        """Go through what a teacher should know of a variant that is no fault of it."""
        yield from self.warnings(solved)

    # Solving.

    @abstractmethod
    def solve(self, subject: Subject, values: Numbers, words: Choices, plans: Plans) -> Answer:
        """Solve a variant with its `values` in SI and the `words` of its choices; impossible values are refused."""

    @abstractmethod
    def scale_symbols(self, solved: Answer) -> tuple[str, ...]:
        """Return the symbols of all scale factors that a task or a user may choose."""

    @abstractmethod
    def first_scales(self, solved: Answer, choosers: Choosers, plans: Plans) -> tuple[Format, Scales]:
        """Return format and scale factors by plan as they follow from the extents of plans, of which none is drawn."""

    def conditions(self, case: Case) -> dict[str, Condition]:
        """Return the condition of every quantity; what has none is refused."""
        raise InputError("kind-without", task=quote(case.task.id), text="condition")

    def warnings(self, solved: Answer) -> tuple[InputError, ...]:
        """Return what a user should know of what has been solved."""
        return ()

    def unfit(self, case: Case) -> Iterator[InputError]:
        """Go through what makes a variant a poor exercise: what users are warned of, rules that it breaks."""
        yield from case.warnings
        solved: Any = case.solved
        for check in self.checks(solved, solved.quantities):
            if not check.ok:
                yield InputError("variant-check", check=check.name)

    def checks(self, solved: Answer, quantities: Mapping[str, Quantity]) -> tuple[Check, ...]:
        """Return what a second route, or a rule of good design, says of a solution."""
        return ()

    def gallery(self, task: Task) -> Gallery:
        """Return what makes the charts of a task; one that has none is refused."""
        found: Gallery = self._own("charts", task).CHARTS
        return found

    def _own(self, folder: str, task: Task) -> Any:
        """Return the module about this kind of tasks in a folder of what is done with them; else refuse it."""
        if self.table not in MODULES:
            raise InputError("kind-without", task=quote(task.id), text=folder[:-1])
        return import_module(f"..{folder}.{MODULES[self.table]}", __package__)

    def sweep(self, case: Case, words: Words, asked: SweepRequest) -> Swept:
        """Look at a case over its whole cycle; one that has none is refused."""
        found: Swept = self._own("sweeps", case.task).SWEEP.of(case, words, asked)
        return found

    def listed(self, solved: Answer, plans: tuple[str, ...]) -> tuple[str, ...]:
        """Return the names of the quantities and scale factors that a list for some plans shows, in its order."""
        return tuple(solved.quantities)

    def headings(self, solved: Answer, words: Words) -> dict[str, str]:
        """Return the headings in a list of quantities, each by the first quantity under it; a short list has none."""
        return {}

    # Drawing.

    @abstractmethod
    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a case; on the smallest format that holds everything where `paper` is not said."""

    def fitted(self, solved: Answer, drawn: Drawn) -> tuple[Answer, tuple[InputError, ...]]:
        """Return what has been solved as large as a sheet draws it, and what a user should know of that."""
        return solved, ()

    def story(self, case: Case, scales: Scales, words: Words, texts: Mapping[str, str]) -> Story:
        """Return what the explanatory note says beside the views of the sheet, drawn with `scales` by plan."""
        from ...drawing.notes.blocks import Story

        return Story()

    def begun(self, case: Case, scales: Scales, words: Words, steps: int) -> Mapping[str, Shown]:
        """Return what is drawn, after the first steps, of views that are not drawn in stages; nothing of others."""
        return {}

    # Marking.

    def lettered(self, words: Words, solved: Answer) -> Words:
        """Return the words with the letters that depend on the subject."""
        return words

    def asks(self, solved: Answer, question: Question) -> bool:
        """Whether a form asks for a quantity."""
        return True

    def as_drawn(self, solved: Answer) -> Answer:
        """Return what has been solved as a student draws it, with what hangs on the drawing: it is marked."""
        return solved

    def stands_for(self, solved: Answer) -> dict[str, str]:
        """Return what quantities of `solved` are called in `as_drawn`, those that are called otherwise there."""
        return {}

    limits_add_up: ClassVar[bool] = False  # whether limits are those of errors of drawing, else of what is read off

    def limits(self, drawn: Answer, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Return by how much single quantities may miss, SI, where the usual rule does not hold.

        What is `drawn` is as `as_drawn` returns it, `paper` the same on paper, with its scale factors.
        """
        return {}

    def form_notes(self, solved: Answer) -> tuple[str, ...]:
        """Return the keys, after `form.`, of what a form of this kind says beside what every form does."""
        return ()

    def section(self, solved: Answer, question: Question, current: str) -> str:
        """Return the section of the form in which a question stands; `current` is that of the one before it."""
        return question.plan

    def section_heading(self, solved: Answer, section: str, words: Words) -> str:
        """Return the heading of a section of the form."""
        return self.plan_heading(solved, section, words)

    def plan_heading(self, solved: Answer, plan: str, words: Words) -> str:
        """Return the heading of a plan, as the sheet has it."""
        return words[f"heading.{plan}"]

    def vector_letters(self, solved: Answer, words: Words) -> dict[str, str]:
        """Return the letters of the vectors that show quantities on their plans."""
        return {}


class Sized(Kind[Subject, Answer]):
    """A kind whose subjects are described by words, and by numbers that all have names: cams, gear pairs, hoists.

    `room` is the folder of its plans and of its drawings. There what has one use is called alike, after the table:
    `solve_cam`, `CamScene`, `CamFitting` of `[cam]`.
    """

    room: ClassVar[str]
    symbols: ClassVar[tuple[str, ...]]  # of the scale factors that may be chosen
    made: ClassVar[type[Described]]
    unasked: ClassVar[tuple[str, ...]] = ()  # quantities that no form asks for

    def _in(self, layer: str, module: str, name: str) -> Any:
        """Return what a module of this kind's plans or drawings calls `name`; most need numpy."""
        return getattr(import_module(f"...{layer}.{self.room}.{module}", __package__), name)

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Subject | None:
        """Read the table, and hold the numbers of the task against those that such a subject has."""
        before = len(checker.faults)
        words = {key: given.choices for key, given in self.givens.items() if given.choices}
        fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in words.items()}
        read = record(checker, (self.table,), raw, fields)
        check_numbers(checker, names, self.givens, f"{self.table}-number-unknown")
        return cast(Any, self.made)(**read) if len(checker.faults) == before else None

    def fits(self, checker: Checker, subject: Subject, head: Mapping[str, Any]) -> None:
        """Check that the scale factors are those that may be chosen."""
        for name in head.get("scales", {}):
            if name not in self.symbols:
                checker.fault(("scales", name), unknown("scale-unknown", name, self.symbols, task=head.get("id", "")))

    @abstractmethod
    def impossible(self, values: Numbers) -> Iterable[tuple[str, InputError]]:
        """Go through what no such subject can have, each with the name of the number at fault, or without one."""

    def varies(self, checker: Checker, task: Task) -> None:
        """Check that every variant is one of such a subject."""
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

    def solve(self, subject: Any, values: Numbers, words: Choices, plans: Plans) -> Answer:
        """Solve a variant; numbers that belong to none are refused."""
        solved: Answer = self._in("plans", "solve", f"solve_{self.table}")(subject.chosen(words), values, plans)
        return solved

    def scale_symbols(self, solved: Answer) -> tuple[str, ...]:
        """Return the symbols of the scale factors that may be chosen."""
        return self.symbols

    def first_scales(self, solved: Answer, choosers: Choosers, plans: Plans) -> tuple[Format, Scales]:
        """Return format and scale factors by plan; those of diagrams follow from the construction."""
        found: tuple[Format, Scales] = self._in("drawing", "sheet", "first_scales")(solved, choosers, plans)
        return found

    def conditions(self, case: Case) -> dict[str, Condition]:
        """Return the condition of every quantity."""
        found: dict[str, Condition] = self._in("plans", "solve", "conditions_of")(case.solved)
        return found

    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a case."""
        from ...drawing.figure import SheetContents

        note = case.task.note_in(words.language)
        contents = SheetContents(case.solved, case.plans, case.choosers, case.givens, words, norm, note=note)
        drawn: Drawn = self._in("drawing", "sheet", f"{self.table.title()}Fitting")(contents).draw(paper)
        return drawn

    def fitted(self, solved: Answer, drawn: Drawn) -> tuple[Answer, tuple[InputError, ...]]:
        """Return what is solved with diagrams as small as the format has room for, and tell how small that is."""
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
        from ...drawing.formats import STYLES

        made = self._in("drawing", "sheet", f"{self.table.title()}Scene")
        solved: Any = case.solved
        return made(solved, self.lettered(words, solved), STYLES["A4"], case.givens)

    def story(self, case: Case, scales: Scales, words: Words, texts: Mapping[str, str]) -> Story:
        """Tell the drawings step by step, and what is calculated with its numbers."""
        story: Story = self._in("drawing", "text", "story")(self.scene(case, scales, words), scales, texts)
        return story

    def begun(self, case: Case, scales: Scales, words: Words, steps: int) -> Mapping[str, Shown]:
        """Return what is drawn of the tables; drawings have stages."""
        shown: Mapping[str, Shown] = self._in("drawing", "text", "begun")(self.scene(case, scales, words), steps)
        return shown

    def asks(self, solved: Answer, question: Question) -> bool:
        """Ask for what is found, not for what is given."""
        return question.name not in self.unasked and question.name not in solved.givens

    def limits(self, drawn: Answer, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Let pass what the errors of chords and marks add up to."""
        limits: dict[str, float] = self._in("plans", "solve", "tolerances_of")(drawn, paper, tolerance)
        return limits

    def headings(self, solved: Answer, words: Words) -> dict[str, str]:
        """Return the headings of the sections of the note, each by its first quantity."""
        first: dict[str, str] = {}
        for name in self.listed(solved, self.plans):
            first.setdefault(self._in("plans", "solve", "section_of")(name), name)
        return {name: words[f"heading.{self.table}_{self._headed(solved, section)}"] for section, name in first.items()}

    def _headed(self, solved: Answer, section: str) -> str:
        """Return what the heading of a section of the note is called."""
        return section

    def section(self, solved: Answer, question: Question, current: str) -> str:
        """Return the section of a question: that of the note."""
        section: str = self._in("plans", "solve", "section_of")(question.name)
        return section

    def plan_heading(self, solved: Answer, plan: str, words: Words) -> str:
        """Return the heading of a section, or of a plan, as the sheet has it."""
        return words[f"heading.{self.table}_{plan}"]

    def lettered(self, words: Words, solved: Answer) -> Words:
        """Return the words with the letters of the subject's quantities."""
        letters: Words = self._in("drawing", "sheet", "lettered")(words)
        return letters
