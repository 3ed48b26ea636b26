"""Photographs in the browser: marked as the command marks them, what is not sure is asked, nobody asks for others'."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

import kulman
from kulman.tests.photos.stacks import TASK, Stack
from kulman.tests.support.serving import asked
from kulman.variants.photos import reading
from kulman.variants.photos.asking import OUT, Asking, EndAsk, PageAsk, Told
from kulman.variants.serving.asking import PASSED, Sitting, place_of
from kulman.variants.serving.jobs import KEPT
from kulman.variants.serving.making import Asked, Handed, Upload, marked_class
from kulman.variants.serving.safety import doors_for

CHECK = f"/task/{TASK}/check?v=3"


def followed(client: TestClient, answer: Any) -> str:
    """Return the page to which an answer leads."""
    assert answer.status_code == 303, answer.text
    return client.get(path_of(client, answer.headers["location"])).text


def path_of(client: TestClient, address: str) -> str:
    return unescape(address).removeprefix(client.base_url.path.rstrip("/")).partition("#")[0]


def links(client: TestClient, page: str, part: str) -> list[str]:
    return [path_of(client, found) for found in re.findall(r'(?:href|src|action)="([^"]+)"', page) if part in found]


def upload(*files: Path) -> list[tuple[str, tuple[str, bytes]]]:
    return [("drawing", (file.name, file.read_bytes())) for file in files]


def test_a_blank_to_be_photographed_is_that_of_the_command(client: TestClient, tmp_path: Path) -> None:
    (file,) = kulman.handout(TASK, "3", scan=True, lang="en").save(tmp_path / "x.pdf")

    assert client.get(f"/task/{TASK}/scan.pdf?v=3").content == file.read_bytes()
    assert links(client, client.get(f"/task/{TASK}?v=3").text, "/scan.pdf")
    assert not links(client, client.get("/task/madi-gear").text, "/scan.pdf")  # whose plans are not read


@pytest.fixture(scope="module")
def report(client: TestClient, stack: Stack) -> str:
    """What a student gets who has handed in a photograph and one that cannot be read."""
    good, _, _, blurred = stack.pictures
    return followed(client, client.post(CHECK, files=upload(good, blurred)))


def test_a_place_of_the_picture_means_the_spot_near_it(client: TestClient, report: str) -> None:
    (questions,) = links(client, report, "/asked/")
    ask = client.app_state["desk"].sittings.get(questions.rpartition("/")[2]).asking.ends[0]  # type: ignore[attr-defined]
    spot = ask.spots[-1]
    at = f"{spot.real - ask.box[0] + 0.3:.2f},{ask.box[3] - spot.imag:.2f}"

    page = client.get(f"{questions}/1", params={"at": at, "move": "tip"}).text

    (tip,) = re.findall(r'name="tip" value="([^"]+)"', page)
    assert abs(complex(*map(float, tip.split(","))) - spot) < 0.02
    for words in ({"tip": "nan,nan"}, {"tip": "1e9,1"}, {"at": "<b>,1"}, {"move": "x"}):
        assert client.get(f"{questions}/1", params=words).status_code == 200
    assert client.get(f"{questions}/99").status_code == 404
    assert client.get(f"{questions}/plan/none.png").status_code == 404
    assert client.get("/asked/nobody").status_code == 404


def test_a_student_hands_in_photographs_and_answers_what_is_not_sure(
    client: TestClient, report: str, stack: Stack
) -> None:
    (questions,) = links(client, report, "/asked/")
    overview = client.get(questions).text
    question = client.get(f"{questions}/1").text

    assert report.count("data:image/jpeg") == 1
    assert client.get(links(client, report, "/result/")[0]).content.startswith(b"%PDF")
    assert f"{stack.pictures[-1].name}: " in overview  # which could not be read
    assert "a<sup>n</sup><sub>BA</sub>" in question
    assert "a<sup>n</sup><sub>BA</sub>" not in report.partition("<table>")[2]
    (picture,) = links(client, question, ".png")
    assert client.get(picture).content.startswith(b"\x89PNG")
    at = f"{questions}/1"
    while not at.endswith("#done"):
        ends = dict(re.findall(r'name="(tail|tip)" value="([^"]+)"', client.get(path_of(client, at)).text))
        told = client.post(path_of(client, at), data={**ends, "say": "yes" if len(ends) == 2 else "?"})
        at = told.headers["location"]

    marked = followed(client, client.post(questions))

    assert "a<sup>n</sup><sub>BA</sub>" in marked.partition("<table>")[2]


def test_photographs_of_a_class_are_read_once_to_ask_and_to_mark(
    stack: Stack, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read, photographed = list[int](), reading.photographed

    def counted(photos: Any, *more: Any) -> Any:
        read.append(len(photos))
        return photographed(photos, *more)

    monkeypatch.setattr(reading, "photographed", counted)
    files = tuple(Upload(file.name, file.read_bytes()) for file in stack.pictures[:1])
    handed = Handed(Asked(TASK), files, {}, Upload("roster.csv", stack.roster.read_bytes()))
    (tmp_path / KEPT).mkdir()

    def done(told: Told | None, asked: str, archive: str) -> set[str]:
        (folder := tmp_path / archive).mkdir()
        monkeypatch.chdir(folder)
        asking = marked_class(lambda *of: None, handed, told, asked, f"{archive}.zip", 1).asking
        assert (asking is None) is (told is not None)
        return {file.name for file in (tmp_path / KEPT).iterdir()}

    assert done(None, "", "one") == {"one"}
    assert done(Told(), "one", "two") == {"two", "two.zip"}
    assert done(Told(), "two", "three") == {"two.zip", "three", "three.zip"}
    assert read == [1]
    assert done(Told(), "", "four") == {"two.zip", "three", "three.zip", "four.zip"}  # of which nothing was asked
    assert read == [1, 1]


@pytest.mark.parametrize("text", ["", "1", "1,2,3", "nan,1", "inf,1", "-1,1", "11,1", "a,b"])
def test_no_other_places_are_taken(text: str) -> None:
    assert place_of(text, (0.0, 0.0, 10.0, 10.0)) is None
    assert place_of("3.5,2", (0.0, 0.0, 10.0, 10.0)) == 3.5 + 2j


def sitting(alone: bool = False) -> Sitting:
    """Return questions about three pages and two vectors of one plan that share a point."""
    pages = (
        PageAsk("whose", ("a",), ("forms/001-x.jpg",)),
        PageAsk("which", ("b", "c"), ("forms/001-x.jpg", "forms/002-y.jpg"), 2),
    )
    box = (0.0, 0.0, 100.0, 100.0)
    ends = (
        EndAsk("b", "forms/001-x.jpg", "", "plan", "V_B", "V_B", 10 + 10j, 50 + 10j, (0, 1), (50 + 12j,), (), box, "p"),
        EndAsk("b", "forms/001-x.jpg", "", "plan", "V_CB", "V_CB", None, 70 + 70j, (1, 2), (), (), box, "p"),
        EndAsk("c", "forms/002-y.jpg", "", "plan", "V_B", "V_B", None, None, (0, 1), (), (), box, "q"),
    )
    files = (Upload("x y.jpg", b"12"), Upload("z.jpg", b"3"))
    return Sitting("s", Handed(Asked(TASK), files, {}, alone=alone), "/marks", Asking(pages, ends, {"p": b"4"}))


def test_answers_are_noted_and_help_with_other_questions() -> None:
    one = sitting()
    whose, which, v_b, v_cb, _ = one.asks

    one.answer(whose, "#3", None)
    one.answer(which, "b", None)
    one.answer(v_b, "yes", (10 + 10j, 50 + 12j))

    assert one.left == [4]  # the page of the last one is left out
    assert one.believed(v_cb) == (50 + 12j, 70 + 70j)
    assert one.told.pages == {"a": "#3", "c": OUT}
    assert one.told.ends == {("b", "V_B"): (10 + 10j, 50 + 12j)}
    one.answer(v_b, OUT, None)
    one.answer(v_cb, PASSED, None)
    one.answer(which, "c", None)
    assert (one.told.pages["b"], "c" in one.told.pages) == (OUT, False)
    assert one.told.ends == {("b", "V_B"): None}
    assert one.left == [5]


def test_a_student_sees_nothing_of_a_class() -> None:
    doors = doors_for("127.0.0.1", (), {"teacher": "teacher-word", "student": "student-word"})
    with asked(doors) as client:
        desk = client.app_state["desk"]  # type: ignore[attr-defined]
        desk.sittings.keep("class", sitting())
        desk.sittings.keep("own", sitting(alone=True))
        for path in ("", "/1", "/3", "/plan/p.png", "/sent/0"):
            assert client.get(f"/asked/class{path}", auth=("student", "student-word")).status_code == 403
            assert client.get(f"/asked/class{path}", auth=("teacher", "teacher-word")).status_code == 200
            assert client.get(f"/asked/own{path}", auth=("student", "student-word")).status_code == 200
        assert client.post("/asked/class", auth=("student", "student-word")).status_code == 403
        sent = client.get("/asked/class/sent/0", auth=("teacher", "teacher-word"))
        assert (sent.content, sent.headers["content-type"]) == (b"12", "image/jpeg")
        assert sent.headers["content-security-policy"] == "sandbox"
