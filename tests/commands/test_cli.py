"""The commands as a user types them: help with examples that run, JSON, languages, consoles, statuses, checks."""

from __future__ import annotations

import json
import math
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from kulman import KulmanError, __version__, cli, sheet
from kulman.drawing.formats import FORMATS
from kulman.scales import choices
from kulman.scales.errors import LANGUAGES, messages
from kulman.tests.commands.test_languages import CYRILLIC, FOREIGN
from kulman.tests.support.commands import Run
from kulman.variants.case import kind_of
from kulman.variants.kinds import MODULES
from kulman.variants.making.new_variants import _with_variants
from kulman.variants.making.starter import _template
from kulman.variants.reader import check_text
from kulman.variants.serving.app import _listening
from kulman.variants.shelf import bundled, bundled_text
from kulman.variants.solution import Solution, solve

TASK = "nau-slider-crank"
EXAMPLE = ["-v", "example"]


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
    shown = [shlex.split(line) for line in text.partition("Example:")[2].splitlines() if line.strip()]
    assert {words[0] for words in shown} == {"kulman"}
    return [words[1:] for words in shown]


# of what takes long one example runs by default or none, all in the soak
LONG = {"batch": slice(1), "handout": slice(1), "note": slice(1, 2), "sheet": slice(1), "sweep": slice(1)}
LONGEST = ("chart", "page", "variants")


