"""What is drawn of a hoist when only the first steps of each view have been done: a blank has axes with their scales.

The parts of a view are said where it is drawn; here stands which of them each step of the note draws.
"""

from __future__ import annotations

from ..handouts.begun import Shown
from .axes import AXES
from .scene import HoistScene

Stage = tuple[str, ...]  # parts that are drawn in one step
# by view; what the first stage draws is there before any step, and on a blank
STAGES: dict[str, tuple[Stage, ...]] = {
    "scheme": ((), ("support",), ("rope",), ("bridge",)),
    "model": ((), ("model",)),
    "forces": ((AXES,), ("levels",), ("resting",), ("hanging",), ("article",)),
    "lift_off": ((AXES,), ("points",), ("curves",), ("crossing",)),
    "extremes": ((AXES,), ("points", "curves"), ("crossing",)),
    "circle": ((AXES,), ("start",), ("circle",), ("ends",)),
    "beams": ((AXES,), ("bent",), ("greatest",)),
}
NOTHING = frozenset[str]()
CONDITIONS = 2  # columns of the table of checks that say what is asked


def stages(scene: HoistScene) -> dict[str, tuple[Stage, ...]]:
    """Return what each step of the note draws, by view.

    Where the closed formulas are not valid, the first step of the forces over time says so, and draws nothing; the
    circle has no step for its ends, which such a rope need not reach.
    """
    if scene.solved.forces.motion is None:
        return STAGES
    axes, *forces = STAGES["forces"]
    *circle, ends, last = STAGES["circle"]
    return STAGES | {"forces": (axes, (), *forces), "circle": (*circle, ends + last)}


def begun(scene: HoistScene, steps: int) -> dict[str, Shown]:
    """Return for every view what its first steps draw; of the table of checks what is asked."""
    found = {
        view: Shown(NOTHING, NOTHING, notes=steps >= len(table) - 1, parts=frozenset(_drawn(table[: steps + 1])))
        for view, table in stages(scene).items()
    }
    return found | {"checks": Shown(NOTHING, NOTHING, notes=False, rows=NOTHING, columns=CONDITIONS)}


def _drawn(table: tuple[Stage, ...]) -> tuple[str, ...]:
    return tuple(part for stage in table for part in stage)
