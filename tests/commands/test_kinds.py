"""Kinds of tasks: loaded by their table alone; one that the package does not know, registered in a line, gets all."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kulman import all_variants, batch, chart, check, handout, load_task, note, sheet, solve, sweep
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.packaged import add_texts, packaged
from kulman.scales.scale import Scale
from kulman.tests.commands.test_layers import loaded
from kulman.tests.support import toy
from kulman.tests.support.cases import solve_case
from kulman.variants.case import Case, Kind, beside, kind_of
from kulman.variants.kinds import KINDS, MODULES
from kulman.variants.making.starter import start
from kulman.variants.reader import check_file, read_text
from kulman.variants.tables import _csv_text

FILE = "seesaw.toml"


class Bare(Kind[Any, Any]):
    """A kind that says nothing but its name, and that nothing moves."""

    table, plans, moves = "bare", (), False


@pytest.fixture(scope="module")
def case() -> Case:
    return solve_case("nau-slider-crank", None, None, "position", None)


@pytest.fixture
def seesaw(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The name of a file of a subject that the package does not know, as it is begun; later nobody knows it again."""
    monkeypatch.setattr("kulman.scales.packaged._ADDED", [])
    toy.register()
    start(FILE, "en", toy.NAME)
    yield FILE
    del MODULES[toy.TABLE]
    packaged.cache_clear()


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        pytest.param(lambda case: beside(replace(case.task, kind="bare"), "charts"), "chart", id="chart"),
        pytest.param(lambda case: replace(case.task, subject=None).mechanism, "mechanism", id="sweep of a cycle"),
    ],
)
def test_what_a_kind_has_not_is_refused_in_one_line(asked: Callable[[Case], Any], named: str, case: Case) -> None:
    with pytest.raises(InputError) as refused:
        asked(case)

    assert refused.value.key == "kind-without"
    for language in LANGUAGES:
        line = refused.value.text(language)
        assert line.startswith("nau-slider-crank: ")
        assert line.split().count(named) == 1
        assert "\n" not in line


def test_a_bare_kind_warns_of_nothing_checks_nothing_and_refuses_no_number(case: Case) -> None:
    bare = Bare()

    assert (bare.warnings(case.solved), bare.checks(case.solved), bare.course(case.solved)) == ((), (), None)
    assert [*bare.impossible({"l_OA": -1.0})] == []


def test_every_table_leads_to_its_kind() -> None:
    assert {table: kind_of(table).table for table in MODULES} == {table: table for table in MODULES}
    assert len(set(KINDS)) == len(MODULES)


@pytest.mark.parametrize("task", ["madi-cam", "madi-gear"])
def test_reading_a_task_about_a_cam_or_gears_needs_no_arrays(task: str) -> None:
    assert loaded(f"from kulman import load_task; load_task('{task}')") == set()


def test_the_template_made_of_its_givens_is_a_task_that_is_in_order(seesaw: str) -> None:
    task = load_task(seesaw)

    assert check_file(seesaw) == ((), ())
    assert (task.id, task.kind, tuple(task.givens)) == ("seesaw", "seesaw", ("l_1", "l_2", "F_1"))
    assert task.values() == pytest.approx({"l_1": 0.2, "l_2": 0.4, "F_1": 100.0, "zero": 0.0}, rel=1e-12)


def test_what_no_seesaw_has_is_a_fault_with_its_line(seesaw: str) -> None:
    text = Path(seesaw).read_text(encoding="utf-8")

    for old, new, said in (
        ("l_2 = 0.4", "l_2 = 40.0", "variant.l_2: the other arm is more than 100 times as long"),
        ("l_2 = 0.4", "l_2 = -1", "must be greater than zero"),
        ('near = "left"', 'near = "leftt"', "did you mean 'left'"),
        ('F_1 = { unit = "N" }', 'F_1 = { unit = "m" }', "expected"),
        ("F_1", "F_9", "the key 'F_1' is missing"),
    ):
        assert old in text
        fault = read_text(text.replace(old, new), seesaw)[1][0].text("en")
        assert said in fault, fault
        assert fault.startswith(f"{seesaw}:")


