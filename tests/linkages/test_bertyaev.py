"""The six-bar linkage of Bertyaev: every number that is printed beside ours, and what the print has wrong.

Source: Bertyaev and others, Mechanics: course works with Mathcad 12, section 4, pp. 47-60, figs. 13-16. The pages with
the dimensions are missing; they were found from these results. A calculated number is right to half a unit of its last
digit; one that was measured on a figure, or follows from such a one, to a millimetre there at the scale factor printed.
"""

from __future__ import annotations

import json
import math

import pytest

from kulman import solve
from kulman.scales.scale import Display, Scale
from kulman.variants.solution import Solution

RULER = 0.1  # cm
M_V, M_A_B, M_A_M, M_A_D = 0.75, 0.4, 0.25, 0.05  # scale factors of the figures, (cm/s)/cm and (cm/s^2)/cm
AB, O1B, CD = 97.0, 66.0, 86.0
SHOWN = Display("cm", "cm")

# name, printed magnitude with its digits, what a ruler may miss
CALCULATED = [
    ("l_OA", "15"),
    ("l_O1C", "25"),
    ("V_B_e", "17.8"),
    ("V_M_e", "8.38"),
    ("V_D_e", "5.59"),
    ("V_K_e", "2.58"),
    ("a_B_k", "7.81"),
    ("a_B_en", "3.10"),
    ("a_B_et", "0"),
    ("a_B_rn", "5.16"),
    ("a_B_n", "0.443"),
    ("a_M_en", "1.46"),
    ("a_M_et", "0"),
    ("a_M_rn", "2.23"),
    ("a_M_rt", "0.26"),
    ("a_M_k", "3.38"),
    ("a_D_en", "0.458"),
    ("a_D_et", "0.062"),
    ("a_D_rn", "0.383"),
    ("a_D_k", "0.940"),
    ("a_K_en", "0.212"),
    ("a_K_et", "0.029"),
    ("a_K_rn", "0.209"),
    ("a_K_rt", "0.037"),
    ("a_K_k", "0.514"),
]
MEASURED = [
    ("l_OB", "102", 0.5),
    ("l_OM", "48", 0.5),
    ("l_O1D", "68", 0.5),
    ("V_B_r", "22.4", RULER * M_V),
    ("V_B", "5.4", RULER * M_V),
    ("omega_r_2", "0.2306", RULER * M_V / AB),
    ("omega_2", "0.056", RULER * M_V / AB),
    ("l_AP2", "47", 0.5),
    ("V_M_r", "9.68", RULER * M_V),
    ("V_M", "3.05", RULER * M_V),
    ("omega_3", "0.0819", RULER * M_V / O1B),
    ("V_D_r", "5.74", RULER * M_V),
    ("V_D", "1.31", RULER * M_V),
    ("omega_r_4", "0.0667", RULER * M_V / CD),
    ("V_K_r", "3.14", RULER * M_V),
    ("V_K", "1.55", RULER * M_V),
    ("omega_4", "0.0152", RULER * M_V / CD),
    ("l_O1P4", "109.7", 0.5),
    ("a_B_rt", "0.597", RULER * M_A_B),
    ("a_B_t", "0.06", RULER * M_A_B),
    ("a_B", "0.45", RULER * M_A_B),
    ("epsilon_3", "0.0009", RULER * M_A_B / O1B),
    ("a_C", "0.172", RULER * M_A_B * 25 / O1B),
    ("a_M", "0.31", RULER * M_A_M),
    ("a_D_rt", "0.067", RULER * M_A_D),
    ("a_D", "0.105", RULER * M_A_D),
    ("epsilon_r_4", "0.00078", RULER * M_A_D / CD),
    ("epsilon_4", "0.00168", RULER * M_A_D / CD),
    ("a_K", "0.116", RULER * M_A_D),
]
# printed, right to as many digits, and what the text itself makes of it
ERRATA = {
    "l_O1K": ("35.5", "31.5", 2.58 / 0.0819),  # v_K^e = omega_CD^e O1K
    "epsilon_r_2": ("0.0063", "0.0062", 0.597 / AB),
    "epsilon_2": ("0.0063", "0.0062", 0.597 / AB),
}
CLOCKWISE = ("omega_2", "omega_3", "omega_4", "omega_r_2", "epsilon_3", "epsilon_4", "epsilon_r_4")
COUNTER_CLOCKWISE = ("omega_1", "omega_r_4", "epsilon_2", "epsilon_r_2")


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve("bertyaev-six-bar", lang="ru")


def shown(solution: Solution, name: str) -> float:
    """Return a magnitude in cm and s."""
    value = solution[name].shown(SHOWN).value
    assert value is not None
    return abs(value)


def last_digit(printed: str) -> float:
    """Return a unit of the last printed digit."""
    return 10.0 ** -len(printed.partition(".")[2])


@pytest.mark.parametrize(("name", "printed"), CALCULATED)
def test_calculated_numbers_are_those_of_the_print(solution: Solution, name: str, printed: str) -> None:
    # the print calculates with rounded omega_CD^e = 0.0819 and epsilon_r: a unit of the last digit
    assert shown(solution, name) == pytest.approx(float(printed), abs=last_digit(printed) / 2 * 1.0001 + 1e-4)


@pytest.mark.parametrize(("name", "printed", "ruler"), MEASURED)
def test_measured_numbers_are_those_of_the_print(solution: Solution, name: str, printed: str, ruler: float) -> None:
    assert shown(solution, name) == pytest.approx(float(printed), abs=max(ruler, last_digit(printed) / 2))


