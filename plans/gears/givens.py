"""The givens of a gear pair made complete: the standard rack, the shifts; and what cannot be, told.

Of x_1, x_2 two fix the pair, or one of them with a_w or x_sum. Of a_w or x_sum alone the shifts follow by which both
wheels slide alike: the specific sliding at the root of the pinion, theta_12 at A1, equals that at the root of the
wheel, theta_21 at A2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...scales.errors import InputError
from ..laws import LAWS
from .gear import SHIFTS, STANDARD, WHEELS, impossible
from .geometry import geometry
from .teeth import tooth_of

HALVINGS = 200
BALANCE = ("theta_12_A1", "theta_21_A2")
BASIC = ("a", "x_sum", "a_w", "alpha_w", "inv_alpha", "inv_alpha_w")


def complete(values: Mapping[str, float]) -> dict[str, float]:
    """Return the givens with the standard rack where nothing else is given, and with both shifts.

    The `values` are `m z_1 z_2` and, of `x_1 x_2 x_sum a_w`, what fixes the shifts; what `STANDARD` has may be missing.

    Raises
    ------
    InputError
        Numbers of which no pair can be made: the wheels, the rack, the shifts, the teeth, the meshing.
    """
    found = {**STANDARD, **values}
    for _, error in impossible(found):
        raise error
    x_1, x_2 = shifts(found)
    given = ", ".join(name for name in SHIFTS if name in found)
    found = {name: float(value) for name, value in found.items() if name not in SHIFTS} | {"x_1": x_1, "x_2": x_2}
    _meshes(found, given if given != "x_1, x_2" else "")
    return found


def shifts(values: Mapping[str, float]) -> tuple[float, float]:
    """Return x_1 and x_2 of a pair of which those are given, or one and a_w or x_sum, or one of the latter alone."""
    match given := tuple(name for name in SHIFTS if name in values):
        case ("x_1", "x_2"):
            return float(values["x_1"]), float(values["x_2"])
        case ("x_1", "x_sum" | "a_w"):
            return float(values["x_1"]), sum_of_shifts(values) - values["x_1"]
        case ("x_2", "x_sum" | "a_w"):
            return sum_of_shifts(values) - values["x_2"], float(values["x_2"])
        case ("x_sum" | "a_w",):
            return balanced(values, sum_of_shifts(values))
    raise InputError("gear-shifts", given=", ".join(given) or "-")


def sum_of_shifts(values: Mapping[str, float]) -> float:
    """Return x_1 + x_2 of a pair with given x_sum, or a_w, for which the base circles must leave room."""
    if "x_sum" in values:
        return float(values["x_sum"])
    z_1, z_2, alpha, a_w = (values[name] for name in ("z_1", "z_2", "alpha", "a_w"))
    a = LAWS["reference_centre"](values["m"], z_1, z_2)
    least = LAWS["base_diameter"](a, alpha)
    if not a_w > least:
        raise InputError("gear-centre", a_w=f"{a_w * 1e3:.7g}", least=f"{least * 1e3:.7g}")
    inv, inv_w = (LAWS["involute"](angle) for angle in (alpha, LAWS["working_angle"](a, alpha, a_w)))
    return float(LAWS["sum_of_shifts"](z_1, z_2, alpha, inv, inv_w))


def balanced(values: Mapping[str, float], x_sum: float) -> tuple[float, float]:
    """Return x_1 and x_2 with the given sum by which both wheels slide alike.

    The larger x_1 is, the nearer A1 is to the pole and the farther A2: theta_12 at A1 only rises, theta_21 at A2 only
    falls, between the shifts that put A1 into N1 and A2 into N2; there may be none between.
    """
    least, most = _between(values, x_sum)
    low, high = least, most
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        found = geometry({**values, "x_1": middle, "x_2": x_sum - middle}, BALANCE)
        low, high = (middle, high) if found[BALANCE[0]] < found[BALANCE[1]] else (low, middle)
    if not least < low < high < most:
        raise InputError("gear-no-balance", x_sum=f"{x_sum:.6g}")
    return low, x_sum - low


def _between(values: Mapping[str, float], x_sum: float) -> tuple[float, float]:
    """Return the x_1 that puts A1 into N1, and that which puts A2 into N2."""
    wanted = ("l_N1N2", "d_b1", "d_b2", "d_a1", "d_a2", "alpha_w")
    found = geometry({**values, "x_1": 0.0, "x_2": x_sum}, wanted)
    if not found["alpha_w"] > 0.0:
        raise _no_mesh(values, x_sum)
    most = [math.hypot(2.0 * found["l_N1N2"], found[f"d_b{i}"]) - found[f"d_a{i}"] for i in WHEELS]
    return -0.5 * most[1] / values["m"], 0.5 * most[0] / values["m"]


def _meshes(values: Mapping[str, float], given: str) -> None:
    """Look whether the wheels have teeth, and whether these can touch; `given` is what the shifts are found by."""
    found = geometry(values, BASIC)
    if not found["inv_alpha_w"] > 0.0:
        raise _no_mesh(values, found["x_sum"])
    for i in WHEELS:
        if not tooth_of(values, i).whole:
            said = {"name": f"x_{i}", "text": f"{values[f'x_{i}']:.6g}", "wheel": i}
            found_by = {"given": given} if given else {}
            raise InputError("gear-no-tooth-found" if given else "gear-no-tooth", **found_by, **said)
    line = geometry(values, ("g_alpha",))["g_alpha"]
    if not line > 0.0:
        raise InputError("gear-no-contact", gap=f"{-line * 1e3:.4g}")


def _no_mesh(values: Mapping[str, Any], x_sum: float) -> InputError:
    """Return the error of a sum of shifts by which the centres come nearer than the base circles allow."""
    z_1, z_2, alpha = (values[name] for name in ("z_1", "z_2", "alpha"))
    least = float(LAWS["sum_of_shifts"](z_1, z_2, alpha, LAWS["involute"](alpha), np.float64(0.0)))
    return InputError("gear-no-mesh", x_sum=f"{x_sum:.6g}", least=f"{least:.4g}")
