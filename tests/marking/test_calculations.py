"""Calculations written in cells: worked out, held against what stands behind them, and never run."""

from __future__ import annotations

import math
import random
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kulman import check
from kulman.tests.support.answer_files import HEAD, messages, one
from kulman.variants.marking.cells import LONGEST, slip_in


@pytest.mark.parametrize(
    ("text", "makes"),
    [
        ("75 · 0,93969 = 70,747675 мм", 70.47675),
        ("(3,14/2 + 2 · 0,2 · 0,36397) · 5 = 8,584192", 8.581922),  # 3.14 written for pi
        ("√(5387,525² + 591,608²) = 5404,102", 5419.910),
        ("W = 3·3 - 1 - 2·4 - 0 = 3·3 - 2·4 - 0 = 1", 0.0),
        ("[15 · 0,68683 + 20 · 0,74177 – (15 + 20) · 0,50194] / (2 · 3,14) = 3,72121", 1.204795),
        ("V_BA/l_AB = 1,35/0,130 = 14,0 м/с²", 10.38462),  # the square forgotten
        ("2,5 × 200 : 2 = 500", 250.0),
        ("80 · sin(90° + 30°) / cos 60° = 80", 138.5641),
        ("-(2 + 3)^2 = 23", -25.0),
        ("10 · 10⁻³ = 0,1", 0.01),
    ],
)
def test_what_does_not_make_what_stands_behind_it_is_found(text: str, makes: float) -> None:
    found = slip_in(text)

    assert found is not None
    assert found.makes == pytest.approx(makes, rel=1e-6, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "100 · 0,93969 = 93,96926",
        "0,05 · 58 = 2,9 м/с",
        "(3,14 · 765/30)² · 0,05 = 320,56",
        "(500 · 30 · 0,001 + 30,94)/0,130 = 353,3",  # cut off, not rounded
        "2 · 91,99949/(1,333 + 1) = 78,86797",
        "500 · 7 = 3500 Н",
        "2487 · 1 = 2500",  # rounded to hundreds
        "0,002 = 0,1 · (120 · 10⁻³)² · 1,2",
        "1,35/0,130 = -10,4",  # a sense
        "3n - 1 - 2p = 1",  # letters are nothing to work out
        "16,3",
        "= 5",
        "a = b = c",
        "((((= 3",
        "1/0 = 3",
        "9^9^9^9 = 1",
        "",
    ],
)
def test_what_agrees_or_cannot_be_worked_out_is_not_told_of(text: str) -> None:
    assert slip_in(text) is None


def test_numbers_rounded_to_three_digits_or_more_agree_with_a_result_that_was_not() -> None:
    dice = random.Random(4)
    for _ in range(2000):
        a, b, c = (dice.uniform(0.1, 900.0) for _ in range(3))
        digits = dice.randrange(3, 7)
        text = f"({a:#.{digits}g} · {b:#.{digits}g} + {c:#.{digits}g})/{a:#.{digits}g} = {(a * b + c) / a:#.{digits}g}"

        assert "e" in text or slip_in(text) is None, text


@pytest.mark.parametrize("piece", ["(", "√", "-", "2^", "0,12+", "3,14·", "sin ", "[", "1=", "²"])
def test_long_calculations_take_no_time(piece: str) -> None:
    begin = time.process_time()
    for length in (LONGEST, 20 * LONGEST):
        slip_in((piece * length)[: length - 2] + "=1")

    assert time.process_time() - begin < 1.0


@settings(max_examples=300, deadline=None)
@given(st.text(alphabet="0123456789,.+-*/^()√²⁻=πsincotg° [", max_size=40))
def test_whatever_is_written_is_worked_out_or_passed_over(text: str) -> None:
    found = slip_in(text)

    assert found is None or math.isfinite(found.makes)


def test_a_calculation_in_a_cell_gives_its_result_and_is_told_of_where_it_is_wrong(tmp_path: Path) -> None:
    rows = "V_B;55,2;4,0/80 = 0,05;55,2 · 0,05 = 2,96;м/с;\nomega_2;;;1,35/0,130 = – 10,8 1/с;;\n"

    found = one(tmp_path, f"{HEAD}{rows}обчислення;;;W = 3·3 - 2·4 = 2;;\nвычисление;;;15·4 = 60;;\n")

    assert found.lines["V_B"].value == pytest.approx(2.96)
    assert found.lines["omega_2"].value == pytest.approx(-10.8)
    assert set(found.lines) == {"V_B", "omega_2"}
    assert [text.partition(": ")[2] for text in messages(found)] == [
        "D2, V_B: '55,2 · 0,05' makes 2,76, not 2,96",
        "D3, omega_2: '1,35/0,130' makes 10,38462, not –10,8",
        "D4, обчислення: '3·3 - 2·4' makes 1, not 2",
    ]


@pytest.mark.parametrize(
    "shown", ["«1.35/0.130» дорівнює 10.38462, а не 10.8", "«1,35/0,130» дорівнює 10,38462, а не 10,8"]
)
def test_numbers_of_a_calculation_are_shown_as_the_student_writes_them(shown: str, tmp_path: Path) -> None:
    written = shown[1:11], shown[-4:]

    found = one(tmp_path, f"{HEAD}omega_2;;;{' = '.join(written)} 1/с;;\n")

    assert [problem.text("uk").partition("omega_2: ")[2] for problem in found.problems] == [shown]


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ("nau-slider-crank", ["makes 0, not", "makes 55,1487", "makes 41.56061", "makes 67,09136"]),
        ("madi-four-bar", ["omega_2", "makes 1267,528", "makes 5419,91", "makes 2283,039"]),
        ("madi-gear", ["D6, a:", "d_b1", "s_1", "rho_p2", "epsilon_alpha", "s_a2"]),
        ("madi-cam", ["makes 0.5, not 55", "makes 1,226"]),
        ("bertyaev-six-bar", ["epsilon_2: '0,597 / 97' makes 0,006154639"]),
    ],
)
def test_slips_of_the_pen_in_the_sources_are_found(task: str, told: list[str]) -> None:
    problems = [problem.text("en") for problem in check(task).read("printed")[0].problems]

    assert len(problems) == len(told)
    assert all(part in text and text.startswith("printed: ") for part, text in zip(told, problems, strict=True))
