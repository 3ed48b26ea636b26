"""Plans in double precision miss fifty digits by no more than data that err in their last places would.

|error| <= 4 eps (K + 1) times the size that K refers to (of what no plan shows its own magnitude): of every quantity,
over the cycle and on the way to every dead position, limit and change point from 0.1 down to 1e-9 rad.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from mpmath import mp

from kulman import solve
from kulman.plans.board import Program
from kulman.plans.boards.exact import run
from kulman.plans.boards.precision import DIGITS, fifty_digits
from kulman.plans.condition import derivatives, sizes_beside
from kulman.plans.laws import LAWS, TURN
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.cycles.limits import Reach, Swept, reach_of, swept
from kulman.plans.linkages.cycles.strokes import output_motions
from kulman.plans.linkages.solved import signs
from kulman.plans.quantities import results
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.mechanisms import one_of
from kulman.variants.shelf import bundled

EPS = 2.0**-52
MOST = 4.0
AWAY = tuple(10.0**-power for power in range(1, 10))
SAMPLE = ("nau-slider-crank", "scheme-11-slotter", "scheme-20-press-automaton")


@dataclass(frozen=True, slots=True)
class Task:
    """A mechanism ready to be moved through its cycle."""

    drive: Swept
    program: Program
    values: Mapping[str, Any]
    reach: Reach

    def givens(self, place: float) -> dict[str, float]:
        """Return what the board begins with, the driver being at a place."""
        there = self.drive.givens(self.values, np.array([place]))
        return {name: float(np.ravel(value)[0]) for name, value in there.items()}

    def cycle(self, count: int) -> list[float]:
        """Return places around the circle, or within the stretches that the driver can reach."""
        if self.drive.turns:
            return [self.drive.start + TURN * k / count for k in range(count)]
        return [s.low + (s.high - s.low) * (k + 0.5) / count for s in self.reach.stretches for k in range(count)]

    def special(self) -> list[float]:
        """Return dead positions of outputs, limits and change points."""
        dead = {dead.angle for motion in output_motions(self.drive, self.values, self.reach) for dead in motion.dead}
        return sorted(dead.union(self.reach.limits, self.reach.changes))


def task_of(name: str) -> Task:
    solved = solve(name).solved
    drive = swept(solved.mechanism, solved.givens)
    return Task(drive, construct(drive.mechanism)[1], solved.givens, reach_of(drive, solved.givens))


def ratios(task: Task, place: float) -> Iterator[tuple[float, str]]:
    """Go through all quantities of a position: error over what it may be, and the name.

    Left out are arms of forces that are zero but for rounding: these have no line.
    """
    givens = task.givens(place)
    board, right = run(task.program, givens), fifty_digits(task.program, givens)
    fixed = signs(task.drive.mechanism)
    slopes = derivatives(task.program, givens, [name for name, x in givens.items() if name not in fixed and x])
    sizes = sizes_beside(task.program, board.values)
    bounds: dict[str, float] = {}
    for step in results(task.program):
        value, name = board.values[step.name], step.name
        if step.verb == "arm" and is_none(step.operands[1], board.values, bounds):
            continue
        if value != value:
            assert board.trouble is not None, name
            continue
        bounds[name] = EPS * (float(np.abs(slopes[name]).sum()) + sizes[name])
        if step.law == "difference":  # in per cent: what both values may err by, beside the first of them
            beside = abs(board.values[step.operands[1]])
            bounds[name] += 100.0 * sum(map(bounds.__getitem__, step.operands)) / (beside + (beside == 0.0))
        with mp.workdps(DIGITS):
            error = float(abs(mp.mpmathify(value) - right[name]))
        assert error == error, name
        yield (error / bounds[name] if bounds[name] else math.inf if error else 0.0), name


def is_none(force: str, values: Mapping[str, Any], bounds: Mapping[str, float]) -> bool:
    """Whether a force, or the moment of a couple, is zero but for rounding."""
    return bool(abs(values[force]) <= MOST * bounds.get(force, 0.0))


def worst(task: Task, places: list[float]) -> tuple[float, str, float]:
    """Return the worst ratio of all quantities at some places, the quantity and the place."""
    found = [(*ratio, place) for place in places for ratio in ratios(task, place)]
    assert len(found) > len(places)
    return max(found)


@pytest.mark.parametrize("name", SAMPLE)
def test_plans_err_no_more_than_their_data_over_a_sample_of_the_cycle(name: str) -> None:
    task = task_of(name)
    dead = task.special()[0]

    assert worst(task, [*task.cycle(6), *(dead + away for away in (1e-2, -1e-5, 1e-9))])[0] <= MOST


@pytest.mark.soak
@pytest.mark.parametrize("name", sorted(bundled("mechanism")))
def test_plans_err_no_more_than_their_data(name: str) -> None:
    task = task_of(name)
    near = [place + away for place in task.special() for step in AWAY for away in (step, -step)]

    ratio, quantity, place = worst(task, [*task.cycle(72), *near])

    assert ratio <= MOST, (quantity, place)


DYADS: list[tuple[str, tuple[int, int], tuple[bool, ...]]] = [
    ("RRR", (2, 3), ()),
    ("RRP", (2, 3), (False,)),
    ("RRP", (2, 1), (True,)),
    ("RPR", (2, 3), (False,)),
    ("RPR", (2, 1), (True,)),
    ("PRP", (2, 3), (False, True)),
    ("RPP", (2, 3), (False, False)),
]


@pytest.mark.soak
@pytest.mark.parametrize(("kind", "before", "carries"), DYADS)
def test_dyads_err_no_more_than_their_data_beside_their_limits(
    kind: str, before: tuple[int, int], carries: tuple[bool, ...]
) -> None:
    mechanism, values, _ = random_dyads(kind, before, carries, seed=7, count=1)
    one = one_of(values, 0)
    drive = swept(mechanism, one)
    task = Task(drive, construct(drive.mechanism)[1], one, reach_of(drive, one))
    near = [place + away for place in task.reach.limits for step in AWAY for away in (step, -step)]

    ratio, quantity, place = worst(task, [drive.start, *near])

    assert ratio <= MOST, (quantity, place)


def test_a_plan_without_a_few_digits_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    task = task_of("nau-slider-crank")
    assert worst(task, [1.0])[0] <= MOST
    exact = LAWS["normal_part"]
    right = fifty_digits(task.program, task.givens(1.0))
    monkeypatch.setitem(globals(), "fifty_digits", lambda program, givens: right)

    monkeypatch.setitem(LAWS, "normal_part", lambda v, length: exact(v, length) * (1.0 + 2.0**-42))

    assert worst(task, [1.0])[0] > MOST
