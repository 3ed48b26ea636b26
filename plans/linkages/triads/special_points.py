"""Which two legs of a triad make its special point: those whose lines, and whose point with the third leg, meet best.

Any two will do, but where two legs are nearly parallel their lines meet far away, and where the special point stands in
the joint of the third leg nothing turns about it. The choice is data of the construction: `Start.legs`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import Program, RecordingBoard
from ...boards.batch import batch
from ...boards.exact import ILL, SMALL, run
from ..chain import construct, named_groups
from ..legs import Leg
from ..mechanism import Mechanism
from .following import followed
from .triad import Triad

Array = NDArray[Any]
Legs = tuple[int, int]


def with_special_points(
    mechanism: Mechanism,
    values: Mapping[str, Any],
    near: Mapping[str, Any] | None = None,
    enough: float = SMALL,
    first: Mapping[int, Legs | None] | None = None,
) -> Mechanism:
    """Return the mechanism with two legs chosen for the special point of every triad whose task names none.

    Parameters
    ----------
    values : mapping of str to float or float64 array of shape (N,)
        Its numbers in SI, for one position or for many: of these the worst one counts.
    near : mapping, optional
        What `following.followed` gives for them, where it is known already.
    enough : float
        The first two legs whose sines are nowhere below are taken, so that one position is constructed like another;
        without such ones the best two.
    first : mapping of int to pair of int, optional
        By the number of the central link two legs that are taken where their lines meet everywhere, however flatly.
    """
    for number, (pairs, sines) in _sines(mechanism, values, near).items():
        worst = sines.min(axis=1)
        legs = pairs[int(np.argmax(np.minimum(worst, enough)))]
        wanted = (first or {}).get(number)
        keeps = wanted is not None and worst[pairs.index(wanted)] >= ILL
        mechanism = _choose(mechanism, number, wanted if keeps and wanted else legs)
    return mechanism


def _choose(mechanism: Mechanism, number: int, legs: Legs) -> Mechanism:
    starts = tuple(replace(start, legs=legs) if start.link == number else start for start in mechanism.starts)
    return replace(mechanism, starts=starts)


def _sines(
    mechanism: Mechanism, values: Mapping[str, Any], near: Mapping[str, Any] | None
) -> dict[int, tuple[list[Legs], Array]]:
    """Return for each triad without named legs the pairs of its legs, and the worse sine of each, shape (3, N).

    Where the mechanism cannot be assembled all are one.
    """
    if not any(start.legs is None for start in mechanism.starts):
        return {}
    free = mechanism.without_loads
    triads = [group for group in named_groups(free) if isinstance(group, Triad)]
    board, named = RecordingBoard(), {}
    for triad in triads:
        start = mechanism.start(triad.central.number)
        if start is not None and start.legs is None:
            named[triad.central.number] = dict(_pairs(board, triad))
    if not named:
        return {}
    _, position = construct(free, ("position",))
    program = Program((*position.steps, *board.steps))
    wanted = [name for pairs in named.values() for names in pairs.values() for name in names]
    found = _run(program.needed_for(wanted), {**values, **(near or followed(mechanism, values))}, wanted)
    return {number: (list(pairs), _rows(found, pairs.values())) for number, pairs in named.items()}


def _rows(found: Mapping[str, Any], pairs: Iterable[tuple[str, str]]) -> Array:
    rows = np.stack([np.min([np.atleast_1d(np.abs(found[name])) for name in names], axis=0) for names in pairs])
    apart = np.isnan(rows).all(axis=0)
    return np.where(apart, 1.0, np.nan_to_num(rows, nan=0.0))


def _run(program: Program, values: Mapping[str, Any], wanted: list[str]) -> Mapping[str, Any]:
    needs = program.needs
    values = {name: value for name, value in values.items() if name in needs}
    if any(np.ndim(value) for value in values.values()):
        return batch(program, values, wanted)[0]
    return run(program, values).values


def _pairs(board: RecordingBoard, triad: Triad) -> Iterable[tuple[Legs, tuple[str, str]]]:
    """Record the sines of every two legs: of their lines, and of the third line with the way to the special point."""
    board.pole("_nowhere")
    for first, second in combinations(triad.by_number, 2):
        third = next(leg for leg in triad.legs if leg not in (first, second))
        yield (first.number, second.number), _sines_of(board, first, second, third)


def _sines_of(board: RecordingBoard, first: Leg, second: Leg, third: Leg) -> tuple[str, str]:
    key = f"{first.number}_{second.number}"
    board.meet(f"_X_{key}", first.start, first.line, second.start, second.line)
    board.distance(f"_l_{key}", f"_X_{key}", third.end)
    board.calc(f"_sine_{key}", "across_axis", first.line, "_nowhere", second.line)
    # the normals to both meet like the lines themselves
    board.calc(f"_across_{key}", "across_axis", third.line, f"_X_{key}", third.end)
    board.calc(f"_sine_D_{key}", "part_of", f"_across_{key}", f"_l_{key}")
    return f"_sine_{key}", f"_sine_D_{key}"
