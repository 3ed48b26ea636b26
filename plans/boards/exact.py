"""The exact board: the steps on Python floats and complex numbers, for one position; `arrays` has the board for many.

Both do the same operations in the same order, only ones that are rounded alike everywhere (no product of two complex
numbers, which numpy fuses; no modulus by `hypot`): N positions at once equal one at a time to the last bit.

The protractor gives sine and cosine that are rounded alike on any machine, without numpy. An angle is the nearest of
1024 marks around the circle and a rest of at most 0.18 degrees, for which three terms of the series do. Sums, products
and a table round alike everywhere; marks at multiples of 90 degrees are exact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from ..board import Board, Prepared, Program
from ..laws import LAWS, cross, dot
from .template import ASTRAY, CLOSED, CORRECTIONS, FOLDED, Laid, lay, turned

MARKS = 1024
TURN = 2.0 * math.pi
STEP = TURN / MARKS
COARSE = math.ldexp(round(math.ldexp(STEP, 40)), -40)  # so few bits that its product with a number of marks is exact
FINE = STEP - COARSE + 2.4492935982947064e-16 / MARKS  # with what 2 pi is more than TURN
PER_RADIAN = 1.0 / STEP
ROUND = 1.5 * 2.0**52  # added and taken away again, it rounds to a whole number; added, it puts it into the last bits
FARTHEST = 1e6  # radians; full turns are taken off a larger angle, which is not known any better


@cache
def graduation() -> tuple[list[float], list[float]]:
    """Return cosine and sine of the marks, correct to a unit in the last place."""
    sines = [math.sin(mark * COARSE) + mark * FINE * math.cos(mark * COARSE) for mark in range(MARKS // 8 + 1)]
    cosines = [math.cos(mark * COARSE) - mark * FINE * math.sin(mark * COARSE) for mark in range(MARKS // 8 + 1)]
    quarter = sines + cosines[-2::-1]
    half = quarter + quarter[-2:0:-1]
    sine = half + [-value for value in half]
    return sine[MARKS // 4 :] + sine[: MARKS // 4], sine


SINGULAR = 1e-13  # sine of the angle of two lines below which they count as parallel
SMALL = math.sin(math.radians(20.0))  # sine of an angle at which lines meet so flatly that a drawing loses much
ILL = 1e-3  # sine below which three digits and more are lost: the position is called ill-conditioned
TANGENT = 4 * 2.0**-52  # part of r^2 within which an arc touches a line

Status = Literal["ok", "ill-conditioned", "singular", "no-assembly"]
STATUSES: tuple[Status, ...] = ("ok", "ill-conditioned", "singular", "no-assembly")
NAN = float("nan")
Marks = Sequence[tuple[Any, ...]]  # statuses with their conditions, and what tells the sine or the gap of one position
Rarely = tuple[Marks, Any]  # and the value to go on with
# how numbers, by the least and the most of them, must lie to a bound to be left alone; never where a number is none
ORDERS = {
    "above": "{least} > {bound}",
    "at least": "{least} >= {bound}",
    "at most": "{most} <= {bound}",
    "beyond": "({least} >= {bound} or {most} <= -{bound})",
    "within": "({least} > -{bound} and {most} < {bound})",
}


def calm_by(least: str, most: str, functions: Mapping[str, Any] = {}) -> dict[str, Callable[[Any, Any], bool]]:
    """Return for each of `ORDERS` what tells whether a `value` lies so to a `bound`; the ends may call functions."""
    sources = {name: said.format(least=least, most=most, bound="bound") for name, said in ORDERS.items()}
    return {name: eval(f"lambda value, bound: {source}", dict(functions)) for name, source in sources.items()}


_CALM = calm_by("value", "value")


@dataclass(frozen=True, slots=True)
class Trouble:
    """Where a construction fails: the step's name, its sine (of two lines) or its gap in metres (of an arc)."""

    status: Status
    name: str
    sine: float = 0.0
    gap: float = 0.0


POLE = 0j
RIGHT = 2.0**-50  # component of a unit direction that is rounding: the direction is at a multiple of 90 degrees


def _seen(field: str) -> Callable[..., Any]:
    """Return the verb that tells how a template lies that is laid down: a field of `Laid`."""
    return lambda board, *where: getattr(board._lay_template(board._operands, where), field)


