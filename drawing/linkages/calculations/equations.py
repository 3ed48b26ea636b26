"""Parts of equations: underlines of known vectors, sums of products whose printed numbers recompute."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ....plans.board import POSITION, Step
from ....plans.laws import form_of
from ....plans.linkages.legs import guide_letters
from ....plans.linkages.parts import SYMBOLS
from ....plans.names import CORIOLIS, NORMAL, POLE, role, vector
from ....plans.quantities import unit_of
from ....scales.scale import Scale
from ...printed import POINT, Input, Symbol, calculation, ruler_decimals, value_text
from ...words import Words
from ..reading import Edge, Reading
from ..scene import Scene

Lines = list[tuple[str, ...]]
DIRECTIONS = ("direction", "turn", "normal", "incline", "decline")  # verbs that make them


def known(text: str) -> str:
    """Underline a vector twice: known in full."""
    return f"\\uu{{{text}}}"


def by_direction(text: str) -> str:
    """Underline a vector once: known by direction."""
    return f"\\u{{{text}}}"


@dataclass(frozen=True, slots=True)
class Factor:
    """A factor of a product: its symbol, its size as it is printed, whether that is exact, its power 1, 2 or -1.

    A segment of the sheet has at most `places` decimals.
    """

    symbol: str
    value: float
    exact: bool = False
    power: int = 1
    places: int | None = None

    @property
    def letter(self) -> Symbol:
        """Its symbol in a formula: the exponent of a square stands over the letter, before its index."""
        base, underscore, index = self.symbol.partition("_")
        return Symbol.of(self.symbol, *((f"({self.symbol})",) if "^" in self.symbol else (base, underscore + index)))


@dataclass(frozen=True, slots=True)
class Product:
    """A term of a sum: a sign and factors."""

    factors: tuple[Factor, ...]
    sign: float = 1.0

    @property
    def in_letters(self) -> Any:
        """The product as a formula."""
        return self.of([factor.letter for factor in self.factors])

    def of(self, values: Sequence[Any]) -> Any:
        """Return the signed product of other values of its factors, or of symbols."""
        sizes = (value**factor.power for value, factor in zip(values, self.factors, strict=True))
        return math.copysign(1.0, self.sign) * math.prod(sizes)


def turned(products: Iterable[Product], turn: float) -> list[Product]:
    """Return the products with all signs multiplied by that of `turn`."""
    return [replace(product, sign=product.sign * turn) for product in products]


def worked(
    words: Words, head: str, products: Sequence[Product], unit: str, divisor: Product | None = None
) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of a sum of products, perhaps over a divisor."""
    return by_law(words, head, lambda *x: sum(x[1:]) / x[0], (divisor or Product(()), *products), unit)


def by_law(words: Words, head: str, law: Callable[..., Any], operands: Sequence[Product], unit: str) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of a law of operands each of which is a product.

    The numbers are printed with as many digits as it takes for the result to come out to its last one.
    """
    factors = [factor for operand in operands for factor in operand.factors]

    def found(*x: Any) -> Any:
        rest = iter(x)
        return law(*(operand.of([next(rest) for _ in operand.factors]) for operand in operands))

    texts, result = calculation(words, found, [Input(factor.value, factor.exact, factor.places) for factor in factors])
    formula, reckoned = found(*(factor.letter for factor in factors)).chunks, found(*map(Symbol.of, texts)).chunks
    formula[0] = f"{head} = {formula[0]}"
    for chunks in (formula, reckoned):
        chunks[-1] += " ="
    return (*formula, *reckoned, f"{result} {words.unit(words.display.unit(unit))}".rstrip())


def size_by_law(scene: Scene, head: str, step: Step, unit: str) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of the size that the law of a step gives."""

    def size(*x: Any) -> Any:
        value = form_of(step.law)(*x)
        return value.size if isinstance(value, Symbol) else abs(value)

    return by_law(scene.words, head, size, [_operand(scene, name) for name in step.operands], unit)


def _operand(scene: Scene, name: str) -> Product:
    """Return an operand of a law: a value, an arm that was read off the plan of the mechanism, or a direction."""
    made = scene.reading.made.get(name)
    if made is not None and made.verb in DIRECTIONS:
        return Product(())
    if made is not None and made.verb == "read" and made.plan == POSITION:
        return distance(scene, *made.operands)
    return Product((factor(scene, name),))


def distance(scene: Scene, start: str, end: str) -> Product:
    """Return a distance on the plan of the mechanism as its millimetres and the scale factor."""
    words, size = scene.words, abs(scene.solved.point(end) - scene.solved.point(start))
    own = segment(scene, words.mark(start) + words.mark(end), POSITION, size)
    return Product((own, paper(words, scene.scales[POSITION])))


def moments_in_letters(own: Symbol, others: Iterable[Product]) -> list[str]:
    """Return the terms of a sum of moments, that of the force to be found first."""
    return sum((product.in_letters for product in others), own).chunks


