"""Lines of a drawing put in order: what is split, doubled and overdrawn as straight runs, and nodes where lines end.

Everything is in millimetres of paper. A node is where segments end or runs cross; two nodes are joined where a run goes
through both, whatever pieces it was drawn in. All that is looked for later is a question whether two places are joined.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from ..laws import cross, dot

SAME = 0.25  # mm within which ends are one node
ASIDE = 0.25  # mm by which pieces of one line may lie beside one another
BESIDE = 0.4  # mm by which a node may lie beside a line
BY_HAND = 0.2  # mm besides, of a line that was drawn by hand
BENT = 0.75  # mm from which what hangs together is no straight line
ASTRAY, TILT = 0.3, 0.01  # mm and part of its length by which a line may miss its way
SEED = 4.0  # mm from which a segment has a direction
CLOSE = 0.7  # mm within which one node may be taken for another
LEAST = 1.0  # mm; nodes nearer than this are no ends of a vector that can be told
FLAT = 0.05  # sine of two lines that cross too flatly to make a node
MANY = 48  # nodes on one line, of which all pairs are looked at; of one with more those nearest to each other
AT_ONCE = 1000  # lines about which others are looked for
CELL = 0.5  # mm, side of the squares in which nodes are looked up
WAYS, LENGTHS, LONGEST = 64, 32, 1500.0  # of lines that go out: directions, and lengths up to mm that are told apart
BINS, FAR = 1440, 10_000.0  # directions of lines by which they are looked up; mm, beyond all sizes
MOSTLY = 0.7  # part of all letters that tells how a sheet is turned
APART = 1000.0  # mm between pages
REACH = 3  # squares around a node from which it is found
SQUARES = 16_000_000  # the most squares
FINE = 65_000.0  # of `REACH`, by which nodes are told nearer

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Letter:
    """A text of a drawing: its middle, its height, mm, and the way it is written; 0 where that is not known."""

    text: str
    place: complex
    height: float
    way: complex = 0j


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """What a drawing holds, in millimetres of paper, y up: segments as they were found, complex of shape (N,).

    `arrows` are the indices of those that have an arrowhead at their tip. Lines `by_hand` may miss their ends by more.
    """

    tails: Complex
    tips: Complex
    letters: tuple[Letter, ...] = ()
    arrows: Indices = field(default_factory=lambda: np.zeros(0, np.intp))
    by_hand: bool = False

    @property
    def turn(self) -> int | None:
        """By how many right angles the sheet is turned, 0 to 3, as most of what is written on it tells, if it does."""
        told = Counter[int]()
        for letter in self.letters:
            if letter.way:
                told[round(cmath.phase(letter.way) / (math.pi / 2.0)) % 4] += len(letter.text)
        most = told.most_common(1)
        return most[0][0] if most and most[0][1] >= MOSTLY * told.total() else None


def side_by_side(pages: Iterable[Drawn]) -> Drawn:
    """Return the pages of a drawing as one, beside one another."""
    whole, *others = pages
    for page in others:
        by = np.append(whole.tails, whole.tips).real.max() - np.append(page.tails, page.tips).real.min() + APART
        letters = (replace(letter, place=letter.place + by) for letter in page.letters)
        arrows = np.append(whole.arrows, page.arrows + len(whole.tails))
        tails, tips = np.append(whole.tails, page.tails + by), np.append(whole.tips, page.tips + by)
        whole = Drawn(tails, tips, (*whole.letters, *letters), arrows, whole.by_hand)
    return whole


@dataclass(frozen=True, eq=False)
class Lines:
    """The lines of a drawing.

    nodes   places, complex of shape (N,); the first `ends` of them are ends of segments, the others crossings
    first, second   indices of the nodes of each pair that a line joins, in both orders, of shape (P,)
    places  where they are found, ascending: by direction, of which `BINS` are told apart, and then by size
    angles  directions from first to second, radians from 0 to 2 pi, of shape (P,)
    sizes   their distances, of shape (P,)
    codes   first * N + second, ascending: to be searched
    hubs    number of the hub of each node, of shape (N,): nodes that may be taken for one another are one hub
    hub_codes   the same as codes, of hubs
    squares, corner   which node is nearest to each square, -1 for none, of shape (rows, columns); the lowest corner
    tails, tips     the segments as they were drawn
    """

    nodes: Complex
    ends: int
    first: Indices
    second: Indices
    places: Floats
    angles: Floats
    sizes: Floats
    codes: Indices
    hubs: Indices
    hub_codes: Indices
    squares: NDArray[np.int32]
    corner: complex
    tails: Complex
    tips: Complex

    def near(self, places: Complex) -> Indices:
        """Return for each place the index of the nearest node within about 1.5 mm, or -1."""
        rows, columns = self.squares.shape
        across = np.floor((places.real - self.corner.real) / CELL).astype(np.intp)
        up = np.floor((places.imag - self.corner.imag) / CELL).astype(np.intp)
        inside = (across >= 0) & (up >= 0) & (across < columns) & (up < rows)
        return np.where(inside, self.squares.ravel().take(up * columns + across, mode="clip"), -1).astype(np.intp)

    def joined(self, first: Indices, second: Indices, loosely: bool = False) -> NDArray[np.bool_]:
        """Return which pairs of nodes a line joins; -1 stands for no node. Loosely: nodes beside them count as well."""
        codes = self.hub_codes if loosely else self.codes
        if not len(codes):
            return np.zeros(np.broadcast(first, second).shape, bool)
        both = (first >= 0) & (second >= 0)
        first, second = np.broadcast_to(first, both.shape)[both], np.broadcast_to(second, both.shape)[both]
        one, other = (self.hubs[first], self.hubs[second]) if loosely else (first, second)
        wanted = one * len(self.nodes) + other
        both[both] = codes[np.minimum(np.searchsorted(codes, wanted), len(codes) - 1)] == wanted
        return both

    def joined_to(self, node: int) -> Indices:
        """Return the nodes that a line joins to one."""
        begin, end = np.searchsorted(self.codes, [node * len(self.nodes), (node + 1) * len(self.nodes)])
        return self.codes[begin:end] % len(self.nodes)

    @cached_property
    def outward(self) -> NDArray[np.uint32]:
        """How long lines are that go out from each hub in about each of `WAYS` directions: bits by `length_of`.

        Of shape (hubs * WAYS,).
        """
        found = np.zeros((int(self.hubs.max(initial=-1)) + 1) * WAYS, np.uint32)
        long = self.sizes > SEED
        hubs, angles, sizes = self.hubs[self.first[long]], self.angles[long], self.sizes[long]
        off = TILT + 2.0 * CLOSE / sizes
        low, high = (np.floor((angles + side) * (WAYS / math.tau)).astype(np.intp) for side in (-off, off))
        least, most = (length_of(np.log(sizes * (1.0 + side))) for side in (-off, off))
        bits = ((2 << most) - (1 << least)).astype(np.uint32)
        for step in range(int((high - low).max(initial=-1)) + 1):
            here = low + step <= high
            np.bitwise_or.at(found, hubs[here] * WAYS + (low + step)[here] % WAYS, bits[here])
        return found

    def covers(self, start: complex, stop: complex) -> bool:
        """Whether segments cover the whole way between two places, whatever else runs beside it."""
        size = abs(stop - start)
        way = (stop - start) / size
        aside = np.maximum(np.abs(cross(way, self.tails - start)), np.abs(cross(way, self.tips - start)))
        here = aside < BESIDE
        along = np.sort([dot(way, self.tails[here] - start), dot(way, self.tips[here] - start)], axis=0)
        reached = BESIDE
        for low, high in along[:, np.argsort(along[0])].T.tolist():
            if low > reached:
                break
            reached = max(reached, high + BESIDE)
        return reached >= size - BESIDE

    def stand_free(self, starts: Complex, stops: Complex) -> bool:
        """Whether no other long segment meets some lines, and none of these goes on."""
        own, long = shapely.union_all(_segments(starts, stops)), np.abs(self.tips - self.tails) > SEED
        tails, tips = self.tails[long], self.tips[long]
        near = shapely.dwithin(_segments(tails, tips), own, ASIDE)
        return all((shapely.distance(_points(ends[near]), own) <= BESIDE).all() for ends in (tails, tips))

    def end(self, place: complex, ways: Complex) -> complex | None:
        """Return where ends of lines going out some ways (unit directions) meet near a place; None where none do."""
        ends, others = np.concatenate((self.tails, self.tips)), np.concatenate((self.tips, self.tails))
        here = np.abs(ends - place) < 2.0 * BESIDE
        ends, spans = ends[here], others[here] - ends[here]
        sizes = np.abs(spans)
        aside, along = np.abs(cross(ways[:, None], spans[None, :])), dot(ways[:, None], spans[None, :])
        ends = ends[((aside < np.minimum(ASTRAY + TILT * sizes, 0.5 * sizes)) & (along > 0.0)).any(axis=0)]
        for within in (ASIDE, BESIDE, 2.0 * BESIDE):
            near = np.abs(ends - place) < within
            if near.any():
                middle = complex(ends[near].mean())
                return complex(ends[np.abs(ends - middle) <= max(ASIDE, np.abs(ends - middle).min())].mean())
        return None

    def go_on(self, first: Indices, second: Indices) -> NDArray[np.bool_]:
        """Return which lines that join two nodes go on to another node beyond the second one."""
        count = len(self.nodes)
        begin, end = np.searchsorted(self.codes, second * count), np.searchsorted(self.codes, (second + 1) * count)
        own = np.repeat(np.arange(len(first)), end - begin)  # all pairs that begin at the second nodes
        at = np.arange(len(own)) + (begin - np.cumsum(end - begin) + (end - begin))[own]
        beyond = self.nodes[self.codes[at] % count] - self.nodes[second[own]]
        off = np.abs(np.angle(beyond / (self.nodes[second] - self.nodes[first])[own]))
        on = own[off < TILT + ASTRAY / np.abs(beyond)]
        return np.bincount(on, minlength=len(first)) > 0

    def ranges(self, angles: Floats, within: Floats, low: Floats, high: Floats) -> tuple[Indices, Indices]:
        """Return where pairs begin and stop that have about some directions, and sizes between two; see `within`.

        All are of shape (N,), radians and mm; what is returned of shape (N, bins).
        """
        first = np.floor((angles - within) * (BINS / math.tau))
        count = np.floor((angles + within) * (BINS / math.tau)) - first + 1
        steps = np.arange(int(count.max(initial=0)))
        bins = (first[:, None] + steps) % BINS * FAR
        begin = np.searchsorted(self.places, bins + np.maximum(low, 0.0)[:, None])
        end = np.searchsorted(self.places, bins + np.clip(high, 0.0, FAR / 2.0)[:, None])
        return begin, np.where(steps < count[:, None], np.maximum(begin, end), begin)

    def within(self, found: tuple[Indices, Indices]) -> tuple[Indices, Indices]:
        """Return for ranges of pairs, of shape (N, bins), the numbers of the row of each pair, and the pairs."""
        begin, counts = found[0].ravel(), (found[1] - found[0]).ravel()
        own = np.repeat(np.arange(len(found[0])), counts.reshape(found[0].shape).sum(axis=1))
        return own, np.arange(len(own)) + np.repeat(begin - np.cumsum(counts) + counts, counts)


def length_of(logarithms: Floats) -> Indices:
    """Return of which of `LENGTHS` lines are, from the logarithms of their sizes, mm."""
    found = (logarithms - math.log(SEED)) * (LENGTHS / math.log(LONGEST / SEED))
    return np.clip(found, 0.0, LENGTHS - 1.0).astype(np.intp)


def lines_of(drawn: Drawn) -> Lines:
    """Put segments in order: pieces, copies and stray ones."""
    tails, tips = drawn.tails, drawn.tips
    whole = np.isfinite(tails) & np.isfinite(tips)
    tails, tips = tails[whole], tips[whole]
    nodes, number = _clustered(np.concatenate((tails, tips)))
    long = np.abs(tips - tails) > SAME
    in_line = _in_line(tails[long], tips[long])
    starts, stops, beside = _runs(tails[long], tips[long], in_line)
    beside = beside + BY_HAND * drawn.by_hand
    crossings = _crossings(starts, stops, nodes)
    every = np.concatenate((nodes, crossings))
    more = _lengthened(tails[long], tips[long], in_line)
    runs = (
        np.concatenate((starts, more[0])),
        np.concatenate((stops, more[1])),
        np.append(beside, np.full(len(more[0]), BY_HAND * drawn.by_hand)),
    )
    first, second = _pairs(runs, every, len(nodes), number.reshape(2, -1))
    ways = every[second] - every[first]
    angles, sizes = np.angle(ways) % (2.0 * math.pi), np.abs(ways)
    places = np.floor(angles * (BINS / math.tau)) * FAR + np.minimum(sizes, FAR / 2.0)
    order = np.lexsort((angles, places))
    first, second, places, angles, sizes = first[order], second[order], places[order], angles[order], sizes[order]
    hubs = _hubs(every)
    codes, hub_codes = _distinct(first * len(every) + second), _distinct(hubs[first] * len(every) + hubs[second])
    squares, corner = _squares(every)
    return Lines(
        every, len(nodes), first, second, places, angles, sizes, codes, hubs, hub_codes, squares, corner, tails, tips
    )


def _distinct(codes: Indices) -> Indices:
    """Return what whole numbers there are, ascending; of many that differ this is faster than NumPy's own."""
    codes = np.sort(codes)
    return np.asarray(codes[np.append(True, codes[1:] != codes[:-1])[: len(codes)]])


