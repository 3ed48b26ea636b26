"""The whole cycle against closed forms: limiting angles, dead positions, strokes, ratios of times, extremes."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping

import numpy as np
import pytest

from kulman.plans.linkages.cycles.cycle import Cycle, cycle
from kulman.plans.linkages.cycles.limits import Arc, limiting_places, reach_of, size_of, swept
from kulman.plans.linkages.cycles.strokes import OutputMotion, output_motions, stroke_of
from kulman.plans.linkages.mechanism import Mechanism, Stroke
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.linkages import (
    four_bar,
    four_bar_values,
    piston_engine,
    random_crank_rockers,
    random_four_bars,
    random_slider_cranks,
    reach,
    slider_crank,
    slider_crank_values,
)

SEED = 3
MOTION = ("acceleration",)
TURN = 2.0 * math.pi


def counts(few: int, many: int) -> pytest.MarkDecorator:
    """Run a law over a few random mechanisms by default, over many in the long run."""
    return pytest.mark.parametrize("count", [few, pytest.param(many, marks=pytest.mark.soak)])


def difference(angle: float, other: float) -> float:
    """Size of the difference of two angles."""
    return abs((angle - other + math.pi) % TURN - math.pi)


def closest(angles: list[float], expected: list[float]) -> float:
    """Largest distance of angles from those that are expected, in whatever order."""
    assert len(angles) == len(expected), (angles, expected)
    return max((min(difference(a, b) for b in angles) for a in expected), default=0.0)


def angle_in(first: float, second: float, opposite: float) -> float:
    """Angle between two sides of a triangle, by the cosine law."""
    return math.acos((first**2 + second**2 - opposite**2) / (2.0 * first * second))


def limits_of_four_bar(v: Mapping[str, float]) -> list[float]:
    """Angles of the crank at which coupler and rocker lie in line: AC is their sum or their difference."""
    frame = math.hypot(v["x_C"] - v["x_O"], v["y_C"] - v["y_O"])
    tilt = math.atan2(v["y_C"] - v["y_O"], v["x_C"] - v["x_O"])
    found = []
    for distance in (v["l_AB"] + v["l_CB"], abs(v["l_AB"] - v["l_CB"])):
        if abs(frame - v["l_OA"]) < distance < frame + v["l_OA"]:
            found += [tilt + s * angle_in(v["l_OA"], frame, distance) for s in (-1.0, 1.0)]
    return found


@counts(30, 10_000)
def test_limiting_angles_of_four_bars_follow_the_cosine_law(count: int) -> None:
    mechanism, worst, limited = four_bar(), 0.0, 0

    for values in random_four_bars(SEED, count):
        found = reach(mechanism, values)
        ends = [end for arc in found.apart for end in (arc.low, arc.high)]
        worst = max(worst, closest(ends, limits_of_four_bar(values)))
        limited += bool(ends)

    assert limited > count / 4
    assert worst < 1e-11


@pytest.mark.parametrize("missing", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_an_arc_shorter_than_the_grid_is_seen(missing: float) -> None:
    values = slider_crank_values(1.0, 1.0 - missing, 0.0)

    found = reach(slider_crank(), values)

    half = math.atan2(math.sqrt(missing * (2.0 - missing)), 1.0 - missing)  # arccos(1 - missing), not to cancel
    ends = sorted(end for arc in found.apart for end in (arc.low, arc.high))
    expected = sorted(top + s * half for top in (math.pi / 2, 3 * math.pi / 2) for s in (-1.0, 1.0))
    # the difference of nearly equal lengths is known to 1e-16 only
    assert np.allclose(ends, expected, rtol=0.0, atol=1e-12 + 1e-15 / half)


def test_a_crank_that_turns_round_has_no_limits() -> None:
    found = reach(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0))

    assert found.apart == found.changes == found.poles == ()
    assert found.free


def test_a_mechanism_that_cannot_be_assembled_has_no_reach() -> None:
    values = four_bar_values(0.1, 1.0, 1.0, 5.0)

    found = reach(four_bar(), values)
    done = cycle(four_bar(), values)

    assert found.stretches == ()
    assert found.apart == (Arc(0.0, TURN),)
    assert limiting_places(four_bar(), values) is None
    assert set(done.statuses) == {"no-assembly"}


def test_the_nearest_limits_of_a_position_lie_on_both_sides_of_it() -> None:
    values = slider_crank_values(2.0, 1.0, 0.0) | {"phi": math.radians(80.0 + 720.0)}

    low, high = limiting_places(slider_crank(), values) or (None, None)

    assert low == pytest.approx(math.radians(750.0), abs=1e-11)
    assert high == pytest.approx(math.radians(870.0), abs=1e-11)


def motion(mechanism: Mechanism, values: Mapping[str, float]) -> OutputMotion:
    """Return how link 3 moves: what a cycle says of it, without its positions."""
    drive = swept(mechanism, values)
    return next(m for m in output_motions(drive, values, reach_of(drive, values)) if m.output.link == 3)


@counts(30, 10_000)
def test_sliders_stand_dead_where_crank_and_rod_lie_in_line(count: int) -> None:
    mechanism, worst, strokes, ratios = slider_crank(), 0.0, 0.0, 0.0

    for v in random_slider_cranks(SEED, count):
        done = motion(mechanism, v)
        r, l, e, side = v["l_OA"], v["l_AB"], v["e"], v["side"]
        # the slider lies at the distance l + r or l - r from O, e to the left of it; the crank points there or back
        far, near = (math.atan2(e, side * math.sqrt((l + k * r) ** 2 - e**2)) for k in (1, -1))
        expected = [far + v["gamma"], near + v["gamma"] + math.pi]
        worst = max(worst, closest([spot.angle for spot in done.dead], expected))
        stroke = math.sqrt((l + r) ** 2 - e**2) - math.sqrt((l - r) ** 2 - e**2)
        assert done.travel is not None
        assert done.ratio is not None
        strokes = max(strokes, abs(done.travel.length - stroke) / stroke)
        theta = abs(difference(far, near))
        ratios = max(ratios, abs(done.ratio - (math.pi + theta) / (math.pi - theta)))

    assert worst < 1e-11
    assert strokes < 1e-12
    assert ratios < 1e-11


@counts(30, 10_000)
def test_rockers_stand_dead_where_crank_and_coupler_lie_in_line(count: int) -> None:
    mechanism, worst, swings, ratios = four_bar(), 0.0, 0.0, 0.0

    for v in random_crank_rockers(SEED, count):
        done = motion(mechanism, v)
        frame = math.hypot(v["x_C"] - v["x_O"], v["y_C"] - v["y_O"])
        tilt = math.atan2(v["y_C"] - v["y_O"], v["x_C"] - v["x_O"])
        far, near = (v["l_AB"] + k * v["l_OA"] for k in (1.0, -1.0))
        # O, A, B in line: B stands to the left of OC where the branch is +1; the crank points to B, or away from it
        turn = [v["side"] * angle_in(frame, distance, v["l_CB"]) for distance in (far, near)]
        worst = max(worst, closest([spot.angle for spot in done.dead], [tilt + turn[0], tilt + turn[1] + math.pi]))
        swing = angle_in(frame, v["l_CB"], far) - angle_in(frame, v["l_CB"], near)
        theta = abs(turn[0] - turn[1])
        assert done.travel is not None
        assert done.ratio is not None
        swings = max(swings, abs(done.travel.length - swing))
        ratios = max(ratios, abs(done.ratio / ((math.pi + theta) / (math.pi - theta)) - 1.0))

    assert worst < 1e-11
    assert swings < 1e-11
    assert ratios < 1e-11


def test_an_output_that_turns_round_has_no_dead_position() -> None:
    done = motion(four_bar(), four_bar_values(2.0, 2.5, 3.0, 1.0))  # a drag link

    assert done.dead == ()
    assert done.travel is None
    with pytest.raises(InputError, match="no strokes"):
        stroke_of(four_bar(Stroke(3)), four_bar_values(2.0, 2.5, 3.0, 1.0))


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("rotation", [1.0, -1.0])
def test_the_working_stroke_says_where_the_cycle_begins_and_which_time_is_long(sense: float, rotation: float) -> None:
    values = slider_crank_values(1.0, 3.0, 0.8, sense=rotation) | {"working": sense}

    done = cycle(slider_crank(Stroke(3, "working")), values, ("velocity",), positions=360)

    moving = done.values["_V_3"] * sense
    first = int(np.argmax(moving < -1e-9))  # the first position of the idle stroke
    assert done.zero == pytest.approx(done.angles[0])
    assert abs(moving[0]) < 1e-12
    assert np.all(moving[1:first] > 0.0)
    assert np.all(moving[first:] < 0.0)
    assert done.motions[0].ratio == pytest.approx(first / (360 - first), rel=0.02)


def test_without_a_stroke_the_cycle_begins_at_the_zero_of_the_crank() -> None:
    done = cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.8, sense=-1.0), positions=8)

    assert done.angles.tolist() == [-k * TURN / 8 for k in range(8)]
    assert done.times[1] == pytest.approx(TURN / 8 / 2.0)


def test_another_beginning_is_taken_as_it_is() -> None:
    done = cycle(slider_crank(Stroke(3)), slider_crank_values(1.0, 3.0, 0.8), positions=8, start=0.7)

    assert done.angles[0] == 0.7


@counts(20, 3_000)
def test_links_keep_their_lengths_and_branches_over_the_cycle(count: int) -> None:
    mechanism = four_bar()

    for values in random_four_bars(SEED + 2, count):
        done = cycle(mechanism, values, ("position",), positions=360)
        O, A, B, C, E = (done.values[point] for point in "OABCE")
        whole = np.isfinite(B)
        side = ((C - A).conj() * (B - A)).imag[whole] * values["side"]
        for start, end, length in ((O, A, "l_OA"), (A, B, "l_AB"), (C, B, "l_CB")):
            off = np.abs(np.abs(end - start)[whole] / values[length] - 1.0)
            assert off.max(initial=0.0) < 1e-12
        bent = (E - A)[whole] * (B - A)[whole].conj()
        expected = complex(values["x_E"], values["y_E"]) * values["l_AB"]
        assert np.all(np.abs(bent - expected) < 1e-12 * abs(expected))
        assert np.all(side >= 0.0)
        assert np.array_equal(whole, np.array(done.statuses) != "no-assembly")


def test_positions_of_a_cycle_are_those_solved_one_by_one() -> None:
    mechanism, values = four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0, sense=-1.0)

    done = cycle(mechanism, values, MOTION, positions=24, start=0.123)

    for k, angle in enumerate(done.angles.tolist()):
        solved = solve_linkage(mechanism, {**values, "phi": angle}, MOTION)
        for name in done.quantities:
            assert done.values[name][k] == solved.values[name], name


@counts(10, 1_000)
def test_velocities_are_derivatives_of_places_and_accelerations_of_velocities(count: int) -> None:
    cases = [(four_bar(), v) for v in random_four_bars(SEED + 3, count)]
    cases += [(slider_crank(), v) for v in random_slider_cranks(SEED + 3, count)]
    h = 1e-5

    for mechanism, values in cases:
        done = cycle(mechanism, values, MOTION, positions=360)
        marks = [f"{plan}{point}" for plan in ("", "velocity.", "acceleration.") for point in "ABE"]
        here = done.at(done.angles, marks)
        ahead, behind = (done.at(done.angles + s * h, marks) for s in (1.0, -1.0))
        # near a limit of assembly a difference quotient says nothing
        smooth = np.min([np.abs(done.angles[:, None] - end + k * TURN) for arc in done.reach.apart
                         for end in [np.array([arc.low, arc.high])] for k in (-2, -1, 0, 1, 2)] or [np.ones((360, 2))],
                        axis=0).min(axis=1) > 0.05  # fmt: skip
        rate = values["speed"] * values["sense"] / (2.0 * h)
        for order, whole in (("", "velocity."), ("velocity.", "acceleration.")):
            for point in "ABE":
                slope = (ahead[order + point] - behind[order + point]) * rate
                size = np.nanmax(np.abs(here[whole + point][smooth]), initial=1e-300)
                off = np.abs(slope - here[whole + point])[smooth & np.isfinite(slope)]
                assert off.max(initial=0.0) < 1e-5 * size


PARALLELOGRAM = four_bar_values(1.0, 2.0, 1.0, 2.0)


def test_a_parallelogram_lying_flat_is_singular_and_does_not_flip_silently() -> None:
    done = cycle(four_bar(), PARALLELOGRAM, ("velocity",), positions=8)

    side = ((done.values["C"] - done.values["A"]).conj() * (done.values["B"] - done.values["A"])).imag
    flat = np.array([0, 4])
    assert [done.statuses[k] for k in flat] == ["singular", "singular"]
    assert np.all(np.isfinite(done.values["B"]))
    assert np.flatnonzero(np.isnan(done.values["V_B"])).tolist() == flat.tolist()
    assert np.all(np.abs(side[flat]) < 1e-7)
    assert np.all(np.delete(side, flat) > 0.1)  # the branch that the task names, on both sides of the change point
    assert done.reach.apart == ()
    assert closest(list(done.reach.changes), [0.0, math.pi]) < 1e-7


def test_both_bars_in_line_are_a_change_point() -> None:
    done = cycle(slider_crank(), slider_crank_values(1.0, 1.0, 0.0), ("velocity",), positions=4)

    assert closest(list(done.reach.changes), [math.pi / 2, 3 * math.pi / 2]) < 1e-7
    assert [done.statuses[k] for k in (1, 3)] == ["singular", "singular"]
    assert done.motions[0].ratio is None


def dense(done: Cycle, name: str) -> np.ndarray:
    """Return sizes of a quantity on a grid a hundred times as fine as that of the search."""
    found = done.at(np.linspace(0.0, TURN, 36_001), [name])[name]
    return np.abs(found) if np.iscomplexobj(found) else found


def test_extremes_are_those_of_a_fine_grid_and_better() -> None:
    for mechanism, values in (
        (slider_crank(), slider_crank_values(1.0, 2.1, 0.7, tilt=0.4)),
        (four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0)),
        (four_bar(), four_bar_values(1.0, 2.02, 2.0, 1.05)),  # a sharp peak
    ):
        done = cycle(mechanism, values, MOTION)
        found = done.extremes()
        assert set(found) == set(done.quantities)
        for name, (most, least) in found.items():
            fine = dense(done, name)
            size = np.abs(fine).max() or 1.0
            assert fine.max() <= most.value + 1e-12 * size
            assert least.value <= fine.min() + 1e-9 * size
            for extreme in (most, least):
                at = done.at(np.array([extreme.at]), [name])[name][0]
                value = abs(at) if isinstance(at, complex) else at
                assert value == pytest.approx(extreme.value, abs=1e-9 * size)


def test_extremes_of_a_slider_crank_lie_where_the_textbook_says() -> None:
    r, l = 0.05, 0.2
    done = cycle(slider_crank(), slider_crank_values(r, l, 0.0), MOTION)

    found = done.extremes(["a_B", "V_B", "V_A"])

    omega = 2.0  # the acceleration of the piston at its outer dead position is r omega^2 (1 + lambda)
    assert found["a_B"][0].value == pytest.approx(r * omega**2 * (1.0 + r / l), rel=1e-12)
    assert difference(found["a_B"][0].at, 0.0) < 1e-7
    assert found["V_B"][1].value == 0.0
    assert [e.value for e in found["V_A"]] == pytest.approx([r * omega] * 2)


def test_velocities_grow_without_bound_towards_a_limiting_position() -> None:
    done = cycle(slider_crank(), slider_crank_values(2.0, 1.0, 0.0), ("velocity",))

    found = done.extremes(["V_B", "V_A"])

    assert found["V_B"][0].value == math.inf
    assert found["V_B"][1].value == 0.0
    assert found["V_A"][0].value == pytest.approx(4.0)


def test_a_sliding_driver_moves_as_far_as_its_links_let_it() -> None:
    values = {"l_AB": 3.0, "l_OA": 1.0, "travel": 2.5, "speed": 0.5, "gamma": 0.3, "side": 1.0}

    done = cycle(piston_engine(), values, ("velocity",), positions=5)

    assert np.allclose(done.angles, [2.0, 2.5, 3.0, 3.5, 4.0], rtol=0, atol=1e-9)
    assert done.times[-1] == pytest.approx(2.0 / 0.5)
    assert done.statuses == ("singular", "ok", "ok", "ok", "singular")
    assert np.isfinite(done.values["A"]).all()
    swing = done.motions[0]
    assert swing.travel is not None
    assert swing.travel.length == pytest.approx(math.pi, abs=1e-6)


def test_a_sliding_driver_moves_from_where_to_where_the_user_says() -> None:
    values = {"l_AB": 3.0, "l_OA": 1.0, "travel": 2.5, "speed": -0.5, "gamma": 0.3, "side": 1.0}

    done = cycle(piston_engine(), values, ("velocity",), positions=4, start=1.5, end=4.5)

    assert np.allclose(done.angles, [4.5, 3.5, 2.5, 1.5], rtol=0, atol=1e-12)
    assert done.statuses == ("no-assembly", "ok", "ok", "no-assembly")
    assert [(arc.low, arc.high) for arc in done.reach.apart] == [
        (1.5, pytest.approx(2.0, abs=1e-11)),
        (pytest.approx(4.0, abs=1e-11), 4.5),
    ]


@pytest.mark.parametrize("phi", [0.0, math.pi])
def test_a_crank_that_cannot_turn_round_has_the_stroke_of_where_it_stands(phi: float) -> None:
    # at its limits the rod stands across the guide, under the pin at +-1; the slider goes on to where both lie in line
    values = slider_crank_values(math.sqrt(2.0), 1.0, 0.0) | {"phi": phi}

    done = motion(slider_crank(), values)

    ends = (1.0, 1.0 + math.sqrt(2.0)) if phi == 0.0 else (-1.0, 1.0 - math.sqrt(2.0))
    assert done.travel is not None
    assert (done.travel.low, done.travel.high) == pytest.approx(ends, abs=1e-6)


@pytest.mark.parametrize("positions", [-1, 0, 2, 1_000_000])
def test_a_number_of_positions_that_makes_no_cycle_is_refused(positions: int) -> None:
    with pytest.raises(InputError, match="positions"):
        cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.8), positions=positions)


def test_the_length_that_no_distance_exceeds_is_the_same_in_every_process() -> None:
    names, dice = ("l_OA", "l_AB", "l_CB", "x_E", "y_E", "x_O", "y_O", "x_C", "y_C"), random.Random(7)

    for _ in range(100):  # the order of a set of names is that of one process
        values = four_bar_values(*(dice.uniform(0.01, 1.0) for _ in range(4)))
        assert size_of(four_bar(), values) == math.fsum(abs(values[name]) for name in names)