class ExactBoard(Board):
    """One position on Python numbers: `values` by name, and `trouble`, the first step that cannot be done.

    What hangs on a failed step becomes NaN; what does not is computed all the same. The thresholds go with the
    precision of the numbers.
    """

    parallel, touching, closed, folded, corrections = SINGULAR, TANGENT, CLOSED, FOLDED, CORRECTIONS

    def __init__(self, givens: Mapping[str, Any]) -> None:
        self.values: dict[str, Any] = {"zero": 0.0, "one": 1.0, **givens}
        self.sines: dict[str, float] = {}
        self.trouble: Trouble | None = None
        self._name = self._failed = ""
        self._operands: tuple[str, ...] = ()
        self._begin()

    def _begin(self) -> None:
        """Forget what was found for other positions: sines by two directions, templates that are laid down."""
        self._sine_of: dict[tuple[str, str], Any] = {}
        self._templates: dict[tuple[str, ...], Laid] = {}
        self._finished: dict[tuple[str, ...], tuple[Any, Any]] = {}

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Do the step with numbers."""
        self.perform(self.operation(verb, law), name, operands)

    def operation(self, verb: str, law: str) -> Callable[..., Any]:
        """Return what computes a step."""
        operate: Callable[..., Any] = LAWS[law] if law else getattr(self, "_" + verb)
        return operate

    def perform(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> None:
        """Make `name` with the operation of a step."""
        values = self.values
        self._name, self._operands = name, operands
        value = operate(*[values[operand] for operand in operands])
        if type(value) is not complex:
            value = value + 0.0  # zero has no sign, and an array of one number becomes that number
        elif value is not POLE:
            value += POLE
        values[name] = value

    def follow(self, program: Program) -> None:
        """Do all steps of a program."""
        self.do(program.prepared)

    def do(self, steps: Iterable[Prepared]) -> None:
        """Do steps: what `step` does with each, without looking operations up again and again."""
        values = self.values
        operations: dict[tuple[str, str], Callable[..., Any]] = {}
        for name, operands, operation, taken in steps:
            operate = operations.get(operation)
            if operate is None:
                operate = operations[operation] = self.operation(*operation)
            self._name, self._operands = name, operands
            value = operate(*taken(values)) if taken else operate(*[values[operand] for operand in operands])
            if type(value) is not complex:
                value = value + 0.0
            elif value is not POLE:
                value += POLE
            values[name] = value

    # What differs between one position and many.

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return math.sqrt(square) if square >= 0.0 else NAN

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        return complex(real, imag)

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        return value if where else other

    @staticmethod
    def _remainder(angle: Any) -> Any:
        return math.fmod(angle, TURN) if math.isfinite(angle) else NAN

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        """Return cosine and sine of a whole number of the protractor's marks, to which `ROUND` is added."""
        if rounded != rounded:
            return NAN, NAN
        cosines, sines = graduation()
        mark = int(rounded - ROUND) % MARKS
        return cosines[mark], sines[mark]

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Any:
        """Return whether numbers lie so that nothing is the matter: to `bound`, or to it times the largest `of`."""
        if of is not None:
            bound = bound * of
        return _CALM[order](value, bound * bound if squared else bound)

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        """Return the first of the operands of a check, or what it is worth where not all is calm."""
        if all(calm):
            return operands[0]
        marks, result = rare()
        for status, here, *measure in reversed(marks):  # the worst comes last
            if here and status != "ill-conditioned":
                self._failed, size = self._name, measure[0]() if measure else 0.0
                failed = Trouble(status, self._name, *((size, 0.0) if status == "singular" else (0.0, size)))
                self.trouble = self.trouble or failed
                break
        return result

    def _note_sine(self, part: Any, whole: Any = None) -> None:
        """Note the sine of two lines, or of a line and an arc: by the square of half a chord, and its radius."""
        if whole is None:
            self.sines[self._name] = abs(part)
        elif self._failed is not self._name:
            self.sines[self._name] = math.sqrt(part) / whole if whole else 0.0

    def _note_pins(self, distance: Any, size: Any) -> None:
        """Note how near two joints come that settle a direction."""
        if distance > self.parallel * size:
            self.sines[self._name] = min(self.sines[self._name], float(distance / size))

    # What is looked at, written once for all boards: how a number must lie to be left alone; else what statuses that
    # sets, with a sine or a gap that tells how much is wrong, and what to go on with.

    def _near(self, angle: Any) -> Any:
        """Return an angle without the full turns that only cost digits."""
        calm = self._calm(angle, "within", FARTHEST)
        return self._look(
            "near", (angle,), (calm,), lambda: ((), self._choose(abs(angle) < FARTHEST, angle, self._remainder(angle)))
        )

    def _upright(self, component: Any) -> Any:
        """Return a component of a unit direction without the rounding at a multiple of 90 degrees."""
        size = abs(component)
        calm = self._calm(size, "above", RIGHT)
        return self._look(
            "upright", (component, size), (calm,), lambda: ((), self._choose(size <= RIGHT, 0.0, component))
        )

    def _lines_sine(self, sine: Any) -> Any:
        """Look at the sine of two lines; parallel lines do not meet."""

        def rare() -> Rarely:
            size = abs(sine)
            flat = size < self.parallel
            return [("ill-conditioned", size < ILL), ("singular", flat, lambda: sine)], self._choose(flat, NAN, sine)

        self._note_sine(sine)
        return self._look("sine", (sine,), (self._calm(sine, "beyond", ILL),), rare)

    def _half_chord(self, radius: Any, distance: Any, first: Any, second: Any) -> Any:
        """Half the chord that a circle cuts from a line at `distance` from its centre, factored, not to cancel."""
        square = (radius - distance) * (radius + distance)
        return self._sqrt(self._reaches(square, radius, distance, first.real, first.imag, second.real, second.imag))

    def _reaches(self, square: Any, radius: Any, distance: Any, *places: Any) -> Any:
        """Return the square of the half chord; an arc that does not reach the line cuts no chord.

        One that crosses it by no more than rounding touches it: there is no angle to draw anything with. The distance
        is rounded as the coordinates of the `places` are from which it comes.
        """

        def rare() -> Rarely:
            touching = self.touching * radius * (radius + sum(map(abs, places)))
            out = square < -touching
            half = self._choose(out, NAN, self._choose(square <= touching, 0.0, square))
            marks: Marks = [
                ("ill-conditioned", square < ILL * ILL * radius * radius),
                ("no-assembly", out, lambda: distance - radius),
            ]
            return marks, half

        calm = self._calm(square, "at least", ILL, radius, squared=True)
        half = self._look("reaches", (square, radius, distance, *places), (calm,), rare)
        self._note_sine(half, radius)
        return half

    def _assembles(self, product: Any, first: Any, second: Any, base: Any, total: Any, *places: Any) -> Any:
        """Return Heron's product, factored, not to cancel; arcs that do not meet make no triangle.

        Links in line but for rounding are in line, and pins together but for rounding coincide.
        """
        double = first * second * 2.0

        def rare() -> Rarely:
            rounded = self.touching * (total + sum(map(abs, places)))
            touching, together = rounded * double, base <= rounded
            out = product < -touching * total
            ill = product < ILL * double * (ILL * double)
            area = self._choose(out | together, NAN, self._choose(product <= touching * base, 0.0, product))
            marks: Marks = [
                ("ill-conditioned", ill),
                ("singular", together),
                ("no-assembly", out, lambda: max(base - total, abs(first - second) - base)),
            ]
            return marks, area

        calm = self._calm(product, "above", ILL, double, squared=True)
        area = self._look("assembles", (product, first, second, base, total, *places), (calm,), rare)
        self._note_sine(area, double)
        return area

    def _apart(self, distance: Any) -> Any:
        """Look at the distance of two joints, which settle no direction when they coincide."""

        def rare() -> Rarely:
            together = distance == 0.0
            return [("singular", together)], self._choose(together, NAN, distance)

        return self._look("apart", (distance,), (self._calm(distance, "above", 0.0),), rare)

    def _clear(self, distance: Any, size: Any) -> Any:
        """Return the distance of two joints, which must not be rounding beside the whole mechanism."""

        def rare() -> Rarely:
            together = distance <= self.parallel * size
            marks: Marks = [("ill-conditioned", distance < ILL * size), ("singular", together)]
            self._note_pins(distance, size)
            return marks, self._choose(together, NAN, distance)

        return self._look("clear", (distance, size), (self._calm(distance, "at least", ILL, size),), rare)

    def _bears(self, size: Any, moment: Any) -> Any:
        """Return the size of a force to divide its moment by; a moment without a force is a couple: it has no arm."""

        def rare() -> Rarely:
            return (), self._choose(size == 0.0, self._choose(moment == 0.0, 1.0, NAN), size)

        return self._look("bears", (size, moment), (self._calm(size, "above", 0.0),), rare)

    def _holds(self, determinant: Any, apart: Any, astray: Any, missing: Any) -> Any:
        """Return the determinant of the legs that hold a template: they must reach it, and must not concur."""
        size, astray = abs(determinant), abs(astray)

        def rare() -> Rarely:
            reached, folded = astray == 0.0, size < self.folded
            apart_here = (reached & (folded | (apart <= self.closed))) == 0.0
            marks: Marks = [
                ("ill-conditioned", size < ILL),
                ("singular", reached & folded, lambda: determinant),
                ("no-assembly", apart_here, lambda: astray or missing),
            ]
            return marks, self._choose(folded | apart_here, NAN, determinant)

        self._note_sine(determinant)
        calm = [self._calm(size, "at least", ILL), self._calm(apart, "at most", self.closed)]
        calm.append(self._calm(astray, "at most", 0.0))
        return self._look("holds", (determinant, apart, astray, missing), tuple(calm), rare)

    # The verbs, the same for one and for many.

    def _place(self, x: Any, y: Any) -> Any:
        in_origin = isinstance(x, float) and isinstance(y, float) and x == y == 0.0
        return POLE if in_origin else self._complex(x, y)

    def _pole(self) -> Any:
        return POLE

    def _turn(self, angle: Any) -> Any:
        angle = self._near(angle)
        rounded = angle * PER_RADIAN + ROUND
        marks = rounded - ROUND
        rest = (angle - marks * COARSE) - marks * FINE
        cosine, sine = self._graduation(rounded)
        square = rest * rest
        less = square * (square * (1.0 / 24.0) - 0.5)  # cosine of the rest, less one
        more = rest + (rest * square) * (square * (1.0 / 120.0) - (1.0 / 6.0))  # its sine
        x, y = cosine + (cosine * less - sine * more), sine + (sine * less + cosine * more)
        return self._complex(self._upright(x), self._upright(y))

    def _direction(self, start: Any, end: Any, length: Any) -> Any:
        return (end - start) * (1.0 / length)

    def _normal(self, vector: Any) -> Any:
        return vector * 1j

    def _lay(self, start: Any, direction: Any, length: Any) -> Any:
        return self._chain(start, direction * length)

    def _back(self, start: Any, direction: Any, length: Any) -> Any:
        return self._chain(start, direction * -length)

    def _chain(self, start: Any, vector: Any) -> Any:
        return vector if start is POLE else start + vector

    def _meet(self, p: Any, u: Any, q: Any, w: Any) -> Any:
        # plans of velocities and accelerations meet along the same two directions
        key = self._operands[1], self._operands[3]
        sine = self._sine_of.get(key)
        if sine is None:
            sine = self._sine_of[key] = self._lines_sine(cross(u, w))
        found = self._chain(p, u * (cross(self._read(p, q), w) / sine))
        if q is POLE:  # however far the way was, the point lies on the line through the pole to its own last digit
            return found - (w * 1j) * cross(w, found)
        return found

    def _arc(self, centre: Any, radius: Any, q: Any, w: Any, side: Any) -> Any:
        to_centre = self._read(q, centre)
        half = self._half_chord(radius, abs(cross(w, to_centre)), centre, q)
        return self._chain(q, w * (dot(w, to_centre) + side * half))

    def _arcs(self, first: Any, radius: Any, second: Any, other: Any, side: Any) -> Any:
        between = self._read(first, second)
        square = dot(between, between)
        base, total, less = self._sqrt(square), radius + other, radius - other
        product = (total + base) * (total - base) * (base + less) * (base - less)  # 16 times the squared area
        places = first.real, first.imag, second.real, second.imag
        root = self._sqrt(self._assembles(product, radius, other, base, total, *places))
        calm = self._calm(square, "above", 0.0)  # else one in the place of zero: what is divided is known to fail
        divisor = self._look("divisor", (square,), (calm,), lambda: ((), self._choose(square == 0.0, 1.0, square)))
        half = 0.5 / divisor  # parts of the way between the centres: along it, and across
        along, across = (square + less * total) * half, side * root * half
        return self._chain(first, between * along + (between * 1j) * across)

    def _tangent(self, centre: Any, point: Any, offset: Any, side: Any, size: Any) -> Any:
        between = self._read(centre, point)
        distance = self._distance(centre, point)
        part = side * self._half_chord(distance, abs(offset), centre, point)
        inverse = 1.0 / self._clear(distance, size)
        along = between * inverse
        return along * (part * inverse) - (along * 1j) * (offset * inverse)

    def _incline(self, direction: Any, slope: Any) -> Any:
        return direction * slope.real + (direction * 1j) * slope.imag

    def _decline(self, direction: Any, slope: Any) -> Any:
        return direction * slope.real - (direction * 1j) * slope.imag

    def _measure(self, start: Any, end: Any) -> Any:
        return self._apart(self._distance(start, end))

    def _distance(self, start: Any, end: Any) -> Any:
        between = self._read(start, end)
        return self._sqrt(dot(between, between))

    def _angle(self, first: Any, second: Any) -> Any:
        import numpy as np  # its arc tangent may differ from the C library's in the last bit, as its cosine

        angle = np.arctan2(cross(first, second), dot(first, second))
        return angle if np.ndim(angle) else float(angle)

    def _similar(self, start: Any, end: Any, along: Any, across: Any) -> Any:
        base = self._read(start, end)
        return self._chain(start, base * along + (base * 1j) * across)

    def _divide(self, start: Any, end: Any, part: Any, whole: Any) -> Any:
        return start + (end - start) * (part / whole)

    def _same(self, mark: Any) -> Any:
        return mark

    def _read(self, tail: Any, tip: Any) -> Any:
        return tip if tail is POLE else tip - tail

    def _moment(self, force: Any, at: Any, about: Any) -> Any:
        return cross(self._read(about, at), force)

    def _arm(self, moment: Any, force: Any) -> Any:
        return abs(moment) / self._bears(self._sqrt(dot(force, force)), moment)

    def _template(self, point: Any, *where: Any) -> Any:
        """Mark a point through a template that is laid down; `point` is on a drawing of the link alone."""
        names = self._operands[1:]
        if names not in self._finished:
            laid = self._lay_template(names, where)
            held = self._holds(laid.determinant, laid.apart, where[ASTRAY], laid.missing)
            self._finished[names] = laid.finished(held)
        place, turn = self._finished[names]
        return place + turned(turn, point - where[ASTRAY + 1])

    _template_place, _template_turn, _template_determinant = map(_seen, ("place", "turn", "determinant"))
    _template_apart, _template_doubt, _template_missing = map(_seen, ("apart", "doubt", "missing"))

    def _lay_template(self, names: tuple[str, ...], where: tuple[Any, ...]) -> Laid:
        """Lay a template down once for all its points."""
        if names not in self._templates:
            self._templates[names] = lay(where, names, self._sqrt, self._complex, self.corrections)
        return self._templates[names]

    @property
    def status(self) -> Status:
        """Status of the position."""
        if self.trouble is not None:
            return self.trouble.status
        return "ill-conditioned" if min(self.sines.values(), default=1.0) < ILL else "ok"


class PlainBoard(ExactBoard):
    """A board of other numbers than Python's, which are kept as the operations give them, zeros with their signs."""

    def perform(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> None:
        """Make `name` with the operation of a step."""
        values = self.values
        self._name, self._operands = name, operands
        values[name] = operate(*[values[operand] for operand in operands])


def run(program: Program, givens: Mapping[str, Any]) -> ExactBoard:
    """Run `program` for one position; `givens` are floats in SI."""
    board = ExactBoard(givens)
    board.follow(program)
    return board
