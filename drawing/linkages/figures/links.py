"""Links drawn to scale: lines from pair to pair, blocks, guides, rigid corners, pivots on the frame, and their letters.

Any view of a mechanism, or of a part of it, draws its links so:

    figures = draw_links(canvas, scene, numbers)      # all lines, blocks and pins of these links
    draw_frame(canvas, scene, numbers, figures)       # the pivots on which they turn, where the frame belongs
    letter_links(canvas, scene, numbers, figures)     # joints, centres of mass and numbers, each once
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from ....plans.board import POSITION
from ....plans.linkages.mechanism import FRAME, Prismatic, Revolute
from ....plans.names import role
from ...figure import GIVEN
from ...shapes import Group, Line, Pen
from ...symbols import block, bridge, centre_of_mass, fixed_pivot, guide, revolute, rigid_corner, slider_up
from ...view import Canvas
from ..scene import Scene
from ..skeleton import (
    NEAR,
    Skeleton,
    Stroke,
    block_size,
    guide_of,
    is_inside,
    nearest,
    pins_of,
    rays_of,
    rim_of,
    room_beside,
    skeleton,
    spread_of,
)

STRAIGHT = math.radians(179.0)
DOWN = (-1j, -1 + 0j, 1 + 0j, 1j)  # where the foot of a pivot may stand, the usual place first
ROOM = math.radians(35.0)  # between the foot of a pivot and a link
LONG = 1.1  # half the length of a guide in lengths of its slider
BESIDE = 0.75  # lengths of the slider beyond an end of the guide where a link would still pass close to the hatching


def draw_links(
    canvas: Canvas, scene: Scene, numbers: Sequence[int], framed: bool = True, whole: bool = False
) -> list[Skeleton]:
    """Draw moving links: guides under blocks, all other lines over them, pins on top; return their figures.

    `framed` says whether the guides of the frame are drawn under the sliders that run on them, `whole` whether as long
    as the way of the sliders.
    """
    figures = [skeleton(scene, number) for number in numbers]
    for figure in figures:
        canvas.part(drawn_with(scene, figure))
        _strokes(canvas, scene, figure, figure.guides)
    blocks = [(figure, *drawn) for figure in figures for drawn in _blocks(scene, figure, framed, whole)]
    for figure, _, shapes in sorted(blocks, key=lambda drawn: -drawn[1]):
        canvas.part(drawn_with(scene, figure))
        canvas.add(*shapes)
    for figure in figures:
        canvas.part(drawn_with(scene, figure))
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
    """Draw lines of a link, each stopped at the circles and blocks on its way."""
    lines = tuple(Line(*part, Pen.MAIN) for stroke in strokes for part in _parts(scene, figure, stroke))
    if lines:
        canvas.add(Group(lines, "link", str(figure.number)))


def _parts(scene: Scene, figure: Skeleton, stroke: Stroke) -> Iterator[Stroke]:
    """Cut a line at the pins on it."""
    a, b = stroke
    e = (b - a) / abs(b - a)
    inside = [pin for pin in figure.pins if abs(((pin - a) / e).imag) < NEAR and 0 < ((pin - a) / e).real < abs(b - a)]
    stops = [a, *sorted(inside, key=lambda pin: abs(pin - a)), b]
    for start, end in pairwise(stops):
        if abs(end - start) > _rim(scene, figure, start, e) + _rim(scene, figure, end, -e):
            yield start + e * _rim(scene, figure, start, e), end - e * _rim(scene, figure, end, -e)


def _rim(scene: Scene, figure: Skeleton, end: complex, e: complex) -> float:
    """Return where a line that leaves `end` along `e` begins: at the circle of a pin, at the edge of a block."""
    if _is_in(end, figure.pins):
        return scene.style.pair
    return next((rim_of(u, size, e) for at, u, size in figure.blocks if abs(at - end) < NEAR), 0.0)


def _is_in(at: complex, places: Iterable[complex]) -> bool:
    return any(abs(at - place) < NEAR for place in places)


def _blocks(scene: Scene, figure: Skeleton, framed: bool, whole: bool) -> Iterator[tuple[float, tuple[Group, ...]]]:
    """Go through the blocks of a link by size: sliders with the frame's guide under them, blocks on links that move."""
    name = str(figure.number)
    own = [p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and p.links[0] == figure.number]
    for pair, (at, u, size) in zip(own, figure.blocks, strict=True):
        if pair.links[1] == FRAME and framed:
            up = guide_up(scene, pair)
            on_frame = guide(guide_pieces(scene, pair, up, whole), up, name, scene.style)
            yield size[0], (on_frame, block(at, u, name, size))
        else:
            yield size[0], (block(at, u, name, size),)


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


