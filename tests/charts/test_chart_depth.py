"""Depth of the model: what is left out costs what it is worth, nothing costs nothing, everything costs all."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from kulman.plans.lab.stability import (
    ALL,
    FORCES,
    INERTIA,
    MOMENTS,
    WEIGHTS,
    Model,
    depth,
    parts_of,
    without,
)
from kulman.plans.linkages.cycles.cycle import Cycle, cycle
from kulman.scales.errors import InputError
from kulman.variants.reader import load_task

TASKS = ["nau-slider-crank", "madi-four-bar", "scheme-09-shaper", "scheme-14-jaw-crusher"]


@cache
def of_task(name: str) -> Cycle:
    task = load_task(name)
    return cycle(task.mechanism, task.values(None, {}), task.plans, 36)


@pytest.mark.parametrize("name", TASKS)
def test_leaving_out_nothing_costs_nothing(name: str) -> None:
    cost = Model(of_task(name)).cost("", ())

    assert (cost.balance, cost.reaction, cost.balance_rms, cost.reaction_rms) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", TASKS)
def test_leaving_out_everything_costs_everything(name: str) -> None:
    whole = of_task(name)
    loads = [load.name for load in whole.mechanism.acting]

    cost = Model(whole).cost("", [*parts_of(whole.program), *loads])

    assert cost.balance == pytest.approx(100.0, rel=1e-9)
    assert cost.reaction == pytest.approx(100.0, rel=1e-9)


@pytest.mark.parametrize("name", TASKS)
def test_costs_are_those_of_a_mechanism_without_that_mass(name: str) -> None:
    whole = of_task(name)
    model = Model(whole)
    task = load_task(name)
    mass = next(link.mass for link in whole.mechanism.links[::-1] if link.mass in task.values(None, {}))
    link = next(link for link in whole.mechanism.links if link.mass == mass)
    values = {**whole.givens, mass: 0.0}

    lighter = cycle(task.mechanism, values, task.plans, 36)
    parts = [part for part in parts_of(whole.program) if part in (f"F_i{link.number}", f"G_{link.number}")]

    change = np.nanmax(np.abs(lighter.values[model.balance] - whole.values[model.balance]))
    assert parts
    assert model.cost("", parts).balance == pytest.approx(change / model.largest * 100.0, rel=1e-9, abs=1e-9)


def test_simplifications_of_a_shaper() -> None:
    found = depth(of_task("scheme-09-shaper"), 1.0)

    keys = [cost.key for cost in found.costs]
    assert keys[:8] == ["F_i3", "G_3", "M_i3", "F_i4", "G_4", "M_i4", "F_i5", "G_5"]
    assert keys[8:] == [FORCES, MOMENTS, WEIGHTS, INERTIA, ALL]
    costs = {cost.key: cost for cost in found.costs}
    assert costs["G_5"].balance < 1e-9  # the ram moves level: its weight does no work
    assert (costs["G_5"].reaction or 0.0) > 5.0  # but its guide bears it
    assert all(cost.balance_rms <= cost.balance for cost in found.costs)


def test_all_inertia_is_listed_once_where_there_is_no_weight() -> None:
    keys = [cost.key for cost in depth(of_task("madi-four-bar"), 1.0).costs]

    assert INERTIA in keys
    assert ALL not in keys
    assert WEIGHTS not in keys


@pytest.mark.parametrize("tolerance", [0.0, 5.0, 200.0, pytest.param(0.5, marks=pytest.mark.soak)])
def test_what_may_go_costs_less_than_the_tolerance(tolerance: float) -> None:
    whole = of_task("scheme-09-shaper")
    found = depth(whole, tolerance)

    assert {*found.needed, *found.spare} == set(parts_of(whole.program))
    assert not {*found.needed} & {*found.spare}
    assert Model(whole).cost("", found.spare).worst <= tolerance
    assert bool(found.needed) == (tolerance < 100.0)


def test_a_part_is_left_out_by_a_rewrite_of_its_own_step() -> None:
    program = of_task("nau-slider-crank").program

    rewritten = without(program, ["F_i2"])

    changed = [(a, b) for a, b in zip(program, rewritten, strict=True) if a != b]
    assert [(a.name, b.operands[0]) for a, b in changed] == [("F_i2", "zero")]


def test_without_forces_there_is_no_depth() -> None:
    task = load_task("nau-slider-crank")
    whole = cycle(task.mechanism, task.values(None, {}), ("acceleration",), 12)

    with pytest.raises(InputError, match="needs the plan of forces"):
        depth(whole, 1.0)


def test_the_lever_alone_gives_the_balance() -> None:
    task = load_task("nau-slider-crank")
    whole = cycle(task.mechanism, task.values(None, {}), ("lever",), 12)

    found = depth(whole, 1.0)

    assert found.balance == "M_bal_lever"
    assert found.reaction is None
    assert all(cost.reaction is None for cost in found.costs)
