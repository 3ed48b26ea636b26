"""The driver's variable: what is swept, alone and at unit speed, so that only the geometry of the mechanism speaks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from .mechanism import ZERO, Driver, Mechanism

OWN = "_driver"  # the driver's variable where the mechanism has a literal in its place


@dataclass(frozen=True, slots=True)
class Swept:
    """A mechanism whose driver's variable may be swept: an angle that turns round, or the travel of a slide."""

    mechanism: Mechanism
    variable: str
    turns: bool
    start: float  # the variable's value as given
    sense: float  # of the driver's motion, +1 or -1


def swept(mechanism: Mechanism, values: Mapping[str, float]) -> Swept:
    """Return `mechanism` ready for a sweep.

    A literal may stand in other places too, so that the driver gets a variable of its own; a given that also stands
    elsewhere, as the direction of a load, changes there as well.
    """
    driver = mechanism.driver
    turns = isinstance(driver, Driver)
    name = driver.angle if isinstance(driver, Driver) else driver.travel
    start = float(values.get(name, 0.0))
    sense = values.get(driver.sense, 1.0) if isinstance(driver, Driver) else values.get(driver.speed, 1.0)
    if name == ZERO or name.startswith("_"):
        name = OWN
        key = "angle" if turns else "travel"
        mechanism = replace(mechanism, driver=replace(driver, **{key: name}))  # type: ignore[arg-type]
    return Swept(mechanism, name, turns, start, -1.0 if sense < 0.0 else 1.0)


def at_unit_speed(mechanism: Mechanism) -> Mechanism:
    """Return the mechanism with a driver that moves by one radian or metre a second in the positive sense, steadily."""
    driver = mechanism.driver
    if isinstance(driver, Driver):
        return replace(mechanism, driver=replace(driver, speed="one", sense="one", acceleration=None))
    return replace(mechanism, driver=replace(driver, speed="one", acceleration=None))


def without_loads(mechanism: Mechanism) -> Mechanism:
    """Return the mechanism as its geometry alone."""
    return replace(mechanism, loads=(), couples=(), diagrams=(), gravity=None)
