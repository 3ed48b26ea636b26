"""Work shared out among processes, a few items at a time; an item that kills its process is found out and left."""

from __future__ import annotations

import multiprocessing
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.process import BaseProcess
from threading import Thread
from typing import Any, Generic, Protocol, TypeVar

Item = TypeVar("Item")
ItemIn = TypeVar("ItemIn", contravariant=True)
Made = TypeVar("Made")
MadeOut = TypeVar("MadeOut", covariant=True)
TOGETHER = 8  # items that a process is given at once
ALONE = 16  # items for which no process is started
WAITING = 3  # pieces that wait for each process


class Work(Protocol[ItemIn, MadeOut]):
    """What is done with every item; it goes to each process, which sets itself up once."""

    def begin(self) -> Callable[[ItemIn], MadeOut]:
        """Set up, and return what makes something of an item."""
        ...


@dataclass(frozen=True, slots=True)
class Done(Generic[Made]):
    """What has been made of the item at `place`; nothing where its process died of it, alone and a second time."""

    place: int
    made: Made | None


Advance = Callable[[int, int], None]  # told how many more are done, and of how many
Piece = list[tuple[int, Item]]


def shared_out(
    work: Work[Item, Made], items: Sequence[Item], jobs: int, alone: int | None = None
) -> Iterator[list[Done[Made]]]:
    """Go through what is made, in the order in which it is done.

    Parameters
    ----------
    jobs : int
        Processes. With one all is done in this one.
    alone : int, optional
        For so many items no process is started; then one may be the only one.
    """
    placed = list(enumerate(items))
    pieces = deque(placed[at : at + TOGETHER] for at in range(0, len(placed), TOGETHER))
    if len(placed) > ((ALONE if jobs > 1 else len(placed)) if alone is None else alone):
        yield from _in_processes(work, pieces, min(jobs, len(pieces)))
        return
    make = work.begin()
    for piece in pieces:
        yield [Done(place, make(item)) for place, item in piece]


def _in_processes(work: Work[Item, Made], left: deque[Piece[Item]], jobs: int) -> Iterator[list[Done[Made]]]:
    """Share pieces out; where a process dies what was in work then is done again, item by item, one at a time."""
    while left:
        waiting: dict[Future[list[Made]], Piece[Item]] = {}
        with suppress(BrokenProcessPool):
            yield from _shared(work, left, jobs, waiting)
        yield from _singly(work, (item for piece in waiting.values() for item in piece))


def _shared(
    work: Work[Item, Made], left: deque[Piece[Item]], jobs: int, waiting: dict[Future[list[Made]], Piece[Item]]
) -> Iterator[list[Done[Made]]]:
    """Share pieces out until none is left; those in work stand in `waiting`."""
    with ProcessPoolExecutor(jobs, initializer=_begin, initargs=(work,)) as pool:
        try:
            while left or waiting:
                while left and len(waiting) < WAITING * jobs:
                    task = pool.submit(_piece, [item for _, item in left[0]])
                    waiting[task] = left.popleft()
                for task in wait(waiting, return_when=FIRST_COMPLETED).done:
                    made = task.result()
                    yield [Done(place, one) for (place, _), one in zip(waiting.pop(task), made, strict=True)]
        finally:
            # what is still in work is not waited for; all done, threads that end later would stumble at the exit
            pool.shutdown(wait=not waiting, cancel_futures=True)


def _singly(work: Work[Item, Made], suspects: Iterable[tuple[int, Item]]) -> Iterator[list[Done[Made]]]:
    """Do items one at a time in a process of their own, a new one after each that dies."""
    left = deque(suspects)
    while left:
        with ProcessPoolExecutor(1, initializer=_begin, initargs=(work,)) as pool:
            while left:
                place, item = left.popleft()
                try:
                    yield [Done(place, pool.submit(_piece, [item]).result()[0])]
                except BrokenProcessPool:
                    yield [Done(place, None)]
                    break


_OWN: list[Callable[[Any], Any]] = []  # of a process


def _begin(work: Work[Any, Any]) -> None:
    """Set up a process, which ends with the one that has started it, even if that is killed."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=_end_with, args=(parent,), daemon=True).start()
    _OWN.append(work.begin())


def _end_with(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)


def _piece(items: list[Any]) -> list[Any]:
    return [_OWN[-1](item) for item in items]
