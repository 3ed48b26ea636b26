"""How far steps may reach: errors of integrators over the step, the order that shows, and where runs are refused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .course import rope_forces
from .integrators import Run, integrate
from .rivals import COMPARED, exact
from .steppers import EXPLICIT, ORDERS, stability_limit

Array = NDArray[np.float64]
STEPS = tuple(4.0 * 2.0 ** (-0.5 * i) for i in range(15))  # k h, rad: from 4 to 0.03
TINY = tuple(2.0 ** (-0.5 * i) / 64.0 for i in range(6))  # beside these for explicit Euler, which is refused early
SHOWING = 0.35  # k h up to which an error shows its order
ROUNDING = 1e-12  # error that is none


@dataclass(frozen=True, slots=True, eq=False)
class StepLimits:
    """Errors of the rope's force, the worst until one period after lift-off, in parts of the greatest force.

    Parameters
    ----------
    steps : mapping of str to array of shape (N,)
        k h, rad, by method.
    ratio : float
        k_1 / k: in phase 2 steps are so much smaller beside the period.
    errors : mapping of str to array of shape (N,)
        By method; NaN where a run is refused.
    grown : mapping of str to array of shape (N,)
        By what a method makes oscillations grow over the run.
    """

    steps: Mapping[str, Array]
    ratio: float
    errors: Mapping[str, Array]
    grown: Mapping[str, Array]

    def order(self, method: str) -> float | None:
        """Return the power of the step as which the error falls; None where too few runs show it."""
        steps, error = self.steps[method], self.errors[method]
        shown = (steps <= SHOWING) & (error > ROUNDING)
        if shown.sum() < 2:
            return None
        return float(np.polyfit(np.log(steps[shown]), np.log(error[shown]), 1)[0])

    def refused_from(self, method: str) -> float | None:
        """Return the smallest step of those tried that is refused; None where none is."""
        refused = self.steps[method][np.isnan(self.errors[method])]
        return float(refused.min()) if refused.size else None

    @staticmethod
    def limit(method: str) -> float:
        """Return the largest k h at which a method is stable."""
        return stability_limit(method)


def step_limits(
    values: Mapping[str, float], steps: tuple[float, ...] = STEPS, tiny: tuple[float, ...] = TINY
) -> StepLimits:
    """Integrate a hoist with larger and larger steps, all of them at once.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens of a hoist on a support that yields, whose formulas are valid, SI.
    """
    right = exact(values)
    hoist = {name: float(right[name]) for name in COMPARED} | {"a": values["a"]}
    taken = {method: np.array((*steps, *(tiny if method == EXPLICIT else ()))) for method in ORDERS}
    runs = {method: integrate(hoist, method, z) for method, z in taken.items()}
    errors = {method: _worst(run, right) for method, run in runs.items()}
    return StepLimits(taken, hoist["k_1"] / hoist["k"], errors, {method: run.grown for method, run in runs.items()})


def _worst(run: Run, right: Mapping[str, Any]) -> Array:
    """Return the worst error of every run, NaN of those that are refused."""
    known = ~np.isnan(run.t)
    forces = rope_forces(right, np.where(known, run.t, 0.0).astype(np.longdouble))[1]
    away = np.abs((run.F_12 - forces) * (1.0 / right["F_max"])).astype(float)
    return np.where(run.refused, np.nan, np.max(away, axis=0, initial=0.0, where=known))
