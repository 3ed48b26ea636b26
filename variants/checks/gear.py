"""Checking a gear pair: its words, and whether its numbers have the right names, kinds and bounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...plans.gears.gear import MATERIALS, ROTATIONS, SHIFTS, STANDARD, VALUES, GearPair
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.units import Unit, customary, unit
from ..task import Bound, Given
from .basics import Checker, Field, record
from .givens import word_or_choice
from .names import Names

TABLE = "gear"
KNOWN = {"rotation": ROTATIONS, "material": MATERIALS}  # keys whose value may be the name of a choice


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a pair: which values it may have, and whether it must be given."""

    bound: Bound = Bound.POSITIVE
    needed: bool = True


NUMBERS = {
    "m": Number(),
    "z_1": Number(),
    "z_2": Number(),
    **dict.fromkeys(SHIFTS, Number(Bound.FREE, needed=False)),
    "a_w": Number(needed=False),
    **dict.fromkeys(STANDARD, Number()),
    "c": Number(Bound.NOT_NEGATIVE),
}


def _unit(name: str) -> Unit:
    """Return the unit of a number of a pair."""
    return unit(VALUES[name] or "1")


def words_of(raw: object) -> frozenset[str]:
    """Return the words of `[gear]` that may be names of choices."""
    if not isinstance(raw, dict):
        return frozenset()
    return frozenset(name for key in KNOWN if isinstance(name := raw.get(key), str))


def read_gear(checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> GearPair | None:
    """Read `[gear]`, and hold the numbers of the task against those that a pair has."""
    before = len(checker.faults)
    fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in KNOWN.items()}
    read = record(checker, (TABLE,), raw, fields)
    _numbers(checker, names)
    return None if len(checker.faults) > before else GearPair(**read)


def _numbers(checker: Checker, names: Names) -> None:
    """Check that the numbers are there that a pair needs, and no others; fill in those of the standard rack."""
    for name, dimension in names.dimensions.items():
        place = names.stated.get(name, ("givens",))
        if name not in NUMBERS:
            checker.fault(place, unknown("gear-number-unknown", name, NUMBERS))
        elif dimension not in (None, _unit(name).dimension):
            checker.fault(place, InputError("value-wrong", text=name, expected=customary(_unit(name))))
        else:
            names.bounds[name] = NUMBERS[name].bound
    for name, number in NUMBERS.items():
        if not number.needed or name in STANDARD:
            names.optional.add(name)
        if name in STANDARD:
            names.named[name] = STANDARD[name]  # a variant may say another
        elif number.needed and name not in names.dimensions:
            checker.fault(("givens",), InputError("key-missing", name=name))
    if not {*SHIFTS}.intersection(names.dimensions):
        checker.fault(("givens",), InputError("gear-shifts", given="-"))
