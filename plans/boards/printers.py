"""A trace, printed: as straight NumPy for chunks of positions, as plain Python for one, as a loop over many.

What is printed makes the same sums, products and roots in the same order, so that all printers agree to the last bit.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, ClassVar

import numpy as np

from .arrays import cosine_of, mark_of, sine_of
from .exact import MARKS, ORDERS, ROUND, graduation
from .trace import Calm, Entry, Rare, Trace

DEEPEST = 12  # brackets within brackets
Output = tuple[int, bool]  # place of a number, and whether its negative is wanted
# what one operation is in Python; operands that stand there twice are named before
SIGNS = {"add": "+", "subtract": "-", "multiply": "*", "divide": "/", "floor_divide": "//", "power": "**"}
SIGNS |= {"less": "<", "less_equal": "<=", "greater": ">", "greater_equal": ">=", "equal": "=="}
SIGNS |= {"logical_and": "and", "logical_or": "or"}
PYTHON = {
    **{name: f"({{0}} {sign} {{1}})" for name, sign in SIGNS.items()},
    "negative": "(-{0})",
    "absolute": "abs({0})",
    "sqrt": "(sqrt({0}) if {0} >= 0.0 else nan)",
    "root": "sqrt({0})",  # of what is a square
    "where": "({1} if {0} else {2})",
    "fmod": "(fmod({0}, {1}) if isfinite({0}) else nan)",
    "arctan2": "float(arctan2({0}, {1}))",
    "cos": "cos({0})",
    "sin": "sin({0})",
    "mark": f"(int({{0}} - {ROUND!r}) & {MARKS - 1} if {{0}} == {{0}} else {MARKS})",
    "cosine": "cosines[{0}]",
    "sine": "sines[{0}]",
}
_TWICE = {name for name, said in PYTHON.items() if said.count("{0}") > 1}
# what the source of `Chunked` calls
ARRAYS: dict[str, Any] = {
    **{name: getattr(np, name) for name in PYTHON if hasattr(np, name)},
    "copyto": np.copyto,
    "int8": np.int8,
    "maximum": np.maximum,
    "least": np.minimum.reduce,
    "most": np.maximum.reduce,
    "nan": math.nan,
    "mark": mark_of,
    "cosine": cosine_of,
    "sine": sine_of,
}


def _lies(orders: Mapping[str, str], calm: Calm, ends: tuple[str, str], of: str) -> str:
    """Return whether a number, by its least and its most, lies so that nothing is the matter, as a source says it."""
    bound = number(calm.bound)
    if of:
        bound = f"({bound} * {of})" + " ** 2" * calm.squared
    return orders[calm.order].format(least=ends[0], most=ends[1], bound=bound)


def in_order(trace: Trace, wanted: Iterable[int]) -> list[int]:
    """Return the entries that `wanted` and the statuses need, constants apart, each as late as it is asked for."""
    entries, roots = trace.entries, {*wanted}
    roots |= {i for i, e in enumerate(entries) if e.operation == "rare" and e.data.marks}
    done = {place for place, entry in enumerate(entries) if entry.operation == "constant"}
    order: list[int] = []
    for root in sorted(roots):
        waiting = [root]
        while waiting:
            place = waiting[-1]
            first = [operand for operand in entries[place].operands if operand not in done]
            if first:
                waiting += reversed(first)
                continue
            waiting.pop()
            if place not in done:
                done.add(place)
                order.append(place)
    return order


@dataclass(frozen=True)
class Plain:
    """The program of a trace for one position, as source of Python.

    The function it defines takes the givens by name, in a mapping, and returns the code of the status and a result.
    """

    trace: Trace
    order: Sequence[int]
    outputs: Collection[int]

    operations: ClassVar[Mapping[str, str]] = PYTHON
    orders: ClassVar[Mapping[str, str]] = ORDERS
    given: ClassVar[str] = "given[{name}]"
    new: ClassVar[str] = "{0} = {1}"
    again: ClassVar[str] = "{0} = {1}"
    unless: ClassVar[str] = "if not ({0}):"
    worse: ClassVar[str] = "if {0} and code < {1}: code = {1}"
    end: ClassVar[tuple[str, ...]] = ()
    both: ClassVar[str] = " and "
    never: ClassVar[str] = "False"

    def source(self, function: str, result: str, code: int = 0) -> str:
        """Return the source of a function of the givens by name that returns a code and a result."""
        return _defined(function, ("given",), [*self.lines(code), f"return code, {result}"])

    def lines(self, code: int = 0) -> Iterator[str]:
        """Print what makes the outputs, without indent."""
        yield self.new.format("code", code)
        for place in self.order:
            entry = self.trace.entries[place]
            if entry.operation == "rare":
                yield from self._look(place, entry)
            elif entry.operation in ("whole", "second"):
                raise TypeError("a step that is more than arithmetic")
            elif entry.operation == "given":
                yield self.new.format(f"v{place}", self.given.format(place=place, name=json.dumps(entry.data)))
            elif place in self._named:
                yield self.new.format(f"v{place}", self._expression(place))

    def value(self, place: int) -> str:
        """Return what stands for a number: a constant, a name, or the expression where it is used once."""
        entry = self.trace.entries[place]
        if entry.operation == "constant":
            return number(entry.data)
        return f"v{place}" if place in self._named else self._expression(place)

    def _expression(self, place: int) -> str:
        entry = self.trace.entries[place]
        if entry.operation == "sqrt" and self._is_square(entry.operands[0]):
            return self.operations["root"].format(self.value(entry.operands[0]))
        return self.operations[entry.operation].format(*map(self.value, entry.operands))

    def _look(self, place: int, entry: Entry) -> Iterator[str]:
        rare: Rare = entry.data
        yield self.new.format(f"v{place}", self.value(entry.operands[0]))
        yield self.unless.format(self.both.join(map(self._calm, rare.calm)) or self.never)
        for inner in rare.block:
            if self.trace.entries[inner].operation != "constant":
                yield "    " + self.new.format(f"v{inner}", self._expression(inner))
        for code, condition in rare.marks:
            yield "    " + self.worse.format(self.value(condition), code)
        yield "    " + self.again.format(f"v{place}", self.value(rare.result))
        yield from self.end

    def _calm(self, calm: Calm) -> str:
        value = self.value(calm.place)
        return _lies(self.orders, calm, (value, value), "" if calm.of is None else self.value(calm.of))

    @cached_property
    def _named(self) -> frozenset[int]:
        """Places that have names: used twice, looked at, deep, or wanted."""
        entries = self.trace.entries
        uses = Counter(operand for place in self.order for operand in entries[place].operands)
        named, depth = {*self.outputs}, dict[int, int]()
        for place in self.order:
            entry = entries[place]
            if entry.operation == "rare":
                named |= {place, *entry.operands, *entry.data.block}
            elif entry.operation == "given" or uses[place] > 1:
                named.add(place)
            elif entry.operation in _TWICE and not self._is_square(entry.operands[0]):
                named.add(entry.operands[0])
            depth[place] = 1 + max((depth.get(o, 0) for o in entry.operands if o not in named), default=0)
            if depth[place] > DEEPEST:
                named.add(place)
        return frozenset(named)

    def _is_square(self, place: int) -> bool:
        """Whether a number is a square, or a sum of squares: it has a root, or is none."""
        entry = self.trace.entries[place]
        if entry.operation == "add":
            return all(map(self._is_square, entry.operands))
        return entry.operation == "multiply" and entry.operands[0] == entry.operands[1]


def _defined(name: str, parameters: Iterable[str], lines: Iterable[str]) -> str:
    """Return the source of a function of Python."""
    return "\n".join([f"def {name}({', '.join(parameters)}):", *(f"    {line}" for line in lines), ""])


def compiled(source: str, name: str, names: Mapping[str, Any]) -> Callable[..., Any]:
    """Return the function of that name that a source defines, which calls nothing but `names`."""
    space = dict(names)
    exec(compile(source, f"<{name}>", "exec"), space)
    function: Callable[..., Any] = space[name]
    return function


@cache
def plain_names() -> dict[str, Any]:
    """Return what the source of `Plain` calls; the protractor's table has no number behind its marks."""
    cosines, sines = graduation()
    functions = {name: getattr(math, name) for name in ("sqrt", "cos", "sin", "fmod", "isfinite")}
    tables = {"cosines": [*cosines, math.nan], "sines": [*sines, math.nan]}
    # the arc tangent of the C library may differ in the last bit
    return {**functions, **tables, "arctan2": np.arctan2, "nan": math.nan, "inf": math.inf}


