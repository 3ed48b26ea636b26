"""Checking the mechanism of a task: every name is known and of the right dimension, every pair joins what it says."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ..plans.linkages.mechanism import (
    FRAME,
    MINUS,
    ZERO,
    Couple,
    Driver,
    Link,
    Load,
    Mechanism,
    Pair,
    Prismatic,
    Revolute,
)
from ..scales.errors import InputError
from ..scales.names import unknown
from ..scales.numbers import quote
from ..scales.units import ONE, Dimension, Unit, unit
from .checks import NAME, Checker, Field, Read, array_of, link_number, name, one_of, record, rows
from .checks_givens import NEVER_NEGATIVE, Setting, literal
from .toml_places import Path

_RAD_S, _N, _KG, _KG_M2 = unit("rad/s"), unit("N"), unit("kg"), unit("kg*m^2")
_M, _RAD = unit("m"), unit("rad")
_RAD_S2, _N_M = unit("rad/s^2"), unit("N*m")


@dataclass(slots=True)
class Names:
    """The values that a mechanism may name, and what it turned out to use.

    `literals` are constants by value and dimension, `lengths` those of them that are links, by their customary names,
    `positive` the names that must be greater than zero: without a length or a speed of the crank there is no plan.
    """

    dimensions: dict[str, Dimension]
    literals: dict[tuple[float, Dimension], str] = field(default_factory=dict)
    lengths: dict[str, float] = field(default_factory=dict)
    positive: set[str] = field(default_factory=set)
    signs: set[str] = field(default_factory=set)

    def value(self, wanted: Unit) -> Read:
        """Return a reader of a value of the dimension of `wanted`: a name, or a literal with its unit.

        A minus may stand before the name of a length.
        """

        def read(checker: Checker, path: Path, raw: object) -> str | None:
            bare = raw.removeprefix("-") if isinstance(raw, str) and wanted == _M else raw
            if isinstance(bare, str) and NAME.fullmatch(bare):
                if bare not in self.dimensions:
                    checker.fault(path, unknown("value-unknown", bare, self.dimensions))
                    return None
                found, written = bare if bare == raw else MINUS + bare, self.dimensions[bare]
            else:
                setting = self.literal(checker, path, raw, wanted)
                if setting is None:
                    return None
                found, written = self.constant(setting.value, setting.dimension), setting.dimension
            if written != wanted.dimension:
                checker.fault(path, InputError("value-wrong", text=quote(raw), expected=wanted.name))
                return None
            return found

        return read

    @staticmethod
    def literal(checker: Checker, path: Path, raw: object, wanted: Unit) -> Setting | None:
        """Read a literal with its unit; a mass is not negative."""
        setting = literal(checker, path, raw)
        if setting is not None and setting.dimension == ONE.dimension != wanted.dimension:
            checker.fault(path, InputError("unit-missing", text=quote(raw), expected=wanted.name))
        elif setting is not None and setting.value < 0.0 and setting.dimension in NEVER_NEGATIVE:
            checker.fault(path, InputError("negative", text=quote(raw)))
        else:
            return setting
        return None

    def sign(self, checker: Checker, path: Path, raw: object) -> str | None:
        """Read a sense or a branch: +1 or -1, or the name of one that a choice sets."""
        found: str | None = self.value(ONE)(checker, path, raw)
        if found in self.dimensions:
            self.signs.add(found)
        elif found is not None and abs(self.constants.get(found, 0.0)) != 1.0:
            checker.fault(path, InputError("sign-bad", text=quote(raw)))
            return None
        return found

    def constant(self, value: float, dimension: Dimension) -> str:
        """Return the name of a literal; zero has the name that the plans know."""
        if value == 0.0:
            return ZERO
        return self.literals.setdefault((value, dimension), f"_constant_{len(self.literals) + 1}")

    @property
    def constants(self) -> dict[str, float]:
        """The literals by their names."""
        return {constant: value for (value, _), constant in self.literals.items()} | self.lengths

    def on_axis(self, points: dict[str, tuple[str, str]]) -> dict[str, tuple[str, str]]:
        """Call literal distances from the origin of a link by their ends, `l_AB`, where nothing else is called so."""
        start = next((point for point, at in points.items() if at == (ZERO, ZERO)), "")
        named = dict(points)
        for end, (x, y) in points.items():
            name, value = f"l_{start}{end}", self.constants.get(x, 0.0)
            free = start and y == ZERO and value > 0.0 and name not in self.dimensions
            if free and self.lengths.setdefault(name, value) == value:
                named[end] = (name, y)
        return named


def read_mechanism(checker: Checker, raw: object, names: Names) -> Mechanism | None:
    """Read `[mechanism]`; `None` when a part of it is at fault."""
    before = len(checker.faults)
    number = names.value
    kinds = {
        "link": Field(_rows(lambda c, p, r: _link(c, p, r, names))),
        "pair": Field(_rows(lambda c, p, r: _pair(c, p, r, names))),
        "driver": Field(lambda c, p, r: _driver(c, p, r, names)),
        "load": Field(_rows(lambda c, p, r: record(c, p, r, _load_fields(number))), required=False),
        "couple": Field(_rows(lambda c, p, r: record(c, p, r, _couple_fields(names))), required=False),
    }
    read = record(checker, ("mechanism",), raw, kinds)
    if len(checker.faults) > before:
        return None
    mechanism = Mechanism(
        tuple(read["link"]),
        tuple(read["pair"]),
        Driver(**read["driver"]),
        tuple(Load(**x) for x in read.get("load", ())),
        tuple(Couple(**x) for x in read.get("couple", ())),
    )
    names.positive.add(mechanism.driver.speed)
    _joined(checker, mechanism, names)
    return mechanism if len(checker.faults) == before else None


def _rows(read: Callable[[Checker, Path, object], Any]) -> Read:
    """Return a reader of an array of tables, one at a time."""
    return lambda checker, path, raw: [read(checker, row_path, row) for row_path, row in rows(checker, path, raw)]


def _driver(checker: Checker, path: Path, raw: object, names: Names) -> dict[str, str]:
    """Read the only driver; it moves."""
    if isinstance(raw, list):
        checker.fault(path, InputError("driver-twice"))
        return {}
    places = {"link": Field(link_number), "pivot": Field(name), "point": Field(name)}
    turning = {"angle": Field(names.value(_RAD)), "speed": Field(names.value(_RAD_S)), "sense": Field(names.sign)}
    speeding = {"acceleration": Field(names.value(_RAD_S2), required=False)}
    read = record(checker, path, raw, places | turning | speeding)
    if read.get("speed") == ZERO:
        checker.fault((*path, "speed"), InputError("not-positive", text="0"))
    return read


def _load_fields(number: Callable[[Unit], Read]) -> dict[str, Field]:
    places = {"name": Field(name), "link": Field(link_number), "point": Field(name)}
    return places | {"magnitude": Field(number(_N)), "direction": Field(number(_RAD))}


def _couple_fields(names: Names) -> dict[str, Field]:
    places = {"name": Field(name), "link": Field(link_number)}
    return places | {"magnitude": Field(names.value(_N_M)), "sense": Field(names.sign)}


def _link(checker: Checker, path: Path, raw: object, names: Names) -> Link | None:
    """Read one link; a point on a local axis lies at a distance, which must be greater than zero."""

    def points(checker: Checker, path: Path, raw: object) -> dict[str, tuple[str, str]] | None:
        if not isinstance(raw, dict) or not raw:
            checker.wrong_type(path, "type-table")
            return None
        lettered = {name(checker, (*path, key), key): place(checker, (*path, key), at) for key, at in raw.items()}
        for at in lettered.values():
            if at and ZERO in at:
                names.positive.update(length.removeprefix(MINUS) for length in at)
        return None if None in lettered or None in lettered.values() else names.on_axis(lettered)

    place = array_of(names.value(_M), 2)
    fields = {
        "number": Field(link_number),
        "points": Field(points),
        "centre": Field(name, required=False),
        "mass": Field(names.value(_KG), required=False),
        "inertia": Field(names.value(_KG_M2), required=False),
    }
    read = record(checker, path, raw, fields)
    if not {"number", "points"} <= read.keys():
        return None
    if read.get("centre", next(iter(read["points"]))) not in read["points"]:
        checker.fault((*path, "centre"), unknown("point-unknown", read["centre"], read["points"], link=read["number"]))
    if "centre" not in read and ("mass" in read or "inertia" in read):
        checker.fault(path, InputError("key-missing", name="centre"))
    return Link(**read)


def _pair(checker: Checker, path: Path, raw: object, names: Names) -> Pair | None:
    """Read one pair of the kind that it names."""
    joins = {"point": Field(name), "links": Field(array_of(link_number, 2))}
    place = Field(array_of(names.value(_M), 2))
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
                "offset": Field(names.value(_M), required=False),
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
    for i, link in enumerate(mechanism.links):
        if link.number == FRAME or link.number in links:
            checker.fault(("mechanism", "link", i, "number"), InputError("link-number", number=link.number))
        links[link.number] = link.points
    for i, pair in enumerate(mechanism.pairs):
        _pair_joined(checker, ("mechanism", "pair", i), pair, links)
    _driver_joined(checker, mechanism, links)
    _loads_joined(checker, mechanism, names, links)


def _loads_joined(
    checker: Checker, mechanism: Mechanism, names: Names, links: Mapping[int, Mapping[str, object]]
) -> None:
    """Check that loads and couples act on links, forces at their points, each under a name of its own."""
    seen: set[str] = set()
    placed: list[tuple[Path, Load | Couple]] = [
        *((("mechanism", "load", i), load) for i, load in enumerate(mechanism.loads)),
        *((("mechanism", "couple", i), couple) for i, couple in enumerate(mechanism.couples)),
    ]
    for path, load in placed:
        if load.link == FRAME:
            checker.fault((*path, "link"), InputError("load-frame", known=", ".join(map(str, links))))
        elif isinstance(load, Load):
            _on_link(checker, path, "point", load.point, load.link, links)
        elif load.link not in links:
            checker.fault((*path, "link"), unknown("link-unknown", str(load.link), map(str, links)))
        if load.name in seen or (load.name in names.dimensions and load.name != load.magnitude):
            checker.fault((*path, "name"), InputError("id-twice", name=load.name))
        seen.add(load.name)


def _driver_joined(checker: Checker, mechanism: Mechanism, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check that the crank turns on the frame about its pivot and carries another point."""
    driver, path = mechanism.driver, ("mechanism", "driver")
    before = len(checker.faults)
    _on_link(checker, path, "pivot", driver.pivot, driver.link, links)
    _on_link(checker, path, "point", driver.point, driver.link, links)
    if len(checker.faults) > before:
        return
    pivots = [p.point for p in mechanism.pairs if isinstance(p, Revolute) and {*p.links} == {FRAME, driver.link}]
    if driver.pivot not in pivots:
        checker.fault((*path, "pivot"), InputError("driver-pivot", text=driver.pivot, link=driver.link))
    elif driver.point == driver.pivot:
        checker.fault((*path, "point"), InputError("driver-point", text=driver.point))