def _hubs(nodes: Complex) -> Indices:
    """Return the numbers of groups of nodes that are close together."""
    if not len(nodes):
        return np.zeros(0, np.intp)
    return _components(len(nodes), *_near(nodes, CLOSE))


def _near(places: Complex, within: float) -> tuple[Indices, Indices]:
    """Return which places are near one another, mm, each pair of them once: places in squares side by side."""
    across, up = (np.floor(axis / within).astype(np.int64) for axis in (places.real, places.imag))
    up -= up.min(initial=0)
    rows = int(up.max(initial=0)) + 3
    codes = across * rows + up
    order = np.argsort(codes, kind="stable")
    codes, places = codes[order], places[order]
    found = []
    for first, last in ((np.arange(1, len(codes) + 1), codes + 1), (None, codes + rows + 1)):
        begin = np.searchsorted(codes, codes + rows - 1) if first is None else first
        counts = np.maximum(np.searchsorted(codes, last, side="right") - begin, 0)
        one = np.repeat(np.arange(len(codes)), counts)
        other = np.arange(len(one)) + (begin - np.cumsum(counts) + counts)[one]
        near = np.abs(places[one] - places[other]) <= within
        found.append((order[one[near]], order[other[near]]))
    one, other = (np.concatenate([pair[side] for pair in found]) for side in (0, 1))
    return one, other


