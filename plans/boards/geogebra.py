"""A recorded program as objects of GeoGebra: verbs become its commands, laws the expressions that they print.

Marks are points in mm of a drawing: those of the mechanism about an origin, those of a plan about its pole, which is
free. Lengths, velocities, forces stay numbers and vectors in SI; scale factors lead from them to the drawing and back.
Where lines and arcs cross twice, the object takes the crossing on its own side: GeoGebra numbers them as it pleases.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import partialmethod
from itertools import chain, count
from typing import Any, NamedTuple

from ..board import POINTS, POSITION, Program
from ..names import ORIGIN, role
from .trace import Real, TracingBoard, Vector

# names that stand for something else in GeoGebra: coordinates, constants, functions, axes
_WORDS = """x y z e i pi π ί ℯ abs sgn sqrt cbrt exp ln ld lg log cos sin tan sec csc cot cosh sinh tanh acos asin atan
atan2 floor ceil round random gamma arg alt real imaginary conjugate xAxis yAxis zAxis true false"""
RESERVED = frozenset(_WORDS.split())
_SIGN = re.compile(r"\\[a-z]+")  # of markup: the bar of a vector
_SCRIPT = re.compile(r"[_^]\{([^{}]*)\}|[_^](.)")
_STEM = re.compile(r"[^\W\d]+'*")
_LEFT = re.compile(r"\W|_")  # what an index does not hold
LONGEST = 160  # characters of an expression, where parts of it come again
SUM, PRODUCT, ATOM = 1, 2, 3  # how strongly an expression holds together
OPERATORS = {"add": ("+", SUM), "subtract": ("-", SUM), "multiply": ("*", PRODUCT), "divide": ("/", PRODUCT)}
COMPARISONS = {"less": "<", "less_equal": "<=", "greater": ">", "greater_equal": ">=", "equal": "=="}
FUNCTIONS = {  # what is true is one, what is not is zero
    "absolute": "abs({0})",
    "sqrt": "sqrt({0})",
    "arctan2": "atan2({0}, {1})",
    "floor_divide": "floor(({0}) / ({1}))",
    **{name: f"If[{{0}} {sign} {{1}}, 1, 0]" for name, sign in COMPARISONS.items()},
    "logical_and": "(({0}) * ({1}))",
    "logical_or": "If[{0} + {1} > 0.5, 1, 0]",
    "where": "If[{0} > 0.5, {1}, {2}]",
    "power": "(({0})^({1}))",
}
UNDEFINED = "(0 / 0)"
NOTHING = "0", ATOM
Text = tuple[str, int]  # of an expression, and how strongly it holds together


class Item(NamedTuple):
    """An object of GeoGebra: its label, its type, what the program calls it (nothing: a helper), and what makes it.

    It is made by an expression, by a `command` with inputs, or by nothing: then it is free.
    """

    label: str
    kind: str
    name: str = ""
    said: str = ""
    command: str = ""
    inputs: tuple[str, ...] = ()


class Labels:
    """Labels that GeoGebra takes, each once."""

    def __init__(self) -> None:
        self._taken = set(RESERVED)

    def take(self, wanted: str, beside: str = "") -> str:
        """Return a label like `wanted`, a symbol as markup writes it; one that is taken has `beside` in its index.

        >>> labels = Labels()
        >>> labels.take("a^{n}_{BA}"), labels.take("e", "45"), labels.take("e", "45"), labels.take("S3")
        ('a_{nBA}', 'e_{45}', 'e_{452}', 'S_{3}')
        """
        wanted = _SIGN.sub("", wanted)
        scripts = "".join(one or other for one, other in _SCRIPT.findall(wanted))
        letters = re.sub(r"[^\w']|_", "", _SCRIPT.sub("", wanted).replace("′", "'").replace("″", "''"))
        stem = _STEM.match(letters)
        head, rest = (stem[0], letters[stem.end() :]) if stem else ("k", letters)
        index, beside = (_LEFT.sub("", text) for text in (rest + scripts, beside))
        tried = (f"{index}{beside}{at if at > 1 or not beside else ''}" for at in count(1))
        labels = (head + (f"_{{{one}}}" if one else "") for one in chain((index,), tried))
        label = next(label for label in labels if label not in self._taken)
        self._taken.add(label)
        return label


class _Mark(NamedTuple):
    """A point of a drawing: its label, the label of the drawing's origin, SI units in a millimetre."""

    label: str
    origin: str
    mu: Any


