"""New variants, made within ranges or taken from tables of variants as departments keep them."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import openpyxl
import pytest

from kulman import all_variants, load_task, sheet, solve
from kulman.plans.boards.exact import SMALL
from kulman.plans.linkages.solved import SolvedLinkage
from kulman.scales.errors import InputError
from kulman.scales.units import format_unit
from kulman.tests.support.cases import solve_case, some
from kulman.tests.support.commands import Run
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.case import Request
from kulman.variants.kinds import KINDS, linkage
from kulman.variants.kinds.linkage import _short_vectors
from kulman.variants.making.new_variants import (
    _most_pages,
    _ranges_of,
    _read_variants,
    _table,
    _with_variants,
    import_variants,
)
from kulman.variants.making.starter import start
from kulman.variants.reader import read_text
from kulman.variants.sheets import draw_case
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.task import Task

TASK = "nau-slider-crank"
ROWS = """\
Варіант;phi [град];l_OA, мм;l_AB, мм;l_AS2, мм;n_1, об/хв;m_2, кг;m_3, кг;J_S2, кг·м²;F_3, кН
В1;30;25;125;42;2000;0,8;0,6;0,005;2
2;45;30;140;46;1800;1,8;1,5;0,01;3,5
long;60;80;70;20;1800;1;1;0,01;2
bad;60;20;abc;5;100;1;1;0,01;2
half;60;20;;5;100;1;1;0,01;2
2;50;30;140;46;1800;1,8;1,5;0,01;3,5
"""


@pytest.mark.parametrize(
    ("task", "count", "ranges"),
    some(
        [
            (TASK, 2, {"l_OA": "20..60/5 mm", "phi": "0..345/15"}),
            ("madi-four-bar", 1, {}),
            pytest.param("scheme-06-opposed-compressor", 1, {}, marks=pytest.mark.soak),
            pytest.param(TASK, 8, {"l_OA": "20..90/5 mm", "phi": "0..355/5"}, marks=pytest.mark.soak),
            pytest.param("madi-four-bar", 3, {"l_AB": "80..300/5 mm", "phi": "0..350/10"}, marks=pytest.mark.soak),
        ],
        0,
    ),
)
def test_made_variants_are_good_exercises(task: str, count: int, ranges: dict[str, str]) -> None:
    new = all_variants(task, make=count, ranges=ranges, seed=7).new

    assert new is not None
    own = len(sheet(task).pages)  # of most tasks one
    rows = [tuple(row.values.values()) for row in new.task.variants.values()]
    assert len(set(rows)) == count
    for variant in new.task.variants:
        solution = solve(new.task, variant)
        assert solution.status == "ok"
        assert solution.warnings == ()
        assert solution.solved.worst_sine()[1] >= SMALL
        drawn = sheet(new.task, variant)
        assert drawn.warnings == ()
        assert len(drawn.pages) <= own
        speeds = {name: item.value for name, item in solution.quantities.items() if re.match(r"V_\w+$", name)}
        assert min(speeds.values()) >= 0.01 * max(speeds.values())  # no plan is a line
        for step in range(0, 360, 20):  # the crank turns round
            assert solve(new.task, variant, set={"phi": step}, only="position").status != "no-assembly"


def test_new_variants_divide_links_by_their_centres_of_mass_as_the_others_do() -> None:
    own = load_task("scheme-03-crank-rocker")
    new = all_variants(own, make=6, ranges={"l_OA": "40..60/5 mm"}, seed=2).new

    assert new is not None
    for values in (row.values for row in new.task.variants.values()):
        for part, whole in (("l_AS2", "l_AB"), ("l_CS3", "l_CB")):
            assert float(values[part]) == pytest.approx(0.5 * float(values[whole]))
    free = all_variants(own, make=1, ranges={"l_AS2": "20..30/5 mm"}, seed=2).new  # whoever asks for a range has it
    assert free is not None
    assert 0.02 <= float(free.task.variant("1").values["l_AS2"]) <= 0.03


def test_a_centre_of_mass_stays_between_the_parts_of_its_link_that_variants_have(tmp_path: Path) -> None:
    text = bundled_text("scheme-03-crank-rocker").replace("l_AS2 = 150", "l_AS2 = 120")  # 0.4 of 300
    (file := tmp_path / "own.toml").write_text(text, encoding="utf-8")
    new = all_variants(file, make=4, seed=3).new

    assert new is not None
    parts = [float(row.values["l_AS2"]) / float(row.values["l_AB"]) for row in new.task.variants.values()]
    assert all(0.4 - 1e-9 <= part <= 0.5 + 1e-9 for part in parts)


@pytest.mark.parametrize("kind", KINDS)
def test_what_new_writes_is_drawn_without_warnings_and_makes_variants(kind: str, tmp_path: Path) -> None:
    task = load_task(start(tmp_path / "own.toml", "en", kind))
    stated = {frozenset(row.values) for row in task.variants.values()}

    for variant in task.variants:
        assert sheet(task, variant).warnings == ()
    new = all_variants(task, make=2, seed=1).new
    assert new is not None
    assert {frozenset(row.values) for row in new.task.variants.values()} <= stated
    for variant in new.task.variants:
        assert solve(new.task, variant).warnings == ()


@pytest.mark.parametrize(("phi", "quantity"), [("180°", "V_B"), ("90°", "V_BA")])
def test_a_plan_that_is_a_line_makes_a_poor_exercise(phi: str, quantity: str) -> None:
    case = solve_case(TASK, "3", {"phi": phi}, None, None)

    assert [error.data for error in case.kind.unfit(case) if error.key == "variant-short"] == [{"quantity": quantity}]


@pytest.mark.parametrize(
    ("task", "settings"),
    some([("madi-cam", {"h": "60 mm"}), ("madi-gear", {"m": "8 mm"}), ("madi-gear", {"z_1": "20"})], 1),
)
def test_what_would_be_drawn_smaller_is_refused_before_it_is(task: str, settings: dict[str, str]) -> None:
    asked = Request(load_task(task), None, settings)

    keys = {warning.key for warning in draw_case(asked.case()).warnings}
    assert keys & {"scales-changed", "scales-reduced", "scale-coarser"}
    with pytest.raises(InputError) as refused:
        draw_case(replace(asked, as_wanted=True).case())
    assert refused.value.key == "variant-room"
    own = Request(load_task(task), as_wanted=True).case()  # which is drawn as it is wanted
    assert len(draw_case(own).pages) == len(draw_case(replace(own, as_wanted=False)).pages)


def test_what_is_short_wherever_a_crank_stands_is_looked_for_in_no_more_places_than_needed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looked: list[float] = []

    def counted(solved: SolvedLinkage) -> set[str]:
        looked.append(round(math.degrees(solved.values["phi"])))
        return _short_vectors(solved)

    monkeypatch.setattr(linkage, "_short_vectors", counted)
    fit, poor = (solve_case(TASK, "3", {"phi": phi}, None, None) for phi in ("60°", "180°"))

    assert list(fit.kind.unfit(fit)) == []
    assert looked == [60]
    assert [error.key for error in poor.kind.unfit(poor)] == ["variant-short"]
    assert looked == [60, 180, 240]  # where it has none, none is short wherever the crank stands


def test_an_acceleration_that_cannot_be_seen_on_its_plan_makes_a_poor_exercise() -> None:
    values = {"phi": "105°", "l_OA": "55 mm", "l_AB": "190 mm", "l_AS2": "61 mm"}  # *a_B* is 0.5 m/s² beside 861
    fit, poor = (solve_case(TASK, "3", {**values, "phi": phi}, None, None) for phi in ("75°", "105°"))

    assert [[error.text("en") for error in case.kind.unfit(case)] for case in (fit, poor)] == [
        [],
        ["a_B is next to nothing: it cannot be seen on its plan"],
    ]


def test_variants_that_all_stand_in_dead_positions_make_others_that_do_not(tmp_path: Path) -> None:
    shared = {
        "l_AB": "180 mm",
        "l_AS2": "60 mm",
        "n_1": "1500 rpm",
        "m_2": "2 kg",
        "m_3": "2 kg",
        "J_S2": "0.01 kg*m^2",
    }
    two = {
        phi: {"phi": f"{phi} deg", "l_OA": l_OA, **shared, "F_3": "3 kN"}
        for phi, l_OA in (("0", "30 mm"), ("180", "45 mm"))
    }
    file = tmp_path / "two.toml"
    file.write_text(_with_variants(bundled_text(TASK), two.items()), encoding="utf-8")

    new = all_variants(file, make=8).new

    assert new is not None
    rows = [row.values for row in new.task.variants.values()]
    angles = [math.degrees(row["phi"]) for row in rows]
    assert len({round(angle) for angle in angles}) > 4
    assert all(0.0 < angle < 180.0 for angle in angles)
    assert {round(1e3 * row["l_OA"]) for row in rows} <= {*range(30, 46)}
    assert len({row["l_OA"] for row in rows}) > 4


@pytest.mark.parametrize(
    "text", ["25..60/5 mm", "2,5..6/0,5 см", "25мм..60мм/5мм", "25…60/5", "25–60 / 5 мм", "0.025 .. 0.06 / 0.005 m"]
)
def test_a_range_is_read_in_every_usual_form(text: str) -> None:
    found = _ranges_of(load_task(TASK), {"l_OA": text})["l_OA"]

    assert (found.low, found.high, found.step, found.unit) == (25, 60, 5, "mm")
    for bad in ("..", "5..", "..5", "5../2", "5..7/", "5", ""):
        with pytest.raises(InputError):
            _ranges_of(load_task(TASK), {"l_OA": bad})


@pytest.mark.parametrize(
    ("name", "text", "low", "high", "step"),
    [
        ("n_1", "700..760 об/мин", 700, 760, None),
        ("n_1", "700 об/хв..760 об/хв", 700, 760, None),
        ("n_1", "10..12/0,5 об/с", 600, 720, 30),
        ("omega", "60..80/5 рад/с", 60, 80, 5),
        ("omega", "60..80 1/с", 60, 80, None),
        ("J_S2", "100..200/50 kg*cm^2", "0.01", "0.02", "0.005"),
        ("J_S2", "1e-2..2e-2 кг·м²", "0.01", "0.02", None),
    ],
)
def test_the_unit_of_a_range_may_have_a_slash_a_figure_or_a_power(
    name: str, text: str, low: float, high: float, step: float | None
) -> None:
    found = _ranges_of(load_task("madi-cam" if name == "omega" else TASK), {name: text})[name]

    assert (found.low, found.high) == (Decimal(low), Decimal(high))
    assert step is None or found.step == Decimal(step)


def test_ranges_about_the_only_variant_of_a_task_have_round_steps_some_twenty_of_them() -> None:
    ranges = _ranges_of(load_task("bertyaev-six-bar"), {})

    assert ranges
    for name, usual in ranges.items():
        assert usual.low < usual.high, name
        assert usual.step.normalize().as_tuple().digits in ((1,), (2,), (5,)), name
        assert 8 <= (usual.high - usual.low) / usual.step <= 21, name


def test_what_is_counted_is_whole_in_new_variants() -> None:
    spans = _ranges_of(load_task("madi-gear"), {"z_2": "12..40"})

    for name in ("z_1", "z_2"):
        assert spans[name].low % 1 == spans[name].step % 1 == 0, name
        assert spans[name].high > spans[name].low


def test_made_variants_keep_to_ranges_and_steps() -> None:
    new = all_variants(TASK, make=2, ranges={"l_OA": "20..40/5 мм", "n_1": "600..1400/100"}, set={"m_3": "1 kg"}).new

    assert new is not None
    for row in re.findall(r"\[\[variant\]\]\n((?:.+\n)+)", new.text):
        said = dict(re.findall(r'(\w+) = "(\S+)[^"]*"', row))
        assert Decimal(said["l_OA"]) in range(20, 41, 5)
        assert Decimal(said["n_1"]) in range(600, 1401, 100)
        assert said["m_3"] == "1"
    assert new.text.count("reconstruction") == 1  # the comment at its head stays
    assert "reconstructed" not in new.text  # what the old variants said of theirs does not


def test_a_seed_tells_the_variants() -> None:
    made = [all_variants(TASK, make=1, seed=seed).new for seed in (3, 3, 4)]

    first, again, other = (new.text for new in made if new is not None)
    assert first == again != other


@pytest.mark.parametrize("name", bundled())
def test_other_variants_leave_everything_else_as_it_is(name: str) -> None:
    task = load_task(name)
    first, *_ = task.variants.values()
    row = {
        given: value if isinstance(value, str) else f"{unit.from_si(value):.12g} {unit.name}".removesuffix(" 1")
        for given, value in first.values.items()
        if (unit := task.givens[given].unit) is not None or isinstance(value, str)
    }

    found, faults = read_text(_with_variants(task.text, [("one", row), ("two", row)]), "new.toml")

    assert faults == ()
    assert found is not None
    assert list(found.variants) == ["one", "two"]
    assert found.resolve("two") == pytest.approx(task.resolve(first.id))
    assert (found.givens, found.subject, found.scales) == (task.givens, task.subject, task.scales)


@pytest.mark.parametrize("turned", some([False, True], 1))
def test_a_spreadsheet_becomes_variants(turned: bool, tmp_path: Path, run: Run) -> None:
    file, out = tmp_path / "variants.csv", tmp_path / "class.toml"
    cells = [line.split(";") for line in ROWS.splitlines()]
    rows = [";".join(row) for row in (zip(*cells, strict=True) if turned else cells)]
    file.write_text("\n".join(("Курсова робота", "", *rows)) + "\n", encoding="utf-8-sig")

    status, _, err = run("variants", TASK, "--from", str(file), "-o", str(out))

    assert status == 2
    told = [line.removeprefix(f"{file}: ") for line in err.splitlines()]
    assert [re.split(r"[:,] ", line)[1] for line in told[:4]] == ["long", "l_AB", "half", "2"]
    task = load_task(out)
    assert list(task.variants) == ["В1", "2"]
    assert task.resolve("2")["l_AB"] == pytest.approx(0.14)
    assert task.resolve("В1")["F_3"] == pytest.approx(2000.0)
    assert solve(task, "2")["V_B"].value == pytest.approx(solve(TASK, "1")["V_B"].value)


PRINTED = "Величина;Вар. 1;Вар. 2;Вар. 3\nКривошип l_OA, мм;40;45;50\nШатун lAB, мм;190;200;30\nφ, град;30;60;120\n"


def test_what_a_printed_table_has_not_may_be_set_for_all(tmp_path: Path, run: Run) -> None:
    (file := tmp_path / "tab.csv").write_text(f"{PRINTED}n1;1400;1000;900\nFпс, Н;4000;5000;6000\n", encoding="utf-8")
    own = [f"--set={said}" for said in ("l_AS2=65", "m_2=2", "m_3=1", "J_S2=0,01", "F_3=4 kN", "n_1=900")]
    out = tmp_path / "tab.toml"

    _, _, err = run("variants", TASK, "--from", str(file), *own[:3], "--lang", "en")
    missing = re.findall(r"([BCD]\d, \d): no value is given of: ([^;]+);", err)
    _, _, told = run("variants", TASK, "--from", str(file), *own, "-o", str(out), "--lang", "en")

    assert missing == [(f"{'BCD'[n]}1, {n + 1}", "J_S2, F_3") for n in range(3)]
    assert "tab.csv: what names no given is not read: Fпс, Н" in err
    assert "tab.csv: what names no given is not read: Fпс, Н" in told
    task = load_task(out)
    assert list(task.variants) == ["1", "2"]  # the third cannot be assembled
    assert [(row["l_AS2"], row["F_3"], row["n_1"]) for row in map(task.resolve, task.variants)] == [
        pytest.approx((0.065, 4000.0, 30.0 * math.pi))
    ] * 2
    assert task.source["en"] == "data of my own"


def test_what_a_table_has_in_another_unit_without_saying_so_is_told_with_its_place(tmp_path: Path, run: Run) -> None:
    """A centre of mass 0.06 mm from the crank pin, of a table in metres, was taken without a word."""
    head, values = (row.split(";") for row in ROWS.splitlines()[:2])
    head[4], values[4] = "l_AS2", "0,06"
    (file := tmp_path / "tab.csv").write_text("\n".join(map(";".join, (head, values))) + "\n", encoding="utf-8")

    status, _, err = run("variants", TASK, "--from", str(file), "-o", str(tmp_path / "tab.toml"), "--lang", "en")

    assert status == 0
    assert re.search(r"tab\.csv: .*l_AS2: 0\.06 mm is far from what the variants of the task have", err)


def test_a_file_of_new_variants_is_called_by_its_own_name(folder: Path, run: Run) -> None:
    run("variants", TASK, "--make", "1", "-o", "АТ-301 осінь.toml", "--lang", "en")

    status, _, err = run("check", "АТ-301 осінь.toml", "-v", "9", "answers.csv", "--lang", "en")

    assert load_task("АТ-301 осінь.toml").id == "АТ-301-осінь"
    assert (status, err) == (2, "АТ-301-осінь has no variant '9'; it has: 1\n")
    assert run("check", "АТ-301 осінь.toml", "printed")[0] == 2  # another task's answers


@pytest.mark.parametrize(("lang", "said"), [("uk", "не змінено"), ("ru", "не изменён"), ("en", "left as it is")])
def test_a_file_of_new_variants_that_has_been_edited_stays(lang: str, said: str, folder: Path, run: Run) -> None:
    asked = ("variants", TASK, "--make", "1", "-o", "class.toml", "-o", "key.csv", "--lang", lang)
    assert [run(*asked)[0] for _ in range(2)] == [0, 0]  # the same again is no other file
    edited, key = (file := Path("class.toml")).read_text("utf-8") + "# ours\n", Path("key.csv").read_bytes()
    file.write_text(edited, encoding="utf-8")

    status, _, err = run(*asked, "--seed", "2")

    assert (status, err.startswith("class.toml: "), said in err) == (4, True, True)
    assert (file.read_text("utf-8"), Path("key.csv").read_bytes()) == (edited, key)


@pytest.mark.parametrize("x_1", [pytest.param("0.2", id="drawn"), pytest.param("-3", id="refused")])
def test_pages_are_counted_though_the_first_variant_of_a_task_is_refused(x_1: str) -> None:
    task = task_of(with_changes(load_task("madi-gear").text, ("x_1 = 0.2", f"x_1 = {x_1}")))

    assert _most_pages(task)() == 2


# Tables of variants as departments keep them: whatever symbols, units, merged cells and empty rows they have.
GUIDE = """\
Параметр;Позначення;Одиниці;Номер варіанта;;
;;;0;1;2
Положення механізму;φ;град;30;45;60
Розмір ланок;;;;;
;l_{OA};мм;25;30;35

