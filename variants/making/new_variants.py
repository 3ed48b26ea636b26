"""New variants of a task: made from ranges, or read from a spreadsheet; as a task file, with what is wrong."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from ...scales.arguments import of_kind
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import quote
from ..arguments import by_name
from ..case import Settings
from ..crew import Advance
from ..reader import TaskFileError, load_task, read_text
from ..task import LocatedError, Task
from .ranges import looked_at, made, most_pages, ranges_of
from .table_in import Read, read_variants
from .task_text import with_variants

MOST = 1000  # variants that are made at once


@dataclass(frozen=True, slots=True)
class NewVariants:
    """A task with new variants, the text of its file, and what is wrong with those left out or kept all the same."""

    task: Task
    text: str
    left_out: tuple[KulmanError, ...] = ()
    remarks: tuple[KulmanError, ...] = ()


def make_variants(
    task: str | os.PathLike[str] | Task,
    count: int,
    ranges: Settings | None = None,
    *,
    set: Settings | None = None,
    seed: int = 1,
    advance: Advance | None = None,
) -> NewVariants:
    """Make variants from ranges, each a good exercise: it can be solved and drawn on one sheet without a warning.

    A crank turns round, lines meet at angles over 20 degrees, plans fit at the scale factors that the task wants, and
    what the task's kind calls good design holds.

    Parameters
    ----------
    count : int
        How many, up to 1000.
    ranges : mapping, optional
        `{"l_OA": "25..60/5 mm"}`: from, to, and a step; of other givens what the task's variants span.
    set : mapping, optional
        Givens that all new variants have alike.
    seed : int
        The same seed gives the same variants.

    Raises
    ------
    InputError
        A range is wrong, or too few sets of data are good.
    """
    found = task if isinstance(task, Task) else load_task(task)
    of_kind("count", count, (int,), "int")
    if not 1 <= count <= MOST:
        raise InputError("variants-count", n=MOST)
    fixed = {name: str(value) for name, value in by_name("set", set).items()}
    found.resolve(None, fixed)
    spans = ranges_of(found, {name: str(text) for name, text in by_name("ranges", ranges).items()})
    spans = {name: one for name, one in spans.items() if name not in fixed}
    rows: list[tuple[str, Mapping[str, str]]] = []
    for row in made(found, spans, count, seed, fixed):
        rows.append((str(len(rows) + 1), row))
        if advance is not None:
            advance(1, count)
    return _task_with(found, dict(rows))


def import_variants(task: str | os.PathLike[str] | Task, file: str | os.PathLike[str]) -> NewVariants:
    """Read variants from a spreadsheet; those that have no solution are left out and named.

    Raises
    ------
    InputError
        The file cannot be read, names no given of the task, or none of its variants can be solved.
    """
    found = task if isinstance(task, Task) else load_task(task)
    rows: dict[str, Mapping[str, str]] = {}
    pages = most_pages(found)
    left_out: list[KulmanError] = []
    remarks: list[KulmanError] = []
    for read in read_variants(os.fspath(file), found):
        reasons, remark = _judged(found, read, pages)
        if not reasons and read.id in rows:
            reasons = (InputError("variant-twice"),)
        left_out.extend(_at(read, reason) for reason in reasons)
        if remark is not None:
            remarks.append(_at(read, remark))
        if not reasons:
            rows[read.id] = read.row
    if not rows:
        raise left_out[0] if left_out else InputError("answers-empty", file=quote(os.fspath(file)))
    return replace(_task_with(found, rows), left_out=tuple(left_out), remarks=tuple(remarks))


def _judged(task: Task, read: Read, pages: Callable[[], int]) -> tuple[tuple[KulmanError, ...], KulmanError | None]:
    """Return why a variant is left out, if it is, and what makes it a poor exercise."""
    if read.problems:
        return read.problems, None
    try:
        alone = _task_with(task, {read.id: read.row}).task
    except TaskFileError as error:
        return tuple(map(_plainly, error.faults)), None
    reason, remark = looked_at(alone, read.id, {}, pages)
    return (() if reason is None else (reason,)), remark


def _plainly(fault: InputError) -> KulmanError:
    """Return a fault of a task file as one of a spreadsheet, which has no lines and keys."""
    cause = fault.cause if isinstance(fault, LocatedError) else fault
    return InputError("variants-missing", name=cause.data["name"]) if cause.key == "key-missing" else cause


def _at(read: Read, error: KulmanError) -> KulmanError:
    """Return an error with the variant's place before it, unless it says a cell."""
    if isinstance(error, LocatedError) and error in read.problems:
        return error
    return LocatedError(read.place, error)


def _task_with(task: Task, rows: Mapping[str, Mapping[str, str]]) -> NewVariants:
    """Return a task with other variants.

    Raises
    ------
    TaskFileError
        One of them is no variant of the task.
    """
    text = with_variants(task.text, rows.items())
    file = task.file or f"{task.id}.toml"
    found, faults = read_text(text, file)
    if found is None:
        raise TaskFileError(file, faults)
    return NewVariants(found, text)
