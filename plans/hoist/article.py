"""The article's formula (14) over time, to be set beside the exact one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..laws import LAWS
from . import formulas as formulas  # its laws of calculation


def article_force(found: Mapping[str, Any], T: Any) -> Any:
    """Return the force of the rope at times after the lift-off as the article has it, N.

    Parameters
    ----------
    found : mapping of str to float
        Quantities `m g a V_0 slack P_st C_12 k_1`, SI.
    T : float or array
        s
    """
    V = LAWS["article_speed"](*(found[name] for name in ("V_0", "a", "slack", "P_st", "C_12")))
    return LAWS["article_force"](*(found[name] for name in ("m", "g", "a")), V, found["C_12"], found["k_1"], T)
