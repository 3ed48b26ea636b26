"""Task files: where keys stand, what a good file gives; new files; the twenty schemes against their machines."""

from __future__ import annotations

import io
import math
import re
import string
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kulman.plans.boards import exact
from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens, solve_linkage
from kulman.plans.linkages.structure import Group, analyse
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.commands import Run
from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.sheet_cases import ROWS, Case
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.checks.basics import Places
from kulman.variants.kinds import KINDS, MODULES
from kulman.variants.making.starter import _template, start
from kulman.variants.reader import load_task, read_text
from kulman.variants.shelf import bundled, bundled_text, summary
from kulman.variants.solution import solve

PLACED = '''\
# a comment [not a table]
title = "x # y"
[givens]   # more
phi = { unit = "deg", "a b" = [1, { c = 2 }] }
a.b . "c d" = 1
text = """
[fake]
key = "no" \\""" ""
"""  # end
raw = \'\'\'
[[fake]]\'\'\'
list = [
  "one", # first
  [ 2, 3 ],
]
[[variant]]
id = "0"
[variant.more]
deep = 1979-05-27 07:32:00
[[variant]]
id = "1"
[[variant.row]]
x = 1
[[variant.row]]
x = 2
'''


PLACES: dict[tuple[str | int, ...], tuple[int, int]] = {
    ("title",): (2, 1), ("givens",): (3, 1), ("givens", "phi"): (4, 1), ("givens", "phi", "unit"): (4, 9),
    ("givens", "phi", "a b", 0): (4, 32), ("givens", "phi", "a b", 1, "c"): (4, 37),
    ("givens", "a", "b", "c d"): (5, 7), ("givens", "raw"): (10, 1), ("givens", "list"): (12, 1),
    ("givens", "list", 1): (14, 3), ("givens", "list", 1, 1): (14, 8), ("variant", 0): (16, 1),
    ("variant", 0, "id"): (17, 1), ("variant", 0, "more", "deep"): (19, 1), ("variant", 1, "id"): (21, 1),
    ("variant", 1, "row", 0, "x"): (23, 1), ("variant", 1, "row", 1, "x"): (25, 1),
    ("variant", 1, "missing"): (20, 1), ("missing",): (1, 1),
}  # fmt: skip


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_every_key_has_its_place(end: str) -> None:
    tomllib.loads(PLACED)
    places = Places(PLACED.replace("\n", end))

    assert {path: places[path] for path in PLACES} == PLACES


KEYS = st.text(string.ascii_letters + string.digits + "_-", min_size=1, max_size=6)
VALUES = st.recursive(
    st.integers(-99, 99).map(str) | st.text("ab[]{}#=,.'", max_size=6).map(lambda s: f'"{s}"') | st.just("'''\n]'''"),
    lambda inner: (
        st.lists(inner, max_size=3).map(lambda items: "[" + ", ".join(items) + "]")
        | st.dictionaries(KEYS, inner, max_size=3).map(
            lambda d: "{" + ", ".join(f"{k} = {v}" for k, v in d.items()) + "}"
        )
    ),
    max_leaves=6,
)


@settings(suppress_health_check=[HealthCheck.too_slow], max_examples=50)
@given(st.dictionaries(KEYS, st.dictionaries(KEYS, VALUES, max_size=4), max_size=4))
def test_places_point_at_the_keys_of_any_file(tables: dict[str, dict[str, str]]) -> None:
    text = "".join(f"[{table}]\n" + "".join(f"{k} = {v}\n" for k, v in rows.items()) for table, rows in tables.items())
    lines = text.split("\n")
    tomllib.loads(text)

    places = Places(text)

    for table, rows in tables.items():
        line, column = places[(table,)]
        assert lines[line - 1].startswith(f"[{table}]", column - 1)
        for key in rows:
            line, column = places[(table, key)]
            assert lines[line - 1].startswith(f"{key} = ", column - 1)


@pytest.mark.parametrize("task", bundled())
def test_every_bundled_task_is_without_fault(task: str) -> None:
    found, faults = read_text(bundled_text(task), task)

    assert faults == ()
    assert found is not None
    assert found.id == task
    assert set(found.title) == {"uk", "ru", "en"}
    for variant in found.variants:
        assert all(math.isfinite(value) for value in found.values(variant).values())
    assert summary(task)["variants"] == list(found.variants)


