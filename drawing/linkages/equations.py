"""Parts of equations: underlines of known vectors, calculations whose printed numbers recompute, signed sums."""

from __future__ import annotations

from collections.abc import Callable

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
