"""What the figure of a link is made of: its pins, blocks and guides, the lines that join them, its rigid corners."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import NamedTuple

from ...plans.linkages.mechanism import FRAME, Pair, Prismatic, Revolute
from .scene import Scene

NEAR = 0.02  # mm: points so near to one another, or to a line, coincide on the drawing
ON_LINK, INNER, OUTER = 0.88, 0.75, 1.6  # parts of a slider on the frame: blocks on links, and two on one pin
Stroke = tuple[complex, complex]


class Block(NamedTuple):
    """A block: its centre, unit direction, length and height."""

    at: complex
    u: complex
    size: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Skeleton:
    """The figure of a link, mm: `pins` and centres of `blocks`, main lines between them, corners that do not turn.

    `guides` are the lines on which other links slide, `bars` all others; both end at pins, blocks or corners. A corner
    is a vertex with the unit directions of its two sides; two opposite ones are those of a line that runs through.
    """

    number: int
    pins: tuple[complex, ...]
    blocks: tuple[Block, ...]
    guides: tuple[Stroke, ...]
    bars: tuple[Stroke, ...]
    corners: tuple[tuple[complex, complex, complex], ...]

    @property
    def nodes(self) -> tuple[complex, ...]:
        """Its pins and the centres of its blocks."""
        return (*self.pins, *(block.at for block in self.blocks))

    @property
    def strokes(self) -> tuple[Stroke, ...]:
        """All its lines."""
        return self.guides + self.bars


def pairs_of(scene: Scene, number: int) -> tuple[Pair, ...]:
    """Return the pairs in which a link takes part."""
    return tuple(pair for pair in scene.mechanism.pairs if number in pair.links)


def pins_of(scene: Scene, number: int) -> tuple[str, ...]:
    """Return the letters of the revolute pairs of a link, each once."""
    pairs = pairs_of(scene, number)
    return tuple(dict.fromkeys(pair.point for pair in pairs if isinstance(pair, Revolute)))


def guide_of(scene: Scene, pair: Prismatic) -> complex:
    """Return the unit direction of a pair's guide."""
    return scene.solved.point(scene.solved.guide_name(pair))


def skeleton(scene: Scene, number: int) -> Skeleton:
    """Return the figure of a moving link, which is asked for wherever something must keep clear of the link."""
    if number not in scene.skeletons:
        scene.skeletons[number] = _skeleton(scene, number)
    return scene.skeletons[number]


def _skeleton(scene: Scene, number: int) -> Skeleton:
    """Find the figure of a moving link from the points that it has."""
    sliding = [pair for pair in pairs_of(scene, number) if isinstance(pair, Prismatic)]
    pins = [scene.mm(point) for point in pins_of(scene, number)]
    own = [p for p in sliding if p.links[0] == number]
    blocks = tuple(Block(scene.mm(p.point), guide_of(scene, p), block_size(scene, p)) for p in own)
    rails = [_rail(scene, pair) for pair in sliding if pair.links[1] == number]
    link = scene.mechanism.link(number)
    nodes = [*pins, *(block.at for block in blocks)]
    nodes += [scene.mm(point) for point in link.points if point != link.centre]
    nodes = _apart(nodes)
    if rails:
        guides, bars, corners = _on_rails(rails, nodes)
    else:
        held = [point for point in pins_of(scene, number) if point in scene.mechanism.frame_points]
        guides, (bars, corners) = (), _between(nodes, scene.mm(held[0]) if held else None)
    corners = (*corners, *_through(pins, (*guides, *bars)), *_on_blocks(blocks, (*guides, *bars)))
    return Skeleton(number, tuple(_apart(pins)), blocks, guides, bars, corners)


