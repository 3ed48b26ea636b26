"""The shaky hand: the construction drawn N times over, each mark, line and reading a little off, as on paper.

Errors are millimetres of paper, so that the scale factor of each plan says what they are worth; directions err by
degrees. An error belongs to an act of the hand: a line that lies on the paper already does not err again when a length
is laid off along it, and one that is drawn elsewhere parallel to it does. What is calculated, the data, and drawings of
a link alone (which only give numbers) have no error. What is read is what the steps after it start from.

With a ruler what is read is a whole number of half millimetres, and all else follows. What is laid off is so long as it
is calculated. What is shorter than a millimetre is read in a detail drawn larger, so exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import astuple, dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import rounded
from ..board import POSITION, Program
from ..boards.arrays import ArrayBoard
from ..boards.exact import ExactBoard
from ..laws import dot
from ..names import role
from ..solved import Solved

ZERO = "zero"
Array = NDArray[Any]
Shape = int | tuple[int, ...]
Operate = Callable[..., Any]


LARGEST = {"point": 100.0, "direction": 90.0, "reading": 100.0}  # mm, degrees: the sheet, a right angle


@dataclass(frozen=True, slots=True)
class Hand:
    """Standard deviations of the errors of a hand."""

    point: float  # mm, of each coordinate of a mark, of the distance of a line from the mark through which it is drawn
    direction: float  # degrees, of a line from the direction that it should have
    reading: float  # mm, of a length read off or taken into the compass

    def __post_init__(self) -> None:
        """Refuse errors below zero, and those of which no drawing is left."""
        for name, most in LARGEST.items():
            if not getattr(self, name) >= 0.0:
                raise InputError("hand-negative", name=name)
            if getattr(self, name) > most:
                raise InputError("hand-large", name=name, most=f"{most:g}")

    def times(self, factor: float) -> Hand:
        """Return a hand with errors larger by `factor`."""
        return Hand(self.point * factor, self.direction * factor, self.reading * factor)


@dataclass(frozen=True, slots=True, eq=False)
class Hands:
    """Several hands that draw at once, `(hands, drawings)`: standard deviations as columns, shape (hands, 1)."""

    point: Array
    direction: Array
    reading: Array

    @classmethod
    def of(cls, hands: Iterable[Hand]) -> Hands:
        """Put hands together."""
        return cls(*(np.array(column)[:, None] for column in zip(*map(astuple, hands), strict=True)))


@dataclass(frozen=True, slots=True)
class Alike:
    """Errors that are the same all along the first axis, of hands or of positions, so that these can be compared."""

    random: np.random.Generator

    def standard_normal(self, size: Shape, /) -> Array:
        """Return an array of errors in standard deviations."""
        assert isinstance(size, tuple)
        return np.broadcast_to(self.random.standard_normal((1, *size[1:])), size)


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What a teacher lets pass: of a segment the larger of `mm` and its `part`, of a direction `degrees`."""

    mm: float
    part: float
    degrees: float

    def of_segment(self, millimetres: Any, sine: Any = 1.0) -> Any:
        """Return the millimetres by which a segment may miss; `sine` is that of the intersection at its end."""
        most = self.part * abs(millimetres)
        return (most if most > self.mm else self.mm) / abs(sine)


@dataclass(frozen=True, slots=True)
class _Preset:
    """A hand, the segment of the crank's velocity that goes with it (mm; None: any), and the tolerance."""

    hand: Hand
    pa: float | None
    tolerance: Tolerance


# What rulers and protractors can: a ruler with marks of 0.5 mm is read to 0.25 mm, dividers and a scale to 0.1 or
# 0.2 mm, a protractor to half a degree, set squares keep a quarter to half a degree. What departments ask: 5 % is the
# usual limit between a plan and a calculation, 3 % that of careful work, 10 % the upper one; plans drawn by a computer
# agree with the calculation to 0.01 ... 0.1 %, and are held to 0.5 %.
PRESETS: Mapping[str, _Preset] = {
    "cad": _Preset(Hand(0.03, 0.01, 0.03), None, Tolerance(0.3, 0.005, 0.2)),
    "careful": _Preset(Hand(0.1, 0.25, 0.1), 100.0, Tolerance(1.0, 0.03, 0.5)),
    "normal": _Preset(Hand(0.25, 0.5, 0.25), 80.0, Tolerance(2.0, 0.05, 1.0)),
    "lenient": _Preset(Hand(0.5, 1.0, 0.5), 50.0, Tolerance(3.0, 0.1, 2.0)),
}


