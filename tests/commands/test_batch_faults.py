"""A disk that fills up, a run that is killed, rows that crash: all that is there is whole, nothing is done twice."""

from __future__ import annotations

import ctypes
import errno
import faulthandler
import io
import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from kulman import batch
from kulman.drawing import writers
from kulman.scales.errors import InputError
from kulman.tests.support import commands
from kulman.tests.support.commands import files
from kulman.variants.batches.batch import JOURNAL, Outcome, Student, _Making
from kulman.variants.crew import Journal

TASK = "nau-slider-crank"
MAIN = "from kulman.cli import main\nmain(sys.argv[1:])"
posix = pytest.mark.skipif(sys.platform == "win32", reason="processes are killed as POSIX kills them")


def roster(folder: Path, count: int) -> Path:
    return commands.roster(folder, *(f"S{n};{n % 10}" for n in range(1, count + 1)), head="student;variant")


def parts(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name.endswith(".part")]


def numbers(folder: Path) -> dict[str, int]:
    """Return what tells a file from another one written in its place."""
    return {path.name: path.stat().st_ino for path in folder.iterdir() if not path.name.startswith(".")}


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of the students for whom something is made: two small files each, as what they hold is no matter."""
    found: list[int] = []

    def make(making: _Making, student: Student) -> Outcome:
        found.append(student.number)
        stem, data = f"{student.number:03d}-{student.entry.who.student}", f"{student!r}\n" * 20
        return Outcome("1", "id", {f"{stem}.svg": data.encode(), f"{stem}.pdf": data.encode()}, {"V_B": 1.5})

    monkeypatch.setattr(_Making, "make", make)
    return found


class Disk:
    """Counts what is written, renamed, made; from the n-th time on something happens instead."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, until: int, then: Callable[[], None]) -> None:
        self.left, self.then = until, then
        first, replace = io.open, os.replace

        def opened(file: Any, mode: str = "r", *rest: Any, **more: Any) -> Any:
            stream = first(file, mode, *rest, **more)
            return stream if mode.startswith("r") else Slow(stream, self)

        def replaced(*names: Any) -> None:
            self.count()
            replace(*names)

        monkeypatch.setattr(io, "open", opened)  # what `Path.open` calls
        monkeypatch.setattr(os, "replace", replaced)

    def count(self) -> None:
        self.left -= 1
        if self.left < 0:
            self.then()


class Slow:
    """A file of which half is written before the disk is asked for the rest."""

    def __init__(self, stream: Any, disk: Disk) -> None:
        self.stream, self.disk = stream, disk

    def __enter__(self) -> Slow:
        return self

    def __exit__(self, *what: object) -> None:
        self.stream.close()

    def write(self, data: bytes) -> None:
        half = len(data) // 2
        self.stream.write(data[:half])
        self.stream.flush()
        self.disk.count()
        self.stream.write(data[half:])


def full() -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def die() -> None:
    os._exit(9)


@pytest.fixture
def whole(tmp_path: Path, made: list[int]) -> dict[str, bytes]:
    """What an undisturbed batch of three has made; its roster is class.csv."""
    batch(TASK, roster(tmp_path, 3), tmp_path / "whole", jobs=1)
    return files(tmp_path / "whole")


def goes_on(out: Path, right: dict[str, bytes], made: list[int]) -> None:
    """What is there is right; a second run makes the rest, and writes nothing again that was there."""
    there, before = files(out), numbers(out)
    assert there.items() <= right.items()
    made.clear()

    batch(TASK, out.parent / "class.csv", out, jobs=1)

    assert (files(out), parts(out)) == (right, [])
    assert before.items() <= numbers(out).items()
    assert len(made) <= 3 - len([name for name in there if name.endswith(".pdf")]) + 1


MOMENTS = 3 * (2 * 2 + 1) + 2 * 2  # two files and a note for each, two tables


def test_a_disk_that_is_full_at_any_moment_leaves_nothing_half_written(
    tmp_path: Path, made: list[int], whole: dict[str, bytes]
) -> None:
    for until in range(100):
        out = tmp_path / f"full-{until}"
        with pytest.MonkeyPatch.context() as patched:
            Disk(patched, until, full)
            try:
                batch(TASK, tmp_path / "class.csv", out, jobs=1)
            except InputError as error:
                told = error.text("en")
                assert re.fullmatch(re.escape(str(out)) + r"/\S+: cannot be written \(No space left on device\)", told)
            else:
                break
        assert parts(out) == []
        goes_on(out, whole, made)
    assert until >= MOMENTS


@posix
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_run_that_is_killed_at_any_moment_is_gone_on_with(
    tmp_path: Path, made: list[int], whole: dict[str, bytes]
) -> None:
    def run(out: Path, until: int) -> None:
        Disk(pytest.MonkeyPatch(), until, die)
        batch(TASK, tmp_path / "class.csv", out, jobs=1)

    for until in range(100):
        out = tmp_path / f"killed-{until}"
        child = multiprocessing.get_context("fork").Process(target=run, args=(out, until))
        child.start()
        child.join()
        if child.exitcode == 0:
            break
        assert child.exitcode == 9
        goes_on(out, whole, made)
    assert until >= MOMENTS