@pytest.mark.parametrize(
    ("command", "which"),
    [
        *((name, LONG.get(name, slice(None))) for name in ("", *cli.commands.commands) if name not in LONGEST),
        *(pytest.param(name, slice(None), marks=pytest.mark.soak) for name in (*LONG, *LONGEST)),
    ],
)
def test_the_help_of_every_command_shows_examples_that_run(
    command: str, which: slice, folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = examples(*command.split())
    monkeypatch.setattr("uvicorn.Server.run", lambda server, sockets: None)  # which ends only when somebody ends it
    monkeypatch.setattr("webbrowser.open", lambda address: True)
    Path("passwords.txt").write_text("teacher: long enough\n")

    assert shown
    for arguments in shown[which]:
        assert not command or arguments[0] == command
        status, out, err = run(*arguments)
        assert status == 0
        # other scale factors, the language of a table
        assert all(re.search("`kulman solve .*--format A|`--lang ", line) for line in err.splitlines())
        assert out


def test_nobody_else_is_let_in_without_passwords(run: Run) -> None:
    with _listening("127.0.0.1", 0) as taken:
        port = str(taken.getsockname()[1])

        assert run("serve", "--host", "0.0.0.0")[:2] == (2, "")
        assert "--password-file" in run("serve", "--name", "plans.example.edu")[2]
        assert "--password-file" in run("serve", "--students", "sheets")[2]
        assert "taken" in run("serve", "--port", port, "--lang", "en")[2]


def test_without_a_command_the_help_is_shown_and_the_version_where_it_is_asked_for(run: Run) -> None:
    status, out, err = run()

    assert (status, err) == (0, "")
    assert all(name in out for name in cli.commands.commands)
    assert run("--version") == (0, f"{__version__}\n", "")


@pytest.mark.parametrize(
    ("words", "tasks"),
    [
        pytest.param(["shaper", "slotted"], ["scheme-09-shaper"], id="of the name and of the title"),
        pytest.param(["Поперечно-стругальний", "верстат"], ["scheme-09-shaper"], id="Ukrainian, as one names it"),
        pytest.param(["щёковая", "дробилка"], ["scheme-14-jaw-crusher"], id="Russian, as one names it"),
        pytest.param(["nau slider"], ["nau-slider-crank"], id="in one argument"),
    ],
)
def test_a_list_of_words_has_the_tasks_that_are_called_so_in_any_language(
    words: list[str], tasks: list[str], run: Run
) -> None:
    for lang in LANGUAGES:
        out = run("list", *words, "--lang", lang)[1]
        listed = json.loads(run("list", *words, "--json", "--lang", lang)[1])["tasks"]

        assert [task["id"] for task in listed] == tasks == [x.split()[0] for x in out.splitlines() if x[:1] != " "]


def test_words_of_no_task_are_refused(run: Run) -> None:
    status, out, err = run("list", "lathe", "--lang", "en")

    assert (status, out) == (2, "")
    assert err.startswith("there is no bundled task 'lathe'; there are: ")


def test_a_check_shows_every_fault_of_a_file(folder: Path, run: Run) -> None:
    text = bundled_text(TASK).replace('l_OA = "30 mm"', 'l_OA = "0 mm"').replace('"45 deg"', '"45 kg"')
    Path("bad.toml").write_text(text, encoding="utf-8")
    Path("good.toml").write_text(bundled_text(TASK), encoding="utf-8")

    status, out, err = run("list", "--check", "bad.toml")
    parsed = run("list", "--check", "bad.toml", "--json")

    assert (status, err) == (parsed[0], parsed[2]) == (2, "bad.toml: faults found: 2\n")
    assert [line.split(": ")[1] for line in out.splitlines()] == ["variant.phi", "variant.l_OA"]
    data = json.loads(parsed[1])
    assert not data["ok"]
    assert [fault["message"] for fault in data["errors"]] == out.splitlines()
    assert run("list", "--check", "good.toml") == (0, "good.toml: no faults\n", "")
    assert run("list", "--check", "madi-gear") == (0, "madi-gear: no faults\n", "")
    good = json.loads(run("list", "--check", "good.toml", "--json")[1])
    assert good == {"file": "good.toml", "ok": True, "errors": [], "remarks": []}

    several = "list", "--check", "bad.toml", "none.toml", "good.toml"
    status, both, err = run(*several)
    assert (status, both) == (2, out + "good.toml: no faults\n")
    assert [line.partition(": ")[0] for line in err.splitlines()] == ["bad.toml", "none.toml"]
    assert json.loads(run(*several, "--json")[1]) == {"files": [data, good]}


def test_plans_and_scale_factors_are_those_asked_for(run: Run) -> None:
    scales = ("--scale", "pa=40", "--scale", "mu_a=5")

    velocity = json.loads(run("solve", TASK, "--only", "velocity", "--json")[1])["quantities"]
    whole = json.loads(run("solve", TASK, *EXAMPLE, "--json", *scales)[1])

    assert "V_B" in velocity
    assert not {"a_B", "R_12"} & {*velocity}
    assert whole["scales"]["mu_V"]["value"] == pytest.approx(4.0055306 / 40, rel=5e-3)
    assert whole["scales"]["mu_a"]["value"] == 5
    assert {name: item["about"] for name, item in whole["quantities"].items() if "about" in item} == {"M_03": "B"}


@pytest.mark.parametrize(
    ("settings", "word"),
    [(["--set", "l_AB=20"], "no-assembly"), (["--set", "phi=90", "--set", "l_AB=50"], "singular")],
)
def test_a_position_without_a_plan_says_why(settings: list[str], word: str, folder: Path, run: Run) -> None:
    solved = run("solve", TASK, *EXAMPLE, *settings)
    status, parsed, err = run("solve", TASK, *EXAMPLE, *settings, "--json")
    drawn = run("sheet", TASK, *EXAMPLE, *settings, "-o", "x.svg", "-o", "x.pdf")

    assert solved == drawn == (3, "", err)
    assert (status, err.count("\n")) == (3, 1)
    assert json.loads(parsed)["status"] == word
    assert json.loads(parsed)["quantities"]["l_OA"]["value"] == 0.05
    assert list(folder.iterdir()) == []


def test_a_sheet_is_written_in_every_format_with_every_word_of_its_title_block(folder: Path, run: Run) -> None:
    words = {"student": "Зозуля Є.", "group": "АР-207", "teacher": "Ґудзь Ї.", "date": "01.02.26"}
    files = ["аркуш 1.svg", "SHEET.PDF"]
    options = [x for file in files for x in ("-o", file)] + [x for k, v in words.items() for x in (f"--{k}", v)]

    status, out, err = run("sheet", TASK, *options)

    assert (status, err) == (0, "")
    assert out.splitlines() == files
    text = re.sub(r"\s+", " ", Path(files[0]).read_text(encoding="utf-8"))
    assert text.startswith("<?xml")
    assert all(word in text for word in words.values())
    assert Path(files[1]).read_bytes().startswith(b"%PDF")
    assert sorted(path.name for path in folder.iterdir()) == sorted(files)


def test_a_file_that_cannot_be_written_is_one_line(folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)

    status, out, err = run("sheet", TASK, "-o", "x.svg")

    assert (status, out) == (2, "")
    assert "x.svg: cannot be written" in err
    assert list(folder.iterdir()) == []


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
        (["solve", TASK, "--lang", "uk"], "відносно B"),
        (["solve", TASK, "--lang", "ru"], "относительно B"),
        (["--lang", "uk", "chart", "scheme-11-slotter", "--scale", "OA=0.0015", "--chart", "stability"], " 73,3 "),
    ],
)
def test_the_language_of_messages_stands_anywhere(words: list[str], said: str, run: Run) -> None:
    _, out, err = run(*words)

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
def test_numbers_of_messages_have_commas_but_those_that_are_quoted(words: list[str], said: str, run: Run) -> None:
    for language in ("uk", "ru"):
        _, _, err = run("--lang", language, *words)

        assert said in err
        assert said.translate(str.maketrans(".,", ",.")) not in err


