"""Every command takes every task with every plan alone, in every language, as text and as JSON."""

from __future__ import annotations

import json
import math
from itertools import cycle
from pathlib import Path

import pytest

from kulman import cli, load_task
from kulman.scales.errors import LANGUAGES
from kulman.variants.case import kind_of
from kulman.variants.shelf import bundled
from kulman.variants.solution import Solution, solve

TYPICAL = ("nau-slider-crank", "madi-gear", "karpenko-hoist")  # the others take all plans, and their first two alone
TASKS = [pytest.param(task, marks=[] if task in TYPICAL else pytest.mark.soak) for task in bundled()]
PLANS = [
    pytest.param(task, plan, marks=marks, id=f"{task}-{plan}")
    for (task,), marks, _ in TASKS
    for plan in (None, *kind_of(load_task(task).kind).plans[: None if task in TYPICAL else 2])
]
COMMANDS = (
    ("solve",),
    ("solve", "--json"),
    ("solve", "--condition", "--json"),
    ("solve", "--hand", "normal"),
    ("solve", "--hand", "normal", "--condition", "--json"),
    ("variants",),
    ("variants", "--json"),
    ("sweep", "--positions", "6"),
    ("sweep", "--positions", "6", "--json"),
)
LANGUAGE = cycle(LANGUAGES)


def run(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Run a command: it succeeds or refuses in one line, and prints JSON where that is wanted; return its output."""
    with pytest.raises(SystemExit) as stopped:
        cli.main([*arguments, "--lang", next(LANGUAGE)])
    out, err = capsys.readouterr()
    assert stopped.value.code in (0, 2, 3), err
    if stopped.value.code == 2:
        assert err.count("\n") == 1
        assert out == ""
    elif "--json" in arguments:
        json.loads(out, parse_constant=pytest.fail)
    return out


@pytest.mark.parametrize(("task", "plan"), PLANS)
def test_every_command_takes_every_plan(task: str, plan: str | None, capsys: pytest.CaptureFixture[str]) -> None:
    for command, *options in COMMANDS:
        run([command, task, *options, *(["--only", plan] if plan else [])], capsys)


@pytest.mark.parametrize(("task", "plan"), PLANS)
def test_every_form_is_marked_when_it_is_filled_in(
    task: str, plan: str | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    only = ["--only", plan] if plan else []
    form, answers = tmp_path / "form.csv", tmp_path / "answers.csv"
    run(["check", task, "--form", str(form), *only], capsys)
    if not form.exists():  # a plan that this mechanism has not
        assert plan == "compound"
        return
    answers.write_text(_filled(solve(task, only=plan)), encoding="utf-8")
    for options in ([], ["--json"], ["--verdict-only", "--json"]):
        assert run(["check", task, "-v", solve(task).variant, str(answers), *options, *only], capsys)


def _filled(solution: Solution) -> str:
    """Return the answers of somebody who has every value right."""
    rows = ["quantity;value;unit"]
    for quantity in solution.quantities.values():
        if quantity.value is not None and math.isfinite(quantity.value):
            rows.append(f"{quantity.name};{quantity.value!r};{quantity.unit}")
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("task", TASKS)
def test_what_one_position_gives_is_single_numbers(task: str) -> None:
    values = solve(task).solved.values

    assert [name for name, value in values.items() if not isinstance(value, (float, complex))] == []
