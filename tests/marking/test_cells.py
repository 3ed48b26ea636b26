"""What stands in a cell of an answer: calculations, units, scale factors; signs, words and arrows of senses."""

from __future__ import annotations

import math
import random
import time
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kulman import check
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.answer_files import HEAD, messages, one, write
from kulman.variants.marking.cells import LONGEST, Mu, rounded, scale_factor, slip_in, split_sense
from kulman.variants.marking.checks import Check
from kulman.variants.marking.marked import Desk
from kulman.variants.spreadsheets.files import read_grid
from kulman.variants.spreadsheets.grid import quantity_part

TASK = "nau-slider-crank"  # variant 1: omega_2 = -28.9 rad/s, M_bal = 89.27 N*m, both seen from the reader


@pytest.mark.parametrize(
    ("text", "makes"),
    [
        ("75 · 0,93969 = 70,747675 мм", 70.47675),
        ("(3,14/2 + 2 · 0,2 · 0,36397) · 5 = 8,584192", 8.581922),  # 3.14 written for pi
        ("√(5387,525² + 591,608²) = 5404,102", 5419.910),
        ("W = 3·3 - 1 - 2·4 - 0 = 3·3 - 2·4 - 0 = 1", 0.0),
        ("[15 · 0,68683 + 20 · 0,74177 – (15 + 20) · 0,50194] / (2 · 3,14) = 3,72121", 1.204795),
        ("V_BA/l_AB = 1,35/0,130 = 14,0 м/с²", 10.38462),  # the square forgotten
        ("80 · sin(90° + 30°) / cos 60° = 80", 138.5641),
        ("2 · ctg 45° + tg 45° = 2,00", 3.0),
        ("-(2 + 3)^2 = 23", -25.0),
        ("10 · 10⁻³ : 2 = 0,0100", 0.005),
        ("0,12345^2 = 0,01534", 0.015239902),  # rounding of a base counts as often as its power says
    ],
)
def test_what_does_not_make_what_stands_behind_it_is_found(text: str, makes: float) -> None:
    slip = slip_in(text)

    assert slip is not None
    assert slip.makes == pytest.approx(makes, rel=1e-6, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        *("0,05 · 58 = 2,9 м/с", "(3,14 · 765/30)² · 0,05 = 320,56", "2 · 91,99949/(1,333 + 1) = 78,86797"),
        "(500 · 30 · 0,001 + 30,94)/0,130 = 353,3",  # cut off, not rounded
        *("500 · 7 = 3500 Н", "0,002 = 0,1 · (120 · 10⁻³)² · 1,2", "0,12345^2 = 0,01524"),
        "2487 · 1 = 2500",  # rounded to hundreds
        "1,35/0,130 = -10,4",  # a sense
        "3n - 1 - 2p = 1",  # letters are nothing to work out
        *("16,3", "= 5", "a = b = c", "((((= 3", "1/0 = 3", "9^9^9^9 = 1", ""),
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


def test_long_calculations_take_no_time() -> None:
    begin = time.process_time()
    for piece in ("(", "√", "-", "2^", "0,12+", "3,14·", "sin ", "[", "1=", "²"):
        for length in (LONGEST, 20 * LONGEST):
            slip_in((piece * length)[: length - 2] + "=1")

    assert time.process_time() - begin < 1.0


@settings(max_examples=150)
@given(st.text(alphabet="0123456789,.+-*/^()√²⁻=πsincotg° [", max_size=40))
def test_whatever_is_written_is_worked_out_or_passed_over(text: str) -> None:
    slip = slip_in(text)

    assert slip is None or math.isfinite(slip.makes)


def test_a_calculation_in_a_cell_gives_its_result_and_is_told_of_where_it_is_wrong(tmp_path: Path) -> None:
    rows = "V_B;55,2;4,0/80 = 0,05;55,2 · 0,05 = 2,96;м/с;\nomega_2;;;1,35/0,130 = – 10,8 1/с;;\n"

    more = "обчислення;;;W = 3·3 - 2·4 = 2;;\nвычисление;;;15·4 = 60;;\nвычисление;;;15,·4. = 61;;\n"
    answers = one(tmp_path, f"{HEAD}{rows}{more}")
    with_point = one(tmp_path, f"{HEAD}omega_2;;;1.35/0.130 = 10.8 1/с;;\n")
    whole = one(tmp_path, f"{HEAD}omega_2;;;135/13 = 11 1/с;;\n")

    assert {name: line.value for name, line in answers.lines.items()} == {"V_B": 2.96, "omega_2": -10.8}
    assert [text.partition(": ")[2] for text in messages(answers)] == [
        "D2, V_B: '55,2 · 0,05' makes 2,76, not 2,96",
        "D3, omega_2: '1,35/0,130' makes 10,38462, not –10,8",
        "D4, обчислення: '3·3 - 2·4' makes 1, not 2",
        "D6, вычисление: '15,·4.' makes 60, not 61",
    ]
    assert "«1.35/0.130» дорівнює 10.38462, а не 10.8" in with_point.problems[0].text("uk")  # as the student writes
    assert "«135/13» дорівнює 10,38462, а не 11" in whole.problems[0].text("uk")


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ("nau-slider-crank", ["makes 0, not", "makes 55,1487", "makes 41.56061", "makes 67,09136"]),
        ("madi-four-bar", ["omega_2", "makes 1267,528", "makes 5419,91", "makes 2283,039"]),
        ("madi-gear", ["D5, a:", "d_b1", "s_1", "rho_p2", "epsilon_alpha", "s_a2"]),
        ("madi-cam", ["makes 0.5, not 55", "makes 1,226"]),
        ("bertyaev-six-bar", ["epsilon_2: '0,597 / 97' makes 0,006154639"]),
    ],
)
def test_slips_of_the_pen_in_the_sources_are_found(task: str, told: list[str]) -> None:
    problems = [problem.text("en") for problem in check(task).read("printed")[0].problems]

    assert len(problems) == len(told)
    assert all(part in text and text.startswith("printed: ") for part, text in zip(told, problems, strict=True))


