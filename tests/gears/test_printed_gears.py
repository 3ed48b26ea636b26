"""The printed numbers of the project's gear pair beside the exact ones: which are right, which are slips, and of what.

Source: Moscow Automobile and Road Institute, explanatory note to the course project, task 17, 2006, sheet 2. Lengths in
millimetres, angles in degrees, as printed. The note computes with five digits, and cuts some off.
"""

import math

import pytest

from kulman.plans.gears.geometry import POINTS, _angle_of_involute, geometry
from kulman.tests.support.gears import madi

FOUND = geometry(madi())
DEGREES = ("alpha_w", "tau_1", "tau_2", "alpha_a1", "alpha_a2")
NUMBERS = ("x_sum", "inv_alpha_w", "u", "y", "delta_y", "nu_p1", "nu_p2", "x_min1", "x_min2", "epsilon_alpha")
# by how much a number may be off, a digit of what the note computes with: name, printed
RIGHT = {
    1e-9: {"x_sum": 1.05, "d_1": 75.0, "d_2": 100.0, "d_f1": 64.5, "d_f2": 96.0, "tau_1": 24.0, "tau_2": 18.0},
    6e-7: {"inv_alpha_w": 0.036742012},
    5e-4: {"alpha_w": 26.654, "u": 1.333, "alpha_a1": 34.4825, "alpha_a2": 36.56679},
    4e-4: {
        "a_w": 91.99949,
        "a_w_rolling": 91.99950,
        "a_w_shift": 91.99950,
        "a_w_tip1": 91.99950,
        "a_w_tip2": 91.99950,
        "h": 10.4995,
        "s_a1": 3.79033,
    },
    1e-4: {"y": 0.8999, "delta_y": 0.1501, "rho_p1": 6.41934, "rho_p2": 17.06819, "s_a2": 2.43616},
    1e-3: {"d_a1": 85.499, "d_a2": 116.999},
    1e-5: {
        "d_b2": 93.96926,
        "s_2": 10.94773,
        "nu_p1": 0.18217,
        "nu_p2": 0.36327,
        "p_b": 14.76066,
        "x_min1": 0.12267,
        "x_min2": -0.16978,
    },
}
# the rows of the table as printed; the diagram behind them is drawn with PW = 40 mm
Y_1 = (0, 8, 15, 23, 32, 40, 34, 29, 22, 13, 6, 0)
Y_2 = (70, 64, 39, 53, 46, 40, 47, 54, 64, 75, 84, 93)
DIFFERENCE = (-70, -56, -44, -30, -14, 0, -13, -25, -42, -62, -78, -93)
THETA_12 = (-math.inf, -7, -2.9, -1.3, -0.44, 0, -0.4, -0.86, -1.9, -4.8, -13, -math.inf)
THETA_21 = (1, 0.875, 0.75, 0.57, 0.3, 0, 0.3, 0.46, 0.66, 0.8, 0.93, 1)


def shown(name: str) -> float:
    """Return a quantity in the unit in which the note prints it."""
    value = FOUND[name]
    return math.degrees(value) if name in DEGREES else value if name in NUMBERS else value * 1e3


def test_printed_numbers_are_right() -> None:
    assert sum(map(len, RIGHT.values())) == 33
    for digit, printed in RIGHT.items():
        assert {name: shown(name) for name in printed} == pytest.approx(printed, abs=digit)


def test_printed_rolling_diameters_follow_from_a_rounded_ratio() -> None:
    a_w, u = 91.99949, 1.333
    assert shown("d_w1") == pytest.approx(78.85702, abs=1e-5)  # printed 78.86797
    assert shown("d_w2") == pytest.approx(105.14269, abs=1e-5)  # printed 105.13101
    assert 2.0 * a_w / (u + 1.0) == pytest.approx(78.86797, abs=1e-5)
    assert 2.0 * a_w * u / (u + 1.0) == pytest.approx(105.13101, abs=1e-5)
    assert shown("d_w2") / shown("d_w1") == pytest.approx(20.0 / 15.0, rel=1e-14)


def test_printed_chords_of_the_pitch_are_sines_of_the_whole_angle_halved() -> None:
    for i, printed, tau in ((1, 15.25262, 24.0), (2, 15.45085, 18.0)):
        d = shown(f"d_{i}")
        assert shown(f"P_{i}") == pytest.approx(d * math.sin(math.radians(0.5 * tau)), rel=1e-14)
        assert shown(f"P_{i}") - printed > 0.19
        assert 0.5 * d * math.sin(math.radians(tau)) == pytest.approx(printed, abs=2e-5)
    assert shown("P_1") == pytest.approx(15.59338, abs=1e-5)
    assert shown("P_2") == pytest.approx(15.64345, abs=1e-5)


