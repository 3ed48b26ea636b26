"""The explanatory note: all is said in every language, numbers recompute and are those of the solution."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import docx
import pypdfium2
import pytest

from kulman import note, sheet, solve
from kulman.drawing.notes.blocks import (
    PAPER,
    PROFILES,
    Block,
    Document,
    Equations,
    Figure,
    Heading,
    Sentences,
    Steps,
    Table,
    said_under,
)
from kulman.drawing.notes.docx import docx_bytes
from kulman.drawing.notes.markdown import markdown
from kulman.drawing.notes.typst import Body, pdf_bytes
from kulman.drawing.shapes import Line
from kulman.drawing.view import View
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.tests.notes import test_docx as in_word
from kulman.tests.support.cases import solve_case, some
from kulman.tests.support.commands import Run
from kulman.tests.support.printed_numbers import calculations, disagreements, equation_faults, evaluate, recomputes
from kulman.tests.support.readback import read_back
from kulman.variants.case import Case, Settings
from kulman.variants.notes import Note
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled, bundled_text

PATH = pypdfium2.raw.FPDF_PAGEOBJ_PATH
TASK, CAM, GEAR, HOIST = "nau-slider-crank", "madi-cam", "madi-gear", "karpenko-hoist"
MEASURED = re.compile(r"= ([\d.,]+) [^:=]+: ([^=]+) = ([\d.,]+)([·/])([\d.,]+) = ([\d.,]+) (\S+)\.(?: The.*)?$")


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
    """Return the letters of a PDF, without spaces."""
    return "".join(map(text_in_page, pypdfium2.PdfDocument(pdf)))


def text_in_page(page: pypdfium2.PdfPage) -> str:
    return "".join(page.get_textpage().get_text_range().split())


def number(text: str) -> float:
    return float(text.replace(",", ".").replace("−", "-"))


def half(text: str) -> float:
    """Half of the last printed digit."""
    return 0.5 * 10.0 ** -len(text.replace(",", ".").partition(".")[2])


def assert_everything_is_said(written: Note, lang: str) -> None:
    said = list(texts(written))

    assert len(written.figures) >= 2
    for text in said:
        assert not re.search(r"(?<![\\^_])(?<!bar)(?<!\\u)(?<!\\uu)\{[a-z_]+\}", text), text  # nothing left unfilled
        assert not re.search(r"\b(nan|inf|None)\b", text), text
    words = " ".join(text for text in said if text not in _sources(written))  # books have titles of their own language
    assert bool(re.search("[іїєґ]", words)) == (lang == "uk")
    assert bool(re.search("[ыэъ]", words)) == (lang == "ru")
    assert bool(re.search("[а-яА-Я]{3}", words)) == (lang != "en")


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
            # the segment is printed to its last digit, and what is reckoned from it knows no more
            by = half(segment) * number(mu) ** (1.0 if sign == "·" else -1.0)
            assert number(value) == pytest.approx(near, abs=1.01 * (half(value) + by))


def assert_it_becomes_a_document(written: Note, folder: Path) -> None:
    pdf, text = written.save(folder / "note.pdf", folder / "note.md")[:2]

    read = text_in(pdf.read_bytes())
    for block in written.document.blocks:
        if isinstance(block, Heading) and not re.search(r"[{}\\]", block.text):
            assert "".join(block.text.split()) in read
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text.read_text(encoding="utf-8"))
    assert len(pictures) == len(written.figures)
    assert all((folder / name).read_text(encoding="utf-8").startswith("<?xml") for name in pictures)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_note_says_everything_in_its_language(lang: str) -> None:
    keys = [packaged("kulman.drawing.notes", "texts", lang).keys() for lang in LANGUAGES]

    assert keys[0] == keys[1] == keys[2]
    assert_everything_is_said(note_of(lang), lang)
    if lang == "en":
        assert_measured_as_solved(note_of(lang), TASK)


def test_a_note_becomes_a_document_of_the_same_bytes_every_time(tmp_path: Path) -> None:
    assert_it_becomes_a_document(note_of(), tmp_path)
    own = pdf_bytes(note_of().document)
    assert pdf_bytes(note(TASK, student="І. Петренко").document) == own
    assert b"/MarkInfo<</Marked true" in own  # read aloud by its tags
    assert b"/Suspects" not in own  # of which Poppler complains


@pytest.mark.soak
@pytest.mark.parametrize("own", [True, False], ids=["uk or ru", "en"])
@pytest.mark.parametrize(("place", "task"), [*enumerate(bundled())])
def test_a_note_of_every_task_is_complete_and_right(place: int, task: str, own: bool, tmp_path: Path) -> None:
    """Every task in English, whose plans are measured, and in another language by turns; one of both as documents."""
    lang = ("uk", "ru")[place % 2] if own else "en"
    written = note(task, lang=lang, student="І. Петренко", date="2026")

    assert_everything_is_said(written, lang)
    in_word.assert_a_document_says_all(written.document)
    if not own and task in bundled("mechanism"):  # whose plans are told mark by mark
        assert_measured_as_solved(written, task)
    if own == (place % 3 > 0):
        assert_it_becomes_a_document(written, tmp_path)
        in_word.assert_it_becomes_a_document(written.document)


def test_steps_and_equations_stand_before_their_figure() -> None:
    whole = note(TASK, "3").document.blocks
    meant = [text for block in whole if isinstance(block, Sentences) for text in block.texts if text.startswith("де ")]
    blocks = [block for block in whole if not (isinstance(block, Sentences) and block.texts[0] in meant)]
    places = {block.view.name: place for place, block in enumerate(blocks) if isinstance(block, Figure)}
    symbols = re.findall(rf"(?:^де|;) (\S+){TIE}– ", "\n".join(meant), re.M)

    assert meant[0].startswith(f"де ω_{{1}}{TIE}– кутова швидкість ланки 1; V_{{A}}{TIE}– модуль швидкості точки A; ")
    assert len(symbols) == len({*symbols}) >= 20  # each is explained once
    for plan in ("velocity", "acceleration", "forces_23"):
        before = [type(block) for block in blocks[places[plan] - 5 : places[plan]]]
        assert before == [Heading, Sentences, Equations, Sentences, Steps]
    before = [type(block) for block in blocks[places["group_23"] - 5 : places["group_23"]]]
    assert before == [Heading, Sentences, Equations, Heading, Sentences]
    of_forces = blocks[places["forces_23"] - 3]
    assert isinstance(of_forces, Equations)
    assert any("ΣM" in " ".join(line) for line in of_forces.lines)
    assert [type(block) for block in blocks[-4:]] == [Heading, Steps] * 2  # the conclusions, the sources


@pytest.mark.parametrize(
    "task",
    [pytest.param(t, marks=[pytest.mark.soak] * (t != TASK)) for t in bundled("mechanism")],
)
def test_a_ruler_reads_half_millimetres_and_all_else_follows_from_them(task: str) -> None:
    written, usual = note(task, lang="en", readings="ruler"), note(task, lang="en")
    steps = [text for block in written.document.blocks if isinstance(block, Steps) for text in block.texts]
    found = [match for text in steps if (match := MEASURED.search(text))]

    assert len(found) >= 5
    for match in found:
        segment, symbol, again, sign, mu, value, _ = match.groups()
        mm = number(segment) * (10.0 if f"{segment} cm" in match[0] else 1.0)
        assert segment == again
        # of two forces on a plan the one is known by the other
        assert mm < 1.0 or (2.0 * mm).is_integer() or symbol == "R_{01}", match[0]
        product = number(segment) * number(mu) if sign == "·" else number(segment) / number(mu)
        assert product == pytest.approx(number(value), abs=1.001 * half(value))
    assert_a_quantity_has_one_number(written)
    # lever and force plan differ as drawings do, by what their numbers say
    differ = [re.search(DIFFER, " ".join(texts(one))) for one in (written, usual)]
    if differ[0] is not None and differ[1] is not None:
        plan, lever, part = map(number, differ[0].groups())
        assert part == pytest.approx(100.0 * (lever - plan) / lever, abs=0.02)
        # how much, chance decides: the segments of the sheet, to 0.01 mm, leave no more than a quarter of a percent
        assert abs(part) < 5.0
        assert abs(number(differ[1][3])) <= 0.25
        assert differ[0].groups() != differ[1].groups()


def assert_a_quantity_has_one_number(written: Note) -> None:
    """What is calculated is what tables say; arms on the lever are read."""
    blocks = written.document.blocks
    rows = [[*map(str, row)] for block in blocks if isinstance(block, Table) for row in block.rows if len(row) == 6]
    values, arms = ([row for row in rows if is_arm == bool(re.search("[a-z]", row[2]))] for is_arm in (False, True))
    told = {row[0]: row[3] for row in values if re.fullmatch(r"[\d.]+", row[3])}
    lines = (" ".join(line) for block in blocks if isinstance(block, Equations) for line in block.lines)
    found = [(match[1], match[2]) for line in lines if (match := RESULT.match(line)) and match[1] in told]

    assert len(found) >= 4
    for symbol, value in found:
        near = 1.001 * max(map(half, (value, told[symbol])))
        assert number(value) == pytest.approx(number(told[symbol]), abs=near), symbol
    for name, _, _, mm, *_ in (row for row in arms if re.fullmatch(r"[\d.]+", row[3]) and "{bal}" not in row[0]):
        assert (2.0 * number(mm)).is_integer() or number(mm) < 1.0, (name, mm)


RESULT = re.compile(r"(\S+) = .*= ([\d.]+) [^\d=]*$")  # of an equation with its numbers
DIFFER = r"= ([\d.]+) \S+, by the lever .*? = ([\d.]+) \S+: they differ by (−?[\d.]+) %"
REFERENCES = {  # to equations, figures and tables, from a word of the text
    Equations: r"equations? \((\d+)\)(?: to \((\d+)\))?",
    Figure: r"[Ff]igure (\d+)()",
    Table: r"tables? (\d+)(?: to (\d+))?",
}


def assert_the_text_refers_to_everything_and_to_nothing_else(written: Note) -> None:
    """Numbers count from 1 without a gap, the text refers to each, and each to which it refers is there."""
    blocks = written.document.blocks
    said = " ".join(text for block in blocks if isinstance(block, Sentences | Steps) for text in block.texts)
    numbers = [n for block in blocks if isinstance(block, Equations) for _, n in block.told if n]
    counts = {Equations: len(numbers)}
    counts |= {kind: sum(isinstance(block, kind) for block in blocks) for kind in (Figure, Table)}

    assert numbers == [*range(1, len(numbers) + 1)]
    for kind, pattern in REFERENCES.items():
        told = ((int(first), int(last or first)) for first, last in re.findall(pattern, said.replace(TIE, " ")))
        referred = {n for first, last in told for n in range(first, last + 1)}
        assert referred == {*range(1, counts[kind] + 1)}, kind
    assert {int(n) for n in re.findall(r"\[(\d)[,\]]", said)} == {*range(1, 1 + len(_sources(written)))}


def _sources(written: Note) -> tuple[str, ...]:
    last = written.document.blocks[-1]
    assert isinstance(last, Steps)
    return last.texts


LAID_OUT = ((TASK, "3"), (CAM, None), (GEAR, None), (HOIST, None), ("scheme-09-shaper", "2"))


@pytest.mark.parametrize(
    ("task", "variant", "profile"),
    [
        (TASK, "3", "dstu3008"),
        pytest.param("scheme-09-shaper", "4", "dstu3008", marks=pytest.mark.soak),
        *(pytest.param(*of, "plain", marks=pytest.mark.soak) for of in LAID_OUT),
    ],
)
def test_the_text_refers_to_all_and_no_page_but_the_last_is_half_empty(
    task: str, variant: str | None, profile: str
) -> None:
    written = note(task, variant, lang="en", profile=profile)
    blocks = written.document.blocks
    looks = written.document.profile
    marks = Body.of(blocks, "en", looks).marks("en")

    assert_the_text_refers_to_everything_and_to_nothing_else(written)
    assert {block for block, _, _ in marks} == {n for n, block in enumerate(blocks) if not isinstance(block, Heading)}
    ends: dict[int, float] = {}
    for _, page, y in marks:
        ends[page] = max(y, ends.get(page, 0.0))
    assert sorted(ends) == [*range(1, len(ends) + 1)]
    assert max(ends.values()) <= PAPER[1] - looks.bottom  # below it a title block stands
    assert all(ends[page] > 150.0 for page in range(1, len(ends))), ends  # of 262 mm from the top margin of 15
    assert all(second >= first for first, second in pairwise(_figures(marks, blocks)))


def _figures(marks: list[tuple[int, int, float]], blocks: tuple[Block, ...]) -> list[tuple[int, float]]:
    """Return page and height of each figure of the text in the order of their numbers."""
    return [(page, y) for block, page, y in marks if isinstance(figure := blocks[block], Figure) and not figure.folded]


@pytest.mark.soak
def test_a_profile_frames_all_pages_with_their_title_blocks() -> None:
    written = note(TASK, "3", student="І. Петренко", profile="dstu3008")
    title, first, *others = pdf = pypdfium2.PdfDocument(pdf_bytes(written.document))
    section = docx.Document(BytesIO(docx_bytes(written.document))).sections[0]

    assert f"Аркушів2{len(pdf)}ЗМІСТ" in text_in_page(first)
    for number, page in enumerate(others, 3):
        assert f"ТММ.23.03.000ПЗІ.ПетренкоАрк.{number}" in text_in_page(page)
    assert "ТММ.23" not in text_in_page(title)
    assert [round(getattr(section, f"{side}_margin").mm) for side in ("left", "right", "top", "bottom")] == [
        30,
        10,
        20,
        25,
    ]
    with pytest.raises(InputError, match="dstu3008"):
        note(TASK, profile="dstu")


def test_no_page_parts_the_first_or_the_last_three_rows_of_a_table() -> None:
    parted = set()
    for before in range(40, 47):  # lines on the page, so that the table begins at any height near its end
        rows = (("i", "v"), *((f"row{i}", "0") for i in range(7)))
        blocks = (Steps(("x",) * before), Table(rows, "T"))
        pages = [text_in_page(page) for page in pypdfium2.PdfDocument(pdf_bytes(replace(few_words(), blocks=blocks)))]
        counts = [count for page in pages if (count := page.count("row"))]

        assert all(count >= 3 for count in counts), counts
        assert ["Продовженнятаблиці1" in page for page in pages if "row" in page] == [n > 0 for n in range(len(counts))]
        parted.add(len(counts))
    assert parted == {1, 2}


@cache
def few_words() -> Document:
    document = note(TASK, only="structure").document
    return replace(document, blocks=document.blocks[:2])


@pytest.mark.parametrize(
    "name", ['#panic("x")', "$x$", "]#[", '"\\', "*_`", "<b>", "//", "@a", "= b", "\u202ea", "\x07", "😀"]
)
def test_a_name_is_never_taken_for_a_sign(name: str) -> None:
    document = few_words()
    document = replace(document, title=replace(document.title, student=name, teacher=name, date=name))

    plain = "".join(c for c in name if c.isprintable() and c.isascii())
    said = markdown(document, ["figure.svg"])
    assert "".join(plain.split()) in text_in(pdf_bytes(document))
    assert "<b>" not in said
    assert all(word in said for word in re.findall(r"\w+", name, re.ASCII))


@pytest.mark.parametrize(("notation", "by"), [("nau", "times its"), ("bauman", "over its")])
def test_a_note_says_what_scale_factors_are_for(notation: str, by: str) -> None:
    about = note(TASK, only="structure", notation=notation, lang="en").document.blocks[2]

    assert isinstance(about, Sentences)
    assert f"segment {by} scale factor is the quantity" in about.texts[0]


TIE = "\u00a0"
OWN = {"uk": "слово про дані", "ru": "слово о данных", "en": "a word on the data"}


@pytest.mark.parametrize(("task", "only"), [(TASK, "position"), (CAM, "sizes"), (GEAR, "sliding"), (HOIST, "scheme")])
def test_a_word_of_the_task_on_its_data_stands_with_the_results_not_on_a_students_sheet_or_note(
    task: str, only: str, tmp_path: Path
) -> None:
    head, _, rest = bundled_text(task).partition("\n[givens]")
    before, _, after = head.partition("\n[note]")
    words = "".join(f'{language} = "{text}"\n' for language, text in OWN.items())
    tables = "\n[" + after.partition("\n[")[2] if "\n[" in after else ""
    own = tmp_path / "own.toml"
    own.write_text(f"{before}\n[note]\n{words}{tables}\n[givens]{rest}", encoding="utf-8")

    views = sheet(own, only=only, lang="uk").views
    blocks = note(own, only=only, lang="uk").document.blocks

    assert solve(own, lang="uk").to_json()["note"] == OWN["uk"]
    said = [" ".join(line) for view in views for line in view.lines]
    said += [" ".join(line) for block in blocks if isinstance(block, Equations) for line in block.lines]
    assert not any(word in text for text in said for word in (OWN["uk"], "Примітка"))


def concluded(case: Case, lang: str = "en") -> tuple[str, ...]:
    words, said = case.words(lang), packaged("kulman.drawing.notes", "texts", lang)
    return case.kind.story(case, {"meshing": Scale("mu_l", 0.0005, "m")}, words, said).conclusions


def solved(task: str, variant: str | None = None, **settings: str) -> Case:
    return solve_case(task, variant, settings, None, None)


@pytest.mark.parametrize(
    ("task", "settings"),
    [(GEAR, {}), (GEAR, {"x_1": "-0.3", "x_2": "-0.3"}), (HOIST, {}), (HOIST, {"V_0": "4 m/s"})],
)
def test_conclusions_are_whole_sentences_in_every_language(task: str, settings: Settings) -> None:
    case = solved(task, **settings)
    for lang in LANGUAGES:
        said = concluded(case, lang)

        assert len(said) >= 4
        for text in said:
            assert text.endswith(".")
            assert text[0].isupper()
            assert not re.search(r"\b(nan|inf|None)\b|  ", text)
            assert not re.search(r"\d,\d" if lang == "en" else r"\d\.\d", text)


def test_gears_are_judged_as_their_checks_are() -> None:
    bad, alike = (
        " ".join(concluded(solved(GEAR, **own))) for own in ({"x_1": "-0.3", "x_2": "-0.3"}, {"x_sum": "1.05"})
    )

    assert r"Teeth are undercut: x_{1} = −0.3000 < x_{min 1} = 0.1227" in bad
    assert "No tooth is undercut" not in bad
    assert "both wheels wear alike" in alike


def test_hoists_compare_the_greatest_force_with_the_static_one_and_say_where_formulas_do_not_hold() -> None:
    for variant in ("V03", "V04"):
        case = solved(HOIST, variant)
        said, values = " ".join(concluded(case)), {name: q.value or 0.0 for name, q in case.solved.quantities.items()}

        factor = re.search(r"/mg = ([\d.]+)\.", said)
        assert factor is not None
        assert float(factor[1]) == pytest.approx(values["F_max"] / values["P_st"], abs=5e-4)
        assert f"{values['F_max']:.0f} N, comes" in said
        assert f"is mg = {values['P_st']:.0f} N: " in said
        assert ("The rope is strong enough" in said) == (values["safety"] >= case.solved.givens["K"])
        assert f"l_{{0}}/{round(case.solved.givens['l_0'] / values['w_0_max'])}" in said

    fast = " ".join(concluded(solved(HOIST, "V04", V_0="4 m/s")))
    assert "the closed formulas do not hold" in fast
    assert not re.search("the closed formulas hold|article", fast)


@pytest.mark.parametrize("format", ["A3", *(pytest.param(f, marks=pytest.mark.soak) for f in ("A1", "A4"))])
def test_scale_of_specific_sliding_is_that_of_the_figure(format: str) -> None:
    written = note(GEAR, only="sliding", format=format, lang="en")

    steps = [text for block in written.document.blocks if isinstance(block, Steps) for text in block.texts]
    value = re.search(r"μ_\{θ\} = [\d.]+ mm\^\{−1\}", " ".join(written.figures["sliding"].under))
    assert value is not None
    assert any(value[0] in step for step in steps)


def in_typst(*blocks: Block) -> str:
    return Body.of(blocks, "en").text


def test_no_line_ends_between_a_letter_its_number_and_the_unit_but_before_a_sign_of_an_equation() -> None:
    line = "r_{0} = 45.26 mm and more"
    for block in (Steps((line,)), Sentences((line,))):
        assert f"{TIE}= 45.26{TIE}mm and more" in in_typst(block)
    assert TIE not in in_typst(Equations((("a = 2·3", "= 6 mm"),)))


@pytest.mark.parametrize(
    ("markup", "slanted", "upright"),
    [
        *(("d^{2}s/dφ^{2}", "", "dφ"), ("μ_{d^{2}s/dφ^{2}}", "μ", "dφ"), ("ω^{2}·r_{0}", "ωr", "")),
        *(("P_{1}B_{1}", "PB", ""), ("OP_{1} = 2", "", "P"), ("a_{B} = 2 m/s^{2}", "a", "s")),
        *(("V_{A}^{2}/l_{OA}", "Vl", ""), ("μ_{s} = h/S_{max}", "μS", ""), ("m/s^{2}", "", "s")),
        *(
            ("кг·м^{2}", "", "м"),
            ("kg·m^{2}", "", "m"),
            ("м^{2}", "", "м"),
            ("m^{2}", "", "m"),
            ("J = m·l^{2}", "l", ""),
        ),
    ],
)
def test_letters_of_one_word_are_all_upright(markup: str, slanted: str, upright: str) -> None:
    text = in_typst(Sentences((markup,)))

    assert all(f'attach(italic("{letter}")' in text for letter in slanted)
    assert all(f'attach("{letter}"' in text for letter in upright)
    assert text.count("italic") == len(slanted)


def test_scripts_of_a_script_stand_close_and_the_head_of_a_table_on_every_page() -> None:
    assert 't: "2")"s/d"attach(' in in_typst(Sentences(("μ_{d^{2}s/dφ^{2}}",)))

    head, body = in_typst(Table((("i", "φ"), ("0", "0.00"), ("1", None)), "Angles")).split("\n")[:2]
    assert ("table.header(" in head, "φ" in head, "0.00" in head) == (True, True, False)
    assert "0.00" in body
    assert "colspan: 2" in body


@pytest.mark.parametrize("lang", ["ru", *(pytest.param(lang, marks=pytest.mark.soak) for lang in ("uk", "en"))])
def test_words_in_which_something_is_equal_have_no_number_of_an_equation(lang: str) -> None:
    blocks = [block for block in note(CAM, lang=lang).document.blocks if isinstance(block, Equations)]
    numbers = [number for _, number in blocks[0].told]
    told = [" ".join(line) for block in blocks for line, number in block.told if number]

    still = [
        block for block in note(TASK, "3", set={"phi": 0}, lang=lang).document.blocks if isinstance(block, Equations)
    ]
    meant = [
        line[0] for block in still for line, number in block.told if line[0].startswith("ε_{2} = 0:") and not number
    ]

    assert numbers == [0] * len(numbers)  # the law of motion, the senses
    assert not any(re.match(r"[^\W\d_’]{3,}[ ’]", line) for line in told)
    assert len(meant) == 1  # what it means that a rate is zero, as an equation has given


@pytest.mark.soak
def test_no_rule_of_a_page_strikes_a_letter() -> None:
    equations = tuple(b for b in note("scheme-09-shaper", "3").document.blocks if isinstance(b, Equations))
    rows = Table((("i", "φ"), *((f"p_{{{k}}}", "0.00") for k in range(60))), "Angles")
    written = replace(note_of().document, blocks=(Heading("Plans"), *equations, rows))
    struck = []

    for page in pypdfium2.PdfDocument(pdf_bytes(written)):
        text = page.get_textpage()
        letters = [text.get_charbox(k) for k in range(text.count_chars())]
        for x0, y0, x1, y1 in (thing.get_bounds() for thing in page.get_objects(filter=[PATH])):
            y, is_rule = (y0 + y1) / 2.0, x1 - x0 > 5.0 > y1 - y0
            over = [(low, high) for a, low, b, high in letters if min(b, x1) - max(a, x0) > 2.0]
            struck += [(y, low, high) for low, high in over if is_rule and low + 0.4 < y < high - 0.4]

    assert struck == []


def test_a_figure_that_would_be_too_small_stands_on_a_larger_sheet_at_the_end() -> None:
    figures = (
        Figure(View("plan", (Line(0j, complex(width, height)),), (0.0, 0.0, width, height)), "Plan", ())
        for width, height in ((90.0, 90.0), (300.0, 500.0), (200.0, 90.0))
    )

    body = Body.of((*figures, Heading("End")), "en")

    assert body.figures.keys() == {"1.svg", "2.svg", "3.svg"}
    shown, folded = body.text.split("= ")[0], body.text.split('#page(paper: "a3", ..folded)')[1]
    assert [name in shown for name in ('"1.svg"', '"2.svg"', '"3.svg"')] == [True, False, True]
    assert "Figure 2 stands on a sheet A3" in shown
    assert "counter(figure.where(kind: image)).step()" in shown  # so that the next one is the third
    assert 'image("2.svg", width: 204.0000mm, height: 340.0000mm)' in folded
    assert 'numbering: _ => "2"' in folded
    assert "reduced to 68 %" in folded


def test_a_larger_sheet_at_the_end_of_a_framed_note_has_a_frame_of_its_size_with_its_number() -> None:
    """The frame of a smaller page lay in the middle of it, across the figure."""
    view = View("plan", (Line(0j, complex(300.0, 500.0)),), (0.0, 0.0, 300.0, 500.0))
    blocks = (Heading("Plan"), Figure(view, "Plan", ()))
    written = replace(few_words(), blocks=blocks, profile=PROFILES["dstu3008"])
    framed = {"left": 20.0, "right": 292.0, "low": 5.0, "high": 415.0}

    *_, last = pdf = pypdfium2.PdfDocument(pdf_bytes(written))
    boxes = [[part * 25.4 / 72 for part in thing.get_bounds()] for thing in last.get_objects(filter=[PATH])]
    left, low, right, high = (
        pick(sides) for pick, sides in zip((min, min, max, max), zip(*boxes, strict=True), strict=True)
    )
    page = last.get_textpage()
    number = [page.get_charbox(k) for k in range(page.count_chars()) if page.get_text_range(k, 1) == str(len(pdf))]
    section = docx.Document(BytesIO(docx_bytes(written))).sections[-1]
    header = section.header.part.blob.decode()

    assert {"left": left, "right": right, "low": low, "high": high} == pytest.approx(framed, abs=0.6)
    assert any(282.0 < x * 25.4 / 72 < 292.0 and 5.0 < y * 25.4 / 72 < 13.0 for x, y, *_ in number)
    assert f'cx="{297 * 36000}" cy="{420 * 36000}"' in header
    assert re.findall(r' w:x="(\d+)"|instr=" (\w+) "', header) == [("15987", ""), ("", "PAGE")]
    assert section.page_width.mm - section.left_margin.mm - section.right_margin.mm == pytest.approx(267.0, abs=0.1)


def test_a_figure_alone_is_a_picture(tmp_path: Path, run: Run) -> None:
    file = tmp_path / "velocity.svg"

    status, out, err = run("note", TASK, "-v", "3", "--figure", "velocity", "-o", str(file))

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
    arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run
) -> None:
    monkeypatch.chdir(tmp_path)

    status, out, err = run("note", TASK, *arguments)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert list(tmp_path.iterdir()) == []


def test_names_with_spaces_are_targets_of_links(tmp_path: Path) -> None:
    path = tmp_path / "записка (1) x.md"

    note(TASK, "3", only="velocity").save(path)

    assert "](<записка (1) x-velocity.svg>)" in path.read_text(encoding="utf-8")
    assert (tmp_path / "записка (1) x-velocity.svg").is_file()


def test_a_figure_is_reduced_only_where_it_shows_in_per_cent() -> None:
    said = {"figure.reduced": "reduced to {part} %"}
    shares = {1.0: (), 0.998: (), 0.99: ("reduced to 99 %",), 0.5: ("reduced to 50 %",)}

    for share, lines in shares.items():
        assert said_under(SimpleNamespace(under=("A",), share=share), said) == ("A", *lines)


ROCKER = str(Path(__file__).resolve().parents[2] / "docs" / "examples" / "rocker-cam.toml")
OTHERS = [(task, variant, {}) for task in (HOIST, CAM, GEAR, ROCKER) for variant in load_task(task).variants]
OTHERS += [(HOIST, "V03", set) for set in ({"I_0": "inf", "I_2": "inf"}, {"V_0": "4 m/s"}, {"slack": "0.03 m"})]
OTHERS += [(task, variant, {}) for task in bundled("mechanism") for variant in load_task(task).variants]


@pytest.mark.parametrize(("task", "variant", "changed"), some(OTHERS, *range(17), 30, 60, 105, 140))
def test_every_printed_equation_of_note_and_sheet_recomputes_to_its_last_digit(
    task: str, variant: str, changed: dict[str, str]
) -> None:
    lang = LANGUAGES[len(variant + task) % 3]
    written = note(task, variant, set=changed, lang=lang)

    plain = [re.sub(r"\\bar|\\u+(?=\{)", "", text) for text in texts(written)]
    found = [calculation for text in plain for calculation in calculations(text)]
    drawn = read_back(written.sheet)
    count, faults = equation_faults(drawn)

    assert [(numbers, result) for numbers, result in found if not recomputes(evaluate(numbers), result)] == []
    assert faults == []
    assert len(found) > 12
    assert count > 1
    if task in bundled("mechanism"):  # one number for one quantity
        assert list(disagreements(drawn, plain)) == []
