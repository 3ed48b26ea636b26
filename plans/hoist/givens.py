"""The givens of a hoist made complete; and what no hoist can have, told."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...scales.errors import InputError
from ...scales.numbers import quote
from ..laws import TURN
from .hoist import MAY_BE_RIGID, NOT_NEGATIVE, PARTS, USUAL, VALUES

MOST_SWINGS = 1e9  # before the lift-off: half of the digits tell in which of them this is
NEAREST = 0.5  # part of a span at most, from the nearer end


def complete(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the givens of one hoist as numbers, with what is usual where nothing else is given.

    Parameters
    ----------
    values : mapping of str to number
        Of the names of `VALUES`, in SI; `I_0` and `I_2` may be infinite: a rigid beam.

    Raises
    ------
    InputError
        `hoist-missing`, `hoist-number`, `hoist-positive`, `hoist-not-negative`, `hoist-beta` of a single number,
        `hoist-still` of a rope that is not wound up at all.
    """
    found = {name: _number(name, values) for name in VALUES}
    for name, value in found.items():
        if name in NOT_NEGATIVE:
            if value < 0.0:
                raise InputError("hoist-not-negative", name=name, text=f"{value:.7g}")
        elif not value > 0.0:
            key = "hoist-beta" if name in PARTS else "hoist-positive"
            raise InputError(key, name=name, text=f"{value:.7g}")
        elif name in PARTS and value > NEAREST:
            raise InputError("hoist-beta", name=name, text=f"{value:.7g}")
    if found["V_0"] == 0.0 == found["a"]:
        raise InputError("hoist-still")
    return found


def _number(name: str, values: Mapping[str, Any]) -> float:
    if name not in values and name not in USUAL:
        raise InputError("hoist-missing", name=name)
    given = values.get(name, USUAL.get(name))
    try:
        value = float(given)
    except (TypeError, ValueError):
        raise InputError("hoist-number", name=name, text=quote(str(given))) from None
    if math.isnan(value) or (math.isinf(value) and name not in MAY_BE_RIGID):
        raise InputError("hoist-number", name=name, text=f"{value:g}")
    return value


def in_range(found: Mapping[str, float]) -> None:
    """Refuse givens so far apart that a result has no number; only what a rigid beam has may be infinite.

    Raises
    ------
    InputError
        `hoist-range`, `hoist-stiff` of a load that swings so often before the lift-off that its phase is not known.
    """
    for name, value in found.items():
        of_rigid = math.isinf(value) and name in RIGID and math.isinf(found[RIGID[name]])
        if not math.isfinite(value) and not of_rigid:
            raise InputError("hoist-range", name=name)
    for name in FINITE:
        if not found[name] > 0.0:
            raise InputError("hoist-range", name=name)
    turns = found["k"] * found["t_1"] / TURN
    if math.isfinite(found["k"]) and turns > MOST_SWINGS:
        raise InputError("hoist-stiff", n=f"{turns:.3g}")


# what is infinite where a beam is rigid, and what must not vanish
RIGID = {"I_0": "I_0", "I_2": "I_2", "C_01": "I_0", "k": "I_0", "C_2": "I_2"}
FINITE = ("m", "P_st", "C_01", "C_12", "C", "k_1", "t_1", "T_1_printed", "P_12_max", "F_max", "sigma_max")
