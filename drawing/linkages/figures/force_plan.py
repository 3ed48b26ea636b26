"""Forces of very different size on one plan: what insets show of it, and what is left for words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ....plans.board import Step
from ....plans.names import FORCES, role
from ....scales.scale import SERIES
from ...shapes import Vector
from ..marks import symbol, vectors_of
from ..scene import Scene
from .inset import NUMERALS, READABLE, TIMES, WIDEST, Window, shows, size_of, window_about

NARROWEST = 45.0  # mm, the least side of an inset
PAST = 6.0  # mm by which a construction line runs past the point that it finds
FEW = 1  # forces too short to be read that a plan shows as points, said in words


@dataclass(frozen=True, slots=True)
class ForcePlan:
    """A plan of forces; its insets show what is too short for an arrowhead, where that is more than one force."""

    scene: Scene
    plan: str

    @property
    def drawn(self) -> list[tuple[str, str, str]]:
        """Quantity, tail and tip of each force."""
        return vectors_of(self.scene.solved.program.on(self.plan))

    def vectors(self) -> Iterator[Vector]:
        """Go through the forces that can be read on the plan or in an inset."""
        least = READABLE * self.scene.style.arrow / self._times()[-1]
        for quantity, tail, tip in dict.fromkeys(self.drawn):
            vector = self.scene.vector(quantity, tail, tip)
            if abs(vector.tip - vector.tail) >= least:
                yield vector

    def lines(self) -> Iterator[tuple[complex, complex, complex, str]]:
        """Go through the construction lines, of which nothing is said."""
        for step in self.scene.solved.program.on(self.plan):
            if step.verb == "meet":
                p, u, q, w = step.operands
                for start, direction in ((p, u), (q, w)):
                    yield (*construction_line(self.scene, step, start, direction), "")

    def marks(self) -> Mapping[str, complex]:
        """Return the places of the pole and of all ends of forces."""
        return {mark: self.scene.mm(mark) for mark in (*self.poles(), *(tip for _, _, tip in self.drawn))}

    def poles(self) -> Sequence[str]:
        """Return the pole."""
        return [step.name for step in self.scene.solved.program.on(self.plan) if step.verb == "pole"]

    def windows(self) -> list[Window]:
        """Return what the insets show, the coarser ones first; none where a single force is too short."""
        short = self._short(1.0)
        found, left = list[Window](), _clusters(short) if len(short) > FEW else []
        while left:
            cluster = left.pop(0)
            window = self._window(cluster)
            found.append(window)
            finer = [vector for vector in cluster if vector in self._short(window.times)]
            left += _clusters(finer) if len(finer) < len(cluster) or window.times < self._times()[-1] else []
        return found

    def _short(self, times: float) -> list[Vector]:
        """Return the forces that are shorter than an arrowhead where they are drawn `times` as large."""
        return [v for v in self.vectors() if abs(v.tip - v.tail) * times < self.scene.style.arrow]

    def _window(self, cluster: Sequence[Vector]) -> Window:
        """Return the window for forces that hang together, as large as they are readable or as an inset may be."""
        ends = {end for vector in cluster for end in (vector.tail, vector.tip)}
        least = min(abs(vector.tip - vector.tail) for vector in cluster)
        times = self._times()
        readable = next((m for m in times if least * m >= READABLE * self.scene.style.arrow), times[-1])
        fitting = [m for m in times if max(size_of(ends)) * m <= WIDEST]
        return window_about(ends, min(readable, fitting[-1] if fitting else times[0]), NARROWEST)

    def _times(self) -> Sequence[float]:
        """Return the enlargements whose scale factors are of the customary series; all, where there are none."""
        mu = self.scene.scales[self.plan].mu
        customary = [m for m in TIMES if float(f"{mu / m:e}".partition("e")[0]) in SERIES]
        return customary or TIMES

    def said(self, shown: Sequence[Window]) -> Iterator[str]:
        """Say which forces stand in which inset."""
        for numeral, window in zip(NUMERALS, shown, strict=False):
            readable = (vector for vector in self.vectors() if _seen(self.scene, window, vector))
            symbols = dict.fromkeys(symbol(self.scene, vector.quantity) for vector in readable)
            if symbols:
                yield self.scene.words["said.inset"].format(vectors=", ".join(symbols), inset=numeral)


def enlarged(scene: Scene, quantity: str, plan: str) -> float:
    """Return how many times as large as on its plan a force can be read in an inset, 1 where it is in none."""
    if role(plan).kind != FORCES:
        return 1.0
    forces = ForcePlan(scene, plan)
    own = [vector for vector in forces.vectors() if vector.quantity == quantity]
    return min((w.times for w in forces.windows() if any(_seen(scene, w, v) for v in own)), default=1.0)


def _seen(scene: Scene, window: Window, vector: Vector) -> bool:
    """Whether a vector too short for an arrowhead on its plan can be read in a window."""
    ends, long = (vector.tail, vector.tip), abs(vector.tip - vector.tail) * window.times >= scene.style.arrow
    return long and in_inset(scene, [window], ends)


def _clusters(vectors: Sequence[Vector]) -> list[list[Vector]]:
    """Part vectors into those that hang together by their ends."""
    clusters: list[list[Vector]] = []
    for vector in vectors:
        own = [c for c in clusters if any(_joined(vector, other) for other in c)]
        clusters = [c for c in clusters if c not in own] + [[*(v for c in own for v in c), vector]]
    return clusters


def _joined(one: Vector, other: Vector) -> bool:
    return any(abs(a - b) < 1e-6 for a in (one.tail, one.tip) for b in (other.tail, other.tip))


def in_inset(scene: Scene, shown: Sequence[Window], ends: tuple[complex, complex]) -> bool:
    """Whether a vector is too short to be read in its figure and stands in an inset."""
    short = abs(ends[1] - ends[0]) < scene.style.arrow
    return short and any(shows(window, ends) for window in shown)


def construction_line(scene: Scene, step: Step, start: str, direction: str) -> tuple[complex, complex, complex]:
    """Return whence a line of a meeting runs, the point that it finds, and its end past it."""
    e, tail, found = scene.solved.point(direction), scene.mm(start), scene.mm(step.name)
    along = ((found - tail) / e).real
    if abs(along) < PAST:
        return found - e * 2 * PAST, found, found + e * 2 * PAST
    return tail, found, found + e * PAST if along > 0 else found - e * PAST
