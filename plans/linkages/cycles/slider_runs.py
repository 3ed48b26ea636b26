"""How far sliders run along their guides while the driver goes through its cycle: guides are drawn at least so long."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...laws import TURN, dot
from ..bare import without_loads
from ..chain import constructed
from ..mechanism import FRAME, Driver, Prismatic
from ..solved import SolvedLinkage
from .swept import swept

Array = NDArray[Any]
POSITIONS = 72
SWAY = 0.3  # part of the mechanism's size by which a sliding driver is moved to and fro
LEAP = 0.12  # part of that size which no slider runs between two positions, unless the guides are nearly parallel

Runs = Mapping[str, tuple[float, float]]


def slider_runs(solved: SolvedLinkage) -> Runs:
    """Return for each guide how far the slider's point runs back (negative) and forth from its place now, metres."""
    pairs = [pair for pair in solved.mechanism.pairs if isinstance(pair, Prismatic)]
    if not pairs:
        return {}
    drive = swept(solved.mechanism, solved.givens)
    free = without_loads(drive.mechanism)
    _, program = constructed(free, ("position",))
    marks = {solved.guide_name(pair): (pair.point, _beside(solved, pair)) for pair in pairs}
    wanted = sorted({mark for u, (point, at) in marks.items() for mark in (u, point, at) if mark})
    steps = np.arange(-POSITIONS // 2, POSITIONS // 2 + 1) * (1.0 / POSITIONS)
    size = solved.extent
    whole = TURN if isinstance(solved.mechanism.driver, Driver) else 2.0 * SWAY * size
    places: Array = drive.start + steps * whole
    moved = drive.along(program, solved.givens, wanted, mechanism=free)(places)
    return {u: _run(_along(moved, u, point, at), LEAP * size) for u, (point, at) in marks.items()}


def _beside(solved: SolvedLinkage, pair: Prismatic) -> str:
    """Return a point of the guide's link, from which the slider's way is measured; "" on the frame."""
    number = pair.links[1]
    return "" if number == FRAME else next(iter(solved.mechanism.link(number).points))


def _along(moved: Mapping[str, Array], u: str, point: str, at: str) -> Array:
    """Return where the slider's point stands along the guide."""
    way = moved[point] - moved[at] if at else moved[point]
    along: Array = dot(way, moved[u])
    return along


def _run(along: Array, leap: float) -> tuple[float, float]:
    """Return how far it goes back and forth from the middle position, without a leap and while it can be assembled."""
    middle = len(along) // 2
    steps = np.abs(np.diff(along))
    stops = np.flatnonzero(~(steps < leap))
    first = int(max((k + 1 for k in stops if k < middle), default=0))
    last = int(min((k for k in stops if k >= middle), default=len(along) - 1))
    way = along[first : last + 1] - along[middle]
    return float(way.min()), float(way.max())
