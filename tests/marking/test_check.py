"""`kulman check`: one student's answers marked, told to the student and to the teacher; rosters, rubrics, sheet ids."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kulman import check, cli, load_task, sheet, solve
from kulman.plans.hands.shaky import PRESETS
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.marking.checks import Check
from kulman.variants.marking.keyed import asked_of
from kulman.variants.marking.reading import read_answers
from kulman.variants.marking.report import report_html, report_text, to_json
from kulman.variants.marking.rubric import read_rubric
from kulman.variants.roster import read_roster, variant_of_book
from kulman.variants.sheets import same_id, sheet_id, variant_of_id

TASK = "nau-slider-crank"
HEAD = "task;nau-slider-crank\nvariant;example\n{about}quantity;mm;mu;value;unit;direction\n"
RIGHT = {"V_A": 4.006, "V_BA": 2.124, "V_B": 2.761, "omega_2": -16.34, "a_BA_n": 34.7, "a_B": 221.8, "epsilon_2": -2173}


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run a command; return its status and what it prints."""
    with pytest.raises(SystemExit) as left:
        cli.main(["check", *arguments])
    out, err = capsys.readouterr()
    return int(left.value.code or 0), out, err


def answers(tmp_path: Path, changed: dict[str, float] | None = None, about: str = "", name: str = "a.csv") -> str:
    """Write a form whose answers are right but for those changed."""
    rows = "".join(f"{name};;;{value};;\n" for name, value in {**RIGHT, **(changed or {})}.items())
    file = tmp_path / name
    file.write_text(HEAD.format(about=about) + rows, encoding="utf-8")
    return str(file)


