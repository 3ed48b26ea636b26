"""Checking the mechanism of a task: every name is known and of the right dimension, every pair joins what it says."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...plans.linkages.mechanism import FRAME, ZERO, Link, Mechanism, Pair, Prismatic, Revolute, Start, positive
from ...plans.linkages.structure import analyse
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.units import ONE, unit
from ..task import Bound
from ..toml_places import Path
from .basics import Checker, Field, Read, array_of, link_number, name, on_link, one_of, record, rows
from .driver import driver_joined, read_driver
from .loads import loads_joined, output_joined, read_couple, read_diagrams, read_load, read_stroke
from .names import Names
from .start import start_fields, starts_joined
from .structure import place_of

_RAD, _M_S2 = unit("rad"), unit("m/s^2")
_KG, _KG_M2, _KG_M = unit("kg"), unit("kg*m^2"), unit("kg/m")


def read_mechanism(checker: Checker, raw: object, names: Names) -> Mechanism | None:
    """Read `[mechanism]`; `None` when a part of it is at fault."""
    before = len(checker.faults)
    kinds = {
        "gravity": Field(names.value(_M_S2), required=False),
        "link": Field(_rows(lambda c, p, r: _link(c, p, r, names))),
        "pair": Field(_rows(lambda c, p, r: _pair(c, p, r, names))),
        "driver": Field(lambda c, p, r: read_driver(c, p, r, names)),
        "stroke": Field(lambda c, p, r: read_stroke(c, p, r, names), required=False),
        # before the loads that name them
        "diagram": Field(lambda c, p, r: read_diagrams(c, rows(c, p, r), names), required=False),
        "load": Field(_rows(lambda c, p, r: read_load(c, p, r, names)), required=False),
        "couple": Field(_rows(lambda c, p, r: read_couple(c, p, r, names)), required=False),
    }
    slides = isinstance(raw, dict) and isinstance(raw.get("driver"), dict) and "travel" in raw["driver"]
    starts = start_fields(names, slides)
    kinds["start"] = Field(_rows(lambda c, p, r: record(c, p, r, starts)), required=False)
    read = record(checker, ("mechanism",), raw, kinds)
    if len(checker.faults) > before:
        return None
    mechanism = Mechanism(
        tuple(read["link"]),
        tuple(read["pair"]),
        read["driver"],
        tuple(read.get("load", ())),
        tuple(read.get("couple", ())),
        tuple(read.get("diagram", ())),
        read.get("stroke"),
        names.called("g", read.get("gravity")),
        tuple(Start(**x) for x in read.get("start", ())),
    )
    _joined(checker, mechanism, names)
    return mechanism if len(checker.faults) == before else None


def _rows(read: Callable[[Checker, Path, object], Any]) -> Read:
    """Return a reader of an array of tables, one at a time."""
    return lambda checker, path, raw: [read(checker, row_path, row) for row_path, row in rows(checker, path, raw)]


def _link(checker: Checker, path: Path, raw: object, names: Names) -> Link | None:
    """Read one link; a point on a local axis lies at a distance, which must be greater than zero."""

    def points(checker: Checker, path: Path, raw: object) -> dict[str, tuple[str, str]] | None:
        if not isinstance(raw, dict) or not raw:
            checker.wrong_type(path, "type-table")
            return None
        letters = [name(checker, (*path, key), key) for key in raw]
        lettered = {key: place(checker, (*path, key), at) for key, at in raw.items()}
        for at in lettered.values():
            if at and ZERO in at:
                names.bounds.update((positive(length), Bound.POSITIVE) for length in at)
        return None if None in letters or None in lettered.values() else names.on_axis(lettered)

    place = array_of(names.place, 2)
    fields = {
        "number": Field(link_number),
        "points": Field(points),
        "centre": Field(name, required=False),
        "mass": Field(names.value(_KG), required=False),
        "inertia": Field(names.value(_KG_M2), required=False),
        "per_length": Field(names.above_zero(_KG_M), required=False),
        "inertia_factor": Field(names.above_zero(ONE), required=False),
    }
    read = record(checker, path, raw, fields)
    if not {"number", "points"} <= read.keys():
        return None
    if read.get("centre", next(iter(read["points"]))) not in read["points"]:
        checker.fault((*path, "centre"), unknown("point-unknown", read["centre"], read["points"], link=read["number"]))
    if "centre" not in read and read.keys() & {"mass", "inertia", "per_length", "inertia_factor"}:
        checker.fault(path, InputError("key-missing", name="centre"))
    return Link(**_with_mass(checker, path, read, names))


def _with_mass(checker: Checker, path: Path, read: dict[str, Any], names: Names) -> dict[str, Any]:
    """Name the mass and the moment of inertia, whether they are literals or follow from the length."""
    customary = {"mass": "m_", "inertia": "J_S", "per_length": "k_", "inertia_factor": "j_"}
    for key in read.keys() & customary.keys():
        read = {**read, key: names.called(f"{customary[key]}{read['number']}", read[key])}
    if "inertia_factor" in read and not read.keys() & {"mass", "per_length"}:
        checker.fault(path, InputError("key-missing", name="mass"))
    for factor, result in (("per_length", "mass"), ("inertia_factor", "inertia")):
        if factor in read and result in read:
            checker.fault((*path, result), InputError("follows-from", name=result, other=factor))
        if factor in read:
            read = {**read, result: f"{customary[result]}{read['number']}"}
    return read


def _pair(checker: Checker, path: Path, raw: object, names: Names) -> Pair | None:
    """Read one pair of the kind that it names."""
    joins = {"point": Field(name), "links": Field(array_of(link_number, 2))}
    place = Field(array_of(names.place, 2))
    kinds: dict[str, tuple[type[Pair], dict[str, Field]]] = {
        "revolute": (
            Revolute,
            {**joins, "at": Field(place.read, required=False), "branch": Field(names.sign, required=False)},
        ),
        "prismatic": (
            Prismatic,
            {
                **joins,
                "through": place,
                "direction": Field(names.value(_RAD)),
                "offset": Field(names.place, required=False),
                "branch": Field(names.sign, required=False),
            },
        ),
    }
    kind = raw.get("kind") if isinstance(raw, dict) else None
    if not isinstance(raw, dict) or not isinstance(kind, str) or kind not in kinds:
        checker.fault((*path, "kind"), InputError("pair-kind", text=quote(kind), known=", ".join(kinds)))
        return None
    made, fields = kinds[kind]
    before = len(checker.faults)
    read = record(checker, path, raw, {"kind": Field(one_of("pair-kind", lambda: tuple(kinds))), **fields})
    if len(checker.faults) > before:
        return None
    del read["kind"]
    return made(**read)


def _joined(checker: Checker, mechanism: Mechanism, names: Names) -> None:
    """Check that links, pairs, driver and loads speak of the same numbers and letters."""
    links: dict[int, Mapping[str, object]] = {}
    before = len(checker.faults)
    for i, link in enumerate(mechanism.links):
        if link.number == FRAME or link.number in links:
            checker.fault(("mechanism", "link", i, "number"), InputError("link-number", number=link.number))
        links[link.number] = link.points
    for i, pair in enumerate(mechanism.pairs):
        _pair_joined(checker, ("mechanism", "pair", i), pair, links)
    _places_joined(checker, mechanism)
    driver_joined(checker, mechanism, links)
    loads_joined(checker, mechanism, names, links)
    starts_joined(checker, mechanism, links)
    whole = len(checker.faults) == before
    output_joined(checker, mechanism)
    if whole and len(checker.faults) > before:  # else the reader, which constructs it, finds what is wrong
        _moves(checker, mechanism)


def _moves(checker: Checker, mechanism: Mechanism) -> None:
    """Check that the mechanism has a structure."""
    try:
        analyse(mechanism)
    except InputError as error:
        checker.fault(place_of(mechanism, error), error)


def _places_joined(checker: Checker, mechanism: Mechanism) -> None:
    """Check that a pivot of the frame stands at one place."""
    places: dict[str, tuple[str, str] | None] = {}
    for i, pair in enumerate(mechanism.pairs):
        at = pair.at if isinstance(pair, Revolute) else None
        if at is not None and places.setdefault(pair.point, at) != at:
            checker.fault(("mechanism", "pair", i, "at"), InputError("pivot-twice", point=pair.point))


def _pair_joined(checker: Checker, path: Path, pair: Pair, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check one pair: two different links, its point on both of them, a place where one of them is the frame."""
    if pair.links[0] == pair.links[1]:
        checker.fault((*path, "links"), InputError("pair-same", number=pair.links[0]))
        return
    if isinstance(pair, Revolute):
        for number in pair.links:
            if number != FRAME:
                on_link(checker, path, "point", pair.point, number, links)
        if pair.at is None and FRAME in pair.links:
            checker.fault(path, InputError("key-missing", name="at"))
        if pair.at is not None and FRAME not in pair.links:
            checker.fault((*path, "at"), InputError("pair-at", name="at"))
    elif pair.links[0] == FRAME:
        checker.fault((*path, "links"), InputError("moving-guide", links=", ".join(map(str, pair.links))))
    else:
        on_link(checker, path, "point", pair.point, pair.links[0], links)
        if pair.links[1] != FRAME and pair.links[1] not in links:
            checker.fault((*path, "links"), unknown("link-unknown", str(pair.links[1]), map(str, links)))