def letter_links(canvas: Canvas, scene: Scene, numbers: Sequence[int], figures: Sequence[Skeleton]) -> None:
    """Draw centres of mass and other lettered points, and letter joints, points and links, each once."""
    several, lettered = coincident(scene), set[str]()
    for number, figure in zip(numbers, figures, strict=True):
        link = scene.mechanism.link(number)
        for point in link.points:
            if point in lettered:
                continue
            lettered.add(point)
            canvas.part(point)
            running = (p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and p.links[0] == number)
            if point in pins_of(scene, number) or point in {pair.point for pair in running}:
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
    up = _up(scene, figure.number, at, u, figures)
    edge, half = at + up * (height / 2), u * (length / 2)
    canvas.label(mark, (edge - half, edge + half), clear=1.0, prefer=up, priority=1)


def _up(scene: Scene, number: int, at: complex, u: complex, figures: Sequence[Skeleton]) -> complex:
    """Return the side of a block for its letter: away from the frame's guide, or from lines that leave it."""
    for pair in scene.mechanism.pairs:
        if isinstance(pair, Prismatic) and pair.links == (number, FRAME):
            return guide_up(scene, pair)
    rays = rays_at(at, figures)
    sides = slider_up(u), -slider_up(u)
    return max(sides, key=lambda side: round(room_beside(side, rays), 3))


def _letter_point(canvas: Canvas, scene: Scene, figure: Skeleton, point: str) -> None:
    """Draw and letter a centre of mass or another point that is no joint."""
    at, style, number = scene.mm(point), scene.style, figure.number
    if any(abs(at - scene.mm(pin)) < style.pair for pin in pins_of(scene, number)):
        return
    if point == scene.mechanism.link(number).centre:
        _tie(canvas, scene, at, figure)
        canvas.add(centre_of_mass(at, point, style))
    else:
        canvas.add(scene.point(at, point))
    canvas.label(scene.words.mark(point), at, clear=style.centre + 0.8)


def _tie(canvas: Canvas, scene: Scene, at: complex, figure: Skeleton) -> None:
    """Draw a thin line to a centre of mass that stands neither on a line of its link nor between them."""
    feet = [*(nearest(*stroke, at) for stroke in figure.strokes), *(block.at for block in figure.blocks), *figure.pins]
    foot = min(feet, key=lambda foot: abs(foot - at))
    inside = len(figure.bars) > 2 and is_inside([a for a, _ in figure.bars], at)
    reach, e = abs(foot - at), (at - foot) / (abs(foot - at) or 1.0)
    start = _rim(scene, figure, foot, e)
    if reach > start + scene.style.centre and not inside:
        canvas.add(Line(foot + e * start, at - e * scene.style.centre, Pen.THIN, role="tie"))


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
    """Cut a line at all pins and blocks on it."""
    a, b = stroke
    e, reach = (b - a) / abs(b - a), abs(b - a)
    marks = [at for figure in figures for at in figure.nodes]
    along = [((at - a) / e).real for at in marks if abs(((at - a) / e).imag) < NEAR]
    stops = sorted({0.0, reach, *(k for k in along if 0 < k < reach)})
    yield from ((a + e * low, a + e * high) for low, high in pairwise(stops))


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
