"""A tape of real operations done on arrays, chunk by chunk, in few buffers, so that a chunk stays in the cache."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from .arithmetic import Entry, Real, Vector

PADDING = 72  # numbers between two buffers, lest all of them begin at the same place of a memory page
Array = NDArray[np.float64]
Call = tuple[Callable[..., Any], tuple[Any, ...]]
LATER: Call = (tuple, ())  # the place of a call that depends on the chunk


@dataclass(frozen=True, slots=True, eq=False)
class Store:
    """Where a number of the tape goes: an array, or one part of a complex one, of all positions."""

    place: int
    negative: bool
    into: Array

    def call(self, row: Array, part: slice) -> Call:
        """Return what stores a chunk; zeros lose their sign."""
        return (np.subtract, (0.0, row, self.into[part])) if self.negative else (np.add, (row, 0.0, self.into[part]))


class Chunks:
    """What `stores` need of a tape, ready to be done for one chunk after another.

    Parameters
    ----------
    arrays : mapping of str to float64 array of shape (N,)
        What the givens of the tape stand for.
    chunk : int
        Positions at a time, at most.
    number : dtype
        Of all numbers.
    """

    def __init__(
        self,
        entries: Sequence[Entry],
        stores: Iterable[Store],
        arrays: Mapping[str, Array],
        chunk: int,
        number: DTypeLike = float,
    ) -> None:
        self._entries, self._arrays = entries, arrays
        self._stores: dict[int, list[Store]] = {}
        for store in stores:
            self._stores.setdefault(store.place, []).append(store)
        self._order = _in_order(entries, self._stores)
        self._buffer_of = _buffers(entries, self._order)
        self._block = np.empty((1 + max(self._buffer_of.values(), default=0), chunk + PADDING), number)
        self._constants = {
            place: np.array(entry.constant, number) for place, entry in enumerate(entries) if entry.constant is not None
        }
        self._calls: list[Call] = []
        self._moving: list[tuple[int, Callable[[slice], Call]]] = []
        self._size = 0

    def do(self, part: slice) -> None:
        """Do the operations for a part of the positions."""
        if part.stop - part.start != self._size:
            self._bind(part.stop - part.start)
        calls = self._calls
        for index, call in self._moving:
            calls[index] = call(part)
        for function, operands in calls:
            function(*operands)

    def _bind(self, size: int) -> None:
        """Settle the calls for chunks of a size, and which of them change from chunk to chunk."""
        self._size, self._calls, self._moving = size, [], []
        buffers = [buffer[:size] for buffer in self._block]  # the very arrays: a check returns the one it was given
        rows = self._constants | {place: buffers[number] for place, number in self._buffer_of.items()}
        for place in self._order:
            self._add(partial(self._operation, place, rows), any(o not in rows for o in self._entries[place].operands))
            for store in self._stores.get(place, []):
                self._add(partial(self._storing, place, store, rows), True)

    def _add(self, call: Callable[[slice], Call], moves: bool) -> None:
        """Settle a call, now or for each chunk."""
        if moves:
            self._moving.append((len(self._calls), call))
        self._calls.append(LATER if moves else call(slice(0)))

    def _operation(self, place: int, rows: Mapping[int, Array], part: slice) -> Call:
        """Return what does an entry; arrays that are given are read where they lie."""
        entry = self._entries[place]
        if entry.operation is None:
            return LATER
        operands = tuple([rows[o] if o in rows else self._given(o, part) for o in entry.operands])
        if isinstance(entry.operation, np.ufunc) or entry.fills:
            return entry.operation, (*operands, rows[place])
        return _keep, (rows[place], entry.operation, operands)

    def _storing(self, place: int, store: Store, rows: Mapping[int, Array], part: slice) -> Call:
        return store.call(rows[place] if place in rows else self._given(place, part), part)

    def _given(self, place: int, part: slice) -> Array:
        return self._arrays[self._entries[place].given][part]


def room(value: Any, size: int, kind: DTypeLike = float) -> tuple[NDArray[Any], list[Store]]:
    """Return an array for a value at all positions, filled where it is the same everywhere, and what fills the rest.

    `kind` is the type of its numbers, real ones.
    """
    vectors = np.result_type(kind, np.complex64)
    if not isinstance(value, (Real, Vector)):
        return np.full(size, value + type(value)(), vectors if isinstance(value, complex) else kind), []
    if isinstance(value, Real):
        room = np.empty(size, kind)
        return room, [Store(value.place, value.negative, room)]
    points, stores = np.empty(size, vectors), []
    for number, into in ((value.real, points.real), (value.imag, points.imag)):
        if isinstance(number, Real):
            stores.append(Store(number.place, number.negative, into))
        else:
            into[:] = number + 0.0
    return points, stores


def _keep(row: Array, operation: Callable[..., Any], operands: tuple[Any, ...]) -> None:
    """Put the result of an operation that chooses its own memory into its row."""
    result = operation(*operands)
    if result is not row:
        np.copyto(row, result)


def _in_order(entries: Sequence[Entry], wanted: Collection[int]) -> list[int]:
    """Return the entries that `wanted` and the checks need, constants apart, each as late as it is asked for."""
    order: list[int] = []
    done = {place for place, entry in enumerate(entries) if entry.constant is not None}
    for root, entry in enumerate(entries):
        waiting = [root] if root in wanted or entry.check else []
        while waiting:
            place = waiting[-1]
            first = [operand for operand in entries[place].operands if operand not in done]
            if first:
                waiting += reversed(first)
                continue
            waiting.pop()
            if place not in done:
                done.add(place)
                order.append(place)
    return order


def _buffers(entries: Sequence[Entry], order: Sequence[int]) -> dict[int, int]:
    """Give each entry a buffer; what nothing needs any more hands its own on, first operands last, so used first."""
    last = {operand: place for place in order for operand in entries[place].operands}
    buffer_of: dict[int, int] = {}
    free: list[int] = []
    count = 0
    for place in order:
        if entries[place].given:  # it is read where it lies
            continue
        for operand in dict.fromkeys(reversed(entries[place].operands)):
            if operand in buffer_of and last[operand] == place:
                free.append(buffer_of[operand])
        if not free:
            free.append(count)
            count += 1
        buffer_of[place] = free.pop()
        if place not in last:
            free.append(buffer_of[place])
    return buffer_of
