"""Hoists whose formulas are not valid: the rope would push, or goes slack. What happens, against small steps."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest

from kulman.plans.hoist.forces import Forces, forces
from kulman.plans.hoist.onesided import one_sided
from kulman.tests.support.hoists import SEED, VARIANTS, random_hoists

PUSHES = {**VARIANTS["V04"], "I_0": 2.7e-6, "a": 0.0}  # a support ten times as soft, no acceleration
PARTS = 3000  # of a swing


def stepped(found: Mapping[str, float], end: float) -> dict[str, float]:
    """Return what small steps of a load on a one-sided support, by a one-sided rope, give (Verlet's rule)."""
    m, g, C_01, C_12, V, a = (found[name] for name in ("m", "g", "C_01", "C_12", "V_t", "a"))
    h = 2.0 * math.pi / found["k"] / PARTS
    rest = m * g / C_01
    t, s, v, t_1, most = 0.0, -rest, 0.0, math.nan, [0.0, 0.0]
    slack, phase, rate = False, 0, 0.0
    while t < end:
        v += 0.5 * h * rate
        before, s, t = s, s + h * v, t + h
        pulled = C_12 * (V * t + 0.5 * a * t * t - s - rest)
        if pulled <= 0.0:
            pulled, slack = 0.0, True
        rate = (pulled - C_01 * s if s < 0.0 else pulled) / m - g
        v += 0.5 * h * rate
        if s >= 0.0 and not phase:
            phase, t_1 = 1, t - h * s / (s - before)
        if pulled > most[phase]:
            most[phase] = pulled
    return {"t_1": t_1, "F_12_max": most[0], "P_12_max": most[1], "slack": float(slack)}


def assert_follows(solved: Forces) -> None:
    motion, found = solved.motion, solved.found
    assert motion is not None
    other = stepped(found, motion.pieces[-1].end)
    assert other["slack"] == 1.0
    assert found["t_1"] == pytest.approx(other["t_1"], rel=1e-4)  # it may leave slowly: then heights are compared
    assert abs(motion.height(other["t_1"])) < 1e-6 * found["P_st"] * (1.0 / found["C_01"] + 1.0 / found["C_12"])
    rate = found["C_12"] * (found["V_t"] + found["a"] * found["t_1"] + found["V_t"])  # for the last step before t_1
    step = 2.0 * math.pi / found["k"] / PARTS
    assert found["F_12_max"] == pytest.approx(other["F_12_max"], rel=1e-5, abs=2.0 * rate * step)
    assert found["P_12_max"] == pytest.approx(other["P_12_max"], rel=1e-5)


def test_rope_that_would_push_is_told_and_the_motion_followed() -> None:
    solved = forces(PUSHES)

    assert not solved.ok["rope_phase_1"]
    assert solved.checks[0].value < 0.0  # what the formula gives
    assert solved.found["F_12_min"] == 0.0  # and what there is
    assert solved.motion is not None
    assert all(piece.begin < piece.end for piece in solved.motion.pieces if not piece.rope)
    assert_follows(solved)


def test_rope_that_goes_slack_after_the_lift_off_leaves_the_maximum_as_it_is() -> None:
    values = {**VARIANTS["V09"], "V_0": 1.0}
    solved = forces(values)

    assert solved.ok["rope_phase_1"]
    assert not solved.ok["rope_phase_2"]
    found = solved.found
    assert found["P_12_max"] == pytest.approx(found["P_m"] + found["R"], rel=1e-12)
    assert found["P_12_min"] == 0.0
    assert_follows(solved)


@pytest.mark.parametrize("count", [pytest.param(40, id="40"), pytest.param(600, id="600", marks=pytest.mark.soak)])
def test_one_sided_motions_of_random_hoists_are_those_of_small_steps(count: int) -> None:
    hoists, seen, followed = random_hoists(np.random.default_rng(SEED), count), 0, 0
    for i in range(count):
        solved = forces({name: float(column[i]) for name, column in hoists.items()})
        if solved.motion is None:
            assert min(solved.found["F_12_min"], solved.found["P_12_min"]) >= 0.0
            continue
        seen += 1
        assert min(solved.found["F_12_min"], solved.found["P_12_min"]) == 0.0
        if followed < count // 10:
            followed += 1
            assert_follows(solved)
    assert seen >= 4


def test_motion_of_a_valid_hoist_is_that_of_the_formulas() -> None:
    for values in VARIANTS.values():
        found = forces(values).found
        motion = one_sided(found)

        (at, most), (_, least) = motion.extremes(lifted=False)
        (top_at, top), (_, bottom) = motion.extremes(lifted=True)

        assert all(piece.rope for piece in motion.pieces)
        assert motion.returns == ()
        pairs = {"t_1": motion.t_1, "F_12_max": most, "t_F12_max": at, "F_12_min": least, "P_12_max": top}
        pairs |= {"P_12_min": bottom, "T_1": top_at - motion.t_1, "s_min": motion.lowest}
        for name, value in pairs.items():
            assert value == pytest.approx(found[name], rel=1e-11), name


def test_no_load_comes_back_to_a_rigid_support() -> None:
    hoists, slack = random_hoists(np.random.default_rng(SEED + 2), 60), 0
    hoists["V_0"] *= 8.0  # so that the rope goes slack
    for i in range(60):
        solved = forces({**{name: float(column[i]) for name, column in hoists.items()}, "I_0": math.inf})
        if solved.motion is not None:
            slack += sum(not piece.rope for piece in solved.motion.pieces)
            assert solved.motion.lowest > 0.0
    assert slack > 10


def test_energy_that_the_winding_gives_is_kept() -> None:
    solved = forces(PUSHES)
    motion, found = solved.motion, solved.found
    assert motion is not None
    m, g, C_01, C_12, V = (found[name] for name in ("m", "g", "C_01", "C_12", "V_t"))

    t = np.linspace(0.0, motion.pieces[-1].end * (1.0 - 1e-12), 40_001)
    force, s = (np.array([read(x) for x in t.tolist()]) for read in (motion.force, motion.height))

    speed = np.gradient(s, t)
    stored = 0.5 * m * speed**2 + m * g * s + 0.5 * C_01 * np.minimum(s, 0.0) ** 2 + 0.5 * force**2 / C_12
    given = np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(t) * V)))
    surplus = (stored - given)[1:-1]
    assert np.max(np.abs(surplus - surplus[0])) < 1e-5 * np.max(stored - stored[0])
