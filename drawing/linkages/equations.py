"""Parts of equations: underlines of known vectors, calculations whose printed numbers recompute, signed sums."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..printed import calculation
from .scene import Scene

Lines = list[tuple[str, ...]]


def known(text: str) -> str:
    """Underline a vector twice: known in full."""
    return f"\\uu{{{text}}}"


def by_direction(text: str) -> str:
    """Underline a vector once: known by direction."""
    return f"\\u{{{text}}}"


def size_of(scene: Scene, name: str) -> float:
    """Return the magnitude of a quantity or of a value of the construction."""
    item = scene.solved.quantities.get(name)
    return scene.solved.size(name) if item is None else (item.value or 0.0)


def calculated(
    scene: Scene, name: str, formula: str, pattern: str, law: Callable[..., float], *inputs: tuple[float, bool]
) -> tuple[str, ...]:
    """Return `symbol = formula = numbers = result unit`; `pattern` takes the printed inputs."""
    texts, result = calculation(scene.words, law, inputs)
    unit = scene.words.unit(scene.solved.quantities[name].unit)
    head = f"{scene.words.symbol(name)} = {formula} ="
    return head, f"{pattern.format(*texts)} =", f"{result} {unit}".rstrip()


def given(scene: Scene, name: str) -> tuple[float, bool]:
    """Return a given as the exact input of a calculation."""
    return scene.solved.values[name], True


def vector_sum(w_known: list[str], w_line: list[str], unknown: str = "") -> tuple[str, ...]:
    """Return a closed sum of vectors: those known in full, those known by direction, the one to be found."""
    parts = [known(text) for text in w_known] + [by_direction(text) for text in w_line] + ([unknown] if unknown else [])
    chunks = [parts[0], *(f"+ {part}" for part in parts[1:])]
    return (*chunks, "= 0")


def signed(sign: float, text: str, first: bool = False) -> str:
    """Return a term of a sum with its sign before it."""
    if first:
        return text if sign > 0 else f"−{text}"
    return f" + {text}" if sign > 0 else f" − {text}"


@dataclass(frozen=True, slots=True)
class Term:
    """A moment in a sum: its value with sign, how it is written, and the factors that make it (value, exact)."""

    value: float
    symbol: str
    factors: tuple[tuple[float, bool], ...]

    @property
    def sign(self) -> float:
        """+1 counter-clockwise, -1 clockwise."""
        return math.copysign(1.0, self.value)


def sum_of(terms: Sequence[Term], turn: float = 1.0) -> list[str]:
    """Return the terms as chunks of a sum, all signs multiplied by `turn`."""
    chunks = [signed(turn * term.sign, term.symbol, first=i == 0) for i, term in enumerate(terms)]
    return [chunk.strip() for chunk in chunks]


def balanced(
    scene: Scene, terms: Sequence[Term], turn: float, divisor: tuple[float, bool] | None = None
) -> tuple[list[str], str, str]:
    """Solve a sum of moments for one more: `turn` * terms / divisor, with numbers that recompute.

    Returns
    -------
    numbers : list of str
        The printed terms, as chunks.
    below : str
        The printed divisor, or nothing.
    result : str
        The printed result, positive when `turn` is the sense that the sum asks for.
    """
    inputs = [factor for term in terms for factor in term.factors]

    def law(*x: float) -> float:
        total, at = 0.0, 0
        for term in terms:
            total += turn * term.sign * math.prod(x[at : at + len(term.factors)])
            at += len(term.factors)
        return total / x[-1] if divisor else total

    texts, result = calculation(scene.words, law, [*inputs, divisor] if divisor else inputs)
    products, at = [], 0
    for i, term in enumerate(terms):
        product = "·".join(texts[at : at + len(term.factors)])
        products.append(signed(turn * term.sign, product, first=i == 0).strip())
        at += len(term.factors)
    return products, texts[-1] if divisor else "", result
