"""What stands in a cell of an answer: a segment, a scale factor, a value, a direction, a calculation; or why none.

What cannot be read is refused with an InputError.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

from ...plans.marking.answers import nearest
from ...plans.quantities import Quantity
from ...scales.errors import InputError
from ...scales.names import latin
from ...scales.numbers import quote, split_number, with_power
from ...scales.scale import Display, as_ratio
from ...scales.units import Unit, bounded, converted, unit
from ..spreadsheets.grid import UNDERSTOOD, Grid, symbol, tidy

NONE = frozenset(UNDERSTOOD["none"])
CALCULATIONS = frozenset(UNDERSTOOD["calculation"])
SENSES = {word: int(sense) for sense, words in UNDERSTOOD["senses"].items() for word in words}
SIDES = {word: float(degrees) for degrees, words in UNDERSTOOD["directions"].items() for word in words}
TURNING: dict[str, list[str]] = UNDERSTOOD["turning"]
SIGNS = ("+", "-", "−", "–")
WORDIEST = 200  # characters of a cell in which a sense is looked for
_ALONG_OR_AGAINST = frozenset((*TURNING["along"], *TURNING["against"]))
_BEHIND = ("(+)", "(-)", "(−)", "(–)", "+")
_DOUBT = re.compile(r"(?<=[0-9])\s*[?]+$")  # behind a unit it may be a lost ²
_ARROWS = "".join(word for kind in ("clockwise", "counter") for word in TURNING[kind] if not word.isalpha())
# б and ю lie where other keyboards have comma and point: between digits they are decimal signs
_SIGN_KEY, _KEYS = re.compile("(?<=[0-9])[бюБЮ](?=[0-9])"), str.maketrans("бюБЮ", ",.,.")
_LETTER_INSIDE = re.compile(r"\S*[0-9](?:[^\W\d_][.,]?[0-9]|[.,][^\W\d_])")
_WIDE = str.maketrans("＋－", "+-")
_WORD = re.compile(rf"[^\W\d_]+|[{_ARROWS}]")
_DECIMALS = re.compile(r"[^0-9.,]*+[0-9 \u00a0\u2009\u202f]*+[.,]([0-9]+)")
_ANGLE = re.compile(r"[0-9]{1,9}(?:[.,][0-9]{1,9})?")  # in degrees
_SEXAGESIMAL = re.compile(
    r"([+\-−–]?[0-9]{1,4})\s*[°º]\s*([0-5]?[0-9])\s*['’′]?\s*(?:([0-5]?[0-9])\s*(?:[\"″]|''|′′))?"
)
_QUOTIENT = re.compile(r"(?<=[0-9])\s*:\s*(?=[0-9])")  # of whole numbers, 4:3
MM, DEGREE = unit("mm"), unit("deg")
NOTHING = 0.0  # a value may be as small as a calculator's rounding leaves it
LONGEST = 250  # characters of a calculation
DIGITS = 3  # from which a number with a decimal sign may be a rounded one
ROUNDING = 1e-9  # part of a value
_TOKEN = re.compile(r"\d+(?:[.,]\d*)?|[^\W\d_]+|[^\s]")
_NUMBER = re.compile(r"\d+(?:[.,]\d*)?")
_PI = re.compile(r"3[.,]14(?:1[56]\d*|2)?")  # written for pi
_SIGNS = str.maketrans(
    {**dict.fromkeys("·×⋅∙•∗", "*"), **dict.fromkeys("−–", "-"), **dict.fromkeys(":÷∕", "/"), "º": "°"}
    | {**dict.fromkeys("[{", "("), **dict.fromkeys("]}", ")")}
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_POWER = re.compile(r"[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    **dict.fromkeys(("√", "sqrt"), math.sqrt),
    "sin": math.sin,
    "cos": math.cos,
    **dict.fromkeys(("tg", "tan"), math.tan),
    **dict.fromkeys(("ctg", "cot"), lambda angle: 1.0 / math.tan(angle)),
}


@dataclass(frozen=True, slots=True)
class Mu:
    """A scale factor in SI per millimetre; `sure` when its unit says which way it is meant.

    Without a unit 0.05 may be metres per second to a millimetre, or millimetres to a metre per second.
    """

    value: float
    sure: bool = False

    @property
    def ways(self) -> tuple[float, ...]:
        """The factor as value per mm, in each way in which it may be meant."""
        return (self.value,) if self.sure else (self.value, 1.0 / self.value)

    def nearest(self, ours: float) -> float:
        """Return the factor in the way that is nearer to ours in ratio."""
        return nearest(self.ways, ours)


@dataclass(frozen=True, slots=True)
class Asked:
    """What can be answered in a task: its quantities, its scale factors, and the units in which it shows results.

    `others` are names of plans that are not marked now; answers to them are passed over. So are columns of a class over
    what is `unasked`, such as what is given: its key has them. `symbols` are the names by what the sheet shows of them.
    """

    quantities: Mapping[str, Quantity]
    scales: Mapping[str, str]  # SI unit of what a scale factor draws, by symbol
    display: Display = field(default_factory=Display)
    others: frozenset[str] = frozenset()
    unasked: frozenset[str] = frozenset()
    symbols: Mapping[str, str] = field(default_factory=dict)

    def meant(self, text: str) -> str:
        """Return the name of what is written by its name, or as the sheet shows it: `M_зр`, `ω_2`, `F_и3`, `VB`."""
        name = latin(text)
        return name if name in {*self.names} | self.others | self.unasked else self.symbols.get(folded(text), text)

    @property
    def names(self) -> tuple[str, ...]:
        """All names that an answer may have."""
        return (*(name for name, q in self.quantities.items() if q.kind != "point"), *self.scales)

    def unit(self, name: str) -> str:
        """Return the unit in which a quantity is asked for."""
        return self.display.unit(self.quantities[name].unit)


def folded(text: str) -> str:
    """Return a symbol as plain letters and digits, the index of inertia in Latin.

    >>> folded("F_и3"), folded("a^n_{BA}")
    ('Fi3', 'anBA')
    """
    return symbol(text).replace("и", "i")


def _known(written: str, wanted: Unit) -> Unit:
    """Return the unit that stands in a file; cp1251 has no ², which comes back as a question mark.

    Where only the unit without it is of the dimension `wanted`, it is that of somebody who doubts: `45мм?`.
    """
    if "?" in written:
        for of in ("2", ""):
            with suppress(InputError):
                found = unit(written.replace("?", of))
                if found.dimension == wanted.dimension:
                    return found
    return unit(written.replace("?", "2"))


def of_paper(written: str) -> bool:
    """Whether a unit is one in which segments are measured on paper."""
    return written.strip().lower() in UNDERSTOOD["paper"]


def checked(grid: Grid, row: int, column: int | None) -> str:
    """Return the text of a cell for a number; nothing where there is no answer.

    It is refused where it is a formula that nobody has worked out, or a date that a spreadsheet has made of a number.
    """
    text = grid.text(row, column)
    at = (row, column if column is not None else -1)
    if at in grid.formulas or (text.startswith("=") and len(text) > 1):
        raise InputError("answer-formula", text=quote(text))
    if at in grid.dates:
        raise InputError("answer-date")
    return "" if text in NONE else text


def with_signs(text: str) -> str:
    """Return a text in which б and ю between digits are the decimal signs of their keys: `12б3` is 12,3."""
    return _SIGN_KEY.sub(lambda found: found.group().translate(_KEYS), text)


def is_garbled(text: str) -> bool:
    """Whether a letter stands in a number where no unit begins: `12k3`, `1О,5`; it is not what stands before it."""
    return _LETTER_INSIDE.match(text) is not None


def signed(text: str) -> str:
    """Return a number with the sign directly before it that stands apart from it, or behind it: `28.79 (+)`.

    That it is told to be rounded, `≈ 28.79`, or is doubted, `28.79?`, says nothing more.
    """
    text = in_degrees(_DOUBT.sub("", text.translate(_WIDE).lstrip("≈~∼ ")))
    if text[:1] in "+-−–" and text[1:2].isspace():
        return text[0] + text[1:].lstrip()
    if not text.endswith(_BEHIND):
        return text
    behind = next(sign for sign in _BEHIND if text.endswith(sign))
    number = text.removesuffix(behind).strip()
    return behind.strip("()") + number if number[:1].isdigit() else text


def in_degrees(text: str) -> str:
    r"""Return an angle in degrees and minutes as one in degrees, to about a minute; any other text as it is.

    >>> in_degrees("26° 39′"), in_degrees("-5°07'30\""), in_degrees("26,65°")
    ('26.65°', '-5.1250°', '26,65°')
    """
    found = _SEXAGESIMAL.fullmatch(text.strip())
    if found is None:
        return text
    whole, minutes, seconds = found.groups()
    return f"{whole}.{f'{int(minutes) / 60.0 + int(seconds or 0) / 3600.0:.{4 if seconds else 2}f}'[2:]}°"


def segment(text: str, written: str) -> tuple[float, int]:
    """Return millimetres of paper, and the decimals with which they are written; `written` is the column's unit.

    What is no number is refused, and another unit than of length, or a negative one.
    """
    number, rest = split_number(text)
    own = _known(rest or written, MM) if rest or written else MM
    millimetres = converted(number, own, MM, NOTHING) * 1e3
    if number < 0.0:
        raise InputError("answer-negative", text=quote(text))
    decimals = _DECIMALS.match(text)
    digits = len(decimals[1]) if decimals else 0
    return millimetres, max(digits - round(math.log10(own.to_si(1e3))), 0)


def scale_factor(text: str, written: str, per_mm: str, display_per_mm: str) -> Mu:
    """Return a scale factor in SI per millimetre, of lengths also `1:5`; a unit may be `written` beside the number.

    The unit per millimetre is that in SI, and as the task shows it: what a bare number is meant in. What is no number
    is refused, and one that is not positive, or a unit that is none of a scale factor of this plan.
    """
    ratio = as_ratio(text) if unit(per_mm) == unit("m/mm") else None
    number, rest = split_number(text) if ratio is None else (ratio, "")
    if number <= 0.0:
        raise InputError("scale-not-positive", text=quote(text))
    if ratio is not None:
        return Mu(converted(ratio, MM, MM), sure=True)
    name, si = rest or written, unit(per_mm)
    own = _known(name, si) if name else unit(display_per_mm)
    on_paper = {("mm", 1), ("cm", 1)}
    if own.powers and own.powers[0] in on_paper and (own.powers[-1][0], -own.powers[-1][1]) not in on_paper:
        reciprocal = Unit(tuple((symbol, -power) for symbol, power in si.powers))
        return Mu(1e-3 / converted(number, own, reciprocal), sure=True)
    return Mu(converted(number, own, si) / 1e3, sure=bool(name))


def value(text: str, written: str, name: str, asked: Asked) -> float:
    """Return a value in the unit of its quantity; its own stands in the cell, or beside it, or is that of the form.

    What is no number is refused, and an unknown unit, or one that does not fit the quantity.
    """
    number, rest = split_number(_QUOTIENT.sub("/", text))
    own = unit(asked.quantities[name].unit)  # SI, but of a scale factor SI per millimetre
    return own.from_si(converted(number, _known(rest or written or asked.unit(name), own), own, NOTHING))


def rounded(text: str, value: float | None) -> float | None:
    """Return half of the last digit of a number as written, in the unit of its value; None where it has none."""
    text = _QUOTIENT.sub("/", text)
    number, rest = split_number(text)
    written = with_power(text.strip()).lower()
    mantissa, _, power = written[: len(written) - len(rest)].strip().replace(",", ".").partition("e")
    if not value or not number or "/" in mantissa:
        return None
    last = int(power.replace("−", "-") or 0) - len(mantissa.partition(".")[2])
    return 0.5 * 10.0**last * abs(value / number)


def bare(text: str, name: str, asked: Asked) -> float | None:
    """Return the number alone, as if it were in the form's unit; None where there is none."""
    try:
        shown, own = unit(asked.unit(name)), unit(asked.quantities[name].unit)
        return own.from_si(bounded(shown.to_si(split_number(text)[0]), own, text, NOTHING))
    except InputError:
        return None


