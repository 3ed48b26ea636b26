"""The whole cycle against closed forms: limiting angles, dead positions, strokes, ratios of times, extremes."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping

import numpy as np
import pytest

from kulman.plans.linkages.cycle import cycle
from kulman.plans.linkages.limits import Arc, limiting_places, reach_of, size_of, swept
from kulman.plans.linkages.mechanism import Mechanism, Stroke
from kulman.plans.linkages.solved import solve_linkage
from kulman.plans.linkages.strokes import OutputMotion, output_motions, stroke_of, working_stroke
from kulman.plans.zeros import Stretch, zeros
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
DRIVEN = {"l_AB": 3.0, "l_OA": 1.0, "travel": 2.5, "speed": 0.5, "gamma": 0.3, "side": 1.0}


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


def frame_of(v: Mapping[str, float]) -> tuple[float, float]:
    """Return the length and the direction of the frame OC."""
    along = complex(v["x_C"] - v["x_O"], v["y_C"] - v["y_O"])
    return abs(along), math.atan2(along.imag, along.real)


def test_zeros_close_together_are_found_wherever_they_lie_between_grid_points() -> None:
    dice = np.random.default_rng(5)
    for _ in range(400):
        middle, b, _ = dice.uniform(0.0, TURN, 3)
        half, part, waves = 10 ** dice.uniform(-7.0, -1.0), dice.uniform(0.0, 0.9), dice.integers(1, 40)
        ends = [middle - half, middle + half]

        def dip(x: np.ndarray) -> np.ndarray:
            size = 1.0 + part * np.cos(waves * x + b)  # noqa: B023
            return np.sin(0.5 * (x - ends[0])) * np.sin(0.5 * (x - ends[1])) * size  # noqa: B023

        roots, touches = zeros(dip, Stretch(0.0, TURN, TURN / 360, closed=True))

        assert closest(roots.tolist(), ends) < 1e-11
        assert len(touches) == 0


@counts(30, 1_500)
def test_limiting_angles_of_four_bars_follow_the_cosine_law(count: int) -> None:
    mechanism, worst, limited = four_bar(), 0.0, 0
    for v in random_four_bars(SEED, count):
        frame, tilt = frame_of(v)
        # coupler and rocker lie in line: AC is their sum or their difference
        lined = (v["l_AB"] + v["l_CB"], abs(v["l_AB"] - v["l_CB"]))
        within = [distance for distance in lined if abs(frame - v["l_OA"]) < distance < frame + v["l_OA"]]
        expected = [tilt + s * angle_in(v["l_OA"], frame, distance) for distance in within for s in (-1.0, 1.0)]

        ends = [end for arc in reach(mechanism, v).apart for end in (arc.low, arc.high)]

        worst = max(worst, closest(ends, expected))
        limited += bool(ends)
    assert limited > count / 4
    assert worst < 1e-11


@pytest.mark.parametrize("missing", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_an_arc_shorter_than_the_grid_is_seen(missing: float) -> None:
    found = reach(slider_crank(), slider_crank_values(1.0, 1.0 - missing, 0.0))

    half = math.atan2(math.sqrt(missing * (2.0 - missing)), 1.0 - missing)  # arccos(1 - missing), not to cancel
    ends = sorted(end for arc in found.apart for end in (arc.low, arc.high))
    expected = sorted(top + s * half for top in (math.pi / 2, 3 * math.pi / 2) for s in (-1.0, 1.0))
    # the difference of nearly equal lengths is known to 1e-16 only
    assert np.allclose(ends, expected, rtol=0.0, atol=1e-12 + 1e-15 / half)


def test_reach_is_all_nothing_or_lies_on_both_sides_of_where_the_crank_stands() -> None:
    free, apart = reach(four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0)), four_bar_values(0.1, 1.0, 1.0, 5.0)
    nowhere = reach(four_bar(), apart)

    values = slider_crank_values(2.0, 1.0, 0.0) | {"phi": math.radians(800.0)}
    around = limiting_places(slider_crank(), values)

    assert free.apart == free.changes == free.poles == nowhere.stretches == ()
    assert free.free
    assert nowhere.apart == (Arc(0.0, TURN),)
    assert limiting_places(four_bar(), apart) is None
    assert set(cycle(four_bar(), apart).statuses) == {"no-assembly"}
    assert around == pytest.approx((math.radians(750.0), math.radians(870.0)), abs=1e-11)


def motion(mechanism: Mechanism, values: Mapping[str, float]) -> OutputMotion:
    """Return how link 3 moves: what a cycle says of it, without its positions."""
    drive = swept(mechanism, values)
    return next(m for m in output_motions(drive, values, reach_of(drive, values)) if m.output.link == 3)


def misses(done: OutputMotion, dead: list[float], length: float, ratio: float) -> np.ndarray:
    """Return how far dead positions, the travel and the ratio of times are from those of closed forms."""
    assert done.travel is not None
    assert done.ratio is not None
    places = closest([spot.angle for spot in done.dead], dead)
    return np.array([places, abs(done.travel.length - length), abs(done.ratio - ratio)])


@counts(30, 1_500)
def test_sliders_stand_dead_where_crank_and_rod_lie_in_line(count: int) -> None:
    missed = []
    for v in random_slider_cranks(SEED, count):
        r, l, e, side = v["l_OA"], v["l_AB"], v["e"], v["side"]
        # the slider lies at the distance l + r or l - r from O, e to the left of it; the crank points there or back
        far, near = (math.atan2(e, side * math.sqrt((l + k * r) ** 2 - e**2)) for k in (1, -1))
        stroke = math.sqrt((l + r) ** 2 - e**2) - math.sqrt((l - r) ** 2 - e**2)
        dead = [far + v["gamma"], near + v["gamma"] + math.pi]
        theta = abs(difference(far, near))
        ratio = (math.pi + theta) / (math.pi - theta)
        missed.append(misses(motion(slider_crank(), v), dead, stroke, ratio) / [1.0, stroke, 1.0])

    assert np.all(np.max(missed, axis=0) < [1e-11, 1e-12, 1e-11])


@counts(30, 1_500)
def test_rockers_stand_dead_where_crank_and_coupler_lie_in_line(count: int) -> None:
    missed = []
    for v in random_crank_rockers(SEED, count):
        frame, tilt = frame_of(v)
        far, near = (v["l_AB"] + k * v["l_OA"] for k in (1.0, -1.0))
        # O, A, B in line: B stands to the left of OC where the branch is +1; the crank points to B, or away from it
        turn = [v["side"] * angle_in(frame, distance, v["l_CB"]) for distance in (far, near)]
        swing = angle_in(frame, v["l_CB"], far) - angle_in(frame, v["l_CB"], near)
        dead = [tilt + turn[0], tilt + turn[1] + math.pi]
        theta = abs(turn[0] - turn[1])
        ratio = (math.pi + theta) / (math.pi - theta)
        missed.append(misses(motion(four_bar(), v), dead, swing, ratio) / [1.0, 1.0, ratio])

    assert np.max(missed) < 1e-11


def test_an_output_that_turns_round_has_no_dead_position_and_no_stroke() -> None:
    drag_link = four_bar_values(2.0, 2.5, 3.0, 1.0)

    done = motion(four_bar(), drag_link)

    assert (done.dead, done.travel) == ((), None)
    with pytest.raises(InputError, match="no strokes"):
        stroke_of(four_bar(Stroke(3)), drag_link)


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


@pytest.mark.parametrize("working", [-1.0, 1.0])
def test_a_working_stroke_runs_between_positions_with_crank_and_coupler_in_line(working: float) -> None:
    mechanism = four_bar(Stroke(3, "working"))
    for values in random_crank_rockers(seed=11, count=60):
        given = {**values, "working": working}
        ends = working_stroke(mechanism, given)

        stands = [solve_linkage(mechanism, {**given, "phi": end}, ("position",)) for end in ends]

        arms = []
        for stand in stands:
            O, A, B = (stand.point(name) for name in "OAB")
            assert abs(((B - O) / (A - O)).imag) < 1e-6  # the angle is known better than 1e-12
            arms.append(stand.point("B") - stand.point("C"))
        turned = math.remainder(math.atan2((arms[1] / arms[0]).imag, (arms[1] / arms[0]).real), math.tau)
        assert turned * working > 0.0


def test_without_a_stroke_the_cycle_begins_at_the_zero_of_the_crank_or_where_it_is_said() -> None:
    plain = cycle(slider_crank(), slider_crank_values(1.0, 3.0, 0.8, sense=-1.0), positions=8)
    said = cycle(slider_crank(Stroke(3)), slider_crank_values(1.0, 3.0, 0.8), positions=8, start=0.7)

    assert plain.angles.tolist() == [-k * TURN / 8 for k in range(8)]
    assert plain.times[1] == pytest.approx(TURN / 8 / 2.0)
    assert said.angles[0] == 0.7


@counts(20, 500)
def test_links_keep_their_lengths_and_branches_over_the_cycle(count: int) -> None:
    for values in random_four_bars(SEED + 2, count):
        done = cycle(four_bar(), values, ("position",), positions=360)

        O, A, B, C, E = (done.values[point] for point in "OABCE")
        whole = np.isfinite(B)
        side = ((C - A).conj() * (B - A)).imag[whole] * values["side"]
        for start, end, length in ((O, A, "l_OA"), (A, B, "l_AB"), (C, B, "l_CB")):
            assert np.abs(np.abs(end - start)[whole] / values[length] - 1.0).max(initial=0.0) < 1e-12
        bent = (E - A)[whole] * (B - A)[whole].conj()
        expected = complex(values["x_E"], values["y_E"]) * values["l_AB"]
        assert np.all(np.abs(bent - expected) < 1e-12 * abs(expected))
        assert np.all(side >= 0.0)
        assert np.array_equal(whole, np.array(done.statuses) != "no-assembly")


def test_positions_of_a_cycle_are_those_solved_one_by_one() -> None:
    mechanism, values = four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0, sense=-1.0)

    done = cycle(mechanism, values, MOTION, positions=12, start=0.123)

    for k, angle in enumerate(done.angles.tolist()):
        solved = solve_linkage(mechanism, {**values, "phi": angle}, MOTION)
        assert {name: done.values[name][k] for name in done.quantities} == {
            n: solved.values[n] for n in done.quantities
        }


@counts(10, 150)
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
        ends = np.array([end for arc in done.reach.apart for end in (arc.low, arc.high)])
        off = np.abs((done.angles[:, None] - ends + math.pi) % TURN - math.pi)
        smooth = np.min(off, axis=1, initial=1.0) > 0.05
        rate = values["speed"] * values["sense"] / (2.0 * h)
        for order, whole in (("", "velocity."), ("velocity.", "acceleration.")):
            for point in "ABE":
                slope = (ahead[order + point] - behind[order + point]) * rate
                size = np.nanmax(np.abs(here[whole + point][smooth]), initial=1e-300)
                missed = np.abs(slope - here[whole + point])[smooth & np.isfinite(slope)]
                assert missed.max(initial=0.0) < 1e-5 * size


def test_links_that_lie_flat_are_change_points_and_do_not_flip_silently() -> None:
    parallelogram = cycle(four_bar(), four_bar_values(1.0, 2.0, 1.0, 2.0), ("velocity",), positions=8)
    bars = cycle(slider_crank(), slider_crank_values(1.0, 1.0, 0.0), ("velocity",), positions=4)

    A, B, C = (parallelogram.values[point] for point in "ABC")
    side, flat = ((C - A).conj() * (B - A)).imag, np.array([0, 4])
    assert [parallelogram.statuses[k] for k in flat] == [bars.statuses[k] for k in (1, 3)] == ["singular", "singular"]
    assert np.all(np.isfinite(B))
    assert np.flatnonzero(np.isnan(parallelogram.values["V_B"])).tolist() == flat.tolist()
    assert np.all(np.abs(side[flat]) < 1e-7)
    assert np.all(np.delete(side, flat) > 0.1)  # the branch that the task names, on both sides of the change point
    assert parallelogram.reach.apart == ()
    assert closest(list(parallelogram.reach.changes), [0.0, math.pi]) < 1e-7
    assert closest(list(bars.reach.changes), [math.pi / 2, 3 * math.pi / 2]) < 1e-7
    assert bars.motions[0].ratio is None


@pytest.mark.parametrize(
    ("mechanism", "values"),
    [
        (slider_crank(), slider_crank_values(1.0, 2.1, 0.7, tilt=0.4)),
        (four_bar(), four_bar_values(1.0, 3.0, 2.5, 2.0)),
        pytest.param(four_bar(), four_bar_values(1.0, 2.02, 2.0, 1.05), id="a sharp peak"),
    ],
)
def test_extremes_are_those_of_a_fine_grid_and_better(mechanism: Mechanism, values: dict[str, float]) -> None:
    done = cycle(mechanism, values, MOTION)
    dense = done.at(np.linspace(0.0, TURN, 36_001), done.quantities)

    found = done.extremes()

    assert set(found) == set(done.quantities)
    for name, (most, least) in found.items():
        fine = np.abs(dense[name]) if np.iscomplexobj(dense[name]) else dense[name]
        size = np.abs(fine).max() or 1.0
        assert fine.max() <= most.value + 1e-12 * size
        assert least.value <= fine.min() + 1e-9 * size
        for extreme in (most, least):
            at = done.at(np.array([extreme.at]), [name])[name][0]
            value = abs(at) if isinstance(at, complex) else at
            assert value == pytest.approx(extreme.value, abs=1e-9 * size)


def test_extremes_lie_where_the_textbook_says_and_grow_without_bound_towards_a_limit() -> None:
    r, l, omega = 0.05, 0.2, 2.0
    done = cycle(slider_crank(), slider_crank_values(r, l, 0.0), MOTION)
    limited = cycle(slider_crank(), slider_crank_values(2.0, 1.0, 0.0), ("velocity",))

    found, unbounded = done.extremes(["a_B", "V_B", "V_A"]), limited.extremes(["V_B", "V_A"])

    # the acceleration of the piston at its outer dead position is r omega^2 (1 + lambda)
    assert found["a_B"][0].value == pytest.approx(r * omega**2 * (1.0 + r / l), rel=1e-12)
    assert difference(found["a_B"][0].at, 0.0) < 1e-7
    assert found["V_B"][1].value == 0.0
    assert [e.value for e in found["V_A"]] == pytest.approx([r * omega] * 2)
    assert [e.value for e in unbounded["V_B"]] == [math.inf, 0.0]
    assert unbounded["V_A"][0].value == pytest.approx(4.0)


def test_a_sliding_driver_moves_as_far_as_its_links_let_it_or_from_where_to_where_the_user_says() -> None:
    whole = cycle(piston_engine(), DRIVEN, ("velocity",), positions=5)
    back = cycle(piston_engine(), {**DRIVEN, "speed": -0.5}, ("velocity",), positions=4, start=1.5, end=4.5)

    swing = whole.motions[0]
    assert np.allclose(whole.angles, [2.0, 2.5, 3.0, 3.5, 4.0], rtol=0, atol=1e-9)
    assert whole.times[-1] == pytest.approx(2.0 / 0.5)
    assert whole.statuses == ("singular", "ok", "ok", "ok", "singular")
    assert np.isfinite(whole.values["A"]).all()
    assert swing.travel is not None
    assert swing.travel.length == pytest.approx(math.pi, abs=1e-6)
    assert np.allclose(back.angles, [4.5, 3.5, 2.5, 1.5], rtol=0, atol=1e-12)
    assert back.statuses == ("no-assembly", "ok", "ok", "no-assembly")
    ends = [end for arc in back.reach.apart for end in (arc.low, arc.high)]
    assert ends == pytest.approx([1.5, 2.0, 4.0, 4.5], abs=1e-11)


@pytest.mark.parametrize("phi", [0.0, math.pi])
def test_a_crank_that_cannot_turn_round_has_the_stroke_of_where_it_stands(phi: float) -> None:
    # at its limits the rod stands across the guide, under the pin at +-1; the slider goes on to where both lie in line
    done = motion(slider_crank(), slider_crank_values(math.sqrt(2.0), 1.0, 0.0) | {"phi": phi})

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
