"""A hoist drawn on the board: marks of its plans at their places, what is drawn of it and what is not."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from kulman.plans.hoist.construction import BENT, EXTREMES, FORCES, LIFT_OFF, SCHEME
from kulman.plans.hoist.forces import course
from kulman.plans.hoist.hoist import PLANS, Hoist
from kulman.plans.hoist.model import CIRCLE
from kulman.plans.hoist.solve import SolvedHoist, solve_hoist
from kulman.tests.support.hoists import VARIANTS

MM = 1e-3
PUSHES: dict[str, Any] = {"I_0": 2.7e-6, "a": 0.0}


@pytest.fixture(scope="module", params=["V03", "V04", "V07", "V10"])
def solved(request: pytest.FixtureRequest) -> SolvedHoist:
    return solve_hoist(Hoist(), VARIANTS[request.param])


def place(solved: SolvedHoist, plan: str, mark: str, mus: tuple[str, str]) -> complex:
    """Return abscissa and ordinate of a mark in SI, by the scale factors that are printed, per millimetre."""
    x, y = (solved.quantities[mu].value or math.nan for mu in mus)
    at = solved.point(f"{plan}.{mark}") * (1.0 / MM)
    return complex(at.real * x, at.imag * y)


def test_numbers_of_the_construction_are_those_of_the_forces(solved: SolvedHoist) -> None:
    assert (solved.status, all(check.ok for check in solved.forces.checks[:3])) == ("ok", True)
    for name, value in solved.forces.found.items():
        if name in solved.quantities:
            assert solved.quantities[name].value == value
    units = {name: solved.quantities[name].unit for name in ("mu_F", "mu_y", "mu_v")}
    assert units == {"mu_F": "N/mm", "mu_y": "m/mm", "mu_v": "(m/s)/mm"}


def test_both_forces_are_drawn_to_their_scales(solved: SolvedHoist) -> None:
    found, mus = solved.forces.found, ("mu_t", "mu_F")
    for letter, column, lines in (("S", "F_01", "f"), ("R", "F_12", "f"), ("P", "F_12", "g")):
        sections = solved.layout.resting if lines == "f" else solved.layout.hanging
        drawn = np.array([place(solved, FORCES, f"{letter}{i}", mus) for i in range(sections + 1)])
        inside = drawn[1:-1]  # at the lift-off itself both phases have a say

        other = course(solved.forces, inside.real).columns[column]

        assert np.max(np.abs(inside.imag - other)) < 1e-9 * found["P_st"]
    first, last = place(solved, FORCES, "S0", mus), place(solved, FORCES, f"S{solved.layout.resting}", mus)
    assert first == pytest.approx(complex(0.0, -found["P_st"]))
    assert last == pytest.approx(complex(found["t_1"], 0.0), abs=1e-9 * found["P_st"])
    joint = place(solved, FORCES, f"R{solved.layout.resting}", mus) - place(solved, FORCES, "P0", mus)
    assert abs(joint) < 1e-9 * found["P_st"]  # without a jump


def test_drawn_roots_are_near_the_calculated_ones(solved: SolvedHoist) -> None:
    found, roots = solved.forces.found, solved.layout.roots
    assert roots is not None
    V, a, k, ratio = found["V_t"], found["a"], found["k"], found["C_01"] / found["C_12"]

    lift_off = place(solved, LIFT_OFF, "X", ("mu_t1", "mu_y")).real

    assert lift_off == pytest.approx(solved.quantities["t_1_drawn"].value, rel=1e-12)
    assert abs(lift_off - found["t_1"]) < 0.2 * roots.section
    for n, t in enumerate(roots.times, 1):
        crossing = place(solved, EXTREMES, f"X{n}", ("mu_t1", "mu_v"))

        assert abs(V * math.cos(k * t) + a / k * math.sin(k * t) + ratio * (V + a * t)) < 1e-9 * V
        assert solved.quantities[f"t_2_{n}"].value == t
        assert abs(crossing.real - t) < 0.2 * roots.section
        assert crossing.imag == pytest.approx(-ratio * (V + a * crossing.real), rel=1e-9)
    assert (f"{EXTREMES}.X{len(roots.times) + 1}") not in solved.values


@pytest.mark.parametrize("i", [0, 2])
def test_beams_bend_as_their_moments_say(solved: SolvedHoist, i: int) -> None:
    found, mus = solved.forces.found, ("mu_x", "mu_w")
    plan, l, b = BENT[i], found[f"l_{i}"], found[f"b_{i}"]
    load, EI = found["P_st" if i == 0 else "P_12_max"], found[f"E_{i}"] * found[f"I_{i}"]

    drawn = np.array([place(solved, plan, f"w{n}", mus) for n in range(13)])

    x, h = drawn.real, l / 12.0
    assert np.allclose(x, np.arange(13) * h, rtol=1e-12, atol=1e-12)
    w, moment = -drawn.imag, np.where(x < b, load * (l - b) / l * x, load * b / l * (l - x))
    bend = (w[2:] - 2.0 * w[1:-1] + w[:-2]) / h**2
    mean = (moment[2:] + 4.0 * moment[1:-1] + moment[:-2]) / 6.0  # exact for straight lines
    smooth = (np.abs(x[1:-1] - b) >= h * (1.0 - 1e-9)) & ((x[1:-1] - b) % h >= 0.0)
    assert np.allclose(bend[smooth], -mean[smooth] / EI, rtol=1e-6)
    under = -place(solved, plan, "A", mus).imag
    assert under == pytest.approx(load / found["C_01" if i == 0 else "C_2"], rel=1e-12)
    most = place(solved, plan, "M", mus)
    assert -most.imag == pytest.approx(found[f"w_{i}_max"], rel=1e-12)
    assert most.real == pytest.approx(l - found[f"x_w{i}"], rel=1e-12)
    assert -most.imag >= np.max(w)


def test_scheme_has_the_nearer_ends_where_they_are_said_to_be() -> None:
    values = VARIANTS["V03"]

    solved = solve_hoist(Hoist(near_0="left", near_2="right"), values)

    at = {mark: solved.point(f"{SCHEME}.{mark}") for mark in ("O1", "O2", "A0", "A2", "B1", "B2")}
    assert at["A2"] - at["A0"] == pytest.approx(values["L"] * 1j)
    assert at["A0"] - at["O1"] == pytest.approx(values["beta_0"] * values["l_0"])
    assert at["O2"] - at["O1"] == pytest.approx(values["l_0"])
    assert at["B2"] - at["A2"] == pytest.approx(values["beta_2"] * values["l_2"])
    assert at["B2"] - at["B1"] == pytest.approx(values["l_2"])


def test_what_is_not_there_is_not_drawn() -> None:
    everything = {SCHEME, FORCES, LIFT_OFF, EXTREMES, CIRCLE, *BENT.values()}
    for changes, missing in (
        ({"I_0": math.inf}, {EXTREMES, "beam_0"}),
        ({"I_0": math.inf, "I_2": math.inf}, {EXTREMES, "beam_0", "beam_2"}),
        (PUSHES, {LIFT_OFF, EXTREMES}),
    ):
        solved = solve_hoist(Hoist(), {**VARIANTS["V04"], **changes})

        assert everything - {*solved.program.plans} == missing
        assert {*solved.scale_of_plan} == everything - missing
        assert solved.trouble is None


def test_motion_is_drawn_in_the_place_of_formulas_that_are_not_valid() -> None:
    solved = solve_hoist(Hoist(), {**VARIANTS["V04"], **PUSHES})

    motion = solved.forces.motion
    assert motion is not None
    assert "P_12_max" in solved.quantities
    for i in range(solved.layout.resting + 1):
        at = place(solved, FORCES, f"R{i}", ("mu_t", "mu_F"))
        assert at.imag >= 0.0
        assert at.imag == pytest.approx(motion.force(at.real), abs=1e-6 * motion.C_12)


def test_a_load_that_swings_for_long_is_drawn_at_the_end_only() -> None:
    values = {**VARIANTS["V04"], "V_0": 1e-3, "a": 0.002}

    solved = solve_hoist(Hoist(), values)

    roots, found = solved.layout.roots, solved.forces.found
    assert found["k"] * found["t_1"] > 24.0 * math.pi
    assert roots is not None
    assert roots.begin > 0.5 * found["t_1"]
    assert solved.quantities["t_1_drawn"].value == pytest.approx(found["t_1"], abs=0.2 * roots.section)


def test_every_plan_can_be_had_alone() -> None:
    whole = solve_hoist(Hoist(), VARIANTS["V04"])
    for plan in PLANS:
        solved = solve_hoist(Hoist(), VARIANTS["V04"], (plan,))

        assert len(solved.program.steps) < len(whole.program.steps)
        assert all(quantity.value == whole.quantities[name].value for name, quantity in solved.quantities.items())
