"""A hoist that takes a load off a beam, as data; all numbers by name.

`GIVENS` says what describes one: words are fields of a hoist, numbers come separately, in SI.

Source: Karpenko, Muzyka, Gudym, Evaluation of the forces in the lifting rope taking into account the resilience of its
links.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...scales.errors import InputError
from ...scales.givens import Bound, Described, Givens, Parameter, units
from ...scales.numbers import quote

Numbers = Mapping[str, Any]  # quantities by name, SI: of one hoist, or arrays of many
LEFT, RIGHT = SIDES = ("left", "right")
# parts of the construction that may be wanted, each of one plan or more
DRAWN = "drawn"  # part: a quantity as a drawing gives it
SCHEME_PART, FORCES_PART, ROOTS_PART, CIRCLE_PART, BEAMS_PART = PLANS = ("scheme", "forces", "roots", "circle", "beams")
GIVENS: Givens = {
    "near_0": Parameter(choices=SIDES, default=LEFT),  # the end of the support beam that is the nearer one
    "near_2": Parameter(choices=SIDES, default=LEFT),  # of the bridge beam likewise
    "G_1": Parameter("N"),  # weight of the load, and of the rope that hangs
    "G_2": Parameter("N", Bound.NOT_NEGATIVE),
    "L": Parameter("m"),  # of the rope: hanging length, area of metal, modulus, permissible stress, required safety
    "S": Parameter("m^2"),
    "E_k": Parameter("Pa"),
    "sigma": Parameter("Pa"),
    "K": Parameter(),
    "l_0": Parameter("m"),  # of the support beam: span, second moment of area, modulus, place in parts of the span
    "I_0": Parameter("m^4", Bound.RIGID),
    "E_0": Parameter("Pa"),
    "beta_0": Parameter("", Bound.UP_TO_HALF),  # counted from the nearer end
    "l_2": Parameter("m"),  # of the bridge beam likewise
    "I_2": Parameter("m^4", Bound.RIGID),
    "E_2": Parameter("Pa"),
    "beta_2": Parameter("", Bound.UP_TO_HALF),
    "V_0": Parameter("m/s", Bound.NOT_NEGATIVE),  # of the rope's upper end: speed at the beginning, acceleration
    "a": Parameter("m/s^2", Bound.NOT_NEGATIVE),
    "slack": Parameter("m", Bound.NOT_NEGATIVE, default=0.0),  # is taken up first
    "g": Parameter("m/s^2", default=9.81),
}
VALUES = units(GIVENS)
REFUSED = {Bound.NOT_NEGATIVE: "hoist-not-negative", Bound.UP_TO_HALF: "hoist-beta"}  # by bound; others positive


@dataclass(frozen=True, slots=True)
class Hoist(Described):
    """A load on a support beam, and the drum on a bridge beam above it that takes it up."""

    givens = GIVENS
    near_0: str = LEFT
    near_2: str = LEFT


MOST_SWINGS = 1e9  # before the lift-off: half of the digits tell in which of them this is


def complete(values: Numbers) -> dict[str, float]:
    """Return the givens of one hoist as numbers, with what is usual where nothing else is given.

    The `values` have the names of `GIVENS`, in SI; `I_0` and `I_2` may be infinite: a rigid beam.
    Raises InputError: `hoist-missing`, `hoist-number`, `hoist-positive`, `hoist-not-negative`, `hoist-beta` of a single
    number, `hoist-still` of a rope that is not wound up at all.
    """
    found: dict[str, float] = {}
    for name in VALUES:
        given, bound = values.get(name, GIVENS[name].default), GIVENS[name].bound
        if name not in values and given is None:
            raise InputError("hoist-missing", name=name)
        try:
            found[name] = value = float(given)
        except (TypeError, ValueError):
            raise InputError("hoist-number", name=name, text=quote(str(given))) from None
        if math.isnan(value) or (math.isinf(value) and bound is not Bound.RIGID):
            raise InputError("hoist-number", name=name, text=f"{value:g}")
    for name, value in found.items():
        bound = GIVENS[name].bound
        if not bound.admits(value):
            raise InputError(REFUSED.get(bound, "hoist-positive"), name=name, text=f"{value:.7g}")
    if found["V_0"] == 0.0 == found["a"]:
        raise InputError("hoist-still")
    return found


# what is infinite where a beam is rigid, and what must not vanish
RIGID = {"I_0": "I_0", "I_2": "I_2", "C_01": "I_0", "k": "I_0", "C_2": "I_2"}
FINITE = ("m", "P_st", "C_01", "C_12", "C", "k_1", "t_1", "T_1_printed", "P_12_max", "F_max", "sigma_max")
