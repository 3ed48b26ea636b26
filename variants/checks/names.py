"""The table of a task: givens, choices, variants; the values that a subject may name, each of the wanted dimension."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ...plans.linkages.mechanism import MINUS, ZERO
from ...scales.errors import InputError
from ...scales.givens import Bound, Givens
from ...scales.names import cyrillic, latin, unknown
from ...scales.numbers import quote, split_number
from ...scales.units import ONE, Dimension, Unit, customary, parse, unit
from ..task import Given, Variant
from .basics import NAME, Checker, Field, Path, array_of, as_is, label, name, one_of, record, rows, text, trying, word

NEVER_NEGATIVE = {unit("kg").dimension, unit("kg*m^2").dimension, unit("rad/s").dimension}
_M = unit("m")


@dataclass(frozen=True, slots=True)
class Setting:
    """A number that a choice sets, in SI, with its dimension."""

    value: float
    dimension: Dimension


Settings = Mapping[str, Mapping[str, Mapping[str, Setting]]]
Named = Callable[[Checker, Path, Any], str | None]  # a reader of what has a name, or gets one


@trying
def _unit(raw: object) -> Unit:
    if isinstance(raw, str):
        return unit(raw)
    raise InputError("type-text")


_GIVEN = {
    "unit": Field(_unit, required=False),
    "choices": Field(array_of(word), required=False),
    "default": Field(as_is, required=False),
}


def read_givens(checker: Checker, raw: object) -> dict[str, Given]:
    """Read `[givens]`: each has either a unit or choices."""
    if not isinstance(raw, dict) or not raw:
        checker.fault(("givens",), InputError("type-table"))
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
        given = Given(key, read.get("unit"), read.get("choices", ()))
        if given.unit is not None and given.unit.dimension in NEVER_NEGATIVE:
            given = replace(given, bound=Bound.NOT_NEGATIVE)
        if "default" in read:
            given = replace(given, default=trying(given.read)(checker, (*path, "default"), read["default"]))
        givens[key] = given
    return givens


def read_choices(checker: Checker, raw: object, givens: Mapping[str, Given], words: Container[str]) -> Settings:
    """Read `[choices.*]`: every word of a choice sets the same numbers.

    Choices whose `words` are taken as they are need not set any.
    """
    raw = checker.table(("choices",), raw)
    if ("choices",) in checker.faulty:
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
    own = checker.table(path, raw)
    named = [key for key in own if name(checker, (*path, key), key) is not None]
    settings = {key: literal(checker, (*path, key), own[key]) for key in named}
    known = {key: setting for key, setting in settings.items() if setting is not None}
    return known if own or isinstance(raw, dict) else None


@trying
def literal(raw: object) -> Setting:
    """Read a number, plain or with a unit, of whatever dimension."""
    if isinstance(raw, str):
        _, rest = split_number(raw)
        written = unit(rest) if rest else ONE
        return Setting(parse(raw, written), written.dimension)
    if isinstance(raw, int | float) and not isinstance(raw, bool):
        Given("", ONE).read(raw)
        return Setting(float(raw), ONE.dimension)
    raise InputError("type-number", text=quote(type(raw).__name__))


def read_variants(
    checker: Checker, raw: object, givens: Mapping[str, Given], optional: Container[str]
) -> dict[str, Variant]:
    """Read `[[variant]]`: every row states every given that has no default, and no two rows share an id.

    Those that are `optional` may be left out.
    """
    variants: dict[str, Variant] = {}
    stated: dict[str, Path] = {}
    for path, row in rows(checker, ("variant",), raw):
        if not isinstance(row, dict):
            checker.fault(path, InputError("type-table"))
            continue
        fields = {
            key: Field(trying(given.read), given.default is None and key not in optional)
            for key, given in givens.items()
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


@dataclass(slots=True)
class Names:
    """The values that a mechanism may name, and what it turned out to use.

    A name whose own line is at fault has no dimension, and may stand anywhere. `stated` says where each name stands.
    `literals` are constants by value and dimension, `named` those of them that have customary names, such as links;
    `bounds` say which values a name may have: without a length or a speed of the crank there is no plan; givens that
    are `optional` need no value.
    """

    dimensions: dict[str, Dimension | None]
    stated: dict[str, Path] = field(default_factory=dict)
    literals: dict[tuple[float, Dimension], str] = field(default_factory=dict)
    named: dict[str, float] = field(default_factory=dict)
    bounds: dict[str, Bound] = field(default_factory=dict)
    optional: set[str] = field(default_factory=set)
    signs: set[str] = field(default_factory=set)

    def place(self, checker: Checker, path: Path, raw: object) -> str | None:
        """Read a coordinate: the name of a length, a minus before it or not, or a literal with its unit."""
        return self.value(_M, signed=True)(checker, path, raw)

    def value(self, wanted: Unit, signed: bool = False) -> Named:
        """Return a reader of a value of the dimension of `wanted`: a name, or a literal with its unit.

        A minus may stand before a `signed` name.
        """

        def read(checker: Checker, path: Path, raw: object) -> str | None:
            bare = raw.removeprefix("-") if isinstance(raw, str) and signed else raw
            if isinstance(bare, str) and NAME.fullmatch(bare):
                if bare not in self.dimensions:
                    fitting = [name for name, own in self.dimensions.items() if own in (None, wanted.dimension)]
                    checker.fault(path, unknown("value-unknown", bare, fitting or self.dimensions))
                    return None
                found, written = bare if bare == raw else MINUS + bare, self.dimensions[bare]
                if written is None:
                    return found
            elif isinstance(bare, str) and NAME.fullmatch(latin(bare)):
                checker.fault(path, cyrillic(bare))
                return None
            else:
                setting = self.literal(checker, path, raw, wanted)
                if setting is None:
                    return None
                found, written = self.constant(setting.value, setting.dimension), setting.dimension
            if written != wanted.dimension:
                checker.fault(path, InputError("value-wrong", text=quote(raw), expected=customary(wanted)))
                return None
            return found

        return read

    def above_zero(self, wanted: Unit) -> Named:
        """Return a reader of a value that is greater than zero."""

        def read(checker: Checker, path: Path, raw: object) -> str | None:
            found = self.value(wanted)(checker, path, raw)
            if found in self.dimensions:
                self.bounds[found] = Bound.POSITIVE
            elif found is not None and not self.constants.get(found, 0.0) > 0.0:
                checker.fault(path, InputError("not-positive", text=quote(raw)))
                return None
            return found

        return read

    def dimension_of(self, raw: object) -> Dimension | None:
        """Return the dimension of a name or a literal, None for what is neither."""
        if not isinstance(raw, str):
            return ONE.dimension
        if NAME.fullmatch(raw):
            return self.dimensions.get(raw)
        try:
            return unit(split_number(raw)[1]).dimension
        except InputError:
            return None

    @staticmethod
    def literal(checker: Checker, path: Path, raw: object, wanted: Unit) -> Setting | None:
        """Read a literal with its unit; a mass is not negative."""
        setting: Setting | None = literal(checker, path, raw)
        if setting is not None and setting.dimension == ONE.dimension != wanted.dimension:
            checker.fault(path, InputError("unit-missing", text=quote(raw), expected=customary(wanted)))
        elif setting is not None and setting.value < 0.0 and setting.dimension in NEVER_NEGATIVE:
            checker.fault(path, InputError("negative", text=quote(raw)))
        else:
            return setting
        return None

    def sign(self, checker: Checker, path: Path, raw: object) -> str | None:
        """Read a sense or a branch: +1 or -1, or the name of one that a choice sets."""
        found = self.value(ONE)(checker, path, raw)
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
        return {constant: value for (value, _), constant in self.literals.items()} | self.named

    def called(self, name: str, found: str | None) -> str | None:
        """Call a literal by its customary name, `m_3`, where nothing else is called so."""
        value = self.constants.get(found or "")
        if value is None or name in self.dimensions or self.named.setdefault(name, value) != value:
            return found
        return name

    def on_axis(self, points: dict[str, tuple[str, str]]) -> dict[str, tuple[str, str]]:
        """Call literal distances from the origin of a link by their ends, `l_AB`, where nothing else is called so."""
        start = next((point for point, at in points.items() if at == (ZERO, ZERO)), "")
        named = dict(points)
        for end, (x, y) in points.items():
            name, value = f"l_{start}{end}", self.constants.get(x, 0.0)
            free = start and y == ZERO and value > 0.0 and name not in self.dimensions
            if free and self.named.setdefault(name, value) == value:
                named[end] = (name, y)
        return named


def check_numbers(
    checker: Checker, names: Names, givens: Givens, stranger: str, unused: Mapping[str, InputError] | None = None
) -> None:
    """Check that the numbers are there that are needed, and no others; bound them, and fill in the usual ones.

    Of another name a message with the key `stranger` tells, of one that is `unused` by this very subject its error.
    """
    numbers, unused = {name: given for name, given in givens.items() if not given.choices}, unused or {}
    for key, dimension in names.dimensions.items():
        place, number = names.stated.get(key, ("givens",)), numbers.get(key)
        if number is None:
            checker.fault(place, unknown(stranger, key, numbers))
        elif key in unused:
            checker.fault(place, unused[key])
        elif dimension not in (None, (wanted := unit(number.unit or "1")).dimension):
            checker.fault(place, InputError("value-wrong", text=key, expected=customary(wanted)))
        else:
            names.bounds[key] = number.bound
    for key, number in numbers.items():
        needed = number.needed and key not in unused
        if not needed or number.default is not None:
            names.optional.add(key)
        if needed and isinstance(number.default, float):
            names.named[key] = number.default  # a variant may say another
        elif needed and key not in names.dimensions:
            checker.fault(("givens",), InputError("key-missing", name=key))