def _pair_joined(checker: Checker, path: Path, pair: Pair, links: Mapping[int, Mapping[str, object]]) -> None:
    """Check one pair: two different links, its point on both of them, a place where one of them is the frame."""
    if pair.links[0] == pair.links[1]:
        checker.fault((*path, "links"), InputError("pair-same", number=pair.links[0]))
        return
    if isinstance(pair, Revolute):
        for number in pair.links:
            if number != FRAME:
                _on_link(checker, path, "point", pair.point, number, links)
        if pair.at is None and FRAME in pair.links:
            checker.fault(path, InputError("key-missing", name="at"))
        if pair.at is not None and FRAME not in pair.links:
            checker.fault((*path, "at"), InputError("pair-at", name="at"))
    else:
        _on_link(checker, path, "point", pair.point, pair.links[0], links)
        if pair.links[1] != FRAME and pair.links[1] not in links:
            checker.fault((*path, "links"), unknown("link-unknown", str(pair.links[1]), map(str, links)))


def _on_link(
    checker: Checker, path: Path, key: str, point: str, number: int, links: Mapping[int, Mapping[str, object]]
) -> None:
    """Check that `point`, named by `key`, is lettered on link `number`."""
    if number not in links:
        at = (*path, "links") if (*path, "links") in checker.places else (*path, "link")
        checker.fault(at, unknown("link-unknown", str(number), map(str, links)))
    elif point not in links[number]:
        checker.fault((*path, key), unknown("point-unknown", point, links[number], link=number))
