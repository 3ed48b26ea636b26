"""Checking a mechanism: names and dimensions, what pairs, driver and loads join, what the structure needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from ...plans.linkages import mechanism as model
from ...plans.linkages.loads import output_pair
from ...plans.linkages.structure import TRIAD, Structure, analyse
from ...scales.errors import InputError
from ...scales.givens import Bound
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.units import ONE, unit
from .basics import Checker, Field, Path, array_of, as_is, link_number, name, on_link, one_of, record, record_of, rows
from .names import Names

_RAD, _RAD_S, _RAD_S2 = unit("rad"), unit("rad/s"), unit("rad/s^2")
_M, _M_S, _M_S2 = unit("m"), unit("m/s"), unit("m/s^2")
_KG, _KG_M2, _KG_M = unit("kg"), unit("kg*m^2"), unit("kg/m")
_N, _N_M = unit("N"), unit("N*m")
_STROKE = Field(one_of("stroke-unknown", lambda: (model.BOTH, model.WORKING, model.IDLE)), required=False)
_OVER = one_of("diagram-over", lambda: (model.STROKE, model.ANGLE))
_BALANCE = one_of("balance-unknown", lambda: (model.MOMENT, model.FORCE))
SEVERAL = ("link", "pair", "load", "couple", "diagram", "start")


def read_mechanism(checker: Checker, raw: object, names: Names) -> model.Mechanism | None:
    """Read `[mechanism]`; `None` when a part of it is at fault."""
    before = len(checker.faults)

    def each(read: Callable[..., Any], required: bool = False) -> Field:
        """Read an array of tables, one at a time."""
        return Field(lambda c, p, r: [read(c, path, row, names) for path, row in rows(c, p, r)], required)

    slides = isinstance(raw, dict) and isinstance(raw.get("driver"), dict) and "travel" in raw["driver"]
    kinds = {
        "gravity": Field(names.value(_M_S2), required=False),
        "link": each(_link, required=True),
        "pair": each(_pair, required=True),
        "driver": Field(lambda c, p, r: _driver(c, p, r, names)),
        "stroke": Field(lambda c, p, r: _stroke(c, p, r, names), required=False),
        # before the loads that name them
        "diagram": Field(lambda c, p, r: _diagrams(c, rows(c, p, r), names), required=False),
        "load": each(_load),
        "couple": each(_couple),
        "start": each(partial(_start, slides=slides)),
    }
    read = record(checker, ("mechanism",), raw, kinds)
    if len(checker.faults) > before:
        return None
    found = {f"{key}s": tuple(read.get(key, ())) for key in SEVERAL} | {"driver": read["driver"]}
    found |= {"stroke": read.get("stroke"), "gravity": names.called("g", read.get("gravity"))}
    mechanism = model.Mechanism(**found)
    _joined(checker, mechanism, names)
    return mechanism if len(checker.faults) == before else None


def _link(checker: Checker, path: Path, raw: object, names: Names) -> model.Link | None:
    """Read one link; a point on a local axis lies at a distance, which must be greater than zero."""

    def points(checker: Checker, path: Path, raw: object) -> dict[str, tuple[str, str]] | None:
        if not isinstance(raw, dict) or not raw:
            checker.wrong_type(path, "type-table")
            return None
        letters = [name(checker, (*path, key), key) for key in raw]
        lettered = {key: place(checker, (*path, key), at) for key, at in raw.items()}
        for at in lettered.values():
            if at and model.ZERO in at:
                names.bounds.update((model.positive(length), Bound.POSITIVE) for length in at)
        return None if None in letters or None in lettered.values() else names.on_axis(lettered)

    place = array_of(names.place, 2)
    fields = {"number": Field(link_number), "points": Field(points), "centre": Field(name, required=False)}
    fields |= {key: Field(names.value(of), required=False) for key, of in (("mass", _KG), ("inertia", _KG_M2))}
    factors = ("per_length", _KG_M), ("inertia_factor", ONE)
    fields |= {key: Field(names.above_zero(of), required=False) for key, of in factors}
    read = record(checker, path, raw, fields)
    if not {"number", "points"} <= read.keys():
        return None
    if read.get("centre", next(iter(read["points"]))) not in read["points"]:
        checker.fault((*path, "centre"), unknown("point-unknown", read["centre"], read["points"], link=read["number"]))
    if "centre" not in read and read.keys() & {"mass", "inertia", "per_length", "inertia_factor"}:
        checker.fault(path, InputError("key-missing", name="centre"))
    return model.Link(**_with_mass(checker, path, read, names))


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


def _pair(checker: Checker, path: Path, raw: object, names: Names) -> model.Pair | None:
    """Read one pair of the kind that it names."""
    place = array_of(names.place, 2)
    guide = {"through": Field(place), "direction": Field(names.value(_RAD))}
    kinds: dict[str, tuple[type[model.Pair], dict[str, Field]]] = {
        "revolute": (model.Revolute, {"at": Field(place, required=False)}),
        "prismatic": (model.Prismatic, {**guide, "offset": Field(names.place, required=False)}),
    }
    kind = raw.get("kind") if isinstance(raw, dict) else None
    if not isinstance(kind, str) or kind not in kinds:
        checker.fault((*path, "kind"), InputError("pair-kind", text=quote(kind), known=", ".join(kinds)))
        return None
    pair, own = kinds[kind]
    fields = {"kind": Field(as_is), "point": Field(name), "links": Field(array_of(link_number, 2)), **own}
    fields["branch"] = Field(names.sign, required=False)
    return record_of(checker, path, raw, fields, lambda kind, **read: pair(**read))


def _driver(checker: Checker, path: Path, raw: object, names: Names) -> model.Driver | model.SlidingDriver | None:
    """Read the only driver; it moves. A key `travel` tells one that slides."""
    if isinstance(raw, list):
        checker.fault(path, InputError("driver-twice"))
        return None
    before = len(checker.faults)
    slides = isinstance(raw, dict) and "travel" in raw
    fields = {"link": Field(link_number), "point": Field(name)}
    if slides:
        fields |= {"travel": Field(names.value(_M)), "speed": Field(names.value(_M_S))}
    else:
        fields |= {"pivot": Field(name), "angle": Field(names.value(_RAD)), "speed": Field(names.value(_RAD_S))}
        fields |= {"sense": Field(names.sign)}
    fields["acceleration"] = Field(names.value(_M_S2 if slides else _RAD_S2), required=False)
    fields |= {} if slides else {"balance": Field(_BALANCE, required=False)}
    read = record(checker, path, raw, fields)
    if read.get("speed") == model.ZERO:
        checker.fault((*path, "speed"), InputError("is-zero" if slides else "not-positive", text="0"))
    if len(checker.faults) > before:
        return None
    names.bounds.setdefault(read["speed"], Bound.NOT_ZERO if slides else Bound.POSITIVE)
    return model.SlidingDriver(**read) if slides else model.Driver(**read)


def _start(checker: Checker, path: Path, raw: object, names: Names, slides: bool) -> model.Start | None:
    """Read where a link starts; the driver stands at an angle, or at its travel where it `slides`."""
    place = {"x": Field(names.value(_M)), "y": Field(names.value(_M)), "angle": Field(names.value(_RAD))}
    legs = {"legs": Field(array_of(link_number, 2), required=False)}
    fields = {"link": Field(link_number), **place, "driver": Field(names.value(_M if slides else _RAD)), **legs}
    return record_of(checker, path, raw, fields, model.Start)


def _stroke(checker: Checker, path: Path, raw: object, names: Names) -> model.Stroke | None:
    """Read which link is the output, and which way it works."""
    fields = {"link": Field(link_number), "sense": Field(names.sign, required=False)}
    return record_of(checker, path, raw, fields, model.Stroke)


def _load(checker: Checker, path: Path, raw: object, names: Names) -> model.Load | None:
    """Read a force; without a direction it resists the motion of its point."""
    places = {"name": Field(name), "link": Field(link_number), "point": Field(name)}
    size = {"magnitude": Field(names.value(_N)), "direction": Field(names.value(_RAD), required=False)}
    return record_of(checker, path, raw, {**places, **size, "stroke": _STROKE}, partial(_named, model.Load, names))


def _couple(checker: Checker, path: Path, raw: object, names: Names) -> model.Couple | None:
    """Read a moment; without a sense it resists the turning of its link."""
    places = {"name": Field(name), "link": Field(link_number)}
    size = {"magnitude": Field(names.value(_N_M)), "sense": Field(names.sign, required=False)}
    make = partial(_named, model.Couple, names, sense=None)
    return record_of(checker, path, raw, {**places, **size, "stroke": _STROKE}, make)


def _named(make: Callable[..., Any], names: Names, **read: Any) -> Any:
    """Make a load; a literal magnitude is called like it."""
    return make(**{**read, "magnitude": names.called(read["name"], read["magnitude"])})


def _diagrams(checker: Checker, rows: list[tuple[Path, object]], names: Names) -> list[model.Diagram]:
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


def _diagram(checker: Checker, path: Path, raw: object, names: Names) -> tuple[model.Diagram, Any] | None:
    over = raw.get("over") if isinstance(raw, dict) else None
    first = raw.get("values") if isinstance(raw, dict) else None
    moment = isinstance(first, list) and any(names.dimension_of(value) == _N_M.dimension for value in first)
    wanted = _N_M if moment else _N
    sizes = array_of(names.value(wanted))
    fields = {
        "name": Field(name),
        "over": Field(_OVER),
        "at": Field(array_of(names.value(_RAD if over == model.ANGLE else ONE))),
        "values": Field(sizes),
        "back": Field(sizes, required=False),
    }
    diagram = record_of(checker, path, raw, fields, model.Diagram)
    if diagram is None:
        return None
    before = len(checker.faults)
    for key in ("values", "back"):
        sizes = getattr(diagram, key)
        if sizes is not None and len(sizes) != len(diagram.at):
            checker.fault((*path, key), InputError("diagram-uneven", n=len(diagram.at), m=len(sizes)))
    if diagram.back and over == model.ANGLE:
        checker.fault((*path, "back"), InputError("diagram-back"))
    return (diagram, wanted.dimension) if len(checker.faults) == before else None


def _joined(checker: Checker, mechanism: model.Mechanism, names: Names) -> None:
    """Check that links, pairs, driver and loads speak of the same numbers and letters."""
    links: dict[int, Mapping[str, object]] = {}
    before = len(checker.faults)
    for i, link in enumerate(mechanism.links):
        if link.number == model.FRAME or link.number in links:
            checker.fault(("mechanism", "link", i, "number"), InputError("link-number", number=link.number))
        links[link.number] = link.points
    for i, pair in enumerate(mechanism.pairs):
        _pair_joined(checker, ("mechanism", "pair", i), pair, links)
    places: dict[str, tuple[str, str]] = {}  # a pivot of the frame stands at one
    for i, pair in enumerate(mechanism.pairs):
        at = pair.at if isinstance(pair, model.Revolute) else None
        if at is not None and places.setdefault(pair.point, at) != at:
            checker.fault(("mechanism", "pair", i, "at"), InputError("pivot-twice", point=pair.point))
    _driver_joined(checker, mechanism, links)
    _loads_joined(checker, mechanism, names, links)
    _starts_joined(checker, mechanism, links)
    whole = len(checker.faults) == before
    _output_joined(checker, mechanism)
    if whole and len(checker.faults) > before:  # else the reader, which constructs it, finds what is wrong
        try:
            analyse(mechanism)
        except InputError as error:
            checker.fault(place_of(mechanism, error), error)


def _pair_joined(checker: Checker, path: Path, pair: model.Pair, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check one pair: two different links, its point on both of them, a place where one of them is the frame."""
    if pair.links[0] == pair.links[1]:
        checker.fault((*path, "links"), InputError("pair-same", number=pair.links[0]))
        return
    if isinstance(pair, model.Revolute):
        for number in pair.links:
            if number != model.FRAME:
                on_link(checker, path, "point", pair.point, number, links)
        if pair.at is None and model.FRAME in pair.links:
            checker.fault(path, InputError("key-missing", name="at"))
        if pair.at is not None and model.FRAME not in pair.links:
            checker.fault((*path, "at"), InputError("pair-at", name="at"))
    elif pair.links[0] == model.FRAME:
        checker.fault((*path, "links"), InputError("moving-guide", links=", ".join(map(str, pair.links))))
    else:
        on_link(checker, path, "point", pair.point, pair.links[0], links)
        if pair.links[1] != model.FRAME and pair.links[1] not in links:
            checker.fault((*path, "links"), unknown("link-unknown", str(pair.links[1]), map(str, links)))


