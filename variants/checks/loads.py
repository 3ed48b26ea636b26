"""Checking loads, couples, load diagrams and the stroke of a mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ...plans.linkages.loads import in_order, output_pair
from ...plans.linkages.mechanism import (
    ANGLE,
    BOTH,
    FRAME,
    IDLE,
    STROKE,
    WORKING,
    Couple,
    Diagram,
    Load,
    Mechanism,
    SlidingDriver,
    Stroke,
)
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.units import ONE, unit
from ..toml_places import Path
from .basics import Checker, Field, array_of, link_number, name, on_link, one_of, record
from .names import Names

_RAD, _N, _N_M = unit("rad"), unit("N"), unit("N*m")
_STROKE = one_of("stroke-unknown", lambda: (BOTH, WORKING, IDLE))
_OVER = one_of("diagram-over", lambda: (STROKE, ANGLE))


def read_load(checker: Checker, path: Path, raw: object, names: Names) -> Load | None:
    """Read a force; without a direction it resists the motion of its point."""
    places = {"name": Field(name), "link": Field(link_number), "point": Field(name)}
    size = {"magnitude": Field(names.value(_N)), "direction": Field(names.value(_RAD), required=False)}
    read = _read(checker, path, raw, names, places | size)
    return Load(**read) if read else None


def read_couple(checker: Checker, path: Path, raw: object, names: Names) -> Couple | None:
    """Read a moment; without a sense it resists the turning of its link."""
    places = {"name": Field(name), "link": Field(link_number)}
    size = {"magnitude": Field(names.value(_N_M)), "sense": Field(names.sign, required=False)}
    read = _read(checker, path, raw, names, places | size)
    return Couple(**{"sense": None, **read}) if read else None


def _read(
    checker: Checker, path: Path, raw: object, names: Names, fields: Mapping[str, Field]
) -> dict[str, Any] | None:
    """Read a load that may act in one stroke; a literal magnitude is called like the load."""
    before = len(checker.faults)
    read = record(checker, path, raw, {**fields, "stroke": Field(_STROKE, required=False)})
    if len(checker.faults) > before:
        return None
    return {**read, "magnitude": names.called(read["name"], read["magnitude"])}


def read_stroke(checker: Checker, path: Path, raw: object, names: Names) -> Stroke | None:
    """Read which link is the output, and which way it works."""
    read = record(checker, path, raw, {"link": Field(link_number), "sense": Field(names.sign, required=False)})
    return Stroke(**read) if "link" in read else None


def read_diagrams(checker: Checker, rows: list[tuple[Path, object]], names: Names) -> list[Diagram]:
    """Read the load diagrams; from then on their names are those of forces or moments."""
    found = [(path, _diagram(checker, path, row, names)) for path, row in rows]
    for (path, row), (_, made) in zip(rows, found, strict=True):
        if made is None and isinstance(row, dict) and isinstance(row.get("name"), str):
            names.dimensions.setdefault(row["name"], None)
            names.stated.setdefault(row["name"], (*path, "name"))
    diagrams = [(path, *made) for path, made in found if made is not None]
    for path, diagram, wanted in diagrams:
        if diagram.name in names.dimensions:
            checker.twice((*path, "name"), diagram.name, names.stated[diagram.name])
        names.dimensions[diagram.name] = wanted
        names.stated.setdefault(diagram.name, (*path, "name"))
    return [diagram for _, diagram, _ in diagrams]


def _diagram(checker: Checker, path: Path, raw: object, names: Names) -> tuple[Diagram, Any] | None:
    over = raw.get("over") if isinstance(raw, dict) else None
    first = raw.get("values") if isinstance(raw, dict) else None
    moment = isinstance(first, list) and any(names.dimension_of(value) == _N_M.dimension for value in first)
    wanted = _N_M if moment else _N
    sizes = array_of(names.value(wanted))
    fields = {
        "name": Field(name),
        "over": Field(_OVER),
        "at": Field(array_of(names.value(_RAD if over == ANGLE else ONE))),
        "values": Field(sizes),
        "back": Field(sizes, required=False),
    }
    before = len(checker.faults)
    read = record(checker, path, raw, fields)
    if len(checker.faults) > before:
        return None
    diagram = Diagram(**read)
    for key in ("values", "back"):
        if key in read and len(read[key]) != len(diagram.at):
            checker.fault((*path, key), InputError("diagram-uneven", n=len(diagram.at), m=len(read[key])))
    if diagram.back and over == ANGLE:
        checker.fault((*path, "back"), InputError("diagram-back"))
    return (diagram, wanted.dimension) if len(checker.faults) == before else None


def diagrams_in_order(checker: Checker, mechanism: Mechanism, rows: Sequence[Mapping[str, float]]) -> None:
    """Check that the places of load diagrams do not decrease, and lie within the stroke or a turn, in any variant."""
    for i, diagram in enumerate(mechanism.diagrams):
        try:
            for values in rows:
                in_order(diagram, values)
        except InputError as error:
            checker.fault(("mechanism", "diagram", i, "at"), error)


def loads_joined(
    checker: Checker, mechanism: Mechanism, names: Names, links: Mapping[int, Mapping[str, object]]
) -> None:
    """Check that loads and couples act on links, forces at their points, each under a name of its own."""
    seen: dict[str, Path] = {}
    sizes = {name for diagram in mechanism.diagrams for name in (diagram.name, *diagram.sizes)}
    sizes |= {load.magnitude for load in mechanism.acting}
    placed: list[tuple[Path, Load | Couple]] = [
        *((("mechanism", "load", i), load) for i, load in enumerate(mechanism.loads)),
        *((("mechanism", "couple", i), couple) for i, couple in enumerate(mechanism.couples)),
    ]
    for path, load in placed:
        if load.link == FRAME:
            checker.fault((*path, "link"), InputError("load-frame", known=", ".join(map(str, links))))
        elif isinstance(load, Load):
            on_link(checker, path, "point", load.point, load.link, links)
        elif load.link not in links:
            checker.fault((*path, "link"), unknown("link-unknown", str(load.link), map(str, links)))
        if load.name in seen:
            checker.twice((*path, "name"), load.name, (*seen[load.name], "name"))
        elif load.name in names.dimensions and load.name not in sizes:
            line, _ = checker.places[names.stated[load.name]]
            checker.fault((*path, "name"), InputError("load-given", name=load.name, line=line))
        seen.setdefault(load.name, path)


def output_joined(checker: Checker, mechanism: Mechanism) -> None:
    """Check that the output link moves on the frame, and that a diagram over an angle has a crank."""
    if mechanism.stroke is not None:
        try:
            output_pair(mechanism)
        except InputError as error:
            checker.fault(("mechanism", "stroke", "link"), error)
    for i, diagram in enumerate(mechanism.diagrams):
        if diagram.over == ANGLE and isinstance(mechanism.driver, SlidingDriver):
            checker.fault(("mechanism", "diagram", i, "over"), InputError("diagram-crank"))
