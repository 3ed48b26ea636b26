"""A server of its own under what a class, or somebody who means it ill, does to it: it lives, and leaves nothing."""

from __future__ import annotations

import http.client
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from kulman import load_task
from kulman.tests.support.serving import served

pytestmark = pytest.mark.soak
TASK = "nau-slider-crank"
CLASS = "scheme-09-shaper"
HUGE = 100_000_000


def get(address: str, path: str) -> tuple[int, bytes]:
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.netloc, timeout=120)
    connection.request("GET", f"{parts.path}{path}")
    answer = connection.getresponse()
    found = answer.status, answer.read()
    connection.close()
    return found


def timed(address: str, path: str) -> float:
    begun = time.perf_counter()
    status, data = get(address, path)
    assert status == 200
    assert b"page.svg" in data
    return time.perf_counter() - begun


def children(process: int) -> list[int]:
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process)], capture_output=True, text=True, check=False)
    return [int(word) for word in found.stdout.split()]


def test_thirty_different_sheets_that_are_asked_for_at_once_all_come() -> None:
    variants = load_task(CLASS).variants
    paths = [f"task/{CLASS}?v={name}&of={name}&g.phi={phi}" for name in variants for phi in (40, 75, 130)]
    assert len(paths) == 30
    with served() as (address, _):
        with ThreadPoolExecutor(30) as many:
            sheets = [*many.map(lambda path: get(address, path.replace("?", "/page.svg?")), paths)]

        assert [status for status, _ in sheets] == [200] * 30
        assert len({svg for _, svg in sheets}) == 30


def test_a_server_lives_through_what_is_sent_to_it() -> None:
    with served() as (address, process):
        parts = urlsplit(address)
        assert parts.hostname is not None
        where = parts.hostname, parts.port
        kind = "Content-Type: multipart/form-data; boundary=x"
        head = f"POST {parts.path}own HTTP/1.1\r\nHost: {parts.netloc}\r\n{kind}\r\n"
        half = [socket.create_connection(where) for _ in range(50)]
        waiting = ExitStack()
        for one in half:
            waiting.enter_context(one)
        for number, one in enumerate(half):  # requests that never end, bodies that hardly come
            one.sendall((head[:40] if number % 2 else f"{head}Content-Length: 1000\r\n\r\n--x").encode())
        with socket.create_connection(where) as large:
            large.sendall(f"{head}Content-Length: {HUGE}\r\n\r\n".encode())
            for _ in range(HUGE // 1_000_000):
                large.sendall(b"x" * 1_000_000)
            assert large.recv(100).startswith(b"HTTP/1.1 413")
        with socket.create_connection(where) as endless:
            endless.sendall(f"{head}Transfer-Encoding: chunked\r\n\r\n".encode())
            with suppress(OSError):  # it hangs up
                for _ in range(300):
                    endless.sendall(b"f4240\r\n" + b"x" * 1_000_000 + b"\r\n")
                raise AssertionError
        assert timed(address, f"task/{TASK}?v=4") < 30.0
        for one in half:
            one.settimeout(70.0)
            assert one.recv(100)[:12] in (b"", b"HTTP/1.1 408")
        waiting.close()
        for worker in children(process.pid):
            os.kill(worker, 9)
        assert timed(address, f"task/{TASK}?v=5") < 30.0


@pytest.mark.skipif(sys.platform == "win32", reason="no groups of processes")
@pytest.mark.parametrize("sign", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_a_signal_to_all_processes_at_once_leaves_nothing_for_longer_than_until_the_next_server(
    sign: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with served(start_new_session=True) as (address, process), ThreadPoolExecutor(6) as many:
        asked = [many.submit(get, address, f"task/{TASK}?v={n}") for n in range(6)]
        while len([*tmp_path.glob("kulman-serve-*/seat-*")]) < 2:  # until it is at work
            time.sleep(0.05)
        os.killpg(process.pid, sign)
        process.wait(30)
        for one in asked:
            with suppress(OSError, http.client.HTTPException):
                one.result()
    for left in tmp_path.glob("kulman-serve-*"):
        assert sign == signal.SIGKILL
        os.utime(left, (0, 0))
    with served() as _:
        assert len([*tmp_path.glob("kulman-serve-*")]) == 1
    assert [*tmp_path.glob("kulman-serve-*")] == []


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGTERM")
def test_who_waits_when_a_server_ends_is_told_so() -> None:
    with served(stderr=subprocess.PIPE) as (address, process), ThreadPoolExecutor(20) as many:
        paths = (f"task/{task}?v={n}" for task in (CLASS, "scheme-20-press-automaton") for n in range(10))
        asked = [many.submit(get, address, path) for path in paths]  # more than two processes draw in a second
        time.sleep(1.0)
        process.terminate()
        _, told = process.communicate(timeout=30)
        answers = [one.result() for one in asked]
    assert "Traceback" not in told
    assert {answer for answer in answers if answer[0] != 200} == {(503, b"503 the server ends\n")}


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_killed_server_leaves_nothing_behind() -> None:
    before = {*Path(tempfile.gettempdir()).glob("kulman-serve-*")}
    with served() as (address, process):
        timed(address, f"task/{TASK}?v=3")
        workers = children(process.pid)
        made = {*Path(tempfile.gettempdir()).glob("kulman-serve-*")} - before
        assert made
        assert workers
        process.kill()
        process.wait()
        for _ in range(100):
            left = [path for path in made if path.exists()]
            alive = [worker for worker in workers if Path(f"/proc/{worker}").exists()]
            if not left and not alive:
                break
            time.sleep(0.1)
        assert (left, alive) == ([], [])