def test_units_stand_in_cells(tmp_path: Path) -> None:
    lines = {
        "12,5 мм": (12.5, 1),
        "12.5mm": (12.5, 1),
        "12,5 мм.": (12.5, 1),
        "1,25 см": (12.5, 1),
        " 12,50 ": (12.5, 2),
        "0": (0.0, 0),
    }
    for cell, (mm, decimals) in lines.items():
        answers = one(tmp_path, f"{HEAD}V_B;{cell};;2,76;;\n")

        assert answers.problems == ()
        assert (answers.lines["V_B"].mm, answers.lines["V_B"].decimals) == (pytest.approx(mm), decimals)


@pytest.mark.parametrize(
    ("cell", "mu", "sure"),
    [
        *(("0,05", 0.05, False), ("20", 20.0, False), ("0,05 (м/с)/мм", 0.05, True)),
        *(("20 мм/(м/с)", 0.05, True), ("2 cm/(m/s)", 0.05, True), ("0.5 (m/s)/cm", 0.05, True)),
    ],
)
def test_a_scale_factor_is_meant_either_way_unless_its_unit_says_which(
    tmp_path: Path, cell: str, mu: float, sure: bool
) -> None:
    answers = one(tmp_path, f"{HEAD}V_B;55;{cell};2,76;;\n")

    factor = answers.lines["V_B"].factor
    assert answers.problems == ()
    assert factor is not None
    assert (factor.value, factor.sure) == (pytest.approx(mu), sure)


@pytest.mark.parametrize(
    ("written", "mu"),
    [
        *(("0.5 cm/mm", 5e-3), ("0.5 мм/м", 2.0), ("2 мм/мм", 2e-3), ("2 m/mm", 2.0)),
        *(("1:5", 5e-3), ("М 1 : 2,5", 2.5e-3), ("2:1", 0.5e-3)),
    ],
)
def test_a_scale_factor_of_lengths_in_mm_says_which_way_it_is_meant(written: str, mu: float) -> None:
    assert scale_factor(written, "", "m/mm", "m/mm") == Mu(pytest.approx(mu), sure=True)
    if ":" in written:
        assert scale_factor(written, "м/мм", "m/mm", "m/mm") == Mu(pytest.approx(mu), sure=True)
        for bad in (f"{written}0 Н", written.replace("1", "0")):
            with pytest.raises(InputError):
                scale_factor(bad, "", "m/mm", "m/mm")
        with pytest.raises(InputError):  # of what is no length
            scale_factor(written, "", "(m/s)/mm", "(m/s)/mm")


