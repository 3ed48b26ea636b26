"""Scale factors: value per millimetre of the sheet; how one is chosen, and in which units results are shown.

One is chosen by a given mu, the length of a segment such as pa = 80 mm, a round mu, or the crank scale. Each gives a
ladder of scale factors, the wanted one first, then coarser and coarser: the sheet takes the first that fits. What a
user has fixed has one rung.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from .errors import InputError
from .numbers import quote, split_number
from .units import SYMBOLS, USUAL, Unit, UnitName, parse, unit

# GOST 2.302 and its reciprocals give the same customary mantissas
SERIES = (1.0, 2.0, 2.5, 4.0, 5.0)
EXACT, SEEN = 6, 0.005  # digits of a scale factor at most, for a segment that is so long to so many mm

RUNGS = 16
CRANK = {"V": 1, "a": 2}
UNITS = {"l": "m", "s": "m", "V": "m/s", "a": "m/s^2", "F": "N", "h": "m/s"}  # arms on the lever are velocities
# a segment by its letters on the plan, and the quantity that it shows: pa is V_A, p'a' is a_A, OA is l_OA
_RATIO = re.compile(r"(?:[MМ]\s*)?([0-9]{1,9}(?:[.,][0-9]{1,9})?)\s*:\s*([0-9]{1,9}(?:[.,][0-9]{1,9})?)")  # 1:2,5
SEGMENT_OF = {
    "a": re.compile(r"[pπ]['′]?([a-z])(\d*)['′](\d*)"),
    "V": re.compile(r"p([a-z])(\d*)"),
    "l": re.compile(r"([A-Z]\d*[A-Z]\d*)"),
}

LENGTHS = tuple(name for name, symbol in SYMBOLS.items() if symbol.dimension == SYMBOLS["m"].dimension)
PAPER = ("mm", "cm")
METRE, RADIAN = "m", "rad"
ANGLES = (RADIAN, "deg")


@dataclass(frozen=True, slots=True)
class Scale:
    """A scale factor such as mu_V = 0.05 (m/s)/mm.

    Parameters
    ----------
    symbol : str
        `mu_l`, `mu_V`, `mu_a`, `mu_F_23`, ...
    mu : float
        Value in `unit` per millimetre.
    unit : str
        Unit of the value drawn, SI: `m`, `m/s`, `m/s^2`, `N`.
    paper : str
        What the segments are measured in: millimetres, unless the factor is only shown.
    """

    symbol: str
    mu: float
    unit: str
    paper: str = "mm"

    def drawn(self, value: float) -> float:
        """Return the millimetres that show `value`."""
        return value / self.mu

    def measured(self, millimetres: float) -> float:
        """Return the value that `millimetres` show."""
        return millimetres * self.mu

    @property
    def per_mm_unit(self) -> UnitName:
        """Unit of the scale factor, `m/mm` or `(m/s)/mm`."""
        of = f"({self.unit})" if "/" in self.unit or "*" in self.unit else self.unit
        return UnitName(f"{of}/{self.paper}")

    @property
    def per_unit(self) -> float:
        """The same scale factor in the other convention: millimetres per unit of the value."""
        return 1.0 / self.mu


def rounded(mu: float, digits: int = 3) -> float:
    """Round a scale factor to so many significant digits: what is printed is what is drawn."""
    return float(f"{mu:.{digits - 1}e}")


def steps(mu: float, series: tuple[float, ...] = SERIES) -> tuple[float, ...]:
    """Return the members of `series` times powers of ten from `mu` upwards, two decades of them."""
    decade = math.floor(math.log10(mu))
    members = [round(m * 10.0**e, 15 - e) for e in range(decade, decade + 3) for m in series]
    return tuple(m for m in members if m >= mu * (1.0 - 1e-9))


@dataclass(frozen=True, slots=True)
class Fixed:
    """A given mu in SI per millimetre; `firm` when the user has said so himself."""

    mu: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return mu; the rounder coarser ones, unless it is firm, are for a page that cannot hold the plan alone."""
        return (self.mu,) if self.firm else From(self.mu).ladder(value)


