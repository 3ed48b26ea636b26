"""The words of a sheet in one language and one notation: texts, numbers, units, symbols, letters of the plans."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from ..scales.errors import LANGUAGES, InputError
from ..scales.names import unknown
from ..scales.packaged import packaged
from ..scales.scale import Scale
from ..scales.units import format_unit

GREEK = {"omega": "ω", "epsilon": "ε", "mu": "μ", "phi": "φ", "delta": "Δ"}
PARTS = {"n": "n", "t": "t", "k": "k", "r": "r"}  # normal, tangential, Coriolis, sliding part of a vector
FORCE_LETTERS = "abcdefghijklm"


def notations() -> tuple[str, ...]:
    """Return the names of the notation profiles."""
    return tuple(sorted(p.name.removesuffix(".toml") for p in files(__package__).joinpath("notations").iterdir()))


@dataclass(frozen=True, slots=True)
class Words:
    """Texts, numbers and symbols for a sheet in `language` and `notation`."""

    language: str
    texts: dict[str, str]
    notation: dict[str, Any]
    starts: frozenset[str] = frozenset()  # `2_A`: where the second force of a couple on link 2 hangs, letter F″

    @classmethod
    def of(cls, language: str, notation: str) -> Words:
        """Load the words of a language and a notation profile.

        Raises
        ------
        InputError
            When there is no such language or notation.
        """
        if language not in LANGUAGES:
            raise InputError("language", language=language, known=", ".join(LANGUAGES))
        if notation not in notations():
            raise unknown("notation-unknown", notation, notations())
        return cls(language, packaged(__package__, "texts", language), packaged(__package__, "notations", notation))

    def __getitem__(self, key: str) -> str:
        """Return a text by its key."""
        return self.texts[key]

    def number(self, value: float, decimals: int) -> str:
        """Return a number with so many decimals, a true minus and the language's decimal sign."""
        text = f"{value:.{max(decimals, 0)}f}"
        if float(text) == 0.0:
            text = text.removeprefix("-")
        return self.decimal(text)

    def short(self, value: float, digits: int = 12) -> str:
        """Return a number as short as it is, such as a given."""
        return self.decimal(f"{value:.{digits}g}" if 1e-4 <= abs(value) < 1e15 or value == 0 else _plain(value, digits))

    def decimal(self, text: str) -> str:
        """Write the decimal sign and the minus of the language."""
        text = text.replace("-", "−")
        return text if self.language == "en" else text.replace(".", ",")

    def unit(self, unit: str) -> str:
        """Return a unit in the language, powers as true superscripts."""
        return format_unit(unit, self.language, raised=True)

    def scale(self, scale: Scale) -> str:
        """Return a scale factor as `μ_V = 0,05 (м/с)/мм`, or as `μ_V = 20 мм/(м/с)` where the notation says so."""
        symbol = self.symbol(scale.symbol)
        if self.notation.get("scales") == "mm per unit":
            unit = self.unit(scale.unit)
            per = f"({unit})" if "/" in unit else unit
            return f"{symbol} = {self.short(scale.per_unit, 6)} {self['unit.mm']}/{per}"
        return f"{symbol} = {self.short(scale.mu)} {self.unit(scale.per_mm_unit)}"

    def symbol(self, name: str, bar: bool = False) -> str:
        """Return the markup of a quantity's symbol, with a vector bar where wanted."""
        special = self.notation["symbols"][self.language].get(name)
        if special is not None:
            head, mark, rest = _split(special)
        else:
            head, mark, rest = self._composed(name)
        return f"\\bar{{{head}}}{mark}{rest}" if bar else f"{head}{mark}{rest}"

    def _composed(self, name: str) -> tuple[str, str, str]:
        letters = self.notation.get("letters", {})
        if name.startswith("mu_"):
            kind = name.split("_")[1]  # forces of a group or of the driver alike
            return "μ", "", f"_{{{letters.get(kind, kind)}}}"
        if name.startswith("h_lever_"):
            return self._lever_arm(name)
        if "_couple" in name:
            link = name.removeprefix("F_i").partition("_")[0]
            end = name.rpartition("couple")[2]
            return "F", "″" if f"{link}{end}" in self.starts else "′", f"_{{i{link}}}"
        head, _, rest = name.partition("_")
        head = letters.get(head, GREEK.get(head, head))
        stem, _, part = rest.rpartition("_")
        if part in PARTS and stem:
            return head, f"^{{{PARTS[part]}}}", f"_{{{stem}}}"
        return head, "", f"_{{{rest}}}" if rest else ""

    def _lever_arm(self, name: str) -> tuple[str, str, str]:
        thing = name.removeprefix("h_lever_")
        if thing.startswith("M_i"):
            ends = thing.removeprefix("M_i")
            return "h", "″" if ends in self.starts else "′", f"_{{{ends.partition('_')[0]}}}"
        return "h", "", f"_{{{thing.replace('_', '')}}}"

    def mark(self, mark: str) -> str:
        """Return the letter of a mark: `velocity.S2` is s_2, `forces_23.1` is a, `A` is A."""
        plan, _, point = mark.rpartition(".")
        if not plan:
            return _indexed(point)
        if plan.startswith("forces"):
            return self.notation["force_pole"] if point == "0" else FORCE_LETTERS[int(point) - 1]
        if point == "p":
            return str(self.notation[f"{plan}_pole"])
        prime = self.notation["acceleration_prime"] if plan == "acceleration" else ""
        if point.startswith("n_"):
            return str(self.notation["normal_end"])
        return _indexed(point[0].lower() + prime + point[1:])


def _indexed(letter: str) -> str:
    """Set the digits of a letter as its subscript."""
    digits = letter.lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz′")
    return f"{letter.removesuffix(digits)}_{{{digits}}}" if digits else letter


def _split(special: str) -> tuple[str, str, str]:
    cut = min((i for i in (special.find("^"), special.find("_")) if i >= 0), default=len(special))
    return special[:cut], "", special[cut:]


def _plain(value: float, digits: int) -> str:
    """Return a small number without an exponent."""
    decimals = min(max(digits - 1 - math.floor(math.log10(abs(value))), 0), 40)
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if decimals else text
