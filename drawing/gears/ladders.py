"""Scale factors of the plans of gears: the ladder of the meshing, and those of the diagrams, which are known before."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...plans.solved import PAPER_MM
from ...scales.choose import Choosers, From
from ...scales.scale import Scale, steps
from ..extents import not_a_point, smallest, visible
from ..formats import STYLES, Format

TOOTH = 50.0  # mm, by which a drawn tooth should be high at least
LONGEST = 230.0  # mm, that N1N2 may be where the involutes are constructed
FOREIGN = 4e-5  # m/mm, 25:1
# mm^2 of A1, of figures with their texts
AREAS = {GEOMETRY_PART: 2.6e5, MESHING_PART: 3e5, SLIDING_PART: 9e4}
# mm of the line of action and of the axis of specific sliding on the diagrams, by the height of letters
ALONG, TALL = {5.0: 250.0, 3.5: 140.0}, {5.0: 125.0, 3.5: 62.0}
CURVES = {1: "theta_12", 2: "theta_21"}  # of specific sliding
ENDS = {"A1": "rho_p1", "A2": "rho_a1"}  # of the active line, and the quantities that are their distances from N1
CUTS = 2.0, 10.0  # the least and the greatest depth at which curves are cut off
USUAL = 5.0  # where sliding has no limit on the active line
ROOM = 1.25  # how far below the extremes
PARTS = 1.0, 0.8, 0.6, 0.5  # of the usual size of the diagrams of sliding
UNITS = {MESHING: "m", SLIDING: "m", THETA: "1"}


def mu_ladder(solved: SolvedGear, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the meshing, the one wanted first: where nothing is said, teeth of 50 mm."""
    wanted = choosers.get("mu_l", From(_finest(solved)))
    first, *others = wanted.ladder(lambda name: solved.sizes.get(name, solved.sizes["a_w"]))
    if MESHING in solved.scale_of_plan:
        visible(wanted, "mu_l", first, solved.sizes["a_w"], "m")
    return first, *_standard(others)


def near_ladder(solved: SolvedGear) -> tuple[float, ...]:
    """Return the scale factors of the middle of a meshing that is drawn apart."""
    return _standard(From(_finest(solved)).ladder(lambda _: solved.sizes["a_w"]))


def rolled_ladder(solved: SolvedGear) -> tuple[float, ...]:
    """Return the scale factors of the construction of the involutes and of the line of action straightened."""
    least = max(_finest(solved), _standard(steps(solved.sizes["l_N1N2"] / LONGEST))[0])
    return _standard(From(least).ladder(lambda _: solved.sizes["a_w"]))


def _finest(solved: SolvedGear) -> float:
    most = solved.sizes["h"] / TOOTH
    return max(mu for mu in _standard(steps(most / 10.0)) if mu <= most * (1.0 + 1e-9))


def _standard(mus: Iterable[float]) -> tuple[float, ...]:
    """Return the scale factors that GOST 2.302 has: 2,5:1 is one of its enlargements, 25:1 is not."""
    return tuple(mu for mu in mus if not math.isclose(mu, FOREIGN))


def first_scales(solved: SolvedGear, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: the given ones, or coarser ones where diagrams have no room."""
    sheet = smallest(AREAS[plan] for plan in plans)
    values = {MESHING: mu_ladder(solved, choosers)[0]}
    if SLIDING in solved.scale_of_plan:
        height, part = STYLES[sheet.letters].label, parts_of(plans)[0]
        values |= {SLIDING: rho_mu(solved, height, part), THETA: theta_mu(solved, height, part)}
    return sheet, {plan: Scale(symbol, values[plan], UNITS[plan]) for plan, symbol in solved.scale_of_plan.items()}


def parts_of(plans: Sequence[str]) -> tuple[float, ...]:
    """Return what diagrams of sliding may have of their usual size, the wanted part first: beside the meshing less."""
    return PARTS[1:] if {MESHING_PART, SLIDING_PART} <= {*plans} else PARTS


def rho_mu(solved: SolvedGear, letters: float, part: float = 1.0) -> float:
    """Return the scale factor of the line of action, the given one or a coarser one of its series, m/mm.

    `letters` are so high, mm; diagrams have `part` of their usual size.
    """
    given = float(solved.values["mu_rho"]) * PAPER_MM
    return steps(max(given, solved.sizes["l_N1N2"] / (ALONG[letters] * part)))[0]


def theta_mu(solved: SolvedGear, letters: float, part: float = 1.0) -> float:
    """Return the scale factor of specific sliding, the given one or a coarser one of its series, 1/mm.

    Raises
    ------
    InputError
        The given one is so coarse that the diagram is a line.
    """
    wanted = float(solved.values["mu_theta"]) * PAPER_MM
    depth = 1.0 - cut_of(solved)
    not_a_point("mu_theta", wanted, depth, "1")
    return steps(max(depth / (TALL[letters] * part), wanted * (1.0 - 1e-9)))[0]


def cut_of(solved: SolvedGear) -> float:
    """Return the value at which the curves are cut off: a whole number below both extremes of the active line."""
    lowest = min(solved.sizes[f"{name}_{end}"] for name in CURVES.values() for end in ENDS)
    if not math.isfinite(lowest):
        return -USUAL
    return -min(max(math.ceil(-ROOM * lowest), CUTS[0]), CUTS[1])