@pytest.mark.parametrize(
    ("text", "value", "half"),
    [
        *(("16,3", 16.3, 0.05), ("16", 16.0, 0.5), ("2.5 kN", 2500.0, 50.0), ("1,20e3", 1200.0, 5.0)),
        *(("1/4", 0.25, None), ("0", 0.0, None), ("16", None, None)),
    ],
)
def test_the_last_digit_of_a_number_is_known(text: str, value: float | None, half: float | None) -> None:
    assert rounded(text, value) == (None if half is None else pytest.approx(half))


@pytest.mark.parametrize(
    ("written", "meant"), [("12б3", 12.3), ("0ю262", 0.262), ("5Ю6 м/с", 5.6), ("−1Б5", -1.5), ("0ю5·2б5=1ю25", 1.25)]
)
def test_the_letter_of_the_key_of_a_decimal_sign_is_one_and_that_is_told(
    tmp_path: Path, written: str, meant: float
) -> None:
    """Comma and point lie where the Cyrillic keyboards have б and ю: `12б3` was 12 of an unknown unit."""
    size = f"{abs(meant)}".replace(".", "ю")
    rows = f"V_B;{size};{size};{written};;{size}°\nomega_2;;;{written};;\nmu_a;;;{size};;\n"

    answers = one(tmp_path, HEAD + rows)
    line, factor, told = answers.lines["V_B"], answers.lines["V_B"].factor, messages(answers)

    assert (line.mm, line.value, factor and factor.value) == pytest.approx((abs(meant), meant, abs(meant)))
    assert line.direction == pytest.approx(math.radians(abs(meant)))
    assert answers.lines["omega_2"].value == pytest.approx(meant)
    assert answers.scales["mu_a"].value == pytest.approx(abs(meant))
    told = [text for text in told if "decimal sign" in text]
    assert [sum(f"{of}, {name}: " in text for text in told) for of, name in PLACES] == [1] * 6
    assert "read as 12.3" in told[0] or written != "12б3"


@pytest.mark.parametrize("written", ["1О,5", "12k3", "1O5 м/с", "12,З", "12,ЗЗ", "1ю500б5"])
def test_a_number_with_a_letter_in_it_is_none_and_not_what_stands_before_the_letter(
    tmp_path: Path, written: str
) -> None:
    answers = one(tmp_path, f"{HEAD}V_B;{written};{written};{written};;\na_B;49;4;196;;\n")

    assert "V_B" not in answers.lines
    assert len([text for text in messages(answers) if "V_B" in text and "is not a number" in text]) >= 1


@pytest.mark.parametrize(
    ("row", "where", "what"),
    [
        ("V_B;багато;;2,76;;", "B2, V_B", "is not a number"),
        ("V_B;55;0;2,76;;", "C2, V_B", "greater than zero"),
        ("V_B;-55;;2,76;;", "B2, V_B", "cannot be negative"),
        ("V_B;=5*11;;2,76;;", "B2, V_B", "formulas are not worked out"),
        ("V_B;55;;2,76 кг;;", "D2, V_B", "unit kg does not fit"),
        ("V_B;55;;2,76;;кудись", "F2, V_B", "is no direction"),
        ("V_BB;55;;2,76;;", "A2, V_BB", "did you mean 'V_B'"),
        ("V_B;55 м/с;;2,76;;", "B2, V_B", "unit m/s does not fit"),
        ("V_B;1e400;;2,76;;", "B2, V_B", "too large or too small"),
        ("V_B;55;0,05 кг;2,76;;", "C2, V_B", "unit kg does not fit"),
    ],
)
def test_a_bad_cell_is_told_of_with_its_place_and_the_rest_is_read(
    tmp_path: Path, row: str, where: str, what: str
) -> None:
    answers = one(tmp_path, f"{HEAD}{row}\na_B;49;4;196;;\n")

    (told,) = messages(answers)
    assert where in told
    assert what in told
    assert answers.lines["a_B"].value == pytest.approx(196.0)
    if what == "unit kg does not fit":  # a value with a wrong unit is taken in that of the form
        assert answers.lines["V_B"].value == pytest.approx(2.76)


