"""Work shared out among processes or the workers of a Dask cluster, and noted; an item that kills one is left out."""

from __future__ import annotations

import hashlib
import json
import logging
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, ProcessPoolExecutor, wait
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import asdict
from functools import partial
from multiprocessing.process import BaseProcess
from pathlib import Path
from pickle import PickleError
from threading import Thread
from typing import Any, Generic, TypeAlias, TypeVar

from ..drawing.writers import refused, write_whole
from ..scales.errors import InputError
from ..scales.kept import collect_seldom
from ..scales.numbers import SHOWN, quote

Item = TypeVar("Item")
Made = TypeVar("Made")
TOGETHER, MOST = 8, 16  # items in a piece: at least, and at most where the next ones are alike
ALONE = 16  # items for which no process is started
WAITING = 2  # pieces that each process has, one in work
PATIENCE, BEAT = 10.0, 0.2  # seconds for which a process that is stopped may go on; after which it looks whether it is
Advance = Callable[[int, int], None]  # told how many more are done, and of how many
Piece = list[tuple[int, Item]]
Begin: TypeAlias = Callable[
    [], Callable[[Item], Made]
]  # sets up, once in each process, what makes something of an item
ANSWERS = "10s"  # how long the scheduler is waited for
ROUND, ROUNDS = 10.0, 6  # after so many seconds in which nobody does anything, so often, it is said, or begun again
DEATHS = 1  # times that a worker of a cluster may die of a piece
Task: TypeAlias = "Future[list[Any]]"
Tasks: TypeAlias = dict[Task, Piece[Any]]
Submit: TypeAlias = Callable[[list[Any]], Task]
Hire: TypeAlias = Callable[[int], AbstractContextManager[Submit]]  # for so many pieces at a time
# the place of an item and what has been made of it; nothing where its process died of it, when it was alone with it
Done: TypeAlias = tuple[int, Made | None]
_HERE: dict[str, Any] = {}  # what a process works at


def shared_out(
    begin: Begin[Item, Made],
    items: Sequence[Item],
    jobs: int,
    alike: Callable[[Item], Any],
    alone: int | None = None,
    afresh: bool = False,
) -> Iterator[list[Done[Made]]]:
    """Go through what is made, in the order in which it is done, by so many processes.

    Items that are `alike`, by something that can be sorted, go to one process, one after the other: they share much.
    With one job all is done in this process; for `alone` items, too, none is started, where that is said it may be the
    only one. Processes that are `afresh` are no copies of this one, which has threads without which a copy would stand
    still.
    """
    pieces = _pieces(items, alike)
    if len(items) > ((ALONE if jobs > 1 else len(items)) if alone is None else alone):
        most = max(1, min(jobs, len(pieces)))
        # an executor is broken as a whole: who was at work then is tried item by item, at last one alone
        yield from _tried(partial(_processes, begin, most, afresh), pieces, (WAITING * most, most, 1), BrokenExecutor)
        return
    make = begin()
    for piece in pieces:
        for place, item in piece:
            yield [(place, make(item))]


def _pieces(items: Sequence[Item], alike: Callable[[Item], Any]) -> list[Piece[Item]]:
    """Return items with their places in pieces, which part those that are alike only where there are many of them."""
    pieces: list[Piece[Item]] = []
    for place, item in sorted(enumerate(items), key=lambda placed: alike(placed[1])):
        if not pieces or len(pieces[-1]) >= (MOST if alike(pieces[-1][-1][1]) == alike(item) else TOGETHER):
            pieces.append([])
        pieces[-1].append((place, item))
    return pieces


