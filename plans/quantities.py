"""Quantities: what a user wants to know of a construction, by name, with units and the plan each is read from."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ..scales.display import Display
from ..scales.scale import Scale
from .board import POSITION, Program
from .names import LEVER, by_lever, is_shown, role, spelled

UNITS = {
    "V": "m/s",
    "a": "m/s^2",
    "omega": "rad/s",
    "epsilon": "rad/s^2",
    "m": "kg",
    "J": "kg*m^2",
    "G": "N",
    "F": "N",
    "R": "N",
    "M": "N*m",
    "h": "m",
    "l": "m",
    "delta": "%",
}
M_BAL, F_BAL = spelled("M", "bal"), spelled("F", "bal")
BALANCES = (M_BAL, by_lever(M_BAL), F_BAL, by_lever(F_BAL))  # what balances the driver: by plans, by the lever
RESULTS = ("read", "calc", "arm", "distance", "measure")  # verbs that make quantities
POINTS = ("place", "lay", "back", "arc", "arcs", "meet", "divide", "similar", "template", "same")


@dataclass(frozen=True, slots=True)
class Quantity:
    """A result in SI: a signed scalar, a vector with components (`value` is its magnitude), or a point (no `value`).

    `mm` is the segment that shows it on its plan at the scale factor `scale`; what is undefined is None. The moment of
    a prismatic pair's reaction is taken `about` a point, where the reaction is thought to act.
    """

    name: str
    value: float | None
    unit: str
    x: float | None = None
    y: float | None = None
    mm: float | None = None
    scale: str | None = None
    kind: str = "scalar"
    about: str | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the quantity as the command line's JSON has it."""
        item: dict[str, Any] = {"unit": self.unit}
        if self.kind != "point":
            item = {"value": self.value, **item}
        if self.kind != "scalar":
            item |= {"x": self.x, "y": self.y}
        if self.scale is not None:
            item |= {"mm": self.mm, "scale": self.scale}
        return item if self.about is None else {**item, "about": self.about}

    def shown(self, display: Display) -> Quantity:
        """Return the quantity in the units of `display`, its segment too."""
        value, x, y = (
            None if part is None else display.value(part, self.unit) for part in (self.value, self.x, self.y)
        )
        mm = None if self.mm is None else display.segment(self.mm)
        return replace(self, value=value, x=x, y=y, unit=display.unit(self.unit), mm=mm)


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity by its name."""
    if role(name).kind == "h" and role(name).part == LEVER:
        return "m/s"  # an arm on the turned velocity plan
    return UNITS.get(role(name).kind, "m")


def shown_on(program: Program) -> dict[str, str]:
    """Return for each quantity the first plan that shows it as a segment."""
    plans: dict[str, str] = {}
    for step in program:
        if step.verb == "read":
            plans.setdefault(role(step.name).shown, step.plan)
        elif step.verb == "chain":
            plans.setdefault(role(step.operands[1]).shown, step.plan)
        elif step.verb == "arm":
            plans.setdefault(step.name, "lever" if role(step.name).part == LEVER else POSITION)
    return plans


def quantities(
    program: Program, values: Mapping[str, Any], lengths: Mapping[str, float], unit: Callable[[str], str] = unit_of
) -> dict[str, Quantity]:
    """Collect the quantities of a finished exact run, in order of construction, the given `lengths` first.

    `unit` returns the SI unit of a quantity by its name.
    """
    found = {name: Quantity(name, float(size), "m") for name, size in lengths.items()}
    for step in program:
        if not is_shown(step.name):
            continue
        if step.verb in RESULTS:
            found[step.name] = _quantity(step.name, values[step.name], unit(step.name))
        elif step.verb in POINTS:
            point = values[step.name]
            found[step.name] = Quantity(step.name, None, "m", _finite(point.real), _finite(point.imag), kind="point")
    return found


def _quantity(name: str, value: Any, unit: str) -> Quantity:
    if isinstance(value, complex):
        size = None if cmath.isnan(value) else math.hypot(value.real, value.imag)
        return Quantity(name, size, unit, _finite(value.real), _finite(value.imag), kind="vector")
    return Quantity(name, _finite(value), unit)


def _finite(value: float) -> float | None:
    return float(value) + 0.0 if math.isfinite(value) else None  # + 0.0 turns -0.0 into 0.0


def measured(
    items: Mapping[str, Quantity], plans: Mapping[str, str], scales: Mapping[str, Scale]
) -> dict[str, Quantity]:
    """Return the quantities with the millimetres that show them; `scales` are by plan."""
    out = {}
    for name, item in items.items():
        plan = POSITION if role(name).kind == "l" and POSITION in scales else plans.get(name, "")
        scale = scales.get(plan)
        if scale is not None and item.kind != "point":
            mm = None if item.value is None else scale.drawn(abs(item.value))
            item = replace(item, mm=mm, scale=scale.symbol)
        out[name] = item
    return out
