"""The values that a subject may name: givens, what choices set, and literals; or numbers that all have names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...plans.linkages.mechanism import MINUS, ZERO
from ...scales.errors import InputError
from ...scales.names import cyrillic, latin, unknown
from ...scales.numbers import quote, split_number
from ...scales.units import ONE, Dimension, Unit, customary, unit
from ..task import Bound
from ..toml_places import Path
from .basics import NAME, Checker, Read
from .givens import NEVER_NEGATIVE, Setting, literal

_M = unit("m")


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
        found: str | None = self.value(_M, signed=True)(checker, path, raw)
        return found

    def value(self, wanted: Unit, signed: bool = False) -> Read:
        """Return a reader of a value of the dimension of `wanted`: a name, or a literal with its unit.

        A minus may stand before a `signed` name.
        """

        def read(checker: Checker, path: Path, raw: object) -> str | None:
            bare = raw.removeprefix("-") if isinstance(raw, str) and signed else raw
            if isinstance(bare, str) and NAME.fullmatch(bare):
                if bare not in self.dimensions:
                    checker.fault(path, unknown("value-unknown", bare, self.dimensions))
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

    def above_zero(self, wanted: Unit) -> Read:
        """Return a reader of a value that is greater than zero."""

        def read(checker: Checker, path: Path, raw: object) -> str | None:
            found: str | None = self.value(wanted)(checker, path, raw)
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
        setting = literal(checker, path, raw)
        if setting is not None and setting.dimension == ONE.dimension != wanted.dimension:
            checker.fault(path, InputError("unit-missing", text=quote(raw), expected=customary(wanted)))
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


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a subject: which values it may have, whether it is needed, what it is where nobody says.

    The default is in SI. A number that is `unused` by this very subject is refused with that error.
    """

    bound: Bound = Bound.POSITIVE
    needed: bool = True
    default: float | None = None
    unused: InputError | None = None


def check_numbers(
    checker: Checker, names: Names, numbers: Mapping[str, Number], units: Mapping[str, str], stranger: str
) -> None:
    """Check that the numbers are there that are needed, and no others; bound them, and fill in the usual ones.

    Parameters
    ----------
    numbers : mapping
        What the subject has, by name.
    units : mapping
        Their SI units, empty for a plain number.
    stranger : str
        Key of the message about a name that is not among the numbers.
    """
    for name, dimension in names.dimensions.items():
        place, number = names.stated.get(name, ("givens",)), numbers.get(name)
        if number is None:
            checker.fault(place, unknown(stranger, name, numbers))
        elif number.unused is not None:
            checker.fault(place, number.unused)
        elif dimension not in (None, (wanted := unit(units[name] or "1")).dimension):
            checker.fault(place, InputError("value-wrong", text=name, expected=customary(wanted)))
        else:
            names.bounds[name] = number.bound
    for name, number in numbers.items():
        if not number.needed or number.default is not None:
            names.optional.add(name)
        if number.needed and number.default is not None:
            names.named[name] = number.default  # a variant may say another
        elif number.needed and name not in names.dimensions:
            checker.fault(("givens",), InputError("key-missing", name=name))
