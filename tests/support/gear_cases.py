"""Sheets of gear pairs to be judged, and what is drawn in their views; sizes by the second route of `gears`."""

from __future__ import annotations

import cmath
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from kulman import sheet
from kulman.tests.support.gears import madi, second_route
from kulman.tests.support.readback import Sheet, Stroke, Text, View, read
from kulman.variants.sheets import Sheet as Drawing

NEAR, STEEP = 0.01, 0.01  # mm, degrees
Faults = Iterator[str]
CIRCLES = ("a", "w", "", "b", "f")
WHEELS = (1, 2)


@dataclass(frozen=True)
class GearCase:
    """One pair as a task with changes, on a format, in a language."""

    changes: tuple[tuple[str, float], ...] = ()
    format: str = "A1"
    lang: str = "uk"
    rotation: str = "ccw"
    only: str | None = "meshing"

    def __str__(self) -> str:
        changed = ",".join(f"{name}={value}" for name, value in self.changes)
        return f"{self.format}-{self.lang}-{self.rotation}-{changed}"

    @cached_property
    def drawn(self) -> Drawing:
        changes = {**{name: repr(value) for name, value in self.changes}, "rotation": self.rotation}
        return sheet("madi-gear", set=changes, only=self.only, format=self.format, lang=self.lang)

    @cached_property
    def pages(self) -> tuple[str, ...]:
        return tuple(self.drawn.svg(number) for number in range(1, len(self.drawn.pages) + 1))

    @cached_property
    def sheet(self) -> Sheet:
        return read(*self.pages)

    @cached_property
    def given(self) -> dict[str, float]:
        return madi(**dict(self.changes))

    @cached_property
    def sizes(self) -> dict[str, float]:
        """Quantities by the second route, SI."""
        found = second_route({name: np.array([value]) for name, value in self.given.items()})
        return {name: float(np.ravel(value)[0]) for name, value in found.items()}

    @property
    def side(self) -> int:
        """+1 when the pinion turns counter-clockwise: contacts go to the left."""
        return 1 if self.rotation == "ccw" else -1


def unless(good: bool, fault: str) -> Faults:
    if not good:
        yield fault


# What is drawn in a view.


def mu(view: View) -> float:
    """The printed scale factor, m a mm; it must be that of the printed ratio."""
    heading = " ".join(t.string for t in view.of("heading"))
    number = re.search(r"μ_\{l\} = (\d+[.,]?\d*)", heading)
    ratio = re.search(r"[MМ] (\d+(?:[.,]\d+)?):(\d+)", heading)
    assert number is not None, heading
    assert ratio is not None, heading
    up, down = (float(part.replace(",", ".")) for part in ratio.groups())
    found = float(number[1].replace(",", "."))
    assert abs(found - 1e-3 * down / up) < 1e-9, heading
    return found


def printed(view: View, symbol: str) -> float:
    """The number printed after `symbol =`, as it stands; those of both wheels must agree."""
    found = {
        float(number.replace(",", "."))
        for text in view.texts
        for number in re.findall(rf"(?<!\w){re.escape(symbol)} ?= (-?\d+(?:[.,]\d+)?)", _line(text))
    }
    assert len(found) == 1, f"{symbol}: {found}"
    return found.pop()


def _line(text: Text) -> str:
    """A text as a line; the scripts of one that is turned are below."""
    if not text.turned:
        return text.string
    main = max(run.size for run in text.runs)
    return "".join(run.string if run.size > 0.9 * main else f"_{{{run.string}}}" for run in text.runs)


def arc_of(view: View, name: str) -> tuple[complex, float]:
    """Centre and radius of the arc of a circle."""
    (arc,) = [s.arc for s in view.inside("circle", name) if s.arc is not None]
    return arc[0], arc[1]


def tips(view: View, name: str) -> list[complex]:
    """Tips of the arrowheads of a dimension."""
    return [t.corners[0] for t in view.tips if ("dimension", name) in t.path]


def centres(view: View) -> tuple[complex, complex]:
    return view.point("O1"), view.point("O2")


def outline(view: View, name: str) -> list[complex]:
    """A drawn profile."""
    (line,) = view.lines("profile", name)
    return list(line.points)


def crossings(points: Sequence[complex], centre: complex, radius: float) -> list[complex]:
    """Where a broken line crosses a circle, one after the other."""
    found = []
    for a, b in pairwise(points):
        low, high = abs(a - centre) - radius, abs(b - centre) - radius
        if (low < 0.0) != (high < 0.0):
            found.append(a + (b - a) * (low / (low - high)))
    return found


def turned(centre: complex, a: complex, b: complex) -> float:
    """The angle from a to b about a centre, rad."""
    return cmath.phase((b - centre) / (a - centre))


def one(strokes: Sequence[Stroke]) -> tuple[complex, complex]:
    """The ends of the only stroke."""
    (stroke,) = strokes
    return stroke.points[0], stroke.points[-1]
