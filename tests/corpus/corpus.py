"""What the program prints and writes, hashed: a change that is to change nothing proves it.

    python -m kulman.tests.corpus.corpus            compare all with what is kept, on all cores: make corpus
    python -m kulman.tests.corpus.corpus --keep     keep what there is now, with --only TEXT of some cases
    python -m kulman.tests.corpus.corpus --write DIR --only TEXT    write the outputs of some cases, to look at them

A case is a command in a folder of its own; its output is what it prints on both streams, its status, and the bytes of
the files it writes, of workbooks the values of cells. Answers to be marked are made from the right ones. What is kept
holds where library functions and the packages that draw are the same, bit for bit (`machine`).
"""

from __future__ import annotations

import argparse
import cmath
import hashlib
import io
import json
import math
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

KEPT = Path(__file__).with_name("digests.txt")
MACHINE = "machine"  # stands in the place of a case
PACKAGES = ("click", "matplotlib", "numpy", "openpyxl", "reportlab", "shapely", "svgwrite")
DIGITS = 16  # of a digest
EVERY = {"few": 24, "many": 7}  # every how-manieth case a short and a longer run compare
WRONG = 1.25  # how many times too large the student's answers of every fifth line are
CHARTS = {"mechanism": ("stability", "depth"), "cam": ("sections", "stability"), "gear": ("scale",)}
CHARTS["hoist"] = ("roots", "depth", "stability")


@dataclass(frozen=True)
class Case:
    """A command and, where it marks, the task and variant whose answers stand in `answers.csv`."""

    arguments: tuple[str, ...]
    marks: tuple[str, str] | None = None

    @property
    def name(self) -> str:
        """The command as it is typed."""
        return " ".join(self.arguments)


def cases() -> Iterator[Case]:
    """Go through all cases, always in the same order."""
    from kulman import load_task
    from kulman.scales.errors import LANGUAGES
    from kulman.variants.shelf import bundled

    yield from (Case(("list", "--lang", language)) for language in LANGUAGES)
    yield Case(("list", "--json"))
    for task in bundled():
        loaded = load_task(task)
        kind, variants = loaded.kind, list(loaded.variants)
        for variant in variants:
            yield Case(("solve", task, "-v", variant, "--json"))
            yield Case(("sheet", task, "-v", variant, "--lang", "uk", "-o", "sheet.svg"))
        for language in LANGUAGES:
            said = (task, "--lang", language)
            yield Case(("solve", *said))
            yield Case(("solve", *said, "--condition"))
            yield Case(("sheet", *said, "--format", "A3", "-o", "sheet.svg", "-o", "sheet.pdf"))
            yield Case(("note", *said, "-o", "note.md"))
            yield Case(("handout", *said, "-o", "blank.svg"))
            yield Case(("handout", *said, "--steps", "3", "-o", "begun.svg"))
            yield Case(("check", *said, "--form", "form.csv"))
            yield Case(("check", *said, "answers.csv"), (task, variants[-1]))
            yield Case(("sweep", *said, "-o", "cycle.csv"))
            for chart in CHARTS[kind]:
                yield Case(("chart", *said, "--chart", chart, "--positions", "24", "-o", "chart.csv"))
        yield Case(("sheet", task, "--format", "A4", "--norm", "iso", "--lang", "en", "-o", "sheet.pdf"))
        yield Case(("handout", task, "--key", "-o", "key.pdf"))
        yield Case(("check", task, "-v", variants[-1], "answers.csv", "--json"), (task, variants[-1]))
        yield Case(("check", task, "--form", "form.xlsx"))
        yield Case(("variants", task, "--lang", "en"))
        yield Case(("sweep", task, "--json"))


