"""Long texts of users, made to be looked through again and again: whoever reads them takes time in proportion."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from kulman.cli import main
from kulman.drawing.notes.markup import letters
from kulman.drawing.notes.omml import atoms_of
from kulman.drawing.text import escape, lay_out
from kulman.drawing.titleblock import surname, with_initials
from kulman.drawing.writers import slug
from kulman.scales.choose import chooser
from kulman.scales.errors import InputError, KulmanError
from kulman.scales.names import unknown
from kulman.scales.numbers import quote, split_number
from kulman.scales.units import parse as value_in
from kulman.scales.units import unit
from kulman.tests.support.answer_files import ASKED
from kulman.variants.checks.basics import Places
from kulman.variants.hands import hand_of
from kulman.variants.making.new_variants import _ranges_of, _with_variants
from kulman.variants.making.starter import _label
from kulman.variants.marking import cells
from kulman.variants.marking.wording import plain
from kulman.variants.roster import _folded, variant_of_book
from kulman.variants.sheets import variant_of_id
from kulman.variants.shelf import bundled_text
from kulman.variants.solution import solve
from kulman.variants.spreadsheets import grid as headers
from kulman.variants.tables import harmless

_OF_LINE = dict.fromkeys(map(ord, "'\n"))
SLIDER = solve("nau-slider-crank", "example").task
PIECES = (
    " ", "\t", "a", "A_", "1", "1 ", "1,", ".", "..", "-", "–", "…", "/", ",", ", ", ";", "; ", ":", "(", ")", "[",
    "]", "{", "}", "\\", '"', "'", "′", "_{", "^{", "\\u{", "=", "+-", "e", "1e", "м", "м5", "№", "°", "1°", "\u00a0",
    "\n", "#", "×", "|", "a-", "10..20", "<", "$", "\u202e", "ё", "Ἀ", "ﷺ",
)  # fmt: skip
ROUND = (("1", "x"), ("5 ", "мм"), ("V_B [", "x"))  # before and behind
READERS: dict[str, Callable[[str], object]] = {
    "tidy": headers.tidy,
    "unit over a column": headers.split_unit,
    "kind of a column": headers.column_kind,
    "kind of a cell": headers.about_kind,
    "quantity": headers.quantity_part,
    "symbol": headers.symbol,
    "variant": headers.variant_said,
    "recognised": lambda text: headers.recognised([[text]]),
    "number": split_number,
    "unit": unit,
    "value": lambda text: value_in(text, unit("mm")),
    "angle": lambda text: value_in(text, unit("deg")),
    "segment": lambda text: cells.segment(text, ""),
    "scale factor": lambda text: cells.scale_factor(text, "", "(m/s)/mm", "(m/s)/mm"),
    "answer": lambda text: cells.value(text, "", "V_B", ASKED),
    "direction": cells.direction,
    "paper": cells.of_paper,
    "hand": hand_of,
    "range": lambda text: _ranges_of(SLIDER, {"l_OA": text}),
    "record book": lambda text: variant_of_book(SLIDER, text),
    "digits": lambda text: variant_of_book(SLIDER, "12", text),
    "scale": lambda text: chooser("mu_V", text),
    "name": lambda text: unknown("given-unknown", text, SLIDER.givens, task="x"),
    "quoted": quote,
    "slug": slug,
    "label": _label,
    "folded": _folded,
    "surname": surname,
    "initials": with_initials,
    "escaped": escape,
    "markup": lambda text: letters(escape(text)),
    "laid out": lambda text: lay_out(escape(text), 3.5),
    "atoms": lambda text: atoms_of(escape(text)),
    "wording": plain,
    "cell of CSV": harmless,
    "sheet": lambda text: variant_of_id(SLIDER, text),
    "places of TOML": lambda text: Places(f"x = '{text.translate(_OF_LINE)}' # {text.translate(_OF_LINE)}"),
    "task file": lambda text: _with_variants(bundled_text("nau-slider-crank") + text, ()),
}


def seconds(reader: Callable[[str], object], text: str) -> float:
    begin = time.process_time()
    with suppress(KulmanError):
        reader(text)
    return time.process_time() - begin


@pytest.mark.soak
@pytest.mark.parametrize("name", READERS)
def test_no_text_takes_more_time_than_its_length(name: str) -> None:
    reader = READERS[name]
    for piece in PIECES:
        for before, behind in ROUND:
            texts = [before + piece * (n // len(piece)) + behind for n in (800, 8_000)]
            short, long = (seconds(reader, text) for text in texts)

            assert long < max(30.0 * short, 0.3), (piece, before, behind)  # a hundred times if it were the square


@pytest.mark.parametrize(
    ("option", "value"),
    [("--set", "l_OA=" + " " * 20_000), ("--student", "а" * 20_000), ("--scale", "mu_V=" + "1" * 20_000)],
)
def test_an_option_longer_than_any_is_refused(
    option: str, value: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["sheet", "nau-slider-crank", option, value, "-o", str(tmp_path / "x.svg")])

    error = capsys.readouterr().err
    assert caught.value.code == 2
    assert len(error) < 200
    assert "10000" in error
    assert not list(tmp_path.iterdir())


def test_ranges_and_units_are_taken_apart_as_before() -> None:
    ranges = _ranges_of(SLIDER, {"l_OA": " 25 .. 60 / 5 mm ", "n_1": "700–800 rpm", "l_AB": "0.1...0.2 m"})

    assert (ranges["l_OA"].low, ranges["l_OA"].high, ranges["l_OA"].step) == (25, 60, 5)
    assert (ranges["n_1"].low, ranges["n_1"].high) == (700, 800)
    assert (ranges["l_AB"].low, ranges["l_AB"].high) == (100, 200)
    for bad in ("..", "5..", "..5", "5../2", "5..7/", "5", ""):
        with pytest.raises(InputError):
            _ranges_of(SLIDER, {"l_OA": bad})
