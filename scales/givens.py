"""What a subject is described by: a table of parameters, from which reader, template, roster, forms and ranges follow.

The table of a subject stands beside the subject, in its folder of `plans`, under the name `GIVENS`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, ClassVar, Self, cast


class Bound(Enum):
    """What values a given may take, in SI; the value of a member is the key of the message for the others."""

    admits: Callable[[float], bool]

    FREE = "", lambda value: True
    POSITIVE = "not-positive", lambda value: value > 0.0
    NOT_NEGATIVE = "negative", lambda value: value >= 0.0
    NOT_ZERO = "is-zero", lambda value: value != 0.0
    PART = "not-part", lambda value: 0.0 < value < 1.0
    ACUTE = "not-acute", lambda value: 0.0 < value < 0.5 * math.pi
    TURN = "not-turn", lambda value: 0.0 < value <= 2.0 * math.pi
    UP_TO_HALF = "not-half", lambda value: 0.0 < value <= 0.5
    RIGID = "not-positive-or-inf", lambda value: value > 0.0  # positive or infinite

    def __new__(cls, key: str, admits: Callable[[float], bool]) -> Bound:
        """Make a bound that is known by its key."""
        bound = object.__new__(cls)
        bound._value_, bound.admits = key, admits
        return bound


@dataclass(frozen=True, slots=True)
class Parameter:
    """What may be given of a subject: a number, or, where there are `choices`, a word out of these.

    Numbers are in SI. Without a value that is `needed` and has no default there is no such subject.
    """

    unit: str = ""  # SI, empty for a plain number
    bound: Bound = Bound.POSITIVE
    default: float | str | None = None
    needed: bool = True
    usual: tuple[float, float] | None = None  # the least and the greatest value that is not worth a warning
    choices: tuple[str, ...] = ()
    forms: tuple[str, ...] = ()  # of the subject that have it; all where none is said
    row: tuple[float, ...] = ()  # the values that a standard has, of which new variants choose
    whole: bool = False  # what is counted: new variants have whole numbers of it


Givens = Mapping[str, Parameter]


class Described:
    """A subject whose words stand in its fields, while its numbers come separately, by name, in SI.

    So one subject serves a variant, a sweep and a batch. A field may also hold the name of a given that is a choice.
    """

    __slots__ = ()
    givens: ClassVar[Givens]

    def chosen(self, words: Mapping[str, str]) -> Self:
        """Return the subject with the words of a variant in the place of the names of the choices."""
        fields = {key: getattr(self, key) for key, given in self.givens.items() if given.choices}
        chosen: Self = replace(cast(Any, self), **{key: words.get(word, word) for key, word in fields.items()})
        return chosen


def units(givens: Givens) -> dict[str, str]:
    """Return the SI units of the numbers by name."""
    return {name: given.unit for name, given in givens.items() if not given.choices}


def defaults(givens: Givens) -> dict[str, float]:
    """Return the numbers that hold where nothing else is given, SI."""
    return {name: float(given.default) for name, given in givens.items() if isinstance(given.default, float)}