def _components(count: int, one: Indices, other: Indices) -> Indices:
    """Return the number of the group of each of so many things, of which pairs belong together."""
    labels = np.arange(count)
    while True:
        before = labels.copy()
        np.minimum.at(labels, one, labels[other])
        np.minimum.at(labels, other, labels[one])
        labels = labels[labels]
        if np.array_equal(labels, before):
            return np.unique(labels, return_inverse=True)[1].reshape(-1)


def _points(places: Complex) -> NDArray[np.object_]:
    return np.asarray(shapely.points(places.real, places.imag))


def _segments(tails: Complex, tips: Complex) -> NDArray[np.object_]:
    ends = np.stack((np.stack((tails.real, tails.imag), -1), np.stack((tips.real, tips.imag), -1)), 1)
    return np.asarray(shapely.linestrings(ends))


def _clustered(ends: Complex) -> tuple[Complex, Indices]:
    """Return the middles of ends that stand together, and of which of them each end is."""
    if not len(ends):
        return ends, np.zeros(0, np.intp)
    # many ends stand at the very same place
    places, own, counts = np.unique(np.round(ends, 3), return_inverse=True, return_counts=True)
    labels = _components(len(places), *_near(places, SAME))
    return _mean(labels, places, counts.astype(float)), labels[own.reshape(-1)]


