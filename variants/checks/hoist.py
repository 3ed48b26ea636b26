"""Checking a hoist: its words, and whether its numbers have the right names, kinds and bounds."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.hoist.hoist import MAY_BE_RIGID, NOT_NEGATIVE, PARTS, SIDES, USUAL, VALUES, Hoist
from ..task import Bound, Given
from .basics import Checker, Field, record
from .givens import word_or_choice
from .names import Names
from .numbers import Number, check_numbers

TABLE = "hoist"
KNOWN = {"near_0": SIDES, "near_2": SIDES}  # keys whose value may be the name of a choice


def _bound_of(name: str) -> Bound:
    """Return which values a number of a hoist may have."""
    if name in MAY_BE_RIGID:
        return Bound.RIGID
    if name in PARTS:
        return Bound.UP_TO_HALF
    return Bound.NOT_NEGATIVE if name in NOT_NEGATIVE else Bound.POSITIVE


NUMBERS = {name: Number(_bound_of(name), default=USUAL.get(name)) for name in VALUES}


def read_hoist(checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Hoist | None:
    """Read `[hoist]`, and hold the numbers of the task against those that a hoist has."""
    before = len(checker.faults)
    fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in KNOWN.items()}
    read = record(checker, (TABLE,), raw, fields)
    check_numbers(checker, names, NUMBERS, VALUES, "hoist-number-unknown")
    return None if len(checker.faults) > before else Hoist(**read)
