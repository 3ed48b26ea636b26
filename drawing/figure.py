"""A figure of a sheet as a table of stages: the view draws them all, a handout the first ones, the note tells them."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Generic, TypeVar

from ..plans.board import Program
from ..plans.names import is_shown
from .view import Canvas, View

COARSE = 0.1  # mm by which a curve may be simplified for the letters beside it
GIVEN = "given"  # what is drawn before any step
ANSWERS = "answers"  # what is drawn in no stage, but with all the work: what it comes to
NUMBER = re.compile(r"\d+")

Scene = TypeVar("Scene")


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of the work on a figure: the part of the view that is drawn in it.

    Its sentence has the key of the figure, a dot and its `name`. `marks` are what the construction makes in it, `#` for
    numbers, and `verb` how where marks of one name are made in two ways: without such a step the stage falls away.
    """

    name: str
    marks: str = ""
    verb: str = ""
    when: Callable[[Any], bool] = lambda scene: True  # else what it would draw comes with the stage before it
    variant: Callable[[Any], str] = lambda scene: ""  # what stands after its key in a scene of another sentence


def stages(*names: str) -> tuple[Stage, ...]:
    """Return stages that every scene has, by name."""
    return tuple(map(Stage, names))


@dataclass(frozen=True, slots=True)
class Figure(Generic[Scene]):
    """One figure of a sheet: how it is drawn, the ladders of scale factors it depends on, the one that sizes it first.

    The first of its `stages` is there before any step, and on a blank. Its sentences have keys that begin with `key`;
    without one nothing is told. A table or a text has no stages.
    """

    name: str
    draw: Callable[[Scene], View]
    ladders: tuple[str, ...] = ()
    stages: tuple[Stage, ...] = ()
    key: str = ""

    def keys(self, scene: Any) -> dict[str, str]:
        """Return the stages that a scene has, in order, with the keys of their sentences."""
        made = families(scene.solved.program)
        own = [s for s in self.stages if s.when(scene) and (not s.marks or (s.marks, s.verb) in made)]
        key = {stage.name: f"{self.key}.{stage.name}{stage.variant(scene)}" if self.key else "" for stage in own[1:]}
        return {own[0].name: "", **key}

    def canvas(self, scene: Any, coarse: float = COARSE) -> Canvas:
        """Return an empty canvas for the stages that a scene has; letters may take curves for `coarse` ones, mm."""
        keys, parts, last = self.keys(scene), {ANSWERS: ANSWERS}, ""
        for stage in self.stages:
            last = parts[stage.name] = stage.name if stage.name in keys else last
        return Canvas(scene.style, coarse=coarse, parts=parts, stages=keys)


@lru_cache(maxsize=8)
def families(program: Program) -> frozenset[tuple[str, str]]:
    """Return the families of the steps of a program, each with the verbs of its steps and with none."""
    return frozenset((family(step.name), verb) for step in program for verb in ("", step.verb))


def family(name: str) -> str:
    """Return the name of a step with `#` for its numbers; a quantity keeps its own.

    >>> family("profile.E12"), family("r_0")
    ('profile.E#', 'r_0')
    """
    return name if is_shown(name) else NUMBER.sub("#", name)
