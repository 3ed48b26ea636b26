"""An external spur gear pair as data, all numbers by name, and what cannot be, seen at these alone.

`GIVENS` says what describes one: words are fields of a pair, numbers come separately, in SI.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ...scales.errors import InputError
from ...scales.givens import Bound, Described, Givens, Parameter, defaults, units
from ..names import Name, role

CCW, CW = ROTATIONS = ("ccw", "cw")
HOMOGENEOUS, HARDENED = MATERIALS = ("homogeneous", "hardened")
WHEELS = (1, 2)  # the pinion, which drives, and the wheel
SHIFTS = ("x_1", "x_2", "x_sum", "a_w")  # of which some are given
# parts of the construction that may be wanted
GEOMETRY_PART, MESHING_PART, SLIDING_PART = PLANS = ("geometry", "meshing", "sliding")
# modules of GOST 9563-60, both rows, m
MODULES = (
    *(1e-3, 1.125e-3, 1.25e-3, 1.375e-3, 1.5e-3, 1.75e-3, 2e-3, 2.25e-3, 2.5e-3, 2.75e-3, 3e-3, 3.5e-3, 4e-3, 4.5e-3),
    *(5e-3, 5.5e-3, 6e-3, 7e-3, 8e-3, 9e-3, 10e-3, 11e-3, 12e-3, 14e-3, 16e-3, 18e-3, 20e-3, 22e-3, 25e-3),
)
# of x_1, x_2 and one of a_w, x_sum two are given, or one of the latter; what has a default is that of GOST 13755-81
GIVENS: Givens = {
    "rotation": Parameter(choices=ROTATIONS, default=CCW),  # sense in which the pinion turns
    # whether the teeth are of one structure, or hard outside: these must be thicker at the tip
    "material": Parameter(choices=MATERIALS, default=HOMOGENEOUS),
    "m": Parameter("m", row=MODULES),  # module
    "z_1": Parameter(whole=True),  # teeth
    "z_2": Parameter(whole=True),
    "x_1": Parameter(bound=Bound.FREE, needed=False),  # shifts of the rack in modules
    "x_2": Parameter(bound=Bound.FREE, needed=False),
    "x_sum": Parameter(bound=Bound.FREE, needed=False),
    "a_w": Parameter("m", needed=False),
    "alpha": Parameter("rad", default=math.radians(20.0)),  # of the rack: profile angle
    "h_a": Parameter(default=1.0),  # addendum, depth of its straight edge, clearance in modules
    "h_l": Parameter(default=2.0),
    "c": Parameter(bound=Bound.NOT_NEGATIVE, default=0.25),
    "PW": Parameter("m", default=40e-3),  # drawn length of the velocity along the profiles at the pole
    "mu_theta": Parameter("1/mm", default=50.0),  # scale factor of the diagrams of specific sliding
}
VALUES, STANDARD = units(GIVENS), defaults(GIVENS)
# calculated quantities that are no lengths: angles and plain numbers by their kinds, others by their names
ANGLES = ("alpha", "tau", "nu", "phi")
PLAIN = ("x", "inv", "epsilon", "theta")
NUMBERS = ("u", "y", "delta_y", *(f"z_W{i}" for i in WHEELS))


@dataclass(frozen=True, slots=True)
class GearPair(Described):
    """A pinion that drives a wheel, both cut by one rack."""

    givens = GIVENS
    rotation: str = CCW
    material: str = HOMOGENEOUS

    @property
    def sense(self) -> int:
        """+1 when the pinion turns counter-clockwise, else -1."""
        return 1 if self.rotation == CCW else -1

    @property
    def least_tip(self) -> float:
        """The least thickness of a tooth at its tip, in modules."""
        return 0.4 if self.material == HARDENED else 0.3


def ordinate(wheel: int, point: str) -> Name:
    """Return the ordinate of a wheel's velocity in a point of the table."""
    return Name(f"y_{wheel}_{point}", "y", str(wheel), point)


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity of a pair by its name."""
    if name in NUMBERS or role(name).kind in PLAIN:
        return "1"
    return "rad" if role(name).kind in ANGLES else "m"


FEWEST = 3  # teeth
MOST = 10_000
ALPHA = math.radians(10.0), math.radians(35.0)
NEAR = 1e-12  # by which a limit may be passed: rounding
FIXED_BY = (
    *(("x_1", "x_2"), ("x_1", "x_sum"), ("x_1", "a_w"), ("x_2", "x_sum"), ("x_2", "a_w")),
    *(("x_sum",), ("a_w",)),
)


def impossible(values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
    """Go through what cannot be, by the name of the number that is told of; SI, what `STANDARD` has may be left out."""
    found = {**STANDARD, **values}
    m = found["m"]
    if not (math.isfinite(m) and m > 0.0):
        yield "m", InputError("gear-module", text=f"{m * 1e3:.7g}")
    for name in (name for name, of in GIVENS.items() if of.whole):
        z = found[name]
        if not (math.isfinite(z) and FEWEST <= z <= MOST and z == round(z)):
            yield name, InputError("gear-teeth", name=name, text=f"{z:.7g}", least=FEWEST, most=MOST)
    yield from _rack(found)
    given = tuple(name for name in SHIFTS if name in found)
    if given not in FIXED_BY:
        yield (given or SHIFTS)[0], InputError("gear-shifts", given=", ".join(given) or "-")
    for name in given:
        if not math.isfinite(found[name]):
            yield name, InputError("gear-shifts", given=", ".join(given))


def _rack(values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
    """Look at the rack: its angle, and that its tooth has a tip, a straight edge and room for a corner."""
    alpha, h_a, h_l, c = (values[name] for name in ("alpha", "h_a", "h_l", "c"))
    if not ALPHA[0] - NEAR <= alpha <= ALPHA[1] + NEAR:
        low, high = (f"{math.degrees(angle):.0f}" for angle in ALPHA)
        yield "alpha", InputError("gear-alpha", text=f"{math.degrees(alpha):.7g}", low=low, high=high)
        return
    depth = h_a + c
    widest = 0.25 * math.pi / math.tan(alpha)
    holds = {"c": c >= 0.0, "h_a": h_a > 0.0 and depth <= widest + NEAR, "h_l": h_a < h_l <= h_a + depth + NEAR}
    if wrong := next((name for name, right in holds.items() if not right), ""):
        said = {"h_a": f"{h_a:.6g}", "h_l": f"{h_l:.6g}", "c": f"{c:.6g}", "most": f"{widest:.4g}"}
        yield wrong, InputError("gear-rack", **said)
