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

from ..board import Board
from ..laws import cross, dot

CORRECTIONS = 5
ASTRAY = 4  # which operand of the verbs tells how far the template went astray; those of the legs follow
CLOSED = 1e-12  # part of all lengths together that legs may miss their joints by
# The position itself is known to eps / determinant only: a determinant below the root of eps may as well be zero.
FOLDED = 1e-7
NOISE = 2.0**-36  # part of the size below which a correction is no measure of convergence


@dataclass(frozen=True, slots=True)
class Path:
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
        return self.place + move * inverse, rotated(self.turn, twist * inverse)


def paths_of(marks: Sequence[Any], names: Sequence[str]) -> tuple[Path, Path, Path]:
    """Return the paths from a board's operands, four for each leg: joint, start, radius, direction.

    The radius of a line and the direction of an arc are called `zero`.
    """
    first, second, third = (
        Path(marks[i] - marks[0], marks[i + 1], marks[i + 2], marks[i + 3], names[i + 2] == "zero") for i in (0, 4, 8)
    )
    return first, second, third


def lay(
    place: Any, turn: Any, paths: tuple[Path, Path, Path], root: Callable[[Any], Any], corrections: int = CORRECTIONS
) -> Laid:
    """Lay a template on three paths by Newton's method.

    Parameters
    ----------
    place : complex or complex128 array of shape (N,)
        Where its first joint lies about, m.
    turn : complex or complex128 array of shape (N,)
        Unit direction of its x axis, about.
    paths : three paths
        Of its joints.
    root : callable
        The square root of the board's numbers.
    corrections : int
        How many, the last one included: each doubles the digits.
    """
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
            place, turn = place + move, rotated(turn, twist / size)
            steps.append(root(dot(move, move) + twist * twist))
    total = size + paths[0].radius + paths[1].radius + paths[2].radius
    apart = (abs(gaps[0]) + abs(gaps[1]) + abs(gaps[2])) / total
    doubt = steps[1] / (steps[0] + size * NOISE)
    turn = turn * (1.0 / root(dot(turn, turn)))
    return Laid(place, turn, determinant, apart, doubt, missing, (move, twist / size))


def _size(paths: tuple[Path, Path, Path], root: Callable[[Any], Any]) -> Any:
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


def rotated(turn: Any, angle: Any) -> Any:
    """Return a unit direction turned by about `angle`, exactly so as `angle` goes to zero."""
    half = angle * 0.5
    inverse = 1.0 / (half * half + 1.0)
    return turn * ((1.0 - half * half) * inverse) + (turn * 1j) * (angle * inverse)


def _read(field: str) -> Callable[..., Any]:
    """Return the verb that reads how a template lies that is laid down: a field of `Laid`."""
    return lambda board, *marks: getattr(board._lay_template(board._operands, marks), field)


class TemplateBoard(Board):
    """The verbs of templates on boards that compute.

    Operands are where the template lies already, about: x, y of its first joint, cosine and sine of its x axis; how far
    it went astray on the way there, zero when it did not; then joint, start, radius and direction of each leg.
    """

    corrections = CORRECTIONS

    def __init__(self) -> None:
        self._templates: dict[tuple[str, ...], Laid] = {}
        self._finished: dict[tuple[str, ...], tuple[Any, Any]] = {}

    def lift_templates(self) -> None:
        """Begin with other positions."""
        self._templates, self._finished = {}, {}

    def _template(self, point: Any, *marks: Any) -> Any:
        """Mark a point through a template that is laid down; `point` is on a drawing of the link alone."""
        names = self._operands[1:]
        if names not in self._finished:
            laid = self._lay_template(names, marks)
            held = self._holds(laid.determinant, laid.apart, marks[ASTRAY], laid.missing)
            self._finished[names] = laid.finished(held)
        place, turn = self._finished[names]
        return place + turned(turn, point - marks[ASTRAY + 1])

    _template_place, _template_turn, _template_determinant = map(_read, ("place", "turn", "determinant"))
    _template_apart, _template_doubt, _template_missing = map(_read, ("apart", "doubt", "missing"))

    def _lay_template(self, names: tuple[str, ...], marks: tuple[Any, ...]) -> Laid:
        """Lay a template down once for all its points."""
        laid = self._templates.get(names)
        if laid is None:
            x, y, cosine, sine, _, *legs = marks
            place, turn = self._complex(x, y), self._complex(cosine, sine)
            paths = paths_of(legs, names[ASTRAY + 1 :])
            laid = self._templates[names] = lay(place, turn, paths, self._sqrt, self.corrections)
        return laid

    # What a board says of itself.

    _operands: tuple[str, ...]

    @staticmethod
    def _sqrt(square: Any) -> Any:
        raise NotImplementedError

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        raise NotImplementedError

    def _holds(self, determinant: Any, apart: Any, astray: Any, missing: Any) -> Any:
        raise NotImplementedError
