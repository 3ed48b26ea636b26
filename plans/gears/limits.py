"""What no gear pair can have among its numbers, seen at these alone: wheels, rack, which shifts are given."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ...scales.errors import InputError
from .gear import SHIFTS, STANDARD, WHEELS

FEWEST = 3  # teeth
MOST = 10_000
ALPHA = math.radians(10.0), math.radians(35.0)
NEAR = 1e-12  # by which a limit may be passed: rounding
FIXED_BY = (
    *(("x_1", "x_2"), ("x_1", "x_sum"), ("x_1", "a_w"), ("x_2", "x_sum"), ("x_2", "a_w")),
    *(("x_sum",), ("a_w",)),
)


def impossible(values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
    """Go through what cannot be, each with the name of the number that is told of.

    Parameters
    ----------
    values : mapping of str to float
        In SI; what `STANDARD` has may be left out.
    """
    found = {**STANDARD, **values}
    yield from _wheels(found)
    yield from _rack(found)
    given = tuple(name for name in SHIFTS if name in found)
    if given not in FIXED_BY:
        yield (given or SHIFTS)[0], InputError("gear-shifts", given=", ".join(given) or "-")
    for name in given:
        if not math.isfinite(found[name]):
            yield name, InputError("gear-shifts", given=", ".join(given))


def _wheels(values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
    m = values["m"]
    if not (math.isfinite(m) and m > 0.0):
        yield "m", InputError("gear-module", text=f"{m * 1e3:.7g}")
    for i in WHEELS:
        z = values[f"z_{i}"]
        if not (math.isfinite(z) and FEWEST <= z <= MOST and z == round(z)):
            yield f"z_{i}", InputError("gear-teeth", name=f"z_{i}", text=f"{z:.7g}", least=FEWEST, most=MOST)


def _rack(values: Mapping[str, float]) -> Iterator[tuple[str, InputError]]:
    """Look at the rack: its angle, and that its tooth has a tip, a straight edge and room for a corner."""
    alpha, h_a, h_l, c = (values[name] for name in ("alpha", "h_a", "h_l", "c"))
    if not ALPHA[0] - NEAR <= alpha <= ALPHA[1] + NEAR:
        low, high = (f"{math.degrees(angle):.0f}" for angle in ALPHA)
        yield "alpha", InputError("gear-alpha", text=f"{math.degrees(alpha):.7g}", low=low, high=high)
        return
    depth = h_a + c
    widest = 0.25 * math.pi / math.tan(alpha)
    holds = {
        "c": c >= 0.0,
        "h_a": h_a > 0.0 and depth <= widest + NEAR,
        "h_l": h_a < h_l <= h_a + depth + NEAR,
    }
    wrong = next((name for name, right in holds.items() if not right), "")
    if wrong:
        said = {"h_a": f"{h_a:.6g}", "h_l": f"{h_l:.6g}", "c": f"{c:.6g}", "most": f"{widest:.4g}"}
        yield wrong, InputError("gear-rack", **said)
