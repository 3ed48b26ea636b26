"""Names, cells and texts that somebody has chosen to do harm: they are texts everywhere, read in time, and no more."""

from __future__ import annotations

import csv
import gc
import os
import re
import sys
import time
import unicodedata
from collections.abc import Callable
from contextlib import suppress
from html import escape as entities
from pathlib import Path
from xml.dom import minidom

import openpyxl
import pypdfium2
import pytest

from kulman import all_variants, batch, check, load_task, note, sheet
from kulman.drawing.notes.omml import _atoms_of
from kulman.drawing.text import escape, lay_out, spelled
from kulman.drawing.titleblock import _surname, _with_initials
from kulman.drawing.writers import slug
from kulman.scales.errors import InputError, KulmanError
from kulman.scales.names import unknown
from kulman.scales.numbers import quote, split_number
from kulman.scales.scale import chooser
from kulman.scales.units import parse as value_in
from kulman.scales.units import unit
from kulman.tests.support import commands
from kulman.tests.support.answer_files import ASKED, HEAD, ROW
from kulman.tests.support.commands import Run, table
from kulman.variants.checks.basics import Places
from kulman.variants.hands import _hand_of
from kulman.variants.making.new_variants import _ranges_of, _with_variants
from kulman.variants.making.questions import Question, gift_bytes, html, xml_bytes
from kulman.variants.making.starter import _label
from kulman.variants.marking import cells
from kulman.variants.marking.wording import plain
from kulman.variants.roster import _folded, _same_person, collated, read_roster, several_groups, variant_of_book
from kulman.variants.sheets import BLOCK, variant_of_id
from kulman.variants.shelf import bundled_text
from kulman.variants.spreadsheets import grid as headers
from kulman.variants.spreadsheets.files import read_grid
from kulman.variants.tables import _csv_text, _harmless, _xlsx_bytes

TASK = "nau-slider-crank"
PATHS = (
    "../../etc/passwd", "..\\..\\windows", "/abs/path", "C:\\x", "~/.ssh", "*", "?", "a:b", "trailing.", "trailing ",
    ".hidden", "CON", "nul.txt", "com1", "LPT9.pdf", "a::$DATA", "-rf", "|", "file\x85name", "é", "e\u0301", "koval",
    "KOVAL",
)  # fmt: skip
MARKUP = (
    "<script>alert(1)</script>", "&amp;<b>", "]]>", "<!-- x", "<!ENTITY x>", "&#x202e;", "%s%n", "{names}", "{0}",
    "$HOME", "`id`", "'; DROP TABLE x", '"quoted"', "name;semicolon", "name,comma", "#hash", "#sys.inputs",
    "$x^2$ *b* _i_", "@cite <label>", '#include "/etc/passwd"', "[link](http://x)", "![x](http://x/y.png)", "// c",
    "~=:{}",
    "_x0041_", "<r><t>x</t></r>", "<r></si><si></r>",
)  # fmt: skip
FORMULAS = (
    "=1+1", "+cmd", "-2", "@SUM(A1)", "\tTab", "|x", "%0A", "x,=1+1,y", "x;=1+1;y", "x\n=1+1,y", "x\t=1+1", "\u200b=1",
    "x, -2+3+cmd|' /C calc'!A0", "'=1", " =1", "\r=1",
)  # fmt: skip
SIGNS = (
    "\u202eevil", "\u202dx\u202c", "\u2067x", "\u200b", "אבג", "مرحبا", "😀", "中文", "x" * 300, "Я" * 300, " ", "a\nb",
    "\x07bell", "\x1b[31mred", "\ufeffbom", "é̂̃", "Ünïcödé", "О'Коннор", "＝1+1", "\u2028", "\ufffe", "\U0010ffff",
    "a" * 5000,
)  # fmt: skip
HOSTILE = (*PATHS, *MARKUP, *FORMULAS, *SIGNS)
RESERVED = re.compile(r"(CON|PRN|AUX|NUL|COM\d|LPT\d)(\..*)?", re.IGNORECASE)


def roster(folder: Path, names: tuple[str, ...] = HOSTILE) -> Path:
    file = folder / "class.csv"
    with file.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, delimiter=";")
        head = ("student", "group", "record book", "id number", "e-mail", "variant")
        writer.writerows([head, *((name, name[:5], name[:30], name[:40], name, "1") for name in names)])
    return file


