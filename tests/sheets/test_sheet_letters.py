"""Page, pens, letters and words of a sheet, read back from the file."""

from __future__ import annotations

import re

import pytest

from kulman.tests.sheets.test_sheet_points import SAMPLE
from kulman.tests.support.overlaps import overlaps
from kulman.tests.support.printed_numbers import numbers_of
from kulman.tests.support.readback import CAP, Sheet, read
from kulman.tests.support.sheet_cases import Case, drawn, pages

PAGES = {(841.0, 594.0), (594.0, 420.0), (420.0, 297.0), (297.0, 420.0), (210.0, 297.0)}
THINNEST = {841.0: 0.3, 594.0: 0.25, 420.0: 0.25, 297.0: 0.25, 210.0: 0.2}
HEIGHTS = (2.5, 3.5, 5.0, 7.0, 10.0)
ISO = [
    Case("3", "A1", "en", norm="iso", notation="iso"),
    Case("5", "A3", "ru", "right", norm="iso", notation="iso"),
    Case("example", "A4", "uk", norm="iso"),
]
FOREIGN = {"uk": "[ыэъёЫЭЪЁ]", "ru": "[іїєґІЇЄҐ]", "en": "[а-яА-ЯіїєґІЇЄҐёЁ]"}
OTHERS = {  # words of the neighbouring language that pass the alphabet
    "uk": ("Лист", "Листов", "Подп", "Утв", "Пров", "Изм", "план", "сила", "Разраб"),
    "ru": ("Аркуш", "Арк", "Затв", "Перев", "Розроб", "швидкостей", "прискорень", "сил групи", "ланки", "ланка"),
    "en": (),
}


def page_faults(case: Case, sheet: Sheet) -> list[str]:
    """G1: one format, millimetres, nothing transformed. G2: the frame."""
    faults = []
    left, margin = 20.0, 10.0 if case.norm == "iso" else 5.0
    for page in sheet.pages:
        root = page.root
        size = page.width, page.height
        if size not in PAGES or (size == (210.0, 297.0) and case.format not in ("A4", None)):
            faults.append(f"page of {size}")
        if (root.get("width"), root.get("height")) != (f"{page.width:g}mm", f"{page.height:g}mm"):
            faults.append("width and height are not the viewBox in mm")
        for vector in root.xpath("//*[@class='vector' or @class='arrow']"):
            if any(e.get("transform") for e in (vector, *vector.iterancestors(), *vector.iterdescendants())):
                faults.append("a transformed vector")
        (frame,) = [s for s in page.rest.strokes if s.role == "frame"]
        xs, ys = sorted({p.real for p in frame.points}), sorted({p.imag for p in frame.points})
        wanted = [left, page.width - margin, margin, page.height - margin]
        if max(abs(a - b) for a, b in zip((*xs, *ys), wanted, strict=True)) > 0.01:
            faults.append(f"frame {xs} {ys}")
        if frame.width < 0.5:
            faults.append("a thin frame")
    return faults


def pen_faults(case: Case, sheet: Sheet) -> list[str]:
    """G4: stroke weights, cap heights, arrowheads; G7: nothing lighter than 50 % grey."""
    faults = []
    for page in sheet.pages:
        widths = {s.width for v in page.all for s in v.strokes} | {r.width for v in page.all for r in v.rings}
        main, thin = max(widths), min(widths)
        if len(widths) > 3 or not main / 3 - 0.02 <= thin <= main / 2 + 1e-9 or thin < THINNEST[page.width] - 0.001:
            faults.append(f"weights {sorted(widths)}")
        large = page.width > 800
        for text in (t for v in page.all for t in v.texts):
            capitals = {run.size * CAP for run in text.runs}
            body = max(capitals)
            if not any(abs(body - h) < 0.01 for h in HEIGHTS):
                faults.append(f"{text.string!r} is {body:.2f} high")
            for small in capitals - {body}:
                if abs(small / body - 5 / 7) > 0.001 or small < (2.5 if large else 1.75) - 0.001:
                    faults.append(f"a script of {text.string!r} is {small:.2f} high")
        heads = {round(tip.length, 3) for v in page.all for tip in v.tips}
        if len(heads) > 1 or min(heads, default=3.0) < 2.499:
            faults.append(f"arrowheads {heads}")
        for e in page.root.iter():
            for key in ("stroke", "fill"):
                colour = e.get(key, "none")
                if colour not in ("none", "#000", "#fff") and not dark(colour):
                    faults.append(f"{key} {colour}")
                if colour == "#fff" and key == "stroke":
                    faults.append("a white line")
    return faults