@pytest.mark.parametrize(
    ("language", "status", "said"),
    [("uk", 2, "не має варіанта"), (" UK", 2, "не має варіанта"), ("xx", 2, "KULMAN_LANG: 'xx' is unknown")],
)
def test_the_language_stands_in_the_environment(
    language: str, status: int, said: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KULMAN_LANG", language)

    found, _, err = run("solve", TASK, "-v", "щось")

    assert found == status
    assert said in err


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        (("8", "-v", "7"), ("scheme-08-planer", "-v", "7")),
        ((TASK, "--set", "φ=30", "--set", "lAB=140"), (TASK, "--set", "phi=30", "--set", "l_AB=140")),
        (
            (TASK, "--scale", "mu_l=1:2,5", "--scale", "μV=0.1"),
            (TASK, "--scale", "mu_l=0.0025", "--scale", "mu_V=0.1"),
        ),
    ],
    ids=["number of a scheme", "givens", "scale factors"],
)
def test_tasks_givens_and_scale_factors_are_named_as_in_rosters_and_forms(
    said: tuple[str, ...], meant: tuple[str, ...], run: Run
) -> None:
    status, out, err = run("solve", *meant, "--only", "velocity")

    assert status == 0
    assert run("solve", *said, "--only", "velocity") == (status, out, err)


def test_formats_are_those_of_one_list(run: Run, folder: Path) -> None:
    assert tuple(FORMATS) == choices.FORMATS
    with pytest.raises(KulmanError) as refused:
        sheet(TASK, format="A7")
    _, _, err = run("sheet", TASK, "--format", "A7", "-o", "x.svg")
    listed = "expected one of: A4, A3, A3-portrait, A2, A1"
    assert listed in str(refused.value)
    assert listed in err
    assert run("sheet", TASK, "--only", "position", "--format", "a3-portrait", "-o", "x.svg")[0] == 0


def test_charts_are_named_as_help_explains_them(run: Run) -> None:
    chart = "chart", "scheme-11-slotter", "--positions", "4", "--chart"

    shown = run(*chart, "stability,depth")

    assert shown[0] == 0
    for names in ("стійкість,глибина", "Устойчивость, глубина модели"):
        assert run(*chart, names) == shown
    assert "unknown chart 'ширина'; known are: accuracy" in run(*chart, "ширина")[2]


def test_who_names_no_variant_is_told_which_one_is_shown(run: Run) -> None:
    assert run("solve", TASK)[2] == "this is variant 0 of 11; `-v` chooses another one\n"
    assert run("solve", TASK, "-v", "0")[2] == run("solve", TASK, "--json")[2] == ""


