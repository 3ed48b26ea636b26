"""Checking what follows from links and pairs together: where a fault of the structure shows, which side is meant."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...plans.linkages.mechanism import BOTH, WORKING, Couple, Diagram, Load, Mechanism, Pair, Prismatic, Revolute
from ...plans.linkages.structure import TRIAD, Structure
from ...scales.errors import InputError
from ..toml_places import Path
from .basics import Checker


def place_of(mechanism: Mechanism, error: InputError) -> Path:
    """Return where an error of the structure shows: the load or the first link that it names, or the point."""
    loads: dict[str, Sequence[Load | Couple | Diagram]] = {
        "load": mechanism.loads,
        "couple": mechanism.couples,
        "diagram": mechanism.diagrams,
    }
    for kind, rows in loads.items():
        for i, row in enumerate(rows):
            timed = getattr(row, "stroke", WORKING) != BOTH  # all diagrams over a stroke are
            if row.name == error.data.get("name") or (timed and error.key == "stroke-missing"):
                return "mechanism", kind, i
    named = re.search("[0-9]+", str(error.data.get("link", error.data.get("links", ""))).replace("0, ", "", 1))
    for i, link in enumerate(mechanism.links):
        if named and link.number == int(named[0]):
            return "mechanism", "link", i
    point = error.data.get("name", error.data.get("point"))
    holders = [i for i, link in enumerate(mechanism.links) if point in link.points]
    return ("mechanism", "link", holders[-1], "points", str(point)) if holders else ("mechanism",)


def branched(checker: Checker, mechanism: Mechanism, structure: Structure) -> None:
    """Check that every dyad of three revolute pairs says on which side its inner pair lies."""
    for group in structure.groups:
        if group.kind == "RRR" and group.inner[0].branch is None:
            point = group.inner[0].point
            number = next(i for i, p in enumerate(mechanism.pairs) if isinstance(p, Revolute) and p.point == point)
            ends = sorted(zip(group.links, group.outer, strict=True))
            data = {"links": ", ".join(map(str, sorted(group.links))), "point": point}
            error = InputError("branch-missing", start=ends[0][1].point, end=ends[1][1].point, **data)
            checker.fault(("mechanism", "pair", number), error)


def needless_branches(checker: Checker, mechanism: Mechanism, structure: Structure) -> None:
    """Check that only pairs at which there are two ways to go on say which is meant."""
    pins = {group.inner[0].point for group in structure.groups if group.kind == "RRR"}
    two_ways = [group for group in structure.groups if group.kind in ("RRP", "RPR")]
    guides = [pair for group in two_ways for pair in (*group.inner, *group.outer) if isinstance(pair, Prismatic)]
    for i, pair in enumerate(mechanism.pairs):
        meant = pair.point in pins if isinstance(pair, Revolute) else pair in guides
        if pair.branch is not None and not meant:
            error = InputError("branch-triad" if _in_triad(structure, pair) else "branch-needless", point=pair.point)
            checker.fault(("mechanism", "pair", i, "branch"), error)


def _in_triad(structure: Structure, pair: Pair) -> bool:
    triads = [group for group in structure.groups if group.kind == TRIAD]
    return any(pair.point == other.point for group in triads for other in (*group.inner, *group.outer))
