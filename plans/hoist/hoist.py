"""A hoist that takes a load off a beam, as data; all numbers by name.

The numbers come separately, in SI, under the names of `VALUES`, so that one hoist serves a variant, a sweep, a batch. A
field may also hold the name of a given that is a choice between words: `chosen` puts the word of a variant there.

Source: Karpenko, Muzyka, Gudym, Evaluation of the forces in the lifting rope taking into account the resilience of its
links.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...scales.errors import InputError
from ...scales.numbers import quote
from ..laws import TURN

LEFT, RIGHT = SIDES = ("left", "right")
# parts of the construction that may be wanted, each of one plan or more
DRAWN = "drawn"  # part: a quantity as a drawing gives it
SCHEME_PART, FORCES_PART, ROOTS_PART, CIRCLE_PART, BEAMS_PART = PLANS = ("scheme", "forces", "roots", "circle", "beams")
# names of the numbers, and what they are
VALUES = {
    "G_1": "N",  # weight of the load, and of the rope that hangs
    "G_2": "N",
    "L": "m",  # of the rope: hanging length, area of metal, modulus, permissible stress, safety factor that is required
    "S": "m^2",
    "E_k": "Pa",
    "sigma": "Pa",
    "K": "",
    "l_0": "m",  # of the support beam: span, second moment of area, modulus, place of the load in parts of the span
    "I_0": "m^4",
    "E_0": "Pa",
    "beta_0": "",
    "l_2": "m",  # of the bridge beam likewise
    "I_2": "m^4",
    "E_2": "Pa",
    "beta_2": "",
    "V_0": "m/s",  # of the rope's upper end: speed at the beginning, acceleration; slack that is taken up first
    "a": "m/s^2",
    "slack": "m",
    "g": "m/s^2",
}
MAY_BE_RIGID = ("I_0", "I_2")  # numbers that may be infinite
NOT_NEGATIVE = ("G_2", "V_0", "a", "slack")  # numbers that may be zero
PARTS = ("beta_0", "beta_2")  # counted from the nearer end: up to one half
USUAL = {"slack": 0.0, "g": 9.81}  # what is not given


@dataclass(frozen=True, slots=True)
class Hoist:
    """A load on a support beam, and the drum on a bridge beam above it that takes it up."""

    # `left`, `right`: the end of the support beam and of the bridge beam that is the nearer one
    near_0: str = LEFT
    near_2: str = LEFT

    def chosen(self, words: Mapping[str, str]) -> Hoist:
        """Return the hoist with the words of a variant in the place of the names of the choices."""
        near_0, near_2 = (words.get(word, word) for word in (self.near_0, self.near_2))
        return replace(self, near_0=near_0, near_2=near_2)


MOST_SWINGS = 1e9  # before the lift-off: half of the digits tell in which of them this is
NEAREST = 0.5  # part of a span at most, from the nearer end


def complete(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the givens of one hoist as numbers, with what is usual where nothing else is given.

    The `values` have the names of `VALUES`, in SI; `I_0` and `I_2` may be infinite: a rigid beam.
    Raises InputError: `hoist-missing`, `hoist-number`, `hoist-positive`, `hoist-not-negative`, `hoist-beta` of a single
    number, `hoist-still` of a rope that is not wound up at all.
    """
    found = {name: _number(name, values) for name in VALUES}
    for name, value in found.items():
        if name in NOT_NEGATIVE:
            key, permitted = "hoist-not-negative", value >= 0.0
        elif name in PARTS:
            key, permitted = "hoist-beta", 0.0 < value <= NEAREST
        else:
            key, permitted = "hoist-positive", value > 0.0
        if not permitted:
            raise InputError(key, name=name, text=f"{value:.7g}")
    if found["V_0"] == 0.0 == found["a"]:
        raise InputError("hoist-still")
    return found


def _number(name: str, values: Mapping[str, Any]) -> float:
    if name not in values and name not in USUAL:
        raise InputError("hoist-missing", name=name)
    given = values.get(name, USUAL.get(name))
    try:
        value = float(given)
    except (TypeError, ValueError):
        raise InputError("hoist-number", name=name, text=quote(str(given))) from None
    if math.isnan(value) or (math.isinf(value) and name not in MAY_BE_RIGID):
        raise InputError("hoist-number", name=name, text=f"{value:g}")
    return value


def in_range(found: Mapping[str, float]) -> None:
    """Refuse givens so far apart that a result has no number; only what a rigid beam has may be infinite.

    Raises InputError: `hoist-range`, `hoist-stiff` of a load that swings so often that its phase is not known.
    """
    for name, value in found.items():
        of_rigid = math.isinf(value) and name in RIGID and math.isinf(found[RIGID[name]])
        if not math.isfinite(value) and not of_rigid:
            raise InputError("hoist-range", name=name)
    if vanished := [name for name in FINITE if not found[name] > 0.0]:
        raise InputError("hoist-range", name=vanished[0])
    turns = found["k"] * found["t_1"] / TURN
    if math.isfinite(found["k"]) and turns > MOST_SWINGS:
        raise InputError("hoist-stiff", n=f"{turns:.3g}")


# what is infinite where a beam is rigid, and what must not vanish
RIGID = {"I_0": "I_0", "I_2": "I_2", "C_01": "I_0", "k": "I_0", "C_2": "I_2"}
FINITE = ("m", "P_st", "C_01", "C_12", "C", "k_1", "t_1", "T_1_printed", "P_12_max", "F_max", "sigma_max")
