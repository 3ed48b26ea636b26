"""What a hoist is judged by: whether its formulas are valid, and whether its rope is strong enough."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .onesided import OneSided

ROPE_1, ROPE_2, SUPPORT, STRENGTH = ("rope_phase_1", "rope_phase_2", "support", "strength")


@dataclass(frozen=True, slots=True)
class Check:
    """One check: a value that must not be below its limit.

    Of the first three the value is what the two-sided formulas give as long as those before it hold, else that of the
    motion: the least force of the rope in phase 1 and in phase 2, the least height of the lifted load.
    """

    name: str
    ok: bool
    value: float
    limit: float
    unit: str


def valid(found: Mapping[str, Any]) -> Any:
    """Return whether the two-sided formulas are valid: the rope always pulls, the load does not come back."""
    return (found["F_12_min"] >= 0.0) & (found["P_12_min"] >= 0.0) & (found["s_min"] > 0.0)


def validity(found: Mapping[str, float], motion: OneSided | None) -> list[Check]:
    """Return the checks of the two-sided formulas, from their quantities and, where they fail, from the motion."""
    pulls = found["F_12_min"] >= 0.0
    checks = [Check(ROPE_1, pulls, found["F_12_min"], 0.0, "N")]
    if pulls or motion is None:
        taut, least = found["P_12_min"] >= 0.0, found["P_12_min"]
    else:
        taut, least = not motion.slackens, motion.least_pull
    checks.append(Check(ROPE_2, taut, least, 0.0, "N"))
    if motion is None or (pulls and taut):
        stays, lowest = found["s_min"] > 0.0, found["s_min"]
    else:
        stays, lowest = not motion.returns, motion.lowest
    checks.append(Check(SUPPORT, stays, lowest, 0.0, "m"))
    return checks


def strength(values: Mapping[str, float]) -> Check:
    """Return whether the rope is as safe as is required."""
    return Check(STRENGTH, values["safety"] >= values["K"], values["safety"], values["K"], "")
