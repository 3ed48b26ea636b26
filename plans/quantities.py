"""Quantities: what a user wants to know of a construction, by name, with units and the plan each is read from.

Their accuracy is measured by the largest vector beside each, and by the intersections behind it.
"""

from __future__ import annotations

import cmath
import math
import operator
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from numbers import Real
from typing import Any, TypeVar

from ..scales.errors import InputError
from ..scales.scale import Display, Scale
from ..scales.units import converted, parse, unit
from .board import POINTS, POSITION, Program, Step
from .boards.exact import ILL
from .names import LEVER, by_lever, is_shown, role, spelled

UNITS = {"V": "m/s", "a": "m/s^2", "omega": "rad/s", "epsilon": "rad/s^2", "m": "kg", "J": "kg*m^2", "M": "N*m"}
UNITS |= {**dict.fromkeys("GFR", "N"), **dict.fromkeys("hl", "m"), "delta": "%"}
M_BAL, F_BAL = spelled("M", "bal"), spelled("F", "bal")
BALANCES = (M_BAL, by_lever(M_BAL), F_BAL, by_lever(F_BAL))  # what balances the driver: by plans, by the lever
Of = TypeVar("Of")
RESULTS = ("read", "calc", "arm", "distance", "measure")  # verbs that make quantities
MEETING = ("meet", "arc", "arcs", "tangent")


def _beside(operate: Callable[[float, float], Of]) -> Callable[[Quantity, Any], Of]:
    """Return an operator on numbers in the unit of the first quantity."""
    return lambda own, other: operate(float(own), own._number(other))


def _times(operate: Callable[[float, float], float]) -> Callable[[Quantity, Any], float]:
    """Return an operator on bare numbers."""
    return lambda own, other: operate(float(own), float(other))


@dataclass(frozen=True, slots=True, repr=False)
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

    def __repr__(self) -> str:
        """Return name, value and unit; of a vector and a point the components, too."""
        sizes = [] if self.kind == "point" else ["–" if self.value is None else f"{self.value:.6g}"]
        if self.kind == "point" or self.x is not None:
            sizes.append("–" if self.x is None or self.y is None else f"({self.x:.6g}, {self.y:.6g})")
        return f"{self.name} = {' '.join(sizes)} {self.unit}".rstrip()

    def __float__(self) -> float:
        """Return the value, NaN where it is undefined; a point has none.

        Raises TypeError: of a point.
        """
        if self.kind == "point":
            raise TypeError(f"{self.name} is a point: it has coordinates x and y")
        return math.nan if self.value is None else self.value

    def __eq__(self, other: object) -> bool:
        """Whether the other one is the same in everything, or is its value, a number or a text with its unit."""
        if isinstance(other, Quantity):
            return all(getattr(self, name) == getattr(other, name) for name in self.__slots__)
        if not isinstance(other, (Real, str)):
            return NotImplemented
        with suppress(InputError):  # a text that says nothing of this kind
            return self.value is not None and self.value == self._number(other)
        return False

    def __hash__(self) -> int:
        """Return the hash of the value, which equals a number."""
        return hash(self.value)

    # compared with, and added to, a quantity, a text with its unit, or a number in the unit of this one
    __lt__, __gt__, __le__, __ge__ = map(_beside, (float.__lt__, float.__gt__, float.__le__, float.__ge__))
    __add__, __sub__, __rsub__ = map(_beside, (float.__add__, float.__sub__, float.__rsub__))
    # units of products and ratios are not kept
    __mul__, __truediv__, __rtruediv__ = map(_times, (float.__mul__, float.__truediv__, float.__rtruediv__))
    __radd__, __rmul__ = __add__, __mul__
    __pow__, __rpow__ = _times(operator.pow), _times(lambda own, other: operator.pow(other, own))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """Return the value as numpy takes it: `numpy.sqrt(quantity)` is a number."""
        import numpy as np  # which plain solutions do without

        return np.asarray(float(self), dtype)

    def __neg__(self) -> float:
        """Return the value with the other sign."""
        return -float(self)

    def __abs__(self) -> float:
        """Return the size of the value."""
        return abs(float(self))

    def __round__(self, digits: int | None = None) -> float:
        """Return the value, rounded as a number is: to so many digits behind the point, to a whole one without any."""
        return round(float(self), digits)

    def _number(self, other: Any) -> float:
        """Return in the unit of this quantity what is added to it, or compared with it."""
        if isinstance(other, str):
            return unit(self.unit).from_si(parse(other, unit(self.unit)))
        return float(other.to(self.unit)) if isinstance(other, Quantity) else float(other)

    def __format__(self, spec: str) -> str:
        """Return the value, of a point its coordinates, as numbers are formatted, with the unit.

        >>> f"{Quantity('V_B', 2.7614, 'm/s'):.2f}"
        '2.76 m/s'
        """
        if not spec:
            return repr(self)
        parts = (self.x, self.y) if self.kind == "point" else (self.value,)
        sizes = ", ".join("–" if part is None else format(part, spec) for part in parts)
        return f"{f'({sizes})' if self.kind == 'point' else sizes} {self.unit}"

    def to(self, of: str) -> Quantity:
        """Return the quantity in another unit, `"mm/s"`.

        Raises InputError: a unit that is not known, or is one of something else.
        """
        own, one = unit(self.unit), converted(1.0, unit(of), unit(self.unit))
        value, x, y = (None if part is None else own.to_si(part) / one for part in (self.value, self.x, self.y))
        return replace(self, value=value, x=x, y=y, unit=unit(of).name)

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
        name, value = step.name, values[step.name]
        if step.verb in POINTS:
            found[name] = Quantity(name, None, "m", _finite(value.real), _finite(value.imag), kind="point")
        elif step.verb in RESULTS and isinstance(value, complex):
            size = None if cmath.isnan(value) else math.hypot(value.real, value.imag)
            found[name] = Quantity(name, size, unit(name), _finite(value.real), _finite(value.imag), kind="vector")
        elif step.verb in RESULTS:
            found[name] = Quantity(name, _finite(value), unit(name))
    return found


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


