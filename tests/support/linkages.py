"""Small mechanisms whose motion is known in closed form: four-bars and slider-cranks in any place and orientation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from kulman.plans.linkages.cycles.limits import Reach, reach_of, swept
from kulman.plans.linkages.mechanism import (
    ZERO,
    Driver,
    Link,
    Mechanism,
    Prismatic,
    Revolute,
    SlidingDriver,
    Stroke,
)

ORIGIN = (ZERO, ZERO)
CRANK = Driver(1, "O", "A", "phi", "speed", "sense")


def four_bar(stroke: Stroke | None = None) -> Mechanism:
    """Crank OA, coupler AB, rocker CB, pivots O and C on the frame."""
    return Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "E": ("x_E", "y_E")}),
            Link(3, {"C": ORIGIN, "B": ("l_CB", ZERO)}),
        ),
        pairs=(
            Revolute("O", (0, 1), ("x_O", "y_O")),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3), branch="side"),
            Revolute("C", (0, 3), ("x_C", "y_C")),
        ),
        driver=CRANK,
        stroke=stroke,
    )


def four_bar_values(
    crank: float, coupler: float, rocker: float, frame: float, side: float = 1.0, tilt: float = 0.0, sense: float = 1.0
) -> dict[str, float]:
    """Return values of a four-bar whose frame OC is turned by `tilt`, O off the origin."""
    return {
        "phi": 0.3,
        "speed": 2.0,
        "sense": sense,
        "side": side,
        **{"l_OA": crank, "l_AB": coupler, "l_CB": rocker, "x_E": 0.4 * coupler, "y_E": 0.3 * coupler},
        **{"x_O": 0.7, "y_O": -0.2, "x_C": 0.7 + frame * math.cos(tilt), "y_C": -0.2 + frame * math.sin(tilt)},
    }


def slider_crank(stroke: Stroke | None = None) -> Mechanism:
    """Crank OA about the origin, rod AB, slider on a guide at the distance `e` to the left of O."""
    return Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "E": ("x_E", "y_E")}),
            Link(3, {"B": ORIGIN}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ORIGIN, "gamma", "e", "side"),
        ),
        driver=CRANK,
        stroke=stroke,
    )


def slider_crank_values(
    crank: float, rod: float, offset: float, side: float = 1.0, tilt: float = 0.0, sense: float = 1.0
) -> dict[str, float]:
    """Return values of a slider-crank whose guide has the direction `tilt`."""
    lengths = {"l_OA": crank, "l_AB": rod, "x_E": 0.4 * rod, "y_E": 0.3 * rod, "e": offset, "gamma": tilt}
    return {"phi": 0.3, "speed": 2.0, "sense": sense, "side": side, **lengths}


def piston_engine() -> Mechanism:
    """The slider-crank driven by its piston: slider 1 on a guide through O, rod 2, crank 3."""
    return Mechanism(
        links=(
            Link(1, {"B": ORIGIN}),
            Link(2, {"B": ORIGIN, "A": ("l_AB", ZERO)}),
            Link(3, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
        ),
        pairs=(
            Prismatic("B", (1, 0), ORIGIN, "gamma"),
            Revolute("B", (1, 2)),
            Revolute("A", (2, 3), branch="side"),
            Revolute("O", (0, 3), ORIGIN),
        ),
        driver=SlidingDriver(1, "B", "travel", "speed"),
    )


def random_four_bars(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through four-bars of all kinds that have at least some reach, none near a change point."""
    random = np.random.default_rng(seed)
    while count:
        crank, coupler, rocker, frame = 10.0 ** random.uniform(-0.7, 0.3, 4)
        ends = [abs(coupler - rocker), coupler + rocker, abs(frame - crank), frame + crank]
        gaps = np.abs(np.subtract.outer(ends[:2], ends[2:])).min()
        if gaps < 0.02 * max(ends) or frame + crank < ends[0] or abs(frame - crank) > ends[1]:
            continue
        side, sense = random.choice([-1.0, 1.0], 2)
        yield four_bar_values(crank, coupler, rocker, frame, float(side), random.uniform(-7, 7), float(sense))
        count -= 1


def random_crank_rockers(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through four-bars whose crank turns round while the rocker swings (Grashof: the crank is the shortest)."""
    random = np.random.default_rng(seed)
    while count:
        crank = 10.0 ** random.uniform(-1.0, 0.0)
        coupler, rocker, frame = crank * random.uniform(1.1, 6.0, 3)
        longest = max(coupler, rocker, frame)
        if crank + longest > 0.98 * (coupler + rocker + frame - longest):
            continue
        side, sense = random.choice([-1.0, 1.0], 2)
        yield four_bar_values(crank, coupler, rocker, frame, float(side), random.uniform(-7, 7), float(sense))
        count -= 1


def random_slider_cranks(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through slider-cranks whose cranks turn all the way round."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        crank = 10.0 ** random.uniform(-1.5, 0.5)
        offset = crank * random.uniform(-2.0, 2.0)
        rod = (crank + abs(offset)) * random.uniform(1.05, 4.0)
        side, sense = random.choice([-1.0, 1.0], 2)
        yield slider_crank_values(crank, rod, offset, float(side), random.uniform(-7, 7), float(sense))


def reach(mechanism: Mechanism, values: Mapping[str, float]) -> Reach:
    return reach_of(swept(mechanism, values), values)
