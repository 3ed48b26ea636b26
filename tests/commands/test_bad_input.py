"""Bad input: one line that names the place and what was expected, status 2, nothing written."""

import ast
import csv
import io
import os
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kulman import sheet, solve, solve_many
from kulman.scales.errors import LANGUAGES, InputError, KulmanError, messages
from kulman.tests.support import broken_files as brokens
from kulman.tests.support.broken_files import BROKEN, LOADED, broken
from kulman.tests.support.commands import Run
from kulman.tests.support.sources import trees
from kulman.tests.support.task_files import with_changes
from kulman.variants.reader import LARGEST_FILE, load_task, read_text
from kulman.variants.shelf import bundled_text
from kulman.variants.tables import table_bytes

TASK = "nau-slider-crank"
GOOD = bundled_text(TASK)

# What is replaced in a good file, by what, and the key of the first fault, which is on the line of the replacement.
FILES = {
    "no id": ('id = "nau-slider-crank"\n', "", "key-missing"),
    "id with a space": ('id = "nau-slider-crank"', 'id = "my task"', "type-id"),
    "no source": ("source = ", "sorce = ", "key-unknown-like"),
    "empty source": ("source = {", 'source = ""\n# {', "type-text"),
    "unknown plan": ('"structure", "position"', '"structure", "posision"', "plan-unknown-like"),
    "plans not an array": ("plans = [", "plans = 1 # [", "type-array"),
    "plan a number": ('plans = ["structure"', "plans = [1", "type-text"),
    "title in an unknown language": ("[title]\nuk = ", "[title]\nua = ", "key-unknown"),
    "title a number": ("[title]\n", "title = 3\n[titel]\n", "type-table"),
    "givens empty": ("[givens]\n", "[givens]\n[given]\n", "type-table"),
    "given without a unit": ('phi = { unit = "deg" }', "phi = {}", "given-kind"),
    "given with a unit and choices": ('{ unit = "deg" }', '{ unit = "deg", choices = ["a"] }', "given-kind"),
    "given with an unknown unit": ('unit = "rpm"', 'unit = "rmp"', "unit-unknown-like"),
    "given with a key of no use": ('phi = { unit = "deg" }', 'phi = { unit = "deg", unti = 1 }', "key-unknown-like"),
    "given with a bad name": ('phi = { unit = "deg" }', '"φ" = { unit = "deg" }', "type-name"),
    "default of no choice": ('default = "cw"', 'default = "cv"', "choice-unknown"),
    "choice without its table": ("[choices.side]", "[choices.sides]", "choice-missing"),
    "choice of an unknown word": ("left = { branch_B", "leaft = { branch_B", "key-unknown-like"),
    "choice with other numbers": ("ccw = { sense_1 = 1 }", "ccw = { sense_2 = 1 }", "choice-uneven"),
    "choice with another unit": ('alpha_F3 = "180 deg"', 'alpha_F3 = "180 mm"', "choice-uneven"),
    "choice with a bad number": ('alpha_F3 = "180 deg"', 'alpha_F3 = "x deg"', "number-bad"),
    "sense that is no sign": ("ccw = { sense_1 = 1 }", "ccw = { sense_1 = 2 }", "sign-bad"),
    "point not named": ('points = { B = ["0 mm", "0 mm"] }', 'points = { "1" = ["0 mm", "0 mm"] }', "type-name"),
    "point with one coordinate": ('points = { B = ["0 mm", "0 mm"] }', 'points = { B = ["0 mm"] }', "type-array"),
    "point without a unit": ('points = { B = ["0 mm", "0 mm"] }', "points = { B = [5, 0] }", "unit-missing"),
    "point in seconds": ('points = { B = ["0 mm", "0 mm"] }', 'points = { B = ["5 s", "0 mm"] }', "value-wrong"),
    "point by an angle": ('A = ["l_OA", "0 mm"]', 'A = ["phi", "0 mm"]', "value-wrong"),
    "point by an unknown name": ('A = ["l_OA", "0 mm"]', 'A = ["l_0A", "0 mm"]', "value-unknown-like"),
    "no points": ('points = { B = ["0 mm", "0 mm"] }', "points = {}", "type-table"),
    "link zero": ("number = 1\n", "number = 0\n", "link-number"),
    "link negative": ("number = 3\n", "number = -3\n", "type-whole-number"),
    "centre of another link": ('centre = "S2"', 'centre = "O"', "point-unknown"),
    "mass in newtons": ('mass = "m_2"', 'mass = "F_3"', "value-wrong"),
    "links one table": ("[[mechanism.pair]]", "[mechanism.pair]", "toml-rows"),
    "pair of three links": ("links = [1, 2]", "links = [1, 2, 3]", "type-array"),
    "driver about no pivot": ('pivot = "O"', 'pivot = "A"', "driver-pivot"),
    "driver without a crank": ('point = "A"\nangle', 'point = "O"\nangle', "driver-point"),
    "load named like a length": ('name = "F_3"', 'name = "l_OA"', "load-given"),
    "load in millimetres": ('magnitude = "F_3"', 'magnitude = "l_OA"', "value-wrong"),
    "scale with a bad name": ("mu_V = ", "v = ", "scale-symbol"),
    "scale of nothing": ('mu_V = "pa=80 mm"', 'mu_V = "zz=80 mm"', "scale-segment"),
    "scale of zero": ('mu_V = "pa=80 mm"', 'mu_V = "pa=0 mm"', "scale-not-positive"),
    "scale in kilograms": ('mu_V = "pa=80 mm"', 'mu_V = "5 kg"', "unit-wrong"),
    "scale factor of no plan": ("mu_F_23 =", "mu_F_32 =", "scale-unknown-like"),
    "unknown notation": ('notation = "nau"', 'notation = "naw"', "notation-unknown-like"),
    "scale a number": ('mu_V = "pa=80 mm"', "mu_V = 0.05", "type-text"),
    "variant with an extra given": ('phi = "45 deg"\n', 'phi = "45 deg"\nl_BC = "5 mm"\n', "key-unknown-like"),
    "variant with a given twice": ('phi = "45 deg"\n', 'phi = "45 deg"\nphi = "46 deg"\n', "toml-twice"),
    "variant twice": ('id = "1"', 'id = "0"', "id-twice"),
    "angle in millimetres": ('phi = "45 deg"', 'phi = "45 mm"', "unit-wrong"),
    "angle of an unknown unit": ('phi = "45 deg"', 'phi = "45 dg"', "unit-unknown-like"),
    "angle not a number": ('phi = "45 deg"', 'phi = "forty"', "number-bad"),
    "angle empty": ('phi = "45 deg"', 'phi = ""', "number-empty"),
    "angle nan": ('phi = "45 deg"', "phi = nan", "number-bad"),
    "angle inf": ('phi = "45 deg"', "phi = -inf", "number-infinite"),
    "angle 1e400 without quotes": ('phi = "45 deg"', "phi = 1e400", "number-infinite"),
    "angle an array": ('phi = "45 deg"', "phi = [45]", "type-quantity"),
    "angle true": ('phi = "45 deg"', "phi = true", "type-quantity"),
    "angle of five thousand digits": ('phi = "45 deg"', "phi = " + "9" * 5000, "number-infinite"),
    "length zero": ('l_OA = "30 mm"', "l_OA = 0", "not-positive"),
    "length huge": ('l_OA = "30 mm"', 'l_OA = "1e200 mm"', "number-infinite"),
    "inertia negative": ('J_S2 = "0.010 kg*m^2"', 'J_S2 = "-0.010 kg*m^2"', "negative"),
    "rotation of no choice": ('rotation = "cw"', 'rotation = "left"', "choice-unknown"),
    "reconstructed of no given": ('reconstructed = ["J_S2"]', 'reconstructed = ["J_S"]', "given-missing-like"),
    "typographic quotes": ('phi = "45 deg"', "phi = «45 deg»", "toml-quotes"),
    "straight and typographic quotes": ('phi = "45 deg"', 'phi = "45 deg”', "toml-quotes"),
    "colon": ('phi = "45 deg"', "phi: 45", "toml-colon"),
    "comma at the end": ('phi = "45 deg"', "phi = 45,", "toml-end"),
    "unit without quotes in a row": ('default = "cw"', "default = 60 deg", "toml-bare"),
    "word without quotes": ('phi = "45 deg"', "phi = forty", "toml-bare"),
    "Cyrillic key": ('phi = "45 deg"', "рhi = 45", "name-cyrillic"),
    "no equals sign": ('phi = "45 deg"', "phi 45", "toml-bad"),
    "string not closed": ('phi = "45 deg"', 'phi = "45 deg', "toml-open"),
    "no comma in a table": ('B = ["l_AB", "0 mm"],', 'B = ["l_AB", "0 mm"]', "toml-comma"),
    "no comma before a text": ('"structure", "position"', '"structure" "position"', "toml-comma"),
    "no comma between rows": ('"structure", "position"', '"structure",\n  "lever" # last\n  "position"', "toml-comma"),
    "no comma behind a number": ('default = "cw"', "default = 3 choices = 5", "toml-comma"),
    "array not closed": ('"lever"]', '"lever"', "toml-unclosed"),
    "rows not closed": ('phi = { unit = "deg" }', 'phi = [\n{ unit = "deg" },', "toml-unclosed"),
    "table not closed": ('phi = { unit = "deg" }', 'phi = { unit = "deg"', "toml-unclosed"),
    "table without an end": ('phi = { unit = "deg" }', 'phi = { unit = "deg",', "toml-unclosed"),
}


