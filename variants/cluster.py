"""Work shared out among the workers of a Dask cluster: the same work, the same results, other processes."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
from pickle import PickleError
from typing import Any, TypeVar

from ..scales.errors import InputError
from ..scales.numbers import SHOWN, quote
from .crew import TOGETHER, Done, Piece, Work

Item = TypeVar("Item")
Made = TypeVar("Made")
PATIENCE = "10s"  # how long the scheduler is waited for
ROUND, ROUNDS = "10s", 6  # after so many rounds in which nobody does anything it is said, or begun again
FETCHED = "30s"  # how long what is made may be on its way
DEATHS = 1  # times that a worker may die of a piece before it is taken apart, or of an item before it is left


def on_cluster(work: Work[Item, Made], items: Sequence[Item], address: str) -> Iterator[list[Done[Made]]]:
    """Go through what is made on a cluster, in the order in which it is done.

    Parameters
    ----------
    address : str
        Of the scheduler, such as `tcp://10.0.0.7:8786`; certificates for `tls://` are those of Dask's configuration.

    Raises
    ------
    InputError
        The extra `cluster` is missing, no scheduler answers there or no longer does, or its workers cannot do the work.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError("cluster-extra") from None
    try:
        client: Any = Client(address, timeout=PATIENCE)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as problem:
        raise InputError("cluster-silent", address=quote(address)) from problem
    except TypeError as problem:  # what Dask says of an address with TLS and no certificate
        raise InputError("cluster-tls", address=quote(address)) from problem
    before = logging.root.manager.disable
    try:
        with client:
            try:
                yield from _shared(client, work, list(enumerate(items)))
            except (CancelledError, OSError) as problem:
                logging.disable()  # what Dask says of it besides, while it closes
                raise InputError("cluster-lost", address=quote(address)) from problem
            except (ImportError, AttributeError, PickleError, RuntimeError) as problem:  # of what is unpacked there
                cause = problem.__cause__ or problem
                raise InputError("cluster-work", address=quote(address), error=quote(cause, SHOWN)) from problem
    finally:
        logging.disable(before)


def _shared(client: Any, work: Work[Item, Made], placed: list[tuple[int, Item]]) -> Iterator[list[Done[Made]]]:
    """Share pieces out; those of which a worker dies are done again item by item, one at a time."""
    from distributed import KilledWorker

    pieces = deque(placed[at : at + TOGETHER] for at in range(0, len(placed), TOGETHER))
    suspects: list[tuple[int, Item]] = []
    for piece, made in _done(client, work, pieces):
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
    """Wait until something is done; nothing where no worker has had anything to do for some time.

    Raises
    ------
    InputError
        There are no workers.
    """
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


_READY: dict[Any, Callable[[Any], Any]] = {}  # of a worker, by work


def make_piece(work: Work[Any, Any], items: list[Any]) -> list[Any]:
    """Do a piece on a worker, which sets itself up once for each work."""
    key = repr(work)
    if key not in _READY:
        _READY.clear()
        _READY[key] = work.begin()
    return [_READY[key](item) for item in items]