def block_size(scene: Scene, pair: Prismatic) -> tuple[float, float]:
    """Return length and height of a block: on a moving link a little smaller; of two on one pin the first is larger."""
    others = [p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and p.links[0] != pair.links[0]]
    shared = [p for p in others if abs(scene.mm(p.point) - scene.mm(pair.point)) < NEAR]
    rank = [FRAME not in pair.links, pair.links[0]]
    part = ON_LINK if FRAME not in pair.links else 1.0
    if shared:
        inner = any([FRAME not in p.links, p.links[0]] < rank for p in shared)
        part = INNER if inner else OUTER
    length, height = scene.style.slider
    return part * length, part * height


def _rail(scene: Scene, pair: Prismatic) -> Stroke:
    """Return the line along which the slider runs on a moving link, longer at both ends than the slider's way."""
    at, u = scene.mm(pair.point), guide_of(scene, pair)
    low, high = scene.runs.get(scene.solved.guide_name(pair), (0.0, 0.0))
    per_mm, spare = 1.0 / scene.scales["position"].mu, 0.75 * scene.style.slider[0]
    return at + u * (low * per_mm - spare), at + u * (high * per_mm + spare)


def _apart(nodes: list[complex]) -> list[complex]:
    """Leave out nodes that coincide with earlier ones."""
    found: list[complex] = []
    for node in nodes:
        if all(abs(node - other) > NEAR for other in found):
            found.append(node)
    return found


Corner = tuple[complex, complex, complex]
Parts = tuple[tuple[Stroke, ...], tuple[Corner, ...]]


def _between(nodes: list[complex], pivot: complex | None) -> Parts:
    """Join the nodes of a link without guides: a line, a lever with arms from its pivot, or a closed figure."""
    if len(nodes) < 2:
        return (), ()
    a, b = max(combinations(nodes, 2), key=lambda ends: abs(ends[1] - ends[0]))
    if all(_aside(a, b, node) < NEAR for node in nodes):
        return ((a, b),), ()
    if pivot is not None:
        return _arms(pivot, nodes)
    ring = _hull(nodes)
    inside = [node for node in nodes if min(_aside(p, q, node) for p, q in _sides(ring)) > NEAR]
    ties = tuple((node, min(ring, key=lambda corner: abs(corner - node))) for node in inside)
    corners = tuple(
        (at, _unit(before - at), _unit(after - at))
        for before, at, after in zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1], strict=True)
    )
    return (*_sides(ring), *ties), corners


def _arms(pivot: complex, nodes: list[complex]) -> Parts:
    """Join a pivot with all others; nodes on one ray share an arm."""
    ends: list[complex] = []
    for node in sorted((n for n in nodes if abs(n - pivot) > NEAR), key=lambda n: -abs(n - pivot)):
        if all(_aside(pivot, end, node) > NEAR or ((node - pivot) / (end - pivot)).real < 0 for end in ends):
            ends.append(node)
    rays = sorted((_unit(end - pivot) for end in ends), key=cmath.phase)
    pairs = list(pairwise(rays)) + ([(rays[-1], rays[0])] if len(rays) > 2 else [])
    corners = tuple((pivot, u, w) for u, w in pairs if abs((u.conjugate() * w).imag) > 1e-6)
    return tuple((pivot, end) for end in ends), corners


def _on_rails(
    rails: list[Stroke], nodes: list[complex]
) -> tuple[tuple[Stroke, ...], tuple[Stroke, ...], tuple[Corner, ...]]:
    """Join the nodes of a link with its first guide, those beside it square to it or to a pin on it; tie the others."""
    (low, high), others = rails[0], rails[1:]
    u = _unit(high - low)
    on_line = [node for node in nodes if abs(((node - low) / u).imag) < NEAR]
    reach = [((node - low) / u).real for node in on_line]
    ends = [0.0, abs(high - low), *reach]
    bars, corners = [], []
    for node in (n for n in nodes if n not in on_line):
        foot = low + u * ((node - low) / u).real
        root = min(on_line, key=lambda pin: abs(pin - node)) if on_line else foot
        ends.append(((root - low) / u).real)
        bars.append((node, root))
        corners.append((root, _unit(node - root), u if ends[-1] < abs(high - low) / 2 else -u))
    for start, end in others:
        bars.append((nearest(start, end, low), nearest(low, high, start)))
    first = (low + u * min(ends), low + u * max(ends))
    return (first, *others), tuple(bar for bar in bars if abs(bar[1] - bar[0]) > NEAR), tuple(corners)


