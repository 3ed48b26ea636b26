"""Letters of the schools: symbols, marks, scale factors in either convention, printed numbers that agree."""

from __future__ import annotations

import pytest

from kulman.drawing.words import Words, notations
from kulman.scales.errors import LANGUAGES
from kulman.scales.scale import Scale
from kulman.tests.support.printed_numbers import equation_faults, half_digit, table, value
from kulman.tests.support.sheet_cases import Case, drawn, solved

BAUMAN = Case("5", "A1", "ru", notation="bauman")
NAMES = """V_B V_BA a_BA_n a_BA_t a_A3A2_k a_A3A2_r omega_2 epsilon_3 G_2 M_sum M_sum_3 P_2 h_2 h_21 h_F_3 h_2_A h_F_3_A
R_12 R_12_n R_01 M_43 J_S2 m_2 F_i2 M_i2 F_3 F_i2_couple F_i2_couple_B F_3_couple_C F_sum_couple_C F_sum_3_couple_C
h_lever_F_i2 h_lever_M_i2_B h_lever_M_3_C h_lever_G_2 mu_V mu_a mu_F_23 mu_l F_bal M_bal F_bal_lever
delta_F_bal l_AP2"""


@pytest.mark.parametrize("notation", notations())
@pytest.mark.parametrize("language", LANGUAGES)
def test_symbols_are_markup_without_names(notation: str, language: str) -> None:
    words = Words.of(language, notation)

    for name in NAMES.split():
        symbol = words.symbol(name)
        assert symbol.count("{") == symbol.count("}") == symbol.count("_{") + symbol.count("^{"), symbol
        assert "__" not in symbol, symbol
        assert words.symbol(name, bar=True).startswith("\\bar{"), symbol


def test_two_quantities_have_two_symbols() -> None:
    for notation in notations():
        words = Words.of("ru", notation)
        names = [name for name in NAMES.split() if "couple" not in name]

        assert len({words.symbol(name) for name in names}) == len(names), notation


@pytest.mark.parametrize(
    ("mu_l", "scale"),
    [(1e-3, "1:1"), (5e-4, "2:1"), (4e-4, "2.5:1"), (2e-4, "5:1"), (2e-3, "1:2"), (2.5e-3, "1:2.5"), (0.15, "1:150")],
)
def test_scale_of_lengths_is_written_as_drawings_have_it(mu_l: float, scale: str) -> None:
    assert Words.of("en", "iso").drawn_at(mu_l) == f"M {scale}"
    assert Words.of("uk", "nau").drawn_at(mu_l) == f"М {scale.replace('.', ',')}"  # the Cyrillic letter


@pytest.mark.parametrize(
    ("mark", "letter"),
    [
        ("velocity.A3", "a_{3}"),
        ("velocity.S2", "s_{2}"),
        ("acceleration.A3", "a′_{3}"),
        ("acceleration.n_BA", "n"),
        ("acceleration.k_A3A2", "k"),
        ("forces_23.0", "H"),
        ("forces_23.1", "a"),
        ("forces_23.14", "n"),
        ("forces_23.27", "a_{1}"),
    ],
)
def test_letters_of_marks(mark: str, letter: str) -> None:
    assert Words.of("uk", "nau").mark(mark) == letter


def test_letters_of_forces_leave_the_letter_of_the_pole_out() -> None:
    words = Words.of("en", "iso")

    assert words.mark("forces_23.0") == "o"
    assert "o" not in {words.mark(f"forces_23.{number}") for number in range(1, 60)}


def test_reaction_stands_with_the_link_on_which_it_acts_first() -> None:
    words = Words.of("ru", "bauman")

    assert [words.symbol(name) for name in ("R_12", "R_01", "h_21", "M_43")] == ["F_{21}", "F_{10}", "h_{12}", "M_{34}"]


def test_scale_factor_is_in_millimetres_per_unit() -> None:
    assert Words.of("ru", "bauman").scale(Scale("mu_V", 0.05, "m/s")) == "μ_{v} = 20 мм/(м/с)"


def test_sheet_of_bauman_has_segments_that_divide_by_its_scale_factors() -> None:
    sheet = drawn(BAUMAN)
    count = 0

    for name in sheet.names:
        for symbol, mm, scale, printed, *_ in table(sheet[name]) if name.startswith("results_") else ():
            if mm != "–":
                assert abs(value(mm) / value(scale) - value(printed)) <= half_digit(printed), symbol
                count += 1

    assert count > 20
    assert equation_faults(sheet)[1] == []


def test_sheet_of_bauman_has_angles_of_vectors() -> None:
    rows = {row[0]: row for row in table(drawn(BAUMAN)["results_velocity"])}

    velocity = solved(BAUMAN)["V_B"]

    assert velocity.x is not None
    assert rows["v_{B}"][-1] == ("0,0" if velocity.x > 0 else "180,0")
    assert rows["ω_{2}"][-1] == "–"
