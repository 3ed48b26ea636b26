"""The forces of a hoist as they are: by the formulas where these are valid, else by the motion; and where it may stand.

A hoist is judged by whether its formulas are valid, and whether its rope is strong enough. Where load and drum stand is
chosen by the greatest force and stress over beta_0 and beta_2, and by what is permitted. The article's loop changes
beta_0 and beta_2 until the rope is safe enough: it tries the places of a grid, the nearest to the given ones first.
Where a rope that pushes or a support that pulls makes the formulas invalid, the motion of a one-sided rope and support
is taken.

Source: Karpenko, Muzyka, Gudym, figure 3.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..check import AT_LEAST, MORE, Check
from .hoist import VALUES, complete, in_range
from .model import model, motion_given
from .onesided import OneSided, one_sided

ROPE_1, ROPE_2, SUPPORT, STRENGTH = ("rope_phase_1", "rope_phase_2", "support", "strength")


def valid(found: Mapping[str, Any]) -> Any:
    """Return whether the two-sided formulas are valid: the rope always pulls, the load does not come back."""
    return (found["F_12_min"] >= 0.0) & (found["P_12_min"] >= 0.0) & (found["s_min"] > 0.0)


def validity(found: Mapping[str, float], motion: OneSided | None) -> list[Check]:
    """Return the checks of the two-sided formulas: least forces of the rope in both phases, least height of the load.

    A value is what the formulas give as long as the checks before it hold, else that of the motion.
    """
    pulls = found["F_12_min"] >= 0.0
    checks = [_check(ROPE_1, "F_12_min", pulls, found["F_12_min"])]
    if pulls or motion is None:
        taut, least = found["P_12_min"] >= 0.0, found["P_12_min"]
    else:
        taut, least = not motion.slackens, motion.least_pull
    checks.append(_check(ROPE_2, "P_12_min", taut, least))
    if motion is None or (pulls and taut):
        stays, lowest = found["s_min"] > 0.0, found["s_min"]
    else:
        stays, lowest = not motion.returns, motion.lowest
    checks.append(_check(SUPPORT, "s_min", stays, lowest, MORE, "m"))
    return checks


def _check(name: str, quantity: str, ok: bool, value: float, relation: str = AT_LEAST, unit: str = "N") -> Check:
    return Check(name=name, ok=bool(ok), value=value, unit=unit, limit=0.0, relation=relation, quantity=quantity)


def strength(values: Mapping[str, float]) -> Check:
    """Return whether the rope is as safe as is required."""
    value, limit = values["safety"], values["K"]
    return Check(
        name=STRENGTH, ok=bool(value >= limit), value=value, unit="1", limit=limit, relation=AT_LEAST,
        quantity="safety", of="K",
    )  # fmt: skip


MOST_OF_MANY = 10_000.0  # pieces and swings of the motions of many hoists together
VALIDITY = ("F_12_min", "P_12_min", "s_min")
MOVED = ("g", "m", "C_01", "C_12", "V_t", "a")  # what a motion follows from


@dataclass(frozen=True, slots=True)
class Forces:
    """The quantities of a hoist in SI, what they are judged by, and the motion where the formulas are not valid."""

    found: Mapping[str, float]
    checks: tuple[Check, ...]
    motion: OneSided | None

    @property
    def ok(self) -> Mapping[str, bool]:
        """The verdicts by name."""
        return {check.name: check.ok for check in self.checks}


def forces(values: Mapping[str, Any]) -> Forces:
    """Return the forces of one hoist.

    Parameters
    ----------
    values : mapping of str to number
        The givens in SI; what `USUAL` has may be left out.

    Raises
    ------
    InputError
        Givens that no hoist can have, named.
    """
    givens = complete(values)
    found = model(givens)
    in_range(found)
    motion = None if valid(found) else one_sided(found)
    checks = validity(found, motion)
    if motion is not None:
        found = model(givens | motion_givens(motion), one_sided=True)
    return Forces(found, (*checks, strength(found)), motion)


def motion_givens(motion: OneSided) -> dict[str, float]:
    """Return the quantities that a motion gives in the place of formulas, as givens of the construction."""
    t_1 = motion.t_1
    (t_most, most), (_, least) = motion.extremes(lifted=False)
    (t_top, top), (_, bottom) = motion.extremes(lifted=True)
    found = {
        "t_1": t_1,
        "F_12_t1": motion.force(t_1),
        "_dF_t1": motion.rate(t_1),
        "F_12_max": most,
        "t_F12_max": t_most,
        "F_12_min": least,
        "T_1": t_top - t_1,
        "P_12_max": top,
        "P_12_min": bottom,
        "s_min": motion.lowest,
    }
    return {motion_given(name): value for name, value in found.items()}


def forces_of_many(values: Mapping[str, Any], wanted: Iterable[str]) -> dict[str, Any]:
    """Return quantities of many hoists at once, each found as it is valid for it.

    Parameters
    ----------
    values : mapping of str to float or array
        The complete givens, admissible, with any shapes that go together.
    wanted : iterable of str
        Names of the quantities.

    Raises
    ------
    InputError
        Motions of more pieces and swings than anybody waits for.
    """
    names, left = tuple(wanted), MOST_OF_MANY
    found = model(values, (*names, *VALIDITY, *MOVED))
    shape = np.broadcast_shapes(*(np.shape(values[name]) for name in VALUES))
    kept = {name: np.array(np.broadcast_to(found[name], shape)) for name in names}
    for index in map(tuple, np.argwhere(~np.broadcast_to(valid(found), shape))):
        one = {name: float(np.broadcast_to(values[name], shape)[index]) for name in VALUES}
        motion = one_sided({name: float(np.broadcast_to(found[name], shape)[index]) for name in MOVED}, left)
        left -= motion.events
        alone = model(one | motion_givens(motion), names, one_sided=True)
        for name in names:
            kept[name][index] = alone[name]
    return kept


Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
LEAST, MOST = 0.05, 0.5  # of beta: nearer to its end a beam is rigid
PLACES, FEWER = 46, 16  # of each beta: steps of 0.01, or of 0.03 where many motions have to be followed
MANY = 100  # places at which the formulas are not valid, and the motion takes a thousand times as long
ROUNDS, FINE, LESS = 5, 9, 5  # rounds in which the optimum is closed in on, and places in each


@dataclass(frozen=True, slots=True, eq=False)
class Spectrum:
    """Greatest forces over the places of load and drum."""

    # shape (N,): the places
    beta_0: Array
    beta_2: Array
    # shape (N, M), SI
    F_max: Array
    sigma_max: Array
    safety: Array
    formulas: Flags  # shape (N, M): whether the closed formulas are valid
    permitted: Flags  # shape (N, M): whether the strength condition holds


@dataclass(frozen=True, slots=True)
class Trial:
    """Places that were tried, and the safety that they have."""

    beta_0: float
    beta_2: float
    F_max: float
    safety: float


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """The spectrum, the best places, and the way of the article's loop."""

    spectrum: Spectrum
    given: Trial  # the places that are given
    best: Trial  # those with the least force, between the places of the grid too
    trials: tuple[Trial, ...]  # what the loop tried, `given` first; the last is safe, unless no place is
    K: float  # the safety that is required

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
