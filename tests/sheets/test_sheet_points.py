"""Points L1 to L13 of the examiner's list on sheets that were drawn and read back."""

from __future__ import annotations

import random
import re

import pytest

from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.printed_numbers import equation_faults, lines_of, table_faults
from kulman.tests.support.readback import Sheet, read
from kulman.tests.support.sheet_cases import FORMATS, Case, drawn, pages, solved
from kulman.tests.support.sheet_points import POINTS, mechanism_faults

LETTERS = {"omega": "ω", "epsilon": "ε"}


def sample(count: int) -> list[Case]:
    """A seeded sample: every variant at least once, every format, side, rotation and language."""
    r = random.Random(20160101)
    variants = list(NAU_VARIANTS)
    return [
        Case(
            variants[k % len(variants)],
            FORMATS[k % 5],
            ("uk", "en", "ru")[k % 3],
            r.choice(("left", "right")),
            r.choice(("cw", "ccw")),
        )
        for k in range(count)
    ]


SAMPLE = sample(12)


def number_faults(case: Case, sheet: Sheet) -> list[str]:
    """What does not recompute, or is not what `kulman solve` says."""
    count, faults = equation_faults(sheet)
    if count < 18:
        faults.append(f"only {count} calculations")
    numbers = solved(case)
    values = {symbol_of(name): q.value for name, q in numbers.quantities.items() if plain(name)}
    faults += table_faults(sheet, case.lang, values)
    for vector in sheet.vectors:
        expected = numbers[vector.quantity].value
        if abs(vector.value - expected) > 1e-12 * abs(expected):
            faults.append(f"data-value of {vector.quantity} is {vector.value}, not {expected}")
        if abs(abs(vector.span) * vector.mu - vector.value) > 0.01 * vector.mu:
            faults.append(f"{vector.quantity} has {abs(vector.span)} mm, not {vector.value / vector.mu}")
    return [f"{case}: {fault}" for fault in faults]


def plain(name: str) -> bool:
    """Whether a quantity's symbol is its name with scripts, in every language."""
    return bool(re.fullmatch(r"(V|a|omega|epsilon|R|F|h)_[0-9A-Z]+(_[nt])?|[FM]_i\d|M_i2", name))


def symbol_of(name: str) -> str:
    letter, _, rest = name.partition("_")
    stem, _, part = rest.partition("_")
    letter = LETTERS.get(letter, letter)
    return f"{letter}^{{{part}}}_{{{stem}}}" if part else f"{letter}_{{{stem}}}"


@pytest.mark.parametrize("case", SAMPLE, ids=str)
def test_sheet_satisfies_the_points_of_a_linkage(case: Case) -> None:
    assert mechanism_faults(case, drawn(case)) == []


@pytest.mark.parametrize("case", SAMPLE, ids=str)
def test_printed_numbers_recompute_and_are_those_of_solve(case: Case) -> None:
    assert number_faults(case, drawn(case)) == []


def moved(case: Case, old: str, new: str, count: int = 1) -> Sheet:
    """The sheet with one piece of its file changed."""
    (svg,) = pages(case)
    assert len(re.findall(old, svg)) >= count
    return read(re.sub(old, new, svg, count=count))


A1 = Case(format="A1")
SPOILED = {
    "L1": (r'(data-name="S2">\n<circle class="main" cx=")\d+', r"\g<1>300"),
    "L3": (r'(?s)(data-quantity="V_A".*?x2=")(\d+)', r"\g<1>1\g<2>"),
    "L4": (r'(data-name="velocity.B_2" [^>]*?y1=")(\d+)', r"\g<1>9\g<2>"),
    "L6": (r'(?s)(data-quantity="a_BA_n".*?y2=")(\d)', r"\g<1>9\g<2>"),
    "L9": (r'("h_2">\n<line class="thin" [^>]*?x2=")(\d+)', r"\g<1>1\g<2>"),
    "L10": (r'(?s)(data-quantity="F_i2".*?y1=")(\d)', r"\g<1>9\g<2>"),
    "L11": (r'(?s)(data-name="driver">.*?= 0,001)( м/мм)', r"\g<1>01\g<2>"),
    "L12": (r"·pa − F", "·pa + F"),
    "L12, arms": (r"(?s)= 18,36(.*?)= 60,76", r"= 60,76\g<1>= 18,36"),
}


@pytest.mark.parametrize("point", SPOILED)
def test_the_examiner_sees_a_spoiled_sheet(point: str) -> None:
    old, new = SPOILED[point]
    spoiled, judge = moved(A1, old, new), POINTS[point.partition(",")[0]]

    try:
        faults = list(judge(A1, spoiled))
    except (AssertionError, ValueError) as stumbled:
        faults = [str(stumbled)]

    assert list(judge(A1, drawn(A1))) == []
    assert faults


def test_a_wrong_digit_is_seen() -> None:
    spoiled = moved(A1, r"(= 2,5·240,9 = 602),2", r"\1,4")

    assert len(equation_faults(spoiled)[1]) == 1


def test_vector_equations_have_at_most_two_unknowns_and_underline_the_known() -> None:
    """Two underlines: known in full; one: known by direction; bars stand above the letters."""
    checked = 0
    for view in drawn(A1).views:
        for text in view.of("line"):
            under = [(a, b) for a, b in text.rules if a.imag < text.baseline]
            if not under:
                continue
            body = text.string.partition(",")[0]
            spans = {(round(a.real, 2), round(b.real, 2)) for a, b in under}
            lines = {span: sum((round(a.real, 2), round(b.real, 2)) == span for a, b in under) for span in spans}
            terms = len(re.findall(r"[A-Za-z][_^]", re.sub(r"\}[_^]", "}", body)))
            single = sum(count == 1 for count in lines.values())
            free = terms - len(lines)
            assert set(lines.values()) <= {1, 2}, text.string
            assert single + 2 * free <= 2 * body.count("="), text.string
            checked += 1
    assert checked == 6


def test_both_balancing_moments_and_their_difference_are_printed() -> None:
    lines = lines_of(drawn(A1)["equations_lever"])

    assert any(line.startswith("M^{Ж}_{зр} = F_{зр}·l_{OA}") for line in lines)
    assert any(line.startswith("ΔM_{зр}") and line.endswith("%") for line in lines)
    assert any("M_{зр} = R_{21}·h_{21}·μ_{l}" in line for line in lines_of(drawn(A1)["equations_forces"]))
