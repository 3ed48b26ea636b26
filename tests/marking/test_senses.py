"""Signs, words and arrows of senses, in any cell of any form; directions required, optional, or ignored."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import openpyxl
import pytest

from kulman import check, cli
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.marking.cells import split_sense
from kulman.variants.spreadsheets.files import read_grid

TASK = "nau-slider-crank"  # variant 1: omega_2 = -28.9 rad/s, M_bal = 89.27 N*m, both seen from the reader
RIGHT_WAY = (
    "-28,79",
    "28.79 cw",
    "28,79 за годинниковою стрілкою",
    "↻ 28,79",
    "28,79 1/с по ч. с.",
    "− 28.79",
    "28.79 (-)",
)
WRONG_WAY = (
    "+28.79",
    "28.79 проти годинникової стрілки",
    "28,79 рад/с проти год. стр.",
    "28,79 1/с, против часовой",
    "28,79 с⁻¹ (против хода часовой стрелки)",
    "28.79 rad/s counter-clockwise",
    "c.c.w. 28.79",
    "28,79 ↺",
    "28,79 рад/с проти",
    "28,79 проти стрілки",
    "28.79 counter-clock-wise",
    "+ 28.79",
    "28.79 (+)",
    "28.79+",
    "＋28.79",
)
HEADS = {"value": "величина;значення;напрям", "class": "student;variant;omega_2;omega_2.sense"}


def write(tmp_path: Path, rows: list[list[object]], suffix: str) -> str:
    """Write rows of cells as CSV or as a workbook."""
    file = tmp_path / f"answers{suffix}"
    if suffix == ".xlsx":
        book = openpyxl.Workbook()
        assert book.active is not None
        for row in rows:
            book.active.append(row)
        book.save(file)
    else:
        stream = io.StringIO()
        csv.writer(stream, delimiter=";").writerows(rows)
        file.write_text(stream.getvalue(), encoding="utf-8")
    return str(file)


def form(name: str, value: object, direction: object = "") -> list[list[object]]:
    """Return a form with one answer."""
    return [["величина", "значення", "напрям"], [name, value, direction]]


def of_class(name: str, value: object, sense: object = "") -> list[list[object]]:
    """Return a class of one student with one answer."""
    return [["student", "variant", name, f"{name}.sense"], ["Student 1", "1", value, sense]]


def verdict(file: str, name: str = "omega_2", **options: str) -> str:
    """Return how one answer is marked, and what is wrong with it."""
    asked = check(TASK, "1", lang="en", **options)  # type: ignore[arg-type]
    answers = asked.read(file)[0]
    assert answers.problems == ()
    line = asked.mark(answers).marked.marking[name]
    return f"{line.verdict} {line.about}".strip()


@pytest.mark.parametrize("suffix", [".csv", ".xlsx"])
@pytest.mark.parametrize("made", [form, of_class])
def test_a_sign_a_word_or_an_arrow_beside_a_number_is_a_sense(tmp_path: Path, made: object, suffix: str) -> None:
    assert callable(made)
    right = {cell: verdict(write(tmp_path, made("omega_2", cell), suffix)) for cell in RIGHT_WAY}
    wrong = {cell: verdict(write(tmp_path, made("omega_2", cell), suffix)) for cell in WRONG_WAY}

    assert right == dict.fromkeys(RIGHT_WAY, "right")
    assert wrong == dict.fromkeys(WRONG_WAY, "wrong direction")


@pytest.mark.parametrize("made", [form, of_class])
@pytest.mark.parametrize(
    ("sense", "found"),
    [
        ("+", "wrong direction"),
        ("+1", "wrong direction"),
        ("↺", "wrong direction"),
        ("проти г.с.", "wrong direction"),
        ("против движения часовой стрелки", "wrong direction"),
        ("anti-clockwise", "wrong direction"),
        ("ω₂ – проти стрілки годинника", "wrong direction"),
        ("-", "right"),
        (-1, "right"),
        ("⟳", "right"),
        ("за ходом годинникової стрілки", "right"),
        ("по часовой", "right"),
        ("c.w.", "right"),
        ("за год.", "right"),
        ("clock-wise", "right"),
    ],
)
def test_a_sense_stands_in_a_column_of_its_own(tmp_path: Path, made: object, sense: object, found: str) -> None:
    assert callable(made)
    assert verdict(write(tmp_path, made("omega_2", 28.79, sense), ".xlsx")) == found


def test_a_number_alone_is_a_size_also_where_a_spreadsheet_has_dropped_the_plus(tmp_path: Path) -> None:
    assert verdict(write(tmp_path, form("omega_2", "28.79"), ".csv")) == "right"
    assert verdict(write(tmp_path, form("omega_2", 28.79), ".xlsx")) == "right"  # typed as +28.79, or as 28.79
    assert verdict(write(tmp_path, form("omega_2", -28.79), ".xlsx")) == "right"


@pytest.mark.parametrize(
    ("value", "sense", "found"),
    [
        ("89,3", "", "right"),
        ("+89,3", "", "right"),  # of a sense that was assumed: a sign alone does not say which
        ("-89,3", "", "right"),
        ("89,3 за год. стрілкою", "", "wrong direction"),
        ("89,3 ↻", "", "wrong direction"),
        ("89,3", "-", "wrong direction"),
        ("89,3", "против часовой", "right"),
        ("-89,3", "cw", "right"),  # assumed clockwise, it came out the other way
    ],
)
def test_of_an_assumed_sense_words_are_judged_and_a_sign_alone_is_not(
    tmp_path: Path, value: str, sense: str, found: str
) -> None:
    assert verdict(write(tmp_path, form("M_bal", value, sense), ".csv"), "M_bal") == found


def test_a_sense_beside_the_unit_is_one(tmp_path: Path) -> None:
    rows: list[list[object]] = [["quantity", "value", "unit"], ["omega_2", "28.79", "1/с, проти год. стрілки"]]

    assert verdict(write(tmp_path, rows, ".csv")) == "wrong direction"


def test_two_senses_that_contradict_each_other_are_told_and_the_column_counts(tmp_path: Path) -> None:
    asked = check(TASK, "1", lang="en")
    told = []
    for value, sense in (("28,79 ↻", "проти"), ("28.79 cw, ccw", "+")):
        answers = asked.read(write(tmp_path, form("omega_2", value, sense), ".csv"))[0]
        told += [problem.text("en") for problem in answers.problems]
        assert answers.lines["omega_2"].sense == 1

    assert len(told) == 2
    assert all("omega_2" in text and "contradict" in text for text in told)


@pytest.mark.parametrize(
    ("text", "rest", "sense"),
    [
        ("28.79 об за хв", "28.79 об за хв", None),  # "per"
        ("5 м за с", "5 м за с", None),
        ("12,5 Н за год", "12,5 Н за год", None),  # "per hour"
        ("16,3 рад/с за год. стрілкою", "16,3 рад/с", -1),
        ("1.5 cw", "1.5", -1),
        ("1.5 kW", "1.5 kW", None),
        ("", "", None),
        ("проти " * 2000, ("проти " * 2000), None),
    ],
)
def test_words_that_say_per_are_no_senses(text: str, rest: str, sense: int | None) -> None:
    assert split_sense(text) == (rest, frozenset() if sense is None else {sense})


def test_an_angle_of_a_vector_may_say_which_way_it_is_counted(tmp_path: Path) -> None:
    asked = check(TASK, "1")
    cells = {"315": "right", "45° за год. стрілкою": "right", "315 ccw": "right", "45 ccw": "wrong direction"}
    found = {cell: verdict(write(tmp_path, form("V_A", 5.65, cell), ".csv"), "V_A") for cell in cells}

    assert found == cells
    assert asked.read(write(tmp_path, form("V_A", 5.65, "45 ↻"), ".csv"))[0].problems == ()


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_form_of_a_class_asks_for_senses(tmp_path: Path, language: str) -> None:
    roster = tmp_path / "roster.csv"
    roster.write_text("student;variant\nStudent 1;1\n", encoding="utf-8")

    file = check(TASK, roster=roster, lang=language).write_form(tmp_path / "form.csv")
    header = read_grid(file).rows[0]
    without = read_grid(
        check(TASK, roster=roster, lang=language, directions="ignored").write_form(tmp_path / "form.csv")
    ).rows[0]

    assert {"omega_2.sense", "epsilon_2.sense", "M_i2.sense", "M_bal.sense", "V_B.dir"} <= {*header}
    assert not {"F_bal.sense", "h_2.sense", "V_B.sense"} & {*header}
    assert [column for column in header if not column.endswith((".sense", ".dir"))] == [*without]


@pytest.mark.parametrize("made", [form, of_class])
@pytest.mark.parametrize(
    ("directions", "cell", "mark", "found"),
    [
        ("optional", "28.79", 100.0, "right"),
        ("required", "28.79", 50.0, "right"),
        ("required", "-28.79", 100.0, "right"),
        ("required", "28.79 cw", 100.0, "right"),
        ("required", "+28.79", 0.0, "wrong direction"),
        ("ignored", "28.79", 100.0, "right"),
        ("ignored", "+28.79", 100.0, "right"),
        ("ignored", "28.79 ccw", 100.0, "right"),
        ("ignored", "-28.79", 100.0, "right"),
        ("ignored", "-38.79", 0.0, "wrong size"),
    ],
)
@pytest.mark.parametrize("by", ["option", "rubric"])
def test_directions_are_required_optional_or_ignored_in_all_forms(
    tmp_path: Path, made: object, directions: str, cell: str, mark: float, found: str, by: str
) -> None:
    assert callable(made)
    rubric = tmp_path / "rubric.toml"
    said = directions if by == "rubric" else "required" if directions != "required" else "ignored"
    rubric.write_text(f'asked = ["omega_2"]\ndirections = "{said}"\n', encoding="utf-8")
    file = write(tmp_path, made("omega_2", cell), ".csv")
    asked = check(TASK, "1", rubric=rubric, directions=directions if by == "option" else None)

    marked = asked.mark(asked.read(file)[0]).marked

    assert marked.mark == mark
    assert f"{marked.marking['omega_2'].verdict} {marked.marking['omega_2'].about}".strip() == found


def test_directions_are_an_option_of_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write(
        tmp_path, [["quantity", "value", "direction"], ["F_3", 3500, "left"], ["omega_2", "28.9 ↺", ""]], ".csv"
    )

    found = {}
    for choice in ("optional", "ignored"):
        with pytest.raises(SystemExit):
            cli.main(["check", TASK, "-v", "1", file, "--directions", choice, "--json"])
        lines = json.loads(capsys.readouterr().out)["lines"]
        found[choice] = [line["verdict"] for line in lines if line["quantity"] in ("F_3", "omega_2")]
    with pytest.raises(SystemExit):
        cli.main(["check", "--help"])
    help_text = capsys.readouterr().out

    assert found == {"optional": ["wrong", "wrong"], "ignored": ["right", "right"]}
    assert "--directions" in help_text
    assert all(choice in help_text for choice in ("required", "optional", "ignored"))


def test_another_word_for_directions_is_refused() -> None:
    with pytest.raises(InputError, match="maybe"):
        check(TASK, "1", directions="maybe")


@pytest.mark.parametrize(
    ("value", "direction", "told"),
    [
        ("3.386", "↻", "↻"),
        ("3,386", "+", "+"),
        (3.386, "-", "-"),
        ("3,386", "проти", "проти"),
        ("3,386 за год. стрілкою", "", "за год. стрілкою"),
        ("3.386 m/s, cw", "0", "cw"),
        ("↺ 3,386 м/с", "", "↺"),
        ("3,386 по часовой", "right", "по часовой"),
        ("3,386 м/с вправо", "", None),
        ("3.386 →", "", None),
        ("3.386 m/s (right)", "0", None),
        ("-3,386", "0", "-"),
        ("+3.386 m/s", "", "+"),
        ("−3,386", "right", "−"),
        ("-", "-", None),  # no answer
    ],
)
def test_a_sense_is_no_direction_of_a_vector_and_that_is_told(
    tmp_path: Path, value: object, direction: str, told: str | None
) -> None:
    rows = [*form("V_B", value, direction), ["omega_2", 28.9, "-"]]

    answers = check(TASK, "1").read(write(tmp_path, rows, ".xlsx"))[0]
    line = answers.lines.get("V_B")

    assert len(answers.problems) == (told is not None)
    assert all(f"V_B: '{told}' is no direction of a vector" in problem.text("en") for problem in answers.problems)
    assert line is None or (abs(line.value or 0.0), line.sense) == (pytest.approx(3.386), None)
    assert line is None or line.direction == (0.0 if {"right", "0"} & {direction} or told is None else None)


def test_the_sign_of_a_reaction_says_whether_its_sense_was_assumed_rightly(tmp_path: Path) -> None:
    answers = check(TASK, "1").read(write(tmp_path, form("R_12", "-500", "0"), ".xlsx"))[0]

    assert answers.problems == ()
