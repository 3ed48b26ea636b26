"""A batch on a cluster: a real scheduler and two workers give the same bytes as processes here."""

from __future__ import annotations

import json
import logging
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Thread

import pytest

from kulman import batch
from kulman.scales.errors import InputError
from kulman.variants.crew import on_cluster

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
    rows = [f"S{number};{number:02d}" for number in range(58)]
    file.write_text("\n".join(("student;record book", *rows, "Bad;x", "None;")) + "\n", encoding="utf-8")
    tasks = ["nau-slider-crank"] * 6 + ["scheme-19-scotch-yoke"] * 4

    there = batch(tasks, file, tmp_path / "there", only="structure,velocity", dask=address, lang="en")
    here = batch(tasks, file, tmp_path / "here", only="structure,velocity", jobs=2, lang="en")

    assert len(there.problems) == 2
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
    done = [one for piece in on_cluster(Squares(), list(range(24)), str, address) for one in piece]

    assert {one.place: one.made for one in done} == {n: n * n if n != 13 else None for n in range(24)}


@dataclass(frozen=True)
class Strange(Squares):
    """What a worker without the module cannot unpack."""

    def __reduce__(self) -> tuple[object, ...]:
        return missing, ()


def missing() -> None:
    raise ModuleNotFoundError("No module named 'kulman'")


def test_a_worker_that_cannot_do_the_work_is_told_in_a_line(address: str) -> None:
    with pytest.raises(InputError, match="cannot do the work: No module named 'kulman'"):
        list(on_cluster(Strange(), [1], str, address))


def kill_when_reached(scheduler: subprocess.Popen[bytes]) -> None:
    from distributed import default_client

    for _ in range(1200):
        with suppress(ValueError):
            if default_client().futures:
                break
        time.sleep(0.05)
    scheduler.kill()


@pytest.fixture
def idle(tmp_path: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """A scheduler without workers: its address, its process."""
    place = tmp_path / "scheduler.json"
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard"]
    with subprocess.Popen([*command, "--scheduler-file", str(place)], stderr=subprocess.DEVNULL) as going:
        while not place.exists() or not place.read_text():
            time.sleep(0.05)
        yield json.loads(place.read_text())["address"], going
        going.kill()


def test_a_scheduler_that_goes_is_told_in_a_line(idle: tuple[str, subprocess.Popen[bytes]]) -> None:
    there, going = idle
    Thread(target=kill_when_reached, args=(going,)).start()

    with pytest.raises(InputError, match=f"{there} no longer answers"):
        list(on_cluster(Squares(), [1, 2, 3], str, there))

    assert logging.root.manager.disable == logging.NOTSET


def test_a_scheduler_without_workers_is_told_in_a_line(
    idle: tuple[str, subprocess.Popen[bytes]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kulman.variants.crew.ROUND", 0.2)

    with pytest.raises(InputError, match=f"{idle[0]} has no workers"):
        list(on_cluster(Squares(), [1, 2, 3], str, idle[0]))


def test_a_scheduler_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.crew.ANSWERS", "1s")

    with pytest.raises(InputError, match=r"tcp://127\.0\.0\.1:9"):
        next(on_cluster(Squares(), [1], str, "tcp://127.0.0.1:9"))


def test_a_cluster_with_tls_lets_in_who_has_a_certificate(tmp_path: Path) -> None:
    import dask
    from distributed import LocalCluster, Security

    keys = Security.temporary()
    named = {"ca-file": keys.tls_ca_file, "client.key": keys.tls_client_key, "client.cert": keys.tls_client_cert}
    for name, text in named.items():
        (tmp_path / name).write_text(text, encoding="ascii")
    config = {f"distributed.comm.tls.{name}": str(tmp_path / name) for name in named}
    with LocalCluster(1, processes=True, dashboard_address=":0", security=keys, protocol="tls://") as cluster:
        address = str(cluster.scheduler_address)

        with dask.config.set(config):
            done = [made for piece in on_cluster(Squares(), [2, 3], str, address) for made in piece]
        with pytest.raises(InputError, match="no certificates for TLS"):
            list(on_cluster(Squares(), [2, 3], str, address))

    assert [one.made for one in done] == [4, 9]
