"""A batch on a cluster: a real scheduler and two workers give the same bytes as processes here."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from kulman import batch
from kulman.scales.errors import InputError
from kulman.variants.cluster import on_cluster

pytestmark = [pytest.mark.soak, pytest.mark.filterwarnings("ignore")]  # what Dask warns of is not ours


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster:
        yield str(cluster.scheduler_address)


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.startswith(".")}


def test_a_cluster_gives_the_same_bytes(tmp_path: Path, address: str) -> None:
    file = tmp_path / "class.csv"
    rows = [f"S{number};{number % 10}" for number in range(20)]
    file.write_text("\n".join(("student;variant", *rows, "Bad;77")) + "\n", encoding="utf-8")

    there = batch("nau-slider-crank", file, tmp_path / "there", dask=address, lang="en")
    here = batch("nau-slider-crank", file, tmp_path / "here", jobs=2, lang="en")

    assert there.outcomes == here.outcomes
    assert files(tmp_path / "there") == files(tmp_path / "here")


@dataclass(frozen=True)
class Squares:
    """Squares; of 13 a worker dies."""

    def begin(self) -> Callable[[int], int]:
        return self.square

    def square(self, item: int) -> int:
        if item == 13:
            os.kill(os.getpid(), signal.SIGKILL)
        return item * item


def test_an_item_that_kills_workers_is_found_out(address: str) -> None:
    done = [one for piece in on_cluster(Squares(), list(range(24)), address) for one in piece]

    assert {one.place: one.made for one in done} == {n: n * n if n != 13 else None for n in range(24)}


def test_a_scheduler_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.cluster.PATIENCE", "1s")

    with pytest.raises(InputError, match=r"tcp://127\.0\.0\.1:9"):
        next(on_cluster(Squares(), [1], "tcp://127.0.0.1:9"))
