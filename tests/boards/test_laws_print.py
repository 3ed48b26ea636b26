"""Laws that are called with symbols: what they print, read as mathematics, is what they compute."""

from __future__ import annotations

import inspect
import math
import random
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import kulman.plans.cams.construction
import kulman.plans.gears.geometry
import kulman.plans.hoist.model  # noqa: F401
from kulman.drawing.gears.text import _prints
from kulman.drawing.printed import Symbol
from kulman.plans.gears.geometry import _involute
from kulman.plans.laws import FORMS, LAWS, Sign, bracketed, form_of

# what is printed with millimetres of paper, or with degrees, is so many times what the law makes of SI
TIMES = {
    **dict.fromkeys(("on_axis", "scale_factor", "derived_scale"), 1e3),
    **dict.fromkeys(("to_scale", "ordinate_to_scale"), 1e-3),
    "arc_length": math.radians(1.0),
}


class Function:
    """A function that binds its argument as `f ** x`, as strongly as a name before it in print."""

    def __init__(self, function: Callable[[float], float]) -> None:
        self.function = function

    def __pow__(self, argument: float) -> float:
        return self.function(argument)


FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan")}
FUNCTIONS |= {"arccos": math.acos, "arctan": math.atan, "inv": _involute}
NAMES = {
    **{name: Function(function) for name, function in FUNCTIONS.items()},
    **{f"{name}2": Function(lambda x, f=function: f(x) ** 2) for name, function in FUNCTIONS.items()},
    "sqrt": math.sqrt,
    "π": math.pi,
}


def read(text: str) -> float:
    """Return the number that a printed formula has when people read it."""
    text = re.sub(r"(\d+)°", lambda found: f"({found[1]}*π/180)", text.replace("2π", "(2·π)"))
    text = re.sub(r"([a-z]+)(?:\^\{(2)\})? ", r"\1\2**", text)
    for sign, written in (("·", "*"), ("−", "-"), ("√", "sqrt"), ("^{", "**("), ("}", ")")):
        text = text.replace(sign, written)
    return float(eval(text, {}, NAMES))


def operands_of(law: str) -> int:
    """Return how many operands a law takes, six where it takes any number."""
    parameters = inspect.signature(inspect.unwrap(LAWS[law])).parameters.values()
    return sum(
        6 if p.kind is p.VAR_POSITIONAL else 1 for p in parameters if p.default is p.empty or len(parameters) == 1
    )


PRINTING = [law for law in LAWS if _prints(law, operands_of(law))]


def size(value: Any) -> float:
    """Return a number, of a vector its size."""
    return abs(complex(value)) if isinstance(value, complex | np.complexfloating) else float(value)


@pytest.mark.parametrize("law", PRINTING)
def test_law_prints_what_it_computes(law: str) -> None:
    draw, count = random.Random(law), operands_of(law)
    for _ in range(20):
        numbers = sorted(round(draw.uniform(0.5, 0.9), 3) for _ in range(count))
        with np.errstate(invalid="ignore"):
            if math.isnan(size(LAWS[law](*numbers))):
                numbers.reverse()  # a leg is no longer than a hypotenuse
        text = str(form_of(law)(*(Symbol.of(repr(number)) for number in numbers)))
        computed = size(LAWS[law](*numbers)) * TIMES.get(law, 1.0)
        told = read(text)
        assert told == pytest.approx(computed, rel=1e-9, abs=1e-12), text


def test_most_laws_print_themselves_but_no_procedure() -> None:
    assert len(PRINTING) >= 120
    assert set(FORMS) <= set(PRINTING)
    assert len(FORMS) <= 16  # few are computed in another form than is printed
    assert not _prints("angle_of_involute", 1)
    assert not _prints("last_maximum", 5)


a, b, c = map(Symbol.of, "abc")


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (a - (b - c) * 2.0, "a − (b − c)·2"),
        (a / (b * c), "a/(b·c)"),
        (a / (b / c), "a/(b/c)"),
        (a / b / c, "(a/b)/c"),
        (-(a + b) / c, "(−a − b)/c"),
        (-a / b, "(−a)/b"),
        ((1.0 - a) * (1.0 - a) * a, "(1 − a)^{2}·a"),
        (a * a * a / 3.0, "a^{3}/3"),
        (0.5 * a * (b + 0.0), "a·b/2"),
        ((a + b) ** 1.5, "(a + b)^{3/2}"),
        (np.float64(2.0) * np.sqrt(a * b) ** 2, "2·√(a·b)^{2}"),
        (np.sin(2.0 * a) ** 2 * np.cos(b), "sin^{2} (2·a)·cos b"),
        (a / (2.0 * math.pi) - math.pi, "a/(2π) − π"),
        (bracketed(a / b) * Sign(3.0, "three"), "(a/b)·three"),
        (Symbol.of("−5") - Symbol.of("2·10^{3}") ** 2 / Symbol.of("2·10^{3}"), "(−5) − (2·10^{3})^{2}/(2·10^{3})"),
        (Symbol.of("ω_{1}", "ω", "_{1}") ** 2 * a, "ω^{2}_{1}·a"),
        ((1j * a) * 1.0, "a"),
    ],
)
def test_signs_and_brackets(expression: Symbol, text: str) -> None:
    assert str(expression) == text
