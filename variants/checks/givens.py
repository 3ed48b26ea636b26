"""Checking the table of a task: its givens, what their choices set, and its variants."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import quote, split_number
from ...scales.units import ONE, Dimension, Unit, parse, unit
from ..task import Bound, Given, Variant
from ..toml_places import Path
from .basics import Checker, Field, array_of, as_is, label, name, one_of, record, rows, text, word

NEVER_NEGATIVE = {unit("kg").dimension, unit("kg*m^2").dimension, unit("rad/s").dimension}


@dataclass(frozen=True, slots=True)
class Setting:
    """A number that a choice sets, in SI, with its dimension."""

    value: float
    dimension: Dimension


Settings = Mapping[str, Mapping[str, Mapping[str, Setting]]]


def _unit(checker: Checker, path: Path, raw: object) -> Unit | None:
    """Read a unit."""
    if not isinstance(raw, str):
        checker.wrong_type(path, "type-text")
        return None
    try:
        return unit(raw)
    except InputError as error:
        checker.fault(path, error)
        return None


_GIVEN = {
    "unit": Field(_unit, required=False),
    "choices": Field(array_of(word), required=False),
    "default": Field(as_is, required=False),
}


def read_givens(checker: Checker, raw: object) -> dict[str, Given]:
    """Read `[givens]`: each has either a unit or choices."""
    if not isinstance(raw, dict) or not raw:
        checker.wrong_type(("givens",), "type-table")
        return {}
    givens = {}
    for key, value in raw.items():
        path: Path = ("givens", key)
        if name(checker, path, key) is None:
            continue
        before = len(checker.faults)
        read = record(checker, path, value, _GIVEN)
        if len(checker.faults) == before and ("unit" in read) == ("choices" in read):
            checker.fault(path, InputError("given-kind"))
        if len(checker.faults) > before:
            checker.unread.add(key)
            continue
        givens[key] = _with_default(checker, path, Given(key, read.get("unit"), read.get("choices", ())), read)
    return givens


def _with_default(checker: Checker, path: Path, given: Given, read: Mapping[str, Any]) -> Given:
    """Return `given` with the bound of its dimension and its default."""
    if given.unit is not None and given.unit.dimension in NEVER_NEGATIVE:
        given = replace(given, bound=Bound.NOT_NEGATIVE)
    if "default" not in read:
        return given
    try:
        return replace(given, default=given.read(read["default"]))
    except InputError as error:
        checker.fault((*path, "default"), error)
        return given


def read_choices(checker: Checker, raw: object, givens: Mapping[str, Given], words: Container[str] = ()) -> Settings:
    """Read `[choices.*]`: every word of a choice sets the same numbers.

    Choices whose `words` are taken as they are need not set any.
    """
    if not isinstance(raw, dict):
        checker.wrong_type(("choices",), "type-table")
        return {}
    wanted = [given for given in givens.values() if given.choices]
    for key in raw:
        if key not in checker.unread and not any(key == given.name for given in wanted):
            checker.fault(("choices", key), unknown("key-unknown", key, [given.name for given in wanted]))
    choices = {}
    for given in wanted:
        path: Path = ("choices", given.name)
        if given.name not in raw and given.name in words:
            choices[given.name] = {chosen: dict[str, Setting]() for chosen in given.choices}
            continue
        if given.name not in raw:
            checker.fault(("givens", given.name), InputError("choice-missing", name=given.name))
            continue
        read = record(checker, path, raw[given.name], {chosen: Field(_settings) for chosen in given.choices})
        first: dict[str, Setting] = next(iter(read.values()), {})
        for chosen, settings in read.items():
            if {key: s.dimension for key, s in settings.items()} != {key: s.dimension for key, s in first.items()}:
                checker.fault((*path, chosen), InputError("choice-uneven", name=", ".join(first)))
        choices[given.name] = read
    return choices


def _settings(checker: Checker, path: Path, raw: object) -> dict[str, Setting] | None:
    """Read what one word of a choice sets."""
    if not isinstance(raw, dict):
        checker.wrong_type(path, "type-table")
        return None
    settings = {}
    for key, value in raw.items():
        if name(checker, (*path, key), key) is not None:
            found = literal(checker, (*path, key), value)
            if found is not None:
                settings[key] = found
    return settings


def literal(checker: Checker, path: Path, raw: object) -> Setting | None:
    """Read a number, plain or with a unit, of whatever dimension."""
    try:
        if isinstance(raw, str):
            _, rest = split_number(raw)
            written = unit(rest) if rest else ONE
            return Setting(parse(raw, written), written.dimension)
        if isinstance(raw, int | float) and not isinstance(raw, bool):
            Given("", ONE).read(raw)
            return Setting(float(raw), ONE.dimension)
        raise InputError("type-number", text=quote(type(raw).__name__))
    except InputError as error:
        checker.fault(path, error)
        return None


def read_variants(
    checker: Checker, raw: object, givens: Mapping[str, Given], optional: Container[str] = ()
) -> dict[str, Variant]:
    """Read `[[variant]]`: every row states every given that has no default, and no two rows share an id.

    Those that are `optional` may be left out.
    """
    variants: dict[str, Variant] = {}
    stated: dict[str, Path] = {}
    for path, row in rows(checker, ("variant",), raw):
        if not isinstance(row, dict):
            checker.wrong_type(path, "type-table")
            continue
        fields = {
            key: Field(_given(given), given.default is None and key not in optional) for key, given in givens.items()
        }
        fields |= {key: Field(as_is, required=False) for key in checker.unread}
        fields |= {"id": Field(label), "reconstructed": Field(array_of(text), required=False)}
        read = record(checker, path, row, fields)
        for i, key in enumerate(read.get("reconstructed", ())):
            if key not in givens:
                checker.fault((*path, "reconstructed", i), unknown("given-missing", key, givens))
        number = read.get("id")
        if number in variants:
            checker.twice((*path, "id"), number, (*stated[number], "id"))
        elif number is not None:
            values = {key: value for key, value in read.items() if key in givens}
            variants[number] = Variant(number, values, read.get("reconstructed", ()))
            stated[number] = path
    return variants


def _given(given: Given) -> Any:
    """Return the reader of one column."""

    def read(checker: Checker, path: Path, raw: object) -> float | str | None:
        try:
            return given.read(raw)
        except InputError as error:
            checker.fault(path, error)
            return None

    return read


def word_or_choice(known: tuple[str, ...], givens: Mapping[str, Given]) -> Any:
    """Return a reader of one of the `known` words, or of the name of a choice between some of them."""

    def read_word(checker: Checker, path: Path, raw: object) -> str | None:
        given = givens.get(raw) if isinstance(raw, str) else None
        if given is None or not given.choices:
            found: str | None = one_of("choice-unknown", lambda: known)(checker, path, raw)
            return found
        for i, choice in enumerate(given.choices):
            if choice not in known:
                checker.fault(("givens", given.name, "choices", i), unknown("choice-unknown", choice, known))
        return given.name

    return read_word