@pytest.mark.soak
@posix
def test_a_disk_with_a_limit_of_the_system_is_one_line(tmp_path: Path) -> None:
    limited = "import resource, sys\nresource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv.pop(1)),) * 2)\n" + MAIN
    kinds = ["--only", "structure", "--jobs", "1", "--as", "svg", "--as", "pdf"]
    arguments = ["batch", TASK, "--roster", str(roster(tmp_path, 2)), "--out", str(tmp_path / "out"), *kinds]

    for limit, status, left in (("9000", 2, 0), ("1000000", 0, 4)):
        done = subprocess.run([sys.executable, "-c", limited, limit, *arguments], capture_output=True, check=False)

        assert (done.returncode, done.stderr.count(b"\n")) == (status, status // 2)
        made = [path.name for path in (tmp_path / "out").iterdir() if path.suffix in (".svg", ".pdf", ".part")]
        assert len(made) == left


def test_only_what_a_batch_has_left_half_written_is_swept(tmp_path: Path, made: list[int]) -> None:
    out = tmp_path / "out"
    out.mkdir()
    own = (".001-S1.svg.77.part", ".manifest.csv.4.part", f".{JOURNAL}.5.part")
    foreign = (".001-S1.svg.part", "001-S1.svg.77.part", ".thesis.docx.77.part", ".secret")
    for name in (*own, *foreign, f".001-S1.svg.{os.getpid()}.part"):
        (out / name).write_bytes(b"half")

    batch(TASK, roster(tmp_path, 1), out, jobs=1)

    assert {path.name for path in out.iterdir() if path.name.startswith(".") or "part" in path.name} == {
        JOURNAL,
        *foreign,
    }


@pytest.mark.parametrize(
    "torn", [b'{"digest": "ab', b"\xff\xfe\x00\n", b"[]\n5\nnull\n", b'{"digest": [], "result": []}\n', b"\n\n"]
)
def test_what_a_killed_run_has_torn_costs_no_other_line(tmp_path: Path, torn: bytes) -> None:
    path = tmp_path / JOURNAL
    outcome = Outcome("1", "id", {"x.svg": "0"}, {}, (), "")
    journal = Journal(path, Outcome.from_json)
    journal.note("first", outcome)
    path.write_bytes(path.read_bytes() + torn)
    journal = Journal(path, Outcome.from_json)
    journal.note("second", outcome)

    found = Journal(path, Outcome.from_json)

    assert (found.before.get("first"), found.before.get("second")) == (outcome, outcome)


@pytest.mark.parametrize("files", ["5", "null", "[]", '{"a": 1}', '"x"'])
def test_a_journal_of_something_else_is_as_good_as_none(tmp_path: Path, made: list[int], files: str) -> None:
    out = tmp_path / "out"
    out.mkdir()
    said = f'"variant": "1", "sheet": "", "files": {files}, "key": {{}}, "notes": [], "problem": ""'
    (out / JOURNAL).write_text(f'{{"digest": "x", "result": {{{said}}}}}\n', encoding="utf-8")

    batch(TASK, roster(tmp_path, 2), out, jobs=1)

    assert made == [1, 2]


def test_a_file_that_a_scanner_keeps_for_a_moment_is_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    waits: list[float] = []
    first = os.replace

    def kept(*names: Any) -> None:
        if len(waits) < 2:
            raise PermissionError(errno.EACCES, "Access is denied")
        first(*names)

    monkeypatch.setattr(os, "replace", kept)
    monkeypatch.setattr(time, "sleep", waits.append)
    monkeypatch.setattr(writers, "PAUSES", (0.1, 0.2))  # those of Windows

    writers.write_whole(tmp_path / "x.csv", b"1")
    waits.clear()
    monkeypatch.setattr(writers, "PAUSES", (0.1,))
    with pytest.raises(InputError, match=r"x\.csv: cannot be written \(Access is denied\)"):
        writers.write_whole(tmp_path / "x.csv", b"2")

    assert (tmp_path / "x.csv").read_bytes() == b"1"
    assert parts(tmp_path) == []


def segfault() -> None:
    faulthandler.disable()  # of the process that dies
    ctypes.string_at(0)


def panic() -> None:
    class PanicException(BaseException):
        """As typst's, which is no Exception."""

    raise PanicException("range end index 3 out of range")


def swell() -> None:
    raise MemoryError


def divide() -> None:
    print(1 // 0)


@posix
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.parametrize(
    ("poison", "jobs", "said"),
    [
        (segfault, 2, "ended in a crash"),
        (die, None, "ended in a crash"),
        (panic, 1, "PanicException: range end index 3 out of range (test_batch_faults.py:"),
        (swell, 2, "MemoryError (test_batch_faults.py:"),
        (divide, 1, "ZeroDivisionError: integer division or modulo by zero (test_batch_faults.py:"),
    ],
)
def test_a_row_that_crashes_is_named_and_the_others_are_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, poison: Callable[[], None], jobs: int | None, said: str
) -> None:
    def make(making: _Making, student: Student) -> Outcome:
        if student.number == 3:
            poison()
        return Outcome("1", "id", {f"{student.number:03d}.svg": b"<svg/>"})

    monkeypatch.setattr(_Making, "_made", make)

    done = batch(TASK, roster(tmp_path, 5), tmp_path / "out", kinds=["svg"], jobs=jobs, lang="en")

    assert len(done.problems) == 1
    assert done.problems[0].startswith(f"{tmp_path / 'class.csv'}: row 4: ")
    assert said in done.problems[0]
    assert sorted(name for name in files(tmp_path / "out") if name.endswith(".svg")) == [
        f"00{n}.svg" for n in (1, 2, 4, 5)
    ]
    assert said in (tmp_path / "out" / "manifest.csv").read_text(encoding="utf-8-sig")


@posix
@pytest.mark.soak
def test_a_run_killed_again_and_again_gets_there(tmp_path: Path) -> None:
    file, out = roster(tmp_path, 32), tmp_path / "out"
    arguments = ["batch", TASK, "--roster", str(file), "--jobs", "2", "--only", "structure"]
    subprocess.run([sys.executable, "-m", "kulman", *arguments, "--out", str(tmp_path / "whole")], check=True)
    right = files(tmp_path / "whole")
    kills, before = 0, dict[str, int]()
    while kills < 60:
        going = subprocess.Popen(
            [sys.executable, "-m", "kulman", *arguments, "--out", str(out)], stdout=subprocess.PIPE
        )
        with going:
            had, patience = len(before), time.monotonic() + 60.0
            while going.poll() is None and len(list(out.glob("0*"))) < had + 5 + 7 * (kills % 5):
                time.sleep(0.003 * (kills % 7))
                assert time.monotonic() < patience
            ended = going.poll() == 0
            going.send_signal(signal.SIGKILL)
            assert going.stdout is not None
            going.stdout.read()  # until the last of its processes has ended, too
        there = files(out)
        assert there.items() <= right.items()
        assert before.items() <= numbers(out).items()
        before = numbers(out)
        if ended:
            break
        kills += 1

    assert kills >= 3
    assert (files(out), parts(out)) == (right, [])


@pytest.mark.soak
@pytest.mark.parametrize("start", ["spawn", "forkserver"])
def test_processes_that_start_anew_give_the_same_bytes(tmp_path: Path, start: str) -> None:
    if start not in multiprocessing.get_all_start_methods():
        pytest.skip("not on this system")
    file = roster(tmp_path, 20)
    how = f"import multiprocessing, sys; multiprocessing.set_start_method('{start}')\n{MAIN}"
    arguments = ["batch", TASK, "--roster", str(file), "--as", "svg", "--as", "pdf", "--lang", "en"]

    subprocess.run([sys.executable, "-c", how, *arguments, "--jobs", "2", "--out", str(tmp_path / "two")], check=True)
    batch(TASK, file, tmp_path / "one", kinds=["svg", "pdf"], lang="en", jobs=1)

    assert files(tmp_path / "two") == files(tmp_path / "one")


@pytest.mark.parametrize(
    ("lang", "told", "again"),
    [
        ("uk", "перервано: готово 3 з 5; готове лишилося в теці «out»", "нічого не записано"),
        ("ru", "прервано: готово 3 из 5; готовое осталось в папке «out»", "ничего не записано"),
        ("en", "interrupted: 3 of 5 done, which stay in the folder 'out'", "nothing has been written"),
    ],
)
def test_an_interrupted_run_says_what_is_written_and_goes_on_from_there(
    lang: str,
    told: str,
    again: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    made: list[int],
    run: commands.Run,
) -> None:
    monkeypatch.chdir(tmp_path)
    command = ("batch", TASK, "--roster", str(roster(tmp_path, 5)), "--out", "out", "--jobs", "1", "--lang", lang)
    note = Journal.note

    def stopped(after: int) -> Callable[..., None]:
        def noted(journal: Journal[Outcome], name: str, done: Outcome) -> None:
            if len(made) > after:
                raise KeyboardInterrupt
            note(journal, name, done)

        return noted

    for after, words in ((0, again), (3, told)):
        monkeypatch.setattr(Journal, "note", stopped(after))
        made.clear()
        status, out, err = run(*command)
        assert (status, out, err.count("\n"), words in err) == (130, "", 1, True), err
    monkeypatch.setattr(Journal, "note", note)
    made.clear()
    assert run(*command)[0] == 0
    assert 0 < len(made) < 5  # the others are not made again
