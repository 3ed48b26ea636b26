"""Simulated students marked as a teacher does it: a roster and a table of the class in, marks and mistakes out.

What is counted, of the lines that a student has written and of the first explanation that the report gives:

right lines
    Lines of honest students that pass.
first wrong step
    The line named first is one that the mistake moves (by half a tolerance or more), and stands no later than the
    first line that it moves clearly (by two). Tolerances are those of the simulation (`students.moved`).
named
    The number of the mistake is that of the first explanation, or of one reported with it as not to be told apart.
    Of two mistakes both are.
wrong name
    There is an explanation, and the first one does not have the number.
unnoticed
    No line at all is wrong.

A mistake is planted only where it moves a line clearly: one within the tolerances cannot be seen.
"""

from __future__ import annotations

import csv
import random
import tempfile
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from kulman import check, load_task
from kulman.variants.marking.marked import Desk, Marked

from .drawn_by_hand import Hand, Line, Slip, named_value
from .students import (
    CLEAR,
    SLIPS,
    Data,
    Student,
    accepted,
    at_random,
    data_of,
    drawn,
    honest,
    kinds,
    mistaken,
    pool,
    scale_factors,
)

TOUCHED = 0.5  # tolerances by which a line is moved at all
SYMBOLS = {"velocity": "mu_V", "acceleration": "mu_a"}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one student; shares of lines are those that were written."""

    task: str
    slips: tuple[str, ...]
    places: tuple[str, ...]
    mark: float
    lines: int
    passed: int
    first: str  # wrong step, as named
    step: bool  # whether it is right
    names: frozenset[str]  # numbers of the first explanation
    fits: str  # another variant that the answers are said to fit

    @property
    def named(self) -> bool:
        """Whether all mistakes are named first."""
        return all(self.has(slip) for slip in self.slips)

    def has(self, slip: str) -> bool:
        """Whether a mistake is named first."""
        return not accepted(slip).isdisjoint(self.names)


def marked(students: Iterable[Student]) -> list[Outcome]:
    """Mark students, a class for each task."""
    by_task = defaultdict(list)
    for number, student in enumerate(students):
        by_task[student.task].append((number, student))
    found: dict[int, Outcome] = {}
    for task, group in by_task.items():
        ordered = sorted(group, key=lambda one: (one[1].variant, sorted(one[1].data.settings.items())))
        found |= zip((n for n, _ in ordered), _class(task, [student for _, student in ordered]), strict=True)
    return [found[number] for number in sorted(found)]


def _class(task: str, students: list[Student]) -> Iterator[Outcome]:
    with tempfile.TemporaryDirectory() as folder:
        roster, answers = Path(folder) / "roster.csv", Path(folder) / "class.csv"
        first = next(iter(load_task(task).variants))
        rows = [{"student": f"S{i}", "variant": s.variant or first} for i, s in enumerate(students)]
        _write(roster, [row | s.data.settings for row, s in zip(rows, students, strict=True)])
        _write(answers, [row | dict(cells(s)) for row, s in zip(rows, students, strict=True)])
        asked = check(task, roster=roster, lang="en")
        desk, handed_in = Desk(asked), {read.who.student: read for read in asked.read(str(answers))}
        for i, student in enumerate(students):
            yield _outcome(student, desk.mark(handed_in[f"S{i}"]))


def _outcome(student: Student, result: Marked) -> Outcome:
    first = result.marking.first_wrong or ""
    lines = [line for line in result.lines if line.answer is not None]
    moves = student.moved
    clearly = next((line.name for line in result.marking.lines if moves.get(line.name, 0.0) >= CLEAR), "")
    order = [line.name for line in result.marking.lines]
    step = bool(first and clearly) and moves.get(first, 0.0) >= TOUCHED and order.index(first) <= order.index(clearly)
    return Outcome(
        student.task,
        tuple(slip.id for slip in student.slips),
        tuple(f"{slip.at} {slip.way}".strip() for slip in student.slips),
        result.mark,
        len(lines),
        sum(line.verdict.passed for line in lines),
        first,
        step,
        frozenset(result.candidates[0].ids) if result.candidates else frozenset(),
        result.fits,
    )


def cells(student: Student) -> Iterator[tuple[str, str]]:
    """Go through what a student writes: scale factors, millimetres, values; directions and signs where told."""
    sheet = student.sheet
    for plan, mu in sheet.mus.items():
        yield SYMBOLS.get(plan, plan), f"{mu:.10g}"
    for name, line in sheet.lines.items():
        if line.mm is not None:
            yield f"{name}.mm", f"{line.mm:.10g}"
        if named_value(name):
            yield name, _value(line, student.told)
        if student.told and line.degrees is not None:
            yield f"{name}.dir", f"{line.degrees:g}"


def _value(line: Line, told: bool) -> str:
    if line.vector is not None or not told or not line.value or line.mm is not None:
        return f"{abs(line.value):.10g}"
    return f"{line.value:+.10g}"


def _write(file: Path, rows: list[dict[str, str]]) -> None:
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with file.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, columns, delimiter=";", restval="")
        writer.writeheader()
        writer.writerows(rows)


def swapped_sheets(task: str, count: int, dice: random.Random) -> Iterator[Student]:
    """Go through students who hand in an honest sheet of another variant of the task."""
    variants = list(load_task(task).variants)
    for _ in range(count):
        own, other = dice.sample(variants, 2)
        data = printed(task, other)
        sheet = drawn(task, data.givens, Hand(dice), (), scale_factors(task, data.givens, (), dice))
        yield Student(task, Data({}, {}), (), sheet, True, {}, own)


def printed(task: str, variant: str) -> Data:
    """Return the data of a bundled variant."""
    loaded = load_task(task)
    values, factors = loaded.resolve(variant), {"deg": 180.0 / 3.141592653589793, "rpm": 30.0 / 3.141592653589793}
    written, turn, side = {}, 1, 1
    for name, given in loaded.givens.items():
        if given.unit is None:
            continue
        scale = {"mm": 1e3, "kN": 1e-3}.get(given.unit.name) or factors.get(given.unit.name, 1.0)
        written[name] = float(f"{float(values[name]) * scale:.12g}")
    if task == "nau-slider-crank":
        turn, side = (1 if values["rotation"] == "ccw" else -1), (1 if values["side"] == "right" else -1)
    return data_of(task, written, turn, side)


def share(outcomes: Sequence[Outcome], counts: Callable[[Outcome], bool]) -> float:
    """Return the percentage of students of whom something holds."""
    return 100.0 * sum(map(counts, outcomes)) / max(len(outcomes), 1)


def population(group: str, name: str, count: int, dice: random.Random, part: tuple[int, int] = (0, 1)) -> list[Student]:
    """Draw one kind of students: `name` is a mistake, of the groups `one` and `sizes`, or a task.

    `part` is which of several parts of all variants they have, and of how many.
    """
    tasks = [task for task in SLIPS if name in kinds(task)] if group in ("one", "sizes") else [name]
    some = {task: pool(task)[part[0] :: part[1]] for task in tasks}
    if group in ("one", "sizes"):
        chosen = [tasks[i % len(tasks)] for i in range(count)]
        found = [one_mistake(task, name, dice, some[task], group == "one") for task in chosen]
        return [student for student in found if student is not None]
    if group == "other":
        return list(swapped_sheets(name, count, dice))
    draw = {"honest": honest, "two": two_mistakes, "random": at_random}[group]
    return [draw(name, dice, some[name]) for _ in range(count)]


def one_mistake(
    task: str, id: str, dice: random.Random, among: Sequence[Data] = (), told: bool = True
) -> Student | None:
    """Draw a student with one mistake; None where it moves no line clearly, as in sizes one of a sense."""
    slips = kinds(task)[id]
    return mistaken(task, lambda: (dice.choice(slips),), dice, among, told)


def two_mistakes(task: str, dice: random.Random, among: Sequence[Data] = ()) -> Student:
    """Draw a student with two mistakes of different numbers."""
    of_task = kinds(task)

    def choose() -> tuple[Slip, ...]:
        return tuple(dice.choice(of_task[id]) for id in dice.sample(sorted(of_task), 2))

    student = mistaken(task, choose, dice, among)
    assert student is not None
    return student
