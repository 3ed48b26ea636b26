"""The ladder of the scale factor of a cam's profiles: the wanted one first, then coarser and coarser."""

from __future__ import annotations

from ...plans.cams.solve import SolvedCam
from ...scales.choose import Choosers, Fixed

MU_L = 0.001  # m/mm, M 1:1, where nothing is said


def mu_ladder(solved: SolvedCam, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the profiles, the one wanted first."""
    sizes = [part.sizes.r_0 + solved.motion.h for part in (solved.roller, solved.plate) if part is not None]
    sizes += [solved.rocker.sizes.l_OC] if solved.rocker is not None else []
    across = 2.0 * max(sizes, default=MU_L)
    return choosers.get("mu_l", Fixed(MU_L)).ladder(lambda _: across)
