"""What a task file says of its data stands on the sheet and in the note of every kind, in their language."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import note, sheet
from kulman.drawing.notes.blocks import Equations, Heading
from kulman.scales.errors import LANGUAGES
from kulman.variants.shelf import bundled_text

SAID = {"uk": "слово про дані", "ru": "слово о данных", "en": "a word on the data"}
FEW = {"nau-slider-crank": "position", "madi-gear": "sliding", "karpenko-hoist": "scheme"}


def noted(task: str, folder: Path) -> str:
    """Return a copy of a task file with a note of its own."""
    head, _, rest = bundled_text(task).partition("\n[givens]")
    before, _, after = head.partition("\n[note]")
    tables = after.partition("\n[")[2]
    own = "\n[note]\n" + "".join(f'{lang} = "{text}"\n' for lang, text in SAID.items())
    file = folder / "own.toml"
    file.write_text(f"{before}{own}\n{'[' + tables if tables else ''}\n[givens]{rest}", encoding="utf-8")
    return str(file)


@pytest.mark.parametrize("lang", ["uk", *(pytest.param(lang, marks=pytest.mark.soak) for lang in ("ru", "en"))])
@pytest.mark.parametrize(("task", "only"), FEW.items())
def test_a_word_of_the_task_stands_on_the_sheet_and_in_the_note(
    task: str, only: str, lang: str, tmp_path: Path
) -> None:
    own = noted(task, tmp_path)
    assert lang in LANGUAGES

    view = next(view for view in sheet(own, only=only, lang=lang).views if view.name == "note")
    assert [" ".join(line) for line in view.lines] == [SAID[lang]]
    blocks = note(own, only=only, lang=lang).document.blocks
    said = [block for block in blocks if isinstance(block, Equations) and " ".join(block.lines[0]) == SAID[lang]]
    assert len(said) == 1
    heading = blocks[blocks.index(said[0]) - 1]
    assert isinstance(heading, Heading)
    assert heading.text in ("Примітка", "Примечание", "Note", "Примітки", "Примечания")


def test_the_bundled_hoist_says_where_its_numbers_come_from() -> None:
    views = sheet("karpenko-hoist", only="scheme", lang="en").views

    assert "The article prints no numbers" in " ".join(next(view for view in views if view.name == "note").lines[0])
