"""Work shared out among processes: all is done once, whoever dies."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from pickle import PicklingError

import pytest

from kulman.variants.crew import shared_out

ITEMS = list(range(60))


@dataclass(frozen=True)
class Squares:
    """Squares; of `poison` a process dies, of `unlucky` only the first that meets it."""

    poison: frozenset[int] = frozenset()
    unlucky: Path | None = None
    wrong: int | None = None

    def begin(self) -> Callable[[int], int]:
        return self.square

    def square(self, item: int) -> int:
        if item in self.poison:
            os.kill(os.getpid(), signal.SIGKILL)
        if item == 31 and self.unlucky is not None and not self.unlucky.exists():
            self.unlucky.touch()
            os._exit(1)
        if item == self.wrong:
            raise ValueError(f"no square of {item}")
        return item * item


def made(work: Squares, jobs: int) -> dict[int, int | None]:
    done = [one for piece in shared_out(work, ITEMS, jobs, str) for one in piece]
    assert sorted(one.place for one in done) == ITEMS  # nothing lost, nothing twice
    return {one.place: one.made for one in done}


@pytest.mark.parametrize("jobs", [1, 2])
def test_everything_is_made(jobs: int) -> None:
    assert made(Squares(), jobs) == {item: item * item for item in ITEMS}


def test_an_item_that_kills_its_process_is_found_out(tmp_path: Path) -> None:
    poison = frozenset({5, 6, 59})

    found = made(Squares(poison), 2)

    assert {place for place, square in found.items() if square is None} == poison
    assert all(square == place * place for place, square in found.items() if place not in poison)


def test_a_process_that_somebody_kills_costs_nothing(tmp_path: Path) -> None:
    unlucky = tmp_path / "met"

    assert made(Squares(unlucky=unlucky), 2) == {item: item * item for item in ITEMS}
    assert unlucky.exists()


def test_an_error_of_the_work_comes_through() -> None:
    with pytest.raises(ValueError, match="no square of 40"):
        made(Squares(wrong=40), 2)


@dataclass(frozen=True)
class Place:
    """The process in which an item is made, with so many bytes; nothing that can be sent for `odd`."""

    size: int = 0
    odd: int | None = None

    def begin(self) -> Callable[[object], object]:
        return self.where

    def where(self, item: object) -> object:
        return (lambda: item) if item == self.odd else (os.getpid(), b"x" * self.size)


def test_items_that_are_alike_are_made_in_one_process() -> None:
    items = [number % 20 for number in range(160)]

    done = [one for piece in shared_out(Place(), items, 2, int) for one in piece]

    where = {one.place: one.made[0] for one in done if isinstance(one.made, tuple)}
    assert sorted(where) == list(range(160))
    assert len(set(where.values())) <= 2
    assert os.getpid() not in where.values()
    assert all(len({where[place] for place in range(item, 160, 20)}) == 1 for item in range(20))


def test_many_that_are_alike_go_to_all_processes() -> None:
    sizes = [len(piece) for piece in shared_out(Place(), [1] * 100, 2, int)]

    assert sum(sizes) == 100
    assert max(sizes) <= 16


def test_what_is_large_stops_nobody() -> None:
    items = ["y" * 300_000] * 40

    done = [one for piece in shared_out(Place(300_000), items, 2, len) for one in piece]

    assert len(done) == 40
    assert {len(one.made[1]) for one in done if isinstance(one.made, tuple)} == {300_000}


def test_what_cannot_be_sent_is_an_error_and_no_process_stays() -> None:
    with pytest.raises((AttributeError, PicklingError), match="pickle"):
        list(shared_out(Place(odd=31), list(range(60)), 2, str))

    assert multiprocessing.active_children() == []


@pytest.mark.parametrize("jobs", [-3, 0, 1, 1000])
def test_any_number_of_processes_makes_everything(jobs: int) -> None:
    found = [one for piece in shared_out(Squares(), ITEMS[:20], jobs, str, alone=0) for one in piece]

    assert sorted((one.place, one.made) for one in found) == [(item, item * item) for item in ITEMS[:20]]


@dataclass(frozen=True)
class Slow:
    """Leaves a file for each item, after a while; the first is wrong."""

    folder: Path

    def begin(self) -> Callable[[int], None]:
        return self.make

    def make(self, item: int) -> None:
        if item == 0:
            raise ValueError
        time.sleep(0.1)
        (self.folder / str(item)).touch()


def test_a_process_that_is_stopped_leaves_the_rest_of_its_piece(tmp_path: Path) -> None:
    with pytest.raises(ValueError):
        list(shared_out(Slow(tmp_path), range(40), 2, lambda item: item > 0))

    assert multiprocessing.active_children() == []
    assert len(list(tmp_path.iterdir())) < 16  # a piece
