"""What the note of a seesaw says, and what handouts show of its tables."""

from __future__ import annotations

from collections.abc import Mapping

from kulman.drawing.handouts import Shown
from kulman.drawing.notes.blocks import Story
from kulman.scales.scale import Scale
from kulman.tests.support.toy.drawing.seesaw.sheet import SeesawScene


def story(scene: SeesawScene, scales: Mapping[str, Scale], texts: Mapping[str, str]) -> Story:
    """Tell the stages of both figures, with the forces."""
    values = {name: scene.value(scene.solved.size(name)) for name in ("F_1", "F_2")}
    return Story(texts=texts, said=values)


def begun(scene: SeesawScene, steps: int) -> dict[str, Shown]:
    """Return nothing: both figures have stages."""
    return {}
