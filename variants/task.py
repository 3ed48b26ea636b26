"""A task: its subject, such as a mechanism, its givens and choices, its variants, as read from one TOML file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sized
from copy import copy
from dataclasses import dataclass, field
from numbers import Complex, Number, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsFloat, TypeAlias, TypeGuard, cast

from ..plans.linkages.mechanism import ZERO, Mechanism
from ..plans.quantities import Quantity
from ..scales.errors import InputError, KulmanError, as_one, spoken
from ..scales.givens import Bound, Described
from ..scales.names import latin, unknown, unknown_given
from ..scales.numbers import quote
from ..scales.scale import AS_INSIDE, Display
from ..scales.units import Unit, UnitName, bounded, parse
from .shelf import bundled_text

if TYPE_CHECKING:
    from ..plans.cams.cam import Cam
    from ..plans.gears.gear import GearPair
    from ..plans.hoist.hoist import Hoist

UTF_16 = (b"\xff\xfe", b"\xfe\xff")
# letters and a number, V04 or V-04; 4.0 is how a spreadsheet may write 4
NUMBERED = re.compile(r"([^\W\d]*)(?:(?<=[^\W\d])[-–. ])?(\d{1,99})(?:[.,]0)?")
_OF_VARIANT = ("", "v", "в")  # letters before its number that only say what it is
ENDLESS = ("inf", "+inf", "∞")  # what is infinite, as it is written, with a unit or without

AnyTask: TypeAlias = "str | os.PathLike[str] | Task"  # an id or a file, or one that is read already
Settings = Mapping[str, str | float | tuple[float, str] | Quantity]  # values by name: text, number, or number and unit
Instead = tuple[tuple[frozenset[str], tuple[str, ...]], ...]  # givens, and those in whose place they stand
WITH_FORCES = frozenset(("forces", "lever"))  # plans whose units hang together in SI alone


class LocatedError(InputError):
    """An error with its place before it: `file:line:column`, or the option that it came from."""

    def __init__(self, place: str, cause: KulmanError) -> None:
        """Put `place` before the message of `cause`."""
        super().__init__(cause.key, **cause.data)
        self.place = place
        self.cause = cause

    def text(self, language: str = "en") -> str:
        """Return the place and the message as one line in `language`."""
        return f"{spoken(self.place, language)}: {self.cause.text(language)}"

    def __str__(self) -> str:
        """Return the message as any error does, the place, too, by the argument that the option is in Python."""
        named = copy(self)
        named.place = getattr(self.place, "argument", self.place)
        return super(LocatedError, named).__str__()


@dataclass(frozen=True, slots=True, repr=False)
class Given:
    """One given: a quantity with its unit, or a choice between words."""

    name: str
    unit: Unit | None = None
    choices: tuple[str, ...] = ()
    default: float | str | None = None
    bound: Bound = Bound.FREE

    def __repr__(self) -> str:
        """Return its name, and its unit or the words to choose between."""
        return f"<Given {self.name}: {' | '.join(self.choices) if self.unit is None else self.unit.name}>"

    def read(self, value: object) -> float | str:
        """Return what was written for this given: a chosen word, or a number in SI.

        A quantity may be a text (`"55,5 мм"`), a number and its unit (`(55.5, "mm")`), one in the given's own unit, or
        what `solve` has found.
        """
        if self.unit is None:
            if value not in self.choices or not isinstance(value, str):
                raise InputError("choice-unknown", text=quote(value), known=", ".join(self.choices))
            return value
        value = as_text(value)
        written = value.strip().lower().partition(" ")[0] if isinstance(value, str) else value
        if self.bound is Bound.RIGID and written in (*ENDLESS, math.inf):
            return math.inf
        if isinstance(value, str):
            number = parse(value, self.unit, self.unit)
        elif _is_number(value):
            number = plain_number(value, self.unit)
        else:
            raise InputError("type-quantity", expected=UnitName(self.unit.name))
        if not self.bound.admits(number):
            raise InputError(self.bound.value, text=quote(value))
        return number


def as_text(value: object) -> object:
    """Return a number and its unit, or a quantity that `solve` has found, as the text that says it."""
    if getattr(value, "ndim", 1) == 0:  # a number, as numpy has it
        value = cast(Any, value).item()
    if isinstance(value, Quantity) and value.kind != "point":
        value = float(value), value.unit
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str):
        number = as_text(value[0])
        return f"{float(number)!r} {value[1]}" if _is_number(number) else value
    return value


def _is_number(value: object) -> TypeGuard[SupportsFloat]:
    """Whether it is one number without imaginary part, a `Decimal` too, which is none of `numbers.Real`."""
    real = isinstance(value, Real) or not isinstance(value, Complex)
    return isinstance(value, Number) and real and not isinstance(value, bool)


def decoded(data: bytes) -> str:
    """Return the text of a file in UTF-8, or in UTF-16 with a mark at its beginning, as some editors save it.

    Raises UnicodeDecodeError: it is in neither.
    """
    return data.decode("utf-16" if data.startswith(UTF_16) else "utf-8-sig")


def plain_number(value: SupportsFloat, of: Unit) -> float:
    """Return a number of a unit in SI, within the bounds of all numbers."""
    try:
        return bounded(of.to_si(float(value)), of, value)
    except OverflowError:  # a whole number that no float holds
        raise InputError("number-infinite", text=quote(value)) from None


@dataclass(frozen=True, slots=True)
class Variant:
    """One row of the task's table: the givens that it states, in SI, and those that the source does not print."""

    id: str
    values: Mapping[str, float | str]
    reconstructed: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, repr=False)
