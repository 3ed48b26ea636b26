"""How far sliders run along their guides while the driver goes through its cycle: guides are drawn at least so long."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ...plans.batch import batch
from ...plans.board import Program
from ...plans.linkages.chain import construct
from ...plans.linkages.mechanism import FRAME, Driver, Prismatic
from ...plans.linkages.solved import Solved

POSITIONS = 72
SWAY = 0.3  # part of the mechanism's size by which a sliding driver is moved to and fro
LEAP = 0.12  # part of that size which no slider runs between two positions, unless the guides are nearly parallel

Reach = Mapping[str, tuple[float, float]]


def guide_name(solved: Solved, pair: Prismatic) -> str:
    """Return the name of the direction of a pair's guide."""
    a, b = pair.links
    return next(name for name in (f"u_{a}{b}", f"u_{b}{a}") if name in solved.values)


def reaches(solved: Solved) -> Reach:
    """Return for each guide how far the slider's point runs back (negative) and forth from its place now, metres."""
    pairs = [pair for pair in solved.mechanism.pairs if isinstance(pair, Prismatic)]
    if not pairs:
        return {}
    _, program = construct(solved.mechanism, ("position",))
    angle, angles = _cycle(solved)
    values = {name: value for name, value in solved.values.items() if isinstance(value, float)}
    wanted = {guide_name(solved, pair): (pair.point, _beside(solved, pair)) for pair in pairs}
    marks = sorted({mark for u, (P, at) in wanted.items() for mark in (u, P, at) if mark} & set(program.names))
    moved = _moved(program, {**values, angle: angles}, marks)
    found = {}
    for u, (P, at) in wanted.items():
        found[u] = _range(_along(moved, u, P, at), LEAP * _size(solved))
    return found


def _moved(program: Program, givens: Mapping[str, object], marks: list[str]) -> dict[str, NDArray[np.complex128]]:
    return batch(program, givens, marks)[0]


def _cycle(solved: Solved) -> tuple[str, NDArray[np.float64]]:
    """Return what the driver's position is called, and its values through the cycle."""
    driver, steps = solved.mechanism.driver, np.arange(-POSITIONS // 2, POSITIONS // 2 + 1)
    if isinstance(driver, Driver):
        return driver.angle, solved.values[driver.angle] + steps * (2 * math.pi / POSITIONS)
    return driver.travel, solved.values[driver.travel] + steps * (2 * SWAY * _size(solved) / POSITIONS)


def _size(solved: Solved) -> float:
    """Return the longest distance between lettered points of the links, m."""
    places = [solved.point(point) for link in solved.mechanism.links for point in link.points]
    return max(abs(a - b) for a in places for b in places)


def _beside(solved: Solved, pair: Prismatic) -> str:
    """Return a point of the guide's link, from which the slider's way is measured; "" on the frame."""
    number = pair.links[1]
    return "" if number == FRAME else next(iter(solved.mechanism.link(number).points))


def _along(moved: Mapping[str, NDArray[np.complex128]], u: str, P: str, at: str) -> NDArray[np.float64]:
    """Return where P stands along the guide."""
    way = moved[P] - moved[at] if at else moved[P]
    result: NDArray[np.float64] = (way * np.conj(moved[u])).real
    return result


def _range(along: NDArray[np.float64], leap: float) -> tuple[float, float]:
    """Return how far it goes back and forth from the middle position, without a leap and while it can be assembled."""
    middle = len(along) // 2
    steps = np.abs(np.diff(along))
    stops = np.flatnonzero(~(steps < leap))
    first = int(max((k + 1 for k in stops if k < middle), default=0))
    last = int(min((k for k in stops if k >= middle), default=len(along) - 1))
    way = along[first : last + 1] - along[middle]
    return float(way.min()), float(way.max())
