"""Parts of equations: underlines of known vectors, sums of products whose printed numbers recompute."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ....plans.quantities import unit_of
from ....scales.scale import Scale
from ...printed import POINT, Input, calculation, ruler_decimals, value_text
from ...words import Words
from ..reading import read
from ..scene import Scene

Lines = list[tuple[str, ...]]


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


@dataclass(frozen=True, slots=True)
class Product:
    """A term of a sum: a sign and factors."""

    factors: tuple[Factor, ...]
    sign: float = 1.0

    def written(self, texts: Sequence[str]) -> str:
        """Return the product of the factors written as `texts`: `a·b^{2}/c`."""
        above = [squared(t) if f.power == 2 else t for t, f in zip(texts, self.factors, strict=True) if f.power > 0]
        below = [t for t, f in zip(texts, self.factors, strict=True) if f.power < 0]
        over = f"({'·'.join(below)})" if len(below) > 1 else "".join(below)
        return "·".join(above) + (f"/{over}" if over else "")

    @property
    def symbols(self) -> str:
        """The product in symbols."""
        return self.written([factor.symbol for factor in self.factors])

    def of(self, values: Sequence[float]) -> float:
        """Return the signed product of other values of its factors."""
        sizes = (value**factor.power for value, factor in zip(values, self.factors, strict=True))
        return math.copysign(1.0, self.sign) * math.prod(sizes)


def squared(text: str) -> str:
    """Write a square: the 2 stands over the letter, before its index."""
    if "^" in text:
        return f"({text})^{{2}}"
    letter, underscore, index = text.partition("_")
    return f"{letter}^{{2}}{underscore}{index}"


def turned(products: Iterable[Product], turn: float) -> list[Product]:
    """Return the products with all signs multiplied by that of `turn`."""
    return [replace(product, sign=product.sign * turn) for product in products]


def signs(products: Sequence[Product], texts: Sequence[str]) -> list[str]:
    """Return the terms of a sum with their signs, a chunk each."""
    chunks = []
    for i, (product, text) in enumerate(zip(products, texts, strict=True)):
        plus = math.copysign(1.0, product.sign) > 0
        sign = ("" if plus else "−") if i == 0 else ("+ " if plus else "− ")
        chunks.append(f"{sign}{text}")
    return chunks


def worked(
    words: Words, head: str, products: Sequence[Product], unit: str, divisor: Product | None = None
) -> tuple[str, ...]:
    """Return `head = formula = numbers = result unit` of a sum of products, perhaps over a divisor.

    The numbers are printed with as many digits as it takes for the result to come out to its last one.
    """
    over = (divisor,) if divisor else ()
    factors = [factor for product in (*products, *over) for factor in product.factors]
    cuts = [sum(len(p.factors) for p in products[:i]) for i in range(len(products) + 1)]

    def law(*x: float) -> float:
        found = sum(product.of(x[a:b]) for product, a, b in zip(products, cuts, cuts[1:], strict=False))
        return found / math.prod(product.of(x[cuts[-1] :]) for product in over)

    texts, result = calculation(words, law, [Input(factor.value, factor.exact, factor.places) for factor in factors])
    symbols = signs(products, [product.symbols for product in products])
    numbers = [p.written(texts[a:b]) for p, a, b in zip(products, cuts, cuts[1:], strict=False)]
    formula = _over(symbols, divisor.symbols if divisor else "")
    reckoned = _over(signs(products, numbers), divisor.written(texts[cuts[-1] :]) if divisor else "")
    formula[0] = f"{head} = {formula[0]}"
    formula[-1] += " ="
    reckoned[-1] += " ="
    return (*formula, *reckoned, f"{result} {words.unit(words.display.unit(unit))}".rstrip())


def _over(chunks: list[str], divisor: str) -> list[str]:
    """Put a sum over a divisor, each in parentheses unless it is one product."""
    if not divisor:
        return chunks
    divisor = f"({divisor})" if "·" in divisor or "/" in divisor else divisor
    if len(chunks) > 1:
        return [f"({chunks[0]}", *chunks[1:-1], f"{chunks[-1]})/{divisor}"]
    plain = not chunks[0].startswith("−") and "/" not in chunks[0]
    return [f"{chunks[0]}/{divisor}" if plain else f"({chunks[0]})/{divisor}"]


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
    plain = name.strip("_|")
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