;l_{AB};мм;125;140;170
;l_{AS_2};мм;42;46;55
Частота обертання ланки 1;n₁;об/хв;2 000;1800;1600
Маса ланок;;;;;
;m2;кг;0,8;1,8;2,5
;m3;кг;0,6;1,5;2,0
Момент інерції;JS2;кг·м²;0,005;0,01;0,015
Сила;F_3;Н;2000;3500;4000
"""


def table(folder: Path, text: str) -> str:
    file = folder / "table.csv"
    file.write_text(text, encoding="utf-8-sig")
    return str(file)


def values(task: Task, file: str) -> dict[str, dict[str, float | str]]:
    read = _read_variants(_table(file, task), task, {})
    assert [str(problem) for one in read for problem in one.problems] == []
    return {one.id: {name: task.givens[name].read(text) for name, text in one.row.items()} for one in read}


def latex(name: str) -> str:
    head, _, rest = name.partition("_")
    return f"{head}_{{{rest}}}" if rest else head


def told(name: str) -> str:
    return f"Величина {name}" if len(name) > 1 else name


@pytest.mark.parametrize("form", [str, latex, lambda name: name.replace("_", ""), told])
@pytest.mark.parametrize("name", some(bundled(), *range(0, 99, 3)))
def test_symbols_and_units_are_read_in_every_usual_form(name: str, form: Callable[[str], str], tmp_path: Path) -> None:
    task = load_task(name)
    rows_of = {variant: row.values for variant, row in task.variants.items()}
    variants = {variant: row for variant, row in rows_of.items() if variant.isdigit()} or rows_of
    givens = [given for given in task.givens if all(isinstance(row.get(given), float) for row in variants.values())]
    units = [task.givens[given].unit for given in givens]
    shown = ["" if unit is None or unit.name == "1" else format_unit(unit, "uk") for unit in units]
    head = ["", *(f"{form(given)}, {unit}" if unit else form(given) for given, unit in zip(givens, shown, strict=True))]
    asked = [(given, unit) for given, unit in zip(givens, units, strict=True) if unit]
    rows = [
        [variant, *(f"{unit.from_si(row[given]):.12g}".replace(".", ",") for given, unit in asked)]
        for variant, row in variants.items()
    ]
    for way, cells in (("rows", [head, *rows]), ("columns", [*zip(head, *rows, strict=True)])):
        file = tmp_path / f"{way}.csv"
        with file.open("w", encoding="utf-8-sig", newline="") as stream:
            csv.writer(stream, delimiter=";").writerows(cells)

        found = values(task, str(file))

        assert list(found) == list(variants)
        for variant, row in variants.items():
            assert found[variant] == pytest.approx({given: row[given] for given in givens}, rel=1e-9)


def test_the_table_of_a_printed_guide_is_read_as_it_stands(tmp_path: Path) -> None:
    task = load_task(TASK)

    found = values(task, table(tmp_path, GUIDE))

    for variant in "012":
        stated = task.variants[variant].values
        assert found[variant] == pytest.approx({name: stated[name] for name in found[variant]})
        assert len(found[variant]) == 9


def test_merged_cells_say_the_same_of_all(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    rows: list[list[object]] = [["Курсова робота"], [], ["Параметр", "Одиниці", "Варіант"], [None, None, 3, 4, 5]]
    rows += [[name, unit, *cells] for name, unit, *cells in (
        ("phi", "град", 30, 45, 60), ("l_OA", "мм", 25), ("l_AB", "мм", 125, 140, 170), ("m_2", None, 0.8, 1.8, 2.5),
    )]  # fmt: skip
    for row in rows:
        sheet.append(row)
    for cells in ("A1:E1", "A3:A4", "C3:E3", "C6:E6", "Z1:Z300"):
        sheet.merge_cells(cells)
    book.save(tmp_path / "table.xlsx")

    found = values(load_task(TASK), str(tmp_path / "table.xlsx"))

    assert list(found) == ["3", "4", "5"]
    assert [row["l_OA"] for row in found.values()] == [pytest.approx(0.025)] * 3
    assert [row["m_2"] for row in found.values()] == [0.8, 1.8, 2.5]


@pytest.mark.parametrize(
    ("header", "given", "said"),
    [
        ("l_OA [см]", "l_OA", "0.025"),
        ("F_3, кгс", "F_3", "кгс"),
        ("Сила F_3 (кгс)", "F_3", "кгс"),
        ("Сила корисного опору, Н: F_3", "F_3", "2.5"),
        ("m_2 (маса шатуна), кг", "m_2", "2.5"),
    ],
)
def test_a_unit_of_a_header_is_never_passed_over(header: str, given: str, said: str, tmp_path: Path) -> None:
    task = load_task(TASK)
    file = table(tmp_path, f'Варіант;phi, град;"{header}"\n1;30;2,5\n')

    [read] = _read_variants(_table(file, task), task, {})

    if read.problems:
        assert re.search(rf"C2, {given}: .*{said}", str(read.problems[0]))
    else:
        assert task.givens[given].read(read.row[given]) == pytest.approx(float(said))
    assert bool(read.problems) == (said == "кгс")


def test_numbers_without_ids_are_counted_and_data_that_are_missing_named(tmp_path: Path) -> None:
    assert list(values(load_task(TASK), table(tmp_path, "phi;l_OA\n\n30;25\n45;30\n\n\n"))) == ["1", "2"]
    lacking = "no value is given of: l_OA, l_AS2, n_1, m_2, m_3, J_S2, F_3"
    missing = rf"A2, 1: {lacking}; .*A3, 2: {lacking}$"
    with pytest.raises(InputError, match=missing):
        import_variants(TASK, table(tmp_path, "Варіант;phi;l_AB\n1;30;125\n2;30;125\n"))
    with pytest.raises(InputError, match=r"B2, phi: 'abc' .*; .*C2, l_AB: 'def' "):
        import_variants(TASK, table(tmp_path, "Варіант;phi;l_AB\n1;abc;def\n"))


def test_two_symbols_of_one_name_are_not_taken_for_a_given(tmp_path: Path) -> None:
    task = load_task(TASK)
    file = table(tmp_path, "Варіант;phi;Відношення l_OA до l_AB\n1;30;0,2\n")

    [read] = _read_variants(_table(file, task), task, {})

    assert set(read.row) == {"phi"}