def preset(name: str) -> _Preset:
    """Return a preset by its name.

    Raises InputError: with the key `hand-unknown`.
    """
    if name not in PRESETS:
        raise unknown("hand-unknown", name, PRESETS)
    return PRESETS[name]


@dataclass(frozen=True, slots=True)
class Paper:
    """A construction as it is drawn."""

    program: Program
    givens: Mapping[str, Any]  # SI: numbers, or arrays that broadcast against the shape of the drawings
    mus: Mapping[str, Any]  # scale factors by plan, value in SI per mm
    edges: Collection[str] = ()  # names of the directions along which a drafting machine draws without error
    unscaled: Collection[str] = ()  # plans in millimetres of paper themselves: what is measured there has no factor
    ends: Collection[str] = ()  # marks at which curves must come back to their axis, else they are drawn again


def paper_of(solved: Solved, mus: Mapping[str, float]) -> Paper:
    """Return the drawing of what is solved with scale factors by symbol, `mu_V`, in SI per mm."""
    by_plan = {plan: mus[symbol] for plan, symbol in solved.scale_of_plan.items()}
    return drawing_of(solved, by_plan)


def drawing_of(solved: Solved, mus: Mapping[str, float]) -> Paper:
    """Return the drawing of what is solved with scale factors by plan, in SI per mm."""
    return Paper(solved.program, solved.givens, solved.worth(mus), solved.edges, solved.on_paper, solved.ends)


class ShakyBoard(ArrayBoard):
    """Many drawings of one construction, in an array of `shape`; at steps that are not in `only` the hand is exact.

    `erred` names for each error, in order, the step at which it was made; `missed` the names that hang on an error.
    """

    def __init__(
        self, paper: Paper, hand: Hand | Hands, random: Any, shape: Shape, only: Collection[str] | None = None
    ) -> None:
        super().__init__(paper.givens, 0)
        self.codes = np.zeros(shape, np.int8)
        self.erred: list[str] = []
        self.missed: set[str] = set()
        self._hand, self._mus, self._random, self._only = hand, paper.mus, random, only
        self._edges = frozenset(paper.edges)
        self._steps = {step.name: step for step in paper.program}
        self._drawn = frozenset(name for step in paper.program if step.verb != "calc" for name in step.operands)

    def operation(self, verb: str, law: str) -> Operate:
        """Return what does a step, with the errors of a hand."""
        exact = super().operation(verb, law)
        shaky = SHAKY.get(verb)
        return exact if shaky is None else partial(shaky, self, exact)

    def perform(self, operate: Operate, name: str, operands: tuple[str, ...]) -> None:
        """Make `name` with the operation of a step; note what hangs on an error."""
        super().perform(operate, name, operands)
        if not self.missed.isdisjoint(operands):
            self.missed.add(name)

    # Errors: numbers of the standard normal distribution, times what the hand and the scale make of them.

    def _error(self, size: Any) -> Any:
        """Return an error of this step for every drawing, zero for a hand that never errs so."""
        if (np.ndim(size) == 0 and not size) or (self._only is not None and self._name not in self._only):
            return 0.0
        self.missed.add(self._name)
        self.erred.append(self._name)
        return self._random.standard_normal(self.codes.shape) * size

    def _point(self, mark: str = "") -> Any:
        """Return the error of a mark, or of a line's distance from it, on the plan of `mark`, else of this step."""
        return self._error(self._hand.point * self._mu(mark))

    def _reading(self, mark: str = "") -> Any:
        return self._error(self._hand.reading * self._mu(mark))

    def _direction_error(self) -> Any:
        return self._error(self._hand.direction * (math.pi / 180.0))

    def _mu(self, mark: str) -> Any:
        return self._mus[role(mark or self._name).plan]

    def _off(self, mark: Any) -> Any:
        """Miss a mark in both coordinates."""
        x, y = self._point(), self._point()
        return mark if _none(x) and _none(y) else mark + self._complex(x, y)

    def _swung(self, direction: Any) -> Any:
        """Miss a direction."""
        return swung(direction, self._direction_error())

    def _parallel(self, direction: Any, name: str) -> Any:
        """Draw a line parallel to the direction `name`, which a drafting machine has for the sheet's edges."""
        return direction if name in self._edges else self._swung(direction)

    def _aside(self, mark: Any, direction: Any) -> Any:
        """Draw a line along `direction` a little aside of the mark."""
        error = self._point()
        return mark if _none(error) else mark + (direction * 1j) * error

    # What is on the paper, and what is not.

    def _apart_by_name(self, *marks: str) -> bool:
        """Whether two marks are not letters of the same one."""
        found = [*marks]
        for i, mark in enumerate(marks):
            while (step := self._steps.get(mark)) is not None and step.verb == "same":
                found[i] = mark = step.operands[0]
        return found[0] != found[1]

    # Templates: Newton's method looks at the paths of all legs at once.

    def _lay_template(self, names: tuple[str, ...], marks: tuple[Any, ...]) -> Any:
        """Lay a template on arcs and lines each of which misses a little, the same for all its points."""
        if names not in self._templates:
            missed = list(marks)
            for leg in (5, 9, 13):  # of each: joint, start, radius, direction
                if names[leg + 2] == ZERO:
                    missed[leg + 1] = self._aside(missed[leg + 1], missed[leg + 3])
                else:
                    missed[leg + 2] = missed[leg + 2] + self._point()
            marks = tuple(missed)
        return super()._lay_template(names, marks)


