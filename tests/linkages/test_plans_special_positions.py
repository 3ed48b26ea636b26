"""Positions at and near the multiples of 90 degrees, singular ones, and ones that cannot be assembled."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from kulman.plans.board import Program
from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.exact import STATUSES, ExactBoard, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import board_givens
from kulman.tests.linkages.test_plans_second_solver import differing, quantities
from kulman.tests.support.mechanisms import (
    NAU_VARIANTS,
    SIDES,
    general_slider_crank,
    nau_slider_crank,
    nau_values,
    one_of,
    random_slider_cranks,
    solved,
)
from kulman.tests.support.second_solver import SecondSolver

NAU = nau_slider_crank()
_, PROGRAM = construct(NAU)
IN_LINE = (
    "V_B",
    "a_BA_t",
    "epsilon_2",
    "M_i2",
    "h_2",
    "R_12_t",
    "R_03",
    "h_03",
    "h_21",
    "M_bal",
    "M_bal_lever",
    "F_bal",
)
UPRIGHT = ("V_BA", "omega_2", "a_BA_n")


def dependent(program: Program, failed: str) -> set[str]:
    """Return `failed` and all names that hang on it."""
    found = {failed}
    for step in program:
        if found & set(step.operands):
            found.add(step.name)
    return found


def undefined(program: Program, values: Any) -> set[str]:
    return {name for name in program.names if np.isnan(values[name])}


def turned(variant: str, side: str, degrees: float, gamma: float) -> dict[str, float]:
    """Values of a variant with its guide at the angle `gamma` and the crank at `degrees` from it."""
    values = nau_values(variant, side, phi=math.radians(degrees + gamma))
    zeros = dict.fromkeys(
        ("x_O", "y_O", "x_g", "y_g", "e", "m_1", "F_1", "F_C", "F_B", "alpha_F1", "alpha_FC", "alpha_FB"), 0.0
    )
    angles = {"gamma": math.radians(gamma), "alpha_F3": math.radians(gamma + (180 if side == "right" else 0))}
    return {**values, **zeros, **angles, "l_AC": 0.1}


@pytest.mark.parametrize("gamma", [0, 90, 180, 270, -90])
@pytest.mark.parametrize("degrees", [0, 90, 180, 270, 360, -90, 450])
@pytest.mark.parametrize("side", SIDES)
def test_what_geometry_says_is_zero_is_exactly_zero(side: str, degrees: float, gamma: float) -> None:
    mechanism = general_slider_crank()
    _, program = construct(mechanism)

    for variant in NAU_VARIANTS:
        board = run(program, board_givens(mechanism, turned(variant, side, degrees, gamma)))

        zeros = UPRIGHT if degrees % 180 else IN_LINE
        assert {name: board.values[name] for name in zeros if abs(board.values[name]) > 0} == {}
        assert undefined(program, board.values) == set()
        assert board.status == "ok"


@pytest.mark.parametrize("degrees", [0, 90])
def test_what_geometry_says_is_zero_is_exactly_zero_for_any_lengths(degrees: float) -> None:
    random = np.random.default_rng(90)
    l_OA = 10 ** random.uniform(-2, 0, 500)
    values: dict[str, Any] = {
        name: np.full(500, value) for name, value in nau_values(phi=math.radians(degrees)).items()
    }
    values |= {"l_OA": l_OA, "l_AB": l_OA * random.uniform(1.1, 5, 500), "l_AS2": l_OA * random.uniform(0.1, 1, 500)}

    mechanisms = solved(NAU, values)

    for name in UPRIGHT if degrees else ("V_B", "R_03", "epsilon_2", "M_bal_lever", "h_03"):
        assert not mechanisms[name].any(), name


@pytest.mark.parametrize("offset", [sign * 10.0**-power for power in (3, 6, 9, 12) for sign in (1, -1)])
@pytest.mark.parametrize("degrees", [0, 90, 180, 270])
def test_positions_near_a_right_angle_agree_with_the_second_solver(degrees: float, offset: float) -> None:
    for side in SIDES:
        values = nau_values("example", side, phi=math.radians(degrees) + offset)

        board = run(PROGRAM, board_givens(NAU, values))

        second = SecondSolver(NAU, values)
        names = [name for name in quantities(PROGRAM) if name != "delta_M_bal"]  # of two moments that nearly vanish
        assert board.status == "ok"
        assert differing(board, second, names, 1e-11) == {}
        assert abs(board.values["V_BA" if degrees % 180 else "V_B"]) > 0


@pytest.mark.parametrize("degrees", [0, 90, 180, 270])
def test_crank_that_is_off_by_a_rounding_error_stands_at_the_right_angle(degrees: float) -> None:
    exact = math.radians(degrees)

    boards = [run(PROGRAM, board_givens(NAU, nau_values(phi=phi))) for phi in (exact, math.nextafter(exact, 9))]

    assert boards[0].values["e_OA"] == boards[1].values["e_OA"] == 1j ** (degrees // 90)


@pytest.mark.parametrize("degrees", [60, -60])
@pytest.mark.parametrize("side", SIDES)
def test_rod_too_short_for_the_guide_cannot_be_assembled(side: str, degrees: float) -> None:
    values = nau_values(side=side, phi=math.radians(degrees), l_AB=0.04)

    board = run(PROGRAM, board_givens(NAU, values))

    assert board.trouble is not None
    assert board.status == board.trouble.status == "no-assembly"
    assert board.trouble.name == "B"
    assert board.trouble.gap == pytest.approx(0.05 * math.sin(math.radians(60)) - 0.04, rel=1e-13)
    assert undefined(PROGRAM, board.values) == dependent(PROGRAM, "B")


@pytest.mark.parametrize("name", ["O", "A", "e_OA", "V_A", "velocity.A", "a_A", "omega_1", "F_3", "u_30", "lever.A"])
def test_what_does_not_hang_on_the_rod_stays_defined_without_assembly(name: str) -> None:
    values = nau_values(l_AB=0.04)

    board = run(PROGRAM, board_givens(NAU, values))

    assert board.values[name] == run(PROGRAM, board_givens(NAU, nau_values())).values[name]


@pytest.mark.parametrize(("degrees", "gamma"), [(90, 0), (270, 0), (0, 90), (180, 90)])
def test_rod_normal_to_the_guide_is_singular(degrees: float, gamma: float) -> None:
    mechanism = general_slider_crank()
    _, program = construct(mechanism)
    values = {**turned("example", "left", 0, gamma), "phi": math.radians(degrees), "l_AB": 0.05}

    board = run(program, board_givens(mechanism, values))

    assert board.trouble is not None
    assert (board.status, board.trouble.name) == ("singular", "velocity.B")
    assert abs(board.trouble.sine) < 1e-13
    assert undefined(program, board.values) == dependent(program, "velocity.B")
    assert {"B", "S2", "e_AB", "V_A", "a_A"}.isdisjoint(undefined(program, board.values))


def test_rod_as_long_as_the_crank_is_singular_upright_and_fine_elsewhere() -> None:
    values = nau_values(side="right", l_AB=0.05, phi=math.radians(20))

    statuses = {
        degrees: run(PROGRAM, board_givens(NAU, {**values, "phi": math.radians(degrees)})).status
        for degrees in (0, 20, 89, 90, 91, 180, 270, 359)
    }

    expected = dict.fromkeys((0, 20, 89, 91, 180, 359), "ok")
    assert statuses == {**expected, 90: "singular", 270: "singular"}


def test_rod_as_long_as_the_crank_agrees_with_the_second_solver() -> None:
    values = nau_values(side="right", l_AB=0.05, phi=math.radians(20))

    board = run(PROGRAM, board_givens(NAU, values))

    names = [name for name in quantities(PROGRAM) if "lever_M_i2" not in name]  # arms of a couple that vanishes
    assert differing(board, SecondSolver(NAU, values), names, 1e-11) == {}


def test_rod_nearly_normal_to_the_guide_is_ill_conditioned() -> None:
    values = nau_values(phi=math.radians(90), l_AB=0.05 * (1 + 1e-8))

    board = run(PROGRAM, board_givens(NAU, values))

    sine = math.sqrt(1 - (1 + 1e-8) ** -2)
    assert board.status == "ill-conditioned"
    assert min(board.sines.values()) == pytest.approx(sine, rel=1e-6)
    assert undefined(PROGRAM, board.values) == set()


THRESHOLDS = {1e-3: "ok", 0.6e-6: "ok", 0.4e-6: "ill-conditioned", 1e-7: "ill-conditioned", 1e-14: "ill-conditioned"}
THRESHOLDS |= {0.0: "singular", -1e-14: "no-assembly"}


@pytest.mark.parametrize(("part", "status"), THRESHOLDS.items())
def test_status_turns_where_its_threshold_says(part: float, status: str) -> None:
    values = nau_values(phi=math.radians(90), l_AB=0.05 * (1 + part))

    board = run(PROGRAM, board_givens(NAU, values))
    mechanisms = solved(NAU, {name: np.full(1, value) for name, value in values.items()})

    assert board.status == STATUSES[mechanisms.codes[0]] == status


@pytest.mark.parametrize(
    ("moment", "force", "arm"),
    [
        pytest.param(-6.0, 3j, 2.0, id="a force off the point"),
        pytest.param(0.0, 3j, 0.0, id="a force through the point"),
        pytest.param(0.0, 0j, 0.0, id="nothing"),
        pytest.param(6.0, 0j, math.nan, id="a couple, which has no arm"),
    ],
)
def test_arm_is_that_of_one_force(moment: float, force: complex, arm: float) -> None:
    one, many = ExactBoard({"M": moment, "F": force}), ArrayBoard({"M": np.array([moment]), "F": np.array([force])}, 1)

    one.step("arm", "h", "M", "F")
    with np.errstate(invalid="ignore", divide="ignore"):
        many.step("arm", "h", "M", "F")

    assert [one.values["h"], many.values["h"][0]] == pytest.approx([arm, arm], rel=1e-15, nan_ok=True)


def mixed() -> dict[str, Any]:
    """Four statuses in one array: l_AB from too short over just touching to long, at several crank angles."""
    l_AB = np.array([0.03, 0.0499, 0.05, 0.05 * (1 + 1e-12), 0.05 * (1 + 1e-8), 0.051, 0.06, 0.2])
    degrees = np.array([0.0, 45.0, 90.0, 180.0, 270.0, 300.0])
    l_AB, phi = (grid.ravel() for grid in np.meshgrid(l_AB, np.radians(degrees)))
    return {**{name: np.full(phi.shape, value) for name, value in nau_values().items()}, "l_AB": l_AB, "phi": phi}


def test_batch_gives_the_status_of_each_position() -> None:
    values = mixed()

    mechanisms = solved(NAU, values)

    boards = [run(PROGRAM, board_givens(NAU, one_of(values, i))) for i in range(len(mechanisms.codes))]
    assert [STATUSES[code] for code in mechanisms.codes] == [board.status for board in boards]
    assert {board.status for board in boards} == set(STATUSES)


def test_batch_is_undefined_only_where_a_position_fails() -> None:
    values = mixed()

    mechanisms = solved(NAU, values)

    for i, code in enumerate(mechanisms.codes):
        board = run(PROGRAM, board_givens(NAU, one_of(values, i)))
        in_batch = {name: mechanisms[name][i] for name in PROGRAM.names}
        assert undefined(PROGRAM, in_batch) == undefined(PROGRAM, board.values)
        assert bool(undefined(PROGRAM, in_batch)) == (STATUSES[code] in ("singular", "no-assembly"))
        assert all(board.values[name] == in_batch[name] for name in set(PROGRAM.names) - undefined(PROGRAM, in_batch))


def test_statuses_agree_within_ulps_of_every_threshold() -> None:
    mechanism, thresholds = general_slider_crank(), (1.0, math.sqrt(1 - 1e-6))
    _, program = construct(mechanism)
    for index in range(6):
        one = one_of(random_slider_cranks(12, 6), index)
        board = run(program, board_givens(mechanism, one))
        distance = abs((board.values["u_30"].conjugate() * (board.values["A"] - board.values["_u_30_origin_B"])).imag)
        steps = np.arange(-30, 31) * 2.0**-53
        l_AB = np.concatenate([distance / threshold * (1 + steps) for threshold in thresholds])
        values = {**{name: np.full(l_AB.shape, value) for name, value in one.items()}, "l_AB": l_AB}

        mechanisms = solved(mechanism, values)

        statuses = [run(program, board_givens(mechanism, one_of(values, i))).status for i in range(len(l_AB))]
        assert statuses == [STATUSES[code] for code in mechanisms.codes]
        assert len(set(statuses)) >= 3


def test_load_of_zero_has_no_arm_but_everything_else() -> None:
    values = nau_values(F_3=0.0, m_3=0.0)

    board = run(PROGRAM, board_givens(NAU, values))

    assert board.status == "ok"
    assert undefined(PROGRAM, board.values) == set()
    assert board.values["F_3"] == board.values["F_i3"] == 0


def test_massless_mechanism_without_load_needs_no_balancing() -> None:
    values = nau_values(F_3=0.0, m_2=0.0, m_3=0.0, J_S2=0.0)

    board = run(PROGRAM, board_givens(NAU, values))

    assert undefined(PROGRAM, board.values) == set()
    assert board.values["M_bal"] == board.values["M_bal_lever"] == board.values["delta_M_bal"] == 0
