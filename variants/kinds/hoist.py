"""Tasks about hoists: a table `[hoist]` with the sides of the beams that are the nearer ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, cast

from ...plans.hoist import hoist as hoists
from ...plans.names import role
from ...plans.solved import Check
from ...scales.errors import InputError
from ..case import Case, Kind

if TYPE_CHECKING:
    from ...drawing.tables import Row
    from ...drawing.view import View
    from ...drawing.words import Words
    from ...plans.hoist.solve import SolvedHoist
    from ...plans.marking.key import Question


class _Hoists(Kind[hoists.Hoist, "SolvedHoist"]):
    """Loads that a rope takes off a beam, wound up on another beam."""

    table, plans = "hoist", hoists.PLANS
    room, made, givens = "hoist", hoists.Hoist, hoists.GIVENS
    symbols = ("mu_l", "mu_F_circle")  # those of the diagrams are found
    unasked = ("s_min", "t_P12_max")
    unequal = True  # as many times of equation (12) as it has roots
    rules: ClassVar[Mapping[str, str]] = {  # where the formulas are not valid, or a rope is not strong enough
        "rope_phase_1": "hoist-rule-rope-phase-1",
        "rope_phase_2": "hoist-rule-rope-phase-2",
        "support": "hoist-rule-support",
        "strength": "hoist-rule-strength",
    }

    def impossible(self, values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
        """Say why no hoist has these numbers."""
        try:
            hoists.complete(values)
        except InputError as error:
            yield "", error

    def checks(self, solved: SolvedHoist) -> tuple[Check, ...]:
        """Return what formulas and rope are judged by: the compared value and its limit, SI.

        `rope_phase_1` and `rope_phase_2` are the least force of the rope, `support` is the least height of the lifted
        load, `strength` the safety beside the required one.
        """
        return solved.forces.checks

    def asks(self, solved: SolvedHoist, question: Question) -> bool:
        """Ask for what is calculated rather than for what a drawing gives in its place, and for no check."""
        return super().asks(solved, question) and role(question.name).part != hoists.DRAWN

    def pictured(self, case: Case, words: Words, part: float = 1.0) -> View:
        """Draw the scheme."""
        from ...drawing.hoist.scheme_view import picture
        from ...drawing.page import SCHEME as PICTURE

        _, scales = self.first_scales(cast("SolvedHoist", case.solved), case.choosers, case.plans)
        mus = {scale.symbol: scale.mu / part for scale in scales.values()}
        return replace(picture(replace(self.scene(case, scales, words), mus=mus)), name=PICTURE)

    def rows(self, case: Case, words: Words) -> Sequence[Row]:
        """Return the data in the units in which people know them."""
        from ...drawing.hoist.text import data_table

        return data_table(self.scene(case, {}, words), stated=True).rows[1:]


KIND = _Hoists()