class GeoGebraBoard(TracingBoard):
    """Notes what a program does as objects of GeoGebra.

    Parameters
    ----------
    constants : mapping of str to float
        Givens that stay as they are.
    free : mapping of str to tuple of str and float
        Labels of the numbers that may be changed, by the givens that follow from them, and a unit of it in SI.
    scales : mapping of str to str
        Labels of the scale factors, SI units in a millimetre, by plan.
    label : callable
        Gives a name of the program a label; the second argument says whether it is seen.
    helper : callable
        Gives a label with a letter to what the program does not name.
    """

    def __init__(
        self,
        constants: Mapping[str, float],
        free: Mapping[str, tuple[str, float]],
        scales: Mapping[str, str],
        label: Callable[[str, bool], str],
        helper: Callable[[str], str],
    ) -> None:
        super().__init__(constants, ())
        self.items: list[Item] = []
        self.labels: dict[str, str] = {}  # of what has been made, by the program's names
        self._label, self._helper, self._scales = label, helper, scales
        self._marks: dict[str, _Mark] = {}
        self._drawn: dict[str, _Mark] = {}
        self._lines: dict[tuple[str, str], str] = {}
        self._named: dict[int, str] = {}
        self._poles: dict[str, str] = {}
        for name, (text, si) in free.items():
            self.values[name] = self.trace.given(text) * si
            self.labels[name] = text

    def write(self, program: Program) -> None:
        """Note a program; the origin of the mechanism's plan comes first."""
        places = program.which(("place",))
        origin = next((s.name for s in places if s.operands == ("zero", "zero") and not self._local(s.name)), "")
        self._poles[POSITION] = self._put("point", origin) if origin else self._help("point", "O")
        if origin:
            self._marks[origin] = self._mark_of(origin)
        program.run(self)

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Note a step: as commands where its verb has some, else as what its law or its verb calculates."""
        if name in self._marks:
            return
        draw = None if law else getattr(self, f"_draw_{verb}", None)
        if draw is None or draw(name, *operands) is NotImplemented:
            self._calculate(verb, name, operands, law)

    def drawn(self, name: str) -> bool:
        """Whether a vector stands between points, in mm of its drawing, not in SI."""
        return name in self._drawn

    def origin(self, plan: str) -> str:
        """Return the label of the origin of a plan, of its pole."""
        return self._poles[plan]

    # what has been made

    @staticmethod
    def _local(name: str) -> bool:
        """Whether a mark that is placed stands on a drawing of its link alone, which is not drawn, and in SI."""
        return role(name).hidden and role(name).kind != ORIGIN

    def _mark_of(self, name: str) -> _Mark:
        plan = role(name).plan
        return _Mark(self.labels[name], self._poles[plan], self._mu(plan))

    def _mu(self, plan: str) -> Real:
        return self.trace.given(self._scales[plan])

    def _put(self, kind: str, name: str, said: str = "", command: str = "", inputs: Iterable[str] = ()) -> str:
        seen = not role(name).hidden and (kind != "vector" or command == "Vector")
        label = self.labels[name] = self._label(name, seen)
        self.items.append(Item(label, kind, name, said, command, tuple(inputs)))
        return label

    def _help(self, kind: str, letter: str, said: str = "", command: str = "", inputs: Iterable[str] = ()) -> str:
        label = self._helper(letter)
        self.items.append(Item(label, kind, "", said, command, tuple(inputs)))
        return label

    def _point(self, name: str, said: str, command: str = "", inputs: Iterable[str] = ()) -> None:
        self._put("point", name, said, command, inputs)
        self._marks[name] = self._mark_of(name)

    def _operand(self, name: str, absolute: bool) -> Any:
        """Return what a name stands for in SI; a point from anywhere where only differences count."""
        mark = self._marks.get(name)
        if mark is None:
            return self.values[name]
        x, y = (self.trace.given(f"{axis}({mark.label})") for axis in "xy")
        if absolute and mark.origin:
            x, y = (part - self.trace.given(f"{axis}({mark.origin})") for axis, part in zip("xy", (x, y), strict=True))
        return Vector(x * mark.mu, y * mark.mu)

    def _on_drawing(self, name: str) -> Vector:
        """Return a point as it is drawn, in mm."""
        return self._vector(self._marks[name].label)

    def _vector(self, label: str, mu: Any = 1.0) -> Vector:
        return Vector(*(self.trace.given(f"{axis}({label})") * mu for axis in "xy"))

    # verbs

    def _calculate(self, verb: str, name: str, operands: tuple[str, ...], law: str) -> None:
        self._name, self._operands = name, operands
        absolute = bool(law) or verb == "template"
        result = self.operation(verb, law)(*(self._operand(operand, absolute) for operand in operands))
        if verb in POINTS:
            self._mark_at(name, result)
        else:
            self._note(name, result)

    def _note(self, name: str, result: Any) -> None:
        """Note a number or a vector in SI."""
        if isinstance(result, Vector | complex):
            label = self._put("vector", name, self._told_vector(result)[0])
            self.values[name] = result if isinstance(result, complex) else self._vector(label)
        else:
            label = self._put("numeric", name, self._told(result)[0])
            self.values[name] = self.trace.given(label) if isinstance(result, Real) else result

    def _mark_at(self, name: str, at: Any) -> None:
        """Mark a point that has been calculated in SI."""
        plan = role(name).plan
        mu = self._mu(plan)
        self._point(name, f"{self._poles[plan]} + {self._told_vector(_over(at, mu), SUM)}")

    def _draw_place(self, name: str, x: str, y: str) -> None:
        at = self._complex(self.values[x], self.values[y])
        if not self._local(name):
            return self._mark_at(name, at)
        label = self._put("point", name, f"({self._told(at.real)[0]}, {self._told(at.imag)[0]})")
        self._marks[name] = _Mark(label, "", 1.0)
        return None

    def _draw_pole(self, name: str) -> None:
        self._poles[role(name).plan] = self._put("point", name)
        self._marks[name] = self._mark_of(name)

    def _draw_turn(self, name: str, angle: str) -> Any:
        if not isinstance(self.values[angle], Real):
            return NotImplemented
        text = self._told(self.values[angle])[0]
        self.values[name] = self._vector(self._put("vector", name, f"(cos({text}), sin({text}))"))
        return None

    def _draw_direction(self, name: str, start: str, end: str, length: str) -> None:
        a, b = self._marks[start], self._marks[end]
        part = self._told_part(a.mu / self.values[length])
        self.values[name] = self._vector(self._put("vector", name, f"{part} * ({b.label} - {a.label})"))

    def _draw_normal(self, name: str, vector: str) -> Any:
        if vector in self._marks:  # the plan of velocities, turned
            return self._mark_at(name, self._operand(vector, True) * 1j)
        label = self._put("vector", name, command="OrthogonalVector", inputs=(self.labels[vector],))
        before = self.values[vector]
        self.values[name] = before * 1j if isinstance(before, complex) else self._vector(label)
        return None

    def _draw_lay(self, name: str, start: str, direction: str, length: str, sense: float = 1.0) -> None:
        part = self._told_part(self.values[length] * sense / self._marks[start].mu)
        self._point(name, f"{self._marks[start].label} + {part} * {self.labels[direction]}")

    _draw_back = partialmethod(_draw_lay, sense=-1.0)

    def _draw_chain(self, name: str, start: str, vector: str) -> None:
        a, laid = self._marks[start], self._drawn.get(vector)
        if laid is not None:
            part = "" if laid.mu.place == a.mu.place else f"{self._told_part(laid.mu / a.mu)} * "
            return self._point(name, f"{a.label} + {part}{laid.label}")
        return self._point(name, f"{a.label} + {self._told_part(1.0 / a.mu)} * {self.labels[vector]}")

    def _draw_divide(self, name: str, start: str, end: str, part: str, whole: str) -> None:
        a, b = self._marks[start].label, self._marks[end].label
        self._point(name, f"{a} + {self._told_part(self.values[part] / self.values[whole])} * ({b} - {a})")

    def _draw_similar(self, name: str, start: str, end: str, along: str, across: str) -> None:
        at = self._similar(self._on_drawing(start), self._on_drawing(end), self.values[along], self.values[across])
        self._point(name, self._told_vector(at)[0])

    def _draw_same(self, name: str, mark: str) -> None:
        self._point(name, f"{self._marks[mark].label} + (0, 0)")

    def _draw_read(self, name: str, tail: str, tip: str) -> None:
        a, b = self._marks[tail], self._marks[tip]
        label = self._put("vector", name, command="Vector", inputs=(a.label, b.label))
        self._drawn[name] = _Mark(label, "", b.mu)
        self.values[name] = self._vector(label, b.mu)

    def _draw_measure(self, name: str, start: str, end: str) -> None:
        a, b = self._marks[start], self._marks[end]
        part = f"{self._told_part(a.mu)} * " if isinstance(a.mu, Real) else ""
        self.values[name] = self.trace.given(self._put("numeric", name, f"{part}Distance[{a.label}, {b.label}]"))

    _draw_distance = _draw_measure

    def _draw_tangent(self, name: str, centre: str, point: str, offset: str, side: str, size: str) -> None:
        mu = self._marks[centre].mu
        offset_mm, size_mm = (self.values[given] / mu for given in (offset, size))
        self._name, self._operands = name, (centre, point, offset, side, size)
        ends = self._on_drawing(centre), self._on_drawing(point)
        offset_mm = 0.0 if offset == "zero" else offset_mm
        self._note(name, self._tangent(*ends, offset_mm, self.values[side], size_mm))

    def _draw_meet(self, name: str, p: str, u: str, q: str, w: str) -> None:
        self._point(name, "", "Intersect", (self._line(p, u), self._line(q, w)))

    def _line(self, mark: str, direction: str) -> str:
        key = self._marks[mark].label, self.labels[direction]
        if key not in self._lines:
            self._lines[key] = self._help("line", "g", command="Line", inputs=key)
        return self._lines[key]

    def _circle(self, centre: str, radius: str) -> str:
        mark = self._marks[centre]
        inputs = mark.label, self._told(self.values[radius] / mark.mu)[0]
        return self._help("conic", "c", command="Circle", inputs=inputs)

    def _draw_arc(self, name: str, centre: str, radius: str, q: str, w: str, side: str) -> None:
        crossed = self._circle(centre, radius), self._line(q, w)
        first, second = self._crossings(crossed)
        way = self._vector(first) - self._vector(second)
        ahead = self.values[w].real * way.real + self.values[w].imag * way.imag
        self._choose_crossing(name, ahead * self.values[side], first, second)

    def _draw_arcs(self, name: str, first: str, radius: str, second: str, other: str, side: str) -> None:
        one, two = self._crossings((self._circle(first, radius), self._circle(second, other)))
        a, b = self._on_drawing(first), self._on_drawing(second)
        base, way = b - a, self._vector(one) - a
        aside = base.real * way.imag - base.imag * way.real
        self._choose_crossing(name, aside * self.values[side], one, two)

    def _crossings(self, crossed: tuple[str, str]) -> tuple[str, str]:
        first, second = (self._help("point", "Q", command="Intersect", inputs=(*crossed, n)) for n in "12")
        return first, second

    def _choose_crossing(self, name: str, sign: Real, first: str, second: str) -> None:
        self._point(name, "", "If", (f"{self._told(sign)[0]} >= 0", first, second))

    # printing

    def _told_part(self, number: Any) -> str:
        """Return a number that stands as a factor before something."""
        return _held(self._told(number), PRODUCT)

    def _told(self, number: Real | float) -> Text:
        """Return the expression of a number; parts of a long one that come again get labels of their own."""
        if not isinstance(number, Real):
            return _written(number)
        self._name_parts(number.place)
        return _turned(self._text(number.place), number.negative)

    def _told_vector(self, vector: Any, level: int = 0) -> Any:
        """Return the expression of a vector: by vectors where its parts are alike, else by its coordinates."""
        parts = [part if isinstance(part, Real) else self.trace.real(part) for part in (vector.real, vector.imag)]
        for part in parts:
            self._name_parts(part.place)
        whole = self._alike(parts[0].place, parts[1].place) if parts[0].negative == parts[1].negative else None
        if whole is None:
            x, y = (self._told(part)[0] for part in (vector.real, vector.imag))
            whole = f"({x}, {y})", ATOM
        elif parts[0].negative:
            whole = _turned(whole, True)
        return _held(whole, level) if level else whole

    def _alike(self, x: int, y: int) -> Text | None:
        """Return a vector whose parts are calculated in the same way, each from the same part of another vector."""
        if x in self._named or y in self._named:
            return None
        one, other = self.trace.entries[x], self.trace.entries[y]
        if one.operation != other.operation:
            return None
        if one.operation == "given":
            alike = one.data[:2] == "x(" and other.data[:2] == "y(" and one.data[2:] == other.data[2:]
            return (one.data[2:-1], ATOM) if alike else None
        if one.operation == "multiply":
            same = [place for place in one.operands if place in other.operands]
            if len(same) != 1:
                return None
            rest = (next(place for place in entry.operands if place != same[0]) for entry in (one, other))
            inner = self._alike(*rest)
            return inner and (f"{_held(self._text(same[0]), PRODUCT)} * {_held(inner, ATOM)}", PRODUCT)
        if one.operation == "divide" and one.operands[1] == other.operands[1]:
            inner = self._alike(one.operands[0], other.operands[0])
            return inner and (f"{_held(inner, PRODUCT)} / {_held(self._text(one.operands[1]), ATOM)}", PRODUCT)
        return None

    def _text(self, place: int) -> Text:
        """Return the expression of an entry of the trace."""
        if place in self._named:
            return self._named[place], ATOM
        operation, operands, data = self.trace.entries[place]
        if operation == "given":
            return data, ATOM
        if operation == "constant":
            return _written(data)
        if operation == "rare":  # what is looked at closely fails by itself where nothing takes its place
            return self._text(operands[0] if data.marks else data.result)
        if operation == "negative":
            return _turned(self._text(operands[0]), True)
        texts = [self._text(operand) for operand in operands]
        if operation in OPERATORS:
            if NOTHING in texts:
                return _without(operation, *texts)
            sign, level = OPERATORS[operation]
            right = ATOM if texts[1][0].startswith("-") else level + (sign in "-/")
            return f"{_held(texts[0], level)} {sign} {_held(texts[1], right)}", level
        if operation == "power" and texts[0][0] == UNDEFINED:  # nothing to the power of zero is one
            return f"If[{texts[1][0]} > 0.5, {UNDEFINED}, 1]", ATOM
        return FUNCTIONS[operation].format(*(text for text, _ in texts)), ATOM

    def _name_parts(self, root: int) -> None:
        """Give labels to parts of an expression that come again, or are long, where it is too long."""
        counts: dict[int, int] = {}
        waiting = [root]
        while waiting:
            place = waiting.pop()
            counts[place] = counts.get(place, 0) + 1
            if counts[place] == 1 and place not in self._named:
                waiting += self._parts_of(place)
        lengths: dict[int, int] = {}
        for place in sorted(counts):
            lengths[place] = 8 + sum(lengths[part] for part in self._parts_of(place)) if place not in self._named else 8
        if lengths[root] <= LONGEST:
            return
        lengths = {}
        for place in sorted(counts):
            parts = () if place in self._named else self._parts_of(place)
            lengths[place] = 8 + sum(lengths[part] for part in parts)
            if parts and place != root and (counts[place] > 1 or lengths[place] > LONGEST):
                self._named[place] = self._help("numeric", "k", self._text(place)[0])
                lengths[place] = 8

    def _parts_of(self, place: int) -> tuple[int, ...]:
        entry = self.trace.entries[place]
        if entry.operation == "rare":
            return (entry.operands[0],) if entry.data.marks else (entry.data.result,)
        return entry.operands


def _without(operation: str, first: Text, second: Text) -> Text:
    """Return a sum, a difference, a product or a quotient one of whose parts is nothing."""
    if operation in ("multiply", "divide"):
        return NOTHING if operation == "multiply" or first == NOTHING else (f"{_held(first, PRODUCT)} / 0", PRODUCT)
    if second == NOTHING:
        return first
    return _turned(second, operation == "subtract")


def _over(vector: Any, mu: Real) -> Vector:
    return Vector(vector.real / mu, vector.imag / mu)


def _held(text: Text, level: int) -> str:
    """Return an expression as part of one that holds so strongly."""
    return text[0] if text[1] >= level else f"({text[0]})"


def _turned(text: Text, negative: bool) -> Text:
    return NOTHING if text == NOTHING else (f"-{_held(text, PRODUCT)}", SUM) if negative else text


def _written(value: float) -> Text:
    """Return a number as GeoGebra writes it; e would be a number there."""
    if value != value:
        return UNDEFINED, ATOM
    return _turned((repr(abs(value)).upper().removesuffix(".0"), ATOM), value < 0.0)