def test_a_title_and_a_source_in_one_language_do_for_all(tmp_path: Path) -> None:
    own, text = tmp_path / "own.toml", load_task("nau-slider-crank").text
    text = re.sub(r"(?m)^source = .*$", 'source = "свої дані"', text)
    own.write_text(re.sub(r'(?m)^(ru|en) = "[^"]*"\n', "", text, count=2), encoding="utf-8")

    task = load_task(own)

    assert {task.title[language] for language in ("uk", "ru", "en")} == {load_task("nau-slider-crank").title["uk"]}
    assert {*task.source.values()} == {"свої дані"}
    own.write_text(re.sub(r"(?ms)^\[title\]\n.*?\n\n", 'title = "Shaper"\n\n', text), encoding="utf-8")
    assert {*load_task(own).title.values()} == {"Shaper"}
    assert len({*load_task("nau-slider-crank").source.values()}) == 3


def test_the_slider_crank_has_the_numbers_of_its_table() -> None:
    task = load_task("nau-slider-crank")

    assert list(task.variants) == list(NAU_VARIANTS) == [*"0123456789", "example"]
    for variant in task.variants:
        values = task.values(variant)
        assert {name: values[name] for name in ROWS} == pytest.approx({n: Case(variant).given(n) for n in ROWS}, 1e-15)
        assert task.variants[variant].reconstructed == (() if variant == "example" else ("J_S2",))


def test_settings_take_any_unit_of_the_kind_and_the_tasks_own_without_one() -> None:
    task = load_task("nau-slider-crank")
    asked = {"l_OA": "5,5 см", "l_AB": "140", "n_1": "80 рад/с", "F_3": 2, "phi": 90.0, "rotation": "ccw"}
    wanted = {"l_OA": 0.055, "l_AB": 0.14, "n_1": 80.0, "F_3": 2000.0, "phi": math.pi / 2, "sense_1": 1.0}

    values = task.values(None, asked)

    assert {name: values[name] for name in wanted} == wanted
    assert task.resolve(None, asked)["rotation"] == "ccw"
    assert values["m_2"] == 0.8  # the first variant


def test_a_file_of_ones_own_is_read_like_a_bundled_task(tmp_path: Path) -> None:
    file = tmp_path / "мій механізм.toml"
    file.write_bytes(b"\xef\xbb\xbf" + bundled_text("nau-slider-crank").replace("\n", "\r\n").encode())

    own = load_task(file)

    assert own.file == str(file)
    assert own.mechanism == load_task("nau-slider-crank").mechanism
    assert own.values("7") == load_task(str(file)).values("7") == load_task("nau-slider-crank").values("7")


def test_literals_of_the_mechanism_become_constants() -> None:
    changes = ('offset = "0 mm"', 'offset = "5 mm"'), ('direction = "0 deg"', 'direction = "90 deg"')

    task = task_of(with_changes(bundled_text("nau-slider-crank"), *changes))

    guide = task.mechanism.pairs[3]
    assert isinstance(guide, Prismatic)
    values = task.values("0")
    assert guide.through == (ZERO, ZERO)
    assert (values[guide.offset], values[guide.direction], values[ZERO]) == (0.005, math.pi / 2, 0.0)


def test_a_length_that_is_no_distance_may_be_negative_or_zero() -> None:
    changes = ('offset = "0 mm"', 'offset = "e"'), ("[givens]\n", '[givens]\ne = { unit = "mm", default = 0 }\n')

    task = task_of(with_changes(bundled_text("nau-slider-crank"), *changes))

    assert task.values("0")["e"] == 0.0
    assert task.values("0", {"e": -12})["e"] == -0.012


def test_all_faults_are_found_at_once_in_the_order_of_their_lines(folder: Path) -> None:
    text = with_changes(
        bundled_text("nau-slider-crank"),
        ('unit = "kg*m^2"', 'unit = "kg*mm^2x"'),
        ('centre = "S2"', 'centre = "S3"'),
        ('speed = "n_1"', 'speed = "n1"'),
        ('phi = "30 deg"', 'phi = "30 mm"'),
        ('l_OA = "28 mm"', 'l_OA = "-28 mm"'),
    )
    Path("t.toml").write_text(text, encoding="utf-8")

    _, faults = read_text(text, "t.toml")

    lines = [int(str(fault).split(":")[1]) for fault in faults]
    assert len(faults) >= 5
    assert lines == sorted(lines)
    with pytest.raises(InputError) as caught:
        load_task("t.toml")
    assert str(caught.value) == f"{faults[0]} (and {len(faults) - 1} more: kulman list --check t.toml)"


