"""Bad input: one line that names the place and what was expected, status 2, nothing written."""

import ast
import os
import string
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kulman import cli
from kulman.scales.errors import LANGUAGES, InputError, KulmanError, messages
from kulman.tests.support.sources import trees
from kulman.variants.reader import LARGEST_FILE, load_task, read_text
from kulman.variants.shelf import bundled_text

GOOD = bundled_text("nau-slider-crank")

# What is replaced in a good file, by what, and the key of the first fault, which is on the line of the replacement.
FILES = {
    "no id": ('id = "nau-slider-crank"\n', "", "key-missing"),
    "id a number": ('id = "nau-slider-crank"', "id = 5", "type-id"),
    "id with a space": ('id = "nau-slider-crank"', 'id = "my task"', "type-id"),
    "no source": ("source = ", "sorce = ", "key-unknown-like"),
    "empty source": ('source = "National', 'source = ""\n# "National', "type-text"),
    "unknown plan": ('"structure", "position"', '"structure", "posision"', "plan-unknown-like"),
    "plans not an array": ("plans = [", "plans = 1 # [", "type-array"),
    "no plans": ("plans = [", "plans = [] # [", "type-array"),
    "plan a number": ('plans = ["structure"', "plans = [1", "type-text"),
    "title without Ukrainian": ("[title]\nuk = ", "[title]\nua = ", "key-missing"),
    "title a text": ("[title]\n", 'title = "x"\n[titel]\n', "type-table"),
    "givens empty": ("[givens]\n", "[givens]\n[given]\n", "type-table"),
    "given without a unit": ('phi = { unit = "deg" }', "phi = {}", "given-kind"),
    "given with a unit and choices": ('{ unit = "deg" }', '{ unit = "deg", choices = ["a"] }', "given-kind"),
    "given an array": ('phi = { unit = "deg" }', 'phi = ["deg"]', "type-table"),
    "given with an unknown unit": ('unit = "rpm"', 'unit = "rmp"', "unit-unknown-like"),
    "given with a unit of no text": ('unit = "rpm"', "unit = 1", "type-text"),
    "given with a key of no use": ('phi = { unit = "deg" }', 'phi = { unit = "deg", unti = 1 }', "key-unknown-like"),
    "given with a bad name": ('phi = { unit = "deg" }', '"φ" = { unit = "deg" }', "type-name"),
    "default of no choice": ('default = "cw"', 'default = "cv"', "choice-unknown"),
    "choice without its table": ("[choices.side]", "[choices.sides]", "choice-missing"),
    "choice of an unknown word": ("left = { branch_B", "leaft = { branch_B", "key-unknown-like"),
    "choice with other numbers": ("ccw = { sense_1 = 1 }", "ccw = { sense_2 = 1 }", "choice-uneven"),
    "choice with another unit": ('alpha_F3 = "180 deg"', 'alpha_F3 = "180 mm"', "choice-uneven"),
    "choice with a bad number": ('alpha_F3 = "180 deg"', 'alpha_F3 = "x deg"', "number-bad"),
    "sense that is no sign": ("ccw = { sense_1 = 1 }", "ccw = { sense_1 = 2 }", "sign-bad"),
    "choice that sets a given": ("cw = { sense_1 = -1 }", "cw = { m_2 = -1 }", "choice-uneven"),
    "point not named": ('points = { B = ["0 mm", "0 mm"] }', 'points = { "1" = ["0 mm", "0 mm"] }', "type-name"),
    "point with one coordinate": ('points = { B = ["0 mm", "0 mm"] }', 'points = { B = ["0 mm"] }', "type-array"),
    "point without a unit": ('points = { B = ["0 mm", "0 mm"] }', "points = { B = [5, 0] }", "unit-missing"),
    "point in seconds": ('points = { B = ["0 mm", "0 mm"] }', 'points = { B = ["5 s", "0 mm"] }', "value-wrong"),
    "point by an angle": ('A = ["l_OA", "0 mm"]', 'A = ["phi", "0 mm"]', "value-wrong"),
    "point by an unknown name": ('A = ["l_OA", "0 mm"]', 'A = ["l_0A", "0 mm"]', "value-unknown-like"),
    "no points": ('points = { B = ["0 mm", "0 mm"] }', "points = {}", "type-table"),
    "link zero": ("number = 1\n", "number = 0\n", "link-number"),
    "link twice": ("number = 3\n", "number = 2\n", "link-number"),
    "link negative": ("number = 3\n", "number = -3\n", "type-link-number"),
    "link true": ("number = 3\n", "number = true\n", "type-link-number"),
    "centre of another link": ('centre = "S2"', 'centre = "O"', "point-unknown"),
    "mass in newtons": ('mass = "m_2"', 'mass = "F_3"', "value-wrong"),
    "links one table": ("[[mechanism.pair]]", "[mechanism.pair]", "toml-twice"),
    "pair of no kind": ('kind = "prismatic"', 'kind = "prizmatic"', "pair-kind"),
    "pair with itself": ("links = [1, 2]", "links = [1, 1]", "pair-same"),
    "pair with an unknown link": ("links = [1, 2]", "links = [1, 7]", "link-unknown"),
    "pair of three links": ("links = [1, 2]", "links = [1, 2, 3]", "type-array"),
    "pair with the frame nowhere": ('links = [0, 1]\nat = ["0 mm", "0 mm"]', "links = [0, 1]", "key-missing"),
    "pair of moving links with a place": ("links = [1, 2]", 'links = [1, 2]\nat = ["0 mm", "0 mm"]', "pair-at"),
    "guide without a direction": ('direction = "0 deg"\n', "", "key-missing"),
    "driver of an unknown point": ('pivot = "O"', 'pivot = "Q"', "point-unknown"),
    "driver about no pivot": ('pivot = "O"', 'pivot = "A"', "driver-pivot"),
    "driver without a crank": ('point = "A"\nangle', 'point = "O"\nangle', "driver-point"),
    "load named like a length": ('name = "F_3"', 'name = "l_OA"', "load-given"),
    "no structure": ("links = [3, 0]", "links = [2, 0]", "link-loose"),
    "driver with a speed in newtons": ('speed = "n_1"', 'speed = "F_3"', "value-wrong"),
    "load in millimetres": ('magnitude = "F_3"', 'magnitude = "l_OA"', "value-wrong"),
    "load on no link": ('name = "F_3"\nlink = 3', 'name = "F_3"\nlink = 4', "link-unknown"),
    "scale with a bad name": ("mu_V = ", "v = ", "scale-symbol"),
    "scale of nothing": ('mu_V = "pa=80 mm"', 'mu_V = "zz=80 mm"', "scale-segment"),
    "scale of zero": ('mu_V = "pa=80 mm"', 'mu_V = "pa=0 mm"', "scale-not-positive"),
    "scale in kilograms": ('mu_V = "pa=80 mm"', 'mu_V = "5 kg"', "unit-wrong"),
    "scale factor of no plan": ("mu_F_23 =", "mu_F_32 =", "scale-unknown-like"),
    "segment of no plan": ('mu_V = "pa=80 mm"', 'mu_V = "pz=80 mm"', "scale-segment"),
    "unknown notation": ('notation = "nau"', 'notation = "naw"', "notation-unknown-like"),
    "scale a number": ('mu_V = "pa=80 mm"', "mu_V = 0.05", "type-text"),
    "variant without a given": ('phi = "45 deg"\n', "", "key-missing"),
    "variant with an extra given": ('phi = "45 deg"\n', 'phi = "45 deg"\nl_BC = "5 mm"\n', "key-unknown-like"),
    "variant with a given twice": ('phi = "45 deg"\n', 'phi = "45 deg"\nphi = "46 deg"\n', "toml-twice"),
    "variant twice": ('id = "1"', 'id = "0"', "id-twice"),
    "variant id with a space": ('id = "1"', 'id = "1 a"', "type-id"),
    "angle in millimetres": ('phi = "45 deg"', 'phi = "45 mm"', "unit-wrong"),
    "angle of an unknown unit": ('phi = "45 deg"', 'phi = "45 dg"', "unit-unknown-like"),
    "angle not a number": ('phi = "45 deg"', 'phi = "forty"', "number-bad"),
    "angle empty": ('phi = "45 deg"', 'phi = ""', "number-empty"),
    "angle nan": ('phi = "45 deg"', "phi = nan", "number-bad"),
    "angle inf": ('phi = "45 deg"', "phi = -inf", "number-infinite"),
    "angle 1e400": ('phi = "45 deg"', 'phi = "1e400 deg"', "number-infinite"),
    "angle 1e400 without quotes": ('phi = "45 deg"', "phi = 1e400", "number-infinite"),
    "angle an array": ('phi = "45 deg"', "phi = [45]", "type-quantity"),
    "angle true": ('phi = "45 deg"', "phi = true", "type-quantity"),
    "angle a date": ('phi = "45 deg"', "phi = 2016-01-01", "type-quantity"),
    "angle of five thousand digits": ('phi = "45 deg"', "phi = " + "9" * 5000, "number-infinite"),
    "length negative": ('l_OA = "30 mm"', 'l_OA = "-30 mm"', "not-positive"),
    "length zero": ('l_OA = "30 mm"', "l_OA = 0", "not-positive"),
    "length huge": ('l_OA = "30 mm"', 'l_OA = "1e200 mm"', "number-infinite"),
    "mass negative": ('m_2 = "1.8 kg"', 'm_2 = "-1.8 kg"', "negative"),
    "inertia negative": ('J_S2 = "0.010 kg*m^2"', 'J_S2 = "-0.010 kg*m^2"', "negative"),
    "rotation of no choice": ('rotation = "cw"', 'rotation = "left"', "choice-unknown"),
    "reconstructed of no given": ('reconstructed = ["J_S2"]', 'reconstructed = ["J_S"]', "given-missing-like"),
    "no equals sign": ('phi = "45 deg"', "phi 45", "toml-bad"),
    "string not closed": ('phi = "45 deg"', 'phi = "45 deg', "toml-bad"),
    "array not closed": ("plans = [", "plans = [[", "toml-bad"),
}
WITHOUT_LINE = {"no structure", "array not closed", "links one table"}  # reported where it shows


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in, which must be left as it was."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Run a command that must be refused, and return its one line."""
    before = sorted(Path.cwd().rglob("*"))

    with pytest.raises(SystemExit) as stopped:
        cli.main(arguments)

    out, err = capsys.readouterr()
    assert stopped.value.code == 2
    assert out == ""
    assert err.endswith("\n")
    assert len(err.splitlines()) == 1, err
    assert "Traceback" not in err
    assert sorted(Path.cwd().rglob("*")) == before
    return err.strip()