def digest(case: Case, kept: Path | None = None) -> str:
    """Run a case and hash what comes of it; write that into the folder `kept`, too, where one is given."""
    from kulman import cli
    from kulman.scales.language import VARIABLE

    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="") for _ in range(2))
    streams, shell = (sys.stdout, sys.stderr), {name: os.environ.pop(name, None) for name in ("LC_ALL", VARIABLE)}
    status: object = 0
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        if case.marks:
            Path("answers.csv").write_text(_answers(*case.marks), encoding="utf-8")
        sys.stdout, sys.stderr, os.environ["LC_ALL"] = out, err, "C.UTF-8"
        try:
            cli.main(list(case.arguments))
        except SystemExit as stopped:
            status = stopped.code
        finally:
            sys.stdout, sys.stderr = streams
            del os.environ["LC_ALL"]
            os.environ.update({name: value for name, value in shell.items() if value is not None})
        found = hashlib.sha256(f"{status}\n".encode())
        for stream in (out, err):
            stream.flush()
            found.update(stream.buffer.getvalue())  # type: ignore[attr-defined]
        for file in sorted(Path().iterdir()):
            content = _content(file)
            found.update(f"\n{file.name}\n".encode() + content)
            if kept:
                (kept / file.name).write_bytes(content)
        if kept:
            (kept / "stdout").write_bytes(out.buffer.getvalue())  # type: ignore[attr-defined]
    return found.hexdigest()[:DIGITS]


def _content(file: Path) -> bytes:
    """Return the bytes of a file, of a workbook the values of its cells."""
    if file.suffix != ".xlsx":
        return file.read_bytes()
    from openpyxl import load_workbook

    sheets = load_workbook(file).worksheets
    return json.dumps([[[cell.value for cell in row] for row in sheet.iter_rows()] for sheet in sheets]).encode()


def _answers(task: str, variant: str) -> str:
    """Return a form with the right answers to four digits, every fifth too large."""
    from kulman import check, solve

    solution = solve(task, variant)
    rows = ["quantity;mm;value"]
    names = [name for name in check(task, variant).asked.quantities if name in solution.quantities]
    for number, name in enumerate(names):
        quantity = solution[name]
        if quantity.value is None:
            continue
        times = WRONG if number % 5 == 3 else 1.0
        mm = "" if quantity.mm is None else f"{quantity.mm * times:.4g}"
        rows.append(f"{name};{mm};{quantity.value * times:.4g}")
    return "\n".join([f"variant;{variant}", *rows, ""])


def some(which: str) -> list[Case]:
    """Return the cases of a short run, `few`, or of a longer one, `many`, drawn evenly from all."""
    return [case for number, case in enumerate(cases()) if number % EVERY[which] == 0]


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
    """Return the digests that are kept, by the names of their cases; `MACHINE` names where they hold."""
    lines = KEPT.read_text(encoding="utf-8").splitlines()
    return {name: found for found, _, name in (line.partition(" ") for line in lines)}


def digests(wanted: Sequence[Case]) -> dict[str, str]:
    """Return the digests of cases by their names, worked out on all cores."""
    with ProcessPoolExecutor() as pool:
        return dict(zip((case.name for case in wanted), pool.map(digest, wanted, chunksize=4), strict=True))


def main() -> int:
    """Compare, keep or write; the status is 1 where something is other than it was."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--write", type=Path)
    parser.add_argument("--only", default="")
    said = parser.parse_args()
    wanted = [case for case in cases() if said.only in case.name]
    if said.write:
        for number, case in enumerate(wanted):
            folder = said.write / f"{number:04d}"
            folder.mkdir(parents=True, exist_ok=True)
            print(digest(case, folder), case.name)
        return 0
    found = digests(wanted)
    before = kept()
    if said.keep:
        whole = {MACHINE: machine(), **(before if said.only else {}), **found}
        KEPT.write_text("".join(f"{value} {name}\n" for name, value in whole.items()), encoding="utf-8")
        return 0
    if before[MACHINE] != machine():
        print("what is kept is that of another machine, or of other packages", file=sys.stderr)
        return 2
    changed = [name for name, value in found.items() if before.get(name) != value]
    print("\n".join(["changed:", *changed] if changed else [f"{len(found)} outputs, none changed"]))
    return bool(changed)


if __name__ == "__main__":
    sys.exit(main())
