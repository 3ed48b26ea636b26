"""Units: what people write behind a number, its dimension, its factor to SI, and its spelling in each language.

Inside the package everything is SI; a unit stands only at the edge. A unit is a product of powers of the symbols in
`SYMBOLS`, written `kg*m^2`, `м/с²`, `об/хв`, `(m/s)/mm`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import NamedTuple

from .errors import RAISED, InputError, Spoken
from .numbers import quote, split_number


class Dimension(NamedTuple):
    """Powers of length, mass, time and plane angle.

    The angle is counted so that degrees, per cent and plain numbers are not mistaken for one another.
    """

    length: int = 0
    mass: int = 0
    time: int = 0
    angle: int = 0


@dataclass(frozen=True, slots=True)
class _Symbol:
    """One symbol of a unit: `num / den` makes it SI; kept apart, so that 55 mm is 55/1000 and not 55*0.001."""

    dimension: Dimension
    num: float
    den: int
    en: str
    uk: str
    ru: str
    also: tuple[str, ...] = ()


_LENGTH, _MASS, _TIME, _ANGLE = Dimension(1), Dimension(0, 1), Dimension(0, 0, 1), Dimension(0, 0, 0, 1)
_FORCE, _PRESSURE = Dimension(1, 1, -2), Dimension(-1, 1, -2)
_ENERGY, _POWER = Dimension(2, 1, -2), Dimension(2, 1, -3)

_DEGREES = ("deg", "град", "º", "˚", "degree", "degrees", "градуси", "градусів", "градусы", "градусов")

SYMBOLS: dict[str, _Symbol] = {
    "m": _Symbol(_LENGTH, 1, 1, "m", "м", "м"),
    "dm": _Symbol(_LENGTH, 1, 10, "dm", "дм", "дм"),
    "cm": _Symbol(_LENGTH, 1, 100, "cm", "см", "см"),
    "mm": _Symbol(_LENGTH, 1, 1000, "mm", "мм", "мм"),
    "um": _Symbol(_LENGTH, 1, 1_000_000, "μm", "мкм", "мкм", ("um", "µm", "мк")),
    "km": _Symbol(_LENGTH, 1000, 1, "km", "км", "км"),
    "kg": _Symbol(_MASS, 1, 1, "kg", "кг", "кг"),
    "g": _Symbol(_MASS, 1, 1000, "g", "г", "г"),
    "t": _Symbol(_MASS, 1000, 1, "t", "т", "т"),
    "s": _Symbol(_TIME, 1, 1, "s", "с", "с", ("sec", "сек")),
    "ms": _Symbol(_TIME, 1, 1000, "ms", "мс", "мс"),
    "min": _Symbol(_TIME, 60, 1, "min", "хв", "мин"),
    "h": _Symbol(_TIME, 3600, 1, "h", "год", "ч"),
    "rad": _Symbol(_ANGLE, 1, 1, "rad", "рад", "рад", ("radian", "radians")),
    "deg": _Symbol(_ANGLE, math.pi, 180, "°", "°", "°", _DEGREES),
    "arcmin": _Symbol(_ANGLE, math.pi, 10_800, "′", "′", "′", ("arcmin", "'", "’")),
    "rev": _Symbol(_ANGLE, 2 * math.pi, 1, "rev", "об", "об", ("r",)),
    "rpm": _Symbol(Dimension(time=-1, angle=1), math.pi, 30, "rpm", "об/хв", "об/мин", ("RPM",)),
    "N": _Symbol(_FORCE, 1, 1, "N", "Н", "Н", ("н",)),
    "kN": _Symbol(_FORCE, 1000, 1, "kN", "кН", "кН", ("кн",)),
    "MN": _Symbol(_FORCE, 1_000_000, 1, "MN", "МН", "МН"),
    "Pa": _Symbol(_PRESSURE, 1, 1, "Pa", "Па", "Па", ("па",)),
    "kPa": _Symbol(_PRESSURE, 1000, 1, "kPa", "кПа", "кПа", ("кпа",)),
    "MPa": _Symbol(_PRESSURE, 1_000_000, 1, "MPa", "МПа", "МПа"),
    "GPa": _Symbol(_PRESSURE, 1_000_000_000, 1, "GPa", "ГПа", "ГПа"),
    "J": _Symbol(_ENERGY, 1, 1, "J", "Дж", "Дж", ("дж",)),
    "kJ": _Symbol(_ENERGY, 1000, 1, "kJ", "кДж", "кДж"),
    "W": _Symbol(_POWER, 1, 1, "W", "Вт", "Вт", ("вт",)),
    "kW": _Symbol(_POWER, 1000, 1, "kW", "кВт", "кВт", ("квт",)),
    "%": _Symbol(Dimension(), 1, 100, "%", "%", "%"),
}

# the symbols that stand for 1 in SI; per cents are plain numbers
_COHERENT = {symbol.dimension: name for name, symbol in SYMBOLS.items() if symbol.num == symbol.den == 1}

# Letters that look alike in both alphabets: a Cyrillic "с" or "Н" typed on the wrong layout is still a unit.
_ALIKE = str.maketrans("асеоркНМТ", "aceopkHMT")
_SPELLINGS = {
    spelling.translate(_ALIKE): name
    for name, symbol in SYMBOLS.items()
    if name != "rpm"  # "об/хв" is read as a quotient
    for spelling in (name, symbol.en, symbol.uk, symbol.ru, *symbol.also)
} | {"rpm": "rpm", "RPM": "rpm"}

# In SI; no drawing has links, masses or forces beyond these, and none of their products leaves the range of a float.
SMALLEST, LARGEST = 1e-12, 1e9
LARGEST_OF = {_PRESSURE: 1e15}  # what is large in SI already

_SUPERSCRIPT = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
_TOKEN = re.compile(
    r"\s*(?:(?P<power>(?:\^|\*\*)\s*(?:[-−]?[0-9]|\([-−]?[0-9]\))|[-−]?[0-9]|⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹])"
    r"|(?P<sign>[*·⋅×∙./()])|(?P<symbol>[A-Za-zµμА-Яа-яІіЇїЄєҐґ]+|[°º˚′'’%]))\s*"
)
# Нм, kgm²: moments as they are written by hand
_JOINED = re.compile(r"\b([kк]?[NНн]|kg|кг)((?:[mм]|[cс])?[mм])(?![A-Za-zА-Яа-яІіЇїЄєҐґ])")
_FULL_STOP = re.compile(r"(?<=\S)\.(?![^\W⁰¹²³⁴⁵⁶⁷⁸⁹])")  # об./мин.; between letters it multiplies: Н.м
_TIMES = frozenset("*·⋅×∙.")
_LONGEST = 40

Powers = list[tuple[str, int]]


@dataclass(frozen=True)
class Unit:
    """A product of powers of symbols, in the order in which it was written."""

    powers: tuple[tuple[str, int], ...]

    @cached_property
    def dimension(self) -> Dimension:
        """Powers of length, mass, time and angle."""
        counted = ([power * times for power in SYMBOLS[name].dimension] for name, times in self.powers)
        return Dimension(*map(sum, zip(*counted, strict=True)))

    @cached_property
    def ratio(self) -> tuple[float, float]:
        """Numerator and denominator of the factor to SI; whole numbers wherever the unit has no angle."""
        num: float = 1
        den: float = 1
        for name, power in self.powers:
            symbol = SYMBOLS[name]
            up, down = (symbol.num, symbol.den) if power > 0 else (symbol.den, symbol.num)
            num *= up ** abs(power)
            den *= down ** abs(power)
        if isinstance(num, int) and isinstance(den, int):
            common = math.gcd(num, den)
            return num // common, den // common
        return num, den

    def to_si(self, value: float) -> float:
        """Return `value` of this unit in SI."""
        num, den = self.ratio
        return value * num / den

    def from_si(self, value: float) -> float:
        """Return the SI `value` in this unit."""
        num, den = self.ratio
        return value * den / num

    @cached_property
    def si(self) -> Unit:
        """The unit of SI in its place: m for mm, rad/s for rpm, kg*m^2 for g*cm^2."""
        powers: dict[str, int] = {}
        for name, power in self.powers:
            parts = (("rad", 1), ("s", -1)) if name == "rpm" else ((_COHERENT.get(SYMBOLS[name].dimension, ""), 1),)
            for base, times in parts:
                powers[base] = powers.get(base, 0) + power * times
        return Unit(tuple((base, power) for base, power in powers.items() if base and power))

    @property
    def name(self) -> str:
        """The ASCII name, such as `kg*m^2` or `(m/s)/mm`."""
        return _spell(self, {name: name for name in SYMBOLS}, "*", lambda power: f"^{power}")

    @property
    def behind(self) -> str:
        """What stands behind a number: the ASCII name, nothing where there is no unit."""
        return self.name if self.powers else ""

    def __str__(self) -> str:
        """Return the ASCII name."""
        return self.name


ONE = Unit(())
USUAL = {"Pa": "MPa", "m^2": "mm^2"}  # SI units, with those in which people know what has them
SHOWN = {"m": "mm", "rad": "deg", "Pa": USUAL["Pa"]}  # SI units, with those in which columns over a motion are read


@cache
def unit(text: str) -> Unit:
    """Return the unit written as `text`, in any of the three languages.

    Raises
    ------
    InputError
        `unit-unknown`, or `unit-unknown-like` with the unit that was probably meant.

    >>> unit("кг м²").name, unit("об/хв").name, unit("с⁻¹").name, unit("м·с^-1/мм").name
    ('kg*m^2', 'rpm', '1/s', '(m/s)/mm')
    """
    tokens = _tokens(text)
    try:
        factors = _product(tokens)
    except (IndexError, KeyError) as error:
        raise _unknown(text) from error
    if tokens:
        raise _unknown(text)
    powers: dict[str, int] = {}
    for name, power in factors:
        powers[name] = powers.get(name, 0) + power
    named = {name: power for name, power in powers.items() if power}
    if any(abs(power) > 9 for power in named.values()):
        raise _unknown(text)
    return RPM if named == {"rev": 1, "min": -1} else Unit(tuple(named.items()))


def _tokens(text: str) -> list[tuple[str, str]]:
    """Cut a unit into (kind, token), the last one first."""
    tokens: list[tuple[str, str]] = []
    at, apart = 0, _JOINED.sub(r"\1*\2", _FULL_STOP.sub("", text)) if len(text) <= _LONGEST else ""
    if text and not apart:
        raise _unknown(text)
    while at < len(apart):
        found = _TOKEN.match(apart, at)
        if found is None:
            raise _unknown(text)
        kind = str(found.lastgroup)
        tokens.append((kind, found[kind]))
        at = found.end()
    return tokens[::-1]


def _product(tokens: list[tuple[str, str]]) -> Powers:
    """Take a product or quotient: a division holds for one factor, as in `кг/с*м`; side by side is a product."""
    factors = _factor(tokens)
    while tokens and tokens[-1] != ("sign", ")"):
        side = 1
        if tokens[-1][0] == "sign" and tokens[-1][1] in _TIMES | {"/"}:
            side = -1 if tokens.pop()[1] == "/" else 1
        factors += [(name, side * power) for name, power in _factor(tokens)]
    return factors


def _factor(tokens: list[tuple[str, str]]) -> Powers:
    """Take one symbol or parenthesis with its power, or the 1 of `1/s`."""
    kind, token = tokens.pop()
    if (kind, token) == ("power", "1"):
        return []
    if kind == "symbol":
        base: Powers = [(_SPELLINGS[token.translate(_ALIKE)], 1)]
    elif token == "(":
        base = _product(tokens)
        if tokens.pop() != ("sign", ")"):
            raise KeyError(token)
    else:
        raise KeyError(token)
    if tokens and tokens[-1][0] == "power":
        digits = re.sub(r"[\^*()\s]", "", tokens.pop()[1].translate(_SUPERSCRIPT))
        base = [(name, power * int(digits)) for name, power in base]
    return base


def _unknown(text: str) -> InputError:
    """Return the error for a unit that nobody knows."""
    from difflib import get_close_matches

    folded = text.translate(_ALIKE)
    like = [known for known in _SPELLINGS if known.lower() == folded.lower()]
    like = like or get_close_matches(folded, [known for known in _SPELLINGS if len(known) > 1], n=1, cutoff=0.6)
    if like:
        return InputError("unit-unknown-like", text=quote(text), like=UnitName(_SPELLINGS[like[0]]))
    return InputError("unit-unknown", text=quote(text), known=UnitName(", ".join(_COMMON)))


def parse(text: str, expected: Unit, default: Unit | None = None) -> float:
    """Return the quantity written as `text` in SI.

    Parameters
    ----------
    text : str
        A number with or without a unit: `55 mm`, `55,5мм`, `765 об/хв`, `1e-3 m`, `30°15′`.
    expected : Unit
        Any unit of the wanted dimension.
    default : Unit, optional
        The unit of a number that has none; without it a unit is required (a plain number needs none).

    Raises
    ------
    InputError
        No number, an unknown unit, a missing one, or one of another dimension.

    >>> parse("55,5 мм", unit("m"))
    0.0555
    """
    sexagesimal = _SEXAGESIMAL.fullmatch(text.strip())
    if sexagesimal and expected.dimension == _ANGLE:
        degrees = float(sexagesimal[2]) + float(sexagesimal[3].replace(",", ".")) / 60
        return unit("deg").to_si(-degrees if sexagesimal[1] else degrees)
    value, rest = split_number(text)
    if rest:
        written = unit(rest)
    elif default is not None or expected == ONE:
        written = default or ONE
    else:
        raise InputError("unit-missing", text=quote(text.strip()), expected=customary(expected))
    return converted(value, written, expected)


def converted(value: float, written: Unit, expected: Unit, least: float = SMALLEST) -> float:
    """Return `value`, given in the unit `written`, in SI; refuse a unit of another dimension than `expected`.

    An angular velocity may leave its angle out: 1/s is rad/s, but 1/min is a number of revolutions. What is `least`
    but for zero, and largest, is the same for all that people write.
    """
    dimension = written.dimension
    if dimension != expected.dimension:
        unturned = expected.dimension._replace(angle=0)
        if dimension != unturned or not expected.dimension.angle or not dimension.time:
            raise InputError("unit-wrong", text=UnitName(written.name), expected=UnitName(expected.name))
        if written == unit("1/min"):
            written = RPM
    result = written.to_si(value)
    if least <= abs(result) <= LARGEST_OF.get(dimension, LARGEST) and result:
        return result
    text = f"{value:g} {written}"
    if value != 0.0 and result == 0.0 and least > 0.0:  # what no float holds
        raise InputError("number-infinite", text=quote(text))
    return bounded(result, expected, text, least)


def bounded(value: float, of: Unit, text: object, least: float = SMALLEST) -> float:
    """Return `value`, in SI, unless it is no number, or none that can be calculated with; `text` is what was written.

    Raises
    ------
    InputError
        `number-bad` of NaN, `number-infinite` of a number that is too large, or nearer to zero than `least`.
    """
    if math.isnan(value):
        raise InputError("number-bad", text=quote(text))
    if value != 0.0 and not least <= abs(value) <= LARGEST_OF.get(of.dimension, LARGEST):
        raise InputError("number-infinite", text=quote(text))
    return value


class UnitName(Spoken):
    """The name of a unit, or names with commas between, which messages spell as paper does."""

    __slots__ = ()

    def said(self, language: str) -> str:
        """Return the spelling in `language`."""
        names = self.split(", ")
        return str(self) if language == "en" else ", ".join(format_unit(name, language) or name for name in names)


@cache
def format_unit(written: Unit | str, language: str, *, raised: bool = False) -> str:
    """Return the spelling of a unit on paper: `м/с²`, `об/хв`, `кг·м²`, `(м/с)/мм`.

    With `raised`, powers are marked up (`м/с^{2}`) for text that is set with true superscripts. A number without a unit
    has nothing behind it.

    >>> format_unit("(m/s^2)/mm", "uk"), format_unit("1/s", "uk"), format_unit("1/s", "en")
    ('(м/с²)/мм', 'с⁻¹', '1/s')
    """
    spelled = unit(written) if isinstance(written, str) else written
    if not spelled.powers:
        return ""
    words = {name: str(getattr(symbol, language)) for name, symbol in SYMBOLS.items()}

    def power(exponent: int) -> str:
        return f"^{{{exponent}}}".replace("-", "−") if raised else str(exponent).translate(RAISED)

    if language != "en" and len(spelled.powers) == 1 and spelled.powers[0][1] < 0:
        name, exponent = spelled.powers[0]
        return words[name] + power(exponent)
    return _spell(spelled, words, "·", power)


def _spell(written: Unit, words: dict[str, str], times: str, power: Callable[[int], str]) -> str:
    """Write a unit as a fraction; a scale factor is something `(per)/mm`."""
    over = [words[name] + (power(p) if p > 1 else "") for name, p in written.powers if p > 0]
    under = [words[name] + (power(-p) if p < -1 else "") for name, p in written.powers if p < 0]
    top = times.join(over) or "1"
    if len(under) > 1 and written.powers[-1] == ("mm", -1):
        rest = times.join(under[:-1])
        return f"({top}/{rest if len(under) == 2 else f'({rest})'})/{under[-1]}"
    if len(under) > 1:
        return f"{top}/({times.join(under)})"
    return f"{top}/{under[0]}" if under else top


def customary(written: Unit) -> UnitName:
    """Return the name of the unit in which people write quantities of this kind: mm, deg, rpm, not m, rad, rad/s."""
    return UnitName(_CUSTOMARY.get(written.dimension, written.name))


RPM = Unit((("rpm", 1),))
_CUSTOMARY = {_LENGTH: "mm", _ANGLE: "deg", RPM.dimension: "rpm"}
_SEXAGESIMAL = re.compile(r"([-−]?)([0-9]{1,9})\s*[°º˚]\s*([0-9]{1,2}(?:[.,][0-9]{1,9})?)\s*['’′]")
_COMMON = ("mm", "m", "deg", "rad", "rpm", "rad/s", "kg", "kg*m^2", "N", "kN", "N*m", "MPa", "s", "m/s")
