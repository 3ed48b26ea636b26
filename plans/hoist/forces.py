"""The forces of a hoist as they are: by the formulas where these are valid, else by the motion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..check import Check
from .checks import strength, valid, validity
from .hoist import VALUES, complete, in_range
from .model import model, motion_given
from .onesided import OneSided, one_sided

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
