"""The explanatory note: all is said in every language, numbers recompute and are those of the solution."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import pypdfium2
import pytest

from kulman import cli, note, solve
from kulman.drawing import notes
from kulman.drawing.notes.blocks import Document, Equations, Figure, Heading, Sentences, Steps, Table
from kulman.drawing.notes.markdown import markdown
from kulman.drawing.notes.typst import pdf_bytes
from kulman.scales.packaged import packaged
from kulman.variants.notes import Note

LANGUAGES = ("uk", "ru", "en")
TASK = "nau-slider-crank"
MEASURED = re.compile(r"= ([\d.,]+) [^:=]+: ([^=]+) = ([\d.,]+)([·/])([\d.,]+) = ([\d.,]+) (\S+)\.$")


@cache
def note_of(lang: str = "uk") -> Note:
    return note(TASK, lang=lang, student="І. Петренко")


def texts(written: Note) -> Iterator[str]:
    """Go through all markup of a note."""
    for block in written.document.blocks:
        match block:
            case Heading(text=text):
                yield text
            case Sentences(texts=some) | Steps(texts=some):
                yield from some
            case Equations(lines=lines):
                yield from (" ".join(line) for line in lines)
            case Table(rows=rows):
                yield from (cell for row in rows for cell in row if cell)
            case Figure(caption=caption, under=under):
                yield from (caption, *under)


def text_in(pdf: bytes) -> str:
    return "".join(page.get_textpage().get_text_range() for page in pypdfium2.PdfDocument(pdf))


def number(text: str) -> float:
    return float(text.replace(",", "."))


def half(text: str) -> float:
    """Half of the last printed digit."""
    decimals = len(text.replace(",", ".").partition(".")[2])
    return 0.5 * 10.0**-decimals


def assert_everything_is_said(written: Note, lang: str) -> None:
    said = list(texts(written))

    assert len(written.figures) >= 2
    for text in said:
        assert not re.search(r"(?<![\\^_])(?<!bar)(?<!\\u)(?<!\\uu)\{[a-z_]+\}", text), text  # nothing left unfilled
        assert not re.search(r"\b(nan|inf|None)\b", text), text
    words = " ".join(said)
    assert bool(re.search("[іїєґ]", words)) == (lang == "uk")
    assert bool(re.search("[ыэъ]", words)) == (lang == "ru")
    assert bool(re.search("[а-яА-Я]{3}", words)) == (lang != "en")


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_note_says_everything_in_its_language(lang: str) -> None:
    assert_everything_is_said(note_of(lang), lang)


def assert_measured_as_solved(written: Note, task: str) -> None:
    """What is measured on an English note recomputes, and is what is solved."""
    solution = solve(task, lang="en", format=written.sheet.format)
    symbols: dict[str, list[float]] = {}
    for quantity in solution.quantities.values():
        shown = quantity.shown(solution.words.display)
        symbols.setdefault(solution.words.symbol(quantity.name), []).append(abs(shown.value or 0.0))
    steps = [text for block in written.document.blocks if isinstance(block, Steps) for text in block.texts]
    found = [match for text in steps if (match := MEASURED.search(text))]

    assert len(found) >= 5
    for match in found:
        segment, symbol, again, sign, mu, value, _ = match.groups()
        assert segment == again
        product = number(segment) * number(mu) if sign == "·" else number(segment) / number(mu)
        assert product == pytest.approx(number(value), abs=1.001 * half(value))
        if symbol in symbols:
            near = min(symbols[symbol], key=lambda right: abs(right - number(value)))
            assert number(value) == pytest.approx(near, abs=1.01 * half(value))


def test_what_is_measured_recomputes_and_is_what_is_solved() -> None:
    assert_measured_as_solved(note_of("en"), TASK)


def test_steps_and_equations_stand_before_their_figure() -> None:
    blocks = note("nau-slider-crank", "3").document.blocks
    places = {block.view.name: place for place, block in enumerate(blocks) if isinstance(block, Figure)}

    for plan in ("velocity", "acceleration"):
        assert [type(block) for block in blocks[places[plan] - 3 : places[plan]]] == [Heading, Equations, Steps]
    assert isinstance(blocks[places["forces_23"] - 1], Steps)
    assert [type(block) for block in blocks[-2:]] == [Heading, Steps]  # the conclusions


def assert_it_becomes_a_document(written: Note, folder: Path) -> None:
    pdf, text = written.save(folder / "note.pdf", folder / "note.md")[:2]

    read = text_in(pdf.read_bytes())
    for block in written.document.blocks:
        if isinstance(block, Heading) and not re.search(r"[{}\\]", block.text):
            assert "".join(block.text.split()) in "".join(read.split())
    said = text.read_text(encoding="utf-8")
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", said)
    assert len(pictures) == len(written.figures)
    assert all((folder / name).read_text(encoding="utf-8").startswith("<?xml") for name in pictures)


def test_a_note_becomes_a_document(tmp_path: Path) -> None:
    assert_it_becomes_a_document(note_of(), tmp_path)


def test_the_same_note_has_the_same_bytes() -> None:
    assert pdf_bytes(note(TASK, student="І. Петренко").document) == pdf_bytes(note_of().document)


@cache
def few_words() -> Document:
    document = note("nau-slider-crank", only="structure").document
    return replace(document, blocks=document.blocks[:2])


HOSTILE = ('#panic("x")', "$x$", "]#[", '"\\', "*_`", "<b>", "//", "@a", "= b", "\u202ea", "\x07", "😀")


@pytest.mark.parametrize("name", HOSTILE)
def test_a_name_is_never_taken_for_a_sign(name: str) -> None:
    document = few_words()
    document = replace(document, title=replace(document.title, student=name, teacher=name, date=name))

    read = text_in(pdf_bytes(document))
    plain = "".join(c for c in name if c.isprintable() and c.isascii())
    assert "".join(plain.split()) in "".join(read.split())
    said = markdown(document, ["figure.svg"])
    assert "<b>" not in said
    assert all(word in said for word in re.findall(r"\w+", name, re.ASCII))


def test_markdown_tells_one_line_under_a_vector_from_two() -> None:
    document = few_words()
    lines = Equations(((r"\uu{\bar{V}_{B}} = \u{\bar{V}_{BA}}",),))

    said = markdown(replace(document, blocks=(lines,)), [])
    assert "V\u0305\u0333<sub>B</sub> = <u>V\u0305<sub>BA</sub></u>" in said


@pytest.mark.parametrize(("notation", "by"), [("nau", "times its"), ("bauman", "over its")])
def test_a_note_says_what_scale_factors_are_for(notation: str, by: str) -> None:
    about = note("nau-slider-crank", only="structure", notation=notation, lang="en").document.blocks[0]

    assert isinstance(about, Sentences)
    assert f"segment {by} scale factor is the quantity" in about.texts[0]


def test_texts_have_the_same_keys() -> None:
    keys = [packaged(notes.__name__, "texts", lang).keys() for lang in LANGUAGES]

    assert keys[0] == keys[1] == keys[2]


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as left:
        cli.main(["note", *arguments])
    out, err = capsys.readouterr()
    return int(left.value.code or 0), out, err


def test_a_figure_alone_is_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "velocity.svg"

    status, out, err = run(capsys, "nau-slider-crank", "-v", "3", "--figure", "velocity", "-o", str(file))

    assert (status, out.strip(), err) == (0, str(file), "")
    assert 'data-quantity="V_B"' in file.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-o", "v.svg"], "--figure"),
        (["--figure", "velocit", "-o", "v.svg"], "'velocity'"),
        (["--figure", "velocity", "-o", "v.pdf"], "velocity"),
        (["-o", "v.txt"], ".md"),
        (["-v", "77", "-o", "v.md"], "77"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(
    arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    status, out, err = run(capsys, "nau-slider-crank", *arguments)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert list(tmp_path.iterdir()) == []


def test_names_with_spaces_are_targets_of_links(tmp_path: Path) -> None:
    path = tmp_path / "записка (1) x.md"

    note("nau-slider-crank", "3", only="velocity").save(path)

    assert "](<записка (1) x-velocity.svg>)" in path.read_text(encoding="utf-8")
    assert (tmp_path / "записка (1) x-velocity.svg").is_file()