def _driver_joined(checker: Checker, mechanism: model.Mechanism, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check that the driver carries its point, and that a crank turns on the frame about another one, its pivot."""
    driver = mechanism.driver
    before, path = len(checker.faults), ("mechanism", "driver")
    on_link(checker, path, "point", driver.point, driver.link, links)
    if not isinstance(driver, model.Driver):
        return
    on_link(checker, path, "pivot", driver.pivot, driver.link, links)
    if len(checker.faults) > before:
        return
    joints = [pair for pair in mechanism.pairs if isinstance(pair, model.Revolute) and pair.point == driver.pivot]
    if not {model.FRAME, driver.link} <= {number for pair in joints for number in pair.links}:
        checker.fault((*path, "pivot"), InputError("driver-pivot", text=driver.pivot, link=driver.link))
    elif driver.point == driver.pivot:
        checker.fault((*path, "point"), InputError("driver-point", text=driver.point))


def _starts_joined(checker: Checker, mechanism: model.Mechanism, links: Mapping[int, object]) -> None:
    """Check that the starts are those of different links."""
    seen: dict[int, Path] = {}
    for i, start in enumerate(mechanism.starts):
        path: Path = ("mechanism", "start", i, "link")
        if start.link not in links:
            checker.fault(path, unknown("link-unknown", str(start.link), map(str, links)))
        elif start.link in seen:
            checker.twice(path, start.link, seen[start.link])
        seen.setdefault(start.link, path)


def _loads_joined(
    checker: Checker, mechanism: model.Mechanism, names: Names, links: Mapping[int, Mapping[str, object]]
) -> None:
    """Check that loads and couples act on links, forces at their points, each under a name of its own."""
    seen: dict[str, Path] = {}
    sizes = {name for diagram in mechanism.diagrams for name in (diagram.name, *diagram.sizes)}
    sizes |= {load.magnitude for load in mechanism.acting}
    placed: list[tuple[Path, model.Load | model.Couple]] = [
        *((("mechanism", "load", i), load) for i, load in enumerate(mechanism.loads)),
        *((("mechanism", "couple", i), couple) for i, couple in enumerate(mechanism.couples)),
    ]
    for path, load in placed:
        if load.link == model.FRAME:
            checker.fault((*path, "link"), InputError("load-frame", known=", ".join(map(str, links))))
        elif isinstance(load, model.Load):
            on_link(checker, path, "point", load.point, load.link, links)
        elif load.link not in links:
            checker.fault((*path, "link"), unknown("link-unknown", str(load.link), map(str, links)))
        if load.name in seen:
            checker.twice((*path, "name"), load.name, (*seen[load.name], "name"))
        elif load.name in names.dimensions and load.name not in sizes:
            line, _ = checker.places[names.stated[load.name]]
            checker.fault((*path, "name"), InputError("load-given", name=load.name, line=line))
        seen.setdefault(load.name, path)


def _output_joined(checker: Checker, mechanism: model.Mechanism) -> None:
    """Check that the output link moves on the frame, and that a diagram over an angle has a crank."""
    if mechanism.stroke is not None:
        with checker.at(("mechanism", "stroke", "link")):
            output_pair(mechanism)
    for i, diagram in enumerate(mechanism.diagrams):
        if diagram.over == model.ANGLE and isinstance(mechanism.driver, model.SlidingDriver):
            checker.fault(("mechanism", "diagram", i, "over"), InputError("diagram-crank"))


def started(checker: Checker, mechanism: model.Mechanism, structure: Structure) -> None:
    """Check that only central links have a start."""
    central = [group.central for group in structure.groups if group.kind == TRIAD]
    for i, start in enumerate(mechanism.starts):
        if start.link not in central:
            known = ", ".join(map(str, central))
            error = InputError("start-leg" if central else "start-link", link=start.link, known=known)
            checker.fault(("mechanism", "start", i, "link"), error)


def place_of(mechanism: model.Mechanism, error: InputError) -> Path:
    """Return where an error of the structure shows: the load or the first link that it names, or the point."""
    loads: dict[str, Sequence[model.Load | model.Couple | model.Diagram]] = {
        "load": mechanism.loads,
        "couple": mechanism.couples,
        "diagram": mechanism.diagrams,
    }
    for kind, acting in loads.items():
        for i, row in enumerate(acting):
            timed = getattr(row, "stroke", model.WORKING) != model.BOTH  # all diagrams over a stroke are
            if row.name == error.data.get("name") or (timed and error.key == "stroke-missing"):
                return "mechanism", kind, i
    named = re.search("[0-9]+", str(error.data.get("link", error.data.get("links", ""))).replace("0, ", "", 1))
    for i, link in enumerate(mechanism.links):
        if named and link.number == int(named[0]):
            return "mechanism", "link", i
    point = error.data.get("name", error.data.get("point"))
    holders = [i for i, link in enumerate(mechanism.links) if point in link.points]
    return ("mechanism", "link", holders[-1], "points", str(point)) if holders else ("mechanism",)


def branched(checker: Checker, mechanism: model.Mechanism, structure: Structure) -> None:
    """Check that every dyad of three revolute pairs says on which side its inner pair lies."""
    for group in structure.groups:
        if group.kind == "RRR" and group.inner[0].branch is None:
            point = group.inner[0].point
            pins = [pair.point if isinstance(pair, model.Revolute) else None for pair in mechanism.pairs]
            ends = sorted(zip(group.links, group.outer, strict=True))
            data = {"links": ", ".join(map(str, sorted(group.links))), "point": point}
            error = InputError("branch-missing", start=ends[0][1].point, end=ends[1][1].point, **data)
            checker.fault(("mechanism", "pair", pins.index(point)), error)


def needless_branches(checker: Checker, mechanism: model.Mechanism, structure: Structure) -> None:
    """Check that only pairs at which there are two ways to go on say which is meant."""
    pins = {group.inner[0].point for group in structure.groups if group.kind == "RRR"}
    two_ways = [group for group in structure.groups if group.kind in ("RRP", "RPR")]
    triads = {pair.point for group in structure.groups if group.kind == TRIAD for pair in (*group.inner, *group.outer)}
    guides = [pair for group in two_ways for pair in (*group.inner, *group.outer) if isinstance(pair, model.Prismatic)]
    for i, pair in enumerate(mechanism.pairs):
        meant = pair.point in pins if isinstance(pair, model.Revolute) else pair in guides
        if pair.branch is not None and not meant:
            error = InputError("branch-triad" if pair.point in triads else "branch-needless", point=pair.point)
            checker.fault(("mechanism", "pair", i, "branch"), error)