# `kulman new`: a file with comments in each language, never in place of another file.
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_new_file_is_valid_at_once_in_every_language(language: str, kind: str, folder: Path) -> None:
    path = start("own-task.toml", language, kind)

    task = load_task(path)

    assert (task.id, MODULES[task.kind]) == ("own-task", kind)
    assert "own-task.toml" in path.read_text(encoding="utf-8")
    assert not re.search("my-(mechanism|cam|gear|hoist)", path.read_text(encoding="utf-8"))
    for variant in task.variants:
        solution = solve(path, variant)
        assert (solution.status, solution.warnings) == ("ok", ())
        assert all(check["ok"] for check in solution.checks.values())


@pytest.mark.parametrize("kind", KINDS)
def test_templates_differ_in_words_alone(kind: str) -> None:
    def plain(language: str) -> str:
        lines = (line.partition("#")[0].rstrip() for line in _template(language, kind).splitlines())
        return re.sub('source = ".*"', "", "\n".join(line for line in lines if line))

    assert plain("uk") == plain("ru") == plain("en")
    assert all(len(line) <= 120 for language in LANGUAGES for line in _template(language, kind).splitlines())


def test_new_file_is_easy_to_change() -> None:
    changes = ("l_OA = 100", "l_OA = 95"), ('at = ["280 mm"', 'at = ["300 mm"'), ("sense = 1\n", "sense = -1\n")

    assert task_of(with_changes(_template("en"), *changes)).values()["l_OA"] == 0.095


def test_command_writes_the_file_in_the_language_asked_for_and_shows_its_name(folder: Path, run: Run) -> None:
    for arguments, words in ((["new", "a.toml"], "The links."), (["new", "b.toml", "--lang", "uk"], "Ланки.")):
        assert run(*arguments) == (0, f"{arguments[1]}\n", "")
        assert words in Path(arguments[1]).read_text(encoding="utf-8")


def test_name_without_a_suffix_gets_one_and_any_name_makes_an_id(folder: Path) -> None:
    assert start("press", "en") == Path("press.toml")
    assert load_task(start("мій механізм (2).toml", "uk")).id == "мій-механізм-2"
    assert 'kulman sheet "мій механізм (2).toml"' in Path("мій механізм (2).toml").read_text(encoding="utf-8")
    assert load_task(start("---.toml", "en")).id == "my-mechanism"


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("there.toml", "output-exists"),
        ("x.svg", "output-suffix"),
        ("none/x.toml", "output-folder-missing"),
        ("folder.toml", "output-exists"),
        ("a\0.toml", "output-name"),
        ("", "output-name"),
    ],
)
def test_place_where_no_file_can_be_written_is_refused(name: str, key: str, folder: Path) -> None:
    Path("there.toml").write_text("mine", encoding="utf-8")
    Path("folder.toml").mkdir()

    with pytest.raises(InputError) as refused:
        start(name, "en")

    assert refused.value.key == key
    assert Path("there.toml").read_text(encoding="utf-8") == "mine"
    assert sorted(path.name for path in Path().iterdir()) == ["folder.toml", "there.toml"]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_task_may_come_from_standard_input(
    encoding: str, folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def piped(data: bytes) -> None:
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(data), encoding="utf-8"))

    start("own.toml", "uk")
    data = Path("own.toml").read_text(encoding="utf-8").encode(encoding)
    by_name = run("solve", "own.toml", "--json")[1]
    for command in (["solve", "-", "--json"], ["batch", "-", "--form", "class.csv"], ["check", "-", "--form", "f.csv"]):
        piped(data)
        status, out, err = run(*command)
        assert (status, err) == (0, "")
        assert command[0] != "solve" or out == by_name

    for bad, message in ((b" \n", "-: "), (b"id = 3", "-:1"), (b"x" * 1_000_001, "1 MB")):
        piped(bad)
        status, out, err = run("solve", "-", "--lang", "en")
        assert (status, out, message in err) == (2, "", True), err


