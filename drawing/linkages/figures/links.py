"""Links drawn to scale: what the figure of a link is made of, and how any view of a mechanism draws it.

figures = draw_links(canvas, scene, numbers)      # all lines, blocks and pins of these links, pivots and guides
letter_links(canvas, scene, figures)              # joints, centres of mass and numbers, each once
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import NamedTuple

from ....plans.linkages.mechanism import FRAME, Driver, Prismatic, Revolute
from ....plans.names import role
from ...areas import clipped
from ...figure import GIVEN
from ...shapes import Arc, Circle, Group, Line, Pen
from ...symbols import block, fixed_pivot, guide, revolute, rigid_corner, slider_up, unit
from ...view import Canvas
from ..scene import Scene

NEAR = 0.02  # mm: points so near to one another, or to a line, coincide on the drawing
SPARE = 0.75  # lengths of a slider by which the line on which it runs is longer at both ends
ON_LINK, INNER, OUTER = 0.88, 0.75, 1.6  # parts of a slider on the frame: blocks on links, and two on one pin
Stroke = tuple[complex, complex]
Corner = tuple[complex, complex, complex]  # a vertex, the directions of its sides
STRAIGHT = math.radians(179.0)
DOWN = (-1j, -1 + 0j, 1 + 0j, 1j)  # where the foot of a pivot may stand, the usual place first
ROOM = math.radians(35.0)  # between the foot of a pivot and a link
LONG = 1.1  # half the length of a guide in lengths of its slider
BESIDE = 0.75  # lengths of the slider beyond an end of the guide where a link would still pass close to the hatching


class _Block(NamedTuple):
    """A block: its centre, unit direction, length and height."""

    at: complex
    u: complex
    size: tuple[float, float]

    def rim(self, e: complex) -> float:
        """Return how far from its centre its edge is along `e`."""
        along, across = abs((e / self.u).real), abs((e / self.u).imag)
        return min(self.size[0] / 2 / max(along, 1e-9), self.size[1] / 2 / max(across, 1e-9))


@dataclass(frozen=True, slots=True)
class Skeleton:
    """The figure of a link, mm: `pins` and centres of `blocks`, main lines between them, corners that do not turn.

    `guides` are the lines on which other links slide, `bars` all others; both end at pins, blocks or corners. A corner
    is a vertex with the unit directions of its two sides; two opposite ones are those of a line that runs through.
    """

    number: int
    pins: Sequence[complex]
    blocks: Sequence[_Block]
    guides: Sequence[Stroke]
    bars: Sequence[Stroke]
    corners: Sequence[Corner]

    @property
    def nodes(self) -> list[complex]:
        """Its pins and the centres of its blocks."""
        return [*self.pins, *(block.at for block in self.blocks)]

    @property
    def strokes(self) -> list[Stroke]:
        """All its lines."""
        return [*self.guides, *self.bars]

    def rim(self, end: complex, e: complex) -> float:
        """Return how far from a node its lines begin, along `e`."""
        return next((block.rim(e) for block in self.blocks if abs(block.at - end) < NEAR), 0.0)


def pins_of(scene: Scene, number: int) -> tuple[str, ...]:
    """Return the letters of the revolute pairs of a link, each once."""
    return tuple(dict.fromkeys(pair.point for pair in scene.turning(number)))


def _sliding(scene: Scene, number: int, guide: bool = False) -> list[Prismatic]:
    """Return the pairs whose block is that of a link, or whose `guide` is."""
    return [pair for pair in scene.sliding(number) if pair.links[guide] == number]


def guide_of(scene: Scene, pair: Prismatic) -> complex:
    """Return the unit direction of a pair's guide."""
    return scene.solved.point(scene.solved.guide_name(pair))


def skeleton(scene: Scene, number: int) -> Skeleton:
    """Return the figure of a moving link, which is asked for wherever something must keep clear of the link."""
    known: dict[int, Skeleton] = scene.skeletons
    if number not in known:
        known[number] = _skeleton(scene, number)
    return known[number]


