"""Work shared out among the workers of a Dask cluster: the same work, the same results, other processes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from ..scales.errors import InputError
from ..scales.numbers import quote
from .crew import TOGETHER, Done, Work

Item = TypeVar("Item")
Made = TypeVar("Made")
PATIENCE = "10s"  # how long the scheduler is waited for
DEATHS = 1  # times that a worker may die of a piece before it is taken apart, or of an item before it is left


def on_cluster(work: Work[Item, Made], items: Sequence[Item], address: str) -> Iterator[list[Done[Made]]]:
    """Go through what is made on a cluster, in the order in which it is done.

    Parameters
    ----------
    address : str
        Of the scheduler, such as `tcp://10.0.0.7:8786`.

    Raises
    ------
    InputError
        The extra `cluster` is missing, or no scheduler answers there.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError("cluster-extra") from None
    try:
        client: Any = Client(address, timeout=PATIENCE)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as problem:
        raise InputError("cluster-silent", address=quote(address)) from problem
    with client:
        yield from _shared(client, work, list(enumerate(items)))


def _shared(client: Any, work: Work[Item, Made], placed: list[tuple[int, Item]]) -> Iterator[list[Done[Made]]]:
    """Share pieces out; one of which a worker dies is done again item by item."""
    from distributed import KilledWorker, as_completed

    done: Any = as_completed

    pieces = [placed[at : at + TOGETHER] for at in range(0, len(placed), TOGETHER)]
    for alone in (False, True):
        futures = {}
        for piece in pieces:
            items = [item for _, item in piece]
            futures[client.submit(make_piece, work, items, pure=False, retries=DEATHS)] = piece
        pieces = []
        for future in done(list(futures)):
            piece = futures.pop(future)
            try:
                made = future.result()
            except KilledWorker:
                if alone:
                    yield [Done(piece[0][0], None)]
                pieces += [] if alone else [[one] for one in piece]
                continue
            yield [Done(place, one) for (place, _), one in zip(piece, made, strict=True)]


_READY: dict[Any, Callable[[Any], Any]] = {}  # of a worker, by work


def make_piece(work: Work[Any, Any], items: list[Any]) -> list[Any]:
    """Do a piece on a worker, which sets itself up once for each work."""
    key = repr(work)
    if key not in _READY:
        _READY.clear()
        _READY[key] = work.begin()
    return [_READY[key](item) for item in items]
