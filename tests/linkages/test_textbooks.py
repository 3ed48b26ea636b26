"""Worked examples of a guide, a student's note and a textbook: their printed values beside the computed ones.

GUIDE: National Aviation University, Theory of mechanisms and machines: guide to the calculation-graphic work, Kyiv
2016, worked example (phi 60 deg, l_OA 50, l_AB 130, l_AS2 60 mm, n_1 765 rpm clockwise, F_3 1.5 kN), sections 2 to 5.
Errata. Its velocity and acceleration plans are drawn wrongly: the segment ab measures 27 mm where the construction
gives 42.5 mm, and all that hangs on V_BA follows (omega_2, a^n_BA, a_B, a_S2, both forces of inertia, the arm of F_i2
on the lever). The arm h_2 and one arm of the couple on the lever are measured to a wrong line. That the balancing
moments all the same agree with the true one within 3 per cent is luck: the errors cancel.

NOTE: Moscow Automobile and Road Institute, Machine parts and theory of mechanisms, explanatory note to the course
project, task 17, 2006, sheet 3. A and D are pivots of the frame, B the crank pin, C the pin of the rocker: AD 510,
AB 120, BC 480, DC 380 mm, n_1 = 900 rpm clockwise, crank at 345 deg, C above AD; masses 1.2, 4.8, 3.8 kg, moments of
inertia 0.111 and 0.055 kg m^2, centres of mass at mid-length, a resisting moment of 380 N m on the rocker.
Printed values were read off drawings; the kinematics agree within two per cent. Errata. Both moments of the forces of
inertia are taken with the wrong sign, against the angular accelerations of its own plan: 246 N m enters the moments of
link 2 against those of P_i2 (they turn the same way), and 69 N m is subtracted from the resisting moment (it adds to
it). The lever repeats both, so that the two balancing forces agree, 4886 and 4723 N, where the right one is 4077 N.
With these two signs turned the printed forces follow, which is tested. Slips of the pen: V_CB is 11.813 m/s in one line
and 11.823 m/s in the next; the rocker's angular velocity has the index 2; the scale of the plan, 2.5 : 1, is that of a
reduction.

BERTYAEV: Bertyaev and others, Mechanics: course works with Mathcad 12, section 4, pp. 47-60, figs. 13-16. The pages
with the dimensions are missing; they were found from these results. A calculated number is right to half a unit of its
last digit; one that was measured on a figure, or follows from such a one, to a millimetre there at its scale factor.
"""

from __future__ import annotations

import math

import pytest

from kulman import solve
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.scale import Display, Scale
from kulman.variants.solution import Solution

MU_V = 0.05  # m/s in a millimetre
GUIDE = {  # what a printed value may miss: right to 5 per cent, a little off
    0.05: {
        **{"omega_1": 80.07, "V_A": 4.0, "V_S2": 3.4, "a_A": 320.56, "R_12_t": 353.3, "R_03": 870, "R_12": 2580},
        **{"R_32": 2130, "h_21": 28e-3, "M_bal": 72.24, "h_lever_M_i2_B": 19 * MU_V, "F_bal": 1471},
        "M_bal_lever": 73.54,
    },
    0.07: {
        **{"V_B": 2.9, "a_BA_t": 268, "epsilon_2": 2062, "M_i2": 30.93, "R_12_n": 2520, "R_01": 2575},
        **{"F_i2_couple": 237.9, "h_lever_F_i3": 58 * MU_V},
    },
}
GUIDE_ERRATA = {
    **{"V_BA": 1.35, "omega_2": 10.4, "a_BA_n": 14.0, "a_B": 196, "a_S2": 200, "F_i2": 500, "F_i3": 392, "h_2": 30e-3},
    **{"h_lever_F_i2": 23 * MU_V, "h_lever_M_i2_A": 34 * MU_V},
}


@pytest.fixture(scope="module")
def guide() -> Solution:
    return solve("nau-slider-crank", "example", set={"side": "left", "rotation": "cw"})


def size(solution: Solution, name: str) -> float:
    return abs(solution[name].value or 0.0)


