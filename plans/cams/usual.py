"""What numbers the cams of machines have: others are solved, too, but are more often a wrong unit than a cam."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .cam import VALUES
from .solve import SolvedCam, unit_of

DEGREE = math.radians(1.0)
# SI; the least and the greatest usual value. Lengths on paper are those that a sheet of format A1 has room for.
GIVEN = {
    "h": (1e-4, 0.5),
    "psi": (0.5 * DEGREE, 60.0 * DEGREE),
    "l_rocker": (5e-3, 2.0),
    "l_OC": (5e-3, 2.0),
    "phi_rise": (5.0 * DEGREE, 355.0 * DEGREE),
    "phi_fall": (5.0 * DEGREE, 355.0 * DEGREE),
    "omega": (1e-2, 3e3),
    "u": (0.05, 0.95),
    "u_fall": (0.05, 0.95),
    "l_A1": (0.01, 0.4),
    "H_a": (5e-3, 0.2),
    "H_v": (5e-3, 0.2),
    "mu_phi": (0.25 * DEGREE, 10.0 * DEGREE),
    "gamma_rise": (20.0 * DEGREE, 85.0 * DEGREE),
    "gamma_fall": (20.0 * DEGREE, 85.0 * DEGREE),
    "R_roller": (1e-3, 0.1),
    "rho_flat": (0.0, 0.2),
    "margin": (0.0, 0.05),
}
# what follows is looked at where all that is given is usual
FOUND = {"r_0": (2e-3, 1.0), "r_0_flat": (2e-3, 1.0), "a_max": (0.0, 1e5)}


@dataclass(frozen=True, slots=True)
class Unusual:
    """A number of a cam with its SI unit ("" for none), and between what the usual ones lie."""

    name: str
    unit: str
    value: float
    least: float
    most: float


def unusual(solved: SolvedCam) -> Iterator[Unusual]:
    """Go through the numbers that hardly any cam has: the given ones, else those that follow from them."""
    given = [*_beyond(solved, GIVEN)]
    yield from given or _beyond(solved, FOUND)


def _beyond(solved: SolvedCam, usual: dict[str, tuple[float, float]]) -> Iterator[Unusual]:
    for name, (least, most) in usual.items():
        value = solved.givens.get(name) if usual is GIVEN else solved.values.get(name)
        if value is not None and not least * (1.0 - 1e-9) <= value <= most * (1.0 + 1e-9):
            unit = VALUES[name] if name in VALUES else unit_of(name)
            yield Unusual(name, unit, float(value), least, most)