@pytest.mark.parametrize("name", FILES)
def test_a_fault_in_a_task_file_is_named_with_its_place(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
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
    line = refusal(["solve", "t.toml"], capsys)
    assert line == str(caught.value)
    assert line.startswith("t.toml:")
    if key not in {"key-missing", "choice-missing"} and name not in WITHOUT_LINE:
        assert first - 1 <= int(line.split(":")[1]) <= last + 1
    assert len(line) < 300


def test_without_a_change_the_file_is_good() -> None:
    assert read_text(GOOD, "t.toml")[1] == ()


BYTES = {
    "empty": (b"", "empty"),
    "blank": (b" \n\n", "empty"),
    "binary": (b"\x7fELF\x02\x01\x01\x00\x00", "bin.toml"),
    "not UTF-8": ("id = 'механізм'".encode("cp1251"), "bin.toml:1: not a text in UTF-8"),
    "zero byte": (b'id = "a"\nsource = "\x00"', "bin.toml:2: not a text file"),
    "UTF-16": ("id = 'x'".encode("utf-16"), "bin.toml:1"),
    "nested arrays": (b"x = " + b"[" * 100_000 + b"]" * 100_000, "nested too deep"),
    "nested arrays not closed": (b"x = " + b"[" * 100_000, "nested too deep"),
    "nested tables": (b"x = " + b"{a=" * 100_000 + b"1" + b"}" * 100_000, "nested too deep"),
    "long dotted key": (b".".join([b"a"] * 400_000) + b" = 1", "nested too deep"),
    "long dotted heading": (b"[" + b" . ".join([b"'a'"] * 100_000) + b"]", "nested too deep"),
    "very many faults": (GOOD.encode() + b"".join(b"k%d = 1\n" % i for i in range(30_000)), "(and 999 more"),
    "only a comment": (b"# nothing", "bin.toml:1:1: the key"),
    "JSON": (b'{"id": "x"}', "bin.toml:1:1: not valid TOML"),
    "one word": (b"kulman", "bin.toml:1:"),
    "escape sequence": (b"x = \x1b[31m", "bin.toml:1:"),
}


@pytest.mark.parametrize("name", BYTES)
def test_a_file_that_is_no_task_is_refused(name: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data, part = BYTES[name]
    Path("bin.toml").write_bytes(data)

    line = refusal(["solve", "bin.toml"], capsys)

    assert part in line
    assert line.isprintable()


def test_a_large_file_is_refused_unread(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with Path("large.toml").open("wb") as file:
        file.truncate(1 << 40)  # no such file fits into memory

    assert "larger than 1 MB" in refusal(["solve", "large.toml"], capsys)


def test_a_file_of_just_under_a_megabyte_is_read(folder: Path) -> None:
    text = GOOD + "#" * (LARGEST_FILE - len(GOOD.encode()) - 1)
    Path("t.toml").write_text(text, encoding="utf-8")

    assert load_task("t.toml").id == "nau-slider-crank"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_what_is_no_regular_file_is_refused_without_waiting_for_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    os.mkfifo("pipe.toml")
    Path("dir.toml").mkdir()

    for name in ("pipe.toml", "dir.toml", "/dev/zero", "."):
        assert "not a folder or a device" in refusal(["solve", name], capsys)


TASK = "nau-slider-crank"
ARGUMENTS = {
    "unknown command": (["slove", TASK], "did you mean solve?"),
    "unknown option": (["solve", TASK, "--varient", "3"], "--variant"),
    "no task": (["solve"], "TASK"),
    "no output": (["sheet", TASK], "-o is missing"),
    "option without its value": (["solve", TASK, "-v"], "-v"),
    "too many arguments": (["solve", TASK, "3"], "unexpected '3'"),
    "unknown task": (["solve", "nau-slider"], "did you mean nau-slider-crank?"),
    "unknown task far off": (["solve", "zzz"], "nau-slider-crank"),
    "task empty": (["solve", ""], "nau-slider-crank"),
    "missing file": (["solve", "none.toml"], "none.toml: there is no such file"),
    "missing folder": (["solve", "none/none.toml"], "no such file"),
    "file with a zero byte": (["solve", "a\0.toml"], "no such file"),
    "file with a long name": (["solve", "a" * 5000 + ".toml"], "no such file"),
    "unknown variant": (["solve", TASK, "-v", "11"], "no variant '11'"),
    "variant of two lines": (["solve", TASK, "-v", "1\n2"], "no variant"),
    "unknown given": (["solve", TASK, "--set", "l_0A=5"], "did you mean 'l_OA'?"),
    "set without a value": (["solve", TASK, "--set", "l_OA"], "NAME=VALUE"),
    "set to nothing": (["solve", TASK, "--set", "l_OA="], "NAME=VALUE"),
    "set twice": (["solve", TASK, "--set", "l_OA=5", "--set", "l_OA=6"], "twice"),
    "set to another kind": (["solve", TASK, "--set", "l_OA=5 kg"], "l_OA: the unit kg"),
    "set to an unknown unit": (["solve", TASK, "--set", "l_OA=5 дюймів"], "l_OA: unknown unit"),
    "set to zero": (["solve", TASK, "--set", "l_OA=0"], "l_OA: '0': must be greater than zero"),
    "set below zero": (["solve", TASK, "--set", "m_2=-1"], "m_2: '-1': must not be negative"),
    "set to nan": (["solve", TASK, "--set", "phi=nan"], "phi: 'nan' is not a number"),
    "set to inf": (["solve", TASK, "--set", "phi=inf"], "phi: 'inf' is not a number"),
    "set too large": (["solve", TASK, "--set", "phi=1e400"], "too large"),
    "set to no choice": (["solve", TASK, "--set", "side=top"], "left, right"),
    "unknown plan": (["solve", TASK, "--only", "velosity"], "did you mean 'velocity'?"),
    "one unknown plan of two": (["solve", TASK, "--only", "velocity,zzz"], "unknown plan 'zzz'"),
    "no plan": (["solve", TASK, "--only", ""], "unknown plan ''"),
    "unknown language": (["solve", TASK, "--lang", "de"], "--lang: 'de'"),
    "unknown notation": (["solve", TASK, "--notation", "zzz"], "unknown notation 'zzz'"),
    "scale without a value": (["solve", TASK, "--scale", "mu_V"], "NAME=VALUE"),
    "scale by a segment of no plan": (["solve", TASK, "--scale", "pz=80"], "pz: 'pz' is not a segment"),
    "scale twice": (["solve", TASK, "--scale", "pa=80", "--scale", "pa=70"], "twice"),
    "unknown format": (["sheet", TASK, "-o", "x.svg", "--format", "A9"], "--format: 'A9'"),
    "unknown norm": (["sheet", TASK, "-o", "x.svg", "--norm", "din"], "--norm: 'din'"),
    "unknown tile": (["sheet", TASK, "-o", "x.svg", "--tile", "B5"], "--tile: 'B5'"),
    "unknown suffix": (["sheet", TASK, "-o", "x.doc"], ".svg"),
    "no suffix": (["sheet", TASK, "-o", "x"], ".svg"),
    "one suffix of two unknown": (["sheet", TASK, "-o", "x.svg", "-o", "x.xyz"], "x.xyz"),
    "output folder missing": (["sheet", TASK, "-o", "none/x.svg"], "no folder 'none'"),
    "output folder a file": (["sheet", TASK, "-o", "file.txt/x.svg"], "no folder 'file.txt'"),
    "output is a folder": (["sheet", TASK, "-o", "dir.svg"], "this is a folder"),
    "output twice": (["sheet", TASK, "-o", "x.svg", "-o", "x.svg"], "twice"),
    "output twice under two names": (["sheet", TASK, "-o", "x.svg", "-o", "./x.svg"], "twice"),
    "tiles of no PDF": (["sheet", TASK, "--tile", "A4", "-o", "x.pdf", "-o", "x.svg"], "x.svg: only a PDF"),
    "output with a zero byte": (["sheet", TASK, "-o", "a\0.svg"], "no file can have this name"),
    "output empty": (["sheet", TASK, "-o", ""], ".svg"),
    "sheet of an unknown variant": (["sheet", TASK, "-v", "zz", "-o", "x.svg"], "no variant 'zz'"),
    "sheet of a bad value": (["sheet", TASK, "--set", "l_OA=-1", "-o", "x.svg"], "greater than zero"),
    "check of a missing file": (["list", "--check", "none.toml"], "no such file"),
    "check without a file": (["list", "--check"], "--check"),
}


@pytest.mark.parametrize("name", ARGUMENTS)
def test_a_command_that_cannot_be_carried_out_is_refused(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments, part = ARGUMENTS[name]
    Path("file.txt").touch()
    Path("dir.svg").mkdir()

    line = refusal(arguments, capsys)

    assert part in line
    assert len(line) < 400


@pytest.mark.parametrize("language", LANGUAGES)
def test_messages_follow_the_language_of_the_system(
    language: str, folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", f"{language}_XX.UTF-8")

    line = refusal(["solve", TASK, "-v", "zz"], capsys)

    known = ", ".join((*"0123456789", "example"))
    assert line == messages(language)["variant-unknown"].format(task=TASK, text="zz", known=known)


def test_every_message_is_in_every_language_with_the_same_data() -> None:
    def fields(template: str) -> set[str]:
        return {name for _, name, _, _ in string.Formatter().parse(template) if name}

    keys = {language: messages(language).keys() for language in LANGUAGES}
    assert keys["uk"] == keys["ru"] == keys["en"]
    for key in keys["en"]:
        templates = [messages(language)[key] for language in LANGUAGES]
        assert len({frozenset(fields(template)) for template in templates}) == 1, key
        assert all("\n" not in template and template.strip() == template for template in templates), key
        if key.split("-")[0] != "list":
            assert len(set(templates)) == 3, f"{key} is not translated"


def raised_keys() -> set[str]:
    """Return the keys of all messages that the package's code names."""
    keys = set()
    for tree in trees().values():
        for node in ast.walk(tree):
            name = getattr(node.func, "id", "") if isinstance(node, ast.Call) else ""
            if name in {"KulmanError", "InputError", "PositionError", "unknown"}:
                first = node.args[0] if isinstance(node, ast.Call) else None
                if isinstance(first, ast.Constant) and isinstance(first.value, str):
                    keys |= {first.value, f"{first.value}-like"} if name == "unknown" else {first.value}
    return keys - {"link-unknown-like"}  # numbers have no likeness


def test_every_error_has_its_message() -> None:
    assert raised_keys() <= messages("en").keys()


def test_a_message_stays_one_line_whatever_it_quotes() -> None:
    error = KulmanError("number-bad", text="a\nb\r\n\u2028c {0} {x}")

    assert len(error.text().splitlines()) == 1


@settings(suppress_health_check=[HealthCheck.too_slow], max_examples=60)
@given(st.binary(max_size=300) | st.text(max_size=300).map(str.encode))
def test_any_bytes_are_refused_in_one_line(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    file = tmp_path_factory.getbasetemp() / "any.toml"
    file.write_bytes(data)

    with pytest.raises(InputError) as caught:
        load_task(file)

    assert caught.value.text("uk").isprintable()


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_a_good_file_with_a_piece_cut_out_never_crashes(data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(GOOD)))
    end = data.draw(st.integers(start, min(len(GOOD), start + 200)))

    instead = data.draw(st.sampled_from(("", "0", '"', "\n", "[", "{}")))

    task, faults = read_text(GOOD[:start] + instead + GOOD[end:], "t.toml")

    assert (task is None) == bool(faults)
    assert all(fault.text("ru").isprintable() for fault in faults)