# The customary schemes of course projects: I is the driver, then the groups by class and kind (class III by order) with
# their links; -> on links of a group before, || on the driver alone.
FORMULAS = {
    "scheme-01-compressor": "I -> II2(2,3)", "scheme-02-forging-press": "I -> II2(2,3)",
    "scheme-03-crank-rocker": "I -> II1(2,3)", "scheme-04-v-engine": "I -> II2(2,3) || II2(4,5)",
    "scheme-05-articulated-rod": "I -> II2(2,3) -> II2(4,5)",
    "scheme-06-opposed-compressor": "I -> II2(2,3) || II2(4,5)",
    "scheme-07-two-stage-compressor": "I -> II2(2,3) -> II2(4,5)", "scheme-08-planer": "I -> II1(2,3) -> II2(4,5)",
    "scheme-09-shaper": "I -> II3(2,3) -> II2(4,5)", "scheme-10-shaper-two-blocks": "I -> II3(2,3) -> II4(4,5)",
    "scheme-11-slotter": "I -> II3(2,3) -> II2(4,5)", "scheme-12-shaking-conveyor": "I -> II1(2,3) -> II2(4,5)",
    "scheme-13-toggle-press": "I -> II1(2,3) -> II2(4,5)", "scheme-14-jaw-crusher": "I -> II1(2,3) -> II1(4,5)",
    "scheme-15-lever-shears": "I -> II1(2,3) -> II1(4,5)", "scheme-16-hay-baler": "I -> II1(2,3) -> II2(4,5)",
    "scheme-17-sewing-machine": "I -> II2(2,3) || II1(4,5)", "scheme-18-hydraulic-drive": "I -> II1(2,3)",
    "scheme-19-scotch-yoke": "I -> II5(2,3)", "scheme-20-press-automaton": "I -> III3(2,3,4,5)",
}  # fmt: skip
VARIANTS = [  # one of ten by default, others with each scheme
    pytest.param(scheme, str(variant), marks=[] if (number + variant) % 10 == 0 else pytest.mark.soak)
    for number, scheme in enumerate(FORMULAS)
    for variant in range(10)
]
POSITIONS = 360
TRAVEL = 0.15  # m, of the hydraulic cylinder
LEAST, FLAT = math.sin(math.radians(20.0)), math.sin(math.radians(15.0))


def formula(groups: tuple[Group, ...]) -> str:
    """Write the structure formula with ASCII letters."""
    text, before = "I", {FRAME}
    for group in groups:
        parallel = bool(before - {FRAME}) and before.isdisjoint({*group.before} - {FRAME})
        kind = f"II{group.view}" if group.group_class == 2 else f"III{group.order}"
        text += f" {'||' if parallel else '->'} {kind}({','.join(map(str, sorted(group.links)))})"
        before |= {*group.links}
    return text


@pytest.mark.parametrize("task", bundled())
def test_what_list_shows_is_what_the_file_holds(task: str) -> None:
    raw = tomllib.loads(bundled_text(task))

    shown = summary(task)

    heads = ("id", "title", "source", "note", "plans")
    assert {name: shown.get(name) for name in heads} == {name: raw.get(name) for name in heads}
    assert shown["variants"] == [row["id"] for row in raw["variant"]]
    assert shown["givens"] == {name: given.get("unit") or given["choices"] for name, given in raw["givens"].items()}
    assert {*raw["title"]} == {*raw.get("note", raw["title"])} == {*LANGUAGES}


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_said_in_one_language_stands_for_the_others(language: str) -> None:
    said = f'[title]\n{language} = "Title"\n\n[note]\n{language} = "Note"\n'
    text = re.sub(r"\[title\]\n(?:.+\n)+", said, _template("en"))

    task, faults = read_text(text, "t.toml")

    assert task is not None, faults
    assert task.title == dict.fromkeys(LANGUAGES, "Title")
    assert task.note == dict.fromkeys(LANGUAGES, "Note")


@pytest.mark.parametrize("scheme", FORMULAS)
def test_scheme_has_the_structure_of_its_machine(scheme: str) -> None:
    assert formula(analyse(load_task(scheme).mechanism).groups) == FORMULAS[scheme]


