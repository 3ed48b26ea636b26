"""The crank drawn at another angle: what any multiple of five degrees would give, all of them run at once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..boards.batch import batch
from ..marking.key import Key
from .inputs import angle_of_driver
from .rules import Broken, Scene

STEP = 5  # degrees; tasks give no finer angles, and nobody misreads a protractor by less
OWN = 0.5  # part of a step by which an angle differs from the right one


@dataclass(frozen=True)
class Turned:
    """The construction of a key at other angles of its crank; none where a slider drives, or an angle is calculated."""

    key: Key

    @cached_property
    def name(self) -> str:
        """The given that is the crank's angle; empty where there is none."""
        name = angle_of_driver(Scene(self.key.paper, self.key.values))
        return "" if name in (None, "zero") else str(name)

    @cached_property
    def angles(self) -> NDArray[np.float64]:
        """The angles, radians, without the right one."""
        if not self.name:
            return np.zeros(0)
        found = np.radians(np.arange(0.0, 360.0, STEP))
        apart = np.abs(np.angle(np.exp(1j * (found - self.key.paper.givens[self.name]))))
        return np.asarray(found[apart > OWN * math.radians(STEP)])

    @cached_property
    def table(self) -> NDArray[np.complex128]:
        """What each angle gives for every question, of shape (angles, questions); NaN where it gives nothing."""
        names, paper = list(self.key.questions), self.key.paper
        rows = np.full((len(self.angles), len(names)), np.nan, complex)
        if len(rows):
            values, _ = batch(paper.program, {**paper.givens, self.name: self.angles}, names)
            for place, name in enumerate(names):
                rows[:, place] = values[name]
        return rows

    def broken(self, row: int) -> Broken:
        """Return the construction at one of the angles, as a mistake."""
        paper, angle = self.key.paper, float(self.angles[row])
        return Broken("M10", self.name, f"={angle!r}", paper.program, {**paper.givens, self.name: angle})
