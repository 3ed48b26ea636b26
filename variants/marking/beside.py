"""Where the letters of a student's vectors stand: beside them, on the outer side, none on another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

PLACES = (0.5, 0.36, 0.64, 0.22, 0.78)  # along a vector, the best first
GAP = 0.8  # mm from the line
HEIGHT, WIDTH = 3.6, 1.8  # mm, of a line of text, and of a letter on the average


class Box(NamedTuple):
    """The room of a text, mm, y down: its middle and half its width."""

    middle: complex
    half: float

    @property
    def start(self) -> complex:
        """Where the text begins, on its line."""
        return self.middle + complex(-self.half, 0.3 * HEIGHT)

    def lies_in(self, figure: complex) -> bool:
        """Whether the text lies within a figure of this width and height."""
        x, y = self.middle.real, self.middle.imag
        return self.half <= x <= figure.real - self.half and 0.5 * HEIGHT <= y <= figure.imag - 0.5 * HEIGHT

    def meets(self, other: Box) -> bool:
        """Whether two texts lie on each other."""
        apart = self.middle - other.middle
        return abs(apart.real) < self.half + other.half and abs(apart.imag) < HEIGHT


def boxes(vectors: Sequence[tuple[complex, complex, int]], figure: complex) -> Iterator[Box]:
    """Go through the rooms of the texts of vectors, in their order.

    Parameters
    ----------
    vectors : sequence of (complex, complex, int)
        Tail, tip and number of letters, mm, y down.
    figure : complex
        Its width and height; texts turn away from its middle, and keep within it.
    """
    taken: list[Box] = []
    for tail, tip, letters in vectors:
        spots = list(_spots(tail, tip, 0.5 * WIDTH * letters, figure * 0.5))
        within = [spot for spot in spots if spot.lies_in(figure)] or spots
        box = next((spot for spot in within if not any(map(spot.meets, taken))), within[0])
        taken.append(box)
        yield box


def _spots(tail: complex, tip: complex, half: float, centre: complex) -> Iterator[Box]:
    """Go through the places of a text beside a vector: first those on its outer side."""
    length = abs(tip - tail)
    normal = (tip - tail) * 1j * (1.0 / length) if length else 1j
    outward = (0.5 * (tail + tip) - centre) * normal.conjugate()
    for side in (1.0, -1.0) if outward.real >= 0.0 else (-1.0, 1.0):
        away = side * normal * (GAP + abs(normal.real) * half + abs(normal.imag) * 0.5 * HEIGHT)
        for place in PLACES:
            yield Box(tail + (tip - tail) * place + away, half)
