"""The rules of good design of a cam for a roller: how large the roller may be, how small the transmission angles."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .profile import OF_R_0, OF_RHO_MIN
from .solve import SolvedCam

ROUNDING = 1e-9  # part of a limit by which rounding may pass it


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule, its value beside its limit, SI: at most this, or at least.

    Parameters
    ----------
    name : str
        As checks and warnings have it.
    value, limit : float
        m or rad.
    unit : str
        Of both.
    kept : bool
        Whether the value keeps its limit, rounding apart.
    part, of, size : float, str, float
        Of which size the limit is which part, where it is one.
    """

    name: str
    value: float
    limit: float
    unit: str
    kept: bool
    part: float = 1.0
    of: str = ""
    size: float = 0.0


def rules_of(solved: SolvedCam) -> tuple[Rule, ...]:
    """Return the rules for a cam with a roller, none for one with a plate alone.

    `roller_of_radius` and `roller_of_curvature` hold the roller against 0.4 r_0 and 0.7 rho_min, the latter where the
    pitch curve is convex anywhere; `gamma_rise` and `gamma_fall` the least transmission angles against those permitted.
    """
    found = solved.roller or solved.rocker
    if found is None:
        return ()
    profile, sizes = found.profile, found.sizes
    parts = (
        ("roller_of_radius", OF_R_0, "r_0", sizes.r_0),
        ("roller_of_curvature", OF_RHO_MIN, "rho_min", profile.rho_min),
    )
    rollers = (_of_roller(name, profile.R, part, of, size) for name, part, of, size in parts if math.isfinite(size))
    return (*rollers, *_of_transmission(solved))


def _of_roller(name: str, R: float, part: float, of: str, size: float) -> Rule:
    limit = part * size
    return Rule(name, R, limit, "m", limit * (1.0 + ROUNDING) >= R, part, of, size)


def _of_transmission(solved: SolvedCam) -> Iterator[Rule]:
    for name in ("gamma_rise", "gamma_fall"):
        least, permitted = float(solved.values[f"{name}_min"]), float(solved.givens[name])
        yield Rule(name, least, permitted, "rad", least >= permitted * (1.0 - ROUNDING))
