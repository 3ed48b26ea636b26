"""Mutated task files, options and answers end in a result or in a line that says what is wrong, in bounded time."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from kulman.tests.support.mutated import FAMILIES, Case, lay_out, made
from kulman.tests.support.mutated_runs import faults, judged, run
from kulman.tests.support.task_files import with_changes
from kulman.variants.shelf import bundled_text

CASES, DRAWN, CLASSES = 150, 20, 25  # of each half of the soak: twenty seconds
HANG = 30.0  # seconds: a slow machine is no fault; the long run has the bound that counts


@dataclass(frozen=True)
class Found:
    """A command that once crashed, what it must say now, and what is changed in a file of a bundled task."""

    command: str
    said: str = ""
    status: int = 2
    task: str = "nau-slider-crank"
    changes: tuple[tuple[str, str], ...] = ()
    files: dict[str, str] = field(default_factory=dict)


DIAGRAM = '[[mechanism.diagram]]\nname = "p_gas"\n'
UNFINISHED = f'{DIAGRAM}over = "strok"\n'
FOUND = {
    "a segment that nobody sees": Found("sheet scheme-01-compressor -v 9 --scale pa=0.001 -o x.svg",
        "largest segment would be 0.001 mm"),
    "a segment that nobody sees, over the cycle": Found("chart scheme-11-slotter --scale OA=0.0015 --chart stability",
        "mu_l = 73.3 m/mm"),
    "a length beside which others are nothing": Found("sheet scheme-14-jaw-crusher --set l_AS2=295km -o x.svg",
        status=0),
    "a link beside which the others are points": Found("sheet scheme-13-toggle-press --set l_AS2=2.53e+10 -o x.svg",
        status=0),
    "a diagram of sliding that is a line": Found("sheet madi-gear --set mu_theta=643646 -o x.svg", "mu_theta = 643646"),
    "a literal beyond all drawings": Found("solve x.toml", "x.toml:85:1: mechanism.pair.offset: '1e+154 m'",
        changes=(('offset = "0 mm"', 'offset = "1e154 m"'),)),
    "a choice beyond all drawings": Found("list --check x.toml", "'1e+200 deg' is too large",
        changes=(('alpha_F3 = "180 deg"', 'alpha_F3 = "1e200 deg"'),)),
    "a hand that no float holds": Found("solve nau-slider-crank --hand 1e308mm,1deg,1mm", "'1e+308 mm' is too large"),
    "a hand that no drawing survives": Found("solve nau-slider-crank --hand 1e8mm,1deg,1mm", "point is at most 100 ("),
    "a place beyond all drawings": Found("sweep nau-slider-crank --from 1e300", "'1e+300 deg' is too large"),
    "a scale factor beyond all drawings": Found("solve nau-slider-crank --scale mu_l=1e20m/mm",
        "'1e+20 m/mm' is too large"),
    "a number that is nothing in metres": Found("solve madi-cam --set rho_flat=5e-324mm --condition",
        "rho_flat: '4.94066e-324 mm' is too large or too small"),
    "a cam without a least radius": Found("solve madi-cam --set rho_flat=0 --condition", status=0),
    "a load diagram twice, once unfinished": Found("list --check x.toml", "'p_gas' stands here a second time",
        task="scheme-01-compressor", changes=((DIAGRAM, UNFINISHED + DIAGRAM),)),
    "a load diagram twice, the second unfinished": Found("list --check x.toml", "'p_gas' stands here a second time",
        task="scheme-01-compressor", changes=(('[[mechanism.load]]\n', UNFINISHED + '[[mechanism.load]]\n'),)),
    "a plan of joints that is a point": Found("solve x.toml --format A4", status=0, task="bertyaev-six-bar",
        changes=(('mu_l = "5 cm/cm"', 'mu_l = "80 m/mm"'),)),
    "gears that slide without bounds": Found("solve madi-gear --set x_sum=-0 --set x_2=0.97 --condition", status=0),
    "ranges of a beam that is rigid in some variants": Found("variants x.toml --make 1 --seed 1 --range L=1..2/0",
        "L: '0': must be greater than zero", task="karpenko-hoist", changes=(('I_2 = "4.6e-3 m^4"', 'I_2 = "inf"'),)),
    "a JSON object beside files": Found("sweep nau-slider-crank --only velocity --json -o s.csv", status=0),
    "a JSON object beside a report": Found("check nau-slider-crank printed --json -o r.txt --form f.csv --jobs 1",
        status=0),
    "answers to a hoist with a rigid beam": Found("check karpenko-hoist --set I_0=inf --jobs 1 a.csv", status=0,
        files={"a.csv": "quantity,value\nS_max,1\n"}),
    "an answer that no float holds": Found("check nau-slider-crank --jobs 1 a.csv", "", 0,
        files={"a.csv": "quantity,value,unit\nV_B,1e308,m/s\nomega_2,1e300,kg\n"}),
    "the cycle of a structure": Found("sweep nau-slider-crank --only structure -o s.svg",
        "need the plans of velocities"),
    "a point hundreds of kilometres off": Found("sheet bertyaev-six-bar --set l_AM=34064609cm -o x.svg", "fits on A1"),
    "a field over millions of kilometres": Found("sweep nau-slider-crank --set l_AB=2.3e9mm -o s.svg", "fits on A1"),
    "a stroke that is nothing": Found(
        "solve scheme-02-forging-press --set e=0 --set l_AB=4.0391552127004423e-09 --only forces", "are missing at B",
        3),
    "an option whose file is missing": Found("list --check", "--check needs FILE after it; see kulman list --help"),
    "a flag with a value": Found("list --json=3", "--json takes no value"),
    "a hand of one's own that draws a chart": Found("chart nau-slider-crank --hand 0mm,0deg,0mm",
        "is a hand of one's own"),
    "a quantity that is a table": Found("check nau-slider-crank printed --rubric r.toml", "list of quantities",
        files={"r.toml": "asked = [{a = 1}]"}),
    "a miss that leads out of where a law holds": Found("variants karpenko-hoist --set g=2.32e-07", status=0),
    "a default that no variant could have": Found("solve x.toml",
        "givens.mu_theta.default: '0 1/mm': must be greater than zero", task="madi-gear",
        changes=(('default = "0.05 1/mm"', 'default = "0 1/mm"'),)),
    "a length of a link that is nothing by default": Found("list --check x.toml",
        "givens.l_OA.default: '0 mm': must be greater than zero",
        changes=(('l_OA = { unit = "mm" }', 'l_OA = { unit = "mm", default = "0 mm" }'),)),
    "an answer that is nothing": Found("check nau-slider-crank --jobs 1 a.csv", "", 0,
        files={"a.csv": "quantity,value\nV_B,1e-320\na_B,-5e-324\n"}),
}  # fmt: skip


# others are as far off, and need no whole sheet to be drawn and no class to be solved
SLOW = (
    "a field over millions of kilometres",
    "a plan of joints that is a point",
    "a length beside which others are nothing",
    "a point hundreds of kilometres off",
    "a link beside which the others are points",
    "a miss that leads out of where a law holds",
)


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.soak] * (n in SLOW), id=n) for n in FOUND])
@pytest.mark.filterwarnings("error")
def test_what_once_crashed_says_what_is_wrong(name: str, folder: Path) -> None:
    found = FOUND[name]
    text = with_changes(bundled_text(found.task), *found.changes)
    case = Case(found.command.split(), {"x.toml": text.encode()} | {k: v.encode() for k, v in found.files.items()})
    lay_out(case, folder)

    status, out, err = run(case)

    assert (status, judged(case, status, out, err)) == (found.status, "")
    assert found.said in out + err
    assert status == 0 or len(err.splitlines()) == 1


def test_a_case_is_the_same_every_time_and_no_two_are_alike() -> None:
    cases = [made(n, family) for family in FAMILIES for n in range(40)]

    assert cases == [made(n, family) for family in FAMILIES for n in range(40)]
    assert len({(case.line, *case.files.values()) for case in cases}) == len(cases)


@pytest.mark.parametrize(
    ("fault", "kind"),
    [
        pytest.param(lambda error: 1 // 0, "ZeroDivisionError", id="a crash"),
        pytest.param(lambda error: bytearray(10**9), "MemoryError", id="a flood"),
        pytest.param(lambda error: [n for n in itertools.count(1) if not n], "TooLongError", id="a hang"),
    ],
)
def test_a_crash_a_flood_and_a_hang_are_faults(fault: Any, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.cli.console.refuse", fault)

    found = list(faults(range(3), method="fork", seconds=0.25))  # with what is planted here

    assert kind in {fault.what.partition(":")[0] for fault in found}


@pytest.mark.soak
@pytest.mark.parametrize("half", range(2))
def test_no_mutated_input_crashes_hangs_or_floods(half: int) -> None:
    found = [
        *faults(range(half * CASES, (half + 1) * CASES), seconds=HANG),
        *faults(range(half * DRAWN, (half + 1) * DRAWN), "drawn", seconds=HANG),
        *faults(range(half * CLASSES, (half + 1) * CLASSES), "classes", seconds=HANG),
    ]

    assert not found, "\n".join(f"case {fault.n}: {fault.what}\n{fault.line}\n{fault.trace}" for fault in found)


@pytest.mark.soak
def test_cases_end_in_a_process_that_has_written_a_note_before(tmp_path: Path) -> None:
    run(Case(["note", "nau-slider-crank", "-o", str(tmp_path / "note.pdf")]))

    assert (tmp_path / "note.pdf").exists()
    batch = made(397, "classes")
    assert (batch.arguments[0], *batch.arguments[-2:]) == ("batch", "--as", "note")
    assert not list(faults(range(397, 398), "classes"))
