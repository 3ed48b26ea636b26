"""Nothing from elsewhere is answered, nothing that is asked reaches a file, every job is bounded."""

from __future__ import annotations

import asyncio
import gc
import os
import time
from collections.abc import Iterator
from contextlib import closing
from html import unescape
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from starlette.testclient import TestClient

from kulman.scales.errors import InputError
from kulman.scales.kept import COLLECTED
from kulman.tests.support.jobs import dies, dies_once, fails, leaves, sleeps, takes
from kulman.tests.support.serving import asked
from kulman.variants.serving import jobs
from kulman.variants.serving.desk import Desk
from kulman.variants.serving.jobs import BusyError, CrashError, Crew, Seat
from kulman.variants.serving.pages import tag
from kulman.variants.serving.safety import doors_for, read_passwords

TASK = "nau-slider-crank"


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        pytest.param({"Host": "evil.example"}, 421, id="foreign host"),
        pytest.param({"Host": "127.0.0.1.evil.example"}, 421, id="host that begins like ours"),
        pytest.param({"Host": ""}, 421, id="no host"),
        pytest.param({"Origin": "http://evil.example"}, 403, id="foreign origin"),
        pytest.param({"Origin": "null"}, 403, id="no origin of a frame"),
        pytest.param({"Origin": "http://127.0.0.1:9999"}, 403, id="origin of another port"),
        pytest.param({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors"}, 403, id="picture on another site"),
        pytest.param({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate"}, 200, id="link from elsewhere"),
        pytest.param({"Host": "LOCALHOST:8765"}, 200, id="other name of ours"),
        pytest.param({"Content-Length": "100000000"}, 413, id="100 MB"),
        pytest.param({"Content-Length": "nonsense"}, 413, id="no length"),
    ],
)
def test_foreign_requests_are_refused(headers: dict[str, str], status: int, client: TestClient) -> None:
    assert client.get("/own", headers=headers).status_code == status


@pytest.mark.parametrize("path", ["/", "/own", "/no-such-token/", "/task/madi-cam", "/static/web.css"])
def test_without_the_token_nothing_is_shown(path: str, client: TestClient) -> None:
    answer = client.get(f"http://127.0.0.1{path}")

    assert answer.status_code == 403
    assert client.base_url.path.strip("/") not in answer.text


@pytest.mark.parametrize(
    "name", ["../cli.py", "..%2f..%2fcli.py", "%2e%2e/%2e%2e/etc/passwd", "/etc/passwd", "a%00b", "con"]
)
@pytest.mark.parametrize(
    "at", ["/static/{}", "/task/{}", "/picture/{}.svg", f"/task/{TASK}/{{}}.svg", "/result/{}", "/job/{}"]
)
def test_no_path_leads_to_a_file(at: str, name: str, client: TestClient) -> None:
    answer = client.get(at.format(name))

    assert answer.status_code == 404
    assert "import" not in answer.text


def test_an_answer_loads_nothing_from_elsewhere_and_leaves_no_cookie(client: TestClient) -> None:
    answer = client.get(f"/task/{TASK}")

    assert "default-src 'none'" in answer.headers["content-security-policy"]
    assert "unsafe" not in answer.headers["content-security-policy"]
    assert "set-cookie" not in answer.headers
    assert answer.headers["referrer-policy"] == "same-origin"
    assert answer.text.count("<script") == 1
    assert "<style" not in answer.text
    assert " style=" not in answer.text


def test_texts_are_escaped() -> None:
    assert tag("p", "<b>", title='"&') == '<p title="&quot;&amp;">&lt;b&gt;</p>'


def chunks(megabytes: int) -> Iterator[bytes]:
    yield from (b"x" * 1_000_000 for _ in range(megabytes))


def test_a_body_without_a_length_is_bounded(client: TestClient) -> None:
    answer = client.post("/own", content=chunks(60), headers={"Content-Type": "multipart/form-data; boundary=x"})

    assert answer.status_code == 413


@pytest.fixture(scope="module")
def passwords(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("serving") / "passwords.txt"
    file.write_text("# ours\nteacher: long enough\nstudent: quite long\n")
    return file


def test_students_see_what_they_may(passwords: Path) -> None:
    doors = doors_for("127.0.0.1", ("plans.example.edu",), read_passwords(passwords))
    student: Any = {"auth": ("student", "quite long")}
    teacher: Any = {"auth": ("teacher", "long enough")}
    with asked(doors) as client:
        for allowed, seen in (("forms", "100"), ("sheets", "110"), ("answers", "111")):
            client.app_state["desk"].allowed = allowed
            found = (client.get(f"/task/{TASK}/{file}", **student) for file in ("form.csv", "sheet.svg", "results.csv"))
            assert "".join("1" if answer.status_code == 200 else "0" for answer in found) == seen
            page = client.get(f"/task/{TASK}", **student).text
            linked = "1" + "".join("01"[f"/task/{TASK}/{file}" in page] for file in ("sheet.svg", "results.csv"))
            assert linked == seen
            paper = "A4" if allowed == "forms" else "A1"  # that of what they may see: the form told of the sheet's
            told = (client.get(f"/task/{TASK}/{page}?v=3", **student) for page in ("check", "form.csv"))
            assert all(f": {paper}: " in unescape(answer.text) for answer in told)
        assert client.get("/class", **student).status_code == 403
        assert client.get("/class", **teacher).status_code == 200
        begun = time.monotonic()
        assert client.get("/", auth=("teacher", "wrong")).status_code == 401
        assert time.monotonic() - begun > 0.4
        asked_for = client.get("/")
        assert asked_for.headers["www-authenticate"].startswith("Basic")
        assert all(
            word in asked_for.text for word in ("teacher or student", "teacher або student", "teacher или student")
        )
        assert client.get("http://plans.example.edu/", **teacher).status_code == 200


@pytest.mark.parametrize(
    "text", ["", "student: quite long", "teacher: short", "teacher: long enough\nroot: long enough"]
)
def test_a_wrong_file_of_passwords_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "passwords").write_text(text)

    with pytest.raises(InputError, match="teacher"):
        read_passwords(tmp_path / "passwords")


def interrupted(*said: int) -> None:
    raise KeyboardInterrupt


def test_a_process_is_bounded_and_mended(tmp_path: Path) -> None:
    seat, far = Seat(tmp_path / "seat", memory=1_000_000_000), list[tuple[int, int]]()
    try:
        assert seat.do(sleeps, (0.0,), 60.0, lambda *said: far.append(said)) == str(tmp_path / "seat")
        assert far == [(1, 2)]
        with pytest.raises(InputError, match=r"longer than 1 s"):
            seat.do(sleeps, (60.0,), 1.0, print)
        assert seat.do(dies_once, (str(tmp_path / "once"),), 60.0, print) == "done"
        with pytest.raises(KeyboardInterrupt):
            seat.do(sleeps, (0.0,), 60.0, interrupted)
        assert seat.do(dies_once, (str(tmp_path / "once"),), 60.0, print) == "done"  # not what the other one has made
        with pytest.raises(InputError, match="crash"):
            seat.do(dies, (), 60.0, print)
        with pytest.raises(CrashError, match="ZeroDivisionError"):
            seat.do(fails, (), 60.0, print)
        assert seat.do(sleeps, (0.0,), 60.0, lambda *said: None)
        assert [*(tmp_path / "seat").iterdir()] == []
        if os.name == "posix":
            with pytest.raises(InputError, match="memory"):
                seat.do(takes, (4_000_000_000,), 60.0, print)
    finally:
        seat.stop()


def test_a_process_looks_for_garbage_between_two_jobs_not_while_it_is_at_one(tmp_path: Path) -> None:
    seat = Seat(tmp_path / "seat")
    try:
        assert seat.do(leaves, (str(tmp_path / "gone"),), 60.0, print) == COLLECTED
        seat.do(sleeps, (0.0,), 60.0, lambda *said: None)
        assert (tmp_path / "gone").exists()
    finally:
        seat.stop()


def test_more_than_may_wait_is_told_to_come_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs.Seat, "do", lambda self, make, args, seconds, advance: time.sleep(0.2))

    async def several() -> list[Any]:
        crew = Crew(1, 2, 60.0, tmp_path, "seat")
        return await asyncio.gather(*(crew.do(sleeps, 0.0) for _ in range(5)), return_exceptions=True)

    found = asyncio.run(several())

    assert [type(one) for one in found].count(BusyError) == 2


@pytest.mark.parametrize("stopped", [True, False])
def test_a_server_that_is_stopped_at_a_job_complains_of_none(
    stopped: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, ended = Event(), Event()

    def killed(*job: Any) -> None:
        begun.set()
        ended.wait(60.0)
        raise InputError("serve-died")

    async def one() -> list[Any]:
        crew, told = Crew(1, 2, 60.0, tmp_path, "seat"), list[Any]()
        asyncio.get_running_loop().set_exception_handler(lambda loop, what: told.append(what["exception"]))
        asked = asyncio.create_task(crew.do(sleeps, 0.0))
        await asyncio.to_thread(begun.wait, 60.0)
        asked.cancel()  # whoever has asked is gone, as all are when Ctrl+C ends the server
        if stopped:
            crew.stop()
        ended.set()
        while len(asyncio.all_tasks()) > 1:
            await asyncio.sleep(0.01)
        del asked
        gc.collect()
        return told

    monkeypatch.setattr(jobs.Seat, "do", killed)
    told = asyncio.run(one())
    assert [type(error) for error in told] == ([] if stopped else [InputError])  # a live one complains


@pytest.mark.parametrize(("cores", "seats"), [(None, 2), (1, 2), (2, 2), (6, 6)])
def test_a_server_has_a_process_for_each_core_and_never_one_alone(
    cores: int | None, seats: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: cores)

    with closing(Desk(doors_for("127.0.0.1", (), None), "forms")) as desk:
        assert (len(desk.crew.seats), len(desk.photos.seats), len(desk.classes.seats)) == (seats, seats // 2, 1)


def test_a_busy_server_says_so(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    desk = client.app_state["desk"]

    async def busy(*args: Any, **how: Any) -> None:
        raise BusyError

    monkeypatch.setattr(desk.crew, "do", busy)
    answer = client.get(f"/task/{TASK}?v=9&lang=uk")

    assert answer.status_code == 503
    assert answer.headers["retry-after"] == "10"
    assert "через кілька секунд" in answer.text
