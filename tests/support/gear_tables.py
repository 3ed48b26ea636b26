"""What is printed about a gear pair, read back: tables, and calculations that are done again from their own numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from kulman.tests.support.readback import View

NUMBER = r"[−-]?\d+(?:[.,]\d+)?"
LEVEL = 0.8  # mm by which baselines of one row may differ
FUNCTIONS = ("sin", "cos", "tg", "tan", "inv", "arccos")


def number(text: str) -> float:
    """A printed number; the first one of a text."""
    if text == "−∞":
        return -math.inf
    found = re.search(NUMBER, text)
    assert found, text
    return float(found[0].replace("−", "-").replace(",", "."))


def last_digit(text: str) -> float:
    """Half of the last digit of a printed number."""
    found = re.search(NUMBER, text)
    assert found, text
    return 0.5 * 10.0 ** -len(re.split("[.,]", found[0])[1] if re.search("[.,]", found[0]) else "")


def rows(view: View) -> list[list[str]]:
    """The rows of a table from the top, each from the left; cells without text are left out."""
    levels: dict[float, list[tuple[float, str]]] = {}
    for text in view.of("cell"):
        at = next((level for level in levels if abs(level - text.baseline) < LEVEL), text.baseline)
        levels.setdefault(at, []).append((text.box[0], text.string))
    return [[string for _, string in sorted(levels[level])] for level in sorted(levels, reverse=True)]


@dataclass(frozen=True)
class Calculation:
    """A printed calculation: its symbol, the expression with numbers if it has one, the result with its unit."""

    symbol: str
    expression: str
    result: str

    @property
    def again(self) -> float:
        """The expression calculated from its own numbers."""
        return evaluated(self.expression)


def calculations(view: View) -> Iterator[Calculation]:
    """Go through the calculations of a block of text, lines that are broken joined again."""
    lines: list[str] = []
    for text in sorted(view.of("line"), key=lambda text: -text.baseline):
        if lines and text.string.strip().startswith("="):
            lines[-1] += " " + text.string.strip()
        else:
            lines.append(text.string.strip())
    for line in lines:
        parts = line.split(" = ")
        if re.match(NUMBER, parts[-1]):
            yield Calculation(parts[0], parts[-2] if len(parts) > 3 else "", parts[-1])


def evaluated(expression: str) -> float:
    """The value of a printed expression; angles in degrees."""
    text = expression.replace(",", ".").replace("−", "-").replace("π", "pi").replace("·", "*")
    text = re.sub(r"(\d)pi", r"\1*pi", text)
    name = "|".join(FUNCTIONS)
    text = re.sub(rf"({name})(\^\{{2\}})? (\(.*?\)|[\d.]+°)", _call, text)
    known = {"pi": math.pi, "sin": _sin, "cos": _cos, "tg": _tan, "tan": _tan, "inv": _inv, "arccos": _arccos}
    return float(eval(text.replace("°", ""), {"__builtins__": {}}, known))


def _call(found: re.Match[str]) -> str:
    argument = found[3].strip("()")
    return f"{found[1]}({argument})" + ("**2" if found[2] else "")


def _sin(degrees: float) -> float:
    return math.sin(math.radians(degrees))


def _cos(degrees: float) -> float:
    return math.cos(math.radians(degrees))


def _tan(degrees: float) -> float:
    return math.tan(math.radians(degrees))


def _inv(degrees: float) -> float:
    return _tan(degrees) - math.radians(degrees)


def _arccos(value: float) -> float:
    return math.degrees(math.acos(value))
