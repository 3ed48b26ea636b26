"""Forces and times of a hoist against integration in extended precision, for the ten variants and for random cranes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp

from kulman.plans.hoist.forces import forces, forces_of_many
from kulman.plans.hoist.model import model
from kulman.plans.hoist.roots import cosine_rest, extremes, sine_rest
from kulman.tests.support.hoists import LONGEST, SEED, VARIANTS, constants, random_hoists, together, two_sided

NEAR = 1e-9
QUANTITIES = ("m", "alpha_0", "alpha_2", "C_01", "C_k", "C_2", "C_12", "C", "k", "k_1", "t_1", "F_12_t1", "F_12_max")
QUANTITIES += ("t_F12_max", "T_1", "P_m", "R", "P_12_max", "P_12_min", "F_max", "sigma_max", "safety")
QUANTITIES += ("dynamic_factor", "w_0_max", "w_2_max", "P_12_max_printed")


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


def test_every_quantity_of_the_note_is_there() -> None:
    found = forces(VARIANTS["V03"]).found

    assert set(QUANTITIES) <= set(found)
    assert all(math.isfinite(found[name]) for name in QUANTITIES)
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
