"""Error against the scale of the drawing: the meshing drawn by hands at one scale after the other, and measured.

A hand errs by millimetres of paper, and by degrees: the larger the drawing, the less the former count, while the latter
do not change. That is why teeth are drawn five times as large as they are, and hardly ever larger.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ..hands.hand import Hand
from ..hands.shaky import draw, drawing_of
from ..hands.spread import kept
from .construction import MESHING
from .solve import DRAWN, SolvedGear, section_of

Array = NDArray[np.float64]
RATIOS = (1.0, 2.0, 2.5, 4.0, 5.0, 10.0, 20.0)  # millimetres of paper for one of the wheels, GOST 2.302
USUAL = ("epsilon_alpha_drawn", "epsilon_alpha_arc1", "c_1")
DRAWINGS, SEED = 400, 1
MILLI = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class ScaleErrors:
    """What 95 % of drawings keep, in parts of the exact value, by hand and quantity: one for each of the `ratios`."""

    exact: Mapping[str, float]  # the exact values, SI
    ratios: tuple[float, ...]  # scales of the meshing, M k : 1
    tooth: float  # depth of a tooth, m
    errors: Mapping[tuple[str, str], Array]  # by hand and quantity, in the order of `ratios`

    @property
    def quantities(self) -> tuple[str, ...]:
        """What is compared."""
        return tuple(self.exact)

    def enough(self, hand: str, quantity: str, part: float) -> float | None:
        """Return the smallest scale at which a hand misses by no more than a part; None where no scale does."""
        return next(
            (k for k, error in zip(self.ratios, self.errors[hand, quantity], strict=True) if error <= part), None
        )


def compared(solved: SolvedGear) -> tuple[str, ...]:
    """Return what can be compared: all that is measured on the meshing, or calculated from that."""
    return tuple(name for name in solved.program.names if name in solved.quantities and section_of(name) == DRAWN)


def scale_errors(
    solved: SolvedGear, hands: Mapping[str, Hand], quantities: Sequence[str] = (), ratios: Iterable[float] = RATIOS
) -> ScaleErrors:
    """Draw the meshing at one scale after the other, by hands of some names; `quantities` of `compared`, or the usual.

    Raises InputError with the key `chart-no-meshing` where the meshing is not among the plans.
    """
    if MESHING not in solved.scale_of_plan:
        raise InputError("chart-no-meshing")
    wanted, ratios = tuple(quantities) or USUAL, tuple(ratios)
    errors = {(hand, name): np.empty(len(ratios)) for hand in hands for name in wanted}
    for i, ratio in enumerate(ratios):
        paper = drawing_of(solved, dict.fromkeys(solved.scale_of_plan, MILLI / ratio))
        paper = replace(paper, program=paper.program.needed_for(wanted))
        for hand, own in hands.items():
            board = draw(paper, own, np.random.default_rng(SEED), DRAWINGS)
            for name in wanted:
                exact = solved.values[name]
                drawn = np.broadcast_to(board.values[name], board.codes.shape)
                errors[hand, name][i] = float(kept(drawn, exact)) / abs(exact)
    exact_values = {name: float(solved.values[name]) for name in wanted}
    return ScaleErrors(exact_values, ratios, solved.sizes["h"], errors)