def _mean(labels: Indices, places: Complex, weights: Floats) -> Complex:
    total = np.bincount(labels, weights)
    sums = np.bincount(labels, weights * places.real) + 1j * np.bincount(labels, weights * places.imag)
    return np.asarray(sums / total)


def _in_boxes(
    tree: shapely.STRtree, starts: Complex, stops: Complex, within: Floats
) -> Iterator[tuple[Indices, Indices]]:
    """Go through what may be within so many mm of segments, some of these after the other: numbers of both.

    What is in their boxes, which trees find faster than what is near.
    """
    low, high = np.minimum(starts.real, stops.real) - within, np.maximum(starts.real, stops.real) + within
    down, up = np.minimum(starts.imag, stops.imag) - within, np.maximum(starts.imag, stops.imag) + within
    for begin in range(0, len(starts), AT_ONCE):
        some = slice(begin, begin + AT_ONCE)
        one, other = tree.query(shapely.box(low[some], down[some], high[some], up[some]))
        yield one + begin, other


def _joined(pairs: Iterable[tuple[Indices, Indices]]) -> tuple[Indices, Indices]:
    found = [(np.zeros(0, np.intp), np.zeros(0, np.intp)), *pairs]
    return np.concatenate([one for one, _ in found]), np.concatenate([other for _, other in found])


