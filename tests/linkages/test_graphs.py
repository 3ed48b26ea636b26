"""Diagrams by chords: order two in the number of sections, scale factors of paper, beside the plans."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.linkages.cycles.cycle import (
    chords,
    cycle,
    diagrams,
    differentiate,
    pole_distance,
    velocities,
    velocity_field,
)
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.linkages import four_bar, four_bar_values, piston_engine, slider_crank, slider_crank_values

MOTION = ("acceleration",)
CASES = [
    pytest.param(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), "B", "m", id="slider"),
    pytest.param(slider_crank(), slider_crank_values(1.0, 3.0, 0.5, sense=-1.0), "3", "m", id="slider by its number"),
    pytest.param(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), "E", "m", id="point of the rod"),
    pytest.param(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), "2", "rad", id="rod"),
    pytest.param(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0, sense=-1.0), "3", "rad", id="rocker"),
    pytest.param(four_bar(), four_bar_values(2.0, 2.5, 3.0, 1.0), "3", "rad", id="drag link, round and round"),
]


@pytest.mark.parametrize(("mechanism", "values", "of", "unit"), CASES)
def test_chords_come_nearer_to_the_plans_with_the_square_of_the_sections(
    mechanism: Mechanism, values: dict[str, float], of: str, unit: str
) -> None:
    done = cycle(mechanism, values, MOTION)

    drawn = [diagrams(done, of, sections) for sections in (48, 96, 192)]

    assert {d.unit for d in drawn} == {unit}
    for curve in ("velocity", "acceleration"):
        errors = [np.abs(getattr(d, curve).difference).max() for d in drawn]
        orders = [math.log2(errors[k] / errors[k + 1]) for k in (0, 1)]
        assert orders == pytest.approx([2.0, 2.0], abs=0.15)
        assert getattr(drawn[-1], curve).per_cent.max() < 0.5


@pytest.mark.parametrize("sections", [8, 12, 24])
def test_velocities_stand_at_the_middles_of_sections_accelerations_at_their_ends(sections: int) -> None:
    done = cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), MOTION)

    drawn = diagrams(done, "B", sections)

    step = math.pi / sections  # a full turn at 2 rad/s takes pi seconds
    assert len(drawn.times) == len(drawn.s) == len(drawn.v) == len(drawn.a) == sections + 1
    assert np.allclose(drawn.times, np.arange(sections + 1) * step)
    assert np.allclose(drawn.velocity.times, (np.arange(sections) + 0.5) * step)
    assert np.allclose(drawn.acceleration.times, np.arange(sections) * step)
    assert np.allclose(drawn.acceleration.plans, drawn.a[:-1])


def test_a_sliding_driver_draws_open_diagrams() -> None:
    values = {"l_AB": 3.0, "l_OA": 1.0, "travel": 2.5, "speed": 0.5, "gamma": 0.3, "side": 1.0}
    done = cycle(piston_engine(), values, MOTION, start=2.3, end=3.7)

    drawn = diagrams(done, "3", 48)

    assert len(drawn.acceleration.chords) == 47
    assert drawn.velocity.per_cent.max() < 0.5
    assert drawn.times[-1] == pytest.approx(1.4 / 0.5)


def test_chords_on_paper_and_their_scale_factors_give_the_same_values() -> None:
    times = np.linspace(0.0, 0.08, 13)
    s = 0.1 * np.sin(40.0 * times)
    mu_s, mu_t, mu_v = 0.001, 0.08 / 180.0, 0.075  # m/mm, s/mm, (m/s)/mm

    pole = pole_distance(mu_s, mu_t, mu_v)

    cut = np.diff(s / mu_s) * (pole / (180.0 / 12))  # by rays from the pole, parallel to the chords
    assert pole == pytest.approx(30.0)
    assert np.allclose(cut * mu_v, chords(s, times[1]), rtol=1e-13)


def test_chords_of_a_parabola_are_exact() -> None:
    t = np.linspace(0.0, 1.2, 13)

    v, a = differentiate(3.0 * t * t, 0.1, closed=False)

    assert np.allclose(v, 6.0 * 0.5 * (t[:-1] + t[1:]))
    assert np.allclose(a, 6.0)
    assert len(a) == 11


@pytest.mark.parametrize(("of", "key"), [("Q", "motion-unknown"), ("9", "motion-unknown")])
def test_what_does_not_move_has_no_diagrams(of: str, key: str) -> None:
    done = cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), MOTION)

    with pytest.raises(InputError) as caught:
        diagrams(done, of)

    assert caught.value.key == key


def test_diagrams_need_accelerations() -> None:
    done = cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), ("velocity",))

    with pytest.raises(InputError, match="accelerations"):
        diagrams(done, "B")


def test_the_field_of_velocities_is_that_of_a_rigid_link() -> None:
    solved = solve_linkage(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0), ("velocity",))

    for link, points in ((1, "OA"), (2, "ABE"), (3, "CB")):
        places, field = velocity_field(solved, link)
        omega = solved.values[f"omega_{link}"]
        for point in points:
            at = solved.point(point)
            v = 0j if point in "OC" else solved.point(f"velocity.{point}")
            assert np.allclose(field - v, 1j * omega * (places - at), atol=1e-12)
            assert places.real.min() < at.real < places.real.max()
            assert places.imag.min() < at.imag < places.imag.max()
        assert places.shape == field.shape == (7, 9)


def test_a_slider_moves_alike_everywhere() -> None:
    solved = solve_linkage(slider_crank(), slider_crank_values(1.0, 3.0, 0.5), ("velocity",))

    _, field = velocity_field(solved, 3)

    assert np.all(field == solved.point("velocity.B"))


def test_velocities_of_points_of_a_link() -> None:
    at = np.array([0j, 1.0 + 0j, 1j])

    assert velocities(at, 0j, 1.0 + 0j, 2.0).tolist() == [1 + 0j, 1 + 2j, -1 + 0j]
