"""Sheets of the bundled slider-crank, drawn and read back: what they say, how they look, and what is in their files."""

from __future__ import annotations

import io
import itertools
import os
import random
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from pdfminer.high_level import extract_pages
from pdfminer.layout import LAParams, LTLine, LTTextContainer
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfparser import PDFParser
from pdfminer.pdftypes import resolve1

from kulman import sheet
from kulman.drawing.pdf import write as write_pdf
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.sheets.judge import dark, looks, overlaps
from kulman.tests.support import linkage_points, sheet_points
from kulman.tests.support.cases import some
from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.printed_numbers import decimal, equation_faults, table_faults
from kulman.tests.support.readback import Sheet, read
from kulman.tests.support.sheet_cases import FORMATS, TASK, Case, drawn, pages, sheet_of, solved
from kulman.tests.support.sheet_points import mechanism_faults, symbol_of

MM = 25.4 / 72
LETTERS = LAParams(boxes_flow=None)  # letters as lines of text, which take no order
SIDES = ("left", "right")
A1 = Case(format="A1")
SAID = {"uk": "= 0 (точка)", "en": "= 0"}


def sample(count: int) -> list[Case]:
    """A seeded sample: every variant at least once, every format, side, rotation and language."""
    r, names = random.Random(20160101), list(NAU_VARIANTS)
    return [
        Case(names[k % len(names)], FORMATS[k % 5], ("uk", "en", "ru")[k % 3], r.choice(SIDES), r.choice(("cw", "ccw")))
        for k in range(count)
    ]


SAMPLE = [pytest.param(case, marks=[pytest.mark.soak] * (k % 4 > 0)) for k, case in enumerate(sample(12))]


def number_faults(case: Case, sheet: Sheet) -> list[str]:
    """Tables that do not say what `kulman solve` does, and too little that could be judged."""
    count, faults = equation_faults(sheet)[0], []
    if count < 18 or len(sheet.vectors) < 20:
        faults.append(f"only {count} calculations, {len(sheet.vectors)} vectors")
    numbers = solved(case)
    values = {symbol_of(name): q.value for name, q in numbers.quantities.items() if plain(name)}
    faults += table_faults(sheet, case.lang, values)
    return faults


def plain(name: str) -> bool:
    """Whether a quantity's symbol is its name with scripts, in every language."""
    return bool(re.fullmatch(r"(V|a|omega|epsilon|R|F|h)_[0-9A-Z]+(_[nt])?|[FM]_i\d|M_i2", name))


def all_faults(case: Case) -> list[str]:
    read = drawn(case)
    faults = [*looks(read), *mechanism_faults(case, read), *number_faults(case, read)]
    return [f"{case}: {fault}" for fault in faults]


def pdf_faults(case: Case) -> list[str]:
    """PDF against SVG: size of the pages, every vector's shaft, selectable words, embedded fonts."""
    read, stream, faults = drawn(case), io.BytesIO(), []
    write_pdf(sheet_of(case).pages, stream)
    pages = list(extract_pages(stream, laparams=LETTERS))
    for page, same in zip(pages, read.pages, strict=True):
        if abs(page.width * MM - same.width) > 0.01 or abs(page.height * MM - same.height) > 0.01:
            faults.append(f"page of {page.width * MM} x {page.height * MM}")
        lines = {tuple(round(v * MM, 1) for p in line.pts for v in p) for line in page if isinstance(line, LTLine)}
        for view in same.views:
            for vector in view.vectors:
                near = any(abs(complex(x, y) - vector.tail) < 0.1 for x, y, *_ in lines)
                if abs(vector.span) > 5 and not near:
                    faults.append(f"no {vector.quantity} in the PDF")
    text = "".join(item.get_text() for page in pages for item in page if isinstance(item, LTTextContainer))
    for heading in ("План швидкостей", "План прискорень", "Структура механізму", "Вихідні дані"):
        if heading not in text:
            faults.append(f"{heading!r} cannot be searched")
    document = PDFDocument(PDFParser(stream))
    for number in (number for xref in document.xrefs for number in xref.get_objids()):
        item = resolve1(document.getobj(number))
        font = isinstance(item, dict) and getattr(item.get("Type"), "name", "") == "FontDescriptor"
        if font and "FontFile2" not in item:
            faults.append(f"a font is not embedded: {item}")
    return faults


