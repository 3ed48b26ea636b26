"""Tasks about what words and named numbers describe: cams, gear pairs, hoists."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, cast

from ...plans.solved import Course
from ...scales.errors import InputError
from ...scales.givens import Described
from ...scales.names import unknown
from ...scales.scale import Choosers
from ..case import Answer, Case, Choices, Kind, Numbers, Plans, Scales, Subject
from ..checks.basics import Checker, Field, record
from ..checks.names import Names, check_numbers, word_or_choice
from ..task import Given, Task

if TYPE_CHECKING:
    from ...drawing.compose import Drawn
    from ...drawing.formats import Format
    from ...drawing.handouts import Shown
    from ...drawing.notes.blocks import Story
    from ...drawing.pens import Norm
    from ...drawing.words import Words
    from ...plans.condition import Condition
    from ...plans.hands.shaky import Paper, Tolerance
    from ...plans.marking.key import Question


class Sized(Kind[Subject, Answer]):
    """A kind whose subjects are described by words, and by numbers that all have names: cams, gear pairs, hoists.

    `room` is the folder of its plans and of its drawings. There what has one use is called alike, after the table:
    `solve_cam`, `CamScene`, `CamFitting` of `[cam]`.
    """

    home: ClassVar[str] = "kulman"  # the package whose layers have the room
    room: ClassVar[str]
    symbols: ClassVar[tuple[str, ...]]  # of the scale factors that may be chosen
    made: ClassVar[type[Described]]
    moves: ClassVar[bool] = True  # whether its plans have a course
    stranger: ClassVar[str] = ""  # key of the message for a number of no such subject, where it has none of its own
    unasked: ClassVar[tuple[str, ...]] = ()  # quantities that no form asks for

    def _in(self, layer: str, module: str, name: str) -> Any:
        """Return what a module of this kind's plans or drawings calls `name`; most need numpy."""
        return getattr(import_module(f"{self.home}.{layer}.{self.room}.{module}"), name)

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Subject | None:
        """Read the table, and hold the numbers of the task against those that such a subject has."""
        before = len(checker.faults)
        words = {key: given.choices for key, given in self.givens.items() if given.choices}
        fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in words.items()}
        read = record(checker, (self.table,), raw, fields)
        check_numbers(checker, names, self.givens, self.stranger or f"{self.table}-number-unknown")
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
        for _, error in self.impossible(values):
            raise error
        solved: Answer = self._in("plans", "solve", f"solve_{self.table}")(subject.chosen(words), values, plans)
        return solved

    def scale_symbols(self, solved: Answer) -> tuple[str, ...]:
        """Return the symbols of the scale factors that may be chosen."""
        return self.symbols

    def first_scales(self, solved: Answer, choosers: Choosers, plans: Plans) -> tuple[Format, Scales]:
        """Return format and scale factors by plan; those of diagrams follow from the construction."""
        found: tuple[Format, Scales] = self._in("drawing", "sheet", "first_scales")(solved, choosers, plans)
        return found

    def conditions(self, solved: Answer) -> dict[str, Condition]:
        """Return the condition of every quantity."""
        found: dict[str, Condition] = self._in("plans", "solve", "conditions_of")(solved)
        return found

    def course(self, solved: Answer) -> Course | None:
        """Return the subject over its motion."""
        if not self.moves:
            return None
        course: Course = self._in("plans", "course", f"{self.table.title()}Course")(solved)
        return course

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
