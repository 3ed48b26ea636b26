"""Choosing where load and drum stand: the greatest force and stress over beta_0 and beta_2, and what is permitted.

The article's loop changes beta_0 and beta_2 until the rope is safe enough: it tries the places of a grid, the nearest
to the given ones first. Where a rope that pushes or a support that pulls makes the formulas invalid, the motion of a
one-sided rope and support is taken instead.

Source: Karpenko, Muzyka, Gudym, figure 3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .checks import valid
from .forces import VALIDITY, forces_of_many
from .model import model

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
LEAST, MOST = 0.05, 0.5  # of beta: nearer to its end a beam is rigid
PLACES, FEWER = 46, 16  # of each beta: steps of 0.01, or of 0.03 where many motions have to be followed
MANY = 100  # places at which the formulas are not valid, and the motion takes a thousand times as long
ROUNDS, FINE, LESS = 5, 9, 5  # rounds in which the optimum is closed in on, and places in each


@dataclass(frozen=True, slots=True, eq=False)
class Spectrum:
    """Greatest forces over the places of load and drum.

    Parameters
    ----------
    beta_0, beta_2 : array of shape (N,), (M,)
        The places.
    F_max, sigma_max, safety : array of shape (N, M)
        SI.
    formulas : array of bool, shape (N, M)
        Whether the closed formulas are valid.
    permitted : array of bool, shape (N, M)
        Whether the strength condition holds.
    """

    beta_0: Array
    beta_2: Array
    F_max: Array
    sigma_max: Array
    safety: Array
    formulas: Flags
    permitted: Flags


@dataclass(frozen=True, slots=True)
class Trial:
    """Places that were tried, and the safety that they have."""

    beta_0: float
    beta_2: float
    F_max: float
    safety: float


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """The spectrum, the best places, and the way of the article's loop.

    Parameters
    ----------
    given : Trial
        The places that are given.
    best : Trial
        Those with the least force, between the places of the grid too.
    trials : tuple of Trial
        What the loop tried, `given` first; the last is safe, unless no place is.
    K : float
        The safety that is required.
    """

    spectrum: Spectrum
    given: Trial
    best: Trial
    trials: tuple[Trial, ...]
    K: float

    @property
    def found(self) -> bool:
        """Whether the loop ended with places that are safe."""
        return self.trials[-1].safety >= self.K


def spectrum(values: Mapping[str, float], beta_0: Array, beta_2: Array) -> Spectrum:
    """Return the greatest forces at all pairs of places.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens, SI; their own places do not count.
    """
    formulas = _formulas(values, beta_0, beta_2)
    F_max = forces_of_many(_placed(values, beta_0, beta_2), ("F_max",))["F_max"]
    shape = len(beta_0), len(beta_2)
    F_max = F_max.reshape(shape)
    sigma_max = F_max * (1.0 / values["S"])
    safety = values["sigma"] / sigma_max
    return Spectrum(beta_0, beta_2, F_max, sigma_max, safety, formulas.reshape(shape), safety >= values["K"])


def _placed(values: Mapping[str, float], beta_0: Array, beta_2: Array) -> dict[str, Any]:
    """Return the givens of the hoists at all pairs of places."""
    first, second = (one.ravel() for one in np.meshgrid(beta_0, beta_2, indexing="ij"))
    return {**values, "beta_0": first, "beta_2": second}


def _formulas(values: Mapping[str, float], beta_0: Array, beta_2: Array) -> Flags:
    """Return at which pairs of places the formulas are valid."""
    found: Flags = valid(model(_placed(values, beta_0, beta_2), VALIDITY))
    return found


def _grid(places: int) -> Array:
    found: Array = LEAST + (MOST - LEAST) * (np.arange(places) / (places - 1))
    return found


def choose(values: Mapping[str, float], places: int = PLACES) -> Choice:
    """Look for places that are safe, and for the best ones.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens, SI, `beta_0` and `beta_2` among them.
    places : int
        Of each beam, from `LEAST` to `MOST`; fewer where the formulas are not valid at many.
    """
    grid, fine = _grid(places), FINE
    if np.sum(~_formulas(values, grid, grid)) > MANY:
        grid, fine = _grid(min(places, FEWER)), LESS
    found = spectrum(values, grid, grid)
    given = _trial(spectrum(values, np.array([values["beta_0"]]), np.array([values["beta_2"]])), 0, 0)
    return Choice(found, given, _best(values, found, fine), _loop(found, given, values["K"]), values["K"])


def _trial(found: Spectrum, i: int, j: int) -> Trial:
    values = (found.beta_0[i], found.beta_2[j], found.F_max[i, j], found.safety[i, j])
    return Trial(*map(float, values))


def _loop(found: Spectrum, given: Trial, K: float) -> tuple[Trial, ...]:
    """Try places until they are safe, those first that are least changed."""
    trials = [given]
    away = np.hypot(found.beta_0[:, None] - given.beta_0, found.beta_2[None, :] - given.beta_2)
    for at in np.argsort(away, axis=None, kind="stable").tolist():
        if trials[-1].safety >= K:
            break
        trials.append(_trial(found, *divmod(at, len(found.beta_2))))
    return tuple(trials)


def _best(values: Mapping[str, float], found: Spectrum, count: int) -> Trial:
    """Return the places of the least force: those of the grid, then of finer and finer grids around them."""
    width = float(found.beta_0[1] - found.beta_0[0])
    best = _trial(found, *map(int, np.unravel_index(found.F_max.argmin(), found.F_max.shape)))
    for _ in range(ROUNDS):
        fine = spectrum(values, _around(best.beta_0, width, count), _around(best.beta_2, width, count))
        nearer = _trial(fine, *map(int, np.unravel_index(fine.F_max.argmin(), fine.F_max.shape)))
        best = nearer if nearer.F_max < best.F_max else best
        width *= 3.0 / (count - 1)
    return best


def _around(middle: float, width: float, count: int) -> Array:
    found: Array = np.clip(middle + width * np.linspace(-1.0, 1.0, count), LEAST, MOST)
    return found