TABLES = (
    ("solve", TASK, "-o", "x.csv"),
    ("sweep", TASK, "-o", "x.svg", "-o", "x.CSV"),
    ("variants", TASK, "-o", "x.xlsx"),
    ("chart", TASK, "--chart", "stability", "-o", "x.html"),
)


@pytest.mark.parametrize("words", TABLES, ids=lambda words: words[0])
def test_of_tables_in_another_language_than_messages_it_is_told_which_and_how_to_choose(
    words: tuple[str, ...], run: Run, monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    status, _, err = run(*words)
    assert status == 0
    assert f"{words[-1]}: decimal signs, units and words are Ukrainian" in err
    assert "--lang en" in err

    for language in LANGUAGES:
        assert "--lang" not in run(*words, "--lang", language)[2]
    assert "--lang" not in run(*words[:2], "-o", "x.json")[2]
    monkeypatch.setenv("KULMAN_LANG", "en")
    assert "--lang" not in run(*words)[2]
    monkeypatch.delenv("KULMAN_LANG")
    monkeypatch.setenv("LC_ALL", "uk_UA.UTF-8")
    assert "--lang" not in run(*words)[2]


def test_output_is_utf8_on_every_console(tmp_path: Path) -> None:
    done = shell(["list"], tmp_path, PYTHONIOENCODING="ascii", LC_ALL="uk_UA")
    refused = shell(["solve", TASK, "-v", "щось"], tmp_path, PYTHONIOENCODING="cp1251", LC_ALL="uk_UA")

    assert "варіанти" in done.stdout.decode("utf-8")
    assert "варіанта" in refused.stderr.decode("utf-8")
    assert (done.returncode, refused.returncode) == (0, 2)


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of another kind")
def test_a_closed_pipe_is_quiet(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)

    command = [sys.executable, "-m", "kulman", "list", "--json"]
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, check=False)
    os.close(writing)

    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a disk that is always full")
@pytest.mark.parametrize("arguments", [["list"], ["--help"]])
def test_a_full_disk_is_one_line(arguments: list[str]) -> None:
    command = [sys.executable, "-m", "kulman", *arguments]
    with open("/dev/full", "wb") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, check=False)

    assert done.returncode == 2
    assert done.stderr.decode() == f"the output cannot be written ({os.strerror(28)})\n"


@pytest.mark.skipif(sys.platform == "win32", reason="a shell's way to close a stream")
@pytest.mark.parametrize(
    ("redirection", "task", "status"), [(">&-", f"{TASK} -v 3", 0), ("2>&-", "zzz", 2), ("2>/dev/full", "zzz", 2)]
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


def test_what_a_class_is_told_of_is_in_the_language_of_the_console_where_files_are_in_another(
    folder: Path, run: Run
) -> None:
    Path("works").mkdir()
    Path("works/a.csv").write_text("student,Koval\ntask,madi-cam\nvariant,3\nquantity,value\nV_B,5.62\nV_A,5 kg\n")
    Path("works/b.xlsx").write_text("junk")

    for more in (["--out", "reports"], ["--out", "reports"], ["-o", "marks.csv"]):
        status, out, _ = run("check", TASK, "works", *more)
        assert status == 0
        assert not re.search("[а-яі]", out), out
        assert "not read: works/b.xlsx" in out
    assert re.search("не прочитано: works/b.xlsx", Path("marks.csv").read_text(encoding="utf-8-sig"))


def test_an_interrupt_is_quiet_and_a_fault_of_the_program_itself_is_not_hidden(
    monkeypatch: pytest.MonkeyPatch, run: Run
) -> None:
    def ends(error: BaseException) -> None:
        def end(*_: object, **__: object) -> None:
            raise error

        monkeypatch.setattr("kulman.variants.solution.solve", end)

    ends(KeyboardInterrupt())
    status, out, err = run("solve", TASK)
    ends(ZeroDivisionError())

    assert (status, out, err.strip()) == (130, "", "")
    with pytest.raises(ZeroDivisionError):
        cli.main(["solve", TASK])


def test_no_garbage_is_looked_for_while_a_sheet_is_drawn_nor_afterwards(tmp_path: Path) -> None:
    code = "import atexit, gc, kulman.cli\ngc.collect()\ngc.callbacks.append(lambda when, _: print(when))\n"
    code += "atexit.register(gc.callbacks.clear)\nkulman.cli.main(['sheet', 'nau-slider-crank', '-o', 'x.svg'])"

    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)

    assert done.stdout.split() == ["x.svg"]


