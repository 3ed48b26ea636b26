"""Files of answers for tests of reading: written, and read again."""

from __future__ import annotations

from pathlib import Path

from kulman.variants.marking.cells import Asked
from kulman.variants.marking.keyed import asked_of
from kulman.variants.marking.reading import Answers, read_answers
from kulman.variants.solution import solve

ASKED = asked_of(solve("nau-slider-crank", "example"))
ROW = "V_B;55,2;0,05;2,76;м/с;180\n"
HEAD = "величина;відрізок, мм;масштаб;значення;одиниця;напрям\n"


def read(tmp_path: Path, text: str | bytes, name: str = "answers.csv", asked: Asked = ASKED) -> list[Answers]:
    """Return the answers of a file with this content."""
    file = tmp_path / name
    file.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
    return read_answers(file, asked)


def one(tmp_path: Path, text: str | bytes, name: str = "answers.csv") -> Answers:
    found = read(tmp_path, text, name)
    assert len(found) == 1
    return found[0]


def messages(answers: Answers) -> list[str]:
    return [problem.text("en") for problem in answers.problems]
