"""What a hand misses over the cycle of a mechanism, to stand beside the methods of a computer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import POSITION, Program
from ...boards.exact import ExactBoard, run
from ...contest import Entry, Kind
from ...hands.hand import Hand
from ...hands.shaky import Paper, draw
from ...hands.spread import kept
from ...laws import TURN
from ...references import plans_of, references
from ..cycles.cycle import Cycle
from ..solved import SolvedLinkage
from .comparison import HAND, beside, one_of, places_of, summed

Array = NDArray[Any]
SEED = 1  # the same hand on every paper
NEAR_DEAD = 0.01  # part of the cycle
DRAWN, DRAWINGS = 12, 400  # positions that are drawn, how many times


@dataclass(frozen=True, slots=True)
class DrawnSheet:
    """The sheet of one position, `solved`, on a `paper`, with its scale factors by plan, SI per mm."""

    paper: str
    solved: SolvedLinkage
    mus: Mapping[str, float]


def by_hand(cycle: Cycle, sheet: DrawnSheet, hand: Hand, kinds: Iterable[Kind]) -> Iterator[Entry]:
    """Go through the errors that most drawings of a hand keep, kind by kind.

    The plans of every position are drawn as long as a sheet draws those of one.
    """
    places, kinds = _not_dead(cycle, places_of(cycle, DRAWN)), tuple(kinds)
    names = tuple(name for kind in kinds for name in kind.names)
    program, givens = cycle.program.needed_for(names), cycle.drive.givens(cycle.givens, places, cycle.program)
    runs = [run(cycle.program, one_of(givens, i)) for i in range(len(places))]
    column = {name: value[:, None] if np.ndim(value) else value for name, value in givens.items()}
    on_paper = Paper(program, column, _as_long(cycle.program, runs, sheet))
    board = draw(on_paper, hand, np.random.default_rng(SEED), (len(places), DRAWINGS))
    sizes = [references(cycle.program, one.values) for one in runs]
    errors = {}
    for name in names:
        exact = np.array([one.values[name] for one in runs])[:, None]
        drawings = np.broadcast_to(board.values[name], (len(places), DRAWINGS))
        size = beside(cycle, name, np.array([size[name] for size in sizes]))
        errors[name] = kept(drawings, exact) * (1.0 / size)
    for kind in kinds:
        yield summed(HAND, sheet.paper, kind, places, errors)


def _as_long(program: Program, runs: Iterable[ExactBoard], sheet: DrawnSheet) -> dict[str, float | Array]:
    """Return scale factors by plan at which the longest vectors are as long as those of the solved position."""
    solved, symbols = sheet.solved, sheet.solved.scale_of_plan
    own = _largest(solved.program, solved.values, symbols)
    each = [_largest(program, one.values, symbols) for one in runs]
    found: dict[str, float | Array] = {}
    for plan, mu in sheet.mus.items():
        symbol = symbols.get(plan, "")
        sizes = np.array([size.get(symbol, 0.0) for size in each])[:, None]
        drawn = own.get(symbol, 0.0) if plan != POSITION else 0.0
        found[plan] = np.where(sizes > 0.0, sizes * (mu / drawn), mu) if drawn > 0.0 else mu
    return found


def _largest(program: Program, values: Mapping[str, Any], symbols: Mapping[str, str]) -> dict[str, float]:
    """Return the largest vector that is drawn with each scale factor."""
    plans, largest = plans_of(program), dict[str, float]()
    for name, size in references(program, values).items():
        symbol = symbols.get(plans.get(name, ""))
        if symbol is not None:
            largest[symbol] = max(largest.get(symbol, 0.0), size)
    return largest


def _not_dead(cycle: Cycle, places: Array) -> Array:
    """Return the places that are off dead positions: a hand that errs there takes one stroke for the other."""
    near = NEAR_DEAD * abs(cycle.range.high - cycle.range.low)
    off = np.ones(len(places), bool)
    for dead in (dead for motion in cycle.motions for dead in motion.dead):
        away = places - dead.angle
        off &= np.abs(away - TURN * np.rint(away / TURN) if cycle.drive.turns else away) > near
    return places[off]