def test_schemes_have_all_dyads_bent_links_forked_joints_and_shafts_with_two_cranks() -> None:
    mechanisms = {scheme: load_task(scheme).mechanism for scheme in FORMULAS}
    kinds = {group.kind for mechanism in mechanisms.values() for group in analyse(mechanism).groups}

    assert kinds >= {"RRR", "RRP", "RPR", "PRP", "RPP"}
    for scheme in ("scheme-04-v-engine", "scheme-07-two-stage-compressor", "scheme-13-toggle-press"):
        joints = [pair.point for pair in mechanisms[scheme].pairs if isinstance(pair, Revolute)]
        assert len(joints) > len(set(joints)), scheme
    for scheme, link in (("scheme-05-articulated-rod", 2), ("scheme-08-planer", 3), ("scheme-16-hay-baler", 2)):
        assert len(mechanisms[scheme].link(link).points) >= 4
    assert {"O", "A", "C"} == set(mechanisms["scheme-06-opposed-compressor"].link(1).points)


@pytest.mark.parametrize(("scheme", "variant"), VARIANTS)
def test_variant_has_good_plans_in_every_position_of_the_driver(scheme: str, variant: str) -> None:
    task = load_task(scheme)
    driver = task.mechanism.driver
    places = np.arange(POSITIONS) * ((2.0 * math.pi if isinstance(driver, Driver) else TRAVEL) / POSITIONS)
    _, program = construct(task.mechanism, ["velocity"])
    wanted = [name for name in program.names if not name.startswith("_")]

    def givens(at: object) -> dict[str, Any]:
        values: dict[str, Any] = {**task.values(variant), driver.coordinate: at}
        return dict(board_givens(task.mechanism, values, program))

    solved = solve_linkage(task.mechanism, task.values(variant))
    _, codes = batch(program, givens(places), wanted)
    flattest = min(min(exact.run(program, givens(float(at))).sines.values()) for at in places[:: POSITIONS // 18])

    mark, sine = solved.worst_sine()
    assert solved.status == "ok"
    assert sine > LEAST, mark
    assert {exact.STATUSES[code] for code in codes} == {"ok"}
    assert flattest > FLAT


@pytest.mark.soak
@pytest.mark.parametrize("scheme", FORMULAS)
def test_most_variants_are_drawn_while_the_load_acts(scheme: str) -> None:
    task = load_task(scheme)
    names = [load.name for load in (*task.mechanism.loads, *task.mechanism.couples)]

    acting = [
        all(abs(solve_linkage(task.mechanism, task.values(variant), ["forces"]).values[name]) > 0.0 for name in names)
        for variant in task.variants
    ]

    assert sum(acting) >= 8


@pytest.mark.parametrize(
    ("scheme", "out"),
    [
        ("scheme-08-planer", -1.0),
        ("scheme-09-shaper", -1.0),
        ("scheme-10-shaper-two-blocks", -1.0),
        ("scheme-11-slotter", -1j),
    ],
)
def test_machine_tools_cut_slowly_and_return_fast(scheme: str, out: complex) -> None:
    task = load_task(scheme)
    assert isinstance(task.mechanism.driver, Driver)
    _, program = construct(task.mechanism, ["position"])
    (tool,) = (pair.point for pair in task.mechanism.pairs if isinstance(pair, Prismatic) and FRAME in pair.links)
    phi = np.arange(POSITIONS) * (2.0 * math.pi / POSITIONS)

    for variant in task.variants:
        values = task.values(variant)
        turned = phi * values[task.mechanism.driver.sense]
        places, _ = batch(program, board_givens(task.mechanism, {**values, "phi": turned}), [tool])
        way = np.diff((places[tool] * np.conj(out)).real, append=(places[tool][0] * np.conj(out)).real)
        assert np.count_nonzero(way > 0.0) >= POSITIONS / 2


def test_a_bare_word_in_a_row_is_told_how_to_be_written(tmp_path: Path) -> None:
    file = tmp_path / "t.toml"
    file.write_text('variant = [\n  { id = "1", phi = sixty, l_OA = 30 },\n]\n', encoding="utf-8")

    with pytest.raises(InputError, match=r't.toml:2:21: .* stands in straight quotes: "sixty"'):
        load_task(file)