def _through(pins: list[complex], strokes: tuple[Stroke, ...]) -> tuple[Corner, ...]:
    """Return as corners of 180 degrees the pins through which a line of the link runs."""
    found = []
    for at in _apart(pins):
        found += [(at, u, w) for u, w in combinations(rays_of(at, strokes), 2) if abs(u + w) < 1e-4][:1]
    return tuple(found)


def _on_blocks(blocks: Iterable[Block], strokes: Sequence[Stroke]) -> Iterator[Corner]:
    """Go through the corners between a block and each line of its own link that leaves it."""
    for at, u, size in blocks:
        for e in rays_of(at, strokes):
            rim = rim_of(u, size, e)
            along = 1j * u if abs((e / u).real) * rim > 0.999 * size[0] / 2 else u  # the edge at which it leaves
            yield at + e * rim, e, along if (along / e).real >= 0 else -along


def rim_of(u: complex, size: tuple[float, float], e: complex) -> float:
    """Return how far from its centre the edge of a block along `u` is, along `e`."""
    along, across = abs((e / u).real), abs((e / u).imag)
    return min(size[0] / 2 / max(along, 1e-9), size[1] / 2 / max(across, 1e-9))


def _on(stroke: Stroke, at: complex) -> bool:
    a, b = stroke
    return abs(a - at) + abs(b - at) - abs(b - a) < NEAR


def _hull(nodes: list[complex]) -> list[complex]:
    """Return the corners of the convex hull, counter-clockwise."""
    ordered = sorted(nodes, key=lambda node: (node.real, node.imag))

    def chain(points: list[complex]) -> list[complex]:
        kept: list[complex] = []
        for point in points:
            while len(kept) > 1 and ((kept[-1] - kept[-2]).conjugate() * (point - kept[-2])).imag <= 1e-9:
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return chain(ordered) + chain(ordered[::-1])


def _sides(ring: list[complex]) -> tuple[Stroke, ...]:
    return tuple(zip(ring, ring[1:] + ring[:1], strict=True))


def _unit(way: complex) -> complex:
    return way / abs(way)


def _aside(a: complex, b: complex, point: complex) -> float:
    """Return the distance of a point from the line a-b."""
    return abs(((point - a) / _unit(b - a)).imag)


def nearest(a: complex, b: complex, point: complex) -> complex:
    """Return the point of the line from a to b nearest to a point."""
    along = ((point - a) / (b - a)).real
    return a + (b - a) * min(max(along, 0.0), 1.0)


def rays_of(at: complex, strokes: Iterable[Stroke]) -> list[complex]:
    """Return the unit directions in which lines leave a place."""
    through = [stroke for stroke in strokes if _on(stroke, at)]
    return [_unit(end - at) for stroke in through for end in stroke if abs(end - at) > NEAR]


def is_inside(ring: Sequence[complex], point: complex) -> bool:
    """Tell whether a point lies within a convex figure whose corners go counter-clockwise."""
    return all(((b - a).conjugate() * (point - a)).imag > 0 for a, b in _sides(list(ring)))


def spread_of(u: complex, w: complex) -> float:
    """Return the angle between two unit directions, radians."""
    return abs(math.remainder(cmath.phase(w / u), 2 * math.pi))


def room_beside(u: complex, rays: Iterable[complex]) -> float:
    """Return the least angle between a direction and any of these, radians."""
    return min((spread_of(u, ray) for ray in rays), default=math.pi)
