"""Tasks about gear pairs: a table `[gear]` with the pinion's sense and the material of the teeth."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from ...plans.gears.gear import GIVENS, PLANS, SHIFTS, GearPair, impossible
from ...plans.solved import Check
from ...scales.errors import InputError
from ...scales.scale import Display
from ..case import Case, Kind
from ..checks.basics import Checker
from ..checks.names import Names
from ..task import Given

if TYPE_CHECKING:
    from ...drawing.view import View
    from ...drawing.words import Words
    from ...plans.gears.solve import SolvedGear
    from ...plans.marking.key import Question

# checks that are told when they fail
RULES = {"undercut": "gear-rule-undercut", "interference": "gear-rule-interference", "tip": "gear-rule-tip"}
RULES |= {"contact_ratio": "gear-rule-contact", "contact_flanks": "gear-rule-flanks"}
BROKEN = {"contact_ratio": "gear-rule-broken", "contact_flanks": "gear-rule-flanks-broken"}  # of less than one pair
IN_LENGTHS = ("interference", "tip")


class _Gears(Kind[GearPair, "SolvedGear"]):
    """External pairs of involute spur gears cut by a standard rack."""

    table, plans = "gear", PLANS
    room, made, givens = "gears", GearPair, GIVENS
    symbols = ("mu_l",)  # the scale factors of the diagrams are found, or given
    judged = "heading.gear_checks"
    pages = 2  # the meshing at 5:1 fills one
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

    def impossible(self, values: Mapping[str, float]) -> Iterable[tuple[str, InputError]]:
        """Go through what no pair can have."""
        return impossible(values)

    def warnings(self, solved: SolvedGear) -> tuple[InputError, ...]:
        """Tell which limits are not kept, and of teeth that are pointed."""
        from ...plans.gears.solve import rule_of  # needs numpy

        found = []
        for check in solved.checks:
            rule, wheel = rule_of(check)
            if check.ok or rule not in RULES:
                continue
            if rule == "tip" and solved.meshing.teeth[int(wheel) - 1].pointed:
                found.append(InputError("gear-rule-pointed", wheel=wheel))
                continue
            times = 1e3 if rule in IN_LENGTHS else 1.0  # in millimetres
            said = {"value": f"{check.value * times:.4g}", "limit": f"{check.limit * times:.4g}", "wheel": wheel}
            found.append(InputError(BROKEN[rule] if rule in BROKEN and check.value < 1.0 else RULES[rule], **said))
        return tuple(found)

    def checks(self, solved: SolvedGear) -> tuple[Check, ...]:
        """Return what the pair is judged by: the compared value, its limit, how they have to stand, SI."""
        return solved.checks

    def asks(self, solved: SolvedGear, question: Question) -> bool:
        """Ask not for what is given, nor for ordinates that are nothing or PW by construction."""
        return super().asks(solved, question) and question.step.operands != ("_zero",)

    def pictured(self, case: Case, words: Words, part: float = 1.0) -> View:
        """Draw both wheels."""
        from ...drawing.gears.meshing_view import SCHEME, pair_view

        scene = self.scene(case, {}, words)
        return pair_view(replace(scene, mu_l=scene.size("a_w") / (part * SCHEME)))


KIND = _Gears()
