"""The files of a sheet: to scale on every format, the same bytes each time, letters that can be searched in the PDF."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pdfminer.high_level import extract_pages
from pdfminer.layout import LAParams, LTLine, LTTextContainer
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfparser import PDFParser
from pdfminer.pdftypes import resolve1

from kulman.drawing.pdf import write as write_pdf
from kulman.tests.sheets.test_sheet_points import SAMPLE
from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.sheet_cases import TASK, Case, drawn, sheet_of, solved

MM = 25.4 / 72
LETTERS = LAParams(boxes_flow=None)  # letters as lines of text, which take no order


def scale_faults(case: Case) -> list[str]:
    """Vectors that are not drawn to their printed scale factor, or do not have the value of `kulman solve`."""
    read, numbers, faults = drawn(case), solved(case), []
    for vector in read.vectors:
        if abs(abs(vector.span) - vector.value / vector.mu) > 0.01:
            faults.append(f"{case}: {vector.quantity} is {abs(vector.span)} mm long")
        if vector.value != pytest.approx(numbers[vector.quantity].value, rel=1e-12, abs=1e-12):
            faults.append(f"{case}: {vector.quantity} is {vector.value}")
    if len(read.vectors) < 20:
        faults.append(f"{case}: only {len(read.vectors)} vectors")
    return faults


@pytest.mark.parametrize("case", SAMPLE, ids=str)
def test_length_times_mu_is_the_value(case: Case) -> None:
    assert scale_faults(case) == []


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
                near = (vector.tail.real, vector.tail.imag)
                if abs(vector.span) > 5 and not any(
                    abs(x - near[0]) < 0.1 and abs(y - near[1]) < 0.1 for x, y, *_ in lines
                ):
                    faults.append(f"no {vector.quantity} in the PDF")
    text = "".join(item.get_text() for page in pages for item in page if isinstance(item, LTTextContainer))
    for heading in ("План швидкостей", "План прискорень", "Структура механізму", "Вихідні дані"):
        if heading not in text:
            faults.append(f"{heading!r} cannot be searched")
    document = PDFDocument(PDFParser(stream))
    for number in (number for xref in document.xrefs for number in xref.get_objids()):
        item = resolve1(document.getobj(number))
        if (
            isinstance(item, dict)
            and getattr(item.get("Type"), "name", "") == "FontDescriptor"
            and "FontFile2" not in item
        ):
            faults.append(f"a font is not embedded: {item}")
    return [f"{case}: {fault}" for fault in faults]


@pytest.mark.parametrize("case", [Case("3", "A4"), Case("8", "A3")], ids=str)
def test_the_pdf_is_the_same_sheet_with_letters_that_can_be_searched(case: Case) -> None:
    assert pdf_faults(case) == []


def test_the_same_command_gives_the_same_bytes_later(tmp_path: Path) -> None:
    made = []
    for seed in ("1", "2"):
        folder = tmp_path / seed
        folder.mkdir()
        files = [folder / "sheet.svg", folder / "sheet.pdf"]
        command = [sys.executable, "-m", "kulman", "sheet", TASK, "-v", "3", "--format", "A3", "--lang", "ru"]
        command += [part for file in files for part in ("-o", str(file))]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run(command, check=True, capture_output=True, env=environment)
        made.append({file.name: file.read_bytes() for file in sorted(folder.iterdir())})
        time.sleep(1.1 if seed == "1" else 0.0)

    assert made[0] == made[1]
    assert any(name.endswith(".pdf") for name in made[0])


def test_the_variants_are_those_of_the_guide() -> None:
    assert len(NAU_VARIANTS) == 11
