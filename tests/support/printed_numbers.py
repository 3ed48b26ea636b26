"""Numbers as they are printed on a sheet: tables, equations, and whether they recompute (L9, L12, L13)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from decimal import Decimal
from itertools import pairwise

from kulman.tests.support.readback import Sheet, Text, View

NUMBER = r"\d+(?:[.,]\d+)?"
EXPRESSION = re.compile(r"[\s\d.,·/+−()%π]*(?:\^\{2\}[\s\d.,·/+−()%π]*)*")


def numbers_of(text: str, lang: str) -> list[float]:
    """Return the numbers of a text; a wrong decimal sign is no number."""
    plain = re.sub(r"[_^]\{[^}]*\}", "", text)
    found = re.findall(rf"[−]?{NUMBER}", plain)
    sign = "." if lang == "en" else ","
    wrong = "," if lang == "en" else "."
    assert not any(re.search(rf"\d\{wrong}\d", number) for number in found), text
    return [float(number.replace("−", "-").replace(sign, ".")) for number in found]


def decimal(text: str, lang: str) -> str:
    """Return a number that has a point as a language writes it."""
    return text if lang == "en" else text.replace(".", ",")


def value(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


def half_digit(text: str) -> float:
    """Half a unit of the last printed digit, and a little for ties."""
    number = re.findall(NUMBER, text)[-1].replace(",", ".")
    return 0.5 * 10.0 ** Decimal(number).as_tuple().exponent * (1 + 1e-9)


def table(view: View) -> list[list[str]]:
    """Return the rows of a table below its head, the cells from left to right."""
    rows: dict[int, list[Text]] = {}
    for cell in sorted(view.of("cell"), key=lambda cell: -cell.baseline):
        level = next((y for y in rows if abs(y - cell.baseline * 1000) < 10), round(cell.baseline * 1000))
        rows.setdefault(level, []).append(cell)
    ordered = [sorted(cells, key=lambda cell: cell.box[0]) for cells in rows.values()]
    return [[cell.string for cell in cells] for cells in ordered[1:]]


def lines_of(view: View) -> list[str]:
    """Return the lines of a block of text, broken ones joined again."""
    lines: list[str] = []
    left = min(t.runs[0].at.real for t in view.of("line"))
    for text in view.of("line"):
        if text.runs[0].at.real > left + 0.5 and lines:
            lines[-1] += " " + text.string
        else:
            lines.append(text.string)
    return lines


def _shows_three_digits(mu: float, printed: float) -> bool:
    """Whether a hundredth of a millimetre is no more than a unit of the third digit of a value."""
    return printed != 0.0 and 0.01 * mu <= 10.0 ** (math.floor(math.log10(abs(printed))) - 2)


def _needless(mm: str, most: int, mu: float, printed: str) -> bool:
    """Whether a segment has more decimals than a ruler shows, though with so many its value would be as printed."""
    decimals = re.split("[.,]", mm)[-1]
    if len(decimals) <= most or decimals[most] == "5":  # which way it was rounded cannot be told
        return False
    return abs(round(value(mm), most) * mu - value(printed)) < half_digit(printed) * (1 - 1e-6)


def table_faults(sheet: Sheet, lang: str, values: dict[str, float]) -> Iterator[str]:
    """Rows in which mm times mu is not the value to its last digit, or which `values` (by symbol) contradict."""
    for name in sheet.names:
        if not name.startswith("results_"):
            continue
        most = 3 if any(re.search(r", (cm|см)$", cell.string) for cell in sheet[name].of("cell")) else 2
        for row in table(sheet[name]):
            symbol, mm, mu, printed = row[:4]
            if mm != "–" and abs(value(mm) * value(mu) - value(printed)) > half_digit(printed):
                yield f"{symbol}: {mm}·{mu} is not {printed}"
            # of hundreds and thousands the units are printed, which a hundredth of a millimetre may not show
            longer = mm != "–" and value(mm) > 2.0 and len(re.split("[.,]", mm)[-1]) > most
            if longer and abs(value(printed)) < 100.0 and _shows_three_digits(value(mu), value(printed)):
                yield f"{symbol}: no ruler reads {mm} mm"
            if mm != "–" and _needless(mm, most, value(mu), printed):
                yield f"{symbol}: {mm} mm has more decimals than it takes"
            if symbol in values and abs(abs(value(printed)) - abs(values[symbol])) > half_digit(printed) + 1e-9:
                yield f"{symbol}: {printed} is not {values[symbol]}"
            numbers_of(" ".join(row), lang)


def evaluate(text: str) -> float:
    """Return the value of a printed expression of numbers."""
    plain = text.replace("100 %", "100").replace(",", ".").replace("·", "*").replace("−", "-").replace("^{2}", "**2")
    plain = plain.replace("π", repr(math.pi))
    assert re.fullmatch(r"[\d.\s*/+()\-]+", plain), text
    return float(eval(re.sub(r"\s+", " ", plain).strip()))


def calculations(line: str) -> Iterator[tuple[str, str]]:
    """Yield (expression, printed result) for every `= numbers = number unit` of a line."""
    body = line.rpartition(": ")[2]
    sides = [side.strip() for side in body.split("=")]
    for expression, result in pairwise(sides):
        found = re.match(rf"−?{NUMBER}", result)
        if found and re.search(r"\d", expression) and EXPRESSION.fullmatch(expression):
            yield expression, found[0]


def equation_faults(sheet: Sheet) -> tuple[int, list[str]]:
    """Return how many printed calculations there are, and those that do not recompute to their last digit."""
    count, faults = 0, []
    for view in sheet.views:
        if view.of("line"):
            for line in lines_of(view):
                for expression, result in calculations(line):
                    count += 1
                    if abs(evaluate(expression) - value(result)) > half_digit(result):
                        faults.append(f"{view.name}: {expression} = {evaluate(expression)}, printed {result}")
    return count, faults
