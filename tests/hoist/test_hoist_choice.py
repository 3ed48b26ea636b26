"""Places of load and drum: the spectrum against single hoists, the article's loop, the optimum against chance."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from kulman.plans.hoist.forces import LEAST, MOST, Choice, choose, spectrum
from kulman.plans.hoist.model import model

# 3.2 t, load and drum off the middle: V03 of hoist-variants.json, not safe with K = 5.5
OFF_MIDDLE = {
    "G_1": 32e3, "G_2": 90.0, "L": 7.0, "S": 160e-6, "E_k": 1e11, "sigma": 1400e6, "K": 5.5,
    "l_0": 4.0, "I_0": 5e-5, "E_0": 2.06e11, "beta_0": 0.3, "l_2": 13.5, "I_2": 6e-4, "E_2": 2.06e11, "beta_2": 0.25,
    "V_0": 0.13, "a": 0.1, "slack": 0.0, "g": 9.81,
}  # fmt: skip
SEED, PLACES = 3, 10


@cache
def chosen(**other: float) -> Choice:
    return choose(OFF_MIDDLE | other, PLACES)


def test_places_of_the_spectrum_are_single_hoists() -> None:
    found = chosen().spectrum

    for i, j in ((0, 0), (3, 7), (9, 1)):
        alone = model(OFF_MIDDLE | {"beta_0": float(found.beta_0[i]), "beta_2": float(found.beta_2[j])})
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


def test_loop_is_over_at_once_where_the_given_places_are_safe() -> None:
    assert chosen(K=5.0).trials == (chosen(K=5.0).given,)


def test_loop_says_that_no_place_is_safe() -> None:
    found = chosen(K=7.0)

    assert not found.found
    assert len(found.trials) == 1 + PLACES * PLACES
    assert not found.spectrum.permitted.any()


def test_no_place_is_better_than_the_best() -> None:
    best = chosen().best
    random = np.random.default_rng(SEED)
    beta_0, beta_2 = random.uniform(LEAST, MOST, (2, 1000))

    elsewhere = model(OFF_MIDDLE | {"beta_0": beta_0, "beta_2": beta_2}, ("F_max",))["F_max"]

    assert best.F_max <= elsewhere.min() * (1.0 + 1e-6)
    assert best.safety == pytest.approx(1400e6 * 160e-6 / best.F_max, rel=1e-14)


def one_sided_by_steps(values: dict[str, float]) -> float:
    """The greatest force of a rope that only pulls on a load whose support only pushes, by small steps."""
    found = model(values)
    m, C_01, C_12, g, V, a = (found[name] for name in ("m", "C_01", "C_12", "g", "V_t", "a"))
    h = 2e-4 / found["k"] * 10.0
    height, speed, t, greatest = -m * g / C_01, 0.0, 0.0, 0.0
    while t < 4.0 * found["t_1"]:
        rope = max(C_12 * (V * t + 0.5 * a * t * t - height - m * g / C_01), 0.0)
        push = max(-C_01 * height, 0.0)
        speed += h * ((rope + push) / m - g)
        height += h * speed
        t += h
        greatest = max(greatest, rope)
    return greatest


def test_where_the_rope_would_push_the_force_is_that_of_a_one_sided_rope() -> None:
    soft = OFF_MIDDLE | {"I_0": 1e-6, "V_0": 0.5, "a": 0.0}
    place = np.array([0.3])

    found = spectrum(soft, place, np.array([0.25]))

    assert model(soft)["F_12_min"] < 0.0
    assert not found.formulas[0, 0]
    assert found.F_max[0, 0] == pytest.approx(one_sided_by_steps(soft), rel=2e-3)
    assert found.F_max[0, 0] != pytest.approx(model(soft)["F_max"], rel=1e-2)


def test_where_many_motions_have_to_be_followed_fewer_places_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.plans.hoist.forces.FEWER", 4)
    monkeypatch.setattr("kulman.plans.hoist.forces.ROUNDS", 1)

    found = choose(OFF_MIDDLE | {"V_0": 5.0}, 46).spectrum

    assert found.F_max.shape == (4, 4)
    assert not found.formulas.any()
    assert np.isfinite(found.F_max).all()
