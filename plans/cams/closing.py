"""Closing diagrams that have been drawn: the velocity brought back to zero, then the travel.

What a hand draws does not close: at the end of a phase the velocity is not zero, after the fall the travel is not. The
closing error of the velocity may be distributed over its phase, that of the travel over the turn, in proportion to the
way along the axis; as the travel is the integral of the velocity, the first changes the travel, too.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .formulas import MM_PER_M
from .integration import ACCELERATION, TRAVEL, VELOCITY, Division
from .sectioned import ordinates
from .solve import SolvedCam

Array = NDArray[np.float64]
AS_DRAWN, SPEED, STROKE, BOTH = WAYS = ("drawn", "speed", "stroke", "both")  # what has been closed


def travel_errors(
    solved: SolvedCam, angles: Array, division: Division, values: Mapping[str, Any], *shape: int
) -> dict[str, Array]:
    """Return the errors of a drawn travel on its worst section line, in parts of the stroke, by what has been closed.

    Parameters
    ----------
    angles : array
        Section lines, rad.
    values : mapping
        The nodes that have been drawn, each a number or an array of `shape`.

    Returns
    -------
    dict of str to array of `shape`
        By `WAYS`; where the velocity is given there is none to be closed. The travel is scaled by its own stroke.
    """
    x = angles * (1.0 / (solved.givens["mu_phi"] * MM_PER_M))
    travel = ordinates(values, TRAVEL, division, *shape)
    closed = {AS_DRAWN: travel, STROKE: stroke_closed(travel, x)}
    if solved.layout.given == ACCELERATION:
        speed = ordinates(values, VELOCITY, division, *shape)
        closed[SPEED] = travel - drift(speed, x, division, solved.givens["H_v"])
        closed[BOTH] = stroke_closed(closed[SPEED], x)
    exact = _column(solved.motion.at(angles, -1)[0] * (1.0 / solved.motion.h), travel)
    found = {}
    for way in WAYS:
        if way in closed:
            scaled = closed[way] * (1.0 / closed[way][division.top])
            found[way] = np.max(np.abs(scaled - exact), axis=0)
    return found


def stroke_closed(travel: Array, x: Array) -> Array:
    """Return ordinates of the travel, shape (lines, ...), with the error at the last line distributed over the turn."""
    closed: Array = travel - _column(x / x[-1], travel) * travel[-1]
    return closed


def drift(speed: Array, x: Array, division: Division, pole_distance: float) -> Array:
    """Return by how much the travel falls when the velocity is brought back to zero at the ends of rise and fall.

    Parameters
    ----------
    speed : array of shape (lines, ...)
        Ordinates of the velocity on the section lines, m of paper.
    x : array of shape (lines,)
        Abscissas, m of paper.
    """
    column = _column(x, speed)
    top, leave, last = division.top, division.leave, division.last
    off = np.empty_like(speed)
    off[: top + 1] = speed[top] * (column[: top + 1] / x[top])
    part = (column[leave:] - x[leave]) / (x[last] - x[leave])
    off[leave:] = speed[leave] * (1.0 - part) + speed[last] * part
    areas = 0.5 * (off[1:] + off[:-1]) * np.diff(column, axis=0)
    found: Array = np.concatenate((np.zeros_like(speed[:1]), np.cumsum(areas, axis=0))) * (1.0 / pole_distance)
    return found


def _column(x: Array, beside: Array) -> Array:
    """Return numbers of section lines as a column beside ordinates of many drawings."""
    return x.reshape(-1, *(1,) * (beside.ndim - 1))