PLACES = (("B2", "V_B"), ("C2", "V_B"), ("D2", "V_B"), ("F2", "V_B"), ("D3", "omega_2"), ("D4", "mu_a"))
RIGHT_WAY = (
    *("-28,79", "28.79 cw", "28,79 за годинниковою стрілкою", "↻ 28,79", "28,79 1/с по ч. с.", "− 28.79", "28.79 (-)"),
    "≈ −28,79",
)
WRONG_WAY = (
    *("+28.79", "28.79 проти годинникової стрілки", "28,79 рад/с проти год. стр.", "28,79 1/с, против часовой"),
    *("28,79 с⁻¹ (против хода часовой стрелки)", "28.79 rad/s counter-clockwise", "c.c.w. 28.79", "28,79 ↺"),
    *("28,79 рад/с проти", "28,79 проти стрілки", "28.79 counter-clock-wise", "+ 28.79", "28.79 (+)", "28.79+"),
    "＋28.79",
)
WRONG_SENSES: tuple[object, ...] = (
    *("+", "+1", "↺", "проти г.с.", "против движения часовой стрелки", "anti-clockwise"),
    "ω₂ – проти стрілки годинника",
)
RIGHT_SENSES: tuple[object, ...] = (
    *("-", -1, "⟳", "за ходом годинникової стрілки", "по часовой", "c.w.", "за год.", "clock-wise"),
)


def form(name: str, value: object, direction: object = "") -> list[list[object]]:
    """Return a form with one answer."""
    return [["величина", "значення", "напрям"], [name, value, direction]]


@cache
def asked(**options: Any) -> Check:
    return check(TASK, "1", lang="en", **options)


def verdicts(file: Path, name: str = "omega_2") -> list[str]:
    """Return how one quantity is marked, of each student in a file."""
    desk, found = Desk(asked()), []
    for answers in asked().read(str(file)):
        assert answers.problems == ()
        line = desk.mark(answers).marking[name]
        found.append(f"{line.verdict} {line.about}".strip())
    return found


@pytest.mark.parametrize("suffix", [".csv", ".xlsx"])
def test_a_sign_a_word_or_an_arrow_beside_a_number_or_in_its_own_column_is_a_sense(tmp_path: Path, suffix: str) -> None:
    cells: list[tuple[object, object]] = [
        *((text, "") for text in RIGHT_WAY + WRONG_WAY),
        *((28.79, sense) for sense in RIGHT_SENSES + WRONG_SENSES),
    ]
    rows = [
        ["student", "variant", "omega_2", "omega_2.sense"],
        *([f"S{value}{sense}", "1", value, sense] for value, sense in cells),
    ]

    of_class = verdicts(write(tmp_path, rows, suffix))

    right = {*RIGHT_WAY, *RIGHT_SENSES}
    assert of_class == ["right" if {value, sense} & right else "wrong direction" for value, sense in cells]
    for value, sense in (cells[1], cells[9], cells[-1], cells[-10]):
        (of_form,) = verdicts(write(tmp_path, form("omega_2", value, sense), suffix))
        assert of_form == of_class[cells.index((value, sense))]


def test_a_number_alone_is_a_size_also_where_a_spreadsheet_has_dropped_the_plus(tmp_path: Path) -> None:
    for value in (28.79, -28.79):  # typed as +28.79, or as 28.79
        assert verdicts(write(tmp_path, form("omega_2", value), ".xlsx")) == ["right"]
    assert verdicts(write(tmp_path, form("omega_2", "28.79"), ".csv")) == ["right"]


@pytest.mark.parametrize(
    ("value", "sense", "verdict"),
    [
        *(("89,3", "", "right"), ("-89,3", "", "right")),
        ("+89,3", "", "right"),  # of a sense that was assumed: a sign alone does not say which
        *(("89,3 за год. стрілкою", "", "wrong direction"), ("89,3 ↻", "", "wrong direction")),
        *(("89,3", "-", "wrong direction"), ("89,3", "против часовой", "right")),
        ("-89,3", "cw", "right"),  # assumed clockwise, it came out the other way
    ],
)
def test_of_an_assumed_sense_words_are_judged_and_a_sign_alone_is_not(
    tmp_path: Path, value: str, sense: str, verdict: str
) -> None:
    assert verdicts(write(tmp_path, form("M_bal", value, sense)), "M_bal") == [verdict]


