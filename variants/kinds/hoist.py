"""Tasks about hoists: a table `[hoist]` with the sides of the beams that are the nearer ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ...plans.check import Check
from ...plans.hoist.hoist import DRAWN, PLANS, Hoist
from ...plans.names import role
from ...scales.choose import Choosers
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..checks.hoist import KNOWN, read_hoist
from ..task import Given, Task
from .kind import Kind, check_scales, first_of

if TYPE_CHECKING:
    from ...drawing.compose import Drawn
    from ...drawing.formats import Format
    from ...drawing.handouts import Shown
    from ...drawing.hoist.scene import HoistScene
    from ...drawing.notes.blocks import Story
    from ...drawing.pens import Norm
    from ...drawing.words import Words
    from ...plans.condition import Condition
    from ...plans.hands.hand import Tolerance
    from ...plans.hands.shaky import Paper
    from ...plans.hoist.solve import SolvedHoist
    from ...plans.marking.key import Question
    from ...plans.quantities import Quantity
    from ..case import Case
    from ..checks.basics import Checker
    from ..checks.names import Names

UNASKED = ("s_min", "t_P12_max")
RULES = {  # what is told of a check that fails
    "rope_phase_1": "hoist-rule-rope-phase-1",
    "rope_phase_2": "hoist-rule-rope-phase-2",
    "support": "hoist-rule-support",
    "strength": "hoist-rule-strength",
}
SYMBOLS = ("mu_l", "mu_F_circle")  # scale factors that may be chosen; those of the diagrams are found


class Hoists(Kind[Hoist, "SolvedHoist"]):
    """Loads that a rope takes off a beam, wound up on another beam."""

    table, plans = "hoist", PLANS
    choosing = tuple(KNOWN)

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Hoist | None:
        """Read `[hoist]`."""
        return read_hoist(checker, raw, names, givens)

    def fits(self, checker: Checker, subject: Hoist, head: Mapping[str, Any]) -> None:
        """Check that the scale factors are those that may be chosen."""
        check_scales(checker, head, SYMBOLS)

    def varies(self, checker: Checker, task: Task) -> None:
        """Check that every variant moves its load."""
        from ...plans.hoist.hoist import complete

        for row, variant in enumerate(task.variants):
            try:
                complete(task.values(variant))
            except InputError as error:
                checker.fault(("variant", row), error)

    def solve(
        self, subject: Hoist, values: Mapping[str, float], words: Mapping[str, str], plans: tuple[str, ...]
    ) -> SolvedHoist:
        """Solve a hoist.

        Raises
        ------
        InputError
            Numbers that no hoist can have.
        """
        from ...plans.hoist.solve import solve_hoist  # needs numpy

        return solve_hoist(subject.chosen(words), values, plans)

    def scale_symbols(self, solved: SolvedHoist) -> tuple[str, ...]:
        """Return the symbols of the scale factors that may be chosen."""
        return SYMBOLS

    def first_scales(
        self, solved: SolvedHoist, choosers: Choosers, plans: tuple[str, ...]
    ) -> tuple[Format, dict[str, Scale]]:
        """Return format and scale factors by plan: those of the diagrams are known before."""
        from ...drawing.hoist.ladders import first_scales

        return first_scales(solved, choosers, plans)

    def conditions(self, case: Case) -> dict[str, Condition]:
        """Return the condition of every quantity."""
        from ...plans.hoist.conditions import conditions_of  # needs numpy
        from ...plans.hoist.solve import SolvedHoist

        return conditions_of(SolvedHoist.of(case.solved))

    def warnings(self, solved: SolvedHoist) -> tuple[InputError, ...]:
        """Tell where the formulas are not valid, and of a rope that is not strong enough."""
        found = []
        for check in solved.forces.checks:
            if not check.ok:
                said = {"value": f"{check.value:.5g}", "limit": f"{check.limit:.5g}"}
                found.append(InputError(RULES[check.name], **said))
        return tuple(found)

    def checks(self, solved: SolvedHoist, quantities: Mapping[str, Quantity]) -> tuple[Check, ...]:
        """Return what formulas and rope are judged by: the compared value and its limit, SI.

        `rope_phase_1` and `rope_phase_2` are the least force of the rope, `support` is the least height of the lifted
        load, `strength` the safety beside the required one.
        """
        return solved.forces.checks

    def headings(self, solved: SolvedHoist, words: Words) -> dict[str, str]:
        """Return the headings of the sections of the note."""
        from ...plans.hoist.model import section_of

        first = first_of(solved.quantities, section_of)
        return {name: words[f"heading.hoist_{section}"] for section, name in first.items()}

    def asks(self, solved: SolvedHoist, question: Question) -> bool:
        """Ask for what is calculated rather than for what a drawing gives in its place, and for no check."""
        return role(question.name).part != DRAWN and question.name not in UNASKED

    def limits(self, drawn: SolvedHoist, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Let pass of the times that solve equations what is read off their drawings."""
        from ...plans.hoist.conditions import tolerances_of

        return tolerances_of(drawn, tolerance)

    def section(self, solved: SolvedHoist, question: Question, current: str) -> str:
        """Return the section of a question: that of the note."""
        from ...plans.hoist.model import section_of

        return section_of(question.name)

    def plan_heading(self, solved: SolvedHoist, plan: str, words: Words) -> str:
        """Return the heading of a section, or of a plan, as the sheet has it."""
        return words[f"heading.hoist_{plan}"]

    def fitted(self, solved: SolvedHoist, drawn: Drawn) -> tuple[SolvedHoist, tuple[InputError, ...]]:
        """Return the hoist with diagrams as small as the format has room for, and tell how small that is."""
        from ...plans.hoist.solve import reduced

        if drawn.reduction == 1.0:
            return solved, ()
        smaller = InputError("hoist-smaller", format=drawn.format, part=f"{drawn.reduction:g}")
        return reduced(solved, drawn.reduction), (smaller,)

    def lettered(self, words: Words, solved: SolvedHoist) -> Words:
        """Return the words with the letters of a hoist's quantities."""
        from ...drawing.hoist.scene import lettered

        return lettered(words, len(solved.layout.roots.times) if solved.layout.roots else 0)

    def begun(self, case: Case, scales: Mapping[str, Scale], words: Words, steps: int) -> Mapping[str, Shown]:
        """Show what the table of checks asks; drawings have stages."""
        from ...drawing.hoist.tables import begun

        return begun()

    def story(self, case: Case, scales: Mapping[str, Scale], words: Words, texts: Mapping[str, str]) -> Story:
        """Tell formulas with their numbers, and the drawings step by step."""
        from ...drawing.hoist.steps import story

        return story(self._scene(case, words), scales, texts)

    def _scene(self, case: Case, words: Words) -> HoistScene:
        """Return the hoist with its letters, for what is said of it: no scale factor counts there."""
        from ...drawing.formats import STYLES
        from ...drawing.hoist.scene import HoistScene

        solved = hoist(case.solved)
        return HoistScene(solved, self.lettered(words, solved), STYLES["A4"], case.givens, {})

    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a hoist."""
        from ...drawing.contents import SheetContents
        from ...drawing.hoist.sheet import HoistFitting

        note = case.task.note_in(words.language)
        contents = SheetContents(hoist(case.solved), case.plans, case.choosers, case.givens, words, norm, note=note)
        return HoistFitting(contents).draw(paper)


KIND = Hoists()


def hoist(solved: Any) -> SolvedHoist:
    """Return what has been solved as the hoist that it is."""
    from ...plans.hoist.solve import SolvedHoist

    return SolvedHoist.of(solved)