def test_the_list_loads_nothing_heavy(tmp_path: Path) -> None:
    code = "import sys; sys.argv = ['kulman', 'list']\nimport atexit, kulman.cli\n"
    code += "atexit.register(lambda: print(*sorted(sys.modules), file=sys.stderr))\nkulman.cli.main()"

    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)

    loaded = set(done.stderr.split())
    assert not loaded & {"numpy", "msgspec", "shapely", "matplotlib", "reportlab", "svgwrite", "fontTools"}
    assert not loaded & {"kulman.plans", "kulman.drawing", "kulman.variants.reader"}


# `kulman list --check` solves every variant of a file: what is a fault of it, what a remark, what was not tried.
@pytest.fixture
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let all variants be tried, however slow or busy the machine is."""
    monkeypatch.setattr("kulman.variants.reader.TRIED_FOR", math.inf)


def crank_rocker(*variants: tuple[float, ...]) -> str:
    """Return a file of variants: angle of the crank, degrees, lengths of crank, coupler, rocker, frame, mm."""
    names, rest = (
        ("phi", "l_OA", "l_AB", "l_CB", "l_OC"),
        {"l_AS2": "5", "l_CS3": "5", "n_1": "90", "q": "9", "M_3": "9"},
    )
    rows = (dict(zip(names, map(repr, numbers), strict=True)) for numbers in variants)
    text = bundled_text("scheme-03-crank-rocker")
    return _with_variants(text, [(f"v{k}", {**row, **rest}) for k, row in enumerate(rows)])


@pytest.mark.usefixtures("patience")
def test_a_check_tries_every_variant_over_the_cycle() -> None:
    random, kinds = np.random.default_rng(20261122), set[str]()
    lengths = random.uniform((0, 10, 10, 10, 10), (360, 60, 90, 90, 120), (24, 5))
    rows = [(45.0, 30.0, 21.0, 80.0, 100.0), *(tuple(row) for row in np.round(lengths, 3).tolist())]

    faults, remarks = check_text(crank_rocker(*rows), "own.toml")

    told = {one.place.split(": variant.")[1]: one.key for one in faults}
    arcs: dict[str, list[tuple[float, float]]] = {}
    for one in remarks:
        if one.key == "variant-apart":
            ends = float(one.data["low"]), float(one.data["high"])
            arcs.setdefault(one.place.split(": variant.")[1], []).append(ends)
    for k, (phi, a, b, c, d) in enumerate(rows):
        angles = np.radians(np.arange(0.0, 360.0, 0.25))
        across = np.sqrt(a * a + d * d - 2.0 * a * d * np.cos(np.append(angles, math.radians(phi))))
        *every, here = ((abs(b - c) <= across) & (across <= b + c)).tolist()
        kind = "" if here else "no-assembly-here" if any(every) else "no-assembly"
        kinds.add(kind)
        assert told.get(f"v{k}", "") == kind
        lost = sum(high - low for low, high in arcs.get(f"v{k}", ()))
        assert lost == pytest.approx(0.25 * every.count(False) if any(every) else 0.0, abs=1.0)
    assert kinds == {"", "no-assembly-here", "no-assembly"}


@pytest.mark.usefixtures("patience")
@pytest.mark.parametrize("language", LANGUAGES)
def test_a_check_tells_faults_from_remarks(folder: Path, run: Run, language: str) -> None:
    words = messages(language)
    text = crank_rocker((0.0, 50.0, 21.0, 80.0, 100.0), (90.0, 50.0, 120.0, 50.0, 120.0))
    Path("t.toml").write_text(text, encoding="utf-8")

    status, out, err = run("list", "--check", "t.toml", "--lang", language)
    data = json.loads(run("list", "--check", "t.toml", "--json", "--lang", language)[1])

    assert status == 2
    assert [one["key"] for one in data["errors"]] == ["no-assembly-here"]
    assert [one["key"] for one in data["remarks"]] == ["variant-apart", "variant-apart", "variant-change"]
    assert data["remarks"][-1]["message"].endswith(words["variant-change"].format(angles="0°, 180°"))
    assert out.splitlines()[0] == data["errors"][0]["message"]
    assert out.splitlines()[1:] == [words["check-remark"].format(text=one["message"]) for one in data["remarks"]]
    assert err == words["check-bad"].format(file="t.toml", n=1) + "\n"


@pytest.mark.usefixtures("patience")
@pytest.mark.parametrize(
    ("task", "old", "new", "fault", "remarks"),
    [
        ("madi-cam", 'R_roller = "7 mm"', 'R_roller = "7 mm"\nr_0 = "40 mm"', "cam-no-offset", []),
        ("madi-cam", 'R_roller = "7 mm"', 'R_roller = "20 mm"', None, ["cam-rule-roller_of_radius"]),
        ("madi-gear", "", "", None, []),
        ("karpenko-hoist", "", "", None, ["hoist-rule-strength"]),
    ],
)
def test_variants_of_every_kind_are_tried(task: str, old: str, new: str, fault: str | None, remarks: list[str]) -> None:
    text = bundled_text(task)
    assert old in text

    faults, known = check_text(text.replace(old, new, 1), "own.toml")

    assert [one.key for one in faults] == [fault] * (fault is not None)
    assert {*remarks} <= {one.key for one in known}


def test_what_there_was_no_time_to_try_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.reader.TRIED_FOR", -1.0)
    text = crank_rocker(*[(45.0, 30.0, 21.0, 80.0, 100.0)] * 3)
    line = text[: text.index("[[variant]]")].count("\n") + 1

    faults, remarks = check_text(text, "own.toml")

    said = "variant.v0: from here on variants were not tried: 3 of 3; kulman variants own.toml solves them all"
    assert (faults, [one.text("en") for one in remarks]) == ((), [f"own.toml:{line}:1: {said}"])


SELDOM = ("structure", "position", "acceleration", "dead", "lever", "geometry", "meshing")  # what is like another plan
TYPICAL = ("nau-slider-crank", "madi-gear")  # the others take all plans, and their first two alone
PLANS = [
    pytest.param(task, plan, marks=[] if quick else pytest.mark.soak, id=f"{task}-{plan}")
    for kind in MODULES
    for task in bundled(kind)
    for plan in (None, *kind_of(kind).plans[: None if task in TYPICAL else 2])
    for quick in [task in TYPICAL and plan not in SELDOM]
]
COMMANDS = (
    ("solve",),
    ("solve", "--condition", "--json"),
    ("solve", "--hand", "normal"),
    ("solve", "--hand", "normal", "--condition", "--json"),
    ("variants",),
    ("variants", "--json"),
    ("sweep", "--positions", "6"),
    ("sweep", "--positions", "6", "--json"),
)
LANGUAGE = cycle(LANGUAGES)


def ends_well(run: Run, *arguments: str) -> str:
    """Run a command: it succeeds or refuses in one line, and prints JSON where that is wanted; return its output."""
    status, out, err = run(*arguments, "--lang", next(LANGUAGE))
    assert status in (0, 2, 3), err
    if status == 2:
        assert (err.count("\n"), out) == (1, "")
    elif "--json" in arguments:
        json.loads(out, parse_constant=pytest.fail)
        assert out.isascii()
    return out


@pytest.mark.parametrize(("task", "plan"), PLANS)
def test_every_command_takes_every_plan(task: str, plan: str | None, run: Run) -> None:
    for command, *options in COMMANDS:
        ends_well(run, command, task, *options, *(["--only", plan] if plan else []))


@pytest.mark.parametrize(("task", "plan"), PLANS)
def test_every_form_is_marked_when_it_is_filled_in(task: str, plan: str | None, folder: Path, run: Run) -> None:
    only = ["--only", plan] if plan else []
    ends_well(run, "check", task, "--form", "form.csv", *only)
    if not Path("form.csv").exists():  # a plan that this mechanism has not
        assert plan == "compound"
        return
    solution = solve(task, only=plan)
    Path("answers.csv").write_text("\n".join(("quantity;value;unit", *filled(solution))) + "\n", encoding="utf-8")
    for options in ([], ["--verdict-only", "--json"]):
        assert ends_well(run, "check", task, "-v", solution.variant, "answers.csv", *options, *only)
    assert [name for name, value in solution.solved.values.items() if not isinstance(value, (float, complex))] == []


def filled(solution: Solution) -> Iterator[str]:
    """Go through the answers of somebody who has every value right."""
    for quantity in solution.quantities.values():
        if quantity.value is not None and math.isfinite(quantity.value):
            yield f"{quantity.name};{quantity.value!r};{quantity.unit}"


def test_a_bundled_task_is_shown_and_copied_to_begin_with(folder: Path, run: Run) -> None:
    for language in LANGUAGES:
        status, shown, _ = run("show", "scheme-09-shaper", "--lang", language)
        assert (status, tomllib.loads(shown)) == (0, tomllib.loads(bundled_text("scheme-09-shaper")))
    assert run("new", "--from", "scheme-09-shaper", "my shaper") == (0, "my shaper.toml\n", "")
    assert run("new", "--from", "scheme-09-shaper", "my shaper.toml")[0] == 4  # it stays
    assert "did you mean scheme-09-shaper" in run("show", "scheme-09-shapr")[2]
    assert run("new", "--from", "nothing", "other.toml")[0] == run("show", "my shaper.toml")[0] == 2
    assert run("new", "--from", TASK, "--kind", "cam", "other.toml")[0] == 2
    assert not Path("other.toml").exists()


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=[pytest.mark.soak] * (k % 4 > 0)) for k, task in enumerate(bundled())]
)
def test_a_copied_task_is_the_users_own(task: str, folder: Path, run: Run) -> None:
    language = LANGUAGES[len(task) % 3]

    run("new", "--from", task, "мій.toml", "--lang", language)

    copied = Path("мій.toml").read_text(encoding="utf-8")
    comments = " ".join(re.findall(r"#(.*)", copied))
    own, source = tomllib.loads(copied), tomllib.loads(bundled_text(task))
    assert own["source"] == tomllib.loads(_template(language))["source"]
    assert own["id"] == "мій"
    assert "kulman solve мій.toml" in comments
    assert source["title"][language] in comments
    shown = run("show", task, "--lang", language)[1]
    for words in (comments.replace("мій", ""), " ".join(re.findall(r"#(.*)", shown))):
        assert language == "en" or not FOREIGN[language].search(words)
        assert (language == "en") == (not CYRILLIC.search(words))
    above = re.search(r"((?:#.*\n)+)\[givens\]\n", copied)
    assert above
    assert not re.search("at the end|наприкінці|в конце", above[1])  # the variants may stand first
    rows = re.search(r"(?<=^\[givens\]\n)(?:.+\n)+", copied, re.MULTILINE)
    assert rows
    assert all(re.search(r"\}  +# \w{2,}", row) for row in rows[0].splitlines())
    assert own.keys() ^ source.keys() <= {"number", "note"}
    assert "number" not in own
    assert all(own[key] == source[key] for key in own.keys() - {"id", "source"})
    assert run("list", "--check", "мій.toml")[0] == 0


@pytest.mark.skipif(sys.platform == "win32", reason="consoles of Windows are asked in UTF-16")
@pytest.mark.parametrize(("encoding", "unit"), [("cp866", "рад/с"), ("ascii", "rad/s")])
def test_a_console_gets_its_own_encoding_with_like_signs(encoding: str, unit: str, folder: Path) -> None:
    import pty

    above, below = pty.openpty()
    command = [sys.executable, "-m", "kulman", "solve", TASK, "-v", "3", "--only", "velocity", "--lang", "uk"]
    subprocess.run(command, stdout=below, check=True, env={**os.environ, "PYTHONIOENCODING": encoding})
    os.close(below)
    shown = os.read(above, 10_000).decode(encoding)
    os.close(above)

    line = next(line for line in shown.splitlines() if line.startswith("omega_2"))
    assert re.search(r"\(-\d", shown)  # the sign of a number is never lost
    assert line.endswith(unit)
    assert not re.search(r"\\u|\?", shown)


def test_pipes_have_utf_8_whatever_the_console_has(folder: Path) -> None:
    done = shell(["solve", TASK, "-v", "3", "--only", "velocity", "--lang", "uk"], folder, PYTHONIOENCODING="cp866")

    assert "−" in done.stdout.decode("utf-8")


@pytest.mark.parametrize("said", ["", "en"])
def test_files_are_ukrainian_unless_a_language_is_said(
    said: str, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KULMAN_LANG", said)
    monkeypatch.chdir(tmp_path)
    Path("roster.csv").write_text("name,group,variant\nIryna,MM-21,3\n", encoding="utf-8")
    velocity = TASK, "-v", "3", "--only", "velocity"

    written = [
        run("batch", TASK, "--form", "class.csv"),
        run(
            "batch", TASK, "--roster", "roster.csv", "--out", "out", "--as", "svg", "--only", "velocity", "--jobs", "1"
        ),
        run("check", *velocity, "--form", "form.csv"),
        run("check", TASK, "--only", "velocity", "out/key.csv", "-o", "class.html"),
        run("variants", *velocity, "--quantities", "V_B", "-o", "key.csv"),
        run("handout", *velocity, "-o", "blank.svg"),
        run("sheet", *velocity, "-o", "sheet.svg"),
        run("note", *velocity, "-o", "note.md"),
    ]
    status, shown, _ = run("variants", *velocity, "--quantities", "V_B")

    assert [code for code, _, _ in written] == [0] * len(written)
    texts = {
        file: file.read_text("utf-8-sig")
        for file in tmp_path.rglob("*")
        if file.suffix in (".csv", ".html", ".svg", ".md")
    }
    own = {
        file.name: re.search("[а-яії]{4}", text) is not None
        for file, text in texts.items()
        if file.name != "roster.csv"
    }
    assert len(own) >= 10
    assert {name for name, cyrillic in own.items() if cyrillic is bool(said)} == set()
    assert (status, shown.split()[:2]) == (0, ["quantity", "unit"])


@pytest.mark.parametrize("said", ["", "ru", "en"])
def test_tables_of_all_commands_have_numbers_and_units_of_one_language(
    said: str, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KULMAN_LANG", said)
    monkeypatch.chdir(tmp_path)
    velocity = TASK, "-v", "3", "--only", "velocity"
    for command in (
        ("solve", *velocity, "-o", "solved.csv"),
        ("sweep", *velocity, "--positions", "3", "-o", "swept.csv"),
        ("variants", *velocity, "--quantities", "V_B", "-o", "key.csv"),
        ("chart", TASK, "-v", "3", "--chart", "stability", "--positions", "4", "-o", "chart.csv"),
        ("solve", *velocity, "-o", "solved.html"),
    ):
        status, _, err = run(*command)
        assert status == 0, command
        assert ("--lang en" in err) is (not said)  # messages are in English, and nobody has chosen a language

    texts = {file.name: file.read_text("utf-8-sig") for file in tmp_path.iterdir()}

    decimal, between, metres = (r"\d\.\d", ",", "m/s") if said == "en" else (r"\d,\d", ";", "м/с")
    assert {name for name, text in texts.items() if not re.search(decimal, text)} == set()
    assert {name for name, text in texts.items() if between not in text.splitlines()[0]} == {"solved.html"}
    assert {name for name, text in texts.items() if metres not in text} == {"chart.csv"}
    assert f"[{'mm' if said == 'en' else 'мм'}]" in texts["chart.csv"]
    assert texts["chart.csv"].startswith("place [°]")