def _skeleton(scene: Scene, number: int) -> Skeleton:
    letters, link = pins_of(scene, number), scene.mechanism.link(number)
    pins, blocks = [scene.mm(point) for point in letters], [_block(scene, pair) for pair in _sliding(scene, number)]
    rails, spare = list[Stroke](), SPARE * scene.style.slider[0]
    for pair in _sliding(scene, number, guide=True):  # longer at both ends than the slider's way
        at, u, (low, high) = scene.mm(pair.point), guide_of(scene, pair), scene.run_of(pair)
        rails.append((at + u * (low - spare), at + u * (high + spare)))
    nodes = _apart([*pins, *(b.at for b in blocks), *(scene.mm(p) for p in link.points if p != link.centre)])
    joints = {*letters, *(point for point in link.points if point != link.centre)}
    # a triangle that similarity names has three sides; else a lever has but its arms
    triangle = any({*scene.reading.on_link(marks)} <= joints for marks in scene.reading.triangles("velocity"))
    still = (scene.mm(point) for point in letters if point in scene.mechanism.frame_points)
    held = None if triangle else next(still, None)
    guides, bars, corners = _on_rails(rails, nodes) if rails else ([], *_between(nodes, held))
    strokes = [*guides, *bars]
    for pin in _apart(pins):  # a line of the link that runs through is a corner of 180 degrees
        both = ((pin, u, w) for u, w in combinations(rays_of(pin, strokes), 2) if abs(u + w) < 1e-4)
        corners += [*both][:1]
    for own in blocks:
        for e in rays_of(own.at, strokes):
            rim, u = own.rim(e), own.u
            along = 1j * u if abs((e / u).real) * rim > 0.999 * own.size[0] / 2 else u  # the edge at which it leaves
            corners.append((own.at + e * rim, e, along if (along / e).real >= 0 else -along))
    return Skeleton(number, _apart(pins), blocks, guides, bars, corners)


def _block(scene: Scene, pair: Prismatic) -> _Block:
    """Return the block of a pair: on a moving link a little smaller; of two on one pin the first is larger."""
    others = [p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and p.links[0] != pair.links[0]]
    shared = [p for p in others if abs(scene.mm(p.point) - scene.mm(pair.point)) < NEAR]
    part, rank = ON_LINK if FRAME not in pair.links else 1.0, (FRAME not in pair.links, pair.links[0])
    if shared:
        part = INNER if any((FRAME not in p.links, p.links[0]) < rank for p in shared) else OUTER
    length, height = scene.style.slider
    return _Block(scene.mm(pair.point), guide_of(scene, pair), (part * length, part * height))


def _apart(nodes: list[complex]) -> list[complex]:
    kept: list[complex] = []
    for node in nodes:
        kept += [] if _is_in(node, kept) else [node]
    return kept


def _is_in(at: complex, places: Iterable[complex]) -> bool:
    return any(abs(at - place) <= NEAR for place in places)


def _between(nodes: list[complex], pivot: complex | None) -> tuple[list[Stroke], list[Corner]]:
    """Join the nodes of a link without guides: a line, a lever with arms from its pivot, or a closed figure."""
    if len(nodes) < 2:
        return [], []
    a, b = max(combinations(nodes, 2), key=lambda ends: abs(ends[1] - ends[0]))
    if all(_aside(a, b, node) < NEAR for node in nodes):
        return [(a, b)], []
    if pivot is not None:  # nodes on one ray share an arm
        ends: list[complex] = []
        for node in sorted((n for n in nodes if abs(n - pivot) > NEAR), key=lambda n: -abs(n - pivot)):
            if all(_aside(pivot, end, node) > NEAR or ((node - pivot) / (end - pivot)).real < 0 for end in ends):
                ends.append(node)
        rays = sorted((unit(end - pivot) for end in ends), key=cmath.phase)
        pairs = pairwise([*rays, *rays[: len(rays) > 2]])
        corners = [(pivot, u, w) for u, w in pairs if abs((u.conjugate() * w).imag) > 1e-6]
        return [(pivot, end) for end in ends], corners
    ordered = sorted(nodes, key=lambda node: (node.real, node.imag))
    ring = [*_chain(ordered), *_chain(ordered[::-1])]
    sides = [*pairwise([*ring, ring[0]])]
    inside = [node for node in nodes if min(_aside(p, q, node) for p, q in sides) > NEAR]
    ties = [(node, min(ring, key=lambda corner: abs(corner - node))) for node in inside]
    turns = zip(sides[-1:] + sides[:-1], sides, strict=True)
    return sides + ties, [(at, unit(a - at), unit(b - at)) for (a, at), (_, b) in turns]