def _in_line(tails: Complex, tips: Complex) -> tuple[Indices, Indices, Floats]:
    """Return which segments have which others along their lines, and how far these lie beside it, mm."""
    drawn, found = _segments(tails, tips), list[tuple[Indices, Indices]]()
    ways = (tips - tails) / np.abs(tips - tails)

    def aside(one: Indices, other: Indices) -> Floats:
        off = [np.abs(cross(ways[one], end[other] - tails[one])) for end in (tails, tips)]
        return np.asarray(np.maximum(*off))

    for one, other in _in_boxes(shapely.STRtree(drawn), tails, tips, np.full(len(tails), ASIDE)):
        here = aside(one, other) < BESIDE
        one, other = one[here], other[here]
        here = shapely.dwithin(drawn[one], drawn[other], ASIDE)
        found.append((one[here], other[here]))
    one, other = _joined(found)
    return one, other, aside(one, other)


def _runs(tails: Complex, tips: Complex, in_line: tuple[Indices, Indices, Floats]) -> tuple[Complex, Complex, Floats]:
    """Return both ends of straight lines, each put together of its pieces and copies; how far these lie beside it."""
    if not len(tails):
        return tails, tips, np.zeros(0)
    one, other, aside = in_line
    sizes = np.abs(tips - tails)
    longer = (sizes[one] > sizes[other]) | ((sizes[one] == sizes[other]) & (one < other))
    together = longer & (aside < ASIDE)
    labels = _components(len(tails), one[together], other[together])
    order = np.lexsort((-sizes, labels))
    longest = order[np.searchsorted(labels[order], np.arange(labels.max() + 1))]
    begin, way = tails[longest][labels], ((tips - tails) / sizes)[longest][labels]
    # chords of an arc hang together, too, and are no straight line
    off = np.maximum(np.abs(cross(way, tails - begin)), np.abs(cross(way, tips - begin)))
    bent = np.zeros(len(longest))
    np.maximum.at(bent, labels, off)
    alone = (bent > BENT)[labels]
    least, most = np.full(len(longest), np.inf), np.full(len(longest), -np.inf)
    for end in (tails, tips):
        np.minimum.at(least, labels, dot(way, end - begin))
        np.maximum.at(most, labels, dot(way, end - begin))
    straight = bent <= BENT
    middles = _mean(labels, (tails + tips) / 2.0, sizes)
    base, unit = tails[longest], ((tips - tails) / sizes)[longest]
    base = base + 1j * unit * cross(unit, middles - base)
    starts, stops = base + least * unit, base + most * unit
    beside = np.concatenate((bent[straight], np.zeros(int(alone.sum()))))
    return np.concatenate((starts[straight], tails[alone])), np.concatenate((stops[straight], tips[alone])), beside


def _lengthened(tails: Complex, tips: Complex, in_line: tuple[Indices, Indices, Floats]) -> tuple[Complex, Complex]:
    """Return segments with the pieces that go on in line with each: of lines close together each keeps its own."""
    one, other, _ = in_line
    sizes = np.abs(tips - tails)
    ways, least, most = (tips - tails) / sizes, np.zeros(len(sizes)), sizes.copy()
    for end in (tails, tips):
        along = dot(ways[one], end[other] - tails[one])
        np.minimum.at(least, one, along)
        np.maximum.at(most, one, along)
    grown = (sizes > SEED) & ((least < -ASIDE) | (most > sizes + ASIDE))
    return (tails + least * ways)[grown], (tails + most * ways)[grown]


