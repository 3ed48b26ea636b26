"""One line of a student's form, what it says (a magnitude, a sign or a direction, as far as it does), its verdict."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import Any, NamedTuple

from ..laws import cross, dot

QUARTER = math.pi / 4.0  # on either side of a word of direction
FREE = re.compile(r"R_\w+$|M_(\d\d|\d+_\d+)$|[MF]_bal(_lever)?$")  # whose sense is assumed, and found by the sign


@dataclass(frozen=True, slots=True)
class Answer:
    """What a student says of one quantity, in SI; any part may be left out."""

    name: str
    mm: float | None = None  # the segment on paper
    mu: float | None = None  # the scale factor as the student writes it: value per mm, or mm per unit
    value: float | None = None  # of a vector its magnitude
    direction: float | None = None  # radians from the x axis, of a vector
    side: bool = False  # whether a word says it, such as left: that means all that is nearer to it than to others
    sense: int | None = None  # of a scalar, said beside it: +1 counter-clockwise (or along the axis), -1 the other way
    plus: bool = False  # whether the value has one: without it a positive value says nothing of the sense
    rounded: float | None = None  # half of the last digit of the value as it was written

    @property
    def empty(self) -> bool:
        """Whether it says nothing that can be marked: a direction or a sense without a size can be guessed."""
        return not any(map(known, (self.mm, self.value)))

    def values(self, mu: float | None = None) -> tuple[float, ...]:
        """Return the values that it may mean, signed: the one written, else mm times or through mu.

        `mu` is that of other lines of the plan, for a line that has none.
        """
        return (self.value,) if self.value is not None and known(self.value) else self.measured(mu)

    def measured(self, mu: float | None) -> tuple[float, ...]:
        """Return the values that the millimetres mean, in either convention of the scale factor."""
        factor = self.mu if known(self.mu) else mu
        if self.mm is None or not known(self.mm) or not factor or not known(factor):
            return ()
        return tuple(dict.fromkeys(x for x in (self.mm * factor, self.mm / factor) if math.isfinite(x)))


@dataclass(frozen=True, slots=True)
class Said:
    """One way to take an answer: `size` without its sign; None for what it does not say."""

    size: float | None
    sign: int | None
    direction: complex | None
    side: bool = False  # of a word: all within `QUARTER` of the direction

    def off(self, vector: complex) -> float:
        """Return by what angle, radians, a vector is off the direction, or off all that a word means."""
        if self.direction is None:
            return 0.0
        turned = abs(math.atan2(cross(vector, self.direction), dot(vector, self.direction)))
        return max(turned - QUARTER, 0.0) if self.side else turned

    def taken(self, follows: Any) -> Any:
        """Return the value to go on with: what the answer does not say is taken from what follows without it."""
        length = abs(follows)
        size = length if self.size is None else self.size
        if not isinstance(follows, complex):
            return size * (self.sign if self.sign is not None else -1.0 if follows < 0.0 else 1.0)
        if self.direction is not None and not (self.side and length and not self.off(follows)):
            return self.direction * size
        return follows * (size * (1.0 / length)) if length else follows


def known(number: float | None) -> bool:
    """Whether a number is there, and is one."""
    return number is not None and math.isfinite(number)


def nearest(values: tuple[float, ...], ours: float) -> float:
    """Return the value nearest to ours in ratio."""
    return min(values, key=lambda x: abs(math.log(abs(x)) - math.log(ours)) if x and ours else math.inf)


@lru_cache(maxsize=1024)  # the same answers are held against one candidate after the other
def readings(answer: Answer, values: tuple[float, ...], plain: bool) -> tuple[Said, ...]:
    """Return all ways to take an answer whose value is one of `values`.

    A sign of the value is its sense. Where the sense is free to be assumed, a minus says that it is the other one, and
    a sign alone leaves open which one was assumed; a sense that is said beside the value does not. A `plain` number has
    no sense: without a minus it is positive.
    """
    turned = cmath.rect(1.0, answer.direction) if answer.direction is not None and known(answer.direction) else None
    free, found = FREE.match(answer.name), []
    for value in values or (None,):
        size, minus = (None, False) if value is None else (abs(value), value < 0.0)
        sign = answer.sense if answer.sense else None
        if minus and free:
            opposite = None if turned is None else turned * -1.0
            ways = (sign, turned), (None if sign is None else -sign, opposite)
            found += [Said(size, *way, answer.side) for way in ways]
        else:
            positive = plain or (answer.plus and not free)
            written = -1 if minus else 1 if positive and size else None
            found.append(Said(size, written if sign is None else sign, turned, answer.side))
    return tuple(found)


SIZE, DIRECTION = "size", "direction"
NEVER = math.inf


class Miss(NamedTuple):
    """Tolerances by which an answer misses, one or less being right, and what does: size, or direction alone."""

    off: float
    about: str


def miss(said: Said, value: Any, allowed: float, angle: float = math.pi) -> Miss:
    """Return by how many tolerances `said` misses `value`, NEVER where that is undefined.

    The size may miss what is `allowed`, SI, and the direction of a vector an `angle`, radians.
    """
    if value != value:
        return Miss(NEVER, SIZE)
    size = abs(value)
    right = 0.0 if said.size is None else abs(said.size - size)
    off = ratio(right, allowed)
    if not isinstance(value, complex):
        if said.sign is None:
            return Miss(off, SIZE)
        turned = ratio(abs((size if said.size is None else said.size) * said.sign - value), allowed)
        return Miss(turned, DIRECTION if off <= 1.0 < turned else SIZE)
    if said.direction is None or size <= allowed:
        return Miss(off, SIZE)
    most = max(angle, math.asin(allowed / size))
    turned = said.off(value) / most
    return Miss(turned, DIRECTION) if off <= 1.0 < turned else Miss(max(off, turned), SIZE)


def ratio(missed: float, allowed: float) -> float:
    """Return a difference in tolerances; where nothing is allowed any difference is too much."""
    return missed / allowed if allowed else 0.0 if not missed else NEVER


class Verdict(StrEnum):
    """What a line is; `passed` where nothing is wrong with it, `faulty` where there is an error in this very line."""

    RIGHT = "right"
    CARRIED = "carried"
    WRONG = "wrong"
    UNCOUNTED = "uncounted"  # follows from numbers most of which are wrong
    ARITHMETIC = "arithmetic"
    SCALE = "scale"
    SMALL = "small"  # within the tolerance, of a value too small for a hand: neither right nor wrong
    MISSING = "missing"

    passed: bool
    faulty: bool

    def __init__(self, value: str) -> None:
        """Say once what is asked of every line again and again."""
        self.passed, self.faulty = value in ("right", "carried", "small"), value in ("wrong", "arithmetic", "scale")


@dataclass(frozen=True, slots=True)
class Line:
    """One line marked; sizes in SI, vectors complex."""

    name: str
    plan: str
    verdict: Verdict
    answer: Answer | None
    said: Any  # what it leaves out (a direction, a sense) is that of what follows
    right: Any
    follows: Any  # from the answers before it
    allowed: float  # of the size
    off: float  # by how many tolerances it misses the better of the two
    about: str = ""  # of a line that does not pass: "size" or "direction", that of a scalar being its sense
    way: Said | None = None  # in which the answer was taken
