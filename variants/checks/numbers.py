"""Checking the numbers of a subject that has names for all of them: those are there that it needs, and no others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.units import customary, unit
from ..task import Bound
from .basics import Checker
from .names import Names


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a subject: which values it may have, whether it is needed, what it is where nobody says.

    The default is in SI. A number that is `unused` by this very subject is refused with that error.
    """

    bound: Bound = Bound.POSITIVE
    needed: bool = True
    default: float | None = None
    unused: InputError | None = None


def check_numbers(
    checker: Checker, names: Names, numbers: Mapping[str, Number], units: Mapping[str, str], stranger: str
) -> None:
    """Check that the numbers are there that are needed, and no others; bound them, and fill in the usual ones.

    Parameters
    ----------
    numbers : mapping
        What the subject has, by name.
    units : mapping
        Their SI units, empty for a plain number.
    stranger : str
        Key of the message about a name that is not among the numbers.
    """
    for name, dimension in names.dimensions.items():
        place, number = names.stated.get(name, ("givens",)), numbers.get(name)
        if number is None:
            checker.fault(place, unknown(stranger, name, numbers))
        elif number.unused is not None:
            checker.fault(place, number.unused)
        elif dimension not in (None, (wanted := unit(units[name] or "1")).dimension):
            checker.fault(place, InputError("value-wrong", text=name, expected=customary(wanted)))
        else:
            names.bounds[name] = number.bound
    for name, number in numbers.items():
        if not number.needed or number.default is not None:
            names.optional.add(name)
        if number.needed and number.default is not None:
            names.named[name] = number.default  # a variant may say another
        elif number.needed and name not in names.dimensions:
            checker.fault(("givens",), InputError("key-missing", name=name))
