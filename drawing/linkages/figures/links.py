"""Links drawn to scale: what the figure of a link is made of, and how any view of a mechanism draws it.

figures = draw_links(canvas, scene, numbers)      # all lines, blocks and pins of these links
draw_frame(canvas, scene, numbers, figures)       # the pivots on which they turn, where the frame belongs
letter_links(canvas, scene, figures)              # joints, centres of mass and numbers, each once
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import NamedTuple

from ....plans.linkages.mechanism import FRAME, Prismatic, Revolute
from ....plans.names import role
from ...figure import GIVEN
from ...shapes import Group, Line, Pen
from ...symbols import block, bridge, centre_of_mass, fixed_pivot, guide, revolute, rigid_corner, slider_up, unit
from ...view import Canvas
from ..scene import Scene

NEAR = 0.02  # mm: points so near to one another, or to a line, coincide on the drawing
SPARE = 0.75  # lengths of a slider by which the line on which it runs is longer at both ends
ON_LINK, INNER, OUTER = 0.88, 0.75, 1.6  # parts of a slider on the frame: blocks on links, and two on one pin
Stroke = tuple[complex, complex]
Corner = tuple[complex, complex, complex]  # a vertex, the directions of its sides
Parts = tuple[tuple[Stroke, ...], tuple[Corner, ...]]
STRAIGHT = math.radians(179.0)
DOWN = (-1j, -1 + 0j, 1 + 0j, 1j)  # where the foot of a pivot may stand, the usual place first
ROOM = math.radians(35.0)  # between the foot of a pivot and a link
LONG = 1.1  # half the length of a guide in lengths of its slider
BESIDE = 0.75  # lengths of the slider beyond an end of the guide where a link would still pass close to the hatching


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
    corners: tuple[Corner, ...]

    @property
    def nodes(self) -> tuple[complex, ...]:
        """Its pins and the centres of its blocks."""
        return (*self.pins, *(block.at for block in self.blocks))

    @property
    def strokes(self) -> tuple[Stroke, ...]:
        """All its lines."""
        return self.guides + self.bars


def pins_of(scene: Scene, number: int) -> tuple[str, ...]:
    """Return the letters of the revolute pairs of a link, each once."""
    pairs = (pair for pair in scene.mechanism.pairs if isinstance(pair, Revolute) and number in pair.links)
    return tuple(dict.fromkeys(pair.point for pair in pairs))


def sliding(scene: Scene, number: int, guide: bool = False) -> list[Prismatic]:
    """Return the pairs whose block is that of a link, or whose `guide` is."""
    return [pair for pair in scene.mechanism.pairs if isinstance(pair, Prismatic) and pair.links[guide] == number]


def guide_of(scene: Scene, pair: Prismatic) -> complex:
    """Return the unit direction of a pair's guide."""
    return scene.solved.point(scene.solved.guide_name(pair))


def skeleton(scene: Scene, number: int) -> Skeleton:
    """Return the figure of a moving link, which is asked for wherever something must keep clear of the link."""
    if number not in scene.skeletons:
        scene.skeletons[number] = _skeleton(scene, number)
    return scene.skeletons[number]


def _skeleton(scene: Scene, number: int) -> Skeleton:
    pins, link = [scene.mm(point) for point in pins_of(scene, number)], scene.mechanism.link(number)
    blocks = tuple(Block(scene.mm(p.point), guide_of(scene, p), block_size(scene, p)) for p in sliding(scene, number))
    rails = [_rail(scene, pair) for pair in sliding(scene, number, guide=True)]
    others = (scene.mm(point) for point in link.points if point != link.centre)
    nodes = _apart([*pins, *(block.at for block in blocks), *others])
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
    part, rank = ON_LINK if FRAME not in pair.links else 1.0, (FRAME not in pair.links, pair.links[0])
    if shared:
        part = INNER if any((FRAME not in p.links, p.links[0]) < rank for p in shared) else OUTER
    length, height = scene.style.slider
    return part * length, part * height


def _rail(scene: Scene, pair: Prismatic) -> Stroke:
    """Return the line along which the slider runs on a moving link, longer at both ends than the slider's way."""
    at, u, spare = scene.mm(pair.point), guide_of(scene, pair), SPARE * scene.style.slider[0]
    low, high = scene.run_of(pair)
    return at + u * (low - spare), at + u * (high + spare)


