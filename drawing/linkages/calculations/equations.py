"""Parts of equations: underlines of known vectors, sums of products whose printed numbers recompute."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ....plans.board import POSITION, Step
from ....plans.laws import form_of
from ....plans.names import role
from ....plans.quantities import unit_of
from ....scales.scale import Scale
from ...formulas import Symbol
from ...printed import POINT, Input, calculation, ruler_decimals, value_text
from ...words import Words
from ..reading import read
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
    formula[-1] += " ="
    reckoned[-1] += " ="
    return (*formula, *reckoned, f"{result} {words.unit(words.display.unit(unit))}".rstrip())


def size_by_law(scene: Scene, head: str, step: Step, unit: str) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of the size that the law of a step gives."""

    def size(*x: Any) -> Any:
        value = form_of(step.law)(*x)
        return value.size if isinstance(value, Symbol) else abs(value)

    return by_law(scene.words, head, size, [_operand(scene, name) for name in step.operands], unit)


def _operand(scene: Scene, name: str) -> Product:
    """Return an operand of a law: a value, an arm that was read off the plan of the mechanism, or a direction."""
    made = read(scene.solved.program).step(name)
    if made is not None and made.verb in DIRECTIONS:
        return Product(())
    if made is not None and made.verb == "read" and made.plan == POSITION:
        return distance(scene, *made.operands)
    return Product((factor(scene, name),))


def distance(scene: Scene, start: str, end: str) -> Product:
    """Return a distance on the plan of the mechanism as its millimetres and the scale factor."""
    words, size = scene.words, abs(scene.solved.point(end) - scene.solved.point(start))
    return Product(
        (segment(scene, words.mark(start) + words.mark(end), POSITION, size), paper(words, scene.scales[POSITION]))
    )


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
    step = read(scene.solved.program).step(name)
    if step is not None and step.law == "same_turning":
        return rate_of(scene, step.operands[0])
    still = step is not None and step.law == "turning" and size_of(scene, step.operands[0]) == 0.0
    return 0.0 if still else float(scene.solved.values[name])


def factor(scene: Scene, name: str, power: int = 1, symbol: str | None = None) -> Factor:
    """Return a value of the construction as a factor in the units shown; a given is exact."""
    plain = role(name).shown
    value = scene.words.display.value(size_of(scene, name), unit_of(plain))
    return Factor(scene.words.symbol(plain) if symbol is None else symbol, value, is_given(scene, name), power)


def segment(scene: Scene, symbol: str, plan: str, size: float) -> Factor:
    """Return what a plan shows as a factor in the paper's unit, without its scale factor."""
    measured = scene.words.display.segment(size / scene.scales[plan].mu)
    return Factor(symbol, measured, places=ruler_decimals(scene.words))


def is_given(scene: Scene, name: str) -> bool:
    """Whether a value is stated by the task, not constructed."""
    return name in scene.solved.values and name not in read(scene.solved.program).made


def paper(words: Words, scale: Scale) -> Factor:
    """Return the factor that makes millimetres of a plan the value that they show: μ, below the bar if mm per unit."""
    power = -1 if words.per_unit else 1
    value = words.factor(scale)
    return Factor(words.symbol(scale.symbol), value, exact=True, power=power)


def noted(line: Sequence[str], *notes: str) -> tuple[str, ...]:
    """Return a line with notes behind it, commas between; empty notes are none."""
    *chunks, last = (*line, *(note for note in notes if note))
    behind = len([note for note in notes if note])
    cut = len(chunks) - behind
    return (*chunks[:cut], *(f"{chunk}," for chunk in chunks[cut:]), last)


def sensed(words: Words, value: float) -> str:
    """Return the sense of a turning or of a moment in words; nothing for zero."""
    return "" if value == 0.0 else words["said.ccw" if value > 0 else "said.cw"]


def stated(words: Words, symbol: str, value: float, unit: str) -> str:
    """Return `symbol = number unit` of a value in SI."""
    shown = words.display.unit(unit)
    return f"{symbol} = {value_text(words, words.display.value(value, unit))} {words.unit(shown)}"
