"""What is asked of a task, and a case: one variant of it solved for the plans wanted."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

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
from .task import WITH_FORCES, LocatedError, Task

if TYPE_CHECKING:
    from ..drawing.formats import Format
    from ..drawing.pens import Norm

Settings = Mapping[str, str | float]


@dataclass(frozen=True, slots=True)
class Request:
    """What is asked of a task, by the keywords that every function of the package has; `block` is for title blocks."""

    task: Task
    variant: str | None = None
    settings: Settings | None = None  # in the place of givens
    only: str | Iterable[str] | None = None
    scales: Settings | None = None
    notation: str | None = None
    language: str = "uk"
    format: str | Format | None = None
    norm: Norm = "gost"
    block: Mapping[str, str] = field(default_factory=dict)

    def case(self) -> Case:
        """Solve what is asked for; what there is not, or is of the wrong kind, is refused."""
        task = self.task
        of_kind("variant", self.variant, (str, int, type(None)), "str | None")
        variant, settings = task.variant(self.variant).id, by_name("set", self.settings)
        plans = plans_wanted(self.only, task)
        values, words = task.values(variant, settings), task.words(variant, settings)
        solved = kind_of(task.kind).solve(task.subject, values, words, plans)
        choosers = _choosers(task, by_name("scales", self.scales), solved)
        asked = {item.name: getattr(self, item.name) for item in fields(self)}
        return Case(**asked | {"variant": variant, "settings": settings}, plans=plans, solved=solved, choosers=choosers)


@dataclass(frozen=True, slots=True)
class Case(Request):
    """One variant of a task in one position; `choosers` are by scale factor."""

    variant: str = ""
    settings: Settings = field(default_factory=dict)
    plans: tuple[str, ...] = field(kw_only=True)
    solved: Solved = field(kw_only=True)
    choosers: Mapping[str, Chooser] = field(kw_only=True)

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

    def words(self, language: str | None = None) -> Words:
        """Return the words of results in their units; in the language that was asked for where none is said."""
        notation = self.task.notation if self.notation is None else self.notation
        return Words.of(self.language if language is None else language, notation).showing(self.display)

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a user should know of what has been solved: lines that meet at a small angle."""
        return self.kind.warnings(self.solved)

    @property
    def kind(self) -> Kind[Any, Any]:
        """Of which kind the task is."""
        return kind_of(self.task.kind)


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
    """Return names that are given each alone or several with commas between, each of these `kinds`; none for None."""
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
    """Return a number of positions or sections that a cycle can have."""
    from ..plans.linkages.cycles.cycle import FEWEST, MOST  # brings numpy, which most commands do without

    of_kind(argument, value, (int,), "int")
    if not FEWEST <= value <= MOST:
        raise InputError("positions-number", n=quote(value), least=FEWEST, most=MOST)
    return value


def plans_wanted(value: str | Iterable[str] | None, task: Task) -> tuple[str, ...]:
    """Return the plans that `only` names, each alone or several with commas between; all of the task for none."""
    if value is None:
        return task.plans
    of_kind("only", value, (str, Iterable), "list[str]")
    items = (value,) if isinstance(value, str) else tuple(value)
    plans = names_of("only", items)
    all_known("plan-unknown", plans or items[:1], kind_of(task.kind).plans)
    return plans or task.plans
