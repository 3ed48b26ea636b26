"""GeoGebra's construction, evaluated: what its manual says of commands, operators and functions, and nothing else.

Where lines and circles cross, the manual promises no order; `flipped` takes the other one.
"""

import cmath
import math
import re
import zipfile
from collections.abc import Callable, Mapping
from io import BytesIO
from typing import Any

from lxml import etree

from kulman.tests.support.readback import cross

LABEL = re.compile(r"[^\W\d_][^\W_]*'*(_\{[^{}\W_]+\}|_[^\W_])?")
TOKEN = re.compile(
    rf"""\s*(?:(?P<text>"[^"]*")|(?P<number>\d+(?:\.\d+)?(?:E[+-]?\d+)?)|(?P<name>{LABEL.pattern})"""
    r"|(?P<sign>>=|<=|==|[-+*/^(),<>\[\]{}?]))"
)
CONSTANTS = {"e", "i", "pi", "π", "ℯ", "ί"}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "x": lambda at: at.real,
    "y": lambda at: at.imag,
    "abs": abs,
    "sqrt": lambda value: math.sqrt(value) if value >= 0.0 else math.nan,
    "cos": math.cos,
    "sin": math.sin,
    "atan2": math.atan2,
    "floor": lambda value: math.floor(value) if math.isfinite(value) else math.nan,
}
RESERVED = CONSTANTS | {
    *FUNCTIONS,
    "z",
    "xAxis",
    "yAxis",
    "tan",
    "exp",
    "ln",
    "ld",
    "lg",
    "log",
    "sgn",
    "round",
    "ceil",
}
Line = tuple[complex, complex]  # a point, a direction
Circle = tuple[complex, float]


def divided(value: Any, by: float) -> Any:
    return value / by if by else value * math.nan


def meet(first: Line, second: Line) -> complex:
    return first[0] + first[1] * divided(cross(second[0] - first[0], second[1]), cross(first[1], second[1]))


def crossings(circle: Circle, other: Any) -> tuple[complex, complex]:
    centre, radius = circle
    if isinstance(other[1], float):  # the line through both crossings
        between, far = other[0] - centre, other[1]
        along = divided(abs(between) ** 2 + radius**2 - far**2, 2.0 * abs(between))
        unit = divided(between, abs(between))
        foot, unit = centre + along * unit, unit * 1j
    else:
        unit = divided(other[1], abs(other[1]))
        foot = other[0] + unit * ((centre - other[0]) * unit.conjugate()).real
        along = abs(foot - centre)
    half = FUNCTIONS["sqrt"]((radius - along) * (radius + along))
    return foot - half * unit, foot + half * unit


class Evaluator:
    """A file of GeoGebra; `at` returns the values of its objects with some free numbers changed."""

    def __init__(self, data: bytes) -> None:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            assert archive.namelist() == ["geogebra.xml"]
            self.root = etree.fromstring(archive.read("geogebra.xml"))
        assert (self.root.tag, self.root.get("format")) == ("geogebra", "5.0")
        self.steps: list[tuple[str, Callable[[dict[str, Any], bool], Any]]] = []
        self.elements: dict[str, Any] = {}
        self.free: list[str] = []
        (construction,) = self.root.findall("construction")
        made = ""
        for entry in construction:
            if entry.tag == "element":
                made = self._element(entry, made)
            else:
                assert not made, f"{made} is made and nowhere shown"
                made = self._made(entry)
        assert not made

    def at(self, changed: Mapping[str, float], flipped: bool = False) -> dict[str, Any]:
        """Return all values; the free ones as they stand, or as they are changed."""
        values: dict[str, Any] = {}
        for label, make in self.steps:
            values[label] = changed[label] if label in changed else make(values, flipped)
        return values

    def _element(self, entry: Any, made: str) -> str:
        label = entry.get("label")
        assert LABEL.fullmatch(label), label
        assert label not in RESERVED, label
        assert label not in self.elements, f"{label} twice"
        self.elements[label] = entry
        if made:
            assert made == label
            return ""
        self.free.append(label)
        if entry.get("type") == "point":
            x, y, z = (float(entry.find("coords").get(axis)) for axis in "xyz")
            assert z == 1.0
            self.steps.append((label, lambda values, flipped: complex(x, y)))
        else:
            assert entry.get("type") in ("numeric", "angle")
            value = float(entry.find("value").get("val"))
            self.steps.append((label, lambda values, flipped: value))
        return ""

    def _made(self, entry: Any) -> str:
        if entry.tag == "expression":
            label, make = entry.get("label"), self.parsed(entry.get("exp"))
            assert label not in self.elements
            self.steps.append((label, make))
            return label
        assert entry.tag == "command"
        inputs = [self.parsed(text) for _, text in sorted(entry.find("input").attrib.items())]
        name, (label,) = entry.get("name"), entry.find("output").attrib.values()
        self.steps.append(
            (label, lambda values, flipped: command(name, [one(values, flipped) for one in inputs], flipped))
        )
        return label

    def parsed(self, text: str) -> Callable[[dict[str, Any], bool], Any]:
        """Return what an expression calculates, whose labels must have been made."""
        tokens, at = [], 0
        while text[at:].strip():
            found = TOKEN.match(text, at)
            assert found, f"{text[at:]!r} in {text!r}"
            tokens.append((found.lastgroup, found[found.lastgroup]))
            at = found.end()
        parser = Parser([(kind, value) for kind, value in tokens], self.elements)
        make = parser.compared()
        assert not parser.tokens, f"{parser.tokens} left of {text!r}"
        return make


