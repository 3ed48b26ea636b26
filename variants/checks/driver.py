"""Checking the driver of a mechanism: a crank on a pivot of the frame, or a slider on a guide of the frame."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.linkages.mechanism import FORCE, FRAME, MOMENT, ZERO, Driver, Mechanism, Revolute, SlidingDriver
from ...scales.errors import InputError
from ...scales.units import unit
from ..task import Bound
from ..toml_places import Path
from .basics import Checker, Field, link_number, name, on_link, one_of, record
from .names import Names

_RAD, _RAD_S, _RAD_S2 = unit("rad"), unit("rad/s"), unit("rad/s^2")
_M, _M_S, _M_S2 = unit("m"), unit("m/s"), unit("m/s^2")
_PATH: Path = ("mechanism", "driver")


def read_driver(checker: Checker, path: Path, raw: object, names: Names) -> Driver | SlidingDriver | None:
    """Read the only driver; it moves. A key `travel` tells one that slides."""
    if isinstance(raw, list):
        checker.fault(path, InputError("driver-twice"))
        return None
    before = len(checker.faults)
    slides = isinstance(raw, dict) and "travel" in raw
    read = record(checker, path, raw, (_sliding if slides else _turning)(names))
    if read.get("speed") == ZERO:
        checker.fault((*path, "speed"), InputError("is-zero" if slides else "not-positive", text="0"))
    if len(checker.faults) > before:
        return None
    names.bounds.setdefault(read["speed"], Bound.NOT_ZERO if slides else Bound.POSITIVE)
    return SlidingDriver(**read) if slides else Driver(**read)


def _turning(names: Names) -> dict[str, Field]:
    return {
        "link": Field(link_number),
        "pivot": Field(name),
        "point": Field(name),
        "angle": Field(names.value(_RAD)),
        "speed": Field(names.value(_RAD_S)),
        "sense": Field(names.sign),
        "acceleration": Field(names.value(_RAD_S2), required=False),
        "balance": Field(one_of("balance-unknown", lambda: (MOMENT, FORCE)), required=False),
    }


def _sliding(names: Names) -> dict[str, Field]:
    return {
        "link": Field(link_number),
        "point": Field(name),
        "travel": Field(names.value(_M)),
        "speed": Field(names.value(_M_S)),
        "acceleration": Field(names.value(_M_S2), required=False),
    }


def driver_joined(checker: Checker, mechanism: Mechanism, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check that the driver carries its point, and that a crank turns on the frame about another one, its pivot."""
    driver = mechanism.driver
    before = len(checker.faults)
    on_link(checker, _PATH, "point", driver.point, driver.link, links)
    if not isinstance(driver, Driver):
        return
    on_link(checker, _PATH, "pivot", driver.pivot, driver.link, links)
    if len(checker.faults) > before:
        return
    joints = [pair for pair in mechanism.pairs if isinstance(pair, Revolute) and pair.point == driver.pivot]
    if not {FRAME, driver.link} <= {number for pair in joints for number in pair.links}:
        checker.fault((*_PATH, "pivot"), InputError("driver-pivot", text=driver.pivot, link=driver.link))
    elif driver.point == driver.pivot:
        checker.fault((*_PATH, "point"), InputError("driver-point", text=driver.point))