@pytest.fixture
def refusal(folder: Path, run: Run) -> Callable[..., str]:
    """Runs a command that must be refused with nothing written, and returns its one line."""

    def refused(*arguments: str, wanted: int = 2) -> str:
        before = sorted(folder.rglob("*"))
        status, out, err = run(*arguments)
        assert (status, out, err.count("\n"), len(err.splitlines())) == (wanted, "", 1, 1), err
        assert "Traceback" not in err
        assert sorted(folder.rglob("*")) == before
        return err.strip()

    return refused


@pytest.mark.parametrize("name", FILES)
def test_a_fault_in_a_task_file_is_named_with_its_place(name: str, refusal: Callable[..., str]) -> None:
    old, new, key = FILES[name]
    assert old in GOOD
    at = GOOD.index(old)
    text = GOOD.replace(old, new, 1)
    Path("t.toml").write_text(text, encoding="utf-8")
    first, last = GOOD.count("\n", 0, at) + 1, text.count("\n", 0, at + len(new)) + 1

    with pytest.raises(InputError) as caught:
        load_task("t.toml")

    keys = [fault.key for fault in getattr(caught.value, "faults", [caught.value])]
    assert key in keys
    line = refusal("solve", "t.toml")
    assert line == str(caught.value)
    assert line.startswith("t.toml:")
    if key not in {"key-missing", "choice-missing"}:
        assert first - 1 <= int(line.split(":")[1]) <= last + 1
    assert len(line) < 300


