"""A cycle as columns of numbers: one real array each, with its name and unit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...plans.linkages.cycles.cycle import Cycle
from ...plans.linkages.cycles.strokes import Output
from ...plans.linkages.mechanism import Mechanism
from ...plans.names import role
from ...plans.quantities import BALANCES, unit_of
from ...scales.display import Display
from ...scales.units import unit

Array = NDArray[Any]


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One column: values in SI and their unit."""

    name: str
    unit: str
    values: Array

    def shown(self, display: Display) -> Column:
        """Return the column in the units of `display`, angles in degrees."""
        in_degrees: Callable[[Any], Any] = unit("deg").from_si
        if self.unit == "rad":
            return Column(self.name, "deg", in_degrees(self.values))
        as_shown: Callable[[Any, str], Any] = display.value
        return Column(self.name, display.unit(self.unit), as_shown(self.values, self.unit))


def driver_column(cycle: Cycle) -> Column:
    """Return where the driver stands: an angle within a turn, or a travel."""
    name = driver_name(cycle)
    if not cycle.drive.turns:
        return Column(name, "m", cycle.angles)
    turn = 2.0 * np.pi
    within = cycle.angles % turn
    return Column(name, "rad", np.where(np.abs(within - turn) < 1e-12, 0.0, within))


def driver_name(cycle: Cycle) -> str:
    """Return the name of the driver's variable, `phi` or `s` where the task has a literal in its place."""
    variable = cycle.drive.variable
    return ("phi" if cycle.drive.turns else "s") if role(variable).hidden else variable


def place_name(output: Output) -> str:
    """Return the name of an output's place: the travel of a slider, the angle of a rocker."""
    return f"{'s' if output.slides else 'phi'}_{output.link}"


def output_columns(cycle: Cycle, output: Output) -> list[Column]:
    """Return place, velocity and acceleration of a link on the frame, as far as the plans go."""
    if output.place not in cycle.values:
        return []
    place = Column(place_name(output), output.unit, output.places(cycle.values))
    rates = [(output.rate, "V", "m/s"), (output.change, "a", "m/s^2")]
    if not output.slides:
        rates = [(output.rate, "omega", "rad/s"), (output.change, "epsilon", "rad/s^2")]
    found = ((f"{symbol}_{output.link}", of, cycle.values.get(name or "")) for name, symbol, of in rates)
    return [place, *(Column(name, of, values) for name, of, values in found if values is not None)]


def quantity_columns(name: str, values: Array, point: bool = False) -> Iterator[Column]:
    """Go through the columns of a quantity: of a vector its size and components, of a point its coordinates."""
    of = unit_of(name)
    if not np.iscomplexobj(values):
        yield Column(name, of, values)
        return
    if not point:
        yield Column(name, of, np.hypot(values.real, values.imag))
    yield Column(f"{name}.x", of, values.real)
    yield Column(f"{name}.y", of, values.imag)


def all_columns(cycle: Cycle) -> list[Column]:
    """Return columns of the links on the frame, of all points and of all quantities."""
    columns = [column for output in cycle.outputs for column in output_columns(cycle, output)]
    seen = {column.name for column in columns}
    points = [name for name in letters(cycle.mechanism) if name in cycle.values]
    for name in (*points, *cycle.quantities):
        if name not in seen:
            columns += quantity_columns(name, cycle.values[name], name in points)
    return columns


def main_columns(cycle: Cycle) -> list[Column]:
    """Return the columns of a readable table: how the outputs move, and what balances the driver."""
    columns = [column for output in cycle.outputs for column in output_columns(cycle, output)]
    balance = next((name for name in BALANCES if name in cycle.values), None)
    return columns + (list(quantity_columns(balance, cycle.values[balance])) if balance else [])


def chosen_columns(cycle: Cycle, chosen: tuple[str, ...]) -> list[Column]:
    """Return the columns of points, by their letters, and of links, by their numbers."""
    columns: list[Column] = []
    outputs = {str(output.link): output for output in cycle.outputs}
    for one in chosen:
        if one in outputs:
            columns += output_columns(cycle, outputs[one])
        for name in (one, f"V_{one}", f"a_{one}", f"omega_{one}", f"epsilon_{one}"):
            if name in cycle.values and all(column.name != name for column in columns):
                columns += quantity_columns(name, cycle.values[name], name == one)
    return columns


def letters(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the letters of all points."""
    points = (point for link in mechanism.links for point in link.points)
    return tuple(dict.fromkeys((*mechanism.frame_points, *points)))
