"""The commands as a user types them: help with examples that run, JSON, languages, consoles, statuses."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from kulman import __version__, cli
from kulman.scales.errors import LANGUAGES
from kulman.variants.shelf import bundled, bundled_text

TASK = "nau-slider-crank"
EXAMPLE = ["-v", "example"]


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


def run(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    """Run a command in this process: its status, standard output and standard error."""
    with pytest.raises(SystemExit) as stopped:
        cli.main(arguments)
    assert isinstance(stopped.value.code, int)
    return stopped.value.code, *capsys.readouterr()


def shell(arguments: list[str], folder: Path, **environment: str) -> subprocess.CompletedProcess[bytes]:
    """Run a command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "kulman", *arguments],
        cwd=folder,
        capture_output=True,
        timeout=60,
        env={**os.environ, **environment},
        check=False,
    )


def examples(*command: str) -> list[list[str]]:
    """Return the commands that a help text shows."""
    text = CliRunner().invoke(cli.commands, [*command, "--help"]).output
    shown = text.partition("Example:")[2]
    return [shlex.split(line)[1:] for line in shown.splitlines() if line.strip().startswith("kulman ")]


LONG = ("chart", "sweep")  # whose first example runs by default, all in the soak


@pytest.mark.parametrize(
    ("command", "count"),
    [
        *(pytest.param(name, 1 if name in LONG else None, id=name) for name in ("", *cli.commands.commands)),
        *(pytest.param(name, None, id=f"{name}-all", marks=pytest.mark.soak) for name in LONG),
    ],
)
def test_the_help_of_every_command_shows_examples_that_run(
    command: str,
    count: int | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    shown = examples(*command.split())

    assert shown
    for arguments in shown[:count]:
        assert not command or arguments[0] == command
        status, out, err = run(arguments, capsys)
        assert status == 0
        assert all("kulman solve --format" in line for line in err.splitlines())  # other scale factors on small paper
        assert out


def test_without_a_command_the_help_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run([], capsys)

    assert (status, err) == (0, "")
    assert all(name in out for name in cli.commands.commands)


def test_the_version_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--version"], capsys) == (0, f"{__version__}\n", "")


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_list_names_every_task_with_its_variants_and_plans(
    language: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", f"{language}.UTF-8")

    status, out, err = run(["list"], capsys)

    assert (status, err) == (0, "")
    assert all(task in out for task in bundled())
    assert ", ".join((*"0123456789", "example")) in out
    assert {"uk": "варіанти", "ru": "варианты", "en": "variants"}[language] in out


def test_the_list_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(["list", "--json"], capsys)

    tasks = {task["id"]: task for task in json.loads(out)["tasks"]}
    assert status == 0
    assert out.isascii()
    assert set(tasks) == set(bundled())
    assert tasks[TASK]["variants"] == [*"0123456789", "example"]
    assert tasks[TASK]["plans"][:2] == ["structure", "position"]
    assert tasks[TASK]["givens"]["l_OA"] == "mm"
    assert tasks[TASK]["givens"]["side"] == ["left", "right"]


def test_a_check_shows_every_fault_of_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "t.toml"
    file.write_text(bundled_text(TASK).replace('l_OA = "30 mm"', 'l_OA = "0 mm"').replace('"45 deg"', '"45 kg"'))

    status, out, err = run(["list", "--check", str(file)], capsys)
    parsed = run(["list", "--check", str(file), "--json"], capsys)

    assert status == parsed[0] == 2
    assert [line.split(": ")[1] for line in out.splitlines()] == ["variant.phi", "variant.l_OA"]
    assert err == parsed[2] == f"{file}: faults found: 2\n"
    data = json.loads(parsed[1])
    assert not data["ok"]
    assert [fault["message"] for fault in data["errors"]] == out.splitlines()


def test_check_takes_a_bundled_task(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "--check", "madi-gear"], capsys) == (0, "madi-gear: no faults\n", "")


def test_a_check_of_a_good_file_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "t.toml"
    file.write_text(bundled_text(TASK), encoding="utf-8")

    assert run(["list", "--check", str(file)], capsys) == (0, f"{file}: no faults\n", "")

    assert json.loads(run(["list", "--check", str(file), "--json"], capsys)[1]) == {
        "file": str(file),
        "ok": True,
        "errors": [],
        "remarks": [],
    }


def test_json_is_one_ascii_object_with_full_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["solve", TASK, *EXAMPLE, "--json", "--lang", "uk"], capsys)

    data = json.loads(out)
    assert (status, err) == (0, "")
    assert out.isascii()
    assert (data["task"], data["variant"], data["status"]) == (TASK, "example", "ok")
    assert data["quantities"]["V_A"]["value"] == pytest.approx(765 * 3.141592653589793 / 30 * 0.05, rel=1e-15)
    assert data["quantities"]["V_A"]["mm"] == pytest.approx(80, rel=1e-2)