def _none(error: Any) -> bool:
    return isinstance(error, float) and error == 0.0


def swung(direction: Any, angle: Any) -> Any:
    """Return a direction turned by a small angle, the very same for none."""
    return direction if _none(angle) else direction * np.cos(angle) + (direction * 1j) * np.sin(angle)


# The verbs as a hand does them: (board, the exact operation, operands).


def _place(b: ShakyBoard, exact: Operate, x: Any, y: Any) -> Any:
    aside = role(b._name).hidden or b._operands == (ZERO, ZERO)  # a place on a drawing of the link alone; the origin
    return exact(x, y) if aside else b._off(exact(x, y))


def _turn(b: ShakyBoard, exact: Operate, angle: Any) -> Any:
    """Lay off an angle; the edge of the sheet is there, and a direction that only a calculation needs is not drawn."""
    direction = exact(angle)
    drawn = b._operands != (ZERO,) and b._name in b._drawn and not role(b._name).hidden
    return b._swung(direction) if drawn else direction


def _incline(b: ShakyBoard, exact: Operate, direction: Any, slope: Any) -> Any:
    """Lay off an angle from a line; along the line itself there is none to lay off."""
    found, of = exact(direction, slope), b._steps.get(b._operands[1])
    parallel = of is not None and of.verb == "turn" and of.operands == (ZERO,)
    return found if parallel or role(b._name).hidden else b._swung(found)


def _direction(b: ShakyBoard, exact: Operate, start: Any, end: Any, length: Any) -> Any:
    """Lay the ruler on two marks; their distance as it is drawn is not that of the data."""
    found = exact(start, end, length)
    return found if b.missed.isdisjoint(b._operands) else found * (1.0 / np.sqrt(dot(found, found)))


def _normal(b: ShakyBoard, exact: Operate, vector: Any) -> Any:
    """Turn a whole plan, mark by mark; the normal to a line is only drawn where it is needed."""
    found = exact(vector)
    return b._off(b._swung(found)) if "." in b._operands[0] else found