def _chain(points: list[complex]) -> list[complex]:
    """Return the part of a convex figure about points to the right of the way from the first to the last of them."""
    kept: list[complex] = []
    for point in points:
        while len(kept) > 1 and ((kept[-1] - kept[-2]).conjugate() * (point - kept[-2])).imag <= 1e-9:
            kept.pop()
        kept.append(point)
    return kept[:-1]


def _on_rails(rails: list[Stroke], nodes: list[complex]) -> tuple[list[Stroke], list[Stroke], list[Corner]]:
    """Join the nodes of a link with its first guide, those beside it square to it or to a pin on it; tie the others."""
    (low, high), others = rails[0], rails[1:]
    u, reach = unit(high - low), abs(high - low)
    on_line = [node for node in nodes if abs(((node - low) / u).imag) < NEAR]
    ends = [0.0, reach, *(((node - low) / u).real for node in on_line)]
    bars, corners = list[Stroke](), list[Corner]()
    for node in (node for node in nodes if node not in on_line):
        foot = low + u * ((node - low) / u).real
        root = min(on_line, key=lambda pin: abs(pin - node)) if on_line else foot
        ends.append(((root - low) / u).real)
        bars.append((node, root))
        corners.append((root, unit(node - root), u if ends[-1] < reach / 2 else -u))
    bars += [(_nearest(start, end, low), _nearest(low, high, start)) for start, end in others]
    first = (low + u * min(ends), low + u * max(ends))
    return [first, *others], [bar for bar in bars if abs(bar[1] - bar[0]) > NEAR], corners


def _aside(a: complex, b: complex, point: complex) -> float:
    return abs(((point - a) / unit(b - a)).imag)


def _nearest(a: complex, b: complex, point: complex) -> complex:
    """Return the point of the line from a to b nearest to a point."""
    return a + (b - a) * min(max(((point - a) / (b - a)).real, 0.0), 1.0)


def rays_of(at: complex, strokes: Iterable[Stroke]) -> list[complex]:
    """Return the unit directions in which lines leave a place."""
    through = ((a, b) for a, b in strokes if abs(a - at) + abs(b - at) - abs(b - a) < NEAR)
    return [unit(end - at) for stroke in through for end in stroke if abs(end - at) > NEAR]


def rays_at(at: complex, figures: Iterable[Skeleton]) -> list[complex]:
    """Return the unit directions in which lines of links leave a place."""
    return rays_of(at, (stroke for figure in figures for stroke in figure.strokes))


def _room(u: complex, rays: Iterable[complex]) -> float:
    """Return the least angle between a direction and any of these, radians."""
    return min((abs(math.remainder(cmath.phase(ray / u), math.tau)) for ray in rays), default=math.pi)


def draw_links(
    canvas: Canvas, scene: Scene, numbers: Sequence[int], framed: bool = True, whole: bool = False
) -> list[Skeleton]:
    """Draw moving links: guides under blocks, all other lines over them, pins on top; return their figures.

    `framed` says whether the frame is drawn where they turn and slide on it, `whole` whether its guides are as long as
    the way of the sliders.
    """
    figures = [skeleton(scene, number) for number in numbers]
    for figure in figures:
        _strokes(canvas, scene, figure, figure.guides)
    blocks = [
        (own, pair, figure)
        for figure in figures
        for pair, own in zip(_sliding(scene, figure.number), figure.blocks, strict=True)
    ]
    for (at, u, size), pair, figure in sorted(blocks, key=lambda drawn: -drawn[0].size[0]):
        canvas.part(_drawn_with(scene, figure))
        name = str(figure.number)
        if pair.links[1] == FRAME and framed:
            up = guide_up(scene, pair)
            canvas.add(guide(_guide_pieces(scene, pair, up, whole), up, name, scene.style))
        canvas.add(block(at, u, name, size))
    for figure in figures:
        _strokes(canvas, scene, figure, figure.bars)
        for at, u, w in figure.corners:
            if _room(u, [w]) > STRAIGHT:
                rays = rays_at(at, figures)  # the arc over a pin stands where no other link leaves the pin
                along = u if _room(1j * u, rays) >= _room(-1j * u, rays) else -u
                canvas.add(Arc(at, 1.6 * scene.style.pair, cmath.phase(along), math.pi, Pen.MAIN, role="rigid"))
            else:
                canvas.add(rigid_corner(at, u, w, scene.style, pin=_is_in(at, figure.pins)))
    held = scene.mechanism.frame_points if framed else ()
    pins = dict.fromkeys(point for number in numbers for point in pins_of(scene, number))
    for point in (point for point in pins if point not in held):
        canvas.part(point, revolute(scene.mm(point), point, scene.style))
    if framed:
        before = canvas.part(GIVEN)
        for point in dict.fromkeys(pair.point for pair in scene.turning() if {*numbers} & {*pair.links}):
            at, down, (_, height, base) = scene.mm(point), foot_of(scene, point, figures), scene.style.pivot
            canvas.add(fixed_pivot(at, point, scene.style, down))
            far = at + down * (height + scene.style.pair + scene.style.hatch[0])
            canvas.keep_clear(at - down * 1j * (base / 2), far + down * 1j * (base / 2))
        canvas.part(before)
    return figures


