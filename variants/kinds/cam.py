"""Tasks about disk cams: a table `[cam]` with followers, laws of motion, senses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ...plans.cams.cam import PLANS, ROLLER, Cam
from ...scales.choose import Choosers, Fixed
from ...scales.names import unknown
from ...scales.scale import Scale
from ..checks.cam import impossible, read_cam, words_of
from ..task import Given, Task
from .kind import Kind, Verdicts

if TYPE_CHECKING:
    from ...drawing.formats import Format
    from ...drawing.page import Drawn
    from ...drawing.pens import Norm
    from ...drawing.titleblock import Stamp
    from ...drawing.words import Words
    from ...plans.cams.solve import SolvedCam
    from ...plans.quantities import Quantity
    from ..case import Case
    from ..checks.basics import Checker
    from ..checks.names import Names

SYMBOLS = ("mu_l",)  # the others follow from the drawn amplitude and the pole distances
MM = 1e-3
FULL_SIZE = 1e-3  # m/mm


class Cams(Kind[Cam, "SolvedCam"]):
    """Disk cams with translating roller and flat-faced followers, or with a rocker."""

    table, plans = "cam", PLANS

    def words(self, raw: object) -> frozenset[str]:
        """Return the words of `[cam]` that may be names of choices."""
        return words_of(raw)

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Cam | None:
        """Read `[cam]`."""
        return read_cam(checker, raw, names, givens)

    def fits(self, checker: Checker, subject: Cam, head: Mapping[str, Any]) -> None:
        """Check that the scale factors are those that may be chosen."""
        for name in head.get("scales", {}):
            if name not in SYMBOLS:
                checker.fault(("scales", name), unknown("scale-unknown", name, SYMBOLS, task=head.get("id", "")))

    def varies(self, checker: Checker, task: Task) -> None:
        """Check that every variant is one of a cam."""
        for row, variant in enumerate(task.variants):
            for error in impossible(task.values(variant)):
                checker.fault(("variant", row), error)

    def solve(
        self, subject: Cam, values: Mapping[str, float], words: Mapping[str, str], plans: tuple[str, ...]
    ) -> SolvedCam:
        """Solve a cam.

        Raises
        ------
        InputError
            Numbers that no cam can have: phases longer than a turn, a roller that leaves no cam.
        """
        from ...plans.cams.solve import solve_cam  # needs numpy

        for error in impossible(values):
            raise error
        solved = solve_cam(subject.chosen(words), {**values, "mu_phi": values["mu_phi"] * MM}, plans)
        size = solved.quantities.get("r_0")
        if ROLLER in subject.followers and size is not None and size.value is not None:
            for error in impossible({**values, "r_0": size.value}):
                raise error
        return solved

    def scale_symbols(self, solved: SolvedCam) -> tuple[str, ...]:
        """Return the symbols of the scale factors that may be chosen."""
        return SYMBOLS

    def first_scales(self, solved: SolvedCam, choosers: Choosers) -> dict[str, Scale]:
        """Return the scale factors by plan: those of the diagrams follow from the construction."""
        mu_l = choosers.get("mu_l", Fixed(FULL_SIZE)).ladder(lambda name: _size(solved))[0]
        values = {**solved.values, "mu_l": mu_l}
        return {plan: Scale(symbol, values[symbol], "m") for plan, symbol in solved.scale_of_plan.items()}

    def checks(self, solved: SolvedCam, quantities: Mapping[str, Quantity]) -> Verdicts:
        """Return what the rules of good design say."""
        return {}

    def draw(self, case: Case, words: Words, stamp: Stamp, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the sheet of a cam."""
        raise NotImplementedError


KIND = Cams()


def _size(solved: SolvedCam) -> float:
    """Return the greatest radius of the profiles, m."""
    found = (solved.quantities[name].value for name in ("r_0", "r_0_flat") if name in solved.quantities)
    return max(filter(None, found), default=0.0) + solved.motion.h