def _crossings(starts: Complex, stops: Complex, nodes: Complex) -> Complex:
    """Return where lines cross away from all ends."""
    if not len(starts):
        return starts
    drawn = _segments(starts, stops)
    one, other = shapely.STRtree(drawn).query(drawn, predicate="intersects")
    once = one < other
    one, other = one[once], other[once]
    u, w = stops[one] - starts[one], stops[other] - starts[other]
    sine = cross(u, w) / (np.abs(u) * np.abs(w))
    steep = np.abs(sine) > FLAT
    one, other, u, w = one[steep], other[steep], u[steep], w[steep]
    places = starts[one] + u * (cross(starts[other] - starts[one], w) / cross(u, w))
    places, _ = _clustered(places)
    if not len(places):
        return places
    near, _ = shapely.STRtree(_points(nodes)).query(_points(places), predicate="dwithin", distance=BESIDE)
    return np.delete(places, near)


def _pairs(runs: tuple[Complex, Complex, Floats], nodes: Complex, ends: int, drawn: Indices) -> tuple[Indices, Indices]:
    """Return the indices of nodes that lines join, those of `drawn` segments among them; each pair in both orders.

    A segment ends at one of them at the least: of a vector something is drawn that begins or ends where it does.
    """
    starts, stops, beside = runs
    if not len(starts):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    sizes, ways = np.abs(stops - starts), (stops - starts) / np.abs(stops - starts)

    def near(line: Indices, node: Indices) -> tuple[Indices, Indices]:
        along = np.clip(dot(ways[line], nodes[node] - starts[line]), 0.0, sizes[line])
        here = np.abs(starts[line] + along * ways[line] - nodes[node]) <= BESIDE + beside[line]
        return line[here], node[here]

    boxes = _in_boxes(shapely.STRtree(_points(nodes)), starts, stops, BESIDE + beside)
    line, node = _joined(near(*some) for some in boxes)
    order = np.lexsort((dot(ways[line], nodes[node] - starts[line]), line))
    line, node = line[order], node[order]
    found: list[tuple[Indices, Indices]] = []
    for step in range(1, min(len(node), MANY)):
        here = line[:-step] == line[step:]
        if not here.any():
            break
        here &= (node[:-step] < ends) | (node[step:] < ends)
        found.append((node[:-step][here], node[step:][here]))
    one, other = (np.concatenate([drawn[side], *(pair[side] for pair in found)]) for side in (0, 1))
    codes = _distinct(np.concatenate((one * len(nodes) + other, other * len(nodes) + one)))
    one, other = codes // len(nodes), codes % len(nodes)
    apart = np.abs(nodes[one] - nodes[other]) > LEAST
    return one[apart], other[apart]


def _squares(nodes: Complex) -> tuple[NDArray[np.int32], complex]:
    """Return which node is nearest to each square, and the lowest corner of all."""
    if not len(nodes):
        return np.full((1, 1), -1, np.int32), 0j
    corner = complex(nodes.real.min(), nodes.imag.min()) - (REACH + 1) * CELL * (1 + 1j)
    at = (nodes - corner) / CELL
    columns, rows = (int(axis.max()) + REACH + 2 for axis in (at.real, at.imag))
    if rows * columns > SQUARES:  # a drawing beyond all paper: what is out there is no plan
        columns = rows = math.isqrt(SQUARES)
    squares = np.full((rows, columns), -1, np.int32)
    offsets = np.arange(-REACH, REACH + 1)
    dx, dy = (grid.ravel() for grid in np.meshgrid(offsets, offsets))
    x, y = np.floor(at.real)[:, None] + dx, np.floor(at.imag)[:, None] + dy
    apart = np.abs(x + 0.5 - at.real[:, None] + 1j * (y + 0.5 - at.imag[:, None]))
    number = np.broadcast_to(np.arange(len(nodes))[:, None], x.shape)
    inside = (apart <= REACH) & (x >= 0) & (y >= 0) & (x < columns) & (y < rows)
    x, y, number, apart = x[inside], y[inside], number[inside], apart[inside]
    far = ((REACH - apart) * (FINE / REACH)).astype(np.uint16)  # whole numbers of 16 bits are sorted faster
    order = np.argsort(far, kind="stable")  # the nearest is written last
    squares[y[order].astype(np.intp), x[order].astype(np.intp)] = number[order]
    return squares, corner
