"""Work shared out among processes, here or on a cluster of a real scheduler: all is done once, whoever dies."""

from __future__ import annotations

import gc
import json
import logging
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from pickle import PicklingError
from threading import Thread

import pytest

from kulman import batch
from kulman.scales.errors import InputError
from kulman.scales.kept import COLLECTED, seldom_collected
from kulman.tests.support.cases import some
from kulman.tests.support.commands import files, roster
from kulman.variants.crew import on_cluster, shared_out, without_script

ITEMS = list(range(60))
SQUARES = {item: item * item for item in ITEMS}


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


def made(work: Squares, jobs: int, **more: int) -> dict[int, int | None]:
    done = [one for piece in shared_out(work.begin, ITEMS, jobs, str, **more) for one in piece]
    assert sorted(place for place, _ in done) == ITEMS  # nothing lost, nothing twice
    return dict(done)


@pytest.mark.parametrize("jobs", some([-3, 0, 1, 2, 1000], 1, 2, 3))
def test_any_number_of_processes_makes_everything(jobs: int) -> None:
    assert made(Squares(), jobs, alone=0) == made(Squares(), min(jobs, 2)) == SQUARES


def threshold() -> Callable[[int], int]:
    return lambda item: gc.get_threshold()[0]


def test_processes_look_for_garbage_seldom_also_where_they_are_no_copies_of_one_that_does() -> None:
    found = {one for piece in shared_out(threshold, [1, 2], 1, str, alone=0, afresh=True) for _, one in piece}

    assert found == {COLLECTED}


@pytest.mark.parametrize(("usual", "meanwhile"), [(0, 0), (700, COLLECTED), (2 * COLLECTED, 2 * COLLECTED)])
def test_garbage_that_is_looked_for_never_or_more_seldom_yet_is_left_so(usual: int, meanwhile: int) -> None:
    before = gc.get_threshold()
    gc.set_threshold(usual, *before[1:])
    with seldom_collected():
        found = gc.get_threshold()[0]
    left = gc.get_threshold()[0]
    gc.set_threshold(*before)

    assert (found, left) == (meanwhile, usual)


def test_an_item_that_kills_its_process_is_found_out() -> None:
    poison = frozenset({5, 6, 59})

    assert made(Squares(poison), 2) == {item: None if item in poison else item * item for item in ITEMS}


def test_a_process_that_somebody_kills_costs_nothing(tmp_path: Path) -> None:
    assert made(Squares(unlucky=tmp_path / "met"), 2) == SQUARES
    assert (tmp_path / "met").exists()


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

    done = [one for piece in shared_out(Place().begin, items, 2, int) for one in piece]

    where = {place: made[0] for place, made in done if isinstance(made, tuple)}
    assert sorted(where) == list(range(160))
    assert len(set(where.values())) <= 2
    assert os.getpid() not in where.values()
    assert all(len({where[place] for place in range(item, 160, 20)}) == 1 for item in range(20))


def test_many_that_are_alike_go_to_all_processes_and_what_is_large_stops_nobody() -> None:
    sizes = [len(piece) for piece in shared_out(Place().begin, [1] * 100, 2, int)]
    done = [one for piece in shared_out(Place(300_000).begin, ["y" * 300_000] * 40, 2, len) for one in piece]

    assert sum(sizes) == 100
    assert max(sizes) <= 16
    assert [len(made[1]) for _, made in done if isinstance(made, tuple)] == [300_000] * 40


