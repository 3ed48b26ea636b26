"""Limits of a hoist: rigid beams, a rope without mass, no acceleration, no speed, slack; reached without a jump."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman import solve
from kulman.plans.hoist.forces import choose, forces
from kulman.plans.hoist.hoist import VALUES, Hoist
from kulman.plans.hoist.model import model
from kulman.plans.hoist.onesided import MOST, Curve
from kulman.plans.hoist.solve import solve_hoist
from kulman.plans.lab.ropes import TremblingError, rope_of
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.hoists import SEED, VARIANTS, random_hoists

FORCES = ("t_1", "F_12_t1", "F_12_max", "T_1", "P_12_max", "P_12_min", "s_min")


@pytest.mark.parametrize(
    ("name", "limit", "steps"),
    [
        ("I_0", math.inf, (1.0, 1e4, 1e8)),  # a rigid support
        ("I_2", math.inf, (1.0, 1e4, 1e8)),
        ("G_2", 0.0, (1e2, 1e-2, 1e-6)),
        ("a", 0.0, (1e-1, 1e-4, 1e-7)),
        ("V_0", 0.0, (1e-2, 1e-5, 1e-8)),
        ("slack", 0.0, (1e-2, 1e-5, 1e-8)),
    ],
)
def test_limits_are_approached_without_a_jump(name: str, limit: float, steps: tuple[float, ...]) -> None:
    there, *near = (forces({**VARIANTS["V03"], name: value}).found for value in (limit, *steps))

    changes = [max(abs(one[force] - there[force]) / abs(there[force]) for force in FORCES) for one in near]

    assert changes[0] > changes[1] > changes[2] > 0.0
    assert changes[2] < 1e-3 * changes[0]


def test_on_a_rigid_support_the_rope_alone_stretches() -> None:
    values = {**VARIANTS["V05"], "I_0": math.inf}

    found = forces(values).found

    assert math.isinf(found["C_01"])
    assert math.isinf(found["k"])
    t = found["t_1"]
    wound = values["V_0"] * t + 0.5 * values["a"] * t * t
    assert found["C_12"] * wound == pytest.approx(found["P_st"], rel=1e-13)
    assert found["F_12_max"] == found["F_12_t1"] == pytest.approx(found["P_st"], rel=1e-13)
    assert found["w_0_max"] == 0.0
    rate = found["C_12"] * (values["V_0"] + values["a"] * t) / found["k_1"]
    swing = math.hypot(found["m"] * values["a"], rate)
    assert found["P_12_max"] == pytest.approx(found["P_m"] + swing, rel=1e-13)


def test_load_that_stands_when_it_is_lifted_off_does_not_come_back() -> None:
    hoists = random_hoists(np.random.default_rng(SEED), 200)
    hoists["I_0"][:] = math.inf  # the load leaves a rigid support without a speed

    found = model(hoists)

    assert np.all(found["s_min"] > 1e-3 * found["P_st"] / found["C_12"])


def test_on_rigid_beams_the_article_is_right_when_its_speed_is_that_at_the_lift_off() -> None:
    values = {**VARIANTS["V03"], "I_0": math.inf, "I_2": math.inf}
    found = forces(values).found

    lifted = forces({**values, "V_0": values["V_0"] + values["a"] * found["t_1"]}).found

    assert found["C_12"] == found["C_k"]
    assert lifted["P_12_max_printed"] == pytest.approx(found["P_12_max"], rel=1e-13)
    assert lifted["T_1_printed"] == pytest.approx(found["T_1"], rel=1e-13)


def test_printed_force_has_its_greatest_value_where_its_curve_has() -> None:
    for values in VARIANTS.values():
        found = forces(values).found
        m, a, V, C_12, k_1 = found["m"], values["a"], values["V_0"], found["C_12"], found["k_1"]
        T = np.linspace(0.0, 2.0 * math.pi / k_1, 100_001)

        P = m * 9.81 + m * a * (1.0 - np.cos(k_1 * T)) + V * math.sqrt(m * C_12) * np.sin(k_1 * T)

        assert found["P_12_max_printed"] == pytest.approx(float(np.max(P)), rel=1e-9)
        assert found["T_1_printed"] == pytest.approx(float(T[np.argmax(P)]), abs=2e-5 / k_1 * 10.0)
        assert 0.5 * math.pi <= found["T_1_printed"] * k_1 <= math.pi


def test_slack_is_taken_up_before_the_rope_is_taut() -> None:
    values = {**VARIANTS["V03"], "slack": 0.05}
    found = forces(values).found

    speed = math.sqrt(0.13**2 + 2.0 * 0.10 * 0.05)

    same = forces({**values, "slack": 0.0, "V_0": speed}).found
    for name in FORCES:
        assert found[name] == pytest.approx(same[name], rel=1e-12)
    printed = math.sqrt(2.0 * 0.10 * (0.05 + found["P_st"] / found["C_12"]))  # the speed that the article takes
    mean, swing = found["P_m"], math.hypot(found["m"] * 0.10, printed * math.sqrt(found["m"] * found["C_12"]))
    assert found["P_12_max_printed"] == pytest.approx(mean + swing, rel=1e-13)


def test_rope_pulled_from_rest_lifts_off_after_the_exact_time() -> None:
    found = forces({**VARIANTS["V06"], "V_0": 0.0}).found

    t, k = found["t_1"], found["k"]
    assert 0.40 * (0.5 * t * t - (1.0 - math.cos(k * t)) / k**2) == pytest.approx(found["P_st"] / found["C"], rel=1e-12)


ENDLESS = {  # givens within their bounds whose motion nobody follows, and what is said of them
    ("V04", "E_0", 0.8): "hoist-pieces",  # a support so weak that the rope trembles on it for years
    ("V04", "l_0", 1e4): "hoist-pieces",
    ("V01", "l_0", 3e-12): "hoist-stiff",
}


@pytest.mark.parametrize(("variant", "name", "value"), ENDLESS)
def test_a_motion_that_nobody_follows_is_refused_in_a_line(variant: str, name: str, value: float) -> None:
    with pytest.raises(InputError) as told:
        solve("karpenko-hoist", variant, set={name: f"{value} {VALUES[name]}"})

    assert told.value.key == ENDLESS[variant, name, value]
    assert all("\n" not in told.value.text(language) for language in LANGUAGES)


def test_many_swings_before_the_lift_off_are_no_trouble_where_the_formulas_are_valid() -> None:
    slow = {**VARIANTS["V10"], "V_0": 1e-7, "a": 0.0}
    found = forces(slow).found

    assert found["k"] * found["t_1"] > 1e6
    assert len([*solve_hoist(Hoist(), slow).program]) < 10_000  # the last swings are drawn, not a million
    with pytest.raises(InputError, match=r"more than \d+ times"):
        choose({**VARIANTS["V04"], "l_0": 300.0})
    with pytest.raises(TremblingError):
        rope_of(model({**VARIANTS["V06"], "G_2": 0.03}), 32)


def test_a_curve_falls_through_zero_where_small_steps_say_so() -> None:
    random, fallen = np.random.default_rng(SEED + 40), 0

    for _ in range(120):
        p_1, p_2 = random.normal(0.0, 10.0 ** random.uniform(-4.0, 0.5, 2))
        A, B, w = (*random.normal(0.0, 1.0, 2), random.uniform(1.0, 40.0))
        p_0 = random.choice((-A + 10.0 ** random.uniform(-6.0, 0.0), random.uniform(1.0, 3.0) * math.hypot(A, B)))
        curve = Curve(p_0, p_1, p_2, A, B, w)
        if not curve.at(0.0) > 0.0:
            continue
        t = np.linspace(0.0, end := random.uniform(1.0, 40.0), 20_001)
        ordinates = p_0 + (p_1 + p_2 * t) * t + A * np.cos(w * t) + B * np.sin(w * t)
        below = np.flatnonzero(ordinates < 0.0)

        found = curve.falls_through(end, 1e-12)

        if not below.size:
            assert found is None or abs(curve.jet(found)[1]) < 0.05 * w  # a dip between two steps
        else:
            fallen += 1
            assert found is not None
            assert found <= t[below[0]]
            assert found > t[below[0] - 1] or curve.at(0.5 * (found + t[below[0] - 1])) > -1e-4
            assert curve.at(found) == pytest.approx(0.0, abs=1e-9)
    assert fallen > 30


@pytest.mark.parametrize("count", [pytest.param(12, id="12"), pytest.param(300, id="300", marks=pytest.mark.soak)])
def test_any_givens_within_their_bounds_are_answered(count: int) -> None:
    random = np.random.default_rng(SEED + 41)
    places, speeds = ("beta_0", "beta_2"), ("V_0", "a", "slack", "G_2")

    for _ in range(count):
        values = dict(VARIANTS[str(random.choice([*VARIANTS]))])
        for name in random.choice([*values], random.integers(1, 7), replace=False).tolist():
            values[name] = (values[name] or 1.0) * 10.0 ** (random.uniform(-1.0, 1.0) * random.choice((1.0, 3.0, 9.0)))
            if name in places:
                values[name] = min(values[name], 0.5)
            elif name in speeds and random.random() < 0.2:
                values[name] = 0.0
        try:
            solved = solve_hoist(Hoist(), values)
        except InputError:
            continue
        assert solved.forces.motion is None or solved.forces.motion.events <= MOST
        assert all(math.isfinite(q.value) or "inf" in str(values) for q in solved.quantities.values())