def _drawn_with(scene: Scene, figure: Skeleton) -> str:
    """Return the step with which a link is drawn: that of its last point."""
    return scene.last(scene.mechanism.link(figure.number).points)


def _strokes(canvas: Canvas, scene: Scene, figure: Skeleton, strokes: Iterable[Stroke]) -> None:
    """Draw lines of a link that stop at its pins and blocks."""
    canvas.part(_drawn_with(scene, figure))
    lines = list[Line]()
    for a, b in strokes:
        e = unit(b - a)
        for start, end in pairwise([a, *_between_ends(a, b, figure.pins), b]):
            first, last = _rim(scene, figure, start, e), _rim(scene, figure, end, -e)
            if abs(end - start) > first + last:
                lines.append(Line(start + e * first, end - e * last))
    if lines:
        canvas.add(Group(tuple(lines), "link", str(figure.number)))


def _between_ends(a: complex, b: complex, places: Iterable[complex]) -> list[complex]:
    """Return the places that stand on the line from a to b, in order."""
    e, reach = unit(b - a), abs(b - a)
    inside = (at for at in places if abs(((at - a) / e).imag) < NEAR and 0 < ((at - a) / e).real < reach)
    return sorted(inside, key=lambda at: abs(at - a))


def _rim(scene: Scene, figure: Skeleton, end: complex, e: complex) -> float:
    return scene.style.pair if _is_in(end, figure.pins) else figure.rim(end, e)


def foot_of(scene: Scene, point: str, figures: Sequence[Skeleton]) -> complex:
    """Return the side on which the foot of a pivot stands: below, unless a link or another pivot is there."""
    at = scene.mm(point)
    others = [scene.mm(other) - at for other in scene.mechanism.frame_points]
    rays = rays_at(at, figures) + [unit(way) for way in others if NEAR < abs(way) < 2 * scene.style.pivot[2]]
    met, driver = {down: _met(scene, at, down, figures) for down in DOWN}, scene.mechanism.driver
    turned = isinstance(driver, Driver) and driver.pivot == point  # its angle is measured from the right

    def free(down: complex) -> tuple[bool, bool, int, bool, int]:
        apart = _room(down, rays) >= ROOM
        return apart and not met[down], apart, -met[down], not (turned and down == 1), -DOWN.index(down)

    return max(DOWN, key=free)


def _met(scene: Scene, at: complex, down: complex, figures: Sequence[Skeleton]) -> int:
    """Return how many lines and points of links stand on the foot of a pivot, on its hatching above all."""
    (width, height, base), stroke, pair = scene.style.pivot, scene.style.hatch[0], scene.style.pair
    ground, clear = pair + height, scene.style.centre
    boxes = (
        (ground - clear, -base / 2 - clear, ground + stroke + clear, base / 2 + clear),
        (ground - height / 2, -width / 4, ground, width / 4),
    )
    points = {point for figure in figures for point in scene.mechanism.link(figure.number).points}
    lines = [*(line for figure in figures for line in figure.strokes), *((end, end) for end in map(scene.mm, points))]
    placed = [((a - at) / down, (b - at) / down) for a, b in lines]
    return sum(any(clipped(a, b, box) for box in boxes) for a, b in placed)