# Mechanism files as newcomers break them.
@pytest.mark.parametrize("name", [*BROKEN, *LOADED])
def test_fault_is_named_with_its_place_and_what_was_expected(name: str, refusal: Callable[..., str]) -> None:
    text, key, place, said = broken(name)
    Path("mine.toml").write_text(text, encoding="utf-8")
    _, faults = read_text(text, "mine.toml")
    fault = next(fault for fault in faults if getattr(fault, "cause", fault).key == key)
    lines = [int(str(one).split(":")[1]) for one in (fault, faults[0])]

    assert f"{place}: " in fault.text("en")
    assert said in fault.text("en")
    assert 1 <= lines[0] <= text.count("\n") + 1
    if name in BROKEN and key not in {"links-rigid", "links-free", "link-loose", "no-construction"}:
        new, old = text.splitlines(), brokens.GOOD.splitlines()
        changed = [i for i, line in enumerate(new) if line not in old] or [
            i for i, pair in enumerate(zip(new, old, strict=False)) if pair[0] != pair[1]
        ]
        assert min(abs(lines[1] - 1 - i) for i in changed) <= 8
    for language in LANGUAGES:
        line = refusal("solve", "mine.toml", "--lang", language)
        assert line.startswith("mine.toml:")
        assert "{" not in line
        assert len(line) < 330


@pytest.mark.parametrize(
    ("edits", "said"),
    [
        pytest.param(
            [("l_AB = 260", "l_AB = 26"), ('"220 mm"', '"22 mm"')],
            "in any position of the crank: here",
            id="loop never closed",
        ),
        pytest.param([("l_OA = 100", "l_OA = 230")], "the nearest positions that can be", id="loop not closed here"),
    ],
)
def test_loop_that_does_not_close_is_refused_with_status_three(
    edits: list[tuple[str, str]], said: str, refusal: Callable[..., str]
) -> None:
    text = brokens.GOOD.replace("phi = 60", "phi = 150")
    for old, new in edits:
        text = text.replace(old, new)
    Path("mine.toml").write_text(text, encoding="utf-8")

    err = refusal("solve", "mine.toml", wanted=3)
    reason = solve("mine.toml").reason

    assert said in err
    assert "mm are missing at B" in err
    assert reason is not None
    assert len({reason.text(language) for language in LANGUAGES}) == 3


ALONE = {
    "unit-unknown-like": (brokens.GOOD, 'n_1 = { unit = "rpm" }', 'n_1 = { unit = "rpmm" }'),
    "key-unknown-like": (brokens.GOOD, 'n_1 = { unit = "rpm" }', 'n_1 = { unt = "rpm" }'),
    "given-kind": (brokens.GOOD, 'n_1 = { unit = "rpm" }', "n_1 = {}"),
    "diagram-stroke": (brokens.PRESS, "at = [0, 0.35, 0.35", "at = [0, 0.35, 0.3"),
    "diagram-over": (brokens.PRESS, 'over = "stroke"', 'over = "path"'),
    "diagram-uneven": (brokens.PRESS, 'values = ["0 N", "0 N", ', 'values = ["0 N", '),
}


@pytest.mark.parametrize("key", ALONE)
def test_what_follows_from_a_fault_is_no_other_fault(key: str) -> None:
    text, old, new = ALONE[key]

    _, faults = read_text(with_changes(text, (old, new)), "mine.toml")

    assert [getattr(fault, "cause", fault).key for fault in faults] == [key]