def number(value: float) -> str:
    """Return a number as both languages write it."""
    if math.isfinite(value):
        return repr(float(value))
    return "nan" if value != value else "inf" if value > 0.0 else "-inf"


@dataclass(frozen=True)
class _Loop(Plain):
    """The same for many positions: a loop over arrays `g...` of givens and `out...` of results that numba compiles."""

    shared: Collection[int]  # places of what is the same at all positions

    given = "g{place}[i]"

    def loop(self, results: Sequence[str]) -> str:
        """Return the source of a function of the codes, the arrays of givens, what is shared, and those of results."""
        arrays = [f"g{place}" for place in self.order if self.trace.entries[place].operation == "given"]
        outputs = [f"out{index}" for index in range(len(results))]
        lines = [*self.lines(), *(f"{out}[i] = {result}" for out, result in zip(outputs, results, strict=True))]
        lines += ["if code > codes[i]: codes[i] = code"]
        parameters = ["codes", *arrays, *(f"v{place}" for place in self.shared), *outputs]
        return _defined("loop", parameters, ["for i in range(codes.size):", *("    " + line for line in lines)])

    @cached_property
    def _named(self) -> frozenset[int]:
        return super()._named | {*self.shared}


@dataclass(frozen=True)
class Chunked:
    """The program of a trace for chunks of positions, as source of Python with the functions of NumPy.

    What depends on no array is done once, on numbers; the rest goes through few buffers, so that a chunk stays in the
    cache: what nothing needs any more hands its own on.
    """

    trace: Trace
    arrays: Collection[str]  # givens that are arrays
    outputs: Sequence[Output]  # what is kept of every position

    @cached_property
    def order(self) -> list[int]:
        """All entries that are needed, constants apart."""
        return in_order(self.trace, [place for place, _ in self.outputs])

    @cached_property
    def varying(self) -> frozenset[int]:
        """Entries that are other ones at each position."""
        found: set[int] = set()
        for place in self.order:
            entry = self.trace.entries[place]
            varies = entry.data in self.arrays if entry.operation == "given" else not found.isdisjoint(entry.operands)
            if varies or entry.operation == "whole":
                found.add(place)
        return frozenset(found)

    @cached_property
    def each(self) -> list[int]:
        """What is done for every chunk, in order."""
        return [place for place in self.order if place in self.varying]

    @cached_property
    def shared(self) -> list[int]:
        """What the chunks share: entries that are done once, and constants."""
        needed = (o for place in self.each for o in self.trace.entries[place].operands if o not in self.varying)
        return list(dict.fromkeys((*needed, *(place for place, _ in self.outputs if place not in self.varying))))

    @property
    def computed(self) -> list[int]:
        """What the chunks share, constants apart."""
        return [place for place in self.shared if self.trace.entries[place].operation != "constant"]

    @cached_property
    def _buffers(self) -> tuple[Mapping[int, int], int]:
        """The buffer of each entry, and how many there are; first operands hand theirs on last: they are used first."""
        entries = self.trace.entries
        last = {operand: place for place in self.each for operand in entries[place].operands}
        found: dict[int, int] = {}
        free: list[int] = []
        count = 0
        for place in self.each:
            entry = entries[place]
            if entry.operation == "given" or self._is_looked_at_given(place):  # it is read where it lies
                continue
            dying = [o for o in dict.fromkeys(reversed(entry.operands)) if o in found and last[o] == place]
            # while a number is looked at, what it is looked at with must stay
            kept = [o for o in dying if o != entry.operands[0]] if entry.operation == "rare" else []
            free += [found[o] for o in dying if o not in kept]
            if not free:
                free.append(count)
                count += 1
            found[place] = free.pop()
            free += [found[o] for o in kept]
            if place not in last:
                free.append(found[place])
        return found, count

    def _is_looked_at_given(self, place: int) -> bool:
        entry = self.trace.entries[place]
        return entry.operation == "rare" and self.trace.entries[entry.operands[0]].operation == "given"

    @property
    def buffers(self) -> int:
        """How many buffers there are."""
        return self._buffers[1]

    @cached_property
    def given(self) -> dict[int, str]:
        """Places and names of the givens that are arrays, in the order in which `chunk` takes them."""
        entries = self.trace.entries
        return {place: entries[place].data for place in self.each if entries[place].operation == "given"}

    def once(self) -> str:
        """Return the source of `once(given) -> (code, shared)`, for a mapping of numbers by name."""
        plain = Plain(self.trace, [place for place in self.order if place not in self.varying], {*self.shared})
        return plain.source("once", f"[{', '.join(map(plain.value, self.shared))}]")

    def chunk(self) -> str:
        """Return the source of `chunk(codes, given, shared, buffers, outputs)`."""
        unpacked = {
            "given": [f"g{place}" for place in self.given],
            "shared": [f"s{place}" for place in self.shared],
            "buffers": [f"b{index}" for index in range(self.buffers)],
        }
        lines = [f"{', '.join(names)}, = {what}" for what, names in unpacked.items() if names]
        lines += [line for place in self.each for line in self._lines(place)]
        return _defined("chunk", ("codes", "given", "shared", "buffers", "outputs"), lines or ["pass"])

    def loop(self) -> str:
        """Return the source of `loop(codes, *given, *computed, *outputs)`, for the outputs that vary."""
        loop = _Loop(self.trace, self.each, [place for place, _ in self.outputs], self.computed)
        kept = [(loop.value(place), negative) for place, negative in self.outputs if place in self.varying]
        return loop.loop([f"0.0 - {value}" if negative else f"{value} + 0.0" for value, negative in kept])

    def _value(self, place: int, block: Collection[int] = ()) -> str:
        entry = self.trace.entries[place]
        if place in block:
            return number(entry.data) if entry.operation == "constant" else f"t{place}"
        if place not in self.varying:
            return f"s{place}"
        if entry.operation == "given" or self._is_looked_at_given(place):
            return f"g{place}"
        return f"b{self._buffers[0][place]}"

    def _lines(self, place: int) -> Iterator[str]:
        entry = self.trace.entries[place]
        if entry.operation != "given":
            yield from self._made(place, entry)
        for index, negative in self._kept.get(place, ()):  # zeros lose their sign
            operands = f"0.0, {self._value(place)}" if negative else f"{self._value(place)}, 0.0"
            yield f"{'subtract' if negative else 'add'}({operands}, outputs[{index}])"

    @cached_property
    def _kept(self) -> Mapping[int, Sequence[tuple[int, bool]]]:
        """Of each entry that is kept: in which outputs, and whether with the other sign."""
        found: dict[int, list[tuple[int, bool]]] = {}
        for index, (place, negative) in enumerate(self.outputs):
            found.setdefault(place, []).append((index, negative))
        return found

    def _made(self, place: int, entry: Entry) -> Iterator[str]:
        into, operands = self._value(place), [self._value(o) for o in entry.operands]
        if entry.operation == "rare":
            yield from self._look(place, entry.data, into, operands[0])
        elif entry.operation == "whole":
            yield f"{into}[:], w{place} = whole[{place}](codes, {', '.join(operands)})"
        elif entry.operation == "second":
            yield f"{into}[:] = w{entry.operands[0]}"
        elif entry.operation == "where":
            yield f"copyto({into}, where({', '.join(operands)}))"
        else:
            yield f"{entry.operation}({', '.join(operands)}, {into})"

    def _look(self, place: int, rare: Rare, into: str, value: str) -> Iterator[str]:
        own = self._is_looked_at_given(place)
        if into != value:
            yield f"{into} = {value}" if own else f"copyto({into}, {value})"
        yield f"if not ({' and '.join(map(self._calm, rare.calm)) or 'False'}):"
        for inner in rare.block:
            entry = self.trace.entries[inner]
            if entry.operation != "constant":
                operands = (self._value(o, rare.block) for o in entry.operands)
                yield f"    t{inner} = {entry.operation}({', '.join(operands)})"
        for code, condition in rare.marks:
            yield f"    maximum(codes, where({self._value(condition, rare.block)}, int8({code}), int8(0)), out=codes)"
        result = self._value(rare.result, rare.block)
        yield f"    {into} = {result}" if own else f"    copyto({into}, {result})"

    def _calm(self, calm: Calm) -> str:
        ends, of = (self._value(calm.place),) * 2, "" if calm.of is None else self._value(calm.of)
        if calm.place in self.varying:
            ends = f"least({ends[0]})", f"most({ends[0]})"
        return _lies(ORDERS, calm, ends, f"most({of})" if calm.of in self.varying else of)
