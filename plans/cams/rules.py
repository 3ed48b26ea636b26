"""The rules of good design of a cam for a roller: how large the roller may be, how small the transmission angles."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ..check import AT_LEAST, AT_MOST, Check
from .profile import OF_R_0, OF_RHO_MIN
from .solve import SolvedCam

ROUNDING = 1e-9  # part of a limit by which rounding may pass it


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule(Check):
    """A rule; its limit may be a `part` of the `size` of the quantity `of`, m."""

    part: float = 1.0
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
    ok = limit * (1.0 + ROUNDING) >= R
    return Rule(
        name=name, ok=ok, value=R, unit="m", limit=limit, relation=AT_MOST, quantity="R_roller", of=of,
        part=part, size=size,
    )  # fmt: skip


def _of_transmission(solved: SolvedCam) -> Iterator[Rule]:
    for name in ("gamma_rise", "gamma_fall"):
        quantity = f"{name}_min"
        least, permitted = float(solved.values[quantity]), float(solved.givens[name])
        ok = least >= permitted * (1.0 - ROUNDING)
        yield Rule(name=name, ok=ok, value=least, unit="rad", limit=permitted, relation=AT_LEAST, quantity=quantity)
