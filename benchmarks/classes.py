"""What `kulman check` takes for a student of a class: a variant each, and data of one's own: `make speed` shows it.

Alone it marks a whole class: `python benchmarks/classes.py nau-slider-crank 1000 own`.
"""

from __future__ import annotations

import cmath
import csv
import random
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from kulman import check, load_task, solve
from kulman.plans.hands.shaky import draw, preset
from kulman.scales.errors import KulmanError
from kulman.variants.marking.keyed import Keyed, Request, Rubric, keyed
from kulman.variants.task import Task

HAND = preset("normal")
SEED = 20
EVERY = 3  # how many students there are to one with a mistake in the drawing
MOVED = {"phi": 0.02, "l": 0.02, "n": 0.05}  # parts by which data of one's own differ from the variant's, by kind
TRIES = 10  # at data of one's own, for which there may be no plan
TASKS = ("nau-slider-crank", "madi-four-bar", "scheme-09-shaper")
STUDENTS, SOLUTIONS = 100, 40
Data = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Class:
    """A class on disk: the answers, a row each, and the roster with variants and, where wanted, data of one's own."""

    answers: Path
    roster: Path


def written(folder: Path, task_id: str, count: int, own: bool) -> Class:
    """Write a class drawn by usual hands: the variants of the task in turn; with `own` everybody has other data.

    The same arguments write the same class.
    """
    task, dice = load_task(task_id), random.Random(SEED)
    givens = [name for name in task.givens if own and name.partition("_")[0] in MOVED]
    variants = list(task.variants)
    rows: list[dict[str, str]] = []
    entries = [["student", "id number", "variant", *(f"{name} [{_unit(task, name).name}]" for name in givens)]]
    for number in range(count):
        variant = variants[number % len(variants)]
        found, data = _sheet(task, variant, givens, dice)
        who = {"student": f"Student {number:04d}", "id number": f"N{number}", "variant": variant}
        rows.append({**who, **dict(_answers(found, dice, number % EVERY == 0))})
        entries.append([*who.values(), *(dict(data).get(name, "") for name in givens)])
    columns = list(dict.fromkeys(name for row in rows for name in row))
    made = Class(folder / "class.csv", folder / "roster.csv")
    _write(made.answers, [columns, *([row.get(name, "") for name in columns] for row in rows)])
    _write(made.roster, entries)
    return made


def _write(file: Path, rows: list[list[str]]) -> None:
    with file.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, delimiter=";").writerows(rows)


def _unit(task: Task, name: str) -> Any:
    return task.givens[name].unit


def _sheet(task: Task, variant: str, givens: list[str], dice: random.Random) -> tuple[Keyed, Data]:
    """Return a sheet with data of one's own; with those of the variant where others have no plan."""
    values: dict[str, Any] = task.resolve(variant)
    for _ in range(TRIES):
        parts = {name: 1.0 + dice.uniform(-1.0, 1.0) * MOVED[name.partition("_")[0]] for name in givens}
        data = tuple((name, f"{_unit(task, name).from_si(values[name]) * part:.4g}") for name, part in parts.items())
        try:
            return _keyed(task.id, variant, data), data
        except KulmanError:
            continue
    return _keyed(task.id, variant, ()), ()


@lru_cache(maxsize=40)
def _keyed(task_id: str, variant: str, data: Data) -> Keyed:
    return keyed(Request(load_task(task_id), variant), variant, dict(data), Rubric(HAND.tolerance))


def _answers(found: Keyed, dice: random.Random, wrong: bool) -> Iterator[tuple[str, str]]:
    """Go through what is written of one drawing: scale factors, segments, values of four digits, directions."""
    paper, ours = found.key.paper, found.key.paper.mus
    if wrong:
        broken = dice.choice(found.book.signatures).broken
        paper = replace(paper, program=broken.program, givens=broken.givens)
    paper = replace(paper, mus={plan: ours.get(plan, 0.0) for plan in paper.program.plans})
    board = draw(paper, HAND.hand, np.random.default_rng(dice.randrange(2**32)), 1)
    for symbol, scale in found.solution.scales.items():
        if symbol in found.asked.scales:
            yield symbol, f"{scale.mu:.6g}"
    for name, question in found.key.questions.items():
        value, mu = np.ravel(board.values[name])[0], ours.get(question.plan)
        if value != value or "_couple_" in name:
            continue
        if mu and question.step.verb in ("read", "arm"):
            yield f"{name}.mm", f"{abs(value) / mu:.1f}"
        yield name, f"{abs(value) if question.vector else value:.4g}"
        if question.vector:
            yield f"{name}.dir", f"{np.degrees(cmath.phase(complex(value))) % 360.0:.1f}"


def marked(task_id: str, count: int, own: bool, jobs: int = 1) -> float:
    """Return the seconds of the processor in which a class is read and marked, with a report on everybody."""
    with tempfile.TemporaryDirectory() as folder:
        made = written(Path(folder), task_id, count, own)
        start = _spent()
        asked = check(task_id, roster=made.roster, lang="en")
        found = asked.mark_all(asked.read(str(made.answers)), Path(folder) / "reports", jobs=jobs)
        taken = _spent() - start
    assert len(found) == count
    assert all(result.mark is not None for result in found)
    return taken


def _spent() -> float:
    times = [time.process_time()]
    if sys.platform != "win32":
        import resource

        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        times += [children.ru_utime, children.ru_stime]
    return sum(times)


def solution(task_id: str) -> float:
    """Return the seconds of the processor in which a variant is solved."""
    task = load_task(task_id)
    start = time.process_time()
    for number in range(SOLUTIONS):
        solve(task, list(task.variants)[number % len(task.variants)])
    return (time.process_time() - start) / SOLUTIONS


def students() -> Iterator[tuple[str, float, float]]:
    """Go through the classes: what they are, the seconds that a student takes, and how many solutions that is."""
    for task_id in TASKS:
        for own, kind in ((False, "a variant each"), (True, "data of one's own")):
            yardstick = solution(task_id)
            each = marked(task_id, STUDENTS, own) / STUDENTS
            yield f"`kulman check`, a student, {task_id}, {kind}", each, each / min(yardstick, solution(task_id))


if __name__ == "__main__":
    task_id, count, *own = sys.argv[1:]
    taken = marked(task_id, int(count), bool(own), jobs=2)
    print(f"{task_id}, {count} students: {taken:.1f} s of the processor, {taken / int(count) * 1e3:.1f} ms each")