@pytest.mark.parametrize("format_", ["\u04103", "\u04303"])
def test_word_of_an_option_may_have_a_cyrillic_letter_that_looks_like_its_own(format_: str, run: Run) -> None:
    wide, narrow = (
        run("solve", "nau-slider-crank", "--format", name, "--only", "velocity") for name in (format_, "A3")
    )

    assert wide == narrow
    assert wide[0] == 0


@pytest.mark.parametrize(("printed", "typed"), [("φ", "phi"), ("J_S₂", "J_S2"), ("lOA", "l_OA"), ("n1", "n_1")])
def test_a_setting_is_taken_as_it_is_printed(printed: str, typed: str) -> None:
    taken, usual = (solve("nau-slider-crank", set={name: "30"}) for name in (printed, typed))

    assert taken.case.settings == {typed: "30"}
    assert taken.to_json() == usual.to_json()


def test_all_settings_that_are_wrong_are_told_at_once() -> None:
    with pytest.raises(InputError) as caught:
        solve(TASK, set={"phi": "abc", "l_OA": "30 mm", "n_1": "5 kg", "l_XX": "1 mm"})

    assert [error.key for error in caught.value.data["faults"]] == ["number-bad", "unit-wrong", "given-unknown"]
    assert "no given 'l_XX'" in caught.value.text("en")


def test_metres_for_millimetres_are_told_also_where_nothing_can_be_assembled_of_them(run: Run) -> None:
    status, out, err = run("solve", TASK, "-v", "3", "--set", "l_AB=0,2")

    assert (status, out) == (3, "")
    assert err.startswith("l_AB: 0.2 mm is far from what the variants")
    assert "cannot be assembled in this position" in err


def test_metres_for_millimetres_are_told_also_where_no_format_has_room_for_the_plan(folder: Path, run: Run) -> None:
    status, out, err = run("sheet", TASK, "-v", "3", "--set", "l_OA=0.04", "-o", "sheet.svg", "--lang", "en")

    assert (status, out) == (2, "")
    assert err.startswith("l_OA: 0.04 mm is far from what the variants of the task have, from 25 to 50 mm")
    assert "the plan fits on no format" in err
    assert not [*folder.iterdir()]


def test_answers_without_their_task_and_a_task_file_without_its_suffix_are_told(
    folder: Path, refusal: Callable[..., str]
) -> None:
    """Answers were text in no UTF-8, or there was nothing to do; of my-own.toml it was told which tasks there are."""
    for name in ("answers.xlsx", "plans.svg", "my-own.toml"):
        Path(name).write_bytes(b"PK\xff")

    assert refusal("check", "answers.xlsx").startswith("the task is missing before answers.xlsx")
    assert refusal("check", "plans.svg", "answers.xlsx", "-v", "3").startswith("the task is missing before plans.svg")
    assert refusal("solve", "my-own").endswith("did you mean my-own.toml?")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [("scheme-1", "scheme-01-compressor"), ("Scheme-009", "scheme-09-shaper"), ("scheme-011", "scheme-11-slotter")],
)
def test_the_number_of_a_scheme_may_be_written_without_its_zero(
    typed: str, meant: str, refusal: Callable[..., str]
) -> None:
    """Of scheme-1 it was asked whether scheme-11-slotter is meant."""
    assert refusal("new", "x.toml", "--from", typed).endswith(f"did you mean {meant}?")
    assert refusal("solve", typed).endswith(f"did you mean {meant}?")


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (("sheet", TASK, "-o", "x.pdf", "--only", "position", "velocity"), "--only velocity"),
        (("variants", TASK, "--quantities", "V_B", "a_B"), "--quantities a_B"),
        (("sheet", TASK, "3", "--only", "velocity", "-o", "x.pdf"), "-v 3"),
        (("sheet", TASK, "-o", "x.pdf", "y.svg"), "-o y.svg"),
    ],
)
def test_a_word_too_many_is_told_with_its_option(
    command: tuple[str, ...], told: str, refusal: Callable[..., str]
) -> None:
    """A plan was taken for a variant."""
    assert refusal(*command).endswith(f"was {told} meant?")


def test_a_name_that_there_is_not_is_told_with_one_of_its_kind(refusal: Callable[..., str]) -> None:
    """For a mass a force was offered."""
    Path("x.toml").write_text(GOOD.replace('mass = "m_2"', 'mass = "f_3"'), encoding="utf-8")

    assert "did you mean 'm_3'?" in refusal("solve", "x.toml")


@pytest.mark.parametrize("between", [",", ", ", ";", "; "])
def test_several_settings_in_one_are_to_be_said_one_by_one(between: str, refusal: Callable[..., str]) -> None:
    """Of a semicolon it was told that there is no unit `;n_1=700`."""
    assert refusal("solve", TASK, "--set", f"l_AB=200{between}n_1=700").endswith("say --set again for 'n_1=700'")


