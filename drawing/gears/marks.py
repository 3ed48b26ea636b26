"""The named places of the line of action: N1, A1, P, A2, N2, with the points of the sliding table that stand there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...plans.gears.geometry import POINTS

# rho_1 of a place, its distance from N1: by the name of a quantity
PLACES = {"A1": "rho_p1", "P": "rho_w1", "A2": "rho_a1"}
NUMBERS = (
    "03",
    "06",
    "08",
)  # points of the table at the three places, in the order in which they liefrom ..words import indexed


def along(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the named places in their order on the line of action: their distances from N1, m.

    A1 and A2 lie between N1 and N2 in a pair without interference.
    """
    line = float(values["l_N1N2"])
    found = {"N1": 0.0, **{name: float(values[rho]) for name, rho in PLACES.items()}, "N2": line}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def marks(values: Mapping[str, Any]) -> dict[str, str]:
    """Return the points of the table that stand at the named places, by the names of these."""
    line = float(values["l_N1N2"])
    inner = sorted(PLACES, key=lambda name: min(max(float(values[PLACES[name]]), 0.0), line))
    return {"N1": POINTS[0], **dict(zip(inner, NUMBERS, strict=True)), "N2": POINTS[-1]}