def _any(*kinds: str) -> str:
    """Return a pattern of the words of some kinds; of those that end in * the beginning is enough."""
    words = (word for kind in kinds for word in TURNING[kind])
    return f"(?:{'|'.join(re.escape(word[:-1]) + '[^ ]*' if word[-1] == '*' else re.escape(word) for word in words)})"


_SURE, _CLOCKWORK = _any("clocks", "hands"), _any("clocks", "hands", "clock", "hand")
_OF_CLOCKS = f"{_SURE}(?: {_CLOCKWORK})?|{_CLOCKWORK} {_SURE}"
# a lone "за" or "по" is one at the end of a text only: between two words it may mean "per"
_SENSE = re.compile(
    f"(?<![^ ])(?:(?P<counter>{_any('counter_phrases', 'counter')})|{_any('clockwise_phrases', 'clockwise')}"
    f"|(?P<against>{_any('against')})(?:(?: {_any('course')})* (?:{_OF_CLOCKS}|{_any('clock')}(?: {_CLOCKWORK})?)|$)"
    f"|{_any('along')}(?:(?: {_any('course')})* (?:{_OF_CLOCKS}|{_any('clock')} {_any('hand')})|$))(?![^ ])"
)


def split_sense(text: str) -> tuple[str, frozenset[int]]:
    """Return a text without the words and arrows that say which way something turns, and these senses.

    >>> split_sense("16,3 рад/с за год. стрілкою")
    ('16,3 рад/с', frozenset({-1}))
    """
    if len(text) > WORDIEST:
        return text, frozenset()
    found = list(_WORD.finditer(text))
    words = " ".join(match.group().lower().replace("ё", "е") for match in found)
    senses, rest, after = set[int](), "", 0
    for sense in _SENSE.finditer(words):
        first, last = (found[words.count(" ", 0, end)] for end in sense.span())
        senses.add(1 if sense["counter"] or sense["against"] else -1)
        rest += text[after : first.start()].rstrip(" ([,;–-") + " "
        after = last.end()
        while text[after : after + 1] and text[after] in " .,;:)]\ufe0f":
            after += 1
    return ((rest + text[after:]).strip(), frozenset(senses)) if senses else (text, frozenset())