def test_printed_boundary_curvatures_are_with_the_sine_of_half_the_angle() -> None:
    for i, printed, x in ((1, 1.32853, 0.2), (2, 15.17197, 0.85)):
        below = (2.0 - 1.0 - x) * 5.0 / math.sin(math.radians(20.0))
        d = shown(f"d_{i}")
        assert shown(f"rho_l{i}") == pytest.approx(0.5 * d * math.sin(math.radians(20.0)) - below, rel=1e-13)
        assert d * math.sin(math.radians(10.0)) - below == pytest.approx(printed, abs=2e-4)
    assert shown("rho_l1") == pytest.approx(1.13054, abs=1e-5)
    assert shown("rho_l2") == pytest.approx(14.90815, abs=1e-5)


def test_printed_contact_ratio_contradicts_the_numbers_from_which_it_is_said_to_come() -> None:
    assert shown("epsilon_alpha") == pytest.approx(1.20483, abs=1e-5)  # printed 3.72121
    assert (15 * 0.68683 + 20 * 0.74177 - 35 * 0.50194) / (2 * math.pi) == pytest.approx(1.2048, abs=1e-4)
    assert shown("epsilon_alpha") > 1.2  # so the pair passes, but only just


def test_printed_angle_of_action_and_tangents_agree_where_the_pen_did_not_slip() -> None:
    assert math.tan(FOUND["alpha_a1"]) == pytest.approx(0.68683, abs=2e-5)  # and 0.68983 in the line of rho_p2
    assert math.tan(FOUND["alpha_a2"]) == pytest.approx(0.74177, abs=2e-5)
    assert math.degrees(_angle_of_involute(0.036742012)) == pytest.approx(26.654, abs=1e-5)
    assert pytest.approx(17.06819, abs=1e-3) == 91.99949 * 0.4486 - 35.23838 * 0.68683


def test_printed_table_has_its_rows_exchanged_beyond_the_pole() -> None:
    for k, point in enumerate(POINTS):
        y_1, y_2 = (Y_1[k], Y_2[k]) if k < 6 else (Y_2[k], Y_1[k])
        if k == 2:
            assert y_2 == 39  # a slip of the pen: 15 - 39 is not the printed -44
            y_2 = 59
        assert shown(f"y_1_{point}") == pytest.approx(y_1, abs=1.6)  # drawn
        assert shown(f"y_2_{point}") == pytest.approx(y_2, abs=1.6)
        assert abs(DIFFERENCE[k]) == abs(y_1 - y_2)
    assert [shown(f"y_1_{point}") for point in POINTS] == sorted(shown(f"y_1_{point}") for point in POINTS)


def test_three_printed_lengths_are_slips_of_the_pen() -> None:
    assert shown("a") == pytest.approx(87.5, abs=1e-9)  # printed 85.5, as the result of (15 + 20) * 5 / 2
    assert shown("a_w") - 5.0 * 0.8999 == pytest.approx(87.5, abs=1e-3)  # y is computed with the right one
    assert shown("d_b1") == pytest.approx(70.47695, abs=1e-5)  # printed 70.747675; later on 70.47675 is used
    assert math.degrees(math.acos(70.47675 / 85.499)) == pytest.approx(34.4825, abs=1e-3)
    assert shown("s_1") == pytest.approx(8.581922, abs=1e-6)  # printed 8.584192: digits exchanged


def test_printed_sliding_is_that_of_the_drawn_ordinates_at_the_ends_of_the_active_line_too() -> None:
    for k, point in enumerate(POINTS):
        printed = (THETA_12[k], THETA_21[k]) if k < 6 else (THETA_21[k], THETA_12[k])
        for said, exact in zip(printed, (FOUND[f"theta_12_{point}"], FOUND[f"theta_21_{point}"]), strict=True):
            # as slopes: near N a millimetre of the drawing changes much
            assert exact == said or math.atan(exact) == pytest.approx(math.atan(said), abs=0.06)
            assert math.isfinite(said) == math.isfinite(exact)
    for name, said in (("theta_12_A1", -2.9), ("theta_12_A2", 0.46), ("theta_21_A1", 0.75), ("theta_21_A2", -0.86)):
        assert FOUND[name] == pytest.approx(said, rel=0.06)
    assert FOUND["theta_12_A1"] == pytest.approx(FOUND["theta_12_03"], rel=1e-13)  # the third point and the eighth
    assert FOUND["theta_21_A2"] == pytest.approx(FOUND["theta_21_08"], rel=1e-13)
