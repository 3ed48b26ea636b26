"""Arms on the lever: those that lie close together are staggered like dimensions, outside of the figure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, radians

from ...shapes import Line, Pen
from ...symbols import arm
from ...view import Canvas
from ..scene import Scene

BESIDE = cos(radians(12.0))  # arms that make a smaller angle run into one another
STEP = 2.4  # heights of an arm's letters between arms that are staggered
LEAST = 0.05  # mm: a shorter arm is none
PAST = 4.0  # mm by which the line of a force runs past what it meets


@dataclass(frozen=True, slots=True)
class LeverArm:
    """An arm: the forces on one line, the names of their arms, where they hang, their direction, the line's foot."""

    forces: tuple[str, ...]
    names: tuple[str, ...]
    at: complex
    along: complex
    foot: complex

    def said(self, scene: Scene) -> str:
        """Return what is written on the arm."""
        symbols = " = ".join(scene.words.symbol(name) for name in self.names)
        return f"{symbols} = {scene.segment(self.names[0])}"

    @property
    def line(self) -> str:
        """The name of the line on which the forces act."""
        return " ".join(self.forces)


def draw_arms(canvas: Canvas, scene: Scene, pole: complex, arms: Sequence[LeverArm], middle: complex) -> None:
    """Draw arms from the `pole`, or beside it on the far side of the figure, whose middle is `middle`."""
    shifts = staggered(pole, arms, middle, STEP * scene.style.text)
    for number, each in enumerate(arms):
        shift = shifts.get(number, 0j)
        _line_of_action(canvas, scene, each, each.foot + shift)
        if abs(each.foot - pole) < LEAST:
            continue
        if shift:
            canvas.add(
                Line(pole, pole + shift * (1 + 1.5 / abs(shift)), Pen.THIN, role="extension", name=each.names[0])
            )
        canvas.add(arm(pole + shift, each.foot + shift, each.names[0], each.along, scene.style))
        ends, text = (pole + shift, each.foot + shift), each.said(scene)
        # smaller than a node's letter: a number with its symbol is long
        canvas.label(text, ends, clear=0.9, height=scene.style.text, strict=True, spare=text)


def staggered(pole: complex, arms: Sequence[LeverArm], middle: complex, step: float) -> Mapping[int, complex]:
    """Return by how much arms are moved along the lines of their forces; the shortest of those side by side stays.

    Arms are side by side when they make a small angle; each is moved away from the middle of the figure.
    """
    shifts: dict[int, complex] = {}
    by_length = sorted((abs(each.foot - pole), i) for i, each in enumerate(arms) if abs(each.foot - pole) >= LEAST)
    bundles: list[list[int]] = []
    for reach, i in by_length:
        way = (arms[i].foot - pole) / reach
        near = (b for b in bundles if (way.conjugate() * _way(arms[b[0]], pole)).real > BESIDE)
        bundle = next(near, None)
        if bundle is None:
            bundles.append([i])
            continue
        outward = arms[i].along
        outward *= -1.0 if (outward.conjugate() * (middle - pole)).real > 0 else 1.0
        shifts[i] = outward * step * len(bundle)
        bundle.append(i)
    return shifts


def _way(each: LeverArm, pole: complex) -> complex:
    return (each.foot - pole) * (1.0 / abs(each.foot - pole))


def _line_of_action(canvas: Canvas, scene: Scene, each: LeverArm, foot: complex) -> None:
    """Draw the line of a force, thin, from its arrow past the foot of its arm."""
    reach = 0.6 * scene.style.force
    ends = sorted((-reach, reach, ((foot - each.at) / each.along).real))
    line = (each.at + each.along * (ends[0] - PAST), each.at + each.along * (ends[-1] + PAST))
    canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=each.line))