def split_side(text: str) -> tuple[str, float | None]:
    """Return a text without the word or arrow of a side that stands last, and its angle in radians.

    >>> split_side("3,4 м/с вправо")
    ('3,4 м/с', 0.0)
    """
    before, _, last = text.rstrip(" .,;)").replace("(", " ").rpartition(" ")
    side = SIDES.get(tidy(last))
    return (text, None) if side is None else (before.rstrip(" ,;"), math.radians(side))


def direction(text: str, vector: bool = False) -> tuple[float | None, int | None]:
    """Return an angle in radians from the x axis, or a sense; of a vector a number is an angle, also 1.

    What is neither an angle in degrees nor a sense is refused, and two senses; of a vector what is no angle.
    """
    text = in_degrees(text)
    if vector and _ANGLE.fullmatch(text):
        return converted(split_number(text)[0], DEGREE, DEGREE), None
    word = tidy(text)
    if word in SIDES:
        return math.radians(SIDES[word]), None
    if text in SIGNS and not vector:
        return None, 1 if text == "+" else -1
    if word in SENSES and not vector:
        return None, SENSES[word]
    angle, senses = split_sense(text)
    if len(senses) > 1:
        raise InputError("answer-senses", text=quote(text))
    first = tidy(text).split()[:1]  # "за год." is no "per hour" here
    sense = next(iter(senses), None) or next((SENSES[word] for word in first if word in _ALONG_OR_AGAINST), None)
    if sense is not None and not vector:
        return None, sense
    try:
        number, rest = split_number(angle)
        return (sense or 1) * converted(number, unit(rest) if rest else unit("deg"), unit("deg")), None
    except InputError:
        raise InputError("answer-vector-direction" if vector else "answer-direction", text=quote(text)) from None