def test_the_table_is_in_the_language_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert "м/с" in run(["solve", TASK, "--lang", "uk"], capsys)[1]
    assert "m/s" in run(["solve", TASK, "--lang", "en"], capsys)[1]
    assert "m/s" in run(["solve", TASK], capsys)[1]


def test_settings_are_taken_in_any_unit(capsys: pytest.CaptureFixture[str]) -> None:
    plain = run(["solve", TASK, "--set", "l_OA=55.5", "--set", "n_1=765", "--set", "F_3=2", "--json"], capsys)
    units = ["l_OA=55,5 мм", "n_1=765 об/хв", "F_3=2 кН"]
    other = run(["solve", TASK, *(x for unit in units for x in ("--set", unit)), "--json"], capsys)

    assert plain == other
    assert plain[0] == 0


def test_only_the_plans_asked_for_are_built(capsys: pytest.CaptureFixture[str]) -> None:
    quantities = json.loads(run(["solve", TASK, "--only", "velocity", "--json"], capsys)[1])["quantities"]

    assert "V_B" in quantities
    assert "a_B" not in quantities
    assert "R_12" not in quantities


def test_a_segment_or_a_factor_chooses_a_scale(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["solve", TASK, *EXAMPLE, "--json", "--scale", "pa=40", "--scale", "mu_a=5"]

    data = json.loads(run(arguments, capsys)[1])

    assert data["scales"]["mu_V"]["value"] == pytest.approx(4.0055306 / 40, rel=5e-3)
    assert data["scales"]["mu_a"]["value"] == 5


@pytest.mark.parametrize(
    ("settings", "status_word"),
    [(["--set", "l_AB=20"], "no-assembly"), (["--set", "phi=90", "--set", "l_AB=50"], "singular")],
)
def test_a_position_without_a_plan_says_why(
    settings: list[str],
    status_word: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)

    solved = run(["solve", TASK, *EXAMPLE, *settings], capsys)
    parsed = run(["solve", TASK, *EXAMPLE, *settings, "--json"], capsys)
    drawn = run(["sheet", TASK, *EXAMPLE, *settings, "-o", "x.svg", "-o", "x.pdf"], capsys)

    assert solved[0] == parsed[0] == drawn[0] == 3
    assert solved[1] == drawn[1] == ""
    assert solved[2] == parsed[2] == drawn[2]
    assert len(solved[2].splitlines()) == 1
    data = json.loads(parsed[1])
    assert data["status"] == status_word
    assert data["quantities"]["l_OA"]["value"] == 0.05
    assert list(tmp_path.iterdir()) == []


def test_a_sheet_is_written_in_every_format_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = [tmp_path / "аркуш 1.svg", tmp_path / "SHEET.PDF"]

    status, out, err = run(["sheet", TASK, *(x for file in files for x in ("-o", str(file)))], capsys)

    assert (status, err) == (0, "")
    assert out.splitlines() == [str(file) for file in files]
    assert files[0].read_bytes().startswith(b"<?xml")
    assert files[1].read_bytes().startswith(b"%PDF")
    assert sorted(tmp_path.iterdir()) == sorted(files)


def test_every_word_for_the_title_block_reaches_the_sheet(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = {"student": "Зозуля Є.", "group": "АР-207", "teacher": "Ґудзь Ї.", "date": "01.02.26"}
    file = tmp_path / "x.svg"

    status, _, _ = run(["sheet", TASK, "-o", str(file), *(x for k, v in words.items() for x in (f"--{k}", v))], capsys)

    text = re.sub(r"\s+", " ", file.read_text(encoding="utf-8"))
    assert status == 0
    assert all(word in text for word in words.values())


def test_a_task_file_is_solved_like_the_bundled_task(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "свій.toml"
    file.write_text(bundled_text(TASK), encoding="utf-8")

    own = json.loads(run(["solve", str(file), "-v", "5", "--json"], capsys)[1])
    ours = json.loads(run(["solve", TASK, "-v", "5", "--json"], capsys)[1])

    assert own["quantities"] == ours["quantities"]


def test_a_file_that_cannot_be_written_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)

    status, out, err = run(["sheet", TASK, "-o", str(tmp_path / "x.svg")], capsys)

    assert (status, out) == (2, "")
    assert "x.svg: cannot be written" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("environment", "language"),
    [
        ({"LC_ALL": "uk_UA.UTF-8"}, "uk"),
        ({"LC_ALL": "", "LC_MESSAGES": "ru_UA.UTF-8", "LANG": "uk_UA.UTF-8"}, "ru"),
        ({"LC_ALL": "", "LC_MESSAGES": "", "LANG": "uk"}, "uk"),
        ({"LC_ALL": "C", "LANG": "uk_UA"}, "en"),
        ({"LC_ALL": "de_DE.UTF-8"}, "en"),
        ({"LC_ALL": "", "LC_MESSAGES": "", "LANG": ""}, "en"),
    ],
)
def test_the_language_of_messages_is_that_of_the_system(
    environment: dict[str, str], language: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    if sys.platform == "win32" and not any(environment.values()):
        pytest.skip("Windows has a language of its own")

    assert cli.system_language() == language


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--lang", "uk", "solve", TASK, "-v", "щось"], "не має варіанта"),
        (["solve", TASK, "-v", "щось", "--lang=ru"], "нет варианта"),
        (["solve", "--lang", "uk", TASK, "--nothing"], "невідомий параметр"),
        (["list", "--lang", "uk", "--check", "no.toml"], "немає"),
        (["--lang", "ru", "list", "--lang", "uk"], "варіанти"),
        (["--lang", "uk", "solve", TASK, "--only", "position"], "0,025"),
        (["--lang", "uk", "chart", "scheme-11-slotter", "--scale", "OA=0.0015", "--chart", "stability"], " 73,3 "),
    ],
)
def test_the_language_of_messages_stands_anywhere(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    _, out, err = run(words, capsys)

    assert said in out + err
    assert cli.system_language() == "en"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["solve", "madi-gear", "--set", "alpha=5.5 deg"], "5,5"),
        (["solve", TASK, "-v", "1.5"], "«1.5»"),
        (["solve", TASK, "--scale", "mu_V=-0.5"], "-0.5"),
        (["sheet", TASK, "-o", "for 7.5 points/x.svg"], "for 7.5 points"),
        (["new", "for 7.5 points/x.toml"], "for 7.5 points"),
    ],
)
def test_numbers_of_messages_have_commas_but_those_that_are_quoted(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    for language in ("uk", "ru"):
        _, _, err = run(["--lang", language, *words], capsys)

        assert said in err
        assert said.translate(str.maketrans(".,", ",.")) not in err


@pytest.mark.parametrize(
    ("language", "status", "said"),
    [("uk", 2, "не має варіанта"), (" UK", 2, "не має варіанта"), ("xx", 2, "KULMAN_LANG: 'xx' is unknown")],
)
def test_the_language_stands_in_the_environment(
    language: str, status: int, said: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KULMAN_LANG", language)

    found, _, err = run(["solve", TASK, "-v", "щось"], capsys)

    assert found == status
    assert said in err


def test_documents_have_the_language_before_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    note = tmp_path / "note.md"

    run(["--lang", "ru", "note", TASK, "-o", str(note)], capsys)

    assert "Пояснительная записка" in note.read_text(encoding="utf-8")


@pytest.mark.parametrize("encoding", ["cp1251", "cp866", "ascii"])
def test_output_is_utf8_on_every_console(encoding: str, tmp_path: Path) -> None:
    done = shell(["solve", TASK, "--lang", "uk"], tmp_path, PYTHONIOENCODING=encoding, LC_ALL="uk_UA")
    refused = shell(["solve", TASK, "-v", "щось"], tmp_path, PYTHONIOENCODING=encoding, LC_ALL="uk_UA")

    assert "м/с²" in done.stdout.decode("utf-8")
    assert "немає" in refused.stderr.decode("utf-8") or "варіанта" in refused.stderr.decode("utf-8")
    assert refused.returncode == 2


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of another kind")
def test_a_closed_pipe_is_quiet(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)

    done = subprocess.run(
        [sys.executable, "-m", "kulman", "solve", TASK, "--json"], stdout=writing, stderr=subprocess.PIPE, check=False
    )
    os.close(writing)

    assert done.stderr == b""
    assert done.returncode == 1


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a disk that is always full")
@pytest.mark.parametrize("arguments", [["list"], ["list", "--json"], ["solve", TASK], ["--help"]])
def test_a_full_disk_is_one_line(arguments: list[str]) -> None:
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "kulman", *arguments], stdout=full, stderr=subprocess.PIPE, check=False
        )

    assert done.returncode == 2
    assert done.stderr.decode() == f"the output cannot be written ({os.strerror(28)})\n"


