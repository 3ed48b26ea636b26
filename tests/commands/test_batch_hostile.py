"""Names and cells of a roster that somebody has chosen to do harm: they are texts everywhere, and nothing else."""

from __future__ import annotations

import csv
import re
import unicodedata
from pathlib import Path
from xml.dom import minidom

import openpyxl
import pypdfium2
import pytest

from kulman import all_variants, batch, check, cli, load_task
from kulman.variants.making.all_variants import _gift_bytes, _Question, _xml_bytes
from kulman.variants.spreadsheets.files import read_grid
from kulman.variants.tables import csv_text, harmless, xlsx_bytes

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


def table(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8-sig", newline="") as stream:
        return list(csv.DictReader(stream))


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
    text = csv_text([(name, "x", name, 1.5) for name in HOSTILE], language)

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
    (tmp_path / "t.csv").write_bytes(csv_text(rows, "uk").encode("utf-8-sig"))
    (tmp_path / "t.xlsx").write_bytes(xlsx_bytes(rows, name * 31))

    seen = openpyxl.load_workbook(tmp_path / "t.xlsx").worksheets[0]["A2"]

    assert seen.data_type in ("s", "inlineStr", "n")  # a text, or nothing
    assert str(seen.value or "").strip() == "".join(c if c.isprintable() or c == "\n" else " " for c in name).strip()
    assert formulas([harmless(name)]) == []
    for file in ("t.csv", "t.xlsx"):
        cell = read_grid(tmp_path / file).text(1, 0)
        assert _bare(cell) == _bare(name)


def _bare(text: str) -> str:
    """Return what a text says, without apostrophes and signs that nobody sees."""
    return "".join(sign for sign in text if sign.isprintable() and sign not in "' ")


@pytest.mark.parametrize("name", HOSTILE)
def test_a_question_for_moodle_is_a_text(name: str) -> None:
    asked = [_Question(name, name, 1.5, 0.1), _Question("next", "next", 2.5, 0.1)]

    gift, xml = _gift_bytes("c", asked).decode("utf-8"), minidom.parseString(_xml_bytes("c", asked))

    assert len(xml.getElementsByTagName("question")) == 3
    assert {node.tagName for node in xml.getElementsByTagName("*")} == {
        "quiz", "question", "category", "text", "name", "questiontext", "answer", "tolerance",
    }  # fmt: skip
    assert {node.getAttribute("format") for node in xml.getElementsByTagName("questiontext")} == {"plain_text"}
    lines = [line for line in gift.split("\n") if line]
    assert len(lines) == 3
    plain = re.sub(r"\\.", "", lines[1])  # without what is escaped
    assert re.fullmatch(r"::[^:~={}#]*::\[plain\][^:~={}#]*\{#=1\.5:0\.1 =%50%1\.5:0\.2\}", plain)


def test_a_hostile_title_of_a_task_is_a_text_everywhere(tmp_path: Path) -> None:
    title = "<script>[html]~=#{}:</script>]]>&"
    own = tmp_path / "own.toml"
    text = re.sub(r"(?m)^(uk|ru|en) = .*$", rf'\1 = "{title}"', load_task(TASK).text, count=3)
    own.write_text(text, encoding="utf-8")
    found = all_variants(own, quantities=["V_B"], only="velocity", lang="en")

    xml, gift, table = found.save(tmp_path / "q.xml", tmp_path / "q.gift", tmp_path / "t.xlsx")

    assert load_task(own).title["en"] == title
    assert title in minidom.parse(str(xml)).getElementsByTagName("text")[2].firstChild.data
    assert r"\{\}\:</script>" in gift.read_text(encoding="utf-8")
    assert openpyxl.load_workbook(table).worksheets[0].title


@pytest.mark.soak
def test_hostile_names_are_texts_in_every_kind_of_file(tmp_path: Path) -> None:
    out = tmp_path / "out"
    block = {"teacher": MARKUP[0], "department": MARKUP[18], "designation": "=<&", "date": "\u202e2026"}

    done = batch(TASK, roster(tmp_path), out, kinds=["pdf", "note", "handout"], lang="en", jobs=1, block=block)

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


def test_hostile_names_go_through_marking(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, out = roster(tmp_path), tmp_path / "reports"
    form = tmp_path / "form.csv"
    with pytest.raises(SystemExit):
        cli.main(["check", TASK, "--form", str(form), "--roster", str(file), "--lang", "en"])
    asked = check(TASK, roster=file, lang="en")
    assert len(asked.read(str(form))) >= 1

    asked.mark_all(asked.read(str(form)), out, jobs=1)

    assert {path.name for path in tmp_path.iterdir()} == {"class.csv", "form.csv", "reports"}
    assert all(re.fullmatch(r"[\w.-]+", path.name) for path in out.iterdir())
    assert not any("<script" in path.read_text(encoding="utf-8") for path in out.glob("*.html"))
