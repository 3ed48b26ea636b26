"""What is collected of a drawing: lines, arrowheads, letters in mm of paper, counted, and what becomes of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:  # the process that reads a PDF collects, and does no more
    import numpy as np

    from ...plans.marking.lines import Drawn, Letter

LARGEST = 16_000_000  # bytes, also unpacked
MOST, STEPS = 30_000, 3  # lines of a drawing; what is counted for each: an entity and its ends
DEEPEST = 24  # blocks, forms and copies in one another
LONGEST = 200  # characters of a text
FARTHEST = 1e6  # mm from the origin
SHORTEST = 1e-3  # mm of a line
APART = 1000.0  # mm between pages
INCH = 25.4
POINT, PIXEL = INCH / 72.0, INCH / 96.0  # mm
WIDE, CAPITAL = 0.6, 0.7  # parts of the size of a font: a letter's width about, a capital's height


class FaultError(Exception):
    """What keeps a drawing from being read: the key of its message."""


class Affine(NamedTuple):
    """A map of the plane: z becomes p·z + q·(conjugate of z) + t."""

    p: complex = 1.0
    q: complex = 0.0
    t: complex = 0.0

    @classmethod
    def of(cls, x: complex, y: complex, t: complex = 0j) -> Affine:
        """Return the map that takes the axes to `x` and `y` and the origin to `t`."""
        return cls((x - 1j * y) / 2, (x + 1j * y) / 2, t)

    def at(self, z: complex) -> complex:
        """Return where a point goes."""
        return self.p * z + self.q * z.conjugate() + self.t

    def after(self, first: Affine) -> Affine:
        """Return the map that does `first`, then this one."""
        p, q = first.p, first.q
        both = self.p * p + self.q * q.conjugate(), self.p * q + self.q * p.conjugate()
        return Affine(*both, self.at(first.t))

    @property
    def scale(self) -> float:
        """How many times longer lines become, on the average."""
        return math.sqrt(abs(abs(self.p) ** 2 - abs(self.q) ** 2))


class _Piece(NamedTuple):
    """A run of letters: where it begins and ends, about, the height of its capitals."""

    text: str
    start: complex
    end: complex
    height: float


@dataclass(slots=True)
class Marks:
    """What is collected of a drawing, counted; a page stands beside the one before it."""

    lines: list[tuple[complex, complex]] = field(default_factory=list)
    heads: list[tuple[complex, complex, complex]] = field(default_factory=list)  # filled triangles
    pieces: list[_Piece] = field(default_factory=list)
    left: int = STEPS * MOST

    def count(self, pieces: int = 1) -> None:
        """Count what takes time."""
        self.left -= pieces
        if self.left < 0 or len(self.lines) > MOST:
            raise FaultError("drawing-many")

    def path(self, points: Sequence[complex], closed: bool = False) -> None:
        """Add the sides of a broken line."""
        self.count(len(points))
        self.lines += pairwise((*points, points[0]) if closed and len(points) > 2 else points)

    def text(self, text: str, start: complex, end: complex, height: float) -> None:
        """Add a run of letters; a long one is no letter of a plan."""
        self.count()
        text = " ".join(text.split())
        if text and len(text) <= LONGEST:
            self.pieces.append(_Piece(text, start, end, height))

    def drawn(self) -> Drawn:
        """Return the drawing: arrows from tail to tip, as long as they look, runs of letters joined to texts."""
        import numpy as np

        from ...plans.marking.lines import Drawn

        ends = np.array(self.lines, dtype=complex).reshape(-1, 2)
        corners = np.array(self.heads, dtype=complex).reshape(-1, 3)
        places = np.array([(piece.start, piece.end) for piece in self.pieces], dtype=complex).ravel()
        every = np.concatenate([ends.ravel(), corners.ravel(), places])
        if not (np.abs(every) <= FARTHEST).all():  # also where it is no number
            raise FaultError("drawing-far")
        ends = ends[np.abs(ends[:, 1] - ends[:, 0]) >= SHORTEST]
        if not len(ends):
            raise FaultError("drawing-empty")
        ends, arrows = _pointed(ends, corners)
        return Drawn(ends[:, 0], ends[:, 1], tuple(_letters(self.pieces)), arrows)


def _pointed(ends: np.ndarray, heads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return lines from tail to tip, shape (N, 2), and the indices of those that have an arrowhead at one end, the tip.

    One that ends inside an arrowhead goes on to its point. A head is a triangle with two sides alike, its point between
    them, and lies along its line.
    """
    import numpy as np
    import shapely

    sides = np.abs(np.roll(heads, -1, axis=1) - np.roll(heads, -2, axis=1))  # each opposite to its corner
    order = np.argsort(sides, axis=1)
    tips, *feet = np.take_along_axis(heads, order, axis=1).T if len(heads) else np.empty((3, 0), complex)
    long = np.take_along_axis(sides, order, axis=1)
    back = (feet[0] + feet[1]) / 2.0
    slim = (long[:, 2] - long[:, 1] <= 0.05 * long[:, 2]) & (long[:, 0] < long[:, 1]) if len(heads) else np.array([])
    tips, back = tips[slim.astype(bool)], back[slim.astype(bool)]
    if not len(tips):
        return ends, np.zeros(0, np.intp)
    spans = shapely.linestrings(np.stack([np.stack([tips.real, back.real], 1), np.stack([tips.imag, back.imag], 1)], 2))
    points = shapely.points(np.stack([ends.real.ravel(), ends.imag.ravel()], axis=1))
    at, head = shapely.STRtree(spans).query(points, predicate="dwithin", distance=0.05)
    line, end = at // 2, at % 2
    way = ends[line, end] - ends[line, 1 - end]
    along = (tips[head] - back[head]) * way.conj()
    fits = along.real >= 0.999 * np.abs(along)
    found = ends.copy()
    found[line[fits], 1] = tips[head[fits]]
    found[line[fits], 0] = ends[line[fits], 1 - end[fits]]
    pointed, ends_of = np.unique(np.unique(at[fits]) // 2, return_counts=True)  # a dimension has heads at both
    return found, pointed[ends_of == 1]


def _letters(pieces: Sequence[_Piece]) -> Iterator[Letter]:
    """Go through the texts of a drawing: runs that follow one another on a line, with scripts, are one."""
    from ...plans.marking.lines import Letter

    run: list[_Piece] = []
    for piece in (*pieces, None):
        if run and (piece is None or not _goes_on(run, piece)):
            largest = max(one.height for one in run)
            start, end = run[0].start, run[-1].end
            yield Letter(_spelled(run), (start + end) / 2.0, largest, end - start)
            run = []
        run += [piece] if piece is not None else []


def _goes_on(run: Sequence[_Piece], piece: _Piece) -> bool:
    """Whether a run of letters begins where those before it end, up or down by no more than a script is."""
    last, height = run[-1], max(one.height for one in run)
    along = last.end - last.start
    along = along / abs(along) if along else 1.0 + 0j
    gap = (piece.start - last.end) * along.conjugate()
    return (
        abs(gap.imag) <= 0.9 * height and -0.5 * height <= gap.real <= 0.9 * height
        and sum(len(one.text) for one in run) + len(piece.text) <= LONGEST
    )  # fmt: skip


def _spelled(run: Sequence[_Piece]) -> str:
    """Return runs as one text, with spaces where there is room for them."""
    text = run[0].text
    for before, piece in pairwise(run):
        text += " " * (abs(piece.start - before.end) > 0.4 * before.height) + piece.text
    return text


def beside(marks: Marks) -> complex:
    """Return how far a page must be moved to stand beside those before it."""
    return max((end.real for line in marks.lines for end in line), default=-APART) + APART + 0j