def command(name: str, inputs: list[Any], flipped: bool) -> Any:
    match name, *inputs:
        case "Line", at, direction:
            return at, direction
        case "Circle", centre, radius:
            return centre, float(radius)
        case "Intersect", first, second:
            return meet(first, second)
        case "Intersect", first, second, index:
            return crossings(first, second)[(int(index) - 1) ^ flipped]
        case "Vector", tail, tip:
            return tip - tail
        case "Segment", tail, tip:
            return abs(tip - tail)
        case "OrthogonalVector", vector:
            return vector * 1j
        case "If", condition, yes, no:
            return math.nan if condition is None else yes if condition else no
        case "Distance", one, other:
            return abs(one - other)
        case "Length", vector:
            return abs(vector)
        case "Element", items, place:
            return items[int(place) - 1]
    raise AssertionError(f"command {name} of {len(inputs)}")


class Parser:
    def __init__(self, tokens: list[tuple[str, str]], known: Mapping[str, Any]) -> None:
        self.tokens, self.known = tokens, known

    def take(self, *signs: str) -> str:
        """Take the next token if it is one of some signs."""
        if self.tokens and self.tokens[0][0] == "sign" and self.tokens[0][1] in signs:
            return self.tokens.pop(0)[1]
        return ""

    def compared(self) -> Any:
        first = self.sum()
        sign = self.take(">", ">=", "<", "<=", "==")
        if not sign:
            return first
        second = self.sum()
        tell = {">": "__gt__", ">=": "__ge__", "<": "__lt__", "<=": "__le__", "==": "__eq__"}[sign]

        def make(values: Any, flipped: bool) -> Any:
            a, b = float(first(values, flipped)), float(second(values, flipped))
            return None if math.isnan(a) or math.isnan(b) else getattr(a, tell)(b)

        return make

    def sum(self) -> Any:
        first = self.product()
        while sign := self.take("+", "-"):
            first = self._joined(sign, first, self.product())
        return first

    def product(self) -> Any:
        first = self.signed()
        while sign := self.take("*", "/"):
            first = self._joined(sign, first, self.signed())
        return first

    def signed(self) -> Any:
        if self.take("-"):
            inner = self.signed()
            return lambda values, flipped: -inner(values, flipped)
        base = self.atom()
        return self._joined("^", base, self.signed()) if self.take("^") else base

    @staticmethod
    def _joined(sign: str, first: Any, second: Any) -> Any:
        def make(values: Any, flipped: bool) -> Any:
            a, b = first(values, flipped), second(values, flipped)
            if isinstance(a, str) or isinstance(b, str):
                assert sign == "+"
                return f"{a}{b}"
            assert not (isinstance(b, complex) and sign in "/^"), "divided by a vector"
            if isinstance(a, complex) and isinstance(b, complex):
                assert sign in "+-*"
                if sign == "*":
                    return (a * b.conjugate()).real
            elif isinstance(a, complex) or isinstance(b, complex):
                assert sign in "*/", "a number and a point"
            return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: divided(a, b)}.get(
                sign, lambda: a**b
            )()

        return make

    def listed(self, end: str) -> list[Any]:
        items = [self.compared()]
        while self.take(","):
            items.append(self.compared())
        assert self.take(end) == end
        return items

    def atom(self) -> Any:
        kind, token = self.tokens.pop(0)
        if kind == "number":
            return lambda values, flipped: float(token)
        if kind == "text":
            return lambda values, flipped: token[1:-1]
        if kind == "name":
            return self._named(token)
        if token == "{":
            items = self.listed("}")
            return lambda values, flipped: [item(values, flipped) for item in items]
        assert token == "(", token
        items = self.listed(")")
        if len(items) == 1:
            return items[0]
        x, y = items
        return lambda values, flipped: complex(x(values, flipped), y(values, flipped))

    def _named(self, name: str) -> Any:
        if name in FUNCTIONS and self.take("("):
            items, do = self.listed(")"), FUNCTIONS[name]
            return lambda values, flipped: do(*(item(values, flipped) for item in items))
        if self.take("["):
            items = self.listed("]")
            return lambda values, flipped: command(name, [item(values, flipped) for item in items], flipped)
        assert name in self.known, f"{name} is not made yet"
        return lambda values, flipped: values[name]


def is_near(got: Any, expected: Any, size: float, part: float) -> bool:
    """Whether a value is that which is expected, or neither is defined."""
    if cmath.isnan(expected):
        return cmath.isnan(got)
    return abs(got - expected) <= part * size
