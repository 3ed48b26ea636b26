"""Forms of a mechanism in which only its geometry speaks: without loads, with a driver at unit speed."""

from __future__ import annotations

from dataclasses import replace

from .mechanism import Driver, Mechanism


def at_unit_speed(mechanism: Mechanism) -> Mechanism:
    """Return the mechanism with a driver that moves by one radian or metre a second in the positive sense, steadily."""
    driver = mechanism.driver
    if isinstance(driver, Driver):
        return replace(mechanism, driver=replace(driver, speed="one", sense="one", acceleration=None))
    return replace(mechanism, driver=replace(driver, speed="one", acceleration=None))


def without_loads(mechanism: Mechanism) -> Mechanism:
    """Return the mechanism as its geometry alone."""
    return replace(mechanism, loads=(), couples=(), diagrams=(), gravity=None)
