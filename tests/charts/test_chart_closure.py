"""Newton's method on closed contours beside plans: another route to the same motion, whose error its tolerance sets."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.exact import run
from kulman.plans.lab.contours import Contours
from kulman.plans.lab.linkages import Rivals, kinds_of, places_of
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.cycles.cycle import Cycle, cycle
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.linkages import (
    four_bar,
    piston_engine,
    random_crank_rockers,
    random_slider_cranks,
    slider_crank,
)
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

MOTION = ("velocity", "acceleration")
PLANS = ("position", *MOTION)
TOLERANCES = (1e-1, 1e-2, 1e-4, 1e-8)


def of_task(name: str, positions: int = 12) -> Cycle:
    task = load_task(name)
    return cycle(task.mechanism, task.values(None, {}), PLANS, positions)


def differences(found: Any, exact: Any) -> float:
    """Return the largest difference of quantities, in parts of the largest value of each kind."""
    sizes: dict[str, float] = {}
    for name, values in exact.items():
        kind = name.partition("_")[0]
        sizes[kind] = max(sizes.get(kind, 0.0), float(np.nanmax(np.abs(values))))
    return max(float(np.nanmax(np.abs(found[n] - x))) / (sizes[n.partition("_")[0]] or 1.0) for n, x in exact.items())


def both(whole: Cycle, tolerance: float) -> tuple[Any, Any]:
    """Return motion by Newton's method and by plans, half a step off the ends of the cycle."""
    rivals, places = Rivals(whole), places_of(whole, 24)
    names = [name for kind in kinds_of(whole) if kind.name in MOTION for name in kind.names]
    return rivals.newton(tolerance, places, names), rivals.plan(places, names)


FEW = (  # every kind of dyad, and a slide that drives
    *("madi-four-bar", "nau-slider-crank", "scheme-09-shaper", "scheme-10-shaper-two-blocks"),
    *("scheme-18-hydraulic-drive", "scheme-19-scotch-yoke"),
)


@pytest.mark.parametrize(
    "name", [name if name in FEW else pytest.param(name, marks=[pytest.mark.soak]) for name in bundled("mechanism")]
)
def test_newton_agrees_with_plans(name: str) -> None:
    found, exact = both(of_task(name), 1e-9)

    assert any(name.startswith("a_") for name in exact)
    assert differences(found, exact) < 1e-8


@pytest.mark.parametrize(
    ("mechanism", "values"),
    [
        *((four_bar(), values) for values in random_crank_rockers(11, 8)),
        *((slider_crank(), values) for values in random_slider_cranks(12, 8)),
    ],
)
def test_newton_agrees_with_plans_of_random_mechanisms(mechanism: Mechanism, values: dict[str, float]) -> None:
    found, exact = both(cycle(mechanism, values, PLANS), 1e-9)

    assert differences(found, exact) < 1e-9


@pytest.mark.parametrize(
    ("kind", "carries"),
    [
        *(("RRR", ()), ("RRP", (False,)), ("RRP", (True,)), ("RPR", (False,)), ("RPR", (True,))),
        *(("PRP", (False, True)), ("PRP", (True, True)), ("RPP", (True, False)), ("RPP", (True, True))),
    ],
)
def test_newton_agrees_with_plans_of_dyads_on_links_that_move(kind: str, carries: tuple[bool, ...]) -> None:
    mechanism, values, places = random_dyads(kind, (2, 3), carries, seed=5, count=4)
    _, program = construct(mechanism, PLANS)
    for i in range(len(places)):
        own = {name: float(np.broadcast_to(value, len(places))[i]) for name, value in values.items()}
        exact = run(program, board_givens(mechanism, own)).values
        contours = Contours(mechanism, own)
        at = np.array([own[mechanism.driver.coordinate]])
        points = {point: np.array([exact[point]]) for link in mechanism.links for point in link.points}
        turns = {link.number: np.exp(1j * places[i, k, 2:]) for k, link in enumerate(mechanism.links)}
        near = contours.pose(turns)
        near[: contours.count] += 1e-3
        pose = contours.solve(near, at, 1e-6)
        speed = exact[f"omega_{mechanism.driver.link}"]
        rates = contours.rates(pose, speed)
        epsilon = exact.get(f"epsilon_{mechanism.driver.link}", 0.0)
        changes = contours.changes(pose, rates, epsilon)

        moving = [point for point in points if f"a_{point}" in exact]
        most = max(abs(exact[f"a_{point}"]) for point in moving)
        for point in moving:
            form = contours.point(point)
            assert abs(contours.value(form, pose)[0] - exact[point]) < 1e-8
            assert abs(contours.change(form, pose, rates, changes)[0] - exact[f"a_{point}"]) < 1e-6 * most


def test_newton_takes_a_driver_that_slides_and_speeds_up() -> None:
    from dataclasses import replace

    driven = piston_engine()
    driven = replace(driven, driver=replace(driven.driver, acceleration="a"))
    values = {"gamma": 0.3, "l_AB": 0.5, "l_OA": 0.2, "side": 1.0, "travel": 0.55, "speed": 2.0, "a": 3.0}
    found, exact = both(cycle(driven, values, PLANS, start=0.45, end=0.6), 1e-9)

    assert differences(found, exact) < 1e-10


def test_error_falls_with_the_tolerance() -> None:
    whole = of_task("madi-four-bar")
    errors = [differences(*both(whole, tolerance)) for tolerance in TOLERANCES]

    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 1e-6
    assert errors[-1] < 1e-13


def test_what_newton_does_not_find_is_not_a_number() -> None:
    whole = of_task("madi-four-bar")
    places = places_of(whole, 24)
    rivals = Rivals(whole)

    found = rivals.newton(0.0, places, ("V_C",))["V_C"]

    assert np.isnan(found).all()


def test_contours_are_no_more_than_loops() -> None:
    whole = of_task("scheme-09-shaper")
    contours = Rivals(whole).contours

    assert len(contours.closed) == 2
    assert contours.count == 4  # frame and slide, crank, lever and block, rod