def _apart(nodes: list[complex]) -> list[complex]:
    found: list[complex] = []
    for node in nodes:
        found += [node] if all(abs(node - other) > NEAR for other in found) else []
    return found


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
    turns = zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1], strict=True)
    return (*_sides(ring), *ties), tuple((at, unit(a - at), unit(b - at)) for a, at, b in turns)


def _arms(pivot: complex, nodes: list[complex]) -> Parts:
    """Join a pivot with all others; nodes on one ray share an arm."""
    ends: list[complex] = []
    for node in sorted((n for n in nodes if abs(n - pivot) > NEAR), key=lambda n: -abs(n - pivot)):
        if all(_aside(pivot, end, node) > NEAR or ((node - pivot) / (end - pivot)).real < 0 for end in ends):
            ends.append(node)
    rays = sorted((unit(end - pivot) for end in ends), key=cmath.phase)
    pairs = pairwise([*rays, *rays[: len(rays) > 2]])
    corners = tuple((pivot, u, w) for u, w in pairs if abs((u.conjugate() * w).imag) > 1e-6)
    return tuple((pivot, end) for end in ends), corners


def _on_rails(rails: list[Stroke], nodes: list[complex]) -> tuple[tuple[Stroke, ...], *Parts]:
    """Join the nodes of a link with its first guide, those beside it square to it or to a pin on it; tie the others."""
    (low, high), others = rails[0], rails[1:]
    u = unit(high - low)
    on_line = [node for node in nodes if abs(((node - low) / u).imag) < NEAR]
    ends = [0.0, abs(high - low), *(((node - low) / u).real for node in on_line)]
    bars, corners = [], []
    for node in (n for n in nodes if n not in on_line):
        foot = low + u * ((node - low) / u).real
        root = min(on_line, key=lambda pin: abs(pin - node)) if on_line else foot
        ends.append(((root - low) / u).real)
        bars.append((node, root))
        corners.append((root, unit(node - root), u if ends[-1] < abs(high - low) / 2 else -u))
    bars += [(nearest(start, end, low), nearest(low, high, start)) for start, end in others]
    first = (low + u * min(ends), low + u * max(ends))
    return (first, *others), tuple(bar for bar in bars if abs(bar[1] - bar[0]) > NEAR), tuple(corners)


def _through(pins: list[complex], strokes: tuple[Stroke, ...]) -> tuple[Corner, ...]:
    """Return as corners of 180 degrees the pins through which a line of the link runs."""
    both = ([(at, u, w) for u, w in combinations(rays_of(at, strokes), 2) if abs(u + w) < 1e-4] for at in _apart(pins))
    return tuple(corner for corners in both for corner in corners[:1])


def _on_blocks(blocks: Iterable[Block], strokes: Sequence[Stroke]) -> Iterator[Corner]:
    for at, u, size in blocks:
        for e in rays_of(at, strokes):
            rim = rim_of(u, size, e)
            along = 1j * u if abs((e / u).real) * rim > 0.999 * size[0] / 2 else u  # the edge at which it leaves
            yield at + e * rim, e, along if (along / e).real >= 0 else -along


def rim_of(u: complex, size: tuple[float, float], e: complex) -> float:
    """Return how far from its centre the edge of a block along `u` is, along `e`."""
    along, across = abs((e / u).real), abs((e / u).imag)
    return min(size[0] / 2 / max(along, 1e-9), size[1] / 2 / max(across, 1e-9))


def _hull(nodes: list[complex]) -> list[complex]:
    ordered = sorted(nodes, key=lambda node: (node.real, node.imag))

    def chain(points: list[complex]) -> list[complex]:
        kept: list[complex] = []
        for point in points:
            while len(kept) > 1 and ((kept[-1] - kept[-2]).conjugate() * (point - kept[-2])).imag <= 1e-9:
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return chain(ordered) + chain(ordered[::-1])


def _sides(ring: Sequence[complex]) -> tuple[Stroke, ...]:
    return tuple(pairwise([*ring, ring[0]]))


def _aside(a: complex, b: complex, point: complex) -> float:
    return abs(((point - a) / unit(b - a)).imag)


def nearest(a: complex, b: complex, point: complex) -> complex:
    """Return the point of the line from a to b nearest to a point."""
    along = ((point - a) / (b - a)).real
    return a + (b - a) * min(max(along, 0.0), 1.0)