def test_setting_with_a_cyrillic_letter_says_so() -> None:
    with pytest.raises(InputError) as refused:
        solve("nau-slider-crank", set={"l_\u041e\u0410": "55 mm"})

    assert refused.value.key == "name-cyrillic"
    assert all(refused.value.text(language).endswith(("O", "same")) for language in LANGUAGES)


def test_without_a_change_the_files_are_good() -> None:
    for text in (GOOD, brokens.GOOD, brokens.PRESS, brokens.AUTOMATON):
        assert read_text(text, "mine.toml")[1] == ()


BYTES = {
    "empty": (b"", "empty"),
    "binary": (b"\x7fELF\x02\x01\x01\x00\x00", "bin.toml"),
    "not UTF-8": ("id = 'механізм'".encode("cp1251"), "bin.toml:1: not a text in UTF-8: save the file"),
    "zero byte": (b'id = "a"\nsource = "\x00"', "bin.toml:2: not a text file"),
    "UTF-16": ("id = 'x'".encode("utf-16"), "bin.toml:1"),
    "nested arrays": (b"x = " + b"[" * 100_000 + b"]" * 100_000, "nested too deep"),
    "long dotted key": (b".".join([b"a"] * 400_000) + b" = 1", "nested too deep"),
    "long dotted heading": (b"[" + b" . ".join([b"'a'"] * 100_000) + b"]", "nested too deep"),
    "very many faults": (GOOD.encode() + b"".join(b"k%d = 1\n" % i for i in range(30_000)), "(and 999 more"),
    "escape sequence": (b"x = \x1b[31m", "bin.toml:1:"),
}


@pytest.mark.parametrize("name", BYTES)
def test_a_file_that_is_no_task_is_refused(name: str, refusal: Callable[..., str]) -> None:
    data, part = BYTES[name]
    Path("bin.toml").write_bytes(data)

    line = refusal("solve", "bin.toml")

    assert part in line
    assert line.isprintable()


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_task_file_may_have_a_mark_of_its_encoding(encoding: str, folder: Path) -> None:
    Path("mine.toml").write_text(GOOD, encoding=encoding)

    task = load_task("mine.toml")
    assert (task.text, task.title) == (GOOD, load_task(TASK).title)


def test_a_large_file_is_refused_unread_and_one_of_just_under_a_megabyte_is_read(refusal: Callable[..., str]) -> None:
    with Path("large.toml").open("wb") as file:
        file.truncate(1 << 40)  # no such file fits into memory
    Path("t.toml").write_text(GOOD + "#" * (LARGEST_FILE - len(GOOD.encode()) - 1), encoding="utf-8")

    assert "larger than 1 MB" in refusal("solve", "large.toml")
    assert load_task("t.toml").id == TASK


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_what_is_no_regular_file_is_refused_without_waiting_for_it(refusal: Callable[..., str]) -> None:
    os.mkfifo("pipe.toml")
    Path("dir.toml").mkdir()

    for name in ("pipe.toml", "dir.toml", "/dev/zero", "."):
        assert "not a folder or a device" in refusal("solve", name)


