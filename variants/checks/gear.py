"""Checking a gear pair: its words, and whether its numbers have the right names, kinds and bounds."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.gears.gear import MATERIALS, ROTATIONS, SHIFTS, STANDARD, VALUES, GearPair
from ...scales.errors import InputError
from ..task import Bound, Given
from .basics import Checker, Field, record
from .givens import word_or_choice
from .names import Names
from .numbers import Number, check_numbers

TABLE = "gear"
KNOWN = {"rotation": ROTATIONS, "material": MATERIALS}  # keys whose value may be the name of a choice
NUMBERS = {
    "m": Number(),
    "z_1": Number(),
    "z_2": Number(),
    **dict.fromkeys(SHIFTS, Number(Bound.FREE, needed=False)),
    "a_w": Number(needed=False),
    **{name: Number(default=usual) for name, usual in STANDARD.items()},
    "c": Number(Bound.NOT_NEGATIVE, default=STANDARD["c"]),
}


def read_gear(checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> GearPair | None:
    """Read `[gear]`, and hold the numbers of the task against those that a pair has."""
    before = len(checker.faults)
    fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in KNOWN.items()}
    read = record(checker, (TABLE,), raw, fields)
    check_numbers(checker, names, NUMBERS, VALUES, "gear-number-unknown")
    if not {*SHIFTS}.intersection(names.dimensions):
        checker.fault(("givens",), InputError("gear-shifts", given="-"))
    return None if len(checker.faults) > before else GearPair(**read)