@dataclass(frozen=True, slots=True)
class From:
    """A given mu in SI per millimetre, or a coarser one where so the sheet is a single one."""

    mu: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return mu, then the rounder coarser ones."""
        return (self.mu, *(mu for mu in steps(self.mu) if mu > self.mu * 1.0001))[:RUNGS]


@dataclass(frozen=True, slots=True)
class Segment:
    """The segment of quantity `quantity` is about `millimetres` long, at a round mu; it is exactly so where firm."""

    quantity: str
    millimetres: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return the mu of the customary series with the nearest length, then coarser ones."""
        size = value(self.quantity)
        if self.firm:  # as few digits as the length needs
            rough = (rounded(size / self.millimetres, digits) for digits in range(3, EXACT))
            exact = rounded(size / self.millimetres, EXACT)
            return (next((mu for mu in rough if abs(size / mu - self.millimetres) < SEEN), exact),)
        finer = [mu for mu in steps(size / self.millimetres / 10.0) if mu * self.millimetres < size * (1.0 - 1e-9)]
        series = (finer[-1], *steps(size / self.millimetres))
        first = int(abs(size / series[1] - self.millimetres) < abs(size / series[0] - self.millimetres))
        return series[first : first + RUNGS]


@dataclass(frozen=True, slots=True)
class Round:
    """The finest mu of the customary series at which the longest segment of the plan is at most `millimetres` long."""

    symbol: str
    millimetres: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return the series from that mu on; `value` of the symbol itself is the largest quantity drawn to it."""
        return steps(value(self.symbol) / self.millimetres)[:RUNGS]


@dataclass(frozen=True, slots=True)
class CrankScale:
    """mu_V = omega_1 * mu_l and mu_a = omega_1^2 * mu_l: the segment of the crank shows its velocity, its acceleration.

    Such a scale factor goes with mu_l; six digits keep pa = OA to a ten thousandth of a millimetre.
    """

    power: int
    firm: bool = False

    def ladder(self, value: Callable[[str], float], base: tuple[float, ...] = ()) -> tuple[float, ...]:
        """Return the ladder of mu_l times omega_1 or its square."""
        return tuple(rounded(mu * value("omega_1") ** self.power, 6) for mu in base)


Chooser = Fixed | From | Segment | Round | CrankScale
Choosers = Mapping[str, Chooser]


def chooser(symbol: str, text: str, firm: bool = False) -> Chooser:
    """Read how the scale factor `symbol` is chosen.

    Parameters
    ----------
    text : str
        `15 N/mm`, `20 mm/(m/s)` or `0.05` (a given mu), `pa=80 mm` (the mu of the customary series at which the segment
        is nearest to that), `exactly pa=80 mm`, `round` or `round 120 mm` (the customary series, the longest segment at
        most so long), `crank` (the crank scale), `from 15 N/mm` (this mu, or a coarser one of the series where there is
        little room).
    firm : bool
        Said by the user: no other scale factor will do.

    Raises
    ------
    InputError
        When the text is none of these.
    """
    kind = symbol.split("_")[1] if "_" in symbol else ""
    if kind not in UNITS:
        raise InputError("scale-symbol", text=quote(symbol))
    name, equals, rest = text.partition("=")
    if equals:
        millimetres = _positive(parse(rest, unit("mm"), unit("mm")) * 1e3, text)
        exactly, _, named = name.strip().rpartition(" ")
        letters = SEGMENT_OF[kind].fullmatch(named) if kind in SEGMENT_OF else None
        if letters is None or exactly.strip() not in ("", "exactly"):
            raise InputError("scale-segment", text=quote(name.strip()))
        quantity = f"{kind}_{''.join(letters.groups()).upper()}"  # what it shows
        return Segment(quantity, millimetres, firm or bool(exactly))
    word, _, rest = text.strip().partition(" ")
    if word == "round":
        return Round(symbol, _positive(parse(rest, unit("mm"), unit("mm")) * 1e3, text) if rest else 100.0, firm)
    if text.strip() == "crank" and kind in CRANK:
        return CrankScale(CRANK[kind], firm)
    if word == "from":
        return From(_given(kind, rest, text), firm)
    return Fixed(_given(kind, text, text), firm)


def as_ratio(text: str) -> float | None:
    """Return how many times as long as drawn a length is, of a scale such as `1:2,5`; None of another text.

    >>> as_ratio("1:2,5"), as_ratio("М 2:1"), as_ratio("2.5 mm")
    (2.5, 0.5, None)
    """
    found = _RATIO.fullmatch(text.strip())
    if found is None:
        return None
    drawn, real = (split_number(part)[0] for part in found.groups())
    return real / drawn if drawn else 0.0


def _given(kind: str, written: str, text: str) -> float:
    """Read a scale factor in either convention, of lengths also `1:2`; `text` is the whole of what was said."""
    ratio = as_ratio(written) if kind == "l" else None
    if ratio is not None:
        return _positive(ratio, text) / 1e3
    if split_number(written)[1].replace("мм", "mm").startswith("mm/"):  # the other convention: millimetres per unit
        per_unit = parse(written, unit(f"mm/({UNITS[kind]})")) * 1e3
        return 1.0 / _positive(per_unit, text)
    per_mm = unit(f"({UNITS[kind]})/mm")
    return _positive(parse(written, per_mm, per_mm) / 1e3, text)


def segment_symbol(segment: str) -> str:
    """Return the scale factor that a chosen segment fixes: `pa` mu_V, `p'a'` mu_a, `OA` mu_l.

    Raises
    ------
    InputError
        When the letters name no segment.
    """
    kind = next((kind for kind, letters in SEGMENT_OF.items() if letters.fullmatch(segment)), None)
    if kind is None:
        raise InputError("scale-segment", text=quote(segment))
    return f"mu_{kind}"


def _positive(mu: float, text: str) -> float:
    if not 1e-30 < mu < 1e30:
        raise InputError("scale-not-positive", text=quote(text))
    return mu


# The units in which a task shows its results: lengths in cm, say, velocities in cm/s, scale factors per cm of paper.
# Inside the package everything is SI and millimetres; this stands at the edge, where numbers are printed.


@dataclass(frozen=True, slots=True)
class Display:
    """`length` stands for the metre in units of lengths, velocities, accelerations; `paper` measures segments.

    With `size` lengths alone have this unit, those of a cam millimetres, say, while its velocities stay in m/s; `angle`
    is the unit of angles, `stress` that of stresses.
    """

    length: str = METRE
    paper: str = "mm"
    size: str = ""
    angle: str = RADIAN
    stress: str = USUAL["Pa"]

    def unit(self, si: str) -> str:
        """Return the unit in which a value of an SI unit is shown.

        >>> Display("cm").unit("m/s^2"), Display("cm").unit("rad/s")
        ('cm/s^2', 'rad/s')
        """
        if si == RADIAN:
            return self.angle
        if si == "Pa":
            return self.stress
        if self.size and si == METRE:
            return self.size
        powers = unit(si).powers
        if self.length == METRE or all(name != METRE for name, _ in powers):
            return si
        return Unit(tuple((self.length if name == METRE else name, power) for name, power in powers)).name

    @property
    def of_scales(self) -> Display:
        """The units in which scale factors are shown, and what they draw."""
        return replace(self, size="", angle=RADIAN)

    def value(self, value: float, si: str) -> float:
        """Return a value of an SI unit as it is shown.

        >>> Display("cm").value(0.178, "m/s")
        17.8
        """
        shown = self.unit(si)
        return value if shown == si else unit(shown).from_si(value)

    def segment(self, millimetres: float) -> float:
        """Return millimetres of the sheet in the unit in which segments are shown."""
        return millimetres if self.paper == "mm" else unit(self.paper).from_si(millimetres * 1e-3)

    def scale(self, scale: Scale) -> Scale:
        """Return a scale factor as it is shown; one that is shown so already stays.

        >>> Display("cm", "cm").scale(Scale("mu_V", 0.00075, "m/s"))
        Scale(symbol='mu_V', mu=0.75, unit='cm/s', paper='cm')
        """
        if self != self.of_scales:
            return self.of_scales.scale(scale)
        if scale.paper == self.paper and self.unit(scale.unit) == scale.unit:
            return scale
        per_mm = self.value(scale.mu, scale.unit)
        mu = float(f"{per_mm / self.segment(1.0):.12g}")  # the factor is a round decimal: a shown one stays so
        return replace(scale, mu=mu, unit=self.unit(scale.unit), paper=self.paper)


AS_INSIDE = Display()  # metres, and millimetres of paper
