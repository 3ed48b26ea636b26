"""Scale factors: both conventions, the choosers, what is printed is what is drawn."""

from __future__ import annotations

from dataclasses import replace

import pytest

import kulman
from kulman.drawing.words import Words
from kulman.scales.errors import InputError
from kulman.scales.scale import SERIES, Fixed, From, Scale, Segment, chooser, rounded, steps


def test_both_conventions_name_the_same_scale() -> None:
    scale = Scale("mu_V", 0.05, "m/s")
    words = Words.of("uk", "nau")
    per_unit = replace(words, notation={**words.notation, "scales": "mm per unit"})

    assert scale.per_unit == 20.0
    assert words.scale(scale) == "μ_{V} = 0,05 (м/с)/мм"
    assert per_unit.scale(scale) == "μ_{V} = 20 мм/(м/с)"


@pytest.mark.parametrize(
    ("symbol", "text", "mu"),
    [
        pytest.param("mu_V", "0.05", 0.05, id="a plain number"),
        pytest.param("mu_V", "0,05 (м/с)/мм", 0.05, id="value per mm"),
        pytest.param("mu_V", "20 mm/(m/s)", 0.05, id="mm per unit"),
        pytest.param("mu_l", "500 мм/м", 0.002, id="mm per metre"),
        pytest.param("mu_F_23", "15 Н/мм", 15.0, id="forces"),
        pytest.param("mu_F_23", "0.04 mm/N", 25.0, id="mm per newton"),
    ],
)
def test_a_given_scale_is_read_in_either_convention(symbol: str, text: str, mu: float) -> None:
    found = chooser(symbol, text, firm=True)

    assert isinstance(found, Fixed)
    assert found.mu == pytest.approx(mu, rel=1e-15)
    assert found.ladder(lambda name: 1.0) == (found.mu,)


def test_a_chosen_segment_is_read_by_its_letters() -> None:
    assert chooser("mu_a", "p'a'=80 mm") == Segment("a_A", 80.0)
    assert chooser("mu_V", "ps2=6 cm") == Segment("V_S2", 60.0)
    assert chooser("mu_l", "AB=13 cm") == Segment("l_AB", 130.0)


def test_a_scale_to_begin_with_may_be_coarser() -> None:
    assert chooser("mu_F_23", "from 15 N/mm") == From(15.0)
    assert chooser("mu_V", "from 20 mm/(m/s)").ladder(lambda name: 1.0)[:3] == (0.05, 0.1, 0.2)


@pytest.mark.parametrize("text", ["from", "from pa=80", "abc", "-5", "0", "20 mm/s", "pa=0", "qa=5", "1e400", ""])
def test_what_is_no_scale_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        chooser("mu_V", text)


def test_ladders_grow_coarser_by_round_steps() -> None:
    ladder = chooser("mu_F_23", "15 N/mm").ladder(lambda name: 1.0)

    assert ladder[:5] == (15.0, 20.0, 25.0, 40.0, 50.0)
    assert all(mu / 10.0 ** len(str(int(mu))[1:]) in SERIES for mu in ladder[1:])
    assert steps(0.003)[:3] == (0.004, 0.005, 0.01)
    assert rounded(0.0500691) == 0.0501


def test_crank_scale_draws_the_crank_as_its_own_velocity() -> None:
    solution = kulman.solve("nau-slider-crank", "3", scales={"mu_V": "crank", "mu_a": "crank"})

    assert solution["V_A"].mm == pytest.approx(solution["l_OA"].mm, abs=1e-3)
    assert solution["a_A"].mm == pytest.approx(solution["l_OA"].mm, abs=1e-3)


def test_round_scale_comes_from_the_series() -> None:
    solution = kulman.solve("nau-slider-crank", "3", scales={"mu_V": "round 60 mm"})

    assert solution.scales["mu_V"].mu == 0.1
    assert max(solution[name].mm for name in ("V_A", "V_B", "V_BA", "V_S2")) <= 60.0
