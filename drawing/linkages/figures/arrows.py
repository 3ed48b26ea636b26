"""Arrows of forces at their points: clear of links and of one another, each with its letter."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from ...shapes import Arrow, Pen
from ...symbols import clear_ray, room_on
from ...view import Canvas
from ..marks import symbol
from ..scene import Scene
from ..skeleton import Stroke, rays_of

SHORTER = 0.6  # part of its length that an arrow beyond another one has
SPARE, ALONG = 1.2, 2.5  # mm between two arrows on a line, and beside one another where they count as on one
FARTHEST = 2.5  # lengths of an arrow that it may stand from its point


@dataclass(slots=True)
class Arrows:
    """Arrows on a figure of main lines `strokes`; it remembers what lies at each place, and which forces are zero."""

    canvas: Canvas
    scene: Scene
    strokes: Sequence[Stroke]
    zero: list[str] = field(default_factory=list)
    hung: list[str] = field(default_factory=list)
    at: dict[complex, list[complex]] = field(default_factory=dict)  # ends of the arrows at each place, from there
    _lying: list[Stroke] = field(default_factory=list)
    _barred: dict[complex, list[complex]] = field(default_factory=dict)

    def hang(self, name: str, at: complex, gap: float = 0.0) -> None:
        """Draw the arrow of a force at a point, `gap` mm from it or more, and letter it; once."""
        if name in self.hung or not self.scene.defined(name):
            return
        self.hung.append(name)
        e = self.scene.direction(name)
        if e == 0:
            self.zero.append(name)
            return
        ray, start = self._where(at, e, gap)
        near, far = at + ray * start, at + ray * (start + self._length(start > gap))
        self.at.setdefault(_place(at), []).append(far - at)
        self._lying.append((near, far))
        tail, tip = (near, far) if abs(ray - e) < 1.0 else (far, near)
        letter_arrow(self.canvas, self.scene, Arrow(tail, tip, Pen.MAIN, name=name), ray)

    def bar(self, at: complex, directions: Iterable[complex]) -> None:
        """Let no arrow leave a place in these directions."""
        self._barred.setdefault(_place(at), []).extend(directions)

    def _where(self, at: complex, e: complex, gap: float) -> tuple[complex, float]:
        """Choose the side of a point on which an arrow lies, and how far from it, clear of all on its own line."""
        length, arrows = self.scene.style.force, self.at.get(_place(at), [])
        lines = [*rays_of(at, self.strokes), *self._barred.get(_place(at), ())]
        ray, _ = clear_ray(e, lines, arrows)
        start, other = self._start(at, ray, gap), self._start(at, -ray, gap)
        if start - other > 0.6 * length and room_on(-ray, lines, arrows) > 0.35:
            ray, start = -ray, other
        # far from its point it would not be found: then it lies on the link
        return (ray, start) if start < gap + FARTHEST * length else (ray, gap)

    def _start(self, at: complex, ray: complex, start: float) -> float:
        """Return where on a ray there is room for an arrow: beyond links and arrows that lie along it."""
        first, taken = start, []
        lying = [(s, self.scene.style.pair + 1.0, 0.5) for s in self.strokes]
        lying += [(s, SPARE, ALONG) for s in self._lying]
        for (a, b), spare, aside in lying:
            ends = [(end - at) / ray for end in (a, b)]
            if all(abs(end.imag) < aside for end in ends):
                low, high = sorted(end.real for end in ends)
                taken.append((low, high, spare))
        for low, high, spare in sorted(taken):
            if low < start + self._length(start > first) - 0.5 and high > start + 0.5:
                start = high + spare
        return start

    def _length(self, beyond: bool) -> float:
        """Return the length of an arrow, one `beyond` another on its line being shorter, to stay near its point."""
        return self.scene.style.force * (SHORTER if beyond else 1.0)


def _place(at: complex) -> complex:
    return complex(round(at.real, 2), round(at.imag, 2))


def letter_arrow(canvas: Canvas, scene: Scene, arrow: Arrow, ray: complex) -> None:
    """Draw a force arrow with its letter beside its outer half."""
    canvas.add(arrow)
    far = arrow.tip if abs((arrow.tip - arrow.tail) / abs(arrow.tip - arrow.tail) - ray) < 1.0 else arrow.tail
    canvas.label(symbol(scene, arrow.name), (far - ray * 0.55 * scene.style.force, far), clear=0.9)