def test_printed_values_of_the_guide_are_right_or_errata(guide: Solution) -> None:
    for part, values in GUIDE.items():
        for name, printed in values.items():
            assert printed == pytest.approx(size(guide, name), rel=part), name
    for name, printed in GUIDE_ERRATA.items():
        assert abs(printed / size(guide, name) - 1) > 0.11, name


def test_geometry_and_senses_are_those_of_the_example_of_the_guide(guide: Solution) -> None:
    rod_angle = math.asin(0.05 * math.sin(math.radians(60)) / 0.13)
    v_A = 765 * math.pi / 30 * 0.05

    # law of sines in the triangle pab
    assert size(guide, "V_BA") == pytest.approx(v_A * math.cos(math.radians(60)) / math.cos(rod_angle), rel=1e-14)
    assert all((guide[name].value or 0.0) < 0 for name in ("omega_1", "omega_2", "epsilon_2"))  # the rod speeds up
    assert guide.solved.point("B").real < 0 < (guide["M_bal"].value or 0.0)


NOTE = {
    **{"omega_1": 94.248, "V_B": 11.310, "V_C": 13.230, "V_CB": 11.813, "omega_2": 24.610, "omega_3": 34.816},
    **{"a_CB_n": 290.713, "a_C_n": 460.618, "a_CB_t": 1065.9, "a_C_t": 479.655, "a_CB": 1114.931, "a_C": 660.858},
    **{"a_S1": 532.95, "a_S2": 690.7, "a_S3": 333.56, "epsilon_2": 2220.625, "epsilon_3": 1262.25},
    **{"F_i1": 639.54, "F_i2": 3315.38, "F_i3": 1263.73, "M_i2": 246.489, "M_i3": 69.424},
    **{"h_2": 160e-3, "h_3": 137.5e-3, "F_i2_couple": 513.519},
    **{"h_lever_F_i2": 49 * 0.189, "h_lever_F_i3": 25 * 0.189, "h_lever_M_i2_C": 42 * 0.189},
    **{"h_lever_M_i2_B": 20.5 * 0.189, "h_lever_M_sum_C": 70 * 0.189},
}
WRONG_SIGNS = {
    **{"R_12_t": 591.608, "R_03_t": 360.035, "R_12_n": 5387.525, "R_03_n": 2254.472, "R_12": 5404.102},
    **{"R_03": 2287.626, "R_32": 3381.708, "h_21": 108.5e-3, "M_sum": 310.576, "F_sum_couple": 817.305},
    **{"F_bal": 4886.209, "F_bal_lever": 4722.55, "R_01": 2914.393},
}
RIGHT_SIGNS = {"R_12_t": 1622.2, "R_03_t": 728.16, "R_12": 5198.9, "R_03": 1290.3, "R_32": 2540.8, "F_bal": -4077.3}
UNPRINTED = """V_S1 V_S2 V_S3 h_lever_F_i1 F_i2_couple_B F_i2_couple_C F_sum_couple_C delta_F_bal l_AB l_BC l_DC A B C D
S1 S2 S3"""


@pytest.fixture(scope="module")
def note() -> Solution:
    return solve("madi-four-bar")


def test_printed_values_of_the_note_are_right_or_follow_from_two_wrong_signs(note: Solution) -> None:
    values = note.task.values()
    turned = solve_linkage(note.task.mechanism, {**values, "J_S2": -values["J_S2"], "J_S3": -values["J_S3"]})

    for name, printed in NOTE.items():
        assert printed == pytest.approx(size(note, name), rel=0.02), name
    for name, printed in WRONG_SIGNS.items():
        assert printed == pytest.approx(abs(turned.quantities[name].value or 0.0), rel=0.08), name
    for name, right in RIGHT_SIGNS.items():
        assert note[name].value == pytest.approx(right, rel=1e-4)
    assert [name for name in UNPRINTED.split() if name not in note] == []
    assert (note.status, note.checks["lever"]["ok"]) == ("ok", True)
    scales = {"mu_l": 0.0025, "mu_V": 0.189, "mu_a": 21.318, "mu_h": 0.126, "mu_F_23": 33.154, "mu_F_1": 54.373}
    assert {name: scale.mu for name, scale in note.scales.items()} == scales
    assert note["F_bal"].scale == "mu_F_1"


