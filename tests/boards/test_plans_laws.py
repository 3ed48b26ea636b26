"""Laws of mechanics over random slider-cranks in one array: rigid links, similarity, equilibrium, power, scaling."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from kulman.tests.support.jacobian_solver import cross, dot
from kulman.tests.support.mechanisms import (
    GENERAL_LENGTHS,
    SEED,
    Solved,
    general_slider_crank,
    random_slider_cranks,
    solved,
)

RELATIVE = 1e-11
LOADS = {
    1: (("F_i1", "A"), ("F_1", "A")),
    2: (("F_i2", "S2"), ("F_C", "C"), ("F_B", "B")),
    3: (("F_i3", "B"), ("F_3", "B")),
}
REACTIONS = {1: (("R_01", "O"), ("R_21", "A")), 2: (("R_12", "A"), ("R_32", "B")), 3: (("R_23", "B"), ("R_03", "B"))}
# in the laws of a scaled mechanism lengths, loads and moments of inertia grow by k, k and k^2
POWERS = {"omega": 0, "epsilon": 0, "e": 0, "n": 0, "u": 0, "delta": 0, "M": 2}


def vanish(value: Any, *parts: Any) -> bool:
    """Return whether `value` is zero beside the parts of which it is the remainder."""
    return bool(np.all(np.abs(value) <= RELATIVE * sum(np.abs(part) for part in parts)))


def test_links_keep_their_lengths_and_the_slider_its_guide_and_side(cranks: Solved) -> None:
    crank, rod, places = cranks["A"] - cranks["O"], cranks["B"] - cranks["A"], (cranks["A"], cranks["B"])
    u, from_guide = np.exp(1j * cranks["gamma"]), cranks["B"] - (cranks["x_g"] + 1j * cranks["y_g"])

    assert not cranks.codes.any()
    assert all(np.isfinite(array).all() for array in cranks.results.values())
    assert vanish(cranks["O"] - (cranks["x_O"] + 1j * cranks["y_O"]), cranks["O"])
    assert vanish(crank - cranks["l_OA"] * np.exp(1j * cranks["phi"]), cranks["A"], cranks["O"])
    assert vanish(np.abs(rod) - cranks["l_AB"], rod, *places)
    for point, length in (("S2", "l_AS2"), ("C", "l_AC")):
        assert vanish(cranks[point] - cranks["A"] - rod * cranks[length] / cranks["l_AB"], rod, *places)
    assert vanish(cross(u, from_guide) - cranks["e"], from_guide, cranks["A"])  # the offset is to the left of the guide
    assert np.array_equal(np.sign(dot(u, rod)), cranks["branch_B"])


def test_plans_keep_the_crank_on_its_circle_the_rod_rigid_and_the_slider_on_its_guide(cranks: Solved) -> None:
    crank, rod, u = cranks["A"] - cranks["O"], cranks["B"] - cranks["A"], np.exp(1j * cranks["gamma"])
    omega, size = cranks["n_1"] * cranks["sense_1"], np.abs(cranks["a_A"]) + np.abs(cranks["a_BA_n"])

    assert np.array_equal(cranks["omega_1"], omega)
    assert vanish(cranks["V_A"] - 1j * omega * crank, cranks["V_A"], omega * cranks["A"])
    assert vanish(cranks["a_A"] + omega**2 * crank, cranks["a_A"], omega**2 * cranks["A"])

    assert vanish(dot(cranks["V_BA"], rod), np.abs(cranks["V_A"]) * np.abs(rod))
    assert vanish(cross(u, cranks["V_B"]), cranks["V_A"])
    assert vanish(cranks["V_A"] + cranks["V_BA"] - cranks["V_B"], cranks["V_A"], cranks["V_B"])
    assert vanish(cranks["V_BA"] - 1j * cranks["omega_2"] * rod, cranks["V_A"])

    assert vanish(cranks["a_BA_n"] + cranks["omega_2"] ** 2 * rod, size)
    assert np.all(dot(cranks["a_BA_n"], rod) <= 0)
    assert vanish(dot(cranks["a_BA_t"], rod), size * np.abs(rod))
    assert vanish(cross(u, cranks["a_B"]), size)
    assert vanish(cranks["a_A"] + cranks["a_BA_n"] + cranks["a_BA_t"] - cranks["a_B"], size)
    assert vanish(cranks["a_BA"] - cranks["a_BA_n"] - cranks["a_BA_t"], size)
    assert vanish(cranks["a_BA_t"] - 1j * cranks["epsilon_2"] * rod, size)
    assert vanish(cranks["acceleration.n_BA"] - cranks["a_A"] - cranks["a_BA_n"], size)


def test_points_of_the_rod_form_a_similar_figure_in_the_plan(cranks: Solved) -> None:
    for plan, kind in (("velocity", "V"), ("acceleration", "a")):
        a, b = cranks[f"{plan}.A"], cranks[f"{plan}.B"]
        for point, length in (("S2", "l_AS2"), ("C", "l_AC")):
            assert vanish(cranks[f"{plan}.{point}"] - a - (b - a) * cranks[length] / cranks["l_AB"], a, b)
            assert np.array_equal(cranks[f"{kind}_{point}"], cranks[f"{plan}.{point}"])


def test_forces_of_inertia_oppose_the_accelerations_and_loads_are_as_given(cranks: Solved) -> None:
    for link, centre in ((1, "A"), (2, "S2"), (3, "B")):
        assert vanish(cranks[f"F_i{link}"] + cranks[f"m_{link}"] * cranks[f"a_{centre}"], cranks[f"F_i{link}"])
    assert vanish(cranks["M_i2"] + cranks["J_S2"] * cranks["epsilon_2"], cranks["M_i2"])
    for load, angle in (("F_1", "F1"), ("F_C", "FC"), ("F_B", "FB"), ("F_3", "F3")):
        expected = cranks.values[load] * np.exp(1j * cranks[f"alpha_{angle}"])
        assert vanish(cranks.results[load] - expected, expected)


@pytest.mark.parametrize("link", [1, 2, 3])
def test_forces_of_a_link_close_and_balance_about_a_point_off_the_plan(cranks: Solved, link: int) -> None:
    about = cranks["A"] + cranks["l_AB"] * np.exp(2.6j)  # no construction uses it
    forces = (*REACTIONS[link], *LOADS[link])
    moments = [cross(cranks[at] - about, cranks[name]) for name, at in forces]
    moments += {1: [cranks["M_bal"]], 2: [cranks["M_i2"]], 3: []}[link]

    assert vanish(sum(cranks[name] for name, _ in forces), *(cranks[name] for name, _ in forces))
    assert vanish(sum(moments), *moments)


def test_reactions_are_opposite_normal_to_the_guide_and_resolved_along_and_across_the_rod(cranks: Solved) -> None:
    rod, size = cranks["B"] - cranks["A"], np.abs(cranks["R_12"]) + np.abs(cranks["R_03"])

    assert np.array_equal(cranks["R_12"], -cranks["R_21"])
    assert np.array_equal(cranks["R_23"], -cranks["R_32"])
    assert vanish(dot(np.exp(1j * cranks["gamma"]), cranks["R_03"]), cranks["R_32"], cranks["R_12_n"])
    assert vanish(dot(cranks["R_12_t"], rod), size * np.abs(rod))
    assert vanish(cross(cranks["R_12_n"], rod), size * np.abs(rod))
    assert vanish(cranks["R_12_n"] + cranks["R_12_t"] - cranks["R_12"], size)


def test_lever_gives_the_balancing_moment_of_the_force_plan_and_no_power_is_left(cranks: Solved) -> None:
    powers = [dot(cranks[name], cranks[f"V_{at}"]) for forces in LOADS.values() for name, at in forces]
    powers.append(cranks["M_i2"] * cranks["omega_2"])
    size = sum(np.abs(power) for power in powers) / cranks["n_1"]
    drive = cranks["M_bal"] * cranks["omega_1"]
    crank, force = cranks["A"] - cranks["O"], cranks["_F_bal"]
    moments = np.abs(force) * (np.abs(cranks["A"]) + np.abs(cranks["O"]))

    assert vanish(sum(powers) + drive, *powers, drive)
    assert vanish(cranks["M_bal"] - cranks["M_bal_lever"], size)
    assert vanish(cranks["M_bal_lever"] - cranks["F_bal"] * cranks["l_OA"], size)
    difference = (cranks["M_bal_lever"] - cranks["M_bal"]) / cranks["M_bal_lever"] * 100
    assert np.allclose(cranks["delta_M_bal"], difference, rtol=1e-9, atol=0)
    assert vanish(dot(crank, force), moments)  # the force stands on the crank pin across the crank
    assert vanish(cross(crank, force) - cranks["M_bal_lever"], moments)
    for point in ("A", "B", "C", "S2"):  # the plan is turned by a right angle
        assert np.array_equal(cranks[f"lever.{point}"], 1j * cranks[f"V_{point}"])


@pytest.mark.parametrize(
    ("plan", "order"),
    [
        ("forces_23", ("R_12_t", "F_i3", "F_3", "F_i2", "F_C", "F_B", "R_03")),
        ("forces_2", ("R_12", "F_i2", "F_C", "F_B")),
        ("forces_1", ("R_21", "F_i1", "F_1")),
    ],
)
def test_force_plan_hangs_tip_to_tail_from_its_pole(cranks: Solved, plan: str, order: tuple[str, ...]) -> None:
    forces = [cranks[name] for name in order]

    for number in range(len(order) + 1):
        assert vanish(cranks[f"{plan}.{number}"] - sum(forces[:number]), *forces)


@pytest.mark.parametrize(
    ("arm", "force", "at", "about"),
    [
        pytest.param("h_2", "F_i2", "S2", "B", id="inertia force of the rod"),
        pytest.param("h_F_C", "F_C", "C", "B", id="load on the rod"),
        pytest.param("h_21", "R_21", "A", "O", id="reaction on the crank"),
        pytest.param("h_F_1", "F_1", "A", "O", id="load on the crank"),
        pytest.param("h_lever_F_i2", "F_i2", "lever.S2", "lever.p", id="inertia force on the lever"),
        pytest.param("h_lever_F_3", "F_3", "lever.B", "lever.p", id="load on the lever"),
        pytest.param("h_lever_M_i2_B", "F_i2_couple_B", "lever.B", "lever.p", id="couple at B on the lever"),
        pytest.param("h_lever_M_i2_A", "F_i2_couple_A", "lever.A", "lever.p", id="couple at A on the lever"),
    ],
)
def test_arm_is_the_distance_of_the_line_of_action(cranks: Solved, arm: str, force: str, at: str, about: str) -> None:
    direction = cranks[force] / np.abs(cranks[force])
    foot = cranks[at] - cranks[about]

    assert vanish(cranks[arm] - np.abs(cross(direction, foot)), foot, cranks["A"] if "lever" not in arm else foot)


@pytest.mark.parametrize("k", [1e-7, 1e7, 2.0**-23, 2.0**23], ids=["0.1 um for a metre", "10,000 km", "2^-23", "2^23"])
def test_scaled_mechanism_moves_alike_and_by_a_power_of_two_to_the_last_bit(k: float) -> None:
    values = random_slider_cranks(SEED, 500)
    grown = {name: values[name] * k for name in (*GENERAL_LENGTHS, "F_1", "F_C", "F_B", "F_3")}
    grown["J_S2"] = values["J_S2"] * k * k  # masses and times stay

    small, large = (solved(general_slider_crank(), each) for each in (values, {**values, **grown}))

    assert np.array_equal(small.codes, large.codes)
    for name in (name for name in small.program.names if not name.startswith("_") and name != "delta_M_bal"):
        factor = k ** POWERS.get(name.partition("_")[0], 1)
        allowed = 0.0 if k.hex().startswith("0x1.0000000000000p") else 1e-10 * size(small, name) * factor
        assert np.all(np.abs(large[name] - small[name] * factor) <= allowed), name


def size(mechanisms: Solved, name: str) -> Any:
    """Return what a quantity is a remainder of."""
    kind = name.partition("_")[0]
    if kind in ("M", "F", "R") or name.startswith("forces"):
        forces = ("R_12_n", "R_12_t", "R_03", "F_i2", "F_i3", "F_3", "F_C", "F_B")
        return sum(np.abs(mechanisms[force]) for force in forces) * (mechanisms["l_AB"] if kind == "M" else 1.0)
    if kind == "h" and not name.startswith("h_lever"):
        return np.abs(mechanisms["A"]) + np.abs(mechanisms["B"]) + np.abs(mechanisms["C"])
    return np.abs(mechanisms["a_A"]) + np.abs(mechanisms["a_BA_n"]) + np.abs(mechanisms[name])


def test_speed_turned_round_turns_velocities_and_leaves_accelerations() -> None:
    values = random_slider_cranks(SEED, 500)

    forth, back = (
        solved(general_slider_crank(), {**values, "sense_1": sign * values["sense_1"]}) for sign in (1.0, -1.0)
    )

    for name in ("V_A", "V_B", "V_BA", "V_S2", "omega_1", "omega_2"):
        assert np.array_equal(back[name], -forth[name])
    for name in ("a_A", "a_B", "a_BA_n", "a_BA_t", "epsilon_2", "F_i2", "M_i2", "R_12", "R_03", "M_bal"):
        assert np.array_equal(back[name], forth[name])
