"""What a solution is judged by: a value beside its limit, how they have to stand, and whether they do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .names import role

# how a value has to stand to its limit; within: by its magnitude
AT_LEAST, MORE, AT_MOST, EQUAL, WITHIN = ("at-least", "more-than", "at-most", "equal", "within")
SIGNS = {AT_LEAST: "≥", MORE: ">", AT_MOST: "≤", EQUAL: "=", WITHIN: "∈ ±"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """A rule of good design, a condition of validity, or a second route beside the first; in SI."""

    name: str  # what is looked at: `undercut_1`, `strength`, `lever`
    ok: bool  # whether the value stands as it has to; what is undefined does not
    value: float
    limit: float
    relation: str  # how the value has to stand to its limit, one of `SIGNS`
    unit: str  # of both
    quantity: str = ""  # the quantity that is compared, where it is one
    of: str = ""  # the quantity that the limit is, or is a part of, if one

    @property
    def sign(self) -> str:
        """The relation as a sign."""
        return SIGNS[self.relation]

    def to_json(self) -> dict[str, Any]:
        """Return what is said of the check, for JSON; its name is the key."""
        compared = {"quantity": self.quantity} if self.quantity else {}
        sides = {"value": self.value, "limit": self.limit, "relation": self.relation, "unit": self.unit}
        return {"ok": self.ok, **compared, **sides}


def rule_of(check: Check) -> tuple[str, str]:
    """Return the rule that a check of a gear pair is of, and the wheel, if it is that of one."""
    name = role(check.name)
    return (name.kind, name.of) if name.of.isdigit() else (check.name, "")
