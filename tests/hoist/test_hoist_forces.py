"""Forces and times of a hoist, its limits, its motion where formulas are not valid, best places of load and drum."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from kulman import solve
from kulman.plans.hoist.forces import LEAST, MOST, Choice, Forces, _forces_of_many, choose, forces, spectrum
from kulman.plans.hoist.hoist import VALUES, Hoist
from kulman.plans.hoist.model import model
from kulman.plans.hoist.onesided import MOST as MOST_PIECES
from kulman.plans.hoist.onesided import Curve, one_sided
from kulman.plans.hoist.roots import _cosine_rest, extremes, sine_rest
from kulman.plans.hoist.solve import solve_hoist
from kulman.plans.lab.ropes import _rope_of, _TremblingError
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.cases import some
from kulman.tests.support.hoists import LONGEST, SEED, VARIANTS, constants, random_hoists, together, two_sided

NEAR = 1e-9


def assert_same(hoists: dict[str, np.ndarray], near: float = NEAR) -> None:
    found, other = model(hoists), two_sided(hoists)
    stretch, swing = found["P_st"] / found["C_12"], 2.0 * math.pi / found["k_1"]
    for name, value in other.items():
        whole = {"t": other["t_1"], "T": swing, "s": stretch}.get(name[0], found["P_st"])
        assert np.max(np.abs(found[name] - value) / whole) < near, name


def test_forces_of_the_variants_are_those_of_integration() -> None:
    hoists = together(tuple(VARIANTS.values()))

    assert_same(hoists, 1e-12)
    for variant in VARIANTS.values():
        assert all(forces(variant).ok[name] for name in ("rope_phase_1", "rope_phase_2", "support"))


@pytest.mark.parametrize(
    ("count", "longest"),
    [pytest.param(30, 15.0, id="30"), pytest.param(2000, LONGEST, id="2000", marks=pytest.mark.soak)],
)
def test_forces_of_random_hoists_are_those_of_integration(count: int, longest: float) -> None:
    assert_same(random_hoists(np.random.default_rng(SEED), count, longest))


def test_reduced_quantities_are_those_of_integrals_over_beams_and_rope() -> None:
    hoists = random_hoists(np.random.default_rng(SEED), 40)

    found, other = model(hoists), constants(hoists)

    for name, exact in (("m", "m"), ("C_01", "C_01"), ("C_12", "C_12"), ("V_t", "V")):
        assert np.allclose(found[name], np.asarray(other[exact], float), rtol=1e-14, atol=0.0), name
    assert np.allclose(1.0 / found["C"], 1.0 / found["C_01"] + 1.0 / found["C_12"], rtol=1e-14)
    assert np.allclose(found["k"] ** 2 * found["m"], found["C_01"] + found["C_12"], rtol=1e-14)


def test_what_is_told_of_the_rope_follows_from_its_greatest_force() -> None:
    found = forces(VARIANTS["V03"]).found

    assert found["F_max"] == max(found["F_12_max"], found["P_12_max"])
    assert found["sigma_max"] == pytest.approx(found["F_max"] / 160e-6)
    assert found["safety"] == pytest.approx(1400e6 / found["sigma_max"])
    assert found["dynamic_factor"] == pytest.approx(found["P_12_max"] / (found["m"] * 9.81))


def test_many_hoists_are_each_the_same_to_the_last_bit() -> None:
    hoists = random_hoists(np.random.default_rng(SEED + 1), 10)
    hoists["I_0"][0] = hoists["I_2"][1] = math.inf

    found = model(hoists)
    valid = _forces_of_many(hoists, ("F_max", "T_1", "t_1"))

    for i in range(10):
        one = {name: float(column[i]) for name, column in hoists.items()}
        for name, value in model(one).items():
            assert np.array_equal(value, found[name][i], equal_nan=True), name
        alone = forces(one).found
        assert all(alone[name] == valid[name][i] for name in ("F_max", "T_1", "t_1"))


def test_every_extreme_of_the_rope_is_found() -> None:
    hoists = random_hoists(np.random.default_rng(SEED), 150)
    found, turned = model(hoists), 0
    ratio = found["C_01"] / found["C_12"]
    for i in range(150):
        V, a, k, t_1 = (float(found[name][i]) for name in ("V_t", "a", "k", "t_1"))
        maxima, minima = extremes(V, a, k, float(ratio[i]), t_1)

        t = np.linspace(0.0, t_1, 20_001)[1:-1]
        rate = a / k * np.sin(k * t) + V * np.cos(k * t) + ratio[i] * (V + a * t)
        down = np.flatnonzero((rate[:-1] > 0.0) & (rate[1:] <= 0.0))
        up = np.flatnonzero((rate[:-1] < 0.0) & (rate[1:] >= 0.0))
        assert len(maxima) == len(down)
        assert len(minima) == len(up)
        assert np.all(np.abs(maxima - t[down]) < 1e-4 * t_1)
        assert np.all(np.abs(minima - t[up]) < 1e-4 * t_1)
        turned += len(maxima)
    assert turned > 40


@pytest.mark.parametrize("turns", [1, 2, 7])
@pytest.mark.parametrize("off", [0.0, -3e-15, 1e-13, 1e-9, -1e-6])
def test_nearly_triple_roots_are_found_to_seven_digits(turns: int, off: float) -> None:
    values = dict(VARIANTS["V10"])
    found = model(values)
    values["V_0"] = found["P_st"] / found["C"] * found["k"] / (2.0 * math.pi * turns) * (1.0 + off)

    t_1 = model(values)["t_1"]

    with mp.workdps(60):
        v = {name: mp.mpf(value) for name, value in values.items()}
        m = (v["G_1"] + v["G_2"] / 3) / v["g"]
        beams = [
            3 * v[f"E_{i}"] * v[f"I_{i}"] / (v[f"beta_{i}"] * (1 - v[f"beta_{i}"])) ** 2 / v[f"l_{i}"] ** 3
            for i in (0, 2)
        ]
        C_12 = 1 / (v["L"] / (v["S"] * v["E_k"]) + 1 / beams[1])
        k = mp.sqrt((beams[0] + C_12) / m)
        wanted = m * v["g"] * (1 / beams[0] + 1 / C_12) * k / v["V_0"]
        low, high = mp.mpf(0), wanted + 2
        for _ in range(180):  # halving: it does not mind that the root is triple
            middle = (low + high) / 2
            low, high = (middle, high) if middle - mp.sin(middle) < wanted else (low, middle)
        assert abs(t_1 - low / k) < 1e-9 * t_1


def test_rests_of_sine_and_cosine_keep_their_digits() -> None:
    x = np.concatenate((np.logspace(-12, 3, 400), [0.999999, 1.0, 1.000001]))

    sines, cosines = sine_rest(x), _cosine_rest(x)

    with mp.workdps(120):
        for i, value in enumerate(x.tolist()):
            exact = mp.mpf(value)
            assert abs(sines[i] / (exact - mp.sin(exact)) - 1) < 4e-15
            assert abs(cosines[i] / (exact**2 / 2 - 1 + mp.cos(exact)) - 1) < 1e-14


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
    solved = forces({**VARIANTS["V09"], "V_0": 1.0})
    found = solved.found

    assert (solved.ok["rope_phase_1"], solved.ok["rope_phase_2"]) == (True, False)
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


VARIANTS["V03"] = {
    "G_1": 32e3, "G_2": 90.0, "L": 7.0, "S": 160e-6, "E_k": 1e11, "sigma": 1400e6, "K": 5.5,
    "l_0": 4.0, "I_0": 5e-5, "E_0": 2.06e11, "beta_0": 0.3, "l_2": 13.5, "I_2": 6e-4, "E_2": 2.06e11, "beta_2": 0.25,
    "V_0": 0.13, "a": 0.1, "slack": 0.0, "g": 9.81,
}  # fmt: skip


@cache
def chosen(**other: float) -> Choice:
    """Choose places for 3.2 t, load and drum off the middle, not safe with K = 5.5."""
    return choose(VARIANTS["V03"] | other, 10)


def test_places_of_the_spectrum_are_single_hoists() -> None:
    found = chosen().spectrum

    for i, j in ((0, 0), (3, 7), (9, 1)):
        alone = model(VARIANTS["V03"] | {"beta_0": float(found.beta_0[i]), "beta_2": float(found.beta_2[j])})
        assert [found.F_max[i, j], found.sigma_max[i, j]] == pytest.approx(
            [alone["F_max"], alone["sigma_max"]], rel=1e-14
        )
        assert found.permitted[i, j] == (alone["safety"] >= 5.5)
    assert 0 < found.permitted.sum() < found.permitted.size


def test_loop_tries_the_least_changes_first_until_the_rope_is_safe() -> None:
    found = chosen()
    away = [np.hypot(t.beta_0 - 0.3, t.beta_2 - 0.25) for t in found.trials]

    assert found.found
    assert found.given == found.trials[0]
    assert away == sorted(away)
    assert [t.safety >= 5.5 for t in found.trials] == [False] * (len(away) - 1) + [True]


def test_loop_is_over_at_once_where_the_given_places_are_safe_and_says_where_none_is() -> None:
    easy, never = chosen(K=5.0), chosen(K=7.0)

    assert easy.trials == (easy.given,)
    assert not never.found
    assert len(never.trials) == 1 + 10 * 10
    assert not never.spectrum.permitted.any()


def test_no_place_is_better_than_the_best() -> None:
    best = chosen().best
    random = np.random.default_rng(SEED)
    beta_0, beta_2 = random.uniform(LEAST, MOST, (2, 1000))

    elsewhere = model(VARIANTS["V03"] | {"beta_0": beta_0, "beta_2": beta_2}, ("F_max",))["F_max"]

    assert best.F_max <= elsewhere.min() * (1.0 + 1e-6)
    assert best.safety == pytest.approx(1400e6 * 160e-6 / best.F_max, rel=1e-14)


def test_where_the_rope_would_push_the_force_is_that_of_a_one_sided_rope() -> None:
    soft = VARIANTS["V03"] | {"I_0": 1e-6, "V_0": 0.5, "a": 0.0}

    found = spectrum(soft, np.array([0.3]), np.array([0.25]))

    assert model(soft)["F_12_min"] < 0.0
    assert not found.formulas[0, 0]
    steps = stepped(forces(soft).found, forces(soft).end)
    assert found.F_max[0, 0] == pytest.approx(max(steps["F_12_max"], steps["P_12_max"]), rel=1e-5)
    assert found.F_max[0, 0] != pytest.approx(model(soft)["F_max"], rel=1e-2)


def test_where_many_motions_have_to_be_followed_fewer_places_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.plans.hoist.forces.FEWER", 4)
    monkeypatch.setattr("kulman.plans.hoist.forces.ROUNDS", 1)

    found = choose(VARIANTS["V03"] | {"V_0": 5.0}, 46).spectrum

    assert found.F_max.shape == (4, 4)
    assert not found.formulas.any()
    assert np.isfinite(found.F_max).all()


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


@pytest.mark.parametrize(("variant", "name", "value"), some(ENDLESS, 1, 2))
def test_a_motion_that_nobody_follows_is_refused_in_a_line(variant: str, name: str, value: float) -> None:
    with pytest.raises(InputError) as told:
        solve("karpenko-hoist", variant, set={name: f"{value} {VALUES[name]}"})

    assert told.value.key == ENDLESS[variant, name, value]
    assert all("\n" not in told.value.text(language) for language in LANGUAGES)


@pytest.mark.soak
def test_many_swings_before_the_lift_off_are_no_trouble_where_the_formulas_are_valid() -> None:
    slow = {**VARIANTS["V10"], "V_0": 1e-7, "a": 0.0}
    found = forces(slow).found

    assert found["k"] * found["t_1"] > 1e6
    assert len([*solve_hoist(Hoist(), slow).program]) < 10_000  # the last swings are drawn, not a million
    with pytest.raises(InputError, match=r"more than \d+ times"):
        choose({**VARIANTS["V04"], "l_0": 300.0})
    with pytest.raises(_TremblingError):
        _rope_of(model({**VARIANTS["V06"], "G_2": 0.03}), 32)


def test_a_curve_turns_and_falls_through_zero_where_small_steps_say_so() -> None:
    random, fallen, turned = np.random.default_rng(SEED + 40), 0, 0

    for k in range(160):
        p_1, p_2 = random.normal(0.0, 10.0 ** random.uniform(-4.0, 0.5, 2))
        A, B, w = (*random.normal(0.0, 1.0, 2), random.uniform(1.0, 40.0)) if k < 120 else (0.0, 0.0, 0.0)
        p_0 = random.choice((-A + 10.0 ** random.uniform(-6.0, 0.0), random.uniform(1.0, 3.0) * math.hypot(A, B) + 0.1))
        curve = Curve(p_0, p_1, p_2, A, B, w)
        if not curve.at(0.0) > 0.0:
            continue
        t = np.linspace(0.0, end := random.uniform(1.0, 40.0), 20_001)
        ordinates = p_0 + (p_1 + p_2 * t) * t + A * np.cos(w * t) + B * np.sin(w * t)
        below = np.flatnonzero(ordinates < 0.0)
        early = t[1:4000][(np.diff(ordinates[1:]) * np.diff(ordinates[:-1]) < 0.0)[:3999]]  # where it turns, of a fifth

        found, turns = curve.falls_through(end, 1e-12), np.array([*curve.turnings(0.2 * end)])

        assert all(np.min(np.abs(turns - top)) <= 2.0 * t[1] for top in early)
        assert np.all(np.abs([curve.jet(turn)[1] for turn in turns.tolist()]) < 1e-6 * (abs(p_1) + 1.0 + w * w))
        turned += len(early)
        if not below.size:
            assert found is None or abs(curve.jet(found)[1]) < 0.05 * (w or 1.0)  # a dip between two steps
        else:
            fallen += 1
            assert found is not None
            assert found <= t[below[0]]
            assert found > t[below[0] - 1] or curve.at(0.5 * (found + t[below[0] - 1])) > -1e-4
            assert curve.at(found) == pytest.approx(0.0, abs=1e-9)
    assert fallen > 30
    assert turned > 200


@pytest.mark.parametrize("count", [pytest.param(12, id="12"), pytest.param(120, id="120", marks=pytest.mark.soak)])
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
        assert solved.forces.motion is None or solved.forces.motion.events <= MOST_PIECES
        assert all(math.isfinite(q.value) or "inf" in str(values) for q in solved.quantities.values())
