"""A four-bar linkage worked in a student's explanatory note, its printed values beside the computed ones.

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
the index 2. The note balances the crank by a force at B, so that its R_01 is what a couple leaves along the crank.
"""

from __future__ import annotations

import math

import pytest

from kulman.plans.exact import ExactBoard, run
from kulman.plans.linkages.chain import board_givens, construct
from kulman.plans.linkages.mechanism import ZERO, Couple, Driver, Link, Mechanism, Revolute

ORIGIN = (ZERO, ZERO)
FOUR_BAR = Mechanism(
    links=(
        Link(1, {"A": ORIGIN, "B": ("l_AB", ZERO), "S1": ("l_AS1", ZERO)}, "S1", "m_1"),
        Link(2, {"B": ORIGIN, "C": ("l_BC", ZERO), "S2": ("l_BS2", ZERO)}, "S2", "m_2", "J_S2"),
        Link(3, {"D": ORIGIN, "C": ("l_DC", ZERO), "S3": ("l_DS3", ZERO)}, "S3", "m_3", "J_S3"),
    ),
    pairs=(
        Revolute("A", (0, 1), ORIGIN),
        Revolute("B", (1, 2)),
        Revolute("C", (2, 3), None, "branch_C"),
        Revolute("D", (3, 0), ("l_AD", ZERO)),
    ),
    driver=Driver(1, "A", "B", "phi", "n_1", "sense_1"),
    couples=(Couple("M_3", 3, "M_3", "sense_M3"),),
)
VALUES = {
    **{"l_AD": 0.51, "l_AB": 0.12, "l_BC": 0.48, "l_DC": 0.38, "l_AS1": 0.06, "l_BS2": 0.24, "l_DS3": 0.19},
    **{"m_1": 1.2, "m_2": 4.8, "m_3": 3.8, "J_S2": 0.111, "J_S3": 0.055, "M_3": 380.0},
    **{"n_1": 900 * math.pi / 30, "sense_1": -1.0, "phi": math.radians(345), "branch_C": 1.0, "sense_M3": -1.0},
}


@pytest.fixture(scope="module")
def example() -> ExactBoard:
    _, program = construct(FOUR_BAR)
    return run(program, board_givens(FOUR_BAR, VALUES))


@pytest.fixture(scope="module")
def with_errata() -> ExactBoard:
    """The same with both moments of the forces of inertia turned round."""
    _, program = construct(FOUR_BAR)
    return run(program, board_givens(FOUR_BAR, {**VALUES, "J_S2": -VALUES["J_S2"], "J_S3": -VALUES["J_S3"]}))


RIGHT = {
    **{"omega_1": 94.248, "V_B": 11.310, "V_C": 13.230, "V_CB": 11.813, "omega_2": 24.610, "omega_3": 34.816},
    **{"a_CB_n": 290.713, "a_C_n": 460.618, "a_CB_t": 1065.9, "a_C_t": 479.655, "a_CB": 1114.931, "a_C": 660.858},
    **{"a_S1": 532.95, "a_S2": 690.7, "a_S3": 333.56, "epsilon_2": 2220.625, "epsilon_3": 1262.25},
    **{"F_i1": 639.54, "F_i2": 3315.38, "F_i3": 1263.73, "M_i2": 246.489, "M_i3": 69.424},
    **{"h_2": 160e-3, "h_3": 137.5e-3, "F_i2_couple": 513.519},
    **{"h_lever_F_i2": 49 * 0.189, "h_lever_F_i3": 25 * 0.189, "h_lever_M_i2_C": 42 * 0.189},
    **{"h_lever_M_i2_B": 20.5 * 0.189, "h_lever_M_3_C": 70 * 0.189},
}
WRONG_SIGNS = {
    **{"R_12_t": 591.608, "R_03_t": 360.035, "R_12_n": 5387.525, "R_03_n": 2254.472, "R_12": 5404.102},
    **{"R_03": 2287.626, "R_32": 3381.708, "h_21": 108.5e-3, "M_bal": 4886.209 * 0.12, "M_bal_lever": 4722.55 * 0.12},
}


@pytest.mark.parametrize(("name", "printed"), RIGHT.items())
def test_printed_value_is_right_within_two_per_cent(example: ExactBoard, name: str, printed: float) -> None:
    assert printed == pytest.approx(abs(example.values[name]), rel=0.02)


@pytest.mark.parametrize(("name", "printed"), WRONG_SIGNS.items())
def test_printed_force_follows_from_two_wrong_signs(with_errata: ExactBoard, name: str, printed: float) -> None:
    assert printed == pytest.approx(abs(with_errata.values[name]), rel=0.08)


@pytest.mark.parametrize(
    ("name", "right"),
    [("R_12_t", 1622.2), ("R_03_t", 728.16), ("R_12", 5198.9), ("R_03", 1290.3), ("R_32", 2540.8), ("F_bal", 4077.3)],
)
def test_forces_with_the_right_signs(example: ExactBoard, name: str, right: float) -> None:
    assert abs(example.values[name]) == pytest.approx(right, rel=1e-4)


def test_signs_of_the_note_are_wrong(example: ExactBoard) -> None:
    values = example.values
    to_S2 = values["S2"] - values["C"]
    moment_of_F_i2 = (to_S2.conjugate() * values["F_i2"]).imag

    assert values["M_i2"] * moment_of_F_i2 > 0
    assert values["M_i3"] * values["M_3"] > 0


def test_pivot_of_a_crank_balanced_by_a_force_bears_what_is_along_the_crank(with_errata: ExactBoard) -> None:
    values = with_errata.values

    along = (values["R_01"].conjugate() * values["e_AB"]).real

    assert abs(along) == pytest.approx(2914.393, rel=0.05)


def test_balancing_moment_drives_against_the_resistance(example: ExactBoard) -> None:
    assert example.values["M_bal"] * example.values["omega_1"] > 0
    assert example.values["M_bal"] == pytest.approx(example.values["M_bal_lever"], rel=1e-13)
    assert example.status == "ok"
