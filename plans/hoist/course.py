"""A hoist over time, until one period after the lift-off: forces, stress, how the load rises and the beams bend."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ...scales.scale import steps
from ..laws import LAWS
from ..solved import Columned, Course, Pieces, Rows
from .forces import COLUMN_UNITS, changed, course, formulas, pieces
from .hoist import LEFT
from .model import lift_off_between
from .solve import SolvedHoist

CHANGEABLE = ("G_1", "G_2", "S", "E_k", "I_0", "E_0", "I_2", "E_2", "V_0", "a", "slack", "g")
TABLED = 25  # times in the table, beside the marks


class HoistCourse(Course):
    """A hoist at times, evenly."""

    usual, called = 361, "times"

    def __init__(self, solved: SolvedHoist) -> None:
        self.solved, self.forces = solved, solved.forces

    def places(self, count: int) -> Any:
        """Return so many times, s."""
        return np.linspace(0.0, self.forces.end, count)

    def columns(self, places: Any) -> Sequence[Columned]:
        """Return the columns at times."""
        columns = course(self.forces, places).columns
        return [Columned(name, unit, columns[name]) for name, unit in COLUMN_UNITS.items()]

    def formulas(self, given: Callable[[str], Any]) -> dict[str, Any]:
        """Return the columns; as vectors, how far load, beam and drum are off, and the forces on the load."""
        found = formulas(self.forces, given, self.changeable)
        moved = {"load.s": found["s"], "load.w_0": -found["w_0"], "drum.w_2": -found["w_2"]}
        moved |= {"load.F_01": -found["F_01"], "load.F_12": found["F_12"]}
        return found | {name: size * 1j for name, size in moved.items()}

    @property
    def changeable(self) -> Mapping[str, float]:
        """What is lifted, what bears it, and how, as long as the formulas are valid and no beam is rigid.

        Lengths and places of beams and rope are none of them: their scheme would be another.
        """
        given = {name: float(self.forces.found[name]) for name in CHANGEABLE}
        return given if self.forces.motion is None and all(map(math.isfinite, given.values())) else {}

    @property
    def kept(self) -> Mapping[str, float]:
        """The lift-off."""
        return {"t_1": float(self.forces.found["t_1"])} if self.changeable else {}

    def found_again(self, given: Callable[[str], Any]) -> Mapping[str, tuple[Any, Any, Any]]:
        """Return the lift-off."""
        if not self.changeable:
            return {}
        return {"t_1": lift_off_between(changed(self.forces, given, self.changeable))}

    def enlarged(self, part: float) -> float:
        """Return the round number that makes the largest displacement about such a part of the rope's length."""
        columns = course(self.forces, self.places(self.usual)).columns
        shift = max(float(np.abs(columns[name]).max()) for name in ("s", "w_0", "w_2"))
        return steps(part * float(self.forces.found["L"]) / shift)[0] if shift > 0.0 else 1.0

    def bent(self, i: int, count: int) -> list[tuple[float, float]]:
        """Return so many places along the beam `i`, from its left end, m, and how far it bends there.

        That is in parts of the deflection under what it bears.
        """
        of = LAWS["deflection_of_unit"]
        l, b = (float(self.forces.found[f"{name}_{i}"]) for name in "lb")
        from_left = np.linspace(0.0, l, count)
        places = from_left if self.solved.layout.near[i // 2] == LEFT else l - from_left
        parts = of(places, b, l, 1.0, 1.0) / of(np.float64(b), b, l, 1.0, 1.0)
        return list(zip(from_left.tolist(), parts.tolist(), strict=True))

    def pieces(self) -> Pieces | None:
        """Return the pieces of a motion for which the formulas are not valid."""
        return pieces(self.forces)

    def rows(self, count: int | None) -> Rows:
        """Return even times with the marks among them."""
        heads: dict[float, list[str]] = {float(t): [] for t in self.places(count or TABLED)}
        for name, at in self.forces.marks.items():
            heads.setdefault(at, []).append(name)
        times = sorted(heads)
        return [", ".join(heads[t]) for t in times], self.columns(np.array(times))

    def states(self, places: Any) -> dict[str, tuple[str, ...]]:
        """Return what bears the load at each time."""
        return {"bears": course(self.forces, places).states}

    def data(self, places: Any) -> dict[str, Any]:
        """Return what bears the load when, the marks, and whether the formulas are valid."""
        return {"valid": self.forces.motion is None, **self.states(places), "marks": self.forces.marks}