def test_signs_of_the_note_are_wrong_and_the_balancing_force_drives(note: Solution) -> None:
    values = note.solved.values
    force = values["_F_bal"]

    assert values["M_i2"] * ((values["S2"] - values["C"]).conjugate() * values["F_i2"]).imag > 0
    assert values["M_i3"] * values["M_3"] > 0
    assert values["M_sum"] == values["M_i3"] + values["M_3"]
    assert values["M_3"] == -380.0 < 0.0 < values["omega_3"]  # the rocker is loaded against its motion
    assert abs((force.conjugate() * values["e_AB"]).real) < 1e-9
    assert (force.conjugate() * values["V_B"]).real > 0.0
    assert values["R_01"] + values["R_21"] + values["F_i1"] + force == pytest.approx(0.0, abs=1e-9)
    assert values["F_bal"] == pytest.approx(values["F_bal_lever"], rel=1e-13)


RULER = 0.1  # cm
M_V, M_A_B, M_A_M, M_A_D = 0.75, 0.4, 0.25, 0.05  # scale factors of the figures, (cm/s)/cm and (cm/s^2)/cm
AB, O1B, CD = 97.0, 66.0, 86.0
SHOWN = Display("cm", "cm")
CALCULATED = """l_OA 15 l_O1C 25 V_B_e 17.8 V_M_e 8.38 V_D_e 5.59 V_K_e 2.58 a_B_k 7.81 a_B_en 3.10 a_B_et 0 a_B_rn 5.16
a_B_n 0.443 a_M_en 1.46 a_M_et 0 a_M_rn 2.23 a_M_rt 0.26 a_M_k 3.38 a_D_en 0.458 a_D_et 0.062 a_D_rn 0.383 a_D_k 0.940
a_K_en 0.212 a_K_et 0.029 a_K_rn 0.209 a_K_rt 0.037 a_K_k 0.514"""
MEASURED = {  # what a ruler may miss
    0.5: "l_OB 102 l_OM 48 l_O1D 68 l_AP2 47 l_O1P4 109.7",
    RULER * M_V: "V_B_r 22.4 V_B 5.4 V_M_r 9.68 V_M 3.05 V_D_r 5.74 V_D 1.31 V_K_r 3.14 V_K 1.55",
    RULER * M_V / AB: "omega_r_2 0.2306 omega_2 0.056",
    RULER * M_V / O1B: "omega_3 0.0819",
    RULER * M_V / CD: "omega_r_4 0.0667 omega_4 0.0152",
    RULER * M_A_B: "a_B_rt 0.597 a_B_t 0.06 a_B 0.45",
    RULER * M_A_B / O1B: "epsilon_3 0.0009",
    RULER * M_A_B * 25 / O1B: "a_C 0.172",
    RULER * M_A_M: "a_M 0.31",
    RULER * M_A_D: "a_D_rt 0.067 a_D 0.105 a_K 0.116",
    RULER * M_A_D / CD: "epsilon_r_4 0.00078 epsilon_4 0.00168",
}
# printed, right to as many digits, and what the text itself makes of it
ERRATA = {
    "l_O1K": ("35.5", "31.5", 2.58 / 0.0819),  # v_K^e = omega_CD^e O1K
    "epsilon_r_2": ("0.0063", "0.0062", 0.597 / AB),
    "epsilon_2": ("0.0063", "0.0062", 0.597 / AB),
}
CLOCKWISE = ("omega_2", "omega_3", "omega_4", "omega_r_2", "epsilon_3", "epsilon_4", "epsilon_r_4")
COUNTER_CLOCKWISE = ("omega_1", "omega_r_4", "epsilon_2", "epsilon_r_2")


@pytest.fixture(scope="module")
def bertyaev() -> Solution:
    return solve("bertyaev-six-bar", lang="ru")


def pairs(text: str) -> dict[str, str]:
    words = text.split()
    return dict(zip(words[::2], words[1::2], strict=True))


def shown(solution: Solution, name: str) -> float:
    """Return a magnitude in cm and s."""
    return abs(solution[name].shown(SHOWN).value or 0.0)


def half_digit(printed: str) -> float:
    """Return half a unit of the last printed digit."""
    return 0.5 * 10.0 ** -len(printed.partition(".")[2])


