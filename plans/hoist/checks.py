"""What a hoist is judged by: whether its formulas are valid, and whether its rope is strong enough."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..check import AT_LEAST, MORE, Check
from .onesided import OneSided

ROPE_1, ROPE_2, SUPPORT, STRENGTH = ("rope_phase_1", "rope_phase_2", "support", "strength")


def valid(found: Mapping[str, Any]) -> Any:
    """Return whether the two-sided formulas are valid: the rope always pulls, the load does not come back."""
    return (found["F_12_min"] >= 0.0) & (found["P_12_min"] >= 0.0) & (found["s_min"] > 0.0)


def validity(found: Mapping[str, float], motion: OneSided | None) -> list[Check]:
    """Return the checks of the two-sided formulas: least forces of the rope in both phases, least height of the load.

    A value is what the formulas give as long as the checks before it hold, else that of the motion.
    """
    pulls = found["F_12_min"] >= 0.0
    checks = [_check(ROPE_1, "F_12_min", pulls, found["F_12_min"])]
    if pulls or motion is None:
        taut, least = found["P_12_min"] >= 0.0, found["P_12_min"]
    else:
        taut, least = not motion.slackens, motion.least_pull
    checks.append(_check(ROPE_2, "P_12_min", taut, least))
    if motion is None or (pulls and taut):
        stays, lowest = found["s_min"] > 0.0, found["s_min"]
    else:
        stays, lowest = not motion.returns, motion.lowest
    checks.append(_check(SUPPORT, "s_min", stays, lowest, MORE, "m"))
    return checks


def _check(name: str, quantity: str, ok: bool, value: float, relation: str = AT_LEAST, unit: str = "N") -> Check:
    return Check(name=name, ok=bool(ok), value=value, unit=unit, limit=0.0, relation=relation, quantity=quantity)


def strength(values: Mapping[str, float]) -> Check:
    """Return whether the rope is as safe as is required."""
    value, limit = values["safety"], values["K"]
    return Check(
        name=STRENGTH, ok=bool(value >= limit), value=value, unit="1", limit=limit, relation=AT_LEAST,
        quantity="safety", of="K",
    )  # fmt: skip
