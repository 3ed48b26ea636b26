"""A disk cam as data: its followers, the laws of their motion, the senses; all numbers by name.

The numbers come separately, in SI, under the names of `VALUES`, so that one cam serves a variant, a sweep and a batch.
Everything else is a word. A field may also hold the name of a given that is a choice between words: `chosen` puts the
word of a variant in its place, and only then is the cam one that can be solved.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

ROLLER, PLATE, ROCKER = FOLLOWERS = ("roller", "plate", "rocker")
LAWS = (
    "uniform",
    "constant",
    "falling",
    "sawtooth",
    "cosine",
    "sine",
    "trapezoid",
    "modified-trapezoid",
    "modified-sine",
    "polynomial-345",
    "polynomial-4567",
)
AS_RISE = "rise"  # the fall has the law of the rise
MIRROR, SAME = ORDERS = ("mirror", "same")
CCW, CW = ROTATIONS = ("ccw", "cw")
ONE_SIDED, TWO_SIDED = LIMITS = ("one-sided", "two-sided")
POINTS, PIECES = CURVES = ("points", "pieces")
# parts of the construction that may be wanted, each of one plan or more
DIAGRAMS_PART, SIZES_PART, PROFILE_PART, PRESSURE_PART = PLANS = ("diagrams", "sizes", "profile", "pressure")
# names of the numbers, and what they are; those of a phase or a follower that a cam has not are not needed
VALUES = {
    "h": "m",  # stroke
    "phi_rise": "rad",
    "phi_upper": "rad",
    "phi_fall": "rad",
    "u": "",  # part of a phase that its first lobe takes, and that of the fall if it is another
    "u_fall": "",
    "omega": "rad/s",
    "mu_phi": "rad/mm",  # scale factor of the axis of angles
    "l_A1": "m",  # drawn length of the first amplitude, and the pole distances of both integrations
    "H_a": "m",
    "H_v": "m",
    "gamma_rise": "rad",
    "gamma_fall": "rad",
    "R_roller": "m",
    "rho_flat": "m",  # least radius of curvature under the plate, and by how much the plate reaches beyond the contact
    "margin": "m",
    "psi": "rad",  # swing of a rocker, in the place of the stroke; its length, and where it turns
    "l_rocker": "m",
    "l_OC": "m",
    "r_0": "m",  # sizes that are given, not found; r_0_flat is that of the cam for a plate beside one for a roller
    "e": "m",
    "r_0_flat": "m",
}
CHOICES = ("law", "law_fall", "fall", "rotation", "limits")  # fields that may hold the name of a choice
NEAR = 1e-12  # rad, within which two angles are one: by so much the phases may be longer than a turn
SECTIONS = 12  # of a phase, at least: what a student can draw, and enough for a smooth curve


@dataclass(frozen=True, slots=True)
class Curve:
    """A law of one's own: `values` at the parts `at` of the phase, which run from 0 to 1.

    Of kind `points` the values are travels, in any unit, joined by a smooth curve; of kind `pieces` they are the
    analogue of acceleration, in any unit, joined by straight lines, which jump where two places are equal.
    """

    name: str
    kind: str
    at: tuple[float, ...]
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Cam:
    """A disk cam that turns with `omega` and lifts its followers after one law of motion."""

    # of `FOLLOWERS`: the same motion may be that of several cams, each with a follower of its own
    followers: tuple[str, ...]
    law: str  # the law of the rise: one of `LAWS`, or the name of one of `curves`
    law_fall: str = AS_RISE  # the law of the fall likewise, or `rise`
    # `mirror`, `same`: whether the fall runs through its law backwards in time, or in the same order
    fall: str = MIRROR
    rotation: str = CCW  # `ccw`, `cw`: sense in which the cam turns
    # `one-sided`, `two-sided`: whether the pressure angle is limited only where the cam pushes, or to both sides
    limits: str = ONE_SIDED
    sections: int = SECTIONS  # into how many sections a phase is divided at least
    curves: tuple[Curve, ...] = ()  # laws of one's own

    def chosen(self, words: Mapping[str, str]) -> Cam:
        """Return the cam with the words of a variant in the place of the names of the choices."""
        chosen = {key: words.get(word := getattr(self, key), word) for key in CHOICES}
        return replace(self, **chosen)

    @property
    def sense(self) -> int:
        """+1 when the cam turns counter-clockwise, else -1."""
        return 1 if self.rotation == CCW else -1

    @property
    def two_sided(self) -> bool:
        """Whether the pressure angle is limited to both sides."""
        return self.limits == TWO_SIDED

    @property
    def falls_by(self) -> str:
        """The law of the fall."""
        return self.law if self.law_fall == AS_RISE else self.law_fall

    def curve(self, law: str) -> Curve | None:
        """Return the law of one's own of this name, None for one of `LAWS`."""
        return next((curve for curve in self.curves if curve.name == law), None)
