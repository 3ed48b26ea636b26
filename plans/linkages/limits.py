"""Limiting angles of the driver: how far it can turn from a position before the mechanism comes apart."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..exact import run
from .chain import construct
from .mechanism import Mechanism

STEPS = 360
HALVINGS = 45


def limiting_angles(mechanism: Mechanism, values: Mapping[str, float]) -> tuple[float, float] | None:
    """Return the angles of the driver, below and above the given one, from which on the mechanism can be assembled.

    Found on a grid of one degree, then halved: an arc shorter than that is not seen.

    Returns
    -------
    tuple of float or None
        Radians, within one turn of the given angle; None when no position of the driver can be assembled.
    """
    _, program = construct(mechanism, ("position",))
    angle = mechanism.driver.angle
    start = values[angle]

    def stands(at: float) -> bool:
        return run(program, {**values, angle: at}).status != "no-assembly"

    found = []
    for sense in (-1.0, 1.0):
        step = sense * 2.0 * math.pi / STEPS
        first = next((k for k in range(1, STEPS) if stands(start + k * step)), None)
        if first is None:
            return None
        apart, whole = start + (first - 1) * step, start + first * step
        for _ in range(HALVINGS):
            middle = 0.5 * (apart + whole)
            apart, whole = (apart, middle) if stands(middle) else (middle, whole)
        found.append(whole)
    return found[0], found[1]
