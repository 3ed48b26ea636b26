"""Mechanisms for many tests: four-bars, slider-cranks (motion in closed form), presses with a group of class III."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from kulman.plans.linkages.limits import Reach, reach_of, swept
from kulman.plans.linkages.mechanism import (
    ZERO,
    Driver,
    Link,
    Load,
    Mechanism,
    Prismatic,
    SlidingDriver,
    Start,
    Stroke,
)
from kulman.tests.support.mechanisms import ORIGIN, bodies, pins

CRANK = Driver(1, "O", "A", "phi", "speed", "sense")


def four_bar(stroke: Stroke | None = None) -> Mechanism:
    """Crank OA, coupler AB, rocker CB, pivots O and C on the frame."""
    links = bodies("O A:l_OA", "A B:l_AB E:x_E,y_E", "C B:l_CB")
    return Mechanism(links, pins("O01@x_O,y_O A12 B23:side C03@x_C,y_C"), CRANK, stroke=stroke)


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
    guide = Prismatic("B", (3, 0), ORIGIN, "gamma", "e", "side")
    return Mechanism(bodies("O A:l_OA", "A B:l_AB E:x_E,y_E", "B"), (*pins("O01 A12 B23"), guide), CRANK, stroke=stroke)


def slider_crank_values(
    crank: float, rod: float, offset: float, side: float = 1.0, tilt: float = 0.0, sense: float = 1.0
) -> dict[str, float]:
    """Return values of a slider-crank whose guide has the direction `tilt`."""
    lengths = {"l_OA": crank, "l_AB": rod, "x_E": 0.4 * rod, "y_E": 0.3 * rod, "e": offset, "gamma": tilt}
    return {"phi": 0.3, "speed": 2.0, "sense": sense, "side": side, **lengths}


def piston_engine() -> Mechanism:
    """The slider-crank driven by its piston: slider 1 on a guide through O, rod 2, crank 3."""
    guide = Prismatic("B", (1, 0), ORIGIN, "gamma")
    driver = SlidingDriver(1, "B", "travel", "speed")
    return Mechanism(bodies("B", "B A:l_AB", "O A:l_OA"), (guide, *pins("B12 A23:side O03")), driver)


def press(C: str = "l_BC") -> Mechanism:
    """Return a press: crank, rod, a central link 3 with the joint C there, a rocker, and a rocker with a load."""
    central = f"B C:{C} D:x_D,y_D S3:x_S,y_S / S3 m_3 J_S3"
    return Mechanism(
        bodies("O A:l_OA", "A B:l_AB", central, "E C:l_EC", "F D:l_FD / D m_5"),
        pins("O01 A12 B23 C34 D35 E40@x_E,y_E F50@x_F,y_F"),
        Driver(1, "O", "A", "phi", "n_1", "sense_1"),
        (Load("F_5", 5, "D", "F_5", "alpha"),),
        starts=(Start(3, "x_0", "y_0", "angle_0", "phi_0"),),
    )


PRESS = press()
RAM = replace(  # the second rocker is a slider
    PRESS,
    links=(*PRESS.links[:4], Link(5, {"D": ORIGIN}, "D", "m_5")),
    pairs=(*PRESS.pairs[:6], Prismatic("D", (5, 0), ("x_G", ZERO), "up")),
)
PRESS_VALUES = {
    **{"phi": 0.7, "l_OA": 0.1, "l_AB": 0.4, "l_BC": 0.3, "x_D": 0.12, "y_D": 0.2, "l_EC": 0.35, "l_FD": 0.3},
    **{"x_E": 0.75, "y_E": -0.2, "x_F": 0.6, "y_F": 0.5, "n_1": 10.0, "sense_1": 1.0, "F_5": 300.0, "alpha": 1.3},
    **{"x_S": 0.1, "y_S": 0.08, "m_3": 2.0, "J_S3": 0.03, "m_5": 1.5, "x_G": 0.5, "up": math.pi / 2},
    **{"x_0": 0.46, "y_0": 0.1, "angle_0": 0.2, "phi_0": 0.5},
}


RAM_VALUES = {
    **PRESS_VALUES,
    **{"l_AB": 0.57, "l_BC": 0.266, "x_D": 0.084, "y_D": 0.324, "l_EC": 0.404, "x_G": 0.405},
    **{"x_0": 0.55, "y_0": 0.05, "angle_0": 1.74},
}


def two_presses() -> tuple[Mechanism, dict[str, float]]:
    """Return a press and a second triad, links 6 to 9, between its links 4 and 5 and the frame."""
    links = bodies(*[""] * 5, "C H:l_CH", "H I:l_HI K:x_K,y_K / K m_3 J_S3", "M I:l_MI", "N K:l_NK")[5:]
    pairs = pins("C46 H67 I78 K79 M80@x_M,y_M N90@x_N,y_N")
    second = Start(7, "x_1", "y_1", "angle_1", "phi_1")
    of = replace(PRESS, links=(*PRESS.links, *links), pairs=(*PRESS.pairs, *pairs), starts=(*PRESS.starts, second))
    own = {"l_CH": 0.366, "l_HI": 0.396, "x_K": 0.163, "y_K": 0.252, "l_MI": 0.387, "l_NK": 0.479, "x_M": 1.443}
    own |= {"y_M": -0.266, "x_N": 1.495, "y_N": 0.352, "x_1": 1.17, "y_1": -0.24, "angle_1": 0.61, "phi_1": 0.9}
    return of, {**PRESS_VALUES, **own}


# A parallelogram: the central link does not turn, B runs on a circle about a place G, as in a four-bar O A B G. Its
# crank goes as far as A B G come in line, at cos(phi) = (OA^2 + OG^2 - (AB + BG)^2) / (2 OA OG).
BENT = press("x_C,y_C")
SHIFTS = {"C": 0.05 + 0.1j, "D": 0.15 + 0.28j}
PARALLELOGRAM = {
    **{"l_OA": 0.1, "l_AB": 0.3, "l_EC": 0.25, "l_FD": 0.25, "x_0": 0.33, "y_0": 0.19, "angle_0": 0.0, "phi_0": 0.0},
    **{"x_C": SHIFTS["C"].real, "y_C": SHIFTS["C"].imag, "x_D": SHIFTS["D"].real, "y_D": SHIFTS["D"].imag},
    **{"x_E": 0.5 + SHIFTS["C"].real, "y_E": SHIFTS["C"].imag, "x_F": 0.5 + SHIFTS["D"].real, "y_F": SHIFTS["D"].imag},
}
DEAD = math.acos((0.01 + 0.25 - 0.55**2) / 0.1)


def _signs(random: np.random.Generator) -> tuple[float, float, float]:
    """Draw the side, the tilt and the sense of a mechanism."""
    side, sense = random.choice([-1.0, 1.0], 2)
    return float(side), random.uniform(-7, 7), float(sense)


def random_four_bars(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through four-bars of all kinds that have at least some reach, none near a change point."""
    random = np.random.default_rng(seed)
    while count:
        crank, coupler, rocker, frame = 10.0 ** random.uniform(-0.7, 0.3, 4)
        ends = [abs(coupler - rocker), coupler + rocker, abs(frame - crank), frame + crank]
        gaps = np.abs(np.subtract.outer(ends[:2], ends[2:])).min()
        if gaps >= 0.02 * max(ends) and frame + crank >= ends[0] and abs(frame - crank) <= ends[1]:
            yield four_bar_values(crank, coupler, rocker, frame, *_signs(random))
            count -= 1


def random_crank_rockers(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through four-bars whose crank turns round while the rocker swings (Grashof: the crank is the shortest)."""
    random = np.random.default_rng(seed)
    while count:
        crank = 10.0 ** random.uniform(-1.0, 0.0)
        coupler, rocker, frame = crank * random.uniform(1.1, 6.0, 3)
        longest = max(coupler, rocker, frame)
        if crank + longest <= 0.98 * (coupler + rocker + frame - longest):
            yield four_bar_values(crank, coupler, rocker, frame, *_signs(random))
            count -= 1


def random_slider_cranks(seed: int, count: int) -> Iterator[dict[str, float]]:
    """Go through slider-cranks whose cranks turn all the way round."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        crank = 10.0 ** random.uniform(-1.5, 0.5)
        offset = crank * random.uniform(-2.0, 2.0)
        rod = (crank + abs(offset)) * random.uniform(1.05, 4.0)
        yield slider_crank_values(crank, rod, offset, *_signs(random))


def reach(mechanism: Mechanism, values: Mapping[str, float]) -> Reach:
    return reach_of(swept(mechanism, values), values)
