"""Tasks about gear pairs: a table `[gear]` with the pinion's sense and the material of the teeth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from ...plans.check import Check, rule_of
from ...plans.gears.gear import MATERIALS, MODULES, PLANS, ROTATIONS, SHIFTS, STANDARD, VALUES, GearPair, impossible
from ...scales.display import Display
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..checks.basics import Checker
from ..checks.names import Names, Number
from ..task import Bound, Given, Task
from .kind import Sized

if TYPE_CHECKING:
    from ...drawing.compose import Drawn
    from ...drawing.formats import Format
    from ...drawing.gears.scene import GearScene
    from ...drawing.handouts import Shown
    from ...drawing.notes.blocks import Story
    from ...drawing.pens import Norm
    from ...drawing.words import Words
    from ...plans.gears.solve import SolvedGear
    from ...plans.hands.hand import Tolerance
    from ...plans.hands.shaky import Paper
    from ...plans.marking.key import Question
    from ...plans.quantities import Quantity
    from ..case import Case

RULES = {  # checks that are told when they fail
    "undercut": "gear-rule-undercut",
    "interference": "gear-rule-interference",
    "contact_ratio": "gear-rule-contact",
    "contact_flanks": "gear-rule-flanks",
    "tip": "gear-rule-tip",
}
BROKEN = {"contact_ratio": "gear-rule-broken", "contact_flanks": "gear-rule-flanks-broken"}  # of less than one pair
IN_LENGTHS = ("interference", "tip")
NUMBERS = {
    "m": Number(),
    "z_1": Number(),
    "z_2": Number(),
    **dict.fromkeys(SHIFTS, Number(Bound.FREE, needed=False)),
    "a_w": Number(needed=False),
    **{name: Number(default=usual) for name, usual in STANDARD.items()},
    "c": Number(Bound.NOT_NEGATIVE, default=STANDARD["c"]),
}


class Gears(Sized[GearPair, "SolvedGear"]):
    """External pairs of involute spur gears cut by a standard rack."""

    table, plans = "gear", PLANS
    room, made, numbers, units = "gears", GearPair, NUMBERS, VALUES
    known: ClassVar[Mapping[str, tuple[str, ...]]] = {"rotation": ROTATIONS, "material": MATERIALS}
    choosing = tuple(known)
    symbols = ("mu_l",)  # the scale factors of the diagrams are found, or given
    judged = "heading.gear_checks"
    pages = 2  # the meshing at 5:1 fills one
    rows: ClassVar[Mapping[str, tuple[float, ...]]] = {"m": MODULES}
    display = Display(size="mm", angle="deg")
    instead = (
        (frozenset(("x_1", "x_2")), ("x_sum", "a_w")),
        (frozenset(("x_sum",)), ("x_1", "x_2", "a_w")),
        (frozenset(("a_w",)), ("x_1", "x_2", "x_sum")),
    )

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> GearPair | None:
        """Read `[gear]`; what of the rack is shifted must be said."""
        pair = super().read(checker, raw, names, givens)
        if {*SHIFTS}.intersection(names.dimensions):
            return pair
        checker.fault(("givens",), InputError("gear-shifts", given="-"))
        return None

    def varies(self, checker: Checker, task: Task) -> None:
        """Check that every variant is one of a pair."""
        told: set[str] = set()  # what is at fault in a default is so in every variant
        for row, variant in enumerate(task.variants.values()):
            for name, error in impossible(task.values(variant.id)):
                given = task.givens.get(name)
                if name in variant.values:
                    checker.fault(("variant", row, name), error)
                elif given is None or given.default is None:
                    checker.fault(("variant", row), error)
                elif name not in told:
                    told.add(name)
                    checker.fault(("givens", name, "default"), error)

    def solve(
        self, subject: GearPair, values: Mapping[str, float], words: Mapping[str, str], plans: tuple[str, ...]
    ) -> SolvedGear:
        """Solve a pair; numbers that belong to none are refused."""
        from ...plans.gears.solve import solve_gear

        return solve_gear(subject.chosen(words), values, plans)

    def warnings(self, solved: SolvedGear) -> tuple[InputError, ...]:
        """Tell which limits are not kept, and of teeth that are pointed."""
        found = []
        for check in solved.checks:
            rule, wheel = rule_of(check)
            if check.ok or rule not in RULES:
                continue
            if rule == "tip" and solved.meshing.teeth[int(wheel) - 1].pointed:
                found.append(InputError("gear-rule-pointed", wheel=wheel))
                continue
            said = _millimetres if rule in IN_LENGTHS else _plain
            key = BROKEN[rule] if rule in BROKEN and check.value < 1.0 else RULES[rule]
            found.append(InputError(key, value=said(check.value), limit=said(check.limit), wheel=wheel))
        return tuple(found)

    def checks(self, solved: SolvedGear, quantities: Mapping[str, Quantity]) -> tuple[Check, ...]:
        """Return what the pair is judged by: the compared value, its limit, how they have to stand, SI."""
        return solved.checks

    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a pair."""
        from ...drawing.gears.sheet import GearFitting

        return GearFitting(self.contents(case, words, norm)).draw(paper)

    def asks(self, solved: SolvedGear, question: Question) -> bool:
        """Ask not for what is given, nor for ordinates that are nothing or PW by construction."""
        return question.name not in solved.givens and question.step.operands != ("_zero",)

    def begun(self, case: Case, scales: Mapping[str, Scale], words: Words, steps: int) -> Mapping[str, Shown]:
        """Return what is drawn of the tables; drawings have stages."""
        from ...drawing.gears.text import begun

        return begun(self._scene(case, words))

    def story(self, case: Case, scales: Mapping[str, Scale], words: Words, texts: Mapping[str, str]) -> Story:
        """Tell the drawing step by step."""
        from ...drawing.gears.text import story

        return story(self._scene(case, words), scales, texts)

    def _scene(self, case: Case, words: Words) -> GearScene:
        """Return the pair with its letters, for what is said of it: no scale factor counts there."""
        from ...drawing.formats import STYLES
        from ...drawing.gears.scene import GearScene
        from ...plans.gears.solve import SolvedGear

        solved = SolvedGear.of(case.solved)
        return GearScene(solved, self.lettered(words, solved), STYLES["A4"], case.givens, 1.0, 1.0, 1.0)

    def limits(self, drawn: SolvedGear, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Let pass of angles what the errors of the marks they hang on add up to."""
        from ...plans.gears.solve import tolerances_of

        return tolerances_of(drawn, paper, tolerance)


KIND = Gears()


def _millimetres(length: float) -> str:
    return f"{length * 1e3:.4g}"


def _plain(value: float) -> str:
    return f"{value:.4g}"
