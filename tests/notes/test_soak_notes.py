"""The notes of all bundled tasks in every language, each written once for all that is asked of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import note
from kulman.tests.notes import test_docx as in_word
from kulman.tests.notes import test_notes as in_print
from kulman.variants.shelf import bundled

pytestmark = pytest.mark.soak
LINKAGES = bundled("mechanism")  # whose plans are told mark by mark


@pytest.mark.parametrize("lang", in_print.LANGUAGES)
@pytest.mark.parametrize(("number", "task"), [*enumerate(bundled())])
def test_a_note_is_complete_and_right(number: int, task: str, lang: str, tmp_path: Path) -> None:
    written = note(task, lang=lang, student="І. Петренко", date="2026")

    in_print.assert_everything_is_said(written, lang)
    in_word.assert_a_document_says_all(written.document)
    if lang == "en" and task in LINKAGES:
        in_print.assert_measured_as_solved(written, task)
    if lang == in_print.LANGUAGES[number % 3]:
        in_print.assert_it_becomes_a_document(written, tmp_path)
        in_word.assert_it_becomes_a_document(written.document)
