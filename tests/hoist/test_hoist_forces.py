"""Forces and times of a hoist, its motion where formulas are not valid, and the best places of load and drum."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from kulman.plans.hoist.forces import LEAST, MOST, Choice, Forces, choose, forces, forces_of_many, spectrum
from kulman.plans.hoist.model import model
from kulman.plans.hoist.onesided import one_sided
from kulman.plans.hoist.roots import cosine_rest, extremes, sine_rest
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


def test_greatest_deflections_are_those_of_the_curve_of_the_beam() -> None:
    values = VARIANTS["V03"]
    found = forces(values).found
    for i, load in ((0, found["P_st"]), (2, found["P_12_max"])):
        l, b, EI = values[f"l_{i}"], values[f"beta_{i}"] * values[f"l_{i}"], values[f"E_{i}"] * values[f"I_{i}"]
        x = np.linspace(0.0, l, 200_001)  # from the nearer end: bending moment, integrated twice
        moment = np.where(x < b, load * (l - b) / l * x, load * b / l * (l - x))
        step = x[1] - x[0]
        slope = np.concatenate(([0.0], np.cumsum(0.5 * (moment[1:] + moment[:-1])) * step))
        w = np.concatenate(([0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1])) * step))
        w = (w[-1] / l * x - w) / EI

        assert found[f"w_{i}_max"] == pytest.approx(float(np.max(w)), rel=1e-8)
        assert l - found[f"x_w{i}"] == pytest.approx(float(x[np.argmax(w)]), abs=1e-3 * l)


def test_many_hoists_are_each_the_same_to_the_last_bit() -> None:
    hoists = random_hoists(np.random.default_rng(SEED + 1), 10)
    hoists["I_0"][0] = hoists["I_2"][1] = math.inf

    found = model(hoists)
    valid = forces_of_many(hoists, ("F_max", "T_1", "t_1"))

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

    sines, cosines = sine_rest(x), cosine_rest(x)

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


# 3.2 t, load and drum off the middle: V03 of hoist-variants.json, not safe with K = 5.5
VARIANTS["V03"] = {
    "G_1": 32e3, "G_2": 90.0, "L": 7.0, "S": 160e-6, "E_k": 1e11, "sigma": 1400e6, "K": 5.5,
    "l_0": 4.0, "I_0": 5e-5, "E_0": 2.06e11, "beta_0": 0.3, "l_2": 13.5, "I_2": 6e-4, "E_2": 2.06e11, "beta_2": 0.25,
    "V_0": 0.13, "a": 0.1, "slack": 0.0, "g": 9.81,
}  # fmt: skip


@cache
def chosen(**other: float) -> Choice:
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