def _tried(
    hire: Hire,
    pieces: Sequence[Piece[Any]],
    rounds: Sequence[int],
    deaths: type[Exception],
    first: Callable[[Tasks], Iterable[Task]] = lambda tasks: wait(tasks, return_when=FIRST_COMPLETED).done,
) -> Iterator[list[Done[Any]]]:
    """Go through what is made in rounds, of so many pieces at a time: each does what workers have died of once more.

    From the second round on a piece is one item. Where `first`, which waits for tasks, has none, they are begun again.
    """
    for at_once in rounds:
        left, lost = deque(pieces), list[Piece[Any]]()
        while left:
            tasks: Tasks = {}
            with hire(at_once) as submit, suppress(BrokenExecutor):  # one of which somebody has died takes no more
                while left or tasks:
                    while left and len(tasks) < at_once:
                        tasks[submit([item for _, item in left[0]])] = left[0]
                        left.popleft()
                    done = first(tasks)
                    for task in done:
                        piece = tasks.pop(task)
                        try:
                            made = task.result()
                        except deaths:
                            lost.append(piece)
                            continue
                        yield [(place, one) for (place, _), one in zip(piece, made, strict=True)]
                    if not done:
                        left.extend(tasks.values())
                        tasks.clear()
            lost += tasks.values()
        pieces = [[item] for piece in lost for item in piece]
    yield [(place, None) for ((place, _),) in pieces]


@contextmanager
def _processes(begin: Begin[Any, Any], most: int, afresh: bool, at_once: int) -> Iterator[Submit]:
    """Start processes; in the end each is stopped when it has done the item that it is at."""
    means: Any = multiprocessing.get_context("spawn" if afresh else None)
    over = means.RawValue("b", 0)
    executor = ProcessPoolExecutor(min(most, at_once), means, _begin, (begin, over))

    def submit(items: list[Any]) -> Task:
        with without_script() if afresh else nullcontext():
            return executor.submit(_make_here, items)

    try:
        yield submit
    finally:
        over.value = 1
        executor.shutdown(cancel_futures=True)


@contextmanager
def without_script() -> Iterator[None]:
    """Keep a process that is started from running the user's script once more: nothing that it needs stands there.

    Nor does it hear of Ctrl+C, which it would die of with a traceback until it ignores that by itself.
    """
    script: dict[str, Any] = vars(sys.modules["__main__"])
    kept: dict[str, Any] = {name: script.pop(name) for name in ("__file__", "__spec__") if name in script}
    script["__spec__"] = None
    heard = None
    if sys.platform != "win32":
        from multiprocessing import resource_tracker

        resource_tracker.ensure_running()  # which would be started with the first process, and hears again after it
        heard = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if heard is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, heard)
        script.update(kept)


def _begin(begin: Begin[Any, Any], over: Any) -> None:
    """Begin a process, which ends with the one that has started it, even if that is killed."""
    collect_seldom()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the other end is told, and stops this one
    _HERE.update(begin=begin, over=over)
    Thread(target=_end_with, args=(multiprocessing.parent_process(), over), daemon=True).start()


def _end_with(parent: BaseProcess, over: Any) -> None:
    while not over.value and parent.is_alive():
        parent.join(BEAT)
    time.sleep(PATIENCE * over.value)
    os._exit(1)


def _make_here(items: list[Any]) -> list[Any]:
    """Do a piece in a process; one that is stopped leaves the rest."""
    if "make" not in _HERE:
        _HERE["make"] = _HERE["begin"]()
    return [_HERE["make"](item) for item in items if not _HERE["over"].value]


def on_cluster(
    begin: Begin[Item, Made], items: Sequence[Item], alike: Callable[[Item], Any], address: str
) -> Iterator[list[Done[Made]]]:
    """Go through what is made on a cluster, in the order in which it is done; what fails there is an `InputError`.

    The address is the scheduler's, `tcp://10.0.0.7:8786`; certificates for `tls://` are those of Dask's configuration.
    """
    try:
        from distributed import Client, KilledWorker
    except ImportError:
        raise InputError("cluster-extra") from None
    try:
        client: Any = Client(address, timeout=ANSWERS)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as problem:
        raise InputError("cluster-silent", address=quote(address)) from problem
    except TypeError as problem:  # what Dask says of an address with TLS and no certificate
        raise InputError("cluster-tls", address=quote(address)) from problem
    before, pieces = logging.root.manager.disable, _pieces(items, alike)
    try:
        with client:
            submit = partial(client.get_executor(pure=False, retries=DEATHS).submit, _make_piece, begin)
            rounds = len(pieces), 1  # what else a dying worker has made would be lost with it
            try:
                first = partial(_some_done, client)
                yield from _tried(lambda at_once: nullcontext(submit), pieces, rounds, KilledWorker, first)
            except (CancelledError, OSError) as problem:
                logging.disable()  # what Dask says of it besides, while it closes
                raise InputError("cluster-lost", address=quote(address)) from problem
            except (ImportError, AttributeError, PickleError, RuntimeError) as problem:  # of what is unpacked there
                cause = problem.__cause__ or problem
                raise InputError("cluster-work", address=quote(address), error=quote(cause, SHOWN)) from problem
    finally:
        logging.disable(before)