def special_faults(case: Case, read: Sheet) -> list[str]:
    """All faults of a sheet whose plans may have vectors of no length."""
    faults = [*mechanism_faults(case, read, special=True), *looks(read)]
    for view in read.views:
        notes = " ".join(text.string for text in view.of("heading"))
        for vector in view.vectors:
            short = abs(vector.span) < 2.0
            if short and symbol_of(vector.quantity) not in notes:
                faults.append(f"{vector.quantity} is a point and not said to be")
            if vector.value == 0.0 and SAID[case.lang] not in notes:
                faults.append(f"{vector.quantity} is zero and not said to be")
            if short and [tip for tip in view.tips if ("vector", vector.quantity) in tip.path]:
                faults.append(f"{vector.quantity} is a point with an arrowhead")
    return [f"{case}: {fault}" for fault in faults]


def special_cases(steps: tuple[float, ...], sheets: tuple[tuple[str, str], ...]) -> list[Case]:
    return [
        Case(variant, name, lang, side, phi=base + step)
        for base in (0, 90, 180, 270)
        for step in steps
        for name in ("A1", "A4")
        for side in ("left", "right")
        for variant, lang in sheets
    ]


def quarter(cases: list[Case]) -> list[Case]:
    """Return one case of each position, with formats and sides in turn; the soak has more."""
    turn = {phi: (k + k // 4) % 4 for k, phi in enumerate(sorted({c.phi or 0.0 for c in cases}))}
    return [c for c in cases if (c.format == "A1") + 2 * (c.side == "left") == turn[c.phi or 0.0]]


@pytest.mark.parametrize("case", SAMPLE, ids=str)
def test_sheet_satisfies_the_points_of_a_linkage_and_looks_like_one(case: Case) -> None:
    assert all_faults(case) == []


@pytest.mark.parametrize(
    "case",
    some(
        [
            Case("3", "A1", "en", norm="iso", notation="iso"),
            Case("5", "A3", "ru", "right", norm="iso", notation="iso"),
            Case("example", "A4", "uk", norm="iso"),
        ],
        1,
    ),
    ids=str,
)
def test_sheet_of_iso_looks_like_one(case: Case) -> None:
    strings = {text.string for text in drawn(case).texts}

    assert [*looks(drawn(case)), *overlaps(drawn(case))] == []
    if case.notation == "iso":
        assert {"v_{A}", "α_{2}"} <= strings
        assert "V_{A}" not in strings


@pytest.mark.parametrize("case", some(quarter(special_cases((1e-6,), (("example", "uk"),))), 0, 3), ids=str)
def test_sheet_of_a_special_position_is_drawn_and_said_in_words(case: Case) -> None:
    assert special_faults(case, drawn(case)) == []


def test_a_zero_vector_is_a_point() -> None:
    view = drawn(Case(format="A1", phi=0.0))["velocity"]

    zero = view.vector("V_B")

    assert abs(zero.span) < 1e-6
    assert zero.value < 1e-12
    assert not [tip for tip in view.tips if ("vector", "V_B") in tip.path]
    assert any(("vector", "V_B") in ring.path for ring in view.rings)


@pytest.mark.parametrize(
    ("only", "there", "missing"),
    [
        (("velocity",), {"velocity", "equations_kinematics"}, {"acceleration", "group_23", "forces_23", "lever"}),
        (("position",), {"position"}, {"velocity", "acceleration", "forces_23", "lever"}),
        (("forces",), {"group_23", "forces_23", "driver"}, {"lever"}),
        (("lever",), {"lever", "equations_lever"}, {"group_23", "forces_23"}),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else "",
)
def test_only_the_plans_asked_for_are_drawn(only: tuple[str, ...], there: set[str], missing: set[str]) -> None:
    case = Case("3", only=only)

    read = drawn(case)

    assert there <= set(read.names)
    assert not missing & set(read.names)
    assert not [v.quantity for v in read.vectors if only == ("velocity",) and v.quantity[0] in "aFR"]
    assert overlaps(read) == []
    assert equation_faults(read)[1] == []
    assert list(table_faults(read, "uk", {})) == []


def test_the_scale_factor_or_segment_asked_for_is_drawn() -> None:
    velocity = drawn(Case("3", "A1", scales=(("mu_V", "0.1"),)))["velocity"]
    pa = drawn(Case("3", "A1", scales=(("pa", "60"),)))["velocity"].vector("V_A")

    assert {vector.mu for vector in velocity.vectors} == {0.1}
    assert "μ_{V} = 0,1 (м/с)/мм" in [text.string for text in velocity.of("heading")]
    assert 55 < abs(pa.span) < 65


@pytest.mark.parametrize("lang", some(LANGUAGES, 1))
def test_too_fine_a_scale_factor_is_refused_with_what_fits(lang: str) -> None:
    with pytest.raises(InputError) as refused:
        sheet(TASK, "3", format="A4", scales={"mu_V": 0.001}, lang=lang)

    text = refused.value.text(lang)
    assert "A4" in text
    assert "\n" not in text
    fits = refused.value.data["fits"]
    assert decimal(str(fits), lang) in text
    assert sheet(TASK, "3", format="A4", scales={"mu_V": float(str(fits))}, lang=lang).pages


def moved(case: Case, old: str, new: str, count: int = 1) -> Sheet:
    """The sheet with one piece of its file changed."""
    (svg,) = pages(case)
    assert len(re.findall(old, svg)) >= count
    return read(re.sub(old, new, svg, count=count))


SPOILED = [
    (linkage_points.l1_plan, r'(data-name="S2">\n<circle class="main" cx=")\d+', r"\g<1>300"),
    (linkage_points.l3_to_l6_plans, r'(?s)(data-quantity="V_A".*?x2=")(\d+)', r"\g<1>1\g<2>"),
    (linkage_points.l3_to_l6_plans, r'(data-name="velocity.B_2" [^>]*?y1=")(\d+)', r"\g<1>9\g<2>"),
    (sheet_points.l3_to_l6_ends, r'(?s)(data-quantity="a_BA_n".*?y2=")(\d)', r"\g<1>9\g<2>"),
    (sheet_points.l9_arms, r'("h_2">\n<line class="thin" [^>]*?x2=")(\d+)', r"\g<1>1\g<2>"),
    (linkage_points.l10_force_plans, r'(?s)(data-quantity="F_i2".*?y1=")(\d)', r"\g<1>9\g<2>"),
    (sheet_points.l11_driver, r'(?s)(data-name="driver">.*?= 0,001)( м/мм)', r"\g<1>01\g<2>"),
    (sheet_points.l12_lever, r"(?s)(>= 0:<.*?)>−<", r"\g<1>>+<"),
    (sheet_points.l12_lever, r'(?s)(data-name="lever">.*?>= )([\d,]+)(.*?>= )([\d,]+)', r"\g<1>\g<4>\g<3>\g<2>"),
]


@pytest.mark.parametrize(("judge", "old", "new"), SPOILED)
def test_the_examiner_sees_a_spoiled_sheet(judge: Callable[[Case, Sheet], Iterator[str]], old: str, new: str) -> None:
    spoiled = moved(A1, old, new)

    try:
        faults = list(judge(A1, spoiled))
    except (AssertionError, ValueError) as stumbled:
        faults = [str(stumbled)]

    assert list(judge(A1, drawn(A1))) == []
    assert faults


def test_a_wrong_digit_is_seen() -> None:
    spoiled = moved(A1, r"(= 2·221,8 = 443),6", r"\1,4")

    assert len(equation_faults(spoiled)[1]) == 1


def test_the_judge_sees_a_letter_on_a_letter_and_a_grey_too_light_to_print() -> None:
    (svg,) = pages(A1)
    found = re.search(r'<text class="label" [^>]*x="([\d.]+)" y="[\d.]+">p</text>', svg)
    assert found
    spoiled = svg.replace(found[0], found[0].replace(found[1], f"{float(found[1]) + 12:.3f}"))

    assert overlaps(read(spoiled))
    assert dark("#808080")
    assert not dark("#909090")


@pytest.mark.parametrize("case", [Case("3", "A4"), pytest.param(Case("8", "A3"), marks=pytest.mark.soak)], ids=str)
def test_the_pdf_is_the_same_sheet_with_letters_that_can_be_searched(case: Case) -> None:
    assert pdf_faults(case) == []


def test_the_same_command_gives_the_same_bytes_later(tmp_path: Path) -> None:
    made, begun = [], time.time()
    for seed in ("1", "2"):
        folder = tmp_path / seed
        folder.mkdir()
        files = [folder / f"sheet.{suffix}" for suffix in ("svg", "pdf", "html")]
        command = [sys.executable, "-m", "kulman", "sheet", TASK, "-v", "3", "--format", "A3", "--lang", "ru"]
        command += [part for file in files for part in ("-o", str(file))]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run(command, check=True, capture_output=True, env=environment)
        made.append({file.name: file.read_bytes() for file in sorted(folder.iterdir())})
        time.sleep(max(0.0, begun + 1.1 - time.time()))  # the other one begins in another second

    assert made[0] == made[1]
    assert any(name.endswith(".pdf") for name in made[0])


@pytest.mark.soak
@pytest.mark.parametrize("number", range(len(NAU_VARIANTS)))
def test_every_sheet_of_a_variant_is_without_fault(number: int) -> None:
    """On two thirds of formats and sides, over the variants on all, in every language and rotation, by GOST and ISO."""
    variant = [*NAU_VARIANTS][number]
    turns = [*itertools.product(("cw", "ccw"), LANGUAGES)]
    for k, (name, side) in enumerate(itertools.product(FORMATS, SIDES)):
        if k % 3 == number % 3:  # other ones of each variant
            continue
        rotation, lang = turns[(k + number) % len(turns)]
        case = Case(variant, name, lang, side, rotation)
        assert all_faults(case) == []
        assert lang != "uk" or pdf_faults(case) == []
        assert (k + number) % 2 or all_faults(replace(case, lang="en", rotation="cw", norm="iso")) == []


@pytest.mark.soak
@pytest.mark.parametrize("base", [0, 90, 180, 270])
def test_sheets_near_a_special_position_are_without_fault(base: int) -> None:
    steps = (0.0, 1e-6, -1e-6, 1e-3, -1e-3)
    cases = [c for c in special_cases(steps, (("example", "uk"), ("0", "en"))) if abs((c.phi or 0.0) - base) < 1]
    turn = {phi: k % 2 for k, phi in enumerate(sorted({c.phi or 0.0 for c in cases}))}
    # each position on each format, to each side, of one of both variants in turn
    pairs = ((c, (c.format == "A1") ^ (c.side == "left") ^ (c.variant == "0")) for c in cases)
    cases = [c for c, pair in pairs if pair == turn[c.phi or 0.0]]

    assert [fault for case in cases for fault in special_faults(case, drawn(case))] == []


@pytest.mark.soak
@pytest.mark.parametrize("phi", range(0, 360, 30))
def test_sheets_all_round_the_circle_are_without_fault(phi: int) -> None:
    both = ("example", "A1"), ("4", "A3")
    cases = [
        Case(*both[(phi // 30 + k) % 2], "uk", side, rotation, phi=phi + 0.5)
        for k, (side, rotation) in enumerate(itertools.product(SIDES, ("cw", "ccw")))
    ]

    assert [fault for case in cases for fault in special_faults(case, drawn(case))] == []
