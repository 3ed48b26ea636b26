"""How a scale factor is chosen: a given mu, a chosen segment such as pa = 80 mm, a round mu, or the crank scale.

Each chooser gives a ladder of scale factors, the wanted one first, then coarser and coarser: the sheet takes the first
that fits. What a user has fixed has one rung.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .errors import InputError
from .numbers import quote, split_number
from .scale import SEGMENTS, rounded, steps
from .units import parse, unit

RUNGS = 16
CRANK = {"V": 1, "a": 2}
UNITS = {"l": "m", "s": "m", "V": "m/s", "a": "m/s^2", "F": "N"}
# a segment by its letters on the plan, and the quantity that it shows: pa is V_A, p'a' is a_A, OA is l_OA
SEGMENT_OF = {
    "a": re.compile(r"[pπ]['′]?([a-z])(\d*)['′](\d*)"),
    "V": re.compile(r"p([a-z])(\d*)"),
    "l": re.compile(r"([A-Z]\d*[A-Z]\d*)"),
}


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
    """The segment of quantity `quantity` is `millimetres` long: mu = value / segment, rounded to three digits."""

    quantity: str
    millimetres: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return mu for the segment wanted, then for shorter ones of the preferred numbers."""
        size = value(self.quantity)
        if self.firm:
            return (rounded(size / self.millimetres),)
        shorter = [10.0**e * m for e in (2, 1, 0) for m in reversed(SEGMENTS)]
        lengths = [self.millimetres, *(mm for mm in shorter if mm < self.millimetres * 0.999)]
        return tuple(rounded(size / mm) for mm in lengths)[:RUNGS]


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
        `15 N/mm`, `20 mm/(m/s)` or `0.05` (a given mu), `pa=80 mm` (a chosen segment), `round` or `round 120 mm`
        (the customary series, the longest segment at most so long), `crank` (the crank scale), `from 15 N/mm` (this mu,
        or a coarser one of the series where there is little room).
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
        return Segment(_shown_by(symbol, name.strip()), millimetres, firm)
    word, _, rest = text.strip().partition(" ")
    if word == "round":
        return Round(symbol, _positive(parse(rest, unit("mm"), unit("mm")) * 1e3, text) if rest else 100.0, firm)
    if text.strip() == "crank" and kind in CRANK:
        return CrankScale(CRANK[kind], firm)
    if word == "from":
        return From(_given(kind, rest, text), firm)
    return Fixed(_given(kind, text, text), firm)


def _given(kind: str, written: str, text: str) -> float:
    """Read a scale factor in either convention; `text` is the whole of what was said."""
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


def _shown_by(symbol: str, segment: str) -> str:
    """Return the quantity that a segment of a plan shows."""
    kind = symbol.split("_")[1]
    letters = SEGMENT_OF[kind].fullmatch(segment) if kind in SEGMENT_OF else None
    if letters is None:
        raise InputError("scale-segment", text=quote(segment))
    return f"{kind}_{''.join(letters.groups()).upper()}"


def _positive(mu: float, text: str) -> float:
    if not 1e-30 < mu < 1e30:
        raise InputError("scale-not-positive", text=quote(text))
    return mu
