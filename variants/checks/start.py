"""Checking where the task says that groups of class III start."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.linkages.mechanism import Mechanism
from ...plans.linkages.structure import TRIAD, Structure
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.units import unit
from ..toml_places import Path
from .basics import Checker, Field, array_of, link_number
from .names import Names

_M, _RAD = unit("m"), unit("rad")


def start_fields(names: Names, slides: bool) -> dict[str, Field]:
    """Return how a start is read; the driver stands at an angle, or at its travel where it `slides`."""
    place = {"x": Field(names.value(_M)), "y": Field(names.value(_M)), "angle": Field(names.value(_RAD))}
    legs = {"legs": Field(array_of(link_number, 2), required=False)}
    return {"link": Field(link_number), **place, "driver": Field(names.value(_M if slides else _RAD)), **legs}


def starts_joined(checker: Checker, mechanism: Mechanism, links: Mapping[int, object]) -> None:
    """Check that the starts are those of different links."""
    seen: dict[int, Path] = {}
    for i, start in enumerate(mechanism.starts):
        path: Path = ("mechanism", "start", i, "link")
        if start.link not in links:
            checker.fault(path, unknown("link-unknown", str(start.link), map(str, links)))
        elif start.link in seen:
            checker.twice(path, start.link, seen[start.link])
        seen.setdefault(start.link, path)


def started(checker: Checker, mechanism: Mechanism, structure: Structure) -> None:
    """Check that only central links have a start."""
    central = [group.central for group in structure.groups if group.kind == TRIAD]
    for i, start in enumerate(mechanism.starts):
        if start.link not in central:
            known = ", ".join(map(str, central))
            error = InputError("start-leg" if central else "start-link", link=start.link, known=known)
            checker.fault(("mechanism", "start", i, "link"), error)