def rays_of(at: complex, strokes: Iterable[Stroke]) -> list[complex]:
    """Return the unit directions in which lines leave a place."""
    through = ((a, b) for a, b in strokes if abs(a - at) + abs(b - at) - abs(b - a) < NEAR)
    return [unit(end - at) for stroke in through for end in stroke if abs(end - at) > NEAR]


def is_inside(ring: Sequence[complex], point: complex) -> bool:
    """Tell whether a point lies within a convex figure whose corners go counter-clockwise."""
    return all(((b - a).conjugate() * (point - a)).imag > 0 for a, b in _sides(ring))


def spread_of(u: complex, w: complex) -> float:
    """Return the angle between two unit directions, radians."""
    return abs(math.remainder(cmath.phase(w / u), math.tau))


def room_beside(u: complex, rays: Iterable[complex]) -> float:
    """Return the least angle between a direction and any of these, radians."""
    return min((spread_of(u, ray) for ray in rays), default=math.pi)


def draw_links(
    canvas: Canvas, scene: Scene, numbers: Sequence[int], framed: bool = True, whole: bool = False
) -> list[Skeleton]:
    """Draw moving links: guides under blocks, all other lines over them, pins on top; return their figures.

    `framed` says whether the guides of the frame are drawn under the sliders that run on them, `whole` whether as long
    as the way of the sliders.
    """
    figures = [skeleton(scene, number) for number in numbers]
    for figure in figures:
        _strokes(canvas, scene, figure, figure.guides)
    blocks = [drawn for figure in figures for drawn in _blocks(scene, figure, framed, whole)]
    for _, stage, shapes in sorted(blocks, key=lambda drawn: -drawn[0]):
        canvas.part(stage)
        canvas.add(*shapes)
    for figure in figures:
        _strokes(canvas, scene, figure, figure.bars)
        for at, u, w in figure.corners:
            if spread_of(u, w) > STRAIGHT:
                rays = rays_at(at, figures)  # the arc over a pin stands where no other link leaves the pin
                up = u if room_beside(1j * u, rays) >= room_beside(-1j * u, rays) else -u
                canvas.add(bridge(at, up, scene.style))
            else:
                canvas.add(rigid_corner(at, u, w, scene.style, pin=_is_in(at, figure.pins)))
    pins = dict.fromkeys(point for number in numbers for point in pins_of(scene, number))
    held = scene.mechanism.frame_points if framed else ()
    for point in (point for point in pins if point not in held):
        canvas.part(point)
        canvas.add(revolute(scene.mm(point), point, scene.style))
    return figures


def drawn_with(scene: Scene, figure: Skeleton) -> str:
    """Return the step with which a link is drawn: that of its last point."""
    return scene.last(scene.mechanism.link(figure.number).points)


def _strokes(canvas: Canvas, scene: Scene, figure: Skeleton, strokes: Iterable[Stroke]) -> None:
    canvas.part(drawn_with(scene, figure))
    lines = tuple(Line(*part, Pen.MAIN) for stroke in strokes for part in _parts(scene, figure, stroke))
    if lines:
        canvas.add(Group(lines, "link", str(figure.number)))


def _parts(scene: Scene, figure: Skeleton, stroke: Stroke) -> Iterator[Stroke]:
    a, b = stroke
    e = (b - a) / abs(b - a)
    inside = [pin for pin in figure.pins if abs(((pin - a) / e).imag) < NEAR and 0 < ((pin - a) / e).real < abs(b - a)]
    for start, end in pairwise([a, *sorted(inside, key=lambda pin: abs(pin - a)), b]):
        first, last = _rim(scene, figure, start, e), _rim(scene, figure, end, -e)
        if abs(end - start) > first + last:
            yield start + e * first, end - e * last


def _rim(scene: Scene, figure: Skeleton, end: complex, e: complex) -> float:
    if _is_in(end, figure.pins):
        return scene.style.pair
    return next((rim_of(u, size, e) for at, u, size in figure.blocks if abs(at - end) < NEAR), 0.0)


def _is_in(at: complex, places: Iterable[complex]) -> bool:
    return any(abs(at - place) < NEAR for place in places)


