"""A case: one variant of a task, solved for the plans wanted, with the givens and scale factors that were asked for."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ..drawing.words import Given, Words
from ..plans.names import role
from ..plans.solved import Solved
from ..scales.arguments import of_kind
from ..scales.choose import Chooser, Segment, chooser, segment_symbol
from ..scales.display import Display
from ..scales.errors import InputError
from ..scales.names import unknown
from ..scales.numbers import quote
from .kinds import kind_of
from .kinds.kind import Kind
from .reader import load_task
from .task import WITH_FORCES, LocatedError, Task

Settings = Mapping[str, str | float]


@dataclass(frozen=True, slots=True)
class Case:
    """One variant of a task in one position; `settings` replace givens, `choosers` are by scale factor."""

    task: Task
    variant: str
    settings: Settings
    plans: tuple[str, ...]
    solved: Solved
    choosers: Mapping[str, Chooser]

    @property
    def givens(self) -> dict[str, Given]:
        """The givens as the task states them, each in its own unit."""
        stated = {}
        for name, value in self.task.resolve(self.variant, self.settings).items():
            unit = self.task.givens[name].unit
            if isinstance(value, str) or unit is None:
                stated[name] = Given(str(value))
            else:
                stated[name] = Given(float(f"{unit.from_si(value):.12g}"), unit.name)
        return stated

    @property
    def display(self) -> Display:
        """The units of results: those of the task, but SI where forces are wanted."""
        return Display(paper=self.task.display.paper) if WITH_FORCES.intersection(self.plans) else self.task.display

    def words(self, lang: str | None = None, notation: str | None = None) -> Words:
        """Return the words of results in their units: English ones and the task's notation where none is said.

        Raises
        ------
        InputError
            There is no such language or notation.
        """
        words = Words.of("en" if lang is None else lang, self.task.notation if notation is None else notation)
        return words.showing(self.display)

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a user should know of what has been solved: lines that meet at a small angle."""
        return self.kind.warnings(self.solved)

    @property
    def kind(self) -> Kind[Any, Any]:
        """Of which kind the task is."""
        return kind_of(self.task.kind)


def solve_case(
    task: str | os.PathLike[str] | Task,
    variant: str | None,
    settings: Settings | None,
    only: str | Iterable[str] | None,
    scales: Settings | None,
) -> Case:
    """Read a task and solve one variant of it; the arguments are those of `solve`.

    Raises
    ------
    InputError
        An unknown task, variant, given, plan or scale factor, or a value of the wrong kind.
    """
    found = task if isinstance(task, Task) else load_task(task)
    of_kind("variant", variant, (str, int, type(None)), "str | None")
    row = found.variant(variant)
    changed = by_name("set", settings)
    kind = kind_of(found.kind)
    plans = plans_wanted(only, found.plans, kind.plans)
    solved = kind.solve(found.subject, found.values(row.id, changed), found.words(row.id, changed), plans)
    return Case(found, row.id, changed, plans, solved, _choosers(found, by_name("scales", scales), solved))


def _choosers(task: Task, scales: Settings, solved: Solved) -> dict[str, Chooser]:
    """Return how each scale factor is chosen: as the task says, unless the user says otherwise."""
    choosers = {symbol: chooser(symbol, text) for symbol, text in task.scales.items()}
    for name, text in scales.items():
        _choosable(task, name, text, solved)
        try:
            symbol = name if role(name).kind == "mu" else segment_symbol(name)
            chosen = chooser(symbol, str(text) if symbol == name else f"{name}={text}", firm=True)
            shown = {*solved.values, *solved.quantities}
            drawn = symbol in solved.scale_of_plan.values()
            if drawn and isinstance(chosen, Segment) and chosen.quantity not in shown:
                raise InputError("scale-segment", text=quote(name))
        except InputError as error:
            raise LocatedError(name, error) from error
        if not drawn:
            known = ", ".join(dict.fromkeys(solved.scale_of_plan.values())) or "-"
            raise InputError("scale-not-drawn", text=quote(name), known=known)
        choosers[symbol] = chosen
    return choosers


def _choosable(task: Task, name: str, text: str | float, solved: Solved) -> None:
    """Refuse a scale factor that a task has not or that is found, and a segment where none chooses a scale factor."""
    kind = kind_of(task.kind)
    known = kind.scale_symbols(solved)
    if role(name).kind == "mu" and name not in known:
        if name in solved.quantities:
            raise InputError("scale-follows", symbol=name, known=", ".join(known))
        raise unknown("scale-unknown", name, known, task=task.id)
    segment = name if role(name).kind != "mu" else str(text) if "=" in str(text) else ""
    if segment and not kind.segments:
        raise InputError("scale-no-segments", text=quote(segment), known=", ".join(known))


def by_name(name: str, value: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the argument `name`, a mapping from names, as a dict; nothing for None."""
    if value is None:
        return {}
    of_kind(name, value, (Mapping,), "dict[str, ...]")
    for key in value:
        of_kind(name, key, (str,), "dict[str, ...]")
    return dict(value)


def names_of(
    argument: str, value: str | Iterable[str | int] | None, kinds: tuple[type, ...] = (str,)
) -> tuple[str, ...]:
    """Return names that are given each alone or several with commas between; none for None.

    Raises
    ------
    InputError
        The value, or one of several, is of no kind of names; `kinds` are those of one.
    """
    if value is None:
        return ()
    of_kind(argument, value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    for item in items:
        of_kind(argument, item, kinds, "list[str]")
    return tuple(dict.fromkeys(one.strip() for item in items for one in str(item).split(",") if one.strip()))


def all_known(key: str, names: Iterable[str], known: Collection[str]) -> None:
    """Refuse, with the message `key`, the first of the names that is not known."""
    for name in names:
        if name not in known:
            raise unknown(key, name, known)


def positions_of(argument: str, value: int) -> int:
    """Return a number of positions or sections of a cycle.

    Raises
    ------
    InputError
        There is no cycle of so many.
    """
    from ..plans.linkages.cycles.cycle import FEWEST, MOST  # brings numpy, which most commands do without

    of_kind(argument, value, (int,), "int")
    if not FEWEST <= value <= MOST:
        raise InputError("positions-number", n=quote(value), least=FEWEST, most=MOST)
    return value


def plans_wanted(
    value: str | Iterable[str] | None, all_of_them: tuple[str, ...], known: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the plans that `only` names, each alone or several with commas between; `all_of_them` for none.

    Those that can be named are `known`.

    Raises
    ------
    InputError
        There is no such plan.
    """
    if value is None:
        return all_of_them
    of_kind("only", value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    plans = names_of("only", items)
    all_known("plan-unknown", plans or items[:1], known)
    return plans or all_of_them
