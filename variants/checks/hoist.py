"""Checking a hoist: its words, and whether its numbers have the right names, kinds and bounds."""

from __future__ import annotations

from collections.abc import Mapping

from ...plans.hoist.hoist import MAY_BE_RIGID, NOT_NEGATIVE, PARTS, SIDES, USUAL, VALUES, Hoist
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.units import Unit, customary, unit
from ..task import Bound, Given
from .basics import Checker, Field, record
from .givens import word_or_choice
from .names import Names

TABLE = "hoist"
KNOWN = {"near_0": SIDES, "near_2": SIDES}  # keys whose value may be the name of a choice


def words_of(raw: object) -> frozenset[str]:
    """Return the words of `[hoist]` that may be names of choices."""
    if not isinstance(raw, dict):
        return frozenset()
    return frozenset(name for key in KNOWN if isinstance(name := raw.get(key), str))


def read_hoist(checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Hoist | None:
    """Read `[hoist]`, and hold the numbers of the task against those that a hoist has."""
    before = len(checker.faults)
    fields = {key: Field(word_or_choice(known, givens), required=False) for key, known in KNOWN.items()}
    read = record(checker, (TABLE,), raw, fields)
    _numbers(checker, names)
    return None if len(checker.faults) > before else Hoist(**read)


def bound_of(name: str) -> Bound:
    """Return which values a number of a hoist may have."""
    if name in MAY_BE_RIGID:
        return Bound.RIGID
    if name in PARTS:
        return Bound.UP_TO_HALF
    return Bound.NOT_NEGATIVE if name in NOT_NEGATIVE else Bound.POSITIVE


def _unit(name: str) -> Unit:
    """Return the unit of a number of a hoist."""
    return unit(VALUES[name] or "1")


def _numbers(checker: Checker, names: Names) -> None:
    """Check that the numbers are there that a hoist needs, and no others; fill in those that are usual."""
    for name, dimension in names.dimensions.items():
        place = names.stated.get(name, ("givens",))
        if name not in VALUES:
            checker.fault(place, unknown("hoist-number-unknown", name, VALUES))
        elif dimension not in (None, _unit(name).dimension):
            checker.fault(place, InputError("value-wrong", text=name, expected=customary(_unit(name))))
        else:
            names.bounds[name] = bound_of(name)
    for name in VALUES:
        if name in USUAL:
            names.optional.add(name)
            names.named[name] = USUAL[name]  # a variant may say another
        elif name not in names.dimensions:
            checker.fault(("givens",), InputError("key-missing", name=name))