@pytest.mark.skipif(sys.platform == "win32", reason="a shell's way to close a stream")
@pytest.mark.parametrize(
    ("redirection", "task", "status"), [(">&-", TASK, 0), ("2>&-", "zzz", 2), ("2>/dev/full", "zzz", 2)]
)
def test_a_stream_that_nobody_reads_changes_no_status(redirection: str, task: str, status: int) -> None:
    if "/dev/full" in redirection and not os.path.exists("/dev/full"):
        pytest.skip("needs a disk that is always full")

    done = subprocess.run(
        ["/bin/sh", "-c", f'exec "$0" -m kulman solve {task} {redirection}', sys.executable],
        capture_output=True,
        check=False,
    )

    assert (done.returncode, done.stderr) == (status, b"")


def test_an_interrupt_is_quiet(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("kulman.variants.solution.solve", interrupt)

    status, out, err = run(["solve", TASK], capsys)

    assert (status, out, err.strip()) == (130, "", "")


def test_a_fault_of_the_program_itself_is_not_hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("kulman.variants.solution.solve", fail)

    with pytest.raises(ZeroDivisionError):
        cli.main(["solve", TASK])


def test_the_list_loads_nothing_heavy(tmp_path: Path) -> None:
    code = "import sys; sys.argv = ['kulman', 'list']\nimport atexit, kulman.cli\n"
    code += "atexit.register(lambda: print(*sorted(sys.modules), file=sys.stderr))\nkulman.cli.main()"

    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)

    loaded = set(done.stderr.split())
    assert not loaded & {"numpy", "msgspec", "shapely", "matplotlib", "reportlab", "svgwrite", "fontTools"}
    assert not loaded & {"kulman.plans", "kulman.drawing", "kulman.variants.reader"}


@pytest.mark.parametrize(("language", "said"), [("uk", "відносно B"), ("ru", "относительно B"), ("en", "about B")])
def test_the_moment_of_a_guide_says_about_which_point_it_is(
    language: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    table = run(["solve", TASK, "--lang", language], capsys)[1]
    found = json.loads(run(["solve", TASK, "--json"], capsys)[1])["quantities"]

    assert next(line for line in table.splitlines() if line.startswith("M_03 ")).endswith(said)
    assert {name: item["about"] for name, item in found.items() if "about" in item} == {"M_03": "B"}