# Calculations, worked out, and both sides held against each other. Numbers of three digits and more may have been
# rounded to the last one; shorter ones and whole ones are taken as exact. What cannot be worked out, such as letters,
# is passed over. A text is never run: only numbers, signs and a few functions are understood, of a bounded length.


class _Slip(NamedTuple):
    """A calculation that does not make what stands behind it."""

    text: str
    makes: float
    written: str


class _Value(NamedTuple):
    """A number, and by how much rounding of what it comes from may have moved it."""

    number: float
    off: float


@dataclass(slots=True)
class _Reader:
    """Works out a calculation, sign by sign; `pi` takes 3.14 for pi."""

    tokens: list[str]
    pi: bool
    at: int = 0

    def value(self) -> _Value:
        """Return what it makes; a ValueError where it is no calculation."""
        total = self._sum()
        if self.at < len(self.tokens) or not math.isfinite(total.number):
            raise ValueError
        return total

    def _next(self, *wanted: str) -> str:
        """Take the next sign if it is one of those wanted."""
        if self.at < len(self.tokens) and (not wanted or self.tokens[self.at] in wanted):
            self.at += 1
            return self.tokens[self.at - 1]
        return ""

    def _sum(self) -> _Value:
        total = self._product()
        while sign := self._next("+", "-"):
            other = self._product()
            number = total.number + other.number if sign == "+" else total.number - other.number
            total = _Value(number, total.off + other.off)
        return total

    def _product(self) -> _Value:
        total = self._power()
        while sign := self._next("*", "/"):
            other = self._power()
            if sign == "/":
                other = _Value(1.0 / other.number, other.off / other.number**2)
            off = abs(total.number) * other.off + abs(other.number) * total.off
            total = _Value(total.number * other.number, off)
        return total

    def _power(self) -> _Value:
        if sign := self._next("+", "-"):
            inside = self._power()
            return inside if sign == "+" else _Value(-inside.number, inside.off)
        base = self._primary()
        if not self._next("^"):
            return base
        sign = self._next("-")
        exponent = self._primary().number * (-1.0 if sign else 1.0)
        raised = math.pow(base.number, exponent)
        return _Value(raised, abs(exponent * raised / base.number) * base.off if base.off else 0.0)

    def _primary(self) -> _Value:
        token = self._next()
        if token == "(":
            inside = self._sum()
            if not self._next(")"):
                raise ValueError
            return inside
        if token.lower() in _FUNCTIONS:
            function, inside = _FUNCTIONS[token.lower()], self._power()
            number = function(inside.number)
            return _Value(number, abs(function(inside.number + inside.off) - number))
        if token in ("π", "pi"):
            return _Value(math.pi, 0.0)
        if not _NUMBER.fullmatch(token):
            raise ValueError
        times = math.radians(1.0) if self._next("°") else 1.0
        if _PI.fullmatch(token) and self.pi:
            return _Value(math.pi, 0.0)
        exact = _PI.fullmatch(token) or len(re.sub("[.,]", "", token).lstrip("0")) < DIGITS or token.isdigit()
        return _Value(float(token.replace(",", ".")) * times, 0.0 if exact else 0.5 * _last_digit(token) * times)


