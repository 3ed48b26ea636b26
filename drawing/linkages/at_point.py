"""The plan that compound motion draws at a point itself: its vectors and construction lines, in place."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...plans.linkages.chain import hinged
from ...plans.linkages.compound import ACCELERATION, TOTAL, VELOCITY, Coupler
from ...plans.linkages.legs import guide_letters
from ...plans.names import mark, role, spelled, vector
from ..shapes import Vector, shifted
from .reading import vectors_of
from .scene import Scene

VELOCITIES, ACCELERATIONS = "compound_velocity", "compound_a_"  # names of the views
PAST = 8.0  # mm by which a construction line runs past the point that it finds


@dataclass(frozen=True, slots=True)
class At:
    """The vectors of one point of a coupler: the plan drawn there, and where the point stands."""

    scene: Scene
    coupler: Coupler
    point: str
    kind: str  # "V" or "a"

    @property
    def letter(self) -> str:
        """The point's letter in the names of its parts."""
        return self.coupler.letters[self.point]

    @property
    def plan(self) -> str:
        """The plan at the point."""
        return spelled(VELOCITY if self.kind == "V" else ACCELERATION, self.letter)

    def mm(self, mark: str) -> complex:
        """Return where a mark of the plan stands in the figure."""
        return self.scene.mm(mark) + self.scene.mm(self.point)

    def vectors(self) -> Iterator[Vector]:
        """Go through the vectors as they were drawn, the total last, each with the name of the quantity it shows."""
        steps = self.scene.solved.program.on(self.plan)
        found = vectors_of(steps)
        if f"{self.plan}.n" in self.scene.solved.values:
            found.append((vector("a", self.point, part="t"), mark(self.plan, "n"), mark(self.plan, self.letter)))
        total = vector(self.kind, self.letter, part=TOTAL).size
        for name, tail, tip in sorted(found, key=lambda item: item[0] == total):
            plain = vector(self.kind, self.point) if name == total else name
            yield shifted_vector(self.scene.vector(plain, tail, tip), self.scene.mm(self.point))

    def lines(self) -> Iterator[tuple[complex, complex, complex, str]]:
        """Go through the construction lines: whence, the point that they find, their end, their direction in words."""
        for step in self.scene.solved.program.on(self.plan):
            if step.verb == "meet":
                p, u, q, w = step.operands
                end = self.mm(step.name)
                for start, direction in ((p, u), (q, w)):
                    e, tail = self.scene.solved.point(direction), self.mm(start)
                    sense = 1.0 if ((end - tail) / e).real >= 0 else -1.0
                    yield tail, end, end + e * sense * PAST, direction_words(self.scene, direction)

    def marks(self) -> Mapping[str, complex]:
        """Return where the point itself stands."""
        return {self.point: self.scene.mm(self.point)}

    def poles(self) -> Sequence[str]:
        """Return the point: its vectors begin there."""
        return (self.point,)


def figures_of(scene: Scene) -> dict[str, tuple[At, ...]]:
    """Return the points whose vectors the figures of compound motion show, by the name of the view."""
    solved = scene.solved
    if not any(is_at_point(plan) and plan in scene.scales for plan in solved.program.plans):
        return {}
    points = [(c, point) for c in hinged(solved.mechanism, solved.structure) for point in c.letters]
    found = {VELOCITIES: tuple(At(scene, c, point, "V") for c, point in points)}
    return found | {f"{ACCELERATIONS}{c.letters[point]}": (At(scene, c, point, "a"),) for c, point in points}


def is_at_point(plan: str) -> bool:
    """Whether a plan is drawn at a point itself."""
    return role(plan).kind in (VELOCITY, ACCELERATION)


def shifted_vector(vector: Vector, by: complex) -> Vector:
    """Return a vector moved to another place."""
    moved = shifted(vector, by)
    assert isinstance(moved, Vector)
    return moved


def direction_words(scene: Scene, direction: str) -> str:
    """Return a direction as it is written on a construction line: normal to AB, parallel to the guide y-y."""
    line = role(direction)
    if line.kind == "u":
        return f"∥{guide_letters(scene.solved.program).get(direction, line.of)}"
    return {"n": "⊥", "e": "∥"}[line.kind] + re.sub(r"(\d+)", r"_{\1}", line.letters)