def test_senses_stand_beside_units_and_beside_angles_and_contradictions_are_told(tmp_path: Path) -> None:
    beside_unit = [["quantity", "value", "unit"], ["omega_2", "28.79", "1/с, проти год. стрілки"]]
    assert verdicts(write(tmp_path, beside_unit)) == ["wrong direction"]

    angles = {"315": "right", "45° за год. стрілкою": "right", "315 ccw": "right", "45 ccw": "wrong direction"}
    for cell, verdict in (angles | {"45 ↻": "right"}).items():
        assert verdicts(write(tmp_path, form("V_A", 5.65, cell)), "V_A") == [verdict]

    for value, sense in (("28,79 ↻", "проти"), ("28.79 cw, ccw", "+")):
        answers = asked().read(str(write(tmp_path, form("omega_2", value, sense))))[0]
        assert ["contradict" in text and "omega_2" in text for text in messages(answers)] == [True]
        assert answers.lines["omega_2"].sense == 1  # what its own column says


@pytest.mark.parametrize(
    ("text", "rest", "sense"),
    [
        ("28.79 об за хв", "28.79 об за хв", None),  # "per"
        ("5 м за с", "5 м за с", None),
        ("12,5 Н за год", "12,5 Н за год", None),  # "per hour"
        *(("16,3 рад/с за год. стрілкою", "16,3 рад/с", -1), ("1.5 cw", "1.5", -1), ("1.5 kW", "1.5 kW", None)),
        *(("", "", None), ("проти " * 2000, "проти " * 2000, None)),
    ],
)
def test_words_that_say_per_are_no_senses(text: str, rest: str, sense: int | None) -> None:
    assert split_sense(text) == (rest, frozenset() if sense is None else {sense})


def test_the_form_of_a_class_asks_for_senses(tmp_path: Path) -> None:
    roster = write(tmp_path, [["student", "variant"], ["Student 1", "1"]], name="roster")

    with_senses, without = (
        read_grid(check(TASK, roster=roster, directions=how).write_form(tmp_path / f"{how}.csv")).rows[0]
        for how in (None, "ignored")
    )

    turning = {f"{name}, direction" for name in ("ω_2", "ε_2", "M_i2", "M_bal", "V_B")}
    assert turning <= {*with_senses}
    assert not {"h_2, direction", "μ_V, direction"} & {*with_senses}
    assert [column for column in with_senses if not column.endswith("direction")] == [*without]
    names = {column[0] for text in with_senses if (column := quantity_part(text)) is not None}
    assert {"V_B", "omega_2", "M_bal", "mu_V"} <= names


@pytest.mark.parametrize(
    ("directions", "cell", "mark", "verdict"),
    [
        *(("optional", "28.79", 100.0, "right"), ("required", "28.79", 50.0, "right")),
        *(("required", "-28.79", 100.0, "right"), ("required", "28.79 cw", 100.0, "right")),
        *(("required", "+28.79", 0.0, "wrong direction"), ("ignored", "28.79", 100.0, "right")),
        *(("ignored", "+28.79", 100.0, "right"), ("ignored", "28.79 ccw", 100.0, "right")),
        ("ignored", "-38.79", 0.0, "wrong size"),
    ],
)
@pytest.mark.parametrize("by", ["option", "rubric"])
def test_directions_are_required_optional_or_ignored(
    tmp_path: Path, directions: str, cell: str, mark: float, verdict: str, by: str
) -> None:
    rubric = tmp_path / "rubric.toml"
    other = "required" if directions != "required" else "ignored"  # which the option overrules
    rubric.write_text(f'asked = ["omega_2"]\ndirections = "{directions if by == "rubric" else other}"\n', "utf-8")
    of_task = check(TASK, "1", rubric=rubric, directions=directions if by == "option" else None)

    marked = of_task.mark(of_task.read(str(write(tmp_path, form("omega_2", cell))))[0]).marked

    line = marked.marking["omega_2"]
    with pytest.raises(InputError, match="maybe"):
        check(TASK, "1", directions="maybe")
    assert (marked.mark, f"{line.verdict} {line.about}".strip()) == (mark, verdict)


