"""A sweep as one JSON object: everything in SI, null for what is undefined."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...plans.extremes import Extreme
from ...plans.linkages.cycles.cycle import Cycle
from ...plans.linkages.cycles.strokes import OutputMotion
from ...plans.quantities import unit_of
from .columns import driver_name, letters


def as_json(cycle: Cycle, chosen: tuple[str, ...]) -> dict[str, Any]:
    """Return the cycle as data; `chosen` points and links only, or all."""
    names = quantities_of(cycle, chosen)
    found = cycle.extremes(names)
    turns = cycle.drive.turns
    return {
        "driver": {
            "name": driver_name(cycle),
            "kind": "crank" if turns else "slider",
            "unit": "rad" if turns else "m",
            "sense": cycle.drive.sense,
            "speed": cycle.speed,
            "zero": cycle.zero,
        },
        "places": numbers(cycle.angles),
        "times": numbers(cycle.times),
        "statuses": list(cycle.statuses),
        "points": {name: _vector(cycle.values[name], "m") for name in points_of(cycle, chosen)},
        "quantities": {name: _quantity(name, cycle.values[name]) for name in names},
        "outputs": [_output(cycle, motion) for motion in cycle.motions],
        "extremes": {
            name: {"unit": unit_of(name), "max": _extreme(most), "min": _extreme(least)}
            for name, (most, least) in found.items()
        },
        "unreachable": [{"from": arc.low, "to": arc.high} for arc in cycle.reach.apart],
        "change_points": list(cycle.reach.changes),
        "parallel_guides": list(cycle.reach.poles),
    }


def points_of(cycle: Cycle, chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the points that were chosen, or all."""
    return tuple(name for name in letters(cycle.mechanism) if name in cycle.values and (not chosen or name in chosen))


def quantities_of(cycle: Cycle, chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the quantities of what was chosen, or all."""
    if not chosen:
        return cycle.quantities
    wanted = {f"{symbol}_{one}" for one in chosen for symbol in ("V", "a", "omega", "epsilon")}
    return tuple(name for name in cycle.quantities if name in wanted)


def numbers(values: Iterable[float]) -> list[float | None]:
    """Return numbers for JSON."""
    return [value + 0.0 if math.isfinite(value) else None for value in np.asarray(values).tolist()]


def _quantity(name: str, values: NDArray[Any]) -> dict[str, Any]:
    if np.iscomplexobj(values):
        size = np.hypot(values.real, values.imag)
        return {"unit": unit_of(name), "value": numbers(size), **_vector(values)}
    return {"unit": unit_of(name), "value": numbers(values)}


def _vector(values: NDArray[Any], unit: str | None = None) -> dict[str, Any]:
    head = {} if unit is None else {"unit": unit}
    return head | {"x": numbers(values.real), "y": numbers(values.imag)}


def _output(cycle: Cycle, motion: OutputMotion) -> dict[str, Any]:
    output, travel = motion.output, motion.travel
    return {
        "link": output.link,
        "kind": "slider" if output.slides else "rocker",
        "unit": output.unit,
        "places": numbers(output.places(cycle.values)) if output.place in cycle.values else None,
        "dead": [
            {"at": spot.angle, "place": spot.place, "end": "high" if spot.high else "low"} for spot in motion.dead
        ],
        "stroke": None if travel is None else travel.length,
        "low": None if travel is None else {"at": travel.angle_low, "place": travel.low},
        "high": None if travel is None else {"at": travel.angle_high, "place": travel.high},
        "time_ratio": motion.ratio,
    }


def _extreme(extreme: Extreme) -> dict[str, Any]:
    """Return an extreme value; one without bound is null."""
    return {"value": extreme.value if math.isfinite(extreme.value) else None, "at": extreme.at}