def dark(colour: str) -> bool:
    digits = colour.lstrip("#")
    digits = "".join(d * 2 for d in digits) if len(digits) == 3 else digits
    r, g, b = (int(digits[i : i + 2], 16) for i in (0, 2, 4))
    return 0.299 * r + 0.587 * g + 0.114 * b <= 128


def word_faults(case: Case, sheet: Sheet) -> list[str]:
    """G3, G6: one language, nothing unfilled, decimal sign of the language, scale factors with number and unit."""
    faults = []
    for text in sheet.texts:
        string = text.string
        shown = " ".join(run.string for run in text.runs)
        if re.search(r"None|TODO|nan|inf\b|[{}\\]", shown):
            faults.append(f"unfilled: {shown!r}")
        if re.search(FOREIGN[case.lang], shown):
            faults.append(f"foreign letters: {shown!r}")
        if case.lang != "en" and re.search(r"\b[A-Za-z]{4,}\b|\bRRP\b", shown):
            faults.append(f"a Latin word: {shown!r}")
        if any(re.search(rf"(?<!\w){word}(?!\w)", shown) for word in OTHERS[case.lang] if word != "план"):
            faults.append(f"a foreign word: {shown!r}")
        if text.role not in ("label",) and not re.search(r"\d\.\d+\.|\.\d+\.", string) and "ТММ" not in string:
            try:
                numbers_of(string, case.lang)
            except AssertionError:
                faults.append(f"decimal sign: {string!r}")
    for view in sheet.views:
        headings = [t.string for t in view.of("heading")]
        if not headings:
            faults.append(f"{view.name} has no heading")
        if view.vectors and not any(re.match(r"μ_\{\w+\} = [\d,.]+ \(?[^\d\s]", h) for h in headings):
            faults.append(f"{view.name} has no scale factor: {headings}")
    return faults


CASES = [*SAMPLE, *ISO]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_page_and_frame_are_those_of_the_format(case: Case) -> None:
    assert page_faults(case, drawn(case)) == []


@pytest.mark.parametrize("case", CASES, ids=str)
def test_pens_letters_and_arrowheads_have_the_sizes_of_the_format(case: Case) -> None:
    assert pen_faults(case, drawn(case)) == []


@pytest.mark.parametrize("case", CASES, ids=str)
def test_words_are_of_one_language_and_complete(case: Case) -> None:
    assert word_faults(case, drawn(case)) == []


@pytest.mark.parametrize("case", CASES, ids=str)
def test_nothing_touches(case: Case) -> None:
    assert overlaps(drawn(case)) == []


def test_the_judge_sees_a_letter_on_a_line_and_on_a_letter() -> None:
    case = Case(format="A1")
    (svg,) = pages(case)
    found = re.search(r'<text class="label" [^>]*x="([\d.]+)" y="[\d.]+">p</text>', svg)
    assert found
    spoiled = svg.replace(found[0], found[0].replace(found[1], f"{float(found[1]) + 12:.3f}"))

    assert overlaps(read(spoiled))


def test_every_grey_is_dark_enough_to_print() -> None:
    assert dark("#808080")
    assert not dark("#909090")


def test_the_sheet_of_iso_has_letters_of_iso() -> None:
    strings = [t.string for t in drawn(ISO[0]).texts]

    assert "v_{A}" in strings
    assert "α_{2}" in strings
    assert "V_{A}" not in strings