def test_solution_and_its_condition_are_those_of_the_balance_of_moments(seesaw: str) -> None:
    solution = solve(seesaw, set={"l_1": "300 mm", "F_1": "80 N"}, scales={"mu_F": 2.0}, condition=True)

    assert solution["F_2"].value == pytest.approx(80.0 * 0.3 / 0.4, rel=1e-15)
    assert solution["l_AB"].value == pytest.approx(0.7, rel=1e-15)
    assert (solution["Q_O"].y, solution["Q_O"].mm) == pytest.approx((140.0, 70.0), rel=1e-14)
    assert solution.scales["mu_F"] == Scale("mu_F", 2.0, "N")
    assert solution.conditions["F_2"].value == pytest.approx(3.0, rel=1e-6)
    assert "Scheme of the seesaw" in solution.table("en")
    with pytest.raises(InputError, match="more than 100 times as long"):
        solve(seesaw, set={"l_2": "21 m"})


@pytest.mark.parametrize("language", LANGUAGES)
def test_sheet_note_and_handout_are_in_its_own_words(language: str, seesaw: str) -> None:
    drawn, told = sheet(seesaw, lang=language), note(seesaw, lang=language)
    begun = [handout(seesaw, lang=language, steps=steps).svg() for steps in (0, 1)]

    told.save("note.md")
    text = Path("note.md").read_text(encoding="utf-8")
    assert {view.name for view in drawn.views} == {"givens", "scheme", "balance"}
    for key in ("heading.seesaw_scheme", "seesaw.scheme.load"):
        assert packaged(toy.__name__, "texts", language)[key] in text
    assert begun[0].count('class="link"') < begun[1].count('class="link"') < drawn.svg().count('class="link"')


def test_form_is_filled_in_and_marked(seesaw: str) -> None:
    asked, solution = check(seesaw, "1", lang="en"), solve(seesaw)

    form = asked.write_form("form.csv").read_text(encoding="utf-8-sig")
    rows = [("name", "value", "unit"), *((q.name, q.value, q.unit) for q in map(solution.__getitem__, solution))]
    wrong = [(name, 2.0 * value if name == "F_2" else value, unit) for name, value, unit in rows[1:]]
    Path("right.csv").write_text(_csv_text(rows, "en"), encoding="utf-8")
    Path("wrong.csv").write_text(_csv_text([rows[0], *wrong], "en"), encoding="utf-8")

    assert all(f"{name}," in form for name in ("F_2", "Q_O", "l_AB", "mu_F"))
    marks = [asked.mark(asked.read(name)[0]).marked.mark for name in ("right.csv", "wrong.csv")]
    assert marks[0] == 100.0
    assert 0.0 < marks[1] < 100.0


def test_a_class_has_columns_of_its_givens_and_new_variants_its_ranges(seesaw: str) -> None:
    Path("class.csv").write_text("student,variant,F_1 [N],near\nA,1,120,\nB,1,,\n", encoding="utf-8")

    made = batch([seesaw], "class.csv", "out", kinds=("svg",), lang="en", jobs=1)
    new = all_variants(seesaw, make=3, ranges={"l_1": "0.2..0.4/0.05 m"}, lang="en")

    assert made.problems == []
    assert len({path.read_bytes() for path in Path("out").rglob("*.svg")}) == 2
    assert set(new.keys) == {"1", "2", "3"}
    for ask in (sweep, chart):
        with pytest.raises(InputError) as refused:
            ask(seesaw)
        assert refused.value.key == "kind-without"


def test_nobody_else_notices_it(seesaw: str) -> None:
    before = packaged("kulman.scales", "messages", "uk")
    add_texts(toy.__name__)  # twice is once

    assert packaged("kulman.scales", "messages", "uk") == before
    code = "import kulman; from kulman.scales import packaged as p; kulman.load_task('madi-gear'); print(p._ADDED)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
    assert replace(load_task("madi-gear"), file=None).kind == "gear"
