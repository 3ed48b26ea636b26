"""Sixty outputs of the program, hashed: a change that is to change nothing proves it.

    python -m kulman.tests.corpus.corpus            compare all with what is kept, on all cores: make corpus
    python -m kulman.tests.corpus.corpus --keep     keep what there is now, with --only TEXT of some cases
    python -m kulman.tests.corpus.corpus --write DIR --only TEXT    write the outputs of some cases, to look at them

A case is a line of `outputs.txt`: commands one after the other in a folder of their own, chosen so that together they
reach nearly every line of the package that any output reaches. Its output is what they print on both streams, their
statuses, and the bytes of the files they write, of workbooks the values of cells. What is kept holds where library
functions and the packages that draw are the same, bit for bit (`machine`).
"""

from __future__ import annotations

import argparse
import cmath
import hashlib
import io
import json
import math
import os
import shlex
import sys
import tempfile
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir
from importlib.metadata import version
from pathlib import Path

import numpy as np

import kulman

KEPT = Path(__file__).with_name("outputs.txt")
MACHINE = "machine"  # stands in the place of a case
PACKAGES = ("click", "matplotlib", "numpy", "openpyxl", "reportlab", "shapely", "svgwrite", "typst", "xlsxwriter")
DIGITS = 16  # of a digest
WRONG = 1.25  # how many times too large the student's answers of every fifth line are
ROSTER = """student;group;variant;l_OA [mm]
Шевчук О.;МТ-31;3;
Koval M.;МТ-31;7;41,5
"""


def digest(case: str, kept: Path | None = None) -> str:
    """Run a case and hash what comes of it; write that into the folder `kept`, too, where one is given."""
    from kulman import cli
    from kulman.scales.errors import VARIABLE
    from kulman.variants.commands.console import PLACE

    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="") for _ in range(2))
    streams, shell = (
        (sys.stdout, sys.stderr),
        {name: os.environ.pop(name, None) for name in ("LC_ALL", VARIABLE, PLACE)},
    )
    found = hashlib.sha256()
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        given = _prepare(case)
        sys.stdout, sys.stderr, os.environ["LC_ALL"], os.environ[PLACE] = out, err, "C.UTF-8", ""
        try:
            for command in case.split(" && "):
                found.update(f"{_status(cli.main, shlex.split(command))}\n".encode())
        finally:
            sys.stdout, sys.stderr = streams
            del os.environ["LC_ALL"], os.environ[PLACE]
            os.environ.update({name: value for name, value in shell.items() if value is not None})
        for stream in (out, err):
            stream.flush()
            found.update(stream.buffer.getvalue())  # type: ignore[attr-defined]
        for file in sorted(file for file in Path().rglob("*") if file.is_file() and file.name not in given):
            content = _content(file)
            found.update(f"\n{file.as_posix()}\n".encode() + content)
            if kept:
                (kept / file).parent.mkdir(parents=True, exist_ok=True)
                (kept / file).write_bytes(content)
        if kept:
            kept.mkdir(parents=True, exist_ok=True)
            (kept / "stdout").write_bytes(out.buffer.getvalue())  # type: ignore[attr-defined]
    return found.hexdigest()[:DIGITS]


def _status(main: Callable[[list[str]], object], arguments: list[str]) -> object:
    """Return the status with which a command ends."""
    try:
        main(arguments)
    except SystemExit as stopped:
        return stopped.code
    return 0


def _prepare(case: str) -> set[str]:
    """Write the files that a case names and does not make itself; return their names.

    Those are the examples of task files, the roster `class.csv`, and `answers.csv`, the right ones to four digits of
    the task and variant that are marked, every fifth too large.
    """
    words = shlex.split(case)
    given = {}
    for example in (Path(kulman.__file__).parent / "docs" / "examples").glob("*.toml"):
        if example.name in words:
            given[example.name] = example.read_text(encoding="utf-8")
    if "class.csv" in words:
        given["class.csv"] = ROSTER
    for name, text in given.items():
        Path(name).write_text(text, encoding="utf-8")
    if "answers.csv" in words:
        given["answers.csv"] = _answers(words[1], words[words.index("-v") + 1] if "-v" in words else None)
        Path("answers.csv").write_text(given["answers.csv"], encoding="utf-8")
    return {*given}


def _answers(task: str, variant: str | None) -> str:
    """Return a form with the right answers to four digits, every fifth too large."""
    solution = kulman.solve(task, variant)
    rows = [f"variant;{solution.variant}", "quantity;mm;value"]
    names = [name for name in kulman.check(task, variant).asked.quantities if name in solution.quantities]
    for number, name in enumerate(names):
        quantity = solution[name]
        if quantity.value is None:
            continue
        times = WRONG if number % 5 == 3 else 1.0
        mm = "" if quantity.mm is None else f"{quantity.mm * times:.4g}"
        rows.append(f"{name};{mm};{quantity.value * times:.4g}")
    return "\n".join([*rows, ""])


def _content(file: Path) -> bytes:
    """Return the bytes of a file, of a workbook the values of its cells."""
    if file.suffix != ".xlsx":
        return file.read_bytes()
    from openpyxl import load_workbook

    sheets = load_workbook(file).worksheets
    return json.dumps([[[cell.value for cell in row] for row in sheet.iter_rows()] for sheet in sheets]).encode()


def machine() -> str:
    """Return a digest of what this machine makes of library functions, and of the versions of what draws and writes."""
    x = np.linspace(-30.0, 30.0, 20_001)
    probe = hashlib.sha256(sys.version.encode())
    for y in (np.sin(x), np.cos(x), np.tan(x), np.exp(x), np.arctan2(x, x[::-1]), np.hypot(x, 3.0), abs(x) ** 0.3):
        probe.update(y.tobytes())
        probe.update(np.array([math.sin(z) * math.exp(z) + cmath.exp(1j * z).real for z in x[::10]]).tobytes())
    probe.update(" ".join(f"{name} {version(name)}" for name in PACKAGES).encode())
    return probe.hexdigest()[:DIGITS]


def kept() -> dict[str, str]:
    """Return the digests that are kept, by their cases; `MACHINE` names where they hold."""
    lines = KEPT.read_text(encoding="utf-8").splitlines()
    return {name: found for found, _, name in (line.partition(" ") for line in lines)}


def digests(wanted: Iterable[str]) -> dict[str, str]:
    """Return the digests of cases, worked out on all cores."""
    wanted = list(wanted)
    with ProcessPoolExecutor() as pool:
        return dict(zip(wanted, pool.map(digest, wanted), strict=True))


def main() -> int:
    """Compare, keep or write; the status is 1 where something is other than it was."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--write", type=Path)
    parser.add_argument("--only", default="")
    asked = parser.parse_args()
    before = kept()
    wanted = [case for case in before if case != MACHINE and asked.only in case]
    if asked.write:
        for number, case in enumerate(wanted):
            print(digest(case, asked.write / f"{number:02d}"), case)
        return 0
    if not asked.keep and before[MACHINE] != machine():
        print("what is kept is that of another machine, or of other packages", file=sys.stderr)
        return 2
    found = digests(wanted)
    if asked.keep:
        whole = {**before, **found, MACHINE: machine()}
        KEPT.write_text("".join(f"{value} {name}\n" for name, value in whole.items()), encoding="utf-8")
        return 0
    changed = [name for name, value in found.items() if before[name] != value]
    print("\n".join(["changed:", *changed] if changed else [f"{len(found)} outputs, none changed"]))
    return bool(changed)


if __name__ == "__main__":
    sys.exit(main())
