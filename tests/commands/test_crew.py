"""Work shared out among processes: all is done once, whoever dies."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

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
    done = [one for piece in shared_out(work, ITEMS, jobs) for one in piece]
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