class Task:
    """A task of a textbook as data.

    `subject` is what it is about: a linkage, a cam, a gear pair, a hoist; `kind` is the table that describes it, and
    names its kind.
    `choices` says which values each word of a choice sets, `constants` holds the literals of the subject;
    `file` is what was read, as the user named it, `None` for a bundled task; `display` are the units of results.
    `note` is what a user should know of the data, by language;
    `number` is its own in designations of sheets, 0 where the file says none;
    `instead` says of which givens, once a user has set them, others of the variant no longer hold;
    `written` is the text of one that comes from no file.
    """

    id: str
    title: Mapping[str, str]
    source: Mapping[str, str]
    notation: str
    plans: tuple[str, ...]
    givens: Mapping[str, Given]
    choices: Mapping[str, Mapping[str, Mapping[str, float]]]
    constants: Mapping[str, float]
    subject: Mechanism | Cam | GearPair | Hoist
    scales: Mapping[str, str]
    variants: Mapping[str, Variant]
    file: str | None = None
    display: Display = AS_INSIDE
    kind: str = "mechanism"
    instead: Instead = ()
    note: Mapping[str, str] = field(default_factory=dict)
    number: int = 0
    written: str = ""

    def __repr__(self) -> str:
        """Return the id and how many variants there are."""
        return f"<Task {self.id}: {len(self.variants)} variants>"

    def note_in(self, language: str) -> str:
        """Return what a user should know of the data, in a language; nothing where the task says nothing."""
        return self.note.get(language, "")

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism that the task of a linkage is about; a task of another kind has none."""
        if not isinstance(self.subject, Mechanism):
            raise InputError("kind-without", task=quote(self.id), text="mechanism")
        return self.subject

    @property
    def text(self) -> str:
        """The text of the file that says all this, as it is now."""
        if self.written:
            return self.written
        return decoded(Path(self.file).read_bytes()) if self.file else bundled_text(self.id)

    def variant(self, variant_id: str | int | None = None) -> Variant:
        """Return a variant, the first one without an id; its number will do: `4`, `04`, `№ 4`, `V04` are alike."""
        if variant_id is None:
            return next(iter(self.variants.values()))
        said = str(variant_id).strip()
        found = [said] if said in self.variants else self._meant(said)
        if len(found) != 1:
            raise unknown("variant-unknown", variant_id, self.variants, task=self.id)
        return self.variants[found[0]]

    def _meant(self, said: str) -> list[str]:
        """Return the ids of the variants with the number of another id, and its letters where they say more."""
        from .spreadsheets.grid import number_said  # most are asked for by their own id

        if (one := NUMBERED.fullmatch(number_said(said))) is None:
            return []
        letters = latin(one[1]).lower(), one[1].lower()
        found = []
        for name in self.variants:
            if (own := NUMBERED.fullmatch(name)) and int(own[2]) == int(one[2]):
                has = latin(own[1]).lower(), own[1].lower()
                if not one[1] or has[0] == letters[0] or {has[1], letters[1]} <= {*_OF_VARIANT}:
                    found.append(name)
        return found

    @property
    def numbered(self) -> dict[int, str]:
        """The ids of the variants by the one number in each, `7`, `V07`; those without one are left out."""
        names = dict[int, str]()
        for name in self.variants:
            if own := NUMBERED.fullmatch(name):
                names.setdefault(int(own[2]), name)
        return names

    def resolve(self, variant_id: str | None = None, settings: Settings | None = None) -> dict[str, float | str]:
        """Return every given of a variant, the first without an id: numbers in SI, choices as words.

        `settings` replace givens of the variant: quantities as `Given.read` takes them.
        """
        row = self.variant(variant_id).values
        resolved = {name: row.get(name, given.default) for name, given in self.givens.items()}
        for stated, others in self.instead:
            if stated <= {*(settings or {})}:
                resolved |= dict.fromkeys((name for name in others if name in resolved), None)
        faults = list[InputError]()
        for name, value in (settings or {}).items():
            try:
                resolved[name] = self._read(name, value)
            except InputError as error:
                faults.append(error)
        if faults:
            raise as_one(faults)
        return {name: value for name, value in resolved.items() if value is not None}

    def _read(self, name: str, value: object) -> float | str:
        """Read what a given is set to."""
        if name not in self.givens:
            if isinstance(self.subject, Described) and name in self.subject.givens:
                raise InputError("given-absent", text=name, task=quote(self.id), known=", ".join(self.givens))
            raise unknown_given(name, self.givens, self.id)
        try:
            return self.givens[name].read(value)
        except InputError as error:
            numbers = value[0] if isinstance(value, tuple) and value else value
            several = error.key == "type-quantity" and isinstance(numbers, Sized)
            several = several and not isinstance(numbers, (str, Mapping)) and getattr(numbers, "ndim", None) != 0
            raise LocatedError(name, InputError("type-quantities") if several else error) from error

    def values(self, variant_id: str | None = None, settings: Settings | None = None) -> dict[str, float]:
        """Return every number that the subject names, in SI: givens, what the choices set, and constants."""
        values = {ZERO: 0.0, **self.constants}
        for name, value in self.resolve(variant_id, settings).items():
            if isinstance(value, str):
                values.update(self.choices[name][value])
            else:
                values[name] = value
        return values

    def words(self, variant_id: str | None = None, settings: Settings | None = None) -> dict[str, str]:
        """Return the words of all choices of a variant."""
        resolved = self.resolve(variant_id, settings).items()
        return {name: value for name, value in resolved if isinstance(value, str)}
