"""Guides of the frame: on which side of its slider a guide lies, and in which pieces, so that no link crosses it."""

from __future__ import annotations

from ....plans.board import POSITION
from ....plans.linkages.mechanism import Prismatic
from ...symbols import slider_up
from ..scene import Scene
from ..skeleton import Stroke, block_size, guide_of, skeleton

LONG = 1.1  # half the length of a guide in lengths of its slider
BESIDE = 0.75  # lengths of the slider beyond an end of the guide where a link would still pass close to the hatching


def guide_up(scene: Scene, pair: Prismatic) -> complex:
    """Return the side of a slider that is free of its guide: that to which the links go which leave the slider."""
    length, _ = block_size(scene, pair)
    usual, reach = slider_up(guide_of(scene, pair)), (LONG + BESIDE) * length

    def crossed(up: complex) -> int:
        return len(_crossings(scene, pair, up, (-reach, reach)))

    return -usual if crossed(-usual) < crossed(usual) else usual


def guide_pieces(scene: Scene, pair: Prismatic, up: complex, whole: bool = False) -> tuple[Stroke, ...]:
    """Return the lines of a guide, mm: one, or several with room between them for the links that pass.

    It is a little longer than the slider; a `whole` one is so all along the slider's way.
    """
    at, u, (length, height) = scene.mm(pair.point), guide_of(scene, pair), block_size(scene, pair)
    stroke, pitch = scene.style.hatch
    per_mm = 1.0 / scene.scales[POSITION].mu
    low, high = scene.runs.get(scene.solved.guide_name(pair), (0.0, 0.0)) if whole else (0.0, 0.0)
    ends, foot = (low * per_mm - LONG * length, high * per_mm + LONG * length), at - up * (height / 2)
    stops = [ends[0]]
    for first, last in sorted(_crossings(scene, pair, up, ends)):
        # strokes of the hatching lean out by less than their length
        stops += [first - stroke, max(last + stroke, stops[-1])]
    stops.append(ends[1])
    parts = zip(stops[::2], stops[1::2], strict=True)
    return tuple((foot + u * start, foot + u * end) for start, end in parts if end - start > 2 * pitch)


def _crossings(scene: Scene, pair: Prismatic, up: complex, ends: tuple[float, float]) -> list[tuple[float, float]]:
    """Return where along a guide, between `ends`, lines of links cross the band of its hatching, mm from its point."""
    at, u, (_, height) = scene.mm(pair.point), guide_of(scene, pair), block_size(scene, pair)
    edges = height / 2, height / 2 + scene.style.hatch[0]
    found = []
    for link in scene.solved.mechanism.links:
        for line in skeleton(scene, link.number).strokes:
            # along the guide, and away from the slider
            (x0, d0), (x1, d1) = (((p - at) * u.conjugate(), (p - at) * -up.conjugate()) for p in line)
            places = [
                x0.real + (x1 - x0).real * (edge - d0.real) / (d1 - d0).real
                for edge in edges
                if (d0.real - edge) * (d1.real - edge) < 0
            ]
            inside = [x for x in places if ends[0] <= x <= ends[1]]
            if inside:
                found.append((min(inside), max(inside)))
    return found
