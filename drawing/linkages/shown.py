"""A scene for tables and equations: all its numbers, scale factors and units as the task wants them shown.

What stands in SI for the figures stands here in cm and cm/s, say; a system of units without forces is coherent, so that
the same laws hold between the numbers that are shown.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from ...plans.linkages.mechanism import ZERO, Mechanism, Prismatic
from ...plans.linkages.solved import Solved
from ...plans.quantities import UNITS
from ...scales.display import AS_INSIDE, Display
from ...scales.scale import Scale
from ..words import Words
from .scene import Scene


class ShownScales(Mapping[str, Scale]):
    """Scale factors by plan, as they are shown."""

    def __init__(self, scales: Mapping[str, Scale], display: Display) -> None:
        self._scales, self._display = scales, display

    def __getitem__(self, plan: str) -> Scale:
        """Return the scale factor of a plan."""
        return self._display.scale(self._scales[plan])

    def __iter__(self) -> Iterator[str]:
        """Go through the plans."""
        return iter(self._scales)

    def __len__(self) -> int:
        """Return the number of plans."""
        return len(self._scales)


def as_shown(scene: Scene) -> Scene:
    """Return the scene in the units of the task."""
    display = scene.words.display
    if display == AS_INSIDE:
        return scene
    solved, words = _solved(scene.solved, display), _words(scene.words)
    return replace(scene, solved=solved, scales=ShownScales(scene.scales, display), words=words)


def _solved(solved: Solved, display: Display) -> Solved:
    units = dict.fromkeys(_lengths(solved.mechanism), "m")
    units |= {name: q.unit for name, q in solved.quantities.items()}
    values = {name: _value(display, value, units.get(name) or _unit(name)) for name, value in solved.values.items()}
    quantities = {name: q.shown(display) for name, q in solved.quantities.items()}
    return replace(solved, values=values, quantities=quantities)


def _value(display: Display, value: Any, unit: str | None) -> Any:
    if unit is None:
        return value
    if isinstance(value, complex):
        return complex(display.value(value.real, unit), display.value(value.imag, unit))
    return display.value(value, unit)


def _lengths(mechanism: Mechanism) -> set[str]:
    """Return the names of the mechanism's distances and coordinates."""
    names = {xy for link in mechanism.links for place in link.points.values() for xy in place}
    for pair in mechanism.pairs:
        names.update((*pair.through, pair.offset) if isinstance(pair, Prismatic) else pair.at or ())
    return names - {ZERO}


def _unit(name: str) -> str | None:
    """Return the unit of what the construction alone knows: sizes of velocities and accelerations, measured lengths."""
    kind = name.lstrip("_").partition("_")[0]
    return UNITS[kind] if name.startswith("_") and kind in ("V", "a", "l") else None


def _words(words: Words) -> Words:
    mm, paper = words.unit("mm"), words.unit(words.display.paper)
    head = words["table.segment"].replace(mm, paper)
    return replace(words, texts={**words.texts, "unit.mm": paper, "table.segment": head})