ARGUMENTS = {
    "unknown command": (["slove", TASK], "did you mean solve?"),
    "unknown option": (["solve", TASK, "--varient", "3"], "--variant"),
    "option with one dash": (["solve", TASK, "-set", "phi=3"], "unknown option -set; did you mean --set?"),
    "unknown letter": (["solve", TASK, "-z"], "unknown option -z; see kulman solve --help"),
    "several givens at once": (["solve", TASK, "--set", "phi=60°, n_1=90"], "say --set again for 'n_1=90'"),
    "word of one task's title": (["solve", "щокова"], "did you mean scheme-14-jaw-crusher?"),
    "word of many titles": (["solve", "механізм"], "the tasks are: "),
    "no task": (["solve"], "TASK"),
    "no output": (["sheet", TASK], "-o is missing"),
    "too many arguments": (["solve", TASK, "3", "4"], "unexpected '3 4'; see kulman solve --help"),
    "variant without its option": (["solve", TASK, "3"], "unexpected '3'; was -v 3 meant?"),
    "given without its option": (["sheet", TASK, "phi=3", "-o", "x.svg"], "was --set phi=3 meant?"),
    "file without its option": (["note", TASK, "x.pdf", "-o", "x.md"], "was -o x.pdf meant?"),
    "too many arguments of a command without options": (["show", TASK, "3"], "see kulman show --help"),
    "unknown task": (["solve", "nau-slider"], "did you mean nau-slider-crank?"),
    "task empty": (["solve", ""], "nau-slider-crank"),
    "missing file": (["solve", "none.toml"], "none.toml: there is no such file"),
    "file with a zero byte": (["solve", "a\0.toml"], "no such file"),
    "file with a long name": (["solve", "a" * 5000 + ".toml"], "no such file"),
    "unknown variant": (["solve", TASK, "-v", "11"], "no variant '11'"),
    "part of one task's name": (["solve", "scheme-03"], "did you mean scheme-03-crank-rocker?"),
    "given in small letters": (["solve", TASK, "--set", "phi=1", "--set", "l_oa=5"], "did you mean 'l_OA'?"),
    "unknown given": (["solve", TASK, "--set", "l_0A=5"], "did you mean 'l_OA'?"),
    "set without a value": (["solve", TASK, "--set", "l_OA"], "NAME=VALUE"),
    "set twice": (["solve", TASK, "--set", "l_OA=5", "--set", "l_OA=6"], "twice"),
    "set to another kind": (["solve", TASK, "--set", "l_OA=5 kg"], "l_OA: the unit kg"),
    "set to an unknown unit": (["solve", TASK, "--set", "l_OA=5 дюймів"], "l_OA: unknown unit"),
    "set to zero": (["solve", TASK, "--set", "l_OA=0"], "l_OA: '0': must be greater than zero"),
    "set below zero": (["solve", TASK, "--set", "m_2=-1"], "m_2: '-1': must not be negative"),
    "set to nan": (["solve", TASK, "--set", "phi=nan"], "phi: 'nan' is not a number"),
    "set too large": (["solve", TASK, "--set", "phi=1e400"], "too large"),
    "set to no choice": (["solve", TASK, "--set", "side=top"], "left, right"),
    "unknown plan": (["solve", TASK, "--only", "velosity"], "did you mean 'velocity'?"),
    "no plan": (["solve", TASK, "--only", ""], "unknown plan ''"),
    "unknown language": (["solve", TASK, "--lang", "de"], "--lang: 'de'"),
    "unknown notation": (["solve", TASK, "--notation", "zzz"], "unknown notation 'zzz'"),
    "scale by a segment of no plan": (["solve", TASK, "--scale", "pz=80"], "pz: 'pz' is not a segment"),
    "scale of a figure drawn larger": (
        ["solve", TASK, "-v", "3", "--scale", "mu_l_1=0.001"],
        "mu_l_1 is that of a figure that is drawn larger, and follows from the others; chosen may be: mu_l, mu_V",
    ),
    "scale twice": (["solve", TASK, "--scale", "pa=80", "--scale", "pa=70"], "twice"),
    "unknown format": (["sheet", TASK, "-o", "x.svg", "--format", "A9"], "--format: 'A9'"),
    "unknown norm": (["sheet", TASK, "-o", "x.svg", "--norm", "din"], "--norm: 'din'"),
    "unknown suffix": (["sheet", TASK, "-o", "x.doc"], ".svg"),
    "one suffix of two unknown": (["sheet", TASK, "-o", "x.svg", "-o", "x.xyz"], "x.xyz"),
    "output folder missing": (["sheet", TASK, "-o", "none/x.svg"], "no folder 'none'"),
    "output folder a file": (["sheet", TASK, "-o", "file.txt/x.svg"], "no folder 'file.txt'"),
    "output is a folder": (["sheet", TASK, "-o", "dir.svg"], "this is a folder"),
    "output twice under two names": (["sheet", TASK, "-o", "x.svg", "-o", "./x.svg"], "twice"),
    "tiles of no PDF": (["sheet", TASK, "--tile", "A4", "-o", "x.pdf", "-o", "x.svg"], "x.svg: only a PDF"),
    "output with a zero byte": (["sheet", TASK, "-o", "a\0.svg"], "no file can have this name"),
    "output empty": (["sheet", TASK, "-o", ""], ".svg"),
    "check of a missing file": (["list", "--check", "none.toml"], "no such file"),
    "check without a file": (["list", "--check"], "--check"),
}


@pytest.mark.parametrize("name", ARGUMENTS)
def test_a_command_that_cannot_be_carried_out_is_refused(name: str, refusal: Callable[..., str]) -> None:
    arguments, part = ARGUMENTS[name]
    Path("file.txt").touch()
    Path("dir.svg").mkdir()

    line = refusal(*arguments)

    assert part in line
    assert len(line) < 400


def test_every_error_has_its_message() -> None:
    calls = [node for tree in trees().values() for node in ast.walk(tree) if isinstance(node, ast.Call) and node.args]
    named = [(getattr(call.func, "id", ""), getattr(call.args[0], "value", None)) for call in calls]
    said = [(name, key) for name, key in named if isinstance(key, str)]
    errors = {key for name, key in said if name in {"KulmanError", "InputError", "PositionError", "unknown"}}
    alike = {f"{key}-like" for name, key in said if name == "unknown"} - {"link-unknown-like"}  # numbers have none

    assert len(errors) > 100
    assert errors | alike <= messages("en").keys()


def test_a_message_stays_one_line_whatever_it_quotes() -> None:
    error = KulmanError("number-bad", text="a\nb\r\n\u2028c {0} {x}")

    assert len(error.text().splitlines()) == 1


