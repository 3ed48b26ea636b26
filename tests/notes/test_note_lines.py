"""Lines of a note in typst: where they may end, which letters are slanted, what stands on every page of a table."""

from __future__ import annotations

import pytest

from kulman.drawing.notes.blocks import Block, Equations, Figure, Heading, Sentences, Steps, Table
from kulman.drawing.notes.typst import Body
from kulman.drawing.shapes import Line
from kulman.drawing.view import View

TIE = "\u00a0"


def written(*blocks: Block) -> str:
    return Body.of(blocks, "en").text


@pytest.mark.parametrize("block", [Steps(("r_{0} = 45.26 mm and more",)), Sentences(("r_{0} = 45.26 mm and more",))])
def test_no_line_ends_between_a_letter_its_number_and_the_unit(block: Block) -> None:
    text = written(block)

    assert f"{TIE}= 45.26{TIE}mm and more" in text


def test_equations_may_end_a_line_before_a_sign() -> None:
    assert TIE not in written(Equations((("a = 2·3", "= 6 mm"),)))


@pytest.mark.parametrize(
    ("markup", "slanted", "upright"),
    [
        ("d^{2}s/dφ^{2}", "", "dφ"),
        ("μ_{d^{2}s/dφ^{2}}", "μ", "dφ"),
        ("ω^{2}·r_{0}", "ωr", ""),
        ("P_{1}B_{1}", "PB", ""),
        ("OP_{1} = 2", "", "P"),
        ("a_{B} = 2 m/s^{2}", "a", "s"),
        ("V_{A}^{2}/l_{OA}", "Vl", ""),
        ("μ_{s} = h/S_{max}", "μS", ""),
        ("m/s^{2}", "", "s"),
    ],
)
def test_letters_of_one_word_are_all_upright(markup: str, slanted: str, upright: str) -> None:
    text = written(Sentences((markup,)))

    assert all(f'attach(italic("{letter}")' in text for letter in slanted)
    assert all(f'attach("{letter}"' in text for letter in upright)
    assert text.count("italic") == len(slanted)


def test_scripts_of_a_script_stand_close() -> None:
    assert 't: "2")"s/d"attach(' in written(Sentences(("μ_{d^{2}s/dφ^{2}}",)))


def test_the_head_of_a_table_stands_on_every_page() -> None:
    text = written(Table((("i", "φ"), ("0", "0.00"), ("1", None))))

    head, body = text.split("\n")[0], text.split("\n")[1]
    assert "table.header(" in head
    assert "φ" in head
    assert "0.00" not in head
    assert "0.00" in body
    assert "colspan: 2" in body


def figure(width: float, height: float) -> Figure:
    return Figure(View("plan", (Line(0j, complex(width, height)),), (0.0, 0.0, width, height)), "Plan", ())


def test_a_figure_that_would_be_too_small_stands_on_a_larger_sheet_at_the_end() -> None:
    body = Body.of((figure(90.0, 90.0), figure(300.0, 500.0), figure(200.0, 90.0), Heading("End")), "en")

    assert body.figures.keys() == {"1.svg", "2.svg", "3.svg"}
    shown, folded = body.text.split("= ")[0], body.text.split('#page(paper: "a3")')[1]
    assert [name in shown for name in ('"1.svg"', '"2.svg"', '"3.svg"')] == [True, False, True]
    assert "Figure 2 stands on a sheet A3" in shown
    assert "counter(figure.where(kind: image)).step()" in shown  # so that the next one is the third
    assert 'image("2.svg", width: 204.0000mm)' in folded
    assert 'numbering: _ => "2"' in folded
    assert "reduced to 68 %" in folded
