"""The bundled four-bar linkage of a student's explanatory note, its printed values beside the computed ones.

Source: Moscow Automobile and Road Institute, Machine parts and theory of mechanisms, explanatory note to the course
project, task 17, 2006, sheet 3. A and D are pivots of the frame, B the crank pin, C the pin of the rocker: AD 510,
AB 120, BC 480, DC 380 mm, n_1 = 900 rpm clockwise, crank at 345 deg, C above AD; masses 1.2, 4.8, 3.8 kg, moments of
inertia 0.111 and 0.055 kg m^2, centres of mass at mid-length, a resisting moment of 380 N m on the rocker.

Printed values were read off drawings; the kinematics agree within two per cent.

Errata of the note. Both moments of the forces of inertia are taken with the wrong sign, against the angular
accelerations of its own plan: 246 N m enters the moments of link 2 against those of P_i2 (they turn the same way), and
69 N m is subtracted from the resisting moment (it adds to it). The lever repeats both, so that the two balancing forces
agree, 4886 and 4723 N, where the right one is 4077 N. With these two signs turned the printed forces follow, which is
tested. Slips of the pen: V_CB is 11.813 m/s in one line and 11.823 m/s in the next; the rocker's angular velocity has
the index 2; the scale of the plan, 2.5 : 1, is that of a reduction.
"""

from __future__ import annotations

import pytest

from kulman.plans.linkages.solved import SolvedLinkage, solve_linkage
from kulman.variants.reader import load_task
from kulman.variants.solution import Solution, solve

TASK = load_task("madi-four-bar")
VALUES = TASK.values()
NAMES = """V_B V_C V_CB V_S1 V_S2 V_S3 a_B a_CB_n a_CB_t a_CB a_C_n a_C_t a_C a_S1 a_S2 a_S3 omega_2 omega_3 epsilon_2
epsilon_3 F_i1 F_i2 F_i3 M_i2 M_i3 M_3 M_sum R_12 R_03 R_32 R_01 R_12_n R_12_t R_03_n R_03_t F_bal F_bal_lever h_2 h_3
h_21 h_lever_F_i1 h_lever_F_i2 h_lever_F_i3 F_i2_couple F_i2_couple_B F_i2_couple_C F_sum_couple F_sum_couple_C
h_lever_M_i2_B h_lever_M_i2_C h_lever_M_sum_C delta_F_bal l_AB l_BC l_DC A B C D S1 S2 S3"""


@pytest.fixture(scope="module")
def example() -> Solution:
    return solve("madi-four-bar")


@pytest.fixture(scope="module")
def with_errata() -> SolvedLinkage:
    """The same with both moments of the forces of inertia turned round."""
    return solve_linkage(TASK.mechanism, {**VALUES, "J_S2": -VALUES["J_S2"], "J_S3": -VALUES["J_S3"]})


RIGHT = {
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


def test_every_quantity_of_the_note_has_its_name(example: Solution) -> None:
    assert [name for name in NAMES.split() if name not in example] == []
    assert example.status == "ok"
    assert example.checks["lever"]["ok"]


@pytest.mark.parametrize(("name", "printed"), RIGHT.items())
def test_printed_value_is_right_within_two_per_cent(example: Solution, name: str, printed: float) -> None:
    assert printed == pytest.approx(abs(example[name].value or 0.0), rel=0.02)


@pytest.mark.parametrize(("name", "printed"), WRONG_SIGNS.items())
def test_printed_force_follows_from_two_wrong_signs(with_errata: SolvedLinkage, name: str, printed: float) -> None:
    assert printed == pytest.approx(abs(with_errata.quantities[name].value or 0.0), rel=0.08)


@pytest.mark.parametrize(
    ("name", "right"),
    [("R_12_t", 1622.2), ("R_03_t", 728.16), ("R_12", 5198.9), ("R_03", 1290.3), ("R_32", 2540.8), ("F_bal", -4077.3)],
)
def test_forces_with_the_right_signs(example: Solution, name: str, right: float) -> None:
    assert example[name].value == pytest.approx(right, rel=1e-4)


def test_signs_of_the_note_are_wrong(example: Solution) -> None:
    values = example.solved.values
    to_S2 = values["S2"] - values["C"]
    moment_of_F_i2 = (to_S2.conjugate() * values["F_i2"]).imag

    assert values["M_i2"] * moment_of_F_i2 > 0
    assert values["M_i3"] * values["M_3"] > 0
    assert values["M_sum"] == values["M_i3"] + values["M_3"]


def test_rocker_is_loaded_against_its_motion(example: Solution) -> None:
    assert example["M_3"].value == -380.0
    assert (example["omega_3"].value or 0.0) > 0.0


def test_balancing_force_stands_across_the_crank_and_drives_it(example: Solution) -> None:
    values = example.solved.values
    force = values["_F_bal"]

    assert abs((force.conjugate() * values["e_AB"]).real) < 1e-9
    assert (force.conjugate() * values["V_B"]).real > 0.0
    assert values["R_01"] + values["R_21"] + values["F_i1"] + force == pytest.approx(0.0, abs=1e-9)
    assert values["F_bal"] == pytest.approx(values["F_bal_lever"], rel=1e-13)


def test_scales_are_those_of_the_note(example: Solution) -> None:
    printed = {"mu_l": 0.0025, "mu_V": 0.189, "mu_a": 21.318, "mu_F_23": 33.154, "mu_F_1": 54.373}

    assert {name: scale.mu for name, scale in example.scales.items()} == printed
    assert example["F_bal"].scale == "mu_F_1"