def _some_done(client: Any, tasks: Tasks) -> Iterable[Task]:
    """Wait until something is done; nothing where no worker has had anything to do for some time.

    So it is where the scheduler has forgotten tasks, as workers have died.
    """
    idle = 0
    while idle < ROUNDS:
        if done := wait(tasks, ROUND, FIRST_COMPLETED).done:
            return done
        idle = 0 if any(client.processing().values()) else idle + 1
    if not client.nthreads():
        raise InputError("cluster-idle", address=quote(client.scheduler.address))
    return ()


def _make_piece(begin: Begin[Any, Any], items: list[Any]) -> list[Any]:
    """Do a piece on a worker, which sets itself up once for each work."""
    if _HERE.get("key") != (key := repr(begin)):
        _HERE.update(key=key, make=begin())
    return [_HERE["make"](item) for item in items]


class Journal(Generic[Made]):
    """The results of a run by the digests of what they were made from, in a file of JSON lines.

    So a killed run can be gone on with: `before` has what it made. Results are dataclasses, which `load` makes of plain
    data.
    """

    def __init__(self, path: Path, load: Callable[[Mapping[str, Any]], Made]) -> None:
        self.path = path
        self.before: dict[str, Made] = {}
        self._torn = False
        with suppress(OSError):  # what cannot be read is made again
            text = path.read_bytes().decode("utf-8", "replace")
            self._torn = text[-1:] not in ("", "\n")  # the last line of a killed run
            for line in text.splitlines():
                with suppress(ValueError, KeyError, TypeError, AttributeError):  # torn, or no line of a journal
                    item = json.loads(line)
                    self.before[item["digest"]] = load(item["result"])

    def note(self, digest: str, result: Made) -> None:
        """Keep a result, or say that it cannot be written."""
        line = self._line(digest, result)
        with refused(self.path), self.path.open("ab") as stream:
            stream.write(f"\n{line}".encode("ascii") if self._torn else line.encode("ascii"))
        self._torn = False

    def keep(self, results: Iterable[tuple[str, Made]]) -> None:
        """Keep these results alone, for a run that comes later, each with its digest."""
        lines = (self._line(digest, result) for digest, result in results)
        with suppress(InputError):  # a folder that takes no note keeps what is there
            write_whole(self.path, "".join(lines).encode("ascii"))

    def _line(self, digest: str, result: Any) -> str:
        return json.dumps({"digest": digest, "result": asdict(result)}, ensure_ascii=True) + "\n"

    def finish(self) -> None:
        """Forget: all is done."""
        with suppress(OSError):
            self.path.unlink()


def remove_stale(
    folder: Path, before: Iterable[tuple[str, str]], names: Container[str], suffixes: Container[str]
) -> list[str]:
    """Remove files of earlier runs that are not among the `names` of this one, of the kinds that such runs write.

    `before` are names and digests that earlier runs have noted as their own: what somebody has changed stays.
    The names of those that are gone are returned.
    """
    gone = list[str]()
    for name, digest in before:
        stale = folder / name
        with suppress(OSError):
            if not stale.resolve().is_relative_to(folder.resolve()):
                continue
            if name not in names and stale.suffix in suffixes and digest_of(stale.read_bytes()) == digest:
                stale.unlink()
                gone.append(name)
    return gone


def digest_of(data: str | bytes) -> str:
    """Return what tells a text, or what a file holds, from any other."""
    whole = data.encode("utf-8", "surrogatepass") if isinstance(data, str) else data
    return hashlib.blake2s(whole, digest_size=12).hexdigest()