@settings(suppress_health_check=[HealthCheck.too_slow], max_examples=40)
@given(st.binary(max_size=300) | st.text(max_size=300).map(str.encode))
def test_any_bytes_are_refused_in_one_line(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    file = tmp_path_factory.getbasetemp() / "any.toml"
    file.write_bytes(data)

    with pytest.raises(InputError) as caught:
        load_task(file)

    assert caught.value.text("uk").isprintable()


@settings(suppress_health_check=[HealthCheck.too_slow], max_examples=50)
@given(st.data())
def test_a_good_file_with_a_piece_cut_out_never_crashes(data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(GOOD)))
    end = data.draw(st.integers(start, min(len(GOOD), start + 200)))

    instead = data.draw(st.sampled_from(("", "0", '"', "\n", "[", "{}")))

    task, faults = read_text(GOOD[:start] + instead + GOOD[end:], "t.toml")

    assert (task is None) == bool(faults)
    assert all(fault.text("ru").isprintable() for fault in faults)


@pytest.mark.parametrize("suffix", ["csv", "xlsx"])
@pytest.mark.parametrize("command", [("check", TASK, "-v", "3"), ("batch", TASK)], ids=["answers", "roster"])
def test_a_form_that_has_been_filled_in_is_never_written_over(
    command: tuple[str, ...], suffix: str, run: Run, refusal: Callable[..., str]
) -> None:
    form = Path(f"form.{suffix}")
    assert [run(*command, "--form", form.name)[0] for _ in range(2)] == [0, 0]  # an empty one may be
    filled = form.read_bytes() + b" "
    form.write_bytes(filled)

    assert "it is left as it is" in refusal(*command, "--form", form.name, wanted=4)
    assert form.read_bytes() == filled


@pytest.mark.parametrize(
    ("read", "command"),
    [
        ("answers.csv", ("check", TASK, "answers.csv", "-o", "./answers.csv")),
        ("plans.svg", ("check", TASK, "-v", "3", "plans.svg", "-o", "plans.svg")),
        ("plans.svg", ("check", TASK, "-v", "3", "*.svg", "-o", "marked.svg", "-o", "plans.svg")),
        ("roster.csv", ("check", TASK, "answers.csv", "--roster", "roster.csv", "--moodle", "roster.csv")),
        ("numbers.csv", ("variants", TASK, "--from", "numbers.csv", "-o", "key.xlsx", "-o", "numbers.csv")),
    ],
)
def test_what_a_command_reads_is_never_written_over(
    read: str, command: tuple[str, ...], folder: Path, refusal: Callable[..., str]
) -> None:
    sheet(TASK, "3", only=["velocity"]).save("plans.svg")
    Path("answers.csv").write_text("variant,3\nquantity,value\nV_B,5.62\n")
    Path("roster.csv").write_text("student,variant\nKoval,3\n")
    Path("numbers.csv").write_text(
        "variant,phi,l_OA,l_AB,l_AS2,n_1,m_2,m_3,J_S2,F_3\n1,30,25,125,42,2000,1,1,0.005,2\n"
    )
    before = {path.name: path.read_bytes() for path in folder.iterdir()}

    assert read in refusal(*command, wanted=4)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize(
    ("task", "name", "hint"),
    [
        (TASK, "omega_1", "n_1 = … rad/s"),
        (TASK, "ω_1", "n_1 = … rad/s"),
        ("bertyaev-six-bar", "n_1", "omega_1 = … rpm"),
    ],
)
def test_a_speed_in_its_other_measure_is_told_as_the_task_takes_it(
    task: str, name: str, hint: str, folder: Path, refusal: Callable[..., str]
) -> None:
    Path("roster.csv").write_text(f"student,variant,{name}\nKoval,3,70\n", encoding="utf-8")
    for command in (
        ("solve", task, "--set", f"{name}=70"),
        ("batch", task, "--roster", "roster.csv", "--out", "out"),
        ("variants", task, "--make", "2", "--range", f"{name}=60..70"),
    ):
        assert f"give it as '{hint}'" in refusal(*command)
    with pytest.raises(InputError, match="give it as"):
        solve_many(task, **{name: [70.0]}) if name.isascii() else solve(task, set={name: 70.0})
    assert solve(task, set={hint.partition(" ")[0]: f"70 {hint.rpartition(' ')[2]}"}).status == "ok"


TABLES = {  # of people, which no result may take the place of
    "a form": "завдання;nau-slider-crank\nваріант;3\nвеличина;відрізок, мм;значення\nV_B;56,2;\n",
    "a form of one's own": "quantity,value\nV_B,5.62\n",
    "a class": "Фамилия;Вариант;V_B, м/с\nКоваль;3;5,62\n",
    "a roster": "student,group,variant\nKoval,AT-301,3\n",
    "data of variants": "variant,phi [deg],l_OA [mm]\n1,30,25\n",
}
WRITING = {
    "solve": ("solve", TASK, "-v", "3"),
    "sweep": ("sweep", TASK, "--positions", "6"),
    "chart": ("chart", TASK, "--chart", "depth", "--positions", "6"),
    "variants": ("variants", TASK, "--quantities", "V_B"),
    "check": ("check", TASK, "answers.csv", "their.csv"),
}