def _blocks(scene: Scene, figure: Skeleton, framed: bool, whole: bool) -> Iterator[tuple[float, str, list[Group]]]:
    """Go through the blocks of a link, each with its length and its step; under a slider is the guide of the frame."""
    name = str(figure.number)
    for pair, (at, u, size) in zip(sliding(scene, figure.number), figure.blocks, strict=True):
        shapes = [block(at, u, name, size)]
        if pair.links[1] == FRAME and framed:
            up = guide_up(scene, pair)
            shapes.insert(0, guide(guide_pieces(scene, pair, up, whole), up, name, scene.style))
        yield size[0], drawn_with(scene, figure), shapes


def rays_at(at: complex, figures: Iterable[Skeleton]) -> list[complex]:
    """Return the unit directions in which lines of links leave a place."""
    return rays_of(at, (stroke for figure in figures for stroke in figure.strokes))


def draw_frame(canvas: Canvas, scene: Scene, numbers: Iterable[int], figures: Sequence[Skeleton]) -> None:
    """Draw the pivots on the frame of these links, each with its foot where no link is in the way."""
    wanted, before = set(numbers), canvas.part(GIVEN)
    pairs = [p for p in scene.mechanism.pairs if isinstance(p, Revolute) and FRAME in p.links]
    for point in dict.fromkeys(pair.point for pair in pairs if wanted & set(pair.links)):
        at, down = scene.mm(point), foot_of(scene, point, figures)
        canvas.add(fixed_pivot(at, point, scene.style, down))
        _, height, base = scene.style.pivot
        far = at + down * (height + scene.style.pair + scene.style.hatch[0])
        canvas.keep_clear(at - down * 1j * (base / 2), far + down * 1j * (base / 2))
    canvas.part(before)


def foot_of(scene: Scene, point: str, figures: Sequence[Skeleton]) -> complex:
    """Return the side on which the foot of a pivot stands: below, unless a link or another pivot is there."""
    at = scene.mm(point)
    rays = rays_at(at, figures)
    others = [scene.mm(other) - at for other in scene.mechanism.frame_points]
    rays += [way / abs(way) for way in others if NEAR < abs(way) < 2 * scene.style.pivot[2]]
    return max(DOWN, key=lambda down: (room_beside(down, rays) >= ROOM, -DOWN.index(down)))


def coincident(scene: Scene) -> dict[str, tuple[int, ...]]:
    """Return the joints at which points of several links have marks of their own, `velocity.A3`, with these links."""
    mechanism, found = scene.mechanism, dict[str, set[int]]()
    letters = {point for link in mechanism.links for point in link.points}
    for step in scene.program.on("velocity"):
        under = role(role(step.name).of)
        if step.verb != "read" and under.links and under.of in letters and under not in letters:
            found.setdefault(under.of, set()).update(under.links)
    for point, numbers in found.items():
        numbers.update(n for p in mechanism.pairs if isinstance(p, Revolute) and p.point == point for n in p.links)
    return {point: tuple(sorted(numbers - {FRAME})) for point, numbers in found.items()}


