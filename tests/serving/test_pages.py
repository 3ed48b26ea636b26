"""The program in a browser gives what the same calls give, and says what is wrong where it is wrong."""

from __future__ import annotations

import io
import re
import time
import zipfile
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
from starlette.testclient import TestClient

import kulman
from kulman.tests.support.answer_files import write
from kulman.variants.marking.checks import write_tables
from kulman.variants.marking.report import report_html
from kulman.variants.reader import load_task
from kulman.variants.serving.making import Job
from kulman.variants.serving.pages import Door, job
from kulman.variants.shelf import bundled, bundled_text, guide_text, guides

TASK = "nau-slider-crank"
ROSTER = "student;group;variant\nІ. Петренко;АТ-301;3\nО. Коваль;АТ-301;7\n".encode()


def files(folder: Path) -> dict[str, bytes]:
    found = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def unpacked(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def archived(client: TestClient, page: str) -> bytes:
    return client.get(f"{page}/{page.rpartition('/')[2]}.zip").content


def finished(client: TestClient, begun: Any) -> str:
    """Wait until the work for a class is done; return the address of its page."""
    assert begun.status_code == 303, begun.text
    path = begun.headers["location"].removeprefix(client.base_url.path.rstrip("/"))
    for _ in range(600):
        state = client.get(f"{path.partition('?')[0]}/state").json()
        if state["over"]:
            return str(path.partition("?")[0])
        time.sleep(0.1)
    raise AssertionError(state)


@pytest.mark.parametrize(("done", "whole", "told"), [(0, 0, "0 of …"), (2, 5, "2 of 5")])
def test_work_whose_extent_is_not_known_yet_is_told_without_it(done: int, whole: int, told: str) -> None:
    door = Door("", "en", False, "teacher", "forms", {})

    page = unescape(job(door, Job("x", "Class", done, whole)))

    assert re.findall(r"\d+ of [\d…]+", page) == [told] * 3  # the bar, its name, the line below


def test_every_task_stands_on_the_first_page_with_its_picture(client: TestClient) -> None:
    page = client.get("/").text

    assert re.findall(r'/picture/([\w-]+)\.svg"', page) != []
    assert sorted(re.findall(r'/picture/([\w-]+)\.svg"', page)) == [*bundled()]
    for task in (TASK, "madi-gear"):
        answer = client.get(f"/picture/{task}.svg")
        assert answer.headers["content-type"] == "image/svg+xml"
        assert answer.text.count("<path") + answer.text.count("<line") > 5


def test_a_sheet_is_that_of_the_command(client: TestClient, tmp_path: Path) -> None:
    page = client.get(f"/task/{TASK}?v=3&student=Eve+%3Cscript%3E").text
    image = unescape(re.findall(r'<img src="[^"]*?(/task/[^"]*)"', page)[0])
    drawn = kulman.sheet(TASK, "3", student="Eve <script>", lang="en")
    drawn.save(tmp_path / "sheet.pdf")

    assert "<script>" not in page.partition("<body>")[2]
    assert client.get(image).text == drawn.svg(1)
    pdf = client.get(f"/task/{TASK}/sheet.pdf?v=3&student=Eve+%3Cscript%3E")
    assert pdf.content == (tmp_path / "sheet.pdf").read_bytes()
    assert pdf.headers["content-disposition"] == f'attachment; filename="{TASK}-3-sheet.pdf"'


def test_pages_of_a_sheet_are_turned(client: TestClient) -> None:
    drawn = kulman.sheet(TASK, "3", format="A3", lang="en")
    page = client.get(f"/task/{TASK}?v=3&format=A3&page=2").text

    assert len(drawn.pages) > 1
    assert f'aria-label="page 2 of {len(drawn.pages)}" aria-current="page"' in page
    assert client.get(f"/task/{TASK}/page.svg?v=3&format=A3&page=2").text == drawn.svg(2)
    assert client.get(f"/task/{TASK}/page.svg?v=3&format=A3&page=99").status_code == 404


@pytest.mark.parametrize(("lang", "called"), [("uk", "швидкості"), ("ru", "скорости"), ("en", "velocities")])
def test_one_plan_alone_may_be_chosen_and_downloaded(lang: str, called: str, client: TestClient) -> None:
    alone = kulman.sheet(TASK, "3", only="velocity", lang=lang)
    at = f"/task/{TASK}?v=3&only=velocity&lang={lang}"

    page = client.get(at).text

    assert re.search(rf'<option[^>]*value="velocity"[^>]*selected[^>]*>{called}<', page)
    for task in (TASK, "madi-cam", "madi-gear", "karpenko-hoist"):
        options = client.get(f"/task/{task}?lang={lang}").text.partition('name="only"')[2].partition("</select>")[0]
        names = re.findall(r'<option value="(\w+)">(.*?)<', options)
        assert [plan for plan, _ in names] == [*load_task(task).plans]
        assert lang == "en" or all(re.fullmatch("[а-яїієґ ]+", name) for _, name in names), names
    assert client.get(at.replace("?", "/page.svg?")).text == alone.svg(1)
    assert client.get(at.replace("?", "/sheet.svg?")).text == alone.svg(1)
    assert "only=velocity" in re.findall(r'href="[^"]*/sheet\.pdf[^"]*"', page)[0]
    answers = client.get(at.replace("?", "/form.csv?")).text
    assert "V_B" in answers
    assert "a_B" not in answers
    assert client.get(at.replace("velocity", "velocity,acceleration")).text.count("velocity,acceleration") > 1
    assert client.get(f"/task/{TASK}?v=3&only=nonsense&lang={lang}").status_code == 200  # told on the page


def test_data_of_ones_own_go_on_to_all_files_and_to_another_variant(client: TestClient) -> None:
    given = {
        "v": "7",
        "of": "3",
        "g.l_OA": "5,5 cm",
        "g.l_AB": "190",
        "g.phi": "120",
    }  # l_AB, phi as variant 3 has them
    own = kulman.solve(TASK, "7", set={"l_OA": "55 mm"})
    page = client.get(f"/task/{TASK}", params=given).text
    address = unescape(re.findall(r'href="[^"]*?(/task/[^"]*/results\.csv[^"]*)"', page)[0])

    assert re.findall(r"g\.(\w+)=", address) == ["l_OA"]
    assert client.get(address).text == own.csv("en")
    refused = client.get(f"/task/{TASK}?v=3&g.l_OA=-5").text
    assert 'role="alert"' in refused
    assert "-5" in refused


FILES = "handout.pdf", "key.svg", "note.md", "form.xlsx", "roster.csv", "moving.html", "positions.pdf", "charts.svg"


@pytest.mark.parametrize("file", FILES)
def test_what_belongs_to_a_sheet_can_be_saved(file: str, client: TestClient) -> None:
    answer = client.get(f"/task/{TASK}/{file}?v=3")

    assert answer.status_code == 200
    assert len(answer.content) > 50
    policy = answer.headers["content-security-policy"]
    assert "unsafe-inline" not in policy.partition("style-src-attr")[0] or "sandbox" in policy


def test_the_whole_cycle_can_be_saved_and_is_drawn_of_linkages(client: TestClient) -> None:
    own = kulman.sweep(TASK, "7", set={"l_OA": "55 mm"}).csv("en")
    offered = {task: client.get(f"/task/{task}").text for task in (TASK, "madi-gear")}

    assert client.get(f"/task/{TASK}/cycle.csv?v=7&of=7&g.l_OA=55").text == own
    assert client.get("/task/madi-gear/cycle.csv").status_code == 200
    assert ["positions.pdf" in page for page in offered.values()] == [True, False]


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
def test_pages_are_in_the_language_of_the_address_and_keep_it(language: str, client: TestClient) -> None:
    page = client.get(f"/?lang={language}").text

    assert f'<html lang="{language}">' in page
    assert f"lang={language}" in re.findall(r'href="([^"]*/task/madi-cam[^"]*)"', page)[0]
    assert kulman.load_task("madi-cam").title[language] in unescape(page)


def test_a_form_asks_of_each_row_what_it_can_hold(client: TestClient) -> None:
    page = client.get(f"/task/{TASK}/check?v=3").text
    columns = dict[str, str]()
    for column, symbol in re.findall(r'name="a\.\d+\.(\d)"[^>]*aria-label="([^:"]+):', page):
        columns[symbol] = columns.get(symbol, "") + column
    # columns of the form: 3 segment, 4 scale factor, 5 value, 7 direction or sense
    assert {symbol: columns[symbol] for symbol in ("μ_V", "V_A", "ω_2", "a^n_BA", "M_bal")} == {
        "μ_V": "4",
        "V_A": "357",
        "ω_2": "57",
        "a^n_BA": "357",
        "M_bal": "57",
    }


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
def test_guides_are_pages_that_lead_to_one_another_and_to_tasks(language: str, client: TestClient) -> None:
    headings, pages = guides(language), dict[str, str]()
    listed = unescape(client.get(f"/guide?lang={language}").text)
    assert all(heading in listed for heading in headings.values())
    for topic, heading in headings.items():
        pages[topic] = client.get(f"/guide/{topic}?lang={language}").text
        text = unescape(re.sub("<[^>]*>", "", pages[topic]))
        assert re.findall("<h1[^>]*>(.*?)</h1>", unescape(pages[topic])) == [heading]
        assert not re.search(r" style=|<!--|\]\(|\.md\b(?=\))", pages[topic])
        shown = [line for line in guide_text(topic, language).splitlines() if line.startswith("$ kulman")]
        assert all(line in text for line in shown)
    led = {to for page in pages.values() for to in re.findall('href="([^"]+)"', page)}
    inside = {to.removeprefix(client.base_url.path.rstrip("/")) for to in led if not re.match("#|https:", to)}
    assert {f"/task/scheme-09-shaper?lang={language}", f"/guide/marking?lang={language}"} <= inside
    for to in inside:
        path, _, part = to.partition("#")
        if path.startswith("/guide/"):
            assert not part or f'id="{unquote(part)}"' in pages[path.removeprefix("/guide/").partition("?")[0]]
        elif path.startswith("/task/"):
            assert path.removeprefix("/task/").partition("?")[0] in bundled()
    for topic, page in pages.items():
        for part in re.findall('href="#([^"]+)"', page):
            assert part == "main" or f'id="{unquote(part)}"' in page, topic
    none = client.get("/guide/none")
    assert (none.status_code, "There is nothing at this address" in none.text) == (404, True)


def test_a_form_says_nothing_of_cells_that_it_does_not_have(client: TestClient) -> None:
    told = re.findall("<p>(.*?)</p>", client.get(f"/task/{TASK}/check?v=3").text)
    hints, scales = (line for line in told if line.endswith("."))

    assert "Any cell may be left empty" in hints
    assert "μ<sub>l</sub> = 0.001 m/mm" in scales
    assert not {"student", "group", "sheet id"}.intersection(told)


def test_answers_are_marked_as_the_command_marks_them(client: TestClient, tmp_path: Path) -> None:
    page = client.get(f"/task/{TASK}/check?v=3").text
    names = dict(re.findall(r'name="(a\.\d+\.5)"[^>]*aria-label="([^:"]+):', page))
    field = {symbol: name for name, symbol in names.items()}
    answer = client.post(f"/task/{TASK}/check?v=3", data={field["V_A"]: "5,86", field["V_B"]: "9,9"})
    report = client.get(answer.headers["location"].removeprefix(client.base_url.path.rstrip("/"))).text
    (tmp_path / "answers.csv").write_text("quantity,value\nV_A,5.86\nV_B,9.9\n")
    asked = kulman.check(TASK, "3", lang="en")
    expected = report_html(asked.mark(asked.read(str(tmp_path / "answers.csv"))[0]))
    summary = re.findall(r"<p>Mark.*?</p>", expected)

    assert summary[0] in report
    assert "5.622" in report

    assert "answers.csv" not in report
    told = client.post(f"/task/{TASK}/check?v=3", data={field["V_A"]: "5,86", field["V_B"]: "abc"})
    report = client.get(told.headers["location"].removeprefix(client.base_url.path.rstrip("/"))).text
    assert "<li>V_B: &#x27;abc&#x27; is not a number" in report
    nothing = client.post(f"/task/{TASK}/check?v=3", data={})
    assert re.search('role="alert"[^>]*>(<[^>]+>)*the form is empty', nothing.text)


def test_the_saved_form_is_handed_in_with_data_of_ones_own(client: TestClient, tmp_path: Path) -> None:
    own = kulman.solve(TASK, "3", set={"l_OA": "55 mm"})
    rows = [["quantity", "value"], ["V_A", own["V_A"].value], ["V_B", own["V_B"].value]]
    book = write(tmp_path, rows, ".xlsx")

    said = [
        client.post(f"/task/{TASK}/check?{query}", files={"drawing": ("answers.xlsx", book.read_bytes())})
        for query in ("v=3&of=3&g.l_OA=55", "v=3")
    ]
    reports = [client.get(one.headers["location"].removeprefix(client.base_url.path.rstrip("/"))).text for one in said]

    assert [re.findall(r"Lines:[^<]*", report)[0].count("right 2") for report in reports] == [1, 0]


def test_a_drawing_is_handed_in_where_a_form_is(client: TestClient, tmp_path: Path) -> None:
    (file,) = kulman.sheet(TASK, "3", lang="en").save(tmp_path / "plans.pdf")
    data = file.read_bytes()
    page = client.get(f"/task/{TASK}/check?v=3").text

    answer = client.post(f"/task/{TASK}/check?v=3", files={"drawing": ("my plans.pdf", data)})
    report = client.get(answer.headers["location"].removeprefix(client.base_url.path.rstrip("/"))).text
    refused = client.post(f"/task/{TASK}/check?v=3", files={"drawing": ("plans.dwg", b"AC1032")})

    assert 'name="drawing"' in page
    assert "data:image/svg+xml" in report
    assert ".dxf" in refused.text


def test_a_task_of_ones_own_is_checked_at_its_lines_and_drawn(client: TestClient) -> None:
    good = bundled_text(TASK).replace(f'id = "{TASK}"', 'id = "my-own"')
    line = next(n for n, text in enumerate(good.splitlines(), 1) if text.startswith("l_AB"))
    bad = client.post("/own", data={"text": good.replace("l_AB = {", "l_AB = { nonsense = 1,")}).text

    assert re.search(rf'<li class="at"><code> +{line}  l_AB.*?</code><p class="fault">', bad)
    upload = {"file": ("../../etc/passwd", good.encode("utf-16"))}
    address = unescape(re.findall(r'href="[^"]*?(/task/own-[^"]*)"', client.post("/own", files=upload).text)[0])
    assert kulman.load_task(TASK).title["en"] in client.get(address).text
    assert client.get(f"{address}/form.csv?v=3").content == client.get(f"/task/{TASK}/form.csv?v=3").content.replace(
        TASK.encode(), b"my-own"
    )
    assert client.get("/task/own-of-somebody").status_code == 404


@pytest.mark.parametrize("kinds", [("card",), pytest.param(("svg", "handout"), marks=pytest.mark.soak)])
def test_a_class_is_drawn_as_the_command_draws_it(client: TestClient, tmp_path: Path, kinds: tuple[str, ...]) -> None:
    form = {"tasks": TASK, "kinds": [*kinds], "merge": "1", "teacher": "Г. Вовк"}
    page = finished(client, client.post("/class?lang=uk", data=form, files={"roster": ("x/../y.csv", ROSTER)}))
    (tmp_path / "roster.csv").write_bytes(ROSTER)
    kulman.batch(TASK, tmp_path / "roster.csv", tmp_path / "out", kinds=kinds, merge=True, teacher="Г. Вовк")

    assert unpacked(archived(client, page)) == files(tmp_path / "out")
    assert "студентів: 2, готово: 2" in client.get(page).text
    assert client.post("/class", data=form).status_code == 400


def test_a_page_speaks_of_what_a_browser_has_and_not_of_commands(client: TestClient) -> None:
    page = unescape(client.get("/task/scheme-14-jaw-crusher?v=2&format=A4&lang=en").text)
    told = re.findall(r"scale factors are not those of[^<]*", page)
    answers = ("forms", ("a.csv", b"student;V_A, m/s\nA;5\n"))
    wrong = ("rubric", ("моя.pdf", b"x"))
    marks = finished(client, client.post("/marks?lang=en", data={"tasks": TASK}, files=[answers, wrong]))

    assert len(told) == 1
    assert "kulman" not in told[0]
    assert "моя.pdf: unknown kind of file; expected a name that ends in one of: .toml" in unescape(
        client.get(marks).text
    )


@pytest.mark.parametrize("said", ["position,velocity", "механізм, швидкості"])
def test_plans_of_a_class_can_be_chosen(client: TestClient, tmp_path: Path, said: str) -> None:
    form = {"tasks": TASK, "kinds": ["handout"], "merge": "1", "only": said}
    page = finished(client, client.post("/class?lang=uk", data=form, files={"roster": ("y.csv", ROSTER)}))
    (tmp_path / "roster.csv").write_bytes(ROSTER)
    kulman.batch(
        TASK, tmp_path / "roster.csv", tmp_path / "out", kinds=["handout"], merge=True, only="position,velocity"
    )
    answers = ("forms", ("a.csv", "student;variant;V_A, m/s\nІ. Петренко;3;5,86\n".encode()))
    unknown = finished(
        client, client.post("/marks?lang=en", data={"tasks": TASK, "only": f"{said}, spin"}, files=[answers])
    )

    assert unpacked(archived(client, page)) == files(tmp_path / "out")
    assert "known are: structure, position" in client.get(unknown).text


def test_what_is_said_of_a_list_of_students_has_the_name_of_the_file_that_was_sent(client: TestClient) -> None:
    listed = b"student;variant;zodiac\nA;3;x\nB;77;y\n"
    form = {"tasks": TASK, "kinds": ["card"]}

    page = finished(client, client.post("/class?lang=en", data=form, files={"roster": ("моя група.csv", listed)}))

    told = unescape(client.get(page).text)
    assert re.findall(r"моя група\.csv: (B3|columns)", told) == ["columns", "B3"]
    manifest = unpacked(archived(client, page))["manifest.csv"].decode()
    assert "моя група.csv: B3" in manifest
    assert "001-моя" not in told + manifest


def test_a_class_is_marked_as_the_command_marks_it(client: TestClient, tmp_path: Path) -> None:
    head, forms = "student;V_A, m/s;V_B, m/s\n", [("forms", ("a.csv", b"")), ("forms", ("b.csv", b""))]
    texts = {"a.csv": f"{head}І. Петренко;5,86;5,6\n", "b.csv": f"{head}О. Коваль;1;2\n"}
    forms = [("forms", (name, text.encode())) for name, text in texts.items()]
    page = finished(client, client.post("/marks", data={"tasks": TASK}, files=[*forms, ("roster", ("r.csv", ROSTER))]))
    made = unpacked(client.get(f"{page}/{page.rpartition('/')[2]}.zip").content)
    (tmp_path / "roster.csv").write_bytes(ROSTER)
    for name, text in texts.items():
        (tmp_path / name).write_bytes(text.encode())
    asked = kulman.check(TASK, roster=tmp_path / "roster.csv", lang="en")
    found = asked.ordered(asked.read(*(str(tmp_path / name) for name in texts)))
    write_tables(asked, asked.mark_all(found, jobs=1), found, [], tmp_path / "moodle.csv")

    assert made["moodle.csv"] == (tmp_path / "moodle.csv").read_bytes()
    assert {"class.html", "gradebook.xlsx"} < {*made}
    assert "І. Петренко" in client.get(f"{page}/class.html").text
    forms.insert(1, ("forms", ("letter.txt", b"read me")))
    again = finished(client, client.post("/marks", data={"tasks": TASK}, files=[*forms, ("roster", ("r.csv", ROSTER))]))
    assert unpacked(client.get(f"{again}/{again.rpartition('/')[2]}.zip").content)["moodle.csv"] == made["moodle.csv"]
    assert "letter.txt" in client.get(again).text
    assert "І. Петренко" in client.get(page).text


def test_the_forms_of_a_class_say_for_which_task_they_are_and_have_their_names(client: TestClient) -> None:
    forms = list[tuple[str, tuple[str, bytes]]]()
    for name, task in (("О'Коннор <1>.csv", TASK), ("b c.csv", TASK), ("інше.csv", "scheme-09-shaper")):
        text = f"task,{task}\nvariant,3\n\nquantity,value,unit\nV_B,5.6,m/s\nV_A,wide,m/s\n"
        forms.append(("forms", (name, text.encode())))
    broken = ("forms", ("broken one.xlsx", b"PK"))
    roster = ("roster", ("моя група.csv", f"{ROSTER.decode()}Х;АТ-301;77\n".encode()))
    assert 'value="" selected' in client.get("/marks").text

    page = finished(client, client.post("/marks", data={"tasks": ""}, files=[*forms, broken, roster]))
    nothing = finished(client, client.post("/marks", data={"tasks": ""}, files=[broken]))

    told = unescape(client.get(page).text)
    assert "marked: 0, mean mark: 0.0; not in the roster: 4" in told  # no form says whose it is
    assert told.count("these answers are for the task") == 1
    assert "моя група.csv: C4" in told
    assert told.count("broken one.xlsx") == 2  # the name of the student, and why it cannot be read
    texts = [told, *(data.decode("utf-8", "replace") for data in unpacked(archived(client, page)).values())]
    assert [text for text in texts if "forms/" in text] == []
    assert any("О'Коннор <1>.csv" in unescape(text) and "О'Коннор <1>" not in text for text in texts)
    assert "choose the task" in client.get(nothing).text