@pytest.mark.parametrize("name", ERRATA)
def test_misprints_contradict_the_text_itself(solution: Solution, name: str) -> None:
    printed, right, follows = ERRATA[name]

    assert shown(solution, name) == pytest.approx(float(right), abs=last_digit(right) / 2)
    assert follows == pytest.approx(float(right), abs=last_digit(right) / 2)
    assert abs(float(printed) - follows) > last_digit(printed) / 2


def test_all_printed_numbers_are_compared(solution: Solution) -> None:
    names = [name for name, *_ in (*CALCULATED, *MEASURED)] + [*ERRATA]

    assert len(names) == len(set(names)) == 57
    for point in "BMDK":
        parts = {f"V_{point}_{part}" for part in "er"} | {f"a_{point}_{part}" for part in ("en", "et", "rn", "rt", "k")}
        assert parts <= {*names}


def test_senses_are_those_of_the_print(solution: Solution) -> None:
    for name in CLOCKWISE:
        assert solution.solved.values[name] < 0, name
    for name in COUNTER_CLOCKWISE:
        assert solution.solved.values[name] > 0, name


def test_absolute_rate_is_the_algebraic_sum_of_both(solution: Solution) -> None:
    omega_e, omega_r, omega = (solution.solved.values[name] for name in ("omega_3", "omega_r_4", "omega_4"))

    assert omega_e < 0 < omega_r
    assert omega == pytest.approx(omega_e + omega_r, abs=1e-15)


def test_instant_centres_stand_where_the_print_has_them(solution: Solution) -> None:
    """AB: beyond A on the line OA; CD: on the line C-O1 beyond O1."""
    O, A, C, O1 = (solution.solved.point(point) for point in ("O", "A", "C", "O1"))
    first, second = (solution.solved.point(P) for P in ("P_2", "P_4"))

    assert abs(first - O) == pytest.approx(abs(first - A) + abs(A - O))
    assert abs(second - C) == pytest.approx(abs(second - O1) + abs(O1 - C))


def test_small_remainder_loses_digits(solution: Solution) -> None:
    """a_B^t = 0.06 is left of vectors up to 7.8: with 3.11 for 3.10 alone it would be 0.08."""
    values = solution.solved.values
    longer = values["a_B_en"] * (3.11 / 3.10)
    shift = longer - values["a_B_en"]
    along, across = values["n_AB"], values["n_O1B"]

    sine = (along.conjugate() * across).imag
    moved = values["a_B_t"] + across * ((along.conjugate() * shift).imag / sine)

    assert abs(moved) * 100 == pytest.approx(0.08, abs=0.005)


def test_both_routes_agree(solution: Solution) -> None:
    check = solution.checks["compound"]

    assert check["ok"] is True
    assert check["value"] < 1e-12
    assert check["unit"] == ""


@pytest.mark.parametrize("phi", range(0, 360, 15))
def test_both_routes_agree_in_the_whole_cycle(phi: int) -> None:
    assert solve("bertyaev-six-bar", set={"phi": phi}).checks["compound"]["value"] < 1e-11


def test_results_are_shown_in_centimetres_and_scales_per_centimetre(solution: Solution) -> None:
    rows = {line.split()[0]: line for line in solution.table().splitlines() if line}

    assert rows["l_OB"].split() == ["l_OB", "101,811", "см", "20,362", "см"]
    assert "17,7694    см/с" in rows["V_B_e"]
    assert "7,80661   см/с²" in rows["a_B_k"]
    assert solution.words.scale(solution.scales["mu_V"]).endswith("= 0,75 (см/с)/см")
    assert solution.words.scale(solution.scales["mu_l"]).endswith("= 5 см/см")


def test_json_stays_in_si(solution: Solution) -> None:
    item = json.loads(json.dumps(solution.to_json()))["quantities"]

    assert item["V_B_e"]["unit"] == "m/s"
    assert item["V_B_e"]["value"] == pytest.approx(0.178, abs=5e-4)
    assert item["V_B_e"]["mm"] == pytest.approx(236.9, abs=0.05)
    assert item["P_4"].keys() == {"unit", "x", "y"}
    assert item["P_4"]["y"] == pytest.approx(item["D"]["y"])


def test_forces_are_shown_in_metres_all_the_same() -> None:
    assert "m/s²" in solve("bertyaev-six-bar", only="acceleration,forces").table("en")


@pytest.mark.parametrize(
    ("language", "transport", "normal", "coriolis"),
    [
        ("ru", "v^{e}_{B}", "a^{e Ц}_{B}", "a^{c}_{B}"),
        ("uk", "v^{e}_{B}", "a^{e ДЦ}_{B}", "a^{c}_{B}"),
        ("en", "v^{e}_{B}", "a^{e n}_{B}", "a^{c}_{B}"),
    ],
)
def test_letters_are_those_of_the_print(language: str, transport: str, normal: str, coriolis: str) -> None:
    words = solve("bertyaev-six-bar", lang=language).words

    assert [words.symbol(name) for name in ("V_B_e", "a_B_en", "a_B_k")] == [transport, normal, coriolis]
    assert words.symbol("l_O1B") == "O_{1}B"


def test_scale_factor_keeps_its_value_when_it_is_shown() -> None:
    scale = Scale("mu_a", 0.0004, "m/s^2")

    once = SHOWN.scale(scale)

    assert (once.mu, once.unit, once.paper) == (0.4, "cm/s^2", "cm")
    assert SHOWN.scale(once) == once
    assert math.isclose(once.measured(2.5) / 100, scale.measured(25.0))
