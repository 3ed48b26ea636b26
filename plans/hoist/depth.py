"""How deep the model of a hoist must be: what simplifications change, and whether one mass is enough."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from .checks import valid
from .forces import forces
from .model import model
from .rope import Heavy, TremblingError, rope_of

Known = TypeVar("Known")
COMPARED = ("t_1", "F_12_max", "P_12_max", "F_max")
SIMPLER: Mapping[str, Mapping[str, float]] = {  # simplifications, and what is given then
    "G_2": {"G_2": 0.0},
    "I_2": {"I_2": math.inf},
    "I_0": {"I_0": math.inf},
    "beams": {"I_0": math.inf, "I_2": math.inf},
    "all": {"I_0": math.inf, "I_2": math.inf, "G_2": 0.0},
}
PRINTED = "printed"  # the article's formula (14) in the place of (14')
MASSES = (1, 2, 4, 8, 16, 32)
MANY = 8  # masses that stand for a rope with its mass spread out, where many ropes are looked at
RATIOS = tuple(10.0 ** (0.25 * i - 3.0) for i in range(13))  # G_2 / G_1, from 0.001 to 1


@dataclass(frozen=True, slots=True)
class Simplification:
    """What a simpler model changes, in parts of what the full one gives; None where nothing can be compared."""

    key: str
    changes: Mapping[str, float | None]


@dataclass(frozen=True, slots=True)
class OneMass:
    """One reduced mass beside a rope of many masses; errors in parts.

    Parameters
    ----------
    at_load, at_drum : float
        F_max of one mass less that of the rope at its lower and upper end.
    """

    ratio: float
    t_1: float
    at_load: float
    at_drum: float

    @property
    def worst(self) -> float:
        """The larger error of the force."""
        return max(abs(self.at_load), abs(self.at_drum))


@dataclass(frozen=True, slots=True)
class HoistDepth:
    """How deep the model must be.

    Parameters
    ----------
    full : mapping of str to float
        The quantities of the full model, of `COMPARED`, SI.
    simpler : tuple of Simplification
        In the order of `SIMPLER`, the article's formula last.
    ropes : tuple of Heavy
        Ropes of more and more masses, as far as they can be followed; empty where the rope weighs nothing, the support
        is rigid or formulas are not valid.
    ratio : float
        G_2 / G_1 of this hoist.
    one_mass : tuple of OneMass
        Beside a rope of `MANY` masses, over the ratio of the weights.
    tolerance : float
        In parts.
    """

    full: Mapping[str, float]
    simpler: tuple[Simplification, ...]
    ropes: tuple[Heavy, ...]
    ratio: float
    one_mass: tuple[OneMass, ...]
    tolerance: float

    @property
    def here(self) -> OneMass | None:
        """One mass beside the rope of the most masses of this hoist itself."""
        return _beside(self.full, self.ropes[-1], self.ratio) if self.ropes else None

    @property
    def enough_to(self) -> float:
        """The ratio of the weights up to which one mass misses by no more than the tolerance, between those known."""
        before: OneMass | None = None
        for one in self.one_mass:
            if one.worst > self.tolerance:
                return 0.0 if before is None else _between(before, one, self.tolerance)
            before = one
        return math.inf

    @property
    def spare(self) -> tuple[str, ...]:
        """Simplifications that change the greatest force by no more than the tolerance."""
        return tuple(s.key for s in self.simpler if s.changes["F_max"] is not None and self.misses(s) <= self.tolerance)

    def misses(self, one: Simplification) -> float:
        """Return by what part a simplification misses the greatest force."""
        return abs(one.changes["F_max"] or 0.0)


def depth(
    values: Mapping[str, float],
    tolerance: float,
    masses: Iterable[int] = MASSES,
    ratios: Iterable[float] = RATIOS,
) -> HoistDepth:
    """Look at simpler models and at ropes of many masses.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens, SI.
    tolerance : float
        In parts: an error of the greatest force that does not count.
    """
    whole = forces(values)
    found = whole.found
    full = {name: found[name] for name in COMPARED}
    simpler = [Simplification(k, _changes(full, forces({**values, **other}).found)) for k, other in SIMPLER.items()]
    printed = dict.fromkeys(COMPARED, math.nan)
    printed |= dict.fromkeys(("P_12_max", "F_max"), found["P_12_max_printed"])
    simpler.append(Simplification(PRINTED, _changes(full, printed)))
    swings = math.isfinite(found["C_01"]) and whole.motion is None
    ropes = (_followed(found, n) for n in masses) if swings and values["G_2"] > 0.0 else ()
    lighter = [_at_ratio(values, ratio) for ratio in ratios] if swings else []
    return HoistDepth(full, tuple(simpler), _known(ropes), values["G_2"] / values["G_1"], _known(lighter), tolerance)


def _changes(full: Mapping[str, float], other: Mapping[str, Any]) -> dict[str, float | None]:
    changes = {name: float(other[name]) / full[name] - 1.0 for name in COMPARED}
    return {name: change if math.isfinite(change) else None for name, change in changes.items()}


def _at_ratio(values: Mapping[str, float], ratio: float) -> OneMass | None:
    """Compare one mass with many for the same load on a rope of other weight; None where no formula is valid."""
    found = model({**values, "G_2": ratio * values["G_1"]})
    rope = _followed(found, MANY) if valid(found) else None
    return None if rope is None else _beside(found, rope, ratio)


def _followed(found: Mapping[str, float], n: int) -> Heavy | None:
    """Return what a rope of n masses gives; None where it trembles too fast to be followed."""
    try:
        return rope_of(found, n)
    except TremblingError:
        return None


def _known(found: Iterable[Known | None]) -> tuple[Known, ...]:
    return tuple(one for one in found if one is not None)


def _beside(found: Mapping[str, float], rope: Heavy, ratio: float) -> OneMass:
    at_load = found["F_max"] / max(rope.F_12_max, rope.P_12_max) - 1.0
    return OneMass(ratio, found["t_1"] / rope.t_1 - 1.0, at_load, found["F_max"] / rope.F_drum_max - 1.0)


def _between(low: OneMass, high: OneMass, tolerance: float) -> float:
    """Return the ratio at which the error is the tolerance, on a straight line of logarithms."""
    if low.worst <= 0.0:
        return low.ratio
    error_low, error_high = np.log(low.worst), np.log(high.worst)
    part = (math.log(tolerance) - error_low) / (error_high - error_low)
    return float(low.ratio * (high.ratio / low.ratio) ** part)
