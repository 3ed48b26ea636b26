"""Many states of a variant at once: arrays of givens in, arrays of quantities with their units out."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..drawing.words import Words
from ..plans.board import POINTS
from ..plans.boards.arrays import CODES
from ..plans.boards.batch import batch
from ..plans.boards.exact import STATUSES
from ..plans.linkages.chain import constructed
from ..plans.linkages.mechanism import Mechanism
from ..plans.linkages.solved import board_givens
from ..plans.quantities import Quantity, results, unit_of
from ..plans.solved import Columned
from ..scales.errors import InputError, Written
from ..scales.names import all_known, by_name, named, names_of, of_its_kinds, unknown, unknown_given
from ..scales.numbers import quote
from ..scales.series import Series
from ..scales.units import UnitName, converted, parse, unit
from .case import Case, Request, Wanted
from .reader import load_task
from .tables import Arrays, html_table
from .task import AnyTask, Given, LocatedError, Task

Array = NDArray[Any]
Many = str | float | ArrayLike | tuple[ArrayLike, str]  # "190 mm"; numbers in SI; numbers, and their unit


USUAL = 2.0  # times more, or less, than the variants have, that is usual


class Status(StrEnum):
    """What can be said of a state: `solution.status == Status.OK`."""

    OK = "ok"
    ILL_CONDITIONED = "ill-conditioned"
    SINGULAR = "singular"
    NO_ASSEMBLY = "no-assembly"


@dataclass(frozen=True, slots=True, repr=False)
class ManyStates(Arrays):
    """States of one variant; `states["V_B"]` is a `Series` of the shape to which the givens broadcast.

    `given` are the givens that are arrays, SI; `values` what was wanted of each state, vectors and points complex, NaN
    where there is no plan. `points` are the names that are places, not vectors. `states["m_2"]` is a given, too, which
    is the same for all states and has no column.
    """

    given: Mapping[str, Array]
    values: Mapping[str, Array]
    codes: NDArray[np.int8]
    points: frozenset[str]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of all arrays."""
        return self.codes.shape

    def __len__(self) -> int:
        """Return the number of states, without a word for each."""
        return int(self.codes.size)

    @property
    def statuses(self) -> NDArray[np.str_]:
        """The status of each state, the words of `kulman.Status`."""
        return np.array(STATUSES)[self.codes]

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Where there is a plan."""
        return self.codes < CODES["singular"]

    @property
    def status(self) -> str:
        """The best status of all states."""
        return STATUSES[int(self.codes.min(initial=len(STATUSES) - 1))]

    def arrays(self, name: str = "") -> Iterator[Columned]:
        """Go through the givens that are arrays and all that was wanted, SI, or find the one that is asked for."""
        for given in (given for given in self.given if name in ("", given)):
            stated = self.task.givens[given].unit
            values = np.broadcast_to(self.given[given], self.shape)
            yield Columned(given, "" if stated is None else stated.si.name, values)
        for found in (found for found in self.values if name in ("", found, f"{found}.x", f"{found}.y")):
            for part, values in parts_of(self.values[found], found in self.points).items():
                yield Columned(found if part == "value" else f"{found}.{part}", unit_of(found), values)
        same = self.task.givens.get(name) if name not in self.given else None
        if same is not None and same.unit is not None:  # only where it is asked for
            yield Columned(name, same.unit.si.name, np.broadcast_to(self.case.values[name], self.shape))

    def _columns(self, words: Words) -> tuple[Sequence[Columned], Mapping[str, Sequence[str]]]:
        return [*self.arrays()], {"status": self.statuses.ravel().tolist()}

    def _data(self) -> dict[str, Any]:
        """Return the shape, and all columns in it."""
        columns = {column.name: {"unit": column.unit, "value": column.values} for column in self.arrays()}
        return {"shape": self.shape, "statuses": self.statuses, "columns": columns}

    def table(self, language: str | None = None) -> str:
        """Return how many states have which status."""
        words, counts = self._words(language), np.bincount(self.codes.ravel(), minlength=len(STATUSES))
        found = (pair for pair in zip(STATUSES, counts.tolist(), strict=True) if pair[1])
        return "\n".join(f"{words.texts.get(f'status.{status}', status)}: {count}" for status, count in found)

    def _repr_html_(self) -> str:
        """Show the range of each column in a notebook, in the units of the task, and how many states have no plan."""
        words = self.words
        rows = [["", words["table.unit"], words["sweep.least"], words["sweep.most"]]]
        for column in self.arrays():
            finite = column.values[np.isfinite(column.values)]
            ends = (finite.min(), finite.max()) if finite.size else ()
            shown = (words.short(words.display.value(float(end), column.unit), 6) for end in ends)
            rows.append([column.name, words.spelled(words.display.unit(column.unit)), *shown])
        return html_table(rows) + "".join(f"<p>{escape(line)}</p>" for line in self.table().split("\n"))

    def __repr__(self) -> str:
        """Return task, variant, the shape, and of how many states there is a plan."""
        return f"<ManyStates {self.task.id} {self.variant}: {self.shape}, {int(self.ok.sum())} with a plan>"


def parts_of(values: Array, point: bool = False) -> dict[str, Array]:
    """Return the values of a quantity: of a vector its size and components, of a point its coordinates."""
    if not np.iscomplexobj(values):
        return {"value": values}
    size = {} if point else {"value": np.hypot(values.real, values.imag)}
    return {**size, "x": values.real, "y": values.imag}


@of_its_kinds()
def solve_many(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Mapping[str, Many] | None = None,
    only: Wanted = None,
    names: Wanted = None,
    lang: str | None = None,
    **givens: Many,
) -> ManyStates:
    """Solve a linkage for many values of its givens at once, by the construction that `solve` draws.

    Parameters
    ----------
    task, variant, only, lang
        As for `solve`.
    set : mapping, optional
        As for `solve`, `{"l_OA": "55 mm"}`; also numbers and their unit, `{"phi": ([0, 45, 90], "deg")}`.
    names : str or iterable of str, optional
        The quantities and points wanted, `"V_B,M_bal"`; all of the plans without it. Fewer are found sooner. A
        component, `"B.x"`, comes with the whole.
    **givens : str, number, array, or a pair of these and a unit
        The same by keyword, where numbers alone are in SI: `phi=numpy.linspace(0, 6.28, 361)`. They broadcast, and go
        before `set`, in which numbers alone would be in the unit of the task, as on the command line: they have to say
        theirs.

    Returns
    -------
    ManyStates
        `states["V_B"]` is a `Series` of the shape of the broadcast givens, `states.statuses` tells of each state
        whether it has a plan.

    Raises
    ------
    InputError
        As for `solve`; also arrays that do not broadcast, values that are no numbers, a task that is no linkage.

    Warns
    -----
    UserWarning
        A number would be usual in the unit of the task, and is not in SI: 55 metres where variants have 55 mm.

    >>> from kulman import solve_many
    >>> states = solve_many("nau-slider-crank", "example", phi=([0, 45, 90], "deg"), names="V_B")
    >>> states["V_B"].round(3).tolist()
    [0.0, 2.032, 4.006]
    >>> solve_many("nau-slider-crank", "example", set={"phi": ([0, 45, 90], "deg")}, names="V_B").shape
    (3,)
    """
    asked, read = load_task(task), dict[str, Array]()
    if not isinstance(asked.subject, Mechanism):
        raise InputError("many-linkages", task=quote(asked.id))
    first = {named(name, asked.givens): value for name, value in by_name("set", set).items()}
    givens = {named(name, asked.givens): value for name, value in givens.items()}
    for name, value in {**first, **givens}.items():
        if name not in asked.givens:
            raise unknown_given(name, asked.givens, asked.id)
        of = asked.givens[name].unit
        if isinstance(value, Quantity) and value.kind != "point":
            value = float(value), value.unit
        if of is None or (name not in givens and isinstance(value, str)):  # a word, or read with the data
            first[name] = value
            continue
        if name not in givens and of.name and not isinstance(value, (tuple, Series)):  # degrees here, radians there
            way = f'"{value:g} {of.name}"' if isinstance(value, (int, float)) else f'(..., "{of.name}")'
            raise LocatedError(name, InputError("number-of-what", text=quote(value), way=Written(way)))
        try:
            read[name] = _in_si(asked.givens[name], value)
        except InputError as error:
            raise LocatedError(name, error) from error
        first[name] = of.from_si(float(read[name].flat[0]))
    bare = ((name, read[name], value) for name, value in givens.items() if name in read)
    for said in (said for name, array, value in bare for said in _of_another_unit(asked, name, array, value)):
        warnings.warn(str(said), stacklevel=3)  # of who calls, past what holds kinds of arguments
    case = Request(asked, variant, first, only, language="en" if lang is None else lang).case()
    try:
        shape = np.broadcast_shapes(*(array.shape for array in read.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in read.items())
        raise InputError("arrays-shapes", text=shapes) from None
    return _solved(case, read, shape, names_of("names", names))


def _in_si(given: Given, value: Any) -> Array:
    """Return the values of a given in SI, each within its bounds."""
    assert given.unit is not None
    if isinstance(value, str):
        return np.asarray(parse(value, given.unit))
    own, of = (value, value.unit) if isinstance(value, Series) else (value, given.unit.si.name)
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str):
        own, of = value
    one = converted(1.0, unit(of), given.unit)
    try:
        plain = np.asarray(own)
        if plain.dtype == bool:
            raise TypeError
        plain = plain.astype(float, casting="unsafe" if plain.dtype == object else "same_kind")  # no complex, no text
        array = plain * one
    except (TypeError, ValueError):
        raise InputError(
            "type-quantity-array", expected=UnitName(given.unit.si.name), other=Written(given.unit.name)
        ) from None
    if not array.size:
        raise InputError("array-empty")
    least, most = int(np.argmin(array)), int(np.argmax(array))
    across = [int(np.argmin(np.abs(array)))] if array.flat[least] < 0.0 < array.flat[most] else []  # nearest to zero
    for worst in {least, most, *across}:
        try:
            given.read(given.unit.from_si(float(array.flat[worst])))  # refuses what is none, or out of bounds
        except InputError as refused:
            error = InputError(refused.key, **{**refused.data, "text": quote(f"{plain.flat[worst]:.7g} {of}")})
            place = ", ".join(map(str, np.unravel_index(worst, array.shape)))
            raise (LocatedError(f"[{place}]", error) if place else error) from refused
    return array


def _of_another_unit(task: Task, name: str, array: Array, value: Any) -> Iterator[LocatedError]:
    """Go through the number, if any, that is no usual one in SI, but would be in the unit of the task: l_OA = 55."""
    given = task.givens[name]
    found = (variant.values.get(name) for variant in task.variants.values())
    sizes = [abs(size) for size in found if size and not isinstance(size, str)]
    if given.unit is None or given.unit == given.unit.si or isinstance(value, (str, tuple, Series)) or not sizes:
        return
    least, most = min(sizes) / USUAL, max(sizes) * USUAL
    worst = float(max(-array.min(), array.max()))
    if not least <= worst <= most and least <= converted(worst, given.unit, given.unit.si) <= most:
        own, si = UnitName(given.unit.name), UnitName(given.unit.si.name)
        example = f'{name}="{worst:g} {given.unit.name}"', f'{name}=(..., "{given.unit.name}")'
        ways = tuple(map(Written, example))
        yield LocatedError(name, InputError("many-unit", text=f"{worst:g}", unit=own, si=si, known=ways))


def _solved(case: Case, read: Mapping[str, Array], shape: tuple[int, ...], wanted: tuple[str, ...]) -> ManyStates:
    mechanism = case.task.mechanism
    values: dict[str, Any] = {**case.values, **{name: float(a) for name, a in read.items() if not a.ndim}}
    values |= {name: np.broadcast_to(array, shape).ravel() for name, array in read.items() if array.ndim}
    if not any(array.ndim for array in read.values()):  # one state
        values[mechanism.driver.coordinate] = np.full(1, values[mechanism.driver.coordinate])
    _, program = constructed(mechanism, case.plans)
    known = {step.name: step.verb in POINTS for step in results(program)}
    parts = {f"{name}.{axis}": name for name in known for axis in "xy"}
    parts = {name: parts[name] for name in wanted if name in parts}
    wanted = tuple(dict.fromkeys(parts.get(name, name) for name in wanted))
    all_known("quantity-unknown", wanted, known)
    wanted = wanted or tuple(known)
    program = program.needed_for(wanted)  # so that strokes are found only where they count
    found, codes = batch(program, board_givens(mechanism, values, program), wanted)
    for name, whole in parts.items():  # a component comes with the others; a number has none
        if not np.iscomplexobj(found[whole]):
            raise unknown("quantity-unknown", name, known)
    return ManyStates(
        case,
        case.words(),
        {name: array for name, array in read.items() if array.ndim},
        {name: array.reshape(shape) for name, array in found.items()},
        codes.reshape(shape),
        frozenset(name for name, point in known.items() if point),
    )