def _lay(b: ShakyBoard, exact: Operate, start: Any, direction: Any, length: Any) -> Any:
    line = b._steps.get(b._operands[1])  # of directions only those of links lie on the paper already, on the mechanism
    if role(b._name).plan != POSITION or (line is not None and line.verb == "normal"):
        direction = b._parallel(direction, b._operands[1])
    return b._off(exact(start, direction, length))


def _chain(b: ShakyBoard, exact: Operate, start: Any, vector: Any) -> Any:
    return b._off(exact(start, b._swung(vector)))


def _meet(b: ShakyBoard, exact: Operate, p: Any, u: Any, q: Any, w: Any) -> Any:
    u, w = b._parallel(u, b._operands[1]), b._parallel(w, b._operands[3])
    p, q = b._aside(p, u), b._aside(q, w)
    b._sine_of = {}  # each crossing has lines of its own
    return exact(p, u, q, w)


def _arc(b: ShakyBoard, exact: Operate, centre: Any, radius: Any, q: Any, w: Any, side: Any) -> Any:
    w = b._swung(w)
    centre, q = b._off(centre), b._aside(q, w)
    return exact(centre, radius + b._reading(), q, w, side)


def _arcs(b: ShakyBoard, exact: Operate, first: Any, radius: Any, second: Any, other: Any, side: Any) -> Any:
    radius, other = radius + b._reading(), other + b._reading()
    return exact(b._off(first), radius, b._off(second), other, side)


def _tangent(b: ShakyBoard, exact: Operate, centre: Any, point: Any, offset: Any, *rest: Any) -> Any:
    """Lay the ruler on a mark and on the circle, or on another mark where the circle has no radius."""
    if b._operands[2] != ZERO:
        offset = offset + b._reading()
    return exact(b._off(centre), b._off(point), offset, *rest)


def _mark(b: ShakyBoard, exact: Operate, *operands: Any) -> Any:
    return b._off(exact(*operands))


def _similar(b: ShakyBoard, exact: Operate, start: Any, end: Any, along: Any, across: Any) -> Any:
    """Draw a similar figure: its side is there, the line to the third point is not."""
    point, error = exact(start, end, along, across), b._direction_error()
    return b._off(point if _none(error) else start + swung(point - start, error))


def _measure(b: ShakyBoard, exact: Operate, start: Any, end: Any) -> Any:
    found, (first, second) = exact(start, end), b._operands
    # both marks on a drawing of a link alone
    alone = all(role(mark).hidden and (mark not in b._steps or role(mark).plan == POSITION) for mark in (first, second))
    if alone or not b._apart_by_name(first, second):
        return found
    return abs(found + b._reading(first))


def _read(b: ShakyBoard, exact: Operate, tail: Any, tip: Any) -> Any:
    """Read a vector, its length and its direction: the tip is seen a little off, seen from the tail."""
    found, (first, second) = exact(tail, tip), b._operands
    if not b._apart_by_name(first, second):
        return found
    x, y = b._reading(first), b._reading(first)
    return found if _none(x) and _none(y) else found + b._complex(x, y)


def _moment(b: ShakyBoard, exact: Operate, force: Any, at: Any, about: Any) -> Any:
    """Draw the force's line through its point, parallel to the plan, and read the arm from the other point."""
    _, mark, centre = b._operands
    if not b._apart_by_name(mark, centre):
        return exact(force, at, about)
    found = exact(b._swung(force), at, about)
    beside, read = b._point(mark), b._reading(mark)
    return found if _none(beside) and _none(read) else found + np.sqrt(dot(force, force)) * (beside + read)


SHAKY: Mapping[str, Operate] = {
    "place": _place,
    "turn": _turn,
    **dict.fromkeys(("incline", "decline"), _incline),
    "direction": _direction,
    "normal": _normal,
    **dict.fromkeys(("lay", "back"), _lay),
    "chain": _chain,
    "meet": _meet,
    "arc": _arc,
    "arcs": _arcs,
    "tangent": _tangent,
    **dict.fromkeys(("template", "divide"), _mark),
    "similar": _similar,
    **dict.fromkeys(("measure", "distance"), _measure),
    "angle": lambda b, exact, first, second: exact(first, second) + b._direction_error(),
    "read": _read,
    "moment": _moment,
}