def size_of(scene: Scene, name: str) -> float:
    """Return the magnitude of a quantity or of a value of the construction; what its plan shows as a point is zero."""
    item, plan = scene.solved.quantities.get(name), scene.solved.shown_on.get(name, "")
    size = abs(scene.solved.size(name)) if item is None else abs(item.value or 0.0)
    return 0.0 if plan in scene.scales and size < POINT * scene.scales[plan].mu else size


def rate_of(scene: Scene, name: str) -> float:
    """Return an angular velocity or acceleration, zero where the vector that it is read from is a point of its plan."""
    step = scene.reading.made.get(name)
    if step is not None and step.law == "same_turning":
        return rate_of(scene, step.operands[0])
    still = step is not None and step.law == "turning" and size_of(scene, step.operands[0]) == 0.0
    return 0.0 if still else float(scene.solved.values[name])


def factor(scene: Scene, name: str, power: int = 1) -> Factor:
    """Return a value of the construction as a factor in the units shown; a given is exact."""
    words, plain = scene.words, role(name).shown
    value = words.display.value(size_of(scene, name), unit_of(plain))
    return Factor(words.symbol(plain), value, is_given(scene, name), power)


def segment(scene: Scene, symbol: str, plan: str, size: float) -> Factor:
    """Return what a plan shows as a factor in the paper's unit, without its scale factor."""
    measured = scene.words.display.segment(size / scene.scales[plan].mu)
    return Factor(symbol, measured, places=ruler_decimals(scene.words))


def is_given(scene: Scene, name: str) -> bool:
    """Whether a value is stated by the task, not constructed."""
    return name in scene.solved.values and name not in scene.reading.made


def paper(words: Words, scale: Scale) -> Factor:
    """Return the factor that makes millimetres of a plan the value that they show: μ, below the bar if mm per unit."""
    return Factor(words.symbol(scale.symbol), words.factor(scale), exact=True, power=-1 if words.per_unit else 1)


def noted(line: Sequence[str], *notes: str) -> tuple[str, ...]:
    """Return a line with notes behind it, commas between; empty notes are none."""
    *before, end = line
    *parted, last = (end, *filter(None, notes))
    return (*before, *(f"{chunk}," for chunk in parted), last)


def sensed(words: Words, value: float) -> str:
    """Return the sense of a turning or of a moment in words; nothing for zero."""
    return "" if value == 0.0 else words["said.ccw" if value > 0 else "said.cw"]


def stated(words: Words, symbol: str, value: float, unit: str) -> str:
    """Return `symbol = number unit` of a value in SI."""
    shown = words.display.unit(unit)
    return f"{symbol} = {value_text(words, words.display.value(value, unit))} {words.unit(shown)}"


@dataclass(frozen=True, slots=True)
class Side:
    """One way from the pole to a point: vectors known in full, then one along the line `direction`."""

    knowns: tuple[str, ...]
    unknown: str
    direction: str