@pytest.mark.parametrize(
    ("value", "direction", "verdict"),
    [
        *(("0,6019", word, "right") for word in ("влево", "ліворуч", "left", "←", "193,4", "193,4°")),
        *(("0,6019", text, "wrong direction") for text in ("вправо", "вниз", "↑", "180", "180°")),
        *(
            ("0,6019 м/с влево", "", "right"),
            ("0,6019 left", "193", "right"),
            ("0,6019 left", "185", "wrong direction"),
        ),
    ],
)
def test_a_word_of_direction_is_right_in_its_quarter(tmp_path: Path, value: str, direction: str, verdict: str) -> None:
    of_task = check("scheme-09-shaper", "3", lang="en")

    report = of_task.mark(of_task.read(str(write(tmp_path, form("V_A3C", value, direction))))[0])
    line = report.marked.marking["V_A3C"]  # at 193.4°

    assert f"{line.verdict} {line.about}".strip() == verdict
    assert ("180° ± 45°" in report.text()) is bool({"влево", "ліворуч", "left", "←", ""} & {direction})


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_line_that_earns_half_without_its_direction_says_so(tmp_path: Path, language: str) -> None:
    """Three right rows without directions earned 2 of 5, and no word of the report said why."""
    half = {"uk": "без напряму чи знака: половина", "ru": "без направления или знака: половина"}
    rows = [*form("omega_2", "28.79"), ["V_B", "3.386", ""], ["V_A", "5.65", "315"], ["epsilon_2", "1e9", ""]]
    file = str(write(tmp_path, rows))

    for directions, halved in (("required", ["V_B", "omega_2"]), ("optional", []), ("ignored", [])):
        of_task = check(TASK, "1", lang=language, directions=directions)
        report = of_task.mark(of_task.read(file)[0])
        said = {row.line.name: half.get(language, "without direction or sense: half") in row.verdict
                for _, rows in report.parts for row in rows}  # fmt: skip
        assert [name for name, one in said.items() if one] == halved
        noted = [note for note in report.marked.notes if note.key == "marked-halved"]
        assert [note.data["n"] for note in noted] == [2] * bool(halved)
        for text in (note.text(language) for note in noted):
            assert text in report.text()
            assert escape(text) in report._repr_html_()


@pytest.mark.parametrize(
    ("value", "direction", "told"),
    [
        *(("3.386", "↻", "↻"), ("3,386", "+", "+"), (3.386, "-", "-"), ("3,386", "проти", "проти")),
        *(("3,386 за год. стрілкою", "", "за год. стрілкою"), ("3.386 m/s, cw", "0", "cw"), ("↺ 3,386 м/с", "", "↺")),
        *(("3,386 по часовой", "right", "по часовой"), ("3,386 м/с вправо", "", None), ("3.386 →", "", None)),
        *(("3.386 m/s (right)", "0", None), ("-3,386", "0", "-"), ("+3.386 m/s", "", "+"), ("−3,386", "right", "−")),
        ("-", "-", None),  # no answer
    ],
)
def test_a_sense_is_no_direction_of_a_vector_and_that_is_told(
    tmp_path: Path, value: object, direction: str, told: str | None
) -> None:
    rows = [*form("V_B", value, direction), ["omega_2", 28.9, "-"]]

    answers = asked().read(str(write(tmp_path, rows, ".xlsx")))[0]
    line = answers.lines.get("V_B")

    assert [f"V_B: '{told}' is no direction of a vector" in text for text in messages(answers)] == [True] * bool(told)
    assert line is None or (abs(line.value or 0.0), line.sense) == (pytest.approx(3.386), None)
    assert line is None or line.direction == (0.0 if {"right", "0"} & {direction} or told is None else None)


def test_one_degree_is_a_direction_of_a_vector_a_sense_of_a_scalar_and_a_side_no_sense(tmp_path: Path) -> None:
    rows = "V_B;;;5,6;;1\nV_A;;;5,9;;-1\nomega_2;;;15,7;;1\nomega_1;;;50;;вліво\nR_12;;;-500;;0\n"

    answers = one(tmp_path, HEAD + rows)

    lines = answers.lines
    assert lines["V_B"].direction == pytest.approx(math.radians(1.0))
    assert lines["V_A"].direction == pytest.approx(math.radians(-1.0))
    assert (lines["omega_2"].direction, lines["omega_2"].sense) == (None, 1)
    assert (lines["omega_1"].direction, lines["omega_1"].value) == (None, pytest.approx(50.0))
    assert lines["R_12"].value == pytest.approx(-500.0)  # it came out against the sense that was assumed
    assert ["omega_1" in text and "a sense" in text for text in messages(answers)] == [True]
