"""Scale factors of the plans of gears: the ladder of the meshing, and those of the diagrams, which are known before."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ...plans.gears.meshing_plan import MESHING
from ...plans.gears.sliding_plan import SLIDING, THETA
from ...plans.gears.solve import SolvedGear
from ...plans.solved import PAPER_MM
from ...scales.choose import Choosers, From
from ...scales.scale import Scale, steps

TOOTH = 50.0  # mm, by which a drawn tooth should be high at least
LONGEST = 230.0  # mm, that N1N2 may be where the involutes are constructed
FOREIGN = 4e-5  # m/mm, 25:1
UNITS = {MESHING: "m", SLIDING: "m", THETA: "1"}


def mu_ladder(solved: SolvedGear, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the meshing, the one wanted first: where nothing is said, teeth of 50 mm."""
    wanted = choosers.get("mu_l", From(_finest(solved)))
    first, *others = wanted.ladder(lambda name: solved.sizes.get(name, solved.sizes["a_w"]))
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


def scales_of(solved: SolvedGear, choosers: Choosers) -> dict[str, Scale]:
    """Return the scale factors by plan as they are wanted."""
    values = {
        MESHING: mu_ladder(solved, choosers)[0],
        SLIDING: solved.values["mu_rho"] * PAPER_MM,
        THETA: solved.values["mu_theta"] * PAPER_MM,
    }
    return {plan: Scale(symbol, values[plan], UNITS[plan]) for plan, symbol in solved.scale_of_plan.items()}