def slip_in(text: str) -> _Slip | None:
    """Return the first place of a calculation where two sides are not equal; None where all are, or none is one.

    >>> slip_in("d = 75 · 0,93969 = 70,747675")
    _Slip(text='75 · 0,93969', makes=70.47675, written='70,747675')
    >>> slip_in("15 · 5/2 = 37,5") is None
    True
    """
    if "=" not in text or len(text) > LONGEST:
        return None
    sides = [side.strip() for side in text.split("=")]
    last = re.sub(r"^([+\-−–])\s+", r"\1", sides[-1])
    with suppress(InputError):  # a calculation stays as it is, a number is without its unit
        rest = split_number(last)[1]
        last = last[: len(last) - len(rest)].strip() if rest[:1].isalpha() or rest[:2] == "1/" else last
    worked = [(side, _ways(side)) for side in (*sides[:-1], last)]
    known = [(side, ways) for side, ways in worked if ways]
    for (side, ways), (written, others) in pairwise(known):
        # equal but for rounding, and for the sign: it may stand for a sense
        apart = ((abs(abs(a.number) - abs(b.number)), a.off + b.off, abs(a.number)) for a in ways for b in others)
        if not any(off <= rounded + ROUNDING * size for off, rounded, size in apart):
            return _Slip(quote(side, LONGEST), ways[-1].number, quote(written))
    return None


def _ways(side: str) -> list[_Value]:
    """Return what a side makes, with 3.14 as it stands and as pi; nothing where it is no calculation.

    A number alone is a result: it may be rounded to its last digit, or cut off there; a whole one, to or at the last
    that is not zero.
    """
    plain = _POWER.sub(lambda found: f"^{found.group().translate(_RAISED)}", side).translate(_SIGNS)
    tokens = _TOKEN.findall(plain)
    try:
        if _NUMBER.fullmatch(tokens[-1]) and tokens[:-1] in ([], ["-"], ["+"]):
            digit = _last_digit(tokens[-1])
            return [_Value(float(tokens[-1].replace(",", ".")) + 0.25 * digit, 0.75 * digit)]
        ways = (False, True) if any(map(_PI.fullmatch, tokens)) else (False,)
        return [_Reader(tokens, pi).value() for pi in ways]
    except (ValueError, ArithmeticError, IndexError, RecursionError):
        return []


def _last_digit(number: str) -> float:
    """Return a unit of the last digit of a number, of a whole one the last that is not zero."""
    whole, _, decimals = number.replace(",", ".").partition(".")
    return 10.0 ** (-len(decimals) if decimals else len(whole) - len(whole.rstrip("0") or whole))