def meeting(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return the equation that two lines of a plan solve, and along which lines its unknown vectors lie.

    Both sides lead from the pole to the point where the lines meet; its absolute vector stands before them unless it is
    itself the unknown of one side.
    """
    reading = scene.reading
    p, u, q, w = step.operands
    sides = sorted((_side(reading, step, p, u), _side(reading, step, q, w)), key=lambda side: len(side.knowns))
    whole = reading.absolute(step.name)
    texts = [" + ".join((*_double(scene, side.knowns), by_direction(scene.letter(side.unknown)))) for side in sides]
    if whole is not None and all(side.knowns or side.unknown != whole.name for side in sides):
        texts.insert(0, scene.letter(whole.name))
    notes = [line_note(scene, side.unknown, side.direction) for side in sides]
    return noted((texts[0], *(f"= {text}" for text in texts[1:])), *notes)


def _side(reading: Reading, step: Step, start: str, direction: str) -> Side:
    before = reading.number[step.name]
    edge = reading.between(start, step.name)
    name = edge.name if edge is not None else _named(reading, start, step.name)
    return Side(tuple(edge.name for edge in reading.way(start, before)), name, direction)


def _named(reading: Reading, start: str, tip: str) -> str:
    """Return the name of a vector that is drawn but not read: `V_XA` from a to x.

    From the end n of normal parts it is the tangential part `a_XA_t`, from that of Coriolis the sliding one `a_XB4_r`.
    """
    begin, end, part = role(start), role(tip), ""
    while begin.kind in (NORMAL, CORIOLIS):
        part = "r" if begin.kind == CORIOLIS else part or "t"
        begin = role(reading.made[begin].operands[0])
    return vector(SYMBOLS.get(end.plan, "V"), end.of, "" if begin.kind == POLE else begin.of, part)


def summed(scene: Scene, whole: str, parts: Sequence[str]) -> tuple[str, ...]:
    """Return `whole = a + b` of parts that are known in full."""
    first, *rest = _double(scene, parts)
    return (f"{scene.letter(whole)} = {first}", *(f"+ {text}" for text in rest))


def line_note(scene: Scene, vector: str, direction: str) -> str:
    """Say along which line a vector lies: `V_BA ⊥ AB`."""
    return f"{scene.letter(vector)} {line_of(scene, direction)}"


def line_of(scene: Scene, direction: str) -> str:
    """Return a line by the name of its direction: ∥ AB, ⊥ AB, ∥ x–x."""
    step = scene.reading.made[direction]
    sign, along = ("⊥", step.operands[0]) if step.verb == "normal" else ("∥", direction)
    letters = guide_letters(scene.program).get(along)
    return f"{sign} {letters or ''.join(map(scene.words.mark, ends_of(scene.reading, along)))}"


def line_through(scene: Scene, point: str, direction: str) -> str:
    """Return the line through a point: AB, or (B ⊥ x–x)."""
    line = line_of(scene, direction)
    return line.removeprefix("∥ ") if line.startswith("∥ ") else f"({scene.words.mark(point)} {line})"


def ends_of(reading: Reading, direction: str) -> tuple[str, str]:
    """Return the two points of which a direction is the line."""
    step = reading.made[direction]
    if step.verb in ("direction", "tangent"):
        return step.operands[0], step.operands[1]
    # the crank is turned to its angle: its end is laid off along this direction
    lay = next(s for s in reading.users(direction) if s.verb == "lay" and s.plan == POSITION)
    return lay.operands[0], lay.name


def closed(scene: Scene, plan: str) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces of a plan: the one that closes it, then those that its chords show."""
    reading = scene.reading
    edges = reading.on(plan)
    meet = next((step for step in scene.program.on(plan) if step.verb == "meet"), None)
    if meet is None:
        last = edges[-1]
        around = path([e for e in edges if e is not last], last.tip, last.tail)
        yield _zero(scene, around, (), last.name)
        return
    p, u, q, w = meet.operands
    firm = [e for e in edges if reading.is_hung(e)]
    lines = ((reading.between(p, meet.name), u), (reading.between(meet.name, q), w))
    found = [edge for edge, _ in lines if edge is not None]
    notes = [line_note(scene, edge.name, along) for edge, along in lines if edge is not None]
    by_moments = next((e for e in edges if {e.tail, e.tip} & {p, q} and role(e.name).part == "m"), None)
    if by_moments is not None:
        whole, along = role(by_moments.name).whole, next(line for edge, line in lines if edge is None)
        yield _two_ways(scene, whole, found[0].name, notes[0], along)
        edges = tuple(sorted((e for e in edges if e is not by_moments), key=lambda e: e.name != whole))
        yield from _chords(scene, edges, [*firm, *found], ())
        return
    yield noted(_zero(scene, path(firm, q, p), [edge.name for edge in found], ""), *notes)
    yield from _chords(scene, edges, [*firm, *found], edges)


def _chords(
    scene: Scene, edges: Sequence[Edge], ready: list[Edge], others: Sequence[Edge]
) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces that the chords of a plan show, by what is ready before each, or by all others."""
    for chord in (e for e in edges if e not in ready):
        parts = path(ready, chord.tail, chord.tip)
        if parts and all(role(part).whole == chord.name != part for part in parts):  # of one reaction
            yield summed(scene, chord.name, parts)
        else:
            around = path([e for e in others or ready if e is not chord], chord.tip, chord.tail)
            yield _zero(scene, around, (), chord.name)
        if not others:
            ready = [*ready, chord]


def _two_ways(scene: Scene, whole: str, normal: str, note: str, along: str) -> tuple[str, ...]:
    """Return the equation of a reaction by its parts along and across its link, and along and across another line."""
    ways = ((f"{whole}_t", normal), (f"{whole}_m", f"{whole}_p"))
    first, second = (f"= {known(scene.letter(x))} + {by_direction(scene.letter(y))}" for x, y in ways)
    return noted((f"{scene.letter(whole)} {first}", second), note, line_note(scene, f"{whole}_p", along))


def path(edges: Iterable[Edge], start: str, end: str) -> list[str]:
    """Return the shortest way of vectors, tip to tail, from one mark to another."""
    ways, queue, every = {start: list[str]()}, [start], list(edges)
    for mark in queue:
        for edge in every:
            if edge.tail == mark and edge.tip not in ways:
                ways[edge.tip] = [*ways[mark], edge.name]
                queue.append(edge.tip)
    return ways.get(end, [])


def _zero(scene: Scene, knowns: Sequence[str], lines: Sequence[str], unknown: str) -> tuple[str, ...]:
    """Return a sum of forces that is zero: known in full, known by direction, to be found."""
    texts = _double(scene, knowns) + [by_direction(scene.letter(name)) for name in lines]
    texts += [scene.letter(unknown)] if unknown else []
    return (texts[0], *(f"+ {text}" for text in texts[1:]), "= 0")


def _double(scene: Scene, names: Iterable[str]) -> list[str]:
    return [known(scene.letter(name)) for name in names]