def results(program: Program) -> tuple[Step, ...]:
    """Return the steps that make quantities that a user sees, points among them."""
    verbs = (*RESULTS, *POINTS)
    return program.once(
        "results", lambda: tuple(step for step in program if step.verb in verbs and is_shown(step.name))
    )


def references(program: Program, values: Mapping[str, Any]) -> dict[str, float]:
    """Return for each quantity the size beside which its error counts, in its unit.

    That is the largest vector of the plan that shows it, the size of the mechanism on its own plan, for points too; for
    a number that no plan shows the largest one of its unit, and for per cents a hundred.
    """
    plans, found = plans_of(program), {}
    largest: dict[str, float] = {POSITION: extent(program, values)}
    for step in results(program):
        found[step.name] = key = plans.get(step.name) or unit_of(step.name)
        if step.verb not in POINTS:
            size = abs(values[step.name])
            if math.isfinite(size):
                largest[key] = max(largest.get(key, 0.0), float(size))
    return {name: 100.0 if key == "%" else largest.get(key, 0.0) for name, key in found.items()}


def plans_of(program: Program) -> Mapping[str, str]:
    """Return for each quantity the plan that shows it, points and measured lengths among them."""
    here = (*POINTS, "distance", "measure")
    points = (step.name for step in results(program) if step.verb in here)
    return program.once("plans", lambda: shown_on(program) | dict.fromkeys(points, POSITION))


def extent(program: Program, values: Mapping[str, Any]) -> float:
    """Return the longest distance between lettered points of the mechanism, m."""
    places = [values[step.name] for step in results(program) if step.verb in POINTS]
    return max((size for a in places for b in places if (size := abs(a - b)) == size), default=0.0)


def intersections(program: Program, sines: Mapping[str, float]) -> dict[str, float]:
    """Return the sine of the lines, or of line and arc, at each step that makes them meet; zero where they do not.

    A board looks at two directions once: lines along the same two meet at the same angle on every plan.
    """
    by_lines = {step.operands[1::2]: sines[step.name] for step in program if step.verb == "meet" and step.name in sines}
    found: dict[str, float] = {}
    for step in program:
        sine = by_lines.get(step.operands[1::2]) if step.verb == "meet" else sines.get(step.name)
        if sine is not None or step.verb in MEETING:
            found[step.name] = float(sine) if sine == sine and sine is not None else 0.0
    return found


def point_of(program: Program, mark: str) -> str:
    """Return the mark at which a meeting is seen: a tangent finds the direction of a line through its second point."""
    step = program.by_name[mark]
    return step.operands[1] if step.verb == "tangent" else mark


def pins_together(program: Program, values: Mapping[str, Any], mark: str) -> tuple[str, str] | None:
    """Return the two joints that settle a direction badly because they nearly coincide, None for lines that do."""
    step = program.by_name[mark]
    if step.verb != "tangent":
        return None
    first, second, *_, size = step.operands
    return (first, second) if abs(values[second] - values[first]) < ILL * values[size] else None


def worst_behind(
    program: Program, sines: Mapping[str, float], counts: Callable[[Step, str], bool] = lambda step, operand: True
) -> dict[str, float]:
    """Return for every name the least sine of all intersections that it hangs on, one where there are none.

    `sines` are as an exact board gives them; `counts` tells whether a step inherits from an operand.
    """
    own = intersections(program, sines)
    worst: dict[str, float] = {}
    for name, operands in program.counting(counts):
        least = own.get(name, 1.0)
        for operand in operands:
            if (sine := worst.get(operand, 1.0)) < least:
                least = sine
        worst[name] = least if least < 1.0 else 1.0
    return worst