def letter_links(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Draw centres of mass and other lettered points, and letter joints, points and links, each once."""
    several, first = coincident(scene), dict[str, Skeleton]()
    for own in figures:
        for point in scene.mechanism.link(own.number).points:
            first.setdefault(point, own)
    for point, figure in first.items():
        canvas.part(point)
        joints = (*pins_of(scene, figure.number), *(pair.point for pair in sliding(scene, figure.number)))
        if point in joints:
            links = ",".join(map(str, several.get(point, ())))
            mark = f"{point}_{{{links}}}" if links else scene.words.mark(point)
            _letter_joint(canvas, scene, point, mark, figures)
        else:
            _letter_point(canvas, scene, figure, point)
    for figure in figures:
        canvas.part(drawn_with(scene, figure))
        _number(canvas, scene, figure, figures)


def _letter_joint(canvas: Canvas, scene: Scene, point: str, mark: str, figures: Sequence[Skeleton]) -> None:
    """Letter a joint; in a block beside its free edge, for lines and arrows leave no room at the pin itself."""
    at = scene.mm(point)
    if not any(point in pins_of(scene, figure.number) for figure in figures):
        canvas.add(scene.point(at, point))
    around = [(size, u, figure) for figure in figures for c, u, size in figure.blocks if abs(c - at) < NEAR]
    if not around:
        canvas.label(mark, at, clear=scene.style.pair + 0.8)
        return
    (length, height), u, figure = max(around, key=lambda one: one[0])
    up, half = _up(scene, figure.number, at, u, figures), u * (length / 2)
    edge = at + up * (height / 2)
    canvas.label(mark, (edge - half, edge + half), clear=1.0, prefer=up, priority=1)


def _up(scene: Scene, number: int, at: complex, u: complex, figures: Sequence[Skeleton]) -> complex:
    """Return the side of a block for its letter: away from the frame's guide, or from lines that leave it."""
    on_frame = next((pair for pair in sliding(scene, number) if pair.links[1] == FRAME), None)
    if on_frame is not None:
        return guide_up(scene, on_frame)
    rays = rays_at(at, figures)
    return max((slider_up(u), -slider_up(u)), key=lambda side: round(room_beside(side, rays), 3))


def _letter_point(canvas: Canvas, scene: Scene, figure: Skeleton, point: str) -> None:
    at, style, number = scene.mm(point), scene.style, figure.number
    if any(abs(at - scene.mm(pin)) < style.pair for pin in pins_of(scene, number)):
        return
    if point == scene.mechanism.link(number).centre:
        canvas.add(*_tie(scene, at, figure), centre_of_mass(at, point, style))
    else:
        canvas.add(scene.point(at, point))
    canvas.label(scene.words.mark(point), at, clear=style.centre + 0.8)


def _tie(scene: Scene, at: complex, figure: Skeleton) -> Iterator[Line]:
    foot = min((*(nearest(*s, at) for s in figure.strokes), *figure.nodes), key=lambda foot: abs(foot - at))
    inside = len(figure.bars) > 2 and is_inside([a for a, _ in figure.bars], at)
    reach, e = abs(foot - at), (at - foot) / (abs(foot - at) or 1.0)
    start = _rim(scene, figure, foot, e)
    if reach > start + scene.style.centre and not inside:
        yield Line(foot + e * start, at - e * scene.style.centre, Pen.THIN, role="tie")


def _number(canvas: Canvas, scene: Scene, figure: Skeleton, figures: Sequence[Skeleton]) -> None:
    """Number a link beside its longest free piece of line, or beside its block."""
    pieces = [piece for stroke in figure.strokes for piece in _pieces(stroke, figures)]
    if pieces:
        a, b = max(pieces, key=lambda piece: round(abs(piece[1] - piece[0]), 3))
        canvas.label(str(figure.number), (a, b), clear=0.8)
    elif figure.blocks:
        at, u, (length, height) = figure.blocks[0]
        up, half = _up(scene, figure.number, at, u, figures), length / 2
        away = [ray for ray in rays_at(at, figures) if abs((ray / u).real) > 0.1]
        far = u * half if sum((ray / u).real for ray in away) <= 0 else -u * half
        canvas.label(str(figure.number), at + up * (height / 2) + far, clear=0.8, prefer=up)


def _pieces(stroke: Stroke, figures: Sequence[Skeleton]) -> Iterator[Stroke]:
    a, b = stroke
    e, reach = (b - a) / abs(b - a), abs(b - a)
    marks = [at for figure in figures for at in figure.nodes]
    along = [((at - a) / e).real for at in marks if abs(((at - a) / e).imag) < NEAR]
    stops = sorted({0.0, reach, *(k for k in along if 0 < k < reach)})
    return ((a + e * low, a + e * high) for low, high in pairwise(stops))


def guide_up(scene: Scene, pair: Prismatic) -> complex:
    """Return the side of a slider that is free of its guide: that to which the links go which leave the slider."""
    usual, reach = slider_up(guide_of(scene, pair)), (LONG + BESIDE) * block_size(scene, pair)[0]
    return min(usual, -usual, key=lambda up: len(_crossings(scene, pair, up, (-reach, reach))))


def guide_pieces(scene: Scene, pair: Prismatic, up: complex, whole: bool = False) -> tuple[Stroke, ...]:
    """Return the lines of a guide, mm: one, or several with room between them for the links that pass.

    It is a little longer than the slider; a `whole` one is so all along the slider's way.
    """
    at, u, (length, height) = scene.mm(pair.point), guide_of(scene, pair), block_size(scene, pair)
    (stroke, pitch), (low, high) = scene.style.hatch, scene.run_of(pair) if whole else (0.0, 0.0)
    ends, foot = (low - LONG * length, high + LONG * length), at - up * (height / 2)
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
    for link in scene.mechanism.links:
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