def formulas(cells: list[str]) -> list[str]:
    """Return the cells that a spreadsheet would work out, or send to a program."""
    seen = ["".join(sign for sign in cell if sign.isprintable() or sign in "\t\r\n").lstrip(" ") for cell in cells]
    return [
        cell for cell in seen
        if cell.startswith(tuple("=@|%\t\r\n＝＋－＠")) or (cell.startswith(("+", "-")) and re.search(r"[(|!=@]", cell))
    ]  # fmt: skip


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a roster of hostile names and, deep in it, what a batch has made of that."""
    folder = tmp_path_factory.mktemp("hostile")
    batch(TASK, roster(folder), folder / "deep" / "out", only="structure", kinds=["svg"], lang="en", jobs=1)
    return folder


def test_hostile_names_stay_in_the_folder_and_are_texts(place: Path) -> None:
    out = place / "deep" / "out"
    rows = table(out / "manifest.csv")
    problems = [row["notes"] for row in rows if not row["files"]]

    assert len(rows) >= len(HOSTILE) - 3  # a name of nothing but blanks is no student
    assert {path.name for path in place.iterdir()} == {"class.csv", "deep"}
    assert [path.name for path in (place / "deep").iterdir()] == ["out"]
    for problem in problems:  # a sheet cannot show the name
        assert re.search("the font has no character|is too long for its cell", problem)
        assert len(problem) < 400
        assert problem.isprintable()
    assert len(problems) <= 14
    files = [path for path in out.iterdir() if path.suffix == ".svg"]
    assert len(files) == len(rows) - len(problems)
    for path in files:
        document = minidom.parse(str(path))
        names = {node.tagName for node in document.getElementsByTagName("*")}
        assert not names & {"script", "foreignObject", "image", "a", "use", "b"}


def test_hostile_names_make_names_of_files_for_any_system(place: Path) -> None:
    names = [path.name for path in (place / "deep" / "out").iterdir()]

    assert len(names) > 60
    for name in names:
        assert re.fullmatch(r"[\w.-]+", name)
        assert not RESERVED.fullmatch(name)
        assert not name.endswith((".", " "))
        assert len(name.encode()) < 200
    assert len({name.casefold() for name in names}) == len(names)
    assert len({unicodedata.normalize("NFD", name) for name in names}) == len(names)


@pytest.mark.parametrize("name", ["manifest.csv", "key.csv"])
def test_no_cell_of_a_list_begins_a_formula(place: Path, name: str) -> None:
    text = (place / "deep" / "out" / name).read_text(encoding="utf-8-sig")
    grid = list(csv.reader(text.splitlines()))

    assert formulas([cell for row in grid for cell in row]) == []
    assert cut_formulas(text) == []
    assert {"koval", "<script>alert(1)</script>"} <= {cell for row in grid for cell in row}


@pytest.mark.parametrize("language", ["en", "uk"])
def test_no_cell_begins_a_formula_wherever_a_program_cuts(language: str) -> None:
    text = _csv_text([(name, "x", name, 1.5) for name in HOSTILE], language)

    assert cut_formulas(text) == []
    assert len(cut_formulas(text.replace("'", ""))) > 20  # without what keeps texts from being formulas


def cut_formulas(text: str) -> list[str]:
    """Return the formulas in a table that a program of another country cuts into cells, quotes or none."""
    return [
        found for separator in ",;\t"
        for found in formulas([piece.strip('"') for line in text.splitlines() for piece in line.split(separator)])
    ]  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_a_cell_comes_back_from_a_table_as_it_was(name: str, tmp_path: Path) -> None:
    rows = [("student", "variant"), (name, "x")]
    (tmp_path / "t.csv").write_bytes(_csv_text(rows, "uk").encode("utf-8-sig"))
    (tmp_path / "t.xlsx").write_bytes(_xlsx_bytes(rows, name * 31))

    seen = openpyxl.load_workbook(tmp_path / "t.xlsx").worksheets[0]["A2"]

    assert seen.data_type in ("s", "inlineStr", "n")  # a text, or nothing
    assert str(seen.value or "").strip() == "".join(c if c.isprintable() or c == "\n" else " " for c in name).strip()
    assert formulas([_harmless(name)]) == []
    for file in ("t.csv", "t.xlsx"):
        cell = read_grid(tmp_path / file).text(1, 0)
        assert _bare(cell) == _bare(name)


def _bare(text: str) -> str:
    """Return what a text says, without apostrophes and signs that nobody sees."""
    return "".join(sign for sign in text if sign.isprintable() and sign not in "' ")


@pytest.mark.parametrize("name", HOSTILE)
def test_a_question_for_moodle_is_a_text(name: str) -> None:
    said = html(escape(name))  # what a file says stands as text in the HTML of a question
    asked = [
        Question(of, (name, of), f"<p>{said}</p>", b"<svg/>", 1.5, 0.1, (name,), True, said, "en")
        for of in (name, "next")
    ]

    gift, xml = gift_bytes(asked).decode("utf-8"), minidom.parseString(xml_bytes(asked))

    questions = xml.getElementsByTagName("question")
    assert [node.getAttribute("type") for node in questions] == ["category", "numerical"] * 2
    texts = [node.getElementsByTagName("questiontext")[0].childNodes[0] for node in questions[1::2]]
    assert {node.tagName for node in xml.getElementsByTagName("questiontext")[0].childNodes} == {"text", "file"}
    for text in texts:  # one paragraph with no other element in it
        assert minidom.parseString(text.firstChild.data).documentElement.getElementsByTagName("*") == []
    lines = [line for line in gift.split("\n") if line]
    assert [line.partition(":")[0] for line in lines] == ["$CATEGORY", "", "$CATEGORY", ""]
    plain = re.sub(r"\\.", "", lines[1])  # without what is escaped
    assert re.fullmatch(r"::[^~={}#]*::\[html\][^~={}#]* \{#=1[^{}]*\}", plain)


def test_a_hostile_title_of_a_task_is_a_text_everywhere(tmp_path: Path) -> None:
    title = "<script>[html]~=#{}:</script>]]>&"
    own = tmp_path / "own.toml"
    text = re.sub(r"(?m)^(uk|ru|en) = .*$", rf'\1 = "{title}"', load_task(TASK).text, count=3)
    own.write_text(text, encoding="utf-8")
    found = all_variants(own, quantities=["V_B"], only="velocity", lang="en")

    xml, gift, table = found.save(tmp_path / "q.xml", tmp_path / "q.gift", tmp_path / "t.xlsx")

    assert load_task(own).title["en"] == title
    asked = minidom.parse(str(xml)).getElementsByTagName("questiontext")[0].getElementsByTagName("text")[0]
    assert f"<p>{entities(title)}. Variant" in asked.firstChild.data
    assert r"\{\}\:&lt;/script&gt;" in gift.read_text(encoding="utf-8")
    assert openpyxl.load_workbook(table).worksheets[0].title


@pytest.mark.soak
def test_hostile_names_are_texts_in_every_kind_of_file(tmp_path: Path) -> None:
    out = tmp_path / "out"
    block = {"teacher": MARKUP[0], "department": MARKUP[18], "designation": "=<&", "date": "\u202e2026"}

    done = batch(
        TASK, roster(tmp_path), out, kinds=["pdf", "note", "handout"], only="velocity", lang="en", jobs=1, **block
    )

    pages = set()
    for student, outcome in zip(done.students, done.outcomes, strict=True):
        for name in outcome.files:
            document = pypdfium2.PdfDocument(str(out / name))
            shown = document[0].get_textpage().get_text_range()
            said = student.entry.who.student
            if said.isascii() and said.isprintable() and "'" not in said:
                assert _bare(said) in _bare(shown), name
            if name.endswith("-note.pdf"):
                pages.add(len(document))
                assert MARKUP[0] in shown
                assert "root:" not in shown
    assert len(pages) == 1  # nothing is set as markup
    assert len(done.problems) <= 14


def test_hostile_names_go_through_marking(tmp_path: Path, run: Run) -> None:
    file, out = roster(tmp_path), tmp_path / "reports"
    form = tmp_path / "form.csv"
    run("check", TASK, "--form", str(form), "--roster", str(file), "--lang", "en")
    asked = check(TASK, roster=file, lang="en")
    assert len(asked.read(str(form))) >= 1

    asked.mark_all(asked.read(str(form)), out, jobs=1)

    assert {path.name for path in tmp_path.iterdir()} == {"class.csv", "form.csv", "reports"}
    assert all(re.fullmatch(r"[\w.-]+", path.name) for path in out.iterdir())
    assert not any("<script" in path.read_text(encoding="utf-8") for path in out.glob("*.html"))


TURNED = "\u202eІ\u200b. Пе\u2066тре\ufeffнко\u00ad\x07\x00"
NAME = "І. Петренко"
BYTES = os.fsdecode(b"x\xff")


# Signs that nobody sees, and bytes that are no text, in what people are called and where files stand.
@pytest.mark.parametrize(
    ("command", "option"),
    [
        pytest.param(command, option, marks=() if (i + j) % 4 == 0 else pytest.mark.soak)
        for i, command in enumerate(("sheet", "handout", "note", "batch"))
        for j, option in enumerate(BLOCK)
    ],
)
def test_bytes_that_are_no_text_are_refused(command: str, option: str, folder: Path, run: Run) -> None:
    commands.roster(folder, "А;1", head="student;variant")
    where = ["--roster", "class.csv", "--out", "out"] if command == "batch" else ["-o", "x.pdf"]

    status, _, err = run(command, TASK, *where, f"--{option}", BYTES)

    assert (status, err.count("\n")) == (2, 1)
    assert option in err
    assert [path.name for path in folder.iterdir()] == ["class.csv"]


def test_signs_that_nobody_sees_are_left_out_of_names(tmp_path: Path) -> None:
    file = commands.roster(tmp_path, f"{TURNED.replace(chr(0), '')};1;\u202e", head="stu\u200bdent;variant;group")

    svg = sheet(TASK, student=TURNED, group="А\t\nБ", only="structure").svg()
    [entry] = read_roster(file, load_task(TASK)).entries
    made = batch(TASK, roster=file, folder=tmp_path / "out", kinds=("svg",), only="structure", jobs=1)

    assert NAME in svg
    assert "А Б" in svg
    assert note(TASK, student=TURNED, only="structure").document.title.student == NAME
    assert (entry.who.student, entry.who.group) == (NAME, "")
    assert [*made.outcomes[0].files] == ["001-І-Петренко-1.svg"]
    for file in (tmp_path / "out").iterdir():
        assert not {*"\u202e\u200b\u2066\u00ad\x07"} & {*file.read_text("utf-8-sig"), *file.name}


def test_signs_that_nobody_sees_are_left_out_of_titles(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    text = bundled_text(TASK)
    title = load_task(TASK).title["uk"]
    file.write_text(text.replace(f'"{title}"', f'"\\u202e{title}\\u200b"', 1), encoding="utf-8")

    assert load_task(file).title["uk"] == title


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
def test_files_whose_names_are_bytes_are_read_and_written(tmp_path: Path, run: Run) -> None:
    folder, reports = tmp_path / "answers", tmp_path / "reports"
    folder.mkdir()
    (folder / f"{BYTES}.csv").write_text(HEAD + ROW, encoding="utf-8")
    own = tmp_path / f"{BYTES}.md"

    note(TASK, only="structure").save(own)
    files = [str(tmp_path / name) for name in ("t.csv", "t.xlsx", "m.csv")]
    to = ["--out", str(reports), "-o", files[0], "-o", files[1], "--moodle", files[2]]
    status, _, _ = run("check", TASK, "-v", "example", str(folder), "--jobs", "1", *to)

    assert status == 0
    assert all(Path(file).exists() for file in files)
    assert len([*reports.glob("*.html")]) == 1
    assert b"x\xff-" in own.read_bytes()


def test_an_error_of_the_system_is_not_one_of_the_output(monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    def no_memory(*_: object, **__: object) -> None:
        raise OSError(12, "Cannot allocate memory")

    monkeypatch.setattr("kulman.variants.solution.solve", no_memory)

    status, _, err = run("solve", TASK)

    assert (status, err.count("\n")) == (2, 1)
    assert "Cannot allocate memory" in err
    assert "output" not in err


def test_a_name_of_bytes_is_refused_from_python() -> None:
    with pytest.raises(InputError, match="teacher"):
        sheet(TASK, teacher="\ud800")


_OF_LINE = dict.fromkeys(map(ord, "'\n"))
SLIDER = load_task(TASK)
PIECES = (
    " ", "\t", "a", "A_", "1", "1 ", "1,", ".", "..", "-", "–", "…", "/", ",", ", ", ";", "; ", ":", "(", ")", "[",
    "]", "{", "}", "\\", '"', "'", "′", "_{", "^{", "\\u{", "=", "+-", "e", "1e", "м", "м5", "№", "°", "1°", "\u00a0",
    "\n", "#", "×", "|", "a-", "10..20", "<", "$", "\u202e", "ё", "Ἀ", "ﷺ",
)  # fmt: skip
ROUND = (("1", "x"), ("5 ", "мм"), ("V_B [", "x"))  # before and behind
# Long texts of users, made to be looked through again and again: whoever reads them takes time in proportion.
READERS: dict[str, Callable[[str], object]] = {
    "tidy": headers.tidy,
    "unit over a column": headers.split_unit,
    "kind of a column": headers.column_kind,
    "kind of a cell": headers.about_kind,
    "quantity": headers.quantity_part,
    "symbol": headers.symbol,
    "variant": headers.number_said,
    "title of a group": lambda text: headers.Grid("x", ((f"Група{text}x\ny",),)).title(0),
    "recognised": lambda text: headers.recognised([[text]]),
    "number": split_number,
    "unit": unit,
    "value": lambda text: value_in(text, unit("mm")),
    "angle": lambda text: value_in(text, unit("deg")),
    "segment": lambda text: cells.segment(text, ""),
    "scale factor": lambda text: cells.scale_factor(text, "", "(m/s)/mm", "(m/s)/mm"),
    "answer": lambda text: cells.value(text, "", "V_B", ASKED),
    "direction": cells.direction,
    "paper": cells.of_paper,
    "hand": _hand_of,
    "range": lambda text: _ranges_of(SLIDER, {"l_OA": text}),
    "record book": lambda text: variant_of_book(SLIDER, text),
    "digits": lambda text: variant_of_book(SLIDER, "12", text),
    "scale": lambda text: chooser("mu_V", text),
    "name": lambda text: unknown("given-unknown", text, SLIDER.givens, task="x"),
    "quoted": quote,
    "slug": slug,
    "label": _label,
    "folded": _folded,
    "a student of the roster": lambda text: _same_person(text, "Коваль Анна-Марія") or _same_person("x", text),
    "groups": several_groups,
    "place in the alphabet": lambda text: collated(text, "uk"),
    "surname": _surname,
    "initials": _with_initials,
    "escaped": escape,
    "markup": lambda text: spelled(escape(text)),
    "laid out": lambda text: lay_out(escape(text), 3.5),
    "atoms": lambda text: _atoms_of(escape(text)),
    "wording": plain,
    "cell of CSV": _harmless,
    "sheet": lambda text: variant_of_id(SLIDER, text),
    "places of TOML": lambda text: Places(f"x = '{text.translate(_OF_LINE)}' # {text.translate(_OF_LINE)}"),
    "task file": lambda text: _with_variants(bundled_text(TASK) + text, ()),
}


def seconds(reader: Callable[[str], object], text: str) -> float:
    gc.disable()  # a search for garbage among all that other tests have left takes longer than most texts
    begin = time.process_time()
    try:
        with suppress(KulmanError):
            reader(text)
        return time.process_time() - begin
    finally:
        gc.enable()


@pytest.mark.soak
@pytest.mark.parametrize("name", READERS)
def test_no_text_takes_more_time_than_its_length(name: str) -> None:
    reader = READERS[name]
    for piece in PIECES:
        for before, behind in ROUND:
            texts = [before + piece * (n // len(piece)) + behind for n in (800, 8_000)]
            short, long = (seconds(reader, text) for text in texts)

            assert long < max(30.0 * short, 0.3), (piece, before, behind)  # a hundred times if it were the square


@pytest.mark.parametrize(
    ("option", "value"),
    [("--set", "l_OA=" + " " * 20_000), ("--student", "а" * 20_000), ("--scale", "mu_V=" + "1" * 20_000)],
)
def test_an_option_longer_than_any_is_refused(option: str, value: str, folder: Path, run: Run) -> None:
    status, _, err = run("sheet", TASK, option, value, "-o", "x.svg")

    assert status == 2
    assert len(err) < 200
    assert "10000" in err
    assert not list(folder.iterdir())