@pytest.mark.parametrize("text", TABLES.values(), ids=TABLES)
@pytest.mark.parametrize("command", WRITING.values(), ids=WRITING)
@pytest.mark.parametrize("suffix", ["csv", "xlsx"])
def test_no_result_takes_the_place_of_what_people_have_filled_in(
    suffix: str, command: tuple[str, ...], text: str, folder: Path, refusal: Callable[..., str]
) -> None:
    rows = [*csv.reader(text.splitlines(), delimiter=";" if ";" in text else ",")]
    for name in ("answers.csv", "their.csv"):
        Path(name).write_text("variant,3\nquantity,value\nV_B,5.62\n")
    filled = Path(f"filled.{suffix}")
    filled.write_bytes(table_bytes(filled, rows, "uk", "", [], 0))
    before = filled.read_bytes()

    told = refusal(*command, "-o", "new.json" if command[0] != "check" else "new.xlsx", "-o", filled.name, wanted=4)

    assert re.fullmatch(rf"filled\.{suffix}: .*give another name.*", told)
    assert filled.read_bytes() == before


@pytest.mark.parametrize("command", WRITING.values(), ids=WRITING)
def test_the_same_command_may_be_run_again_over_its_own_output(
    command: tuple[str, ...], folder: Path, run: Run
) -> None:
    for name in ("answers.csv", "their.csv"):
        Path(name).write_text(f"variant,3\nname,{name}\nquantity,value\nV_B,5.62\n")
    kinds = (".csv", ".xlsx", *{"check": (".html",), "solve": (".json",)}.get(command[0], (".pdf", ".svg")))
    kinds = (*kinds[:2], ".xml", ".html") if command[0] == "variants" else kinds
    again = [f for kind in kinds for f in ("-o", f"own{kind}")] + ["--moodle", "moodle.csv"] * (command[0] == "check")
    Path("own.csv").touch()  # an empty file is nobody's

    for language in (*LANGUAGES, "en"):
        assert run(*command, *again, "--lang", language)[0] == 0


def inkscape(data: bytes) -> bytes:
    """Return a drawing as Inkscape saves it again."""
    return re.sub(rb"<svg ", b'<svg\n   sodipodi:docname="plans.svg"\n   ', data, count=1).replace(
        b"?>", b' standalone="no"?>', 1
    )


def saved_again(data: bytes) -> bytes:
    """Return a file of an office program as it is when one has saved it."""
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(stream, "w") as new:
        for name in old.namelist():
            text = old.read(name)
            if name == "docProps/core.xml":
                text = re.sub(rb"<dcterms:modified.*</dcterms:modified>", b"", text)
                at = b'<dcterms:modified xsi:type="dcterms:W3CDTF">2026-12-01T10:00:00Z</dcterms:modified></cp:coreP'
                text = text.replace(b"</cp:coreP", at)
            new.writestr(name, text)
        if "geogebra.xml" in old.namelist():
            new.writestr("geogebra_thumbnail.png", b"")
    return stream.getvalue()


CHANGED: dict[str, tuple[tuple[str, ...], Callable[[bytes], bytes]]] = {
    "own.svg": (("sheet", TASK, "--only", "velocity"), inkscape),
    "own.dxf": (("sheet", TASK, "--only", "velocity"), lambda data: data.replace(b"ezdxf", b"Olha K")),
    "own.pdf": (("handout", TASK, "--only", "velocity"), lambda data: data + b"1 0 obj\n<<>>\nendobj\n%%EOF\n"),
    "own.ggb": (("sheet", TASK, "--only", "velocity"), saved_again),
    "own.docx": (("note", TASK, "--only", "velocity"), saved_again),
    "own.xlsx": (("sweep", TASK, "--positions", "6"), saved_again),
}


@pytest.mark.parametrize("name", CHANGED)
def test_what_another_program_has_saved_is_not_written_over(
    name: str, folder: Path, run: Run, refusal: Callable[..., str]
) -> None:
    command, change = CHANGED[name]
    assert [run(*command, "-o", name)[0] for _ in range(2)] == [0, 0]
    changed = change(Path(name).read_bytes())
    Path(name).write_bytes(changed)

    for language, said in zip(LANGUAGES, ("інша програма", "другая программа", "another program"), strict=True):
        assert said in refusal(*command, "-o", name, "--lang", language, wanted=4)
    assert Path(name).read_bytes() == changed


def test_from_python_nothing_that_people_have_filled_in_is_lost(folder: Path) -> None:
    Path("form.csv").write_text("variant,3\nquantity,value\nV_B,5.62\n")

    with pytest.raises(InputError, match=r"form\.csv: .*give another name"):
        solve(TASK, "3").save("form.csv")
