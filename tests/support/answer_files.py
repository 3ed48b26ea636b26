"""Files of answers for tests of reading: written, and read again."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import openpyxl

from kulman.variants.marking.cells import Asked
from kulman.variants.marking.keyed import asked_of
from kulman.variants.marking.reading import Answers, _read_answers
from kulman.variants.solution import solve

ASKED = asked_of(solve("nau-slider-crank", "example"))
ROW = "V_B;55,2;0,05;2,76;м/с;180\n"
HEAD = "величина;відрізок, мм;масштаб;значення;одиниця;напрям\n"


def read(tmp_path: Path, text: str | bytes, name: str = "answers.csv", asked: Asked = ASKED) -> list[Answers]:
    """Return the answers of a file with this content."""
    file = tmp_path / name
    file.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
    return _read_answers(file, asked)


def one(tmp_path: Path, text: str | bytes, name: str = "answers.csv") -> Answers:
    (answers,) = read(tmp_path, text, name)
    return answers


def messages(answers: Answers) -> list[str]:
    return [problem.text("en") for problem in answers.problems]


def table(rows: Sequence[Sequence[object]], separator: str = ";") -> str:
    """Return cells as CSV."""
    stream = io.StringIO()
    csv.writer(stream, delimiter=separator).writerows(rows)
    return stream.getvalue()


def write(tmp_path: Path, rows: Sequence[Sequence[object]], suffix: str = ".csv", name: str = "answers") -> Path:
    """Write rows of cells as CSV or as a workbook."""
    file = tmp_path / f"{name}{suffix}"
    if suffix == ".csv":
        file.write_text(table(rows), encoding="utf-8", newline="")
        return file
    book = openpyxl.Workbook()
    assert book.active is not None
    for row in rows:
        book.active.append(row)
    book.save(file)
    return file
