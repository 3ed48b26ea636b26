"""A template of a link, laid on the drawing so that its three joints stand on the paths that their legs allow.

A group of class III has no construction by ruler and compass. On the board one cuts the central link out of paper and
moves it about until each joint stands on its arc, or on its line; Newton's method does the same. It starts where the
template lies already, nearly: how it comes there is no matter of the board.

The equations are straight real arithmetic with a fixed number of corrections: one position and many agree to the bit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..laws import cross, dot

CORRECTIONS = 5
FEWEST = 3  # that tell how well a template lies
ASTRAY = 4  # which operand of the verbs tells how far the template went astray; those of the legs follow
CLOSED = 1e-12  # part of all lengths together that legs may miss their joints by
# The position itself is known to eps / determinant only: a determinant below the root of eps may as well be zero.
FOLDED = 1e-7
NOISE = 2.0**-36  # part of the size below which a correction is no measure of convergence


@dataclass(frozen=True, slots=True)
class _Path:
    """What a leg leaves to its joint: the arc of `radius` about `start`, or the line through `start` along `direction`.

    `joint` is the joint on the template, counted from the first one.
    """

    joint: Any
    start: Any
    radius: Any
    direction: Any
    is_line: bool

    def look(self, place: Any, turn: Any, size: Any, root: Callable[[Any], Any]) -> tuple[Any, Any, Any]:
        """Return the leg's unit direction, its moment about the first joint over `size`, and the gap along it."""
        arm = turned(turn, self.joint)
        way = place + arm - self.start
        if self.is_line:
            along = self.direction * 1j
            gap = cross(self.direction, way)
        else:
            distance = root(dot(way, way))
            along = way * (1.0 / (distance + (distance == 0.0)))
            gap = distance - self.radius
        return along, cross(arm, along) / size, gap


@dataclass(frozen=True, slots=True)
class Laid:
    """The template before its last correction: where its first joint lies, the direction of its x axis, and how well.

    `determinant` is that of the lines of the three legs, their moments counted in the `size` of the template: zero when
    they meet in one point or are parallel; for legs of which two are normal it is the distance of the third line from
    the meeting point of those two, in sizes. `missing` is how far the legs were from their joints at the start, as far
    as no motion of the template mends it; `apart` how far they still are, as a part of all lengths together; `doubt`
    the second correction as a part of the first.
    """

    place: Any
    turn: Any
    determinant: Any
    apart: Any
    doubt: Any
    missing: Any
    last: tuple[Any, Any]

    def finished(self, determinant: Any) -> tuple[Any, Any]:
        """Return place and direction after the last correction, with the determinant that a board has checked."""
        move, twist = self.last
        inverse = -1.0 / determinant
        return self.place + move * inverse, _rotated(self.turn, twist * inverse)


def lay(
    where: Sequence[Any],
    names: Sequence[str],
    root: Callable[[Any], Any],
    point: Callable[[Any, Any], Any],
    corrections: int,
) -> Laid:
    """Lay a template on the paths of its three joints by Newton's method.

    Parameters
    ----------
    where : sequence of numbers, or of arrays of shape (N,)
        Where it lies already, about: x, y of its first joint, m, cosine and sine of its x axis; how far it went astray
        on the way there, zero when it did not; then joint, start, radius and direction of each leg.
    names : sequence of str
        Their names: the radius of a line and the direction of an arc are called `zero`.
    root, point : callables
        The square root of the board's numbers, and a point by its coordinates.
    corrections : int
        How many, the last one included, `FEWEST` at least: each doubles the digits.
    """
    place, turn = point(where[0], where[1]), point(where[2], where[3])
    joint = where[ASTRAY + 1]
    first, second, third = (
        _Path(where[i] - joint, where[i + 1], where[i + 2], where[i + 3], names[i + 2] == "zero")
        for i in range(ASTRAY + 1, len(names), 4)
    )
    paths = first, second, third
    size = _size(paths, root)
    steps: list[Any] = []
    missing: Any = 0.0
    for number in range(corrections):
        lines, moments, gaps = zip(*(path.look(place, turn, size, root) for path in paths), strict=True)
        sines = cross(lines[1], lines[2]), cross(lines[2], lines[0]), cross(lines[0], lines[1])
        determinant = moments[0] * sines[0] + moments[1] * sines[1] + moments[2] * sines[2]
        mending = _mending(lines, moments, sines)
        move, twist = _correction(gaps, mending)
        if number == 0:
            missing = _missing((move, twist), mending, root)
        if number < corrections - 1:
            inverse = -1.0 / (determinant + (determinant == 0.0))
            move, twist = move * inverse, twist * inverse
            place, turn = place + move, _rotated(turn, twist / size)
            steps.append(root(dot(move, move) + twist * twist))
    total = size + paths[0].radius + paths[1].radius + paths[2].radius
    apart = (abs(gaps[0]) + abs(gaps[1]) + abs(gaps[2])) / total
    doubt = steps[1] / (steps[0] + size * NOISE)
    turn = turn * (1.0 / root(dot(turn, turn)))
    return Laid(place, turn, determinant, apart, doubt, missing, (move, twist / size))


def _size(paths: tuple[_Path, _Path, _Path], root: Callable[[Any], Any]) -> Any:
    """Return the size of a template: of an equal-sided one 1.22 sides, of a flat one its length."""
    first, second = paths[1].joint, paths[2].joint
    third = second - first
    size = root((dot(first, first) + dot(second, second) + dot(third, third)) * 0.5)
    return size + (size == 0.0)


def _mending(lines: Any, moments: Any, sines: Any) -> tuple[tuple[Any, Any], ...]:
    """Return for each leg minus the determinant times the correction that a gap of one calls for (Cramer's rule).

    That is of the place, and of the turn in sizes.
    """
    return tuple(
        ((lines[k] * moments[j] - lines[j] * moments[k]) * 1j, sines[i])
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    )


def _correction(gaps: Any, mending: tuple[tuple[Any, Any], ...]) -> tuple[Any, Any]:
    """Return minus the determinant times the correction of all gaps together."""
    move = mending[0][0] * gaps[0] + mending[1][0] * gaps[1] + mending[2][0] * gaps[2]
    return move, mending[0][1] * gaps[0] + mending[1][1] * gaps[1] + mending[2][1] * gaps[2]


def _missing(correction: tuple[Any, Any], mending: tuple[tuple[Any, Any], ...], root: Callable[[Any], Any]) -> Any:
    """Return how much the leg must change that mends all gaps by the least, where no motion does."""
    squares = [dot(move, move) + twist * twist for move, twist in (correction, *mending)]
    least = _larger(_larger(squares[1], squares[2]), squares[3])
    return root(squares[0] / (least + (least == 0.0)))


def _larger(first: Any, second: Any) -> Any:
    return (first + second + abs(first - second)) * 0.5


def turned(turn: Any, vector: Any) -> Any:
    """Return a vector of the template as it lies on the drawing."""
    return turn * vector.real + (turn * 1j) * vector.imag


def _rotated(turn: Any, angle: Any) -> Any:
    """Return a unit direction turned by about `angle`, exactly so as `angle` goes to zero."""
    half = angle * 0.5
    inverse = 1.0 / (half * half + 1.0)
    return turn * ((1.0 - half * half) * inverse) + (turn * 1j) * (angle * inverse)