def marked(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    """Return the JSON of a check."""
    status, out, err = run(capsys, TASK, *arguments, "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    return {**found, "verdicts": {line["quantity"]: line["verdict"] for line in found["lines"]}}


def test_right_answers_are_right(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = marked(capsys, answers(tmp_path))

    assert found["first_wrong"] is None
    assert [found["verdicts"][name] for name in RIGHT] == ["right"] * len(RIGHT)
    assert found["counts"]["missing"] == len(found["lines"]) - len(RIGHT)


def test_an_error_counts_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong = {"V_BA": 1.35, "omega_2": -10.4, "a_BA_n": 14.0}

    found = marked(capsys, answers(tmp_path, wrong))

    assert found["first_wrong"] == "V_BA"
    assert found["verdicts"]["V_BA"] == "wrong"
    assert found["verdicts"]["omega_2"] == found["verdicts"]["a_BA_n"] == "carried"


def test_a_turned_normal_acceleration_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong = {"a_B": 295.3}  # with a_BA_n laid off from A to B

    found = marked(capsys, answers(tmp_path, wrong))

    ids = [mistake["id"] for candidate in found["mistakes"] for mistake in candidate["mistakes"]]
    assert found["first_wrong"] == "a_B"
    assert "M38" in ids


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_report_is_in_one_language(tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str) -> None:
    file = answers(tmp_path, {"a_B": 295.3})

    status, out, err = run(capsys, TASK, file, "--lang", language)

    assert (status, err) == (0, "")
    assert bool(re.search("[а-яА-Я]", out.replace(str(tmp_path), ""))) is (language != "en")
    assert not re.search(r"\d\.\d", out.replace(file, "")) or language == "en"


def numbers_of_the_key() -> set[str]:
    """Return how right values might stand in a report, of those that the student has not written."""
    solution = solve(TASK, "example", lang="en")
    words = solution.words
    return {words.short(abs(q.value), 4) for q in solution.quantities.values() if q.value and len(f"{q.value:.4g}") > 3}


@pytest.mark.parametrize("suffix", [".txt", ".html"])
def test_a_student_sees_no_right_number_and_no_right_vector(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], suffix: str
) -> None:
    file, report = answers(tmp_path, {"V_BA": 1.3, "a_B": 300.0, "omega_2": 9.0}), tmp_path / f"report{suffix}"
    written = {f"{abs(value):.4g}" for value in (*RIGHT.values(), 1.3, 300.0, 9.0)}

    run(capsys, TASK, file, "--verdict-only", "--lang", "en", "-o", str(report))
    own = report.read_text(encoding="utf-8")
    run(capsys, TASK, file, "--lang", "en", "-o", str(report))
    teachers = report.read_text(encoding="utf-8")

    hidden = numbers_of_the_key() - written
    shown = {number for number in hidden if re.search(rf"(?<![\d.]){re.escape(number)}(?![\d.])", own)}
    assert shown == set()
    assert len([number for number in hidden if number in teachers]) > 10
    assert "<svg" not in own
    assert ("<svg" in teachers) is (suffix == ".html")
    assert "First wrong step" in own


def test_json_for_a_student_has_verdicts_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = marked(capsys, answers(tmp_path, {"V_BA": 1.3}), "--verdict-only")

    assert "mistakes" not in found
    assert {key for line in found["lines"] for key in line} == {"quantity", "verdict", "about", "answer"}


def test_a_page_escapes_what_students_write_and_loads_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = answers(tmp_path, about="student;<script>alert(1)</script>\n")

    run(capsys, TASK, file, "-o", str(tmp_path / "r.html"))

    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<script" not in page
    assert "&lt;script&gt;" in page
    assert not re.search(r"(?:src|href)=|@import|url\(", page)


def test_another_variant_and_a_wrong_sheet_id_are_told_of(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = sheet_id(load_task(TASK), "5")
    file = answers(tmp_path, about=f"sheet id;{other}\n")

    status, out, _ = run(capsys, TASK, file, "-v", "3", "--lang", "en")

    assert status == 0
    assert f"the sheet id '{other}' is that of variant 5, not of variant 3" in out
    assert "variant: 3" in out
    assert "the form says variant 'example'; it is marked as variant 3" in out


def test_a_sheet_id_belongs_to_task_variant_and_data() -> None:
    task = load_task(TASK)
    ids = {sheet_id(task, name) for name in task.variants}

    assert len(ids) == len(task.variants)
    assert sheet_id(task, "3", {"phi": "121 deg"}) not in ids
    assert sheet_id(task, "3", {"phi": "120 deg"}) == sheet_id(task, "3")
    assert variant_of_id(task, sheet_id(task, "7")) == "7"
    assert all(re.fullmatch(r"[0-9A-HJKMNP-TV-Z]{3}-[0-9A-HJKMNP-TV-Z]{3}", one) for one in ids)


@pytest.mark.parametrize("written", ["T3K12J", "t3k-12j", " Т3К 12J", "T3K-I2J", "T3K-l2j"])
def test_a_sheet_id_may_be_copied_as_people_copy(written: str) -> None:
    assert same_id(written, "T3K-12J")
    assert not same_id("T3K-12H", "T3K-12J")


@pytest.mark.parametrize(
    ("book", "digits", "variant"), [("АТ-2023/417", 1, "7"), ("20230000", 1, "0"), ("123", 2, "3"), ("115", 2, "5")]
)
def test_a_record_book_gives_the_variant(book: str, digits: int, variant: str) -> None:
    assert variant_of_book(load_task(TASK), book, digits) == variant


def test_a_record_book_without_digits_gives_none() -> None:
    with pytest.raises(InputError, match="at least so many digits: 1"):
        variant_of_book(load_task(TASK), "АТ")


def test_a_roster_gives_variants_and_own_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    roster = tmp_path / "class.csv"
    roster.write_text(
        "student;record book;variant;phi [deg]\nА. Перша;11;example;60\nБ. Другий;12;;\n", encoding="utf-8"
    )

    same = marked(capsys, answers(tmp_path, about="student;А.Перша\n"), "--roster", str(roster))
    other = marked(capsys, answers(tmp_path, about="student;Б. Другий\n"), "--roster", str(roster))

    assert same["variant"] == "example"
    assert same["verdicts"]["V_B"] == "right"
    assert other["variant"] == "2"
    assert any("variant 'example'" in note or "варіант «example»" in note for note in other["notes"])


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("student;variant\nX;33\n", "B2: nau-slider-crank has no variant '33'"),
        ("student;phi [deg]\nX;багато\n", "B2, phi"),
        ("student;l_OAA [mm]\nX;5\n", "B1"),
        ("a;b\n1;2\n", "no row says what the columns hold"),
    ],
)
def test_a_wrong_roster_is_refused_with_its_cell(tmp_path: Path, text: str, what: str) -> None:
    file = tmp_path / "r.csv"
    file.write_text(text, encoding="utf-8")

    with pytest.raises(InputError) as caught:
        read_roster(file, load_task(TASK))

    assert what in caught.value.text("en")


def rubric(tmp_path: Path, text: str) -> str:
    file = tmp_path / "rubric.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


def test_a_rubric_weighs_and_asks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = rubric(tmp_path, 'out_of = 10\nasked = ["V_B", "V_BA", "a_B"]\n[weights]\nV_B = 2\n')

    found = marked(capsys, answers(tmp_path, {"V_BA": 1.0}), "--rubric", asked)

    assert [line["quantity"] for line in found["lines"]] == ["V_BA", "V_B", "a_B"]
    verdicts = found["verdicts"]
    worth = 2.0 * (verdicts["V_B"] in ("right", "carried")) + (verdicts["a_B"] in ("right", "carried"))
    assert found["mark"] == pytest.approx(10.0 * worth / 4.0)


def test_a_rubric_sets_tolerances(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    close = rubric(tmp_path, "[tolerance]\nmm = 0.1\npercent = 0.1\ndegrees = 0.05\n")
    file = answers(tmp_path, {"V_B": 2.80})

    assert marked(capsys, file)["verdicts"]["V_B"] == "right"
    assert marked(capsys, file, "--rubric", close)["verdicts"]["V_B"] == "wrong"


def test_a_rubric_may_require_directions(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = 'asked = ["V_BA", "V_B"]\ndirections = "{}"\n'

    half = marked(capsys, answers(tmp_path), "--rubric", rubric(tmp_path, asked.format("required")))

    assert half["mark"] == 50.0
    assert any("no direction" in note for note in half["notes"])
    optional = rubric(tmp_path, asked.format("optional"))
    assert marked(capsys, answers(tmp_path), "--rubric", optional)["mark"] == 100.0


def test_a_rubric_limits_single_quantities(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wide = rubric(tmp_path, '[limits]\nV_BA = "50 cm/s"\n')
    file = answers(tmp_path, {"V_BA": 2.5})

    assert marked(capsys, file)["verdicts"]["V_BA"] == "wrong"
    assert marked(capsys, file, "--rubric", wide)["verdicts"]["V_BA"] == "right"


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("outof = 5", "outof"),
        ('asked = ["V_X"]', "asked: there is no quantity 'V_X'"),
        ("[weights]\nV_B = -1", "weights.V_B"),
        ("[worth]\nalmost = 1", "worth.almost"),
        ("[limits]\nV_B = '1 kg'", "limits.V_B"),
        ("[tolerance]\nmm = true", "tolerance.mm"),
        ("weights = 3", "weights"),
        ('directions = "maybe"', "directions"),
        ("= 3", "not a rubric in TOML"),
    ],
)
def test_a_wrong_rubric_is_refused_with_its_key(tmp_path: Path, text: str, what: str) -> None:
    asked = asked_of(solve(TASK, "example"))

    with pytest.raises(InputError) as caught:
        read_rubric(rubric(tmp_path, text), "normal", asked)

    assert what in caught.value.text("en")


@pytest.mark.parametrize("task", ["nau-slider-crank", "madi-four-bar", "bertyaev-six-bar"])
def test_printed_answers_are_marked(capsys: pytest.CaptureFixture[str], task: str) -> None:
    status, out, err = run(capsys, task, "printed", "--json")

    found = json.loads(out)
    assert (status, err) == (0, "")
    odd = [note for note in found["notes"] if "no direction" not in note]  # sources print sizes alone
    assert [note for note in odd if " makes " not in note] == []  # and slips of the pen
    assert found["counts"]["right"] + found["counts"]["carried"] > 20


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ((TASK,), "nothing to do"),
        ((TASK, "missing.csv"), "there is no such file"),
        ((TASK, "--form", "x.docx"), "ends in one of: .csv, .xlsx"),
        ((TASK, "printed", "-v", "99"), "'99'"),
        ((TASK, "printed", "-o", "x.docx"), "unknown kind of file"),
        ((TASK, "printed", "--preset", "best"), "cad, careful, normal, lenient"),
        (("scheme-01-compressor", "printed"), "the source of scheme-01-compressor prints no answers"),
        ((TASK, "."), "no files with answers"),
    ],
)
def test_what_cannot_be_checked_is_answered_in_one_line(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    what: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LC_ALL", "C")

    status, out, err = run(capsys, *arguments)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert what in err
    assert list(tmp_path.iterdir()) == []


def test_the_command_knows_all_presets() -> None:
    option = next(param for param in cli.check.params if param.name == "preset")

    assert option.type.words == tuple(PRESETS)


@pytest.mark.parametrize("norm", ["gost", "iso"])
def test_a_sheet_bears_the_id_that_its_form_asks_for(tmp_path: Path, norm: str) -> None:
    sheet(TASK, "3", only="velocity", norm=norm, lang="en").save(tmp_path / "sheet.svg")

    assert f"Sheet id: {sheet_id(load_task(TASK), '3')}" in (tmp_path / "sheet.svg").read_text(encoding="utf-8")


def test_answers_are_marked_from_python_without_a_word(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked, done = check(TASK, "example", own=True, lang="en"), list[int]()
    files = [answers(tmp_path), answers(tmp_path, {"a_B": 295.3}, name="b.csv")]

    report = asked.mark(asked.read(files[0])[0])
    results = asked.mark_all(asked.read(*files), tmp_path / "reports", lambda more, whole: done.append(more), jobs=1)

    assert report.own
    assert report.marked.marking.first_wrong is None
    assert results[0].mark == report.marked.mark
    assert (results[1].mark or 0.0) < report.marked.mark
    assert sum(done) == len(list((tmp_path / "reports").glob("*.html"))) == 2
    assert capsys.readouterr() == ("", "")


def test_only_a_file_among_others_may_be_unreadable(tmp_path: Path) -> None:
    asked, told = check(TASK, "example"), list[str]()
    files = [answers(tmp_path), str(tmp_path / "none.csv")]

    found = asked.read(*files, warn=lambda error: told.append(error.key))

    assert [one.unread is None for one in found] == [True, False]
    assert told == ["file-missing"]
    with pytest.raises(InputError):
        asked.read(*files)


NUMBERS = st.sampled_from(("", "0", "-1", "3", "1e30", "1e-30", "0,05", "80", "сто"))
CELLS = st.tuples(NUMBERS, NUMBERS, NUMBERS, st.sampled_from(("", "+", "-", "90", "?")))


@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-19-scotch-yoke"])
@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_whatever_numbers_come_they_are_marked(tmp_path: Path, task: str, data: st.DataObject) -> None:
    """Zeros, nonsense, and values that make the construction impossible."""
    asked = prepared(task)
    names = data.draw(st.lists(st.sampled_from(sorted(asked.asked.quantities)), min_size=3, unique=True))
    rows = [f"{name};{';'.join(data.draw(CELLS))}\n" for name in names]
    file = tmp_path / "any.csv"
    file.write_text(f"quantity;mm;mu;value;direction\nV_A;;;4;\n{''.join(rows)}", encoding="utf-8")

    found = asked.mark(read_answers(file, asked.asked)[0])

    assert 0.0 <= found.marked.mark <= 100.0
    assert report_html(found).endswith("</html>\n")
    assert report_text(found)
    json.dumps(to_json(found), allow_nan=False)


@cache
def prepared(task: str) -> Check:
    """Return a task about to be marked."""
    return check(task)