def _coincident(scene: Scene) -> dict[str, list[int]]:
    """Return the joints at which points of several links have marks of their own, `velocity.A3`, with these links."""
    mechanism, joints = scene.mechanism, dict[str, set[int]]()
    for step in scene.program.on("velocity"):
        under = role(role(step.name).of)
        if step.verb != "read" and under.links and under.of in scene.points and under not in scene.points:
            joints.setdefault(under.of, set()).update(under.links)
    for pair in mechanism.pairs:
        if isinstance(pair, Revolute) and pair.point in joints:
            joints[pair.point].update(pair.links)
    return {point: sorted(numbers - {FRAME}) for point, numbers in joints.items()}


def letter_links(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Draw centres of mass and other lettered points, and letter joints, points and links, each once."""
    several, first = _coincident(scene), dict[str, Skeleton]()
    for figure in figures:
        for point in scene.mechanism.link(figure.number).points:
            first.setdefault(point, figure)
    pivots = {shape.name for shape in canvas.shapes if isinstance(shape, Group) and shape.role == "pivot"}
    for point, figure in first.items():
        canvas.part(GIVEN if point in pivots else point)  # a pivot comes with its letter
        pins = pins_of(scene, figure.number)
        if point in (*pins, *(pair.point for pair in _sliding(scene, figure.number))):
            links = ",".join(map(str, several.get(point, ())))
            _letter_joint(canvas, scene, point, f"{point}_{{{links}}}" if links else scene.words.mark(point), figures)
        elif all(abs(scene.mm(point) - scene.mm(pin)) >= scene.style.pair for pin in pins):
            _letter_beside(canvas, scene, figure, point)
    for figure in figures:
        canvas.part(_drawn_with(scene, figure))
        _number(canvas, scene, figure, figures)


def _letter_joint(canvas: Canvas, scene: Scene, point: str, mark: str, figures: Sequence[Skeleton]) -> None:
    """Letter a joint; in a block beside its free edge, for lines and arrows leave no room at the pin itself."""
    at = scene.mm(point)
    if not any(point in pins_of(scene, figure.number) for figure in figures):
        canvas.add(scene.point(at, point))
    around = [(own.size, own.u, figure) for figure in figures for own in figure.blocks if abs(own.at - at) < NEAR]
    if not around:
        canvas.label(mark, at, clear=scene.style.pair + 0.8)
        return
    (length, height), u, figure = max(around, key=lambda block: block[0])
    up, half = _up(scene, figure.number, at, u, figures), u * (length / 2)
    edge = at + up * (height / 2)
    canvas.label(mark, (edge - half, edge + half), prefer=up, priority=1, along=False)


def _up(scene: Scene, number: int, at: complex, u: complex, figures: Sequence[Skeleton]) -> complex:
    """Return the side of a block for its letter: away from the frame's guide, or from lines that leave it."""
    on_frame = next((pair for pair in _sliding(scene, number) if pair.links[1] == FRAME), None)
    if on_frame is not None:
        return guide_up(scene, on_frame)
    rays = rays_at(at, figures)
    return max((slider_up(u), -slider_up(u)), key=lambda side: round(_room(side, rays), 3))


def _letter_beside(canvas: Canvas, scene: Scene, figure: Skeleton, point: str) -> None:
    """Draw and letter a point that is no joint; a centre of mass is tied to its link where it stands beside it."""
    at, radius, last = scene.mm(point), scene.style.centre, ""
    mark = scene.words.mark(point)
    if point == scene.mechanism.link(figure.number).centre:
        foot = min((*(_nearest(*s, at) for s in figure.strokes), *figure.nodes), key=lambda foot: abs(foot - at))
        ring = [a for a, _ in figure.bars]
        sides = pairwise([*ring, *ring[:1]])
        inside = len(ring) > 2 and all(((b - a).conjugate() * (at - a)).imag > 0 for a, b in sides)
        if inside:  # a leader would cross a side
            last = scene.words["said.inside"].format(point=mark, link=figure.number)
        reach, e = abs(foot - at), (at - foot) / (abs(foot - at) or 1.0)
        start = _rim(scene, figure, foot, e)
        if reach > start + radius and not inside:
            canvas.add(Line(foot + e * start, at - e * radius, Pen.THIN, role="tie"))
        canvas.group("centre", point, Circle(at, radius, Pen.MAIN, fill="black"))
    else:
        canvas.add(scene.point(at, point))
    canvas.label(mark, at, clear=radius + 0.8, last=last)


def lay_down(canvas: Canvas, scene: Scene, pen: Pen, role: str) -> None:
    """Draw the mechanism in another position, its links as plain lines between small circles."""
    pins: dict[complex, None] = {}
    for number in scene.numbers:
        figure = skeleton(scene, number)
        canvas.add(*(Line(a, b, pen, role=role, name=str(number)) for a, b in figure.strokes))
        pins |= dict.fromkeys(complex(round(at.real, 4), round(at.imag, 4)) for at in figure.nodes)
    canvas.add(*(Circle(at, scene.style.node, Pen.THIN, fill="white", role=role) for at in pins))


def letter_point(canvas: Canvas, scene: Scene, point: str) -> None:
    """Draw and letter a point that is no point of the links drawn."""
    canvas.add(scene.point(scene.mm(point), point))
    canvas.label(scene.words.mark(point), scene.mm(point), clear=scene.style.node + 0.8)


def _number(canvas: Canvas, scene: Scene, figure: Skeleton, figures: Sequence[Skeleton]) -> None:
    """Number a link beside its longest free piece of line, or beside its block."""
    marks, pieces = [at for other in figures for at in other.nodes], list[Stroke]()
    for a, b in figure.strokes:
        e = unit(b - a)
        stops = sorted({0.0, abs(b - a), *(((at - a) / e).real for at in _between_ends(a, b, marks))})
        pieces += [(a + e * low, a + e * high) for low, high in pairwise(stops)]
    if pieces:
        longest = max(pieces, key=lambda piece: round(abs(piece[1] - piece[0]), 3))
        canvas.label(str(figure.number), longest, clear=0.8, along=False)
    elif figure.blocks:
        at, u, (length, height) = figure.blocks[0]
        up = _up(scene, figure.number, at, u, figures)
        away = [ray for ray in rays_at(at, figures) if abs((ray / u).real) > 0.1]
        far = u * (length / 2 if sum((ray / u).real for ray in away) <= 0 else -length / 2)
        canvas.label(str(figure.number), at + up * (height / 2) + far, clear=0.8, prefer=up)


def guide_up(scene: Scene, pair: Prismatic) -> complex:
    """Return the side of a slider that is free of its guide: that to which the links go which leave the slider."""
    own = _block(scene, pair)
    usual, reach = slider_up(own.u), (LONG + BESIDE) * own.size[0]
    return min(usual, -usual, key=lambda up: len([*_crossings(scene, own, up, (-reach, reach))]))


def _guide_pieces(scene: Scene, pair: Prismatic, up: complex, whole: bool) -> tuple[Stroke, ...]:
    """Return the lines of a guide, mm: one, or several with room between them for the links that pass.

    It is a little longer than the slider; a `whole` one is so all along the slider's way.
    """
    own = _block(scene, pair)
    (stroke, pitch), (low, high) = scene.style.hatch, scene.run_of(pair) if whole else (0.0, 0.0)
    ends, foot = (low - LONG * own.size[0], high + LONG * own.size[0]), own.at - up * (own.size[1] / 2)
    stops = [ends[0]]
    for first, last in sorted(_crossings(scene, own, up, ends)):
        # strokes of the hatching lean out by less than their length
        stops += [first - stroke, max(last + stroke, stops[-1])]
    parts = zip(stops[::2], [*stops[1::2], ends[1]], strict=True)
    return tuple((foot + own.u * start, foot + own.u * end) for start, end in parts if end - start > 2 * pitch)


def _crossings(scene: Scene, own: _Block, up: complex, ends: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Go through where along a guide, between `ends`, lines of links cross the band of its hatching, mm from it."""
    edges = own.size[1] / 2, own.size[1] / 2 + scene.style.hatch[0]
    for a, b in (line for link in scene.mechanism.links for line in skeleton(scene, link.number).strokes):
        # along the guide, and away from the slider
        (x0, d0), (x1, d1) = (
            (((p - own.at) * own.u.conjugate()).real, ((p - own.at) * -up.conjugate()).real) for p in (a, b)
        )
        places = (x0 + (x1 - x0) * (edge - d0) / (d1 - d0) for edge in edges if (d0 - edge) * (d1 - edge) < 0)
        inside = [x for x in places if ends[0] <= x <= ends[1]]
        if inside:
            yield min(inside), max(inside)
