"""What a gear pair is judged by: values, limits and verdicts, and the distance of the centres in other ways.

Source: GOST 16532-70, appendix on quality by geometry.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..check import AT_LEAST, AT_MOST, EQUAL, Check
from ..names import role
from .gear import WHEELS, GearPair, unit_of

EPSILON = 1.2  # the least contact ratio advised for spur gears
ROUNDING = 1e-12  # part of a length by which two ways to it may differ, and a limit may be missed
SAME = 1e-9  # part of the active line: flanks that touch along all of it
CENTRES = ("a_w_rolling", "a_w_shift", "a_w_tip1", "a_w_tip2")


def rule_of(check: Check) -> tuple[str, str]:
    """Return the rule that a check is of, and the wheel, if it is that of one."""
    name = role(check.name)
    return (name.kind, name.of) if name.of.isdigit() else (check.name, "")


def judged(name: str, quantity: str, value: float, limit: float, relation: str, of: str = "") -> Check:
    """Return the check of a quantity, SI, against its limit, rounding apart; `of` is the quantity that the limit is.

    Names are `undercut_1`, `interference_1`, `contact_ratio`, `contact_flanks`, `tip_1`, `centre_a_w_shift`, ...
    """
    room = ROUNDING * max(abs(value), abs(limit))
    if relation == EQUAL:
        ok = math.isclose(value, limit, rel_tol=ROUNDING)
    else:
        ok = value >= limit - room if relation == AT_LEAST else value <= limit + room
    return Check(
        name=name, ok=ok, value=value, unit=unit_of(quantity), limit=limit, relation=relation, quantity=quantity, of=of
    )


def checks(pair: GearPair, found: Mapping[str, float]) -> list[Check]:
    """Return the checks of a pair with its quantities by name, in the order of the note.

    Interference is looked for where the rack has cut: the curvature at the lower point of contact must not be less than
    at the boundary point. Of an undercut tooth that is negative, and the check of undercutting tells it.
    """
    return [*_centres(found), *_roots(found), *_contact(found), *_tips(pair, found)]


def _centres(found: Mapping[str, float]) -> list[Check]:
    return [judged(f"centre_{name}", name, found[name], found["a_w"], EQUAL, "a_w") for name in CENTRES]


def _roots(found: Mapping[str, float]) -> list[Check]:
    undercut, interference = [], []
    for i in WHEELS:
        x, least, rho_l, rho_p = (f"{name}{i}" for name in ("x_", "x_min", "rho_l", "rho_p"))
        undercut.append(judged(f"undercut_{i}", x, found[x], found[least], AT_LEAST, least))
        interference.append(judged(f"interference_{i}", rho_l, found[rho_l], found[rho_p], AT_MOST, rho_p))
    return undercut + interference


def _contact(found: Mapping[str, float]) -> list[Check]:
    return [judged("contact_ratio", "epsilon_alpha", found["epsilon_alpha"], EPSILON, AT_LEAST)]


def cut(found: Mapping[str, float]) -> bool:
    """Tell whether teeth may lack a part of their active flanks: undercut, met at the fillet, or pointed."""
    return not all(check.ok for check in _roots(found)) or any(found[f"s_a{i}"] < 0.0 for i in WHEELS)


def on_flanks(found: Mapping[str, float], touching: tuple[float, float]) -> list[Check]:
    """Return the check of the contact ratio by what is left of the flanks, where that is less than the active line.

    `touching` says between which rho_1 the flanks touch, m; the formula of the contact ratio counts what is cut away.
    """
    length = max(touching[1] - touching[0], 0.0)
    if length >= found["g_alpha"] * (1.0 - SAME):
        return []
    return [judged("contact_flanks", "epsilon_flanks", length / found["p_b"], EPSILON, AT_LEAST)]


def _tips(pair: GearPair, found: Mapping[str, float]) -> list[Check]:
    limit = pair.least_tip * found["m"]
    return [judged(f"tip_{i}", f"s_a{i}", found[f"s_a{i}"], limit, AT_LEAST) for i in WHEELS]