def test_what_cannot_be_sent_is_an_error_and_no_process_stays() -> None:
    before = {*multiprocessing.active_children()}  # of other tests: one that reads drawings stays
    with pytest.raises((AttributeError, PicklingError), match="pickle"):
        list(shared_out(Place(odd=31).begin, list(range(60)), 2, str))

    assert {*multiprocessing.active_children()} <= before


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
    before = {*multiprocessing.active_children()}
    with pytest.raises(ValueError):
        list(shared_out(Slow(tmp_path).begin, range(40), 2, lambda item: item > 0))

    assert {*multiprocessing.active_children()} <= before
    assert len(list(tmp_path.iterdir())) < 16  # a piece


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore")  # what Dask warns of is not ours
class TestCluster:
    """On a cluster."""

    @pytest.fixture(scope="class")
    def address(self) -> Iterator[str]:
        from distributed import LocalCluster

        with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster:
            yield str(cluster.scheduler_address)

    @pytest.fixture
    def idle(self, tmp_path: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
        """A scheduler without workers: its address, its process."""
        place = tmp_path / "scheduler.json"
        command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard"]
        with subprocess.Popen([*command, "--scheduler-file", str(place)], stderr=subprocess.DEVNULL) as going:
            while not place.exists() or not place.read_text():
                time.sleep(0.05)
            yield json.loads(place.read_text())["address"], going
            going.kill()

    def test_a_cluster_gives_the_same_bytes(self, tmp_path: Path, address: str) -> None:
        rows = [f"S{number};{number:02d}" for number in range(58)]
        file = roster(tmp_path, *rows, "Bad;x", "None;", head="student;record book")
        tasks = ["nau-slider-crank"] * 6 + ["scheme-19-scotch-yoke"] * 4

        there = batch(tasks, file, tmp_path / "there", only="structure,velocity", dask=address, lang="en")
        here = batch(tasks, file, tmp_path / "here", only="structure,velocity", jobs=2, lang="en")

        assert len(there.problems) == 2
        assert there.outcomes == here.outcomes
        assert files(tmp_path / "there") == files(tmp_path / "here")

    def test_an_item_that_kills_workers_is_found_out(self, address: str) -> None:
        work = Squares(frozenset({13}))

        done = [one for piece in on_cluster(work.begin, list(range(24)), str, address) for one in piece]

        assert dict(done) == {n: n * n if n != 13 else None for n in range(24)}

    def test_a_worker_that_cannot_do_the_work_is_told_in_a_line(self, address: str) -> None:
        with pytest.raises(InputError, match="cannot do the work: No module named 'kulman'"):
            list(on_cluster(Strange().begin, [1], str, address))

    def test_a_scheduler_that_goes_is_told_in_a_line(self, idle: tuple[str, subprocess.Popen[bytes]]) -> None:
        there, going = idle
        Thread(target=kill_when_reached, args=(going,)).start()

        with pytest.raises(InputError, match=f"{there} no longer answers"):
            list(on_cluster(Squares().begin, [1, 2, 3], str, there))

        assert logging.root.manager.disable == logging.NOTSET

    def test_a_scheduler_without_workers_or_none_at_all_is_told_in_a_line(
        self, idle: tuple[str, subprocess.Popen[bytes]], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr("kulman.variants.crew.ROUND", 0.2)
        monkeypatch.setattr("kulman.variants.crew.ANSWERS", "1s")

        with pytest.raises(InputError, match=f"{idle[0]} has no workers"):
            list(on_cluster(Squares().begin, [1, 2, 3], str, idle[0]))
        with pytest.raises(InputError, match=r"tcp://127\.0\.0\.1:9"):
            next(on_cluster(Squares().begin, [1], str, "tcp://127.0.0.1:9"))

    def test_a_cluster_with_tls_lets_in_who_has_a_certificate(self, tmp_path: Path) -> None:
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
                done = [made for piece in on_cluster(Squares().begin, [2, 3], str, address) for made in piece]
            with pytest.raises(InputError, match="no certificates for TLS"):
                list(on_cluster(Squares().begin, [2, 3], str, address))

        assert [made for _, made in done] == [4, 9]


@pytest.mark.skipif(sys.platform == "win32", reason="no signals of a terminal")
def test_a_process_that_is_being_started_does_not_hear_of_ctrl_c() -> None:
    process = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(0.1,))
    with without_script():
        process.start()
    assert process.pid is not None
    os.kill(process.pid, signal.SIGINT)  # as a terminal tells all processes
    process.join(60.0)

    assert process.exitcode == 0
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())  # this one hears again


@dataclass(frozen=True)
class Strange(Squares):
    """What a worker without the module cannot unpack."""

    def __reduce__(self) -> tuple[object, ...]:
        return missing, ()


def missing() -> None:
    raise ModuleNotFoundError("No module named 'kulman'")


def kill_when_reached(scheduler: subprocess.Popen[bytes]) -> None:
    from distributed import default_client

    for _ in range(1200):
        with suppress(ValueError):
            if default_client().futures:
                break
        time.sleep(0.05)
    scheduler.kill()
