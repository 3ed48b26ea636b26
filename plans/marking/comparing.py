"""By how many tolerances an answer misses a value."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ..laws import cross, dot
from .answers import Said

SIZE, DIRECTION = "size", "direction"
NEVER = math.inf


class Miss(NamedTuple):
    """Tolerances by which an answer misses, one or less being right, and what does: size, or direction alone."""

    off: float
    about: str


def miss(said: Said, value: Any, allowed: float, angle: float = math.pi) -> Miss:
    """Return by how many tolerances `said` misses `value`; NEVER where that is undefined.

    Parameters
    ----------
    allowed : float
        What the size may miss, SI.
    angle : float
        What the direction of a vector may miss, radians.
    """
    if value != value:
        return Miss(NEVER, SIZE)
    if isinstance(value, complex):
        return _of_vector(said, value, allowed, angle)
    right = abs(said.size - abs(value)) if said.size is not None else 0.0
    off = ratio(right, allowed)
    if said.sign is None:
        return Miss(off, SIZE)
    turned = ratio(abs((abs(value) if said.size is None else said.size) * said.sign - value), allowed)
    return Miss(turned, DIRECTION if off <= 1.0 < turned else SIZE)


def _of_vector(said: Said, value: complex, allowed: float, angle: float) -> Miss:
    size = 0.0 if said.size is None else ratio(abs(said.size - abs(value)), allowed)
    if said.direction is None or abs(value) <= allowed:
        return Miss(size, SIZE)
    most = max(angle, math.asin(allowed / abs(value)))
    turned = abs(math.atan2(cross(value, said.direction), dot(value, said.direction))) / most
    return Miss(turned, DIRECTION) if size <= 1.0 < turned else Miss(max(size, turned), SIZE)


def ratio(missed: float, allowed: float) -> float:
    """Return a difference in tolerances; where nothing is allowed any difference is too much."""
    return missed / allowed if allowed else 0.0 if not missed else NEVER
