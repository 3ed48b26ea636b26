"""Work shared out among processes or the workers of a Dask cluster, and noted; an item that kills one is left out."""

from __future__ import annotations

import hashlib
import json
import logging
import multiprocessing
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from pickle import PickleError
from queue import SimpleQueue
from threading import Event, Thread
from typing import Any, Generic, Protocol, TypeVar

from ..drawing.writers import refused, write_whole
from ..scales.errors import InputError
from ..scales.numbers import SHOWN, quote

Item = TypeVar("Item")
ItemIn = TypeVar("ItemIn", contravariant=True)
Made = TypeVar("Made")
MadeOut = TypeVar("MadeOut", covariant=True)
TOGETHER = 8  # items that a process is given at once
ALONE = 16  # items for which no process is started
WAITING = 2  # pieces that each process has, one in work
PATIENCE = 10.0  # seconds for which a process that is stopped may go on
Advance = Callable[[int, int], None]  # told how many more are done, and of how many
Piece = list[tuple[int, Item]]
ANSWERS = "10s"  # how long the scheduler is waited for
ROUND, ROUNDS = "10s", 6  # after so many rounds in which nobody does anything it is said, or begun again
FETCHED = "30s"  # how long what is made may be on its way
DEATHS = 1  # times that a worker may die of a piece before it is taken apart, or of an item before it is left
_READY: dict[Any, Callable[[Any], Any]] = {}  # of a worker, by work


class Work(Protocol[ItemIn, MadeOut]):
    """What is done with every item; it goes to each process, which sets itself up once."""

    def begin(self) -> Callable[[ItemIn], MadeOut]:
        """Set up, and return what makes something of an item."""


@dataclass(frozen=True, slots=True)
class Done(Generic[Made]):
    """What has been made of the item at `place`; nothing where its process died of it, alone and a second time."""

    place: int
    made: Made | None


def shared_out(
    work: Work[Item, Made], items: Sequence[Item], jobs: int, alone: int | None = None, afresh: bool = False
) -> Iterator[list[Done[Made]]]:
    """Go through what is made, in the order in which it is done, by so many processes.

    With one job all is done in this process; for `alone` items, too, none is started, where that is said it may be the
    only one. Processes that are `afresh` are no copies of this one, which has threads without which a copy would stand
    still.
    """
    pieces = _pieces(items)
    if len(items) > ((ALONE if jobs > 1 else len(items)) if alone is None else alone):
        yield from _in_processes(partial(_Hand, work, afresh), pieces, max(1, min(jobs, len(pieces))))
        return
    make = work.begin()
    for piece in pieces:
        yield [Done(place, make(item)) for place, item in piece]


def _pieces(items: Sequence[Item]) -> list[Piece[Item]]:
    placed = list(enumerate(items))
    return [placed[at : at + TOGETHER] for at in range(0, len(placed), TOGETHER)]