def test_numbers_of_bertyaev_are_right_to_their_digits_or_to_a_ruler(bertyaev: Solution) -> None:
    measured = {name: (printed, ruler) for ruler, text in MEASURED.items() for name, printed in pairs(text).items()}

    for name, printed in pairs(CALCULATED).items():
        # the print calculates with rounded omega_CD^e = 0.0819 and epsilon_r: a unit of the last digit
        assert shown(bertyaev, name) == pytest.approx(float(printed), abs=half_digit(printed) * 1.0001 + 1e-4), name
    for name, (printed, ruler) in measured.items():
        assert shown(bertyaev, name) == pytest.approx(float(printed), abs=max(ruler, half_digit(printed))), name
    names = {*pairs(CALCULATED), *measured, *ERRATA}
    assert len(names) == 57
    for point in "BMDK":
        parts = {f"V_{point}_{part}" for part in "er"} | {f"a_{point}_{part}" for part in ("en", "et", "rn", "rt", "k")}
        assert parts <= names
    for name, (printed, right, follows) in ERRATA.items():  # these contradict the text itself
        assert [shown(bertyaev, name), follows] == pytest.approx([float(right)] * 2, abs=half_digit(right))
        assert abs(float(printed) - follows) > half_digit(printed)
    assert all(bertyaev.solved.values[name] < 0 for name in CLOCKWISE)
    assert all(bertyaev.solved.values[name] > 0 for name in COUNTER_CLOCKWISE)


def test_instant_centres_stand_where_bertyaev_has_them(bertyaev: Solution) -> None:
    """AB: beyond A on the line OA; CD: on the line C-O1 beyond O1."""
    O, A, C, O1, first, second = (bertyaev.solved.point(point) for point in ("O", "A", "C", "O1", "P_2", "P_4"))

    assert abs(first - O) == pytest.approx(abs(first - A) + abs(A - O))
    assert abs(second - C) == pytest.approx(abs(second - O1) + abs(O1 - C))


def test_small_remainder_loses_digits(bertyaev: Solution) -> None:
    """a_B^t = 0.06 is left of vectors up to 7.8: with 3.11 for 3.10 alone it would be 0.08."""
    values = bertyaev.solved.values
    shift = values["a_B_en"] * (3.11 / 3.10 - 1)
    along, across = values["n_AB"], values["n_O1B"]

    moved = values["a_B_t"] + across * ((along.conjugate() * shift).imag / (along.conjugate() * across).imag)

    assert abs(moved) * 100 == pytest.approx(0.08, abs=0.005)


def test_both_routes_to_the_six_bar_agree_in_the_whole_cycle(bertyaev: Solution) -> None:
    omega_e, omega_r, omega = (bertyaev.solved.values[name] for name in ("omega_3", "omega_r_4", "omega_4"))

    assert omega == pytest.approx(omega_e + omega_r, abs=1e-15)
    assert bertyaev.checks["compound"]["ok"] is True
    assert bertyaev.checks["compound"]["value"] < 1e-12
    for phi in range(0, 360, 40):
        assert solve("bertyaev-six-bar", set={"phi": phi}).checks["compound"]["value"] < 1e-11


@pytest.mark.parametrize(("language", "normal"), [("ru", "a^{e Ц}_{B}"), ("uk", "a^{e ДЦ}_{B}"), ("en", "a^{e n}_{B}")])
def test_letters_are_those_of_bertyaev_and_results_in_centimetres(language: str, normal: str) -> None:
    solution = solve("bertyaev-six-bar", lang=language, only="acceleration,forces")
    words, scale = solution.words, Scale("mu_a", 0.0004, "m/s^2")

    once = SHOWN.scale(scale)

    names = ("V_B_e", "a_B_en", "a_B_k", "l_O1B")
    assert [words.symbol(name) for name in names] == ["v^{e}_{B}", normal, "a^{c}_{B}", "O_{1}B"]
    assert (once.mu, once.unit, once.paper) == (0.4, "cm/s^2", "cm")
    assert SHOWN.scale(once) == once
    assert math.isclose(once.measured(2.5) / 100, scale.measured(25.0))
    assert "m/s²" in solution.table("en")  # forces are shown in metres all the same
