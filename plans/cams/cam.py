"""A disk cam as data: its followers, the laws of their motion, the senses; all numbers by name.

`GIVENS` says what describes one: words are fields of a cam, numbers come separately, in SI. Where a field holds the
name of a given that is a choice, only the cam with the word of a variant in its place can be solved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...scales.givens import Bound, Described, Givens, Parameter, units

ROLLER, PLATE, ROCKER = FOLLOWERS = ("roller", "plate", "rocker")
LAWS = (
    *("uniform", "constant", "falling", "sawtooth", "cosine", "sine", "trapezoid"),
    *("modified-trapezoid", "modified-sine", "polynomial-345", "polynomial-4567"),
)
AS_RISE = "rise"  # the fall has the law of the rise
MIRROR, SAME = ORDERS = ("mirror", "same")
CCW, CW = ROTATIONS = ("ccw", "cw")
ONE_SIDED, TWO_SIDED = LIMITS = ("one-sided", "two-sided")
POINTS, PIECES = CURVES = ("points", "pieces")
# parts of the construction that may be wanted, each of one plan or more
DIAGRAMS_PART, SIZES_PART, PROFILE_PART, PRESSURE_PART = PLANS = ("diagrams", "sizes", "profile", "pressure")
_STRAIGHT, _ROLLING = (ROLLER, PLATE), (ROLLER, ROCKER)
_DEGREE = math.radians(1.0)
_PERMITTED = Parameter("rad", Bound.ACUTE, usual=(20.0 * _DEGREE, 85.0 * _DEGREE), forms=_ROLLING)
_PHASE = Parameter("rad", Bound.TURN, usual=(5.0 * _DEGREE, 355.0 * _DEGREE))
_POLE = Parameter("m", default=0.03, usual=(5e-3, 0.2))
# forms are followers. Usual lengths on paper are those that a sheet of format A1 has room for
GIVENS: Givens = {
    "law": Parameter(choices=LAWS),  # of the rise: one of these, or the name of one of `curves`
    "law_fall": Parameter(choices=(AS_RISE, *LAWS), default=AS_RISE),
    "fall": Parameter(choices=ORDERS, default=MIRROR),  # whether it runs through its law backwards in time
    "rotation": Parameter(choices=ROTATIONS, default=CCW),  # sense in which the cam turns
    "limits": Parameter(choices=LIMITS, default=ONE_SIDED),  # whether the pressure angle is limited to both sides
    "h": Parameter("m", usual=(1e-4, 0.5), forms=_STRAIGHT),  # stroke
    # swing of a rocker, in the place of the stroke
    "psi": Parameter("rad", Bound.ACUTE, usual=(0.5 * _DEGREE, 60.0 * _DEGREE), forms=(ROCKER,)),
    "phi_rise": _PHASE,
    "phi_upper": Parameter("rad", Bound.NOT_NEGATIVE, default=0.0),
    "phi_fall": _PHASE,
    "omega": Parameter("rad/s", usual=(1e-2, 3e3)),
    # part of a phase that its first lobe takes, and that of the fall if it is another
    "u": Parameter("", Bound.PART, default=0.5, usual=(0.05, 0.95)),
    "u_fall": Parameter("", Bound.PART, needed=False, usual=(0.05, 0.95)),
    # drawn length of the first amplitude, and the pole distances of both integrations
    "l_A1": Parameter("m", default=0.1, usual=(0.01, 0.4)),
    "H_a": _POLE,
    "H_v": _POLE,
    # scale factor of the axis of angles; its default in SI, its usual values as it is drawn
    "mu_phi": Parameter("rad/mm", default=math.radians(1e3), usual=(0.25 * _DEGREE, 10.0 * _DEGREE)),
    "gamma_rise": _PERMITTED,
    "gamma_fall": _PERMITTED,
    "R_roller": Parameter("m", usual=(1e-3, 0.1), forms=_ROLLING),
    # least radius of curvature under the plate, and by how much the plate reaches beyond the contact
    "rho_flat": Parameter("m", Bound.NOT_NEGATIVE, default=0.01, usual=(0.0, 0.2), forms=(PLATE,)),
    "margin": Parameter("m", Bound.NOT_NEGATIVE, default=0.005, usual=(0.0, 0.05), forms=(PLATE,)),
    "l_rocker": Parameter("m", usual=(5e-3, 2.0), forms=(ROCKER,)),
    # where the rocker turns; else the pivot is where the cam is smallest
    "l_OC": Parameter("m", needed=False, usual=(5e-3, 2.0), forms=(ROCKER,)),
    "r_0": Parameter("m", needed=False),  # sizes that are given, not found
    "e": Parameter("m", Bound.FREE, needed=False, forms=(ROLLER,)),
    "r_0_flat": Parameter("m", needed=False, forms=(PLATE,)),  # of the cam for a plate beside one for a roller
}
VALUES = units(GIVENS)
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
class Cam(Described):
    """A disk cam that turns with `omega` and lifts its followers after one law of motion."""

    givens = GIVENS
    # of `FOLLOWERS`: the same motion may be that of several cams, each with a follower of its own
    followers: tuple[str, ...]
    law: str
    law_fall: str = AS_RISE
    fall: str = MIRROR
    rotation: str = CCW
    limits: str = ONE_SIDED
    sections: int = SECTIONS  # into how many sections a phase is divided at least
    curves: tuple[Curve, ...] = ()  # laws of one's own

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