def _in_processes(
    new_hand: Callable[[], _Hand[Item, Made]], left: Sequence[Piece[Item]], jobs: int, waiting: int = WAITING
) -> Iterator[list[Done[Made]]]:
    """Share pieces out; what a process has when it dies is done again, item by item, one at a time, after the others.

    Each process has a part of its own, as neighbours are often alike; one that has done it takes from another's end.
    """
    parts = [deque(left[len(left) * at // jobs : len(left) * (at + 1) // jobs]) for at in range(jobs)]
    hands = [new_hand() for _ in parts]
    suspects: list[Piece[Item]] = []
    try:
        while _given_out(parts, hands, waiting):
            for at in _ready(hands):
                hand = hands[at]
                if not hand.has_died():
                    yield hand.take()
                    continue
                lost = [item for piece in hand.pieces for item in piece]
                hand.stop()
                hands[at] = new_hand()
                if waiting == 1:
                    yield [Done(lost[0][0], None)]
                else:
                    suspects += ([item] for item in lost)
    finally:
        for hand in hands:
            hand.stop()
    if suspects:
        yield from _in_processes(new_hand, suspects, 1, 1)


def _given_out(parts: Sequence[deque[Piece[Item]]], hands: Sequence[_Hand[Item, Made]], waiting: int) -> bool:
    """Give every process so many pieces that it need not wait; tell whether any has something to do."""
    for own, hand in zip(parts, hands, strict=True):
        while len(hand.pieces) < waiting and any(parts):
            hand.give(own.popleft() if own else max(parts, key=len).pop())
    return any(hand.pieces for hand in hands)


def _ready(hands: Sequence[_Hand[Item, Made]]) -> list[int]:
    """Wait until processes have made something, or have died; return which."""
    signs: dict[Any, int] = {}
    for at, hand in enumerate(hands):
        if hand.pieces:
            signs |= {hand.made: at, hand.process.sentinel: at}
    return list(dict.fromkeys(signs[sign] for sign in wait(list(signs))))


class _Hand(Generic[Item, Made]):
    """A process that makes pieces in their order; `pieces` are those that it has not handed back."""

    def __init__(self, work: Work[Item, Made], afresh: bool) -> None:
        means: Any = multiprocessing.get_context("spawn" if afresh else None)
        items, self._items = means.Pipe(duplex=False)
        self.made, made = means.Pipe(duplex=False)
        self.pieces: deque[Piece[Item]] = deque()
        self.process = means.Process(target=_serve, args=(items, made, work), daemon=True)
        with _without_script() if afresh else nullcontext():
            self.process.start()
        items.close()
        made.close()
        self._taken: tuple[bool, Any] | None = None

    def give(self, piece: Piece[Item]) -> None:
        """Hand over a piece; a process that has died loses it."""
        self.pieces.append(piece)
        with suppress(OSError):
            self._items.send([item for _, item in piece])

    def has_died(self) -> bool:
        """Whether the process has died, where it has made nothing before it did."""
        try:
            self._taken = self.made.recv()
        except (EOFError, OSError):
            return True
        return False

    def take(self) -> list[Done[Made]]:
        """Return what has been made of the first piece; an error of the work is raised."""
        assert self._taken is not None
        (right, made), self._taken = self._taken, None
        if not right:
            raise made
        return [Done(place, one) for (place, _), one in zip(self.pieces.popleft(), made, strict=True)]

    def stop(self) -> None:
        """End the process when it has done the item that it is at."""
        with suppress(OSError):
            self._items.send(None)
        self.process.join(PATIENCE)
        self.process.kill()
        self.process.join()
        self._items.close()
        self.made.close()


@contextmanager
def _without_script() -> Iterator[None]:
    """Keep a process that is started from running the user's script once more: nothing that it needs stands there."""
    script: dict[str, Any] = vars(sys.modules["__main__"])
    kept: dict[str, Any] = {name: script.pop(name) for name in ("__file__", "__spec__") if name in script}
    script["__spec__"] = None
    try:
        yield
    finally:
        script.update(kept)


def _serve(items: Connection, made: Connection, work: Work[Any, Any]) -> None:
    """Make pieces as they come in a process, which ends with the one that has started it, even if that is killed.

    Two threads take and hand back, so that it never waits for the other end.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the other end is told, and stops this one
    come, gone = SimpleQueue[Any](), SimpleQueue[Any]()
    over = Event()
    parent = multiprocessing.parent_process()
    for task, *given in ((_end_with, parent), (_take_in, items, come, over), (_hand_back, made, gone)):
        Thread(target=task, args=given, daemon=True).start()
    make: Callable[[Any], Any] | None = None
    while (piece := come.get()) is not None:
        try:
            make = make or work.begin()
            results = []
            for item in piece:
                if over.is_set():
                    return
                results.append(make(item))
            gone.put((True, results))
        except Exception as error:
            gone.put((False, error))


def _end_with(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)


def _take_in(items: Connection, come: SimpleQueue[Any], over: Event) -> None:
    with suppress(EOFError, OSError):
        while (piece := items.recv()) is not None:
            come.put(piece)
    over.set()
    come.put(None)


def _hand_back(made: Connection, gone: SimpleQueue[Any]) -> None:
    while True:
        results = gone.get()
        try:
            made.send(results)
        except OSError:
            return
        except Exception as error:  # it cannot be sent
            made.send((False, TypeError(str(error))))


def on_cluster(work: Work[Item, Made], items: Sequence[Item], address: str) -> Iterator[list[Done[Made]]]:
    """Go through what is made on a cluster, in the order in which it is done; what fails there is an `InputError`.

    The address is the scheduler's, `tcp://10.0.0.7:8786`; certificates for `tls://` are those of Dask's configuration.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError("cluster-extra") from None
    try:
        client: Any = Client(address, timeout=ANSWERS)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as problem:
        raise InputError("cluster-silent", address=quote(address)) from problem
    except TypeError as problem:  # what Dask says of an address with TLS and no certificate
        raise InputError("cluster-tls", address=quote(address)) from problem
    before = logging.root.manager.disable
    try:
        with client:
            try:
                yield from _shared(client, work, _pieces(items))
            except (CancelledError, OSError) as problem:
                logging.disable()  # what Dask says of it besides, while it closes
                raise InputError("cluster-lost", address=quote(address)) from problem
            except (ImportError, AttributeError, PickleError, RuntimeError) as problem:  # of what is unpacked there
                cause = problem.__cause__ or problem
                raise InputError("cluster-work", address=quote(address), error=quote(cause, SHOWN)) from problem
    finally:
        logging.disable(before)


def _shared(client: Any, work: Work[Item, Made], pieces: list[Piece[Item]]) -> Iterator[list[Done[Made]]]:
    """Share pieces out; those of which a worker dies are done again item by item, one at a time."""
    from distributed import KilledWorker

    suspects: Piece[Item] = []
    for piece, made in _done(client, work, deque(pieces)):
        if isinstance(made, KilledWorker):
            suspects += piece
        else:
            yield [Done(place, one) for (place, _), one in zip(piece, made, strict=True)]
    for suspect in suspects:  # what else a dying worker has made would be lost with it
        [(_, made)] = _done(client, work, deque([[suspect]]))
        yield [Done(suspect[0], None if isinstance(made, KilledWorker) else made[0])]


def _done(client: Any, work: Work[Item, Made], pieces: deque[Piece[Item]]) -> Iterator[tuple[Piece[Item], Any]]:
    """Go through what is made of pieces, or the error of one of which workers die, as it is done."""
    from distributed import KilledWorker

    futures: dict[Any, Piece[Item]] = {}
    while pieces or futures:
        while pieces:
            piece = pieces.popleft()
            items = [item for _, item in piece]
            futures[client.submit(make_piece, work, items, pure=False, retries=DEATHS)] = piece
        done = _some_done(client, list(futures))
        if not done:  # the scheduler has forgotten them, as workers have died
            pieces.extend(futures.values())
            client.cancel(list(futures))
            futures.clear()
        for future in done:
            piece = futures.pop(future)
            try:
                yield piece, future.result(timeout=FETCHED)
            except KilledWorker as error:
                yield piece, error
            except TimeoutError:  # a worker has died with it, and the scheduler has not noticed
                pieces.append(piece)


def _some_done(client: Any, futures: list[Any]) -> Iterable[Any]:
    """Wait until something is done; nothing where no worker has had anything to do for some time."""
    from distributed import wait

    first: Any = wait
    idle = 0
    while idle < ROUNDS:
        with suppress(TimeoutError):
            done: Iterable[Any] = first(futures, timeout=ROUND, return_when="FIRST_COMPLETED").done
            return done
        idle = 0 if any(client.processing().values()) else idle + 1
    if not client.nthreads():
        raise InputError("cluster-idle", address=quote(client.scheduler.address))
    return ()


def make_piece(work: Work[Any, Any], items: list[Any]) -> list[Any]:
    """Do a piece on a worker, which sets itself up once for each work."""
    key = repr(work)
    if key not in _READY:
        _READY.clear()
        _READY[key] = work.begin()
    return [_READY[key](item) for item in items]


class Journal(Generic[Made]):
    """The results of a run by the digests of what they were made from, in a file of JSON lines.

    So a killed run can be gone on with; `load` and `dump` turn plain data into results and back.
    """

    def __init__(
        self, path: Path, load: Callable[[Mapping[str, Any]], Made], dump: Callable[[Made], Mapping[str, Any]]
    ) -> None:
        self.path, self.dump = path, dump
        self.before: dict[str, Made] = {}
        self._torn = False
        with suppress(OSError):  # what cannot be read is made again
            text = path.read_bytes().decode("utf-8", "replace")
            self._torn = text[-1:] not in ("", "\n")  # the last line of a killed run
            for line in text.splitlines():
                with suppress(ValueError, KeyError, TypeError, AttributeError):  # torn, or no line of a journal
                    item = json.loads(line)
                    self.before[item["digest"]] = load(item["result"])

    def found(self, digest: str) -> Made | None:
        """Return what an earlier run has made of the same."""
        return self.before.get(digest)

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

    def _line(self, digest: str, result: Made) -> str:
        return json.dumps({"digest": digest, "result": self.dump(result)}, ensure_ascii=True) + "\n"

    def finish(self) -> None:
        """Forget: all is done."""
        with suppress(OSError):
            self.path.unlink()


def remove_stale(
    folder: Path, before: Iterable[tuple[str, str]], names: Container[str], suffixes: Container[str]
) -> None:
    """Remove files of earlier runs that are not among the `names` of this one, of the kinds that such runs write.

    `before` are names and digests that earlier runs have noted as their own: what somebody has changed stays.
    """
    for name, digest in before:
        stale = folder / Path(name).name
        with suppress(OSError):
            if name not in names and stale.suffix in suffixes and digest_of(stale.read_bytes()) == digest:
                stale.unlink()


def digest_of(data: str | bytes) -> str:
    """Return what tells a text, or what a file holds, from any other."""
    whole = data.encode("utf-8", "surrogatepass") if isinstance(data, str) else data
    return hashlib.blake2s(whole, digest_size=12).hexdigest()
