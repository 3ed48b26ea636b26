"""A hoist that takes a load off a beam, as data; all numbers by name.

The numbers come separately, in SI, under the names of `VALUES`, so that one hoist serves a variant, a sweep, a batch. A
field may also hold the name of a given that is a choice between words: `chosen` puts the word of a variant there.

Source: Karpenko, Muzyka, Gudym, Evaluation of the forces in the lifting rope taking into account the resilience of its
links.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

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
    """A load on a support beam, and the drum on a bridge beam above it that takes it up.

    Parameters
    ----------
    near_0, near_2 : {"left", "right"}
        The end of the support beam and of the bridge beam that is the nearer one.
    """

    near_0: str = LEFT
    near_2: str = LEFT

    def chosen(self, words: Mapping[str, str]) -> Hoist:
        """Return the hoist with the words of a variant in the place of the names of the choices."""
        near_0, near_2 = (words.get(word, word) for word in (self.near_0, self.near_2))
        return replace(self, near_0=near_0, near_2=near_2)
