"""A subject that the package does not know, registered in one line, gets all that users ask of a task."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from kulman import all_variants, batch, check, handout, load_task, note, sheet, solve
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.packaged import add_texts, packaged
from kulman.scales.scale import Scale
from kulman.tests.support import toy
from kulman.variants.kinds import MODULES
from kulman.variants.making.starter import start
from kulman.variants.reader import check_file, read_text
from kulman.variants.tables import csv_text

FILE = "seesaw.toml"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    toy.register()
    start(FILE, "en", toy.NAME)
    yield tmp_path
    del MODULES[toy.TABLE]


def test_the_template_made_of_its_givens_is_a_task_that_is_in_order() -> None:
    task = load_task(FILE)

    assert check_file(FILE) == ((), ())
    assert (task.id, task.kind, tuple(task.givens)) == ("seesaw", "seesaw", ("l_1", "l_2", "F_1"))
    assert task.values() == pytest.approx({"l_1": 0.2, "l_2": 0.4, "F_1": 100.0, "zero": 0.0}, rel=1e-12)


def test_what_no_seesaw_has_is_a_fault_with_its_line() -> None:
    text = Path(FILE).read_text(encoding="utf-8")

    for old, new, said in (
        ("l_2 = 0.4", "l_2 = 40.0", "variant.l_2: the other arm is more than 100 times as long"),
        ("l_2 = 0.4", "l_2 = -1", "must be greater than zero"),
        ('near = "left"', 'near = "leftt"', "did you mean 'left'"),
        ('F_1 = { unit = "N" }', 'F_1 = { unit = "m" }', "expected"),
        ("F_1", "F_9", "the key 'F_1' is missing"),
    ):
        assert old in text
        faults = read_text(text.replace(old, new), FILE)[1]
        assert said in faults[0].text("en"), faults[0].text("en")
        assert faults[0].text("en").startswith(f"{FILE}:")


def test_solution_and_its_condition_are_those_of_the_balance_of_moments() -> None:
    solution = solve(FILE, set={"l_1": "300 mm", "F_1": "80 N"}, scales={"mu_F": 2.0}, condition=True)

    assert solution["F_2"].value == pytest.approx(80.0 * 0.3 / 0.4, rel=1e-15)
    assert solution["l_AB"].value == pytest.approx(0.7, rel=1e-15)
    assert (solution["Q_O"].y, solution["Q_O"].mm) == pytest.approx((140.0, 70.0), rel=1e-14)
    assert solution.scales["mu_F"] == Scale("mu_F", 2.0, "N")
    assert solution.conditions["F_2"].value == pytest.approx(3.0, rel=1e-6)
    assert "Scheme of the seesaw" in solution.table("en")
    with pytest.raises(InputError, match="more than 100 times as long"):
        solve(FILE, set={"l_2": "21 m"})


@pytest.mark.parametrize("language", LANGUAGES)
def test_sheet_note_and_handout_are_in_its_own_words(language: str) -> None:
    drawn, told = sheet(FILE, lang=language), note(FILE, lang=language)
    begun = [handout(FILE, lang=language, steps=steps).svg() for steps in (0, 1)]

    told.save("note.md")
    text = Path("note.md").read_text(encoding="utf-8")
    assert {view.name for view in drawn.views} == {"givens", "scheme", "balance"}
    for key in ("heading.seesaw_scheme", "seesaw.scheme.load"):
        assert packaged(toy.__name__, "texts", language)[key] in text
    assert begun[0].count('class="link"') < begun[1].count('class="link"') < drawn.svg().count('class="link"')


def test_form_is_filled_in_and_marked() -> None:
    asked, solution = check(FILE, "1", lang="en"), solve(FILE)

    form = asked.write_form("form.csv").read_text(encoding="utf-8-sig")
    rows = [("name", "value", "unit"), *((q.name, q.value, q.unit) for q in map(solution.__getitem__, solution))]
    wrong = [(name, 2.0 * value if name == "F_2" else value, unit) for name, value, unit in rows[1:]]
    Path("right.csv").write_text(csv_text(rows, "en"), encoding="utf-8")
    Path("wrong.csv").write_text(csv_text([rows[0], *wrong], "en"), encoding="utf-8")

    assert all(f"{name}," in form for name in ("F_2", "Q_O", "l_AB", "mu_F"))
    marks = [asked.mark(asked.read(name)[0]).marked.mark for name in ("right.csv", "wrong.csv")]
    assert marks[0] == 100.0
    assert 0.0 < marks[1] < 100.0


def test_a_class_has_columns_of_its_givens_and_new_variants_its_ranges() -> None:
    roster = "student,variant,F_1 [N],near\nA,1,120,\nB,1,,\n"
    Path("class.csv").write_text(roster, encoding="utf-8")

    made = batch([FILE], "class.csv", "out", kinds=("svg",), lang="en", jobs=1)
    new = all_variants(FILE, make=3, ranges={"l_1": "0.2..0.4/0.05 m"}, lang="en")

    assert made.problems == []
    assert len({path.read_bytes() for path in Path("out").rglob("*.svg")}) == 2
    assert set(new.keys) == {"1", "2", "3"}


def test_what_it_has_not_is_refused_in_one_line() -> None:
    from kulman import chart, sweep

    for ask in (sweep, chart):
        with pytest.raises(InputError) as refused:
            ask(FILE)
        assert refused.value.key == "kind-without"


def test_nobody_else_notices_it() -> None:
    before = packaged("kulman.scales", "messages", "uk")
    add_texts(toy.__name__)  # twice is once

    assert packaged("kulman.scales", "messages", "uk") == before
    code = "import kulman; from kulman.scales import packaged as p; kulman.load_task('madi-gear'); print(p._ADDED)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
    assert replace(load_task("madi-gear"), file=None).kind == "gear"
