"""Checking a mechanism: names and dimensions, what pairs, driver and loads join, what the structure needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ...plans.linkages import mechanism as model
from ...plans.linkages.loads import output_pair
from ...plans.linkages.structure import TRIAD, Structure, analyse
from ...scales.errors import InputError
from ...scales.givens import Bound
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.units import ONE, unit
from .basics import Checker, Field, Made, Path, array_of, as_is, name, one_of, record, rows, whole_number
from .names import Names

_RAD, _RAD_S, _RAD_S2 = unit("rad"), unit("rad/s"), unit("rad/s^2")
_M, _M_S, _M_S2 = unit("m"), unit("m/s"), unit("m/s^2")
_KG, _KG_M2, _KG_M = unit("kg"), unit("kg*m^2"), unit("kg/m")
_N, _N_M = unit("N"), unit("N*m")
_STROKE = one_of("stroke-unknown", lambda: (model.BOTH, model.WORKING, model.IDLE))
_OVER = one_of("diagram-over", lambda: (model.STROKE, model.ANGLE))
_BALANCE = one_of("balance-unknown", lambda: (model.MOMENT, model.FORCE))
SEVERAL = ("link", "pair", "load", "couple", "diagram", "start")
CUSTOMARY = {"mass": "m_", "inertia": "J_S", "per_length": "k_", "inertia_factor": "j_"}  # before the number of a link
Links = dict[int, Mapping[str, object]]  # the points of each link by its number
Fields = dict[str, Field]


def _may(**readers: Any) -> Fields:
    """Return fields that may be left out."""
    return {key: Field(read, required=False) for key, read in readers.items()}


def _must(**readers: Any) -> Fields:
    """Return fields that must be there."""
    return {key: Field(read) for key, read in readers.items()}


def read_mechanism(checker: Checker, raw: object, names: Names) -> model.Mechanism | None:
    """Read `[mechanism]`; `None` when a part of it is at fault."""
    before, value = len(checker.faults), names.value
    driver = raw.get("driver") if isinstance(raw, dict) else None
    slides = isinstance(driver, dict) and "travel" in driver
    legs = array_of(whole_number, 2)
    loaded = _must(name=name, link=whole_number)

    def named(make: Callable[..., Any]) -> Callable[..., Any]:
        """Make a load; a literal magnitude is called like it."""
        return lambda **read: make(**{**read, "magnitude": names.called(read["name"], read["magnitude"])})

    made: dict[str, tuple[Callable[..., Any], Fields]] = {
        "stroke": (model.Stroke, _must(link=whole_number) | _may(sense=names.sign)),
        # without a direction or a sense it resists the motion of its point, the turning of its link
        "load": (
            named(model.Load),
            loaded | _must(point=name, magnitude=value(_N)) | _may(direction=value(_RAD), stroke=_STROKE),
        ),
        "couple": (
            named(lambda sense=None, **read: model.Couple(sense=sense, **read)),
            loaded | _must(magnitude=value(_N_M)) | _may(sense=names.sign, stroke=_STROKE),
        ),
        # the driver stands at an angle, or at its travel where it slides
        "start": (
            model.Start,
            _must(link=whole_number, x=value(_M), y=value(_M), angle=value(_RAD), driver=value(_M if slides else _RAD))
            | _may(legs=legs),
        ),
    }

    def single(key: str) -> Callable[..., Any]:
        make, fields = made[key]
        return lambda c, p, r, names=names: _record_of(c, p, r, fields, make)

    def each(read: Callable[..., Any]) -> Callable[..., Any]:
        """Read an array of tables, one at a time."""
        return lambda c, p, r: [read(c, path, row, names) for path, row in rows(c, p, r)]

    fields = {
        **_may(gravity=value(_M_S2)),
        **_must(link=each(_link), pair=each(_pair), driver=lambda c, p, r: _driver(c, p, r, names)),
        **_may(stroke=single("stroke")),
        **_may(diagram=lambda c, p, r: _diagrams(c, rows(c, p, r), names)),  # before the loads that name them
        **_may(**{key: each(single(key)) for key in ("load", "couple", "start")}),
    }
    read = record(checker, ("mechanism",), raw, fields)
    if len(checker.faults) > before:
        return None
    found = {f"{key}s": tuple(read.get(key, ())) for key in SEVERAL}
    gravity = names.called("g", read.get("gravity"))
    mechanism = model.Mechanism(**found, driver=read["driver"], stroke=read.get("stroke"), gravity=gravity)
    _joined(checker, mechanism, names)
    return mechanism if len(checker.faults) == before else None


def _link(checker: Checker, path: Path, raw: object, names: Names) -> model.Link | None:
    """Read one link; a point on a local axis lies at a distance, which must be greater than zero."""

    def points(checker: Checker, path: Path, raw: object) -> dict[str, tuple[str, str]] | None:
        if not isinstance(raw, dict) or not raw:
            checker.fault(path, InputError("type-table"))
            return None
        place = array_of(names.place, 2)
        letters = [name(checker, (*path, key), key) for key in raw]
        lettered = {key: place(checker, (*path, key), at) for key, at in raw.items()}
        for at in lettered.values():
            if at and model.ZERO in at:
                names.bounds.update((model.positive(length), Bound.POSITIVE) for length in at)
        return None if None in letters or None in lettered.values() else names.on_axis(lettered)

    fields = _must(number=whole_number, points=points) | _may(
        centre=name, mass=names.value(_KG), inertia=names.value(_KG_M2),
        per_length=names.above_zero(_KG_M), inertia_factor=names.above_zero(ONE),
    )  # fmt: skip
    read = record(checker, path, raw, fields)
    if not {"number", "points"} <= read.keys():
        return None
    if read.get("centre", next(iter(read["points"]))) not in read["points"]:
        checker.fault((*path, "centre"), unknown("point-unknown", read["centre"], read["points"], link=read["number"]))
    heavy = read.keys() & CUSTOMARY.keys()
    if heavy and "centre" not in read:
        checker.fault(path, InputError("key-missing", name="centre"))
    # masses and moments of inertia have names, whether they are literals or follow from the length
    read |= {key: names.called(f"{CUSTOMARY[key]}{read['number']}", read[key]) for key in heavy}
    if "inertia_factor" in read and not read.keys() & {"mass", "per_length"}:
        checker.fault(path, InputError("key-missing", name="mass"))
    for factor, result in (("per_length", "mass"), ("inertia_factor", "inertia")):
        if factor in read and result in read:
            checker.fault((*path, result), InputError("follows-from", name=result, other=factor))
        if factor in read:
            read[result] = f"{CUSTOMARY[result]}{read['number']}"
    return model.Link(**read)


def _pair(checker: Checker, path: Path, raw: object, names: Names) -> model.Pair | None:
    """Read one pair of the kind that it names."""
    place = array_of(names.place, 2)
    guide = _must(through=place, direction=names.value(_RAD)) | _may(offset=names.place)
    kinds: dict[str, tuple[type[model.Pair], Fields]]
    kinds = {"revolute": (model.Revolute, _may(at=place)), "prismatic": (model.Prismatic, guide)}
    kind = raw.get("kind") if isinstance(raw, dict) else None
    if not isinstance(kind, str) or kind not in kinds:
        checker.fault((*path, "kind"), InputError("pair-kind", text=quote(kind), known=", ".join(kinds)))
        return None
    pair, own = kinds[kind]
    fields = _must(kind=as_is, point=name, links=array_of(whole_number, 2)) | own | _may(branch=names.sign)
    return _record_of(checker, path, raw, fields, lambda kind, **read: pair(**read))


def _driver(checker: Checker, path: Path, raw: object, names: Names) -> model.Driver | model.SlidingDriver | None:
    """Read the only driver; it moves. A key `travel` tells one that slides."""
    if isinstance(raw, list):
        checker.fault(path, InputError("driver-twice"))
        return None
    before, value = len(checker.faults), names.value
    fields = _must(link=whole_number, point=name)
    slides = isinstance(raw, dict) and "travel" in raw
    if slides:
        fields |= _must(travel=value(_M), speed=value(_M_S)) | _may(acceleration=value(_M_S2))
    else:
        fields |= _must(pivot=name, angle=value(_RAD), speed=value(_RAD_S), sense=names.sign)
        fields |= _may(acceleration=value(_RAD_S2), balance=_BALANCE)
    read = record(checker, path, raw, fields)
    if read.get("speed") == model.ZERO:
        checker.fault((*path, "speed"), InputError("is-zero" if slides else "not-positive", text="0"))
    if len(checker.faults) > before:
        return None
    names.bounds.setdefault(read["speed"], Bound.NOT_ZERO if slides else Bound.POSITIVE)
    return model.SlidingDriver(**read) if slides else model.Driver(**read)


def _diagrams(checker: Checker, rows: list[tuple[Path, object]], names: Names) -> list[model.Diagram]:
    """Read the load diagrams; from then on their names are those of forces or moments."""
    read = [(path, row, _diagram(checker, path, row, names)) for path, row in rows]
    diagrams = []
    for path, row, (diagram, wanted) in sorted(read, key=lambda item: item[2][0] is not None):  # those at fault first
        if diagram is None:
            if isinstance(row, dict) and isinstance(row.get("name"), str):
                names.dimensions.setdefault(row["name"], None)
                names.stated.setdefault(row["name"], (*path, "name"))
            continue
        if diagram.name in names.dimensions:
            checker.twice((*path, "name"), diagram.name, names.stated[diagram.name])
        names.dimensions[diagram.name] = wanted
        names.stated.setdefault(diagram.name, (*path, "name"))
        diagrams.append(diagram)
    return diagrams


def _diagram(checker: Checker, path: Path, raw: object, names: Names) -> tuple[model.Diagram | None, Any]:
    """Read a diagram, None where it is at fault, and the dimension of its sizes."""
    own, before = raw if isinstance(raw, dict) else {}, len(checker.faults)
    first, over = own.get("values"), own.get("over")
    moment = isinstance(first, list) and any(names.dimension_of(value) == _N_M.dimension for value in first)
    wanted = _N_M if moment else _N
    sizes, places = array_of(names.value(wanted)), array_of(names.value(_RAD if over == model.ANGLE else ONE))
    fields = _must(name=name, over=_OVER, at=places, values=sizes) | _may(back=sizes)
    diagram = _record_of(checker, path, raw, fields, model.Diagram)
    if diagram is not None:
        for key, listed in (("values", diagram.values), ("back", diagram.back)):
            if listed is not None and len(listed) != len(diagram.at):
                checker.fault((*path, key), InputError("diagram-uneven", n=len(diagram.at), m=len(listed)))
        if diagram.back and over == model.ANGLE:
            checker.fault((*path, "back"), InputError("diagram-back"))
    return (diagram if len(checker.faults) == before else None), wanted.dimension


def _joined(checker: Checker, mechanism: model.Mechanism, names: Names) -> None:
    """Check that links, pairs, driver and loads speak of the same numbers and letters."""
    links: Links = {}
    before = len(checker.faults)
    for i, link in enumerate(mechanism.links):
        if link.number == model.FRAME or link.number in links:
            checker.fault(("mechanism", "link", i, "number"), InputError("link-number", number=link.number))
        links[link.number] = link.points
    places: dict[str, tuple[str, str]] = {}  # a pivot of the frame stands at one
    for i, pair in enumerate(mechanism.pairs):
        _pair_joined(checker, ("mechanism", "pair", i), pair, links)
        at = pair.at if isinstance(pair, model.Revolute) else None
        if at is not None and places.setdefault(pair.point, at) != at:
            checker.fault(("mechanism", "pair", i, "at"), InputError("pivot-twice", point=pair.point))
    _driver_joined(checker, mechanism, links)
    _loads_joined(checker, mechanism, names, links)
    seen: dict[int, Path] = {}
    for i, start in enumerate(mechanism.starts):
        path: Path = ("mechanism", "start", i, "link")
        if _known(checker, path, start.link, links) and start.link in seen:
            checker.twice(path, start.link, seen[start.link])
        seen.setdefault(start.link, path)
    whole = len(checker.faults) == before
    if mechanism.stroke is not None:
        with checker.at(("mechanism", "stroke", "link")):
            output_pair(mechanism)
    for i, diagram in enumerate(mechanism.diagrams):
        if diagram.over == model.ANGLE and isinstance(mechanism.driver, model.SlidingDriver):
            checker.fault(("mechanism", "diagram", i, "over"), InputError("diagram-crank"))
    if whole and len(checker.faults) > before:  # else the reader, which constructs it, finds what is wrong
        try:
            analyse(mechanism)
        except InputError as error:
            checker.fault(place_of(mechanism, error), error)


def _known(checker: Checker, path: Path, number: int, links: Links) -> bool:
    """Tell whether there is a link of a number; else it is a fault."""
    if number not in links:
        checker.fault(path, unknown("link-unknown", str(number), map(str, links)))
    return number in links


def _on_link(checker: Checker, path: Path, key: str, point: str, number: int, links: Links) -> None:
    """Check that `point`, named by `key`, is lettered on link `number`."""
    at = (*path, "links") if (*path, "links") in checker.places else (*path, "link")
    if _known(checker, at, number, links) and point not in links[number]:
        checker.fault((*path, key), unknown("point-unknown", point, links[number], link=number))


def _pair_joined(checker: Checker, path: Path, pair: model.Pair, links: Links) -> None:
    """Check one pair: two different links, its point on both of them, a place where one of them is the frame."""
    if pair.links[0] == pair.links[1]:
        checker.fault((*path, "links"), InputError("pair-same", number=pair.links[0]))
    elif isinstance(pair, model.Revolute):
        for number in pair.links:
            if number != model.FRAME:
                _on_link(checker, path, "point", pair.point, number, links)
        if pair.at is None and model.FRAME in pair.links:
            checker.fault(path, InputError("key-missing", name="at"))
        if pair.at is not None and model.FRAME not in pair.links:
            checker.fault((*path, "at"), InputError("pair-at", name="at"))
    elif pair.links[0] == model.FRAME:
        checker.fault((*path, "links"), InputError("moving-guide", links=", ".join(map(str, pair.links))))
    else:
        _on_link(checker, path, "point", pair.point, pair.links[0], links)
        if pair.links[1] != model.FRAME:
            _known(checker, (*path, "links"), pair.links[1], links)


def _driver_joined(checker: Checker, mechanism: model.Mechanism, links: Links) -> None:
    """Check that the driver carries its point, and that a crank turns on the frame about another one, its pivot."""
    driver = mechanism.driver
    before, path = len(checker.faults), ("mechanism", "driver")
    _on_link(checker, path, "point", driver.point, driver.link, links)
    if not isinstance(driver, model.Driver):
        return
    _on_link(checker, path, "pivot", driver.pivot, driver.link, links)
    if len(checker.faults) > before:
        return
    joints = [pair for pair in mechanism.pairs if isinstance(pair, model.Revolute) and pair.point == driver.pivot]
    if not {model.FRAME, driver.link} <= {number for pair in joints for number in pair.links}:
        checker.fault((*path, "pivot"), InputError("driver-pivot", text=driver.pivot, link=driver.link))
    elif driver.point == driver.pivot:
        checker.fault((*path, "point"), InputError("driver-point", text=driver.point))


def _placed(mechanism: model.Mechanism) -> Iterator[tuple[Path, Any]]:
    """Go through loads, couples and diagrams, each with its place."""
    for key in ("load", "couple", "diagram"):
        for i, acting in enumerate(getattr(mechanism, f"{key}s")):
            yield ("mechanism", key, i), acting


def _loads_joined(checker: Checker, mechanism: model.Mechanism, names: Names, links: Links) -> None:
    """Check that loads and couples act on links, forces at their points, each under a name of its own."""
    seen: dict[str, Path] = {}
    sizes = {name for diagram in mechanism.diagrams for name in (diagram.name, *diagram.sizes)}
    sizes |= {load.magnitude for load in mechanism.acting}
    for path, load in _placed(mechanism):
        if isinstance(load, model.Diagram):
            continue
        if load.link == model.FRAME:
            checker.fault((*path, "link"), InputError("load-frame", known=", ".join(map(str, links))))
        elif isinstance(load, model.Load):
            _on_link(checker, path, "point", load.point, load.link, links)
        else:
            _known(checker, (*path, "link"), load.link, links)
        if load.name in seen:
            checker.twice((*path, "name"), load.name, (*seen[load.name], "name"))
        elif load.name in names.dimensions and load.name not in sizes:
            line, _ = checker.places[names.stated[load.name]]
            checker.fault((*path, "name"), InputError("load-given", name=load.name, line=line))
        seen.setdefault(load.name, path)


def place_of(mechanism: model.Mechanism, error: InputError) -> Path:
    """Return where an error of the structure shows: the load or the first link that it names, or the point."""
    for path, acting in _placed(mechanism):
        timed = getattr(acting, "stroke", model.WORKING) != model.BOTH  # all diagrams over a stroke are
        if acting.name == error.data.get("name") or (timed and error.key == "stroke-missing"):
            return path
    named = re.search("[0-9]+", str(error.data.get("link", error.data.get("links", ""))).replace("0, ", "", 1))
    for i, link in enumerate(mechanism.links):
        if named and link.number == int(named[0]):
            return "mechanism", "link", i
    point = error.data.get("name", error.data.get("point"))
    holders = [i for i, link in enumerate(mechanism.links) if point in link.points]
    return ("mechanism", "link", holders[-1], "points", str(point)) if holders else ("mechanism",)


def started(checker: Checker, mechanism: model.Mechanism, structure: Structure) -> None:
    """Check that only central links have a start."""
    central = [group.central for group in structure.groups if group.kind == TRIAD]
    for i, start in enumerate(mechanism.starts):
        if start.link not in central:
            known = ", ".join(map(str, central))
            error = InputError("start-leg" if central else "start-link", link=start.link, known=known)
            checker.fault(("mechanism", "start", i, "link"), error)


def branched(checker: Checker, mechanism: model.Mechanism, structure: Structure) -> None:
    """Check that pairs at which there are two ways to go on say which is meant, dyads of three pins always; no others.

    The branch of a dyad of three pins says on which side its inner pin lies.
    """
    pins: dict[str, Any] = {group.inner[0].point: group for group in structure.groups if group.kind == "RRR"}
    firsts = [pair.point if isinstance(pair, model.Revolute) else None for pair in mechanism.pairs]
    for point, group in pins.items():
        if group.inner[0].branch is None:
            start, end = (pair.point for _, pair in sorted(zip(group.links, group.outer, strict=True)))
            links = ", ".join(map(str, sorted(group.links)))
            error = InputError("branch-missing", start=start, end=end, links=links, point=point)
            checker.fault(("mechanism", "pair", firsts.index(point)), error)
    joints = {kind: [pair for group in structure.groups if group.kind == kind for pair in (*group.inner, *group.outer)]
              for kind in ("RRP", "RPR", TRIAD)}  # fmt: skip
    guides = [pair for pair in joints["RRP"] + joints["RPR"] if isinstance(pair, model.Prismatic)]
    for i, pair in enumerate(mechanism.pairs):
        meant = pair.point in pins if isinstance(pair, model.Revolute) else pair in guides
        if pair.branch is not None and not meant:
            triad = any(pair.point == other.point for other in joints[TRIAD])
            error = InputError("branch-triad" if triad else "branch-needless", point=pair.point)
            checker.fault(("mechanism", "pair", i, "branch"), error)


def _record_of(
    checker: Checker, path: Path, raw: object, fields: Mapping[str, Field], make: Callable[..., Made]
) -> Made | None:
    """Make something of a table with fixed keys; None when a part of it is at fault."""
    before = len(checker.faults)
    read = record(checker, path, raw, fields)
    return make(**read) if len(checker.faults) == before else None