def draw(
    paper: Paper, hand: Hand | Hands, random: Any, drawings: Shape = 1000, only: Collection[str] | None = None
) -> ShakyBoard:
    """Draw a construction so many times with a shaky hand: the same seed of `random` draws the same.

    `random` is a generator of numpy, or what has its `standard_normal`.
    `only` has the names of the only steps at which the hand errs; all when left out.
    """
    board = ShakyBoard(paper, hand, random, drawings, only)
    with np.errstate(invalid="ignore", divide="ignore"):
        paper.program.run(board)
    return board


GRADUATION = 0.5  # mm between the marks of a ruler
SHORT = 1.0  # mm
READ = ("read", "measure", "distance")
WRITTEN = ("V", "a", "omega", "epsilon", "F", "M", "R", "G", "P", "m", "J")  # kinds of quantities
DIGITS = 4  # with which they are written down; balancing ones, which are compared, have one more
BALANCING = ("bal", "bal_lever")
LAID = ("lay", "back", "chain")


def read_by_ruler(mm: float) -> float:
    """Return a length on paper as it is read, mm."""
    return round(mm / GRADUATION) * GRADUATION if mm >= SHORT else mm


class RulerBoard(ExactBoard):
    """One position whose vectors, distances and arms are read off paper with a ruler."""

    def __init__(self, paper: Paper) -> None:
        super().__init__(paper.givens)
        self._mus = paper.mus
        self._steps = {step.name: step for step in paper.program}

    def operation(self, verb: str, law: str) -> Callable[..., Any]:
        """Return what does a step, with the ruler where it measures."""
        exact = super().operation(verb, law)
        if verb == "direction":
            return self._along
        if verb == "moment":
            return partial(self._by_arm, exact)
        if verb in READ:
            return partial(self._by_ruler, exact)
        return partial(self._rounded, exact) if verb == "calc" else exact

    def _rounded(self, found: Callable[..., Any], *operands: Any) -> Any:
        """Go on with the digits of a quantity that one writes down."""
        value, name = found(*operands), role(self._name)
        size = self._sqrt(dot(value, value))
        if name.kind == "arm":  # of a reaction about a point, measured before its size is known
            return value * self._share(size, self._operands[-1])
        if name.kind not in WRITTEN or not 0.0 < size < math.inf:
            return value
        decimals = DIGITS + (name.of in BALANCING) - 1 - math.floor(math.log10(size))
        return value * (rounded(size, decimals) / size)

    def _along(self, start: Any, end: Any, _: Any) -> Any:
        """Return the direction of a line, which is as it is drawn however long the line is read to be."""
        between = self._read(start, end)
        return between * (1.0 / self._sqrt(dot(between, between)))

    def _by_ruler(self, exact: Callable[..., Any], start: Any, end: Any) -> Any:
        """Read a vector, which keeps its direction, or a distance; what was laid off is known."""
        found, (first, second) = exact(start, end), self._operands
        step = self._steps.get(second)
        laid = step is not None and step.verb in LAID and step.operands[0] == first
        if laid or all(role(mark).hidden for mark in (first, second)):
            return found
        return found * self._share(self._sqrt(dot(found, found)), first)

    def _by_arm(self, exact: Callable[..., Any], force: Any, at: Any, about: Any) -> Any:
        """Read the arm of a force about a point."""
        moment, size = exact(force, at, about), self._sqrt(dot(force, force))
        return moment * self._share(abs(moment) / size, self._operands[2]) if size > 0.0 else moment

    def _share(self, length: float, mark: str) -> float:
        """Return by what a length on the plan of a mark is to be multiplied."""
        mm = length / self._mus[role(mark).plan]
        return read_by_ruler(mm) / mm if mm >= SHORT else 1.0
