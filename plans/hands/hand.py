"""How well a hand draws: the errors of pencil, protractor and ruler, and what a teacher lets pass of them.

The names are those of presets: the same hand draws, and the same tolerance marks.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...scales.errors import InputError
from ...scales.names import unknown

LARGEST = {"point": 100.0, "direction": 90.0, "reading": 100.0}  # mm, degrees: the sheet, a right angle


@dataclass(frozen=True, slots=True)
class Hand:
    """Standard deviations of the errors of a hand."""

    point: float  # mm, of each coordinate of a mark, of the distance of a line from the mark through which it is drawn
    direction: float  # degrees, of a line from the direction that it should have
    reading: float  # mm, of a length read off or taken into the compass

    def __post_init__(self) -> None:
        """Refuse errors below zero, and those of which no drawing is left."""
        for name, most in LARGEST.items():
            if not getattr(self, name) >= 0.0:
                raise InputError("hand-negative", name=name)
            if getattr(self, name) > most:
                raise InputError("hand-large", name=name, most=f"{most:g}")

    def times(self, factor: float) -> Hand:
        """Return a hand with errors larger by `factor`."""
        return Hand(self.point * factor, self.direction * factor, self.reading * factor)


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What a teacher lets pass: of a segment the larger of `mm` and its `part`, of a direction `degrees`."""

    mm: float
    part: float
    degrees: float

    def of_segment(self, millimetres: Any, sine: Any = 1.0) -> Any:
        """Return the millimetres by which a segment may miss; `sine` is that of the intersection at its end."""
        most = self.part * abs(millimetres)
        return (most if most > self.mm else self.mm) / abs(sine)


@dataclass(frozen=True, slots=True)
class Preset:
    """A hand, the segment of the crank's velocity that goes with it (mm; None: any), and the tolerance."""

    hand: Hand
    pa: float | None
    tolerance: Tolerance


# What rulers and protractors can: a ruler with marks of 0.5 mm is read to 0.25 mm, dividers and a scale to 0.1 or
# 0.2 mm, a protractor to half a degree, set squares keep a quarter to half a degree. What departments ask: 5 % is the
# usual limit between a plan and a calculation, 3 % that of careful work, 10 % the upper one; plans drawn by a computer
# agree with the calculation to 0.01 ... 0.1 %, and are held to 0.5 %.
PRESETS: Mapping[str, Preset] = {
    "cad": Preset(Hand(0.03, 0.01, 0.03), None, Tolerance(0.3, 0.005, 0.2)),
    "careful": Preset(Hand(0.1, 0.25, 0.1), 100.0, Tolerance(1.0, 0.03, 0.5)),
    "normal": Preset(Hand(0.25, 0.5, 0.25), 80.0, Tolerance(2.0, 0.05, 1.0)),
    "lenient": Preset(Hand(0.5, 1.0, 0.5), 50.0, Tolerance(3.0, 0.1, 2.0)),
}


def preset(name: str) -> Preset:
    """Return a preset by its name.

    Raises
    ------
    InputError
        With the key `hand-unknown`.
    """
    if name not in PRESETS:
        raise unknown("hand-unknown", name, PRESETS)
    return PRESETS[name]
