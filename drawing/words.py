"""The words of a sheet in one language and one notation: texts, numbers, units, symbols, letters of the plans."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from string import ascii_lowercase
from typing import Any

from ..plans.names import CORIOLIS, COUPLE, FORCES, LEVER, NORMAL, PARTS, POLE, POSITION, Name, couple, role, spelled
from ..scales.errors import LANGUAGES, InputError
from ..scales.names import unknown
from ..scales.numbers import rounded
from ..scales.packaged import home, packaged
from ..scales.scale import AS_INSIDE, Display, Scale
from ..scales.units import format_unit

GREEK = {
    **{"alpha": "α", "beta": "β", "gamma": "γ", "delta": "Δ", "epsilon": "ε", "eta": "η", "theta": "θ", "kappa": "κ"},
    **{"lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "psi": "ψ"},
    "omega": "ω",
}
OF_LINKS = ("R", "M", "h")  # quantities whose two digits are the links of a pair
PARTING = re.compile(r"(?<=\d)_(?=\d)")  # between numbers of links of two digits: a comma where they are printed
OF_LINK = ("omega", "epsilon", "P")  # quantities of one link: rates, instant centre
PER_UNIT_DIGITS = 6


@cache
def notations() -> tuple[str, ...]:
    """Return the names of the notation profiles."""
    return tuple(sorted(path.stem for path in (home(__package__) / "notations").iterdir()))


def _texts(language: str) -> dict[str, str]:
    if language not in LANGUAGES:
        raise InputError("language", language=language, known=", ".join(LANGUAGES))
    return packaged(__package__, "texts", language)


@dataclass(frozen=True, slots=True)
class Words:
    """Texts, numbers and symbols for a sheet in `language` and `notation`.

    What depends on the mechanism is set when it is known: `seconds` are the forces and arms with two primes, the second
    of each couple; `letters` are marks whose letters need an index, such as one of several ends of normal parts;
    `frame` is the number of the frame, `ends` are the ends of links by number; numbers of links are
    `parted` where a link has two digits. `display` are the units in which the
    task shows its results, `ruler` says whether segments have been read with one.
    """

    language: str
    texts: dict[str, str]
    notation: dict[str, Any]
    seconds: frozenset[str] = frozenset()
    letters: Mapping[str, str] = field(default_factory=dict)
    frame: str = "0"
    ends: Mapping[str, str] = field(default_factory=dict)
    parted: bool = False
    display: Display = AS_INSIDE
    ruler: bool = False
    _symbols: dict[str, tuple[str, str]] = field(default_factory=dict, init=False, repr=False, compare=False)

    @classmethod
    def of(cls, language: str, notation: str) -> Words:
        """Load the words of a language and a notation profile.

        Raises InputError: there is no such language or notation.
        """
        texts = _texts(language)
        if notation not in notations():
            raise unknown("notation-unknown", notation, notations())
        return cls(language, texts, packaged(__package__, "notations", notation))

    def speaking(self, language: str) -> Words:
        """Return the words in another language, of the same notation. Raises InputError: there is no such language."""
        return replace(self, language=language, texts=_texts(language))

    def showing(self, display: Display) -> Words:
        """Return the words for results in the units of `display`."""
        return replace(self, display=display)

    def letters_of(self, subject: str) -> dict[str, str]:
        """Return the letters of the quantities of a subject, `cams`, by name."""
        return dict(packaged(__package__, "texts", f"{subject}.{self.language}"))

    def lettered(self, letters: Mapping[str, str]) -> Words:
        """Return the words with more letters; scale factors are values of a millimetre, as such sheets calculate."""
        symbols = self.notation["symbols"]
        merged = {**symbols, self.language: {**symbols[self.language], **letters}}
        return replace(self, notation={**self.notation, "symbols": merged, "scales": "per mm"})

    def __getitem__(self, key: str) -> str:
        """Return a text by its key."""
        return self.texts[key]

    def listed(self, items: Sequence[str]) -> str:
        """Return items as a sentence has them: `2, 3 and 4`."""
        return self["called.last"].join(part for part in (", ".join(items[:-1]), *items[-1:]) if part)

    def number(self, value: float, decimals: int) -> str:
        """Return a number with so many decimals, a true minus and the language's decimal sign."""
        decimals = max(decimals, 0)
        text = f"{rounded(value, decimals):.{decimals}f}"
        if float(text) == 0.0:
            text = text.removeprefix("-")
        return self.decimal(text)

    def short(self, value: float, digits: int = 12) -> str:
        """Return a number as short as it is, such as a given."""
        text = f"{value:.{digits}g}"
        if "e" not in text:
            return self.decimal(text)
        decimals = min(max(digits - 1 - math.floor(math.log10(abs(value))), 0), 40)  # without an exponent
        text = f"{value:.{decimals}f}"
        return self.decimal(text.rstrip("0").rstrip(".") if decimals else text)

    def decimal(self, text: str) -> str:
        """Write the decimal sign and the minus of the language."""
        text = text.replace("-", "−")
        return text if self.language == "en" else text.replace(".", ",")

    def spelled(self, unit: str) -> str:
        """Return a unit in the language, as plain text; nothing where there is none."""
        return format_unit(unit, self.language)

    def amount(self, value: float, si: str, digits: int = 12) -> str:
        """Return a value of an SI unit as it is shown, with its unit, as plain text."""
        return f"{self.short(self.display.value(value, si), digits)} {self.spelled(self.display.unit(si))}".rstrip()

    def unit(self, unit: str) -> str:
        """Return a unit in the language, powers as true superscripts."""
        return format_unit(unit, self.language, raised=True)

    @property
    def per_unit(self) -> bool:
        """Whether scale factors are millimetres per unit, not the value of a millimetre."""
        return bool(self.notation["scales"] == "mm per unit")

    def factor(self, scale: Scale) -> float:
        """Return the number of a scale factor as it is printed."""
        shown = self.display.scale(scale)
        return float(f"{shown.per_unit:.{PER_UNIT_DIGITS}g}") if self.per_unit else shown.mu

    def scale(self, scale: Scale) -> str:
        """Return a scale factor as `μ_V = 0,05 (м/с)/мм`, or as `μ_V = 20 мм/(м/с)` where the notation says so."""
        shown = self.display.scale(scale)
        unit, paper = self.unit(shown.unit), self.unit(shown.paper)
        per = f"({unit})" if "/" in unit or "·" in unit else unit
        written = f"{paper}/{per}" if self.per_unit else f"{per}/{paper}"
        return f"{self.symbol(scale.symbol)} = {self.short(self.factor(scale))} {written}"

    def drawn_at(self, mu_l: float) -> str:
        """Return the scale of lengths as drawings have it, M 1:1, M 2:1, M 1:2; `mu_l` in m/mm."""
        size = 1e-3 / mu_l  # mm on paper of a millimetre of what is drawn
        ratio = f"{self.short(round(size, 6))}:1" if size >= 1.0 else f"1:{self.short(round(1.0 / size, 6))}"
        return self["said.drawn"].format(ratio=ratio)

    def symbol(self, name: str, bar: bool = False) -> str:
        """Return the markup of a quantity's symbol, with a vector bar where wanted."""
        if name not in self._symbols:
            self._symbols[name] = self._parts(role(name))
        head, rest = self._symbols[name]
        return f"\\bar{{{head}}}{rest}" if bar else f"{head}{rest}"

    def _parts(self, name: Name) -> tuple[str, str]:
        """Return the letter of a quantity and its scripts."""
        halved = name.part == COUPLE
        table: Mapping[str, str] = self.notation["symbols"][self.language]
        whole = name.whole if halved else name
        special = table.get(whole) or table.get(re.sub(r"\d+", "#", whole))  # `#` stands for a number
        if special is not None:
            special = special.replace("#", "".join(re.findall(r"\d+", whole)[:1]))
        elif name.kind == "h" and name.part == LEVER and role(name.of).kind == "M":  # an arm
            return "h" + ("″" if name in self.seconds else "′"), self._parts(couple(name.of))[1]
        elif name.kind == "h" and re.match(r"\d", name.of):  # of a reaction
            above = f"^{{{self._part(name.part)}}}" if name.part else ""
            return "h", f"{above}_{{{self._links('h', _joined(name.of))}{name.about}}}"
        elif name.kind == "h":
            return "h", f"_{{{re.sub(r'[_^{}]', '', self.symbol(name.of))}{name.about}}}"
        markup = special or self._composed(spelled(name.kind, name.of) if halved else name)
        at = next((n for n, letter in enumerate(markup) if letter in "_^"), len(markup))
        return markup[:at] + ("″" if name in self.seconds else "′") * halved, markup[at:]

    def _composed(self, name: Name) -> str:
        """Return a symbol made from the name's own letters: `a_BA_n` is a with n above and BA below."""
        letters, of = self.notation["letters"], name.of
        if name.kind == "mu":  # forces of a group or of the driver alike
            index = letters.get(f"mu_{of}", letters.get(of, GREEK.get(of, of)))
            # on a diagram of angles over an angle two scale factors differ by the link; a link apart may have its own
            return f"{letters['mu']}_{{{index}{name.about if of in ('phi', 'l') else ''}}}"
        if name.kind == "H":  # a pole distance, by what its diagram shows
            return f"H_{{{letters.get(of, GREEK.get(of, of))}}}"
        above = name.part if name.kind in OF_LINK else self._part(name.part) if name.kind in PARTS else ""
        kind, index = (name.kind, name.letters) if name.kind else (name, "")
        below = self._links(kind, _joined(index))
        head = letters.get(kind, GREEK.get(kind, kind))
        if not head:
            return below
        scripts = (f"^{{{above}}}" if above else "") + (f"_{{{below}}}" if below else "")
        return f"{head}{scripts}"

    def _part(self, part: str) -> str:
        """Return the superscript of a part of a vector."""
        above = self.notation["parts"].get(part, part)
        return str(above if isinstance(above, str) else above[self.language])

    def _links(self, head: str, index: str) -> str:
        """Return an index; links by their ends where the notation says so, the frame by its number.

        The two links of a pair stand in the notation's order.
        """
        if self.notation["links"] == "ends" and head in OF_LINK:
            return self.ends.get(index, index)
        if self.notation["links"] == "ends" and head not in OF_LINKS:  # digits of letters lowered: `O_{1}B`
            letters, centre, number = index.partition("P") if head == "l" else (index, "", "")
            lowered = re.sub(r"(?<=[A-Za-z])(\d+)", r"_{\1}", letters)
            link = f"P_{{{self.ends.get(number, number)}}}" if number.isdigit() else centre + number
            return lowered + link
        if head not in OF_LINKS or not re.fullmatch(r"\d+,\d+" if self.parted else r"\d\d", index):
            return index
        parting = "," if self.parted else ""
        pair = [
            self.frame if number == "0" else number for number in re.findall(r"\d+" if self.parted else r"\d", index)
        ]
        return parting.join(pair if self.notation["reaction"] == "ij" else reversed(pair))

    def choice(self, name: str, value: str) -> tuple[str, str]:
        """Return what a given that is a choice is about, and the word chosen."""
        return self.texts.get(f"given.{name}", name), self.texts.get(f"choice.{value}", value)

    def mark(self, mark: str) -> str:
        """Return the letter of a mark: `velocity.S2` is s_2, `forces_23.1` is a, `A` is A."""
        if mark in self.letters:
            return self.letters[mark]
        name, of = role(mark), role(mark).of
        if name.plan == POSITION:
            return indexed(mark)
        if name.plan.kind == FORCES:
            pole = str(self.notation["force_pole"])
            if int(of) == 0:
                return pole
            letters = ascii_lowercase.replace(pole, "")  # a, b, c, ... without the pole's, then a_1, b_1, c_1, ...
            turn, at = divmod(int(of) - 1, len(letters))
            return letters[at] + (f"_{{{turn}}}" if turn else "")
        if name.kind == POLE:
            return str(self.notation[f"{name.plan}_pole"])
        if name.kind in (NORMAL, CORIOLIS):
            return str(self.notation["normal_end" if name.kind == NORMAL else "coriolis_end"])
        prime = self.notation["acceleration_prime"] if name.plan == "acceleration" else ""
        return indexed(of[0].lower() + prime + of[1:])


@dataclass(frozen=True, slots=True)
class Given:
    """A given as the task states it: a number in its own unit, or a chosen word (without unit)."""

    value: float | str
    unit: str = ""


def indexed(letter: str) -> str:
    """Set what stands behind a letter as its subscript: A_{1}."""
    return re.sub(r"^([A-Za-z′]*)([^A-Za-z′].*)", r"\1_{\2}", letter)


def _joined(index: str) -> str:
    """Return an index as it is printed, with a comma between numbers of links of two digits."""
    return PARTING.sub(",", index).replace("_", "")
