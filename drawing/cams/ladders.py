"""Ladders of the scale factors of a cam's plans: the wanted one first, then coarser and coarser."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...plans.cams.cam import DIAGRAMS_PART, PRESSURE_PART, PROFILE_PART, SIZES_PART
from ...plans.cams.solve import EQUAL, SolvedCam
from ...scales.choose import Choosers, From
from ...scales.scale import Scale, rounded, steps
from ..extents import not_a_point, smallest, visible
from ..formats import Format

MU_L = 0.001  # m/mm, M 1:1
SMALL = 0.030  # m, the least radius below which a cam is drawn at M 2:1 where nothing is said
COARSER = (1.0, 2.0, 2.5, 4.0, 5.0, 8.0, 10.0, 20.0, 25.0)  # of a plan with equal scale factors, in the finest one
FINER = (0.5, 0.4, 0.25, 0.2, 0.1)  # the same of one that would be too small
LEAST = 60.0  # mm of the least radius and the stroke on such a plan, where there is room
LARGEST = 150.0  # mm of the least radius and the stroke on a plan, where nothing is said
DIGITS = 5  # of a scale factor that is chosen, not found
AREAS = {DIAGRAMS_PART: 2.3e5, SIZES_PART: 9e4, PROFILE_PART: 9e4, PRESSURE_PART: 1.5e4}  # mm^2 of A1, with texts
PARTS = tuple(AREAS)
SYMBOLS = ("mu_l", *EQUAL)  # what may be chosen: the others follow from the drawn amplitude and the pole distances


def ladder(solved: SolvedCam, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the scale factors of `symbol`, one of `SYMBOLS`, the one wanted first.

    A plan that is made of two diagrams is drawn to the scale factor of one of them, or to a multiple of it.
    """
    across, chooser = size_of(solved, symbol), choosers.get(symbol)
    if chooser is not None and symbol in solved.scale_of_plan.values():
        visible(chooser, symbol, chooser.ladder(lambda _: across)[0], across, "m")
    if symbol not in EQUAL:
        return (chooser or From(_profiles(solved, across))).ladder(lambda _: 2.0 * across)
    if chooser is not None:
        return chooser.ladder(lambda _: across)
    finest = float(solved.values[EQUAL[symbol]]) if EQUAL[symbol] in solved.values else MU_L
    rungs = [rounded(finest * times, DIGITS) for times in COARSER]
    if across < LEAST * finest:  # of diagrams that are drawn smaller
        finer = (rounded(finest * times, DIGITS) for times in FINER)
        rungs.insert(0, next((mu for mu in finer if across >= LEAST * mu), rungs[0]))
    return tuple(mu for mu in rungs if across <= LARGEST * mu) or (steps(across / LARGEST)[0],)


def _profiles(solved: SolvedCam, across: float) -> float:
    """Return the scale factor of profiles where nothing is said: M 2:1 of a small cam, else M 1:1 or less, m/mm."""
    parts = (part for part in (solved.roller, solved.plate, solved.rocker) if part is not None)
    small = max((part.sizes.r_0 for part in parts), default=SMALL) < SMALL
    finest = MU_L / 2.0 if small else MU_L
    return max(finest, steps(across / LARGEST)[0])


def first_scales(
    solved: SolvedCam, choosers: Choosers, plans: Sequence[str] = PARTS
) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams follow from the construction."""
    if "mu_phi" in solved.givens:
        not_a_point("mu_phi", solved.givens["mu_phi"], math.tau, "rad")
    mus = {symbol: ladder(solved, choosers, symbol)[0] for symbol in SYMBOLS}
    return smallest(AREAS[plan] for plan in plans), scales(solved, mus)


def scales(solved: SolvedCam, mus: dict[str, float]) -> dict[str, Scale]:
    """Return the scale factors by plan, the chosen ones of `mus` among them."""
    values = {**solved.values, **mus}
    return {plan: Scale(symbol, float(values[symbol]), "m") for plan, symbol in solved.scale_of_plan.items()}


def size_of(solved: SolvedCam, symbol: str) -> float:
    """Return the largest size that plans of a scale factor show, m: to the cam's centre from the follower's top."""
    parts = {"mu_s_ds": (solved.roller,), "mu_s_d2s": (solved.plate,)}.get(symbol, (solved.roller, solved.plate))
    sizes = [part.sizes.r_0 + solved.motion.h for part in parts if part is not None]
    if symbol == "mu_l" and solved.rocker is not None:
        sizes.append(solved.rocker.sizes.l_OC)
    return max(sizes, default=MU_L)
